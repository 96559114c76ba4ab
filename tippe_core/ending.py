"""What a motion of slide() did, read from it: on what it stood, for how long, where it is in the end, what follows."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from .errors import TopError
from .outcome import steady_states
from .trajectory import Trajectory

# LAST: the share of the time by which the end is told. UPRIGHT, LEANS (rad): so near to a pole, and so little change of
# the tilt.
LAST, UPRIGHT, LEANS = 0.1, 0.2, 0.05
# QUIET: friction that takes less than this share of the kinetic energy in the last of the time changes nothing more.
QUIET = 1e-3
REFUSED = ("rim touches", "Painleve's limit")
STOPS = ("stands upright", "too many events", "too many turns", *REFUSED)


class Stretch(NamedTuple):
    """From start to end in (R/g)^1/2 on "ball", "stem" or "both", or in the "air"."""

    start: float
    end: float
    on: str


@dataclass(frozen=True)
class Ending:
    """What became of a motion.

    stretches  Stretch after Stretch, neighbours different
    end        by the last tenth of its time: "refused" (it came where nothing can be computed: ended says which),
               "stem" (on its stem alone), "upright" (on its ball, theta < 0.2), "inverted" (on its ball,
               theta > pi - 0.2), "leaning" (theta within 0.05 rad, on what `on` says), "rolling" (sticks, nutating),
               "moving" (none of these)
    on         on what it is all through that tenth; "" where that changes
    since      when that tenth begins, (R/g)^1/2
    least, most   theta in it, rad
    ended      the event that ended it before its time, "" if none did
    flat       it stands flat on the end of its stem
    settled    nothing more follows: it rolls and was seen to swing there and back, or friction takes nothing any more
               and it is where it would come back to
    cut        the end of the time is all that ended it, and it still changes
    """

    stretches: tuple
    end: str
    on: str
    since: float
    least: float
    most: float
    ended: str
    flat: bool
    settled: bool
    cut: bool


def ending(trajectory):
    """The Ending of a Trajectory of slide()."""
    if not isinstance(trajectory, Trajectory):
        raise TopError("trajectory", trajectory, "a Trajectory")
    moved, found, ended = trajectory, stretches(trajectory), _ended(trajectory)
    since = moved.t[-1] - LAST * (moved.t[-1] - moved.t[0])
    last = moved.t >= since
    theta = moved.theta[last]
    least, most = float(theta.min()), float(theta.max())
    carries = {stretch.on for stretch in found if stretch.end > since} or {found[-1].on}
    on = carries.pop() if len(carries) == 1 else ""
    rolls = bool(np.all(moved.regime[last] == "roll"))
    settled = not ended and (_swings(moved) if rolls else most - least < LEANS and _quiet(moved, last, on))
    if ended in REFUSED:
        end = "refused"
    elif on == "stem":
        end = "stem"
    elif on == "ball" and most < UPRIGHT:
        end = "upright"
    elif on == "ball" and least > np.pi - UPRIGHT:
        end = "inverted"
    elif most - least < LEANS:
        end = "leaning"
    else:
        end = "rolling" if rolls else "moving"
    return Ending(found, end, on, float(since), least, most, ended, flat=ended == "stands upright", settled=settled,
                  cut=not ended and not settled)  # fmt: skip


def _ended(moved):
    """The event that ended it: the Trajectory has no sample there."""
    if not moved.events:
        return ""
    time, event = moved.events[-1]
    return event if event in STOPS or time > moved.t[-1] or len(moved.t) == 1 else ""


def _swings(moved):
    """Whether it has rolled long enough to come back: through two turning points of theta since it last slipped."""
    since = int(np.flatnonzero(np.append(True, moved.regime != "roll"))[-1])
    theta, w1 = moved.theta[since:], moved.omega[since:, 0]
    return bool(np.ptp(theta) < 1e-6 or np.count_nonzero(np.diff(np.sign(w1))) > 1)


def _quiet(moved, last, on):
    """Whether friction takes nothing any more, and on the ball alone whether that is at a stable steady state."""
    t, heat, entries = moved.t[last], moved.heat[last], moved.ledger
    kinetic = (entries.spin + entries.precession + entries.nutation + entries.translation)[-1]
    first, second = np.diff(np.interp([t[0], (t[0] + t[-1]) / 2, t[-1]], t, heat))
    if on in ("air", "") or first + second > QUIET * kinetic + 1e-9 or second > first + 1e-9:
        return False
    if on != "ball":
        return True
    steady, theta = steady_states(moved.top, moved.jellett[-1]), moved.theta[last].mean()
    stable = np.append(steady.theta[steady.stable], theta if not any(steady.stable) else np.inf)  # a uniform ball
    return bool(np.abs(stable - theta).min() < LEANS)


def stretches(trajectory):
    """(Stretch, ...) of a Trajectory: its supports."""
    times = [*(time for time, _ in trajectory.supports), float(trajectory.t[-1])]
    return tuple(
        Stretch(start, max(start, end), {"none": "air"}.get(on, on))
        for (start, on), end in zip(trajectory.supports, times[1:], strict=True)
    )
