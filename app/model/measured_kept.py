"""The constants of the motion from the data themselves, without any motion fitted: did they stay?"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.stats import chi2 as chi_square

from app.model.measured_data import Data
from tippe_core import Scales, Top
from tippe_core.paper import equations as eq
from tippe_core.types import Array

SHARE = 0.2  # of the values: the first and the last are compared
STAYED = 1e-3


@dataclass(frozen=True, eq=False)
class Kept:
    """A constant of the motion at t (s): values with errors, in the units of the paper; before and after: the means of
    the first and the last fifth, (value, standard error)."""

    t: Array
    values: Array
    errors: Array

    def _mean(self, part: slice) -> tuple[float, float]:
        weights = 1 / self.errors[part] ** 2
        return float(weights @ self.values[part] / weights.sum()), float(weights.sum() ** -0.5)

    @property
    def before(self) -> tuple[float, float]:
        """The mean of the first fifth."""
        return self._mean(slice(0, max(int(SHARE * len(self.t)), 1)))

    @property
    def after(self) -> tuple[float, float]:
        """The mean of the last fifth."""
        return self._mean(slice(-max(int(SHARE * len(self.t)), 1), None))

    @property
    def stayed(self) -> bool:
        """Whether all values agree with one number."""
        mean, _ = self._mean(slice(None))
        left = (self.values - mean) / self.errors
        (first, one), (last, other) = self.before, self.after
        moved = abs(last - first) > 3.3 * np.hypot(one, other)
        return bool(chi_square.sf(left @ left, len(left) - 1) > STAYED and not moved)


def kept(data: Data, top: Top, scales: Scales) -> dict[str, Kept]:
    """{"K_R": Kept} where tilt and spin were measured, and "K_J" where the precession was too; errors by those of the
    data. (Differences of the azimuth are no precession rate: a nutation may be as short as two frames of a film.)"""
    series = dict(data.series)
    if not {"tilt", "spin"} <= set(series):
        return {}
    names = ["tilt", "spin", *(["precession"] if "precession" in series else [])]
    t = series["tilt"].t
    inside = (t >= max(series[name].t[0] for name in names)) & (t <= min(series[name].t[-1] for name in names))
    t = t[inside]
    if len(t) < 8:
        return {}
    unit = scales.angular_velocity
    rows = [np.interp(t, series[name].t, series[name].values) / (1 if name == "tilt" else unit) for name in names]
    errors = [series[name].error / (1 if name == "tilt" else unit) for name in names]

    def K_R(theta: Array, spin: Array, *rest: Array) -> Array:
        return eq.K_R(np.cos(theta), np.sin(theta) ** 2, spin, top)

    def K_J(theta: Array, spin: Array, turn: Array) -> Array:
        s = np.sin(theta)
        return eq.K_J(np.cos(theta), s, turn * s, spin, top)

    found = {"K_R": Kept(t, K_R(*rows), _spread(K_R, rows, errors))}
    if len(rows) > 2:
        found["K_J"] = Kept(t, K_J(*rows), _spread(K_J, rows, errors))
    return found


def _spread(function: Callable[..., Array], rows: list[Array], errors: list[float]) -> Array:
    """The standard errors of function(*rows), by its slopes."""
    total = np.zeros(len(rows[0]))
    for i, error in enumerate(errors):
        high, low = (function(*(row + way * error * (i == j) for j, row in enumerate(rows))) for way in (0.5, -0.5))
        total = total + (high - low) ** 2
    return np.sqrt(total)
