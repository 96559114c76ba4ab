"""The sentences about a Picture of the three planes; each is determined from the motion's own result."""

import html
from itertools import groupby

import numpy as np

from app.model.colours import COLOURS
from app.model.motion import RTOL, THROWN
from app.model.planes.picture import SHORT
from app.model.setup import TABLES
from app.model.story import story
from app.text import listed, say, written
from app.widgets.cards import swatch
from app.widgets.typeset import power
from tippe_core import Coulomb

# The colour of each plane, the same in all pictures of this room.
LOOKS = {"ordinary": COLOURS["friction"], "rough": COLOURS["normal"], "ice": COLOURS["jellett"]}
SURVIVES = ("J", "Routh", "E", "L_3", "L_z")
# A smaller drift is numerical error; physics changes a quantity by more.
ROUNDING = 1e-7
MOST_SPELLS = 5  # intervals on the ball, the stem or both that are listed one by one
AT_ONCE = 0.005  # s: what begins before begins at 0.00 s
# A nudge that grows by this factor turns a tenth of a degree, the accuracy of a hand, into ten degrees.
SCATTERS, HAND = 100.0, 0.1


def degrees(value):
    return f"{written(np.degrees(value), '.1f')}°"


def milliseconds(seconds):
    return written(max(1e3 * seconds, 0.01), ".2g")


def in_force(picture, plane):
    """The present friction law, with its parameters."""
    law, velocity, kind = picture.friction, picture.settings.scales.velocity, picture.settings.law
    if plane in ("rough", "ice"):
        return say(f"planes.force.{plane}")
    if kind == "coulomb":
        return say("planes.force.coulomb", mu_k=law.mu_k, mu_s=law.mu_s)
    if kind == "viscous":
        return say("planes.force.viscous" if law.gamma else "planes.force.none", gamma=law.gamma,
                   si=law.gamma / velocity)  # fmt: skip
    if kind == "contact":
        return say("planes.force.contact", mu=law.mu, patch=picture.settings.patch)
    return say("planes.force.smoothed", mu=law.mu, speed=100 * law.eps * velocity)


def part(settings):
    """The name of the part that touches in addition to the ball."""
    return say(f"planes.parts.{settings.part}")


def happens(event, settings):
    return say(f"planes.events.{event}", part=part(settings))


# ---- how the motion ended ----


def is_caught(picture):
    """Whether Coulomb's law at a point held the top before it was past 90 degrees, and it rolls on."""
    sliding = picture.motions.get("ordinary")
    if sliding is None or not isinstance(picture.friction, Coulomb):
        return False
    return bool(sliding.trajectory.regime[-1] == "roll" and np.isnan(sliding.trajectory.time_90))


def fate(picture, plane):
    """How the motion on a plane ended, in a few sentences."""
    motion = picture.motions[plane]
    if motion is None:
        return html.escape(picture.messages.get(plane, say("planes.fate.nothing")))
    stages = story(motion).stages
    if plane != "ordinary":
        return _bold(stages[0].headline) + " ".join(html.escape(stage.why) for stage in stages)
    said = (_where(picture, motion), _touched(picture, motion), html.escape(stages[-1].why))
    return _bold(stages[-1].headline) + " ".join(filter(None, said))


def _bold(text):
    return f"<b>{html.escape(text)}</b> "


def _where(picture, motion):
    """The tilt at the end, and when it passed a right angle."""
    moved, found, seconds = motion.trajectory, motion.ending, picture.settings.scales.time
    at_the_end = say("planes.fate.end", tilt=degrees(moved.theta[-1]), time=moved.t[-1] * seconds)
    if degrees(found.least) != degrees(found.most):
        at_the_end += say("planes.fate.range", low=degrees(found.least), high=degrees(found.most))
    times = motion.crossings * seconds
    if len(times):
        way = "past" if motion.starts_below else "below"
        key = way if len(times) == 1 else f"{way}_at_last" if len(times) % 2 else f"{way}_and_back"
        at_the_end += say(f"planes.fate.{key}", first=times[0], last=times[-1])
    return at_the_end + "."


