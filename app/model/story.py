"""What a motion on a table did, determined from the motion itself: marks in time, and the words for each stage.

Marks are found in the tilt, in what carried the top and in how its run ended, for any toy and start; their words are in
text/<language>/lab.toml.
"""

from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from app.model.lab.run import TableMotion, Watched
from app.model.regimes import WOULD_LIFT
from app.text import listed, say
from tippe_core.types import Array, Number

ON_ITS_SIDE, STANDS = 90.0, 170.0  # degrees: past the first it has turned over, past the second it stands
UPRIGHT, LEANS = 10.0, 20.0  # degrees: below the first it is upright, above the second it leans
NODS = 10.0  # degrees: smaller oscillations are called nodding
WHILE, PASSING = 0.2, 0.1  # s: what lasts is longer; an interruption of a stand may be this long
HOP = 0.05  # s: a shorter flight is not seen
AT_ONCE = 0.05  # s: what has begun by then was so from the beginning
AT_REST = 1e-6  # MgR: with less kinetic energy it lies still
LEAST_SPIN = 0.5  # rev/s: less is not called spinning
TENTH = (0.05, 0.15)  # degrees
UNSTAGED = ("flies",)

COME_FROM = (
    "begins",
    "high",
    "over",
    "topples",
    "stem",
    "falls",
    "off",
    "back",
)  # after these another event would have followed, had the run gone on
SPINS_ON = ("stands", "stays", "inverted", "leans")


class Mark(NamedTuple):
    """Something that happened: t in s, and a code of [events] in lab.toml."""

    t: float
    code: str


class Event(NamedTuple):
    """A Mark in words, full and short."""

    t: float
    code: str
    word: str
    short: str


class Stage(NamedTuple):
    """The words from t (s) on: a headline, the reason, and a word for the picture."""

    t: float
    headline: str
    why: str
    short: str


@dataclass(frozen=True)
class Story:
    """What a motion did. caption: a few words below it when it is shown beside others; "" on the ordinary table, where
    that is the stage's short word."""

    events: tuple[Event, ...]
    stages: tuple[Stage, ...]
    caption: str


def story(motion: TableMotion) -> Story:
    """The Story of a motion on the ordinary table, on the rough one or on ice, in the page's language."""
    found = marks(motion)
    words = listed("lab.events")
    part = say(f"planes.parts.{motion.start.part}")
    later = [mark for mark in found if mark.t > 0.0]
    events = tuple(Event(t, code, *(word.format(part=part) for word in words[code])) for t, code in later)
    if motion.table == "ordinary":
        return Story(events, _Ordinary(motion, found).stages(), "")
    return Story(events, (_quiet(motion),), _caption(motion))


# ---- what happened ----


def marks(motion: Watched) -> tuple[Mark, ...]:
    """The marks of a motion, in order; at its very beginning only the one that it ends."""
    t, ended = motion.seconds, _ended(motion)
    found = [*_over(motion), *_touches(motion)]
    if motion.table == "ordinary":
        found += [*_stands(motion), *_settles(motion)]
    if ended:
        found = [mark for mark in found if mark.t <= ended.t] + [ended]
    elif motion.ending and motion.rolls_since >= 0.0:  # while rolling, it passes the same tilts again and again
        found = [mark for mark in found if mark.t < motion.rolls_since]
        lies = motion.trajectory.ledger.kinetic[-1] < AT_REST
        found.append(Mark(motion.rolls_since, "lies" if lies else "rolls"))
    return tuple(sorted(mark for mark in found if mark is ended or t[0] < mark.t < t[-1]))


def _over(motion: Watched) -> list[Mark]:
    """It passes a right angle for the first time, or comes back for the last time."""
    theta, times, a = motion.tilt, motion.crossings * motion.start.scales.time, motion.start.top.a
    found: list[Mark] = []
    if not a:  # a uniform ball has no heavy side
        return found
    if len(times) and motion.starts_below:
        found.append(Mark(float(times[0]), "over" if a > 0 else "topples"))
    if len(times) and theta[-1] < ON_ITS_SIDE - NODS and theta.max() > ON_ITS_SIDE + NODS:
        found.append(Mark(float(times[-1]), "back"))
    return found


