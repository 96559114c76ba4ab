"""Which view of the Lab, or which other tab, an address opens, and how little an address need say for it.

The Lab has three views: the toy that flips, at the level "explore"; at "research" what rolls, as the paper has it, and
the three planes. Each has a name of its own in an address.

An address with no query opens the first, as does one that names it. Any other that names no tab opens what rolls, as it
did before there was a Lab; and one that names no level is of a time when there was only what is now research.
"""

from app.state.names import LEVEL, LEVELS, TAB

FIRST, USUAL = AT_ONCE = "lab", "roll"
"""And these are there with the page."""
PLANES = "three-planes"
VIEWS = dict(zip(LEVELS, ((FIRST,), (USUAL, PLANES)), strict=True))


def opened(texts, query=""):
    """The name of what the texts of a query open; query: as it came, of which the texts may be a part."""
    return texts.get(TAB, USUAL if texts or query.strip("?") else FIRST)


def level(texts, query=""):
    """The level at which the texts of a query open it."""
    explores = opened(texts, query) == FIRST
    return texts.get(LEVEL, "explore" if explores else "research")


def shortest(texts):
    """The texts of a query without the tab, the level and the table, where these go without saying."""
    if opened(texts) == USUAL:
        texts = {key: text for key, text in texts.items() if key != "table"}
    for key, usual in ((LEVEL, level), (TAB, opened)):
        others = {name: text for name, text in texts.items() if name != key}
        if key in texts and usual(others) == texts[key]:
            texts = others
    return texts