def spells(motion, seconds):
    """What the top stood on, in s: (start, end, on); three or more consecutive intervals shorter than SHORT are joined
    to (start, end, on at first, its length, the number of others, the length of the longest)."""
    found = [(s.start * seconds, s.end * seconds, s.on) for s in motion.ending.stretches]
    told = []
    for short, group in groupby(found, key=lambda spell: spell[1] - spell[0] < SHORT):
        group = list(group)
        if short and len(group) > 2:
            (start, end, on), longest = group[0], max(end - start for start, end, _ in group)
            told.append((start, group[-1][1], on, end - start, len(group) - 1, longest))
        else:
            told += group
    return told


def _touched(picture, motion):
    """What the top stood on, from when to when."""
    told = spells(motion, picture.settings.scales.time)
    if len(motion.trajectory.t) == 1:
        return ""
    if len(told) == 1 and len(told[0]) == 3:
        whole = picture.settings.edge is None and told[0][2] == "ball"
        return "" if whole else say(f"planes.spells.only.{told[0][2]}", part=part(picture.settings))
    said = [_spell(spell, "first" if k == 0 else "last" if k == len(told) - 1 else "then", part(picture.settings))
            for k, spell in enumerate(told)]  # fmt: skip
    if motion.alone[1] == THROWN:
        said[0] += say("planes.spells.thrown", part=part(picture.settings))
    left_out = len(told) - MOST_SPELLS
    if left_out > 1:
        said[3 : 3 + left_out] = [say("planes.spells.between", end=told[2 + left_out][1])]
    return say("planes.spells.said", spells=say("planes.spells.comma").join(said))


def _spell(spell, place, second):
    start, end, which, *in_turn = spell
    on = say(f"planes.spells.on.{which}", part=second)
    if not in_turn and end - start >= SHORT:
        if place == "last" and start < AT_ONCE:
            place = "at_once"
        return say(f"planes.spells.{place}", start=start, end=end, on=on)
    length, *others = in_turn or [end - start]
    said = say(f"planes.spells.short{'_first' if place == 'first' else ''}", length=milliseconds(length), on=on)
    if others:
        said += say("planes.spells.comma") + say("planes.spells.more", number=others[0], end=end,
                                                 longest=milliseconds(others[1]))  # fmt: skip
    return said


# ---- what friction does to the ball alone, and how predictable a run is ----


def outcome_words(goes, scales):
    """tippe_core's sentence about an Outcome, in the page's language."""
    limits, unit = goes.thresholds, scales.angular_velocity / (2 * np.pi)

    def spin(value):
        return say("planes.outcome.spin", spin=abs(value) * unit)

    upright = say(f"planes.outcome.upright.{limits.upright.stable}", spin=spin(limits.upright.spin))
    inverted = say(f"planes.outcome.inverted.{limits.inverted.stable}", spin=spin(limits.launch))
    reason = upright
    if limits.group == "neutral":
        reason = say("planes.outcome.neutral")
    elif limits.group in ("never rises", "can invert", "rises part of the way"):
        reason = say("planes.outcome.both", upright=upright, inverted=inverted)
    will = listed("planes.outcome.will")[goes.nudged or goes.verdict].format(tilt=np.degrees(goes.theta))
    return say(f"planes.outcome.{'nudged' if goes.nudged else 'sentence'}", spin=spin(goes.launch), will=will,
               reason=reason, doubt="" if goes.certain else say("planes.outcome.doubt"))  # fmt: skip


