"""Integrates a motion, from event to event: steps of stepper.py with the equations of dynamics.py, with a watch on the
guards and on what is noted."""

import numpy as np

from ..compiled import compiled
from ..types import Array, Vector
from . import at, contacts, stepper
from .dynamics import arrange, forces, rates
from .events import first_event, happens
from .friction import is_point
from .impact import halted
from .implicit import IMPLICIT_ORDER, TOLERANCE, differentiate, implicit_step, is_stiff, until_half
from .kinds import HALTS, LEAVES, NONE, SLIPS, Event
from .poses import continue_angles, record
from .records import BALL, NO_ONE, OPEN, SLIP, STEM, STICK, Record, modes_of
from .stepper import STAGES, within
from .summary import summarize, watch_tilt

# Why else follow() or run() returns: the times are over; more steps are needed; Coulomb friction makes the ball roll;
# it has ended.
OVER, MORE, HANDS_OVER, ENDED = range(NONE - 1, NONE - 5, -1)

FIRST_STEP = 1e-3  # (R/g)^1/2: the first step; the following ones grow fast
SHORTEST_STEP = 1e-13  # (R/g)^1/2: the smallest step
NEAR_EVENT = 0.1  # a guard this close to 0 is examined along the step
SLIPS_LITTLE = 1e-3  # the least relative accuracy of a slip
LEAP = 2.0  # a slip grows by exp(LEAP) in one step at most: the error of the polynomial through the step is not
# controlled, and the exponential would magnify it
STIFF_DIRECTION = 10.0  # if beta relaxes so many times faster than log|u| changes, it is kept at its steady value
NEARLY_STILL = 1e-7  # (gR)^1/2: slip and spin at which a patch may come to rest, if the tolerance is smaller


def run(
    W: Record, P: Record, log: Array, times: Array, rows: Array, end: float, flies: bool, hands_over: bool, steps: int
) -> int:
    """Integrates across events: OVER, MORE after so many steps, HANDS_OVER if hands_over and it rolls, or ENDED. log
    lists the events."""
    limit = W.steps + steps
    while True:
        if hands_over and modes_of(W) == (STICK, OPEN) and is_point(P.law):
            return HANDS_OVER
        event = follow(W, P, log, times, rows, end, limit)
        if event[0] == OVER or event[0] == MORE:
            return event[0]
        if happens(W, P, log, event, flies):
            return ENDED


@compiled
def follow(W: Record, P: Record, log: Array, times: Array, rows: Array, end: float, limit: int) -> Event:
    """Integrates until the first event, which it returns, or (OVER or MORE, BALL). Samples at the times go into
    rows."""
    y, C, S = W.y, W.contacts, W.step
    modes = modes_of(W)
    if W.begins:
        W.begins, W.rated, W.stiff, W.slowest = 0, 0, 0, NO_ONE
        W.h = FIRST_STEP
        arrange(y, NO_ONE, (OPEN, OPEN), P, C)
        W.floor[0], W.floor[1] = min(C.height[0], 0.0), min(C.height[1], 0.0)
        contacts.guards(y, NO_ONE, modes, W.floor, P, S, C, W.guards)
        event = contacts.first_negative(W.guards)
        if event[0] != NONE:
            return event
        k = W.samples
        while k < len(times) and times[k] <= y[at.TIME]:
            sample(W, P, y, NO_ONE, times[k], rows)
            k = W.samples
    while y[at.TIME] < end and not sampled(W, times):
        if W.steps >= limit:
            return MORE, BALL
        W.steps += not S.begun
        event = advance(W, P, log, times, rows, end)
        if event[0] != NONE:
            return event
    return OVER, BALL


def sampled(W: Record, times: Array) -> bool:
    """Whether there are times, with a sample at each."""
    return 0 < len(times) == W.samples


