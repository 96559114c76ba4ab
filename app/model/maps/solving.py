"""Solves a Map in pieces, from coarse to fine, so that it can be stopped between two pieces; each cell is one run."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from time import perf_counter
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from app.model.maps.maps import NUDGE, UNITS, Map, cells_of
from app.model.motion import Progress
from tippe_core import Trajectory, ending, slide, slide_many
from tippe_core.types import Array, Bools

PIECE, FEWEST, MOST = 0.12, 16, 256  # duration (s) of a piece, and the range of its number of cells
GROWS = 1e3  # if a nudge grows by this factor, runs between neighbouring cells may end differently
CURVE, MOST_CURVE = 900, 2400  # samples of a run that is drawn
TURN = 1.5  # rad: the largest rotation between two of them, if possible
Ends: TypeAlias = NDArray[np.str_]


@dataclass(frozen=True, eq=False, kw_only=True)
class Level:
    """A map as far as it has been computed: end (up, across), "" for cells not yet run; columns: {a name of UNITS:
    values (up, across)} in these units, nan for the same cells."""

    request: Map
    x: Array
    y: Array
    end: Ends
    columns: dict[str, Array]

    @property
    def whole(self) -> bool:
        """Whether every cell has been run."""
        return bool((self.end != "").all())

    @property
    def finest(self) -> bool:
        """Whether this is the finest level."""
        return self.whole and len(self.x) == self.request.cells

    @property
    def mixed(self) -> Bools:
        """Where two or more of the four neighbours end differently, or a nudge grows by more than GROWS."""
        differ = np.zeros(self.end.shape, int)
        for one, other in (((slice(1, None), slice(None)), (slice(-1), slice(None))),
                           ((slice(None), slice(1, None)), (slice(None), slice(-1)))):  # fmt: skip
            unlike = (self.end[one] != self.end[other]) & (self.end[one] != "") & (self.end[other] != "")
            differ[one] += unlike
            differ[other] += unlike
        with np.errstate(invalid="ignore"):
            return ((differ >= 2) | (self.columns["growth"] > GROWS)) & (self.end != "")

    def copy(self) -> "Level":
        """A copy of the present values; solve() continues to fill the Levels that it yields."""
        return replace(self, end=self.end.copy(), columns={name: x.copy() for name, x in self.columns.items()})

    def worst(self, name: str) -> float:
        """The largest absolute value in a column; nan if it has no number."""
        sizes = np.abs(self.columns[name])
        return float(np.nanmax(sizes)) if np.isfinite(sizes).any() else np.nan

    def cell(self, across: float, up: float) -> tuple[int, int]:
        """(row, column) of the cell that contains a place."""
        return int(np.argmin(np.abs(self.y - up))), int(np.argmin(np.abs(self.x - across)))


class Found(NamedTuple):
    """The result of a single run: times in s, nan if never; theta (degrees) over t (s); film: the motion at the times
    t."""

    end: str
    time_90: float
    time_stem: float
    hops: int
    t: Array
    theta: Array
    film: Trajectory


def solve(request: Map, look: Progress | None = None) -> Iterator[Level]:
    """Yields the Level after each piece. look: called with the share that is done; an exception that it raises stops
    everything."""
    before: Level | None = None
    total, done = sum(n * n for n in request.levels()), 0
    for n in request.levels():
        level = _empty(request, n)
        if before is not None and n == 3 * len(before.x):
            level.end[1::3, 1::3] = before.end
            for name, values in level.columns.items():
                values[1::3, 1::3] = before.columns[name]
            done += len(before.x) ** 2
        left, size = np.flatnonzero(level.end.ravel() == ""), FEWEST
        while left.size:
            piece, left = left[:size], left[size:]
            began = perf_counter()
            _fill(level, piece, done / total, look)
            size = int(np.clip(size * PIECE / max(perf_counter() - began, 1e-6), max(FEWEST, size // 2), MOST))
            done += len(piece)
            yield level
        before = level


def _empty(request: Map, n: int) -> Level:
    x, y = request.centres(n)
    return Level(request=request, x=x, y=y, end=np.full((n, n), "", "<U8"),
                 columns={name: np.full((n, n), np.nan) for name in UNITS})  # fmt: skip


def _fill(level: Level, piece: NDArray[np.intp], share: float, look: Progress | None) -> None:
    request, (rows, columns) = level.request, np.divmod(piece, len(level.x))
    found = cells_of(request, zip(level.x[columns].tolist(), level.y[rows].tolist(), strict=True))
    level.end[rows, columns] = "refused"
    if not found:
        return
    tops, scales, edges, states, laws, t_end = zip(*found.values(), strict=True)
    edge = None if edges[0] is None else np.array(edges)
    told = None if look is None else lambda _: look(share)
    many = slide_many(list(tops), list(states), list(laws), np.array(t_end), edge, rtol=request.rtol,
                      nudge=NUDGE if request.nudged else None, progress=told)  # fmt: skip
    at, time = (rows[[*found]], columns[[*found]]), np.array([each.time for each in scales])
    level.end[at] = many.end
    units = {"theta_end": 180 / np.pi, "time_90": time, "time_stem": time}
    refused = many.end == "refused"
    for name, values in level.columns.items():
        values[at] = np.where(refused, np.nan, getattr(many, name) * units.get(name, 1.0))


def run(request: Map, across: float, up: float, look: Progress | None = None) -> Found:
    """The run at one place of a map, in full. TopError if there is no such run."""
    cell = request.at(across, up)
    frames = int(np.clip(abs(cell.state.omega3) * cell.t_end / TURN, CURVE, MOST_CURVE))
    times, time = np.linspace(0, cell.t_end, frames), cell.scales.time
    moved = slide(cell.top, cell.state, cell.friction, times, rtol=request.rtol, edge=cell.edge,
                  progress=look)  # fmt: skip
    stems = [start for start, on in moved.supports if on == "stem"]
    return Found(
        end=ending(moved).end,
        time_90=moved.time_90 * time,
        time_stem=float(stems[0]) * time if stems else np.nan,
        hops=sum(what == "lifts off" for _, what in moved.events),
        t=moved.t * time,
        theta=np.degrees(moved.theta),
        film=moved,
    )
