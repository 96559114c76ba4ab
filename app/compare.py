"""Tops of a family side by side: Figs. 5 and 6 of each on common axes, and a map of the share that friction leaves."""

import time
from functools import partial

import numpy as np
import panel as pn
import panel_material_ui as pmui
from bokeh.models import ColorBar, ColumnDataSource, HoverTool, LinearColorMapper, Range1d
from bokeh.palettes import Viridis256

from app.builder import thrown
from app.cards import BUTTON, PLAIN, alert, flow, note, on_click, progress, swatch, words
from app.colours import COLOURS, FAINT, INK
from app.family import neighbours, ordinary, pegs, presets, region, share_map
from app.plots import plain
from app.runs import Run, Runs, Stopped
from app.text import listed, say, told
from app.workshop import beside, field, typed
from tippe_core import TopError

SMALL = 158  # px: two of them beside each other on a phone
PICTURE_EVERY = 0.5  # s
RATIOS = np.linspace(0.6, 1.9, 40)
SPANS = {"tippe": np.linspace(0.02, 0.5, 49), "ordinary": np.linspace(-10.0, -0.2, 50)}
SHEET = "#dcebf6"
# Fig. 5 as a drawing: K_J runs so far back and up, of the width and the height of the picture
BACK, UP, HIGH = 0.28, 0.45, 0.5


def waterfall(shown, end, most):
    """Fig. 5 of a family.Region as a drawing: a sheet of f1^2 theta_dot^2 stands on every tieline, K_J to the back.

    end: where the theta axis ends; most: the height, in K_R^2, that all figures have room for.
    """

    def place(theta, part, height=0.0):
        return theta + BACK * end * part, UP * part + HIGH * height / most

    fig = plain(x_range=Range1d(-0.06 * end, (1 + BACK) * end * 1.03), y_range=Range1d(-0.14, UP + HIGH + 0.04),
                title=shown.name, name="waterfall")  # fmt: skip
    fig.update(sizing_mode=None, width=SMALL, height=190)
    fig.title.text_font_size, fig.title.text_color, fig.title.text_font_style = "12px", INK, "normal"
    fig.axis.visible = fig.grid.visible = False
    corners = [place(*corner) for corner in ((0, 0), (end, 0), (end, 1), (0, 1), (0, 0))]
    fig.line(*zip(*corners, strict=True), line_color=FAINT)
    for theta, label in ((0, "0"), (np.pi / 2, "π/2"), (np.pi, "π")):
        if theta <= end:
            fig.line(*zip(place(theta, 0), place(theta, 1), strict=True), line_color=FAINT, line_dash=[2, 4])
            fig.text(theta, 0, text=[label], y_offset=4, text_align="center", text_baseline="top", text_color=INK,
                     text_font_size="11px")  # fmt: skip
    rows = np.flatnonzero(np.isfinite(shown.height).all(axis=1))[::-1]
    sheets = [place(shown.theta[row], shown.part[row], shown.height[row]) for row in rows]
    # closed along the tieline, from the back to the front
    fig.patches([x for x, _ in sheets], [y for _, y in sheets], fill_color=SHEET, fill_alpha=0.85,
                line_color=INK, line_alpha=0.7, line_width=0.7)  # fmt: skip
    fig.line(*place(shown.lift.theta_steady, shown.part), line_color=INK, line_dash=[6, 4], line_width=1.5)
    lifts = np.where(np.isfinite(shown.lift.E), shown.lift.theta_outer, np.nan)
    fig.line(*place(lifts, shown.part), line_color=COLOURS["normal"], line_width=1.5)
    return fig


def small_figure(shown, x_range, y_range):
    """Fig. 6 of one top, a family.Region, with K_J in units of its own K_J(P)."""
    fig = plain(x_range=x_range, y_range=y_range, title=f"Kⱼ(P) = {shown.pole:.3g}".replace("-", "−"))
    fig.update(sizing_mode=None, width=SMALL, height=200)
    fig.title.text_font_size, fig.title.text_color, fig.title.text_font_style = "12px", INK, "normal"
    fig.xaxis.ticker.desired_num_ticks = 3
    steady, lift, slip = shown.lift.theta_steady, shown.lift, shown.slip
    ends = {"l0": lift.theta_inner, "l1": lift.theta_outer, "s0": slip.theta_inner, "s1": slip.theta_outer}
    # where even the steady precession breaks a limit, the tieline is a point there
    ends = {name: np.where(np.isnan(theta), steady, theta) for name, theta in ends.items()}
    source = ColumnDataSource({"part": shown.part, "steady": steady, "verge": slip.theta_verge,
                               "lifts": np.where(np.isfinite(lift.E), ends["l1"], np.nan), **ends})
    for left, right in (("l0", "s0"), ("s1", "l1")):
        fig.harea(y="part", x1=left, x2=right, source=source, fill_color=COLOURS["friction"], fill_alpha=0.16)
    fig.segment(x0="s0", x1="s1", y0="part", y1="part", source=source, line_color=INK, line_alpha=0.55)
    fig.line("lifts", "part", source=source, line_color=COLOURS["normal"], line_width=2)
    fig.line("verge", "part", source=source, line_color=COLOURS["friction"], line_width=2)
    fig.line("steady", "part", source=source, line_color=INK, line_width=1.5, line_dash=[6, 4])
    return fig


