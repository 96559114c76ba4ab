"""Scene -> Bokeh: what all figures share.

A figure is built once; after that only the sources with new numbers are sent. What moves often (the selected tieline,
the line at the time of the clock) is on Bokeh's overlay level, which is repainted without the rest of its figure.
"""

from pathlib import Path

import numpy as np
from bokeh.models import (
    AllIndices,
    AllLabels,
    BasicTickFormatter,
    CDSView,
    CustomJSHover,
    CustomJSTickFormatter,
    Span,
)
from bokeh.plotting import figure

from app.bundle import call, code_of
from app.model.colours import FAINT, INK
from app.text import decimal_point, say
from app.widgets.look import FAMILY

CLICKS, DRAG = ("tap", "doubletap"), ("panstart", "pan", "panend")
"""Bokeh's gestures. It calls the second of two clicks within 0.3 s a doubletap, wherever it is, and not a tap as
well."""
TICKS = code_of(Path(__file__).parents[1] / "ticks.js")
GRID, PAPER = "#e7ebef", "#ffffff"
TYPE = {f"{part}_text_{name}": value for part in ("major_label", "axis_label")
           for name, value in (("color", INK), ("font_size", "12px"), ("font", FAMILY))}  # fmt: skip


def in_language(basic):
    """A tick formatter of Bokeh's, with the decimal point of the page's language."""
    return CustomJSTickFormatter(args={"basic": basic, "point": decimal_point()}, code=TICKS)


def decimals():
    """For the numbers of a HoverTool, "$x{3}": in the notation of the page's language, with so many decimals."""
    return CustomJSHover(
        args={"point": decimal_point()}, code='return Number(value).toFixed(Number(format)).replace(".", point)'
    )


def plain(label="", height=None, **options):
    """A figure without frame and tools, in the page's own type; using it sends nothing to the server. label: what it
    shows, for screen readers, if that is not stored under its name; height: px, if that is not that of its place."""
    size = {"sizing_mode": "stretch_width", "height": height} if height else {"sizing_mode": "stretch_both"}
    fig = figure(title=None, toolbar_location=None, tools="", outline_line_color=None, min_border=4,
                 background_fill_alpha=0, border_fill_alpha=0, lod_threshold=None, **size, **options)  # fmt: skip
    fig.grid.grid_line_color = GRID
    all_labels = AllLabels()  # the same object for both
    for axis in fig.axis:
        axis.update(axis_line_color=FAINT, major_tick_line_color=FAINT, minor_tick_line_color=None, major_tick_in=0,
                    major_label_policy=all_labels, axis_label_text_font_style="normal", **TYPE)  # fmt: skip
        if decimal_point() != "." and isinstance(axis.formatter, BasicTickFormatter):
            axis.formatter = in_language(axis.formatter)
    if label or fig.name:
        label = label or say(f"roll.figures.{fig.name}")
        fig.js_on_change("inner_width", call("nameFigure", fig=fig, label=label))
    return fig


def padded(low, high):
    """The range with some margin below and above."""
    pad = 0.08 * (high - low) or 0.05
    return {"start": low - pad, "end": high + pad}


def round_numbers(low, high):
    """About four round numbers between two values."""
    about = (high - low or 1) / 4
    power = 10 ** np.floor(np.log10(about))
    step = next(size * power for size in (1, 2, 5, 10) if size * power >= about)
    first, last = int(np.ceil(low / step - 1e-9)), int(np.floor(high / step + 1e-9))
    return [float(f"{step * i:.6g}") for i in range(first, last + 1)]


def on_pointer(fig, act, *more):
    """Runs a callback in the browser for each click and drag in a figure, and for more events of Bokeh."""
    for event in (*CLICKS, *DRAG, *more):
        fig.js_on_event(event, act)


def rule(fig, dimension, location=0, **looks):
    """Draws a straight line across a figure, "width" or "height", and returns it."""
    span = Span(dimension=dimension, location=location, **looks)
    fig.add_layout(span)
    return span


def draw(fig, kind, *xy, source, level="glyph", **looks):
    """Draws a Bokeh glyph in the figure; xy: its first two coordinates. The figure's own methods create three of each,
    for selections that are not used here: a page had half as many parts again, all to be created, counted and sent."""
    glyph = kind(**dict(zip(("x", "y"), xy, strict=False)), **looks)
    of_all = fig.renderers[0].view.filter if fig.renderers else AllIndices()
    if fig.renderers:  # nothing is selected, so one policy serves all sources
        source.selection_policy = fig.renderers[0].data_source.selection_policy
    return fig.add_glyph(source, glyph, level=level, view=CDSView(filter=of_all))