def advance(W: Record, P: Record, log: Array, times: Array, rows: Array, end: float) -> Event:
    """Takes one step, or the part of it before an event, and samples it; returns the event, NONE, or OVER within the
    step once there is a sample at each of the times, so that the next call with later times goes on in it."""
    y, S = W.y, W.step
    if not S.begun:
        begin_step(W, P, log, times, end)
    while W.samples < len(times) and times[W.samples] <= S.until:
        t = times[W.samples]
        x = (t - y[at.TIME]) / S.h if S.timed else stepper.when(S, t)
        stepper.at_share(W, P, x, S.at)
        sample(W, P, S.at, S.slowest, t, rows)
    if sampled(W, times):
        return OVER, BALL
    return end_step(W, P)


def begin_step(W: Record, P: Record, log: Array, times: Array, end: float) -> None:
    """Finds a step, at most up to the time `end`, and the part of it before an event, without changing y."""
    y, S, C = W.y, W.step, W.contacts
    S.slowest = slowest = change_variables(W, P)
    if W.rated:  # the last stage of the previous step
        S.K[0, :] = S.K[STAGES]
    scales(W, P, slowest)
    S.timed = timed = P.law.radius == 0.0 and slowest == NO_ONE
    S.h, near = accept(W, P, slowest, end - y[at.TIME] if timed else np.inf)
    if timed:  # free of rounding errors of the integration
        S.new[at.TIME] = end if S.h == end - y[at.TIME] else y[at.TIME] + S.h
    event, share, k, S.N = (NONE, BALL), 1.0, W.samples, C.F[BALL, 2] + C.F[STEM, 2]
    dense = near < NEAR_EVENT or S.new[at.TIME] > end or (k < len(times) and times[k] <= S.new[at.TIME])
    if dense:
        stepper.densely(W, P, slowest, S.h)
    if near < NEAR_EVENT:
        event, share = first_event(W, P, slowest)
    over = S.new[at.TIME] > end and (share == 1.0 or within(S, share, at.TIME) > end)
    if over:
        event, share = (NONE, BALL), stepper.when(S, end)
    t = S.new[at.TIME] if share == 1.0 else (y[at.TIME] + share * S.h if timed else within(S, share, at.TIME))
    S.begun, S.share, S.until, S.event[0], S.event[1] = 1, share, end if over else min(t, end), event[0], event[1]
    stepper.at_end(W, P, share)
    watch_tilt(W, P, log, slowest, S.h, share, dense)


def end_step(W: Record, P: Record) -> Event:
    """Moves y to the end of the step, or of its part before an event; returns the event or NONE."""
    S, event = W.step, (W.step.event[0], W.step.event[1])
    S.begun = 0
    stepper.at_end(W, P, S.share)
    before = moved(W, P, S.slowest, S.until)
    if event[0] == NONE and S.share == 1.0:
        event = comes_to_rest(W, P, S.slowest, before)
    W.rated = event[0] == NONE and S.share == 1.0 and S.slowest == NO_ONE
    summarize(W, P, 0.0 if event[0] == LEAVES else S.N if S.share == 1.0 else np.inf)
    return event


def change_variables(W: Record, P: Record) -> int:
    """Writes y into step.z, with log|u| and beta of the slowest contact in place of v for Coulomb's law. Returns that
    contact.

    log|u| and beta are carried over from step to step, because v does not have the digits of a decaying slip. If
    friction is near its limit, so that a slow slip hardly changes, beta relaxes to its steady value so fast that the
    steps would shrink with |u|. Then it is kept at that value (W.steady); the error is |u| beta'/c, with the relaxation
    rate c at |u| = 1.
    """
    y, S, C, slowest, least = W.y, W.step, W.contacts, NO_ONE, np.inf
    S.z[:] = y
    if is_point(P.law):
        arrange(y, NO_ONE, modes_of(W), P, C)
        for i in range(1 + P.stem):
            speed = np.exp(W.polar[0]) if i == W.slowest else np.hypot(C.u[i, 0], C.u[i, 1])
            if W.modes[i] == SLIP and speed < least:
                slowest, least = i, speed
        if slowest == W.slowest and slowest != NO_ONE:
            S.z[at.LOG_U], S.z[at.BETA] = W.polar[0], W.polar[1]
        elif slowest != NO_ONE:
            S.z[at.LOG_U], S.z[at.BETA] = np.log(least), np.arctan2(C.u[slowest, 1], C.u[slowest, 0])
    W.steady = 0
    if slowest != NO_ONE:
        W.rated = 0
    if slowest != NO_ONE and least < P.tolerance ** (2 / 3):
        S.at[:] = S.z
        beta, attracts, grows = stepper.steady_direction(W, P, slowest)
        W.steady = attracts > STIFF_DIRECTION * abs(grows) and abs(beta - S.z[at.BETA]) < SLIPS_LITTLE
    return slowest


