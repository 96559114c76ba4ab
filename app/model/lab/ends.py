"""Where the runs of all spins end, for the strip below the slider: of a toy, tilt and friction, for all visitors."""

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

SPINS = np.linspace(0.0, 50.0, 101)  # rev/s: all of the slider
TIMES = np.arange(1.0, 6.01, 0.5)  # s: whether it stands is looked at then, for it may fall again
STANDS, LEANS = np.radians(170), np.radians(20)
CLOSE = 2  # cells: where the end changes as soon again, ends are mixed
MOST = 64  # that are kept
LOOKS = 0.2  # s between two looks of who waits for another's
Key = tuple[Toy, float, float, float]  # toy, tilt, mu, patch


class Segment(NamedTuple):
    """From one spin to another (rev/s) runs end alike: one of ends.IN_LAB or "mixed", and its word."""

    least: float
    most: float
    code: str
    word: str


class Ends(NamedTuple):
    """spins (n,), the code of each run (n,), and the same in Segments; "mixed" where neighbours alternate."""

    spins: Array
    codes: tuple[str, ...]
    part: str

    @property
    def segments(self) -> tuple[Segment, ...]:
        """In the page's language."""
        part = say(f"planes.parts.{self.part}")
        edges = [self.spins[0], *(self.spins[1:] + self.spins[:-1]) / 2, self.spins[-1]]
        found, place = [], 0
        for code, group in groupby(mixed(self.codes)):
            first, place = place, place + len(list(group))
            found.append(Segment(float(edges[first]), float(edges[place]), code, say(f"lab.ends.{code}", part=part)))
        return tuple(found)


_kept: OrderedDict[Key, Ends] = OrderedDict()
_under_way: set[Key] = set()
_changing = threading.Condition()  # of these two; who waits for another's hears of it


def known_ends(toy: Toy, tilt: float, mu: float, patch: float = PATCH) -> Ends | None:
    """What ends_of() has found before, or ships with the arrival; None if it has to be asked."""
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
    """The Ends of a toy. look: called with the share that is done; what it raises ends it. Raises TopError."""
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
    """ends_of(), which of those who ask for the same at once only one computes."""
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
    """Whether it is now who asks that computes it; waits for a while where another does."""
    with _changing:
        free = _changing.wait_for(lambda: key not in _under_way, LOOKS)
        if free:
            _under_way.add(key)
    return free


def codes_of(many: Many) -> tuple[str, ...]:
    """The code of each row of runs, that differ in their length alone."""
    high = many.theta_end > STANDS
    stands, inverted = ((high & (many.end == end)).any(axis=1) for end in ("stem", "inverted"))
    last = many.theta_end[:, -1]
    codes = np.select(
        [stands, inverted, np.isnan(last), last > LEANS], ["stands", "inverted", "refused", "leans"], "upright"
    )
    return tuple(codes.tolist())


def mixed(codes: tuple[str, ...]) -> tuple[str, ...]:
    """The codes, with "mixed" from where they begin to alternate within CLOSE cells to where that ends."""
    changes = [i for i in range(1, len(codes)) if codes[i] != codes[i - 1]]
    found = list(codes)
    for first, then in pairwise(changes):
        if then - first <= CLOSE:
            found[first - 1 : then + 1] = ["mixed"] * (then + 2 - first)
    return tuple(found)
