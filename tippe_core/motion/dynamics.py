"""The Newton-Euler equations of a top on a table: in the air, on its ball, on the edge of its stem's end, or on both.

In axes fixed in space, with the unit vector e along axis 3, the angular momentum L about G, the velocity v of G, the
contacts at rho_i from G, and k = 1/I3 - 1/I1:

    v' = sum F_i - z ,   L' = sum (rho_i x F_i + M_i) - drag w ,   e' = w x e ,
    w = L/I1 + k (L . e) e ,   w' = L'/I1 + k [(L' . e) e + (L . e) e'] ,
    u_i = v + w x rho_i ,   u_i' = v' + w' x rho_i + w x rho_i' ,

    ball     rho = a e - z ,
    stem     rho = (a + h) e - b n - q z ,   n = (z - e_z e)/s ,

where the stem's edge is a circle of radius b about axis 3 at the height h above O, rounded with the radius q. At a
slipping contact the friction law gives the force F = N (z - k(u) u) and the pivoting torque M = -N t(u, w_z) z. At a
sticking contact F is a constraint force, and so is M along z if the law has a pivoting torque. Rolling resistance adds
M = -N delta w_h/|w_h|. There are as many unknowns as conditions: u_z' = 0, and for a sticking contact u' = 0 (and
w_z' = 0). If two contacts stick, the friction along the line between them is undetermined; the smallest is chosen, or
if that exceeds static friction at one of them, the nearest to it that does not.

Euler angles are avoided. The orientation is that of a frame whose third axis is e and which does not rotate about e
(quaternion p), and the angle chi by which the body has rotated in that frame, chi' = w_3. Both are smooth through
theta = 0 and pi. A state is

    y = (p_x, p_y, p_z, p_w, chi, L_x, L_y, L_z, v_x, v_y, x, y, t, heat, v_z, z) .

v_z and z follow from the rest while a contact is closed, v_x and v_y if the first closed contact sticks.

The direction of Coulomb friction is undefined at u = 0. So v_x and v_y are replaced by log|u| and the direction beta of
the slip u at the slowest contact, and time by tau, dt = dtau |u|/(|u| + SLOW). Before sticking and after it |u| decays
or grows exponentially in tau, and beta is smooth. This changes the variables, not the law.
"""

from typing import TypeAlias

import numpy as np

from ..compiled import compiled
from ..types import Array, Vector
from . import at
from .elimination import solve_linear
from .friction import bounds, push
from .kinds import Modes
from .records import BALL, NO_ONE, OPEN, SLIP, STEM, STICK, Record

SLOW = 0.01  # ((gR)^1/2)
STEADY = 1.0  # ((g/R)^1/2): rate at which numerical drift at closed contacts is damped
SLOW_ROLLING = 1e-3  # ((g/R)^1/2): w_h below which rolling resistance goes to zero
POLE = 1e-12  # sin(theta) below which the stem's lowest point is anywhere on its rim
LOG_FAST = 100.0  # a trial step with a larger log|u| is too long anyway, and the exponential may overflow

Turning: TypeAlias = tuple[Vector, Vector, float]  # e, w, L . e


@compiled
def carried(modes: Modes) -> int:
    """The closed contacts in these modes: 0 none, 1 the ball, 2 the stem, 3 both."""
    return (1 if modes[BALL] != OPEN else 0) + (2 if modes[STEM] != OPEN else 0)


def cross(x: Vector, y: Vector) -> Vector:
    return x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]


def row(rows: Array, i: int) -> Vector:
    return rows[i, 0], rows[i, 1], rows[i, 2]


@compiled
def turning(y: Array, P: Record) -> Turning:
    """e, w = L/I1 + k (L . e) e, and L . e."""
    px, py, pz, pw, L = y[at.PX], y[at.PY], y[at.PZ], y[at.PW], (y[at.LX], y[at.LY], y[at.LZ])
    e = 2 * (px * pz + pw * py), 2 * (py * pz - pw * px), 1 - 2 * (px * px + py * py)
    L3 = L[0] * e[0] + L[1] * e[1] + L[2] * e[2]
    along = P.k * L3
    return e, (L[0] / P.I1 + along * e[0], L[1] / P.I1 + along * e[1], L[2] / P.I1 + along * e[2]), L3


