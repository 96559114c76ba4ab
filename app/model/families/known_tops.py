"""The tops with a name as points on the map of all tops, where a/R and I1/I3 decide which of them can turn over."""

import json
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np

from app.model.bodies import body
from app.model.build.builder import thrown
from app.model.families.family import Region, region
from app.model.scene import Scene
from app.model.setup import TOYS
from tippe_core import PRESETS, Thresholds, Top, thresholds
from tippe_core.types import Array

SAME = 5e-4  # in a/R and I1/I3: tops that are closer share one point


FILE = Path(__file__).with_name("least_spins.json")
"""Written by python -m app.model.families; a test computes one anew."""


@cache
def _least_spins() -> dict[str, float | None]:
    found: dict[str, float | None] = json.loads(FILE.read_text(encoding="utf-8"))
    return found


@dataclass(frozen=True, eq=False, kw_only=True)
class KnownTop:
    """A top with a name. outline (n, 2): the radius and the height of its surface, in R. turn: rev/s in one
    (g/R)^1/2."""

    name: str
    top: Top
    outline: Array
    turn: float

    @property
    def ratio(self) -> float:
        return self.top.I1 / self.top.I3

    @property
    def limits(self) -> Thresholds:
        return thresholds(self.top)

    @property
    def stands_from(self) -> float:
        """The least spin (rev/s) with which, in runs let go like the arrival's, it comes to stand turned over; nan if
        none was made."""
        return _least_spins().get(self.name) or np.nan

    @property
    def bound(self) -> float:
        """The spin (rev/s) below which an upright top on a point behaves as it does at rest; nan if no spin makes a
        difference."""
        limits = self.limits
        spins = [limits.upright.spin, limits.launch] if limits.group == "can invert" else [limits.upright.spin]
        return max(spins) * self.turn

    def shown(self, mu_s: float) -> Region:
        """Its Figs. 5 and 6, with the spin that a new body is given."""
        return region(self.name, self.top, thrown(TOYS[self.name].shape, self.top)[1], mu_s)


@cache
def known_tops() -> tuple[KnownTop, ...]:
    """One top for each point of the map: the first of the presets there."""
    found: list[KnownTop] = []
    for preset in PRESETS:
        turn = preset.shape.scales.angular_velocity / (2 * np.pi)
        top = KnownTop(name=preset.name, top=preset.top, outline=body(preset.shape), turn=turn)
        if not any(_same(top.top, other.top) for other in found):
            found.append(top)
    return tuple(found)


def known_of(scene: Scene) -> KnownTop | None:
    """The known top of a Scene."""
    return next((each for each in known_tops() if _same(each.top, scene.top)), None)


def _same(one: Top, other: Top) -> bool:
    return abs(one.a - other.a) < SAME and abs(one.I1 / one.I3 - other.I1 / other.I3) < SAME
