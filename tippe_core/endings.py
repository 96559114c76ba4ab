"""What a motion of slide() did, read from it: on what it stood, for how long, where it is in the end, what follows."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from .errors import TopError
from .motion.tally import LAST, LEANS, UPRIGHT
from .motion.trajectory import Trajectory
from .outcomes import steady_states
from .types import Array, Bools

# QUIET: friction that takes less than this share of the kinetic energy in the last of the time changes nothing more.
QUIET = 1e-3
# CREEPS, THERE (rad): a mean tilt that changes by less, beside what it swings, stays where it is; so near its end it
# is there.
CREEPS, THERE = 1e-3, 3.5e-3
# SUNK (R): so far below the table a point of the body counts as in it; rounding and a coarse rtol sink less.
SUNK = 1e-3
ANGLES = 1024  # for which lowest() looks at a profile at once
REFUSED = ("rim touches", "another part touches", "Painleve's limit")
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
    creeps     it is settled, and yet its mean tilt still goes on to where it will be
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


def ending(trajectory: Trajectory) -> Ending:
    """The Ending of a Trajectory of slide()."""
    if not isinstance(trajectory, Trajectory):
        raise TopError("trajectory", trajectory, "Trajectory", code="wrong-kind")
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
    creeps = settled and not rolls and on == "ball" and _creeps(moved, last)
    return Ending(found, end, on, float(since), least, most, ended, flat=ended == "stands upright", settled=settled,
                  cut=not ended and not settled, creeps=creeps)  # fmt: skip


def _ended(moved: Trajectory) -> str:
    """The event that ended it: the Trajectory has no sample there."""
    if not moved.events:
        return ""
    time, event = moved.events[-1]
    return event if event in STOPS or time > moved.t[-1] or len(moved.t) == 1 else ""


def _swings(moved: Trajectory) -> bool:
    """Whether it has rolled long enough to come back: through two turning points of theta since it last slipped."""
    slipped = moved.t[moved.regime != "roll"][-1:]
    event = max([moved.t[0], *slipped, *(time for time, _ in moved.events[-1:])])
    since = min(int(np.searchsorted(moved.t, event)), len(moved.t) - 1)
    theta, w1 = moved.theta[since:], moved.omega[since:, 0]
    return bool(np.ptp(theta) < 1e-6 or np.count_nonzero(np.diff(np.sign(w1))) > 1)


def _quiet(moved: Trajectory, last: Bools, on: str) -> bool:
    """Whether friction takes nothing any more, and on the ball alone whether that is at a stable steady state."""
    t, heat, kinetic = moved.t[last], moved.heat[last], moved.ledger.kinetic[-1]
    first, second = np.diff(np.interp([t[0], (t[0] + t[-1]) / 2, t[-1]], t, heat))
    if on in ("air", "") or first + second > QUIET * kinetic + 1e-9 or second > first + 1e-9:
        return False
    if on != "ball":
        return True
    return _from_stable(moved, last) < LEANS


def _from_stable(moved: Trajectory, last: Bools) -> float:
    """How far the mean of theta is from a stable steady state of the ball; 0 for a uniform ball, which has none."""
    steady, theta = steady_states(moved.top, moved.jellett[-1]), moved.theta[last].mean()
    return float(np.abs(steady.theta[steady.stable] - theta).min()) if any(steady.stable) else 0.0


def lowest(profile: Array, theta: Array) -> Array:
    """How far the lowest point of a profile, (k, 2) of radius and height above O in R, is above O at theta (n,)."""
    radius, z = profile.T[:, :, None]
    parts = np.array_split(theta, len(theta) // ANGLES + 1)  # so that a long motion takes no more memory
    return np.concatenate([(z * np.cos(part) - radius * np.sin(part)).min(axis=0) for part in parts])


def sunk(trajectory: Trajectory, profile: Array) -> int:
    """The first row at which a part of the profile that slide() does not know of is in the table, or how many there
    are: it knows the sphere and one edge, and an upper rim or another corner may come to the table past these. The
    profile as in lowest()."""
    height = trajectory.com[:, 2] + trajectory.top.a * np.cos(trajectory.theta) + lowest(profile, trajectory.theta)
    return int(np.argmax(np.append(height < -SUNK, True)))


def _creeps(moved: Trajectory, last: Bools) -> bool:
    """Whether the mean of theta still changes over the last two fifths of the time, and is not where it goes."""
    if _from_stable(moved, last) < THERE:
        return False
    last = moved.theta[moved.t >= moved.t[-1] - 4 * LAST * (moved.t[-1] - moved.t[0])]
    early, late = (part.mean() for part in np.array_split(last, 2))
    return bool(abs(late - early) > CREEPS + np.ptp(last) / 10)


def stretches(trajectory: Trajectory) -> tuple[Stretch, ...]:
    """(Stretch, ...) of a Trajectory: its supports."""
    times = [*(time for time, _ in trajectory.supports), float(trajectory.t[-1])]
    return tuple(
        Stretch(start, max(start, end), {"none": "air"}.get(on, on))
        for (start, on), end in zip(trajectory.supports, times[1:], strict=True)
    )
