"""Measured data in s, rad and m: the columns of a Table with the quantities and units that the visitor confirmed."""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cache
from types import MappingProxyType

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from app.model.measured.cells import MeasuredError
from app.model.measured.names import UNITS
from app.model.measured.table import Column, Table
from tippe_core.types import Array

TRACKS = (("x", "y"), ("tip_x", "tip_y"))
TOGETHER = (*TRACKS, ("axis_x", "axis_y"), ("axis_side", "axis_up"))
HANDED = {"spin", "precession", "azimuth", "x", "tip_x", "axis_x"}
"""Quantities that tell a motion from its mirror image. A film from the side does not: it may be from either side."""
CAN_BE = {
    "tilt": (-0.5, np.pi + 0.5),
    "spin": (-4000.0, 4000.0),
    "precession": (-4000.0, 4000.0),
    "azimuth": (-1e5, 1e5),
    "line": (-4.0, 4.0),
}
FAR = -5.0, 5.0  # m
PIECE, LAG = 48, 16  # values from which the noise is found, and those that are looked at together
SINCE_1970 = ("us", "ns")  # units of times that a phone counts from then: here from the first
"""{quantity: what a film of a top can show of it}, in rad and rad/s; FAR for all lengths. Beyond, the unit is wrong."""


def are_handed(quantities: Iterable[str]) -> bool:
    """Whether quantities that were measured tell a motion from its mirror image."""
    return not HANDED.isdisjoint(quantities)


@dataclass(frozen=True, eq=False)
class Series:
    """One measured quantity: values at the times t (s), in rad, rad/s or m; error is the standard error of each
    value."""

    t: Array
    values: Array
    error: float


@dataclass(frozen=True, eq=False)
class Data:
    """The Series by quantity (the keys of UNITS except "time")."""

    series: MappingProxyType[str, Series]

    @property
    def t(self) -> Array:
        """All times, each once, in ascending order."""
        return np.unique(np.concatenate([series.t for series in self.series.values()]))

    @property
    def handed(self) -> bool:
        """Whether these data tell a motion from its mirror image."""
        return are_handed(self.series)

    def without(self, far: Iterable[tuple[str, float]]) -> "Data":
        """The Data without these values: (quantity, time in s), and what belongs to them in a pair."""
        times: dict[str, set[float]] = {}
        for name, t in far:
            for each in next((pair for pair in TOGETHER if name in pair), (name,)):
                times.setdefault(each, set()).add(t)
        kept = {}
        for name, series in self.series.items():
            there = ~np.isin(series.t, [*times.get(name, ())])
            kept[name] = Series(series.t[there], series.values[there], series.error)
        return Data(MappingProxyType(kept))

    def between(self, start: float, end: float) -> "Data":
        """The Data from start to end (s). Raises MeasuredError if they are fewer than eight values."""
        parts = {}
        for name, series in self.series.items():
            inside = (series.t >= start) & (series.t <= end)
            parts[name] = Series(series.t[inside], series.values[inside], series.error)
        if sum(len(series.t) for series in parts.values()) < 8:
            raise MeasuredError("part", start=start, end=end)
        return Data(MappingProxyType({name: part for name, part in parts.items() if len(part.t)}))


