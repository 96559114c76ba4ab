"""The wells of U, in which f >= 0 in (36): their turning points, and the steady precessions at their minima.

They are found in floats, on a grid and by zero(). Decimals take the last steps and decide what floats cannot: near a
pole, near a steady precession, and where two wells merge.
"""

from collections.abc import Callable, Iterator
from dataclasses import replace
from decimal import ROUND_CEILING, Context, Decimal, localcontext
from typing import NamedTuple, Self

import numpy as np

from ..compiled import compiled
from ..errors import NoMotionError, finite
from ..types import Array
from . import equations as eq
from .constants import EXACT, Exact, exact_top, nonzero, versines
from .poles import Floats, angle, at_pole, bracket_near, exact_pole_constants
from .search import zero
from .top import Top

ROOTS = Decimal("1e-55")  # relative error of K_J and K_R of a state, from square roots


class Well(NamedTuple):
    """A well: cos(theta) at its turning points."""

    inner: Decimal
    outer: Decimal


class Station(NamedTuple):
    """A pole or an extremum of U: cos(theta), e - U there, and whether U has a minimum."""

    c: Decimal
    kinetic: Decimal
    bottom: bool


class ExactCurve:
    """U, e - U and related functions of c = cos(theta), in Decimals, for one K_J, K_R and e = 2E'."""

    def __init__(self, top: Top, exact: Exact, rounded: bool = True) -> None:
        """rounded: K_J, K_R and E were given as floats, so their values are uncertain by half a unit in the last
        place."""
        self.top = exact_top(top)
        with localcontext(EXACT):
            poles = exact_pole_constants(top, exact.K_R)
            for K_J in poles:
                if rounded and at_pole(float(exact.K_J - K_J), float(exact.K_J)):
                    exact = replace(exact, K_J=K_J)
            negligible = abs(exact.K_J) * ROOTS
            offsets = (exact.K_J - K_J for K_J in poles)
            self.offsets = tuple(d if abs(d) > negligible else Decimal(0) for d in offsets)
        self.exact, self.rounded = exact, rounded
        upright, inverted = map(float, self.offsets)
        self.floats = Floats(top.numbers, float(exact.K_R), upright, inverted)

    @classmethod
    def of(cls, top: Top, K_J: float, K_R: float) -> Self:
        """The curve without an energy."""
        K_J, K_R = (nonzero(Decimal(finite(name, K))) for name, K in (("K_J", K_J), ("K_R", K_R)))
        return cls(top, Exact(K_J, K_R, Decimal(0)))

    def parts(self, c: Decimal) -> tuple[Decimal, Decimal, Decimal]:
        """s^2, w3 and B."""
        s2 = 1 - c * c
        w3 = eq.omega3(c, s2, self.exact.K_R, self.top)
        return s2, w3, eq.bracket(c, self.exact.K_J, w3, self.top)

    def U(self, c: Decimal) -> Decimal:
        """U of (33). Infinite at a pole, unless the bracket vanishes there: then only the potential energy is left."""
        if abs(c) == 1:
            return Decimal("Infinity") if self.offsets[c < 0] else eq.U(1 - c, c, Decimal(0), Decimal(0), self.top)
        s2, _, B = self.parts(c)
        return eq.U(1 - c, c, s2, B * B / s2, self.top)

    def kinetic(self, c: Decimal) -> tuple[Decimal, Decimal | None]:
        """e - U and its slope, where U is finite; at a pole the slope is None."""
        s2 = 1 - c * c
        return self.exact.e - self.U(c), -self.N(c) / (s2 * s2) if s2 else None

    def D(self, c: Decimal) -> tuple[Decimal, Decimal]:
        """s^2 (e - U), which unlike U stays finite towards the poles, and its slope."""
        s2, w3, B = self.parts(c)
        N = eq.s4_U_slope(c, s2, B, eq.bracket_slope(c, s2, w3, self.top), self.top)
        kinetic = self.exact.e - eq.U(1 - c, c, s2, B * B / s2, self.top)
        return s2 * kinetic, -2 * c * kinetic - N / s2

    def N(self, c: Decimal) -> Decimal:
        """s^4 dU/dc"""
        s2, w3, B = self.parts(c)
        return eq.s4_U_slope(c, s2, B, eq.bracket_slope(c, s2, w3, self.top), self.top)


# ---- in floats: x is the distance of cos(theta) from the pole cos(theta) = side ----

_GRID_V, _GRID_M = versines(np.linspace(0, np.pi, 513))  # 1 - c and 1 + c


