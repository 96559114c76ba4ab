"""A round-pegged top as a rigid body in space: the oracle for rolling motion.

Nothing here comes from the paper's integrated formulas (30)-(39). A body with a quaternion, an angular velocity and a
place moves by Newton's and Euler's equations, and the contact force F is whatever keeps the contact point at rest:

    v' = F - z,                      I w' + w x I w = -r x F,                     v = w x r,   r = z - a 3

Differentiating v = w x r gives F = z + w' x r + w x (-a w x 3); put into Euler's equation this is a linear system
for w'. Vectors are resolved along the body's axes, where I is constant. Units: R, M, g.

Time stepping is by collocation: on each step the solution is a polynomial through Chebyshev points that satisfies the
equations at all of them (found by Picard's iteration), in the machine's longest float. On x86 that leaves an error
near 1e-17 a step, so the oracle is sharper than what it judges; its own error is tested in test_oracles.py.
"""

from dataclasses import dataclass

import numpy as np

LONG = np.longdouble
NODES = 36


@dataclass(frozen=True)
class Body:
    """Distance a of G below O along axis 3 and the principal moments at G."""

    a: float
    I1: float
    I3: float

    @classmethod
    def of(cls, top):
        return cls(top.a, top.I1, top.I3)


@dataclass(frozen=True, eq=False)
class Motion:
    """What the integration returns, one row a time; vectors in space axes except `omega_body`."""

    t: np.ndarray
    quaternion: np.ndarray
    omega_body: np.ndarray
    contact: np.ndarray
    force: np.ndarray

    @property
    def omega(self):
        return rotate(self.quaternion.T, self.omega_body.T).T


def cross(p, q):
    return p[[1, 2, 0]] * q[[2, 0, 1]] - p[[2, 0, 1]] * q[[1, 2, 0]]


def dot(p, q):
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]


def rotate(q, v):
    """A body vector v (3, ...) in space axes, q (4, ...) = x, y, z, w."""
    n = cross(q[:3], v)
    return v + 2 * (q[3] * n + cross(q[:3], n)) / (q * q).sum(axis=0)


def rotate_back(q, v):
    """A space vector in body axes."""
    return rotate(np.stack([-q[0], -q[1], -q[2], q[3]]), v)


def product(p, q):
    """The quaternion that turns first by q, then by p; components x, y, z, w along axis 0."""
    vector = p[3] * q[:3] + q[3] * p[:3] + cross(p[:3], q[:3])
    return np.concatenate([vector, [p[3] * q[3] - dot(p, q)]])


def euler_quaternion(phi, theta, psi):
    """Rz(phi) Rx(theta) Rz(psi), by multiplying the three turns."""
    phi, theta, psi = (LONG(angle) / 2 for angle in (phi, theta, psi))
    zero = LONG(0)
    about_z = np.array([zero, zero, np.sin(phi), np.cos(phi)])
    about_x = np.array([np.sin(theta), zero, zero, np.cos(theta)])
    about_3 = np.array([zero, zero, np.sin(psi), np.cos(psi)])
    return product(product(about_z, about_x), about_3)


def to_body(psi, along_1, along_2, along_3):
    """Components along 1', 2', 3 turned into components along the body's own axes."""
    c, s = np.cos(LONG(psi)), np.sin(LONG(psi))
    return np.array([c * along_1 + s * along_2, -s * along_1 + c * along_2, LONG(along_3)])


def acceleration(body, z, w):
    """w' and F (both in body axes) from the vertical z and the angular velocity w (3, ...)."""
    axis = np.zeros_like(z)
    axis[2] = 1
    r = z - body.a * axis
    inertia = np.array([body.I1, body.I1, body.I3], dtype=z.dtype).reshape((3,) + (1,) * (z.ndim - 1))
    carried = z - body.a * cross(w, cross(w, axis))  # F less w' x r
    torque = -cross(w, inertia * w) - cross(r, carried)
    # I w' + r x (w' x r) = torque, a diagonal matrix less r r^T (Sherman and Morrison)
    diagonal = inertia + dot(r, r)
    lean = r / diagonal
    w_dot = torque / diagonal
    w_dot = w_dot + lean * dot(r, w_dot) / (1 - dot(r, lean))
    return w_dot, carried + cross(w_dot, r)


def force_at(body, theta, theta_dot, omega2, omega3):
    """Contact force (3, ...) along the turning axes x, y, z, for arrays of states."""
    theta, theta_dot, omega2, omega3 = np.broadcast_arrays(theta, theta_dot, omega2, omega3)
    s, c = np.sin(theta), np.cos(theta)
    z = np.stack([0 * s, s, c])
    _, force = acceleration(body, z, np.stack([theta_dot, omega2, omega3]))
    return np.stack([force[0], c * force[1] - s * force[2], dot(force, z)])


