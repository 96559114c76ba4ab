"""The forces at the contact point, equations (37) to (39), as functions of theta.

With f' carried out, (37) and (39) have neither the 0/0 of (39) at a c = 1 nor the poles' cancellation:

    F_z = 1 + (a/f1^2) {[c (I1 + 1 + a^2) - a (1 + c^2)] (w1^2 + w2^2) - a s^2 - f2^2 g s w2}
    F_y = (a s/f1^2) {(1 - a c) + [a (c - a) - I1] (w1^2 + w2^2)} + w2 [(1 - a c) f2^2 g/f1^2 - w3]
    F_x = -(I3 K_R/f3^3) [c - (I3/I1)(c - a)] w1 ,           g = (I3/I1) K_R (I3 + 1 - a c)/f3^3 ,  w1 = theta_dot .
"""

from typing import overload

import numpy as np

from ..types import Array, Number, Scalars, Vector
from .constants import Constants, f1_2, f2_2, f3_2, versines
from .curve import bracket_slope, f, omega2, omega3
from .top import Top


def contact_force(
    v: Number, m: Number, top: Top, K_R: Number, w1: Number, w1_squared: Number, w2: Number, w3: Number
) -> Vector:
    """(F_x, F_y, F_z) in Mg in the turning axes, from v = 1 - cos(theta), m = 1 + cos(theta) and omega in 1', 2', 3."""
    a, I1 = top.a, top.I1
    c, s2 = 1 - v, v * m
    s, f1_sq, square = np.sqrt(s2), f1_2(c, top), w1_squared + w2**2
    f3_sq, f2_sq_g = f3_2(c, s2, top), f2_2(c, s2, top) * bracket_slope(c, s2, top, K_R)
    Fx = -top.I3 * K_R / f3_sq**1.5 * (c - top.I3 / I1 * (c - a)) * w1
    Fy = a * s / f1_sq * ((1 - a * c) + (a * (c - a) - I1) * square) + w2 * ((1 - a * c) * f2_sq_g / f1_sq - w3)
    Fz = 1 + a / f1_sq * ((c * (I1 + 1 + a * a) - a * (1 + c * c)) * square - a * s2 - f2_sq_g * s * w2)
    return Fx, Fy, Fz


def forces_on_curve(theta: Scalars, top: Top, constants: Constants, w1_squared: Scalars) -> Vector:
    """(F_x, F_y, F_z) of (37) to (39) for theta_dot > 0, in Mg, where theta_dot^2 is this."""
    v, m = versines(theta)
    w2, w3 = (function(theta, top, constants) for function in (omega2, omega3))
    with np.errstate(invalid="ignore"):
        return contact_force(v, m, top, constants.K_R, np.sqrt(w1_squared), w1_squared, w2, w3)


@overload
def normal_force(theta: float, top: Top, constants: Constants) -> Scalars: ...
@overload
def normal_force(theta: Array, top: Top, constants: Constants) -> Array: ...
def normal_force(theta: Scalars, top: Top, constants: Constants) -> Scalars:
    """F_z = 1 + a (s f'/2 + c f), (37), in Mg. theta in rad; theta and the constants broadcast.

    nan at a pole that no motion with this K_J reaches.
    """
    return forces_on_curve(theta, top, constants, f(theta, top, constants))[2]


@overload
def friction_force(theta: float, top: Top, constants: Constants) -> tuple[Scalars, Scalars]: ...
@overload
def friction_force(theta: Array, top: Top, constants: Constants) -> tuple[Array, Array]: ...
def friction_force(theta: Scalars, top: Top, constants: Constants) -> tuple[Scalars, Scalars]:
    """(F_x, F_y) for theta_dot > 0, (38) and (39), in Mg; F_x turns its sign with theta_dot.

    x along 1' (the line of nodes), y along z cross 1'. theta in rad; theta and the constants broadcast. F_x is nan
    where f < 0.
    """
    return forces_on_curve(theta, top, constants, f(theta, top, constants))[:2]
