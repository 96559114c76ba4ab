"""A round-pegged top sliding on a table, as a rigid body in space: the oracle for motion with friction.

No Euler angles, no constants, no formula of tippe_core: body-to-space quaternion, angular velocity and velocity of G,
all in space axes, and for the accelerations the equations of Newton and Euler with the condition that the top stays
on the table, as seven linear equations for (w', v', N) by LAPACK:

    v' = N (z - k) - z,   I w' + w x I w = -r x N (z - k),   z . (v - w x r)' = 0,   r = z - a 3

k (horizontal) is friction over N, opposite in sign; the law k(u) of the slip u = v - w x r is the caller's. Losses
(delta, drag) are two more moments about G: -N delta w_h/|w_h|, w_h the horizontal part of w, and -drag w.
"""

from dataclasses import dataclass

import numpy as np
from references import kept
from rigid_body import euler_quaternion
from scipy.integrate import solve_ivp

UP = np.array([0.0, 0.0, 1.0])


def skew(v):
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def matrix(q):
    """Body to space, from the quaternion x, y, z, w of any length."""
    x, y, z, w = q / np.linalg.norm(q)
    turn = skew([x, y, z])
    return np.eye(3) + 2 * w * turn + 2 * turn @ turn


def slip(top, axis, w, v):
    return v - np.cross(w, UP - top.a * axis)


def accelerations(top, law, axis, w, v, losses=(0.0, 0.0)):
    """(w', v', N) with the axis 3, w and v in space axes."""
    delta, drag = losses
    r = UP - top.a * axis
    inertia = top.I1 * np.eye(3) + (top.I3 - top.I1) * np.outer(axis, axis)
    direction = UP - law(slip(top, axis, w, v))
    left, right = np.zeros((7, 7)), np.zeros(7)
    left[:3, :3], left[:3, 6] = inertia, np.cross(r, direction)
    right[:3] = -np.cross(w, inertia @ w) - drag * w
    if delta:
        left[:2, 6] += delta * w[:2] / np.hypot(*w[:2])
    left[3:6, 3:6], left[3:6, 6] = np.eye(3), -direction
    right[3:6] = -UP
    left[6, :3], left[6, 3:6] = UP @ skew(r), UP  # z . (v' + r x w') = z . (w x r')
    right[6] = UP @ np.cross(w, -top.a * np.cross(w, axis))
    solved = np.linalg.solve(left, right)
    return solved[:3], solved[3:6], solved[6]


def sphere(top):
    """A contact: from G to the sphere's lowest point, as a function of the axis 3."""
    return lambda axis: top.a * axis - UP


def edge(top, radius, height):
    """A contact: from G to the lowest point of a circle about axis 3, that many R above O."""

    def lowest(axis):
        first = np.cross(axis, [0.6, 0.0, 0.8])  # two radii of the circle
        first /= np.linalg.norm(first)
        second = np.cross(axis, first)
        beta = np.arctan2(-second[2], -first[2])
        return (top.a + height) * axis + radius * (np.cos(beta) * first + np.sin(beta) * second)

    return lowest


def supported(top, law, contacts, axis, w, v):
    """(w', v', N of each contact) where all contacts press on the table.

    As accelerations(), with one unknown N and one condition z . (v + w x rho)' = 0 a contact, rho' by differences.
    """
    inertia, m = top.I1 * np.eye(3) + (top.I3 - top.I1) * np.outer(axis, axis), len(contacts)
    left, right = np.zeros((6 + m, 6 + m)), np.zeros(6 + m)
    left[:3, :3], left[3:6, 3:6] = inertia, np.eye(3)
    right[:3], right[3:6] = -np.cross(w, inertia @ w), -UP
    axis_dot, h = np.cross(w, axis), 1e-5
    for i, contact in enumerate(contacts):
        rho = contact(axis)
        rho_dot = (contact(axis + h * axis_dot) - contact(axis - h * axis_dot)) / (2 * h)
        push = UP - law(v + np.cross(w, rho))
        left[:3, 6 + i], left[3:6, 6 + i] = -np.cross(rho, push), -push
        left[6 + i, :3], left[6 + i, 3:6] = -UP @ skew(rho), UP
        right[6 + i] = -UP @ np.cross(w, rho_dot)
    solved = np.linalg.solve(left, right)
    return solved[:3], solved[3:6], solved[6:]


@dataclass(frozen=True, eq=False)
class Motion:
    """One row a time; vectors in space axes. work: of friction, since the start."""

    quaternion: np.ndarray
    omega: np.ndarray
    velocity: np.ndarray
    com: np.ndarray
    work: np.ndarray


