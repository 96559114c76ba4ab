"""Which room an address opens, at which level, and what an address can leave out. One that names nothing opens the Lab
as on arrival."""

from app.state.names import LEVEL, LEVELS, ROOMS, TAB

FIRST = ROOMS[0]
AT_ONCE = (FIRST,)
"""Rooms whose view is created with the page."""


def opened(texts):
    """The name of the room that a query with these texts opens."""
    room = texts.get(TAB, FIRST)
    return room if room in ROOMS else FIRST


def level(texts):
    """The level at which it opens it."""
    found = texts.get(LEVEL, LEVELS[0])
    return found if found in LEVELS else LEVELS[0]


def shortest(texts):
    """The texts of a query without the tab and the level if these are the default."""
    usual = {TAB: FIRST, LEVEL: LEVELS[0]}
    return {key: text for key, text in texts.items() if usual.get(key) != text}
