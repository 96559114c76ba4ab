"""The final tilt over the spin: steady motions as lines, runs as points, and the long-term fate of a run.

All at the tilt, friction and law of a Map's bead; rev/s across, degrees up.
"""

from dataclasses import dataclass, replace
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from app.model.maps.maps import OF_BODY, QUANTITIES, Cell, Map
from app.model.motion import Progress
from app.model.phases import phases, samples
from tippe_core import State, States, Top, slide, slide_many, steady_states
from tippe_core.paper import equations as eq
from tippe_core.types import Array

RUNS, SWEEP, TILTS, LONGER = 41, 17, 181, 4
MOST_SECONDS = 60.0
DRIFT = 1200  # samples of the long run, denser at its beginning, where it moves faster
NO_END = "refused", "moving"
DIFFER = 5.0  # degrees: the least difference between the sweeps up and down that counts as hysteresis
Words = NDArray[np.str_]


class Line(NamedTuple):
    """One line of steady motions: the spins of starts with the same C_J, at these tilts, and whether the motions are
    stable."""

    spin: Array
    theta: Array
    stable: bool


class Life(NamedTuple):
    """A long run over t (s): the spin of a start with the C_J that is left, and the tilt; the times at which it first
    stands on its stem, at which it does so last, and from which it rolls until the end, s, nan if never; how long it
    was computed, s; and the final tilt."""

    t: Array
    spin: Array
    theta: Array
    stands: float
    leaves: float
    rolls: float
    seconds: float
    end: float


@dataclass(frozen=True, eq=False, kw_only=True)
class Bifurcation:
    """lines: a tuple of Line; spin (n,), and end (2, n), the tilts (degrees) of runs from there after each of times
    (s); up, down (m,): the tilts over swept (m,), where each run continues the one before with its C_J changed to that
    of the next spin; up_end, down_end (m,): their ends; life: of the start at the bead."""

    lines: tuple[Line, ...]
    spin: Array
    times: tuple[float, float]
    theta: Array
    swept: Array
    up: Array
    down: Array
    up_end: Words
    down_end: Words
    life: Life

    @property
    def hysteresis(self) -> tuple[float, float] | None:
        """The lowest and the highest spin at which the sweeps up and down end differently: in other words, or at
        other tilts, unless they nod, when the tilt is that of a moment."""
        one, other = self.up_end, self.down_end
        over = ~np.isin(one, NO_END) & ~np.isin(other, NO_END)
        apart = (one != "rolling") & (np.abs(self.up - self.down) > DIFFER)
        at = self.swept[over & ((one != other) | apart)]
        return (float(at.min()), float(at.max())) if at.size else None


def spins_of(request: Map) -> tuple[float, float]:
    """The range of the spin (rev/s)."""
    if request.across == "spin":
        return request.across_range
    if request.up == "spin":
        return request.up_range
    return QUANTITIES["spin"].low, QUANTITIES["spin"].high


def fixed(request: Map, place: tuple[float, float]) -> Map:
    """The Map over spin and tilt through the bead of another Map."""
    x, axes = request.values_at(*place), (request.across, request.up)
    if {*axes} & OF_BODY:
        cell = request.at(*place)
        own = request.thing._replace(top=cell.top, scales=cell.scales, edge=cell.edge)
        request = replace(request, body="", own=own)
    tilt = QUANTITIES["tilt"]
    values = tuple((name, x[name]) for name in ("mu", "second", "slip", "spin", "tilt"))
    low, high = spins_of(request) if "spin" in axes else (QUANTITIES["spin"].low, QUANTITIES["spin"].high)
    return replace(request, across="spin", up="tilt", across_range=(low, high), up_range=(tilt.low, tilt.high),
                   values=values, nudged=False)  # fmt: skip


def launch(cell: Cell) -> float:
    """C_J of a start for each rev/s of its spin."""
    return C_J(cell.top, State(cell.state.theta, 0.0, 0.0, 2 * np.pi / cell.scales.angular_velocity))


def C_J(top: Top, state: State | States) -> float:
    """Of a state of a top."""
    return float(eq.C_J(np.cos(state.theta), np.sin(state.theta), state.omega2, state.omega3, top))


