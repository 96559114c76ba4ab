"""Zeros and minima of a function of one number, for kernels: plain loops, no derivative."""

from collections.abc import Callable
from typing import Any, TypeAlias

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
