"""A family of tops compared: a map of the share of their motions that is possible with a given friction."""

import time
from functools import partial

import numpy as np
from bokeh.models import BasicTickFormatter, ColorBar, ColumnDataSource, HoverTool, Image, LinearColorMapper, Scatter
from bokeh.palettes import Viridis256

from app.model.build.builder import thrown
from app.model.colours import FAINT, INK
from app.model.families.family import ordinary, share_map
from app.model.once import ONCE
from app.model.runs import Run, Runs, Stopped
from app.text import error_text, listed, say, written
from app.widgets.cards import alert, flow, note, progress, words
from app.widgets.drawing import drawn
from app.widgets.forms import Button, Choice, Field
from app.widgets.plots import decimals, draw, in_language, plain
from tippe_core import TopError, TruncatedSphere

PICTURE_EVERY = 0.5  # s
RATIOS = np.linspace(0.6, 1.9, 40)
SPANS = {"tippe": np.linspace(0.02, 0.5, 49), "ordinary": np.linspace(-10.0, -0.2, 50)}


class ShareFigure:
    """The map."""

    def __init__(self):
        bottom, top = _sides(RATIOS)
        self.figure = fig = plain(height=330, x_range=(0, 1), y_range=(bottom, top), name="map")
        colours = LinearColorMapper(palette=Viridis256, low=0, high=1, nan_color="rgba(0, 0, 0, 0)")
        self.shares = ColumnDataSource({"share": [], "x": [], "w": []})
        self.here = ColumnDataSource({"a": [], "ratio": []})
        picture = draw(fig, Image, "x", bottom, image="share", dw="w", dh=top - bottom, source=self.shares,
                       color_mapper=colours)  # fmt: skip
        draw(fig, Scatter, "a", "ratio", source=self.here, size=9, fill_color="white", line_color=INK, line_width=2)
        fig.add_layout(ColorBar(color_mapper=colours, width=10, major_label_text_color=INK, major_tick_line_color=FAINT,
                                formatter=in_language(BasicTickFormatter())), "right")  # fmt: skip
        fig.add_tools(HoverTool(renderers=[picture], tooltips="a/R $x{3}, I₃/I₁ $y{2}: @share{2}",
                                formatters=dict.fromkeys(("$x", "$y", "@share"), decimals())))  # fmt: skip