def U_near(x: float, side: float, curve: Floats) -> float:
    """U"""
    c, s2, (B, _) = side * (1 - x), x * (2 - x), bracket_near(side, x, curve)
    w2_2 = B * B / s2 if s2 > 0 else 0.0 if B == 0 else np.inf
    return eq.U(x if side > 0 else 2 - x, c, s2, w2_2, curve.top)


def N_near(x: float, side: float, curve: Floats) -> float:
    """s^4 dU/dc"""
    c, s2, (B, w3) = side * (1 - x), x * (2 - x), bracket_near(side, x, curve)
    dB = eq.bracket_slope(c, s2, w3, curve.top)
    return eq.s4_U_slope(c, s2, B, dB, curve.top)


def D_near(x: float, side: float, curve: Floats, e: float) -> float:
    """s^2 (e - U); at the pole its limit"""
    s2, (B, _) = x * (2 - x), bracket_near(side, x, curve)
    return s2 * (e - U_near(x, side, curve)) if s2 > 0 else -eq.f2_2(side, s2, curve.top) * B * B


@compiled
def extrema_near(V: Array, M: Array, curve: Floats) -> Array:
    """The zeros of N from theta = 0 upwards, found on the grid 1 - c = V, 1 + c = M: rows of side, x, a bracket in x,
    and dN/dx. Where N only comes close to zero, a golden section looks for a zero in between."""
    n, half, rows, found = len(V) - 1, len(V) // 2, 0, np.empty((2 * len(V), 5))
    N = np.empty(n + 1)
    for i in range(half + 1):
        N[i] = N_near(V[i], 1.0, curve)
    for i in range(half + 1, n + 1):
        N[i] = N_near(M[i], -1.0, curve)
    for i in range(n):
        side, X = (1.0, V) if i < half else (-1.0, M)
        first, dip, last, count = X[i], X[i + 1], X[i + 1], 1 if N[i] * N[i + 1] < 0 else 0
        if i > 0 and N[i] == 0:
            first, count = X[i - 1], 1
        elif i > 0 and N[i - 1] * N[i] > 0 and N[i] * N[i + 1] > 0 and abs(N[i]) <= min(abs(N[i - 1]), abs(N[i + 1])):
            first, low, high, most = X[i - 1], X[i - 1], X[i + 1], max(abs(N[i - 1]), abs(N[i + 1]))
            for closer in range(60):
                x1, x2 = high - 0.6180339887498949 * (high - low), low + 0.6180339887498949 * (high - low)
                y1, y2 = N_near(x1, side, curve), N_near(x2, side, curve)
                if min(y1 * N[i], y2 * N[i]) < 0:
                    dip, count = x1 if y1 * N[i] < 0 else x2, 2
                    break
                if closer == 8 and min(abs(y1), abs(y2)) > 0.01 * most:
                    break  # a parabola with a zero would have found it by now
                low, high = (x1, high) if abs(y2) < abs(y1) else (low, x2)
        for part in range(count):
            one, other = (first, dip) if part == 0 else (dip, last)
            low, high = min(one, other), max(one, other)
            x = zero(N_near, low, high, (side, curve))
            h = 1e-5 * min(x, 2 - x)
            slope = (N_near(x + h, side, curve) - N_near(x - h, side, curve)) / (2 * h)
            found[rows] = side, x, low, high, slope
            rows += 1
    return found[:rows]


def extrema(curve: ExactCurve) -> list[Decimal]:
    """cos(theta) of all zeros of N in (0, pi), from theta = 0 upwards: the minima and maxima of U."""
    if curve.exact.K_J == curve.exact.K_R == 0:
        return []  # U is only the potential energy
    zeros = []
    for side, x, low, high, slope in extrema_near(_GRID_V, _GRID_M, curve.floats).tolist():
        ends = exact_cosine(side, low), exact_cosine(side, high)
        slopes = iter([Decimal(-side * slope)])  # valid only near the guess

        def N(c: Decimal, slopes: Iterator[Decimal] = slopes) -> tuple[Decimal, Decimal | None]:
            return curve.N(c), next(slopes, None)

        zeros.append(exact_zero(N, min(ends), max(ends), -side * slope > 0, exact_cosine(side, x)))
    return [c for c in zeros if abs(c) < 1]


def exact_cosine(side: float, x: float) -> Decimal:
    return 1 - Decimal(x) if side > 0 else Decimal(x) - 1


