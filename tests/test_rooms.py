"""A room comes after its view was created: what changes meanwhile leaves it whole."""

import panel as pn
import pytest
from bokeh.document import Document
from doubles import keeping
from panel.io.state import set_curdoc

from app.model.runs import Runs
from app.page.page import page
from app.page.session import Session
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
    monkeypatch.setattr("app.widgets.rooms.after", lambda seconds, act: later.append((seconds, act)))

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
        (seconds, early), (_, late) = later
        early()
        assert len(document.models) == many and seconds == AWAY
        late()
        assert len(document.models) == few
        place.ask()
        assert len(document.models) == many > few + MANY and len(made) == 1 and made[0].others[7].object == "new"


def test_a_room_with_a_state_that_only_the_browser_has_stays(monkeypatch):
    """Such as the lesson with its guesses."""
    later = []
    monkeypatch.setattr("app.widgets.rooms.after", lambda seconds, act: later.append(act))
    document = Document()
    with set_curdoc(document):
        place = Place("learn", lambda: pn.Column(pn.pane.HTML("a guess")), lambda act: act())
        pn.Column(place.column).server_doc(document)
        place.fill()
        many = len(document.models)
        place.left()
        later[0]()
        assert len(document.models) == many
