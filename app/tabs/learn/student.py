"""What a student's link opens: one question of a class's vote, one prediction."""

import panel as pn
import panel_material_ui as pmui
import param

from app.bundle import Bundled
from app.model.ballots import Away
from app.model.classroom import MARK, Refused
from app.tabs.learn.poll import Counter, prediction, question_of, refusal
from app.text import say
from app.widgets.cards import PLAIN, note, on_click, px, words
from app.widgets.connection import Connection


class Phone(Bundled):
    """Knows this phone again after a reload, by a number that it keeps."""

    mark = param.String(default="", regex=rf"({MARK.pattern})?", doc="the number; the browser writes it")


class Ballot:
    """What a student's link opens: one question, one prediction."""

    def __init__(self, code):
        self._code, self._counter = code, Counter()
        self.phone = Phone(width=0, height=0, margin=0)
        self.question, self.said, self.widget = words(""), words(""), None
        self.place = pn.Column(sizing_mode="stretch_width", margin=0)
        self.send, self.again = (
            pmui.Button(label=say(f"teach.{name}"), variant="contained", sx=PLAIN, visible=False)
            for name in ("student.send", "vote.again")
        )
        on_click(self.send, lambda event: self.widget and self._vote())
        on_click(self.again, lambda event: self._come())
        # what is held and sent together before the page says that it is there is lost
        self._mark = ""
        self.phone.param.watch(self._known, "mark")
        self._ask_for("", note(say("teach.vote.wait")))

    @property
    def view(self):
        lost = Connection(words=say("main.lost"), width=0, height=0, margin=0)
        return pn.Column(self.question, self.place, self.send, self.said, self.again, self.phone, lost,
                         sizing_mode="stretch_width", max_width=640, margin=16, css_classes=["learn"])  # fmt: skip

    def _ask_for(self, asked, said):
        self.question.object = f"<h2>{say('teach.student.title')}</h2><div style='font-size: {px(16)}'>{asked}</div>"
        self.said.object = said

    def _known(self, event):
        """By what the phone says first: a page that says something else later would vote as another."""
        if not self._mark:
            self._mark = event.new
            pn.state.onload(self._come)

    def _come(self):
        """Asks for the room, and for what this phone has voted there."""
        code, mark = self._code, self._mark

        def done(result):
            self.again.visible = isinstance(result, Away)
            room, voted = (None, None) if isinstance(result, Exception) else result
            step, asks = question_of(room)
            if step is None:
                self._ask_for("", refusal("student", result if self.again.visible else Refused("gone")))
                return
            self.widget = prediction(step, asks, voted)
            self.place.objects, self.send.visible = [self.widget], True
            self._ask_for(say(f"learn.{step.name}.question", **room.numbers), "")
            if voted is not None:
                self._status("sent")
            self._counter.watch(code, self._closed, votes=False)

        self._counter.ask(lambda rooms: rooms.ballot(code, mark), done)

    def _closed(self, room):
        if room is None:
            self._status("closed")

    def _status(self, key):
        self.said.object = f"<div role='status'>{say(f'teach.student.{key}')}</div>"

    def _vote(self):
        value = self.widget.value
        if value is None:
            self._status("waiting")
            return
        code, mark, address = self._code, self._mark, self._counter.address

        def done(result):
            if isinstance(result, Exception):
                self.said.object = refusal("student", result)
            else:
                self._status("sent")

        self.said.object = note(say("teach.vote.wait"))
        self._counter.ask(lambda rooms: rooms.vote(code, mark, address, value), done)


def student_page(code):
    return Ballot(code).view
