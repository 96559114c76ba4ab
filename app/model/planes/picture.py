"""One frozen Picture: one top on all three planes, and the Settings from which it was computed.

In units of R, M and g, except for what a person sets: rev/s, degrees, s.
"""

from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any, ClassVar

import numpy as np

from app.model.bodies import outline, second_part
from tippe_core import (
    Contensou,
    Coulomb,
    Ending,
    Outcome,
    Scales,
    Shape,
    SmoothedCoulomb,
    State,
    Top,
    TopError,
    Trajectory,
    Viscous,
)
from tippe_core.motion.friction import Friction
from tippe_core.types import Array, Indices, Rim

PLANES = ("rough", "smooth", "sliding")
LAWS = ("contact", "coulomb", "viscous", "smoothed")
SET = ("spin", "tilt", "slip", "law", "mu", "mu_s", "gamma", "eps", "patch", "landing", "stem", "seconds")
BY = {True: "spin", False: "constants"}
KEPT = {"J": "jellett", "Routh": "routh", "E": "energy", "L_3": "L_3", "L_z": "L_z"}

MOST_SECONDS = 60.0
# A frame turns the top by MOST_TURN rad at most, unless that takes more than MOST_FRAMES; by FARTHEST_TURN it may not.
MOST_TURN, MOST_FRAMES, FARTHEST_TURN = 0.3, 16_000, 1.0
LEAST_FRAMES = 600
NEAR_TOUCH = 0.02  # rad: so near to the touch angle a lift-off is the touch's
SHORT = 0.05  # s of the real top: a touch, or a hop, that an eye does not follow
RTOL = 1e-9  # of slide()


@dataclass(frozen=True, eq=False, kw_only=True)
class Setup:
    """A body on the tables, in the form that a run needs. shape: None if a, I1 and I3 are not those of the body."""

    most_turn: ClassVar[float] = MOST_TURN

    top: Top
    scales: Scales
    shape: Shape | None
    profile: Array
    landing: str
    stem: bool
    seconds: float

    @property
    def turns(self) -> float:
        """rev/s in one unit of angular velocity."""
        return self.scales.angular_velocity / (2 * np.pi)

    @property
    def friction(self) -> Friction:
        """The law of the table on which it slides."""
        raise NotImplementedError

    @property
    def state(self) -> State:
        """The State at t = 0."""
        raise NotImplementedError

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
    def drawn(self) -> Array:
        """The outline that is drawn, as profile: of the ball alone where the stem takes no part and might go into the
        table."""
        alone = self.shape is not None and self.shape.touch_angle is not None and self.edge is None
        return outline(self.top) if alone else self.profile

    @property
    def part(self) -> str:
        """What touches beside the ball, "stem" or "rim"."""
        return second_part(self.shape)

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
        frames = np.clip(np.ceil(end * fastest / self.most_turn), LEAST_FRAMES, MOST_FRAMES)
        return np.linspace(0, end, int(frames) + 1)


@dataclass(frozen=True, eq=False, kw_only=True)
class Settings(Setup):
    """Everything on which a run of the three planes depends. rolling: the State given by constants of the motion; None
    if spin and tilt are given."""

    rolling: State | None
    spin: float
    tilt: float
    slip: float
    law: str
    mu: float
    mu_s: float
    gamma: float
    eps: float
    patch: float = 0.5  # mm

    @property
    def inputs(self) -> MappingProxyType[str, Any]:
        """What a person set, by the names of the Planes."""
        return MappingProxyType({name: getattr(self, name) for name in SET} | {"by": BY[self.rolling is None]})

    @property
    def friction(self) -> Friction:
        if self.law == "viscous":
            return Viscous(self.gamma)
        if self.law == "contact":
            return Contensou(self.mu, 1e-3 * self.patch / self.scales.R)
        return SmoothedCoulomb(self.mu, self.eps) if self.law == "smoothed" else Coulomb(self.mu, self.mu_s)

    @property
    def state(self) -> State:
        """The State at t = 0, before any table grips it."""
        return self.rolling or by_hand(self.spin, self.tilt, self.slip, self.scales)


def by_hand(spin: float, tilt: float, slip: float, scales: Scales) -> State:
    """The State of a top that a hand lets go: spin in rev/s, tilt in degrees. slip 1: G at rest; 0: G moves as rolling
    needs; in between and beyond in proportion. Raises TopError, whose name is an input."""
    if not 0 <= tilt <= 180:
        raise TopError("tilt", tilt, "0 <= tilt <= 180 (°)")
    for name, value in (("spin", spin), ("slip", slip)):
        if not np.isfinite(value):
            raise TopError(name, value, "a finite number", code="not-finite")
    theta, omega3 = float(np.radians(tilt)), 2 * np.pi * spin / scales.angular_velocity
    return State(theta, 0.0, 0.0, omega3, vx=-(1 - slip) * omega3 * np.sin(theta), vy=0.0)


@dataclass(frozen=True, eq=False, kw_only=True)
class Motion:
    """One top on one plane. trajectory: as far as it goes; ended: the event that it stopped at, or "".

    t (n,) to the end asked for: where the trajectory ends earlier, its last row stands once more at the end. frames:
    the arguments of top3d.pack_frames. stretches: (start, end, one of regimes.py) in turn. drift: of KEPT, the largest
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


@dataclass(frozen=True, eq=False, kw_only=True)
class Picture:
    """All that the views show. motions: {plane: Motion or None}; None: the sentence why is in messages at the plane.

    outcome: of the ball alone. growth: how many times NUDGE grew in the run beside the sliding one, None without that.
    inputs: what is set in the Planes, by their names. messages: a sentence for each control that was given what cannot
    be, "run" for a run that was stopped; the rest but for the inputs is then the last good one.
    """

    settings: Settings
    state: State
    friction: Friction
    motions: MappingProxyType[str, Motion | None]
    outcome: Outcome
    inputs: MappingProxyType[str, Any]
    growth: float | None = None
    messages: MappingProxyType[str, str] = field(default_factory=lambda: MappingProxyType({}))

    @property
    def turns(self) -> float:
        """The spin of the start, rev/s."""
        return self.state.omega3 * self.settings.turns

    @property
    def slip(self) -> float:
        """The speed of the slip at the start, m/s."""
        state, a = self.state, self.settings.top.a
        s, c = np.sin(state.theta), np.cos(state.theta)
        vx, vy = state.vx or 0.0, state.vy or 0.0
        ux = vx - (state.omega2 * (c - a) - state.omega3 * s)
        uy = vy + state.theta_dot * (1 - a * c)
        return float(self.settings.scales.velocity * np.hypot(ux, uy))
