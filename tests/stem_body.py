"""A top with a stem as a rigid body on a table that yields: the oracle for lift-off, landing and two contacts.

A body with a quaternion q, an angular velocity w (body axes), the place and the velocity of G moves by Newton's and
Euler's equations. Nothing holds it on the table, and there are no impacts: ball and stem's end each sink into it by a
depth d and are pushed up like by a spring with a damper,

    N = max(0, k m d + 2 damping (k m m)^1/2 d'),   F = N (z - k(u) u),

m a mass such as that contact meets at most, so that both have the period 2 pi/k^1/2, 0.006 (R/g)^1/2 at k = 1e6. What
slide() decides by cases (who carries, lifts off, lands, sticks) here follows from the force; the hard table is the
limit k -> infinity. The law of friction is this file's own:

    Viscous: k(u) = gamma;   SmoothedCoulomb: k(u) = mu/(u^2 + eps^2)^1/2;   Coulomb: that with the eps given;
    Contensou: Coulomb's of each place of a round patch that presses as Hertz says, summed by quadrature,

true stick being the limit eps -> 0. Stepping is Runge and Kutta's of fourth order; a step is a share of the shortest
time scale there and then, that of the table or that of friction. Units: R, M, g. Compiled, about a second for 60 s of
the real toy.
"""

from dataclasses import dataclass
from math import atan2, cos, hypot, pi, sin, sqrt

import numpy as np
from numba import njit

BALL, STEM = 1, 2  # bits of Motion.touching
MOST_CHANGES = 20_000


@dataclass(frozen=True, eq=False)
class Motion:
    """One row a time: theta; omega about 1', 2', 3; place of G; loads of the ball and of the stem's end; energy.

    touching: (time, bits) wherever what touches has changed, bits the sum of BALL and STEM, 0 in the air.
    """

    t: np.ndarray
    theta: np.ndarray
    omega: np.ndarray
    com: np.ndarray
    loads: np.ndarray
    energy: np.ndarray
    touching: tuple

    def spent(self, bits, since=0.0):
        """The share of the time since then for which just these touched."""
        t = np.array([t for t, _ in self.touching] + [self.t[-1]])
        spans = np.diff(np.maximum(t, since))
        return sum(span for span, (_, now) in zip(spans, self.touching, strict=True) if now == bits) / spans.sum()


def integrate(top, state, friction, times, edge=None, k=1e6, damping=7.0, eps=1e-4, share=0.5):
    """The Motion from a State (of tippe_core) at times[0]; psi is left out, the body being one of revolution.

    edge: as slide()'s. eps: of the smoothed law in place of Coulomb's. share: of the shortest time scale, a step;
    halving it, and a larger k, are the checks of the oracle's own error.
    """
    law = {"Viscous": lambda: (True, friction.gamma, 0.0),
           "SmoothedCoulomb": lambda: (False, friction.mu, friction.eps),
           "Coulomb": lambda: (False, friction.mu_k, eps),
           "Contensou": lambda: (False, friction.mu, eps)}[type(friction).__name__]()  # fmt: skip
    is_patch = type(friction).__name__ == "Contensou"
    summed, radius = (_summed(), friction.radius) if is_patch else (np.empty((0, 2)), 0.0)
    b, h, q = (*edge, 0.0)[:3] if edge else (0.0, 0.0, -1.0)  # a radius below 0: no stem
    reach = hypot(b, top.a + h) + q
    masses = 1 / (1 + top.a**2 / min(top.I1, top.I3)), 1 / (1 + reach**2 / min(top.I1, top.I3))
    body = np.array([top.a, top.I1, top.I3, b, h, q, *masses, k, damping, law[1], law[2], radius])
    y = _start(top, state, edge and (b, h, q))
    times = np.asarray(times, dtype=float)
    rows, loads, changes, count = _follow(y, body, law[0], summed, times, share)
    if count > MOST_CHANGES:
        raise ArithmeticError(f"contacts opened and closed more than {MOST_CHANGES} times")
    z = np.array([2 * (rows[:, 0] * rows[:, 2] - rows[:, 3] * rows[:, 1]),
                  2 * (rows[:, 1] * rows[:, 2] + rows[:, 3] * rows[:, 0]),
                  1 - 2 * (rows[:, 0] ** 2 + rows[:, 1] ** 2)])  # the vertical in body axes  # fmt: skip
    across = np.hypot(z[0], z[1])
    n = z[:2] / np.where(across > 0, across, 1.0)  # 2', as it is seen from the body
    w = rows[:, 4:7].T
    omega = np.array([w[0] * n[1] - w[1] * n[0], w[0] * n[0] + w[1] * n[1], w[2]])
    kinetic = ((rows[:, 4:7] ** 2 * [top.I1, top.I1, top.I3]).sum(axis=1) + (rows[:, 10:13] ** 2).sum(axis=1)) / 2
    touching = tuple((float(t), int(bits)) for t, bits in changes[:count])
    return Motion(times, np.arctan2(across, z[2]), omega.T, rows[:, 7:10], loads,
                  kinetic + rows[:, 9] - (1 - top.a), touching)  # fmt: skip


