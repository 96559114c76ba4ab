"""What is said when a value cannot be used: its name, the value, the allowed range, what to do."""

import math
from typing import SupportsFloat

import numpy as np
from numpy.typing import ArrayLike

from .types import Array


class TopError(ValueError):
    """A quantity outside the range in which it means anything.

    Attributes name, value, allowed and remedy hold the parts of the sentence; str() is the sentence.
    """

    def __init__(self, name: str, value: object, allowed: str, remedy: str = "") -> None:
        self.name, self.value, self.allowed, self.remedy = name, value, allowed, remedy
        shown = f"{value:.10g}" if isinstance(value, float) else repr(value)
        super().__init__(f"{name} = {shown} is not possible: allowed is {allowed}." + (f" {remedy}" if remedy else ""))


class NoMotionError(TopError):
    """The energy is below the bottom of every well of f: no such motion exists."""


def finite(name: str, value: SupportsFloat) -> float:
    """value as a float, or a TopError that names it."""
    try:
        number = float(value)
    except (TypeError, ValueError, OverflowError):
        number = math.nan
    if isinstance(value, bool) or not math.isfinite(number):
        raise TopError(name, value, "a finite number")
    return number


def numbers(name: str, values: ArrayLike) -> Array:
    """values as a new float array, or a TopError that names them."""
    try:
        array = np.array(values)
    except (TypeError, ValueError, OverflowError):
        array = np.array("")
    if array.dtype.kind not in "iuf":
        raise TopError(name, values, "finite numbers")
    array = array.astype(float)
    if not np.all(np.isfinite(array)):
        raise TopError(name, float(array[~np.isfinite(array)].flat[0]), "a finite number")
    return array
