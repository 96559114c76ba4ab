"""A motion beside what was measured, on the film's own clock: its curves, its poses, and where the axis was seen."""

from dataclasses import dataclass

import numpy as np

from app.model.frames import MOST_FRAMES, MOST_TURN, axes
from app.model.measured.data import TOGETHER, Data
from app.model.measured.fit import Problem
from app.model.measured.motion import Left, Model, left_over
from app.model.measured.starts import starts
from app.model.measured.table import MeasuredError
from tippe_core import TopError, Trajectory
from tippe_core.types import Array

POINTS = 900  # of a curve
LOOK = 3.0  # s: by so much of a film a guess is chosen


@dataclass(frozen=True, eq=False)
class Shown:
    """left: what the model leaves over of the data from its start on. t (n,): s of the film; motion: the model's at
    these. curves: {quantity: (t, values)} in s, rad, rad/s and m. axis: rows (t, x, y, z), where the axis was
    measured; its azimuth is the motion's own unless azimuths: then that was measured too."""

    model: Model
    data: Data
    left: Left
    t: Array
    motion: Trajectory
    curves: dict[str, tuple[Array, Array]]
    axis: Array
    azimuths: bool

    @property
    def tilt(self) -> Array:
        """Of the motion at t."""
        return self.motion.theta


def shown(model: Model, data: Data) -> Shown:
    """The model beside the data that begin where it starts. Raises TopError where there is no such motion."""
    left, times = left_over(model, data), data.t
    first, last, unit = times[0], times[-1], model.scales.time
    fastest = abs(model.values["spin"]) + abs(model.values["across"]) + 1.0
    count = int(np.clip((last - first) / unit * fastest / MOST_TURN, len(times), MOST_FRAMES))
    t = np.linspace(first, last, count + 1)
    motion = model.moved(t)
    t = t[: len(motion.t)]
    axis, azimuths = _axis(model, data, left, t, motion)
    return Shown(model, data, left, t, motion, _curves(model, data, left), axis, azimuths)


def _curves(model: Model, data: Data, left: Left) -> dict[str, tuple[Array, Array]]:
    times = data.t
    fine = np.union1d(times, np.linspace(times[0], times[-1], POINTS))
    seen, tracks = model.seen(fine), {name for pair in TOGETHER for name in pair}
    curves = {}
    for name, series in data.series.items():
        if name in tracks:
            curves[name] = series.t, left.values[name]
            continue
        moved = left.values[name][0] - seen[name][np.searchsorted(fine, series.t[0])] if name == "azimuth" else 0.0
        curves[name] = fine, seen[name] + moved
    return curves


def _axis(model: Model, data: Data, left: Left, t: Array, motion: Trajectory) -> tuple[Array, bool]:
    series = data.series
    if "tilt" in series:
        times, theta = series["tilt"].t, series["tilt"].values
    elif "tip" in series:  # while it stands on its ball, the tip is R + tip cos theta above the table
        times = series["tip"].t
        theta = np.arccos(np.clip((series["tip"].values / model.scales.R - 1) / model.tip, -1, 1))
    else:
        return np.zeros((0, 4)), False
    phi, seen = np.interp(times, t, motion.phi), "azimuth" in series
    if seen:
        turn = series["azimuth"]
        moved = np.interp(turn.t, t, motion.phi) - left.values["azimuth"]
        phi = np.interp(times, turn.t, turn.values + float(np.mean(moved)))
    return np.column_stack([times, axes(theta, phi)[2]]), seen


def guess(model: Model, data: Data) -> Shown:
    """Before anything is fitted: the one of a few motions that begin with the first values which is best at first.
    Raises TopError where none is a motion."""
    first = data.t[0]
    try:
        problem = Problem(model, data.between(first, first + LOOK))
    except MeasuredError:  # there are few values
        problem = Problem(model, data)
    (x,) = problem.best_of(starts(model, data), 1)
    return shown(model.with_values(dict(zip(model.free, map(float, x), strict=True))), data)


def placed(model: Model, data: Data) -> Shown | None:
    """guess(), None where there is none."""
    try:
        return guess(model, data)
    except TopError:
        return None