def constants(body, quaternion, omega_body):
    """L . r / I1 (Jellett), the root of twice (25) with w3's sign (Routh), and the energy; from vectors, not angles."""
    q, w = np.asarray(quaternion).T, np.asarray(omega_body).T
    vertical = np.zeros_like(w)
    vertical[2] = 1
    z = rotate_back(q, vertical)
    r = z - body.a * np.eye(3)[2].reshape((3,) + (1,) * (w.ndim - 1))
    momentum = w * np.array([body.I1, body.I1, body.I3]).reshape((3,) + (1,) * (w.ndim - 1))
    velocity = cross(w, r)
    jellett = dot(momentum, r) / body.I1
    across = r[0] ** 2 + r[1] ** 2
    routh = w[2] * np.sqrt(body.I3 + across + body.I3 / body.I1 * r[2] ** 2)
    energy = (dot(w, momentum) + dot(velocity, velocity)) / 2 + body.a * (1 - z[2])
    return jellett, routh, energy


def _chebyshev(n):
    """Points on [-1, 1], their barycentric weights, and the matrix that integrates from -1."""
    k = np.arange(n)
    pi = LONG("3.14159265358979323846264338327950288")
    points = -np.cos(pi * k / (n - 1))
    weights = (LONG(-1)) ** k
    weights[[0, -1]] /= 2
    # values -> coefficients (a cosine sum), then integrate T_j, then evaluate
    cosines = np.cos(pi * np.outer(k, k) / (n - 1)) * (LONG(-1)) ** k[:, None]  # T_j(points_k), row j
    to_coefficients = cosines * 2 / (n - 1)
    to_coefficients[:, [0, -1]] /= 2
    to_coefficients[[0, -1], :] /= 2
    integrals = np.zeros((n, n), dtype=LONG)
    angle = np.arccos(np.clip(points, -1, 1))
    for j in range(n):
        if j == 0:
            primitive = points
        elif j == 1:
            primitive = points**2 / 2
        else:
            primitive = (np.cos((j + 1) * angle) / (j + 1) - np.cos((j - 1) * angle) / (j - 1)) / 2
        integrals[:, j] = primitive - primitive[0]
    return points, weights, integrals @ to_coefficients, to_coefficients


_POINTS, _WEIGHTS, _INTEGRATE, _COEFFICIENTS = _chebyshev(NODES)


def _rates(body, y):
    """Time derivative of (q, w, contact), rows of y (9, n)."""
    q, w = y[:4], y[4:7]
    vertical = np.zeros_like(w)
    vertical[2] = 1
    w_dot, _ = acceleration(body, rotate_back(q, vertical), w)
    spin = np.concatenate([w, np.zeros_like(w[:1])])
    w_space = rotate(q, w)
    # the contact stays under O, and O moves with w x z
    return np.concatenate([product_columns(q, spin) / 2, w_dot, [w_space[1], -w_space[0]]])


def product_columns(p, q):
    vector = p[3] * q[:3] + q[3] * p[:3] + cross(p[:3], q[:3])
    return np.concatenate([vector, [p[3] * q[3] - dot(p, q)]])


def _step(body, y, h):
    """The polynomial over one step as values at the points, or None where it is not resolved."""
    values = np.repeat(y[:, None], NODES, axis=1)
    small = 4 * np.finfo(LONG).eps
    for _ in range(60):
        new = y[:, None] + h / 2 * (_rates(body, values) @ _INTEGRATE.T)
        change = np.abs(new - values).max()
        values = new
        if not change < 1e6:
            return None
        if change <= small * np.abs(values).max():
            break
    else:
        return None
    tail = np.abs(values @ _COEFFICIENTS[-2:].T).max()
    return values if tail <= 16 * small * np.abs(values).max() else None


def integrate(body, quaternion, omega_body, times, contact=(0, 0), turn=2.5):
    """Roll the body from its state at times[0] through all of `times` (rising).

    `turn` is the angle in radians that a step may cover; halving it is the check of the oracle's own error.
    """
    times = np.asarray(times, dtype=float)
    y = np.concatenate([np.asarray(part, dtype=LONG) for part in (quaternion, omega_body, contact)])
    rows = np.empty((len(times), 9), dtype=LONG)
    t, done = LONG(times[0]), 0
    h = LONG(turn) / max(1, np.sqrt(dot(y[4:7], y[4:7])))
    while done < len(times):
        values = _step(body, y, h)
        if values is None:
            h /= 2
            if h < 1e-9:
                raise ArithmeticError(f"no step at t = {t}")
            continue
        while done < len(times) and times[done] <= t + h:
            at = 2 * (LONG(times[done]) - t) / h - 1
            gap = at - _POINTS
            hit = np.flatnonzero(gap == 0)
            share = _WEIGHTS / np.where(gap == 0, 1, gap)
            rows[done] = values[:, hit[0]] if hit.size else values @ share / share.sum()
            done += 1
        y, t = values[:, -1], t + h
        h = min(h * LONG(1.25), LONG(turn) / max(1, np.sqrt(dot(y[4:7], y[4:7]))))
    columns = rows.T
    vertical = np.zeros_like(columns[:3])
    vertical[2] = 1
    _, force = acceleration(body, rotate_back(columns[:4], vertical), columns[4:7])
    force = rotate(columns[:4], force).T
    return Motion(times, rows[:, :4], rows[:, 4:7], rows[:, 7:], force)
