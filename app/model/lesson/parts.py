"""The parts of a step of the lesson: what is shown, asked, answered and drawn."""

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
TILT = 0.1  # rad: nobody releases a top exactly upright
FEW = 24

Numbers: TypeAlias = dict[str, Number]  # by their names in the texts; some are shown as words
Inputs: TypeAlias = dict[str, Number]  # of the Explorer


class Curve(NamedTuple):
    """x, y (n,)."""

    key: str
    colour: str
    x: Array
    y: Array
    dash: str = "solid"


class Point(NamedTuple):
    """A point on the graph."""

    key: str
    x: float
    y: float


@dataclass(frozen=True, eq=False)
class Picture:
    """A graph beside a step; x, y: the symbols on its axes; the keys of curves and points are those of their labels."""

    x: str
    y: str
    curves: tuple[Curve, ...]
    points: tuple[Point, ...] = ()


@dataclass(frozen=True, eq=False)
class Answer:
    """truth: the computed answer, an option or a number; numbers: those in the texts of the step.

    picture: a graph of it, if there is one; told: which of the step's explanations applies.
    """

    truth: str | float
    numbers: Numbers
    picture: Picture | None = None
    told: str = "told"


@dataclass(frozen=True)
class Choice:
    """A prediction by choosing an option; "I do not know yet" is an answer too."""

    options: tuple[str, ...]


@dataclass(frozen=True)
class Guess:
    """A prediction on a slider. share, least: the allowed error of a good guess, relative to the truth, and at
    least."""

    low: float
    high: float
    step: float
    unit: str
    share: float
    least: float

    def near(self, truth: float) -> float:
        """The allowed error of a good guess."""
        return max(self.least, self.share * abs(truth))


@dataclass(frozen=True)
class Step:
    """A step: what is watched before and after the prediction, and the answer that follows from it.

    tops: names for runs.named, shown side by side; before, end: s, how far they are shown before the prediction and
    after it; later: those of them that are shown only afterwards. picture: the picture beside them, a name known to the
    view, or "". inputs: of the Explorer, for a step about one rolling motion; the times are then in nutations. tex:
    equations of the paper; sources: names in sources.toml.
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
    """Inputs for a motion with K_R = 10 at this fraction of K_J(P) and this position on the energy scale."""

    def inputs(top: Top) -> Inputs:
        K_J = K_J_share * pole_constants(top, K_R)[0]
        return {"K_J": K_J, "K_R": K_R, "energy": energy, "mu_s": mu_s, "given": "share"}

    return inputs


def limit_words(E: float) -> str:
    """The words for a limit energy: a number, none at all, or below the least energy."""
    return say(f"learn.limits.{'energy' if np.isfinite(E) else 'always' if np.isnan(E) else 'never'}", E=E)


def level(key: str, colour: str, x: Array, y: float, dash: str = "dashed") -> Curve:
    return Curve(key, colour, np.array([x[0], x[-1]]), np.array([y, y]), dash)


def tied(found: Tielines, key: str, colour: str) -> Curve:
    """The tielines as one curve with gaps."""
    gap = np.full(len(found.K_J), np.nan)
    theta = np.column_stack([found.theta_inner, found.theta_outer, gap]).ravel()
    return Curve(key, colour, np.degrees(theta), np.column_stack([found.K_J, found.K_J, gap]).ravel())


def selected(scene: Scene) -> Curve:
    K_J = scene.constants.K_J
    return Curve("motion", COLOURS["theta"], np.degrees(scene.turning), np.array([K_J, K_J]))
