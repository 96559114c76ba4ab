"""Measured values as points with error bars, over the model's curve, and the residuals below."""

from functools import partial

import numpy as np
from bokeh.models import BoxAnnotation, ColumnDataSource, FixedTicker, Label, Line, Range1d, Scatter, VArea, Whisker

from app.bundle import call, pack
from app.model.colours import COLOURS, FAINT, GREY, INK
from app.text import say
from app.widgets.cards import column, words
from app.widgets.film_stage import clear_motion, put_motion
from app.widgets.forms import Stretch
from app.widgets.plots import draw, on_pointer, pane, plain, rule

SHOWN = dict.fromkeys(("tilt", "line", "azimuth"), 180 / np.pi) | dict.fromkeys(("spin", "precession"), 0.5 / np.pi)
"""{quantity: the factor from the unit of the data to that of the axis}; for lengths 1000, to mm."""
COLOUR = {"spin": "omega", "precession": "omega", "azimuth": "theta"}
HEIGHT, SMALL, REST, LEFT = 250, 180, 56, 52  # px; SMALL if there are more than two figures
NOTHING = {"t": np.zeros(0), "y": np.zeros(0)}
FRAME = f"height: {HEIGHT + REST}px; border: 1px solid var(--rule); border-radius: 6px; box-sizing: border-box"
HEAD = "display: flex; flex-wrap: wrap; justify-content: space-between; align-items: baseline; gap: 0 16px"


def size_of(quantity):
    return SHOWN.get(quantity, 1e3)


def part_of_time(does):
    """A stretch in s."""
    return Stretch(say("measure.part"), does, unit="s", margin=(6, 0, 6, LEFT), sizing_mode="stretch_width")


def show_film(stage, shown, outline):
    """Shows a Shown on the stage; None: nothing. outline: (k, 2), that of the body."""
    if shown is None:
        clear_motion(stage)
        return
    start = shown.t[0] + 0.6 * (shown.t[-1] - shown.t[0])
    label = say("measure.axis" if shown.azimuths else "measure.axis_tilt")
    put_motion(stage, shown.t, shown.motion, outline, start, measured=pack(shown.axis), measured_label=label)


def _heard(pulled, attr, old, new):
    match new:  # a client other than the page may send anything
        case {"start": [int() | float() as start]} if np.isfinite(start):
            pulled(float(start))


class Pictures:
    """view: one figure for each quantity. pulled: called with the time (s) to which the start of the motion is
    dragged."""

    def __init__(self, pulled):
        self._hand = ColumnDataSource({"start": [0.0]})
        self._hand.on_change("data", partial(_heard, pulled))
        self.view = column()
        self._parts, self._starts = {}, []

    def clear(self):
        """Shows an empty frame in place of the figures."""
        self._parts, self._starts = {}, []
        self.view.objects = [words(f'<div style="{FRAME}"></div>')]

    def begin(self, data, start, source):
        """Shows new data. source: their origin, in words."""
        first, last = data.t[0], data.t[-1]
        pad = 0.02 * (last - first)
        x_range = Range1d(first - pad, last + pad)
        high = HEIGHT if len(data.series) < 3 else SMALL
        last = [*data.series][-1]
        self._parts = {
            name: _Picture(name, series, x_range, high, name == last) for name, series in data.series.items()
        }
        figures = [fig for part in self._parts.values() for fig in (part.fig, part.rest)]
        spans = [rule(fig, "height", None, level="overlay", line_color=COLOURS["accent"], line_width=1.5)
                 for fig in figures]  # fmt: skip
        self._starts = [rule(fig, "height", start, line_color=INK, line_width=1.5, line_dash=[5, 4]) for fig in figures]
        curves = [part.curve for part in self._parts.values()]
        for fig in figures:
            pull = call("pullFilm", fig=fig, hand=self._hand, starts=self._starts, curves=curves)
            on_pointer(fig, pull, "mousemove")
        figures[0].js_on_change("inner_width", call("moveLines", spans=spans, clock="film"))
        figures[0].add_layout(Label(x=start, y=high - 32, y_units="screen", x_offset=5, text=say("measure.begins"),
                                    text_color=FAINT, text_font_size="12px"))  # fmt: skip
        self.view.objects = [
            words(f'<div style="{HEAD}"><b>{say("measure.overlay")}</b><span class="key">{source}</span></div>'),
            *(pane for part in self._parts.values() for pane in part.panes),
            words(f'<div class="key">{say("measure.time")}. {say("measure.below")}</div>', margin=(0, 0, 0, LEFT)),
        ]

    def show(self, shown, fit=None):
        """The curves of a Shown and, if they were fitted, the residuals. None: no curves."""
        for name, part in self._parts.items():
            part.show(shown, name, fit)


