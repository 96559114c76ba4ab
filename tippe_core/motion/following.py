"""A motion followed from event to event: steps of stepper.py with the dynamics of dynamics.py, guards watched on the
way, events located on the step's polynomial, and contacts.py to say how it goes on."""

import numpy as np

from ..compiled import compiled
from ..types import Array
from .contacts import (
    BALANCES,
    GUARDS,
    HALTS,
    LEAVES,
    LOG_STILL,
    RIM,
    ROCKS,
    SLIPS,
    STANDS_UP,
    TOUCHES,
    first_negative,
    guards,
    halted,
    known,
    margin,
    may_stick,
    settle,
)
from .dynamics import BALL, NO_ONE, OPEN, SLIP, STEM, STICK, arrange, forces, rates, turning
from .friction import CONTENSOU, COULOMB
from .poses import record, turned
from .records import Record
from .standing import leaning, lies
from .tally import tally
from .stepper import STAGES, A, B, at_share, densely, error, factor, stage, when, within

# How following ends for now: the times are over; more steps are needed; Coulomb's friction holds the ball; for good.
OVER, MORE, ROLLS, ENDED = -1, -2, -3, -4
# events by number
STICKS, SLIPS_OFF, LIFTS_OFF, LANDS, LANDS_ON_STEM, STEM_TOUCHES, BALL_TOUCHES, STEM_LEAVES, STANDS_ON_STEM = range(9)
FALLS_BACK, ROCKS_OVER, RIM_TOUCHES, STANDS_UPRIGHT, PAINLEVE, TOO_MANY_EVENTS, TOO_MANY_TURNS = range(9, 16)
NAMES = ("sticks", "slips", "lifts off", "lands", "lands on its stem", "stem touches", "ball touches", "stem leaves",
         "stands on its stem", "falls back on its ball", "rocks over", "rim touches", "stands upright",
         "Painleve's limit", "too many events", "too many turns")  # fmt: skip
SUPPORTS = ("none", "ball", "stem", "both")  # by ball + 2 stem

FIRST = 1e-3  # (R/g)^1/2: a first step; it grows fast
SMALLEST = 1e-13  # (R/g)^1/2: no step is smaller
NEAR = 0.1  # a guard as near to 0 is looked at along the step
LOOKS = 8  # so many times
SLIPS_LITTLE = 1e-3  # relative precision of a slip at least
STIFF = 10.0  # times faster than a slip changes its direction is attracted, where it is kept steady
NEARLY_STILL = 1e5  # times the tolerance: a slip and spin of a patch at which it may come to rest


@compiled
def follow(W: Record, P: Record, times: Array, rows: Array, end: float, limit: int) -> int:
    """On until the first event, whose number is returned, or OVER, or MORE. Samples at the times go into rows."""
    y, C, S = W.y, W.contacts, W.step
    ball, stem = W.modes[BALL], W.modes[STEM]
    if W.begins:
        W.begins, W.slowest = 0, NO_ONE
        W.h = FIRST
        arrange(y, NO_ONE, OPEN, OPEN, P, C)
        W.floor[0], W.floor[1] = min(C.height[0], 0.0), min(C.height[1], 0.0)
        guards(y, NO_ONE, ball, stem, W.floor, P, S, C, W.guards)
        event = first_negative(W.guards)
        if event != NO_ONE:
            return event
        k = W.samples
        while k < len(times) and times[k] <= y[12]:
            sample(W, P, y, NO_ONE, times[k], rows)
            k = W.samples
    while y[12] < end:
        if W.steps >= limit:
            return MORE
        W.steps += 1
        event = advance(W, P, times, rows, end)
        if event != NO_ONE:
            return event
    return OVER


