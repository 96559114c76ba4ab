"""The motion of one start on each of the three tables, and its curves.

Ordinary: it slips, with the start's law of friction. Rough: it can only roll, so the table grips it first. Ice: no
friction at all.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache, partial
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from app.model import arrival
from app.model.frames import in_space
from app.model.life import Lived, life_of, lived, pushed_rows, thinned, within
from app.model.motion import PUSHED, check_room, clear, for_reader, touches
from app.model.phases import Phase, carried, phases, samples
from app.model.pushes import in_pieces
from app.model.regimes import ENDS, GLIDES, OF_CORE, SLIPS, WOULD_LIFT
from app.model.setup import SECONDS, Push, Setup, start_of
from app.text import error_text, say
from tippe_core import (
    Coulomb,
    Ending,
    State,
    Top,
    TopError,
    Trajectory,
    Viscous,
    ending,
    glide,
    grip,
    outcome,
    roll,
    slide,
)
from tippe_core.types import Array, Indices

STEP = 2  # one row of the curves for so many frames: 200 rows in a second of a fast top
STEM = "stem", "both"
KEPT = {"J": "jellett", "Routh": "routh", "E": "energy", "L_3": "L_3", "L_z": "L_z"}
THROWN = "stem throws it up"
WHILE, AT_ONCE = 0.2, 1e-6  # s
NEARLY = 1e-5  # relative: the precision of a time stored as float32
EXTREME = "extreme"  # the code of a TopError
SHIPS = arrival.TABLE, start_of(*arrival.ARRIVAL[1:])


@dataclass(frozen=True, eq=False, kw_only=True)
class TableMotion:
    """The motion of a start on a table, one of the names in TABLES. trajectory: as far as it goes; ended: the event at
    which it stopped, or ""; ending: on the ordinary table, how it ends. lost: the energy (MgR) that the grip of the
    rough table has taken; it is part of the heat. whole: whether it goes to the end of the toy's life, unless it is
    cut, for the reason life.LONG or life.CATCHES, "" if it is not.

    t (n,) extends to the requested end: if the trajectory ends earlier, its last row is repeated there. frames: the
    arguments of top3d.pack_frames. stretches: (start, end, one of regimes.py), in order. drift: for each of KEPT, the
    largest difference between two instants relative to the largest value; alone: the time up to which only the sphere
    touches, what ends that ("" if nothing), and the drift of J up to then, which only a single contact conserves; both
    since the last push. Events have tippe_core's names, except THROWN if the stem's first touch lifts the top off.

    curves (n, 8): t (s), tilt (degrees), height of G (mm), the energy as the height to which it could lift the top
    (mm), the heat so far in the same way, the spin about the top's own axis and its rotation seen from above (rev/s),
    and the code of regimes.py.
    """

    start: Setup
    table: str
    trajectory: Trajectory
    ending: Ending | None
    ended: str
    t: Array
    frames: tuple[Array | Indices, ...]
    stretches: tuple[tuple[float, float, int], ...]
    drift: MappingProxyType[str, float]
    alone: tuple[float, str, float]
    lost: float
    whole: bool
    cut: str
    curves: Array

    @property
    def slip(self) -> Array:
        """The slip speed, (n,)."""
        return np.hypot(*self.trajectory.slip.T)

    @property
    def ledger(self) -> dict[str, Array]:
        """Energies in MgR whose sum is the energy at the start, {name: (n,)}; the height is that above G's lowest
        position."""
        entries, a = self.trajectory.ledger, self.trajectory.top.a
        return {
            "spin": entries.spin,
            "precession and nutation": entries.precession + entries.nutation,
            "motion of G": entries.translation,
            "height": entries.height - min(0.0, 2 * a),
            "heat": entries.heat,
        }

    @property
    def seconds(self) -> Array:
        """The times of the trajectory in s."""
        return self.trajectory.t * self.start.scales.time

    @property
    def tilt(self) -> Array:
        """theta in degrees, at the times of the trajectory."""
        return np.degrees(self.trajectory.theta)

    @property
    def carried(self) -> NDArray[np.str_]:
        """What the top stands on at the times of the trajectory: "ball", "stem", "both" or "none"."""
        return carried(self.trajectory, self.trajectory.t)

    @property
    def rolls_since(self) -> float:
        """The time (s) from which it rolls until the end; nan if it does not."""
        slips = np.flatnonzero(self.trajectory.regime != "roll")
        if not len(slips):
            return 0.0
        if slips[-1] + 1 == len(self.seconds):
            return np.nan
        touch = self.trajectory.supports[-1][0] * self.start.scales.time  # which may be between two samples
        return float(max(self.seconds[slips[-1] + 1], touch))

    @property
    def caught(self) -> bool:
        """Whether Coulomb's law at a point held the top before it was past 90 degrees, so that it rolls on, although by
        its energy it would rise if it went on slipping."""
        start, moved = self.start, self.trajectory
        if not isinstance(start.friction, Coulomb) or moved.regime[-1] != "roll" or not np.isnan(moved.time_90):
            return False
        return outcome(start.top, start.state).verdict in ("turns over", "hangs")

    @property
    def ended_at(self) -> float | None:
        """When (s) it ended early; None if it did not."""
        if not self.ended or len(self.trajectory.t) == len(self.t):
            return None
        return self.trajectory.events[-1][0] * self.start.scales.time

    @property
    def touches(self) -> float | None:
        """When (s) its stem first touches after the start; None if it does not."""
        stretches = self.ending.stretches[1:] if self.ending else ()
        touch = next((each.start for each in stretches if each.on in STEM), None)
        return None if touch is None else touch * self.start.scales.time

    @cached_property
    def cuts(self) -> Mapping[str, float]:
        """{code: the time (s)} of what divides it: "off", its stem leaves the table for good, after it was on it for a
        while; "rolls", it begins to roll for good."""
        found: dict[str, float] = {}
        unit, stretches = self.start.scales.time, self.ending.stretches if self.ending else ()
        on = [each for each in stretches if each.on in STEM]
        if on and stretches[-1].on == "ball" and (on[-1].end - on[0].start) * unit > WHILE:
            found["off"] = on[-1].end * unit
        if 0.0 < self.rolls_since < self.seconds[-1]:
            off = found.get("off", np.nan)
            found["rolls"] = off if abs(self.rolls_since - off) < AT_ONCE else self.rolls_since
        return MappingProxyType(found)

    @cached_property
    def pushes(self) -> tuple[tuple[Push, int, float], ...]:
        """Those of its start that came about, each with the row just after it, and the energy (MgR) that it gave."""
        moved, rows = self.trajectory, pushed_rows(self.trajectory)
        whole = (moved.energy + moved.heat).tolist()
        return tuple((push, i, whole[i] - whole[i - 1]) for push, i in zip(self.start.pushes, rows, strict=False))

    @cached_property
    def phases(self) -> tuple[Phase, ...]:
        """Its phases."""
        pushes = [push.t for push, *_ in self.pushes]
        still, cuts = max([0.0, *pushes]), (*self.cuts.values(), *pushes)
        rolls = float(np.nan_to_num(self.rolls_since, nan=np.inf))
        return phases(samples(self.trajectory, self.start.scales.time, self.start.turns, cuts,
                              still if self.table == "ice" else max(rolls, still)))  # fmt: skip


@lru_cache(12)
def motion_on(table: str, start: Setup) -> TableMotion:
    """The TableMotion of a start, cached for all visitors; for the arrival, the one that ships. Raises TopError in the
    units of the controls."""
    return whole_on(table, start) if (table, start) == SHIPS else on(start, table)


@lru_cache(12)
def whole_on(table: str, start: Setup) -> TableMotion:
    """As motion_on(), to the end of the toy's life; on a table on which it never ends, as long as on the ordinary
    one."""
    if (table, start) == SHIPS:
        kept = arrival.read(start.top)
        return watched(start, table, Lived(kept, start.scales.time * float(kept.t[-1]), ""), whole=True)
    if table != "ordinary":
        try:
            seconds = whole_on("ordinary", start).start.seconds
        except TopError:
            seconds = SECONDS
        return on(replace(start, seconds=seconds), table)
    try:
        check_room(start, start.state)
        return watched(start, table, lived(start), whole=True)
    except TopError as error:
        raise for_reader(error, start.scales) from None


def on(start: Setup, table: str) -> TableMotion:
    """The TableMotion of a start on a table, shortened if it makes too many turns to be shown. Raises TopError in the
    units of the controls."""
    try:
        start = within(start)
        found, lost = computed(start, table)
        thin = found._replace(moved=thinned(found.moved, start.scales.time))
        return watched(start, table, thin, lost, whole=table != "ordinary")
    except TopError as error:
        raise for_reader(error, start.scales) from None


def computed(start: Setup, table: str) -> tuple[Lived, float]:
    """The motion of a Setup on a table, at evenly spaced times, and the energy (MgR) that the grip of the rough one has
    taken. Raises TopError."""
    state, lost = start.state, 0.0
    check_room(start, state)
    if table == "ordinary":
        return life_of(start).until(start.seconds), lost
    try:
        if table == "ice":
            moved = in_pieces(start, state, partial(_glided, start), lambda state: state)
        else:
            state, lost = grip(start.top, state)
            moved = in_pieces(start, state, partial(_rolled, start), partial(_gripped, start.top))
    except TopError:
        raise
    except (ValueError, ArithmeticError):  # of the solvers without friction, whose squares or reciprocals overflow
        raise TopError("state", repr(state), "one of moderate numbers", code=EXTREME) from None
    return Lived(moved, start.seconds, ""), lost


def check_pushes(start: Setup, motions: list[TableMotion], why: TopError | None) -> None:
    """Raises TopError if the last push came about in none of these motions; why: the reason if there is no motion."""
    if start.pushes and why and not motions:
        raise why
    if start.pushes and all(len(motion.pushes) < len(start.pushes) for motion in motions):
        last = max(motion.seconds[-1] if motion.ended_at is None else motion.ended_at for motion in motions)
        raise TopError("push", start.pushes[-1].t, "{first:.10g} to {last:.10g}", code="outside-times", first=0.0,
                       last=float(last))  # fmt: skip


def _glided(start: Setup, state: State, times: Array) -> Trajectory:
    flies = state.z is not None
    motion = partial(slide, start.top, state, Viscous(0.0), times) if flies else partial(glide, start.top, state, times)
    return clear(motion, start, state)


def _rolled(start: Setup, state: State, times: Array) -> Trajectory:
    return clear(partial(roll, start.top, None, times, state), start, state)


def _gripped(top: Top, state: State) -> State:
    """The rolling State after a push. The rough table pulls too: where the push would lift the top off, at the ball

        J_z = -u_z/(1 + (a s)^2/I1) ,   I1 dw1 = -a s J_z ,

    with the velocity u_z = v_z - a s w1 of the point that touches, keeps it there, before it grips."""
    if state.z is not None and state.vz is not None:
        arm = top.a * np.sin(state.theta)
        J = (arm * state.theta_dot - state.vz) / (1 + arm**2 / top.I1)
        state = replace(state, theta_dot=state.theta_dot - arm * J / top.I1, z=None, vz=None)
    return grip(top, state)[0]


def why_not(error: TopError) -> str:
    """Why a start has no run on a table, in a sentence."""
    return say("planes.run.extreme") if error.code == EXTREME else error_text(error)


def watched(start: Setup, table: str, found: Lived, lost: float = 0.0, *, whole: bool) -> TableMotion:
    """The TableMotion of the results of computed() or lived()."""
    start, moved = replace(start, seconds=found.seconds), found.moved
    end = found.seconds / start.scales.time
    early = end - moved.t[-1] >= NEARLY * end
    code = np.array([OF_CORE[word] for word in moved.regime])
    if table == "rough":
        code[moved.force[:, 2] < 0] = WOULD_LIFT
    elif table == "ice":
        code[code == SLIPS] = GLIDES  # without friction
    frames = [moved.t, moved.quaternion, moved.contact, moved.com, moved.theta, *in_space(moved), code]
    if early:
        frames = [np.concatenate([rows, rows[-1:]]) for rows in frames]
        frames[0][-1], frames[-1][-2:] = end, ENDS
    t, code = frames[0], frames[-1]
    starts = np.flatnonzero(np.diff(code, prepend=-1))
    stretches = zip(t[starts], np.append(t[starts[1:]], t[-1]), code[starts], strict=True)
    since = max((at for at, event in moved.events if event == PUSHED), default=0.0)
    last_part = moved.t >= since
    first = next((each for each in moved.events if each[0] > since and each[1] not in ("sticks", "slips")), (t[-1], ""))
    until, event = first
    if event == "lifts off" and table == "ordinary" and start.edge and touches(moved, until, start):
        event = THROWN
    last = moved.events[-1] if early and moved.events else (t[-1], "")
    return TableMotion(
        start=start, table=table, trajectory=moved, lost=lost, whole=whole, cut=found.cut,
        ending=ending(moved) if table == "ordinary" else None, ended=event if last == first else last[1], t=t,
        frames=tuple(frames),
        stretches=tuple((float(start), float(end), int(which)) for start, end, which in stretches),
        drift=MappingProxyType({name: _drift(getattr(moved, field)[last_part]) for name, field in KEPT.items()}),
        alone=(until, event, _drift(moved.jellett[last_part & (moved.t <= until)])),
        curves=_curves(start, moved, t, code, lost),
    )  # fmt: skip


def _drift(values: Array) -> float:
    most = np.abs(values).max()
    return float(np.ptp(values) / most) if most else 0.0


def _curves(start: Setup, moved: Trajectory, t: Array, code: Indices, lost: float) -> Array:
    millimetres, height = 1e3 * start.scales.R, moved.com[:, 2]
    spin, above = moved.omega[:, 2], moved.omega[:, 1] * np.sin(moved.theta) + moved.omega[:, 2] * np.cos(moved.theta)
    values = np.column_stack([
        np.degrees(moved.theta), millimetres * height, millimetres * (moved.ledger.kinetic + height),
        millimetres * (moved.heat + lost), start.turns * spin, start.turns * above,
    ])  # fmt: skip
    if len(t) > len(values):  # it ended early; the last row is repeated at the end
        values = np.concatenate([values, values[-1:]])
    rows = np.column_stack([t * start.scales.time, values, code])
    return rows[every_other(len(rows), pushed_rows(moved))].astype(np.float32)


def every_other(count: int, pushed: list[int]) -> Indices:
    """One row for each STEP of so many, the last one, and those before and after each push."""
    return np.unique([*range(0, count, STEP), count - 1, *(i - before for i in pushed for before in (0, 1))])