def _summed(columns=2000):
    """Force and torque of a patch of radius 1 with load 1 and friction 1, (columns + 1, 2): it slips by cos(x) and
    turns by sin(x), for x from 0 to pi/2; pressure (3/2 pi)(1 - r^2)^1/2."""
    r, weight = (half / 2 for half in np.polynomial.legendre.leggauss(60))
    angle = 2 * np.pi * (np.arange(90) + 0.5) / 90
    r, angle = np.meshgrid(r + 0.5, angle, indexing="ij")
    load = 1.5 / np.pi * np.sqrt(1 - r * r) * r * weight[:, None] * 2 * np.pi / 90
    found = []
    for x in np.linspace(0, np.pi / 2, columns + 1):
        along, across = np.cos(x) - np.sin(x) * r * np.sin(angle), np.sin(x) * r * np.cos(angle)
        speed = np.hypot(along, across) + 1e-300
        turns = r * (across * np.cos(angle) - along * np.sin(angle))
        found.append([(load * along / speed).sum(), (load * turns / speed).sum()])
    return np.array(found)


def _start(top, state, edge):
    """(q, w, G, v): the lowest point of ball and stem just at the table, its height at rest."""
    half, turn = state.theta / 2, state.phi / 2
    q = sin(half) * cos(turn), sin(half) * sin(turn), cos(half) * sin(turn), cos(half) * cos(turn)
    s, c, a = sin(state.theta), cos(state.theta), top.a
    on_ball = 1 - a * c, a * s  # height of G, and its change with theta
    on_stem = (edge[2] + edge[0] * s - (a + edge[1]) * c, edge[0] * c + (a + edge[1]) * s) if edge else (-1.0, 0.0)
    height, rise = max(on_ball, on_stem)
    vx, vy, rx, ry = state.vx or 0.0, state.vy or 0.0, cos(state.phi), sin(state.phi)
    return np.array([*q, state.theta_dot, state.omega2, state.omega3, state.x or 0.0, state.y or 0.0, height,
                     vx * rx - vy * ry, vx * ry + vy * rx, rise * state.theta_dot])  # fmt: skip