def locate_contacts(e: Vector, w: Vector, P: Record, C: Record) -> None:
    """rho and rho' of each contact."""
    e_dot = cross(w, e)
    for i in range(1 + P.stem):
        along, turns, down = P.a, 0.0, P.a * e[2] - 1.0
        if i == STEM:
            along, down = P.a + P.h, (P.a + P.h) * e[2] - P.q
            if P.b > 0.0:  # rho = (a + h + b e_z/s) e - (b/s + q) z
                s = max(np.sqrt(e[0] * e[0] + e[1] * e[1]), POLE)
                along, turns, down = along + P.b * e[2] / s, P.b * e_dot[2] / (s * s * s), down - P.b * s
        C.rho[i, 0], C.rho[i, 1], C.rho[i, 2] = along * e[0], along * e[1], down
        C.rho_dot[i, 0], C.rho_dot[i, 1] = along * e_dot[0] + turns * e[0], along * e_dot[1] + turns * e[1]
        C.rho_dot[i, 2] = along * e_dot[2]


@compiled
def arrange(y: Array, slowest: int, modes: Modes, P: Record, C: Record) -> Turning:
    """Writes into C the positions and slip velocities of the contacts, and v and z of G, with closed contacts on the
    table."""
    e, w, L3 = turning(y, P)
    locate_contacts(e, w, P, C)
    G = C.G
    G[0], G[1], G[2], G[3] = y[at.VX], y[at.VY], y[at.VZ], y[at.Z]
    ux, uy = 0.0, 0.0
    if slowest != NO_ONE:
        speed, turns = np.exp(min(y[at.LOG_U], LOG_FAST)), cross(w, row(C.rho, slowest))
        ux, uy = speed * np.cos(y[at.BETA]), speed * np.sin(y[at.BETA])
        G[0], G[1] = ux - turns[0], uy - turns[1]
    if carried(modes):
        first = BALL if modes[BALL] != OPEN else STEM
        turns = cross(w, row(C.rho, first))
        G[2], G[3] = -turns[2], -C.rho[first, 2]
        if modes[first] == STICK and slowest == NO_ONE:
            G[0], G[1] = -turns[0], -turns[1]
    for i in range(1 + P.stem):
        turns = cross(w, row(C.rho, i))
        C.u[i, 0], C.u[i, 1], C.u[i, 2] = G[0] + turns[0], G[1] + turns[1], G[2] + turns[2]
        C.height[i] = G[3] + C.rho[i, 2]
    if slowest != NO_ONE:  # with full precision
        C.u[slowest, 0], C.u[slowest, 1] = ux, uy
    return e, w, L3


def from_direction(y: Array, i: int, unit: float, P: Record, C: Record) -> None:
    """Changes n_x, n_y, n_z and sigma in y back into v_x, v_y and L_z: u = sigma unit (n_x, n_y) at contact i, which is
    closed, and radius w_z = sigma unit n_z."""
    e, size = turning(y, P)[0], y[at.SIGMA] * unit
    ux, uy, w_z = size * y[at.NX], size * y[at.NY], size * y[at.NZ] / P.law.radius
    # w_z = L_z/I1 + k (L . e) e_z
    y[at.LZ] = (w_z - P.k * e[2] * (y[at.LX] * e[0] + y[at.LY] * e[1])) / (1 / P.I1 + P.k * e[2] * e[2])
    e, w, _ = turning(y, P)
    locate_contacts(e, w, P, C)
    turns = cross(w, row(C.rho, i))
    y[at.VX], y[at.VY], y[at.VZ], y[at.Z] = ux - turns[0], uy - turns[1], -turns[2], -C.rho[i, 2]


def angular(torque: Vector, e: Vector, P: Record) -> Vector:
    """L'/I1 + k (L' . e) e: the part of w' due to a torque."""
    along = P.k * (torque[0] * e[0] + torque[1] * e[1] + torque[2] * e[2])
    return torque[0] / P.I1 + along * e[0], torque[1] / P.I1 + along * e[1], torque[2] / P.I1 + along * e[2]


