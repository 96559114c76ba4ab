"""The motion shown on arrival, stored in app/data so that it plays before anything is compiled.

    python -m app.model.lab

recomputes it, after a change of the physics or of the start; a test compares it with a fresh run.
"""

from pathlib import Path
from typing import Any

import numpy as np

from tippe_core import Top, Trajectory

FILE = Path(__file__).parent.parent / "data" / "arrival.npz"
TABLE, TOY, SPIN, TILT, MU = ARRIVAL = "ordinary", "Leine and Glocker's toy", 28.65, 5.73, 0.3
"""The table, the toy, its spin (rev/s: 180 rad/s), its tilt (degrees: 0.1 rad) and the friction. That it ends up
standing does not depend on the last digits of these."""
HAPPENS = "events", "supports"


def read(top: Top) -> Trajectory:
    """The stored Trajectory, for this top."""
    with np.load(FILE) as kept:
        found: dict[str, Any] = {name: value for name, value in kept.items() if name != "ends"}
    for name in HAPPENS:
        times, words = (found.pop(f"{name}.{part}").tolist() for part in ("t", "what"))
        found[name] = tuple(zip(times, words, strict=True))
    return Trajectory(top=top, **{
        name: value.astype(float) if name not in ("regime", *HAPPENS) else value for name, value in found.items()
    })  # fmt: skip


def read_ends() -> tuple[str, ...]:
    """The codes for SPINS in lab/ends.py: how a run with each spin ends, at this tilt and friction."""
    with np.load(FILE) as kept:
        return tuple(kept["ends"].tolist())
