"""One step of the Dormand-Prince method of order 8 (Hairer, Norsett and Wanner, Solving Ordinary Differential Equations
I, II.5 and II.6, DOP853), its dense output of order 7, and roots within a step.

It solves dz/dtau = rates(z) of dynamics.py; impact.py uses the same coefficients, which are those of scipy's DOP853.
"""

import numpy as np
from scipy.integrate import DOP853

from ..paper.search import zero
from ..types import Array
from . import at
from .dynamics import from_direction, rates
from .records import Record, modes_of

A, B, E3, E5 = (np.ascontiguousarray(table) for table in (DOP853.A, DOP853.B, DOP853.E3, DOP853.E5))
A_DENSE, D = np.ascontiguousarray(DOP853.A_EXTRA), np.ascontiguousarray(DOP853.D)
STAGES, ORDER = 12, 8
SAFETY, LEAST_FACTOR, MOST_FACTOR = 0.9, 0.2, 10.0


def stage(z: Array, K: Array, weights: Array, count: int, h: float, out: Array) -> None:
    """Writes z + h sum_j weights_j K_j into out."""
    n = len(z)
    for i in range(n):
        out[i] = 0.0
    for j in range(count):
        weight = weights[j]
        if weight != 0.0:
            for i in range(n):
                out[i] += weight * K[j, i]
    for i in range(n):
        out[i] = z[i] + h * out[i]


def error(K: Array, scale: Array, h: float) -> float:
    """The estimated error of a step relative to the scales: |h| e5^2/(e5^2 + e3^2/100)^1/2, e5 and e3 root mean
    squares."""
    n, fifth, third = len(scale), 0.0, 0.0
    for i in range(n):
        e5 = e3 = 0.0
        for j in range(STAGES + 1):
            e5 += E5[j] * K[j, i]
            e3 += E3[j] * K[j, i]
        fifth += (e5 / scale[i]) ** 2
        third += (e3 / scale[i]) ** 2
    if fifth == 0.0 and third == 0.0:
        return 0.0
    return abs(h) * fifth / np.sqrt((fifth + 0.01 * third) * n)


def factor(found: float, order: int) -> float:
    """The factor by which to change h after a step with this ratio of its error, of this order, to the allowed one."""
    if not np.isfinite(found):
        return LEAST_FACTOR
    return min(MOST_FACTOR, max(LEAST_FACTOR, SAFETY * max(found, 1e-12) ** (-1 / order)))


def steady_direction(W: Record, P: Record, slowest: int) -> tuple[float, float, float]:
    """The steady beta near that of step.at, at which u' is parallel to u; the rates at which beta relaxes to it and at
    which log|u| grows."""
    S, C, modes = W.step, W.contacts, modes_of(W)
    beta, out, near = S.at[at.BETA], S.K[15], 1e-4
    for _ in range(3):
        S.at[at.BETA] = beta + near
        rates(S.at, slowest, modes, P, C, out)
        beside = out[at.BETA]
        S.at[at.BETA] = beta
        rates(S.at, slowest, modes, P, C, out)
        attracts = (out[at.BETA] - beside) / near
        if attracts <= 0.0 or abs(out[at.BETA]) > attracts:
            return S.at[at.BETA], 0.0, out[at.LOG_U]
        beta += out[at.BETA] / attracts
        if abs(out[at.BETA]) < 1e-12 * attracts:
            break
    return beta, attracts, out[at.LOG_U]


def steady_rates(W: Record, P: Record, slowest: int, s: int) -> float:
    """Writes the rates at step.at into step.K[s], where beta is kept steady: those at its steady value."""
    S = W.step
    S.at[at.BETA] = steady_direction(W, P, slowest)[0]
    minor = rates(S.at, slowest, modes_of(W), P, W.contacts, S.K[s])
    S.K[s, at.BETA] = 0.0
    return minor


def densely(W: Record, P: Record, slowest: int, h: float) -> None:
    """Computes the polynomial (dense output) of the step from step.z to step.new, whose stages are in step.K.
    That of an implicit step is there already."""
    if W.implicit:
        return
    S, K, F = W.step, W.step.K, W.step.polynomial
    for s in range(3):
        stage(S.z, K, A_DENSE[s], STAGES + 1 + s, h, S.at)
        if W.steady:  # otherwise beta diverges, and log|u| with it
            steady_rates(W, P, slowest, STAGES + 1 + s)
        else:
            rates(S.at, slowest, modes_of(W), P, W.contacts, K[STAGES + 1 + s])
    for i in range(16):
        moved = S.new[i] - S.z[i]
        F[0, i], F[1, i], F[2, i] = moved, h * K[0, i] - moved, 2 * moved - h * (K[STAGES, i] + K[0, i])
        for m in range(4):
            total = 0.0
            for j in range(16):
                total += D[m, j] * K[j, i]
            F[3 + m, i] = h * total


def within(S: Record, x: float, i: int) -> float:
    """Component i of the polynomial at the fraction x of the step."""
    total = 0.0
    for m in range(6, -1, -1):
        total = (total + S.polynomial[m, i]) * (x if m % 2 == 0 else 1 - x)
    return S.z[i] + total


def at_share(W: Record, P: Record, x: float, out: Array) -> None:
    """Writes the polynomial at the fraction x of the step into out."""
    S = W.step
    for i in range(16):
        out[i] = within(S, x, i)
    if W.implicit:
        from_direction(out, S.creeps, S.unit, P, W.contacts)


def at_end(W: Record, P: Record, share: float) -> None:
    """Writes the end of the step, or of its part up to the fraction share, into step.at."""
    if share == 1.0:
        W.step.at[:] = W.step.new
    else:
        at_share(W, P, share, W.step.at)


def lateness(x: float, S: Record, t: float) -> float:
    """How long after t the time at the fraction x of the step is."""
    return within(S, x, at.TIME) - t


def when(S: Record, t: float) -> float:
    """The fraction of the step at which the time is t."""
    return zero(lateness, 0.0, 1.0, (S, t))
