"""The motion of a Scene if it starts to slip at the end of its tieline: how K_J, K_R and the tilt change.

A rolling motion stays on its tieline in the (K_J, theta) plane for ever. When the top slips, K_J is nearly conserved
(pivoting changes it slowly), so it leaves the tieline's end at about the same K_J, while K_R changes. It nutates on the
way: each row is the mean over one nod.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from app.model.runs import TooLong, patience
from app.model.scene import Scene
from tippe_core import Contensou, State, Top, TopError, omega2, omega3, slide
from tippe_core.types import Array, Indices

MU, PATCH = 0.3, 0.008  # for wood that slides on a table; PATCH is the Hertzian contact radius, in R, for a wooden toy
STILL = np.radians(0.2)  # nods within a tenth of a degree either way, the resolution of the page, count as none
NODS, SAMPLES = 300, 24  # how many nutations of the rolling motion are followed, and samples of each
MOST_LOOKS = 2_000  # calls of slide()'s progress: a quarter of a second; the paper's top needs ten

NEAR_A_POLE = 1e-6
RTOL = 1e-8


@dataclass(frozen=True, eq=False, kw_only=True)
class Slipping:
    """theta, K_J, K_R (n,): means over successive nods, starting at the tieline's end; low, high (n,): the smallest and
    the largest tilt of each nod. seconds: the duration, in (R/g)^1/2. touches: the first row, if any, in which the tilt
    reaches that at which the stem touches; from there on the motion is that of a whole sphere. rolls: whether the top
    rolls again, without nodding, at the last row. mu: the friction coefficient on the way."""

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
    """The Slipping of a Scene's motion; None if there is none."""
    touch = scene.shape.touch_angle if scene.shape else None
    state = at_the_end(scene)
    mu = min(MU, scene.mu_s)
    if state is None or not mu > 0:
        return None
    return _slipping(scene.top, state, mu, touch, scene.rolling.period)


def at_the_end(scene: Scene) -> State | None:
    """The motion at the outer end of its tieline, a turning point, as a start for slide(); None at a pole."""
    theta, top = scene.turning[1], scene.top
    s, c = np.sin(theta), np.cos(theta)
    if s < NEAR_A_POLE:
        return None
    w2, w3 = (float(each(theta, top, scene.constants)) for each in (omega2, omega3))
    # it rolls: vx, that of G along the rotating axes, leaves the contact point at rest
    return State(theta, 0.0, w2, w3, vx=w2 * (c - top.a) - w3 * s, vy=0.0)


@lru_cache(maxsize=8)
def _slipping(top: Top, state: State, mu: float, touch: float | None, period: float) -> Slipping | None:
    times = np.linspace(0, NODS * period, NODS * SAMPLES + 1)
    try:
        # the motion of a whole sphere, so that it can be followed beyond the tilt at which the stem would touch
        motion = slide(top, state, Contensou(mu, PATCH), times, rtol=RTOL, progress=patience(MOST_LOOKS))
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
    rolls = last < len(begins) - 1 and motion.regime[begins[last]] != "air" and len(motion.t) == len(times)
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
    """The indices at which the nods begin: the start, then each maximum of the tilt; evenly spaced if there are
    none."""
    steps = np.diff(theta)
    tops = np.flatnonzero((steps[:-1] > 0) & (steps[1:] <= 0)) + 1
    return np.append(0, tops) if len(tops) > 2 else np.arange(0, len(theta) - SAMPLES, SAMPLES)