class _Picture:
    """One quantity: fig with the points and the curve, rest with the residuals; timed: with an axis of time below."""

    def __init__(self, name, series, x_range, high, timed):
        self.name, self.size = name, size_of(name)
        title = say(f"measure.quantities.{name}")
        look = {"x_range": x_range, "min_border_left": LEFT}
        self.fig = plain(say("measure.picture", name=title), high, x_axis_location=None, **look)
        self.rest = plain(say("measure.rest", name=title), REST, y_range=(-3.5, 3.5), **look,
                          x_axis_location="below" if timed else None)  # fmt: skip
        self.curve, self.left = ColumnDataSource(NOTHING), ColumnDataSource(NOTHING)
        for fig in (self.fig, self.rest):
            fig.xgrid.visible = False
            fig.yaxis.update(axis_line_color=None, major_tick_line_color=None)
        self._dots(series)
        self.rest.add_layout(BoxAnnotation(bottom=-1, top=1, fill_color=GREY, fill_alpha=0.18, line_color=None))
        draw(self.rest, Scatter, "t", "y", source=self.left, size=3.5, fill_color=FAINT, line_color=FAINT)
        self.rest.yaxis.ticker = FixedTicker(ticks=[0])
        self.rest.ygrid.ticker = self.rest.yaxis.ticker
        self.head = words(self._head())
        self.panes = [self.head, pane(self.fig), pane(self.rest)]

    def _head(self, after=""):
        unit, title = say(f"measure.units.{self.name}"), say(f"measure.quantities.{self.name}")
        left, right = (f"<span class='key'>{text}</span>" for text in (unit, after))
        return f"<div style='{HEAD}'><span><b>{title}</b> {left}</span>{right}</div>"

    def _dots(self, series):
        y, error = series.values * self.size, series.error * self.size
        dots = ColumnDataSource({"t": series.t, "y": y, "low": y - error, "high": y + error})
        self.fig.add_layout(Whisker(base="t", lower="low", upper="high", source=dots, line_color=GREY,
                                    upper_head=None, lower_head=None))  # fmt: skip
        colour = COLOURS[COLOUR[self.name]] if self.name in COLOUR else INK
        draw(self.fig, Line, "t", "y", source=self.curve, line_color=colour, line_width=2)
        draw(self.fig, Scatter, "t", "y", source=dots, size=5.5, fill_color="#ffffff", line_color=INK)

    def show(self, shown, name, fit):
        if shown is None or name not in shown.curves:
            self.curve.data, self.left.data = NOTHING, NOTHING
            self.head.object = self._head()
            return
        t, values = shown.curves[name]
        self.curve.data = {"t": np.array(t), "y": values * self.size}
        if fit is None:
            self.left.data, self.head.object = NOTHING, self._head(say("measure.not_fitted"))
            return
        rest = shown.residuals.of[name]
        most = max(3.5, float(np.abs(rest).max()) * 1.1)
        self.rest.y_range.update(start=-most, end=most)
        chi2, count = fit.chi2_of[name]
        self.left.data = {"t": shown.data.series[name].t, "y": rest}
        self.head.object = self._head(say("measure.chi2", chi2=chi2, count=count))


def constants(kept):
    """A figure for each constant of the motion, computed from the data alone, with its errors."""
    panes = []
    for name, constant in kept.items():
        colour = COLOURS["jellett" if name == "K_J" else "routh"]
        fig = plain(say("measure.kept.picture", name=say(f"measure.kept.{name}")), 150, min_border_left=LEFT)
        fig.xgrid.visible = False
        t, values, errors = constant.t, constant.values, constant.errors
        found = ColumnDataSource({"t": t, "low": values - errors, "y": values, "high": values + errors})
        draw(fig, VArea, "t", y1="low", y2="high", source=found, fill_color=colour, fill_alpha=0.2)
        draw(fig, Line, "t", "y", source=found, line_color=colour, line_width=1.5)
        mean, _ = constant.mean
        rule(fig, "width", mean, line_color=INK, line_dash=[6, 4])
        middle, half = mean, max(1.2 * float(np.abs(values - mean).max() + errors.max()), 0.1 * abs(mean))
        fig.y_range = Range1d(middle - half, middle + half)
        fig.yaxis.ticker.desired_num_ticks = 4
        head = f"<b>{say(f'measure.kept.{name}')}</b> <span class='key'>{say('measure.kept.band')}</span>"
        panes += [words(head), pane(fig)]
    return panes
