"""The start of one top: everything that a person sets, each quantity once, whatever view shows it."""

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from types import MappingProxyType
from typing import Any

import numpy as np

from app.model import arrival
from app.model.bodies import fits
from app.model.region import Upper
from app.model.setup import MOST_SECONDS, OF_LAW, ON, PATCH, SECONDS, TOYS, Push, Setup, Toy, by_hand, toy_of
from app.model.setup import TABLES as EACH
from tippe_core import Shape, State, Top, TopError, TruncatedSphere
from tippe_core.paper import rolling_velocity

PAPERS = TruncatedSphere.paper()
TABLES = (*EACH, "three")
NUMBERS = tuple(dict.fromkeys(name for names in OF_LAW.values() for name in names))
GIVEN = MappingProxyType({
    "state": ("theta", "theta_dot", "omega2", "omega3", "phi", "psi"), "hand": ("spin", "tilt", "slip"),
    "E": ("K_J", "K_R", "E"), "share": ("K_J", "K_R", "energy"),
})  # fmt: skip
"""{way in which a motion is given: its inputs}. K_J and K_R: Jellett's and Routh's constant, in (g/R)^1/2 and
(MR^2)^1/2 (g/R)^1/2; energy: 0 the steady precession, 1 the limit of friction, 2 the limit F_z = 0; E: the energy
itself, in MgR; theta to psi: the motion at t = 0, in rad and (g/R)^1/2; spin (rev/s), tilt (degrees) and slip: of a
start by hand, as in by_hand()."""
USUAL = MappingProxyType(
    {"K_J": 7.0, "K_R": 10.0, "energy": 0.9, "E": 0.0, "spin": 20.0, "tilt": 10.0, "slip": 1.0}
    | dict.fromkeys(GIVEN["state"], 0.0)
)
"""{input of a motion: its default}."""
SEEN = "table", "upper", "limit"
"""How it is watched: another of these is not another start."""


