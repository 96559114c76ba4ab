"""Definition of a map: two quantities of a sliding top across and up, all others fixed, and one run in each cell.

Values are in rev/s, degrees, s and mm; a/R and I1/I3 are dimensionless. The runs are in units of R, M and g.
"""

from collections.abc import Iterable
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from typing import Any, NamedTuple

import numpy as np

from app.model.scene import Scene
from app.model.setup import TOYS, by_hand
from tippe_core import PRESETS, Contensou, Coulomb, Friction, Scales, SmoothedCoulomb, State, Top, TopError, Viscous
from tippe_core.types import Array, Rim

OWN = ""  # the name that stands for a body that is not one of tippe_core.PRESETS
LAWS = ("coulomb", "viscous", "smoothed", "contensou")
COLOURS_BY = ("end", "time_90", "theta_end", "F_z_least", "flew", "heat", "hops", "growth")
MOST_CELLS, MOST_SECONDS = 96, 60.0
MOST_WORK = 48 * 48 * 60.0  # s in all cells: some ten times a usual map, or 96 x 96 cells of 15 s
FIRST = 8  # cells along each side of the first, coarse level
NUDGE = 1e-6  # rad


class Quantity(NamedTuple):
    """A quantity that can be an axis: its possible range, and the range that is shown first."""

    least: float
    most: float
    low: float
    high: float
    unit: str


QUANTITIES = {
    "spin": Quantity(-300.0, 300.0, 5.0, 50.0, "rev/s"),
    "tilt": Quantity(0.0, 180.0, 1.0, 40.0, "°"),
    "mu": Quantity(0.001, 2.0, 0.05, 0.6, ""),
    "second": Quantity(0.0, 5.0, 0.1, 2.0, ""),
    "slip": Quantity(0.0, 2.0, 0.0, 1.0, ""),
    "a": Quantity(-5.0, 0.95, 0.02, 0.4, ""),
    "ratio": Quantity(0.5, 5.0, 0.7, 1.5, ""),
    "R": Quantity(0.5, 500.0, 8.0, 30.0, "mm"),
    "stem": Quantity(0.0, 1000.0, 10.0, 25.0, "mm"),
    "rounding": Quantity(0.0, 100.0, 1.0, 8.0, "mm"),
}
OF_BODY = {"a", "ratio", "R", "stem", "rounding"}
"""Those of the body; a run of another one is none of the Lab's."""
SECONDS = {"coulomb": "mu_s", "viscous": "", "smoothed": "eps", "contensou": "radius"}
"""{law: what its second parameter is}: static friction; a speed in (gR)^1/2; the radius of the patch in mm."""
UNITS = {"theta_end": "°", "time_90": "s", "time_stem": "s", "hops": "", "flew": "", "F_z_least": "Mg", "heat": "MgR",
         "energy_error": "MgR", "C_J_drift": "", "growth": ""}  # fmt: skip


class Body(NamedTuple):
    """The sliding body: its Top, its R, M and g, and the edge of its stem."""

    top: Top
    scales: Scales
    edge: Rim | None


@cache
def of_preset(name: str) -> Body:
    """The Body of tippe_core.PRESETS with this name."""
    preset = TOYS[name]
    return Body(preset.top, preset.shape.scales, preset.shape.edge)


def of_page(scene: Scene) -> tuple[str, Body | None]:
    """(body, own) of a Map of the page's top: the name of its preset, or OWN and the Body."""
    for preset in PRESETS:
        if preset.shape == scene.shape and preset.top == scene.top:
            return preset.name, None
    return OWN, Body(scene.top, scene.scales, scene.shape.edge if scene.shape else None)


