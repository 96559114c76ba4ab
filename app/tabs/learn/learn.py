"""The tab "Learn": a question, a prediction, a run, an explanation with this run's numbers."""

from functools import partial
from html import escape

import numpy as np
import panel as pn
import panel_material_ui as pmui
import param
from bokeh.models import ColumnDataSource, CustomJS, Range1d

from app.bundle import pack
from app.model import lesson, lesson_sliding
from app.model.bodies import outline
from app.model.colours import COLOURS, GREY, INK
from app.model.frames import axes
from app.model.runs import Run, Runs
from app.state.keep import SECRET, Field, OneOf
from app.tabs.learn.lines import Derivation
from app.tabs.learn.poll import option, prediction
from app.tabs.learn.teach import Key, history_view, teach_view
from app.text import listed, say, told
from app.widgets.cards import PLAIN, alert, card, grid, note, on_click, px, swatch, words
from app.widgets.plots import plain
from app.widgets.top3d import REGIMES, Top3D, pack_frames, show_top
from tippe_core import TopError

CLOCK = "learn"
SECTIONS = ("lesson", "derivation", "teach", "history")
CODES = {"roll": REGIMES.index("rolls"), "slip": REGIMES.index("slips"), "air": REGIMES.index("in the air")}
ROLLING_SPEED, SLIDING_SPEED = 1 / 16, 1 / 4
MARGIN = 0.06
# MathML, which is what KaTeX leaves to the browser here, wants a font that has tall brackets.
MATHS = "math { font-family: 'STIX Two Math', 'Cambria Math', 'Latin Modern Math', 'DejaVu Math TeX Gyre', math }"

# Turns the section's drawing with the clock: only a rotation of the points that Python sent.
TURN_SECTION = """
if (motion.followed) return
motion.followed = true
let now = 0
const draw = () => {
  const {t, theta, push} = motion.data, last = t.length - 1
  const i = Math.round(Math.min(Math.max((now - t[0]) / (t[last] - t[0]), 0), 1) * last)
  const s = Math.sin(theta[i]), c = Math.cos(theta[i]), a = motion.data.a[0]
  const {across, along} = body.data, x = body.data.x, y = body.data.y
  for (let k = 0; k < across.length; k++) {
    x[k] = across[k] * c - along[k] * s
    y[k] = 1 + across[k] * s + along[k] * c
  }
  body.change.emit()
  const G = [a * s, 1 - a * c], mark = (k, x0, y0, x1, y1) => {
    Object.assign(lines.data.x0, {[k]: x0}); Object.assign(lines.data.y0, {[k]: y0})
    Object.assign(lines.data.x1, {[k]: x1}); Object.assign(lines.data.y1, {[k]: y1})
  }
  // the axis 3; the verticals through G and C; r from C to G; the arm of the torque about z, above the points, which
  // are larger than it; that about 3
  const foot3 = [s * c, 1 - c * c]
  mark(0, 1.25 * s, 1 - 1.25 * c, -1.9 * s, 1 + 1.9 * c)
  mark(1, G[0], 0, G[0], 1.7)
  mark(2, 0, 0, G[0], G[1])
  mark(3, 0, 1.5, G[0], 1.5)
  mark(4, 0, 0, foot3[0], foot3[1])
  mark(5, 0, 0, 0, 1.7)
  lines.change.emit()
  const at = (k, x, y) => { points.data.x[k] = x; points.data.y[k] = y }
  at(0, 0, 1); at(1, ...G); at(2, 0, 0); at(3, -1.9 * s, 1 + 1.9 * c)
  points.data.name[4] = push[i] >= 0 ? "F⊙" : "F⊗"
  at(4, 0, -0.02)
  points.change.emit()
}
motion.properties.data.change.connect(draw)
window.addEventListener("tippe:clock:CLOCK", ({detail: {t}}) => { now = t; draw() })
draw()
""".replace("CLOCK", CLOCK)


def kept():
    """What of a Learn a link keeps."""
    return {"step": Field("step", OneOf(**{name: name for name in lesson.NAMES}), undoable=False),
            "section": Field("learn", OneOf(**{name: name for name in SECTIONS}), undoable=False),
            "room": Field(SECRET, Key, undoable=False)}  # fmt: skip


