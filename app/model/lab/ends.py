"""How the runs at all spins end, for the strip below the slider; for one toy, tilt and friction, shared by all
visitors."""

import threading
from collections import OrderedDict
from collections.abc import Callable
from itertools import groupby, pairwise
from typing import NamedTuple

import numpy as np

from app.model import arrival
from app.model.lab.run import PATCH, Toy, start_of
from app.text import say
from tippe_core import Many, slide_many
from tippe_core.types import Array

SPINS = np.linspace(0.0, 50.0, 101)  # rev/s: the whole range of the slider
TIMES = np.arange(1.0, 6.01, 0.5)  # s: when it is checked whether the toy stands, because it may fall again
STANDS, LEANS = np.radians(170), np.radians(20)
CLOSE = 2  # cells: if the end changes again within so few, the ends are called mixed
MOST = 64  # the number of Ends that are stored
LOOKS = 0.2  # s between two checks of a page that waits for the result of another
Key = tuple[Toy, float, float, float]  # toy, tilt, mu, patch


class Segment(NamedTuple):
    """From one spin to another (rev/s) all runs end alike: code is one of ends.IN_LAB or "mixed", word is its name."""

    least: float
    most: float
    code: str
    word: str


class Ends(NamedTuple):
    """spins (n,), the code of each run (n,), and the part of the body that may touch besides the ball."""

    spins: Array
    codes: tuple[str, ...]
    part: str

    @property
    def segments(self) -> tuple[Segment, ...]:
        """The runs grouped into Segments, with words in the page's language; "mixed" where neighbouring runs
        alternate."""
        part = say(f"planes.parts.{self.part}")
        edges = [self.spins[0], *(self.spins[1:] + self.spins[:-1]) / 2, self.spins[-1]]
        found, place = [], 0
        for code, group in groupby(mixed(self.codes)):
            first, place = place, place + len(list(group))
            found.append(Segment(float(edges[first]), float(edges[place]), code, say(f"lab.ends.{code}", part=part)))
        return tuple(found)


_kept: OrderedDict[Key, Ends] = OrderedDict()
_under_way: set[Key] = set()
_changing = threading.Condition()  # guards _kept and _under_way; notified when a computation ends


def known_ends(toy: Toy, tilt: float, mu: float, patch: float = PATCH) -> Ends | None:
    """What ends_of() has found before, or what ships with the arrival; None if it has to be computed."""
    key = toy, tilt, mu, patch
    with _changing:
        found = _kept.get(key)
        if found is None and key == (arrival.TOY, arrival.TILT, arrival.MU, PATCH):
            found = _kept[key] = Ends(SPINS, arrival.read_ends(), start_of(toy, 0.0, tilt, mu).part)
        if found is not None:
            _kept.move_to_end(key)
    return found


def ends_of(
    toy: Toy, tilt: float, mu: float, patch: float = PATCH, look: Callable[[float], object] | None = None
) -> Ends:
    """The Ends of a toy. look: called with the share that is done; an exception that it raises stops the computation.
    Raises TopError."""
    starts = [start_of(toy, float(spin), tilt, mu, patch=patch) for spin in SPINS]
    start, states = starts[0], np.array([[each.state] for each in starts], dtype=object)
    times = TIMES / start.scales.time
    many = slide_many(start.top, states, start.friction, times, edge=start.edge, progress=look)
    found = Ends(SPINS, codes_of(many), start.part)
    with _changing:
        _kept[toy, tilt, mu, patch] = found
        while len(_kept) > MOST:
            _kept.popitem(last=False)
    return found


def ends_once(
    toy: Toy, tilt: float, mu: float, patch: float = PATCH, look: Callable[[float], object] | None = None
) -> Ends:
    """ends_of(), but if several pages ask for the same Ends at the same time, only one of them computes it."""
    key = toy, tilt, mu, patch
    while not _taken(key):
        if look is not None:
            look(0.0)
    try:
        return known_ends(*key) or ends_of(*key, look=look)
    finally:
        with _changing:
            _under_way.discard(key)
            _changing.notify_all()


def _taken(key: Key) -> bool:
    """Whether the caller should compute it; waits up to LOOKS seconds if another page is doing so."""
    with _changing:
        free = _changing.wait_for(lambda: key not in _under_way, LOOKS)
        if free:
            _under_way.add(key)
    return free


def codes_of(many: Many) -> tuple[str, ...]:
    """The code of each row of runs; the runs in a row differ only in their length."""
    high = many.theta_end > STANDS
    stands, inverted = ((high & (many.end == end)).any(axis=1) for end in ("stem", "inverted"))
    last = many.theta_end[:, -1]
    codes = np.select(
        [stands, inverted, np.isnan(last), last > LEANS], ["stands", "inverted", "refused", "leans"], "upright"
    )
    return tuple(codes.tolist())


def mixed(codes: tuple[str, ...]) -> tuple[str, ...]:
    """The codes, replaced by "mixed" over each range in which they alternate within CLOSE cells."""
    changes = [i for i in range(1, len(codes)) if codes[i] != codes[i - 1]]
    found = list(codes)
    for first, then in pairwise(changes):
        if then - first <= CLOSE:
            found[first - 1 : then + 1] = ["mixed"] * (then + 2 - first)
    return tuple(found)
