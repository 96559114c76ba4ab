"""A motion in intervals, each with its vectors in space and their time derivatives, and the motions of the derivation.

Derivatives are those of the polynomial through the motion's own poses at 48 times (barycentric, with the longest
float); the angular velocity is that of its quaternions.
"""

from collections.abc import Callable, Iterator
from functools import cached_property
from typing import TypeAlias, TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy.fft import dct

from app.model.scene import Scene
from tippe_core import Constants, Gliding, Rolling, State, Top, Trajectory
from tippe_core.types import Array, Complex, Number

LONG = np.longdouble
Long: TypeAlias = NDArray[np.floating]  # arrays of the longest float, or of floats where that is enough
Of = TypeVar("Of")
Run: TypeAlias = Callable[[Array], Trajectory]  # a function of times
NODES, EDGE = 48, 8  # of each window; near its ends a derivative is mostly rounding error
TURN = 6.0  # rad in a window: as much as its polynomial can follow
RESOLVED = 1e-12  # relative to the largest: smaller last Chebyshev coefficients of a window are rounding errors
MOST_WINDOWS, NARROWEST = 48, 1e-5
STEP = 1e-20  # in the imaginary direction, where nothing cancels
Z = np.array([0.0, 0.0, 1.0])


def differentiation(t: Array) -> Long:
    """The matrix that gives the derivative, at the samples, of the polynomial through them (barycentric)."""
    t = t.astype(LONG)
    gap = t[:, None] - t[None, :]
    np.fill_diagonal(gap, 1)
    weight = 1 / np.prod(gap / ((t[-1] - t[0]) / 4), axis=1)
    matrix = weight[None, :] / weight[:, None] / gap
    np.fill_diagonal(matrix, 0)
    np.fill_diagonal(matrix, -matrix.sum(axis=1))
    return matrix


def dot(p: Long, q: Long) -> Long:
    return (p * q).sum(axis=1)


def column(x: Long) -> Long:
    return x[:, None]


class Window:
    """An interval of a motion: its vectors in space, one row for each time, and d(x), the time derivative of any of
    them.

    The names are the paper's: r, v, L, F, omega. omega and axis come from differentiating the quaternions, w1, w2, w3
    and L from the motion. e1, e2, axis are the unit vectors 1', 2', 3; y = z x 1'.
    """

    def __init__(self, top: Top, motion: Trajectory, constants: Constants, state: State) -> None:
        self.top, self.motion, self.constants, self.state = top, motion, constants, state
        self.a, self.I1, self.I3, self.dI = top.a, top.I1, top.I3, top.I3 - top.I1
        self.t, self.theta = motion.t, motion.theta
        self.s, self.c = np.sin(self.theta), np.cos(self.theta)
        self._matrix = differentiation(motion.t)
        x, y, z, w = q = motion.quaternion.astype(LONG).T
        dx, dy, dz, dw = (self._matrix @ q.T).T
        # omega = 2 q_dot q^-1 and the third column of the rotation
        self.omega = 2 * np.stack([w * dx - x * dw + y * dz - z * dy, w * dy - y * dw + z * dx - x * dz,
                                   w * dz - z * dw + x * dy - y * dx], axis=1)  # fmt: skip
        self.axis = np.stack([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)], axis=1)
        across = np.cross(Z, self.axis)
        with np.errstate(invalid="ignore", divide="ignore"):
            self.e1 = across / np.sqrt(dot(across, across))[:, None]
        self.e2, self.y = np.cross(self.axis, self.e1), np.cross(Z, self.e1)
        self.w1, self.w2, self.w3 = w1, w2, w3 = motion.omega.astype(LONG).T
        across = column(w1) * self.e1 + column(w2) * self.e2
        self.L = top.I1 * across + top.I3 * column(w3) * self.axis
        self._turn = across + column(w3) * self.axis
        F_x, F_y, F_z = motion.force.T
        self.F = column(F_x) * self.e1 + column(F_y) * self.y + column(F_z) * Z
        self.com = motion.com.astype(LONG)
        self.r = self.com - np.column_stack([motion.contact, 0 * self.t])
        v_x, v_y, v_z = motion.velocity.T
        self.v = column(v_x) * self.e1 + column(v_y) * self.y + column(v_z) * Z
        self.weight = np.broadcast_to(-Z, self.v.shape)
        self._shared()

    def _shared(self) -> None:
        """What several equations need."""
        self.L_dot, self.v_dot, self.omega_dot = self.d(self.L), self.d(self.v), self.d(self._turn)
        self.r_dot, self.w3_dot = self.d(self.r), self.d(self.w3)
        with np.errstate(invalid="ignore", divide="ignore"):
            # theta itself changes abruptly near a pole, cos(theta) does not
            self.theta_dot = -self.d(self.axis[:, 2]) / self.s
            self.theta_double_dot = (self.d(self.s * self.w1) - self.c * self.w1**2) / self.s
        self.r3 = dot(self.r, self.axis)
        beside = self.r - column(self.r3) * self.axis
        self.r_across = np.sqrt(dot(beside, beside))
        self.lean = dot(self.omega, np.cross(self.axis, Z))  # omega . (3 x z) = -sin(theta) theta_dot
        self.sense = np.where(self.w1 < 0, -1.0, 1.0)
        # R -> 0: the same body with a pointed peg, at the same tilts; derivatives at R = 0
        self.L3_pointed, self.L3_slope = self._L3(0.0).real, self._L3(STEP * 1j).imag / STEP  # L_3 and dL_3/dR
        self.Lz_pointed = self.a * (self.L3_slope - self.L3_slope[0])  # by (13), minus its value at the first tilt

    def d(self, x: Long) -> Long:
        return self._matrix @ x

    def turning(self, x: Long) -> Long:
        """Components along 1', y, z."""
        return np.column_stack([dot(x, self.e1), dot(x, self.y), x[:, 2]])

    def along(self, e: Long) -> Long:
        return dot(self.omega, e)

    def of(self, function: Callable[[Array, Top, Constants], Of]) -> Of:
        """f, omega2, ... of tippe_core at these tilts, from the constants alone."""
        return function(self.theta, self.top, self.constants)

    @cached_property
    def energy(self) -> Long:
        v = self.d(self.com)
        return (dot(self.omega, self.L) + dot(v, v)) / 2 + self.com[:, 2] - (1 - self.a)

    def _L3(self, R: complex) -> Complex:
        """(25) for any R, with the spin constant K of R = 0: L_3 = I3 K/f3(R)."""
        K: Number = self.constants.K_R
        s2 = np.sin(self.theta) ** 2
        f3 = np.sqrt(self.I3 + R * R * s2 + self.I3 / self.I1 * (R * self.c - self.a) ** 2 + 0j)
        return self.I3 * K / f3