def paragraphs(text):
    return "".join(f"<p style='margin: 0 0 8px'>{part}</p>" for part in text.split("\n"))


def equation(tex):
    """The paper's equation, typeset by KaTeX; on a narrow screen it scrolls by itself."""
    return pn.pane.LaTeX(
        f"$\\displaystyle {tex}$", sizing_mode="stretch_width", margin=(2, 0, 8, 0),
        # of this size the longest fits at 1400 px, large
        styles={"font-size": px(14.4), "overflow-x": "auto", "overflow-y": "hidden", "padding": "4px 0 6px"},
        stylesheets=[MATHS],
    )  # fmt: skip


def show_motion(view, scene, motion, stem):
    """A Trajectory of its own in place of the scene's; stem: whether that is of the body itself, or of a ball."""
    if view.shown is motion:
        return
    view.shown = motion
    nodal, across, axis, towards = axes(motion.theta, motion.phi)
    w1, w2, w3 = (component[:, None] for component in motion.omega.T)
    F_x, F_y, F_z = (component[:, None] for component in motion.force.T)
    top = scene.top
    view.param.update(
        mu_s=lesson_sliding.FRICTION.mu,
        profile=pack(scene.profile if stem else outline(top)),
        seconds=scene.scales.time,
        speed=SLIDING_SPEED,
        frames=pack_frames(
            motion.t,
            motion.quaternion,
            motion.contact,
            motion.com,
            F_x * nodal + F_y * across + F_z * (0, 0, 1),
            w1 * nodal + w2 * towards + w3 * axis,
            top.I1 * (w1 * nodal + w2 * towards) + top.I3 * w3 * axis,
            [CODES[regime] for regime in motion.regime],
        ),
    )


class StepFigure:
    """A lesson_parts.Picture: curves and points over two axes."""

    def __init__(self):
        self.figure = fig = plain(x_range=Range1d(0, 1), y_range=Range1d(0, 1), name="lesson")
        fig.update(sizing_mode="stretch_width", height=280)
        self.curves = ColumnDataSource({"xs": [], "ys": [], "colour": [], "dash": []})
        self.points = ColumnDataSource({"x": [], "y": [], "name": []})
        fig.multi_line("xs", "ys", source=self.curves, line_color="colour", line_dash="dash", line_width=2)
        fig.scatter("x", "y", source=self.points, size=9, fill_color="white", line_color=INK, line_width=2)
        fig.text("x", "y", "name", source=self.points, x_offset=-8, y_offset=-8, text_align="right", text_color=INK,
                 text_font_size="13px")  # fmt: skip
        self.key, self.x, self.y = words(""), words(""), words("")

    @property
    def view(self):
        return [self.key, self.y, pn.pane.Bokeh(self.figure, sizing_mode="stretch_width", margin=0), self.x]

    def show(self, picture):
        self.curves.data = {
            "xs": [curve.x for curve in picture.curves], "ys": [curve.y for curve in picture.curves],
            "colour": [curve.colour for curve in picture.curves], "dash": [curve.dash for curve in picture.curves],
        }  # fmt: skip
        self.points.data = {
            "x": [point.x for point in picture.points], "y": [point.y for point in picture.points],
            "name": [say(f"learn.points.{point.key}") for point in picture.points],
        }  # fmt: skip
        for axis, values in (("x_range", [part.x for part in (*picture.curves, *picture.points)]),
                             ("y_range", [part.y for part in (*picture.curves, *picture.points)])):  # fmt: skip
            values = np.concatenate([np.atleast_1d(value) for value in values])
            low, high = np.nanmin(values), np.nanmax(values)
            pad = MARGIN * (high - low) or 0.05 * (1 + abs(low))
            getattr(self.figure, axis).update(start=low - pad, end=high + pad)
        known = {curve.key: curve for curve in picture.curves if curve.key != "zero"}
        key = "".join(swatch(c.colour, say(f"learn.curves.{c.key}"), c.dash) for c in known.values())
        self.key.object = f'<div class="key">{key}</div>'
        self.x.object = f'<div class="axis">{say(f"learn.axes.{picture.x}")}</div>'
        self.y.object = f"<div>{say(f'learn.axes.{picture.y}')}</div>"


