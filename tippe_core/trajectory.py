"""The record that every kind of motion returns."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .curve import f3_squared
from .errors import TopError, numbers
from .top import Top


@dataclass(frozen=True, eq=False)
class Trajectory:
    """A motion of a top at n instants, in units of R, M and g.

    t (n,) times; theta, phi, psi (n,) Euler angles in rad, phi the azimuth of 1', continuous in time but for the half
    turns at a pole;
    quaternion (n, 4) x, y, z, w, body to space = Rz(phi) Rx(theta) Rz(psi);
    contact (n, 2) and com (n, 3), the contact point and G in space, z from the table up;
    omega (n, 3) about 1', 2', 3; slip (n, 2), the velocity of the top's material at the contact, and
    force (n, 3) on the top there, both in the turning axes x (along 1'), y (z cross 1'), z;
    regime (n,) "roll", "slip" or "air"; events, a tuple of (time, what).
    jellett, routh and energy (n,) are computed from these, not from what was asked for. All arrays are read-only.
    """

    top: Top
    t: np.ndarray
    theta: np.ndarray
    phi: np.ndarray
    psi: np.ndarray
    quaternion: np.ndarray
    contact: np.ndarray
    com: np.ndarray
    omega: np.ndarray
    slip: np.ndarray
    force: np.ndarray
    regime: np.ndarray
    events: tuple = ()

    def __post_init__(self):
        for value in vars(self).values():
            if isinstance(value, np.ndarray):
                value.flags.writeable = False

    @cached_property
    def jellett(self):
        """C_J = I1 s w2 + I3 (c - a) w3, (14); the paper's K_J of (30) is C_J/I1."""
        top, (_, w2, w3) = self.top, self.omega.T
        return top.I1 * np.sin(self.theta) * w2 + top.I3 * (np.cos(self.theta) - top.a) * w3

    @cached_property
    def routh(self):
        """K_R = f3 w3, (31)."""
        return np.sqrt(f3_squared(self.theta, self.top)) * self.omega[:, 2]

    @cached_property
    def energy(self):
        """E of (6), with G's velocity v = omega x r + slip."""
        top, (w1, w2, w3) = self.top, self.omega.T
        s, c = np.sin(self.theta), np.cos(self.theta)
        vx = w2 * (c - top.a) - w3 * s + self.slip[:, 0]
        vy = -w1 * (c * (c - top.a) + s**2) + self.slip[:, 1]
        vz = top.a * s * w1
        kinetic = top.I1 * (w1**2 + w2**2) + top.I3 * w3**2 + vx**2 + vy**2 + vz**2
        return kinetic / 2 + 2 * top.a * np.sin(self.theta / 2) ** 2


def checked_times(times):
    """times as a new (n,) float array, or a TopError."""
    t = numbers("times", times)
    if t.ndim != 1 or not t.size:
        raise TopError("times", times, "a one-dimensional, not empty array of finite numbers, in (R/g)^1/2")
    return t
