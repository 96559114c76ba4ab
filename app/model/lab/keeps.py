"""What a motion conserves from its start to its end: energy, Jellett's and Routh's constants, spin, in words and
numbers."""

from typing import NamedTuple

import numpy as np

from app.model.lab.run import TableMotion
from app.text import say
from tippe_core.types import Array

ROUNDING, NEARLY, TURNED = 1e-6, 0.25, 0.05  # relative to the largest value
TREND = 0.2  # relative to the range of the values
DIGITS = 5  # decimals, at most


class Row(NamedTuple):
    """One quantity: its name, how far it is conserved ("full", "half" or "empty"), the same in a word, and the
    numbers."""

    name: str
    mark: str
    word: str
    text: str


def keeps(motion: TableMotion) -> tuple[Row, ...]:
    """The Rows of a motion from its start to its end; the start is before the rough table grips it, except for the
    energy."""
    moved, curves, top = motion.trajectory, motion.curves, motion.start.top
    return (
        _row("energy", curves[:, 3].astype(float), 0, say("lab.keeps.millimetres")),
        _row("jellett", moved.jellett / top.I1, 2, ""),
        _row("routh", moved.routh, 2, ""),
        _row("spin", curves[:, 5].astype(float), 1, say("lab.keeps.turns")),
    )


def kind_of(values: Array) -> tuple[str, str]:
    """How far it is conserved, and the key of its word: "kept", "swings", "nearly", "zero" (its sign has changed) or
    "lost"."""
    most, spread = float(np.abs(values).max()), float(np.ptp(values))
    first, last = values[0], values[-1]
    if spread <= ROUNDING * most:
        return "full", "kept"
    if abs(last) > TURNED * most and first * last < 0:
        return "empty", "zero"
    early, late = (float(half.mean()) for half in np.array_split(values, 2))
    if abs(late - early) < TREND * spread and spread < NEARLY * most:
        return "half", "swings"
    return ("half", "nearly") if abs(last - first) < NEARLY * most else ("empty", "lost")


def _row(name: str, values: Array, digits: int, unit: str) -> Row:
    mark, kind = kind_of(values)
    word = {("energy", "lost"): "heat", ("spin", "zero"): "reversed"}.get((name, kind), kind)
    ends = values[:1] if kind == "kept" else values[[0, -1]]
    if kind == "swings":
        ends = np.array([values.min(), values.max()])
    while len(ends) == 2 and digits < DIGITS and f"{ends[0]:.{digits}f}" == f"{ends[1]:.{digits}f}":
        digits += 1
    said = [f"{value:.{digits}f}".replace("-", "−") for value in ends]
    form = {1: "one"}.get(len(said), "range" if kind == "swings" else "two")
    return Row(say(f"lab.keeps.{name}"), mark, say(f"lab.keeps.{word}"),
               say(f"lab.keeps.{form}", first=said[0], last=said[-1], unit=unit))  # fmt: skip
