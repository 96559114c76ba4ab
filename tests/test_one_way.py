"""One way, at run time too: a hand asks, the Explorer solves, one scene is shown.

Every view is made alone, without Explorer, page or another view, and shows stored scenes; test_walks.py goes through
the page.
"""

import ast
import importlib
import json
from functools import cache, partial
from pathlib import Path

import numpy as np
import pytest
from bokeh.document import Document
from bokeh.models import ColumnDataSource, Label, Range1d, Span
from doubles import Shown
from panel.custom import JSComponent
from panel.io.state import set_curdoc

from app.bundle import Bundled
from app.model.build.builder import Builder
from app.model.explorer import Explorer
from app.model.lab.lab import scene_of
from app.model.playing import Playing
from app.model.scene import Scene, solve
from app.model.setup import Setup
from app.share.share import Share
from app.state.url_state import UrlState
from app.tabs.build.build import Build
from app.tabs.build.section import Section
from app.tabs.families.compare import Compare
from app.tabs.families.tops import Tops
from app.tabs.lab.figures import Times, Well
from app.tabs.lab.rolling import Rolling
from app.tabs.learn.learn import Learn
from app.tabs.maps.maps import Maps
from app.tabs.measure.measure import Measure
from app.widgets.cards import Hidden
from app.widgets.controls import FACES, Controls
from app.widgets.drawing import Remote
from app.widgets.guide import Guide
from app.widgets.light import Light
from app.widgets.portraits import Force, Potential, Ring
from app.widgets.scheduling import RenderScheduler
from app.widgets.surface3d import Surface3D, show_surface
from tippe_core import PRESETS, Constants, Top

DOCS = Path(__file__).parent.parent / "docs"


@cache
def stored(name):
    """The Scene of a preset, with its start."""
    preset = next(preset for preset in PRESETS if preset.name == name)
    if preset.top == Top.paper():
        return solve(preset.top, 7.0, 10.0, 0.5, 0.9, shape=preset.shape)
    thrown = Constants.from_state(preset.top, 0.3, 0.0, 0.0, 12.0)
    return solve(preset.top, float(thrown.K_J), float(thrown.K_R), 0.4, 0.6, shape=preset.shape)


TOPS = ("The paper's tippe top", "Leine and Glocker's toy", "Wooden cone")


@cache
def ran(name):
    """A LabScene of its top."""
    scene = stored(name)
    return scene_of("three", Setup(
        top=scene.top, scales=scene.scales, shape=scene.shape, spin=15.0,
        tilt=12.0, slip=1.0, law="coulomb", mu=0.2, mu_s=0.3, gamma=0.3, eps=0.1, landing="plastic",
        stem=True, seconds=0.3))  # fmt: skip


# ---- every view alone ----


def nothing(**inputs):
    raise AssertionError("nobody asked")


def of_scenes(kind):
    def make(scene):
        view = kind()
        return view, view.show

    return make


def surface(scene):
    view = Surface3D()
    return view, partial(show_surface, view)


def controls(scene):
    view = Controls(scene, nothing)

    def show(scene):
        view.follow(scene)
        for face in reversed(FACES):  # hidden parts are shown when they become visible
            view.face = face
            view.show(scene)

    return view, show


def rolling(panel):
    def make(scene):
        content, draws = getattr(Rolling(Shown(scene), None, None), panel)()

        def show(scene):
            for draw in draws.values():
                draw(scene)

        return content, show

    return make


def learn(section):
    def make(scene):
        view = Learn(scene)

        def show(scene):
            for view.section in ("lesson", section):  # hidden parts are shown when they become visible
                view.show(scene)

        return view, show

    return make


def bench(scene):
    """The builder's tab is of a Builder, whose draft is a function of the scene."""
    builder = Builder(scene, nothing)
    view = Build(builder)

    def show(scene):
        builder.follow(scene)
        view.show(scene)

    return view, show


def section(scene):
    view = Section(lambda *wish: None)
    return view, lambda scene: view.show(Builder(scene, nothing).draft)


def share(scene):
    view = Share(UrlState(), Playing(), scene)
    view.open()

    def show(scene):
        view.show(scene)
        view.open()

    return view, show


def compare(scene):
    view = Compare(scene)

    def show(scene):
        view.show(scene)
        view.kind.value = "ordinary" if scene.top.a < 0 else "tippe"
        view._prefill()
        view._show_span()  # as compute() does

    return view, show


class Idle:
    """Runs that are never computed."""

    beside = False

    def begin(self, run, *name):
        return run


def maps(scene):
    view = Maps(Idle(), scene)
    return (view, view.view), view.show


def measure(scene):
    view = Measure(scene, Idle())
    page = view.view
    view.take("t (s),theta (deg)\n" + "".join(f"{0.1 * i},{5 + i * i}\n" for i in range(9)))  # the page's top
    return (view, page), view.show


VIEWS = {
    **{kind.__name__: of_scenes(kind) for kind in (Potential, Ring, Force, Guide)}, "Surface3D": surface,
    **{panel: rolling(panel) for panel in ("plane", "surface", "portraits")},
    "Controls": controls, "Learn, the lesson": learn("lesson"), "Learn, the lines": learn("derivation"),
    "Build": bench, "Section": section, "Share": share, "Compare": compare,
    "Maps": maps, "Measure": measure,
    "Tops": lambda scene: (lambda view: (view, view.show))(Tops(scene, nothing, nothing, nothing)),
}  # fmt: skip


