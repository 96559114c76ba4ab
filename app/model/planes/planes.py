"""The view-model of the three planes: the controls, one run of what they set, one frozen Picture of the results."""

from dataclasses import replace
from functools import partial
from types import MappingProxyType
from typing import Any

import numpy as np
import param

from app.model.explorer import Explorer
from app.model.planes.picture import BY, SET, Picture
from app.model.planes.refusal import Refusal, refused
from app.model.planes.run import hits, nudged, solve
from app.model.runs import LATER, Full, Result, Run, Runs, Stopped
from app.model.scene import Scene
from app.model.setup import Setup
from app.text import say
from tippe_core import (
    Scales,
    TopError,
)
from tippe_core.types import Number

# s: a run may still finish within this time after a newer one was requested; later it is stopped.
PATIENCE = 0.5


# ---- the inputs ----


def _preset(body: str, spin: float, tilt: float, seconds: float, **law: object) -> dict[str, Number]:
    """An example. It sets no table, so that the one that is shown stays."""
    start = {"given": "hand", "spin": spin, "tilt": tilt, "slip": 1.0, "seconds": seconds}
    return {"body": body} | start | law


# Top S as in Rutstam's simulations, arXiv:1306.2470: viscous friction F = -1.0 N v (v in m/s), theta = 0.1, G at rest.
_GAMMA_S = float(Scales(R=0.02, M=0.02).velocity)
_S = {
    name: _preset("Top S", round(spin / (2 * np.pi), 4), 5.73, seconds, law="viscous", gamma=round(_GAMMA_S, 4))
    for name, spin, seconds in (("fast", 90, 10.0), ("hangs", 60, 25.0), ("never", 25, 25.0))
}
PRESETS = {
    "The paper’s top by hand": _preset("The paper's tippe top", 20.0, 10.0, 5.0, law="smoothed", mu=0.3, eps=0.1),
    **{f"Top S {name}": preset for name, preset in _S.items()},
    "An ordinary top rises": _preset("Wooden cone", 20.0, 15.0, 6.0, law="viscous", gamma=0.3),
}
"""{name: the body, one of tippe_core.PRESETS, and inputs of Planes}."""


def preset(name: str) -> tuple[str, dict[str, Number]]:
    """The name of its body, to be thrown anew, and the inputs of its start."""
    inputs = dict(PRESETS[name])
    return inputs.pop("body"), inputs


