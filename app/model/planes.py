"""The view-model of the three planes: a start and a law of friction -> one frozen Picture of one top on all three.

It computes and publishes, and knows no widgets. In units of R, M and g but for what a person sets: rev/s, degrees, s.
A run is made in a thread, which has no page: it is told in which language to say why there is no motion.
"""

from collections.abc import Callable
from dataclasses import dataclass, field, fields, replace
from functools import partial
from itertools import groupby
from types import MappingProxyType
from typing import NamedTuple, TypeAlias

import numpy as np
import param

from app.model.bodies import body, second_part
from app.model.builder import Builder
from app.model.explorer import Explorer
from app.model.frames import axes
from app.model.runs import Result, Run, Runs, Stopped
from app.text import say, told
from tippe_core import (
    SUNK,
    Coulomb,
    Ending,
    Outcome,
    Scales,
    Shape,
    SmoothedCoulomb,
    State,
    SteadyStates,
    Stretch,
    Top,
    TopError,
    Trajectory,
    Viscous,
    beside,
    ending,
    glide,
    growth,
    lowest,
    outcome,
    roll,
    slide,
    steady_states,
    sunk,
)
from tippe_core.motion.friction import Friction
from tippe_core.types import Array, Indices, Number, Rim

PLANES = ("rough", "smooth", "sliding")
LAWS = ("coulomb", "viscous", "smoothed")
# Places in top3d.REGIMES
ROLLS, LIFTS, SLIPS, FLIES, ENDS = 0, 2, 3, 4, 5
KEPT = {"J": "jellett", "Routh": "routh", "E": "energy", "L_3": "L_3", "L_z": "L_z"}

MOST_SECONDS = 60.0
# A frame turns the top by MOST_TURN rad at most, unless that takes more than MOST_FRAMES; by FARTHEST_TURN it may not.
MOST_TURN, MOST_FRAMES, FARTHEST_TURN = 0.3, 16_000, 1.0
LEAST_FRAMES = 600
THROWN, ANOTHER = "stem throws it up", "another part touches"
NEAR_TOUCH = 0.02  # rad: so near to the touch angle a lift-off is the touch's
SHORT = 0.05  # s of the real top: a touch, or a hop, that an eye does not follow
RTOL = 1e-9  # of slide()
NUDGE, BESIDE = 1e-6, 3.0  # rad, s: a run beside the run starts so much further tilted, and goes so far past a touch

# A run that a newer one replaces may still finish within this, s; later it is stopped.
PATIENCE = 0.5

Progress: TypeAlias = Callable[[float], object]


@dataclass(frozen=True, eq=False, kw_only=True)
class Settings:
    """All that a run depends on. rolling: the State that the constants chosen for rolling give; None: spin and tilt
    are given. shape: None where a, I1 and I3 are not its own."""

    top: Top
    scales: Scales
    shape: Shape | None
    profile: Array
    rolling: State | None
    spin: float
    tilt: float
    slip: float
    law: str
    mu_k: float
    mu_s: float
    gamma: float
    mu: float
    eps: float
    landing: str
    stem: bool
    seconds: float

    @property
    def friction(self) -> Friction:
        if self.law == "viscous":
            return Viscous(self.gamma)
        return SmoothedCoulomb(self.mu, self.eps) if self.law == "smoothed" else Coulomb(self.mu_k, self.mu_s)

    @property
    def edge(self) -> Rim | None:
        """The stem's edge where it takes part."""
        return self.shape.edge if self.stem and self.shape is not None else None

    @property
    def touch_angle(self) -> float:
        """theta from which that edge touches, inf where none takes part."""
        found = self.shape.touch_angle if self.edge and self.shape else None
        return np.inf if found is None else found

    @property
    def part(self) -> str:
        """What touches beside the ball, "stem" or "rim"."""
        return second_part(self.shape)

    @property
    def state(self) -> State:
        """The State at t = 0. slip 1: G at rest; 0: G moves as rolling needs; in between and beyond in proportion."""
        if self.rolling is not None:
            return self.rolling
        if not 0 <= self.tilt <= 180:
            raise TopError("tilt", self.tilt, "0 <= tilt <= 180 (°)")
        for name in ("spin", "slip"):
            if not np.isfinite(getattr(self, name)):
                raise TopError(name, getattr(self, name), "a finite number", code="not-finite")
        theta = float(np.radians(self.tilt))
        spin = 2 * np.pi * self.spin / self.scales.angular_velocity
        return State(theta, 0.0, 0.0, spin, vx=-(1 - self.slip) * spin * np.sin(theta), vy=0.0)

    @property
    def times(self) -> Array:
        """(n,), short enough a step that the top turns little in it."""
        if not 0 < self.seconds <= MOST_SECONDS:
            raise TopError("seconds", self.seconds, f"0 < seconds <= {MOST_SECONDS:g} (s)")
        start, end = self.state, self.seconds / self.scales.time
        top = self.top
        kinetic = top.I1 * (start.theta_dot**2 + start.omega2**2) + top.I3 * start.omega3**2
        vx, vy = start.vx or 0.0, start.vy or 0.0
        fastest = np.sqrt((kinetic + vx**2 + vy**2 + 4 * abs(top.a)) / min(top.I1, top.I3))
        if end * fastest > FARTHEST_TURN * MOST_FRAMES:
            most = FARTHEST_TURN * MOST_FRAMES / fastest * self.scales.time
            raise TopError("seconds", self.seconds, "at most {most:.3g} s with this spin",
                           "More turns than that are too many to show.", code="too-many-turns", most=most)  # fmt: skip
        frames = np.clip(np.ceil(end * fastest / MOST_TURN), LEAST_FRAMES, MOST_FRAMES)
        return np.linspace(0, end, int(frames) + 1)


