"""How fast small tilts grow and rotate, by linear theory and in runs; and how the time of inversion scales."""

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from scipy.stats import linregress

from app.model.maps.maps import LAWS, Cell, Map
from app.model.maps.steady import fixed, launch
from app.model.motion import Progress
from tippe_core import State, TopError, slide, slide_many, spinning_modes, steady_states, tumbling_modes
from tippe_core.types import Array

BRANCHES = ("upright", "tumbling", "inverted")
SPINS, DOTS = 97, 9
SMALL = 1e-7  # rad: a start so near a pole remains a small deviation for some time
FOLDS = 3.0  # e-foldings over which the growth of a run is measured
MOST_TIME = 400.0  # (R/g)^1/2: the longest run for this
POINTS = 9  # runs for each power law
REACH = 1.5  # the runs extend from 1/REACH to REACH times the value at the bead


class Branch(NamedTuple):
    """Upright, inverted or tumbling spin: the growth rate and the rotation rate, seen from above (both 1/s), of the
    fastest-growing mode as functions of the spin (rev/s) of the start; and the growth of runs, at fewer spins; none for
    tumbling."""

    name: str
    spin: Array
    growth: Array
    turning: Array
    run_spin: Array
    run_growth: Array


class OfLaw(NamedTuple):
    """The growth rate and the rotation rate of one branch at one spin by one law, both 1/s; nan if there is no such
    steady motion."""

    law: str
    branch: str
    growth: float
    turning: float


class Power(NamedTuple):
    """The exponent of time ~ quantity^power, and its error; nan if fewer than three runs turn over. runs: how many
    do."""

    law: str
    quantity: str
    power: float
    error: float
    runs: int


@dataclass(frozen=True, eq=False, kw_only=True)
class Rates:
    """branches: of the map's law over the spin; laws: of each law at the bead; powers: of each law around the bead."""

    branches: tuple[Branch, ...]
    laws: tuple[OfLaw, ...]
    powers: tuple[Power, ...]


def rates(request: Map, place: tuple[float, float], look: Progress | None = None) -> Rates:
    """The Rates at the bead. Raises TopError if there is no such top."""
    own, x = fixed(request, place), request.values_at(*place)
    low, high = own.across_range
    spin = np.linspace(max(low, 0.0), high, SPINS)
    if high <= 0:
        return Rates(branches=(), laws=(), powers=())
    here = own.at(high, x["tilt"])
    branches = tuple(_branch(name, here, spin, look) for name in BRANCHES)
    return Rates(branches=branches, laws=by_law(own, x), powers=powers(own, x, look))


def by_law(own: Map, x: dict[str, float]) -> tuple[OfLaw, ...]:
    """Each branch by each law, at the spin of the bead."""
    found = []
    for law in LAWS:
        cell = replace(own, law=law, values=_fixed(_of_law(own, law, x))).at(x["spin"], x["tilt"])
        unit = cell.scales.angular_velocity
        for name in BRANCHES:
            mode = unit * _mode(name, cell, launch(cell) * x["spin"])
            found.append(OfLaw(law, name, mode.real, abs(mode.imag)))
    return tuple(found)


def _of_law(own: Map, law: str, x: dict[str, float]) -> dict[str, float]:
    """The same with the second number of another law, if it is another one."""
    return x if law == own.law else x | {"second": Map(law=law).start["second"]}


def _fixed(x: dict[str, float]) -> tuple[tuple[str, float], ...]:
    return tuple((name, x[name]) for name in ("mu", "second", "slip"))


def _mode(name: str, here: Cell, C_J: float) -> complex:
    """The fastest-growing mode, in (g/R)^1/2; nan if there is no such steady motion."""
    top, law = here.top, here.friction
    if name != "tumbling":
        return complex(spinning_modes(top, law, _own_spin(name, C_J, here), name == "inverted")[0])
    steady = steady_states(top, C_J)
    between = steady.theta[1:-1][steady.stable[1:-1]]
    if not len(between):
        return complex(np.nan, np.nan)
    modes = tumbling_modes(top, law, float(between[0]))
    return complex(np.delete(modes, np.argmin(np.abs(modes)))[0])  # without that along the family of steady motions


