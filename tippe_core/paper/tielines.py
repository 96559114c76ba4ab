"""How far a rolling top can go: the tielines of Figs. 5 and 6, and the energies that end them.

With B = s w2, the bracket of (36), and q = w1^2 + w2^2, the forces (37) to (39) are regular at the poles:

    2E' = 2a(1 - c) + f1^2 q - (1 - I1/I3) B^2
    F_z = zc + zb B + z1 q                 A = (a/f1^2) {1 - a c + [a (c - a) - I1] q}
    F_h^2 = X^2 q + D B^2 + 2 A Y B + s^2 A^2
    X = (w3/f2^2) [I1 c - I3 (c - a)] ,    Y = (w3/f1^2) [I3 (1 - a c) - I1 - a^2 s^2] ,    D = (Y^2 - X^2)/s^2

(f3^2 = (I3/I1) f2^2 and f1^2 - f2^2 = (1 - I1/I3) s^2 bring them there). So at each theta the top keeps to the table
where mu F_z - n F_h >= 0 (mu = mu_s, n = 1; for lift-off alone mu = 1, n = 0), in intervals of q that end at zeros of

    mu^2 F_z^2 - n F_h^2 = P2 q^2 - 2 b q + P0 .

A trajectory of the well first reaches theta with the energy `base`, the largest U between theta and the steady
precession. The first energy that breaks the limit there is base, where its q lies in no such interval, and else that
of its interval's end. The limit of a K_J is the least of these over theta. It is found on a grid for all K_J at once,
placed by polynomials through the grid's own points and made exact by Newton's step; what this does not settle is
searched on closer and closer grids.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple, TypeAlias, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import TopError, finite
from ..types import Array, Bools, Complex, Indices, Number, Scalars
from . import equations as eq
from .equations import AnyTop, f2_2
from .poles import pole_offsets
from .top import Top, TopNumbers
from .wells import ExactCurve, angle, find_stations


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


def bracket_slope(c: Number, s2: Number, top: AnyTop, K_R: Number) -> Number:
    """-dB/dc = (I3/I1) K_R (I3 + 1 - a c)/f3^3"""
    return top.I3 / top.I1 * K_R * (top.I3 + 1 - top.a * c) / eq.f3_2(c, s2, top) ** 1.5


well_slope = eq.s4_U_slope
pole_gaps = pole_offsets
ExactTop = TopNumbers

_BLOCK = 256  # K_J at once: more of them leave the processor's caches


@dataclass(frozen=True, eq=False)
class Tielines:
    """One tieline for each K_J, arrays of its shape: the trajectory of largest energy on which the top neither leaves
    the table nor (where mu_s is given) slips.

    E the largest energy (6) in MgR; theta_inner, theta_outer its turning points; theta_verge where on it the limit is
    first reached; limited_by "lift-off", "slip", "nothing" (E is inf: no energy breaks the limit) or "no motion" (E is
    nan: even the steady precession breaks it); theta_steady, E_steady the steady precession of least energy.
    """

    K_J: Array
    E: Array
    theta_inner: Array
    theta_outer: Array
    theta_verge: Array
    limited_by: NDArray[np.str_]
    theta_steady: Array
    E_steady: Array


@overload
def limit_energy(top: Top, K_J: float, K_R: float, mu_s: float | None = None) -> float: ...
@overload
def limit_energy(top: Top, K_J: Array, K_R: float, mu_s: float | None = None) -> Array: ...
def limit_energy(top: Top, K_J: Scalars, K_R: float, mu_s: float | None = None) -> Scalars:
    """The largest E (6) with F_z >= 0, and F_h <= mu_s F_z where mu_s is given, on the whole trajectory.

    For the well of the steady precession of least energy. K_J a number or an array, K_R and mu_s numbers; inf where
    nothing limits (a uniform ball), nan where even the steady precession breaks the limit. In MgR.
    """
    E = tielines(top, K_J, K_R, mu_s).E
    return E if np.ndim(K_J) else float(E)


def tielines(top: Top, K_J: ArrayLike, K_R: float, mu_s: float | None = None) -> Tielines:
    """Tielines of Fig. 5 (mu_s None: F_z >= 0) or of Fig. 6 (F_h <= mu_s F_z too). K_J of any shape, K_R a number."""
    return _tielines(top, K_J, K_R, [mu_s])[0]


def figures(top: Top, K_J: ArrayLike, K_R: float, mu_s: float) -> tuple[Tielines, Tielines]:
    """Both at once, for less than two calls: (tielines of Fig. 5, tielines of Fig. 6)."""
    lift, slip = _tielines(top, K_J, K_R, [None, mu_s])
    return lift, slip


def _tielines(top: Top, K_J: ArrayLike, K_R: float, limits: Sequence[float | None]) -> list[Tielines]:
    """Tielines for each of the limits: None for F_z >= 0 alone, or a mu_s."""
    shape, K_J = np.shape(K_J), np.asarray(K_J, dtype=float)
    if not np.all(np.isfinite(K_J)):
        raise TopError("K_J", float(K_J[~np.isfinite(K_J)].flat[0]), "finite numbers")
    K_J, K_R = K_J.ravel(), finite("K_R", K_R)
    for mu in limits:
        if mu is not None and finite("mu_s", mu) < 0:
            raise TopError("mu_s", float(mu), "mu_s >= 0")
    if not K_J.size:
        empty = np.empty(shape)
        words = np.empty(shape, "U9")
        return [Tielines(empty, empty, empty, empty, empty, words, empty, empty) for _ in limits]
    with np.errstate(all="ignore"):
        blocks = [list(_Wells(top, K_J[i : i + _BLOCK], K_R).columns(limits)) for i in range(0, K_J.size, _BLOCK)]
        columns = [zip(*parts, strict=True) for parts in zip(*blocks, strict=True)]
        return [Tielines(*(np.concatenate(part).reshape(shape) for part in parts)) for parts in columns]


# ---- one theta: everything that depends on it alone ----


class Place(NamedTuple):
    """Arrays of the shape of x, real or complex."""

    x: Number
    s2: Number
    f1: Number
    f2: Number
    drop: Number
    height: Number
    slope: Number
    N0: Number
    N1: Number
    N2: Number
    zc: Number
    zb: Number
    z1: Number
    X2: Number
    Y: Number
    A0: Number
    A1: Number
    D: Number


def _place(x: Number, north: Bools, top: AnyTop, K_R: Number) -> Place:
    """Coefficients at distance x of cos(theta) to the nearer pole: real, or complex to have derivatives (f(x + ih)/h).

    Next to the inverted pole they are those of the upright one with the signs of a, cos(theta) and K_R turned.
    """
    sign = np.where(north, 1.0, -1.0)
    I1, I3, a, K = top.I1, top.I3, sign * top.a, sign * K_R
    c, s2 = 1 - x, x * (2 - x)
    p, one = c - a, 1 - a * c
    g2 = I1 + p * p
    f1, f2 = g2 + s2, g2 + I1 / I3 * s2
    w3, lever = K / np.sqrt(I3 / I1 * f2), a / f1
    P, R, a2 = I3 * one - I1, I1 * c - I3 * p, top.a**2
    X, kappa = w3 / f2 * R, 1 - I1 / I3
    D = I3 * I3 * (1 - a2) - 2 * I1 * I3 + I1 * I1 - 2 * a2 * P + a2 * a2 * s2
    return Place(
        x=x, s2=s2, f1=f1, f2=f2, drop=kappa, height=2 * top.a * np.where(north, x, 2 - x),
        slope=pole_slope(x, a, K, top),
        # s^4 dU/dc = N0 + N1 B + N2 B^2
        N0=-2 * top.a * s2 * s2, N1=-2 * sign * (I3 + one) * w3 * s2, N2=2 * sign * (p * one + I1 * c),
        zc=1 - a2 * s2 / f1, zb=-lever * (I3 + one) * w3, z1=lever * (c * (I1 + 1 + a2) - a * (1 + c * c)),
        X2=X * X, Y=w3 / f1 * (P - a2 * s2), A0=lever * one, A1=lever * (a * p - I1),
        D=(w3 / f1) ** 2 * D - kappa * X * X * (f1 + f2) / (f1 * f1))  # fmt: skip


def _distance(theta: Array, phi: Array) -> tuple[Array, Bools]:
    """1 - cos of the nearer of theta and phi = pi - theta, and whether that is theta."""
    north = theta <= phi
    return 2 * np.sin(np.where(north, theta, phi) / 2) ** 2, north


def _angle(x: Array, north: Bools) -> Array:
    half = 2 * np.arctan2(np.sqrt(x), np.sqrt(2 - x))
    return np.where(north, half, np.pi - half)


def _interval(p: Place, B: Number, q: Number, mu: Scalars, n: Scalars) -> tuple[Number, Number]:
    """2E' at the end of the interval from q on in which the top keeps to the table (less than at q, or nan: it has no
    end), and mu F_z - n F_h at q."""
    z1 = mu * p.z1
    z0 = mu * p.zc + (mu * p.zb) * B
    margin = z0 + z1 * q
    if np.all(n == 0):
        end = z0 * (-1 / np.where(z1 == 0, 1e-300, z1))
    else:
        # F_h^2 = h0 + 2 h1 q + h2 q^2; the 1e-300 keeps the ball that needs no friction from 0/0
        A0, A1 = n * p.A0, n * p.A1
        h2 = p.s2 * A1 * A1
        h1 = A1 * p.Y * B + (n * p.X2 / 2 + p.s2 * A0 * A1)
        h0 = (n * p.D * B + 2 * A0 * p.Y) * B + (p.s2 * A0 * A0 - 1e-300)
        margin -= np.sqrt(np.maximum((2 * h1 + h2 * q) * q + h0, 0))
        P2, P0, u = z1 * z1 - h2, z0 * z0 - h0, z0 * z1
        b = h1 - u
        r = np.sqrt(h1 * (b - u) + h0 * P2 + h2 * z0 * z0)  # b^2 - P2 P0, less what cancels
        end = np.where(b >= 0, P0 / (b + r), (b - r) / P2)
    return p.f1 * end + (p.height - p.drop * B * B), margin


def _first(base: Array, end: Array, margin: Array) -> Array:
    """2E' at which the limit first breaks where the trajectory passes: base, 2E' of one that turns there, where it is
    broken at rest; end of _interval, or inf where it has none."""
    return np.where(margin < 0, base, np.where(end >= base, end, np.inf))


# ---- the grid, and polynomials through its points ----

_CELLS, _REACH = 256, 3
_FEW = 8  # points of it that a trajectory needs, or it gets a grid of its own
h = 1e-60  # f(x + ih) = f(x) + ih f'(x), to all digits
_STENCIL = np.arange(-_REACH, _REACH + 1)[:, None]
_FIT = np.linalg.inv(_STENCIL ** np.arange(2 * _REACH + 1.0))  # values on the stencil to coefficients


def _mapped(t: Array) -> Array:
    """theta at place t of the grid: closer at the poles, where U is steep."""
    X = t / _CELLS
    return np.pi * (X - 0.9 * np.sin(2 * np.pi * X) / (2 * np.pi))


GRID = np.maximum(_mapped(np.arange(_CELLS + 1.0)), 1e-100)  # and both poles, but for their zeros


def _zero(coefficients: Array, t: Array) -> tuple[Array, Number]:
    """The zero next to t of polynomials, rows of coefficients from the constant on, and the slope there."""
    for _ in range(3):
        value, slope = coefficients[-1], 0.0
        for c in coefficients[-2::-1]:
            slope = slope * t + value
            value = value * t + c
        t = t - value / slope
    return t, slope


def _newton(function: Callable[[Complex, Indices], Complex], x: Array, enough: float) -> Indices:
    """Newton's steps in place on function(x + ih, i), i indices of x, to steps of a part `enough`; the i left over."""
    i = np.arange(x.size)
    for _ in range(30):
        value = function(x[i] + h * 1j, i)
        step = value.real / value.imag * h
        x[i] = np.maximum(x[i] - step, 0)
        i = i[np.abs(step) > enough * x[i] + 10 * h]
        if not i.size:
            break
    return i


