"""The view-model: each change of the inputs is solved once, and gives one frozen Scene of the rolling motion."""

from dataclasses import replace
from functools import lru_cache
from math import floor, log10, nan
from types import MappingProxyType
from typing import Any

import param

from app.model.marks import LARGEST
from app.model.region import PAPER, Upper
from app.model.scene import LEAST_INERTIA, Scene, solve
from app.model.start import Start, rolls
from app.text import told
from app.together import set_together
from tippe_core import State, Top, TopError


class Explorer(Start):
    """The controls. Several inputs set in one `param.update` cause one solve and one `scene` event; inputs on which
    rolling does not depend cause none.

    The set of inputs that was changed last determines the motion, and the other sets follow to the last digit, so that
    each may be changed next. To restore an earlier motion, set `given` and its inputs. A start that does not roll is
    gripped by the table first: the constants are those of the rolling that follows.
    """

    upper: param.Selector[Upper] = param.Selector(
        default=True, objects=[True, False, PAPER], doc="which part of the (K_J, theta) plane is shown: region.Upper"
    )
    limit: param.Selector[str] = param.Selector(
        default="lift-off", objects=["lift-off", "slip"], doc="the limit for which Fig. 5 is drawn"
    )
    # __init__ makes the first one
    scene: param.ClassSelector[Scene] = param.ClassSelector(  # type: ignore[assignment]
        class_=Scene, constant=True, doc="the last solution"
    )

    INPUTS = ("K_J", "K_R", "mu_s", "energy", "a", "I1", "I3")
    FOLLOWS = {name for names in Start.GIVEN.values() for name in names} - {"slip"}

    def __init__(self, **inputs: object) -> None:
        super().__init__(**inputs)
        self._later = self._waits = False
        others = ("slip", "given", "mu", "mu_s", "a", "I1", "I3", "shape", "upper", "limit")
        self.param.watch(self._on_inputs, [*self.FOLLOWS, *others])
        self._solve()

    def later(self, **inputs: Any) -> None:
        """Takes inputs of a released top; its rolling motion is solved only when it will be seen, in settle()."""
        self._later = True
        try:
            self.param.update(**inputs)
        finally:
            self._later = False

    def settle(self) -> None:
        """Solves what later() has postponed."""
        if self._waits:
            self._solve()

    @property
    def let_go(self) -> State:
        """The State at t = 0, before any table has gripped it."""
        return super().let_go if self.given == "hand" else rolls(self.scene.state, self.scene.top)

    def _on_inputs(self, *events: param.parameterized.Event) -> None:
        if self._following:
            return
        changed = {event.name for event in events}
        if changed == {"mu"} and self.mu_s is not None:
            return  # rolling depends on static friction alone
        if "given" not in changed:
            by = (("state", self.GIVEN["state"]), ("hand", self.GIVEN["hand"]), ("E", ("E",)),
                  ("share", self.GIVEN["share"]))  # fmt: skip
            given = next((given for given, names in by if changed & set(names)), self.given)
            if given != self.given:
                self._follow(given=given)
        if self._later and self.given == "hand":
            self._waits = True
        else:
            self._solve()

    def _follow(self, **values: object) -> None:
        self._following = True
        try:
            with param.edit_constant(self):
                set_together(self, **values)
        finally:
            self._following = False

    def _solve(self) -> None:
        self._waits = False
        try:
            state = {name: getattr(self, name) for name in self.GIVEN["state"]}
            scene = solve(
                Top(self.a, self.I1, self.I3),
                self.K_J,
                self.K_R,
                self.static,
                self.energy,
                self.upper,
                self.limit,
                self.shape,
                E=self.E if self.given == "E" else None,
                state=State(**state) if self.given == "state" else None,
                let_go=super().let_go if self.given == "hand" else None,
            )
        except TopError as error:
            if self.scene is None:
                raise
            control = {"E": "energy"}.get(error.name, error.name)
            asked = {name: getattr(self, name) for name in self.scene.inputs} | {"mu_s": self.static}
            near = _nearest(error, asked)
            self._follow(scene=replace(
                self.scene, inputs=MappingProxyType(asked), messages=MappingProxyType({control: told(error)}),
                nearest=MappingProxyType({} if near is None else {control: near})))  # fmt: skip
            return
        kept = {name: getattr(self, name) for name in ("given", *self.GIVEN["hand"] * (self.given == "hand"))}
        scene = replace(scene, inputs=MappingProxyType(scene.inputs | kept))
        names = self.FOLLOWS - set(self.GIVEN[self.given])
        self._follow(scene=scene, **{name: scene.inputs[name] for name in names})


def _nearest(error: TopError, asked: dict[str, Any]) -> float | None:
    """The possible value that is nearest to the one at fault, with the other inputs as they were asked for; None if
    another input was asked for."""
    name, value = error.name, error.value
    if name == "E":
        least = error.numbers.get("least")  # rounded to six digits, so the next one is surely possible
        return None if least is None else float(f"{least + 10.0 ** (floor(log10(abs(least))) - 5):.6g}")
    least, most = {
        "a": (-LARGEST, 0.999), "I1": (max(asked["I3"] / 2, LEAST_INERTIA), LARGEST),
        "I3": (LEAST_INERTIA, min(2 * asked["I1"], LARGEST)), "mu_s": (0.0, LARGEST), "theta": (0.001, 3.1415),
    }.get(name, (nan, nan))  # fmt: skip
    if value != asked.get(name) or not least <= most:
        return None
    return float(min(max(value, least), most))


@lru_cache(12)
def solved(**inputs: Any) -> Scene:
    """The Scene of these inputs, cached for all visitors; the default Scene if these inputs do not give a motion."""
    try:
        return Explorer(**inputs).scene
    except (ValueError, ArithmeticError):
        return Explorer().scene
