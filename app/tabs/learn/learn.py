"""The tab Learn: the lesson, the part for theorists, and the pages beside them."""

from functools import partial

import param

from app.model.lesson import lesson
from app.model.lesson.runs import on_table
from app.model.once import ONCE
from app.model.runs import Run, Runs
from app.state import validate
from app.state.names import SECTIONS
from app.tabs.learn.lesson import FIRST, LessonView, cut, runs_of, state_of
from app.tabs.learn.lines import Derivation
from app.tabs.learn.present import Teacher
from app.tabs.learn.published import published_view
from app.tabs.learn.teach import history_view, teach_view
from app.tabs.learn.worksheet import worksheet
from app.text import say, spoken
from app.widgets.cards import Hidden, card, column, first, later, staged, words
from app.widgets.failure import unless_stopped
from app.widgets.forms import Choice, hear
from app.widgets.top3d import Top3D, show_top

ABOVE = "@media (min-width: 1000px) { :host { margin-left: 24px !important } }"  # as the cards below it
CLOCK, SPEED = "learn", 1 / 16
WISHES = ("present", "reveal", "reset")  # requests of the teacher at the big screen


class Learn(param.Parameterized):
    """The lesson, the derivation, the teacher's page and the history.

    scene: the first one, show() sets others; runs: the page's Runs; lab: shows the Lab. A link stores step, section
    and, while a vote is open, the teacher's key, room.
    """

    step = param.Selector(default=lesson.NAMES[0], objects=list(lesson.NAMES))
    section = param.Selector(default=SECTIONS[0], objects=list(SECTIONS))
    room = param.String(default="")

    def __init__(self, scene, runs=None, lab=None):
        super().__init__()
        self._scene, self._runs, self._of = scene, runs or Runs(), {}
        self._lab = lab or (lambda: None)
        self.lesson = LessonView(sizing_mode="stretch_width", margin=0, worksheet=worksheet())
        hear(self.lesson, request=self._heard)
        self.top = Top3D(clock=CLOCK, sizing_mode="stretch_both")
        self.derivation = Derivation(CLOCK)
        options = {say(f"learn.sections.{name}"): name for name in SECTIONS}
        self.sections = Choice.of(self, "section", options, margin=(10, 12, 0, 12), stylesheets=[ABOVE],
                                  styles={"max-width": "calc(100% - 24px)"})  # fmt: skip
        self.teacher = Teacher(self, lambda: self._scene, lambda room: self._tell(room=room))
        self.param.watch(lambda event: self._on_step(), "step")
        self.param.watch(lambda event: self._look(), "section")
        self.param.watch(lambda event: self.teacher.come_back(), "room")
        self.view = self._build()
        self._begin()
        self._tell()
        self._look()

    def _build(self):
        # in a column, because a grid with a layout of its own cannot be hidden
        self.pair = Hidden(lambda: [self._pair()])
        self.others = column()
        self._made = {}
        return column(self.sections, self.lesson, self.pair, self.others, css_classes=["learn"])

    def _pair(self):
        intro = words("".join(f"<p style='margin: 0 0 6px'>{say(f'derivation.page.{key}')}</p>"
                              for key in ("intro", "smooth", "vectors")))  # fmt: skip
        lines = later(card(say("derivation.page.title"), intro, self.derivation.place), 1)
        return staged([first(card(say("learn.page.top"), self.top))], [lines])

    # ---- the lesson ----

    def _begin(self):
        """Shows the first step, which ships, at once, and the others when they have been computed."""
        first = lesson.STEPS[0]
        if not self._runs.beside:
            self._take(self._found(self._scene, lesson.STEPS))
            return
        self.lesson.param.update(steps=[state_of(first, self._scene)], runs={FIRST: cut(on_table(FIRST), first.end)})
        self._find(lesson.STEPS)

    @staticmethod
    def _found(scene, steps):
        """(words, runs) of these steps for this scene."""
        return {step.name: state_of(step, scene) for step in steps}, runs_of(steps, scene)

    def _find(self, steps):
        scene = self._scene
        request = (
            self._found,
            spoken(),
            tuple(step.name for step in steps),
            scene.top,
            scene.scales,
            scene.inputs["shape"],
        )
        work = partial(self._found, scene, steps)
        run = Run(lambda run: ONCE.find(run.wait, request, work), unless_stopped(self._take))
        self._runs.begin(run, "lesson")

    def _take(self, found):
        words_of, runs = found
        self._of |= words_of
        six = {name: runs[name] for step in lesson.SIX for name in step.tops if name in runs}
        changes = {"runs": six} if six else {}
        others = {name: run for name, run in runs.items() if name not in six}
        self.lesson.param.update(
            steps=[self._of[name] for name in lesson.NAMES], others=self.lesson.others | others, **changes
        )

    def _heard(self, event):
        """A request from the browser."""
        _, name, value = validate.parts(event.new, validate.number, validate.text, validate.text)
        if name == "step" and value in lesson.NAMES:
            self.step = value
        elif name == "section" and value in SECTIONS:
            self.section = value
        elif name == "lab":
            self._lab()
        elif name in WISHES:
            getattr(self.teacher, name)()
        else:
            raise validate.InvalidMessage(name)

    # ---- the sections ----

    def _look(self):
        """Shows the section; those beside the lesson and the derivation are created when they are first shown."""
        section = self.section
        makers = {"published": lambda: published_view(self._runs), "history": history_view,
                  "teach": lambda: teach_view(self._present, self.teacher.close)}  # fmt: skip
        if section in makers and section not in self._made:
            self._made[section] = makers[section]()
        self.sections.visible = section != "lesson"
        self.lesson.visible = section == "lesson"
        self.pair.visible = section == "derivation"
        self.others.objects = [self._made[section]] if section in makers else []
        self.show(self._scene)

    def _present(self):
        """Goes from the teacher's page to the big screen."""
        self.section = "lesson"
        self._tell(presents=self.lesson.state.get("presents", 0) + 1)

    def _on_step(self):
        self._tell()
        self.teacher.follow()

    def _tell(self, **more):
        self.lesson.state = self.lesson.state | {"step": self.step} | more

    def show(self, scene):
        """Recomputes what depends on the page's own top, if that has changed."""
        new = scene.top != self._scene.top or scene.inputs["shape"] != self._scene.inputs["shape"]
        self._scene = scene
        if new:
            of_it = [step for step in lesson.STEPS if step.inputs or "yours" in step.tops]
            self._find(of_it if self._of else lesson.STEPS)
        if self.section == "derivation":
            self.top.speed = SPEED
            show_top(self.top, scene)
            self.derivation.show(scene)
