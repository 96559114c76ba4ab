"""A map as a file, with all its parameters and units in it: CSV, NPZ, PNG, SVG, and the Python that makes it."""

import csv
import io
import json
from dataclasses import asdict

import numpy as np

from app.model import ends
from app.model.maps.lines import lines
from app.model.maps.maps import QUANTITIES, UNITS, Map
from app.tabs.maps.picture import span
from app.tabs.maps.words import title, with_unit
from app.text import listed

DPI = 300
KINDS = ("csv", "npz", "png", "svg")
LAWS = {
    "coulomb": "SimpleNamespace(mu_k=v.mu, mu_s=np.maximum(v.mu, v.second))",
    "viscous": "SimpleNamespace(gamma=v.mu)",
    "smoothed": "SimpleNamespace(mu=v.mu, eps=v.second)",
    "contensou": "SimpleNamespace(mu=v.mu, radius=v.second / v.R)",
}


def made(level, colour, kind):
    """One of KINDS, as bytes."""
    return {"csv": _csv, "npz": _npz}.get(kind, lambda *given: _drawn(*given, kind))(level, colour)


def _parameters(asked):
    fixed = {name: value for name, value in asked.start.items() if name not in (asked.across, asked.up)}
    units = {name: quantity.unit for name, quantity in QUANTITIES.items()} | {"seconds": "s"} | UNITS
    return asdict(asked) | {"values": fixed, "units": units}


def _csv(level, colour):
    file = io.StringIO()
    file.write(f"# {json.dumps(_parameters(level.asked), ensure_ascii=False)}\n")
    table = csv.writer(file)
    table.writerow((level.asked.across, level.asked.up, "end", *level.columns, "mixed"))
    mixed = level.mixed
    for i, j in np.ndindex(level.end.shape):
        values = (float(column[i, j]) for column in level.columns.values())
        table.writerow((float(level.x[j]), float(level.y[i]), level.end[i, j], *values, int(mixed[i, j])))
    return file.getvalue().encode()


def _npz(level, colour):
    file = io.BytesIO()
    parameters = json.dumps(_parameters(level.asked), ensure_ascii=False)
    np.savez_compressed(file, allow_pickle=False, parameters=np.array(parameters), across=level.x, up=level.y,
                        end=level.end, mixed=level.mixed, **level.columns)  # fmt: skip
    return file.getvalue()


def _drawn(level, colour, kind):
    import matplotlib
    from matplotlib.colors import ListedColormap
    from matplotlib.figure import Figure
    from matplotlib.patches import Patch

    asked, named = level.asked, listed("maps.quantities")
    with matplotlib.rc_context({"font.size": 9, "svg.hashsalt": "maps"}):
        figure = Figure(figsize=(7.2, 4.8), layout="constrained")
        axes = figure.add_subplot(
            xlabel=with_unit(asked.across), ylabel=with_unit(asked.up), title=title(asked, colour)
        )
        if colour == "end":
            shown = ListedColormap(list(ends.COLOUR.values()))
            index = np.vectorize(lambda end: ends.NAMES.index(end) if end else np.nan, otypes=[float])(level.end)
            axes.pcolormesh(level.x, level.y, index, cmap=shown, vmin=-0.5, vmax=len(ends.NAMES) - 0.5, rasterized=True)
            patches = [Patch(color=ends.COLOUR[end], label=listed("maps.ends")[end])
                       for end in ends.NAMES if (level.end == end).any()]  # fmt: skip
            axes.legend(handles=patches, fontsize=7)
        elif span(level, colour):
            unit = f" ({UNITS[colour]})" if UNITS[colour] else ""
            mesh = axes.pcolormesh(level.x, level.y, level.columns[colour], rasterized=True)
            figure.colorbar(mesh, label=listed("maps.colours")[colour] + unit)
        for _, line in lines(asked):
            axes.plot(*line.T, "--", color="black", linewidth=1)
        fixed = ", ".join(f"{named[name]} {value:.4g} {QUANTITIES[name].unit}".strip()
                          for name, value in _parameters(asked)["values"].items())  # fmt: skip
        figure.supxlabel(f"{asked.body}; {listed('maps.laws')[asked.law]}; {fixed}", fontsize=6)
        file = io.BytesIO()
        figure.savefig(file, format=kind, dpi=DPI, metadata={"Date": None} if kind == "svg" else {})
    return file.getvalue()


def python(asked: Map):
    """A program whose `many` has what the map shows, row by row of up."""
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