@dataclass(frozen=True, kw_only=True)
class Start:
    """The start of which each page has one.

    shape: the body; a, I1, I3: those of the top, set with it. given: one of GIVEN; motion: its inputs, in that order:
    that of a hand with G at rest unless slip says otherwise, or a rolling motion. mu, mu_s: coefficients of sliding and
    of static friction; None: the same. law: that of the ordinary table, with gamma, eps, patch as in a Setup. landing:
    what happens after it lifts off, "stop" or "plastic"; stem: whether it can touch the table. pushes: in the order of
    their times. table: the one on which it is watched; upper, limit: which part of the (K_J, theta) plane is shown, and
    for which limit, "lift-off" or "slip", Fig. 5 is drawn.
    """

    shape: Shape = PAPERS
    a: float = 0.070
    I1: float = 0.399
    I3: float = 0.408
    given: str = "share"
    motion: tuple[float, ...] = tuple(USUAL[name] for name in GIVEN["share"])
    mu_s: float | None = 0.5
    mu: float = 0.3
    law: str = "smoothed"
    gamma: float = 0.3
    eps: float = 0.1
    patch: float = PATCH
    landing: str = "plastic"
    stem: bool = True
    pushes: tuple[Push, ...] = ()
    table: str = "ordinary"
    upper: Upper = True
    limit: str = "lift-off"

    @property
    def inputs(self) -> dict[str, Any]:
        """{input: value}, enough to set it again."""
        fields = {name: value for name, value in vars(self).items() if name != "motion"}
        return fields | dict(zip(GIVEN[self.given], self.motion, strict=True))

    @property
    def put_back(self) -> dict[str, Any]:
        """Of the inputs, those of the top, its motion, its table and the law: enough to do the same again."""
        others = {*NUMBERS, "landing", "stem", *SEEN[1:]} - {*OF_LAW[self.law]}
        return {name: value for name, value in self.inputs.items() if name not in others}

    def changed(self, follows: Mapping[str, Any], **inputs: Any) -> "Start":
        """The start with these inputs. That of GIVEN of which one changes determines the motion from now on, unless
        `given` is said; its others are as they follow from the motion so far, {input: value}. A push belongs to one
        motion: it is forgotten when that changes, unless pushes are said."""
        before = {**follows, **self.inputs}
        new = {name for name, value in inputs.items() if value != before[name]}
        way = next((way for way, names in GIVEN.items() if new & {*names} and (way != "E" or way in new)), self.given)
        given, after = inputs.get("given", way), before | inputs
        motion = tuple(after[name] for name in GIVEN[given])
        named = {name: value for name, value in inputs.items() if name not in USUAL}
        start = replace(self, **named | {"given": given, "motion": motion})
        same = replace(start, **{name: getattr(self, name) for name in SEEN}) == self
        return start if same or "pushes" in inputs else replace(start, pushes=())

    @property
    def static(self) -> float:
        """The coefficient of static friction."""
        return max(self.mu, 0.0) if self.mu_s is None else self.mu_s

    @property
    def top(self) -> Top:
        """Raises TopError if no top has these a, I1 and I3."""
        return Top(self.a, self.I1, self.I3)

    @property
    def body(self) -> tuple[Shape, float, float, float]:
        """What determines its toy."""
        return self.shape, self.a, self.I1, self.I3

    @property
    def toy(self) -> Toy:
        """The body's name in TOYS; otherwise the body itself, or a sphere or a Top with these a, I1 and I3."""
        try:
            top = self.top
        except TopError:  # reported where it matters
            return toy_of(self.shape, self.shape.top, self.shape.scales)
        return toy_of(self.shape if fits(self.shape, top) else None, top, self.shape.scales)

    @property
    def of_rolling(self) -> tuple[object, ...]:
        """All that its rolling motion, and what is shown of that, depends on."""
        return *self.body, self.given, self.motion, self.static, self.upper, self.limit

    @property
    def at_rest(self) -> bool:
        """Whether it is released with G at rest."""
        return self.given == "hand" and self.motion[-1] == 1

    @property
    def let_go(self) -> State | None:
        """The State at t = 0 of a start by hand, before any table has gripped it."""
        if self.given != "hand":
            return None
        spin, tilt, slip = self.motion
        return by_hand(spin, tilt, slip, self.shape.scales)

    def setup(self, rolling: State) -> Setup:
        """All that its runs depend on; rolling: its motion at t = 0 unless a hand lets it go. Raises TopError."""
        top, shape = self.top, self.shape
        turns, by_a_hand = shape.scales.angular_velocity / (2 * np.pi), self.given == "hand"
        motion = self.motion if by_a_hand else (rolling.omega3 * turns, float(np.degrees(rolling.theta)), 1.0)
        spin, tilt, slip = motion
        return Setup(
            top=top, scales=shape.scales, shape=shape if fits(shape, top) else None, mu_s=self.static,
            spin=spin, tilt=tilt, slip=slip, rolling=None if by_a_hand else rolling,
            seconds=min(max([SECONDS, *(push.t + ON for push in self.pushes[-1:])]), MOST_SECONDS),
            **{name: getattr(self, name) for name in OF_RUN},
        )  # fmt: skip


OF_RUN = ("law", "mu", "gamma", "eps", "patch", "landing", "stem", "pushes")
DEFAULTS = MappingProxyType({field.name: field.default for field in fields(Start)} | USUAL)
"""{input: its default}."""


def rolls(state: State, top: Top) -> State:
    """A rolling State that starts at the origin, with the velocity of G made explicit."""
    s, c = np.sin(state.theta), np.cos(state.theta)
    vx, vy = rolling_velocity(c, s, state.theta_dot, state.omega2, state.omega3, top)
    return replace(state, phi=0.0, psi=0.0, vx=float(vx), vy=float(vy))


def of_toy(toy: Toy) -> dict[str, Any]:
    """{input of a Start: value} for the body of a toy."""
    preset = TOYS[toy] if isinstance(toy, str) else None
    shape = preset.shape if preset else toy
    assert isinstance(shape, Shape)
    top = preset.top if preset else shape.top
    return {"shape": shape, "a": top.a, "I1": top.I1, "I3": top.I3}


def arrives() -> dict[str, Any]:
    """{input of a Start: value} of the arrival, where it differs from the default."""
    return of_toy(arrival.TOY) | {
        "given": "hand", "spin": arrival.SPIN, "tilt": arrival.TILT, "mu": arrival.MU, "mu_s": None,
        "law": "contact",
    }  # fmt: skip
