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

TABLES = ("ordinary", "rough", "ice")
LAWS = ("contact", "coulomb", "viscous", "smoothed")
SET = ("spin", "tilt", "slip", "law", "mu", "mu_s", "gamma", "eps", "patch", "landing", "stem", "seconds")
BY = {True: "spin", False: "constants"}
KEPT = {"J": "jellett", "Routh": "routh", "E": "energy", "L_3": "L_3", "L_z": "L_z"}

MOST_SECONDS = 60.0
# A frame turns the top by at most MOST_TURN rad, or FARTHEST_TURN if that would take more than MOST_FRAMES.
MOST_TURN, MOST_FRAMES, FARTHEST_TURN = 0.3, 16_000, 1.0
LEAST_FRAMES = 600
NEAR_TOUCH = 0.02  # rad: a lift-off this near to the touch angle counts as caused by the touch
SHORT = 0.05  # s: a touch or hop that is too short to be seen
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
        """The spin in rev/s for one unit of angular velocity."""
        return self.scales.angular_velocity / (2 * np.pi)

    @property
    def friction(self) -> Friction:
        """The friction law of the table on which it slides."""
        raise NotImplementedError

    @property
    def state(self) -> State:
        """The State at t = 0."""
        raise NotImplementedError

    @property
    def edge(self) -> Rim | None:
        """The edge of the stem, if it takes part."""
        return self.shape.edge if self.stem and self.shape is not None else None

    @property
    def touch_angle(self) -> float:
        """The tilt from which that edge touches, inf if none takes part."""
        found = self.shape.touch_angle if self.edge and self.shape else None
        return np.inf if found is None else found

    @property
    def drawn(self) -> Array:
        """The outline that is drawn, like profile: only the ball if the stem takes no part and might go through the
        table."""
        alone = self.shape is not None and self.shape.touch_angle is not None and self.edge is None
        return outline(self.top) if alone else self.profile

    @property
    def part(self) -> str:
        """The part that touches in addition to the ball, "stem" or "rim"."""
        return second_part(self.shape)

    @property
    def times(self) -> Array:
        """(n,), in steps in which the top turns little."""
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
        """The inputs, by their names in the Planes."""
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
        """The State at t = 0, before a table grips it."""
        return self.rolling or by_hand(self.spin, self.tilt, self.slip, self.scales)


def by_hand(spin: float, tilt: float, slip: float, scales: Scales) -> State:
    """The State of a top that is released by hand: spin in rev/s, tilt in degrees. slip = 1: G at rest; slip = 0: G
    moves as in rolling; other values interpolate or extrapolate. Raises TopError, whose name is an input."""
    if not 0 <= tilt <= 180:
        raise TopError("tilt", tilt, "0 <= tilt <= 180 (°)")
    for name, value in (("spin", spin), ("slip", slip)):
        if not np.isfinite(value):
            raise TopError(name, value, "a finite number", code="not-finite")
    theta, omega3 = float(np.radians(tilt)), 2 * np.pi * spin / scales.angular_velocity
    return State(theta, 0.0, 0.0, omega3, vx=-(1 - slip) * omega3 * np.sin(theta), vy=0.0)


@dataclass(frozen=True, eq=False, kw_only=True)
class Motion:
    """One top on one plane. trajectory: as far as it goes; ended: the event at which it stopped, or "".

    t (n,) extends to the requested end: if the trajectory ends earlier, its last row is repeated there. frames: the
    arguments of top3d.pack_frames. stretches: (start, end, one of regimes.py), in order. drift: for each of KEPT, the
    largest difference between two instants relative to the largest value; alone: the time up to which only the sphere
    touches, what ends that ("" if nothing), and the drift of J up to then, which only a single contact conserves.
    Events have tippe_core's names, except THROWN if the stem's first touch lifts the top off. ending: on the sliding
    plane, how the motion ends.
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
    def crossings(self) -> Array:
        """The times at which theta passes a right angle, (k,)."""
        theta, t = self._from_right_angle
        at = np.flatnonzero((theta[:-1] < 0) != (theta[1:] < 0))
        return t[at] + (t[at + 1] - t[at]) * theta[at] / (theta[at] - theta[at + 1])

    @property
    def _from_right_angle(self) -> tuple[Array, Array]:
        """theta minus a right angle, and the time, where that is not 0."""
        theta = self.trajectory.theta - np.pi / 2
        off = np.abs(theta) > 1e-12
        return theta[off], self.trajectory.t[off]

    @property
    def starts_below(self) -> bool:
        """Whether it starts below a right angle, or moves below it from there."""
        return bool(np.all(self._from_right_angle[0][:1] < 0))


@dataclass(frozen=True, eq=False, kw_only=True)
class Picture:
    """Everything that the views show. motions: {plane: Motion or None}; if None, messages has the reason under the
    plane.

    outcome: that of the ball alone. growth: the factor by which NUDGE grew in the disturbed sliding run, None without
    one. inputs: those of the Planes, by name. messages: a sentence for each control whose value was refused, and "run"
    for a run that was stopped; everything but the inputs is then that of the last valid Picture. nearest: {control: the
    nearest possible value}, where it is known.
    """

    settings: Settings
    state: State
    friction: Friction
    motions: MappingProxyType[str, Motion | None]
    outcome: Outcome
    inputs: MappingProxyType[str, Any]
    growth: float | None = None
    messages: MappingProxyType[str, str] = field(default_factory=lambda: MappingProxyType({}))
    nearest: MappingProxyType[str, float] = field(default_factory=lambda: MappingProxyType({}))

    @property
    def is_old(self) -> bool:
        """Whether it is not of its inputs, but of the last ones that gave one."""
        return not {*self.messages} <= {*TABLES}

    @property
    def turns(self) -> float:
        """The spin at the start, rev/s."""
        return self.state.omega3 * self.settings.turns

    @property
    def slip(self) -> float:
        """The slip speed at the start, m/s."""
        state, a = self.state, self.settings.top.a
        s, c = np.sin(state.theta), np.cos(state.theta)
        vx, vy = state.vx or 0.0, state.vy or 0.0
        ux = vx - (state.omega2 * (c - a) - state.omega3 * s)
        uy = vy + state.theta_dot * (1 - a * c)
        return float(self.settings.scales.velocity * np.hypot(ux, uy))
