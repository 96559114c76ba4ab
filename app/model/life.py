"""The whole life of a toy on the ordinary table: until it rolls for good, and a moment longer."""

from collections.abc import Callable
from dataclasses import replace
from typing import TypeVar

import numpy as np

from app.model.motion import slid
from app.model.setup import SECONDS, Setup
from tippe_core import TopError, Trajectory

LIFE = 60.0  # s, at most
AFTER = 2.0  # s that are still shown of a motion that goes on for ever
NEAR, FAR = (0.5, 0.01), (1.0, 0.02)  # largest rotation (rad) and time (s) between two rows: up to SECONDS, and after
MOST_ROWS = 6000
ROUNDING = 1e-9  # relative


T = TypeVar("T", bound=Setup)


def within(start: T) -> T:
    """A Setup, shortened if it makes too many turns to be shown."""
    try:
        start.times  # noqa: B018  (it is computed, or refused)
    except TopError as error:
        if error.code != "too-many-turns":
            raise
        return replace(start, seconds=float(error.numbers["most"]) * (1 - ROUNDING))
    return start


def lived(start: Setup, look: Callable[[], Callable[[float], object]]) -> tuple[float, Trajectory]:
    """How long a start is to be shown, s, and its Trajectory until then, thinned. look(): the progress of a slide()."""
    time = start.scales.time
    for wanted in (2 * SECONDS, 4 * SECONDS, LIFE):  # most have come to their end in the first
        seconds = within(replace(start, seconds=wanted)).seconds
        times = replace(start, seconds=seconds).times
        moved = slid(start, start.state, times, look())
        end = _end(moved, time, ended=len(moved.t) < len(times))
        if end <= seconds or seconds < wanted:
            break
    found = thinned(moved, time, min(end, seconds))
    if len(found.t) > MOST_ROWS:
        found = thinned(moved, time, time * float(found.t[MOST_ROWS - 1]))
    elif len(moved.t) < len(times):
        return min(end, LIFE), found
    return min(time * float(found.t[-1]), LIFE), found


def _end(moved: Trajectory, time: float, *, ended: bool) -> float:
    """Until when the motion is to be shown, s: until AFTER seconds after it rolls for good or has ended; inf if it does
    neither."""
    slips, last = np.flatnonzero(moved.regime != "roll"), len(moved.t) - 1
    if len(slips) and slips[-1] == last and not ended:
        return np.inf
    since = last if ended else slips[-1] + 1 if len(slips) else 0
    return max(SECONDS, float(np.ceil(10 * (time * moved.t[since] + AFTER)) / 10))


def thinned(moved: Trajectory, time: float, until: float = np.inf) -> Trajectory:
    """A Trajectory up to the time `until` (s), with as few of its rows as are needed: at the intervals NEAR and FAR,
    and wherever the regime changes.

    time: s in one unit of its time.
    """
    step, turning = np.diff(moved.t), np.linalg.norm(moved.omega, axis=1)
    later = (time * moved.t[1:] > SECONDS)[:, None]
    turn, while_ = np.where(later, FAR, NEAR).T
    rows = np.cumsum(step * np.maximum(np.maximum(turning[:-1], turning[1:]) / turn, time / while_))
    changes = moved.regime[1:] != moved.regime[:-1]
    kept = np.ones(len(moved.t), dtype=bool)
    kept[1:-1] = (np.diff(np.floor(rows[:-1]), prepend=0.0) > 0) | changes[:-1] | changes[1:]
    seen = time * moved.t <= until * (1 + 1e-9)
    kept[np.flatnonzero(seen)[-1]] = True
    return moved[kept & seen]
