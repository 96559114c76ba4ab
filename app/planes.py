"""The view-model of the three planes: a start and a law of friction -> one frozen Picture of one top on all three.

It computes and publishes, and knows no widgets. In units of R, M and g but for what a person sets: rev/s, degrees, s.
A run is made in a thread, which has no page: it is told in which language to say why there is no motion.
"""

from dataclasses import dataclass, field, replace
from functools import partial
from types import MappingProxyType

import numpy as np
import param

from app.explorer import axes
from app.runs import Run, Runs, Stopped
from app.text import say, told
from tippe_core import (
    Coulomb,
    Outcome,
    Scales,
    Shape,
    SmoothedCoulomb,
    State,
    Top,
    TopError,
    Viscous,
    glide,
    jellett_potential,
    outcome,
    roll,
    slide,
)

PLANES = ("rough", "smooth", "sliding")
LAWS = ("coulomb", "viscous", "smoothed")
# Places in top3d.REGIMES
ROLLS, LIFTS, SLIPS, FLIES, ENDS = 0, 2, 3, 4, 5
KEPT = {"J": "jellett", "Routh": "routh", "E": "energy", "L_3": "L_3", "L_z": "L_z"}

MOST_SECONDS = 60.0
# A frame turns the top by MOST_TURN rad at most, unless that takes more than MOST_FRAMES; by FARTHEST_TURN it may not.
MOST_TURN, MOST_FRAMES, FARTHEST_TURN = 0.3, 16_000, 1.0
LEAST_FRAMES = 600
THROWN, NEAR_TOUCH = "stem throws it up", 0.02  # rad: so near to the touch angle a lift-off is the touch's
WELL_POINTS = 361

# A run that a newer one replaces may still finish within this, s; later it is stopped.
PATIENCE = 0.5


@dataclass(frozen=True, eq=False, kw_only=True)
class Settings:
    """All that a run depends on. rolling: the State that the constants chosen for rolling give; None: spin and tilt
    are given. shape: None where a, I1 and I3 are not its own."""

    top: Top
    scales: Scales
    shape: Shape | None
    profile: np.ndarray
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
    def friction(self):
        if self.law == "viscous":
            return Viscous(self.gamma)
        return SmoothedCoulomb(self.mu, self.eps) if self.law == "smoothed" else Coulomb(self.mu_k, self.mu_s)

    @property
    def edge(self):
        """The stem's edge where it takes part."""
        return self.shape.edge if self.stem and self.shape is not None else None

    @property
    def state(self):
        """The State at t = 0. slip 1: G at rest; 0: G moves as rolling needs; in between and beyond in proportion."""
        if self.rolling is not None:
            return self.rolling
        if not 0 <= self.tilt <= 180:
            raise TopError("tilt", self.tilt, "0 to 180 degrees")
        for name in ("spin", "slip"):
            if not np.isfinite(getattr(self, name)):
                raise TopError(name, getattr(self, name), "a finite number")
        theta = float(np.radians(self.tilt))
        spin = 2 * np.pi * self.spin / self.scales.angular_velocity
        return State(theta, 0.0, 0.0, spin, vx=-(1 - self.slip) * spin * np.sin(theta), vy=0.0)

    @property
    def times(self):
        """(n,), short enough a step that the top turns little in it."""
        if not 0 < self.seconds <= MOST_SECONDS:
            raise TopError("seconds", self.seconds, f"more than 0, at most {MOST_SECONDS:g} s")
        start, end = self.state, self.seconds / self.scales.time
        top = self.top
        kinetic = top.I1 * (start.theta_dot**2 + start.omega2**2) + top.I3 * start.omega3**2
        fastest = np.sqrt((kinetic + start.vx**2 + start.vy**2 + 4 * abs(top.a)) / min(top.I1, top.I3))
        if end * fastest > FARTHEST_TURN * MOST_FRAMES:
            most = FARTHEST_TURN * MOST_FRAMES / fastest * self.scales.time
            raise TopError("seconds", self.seconds, f"at most {most:.3g} s with this spin",
                           "More turns than that are too many to show.")  # fmt: skip
        frames = np.clip(np.ceil(end * fastest / MOST_TURN), LEAST_FRAMES, MOST_FRAMES)
        return np.linspace(0, end, int(frames) + 1)


