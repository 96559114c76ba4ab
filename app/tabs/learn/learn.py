"""The tab "Learn": a question, a prediction, a run, an explanation with this run's numbers."""

from functools import partial
from html import escape

import panel as pn
import panel_material_ui as pmui
import param

from app.bundle import pack
from app.model import lesson, lesson_sliding
from app.model.bodies import outline
from app.model.frames import in_space
from app.model.regimes import OF_CORE
from app.model.runs import Run, Runs
from app.state.names import SECTIONS
from app.tabs.learn.figures import CLOCK, SectionFigure, StepFigure
from app.tabs.learn.lines import Derivation
from app.tabs.learn.poll import option, prediction
from app.tabs.learn.teach import history_view, teach_view
from app.text import listed, say, told
from app.widgets.cards import PLAIN, alert, card, grid, note, on_click, px, words
from app.widgets.top3d import Top3D, pack_frames, show_top
from tippe_core import TopError

ROLLING_SPEED, SLIDING_SPEED = 1 / 16, 1 / 4
# MathML, which is what KaTeX leaves to the browser here, wants a font that has tall brackets.
MATHS = "math { font-family: 'STIX Two Math', 'Cambria Math', 'Latin Modern Math', 'DejaVu Math TeX Gyre', math }"


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
    codes = [OF_CORE[regime] for regime in motion.regime]
    view.param.update(
        mu_s=lesson_sliding.FRICTION.mu,
        profile=pack(scene.profile if stem else outline(scene.top)),
        seconds=scene.scales.time,
        speed=SLIDING_SPEED,
        frames=pack_frames(motion.t, motion.quaternion, motion.contact, motion.com, *in_space(motion), codes),
    )


class Learn(param.Parameterized):
    """The ten steps, and beside them the derivation, the teacher's page and the history.

    scene: the first, show() is for others; ask: takes inputs of the Explorer; runs: the page's Runs. What a link keeps:
    step, section, and of a vote that is open the teacher's key, room.
    """

    step = param.Selector(default=lesson.NAMES[0], objects=list(lesson.NAMES))
    section = param.Selector(default=SECTIONS[0], objects=list(SECTIONS))
    room = param.String(default="")

    def __init__(self, scene, ask, runs=None):
        super().__init__()
        self._scene, self._ask, self._runs, self._judging = scene, ask, runs or Runs(), None
        self.guesses = {}
        self._make_head()
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
        on_click(self.run, lambda event: self._run())
        self.view = self._build()
        self._open()
        self._look()

    def _make_head(self):
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
        on_click(self.back, lambda event: self._go(-1))
        on_click(self.next, lambda event: self._go(1))

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
        makers = {"teach": lambda: teach_view(lambda: self._scene, self._runs, self), "history": history_view}
        if section in makers and section not in self._made:
            self._made[section] = makers[section]()
        self.pair.visible = section in self.places
        for name, place in self.places.items():
            place.visible = name == section
        self.others.objects = [self._made[section]] if section in makers else []
        self.show(self._scene)

    def _go(self, by):
        place = lesson.NAMES.index(self.step) + by
        self.step = lesson.NAMES[min(max(place, 0), len(lesson.NAMES) - 1)]

    def _open(self):
        """Asks the question of this step, about the motion that it would set up for the present top."""
        step, scene = self.now, self._scene
        self._asked = scene.top
        place = lesson.NAMES.index(step.name)
        self.back.disabled, self.next.disabled = place == 0, place == len(lesson.NAMES) - 1
        try:
            plan = lesson.planned(step, scene)
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
        self.show(scene)

    def _run(self):
        if self.widget.value is None:
            self.verdict.object = f'<div role="status">{say("learn.page.choose")}</div>'
            return
        self.guesses[self.step] = self.widget.value
        self._ask(**self.now.inputs(self._scene.top))

    def show(self, scene):
        """The pictures, and once there is a prediction the verdict, by the motion that runs now."""
        self._scene = scene
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