def _touches(motion: Watched) -> list[Mark]:
    """The stem touches for the first time; the top leaves the table for longer than a hop; the stem lifts off for the
    last time."""
    scale, stretches = motion.start.scales.time, motion.ending.stretches if motion.ending else ()
    touch = next((each.start for each in stretches if each.on in ("stem", "both")), None)
    flight = next(
        (each.start for each in stretches if each.on == "air" and (each.end - each.start) * scale > HOP), None
    )
    found = [] if touch is None else [Mark(touch * scale, "stem")]
    if flight is not None:
        found.append(Mark(flight * scale, "flies"))
    last = next((each for each in reversed(stretches) if each.on in ("stem", "both")), None)
    if touch is not None and last and stretches[-1].on == "ball" and (last.end - touch) * scale > WHILE:
        found.append(Mark(last.end * scale, "off"))
    return found


def _stands(motion: Watched) -> list[Mark]:
    """It begins to stand, that is, stays above STANDS for a while; and falls again."""
    t, theta, found = motion.seconds, motion.tilt, list[Mark]()
    if not motion.start.top.a:
        return found
    for start, end in lasting(t, theta, STANDS):
        inside = (t >= start) & (t <= end)
        stem = np.isin(motion.carried[inside], ("stem", "both")).mean() > 0.5
        found.append(Mark(start, "stands" if stem else "inverted"))
        if end < t[-1]:
            found.append(Mark(end, "falls"))
    return found


def lasting(t: Array, theta: Array, level: float) -> list[tuple[float, float]]:
    """The intervals in which theta is above a level: those longer than WHILE, ignoring gaps shorter than PASSING."""
    above = np.concatenate([[False], theta > level, [False]])
    starts, ends = np.flatnonzero(~above[:-1] & above[1:]), np.flatnonzero(above[:-1] & ~above[1:])
    spells: list[tuple[float, float]] = []
    for i, j in zip(starts, ends, strict=True):
        start = float(t[0] if i == 0 else np.interp(level, theta[i - 1 : i + 1], t[i - 1 : i + 1]))
        end = float(t[-1] if j == len(t) else np.interp(level, theta[j : j - 2 : -1], t[j : j - 2 : -1]))
        if spells and start - spells[-1][1] < PASSING:
            start = spells.pop()[0]
        spells.append((start, end))
    return [spell for spell in spells if spell[1] - spell[0] > WHILE]


def _settles(motion: Watched) -> list[Mark]:
    """It comes to rest at a tilt, or upright."""
    t, theta = motion.seconds, motion.tilt
    last = theta[-1]
    away = np.flatnonzero(np.abs(theta - last) > (NODS / 2 if last < UPRIGHT else NODS))
    if not len(away) or UPRIGHT < last < LEANS or last > STANDS or t[-1] - t[away[-1]] < 2 * WHILE:
        return []
    since = float(t[away[-1] + 1])
    return [Mark(since, "upright" if last < UPRIGHT else "leans")] if since > AT_ONCE else []


def _ended(motion: Watched) -> Mark | None:
    """What ended it early."""
    if not motion.ended or len(motion.trajectory.t) == len(motion.t):
        return None
    time = motion.trajectory.events[-1][0] * motion.start.scales.time
    return Mark(time, "flat" if motion.ended == "stands upright" else "ends")


# ---- the words ----


