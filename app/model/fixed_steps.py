"""Coulomb's law in fixed steps: what a program shows that steps over the moment in which the contact sticks.

R. J. Cohen, Am. J. Phys. 45, 12 (1977), has F = -mu F_N v/|v| (his eq. 16) and a Runge-Kutta method of order four. This
is here to show what goes wrong with that; tippe_core.slide finds the moment."""

import numpy as np

from tippe_core import State, Top


def cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """a x b of two vectors: numpy's takes ten times as long."""
    (a1, a2, a3), (b1, b2, b3) = a.tolist(), b.tolist()
    return np.array([a2 * b3 - a3 * b2, a3 * b1 - a1 * b3, a1 * b2 - a2 * b1])


def slope(top: Top, mu: float, y: np.ndarray) -> np.ndarray:
    """dy/dt (9,) of y: the axis 3, the angular momentum L about G and the velocity V of G, as vectors in space, in
    units of R, M and g."""
    axis, L, V = y[:3], y[3:6], y[6:]
    spin, change = L @ axis, 1 / top.I3 - 1 / top.I1
    omega = L / top.I1 + change * spin * axis
    r = top.a * axis - [0, 0, 1]  # (3): from G to the contact point
    turning = cross(omega, axis)  # 3'
    v = (V + cross(omega, r))[:2]  # his (15)
    speed = np.hypot(*v)
    force = np.array([*(-mu * v / speed if speed else (0, 0)), 1])  # his (16), for F_N = 1
    torque = cross(r, force)
    # G is 1 - a 3_z high, so F_N = 1 - a 3_z'', where 3'' is linear in F_N: his (18) and (19)
    free = change * spin * cross(turning, axis) + cross(omega, turning)
    F_N = (1 - top.a * free[2]) / (1 + top.a * cross(torque, axis)[2] / top.I1)
    return np.concatenate([turning, F_N * torque, F_N * force - [0, 0, 1]])


def in_steps(top: Top, start: State, mu: float, step: float, t_end: float) -> tuple[np.ndarray, np.ndarray]:
    """t (n,) and theta (n,) of a top that starts at rest but for its spin, by Runge-Kutta of order four in equal steps,
    in units of R, M and g."""
    axis = np.array([np.sin(start.theta), 0, np.cos(start.theta)])
    y = np.concatenate([axis, top.I3 * start.omega3 * axis, np.zeros(3)])
    t = np.arange(round(t_end / step) + 1) * step
    theta = np.empty(len(t))
    for i in range(len(t)):
        theta[i] = np.arctan2(np.hypot(y[0], y[1]), y[2])
        k1 = slope(top, mu, y)
        k2 = slope(top, mu, y + step / 2 * k1)
        k3 = slope(top, mu, y + step / 2 * k2)
        k4 = slope(top, mu, y + step * k3)
        y = y + step / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
    return t, theta
