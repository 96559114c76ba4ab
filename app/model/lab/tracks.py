"""The quantities of a run that are shown over time, in the units of the page: degrees, rev/s, cm/s, s; forces in M
g, energies in M g R, Jellett's and Routh's constants as the paper has them."""

from itertools import pairwise
from typing import NamedTuple

import numpy as np

from app.model.run import TableMotion
from tippe_core import Scales, Trajectory
from tippe_core.types import Array

QUANTITIES = ("theta", "omega3", "normal", "ratio", "slip", "E", "K_J", "K_R")
BUCKETS, POINTS = 500, 500  # of a curve, and of the energies
TOUCHES = 1e-6  # of M g: with a smaller normal force nothing carries the top


class Track(NamedTuple):
    """One quantity at the times t (n,), in s; nan where there is none."""

    t: Array
    value: Array


def tracks(moved: Trajectory, scales: Scales) -> dict[str, Track]:
    """{of QUANTITIES: Track}; the ratio is F_h/F_z."""
    force = moved.force
    carried = force[:, 2] > TOUCHES
    values = {
        "theta": np.degrees(moved.theta),
        "omega3": moved.omega[:, 2] * scales.angular_velocity / (2 * np.pi),
        "normal": force[:, 2],
        "ratio": np.where(carried, np.hypot(force[:, 0], force[:, 1]) / np.where(carried, force[:, 2], 1.0), np.nan),
        "slip": 100 * scales.velocity * np.hypot(*moved.slip.T),
        "E": moved.energy,
        "K_J": moved.jellett / moved.top.I1,
        "K_R": moved.routh,
    }
    return {name: extremes(moved.t * scales.time, value) for name, value in values.items()}


def extremes(t: Array, values: Array) -> Track:
    """The least and the largest value in each of BUCKETS intervals, so that a fast oscillation keeps its width."""
    if len(t) <= 2 * BUCKETS:
        return Track(t, values)
    buckets, known = pairwise(np.linspace(0, len(t), BUCKETS + 1).astype(int)), np.nan_to_num(values)
    rows = np.ravel([sorted((a + known[a:b].argmin(), a + known[a:b].argmax())) for a, b in buckets])
    return Track(t[rows], values[rows])


def ledger(motion: TableMotion, scales: Scales) -> tuple[Array, dict[str, Array]]:
    """(t, {name: energy}) at POINTS times, like TableMotion.ledger."""
    every = np.unique(np.linspace(0, len(motion.trajectory.t) - 1, POINTS).astype(int))
    return motion.trajectory.t[every] * scales.time, {name: part[every] for name, part in motion.ledger.items()}
