"""How the motion of a top on the sliding plane ended, determined from its run."""

import numpy as np

from app.model.motion import Motion
from app.model.planes.picture import Picture

# A tilt whose least and largest change by less than STEADY (rad) between the last two fifths of the time neither rises
# nor falls. SHARE of the tilt, or of what it swings, counts as a change where the tilt is small.
STEADY, SHARE = np.radians(0.5), 0.1
STILL = 1e-6  # rad: a tilt that stays within it has not left its balance
NEAR_UPRIGHT = np.radians(2)


def became(picture: Picture, motion: Motion) -> str:
    """The key in planes.toml of how the motion on the sliding plane ended."""
    found, theta, a = motion.ending, motion.trajectory.theta, picture.settings.top.a
    assert found is not None  # of the sliding plane
    if found.flat:
        return "flat"
    if found.ended:
        return "refused"
    if picture.outcome.nudged and np.ptp(theta) < STILL and all(each.on == "ball" for each in found.stretches):
        return "balances"
    if found.on == "ball" and np.all(motion.trajectory.regime[motion.trajectory.t >= found.since] == "roll"):
        return "rolls"
    if found.end == "upright" and (found.most > NEAR_UPRIGHT or trend(motion) == "rises"):
        return "leaning" if found.settled or trend(motion) == "takes" else "moving"
    if found.end == "upright":
        return "upright" if theta[0] < np.pi / 2 else "comes"
    if found.end == "inverted":
        return "inverted" if theta[0] > np.pi / 2 else "turns" if a >= 0 else "falls"
    if found.end == "leaning" and found.on == "both":
        return "both"
    return found.end


def trend(motion: Motion) -> str:
    """Whether its tilt "rises" or "falls" in the last two fifths of the time, more than it swings; or only "takes"."""
    moved = motion.trajectory
    last = moved.t >= moved.t[-1] - 0.4 * (moved.t[-1] - moved.t[0])
    early, late = np.array_split(moved.theta[last], 2)
    least = min(STEADY, SHARE * moved.theta[last].max())
    drifts = late.min() - early.min(), late.max() - early.max()
    if abs(late.mean() - early.mean()) < SHARE * np.ptp(moved.theta[last]):
        return "takes"
    return "rises" if min(drifts) > least else "falls" if max(drifts) < -least else "takes"