class SectionFigure:
    """The paper's Fig. 4, live: the section through the contact point and the axis, with the two lever arms of F_x."""

    def __init__(self):
        self.figure = fig = plain(x_range=Range1d(-2.1, 2.1), y_range=Range1d(-0.45, 3.1), name="section",
                                  match_aspect=True)  # fmt: skip
        fig.update(sizing_mode="stretch_width", height=330)
        fig.grid.visible = fig.axis.visible = False
        self.motion = ColumnDataSource({"t": [0.0, 1.0], "theta": [0.5, 0.5], "push": [1.0, 1.0], "a": [0.07, 0.07]})
        self.body = ColumnDataSource({name: np.zeros(1) for name in ("across", "along", "x", "y")})
        five, six = [0.0] * 5, [0.0] * 6
        self.lines = ColumnDataSource(
            {"x0": six, "y0": list(six), "x1": list(six), "y1": list(six),
             "colour": ["#8a96a3", "#8a96a3", GREY, COLOURS["friction"], COLOURS["theta"], "#8a96a3"],
             "dash": ["dashed", "dotted", "solid", "solid", "solid", "dotted"],
             "width": [1.5, 1.5, 2, 8, 5, 1.5]})  # fmt: skip
        self.points = ColumnDataSource(
            {"x": five, "y": list(five), "name": ["O", "G", "C", "3", "F⊙"], "dx": [10, 10, -18, 8, 8],
             "dy": [-4, 4, 16, 0, 20], "size": [5, 8, 7, 0, 0]})  # fmt: skip
        fig.patch("x", "y", source=self.body, fill_color="#d9b48a", fill_alpha=0.35, line_color="#8a6a42")
        fig.segment(x0=[-2.1], x1=[2.1], y0=[0], y1=[0], line_color=INK, line_width=1.5)
        fig.segment("x0", "y0", "x1", "y1", source=self.lines, line_color="colour", line_dash="dash",
                    line_width="width")  # fmt: skip
        fig.scatter("x", "y", source=self.points, size="size", color=INK)
        fig.text("x", "y", "name", source=self.points, x_offset="dx", y_offset="dy", text_color=INK,
                 text_font_size="15px", text_font_style="italic")  # fmt: skip
        turn = CustomJS(args={"motion": self.motion, "body": self.body, "lines": self.lines, "points": self.points},
                        code=TURN_SECTION)  # fmt: skip
        fig.js_on_change("inner_width", turn)
        self.words = words("")

    @property
    def view(self):
        return [self.words, pn.pane.Bokeh(self.figure, sizing_mode="stretch_width", margin=0)]

    def show(self, scene):
        radius, height = scene.profile.T
        across, along = np.concatenate([radius, -radius[::-1]]), np.concatenate([height, height[::-1]])
        self.body.data = {"across": across, "along": along, "x": across.copy(), "y": along + 1}
        motion = scene.trajectory
        self.motion.data = {
            "t": motion.t, "theta": motion.theta, "push": motion.force[:, 0], "a": np.full(len(motion.t), scene.top.a),
        }  # fmt: skip
        arms = swatch(COLOURS["friction"], say("learn.arms.z")) + swatch(COLOURS["theta"], say("learn.arms.three"))
        self.words.object = f'<div class="key">{arms}</div>'


