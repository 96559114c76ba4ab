"""Tops of a family side by side: Fig. 6 of each on common axes, and a map of the share of it that friction leaves."""

import time

import numpy as np
import panel as pn
import panel_material_ui as pmui
from bokeh.models import ColorBar, ColumnDataSource, HoverTool, LinearColorMapper, Range1d
from bokeh.palettes import Viridis256

from app.builder import thrown
from app.colours import COLOURS
from app.family import neighbours, region, share_map
from app.plots import FAINT, INK, plain
from app.workshop import words
from tippe_core import PRESETS

FAMILIES = {"none": "", "the presets": "presets", "other a": "a", "other I₃": "I3"}
FLOW = {"display": "flex", "flex-flow": "row wrap", "gap": "8px"}
A, RATIOS = np.linspace(0.02, 0.5, 17), np.linspace(0.6, 1.6, 11)
# A turn of the server computes so long, in s, and then the page is served for so long at least, in ms.
TURN, REST = 0.1, 20
BUTTON = {"size": "small", "variant": "outlined", "margin": 0, "sx": {"textTransform": "none"}}


def small_figure(shown, x_range, y_range):
    """Fig. 6 of one top, a family.Region, with K_J in units of its own K_J(P)."""
    fig = plain(x_range=x_range, y_range=y_range, title=f"{shown.name}; {shown.pole:.3g}")
    fig.update(sizing_mode=None, width=205, height=230)
    fig.title.text_font_size, fig.title.text_color, fig.title.text_font_style = "12px", INK, "normal"
    fig.xaxis.ticker.desired_num_ticks = 3
    steady, lift, slip = shown.lift.theta_steady, shown.lift, shown.slip
    ends = {"l0": lift.theta_inner, "l1": lift.theta_outer, "s0": slip.theta_inner, "s1": slip.theta_outer}
    # where even the steady precession breaks a limit, the tieline is a point there
    ends = {name: np.where(np.isnan(theta), steady, theta) for name, theta in ends.items()}
    source = ColumnDataSource({"part": shown.part, "steady": steady, **ends})
    for left, right in (("l0", "s0"), ("s1", "l1")):
        fig.harea(y="part", x1=left, x2=right, source=source, fill_color=COLOURS["friction"], fill_alpha=0.16)
    fig.segment(x0="s0", x1="s1", y0="part", y1="part", source=source, line_color=INK, line_alpha=0.55)
    fig.line("l1", "part", source=source, line_color=COLOURS["normal"], line_width=2)
    fig.line("steady", "part", source=source, line_color=INK, line_width=1.5, line_dash=[6, 4])
    return fig


