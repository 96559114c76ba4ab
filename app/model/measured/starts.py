"""The points in parameter space from which the fit of a Model to Data starts."""

import itertools

import numpy as np
from scipy.stats import qmc

from app.model.measured.data import Data
from app.model.measured.motion import Model, tilt_by_tip
from tippe_core.types import Array

SCATTERED = 256  # starting points that are tried if those from the first values do not lead to a good fit
NEAR, MOST_NEAR = 0.1, 8  # relative distance from the best fit, and number, of the starting points around it
FIRST = 4.0  # standard errors about the first values within which the starting points lie
RANGES = {
    "tilt": (0.05, 1.3), "tilt_rate": (-1.0, 1.0), "across": (-3.0, 3.0), "spin": (-12.0, 12.0), "mu": (0.05, 0.8),
    "eps": (0.01, 1.0), "radius": (3e-3, 0.2), "gamma": (0.03, 1.5), "rolling_resistance": (1e-4, 0.02),
    "air_drag": (1e-4, 0.02),
}  # fmt: skip
"""{parameter: the range of its starting values}, evenly in the logarithm if it is positive."""
ONE_WAY = 1.0, 12.0  # of a spin whose sign the data cannot tell


def starts(model: Model, data: Data) -> list[Array]:
    """A grid: parameters that the first values give, and several values of the others."""
    first = {name: float(np.median(series.values[:5])) for name, series in data.series.items()}
    unit = model.scales.angular_velocity
    tilts = [first["tilt"]] if "tilt" in first else [0.1, 0.4, 0.9]
    if "tip" in first and "tilt" not in first:
        tilts = [float(tilt_by_tip(model, np.array(first["tip"])))]
    ways = (1, -1) if data.handed else (1,)
    spins = [first["spin"] / unit] if "spin" in first else [way * size for size in (3, 5, 8, 12) for way in ways]
    grid = {"tilt": tilts, "spin": spins, "mu": [0.1, 0.2, 0.3, 0.5], "eps": [0.03, 0.1, 0.4],
            "radius": [0.01, 0.03, 0.1], "gamma": [0.05, 0.15, 0.4, 1.0],
            "rolling_resistance": [1e-3], "air_drag": [1e-3]}  # fmt: skip
    if model.name == "rolling":
        turn = first.get("precession")
        if turn is None and "azimuth" in data.series:
            series = data.series["azimuth"]
            turn = float(np.polyfit(series.t, series.values, 1)[0])
        known = [] if turn is None else [turn / unit * np.sin(tilt) for tilt in tilts]
        grid |= {"across": [*known, -1.0, -0.3, 0.0, 0.3, 1.0, 3.0], "tilt_rate": [-0.4, 0.0, 0.4]}
    choices = [grid.get(name, [model.values[name]]) for name in model.free]
    return [np.array(x, dtype=float) for x in itertools.product(*choices)]


def scattered(model: Model, data: Data) -> list[Array]:
    """Points evenly distributed over the ranges that the first values allow."""
    unit = {"tilt": 1.0, "spin": model.scales.angular_velocity}
    points = qmc.Sobol(len(model.free), seed=0).random(SCATTERED)
    columns = []
    for share, name in zip(points.T, model.free, strict=True):
        if name in data.series and name in unit:
            series = data.series[name]
            value, error = float(np.median(series.values[:5])) / unit[name], series.error / unit[name]
            columns.append(value + FIRST * error * (2 * share - 1))
        elif name in RANGES:
            low, high = RANGES[name] if name != "spin" or data.handed else ONE_WAY
            columns.append(low * (high / low) ** share if low > 0 else low + (high - low) * share)
        else:
            columns.append(model.values[name] * (0.8 + 0.4 * share))
    return list(np.array(columns).T)


def around(x: Array, sizes: Array) -> list[Array]:
    """Points around x, at distances relative to each parameter or to its typical size, whichever is larger."""
    shares = 2 * qmc.Sobol(len(x), seed=1).random(MOST_NEAR) - 1
    return [x + NEAR * share * np.maximum(np.abs(x), sizes) for share in shares]