def resolved(motion: Trajectory) -> bool:
    """Whether the polynomial through the samples of a window has converged: its last Chebyshev coefficients are
    rounding errors."""
    samples = np.column_stack([motion.quaternion, motion.omega[:, 2], motion.com])
    size = np.abs(dct(samples, type=1, axis=0)) / np.maximum(1, np.abs(samples).max(axis=0))
    return size[-6:].max() < RESOLVED


def windows(run: Run, period: float, top: Top, constants: Constants, state: State) -> Iterator[Window]:
    """Windows that cover one period of a motion, or its first MOST_WINDOWS; run(times) gives its Trajectory."""
    fastest = np.abs(run(np.linspace(0, period, 7)).omega).max()
    width, begin, found = min(0.6 * period, TURN / max(fastest, 1e-3)), 0.0, 0
    shape = (1 - np.cos(np.pi * np.arange(NODES) / (NODES - 1))) / 2
    while begin < period and found < MOST_WINDOWS:
        times = begin + width * (shape - shape[EDGE])
        motion = run(times)
        if not resolved(motion) and width > NARROWEST * period:
            width /= 2
            continue
        yield Window(top, motion, constants, state)
        begin, found, width = begin + width * (1 - 2 * shape[EDGE]), found + 1, 1.4 * width


def rolled(scene: Scene) -> list[Window]:
    """Windows over one nutation of the scene's own motion."""
    return list(windows(_from_zero(scene.rolling), scene.rolling.period, scene.top, scene.constants, scene.state))


def glided(scene: Scene) -> list[Window]:
    """Windows of the motion that starts like the scene's, but with G at rest, on a perfectly smooth plane."""
    gliding = Gliding(scene.top, scene.state)
    return list(windows(_from_zero(gliding), gliding.period, scene.top, scene.constants, scene.state))


def _from_zero(series: Rolling | Gliding) -> Run:
    """A Rolling or Gliding as a function of the time since its start; the first of the given times is its start."""
    return lambda times: series(np.concatenate([[0.0], times]))[1:]
