"""What becomes of a body, determined from its own run: released like the arrival's toy, on the ordinary table."""

from dataclasses import dataclass

from app.model.arrival import MU, SPIN, TABLE, TILT
from app.model.events import first_times
from app.model.phases import NODS
from app.model.run import TableMotion, whole_on
from app.model.setup import start_of
from app.text import error_text, say
from tippe_core import Shape, TopError
from tippe_core.types import Number


@dataclass(frozen=True)
class Verdict:
    """code: how its run ends, as in the strip of all spins (ends.IN_LAB): "stands", "inverted", "leans", "upright", or
    "refused" if there is no such run; headline and why: in words."""

    code: str
    headline: str
    why: str


def verdict(shape: Shape) -> Verdict:
    """The Verdict on a body, in the page's language."""
    start: dict[str, Number] = {"spin": SPIN, "tilt": TILT, "mu": MU}
    try:
        motion = whole_on(TABLE, start_of(shape, SPIN, TILT, MU))
    except TopError as error:
        wording = say("build.verdict.refused_why", why=error_text(error), **start)
        return Verdict("refused", say("build.verdict.refused"), wording)
    found = first_times(motion)
    code = _end_of(motion, found)
    part = say(f"planes.parts.{motion.start.part}")
    wording = [say(f"build.verdict.{each}", time=found[each], part=part)
            for each in ("over", "stands-on-stem", "stands-inverted", "falls") if each in found]  # fmt: skip
    if "over" not in found:
        low, high = float(motion.tilt.min()), float(motion.tilt.max())
        wording = [say("build.verdict.stays", low=low, high=high, seconds=motion.start.seconds)]
    return Verdict(
        code,
        say(f"build.verdict.{code}_headline", part=part),
        " ".join([say("build.verdict.start", **start), *wording]),
    )


def _end_of(motion: TableMotion, found: dict[str, float]) -> str:
    """Whether it got to stand, though it may fall again; else how it is at the end."""
    for code, event in (("stands", "stands-on-stem"), ("inverted", "stands-inverted")):
        if event in found:
            return code
    return "leans" if motion.tilt[-1] > NODS else "upright"