def settled(table: Table, rate: float = 0.0) -> Data:
    """The Data of a Table. rate: frames per second, if the time is counted in frames."""
    used = [column for column in table.columns if column.quantity]
    for quantity in UNITS:
        alike = [column.name for column in used if column.quantity == quantity]
        if len(alike) > 1:
            raise MeasuredError("twice", first=alike[0], second=alike[1])
    time = next((column for column in used if column.quantity == "time"), None)
    if time is None:
        if any(code == "no-header" for code, _ in table.notes):
            raise MeasuredError("no-names", line=table.lines[0])
        if not used:
            raise MeasuredError("no-columns")
        raise MeasuredError("no-time-column", line=max(table.lines[0] - 1, 1))
    if time.unit == "frames" and not rate > 0:
        raise MeasuredError("rate", rate=rate)
    known = np.isfinite(time.values)
    t = time.si[known] / (rate if time.unit == "frames" else 1.0)
    t = t - t[0] if len(t) and time.unit in SINCE_1970 else t
    lines = np.array(table.lines)[known]
    falls = np.flatnonzero(np.diff(t) < 0)
    if falls.size:
        before, after = time.values[known][falls[0] : falls[0] + 2]
        raise MeasuredError("falling", line=int(lines[falls[0] + 1]), before=float(before), after=float(after))
    if t[0] == t[-1]:
        raise MeasuredError("no-time-passes", time=float(time.values[known][0]), line=int(lines[0]))
    series = {column.quantity: _series(column, t, known, lines) for column in used if column is not time}
    for one, other in TOGETHER:
        if (one in series) != (other in series):
            here, missing = (one, other) if one in series else (other, one)
            raise MeasuredError("half-a-track", here=here, missing=missing)
    if not series:
        raise MeasuredError("nothing", line=max(table.lines[0] - 1, 1))
    for one, other in TOGETHER:
        if one in series:  # one point, in one picture
            error = float(np.hypot(series[one].error, series[other].error) / np.sqrt(2))
            series |= {name: replace(series[name], error=error) for name in (one, other)}
    return Data(MappingProxyType(series))


def _series(column: Column, t: Array, known: Array, lines: Array) -> Series:
    size = UNITS[column.quantity][column.unit]
    values = column.si[known]
    good = np.isfinite(values)
    if good.sum() < 4:
        raise MeasuredError("few-values", name=column.name, count=int(good.sum()))
    values, t = values[good], t[good]
    low, high = CAN_BE.get(column.quantity, FAR)
    beyond = np.flatnonzero((values < low) | (values > high))
    if beyond.size:
        raise MeasuredError("beyond", line=int(lines[good][beyond[0]]), name=column.name, unit=column.unit,
                            value=float(values[beyond[0]] / size), low=low / size, high=high / size)  # fmt: skip
    if column.quantity == "azimuth":
        values = np.unwrap(values)
    least = 1e-4 * float(np.ptp(values)) or 1e-6  # for values that were rounded to fewer digits, or computed
    error = column.error * size if column.error and column.error > 0 else max(roughness(values), least)
    return Series(t, values, error)


def roughness(values: Array) -> float:
    """The standard error of one value, from the scatter about a curve: the smaller one of two estimates.

    Of a smooth curve the third differences are noise alone: their variance is 20 times that of a value. A nutation that
    takes only a few frames is no noise either, but its pieces of LAG values lie in a few dimensions; the other half of
    the eigenvalues of their covariance is that of the noise (singular spectrum analysis)."""
    jumps = np.abs(np.diff(values, 3))
    smooth = float(np.median(jumps) / (0.6745 * np.sqrt(20))) if jumps.size else 0.0
    size = min(len(values), PIECE)
    if size < 2 * LAG:
        return smooth
    begins = np.linspace(0, len(values) - size, len(values) // size).astype(int)
    quiet = np.median([_quiet(values[at : at + size]) for at in begins]) / _of_noise(size)
    return min(smooth, float(np.sqrt(max(quiet, 0.0))))


def _quiet(piece: Array) -> float:
    """The mean of the smaller half of the eigenvalues of the covariance of LAG values that follow one another."""
    rows = sliding_window_view(piece - piece.mean(), LAG)
    return float(np.linalg.eigvalsh(rows.T @ rows / len(rows))[: LAG // 2].mean())


@cache
def _of_noise(size: int) -> float:
    """The same of noise of variance 1: its mean over 300 pieces."""
    rng = np.random.default_rng(0)
    return float(np.mean([_quiet(rng.normal(size=size)) for _ in range(300)]))