@compiled
def advance(W: Record, P: Record, times: Array, rows: Array, end: float) -> int:
    """One step, or its part before an event; the event or NO_ONE."""
    y, S, C, ball, stem = W.y, W.step, W.contacts, W.modes[BALL], W.modes[STEM]
    slowest = change_variables(W, P)
    scales(W, P, slowest)
    timed = P.law.kind != CONTENSOU and slowest == NO_ONE
    h, near = accept(W, P, slowest, end - y[12] if timed else np.inf)
    if timed:  # without the rounding of its integration
        S.new[12] = end if h == end - y[12] else y[12] + h
    event, share, k, N = NO_ONE, 1.0, W.samples, C.F[BALL, 2] + C.F[STEM, 2]
    if near < NEAR or S.new[12] > end or (k < len(times) and times[k] <= S.new[12]):
        densely(S, h, slowest, ball, stem, P, C)
    if near < NEAR:
        event, share = first_event(W, P, slowest)
    if S.new[12] > end and (share == 1.0 or within(S, share, 12) > end):
        event, share = NO_ONE, when(S, end)
    t = S.new[12] if share == 1.0 else (y[12] + share * h if timed else within(S, share, 12))
    if t > end or (share < 1.0 and t > end - 1e-15):
        t = end
    while k < len(times) and times[k] <= t:
        x = (times[k] - y[12]) / h if timed else when(S, times[k])
        at_share(S, x, S.at)
        sample(W, P, S.at, slowest, times[k], rows)
        k = W.samples
    if share == 1.0:
        S.at[:] = S.new
    else:
        at_share(S, share, S.at)
    before = moved(W, P, slowest, t)
    if event == NO_ONE and share == 1.0:
        event = comes_to_rest(W, P, slowest, before)
    tally(W, P, 0.0 if LEAVES <= event < LEAVES + 2 else N if share == 1.0 else np.inf)
    return event


@compiled
def change_variables(W: Record, P: Record) -> int:
    """y into step.z; with Coulomb's law log|u| and beta of the slowest contact in place of v. Which one that is.

    Kept from step to step as they are: v has not the digits of a slip that dies away. Where friction is at its limit,
    so that a slow slip hardly changes, beta is attracted to its steady value so fast that the steps would shrink with
    |u|: there it is kept at that value (W.steady), from which it is off by |u| beta'/c, c the rate at |u| = 1.
    """
    y, S, C, slowest, least = W.y, W.step, W.contacts, NO_ONE, np.inf
    S.z[:] = y
    if P.law.kind == COULOMB:
        arrange(y, NO_ONE, W.modes[BALL], W.modes[STEM], P, C)
        for i in range(1 + P.stem):
            speed = np.exp(W.polar[0]) if i == W.slowest else np.hypot(C.u[i, 0], C.u[i, 1])
            if W.modes[i] == SLIP and speed < least:
                slowest, least = i, speed
        if slowest == W.slowest and slowest != NO_ONE:
            S.z[8], S.z[9] = W.polar[0], W.polar[1]
        elif slowest != NO_ONE:
            S.z[8], S.z[9] = np.log(least), np.arctan2(C.u[slowest, 1], C.u[slowest, 0])
    W.steady = 0
    if slowest != NO_ONE and least < P.tolerance ** (2 / 3):
        S.at[:] = S.z
        beta, attracts, grows = steady_direction(W, P, slowest)
        W.steady = attracts > STIFF * abs(grows) and abs(beta - S.z[9]) < SLIPS_LITTLE
    return slowest


@compiled
def scales(W: Record, P: Record, slowest: int) -> None:
    """What an error of each component of z is measured by: the tolerance times 1 rad, |L|, |v|, R, the energy."""
    y, S, tolerance = W.y, W.step, P.tolerance
    L = max(P.I1, np.sqrt(y[5] * y[5] + y[6] * y[6] + y[7] * y[7]))
    v = max(1.0, np.sqrt(y[8] * y[8] + y[9] * y[9] + y[14] * y[14]))
    S.scale[:] = tolerance
    for i in range(5, 8):
        S.scale[i] = tolerance * L
    S.scale[8] = S.scale[9] = S.scale[14] = tolerance * v
    S.scale[13] = tolerance * max(1.0, L * L / P.I1)
    if slowest != NO_ONE:
        S.scale[8] = S.scale[9] = max(min(tolerance * v / np.exp(S.z[8]), SLIPS_LITTLE), tolerance)


@compiled
def accept(W: Record, P: Record, slowest: int, most: float) -> tuple[float, float]:
    """A step from step.z to step.new within the tolerance, not longer than most: its length, and margin()'s least."""
    S, factors = W.step, 0.0
    while True:
        h = min(W.h, most)
        found, near = attempt(W, P, slowest, h)
        factors = factor(found)
        if found < 1.0 or h <= SMALLEST:
            break
        W.h = h * factors
    W.h = max(h * factors, W.h if h < W.h else 0.0, SMALLEST)
    return h, near


