"""Computes anew from how many turns a second on each known top stands turned over, and stores it: least_spins.json."""

import json

from app.model.arrival import MU, TILT
from app.model.families.known_tops import FILE, known_tops
from app.model.lab.ends import SPINS, ends_of
from app.model.setup import start_of


def least(name: str) -> float | None:
    """The least of SPINS with which a top, let go like the arrival's, comes to stand turned over; None if none does."""
    codes = ends_of(start_of(name, 0.0, TILT, MU)).codes
    return next((float(spin) for spin, code in zip(SPINS, codes, strict=True) if code in ("stands", "inverted")), None)


if __name__ == "__main__":
    names = [top.name for top in known_tops() if top.limits.group == "can invert"]
    FILE.write_text(json.dumps({name: least(name) for name in names}, indent=1) + "\n", encoding="utf-8")
