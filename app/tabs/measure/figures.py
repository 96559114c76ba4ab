"""What was measured as dots with their errors, over the model's curve, and what it leaves over below."""

import numpy as np
import panel as pn
from bokeh.models import BoxAnnotation, ColumnDataSource, Range1d, Whisker

from app.bundle import call
from app.model.colours import COLOURS, GREY, INK
from app.text import say
from app.widgets.cards import words
from app.widgets.plots import plain

SHOWN = {"tilt": 180 / np.pi, "azimuth": 180 / np.pi, "spin": 0.5 / np.pi, "precession": 0.5 / np.pi}
"""{quantity: how many of its unit on the axis one of the data is}; of lengths 1000, mm."""


def size_of(quantity):
    return SHOWN.get(quantity, 1e3)


def _named(fig, label):
    fig.js_on_change("inner_width", call("nameFigure", fig=fig, label=label))
    return fig


def pictures(data, left=None, start=None, end=None):
    """A column of a figure a quantity. left: what a fit leaves over of the data from start to end, s."""
    column = []
    first, last = data.t[0], data.t[-1]
    pad = 0.02 * (last - first)
    x_range = Range1d(first - pad, last + pad)
    inner = data.between(start, end) if left else None
    for name, series in data.series.items():
        unit, size = say(f"measure.units.{name}"), size_of(name)
        title = say(f"measure.quantities.{name}")
        fig = _named(plain(x_range=x_range), say("measure.picture", name=title))
        fig.update(sizing_mode="stretch_width", height=190, min_border_left=52)
        y, error = series.values * size, series.error * size
        dots = ColumnDataSource({"t": series.t, "y": y, "low": y - error, "high": y + error})
        fig.add_layout(Whisker(base="t", lower="low", upper="high", source=dots, line_color=GREY,
                               upper_head=None, lower_head=None))  # fmt: skip
        fig.scatter("t", "y", source=dots, size=5, fill_color=None, line_color=INK)
        column += [words(f"<b>{title}</b> <span class='key'>{unit}</span>"),
                   pn.pane.Bokeh(fig, sizing_mode="stretch_width", height=190, margin=0)]  # fmt: skip
        if left and name in left.residuals:
            colour = COLOURS["omega" if name in ("spin", "precession") else "theta"]
            t = inner.series[name].t
            fig.line(t, left.values[name] * size, line_color=colour, line_width=2)
            column.append(_rest(t, left.residuals[name], x_range, title))
    return column


def _rest(t, residuals, x_range, title):
    most = max(3.5, float(np.abs(residuals).max()) * 1.1)
    fig = _named(plain(x_range=x_range, y_range=Range1d(-most, most)), say("measure.rest", name=title))
    fig.update(sizing_mode="stretch_width", height=80, min_border_left=52)
    fig.add_layout(BoxAnnotation(bottom=-1, top=1, fill_color=GREY, fill_alpha=0.18, line_color=None))
    fig.scatter(t, residuals, size=3, color=INK)
    fig.yaxis.ticker.desired_num_ticks = 2
    return pn.pane.Bokeh(fig, sizing_mode="stretch_width", height=80, margin=0)