class Compare:
    """The tab's content; show() and compute() fill it. runs: the page's Runs."""

    # what a map is made with: name, symbol
    FIELDS = (("I1", "<i>I</i><sub>1</sub>"), ("K_R", "<i>K</i><sub>R</sub>"), ("mu_s", "<i>μ</i><sub>s</sub>"))

    def __init__(self, explorer, runs=None):
        self._explorer, self._runs, self._run = explorer, runs or Runs(), None
        self.rows = pn.Column(sizing_mode="stretch_width", margin=0)
        self.key = words()
        self.family = self._buttons("families")
        self.family.param.watch(lambda event: self.show(event.new), "value")
        self.kind = self._buttons("kinds")
        self.kind.value = "ordinary" if explorer.scene.top.a < 0 else "tippe"
        self.kind.param.watch(lambda event: self._prefill(), "value")
        spoken = {name: listed(f"controls.spoken.{name}")[0] for name, _ in self.FIELDS}
        self.entries = {name: field("", say("family.map.entry", name=spoken[name]), width=76) for name in spoken}
        self._prefill()
        self.said = words()
        self.map = fig = plain(x_range=Range1d(0, 1), y_range=Range1d(*_sides(RATIOS)), name="map")
        fig.update(sizing_mode="stretch_width", height=330)
        colours = LinearColorMapper(palette=Viridis256, low=0, high=1, nan_color="rgba(0, 0, 0, 0)")
        self.shares = ColumnDataSource({"share": [], "x": [], "w": []})
        self.here = ColumnDataSource({"a": [], "ratio": []})
        bottom, top = _sides(RATIOS)
        picture = fig.image("share", x="x", dw="w", y=bottom, dh=top - bottom, source=self.shares,
                            color_mapper=colours)  # fmt: skip
        fig.scatter("a", "ratio", source=self.here, size=9, fill_color="white", line_color=INK, line_width=2)
        fig.add_layout(ColorBar(color_mapper=colours, width=10, major_label_text_color=INK,
                                major_tick_line_color=FAINT), "right")  # fmt: skip
        fig.add_tools(HoverTool(renderers=[picture], tooltips="a/R $x{0.000}, I₃/I₁ $y{0.00}: @share{0.00}"))
        self._show_span()
        self.bar = words(visible=False, margin=(8, 0))
        self.start = pmui.Button(label=say("family.map.start"), **BUTTON)
        self.cancel = pmui.Button(label=say("family.map.cancel"), disabled=True, **BUTTON)
        on_click(self.start, self.compute)
        on_click(self.cancel, lambda event: self._run and self._run.stop())

    @staticmethod
    def _buttons(table):
        options = {says: value for value, says in listed(f"family.{table}").items()}
        return pmui.RadioButtonGroup(label="", options=options, value=next(iter(options.values())), size="small",
                                     margin=0, sx=PLAIN)  # fmt: skip

    @property
    def figures_view(self):
        """Figs. 5 and 6 of several tops."""
        return [self.family, self.key, self.rows]

    @property
    def map_view(self):
        """The map of the share, and what starts and stops it."""
        with_these = [beside(symbol, self.entries[name]) for name, symbol in self.FIELDS]
        return [
            self.kind,
            words(say("family.map.says"), margin=(6, 0)),
            flow(*with_these, self.start, self.cancel, margin=(0, 0, 6, 0)),
            self.bar,
            self.said,
            words("<i>I</i><sub>3</sub>/<i>I</i><sub>1</sub>"),
            pn.pane.Bokeh(self.map, sizing_mode="stretch_width", height=330, margin=0),
            words('<div style="text-align: center"><i>a</i>/<i>R</i></div>'),
            words(note(say("family.map.here"))),
        ]  # fmt: skip

    def show(self, which):
        """The small figures: of the "presets" or of "pegs", all with one spin, or of this top's neighbours, at this
        K_R."""
        explorer = self._explorer
        tops = {"presets": presets, "pegs": pegs}.get(
            which, lambda: [(name, top, explorer.K_R) for name, top in neighbours(explorer.scene.top, which)])()
        shown = [region(name, top, K_R, explorer.mu_s) for name, top, K_R in tops]
        reach = max((np.nanmax(one.lift.theta_outer, initial=0.0) for one in shown), default=0.0)
        end = min(np.pi, max(np.pi / 2, 1.03 * reach))
        most = max((np.nanmax(one.height, initial=0.0) for one in shown), default=0.0) or 1.0
        ranges = Range1d(0, end), Range1d(0, 1.02)
        self.key.object = key_words(explorer.mu_s)
        pairs = [pn.Column(_pane(waterfall(one, end, most)), _pane(small_figure(one, *ranges)), width=SMALL, margin=0)
                 for one in shown]  # fmt: skip
        self.rows.objects = [flow(*pairs, margin=0)]

    def _prefill(self):
        """The explorer's own numbers where its top is of this kind, else those of a preset that is."""
        explorer, ordinary_tops = self._explorer, self.kind.value == "ordinary"
        I1, K_R = explorer.scene.top.I1, explorer.K_R
        if (explorer.scene.top.a < 0) != ordinary_tops:
            shape = ordinary() if ordinary_tops else type(explorer).shape.default
            I1, K_R = shape.top.I1, thrown(shape)[1]
        for name, value in (("I1", I1), ("K_R", K_R), ("mu_s", explorer.mu_s)):
            self.entries[name].value = f"{value:.4g}"

    def _show_span(self):
        a = SPANS[self.kind.value]
        low, high = _sides(a)
        self.map.x_range.update(start=low, end=high)
        return {"x": [low], "w": [high - low]}

    def _asked(self):
        """I1, K_R and mu_s as they were typed; raises ValueError, TopError."""
        values = {}
        for name, entry in self.entries.items():
            try:
                values[name] = typed(entry.value)
            except ValueError:
                raise ValueError(say("family.map.not_a_number", name=name, text=entry.value)) from None
        for name, allowed, good in (("I1", "I1 > 0 (in MR^2)", values["I1"] > 0),
                                    ("mu_s", "mu_s >= 0", values["mu_s"] >= 0)):  # fmt: skip
            if not good:
                raise TopError(name, values[name], allowed)
        return values

    def compute(self, event=None):
        """The map, beside the server, so that this page and all others stay served. Where there can be none, a sentence
        says why."""
        a = SPANS[self.kind.value]
        try:
            asked = self._asked()
        except ValueError as error:
            self.said.object = alert(told(error) if isinstance(error, TopError) else str(error))
            return
        top = self._explorer.scene.top
        own = abs(top.I1 - asked["I1"]) < 1e-3 * top.I1
        self.here.data = {"a": [top.a] * own, "ratio": [top.I3 / top.I1] * own}
        span = self._show_span()
        self.start.disabled, self.cancel.disabled = True, False
        self.bar.visible, self.bar.object, self.said.object = True, _progress(0), ""
        steps = share_map(asked["I1"], asked["K_R"], asked["mu_s"], a, RATIOS)
        self._run = Run(partial(self._work, steps, span), self._done)
        self._runs.begin(self._run, "map")

    def _work(self, steps, span, run):
        shown = time.monotonic()
        for done, found in steps:
            run.look()
            # a message now and then: more would queue up on a slow line, and be under way when a page is closed
            if found.share.size == done or time.monotonic() > shown + PICTURE_EVERY:
                shown = time.monotonic()
                self._runs.post(partial(self._show_rows, run, done, found, span))

    def _show_rows(self, run, done, found, span):
        """The map as far as it is."""
        if not run.stopped:
            self.shares.data = {"share": [found.share], **span}
            self.bar.object = _progress(100 * done / found.share.size)

    def _done(self, result):
        stopped = isinstance(result, Stopped)
        self.start.disabled, self.cancel.disabled, self.bar.visible = False, True, False
        self.said.object = note(say("family.map.cancelled")) if stopped else ""
        if isinstance(result, Exception) and not stopped:
            raise result


def key_words(mu_s):
    lines = "".join((
        swatch(INK, say("family.key.tielines")), swatch(INK, say("family.key.steady"), "dashed"),
        swatch(COLOURS["normal"], say("family.key.lift")),
        swatch(COLOURS["friction"], say("family.key.verge", mu_s=mu_s))))  # fmt: skip
    return f'<div class="key">{say("family.key.figures")}</div><div class="key">{lines}</div>'


def _progress(percent):
    return progress(percent, say("family.map.progress"))


def _pane(figure):
    return pn.pane.Bokeh(figure, width=SMALL, height=figure.height, margin=0)


def _sides(values):
    """Half a cell beyond the first and the last."""
    step = values[1] - values[0]
    return values[0] - step / 2, values[-1] + step / 2