class _Ordinary:
    """The stages of a motion on the ordinary table."""

    def __init__(self, motion: TableMotion, found: tuple[Mark, ...]) -> None:
        self.motion, self.part = motion, say(f"planes.parts.{motion.start.part}")
        rests = min((mark.t for mark in found if mark.code in ("leans", "upright")), default=np.inf)
        staged = [mark for mark in found if mark.code not in UNSTAGED and (mark.code != "stem" or mark.t < rests)]
        first = staged[0] if staged and staged[0].t <= 0.0 else Mark(0.0, self._first(staged))
        all_marks = [first, *(mark for mark in staged if mark is not first)]
        # a stage that is too short to be read is skipped, but not the last one
        self.marks = [mark for mark, after in pairwise(all_marks) if after.t - mark.t > WHILE or mark is first]
        self.marks += all_marks[-1:] if len(all_marks) > 1 else [first]

    def _first(self, staged: list[Mark]) -> str:
        """The code of the first stage."""
        motion, theta, a = self.motion, self.motion.tilt, self.motion.start.top.a
        codes = [mark.code for mark in staged]
        if motion.carried[0] in ("stem", "both"):
            return "stays" if theta[0] > STANDS else "begins"
        if not motion.start.spin:
            return "rest" if np.ptp(theta) < NODS / 10 else "still" if a > 0 else "drops"
        if a < 0 and theta.max() - theta[0] > NODS:
            return "sinks"
        if "over" in codes:
            return "rises"
        if theta[0] > ON_ITS_SIDE and codes:
            return "high"
        if "upright" in codes or (a < 0 and theta[0] > UPRIGHT and theta[0] - theta[-1] > NODS / 2):
            return "rights"
        if "rolls" in codes:
            return "slips"
        if np.ptp(theta) < NODS:
            return "nods" if a > 0 else "sleeps"
        return "part" if a > 0 and theta.max() - theta[0] > NODS > theta[0] - theta.min() else "moves"

    def stages(self) -> tuple[Stage, ...]:
        after = [*self.marks[1:], None]
        return tuple(self._stage(mark, then) for mark, then in zip(self.marks, after, strict=True))

    def _stage(self, mark: Mark, then: Mark | None) -> Stage:
        numbers = self._numbers(mark)
        steady = mark.code == "rolls" and f"{numbers['low']:.1f}" == f"{numbers['high']:.1f}"
        code = "circles" if steady else mark.code
        why = say(f"lab.stages.{code}.why", **numbers)
        if mark.code in ("stands", "inverted") and not any(each.code == "over" for each in self.marks):
            why = ""  # nothing turned it over, so it was put down that way
        if then:
            why += " " + say(f"lab.next.{then.code}", **self._numbers(then))
        elif mark.code in SPINS_ON and abs(numbers["last"]) >= LEAST_SPIN:
            why += " " + say("lab.next.spins", **numbers)
        elif mark.code in COME_FROM:
            why += " " + say("lab.next.tilt", **numbers)
        elif mark.code == "rolls":
            why += " " + say("lab.next.forever")
        if not then and self.motion.is_cut:
            why += " " + say("lab.next.cut", **numbers)
        short = say(f"lab.stages.{code}.short", **numbers)
        return Stage(mark.t, say(f"lab.stages.{code}.headline", **numbers), why.strip(), short[:1].upper() + short[1:])

    def _numbers(self, mark: Mark) -> dict[str, Number]:
        """All numbers that the words of a mark may quote."""
        motion = self.motion
        t, theta, curves = motion.seconds, motion.tilt, motion.curves
        at = min(int(np.searchsorted(curves[:, 0], mark.t)), len(curves) - 1)
        until = curves[: at + 1]
        rolling = theta[t >= mark.t]
        happens = say(f"planes.events.{motion.ended}", part=self.part) if motion.ended else ""
        return {
            "time": mark.t, "seconds": motion.start.seconds, "from": float(theta[0]), "end": float(theta[-1]),
            "least": float(theta.min()), "most": float(theta.max()), "tilt": float(curves[at:, 1].mean()),
            "low": float(rolling.min()) if mark.code == "rolls" else float(until[0, 2]),
            "high": float(rolling.max()) if mark.code == "rolls" else float(curves[:, 2].max()),
            "start": float(curves[0, 3] + curves[0, 4]), "left": float(curves[at, 3]),
            "spin": abs(float(curves[at, 5])), "first": abs(float(curves[0, 5])), "last": abs(float(curves[-1, 5])),
            "happens": happens, "part": self.part,
        }  # fmt: skip


def _quiet(motion: TableMotion) -> Stage:
    """The stage of a motion on the rough table or on ice."""
    low, high, table = float(motion.tilt.min()), float(motion.tilt.max()), motion.table
    name = "steady" if f"{low:.1f}" == f"{high:.1f}" else "why"
    why = [say(f"lab.{table}.{name}", low=low, high=high)]
    energy = float(motion.curves[0, 3] + motion.curves[0, 4])
    if table == "rough" and motion.curves[0, 4] > 0.05:
        why.append(say("lab.rough.gripped", start=energy, lost=float(motion.curves[0, 4])))
    if table == "rough" and any(which == WOULD_LIFT for *_, which in motion.stretches):
        why.append(say("lab.rough.lifts"))
    if ended := _ended(motion):
        kind = "stem" if motion.ended == "stem touches" else "air"
        why.append(say(f"lab.stopped.{kind}", time=ended.t, part=say(f"planes.parts.{motion.start.part}")))
    return Stage(0.0, say(f"lab.{table}.headline"), " ".join(why), say(f"lab.{table}.short"))


def _caption(motion: TableMotion) -> str:
    low, high = float(motion.tilt.min()), float(motion.tilt.max())
    by = high - low
    if by < TENTH[0]:
        return say("lab.caption.stays", low=low)
    if by < TENTH[1]:
        return say("lab.caption.tenth")
    return say("lab.caption.little", by=by) if by < 1 else say("lab.caption.nods", low=low, high=high)
