"""The body that is drawn, and which part of it touches; lengths in R."""

from functools import lru_cache

import numpy as np

from tippe_core import SUNK, Change, Shape, Top, thresholds
from tippe_core.types import Array

# Half of the third digit: the paper rounds appendix A's top to three, and with those it is the same body still.
ROUNDED = 5e-4
OUTLINE_POINTS = 96


def fits(shape: Shape, top: Top) -> bool:
    """Whether a, I1 and I3 are those of the shape, to the three digits of appendix A."""
    own = shape.top
    return max(abs(own.a - top.a), abs(own.I1 - top.I1), abs(own.I3 - top.I3)) < ROUNDED


def upright(top: Top) -> Change:
    """At which spins it is stable upright."""
    return thresholds(top).upright


@lru_cache(maxsize=8)
def body(shape: Shape) -> Array:
    """The outline of the shape: (k, 2), radius and height above O along axis 3, in R."""
    return shape.profile(max(OUTLINE_POINTS, len(shape.solid.outline) + 1)) / shape.R


def second_part(shape: Shape | None) -> str:
    """The part of a body that touches besides the ball: "stem" if it is the end of a stem or there is none, else
    "rim"."""
    if shape is None or shape.edge is None:
        return "stem"
    radius, height, rounding = shape.edge
    ends = height + rounding > body(shape)[:, 1].max() - SUNK
    return "stem" if ends and radius + rounding < 1 else "rim"


def outline(top: Top) -> Array:
    """A stand-in, like body(shape), for a top of which only a, I1 and I3 are known.

    Only the sphere that rolls is certain, so a tippe top is drawn as a whole ball, and a top with G above O as a disc
    on a round peg.
    """
    angle = np.linspace(0, np.pi, 60)
    ball = np.column_stack([np.sin(angle), -np.cos(angle)])
    if top.a >= -0.3:
        return ball
    disc = -top.a + np.array([-0.15, -0.15, 0.15, 0.15])
    wide = max(1.2, 1.5 * top.I3**0.5)
    return np.vstack([ball[:50], [[0.2, disc[0]], [wide, disc[1]], [wide, disc[2]], [0.15, disc[3]],
                                  [0.15, disc[3] + 0.6], [0, disc[3] + 0.6]]])  # fmt: skip
