"""Periodic rolling. Once Coulomb friction makes the ball roll and a whole nutation has passed without an event, every
later nutation is the same one, rotated by the same angle about the vertical and displaced: whole nutations are
skipped."""

import numpy as np

from ..compiled import compiled
from ..paper.search import zero
from ..types import Array
from . import at
from .events import happens
from .kinds import Event
from .poses import continue_angles, tilt_of
from .records import NO_ONE, SAMPLE, Record
from .run import ENDED, HANDS_OVER, MORE, OVER, follow, run
from .stepper import at_share, densely
from .summary import up_rate, up_rate_at


def run_all(W: Record, P: Record, log: Array, end: float, flies: bool, steps: int) -> int:
    """Like run(), without samples, and skipping repeated nutations: OVER, MORE or ENDED."""
    limit, none, rows = W.steps + steps, np.zeros(0), np.zeros(0, SAMPLE)
    exact = P.delta == 0.0 and P.drag == 0.0
    while True:
        status = run(W, P, log, none, rows, end, flies, exact, limit - W.steps)
        if status != HANDS_OVER:
            return status
        event = nutate(W, P, log, none, rows, end, limit)
        if event[0] == OVER or event[0] == MORE:
            return event[0]
        if happens(W, P, log, event, flies):
            return ENDED


@compiled
def nutate(W: Record, P: Record, log: Array, none: Array, rows: Array, end: float, limit: int) -> Event:
    """Rolls like follow(); from the second maximum of theta on by whole nutations."""
    first, second, least, T, passed = np.zeros(6), np.zeros(6), np.zeros(6), W.summary, 0
    while passed < 2:
        before = up_rate(W.y, P)
        event = follow(W, P, log, none, rows, end, min(limit, W.steps + 1))
        if event[0] != MORE or W.steps >= limit:
            return event
        if before < 0.0 <= up_rate(W.y, P):
            turns(W, P, second)
            passed += 1
            if passed == 1:
                first[:] = second
        elif passed and up_rate(W.y, P) < 0.0 <= before:
            turns(W, P, least)
    period = second[0] - first[0]
    whole = end - T.since >= period  # the last part of the time contains a whole nutation
    if skip(W.y, W.angles, first, second, end if whole else T.since) and whole:
        T.least, T.most, T.seen = min(T.least, least[5]), max(T.most, second[5]), T.seen | 2
    W.rated = 0
    return follow(W, P, log, none, rows, end, limit)


def turns(W: Record, P: Record, out: Array) -> None:
    """Writes (t, phi, psi, x, y, theta) at a maximum or minimum of theta in the last step into out."""
    S, angles = W.step, W.angles.copy()
    densely(W, P, NO_ONE, S.new[at.TIME] - S.z[at.TIME])
    at_share(W, P, zero(up_rate_at, 0.0, 1.0, (W, P)), S.at)
    continue_angles(S.at, angles)
    out[0], out[1], out[2] = S.at[at.TIME], angles[0] + angles[1], angles[0] - angles[1] + S.at[at.CHI]
    out[3], out[4] = S.at[at.X], S.at[at.Y]
    out[5] = tilt_of(S.at)


def skip(y: Array, angles: Array, first: Array, second: Array, end: float) -> bool:
    """Advances y by as many whole nutations, like that from first to second, as fit before end; returns whether any do.

    Each maps the horizontal position G_h of G, as a complex number, to turn G_h + moves, turn = exp i(advance of phi).
    """
    n = np.floor((end - y[at.TIME]) / (second[0] - first[0]))
    if n < 1.0:
        return False
    phi, psi = second[1] - first[1], second[2] - first[2]
    turn, turns = complex(np.cos(phi), np.sin(phi)), complex(np.cos(n * phi), np.sin(n * phi))
    moves = complex(second[3], second[4]) - turn * complex(first[3], first[4])
    G = turns * complex(y[at.X], y[at.Y]) + moves * ((turns - 1) / (turn - 1) if abs(turn - 1) > 1e-9 else n)
    y[at.X], y[at.Y] = G.real, G.imag
    for i in (at.LX, at.VX):
        across = turns * complex(y[i], y[i + 1])
        y[i], y[i + 1] = across.real, across.imag
    c, s = np.cos(n * phi / 2), np.sin(n * phi / 2)
    y[at.PX], y[at.PY], y[at.PZ], y[at.PW] = (
        c * y[at.PX] - s * y[at.PY],
        c * y[at.PY] + s * y[at.PX],
        c * y[at.PZ] + s * y[at.PW],
        c * y[at.PW] - s * y[at.PZ],
    )
    angles[0] += n * phi / 2
    angles[1] += n * phi / 2
    y[at.CHI] += n * psi
    y[at.TIME] += n * (second[0] - first[0])
    return True
