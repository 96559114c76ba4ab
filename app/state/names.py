"""All names that an address can contain: what each refers to, how it is written, and whether a change of it can be
undone.

A view stores only what has a row here; a UrlState finds the rows by the owner's class.
"""

import ipaddress
from dataclasses import dataclass
from typing import Any
from urllib.parse import quote

from app.model.lesson.lesson import BEFORE
from app.model.lesson.lesson import NAMES as STEPS
from app.model.maps.maps import COLOURS_BY
from app.model.region import PAPER
from app.model.setup import LAWS
from app.model.start import TABLES
from app.state.codecs import Body, Film, Key, Number, Numbers, OneOf, Pushes, Same
from app.state.map_text import MapText
from app.text import LANGUAGES

ROOMS = ("lab", "build-a-top", "families", "learn", "maps", "measure")
"""Tabs may consist of several rooms."""
LAB = ROOMS[0]
PANELS = ("which", "surface", "time", "values", "ends", "portraits")
"""What the Lab shows beside the stage at the level "Research"."""
LEVELS = ("explore", "research")
SECTIONS = ("lesson", "derivation", "published", "teach", "history")
"""The rooms of the tab Learn."""
SLOWER, FASTER = {str(n): 1 / n for n in (1, 2, 4, 8, 16, 32, 64)}, {".5": 2.0, ".25": 4.0, ".125": 8.0}
SPEEDS = SLOWER | FASTER | {"auto": 0.0}
"""How many times slower than the real top, in a link."""

# The defaults belong to a version: if they or the meaning of a name change, this becomes 5.
VERSION = 4
VERSION_NAME, TAB, LEVEL, LANGUAGE, VOTE, SECRET = "v", "tab", "level", "lang", "vote", "room"
FRAME = "frame"
"""Names that are read before there are views. FRAME: "1" on a page in a frame of another, without a head. SECRET: the
teacher's key of a vote, only in the teacher's own address."""


@dataclass(frozen=True)
class Name:
    """key: the name in the address; owner: the class whose parameter it stores; codec: one of codecs.py; where:
    whether it says what is open, so that a change of it is an entry of the browser's history."""

    key: str
    owner: str
    parameter: str
    codec: Any
    undoable: bool = True
    where: bool = False


def _words(*words):
    return OneOf(**{word: word for word in words})


_SWITCH = OneOf(yes=True, no=False)


def _numbers(**names):
    """{key: parameter} of numbers of the start."""
    return [Name(key, "Explorer", parameter, Number) for key, parameter in names.items()]


def _switches(owner, **names):
    """{key: parameter} of what is on or off, and no step of undo."""
    return [Name(key, owner, parameter, _SWITCH, undoable=False) for key, parameter in names.items()]


ROWS = (
    Name("body", "Explorer", "shape", Body),
    *_numbers(a="a", I1="I1", I3="I3"),
    Name("mu", "Explorer", "mu_s", Same),
    Name("by", "Explorer", "given", _words("share", "E", "state", "hand")),
    *_numbers(KJ="K_J", KR="K_R", e="energy", E="E"),
    *_numbers(th="theta", thd="theta_dot", w2="omega2", w3="omega3", phi="phi", psi="psi"),
    *_numbers(spin="spin", tilt="tilt", slip="slip"),
    Name("table", "Explorer", "table", _words(*TABLES), undoable=False),
    *_numbers(mu_k="mu"),
    Name("law", "Explorer", "law", _words(*LAWS)),
    *_numbers(gamma="gamma", eps="eps", patch="patch"),
    Name("land", "Explorer", "landing", _words("stop", "plastic")),
    Name("stem", "Explorer", "stem", _SWITCH),
    Name("push", "Explorer", "pushes", Pushes),
    Name("half", "Explorer", "upper", OneOf(yes=True, no=False, paper=PAPER)),
    Name("limit", "Explorer", "limit", OneOf(lift="lift-off", slip="slip")),
    # playback and view
    Name("t", "Clock", "at", Number, undoable=False),
    Name("slow", "Playing", "speed", OneOf(**SPEEDS), undoable=False),
    Name("view", "Playing", "camera", Numbers(3), undoable=False),
    *_switches("Playing", track="show_track", trace="show_trace", G="show_com_path", F="show_force",
               cone="show_cone", w="show_omega", L="show_momentum", follow="follow"),
    # the page
    Name(TAB, "Rooms", "room", _words(*ROOMS), undoable=False, where=True),
    Name(LEVEL, "Rooms", "level", _words(*LEVELS), undoable=False, where=True),
    Name("panel", "Research", "panel", _words(*PANELS), undoable=False, where=True),
    Name("face", "Controls", "face", _words("constants", "state"), undoable=False),
    *_switches("Look", dark="dark", large="large"),
    Name(LANGUAGE, "PageLanguage", "lang", _words(*LANGUAGES), undoable=False),
    # the maps
    Name("map", "MapChoice", "request", MapText),
    Name("mapby", "MapChoice", "colour", _words(*COLOURS_BY)),
    Name("mapat", "MapChoice", "place", Numbers(2)),
    # data of a film
    Name("film", "Filmed", "film", Film, undoable=False),
    # lessons
    Name("step", "Learn", "step", OneOf(**{step: step for step in STEPS}, **BEFORE), undoable=False, where=True),
    Name("learn", "Learn", "section", _words(*SECTIONS), undoable=False, where=True),
    Name(SECRET, "Learn", "room", Key, undoable=False),
)  # fmt: skip
NAMES = {row.key: row for row in ROWS}


def of(owner):
    """{parameter: Name} of a class."""
    return {row.parameter: row for row in ROWS if row.owner == owner}


def is_local(host):
    """Whether an address is that of this machine, which a phone cannot reach."""
    try:
        return ipaddress.ip_address(host.strip("[]")).is_loopback
    except ValueError:
        return host == "localhost" or host.endswith(".localhost")


def link(**texts):
    """The query of a link that the page offers, of names that it knows."""
    unknown = texts.keys() - NAMES.keys()
    if unknown:
        raise LookupError(f"no such name in an address: {', '.join(unknown)}")
    return query({VERSION_NAME: str(VERSION)} | texts)


def query(texts):
    """The query with these texts, some of which may come from anyone."""
    return "?" + "&".join(f"{quote(key)}={quote(text)}" for key, text in texts.items())
