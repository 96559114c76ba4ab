"""What a motion conserves from its start until each later moment: energy, Jellett's and Routh's constants, spin."""

import numpy as np
from numpy.typing import NDArray

from app.model.lab.run import STEP, TableMotion
from tippe_core.types import Array

KINDS = ("kept", "swings", "nearly", "zero", "lost")
"""How far a quantity is conserved; zero: its sign has changed."""
ROUNDING, TURNED = 1e-6, 0.05  # relative to the largest value so far
# Less than a quarter has gone; the page says so. Rubbing while a toy turns over takes one or two hundredths of
# Jellett's constant, but half of the energy, and turns Routh's around; later pivoting on the stem uses up Jellett's.
NEARLY = 0.25
TREND = 0.2  # relative to the range of the values


def keeps(motion: TableMotion) -> Array:
    """Rows (n, 13) over a motion: t (s), and for the energy (mm), Jellett's constant (divided by I1), Routh's and the
    spin (rev/s) how far it is conserved from the start until then, an index of KINDS, and two numbers: the first and
    the present one, or the least and the largest so far if it swings. On the rough table the start is after the
    grip."""
    moved, scales = motion.trajectory, motion.start.scales
    energy = 1e3 * scales.R * (moved.ledger.kinetic + moved.com[:, 2])
    turns = scales.angular_velocity / (2 * np.pi) * moved.omega[:, 2]
    # friction can only take energy, so whatever is gone is heat, however little
    found = _told(energy, 0.0), _told(moved.jellett / motion.start.top.I1), _told(moved.routh), _told(turns)
    rows = np.column_stack([motion.seconds, *found])
    return rows[np.unique(np.append(np.arange(0, len(rows), STEP), len(rows) - 1))]


def kinds(values: Array, nearly: float = NEARLY) -> NDArray[np.intp]:
    """How far a quantity is conserved from its first value to each: indices of KINDS. What swings about a mean over the
    whole motion does so from its start. nearly: the relative change below which it is nearly conserved."""
    most, spread = np.maximum.accumulate(np.abs(values)), _most(values) - _least(values)
    found = np.where(np.abs(values - values[0]) < nearly * most, KINDS.index("nearly"), KINDS.index("lost"))
    found[(np.abs(values) > TURNED * most) & (values * values[0] < 0)] = KINDS.index("zero")
    early, late = (float(half.mean()) if len(half) else np.inf for half in np.array_split(values, 2))
    if abs(late - early) < TREND * spread[-1] and spread[-1] < nearly * most[-1]:
        found[:] = KINDS.index("swings")
    found[spread <= ROUNDING * most] = KINDS.index("kept")
    return found


def _told(values: Array, nearly: float = NEARLY) -> Array:
    found = kinds(values, nearly)
    swings = found == KINDS.index("swings")
    first, last = np.where(swings, _least(values), values[0]), np.where(swings, _most(values), values)
    return np.column_stack([found, first, last])


def _least(values: Array) -> Array:
    return np.minimum.accumulate(values)


def _most(values: Array) -> Array:
    return np.maximum.accumulate(values)
