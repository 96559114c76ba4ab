"""The meaning of each symbol and term, shown on hover wherever it occurs: a sketch and words."""

from app.bundle import Bundled
from app.text import listed
from app.widgets.controls import hints


class Symbols(Bundled):
    """It has no place of its own on the page. The sketches are in the browser: frontend/src/widgets/sketches.js."""

    @classmethod
    def says(cls, language=None):
        return {"symbols": hints(language), "terms": listed("glossary.terms", language)}
