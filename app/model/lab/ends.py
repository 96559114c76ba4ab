"""How the runs at all spins end, for the strip below the slider; for one start of which only the spin differs, shared
by all visitors."""

import threading
import time
from collections import OrderedDict
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from itertools import groupby, pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from app.model import arrival
from app.model.once import ONCE
from app.model.phases import NODS, STANDS
from app.model.setup import SECONDS, Setup, start_of
from app.text import say
from tippe_core import Many, State, States, Top, slide_many, thresholds
from tippe_core.types import Array, Bools

SPINS = np.linspace(0.0, 50.0, 101)  # rev/s: the whole range of the slider
TIMES = np.arange(1.0, 6.01, 0.5)  # s: when it is checked whether the toy stands, because it may fall again
LATER, LIFE = 2.0, 60.0  # s: then it is checked so often, and so long, of those of UNDECIDED that may come to stand
UNDECIDED = ("leans", "upright")
HIGH, LOW = np.radians(180 - STANDS[0]), np.radians(NODS)  # as the judge's phases
CLOSE = 2  # cells: if the end changes again within so few, the ends are called mixed
MOST = 64  # the number of Ends that are stored


class Segment(NamedTuple):
    """From the spin of the first of these runs to that of the first of the next (rev/s) all end alike: code is one of
    ends.IN_LAB or "mixed", word is its name."""

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
        begins = [*self.spins, self.spins[-1]]
        found, place = [], 0
        for code, group in groupby(mixed(self.codes)):
            first, place = place, place + len(list(group))
            found.append(Segment(float(begins[first]), float(begins[place]), code, say(f"lab.ends.{code}", part=part)))
        return tuple(found)


_kept: OrderedDict[Setup, Ends] = OrderedDict()
_changing = threading.Lock()


def of_spins(start: Setup) -> Setup:
    """The start of which the Ends are: any spin, let go with G at rest."""
    return replace(start, spin=0.0, slip=1.0, rolling=None, seconds=SECONDS, pushes=())


ARRIVAL = of_spins(start_of(*arrival.ARRIVAL[1:]))


def known_ends(start: Setup) -> Ends | None:
    """What ends_of() has found before, or what ships with the arrival; None if it has to be computed."""
    key = of_spins(start)
    with _changing:
        found = _kept.get(key)
        if found is None and key == ARRIVAL:
            found = _kept[key] = Ends(SPINS, arrival.read_ends(), key.part)
        if found is not None:
            _kept.move_to_end(key)
    return found


def ends_of(start: Setup, look: Callable[[float], object] | None = None) -> Ends:
    """The Ends of a start. look: called with the share that is done; an exception that it raises stops the computation.
    Raises TopError."""
    key = of_spins(start)
    starts = [replace(key, spin=float(spin)) for spin in SPINS]
    found = Ends(SPINS, _codes(starts, look or (lambda share: None)), key.part)
    with _changing:
        _kept[key] = found
        while len(_kept) > MOST:
            _kept.popitem(last=False)
    return found


def ends_once(start: Setup, look: Callable[[float], object] | None = None) -> Ends:
    """ends_of(), but if several pages ask for the same Ends at the same time, only one of them computes it."""
    key = of_spins(start)

    def wait(seconds: float) -> None:
        time.sleep(seconds)
        if look is not None:
            look(0.0)

    found: Ends = ONCE.find(wait, key, partial(ends_of, key, look=look), known_ends)
    return found


def _codes(starts: list[Setup], look: Callable[[float], object]) -> tuple[str, ...]:
    """The codes of the runs: until TIMES[-1], and of those that may come to stand later, until they do, or roll."""
    start, unit = starts[0], starts[0].scales.time
    slides = partial(slide_many, start.top, friction=start.friction, edge=start.edge)
    states = np.array([[each.state] for each in starts], dtype=object)
    many = slides(state=states, t_end=TIMES / unit, progress=lambda share: look(share / 2))
    codes, last = np.array(codes_of(many)), [values[:, -1].copy() for values in many.state_end]
    left = np.flatnonzero(_may_stand(start.top, last) & np.isin(codes, UNDECIDED) & (many.end[:, -1] != "rolling"))
    for t in np.arange(TIMES[-1], LIFE, LATER):  # they go on from where they are
        if not len(left):
            break
        states = State(**{name: values[left] for name, values in zip(States._fields, last, strict=True)})  # type: ignore[arg-type]
        more = slides(state=states, t_end=LATER / unit, progress=partial(_at_most, look, float(t / LIFE)))
        for values, now in zip(last, more.state_end, strict=True):
            values[left] = now
        now = np.array(codes_of(Row(more.theta_end[:, None], more.end[:, None])))
        codes[left] = np.where(now == "refused", codes[left], now)
        left = left[np.isin(now, UNDECIDED) & (more.end != "rolling") & _may_stand(start.top, last)[left]]
    return tuple(codes.tolist())


def _at_most(look: Callable[[float], object], share: float, done: float) -> None:
    look((1 + share) / 2)


def _may_stand(top: Top, last: list[Array]) -> Bools:
    """Whether runs that are in these fields of States may come to stand upside down: they have the energy, and are not
    upright with a spin at which that is stable. Only for tops with a > 0."""
    now = States(*last)
    rise = top.a * np.sin(now.theta) * now.theta_dot
    turning = top.I1 * (now.theta_dot**2 + now.omega2**2) + top.I3 * now.omega3**2
    energy = (turning + now.vx**2 + now.vy**2 + rise**2) / 2 + 1 - top.a * np.cos(now.theta)
    change = thresholds(top).upright
    stays = change.stable == "always" or (change.stable == "below") & (np.abs(now.omega3) < change.spin) & (
        now.theta < LOW
    )
    return np.asarray((top.a > 0) & (energy > 1 + top.a) & ~np.asarray(stays))


class Row(NamedTuple):
    """What codes_of() reads of a Many."""

    theta_end: Array
    end: NDArray[Any]


def codes_of(many: Many | Row) -> tuple[str, ...]:
    """The code of each row of runs; the runs in a row differ only in their length."""
    high = many.theta_end > HIGH
    stands, inverted = ((high & (many.end == end)).any(axis=1) for end in ("stem", "inverted"))
    last = many.theta_end[:, -1]
    codes = np.select(
        [stands, inverted, np.isnan(last), last > LOW], ["stands", "inverted", "refused", "leans"], "upright"
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
