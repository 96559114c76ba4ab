"""What the lesson, the teacher's page and a student's share: a question, its prediction, and the way to the votes."""

import string
from dataclasses import asdict

import panel as pn
import panel_material_ui as pmui

from app.borrowed import may_be_none
from app.model import lesson, lesson_parts
from app.model.ballots import Away
from app.model.classroom import DESK, Refused
from app.model.runs import to_session
from app.state.keep import EXPLORER, explorer_of
from app.text import listed, say


def option(step, key):
    """The words of an option."""
    return listed(f"learn.{step.name}.options").get(key) or say("learn.view.unsure_option")


def prediction(step, asks, value=None):
    """The widget for what a step asks, a Choice or a Guess."""
    label = say("learn.view.yours")
    if isinstance(asks, lesson_parts.Choice):
        options = {option(step, key): key for key in asks.options}
        group = may_be_none(pmui.RadioBoxGroup(label=label, options=options, inline=False, margin=(4, 0)))
        group.value = value
        return group
    start = min(max(value, asks.low), asks.high) if value is not None else (asks.low + asks.high) / 2
    return pmui.FloatSlider(label=f"{label}, {asks.unit}", start=asks.low, end=asks.high,
                            step=asks.step, value=start, sizing_mode="stretch_width", margin=(4, 12),
                            size="small")  # fmt: skip


def page_address():
    """Of this page, without a query."""
    location = pn.state.location
    return f"{location.protocol}//{location.hostname}{f':{location.port}' if location.port else ''}{location.pathname}"


def asked_of(step, scene):
    """A question to a class about this step on the scene's top, as data; its words come with each page."""
    top = scene.top
    planned = lesson.planned(step, scene)
    numbers = step.answer(planned).numbers
    named = {name for _, name, _, _ in string.Formatter().parse(listed(f"learn.{step.name}.question")) if name}
    given = {"shape": scene.inputs["shape"], "a": top.a, "I1": top.I1, "I3": top.I3, "mu_s": scene.mu_s}
    return {"step": step.name, "numbers": {name: float(numbers[name]) for name in named},
            "asks": asdict(step.asks),
            "top": {EXPLORER[name].key: EXPLORER[name].codec.text(value) for name, value in given.items()}}  # fmt: skip


def question_of(room):
    """(Step, Choice or Guess) of a Room; (None, None) where there is no room, or it is of another version of this."""
    if room is None or room.step not in lesson.NAMES:
        return None, None
    kind = lesson_parts.Choice if "options" in room.asks else lesson_parts.Guess
    return lesson.STEPS[lesson.NAMES.index(room.step)], kind(**room.asks)


def truth_of(step, top):
    """The computation's answer, of the top that a room is about."""
    explorer, _ = explorer_of(top)
    return step.answer(lesson.planned(step, explorer.scene)).truth


class Counter:
    """Through which a page asks the DESK: one thing at a time, and told what comes of it on its session's thread."""

    def __init__(self):
        document = pn.state.curdoc
        self._post = to_session(document) if document else lambda function: function()
        self._busy, self._end = False, lambda: None
        request = getattr(document and document.session_context, "request", None)
        self.address = getattr(request, "remote_ip", "")
        if document:
            document.on_session_destroyed(lambda context: self.leave())

    def ask(self, work, done):
        """Has done(result of work(Rooms)) called, or of a Refused or an Away; not while something is asked."""
        if self._busy:
            return
        self._busy = True

        def answered(result):
            self._busy = False
            if isinstance(result, Exception) and not isinstance(result, (Refused, Away)):
                raise result
            with pn.io.hold():
                done(result)

        DESK.ask(work, lambda result: self._post(lambda: answered(result)))

    def watch(self, code, done, votes=True):
        """Has done called with what there is now and later, until leave()."""
        self.leave()

        def news(room):
            with pn.io.hold():
                if self._end is end:  # else it is another room's, come late
                    done(room)

        end = DESK.watch(code, lambda room: self._post(lambda: news(room)), votes)
        self._end = end

    def leave(self):
        end, self._end = self._end, lambda: None
        end()


def refusal(who, error):
    """The sentence for a Refused or an Away. who: "vote", the teacher, or "student"."""
    key = str(error) if isinstance(error, Refused) else "away"
    return f"<div role='alert'>{say(f'teach.{who}.{key}')}</div>"
