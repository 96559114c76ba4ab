"""What a run starts from: a body on the tables, and how it is let go."""

from dataclasses import dataclass
from types import MappingProxyType
from typing import ClassVar, TypeAlias

import numpy as np

from app.model.bodies import outline, second_part
from tippe_core import PRESETS, Friction, Preset, Scales, Shape, State, Top, TopError, Viscous
from tippe_core.types import Array, Rim

TABLES = ("ordinary", "rough", "ice")
LAWS = ("contact", "coulomb", "viscous", "smoothed")
TOYS: MappingProxyType[str, Preset] = MappingProxyType({preset.name: preset for preset in PRESETS})
PATCH = 0.5  # mm: the default radius of the contact patch

MOST_SECONDS = 60.0
# A frame turns the top by at most MOST_TURN rad, or FARTHEST_TURN if that would take more than MOST_FRAMES.
MOST_TURN, MOST_FRAMES, FARTHEST_TURN = 0.3, 16_000, 1.0
LEAST_FRAMES = 600

Toy: TypeAlias = str | Shape
"""The name of one of TOYS, or a body of the visitor's own."""


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
    def is_frictionless(self) -> bool:
        """Whether its law is that of no friction at all."""
        return isinstance(self.friction, Viscous) and self.friction.gamma == 0

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


def shape_of(toy: Toy) -> Shape:
    """The body of a toy."""
    return TOYS[toy].shape if isinstance(toy, str) else toy


def toy_of(shape: Shape, top: Top) -> Toy:
    """The name in TOYS of the toy with this body and this top; if there is none, the body."""
    return next((name for name, preset in TOYS.items() if preset.shape == shape and preset.top == top), shape)
