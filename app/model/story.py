"""What the page says of a motion on a table, made of the phases of that motion and of its numbers.

Words are in text/<language>/lab.toml, under the kinds of phases and their variants. A variant that names a cause is
chosen only where the run, or the stability of this top, shows that it is the cause.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from app.model.events import happened
from app.model.phases import SIDE, SPINS, Phase
from app.model.pushes import size_words
from app.model.regimes import WOULD_LIFT
from app.model.run import TableMotion
from app.model.setup import Push
from app.text import listed, say
from tippe_core import thresholds
from tippe_core.types import Array, Number

STANDS = ("stands-on-stem", "stands-upright", "stands-inverted")
TENTH = (0.05, 0.15)  # degrees
SAME, STEADY = 0.05, 0.5  # the share that is not called a change; degrees within which a tilt is called steady
SAID = 0.5  # mm: less energy is not worth a word
LINGERS = 1.0  # s: so long after a push what it does may be its work
AROUND = np.pi / 2  # rad: what goes round turns by more
BALANCE = 1e-4  # degrees: what stays within it has not left its balance
BACK = 3  # turns of the tilt: it has come back twice


class Event(NamedTuple):
    """Something that happened: t in s, its code in [events] of lab.toml, and its words, full and short."""

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
    """What a motion did: a Stage for each of its phases, and one from each push in it on. caption: a few words below it
    when it is shown beside others; "" on the ordinary table, where that is the stage's short word.
    """

    events: tuple[Event, ...]
    stages: tuple[Stage, ...]
    caption: str


def story(motion: TableMotion) -> Story:
    """The Story of a motion, in the page's language."""
    words, part = listed("lab.events"), _part(motion)
    events = tuple(Event(t, code, *(word.format(part=part) for word in words[code]))
                   for t, code in happened(motion) if t > 0.0)  # fmt: skip
    return Story(events, _Told(motion).stages(), "" if motion.table == "ordinary" else _caption(motion))


def _part(motion: TableMotion) -> str:
    return say(f"planes.parts.{motion.start.part}")


def _happens(motion: TableMotion) -> str:
    """What ended a motion early."""
    return say(f"planes.events.{motion.ended}", part=_part(motion))


