"""Zeros and minima of a function of one variable, for kernels: plain loops, no derivatives."""

from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np

Arguments: TypeAlias = tuple[Any, ...]  # further arguments of the function, after x


def zero(function: Callable[..., float], low: float, high: float, args: Arguments, part: float = 1e-8) -> float:
    """The zero of function(x, *args) between low and high, as in enclose(). A last linear interpolation squares the
    relative error `part`."""
    x, y, opposite, y_opposite = enclose(function, low, high, args, part)
    return x + y / (y - y_opposite) * (opposite - x) if y != y_opposite else x


def fallen(function: Callable[..., float], low: float, high: float, args: Arguments, part: float = 1e-14) -> float:
    """Where function(x, *args) has just ceased to be positive between low, where it is, and high, as in enclose()."""
    x, y, opposite, _ = enclose(function, low, high, args, part)
    return opposite if y > 0 else x


def enclose(
    function: Callable[..., float], low: float, high: float, args: Arguments, part: float
) -> tuple[float, float, float, float]:
    """(x, y, opposite, y_opposite): two points close to a zero of function(x, *args) between low and high,
    0 <= low < high, where it has opposite signs, and its values there.

    Inverse quadratic interpolation where that is safe, otherwise bisection (T. R. Chandrupatla, Adv. Eng. Softw. 28,
    145 (1997)), until the bracket has shrunk to the fraction `part` of x and of its first width.
    """
    x, y = high, function(high, *args)  # the newest
    opposite, y_opposite = low, function(low, *args)
    share = 0.5
    for _ in range(200):
        new = x + share * (opposite - x)
        y_new = function(new, *args)
        if (y_new > 0) == (y > 0):
            last, y_last = x, y
        else:
            last, y_last, opposite, y_opposite = opposite, y_opposite, x, y
        x, y = new, y_new
        best = x if abs(y) < abs(y_opposite) else opposite
        enough, bracket = max(part * min(best, high - low), 4e-16 * best), abs(opposite - x)
        if y == 0 or enough >= bracket / 2:
            break
        within = enough / bracket
        share = 0.5
        if y_last not in (y, y_opposite):
            place, height = (x - opposite) / (last - opposite), (y - y_opposite) / (y_last - y_opposite)
            if height * height < place and (1 - height) * (1 - height) < 1 - place:
                near, far = y / (y_opposite - y), y / (y_last - y)
                share = near * y_last / (y_opposite - y_last)
                share += (last - x) / (opposite - x) * far * y_opposite / (y_last - y_opposite)
        share = min(max(share, within), 1 - within)
    return x, y, opposite, y_opposite


def least(
    function: Callable[..., float], low: float, at: float, high: float, args: Arguments, part: float = 1e-15
) -> float:
    """A minimum of function(x, *args) between low and high, given a point `at` with a smaller value than at both ends.
    part: the relative accuracy of the minimum value.

    The vertex of the parabola through the last three points if it lies inside and the steps shrink, otherwise a golden
    section (R. P. Brent, Algorithms for Minimization Without Derivatives (1973), ch. 5).
    """
    y_low, y, y_high = function(low, *args), function(at, *args), function(high, *args)
    last = before = high - low
    near = 1e-3 * last
    for _ in range(80):
        left, right = (y_low - y) * (high - at), (y_high - y) * (at - low)
        step = (left * (high - at) - right * (at - low)) / (2 * (left + right)) if left + right > 0 else np.nan
        parabola = low < at + step < high and abs(step) < before / 2  # False for nan and inf
        if not parabola:
            step = 0.381966 * ((high - at) if high - at > at - low else (low - at))
        before, last = last, abs(step)
        new = at + step
        y_new = function(new, *args)
        if parabola and abs(step) < near and abs(y_new - y) <= part * abs(y):
            return new if y_new < y else at
        if high - low <= 1e-9 * high:
            return at
        if y_new < y:
            low, y_low, high, y_high = (at, y, high, y_high) if new > at else (low, y_low, at, y)
            at, y = new, y_new
        elif new > at:
            high, y_high = new, y_new
        else:
            low, y_low = new, y_new
    return at
