"""A map as a file with all its parameters and units: CSV, NPZ, PNG, SVG, and the Python program that computes it."""

import csv
import io
import json
import textwrap
from dataclasses import asdict

import numpy as np

from app.model import ends
from app.model.colours import FAINT, INK
from app.model.maps.lines import lines
from app.model.maps.maps import QUANTITIES, SECONDS, UNITS, Map
from app.tabs.maps.picture import DASHES as STYLES
from app.tabs.maps.picture import half_step, span
from app.tabs.maps.words import body_of, title, with_unit
from app.text import listed, say, written

DPI = 300
KINDS = ("csv", "npz", "png", "svg")
OF_LAW = {"smoothed": {"second": "(gR)^1/2"}, "contensou": {"second": "mm"}, "viscous": {"mu": "(gR)^-1/2"}}
"""{law: {parameter: its unit}}, if it has one."""
DASHES = {"dotdash": "dashdot"}  # Bokeh's names that matplotlib does not have
LAWS = {
    "coulomb": "SimpleNamespace(mu_k=v.mu, mu_s=np.maximum(v.mu, v.second))",
    "viscous": "SimpleNamespace(gamma=v.mu)",
    "smoothed": "SimpleNamespace(mu=v.mu, eps=v.second)",
    "contensou": "SimpleNamespace(mu=v.mu, radius=v.second / v.R)",
}


def made(level, colour, kind):
    """A file of one of KINDS, as bytes."""
    return {"csv": _csv, "npz": _npz}.get(kind, lambda *given: _drawn(*given, kind))(level, colour)


def _parameters(asked):
    fixed = {name: value for name, value in asked.start.items() if name not in (asked.across, asked.up)}
    units = {name: quantity.unit for name, quantity in QUANTITIES.items()} | {"seconds": "s"} | UNITS
    top, scales, edge = asked.thing
    own = asdict(top) | {"R": 1e3 * scales.R, "M": scales.M, "g": scales.g, "edge": edge}
    units |= {"I1": "MR^2", "I3": "MR^2", "M": "kg", "g": "m/s^2", "edge": "R"} | OF_LAW.get(asked.law, {})
    return asdict(asked) | {"own": own, "values": fixed, "units": units}


def _header(asked):
    return json.dumps(_parameters(asked), ensure_ascii=False)


def _csv(level, colour):
    file = io.StringIO()
    file.write(f"# {_header(level.asked)}\n")
    table = csv.writer(file)
    table.writerow((level.asked.across, level.asked.up, "end", *level.columns, "mixed"))
    mixed = level.mixed
    for i, j in np.ndindex(level.end.shape):
        values = (float(column[i, j]) for column in level.columns.values())
        table.writerow((float(level.x[j]), float(level.y[i]), level.end[i, j], *values, int(mixed[i, j])))
    return file.getvalue().encode()


def _npz(level, colour):
    file = io.BytesIO()
    np.savez_compressed(file, allow_pickle=False, parameters=np.array(_header(level.asked)), across=level.x, up=level.y,
                        end=level.end, mixed=level.mixed, **level.columns)  # fmt: skip
    return file.getvalue()


def _drawn(level, colour, kind):
    import matplotlib
    from matplotlib.figure import Figure

    asked = level.asked
    with matplotlib.rc_context({"font.size": 9, "svg.hashsalt": "maps"}):
        figure = Figure(figsize=(7.2, 4.8), layout="constrained")
        axes = figure.add_subplot(xlabel=with_unit(asked.across), ylabel=with_unit(asked.up))
        keys = [*_ends(axes, level)] if colour == "end" else _column(figure, axes, level, colour)
        keys += [*_hatched(axes, level, colour), *_lines(axes, asked)]
        axes.set(xlim=asked.across_range, ylim=asked.up_range)
        for axis in (axes.xaxis, axes.yaxis):
            axis.set_major_formatter(_number)
        if keys:
            figure.legend(handles=keys, fontsize=7, loc="outside lower center", ncols=2)
        figure.suptitle(title(asked, colour))
        axes.set_title(textwrap.fill(_fixed(asked), 135), fontsize=6.5)
        file = io.BytesIO()
        undated = {"Date": None} if kind == "svg" else {}
        figure.savefig(file, format=kind, dpi=DPI, metadata=undated | {"Description": _header(asked)})
    return file.getvalue()


def _ends(axes, level):
    """Draws the ends, and returns the entries of the key."""
    from matplotlib.colors import ListedColormap
    from matplotlib.patches import Patch

    index = np.vectorize(lambda end: ends.NAMES.index(end) if end else np.nan, otypes=[float])(level.end)
    axes.pcolormesh(level.x, level.y, index, cmap=ListedColormap(list(ends.COLOUR.values())), vmin=-0.5,
                    vmax=len(ends.NAMES) - 0.5, rasterized=True)  # fmt: skip
    for end in ends.NAMES:
        if (level.end == end).any():
            yield Patch(color=ends.COLOUR[end], label=listed("maps.ends")[end])


