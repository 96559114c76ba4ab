"""The well in which the top moves like a bead: V_J over theta, the least energy at its C_J (tippe_core/outcomes.py).

Each interval in which the stem does not touch has its own C_J, and so its own well.
"""

from dataclasses import dataclass
from itertools import groupby
from typing import NamedTuple

import numpy as np

from app.model.lab.event_list import SHORT
from app.model.run import TableMotion
from app.model.setup import Setup
from tippe_core import SteadyStates, Stretch, Top, jellett_potential, outcome, steady_states
from tippe_core.types import Array, Bools, Indices

POINTS = 361  # of a curve, a half degree apart
BEADS = 4000  # points of the bead's path, at most


class Interval(NamedTuple):
    """An interval in which only the ball touches: from start to end in (R/g)^1/2, its C_J, and the steady states for
    that."""

    start: float
    end: float
    C_J: float
    steady: SteadyStates


@dataclass(frozen=True, eq=False, kw_only=True)
class Well:
    """V_J of one Interval over theta (n,). low, high: the range of V_J to be shown, which includes the bead's energies.
    places (k,): the tilts of the steady states, heights (k,): their V_J; stable (k,)."""

    theta: Array
    V: Array
    low: float
    high: float
    places: Array
    heights: Array
    stable: Bools


class Path(NamedTuple):
    """The path of the bead: at t (n,) its tilt theta, the height V of the well there, and V plus the energy that it has
    left, E; which: the index of the present well, -1 while a stem touches.

    Pivoting changes C_J a little within an Interval, whose well is that of the median C_J. The energy left is that
    above V_J for the present C_J, so it is never negative.
    """

    t: Array
    theta: Array
    V: Array
    E: Array
    which: Indices


NONE = np.zeros(0)
NOWHERE = Path(NONE, NONE, NONE, NONE, np.zeros(0, int))


def intervals(motion: TableMotion | None, start: Setup) -> tuple[Interval, ...]:
    """The Intervals of a motion that are longer than SHORT, because a second contact changes C_J; if there is none, one
    with the C_J of the start."""
    shortest, first = SHORT / start.scales.time, outcome(start.top, start.state)
    at_first = first.C_J, first.steady
    if motion is None:
        return (Interval(0.0, 0.0, *at_first),)
    moved = motion.trajectory
    found: list[Interval] = []
    spells = motion.ending.stretches if motion.ending else (Stretch(moved.t[0], moved.t[-1], "ball"),)
    for free, group in groupby(spells, key=lambda spell: spell.on in ("ball", "air")):
        group = list(group)
        begin, end = group[0].start, group[-1].end
        inside = (moved.t >= begin) & (moved.t <= end)
        if free and inside.any() and (end - begin > shortest or not found):
            C_J = float(np.median(moved.jellett[inside]))
            found.append(Interval(begin, end, C_J, steady_states(moved.top, C_J)))
    return tuple(found) or (Interval(-1.0, -1.0, *at_first),)


def path(motion: TableMotion | None, found: tuple[Interval, ...]) -> Path:
    if motion is None:
        return NOWHERE
    moved = motion.trajectory
    every = np.unique(np.linspace(0, len(moved.t) - 1, BEADS).astype(int))
    t, theta = moved.t[every], moved.theta[every]
    V, which = np.zeros(len(t)), np.full(len(t), -1)
    for k, one in enumerate(found):
        inside = (t >= one.start) & (t <= one.end)
        V[inside], which[inside] = jellett_potential(theta[inside], moved.top, one.C_J), k
    left = moved.energy[every] - jellett_potential(theta, moved.top, moved.jellett[every])
    return Path(t, theta, V, V + np.maximum(left, 0.0), which)  # may be negative in its last digit


def well(top: Top, one: Interval, E: Array) -> Well:
    """E: the energies of the bead in it, beginning with that at the start."""
    theta = np.linspace(0, np.pi, POINTS)
    V = jellett_potential(theta, top, one.C_J)
    low, high = float(V.min()), max(float(np.min([V.max(), 4 * np.median(V)])), *E[:1], E.max(initial=-np.inf))
    return Well(theta=theta, V=V, low=low, high=high, places=one.steady.theta,
                heights=jellett_potential(one.steady.theta, top, one.C_J), stable=one.steady.stable)  # fmt: skip


def wells(motion: TableMotion | None, start: Setup) -> tuple[tuple[Well, ...], Path]:
    """The wells of a motion from this start, and the path of the bead through them."""
    found = intervals(motion, start)
    bead = path(motion, found)
    return tuple(well(start.top, one, bead.E[bead.which == k]) for k, one in enumerate(found)), bead
