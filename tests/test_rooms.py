"""A room comes part by part: what changes meanwhile leaves it whole."""

import panel as pn
import pytest
from bokeh.document import Document
from doubles import keeping
from panel.io.state import set_curdoc

from app.model.runs import Runs
from app.page.page import page
from app.page.session import Session
from app.widgets.rooms import taken_apart


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
        puts = taken_apart(view, 1)
        other = "explore" if level == "research" else "research"
        session.level = other
        for put in puts:
            put()
        names = [type(part).__name__ for part in view]
        assert names[0] == "LabView" and len(names) == 2
