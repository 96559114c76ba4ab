"""The summary of a motion, accumulated step by step."""

import numpy as np

from ..compiled import compiled, shared_with_kernels
from ..paper.search import zero
from ..types import Array
from .dynamics import BALL, OPEN, STEM, STICK, carried, kinetic, turning
from .poses import tilt
from .records import LZ, PW, PX, PY, PZ, TIME, Record, Z
from .stepper import at_end, at_share, densely, when, within

LAST = 0.1  # the last fraction of the time, by which the end is judged
UPRIGHT, LEANS = 0.2, 0.05  # rad: closer than this to a pole; the tilt changes by less than this


@compiled
def energy(W: Record, P: Record) -> float:
    return kinetic(W.y, turning(W.y, P)[2], P) + W.y[Z]


@compiled
def begin_tally(W: Record, P: Record, since: float) -> None:
    """Starts an empty summary; since: the time from which on the tilt and the supports count."""
    T, (e, _, L3) = W.tally, turning(W.y, P)
    T.since, T.C_J, T.drift, T.hops, T.seen, T.slips = since, W.y[LZ] - P.a * L3, 0.0, 0, 0, 0
    T.time_90 = W.y[TIME] if e[2] == 0.0 else np.nan
    T.time_stem = W.y[TIME] if W.modes[STEM] != OPEN else np.nan
    T.F_z_least = T.least = np.inf
    T.most = -np.inf


@compiled
def tally(W: Record, P: Record, N: float) -> None:
    """Updates the summary at the end of a step, with the normal force N there."""
    T, y, (_, _, L3) = W.tally, W.y, turning(W.y, P)
    ball, stem = W.modes[BALL], W.modes[STEM]
    if ball != OPEN or stem != OPEN:
        T.F_z_least = min(T.F_z_least, N)
    if np.isnan(T.time_stem):
        T.drift = max(T.drift, abs(y[LZ] - P.a * L3 - T.C_J))
    if y[TIME] >= T.since:
        T.seen |= 1 << carried(ball, stem)
        if ball not in (OPEN, STICK) or stem not in (OPEN, STICK) or (ball == OPEN and stem == OPEN):
            T.slips = 1


@compiled
def tally_tilt(W: Record, P: Record, slowest: int, h: float, share: float, dense: bool) -> None:
    """Records when theta first passes 90 degrees, and once that counts the range of theta, within the step of length h
    from step.z, up to the fraction share, from the polynomial of the step. dense: whether it is computed already."""
    T, S = W.tally, W.step
    e, rate, e1, rate1, begins, ends = up(S.z), up_rate(S.z, P), up(S.at), up_rate(S.at, P), S.z[TIME], S.at[TIME]
    turns = rate * rate1 < 0.0
    near = turns and e * rate < 0.0 and min(abs(e), abs(e1)) < (abs(rate) + abs(rate1)) * (ends - begins)
    passes, counts = np.isnan(T.time_90) and (e * e1 <= 0.0 or near), ends >= T.since
    if counts:
        widen(T, S.at)
    if not (passes or (counts and (turns or begins < T.since))):
        return
    if not dense:
        densely(W, P, slowest, h)
    turn = zero(up_rate_at, 0.0, share, (S, P)) if turns else share
    at_share(S, turn, S.at)
    there, when_there = up(S.at), within(S, turn, TIME)
    if counts and when_there >= T.since:
        widen(T, S.at)
    if counts and begins < T.since:
        at_share(S, when(S, T.since), S.at)
        widen(T, S.at)
    if passes and e * there <= 0.0:
        T.time_90 = within(S, zero(up_at, 0.0, turn, (S,)), 12)
    elif passes and e * e1 <= 0.0:
        T.time_90 = within(S, zero(up_at, turn, share, (S,)), 12)
    at_end(S, share)


@compiled
def up(y: Array) -> float:
    """e_z = cos(theta), up to the norm of p."""
    return y[PZ] * y[PZ] + y[PW] * y[PW] - y[PX] * y[PX] - y[PY] * y[PY]


@compiled
def up_rate(y: Array, P: Record) -> float:
    """e_z' = (w x e)_z"""
    e, w, _ = turning(y, P)
    return w[0] * e[1] - w[1] * e[0]


@compiled
def widen(T: Record, y: Array) -> None:
    """Extends the range of tilts by that of y."""
    theta = tilt(y)
    T.least, T.most = min(T.least, theta), max(T.most, theta)


@shared_with_kernels
def up_at(x: float, S: Record) -> float:
    """up() at the fraction x of the step."""
    at_share(S, x, S.at)
    return up(S.at)


@shared_with_kernels
def up_rate_at(x: float, S: Record, P: Record) -> float:
    """up_rate() at the fraction x of the step."""
    at_share(S, x, S.at)
    return up_rate(S.at, P)
