"""The way through the page as it is served: a hand asks, the Explorer solves, the RenderScheduler shows, and nobody
else follows.

docs/architecture.md says through which stations three gestures go, and they go through those, each once.
"""

import importlib
import re
from functools import wraps
from itertools import chain
from pathlib import Path

import panel as pn
import pytest
from bokeh.document import Document
from doubles import keeping
from panel.io.state import set_curdoc

import app.model.explorer
import app.model.lab.lab
import app.tabs.lab.rolling
from app.model.build.builder import Builder
from app.model.explorer import Explorer
from app.model.lab.lab import Lab
from app.model.runs import Runs
from app.page.page import page
from app.page.session import Session
from app.share.share import Share
from app.tabs.lab.lab import LabTab
from app.tabs.lab.rolling import Rolling
from app.widgets.controls import Controls
from app.widgets.guide import Guide
from app.widgets.numbers import Numbers
from app.widgets.plane_card import PlaneCard
from app.widgets.plane_view import PlaneView
from app.widgets.scheduling import RenderScheduler

DOCS = Path(__file__).parent.parent / "docs"
APP = DOCS.parent / "app"
SHOWING = [path for room in ("tabs", "widgets", "share") for path in (APP / room).rglob("*.py")]

# ---- three walks ----


STATIONS = (
    (Numbers, "_on_request"), (Rolling, "_grabbed"), (RenderScheduler, "ask"), (Explorer, "_solve"),
    (RenderScheduler, "_on_scene"), (Builder, "follow"), (Share, "show"), (Controls, "follow"),
    (PlaneView, "show_selected"), (PlaneView, "show_plane"),
    (Controls, "show"), (Guide, "show"), (PlaneCard, "show_path"), (LabTab, "_heard"), (Lab, "ask"), (Lab, "_begin"),
    (Lab, "_done"), (LabTab, "_told"),
)  # fmt: skip
FUNCTIONS = (
    (app.model.explorer, "solve"), (app.tabs.lab.rolling, "pulled"), (app.model.lab.lab, "scene_of"),
)  # fmt: skip


def station(owner, name):
    """The name in docs/architecture.md: file and function, where the function is defined."""
    function = getattr(owner, name)
    return f"{function.__module__.removeprefix('app.').replace('.', '/')}.py {function.__qualname__}"


@pytest.fixture
def walk(monkeypatch):
    """walk(query) serves the page of an address, and gives (the objects created, by class; its stations in order;
    rest()). After rest() the browser has painted everything, and nothing is dragged."""
    made, passed, timers = {}, [], []

    def note(function, name):
        @wraps(function)
        def noted(*inputs, **named):
            passed.append(name)
            return function(*inputs, **named)

        return noted

    for owner, name in (*STATIONS, *FUNCTIONS):
        monkeypatch.setattr(owner, name, note(getattr(owner, name), station(owner, name)))
    for kind in (Session, Rolling, Controls, LabTab, PlaneCard):
        monkeypatch.setattr(kind, "__init__", keeping(made, kind.__init__))
    for module in ("scheduling", "rest"):
        monkeypatch.setattr(f"app.widgets.{module}.after", lambda seconds, then: timers.append(then))
    monkeypatch.setattr("app.page.session.Runs", lambda *session: Runs())  # no session: results come at once
    with set_curdoc(Document()):

        def rest():
            scheduler = made[Session].scheduler
            scheduler._rest._last -= 1  # as if long ago
            for _ in range(30):
                scheduler.painted.painted = scheduler.painted.sent
                if timers:
                    timers.pop(0)()

        def walked(query):
            pn.state.location.search = query
            page()
            rest()
            passed.clear()
            return made, passed, rest

        yield walked


def told(title):
    """The stations in docs/architecture.md under a heading."""
    text = (DOCS / "architecture.md").read_text(encoding="utf-8")
    part = re.search(rf"## {title}\n(.*?)(?=\n## |\Z)", text, re.S)[1]
    return re.findall(r"^\d+\. `([^`]*)`", part, re.M)


PAPERS = "?v=3&tab=roll"


def test_the_walk_of_a_slider(walk):
    made, passed, rest = walk(PAPERS)
    made[Controls].numbers.view.request = [1, "K_J", 6.5, False]
    rest()
    assert made[Rolling]._scene.constants.K_J == 6.5
    assert passed == told("A slider, K_J") and len({*passed}) == len(passed)


def followers(scheduler):
    """The names of everything that a RenderScheduler shows scenes to."""
    for show in chain.from_iterable(scheduler._shows.values()):
        yield getattr(show, "func", show).__qualname__


