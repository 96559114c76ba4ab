"""How much of the (K_J, theta) plane friction leaves a top, for thousands of tops a second: Fig. 6 on a bare grid.

At one theta everything is a polynomial in the bracket B of (36), with coefficients that K_J does not enter:

    U = height + g B^2 ,    F_z and F_y at theta_dot = 0 quadratic in B ,
    the 2E' at which F_z = 0 quadratic in B ,    the one at which F_h = mu_s F_z: Q(B) - (W(B))^1/2, Q and W quadratic

(from tielines.py, whose notes these are). So a top is some forty passes over an array of K_J by theta that
stays in the processor's cache. Between the points of the grid, limits and turning points are placed by cubics. Wells
narrower than a few points get a grid of their own, and rows with several wells are left to tielines() itself.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..errors import TopError, finite
from ..types import Array, Bools, Indices, Number
from .equations import AnyTop, f2_2, f3_2
from .tielines import _distance, _mapped, _place, figures
from .top import Top
from .top import TopNumbers as ExactTop

ROWS, COLUMNS = 64, 256  # K_J, theta
BLOCK = 32  # tops whose coefficients are made together
NARROW, CLOSE, AROUND = 10, 24, 1.25  # a well of fewer points gets so many, over so many times its half-width
PASSES, CHUNK = 4, 256  # at most; so many rows of such wells at a time
PART = (np.arange(ROWS) + 0.5) / ROWS  # of K_J(P)
THETA = _mapped(np.arange(COLUMNS + 0.0) + 0.5)  # between the points of tielines' own grid: without the poles
_CUBIC = np.linalg.inv(np.arange(4.0)[:, None] ** np.arange(4))  # values at 0, 1, 2, 3 to coefficients


class _Coefficients(NamedTuple):
    """Of arrays of theta: sin^2; beta = K_J - B; U; F_z; F_y; the end by F_z; that by friction, Q, W and its sign."""

    s2: Array
    beta: Array
    U0: Array
    U2: Array
    z0: Array
    z1: Array
    z2: Array
    y0: Array
    y1: Array
    y2: Array
    l0: Array
    l1: Array
    l2: Array
    q0: Array
    q1: Array
    q2: Array
    w0: Array
    w1: Array
    w2: Array
    sign: Array


def allowed_shares(a: ArrayLike, I1: ArrayLike, I3: ArrayLike, K_R: float, mu_s: float) -> Array:
    """The share, 0 to 1, of Fig. 5's region of the (K_J, theta) plane, K_J from 0 to P, that friction leaves.

    The sum of the widths in theta of 64 tielines under F_h <= mu_s F_z, over the same under F_z >= 0 alone; a tieline
    of no motion is 0 wide, one that nothing limits is pi wide. a, I1, I3 numbers or arrays that broadcast together, K_R
    and mu_s numbers; nan where there is no such Top, or where Fig. 5's region is empty.
    """
    K_R, mu_s = finite("K_R", K_R), finite("mu_s", mu_s)
    if mu_s < 0:
        raise TopError("mu_s", mu_s, "mu_s >= 0")
    a, I1, I3 = np.broadcast_arrays(*(np.asarray(value, dtype=float) for value in (a, I1, I3)))
    with np.errstate(all="ignore"):
        there = np.isfinite(a) & np.isfinite(I1) & np.isfinite(I3) & (a < 1) & (I1 > 0) & (I3 > 0) & (I3 <= 2 * I1)
        share = np.full(a.shape, np.nan)
        tops = np.array([a[there], I1[there], I3[there]])
        for i in range(0, tops.shape[1], BLOCK):
            some = tops[:, i : i + BLOCK, None]
            lift, slip = _widths(some[0], some[1], some[2], K_R, mu_s).sum(axis=2)
            tops[0, i : i + BLOCK] = slip / lift
    share[there] = tops[0]
    return share


def _coefficients(theta: Array, top: AnyTop, K_R: float, mu: float) -> _Coefficients:
    p = _place(*_distance(theta, np.pi - theta), top, K_R)
    c, s, s2 = np.cos(theta), np.sin(theta), p.s2
    z1, A1 = mu * p.z1, p.A1
    # F_h^2 = (e2 B^2 + e1 B + e0) + 2 (a1 B + a0) q + h2 q^2
    h2, a1, a0 = s2 * A1**2, A1 * p.Y, p.X2 / 2 + s2 * p.A0 * A1
    e2, e1, e0 = p.D, 2 * p.A0 * p.Y, s2 * p.A0**2 - 1e-300
    m1, m0 = mu * p.zb, mu * p.zc
    P2, b1, b0 = z1**2 - h2, a1 - m1 * z1, a0 - m0 * z1
    # r^2 = b^2 - P2 P0, less what cancels: (h1 - 2u) h1 + P2 F_h^2(q = 0) + h2 F_z(q = 0)^2
    r2 = a1 * (a1 - 2 * m1 * z1) + e2 * P2 + h2 * m1**2
    r1 = 2 * a1 * a0 - 2 * z1 * (a1 * m0 + a0 * m1) + e1 * P2 + 2 * h2 * m1 * m0
    r0 = a0 * (a0 - 2 * m0 * z1) + e0 * P2 + h2 * m0**2
    unit = p.f1 / P2
    return _Coefficients(
        s2=s2 + 0 * p.f1, beta=top.I3 / top.I1 * (c - top.a) * K_R / np.sqrt(f3_2(c, s2, top)),
        U0=p.height, U2=f2_2(c, s2, top) / s2,
        z0=p.zc, z1=p.zb, z2=p.z1 / s2, y0=s * p.A0, y1=p.Y / s, y2=A1 / s,
        l0=p.height - p.f1 * p.zc / p.z1, l1=-p.f1 * p.zb / p.z1, l2=-p.drop + 0 * p.f1,
        q0=p.height + unit * b0, q1=unit * b1, q2=-p.drop + 0 * unit,
        w0=r0 * unit**2, w1=r1 * unit**2, w2=r2 * unit**2, sign=np.sign(unit))  # fmt: skip


def _widths(a: Array, I1: Array, I3: Array, K_R: float, mu: float) -> Array:
    """Widths in theta of the tielines of tops of (n, 1) a, I1, I3, (2, n, ROWS): of Fig. 5, of Fig. 6."""
    n = len(a)
    k = _coefficients(THETA, ExactTop(a, I1, I3), K_R, mu)
    K_J = PART * (I3 / I1 * (1 - a) * K_R / np.sqrt(f3_2(1.0, 0.0, ExactTop(a, I1, I3))))
    places, several, buffers = np.empty((2, 2, n, ROWS)), np.empty((n, ROWS), dtype=bool), np.empty((8, ROWS, COLUMNS))
    for i in range(n):
        places[:, :, i], several[i] = _sweep(_Coefficients(*(column[i] for column in k)), K_J[i], mu, buffers)
    theta = _mapped(np.clip(places + 0.5, 0, COLUMNS))
    width = theta[:, 1] - theta[:, 0]
    # closer, and closer, where the well has few points
    middle, points = theta[0].mean(axis=0), places[0, 1] - places[0, 0]
    half = AROUND / 2 * width[0]
    step = np.gradient(THETA)[np.searchsorted(THETA, middle).clip(0, COLUMNS - 1)]
    rows = np.flatnonzero(points < NARROW)
    middle, half, step, K = (value.ravel() for value in (middle, half, step, K_J))
    flat = width.reshape(2, -1)
    for _ in range(PASSES):
        half[rows] = np.maximum(half[rows], step[rows] / 2)
        for some in np.split(rows, range(CHUNK, len(rows), CHUNK)):
            step[some] = 2 * half[some] / (CLOSE - 1)
            close = middle[some, None] - half[some, None] + step[some, None] * np.arange(CLOSE)
            top = ExactTop(*(value[some // ROWS] for value in (a, I1, I3)))
            found, _ = _sweep(_coefficients(close, top, K_R, mu), K[some], mu, np.empty((8, len(some), CLOSE)))
            found = np.clip(found, 0, CLOSE - 1)
            flat[:, some] = (found[:, 1] - found[:, 0]) * step[some]
            middle[some] += (found[0].mean(axis=0) - (CLOSE - 1) / 2) * step[some]
            points.ravel()[some] = found[0, 1] - found[0, 0]
        half[rows] = AROUND / 2 * flat[0, rows]
        rows = rows[points.ravel()[rows] < NARROW]
        if not rows.size:
            break
    for i in np.flatnonzero(several.any(axis=1)):
        at = several[i]
        for which, limit in enumerate(figures(Top(a[i, 0], I1[i, 0], I3[i, 0]), K_J[i, at], K_R, mu)):
            width[which, i, at] = limit.theta_outer - limit.theta_inner
    return np.nan_to_num(width)


def _sweep(k: _Coefficients, K_J: Array, mu: float, buffers: Array) -> tuple[Array, Bools]:
    """Places of the turning points on the grid of k's columns (limits, sides, rows), the first point 0: one where
    there is no motion, infinite where nothing limits it; and in which rows U has several minima."""
    B, U, scratch, F_z, F_y, margin, end_z, end_h = buffers
    columns, here = U.shape[1], np.arange(len(U))
    row = here * columns

    def quadratic(c2: Array, c1: Array, c0: Array, out: Array) -> Array:
        np.multiply(B, c2, out=out)
        out += c1
        out *= B
        out += c0
        return out

    np.subtract(K_J[:, None], k.beta, out=B)
    np.multiply(B, B, out=U)
    U *= k.U2
    U += k.U0
    lowest = U.argmin(axis=1)
    falls = U[:, 1:] < U[:, :-1]
    several = (falls[:, 1:] & ~falls[:, :-1]).any(axis=1)
    quadratic(k.z2, k.z1, k.z0, F_z)
    np.abs(quadratic(k.y2, k.y1, k.y0, F_y), out=scratch)
    np.multiply(F_z, mu, out=margin)
    margin -= scratch
    quadratic(k.l2, k.l1, k.l0, end_z)
    np.sqrt(quadratic(k.w2, k.w1, k.w0, scratch), out=scratch)
    scratch *= k.sign
    quadratic(k.q2, k.q1, k.q0, end_h)
    end_h -= scratch

    def stencil(at: Indices) -> tuple[Indices, Indices, Indices]:
        """First of the four points around cells `at`, flat indices (4, ...), where the cells begin among the four."""
        start = np.clip(at - 1, 0, columns - 4)
        return start, row + start + np.arange(4).reshape(-1, *[1] * at.ndim), np.clip(at - start, 0, 2)

    def s2(index: Indices) -> Array:
        return k.s2.take(index if k.s2.ndim == 2 else index - row)

    # within the trajectory: the vertex of a parabola through three points of the limit
    inside, sides, broken = [], [], []
    near = np.clip(lowest, 1, columns - 2)
    three = [U[here, near + step] for step in (-1, 0, 1)]
    well, steady = _vertex(*three)
    outside = np.arange(columns) > (near + steady)[:, None]
    for left, end in ((F_z, end_z), (margin, end_h)):
        over = left < 0
        broken.append(over)
        np.copyto(scratch, end)
        np.copyto(scratch, np.inf, where=over | ~(end >= U))
        j = scratch.argmin(axis=1)
        i = np.clip(j, 1, columns - 2)
        vertex, t = _vertex(*(end[here, i + step] for step in (-1, 0, 1)))
        good = (np.abs(t) <= 1) & (vertex >= _parabola(t, *(U[here, i + step] for step in (-1, 0, 1))))
        inside.append(np.fmin(scratch[here, j], np.where(good, vertex, np.inf)))
        masks = over & ~outside, over & outside
        sides.append([[columns - 1 - masks[0][:, ::-1].argmax(axis=1), masks[1].argmax(axis=1) - 1],
                      [mask.any(axis=1) for mask in masks]])  # fmt: skip
    # at a turning point: where the margin is zero
    cells, some = np.array([side[0] for side in sides]), np.array([side[1] for side in sides])
    start, flat, low = stencil(cells)
    weight = s2(flat)
    # F_y with the sign it has where the limit is broken: its size has a corner of its own
    sign = np.sign(F_y.take(row + np.clip(cells[1] + [[0], [1]], 0, columns - 1)))
    left = np.stack([F_z.take(flat[:, 0]), mu * F_z.take(flat[:, 1]) - sign * F_y.take(flat[:, 1])], axis=1)
    t = _root(weight * left, low)
    corner = _value(_cubic(weight * U.take(flat)), t) / _value(_cubic(weight), t)
    ends = np.fmin(inside, np.where(some, corner, np.inf).min(axis=1))
    normal, across = (_parabola(steady, *(F[here, near + step] for step in (-1, 0, 1))) for F in (F_z, F_y))
    still = np.array([normal < 0, mu * normal < np.abs(across)])
    ends = np.where(still, well, ends)
    # turning points
    within = [U <= end[:, None] for end in ends]
    cells = np.array([(w.argmax(axis=1) - 1, columns - 1 - w[:, ::-1].argmax(axis=1)) for w in within])
    start, flat, low = stencil(cells)
    places = start + _root(s2(flat) * (ends[:, None] - U.take(flat)), low, [[0], [1]])
    places = np.where(cells < 0, -np.inf, np.where(cells >= columns - 1, np.inf, places))
    # a well that falls between two points
    half = np.sqrt(2 * np.maximum(ends - well, 0) / (three[0] - 2 * three[1] + three[2]))
    none = ~np.array([w[here, lowest] for w in within])
    places = np.where(none[:, None], near + steady + half[:, None] * [[-1], [1]], places)
    places = np.where(np.isinf(ends)[:, None], [[-np.inf], [np.inf]], places)
    return np.where(still[:, None], near + steady, places), several


def _vertex(before: Array, at: Array, after: Array) -> tuple[Array, Array]:
    """Least value of the parabolas through values at -1, 0, 1, and where; inf where they bend down."""
    bend = before - 2 * at + after
    bend = np.where(bend > 0, bend, np.nan)
    return at - (after - before) ** 2 / (8 * bend), (before - after) / (2 * bend)


def _parabola(t: Array, before: Array, at: Array, after: Array) -> Array:
    return at + t * ((after - before) + t * (before - 2 * at + after)) / 2


def _cubic(values: Array) -> Array:
    """Coefficients of the cubics through values (4, ...) at 0, 1, 2, 3."""
    return np.tensordot(_CUBIC, values, axes=1)


def _value(c: Array, t: Number) -> Array:
    return ((c[3] * t + c[2]) * t + c[1]) * t + c[0]


def _root(values: Array, low: Indices, outside: Sequence[Sequence[int]] | None = None) -> Array:
    """Where cubics through values (4, ...) are zero between low and low + 1; the chord's zero where they are not.

    outside, 0 or 1: the end of the cell to start from, where values may rise and fall between the two."""
    first, last = (np.take_along_axis(values, low[None] + step, axis=0)[0] for step in (0, 1))
    chord = low + first / (first - last)
    c, t = _cubic(values), chord if outside is None else low + outside
    for _ in range(3 if outside is None else 5):
        t = t - _value(c, t) / ((3 * c[3] * t + 2 * c[2]) * t + c[1])
    return np.where(np.abs(t - low - 0.5) <= 0.5, t, chord)
