"""A motion in frames: their times, and the rotating axes in space."""

import numpy as np

from tippe_core import Constants, Top, Trajectory
from tippe_core.types import Array

NUTATIONS = 20
FRAMES_A_NUTATION = 64
MOST_FRAMES = 2400
# Between two frames the picture rotates about one axis, so the top must not turn far from one to the next.
MOST_TURN = 0.3
STILL = 1e-6  # an angular velocity too small to be seen in any frame


def frame_times(period: float, top: Top, constants: Constants) -> Array:
    """The times (n,) of some nutations in equal frames, so short that the top turns little between two."""
    # (33) bounds the spin: no component is larger than this.
    fastest = float(np.sqrt((2 * abs(float(constants.E)) + 4 * abs(top.a)) / min(top.I1, top.I3)))
    step = min(period / FRAMES_A_NUTATION, MOST_TURN / max(fastest, STILL))
    frames = min(round(NUTATIONS * period / step), MOST_FRAMES)
    return step * np.arange(frames + 1.0)


def axes(theta: Array, phi: Array) -> tuple[Array, Array, Array, Array]:
    """The axes 1', y, 3 and 2' in space, each (n, 3)."""
    zero, s, c = np.zeros_like(theta), np.sin(theta)[:, None], np.cos(theta)[:, None]
    nodal = np.column_stack([np.cos(phi), np.sin(phi), zero])
    across = np.column_stack([-np.sin(phi), np.cos(phi), zero])
    up = np.array([0.0, 0.0, 1.0])
    return nodal, across, c * up - s * across, s * up + c * across


def in_space(motion: Trajectory) -> tuple[Array, Array, Array]:
    """The force of the table, the angular velocity and the angular momentum about G along x, y, z; (n, 3) each."""
    top = motion.top
    nodal, across, axis, towards = axes(motion.theta, motion.phi)
    w1, w2, w3 = (component[:, None] for component in motion.omega.T)
    F_x, F_y, F_z = (component[:, None] for component in motion.force.T)
    across_axis = w1 * nodal + w2 * towards
    force = F_x * nodal + F_y * across + F_z * (0, 0, 1)
    return force, across_axis + w3 * axis, top.I1 * across_axis + top.I3 * w3 * axis
