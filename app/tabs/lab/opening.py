"""Which tab an address opens, and how little an address need say for it.

An address with no query opens the Lab. Any other that names no tab opens Roll, as it did before there was a Lab.
"""

from app.state.names import TAB

FIRST, USUAL = AT_ONCE = "lab", "roll"
"""And these are there with the page."""


def opened(texts, query=""):
    """The name of the tab that the texts of a query open; query: as it came, of which the texts may be a part."""
    return texts.get(TAB, USUAL if texts or query.strip("?") else FIRST)


def shortest(texts):
    """The texts of a query without the tab, where that goes without saying."""
    others = {key: text for key, text in texts.items() if key != TAB}
    return others if TAB in texts and opened(others) == texts[TAB] else texts