@dataclass(frozen=True, eq=False, kw_only=True)
class Motion:
    """One top on one plane. trajectory: as far as it goes; ended: the event that it stopped at, or "".

    t (n,) to the end asked for: where the trajectory ends earlier, its last row stands once more at the end. frames:
    the arguments of top3d.pack_frames. stretches: (start, end, place in REGIMES) in turn. drift: of KEPT, the largest
    difference between two instants, over the largest size; alone: the time to which the sphere alone is on the table,
    what ends that ("" if nothing), and the drift of J until then, which no more than one contact keeps. The events have
    tippe_core's names, but THROWN where the stem's first touch is what lifts it off.
    """

    trajectory: object
    ended: str
    t: np.ndarray
    frames: tuple
    stretches: tuple
    drift: MappingProxyType
    alone: tuple

    @property
    def slip(self):
        """The slip speed, (n,)."""
        return np.hypot(*self.trajectory.slip.T)

    @property
    def ledger(self):
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
    def overturned(self):
        """The time at which theta first passes a right angle, nan if it never does, or started past it."""
        theta, t = self.trajectory.theta, self.trajectory.t
        past = int(np.argmax(theta > np.pi / 2))
        if not past:
            return np.nan
        return float(np.interp(np.pi / 2, theta[past - 1 : past + 1], t[past - 1 : past + 1]))


@dataclass(frozen=True, eq=False, kw_only=True)
class Picture:
    """All that the views show. motions: {plane: Motion or None}; None: the sentence why is in messages at the plane.

    theta, V_J (k,): the well at the start's C_J. messages: a sentence for each control that was given what cannot be,
    "run" for a run that was stopped; the rest is then the last good one.
    """

    settings: Settings
    state: State
    friction: object
    motions: MappingProxyType
    outcome: Outcome
    theta: np.ndarray
    V_J: np.ndarray
    messages: MappingProxyType = field(default_factory=lambda: MappingProxyType({}))


def solve(settings, progress=None):
    """The Picture. progress: called with the time reached; what it raises stops the run. Raises TopError, whose name is
    the input at fault."""
    top, state, friction, times = settings.top, settings.state, settings.friction, settings.times
    runs = {
        "rough": lambda: roll(top, None, times, replace(state, vx=None, vy=None)),
        "smooth": lambda: glide(top, state, times),
        "sliding": lambda: slide(
            top, state, friction, times, landing=settings.landing, edge=settings.edge, progress=progress
        ),
    }
    motions, messages = {}, {}
    for plane in PLANES:
        try:
            motions[plane] = _motion(runs[plane](), settings, times, plane)
        except TopError as error:
            if plane == "sliding":
                raise
            motions[plane], messages[plane] = None, told(error)
    goes = outcome(top, state, settings.scales)
    theta = np.linspace(0, np.pi, WELL_POINTS)
    return Picture(
        settings=settings, state=state, friction=friction, motions=MappingProxyType(motions), outcome=goes, theta=theta,
        V_J=jellett_potential(theta, top, goes.C_J), messages=MappingProxyType(messages),
    )  # fmt: skip


def _motion(trajectory, settings, times, plane):
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
    if event == "lifts off" and plane == "sliding" and settings.edge and _touches(trajectory, until, settings):
        event = THROWN
    last = trajectory.events[-1] if ended and trajectory.events else (t[-1], "")
    return Motion(
        trajectory=trajectory,
        ended=event if last == first else last[1],
        t=t,
        frames=tuple(frames),
        stretches=tuple((float(start), float(end), int(which)) for start, end, which in stretches),
        drift=MappingProxyType({name: _drift(getattr(trajectory, field)) for name, field in KEPT.items()}),
        alone=(until, event, _drift(trajectory.jellett[trajectory.t <= until])),
    )


def _touches(trajectory, time, settings):
    """Whether the top is so far tilted at that time, before which it was on its sphere, that the stem touches."""
    before = max(int(np.searchsorted(trajectory.t, time)) - 1, 0)
    theta = trajectory.theta[before] + (time - trajectory.t[before]) * trajectory.omega[before, 0]
    return abs(theta - settings.shape.touch_angle) < NEAR_TOUCH


def _drift(values):
    most = np.abs(values).max()
    return float(np.ptp(values) / most) if most else 0.0


# ---- what a person sets ----


