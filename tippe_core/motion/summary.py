"""The summary of a motion, and what is noted in its log, step by step."""

import numpy as np

from ..compiled import compiled
from ..paper.search import zero
from ..types import Array
from . import at
from .dynamics import carried, kinetic, turning
from .events import NOTED, PASSES_90, noted, noted_values, touched
from .poses import tilt_of
from .records import OPEN, SLIP, STEM, Record, modes_of
from .stepper import at_end, at_share, densely, when, within


@compiled
def energy_at(W: Record, P: Record) -> float:
    return kinetic(W.y, turning(W.y, P)[2], P) + W.y[at.Z]


@compiled
def begin(W: Record, P: Record, log: Array, since: float) -> None:
    """Starts an empty summary; since: the time from which on the tilt and the supports count."""
    T, (e, _, L3) = W.summary, turning(W.y, P)
    T.since, T.C_J, T.F_z_least, T.least, T.most = since, W.y[at.LZ] - P.a * L3, np.inf, np.inf, -np.inf
    if e[2] == 0.0:
        noted(W, log, PASSES_90, W.y[at.TIME])
    if W.modes[STEM] != OPEN:
        touched(W, log)


def summarize(W: Record, P: Record, N: float) -> None:
    """Updates the summary at the end of a step, with the normal force N there."""
    T, y, (_, _, L3) = W.summary, W.y, turning(W.y, P)
    modes = modes_of(W)
    if carried(modes):
        T.F_z_least = min(T.F_z_least, N)
    if not T.touched:
        T.drift = max(T.drift, abs(y[at.LZ] - P.a * L3 - T.C_J))
    if y[at.TIME] >= T.since:
        T.seen |= 1 << carried(modes)
        if SLIP in modes or not carried(modes):
            T.slips = 1


def watch_tilt(W: Record, P: Record, log: Array, slowest: int, h: float, share: float, dense: bool) -> None:
    """Notes what is noted in the step of length h from step.z, up to the fraction share, from the polynomial of the
    step, and once that counts the range of theta. dense: whether the polynomial is computed already."""
    T, S = W.summary, W.step
    e, rate, e1, rate1, begins, ends = up(W.y), up_rate(W.y, P), up(S.at), up_rate(S.at, P), W.y[at.TIME], S.at[at.TIME]
    first, last, turns, counts = noted_values(e, rate), noted_values(e1, rate1), rate * rate1 < 0.0, ends >= T.since
    # whether e_z may pass through 0 twice
    changes = turns and e * rate < 0.0 and min(abs(e), abs(e1)) < (abs(rate) + abs(rate1)) * (ends - begins)
    for n in range(len(NOTED)):
        changes = changes or (first[n] > 0.0) != (last[n] > 0.0)
    if counts:
        widen(T, S.at)
    if not (changes or (counts and (turns or begins < T.since))):
        return
    if not dense:
        densely(W, P, slowest, h)
    turn = zero(up_rate_at, 0.0, share, (W, P)) if turns else share
    at_share(W, P, turn, S.at)
    if counts and within(S, turn, at.TIME) >= T.since:
        widen(T, S.at)
    middle = noted_values(up(S.at), up_rate(S.at, P))
    if counts and begins < T.since:
        at_share(W, P, when(S, T.since), S.at)
        widen(T, S.at)
    for n in range(len(NOTED)):
        if (first[n] > 0.0) != (middle[n] > 0.0):
            noted(W, log, NOTED[n], within(S, zero(noted_at, 0.0, turn, (W, P, n)), at.TIME))
        if (middle[n] > 0.0) != (last[n] > 0.0):
            noted(W, log, NOTED[n], within(S, zero(noted_at, turn, share, (W, P, n)), at.TIME))
    at_end(W, P, share)


def up(y: Array) -> float:
    """e_z = cos(theta), up to the norm of p."""
    return y[at.PZ] * y[at.PZ] + y[at.PW] * y[at.PW] - y[at.PX] * y[at.PX] - y[at.PY] * y[at.PY]


def up_rate(y: Array, P: Record) -> float:
    """e_z' = (w x e)_z"""
    e, w, _ = turning(y, P)
    return w[0] * e[1] - w[1] * e[0]


def widen(T: Record, y: Array) -> None:
    """Extends the range of tilts by that of y."""
    theta = tilt_of(y)
    T.least, T.most = min(T.least, theta), max(T.most, theta)


def noted_at(x: float, W: Record, P: Record, n: int) -> float:
    """Value n of noted_values() at the fraction x of the step."""
    at_share(W, P, x, W.step.at)
    return noted_values(up(W.step.at), up_rate(W.step.at, P))[n]


def up_rate_at(x: float, W: Record, P: Record) -> float:
    """up_rate() at the fraction x of the step."""
    at_share(W, P, x, W.step.at)
    return up_rate(W.step.at, P)