class Learn(param.Parameterized):
    """The ten steps, and beside them the derivation, the teacher's page and the history.

    explorer, roll: where the runs are set up, by the same requests as the sliders'; runs: the page's Runs. What a link
    keeps: step, section, and of a vote that is open the teacher's key, room.
    """

    step = param.Selector(default=lesson.NAMES[0], objects=list(lesson.NAMES))
    section = param.Selector(default=SECTIONS[0], objects=list(SECTIONS))
    room = param.String(default="")

    def __init__(self, explorer, roll, runs=None):
        super().__init__()
        self._explorer, self._roll, self._runs, self._judging = explorer, roll, runs or Runs(), None
        self.guesses = {}
        titles = {f"{i}. {say(f'learn.{name}.title')}": name for i, name in enumerate(lesson.NAMES, 1)}
        self.select = pmui.Select.from_param(self.param.step, label=say("learn.page.step"), options=titles,
                                             size="small", sizing_mode="stretch_width", min_width=250,
                                             margin=(4, 0))  # fmt: skip
        self.sections = pmui.RadioButtonGroup.from_param(
            self.param.section, label="", options={say(f"learn.sections.{name}"): name for name in SECTIONS},
            size="small", sx=PLAIN, margin=(10, 12, 0, 12), styles={"max-width": "calc(100% - 24px)"},
        )  # fmt: skip
        self.back, self.next = (
            pmui.Button(label=say(f"learn.page.{name}"), size="small", variant="outlined", sx=PLAIN,
                        margin=(4, 0, 0, 8))
            for name in ("back", "next")
        )  # fmt: skip
        self.question, self.verdict, self.explanation, self.sources = (words("") for _ in range(4))
        self.prediction = pn.Column(sizing_mode="stretch_width", margin=(6, 0))
        self.run = pmui.Button(label=say("learn.page.predict"), size="small", variant="contained", sx=PLAIN,
                               margin=(2, 0, 8, 0))  # fmt: skip
        self.equations = pn.Column(sizing_mode="stretch_width", margin=0)
        self.figure, self.fig4 = StepFigure(), SectionFigure()
        self.top = Top3D(clock=CLOCK, height=360, sizing_mode="stretch_width")
        self.picture_card = card(say("learn.page.picture"), *self.figure.view, height="max-content")
        self.section_card = card(say("learn.page.section"), *self.fig4.view, height="max-content")
        self.derivation = Derivation(CLOCK)
        self.param.watch(lambda event: self._open(), "step")
        self.param.watch(lambda event: self._look(), "section")
        on_click(self.back, lambda event: self._go(-1))
        on_click(self.next, lambda event: self._go(1))
        on_click(self.run, lambda event: self._run())
        self.view = self._build()
        roll.followers.append(self.show_scene)
        self._open()
        self._look()

    @property
    def now(self):
        """The Step looked at."""
        return lesson.STEPS[lesson.NAMES.index(self.step)]

    def _build(self):
        head = pn.Row(self.select, pn.Row(self.back, self.next, margin=0), sizing_mode="stretch_width", margin=0,
                      styles={"flex-wrap": "wrap"})  # fmt: skip
        promise = words(f'<div class="key">{say("learn.page.promise")}</div>', margin=(8, 0, 0, 0))
        steps = card(say("learn.sections.lesson"), head, self.question, self.prediction, self.run, self.verdict,
                     self.explanation, self.equations, self.sources, promise, height="max-content")  # fmt: skip
        beside = pn.Column(
            card(say("learn.page.top"), self.top, height="max-content"), self.section_card, self.picture_card,
            sizing_mode="stretch_width", margin=0,
            styles={"gap": "12px", "position": "sticky", "top": "12px", "align-self": "start"},
        )  # fmt: skip
        intro = words("".join(f"<p style='margin: 0 0 6px'>{say(f'derivation.page.{key}')}</p>"
                              for key in ("intro", "smooth", "vectors")))  # fmt: skip
        lines = card(say("derivation.page.title"), intro, self.derivation.place, height="max-content")
        self.places = {"lesson": steps, "derivation": lines}
        # a hidden Column inside, since a grid that is told how to be laid out cannot be hidden
        self.pair = pn.Column(grid(steps, lines, beside), sizing_mode="stretch_width", margin=0)
        self.others = pn.Column(sizing_mode="stretch_width", margin=0)
        self._made = {}
        return pn.Column(self.sections, self.pair, self.others, sizing_mode="stretch_width", margin=0,
                         css_classes=["learn"])  # fmt: skip

    def _look(self):
        """Shows the section; the teacher's page and the history are made when first looked at."""
        section = self.section
        makers = {"teach": lambda: teach_view(self._explorer, self._runs, self), "history": history_view}
        if section in makers and section not in self._made:
            self._made[section] = makers[section]()
        self.pair.visible = section in self.places
        for name, place in self.places.items():
            place.visible = name == section
        self.others.objects = [self._made[section]] if section in makers else []
        self.show_scene(self._explorer.scene)

    def _go(self, by):
        place = lesson.NAMES.index(self.step) + by
        self.step = lesson.NAMES[min(max(place, 0), len(lesson.NAMES) - 1)]

    def _open(self):
        """Asks the question of this step, about the motion that it would set up for the present top."""
        step, scene = self.now, self._explorer.scene
        self._asked = scene.top
        place = lesson.NAMES.index(step.name)
        self.back.disabled, self.next.disabled = place == 0, place == len(lesson.NAMES) - 1
        try:
            plan = lesson.planned(step, scene, self._explorer.shape)
        except TopError as error:
            self.question.object = f'<div role="alert">{escape(told(error))}</div>'
            return
        asks = step.asks(plan)
        self.question.object = (
            f"<h2 style='margin: 8px 0 4px'>{say(f'learn.{step.name}.title')}</h2>"
            f"<div style='font-size: {px(15)}'>{say(f'learn.{step.name}.question', **step.question(plan))}</div>"
        )
        self.widget = prediction(step, asks, self.guesses.get(step.name))
        self.prediction.objects = [self.widget]
        full = [(listed(f"sources.{name}.short"), listed(f"sources.{name}.full")) for name in step.sources]
        self.sources.object = f"<div class='key' style='margin-top: 6px'>{say('learn.page.sources')}</div>" + "".join(
            f"<details><summary>{short}</summary>{text}</details>" for short, text in full
        )
        self.show_scene(scene)

    def _run(self):
        if self.widget.value is None:
            self.verdict.object = f'<div role="status">{say("learn.page.choose")}</div>'
            return
        self.guesses[self.step] = self.widget.value
        self._roll.pacer.request(**self.now.inputs(self._explorer.scene.top))

    def show_scene(self, scene):
        """The pictures, and once there is a prediction the verdict, by the motion that runs now."""
        if self._judging:
            self._judging.forget()
        if self.section == "derivation":
            self.picture_card.visible = self.section_card.visible = False
            self.top.speed = ROLLING_SPEED
            show_top(self.top, scene)
            self.derivation.show(scene)
            return
        if self.section != "lesson":
            return
        step = self.now
        guess = self.guesses.get(step.name)
        if guess is None and scene.top != self._asked:  # the question has the numbers of another top
            self._open()
            return
        if guess is None:
            self._show(scene, step)
        elif not step.slides:
            self._show(scene, step, *lesson.judged(step, scene, guess))
        else:
            self._show(scene, step, waits=note(say("learn.page.wait")))
            self._judging = Run(lambda run: lesson.judged(step, scene, guess), partial(self._judged, scene, step))
            self._runs.begin(self._judging, "lesson")

    def _judged(self, scene, step, result):
        self.verdict.object = alert(told(result)) if isinstance(result, TopError) else ""
        if not isinstance(result, Exception):
            self._show(scene, step, *result)
        elif not isinstance(result, TopError):
            raise result

    def _show(self, scene, step, verdict=None, answer=None, waits=""):
        """The step by this scene: asked where there is no answer yet, else answered. waits: words while it is found."""
        with pn.io.hold():
            guessed = step.name in self.guesses
            self.run.label = say("learn.page.again" if guessed else "learn.page.predict")
            self.picture_card.visible = answer is not None
            self.section_card.visible = step.name == "jellett"
            if self.section_card.visible:
                self.fig4.show(scene)
            if answer is not None and answer.motion is not None:
                show_motion(self.top, scene, answer.motion, answer.stem)
            else:
                self.top.speed = ROLLING_SPEED
                show_top(self.top, scene)
            self.equations.objects = [equation(tex) for tex in step.tex] if guessed else []
            self.verdict.object, self.explanation.object = waits, ""
            if answer is not None:
                said = say(f"learn.verdict.{verdict}")
                self.explanation.object = self._explained(step, answer)
                self.verdict.object = f"<div role='status' style='font-size: {px(15)}'><b>{said}</b></div>"
                self.figure.show(answer.picture)

    @staticmethod
    def _explained(step, answer):
        explained = paragraphs(say(f"learn.{step.name}.{answer.told}", **answer.numbers))
        if answer.doubt:
            explained = paragraphs(say(f"learn.doubt.{answer.doubt}")) + explained
        follows = f'<div class="key">{say("learn.page.follows")}</div>'
        if isinstance(answer.truth, str) and not answer.doubt:
            explained = paragraphs(f"{option(step, answer.truth)}.") + explained
        return f"<div style='font-size: {px(14)}'>{explained}</div>{follows}"
