"""The table of what a run keeps, held against its samples: the spin, and the energy while the ball carries the top."""

import re

import numpy as np
from story_said import differs, energy, number
from story_words import N, minus_zero_in

CHANGES = re.compile(rf"^(?P<word>[^:]*): {N}(?: (?P<how>→|–) {N})?")
KEPT, QUARTER, LITTLE = 2e-3, 0.25, 1e-4


def faults(run, rows, given):
    """[(kind, why)] of rows {quantity: text}. given: a Run that no table grips, which starts as it was let go."""
    bad = []
    for quantity, text in rows.items():
        if minus_zero_in(text):
            bad.append(("kept: minus zero", f"{quantity}: {text}"))
        found = CHANGES.match(text)
        values = {"spin": spin, "energy": energies}.get(quantity.lower(), lambda *_: None)(run, given)
        if found and values is not None and len(values):
            bad += [(f"kept: {quantity}", f"{text!r}: {why}") for why in _row(quantity, found, values) if why]
    return bad


def spin(run, given):
    """The spin as it was let go and in the samples, rev/s."""
    return np.r_[given.spin[:1], run.spin]


def energies(run, given):
    """The energy, MgR; None if something but the ball carries the top at the start or the end."""
    if given.support[0] != "ball" or run.support[-1] != "ball":
        return None
    return np.r_[energy(given)[:1], energy(run)]


def _row(quantity, found, values):
    """What is false of: word: first, word: first -> last, or word: least - most."""
    first, last, word, size = values[0], values[-1], found["word"], np.max(np.abs(values))
    says = [one for one in (found[2], found[4]) if one]
    if found["how"] == "–":
        numbers = [np.min(values), np.max(values)]
    else:
        numbers = [first, last][: len(says)]
    if quantity.lower() == "energy":  # in mm: only their ratio is known
        (begins, half), (ends, _) = number(says[0]), number(says[-1])
        if len(says) > 1:
            ratio, allowed = numbers[-1] / numbers[0], 2 * half / begins + 2e-3
            yield abs(ends / begins - ratio) > allowed and f"the ratio is {ratio:.4f}"
    else:
        yield from (differs(text, (value, value)) for text, value in zip(says, numbers, strict=True))
    gone = abs(first - last)
    yield (
        word == "kept" and np.ptp(values) > KEPT * size and f"it goes from {np.min(values):.4g} to {np.max(values):.4g}"
    )
    yield word == "nearly kept" and gone > (QUARTER + 0.01) * abs(first) and "more than a quarter has gone"
    yield word == "lost" and abs(last) > abs(first) + KEPT * size and "it has grown"
    yield word == "through zero" and np.min(values) * np.max(values) >= 0 and "it has one sign"
    yield word.startswith("lost when gripped") and np.ptp(values[1:]) > KEPT * size and "it changes later"
    back = min(np.sum(np.maximum(np.diff(values), 0)), np.sum(np.maximum(-np.diff(values), 0)))
    yield "swings" in word and back < LITTLE * np.ptp(values) and "it only grows, or only falls"
