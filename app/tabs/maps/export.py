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


def _parameters(request):
    fixed = {name: value for name, value in request.start.items() if name not in (request.across, request.up)}
    units = {name: quantity.unit for name, quantity in QUANTITIES.items()} | {"seconds": "s"} | UNITS
    top, scales, edge = request.thing
    own = asdict(top) | {"R": 1e3 * scales.R, "M": scales.M, "g": scales.g, "edge": edge}
    units |= {"I1": "MR^2", "I3": "MR^2", "M": "kg", "g": "m/s^2", "edge": "R"} | OF_LAW.get(request.law, {})
    return asdict(request) | {"own": own, "values": fixed, "units": units}


def _header(request):
    return json.dumps(_parameters(request), ensure_ascii=False)


def _csv(level, colour):
    file = io.StringIO()
    file.write(f"# {_header(level.request)}\n")
    table = csv.writer(file)
    table.writerow((level.request.across, level.request.up, "end", *level.columns, "mixed"))
    mixed = level.mixed
    for i, j in np.ndindex(level.end.shape):
        values = (float(column[i, j]) for column in level.columns.values())
        table.writerow((float(level.x[j]), float(level.y[i]), level.end[i, j], *values, int(mixed[i, j])))
    return file.getvalue().encode()


def _npz(level, colour):
    file = io.BytesIO()
    np.savez_compressed(file, allow_pickle=False, parameters=np.array(_header(level.request)), across=level.x,
                        up=level.y, end=level.end, mixed=level.mixed, **level.columns)  # fmt: skip
    return file.getvalue()


def _drawn(level, colour, kind):
    import matplotlib
    from matplotlib.figure import Figure

    request = level.request
    with matplotlib.rc_context({"font.size": 9, "svg.hashsalt": "maps"}):
        figure = Figure(figsize=(7.2, 4.8), layout="constrained")
        axes = figure.add_subplot(xlabel=with_unit(request.across), ylabel=with_unit(request.up))
        keys = [*_ends(axes, level)] if colour == "end" else _column(figure, axes, level, colour)
        keys += [*_hatched(axes, level, colour), *_lines(axes, request)]
        axes.set(xlim=request.across_range, ylim=request.up_range)
        for axis in (axes.xaxis, axes.yaxis):
            axis.set_major_formatter(_number)
        if keys:
            figure.legend(handles=keys, fontsize=7, loc="outside lower center", ncols=2)
        figure.suptitle(title(request, colour))
        axes.set_title(textwrap.fill(_fixed(request), 135), fontsize=6.5)
        file = io.BytesIO()
        undated = {"Date": None} if kind == "svg" else {}
        figure.savefig(file, format=kind, dpi=DPI, metadata=undated | {"Description": _header(request)})
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


def _lines(axes, request):
    for name, line in lines(request):
        style = DASHES.get(STYLES[name], STYLES[name])
        axes.plot(*line.T, color="#fefefe", linewidth=3)
        yield from axes.plot(*line.T, linestyle=style, color=INK, linewidth=1, label=say(f"maps.lines.{name}"))


def _number(x, _):
    return written(x, "g")


def _fixed(request):
    """The values that are the same in all cells, in words."""
    values, named = _parameters(request)["values"], listed("maps.quantities")
    second = values.pop("second", None)
    wording = [
        f"{named[name]} {written(value, '.4g')} {QUANTITIES[name].unit}".strip() for name, value in values.items()
    ]
    if second is not None and SECONDS[request.law]:
        wording.append(f"{listed('maps.seconds_of')[request.law]}: {written(second, '.4g')}")
    return "; ".join(filter(None, (body_of(request), listed("maps.laws")[request.law], ", ".join(wording))))


def python(request: Map):
    """A program whose `many` contains what the map shows, row by row from below."""
    values = {name: repr(float(value)) for name, value in request.start.items()}
    values |= {request.across: "x", request.up: "y"}
    (left, right), (bottom, top_end) = request.across_range, request.up_range
    given = ", ".join(f"{name}={value}" for name, value in values.items())
    tops = {"a", "ratio"} & {request.across, request.up}
    top = "SimpleNamespace(a=v.a, I1=v.ratio * body.I3, I3=body.I3)" if tops else "body"
    edge = "edge"
    if {"stem", "rounding"} & {request.across, request.up}:
        edge = ("np.stack(np.broadcast_arrays(edge[0], (v.stem - v.rounding) / 1e3 / scales.R, "
                "v.rounding / 1e3 / scales.R), axis=-1)")  # fmt: skip
    nudge = ", nudge=1e-6" if request.nudged else ""
    needs, body = "PRESETS", f"preset = next(preset for preset in PRESETS if preset.name == {request.body!r})\n"
    body += "body, scales, edge = preset.top, preset.shape.scales, preset.shape.edge"
    if request.own:
        needs, body = "Scales, Top", f"body, scales, edge = {request.own.top}, {request.own.scales}, {request.own.edge}"
    return f"""\
from types import SimpleNamespace

import numpy as np
from tippe_core import {needs}, slide_many

{body}
part = (np.arange({request.cells}) + 0.5) / {request.cells}
x = {left!r} + {right - left!r} * part  # {with_unit(request.across)}
y = ({bottom!r} + {top_end - bottom!r} * part)[:, None]  # {with_unit(request.up)}
v = SimpleNamespace({given})
time = (v.R / 1e3 / scales.g) ** 0.5
theta, spin = np.radians(v.tilt), 2 * np.pi * v.spin * time
start = SimpleNamespace(theta=theta, theta_dot=0.0, omega2=0.0, omega3=spin,
                        vx=-(1 - v.slip) * spin * np.sin(theta), vy=0.0)
top, edge = {top}, {edge}
friction = {LAWS[request.law]}
many = slide_many(top, start, friction, {request.seconds!r} / time + 0 * (x + y), edge, rtol={request.rtol!r}{nudge})
print(many.end)
"""
