"""The pose at any phase of a nutation, from the sums of its series (nutation.py): the kernels that loop over times."""

from typing import NamedTuple

import numpy as np

from ..compiled import compiled
from ..types import Array, Complex, Number, Scalars
from .series import BLOCK, part_turn, sine, sums


class Ends(NamedTuple):
    """The turning points and the pole offsets of a nutation, in the form that kernels use.

    v = 1 - c and m = 1 + c at the inner turning point (1) and the outer one (2), width = c1 - c2, and the pole offsets:
    the values of s w2 extrapolated to theta = 0 (upright) and theta = pi (inverted).
    """

    v1: float
    v2: float
    m1: float
    m2: float
    width: float
    upright: float
    inverted: float


class Pose(NamedTuple):
    """Values at n instants, (n,) each: cos(kappa/2) and sin(kappa/2), v = 1 - c, m = 1 + c, the angles in rad,
    s exp(i phi); and the quaternion (n, 4)."""

    cos_half: Array
    sin_half: Array
    v: Array
    m: Array
    theta: Array
    phi: Array
    psi: Array
    s_exp_phi: Complex
    quaternion: Array


@compiled
def split_phase(passed: Array, period: float, half: float, rest: float) -> tuple[Array, Array, Array]:
    """Whole periods, half periods (0 or 1) and the remaining phase, -pi/2 to pi/2, (n,) each, at the times (n,) after
    the instant at which the phase was pi half + rest."""
    n = len(passed)
    turns, halves, rests = np.empty(n), np.empty(n), np.empty(n)
    # whole periods are subtracted exactly: the phase is as smooth in t after 10,000 periods as in the first
    leading = np.float64(np.float32(period))
    for i in range(n):
        whole = np.floor(passed[i] / period)
        angle = ((passed[i] - whole * leading) - whole * (period - leading)) * (2 * np.pi / period)
        count = np.round((angle + rest) / np.pi)
        rests[i] = (angle - count * np.pi) + rest
        turn = np.floor((half + count) / 2)
        turns[i], halves[i] = turn + whole, half + count - 2 * turn
    return turns, halves, rests


@compiled
def v_and_m(cos_half: Number, sin_half: Number, ends: Ends) -> tuple[Number, Number]:
    """v = 1 - c and m = 1 + c from cos_half = cos(kappa/2) and sin_half = sin(kappa/2); (n,) each, or numbers."""
    return ends.v1 + ends.width * (sin_half * sin_half), ends.m2 + ends.width * (cos_half * cos_half)


def half_angle(half: float, rest: float, series: float) -> tuple[float, float]:
    """cos and sin of kappa/2 = (pi half + rest + series)/2."""
    s = sine((rest + series) / 2)
    c = np.sqrt(1 - s * s)
    return (-s, c) if half else (c, s)


@compiled
def tilts(passed: Array, period: float, half: float, rest: float, kappa: Array, ends: Ends) -> tuple[Array, Array]:
    """sin(theta) and cos(theta), (n,) each. Arguments as in split_phase(), and the series (1, K) of kappa - tau."""
    s, c = np.empty(len(passed)), np.empty(len(passed))
    for first in range(0, len(passed), BLOCK):
        block = slice(first, min(first + BLOCK, len(passed)))
        _, halves, rests = split_phase(passed[block], period, half, rest)
        tilt(halves, rests, sums(halves, rests, kappa, kappa[:0])[0], ends, s[block], c[block])
    return s, c


def tilt(half: Array, rest: Array, kappa: Array, ends: Ends, s: Array, c: Array) -> None:
    """Writes sin(theta) and cos(theta) into s and c at the phases pi half + rest; kappa: kappa minus the phase. (n,)
    each."""
    for i in range(len(rest)):
        small = sine((rest[i] + kappa[i]) / 2) ** 2  # sin(kappa/2)^2 in the inner half, cos(kappa/2)^2 in the outer
        up, down = (small, 1 - small) if half[i] else (1 - small, small)
        v, m = ends.v1 + ends.width * down, ends.m2 + ends.width * up
        s[i], c[i] = np.sqrt(v * m), (m - v) / 2


def cis(angle: float) -> complex:
    """exp(i angle)"""
    return complex(np.cos(angle), np.sin(angle))


def nearer_pole(v: float, m: float, ends: Ends) -> tuple[float, float, float]:
    """cos(theta) of the nearer pole, the distance of c from it, and its offset."""
    return (1.0, v, ends.upright) if v <= m else (-1.0, m, ends.inverted)


def pole_factor(cos_half: float, sin_half: float, x1: float, x2: float, offset: float) -> complex:
    """x1^1/2 cos(kappa/2) +- i x2^1/2 sin(kappa/2), with x = v at theta = 0 and x = m at pi, and the sign of the
    offset."""
    return complex(np.sqrt(x1) * cos_half, np.copysign(np.sqrt(x2), offset) * sin_half)


