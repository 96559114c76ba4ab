"""The motion of a start on the ordinary table, which goes on from where it was: its first seconds, and the whole life
of the toy, until it rolls for good and a moment longer."""

from contextlib import suppress
from dataclasses import replace
from functools import lru_cache
from threading import Lock
from typing import NamedTuple

import numpy as np

from app.model.motion import PUSHED
from app.model.pushes import PushedSliding, with_pushes
from app.model.runs import TooLong, patience
from app.model.setup import SECONDS, Setup
from tippe_core import TopError, Trajectory
from tippe_core.types import Array

LIFE = 60.0  # s, at most
AFTER = 2.0  # s that are still shown of a motion that goes on for ever
NEAR, FAR = (0.5, 0.01), (1.0, 0.02)  # largest rotation (rad) and time (s) between two rows: up to SECONDS, and after
MOST_ROWS = 6000
MOST_LOOKS = 20_000  # calls of progress each time it goes on: some seconds; a toy that flips needs a hundred
ROUNDING = 1e-9  # relative
LONG, CATCHES = "long", "catches"  # why a motion is not computed to its end


class Lived(NamedTuple):
    """A motion from its start on: the Trajectory; its time in s, which is later than its last row if an event ends it;
    cut: LONG or CATCHES if it goes on but is not computed further, or ""."""

    moved: Trajectory
    seconds: float
    cut: str


def within(start: Setup) -> Setup:
    """A Setup, shortened if it makes too many turns to be shown."""
    try:
        start.times  # noqa: B018  (it is computed, or refused)
    except TopError as error:
        if error.code != "too-many-turns":
            raise
        return replace(start, seconds=float(error.numbers["most"]) * (1 - ROUNDING))
    return start


class Life:
    """The motion of a Setup, as far as anybody has asked for it. Threads may share it."""

    def __init__(self, start: Setup) -> None:
        self._start, self._sliding, self._time, self._lock = start, PushedSliding(start), start.scales.time, Lock()
        self._step = float(start.times[1])
        self._most = within(replace(start, seconds=LIFE)).seconds
        self._rows = 0

    def until(self, seconds: float) -> Lived:
        """The motion up to a time, from where it was when somebody asked before; what look() raises stops it there."""
        seconds = min(seconds, self._most)
        times = with_pushes(self._step * np.arange(float(round(seconds / self._time / self._step) + 1)), self._start)
        count = len(times)
        with self._lock:
            if self._rows < count and not self._sliding.ended:
                self._go_on(times[self._rows :])
            moved = self._sliding.trajectory[:count]
            if len(moved) < count and not self._sliding.ended:
                return Lived(moved, float(moved.t[-1]) * self._time, CATCHES)
        return Lived(moved, seconds, LONG if seconds == self._most and len(moved) == count else "")

    def _go_on(self, times: Array) -> None:
        try:
            with suppress(TooLong):
                self._sliding.until(times, patience(MOST_LOOKS))
        finally:
            self._rows = len(self._sliding.trajectory)


@lru_cache(4)
def life_of(start: Setup) -> Life:
    """The Life of a Setup, for all visitors. Raises TopError."""
    return Life(start)


def lived(start: Setup) -> Lived:
    """The motion for as long as it is to be shown, thinned."""
    life, time = life_of(start), start.scales.time
    for wanted in (2 * SECONDS, 4 * SECONDS, LIFE):  # most have come to their end in the first
        moved, seconds, cut = life.until(wanted)
        ended = not cut and time * moved.t[-1] < seconds * (1 - ROUNDING)
        end = _end(moved, time, ended=ended)
        if end <= seconds or cut:
            break
    found = thinned(moved, time, min(end, seconds))
    if len(found) > MOST_ROWS:
        found, ended = thinned(moved, time, time * float(found.t[MOST_ROWS - 1])), False
    if ended:
        return Lived(found, min(end, LIFE), "")
    rolls = found.regime[-1] == "roll" and cut != CATCHES
    return Lived(found, min(time * float(found.t[-1]), LIFE), "" if rolls else cut or LONG)


def _end(moved: Trajectory, time: float, *, ended: bool) -> float:
    """Until when the motion is to be shown, s: until AFTER seconds after it rolls for good or has ended; inf if it does
    neither."""
    slips, last = np.flatnonzero(moved.regime != "roll"), len(moved.t) - 1
    if len(slips) and slips[-1] == last and not ended:
        return np.inf
    since = last if ended else max([slips[-1] + 1 if len(slips) else 0, *pushed_rows(moved)])
    return max(SECONDS, float(np.ceil(10 * (time * moved.t[since] + AFTER)) / 10))


def pushed_rows(moved: Trajectory) -> list[int]:
    """The rows just after each push."""
    found = np.searchsorted(moved.t, [t for t, event in moved.events if event == PUSHED])
    return [int(i) for i in found if i < len(moved)]


def thinned(moved: Trajectory, time: float, until: float = np.inf) -> Trajectory:
    """A Trajectory up to the time `until` (s), with as few of its rows as are needed: at the intervals NEAR and FAR,
    and wherever the regime changes or it is pushed.

    time: s in one unit of its time.
    """
    step, turning = np.diff(moved.t), np.linalg.norm(moved.omega, axis=1)
    later = (time * moved.t[1:] > SECONDS)[:, None]
    turn, while_ = np.where(later, FAR, NEAR).T
    rows = np.cumsum(step * np.maximum(np.maximum(turning[:-1], turning[1:]) / turn, time / while_))
    changes = moved.regime[1:] != moved.regime[:-1]
    kept = np.ones(len(moved.t), dtype=bool)
    kept[1:-1] = (np.diff(np.floor(rows[:-1]), prepend=0.0) > 0) | changes[:-1] | changes[1:]
    for i in pushed_rows(moved):
        kept[i - 1 : i + 1] = True
    seen = time * moved.t <= until * (1 + 1e-9)
    kept[np.flatnonzero(seen)[-1]] = True
    return moved[kept & seen]
