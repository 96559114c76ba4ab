"""What others published, for Learn: the runs beside Cohen's figure, and the links that open each result in the Lab.

docs/published.md has the sources, and the lines that compute each number.
"""

import functools
from dataclasses import dataclass

import numpy as np

from app.model.fixed_steps import in_steps
from tippe_core import Contensou, Coulomb, Scales, SmoothedCoulomb, State, Top, slide
from tippe_core.types import Array

COHEN, SCALES = Top(a=0.2, I1=0.4, I3=0.4), Scales(R=0.025, M=0.015)
START, MU, SECONDS = State(0.1, 0, 0, 100 * SCALES.time), 0.3, 2.0  # Am. J. Phys. 45, 12 (1977), Fig. 5
FIGURE = ((0.5, 0.42), (1.0, 1.65), (1.5, 2.75), (2.0, 3.05))  # s, rad, +- 0.05, read off his Fig. 5(a)
LAWS: dict[str, Coulomb | SmoothedCoulomb | Contensou] = {
    "coulomb": Coulomb(MU),
    "smoothed": SmoothedCoulomb(MU, 0.2),
    "patch": Contensou(MU, 0.02),
}
STEPS = (10.0, 5.0, 2.0, 1.0)  # ms

HAND = {"v": "2", "tab": "three-planes", "table": "ordinary", "by": "hand", "mu_k": ".3"}
SMOOTHED = HAND | {"law": "smoothed", "eps": ".1", "stem": "no", "seconds": "6"}
COHENS = {"body": "BareSphere_.025_.015_.2_.4_.4", "spin": "15.915", "tilt": "5.7296"}
RUTSTAMS = SMOOTHED | {"body": "BareSphere_.02_.02_.3_.3742857142857143_.4", "tilt": "5.7296", "law": "viscous",
                       "gamma": ".1329", "seconds": "7"}  # fmt: skip
TOY = HAND | {"tab": "lab", "spin": "28.648", "tilt": "5.7296", "law": "contact", "patch": ".5",
              "body": "StemmedSphere_.015_.006_.2_.5925925925925926_.5185185185185185_.005_.013"}  # fmt: skip
RESULTS = {
    "cohen": SMOOTHED | COHENS | {"eps": ".2", "seconds": "2"},
    "lighter": SMOOTHED | COHENS | {"body": "BareSphere_.025_.015_.2_.4_.32"},
    "mujoco": SMOOTHED | {"body": "BareSphere_.02_.0554745694_.271579_.573941_.578216", "spin": "31.831",
                          "tilt": ".573", "mu": "1", "mu_k": "1"},
    "threshold": RUTSTAMS | {"spin": "24.669"},
    "leaves": RUTSTAMS | {"spin": "31.831"},
    "leine": TOY,
    "friedl": TOY | {"body": "StemmedSphere_.015_.006_.2_.6666666666666666_.5185185185185185_.005_.013"},
    "ueda": SMOOTHED | COHENS | {"body": "BareSphere_.025_.015_.1_.4_.3"},
    "exudyn": SMOOTHED | {"body": "StemmedSphere_.2_.01_.2_.8133_.6667_.04_.24", "spin": "31.831", "tilt": ".573",
                          "mu_k": ".4", "stem": "yes", "seconds": "16"},
    "dojo": {},
}  # fmt: skip
EXPLANATIONS = {
    "racket": TOY | COHENS,
    "conserved": TOY | {"table": "ice"},
    "space": TOY | {"table": "ice"},
    "reverses": TOY,
    "rough": TOY | {"table": "rough"},
    "inertial": TOY | {"table": "ice"},
}


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
