"""Measured values as points with error bars, over the model's curve, and the residuals below."""

from functools import partial

import numpy as np
from bokeh.models import BoxAnnotation, ColumnDataSource, FixedTicker, Label, Line, Range1d, Scatter, VArea, Whisker

from app.bundle import call, pack
from app.model.colours import COLOURS, FAINT, GREY, INK
from app.text import say
from app.widgets.cards import TYPE, column, words
from app.widgets.drawing import drawn
from app.widgets.film_stage import clear_motion, put_motion
from app.widgets.forms import Stretch
from app.widgets.plots import draw, on_pointer, plain, rule

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


class Series:
    """For each quantity a figure of its values with the curve of the model, and one of the residuals below."""

    def __init__(self, *names):
        self.x_range, self.hand = Range1d(0, 1), ColumnDataSource({"start": [0.0]})
        self.figures, self.starts, self.dots, self.curves, self.left, self.rests = [], [], {}, {}, {}, {}
        high = HEIGHT if len(names) < 3 else SMALL
        for name in names:
            self._add(name, high, name == names[-1])
        spans = [rule(fig, "height", None, level="overlay", line_color=COLOURS["accent"], line_width=1.5)
                 for fig in self.figures]  # fmt: skip
        self.starts += [rule(fig, "height", 0, line_color=INK, line_width=1.5, line_dash=[5, 4])
                        for fig in self.figures]  # fmt: skip
        for fig in self.figures:
            pull = call("pullFilm", fig=fig, hand=self.hand, starts=self.starts, curves=[*self.curves.values()])
            on_pointer(fig, pull, "mousemove")
        self.figures[0].js_on_change("inner_width", call("moveLines", spans=spans, clock="film"))
        self.begins = Label(x=0, y=high - 32, y_units="screen", x_offset=5, text=say("measure.begins"),
                            text_color=FAINT, text_font_size="12px")  # fmt: skip
        self.figures[0].add_layout(self.begins)

    def _add(self, name, high, is_last):
        title, look = say(f"measure.quantities.{name}"), {"x_range": self.x_range, "min_border_left": LEFT}
        fig = plain(say("measure.picture", name=title), high, x_axis_location=None, **look)
        rest = plain(say("measure.rest", name=title), REST, y_range=(-3.5, 3.5), **look,
                     x_axis_location="below" if is_last else None)  # fmt: skip
        for each in (fig, rest):
            each.xgrid.visible = False
            each.yaxis.update(axis_line_color=None, major_tick_line_color=None)
        dots = ColumnDataSource({"t": [], "y": [], "low": [], "high": []})
        curve, left = ColumnDataSource(NOTHING), ColumnDataSource(NOTHING)
        fig.add_layout(Whisker(base="t", lower="low", upper="high", source=dots, line_color=GREY, upper_head=None,
                               lower_head=None))  # fmt: skip
        colour = COLOURS[COLOUR[name]] if name in COLOUR else INK
        draw(fig, Line, "t", "y", source=curve, line_color=colour, line_width=2)
        draw(fig, Scatter, "t", "y", source=dots, size=5.5, fill_color="#ffffff", line_color=INK)
        rest.add_layout(BoxAnnotation(bottom=-1, top=1, fill_color=GREY, fill_alpha=0.18, line_color=None))
        draw(rest, Scatter, "t", "y", source=left, size=3.5, fill_color=FAINT, line_color=FAINT)
        rest.yaxis.ticker = rest.ygrid.ticker = FixedTicker(ticks=[0])
        self.figures += [fig, rest]
        self.dots[name], self.curves[name], self.left[name], self.rests[name] = dots, curve, left, rest

    def begin(self, data, start):
        """Shows Data without a curve."""
        first, last = data.t[0], data.t[-1]
        pad = 0.02 * (last - first)
        self.x_range.update(start=first - pad, end=last + pad)
        for line in self.starts:
            line.location = start
        self.begins.x = start
        for name, series in data.series.items():
            y, error = series.values * size_of(name), series.error * size_of(name)
            self.dots[name].data = {"t": series.t, "y": y, "low": y - error, "high": y + error}

    def show(self, shown, fit):
        """The curves of a Shown and, if they were fitted, the residuals; returns what is said of each quantity."""
        return [self._show(name, shown, fit) for name in self.curves]

    def _show(self, name, shown, fit):
        if shown is None or name not in shown.curves:
            self.curves[name].data, self.left[name].data = NOTHING, NOTHING
            return ""
        t, values = shown.curves[name]
        self.curves[name].data = {"t": np.array(t), "y": values * size_of(name)}
        if fit is None:
            self.left[name].data = NOTHING
            return say("measure.not_fitted")
        rest = shown.residuals.of[name]
        most = max(3.5, float(np.abs(rest).max()) * 1.1)
        self.rests[name].y_range.update(start=-most, end=most)
        self.left[name].data = {"t": shown.data.series[name].t, "y": rest}
        chi2, count = fit.chi2_of[name]
        return say("measure.chi2", chi2=chi2, count=count)


