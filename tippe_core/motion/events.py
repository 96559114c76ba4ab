"""What happens in a motion: the table of events, where in a step one of them happens, the log, and how the motion goes
on after it."""

from typing import Any

import numpy as np

from ..compiled import compiled
from ..paper.search import fallen
from ..types import Array, Number
from . import at, contacts
from .dynamics import carried, turning
from .kinds import BALANCES, HALTS, LEAVES, NONE, RIM, ROCKS, SLIPS, STANDS_UP, STARTS, TOUCHES, Event, Modes
from .poses import continue_angles
from .records import BALL, OPEN, STEM, Record, modes_of
from .standing import leaning, lies
from .stepper import at_share

CHANGES, ENDS, NOTES = range(3)  # after an event the motion goes on in other modes, or ends, or goes on as before
EVENTS = (
    ("sticks", CHANGES), ("slips", CHANGES), ("lifts off", CHANGES), ("lands", CHANGES), ("lands on its stem", CHANGES),
    ("stem touches", CHANGES), ("ball touches", CHANGES), ("stem leaves", CHANGES), ("stands on its stem", CHANGES),
    ("falls back on its ball", CHANGES), ("rocks over", CHANGES), ("rim touches", ENDS), ("stands upright", ENDS),
    ("Painleve's limit", ENDS), ("too many events", ENDS), ("too many steps", ENDS),
    ("theta passes 90 degrees", NOTES), ("the stem touches first", NOTES),
)  # fmt: skip
STICKS, SLIPS_OFF, LIFTS_OFF, LANDS, LANDS_ON_STEM, STEM_TOUCHES, BALL_TOUCHES, STEM_LEAVES, STANDS_ON_STEM = range(9)
FALLS_BACK, ROCKS_OVER, RIM_TOUCHES, STANDS_UPRIGHT, PAINLEVE, TOO_MANY_EVENTS, TOO_MANY_STEPS = range(9, 16)
PASSES_90, FIRST_TOUCH = 16, 17
SUPPORTS = ("none", "ball", "stem", "both")  # by carried()
# why a motion is refused that ends with this event
REASONS = {PAINLEVE: "too-strong", RIM_TOUCHES: "beyond-rim", TOO_MANY_EVENTS: "too-many-events",
           TOO_MANY_STEPS: "too-many-steps", LIFTS_OFF: "lifts-off"}  # fmt: skip
# the event in the table that follows from a guard alone, by its kind
ALONE = np.full(STARTS + 1, NONE)
ALONE[[BALANCES, STANDS_UP, RIM]] = PAINLEVE, STANDS_UPRIGHT, RIM_TOUCHES
# what is noted where a value of noted_values() changes its sign
NOTED = np.array([PASSES_90])
LOOKS = 8  # points of a step at which the guards are evaluated


# ---- where ----


@compiled
def noted_values(up: Number, up_rate: Number) -> tuple[Number, ...]:
    """A value for each of NOTED, from e_z and e_z'."""
    return (up,)


def first_event(W: Record, P: Record, slowest: int) -> tuple[Event, float]:
    """The first event within the step at which a guard falls below 0, or NONE, and the fraction of the step."""
    before, event, share = 0.0, (NONE, BALL), 1.0
    for n in range(1, LOOKS + 1):
        x = n / LOOKS
        watch(W, P, slowest, x)
        if contacts.first_negative(W.guards)[0] == NONE:
            before = x
            continue
        negative = W.guards < 0
        for kind in range(len(negative)):
            for i in range(2):
                if negative[kind, i]:
                    at = crossing(W, P, slowest, (kind, i), before, x)
                    if event[0] == NONE or at < share:
                        event, share = (kind, i), at
        break
    return event, share


def watch(W: Record, P: Record, slowest: int, x: float) -> None:
    """Computes the guards at the fraction x of the step."""
    C = W.contacts
    at_share(W, P, x, W.step.at)
    contacts.guards(W.step.at, slowest, modes_of(W), W.floor, P, W.step, C, W.guards)


def height_or_guard(x: float, W: Record, P: Record, slowest: int, event: Event, touches: bool) -> float:
    """The guard of the event at the fraction x of the step; for one that touches, the height."""
    watch(W, P, slowest, x)
    return W.contacts.height[event[1]] if touches else W.guards[event[0], event[1]]


