"""The words of the tab Maps: the key of the colours, what a run did, where runs and closed forms disagree."""

import numpy as np
from bokeh.palettes import Viridis256

from app.model import ends
from app.model.maps.lines import lines
from app.model.maps.maps import QUANTITIES, UNITS
from app.tabs.maps.picture import DASHES, span
from app.text import listed, say, written
from app.widgets.cards import px, swatch
from app.widgets.typeset import power

PATCH = "display: inline-block; width: 22px; height: 13px; margin: 0 6px 0 0; border: 1px solid var(--control-line); {}"
HATCHED = f"background: repeating-linear-gradient(135deg, {ends.COLOUR['rolling']} 0 3px, #1b2430 3px 4px)"
LINE = {"solid": "solid", "dashed": "dashed", "dotted": "dotted", "dashdot": "dashed", "dotdash": "dotted"}


def _patch(style, text):
    patch = f'<span style="{PATCH.format(style)}"></span>'
    return f'<span style="margin-right: 14px; white-space: nowrap">{patch}{text}</span> '


def colours_say(level, colour):
    """The key of the colours, in words."""
    wording = [f"<h2>{say('maps.colours_say')}</h2>"]
    if colour == "end":
        named = listed("maps.ends")
        wording.append(f"{say('maps.after', seconds=level.request.seconds)} ")
        wording += [
            _patch(f"background: {ends.COLOUR[end]}", named[end]) for end in ends.NAMES if (level.end == end).any()
        ]
    elif found := span(level, colour):
        ramp = ", ".join(Viridis256[::51])
        unit = UNITS[colour]
        least, most = (written(value, ".3g") for value in found[:2])
        wording.append(f'{least} {unit} <span style="display: inline-block; width: 120px; height: 13px; '
                    f'background: linear-gradient(90deg, {ramp})"></span> {most} {unit}; ')  # fmt: skip
        wording.append(_patch("background: transparent", say("maps.missing")))
    if level.finest:
        wording.append(_patch(HATCHED, say("maps.hatched")))
        if colour == "end" and (on_the_way := (level.end == "moving").sum()):
            decided = level.end.size - on_the_way
            text = say("maps.on_the_way", decided=decided, count=level.end.size, moving=on_the_way)
            wording.append(f"<br>{text}")
        names = dict.fromkeys(name for name, _ in lines(level.request))
        wording += [f"<br>{swatch('var(--faint)', say(f'maps.lines.{name}'), LINE[DASHES[name]])}" for name in names]
    return "".join(wording)


def of_run(request, across, up, found):
    """What happened in one run."""
    says = say("maps.run.says", across=_measured(across, request.across), up=_measured(up, request.up),
               seconds=request.seconds, end=listed("maps.ends")[found.end])  # fmt: skip
    times = [say("maps.run.passes", time=found.time_90) if np.isfinite(found.time_90) else say("maps.run.never")]
    if np.isfinite(found.time_stem):
        times.append(say("maps.run.stem", time=found.time_stem))
    if found.hops:
        times.append(say("maps.run.hops", hops=found.hops))
    return f'<div role="status"><b style="font-size: {px(18)}">{says}</b><br>{" ".join(times)}</div>'


def of_worst(level):
    """The largest errors of a map, and what hatching means."""
    drift = level.worst("C_J_drift")
    kept = power(drift) if np.isfinite(drift) else say("maps.drift_none")
    return say("maps.worst", energy=power(level.worst("energy_error")), drift=kept) + " " + say("maps.unsettled")


def of_reason(found, k, request):
    """The reason number k why runs differ from a closed form; before the first one, where they do."""
    low, high = written(found.low, ".3g"), _measured(found.high, request.across)
    where = say("maps.range", low=low, high=high) if found.low < found.high else say("maps.at", value=high)
    says, (why, count, _) = "", found.reasons[k]
    if k == 0:
        says = say(f"maps.in_words.{found.kind}", count=found.count, all=found.allowed, where=where) + " "
    says += say("maps.of_them" if len(found.reasons) > 1 else "maps.of_all", count=count)
    return says + " " + say(f"maps.why.{why}")


def _measured(value, name):
    """A value of a quantity with its unit."""
    unit = unit_of(name)
    return written(value, ".3g") + (f" {unit}" if unit not in ("", "°") else unit)


def body_of(request):
    """The name of the body that slides, if it has one."""
    return "" if request.own else listed("build.presets")[request.body]["name"]


def title(request, colour):
    """What is drawn over what."""
    named = listed("maps.quantities")
    return say("maps.title", colour=listed("maps.colours")[colour], seconds=request.seconds,
               across=named[request.across], up=named[request.up])  # fmt: skip


def unit_of(name):
    """The unit of a quantity, as written after a number."""
    return listed("maps.units").get(QUANTITIES[name].unit, QUANTITIES[name].unit)


def with_unit(name):
    """The name of an axis with its unit."""
    unit = unit_of(name)
    return listed("maps.quantities")[name] + (f", {unit}" if unit else "")