def _branch(name: str, here: Cell, spin: Array, look: Progress | None) -> Branch:
    unit, per_spin, of_runs = here.scales.angular_velocity, launch(here), np.empty((0, 2))
    modes = unit * np.array([_mode(name, here, per_spin * each) for each in spin])
    if name != "tumbling" and here.friction.law.kind != 0:
        places = np.linspace(spin[0], spin[-1], DOTS + 2)[1:-1]
        of_runs = np.array([_grown(name, here, per_spin * each, look) for each in places]) * [1 / per_spin, unit]
    return Branch(name, spin, modes.real, np.abs(modes.imag), *of_runs.T)


def _own_spin(name: str, C_J: float, here: Cell) -> float:
    """The spin at a pole with this C_J, from C_J = I3 (c - a) omega3."""
    c = -1.0 if name == "inverted" else 1.0
    return C_J / (here.top.I3 * (c - here.top.a))


def _grown(name: str, here: Cell, C_J: float, look: Progress | None) -> tuple[float, float]:
    """(the C_J that is left then, since pivoting reduces it; the growth rate of the tilt from the pole in a run, nan if
    it decays)."""
    top, law, spin = here.top, here.friction, _own_spin(name, C_J, here)
    modes = spinning_modes(top, law, spin, name == "inverted").real
    none = C_J, np.nan
    if modes[0] <= 0:
        return none
    since = min(np.log(1e3) / max(modes[0] - modes[1], 1e-3), 6 / modes[0])
    end = since + FOLDS / modes[0]
    if end > MOST_TIME:
        return none
    pole = np.pi if name == "inverted" else 0.0
    state = State(abs(pole - SMALL), 0.0, 0.0, spin, vx=0.0, vy=0.0)
    moved = slide(top, state, law, np.linspace(0, end, 200), rtol=1e-11, progress=look)
    late = moved.t >= since
    if np.count_nonzero(late) < 10:
        return none
    growth = np.polyfit(moved.t[late], np.log(np.abs(pole - moved.theta[late])), 1)[0]
    return float(moved.jellett[late].mean()), float(growth)


def powers(own: Map, x: dict[str, float], look: Progress | None = None) -> tuple[Power, ...]:
    """The scaling of the time to reach 90 degrees with the spin, mu, and the second parameter of each friction law."""
    found = []
    for law in LAWS:
        mine = _of_law(own, law, x)
        for quantity in ("spin", "mu", *(("second",) if law != "viscous" else ())):
            found.append(_power(own, law, quantity, mine, look))
    return tuple(found)


def _power(own: Map, law: str, quantity: str, x: dict[str, float], look: Progress | None) -> Power:
    by = np.geomspace(1 / REACH, REACH, POINTS)
    cells, values = [], []
    for each in by:
        value = x[quantity] * each
        try:
            request = replace(own, law=law, values=_fixed(x | {quantity: value}))
            cells.append(request.at(value if quantity == "spin" else x["spin"], x["tilt"]))
            values.append(value)
        except TopError:
            continue
    if not cells:
        return Power(law, quantity, np.nan, np.nan, 0)
    first = cells[0]
    many = slide_many(first.top, [cell.state for cell in cells], [cell.friction for cell in cells], first.t_end,
                      first.edge, rtol=own.rtol, progress=look)  # fmt: skip
    passed = np.isfinite(many.time_90) & (many.time_90 > 0)
    count = int(passed.sum())
    if count < 3:
        return Power(law, quantity, np.nan, np.nan, count)
    line = linregress(np.log(np.array(values)[passed]), np.log(many.time_90[passed]))
    return Power(law, quantity, float(line.slope), float(line.stderr), count)
