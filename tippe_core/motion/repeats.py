"""Rolling for good. Where Coulomb's friction holds the ball and a whole nutation passed without an event, the same
comes again and again, each time turned by the same angle about the vertical and moved on: so whole nutations are
skipped."""

import numpy as np

from ..compiled import compiled
from ..types import Array
from .dynamics import NO_ONE, turning
from .following import ENDED, MORE, OVER, ROLLS, follow
from .happening import happens, run
from .poses import turned
from .records import Record
from .stepper import at_share, densely


@compiled
def run_all(W: Record, P: Record, log: Array, end: float, steps: int) -> int:
    """As run(), without samples, flying on, and skipping what comes again: OVER, MORE or ENDED."""
    limit, none, rows = W.steps + steps, np.zeros(0), np.zeros((0, 0))
    exact = P.delta == 0.0 and P.drag == 0.0
    while True:
        event = run(W, P, log, none, rows, end, True, exact, limit - W.steps)
        if event == ROLLS:
            event = nutate(W, P, none, rows, end, limit)
            if event not in (OVER, MORE) and not happens(W, P, log, event, True):
                continue
        return event if event in (OVER, MORE) else ENDED


@compiled
def e_z_rate(y: Array, P: Record) -> float:
    """(w x e)_z"""
    e, w, _ = turning(y, P)
    return w[0] * e[1] - w[1] * e[0]


@compiled
def nutate(W: Record, P: Record, none: Array, rows: Array, end: float, limit: int) -> int:
    """Rolls on as follow() does; from the second largest theta on by whole nutations."""
    first, second, T = np.zeros(5), np.zeros(5), W.tally
    passed, least, most = 0, np.inf, -np.inf
    while passed < 2:
        before = e_z_rate(W.y, P)
        event = follow(W, P, none, rows, end, min(limit, W.steps + 1))
        if event != MORE or W.steps >= limit:
            return event
        theta = 2 * np.arctan2(np.hypot(W.y[0], W.y[1]), np.hypot(W.y[2], W.y[3]))
        least, most = min(least, theta), max(most, theta)
        if before < 0.0 <= e_z_rate(W.y, P):
            farthest(W, P, second)
            passed += 1
            if passed == 1:
                first[:] = second
    skip(W.y, W.angles, first, second, end)
    W.rated = 0
    if W.y[12] >= T.since:
        T.least, T.most, T.seen = min(T.least, least), max(T.most, most), T.seen | 2
    return follow(W, P, none, rows, end, limit)


@compiled
def farthest(W: Record, P: Record, out: Array) -> None:
    """(t, phi, psi, x, y) where theta is largest in the last step."""
    S, angles, low, high = W.step, W.angles.copy(), 0.0, 1.0
    densely(W, P, NO_ONE, S.new[12] - S.z[12])
    for _ in range(50):
        x = (low + high) / 2
        at_share(S, x, S.at)
        if e_z_rate(S.at, P) < 0.0:
            low = x
        else:
            high = x
    turned(S.at, angles)
    out[0], out[1], out[2] = S.at[12], angles[0] + angles[1], angles[0] - angles[1] + S.at[4]
    out[3], out[4] = S.at[10], S.at[11]


@compiled
def skip(y: Array, angles: Array, first: Array, second: Array, end: float) -> None:
    """y after as many whole nutations, from first to second, as there is time for.

    In each G's place G_h goes over into turn G_h + moves, in complex numbers, turn = exp i(phi's advance).
    """
    n = np.floor((end - y[12]) / (second[0] - first[0]))
    if n < 1.0:
        return
    phi, psi = second[1] - first[1], second[2] - first[2]
    turn, turns = complex(np.cos(phi), np.sin(phi)), complex(np.cos(n * phi), np.sin(n * phi))
    moves = complex(second[3], second[4]) - turn * complex(first[3], first[4])
    G = turns * complex(y[10], y[11]) + moves * ((turns - 1) / (turn - 1) if abs(turn - 1) > 1e-9 else n)
    y[10], y[11] = G.real, G.imag
    for i in (5, 8):
        across = turns * complex(y[i], y[i + 1])
        y[i], y[i + 1] = across.real, across.imag
    c, s = np.cos(n * phi / 2), np.sin(n * phi / 2)
    y[0], y[1], y[2], y[3] = c * y[0] - s * y[1], c * y[1] + s * y[0], c * y[2] + s * y[3], c * y[3] - s * y[2]
    angles[0] += n * phi / 2
    angles[1] += n * phi / 2
    y[4] += n * psi
    y[12] += n * (second[0] - first[0])
