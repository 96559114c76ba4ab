"""How far a rolling top can go: the tielines of Figs. 5 and 6, and the energies that end them.

With w2 = B/s and the excess x = 2E' - U, so that f1^2 theta_dot^2 = x, the forces at a theta are (forces.py)

    F_z = z0 + z1 x ,   F_y = y0 + y1 x ,   F_x^2 = x1 x ,

so the top lifts off where a linear function of the energy vanishes, and slips where a quadratic does,

    (y1^2 - mu^2 z1^2) x^2 + (x1 + 2 y0 y1 - 2 mu^2 z0 z1) x + y0^2 - mu^2 z0^2 = 0 .

A trajectory in the well of theta_p reaches theta when its energy is at least the largest U between. The limit of a K_J
is the least over theta of the first energy from there on that breaks it. Everything is found on a grid of theta for all
K_J at once, then refined: a least value inside by parabolas, one where the violation meets the turning point as a zero.
"""

from collections import namedtuple
from dataclasses import dataclass
from decimal import Decimal

import numpy as np

from .constants import Constants, Exact, f1_2, f2_2, f3_2, versines
from .curve import bracket_slope, find_stations, near_pole, omega2_at, pole_gaps, turning_points, well_slope
from .errors import TopError, finite

Rows = namedtuple("Rows", "height G s f2 Zc Zl Zq Yc Yl Yq z1 y1 x1")


@dataclass(frozen=True, eq=False)
class Tielines:
    """One tieline for each K_J, arrays of its shape: the trajectory of largest energy on which the top neither leaves the
    table nor (where mu_s is given) slips.

    E the largest energy (6) in MgR; theta_inner, theta_outer its turning points; theta_verge where on it the limit is
    first reached; limited_by "lift-off", "slip", "nothing" (E is inf: no energy breaks the limit) or "no motion" (E is
    nan: even the steady precession breaks it); theta_steady, E_steady the steady precession of least energy.
    """

    K_J: np.ndarray
    E: np.ndarray
    theta_inner: np.ndarray
    theta_outer: np.ndarray
    theta_verge: np.ndarray
    limited_by: np.ndarray
    theta_steady: np.ndarray
    E_steady: np.ndarray


def limit_energy(top, K_J, K_R, mu_s=None):
    """The largest E (6) with F_z >= 0, and F_h <= mu_s F_z where mu_s is given, on the whole trajectory.

    For the well of the steady precession of least energy. K_J a number or an array, K_R and mu_s numbers; inf where
    nothing limits (a uniform ball), nan where even the steady precession breaks the limit. In MgR.
    """
    E = tielines(top, K_J, K_R, mu_s).E
    return E if np.ndim(K_J) else float(E)


def tielines(top, K_J, K_R, mu_s=None):
    """Tielines of Fig. 5 (mu_s None: F_z >= 0) or of Fig. 6 (F_h <= mu_s F_z too). K_J of any shape, K_R a number."""
    if mu_s is None:
        return _tielines(top, K_J, K_R, [None])[0]
    return _tielines(top, K_J, K_R, [mu_s])[0]


def figures(top, K_J, K_R, mu_s):
    """Both at once, for less than two calls: (tielines of Fig. 5, tielines of Fig. 6)."""
    return tuple(_tielines(top, K_J, K_R, [None, mu_s]))


# ---- the grid: every coefficient that depends on theta alone ----

_X = (np.arange(512) + 0.5) / 512
GRID = np.pi * (_X - 0.9 * np.sin(2 * np.pi * _X) / (2 * np.pi))  # closer at the poles, where U is steep


