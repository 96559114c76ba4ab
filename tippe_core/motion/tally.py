"""What is said of a motion as a whole, counted up as it is followed."""

import numpy as np

from ..compiled import compiled
from .dynamics import BALL, OPEN, STEM, STICK, carried, kinetic, turning
from .records import Record

LAST = 0.1  # the share of the time by which the end is told
UPRIGHT, LEANS = 0.2, 0.05  # rad: so near to a pole; so little change of the tilt


@compiled
def energy(W: Record, P: Record) -> float:
    return kinetic(W.y, turning(W.y, P)[2], P) + W.y[15]


@compiled
def begin_tally(W: Record, P: Record, since: float) -> None:
    """An empty one; since: from when on the tilt and what carries count."""
    T, (e, _, L3) = W.tally, turning(W.y, P)
    T.since, T.C_J, T.drift, T.hops, T.seen, T.slips = since, W.y[7] - P.a * L3, 0.0, 0, 0, 0
    T.time_90 = W.y[12] if e[2] == 0.0 else np.nan
    T.time_stem = W.y[12] if W.modes[STEM] != OPEN else np.nan
    T.F_z_least = T.least = np.inf
    T.most = -np.inf


@compiled
def tally(W: Record, P: Record, N: float) -> None:
    """At the end of a step, with the load N that the table carried there."""
    T, y, (e, _, L3) = W.tally, W.y, turning(W.y, P)
    ball, stem = W.modes[BALL], W.modes[STEM]
    if ball != OPEN or stem != OPEN:
        T.F_z_least = min(T.F_z_least, N)
    if np.isnan(T.time_90) and (1 - 2 * (W.step.z[0] ** 2 + W.step.z[1] ** 2)) * e[2] <= 0.0:
        T.time_90 = passes_90(W, P)
    if np.isnan(T.time_stem):
        T.drift = max(T.drift, abs(y[7] - P.a * L3 - T.C_J))
    if y[12] >= T.since:
        theta = 2 * np.arctan2(np.hypot(y[0], y[1]), np.hypot(y[2], y[3]))
        T.least, T.most = min(T.least, theta), max(T.most, theta)
        T.seen |= 1 << carried(ball, stem)
        if ball not in (OPEN, STICK) or stem not in (OPEN, STICK) or (ball == OPEN and stem == OPEN):
            T.slips = 1


@compiled
def passes_90(W: Record, P: Record) -> float:
    """When e_z = 0 in the last step, by the cubic through it and e_z' = (w x e)_z at both ends, and bisection."""
    z, y = W.step.z, W.y
    (e, w, _), (e1, w1, _), h = turning(z, P), turning(y, P), y[12] - z[12]
    rate, rate1 = (w[0] * e[1] - w[1] * e[0]) * h, (w1[0] * e1[1] - w1[1] * e1[0]) * h
    low, high = 0.0, 1.0
    for _ in range(50):
        x = (low + high) / 2
        across = e1[2] - e[2]
        now = e[2] + x * across + x * (1 - x) * ((rate - across) * (1 - x) - (rate1 - across) * x)
        if now * e[2] > 0.0:
            low = x
        else:
            high = x
    return z[12] + high * h