def scales(W: Record, P: Record, slowest: int) -> None:
    """The scale of the error of each component of z: the tolerance times 1 rad, |L|, |v|, R or the energy."""
    y, S, tolerance = W.y, W.step, P.tolerance
    if W.stiff:
        tolerance = max(tolerance, TOLERANCE)
    L = max(P.I1, np.sqrt(y[at.LX] * y[at.LX] + y[at.LY] * y[at.LY] + y[at.LZ] * y[at.LZ]))
    v = max(1.0, np.sqrt(y[at.VX] * y[at.VX] + y[at.VY] * y[at.VY] + y[at.VZ] * y[at.VZ]))
    S.scale[:] = tolerance
    for i in (at.LX, at.LY, at.LZ):
        S.scale[i] = tolerance * L
    S.scale[at.VX] = S.scale[at.VY] = S.scale[at.VZ] = tolerance * v
    S.scale[at.HEAT] = tolerance * max(1.0, L * L / P.I1)
    if slowest != NO_ONE:
        of_slip = max(min(0.1 * tolerance / np.exp(S.z[at.LOG_U]), SLIPS_LITTLE), tolerance)
        S.scale[at.LOG_U] = S.scale[at.BETA] = of_slip


def accept(W: Record, P: Record, slowest: int, most: float) -> tuple[float, float]:
    """Finds a step from step.z to step.new within the tolerance, at most `most` long: its length, and the least
    margin()."""
    S, order = W.step, IMPLICIT_ORDER if W.stiff else stepper.ORDER
    if W.stiff:
        differentiate(W, P)
        most = min(most, until_half(W))
    while True:
        h = min(W.h, most)
        found, near = implicit_step(W, P, h) if W.stiff else try_step(W, P, slowest, h)
        if slowest != NO_ONE and S.new[at.LOG_U] - S.z[at.LOG_U] > LEAP:
            found = np.inf
        factors = stepper.factor(found, order)
        if found < 1.0 or h <= SHORTEST_STEP:
            break
        W.h = h * factors
    W.h = max(h * factors, W.h if h < W.h else 0.0, SHORTEST_STEP)
    W.implicit = W.stiff
    W.stiff = P.law.radius > 0.0 and is_stiff(W, P, h)
    if W.stiff and not W.implicit:
        W.h *= S.K[STAGES, at.TIME]
    elif W.implicit and not W.stiff:
        W.h /= S.K[STAGES, at.TIME]
    return h, near


def try_step(W: Record, P: Record, slowest: int, h: float) -> tuple[float, float]:
    """Computes the stages of a step of length h, and its end into step.new: its error, and the least margin()."""
    S, C, modes, near = W.step, W.contacts, modes_of(W), np.inf
    for s in range(1 if W.rated else 0, STAGES + 1):
        if s == 0:
            S.at[:] = S.z
        else:
            stepper.stage(S.z, S.K, stepper.A[s] if s < STAGES else stepper.B, s, h, S.at)
        if W.steady:
            minor = stepper.steady_rates(W, P, slowest, s)
        else:
            minor = rates(S.at, slowest, modes, P, C, S.K[s])
        near = min(near, contacts.margin(S.at, minor, modes, P, C))
    S.new[:], W.rated = S.at, 1
    return stepper.error(S.K, S.scale, h), near


