"""The view-model: the controls, one solve of what they say, one frozen Scene."""

from dataclasses import replace
from types import MappingProxyType

import param

from app.model.region import PAPER, Upper
from app.model.scene import Scene, solve
from app.text import told
from tippe_core import (
    Shape,
    State,
    Top,
    TopError,
    TruncatedSphere,
)


class Explorer(param.Parameterized):
    """The controls. Several set in one `param.update` make one solve and one `scene` event.

    The motion has three faces, GIVEN: what was set last is what it is given by, and the inputs of the other two then
    follow to the last digit, so that each may be changed next. To put back what was: set `given` and its inputs.
    """

    K_J = param.Number(7.0, doc="Jellett's constant, in (g/R)^1/2")
    K_R = param.Number(10.0, doc="Routh's constant, in (MR^2)^1/2 (g/R)^1/2")
    energy = param.Number(0.9, doc="0 the steady precession, 1 the limit of friction, 2 the limit F_z = 0")
    E = param.Number(0.0, doc="the energy itself, in MgR")
    theta = param.Number(0.0, doc="the tilt at t = 0, in rad")
    theta_dot = param.Number(0.0, doc="its rate, in (g/R)^1/2")
    omega2 = param.Number(0.0, doc="the angular velocity about 2' at t = 0, in (g/R)^1/2")
    omega3 = param.Number(0.0, doc="the angular velocity about the axis of symmetry at t = 0, in (g/R)^1/2")
    phi = param.Number(0.0, doc="the azimuth of 1' at t = 0, in rad")
    psi = param.Number(0.0, doc="the turn about the axis of symmetry at t = 0, in rad")
    given: param.Selector[str] = param.Selector(
        default="share", objects=["share", "E", "state"], doc="which of GIVEN holds"
    )
    mu_s = param.Number(0.5, doc="coefficient of static friction")
    a = param.Number(0.070, doc="distance of G below the centre O of the sphere, in R")
    I1 = param.Number(0.399, doc="moment of inertia about an axis through G across the axis of symmetry, in MR^2")
    I3 = param.Number(0.408, doc="moment of inertia about the axis of symmetry, in MR^2")
    shape = param.ClassSelector(
        class_=Shape, default=TruncatedSphere.paper(), allow_None=False, doc="the body; a, I1, I3 are set with it"
    )
    upper: param.Selector[Upper] = param.Selector(
        default=True, objects=[True, False, PAPER], doc="which part of the (K_J, theta) plane is shown: region.Upper"
    )
    limit: param.Selector[str] = param.Selector(
        default="lift-off", objects=["lift-off", "slip"], doc="which limit Fig. 5 is drawn at"
    )
    # __init__ makes the first one
    scene: param.ClassSelector[Scene] = param.ClassSelector(  # type: ignore[assignment]
        class_=Scene, constant=True, doc="the last solution"
    )

    GIVEN = MappingProxyType(
        {
            "share": ("K_J", "K_R", "energy"),
            "E": ("K_J", "K_R", "E"),
            "state": ("theta", "theta_dot", "omega2", "omega3", "phi", "psi"),
        }
    )
    INPUTS = ("K_J", "K_R", "mu_s", "energy", "a", "I1", "I3")

    def __init__(self, **inputs: object) -> None:
        super().__init__(**inputs)  # type: ignore[no-untyped-call]  # of param
        self._following = False
        motion = {name for names in self.GIVEN.values() for name in names}
        self.param.watch(self._on_inputs, [*motion, "given", "mu_s", "a", "I1", "I3", "shape", "upper", "limit"])
        self._solve()

    def _on_inputs(self, *events: param.parameterized.Event) -> None:
        if self._following:
            return
        changed = {event.name for event in events}
        if "given" not in changed:
            by = (("state", self.GIVEN["state"]), ("E", ("E",)), ("share", self.GIVEN["share"]))
            given = next((given for given, names in by if changed & set(names)), self.given)
            if given != self.given:
                self._follow(given=given)
        self._solve()

    def _follow(self, **values: object) -> None:
        self._following = True
        try:
            with param.edit_constant(self):
                self.param.update(**values)
        finally:
            self._following = False

    def _solve(self) -> None:
        try:
            state = {name: getattr(self, name) for name in self.GIVEN["state"]}
            scene = solve(
                Top(self.a, self.I1, self.I3),
                self.K_J,
                self.K_R,
                self.mu_s,
                self.energy,
                self.upper,
                self.limit,
                self.shape,
                E=self.E if self.given == "E" else None,
                state=State(**state) if self.given == "state" else None,
            )
        except TopError as error:
            if self.scene is None:
                raise
            control = {"E": "energy"}.get(error.name, error.name)
            asked = {name: getattr(self, name) for name in self.scene.inputs}
            self._follow(scene=replace(self.scene, inputs=MappingProxyType(asked),
                                       messages=MappingProxyType({control: told(error)})))  # fmt: skip
            return
        motion = {name for names in self.GIVEN.values() for name in names} - set(self.GIVEN[self.given])
        self._follow(scene=scene, **{name: scene.inputs[name] for name in motion})