def seen(view):
    """{path: value} of everything that a view has put on the page, or stores of it."""
    found, met = {}, set()

    def look(thing, path):
        if isinstance(thing, (Scene, str, int, float, type(None), np.ndarray, Remote)) or id(thing) in met:
            return
        met.add(id(thing))
        if isinstance(thing, (dict, list, tuple)):
            parts = thing.items() if isinstance(thing, dict) else enumerate(thing)
            for name, part in parts:
                look(part, f"{path}/{name}")
        elif isinstance(thing, ColumnDataSource):
            found.update({f"{path}/{name}": in_a_row(column) for name, column in thing.data.items()})
        elif isinstance(thing, Range1d):
            found[path] = np.array([thing.start, thing.end])
        elif isinstance(thing, (Span, Label)):
            found[path] = np.asarray((thing.location if isinstance(thing, Span) else thing.text) * thing.visible)
        elif isinstance(thing, Light) or hasattr(thing, "jslink"):  # a part of the page
            for name in ("objects", "object", "value", "label", "options", "visible", "styles", "state"):
                part = getattr(thing, name, None)
                if isinstance(thing, Hidden) and not thing.visible:
                    continue  # what it has is made when it is first shown
                if isinstance(part, list) and name == "objects":
                    look(part, f"{path}/{name}")
                elif name in thing.param:
                    found[f"{path}/{name}"] = np.asarray(str(part))
            if isinstance(thing, JSComponent):
                for name in {*thing.param} - {*Bundled.param}:
                    part = getattr(thing, name)
                    if name == "looks":  # of a Drawing: what is not visible may be as it was
                        drawn = [
                            (id, *sorted(of.items()))
                            for id, of in part.items()
                            if of.get("visible", of and "text" not in of)
                        ]
                        part = sorted(drawn)
                    known = isinstance(part, bytes)
                    found[f"{path}/{name}"] = np.frombuffer(part, np.uint8) if known else np.asarray(str(part))
        elif type(thing).__module__.startswith("app.") and hasattr(thing, "__dict__"):
            for name, part in vars(thing).items():
                if not name.endswith(("_param__private", "_runs")):
                    look(part, f"{path}.{name}")

    look(view, "")
    return found


def in_a_row(column):
    """A column of a data source: numbers, words, or arrays of any length."""
    return np.concatenate([np.ravel(np.asarray(each)) for each in column]) if len(column) else np.zeros(0)


def same(one, other):
    kinds = one.dtype.kind in "fiu" and other.dtype.kind in "fiu"
    return one.shape == other.shape and np.array_equal(one, other, equal_nan=kinds)


def shown(make, *scenes):
    """What is on the page of a view that was created with the first of these scenes and has shown all others."""
    view, show = make(scenes[0])
    for scene in scenes:
        show(scene)
    return seen(view)


@pytest.fixture
def alone(monkeypatch):
    """Neither an Explorer nor a RenderScheduler is created."""

    def refuse(self, *inputs, **named):
        raise AssertionError("a view made it")

    monkeypatch.setattr(Explorer, "__init__", refuse)
    monkeypatch.setattr(RenderScheduler, "__init__", refuse)
    with set_curdoc(Document()):
        yield


@pytest.mark.slow
@pytest.mark.parametrize("name", VIEWS)
def test_a_view_works_alone_and_shows_the_last_scene_whatever_came_before(alone, name):
    first, *others = (stored(TOPS[i]) for i in (0, 2, 1))
    view, show = VIEWS[name](first)
    show(first)
    shows = None
    for count, scene in enumerate(others, 2):
        show(scene)
        found, expected = seen(view), shown(VIEWS[name], *[scene] * count)
        assert found.keys() == expected.keys()
        assert [path for path in found if not same(found[path], expected[path])] == []
        # it shows something
        assert shows is None or any(path not in shows or not same(found[path], shows[path]) for path in found)
        shows = found


@pytest.mark.slow
@pytest.mark.parametrize("kind", [Times, Well])
def test_the_figures_of_a_run_work_alone(alone, kind):
    make, first, other = of_scenes(kind), ran(TOPS[0]), ran(TOPS[2])
    found, expected = shown(make, first, other), shown(make, other, other)
    assert found.keys() == expected.keys()
    assert [path for path in found if not same(found[path], expected[path])] == []


def test_what_a_view_asks_is_all_that_it_does(alone):
    """Dragging in Fig. 6: the scene stays until another one is shown."""
    scheduler = Shown(stored(TOPS[0]))
    view = Rolling(scheduler, None, None)
    [place], draws = view.plane()
    [plane] = place
    draws["hand"](scheduler.scene)
    plane.hand = ["line", 0.5, 6.0]
    [line] = scheduler.asked
    assert line == {"K_J": 6.0, "given": "share"}
    assert view._scene is scheduler.scene and json.loads(plane.state)["K_J"] == 7.0


# ---- no view computes ----

APP = DOCS.parent / "app"
SHOWING = [path for room in ("tabs", "widgets", "share") for path in (APP / room).rglob("*.py")]


def test_no_view_takes_a_function_of_the_core():
    """Everything shown is computed in the model. Of the core, a view may know a record, a body, an error, or a list of
    them."""
    taken = []
    for path in SHOWING:
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ImportFrom) and (node.module or "").split(".")[0] == "tippe_core":
                module = importlib.import_module(node.module)
                found = {alias.name: getattr(module, alias.name) for alias in node.names}
                taken += [(path.name, name) for name, what in found.items()
                          if callable(what) and not isinstance(what, type)]  # fmt: skip
            elif isinstance(node, ast.Import):
                taken += [(path.name, each.name) for each in node.names if each.name.startswith("tippe_core")]
    assert taken == []
