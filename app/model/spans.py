"""Spans of time, and what a quantity given at instants does in them."""

from collections.abc import Iterable

import numpy as np

from tippe_core.types import Array, Bools

Span = tuple[float, float]
"""From one time to another."""
GAP, DEEP = 0.1, 10.0  # s, degrees: a shorter and smaller interruption does not count


def lasting(t: Array, above: Array, long: float) -> list[Span]:
    """The spans in which a quantity (degrees) is above 0: those at least so long, ignoring gaps shorter than GAP and
    not as deep as DEEP."""
    inside = np.concatenate([[False], above > 0, [False]])
    starts, ends = np.flatnonzero(~inside[:-1] & inside[1:]), np.flatnonzero(inside[:-1] & ~inside[1:])
    spans: list[Span] = []
    last = 0
    for i, j in zip(starts, ends, strict=True):
        start = float(t[0] if i == 0 else np.interp(0.0, above[i - 1 : i + 1], t[i - 1 : i + 1]))
        end = float(t[-1] if j == len(t) else np.interp(0.0, above[[j, j - 1]], t[[j, j - 1]]))
        if spans and start - spans[-1][1] < GAP and above[last:i].min() > -DEEP:
            start = spans.pop()[0]
        spans.append((start, end))
        last = j
    return [span for span in spans if span[1] - span[0] >= long]


def passes(t: Array, values: Array, level: float, i: int) -> float:
    """When a quantity that is on one side of a level at the sample i passes it before the next."""
    if i + 1 == len(t) or values[i] == values[i + 1]:
        return float(t[i])
    share = (level - values[i]) / (values[i + 1] - values[i])
    return float(t[i] + np.clip(share, 0.0, 1.0) * (t[i + 1] - t[i]))


def running_mean(t: Array, values: Array, around: float) -> Array:
    """The mean over the time `around` each instant; within half of it from an end of the run, over that at the end."""
    total = np.concatenate([[0.0], np.cumsum(np.diff(t) * (values[1:] + values[:-1]) / 2)])
    width = min(around, t[-1] - t[0])
    low = np.clip(t - width / 2, t[0], t[-1] - width)
    return np.asarray((np.interp(low + width, t, total) - np.interp(low, t, total)) / width)


def changes(t: Array, tilt: Array, around: float) -> Array:
    """How much the tilt changes in the time `around` each instant."""
    low = np.searchsorted(t, t - around / 2)
    high = np.searchsorted(t, t + around / 2, side="right")
    return np.array([np.ptp(tilt[i:j]) for i, j in zip(low, high, strict=True)])


def within(t: Array, spans: list[Span]) -> Bools:
    found = np.zeros(len(t), dtype=bool)
    for start, end in spans:
        found |= (t >= start) & (t <= end)
    return found


def outside(span: Span, found: Iterable[Span]) -> list[Span]:
    """What is left of a span outside of others."""
    left = [span]
    for first, last in found:
        left = [piece for start, end in left for piece in ((start, min(end, first)), (max(start, last), end))
                if piece[1] - piece[0] > 1e-9]  # fmt: skip
    return left
