"""What happened in a run, and when, determined from the run: marks in its tilt and spin, and the events of its
contacts."""

from typing import NamedTuple

import numpy as np

from app.model.events import happened
from app.model.motion import PUSHED
from app.model.phases import carried
from app.model.regimes import NAMES
from app.model.run import TableMotion
from app.text import listed, say

OF_CONTACTS = ("stem", "off", "flat", "flies", "ends")
"""Events of the story that are listed as those of its contacts."""
MOST = 16
SHORT, RATTLE = 0.05, 0.1  # s: a grip, and a touch or hop, that is too short to be seen
GRIPS, HOPS = {"sticks", "slips"}, {"lifts off", "lands"}
ON = {"both": "both", "stem": "stem", "none": "air"}


class Event(NamedTuple):
    """t in units of the run's time and in s, what happened, in words, and the state right after it, as HTML."""

    t: float
    seconds: float
    word: str
    more: str


def events_of(motion: TableMotion | None) -> tuple[Event, ...]:
    """The Events of a motion, in the page's language; at most MOST of them, and the last one."""
    if motion is None:
        return ()
    unit, words, part = motion.start.scales.time, listed("lab.events"), say(f"planes.parts.{motion.start.part}")
    found = [(t, words[code][0].format(part=part)) for t, code in happened(motion) if code not in OF_CONTACTS]
    found += _turns(motion, unit) + _touches(motion, unit, part)
    told = [(0.0, say("planes.event_list.begins")), *sorted(each for each in found if each[0] > 0.0)]
    if len(told) > MOST:
        told = [*told[: MOST - 1], told[-1]]
    return tuple(Event(t / unit, t, word, _after(motion, t / unit, part)) for t, word in told)


def _turns(motion: TableMotion, unit: float) -> list[tuple[float, str]]:
    """The first time at which the spin about its own axis, and K_R with it, is zero."""
    spin, t = motion.trajectory.omega[:, 2], motion.trajectory.t
    at = np.flatnonzero(spin[:-1] * spin[1:] < 0)
    if not len(at):
        return []
    i = int(at[0])
    zero = t[i] + (t[i + 1] - t[i]) * spin[i] / (spin[i] - spin[i + 1])
    return [(unit * float(zero), say("planes.event_list.turns"))]


def _touches(motion: TableMotion, unit: float, part: str) -> list[tuple[float, str]]:
    """The events of its contacts; those that follow each other too fast to be seen are one series. That it sticks for
    good is told as the table's grip."""
    happens = [(unit * t, event) for t, event in motion.trajectory.events if event != PUSHED]
    grips = motion.cuts.get("rolls", np.inf)
    last_slip = max((t for t, event in happens if event == "slips" and t < grips), default=0.0)
    series: list[list[tuple[float, str]]] = []
    for t, event in happens:
        if event == "sticks" and last_slip <= t <= grips < np.inf:
            continue
        if series and _continues(series[-1], t, event):
            series[-1].append((t, event))
        else:
            series.append([(t, event)])
    return [(each[0][0], _word(each, part)) for each in series]


def _continues(series: list[tuple[float, str]], t: float, event: str) -> bool:
    """Whether an event is one more of a series: of grips, or of touches, between which it may stick and slip."""
    of_grips = series[0][1] in GRIPS
    belongs = (event in GRIPS) == of_grips or (not of_grips and len(series) > 1)
    return belongs and t - series[-1][0] < (SHORT if of_grips else RATTLE)


def _word(series: list[tuple[float, str]], part: str) -> str:
    """One event, or a series of them, in words."""
    if len(series) == 1:
        return say(f"planes.event_list.words.{series[0][1]}", part=part)
    events = {event for _, event in series}
    kind = "grips" if events <= GRIPS else "hops" if events <= GRIPS | HOPS else "rattles"
    return say(f"planes.event_list.series.{kind}", part=part, end=series[-1][0])


def _after(motion: TableMotion, t: float, part: str) -> str:
    """The state right after a time."""
    moved = motion.trajectory
    i = min(int(np.searchsorted(moved.t, t, side="right")), len(moved.t) - 1)
    on = str(carried(moved, np.asarray(t)))
    does = say(f"regimes.stretch.{NAMES[int(motion.frames[-1][i])]}")
    if on != "none":
        does += " " + say(f"planes.spells.on.{ON.get(on, 'ball')}", part=part)
    return say("planes.event_list.after", does=does, tilt=float(np.degrees(moved.theta[i])),
               K_J=float(moved.jellett[i] / moved.top.I1), K_R=float(moved.routh[i]))  # fmt: skip
