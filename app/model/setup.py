"""What a run starts from: a body on the tables, how it is let go, and the friction of the ordinary table."""

from dataclasses import dataclass
from functools import cached_property
from types import MappingProxyType
from typing import NamedTuple, TypeAlias

import numpy as np

from app.model.bodies import body, outline, second_part
from tippe_core import (
    PRESETS,
    BareSphere,
    Contensou,
    Coulomb,
    Friction,
    Preset,
    Scales,
    Shape,
    SmoothedCoulomb,
    State,
    Top,
    TopError,
    Viscous,
)
from tippe_core.types import Array, Rim

TABLES = ("ordinary", "rough", "ice")
OF_LAW = MappingProxyType(
    {"contact": ("mu", "patch"), "coulomb": ("mu", "mu_s"), "viscous": ("gamma",), "smoothed": ("mu", "eps")}
)
"""{friction law of the ordinary table: its numbers, by their names in a Setup}."""
LAWS = (*OF_LAW,)
TOYS: MappingProxyType[str, Preset] = MappingProxyType({preset.name: preset for preset in PRESETS})
PATCH = 0.5  # mm: the default radius of the contact patch

SECONDS, MOST_SECONDS = 6.0, 60.0
# A frame turns the top by at most MOST_TURN rad, or FARTHEST_TURN if that would take more than MOST_FRAMES.
MOST_TURN, MOST_FRAMES, FARTHEST_TURN = 0.5, 16_000, 1.0
LEAST_FRAMES = 600

FARTHEST = 2.0  # R: about how far from G a push acts
ON = 4.0  # s: so long a run goes on at least after its last push

Toy: TypeAlias = str | Shape | Top
"""The name of one of TOYS, or a body of the visitor's own; or a Top that no known body has."""


class Push(NamedTuple):
    """A push of a top that moves: at t (s) an impulse (mN s, along x, y, z, which turn with phi) at a point of the body
    (mm from O along 1', 2', 3); of an upright top 1' is x."""

    t: float
    point: tuple[float, float, float]
    impulse: tuple[float, float, float]

    @property
    def size(self) -> float:
        """In mN s."""
        return float(np.linalg.norm(self.impulse))


@dataclass(frozen=True, eq=False, kw_only=True)
class Setup:
    """One start, all that its runs depend on. Two are equal if their runs are: numbers of other laws do not count.

    shape: None if a, I1 and I3 are not those of the body. Let go by a hand with spin (rev/s), tilt (degrees) and slip
    as in by_hand(), or as the State `rolling`. law: one of OF_LAW, with its numbers: mu, mu_s, gamma and eps in R, M
    and g, patch in mm. seconds: how long a run is. pushes: in the order of their times.
    """

    top: Top
    scales: Scales
    shape: Shape | None
    spin: float
    tilt: float
    slip: float = 1.0
    rolling: State | None = None
    law: str = "contact"
    mu: float
    mu_s: float
    gamma: float = 0.0
    eps: float = 0.1
    patch: float = PATCH
    landing: str = "plastic"
    stem: bool = True
    seconds: float = SECONDS
    pushes: tuple[Push, ...] = ()

    @cached_property
    def _key(self) -> tuple[object, ...]:
        let_go = (self.spin, self.tilt, self.slip) if self.rolling is None else self.rolling
        numbers = tuple(getattr(self, name) for name in OF_LAW[self.law])
        run = self.landing, self.stem, self.seconds, self.pushes
        return self.top, self.scales, self.shape, let_go, self.law, numbers, *run

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Setup) and self._key == other._key

    def __hash__(self) -> int:
        return hash(self._key)

    @property
    def toy(self) -> Toy:
        """As of toy_of()."""
        return toy_of(self.shape, self.top, self.scales)

    @cached_property
    def profile(self) -> Array:
        """The outline of the body, or of a stand-in for it."""
        return outline(self.top) if self.shape is None else body(self.shape)

    @property
    def impulse(self) -> float:
        """The impulse M (gR)^1/2, in mN s."""
        return 1e3 * self.scales.M * self.scales.velocity

    @property
    def turns(self) -> float:
        """The spin in rev/s for one unit of angular velocity."""
        return self.scales.angular_velocity / (2 * np.pi)

    @property
    def friction(self) -> Friction:
        """The friction law of the table on which it slides."""
        match self.law:
            case "contact":
                return Contensou(self.mu, 1e-3 * self.patch / self.scales.R)
            case "coulomb":
                return Coulomb(self.mu, self.mu_s)
            case "viscous":
                return Viscous(self.gamma)
        return SmoothedCoulomb(self.mu, self.eps)

    @property
    def is_frictionless(self) -> bool:
        """Whether its law is that of no friction at all."""
        return isinstance(self.friction, Viscous) and self.friction.gamma == 0

    @property
    def state(self) -> State:
        """The State at t = 0, before a table grips it."""
        return self.rolling or by_hand(self.spin, self.tilt, self.slip, self.scales)

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
        fastest += FARTHEST * sum(push.size for push in self.pushes) / self.impulse / min(top.I1, top.I3)
        if end * fastest > FARTHEST_TURN * MOST_FRAMES:
            most = FARTHEST_TURN * MOST_FRAMES / fastest * self.scales.time
            raise TopError("seconds", self.seconds, "at most {most:.3g} s with this spin",
                           "More turns cannot be shown.", code="too-many-turns", most=most)  # fmt: skip
        frames = np.clip(np.ceil(end * fastest / MOST_TURN), LEAST_FRAMES, MOST_FRAMES)
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


def start_of(
    toy: Toy, spin: float, tilt: float, mu: float, rolling: State | None = None, patch: float = PATCH
) -> Setup:
    """The Setup of a toy on a real contact."""
    shape = shape_of(toy)
    top = TOYS[toy].top if isinstance(toy, str) else shape.top
    return Setup(top=top, scales=shape.scales, shape=shape, spin=spin, tilt=tilt, rolling=rolling, mu=mu, mu_s=mu,
                 patch=patch)  # fmt: skip


def shape_of(toy: Toy) -> Shape:
    """The body of a toy that has one."""
    assert not isinstance(toy, Top)
    return TOYS[toy].shape if isinstance(toy, str) else toy


def toy_of(shape: Shape | None, top: Top, scales: Scales) -> Toy:
    """The name in TOYS of the toy with this body and this top, otherwise the body; without one, a sphere of these
    scales with these a, I1 and I3, if there is one."""
    if shape is not None:
        return next((name for name, preset in TOYS.items() if preset.shape == shape and preset.top == top), shape)
    try:
        return BareSphere(R=scales.R, M=scales.M, a=top.a, I1=top.I1, I3=top.I3)
    except TopError:
        return top