@dataclass(frozen=True, eq=False, kw_only=True)
class Motion:
    """One top on one plane. trajectory: as far as it goes; ended: the event that it stopped at, or "".

    t (n,) to the end asked for: where the trajectory ends earlier, its last row stands once more at the end. frames:
    the arguments of top3d.pack_frames. stretches: (start, end, place in REGIMES) in turn. drift: of KEPT, the largest
    difference between two instants, over the largest size; alone: the time to which the sphere alone is on the table,
    what ends that ("" if nothing), and the drift of J until then, which no more than one contact keeps. The events have
    tippe_core's names, but THROWN where the stem's first touch is what lifts it off, and ANOTHER. ending: on the
    sliding plane, what became of it.
    """

    trajectory: Trajectory
    ending: Ending | None
    ended: str
    t: Array
    frames: tuple[Array | Indices, ...]
    stretches: tuple[tuple[float, float, int], ...]
    drift: MappingProxyType[str, float]
    alone: tuple[float, str, float]

    @property
    def slip(self) -> Array:
        """The slip speed, (n,)."""
        return np.hypot(*self.trajectory.slip.T)

    @property
    def ledger(self) -> dict[str, Array]:
        """Energies in MgR that add up to what it started with, {name: (n,)}; height above G's lowest place."""
        entries, a = self.trajectory.ledger, self.trajectory.top.a
        return {
            "spin": entries.spin,
            "precession and nutation": entries.precession + entries.nutation,
            "motion of G": entries.translation,
            "height": entries.height - min(0.0, 2 * a),
            "heat": entries.heat,
        }

    @property
    def crossings(self) -> Array:
        """The times at which theta passes a right angle, (k,)."""
        theta, t = self._from_right_angle
        at = np.flatnonzero((theta[:-1] < 0) != (theta[1:] < 0))
        return t[at] + (t[at + 1] - t[at]) * theta[at] / (theta[at] - theta[at + 1])

    @property
    def _from_right_angle(self) -> tuple[Array, Array]:
        """theta less a right angle, and the time, where that is not 0."""
        theta = self.trajectory.theta - np.pi / 2
        off = np.abs(theta) > 1e-12
        return theta[off], self.trajectory.t[off]

    @property
    def starts_below(self) -> bool:
        """Whether it starts below a right angle, or goes below it from there."""
        return bool(np.all(self._from_right_angle[0][:1] < 0))

    @property
    def overturned(self) -> float:
        """The time at which theta first passes a right angle, nan if it never does, or started past it."""
        found = self.crossings
        return float(found[0]) if len(found) and self.trajectory.theta[0] < np.pi / 2 else np.nan


class Well(NamedTuple):
    """V_J at one C_J, from start to end in (R/g)^1/2: a while in which the ball alone was at the table."""

    start: float
    end: float
    C_J: float
    steady: SteadyStates


