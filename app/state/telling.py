"""What the page says of a link."""

from app.model.lab.lab import scene_of
from app.model.telling import told
from app.state.url_state import explorer_of, read
from app.text import speaking


def tell(query="", language="en"):
    """What the page says of the start that a link opens, on each of the three tables, as data: see
    app.model.telling.told. query: as in an address; language: one of app.text.LANGUAGES. Raises TopError for a start
    that is impossible on all of them."""
    texts, _ = read(query)
    with speaking(language):
        start, _ = explorer_of(texts)
        return told(scene_of("three", start.setup, whole=True))
