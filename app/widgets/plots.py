"""Scene -> Bokeh: what all figures share, and the motion over time.

A figure is built once; after that only the sources with new numbers are sent. What moves often (the selected tieline,
the line at the time of the clock) is on Bokeh's overlay level, which is repainted without the rest of its figure.
"""

from pathlib import Path

import numpy as np
from bokeh.models import (
    AllIndices,
    AllLabels,
    BasicTickFormatter,
    BoxAnnotation,
    CDSView,
    ColumnDataSource,
    CustomJS,
    CustomJSTickFormatter,
    Line,
    Range1d,
    Span,
)
from bokeh.plotting import figure

from app.bundle import call
from app.model.colours import COLOURS, FAINT, INK
from app.text import decimal_point, say
from app.widgets.look import FAMILY

CLICKS, DRAG = ("tap", "doubletap"), ("panstart", "pan", "panend")
"""Bokeh's gestures. It calls the second of two clicks within 0.3 s a doubletap, wherever it is, and not a tap as
well."""
TICKS = Path(__file__).parents[1].joinpath("ticks.js").read_text(encoding="utf-8")
GRID, PAPER = "#e7ebef", "#ffffff"
POINTS_A_CURVE = 640


def in_language(basic):
    """A tick formatter of Bokeh's, with the decimal point of the page's language."""
    return CustomJSTickFormatter(args={"basic": basic, "point": decimal_point()}, code=TICKS)


def plain(**options):
    """A figure without frame and tools, in the page's own type; using it sends nothing to the server."""
    fig = figure(
        sizing_mode="stretch_both",
        title=None,
        toolbar_location=None,
        tools="",
        outline_line_color=None,
        min_border=4,
        background_fill_alpha=0,
        border_fill_alpha=0,
        lod_threshold=None,
        **options,
    )
    fig.grid.grid_line_color = GRID
    fig.axis.axis_line_color = fig.axis.major_tick_line_color = FAINT
    fig.axis.minor_tick_line_color = None
    fig.axis.major_label_text_color = INK
    fig.axis.major_label_text_font_size = "12px"
    fig.axis.axis_label_text_color = INK
    fig.axis.axis_label_text_font_size = "12px"
    fig.axis.axis_label_text_font_style = "normal"
    fig.axis.major_label_text_font = fig.axis.axis_label_text_font = FAMILY
    fig.axis.major_tick_in = 0
    fig.axis.major_label_policy = AllLabels()  # the same object for both
    if decimal_point() != ".":
        for axis in fig.axis:
            if isinstance(axis.formatter, BasicTickFormatter):
                axis.formatter = in_language(axis.formatter)
    if fig.name:
        label = say(f"roll.figures.{fig.name}")
        fig.js_on_change("inner_width", call("nameFigure", fig=fig, label=label))
    return fig


def on_click(fig, act):
    """Calls act, a function of an event or a callback in the browser, for each click in a figure, however soon after
    the one before."""
    listen = fig.js_on_event if isinstance(act, CustomJS) else fig.on_event
    for event in CLICKS:
        listen(event, act)


def on_pointer(fig, act, *more):
    """Runs a callback in the browser for each click and drag in a figure, and for more events of Bokeh."""
    on_click(fig, act)
    for event in (*DRAG, *more):
        fig.js_on_event(event, act)


def draw(fig, kind, *xy, source, level="glyph", **looks):
    """Draws a Bokeh glyph in the figure; xy: its first two coordinates. The figure's own methods create three of each,
    for selections that are not used here: a page had half as many parts again, all to be created, counted and sent."""
    glyph = kind(**dict(zip(("x", "y"), xy, strict=False)), **looks)
    of_all = fig.renderers[0].view.filter if fig.renderers else AllIndices()
    return fig.add_glyph(source, glyph, level=level, view=CDSView(filter=of_all))


def thinned(**curves):
    """Every n-th row of the curves, enough to draw."""
    every = max(1, len(curves["t"]) // POINTS_A_CURVE)
    return {name: curve[::every] for name, curve in curves.items()}


class TimeFigures:
    """theta, F_z, F_h/F_z and the constants on one time axis, each with a line at the time of the clock."""

    NAMES = ("theta", "normal", "ratio", "constants")

    def __init__(self):
        x_range = Range1d(0, 1)
        names = ("t", "theta", "normal", "ratio", "K_J", "K_R", "E")
        self.source = ColumnDataSource({name: np.zeros(2) for name in names})
        self.figures = {name: plain(x_range=x_range, y_range=Range1d(0, 1), name=name) for name in self.NAMES}
        curves = {
            "theta": {"theta": COLOURS["theta"]},
            "normal": {"normal": COLOURS["normal"]},
            "ratio": {"ratio": COLOURS["friction"]},
            "constants": {"K_J": COLOURS["jellett"], "K_R": COLOURS["omega"], "E": COLOURS["energy"]},
        }
        self.spans, seek = [], call("seekAlong")
        for name, fig in self.figures.items():
            for column, colour in curves[name].items():
                draw(fig, Line, "t", column, source=self.source, line_color=colour, line_width=2)
            self.spans.append(Span(location=0, dimension="height", level="overlay", line_color=INK, line_width=1.5))
            fig.add_layout(self.spans[-1])
            on_pointer(fig, seek)
            fig.min_border_left = 44
            fig.ygrid.ticker = fig.yaxis.ticker
            fig.yaxis.ticker.desired_num_ticks = 2
            fig.xaxis.visible = name == "constants"
        self.slips = Span(location=0.5, dimension="width", line_color=INK, line_dash=[6, 4], line_width=1.5)
        self.beyond = BoxAnnotation(bottom=0.5, fill_color=COLOURS["friction"], fill_alpha=0.12, line_color=None)
        self.figures["ratio"].add_layout(self.slips)
        self.figures["ratio"].add_layout(self.beyond)
        self.figures["normal"].add_layout(
            BoxAnnotation(top=0, fill_color=COLOURS["normal"], fill_alpha=0.15, line_color=None)
        )

        self.figures["theta"].js_on_change("inner_width", call("moveLines", spans=self.spans))
        self._shown = None

    def show(self, scene):
        if (scene.trajectory, scene.mu_s) == self._shown:
            return
        self._shown = (scene.trajectory, scene.mu_s)
        t = scene.trajectory.t
        self.source.data = thinned(t=t, theta=scene.trajectory.theta, normal=scene.normal, ratio=scene.ratio,
                                   K_J=scene.K_J, K_R=scene.K_R, E=scene.E)  # fmt: skip
        self.figures["theta"].x_range.update(start=t[0], end=t[-1])
        self.slips.location = self.beyond.bottom = scene.mu_s
        bounds = {
            "theta": scene.turning,
            "normal": (min(0, scene.normal.min()), max(1.5, scene.normal.max())),
            "ratio": (0, max(1.4 * scene.mu_s, min(scene.ratio.max(), 4 * scene.mu_s + 1))),
            "constants": (
                min(0, scene.K_J.min(), scene.K_R.min()),
                max(scene.K_J.max(), scene.K_R.max(), scene.E.max()),
            ),
        }
        for name, (low, high) in bounds.items():
            pad = 0.08 * (high - low) or 0.05
            self.figures[name].y_range.update(start=low - pad, end=high + pad)