@dataclass(frozen=True, eq=False, kw_only=True)
class Picture:
    """All that the views show. motions: {plane: Motion or None}; None: the sentence why is in messages at the plane.

    outcome: of the ball alone. growth: how many times NUDGE grew in the run beside the sliding one, None without that.
    messages: a sentence for each control that was given what cannot be, "run" for a run that was stopped; the rest is
    then the last good one.
    """

    settings: Settings
    state: State
    friction: Friction
    motions: MappingProxyType[str, Motion | None]
    outcome: Outcome
    growth: float | None = None
    messages: MappingProxyType[str, str] = field(default_factory=lambda: MappingProxyType({}))

    def wells(self, plane: str) -> tuple[Well, ...]:
        """(Well, ...) of the motion on a plane, one for each while of more than SHORT in which no stem touched: a
        second contact changes C_J. Of none, that of the start."""
        motion, shortest = self.motions[plane], SHORT / self.settings.scales.time
        if motion is None:
            return (Well(0.0, 0.0, self.outcome.C_J, self.outcome.steady),)
        moved = motion.trajectory
        found: list[Well] = []
        spells = motion.ending.stretches if motion.ending else (Stretch(moved.t[0], moved.t[-1], "ball"),)
        for free, group in groupby(spells, key=lambda spell: spell.on in ("ball", "air")):
            group = list(group)
            start, end = group[0].start, group[-1].end
            inside = (moved.t >= start) & (moved.t <= end)
            if free and inside.any() and (end - start > shortest or not found):
                C_J = float(np.median(moved.jellett[inside]))
                found.append(Well(start, end, C_J, steady_states(moved.top, C_J)))
        return tuple(found) or (Well(-1.0, -1.0, self.outcome.C_J, self.outcome.steady),)


def solve(settings: Settings, progress: Progress | None = None) -> Picture:
    """The Picture. progress: called with the time reached; what it raises stops the run. Raises TopError, whose name is
    the input at fault."""
    top, state, times = settings.top, settings.state, settings.times
    _check_room(settings, state)
    runs = {
        "rough": lambda: _clear(lambda: roll(top, None, times, replace(state, vx=None, vy=None)), settings, state),
        "smooth": lambda: _clear(lambda: glide(top, state, times), settings, state),
        "sliding": lambda: _slid(settings, state, times, progress),
    }
    motions: dict[str, Motion | None] = {}
    messages: dict[str, str] = {}
    for plane in PLANES:
        try:
            motions[plane] = _motion(runs[plane](), settings, times, plane)
        except TopError as error:
            if plane == "sliding":
                raise
            motions[plane], messages[plane] = None, told(for_reader(error, settings.scales))
    return Picture(
        settings=settings, state=state, friction=settings.friction, motions=MappingProxyType(motions),
        outcome=outcome(top, state, settings.scales), messages=MappingProxyType(messages),
    )  # fmt: skip


def _slid(settings: Settings, state: State, times: Array, progress: Progress | None) -> Trajectory:
    moved = slide(settings.top, state, settings.friction, times, rtol=RTOL, landing=settings.landing,
                  edge=settings.edge, progress=progress)  # fmt: skip
    first = sunk(moved, body(settings.shape)) if settings.edge else len(moved.t)
    return moved if first == len(moved.t) else _until(moved, max(first, 1), float(moved.t[first]), ANOTHER)


def _check_room(settings: Settings, state: State) -> None:
    """TopError where a part of the body that is neither ball nor edge would be below the table at the start."""
    if settings.edge is None:
        return
    theta = np.append(np.linspace(0, np.pi, 3601), state.theta)
    radius, height, rounding = settings.edge
    stands = np.maximum(1, rounding - height * np.cos(theta) + radius * np.sin(theta))
    below = stands + lowest(body(settings.shape), theta) < -SUNK
    if below[-1]:
        most = np.degrees(theta[max(int(np.argmax(below)) - 1, 0)])
        raise TopError("tilt", float(np.degrees(state.theta)), "at most {most:.4g} degrees for this body",
                       "Another part of it would be below the table.", code="body-below-table", most=most)  # fmt: skip


def _until(trajectory: Trajectory, count: int, time: float, event: str) -> Trajectory:
    """The first rows of a Trajectory, which ends at that time with that event."""
    rows: dict[str, Number]
    rows = {part.name: value[:count] for part in fields(trajectory)
            if isinstance(value := getattr(trajectory, part.name), np.ndarray)}  # fmt: skip
    events, supports = (tuple(x for x in each if x[0] < time) for each in (trajectory.events, trajectory.supports))
    return replace(trajectory, events=(*events, (time, event)), supports=supports, **rows)


