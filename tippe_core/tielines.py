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

import numpy as np

from .constants import Constants, f1_2, f2_2, f3_2, versines
from .curve import ExactCurve, angle, bracket_slope, find_stations, pole_gaps, pole_slope, turning_points, well_slope
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

_X = (np.arange(256) + 0.5) / 256
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
    """The excess, counted from where F_z = z, at which F_z falls to 0: negative where it is below already; inf if never."""
    return z * np.where(rows.z1 < 0, -1 / rows.z1, np.inf)


def _slip(rows, z, y, x, mu):
    """The same for F_h rising to mu F_z, counted from where F_z = z, F_y = y and F_x^2 = x."""
    C = mu * z
    B = C * (-2 * mu * rows.z1)
    B += (2 * rows.y1) * y
    B += rows.x1
    over = C < 0
    C *= -C
    C += y * y
    C += x
    over |= C > 1e-24
    root = B * B
    root -= (4 * (rows.y1**2 - (mu * rows.z1) ** 2)) * C
    np.sqrt(root, out=root)
    root += B
    C *= -2
    C /= root
    # no zero ahead: a negative discriminant, or both zeros behind
    np.copyto(C, np.inf, where=~(root > 0))
    np.copyto(C, np.minimum(C, 0) if over.any() else C, where=over)
    C[over & ~(root > 0)] = -np.inf
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
    if not K_J.size:
        empty = np.empty(shape)
        return [Tielines(*[empty] * 5, np.empty(shape, "U9"), empty, empty) for _ in limits]
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        return [Tielines(*(np.reshape(part, shape) for part in parts)) for parts in _solved(top, K_J, K_R, limits)]


def _solved(top, K_J, K_R, limits):
    """The columns of Tielines for each of the limits."""
    well = _Wells(top, K_J, K_R)
    e, verge, slips, broken = (np.reshape(part, (len(limits), -1)) for part in well.limits(limits))
    for which, i in zip(*np.nonzero(well.narrow(e)), strict=True):
        e[which, i], verge[which, i], slips[which, i] = _closer(well, i, limits[which])
    inner, outer = well.ends(e)
    for i in range(len(limits)):
        by = np.where(broken[i], "no motion", np.where(np.isinf(e[i]), "nothing", np.where(slips[i], "slip", "lift-off")))
        place = np.where(np.isfinite(e[i]), verge[i], np.nan)
        yield K_J, well.energy(e[i]), inner[i], outer[i], place, by, well.theta_p, well.energy(well.U_p)


def _closer(well, i, mu):
    """2E', theta and whether it slips, for a tieline too short for the grid: on ever closer grids about theta_p."""
    theta, grid = well.theta_p[i], well.grid
    for _ in range(8):
        j = np.searchsorted(grid, theta)
        low, high = (grid[j - 4] if j >= 4 else 0.0), (grid[j + 3] if j + 3 < len(grid) else np.pi)
        grid = low + (high - low) * (np.arange(len(GRID)) + 0.5) / len(GRID)
        part = _Wells(well.top, well.K_J[i : i + 1], well.K_R, grid, well.theta_p[i : i + 1])
        e, verge, slips, _ = part.limits([mu])
        if not part.narrow(e[None])[0, 0]:
            break
    return e[0], verge[0], slips[0]


