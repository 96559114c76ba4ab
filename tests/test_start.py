"""One top, one start, three tables: every view of the Lab shows the same start, and none has its own."""

import json
from contextlib import contextmanager
from dataclasses import astuple, replace
from itertools import cycle
from unittest.mock import patch

import numpy as np
import panel as pn
import pytest
from bokeh.document import Document
from panel.io.state import set_curdoc

from app.model.explorer import Explorer
from app.model.lab.lab import Lab
from app.model.lesson.lesson import NAMES as STEP_NAMES
from app.model.planes.picture import SET
from app.model.planes.planes import Planes
from app.model.runs import Runs
from app.model.setup import LAWS, TOYS
from app.model.start import TABLES, Start, arrives, of_toy
from app.page import page
from app.page.house import House
from app.state.keep import explorer_of, read
from app.state.names import LEVELS, ROOMS, ROWS, SECTIONS
from app.state.start import OneStart
from app.text import LANGUAGES
from app.widgets import rooms
from app.widgets.numbers import NumberControls
from tippe_core import PRESETS, BareSphere, Top, TruncatedSphere

TOY, PAPER = "Leine and Glocker's toy", "The paper's tippe top"


class Views:
    """The models of the views, and the visible room."""

    def __init__(self, room="lab", **inputs):
        self.explorer, self.room = Explorer(**arrives() | inputs), room
        self.lab, self.planes = Lab(start=self.explorer), Planes(self.explorer)
        self.lab.rest = lambda: None  # the ends for all spins are not needed here
        self.start = OneStart(self.explorer, self.lab)
        self.start.have(self.planes)
        self.lab.show()
        self.planes.show()
        self.go(room)

    def go(self, room, table=None):
        """Goes to a room, or to a table of it, as the head does."""
        if table:
            room = self.start.table(table)
        self.room = room
        self.start.moved(room)
        return self


@pytest.fixture
def views():
    return Views()


def constants(explorer):
    return explorer.K_J, explorer.K_R, explorer.E


# ---- no quantity has two homes ----


def test_no_input_is_kept_twice():
    """No model that shows the start has an input of its own, and no name in an address belongs to one."""
    for model in (Lab, Planes):
        assert {*model.param} <= {"name", "busy", "picture", "refusal", "scene", "ends"}
    assert {row.owner for row in ROWS}.isdisjoint({"Lab", "Planes", "Start"})
    start = {row.parameter for row in ROWS if row.owner == "Explorer"}
    assert {*Start.param} - {"name"} <= start
    others = {row.parameter for row in ROWS if row.owner != "Explorer"}
    assert start.isdisjoint(others) and {*SET} <= start


def test_the_views_have_the_one_start(views):
    views.lab.ask(spin=17.0)
    assert views.explorer.spin == views.planes.inputs["spin"] == 17.0
    views.planes.ask(tilt=12.0, mu=0.2)
    start = views.lab.inputs[1]
    assert (start.spin, start.tilt, start.mu) == (17.0, 12.0, 0.2)


# ---- a table is another one, and the start the same ----


@pytest.mark.parametrize("toy", [TOY, PAPER])
@pytest.mark.parametrize("given", [
    {"given": "hand", "spin": -17.3, "tilt": 11.0}, {"given": "hand", "spin": 20.0, "tilt": 30.0, "slip": 0.4},
    {"given": "share", "K_J": 6.1, "K_R": 9.0, "energy": 0.4}, {"given": "E", "K_J": 6.0, "K_R": 10.0, "E": 40.0},
    {"given": "state", "theta": 0.4, "theta_dot": 0.1, "omega2": -1.0, "omega3": 8.0}])  # fmt: skip
def test_rough_ordinary_rough_comes_back_to_the_last_digit(toy, given):
    views = Views("roll", **of_toy(toy))
    views.explorer.param.update(law="coulomb", mu=0.2, mu_s=0.3, **given)
    asked = [name for name in Start.param if name not in ("name", "table")]
    before, state = {name: getattr(views.explorer, name) for name in asked}, views.explorer.let_go
    for table in ("ordinary", "rough", "ice", "three", "rough"):
        views.go(None, table)
        assert views.explorer.table == table and views.room == ("roll" if table == "rough" else "three-planes")
        assert {name: getattr(views.explorer, name) for name in asked} == before
        assert views.explorer.let_go == state
    views.go("lab").go("roll").go(None, "ordinary")
    assert {name: getattr(views.explorer, name) for name in asked} == before
    assert views.planes.picture.settings.state == state


def test_the_state_is_the_same_on_every_table(views):
    for asked in ({"spin": 20.0, "tilt": 30.0}, {"given": "share", "K_J": 4.0}, {"slip": 0.5}):
        views.explorer.param.update(**asked)
        shown = []
        for room in ("lab", "three-planes"):
            views.go(room, None)
        shown += [views.lab.scene.motions["ordinary"].start.state, views.planes.picture.settings.state]
        assert shown == [views.explorer.let_go] * 2
        views.explorer.given = "hand"