def nudged(picture: Picture, progress: Progress | None = None) -> float:
    """How many times NUDGE, added to the tilt of the start, grows in theta on the sliding plane, at most; BESIDE after
    the first touch is as long as it takes to tell."""
    settings, state, motion = picture.settings, picture.state, picture.motions["sliding"]
    assert motion is not None and motion.ending is not None  # it hits something there
    moved, until = motion.trajectory, motion.ending.stretches[0].end + BESIDE / settings.scales.time
    near = _slid(settings, beside(state, NUDGE), moved.t[moved.t <= until], progress)
    return growth(moved, near, NUDGE)


def _clear(motion: Callable[[], Trajectory], settings: Settings, state: State) -> Trajectory:
    """A motion on the ball alone, motion(), as far as the stem is clear of the table; TopError where it never is."""
    angle = settings.touch_angle
    if state.theta >= angle:
        raise TopError("tilt", float(np.degrees(state.theta)),
                       "less than {most:.4g} degrees on this plane",
                       "Its stem or rim would be below the table.", code="stem-below-table",
                       most=np.degrees(angle))  # fmt: skip
    trajectory = motion()
    theta, t = trajectory.theta, trajectory.t
    if theta.max() < angle:
        return trajectory
    first = max(int(np.argmax(theta >= angle)), 1)
    time = float(np.interp(angle, theta[first - 1 : first + 1], t[first - 1 : first + 1]))
    return _until(trajectory, first, time, "stem touches")


def for_reader(error: TopError, scales: Scales) -> TopError:
    """A TopError of tippe_core in what stands beside the controls: degrees, rev/s, s."""
    names = {"theta": ("tilt", 180 / np.pi), "omega3": ("spin", scales.angular_velocity / (2 * np.pi)),
             "times": ("seconds", scales.time)}  # fmt: skip
    name, size = names.get(error.name, (error.name, 1.0))

    value = float(f"{size * error.value:.6g}") if name != error.name and isinstance(error.value, float) else error.value
    numbers: dict[str, Number] = {}
    if "most" in error.numbers:
        numbers["most"] = float(f"{size * error.numbers['most']:.4g}")
    if "t" in error.numbers:
        numbers |= {"t": float(f"{scales.time * error.numbers['t']:.4g}"), "unit": " s"}
    return error.replaced(name, value, **numbers)


def _motion(trajectory: Trajectory, settings: Settings, times: Array, plane: str) -> Motion:
    top, F, n = trajectory.top, trajectory.force, len(trajectory.t)
    code = np.array([{"roll": ROLLS, "slip": SLIPS, "air": FLIES}[word] for word in trajectory.regime])
    if plane == "rough":
        code[F[:, 2] < 0] = LIFTS
    nodal, across, axis, towards = axes(trajectory.theta, trajectory.phi)
    w1, w2, w3 = (component[:, None] for component in trajectory.omega.T)
    frames = [
        trajectory.t, trajectory.quaternion, trajectory.contact, trajectory.com,
        F[:, :1] * nodal + F[:, 1:2] * across + F[:, 2:] * (0, 0, 1), w1 * nodal + w2 * towards + w3 * axis,
        top.I1 * (w1 * nodal + w2 * towards) + top.I3 * w3 * axis, code,
    ]  # fmt: skip
    ended = n < len(times)
    if ended:
        frames = [np.concatenate([rows, rows[-1:]]) for rows in frames]
        frames[0][-1], frames[-1][-2:] = times[-1], ENDS
    t, code = frames[0], frames[-1]
    starts = np.flatnonzero(np.diff(code, prepend=-1))
    stretches = zip(t[starts], np.append(t[starts[1:]], t[-1]), code[starts], strict=True)
    first = next((event for event in trajectory.events if event[1] not in ("sticks", "slips")), (t[-1], ""))
    until, event = first
    if event == "lifts off" and plane == "sliding" and settings.edge and touches(trajectory, until, settings):
        event = THROWN
    last = trajectory.events[-1] if ended and trajectory.events else (t[-1], "")
    return Motion(
        trajectory=trajectory,
        ending=ending(trajectory) if plane == "sliding" else None,
        ended=event if last == first else last[1],
        t=t,
        frames=tuple(frames),
        stretches=tuple((float(start), float(end), int(which)) for start, end, which in stretches),
        drift=MappingProxyType({name: _drift(getattr(trajectory, field)) for name, field in KEPT.items()}),
        alone=(until, event, _drift(trajectory.jellett[trajectory.t <= until])),
    )


