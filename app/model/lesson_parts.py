"""What a step of the lesson is made of: what is asked, answered and drawn; how its motions start, and are told."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple, TypeAlias

import numpy as np

from app.model.colours import COLOURS
from app.model.scene import Scene
from app.text import say
from tippe_core import (
    Tielines,
    Top,
    Trajectory,
    pole_constants,
)
from tippe_core.types import Array, Number

K_R = 10.0  # the paper's, for Figs. 5 and 6
TILT = 0.1  # rad: nobody lets a top go exactly upright
CURVE = 750  # points of a curve
FEW = 24

Numbers: TypeAlias = dict[str, Number]  # by their names in the words, some of which stand there as words
Inputs: TypeAlias = dict[str, Number]  # of the Explorer
Guessed: TypeAlias = Number  # an option or a number, as the step asks


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
    """truth: what the computation says, an option or a number; numbers: for the words of the explanation.

    motion: a Trajectory to show in 3-D in place of the scene's own, stem: whether it is of the body with its stem;
    told: which of the step's explanations says it. doubt: why truth is not certain, or "": "early" the computation
    came to where it cannot go on, "cut" the motion still changes at its end, "scatters" a start HAND beside it ends
    elsewhere, "differs" a run ends otherwise than the formula says.
    """

    truth: str | float
    numbers: Numbers
    picture: Picture
    motion: Trajectory | None = None
    told: str = "explain"
    stem: bool = False
    doubt: str = ""


@dataclass(frozen=True)
class Choice:
    """A prediction that is one of a few."""

    options: tuple[str, ...]

    def verdict(self, guess: Guessed, truth: Guessed) -> str:
        return "right" if guess == truth else "off"


@dataclass(frozen=True)
class Guess:
    """A prediction on a slider. near: how far a good one may be off, a share of the truth and at least so much."""

    low: float
    high: float
    step: float
    unit: str
    share: float
    least: float

    def verdict(self, guess: Guessed, truth: Guessed) -> str:
        if np.isnan(truth):
            return "never"
        near = max(self.least, self.share * abs(truth))
        return "right" if abs(guess - truth) <= near else "near" if abs(guess - truth) <= 3 * near else "off"


@dataclass(frozen=True)
class Step:
    """A step: the prediction asked for, the Explorer's inputs for a top, and the answer of a scene.

    tex: the paper's equations, and their numbers; sources: names in sources.toml. slides: whether the answer is read
    from runs with friction, which may take long; its question then has the numbers of start() alone.
    """

    name: str
    asks: Callable[[Scene], Choice | Guess]
    inputs: Callable[[Top], Inputs]
    answer: Callable[[Scene], Answer]
    tex: tuple[str, ...]
    sources: tuple[str, ...]
    slides: bool = False

    def question(self, scene: Scene) -> Numbers:
        """The numbers in the words of its question."""
        return start(scene) if self.slides else self.answer(scene).numbers


def at(K_J_share: float, energy: float, mu_s: float = 0.5) -> Callable[[Top], Inputs]:
    """Inputs for a motion of K_R = 10 at this share of K_J(P) and of the energy's marks."""

    def inputs(top: Top) -> Inputs:
        K_J = K_J_share * pole_constants(top, K_R)[0]
        return {"K_J": K_J, "K_R": K_R, "energy": energy, "mu_s": mu_s, "given": "share"}

    return inputs


def choice(*options: str) -> Callable[[Scene], Choice]:
    return lambda scene: Choice(options)


def limit_words(E: float) -> str:
    """An energy that limits a motion: a number, or that there is none, or that it lies below the least."""
    return say(f"learn.limits.{'energy' if np.isfinite(E) else 'always' if np.isnan(E) else 'never'}", E=E)


def revolutions(scene: Scene, spin: float) -> float:
    """rev/s of the real top."""
    return spin * scene.scales.angular_velocity / (2 * np.pi)


def level(key: str, colour: str, x: Array, y: float, dash: str = "dashed") -> Curve:
    return Curve(key, colour, np.array([x[0], x[-1]]), np.array([y, y]), dash)


def start(scene: Scene) -> Numbers:
    """How the top is let go, near upright."""
    return {"spin": revolutions(scene, scene.upright_spin), "tilt": np.degrees(TILT)}


def curve(key: str, colour: str, motion: Trajectory, values: Array) -> Curve:
    """Of a Trajectory over its time."""
    every = slice(None, None, max(1, len(motion.t) // CURVE))
    return Curve(key, colour, motion.t[every], values[every])


def tied(found: Tielines, key: str, colour: str) -> Curve:
    """Tielines as one curve with gaps."""
    gap = np.full(len(found.K_J), np.nan)
    theta = np.column_stack([found.theta_inner, found.theta_outer, gap]).ravel()
    return Curve(key, colour, np.degrees(theta), np.column_stack([found.K_J, found.K_J, gap]).ravel())


def selected(scene: Scene) -> Curve:
    K_J = scene.constants.K_J
    return Curve("motion", COLOURS["theta"], np.degrees(scene.turning), np.array([K_J, K_J]))