def _preset(body, spin, tilt, seconds, plane="sliding", **law):
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

    plane = param.Selector(default="sliding", objects=[*PLANES, "compare"], doc="what is looked at; computes nothing")
    by = param.Selector(default="spin", objects=["spin", "constants"], doc="how the start is given")
    spin = param.Number(20.0, doc="omega_3 at the start, rev/s")
    tilt = param.Number(10.0, doc="theta at the start, degrees")
    slip = param.Number(1.0, doc="slip at the start, of what it is with G at rest")
    law = param.Selector(default="smoothed", objects=list(LAWS), doc="the law of friction of the sliding plane")
    mu_k = param.Number(0.3, doc="coefficient of sliding friction (Coulomb)")
    mu_s = param.Number(0.4, doc="coefficient of static friction (Coulomb)")
    gamma = param.Number(0.3, doc="viscous friction, in (gR)^-1/2")
    mu = param.Number(0.3, doc="coefficient of smoothed friction")
    eps = param.Number(0.1, doc="slip at which smoothed friction is 0.7 of its full size, in (gR)^1/2")
    landing = param.Selector(default="plastic", objects=["stop", "plastic"], doc="what follows where it lifts off")
    stem = param.Boolean(True, doc="whether the stem can touch the table")
    seconds = param.Number(5.0, doc="how long a time is computed, s of the real top")
    busy = param.Boolean(False, constant=True, doc="whether a run is under way")
    picture = param.ClassSelector(class_=Picture, constant=True, doc="the last solution; None before the first")

    FRICTION = ("law", "mu_k", "mu_s", "gamma", "mu", "eps")
    INPUTS = ("by", "spin", "tilt", "slip", *FRICTION, "landing", "stem", "seconds")

    def __init__(self, explorer, builder, runs=None):
        self._explorer, self._builder, self._runs = explorer, builder, runs or Runs()
        self._run = self._wanted = None
        self._told_to_stop = False
        super().__init__()

    def choose(self, name):
        """A preset: the body, thrown anew, and the start."""
        inputs = dict(PRESETS[name])
        self._builder.choose(inputs.pop("body"))
        self.param.update(**inputs)
        self.follow()

    def follow(self, _scene=None):
        """Runs again if the explorer's top, or the motion chosen there, is another than the one last asked for; when
        what is set together with it is set too, as by an undo."""
        self._runs.post(self._follow)

    def _follow(self):
        asked, now = self._asked, self._settings()
        same = (asked.top, asked.scales, asked.shape, asked.rolling) == (now.top, now.scales, now.shape, now.rolling)
        if not same:
            self._ask()

    @property
    def elapsed(self):
        """How long the present run has taken, s; 0 without one."""
        return self._run.elapsed if self._run else 0.0

    @property
    def share(self):
        """How much of the present run is done, 0 to 1."""
        return min(1.0, self._reached / self._running.seconds) if self._run else 1.0

    @property
    def _reached(self):
        """s of the real top."""
        return self._run.reached * self._running.scales.time

    def stop(self):
        """Ends the present run; the last picture stays, with a sentence."""
        self._wanted = None
        if self._run:
            self._told_to_stop = True
            self._run.stop()

    def _settings(self):
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
    def _ask(self):
        self._asked = settings = self._settings()
        if not self._runs.beside:
            self._runs.begin(Run(lambda run: solve(settings), partial(self._publish, settings)), "planes")
            return
        self._wanted = settings
        if self._run is None:
            self._begin()
        elif self._run.elapsed > PATIENCE:
            self._run.stop()

    def _begin(self):
        self._running, self._wanted, self._told_to_stop = self._wanted, None, False
        settings = self._running
        with param.edit_constant(self):
            self.busy = True
        self._run = Run(lambda run: solve(settings, run.look), self._done)
        self._runs.begin(self._run, "planes")

    def _done(self, result):
        settings, reached, told_to_stop = self._running, self._reached, self._told_to_stop
        self._run = None
        if self._wanted is not None:
            self._begin()
        else:
            with param.edit_constant(self):
                self.busy = False
        if isinstance(result, Stopped) and not told_to_stop:
            return
        self._publish(settings, result, reached)

    def _publish(self, settings, result, reached=0.0):
        messages = {}
        if isinstance(result, Stopped):
            messages["run"] = say("planes.run.stopped", reached=reached)
        elif isinstance(result, TopError):
            control = {"theta": "tilt", "omega3": "spin", "times": "seconds", "friction": "law"}
            messages[control.get(result.name, result.name)] = told(result)
        elif isinstance(result, Exception):
            raise result
        if messages:
            if self.picture is None:
                return
            result = replace(self.picture, messages=MappingProxyType(messages))
        with param.edit_constant(self):
            self.picture = result
