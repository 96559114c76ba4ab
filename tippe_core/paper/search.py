"""Zeros and minima of a function of one number, for kernels: plain loops, no derivative."""

from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np

from ..compiled import shared_with_kernels

Arguments: TypeAlias = tuple[Any, ...]  # of the function, after x


@shared_with_kernels
def zero(function: Callable[..., float], low: float, high: float, args: Arguments, part: float = 1e-16) -> float:
    """A zero of function(x, *args) between low and high, 0 <= low < high, where its signs differ: to this part of x.

    Inverse quadratic interpolation where it is safe, else bisection (T. R. Chandrupatla, Adv. Eng. Softw. 28, 145
    (1997)).
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
        within = part * best / abs(opposite - x) if opposite != x else 1.0
        if y == 0 or within > 0.5:
            return best
        share = 0.5
        if y_last != y and y_last != y_opposite:
            place, height = (x - opposite) / (last - opposite), (y - y_opposite) / (y_last - y_opposite)
            if height * height < place and (1 - height) * (1 - height) < 1 - place:
                share = y / (y_opposite - y) * y_last / (y_opposite - y_last) + (last - x) / (opposite - x) * y / (
                    y_last - y
                ) * y_opposite / (y_last - y_opposite)
        share = min(max(share, within), 1 - within)
    return x


@shared_with_kernels
def least(
    function: Callable[..., float], low: float, at: float, high: float, args: Arguments, part: float = 1e-15
) -> float:
    """A minimum of function(x, *args) between low and high, where it is less at `at`: to this part of its value.

    The vertex of the parabola through the last three points where it falls inside, else a golden section.
    """
    y_low, y, y_high = function(low, *args), function(at, *args), function(high, *args)
    near = 1e-3 * (high - low)
    for _ in range(60):
        left, right = (y_low - y) * (high - at), (y_high - y) * (at - low)
        step = (left * (high - at) - right * (at - low)) / (2 * (left + right)) if left + right > 0 else np.nan
        parabola = low < at + step < high and abs(step) < (high - low) / 3  # neither for nan nor inf
        if not parabola:
            step = 0.38 * ((high - at) if high - at > at - low else (low - at))
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
