"""What others published, for Learn: the runs beside Cohen's figure.

docs/published.md has the sources, and the lines that compute each number.
"""

import functools
from dataclasses import dataclass

import numpy as np

from app.model.fixed_steps import in_steps
from app.model.setup import TOYS
from tippe_core import Contensou, Coulomb, SmoothedCoulomb, State, slide
from tippe_core.types import Array

COHEN, SCALES = TOYS["Cohen's top"].top, TOYS["Cohen's top"].shape.scales
START, MU, SECONDS = State(0.1, 0, 0, 100 * SCALES.time), 0.3, 2.0  # Am. J. Phys. 45, 12 (1977), Fig. 5
FIGURE = ((0.5, 0.42), (1.0, 1.65), (1.5, 2.75), (2.0, 3.05))  # s, rad, +- 0.05, read off his Fig. 5(a)
LAWS: dict[str, Coulomb | SmoothedCoulomb | Contensou] = {
    "coulomb": Coulomb(MU),
    "smoothed": SmoothedCoulomb(MU, 0.2),
    "patch": Contensou(MU, 0.02),
}
STEPS = (10.0, 5.0, 2.0, 1.0)  # ms


@dataclass(frozen=True)
class Curve:
    """The tilt of Cohen's top. step: ms, of a program that steps over what happens within a step; 0: of slide(). theta
    in degrees; over: when it passes 90 degrees, s, nan: never; caught: since when it rolls, s, nan: it does not."""

    law: str
    step: float
    t: Array
    theta: Array
    caught: float

    @property
    def over(self) -> float:
        return float(self.t[np.argmax(self.theta > 90)]) if self.theta.max() > 90 else np.nan


def _slid(law: str) -> Curve:
    t = np.linspace(0, SECONDS, 401)
    run = slide(COHEN, START, LAWS[law], t / SCALES.time)
    rolls = [when for when, event in run.events if event == "sticks"] if run.regime[-1] == "roll" else []
    return Curve(law, 0, t, np.degrees(run.theta), rolls[-1] * SCALES.time if rolls else np.nan)


def _stepped(step: float) -> Curve:
    t, theta = in_steps(COHEN, START, MU, step / 1e3 / SCALES.time, SECONDS / SCALES.time)
    rows = slice(None, None, max(1, round(5 / step)))
    return Curve("stepped", step, t[rows] * SCALES.time, np.degrees(theta[rows]), np.nan)


@functools.cache
def curves() -> tuple[Curve, ...]:
    """Of each law, and of Coulomb's in each of STEPS; about a second of a processor, once."""
    return (*map(_slid, LAWS), *map(_stepped, STEPS))
