"""A motion in frames: at which times, and the turning axes in space."""

import numpy as np

from tippe_core import (
    Constants,
    Top,
)
from tippe_core.types import Array

NUTATIONS = 20
FRAMES_A_NUTATION = 64
MOST_FRAMES = 2400
# The picture between two frames is a turn about one axis, so a frame must not turn the top far.
MOST_TURN = 0.3


def frame_times(period: float, top: Top, constants: Constants) -> Array:
    """Some nutations in frames of equal length, short enough that the top turns little between two; (n,)."""
    # (33) bounds the spin: no component is larger than this.
    fastest = float(np.sqrt((2 * abs(float(constants.E)) + 4 * abs(top.a)) / min(top.I1, top.I3)))
    step = min(period / FRAMES_A_NUTATION, MOST_TURN / fastest)
    frames = min(round(NUTATIONS * period / step), MOST_FRAMES)
    return step * np.arange(frames + 1.0)


def axes(theta: Array, phi: Array) -> tuple[Array, Array, Array, Array]:
    """The axes 1', y, 3 and 2' in space, each (n, 3)."""
    zero, s, c = np.zeros_like(theta), np.sin(theta)[:, None], np.cos(theta)[:, None]
    nodal = np.column_stack([np.cos(phi), np.sin(phi), zero])
    across = np.column_stack([-np.sin(phi), np.cos(phi), zero])
    up = np.array([0.0, 0.0, 1.0])
    return nodal, across, c * up - s * across, s * up + c * across
