"""The sentences about the runs of a LabScene at the level "Research"; each is determined from the run's own result."""

import html

import numpy as np

from app.model.lab.event_list import SHORT
from app.model.lab.traced import turns_back
from app.model.motion import RTOL
from app.model.pushes import push_words
from app.model.run import THROWN
from app.model.setup import TABLES
from app.text import say, written
from app.widgets.typeset import power

SURVIVES = ("J", "Routh", "E", "L_3", "L_z")
# A smaller drift is numerical error; physics changes a quantity by more.
ROUNDING = 1e-7
# A nudge that grows by this factor turns a tenth of a degree, the accuracy of a hand, into ten degrees.
SCATTERS, HAND = 100.0, 0.1


def degrees(value):
    return f"{written(np.degrees(value), '.1f')}°"


def in_force(start, table):
    """The friction law of a table for this Setup, with its parameters."""
    law, velocity, kind = start.friction, start.scales.velocity, start.law
    if table in ("rough", "ice"):
        return say(f"planes.force.{table}")
    if kind == "coulomb":
        return say("planes.force.coulomb", mu_k=law.mu_k, mu_s=law.mu_s)
    if kind == "viscous":
        return say("planes.force.viscous" if law.gamma else "planes.force.none", gamma=law.gamma,
                   si=law.gamma / velocity)  # fmt: skip
    if kind == "contact":
        return say("planes.force.contact", mu=law.mu, patch=start.patch)
    return say("planes.force.smoothed", mu=law.mu, speed=100 * law.eps * velocity)


def part(settings):
    """The name of the part that touches in addition to the ball."""
    return say(f"planes.parts.{settings.part}")


def trace_words(moved):
    """Which way the trace on the ball runs, and where it turns back; "" if it does not."""
    back = turns_back(moved)
    if back is None:
        return ""
    return say("lab.trace.with" if back.runs_with else "lab.trace.against", tilt=np.degrees(back.theta))


def carried_words(motion):
    """What carries it: [[from which time (s), words]], without what cannot be seen."""
    unit, found = motion.start.scales.time, []
    for each in motion.ending.stretches if motion.ending else ():
        word = say(f"planes.spells.on.{each.on}", part=part(motion.start))
        if (each.end - each.start) * unit > SHORT and (not found or found[-1][1] != word):
            found.append([each.start * unit, word])
    return found or [[0.0, say("planes.spells.on.ball")]]


# ---- how the motion ended ----


def notes(scene):
    """{input: what its value means for this top, as HTML}."""
    start, motion = scene.start, scene.motions["ordinary"]
    velocity, found = start.scales.velocity, {}
    if motion is not None:
        found["slip"] = say("planes.notes.slip", speed=100 * velocity * motion.slip[0])
    found["eps"] = say("planes.notes.eps", speed=100 * velocity * start.eps)
    found["gamma"] = say("planes.notes.gamma", gamma=start.gamma / velocity)
    return found


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
    will = say(f"planes.outcome.will.{goes.nudged or goes.verdict}", tilt=np.degrees(goes.theta))
    return say(f"planes.outcome.{'nudged' if goes.nudged else 'sentence'}", spin=spin(goes.launch), will=will,
               reason=reason, doubt="" if goes.certain else say("planes.outcome.doubt"))  # fmt: skip


def ball_words(scene):
    """What friction would do to the ball alone, and how far that applies to this run."""
    settings, sliding = scene.start, scene.motions["ordinary"]
    if settings.pushes:
        return ""  # it is said of the start alone
    if settings.is_frictionless:
        heat = sliding.trajectory.heat[-1] if sliding else 0.0
        if heat > ROUNDING:
            return say("planes.verdict.impacts", heat=heat)
        return "" if sliding and sliding.ended else say("planes.verdict.forever")
    patch = settings.law == "contact"  # its torque takes J, on which the outcome depends
    of = "patch" if patch else "ball" if settings.edge else "whole"
    goes = outcome_words(scene.outcome, settings.scales)
    says = say(f"planes.verdict.{of}", sentence=html.escape(goes), part=part(settings))
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


def scatter_words(growth):
    """What the disturbed run shows, if the disturbance grows much."""
    if growth < SCATTERS:
        return ""
    return say("planes.verdict.scatters", growth=written(growth, ".0e" if growth >= 1e4 else ".2g"), hand=HAND)


def run_words(settings, table):
    """The model and inputs of the run on a table, for anyone who quotes it."""
    state = settings.state
    touches = "stem" if settings.edge else "ball"
    start = "start" if settings.rolling is None else "rolling"
    turns = state.omega3 * settings.scales.angular_velocity / (2 * np.pi)
    pushes = f", {push_words(settings.pushes)}" * bool(settings.pushes)
    return say("planes.run.of", pushes=pushes, a=settings.top.a, I1=settings.top.I1, I3=settings.top.I3,
               body=say(f"planes.run.{touches}", part=part(settings)), rtol=power(RTOL),
               law=in_force(settings, table),
               start=say(f"planes.run.{start}", tilt=degrees(state.theta), spin=turns, slip=settings.slip))  # fmt: skip


# ---- what is conserved ----


def table_words(scene):
    """What is conserved on each table that is watched: the measured drift."""
    shown = [table for table in TABLES if scene.motions[table] or table in scene.refused]
    head = "".join(f"<th>{say(f'planes.plane.{table}')}</th>" for table in shown)
    rows = []
    for name in SURVIVES:
        cells = []
        for table in shown:
            motion = scene.motions[table]
            cells.append(f"<td>{drift_words(name, motion) if motion else say('planes.drift.nothing')}</td>")
        rows.append(f"<tr><td>{say(f'planes.survives.{name}')}</td>{''.join(cells)}</tr>")
    of = say(f"planes.drift.{'since' if scene.start.pushes else 'of'}")
    return (f"<table><tr><th>{say('planes.drift.measured')}</th>{head}</tr>{''.join(rows)}</table>"
            f'<div class="key">{of}</div>')  # fmt: skip


def drift_words(name, motion):
    drift, (until, event, alone) = motion.drift[name], motion.alone
    if drift < ROUNDING:
        return f'<span class="kept">{say("planes.drift.stays", power=power(drift))}</span>'
    changes = say("planes.drift.changes", size=f"{written(100 * drift, '.3g')} %" if drift > 1e-3 else power(drift))
    if name == "J" and event and alone < ROUNDING:
        settings = motion.start
        happens = say(f"planes.events.{event}", part=part(settings))
        then = say("planes.drift.then", time=until * settings.scales.time, happens=happens, changes=changes)
        return f'<span class="kept">{say("planes.drift.stays", power=power(alone))}</span>{then}'
    return changes