def _crossing(values: Array, i: Indices, j: Indices) -> Array:
    """Where values on stencils (stencil, k) about points i of the grid are zero, in the cells that begin at j."""
    low, r = j - i + _REACH, np.arange(len(i))
    share = values[low, r] / (values[low, r] - values[low + 1, r])
    share = np.where(j == 0, np.sqrt(share), np.where(j == _CELLS - 1, 1 - np.sqrt(1 - share), share))
    return i + _zero(_FIT @ values, j - i + share)[0]


def _least(values: Array) -> tuple[Array, Array]:
    """Where polynomials through values (stencil, k) are least, from the stencil's middle, and the curvature there."""
    fit = _FIT @ values
    return _zero(fit[1:] * np.arange(1, 2 * _REACH + 1)[:, None], -fit[1] / (2 * fit[2]))


Pair: TypeAlias = tuple[float, float]  # mu, n
Ends: TypeAlias = tuple[Array, Array]  # low, high
# of _closer: theta, what _on gives there, and what to call with the indices of the next ends
Grid: TypeAlias = tuple[Array, tuple[Place, Array, Array, Array], Callable[[Indices, Indices], None]]


class _Wells:
    """The wells of the steady precessions of least energy at one K_R, one for each K_J (k,)."""

    _AT_REST = "x s2 f2 height slope zc zb z1 Y A0 A1".split()

    def __init__(self, top: Top, K_J: Array, K_R: float) -> None:
        self.top, self.K_J, self.K_R, self.barriers = top, K_J, K_R, {}
        self.gaps, self.k = pole_gaps(top, K_J, K_R), np.arange(len(K_J))
        self.place, self.B, self.q, self.U = self._on(GRID, GRID[::-1], self.k)
        self.lowest = self.U.argmin(axis=1)
        self.theta_p = self._steady()
        rising = self.U[:, 1:] > self.U[:, :-1]
        several = np.flatnonzero((rising[:, :-1] > rising[:, 1:]).any(axis=1))
        self.barriers = {i: self._barriers(i) for i in several}
        self.base = self.U
        if self.barriers:
            _, _, self.q, self.base = self._on(GRID, GRID[::-1], self.k)

    def energy(self, e: Array) -> Array:
        """E from 2E'."""
        return (e + self.K_R**2 - self.top.I1 / self.top.I3 * self.K_J**2) / 2

    def _gap(self, north: Bools, k: Indices) -> Array:
        return np.where(north, self.gaps[0][k], self.gaps[1][k])

    def _on(self, theta: Array, phi: Array, k: Indices) -> tuple[Place, Array, Array, Array]:
        """Place, B, and the q and 2E' that first reach each theta, on grids (n,) or (k, n), for K_J of indices k."""
        x, north = _distance(theta, phi)
        p = _place(x, north, self.top, self.K_R)
        B = self._gap(north, k[:, None]) + p.x * p.slope
        q = B * B / p.s2
        U = p.f2 * q + p.height
        if not self.barriers:
            return p, B, q, U
        base, theta = U.copy(), np.broadcast_to(theta, U.shape)
        for row, i in enumerate(k):
            for place, height in self.barriers.get(i, ()):
                beyond = (theta[row] - place) * (self.theta_p[i] - place) < 0
                base[row] = np.where(beyond, np.maximum(base[row], height), base[row])
        return p, B, q + (base - U) / p.f1, base

    def _bracket(self, x: Number, north: Bools, d: Array) -> tuple[Number, Number, Number, ExactTop, Array]:
        """B, f2^2, s^2, and the top and K_R as the nearer pole sees them."""
        sign = np.where(north, 1.0, -1.0)
        t, K = ExactTop(sign * self.top.a, self.top.I1, self.top.I3), sign * self.K_R
        s2 = x * (2 - x)
        return d + x * pole_slope(x, t.a, K, t), f2_2(1 - x, s2, t), s2, t, K

    def _steady(self) -> Array:
        """theta_p: the zero of N next to the lowest point of the grid."""
        j = _clip(self.lowest, _REACH, _CELLS - _REACH)
        p, B = self.place, self.B[self.k, j + _STENCIL]
        N_near = (p.N2[j + _STENCIL] * B + p.N1[j + _STENCIL]) * B + p.N0[j + _STENCIL]
        t, _ = _zero(_FIT @ N_near, (self.lowest - j) * 1.0)
        t = j + np.where(np.abs(t) < _REACH, t, self.lowest - j)
        x, north = _distance(_mapped(t), _mapped(_CELLS - t))
        d = self._gap(north, self.k)

        def N(z: Complex, i: Indices) -> Complex:
            B, _, s2, t, K = self._bracket(z, north[i], d[i])
            return well_slope(1 - z, s2, B, -bracket_slope(1 - z, s2, t, K), t)

        left = _newton(N, x, 1e-8)
        theta = _angle(x, north)
        astray = ~(np.abs(theta - GRID[self.lowest]) <= GRID[j + 1] - GRID[j - 1])
        astray[left] = True
        astray |= (self.lowest == 0) | (self.lowest == _CELLS)
        for gap, pole, sign in zip(self.gaps, (0, np.pi), (1, -1), strict=True):
            if np.any(gap == 0):  # upright at K_J(P): U = 2 a v + f2^2 C^2 v/2 there
                a, C = sign * self.top.a, pole_slope(0.0, sign * self.top.a, sign * self.K_R, self.top)
                still = 2 * a + (self.top.I1 + (1 - a) ** 2) * C**2 / 2 > 0
                at = still & (gap == 0) & (np.abs(GRID[self.lowest] - pole) < 0.01)
                theta[at], astray[at] = pole, False
        for i in np.flatnonzero(astray):
            found = [s for s in find_stations(ExactCurve.of(self.top, self.K_J[i], self.K_R)) if s.bottom]
            # flat to the last digit, as at rest with G in O: any tilt is as low
            theta[i] = angle(max(found, key=lambda s: s.kinetic).c) if found else GRID[self.lowest[i]]
        return theta

    def _barriers(self, i: np.intp) -> list[tuple[float, float]]:
        """(theta, U) of the largest U that separate the wells of one K_J."""
        stations = find_stations(ExactCurve.of(self.top, self.K_J[i], self.K_R))
        return [(angle(s.c), -float(s.kinetic)) for s in stations if not s.bottom and s.kinetic.is_finite()]

    def columns(self, limits: Sequence[float | None]) -> Iterator[tuple[Number, ...]]:
        """The columns of Tielines for each of the limits."""
        pairs = [(1.0, 0.0) if mu is None else (float(mu), 1.0) for mu in limits]
        e, verge, normal, broken, U_p = self._limits(pairs)
        ends = self._ends(e)
        found = [self._narrow(pairs[i], e[i], verge[i], normal[i], ends[i]) for i in range(len(pairs))]
        if any(found):
            ends = self._ends(e)
        for i, (_, n) in enumerate(pairs):
            by = np.where((normal[i] > 1e-9) & (n > 0), "slip", "lift-off")
            by = np.where(broken[i], "no motion", np.where(np.isinf(e[i]), "nothing", by))
            yield self.K_J, self.energy(e[i]), *ends[i], verge[i], by, self.theta_p, self.energy(U_p)

    def _limits(self, pairs: list[Pair]) -> tuple[Array, Array, Array, Bools, Array]:
        """2E' of the limits, theta and F_z where they are reached, whether broken at rest (limits, k); U there (k,)."""
        found = []
        for mu, n in pairs:
            end, margin = _interval(self.place, self.B, self.q, mu, n)
            first = _first(self.base, end, margin)
            j = _clip(first.argmin(axis=1), 1, _CELLS - 1)
            i = _clip(j, _REACH, _CELLS - _REACH)
            about = self.k, i + _STENCIL
            found.append((j, i, first[self.k, j], end[about], margin[about], first, margin))
        j, i, most, end, margin = (np.concatenate(parts, axis=-1) for parts in list(zip(*found, strict=True))[:5])
        count, shape = len(j), (len(pairs), len(self.k))
        k, r, at = np.tile(self.k, len(pairs)), np.arange(count), j - i + _REACH
        # the limit is first broken at a turning point, where the margin there is zero,
        over = margin < 0
        left, right = over[at - 1, r] != over[at, r], over[at, r] != over[at + 1, r]
        low = at - left
        high = low + 1
        T = self.place.s2[i + _STENCIL] * margin
        corner = _crossing(T, i, low + i - _REACH) - i
        outward = over[high, r]  # the limit is broken on the side of larger theta
        # or within the trajectory, where the energy of the interval's end is least: its reciprocal is smooth also where
        # the interval loses its end
        floor = np.tile(self.U[self.k, self.lowest], len(pairs)) - 1
        y = 1 / (end - floor)
        inside, curve = _least(-y)
        beyond = np.where(outward, high, low)
        past = y[beyond, r] * (self.U[k, i + beyond - _REACH] - floor) < 1  # broken from below
        before = (curve > 0) & ((inside < corner) == outward) & (np.abs(inside - (j - i)) <= 1)
        before &= (y[at - 1, r] > 0) & (y[at + 1, r] > 0)
        at_corner = (left | right) & (past | ~before)
        t = i + _clip(np.where(at_corner, corner, inside), j - i - 1, j - i + 1)
        # exactly, by Newton's step, with the steady precessions in the same arrays
        x, north = _distance(np.append(_mapped(t), self.theta_p), np.append(_mapped(_CELLS - t), np.pi - self.theta_p))
        per_t = np.sin(_mapped(t)) * np.pi / _CELLS * (1 - 0.9 * np.cos(2 * np.pi * t / _CELLS))  # |dx/dt|
        mu, n = np.repeat(np.transpose([*pairs, (1.0, 0.0)]), shape[1], axis=1)
        d, tilt = self._gap(north, np.append(k, self.k)), per_t**2 * y[at, r] ** 2 / curve
        step = np.inf
        for _ in range(4):
            p = _place(x + h * 1j, north, self.top, self.K_R)
            B = d + p.x * p.slope
            q = B * B / np.maximum(p.s2, 1e-200)
            U = p.f2 * q + p.height
            end, margin = _interval(p, B, q, mu, n)
            M, (end_, U_) = (p.s2 * margin)[:count], (z[:count] for z in (end, U))
            rise = np.where(at_corner, U_.imag, end_.imag / 2) / h
            before, step = step, np.where(at_corner, M.real / M.imag * h, end_.imag / h * tilt)
            e = np.where(at_corner, U_.real, end_.real) - rise * step
            step = np.where(np.abs(step) < np.abs(before) / 2, step / (1 - step / before), step)  # as the last one went
            x[:count] -= step
            off = np.abs(step) / np.minimum(per_t, x[:count]) * np.where(at_corner, 1e7, 1e4)  # of what still counts
            if not np.any(off > 1):
                break
        ahead = end_.real - U_.real
        below = (n == 0) & (p.z1.real > 0)  # the interval is entered there with more energy, not left
        below = below[:count] | ~(np.abs(ahead) < 1e-3 * (1 + np.abs(U_.real)))
        falling = (end_.imag < 0) == north[:count]
        good = ~(left & right) & np.where(below, past, falling == outward)
        good = np.where(at_corner, good, (curve > 0) & (ahead > 0))
        sure = (good & (off <= 1) & (e <= most + 1e-12 * np.abs(most))).reshape(shape)
        sure &= e.reshape(shape) >= U.real[count:] - 1e-12 * np.abs(U.real[count:])
        sure[:, list(self.barriers)] = False
        e, verge = np.where(sure, e.reshape(shape), np.inf), _angle(x, north)[:count].reshape(shape)
        normal = _normal(p, B, np.append(e, U.real[count:]))[:count].real.reshape(shape)
        # at rest
        p, d = p._replace(**{name: getattr(p, name).real[count:] for name in self._AT_REST}), d[count:]
        w2 = np.where(d == 0, 0.0, d / np.sqrt(p.s2)) + np.sqrt(p.x / (2 - p.x)) * p.slope
        F_y = np.sqrt(p.s2) * (p.A0 + p.A1 * w2**2) + w2 * p.Y
        F_z = p.zc + p.zb * np.sqrt(p.s2) * w2 + p.z1 * w2**2
        broken = np.array([(F_z < 0) | (n * np.abs(F_y) > mu * F_z + 1e-12) for mu, n in pairs])
        done = np.where(at_corner, low + i - _REACH, -1).reshape(shape)  # the cell of the corner in e
        for which, (*_, first, margin) in enumerate(found):
            # what is in doubt, and where the first energy may fall lower between points of the grid than at them
            rise = first[:, 1:] - first[:, :-1]
            local = (rise[:, :-1] <= 0) & (rise[:, 1:] >= 0)
            local[self.k, found[which][0] - 1] = ~sure[which]
            rows, cells = np.divmod(np.flatnonzero(local), _CELLS - 1)
            dip = np.maximum(-rise[rows, cells], rise[rows, cells + 1])
            doubt = (first[rows, cells + 1] - dip < e[which][rows]) | (cells + 1 == found[which][0][rows])
            doubt &= np.isfinite(first[rows, cells + 1]) & ~broken[which][rows]
            rows, begin = rows[doubt], cells[doubt]
            # and the other turning points where the margin is zero: between them the grid may have one point or none
            below = np.where(broken[which], -np.inf, e[which])
            more, cell = self._turns(margin, below, np.where(sure[which], done[which], -1))
            rows, begin, end = np.append(rows, more), np.append(begin, cell), np.append(begin + 2, cell + 1)
            if len(rows):
                ends = [(grid[begin], grid[end]) for grid in (GRID, GRID[::-1])]
                self._search(pairs[which], rows, ends, e[which], verge[which], normal[which])
        verge[~np.isfinite(e) | broken] = np.nan
        return np.where(broken, np.nan, e), verge, normal, broken, p.height + p.f2 * w2**2

    def _turns(self, margin: Array, e: Array, done: Array) -> tuple[Indices, Indices]:
        """Rows and cells of the grid, but for those done, where a turning point below e may be without margin."""
        over = margin < 0
        k, cell = np.divmod(np.flatnonzero(over[:, 1:] != over[:, :-1]), _CELLS)
        below = (np.minimum(self.base[k, cell], self.base[k, cell + 1]) < e[k]) & (cell != done[k])
        k, cell = k[below], cell[below]
        if not k.size:
            return k, cell
        i = _clip(cell, _REACH, _CELLS - _REACH)
        about = k, i + _STENCIL
        t = _crossing(self.place.s2[about[1]] * margin[about], i, cell) - i
        gap = self.place.s2[about[1]] * (self.base[about] - e[k])
        above = (_FIT @ gap * t ** np.arange(2 * _REACH + 1)[:, None]).sum(axis=0)
        clear = (t >= cell - i) & (t <= cell + 1 - i) & (above > 1e-5 * np.abs(np.diff(gap, axis=0)).max(axis=0))
        clear[np.isin(k, list(self.barriers))] = False
        return k[~clear], cell[~clear]

    def _search(self, pair: Pair, k: Indices, ends: list[Ends], e: Array, verge: Array, normal: Array) -> None:
        """Closer and closer grids between ends, for K_J of indices k: writes what is below e."""
        for theta, (p, B, q, base), closer in self._closer(k, ends):
            end, margin = _interval(p, B, q, *pair)
            first = _first(base, end, margin)
            at = first.argmin(axis=1)
            closer(np.maximum(at - 1, 0), np.minimum(at + 1, theta.shape[1] - 1))
        r = np.arange(len(k))
        least, F_z = first[r, at], _normal(p, B, first)[r, at]
        for i, value, place, z in zip(k, least, theta[r, at], F_z, strict=True):
            if value < e[i]:
                e[i], verge[i], normal[i] = value, place, z

    def _narrow(self, pair: Pair, e: Array, verge: Array, normal: Array, ends: Array) -> bool:
        """As _search, in those trajectories in which the grid has few points: whether it found less."""
        count = ((self.base[:, 1:-1] <= e[:, None]) & np.isfinite(e[:, None])).sum(axis=1)
        k = np.flatnonzero(np.isfinite(e) & (count < _FEW) & (ends[1] > ends[0]))
        if not k.size:
            return False
        share, before = np.linspace(0, 1, _CELLS + 1), e.copy()
        theta = ends[0][k, None] + (ends[1] - ends[0])[k, None] * share
        p, B, q, base = self._on(theta, np.pi - theta, k)
        end, margin = _interval(p, B, q, *pair)
        first = _first(base, end, margin)
        cells = (margin[:, 1:] < 0) != (margin[:, :-1] < 0)
        least = _clip(first.argmin(axis=1), 1, _CELLS - 1)
        rows, cell = np.nonzero(cells)
        rows, low, high = np.append(rows, np.arange(len(k))), np.append(cell, least - 1), np.append(cell + 1, least + 1)
        low, high = theta[rows, low], theta[rows, high]
        self._search(pair, k[rows], [(low, high), (np.pi - low, np.pi - high)], e, verge, normal)
        return bool(np.any(e < before))

    def _closer(self, k: Indices, ends: list[Ends]) -> Iterator[Grid]:
        """Grids that close in, for K_J of indices k, from both ends (low, high) of theta and of pi - theta."""
        share, r, ends = np.arange(33) / 32, np.arange(len(k)), [np.array(pair) for pair in ends]

        def closer(low: Indices, high: Indices) -> None:
            ends[:] = [np.array([grid[r, low], grid[r, high]]) for grid in (theta, phi)]

        for _ in range(20):
            theta, phi = (low[:, None] + (high - low)[:, None] * share for low, high in ends)
            yield theta, self._on(theta, phi, k), closer
            if all(
                (np.abs(high - low) <= 1e-16 * np.minimum(ends[0].max(), ends[1].max())).all() for low, high in ends
            ):
                break

    def _ends(self, e: Array) -> Array:
        """theta at both turning points of the trajectories of energies e (limits, k) in these wells: (limits, 2, k)."""
        insides = [self.base <= energy[:, None] for energy in e]
        within = np.array([(inside.argmax(axis=1), _CELLS - inside[:, ::-1].argmax(axis=1)) for inside in insides])
        none = ~(self.base[self.k, within[:, 0]] <= e)
        j = _clip(within - [[1], [0]], 0, _CELLS - 1).ravel()
        i = _clip(j, _REACH, _CELLS - _REACH)
        k, energy = np.tile(self.k, 2 * len(e)), np.repeat(e, 2, axis=0).ravel()
        gap = self.place.s2[i + _STENCIL] * (energy - self.U[k, i + _STENCIL])
        t = np.where(within.ravel() % _CELLS, _crossing(gap, i, j), within.ravel())  # or through a pole
        x, north = _distance(_mapped(t), _mapped(_CELLS - t))
        d = self._gap(north, k)

        def D(z: Complex, i: Indices) -> Complex:
            B, f2, s2, _, _ = self._bracket(z, north[i], d[i])
            return s2 * (energy[i] - 2 * self.top.a * np.where(north[i], z, 2 - z)) - f2 * B * B

        _newton(D, x, 1e-6)
        theta = _angle(x, north).reshape(within.shape)
        theta[:, 0][np.isinf(e)], theta[:, 1][np.isinf(e)] = 0.0, np.pi
        # where the grid has no point within, or a barrier: closer and closer to the first point too high beyond theta_p
        for side, sign in enumerate((1, -1)):
            gone = sign * (theta[:, side] - self.theta_p) > 0
            doubt = np.isfinite(e) & (gone | none | np.isnan(theta[:, side]))
            doubt[:, list(self.barriers)] = np.isfinite(e[:, list(self.barriers)])
            which, rows = np.nonzero(doubt)
            if len(rows):
                theta[which, side, rows] = self._end(rows, e[which, rows], sign)
        return theta

    def _end(self, k: Indices, e: Array, sign: int) -> Array:
        """The turning point on one side of theta_p (1: inner, -1: outer), for K_J of indices k."""
        beyond = (sign * (GRID - self.theta_p[k, None]) < 0) & (self.base[k] > e[:, None])
        low = np.where(sign > 0, _CELLS - beyond[:, ::-1].argmax(axis=1), beyond.argmax(axis=1))
        high = np.searchsorted(GRID, self.theta_p[k], side="left" if sign > 0 else "right") - (sign < 0)
        if sign < 0:
            low, high = high, low
        for theta, (_, _, _, base), closer in self._closer(k, [(grid[low], grid[high]) for grid in (GRID, GRID[::-1])]):
            allowed = (base <= e[:, None]) | (sign * (theta - self.theta_p[k, None]) >= 0)
            at = np.where(sign > 0, allowed.argmax(axis=1), theta.shape[1] - allowed[:, ::-1].argmax(axis=1))
            at = _clip(at, 1, theta.shape[1] - 1)
            closer(at - 1, at)
        r = np.arange(len(k))
        return (theta[r, at - 1] + theta[r, at]) / 2


def _normal(p: Place, B: Number, e: Number) -> Number:
    """F_z at 2E' = e."""
    return p.zc + p.zb * B + p.z1 * (e - p.height + p.drop * B * B) / p.f1


def _clip(x: Number, low: Number, high: Number) -> Number:
    return np.minimum(np.maximum(x, low), high)  # np.clip takes ten times as long on arrays this short
