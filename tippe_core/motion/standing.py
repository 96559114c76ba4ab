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

from collections.abc import Sequence
from math import acos, atan2, cos, hypot, sin, sqrt

from ..paper.top import Top
from ..types import Array, Rim, Vector

STANDS, FLAT = 1e-3, 1e-6  # rad: what counts as upright; what counts as flat
ROUNDING = 1e-13  # what is left of nothing by sin(pi)


def tipping_energy(top: Top, edge: Rim) -> float:
    """What G must rise from flat on the stem's end for the top to tip over its rim, or onto its ball."""
    b, h, q = edge
    H = top.a + h
    onto_ball = atan2(b, h) + acos(min(1.0, (1 - q) / hypot(b, h)))  # h cos(alpha) + b sin(alpha) = 1 - q
    alpha = min(atan2(b, H), onto_ball)
    return H * (cos(alpha) - 1) + b * sin(alpha)


def energy_above_rest(top: Top, edge: Rim, y: Sequence[float] | Array, L3: float) -> float:
    """The energy at y (16) above that of rest, flat on the stem's end."""
    L_squared, v_squared = y[5] * y[5] + y[6] * y[6] + y[7] * y[7], y[8] * y[8] + y[9] * y[9] + y[14] * y[14]
    kinetic = (L_squared / top.I1 + (1 / top.I3 - 1 / top.I1) * L3 * L3 + v_squared) / 2
    return kinetic + y[15] - (top.a + edge[1] + edge[2])


def leaning(e: Vector, w: Vector) -> tuple[float, float]:
    """sin(theta) and its rate."""
    (ex, ey, ez), (wx, wy, wz) = e, w
    s = sqrt(ex * ex + ey * ey)
    return s, (ex * (wy * ez - wz * ey) + ey * (wz * ex - wx * ez)) / s


def lies(top: Top, edge: Rim, e: Vector, w: Vector) -> bool:
    """Whether e' takes it no further than FLAT from flat: 1/2 (I1 + H^2 + b^2) e'^2 < b FLAT, on a rim that holds."""
    b, h, _ = edge
    (ex, ey, ez), (wx, wy, wz) = e, w
    square = (wy * ez - wz * ey) ** 2 + (wz * ex - wx * ez) ** 2
    return (top.I1 + (top.a + h) ** 2 + b * b) * square < 2 * b * FLAT


def crossed(y: Array, e: Vector) -> Array:
    """y (16) leaning as much to the other side, G as high."""
    return _turned(y, -e[1], e[0], -e[2])  # by 2 alpha about z cross e


def leaned(y: Array, e: Vector, w: Vector) -> Array:
    """y (16) of a start flat on the end, leaning to where it turns, or else slides; of any other as it is."""
    (wx, wy, _), tiny = w, FLAT / 1000
    s, rate = leaning(e, w)
    if e[2] > 0 or s > FLAT or (rate >= 0 and s > tiny):
        return y
    if s > tiny:
        return crossed(y, e)
    if hypot(wx, wy) <= ROUNDING * hypot(*w):
        wx, wy = (-y[9], y[8]) if hypot(y[8], y[9]) > ROUNDING else (1.0, 0.0)
    moves = hypot(wx, wy)
    return _turned(y, tiny / 2 * wx / moves, tiny / 2 * wy / moves, 1.0)


def _turned(y: Array, i: float, j: float, w: float) -> Array:
    """y turned by the quaternion (i, j, 0, w)."""
    px, py, pz, pw = y[:4]
    y = y.copy()
    y[:4] = w * px + i * pw + j * pz, w * py - i * pz + j * pw, w * pz + i * py - j * px, w * pw - i * px - j * py
    return y
