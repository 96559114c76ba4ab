"""The motion of a Scene that is let slip at the end of its tieline: what of K_J, K_R and the tilt it keeps.

Rolling, a motion is its tieline in the (K_J, theta) plane for ever. Slipping, it keeps K_J nearly (it pivots), and runs
out of the tieline's end along the same height; K_R goes with it. It nods on the way: each row is the mean of one nod.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from app.model.runs import look
from app.model.scene import Scene
from tippe_core import Contensou, State, Top, TopError, Trajectory, omega2, omega3, slide
from tippe_core.types import Array, Indices

MU, PATCH = 0.3, 0.008  # of wood that slides on a table; the radius of the patch, in R, is Hertz's for a wooden toy
STILL = np.radians(0.2)  # it nods by less than the tenth of a degree either way that the page shows
NODS, SAMPLES = 300, 24  # nutations of the rolling motion that are followed, and times in each
MOST_LOOKS = 2_000  # of slide() at its progress: a quarter of a second; the paper's top needs ten

NEAR_A_POLE = 1e-6
RTOL = 1e-8


@dataclass(frozen=True, eq=False, kw_only=True)
class Slipping:
    """theta, K_J, K_R (n,): the means of one nod after the other, from the tieline's end on; low, high (n,) the least
    and the largest tilt of each. seconds: in (R/g)^1/2, how long it is. touches: the first row, if any, in which it is
    tilted as far as where the stem touches: from there on it goes on as a whole sphere would. rolls: whether, at the
    last row, it rolls again without nodding. mu: the friction it has on the way."""

    theta: Array
    low: Array
    high: Array
    K_J: Array
    K_R: Array
    seconds: float
    touches: int | None
    rolls: bool
    mu: float


def slipping(scene: Scene) -> Slipping | None:
    """The Slipping of a Scene's motion; None where there is none."""
    touch = scene.shape.touch_angle if scene.shape else None
    state = at_the_end(scene)
    mu = min(MU, scene.mu_s)
    if state is None or not mu > 0:
        return None
    return _slipping(scene.top, state, mu, touch, scene.rolling.period)


def at_the_end(scene: Scene) -> State | None:
    """The motion at the outer end of its tieline, where it turns, as a start of slide(); None at a pole."""
    theta, top = scene.turning[1], scene.top
    s, c = np.sin(theta), np.cos(theta)
    if s < NEAR_A_POLE:
        return None
    w2, w3 = (float(each(theta, top, scene.constants)) for each in (omega2, omega3))
    # it rolls: vx, of G in the turning axes, leaves the contact point at rest
    return State(theta, 0.0, w2, w3, vx=w2 * (c - top.a) - w3 * s, vy=0.0)


class TooLong(Exception):
    """It takes more work than a picture is worth."""


def _patient() -> Callable[[float], None]:
    """A progress of slide() that ends it after MOST_LOOKS, or with the run that it is part of."""
    left = iter(range(MOST_LOOKS))

    def patient(reached: float) -> None:
        if next(left, None) is None:
            raise TooLong
        look(reached)

    return patient


@lru_cache(maxsize=8)
def _slipping(top: Top, state: State, mu: float, touch: float | None, period: float) -> Slipping | None:
    times = np.linspace(0, NODS * period, NODS * SAMPLES + 1)
    try:
        # what a whole sphere does, so that it is followed past where the stem would touch
        motion = slide(top, state, Contensou(mu, PATCH), times, rtol=RTOL, landing="plastic", progress=_patient())
    except (TopError, TooLong):
        return None
    if len(motion.t) < 2 * SAMPLES:
        return None
    begins = _nods(motion.theta)
    lengths = np.diff(np.append(begins, len(motion.t)))
    means = [np.add.reduceat(each, begins) / lengths
             for each in (motion.theta, motion.jellett / top.I1, motion.routh)]  # fmt: skip
    low, high = np.minimum.reduceat(motion.theta, begins), np.maximum.reduceat(motion.theta, begins)
    nods = np.flatnonzero(high - low > STILL)
    last = int(nods[-1]) + 1 if len(nods) else 0
    rolls = last < len(begins) - 1 and motion.regime[begins[last]] != "air" and not _ended(motion, times)
    count = last + 1 if rolls else len(begins)
    first = state.theta, motion.jellett[0] / top.I1, motion.routh[0]
    theta, K_J, K_R = (np.append(start, mean[:count]) for start, mean in zip(first, means, strict=True))
    touches = np.flatnonzero(high[:count] > (np.inf if touch is None else touch))
    return Slipping(
        theta=theta, K_J=K_J, K_R=K_R, low=np.append(state.theta, low[:count]),
        high=np.append(state.theta, high[:count]), seconds=float(motion.t[begins[count - 1]]),
        touches=int(touches[0]) + 1 if len(touches) else None, rolls=rolls, mu=mu,
    )  # fmt: skip


def _nods(theta: Array) -> Indices:
    """Where each nod begins: at the motion's start, then where the tilt is largest; evenly where it never is."""
    steps = np.diff(theta)
    tops = np.flatnonzero((steps[:-1] > 0) & (steps[1:] <= 0)) + 1
    return np.append(0, tops) if len(tops) > 2 else np.arange(0, len(theta) - SAMPLES, SAMPLES)


def _ended(motion: Trajectory, times: Array) -> bool:
    return len(motion.t) < len(times)