def integrate(top, law, quaternion, omega, velocity, com, times, rtol=1e-12, contacts=None, losses=(0.0, 0.0)):
    """From the state at times[0], velocity and com (3,) those of G, through times (rising).

    contacts: those that press on the table all the time; the sphere's alone if not given, and then with losses.
    """

    def rates(_, y):
        q, w, v = y[:4], y[4:7], y[7:10]
        axis = matrix(q)[:, 2]
        if contacts is None:
            w_dot, v_dot, N = accelerations(top, law, axis, w, v, losses)
            slips, loads = [slip(top, axis, w, v)], [N]
        else:
            w_dot, v_dot, loads = supported(top, law, contacts, axis, w, v)
            slips = [v + np.cross(w, contact(axis)) for contact in contacts]
        q_dot = np.append(q[3] * w + np.cross(w, q[:3]), -w @ q[:3]) / 2
        power = sum(-N * law(u) @ u for N, u in zip(loads, slips, strict=True))
        return np.concatenate([q_dot, w_dot, v_dot, v, [power]])

    start = np.concatenate([quaternion, omega, velocity, com, [0.0]])
    y = solve_ivp(rates, (times[0], times[-1]), start, "DOP853", times, rtol=rtol, atol=rtol).y.T
    return Motion(y[:, :4], y[:, 4:7], y[:, 7:10], y[:, 10:13], y[:, 13])


@kept
def slid(top, friction, quaternion, omega, velocity, com, times, rtol, rim, is_on_ball):
    """What integrate() gives, from what can be stored."""
    contacts = [*([sphere(top)] if is_on_ball else []), edge(top, *rim)] if rim else None
    moved = integrate(top, lambda u: friction.k(u @ u) * u, quaternion, omega, velocity, com, times, rtol, contacts)
    return moved.quaternion, moved.omega, moved.velocity, moved.com, moved.work


def stored(top, friction, quaternion, omega, velocity, com, times, rtol=1e-12, rim=None, is_on_ball=True):
    """The Motion of integrate() under a law of friction, on the ball, on a stem's rim (radius, height), or on both."""
    return Motion(*slid(top, friction, quaternion, omega, velocity, com, times, rtol, rim, is_on_ball))


def linearised(top, law, pole, spin):
    """Eigenvalues of small motions about spinning on the axis: pole = 1 upright, -1 inverted; spin about axis 3.

    In the axis's and the spin's horizontal components and G's velocity, by central differences.
    """

    def rates(y):
        axis = np.array([y[0], y[1], pole * np.sqrt(1 - y[0] ** 2 - y[1] ** 2)])
        across = np.array([y[2], y[3], 0.0])
        across[2] = -axis @ across / axis[2]
        w = spin * axis + across
        v = np.array([y[4], y[5], 0.0])
        v[2] = np.cross(w, UP - top.a * axis)[2]
        w_dot, v_dot, _ = accelerations(top, law, axis, w, v)
        axis_dot = np.cross(w, axis)
        across_dot = w_dot - (w_dot @ axis + w @ axis_dot) * axis - spin * axis_dot
        return np.concatenate([axis_dot[:2], across_dot[:2], v_dot[:2]])

    steps = 1e-4 * np.eye(6)
    columns = [(8 * (rates(h) - rates(-h)) - (rates(2 * h) - rates(-2 * h))) / (12 * 1e-4) for h in steps]
    return np.linalg.eigvals(np.array(columns).T)


def in_space(phi, theta, along_1, along_2, along_3):
    """Components along 1', 2', 3 (arrays) turned into space components (n, 3)."""
    s, c, y = np.sin(theta), np.cos(theta), np.stack([-np.sin(phi), np.cos(phi), 0 * phi])
    x, z = np.stack([np.cos(phi), np.sin(phi), 0 * phi]), np.array([[0.0], [0.0], [1.0]])
    return (along_1 * x + along_2 * (c * y + s * z) + along_3 * (c * z - s * y)).T


def rotated(phi, horizontal):
    turn = np.exp(1j * phi) * (horizontal[:, 0] + 1j * horizontal[:, 1])
    return np.stack([turn.real, turn.imag], axis=1)


def first_instant(top, state):
    phi, theta = np.array([state.phi]), np.array([state.theta])
    omega = in_space(phi, theta, state.theta_dot, state.omega2, state.omega3)[0]
    q = euler_quaternion(state.phi, state.theta, state.psi).astype(float)
    flat = rotated(phi, np.array([[state.vx or 0.0, state.vy or 0.0]]))[0]
    axis = matrix(q)[:, 2]
    velocity = np.append(flat, np.cross(omega, UP - top.a * axis)[2])
    return q, omega, velocity, np.array([state.x or 0.0, state.y or 0.0, 1 - top.a * axis[2]])