class _Wells:
    """The wells of the steady precessions of least energy at one K_R, one for each K_J (k,), on the grid (k, n)."""

    def __init__(self, top, K_J, K_R, grid=GRID, theta_p=None):
        self.top, self.K_J, self.K_R, self.grid = top, K_J, K_R, grid
        self.gaps = pole_gaps(top, K_J, K_R)
        self.rows = _rows(grid, top, K_R)
        U, self.z, self.y = _at_rest(self.rows, K_J[:, None])
        self.lowest = U.argmin(axis=1)
        self.theta_p = self._steady(U) if theta_p is None else theta_p
        self.at_p = _at_rest(_rows(_clip(self.theta_p, 1e-9, np.pi - 1e-9), top, K_R), K_J)
        self.U_p = self.at_p[0]
        rising = U[:, 1:] > U[:, :-1]
        several = np.flatnonzero((rising[:, :-1] > rising[:, 1:]).any(axis=1))
        self.barriers = {i: self._barriers(i) for i in several}
        self.base, self.x = U, 0.0
        if self.barriers:
            self.base = self._base(U, grid)
            over = self.base - U
            self.z, self.y, self.x = self.z + self.rows.z1 * over, self.y + self.rows.y1 * over, self.rows.x1 * over

    def energy(self, e):
        """E from 2E'."""
        return (e + self.K_R**2 - self.top.I1 / self.top.I3 * self.K_J**2) / 2

    def _steady(self, U):
        """theta_p: the zero of N next to the lowest point of the grid."""
        top, k, n = self.top, np.arange(len(self.K_J)), len(GRID)
        j = _clip(self.lowest, 1, n - 2)
        theta, _ = _vertex(np.array([GRID[j + i] for i in (-1, 0, 1)]), np.array([U[k, j + i] for i in (-1, 0, 1)]))
        h = 1e-6
        for _ in range(3):
            N = self._slope(np.array([theta - h, theta + h]))
            step = h * (N[0] + N[1]) / (N[1] - N[0])
            theta = theta - step
            if not np.any(np.abs(step) > 1e-7):
                break
        edge = (self.lowest < 4) | (self.lowest > n - 5)
        astray = ~(np.abs(step) < 1e-9) | ~(np.abs(theta - GRID[j]) <= GRID[j + 1] - GRID[j - 1])
        for gap, pole, a, K in zip(self.gaps, (0, np.pi), (top.a, -top.a), (self.K_R, -self.K_R), strict=True):
            # upright at K_J(P): U = 2 a v + f2^2 C^2 v/2 there
            still = 2 * a + (top.I1 + (1 - a) ** 2) * pole_slope(0.0, a, K, top) ** 2 / 2 > 0
            at = still & (gap == 0) & (np.abs(GRID[self.lowest] - pole) < 0.01)
            theta[at], edge[at], astray[at] = pole, False, False
        for i in np.flatnonzero(edge | astray):
            found = [x for x in find_stations(ExactCurve.of(top, self.K_J[i], self.K_R)) if x.bottom]
            theta[i] = angle(max(found, key=lambda x: x.gap).c)
        return theta

    def _slope(self, theta):
        c, s2 = np.cos(theta), np.sin(theta) ** 2
        B = self.K_J - self.top.I3 / self.top.I1 * (c - self.top.a) * self.K_R / np.sqrt(f3_2(c, s2, self.top))
        return well_slope(c, s2, B, -bracket_slope(c, s2, self.top, self.K_R), self.top)

    def _barriers(self, i):
        """(theta, U) of the largest U that separate the wells of one K_J."""
        stations = find_stations(ExactCurve.of(self.top, self.K_J[i], self.K_R))
        tops = [x for x in stations if not x.bottom and x.gap.is_finite()]
        return [(angle(x.c), -float(x.gap)) for x in tops]

    def _base(self, U, theta, k=None):
        """The least energy with which each theta is reached: the largest U between it and theta_p.

        U (k, n) on the grid, or U and theta (..., i) for the K_J of the indices k (i,).
        """
        base, theta = U.copy(), np.broadcast_to(theta, U.shape)
        for i, tops in self.barriers.items():
            at = (i,) if k is None else (..., k == i)
            for place, height in tops:
                beyond = (theta[at] - place) * (self.theta_p[i] - place) < 0
                base[at] = np.where(beyond, np.maximum(base[at], height), base[at])
        return base

    def _forces(self, theta, k):
        """Rows, base, and F_z, F_y and F_x^2 there, at theta (..., i) for the K_J of the indices k (i,)."""
        rows = _rows(theta, self.top, self.K_R)
        U, z, y = _at_rest(rows, self.K_J[k])
        base, x = U, 0.0
        if self.barriers:
            base = self._base(U, theta, k)
            over = base - U
            z, y, x = z + rows.z1 * over, y + rows.y1 * over, rows.x1 * over
        return rows, base, z, y, x

    def _span(self, e):
        """First and last point of the grid on the trajectories of energies e (k,); the first after the last where none is."""
        inside = self.base <= e[:, None]
        first, last = inside.argmax(axis=1), len(self.grid) - 1 - inside[:, ::-1].argmax(axis=1)
        return first, np.where(inside[np.arange(len(e)), first], last, -1)

    def narrow(self, e):
        """Where a trajectory of energy e (limits, k) has fewer than six points of the grid."""
        return np.isfinite(e) & [last - first < 5 for first, last in map(self._span, e)]

    def limits(self, limits):
        """2E' of each limit, the theta where it is reached, whether by slipping, and whether at rest already: (limits, k)."""
        count, n = len(self.K_J), len(self.grid)
        lift = _lift(self.rows, self.z)
        j, stencil = [], []
        for mu in limits:
            excess = lift if mu is None else np.minimum(lift, _slip(self.rows, self.z, self.y, self.x, mu))
            first = np.maximum(excess, 0)
            first += self.base
            least = _clip(first.argmin(axis=1), 1, n - 2)
            j.append(least)
            stencil.append(excess[np.arange(count), [least - 1, least, least + 1]])
        k, j = np.tile(np.arange(count), len(limits)), np.concatenate(j)
        mu = np.repeat([np.inf if mu is None else mu for mu in limits], count)
        excess = np.concatenate(stencil, axis=1)
        at = np.array([j - 1, j, j + 1])
        theta = self.grid[at]
        base, margin = self.base[k, at], _margin(self.z[k, at], self.y[k, at], self.x[k, at] if self.barriers else 0.0, mu)
        over = excess < 0
        e_corner, corner, normal = self._corner(theta, over, margin, k, mu)
        e_inside, inside, slipping = self._inside(theta, base + excess, over, np.isfinite(e_corner), corner, k, mu)
        at_corner = e_corner < e_inside
        e, verge = np.where(at_corner, (e_corner, corner), (e_inside, inside))
        missed = ~np.isfinite(e) & np.isfinite(base[1] + np.maximum(excess[1], 0))
        e, verge = np.where(missed, base[1] + np.maximum(excess[1], 0), e), np.where(missed, theta[1], verge)
        U, z, y = (np.tile(part, len(limits)) for part in self.at_p)
        friction = np.isfinite(mu)
        broken = (z < 0) | (friction & (np.abs(y) > np.where(friction, mu, 0) * z + 1e-12))
        slips = friction & np.where(at_corner, normal > 1e-9, slipping)
        return np.where(broken, np.nan, e), verge, slips, broken

    def _corner(self, theta, over, margin, k, mu):
        """Where between three points of the grid the limit is reached at the turning point itself: energy, theta, F_z.

        over (3, i): whether the limit is broken there at once, margin (3, i) how far it is; inf where there is no corner.
        """
        left = over[0] != over[1]
        i = np.flatnonzero(left | (over[1] != over[2]))
        e, zero, normal = np.full(len(k), np.inf), theta[1].copy(), np.zeros(len(k))
        if not i.size:
            return e, zero, normal
        low, high = np.where(left, theta[:2], theta[1:])[:, i]
        # inverse quadratic interpolation on the last three points, kept in the bracket
        xs, fs = [*theta[:, i]], [*margin[:, i]]
        for _ in range(10):
            (x0, x1, x2), (f0, f1, f2) = xs, fs
            d0, d1, d2 = f0 - f1, f1 - f2, f0 - f2
            x = _clip(x2 + f2 * (f1 / d0 * ((x1 - x2) / d1 - (x0 - x2) / d2) - (x1 - x2) / d1), low, high)
            x = np.where(np.isfinite(x), x, x2)
            _, base, z, y, square = self._forces(x, k[i])
            xs, fs = [x1, x2, x], [f1, f2, _margin(z, y, square, mu[i])]
            if np.abs(x - x2).max() < 1e-7:
                break
        e[i], zero[i], normal[i] = base, x, z
        return e, zero, normal

    def _inside(self, theta, first, over, has_corner, corner, k, mu):
        """Where the energy that breaks the limit is least between the three points: energy, theta, whether it slips there."""
        middle, _ = _vertex(theta, first)
        # beyond a corner the limit is broken at once: the least inside lies on the allowed side
        before, after = has_corner & (corner < theta[1]), has_corner & (corner > theta[1])
        low = np.where((before & over[0]) | (after & over[1]), corner, theta[0])
        high = np.where((after & over[2]) | (before & over[1]), corner, theta[2])
        middle = np.where(np.isfinite(middle), middle, theta[1])
        h = (theta[2] - theta[0]) / 200
        i = np.flatnonzero((low < high) & np.isfinite(first[1]))
        e, place, slipping = np.full(len(k), np.inf), theta[1].copy(), np.zeros(len(k), bool)
        for _ in range(6):
            if not i.size:
                break
            centre = _clip(middle[i], low[i] + h[i], high[i] - h[i])
            points = np.array([centre - h[i], centre, centre + h[i]])
            values, slips = self._first(points, k[i], mu[i])
            slipping[i] = slips[1]
            vertex, least = _vertex(points, values)
            good = np.abs(vertex - centre) <= 2 * h[i]
            lowest = values.argmin(axis=0), np.arange(len(i))
            e[i] = np.where(good, least, values[lowest])
            place[i] = np.where(good, vertex, points[lowest])
            pinned = ~good & ((place[i] <= low[i] + 2 * h[i]) | (place[i] >= high[i] - 2 * h[i]))
            middle[i] = np.where(np.isfinite(vertex) & (np.abs(vertex - centre) < 50 * h[i]), vertex, points[lowest])
            i = i[~good & ~pinned]
        inside = (place > low) & (place < high)
        return np.where(inside, e, np.inf), place, slipping

    def _first(self, theta, k, mu):
        """The first energy that breaks the limit, for theta (j, i), and whether it is by slipping."""
        rows, base, z, y, x = self._forces(theta, k)
        lift, friction = _lift(rows, z), np.isfinite(mu)
        slip = np.where(friction, _slip(rows, z, y, x, np.where(friction, mu, 0)), np.inf)
        return base + np.minimum(lift, slip), slip < lift

    def ends(self, e):
        """theta at the turning points of the trajectories of energies e (limits, k) in these wells: (2, limits, k)."""
        n, k, theta = len(self.grid), np.arange(e.shape[1]), []
        curvature = self.base[k, self.lowest] - self.U_p
        wide = np.abs(self.grid[self.lowest] - self.theta_p) / np.sqrt(np.maximum(curvature, 0))
        for energy in e:
            first, last = self._span(energy)
            for j, step in ((first, -1), (last, 1)):
                beyond = _clip(j + step, 0, n - 1)
                share = (energy - self.base[k, j]) / (self.base[k, beyond] - self.base[k, j])
                guess = self.grid[j] + np.where((share >= 0) & (share <= 1), share, 0) * (self.grid[beyond] - self.grid[j])
                near = wide * np.sqrt(np.maximum(energy - self.U_p, 0))
                few = last - first < 4
                guess = np.where(few & np.isfinite(near), self.theta_p + step * near, guess)
                theta.append(guess)
        theta = np.array(theta).reshape(len(e), 2, -1).swapaxes(0, 1)
        theta = self._turning(theta, e)
        theta[:, np.isinf(e)] = np.array([[0.0], [np.pi]])
        doubtful = ~(theta[0] <= self.theta_p + 1e-9) | ~(theta[1] >= self.theta_p - 1e-9)
        doubtful[:, list(self.barriers)] = True
        for which, i in zip(*np.nonzero(doubtful & np.isfinite(e)), strict=True):
            theta[:, which, i] = self._exact_ends(i, e[which, i])
        return theta

    def _turning(self, theta, e):
        """Newton's steps to the zeros of D = s^2 (e - U) in the distance of cos(theta) to the nearer pole."""
        top = self.top
        v, m = versines(theta)
        north = theta < np.pi / 2
        x, a, K = np.where(north, v, m), np.where(north, top.a, -top.a), np.where(north, self.K_R, -self.K_R)
        delta, gamma, d = top.I1 / top.I3, top.I3 / top.I1, np.where(north, *self.gaps)
        lift = np.where(north, e, e - 4 * top.a)  # e less 2a(1 - c) at the pole
        for _ in range(12):
            c, s2 = 1 - x, x * (2 - x)
            p = c - a
            B, f2, f3_2 = d + x * pole_slope(x, a, K, top), top.I1 + delta * s2 + p * p, top.I3 + s2 + gamma * p * p
            rest = lift - 2 * a * x
            dB, df2 = -gamma * K * (top.I3 + 1 - a * c) / (f3_2 * np.sqrt(f3_2)), 2 * (p - delta * c)
            D = s2 * rest - f2 * B * B
            slope = 2 * a * s2 - 2 * c * rest - B * (df2 * B + 2 * f2 * dB)  # dD/dc
            x, before = _clip(x + D / slope, 0, 2), x
            if not np.any(np.abs(x - before) > 1e-7 * x):  # Newton's steps: the error left is the square of that
                break
        half = np.arctan2(np.sqrt(x), np.sqrt(2 - x))
        return np.where(north, 2 * half, np.pi - 2 * half)

    def _exact_ends(self, i, e):
        """As turning_points has them, where the grid leaves doubt."""
        E = (e + self.K_R**2 - self.top.I1 / self.top.I3 * self.K_J[i] ** 2) / 2
        pairs = turning_points(self.top, Constants(self.K_J[i], self.K_R, max(E, self.energy(self.U_p)[i])))
        return min(pairs, key=lambda p: max(p[0] - self.theta_p[i], self.theta_p[i] - p[1]))


def _clip(x, low, high):
    return np.minimum(np.maximum(x, low), high)  # np.clip takes ten times as long on arrays this short


def _margin(z, y, x, mu):
    """mu F_z - F_h, or F_z where mu is infinite."""
    friction = np.isfinite(mu)
    return np.where(friction, np.where(friction, mu, 0) * z - np.sqrt(y * y + x), z)


def _vertex(x, y):
    """Abscissa and value of the parabola through three points, (3, k) each: nan, inf or a maximum where it has no least."""
    left, right = x[1] - x[0], x[2] - x[1]
    slope_left, slope_right = (y[1] - y[0]) / left, (y[2] - y[1]) / right
    curve = (slope_right - slope_left) / (left + right)
    slope = slope_left + left * curve
    step = np.where(curve > 0, -slope / (2 * curve), np.nan)
    return x[1] + step, y[1] + step * slope / 2