@compiled
def attempt(W: Record, P: Record, slowest: int, h: float) -> tuple[float, float]:
    """The stages of a step of length h and its end into step.new: its error, and the least of margin()."""
    S, C, ball, stem, near = W.step, W.contacts, W.modes[BALL], W.modes[STEM], np.inf
    for s in range(STAGES + 1):
        if s == 0:
            S.at[:] = S.z
        else:
            stage(S.z, S.K, A[s] if s < STAGES else B, s, h, S.at)
        if W.steady:
            S.at[9] = steady_direction(W, P, slowest)[0]
        minor = rates(S.at, slowest, ball, stem, P, C, S.K[s])
        if W.steady:
            S.K[s, 9] = 0.0
        near = min(near, margin(S.at, minor, ball, stem, P, C))
    S.new[:] = S.at
    return error(S.K, S.scale, h), near


@compiled
def steady_direction(W: Record, P: Record, slowest: int) -> tuple[float, float, float]:
    """beta near that of step.at at which u' is along u, how fast it is attracted there and how fast log|u| grows."""
    S, C, ball, stem = W.step, W.contacts, W.modes[BALL], W.modes[STEM]
    beta, out, near = S.at[9], S.K[15], 1e-4
    for _ in range(3):
        S.at[9] = beta + near
        rates(S.at, slowest, ball, stem, P, C, out)
        beside = out[9]
        S.at[9] = beta
        rates(S.at, slowest, ball, stem, P, C, out)
        attracts = (out[9] - beside) / near
        if attracts <= 0.0 or abs(out[9]) > attracts:
            return S.at[9], 0.0, out[8]
        beta += out[9] / attracts
        if abs(out[9]) < 1e-12 * attracts:
            break
    return beta, attracts, out[8]


@compiled
def first_event(W: Record, P: Record, slowest: int) -> tuple[int, float]:
    """The first guard that falls below 0 within the step, or NO_ONE, and the share of the step at which it does."""
    before, event, share = 0.0, NO_ONE, 1.0
    for n in range(1, LOOKS + 1):
        x = n / LOOKS
        watched(W, P, slowest, x)
        if first_negative(W.guards) == NO_ONE:
            before = x
            continue
        negative = W.guards < 0
        for i in range(GUARDS):
            if negative[i]:
                at = crossing(W, P, slowest, i, before, x)
                if event == NO_ONE or at < share:
                    event, share = i, at
        break
    return event, share


@compiled
def watched(W: Record, P: Record, slowest: int, x: float) -> None:
    """The guards at the share x of the step."""
    C = W.contacts
    at_share(W.step, x, W.step.at)
    guards(W.step.at, slowest, W.modes[BALL], W.modes[STEM], W.floor, P, W.step, C, W.guards)


@compiled
def height_or_guard(W: Record, P: Record, slowest: int, i: int, x: float, touches: bool) -> float:
    """Guard i at the share x of the step; of one that touches, the height."""
    watched(W, P, slowest, x)
    return W.contacts.height[i - TOUCHES] if touches else W.guards[i]


@compiled
def crossing(W: Record, P: Record, slowest: int, i: int, low: float, high: float) -> float:
    """The share of the step at which guard i falls below 0, between two, by false position and bisection in turns."""
    touches = TOUCHES <= i < TOUCHES + 2 and height_or_guard(W, P, slowest, i, low, True) > 0.0
    f_low = height_or_guard(W, P, slowest, i, low, touches)
    f_high = height_or_guard(W, P, slowest, i, high, touches)
    if f_low <= 0.0:
        return low
    for n in range(60):
        if high - low < 1e-14:
            break
        x = (low + high) / 2 if n % 3 == 2 else low + (high - low) * f_low / (f_low - f_high)
        f = height_or_guard(W, P, slowest, i, x, touches)
        if f > 0.0:
            low, f_low = x, f
        else:
            high, f_high = x, f
        if f == 0.0:
            break
    return high