def touches(trajectory: Trajectory, time: float, settings: Settings) -> bool:
    """Whether the top is so far tilted at that time, before which it was on its sphere, that the stem touches."""
    before = max(int(np.searchsorted(trajectory.t, time)) - 1, 0)
    theta = trajectory.theta[before] + (time - trajectory.t[before]) * trajectory.omega[before, 0]
    return bool(abs(theta - settings.touch_angle) < NEAR_TOUCH)


def _drift(values: Array) -> float:
    most = np.abs(values).max()
    return float(np.ptp(values) / most) if most else 0.0


# ---- what a person sets ----


def _preset(
    body: str, spin: float, tilt: float, seconds: float, plane: str = "sliding", **law: object
) -> dict[str, Number]:
    start = {"by": "spin", "spin": spin, "tilt": tilt, "slip": 1.0, "seconds": seconds}
    return {"body": body, "plane": plane} | start | law


# Top S as in Rutstam's simulations, arXiv:1306.2470: viscous friction F = -1.0 N v (v in m/s), theta = 0.1, G at rest.
_GAMMA_S = float(Scales(R=0.02, M=0.02).velocity)
_S = {
    name: _preset("Top S", round(spin / (2 * np.pi), 4), 5.73, seconds, law="viscous", gamma=round(_GAMMA_S, 4))
    for name, spin, seconds in (("fast", 90, 10.0), ("hangs", 60, 25.0), ("never", 25, 25.0))
}
PRESETS = {
    "The paper’s top by hand": _preset("The paper's tippe top", 20.0, 10.0, 5.0, law="smoothed", mu=0.3, eps=0.1),
    **{f"Top S {name}": preset for name, preset in _S.items()},
    **{f"no friction: {name}": preset | {"plane": "smooth"} for name, preset in _S.items()},
    "An ordinary top rises": _preset("Wooden cone", 20.0, 15.0, 6.0, law="viscous", gamma=0.3),
}
"""{name: the body, one of tippe_core.PRESETS, and inputs of Planes}."""