def _rows(theta, top, K_R):
    a, I1 = top.a, top.I1
    c, s = np.cos(theta), np.sin(theta)
    s2 = s * s
    f1, f2, f3 = f1_2(c, top), f2_2(c, s2, top), np.sqrt(f3_2(c, s2, top))
    w3, ratio, lever = K_R / f3, top.I3 / I1 * (c - a), a / f1
    g = top.I3 / I1 * (top.I3 + 1 - a * c) * w3 / (f3 * f3)
    k = c * (I1 + 1 + a * a) - a * (1 + c * c)
    y, one = lever * s * (a * (c - a) - I1), 1 - a * c
    return Rows(
        height=2 * a * (1 - c), G=ratio * w3, s=s, f2=f2,
        Zc=1 - lever * a * s2, Zl=-lever * f2 * g * s, Zq=lever * k,
        Yc=lever * s * one, Yl=one * f2 * g / f1 - w3, Yq=y,
        z1=lever * k / f1, y1=y / f1, x1=(top.I3 * w3 / (f3 * f3) * (c - ratio)) ** 2 / f1)  # fmt: skip


def _at_rest(rows, K_J):
    """U, z0 and y0."""
    w = (K_J - rows.G) / rows.s
    w_sq = w * w
    U = rows.f2 * w_sq
    U += rows.height
    z0 = rows.Zq * w_sq
    w_sq *= rows.Yq
    z0 += rows.Zl * w
    z0 += rows.Zc
    w *= rows.Yl
    w += w_sq
    w += rows.Yc
    return U, z0, w


def _lift(rows, z):
    """The least excess, from z = F_z at none on, at which F_z < 0; inf where none is."""
    with np.errstate(divide="ignore", invalid="ignore"):
        x = z * np.where(rows.z1 < 0, -1 / rows.z1, np.inf)
    return np.maximum(x, 0, out=x)


def _slip(rows, z, y, x, mu):
    """The least excess, from F_z = z, F_y = y and F_x^2 = x on, at which F_h > mu F_z; inf where none is."""
    C = mu * z
    B = C * (-2 * mu * rows.z1)
    B += (2 * rows.y1) * y
    B += rows.x1
    broken = C < 0
    C *= -C
    C += y * y
    C += x
    root = B * B
    root -= (4 * (rows.y1**2 - (mu * rows.z1) ** 2)) * C
    with np.errstate(divide="ignore", invalid="ignore"):
        np.sqrt(root, out=root)
        root += B
        broken |= C > 1e-24
        C *= -2
        C /= root
        # no zero ahead: a negative discriminant, or both zeros behind
        C[~(root > 0)] = np.inf
    C[broken] = 0
    return C


# ---- the limits ----


def _tielines(top, K_J, K_R, limits):
    """Tielines for each of the limits: None for F_z >= 0 alone, or a mu_s."""
    shape, K_J = np.shape(K_J), np.asarray(K_J, dtype=float)
    if not np.all(np.isfinite(K_J)):
        raise TopError("K_J", float(K_J[~np.isfinite(K_J)].flat[0]), "finite numbers")
    K_J, K_R = K_J.ravel(), finite("K_R", K_R)
    for mu in limits:
        if mu is not None and finite("mu_s", mu) < 0:
            raise TopError("mu_s", float(mu), "mu_s >= 0")
    well = _Wells(top, K_J, K_R)
    lift, results = _lift(well.rows, well.z), []
    for mu in limits:
        first = well.base + (lift if mu is None else np.minimum(lift, _slip(well.rows, well.z, well.y, well.x, mu)))
        e, verge, slips = well.least(first, mu)
        broken = well.broken(mu)
        e = np.where(broken, np.nan, e)
        inner, outer = well.ends(e)
        by = np.where(broken, "no motion", np.where(np.isinf(e), "nothing", np.where(slips, "slip", "lift-off")))
        verge = np.where(np.isfinite(e), verge, np.nan)
        parts = [K_J, well.energy(e), inner, outer, verge, by, well.theta_p, well.energy(well.U_p)]
        results.append(Tielines(*(np.reshape(part, shape) for part in parts)))
    return results


