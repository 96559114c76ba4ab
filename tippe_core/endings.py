"""Reads from a motion of slide() how it went: which contacts carried the top and for how long, and how it ended."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from .classify import LAST, LEANS, judged
from .errors import checked
from .motion.events import ENDS, EVENTS, REASONS
from .motion.trajectory import ANOTHER_TOUCHES, Trajectory
from .outcomes import steady_states
from .types import Bools

# QUIET: friction that takes less than this share of the kinetic energy in the last of the time changes nothing more.
QUIET = 1e-3
# CREEPS, THERE (rad): a mean tilt that changes by less, beside what it swings, stays where it is; so near its end it
# is there.
CREEPS, THERE = 1e-3, 3.5e-3
REFUSED = (*(EVENTS[event][0] for event in REASONS), ANOTHER_TOUCHES)
STOPS = (*(name for name, after in EVENTS if after == ENDS), ANOTHER_TOUCHES)


class Stretch(NamedTuple):
    """A time interval on one support.

    Attributes
    ----------
    start, end : float
        (R/g)^1/2
    on : str
        "ball", "stem", "both" or "air"
    """

    start: float
    end: float
    on: str


@dataclass(frozen=True)
class Ending:
    """How a motion went, and how it ended.

    Attributes
    ----------
    stretches : tuple of Stretch
        one after the other; neighbours differ
    end : str
        judged by the last tenth of the time: "refused" (it reached a state beyond which nothing can be computed:
        ended says which), "stem" (on its stem alone), "upright" (on its ball, theta < 0.2), "inverted" (on its
        ball, theta > pi - 0.2), "leaning" (theta constant within 0.05 rad, on the support `on`), "rolling" (without
        slipping, nutating), "moving" (none of these)
    on : str
        the support throughout that tenth; "" if it changes
    since : float
        when that tenth begins, (R/g)^1/2
    least, most : float
        the range of theta in it, rad
    ended : str
        the event that ended the motion early, "" if none did
    flat : bool
        it stands flat on the end of its stem
    settled : bool
        nothing more will happen: it rolls and has completed a full nutation, or friction no longer dissipates and
        the tilt is a stable one
    cut : bool
        it was still changing when the time was over
    creeps : bool
        it is settled, but its mean tilt still moves slowly to its final value
    """

    stretches: tuple[Stretch, ...]
    end: str
    on: str
    since: float
    least: float
    most: float
    ended: str
    flat: bool
    settled: bool
    cut: bool
    creeps: bool


@checked
def ending(trajectory: Trajectory) -> Ending:
    """How a motion went, and how it ended.

    Parameters
    ----------
    trajectory : Trajectory
        from slide()

    Returns
    -------
    Ending
        the supports, and the end by the last tenth of the time

    Raises
    ------
    TopError
        for anything but a Trajectory
    """
    moved, found, ended = trajectory, stretches(trajectory), _ended(trajectory)
    since = moved.t[-1] - LAST * (moved.t[-1] - moved.t[0])
    last = moved.t >= since
    theta = moved.theta[last]
    least, most = float(theta.min()), float(theta.max())
    carries = {stretch.on for stretch in found if stretch.end > since} or {found[-1].on}
    on = carries.pop() if len(carries) == 1 else ""
    rolls = bool(np.all(moved.regime[last] == "roll"))
    settled = not ended and (_swings(moved) if rolls else most - least < LEANS and _quiet(moved, last, on))
    end = judged(ended in REFUSED, on, least, most, rolls)
    creeps = settled and not rolls and on == "ball" and _creeps(moved, last)
    return Ending(found, end, on, float(since), least, most, ended, flat=ended == "stands upright", settled=settled,
                  cut=not ended and not settled, creeps=creeps)  # fmt: skip


def _ended(moved: Trajectory) -> str:
    """The event that ended the motion; the Trajectory has no sample there."""
    if not moved.events:
        return ""
    time, event = moved.events[-1]
    return event if event in STOPS or time > moved.t[-1] or len(moved.t) == 1 else ""


def _swings(moved: Trajectory) -> bool:
    """Whether it has rolled for a full nutation: through two turning points of theta since it last slipped."""
    slipped = moved.t[moved.regime != "roll"][-1:]
    event = max([moved.t[0], *slipped, *(time for time, _ in moved.events[-1:])])
    since = min(int(np.searchsorted(moved.t, event)), len(moved.t) - 1)
    theta, w1 = moved.theta[since:], moved.omega[since:, 0]
    return bool(np.ptp(theta) < 1e-6 or np.count_nonzero(np.diff(np.sign(w1))) > 1)


def _quiet(moved: Trajectory, last: Bools, on: str) -> bool:
    """Whether friction no longer dissipates and, if only the ball carries, whether the top is at a stable steady
    state."""
    t, heat, kinetic = moved.t[last], moved.heat[last], moved.ledger.kinetic[-1]
    first, second = np.diff(np.interp([t[0], (t[0] + t[-1]) / 2, t[-1]], t, heat))
    if on in ("air", "") or first + second > QUIET * kinetic + 1e-9 or second > first + 1e-9:
        return False
    if on != "ball":
        return True
    return _from_stable(moved, last) < LEANS


def _from_stable(moved: Trajectory, last: Bools) -> float:
    """Distance (rad) of the mean theta from a stable steady state on the ball; 0 for a uniform ball, which has none."""
    steady, theta = steady_states(moved.top, moved.jellett[-1]), moved.theta[last].mean()
    return float(np.abs(steady.theta[steady.stable] - theta).min()) if any(steady.stable) else 0.0


def _creeps(moved: Trajectory, last: Bools) -> bool:
    """Whether the mean of theta still changes over the last two fifths of the time, and has not reached its final
    value."""
    if _from_stable(moved, last) < THERE:
        return False
    last = moved.theta[moved.t >= moved.t[-1] - 4 * LAST * (moved.t[-1] - moved.t[0])]
    early, late = (part.mean() for part in np.array_split(last, 2))
    return bool(abs(late - early) > CREEPS + np.ptp(last) / 10)


def stretches(trajectory: Trajectory) -> tuple[Stretch, ...]:
    """The supports of a Trajectory as a tuple of Stretches."""
    times = [*(time for time, _ in trajectory.supports), float(trajectory.t[-1])]
    return tuple(
        Stretch(start, max(start, end), {"none": "air"}.get(on, on))
        for (start, on), end in zip(trajectory.supports, times[1:], strict=True)
    )
