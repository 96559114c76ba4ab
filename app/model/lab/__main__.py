"""Computes the motion of the arrival anew, and how the runs at all spins end, and stores them: app/model/arrival.py."""

from dataclasses import fields

import numpy as np

from app.model.arrival import FILE, HAPPENS, MU, SPIN, TILT, TOY
from app.model.lab.ends import ends_of
from app.model.life import lived
from app.model.setup import start_of
from tippe_core import Trajectory

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


if __name__ == "__main__":
    start = start_of(TOY, SPIN, TILT, MU)
    write(lived(start).moved, ends_of(start).codes)