def column(C: Record, n: int, i: int, part: int, F: Vector, M: Vector) -> int:
    """Adds an unknown: the magnitude of the force F, with the torque M in addition to rho x F, at contact i.

    part: the component of u_i' that must vanish (2: u_z'), or 3 for w_z'. Returns the next free column.
    """
    C.owner[n], C.part[n] = i, part
    torque = cross(row(C.rho, i), F)
    for axis in range(3):
        C.columns[n, axis], C.columns[n, 3 + axis] = F[axis], torque[axis] + M[axis]
    return n + 1


def component(C: Record, F: Vector, w_dot: Vector, i: int, part: int) -> float:
    """The component `part` of v' + w' x rho_i, or w_z' (3)."""
    if part == 3:
        return w_dot[2]
    return F[part] + cross(w_dot, row(C.rho, i))[part]


def holding(C: Record, n: int, i: int, M: Vector, pivots: bool) -> int:
    """Adds the unknowns of a contact i that sticks: N, each unit of which has the torque M, the two components of
    friction, and its torque if it pivots. Returns the next free column."""
    n = column(C, n, i, 2, (0.0, 0.0, 1.0), M)
    n = column(C, n, i, 0, (1.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    n = column(C, n, i, 1, (0.0, 1.0, 0.0), (0.0, 0.0, 0.0))
    return column(C, n, i, 3, (0.0, 0.0, 0.0), (0.0, 0.0, 1.0)) if pivots else n


def friction(w: Vector, i: int, P: Record, C: Record) -> Vector:
    """(k u_x, k u_y, t) of contact i, which slips, unless C.friction has it already."""
    if C.given != 1 + i:
        ux, uy = C.u[i, 0], C.u[i, 1]
        k, t = push(P.law, ux * ux + uy * uy, w[2])
        C.friction[0], C.friction[1], C.friction[2] = k * ux, k * uy, t
    return C.friction[0], C.friction[1], C.friction[2]


def unknowns(w: Vector, modes: Modes, P: Record, C: Record) -> int:
    """Sets up the columns of all unknowns and returns their number."""
    n, w_h = 0, np.sqrt(w[0] * w[0] + w[1] * w[1] + SLOW_ROLLING * SLOW_ROLLING)
    rolls = -P.delta * w[0] / w_h, -P.delta * w[1] / w_h
    for i in range(1 + P.stem):
        if modes[i] == SLIP:
            kx, ky, t = friction(w, i, P, C)
            n = column(C, n, i, 2, (-kx, -ky, 1.0), (rolls[0], rolls[1], -t))
        elif modes[i] == STICK:
            n = holding(C, n, i, (rolls[0], rolls[1], 0.0), P.law.pivots and carried(modes) < 3)
    return n


def respond(n: int, e: Vector, P: Record, C: Record) -> None:
    """Writes into the matrix what each of n unknowns adds to each component that must vanish."""
    for j in range(n):
        F, w_dot = row(C.columns, j), angular((C.columns[j, 3], C.columns[j, 4], C.columns[j, 5]), e, P)
        for r in range(n):
            C.matrix[r, j] = component(C, F, w_dot, C.owner[r], C.part[r])


def forces(turn: Turning, modes: Modes, P: Record, C: Record) -> float:
    """Writes the contact forces and torques and the accelerations into C, after arrange().

    Returns the least principal minor of du_z'/dN for the slipping contacts; it is <= 0 beyond Painleve's limit.
    """
    e, w, L3 = turn
    e_dot, k = cross(w, e), P.k
    drag = -P.drag * w[0], -P.drag * w[1], -P.drag * w[2]
    free = angular(drag, e, P)
    free = free[0] + k * L3 * e_dot[0], free[1] + k * L3 * e_dot[1], free[2] + k * L3 * e_dot[2]
    if modes[BALL] + modes[STEM] == SLIP:
        return alone(turn, drag, free, BALL if modes[BALL] == SLIP else STEM, P, C)
    n, minor = unknowns(w, modes, P, C), 1.0
    for i in range(1 + P.stem):
        turns, swings = cross(w, row(C.rho_dot, i)), cross(free, row(C.rho, i))
        for axis in range(3):
            C.free[i, axis] = turns[axis] + swings[axis] - (1.0 if axis == 2 else 0.0)
            C.F[i, axis] = C.M[i, axis] = 0.0
    respond(n, e, P, C)
    for j in range(n):
        i, part = C.owner[j], C.part[j]
        if part == 2 and modes[i] == SLIP:
            minor = min(minor, C.matrix[j, j])
        C.right[j] = -(free[2] + STEADY * w[2]) if part == 3 else -C.free[i, part] - 2 * STEADY * C.u[i, part]
        if part == 2:
            C.right[j] -= STEADY * STEADY * C.height[i]
    both = carried(modes) == 3
    if both and modes[BALL] == modes[STEM] == STICK:
        least_along_the_line(C)
        solve_linear(C.matrix, C.right, n)
    else:
        determinant = solve_linear(C.matrix, C.right, n)
        minor = min(minor, determinant) if both else minor
    for axis in range(3):
        C.v_dot[axis], C.L_dot[axis] = (-1.0 if axis == 2 else 0.0), drag[axis]
    for j in range(n):
        i, size, at = C.owner[j], C.right[j], cross(row(C.rho, C.owner[j]), row(C.columns, j))
        for axis in range(3):
            C.F[i, axis] += size * C.columns[j, axis]
            C.M[i, axis] += size * (C.columns[j, 3 + axis] - at[axis])
            C.v_dot[axis] += size * C.columns[j, axis]
            C.L_dot[axis] += size * C.columns[j, 3 + axis]
    if both and modes[BALL] == modes[STEM] == STICK:
        share_along_the_line(P, C)
    w_dot = angular((C.L_dot[0], C.L_dot[1], C.L_dot[2]), e, P)
    for axis in range(3):
        C.w_dot[axis] = w_dot[axis] + k * L3 * e_dot[axis]
    return minor


def alone(turn: Turning, drag: Vector, free: Vector, i: int, P: Record, C: Record) -> float:
    """forces() if only contact i is closed, and slips: its N follows from u_z' = 0, which is linear in N."""
    (e, w, _), rho = turn, row(C.rho, i)
    w_h, (kx, ky, t) = np.sqrt(w[0] * w[0] + w[1] * w[1] + SLOW_ROLLING * SLOW_ROLLING), friction(w, i, P, C)
    F, M = (-kx, -ky, 1.0), (-P.delta * w[0] / w_h, -P.delta * w[1] / w_h, -t)
    torque = cross(rho, F)
    torque = torque[0] + M[0], torque[1] + M[1], torque[2] + M[2]
    w_dot = angular(torque, e, P)
    rises = 1.0 + cross(w_dot, rho)[2]
    falls = cross(w, row(C.rho_dot, i))[2] + cross(free, rho)[2] - 1.0
    N = -(falls + 2 * STEADY * C.u[i, 2] + STEADY * STEADY * C.height[i]) / rises
    for axis in range(3):
        C.F[1 - i, axis] = C.M[1 - i, axis] = 0.0
        C.F[i, axis], C.M[i, axis] = N * F[axis], N * M[axis]
        C.v_dot[axis] = N * F[axis] - (1.0 if axis == 2 else 0.0)
        C.L_dot[axis] = N * torque[axis] + drag[axis]
        C.w_dot[axis] = N * w_dot[axis] + free[axis]
    return rises


def least_along_the_line(C: Record) -> None:
    """If both contacts stick, a pair of forces d and -d along the line between them has no effect. M + n n^T with
    n = (d, -d) makes the equations regular; their solution has no component along n."""
    dx, dy = C.rho[STEM, 0] - C.rho[BALL, 0], C.rho[STEM, 1] - C.rho[BALL, 1]
    far = np.sqrt(dx * dx + dy * dy)
    along = (0.0, dx / far, dy / far, 0.0, -dx / far, -dy / far)
    for r in range(6):
        for j in range(6):
            C.matrix[r, j] += along[r] * along[j]


def share_along_the_line(P: Record, C: Record) -> None:
    """Where the least forces exceed static friction at one contact, the other takes what it can of the force along the
    line, which changes nothing else."""
    dx, dy = C.rho[STEM, 0] - C.rho[BALL, 0], C.rho[STEM, 1] - C.rho[BALL, 1]
    far, most = np.sqrt(dx * dx + dy * dy), bounds(P.law)[0]
    dx, dy = dx / far, dy / far
    for i in range(2):
        along, across = C.F[i, 0] * dx + C.F[i, 1] * dy, C.F[i, 0] * dy - C.F[i, 1] * dx
        room = max(most * C.F[i, 2], 0.0) ** 2 - across * across
        if 0.0 <= room < along * along:
            moves = along - np.copysign(np.sqrt(room), along)
            C.F[i, 0], C.F[i, 1] = C.F[i, 0] - moves * dx, C.F[i, 1] - moves * dy
            C.F[1 - i, 0], C.F[1 - i, 1] = C.F[1 - i, 0] + moves * dx, C.F[1 - i, 1] + moves * dy


def slip_rate(w: Vector, i: int, part: int, C: Record) -> float:
    """u_i' = v' + w' x rho_i + w x rho_i', after forces()."""
    w_dot = C.w_dot[0], C.w_dot[1], C.w_dot[2]
    return C.v_dot[part] + cross(w_dot, row(C.rho, i))[part] + cross(w, row(C.rho_dot, i))[part]


def time_scale(modes: Modes, w_z: float, P: Record, C: Record) -> float:
    """dt/dtau: the product of |u|/(|u| + SLOW) over the contacts that may come to stick. For a patch that also spins,
    |u|^2 is replaced by |u|^2 + (radius w_z)^2."""
    g = 1.0
    if P.law.mu_s > 0.0:
        spin = P.law.radius * w_z
        for i in range(1 + P.stem):
            if modes[i] == SLIP:
                speed = np.sqrt(C.u[i, 0] ** 2 + C.u[i, 1] ** 2 + spin * spin)
                g *= speed / (speed + SLOW)
    return g


def rates(y: Array, slowest: int, modes: Modes, P: Record, C: Record, out: Array) -> float:
    """Writes dy/dtau into out; returns what forces() returns."""
    e, w, L3 = turn = arrange(y, slowest, modes, P, C)
    minor = forces(turn, modes, P, C)
    px, py, pz, pw, w3 = y[at.PX], y[at.PY], y[at.PZ], y[at.PW], L3 / P.I3
    ox, oy, oz = (w[0] - w3 * e[0]) / 2, (w[1] - w3 * e[1]) / 2, (w[2] - w3 * e[2]) / 2  # half that of the frame
    out[at.PX], out[at.PY] = ox * pw + oy * pz - oz * py, oy * pw + oz * px - ox * pz
    out[at.PZ], out[at.PW] = oz * pw + ox * py - oy * px, -ox * px - oy * py - oz * pz
    heat = P.drag * (w[0] * w[0] + w[1] * w[1] + w[2] * w[2])
    for i in range(1 + P.stem):
        for axis in range(3):
            heat -= C.F[i, axis] * C.u[i, axis] + C.M[i, axis] * w[axis]
    out[at.CHI], out[at.LX], out[at.LY], out[at.LZ] = w3, C.L_dot[0], C.L_dot[1], C.L_dot[2]
    out[at.VX], out[at.VY], out[at.X], out[at.Y] = C.v_dot[0], C.v_dot[1], C.G[0], C.G[1]
    out[at.TIME], out[at.HEAT], out[at.VZ], out[at.Z] = 1.0, heat, C.v_dot[2], C.G[2]
    g = time_scale(modes, w[2], P, C)
    if g != 1.0:
        for j in range(16):
            out[j] *= g
    if slowest != NO_ONE:  # log|u|' = |u|'/|u|, and beta' = (u' perpendicular to u)/|u|
        speed, along, across = np.exp(min(y[at.LOG_U], LOG_FAST)), np.cos(y[at.BETA]), np.sin(y[at.BETA])
        x_dot, y_dot = slip_rate(w, slowest, 0, C), slip_rate(w, slowest, 1, C)
        out[at.LOG_U] = (x_dot * along + y_dot * across) * g / speed
        out[at.BETA] = (y_dot * along - x_dot * across) * g / speed
    return minor


def kinetic(y: Array, L3: float, P: Record) -> float:
    """L^2/(2 I1) + k (L . e)^2/2 + v^2/2"""
    L_squared = y[at.LX] * y[at.LX] + y[at.LY] * y[at.LY] + y[at.LZ] * y[at.LZ]
    v_squared = y[at.VX] * y[at.VX] + y[at.VY] * y[at.VY] + y[at.VZ] * y[at.VZ]
    return (L_squared / P.I1 + (1 / P.I3 - 1 / P.I1) * L3 * L3 + v_squared) / 2