@compiled
def moved(W: Record, P: Record, slowest: int, t: float) -> float:
    """y from step.at at the time t, angles followed, p of unit length; how fast the slowest contact slipped before."""
    y, C, S = W.y, W.contacts, W.step
    ball, stem = W.modes[BALL], W.modes[STEM]
    before = np.exp(S.z[8]) if slowest != NO_ONE else np.inf
    if P.law.kind == CONTENSOU:
        _, w, _ = arrange(y, NO_ONE, ball, stem, P, C)
        before = np.inf
        for i in range(1 + P.stem):
            if W.modes[i] == SLIP:
                before = min(before, np.hypot(np.hypot(C.u[i, 0], C.u[i, 1]), P.law.width * w[2]))
    size = 1 / np.sqrt(S.at[0] ** 2 + S.at[1] ** 2 + S.at[2] ** 2 + S.at[3] ** 2)
    for i in range(4):
        S.at[i] *= size
    arrange(S.at, slowest, ball, stem, P, C)
    W.slowest, W.polar[0], W.polar[1] = slowest, S.at[8], S.at[9]
    y[:] = S.at
    y[12] = t
    known(y, C)
    turned(y, W.angles)
    return before


@compiled
def comes_to_rest(W: Record, P: Record, slowest: int, before: float) -> int:
    """HALTS + i where friction stops the slowest contact i, SLIPS + i where its slip goes through 0, or NO_ONE."""
    y, C, ball, stem = W.y, W.contacts, W.modes[BALL], W.modes[STEM]
    if slowest != NO_ONE:
        speed = W.step.new[8]
        if speed < min(np.log(before), LOG_STILL):  # near the limit of friction it may hold yet
            if may_stick(y, ball, stem, slowest, P, C):
                halted(y, slowest, P, C)
                return HALTS + slowest
            if speed < 2 * LOG_STILL:
                return SLIPS + slowest
    elif P.law.kind == CONTENSOU:
        _, w, _ = arrange(y, NO_ONE, ball, stem, P, C)
        for i in range(1 + P.stem):
            speed = np.hypot(np.hypot(C.u[i, 0], C.u[i, 1]), P.law.width * w[2])
            if W.modes[i] == SLIP and speed < min(before, NEARLY_STILL * P.tolerance, 1e-6):
                if may_stick(y, ball, stem, i, P, C):
                    halted(y, i, P, C)
                    return HALTS + i
    return NO_ONE


@compiled
def sample(W: Record, P: Record, z: Array, slowest: int, t: float, rows: Array) -> None:
    """One more row, at z."""
    C, k = W.contacts, W.samples
    ball, stem = W.modes[BALL], W.modes[STEM]
    turn = arrange(z, slowest, ball, stem, P, C)
    forces(turn, ball, stem, P, C)
    turned(z, W.angles)
    record(z, t, turn, W.angles, ball, stem, P, C, rows[k])
    W.samples = k + 1


# ---- from event to event ----


@compiled
def run(
    W: Record, P: Record, log: Array, times: Array, rows: Array, end: float, flies: bool, hands_over: bool, steps: int
) -> int:
    """On over events: OVER, MORE after so many steps, ROLLS where asked to hand that over, or ENDED; see log."""
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
    """The event, into the log, and the modes after it; whether the motion ends there."""
    y, C, ball, stem = W.y, W.contacts, W.modes[BALL], W.modes[STEM]
    if event in (BALANCES, STANDS_UP, RIM):
        names = PAINLEVE if event == BALANCES else STANDS_UPRIGHT if event == STANDS_UP else RIM_TOUCHES
        noted(W, log, names, ball, stem)
        return True
    W.begins = 1
    if event == TOUCHES + STEM and np.isnan(W.tally.time_stem):
        W.tally.time_stem = y[12]
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
    """One more line of the log."""
    n = W.events
    log[n, 0], log[n, 1] = W.y[12], name
    log[n, 2] = (1 if ball != OPEN else 0) + (2 if stem != OPEN else 0)
    W.tally.hops += name == LIFTS_OFF
    W.events = n + 1


@compiled
def change(ball_before: int, stem_before: int, ball: int, stem: int, event: int) -> int:
    """What to call the change of modes after an event."""
    before = (1 if ball_before != OPEN else 0) + (2 if stem_before != OPEN else 0)
    after = (1 if ball != OPEN else 0) + (2 if stem != OPEN else 0)
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