def _column(figure, axes, level, colour):
    if span(level, colour):
        unit = f" ({UNITS[colour]})" if UNITS[colour] else ""
        mesh = axes.pcolormesh(level.x, level.y, level.columns[colour], rasterized=True)
        figure.colorbar(mesh, label=listed("maps.colours")[colour] + unit, format=_number)
    return []


def _hatched(axes, level, colour):
    from matplotlib.collections import PatchCollection
    from matplotlib.patches import Patch, Rectangle

    wide, high = half_step(level.x), half_step(level.y)
    hatch = {"edgecolor": INK if colour == "end" else "#fefefe", "hatch": "/" * 6, "linewidth": 0}
    cells = [Rectangle((level.x[j] - wide, level.y[i] - high), 2 * wide, 2 * high)
             for i, j in np.argwhere(level.mixed)]  # fmt: skip
    if cells:
        axes.add_collection(PatchCollection(cells, facecolor="none", **hatch))
        yield Patch(facecolor="none" if colour == "end" else FAINT, label=say("maps.hatched"), **hatch)


def _lines(axes, asked):
    for name, line in lines(asked):
        style = DASHES.get(STYLES[name], STYLES[name])
        axes.plot(*line.T, color="#fefefe", linewidth=3)
        yield from axes.plot(*line.T, linestyle=style, color=INK, linewidth=1, label=say(f"maps.lines.{name}"))


def _number(x, _):
    return written(x, "g")


def _fixed(asked):
    """The values that are the same in all cells, in words."""
    values, named = _parameters(asked)["values"], listed("maps.quantities")
    second = values.pop("second", None)
    said = [f"{named[name]} {written(value, '.4g')} {QUANTITIES[name].unit}".strip() for name, value in values.items()]
    if second is not None and SECONDS[asked.law]:
        said.append(f"{listed('maps.seconds_of')[asked.law]}: {written(second, '.4g')}")
    return "; ".join(filter(None, (body_of(asked), listed("maps.laws")[asked.law], ", ".join(said))))


def python(asked: Map):
    """A program whose `many` contains what the map shows, row by row from below."""
    values = {name: repr(float(value)) for name, value in asked.start.items()} | {asked.across: "x", asked.up: "y"}
    given = ", ".join(f"{name}={value}" for name, value in values.items())
    tops = {"a", "ratio"} & {asked.across, asked.up}
    top = "SimpleNamespace(a=v.a, I1=v.ratio * body.I3, I3=body.I3)" if tops else "body"
    edge = "edge"
    if {"stem", "rounding"} & {asked.across, asked.up}:
        edge = ("np.stack(np.broadcast_arrays(edge[0], (v.stem - v.rounding) / 1e3 / scales.R, "
                "v.rounding / 1e3 / scales.R), axis=-1)")  # fmt: skip
    nudge = ", nudge=1e-6" if asked.nudged else ""
    needs, body = "PRESETS", f"preset = next(preset for preset in PRESETS if preset.name == {asked.body!r})\n"
    body += "body, scales, edge = preset.top, preset.shape.scales, preset.shape.edge"
    if asked.own:
        needs, body = "Scales, Top", f"body, scales, edge = {asked.own.top}, {asked.own.scales}, {asked.own.edge}"
    return f"""\
from types import SimpleNamespace

import numpy as np
from tippe_core import {needs}, slide_many

{body}
part = (np.arange({asked.cells}) + 0.5) / {asked.cells}
x = {asked.across_range[0]!r} + {asked.across_range[1] - asked.across_range[0]!r} * part  # {with_unit(asked.across)}
y = ({asked.up_range[0]!r} + {asked.up_range[1] - asked.up_range[0]!r} * part)[:, None]  # {with_unit(asked.up)}
v = SimpleNamespace({given})
time = (v.R / 1e3 / scales.g) ** 0.5
theta, spin = np.radians(v.tilt), 2 * np.pi * v.spin * time
start = SimpleNamespace(theta=theta, theta_dot=0.0, omega2=0.0, omega3=spin,
                        vx=-(1 - v.slip) * spin * np.sin(theta), vy=0.0)
top, edge = {top}, {edge}
friction = {LAWS[asked.law]}
many = slide_many(top, start, friction, {asked.seconds!r} / time + 0 * (x + y), edge, rtol={asked.rtol!r}{nudge})
print(many.end)
"""
