"""What the pages of the teacher and of the students share: a question, and access to the votes."""

from dataclasses import asdict

import panel as pn

from app.model.explorer import solved
from app.model.lesson import lesson
from app.model.runs import to_session
from app.model.votes.ballots import Away
from app.model.votes.classroom import Refused
from app.model.votes.desk import DESK
from app.state.url_state import EXPLORER, inputs_of
from app.text import say
from app.widgets.hold import held

MOST_REQUESTS = 4


def page_address():
    """The address of this page, without a query."""
    location = pn.state.location
    return f"{location.protocol}//{location.hostname}{f':{location.port}' if location.port else ''}{location.pathname}"


def question_of(step, scene):
    """A question to a class about this step for the scene's top, as data; each page adds its own words."""
    top = scene.top
    given = {"shape": scene.inputs["shape"], "a": top.a, "I1": top.I1, "I3": top.I3}
    return {"step": step.name, "asks": asdict(step.asks),
            "top": {EXPLORER[name].key: EXPLORER[name].codec.text(value) for name, value in given.items()}}  # fmt: skip


def scene_of(room):
    """The Scene of the top of a Room's question; None if there is no room, or if it is of another version of this
    program."""
    return solved(**inputs_of(room.top)[0]) if room is not None and room.step in lesson.OF_NAME else None


class Counter:
    """A page's access to the DESK: one request at a time, with the results on its session's thread."""

    def __init__(self):
        document = pn.state.curdoc
        self._post = to_session(document) if document else lambda function: function()
        self._requests, self._end = [], lambda: None
        request = getattr(document and document.session_context, "request", None)
        self.address = getattr(request, "remote_ip", "")
        if document:
            document.on_session_destroyed(lambda context: self.leave())

    def ask(self, work, done):
        """Calls done() with the result of work(Rooms), or with a Refused or an Away; after earlier requests, of which
        there are a few at most."""
        if len(self._requests) < MOST_REQUESTS:
            self._requests.append((work, done))
            if len(self._requests) == 1:
                self._begin()

    def _begin(self):
        work, done = self._requests[0]

        def answered(result):
            del self._requests[0]
            if self._requests:
                self._begin()
            if isinstance(result, Exception) and not isinstance(result, (Refused, Away)):
                raise result
            with held():
                done(result)

        DESK.ask(work, lambda result: self._post(lambda: answered(result)))

    def watch(self, code, done, votes=True):
        """Calls done() with the present state of the room and with each later one, until leave()."""
        self.leave()

        def news(room):
            with held():
                if self._end is end:  # else it is late news of another room
                    done(room)

        end = DESK.watch(code, lambda room: self._post(lambda: news(room)), votes)
        self._end = end

    def leave(self):
        end, self._end = self._end, lambda: None
        end()


def refusal(who, error):
    """The sentence for a Refused or an Away. who: "vote" for the teacher, or "student"."""
    return say(f"teach.{who}.{error if isinstance(error, Refused) else 'away'}")