def crossing(W: Record, P: Record, slowest: int, event: Event, low: float, high: float) -> float:
    """The fraction of the step, between low and high, at which the guard of the event falls below 0."""
    touches = event[0] == TOUCHES and height_or_guard(low, W, P, slowest, event, True) > 0.0
    if height_or_guard(low, W, P, slowest, event, touches) <= 0.0:
        return low
    return fallen(height_or_guard, low, high, (W, P, slowest, event, touches))


# ---- what follows ----


@compiled
def happens(W: Record, P: Record, log: Array, event: Event, flies: bool) -> bool:
    """Records the event in the log and sets the modes after it; returns whether the motion ends there."""
    y, C, before, (kind, i) = W.y, W.contacts, modes_of(W), event
    if ALONE[kind] != NONE:
        logged(W, log, ALONE[kind], before)
        return True
    W.begins = 1
    if kind == TOUCHES and i == STEM:
        touched(W, log)
    goes_on = contacts.settle(y, event, W.modes, P, W.step, C)
    continue_angles(y, W.angles)
    if not goes_on:
        W.modes[BALL], W.modes[STEM] = before
        left = before if kind != LEAVES else (OPEN, before[STEM]) if i == BALL else (before[BALL], OPEN)
        logged(W, log, change(before, left, event), before)
        logged(W, log, PAINLEVE, before)
        return True
    ends, (e, w, _) = False, turning(y, P)
    if kind == ROCKS and W.modes[STEM] != OPEN:
        ends = leaning(e, w)[1] <= 0.0 or lies(P, (P.b, P.h, P.q), e, w)
    name = STANDS_UPRIGHT if ends else change(before, modes_of(W), event)
    if e[2] < P.rim:
        name, ends = RIM_TOUCHES, True
    ends = ends or (name == LIFTS_OFF and not flies)
    if ends:
        W.modes[BALL], W.modes[STEM] = before
    logged(W, log, name, modes_of(W))
    if W.events >= len(log) // 2 and not ends:
        logged(W, log, TOO_MANY_EVENTS, modes_of(W))
        return True
    return ends


@compiled
def logged(W: Record, log: Array, name: int, modes: Modes) -> None:
    """Adds an event to the log."""
    enter(W, log, W.y[at.TIME], name, carried(modes))
    W.events += 1


@compiled
def noted(W: Record, log: Array, name: int, t: float) -> None:
    """Adds to the log what changes nothing, as long as that leaves room for the events."""
    if W.logged - W.events < len(log) // 2 - 2:
        enter(W, log, t, name, carried(modes_of(W)))


def enter(W: Record, log: Array, t: float, name: int, supports: int) -> None:
    """Adds an entry to the log."""
    entry = log[W.logged]
    entry.t, entry.name, entry.supports = t, name, supports
    W.logged += 1


def lands(W: Record, log: Array, event: Event) -> None:
    """Adds to the log how a start that moves into the table lands, after its impact."""
    logged(W, log, change((OPEN, OPEN), modes_of(W), event), modes_of(W))


def first(log: Any, name: int) -> float:
    """When something happens for the first time, nan if never."""
    return float(next(iter(log["t"][log["name"] == name]), np.nan))


def touched(W: Record, log: Array) -> None:
    """Notes that the stem touches now, if it is the first time."""
    if not W.summary.touched:
        noted(W, log, FIRST_TOUCH, W.y[at.TIME])
    W.summary.touched = 1


@compiled
def change(modes_before: Modes, modes: Modes, event: Event) -> int:
    """The name of the change of modes after an event."""
    before, after, (kind, i) = carried(modes_before), carried(modes), event
    if before == 0:
        return LANDS_ON_STEM if after >= 2 or (after == 0 and kind == TOUCHES and i == STEM) else LANDS
    if before == after or after == 3:
        if kind == ROCKS:
            return ROCKS_OVER
        if kind == HALTS or kind == STARTS:
            return STICKS
        if kind == SLIPS:
            return SLIPS_OFF
        return STEM_TOUCHES if i == STEM else BALL_TOUCHES
    if before == 3 and after == 1:
        return STEM_LEAVES
    return LIFTS_OFF if after == 0 else FALLS_BACK if after == 1 else STANDS_ON_STEM
