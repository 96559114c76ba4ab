"""The view-model: each change of the inputs is solved once, and gives one frozen Scene of the rolling motion."""

from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache, wraps
from math import floor, log10, nan
from types import MappingProxyType
from typing import Any

import param

from app.model.marks import LARGEST
from app.model.scene import LEAST_INERTIA, Scene, solve
from app.model.setup import Setup
from app.model.start import GIVEN, USUAL, Start, rolls
from app.text import error_text
from app.together import set_together
from tippe_core import State, TopError


class Explorer(param.Parameterized):
    """The one start of a page, and how it rolls. set() alone changes it: a slider, a link, undo and a click on a map
    all come this way. Inputs that follow from the start are read like its own: explorer.K_J of a start by hand, too.

    A start that does not roll is gripped by the table first: the constants are those of the rolling that follows.
    """

    # __init__ makes the first ones
    start: param.ClassSelector[Start] = param.ClassSelector(  # type: ignore[assignment]
        class_=Start, constant=True, doc="the start, all of which is allowed to be wrong"
    )
    scene: param.ClassSelector[Scene] = param.ClassSelector(  # type: ignore[assignment]
        class_=Scene, constant=True, doc="the last solution"
    )

    def __init__(self, **inputs: Any) -> None:
        super().__init__(start=Start().changed(USUAL, **inputs))  # type: ignore[no-untyped-call]  # of param
        self._waits, self._possible = False, self.start
        self._put(scene=self._solve(self.start))

    def set(self, *, solve: bool = True, **inputs: Any) -> None:
        """Changes inputs of the start: one solve and one `scene` event, and none if rolling does not depend on them.
        solve: False where the rolling of a top let go by a hand is not seen: it is solved in settle()."""
        before, start = self.start, self.start.changed(self.scene.inputs, **inputs)
        if self._waits or not self.scene.messages:
            self._possible = before
        scene = {}
        if start.of_rolling != before.of_rolling:
            self._waits = start.given == "hand" and not solve
            scene = {} if self._waits else {"scene": self._solve(start)}
        if scene or start != before:
            self._put(**scene, start=start)

    @property
    def back(self) -> dict[str, Any]:
        """What sets a start that cannot roll back to the one before it; whatever else was changed meanwhile stays."""
        before, pushes = self._possible, self.start.pushes or self._possible.pushes
        names = "shape", "a", "I1", "I3", "given", "mu_s", *GIVEN[before.given]
        return {name: before.inputs[name] for name in names} | {"pushes": pushes}

    def settle(self) -> None:
        """Solves what set() has postponed."""
        if self._waits:
            self._waits = False
            self._put(scene=self._solve(self.start))

    def when(self, name: str, run: Callable[[], object]) -> None:
        """Calls run() whenever this of the start, an input or what it has, becomes another."""

        @wraps(run)  # a list of watchers says what they run
        def changed(event: param.parameterized.Event) -> None:
            if getattr(event.old, name) != getattr(event.new, name):
                run()

        self.param.watch(changed, "start")

    def __getattr__(self, name: str) -> Any:
        """An input, set or as it follows from what is set; or what else the start has."""
        if name.startswith("_"):
            raise AttributeError(name)
        inputs = {**self.scene.inputs, **self.start.inputs}
        return inputs[name] if name in inputs else getattr(self.start, name)

    @property
    def let_go(self) -> State:
        """The State at t = 0, before any table has gripped it."""
        return self.start.let_go or rolls(self.scene.state, self.scene.top)

    @property
    def setup(self) -> Setup:
        """All that its runs depend on; raises TopError if no top has these a, I1 and I3."""
        return self.start.setup(rolls(self.scene.state, self.scene.top))

    def _put(self, **values: object) -> None:
        with param.edit_constant(self):
            set_together(self, **values)

    def _solve(self, start: Start) -> Scene:
        """The Scene of a start; the last one, with a message, if it does not give a motion."""
        request = start.inputs
        K_J, K_R, share = (float(request.get(name, USUAL[name])) for name in GIVEN["share"])
        try:
            scene = solve(start.top, K_J, K_R, start.static, share, start.upper, start.limit, start.shape,
                          E=request.get("E"), state=State(*start.motion) if start.given == "state" else None,
                          let_go=start.let_go)  # fmt: skip
        except TopError as error:
            if self.scene is None:
                raise
            control = {"E": "energy"}.get(error.name, error.name)
            request = {**self.scene.inputs, **request, "mu_s": start.static}
            request = {name: request[name] for name in self.scene.inputs}
            near = _nearest(error, request)
            return replace(
                self.scene, inputs=MappingProxyType(request), messages=MappingProxyType({control: error_text(error)}),
                nearest=MappingProxyType({} if near is None else {control: near}))  # fmt: skip
        motion = dict(zip(GIVEN[start.given], start.motion, strict=True))
        return replace(scene, inputs=MappingProxyType({**scene.inputs, "given": start.given, **motion}))


def _nearest(error: TopError, request: dict[str, Any]) -> float | None:
    """The possible value that is nearest to the one at fault, with the other inputs as they were asked for; None if
    another input was asked for."""
    name, value = error.name, error.value
    if name == "E":
        least = error.numbers.get("least")  # rounded to six digits, so the next one is surely possible
        return None if least is None else float(f"{least + 10.0 ** (floor(log10(abs(least))) - 5):.6g}")
    least, most = {
        "a": (-LARGEST, 0.999), "I1": (max(request["I3"] / 2, LEAST_INERTIA), LARGEST),
        "I3": (LEAST_INERTIA, min(2 * request["I1"], LARGEST)), "mu_s": (0.0, LARGEST), "theta": (0.001, 3.1415),
    }.get(name, (nan, nan))  # fmt: skip
    if value != request.get(name) or not least <= most:
        return None
    return float(min(max(value, least), most))


@lru_cache(12)
def solved(**inputs: Any) -> Scene:
    """The Scene of these inputs, cached for all visitors; the default Scene if these inputs do not give a motion."""
    try:
        return Explorer(**inputs).scene
    except (ValueError, ArithmeticError):
        return Explorer().scene
