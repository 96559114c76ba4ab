"""theta_dot^2 = f(theta), equation (36), and the angular velocities as functions of theta."""

from decimal import localcontext

import numpy as np

from ..compiled import compiled
from ..errors import checked_many
from ..types import Array, Indices, Like, Number, Scalars
from . import equations as eq
from .constants import EXACT, Constants, Exact, exact_versine, versines
from .poles import Floats, bracket_near, pole_offsets
from .top import Top, TopNumbers
from .wells import ExactCurve

_CANCELLED = 1e-5  # relative to the terms of (36): a smaller sum has lost more than five of sixteen figures


@checked_many
def f1_squared(theta: Like, top: Top) -> Like:
    """f1^2 = I1 + 1 + a^2 - 2 a cos(theta), (35).

    Parameters
    ----------
    theta : float or array
        tilt in rad, any shape
    top : Top
        the top

    Returns
    -------
    float or array
        in MR^2, of that shape
    """
    return eq.f1_2(np.cos(theta), top)


@checked_many
def f2_squared(theta: Like, top: Top) -> Like:
    """f2^2 = I1 + (I1/I3) sin(theta)^2 + (cos(theta) - a)^2, (34).

    Parameters
    ----------
    theta : float or array
        tilt in rad, any shape
    top : Top
        the top

    Returns
    -------
    float or array
        in MR^2, of that shape
    """
    return eq.f2_2(np.cos(theta), np.sin(theta) ** 2, top)


@checked_many
def f3_squared(theta: Like, top: Top) -> Like:
    """f3^2 = I3 + sin(theta)^2 + (I3/I1)(cos(theta) - a)^2, (32).

    Parameters
    ----------
    theta : float or array
        tilt in rad, any shape
    top : Top
        the top

    Returns
    -------
    float or array
        in MR^2, of that shape
    """
    return eq.f3_2(np.cos(theta), np.sin(theta) ** 2, top)


@checked_many
def omega3(theta: Like, top: Top, constants: Constants) -> Like:
    """omega_3 = K_R/f3, (31).

    Parameters
    ----------
    theta : float or array
        tilt in rad; broadcasts
    top : Top
        the top
    constants : Constants
        K_J, K_R and E; they broadcast with theta

    Returns
    -------
    float or array
        in (g/R)^1/2

    Raises
    ------
    TopError
        for anything else, with the name, the value and the allowed range
    """
    return eq.omega3(np.cos(theta), np.sin(theta) ** 2, constants.K_R, top)


@checked_many
def omega2(theta: Like, top: Top, constants: Constants) -> Like:
    """omega_2' = [K_J - (I3/I1)(c - a) K_R/f3]/s, (30).

    Parameters
    ----------
    theta : float or array
        tilt in rad; broadcasts
    top : Top
        the top
    constants : Constants
        K_J, K_R and E; they broadcast with theta

    Returns
    -------
    float or array
        in (g/R)^1/2. At a pole it is infinite, or 0 if the bracket vanishes there (K_J at P)

    Raises
    ------
    TopError
        for anything else, with the name, the value and the allowed range
    """
    offsets = pole_offsets(top, constants.K_J, constants.K_R)
    rows = np.broadcast_arrays(*versines(theta), constants.K_R, *offsets)
    value: Number = omega2_on(top.numbers, *(np.array(x, dtype=float).ravel() for x in rows))
    return value.reshape(rows[0].shape)[()]


@compiled
def omega2_on(top: TopNumbers, v: Array, m: Array, K_R: Array, upright: Array, inverted: Array) -> Array:
    """w2 = B/s (30) from v = 1 - c, m = 1 + c, K_R and the offsets of both poles, each (n,)."""
    w2 = np.empty(len(v))
    for i in range(len(v)):
        x, side = (v[i], 1.0) if v[i] <= m[i] else (m[i], -1.0)
        B, _ = bracket_near(side, x, Floats(top, K_R[i], upright[i], inverted[i]))
        s = np.sqrt(v[i] * m[i])
        w2[i] = B / s if s > 0 else 0.0 if B == 0 else np.copysign(np.inf, B)
    return w2


