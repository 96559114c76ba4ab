"""Plastic impacts: a contact closes with some velocity and does not bounce.

Friction is proportional to N, so during the impact, while N is very large for a very short time, the same law holds
with the normal impulse P in place of time (Routh; Keller, J. Appl. Mech. 53, 1, 1986):

    d(impulse)/dP = z - k(u) u ,   d(angular impulse)/dP = -t(u, w_z)   until u_z = 0 (plastic) .

If the law has static friction, the slip may stop during the impact. Rolling resistance and air drag are negligible.
"""

from typing import TypeAlias

import numpy as np

from ..paper.search import zero
from ..types import Array
from . import at
from .dynamics import (
    SLOW,
    angular,
    arrange,
    column,
    component,
    cross,
    holding,
    kinetic,
    least_along_the_line,
    respond,
    row,
    turning,
)
from .elimination import solve_linear
from .friction import bounds, push
from .kinds import Modes
from .records import BALL, NO_ONE, OPEN, STEM, STICK, Record
from .stepper import ORDER, STAGES, A, B, error, factor, stage

STOPPED = 1e-9  # relative to the speed of the impact: a smaller slip counts as 0
DIGITS = 1e-12  # the tolerance of a step, relative to the same
MOST_OF_AN_IMPACT = 10_000
REST = 1e-11  # ((gR)^1/2): slip below which a contact may stick
Slip: TypeAlias = tuple[float, float, float, float]  # u, w_z


def impact(W: Array, start: Array, law: Record, I: Record) -> Array:
    """The impulse and the angular impulse about z, (4,), for (u, w_z) = start + W impulse, W (4, 4), start (4,). I is
    working space."""
    scale, holds = np.sqrt(start[0] ** 2 + start[1] ** 2 + start[2] ** 2), law.mu_s > 0.0
    I.W[:], I.start[:], I.scale, I.J[:], I.allowed[:] = W, start, scale, 0.0, DIGITS * scale
    h = 0.01 * scale
    for _ in range(MOST_OF_AN_IMPACT):
        q = after(I, I.J)
        if holds and spread(q, law) <= STOPPED * scale:
            rest = held(W, q, law)
            most, twists = bounds(law)
            if np.hypot(rest[0], rest[1]) <= most * rest[2] and (rest[3] == 0.0 or abs(rest[3]) <= twists * rest[2]):
                return I.J + rest
            I.J[:], holds = I.J + away(W, q, rest, scale), False
        found = grow_impulse(I, law, h)
        if found < 1.0 and after(I, I.new)[2] >= 0.0:  # u_z = 0 within this step: found by varying its length
            grow_impulse(I, law, zero(rising, 0.0, h, (I, law)))
            return I.new.copy()
        if found < 1.0:
            I.J[:] = I.new
        h *= factor(found, ORDER)
    return I.J.copy()


def after(I: Record, J: Array) -> Slip:
    """(u, w_z) = start + W J, (4,)."""
    W, start = I.W, I.start
    return (
        start[0] + W[0, 0] * J[0] + W[0, 1] * J[1] + W[0, 2] * J[2] + W[0, 3] * J[3],
        start[1] + W[1, 0] * J[0] + W[1, 1] * J[1] + W[1, 2] * J[2] + W[1, 3] * J[3],
        start[2] + W[2, 0] * J[0] + W[2, 1] * J[1] + W[2, 2] * J[2] + W[2, 3] * J[3],
        start[3] + W[3, 0] * J[0] + W[3, 1] * J[1] + W[3, 2] * J[2] + W[3, 3] * J[3],
    )


def spread(q: Slip, law: Record) -> float:
    """The slip speed of the contact, including that of the spin of its patch."""
    return np.sqrt(q[0] * q[0] + q[1] * q[1] + (law.radius * q[3]) ** 2)


def held(W: Array, q: Slip, law: Record) -> Array:
    """The impulse that brings (u, w_z) = q to rest; w_z only if the law has a torque."""
    matrix, J = W.copy(), np.array([-q[0], -q[1], -q[2], -q[3]])
    if not law.pivots:
        J[3] = 0.0
    solve_linear(matrix, J, 4 if law.pivots else 3)
    return J


def away(W: Array, q: Slip, rest: Array, scale: float) -> Array:
    """The impulse with which it goes on slipping: slowly, opposite to the one that would have held it."""
    size, matrix, J = np.hypot(rest[0], rest[1]), W.copy(), np.zeros(4)
    J[0], J[1] = -2 * STOPPED * scale * rest[0] / size - q[0], -2 * STOPPED * scale * rest[1] / size - q[1]
    solve_linear(matrix, J, 3)
    return J


