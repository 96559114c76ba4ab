"""A motion that is pushed on its way: it goes on from the State after each push, as one Trajectory."""

from collections.abc import Callable
from dataclasses import fields, replace
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from app.model.motion import PUSHED, Progress, sliding_of
from app.model.setup import Push, Setup
from app.text import say
from tippe_core import Friction, State, TopError, Trajectory, Viscous, pushed
from tippe_core.types import Array, Rim

STRONGEST = 2.0  # M (gR)^1/2: some three times what knocks a toy over
ROUNDED = 1e-3  # relative: a page writes a point with some digits
UPRIGHT = 1e-4  # below this sine of the tilt 1' is x for a push, as in three/impulse.js: phi alone is no angle there


def size_words(push: Push) -> str:
    """How strong a push is."""
    return say(f"lab.pushed.{'small' if push.size < 1e3 else 'large'}", small=push.size, large=1e-3 * push.size)


def push_words(pushes: tuple[Push, ...]) -> str:
    """Pushes in a few words."""
    if not pushes:
        return say("lab.pushed.none")
    last = pushes[-1]
    return say(f"lab.pushed.{'one' if len(pushes) == 1 else 'several'}", size=size_words(last), time=last.t,
               count=len(pushes))  # fmt: skip


def with_pushes(times: Array, start: Setup) -> Array:
    """The times of a run, and those of its pushes up to the last of them."""
    pushes = np.array([push.t / start.scales.time for push in start.pushes])
    return np.union1d(times, pushes[pushes <= times[-1]]) if len(pushes) else times


def state_after(start: Setup, moved: Trajectory, push: Push, friction: Friction, edge: Rim | None = None) -> State:
    """The State after a push at the last instant of a motion. Raises TopError."""
    if push.size > (most := STRONGEST * start.impulse):
        raise TopError("push", push.size, "at most {most:.10g} in size", code="too-large", most=most)
    R, far = 1e3 * start.scales.R, float(np.linalg.norm(push.point))
    if far > (most := R * float(np.linalg.norm(start.profile, axis=1).max())) * (1 + ROUNDED):
        raise TopError("at", far, "at most {most:.10g} from O", code="too-large", most=most)
    state = moved.at(moved.t[-1])
    c, s = np.cos(state.theta), np.sin(state.theta)
    x, y, z = np.array(push.point) / R
    place, impulse = np.array([x, c * y - s * z, s * y + c * z]), np.array(push.impulse) / start.impulse
    if s < UPRIGHT:
        place, impulse = (Rotation.from_euler("z", -state.phi).apply(vector) for vector in (place, impulse))
    return pushed(start.top, state, impulse, place, friction, edge)


def joined(first: Trajectory | None, then: Trajectory) -> Trajectory:
    """A motion up to a push, whose last row is just before it, and the motion from it on."""
    if first is None:
        return then
    at, before = first.t[-1], first.t < first.t[-1]
    arrays: dict[str, Any] = {
        field.name: np.concatenate([value[before], getattr(then, field.name)])
        for field in fields(first) if isinstance(value := getattr(first, field.name), np.ndarray)
    }  # fmt: skip
    arrays["heat"] = np.concatenate([first.heat[before], first.heat[-1] + then.heat])
    supports = (*first.supports, *then.supports[then.supports[0][1] == first.supports[-1][1] :])
    return replace(first, events=(*first.events, (float(at), PUSHED), *then.events), supports=supports,
                   notes=(*first.notes, *then.notes), **arrays)  # fmt: skip


class PushedSliding:
    """The motion of a Setup on the ordinary table; goes on like a Sliding."""

    def __init__(self, start: Setup) -> None:
        self._start, self._left = start, list(start.pushes)
        self._before: Trajectory | None = None
        self._sliding = sliding_of(start, start.state)

    @property
    def ended(self) -> bool:
        """Whether an event has ended it."""
        return self._sliding.ended

    @property
    def trajectory(self) -> Trajectory:
        """The motion so far, at all of the times; not at that of a push that is still to come."""
        moved = self._sliding.trajectory
        if self._left and moved.t[-1] == self._left[0].t / self._start.scales.time:
            moved = moved[:-1]
        return joined(self._before, moved)

    def until(self, times: Array, progress: Progress | None = None) -> None:
        """Goes on, at these times, as with_pushes() gives them."""
        unit, start = self._start.scales.time, self._start
        while self._left and self._left[0].t / unit <= times[-1]:
            at = self._left[0].t / unit
            if not self._sliding.ended:
                self._sliding.until(times[times <= at], progress)
            moved = self._sliding.trajectory
            if moved.t[-1] < at:
                return  # it has ended before
            state = state_after(start, moved, self._left[0], start.friction, start.edge)
            self._before = joined(self._before, moved)
            self._sliding = sliding_of(start, state, at)
            self._sliding.until([at])
            self._left.pop(0)
            times = times[times > at]
        if len(times) and not self._sliding.ended:
            self._sliding.until(times, progress)


def in_pieces(
    start: Setup, state: State, piece: Callable[[State, Array], Trajectory], gripped: Callable[[State], State]
) -> Trajectory:
    """The motion from a State on a table on which only the ball is computed: piece(state, times) up to each push, and
    on from gripped(the State after it)."""
    times, found = with_pushes(start.times, start), None
    for push in start.pushes:
        at = push.t / start.scales.time
        moved = piece(state, times[times <= at])
        if moved.t[-1] < at:
            return joined(found, moved)
        state, found = state_after(start, moved, push, Viscous(0.0)), joined(found, moved)
        state, times = gripped(state), times[times >= at]
    return joined(found, piece(state, times))