class _Wells:
    """The wells of the steady precessions of least energy at one K_R, one for each K_J (k,), on the grid (k, n)."""

    def __init__(self, top, K_J, K_R):
        self.top, self.K_J, self.K_R = top, K_J, K_R
        self.gaps = pole_gaps(top, K_J, K_R)
        self.rows = _rows(GRID, top, K_R)
        U, self.z, self.y = _at_rest(self.rows, K_J[:, None])
        self.lowest = U.argmin(axis=1)
        self.theta_p, self.U_p = self._steady()
        rising = U[:, 1:] > U[:, :-1]
        several = np.flatnonzero((rising[:, :-1] > rising[:, 1:]).any(axis=1))
        self.barriers = {i: self._barriers(i) for i in several}
        self.base, self.x = U, 0.0
        if self.barriers:
            self.base = self._base(U, GRID)
            over = self.base - U
            self.z, self.y, self.x = self.z + self.rows.z1 * over, self.y + self.rows.y1 * over, self.rows.x1 * over

    def energy(self, e):
        """E from 2E'."""
        return (e + self.K_R**2 - self.top.I1 / self.top.I3 * self.K_J**2) / 2

    def _steady(self):
        """theta_p and U there: the zero of N next to the lowest point of the grid."""
        top, K_R, j = self.top, self.K_R, self.lowest
        low, high = GRID[np.maximum(j - 1, 0)], GRID[np.minimum(j + 1, len(GRID) - 1)]
        theta = _zero(lambda t: self._slope(t), low, high)
        edge = (j < 2) | (j > len(GRID) - 3) | ~np.isfinite(theta)
        for i in np.flatnonzero(edge):
            found = [x for x in find_stations(top, Exact(*(Decimal(float(x)) for x in (self.K_J[i], K_R, 0)))) if x.bottom]
            best = max(found, key=lambda x: x.gap)
            theta[i] = 2 * np.arctan2(float(1 - best.c) ** 0.5, float(1 + best.c) ** 0.5)
        v, m = versines(theta)
        w2 = omega2_at(v, m, top, K_R, self.gaps)
        return theta, 2 * top.a * v + f2_2(1 - v, v * m, top) * w2**2

    def _slope(self, theta):
        c, s2 = np.cos(theta), np.sin(theta) ** 2
        B = self.K_J - self.top.I3 / self.top.I1 * (c - self.top.a) * self.K_R / np.sqrt(f3_2(c, s2, self.top))
        return well_slope(c, s2, B, -bracket_slope(c, s2, self.top, self.K_R), self.top)

    def _barriers(self, i):
        """(theta, U) of the largest U that separate the wells of one K_J."""
        stations = find_stations(self.top, Exact(*(Decimal(float(x)) for x in (self.K_J[i], self.K_R, 0))))
        tops = [x for x in stations if not x.bottom and x.gap.is_finite()]
        return [(2 * np.arctan2(float(1 - x.c) ** 0.5, float(1 + x.c) ** 0.5), -float(x.gap)) for x in tops]

    def _base(self, U, theta):
        """The least energy with which each theta is reached: the largest U between it and theta_p."""
        base = U.copy()
        theta = np.broadcast_to(theta, U.shape)
        for i, tops in self.barriers.items():
            for place, height in tops:
                beyond = (theta[..., i, :] - place) * (self.theta_p[i] - place) < 0
                base[..., i, :] = np.where(beyond, np.maximum(base[..., i, :], height), base[..., i, :])
        return base

    def broken(self, mu):
        """Whether the steady precession itself breaks the limit."""
        rows = _rows(np.clip(self.theta_p, 1e-9, np.pi - 1e-9), self.top, self.K_R)
        v, m = versines(self.theta_p)
        w = omega2_at(v, m, self.top, self.K_R, self.gaps)
        z, y = rows.Zc + rows.Zl * w + rows.Zq * w * w, rows.Yc + rows.Yl * w + rows.Yq * w * w
        return z < 0 if mu is None else (z < 0) | (np.abs(y) > mu * z + 1e-12)

    def _first(self, theta, mu):
        """Base, the first energy from it on that breaks the limit, and how far the limit is at the base, for theta (j, k)."""
        rows = _rows(theta, self.top, self.K_R)
        U, z, y = _at_rest(rows, self.K_J)
        base, x = U, 0.0
        if self.barriers:
            base = self._base(U[..., None], theta[..., None])[..., 0]
            over = base - U
            z, y, x = z + rows.z1 * over, y + rows.y1 * over, rows.x1 * over
        excess = lift = _lift(rows, z)
        if mu is None:
            return base, base + lift, z, False
        slip = _slip(rows, z, y, x, mu)
        excess = np.minimum(lift, slip)
        return base, base + excess, mu * z - np.sqrt(y * y + x), slip < lift * (1 - 1e-9)

    def least(self, first, mu):
        """2E' of the limit, the theta where it is reached, and whether it is slipping: the least of `first` over theta."""
        k, n = np.arange(len(self.K_J)), len(GRID)
        j = first.argmin(axis=1)
        left, right = GRID[np.maximum(j - 1, 0)], GRID[np.minimum(j + 1, n - 1)]
        broken = first == self.base
        # where the violation meets the turning points between two points of the grid, that is a corner
        here, before, after = broken[k, j], broken[k, np.maximum(j - 1, 0)], broken[k, np.minimum(j + 1, n - 1)]
        on_left = np.where(here, ~before, before) & (before != here)
        on_right = np.where(here, ~after, after) & (after != here) & ~on_left
        corner = on_left | on_right
        middle = GRID[j]
        with np.errstate(invalid="ignore", divide="ignore"):
            edge = _zero(lambda t: self._first(t, mu)[2], np.where(on_left, left, middle), np.where(on_right, right, middle))
            edge = np.where(corner & np.isfinite(edge), edge, middle)
            # the allowed side of a corner: from it inwards
            left = np.where(corner & (np.where(on_left, before, here)), edge, left)
            right = np.where(corner & (np.where(on_right, after, here)), edge, right)
            theta = _least(lambda t: self._first(t, mu)[1], left, right)
            candidates = np.array([theta, edge, middle])
            base, e, _, slips = self._first(candidates, mu)
        e[1] = np.where(corner, base[1], e[1])
        best = np.nanargmin(np.where(np.isnan(e), np.inf, e), axis=0)
        slips = np.broadcast_to(slips, e.shape)[best, k]
        if mu is not None:
            slips = slips | (corner & (best == 1) & (self._normal(edge, base[1]) > 1e-9))
        return e[best, k], candidates[best, k], slips

    def _normal(self, theta, e):
        """F_z at theta on the trajectory of energy e."""
        rows = _rows(theta, self.top, self.K_R)
        U, z, _ = _at_rest(rows, self.K_J)
        return z + rows.z1 * (e - U)

    def ends(self, e):
        """theta at the turning points of the trajectories of energy e in these wells."""
        n, k = len(GRID), np.arange(len(e))
        inside = self.base <= e[:, None]
        some = inside.any(axis=1)
        first, last = inside.argmax(axis=1), n - 1 - inside[:, ::-1].argmax(axis=1)
        ends = []
        for j, step in ((first, -1), (last, 1)):
            j = np.where(some, j, self.lowest)
            beyond = np.clip(j + step, 0, n - 1)
            with np.errstate(invalid="ignore", divide="ignore"):
                share = (e - self.base[k, j]) / (self.base[k, beyond] - self.base[k, j])
                share = np.where((share >= 0) & (share <= 1), share, 0)
                guess = GRID[j] + share * (GRID[beyond] - GRID[j])
                curvature = np.abs(self.base[k, self.lowest] - self.U_p) / (GRID[self.lowest] - self.theta_p) ** 2
                near = np.sqrt(np.maximum(e - self.U_p, 0) / curvature)
                guess = np.where(some, guess, self.theta_p + step * np.where(np.isfinite(near), near, 0))
            ends.append(guess)
        with np.errstate(invalid="ignore", divide="ignore"):
            theta = self._turning(np.array(ends), e)
        theta[:, np.isinf(e)] = np.array([[0.0], [np.pi]])
        for i in self.barriers:
            if np.isfinite(e[i]):
                theta[:, i] = self._exact_ends(i, e[i])
        return theta

    def _turning(self, theta, e):
        """Newton's steps to the zeros of D = s^2 (e - U) in the distance of cos(theta) to the nearer pole."""
        top = self.top
        v, m = versines(theta)
        north = theta < np.pi / 2
        x, a, K = np.where(north, v, m), np.where(north, top.a, -top.a), np.where(north, self.K_R, -self.K_R)
        delta, gamma = top.I1 / top.I3, top.I3 / top.I1
        for _ in range(6):
            v, m = np.where(north, x, 2 - x), np.where(north, 2 - x, x)
            d, near, C = near_pole(v, m, top, self.K_R, self.gaps)
            B, c, s2 = d + near * C, 1 - x, x * (2 - x)
            f2, f3 = top.I1 + delta * s2 + (c - a) ** 2, np.sqrt(top.I3 + s2 + gamma * (c - a) ** 2)
            rest = e - 2 * top.a * v
            dB, df2 = -gamma * K * (top.I3 + 1 - a * c) / f3**3, 2 * ((c - a) - delta * c)
            D = s2 * rest - f2 * B * B
            slope = 2 * a * s2 - 2 * c * rest - B * (df2 * B + 2 * f2 * dB)  # dD/dc
            x = np.clip(x + D / slope, 0, 2)
        half = np.arctan2(np.sqrt(x), np.sqrt(2 - x))
        return np.where(north, 2 * half, np.pi - 2 * half)

    def _exact_ends(self, i, e):
        """As turning_points has them, where several wells make the grid's choice of zeros doubtful."""
        E = float(self.energy(e)[i])
        pairs = turning_points(self.top, Constants(self.K_J[i], self.K_R, E))
        return min(pairs, key=lambda p: max(p[0] - self.theta_p[i], self.theta_p[i] - p[1]))


