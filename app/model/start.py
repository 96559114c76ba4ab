"""The start of one top: everything that a person sets, each quantity once, whatever view shows it.

The motion is given by one of the sets in GIVEN: by the spin and tilt of a hand, with G at rest unless slip says
otherwise, or by a rolling motion. The table is the one on which it is watched; changing it does not change the start.
"""

from dataclasses import replace
from types import MappingProxyType
from typing import Any

import numpy as np
import param

from app.model import arrival
from app.model.bodies import fits
from app.model.setup import LAWS, MOST_SECONDS, OF_LAW, ON, PATCH, SECONDS, TOYS, Push, Setup, Toy, by_hand, toy_of
from app.model.setup import TABLES as EACH
from tippe_core import Shape, State, Top, TopError, TruncatedSphere
from tippe_core.paper.equations import rolling_velocity

TABLES = (*EACH, "three")
NUMBERS = tuple(dict.fromkeys(name for names in OF_LAW.values() for name in names))


class Start(param.Parameterized):
    """The start, of which each page has one. Several inputs set in one `param.update` make one new start."""

    # the top
    shape = param.ClassSelector(
        class_=Shape, default=TruncatedSphere.paper(), allow_None=False, doc="the body; a, I1, I3 are set with it"
    )
    a = param.Number(0.070, doc="distance of G below the centre O of the sphere, in R")
    I1 = param.Number(0.399, doc="moment of inertia about an axis through G perpendicular to axis 3, in MR^2")
    I3 = param.Number(0.408, doc="moment of inertia about the axis of symmetry, in MR^2")
    # its motion
    given: param.Selector[str] = param.Selector(
        default="share", objects=["share", "E", "state", "hand"], doc="which set of GIVEN determines the motion"
    )
    K_J = param.Number(7.0, doc="Jellett's constant, in (g/R)^1/2")
    K_R = param.Number(10.0, doc="Routh's constant, in (MR^2)^1/2 (g/R)^1/2")
    energy = param.Number(0.9, doc="0 the steady precession, 1 the limit of friction, 2 the limit F_z = 0")
    E = param.Number(0.0, doc="the energy itself, in MgR")
    theta = param.Number(0.0, doc="the tilt at t = 0, in rad")
    theta_dot = param.Number(0.0, doc="its rate, in (g/R)^1/2")
    omega2 = param.Number(0.0, doc="the angular velocity about 2' at t = 0, in (g/R)^1/2")
    omega3 = param.Number(0.0, doc="the angular velocity about the axis of symmetry at t = 0, in (g/R)^1/2")
    phi = param.Number(0.0, doc="the azimuth of 1' at t = 0, in rad")
    psi = param.Number(0.0, doc="the angle of rotation about the axis of symmetry at t = 0, in rad")
    spin = param.Number(20.0, doc="of a start by hand, about its axis, rev/s")
    tilt = param.Number(10.0, doc="of a start by hand, degrees")
    slip = param.Number(1.0, doc="of a start by hand, relative to that with G at rest")
    # its table
    table: param.Selector[str] = param.Selector(
        default="ordinary", objects=list(TABLES), doc="the table on which it is watched"
    )
    mu_s = param.Number(
        0.5, allow_None=True, doc="coefficient of static friction; None: the same as that of sliding friction"
    )
    mu = param.Number(0.3, doc="coefficient of sliding friction")
    law: param.Selector[str] = param.Selector(
        default="smoothed", objects=list(LAWS), doc="the friction law of the ordinary table"
    )
    gamma = param.Number(0.3, doc="coefficient of viscous friction, in (gR)^-1/2")
    eps = param.Number(0.1, doc="slip at which smoothed friction is 0.7 of its limit, in (gR)^1/2")
    patch = param.Number(PATCH, doc="radius of the patch of a real contact, mm")
    # a run on it
    landing: param.Selector[str] = param.Selector(
        default="plastic", objects=["stop", "plastic"], doc="what happens after it lifts off"
    )
    stem = param.Boolean(True, doc="whether the stem can touch the table")
    pushes: param.Parameter[tuple[Push, ...]] = param.Parameter(
        default=(), doc="what pushes it on its way, in the order of their times; a start that is changed has none"
    )

    GIVEN = MappingProxyType(
        {
            "share": ("K_J", "K_R", "energy"),
            "E": ("K_J", "K_R", "E"),
            "state": ("theta", "theta_dot", "omega2", "omega3", "phi", "psi"),
            "hand": ("spin", "tilt", "slip"),
        }
    )

    _following = False  # whether inputs are being set that follow from others

    def __init__(self, **inputs: Any) -> None:
        super().__init__(**inputs)  # type: ignore[no-untyped-call]  # of param
        of_motion = {name for names in self.GIVEN.values() for name in names} | {"given", "shape", "a", "I1", "I3"}
        self.param.watch(self._anew, [*of_motion, "law", *NUMBERS, "landing", "stem", "pushes"])

    def _anew(self, *events: param.parameterized.Event) -> None:
        """A push belongs to one motion: it is forgotten when that is changed, unless the change itself sets it."""
        if self.pushes and not self._following and all(event.name != "pushes" for event in events):
            self.pushes = ()

    @property
    def set(self) -> dict[str, Any]:
        """{input: value} of the top, of the way its motion is given, and of the table: enough to restore it."""
        body, law = ("shape", "a", "I1", "I3"), ("law", *OF_LAW[self.law])
        names = (*body, "given", *self.GIVEN[self.given], "table", *law, "pushes")
        return {name: getattr(self, name) for name in names}

    def later(self, **inputs: Any) -> None:
        """Sets inputs, like `param.update`."""
        self.param.update(**inputs)

    @property
    def toy(self) -> Toy:
        """The body's name in TOYS; otherwise the body itself, or a sphere or a Top with these a, I1 and I3."""
        try:
            return self.setup.toy
        except TopError:  # no top has these; reported where it matters
            return toy_of(self.shape, self.shape.top)

    @property
    def static(self) -> float:
        """The coefficient of static friction."""
        return max(self.mu, 0.0) if self.mu_s is None else self.mu_s

    @property
    def setup(self) -> Setup:
        """All that its runs depend on; raises TopError if no top has these a, I1 and I3."""
        top, shape = Top(self.a, self.I1, self.I3), self.shape
        names = ("spin", "tilt", "slip", "law", "mu", "gamma", "eps", "patch", "landing", "stem")
        return Setup(
            top=top, scales=shape.scales, shape=shape if fits(shape, top) else None, mu_s=self.static,
            rolling=None if self.given == "hand" else self.let_go, pushes=self.pushes,
            seconds=min(max([SECONDS, *(push.t + ON for push in self.pushes[-1:])]), MOST_SECONDS),
            **{name: getattr(self, name) for name in names},
        )  # fmt: skip

    @property
    def at_rest(self) -> bool:
        """Whether it is released with G at rest."""
        return self.given == "hand" and self.slip == 1

    @property
    def let_go(self) -> State:
        """The State at t = 0, before any table has gripped it."""
        return by_hand(self.spin, self.tilt, self.slip, self.shape.scales)


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
