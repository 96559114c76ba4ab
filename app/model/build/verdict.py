"""Whether a body turns over, determined from its own run: released like the arrival's toy, on the ordinary table."""

from dataclasses import dataclass

from app.model.arrival import MU, SPIN, TABLE, TILT
from app.model.events import first_times
from app.model.run import whole_on
from app.model.setup import start_of
from app.text import say, told
from tippe_core import Shape, TopError
from tippe_core.types import Number


@dataclass(frozen=True)
class Verdict:
    """code: "over", "not", or "refused" if there is no such run; headline and why: in words."""

    code: str
    headline: str
    why: str


def verdict(shape: Shape) -> Verdict:
    """The Verdict on a body, in the page's language."""
    start: dict[str, Number] = {"spin": SPIN, "tilt": TILT, "mu": MU}
    try:
        motion = whole_on(TABLE, start_of(shape, SPIN, TILT, MU))
    except TopError as error:
        said = say("build.verdict.refused_why", why=told(error), **start)
        return Verdict("refused", say("build.verdict.refused"), said)
    found = first_times(motion)
    code = "over" if "over" in found else "not"
    part = say(f"planes.parts.{motion.start.part}")
    said = [say(f"build.verdict.{each}", time=found[each], part=part)
            for each in ("over", "stands-on-stem", "stands-inverted", "falls") if each in found]  # fmt: skip
    if code == "not":
        low, high = float(motion.tilt.min()), float(motion.tilt.max())
        said = [say("build.verdict.stays", low=low, high=high, seconds=motion.start.seconds)]
    return Verdict(code, say(f"build.verdict.{code}_headline"), " ".join([say("build.verdict.start", **start), *said]))
