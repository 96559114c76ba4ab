"""Which view of the Lab, or which other tab, an address opens, and what an address can leave out.

The Lab has three views: the toy that flips, at the level "explore"; at "research" the rolling motion, as in the paper,
and the three planes. Each has its own name in an address.

An address without a query opens the first view, as does one that names it. Any other address that names no tab opens
the rolling motion, as it did before there was a Lab; one that names no level comes from a time when there was only what
is now research.
"""

from app.state.names import LEVEL, LEVELS, TAB

FIRST, USUAL = AT_ONCE = "lab", "roll"
"""Rooms whose view is created with the page."""
PLANES = "three-planes"
VIEWS = dict(zip(LEVELS, ((FIRST,), (USUAL, PLANES)), strict=True))


def opened(texts, query=""):
    """The name of the room that a query opens; query: the original one, of which the texts may be a part."""
    return texts.get(TAB, USUAL if texts or query.strip("?") else FIRST)


def level(texts, query=""):
    """The level at which a query opens it."""
    explores = opened(texts, query) == FIRST
    return texts.get(LEVEL, "explore" if explores else "research")


def shortest(texts):
    """The texts of a query without the tab, the level and the table if these are the default."""
    if opened(texts) == USUAL:
        texts = {key: text for key, text in texts.items() if key != "table"}
    for key, usual in ((LEVEL, level), (TAB, opened)):
        others = {name: text for name, text in texts.items() if name != key}
        if key in texts and usual(others) == texts[key]:
            texts = others
    return texts
