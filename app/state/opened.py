"""Which view of the Lab, or which other tab, an address opens, and what an address can leave out.

The Lab has three views: the toy that flips, at the level "explore"; at "research" the rolling motion, as in the paper,
and the three planes. Each has its own name in an address.

An address that names no tab opens the first view. One that names another tab but no level comes from a time when there
was only what is now research.
"""

from app.state.names import LEVEL, LEVELS, PLANES, ROLLING, ROOMS, TAB, TOY

FIRST, USUAL = AT_ONCE = TOY, ROLLING
"""Rooms whose view is created with the page."""
VIEWS = dict(zip(LEVELS, ((FIRST,), (USUAL, PLANES)), strict=True))


def opened(texts):
    """The name of the room that a query with these texts opens."""
    room = texts.get(TAB, FIRST)
    return room if room in ROOMS else USUAL


def level(texts):
    """The level at which it opens it."""
    return texts.get(LEVEL, LEVELS[0] if opened(texts) == FIRST else LEVELS[1])


def shortest(texts):
    """The texts of a query without the tab, the level and the table if these are the default."""
    if opened(texts) == USUAL:
        texts = {key: text for key, text in texts.items() if key != "table"}
    for key, usual in ((LEVEL, level), (TAB, opened)):
        others = {name: text for name, text in texts.items() if name != key}
        if key in texts and usual(others) == texts[key]:
            texts = others
    return texts
