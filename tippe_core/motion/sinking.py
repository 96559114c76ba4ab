"""Parts of a body other than its ball and the edge of its stem, which a motion does not know, below the table."""

import numpy as np

from ..types import Array
from .trajectory import Trajectory

# SUNK (R): so far below the table a point of the body counts as in it; rounding and a coarse rtol sink less.
SUNK = 1e-3
ANGLES = 1024  # for which lowest() looks at a profile at once
ANOTHER_TOUCHES = "another part touches"


def lowest(profile: Array, theta: Array) -> Array:
    """Height (n,) above O, in R, of the lowest point of the body at the tilts theta (n,), rad.

    profile: (k, 2), radius and height above O in R, as from Shape.profile.
    """
    radius, z = profile.T[:, :, None]
    parts = np.array_split(theta, len(theta) // ANGLES + 1)  # so that a long motion needs no more memory
    return np.concatenate([(z * np.cos(part) - radius * np.sin(part)).min(axis=0) for part in parts])


def sunk(trajectory: Trajectory, profile: Array) -> int:
    """The first row at which some part of the body is below the table; the number of rows if there is none.

    The contacts of slide() are the sphere and one edge, so another corner of the body may sink into the table, unless
    slide() has the profile. profile as in lowest().
    """
    height = trajectory.com[:, 2] + trajectory.top.a * np.cos(trajectory.theta) + lowest(profile, trajectory.theta)
    return int(np.argmax(np.append(height < -SUNK, True)))