class Pictures:
    """view: the figures of Data. pulled: called with the time (s) to which the start of the motion is dragged."""

    def __init__(self, pulled):
        self._pulled, self._names, self._series = partial(_heard, pulled), (), None
        self.view = column()

    def clear(self):
        """Shows an empty frame in place of the figures."""
        self._names, self._series = (), None
        self.view.objects = [words(f'<div style="{FRAME}"></div>')]

    def begin(self, data, start, source):
        """Shows new data. source: their origin, in words."""
        self._names = tuple(data.series)
        self._series = drawn(Series, *self._names, stylesheets=[TYPE])
        self._series.hand.on_change("data", self._pulled)
        self._series.begin(data, start)
        self.show(None)
        self.view.objects = [
            words(f'<div style="{HEAD}"><b>{say("measure.overlay")}</b><span class="key">{source}</span></div>'),
            self._series.drawing,
            words(f'<div class="key">{say("measure.time")}. {say("measure.below")}</div>', margin=(0, 0, 0, LEFT)),
        ]

    def show(self, shown, fit=None):
        """The curves of a Shown and, if they were fitted, the residuals. None: no curves."""
        if self._series:
            says = self._series.show(shown, fit)
            heads = [part for name, after in zip(self._names, says, strict=True) for part in (_head(name, after), "")]
            self._series.drawing.heads = heads


def _head(name, after):
    unit, title = say(f"measure.units.{name}"), say(f"measure.quantities.{name}")
    left, right = (f"<span class='key'>{text}</span>" for text in (unit, after))
    return f"<div style='{HEAD}'><span><b>{title}</b> {left}</span>{right}</div>"


class Constants:
    """A figure for each of these constants of the motion, computed from the data alone, with its errors."""

    def __init__(self, *names):
        self.figures, self.sources, self.means = [], [], []
        for name in names:
            colour = COLOURS["jellett" if name == "K_J" else "routh"]
            fig = plain(say("measure.kept.picture", name=say(f"measure.kept.{name}")), 150, min_border_left=LEFT,
                        y_range=(0, 1))  # fmt: skip
            fig.xgrid.visible = False
            source = ColumnDataSource({"t": [], "low": [], "y": [], "high": []})
            draw(fig, VArea, "t", y1="low", y2="high", source=source, fill_color=colour, fill_alpha=0.2)
            draw(fig, Line, "t", "y", source=source, line_color=colour, line_width=1.5)
            self.means.append(rule(fig, "width", line_color=INK, line_dash=[6, 4]))
            fig.yaxis.ticker.desired_num_ticks = 4
            self.figures.append(fig)
            self.sources.append(source)

    def show(self, found):
        for constant, fig, source, line in zip(found, self.figures, self.sources, self.means, strict=True):
            values, errors = constant.values, constant.errors
            source.data = {"t": constant.t, "low": values - errors, "y": values, "high": values + errors}
            middle, _ = constant.mean
            line.location = middle
            half = max(1.2 * float(np.abs(values - middle).max() + errors.max()), 0.1 * abs(middle))
            fig.y_range.update(start=middle - half, end=middle + half)


def constants(kept):
    """The parts of the page that show {name: a constant of the motion}."""
    if not kept:
        return []
    figures = drawn(Constants, *kept, stylesheets=[TYPE])
    figures.show(kept.values())
    band = f'<span class="key">{say("measure.kept.band")}</span>'
    figures.drawing.heads = [f"<b>{say(f'measure.kept.{name}')}</b> {band}" for name in kept]
    return [figures.drawing]