def pole_angle(factor: complex, offset: float, at_pole: float, turns: float) -> float:
    """The argument of the factor after that many periods; if the factor is 0, at the pole itself, that just after."""
    angle = np.copysign(at_pole, offset) if factor == 0 else np.arctan2(factor.imag, factor.real)
    return angle + np.pi * turns * np.copysign(1.0, offset)


@compiled
def pose(
    turns: Array, half: Array, rest: Array, series: Array, mean: Array, ends: Ends, d_phi: float, d_psi: float
) -> Pose:
    """The Pose at the phases 2 pi turns + pi half + rest (n,), with d_phi and d_psi added to phi and psi.

    series (3 or more, n): kappa minus the phase, and sigma_- and sigma_+ minus their mean rates (mean (2,)) times the
    phase.
    """
    n = len(rest)
    cos_halves, sin_halves, v, m = np.empty(n), np.empty(n), np.empty(n), np.empty(n)
    theta, phi, psi, quaternion = np.empty(n), np.empty(n), np.empty(n), np.empty((n, 4))
    s_exp_phi = np.empty(n, np.complex128)
    turn_minus, turn_plus = cis((d_phi - d_psi) / 2), cis((d_phi + d_psi) / 2)
    before, whole_minus, whole_plus, exp_minus, exp_plus = np.nan, 0.0, 0.0, 1.0 + 0.0j, 1.0 + 0.0j
    for i in range(n):
        if turns[i] != before:
            # whole turns are kept apart: rounded with them, the angles of late periods would not be smooth in time
            before = turns[i]
            whole_minus = 2 * np.pi * part_turn(turns[i], mean[0])
            whole_plus = 2 * np.pi * part_turn(turns[i], mean[1])
            parity = -1.0 if np.remainder(turns[i], 2.0) == 1 else 1.0
            exp_minus, exp_plus = parity * turn_minus * cis(whole_minus), parity * turn_plus * cis(whole_plus)
        cos_half, sin_half = half_angle(half[i], rest[i], series[0, i])
        cos_halves[i], sin_halves[i] = cos_half, sin_half
        v[i], m[i] = v_and_m(cos_half, sin_half, ends)
        theta[i] = 2 * np.arctan2(np.sqrt(v[i]), np.sqrt(m[i]))
        upright = pole_factor(cos_half, sin_half, ends.v1, ends.v2, ends.upright)
        inverted = pole_factor(cos_half, sin_half, ends.m1, ends.m2, ends.inverted)
        tau = np.pi * half[i] + rest[i]
        minus, plus = mean[0] * tau + series[1, i], mean[1] * tau + series[2, i]
        xy, zw = upright * exp_minus * cis(minus), inverted * exp_plus * cis(plus)
        s_exp_phi[i] = xy * zw
        quaternion[i, 0], quaternion[i, 1] = xy.real * np.sqrt(0.5), xy.imag * np.sqrt(0.5)
        quaternion[i, 2], quaternion[i, 3] = zw.imag * np.sqrt(0.5), zw.real * np.sqrt(0.5)
        minus += whole_minus + 2 * np.pi * np.trunc(turns[i] * mean[0])
        plus += whole_plus + 2 * np.pi * np.trunc(turns[i] * mean[1])
        at_upright = pole_angle(upright, ends.upright, np.pi / 2, turns[i])
        at_inverted = pole_angle(inverted, ends.inverted, np.pi, turns[i])
        phi[i] = plus + minus + at_upright + at_inverted + d_phi
        psi[i] = plus - minus + at_inverted - at_upright + d_psi
    return Pose(cos_halves, sin_halves, v, m, theta, phi, psi, s_exp_phi, quaternion)


@compiled
def theta_dot(cos_half: float, sin_half: float, v: float, m: float, dt_dkappa: float, width: float) -> float:
    """w1; where it changes sign, at a pole, the value just after it."""
    if width == 0:
        return 0.0
    if v == 0:
        return np.sqrt(width / 2) / dt_dkappa
    if m == 0:
        return -np.sqrt(width / 2) / dt_dkappa
    return width * sin_half * cos_half / (dt_dkappa * np.sqrt(v * m))


def half_sigma_rate(x: Array, x1: float, x2: float, offset: float, dt_dkappa: Array, slope: Scalars) -> Array:
    """d sigma/dkappa (n,): half of dt/dkappa (offset/x + slope), minus the abrupt change at the pole,
    +- (x1 x2)^1/2/(2x).

    For sigma_- x = v and phi_dot (1 + c) - w3 = offset/v + slope; for sigma_+ x = m and
    phi_dot (1 - c) + w3 = offset/m + slope.
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        peak = np.where(x <= 0, 0.0, (dt_dkappa * offset - np.copysign(np.sqrt(x1 * x2), offset)) / x)
    return (peak + dt_dkappa * slope) / 2