def _zero(function, low, high):
    """Zeros of function(theta (k,)) between low and high (k,): secant steps kept in the bracket. nan without a change of sign."""
    f_low, f_high = function(low), function(high)
    changes = f_low * f_high <= 0
    x0, x1, f0, f1 = low, high, f_low, f_high
    for _ in range(5):
        with np.errstate(invalid="ignore", divide="ignore"):
            x = x1 - f1 * (x1 - x0) / (f1 - f0)
        x = np.where(np.isfinite(x), np.clip(x, low, high), x1)
        x0, f0, x1, f1 = x1, f1, x, function(x)
    return np.where(changes, x1, np.nan)


def _least(function, left, right):
    """Where function((3, k)) is least between left and right (k,), by parabolas on ever closer points."""
    centre, h = (left + right) / 2, (right - left) / 2
    for shrink in (0.05, 0.01, 0.0):
        low, high = np.maximum(centre - h, left), np.minimum(centre + h, right)
        y0, y1, y2 = function(np.array([low, (low + high) / 2, high]))
        half = (high - low) / 2
        step = half * (y0 - y2) / (2 * (y0 - 2 * y1 + y2))
        lowest = np.array([low, (low + high) / 2, high])[np.argmin([y0, y1, y2], axis=0), np.arange(len(y0))]
        vertex = (low + high) / 2 + step
        inside = (vertex >= low) & (vertex <= high) & (y0 - 2 * y1 + y2 > 0)
        centre = np.where(inside, vertex, lowest)
        h = h * shrink
    return centre
