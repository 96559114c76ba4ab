"""What a step of the lesson is made of: what is shown, asked, answered and drawn."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple, TypeAlias

import numpy as np

from app.model.colours import COLOURS
from app.model.scene import Scene
from app.text import say
from tippe_core import Tielines, Top, pole_constants
from tippe_core.types import Array, Number

K_R = 10.0  # the paper's, for Figs. 5 and 6
TILT = 0.1  # rad: nobody lets a top go exactly upright
FEW = 24

Numbers: TypeAlias = dict[str, Number]  # by their names in the words, some of which stand there as words
Inputs: TypeAlias = dict[str, Number]  # of the Explorer


class Curve(NamedTuple):
    """x, y (n,)."""

    key: str
    colour: str
    x: Array
    y: Array
    dash: str = "solid"


class Point(NamedTuple):
    """A place on the graph."""

    key: str
    x: float
    y: float


@dataclass(frozen=True, eq=False)
class Picture:
    """A graph beside a step; x, y are the symbols on its axes, the curves' and points' keys name their words."""

    x: str
    y: str
    curves: tuple[Curve, ...]
    points: tuple[Point, ...] = ()


@dataclass(frozen=True, eq=False)
class Answer:
    """truth: what the computation says, an option or a number; numbers: for the words of the step.

    picture: a graph that tells it, where it has one; told: which of the step's explanations says it.
    """

    truth: str | float
    numbers: Numbers
    picture: Picture | None = None
    told: str = "told"


@dataclass(frozen=True)
class Choice:
    """A prediction that is one of a few; or that one does not know yet, which is an answer too."""

    options: tuple[str, ...]


@dataclass(frozen=True)
class Guess:
    """A prediction on a slider. share, least: how far a good one may be off, of the truth and at least."""

    low: float
    high: float
    step: float
    unit: str
    share: float
    least: float

    def near(self, truth: float) -> float:
        """How far a good one may be off this truth."""
        return max(self.least, self.share * abs(truth))


@dataclass(frozen=True)
class Step:
    """A step: what is watched before and after the prediction, and the answer, read from that.

    tops: names of runs.named, side by side; before, end: s, as far as they are watched before the prediction and
    after it; later: which of the tops are seen only then. picture: what is drawn beside, a name of the view's, or "".
    inputs: of the Explorer, for a step about one rolling motion; then the times are in its nutations. tex: equations of
    the paper; sources: names in sources.toml.
    """

    name: str
    asks: Choice | Guess
    answer: Callable[[Scene], Answer]
    tops: tuple[str, ...] = ()
    before: float = 0.0
    end: float = 0.0
    picture: str = ""
    later: tuple[str, ...] = ()
    inputs: Callable[[Top], Inputs] | None = None
    tex: tuple[str, ...] = ()
    sources: tuple[str, ...] = ()


def at(K_J_share: float, energy: float, mu_s: float = 0.5) -> Callable[[Top], Inputs]:
    """Inputs for a motion of K_R = 10 at this share of K_J(P) and of the energy's marks."""

    def inputs(top: Top) -> Inputs:
        K_J = K_J_share * pole_constants(top, K_R)[0]
        return {"K_J": K_J, "K_R": K_R, "energy": energy, "mu_s": mu_s, "given": "share"}

    return inputs


def limit_words(E: float) -> str:
    """An energy that limits a motion: a number, or that there is none, or that it lies below the least."""
    return say(f"learn.limits.{'energy' if np.isfinite(E) else 'always' if np.isnan(E) else 'never'}", E=E)


def level(key: str, colour: str, x: Array, y: float, dash: str = "dashed") -> Curve:
    return Curve(key, colour, np.array([x[0], x[-1]]), np.array([y, y]), dash)


def tied(found: Tielines, key: str, colour: str) -> Curve:
    """Tielines as one curve with gaps."""
    gap = np.full(len(found.K_J), np.nan)
    theta = np.column_stack([found.theta_inner, found.theta_outer, gap]).ravel()
    return Curve(key, colour, np.degrees(theta), np.column_stack([found.K_J, found.K_J, gap]).ravel())


def selected(scene: Scene) -> Curve:
    K_J = scene.constants.K_J
    return Curve("motion", COLOURS["theta"], np.degrees(scene.turning), np.array([K_J, K_J]))
