"""The motion shown on arrival, stored in app/data so that it plays before anything is compiled.

    python -m app.model.arrival

recomputes it, after a change of the physics or of the start; a test compares it with a fresh run.
"""

from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np

from tippe_core import Top, Trajectory

FILE = Path(__file__).parent.parent / "data" / "arrival.npz"
TABLE, TOY, SPIN, TILT, MU = ARRIVAL = "ordinary", "Leine and Glocker's toy", 28.65, 5.73, 0.3
"""The table, the toy, its spin (rev/s: 180 rad/s), its tilt (degrees: 0.1 rad) and the friction. That it ends up
standing does not depend on the last digits of these."""
HAPPENS = "events", "supports"
NO_ROWS = "top", "notes", *HAPPENS


def write(trajectory: Trajectory, ends: tuple[str, ...]) -> None:
    """Stores a Trajectory, its numbers as float32, and the codes of Ends in lab/ends.py."""
    rows = {part.name: getattr(trajectory, part.name) for part in fields(trajectory) if part.name not in NO_ROWS}
    kept = {name: value if name == "regime" else value.astype(np.float32) for name, value in rows.items()}
    for name in HAPPENS:
        times, words = zip(*getattr(trajectory, name), strict=True)
        kept |= {f"{name}.t": np.array(times), f"{name}.what": np.array(words)}
    FILE.parent.mkdir(exist_ok=True)
    np.savez_compressed(FILE, ends=np.array(ends), **kept)


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


def main() -> None:
    # which read what is written here
    from app.model.lab.ends import ends_of
    from app.model.lab.life import lived
    from app.model.lab.run import Patience, start_of

    write(lived(start_of(TOY, SPIN, TILT, MU), Patience)[1], ends_of(TOY, TILT, MU).codes)


if __name__ == "__main__":
    main()
