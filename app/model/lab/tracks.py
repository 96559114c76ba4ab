"""The quantities of a run that are shown over time, in the units of the page: degrees, rev/s, cm/s, s; forces in M
g, energies in M g R."""

from itertools import pairwise
from typing import NamedTuple

import numpy as np

from app.model.motion import Motion
from tippe_core import Scales
from tippe_core.types import Array

QUANTITIES = ("theta", "omega3", "normal", "slip")
BUCKETS, POINTS = 500, 500  # of a curve, and of the energies


class Track(NamedTuple):
    """One quantity at the times t (n,), in s."""

    t: Array
    value: Array


def tracks(motion: Motion, scales: Scales) -> dict[str, Track]:
    """{of QUANTITIES: Track}"""
    moved = motion.trajectory
    values = {
        "theta": np.degrees(moved.theta),
        "omega3": moved.omega[:, 2] * scales.angular_velocity / (2 * np.pi),
        "normal": moved.force[:, 2],
        "slip": 100 * scales.velocity * motion.slip,
    }
    return {name: extremes(moved.t * scales.time, value) for name, value in values.items()}


def extremes(t: Array, values: Array) -> Track:
    """The least and the largest value in each of BUCKETS intervals, so that a fast oscillation keeps its width."""
    if len(t) <= 2 * BUCKETS:
        return Track(t, values)
    buckets = pairwise(np.linspace(0, len(t), BUCKETS + 1).astype(int))
    rows = np.ravel([sorted((a + values[a:b].argmin(), a + values[a:b].argmax())) for a, b in buckets])
    return Track(t[rows], values[rows])


def ledger(motion: Motion, scales: Scales) -> tuple[Array, dict[str, Array]]:
    """(t, {name: energy}) at POINTS times, like Motion.ledger."""
    every = np.unique(np.linspace(0, len(motion.trajectory.t) - 1, POINTS).astype(int))
    return motion.trajectory.t[every] * scales.time, {name: part[every] for name, part in motion.ledger.items()}
