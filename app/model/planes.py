"""The view-model of the three planes: the controls, one run of what they say, one frozen Picture of it all."""

from dataclasses import replace
from functools import partial
from types import MappingProxyType

import numpy as np
import param

from app.model.planes_picture import LAWS, PLANES, SET, Picture, Settings
from app.model.planes_run import for_reader, hits, nudged, solve
from app.model.runs import Result, Run, Runs, Stopped
from app.model.scene import Scene
from app.text import say, told
from tippe_core import (
    Scales,
    TopError,
)
from tippe_core.types import Number

# A run that a newer one replaces may still finish within this, s; later it is stopped.
PATIENCE = 0.5


# ---- what a person sets ----


def _preset(body: str, spin: float, tilt: float, seconds: float, **law: object) -> dict[str, Number]:
    """Of no table: it stays on that where it is looked at, of which one has no friction."""
    start = {"by": "spin", "spin": spin, "tilt": tilt, "slip": 1.0, "seconds": seconds}
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
    """The controls. Several set in one `param.update` make one run, and one `picture` event when it is done.

    see() is to be called with each scene, whose top it is about, and follow() with that of a hand at rest. runs: the
    page's Runs; of several asked for while one is under way only the newest is made.
    """

    plane: param.Selector[str] = param.Selector(
        default="sliding", objects=[*PLANES, "compare"], doc="what is looked at; computes nothing"
    )
    by: param.Selector[str] = param.Selector(
        default="spin", objects=["spin", "constants"], doc="how the start is given"
    )
    spin = param.Number(20.0, doc="omega_3 at the start, rev/s")
    tilt = param.Number(10.0, doc="theta at the start, degrees")
    slip = param.Number(1.0, doc="slip at the start, of what it is with G at rest")
    law: param.Selector[str] = param.Selector(
        default="smoothed", objects=list(LAWS), doc="the law of friction of the sliding plane"
    )
    mu_k = param.Number(0.3, doc="coefficient of sliding friction (Coulomb)")
    mu_s = param.Number(0.4, doc="coefficient of static friction (Coulomb)")
    gamma = param.Number(0.3, doc="viscous friction, in (gR)^-1/2")
    mu = param.Number(0.3, doc="coefficient of the friction of a real contact, and of smoothed friction")
    eps = param.Number(0.1, doc="slip at which smoothed friction is 0.7 of its full size, in (gR)^1/2")
    patch = param.Number(0.5, doc="radius of the patch of a real contact, mm")
    landing: param.Selector[str] = param.Selector(
        default="plastic", objects=["stop", "plastic"], doc="what follows where it lifts off"
    )
    stem = param.Boolean(True, doc="whether the stem can touch the table")
    seconds = param.Number(5.0, doc="how long a time is computed, s of the real top")
    busy = param.Boolean(False, constant=True, doc="whether a run is under way")
    picture = param.ClassSelector(class_=Picture, constant=True, doc="the last solution; None before the first")

    INPUTS = ("by", *SET)

    def __init__(self, scene: Scene, runs: Runs | None = None) -> None:
        self._scene, self._runs = scene, runs or Runs()
        self._run: Run | None = None
        self._beside: Run | None = None
        self._wanted: Settings | None = None
        self._told_to_stop = False
        super().__init__()  # type: ignore[no-untyped-call]  # of param

    def see(self, scene: Scene) -> None:
        """What is asked for from now on is about this scene."""
        self._scene = scene

    def follow(self, scene: Scene) -> None:
        """Runs again if the top, or the motion chosen for rolling, is another than the one last asked for; when what is
        set together with it is set too, as by an undo."""
        self.see(scene)
        self._runs.post(self._follow)

    def _follow(self) -> None:
        asked, now = self._asked, self._settings()
        same = (asked.top, asked.scales, asked.shape, asked.rolling) == (now.top, now.scales, now.shape, now.rolling)
        if not same:
            self._ask()

    @property
    def elapsed(self) -> float:
        """How long the present run has taken, s; 0 without one."""
        return self._run.elapsed if self._run else 0.0

    @property
    def share(self) -> float:
        """How much of the present run is done, 0 to 1."""
        return min(1.0, self._reached / self._running.seconds) if self._run else 1.0

    @property
    def _reached(self) -> float:
        """s of the real top."""
        return self._run.reached * self._running.scales.time if self._run else 0.0

    def stop(self) -> None:
        """Ends the present run; the last picture stays, with a sentence."""
        self._wanted = None
        if self._run:
            self._told_to_stop = True
            self._run.stop()

    def _settings(self) -> Settings:
        scene, rolling = self._scene, None
        if self.by == "constants":
            start, a = scene.state, scene.top.a
            s, c = np.sin(start.theta), np.cos(start.theta)
            vx, vy = start.omega2 * (c - a) - start.omega3 * s, -start.theta_dot * (1 - a * c)
            rolling = replace(start, phi=0.0, psi=0.0, vx=float(vx), vy=float(vy))
        inputs = {name: getattr(self, name) for name in SET}
        return Settings(
            top=scene.top, scales=scene.scales, shape=scene.shape, profile=scene.profile, rolling=rolling, **inputs
        )

    @param.depends(*INPUTS, watch=True, on_init=True)
    def _ask(self) -> None:
        self._asked = settings = self._settings()
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

    def _begin(self, settings: Settings) -> None:
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
        if isinstance(result, Stopped) and not told_to_stop:
            return
        self._publish(settings, result, reached)

    def _publish(self, settings: Settings, result: Result, reached: float = 0.0) -> None:
        messages = {}
        if isinstance(result, Stopped):
            messages["run"] = say("planes.run.stopped", reached=reached)
        elif isinstance(result, TopError):
            error = for_reader(result, settings.scales)
            name = "law" if error.name == "friction" else error.name
            hidden = settings.rolling is not None and name in ("spin", "tilt", "slip")
            messages["by" if hidden else name] = told(error)
        elif isinstance(result, Exception):
            raise result
        if messages:
            if self.picture is None:
                return
            result = replace(self.picture, messages=MappingProxyType(messages))
        result = replace(result, inputs=MappingProxyType({name: getattr(self, name) for name in self.INPUTS}))
        with param.edit_constant(self):
            self.picture = result
        if not messages and self._runs.beside and not self.busy and hits(result):
            self._beside = Run(lambda run: nudged(result, run.look), partial(self._nudged, result))
            self._runs.begin(self._beside, "nudged")

    def _nudged(self, picture: Picture, growth: object) -> None:
        """What the run beside the run tells of it, if that is still what is shown."""
        if isinstance(growth, float) and self.picture is not None and self.picture.motions is picture.motions:
            with param.edit_constant(self):
                self.picture = replace(self.picture, growth=growth)