class Compare:
    """view: the map and its inputs; compute() fills it. scene: the first one; after show() requests refer to another
    scene. runs: the page's Runs."""

    # the parameters of a map: name, symbol
    FIELDS = (("I1", "<i>I</i><sub>1</sub>"), ("K_R", "<i>K</i><sub>R</sub>"), ("mu_s", "<i>μ</i><sub>s</sub>"))

    def __init__(self, scene, runs=None):
        self._scene, self._runs, self._run = scene, runs or Runs(), None  # the present run, if any
        kinds = {says: kind for kind, says in listed("family.kinds").items()}
        self.kind = Choice(kinds, "ordinary" if scene.top.a < 0 else "tippe")
        self.kind.on("value", lambda event: self._prefill())
        spoken = {name: say(f"controls.inputs.{name}.spoken") for name, _ in self.FIELDS}
        self.entries = {name: Field(say("family.map.entry", name=spoken[name]), shows=symbol)
                        for name, symbol in self.FIELDS}  # fmt: skip
        self._prefill()
        self.wording = words()
        self.map = drawn(ShareFigure)
        self._show_span()
        self.bar = words(visible=False, margin=(8, 0))
        self.start = Button(say("family.map.start"), self.compute)
        self.cancel = Button(say("family.map.cancel"), lambda: self._run and self._run.stop(), disabled=True)

    @property
    def map_view(self):
        """The map of the share, and the buttons that start and stop it."""
        return [
            self.kind,
            words(say("family.map.says"), margin=(6, 0)),
            flow(*self.entries.values(), self.start, self.cancel, margin=(0, 0, 6, 0)),
            self.bar,
            self.wording,
            words("<i>I</i><sub>3</sub>/<i>I</i><sub>1</sub>"),
            self.map.drawing,
            words('<div style="text-align: center"><i>a</i>/<i>R</i></div>' + note(say("family.map.here"))),
        ]  # fmt: skip

    def show(self, scene):
        self._scene = scene

    def _prefill(self):
        """Fills in the explorer's own numbers if its top is of this kind, otherwise those of a preset."""
        scene, ordinary_tops = self._scene, self.kind.value == "ordinary"
        I1, K_R = scene.top.I1, scene.inputs["K_R"]
        if (scene.top.a < 0) != ordinary_tops:
            shape = ordinary() if ordinary_tops else TruncatedSphere.paper()
            I1, K_R = shape.top.I1, thrown(shape)[1]
        for name, value in (("I1", I1), ("K_R", K_R), ("mu_s", scene.inputs["mu_s"])):
            self.entries[name].value = written(value, ".4g")
        self._good = {name: entry.value for name, entry in self.entries.items()}

    def _show_span(self):
        a = SPANS[self.kind.value]
        low, high = _sides(a)
        self.map.figure.x_range.update(start=low, end=high)
        return {"x": [low], "w": [high - low]}

    def _requested(self):
        """I1, K_R and mu_s as they were typed; if one cannot be, says so there, and raises ValueError."""
        values = {name: entry.number("family.map.not_a_number", self._good[name], name=name)
                  for name, entry in self.entries.items()}  # fmt: skip
        for name, allowed, good, near in (("I1", "I1 > 0 (in MR^2)", values["I1"] > 0, ""),
                                          ("mu_s", "mu_s >= 0", values["mu_s"] >= 0, "0")):  # fmt: skip
            if not good:
                error = TopError(name, values[name], allowed)
                self.entries[name].refuse(error_text(error), near, self._good[name])
                raise error
        self._good = {name: entry.value for name, entry in self.entries.items()}
        return values

    def compute(self):
        """Computes the map in a thread. If it is impossible, a sentence says why."""
        try:
            request = self._requested()
        except ValueError:
            return
        top = self._scene.top
        own = abs(top.I1 - request["I1"]) < 1e-3 * top.I1
        self.map.here.data = {"a": [top.a] * own, "ratio": [top.I3 / top.I1] * own}
        span = self._show_span()
        self.cancel.disabled = False
        self.bar.visible, self.bar.object, self.wording.object = True, _progress(0), ""
        wanted = request["I1"], request["K_R"], request["mu_s"], self.kind.value
        self._run = Run(partial(self._work, wanted, span), self._done)
        self._runs.begin(self._run, "map")

    def _work(self, wanted, span, run):
        found = ONCE.find(run.wait, (share_map, *wanted), lambda: self._computed(*wanted, span, run))
        self._runs.post(partial(self._show_rows, run, found.share.size, found, span))

    def _computed(self, I1, K_R, mu_s, kind, span, run):
        shown = time.monotonic()
        for done, found in share_map(I1, K_R, mu_s, SPANS[kind], RATIOS):
            run.look()
            # rarely: on a slow line more messages would queue up, and be under way when a page is closed
            if time.monotonic() > shown + PICTURE_EVERY:
                shown = time.monotonic()
                self._runs.post(partial(self._show_rows, run, done, found, span))
        return found

    def _show_rows(self, run, done, found, span):
        """Shows the map as far as it has been computed."""
        if not run.stopped:
            self.map.shares.data = {"share": [found.share], **span}
            self.bar.object = _progress(100 * done / found.share.size)

    def _done(self, result):
        stopped = isinstance(result, Stopped)
        self.cancel.disabled, self.bar.visible = True, False
        self.wording.object = note(say("family.map.cancelled")) if stopped else ""
        if isinstance(result, Exception) and not stopped:
            self.wording.object = alert(say("family.map.failed"))
            raise result


def _progress(percent):
    return progress(percent, say("family.map.progress"))


def _sides(values):
    """The outer edges of the first and the last cell."""
    step = values[1] - values[0]
    return values[0] - step / 2, values[-1] + step / 2