def test_the_planes_do_what_the_lab_does(views):
    views.go("three-planes")
    for law in LAWS:
        views.planes.ask(law=law, mu=0.2)
        start, settings = views.lab.inputs[1], views.planes.picture.settings
        assert (settings.state, settings.friction) == (start.state, start.friction)
        assert views.go("lab").lab.scene.motions["ordinary"].start.friction == settings.friction
        views.go("three-planes")


def test_the_table_goes_along(views):
    views.lab.ask(table="three")
    assert views.go("three-planes").planes.plane == "three"
    assert views.start.table("ice") == "three-planes" and views.planes.plane == "ice"
    assert views.go("lab").lab.scene.table == "ice"
    assert views.go(None, "rough").room == "roll"
    assert views.go("lab").lab.scene.table == "rough"


@pytest.mark.parametrize("table", TABLES)
def test_going_to_a_room_sets_no_table(views, table):
    views.lab.ask(table=table)
    for room in ("roll", "lab", "three-planes", "roll", "learn", "lab"):
        assert views.go(room).explorer.table == table
    assert views.lab.scene.table == table


def test_the_law_of_friction_stays_when_one_comes_back(views):
    views.planes.ask(law="viscous", gamma=0.7)
    views.go("lab").go("roll").go(None, "ordinary")
    assert views.planes.picture.settings.law == "viscous" and views.planes.picture.settings.gamma == 0.7


def test_what_nobody_looks_at_is_not_computed(views):
    views.go("roll")
    scene, picture = views.lab.scene, views.planes.picture
    views.explorer.param.update(given="hand", spin=31.0)
    assert views.lab.scene is scene and views.planes.picture is picture
    assert views.go("lab").lab.scene.start.spin == 31.0 and views.planes.picture is picture


# ---- the rough table grips ----


def test_gripped_it_keeps_jelletts_constant_of_the_hand(views):
    """The impulse has no moment about the contact: the angular momentum about it, along the line to O, stays."""
    views.lab.ask(spin=20.0, tilt=30.0)
    views.go("roll")
    top, scales = TOYS[TOY].top, TOYS[TOY].shape.scales
    spin = 2 * np.pi * 20.0 * scales.time
    jellett = top.I3 * spin * (np.cos(np.radians(30)) - top.a)  # C_J of G at rest, spun about the axis
    state, scene = views.explorer.scene.state, views.explorer.scene
    across = top.I1 * state.omega2 * np.sin(state.theta)
    assert across + top.I3 * state.omega3 * (np.cos(state.theta) - top.a) == pytest.approx(jellett, rel=1e-12)
    assert state.theta == pytest.approx(np.radians(30)) and scene.top == top
    left = scene.trajectory.ledger.kinetic[0]
    assert scene.lost == pytest.approx(top.I3 * spin**2 / 2 - left, rel=1e-9)
    assert f"that took {scene.lost:.2g} MgR of its energy at once" in scene.notes[0]
    views.explorer.param.update(given="share")
    assert not any("gripped" in note for note in views.explorer.scene.notes)


def test_the_hand_and_what_rolls_are_two_faces_of_one_start(views):
    views.lab.ask(spin=20.0, tilt=30.0)
    views.go("roll")
    before = constants(views.explorer)
    views.explorer.given = "state"  # given by the rolling motion: the same motion
    assert constants(views.explorer) == pytest.approx(before, rel=1e-14) and views.explorer.scene.lost == 0
    assert views.explorer.tilt == pytest.approx(30.0) and abs(views.explorer.spin) < 20.0
    views.lab.ask(spin=21.0)
    assert views.explorer.given == "hand" and views.explorer.tilt == pytest.approx(30.0)


def test_a_motion_given_by_its_constants_rolls_on_every_table(views):
    views.explorer.param.update(**of_toy(PAPER), given="share", K_J=7.0, K_R=10.0, energy=0.9, table="three")
    views.go("lab")
    motions = views.lab.scene.motions
    assert motions["rough"].lost == 0
    assert motions["rough"].trajectory.jellett[0] / 0.399 == pytest.approx(7.0)
    assert {motion.start.state for motion in motions.values()} == {views.explorer.let_go}
    assert np.hypot(*motions["ordinary"].trajectory.slip[0]) == pytest.approx(0, abs=1e-12)


# ---- bodies ----

OWN = next(preset.shape for preset in PRESETS if preset.name == "Free profile")


@pytest.mark.parametrize("shape", [TruncatedSphere(R=0.02, c=0.01, l=0.024, r=0.004, M=0.02),
                                   replace(OWN, density=800.0)])  # fmt: skip
