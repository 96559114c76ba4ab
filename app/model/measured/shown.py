"""A motion beside the data, on the film's own clock: its curves, its poses, and the measured direction of the axis."""

from dataclasses import dataclass

import numpy as np

from app.model.frames import MOST_FRAMES, MOST_TURN, axes
from app.model.measured.cells import MeasuredError
from app.model.measured.data import TOGETHER, Data
from app.model.measured.fit import Problem
from app.model.measured.motion import SIDEWAYS, Model, Residuals, residuals_of, tilt_by_tip
from app.model.measured.starts import starts
from tippe_core import TopError, Trajectory
from tippe_core.types import Array

POINTS = 900  # of each curve
LOOK = 3.0  # s of the film, from its beginning, by which a guess is chosen


@dataclass(frozen=True, eq=False)
class Shown:
    """residuals: those of the data from the model's start on. t (n,): time of the film, s; motion: the model's at these
    times. curves: {quantity: (t, values)} in s, rad, rad/s and m. axis: rows (t, x, y, z) of its measured directions;
    azimuths: whether the azimuth was measured too; otherwise it is the motion's own."""

    model: Model
    data: Data
    residuals: Residuals
    t: Array
    motion: Trajectory
    curves: dict[str, tuple[Array, Array]]
    axis: Array
    azimuths: bool

    @property
    def tilt(self) -> Array:
        """The motion's tilt at t, rad."""
        return self.motion.theta


def shown(model: Model, data: Data) -> Shown:
    """The model beside the data, which begin where it starts. Raises TopError if there is no such motion."""
    residuals, times = residuals_of(model, data), data.t
    first, last, unit = times[0], times[-1], model.scales.time
    fastest = abs(model.values["spin"]) + abs(model.values["across"]) + 1.0
    count = int(np.clip((last - first) / unit * fastest / MOST_TURN, len(times), MOST_FRAMES))
    t = np.linspace(first, last, count + 1)
    motion = model.moved(t)
    t = t[: len(motion.t)]
    axis, azimuths = _axis(model, data, residuals, t, motion)
    return Shown(model, data, residuals, t, motion, _curves(model, data, residuals), axis, azimuths)


def _curves(model: Model, data: Data, residuals: Residuals) -> dict[str, tuple[Array, Array]]:
    times = data.t
    fine = np.union1d(times, np.linspace(times[0], times[-1], POINTS))
    seen, tracks = model.seen(fine), {"line", *SIDEWAYS, *(name for pair in TOGETHER for name in pair)}
    curves = {}
    for name, series in data.series.items():
        if name in tracks:
            curves[name] = series.t, residuals.values[name]
            continue
        moved = residuals.values[name][0] - seen[name][np.searchsorted(fine, series.t[0])] if name == "azimuth" else 0.0
        curves[name] = fine, seen[name] + moved
    return curves


def _axis(model: Model, data: Data, residuals: Residuals, t: Array, motion: Trajectory) -> tuple[Array, bool]:
    series = data.series
    if "tilt" in series:
        times, theta = series["tilt"].t, series["tilt"].values
    elif "tip" in series:
        times, theta = series["tip"].t, tilt_by_tip(model, series["tip"].values)
    else:
        return np.zeros((0, 4)), False
    phi, seen = np.interp(times, t, motion.phi), "azimuth" in series
    if seen:
        turn = series["azimuth"]
        moved = np.interp(turn.t, t, motion.phi) - residuals.values["azimuth"]
        phi = np.interp(times, turn.t, turn.values + float(np.mean(moved)))
    return np.column_stack([times, axes(theta, phi)[2]]), seen


def guess(model: Model, data: Data) -> Shown:
    """A first guess before anything is fitted: of a few motions that begin with the first values, the one that fits
    best at first. Raises TopError if none of them is a motion."""
    first = data.t[0]
    try:
        problem = Problem(model, data.between(first, first + LOOK))
    except MeasuredError:  # too few values
        problem = Problem(model, data)
    (x,) = problem.best_of(starts(model, data), 1)
    return shown(model.with_values(dict(zip(model.free, map(float, x), strict=True))), data)


def placed(model: Model, data: Data) -> Shown | None:
    """guess(), or None if there is none."""
    try:
        return guess(model, data)
    except TopError:
        return None
