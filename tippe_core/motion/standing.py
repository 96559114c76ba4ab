"""Standing flat on the stem's end: when nothing can tip it any more, and what happens where its flat end comes down.

The end is a circle of radius b, H = a + h from G, rounded by a ball of radius q. Leaning by alpha = pi - theta on a
point of its rim G is H cos(alpha) + b sin(alpha) + q high, most where it is straight above that point,
tan(alpha) = b/H, unless the ball comes to the table before that.

Friction takes energy and never gives any. So with less energy above flat rest than G needs for that, all of the motion
counted, nothing tips the top over its rim any more: it stands. The energy of the spin counts too, for friction at a
point of the rim turns it into tilt as it does on the ball: from 1e-3 rad, at rest but for a spin of 6 (g/R)^1/2, the
paper's top leans on its rim by 0.09 rad after 2 (R/g)^1/2, whichever the law.

Passing its flat position the contact runs round the rim, and so the motion is followed. Where it passes within FLAT,
as a top that rocks in a plane does, the far side of the rim comes down at once: an impact like any other here, plastic,
at the opposite point, on which the top then leans as much to the other side. What is left of its leaning may be too
little to take it beyond FLAT again: then it lies on all of its rim, whatever its spin, which that rim only slows. So a
start flat on the end with nothing but a spin stands, though from a lean of 1e-4 rad the same spin rocks it.
"""

import numpy as np

from ..compiled import compiled
from ..types import Array, Number, Rim, Vector
from .dynamics import kinetic

STANDS, FLAT = 1e-3, 1e-6  # rad: what counts as upright; what counts as flat
ROUNDING = 1e-13  # what is left of nothing by sin(pi)


@compiled
def tipping_energy(top: Number, edge: Rim) -> float:
    """What G must rise from flat on the stem's end for the top to tip over its rim, or onto its ball."""
    b, h, q = edge
    H = top.a + h
    onto_ball = np.arctan2(b, h) + np.arccos(min(1.0, (1 - q) / np.hypot(b, h)))  # h cos(alpha) + b sin(alpha) = 1 - q
    alpha = min(np.arctan2(b, H), onto_ball)
    return H * (np.cos(alpha) - 1) + b * np.sin(alpha)


@compiled
def energy_above_rest(top: Number, edge: Rim, y: Array, L3: float) -> float:
    """The energy at y above that of rest, flat on the stem's end."""
    return kinetic(y, L3, top) + y[15] - (top.a + edge[1] + edge[2])


@compiled
def leaning(e: Vector, w: Vector) -> tuple[float, float]:
    """sin(theta) and its rate."""
    s = np.sqrt(e[0] * e[0] + e[1] * e[1])
    rate = e[0] * (w[1] * e[2] - w[2] * e[1]) + e[1] * (w[2] * e[0] - w[0] * e[2])
    return s, (rate / s if s > 0.0 else 0.0)


@compiled
def lies(top: Number, edge: Rim, e: Vector, w: Vector) -> bool:
    """Whether e' takes it no further than FLAT from flat: 1/2 (I1 + H^2 + b^2) e'^2 < b FLAT, on a rim that holds."""
    b, h, _ = edge
    square = (w[1] * e[2] - w[2] * e[1]) ** 2 + (w[2] * e[0] - w[0] * e[2]) ** 2
    return (top.I1 + (top.a + h) ** 2 + b * b) * square < 2 * b * FLAT


@compiled
def crossed(y: Array, e: Vector) -> Array:
    """y leaning as much to the other side, G as high."""
    return turned(y, -e[1], e[0], -e[2])  # by 2 alpha about z cross e


@compiled
def leaned(y: Array, e: Vector, w: Vector) -> Array:
    """y of a start flat on the end, leaning to where it turns, or else slides; of any other as it is."""
    tiny, (s, rate) = FLAT / 1000, leaning(e, w)
    if e[2] > 0 or s > FLAT or (rate >= 0 and s > tiny):
        return y.copy()
    if s > tiny:
        return crossed(y, e)
    wx, wy = w[0], w[1]
    if np.hypot(wx, wy) <= ROUNDING * np.sqrt(wx * wx + wy * wy + w[2] * w[2]):
        wx, wy = (-y[9], y[8]) if np.hypot(y[8], y[9]) > ROUNDING else (1.0, 0.0)
    moves = np.hypot(wx, wy)
    return turned(y, tiny / 2 * wx / moves, tiny / 2 * wy / moves, 1.0)


@compiled
def turned(y: Array, i: float, j: float, w: float) -> Array:
    """y turned by the quaternion (i, j, 0, w)."""
    px, py, pz, pw = y[0], y[1], y[2], y[3]
    y = y.copy()
    y[0], y[1] = w * px + i * pw + j * pz, w * py - i * pz + j * pw
    y[2], y[3] = w * pz + i * py - j * px, w * pw - i * px - j * py
    return y
