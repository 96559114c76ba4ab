"""The paper's equations, each once, written so that they work for floats, arrays, Decimals and compiled kernels alike.

The paper's letters, in units of R, M and g: c = cos(theta), s = sin(theta); w1, w2, w3 are the angular velocities about
1', 2' and 3; top is TopNumbers(a, I1, I3) or a Top. s2 = s^2, v = 1 - c, w1_2 = w1^2 and w2_2 = w2^2 are separate
arguments where they are known more accurately than from c, s, w1 or w2. np.sqrt works for Decimals too.

Each docstring begins with the printed form of the equation. Near a pole the bracket of (36) loses its figures; poles.py
has the form that is used there.
"""

from typing import TypeAlias

import numpy as np

from ..types import Number, Vector
from .top import Top, TopNumbers

AnyTop: TypeAlias = Top | TopNumbers  # a Top in Python; kernels take its numbers

# ---- the constants of the motion ----


def energy(w1: Number, w2: Number, w3: Number, velocity_2: Number, v: Number, top: AnyTop) -> Number:
    """(6)  E = (1/2) omega . L + (1/2) M v . v + M g z,  with v . v the square of G's velocity, z = a(1 - c)"""
    return (top.I1 * (w1 * w1 + w2 * w2) + top.I3 * w3 * w3 + velocity_2) / 2 + top.a * v


def C_J(c: Number, s: Number, w2: Number, w3: Number, top: AnyTop) -> Number:
    """(14)  C_J = L . r = I1 s w2 + I3 (c - a) w3,  which by (30) is I1 K_J"""
    return top.I1 * K_J(c, s, w2, w3, top)


def K_J(c: Number, s: Number, w2: Number, w3: Number, top: AnyTop) -> Number:
    """(30)  K_J = s w2 + (I3/I1)(c - a) w3"""
    return s * w2 + K_J_of_spin(c, w3, top)


def K_J_of_spin(c: Number, w3: Number, top: AnyTop) -> Number:
    """(30)  (I3/I1)(c - a) w3, the part of K_J due to the spin: all of it if w2 = 0 or at a pole"""
    return top.I3 / top.I1 * (c - top.a) * w3


def K_R(c: Number, s2: Number, w3: Number, top: AnyTop) -> Number:
    """(31)  K_R = f3 w3"""
    return np.sqrt(f3_2(c, s2, top)) * w3


def omega3(c: Number, s2: Number, K_R: Number, top: AnyTop) -> Number:
    """(31)  w3 = K_R/f3"""
    return K_R / np.sqrt(f3_2(c, s2, top))


def f3_2(c: Number, s2: Number, top: AnyTop) -> Number:
    """(32)  f3^2 = I3 + s^2 + (I3/I1)(c - a)^2"""
    return top.I3 + s2 + top.I3 / top.I1 * (c - top.a) ** 2


def two_E_prime(E: Number, K_J: Number, K_R: Number, top: AnyTop) -> Number:
    """(33)  2E' = 2E - K_R^2 + (I1/I3) K_J^2"""
    return 2 * E - K_R * K_R + top.I1 / top.I3 * K_J * K_J


def E_of(e: Number, K_J: Number, K_R: Number, top: AnyTop) -> Number:
    """(33)  E from 2E' = e"""
    return (e - two_E_prime(0, K_J, K_R, top)) / 2


def two_E_prime_of_motion(w1_2: Number, U: Number, c: Number, top: AnyTop) -> Number:
    """(33)  2E' = 2a(1 - c) + f2^2 w2^2 + f1^2 w1^2 = U + f1^2 w1^2"""
    return U + f1_2(c, top) * w1_2


def f2_2(c: Number, s2: Number, top: AnyTop) -> Number:
    """(34)  f2^2 = I1 + (I1/I3) s^2 + (c - a)^2"""
    return top.I1 + top.I1 / top.I3 * s2 + (c - top.a) ** 2


def f1_2(c: Number, top: AnyTop) -> Number:
    """(35)  f1^2 = I1 + 1 + a^2 - 2 a c"""
    return top.I1 + 1 + top.a * top.a - 2 * top.a * c


# ---- theta alone ----


def bracket(c: Number, K_J: Number, w3: Number, top: AnyTop) -> Number:
    """(36)  B = K_J - (I3/I1)(c - a) K_R/f3,  with K_R/f3 = w3; by (30) it is s w2"""
    return K_J - K_J_of_spin(c, w3, top)


def U(v: Number, c: Number, s2: Number, w2_2: Number, top: AnyTop) -> Number:
    """(33)  U = 2a(1 - c) + f2^2 w2^2,  2E' at theta_dot = 0: the effective potential of theta, with w2^2 = B^2/s^2"""
    return 2 * top.a * v + f2_2(c, s2, top) * w2_2


def theta_dot_2(e: Number, U: Number, c: Number, top: AnyTop) -> Number:
    """(36)  f1^2 theta_dot^2 = 2E' - 2a(1 - c) - (f2^2/s^2) [K_J - (I3/I1)(c - a) K_R/f3]^2 = e - U"""
    return (e - U) / f1_2(c, top)