class _Told:
    """The stages of a motion."""

    def __init__(self, motion: TableMotion) -> None:
        self.motion, self.phases, self.a = motion, motion.phases, motion.start.top.a
        self.kinds = [phase.kind for phase in self.phases]
        slides = motion.start.is_frictionless and not motion.trajectory.heat.any()
        self.table = "ice" if slides and motion.table == "ordinary" else motion.table
        self.quiet = self.table != "ordinary"
        self.curves = motion.curves.astype(float)
        self.turns = motion.start.turns

    def stages(self) -> tuple[Stage, ...]:
        return tuple(stage for i, phase in enumerate(self.phases) for stage in self._from_pushes(i, phase))

    def _from_pushes(self, i: int, phase: Phase) -> Iterator[Stage]:
        """The Stage of a phase, and the same with a word on each push from it on."""
        stage = first = self._stage(i, phase)
        for push, _, gain in self._pushes(phase):
            height = 1e3 * self.motion.start.scales.R * gain
            wording = say("lab.pushed.told", time=push.t, size=size_words(push))
            if abs(height) >= SAID:
                wording += " " + say(f"lab.pushed.{'gave' if height > 0 else 'took'}", energy=abs(height))
            if push.t > phase.start:
                yield stage
                stage = stage._replace(t=push.t)
            stage = stage._replace(why=f"{wording} {first.why}".strip())
        yield stage

    def _pushes(self, phase: Phase) -> list[tuple[Push, int, float]]:
        """Those in a phase or shortly before it."""
        end = phase.end + (phase is self.phases[-1])
        return [each for each in self.motion.pushes if phase.start - LINGERS < each[0].t < end]

    def _stage(self, i: int, phase: Phase) -> Stage:
        numbers, code = self._numbers(i, phase), self._code(i, phase)
        why = " ".join(filter(None, [*self._whys(i, phase, code, numbers), *self._afterwards(i, phase, numbers)]))
        headline, short = (say(f"lab.stages.{code}.{name}", **numbers) for name in ("headline", "short"))
        if self.quiet and self._stays_low and code in ("nods", "leans", "rests", "swings", "upright"):
            headline, short = (say(f"lab.{self.table}.{name}") for name in ("headline", "short"))
        return Stage(phase.start, headline, why, short[:1].upper() + short[1:])

    # ---- which words ----

    def _code(self, i: int, phase: Phase) -> str:
        """The key of a phase's words: its kind, or a variant of it."""
        kind, cuts = phase.kind, self.motion.cuts
        if phase.start == phase.end and kind in ("rolls", "slides"):
            return "halts"  # it ends as it begins
        if phase.start == cuts.get("rolls") and kind in ("leans", "swings", "nods", "rolls"):
            return "grips"
        if phase.start == cuts.get("off") and kind in ("leans", "sinks", "swings", "nods"):
            return "off"
        match kind:
            case "rises":
                follows = self.kinds[i + 1 : i + 2] == ["over"]
                lifts = "rises" if follows else "lifts"
                return "comes" if not self._rubs(phase) or not self.a else lifts if self.a > 0 else "rights"
            case "over":
                return "over" if self.a > 0 and self._rubs(phase) and self.kinds[:i].count("rises") else "goes"
            case "stands-on-stem" | "stands-inverted":
                return f"{'stem' if kind == 'stands-on-stem' else 'inverted'}-{self._stands(phase)}"
            case "stands-upright":
                return "upright"
            case "falls":
                return "drops" if self._most_spin(phase) < SPINS and self.a < 0 else "falls"
            case "tips-back":
                return "back" if self.a > 0 else "returns"
            case "leans":
                return "leans" if self._goes_round(phase) else "rests"
            case "swings":
                return "rocks" if self._most_spin(phase) < SPINS else "swings"
            case "slides" if i == 0:
                return "slips"
        return kind

    def _stands(self, phase: Phase) -> str:
        return "spins" if abs(self._at(phase.start)[5]) >= SPINS else "balances"

    @property
    def _stays_low(self) -> bool:
        return bool(self.motion.tilt.max() < SIDE)

    def _rubs(self, phase: Phase) -> bool:
        """Whether it slips in a phase, on a table with friction, and nothing pushes it."""
        free = not self.quiet and not self._pushes(phase)
        return free and bool((self.motion.trajectory.regime[self._here(phase)] != "roll").mean() > 0.5)

    def _goes_round(self, phase: Phase) -> bool:
        return bool(np.ptp(self.motion.trajectory.phi[self._here(phase)]) > AROUND)

    # ---- the reasons ----

    def _whys(self, i: int, phase: Phase, code: str, numbers: dict[str, Number]) -> list[str]:
        """The sentences about a phase itself."""
        wording = []
        if self.quiet and i == 0 and not (self.table == "ice" and self.motion.pushes):
            wording.append(say(f"lab.{self.table}.why"))
        if code == "grips":
            steady = f"{numbers['least']:.1f}" == f"{numbers['most']:.1f}"
            how = "steady" if steady else "why" if self._turns(phase) >= BACK else "passes"
            wording.append(say(f"lab.stages.grips.{how}", **numbers))
        elif code in ("stem-spins", "inverted-spins", "stem-balances", "inverted-balances"):
            wording.append(self._why_it_stands(i, phase))
        elif code == "upright" and not self.quiet:
            rolls = self.motion.rolls_since
            held = rolls < phase.end  # what holds it is no friction of what slips
            wording.append(say("lab.next.rolls", time=rolls) if held else self._why_upright(i, numbers))
        elif code == "rocks":
            never = self._stays_low and self.a > 0
            wording.append(say(f"lab.stages.rocks.{'why' if never else 'past'}", **numbers))
        elif code == "falls":
            wording.append(self._why_it_falls(i, phase, numbers))
        elif code == "back":
            wording.append(say(f"lab.stages.back.{'why' if self.motion.start.edge else 'ball'}", **numbers))
        elif code == "leans" and not self.quiet:
            wording.append(self._within(numbers))
            if not self.motion.pushes:
                wording.append(say("lab.stages.leans.energy", **numbers))
        elif code in ("leans", "rests", "upright"):
            wording.append(self._within(numbers))
        else:
            wording.append(say(f"lab.stages.{code}.why", **numbers))
        slower = numbers["last"] < (1 - SAME) * numbers["spin"] and round(numbers["last"]) < round(numbers["spin"])
        if code in ("swings", "nods") and slower and not self.quiet and not self._pushes(phase):
            wording.append(say("lab.stages.swings.spin", **numbers))
        return [*wording, *self._of_table(i, numbers)]

    @staticmethod
    def _within(numbers: dict[str, Number]) -> str:
        same = f"{numbers['least']:.0f}" == f"{numbers['most']:.0f}"
        return say(f"lab.stages.rests.{'steady' if same else 'why'}", **numbers)

    def _why_it_stands(self, i: int, phase: Phase) -> str:
        before = self.kinds[:i]
        if i == 0:
            return say("lab.stages.stands.start")
        rubbed = any(each.kind == "over" and self._rubs(each) for each in self.phases[:i])
        below = self.motion.tilt[0] < SIDE
        return say("lab.stages.stands.turned") if rubbed and below and self.a > 0 and before.count("over") == 1 else ""

    def _why_upright(self, i: int, numbers: dict[str, Number]) -> str:
        """What holds it: its low weight, or its spin; or that nothing does for ever."""
        rose = "rises" in self.kinds[:i] and not self.motion.pushes
        wording = [say("lab.stages.upright.rubbed")] if rose and self.a < 0 else []
        change = thresholds(self.motion.start.top).upright
        spin, needed = numbers["spin"], float(np.nan_to_num(change.spin)) * self.turns
        stable = change.stable == "always" or (change.stable == "above") == (spin > needed)
        stable = stable and change.stable != "never"
        if not stable and np.ptp(self.motion.tilt) < BALANCE:
            return say("lab.stages.upright.exact")
        if self.a > 0:
            low = "always" if change.stable == "always" else "low" if stable else "unstable"
            wording.append(say(f"lab.stages.upright.{low}", needed=needed, **numbers))
        elif self.a < 0:
            wording.append(say(f"lab.stages.upright.{'spin' if stable else 'slow'}", needed=needed, **numbers))
        return " ".join(wording)

    def _why_it_falls(self, i: int, phase: Phase, numbers: dict[str, Number]) -> str:
        """Too little spin is the reason where it stood with more, or where it needs more to stand."""
        stood = self.phases[i - 1] if i and self.kinds[i - 1] in STANDS else None
        change, spin, code = thresholds(self.motion.start.top).upright, numbers["spin"], "why"
        needed = float(change.spin) * self.turns
        if self._pushes(phase):
            pass  # and so it is said
        elif stood and SPINS <= spin < (1 - SAME) * abs(self._at(stood.start)[5]):
            code = "few"
        elif stood and spin < SPINS:
            code = "none"
        elif self.a < 0 and change.stable == "above" and round(spin, 1) < min(needed, round(needed)):  # as it is said
            code = "needs"
        return say(f"lab.stages.falls.{code}", needed=needed, **numbers)

    def _of_table(self, i: int, numbers: dict[str, Number]) -> list[str]:
        """What is said once, of the whole run on a table."""
        motion = self.motion
        if i or motion.table != "rough":
            return []
        wording = []
        if motion.curves[0, 4] > TENTH[0] and not motion.pushes:
            wording.append(say("lab.rough.gripped", start=numbers["start"], lost=float(motion.curves[0, 4])))
        if any(which == WOULD_LIFT for *_, which in motion.stretches):
            wording.append(say("lab.rough.lifts"))
        return wording

    def _afterwards(self, i: int, phase: Phase, numbers: dict[str, Number]) -> list[str]:
        """What comes after a phase: the next one, the end of the run, or that it goes on like this."""
        motion = self.motion
        if i + 1 < len(self.phases):
            then = self.phases[i + 1]
            code = self._next(then)
            lost = abs(self._at(then.start)[5]) < (1 - SAME) * abs(self._at(phase.start)[5])
            stood = self._stands(phase) == "spins" and phase.kind in STANDS and not self._pushes(then)
            if code == "falls" and stood and lost and not self.quiet:
                code = "tires"
            return [say(f"lab.next.{code}", **numbers | {"time": then.start})]
        if motion.ended_at is not None:
            kind = "flat" if motion.ended == "stands upright" else "ends"
            return [say(f"lab.stopped.{kind}", **numbers | {"time": motion.ended_at})]
        if self._repeats(phase):
            return [say("lab.next.forever")] if not self.quiet else [say(f"lab.{self.table}.forever")]
        spins = phase.kind in STANDS and numbers["last"] >= SPINS
        goes_on = "spins" if spins else "" if phase.kind in ("lies", "nods", "leans") else "tilt"
        cut = motion.cut if motion.whole and phase.kind != "lies" else ""
        return [say(f"lab.next.{code}", **numbers) for code in (goes_on, cut) if code]

    def _next(self, then: Phase) -> str:
        cuts = self.motion.cuts
        return next((code for code in ("rolls", "off") if then.start == cuts.get(code)), then.kind)

    def _repeats(self, phase: Phase) -> bool:
        """Whether it has gone through all that a motion without losses repeats: it rolls or glides, and its tilt has
        come back twice, or stays."""
        here = self._here(phase)
        if not self.quiet and not (self.motion.trajectory.regime[here] == "roll").all():
            return False
        if phase.kind == "lies" or (self.quiet and len(self.phases) > 1):
            return False
        return bool(self._turns(phase) >= BACK or np.ptp(self.motion.tilt[here]) < STEADY)

    def _turns(self, phase: Phase) -> int:
        """How often its tilt turns in a phase."""
        return int(np.count_nonzero(np.diff(np.sign(self.motion.trajectory.omega[self._here(phase), 0]))))

    # ---- the numbers ----

    def _most_spin(self, phase: Phase) -> float:
        return float(np.abs(self.motion.trajectory.omega[self._here(phase), 2]).max()) * self.turns

    def _here(self, phase: Phase) -> slice:
        t = self.motion.seconds
        first = min(int(np.searchsorted(t, phase.start - 1e-9)), len(t) - 1)
        return slice(first, max(int(np.searchsorted(t, phase.end + 1e-9)), first + 1))

    def _at(self, t: float) -> Array:
        """A row of the curves at a time; tilt and spin from all samples."""
        row = np.array([np.interp(t, self.curves[:, 0], column) for column in self.curves.T])
        spin = self.turns * self.motion.trajectory.omega[:, 2]
        row[[1, 5]] = [np.interp(t, self.motion.seconds, values) for values in (self.motion.tilt, spin)]
        return row

    def _numbers(self, i: int, phase: Phase) -> dict[str, Number]:
        """All numbers that the words of a phase may quote."""
        motion, here = self.motion, self._here(phase)
        first, last, start = self._at(phase.start), self._at(phase.end), self.curves[0]
        tilt = np.array([first[1], *motion.tilt[here], last[1]])  # it may begin and end between two samples
        ahead = self._at(self.phases[min(i + 1, len(self.phases) - 1)].end) if phase.kind == "over" else last
        upto = self.curves[(self.curves[:, 0] >= phase.start) & (self.curves[:, 0] <= ahead[0])]
        return {
            "time": phase.start, "seconds": float(motion.seconds[-1]), "long": phase.end - phase.start,
            "from": float(first[1]), "end": float(last[1]), "least": float(tilt.min()), "most": float(tilt.max()),
            "spin": abs(float(first[5])), "last": abs(float(last[5])), "low": float(start[2]),
            "high": float(upto[:, 2].max()) if len(upto) else float(first[2]),
            "start": float(start[3] + start[4] * (motion.table == "rough")), "left": float(last[3]),
            "happens": _happens(motion) if motion.ended else "", "part": _part(motion),
        }  # fmt: skip


def _caption(motion: TableMotion) -> str:
    low, high = float(motion.tilt.min()), float(motion.tilt.max())
    by = high - low
    if motion.ended_at is not None:
        return say("lab.caption.ends", time=motion.ended_at, happens=_happens(motion))
    if by < TENTH[0]:
        same = f"{low:.0f}" == f"{high:.0f}"
        return say("lab.caption.stays", low=low) if same else say("lab.caption.stays_near", mean=(low + high) / 2)
    if by < 1:
        return say("lab.caption.tenth") if by < TENTH[1] else say("lab.caption.little", by=by)
    return say("lab.caption.nods", low=low, high=high)