def exact_zero(
    function: Callable[[Decimal], tuple[Decimal, Decimal | None]],
    low: Decimal, high: Decimal, rises: bool, guess: Decimal | None = None,
) -> Decimal:  # fmt: skip
    """The zero of function(c) -> (value, slope or None) between low and high (Decimals); rises: whether it is
    increasing.

    Steps of Newton's or the secant method that stay inside the bracket; otherwise bisection, on a logarithmic scale in
    the distance from a pole. It ends when a step changes 1 - c or 1 + c by less than 1e-13 of itself and the steps
    shrink as fast as at a simple zero.
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


def exact_angle(c: Decimal) -> float:
    """theta (rad) of a cos(theta) given as a Decimal."""
    with localcontext(EXACT):
        return float(angle(float(1 - c), 1.0) if c > 0 else angle(float(1 + c), -1.0))


def find_stations(curve: ExactCurve) -> list[Station]:
    """The poles and the extrema between them: U is monotonic from each to the next."""
    with localcontext(EXACT):
        places = [Decimal(1), *extrema(curve), Decimal(-1)]
        U = [curve.U(c) for c in places]
        infinite = Decimal("Infinity")
        around = zip([infinite, *U], U, [*U[1:], infinite], strict=False)
        bottoms = [(here < left and here < right) or here == left == right for left, here, right in around]
        return [Station(c, curve.exact.e - u, b) for c, u, b in zip(places, U, bottoms, strict=True)]


def wells(curve: ExactCurve) -> list[Well]:
    """The allowed intervals of cos(theta), from theta = 0 upwards: a list of Wells.

    An energy given as a float that equals the minimum of a well to within its own rounding is taken as that of the
    steady precession.
    """
    with localcontext(EXACT):
        exact, stations = curve.exact, find_stations(curve)
        size = max(abs(exact.e), exact.K_R**2, exact.K_J**2)
        rounding = size * (Decimal(2) ** -50 if curve.rounded else Decimal("1e-50"))
        found, inner = [], Decimal(1)
        for before, here in zip([None, *stations], stations, strict=False):
            if here.bottom and abs(here.kinetic) <= rounding:
                found.append(Well(here.c, here.c))
            elif here.kinetic > 0:
                if before is None or (before.bottom and abs(before.kinetic) <= rounding):
                    inner = here.c if before is None else before.c
                elif before.kinetic <= 0:
                    inner = turning_point(curve, here, before)
                if here is stations[-1]:
                    found.append(Well(inner, here.c))
            elif before is not None and before.kinetic > 0 and not (before.bottom and abs(before.kinetic) <= rounding):
                found.append(Well(inner, turning_point(curve, here, before)))
        found = found or [Well(s.c, s.c) for s in stations if s.kinetic == 0][:1]  # a ball at rest
    if not found:
        raise no_motion(curve, max(s.kinetic for s in stations))
    return found


def no_motion(curve: ExactCurve, most: Decimal) -> NoMotionError:
    """The error to raise when e - U is nowhere larger than most."""
    with localcontext(EXACT):
        exact = curve.exact
        E, E_least = (eq.E_of(e, exact.K_J, exact.K_R, curve.top) for e in (exact.e, exact.e - most))
    return NoMotionError("E", float(E), "E >= {least:.10g} for this top, K_J = {K_J:.10g} and K_R = {K_R:.10g}",
                         "Below it is no motion, at it the steady precession of least energy.", code="no-motion",
                         least=no_less(E_least), K_J=float(exact.K_J) + 0.0, K_R=float(exact.K_R) + 0.0)  # fmt: skip


def no_less(x: Decimal) -> float:
    """x to ten figures, rounded up: entered again it is no smaller."""
    return float(Context(prec=10, rounding=ROUND_CEILING).plus(x))


@compiled
def turning_near(low: float, high: float, side: float, curve: Floats, e: float) -> float:
    """x of the zero of e - U between two x at which it has opposite signs."""
    return zero(D_near, low, high, (side, curve, e))


def turning_point(curve: ExactCurve, one: Station, other: Station) -> Decimal:
    """The zero of e - U between two stations at which it has opposite signs."""
    low, high = sorted((one, other))  # by cos(theta)
    for end in (low, high):
        if end.kinetic == 0:
            return end.c
    through_pole = any(abs(end.c) == 1 and end.kinetic.is_finite() for end in (one, other))  # there D is 0 for every e
    if through_pole:
        return exact_zero(curve.kinetic, low.c, high.c, high.kinetic > 0)
    side = 1.0 if low.c + high.c > 0 else -1.0
    near, far = sorted(float(1 - int(side) * end.c) for end in (low, high))
    guess = exact_cosine(side, turning_near(near, far, side, curve.floats, float(curve.exact.e)))
    return exact_zero(curve.D, low.c, high.c, high.kinetic > 0, guess)