def grow_impulse(I: Record, law: Record, h: float) -> float:
    """Writes the impulse after a step of length h from I.J into I.new; returns the ratio of its error to the allowed
    one."""
    grow(I, law, I.J, I.K[0])
    for s in range(1, STAGES):
        stage(I.J, I.K, A[s], s, h, I.at)
        grow(I, law, I.at, I.K[s])
    stage(I.J, I.K, B, STAGES, h, I.new)
    grow(I, law, I.new, I.K[STAGES])
    return error(I.K, I.allowed, h)


def rising(h: float, I: Record, law: Record) -> float:
    """u_z after a step of length h."""
    grow_impulse(I, law, h)
    return after(I, I.new)[2]


def grow(I: Record, law: Record, J: Array, out: Array) -> None:
    """Writes d(impulse)/dP into out, times |u|/(|u| + SLOW) if the slip may stop, as in dynamics.py."""
    q = after(I, J)
    k, t = push(law, q[0] * q[0] + q[1] * q[1], q[3])
    g = 1.0
    if law.mu_s > 0.0:
        speed = spread(q, law)
        g = speed / (speed + SLOW * I.scale)
    out[0], out[1], out[2], out[3] = -k * q[0] * g, -k * q[1] * g, g, -t * g


# ---- the effect of an impulse at a contact, and the final halt of a slip ----


def mobility(i: int, j: int, y: Array, P: Record, C: Record) -> Array:
    """(4, 4): the change of (u_i, w_z) per unit of impulse, and of angular impulse about z, at contact j."""
    e, W, zero = turning(y, P)[0], np.zeros((4, 4)), (0.0, 0.0, 0.0)
    for axis in range(4):
        one = (1.0 if axis == 0 else 0.0, 1.0 if axis == 1 else 0.0, 1.0 if axis == 2 else 0.0)
        column(C, 0, j, 2, one, (0.0, 0.0, 1.0) if axis == 3 else zero)
        w_dot = angular((C.columns[0, 3], C.columns[0, 4], C.columns[0, 5]), e, P)
        for part in range(4):
            W[part, axis] = component(C, one, w_dot, i, part)
    return W


def give_impulse(y: Array, i: int, J: Array, P: Record, C: Record) -> None:
    """y after the impulse and angular impulse J (4,) at contact i; the energy lost is added to the heat."""
    before, impulse = kinetic(y, turning(y, P)[2], P), (J[0], J[1], J[2])
    torque = cross(row(C.rho, i), impulse)
    y[at.LX], y[at.LY], y[at.LZ] = y[at.LX] + torque[0], y[at.LY] + torque[1], y[at.LZ] + torque[2] + J[3]
    y[at.VX], y[at.VY], y[at.VZ] = y[at.VX] + J[0], y[at.VY] + J[1], y[at.VZ] + J[2]
    y[at.HEAT] += before - kinetic(y, turning(y, P)[2], P)


def moving(y: Array, i: int, P: Record, C: Record) -> Array:
    """(u, w_z) of contact i; the positions of the contacts go into C."""
    _, w, _ = arrange(y, NO_ONE, (OPEN, OPEN), P, C)
    return np.array([C.u[i, 0], C.u[i, 1], C.u[i, 2], w[2]])


def rests(y: Array, i: int, P: Record, C: Record) -> bool:
    """Whether contact i may stick."""
    if P.law.mu_s == 0.0:
        return False
    q = moving(y, i, P, C)
    return np.sqrt(q[0] ** 2 + q[1] ** 2 + (P.law.radius * q[3]) ** 2) < REST


def halted(y: Array, modes: Modes, P: Record, C: Record) -> None:
    """y without the slip of the contacts that stick in these modes; one that slips stays closed."""
    e, w, _ = arrange(y, NO_ONE, (OPEN, OPEN), P, C)
    both, n = modes[BALL] == modes[STEM] == STICK, 0
    for i in range(1 + P.stem):
        if modes[i] == STICK:
            n = holding(C, n, i, (0.0, 0.0, 0.0), P.law.pivots and not both)
        elif modes[i] != OPEN:
            n = column(C, n, i, 2, (0.0, 0.0, 1.0), (0.0, 0.0, 0.0))
    respond(n, e, P, C)
    for j in range(n):
        C.right[j] = -w[2] if C.part[j] == 3 else -C.u[C.owner[j], C.part[j]]
    if both:
        least_along_the_line(C)
    solve_linear(C.matrix, C.right, n)
    J = np.zeros((2, 4))
    for j in range(n):
        J[C.owner[j], C.part[j]] = C.right[j]
    for i in range(1 + P.stem):
        give_impulse(y, i, J[i], P, C)