def test_a_body_of_ones_own_goes_along(views, shape):
    views.explorer.param.update(**of_toy(shape))
    views.go("lab")
    assert views.lab.scene.toy == shape
    assert views.lab.scene.start.top == shape.top and not views.lab.scene.messages


def test_inertias_that_are_no_bodys_are_a_sphere_of_these(views):
    views.explorer.param.update(**of_toy(PAPER))
    assert views.explorer.toy == PAPER
    views.explorer.a = 0.11
    assert isinstance(views.explorer.toy, BareSphere) and views.explorer.toy.top == Top(0.11, 0.399, 0.408)


# ---- links of the first version, in which each view had its own ----


@pytest.mark.parametrize(("query", "opens"), {
    "?v=1&tab=lab": {"toy": TOY, "given": "hand", "spin": 28.65, "tilt": 5.73, "mu": 0.3, "law": "contact"},
    "?v=1&tab=lab&toy=2&turns=30&lean=12&rub=.2&table=ice":
        {"toy": "Top S", "spin": 30.0, "tilt": 12.0, "mu": 0.2, "table": "ice"},
    "?v=1&tab=lab&toy=1&by=state&th=.3&w3=9&spin=7": {"toy": PAPER, "given": "hand", "spin": 28.65, "a": 0.07},
    "?v=1&tab=lab&toy=TruncatedSphere_.02_.01_.024_.004_.02":
        {"shape": TruncatedSphere(R=0.02, c=0.01, l=0.024, r=0.004, M=0.02)},
    "?v=1&tab=lab&toy=99": {"toy": TOY},
    "?v=1&tab=three-planes&KJ=6.7&mu=.2&turns=30": {"given": "hand", "spin": 20.0, "tilt": 10.0, "mu_s": 0.2},
    "?v=1&tab=three-planes&start=constants&KJ=6.7": {"given": "share", "K_J": 6.7},
    "?v=1&tab=three-planes&by=E&E=27.5": {"given": "hand", "spin": 20.0},
    "?v=1&tab=three-planes&law=coulomb&mu=.2&mu_smooth=.9": {"mu_s": 0.4, "mu": 0.3},
    "?v=1&tab=three-planes&law=coulomb&mu_k=.25&mu_stick=.35": {"mu_s": 0.35, "mu": 0.25},
    "?v=1&tab=three-planes&mu_k=.25&mu_smooth=.4&mu_stick=.6": {"mu_s": 0.5, "mu": 0.4, "law": "smoothed"},
    "?v=1&tab=three-planes&plane=compare": {"table": "three"},
    "?v=1&KJ=6.7&start=spin&turns=30&toy=3": {"given": "share", "K_J": 6.7, "toy": PAPER},
}.items())  # fmt: skip
def test_a_link_of_the_first_version_opens_the_start_of_its_view(query, opens):
    texts, sentence = read(query)
    explorer, wrong = explorer_of(texts, explores="tab=lab" in query)
    assert sentence == wrong == ""
    assert {name: getattr(explorer, name) for name in opens} == opens


# ---- the page ----


@contextmanager
def visitor(search):
    """(House, Rooms) of a page with this address; its results come at once."""
    made = {}

    def kept(kind):
        make = kind.__init__

        def making(self, *inputs, **named):
            made[kind] = self
            make(self, *inputs, **named)

        return patch.object(kind, "__init__", making)

    with (
        set_curdoc(Document()), kept(House), kept(rooms.Rooms), patch("app.page.house.Runs", lambda *session: Runs()),
        patch.object(rooms.Place, "ask", rooms.Place.fill),
    ):  # fmt: skip
        pn.state.location.search = search
        page.page()
        yield made[House], made[rooms.Rooms]


def shown(house, seen):
    """The numbers that determine which motion is shown."""
    explorer = house.explorer
    explorer.settle()
    names = [name for name in Start.param if name not in ("name", *Start.GIVEN["hand"])]
    return {
        "room": seen.room, **{name: getattr(explorer, name) for name in names}, "let_go": astuple(explorer.let_go),
        "rolls": explorer.scene.trajectory.theta.tolist(), "toy": explorer.toy,
    }  # fmt: skip


def start_of_page(house):
    """Everything that a person has set."""
    return {name: getattr(house.explorer, name) for name in Start.param if name != "name"}


SHOWS = {"ordinary": "three-planes", "rough": "roll", "ice": "three-planes", "three": "three-planes"}


