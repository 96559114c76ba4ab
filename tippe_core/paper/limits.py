"""The largest energy at which a top neither leaves the table nor slips: one scan, one zero and one minimum for each
K_J.

At a given theta the forces (37) to (39) are F_x = X w1, F_y = Y0 + Y1 w1^2, F_z = Z0 + Z1 w1^2. So with f = w1^2 the
limit mu F_z = n F_h (mu = mu_s, n = 1; for lift-off alone mu = 1, n = 0) is a quadratic in f, and 2E' = U + f1^2 f.

A trajectory in the well reaches theta from the energy `base` on, the largest U between theta and the steady precession.
If the limit is already violated at base, base is the first energy to violate it at theta; otherwise it is the energy at
the end of the interval around base in which the limit holds. The limit energy for a K_J is the minimum of these over
theta. Going outwards from the steady precession base never falls, so nothing matters beyond the first point at which
the limit is violated at base.
"""

from typing import TypeAlias

import numpy as np

from ..compiled import compiled
from ..types import Array, Indices
from . import equations as eq
from .poles import Floats, angle, bracket_near
from .search import least, zero
from .top import TopNumbers
from .wells import D_near, N_near, U_near

# Columns of a path, whose rows are points outwards from the steady precession; DISTANCE in theta to the pole ahead.
DISTANCE, X, SIDE, BASE, MARGIN, FIRST = range(6)
MORE = 24  # additional points
Limit: TypeAlias = tuple[float, float]  # mu, n


def interval_end(limit: Limit, X: float, Y0: float, Y1: float, Z0: float, Z1: float) -> float:
    """The f up to which mu F_z >= n F_h holds, starting from one at which it does; inf, or less than that one, if it
    always holds."""
    mu, n = limit
    if n == 0:
        return -Z0 / Z1 if Z1 < 0 else np.inf
    # mu^2 F_z^2 - F_h^2 = P2 f^2 - 2 b f + P0; r^2 = b^2 - P2 P0, less what cancels
    y0, y1, z0, z1 = Y0, Y1, mu * Z0, mu * Z1
    P2, P0, b = z1 * z1 - y1 * y1, z0 * z0 - y0 * y0, X * X / 2 + y0 * y1 - z0 * z1
    r_2 = X * X * (b - X * X / 4) + (z1 * y0 - y1 * z0) ** 2
    if r_2 < 0:
        return np.inf
    r = np.sqrt(r_2)
    if b >= 0:
        return P0 / (b + r) if b + r > 0 else np.inf
    return (b - r) / P2 if P2 < 0 else np.inf


def look(x: float, side: float, barrier: float, curve: Floats, limit: Limit) -> tuple[float, float, float]:
    """base (at least the barrier already passed), the margin mu F_z - n F_h there, and the first 2E' that violates the
    limit."""
    mu, n = limit
    c, s, (B, w3) = side * (1 - x), np.sqrt(x * (2 - x)), bracket_near(side, x, curve)
    w2 = B / s if s > 0 else 0.0 if B == 0 else np.inf
    U = eq.U(x if side > 0 else 2 - x, c, s * s, w2 * w2, curve.top)
    base = max(U, barrier)
    X, Y0, Y1, Z0, Z1 = eq.force_terms(c, s, w2, w3, curve.top)
    f = eq.theta_dot_2(base, U, c, curve.top)
    margin = mu * (Z0 + Z1 * f) - n * np.sqrt(X * X * f + (Y0 + Y1 * f) ** 2)
    if not margin >= 0:
        return base, margin, base
    first = eq.two_E_prime_of_motion(interval_end(limit, X, Y0, Y1, Z0, Z1), U, c, curve.top)
    return base, margin, first if first >= base else np.inf


def margin_at(x: float, side: float, barrier: float, curve: Floats, limit: Limit) -> float:
    """s^2 times the margin; the margin itself is infinite at a pole."""
    return x * (2 - x) * look(x, side, barrier, curve, limit)[1]