@njit(cache=True, error_model="numpy")
def _rates(y, body, viscous, summed, dy, out):
    """dy/dt into dy; out: loads of ball and stem, and 1/time of the quickest thing that happens."""
    a, I1, I3, b, h, q_stem, m_ball, m_stem, k, damping, mu, eps, radius = body
    qx, qy, qz, qw = y[0], y[1], y[2], y[3]
    # the body's axes in space, columns of the matrix of q
    xx, xy, xz = 1 - 2 * (qy * qy + qz * qz), 2 * (qx * qy + qw * qz), 2 * (qx * qz - qw * qy)
    yx, yy, yz = 2 * (qx * qy - qw * qz), 1 - 2 * (qx * qx + qz * qz), 2 * (qy * qz + qw * qx)
    ex, ey, ez = 2 * (qx * qz + qw * qy), 2 * (qy * qz - qw * qx), 1 - 2 * (qx * qx + qy * qy)
    p, q, r = y[4], y[5], y[6]
    wx, wy, wz = xx * p + yx * q + ex * r, xy * p + yy * q + ey * r, xz * p + yz * q + ez * r
    s = sqrt(ex * ex + ey * ey)
    Fx, Fy, Fz, Mx, My, Mz, quick = 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, sqrt(k) * max(1.0, 2 * damping)
    for i in range(2 if q_stem >= 0 else 1):
        m = m_ball if i == 0 else m_stem
        if i == 0:
            cx, cy, cz = a * ex, a * ey, a * ez - 1.0
        else:
            down = b / s if s > 1e-12 else 0.0
            along = a + h + down * ez
            cx, cy, cz = along * ex, along * ey, along * ez - down - q_stem
        depth = -(y[9] + cz)
        out[i] = 0.0
        if depth <= 0.0:
            continue
        ux, uy = y[10] + wy * cz - wz * cy, y[11] + wz * cx - wx * cz
        uz = y[12] + wx * cy - wy * cx
        N = k * m * depth - 2 * damping * sqrt(k) * m * uz
        if N <= 0.0:
            continue
        u2, turn = ux * ux + uy * uy, 0.0
        push = mu if viscous else mu / sqrt(u2 + eps * eps)
        if radius > 0.0:
            rim = radius * wz
            x = atan2(abs(rim), sqrt(u2)) / (pi / 2) * (len(summed) - 1)
            j = min(int(x), len(summed) - 2)
            force, torque = summed[j] + (x - j) * (summed[j + 1] - summed[j])
            speed = sqrt(u2 + rim * rim)
            slow = speed / sqrt(speed * speed + eps * eps)
            push = mu * force * slow / max(sqrt(u2), 1e-12)
            turn = -radius * mu * N * torque * slow * (1.0 if rim > 0 else -1.0)
        fx, fy = -N * push * ux, -N * push * uy
        Fx, Fy, Fz = Fx + fx, Fy + fy, Fz + N
        Mx, My, Mz = Mx + cy * N - cz * fy, My + cz * fx - cx * N, Mz + cx * fy - cy * fx + turn
        out[i] = N
        quick = max(quick, N * push / m)
    out[2] = quick
    # q' = q w/2 with w in the body's axes; Euler's equations there
    dy[0] = (qw * p + qy * r - qz * q) / 2
    dy[1] = (qw * q + qz * p - qx * r) / 2
    dy[2] = (qw * r + qx * q - qy * p) / 2
    dy[3] = -(qx * p + qy * q + qz * r) / 2
    dy[4] = (xx * Mx + xy * My + xz * Mz + (I1 - I3) * q * r) / I1
    dy[5] = (yx * Mx + yy * My + yz * Mz + (I3 - I1) * p * r) / I1
    dy[6] = (ex * Mx + ey * My + ez * Mz) / I3
    dy[7], dy[8], dy[9], dy[10], dy[11], dy[12] = y[10], y[11], y[12], Fx, Fy, Fz


@njit(cache=True, error_model="numpy")
def _moved(y, step, dy, out):
    for i in range(13):
        out[i] = y[i] + step * dy[i]


@njit(cache=True, error_model="numpy")
def _follow(y, body, viscous, summed, times, share):
    rows, loads, changes = np.empty((len(times), 13)), np.empty((len(times), 2)), np.empty((MOST_CHANGES + 1, 2))
    d1, d2, d3, d4, at = np.empty(13), np.empty(13), np.empty(13), np.empty(13), np.empty(13)
    out, spare = np.zeros(3), np.zeros(3)
    t, count, before = times[0], 0, -1
    for n in range(len(times)):
        while True:
            _rates(y, body, viscous, summed, d1, out)
            bits = (1 if out[0] > 0 else 0) + (2 if out[1] > 0 else 0)
            if bits != before and count <= MOST_CHANGES:
                changes[count, 0], changes[count, 1] = t, bits
                before, count = bits, count + 1
            if t >= times[n]:
                break
            left = times[n] - t
            step = min(share / out[2], left)
            _moved(y, step / 2, d1, at)
            _rates(at, body, viscous, summed, d2, spare)
            _moved(y, step / 2, d2, at)
            _rates(at, body, viscous, summed, d3, spare)
            _moved(y, step, d3, at)
            _rates(at, body, viscous, summed, d4, spare)
            for i in range(13):
                y[i] += step / 6 * (d1[i] + 2 * (d2[i] + d3[i]) + d4[i])
            size = 1 / sqrt(y[0] ** 2 + y[1] ** 2 + y[2] ** 2 + y[3] ** 2)
            for i in range(4):
                y[i] *= size
            t = times[n] if step == left else t + step
        rows[n], loads[n, 0], loads[n, 1] = y, out[0], out[1]
    return rows, loads, changes, count