def test_every_one_that_scenes_are_shown_to_is_a_station(walk):
    made, _, _ = walk(PAPERS)
    stations = {getattr(owner, name).__qualname__ for owner, name in (*STATIONS, *FUNCTIONS)}
    assert {*followers(made[Session].scheduler)} - stations == {"Research._on_scene"}  # which has the panel draw it


def test_the_walk_of_a_tieline_that_is_pulled(walk):
    made, passed, rest = walk(PAPERS)
    made[PlaneCard].plane.hand = ["line", 0.5, 6.5]
    rest()
    assert made[Rolling]._scene.constants.K_J == 6.5
    assert passed == told("A tieline that is pulled") and len({*passed}) == len(passed)


@pytest.mark.slow
def test_the_walk_of_a_run_with_friction(walk):
    made, passed, rest = walk("")
    made[LabTab].view.request = [1, "tilt", 15.0]
    rest()
    assert passed == told("A run with friction") and len({*passed}) == len(passed)


# ---- nobody else follows what is solved ----

# {room: what shows scenes there, besides what shows them on every page}
FOLLOW = {
    "lab": {"Controls.follow", "Controls.show", "Research._on_scene"}, "families": {"Tops.show", "Compare.show"},
    "build-a-top": {"Build.show", "Built.show"}, "learn": {"Learn.show"}, "maps": {"Maps.show"},
    "measure": {"Measure.show"},
}  # fmt: skip
# And what else listens to the start: the panel that fits the table, and where it is.
HEARS = {"lab": {("start", "Session.lab"), ("start", "Research._look")}}


def hearers(explorer):
    """(parameter, the function that watches it) for each watcher of an Explorer, except those that compute or store."""
    for kinds in explorer.param.watchers.values():
        for watcher in kinds.get("value", ()):
            fn = getattr(watcher.fn, "func", watcher.fn)
            if not fn.__module__.startswith(("app.model.", "app.state.")):
                yield from ((name, fn.__qualname__.partition(".<locals>")[0]) for name in watcher.parameter_names)


@pytest.fixture
def roomy(monkeypatch, request):
    """(a Session with its page, a list of the views created from now on, with their names)."""
    sessions, given = [], []

    def noted(make, note):
        @wraps(make)
        def making(made, *inputs, **named):
            note(made, [*inputs, *named.values()])
            make(made, *inputs, **named)

        return making

    for path in SHOWING:
        module = importlib.import_module(".".join(path.relative_to(APP.parent).with_suffix("").parts))
        for kind in vars(module).values():
            if isinstance(kind, type) and kind.__module__ == module.__name__ and "__init__" in vars(kind):
                taken = noted(kind.__init__, lambda view, inputs: given.extend((type(view), each) for each in inputs))
                monkeypatch.setattr(kind, "__init__", taken)
    monkeypatch.setattr(Session, "__init__", noted(Session.__init__, lambda session, inputs: sessions.append(session)))
    monkeypatch.setattr(Runs, "begin", lambda self, run, *name: run)  # nothing is computed
    with set_curdoc(Document()):
        first = "families" if "[learn]" in request.node.name else "learn"  # another room than that of the test
        pn.state.location.search = f"?v=4&tab={first}&level=research"
        page()
        yield sessions[0], given


@pytest.mark.parametrize("name", FOLLOW)
def test_a_room_is_told_of_scenes_by_the_pacer_alone(roomy, name):
    """A view that is created with the Explorer or the Session, or that watches the Explorer, is noticed."""
    session, given = roomy
    before, heard = {*followers(session.scheduler)}, {*hearers(session.explorer)}
    session.makers[name]()
    assert {*followers(session.scheduler)} - before == FOLLOW[name]
    assert {*hearers(session.explorer)} - heard == HEARS.get(name, set())
    assert {fn for parameter, fn in heard if parameter == "scene"} == {"RenderScheduler._on_scene"}
    assert {fn for _, fn in heard} == {"RenderScheduler._on_scene", "tells"}  # the head shows the top
    known = [(kind.__name__, type(each).__name__) for kind, each in given if isinstance(each, (Explorer, Session))]
    assert known == [("RenderScheduler", "Explorer")]  # between requests and the Explorer


# ---- the first tab ----


@pytest.mark.slow
@pytest.mark.parametrize("query, first", [("", "lab"), ("?v=4&tab=learn", "learn")])
def test_the_page_needs_no_tab_but_the_first_to_be_made(query, first, monkeypatch):
    """Whichever that is: the others are made when they are looked at."""
    made = []

    def noted(make):
        @wraps(make)
        def making(session):
            made.append(make.__name__)
            return make(session)

        return making

    for name in ("lab", "build", "families", "learn", "measure"):
        monkeypatch.setattr(Session, name, noted(getattr(Session, name)))
    with set_curdoc(Document()):
        pn.state.location.search = query
        page()
    assert made == [first]
