"""One top, one start, three tables: every view of the Lab shows the same start, and none has its own."""

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
from app.model.lab.ends import SPINS, Ends
from app.model.lab.lab import Lab
from app.model.lesson.lesson import NAMES as STEP_NAMES
from app.model.runs import Runs
from app.model.setup import LAWS, TOYS
from app.model.start import DEFAULTS, GIVEN, arrives, of_toy
from app.page import page
from app.page.session import Session
from app.state.names import LEVELS, ROOMS, ROWS, SECTIONS
from app.state.url_state import explorer_of, read
from app.widgets import rooms
from tippe_core import PRESETS, BareSphere, Top, TruncatedSphere

TOY, PAPER = "Leine and Glocker's toy", "The paper's tippe top"


@pytest.fixture
def views():
    return lab_of(Explorer(**arrives()))


def lab_of(explorer):
    """A visible Lab; the ends for all spins are not needed here."""
    lab = Lab(explorer=explorer)
    lab.rest = lambda: None
    lab.show()
    return lab


def constants(explorer):
    return explorer.K_J, explorer.K_R, explorer.E


# ---- no quantity has two homes ----


def test_no_input_is_kept_twice():
    """No model that shows the start has an input of its own, and no name in an address belongs to one."""
    assert {*Lab.param} <= {"name", "busy", "scene", "ends"}
    assert {row.owner for row in ROWS}.isdisjoint({"Lab", "Start"})
    start = {row.parameter for row in ROWS if row.owner == "Explorer"}
    assert {*DEFAULTS} - {"motion"} == start
    others = {row.parameter for row in ROWS if row.owner != "Explorer"}
    assert start.isdisjoint(others)


# ---- a table is another one, and the start the same ----


@pytest.mark.parametrize(("toy", "given"), [
    (TOY, {"given": "hand", "spin": -17.3, "tilt": 11.0}),
    (PAPER, {"given": "hand", "spin": 20.0, "tilt": 30.0, "slip": 0.4}),
    (PAPER, {"given": "share", "K_J": 6.1, "K_R": 9.0, "energy": 0.4}),
    (PAPER, {"given": "E", "K_J": 6.0, "K_R": 10.0, "E": 40.0}),
    (TOY, {"given": "state", "theta": 0.4, "theta_dot": 0.1, "omega2": -1.0, "omega3": 8.0})])  # fmt: skip
def test_rough_ordinary_rough_comes_back_to_the_last_digit(toy, given):
    lab = lab_of(Explorer(**arrives() | of_toy(toy)))
    explorer = lab.explorer
    explorer.set(law="coulomb", mu=0.2, mu_s=0.3, **given)
    before, state = replace(explorer.start, table="rough"), explorer.let_go
    for table in ("ordinary", "rough", "ice", "three", "rough"):
        lab.ask(table=table)
        assert explorer.table == lab.scene.table == table
        assert replace(explorer.start, table="rough") == before
        assert explorer.let_go == state == lab.scene.start.state


def test_the_law_is_that_of_the_ordinary_table(views):
    for law in LAWS:
        views.ask(law=law, mu=0.2)
        assert views.scene.motions["ordinary"].start.friction == views.explorer.setup.friction
    views.ask(table="rough")
    views.ask(table="ordinary")
    assert views.scene.start.law == LAWS[-1]


def test_what_nobody_looks_at_is_not_computed(views):
    views.hide()
    scene = views.scene
    views.explorer.set(given="hand", spin=31.0)
    assert views.scene is scene
    views.show()
    assert views.scene.start.spin == 31.0


# ---- the rough table grips ----


def test_gripped_it_keeps_jelletts_constant_of_the_hand(views):
    """The impulse has no moment about the contact: the angular momentum about it, along the line to O, stays."""
    views.ask(spin=20.0, tilt=30.0)
    views.explorer.settle()
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
    views.explorer.set(given="share")
    assert not any("gripped" in note for note in views.explorer.scene.notes)


def test_the_hand_and_what_rolls_are_two_faces_of_one_start(views):
    views.ask(spin=20.0, tilt=30.0)
    views.explorer.settle()
    before = constants(views.explorer)
    views.explorer.set(given="state")  # given by the rolling motion: the same motion
    assert constants(views.explorer) == pytest.approx(before, rel=1e-14) and views.explorer.scene.lost == 0
    assert views.explorer.tilt == pytest.approx(30.0) and abs(views.explorer.spin) < 20.0
    views.ask(spin=21.0)
    assert views.explorer.given == "hand" and views.explorer.tilt == pytest.approx(30.0)


def test_a_motion_given_by_its_constants_rolls_on_every_table(views):
    views.explorer.set(**of_toy(PAPER), given="share", K_J=7.0, K_R=10.0, energy=0.9, table="three")
    motions = views.scene.motions
    assert motions["rough"].lost == 0
    assert motions["rough"].trajectory.jellett[0] / 0.399 == pytest.approx(7.0)
    assert {motion.start.state for motion in motions.values()} == {views.explorer.let_go}
    assert np.hypot(*motions["ordinary"].trajectory.slip[0]) == pytest.approx(0, abs=1e-12)


# ---- bodies ----

OWN = next(preset.shape for preset in PRESETS if preset.name == "Free profile")


@pytest.mark.parametrize("shape", [TruncatedSphere(R=0.02, c=0.01, l=0.024, r=0.004, M=0.02),
                                   replace(OWN, density=800.0)])  # fmt: skip
def test_a_body_of_ones_own_goes_along(views, shape):
    views.explorer.set(**of_toy(shape))
    assert views.scene.toy == shape
    assert views.scene.start.top == shape.top and not views.scene.messages


