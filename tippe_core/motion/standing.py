"""Standing flat on the end of the stem: when nothing can tip the top any more, and what happens when the flat end comes
down.

The end is a circle of radius b at the distance H = a + h from G, rounded with the radius q. If the top leans by
alpha = pi - theta on a point of the rim, G is at the height H cos(alpha) + b sin(alpha) + q. That is largest when G is
vertically above the point, tan(alpha) = b/H, unless the ball touches the table first.

Friction only dissipates. So once the total energy above that of rest on the flat end is less than G needs to get
over the rim, nothing can tip the top any more: it stands. The energy of the spin has to be included, because friction
at a point of the rim converts it into tilt, as it does on the ball: from 1e-3 rad, at rest except for a spin of 6
(g/R)^1/2, the paper's top leans on its rim by 0.09 rad after 2 (R/g)^1/2, for any friction law.

Near the flat position the contact runs around the rim, and the motion is integrated through that. If it passes within
FLAT, as when a top rocks in a plane, the far side of the rim comes down at once. That is a plastic impact at the
opposite point, on which the top then leans equally far to the other side. If its remaining motion is too slow to take
it beyond FLAT again, it lies on the whole rim, whatever its spin, which friction along the rim only slows. So a top
that starts flat on the end with nothing but a spin stands, although from a lean of 1e-4 rad the same spin makes it
rock.
"""

import numpy as np

from ..compiled import compiled
from ..types import Array, Number, Rim, Vector
from . import at
from .dynamics import kinetic

STANDS, FLAT = 1e-3, 1e-6  # rad: tilts that count as upright, and as flat
ROUNDING = 1e-13  # larger than sin(pi) in floats


@compiled
def tipping_energy(top: Number, edge: Rim) -> float:
    """The height (R) by which G must rise from rest on the flat end for the top to tip over the rim, or onto its
    ball."""
    b, h, q = edge
    H = top.a + h
    onto_ball = np.arctan2(b, h) + np.arccos(min(1.0, (1 - q) / np.hypot(b, h)))  # h cos(alpha) + b sin(alpha) = 1 - q
    alpha = min(np.arctan2(b, H), onto_ball)
    return H * (np.cos(alpha) - 1) + b * np.sin(alpha)


@compiled
def energy_above_rest(top: Number, edge: Rim, y: Array, L3: float) -> float:
    """The energy at y above that of rest on the flat end of the stem, in MgR."""
    return kinetic(y, L3, top) + y[at.Z] - (top.a + edge[1] + edge[2])


def leaning(e: Vector, w: Vector) -> tuple[float, float]:
    """sin(theta) and its rate."""
    s = np.sqrt(e[0] * e[0] + e[1] * e[1])
    rate = e[0] * (w[1] * e[2] - w[2] * e[1]) + e[1] * (w[2] * e[0] - w[0] * e[2])
    return s, (rate / s if s > 0.0 else 0.0)


def lies(top: Number, edge: Rim, e: Vector, w: Vector) -> bool:
    """Whether e' is too slow to tilt it beyond FLAT: 1/2 (I1 + H^2 + b^2) e'^2 < b FLAT, pivoting on the rim."""
    b, h, _ = edge
    square = (w[1] * e[2] - w[2] * e[1]) ** 2 + (w[2] * e[0] - w[0] * e[2]) ** 2
    return (top.I1 + (top.a + h) ** 2 + b * b) * square < 2 * b * FLAT


@compiled
def crossed(y: Array, e: Vector) -> Array:
    """y leaning equally far to the other side, with G at the same height."""
    return rotated(y, -e[1], e[0], -e[2])  # rotated by 2 alpha about z cross e


def leaned(y: Array, e: Vector, w: Vector) -> Array:
    """For a start flat on the end: y with a minimal lean in the direction of its tilting, or of its sliding. Any other
    y is returned as it is."""
    tiny, (s, rate) = FLAT / 1000, leaning(e, w)
    if e[2] > 0 or s > FLAT or (rate >= 0 and s > tiny):
        return y.copy()
    if s > tiny:
        return crossed(y, e)
    wx, wy = w[0], w[1]
    if np.hypot(wx, wy) <= ROUNDING * np.sqrt(wx * wx + wy * wy + w[2] * w[2]):
        wx, wy = (-y[at.VY], y[at.VX]) if np.hypot(y[at.VX], y[at.VY]) > ROUNDING else (1.0, 0.0)
    moves = np.hypot(wx, wy)
    return rotated(y, tiny / 2 * wx / moves, tiny / 2 * wy / moves, 1.0)


def rotated(y: Array, i: float, j: float, w: float) -> Array:
    """y rotated by the quaternion (i, j, 0, w)."""
    px, py, pz, pw = y[at.PX], y[at.PY], y[at.PZ], y[at.PW]
    y = y.copy()
    y[at.PX], y[at.PY] = w * px + i * pw + j * pz, w * py - i * pz + j * pw
    y[at.PZ], y[at.PW] = w * pz + i * py - j * px, w * pw - i * px - j * py
    return y
