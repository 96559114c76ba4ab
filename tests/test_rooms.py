"""A room comes after its view was created: what changes meanwhile leaves it whole."""

import asyncio
import gc
import weakref
from contextvars import ContextVar, copy_context

import panel as pn
import pytest
from bokeh.document import Document
from doubles import keeping
from panel.io.state import set_curdoc
from wire import run

from app.model.runs import Runs
from app.page.page import page
from app.page.session import Session
from app.widgets.failure import after_long
from app.widgets.form import Form
from app.widgets.rooms import AWAY, Place

MANY = 30  # parts


@pytest.mark.parametrize("level", ["explore", "research"])
def test_a_lab_whose_level_changes_while_it_comes_is_whole(monkeypatch, level):
    made = {}
    monkeypatch.setattr(Session, "__init__", keeping(made, Session.__init__))
    monkeypatch.setattr("app.page.session.Runs", lambda *session: Runs())
    with set_curdoc(Document()):
        pn.state.location.search = f"?v=4&tab=learn&level={level}"
        page()
        session = made[Session]
        view = session.makers["lab"]()
        session.level = "explore" if level == "research" else "research"
        names = [type(part).__name__ for part in view]
        assert names[0] == "LabView" and len(names) == 2


def test_a_room_that_nobody_looks_at_gives_its_parts_back_and_comes_again_as_it_was(monkeypatch):
    made, later = [], []
    monkeypatch.setattr("app.widgets.rooms.after_long", lambda *given: later.append(given))

    def make():
        made.append(Form(*(pn.pane.HTML(str(i)) for i in range(MANY))))
        return made[-1]

    document = Document()
    with set_curdoc(document):
        place = Place("maps", make, lambda act: act())
        pn.Column(place.column).server_doc(document)
        few = len(document.models)
        place.fill()
        many = len(document.models)
        made[0].others[7].object = "new"
        for _ in range(2):  # between the two the page looks again
            place.left()
        (seconds, _, early), (_, _, late) = later
        place._give_back(early)
        assert len(document.models) == many and seconds == AWAY
        place._give_back(late)
        assert len(document.models) == few
        place.ask()
        assert len(document.models) == many > few + MANY and len(made) == 1 and made[0].others[7].object == "new"


def test_a_room_with_a_state_that_only_the_browser_has_stays(monkeypatch):
    """Such as the lesson with its guesses."""
    later = []
    monkeypatch.setattr("app.widgets.rooms.after_long", lambda *given: later.append(given))
    document = Document()
    with set_curdoc(document):
        place = Place("learn", lambda: pn.Column(pn.pane.HTML("a guess")), lambda act: act())
        pn.Column(place.column).server_doc(document)
        place.fill()
        many = len(document.models)
        place.left()
        place._give_back(later[0][-1])
        assert len(document.models) == many


class Room:
    """Of a page, whose timers have it in their context."""

    def __init__(self):
        self.called = []

    def call(self, *given):
        self.called.append(given)


def test_a_timer_of_ten_minutes_keeps_no_page():
    """But calls one that is still there."""

    async def later():
        stays, goes, page = Room(), Room(), ContextVar("page")
        for room in (stays, goes):
            context = copy_context()
            context.run(page.set, room)
            context.run(after_long, 0.01, room.call, 7)
        gone = weakref.ref(goes)
        del goes, room, context
        gc.collect()
        assert gone() is None
        while not stays.called:
            await asyncio.sleep(0.01)
        assert stays.called == [(7,)]

    run(later())