class Compare:
    """The card's content. Nothing is computed before a person asks for it."""

    def __init__(self, explorer):
        self._explorer, self._steps, self._job = explorer, None, None
        self.row = pn.Column(sizing_mode="stretch_width", margin=0, styles=FLOW)
        self.family = pmui.RadioButtonGroup(
            label="", options=FAMILIES, value="", size="small", margin=0,
            sx={"& button": {"textTransform": "none", "padding": "3px 8px", "whiteSpace": "nowrap"}},
        )  # fmt: skip
        self.family.param.watch(lambda event: self.show(event.new), "value")
        self.said = words("")
        # half a cell beyond the first and the last
        sides = [Range1d(values[0] - step / 2, values[-1] + step / 2)
                 for values, step in ((A, A[1] - A[0]), (RATIOS, RATIOS[1] - RATIOS[0]))]  # fmt: skip
        self.map = fig = plain(x_range=sides[0], y_range=sides[1], name="map")
        fig.update(sizing_mode=None, width=330, height=300)
        colours = LinearColorMapper(palette=Viridis256, low=0, high=1, nan_color="rgba(0, 0, 0, 0)")
        self.shares = ColumnDataSource({"share": []})
        self.here = ColumnDataSource({"a": [], "ratio": []})
        picture = fig.image(
            "share", x=sides[0].start, dw=sides[0].end - sides[0].start, y=sides[1].start,
            dh=sides[1].end - sides[1].start, source=self.shares, color_mapper=colours,
        )  # fmt: skip
        fig.scatter("a", "ratio", source=self.here, size=9, fill_color="white", line_color=INK, line_width=2)
        fig.add_layout(ColorBar(color_mapper=colours, width=10, major_label_text_color=INK,
                                major_tick_line_color=FAINT), "right")  # fmt: skip
        fig.add_tools(HoverTool(renderers=[picture], tooltips="a/R $x{0.000}, I₃/I₁ $y{0.00}: @share{0.00}"))
        self.bar = pmui.LinearProgress(value=0, variant="determinate", visible=False, sizing_mode="stretch_width",
                                       margin=(8, 0))  # fmt: skip
        self.start = pmui.Button(label="Compute the map", **BUTTON)
        self.cancel = pmui.Button(label="Cancel", disabled=True, **BUTTON)
        self.start.on_click(lambda event: self.compute())
        self.cancel.on_click(lambda event: self._end("Cancelled; the rest of the map is empty."))

    @property
    def figures_view(self):
        """Fig. 6 of several tops."""
        key = (
            "Tielines under both limits over <i>θ</i> (rad), upwards <i>K</i><sub>J</sub>/<i>K</i><sub>J</sub>(P); "
            "<i>K</i><sub>J</sub>(P) beside the name")  # fmt: skip
        return [self.family, words(f'<div class="note">{key}</div>', margin=(6, 0, 0, 0)), self.row]

    @property
    def map_view(self):
        """The map of the share, and what starts and stops it."""
        says = (
            "The part of the (<i>K</i><sub>J</sub>, <i>θ</i>) plane that friction leaves, of what "
            "<i>F</i><sub>z</sub> ≥ 0 allows: over <i>a</i>/<i>R</i>, upwards "
            "<i>I</i><sub>3</sub>/<i>I</i><sub>1</sub>, at this <i>I</i><sub>1</sub>, "
            "<i>K</i><sub>R</sub> and <i>μ</i><sub>s</sub>. The ring is this top.")  # fmt: skip
        return [
            words(f"<div>{says}</div>", margin=(0, 0, 6, 0)),
            pn.Column(self.start, self.cancel, sizing_mode="stretch_width", margin=0, styles=FLOW),
            self.bar,
            self.said,
            pn.pane.Bokeh(self.map, margin=0),
        ]

    def show(self, which):
        """The small figures: of the "presets", all with one spin, or of this top's neighbours, at this K_R; "" none."""
        explorer, tops = self._explorer, []
        if which == "presets":
            tops = [(preset.name, preset.shape.top, thrown(preset.shape)[1]) for preset in PRESETS]
        elif which:
            tops = [(name, top, explorer.K_R) for name, top in neighbours(explorer.scene.top, which)]
        ranges = Range1d(0, np.pi), Range1d(0, 1.02)
        self.row.objects = [
            pn.pane.Bokeh(small_figure(region(name, top, K_R, explorer.mu_s), *ranges), margin=0)
            for name, top, K_R in tops
        ]

    def compute(self):
        """Starts the map, a few tops a turn of the server, so that the page and "Cancel" stay alive."""
        top = self._explorer.scene.top
        self._steps = share_map(top.I1, self._explorer.K_R, self._explorer.mu_s, A, RATIOS)
        self.here.data = {"a": [top.a], "ratio": [top.I3 / top.I1]}
        self.start.disabled, self.cancel.disabled = True, False
        self.bar.visible, self.bar.value, self.said.object = True, 0, ""
        self._job = pn.state.add_periodic_callback(self.turn, period=REST)

    def turn(self):
        """Some more tops; the picture after each row, and the end after the last."""
        if self._steps is None:
            return
        until = time.monotonic() + TURN
        while time.monotonic() < until:
            done, found = next(self._steps, (None, None))
            if done is None:
                self._end("")
                return
            if done % len(A) == 0:
                self.shares.data = {"share": [found.share.copy()]}
                self.bar.value = int(100 * done / found.share.size)

    def _end(self, text):
        self._steps = None
        if self._job is not None:
            self._job.stop()
            self._job = None
        self.start.disabled, self.cancel.disabled, self.bar.visible = False, True, False
        self.said.object = f'<div class="note">{text}</div>' if text else ""
