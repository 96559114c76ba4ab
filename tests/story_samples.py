"""What the checker of the story reads from the samples of a run: spells, the running mean, turns of the tilt.

Written from docs/phases.md alone; nothing of the app is imported.
"""

from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise

import numpy as np

SHORT, WRONG = 0.1, 10.0  # s, degrees: an interruption below both does not count
LONG = 0.05  # s: a shorter flight is a hop
AT_REST = 1e-6  # MgR
ONSTEM = ("stem", "both")


@dataclass(frozen=True)
class Phase:
    """What is said of the run from t0 to t1 (s)."""

    kind: str
    t0: float
    t1: float


@dataclass(frozen=True, eq=False)
class Run:
    """The samples of a run, each (n,): t (s), tilt (degrees), spin (rev/s), support, regime and kinetic (MgR).

    a: the eccentricity; table: ordinary, rough or ice; supports: (from when, what carries it), exact, or () if only the
    samples tell; ended: why the run ended early, "" if it did not.
    """

    t: np.ndarray
    tilt: np.ndarray
    spin: np.ndarray
    support: np.ndarray
    regime: np.ndarray
    kinetic: np.ndarray
    a: float
    phases: tuple[Phase, ...]
    supports: tuple = ()
    ended: str = ""
    table: str = "ordinary"
    known: dict = field(default_factory=dict)

    @classmethod
    def told(cls, name, table):
        """The Run in one of the tables of app.model.tell."""
        samples = {name: np.asarray(values) for name, values in table["samples"].items()}
        names = "t", "tilt", "spin", "support", "regime", "kinetic"
        phases = tuple(Phase(one["kind"], float(one["from"]), float(one["to"])) for one in table["phases"])
        changes = tuple((float(since), what) for since, what in table.get("supports", ()))
        arrays = [samples[one] for one in names]
        return cls(*arrays, a=table["a"], phases=phases, supports=changes, ended=table["ended"], table=name)

    @property
    def start(self):
        """The time of the first sample."""
        return float(self.t[0])

    @property
    def end(self):
        """The time of the last sample."""
        return float(self.t[-1])

    @cached_property
    def step(self):
        """From one sample to the next, s."""
        return float(np.median(np.diff(self.t))) if len(self.t) > 1 else 0.0

    @property
    def slack(self):
        """By how much an end of a phase may differ: conditions on what is not a number change at a sample."""
        return 0.02 + 2 * self.step

    @property
    def high(self):
        """The high pole, degrees."""
        return 180.0 if self.a >= 0 else 0.0

    @property
    def fallen(self):
        """By how much it has fallen, degrees."""
        return np.abs(self.tilt - self.high)

    @cached_property
    def carried(self):
        """[(from, to, what)] of what carries it."""
        changes = [(self.start, self.support[0])]
        exact = self.supports or zip(self.t, self.support, strict=True)
        changes += [(since, what) for since, what in exact if since > self.start]
        ends = [since for since, _ in changes[1:]] + [self.end]
        spells = []
        for (since, what), to in zip(changes, ends, strict=True):
            if spells and spells[-1][2] == what:
                spells[-1] = (spells[-1][0], to, what)
            elif to >= since:
                spells.append((since, to, what))
        return spells

    @cached_property
    def loses(self):
        """Until when the tilt need not repeat itself: on the ordinary table until it begins to roll for good."""
        if self.table == "ice":
            return self.start
        (slips,) = np.nonzero(self.regime != "roll")
        return (
            max(float(self.t[min(slips[-1] + 1, len(self.t) - 1)]), self.carried[-1][0]) if len(slips) else self.start
        )

    def between(self, t0, t1):
        """Times and tilts from t0 to t1, both ends interpolated."""
        inside = (self.t > t0) & (self.t < t1)
        ends = np.interp([t0, t1], self.t, self.tilt)
        return np.r_[t0, self.t[inside], t1], np.r_[ends[0], self.tilt[inside], ends[1]]

    def inside(self, t0, t1):
        """Which samples lie from t0 to t1."""
        return (self.t >= t0) & (self.t <= t1)

    def mean(self, t0, t1):
        """The mean tilt from t0 to t1."""
        t, tilt = self.between(t0, t1)
        return float(np.trapezoid(tilt, t) / (t1 - t0)) if t1 > t0 else float(tilt[0])

    def running(self, t, t0, t1, clipped=False):
        """The mean tilt over the second around each t, of the piece from t0 to t1.

        clipped: at the ends of the piece the mean is over what is left of the second; otherwise the second is moved.
        """
        grid, tilt = self.between(t0, t1)
        below = np.r_[0.0, np.cumsum((tilt[1:] + tilt[:-1]) / 2 * np.diff(grid))]

        def integral(at):
            i = np.clip(np.searchsorted(grid, at, "right") - 1, 0, len(grid) - 2)
            h = at - grid[i]
            return below[i] + h * (tilt[i] + np.interp(at, grid, tilt)) / 2

        if t1 - t0 <= 1 and not clipped:
            return np.full(len(t), self.mean(t0, t1))
        middle = t if clipped else np.clip(t, t0 + 0.5, t1 - 0.5)
        since, to = np.maximum(middle - 0.5, t0), np.minimum(middle + 0.5, t1)
        return (integral(to) - integral(since)) / np.maximum(to - since, 1e-12)

    def swing(self, t, t0, t1, clipped=True):
        """The largest minus the least tilt within the second around each t, inside the piece from t0 to t1."""
        grid, tilt = self.between(t0, t1)
        middle = np.asarray(t) if clipped or t1 - t0 <= 1 else np.clip(t, t0 + 0.5, t1 - 0.5)
        first = np.searchsorted(grid, np.maximum(middle - 0.5, t0))
        last = np.searchsorted(grid, np.minimum(middle + 0.5, t1), "right")
        return np.array([np.ptp(tilt[i:k]) if k > i else 0.0 for i, k in zip(first, last, strict=True)])