def test_inertias_that_are_no_bodys_are_a_sphere_of_these(views):
    views.explorer.set(**of_toy(PAPER))
    assert views.explorer.toy == PAPER
    views.explorer.set(a=0.11)
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
    explorer, wrong = explorer_of(texts)
    assert sentence == wrong == ""
    assert {name: getattr(explorer, name) for name in opens} == opens


# ---- the page ----


@contextmanager
def visitor(search):
    """(Session, Rooms) of a page with this address; its results come at once, without where runs of all spins end."""
    made = {}

    def no_ends(key, look):
        return Ends(SPINS, ("leans",) * len(SPINS), key.part)

    def kept(kind):
        make = kind.__init__

        def making(self, *inputs, **named):
            made[kind] = self
            make(self, *inputs, **named)

        return patch.object(kind, "__init__", making)

    with (
        set_curdoc(Document()), kept(Session), kept(rooms.Rooms),
        patch("app.page.session.Runs", lambda *session: Runs()),
        patch.object(rooms.Place, "ask", rooms.Place.fill), patch("app.model.lab.lab.ends_once", no_ends),
        patch("app.tabs.build.verdict.ends_once", no_ends),
    ):  # fmt: skip
        pn.state.location.search = search
        page.page()
        yield made[Session], made[rooms.Rooms]


def shown(session, seen):
    """The numbers that determine which motion is shown."""
    explorer = session.explorer
    explorer.settle()
    names = [name for name in DEFAULTS if name not in ("motion", "upper", "limit", *GIVEN["hand"])]
    return {
        "room": seen.room, **{name: getattr(explorer, name) for name in names}, "let_go": astuple(explorer.let_go),
        "rolls": explorer.scene.trajectory.theta.tolist(), "toy": explorer.toy,
    }  # fmt: skip


def start_of_page(session):
    """Everything that a person has set."""
    return session.explorer.start


@pytest.mark.parametrize("table", ["ordinary", "three"])
def test_research_and_back_sets_nothing_and_computes_nothing(table):
    with visitor("") as (session, seen):
        session.lab_of.ask(table=table, mu=0.12)
        session.url_state.commit()
        start, scene, query = start_of_page(session), session.lab_of.scene, session.url_state.query
        for _ in range(2):
            seen.level = "research"
            session.url_state.commit()
            assert start_of_page(session) == start and session.lab_of.scene is scene
            assert session.url_state.query == f"{query}&level=research"  # it says how much is open, and nothing else
            seen.room = "learn"
            assert seen.first("lab") == "lab" and seen.level == "research"
            seen.room = "lab"
            seen.level = "explore"
            session.url_state.commit()
            assert (session.url_state.query, start_of_page(session)) == (query, start)
        assert session.lab_of.scene is scene
        session.url_state.undo()  # the friction, the only step
        assert session.explorer.mu == 0.3 and not session.url_state.can_undo


def test_no_room_sets_anything_of_the_start_when_it_opens():
    with visitor("?v=4&table=rough&mu_k=.12&spin=21&tilt=12") as (session, seen):
        session.url_state.commit()
        start, undo = start_of_page(session), session.url_state.can_undo
        for level in LEVELS:
            for name in (*ROOMS[1:], "lab"):
                seen.param.update(room=name, level=level)
                session.url_state.commit()
                assert (name, start_of_page(session), session.url_state.can_undo) == (name, start, undo)
        seen.room = "learn"
        for section, step in zip(cycle(SECTIONS), STEP_NAMES, strict=False):
            session._learn.param.update(section=section, step=step)
        session.url_state.commit()
        assert (start_of_page(session), session.url_state.can_undo) == (start, undo)


STEPS = (
    lambda session, seen: setattr(seen, "room", "lab"),
    lambda session, seen: session.lab_of.ask(spin=21.0, tilt=12.0),
    lambda session, seen: session.lab_of.ask(table="three"),
    lambda session, seen: setattr(seen, "level", "research"),
    lambda session, seen: session.explorer.set(K_J=4.0),
    lambda session, seen: session.lab_of.ask(table="ordinary"),
    lambda session, seen: session.explorer.set(law="coulomb", mu=0.2, mu_s=0.35),
    lambda session, seen: setattr(seen, "level", "explore"),
    lambda session, seen: session.lab_of.ask(mu=0.25),
    lambda session, seen: session.lab_of.ask(table="rough"),
    lambda session, seen: setattr(seen, "room", "build-a-top"),
)  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize(("toy", "language"), [(TOY, "en"), (PAPER, "de")])
def test_links_of_the_steps_open_the_same_and_undo_goes_back_through_the_tables(toy, language):
    with visitor(f"?lang={language}&tab=lab") as (session, seen):
        session.lab_of.ask(toy=toy)
        session.url_state.commit()
        steps = [shown(session, seen)]
        for step in STEPS:
            step(session, seen)
            session.url_state.commit()
            assert f"lang={language}" in session.url_state.query
            steps.append(shown(session, seen))
            if len(steps) % 3 == 2:
                with visitor(session.url_state.query) as (other, their):
                    assert shown(other, their) == steps[-1]
                    assert other.url_state.query == session.url_state.query
        session.url_state.undo()  # the friction
        assert session.explorer.mu == 0.2
        session.url_state.undo()  # the law
        assert (session.explorer.law, session.explorer.K_J) == (steps[4]["law"], 4.0)
        session.url_state.undo()  # the rolling motion
        assert (session.explorer.given, session.explorer.spin, session.explorer.tilt) == ("hand", 21.0, 12.0)
        for _ in range(3):
            session.url_state.redo()
        again = shown(session, seen)
        assert {name: value for name, value in again.items() if name != "table"} == {
            name: value for name, value in steps[-1].items() if name != "table"}  # fmt: skip