def bracket_slope(c: Number, s2: Number, w3: Number, top: AnyTop) -> Number:
    """from (36)  dB/dc = -(I3/I1) K_R (I3 + 1 - a c)/f3^3,  with K_R/f3 = w3"""
    return -top.I3 / top.I1 * w3 * (top.I3 + 1 - top.a * c) / f3_2(c, s2, top)


def s4_U_slope(c: Number, s2: Number, B: Number, dB: Number, top: AnyTop) -> Number:
    """from (36)  dU/dc = -2a + d(f2^2/s^2)/dc B^2 + 2 (f2^2/s^2) B dB/dc

    s^4 dU/dc = -2a s^4 + 2 [(c - a)(1 - a c) + I1 c] B^2 + 2 f2^2 s^2 B dB/dc, rearranged because U is infinite at the
    poles. The zeros are the steady precessions.
    """
    a = top.a
    return -2 * a * s2 * s2 + 2 * B * (((c - a) * (1 - a * c) + top.I1 * c) * B + f2_2(c, s2, top) * s2 * dB)


# ---- the forces ----


def force_terms(
    c: Number, s: Number, w2: Number, w3: Number, top: AnyTop
) -> tuple[Number, Number, Number, Number, Number]:
    """X, Y0, Y1, Z0, Z1 of F_x = X w1,  F_y = Y0 + Y1 w1^2,  F_z = Z0 + Z1 w1^2,  with w1 = theta_dot, w1^2 = f:

    (37)  F_z = 1 + a (s f'/2 + c f)
    (38)  F_x = -(I3 K_R f^(1/2)/f3^3) [c - (I3/I1)(c - a)]
    (39)  (1 - a c) F_y = a s F_z + I1 f'/2 - I1 (c/s) w2^2 + I3 w2 w3

    rearranged, because (39) is 0/0 at a c = 1 and all three lose their figures at the poles. With f' written out, (31),
    and q = w1^2 + w2^2,

    F_z = 1 + (a/f1^2) {[c (I1 + 1 + a^2) - a (1 + c^2)] q - a s^2 - (I3 + 1 - a c) s w2 w3}
    F_x = -(I3 w3/f3^2) [c - (I3/I1)(c - a)] w1
    F_y = (a s/f1^2) {1 - a c + [a (c - a) - I1] q} + (w2 w3/f1^2) [I3 (1 - a c) - I1 - a^2 s^2]
    """
    a, I1, I3 = top.a, top.I1, top.I3
    s2, w2_2, f1_sq = s * s, w2 * w2, f1_2(c, top)
    lever = a / f1_sq
    X = -I3 * w3 / f3_2(c, s2, top) * (c - I3 / I1 * (c - a))
    Y1 = lever * s * (a * (c - a) - I1)
    Y0 = lever * s * (1 - a * c) + Y1 * w2_2 + w2 * w3 / f1_sq * (I3 * (1 - a * c) - I1 - a * a * s2)
    Z1 = lever * (c * (I1 + 1 + a * a) - a * (1 + c * c))
    Z0 = 1 - lever * (a * s2 + (I3 + 1 - a * c) * s * w2 * w3) + Z1 * w2_2
    return X, Y0, Y1, Z0, Z1


def force(c: Number, s: Number, w1: Number, w1_2: Number, w2: Number, w3: Number, top: AnyTop) -> Vector:
    """(38), (39), (37)  F_x, F_y, F_z at the contact point without slipping; F_x changes sign with theta_dot"""
    X, Y0, Y1, Z0, Z1 = force_terms(c, s, w2, w3, top)
    return X * w1, Y0 + Y1 * w1_2, Z0 + Z1 * w1_2


# ---- relations without a number of their own ----


def rolling_velocity(c: Number, s: Number, w1: Number, w2: Number, w3: Number, top: AnyTop) -> tuple[Number, Number]:
    """(4)  v = omega x r, the velocity of G without slipping; along x and y: w2 (c - a) - w3 s,  -w1 (1 - a c)"""
    return w2 * (c - top.a) - w3 * s, -w1 * (1 - top.a * c)


def two_E_smooth(s2: Number, w1: Number, w2: Number, v: Number, top: AnyTop) -> Number:
    """(B3)  e = 2E - I3 w3^2 = I1 (w1^2 + w2^2) + a^2 s^2 w1^2 + 2a(1 - c),  if G moves only vertically"""
    return 2 * energy(w1, w2, 0, top.a * top.a * s2 * w1 * w1, v, top)


def L_z(c: Number, s: Number, w2: Number, w3: Number, top: AnyTop) -> Number:
    """(B4)  L_z = I1 s w2 + I3 c w3,  the vertical component of the angular momentum about G"""
    return top.I1 * s * w2 + top.I3 * c * w3


def I_eff(c: Number, s2: Number, top: AnyTop) -> Number:
    """note 58  I_eff = I1 s^2 + I3 (c - a)^2,  for a rotation about r: K_min = C_J^2/(2 I_eff)"""
    return top.I1 * s2 + top.I3 * (c - top.a) ** 2