def spells(t, excess):
    """[(from, to)] where a quantity, straight between its samples, is positive."""
    positive = excess > 0
    (changes,) = np.nonzero(positive[1:] != positive[:-1])
    at = [float(t[i] + (t[i + 1] - t[i]) * excess[i] / (excess[i] - excess[i + 1])) for i in changes]
    edges = [float(t[0])] * bool(positive[0]) + at + [float(t[-1])] * bool(positive[-1])
    return list(zip(edges[::2], edges[1::2], strict=True))


def lasting(t, excess):
    """The same, but an interruption shorter than SHORT in which it is wrong by less than WRONG does not count."""
    joined = []
    for since, to in spells(t, excess):
        gap = (t > joined[-1][1]) & (t < since) if joined else ()
        if joined and since - joined[-1][1] < SHORT and np.max(-excess[gap], initial=0) < WRONG:
            joined[-1] = (joined[-1][0], to)
        else:
            joined.append((since, to))
    return joined


def sampled(t, true):
    """[(from, to)] in whose samples, one after the other, something is true."""
    (rises,) = np.nonzero(np.diff(np.r_[False, true].astype(int)) == 1)
    (falls,) = np.nonzero(np.diff(np.r_[true, False].astype(int)) == -1)
    return [(float(t[i]), float(t[k])) for i, k in zip(rises, falls, strict=True)]


def legs(values, least):
    """[(i, k)]: from one turn to the next; a turn is an extreme from which it goes back by `least`."""
    turns, up, low, high = [], None, 0, 0
    for i, value in enumerate(values):
        low = i if value < values[low] else low
        high = i if value > values[high] else high
        if up is not True and value - values[low] >= least:
            turns, up, high = [*turns, low], True, i
        elif up is not False and values[high] - value >= least:
            turns, up, low = [*turns, high], False, i
    if up is not None:
        turns.append(high if up else low)
    return list(pairwise(turns))


def comings_back(tilt, least=5.0):
    """(fewest, most) times that the tilt comes back: whether a turn counts before which it went less than `least` in
    the other direction is left open."""
    found = legs(tilt, least)
    if not found:
        return 0, 0
    turns = len(found) - 1
    before = np.ptp(tilt[: found[0][0] + 1]) > 1e-9
    return turns, turns + bool(before)


def minus(wholes, parts):
    """What is left of intervals without others."""
    left = list(wholes)
    for p0, p1 in parts:
        left = [(s, e) for t0, t1 in left for s, e in ((t0, min(t1, p0)), (max(t0, p1), t1)) if e > s]
    return left
