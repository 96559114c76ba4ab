"""theta_dot^2 = f(theta), equation (36): the curve, its zeros, its wells, and the steady precessions at their bottom.

With c = cos(theta), s = sin(theta), B the bracket of (36) and 2E' = e,

    f1^2 f = e - U,     U = 2a(1 - c) + f2^2 w2^2,     w2 = B/s,     B = K_J - (I3/I1)(c - a) K_R/f3 .

B loses all its figures where it vanishes at a pole, which is what happens on every trajectory that comes near one. So
it is taken apart there: at theta = 0, with v = 1 - c, B = d + v C, where d = K_J - K_J(P) and C has no cancellation.
The inverted pole is the same with a -> -a, v -> 1 + c and the sign of K_R turned.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
from decimal import ROUND_CEILING, Context, Decimal, localcontext
from typing import NamedTuple, Self, overload

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from ..errors import NoMotionError, finite, numbers
from ..types import Array, Bools, Number, Scalars
from .constants import EXACT, AnyTop, Constants, Exact, ExactTop, exact_top, f1_2, f2_2, f3_2, nonzero, versines
from .top import Top

_CANCELLED = 1e-5  # of the terms of (36): a smaller sum of them has lost more than five of sixteen figures


class SteadyPrecessions(NamedTuple):
    """theta (k,) in rad, ascending, and stable (k,), whether U is least there."""

    theta: Array
    stable: Bools


class Well(NamedTuple):
    """cos(theta) at the turning points."""

    inner: Decimal
    outer: Decimal


class Station(NamedTuple):
    """cos(theta), e - U there, and whether U is least there."""

    c: Decimal
    gap: Decimal
    bottom: bool


# ---- the functions of theta ----


@overload
def f1_squared(theta: float, top: Top) -> float: ...
@overload
def f1_squared(theta: Array, top: Top) -> Array: ...
def f1_squared(theta: Scalars, top: Top) -> Scalars:
    """f1^2 = I1 + 1 + a^2 - 2 a cos(theta), (35). theta in rad, any shape."""
    return f1_2(np.cos(theta), top)


@overload
def f2_squared(theta: float, top: Top) -> float: ...
@overload
def f2_squared(theta: Array, top: Top) -> Array: ...
def f2_squared(theta: Scalars, top: Top) -> Scalars:
    """f2^2 = I1 + (I1/I3) sin(theta)^2 + (cos(theta) - a)^2, (34). theta in rad, any shape."""
    return f2_2(np.cos(theta), np.sin(theta) ** 2, top)


@overload
def f3_squared(theta: float, top: Top) -> float: ...
@overload
def f3_squared(theta: Array, top: Top) -> Array: ...
def f3_squared(theta: Scalars, top: Top) -> Scalars:
    """f3^2 = I3 + sin(theta)^2 + (I3/I1)(cos(theta) - a)^2, (32). theta in rad, any shape."""
    return f3_2(np.cos(theta), np.sin(theta) ** 2, top)


@overload
def omega3(theta: float, top: Top, constants: Constants) -> Scalars: ...
@overload
def omega3(theta: Array, top: Top, constants: Constants) -> Array: ...
def omega3(theta: Scalars, top: Top, constants: Constants) -> Scalars:
    """omega_3 = K_R/f3, (31), in (g/R)^1/2. theta in rad; theta and the constants broadcast."""
    return constants.K_R / np.sqrt(f3_squared(theta, top))


@overload
def omega2(theta: float, top: Top, constants: Constants) -> Scalars: ...
@overload
def omega2(theta: Array, top: Top, constants: Constants) -> Array: ...
def omega2(theta: Scalars, top: Top, constants: Constants) -> Scalars:
    """omega_2' = [K_J - (I3/I1)(c - a) K_R/f3]/s, (30), in (g/R)^1/2. theta in rad; theta and the constants broadcast.

    At a pole it is infinite unless the bracket vanishes there (K_J at P), and then 0.
    """
    v, m = versines(theta)
    return omega2_at(v, m, top, constants.K_R, pole_gaps(top, constants.K_J, constants.K_R))


@overload
def f(theta: float, top: Top, constants: Constants) -> Scalars: ...
@overload
def f(theta: Array, top: Top, constants: Constants) -> Array: ...
def f(theta: Scalars, top: Top, constants: Constants) -> Scalars:
    """theta_dot^2 = f(theta), (36), in g/R; negative where no motion is.

    theta in rad; theta and the constants broadcast. -inf at a pole that no motion with this K_J reaches. Next to its
    zeros, where the terms of (36) cancel, it is computed in the machine's longest float.
    """
    value, size = _f(theta, top, constants)
    cancelled = np.abs(value) < _CANCELLED * size
    if np.any(cancelled):
        args = np.broadcast_arrays(theta, constants.K_J, constants.K_R, constants.E)
        value = np.array(value)
        value[cancelled] = _long_f(top, *(x[cancelled] for x in args))
    return value[()]


@overload
def rounded_f(theta: float, top: Top, constants: Constants) -> Scalars: ...
@overload
def rounded_f(theta: Array, top: Top, constants: Constants) -> Array: ...
def rounded_f(theta: Scalars, top: Top, constants: Constants) -> Scalars:
    """f in floats all through, which is fast; next to its zeros it has the rounding of the terms of (36)."""
    return _f(theta, top, constants)[0]


def _f(theta: Scalars, top: Top, constants: Constants) -> tuple[Array, Array]:
    """f, and the largest of the terms it is the sum of."""
    v, m = versines(theta)
    w2 = omega2_at(v, m, top, constants.K_R, pole_gaps(top, constants.K_J, constants.K_R))
    value, size = _sum_36(v, m, top, constants.two_E_prime(top), w2)
    return value, np.maximum(size, constants.K_R**2 / f1_2(1 - v, top))


def _sum_36(v: Number, m: Number, top: AnyTop, e: Number, w2: Number) -> tuple[Number, Number]:
    """(2E' - 2a(1 - c) - f2^2 w2^2)/f1^2, and its largest term."""
    c = 1 - v
    tilt, turn, f1_sq = 2 * top.a * v, f2_2(c, v * m, top) * w2**2, f1_2(c, top)
    return (e - tilt - turn) / f1_sq, np.maximum(np.abs(e), np.maximum(np.abs(tilt), turn)) / f1_sq


def _long_f(top: Top, theta: Array, K_J: Array, K_R: Array, E: Array) -> NDArray[np.longdouble]:
    """f with every float taken as exact, in long doubles; arrays of one shape."""
    long = ExactTop(*map(np.longdouble, (top.a, top.I1, top.I3)))
    # 2E' is itself a difference of large numbers
    rows = list(zip(K_J, K_R, E, strict=True))
    known = {row: np.longdouble(str(Exact.of(Constants(*row), top).e)) for row in set(rows)}
    e = np.array([known[row] for row in rows])
    theta, K_J, K_R = (np.asarray(x, dtype=np.longdouble) for x in (theta, K_J, K_R))
    v, m = 2 * np.sin(theta / 2) ** 2, 2 * np.cos(theta / 2) ** 2
    gaps = [K_J - np.longdouble(str(ratio)) * K_R for ratio in pole_ratios(top)]
    gaps = [np.where(at_pole(d, K_J.astype(float)), 0, d) for d in gaps]
    w2 = omega2_at(v, m, long, K_R, gaps)
    return _sum_36(v, m, long, e, w2)[0]


@overload
def pole_constants(top: Top, K_R: float) -> tuple[float, float]: ...
@overload
def pole_constants(top: Top, K_R: Array) -> tuple[Array, Array]: ...
def pole_constants(top: Top, K_R: Scalars) -> tuple[Scalars, Scalars]:
    """(K_J at P, K_J at the inverted pole): where the bracket of (36) vanishes at theta = 0 and at theta = pi.

    K_J(P) = (I3/I1)(1 - a) K_R/f3(0); through the poles pass the trajectories with these K_J and no others. K_R of any
    shape; for a number these are the floats nearest to them, which everything here takes for the poles' own.
    """
    if np.ndim(K_R):
        K_R = numbers("K_R", K_R)
        P, inverted = (top.I3 / top.I1 * (c - top.a) * K_R / np.sqrt(f3_2(c, 0, top)) for c in (1, -1))
        return P, inverted
    with localcontext(EXACT):
        t, K_R = exact_top(top), Decimal(finite("K_R", K_R))
        P, inverted = (float(exact_bracket_term(Decimal(c), Decimal(0), t, K_R)) for c in (1, -1))
        return P, inverted


def pole_ratios(top: Top) -> list[Decimal]:
    """K_J/K_R at P and at the inverted pole, Decimals."""
    with localcontext(EXACT):
        return [exact_bracket_term(Decimal(c), Decimal(0), exact_top(top), Decimal(1)) for c in (1, -1)]


def pole_gaps(top: Top, K_J: Scalars, K_R: Scalars) -> tuple[Array, Array]:
    """d = K_J - K_J(P), and the same at the inverted pole, without the rounding of K_J(P)."""
    gaps = []
    for ratio in pole_ratios(top):
        high = float(ratio)
        low = float(ratio - Decimal(high))
        K = high * K_R
        # the product's own rounding, by Dekker: each factor in two halves of 26 bits
        (a1, a2), (b1, b2) = halves(high), halves(K_R)
        d = (K_J - K) - (((a1 * b1 - K) + a1 * b2 + a2 * b1) + a2 * b2 + low * K_R)
        gaps.append(np.where(at_pole(d, K_J), 0.0, d))
    return gaps[0], gaps[1]


def halves(x: Number) -> tuple[Number, Number]:
    """x as a sum of two floats of half its digits."""
    high = (x * 134217729.0) - (x * 134217729.0 - x)
    return high, x - high


def at_pole(d: Number, K_J: Scalars) -> Bools:
    """Whether K_J is the pole's own to the last digit: its float cannot be nearer to it."""
    return np.abs(d) <= 0.51 * np.spacing(np.abs(K_J))


def near_pole(v: Number, m: Number, top: AnyTop, K_R: Number, gaps: Sequence[Number]) -> tuple[Number, Number, Number]:
    """d, x and C of B = d + x C, where x is the smaller of v = 1 - c and m = 1 + c."""
    north = v <= m
    sign, x = np.where(north, 1.0, -1.0), np.minimum(v, m)
    return np.where(north, *gaps), x, pole_slope(x, sign * top.a, sign * K_R, top)


def pole_slope(x: Number, a: Number, K_R: Number, top: AnyTop) -> Number:
    """C at x = 1 - c next to the upright pole; at the inverted one x = 1 + c and the signs of a and K_R turned."""
    gamma = top.I3 / top.I1
    p = 1 - a
    q, far = p - x, 2 - x
    f3_pole, f3 = np.sqrt(top.I3 + gamma * p * p), np.sqrt(top.I3 + x * far + gamma * q * q)
    # p/f3_pole - q/f3, divided by x, with the difference multiplied out; as it stands where p and q differ in sign
    with np.errstate(divide="ignore", invalid="ignore"):
        C = (p * p * far + top.I3 * (p + q)) / (f3_pole * f3 * (p * f3 + q * f3_pole))
        opposite = p * q <= 0
        if np.any(opposite):
            C = np.where(opposite, np.where(p == 0, 1 / f3, (p / f3_pole - q / f3) / x), C)
    return gamma * K_R * C


def omega2_at(v: Number, m: Number, top: AnyTop, K_R: Number, gaps: Sequence[Number]) -> Array:
    """omega_2' = B/s from v = 1 - c and m = 1 + c."""
    d, x, C = near_pole(v, m, top, K_R, gaps)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(d == 0, 0.0, d / np.sqrt(v * m)) + np.sqrt(x / (2 - x)) * C


def bracket_slope(c: Number, s2: Number, top: AnyTop, K_R: Number) -> Number:
    """-dB/dc = (I3/I1) K_R (I3 + 1 - a c)/f3^3"""
    return top.I3 / top.I1 * K_R * (top.I3 + 1 - top.a * c) / f3_2(c, s2, top) ** 1.5


# ---- the same with the digits of EXACT, for zeros that floats cannot place ----


def exact_bracket_term(c: Decimal, s2: Decimal, t: ExactTop, K_R: Decimal) -> Decimal:
    """(I3/I1)(c - a) K_R/f3"""
    return t.I3 / t.I1 * (c - t.a) * K_R / f3_2(c, s2, t).sqrt()


class ExactCurve:
    """U, D = s^2 (e - U) and N = s^4 dU/dc as functions of c = cos(theta), Decimals."""

    def __init__(self, top: Top, exact: Exact, rounded: bool = True) -> None:
        """rounded: K_J, K_R and E were given as floats, and mean what the nearest float can mean."""
        self.top_, self.top = top, exact_top(top)  # in floats, and exact
        with localcontext(EXACT):
            poles = [exact_bracket_term(Decimal(c), Decimal(0), self.top, exact.K_R) for c in (1, -1)]
            for K_J in poles:
                if rounded and at_pole(float(exact.K_J - K_J), float(exact.K_J)):
                    exact = replace(exact, K_J=K_J)
            # a state's K_J and K_R are exact but for a square root
            negligible = abs(exact.K_J) * Decimal("1e-55")
            self.gaps = tuple(exact.K_J - K_J if abs(exact.K_J - K_J) > negligible else Decimal(0) for K_J in poles)
        self.exact, self.rounded = exact, rounded

    @classmethod
    def of(cls, top: Top, K_J: float, K_R: float) -> Self:
        """With no energy."""
        K_J, K_R = (nonzero(Decimal(finite(name, K))) for name, K in (("K_J", K_J), ("K_R", K_R)))
        return cls(top, Exact(K_J, K_R, Decimal(0)))

    def U(self, c: Decimal) -> Decimal:
        t, s2 = self.top, 1 - c * c
        if s2 == 0:  # finite only where the bracket vanishes too, and then it is the height alone
            return 2 * t.a * (1 - c) if self.gaps[c < 0] == 0 else Decimal("Infinity")
        B = self.exact.K_J - exact_bracket_term(c, s2, t, self.exact.K_R)
        return 2 * t.a * (1 - c) + f2_2(c, s2, t) * B * B / s2

    def gap(self, c: Decimal) -> tuple[Decimal, Decimal | None]:
        """e - U and its slope, for where U is finite; at a pole the slope is left out."""
        s2 = 1 - c * c
        return self.exact.e - self.U(c), -self.N(c) / (s2 * s2) if s2 else None

    def D(self, c: Decimal) -> tuple[Decimal, Decimal]:
        """D and dD/dc."""
        t, s2, e = self.top, 1 - c * c, self.exact.e
        f3_sq = f3_2(c, s2, t)
        f3 = f3_sq.sqrt()
        B = self.exact.K_J - t.I3 / t.I1 * (c - t.a) * self.exact.K_R / f3
        dB = -t.I3 / t.I1 * self.exact.K_R * (t.I3 + 1 - t.a * c) / (f3_sq * f3)
        f2_sq, rest = f2_2(c, s2, t), e - 2 * t.a * (1 - c)
        df2_sq = 2 * ((c - t.a) - t.I1 / t.I3 * c)
        return s2 * rest - f2_sq * B * B, 2 * t.a * s2 - 2 * c * rest - B * (df2_sq * B + 2 * f2_sq * dB)

    def N(self, c: Decimal) -> Decimal:
        t, s2 = self.top, 1 - c * c
        f3_sq = f3_2(c, s2, t)
        f3 = f3_sq.sqrt()
        B = self.exact.K_J - t.I3 / t.I1 * (c - t.a) * self.exact.K_R / f3
        dB = -t.I3 / t.I1 * self.exact.K_R * (t.I3 + 1 - t.a * c) / (f3_sq * f3)
        return well_slope(c, s2, B, dB, t)


def well_slope(c: Number, s2: Number, B: Number, dB: Number, top: AnyTop) -> Number:
    """N = s^4 dU/dc = -2a s^4 + 2[(c - a)(1 - a c) + I1 c] B^2 + 2 f2^2 s^2 B dB/dc; zero at a steady precession."""
    a = top.a
    return -2 * a * s2 * s2 + 2 * B * (((c - a) * (1 - a * c) + top.I1 * c) * B + f2_2(c, s2, top) * s2 * dB)


def solve(
    function: Callable[[Decimal], tuple[Decimal, Decimal | None]],
    low: Decimal, high: Decimal, rises: bool, guess: Decimal | None = None,
) -> Decimal:  # fmt: skip
    """The zero of function(c) -> (value, slope or None) between low and high (Decimals); rises: from below 0 to above.

    Newton's step, or the secant's, kept inside the bracket; bisection, in the distance to a pole on a logarithmic
    scale, where a step leaves it. Ends when a step moves 1 - c or 1 + c by less than 1e-13 of itself, and the steps
    fall as fast as they do off a double zero.
    """
    c, previous, last = guess if guess and low < guess < high else bisect(low, high), None, Decimal(1)
    for _ in range(400):
        value, slope = function(c)
        if value == 0:
            return c
        if (value > 0) == rises:
            high = c
        else:
            low = c
        if slope is None and previous is not None and previous[1] != value:
            slope = (value - previous[1]) / (c - previous[0])
        previous = (c, value)
        following = c - value / slope if slope else bisect(low, high)
        step, small = abs(following - c), min(1 - c, 1 + c) * Decimal("1e-13")
        if slope and step <= small and (step <= last / 1000 or step <= small / 10**9):
            return min(max(following, low), high)
        last = step
        if not low < following < high:
            following = bisect(low, high)
        if high - low <= small / 10**9:
            return c
        c = following
    return c


def bisect(low: Decimal, high: Decimal) -> Decimal:
    for near, far, sign in ((1 - high, 1 - low, 1), (1 + low, 1 + high, -1)):
        if near < far / 16 and near < Decimal("0.1"):
            x = (near * far).sqrt() if near > 0 else far * Decimal("1e-4")
            return sign * (1 - x)
    return (low + high) / 2


# ---- steady precessions, wells, turning points ----

_GRID = np.linspace(0, np.pi, 513)
_GRID_V, _GRID_M = versines(_GRID)


def extrema(curve: ExactCurve) -> list[Decimal]:
    """cos(theta) of all zeros of N in (0, pi), from theta = 0 on: where U is least or largest. List of Decimals."""
    top, K_J, K_R = curve.top_, float(curve.exact.K_J), float(curve.exact.K_R)
    if K_J == K_R == 0:
        return []  # U is the height alone
    v, m, c, s2 = _GRID_V, _GRID_M, 1 - _GRID_V, _GRID_V * _GRID_M
    d, x, C = near_pole(v, m, top, K_R, tuple(map(float, curve.gaps)))

    def N(c: Number) -> Number:
        s2 = 1 - c * c
        B = K_J - top.I3 / top.I1 * (c - top.a) * K_R / f3_2(c, s2, top) ** 0.5
        return well_slope(c, s2, B, -bracket_slope(c, s2, top, K_R), top)

    values = well_slope(c, s2, d + x * C, -bracket_slope(c, s2, top, K_R), top)
    brackets = sign_changes(c, values, N)
    zeros = []
    with localcontext(EXACT):
        for left, right in brackets:
            low, high = N(right), N(left)
            guess = Decimal(brentq(N, right, left, xtol=1e-15)) if low * high < 0 else None
            right, left = Decimal(float(right)), Decimal(float(left))
            zeros.append(solve(lambda c: (curve.N(c), None), right, left, curve.N(right) < 0, guess))
    return [c for c in zeros if abs(c) < 1]


def sign_changes(c: Array, values: Array, function: Callable[[float], float]) -> list[tuple[float, float]]:
    """Pairs of abscissae between which function changes sign: grid cells, and cells into which it only dips."""
    found: list[tuple[Number, tuple[float, float]]]  # where, or halfway between the same and the next
    found = [(i, (c[i], c[i + 1])) for i in np.flatnonzero(values[:-1] * values[1:] < 0)]
    found += [(i, (c[i - 1], c[i + 1])) for i in np.flatnonzero(values[1:-1] == 0) + 1]
    y, size = values, np.abs(values)
    turn = (y[:-2] * y[2:] > 0) & (y[:-2] * y[1:-1] > 0) & (size[1:-1] <= size[:-2]) & (size[1:-1] <= size[2:])
    for i in np.flatnonzero(turn) + 1:
        low, high = c[i + 1], c[i - 1]
        for _ in range(60):  # golden section towards zero
            c1, c2 = high - 0.6180339887498949 * (high - low), low + 0.6180339887498949 * (high - low)
            y1, y2 = function(c1), function(c2)
            if min(y1 * y[i], y2 * y[i]) < 0:
                dip = c1 if y1 * y[i] < 0 else c2
                found += [(i, (c[i - 1], dip)), (i + 0.5, (dip, c[i + 1]))]
                break
            low, high = (c1, high) if abs(y2) < abs(y1) else (low, c2)
    return [pair for _, pair in sorted(found)]


def steady_precessions(top: Top, K_J: float, K_R: float) -> SteadyPrecessions:
    """The steady precessions f = f' = 0 at K_J and K_R (numbers): SteadyPrecessions(theta, stable), arrays by theta.

    theta in rad in (0, pi), and 0 or pi itself where K_J is exactly the pole's; stable (f'' < 0) means that U is least.
    """
    with localcontext(EXACT):
        stations = find_stations(ExactCurve.of(top, K_J, K_R))
        stations = [s for s in stations if s.gap.is_finite()]
        return SteadyPrecessions(np.array([angle(s.c) for s in stations]), np.array([s.bottom for s in stations], bool))


def angle(c: Decimal) -> float:
    """theta of an exact cos(theta)."""
    with localcontext(EXACT):
        v, m = 1 - c, 1 + c
    return 2 * np.arctan2(float(v) ** 0.5, float(m) ** 0.5)


def find_stations(curve: ExactCurve) -> list[Station]:
    """The poles and the extrema between them: U is monotone from each to the next."""
    with localcontext(EXACT):
        exact = curve.exact
        places = [Decimal(1), *extrema(curve), Decimal(-1)]
        U = [curve.U(c) for c in places]
        infinite = Decimal("Infinity")
        around = zip([infinite, *U], U, [*U[1:], infinite], strict=False)
        bottoms = [(here < left and here < right) or here == left == right for left, here, right in around]
        return [Station(c, exact.e - u, b) for c, u, b in zip(places, U, bottoms, strict=True)]


def wells(curve: ExactCurve) -> list[Well]:
    """The allowed intervals of cos(theta), from theta = 0 on: list of Well.

    An energy given as a float that differs from that of the bottom of a well by no more than its own rounding is the
    one of the steady precession.
    """
    with localcontext(EXACT):
        exact, stations = curve.exact, find_stations(curve)
        size = max(abs(exact.e), exact.K_R**2, exact.K_J**2)
        rounding = size * (Decimal(2) ** -50 if curve.rounded else Decimal("1e-50"))
        found, inner = [], Decimal(1)
        for before, here in zip([None, *stations], stations, strict=False):
            if here.bottom and abs(here.gap) <= rounding:
                found.append(Well(here.c, here.c))
            elif here.gap > 0:
                if before is None or (before.bottom and abs(before.gap) <= rounding):
                    inner = here.c if before is None else before.c
                elif before.gap <= 0:
                    inner = turning_point(curve, here, before)
                if here is stations[-1]:
                    found.append(Well(inner, here.c))
            elif before is not None and before.gap > 0 and not (before.bottom and abs(before.gap) <= rounding):
                found.append(Well(inner, turning_point(curve, here, before)))
        found = found or [Well(s.c, s.c) for s in stations if s.gap == 0][:1]  # a ball at rest
        if found:
            return found
        shift = exact.K_R**2 - curve.top.I1 / curve.top.I3 * exact.K_J**2
        E, E_least = float(exact.e + shift) / 2, (exact.e - max(s.gap for s in stations) + shift) / 2
        constants = f"K_J = {float(exact.K_J) + 0.0:.10g} and K_R = {float(exact.K_R) + 0.0:.10g}"
        raise NoMotionError("E", E, f"E >= {_no_less(E_least):.10g} for this top, {constants}",
                            "Below it is no motion, at it the steady precession of least energy.")  # fmt: skip


def _no_less(x: Decimal) -> float:
    """x in ten figures, none of them rounded down: typed in again it is no smaller."""
    return float(Context(prec=10, rounding=ROUND_CEILING).plus(x))


def turning_point(curve: ExactCurve, one: Station, other: Station) -> Decimal:
    """The zero of e - U between two stations at which it differs in sign."""
    low, high = sorted((one, other))  # by cos(theta)
    for end in (low, high):
        if end.gap == 0:
            return end.c
    through_pole = any(abs(end.c) == 1 and end.gap.is_finite() for end in (one, other))  # there D is 0 whatever e is
    return solve(curve.gap if through_pole else curve.D, low.c, high.c, high.gap > 0)


def turning_points(top: Top, constants: Constants) -> Array:
    """The allowed intervals f >= 0: (k, 2) array of theta (rad), a row each, from theta = 0 on.

    The constants are numbers. Steady precession: both ends equal. Raises NoMotionError below the lowest well.
    """
    return np.array([[angle(w.inner), angle(w.outer)] for w in wells(ExactCurve(top, Exact.of(constants, top)))])