class Planes(param.Parameterized):
    """Computes what the page's start does on the three planes; each result is one `picture` event.

    start: the Explorer, which ask() sets. runs: the page's Runs; if several runs are requested while one is under way,
    only the newest is computed. follow() is to be called with the scene of a hand at rest. Nothing is computed before
    show() or after hide().
    """

    busy = param.Boolean(False, constant=True, doc="whether a run is under way")
    picture = param.ClassSelector(class_=Picture, constant=True, doc="the last solution; None before the first")
    refusal = param.ClassSelector(
        class_=Refusal, constant=True, doc="why there is no picture yet; None if there is one"
    )

    INPUTS = ("by", *SET)

    def __init__(self, start: Explorer, runs: Runs | None = None) -> None:
        self._start, self._runs = start, runs or Runs()
        self._run: Run | None = None
        self._beside: Run | None = None
        self._asked: Setup | None = None
        self._wanted: Setup | None = None
        self._shown = self.begun = self._told_to_stop = False
        super().__init__()  # type: ignore[no-untyped-call]  # of param
        start.param.watch(lambda *events: self._run_anew(), ["given", *SET])

    def show(self) -> None:
        """Starts computing, because the view is shown."""
        self._shown = self.begun = True
        self._run_anew()

    def hide(self) -> None:
        """Stops computing, because the view is hidden."""
        self._shown = False

    @property
    def plane(self) -> str:
        """The plane that is shown: one of TABLES, or "three"."""
        return str(self._start.table)

    @property
    def inputs(self) -> dict[str, Any]:
        """The present inputs."""
        start = self._start
        values = {name: getattr(start, name) for name in SET}
        return values | {"mu_s": start.static, "by": BY[start.given == "hand"]}

    def ask(self, by: str | None = None, **inputs: Any) -> None:
        """Sets inputs; by: "spin" or "constants", which give the same start."""
        if by:
            self._start.settle()
            inputs["given"] = "hand" if by == "spin" else "state"
        self._start.later(**inputs)

    def follow(self, scene: Scene) -> None:
        """Starts a run if the top or the rolling motion differs from the last request; waits until inputs that are set
        together, as by undo, are all set."""
        self._runs.post(self._run_anew)

    @property
    def elapsed(self) -> float:
        """The time taken by the present run, s; 0 if there is none."""
        return self._run.elapsed if self._run else 0.0

    @property
    def share(self) -> float:
        """How much of the present run is done, 0 to 1."""
        return self._run.reached if self._run else 1.0

    @property
    def _reached(self) -> float:
        """The time of the motion reached so far, s."""
        return self._run.reached * self._running.seconds if self._run else 0.0

    def stop(self) -> None:
        """Stops the present run; the last picture stays, with a sentence."""
        self._wanted = None
        if self._run:
            self._told_to_stop = True
            self._run.stop()

    def _run_anew(self) -> None:
        if not self._shown:
            return
        settings = self._start.setup
        if settings == self._asked:
            return
        self._asked = settings
        if self._beside:
            self._beside.forget()
        if not self._runs.beside:
            self._runs.begin(Run(lambda run: solve(settings), partial(self._publish, settings)), "planes")
            return
        self._wanted = settings
        if self._run is None:
            self._begin(settings)
        elif self._run.elapsed > PATIENCE:
            self._run.stop()

    def _begin(self, settings: Setup) -> None:
        self._running, self._wanted, self._told_to_stop = settings, None, False
        with param.edit_constant(self):
            self.busy = True
        self._run = Run(lambda run: solve(settings, run.look), self._done)
        self._runs.begin(self._run, "planes")

    def _done(self, result: Result) -> None:
        settings, reached, told_to_stop = self._running, self._reached, self._told_to_stop
        self._run = None
        if self._wanted is not None:
            self._begin(self._wanted)
        else:
            with param.edit_constant(self):
                self.busy = False
        if isinstance(result, Stopped) and not (told_to_stop or isinstance(result, Full)):
            return
        self._publish(settings, result, reached)

    def _publish(self, settings: Setup, result: Result, reached: float = 0.0) -> None:
        if isinstance(result, Exception):
            self._refuse(settings, result, reached)
            return
        result = replace(result, inputs=MappingProxyType(self.inputs))
        with param.edit_constant(self):
            self.param.update(picture=result, refusal=None)
        if self._runs.beside and not self.busy and hits(result):
            self._beside = Run(lambda run: nudged(result, run.look), partial(self._nudged, result))
            self._runs.begin(self._beside, "nudged", LATER)

    def _refuse(self, settings: Setup, error: Exception, reached: float) -> None:
        """Says why there is no picture of these inputs; whatever the reason, nobody is left waiting for one."""
        nearest: dict[str, float] = {}
        if isinstance(error, TopError):
            messages, nearest = refused(error, settings)
        else:
            messages = {"run": self._unfinished(error, reached)}
        if isinstance(error, Full):
            self._asked = None  # so that it is tried again
        answer = Refusal(inputs=MappingProxyType(self.inputs), messages=MappingProxyType(messages),
                         nearest=MappingProxyType(nearest))  # fmt: skip
        with param.edit_constant(self):
            if self.picture is None:
                self.refusal = answer
            else:
                self.picture = replace(self.picture, **vars(answer))
        if not isinstance(error, Stopped | TopError):
            raise error

    def _unfinished(self, error: Exception, reached: float) -> str:
        if isinstance(error, Full):
            return say("main.queue.full", count=error.args[0])
        if not isinstance(error, Stopped):
            return say("main.failed")
        return say("planes.run.stopped" if self.picture else "planes.run.stopped_first", reached=reached)

    def _nudged(self, picture: Picture, growth: object) -> None:
        """Adds the growth of the disturbed run to the picture, if that is still shown."""
        if isinstance(growth, float) and self.picture is not None and self.picture.motions is picture.motions:
            with param.edit_constant(self):
                self.picture = replace(self.picture, growth=growth)