def first_at(x: float, side: float, barrier: float, curve: Floats, limit: Limit) -> float:
    return look(x, side, barrier, curve, limit)[2]


def F_z_at(x: float, side: float, e: float, curve: Floats) -> float:
    """F_z (Mg) at 2E' = e."""
    c, s, (B, w3) = side * (1 - x), np.sqrt(x * (2 - x)), bracket_near(side, x, curve)
    _, _, _, Z0, Z1 = eq.force_terms(c, s, B / s if s > 0 else 0.0, w3, curve.top)
    return Z0 + Z1 * eq.theta_dot_2(e, U_near(x, side, curve), c, curve.top)


# ---- the scan ----


def point_from_pole(distance: float, toward: float) -> tuple[float, float]:
    """x and side of the point at this distance in theta from the pole cos(theta) = toward."""
    if distance <= np.pi / 2:
        return 2 * np.sin(distance / 2) ** 2, toward
    return 2 * np.cos(distance / 2) ** 2, -toward


def seen(path: Array, k: int, side: float) -> float:
    """x of a point as seen from that pole."""
    return path[k, X] if path[k, SIDE] == side else 2 - path[k, X]


def add_point(
    path: Array, k: int, distance: float, x: float, side: float, barrier: float, curve: Floats, limit: Limit
) -> None:
    path[k, DISTANCE], path[k, X], path[k, SIDE] = distance, x, side
    path[k, BASE], path[k, MARGIN], path[k, FIRST] = look(x, side, barrier, curve, limit)


def scan(path: Array, toward: float, far: float, points: int, curve: Floats, limit: Limit, best: float) -> int:
    """Fills the path outwards from its first point, in ever smaller steps towards the distance far, until the limit is
    violated at base, or base exceeds best or the least energy found on the path. Returns the number of points."""
    k, near, rising = 1, path[0, DISTANCE], True
    through = (curve.upright if toward > 0 else curve.inverted) == 0
    for j in range(1, points + MORE):
        share = max(1 - j / points, 0.0)
        distance = far + (near - far) * share * share
        if j > points or (j == points and far == 0 and not through):  # in growing steps up the wall of U at the pole
            if distance == 0 and through:
                break
            distance = max(3 * path[k - 1, DISTANCE] - 2 * path[k - 2, DISTANCE], path[k - 1, DISTANCE] / 10)
        x, side = point_from_pole(distance, toward)
        add_point(path, k, distance, x, side, path[k - 1, BASE], curve, limit)
        if path[k, BASE] > path[k - 1, BASE]:
            rising = True
        elif rising and k > 1:  # past a barrier: its maximum replaces the previous point
            rising, side = False, path[k - 1, SIDE]
            low, high = seen(path, k - 2, side), seen(path, k, side)
            if N_near(low, side, curve) * N_near(high, side, curve) < 0:
                top = zero(N_near, min(low, high), max(low, high), (side, curve))
                add_point(path, k - 1, angle(top, side * toward), top, side, path[k - 2, BASE], curve, limit)
                add_point(path, k, distance, path[k, X], path[k, SIDE], path[k - 1, BASE], curve, limit)
        k = broken_between(path, k, toward, curve, limit)
        best = min(best, path[k, FIRST])
        k += 1
        if not path[k - 1, MARGIN] >= 0 or path[k - 1, BASE] >= best:
            break
    return k


def broken_between(path: Array, k: int, toward: float, curve: Floats, limit: Limit) -> int:
    """The index of the last point: k, or that of a new one if the margin falls below 0 between the last three."""
    if k < 2 or not 0 <= path[k - 1, MARGIN] < min(path[k - 2, MARGIN], path[k, MARGIN]):
        return k
    side, barrier = path[k - 1, SIDE], path[k - 2, BASE]
    low, at, high = seen(path, k - 2, side), path[k - 1, X], seen(path, k, side)
    x = least(margin_at, min(low, high), at, max(low, high), (side, barrier, curve, limit), 1e-3)
    if margin_at(x, side, barrier, curve, limit) >= 0:
        return k
    if (x - at) * (high - at) < 0:
        k -= 1
    add_point(path, k, angle(x, side * toward), x, side, path[k - 1, BASE], curve, limit)
    return k


