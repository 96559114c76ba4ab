"""The well in which the top moves like a bead: V_J over theta, the least energy at its C_J (tippe_core/outcomes.py).

Each interval in which the stem does not touch has its own C_J, and so its own well.
"""

from dataclasses import dataclass
from itertools import groupby
from typing import NamedTuple

import numpy as np

from app.model.planes.picture import PLANES, SHORT, Motion, Picture
from tippe_core import SteadyStates, Stretch, Top, jellett_potential, steady_states
from tippe_core.types import Array, Bools, Indices

POINTS = 361  # of a curve, a half degree apart
BEADS = 4000  # of the path of the bead, at most


class While(NamedTuple):
    """In which the ball alone was at the table: start to end in (R/g)^1/2, C_J, and the steady states at it."""

    start: float
    end: float
    C_J: float
    steady: SteadyStates


@dataclass(frozen=True, eq=False, kw_only=True)
class Well:
    """V_J of one While over theta (n,). low, high: what of V_J is worth showing, with the energies that the bead has
    in it. places (k,): the steady states, at the heights (k,); stable (k,)."""

    theta: Array
    V: Array
    low: float
    high: float
    places: Array
    heights: Array
    stable: Bools


class Path(NamedTuple):
    """Where the bead is: theta, the height V of the well there and up to E what energy it has left, at t (n,). which:
    the place of the well among the wells, -1 while a stem touches.

    Pivoting changes C_J a little within a While, whose well is that of the middle one: what is left is what it has over
    V_J of its own C_J then, which is never less than none.
    """

    t: Array
    theta: Array
    V: Array
    E: Array
    which: Indices


NONE = np.zeros(0)
NOWHERE = Path(NONE, NONE, NONE, NONE, np.zeros(0, int))


def whiles(picture: Picture, plane: str) -> tuple[While, ...]:
    """Of the motion on a plane, each of more than SHORT: a second contact changes C_J. Of none, that of the start."""
    motion, shortest = picture.motions[plane], SHORT / picture.settings.scales.time
    at_first = picture.outcome.C_J, picture.outcome.steady
    if motion is None:
        return (While(0.0, 0.0, *at_first),)
    moved = motion.trajectory
    found: list[While] = []
    spells = motion.ending.stretches if motion.ending else (Stretch(moved.t[0], moved.t[-1], "ball"),)
    for free, group in groupby(spells, key=lambda spell: spell.on in ("ball", "air")):
        group = list(group)
        start, end = group[0].start, group[-1].end
        inside = (moved.t >= start) & (moved.t <= end)
        if free and inside.any() and (end - start > shortest or not found):
            C_J = float(np.median(moved.jellett[inside]))
            found.append(While(start, end, C_J, steady_states(moved.top, C_J)))
    return tuple(found) or (While(-1.0, -1.0, *at_first),)


def path(motion: Motion | None, found: tuple[While, ...]) -> Path:
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
    return Path(t, theta, V, V + np.maximum(left, 0.0), which)  # its last digit may be below


def well(top: Top, one: While, E: Array) -> Well:
    """E: the energies that the bead has in it, the first of them at its start."""
    theta = np.linspace(0, np.pi, POINTS)
    V = jellett_potential(theta, top, one.C_J)
    low, high = float(V.min()), max(float(np.min([V.max(), 4 * np.median(V)])), *E[:1], E.max(initial=-np.inf))
    return Well(theta=theta, V=V, low=low, high=high, places=one.steady.theta,
                heights=jellett_potential(one.steady.theta, top, one.C_J), stable=one.steady.stable)  # fmt: skip


def wells(picture: Picture, plane: str) -> tuple[tuple[Well, ...], Path]:
    """Those of a plane, the sliding one where it is none of them, and the bead's path through them."""
    plane = plane if plane in PLANES else "sliding"
    motion, found = picture.motions[plane], whiles(picture, plane)
    bead = path(motion, found)
    return tuple(well(picture.settings.top, one, bead.E[bead.which == k]) for k, one in enumerate(found)), bead
