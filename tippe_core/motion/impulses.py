"""The effect of an impulse at a contact, and the final halt of a slip."""

import numpy as np

from ..compiled import compiled
from ..types import Array
from .dynamics import NO_ONE, OPEN, angular, arrange, column, component, cross, kinetic, row, turning
from .impact import held
from .records import HEAT, LX, LY, LZ, VX, VY, VZ, Record

REST = 1e-11  # ((gR)^1/2): slip below which a contact may stick


@compiled
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


@compiled
def pushed(y: Array, i: int, J: Array, P: Record, C: Record) -> None:
    """y after the impulse and angular impulse J (4,) at contact i; the energy lost is added to the heat."""
    before, impulse = kinetic(y, turning(y, P)[2], P), (J[0], J[1], J[2])
    torque = cross(row(C.rho, i), impulse)
    y[LX], y[LY], y[LZ] = y[LX] + torque[0], y[LY] + torque[1], y[LZ] + torque[2] + J[3]
    y[VX], y[VY], y[VZ] = y[VX] + J[0], y[VY] + J[1], y[VZ] + J[2]
    y[HEAT] += before - kinetic(y, turning(y, P)[2], P)


@compiled
def moving(y: Array, i: int, P: Record, C: Record) -> Array:
    """(u, w_z) of contact i; the positions of the contacts go into C."""
    _, w, _ = arrange(y, NO_ONE, OPEN, OPEN, P, C)
    return np.array([C.u[i, 0], C.u[i, 1], C.u[i, 2], w[2]])


@compiled
def rests(y: Array, i: int, P: Record, C: Record) -> bool:
    """Whether contact i may stick."""
    if P.law.mu_s == 0.0:
        return False
    q = moving(y, i, P, C)
    return np.sqrt(q[0] ** 2 + q[1] ** 2 + (P.law.width * q[3]) ** 2) < REST


@compiled
def halted(y: Array, i: int, P: Record, C: Record) -> None:
    """y with the rest of the slip of contact i removed."""
    q = moving(y, i, P, C)
    pushed(y, i, held(mobility(i, i, y, P, C), (q[0], q[1], q[2], q[3]), P.law), P, C)