def steady_lines(top: Top, per_spin: float, low: float, high: float) -> tuple[Line, ...]:
    """The steady motions of a top whose starts have C_J = per_spin times their spin: the poles, and between them C_J^2
    = a I_eff^2/(I1 c - I3 (c - a)). Lines are cut where the stability changes."""
    found: list[Line] = []
    spins = np.linspace(low, high, 241)
    poles = [steady_states(top, per_spin * spin).stable[[0, -1]] for spin in spins]
    for pole, theta in ((0, 0.0), (1, 180.0)):
        found += _cut(spins, np.full(len(spins), theta), np.array([each[pole] for each in poles]))
    theta = np.linspace(0, np.pi, TILTS + 2)[1:-1]
    s, c = np.sin(theta), np.cos(theta)
    turns = top.I1 * c - top.I3 * (c - top.a)
    with np.errstate(invalid="ignore", divide="ignore"):
        spin = np.sqrt(top.a / turns) * (top.I1 * s * s + top.I3 * (c - top.a) ** 2) / abs(per_spin)
    spin[(top.a * turns <= 0) | (spin < low) | (spin > high)] = np.nan
    stable = np.zeros(len(theta), bool)
    for i in np.flatnonzero(np.isfinite(spin)):
        states = steady_states(top, per_spin * spin[i])
        stable[i] = states.stable[np.argmin(np.abs(states.theta - theta[i]))]
    return tuple(found + _cut(spin, np.degrees(theta), stable))


def _cut(spin: Array, theta: Array, stable: Array) -> list[Line]:
    """Cuts a line into pieces that are stable, or unstable, throughout."""
    there = np.isfinite(spin)
    ends = np.flatnonzero((stable[1:] != stable[:-1]) | (there[1:] != there[:-1])) + 1
    return [Line(spin[first:last], theta[first:last], bool(stable[first]))
            for first, last in pairwise([0, *ends, len(spin)]) if there[first] and last - first > 1]  # fmt: skip


def bifurcation(request: Map, place: tuple[float, float], look: Progress | None = None) -> Bifurcation:
    """The Bifurcation through the bead. Raises TopError if there is no such top."""
    own, x = fixed(request, place), request.values_at(*place)
    low, high = own.across_range
    here = own.at(x["spin"], x["tilt"])
    spin = np.linspace(low, high, RUNS)
    times = own.seconds, min(LONGER * own.seconds, MOST_SECONDS)
    cells = [own.at(float(each), x["tilt"]) for each in spin]
    t_end = np.array(times)[:, None] / here.scales.time
    many = slide_many(here.top, [cell.state for cell in cells], here.friction, t_end, here.edge, rtol=own.rtol,
                      progress=look)  # fmt: skip
    theta = np.where(many.end == "refused", np.nan, np.degrees(many.theta_end))
    swept = np.linspace(low, high, SWEEP)
    up, up_end = _sweep(own, x["tilt"], swept, look)
    down, down_end = _sweep(own, x["tilt"], swept[::-1], look)
    lines = steady_lines(here.top, launch(here), low, high) if low >= 0 else ()
    return Bifurcation(lines=lines, spin=spin, times=times, theta=theta, swept=swept, up=up, down=down[::-1],
                       up_end=up_end, down_end=down_end[::-1], life=life(here, look))  # fmt: skip


def _sweep(own: Map, tilt: float, spins: Array, look: Progress | None) -> tuple[Array, Words]:
    """The final tilt of each run, and its end; it starts where the one before ended, with all velocities scaled to give
    the C_J of the next spin. A run that was refused is nan, and the next one starts afresh."""
    found, ends, state = np.full(len(spins), np.nan), np.full(len(spins), "refused", "<U8"), None
    for i, spin in enumerate(spins):
        cell = own.at(float(spin), tilt)
        start = cell.state if state is None else _brought(state, cell)
        if start is None:
            continue
        many = slide_many(cell.top, start, cell.friction, cell.t_end, cell.edge, rtol=own.rtol)
        state, ends[i] = None, many.end
        if many.end != "refused":
            found[i], state = np.degrees(many.theta_end), many.state_end
        if look:
            look(0.0)
    return found, ends


def _brought(state: States, cell: Cell) -> States | None:
    """A state with its velocities scaled to the C_J of a cell's start."""
    now = C_J(cell.top, state)
    if now == 0.0:
        return None
    by = C_J(cell.top, cell.state) / now
    names = ("theta_dot", "omega2", "omega3", "vx", "vy")
    return state._replace(**{name: by * getattr(state, name) for name in names})


def life(here: Cell, look: Progress | None) -> Life:
    """The run at the bead for MOST_SECONDS."""
    time = here.scales.time
    times = MOST_SECONDS / time * np.linspace(0, 1, DRIFT) ** 2
    moved = slide(here.top, here.state, here.friction, times, rtol=1e-6, edge=here.edge,
                  progress=look)  # fmt: skip
    stands = [phase for phase in phases(samples(moved, time, 1 / (2 * np.pi * time))) if phase.kind == "stands-on-stem"]
    first, last = (stands[0].start, stands[-1].end) if stands else (np.nan, np.nan)
    leaves = last if stands and last < time * moved.t[-1] else np.nan
    slips = max(np.flatnonzero(moved.regime != "roll"), default=0)
    rolls = moved.t[slips + 1] * time if slips + 1 < len(moved.t) else np.nan
    return Life(moved.t * time, np.abs(moved.jellett / launch(here)), np.degrees(moved.theta), first, leaves, rolls,
                float(moved.t[-1] * time), float(np.degrees(moved.theta[-1])))  # fmt: skip