@dataclass(frozen=True, kw_only=True)
class Map:
    """Everything on which a map depends. body: the name of a preset, or OWN for the Body `own`. values: the values of
    QUANTITIES; those of the two axes are ignored. stem is the height of the end of the stem above O; it moves the edge
    but does not change the mass. nudged: whether each cell is run a second time, tilted by NUDGE more.

    Raises TopError for impossible values.
    """

    body: str = "Leine and Glocker's toy"
    own: Body | None = None
    across: str = "spin"
    up: str = "tilt"
    across_range: tuple[float, float] = (5.0, 50.0)
    up_range: tuple[float, float] = (1.0, 40.0)
    law: str = "contensou"
    values: tuple[tuple[str, float], ...] = ()
    seconds: float = 6.0
    cells: int = 48
    nudged: bool = False
    rtol: float = 1e-6

    def __post_init__(self) -> None:
        if self.law not in LAWS:
            raise TopError("law", self.law, ", ".join(LAWS))
        if self.across == self.up:
            raise TopError("up", self.up, f"!= {self.across}")
        for name, (low, high) in zip((self.across, self.up), (self.across_range, self.up_range), strict=True):
            self._check_possible(name)
            for value in (low, high):
                _check(name, value)
            if not low < high:
                raise TopError(f"{name}_from", low, f"{name}_from < {name}_to = {high:g}")
        for name, value in self.values:
            _check(name, value)
        if not 0 < self.seconds <= MOST_SECONDS:
            raise TopError("seconds", self.seconds, f"0 < seconds <= {MOST_SECONDS:g} (s)")
        if self.cells not in range(3, MOST_CELLS + 1, 3):
            raise TopError("cells", self.cells, f"3, 6, 9, ... {MOST_CELLS}")
        if self.cells**2 * self.seconds > MOST_WORK:
            most = 3 * int((MOST_WORK / self.seconds) ** 0.5 / 3)
            raise TopError("cells", self.cells, f"3, 6, 9, ... {most}")

    def _check_possible(self, name: str) -> None:
        if name not in QUANTITIES:
            raise TopError("axis", name, ", ".join(QUANTITIES))
        if name in ("stem", "rounding") and self.thing.edge is None:
            raise TopError(name, self.body, "r > 0", code="half-a-stem")
        if name == "second" and not SECONDS[self.law]:
            raise TopError("law", self.law, ", ".join(law for law, second in SECONDS.items() if second))

    @property
    def thing(self) -> Body:
        """The sliding body."""
        return self.own or of_preset(self.body or Map.body)  # of a link until the page's top is known: any

    @property
    def start(self) -> dict[str, float]:
        """{name: value} of all QUANTITIES, for the body as it is."""
        top, scales, edge = self.thing
        R = 1e3 * scales.R
        second = {"contensou": 0.5, "smoothed": 0.1, "coulomb": 0.3, "viscous": 0.0}[self.law]
        stem = (edge[1] + edge[2]) * R if edge else 0.0
        own = {"spin": 28.6, "tilt": 5.7, "mu": 0.3, "second": second, "slip": 1.0, "a": top.a,
               "ratio": top.I1 / top.I3, "R": R, "stem": stem, "rounding": edge[2] * R if edge else 0.0}  # fmt: skip
        return own | dict(self.values)

    def levels(self) -> tuple[int, ...]:
        """Cells along each side, from coarse to fine; the centre of each cell of the second level is that of one in
        nine cells of the third."""
        third = self.cells // 3
        return (*((FIRST,) if third > FIRST else ()), *((third,) if self.cells > FIRST else ()), self.cells)

    def centres(self, n: int) -> tuple[Array, Array]:
        """The centres of n cells across, and of n cells up."""
        part = (np.arange(n) + 0.5) / n
        (left, right), (bottom, top) = self.across_range, self.up_range
        return left + (right - left) * part, bottom + (top - bottom) * part

    def at(self, across: float, up: float) -> "Cell":
        """The Cell at these values of the axes."""
        return Cell.of(self, self.values_at(across, up))

    def values_at(self, across: float, up: float) -> dict[str, float]:
        """{name: value} of all QUANTITIES there."""
        return self.start | {self.across: float(across), self.up: float(up)}


class Cell(NamedTuple):
    """One run, as slide() takes it; t_end in (R/g)^1/2."""

    top: Top
    scales: Scales
    edge: Rim | None
    state: State
    friction: Friction
    t_end: float

    @classmethod
    def of(cls, request: Map, x: dict[str, float]) -> "Cell":
        """The Cell for these values of QUANTITIES; TopError if they are impossible."""
        own, mine, _ = request.thing
        top = own if not {"a", "ratio"} & {request.across, request.up} else Top(x["a"], x["ratio"] * own.I3, own.I3)
        scales = Scales(x["R"] / 1e3, mine.M, mine.g)
        state = by_hand(x["spin"], x["tilt"], x["slip"], scales)
        return cls(top, scales, _edge(request, x), state, _law(request.law, x, scales), request.seconds / scales.time)


def _edge(request: Map, x: dict[str, float]) -> Rim | None:
    """The edge of the stem, in R of the original body; its lengths grow with R unless they are on an axis."""
    edge = request.thing.edge
    if edge is None or not {"stem", "rounding"} & {request.across, request.up}:
        return edge
    own = 1e-3 / request.thing.scales.R
    return edge[0], (x["stem"] - x["rounding"]) * own, x["rounding"] * own


def _law(law: str, x: dict[str, float], scales: Scales) -> Friction:
    if law == "coulomb":
        return Coulomb(x["mu"], max(x["second"], x["mu"]))  # static friction is the larger one
    if law == "viscous":
        return Viscous(x["mu"])
    if law == "smoothed":
        return SmoothedCoulomb(x["mu"], x["second"])
    return Contensou(x["mu"], x["second"] / 1e3 / scales.R)


def cells_of(request: Map, places: Iterable[tuple[float, float]]) -> dict[int, Cell]:
    """{index of a place: its Cell} of those places that are possible."""
    found = {}
    for i, (across, up) in enumerate(places):
        with suppress(TopError):
            found[i] = request.at(across, up)
    return found


def _check(name: str, value: Any) -> None:
    quantity = QUANTITIES[name]
    if not quantity.least <= value <= quantity.most:
        unit = f" ({quantity.unit})" if quantity.unit else ""
        raise TopError(name, value, f"{quantity.least:g} <= {name} <= {quantity.most:g}{unit}")


# Three in four of its runs are decided, that of the arrival too: fewer within 3.5 or 4.5 s, and below 20 rev/s hardly
# any before 20 s, when all that stood on their stems roll again.
AT_FIRST = Map(across_range=(20.0, 50.0), up_range=(1.0, 30.0), seconds=4.0)
