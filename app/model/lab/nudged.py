"""How predictable a run is: the same run, tilted a millionth of a radian more at its start."""

from app.model.motion import Progress, sliding_of
from app.model.run import TableMotion
from tippe_core import beside, growth

NUDGE, BESIDE = 1e-6, 3.0  # rad, s: the additional tilt of the second run, and how long it continues after a touch


def hits(motion: TableMotion | None) -> bool:
    """Whether anything but its ball touched; that makes a motion sensitive to its start. Not if it is pushed, which the
    second run is not."""
    return motion is not None and not motion.pushes and motion.ending is not None and len(motion.ending.stretches) > 1


def nudged(motion: TableMotion, progress: Progress | None = None) -> float:
    """The largest factor by which NUDGE, added to the initial tilt, grows in theta on the ordinary table; BESIDE after
    the first touch is long enough to tell. progress: called with the fraction done; what it raises stops the run."""
    start = motion.start
    assert motion.ending is not None  # something touched there
    moved, until = motion.trajectory, motion.ending.stretches[0].end + BESIDE / start.scales.time
    near = sliding_of(start, beside(start.state, NUDGE)).until(moved.t[moved.t <= until], progress)
    return growth(moved, near, NUDGE)
