"""From event to event: the name of each event, and how the motion continues after it."""

import numpy as np

from ..compiled import compiled
from ..types import Array
from .contacts import BALANCES, HALTS, LEAVES, RIM, ROCKS, SLIPS, STANDS_UP, TOUCHES, settle
from .dynamics import BALL, OPEN, STEM, STICK, carried, turning
from .following import ENDED, MORE, OVER, ROLLS, follow
from .friction import COULOMB
from .poses import turned
from .records import TIME, Record
from .standing import leaning, lies

# events by number
STICKS, SLIPS_OFF, LIFTS_OFF, LANDS, LANDS_ON_STEM, STEM_TOUCHES, BALL_TOUCHES, STEM_LEAVES, STANDS_ON_STEM = range(9)
FALLS_BACK, ROCKS_OVER, RIM_TOUCHES, STANDS_UPRIGHT, PAINLEVE, TOO_MANY_EVENTS, TOO_MANY_TURNS = range(9, 16)
NAMES = ("sticks", "slips", "lifts off", "lands", "lands on its stem", "stem touches", "ball touches", "stem leaves",
         "stands on its stem", "falls back on its ball", "rocks over", "rim touches", "stands upright",
         "Painleve's limit", "too many events", "too many turns")  # fmt: skip
SUPPORTS = ("none", "ball", "stem", "both")  # by carried()


@compiled
def run(
    W: Record, P: Record, log: Array, times: Array, rows: Array, end: float, flies: bool, hands_over: bool, steps: int
) -> int:
    """Integrates across events: OVER, MORE after so many steps, ROLLS if hands_over, or ENDED. log lists the events."""
    limit = W.steps + steps
    while True:
        if hands_over and W.modes[BALL] == STICK and W.modes[STEM] == OPEN and P.law.kind == COULOMB:
            return ROLLS
        event = follow(W, P, times, rows, end, limit)
        if event in (OVER, MORE):
            return event
        if happens(W, P, log, event, flies):
            return ENDED


@compiled
def happens(W: Record, P: Record, log: Array, event: int, flies: bool) -> bool:
    """Records the event in the log and sets the modes after it; returns whether the motion ends there."""
    y, C, ball, stem = W.y, W.contacts, W.modes[BALL], W.modes[STEM]
    if event in (BALANCES, STANDS_UP, RIM):
        names = PAINLEVE if event == BALANCES else STANDS_UPRIGHT if event == STANDS_UP else RIM_TOUCHES
        noted(W, log, names, ball, stem)
        return True
    W.begins = 1
    if event == TOUCHES + STEM and np.isnan(W.tally.time_stem):
        W.tally.time_stem = y[TIME]
    goes_on = settle(y, event, W.floor, W.modes, P, W.step, C)
    turned(y, W.angles)
    if not goes_on:
        W.modes[BALL], W.modes[STEM] = ball, stem
        left_ball, left_stem = (OPEN if event == LEAVES else ball), (OPEN if event == LEAVES + 1 else stem)
        noted(W, log, change(ball, stem, left_ball, left_stem, event), ball, stem)
        noted(W, log, PAINLEVE, ball, stem)
        return True
    ends, (e, w, _) = False, turning(y, P)
    if event == ROCKS and W.modes[STEM] != OPEN:
        ends = leaning(e, w)[1] <= 0.0 or lies(P, (P.b, P.h, P.q), e, w)
    name = STANDS_UPRIGHT if ends else change(ball, stem, W.modes[BALL], W.modes[STEM], event)
    if e[2] < P.rim:
        name, ends = RIM_TOUCHES, True
    ends = ends or (name == LIFTS_OFF and not flies)
    if ends:
        W.modes[BALL], W.modes[STEM] = ball, stem
    noted(W, log, name, W.modes[BALL], W.modes[STEM])
    if W.events >= len(log) - 2 and not ends:
        noted(W, log, TOO_MANY_EVENTS, W.modes[BALL], W.modes[STEM])
        return True
    return ends


@compiled
def noted(W: Record, log: Array, name: int, ball: int, stem: int) -> None:
    """Adds a line to the log."""
    n = W.events
    log[n, 0], log[n, 1], log[n, 2] = W.y[TIME], name, carried(ball, stem)
    W.tally.hops += name == LIFTS_OFF
    W.events = n + 1


@compiled
def change(ball_before: int, stem_before: int, ball: int, stem: int, event: int) -> int:
    """The name of the change of modes after an event."""
    before, after = carried(ball_before, stem_before), carried(ball, stem)
    if before == 0:
        return LANDS_ON_STEM if after >= 2 or (after == 0 and event == TOUCHES + STEM) else LANDS
    if before == after or after == 3:
        if event == ROCKS:
            return ROCKS_OVER
        if event >= HALTS:
            return STICKS
        if SLIPS <= event < SLIPS + 2:
            return SLIPS_OFF
        return STEM_TOUCHES if (event - LEAVES) % 2 == STEM else BALL_TOUCHES
    if before == 3 and after == 1:
        return STEM_LEAVES
    return LIFTS_OFF if after == 0 else FALLS_BACK if after == 1 else STANDS_ON_STEM
