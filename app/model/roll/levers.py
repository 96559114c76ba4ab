"""The paper's Fig. 4: the section through the contact point C and the axis 3, with the lever arms of the force F_x."""

from dataclasses import dataclass

import numpy as np

from app.model.frames import axes
from tippe_core import Trajectory
from tippe_core.types import Array


@dataclass(frozen=True, eq=False, kw_only=True)
class Levers:
    """Points and directions seen along F_x, one row (across, up) for each frame, in R, from C: the axis 3; G, whose
    horizontal distance is the lever arm of the torque about z; and the foot of the perpendicular from C to the axis,
    whose distance is the lever arm about 3. push (n,): F_x, in Mg."""

    axis: Array
    G: Array
    foot: Array
    push: Array


def levers(motion: Trajectory) -> Levers:
    """The Levers of a motion, from its poses."""
    _, across, axis, _ = axes(motion.theta, motion.phi)
    up = np.array([0.0, 0.0, 1.0])
    contact = np.column_stack([motion.contact, np.zeros(len(motion.t))])
    foot = up - axis[:, 2:] * axis  # O is above C; from O down along the axis to the point nearest C

    def seen(vectors: Array) -> Array:
        return np.column_stack([(vectors * across).sum(axis=1), vectors[:, 2]])

    return Levers(axis=seen(axis), G=seen(motion.com - contact), foot=seen(foot), push=motion.force[:, 0])