def ball_words(picture):
    """What friction would do to the ball alone, and how far that applies to this run."""
    settings, sliding = picture.settings, picture.motions["ordinary"]
    if picture.settings.is_frictionless:
        heat = sliding.trajectory.heat[-1] if sliding else 0.0
        if heat > ROUNDING:
            return say("planes.verdict.impacts", heat=heat)
        return "" if sliding and sliding.ended else say("planes.verdict.forever")
    patch = settings.law == "contact"  # its torque takes J, on which the outcome depends
    of = "patch" if patch else "ball" if settings.edge else "whole"
    says = say(f"planes.verdict.{of}",
               sentence=html.escape(outcome_words(picture.outcome, settings.scales)), part=part(settings))  # fmt: skip
    if patch and sliding is not None:
        return says + say("planes.verdict.pivots", drift=100 * sliding.drift["J"])
    if settings.edge is None or sliding is None:
        return says
    until, event, _ = sliding.alone
    touched = until if event == THROWN else next(
        (s.start for s in sliding.ending.stretches if s.on in ("stem", "both")), None)  # fmt: skip
    if touched is None:
        return says + say("planes.verdict.clear", angle=degrees(settings.shape.touch_angle), part=part(settings))
    if touched == sliding.trajectory.t[0]:
        return says + say("planes.verdict.never", part=part(settings))
    void = "void" if sliding.drift["J"] > ROUNDING else "void_alone"  # without spin J was and remains 0
    return says + say(f"planes.verdict.{void}", time=touched * settings.scales.time, drift=100 * sliding.drift["J"],
                      part=part(settings))  # fmt: skip


def scatter_words(picture):
    """What the disturbed run shows, if the disturbance grows much."""
    growth = picture.growth
    if growth is None or growth < SCATTERS:
        return ""
    return say("planes.verdict.scatters", growth=written(growth, ".0e" if growth >= 1e4 else ".2g"), hand=HAND)


def run_words(picture):
    """The model and inputs of the sliding run, for anyone who quotes it."""
    settings, state = picture.settings, picture.state
    touches = "stem" if settings.edge else "ball"
    start = "start" if settings.rolling is None else "rolling"
    turns = state.omega3 * settings.scales.angular_velocity / (2 * np.pi)
    return say("planes.run.of", a=settings.top.a, I1=settings.top.I1, I3=settings.top.I3,
               body=say(f"planes.run.{touches}", part=part(settings)), rtol=power(RTOL),
               law=in_force(picture, "ordinary"),
               start=say(f"planes.run.{start}", tilt=degrees(state.theta), spin=turns, slip=settings.slip))  # fmt: skip


def verdict_words(picture):
    lines = [f'<div class="line">{swatch(LOOKS[plane], "")}<b>{say(f"planes.plane.{plane}")}</b>: '
             f"{fate(picture, plane)}</div>" for plane in TABLES]  # fmt: skip
    return (
        "".join(lines)
        + f'<div class="says">{ball_words(picture)}{scatter_words(picture)}</div>'
        + (f'<div class="key says">{run_words(picture)}</div>')
    )


# ---- what is conserved ----


def table_words(picture):
    """What is conserved on each plane: the measured drift."""
    head = "".join(f"<th>{swatch(LOOKS[plane], say(f'planes.plane.{plane}'))}</th>" for plane in TABLES)
    rows = []
    for name in SURVIVES:
        cells = []
        for plane in TABLES:
            motion = picture.motions[plane]
            cells.append(f"<td>{drift_words(name, motion, picture) if motion else say('planes.drift.nothing')}</td>")
        rows.append(f"<tr><td>{say(f'planes.survives.{name}')}</td>{''.join(cells)}</tr>")
    return (f"<table><tr><th>{say('planes.drift.measured')}</th>{head}</tr>{''.join(rows)}</table>"
            f'<div class="key">{say("planes.drift.of")}</div>')  # fmt: skip


def drift_words(name, motion, picture):
    drift, (until, event, alone) = motion.drift[name], motion.alone
    if drift < ROUNDING:
        return f'<span class="kept">{say("planes.drift.stays", power=power(drift))}</span>'
    changes = say("planes.drift.changes", size=f"{written(100 * drift, '.3g')} %" if drift > 1e-3 else power(drift))
    if name == "J" and event and alone < ROUNDING:
        settings = picture.settings
        then = say("planes.drift.then", time=until * settings.scales.time, happens=happens(event, settings),
                   changes=changes)  # fmt: skip
        return f'<span class="kept">{say("planes.drift.stays", power=power(alone))}</span>{then}'
    return changes


def stem_words(settings):
    if settings.shape is None:
        return say("planes.stem.apart")
    angle = settings.shape.touch_angle
    return say("planes.stem.never") if angle is None else say("planes.stem.past", angle=degrees(angle),
                                                                         part=part(settings))  # fmt: skip
