"""Plastic impacts: a contact closes with some velocity and does not bounce.

Friction is proportional to N, so during the impact, while N is very large for a very short time, the same law holds
with the normal impulse P in place of time (Routh; Keller, J. Appl. Mech. 53, 1, 1986):

    d(impulse)/dP = z - k(u) u ,   d(angular impulse)/dP = -t(u, w_z)   until u_z = 0 (plastic) .

If the law has static friction, the slip may stop during the impact. Rolling resistance and air drag are negligible.
"""

from typing import TypeAlias

import numpy as np

from ..compiled import compiled
from ..types import Array
from .dynamics import SLOW
from .elimination import solve
from .friction import CONTENSOU, COULOMB, bounds, push
from .records import Record
from .stepper import ORDER, STAGES, A, B, error, factor, stage

STOPPED = 1e-9  # relative to the speed of the impact: a smaller slip counts as 0
DIGITS = 1e-12  # the tolerance of a step, relative to the same
MOST_STEPS = 10_000
Slip: TypeAlias = tuple[float, float, float, float]  # u, w_z


@compiled
def impact(W: Array, start: Array, law: Record) -> Array:
    """The impulse and the angular impulse about z, (4,), for (u, w_z) = start + W impulse, W (4, 4), start (4,)."""
    scale, holds = np.sqrt(start[0] ** 2 + start[1] ** 2 + start[2] ** 2), law.mu_s > 0.0
    K, J, new, at = np.zeros((STAGES + 1, 4)), np.zeros(4), np.zeros(4), np.zeros(4)
    allowed, h = np.full(4, DIGITS * scale), 0.01 * scale
    for _ in range(MOST_STEPS):
        q = after(W, start, J)
        if holds and spread(q, law) <= STOPPED * scale:
            rest = held(W, q, law)
            most, twists = bounds(law)
            if np.hypot(rest[0], rest[1]) <= most * rest[2] and (rest[3] == 0.0 or abs(rest[3]) <= twists * rest[2]):
                return J + rest
            J, holds = J + away(W, q, rest, scale), False
        found = attempt(W, start, law, scale, J, h, K, at, new, allowed)
        if not found < 1.0:
            h *= factor(found, ORDER)
            continue
        if after(W, start, new)[2] >= 0.0:
            return closing(W, start, law, scale, J, h, K, at, new, allowed)
        J[:] = new
        h *= factor(found, ORDER)
    return J


@compiled
def after(W: Array, start: Array, J: Array) -> Slip:
    """(u, w_z) = start + W J, (4,)."""
    return (
        start[0] + W[0, 0] * J[0] + W[0, 1] * J[1] + W[0, 2] * J[2] + W[0, 3] * J[3],
        start[1] + W[1, 0] * J[0] + W[1, 1] * J[1] + W[1, 2] * J[2] + W[1, 3] * J[3],
        start[2] + W[2, 0] * J[0] + W[2, 1] * J[1] + W[2, 2] * J[2] + W[2, 3] * J[3],
        start[3] + W[3, 0] * J[0] + W[3, 1] * J[1] + W[3, 2] * J[2] + W[3, 3] * J[3],
    )


@compiled
def spread(q: Slip, law: Record) -> float:
    """The slip speed of the contact, including that of the spin of its patch."""
    return np.sqrt(q[0] * q[0] + q[1] * q[1] + (law.width * q[3]) ** 2)


@compiled
def held(W: Array, q: Slip, law: Record) -> Array:
    """The impulse that brings (u, w_z) = q to rest; w_z only if the law has a torque."""
    matrix, J = W.copy(), np.array([-q[0], -q[1], -q[2], -q[3]])
    if law.kind != CONTENSOU:
        J[3] = 0.0
    solve(matrix, J, 4 if law.kind == CONTENSOU else 3)
    return J


@compiled
def away(W: Array, q: Slip, rest: Array, scale: float) -> Array:
    """The impulse with which it goes on slipping: slowly, opposite to the one that would have held it."""
    size, matrix, J = np.hypot(rest[0], rest[1]), W.copy(), np.zeros(4)
    J[0], J[1] = -2 * STOPPED * scale * rest[0] / size - q[0], -2 * STOPPED * scale * rest[1] / size - q[1]
    solve(matrix, J, 3)
    return J


@compiled
def attempt(
    W: Array,
    start: Array,
    law: Record,
    scale: float,
    J: Array,
    h: float,
    K: Array,
    at: Array,
    new: Array,
    allowed: Array,
) -> float:
    """Writes J after one step into new; returns the ratio of its error to the allowed one."""
    grow(W, start, law, scale, J, K[0])
    for s in range(1, STAGES):
        stage(J, K, A[s], s, h, at)
        grow(W, start, law, scale, at, K[s])
    stage(J, K, B, STAGES, h, new)
    grow(W, start, law, scale, new, K[STAGES])
    return error(K, allowed, h)


@compiled
def grow(W: Array, start: Array, law: Record, scale: float, J: Array, out: Array) -> None:
    """Writes d(impulse)/dP into out, times |u|/(|u| + SLOW) if the slip may stop, as in dynamics.py."""
    q = after(W, start, J)
    k, t = push(law, q[0] * q[0] + q[1] * q[1], q[3])
    g = 1.0
    if law.kind == COULOMB or law.kind == CONTENSOU:
        speed = spread(q, law)
        g = speed / (speed + SLOW * scale)
    out[0], out[1], out[2], out[3] = -k * q[0] * g, -k * q[1] * g, g, -t * g


@compiled
def closing(
    W: Array,
    start: Array,
    law: Record,
    scale: float,
    J: Array,
    h: float,
    K: Array,
    at: Array,
    new: Array,
    allowed: Array,
) -> Array:
    """The impulse at which u_z = 0, within the step of length h from J, found by varying the step (false position)."""
    low, high, f_low, f_high, side = 0.0, h, after(W, start, J)[2], after(W, start, new)[2], 0
    for _ in range(60):
        x = high - f_high * (high - low) / (f_high - f_low)
        attempt(W, start, law, scale, J, x, K, at, new, allowed)
        f = after(W, start, new)[2]
        if abs(f) < 1e-15 * scale or high - low < 1e-15 * h:
            break
        if f > 0.0:
            high, f_high, f_low, side = x, f, (f_low / 2 if side > 0 else f_low), 1
        else:
            low, f_low, f_high, side = x, f, (f_high / 2 if side < 0 else f_high), -1
    return new
