"""The constants of the motion computed directly from the data, without a fit: were they conserved?"""

import itertools
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.stats import chi2 as chi_square

from app.model.measured.data import Data
from tippe_core import Scales, Top
from tippe_core.paper import equations as eq
from tippe_core.types import Array

SHARE = 0.2  # of the values: the first and the last are compared
WINDOWS, LEAST = 20, 6  # the number of windows over which an azimuth gives K_J; the least number of frames in one
FEWEST = 4  # windows
MOST_TURNED = 1.0  # rad between two frames: above this, a whole turn of the azimuth may have been missed
STAYED = 1e-3


@dataclass(frozen=True, eq=False)
class Kept:
    """A constant of the motion at t (s): values and errors, in the units of the paper."""

    t: Array
    values: Array
    errors: Array

    def _mean(self, part: slice) -> tuple[float, float]:
        weights = 1 / self.errors[part] ** 2
        return float(weights @ self.values[part] / weights.sum()), float(weights.sum() ** -0.5)

    @property
    def mean(self) -> tuple[float, float]:
        """The mean of all values, and its standard error."""
        return self._mean(slice(None))

    @property
    def before(self) -> tuple[float, float]:
        """The mean of the first fifth of the values, and its standard error."""
        return self._mean(slice(0, max(int(SHARE * len(self.t)), 1)))

    @property
    def after(self) -> tuple[float, float]:
        """The mean of the last fifth of the values, and its standard error."""
        return self._mean(slice(-max(int(SHARE * len(self.t)), 1), None))

    @property
    def stayed(self) -> bool:
        """Whether all values agree with a constant."""
        mean, _ = self.mean
        left = (self.values - mean) / self.errors
        (first, one), (last, other) = self.before, self.after
        moved = abs(last - first) > 3.3 * np.hypot(one, other)
        return bool(chi_square.sf(left @ left, len(left) - 1) > STAYED and not moved)


def kept(data: Data, top: Top, scales: Scales) -> dict[str, Kept]:
    """{"K_R": Kept} if tilt and spin were measured, and "K_J" if the precession rate or the azimuth was too. The errors
    follow from those of the data."""
    series = dict(data.series)
    if not {"tilt", "spin"} <= set(series):
        return {}
    turn = next((name for name in ("precession", "azimuth") if name in series), None)
    names = ["tilt", "spin", *([turn] if turn else [])]
    t = series["azimuth" if turn == "azimuth" else "tilt"].t
    inside = (t >= max(series[name].t[0] for name in names)) & (t <= min(series[name].t[-1] for name in names))
    t = t[inside]
    if len(t) < 8:
        return {}
    sizes = {"tilt": 1.0, "azimuth": 1.0}
    unit = scales.angular_velocity
    rows = [np.interp(t, series[name].t, series[name].values) / sizes.get(name, unit) for name in names]
    errors = [series[name].error / sizes.get(name, unit) for name in names]

    def K_R(theta: Array, spin: Array) -> Array:
        return eq.K_R(np.cos(theta), np.sin(theta) ** 2, spin, top)

    def K_J(theta: Array, spin: Array, turn: Array) -> Array:
        s = np.sin(theta)
        return eq.K_J(np.cos(theta), s, turn * s, spin, top)

    found = {"K_R": Kept(t, K_R(*rows[:2]), _spread(K_R, rows[:2], errors))}
    if turn == "precession":
        found["K_J"] = Kept(t, K_J(*rows), _spread(K_J, rows, errors))
    elif turn == "azimuth" and len(t) >= 4 * LEAST:
        by_azimuth = _by_azimuth(t, rows, errors, top, unit)
        found |= {"K_J": by_azimuth} if len(by_azimuth.t) >= FEWEST else {}
    return found


def _by_azimuth(t: Array, rows: list[Array], errors: list[float], top: Top, unit: float) -> Kept:
    """K_J as means over windows of time; that of s w2 = s^2 phi_dot is the integral of s^2 dphi divided by the time.

    The differences of an azimuth do not give the precession rate, because a nutation may be as short as two frames, but
    its integral over many frames is accurate. What s^2 and phi_dot do together between two frames counts as an error.
    """
    theta, spin, phi = rows
    count = min(WINDOWS, (len(t) - 1) // LEAST)
    ends = np.linspace(0, len(t) - 1, count + 1).astype(int)
    middles, means, spreads = [], [], []
    for low, high in itertools.pairwise(ends):
        part = slice(low, high + 1)
        if np.abs(np.diff(phi[part])).max() > MOST_TURNED:
            continue
        value, error = _window(t[part] * unit, theta[part], spin[part], phi[part], errors, top)
        middles.append(t[part].mean())
        means.append(value)
        spreads.append(error)
    return Kept(np.array(middles), np.array(means), np.array(spreads))


def _window(t: Array, theta: Array, spin: Array, phi: Array, errors: list[float], top: Top) -> tuple[float, float]:
    """(K_J, its error) of one window; t in (R/g)^1/2."""
    s, c, ratio = np.sin(theta), np.cos(theta), top.I3 / top.I1
    s2, turned, long = s**2, np.diff(phi), t[-1] - t[0]
    weights = np.zeros_like(t)  # of a time average
    weights[1:] += np.diff(t) / (2 * long)
    weights[:-1] += np.diff(t) / (2 * long)
    middle = (s2[1:] + s2[:-1]) / 2
    value = float(middle @ turned / long + weights @ eq.K_J(c, 0.0, 0.0, spin, top))
    around = np.concatenate([[turned[0]], turned[1:] + turned[:-1], [turned[-1]]])
    of_tilt = s * c * around / long - weights * ratio * s * spin
    of_spin = weights * ratio * (c - top.a)
    of_azimuth = -np.diff(middle, prepend=0.0, append=0.0) / long
    noise = sum(error**2 * float(slopes @ slopes)
                for error, slopes in zip(errors, (of_tilt, of_spin, of_azimuth), strict=True))  # fmt: skip
    # p: the amplitude of s^2, from its variance beyond noise and drift; that of phi_dot, q p, follows from K_J.
    left = s2 - np.polyval(np.polyfit(t, s2, 1), t)
    p2 = 2 * max(float(np.mean(left**2)) - errors[0] ** 2 * float(np.mean((2 * s * c) ** 2)), 0.0)
    mean = float(s2.mean())
    q = (ratio * float(spin.mean()) / (2 * float(c.mean()) or 1e-3) - float(turned.sum()) / long) / max(mean, 1e-3)
    return value, float(np.sqrt(noise + (p2 * q / 2) ** 2))


def _spread(function: Callable[..., Array], rows: list[Array], errors: list[float]) -> Array:
    """The standard errors of function(*rows), by propagation of errors."""
    total = np.zeros(len(rows[0]))
    for i, error in enumerate(errors):
        high, low = (function(*(row + way * error * (i == j) for j, row in enumerate(rows))) for way in (0.5, -0.5))
        total = total + (high - low) ** 2
    return np.sqrt(total)
