"""Which way round the trace of the contact runs on the ball, and where it turns back: Pliskin, Am. J. Phys. 22, 28
(1954), Fig. 4."""

from typing import NamedTuple

import numpy as np

from tippe_core import Trajectory
from tippe_core.types import Array

FROM, TO = np.radians(45), np.radians(135)  # between these tilts it is near the equator
LEAST = 0.25  # rad: nutation moves the contact to and fro by less
ON, PARTS = 1e-4, 3  # R: so near to its surface the ball touches; parts of a piece of the trace


class Back(NamedTuple):
    """The trace turns back at a tilt (rad), after it has run round with the spin at the start, or against it."""

    theta: float
    runs_with: bool


def turns_back(moved: Trajectory) -> Back | None:
    """Where the trace turns back while the top first turns over on its ball; None if it does not."""
    first = int(np.argmax(moved.theta > np.pi / 2))
    stem = next((t for t, on in moved.supports if on in ("stem", "both")), np.inf)
    before = np.flatnonzero(moved.theta[:first] < FROM)
    after = np.flatnonzero((moved.theta[first:] > TO) | (moved.t[first:] >= stem))
    if not first or not len(before):
        return None
    rows = slice(before[-1] + 1, first + int(after[0]) if len(after) else None)
    round_axis = -np.sign(moved.omega[0, 2]) * moved.psi[rows]  # that the contact has gone, seen from the body
    theta = moved.theta[rows]
    for runs_with, angle in ((True, round_axis), (False, -round_axis)):
        top = int(np.argmax(angle)) if len(angle) else 0
        if len(angle) and angle[top] - max(angle[0], angle[-1]) > LEAST:
            return Back(float(theta[top]), runs_with)
    return None


def pieces(trace: Array) -> Array:
    """(k, PARTS + 1, 3): the trace (n, 3) from each instant at which the ball touches to the next, along great circles
    of the ball."""
    on = np.abs(np.linalg.norm(trace, axis=1) - 1) < ON
    ends = np.stack([trace[:-1], trace[1:]], axis=1)[on[:-1] & on[1:]]
    along = ends[:, :1] + np.diff(ends, axis=1) * np.linspace(0, 1, PARTS + 1)[:, None]
    return along / np.linalg.norm(along, axis=2, keepdims=True)
