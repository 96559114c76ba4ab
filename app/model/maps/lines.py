"""What closed forms predict for a map: lines drawn over it, and why runs end differently than they allow."""

from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from app.model.maps.maps import Map
from app.model.maps.solving import Level
from app.model.maps.steady import C_J
from tippe_core import TopError, strongest_friction, thresholds
from tippe_core.paper import equations as eq
from tippe_core.types import Array, Bools

FINE = 61  # points along each side at which the closed forms are evaluated
MANY = 20  # more hops than this cost the top a noticeable part of its spin
TURNED = ("stem", "inverted")
_limits = lru_cache(256)(thresholds)
WINDOW = ("window_low", "window_high")  # I1/I3 = 1 - a/R and 1 + a/R: the borders between the groups of tops


@dataclass(frozen=True)
class Disagreement:
    """Where runs differ from a closed form. kind: "lies" (the inverted top should stand, and it does not), "stays" (the
    upright top should be unstable, and it stays), "beyond" (the inverted top should be unstable, and it stands). count:
    the number of such cells; allowed: the number of cells for which the closed form predicts this; low, high: the range
    across of the former; reasons: most frequent first."""

    kind: str
    count: int
    allowed: int
    low: float
    high: float
    reasons: tuple["Reason", ...]


class Reason(NamedTuple):
    """Why some runs differ from a closed form: a key of maps.toml; the number of these runs; one of them, (across,
    up)."""

    why: str
    runs: int
    one: tuple[float, float]


def _excess(request: Map, x: float, y: float) -> dict[str, float]:
    """{line: by how much a start is beyond it}; nan if there is no such start, or no such line."""
    none = dict.fromkeys(("stands", "leaves", "painleve", *WINDOW), np.nan)
    try:
        cell = request.at(x, y)
    except TopError:
        return none
    top, state, limits = cell.top, cell.state, _limits(cell.top)
    launch = abs(C_J(top, state) / eq.C_J(1.0, 0.0, 0.0, 1.0, top))
    found = {"stands": launch - limits.launch if limits.inverted.stable == "above" else np.nan,
             "leaves": launch - limits.upright.spin if limits.upright.stable == "below" else np.nan}  # fmt: skip
    mu = cell.friction.law.mu if request.law != "viscous" else np.nan  # viscous friction has no upper bound
    found["painleve"] = mu - strongest_friction(top)
    return found | {"window_low": top.I1 / top.I3 - (1 - top.a), "window_high": top.I1 / top.I3 - (1 + top.a)}


@lru_cache(32)
def lines(request: Map) -> tuple[tuple[str, Array], ...]:
    """(name, (k, 2) points) of each line: "stands", above which the inverted top is stable; "leaves", above which the
    upright top is unstable; "painleve", friction beyond which no normal force can balance the top on its ball; and, for
    a map over tops, the lines of WINDOW."""
    x, y = (np.linspace(*span, FINE) for span in (request.across_range, request.up_range))
    fields = [[_excess(request, float(one), float(other)) for one in x] for other in y]
    wanted = ("stands", "leaves", "painleve", *(WINDOW if {"a", "ratio"} & {request.across, request.up} else ()))
    found: list[tuple[str, Array]] = []
    for name in wanted:
        z = np.array([[each[name] for each in row] for row in fields])
        along, up = _crossings(x, y, z), [line[:, ::-1] for line in _crossings(y, x, z.T)]
        found += [(name, line) for line in max(along, up, key=lambda lines: sum(map(len, lines)))]
    return tuple(found)


def _crossings(x: Array, y: Array, z: Array) -> list[Array]:
    """Where z (y, x) changes sign along each row: the first zeros of all rows as one line, the second ones as another,
    ..."""
    found: dict[int, list[tuple[float, float]]] = {}
    for row, other in zip(z, y, strict=True):
        at = np.flatnonzero((row[:-1] < 0) & (row[1:] >= 0) | (row[:-1] >= 0) & (row[1:] < 0))
        for k, i in enumerate(at):
            place = x[i] + (x[i + 1] - x[i]) * row[i] / (row[i] - row[i + 1])
            found.setdefault(k, []).append((float(place), float(other)))
    return [np.array(line) for line in found.values() if len(line) > 1]


def disagreements(level: Level) -> list[Disagreement]:
    """The Disagreements of a complete level, one for each kind; none if all runs do what the closed forms predict."""
    excess = [[_excess(level.request, float(x), float(y)) for x in level.x] for y in level.y]
    stands, leaves = (np.array([[each[name] for each in row] for row in excess]) for name in ("stands", "leaves"))
    was_run, turned = level.end != "refused", np.isin(level.end, TURNED)
    kinds = {
        "lies": (stands > 0, ~turned),
        "stays": (leaves > 0, level.end == "upright"),
        "beyond": (stands <= 0, turned),
    }
    return [found for kind, (says, does) in kinds.items()
            if (found := _disagreement(level, kind, says & was_run, says & was_run & does))]  # fmt: skip


def _disagreement(level: Level, kind: str, says: Bools, otherwise: Bools) -> Disagreement | None:
    if not otherwise.any():
        return None
    cells: dict[str, list[tuple[float, float]]] = {}
    for i, j in np.argwhere(otherwise):
        cells.setdefault(_why(level, kind, int(i), int(j)), []).append((float(level.x[j]), float(level.y[i])))
    reasons = sorted(
        (Reason(why, len(own), own[len(own) // 2]) for why, own in cells.items()), key=lambda each: -each.runs
    )
    across = level.x[otherwise.any(0)]
    return Disagreement(kind, int(otherwise.sum()), int(says.sum()), float(across.min()), float(across.max()),
                        tuple(reasons))  # fmt: skip


def _why(level: Level, kind: str, i: int, j: int) -> str:
    """What a run does instead, as far as the run itself shows it; and the reason where that is computed."""
    end = str(level.end[i, j])
    if kind == "beyond":
        return "carries" if end == "stem" else "high"
    if end == "upright":
        return _stays(level.request, float(level.x[j]), float(level.y[i]))
    if np.isfinite(level.columns["time_stem"][i, j]):
        return "lifts" if level.columns["hops"][i, j] > MANY else "falls"
    return {"rolling": "sticks", "leaning": "leans"}.get(end, "moving")


def _stays(request: Map, across: float, up: float) -> str:
    """Why a run stays upright: upright is stable too, or pivoting brings its spin to where it is; or that it does."""
    excess, lost = _excess(request, across, up)["leaves"], 0.0
    if not excess > 0:
        return "stable"
    if request.law == "contensou":  # the torque of pivoting without slip is constant: 3 pi/16 mu F_z radius
        cell = request.at(across, up)
        lost = 3 * np.pi / 16 * cell.friction.law.mu * cell.friction.law.radius / cell.top.I3 * cell.t_end
    return "pivoting" if excess < lost else "slow"