@checked_many
def f(theta: Like, top: Top, constants: Constants) -> Like:
    """theta_dot^2 = f(theta), (36); negative where no motion is possible.

    Parameters
    ----------
    theta : float or array
        tilt in rad; broadcasts
    top : Top
        the top
    constants : Constants
        K_J, K_R and E; they broadcast with theta

    Returns
    -------
    float or array
        in g/R. -inf at a pole that no motion with this K_J can reach. Near its zeros, where the terms of (36)
        cancel, it is computed in Decimals, point by point

    Raises
    ------
    TopError
        for anything else, with the name, the value and the allowed range
    """
    value, cancelled = floats(theta, top, constants)
    if cancelled.size:
        args = np.broadcast_arrays(theta, constants.K_J, constants.K_R, constants.E)
        value.flat[cancelled] = exact_f(top, *(x.flat[cancelled] for x in args))
    return value[()]


def rounded_f(theta: Like, top: Top, constants: Constants) -> Like:
    """f computed in floats only, which is fast; near its zeros the error is the rounding of the terms of (36)."""
    return floats(theta, top, constants)[0][()]


def floats(theta: Scalars, top: Top, constants: Constants) -> tuple[Number, Indices]:
    """f in floats, and the flat indices at which its terms cancel."""
    offsets = pole_offsets(top, constants.K_J, constants.K_R)
    given = [np.asarray(x) for x in (*versines(theta), constants.K_R, constants.two_E_prime(top), *offsets)]
    shape = np.broadcast_shapes(*(x.shape for x in given))
    value = np.empty(shape)
    if not value.size:
        return value, np.empty(0, int)
    if len(shape) > 2:
        given = [np.broadcast_to(x, shape).reshape(-1, shape[-1]) for x in given]
    rows = [np.array(np.atleast_2d(x), dtype=float, order="C") for x in given]
    rows.append(value.reshape(-1, shape[-1] if shape else 1))
    return value, theta_dot_2_on(top.numbers, *rows)


@compiled
def theta_dot_2_on(
    top: TopNumbers, V: Array, M: Array, K_R: Array, e: Array, upright: Array, inverted: Array, f: Array
) -> Indices:
    """Writes (36) into f (n, m), from 1 - c, 1 + c, K_R, 2E' and the offsets of both poles, each (n or 1, m or 1).
    Returns the flat indices at which its terms cancel."""
    cancelled, count = np.empty(f.size, np.intp), 0
    n, m = f.shape
    v, c, s2, xC, K, d, e_row, U = np.empty((8, m))
    for i in range(n):
        if i == 0 or len(V) > 1 or len(K_R) > 1:
            for j in range(m):
                v[j], K[j] = at(V, i, j), at(K_R, i, j)
                x, side = (v[j], 1.0) if v[j] <= at(M, i, j) else (at(M, i, j), -1.0)
                c[j], s2[j] = side * (1 - x), x * (2 - x)
                B, _ = bracket_near(side, x, Floats(top, K[j], 0.0, 0.0))
                xC[j] = B
        for j in range(m):
            d[j], e_row[j] = at(upright, i, j) if c[j] >= 0 else at(inverted, i, j), at(e, i, j)
        for j in range(m):  # simple enough to be vectorized
            B = d[j] + xC[j]
            U[j] = eq.U(v[j], c[j], s2[j], B * B / s2[j], top)
            f[i, j] = eq.theta_dot_2(e_row[j], U[j], c[j], top)
        for j in range(m):
            if s2[j] == 0 and d[j] == 0:  # through the pole
                U[j] = eq.U(v[j], c[j], 0.0, 0.0, top)
                f[i, j] = eq.theta_dot_2(e_row[j], U[j], c[j], top)
            if abs(e_row[j] - U[j]) < _CANCELLED * max(abs(e_row[j]), U[j], K[j] * K[j]):
                cancelled[count] = i * m + j
                count += 1
    return cancelled[:count]


def at(x: Array, i: int, j: int) -> float:
    """x[i, j], broadcasting an axis of length 1."""
    return x[i if x.shape[0] > 1 else 0, j if x.shape[1] > 1 else 0]


def exact_f(top: Top, theta: Array, K_J: Array, K_R: Array, E: Array) -> Array:
    """f in Decimals, taking every float as exact; all arrays (n,)."""
    curves = {}
    value = np.empty(theta.shape)
    for i, (x, *row) in enumerate(zip(theta.tolist(), *(K.tolist() for K in (K_J, K_R, E)), strict=True)):
        if tuple(row) not in curves:
            curves[tuple(row)] = ExactCurve(top, Exact.of(Constants(*row), top))
        curve = curves[tuple(row)]
        with localcontext(EXACT):
            c = 1 - exact_versine(x)
            value[i] = eq.theta_dot_2(curve.exact.e, curve.U(c), c, curve.top)
    return value
