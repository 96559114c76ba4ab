"""What a student's link opens: the question on the big screen, one prediction, and the answer once it is shown."""

import panel as pn
import param

from app.bundle import Bundled
from app.model.lesson import lesson
from app.model.runs import Run, Runs, connected_to, to_session
from app.model.votes.ballots import Away
from app.model.votes.classroom import MARK, Refused
from app.state import validate
from app.state.names import link
from app.tabs.learn.lesson import LessonView, runs_of, state_of
from app.tabs.learn.poll import Counter, refusal, scene_of
from app.text import say
from app.widgets.cards import column
from app.widgets.connection import Connection
from app.widgets.failure import full, unless_stopped, waits
from app.widgets.forms import hear


class Phone(Bundled):
    """Recognizes this phone after a reload, by a number that it stores."""

    mark = param.String(default="", regex=rf"({MARK.pattern})?", doc="the number; the browser writes it")


class Ballot:
    """A phone in a class: it follows the teacher from question to question."""

    def __init__(self, code, runs=None):
        self._code, self._counter, self._runs = code, Counter(), runs or Runs()
        self._room, self._mine, self._mark, self._made = None, None, "", ()
        self.phone = Phone(width=0, height=0, margin=0)
        self.lesson = LessonView(sizing_mode="stretch_width", margin=0, state={"role": "phone", "wording": ""})
        # changes that are held back and sent together before the page has loaded would be lost
        self.phone.param.watch(self._known, "mark")
        hear(self.lesson, request=self._heard)
        self._tell(say("teach.vote.wait"))

    @property
    def view(self):
        lost = Connection(words=say("main.lost"), slow=say("main.slow"), width=0, height=0, margin=0)
        return column(self.lesson, self.phone, lost, max_width=640, css_classes=["learn"])

    def _known(self, event):
        """Uses only the first identifier that the phone sends: a page that sends another one later would vote as
        somebody else."""
        if not self._mark:
            self._mark = event.new
            pn.state.onload(self._come)

    def _come(self, again=True):
        """Asks for the room, and for this phone's vote there."""
        code, mark, address = self._code, self._mark, self._counter.address

        def done(result):
            room, voted = (None, None) if isinstance(result, Exception) else result
            if scene_of(room) is None:
                away = isinstance(result, Away)
                self._tell(refusal("student", result if away else Refused("gone")), again=away)
                return
            self._mine = voted
            self._take(room)
            if again:
                self._counter.watch(code, self._news, votes=False)

        self._counter.ask(lambda rooms: rooms.ballot(code, mark, address), done)

    def _news(self, room):
        if room is None or isinstance(room, Refused):
            self._room = None
            self._tell(refusal("student", room or Refused("closed")))
        elif self._room is None or room.step != self._room.step or (room.phones == 0 and self._room.phones):
            self._room = room
            self._come(again=False)  # for its vote on that question; in a new class it joins again
        else:
            self._take(room)

    def _take(self, room):
        self._room = room
        self._tell("")
        if self._made != (room.step, room.shown):
            self._made = room.step, room.shown
            step, scene, shown = lesson.OF_NAME[room.step], scene_of(room), room.shown

            def work(run):
                return state_of(step, scene, hidden=not shown), runs_of([step], scene, hidden=not shown)

            self._runs.begin(Run(work, unless_stopped(self._found)), "lesson")

    def _found(self, found):
        words, runs = found
        self.lesson.param.update(steps=[words], runs=runs, state=self.lesson.state | {"step": words["name"]})

    def _tell(self, sentence, again=False):
        room = self._room
        shown = {} if room is None else {
            "code": room.code, "place": lesson.NAMES.index(room.step) + 1, "question": room.step, "shown": room.shown,
            "voted": len(room.votes), "phones": max(room.phones, len(room.votes)), "mine": self._mine,
        }  # fmt: skip
        self.lesson.state = {"role": "phone", "step": self.lesson.state.get("step", ""), "room": shown,
                             "wording": sentence, "again": again, "alone": link(tab="learn")}  # fmt: skip

    def _heard(self, event):
        """A request from the browser."""
        _, name, value = validate.parts(event.new, validate.number, validate.text, validate.anything)
        if name == "vote" and self._room is not None:
            self._vote(value)
        elif name == "again":
            self._come()

    def _vote(self, value):
        code, mark, address, step = self._code, self._mark, self._counter.address, self._room.step

        def done(result):
            if isinstance(result, Exception):
                self._tell(refusal("student", result))
            else:
                self._mine = value
                self._tell("")

        self._counter.ask(lambda rooms: rooms.vote(code, mark, address, value, step), done)


def student_page(code):
    """The page that a student's link opens."""
    document = pn.state.curdoc
    runs = Runs(to_session(document), connected_to(document), waits, full)
    document.on_session_destroyed(lambda context: runs.leave())
    return Ballot(code, runs).view