def moved(W: Record, P: Record, slowest: int, t: float) -> float:
    """Sets y from step.at at the time t, with continuous angles and p normalized; returns the earlier slip speed of the
    slowest contact."""
    y, C, S = W.y, W.contacts, W.step
    modes = modes_of(W)
    before = np.exp(S.z[at.LOG_U]) if slowest != NO_ONE else np.inf
    if P.law.radius > 0.0:
        _, w, _ = arrange(y, NO_ONE, modes, P, C)
        before = np.inf
        for i in range(1 + P.stem):
            if W.modes[i] == SLIP:
                before = min(before, patch_speed(w, i, P, C))
    size = 1 / np.sqrt(S.at[at.PX] ** 2 + S.at[at.PY] ** 2 + S.at[at.PZ] ** 2 + S.at[at.PW] ** 2)
    for i in range(4):
        S.at[i] *= size
    arrange(S.at, slowest, modes, P, C)
    W.slowest, W.polar[0], W.polar[1] = slowest, S.at[at.LOG_U], S.at[at.BETA]
    y[:] = S.at
    y[at.TIME] = t
    contacts.known(y, C)
    continue_angles(y, W.angles)
    return before


def comes_to_rest(W: Record, P: Record, slowest: int, before: float) -> Event:
    """(HALTS, i) if friction stops the slowest contact i, (SLIPS, i) if its slip goes through 0, or NONE."""
    y, C, modes = W.y, W.contacts, modes_of(W)
    if slowest != NO_ONE:
        speed = W.step.new[at.LOG_U]
        if speed < min(np.log(before), contacts.LOG_STILL):  # near the limit of friction it may still stick
            modes = contacts.stuck(modes, slowest)
            if contacts.may_stick(y, modes, slowest, P, C):
                halted(y, modes, P, C)
                return HALTS, slowest
            if speed < 2 * contacts.LOG_STILL:
                return SLIPS, slowest
    elif P.law.radius > 0.0:
        return patch_comes_to_rest(W, P, before)
    return NONE, BALL


def patch_comes_to_rest(W: Record, P: Record, before: float) -> Event:
    """The same for patches, two of which may come to rest together."""
    y, C, modes, slow = W.y, W.contacts, modes_of(W), max(NEARLY_STILL, 10 * P.tolerance)
    _, w, _ = arrange(y, NO_ONE, modes, P, C)
    speeds = patch_speed(w, BALL, P, C), patch_speed(w, STEM, P, C)
    for i in range(1 + P.stem):
        if modes[i] == SLIP and speeds[i] < min(before, slow):
            left = speeds[i] * (y[at.TIME] - W.step.z[at.TIME]) / (before - speeds[i])  # time until it vanishes
            if left * left > max(P.tolerance, NEARLY_STILL):  # it may as well grow again
                continue
            together = modes[1 - i] == SLIP and speeds[1 - i] < slow and contacts.may_both_stick(y, P, C)
            rest = (STICK, STICK) if together else contacts.stuck(modes, i)
            holds = together or contacts.may_stick(y, rest, i, P, C)
            if holds or speeds[i] < contacts.NUDGE / 4:
                rates(y, NO_ONE, modes, P, C, W.step.K[0])
                if modes[BALL] == OPEN or modes[STEM] == OPEN:  # a straight line would lift one of two off the table
                    for k in range(16):
                        y[k] += left * W.step.K[0, k] / W.step.K[0, at.TIME]
                    arrange(y, NO_ONE, modes, P, C)
                    contacts.known(y, C)
                halted(y, rest, P, C)
                return (HALTS if holds else SLIPS), i
    return NONE, BALL


def patch_speed(w: Vector, i: int, P: Record, C: Record) -> float:
    """How fast a patch slips, or turns at its rim."""
    return np.hypot(np.hypot(C.u[i, 0], C.u[i, 1]), P.law.radius * w[2])


def sample(W: Record, P: Record, z: Array, slowest: int, t: float, rows: Array) -> None:
    """Adds a row for z."""
    C, k = W.contacts, W.samples
    modes = modes_of(W)
    turn = arrange(z, slowest, modes, P, C)
    forces(turn, modes, P, C)
    continue_angles(z, W.angles)
    record(z, t, turn, W.angles, modes, P, C, rows[k])
    W.samples = k + 1
