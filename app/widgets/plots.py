"""Scene -> Bokeh: what all figures share.

A figure is built once; after that only the sources with new numbers are sent. What moves often (the selected tieline,
the line at the time of the clock) is on Bokeh's overlay level, which is repainted without the rest of its figure.
"""

from pathlib import Path

from bokeh.models import (
    AllIndices,
    AllLabels,
    BasicTickFormatter,
    CDSView,
    CustomJS,
    CustomJSHover,
    CustomJSTickFormatter,
)
from bokeh.plotting import figure

from app.bundle import call
from app.model.colours import FAINT, INK
from app.text import decimal_point, say
from app.widgets.look import FAMILY

CLICKS, DRAG = ("tap", "doubletap"), ("panstart", "pan", "panend")
"""Bokeh's gestures. It calls the second of two clicks within 0.3 s a doubletap, wherever it is, and not a tap as
well."""
TICKS = Path(__file__).parents[1].joinpath("ticks.js").read_text(encoding="utf-8")
GRID, PAPER = "#e7ebef", "#ffffff"


def in_language(basic):
    """A tick formatter of Bokeh's, with the decimal point of the page's language."""
    return CustomJSTickFormatter(args={"basic": basic, "point": decimal_point()}, code=TICKS)


def decimals():
    """For the numbers of a HoverTool, "$x{3}": in the notation of the page's language, with so many decimals."""
    return CustomJSHover(
        args={"point": decimal_point()}, code='return Number(value).toFixed(Number(format)).replace(".", point)'
    )


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
    if fig.renderers:  # nothing is selected, so one policy serves all sources
        source.selection_policy = fig.renderers[0].data_source.selection_policy
    return fig.add_glyph(source, glyph, level=level, view=CDSView(filter=of_all))