def corner(path: Array, k: int, curve: Floats, limit: Limit, part: float) -> int:
    """Ends the path with the point at which the limit is first violated at base, and one just before it."""
    if k < 2 or path[k - 1, MARGIN] >= 0:
        return k
    side, barrier = path[k - 1, SIDE], path[k - 2, BASE]
    low, high = seen(path, k - 2, side), seen(path, k - 1, side)
    if not path[k - 2, MARGIN] > 0:
        x = low
    else:
        x = zero(margin_at, min(low, high), max(low, high), (side, barrier, curve, limit), part)
    distance = path[k - 1, DISTANCE]
    add_point(path, k - 1, distance, x + 1e-5 * (low - x), side, barrier, curve, limit)
    add_point(path, k, distance, x, side, barrier, curve, limit)
    path[k, FIRST] = path[k, BASE]
    return k + 1


def dips(paths: Array, counts: Indices, curve: Floats, limit: Limit, part: float) -> tuple[float, float, float]:
    """(2E', x, side) of the least violating energy on both paths if it is less than best; also between the points."""
    found, x_found, side_found = np.inf, paths[0, 0, X], paths[0, 0, SIDE]
    for way in range(2):
        for k in range(counts[way]):
            if paths[way, k, FIRST] < found:
                found, x_found, side_found = paths[way, k, FIRST], paths[way, k, X], paths[way, k, SIDE]
    for way in range(2):
        path = paths[way]
        for k in range(way, counts[way] - 1):
            one, i = (path, k - 1) if k > 0 else (paths[1], 1)  # the point before
            if (k == 0 and counts[1] < 2) or not path[k, MARGIN] >= 0 or path[k, FIRST] == np.inf:
                continue
            if min(one[i, FIRST], path[k + 1, FIRST]) < path[k, FIRST]:
                continue
            side, barrier = path[k, SIDE], one[i, BASE] if k > 0 else path[0, BASE]
            low, high = seen(one, i, side), seen(path, k + 1, side)
            args = side, barrier, curve, limit
            x = least(first_at, min(low, high), path[k, X], max(low, high), args, part * part * 10)
            if first_at(x, *args) < found:
                found, x_found, side_found = first_at(x, *args), x, side
    return found, x_found, side_found


def turning_tilt(path: Array, k: int, curve: Floats, e: float, part: float) -> float:
    """theta of the turning point of a trajectory of energy 2E' = e, on a path of k points."""
    for i in range(1, k):
        if path[i, BASE] > e:
            side = path[i, SIDE]
            low, high = seen(path, i - 1, side), seen(path, i, side)
            if D_near(low, side, curve, e) <= 0:
                return angle(low, side)
            return angle(zero(D_near, min(low, high), max(low, high), (side, curve, e), part), side)
    return angle(path[k - 1, X], path[k - 1, SIDE])


def limit_of(
    paths: Array, x: float, side: float, points: int, curve: Floats, limit: Limit, far: Array, part: float
) -> tuple[float, float, float, float, float]:
    """2E', theta_inner, theta_outer, theta_verge and F_z there, starting from the steady precession at x, to the
    relative accuracy `part` in x.

    paths: working space (2, points + MORE + 2, 6). far: how far the paths may lead; overwritten with how far they
    do."""
    counts = np.ones(2, np.intp)
    for way, toward in ((0, 1.0), (1, -1.0)):
        add_point(paths[way], 0, angle(x, side * toward), x, side, -np.inf, curve, limit)
    if not paths[0, 0, MARGIN] >= -1e-12:
        return np.nan, np.nan, np.nan, np.nan, np.nan
    for closer in range(12):
        done = True
        for way, toward in ((1, -1.0), (0, 1.0)):
            even = points / 2 <= counts[way] <= points + 1
            if paths[way, 0, DISTANCE] > 0 and (closer == 0 or not even):
                best = paths[1 - way, : counts[1 - way], FIRST].min()
                counts[way] = scan(paths[way], toward, far[way], points, curve, limit, best)
                far[way], done = paths[way, counts[way] - 1, DISTANCE], False
        if done or min(paths[0, : counts[0], FIRST].min(), paths[1, : counts[1], FIRST].min()) == np.inf:
            break
    for way in range(2):
        counts[way] = corner(paths[way], counts[way], curve, limit, part)
    e, x, side = dips(paths, counts, curve, limit, part)
    if e == np.inf:
        return e, 0.0, np.pi, np.nan, np.nan
    inner, outer = turning_tilt(paths[0], counts[0], curve, e, part), turning_tilt(paths[1], counts[1], curve, e, part)
    return e, inner, outer, angle(x, side), F_z_at(x, side, e, curve)


