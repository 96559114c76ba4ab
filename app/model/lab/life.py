"""The whole life of a toy on the ordinary table: until the table has gripped it for good, and a moment more."""

from collections.abc import Callable
from dataclasses import replace
from typing import TypeVar

import numpy as np

from app.model.planes.picture import Setup
from app.model.planes.run import cut, slid
from tippe_core import TopError, Trajectory

SECONDS = 6.0  # of a run while a hand moves, and of every other at least
LIFE = 60.0  # s, at most
AFTER = 2.0  # s that are seen of what goes on for ever
NEAR, FAR = (0.5, 0.01), (1.0, 0.02)  # from row to row at most so many rad and s: within SECONDS, and later
MOST_ROWS = 6000


T = TypeVar("T", bound=Setup)


def within(start: T) -> T:
    """A Setup of no more seconds than its turns can be shown."""
    try:
        start.times  # noqa: B018  (it is computed, or refused)
    except TopError as error:
        if error.code != "too-many-turns":
            raise
        return replace(start, seconds=float(error.numbers["most"]))
    return start


def lived(start: Setup, look: Callable[[float], object]) -> tuple[float, Trajectory]:
    """How long a start is to be seen, s, and its Trajectory until then, thinned. look: as progress of slide()."""
    time, seconds, most = start.scales.time, 2 * SECONDS, LIFE
    while True:
        wanted, seconds = seconds, within(replace(start, seconds=seconds)).seconds
        most = seconds if seconds < wanted else most
        times = replace(start, seconds=seconds).times
        moved = slid(start, start.state, times, look)
        end = _end(moved, time, ended=len(moved.t) < len(times))
        if end <= seconds or seconds >= most:
            break
        seconds = min(2 * seconds, most)
    found = thinned(moved, time, min(end, seconds))
    if len(found.t) > MOST_ROWS:
        found = thinned(moved, time, time * float(found.t[MOST_ROWS - 1]))
    elif len(moved.t) < len(times):
        return end, found
    return time * float(found.t[-1]), found


def _end(moved: Trajectory, time: float, *, ended: bool) -> float:
    """Until when it is to be seen, s: AFTER the table has gripped it for good, or what ended it; inf if neither."""
    slips, last = np.flatnonzero(moved.regime != "roll"), len(moved.t) - 1
    if len(slips) and slips[-1] == last and not ended:
        return np.inf
    since = last if ended else slips[-1] + 1 if len(slips) else 0
    return max(SECONDS, float(np.ceil(10 * (time * moved.t[since] + AFTER)) / 10))


def thinned(moved: Trajectory, time: float, until: float = np.inf) -> Trajectory:
    """A Trajectory until then, s, in as few of its rows as show it: as NEAR and FAR say, and where anything changes.

    time: s in one unit of its time."""
    step, turning = np.diff(moved.t), np.linalg.norm(moved.omega, axis=1)
    later = (time * moved.t[1:] > SECONDS)[:, None]
    turn, while_ = np.where(later, FAR, NEAR).T
    rows = np.cumsum(step * np.maximum(np.maximum(turning[:-1], turning[1:]) / turn, time / while_))
    changes = moved.regime[1:] != moved.regime[:-1]
    kept = np.ones(len(moved.t), dtype=bool)
    kept[1:-1] = (np.diff(np.floor(rows[:-1]), prepend=0.0) > 0) | changes[:-1] | changes[1:]
    seen = time * moved.t <= until * (1 + 1e-9)
    kept[np.flatnonzero(seen)[-1]] = True
    return cut(moved, kept & seen, lambda t: time * t <= until)
