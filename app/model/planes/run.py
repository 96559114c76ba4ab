"""Computes the Picture of Setup: the same top on the three planes, and a second, slightly disturbed sliding run.

It runs in a thread, which has no page, so it is told in which language to say why there is no motion.
"""

from types import MappingProxyType

from app.model.motion import Progress, for_reader, slid
from app.model.planes.picture import BY, SET, Picture
from app.model.run import TableMotion, computed, watched, why_not
from app.model.runs import look
from app.model.setup import TABLES, Setup
from tippe_core import (
    TopError,
    beside,
    growth,
    outcome,
)

NUDGE, BESIDE = 1e-6, 3.0  # rad, s: the additional tilt of the disturbed run, and how long it continues after a touch


def solve(settings: Setup, progress: Progress | None = None) -> Picture:
    """The Picture. progress: called with the fraction done; what it raises stops the run. Raises TopError, whose name
    is the input at fault."""
    top, state, times = settings.top, settings.state, settings.times
    motions: dict[str, TableMotion | None] = {}
    messages: dict[str, str] = {}
    for plane in TABLES:
        try:
            trajectory, lost = computed(settings, plane, progress or look)
            motions[plane] = watched(trajectory, settings, times, plane, lost, whole=True)
        except TopError as error:
            if plane == "ordinary":
                raise
            motions[plane], messages[plane] = None, why_not(for_reader(error, settings.scales))
    return Picture(
        settings=settings, state=state, friction=settings.friction, motions=MappingProxyType(motions),
        outcome=outcome(top, state), messages=MappingProxyType(messages),
        inputs=MappingProxyType({name: getattr(settings, name) for name in SET} | {"by": BY[settings.rolling is None]}),
    )  # fmt: skip


def nudged(picture: Picture, progress: Progress | None = None) -> float:
    """The largest factor by which NUDGE, added to the initial tilt, grows in theta on the sliding plane; BESIDE after
    the first touch is long enough to tell."""
    settings, state, motion = picture.settings, picture.state, picture.motions["ordinary"]
    assert motion is not None and motion.ending is not None  # something touched there
    moved, until = motion.trajectory, motion.ending.stretches[0].end + BESIDE / settings.scales.time
    near = slid(settings, beside(state, NUDGE), moved.t[moved.t <= until], progress)
    return growth(moved, near, NUDGE)


def hits(picture: Picture) -> bool:
    """Whether anything but its ball touched; that makes a motion sensitive to its start."""
    motion = picture.motions["ordinary"]
    return motion is not None and motion.ending is not None and len(motion.ending.stretches) > 1