# ---- the steady precession of least energy ----


def least_U(V: Array, M: Array, curve: Floats, part: float) -> tuple[float, float, bool]:
    """(x, side) of the minimum of U, found on the grid 1 - c = V, 1 + c = M from theta = 0 to pi, and whether it is
    certain."""
    n = len(V) - 1
    U = np.empty(n + 1)
    for i in range(n + 1):
        U[i] = U_near(V[i], 1.0, curve) if V[i] <= M[i] else U_near(M[i], -1.0, curve)
    found, x_found, side_found, sure = np.inf, 0.0, 1.0, False
    for i in range(n + 1):
        if (i > 0 and U[i - 1] < U[i]) or (i < n and U[i + 1] < U[i]):
            continue
        side, distances = (1.0, V) if V[i] <= M[i] else (-1.0, M)
        first, last = distances[max(i - 1, 0)], distances[min(i + 1, n)]
        low, high, x = min(first, last), max(first, last), distances[i]
        if low == 0 and U_near(low, side, curve) < np.inf:
            low = 1e-9 * high
        falls, rises = side * N_near(low, side, curve) > 0, side * N_near(high, side, curve) < 0
        if falls and rises:
            x = zero(N_near, low, high, (side, curve), part)
        at_pole = x == 0 and rises and not falls
        if U_near(x, side, curve) < found:
            found, x_found, side_found, sure = U_near(x, side, curve), x, side, at_pole or (falls and rises)
    return x_found, side_found, sure


# ---- for arrays ----


@compiled
def least_U_of(V: Array, M: Array, top: TopNumbers, K_R: float, offsets: Array) -> Array:
    """Rows of x, side and certainty from least_U(), one for each row of offsets."""
    found = np.empty((len(offsets), 3))
    for i in range(len(offsets)):
        x, side, sure = least_U(V, M, Floats(top, K_R, offsets[i, 0], offsets[i, 1]), 1e-8)
        found[i, 0], found[i, 1], found[i, 2] = x, side, sure
    return found


@compiled
def limits_of(
    top: TopNumbers, K_R: float, offsets: Array, steady: Array, limits: Array, points: int
) -> tuple[Array, Array]:
    """For each of the limits (mu, n) and each K_J: 2E', theta_inner, theta_outer, theta_verge and F_z from limit_of(),
    that of lift-off first, because it bounds the paths of the other. Then theta and U of the steady precessions, given
    as rows of x and side."""
    paths, found = np.empty((2, points + MORE + 2, 6)), np.empty((len(limits), 5, len(offsets)))
    at_rest = np.empty((2, len(offsets)))
    for i in range(len(offsets)):
        curve, far, x, side = Floats(top, K_R, offsets[i, 0], offsets[i, 1]), np.zeros(2), steady[i, 0], steady[i, 1]
        at_rest[0, i], at_rest[1, i] = angle(x, side), U_near(x, side, curve)
        for j in range(len(limits)):
            columns = limit_of(paths, x, side, points, curve, (limits[j, 0], limits[j, 1]), far, 1e-8)
            for row in range(5):
                found[j, row, i] = columns[row]
    return found, at_rest