class Planes(param.Parameterized):
    """The controls. Several set in one `param.update` make one run, and one `picture` event when it is done.

    builder: a Builder of the explorer. runs: the page's Runs; of several asked for while one is under way only the
    newest is made.
    """

    plane: param.Selector[str] = param.Selector(
        default="sliding", objects=[*PLANES, "compare"], doc="what is looked at; computes nothing"
    )
    by: param.Selector[str] = param.Selector(
        default="spin", objects=["spin", "constants"], doc="how the start is given"
    )
    spin = param.Number(20.0, doc="omega_3 at the start, rev/s")
    tilt = param.Number(10.0, doc="theta at the start, degrees")
    slip = param.Number(1.0, doc="slip at the start, of what it is with G at rest")
    law: param.Selector[str] = param.Selector(
        default="smoothed", objects=list(LAWS), doc="the law of friction of the sliding plane"
    )
    mu_k = param.Number(0.3, doc="coefficient of sliding friction (Coulomb)")
    mu_s = param.Number(0.4, doc="coefficient of static friction (Coulomb)")
    gamma = param.Number(0.3, doc="viscous friction, in (gR)^-1/2")
    mu = param.Number(0.3, doc="coefficient of smoothed friction")
    eps = param.Number(0.1, doc="slip at which smoothed friction is 0.7 of its full size, in (gR)^1/2")
    landing: param.Selector[str] = param.Selector(
        default="plastic", objects=["stop", "plastic"], doc="what follows where it lifts off"
    )
    stem = param.Boolean(True, doc="whether the stem can touch the table")
    seconds = param.Number(5.0, doc="how long a time is computed, s of the real top")
    busy = param.Boolean(False, constant=True, doc="whether a run is under way")
    picture = param.ClassSelector(class_=Picture, constant=True, doc="the last solution; None before the first")

    FRICTION = ("law", "mu_k", "mu_s", "gamma", "mu", "eps")
    INPUTS = ("by", "spin", "tilt", "slip", *FRICTION, "landing", "stem", "seconds")

    def __init__(self, explorer: Explorer, builder: Builder, runs: Runs | None = None) -> None:
        self._explorer, self._builder, self._runs = explorer, builder, runs or Runs()
        self._run: Run | None = None
        self._beside: Run | None = None
        self._wanted: Settings | None = None
        self._told_to_stop = False
        super().__init__()  # type: ignore[no-untyped-call]  # of param

    def choose(self, name: str) -> None:
        """A preset: the body, thrown anew, and the start."""
        inputs = dict(PRESETS[name])
        self._builder.choose(inputs.pop("body"))
        self.param.update(**inputs)
        self.follow()

    def follow(self, _scene: object = None) -> None:
        """Runs again if the explorer's top, or the motion chosen there, is another than the one last asked for; when
        what is set together with it is set too, as by an undo."""
        self._runs.post(self._follow)

    def _follow(self) -> None:
        asked, now = self._asked, self._settings()
        same = (asked.top, asked.scales, asked.shape, asked.rolling) == (now.top, now.scales, now.shape, now.rolling)
        if not same:
            self._ask()

    @property
    def elapsed(self) -> float:
        """How long the present run has taken, s; 0 without one."""
        return self._run.elapsed if self._run else 0.0

    @property
    def share(self) -> float:
        """How much of the present run is done, 0 to 1."""
        return min(1.0, self._reached / self._running.seconds) if self._run else 1.0

    @property
    def _reached(self) -> float:
        """s of the real top."""
        return self._run.reached * self._running.scales.time if self._run else 0.0

    def stop(self) -> None:
        """Ends the present run; the last picture stays, with a sentence."""
        self._wanted = None
        if self._run:
            self._told_to_stop = True
            self._run.stop()

    def _settings(self) -> Settings:
        scene = self._explorer.scene
        rolling = None
        if self.by == "constants":
            start, a = scene.state, scene.top.a
            s, c = np.sin(start.theta), np.cos(start.theta)
            vx, vy = start.omega2 * (c - a) - start.omega3 * s, -start.theta_dot * (1 - a * c)
            rolling = replace(start, phi=0.0, psi=0.0, vx=float(vx), vy=float(vy))
        inputs = {name: getattr(self, name) for name in self.INPUTS if name != "by"}
        return Settings(
            top=scene.top, scales=scene.scales, shape=scene.shape, profile=scene.profile, rolling=rolling, **inputs
        )

    @param.depends(*INPUTS, watch=True, on_init=True)
    def _ask(self) -> None:
        self._asked = settings = self._settings()
        if self._beside:
            self._beside.forget()
        if not self._runs.beside:
            self._runs.begin(Run(lambda run: solve(settings), partial(self._publish, settings)), "planes")
            return
        self._wanted = settings
        if self._run is None:
            self._begin(settings)
        elif self._run.elapsed > PATIENCE:
            self._run.stop()

    def _begin(self, settings: Settings) -> None:
        self._running, self._wanted, self._told_to_stop = settings, None, False
        with param.edit_constant(self):
            self.busy = True
        self._run = Run(lambda run: solve(settings, run.look), self._done)
        self._runs.begin(self._run, "planes")

    def _done(self, result: Result) -> None:
        settings, reached, told_to_stop = self._running, self._reached, self._told_to_stop
        self._run = None
        if self._wanted is not None:
            self._begin(self._wanted)
        else:
            with param.edit_constant(self):
                self.busy = False
        if isinstance(result, Stopped) and not told_to_stop:
            return
        self._publish(settings, result, reached)

    def _publish(self, settings: Settings, result: Result, reached: float = 0.0) -> None:
        messages = {}
        if isinstance(result, Stopped):
            messages["run"] = say("planes.run.stopped", reached=reached)
        elif isinstance(result, TopError):
            error = for_reader(result, settings.scales)
            name = "law" if error.name == "friction" else error.name
            hidden = settings.rolling is not None and name in ("spin", "tilt", "slip")
            messages["by" if hidden else name] = told(error)
        elif isinstance(result, Exception):
            raise result
        if messages:
            if self.picture is None:
                return
            result = replace(self.picture, messages=MappingProxyType(messages))
        with param.edit_constant(self):
            self.picture = result
        if not messages and self._runs.beside and not self.busy and _hits(result):
            self._beside = Run(lambda run: nudged(result, run.look), partial(self._nudged, result))
            self._runs.begin(self._beside, "nudged")

    def _nudged(self, picture: Picture, growth: object) -> None:
        """What the run beside the run tells of it, if that is still what is shown."""
        if isinstance(growth, float) and self.picture is not None and self.picture.motions is picture.motions:
            with param.edit_constant(self):
                self.picture = replace(self.picture, growth=growth)


def _hits(picture: Picture) -> bool:
    """Whether anything but its ball touched, which is what makes a motion depend on the last digit of its start."""
    motion = picture.motions["sliding"]
    return motion is not None and motion.ending is not None and len(motion.ending.stretches) > 1
