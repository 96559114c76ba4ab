"""What a motion conserves from its start until each later moment: energy, Jellett's and Routh's constants, spin."""

import numpy as np
from numpy.typing import NDArray

from app.model.life import pushed_rows
from app.model.run import TableMotion, every_other
from tippe_core import Constants
from tippe_core.types import Array

KINDS = ("kept", "swings", "nearly", "zero", "lost", "gripped")
"""How far a quantity is conserved; zero: its sign has changed; gripped: it changed when a table gripped the top, and is
conserved since."""
ROUNDING, TURNED = 1e-6, 0.05  # relative to the largest value so far
# Less than a quarter has gone; the page says so. Rubbing while a toy turns over takes one or two hundredths of
# Jellett's constant, but half of the energy, and turns Routh's around; later pivoting on the stem uses up Jellett's.
NEARLY = 0.25
BACK = 0.01  # of its range: what comes back by less only grows, or only falls
TREND = 0.2  # relative to the range of the values
_least, _most = np.minimum.accumulate, np.maximum.accumulate


def keeps(motion: TableMotion) -> Array:
    """Rows (n, 13) over a motion: t (s), and for the energy (mm), Jellett's constant (divided by I1), Routh's and the
    spin (rev/s) how far it is conserved from the given start, before any table grips it, or from the last push, until
    then, an index of KINDS, and two numbers: the first and the present one, or the least and the largest so far if it
    swings."""
    moved, scales, start = motion.trajectory, motion.start.scales, motion.start.state
    length, turns = 1e3 * scales.R, motion.start.turns
    energy, rest = length * (moved.ledger.kinetic + moved.com[:, 2]), length * (1 - abs(moved.top.a))
    pushed = pushed_rows(moved)
    constants = Constants.from_state(moved.top, start.theta, start.theta_dot, start.omega2, start.omega3)
    # friction can only take energy, so whatever is gone is heat, however little
    lost = _from_pushes(pushed, energy - rest, float(energy[0] - rest + length * motion.lost), 0.0, swings=False)
    lost[:, 1:] += rest
    found = [
        _from_pushes(pushed, values, float(first))
        for values, first in (
            (moved.jellett / moved.top.I1, constants.K_J),
            (moved.routh, constants.K_R),
            (turns * moved.omega[:, 2], turns * start.omega3),
        )
    ]
    rows = np.column_stack([motion.seconds, lost, *found])
    return rows[every_other(len(rows), pushed)]


def while_it_turns(motion: TableMotion) -> tuple[float, float, float] | None:
    """Until when (s) only the ball of a top that slips and turns over carries it, and Jellett's constant at the start
    and then, if it is nearly conserved so long and nothing pushes it; else None."""
    until = None if motion.pushes else motion.touches
    if motion.table != "ordinary" or until is None or not any(phase.kind == "over" for phase in motion.phases):
        return None
    values = motion.trajectory.jellett / motion.trajectory.top.I1
    last = float(values[motion.seconds <= until][-1])  # the touch itself changes it
    return (until, float(values[0]), last) if abs(last - values[0]) < NEARLY * abs(values[0]) else None


def kinds(values: Array, nearly: float = NEARLY, *, swings: bool = True) -> NDArray[np.intp]:
    """How far a quantity is conserved from its first value to each: indices of KINDS. What swings about a mean over the
    whole motion does so from its start. nearly: the relative change below which it is nearly conserved; swings: whether
    it can."""
    most, spread = np.maximum.accumulate(np.abs(values)), _most(values) - _least(values)
    found = np.where(np.abs(values - values[0]) < nearly * most, KINDS.index("nearly"), KINDS.index("lost"))
    found[(np.abs(values) > TURNED * most) & (values * values[0] < 0)] = KINDS.index("zero")
    early, late = (float(half.mean()) if len(half) else np.inf for half in np.array_split(values, 2))
    steps = np.diff(values)
    back = min(steps[steps > 0].sum(), -steps[steps < 0].sum()) > BACK * spread[-1]
    if swings and back and abs(late - early) < TREND * spread[-1] and spread[-1] < nearly * most[-1]:
        found[:] = KINDS.index("swings")
    found[spread <= ROUNDING * most] = KINDS.index("kept")
    return found


def _from_pushes(pushed: list[int], values: Array, first: float, *nearly: float, swings: bool = True) -> Array:
    """_told() from the start, and anew from each of the rows just after a push."""
    parts = np.split(values, pushed)
    firsts = [first, *(float(part[0]) for part in parts[1:])]
    return np.concatenate([_told(part, one, *nearly, swings=swings) for part, one in zip(parts, firsts, strict=True)])


def _told(values: Array, first: float, nearly: float = NEARLY, *, swings: bool = True) -> Array:
    """Columns: the kind and two numbers, for a quantity that was `first` at the given start."""
    jumped = abs(values[0] - first) > ROUNDING * max(abs(values[0]), abs(first))
    all_values = np.concatenate([[first], values]) if jumped else values
    found = kinds(all_values, nearly, swings=swings and not jumped)[-len(values) :]
    if jumped and set(kinds(values, nearly, swings=False)) == {KINDS.index("kept")}:
        found[:] = KINDS.index("gripped")
    swing = found == KINDS.index("swings")
    start = np.where(swing, _least(values), all_values[0])
    return np.column_stack([found, start, np.where(swing, _most(values), values)])
