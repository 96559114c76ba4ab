"""Rolling on the ball as a part of a motion with friction, by the exact motion of rolling.py."""

from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from typing import NamedTuple, Self, cast

import numpy as np

from ..paper.constants import versines
from ..paper.top import Top
from ..types import Array
from . import at, events, preparing
from .contacts import SLACK, TOUCH, tilt_guards
from .kinds import RIM, SLIPS, TOUCHES, Event
from .poses import ROLLING
from .records import BALL, SAMPLE, STEM, Record
from .rolling import Rolling
from .smooth import first_below, zeros

MOST_NOTES = 10_000


class RollingPart(NamedTuple):
    """A part of a motion that rolls on the ball alone, from one time until an event at another.

    heat: what was lost before; notes: what is noted in its first period, (the time since it begins, the name).
    """

    rolling: Rolling
    begins: float
    ends: float
    event: Event
    heat: float
    notes: list[tuple[float, int]]

    @classmethod
    def of(cls, top: Top, W: Record, P: Record) -> Self:
        """The part that begins at W.y."""
        rolling, begins = Rolling(top, None, replace(preparing.state_of(W, P), vx=None, vy=None)), float(W.y[at.TIME])
        ends, event = _ends(rolling, P)
        notes = _noted(rolling, min(rolling.period, ends))
        return cls(rolling, begins, begins + ends, event, float(W.y[at.HEAT]), notes)

    def fill(self, times: Array, rows: Array) -> None:
        """Computes the rows at the times (n,)."""
        moved = self.rolling(np.append(self.begins, times))
        for name in SAMPLE.names:
            rows[name] = {"heat": self.heat, "regime": ROLLING}.get(name, getattr(moved, name)[1:])

    def noted(self, since: float, until: float) -> Iterator[tuple[float, int]]:
        """What is noted between two times: when, and its name."""
        for first, name in self.notes:
            times = self.begins + np.arange(first, until - self.begins, self.rolling.period)[:MOST_NOTES]
            yield from ((float(t), name) for t in times[times >= since])

    def end(self, W: Record, P: Record) -> None:
        """Sets W.y to the end of this part."""
        one = self.rolling(np.array([0.0, self.ends - self.begins]))
        theta, turn = one.theta[1], np.exp(1j * one.phi[1])
        v, m = versines(theta)
        u = complex(one.velocity[1, 0], one.velocity[1, 1]) * turn
        W.y[:] = preparing.y_of(P, theta, (v / 2) ** 0.5, float(m / 2) ** 0.5, turn, one.phi[1] + one.psi[1],
                                one.omega[1], u, complex(*one.com[1, :2]), self.ends, self.heat)  # fmt: skip
        W.angles[:] = 0.0, one.phi[1]
        preparing.on_table(W, P, BALL)


def _ends(rolling: Rolling, P: Record) -> tuple[float, Event]:
    """When the ball ceases to roll alone, inf if never, and by which event."""
    theta = rolling.start.theta
    floor = min(preparing.gap(P, np.cos(theta), np.sin(theta)), 0.0)

    def margin(t: Array) -> Array:
        F = rolling(np.append(0.0, t)).force[1:].T
        return P.law.mu_s * F[2] - np.hypot(F[0], F[1]) + SLACK

    def room_left(t: Array) -> Array:
        theta = rolling.theta(t)
        return TOUCH - floor + preparing.gap(P, np.cos(theta), np.sin(theta))

    found: list[tuple[float, Event]] = [(first_below(margin, rolling.period), (SLIPS, BALL))]
    if P.stem:
        found.append((first_below(room_left, rolling.period), (TOUCHES, STEM)))
    for n, least in enumerate(tilt_guards(np.cos(rolling.turning_points), P)):
        if min(least) < 0:
            tilts = partial(lambda t, n: tilt_guards(np.cos(rolling.theta(t)), P)[n], n=n)
            found.append((first_below(tilts, rolling.period), (RIM + n, BALL)))
    return min(found)


def _noted(rolling: Rolling, until: float) -> list[tuple[float, int]]:
    """The times since the start, up to `until`, and the names of what is noted while it rolls."""

    def value(t: Array, n: int) -> Array:
        moved = rolling(np.append(0.0, t))
        up, up_rate = np.cos(moved.theta), -np.sin(moved.theta) * moved.omega[:, 0]
        return cast(Array, events.noted_values(up[1:], up_rate[1:])[n])

    return [(float(t), int(name)) for n, name in enumerate(events.NOTED) for t in zeros(partial(value, n=n), until)]
