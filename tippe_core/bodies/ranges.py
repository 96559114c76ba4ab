"""The allowed ranges of dimensions, and the errors outside them."""

from math import inf, isfinite

import numpy as np

from ..errors import TopError, finite
from .slices import LARGEST

SMALLEST = 1e-6  # m: smaller than any peg, and no power of it underflows
LONG = LARGEST / 4  # m: sums of heights stay below LARGEST
LIGHTEST, THINNEST = 1e-30, 1e-9  # kg, kg/m^3: no product of them underflows
MOST_POINTS, MOST_PIECES = 400, 64


def weight(M: float) -> float:
    in_range("M", M, 0, inf, "kg", above=True)
    return in_range("M", M, LIGHTEST, inf, "kg")


def check_stem(r: float, l: float) -> None:
    if (r == 0) != (l == 0):
        name = "r" if r == 0 else "l"
        raise TopError(name, 0.0, "{range} ({unit})", "A stem has a radius and a length; with both 0 there is none.",
                       code="half-a-stem", range=f"{name} > 0", unit="m")  # fmt: skip
    if l:
        in_range("l", l, SMALLEST, inf, "m")


def in_range(
    name: str,
    value: float,
    low: float,
    high: float,
    unit: str,
    above: bool = False,
    below: bool = False,
    *,
    code: str = "out-of-range",
    why: str = "",
    remedy: str = "",
) -> float:
    """value as a float, or a TopError unless low <= value <= high (strictly if above or below). why: the reason for the
    range."""
    value = finite(name, value)
    if (low < value if above else low <= value) and (value < high if below else value <= high):
        return value
    left = f"{low:g} {'<' if above else '<='} " if isfinite(low) else ""
    right = f" {'<' if below else '<='} {high:g}" if isfinite(high) else ""
    allowed = f"{{range}} ({{unit}}, {why})" if why else "{range} ({unit})"
    raise TopError(name, value, allowed, remedy, code=code, range=f"{left}{name}{right}", unit=unit)


def whole(name: str, value: object, low: int, high: int, least: str = "") -> None:
    """Raises a TopError unless value is a whole number of this range. least: what `low` is, as in " (the corners)"."""
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)) or not low <= value <= high:
        raise TopError(name, value, f"a whole number from {{low}}{least} to {{high}}", code="not-whole", low=low,
                       high=high)  # fmt: skip


def rows_of(name: str, rows: object, columns: int, most: int) -> tuple[tuple[float, ...], ...]:
    """rows as a tuple of tuples of floats, or a TopError."""
    if not isinstance(rows, (list, tuple, np.ndarray)) or not 1 <= len(rows) <= most:
        raise TopError(name, rows, "{count} rows of numbers", code="wrong-count", count=f"1 - {most}")
    for index, row in enumerate(rows):
        if np.shape(row) != (columns,):
            raise TopError(f"{name}[{index}]", row, "{count} numbers", code="wrong-count", count=columns)
    return tuple(
        tuple(finite(f"{name}[{index}]", value) for value in row) for index, row in enumerate(rows))  # fmt: skip