@pytest.mark.parametrize("table", TABLES)
def test_a_level_shows_the_table_that_is_set_and_sets_none(table):
    with visitor("") as (house, seen):
        house.lab_of.ask(table=table, mu=0.12)
        house.keep.at_rest()
        start, scene = start_of_page(house), house.lab_of.scene
        for _ in range(2):
            seen.level = "research"
            assert seen.room == SHOWS[table]
            house.keep.at_rest()
            assert start_of_page(house) == start
            seen.room = "learn"
            assert seen.first("lab") == SHOWS[table]
            seen.room = "lab"
            house.keep.at_rest()
            assert (seen.level, start_of_page(house)) == ("explore", start)
        assert house.lab_of.scene is scene
        house.keep.undo()  # the friction, the only step
        assert house.explorer.mu == 0.3 and not house.keep.can_undo


def test_friction_of_explore_is_that_of_research():
    with visitor("") as (house, seen):
        house.lab_of.ask(mu=0.12)
        seen.level = "research"
        picture = house.start._planes.picture
        groups = seen.columns[ROOMS.index("three-planes")].select(NumberControls)
        [told] = [state for group in groups if "mu" in (state := json.loads(group.state))["values"]]
        assert picture.friction == house.lab_of.scene.motions["ordinary"].start.friction
        assert (picture.friction.mu, told["values"]["mu"]) == (0.12, 0.12)
        assert "mu" not in told["hidden"]


def test_a_table_chosen_in_any_room_is_set_in_all_of_them():
    with visitor("") as (house, seen):
        for level, other in (("research", "explore"), ("explore", "research")):
            for table in ("three", "rough", "ice", "ordinary"):
                seen.level = level
                if level == "research":
                    seen.room = house.start.table(table)
                else:
                    house.lab_of.ask(table=table)
                for shown in (level, other):
                    seen.level = shown
                    assert seen.room == ("lab" if shown == "explore" else SHOWS[table])
                    assert house.explorer.table == table
        seen.level = "research"
        house.explorer.table = "rough"  # set by whatever: the room follows
        assert seen.room == "roll"


@pytest.mark.parametrize("table", ["ordinary", "rough"])
def test_no_room_sets_anything_of_the_start_when_it_opens(table):
    with visitor(f"?v=2&tab=lab&table={table}&mu_k=.12&spin=21&tilt=12") as (house, seen):
        house.keep.at_rest()
        start, undo = start_of_page(house), house.keep.can_undo
        for level in LEVELS:
            for name in (*ROOMS[3:], "lab"):
                seen.room = name
                if name != "lab":
                    seen.level = level
                house.keep.at_rest()
                assert (name, start_of_page(house), house.keep.can_undo) == (name, start, undo)
        seen.room = "learn"
        for section, step in zip(cycle(SECTIONS), STEP_NAMES, strict=False):
            house._learn.param.update(section=section, step=step)
        house.keep.at_rest()
        assert (start_of_page(house), house.keep.can_undo) == (start, undo)


STEPS = (
    lambda house, seen: setattr(seen, "room", "lab"),
    lambda house, seen: house.lab_of.ask(spin=21.0, tilt=12.0),
    lambda house, seen: house.lab_of.ask(table="three"),
    lambda house, seen: setattr(seen, "room", house.start.table("rough")),
    lambda house, seen: house.explorer.param.update(K_J=4.0),
    lambda house, seen: setattr(seen, "room", house.start.table("ordinary")),
    lambda house, seen: house.explorer.param.update(law="coulomb", mu=0.2, mu_s=0.35),
    lambda house, seen: setattr(seen, "room", "lab"),
    lambda house, seen: house.lab_of.ask(mu=0.25),
    lambda house, seen: setattr(seen, "room", house.start.table("rough")),
    lambda house, seen: setattr(seen, "room", "build-a-top"),
)  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize(("toy", "language"), [*zip((TOY, PAPER), LANGUAGES, strict=True)])
def test_links_of_the_steps_open_the_same_and_undo_goes_back_through_the_tables(toy, language):
    with visitor(f"?lang={language}&tab=lab") as (house, seen):
        house.lab_of.ask(toy=toy)
        house.keep.at_rest()
        steps = [shown(house, seen)]
        for step in STEPS:
            step(house, seen)
            house.keep.at_rest()
            assert f"lang={language}" in house.keep.query
            steps.append(shown(house, seen))
            if len(steps) % 3 == 2:
                with visitor(house.keep.query) as (other, their):
                    assert shown(other, their) == steps[-1]
                    assert other.keep.query == house.keep.query
        house.keep.undo()  # the friction
        assert house.explorer.mu == 0.2
        house.keep.undo()  # the law
        assert (house.explorer.law, house.explorer.K_J) == (steps[4]["law"], 4.0)
        house.keep.undo()  # the rolling motion
        assert (house.explorer.given, house.explorer.spin, house.explorer.tilt) == ("hand", 21.0, 12.0)
        for _ in range(3):
            house.keep.redo()
        again = shown(house, seen)
        assert {name: value for name, value in again.items() if name != "table"} == {
            name: value for name, value in steps[-1].items() if name != "table"}  # fmt: skip
