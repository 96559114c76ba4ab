"""Requests to the Lab without a browser: what is computed, what is kept, and what is impossible."""

from queue import Queue

import numpy as np
import pytest
from doubles import lab_of

from app.model import life
from app.model.arrival import ARRIVAL, MU, SPIN, TILT, TOY
from app.model.events import first_times
from app.model.explorer import Explorer
from app.model.lab import ends
from app.model.lab.allowed import LIMITS
from app.model.lab.ends import SPINS, Ends
from app.model.lab.lab import Lab
from app.model.run import whole_on
from app.model.runs import Runs
from app.model.setup import TOYS, start_of
from app.model.start import arrives
from app.model.story import story
from tippe_core import Contensou


@pytest.fixture
def lab():
    found = Lab()
    found.show()
    return found


# ---- the controls ----


def test_before_somebody_looks_nothing_is_computed(monkeypatch):
    monkeypatch.setattr("app.model.lab.lab.scene_of", None)
    lab = Lab()
    lab.ask(spin=20.0)
    assert lab.scene is None and lab.explorer.spin == 20.0


@pytest.mark.parametrize(("name", "value", "says"), [
    ("tilt", 185, "Tilt goes from 0° (stem up) to 180° (stem down). 185° is the same as 175°."),
    ("tilt", float("nan"), "nan is not a number. Type a number from 0 to 180."),
    ("spin", " ", "Nothing is not a number. Type a number from −100 to 100."),
    ("spin", "fast", "fast is not a number. Type a number from −100 to 100."),
    ("spin", 1e9, "Spin goes from −100 to 100 turns a second. 1e+09 is out of range. "
                  "A negative number spins it the other way."),
    ("mu", 0, "Friction goes from 0.01 (nearly ice) to 1.5 (rubber). 0 is out of range."),
    ("mu", None, "None is not a number. Type a number from 0.01 to 1.5."),
    ("toy", "a yo-yo", "a yo-yo is not one of the choices here. Choose one from the list."),
    ("table", [], "[] is not one of the choices here. Choose one from the list."),
])  # fmt: skip
def test_what_cannot_be_is_told_and_all_else_stays(lab, name, value, says):
    before, motions = lab.inputs, lab.scene.motions
    lab.ask(**{name: value})
    assert dict(lab.scene.messages) == {name: says} and lab.inputs == before and lab.scene.motions is motions
    lab.ask(spin=28.65)
    assert not lab.scene.messages


@pytest.mark.parametrize("given", ["hand", "share", "state"])
@pytest.mark.parametrize(("name", "value"), [("tilt", 185.0), ("spin", 1e9)])
def test_to_go_back_from_what_cannot_be_changes_nothing(given, name, value):
    """A start by constants stays one: tilt and spin that it only shows have made it one by hand."""
    lab = lab_of(Explorer(given=given))
    before, scene = lab.inputs, lab.scene
    lab.ask(**{name: value})
    assert name in lab.scene.messages
    lab.ask(**{name: lab.value(name)})
    assert lab.inputs == before and lab.explorer.given == given and not lab.scene.messages
    assert lab.scene.motions is scene.motions
    lab.ask(**{name: lab.value(name)})
    assert lab.explorer.given == "hand"  # it was set, and not gone back to


def test_one_can_go_back_to_what_no_hand_could_set():
    lab = lab_of(Explorer(**(arrives() | {"spin": 200.0})))
    lab.ask(spin=1e9)
    lab.ask(spin=200.0)
    assert not lab.scene.messages and lab.explorer.spin == 200.0


@pytest.mark.parametrize("given", ["hand", "share"])
def test_what_another_control_refuses_stays_there_until_it_is_changed_or_the_lab_is_asked(given):
    explorer = Explorer(given=given)
    lab = lab_of(explorer)
    scene, good = lab.scene, explorer.I3
    explorer.set(I3=2.0)
    assert explorer.I3 == 2.0 and "I3" in explorer.scene.messages and lab.scene is scene
    lab.ask(table="ice")
    explorer.settle()
    assert lab.scene.table == "ice" and not lab.scene.messages
    assert explorer.I3 == good and not explorer.scene.messages


@pytest.mark.parametrize(("name", "value", "near"), [
    ("tilt", 185, 175), ("tilt", -5.0, 5), ("tilt", 725.0, 5), ("spin", 1e9, 100), ("spin", -101, -100),
    ("mu", 0, 0.01), ("mu", 7.0, 1.5), ("patch", 0.0, 0.01), ("patch", 80.0, 5),
])  # fmt: skip
def test_the_nearest_value_that_can_be_is_offered_and_is_taken(lab, name, value, near):
    lab.ask(**{name: value})
    assert lab.nearest == {name: pytest.approx(near)}
    lab.ask(**lab.nearest)
    assert getattr(lab.explorer, name) == pytest.approx(near) and not lab.scene.messages and not lab.nearest


@pytest.mark.parametrize(("name", "value"), [("tilt", 185.0), ("spin", 1e9), ("mu", -1.0), ("patch", np.inf)])
def test_a_link_of_what_nobody_can_show_leaves_all_as_it_was(lab, name, value):
    before = lab.inputs
    lab.explorer.set(**{name: value})
    assert [*lab.scene.messages] == [name] and lab.inputs == before


@pytest.mark.parametrize(("name", "value"), [("spin", 150.0), ("spin", -2000.0), ("mu", 2.0), ("patch", 8.0)])
def test_what_research_has_set_is_kept_and_shown_also_past_what_a_hand_can_set_here(lab, name, value):
    assert not LIMITS[name][0] <= value <= LIMITS[name][1]
    lab.explorer.set(**{name: value})
    assert getattr(lab.explorer, name) == getattr(lab.scene.start, name) == value and not lab.scene.messages
    motion, spins = lab.scene.motions["ordinary"], TOYS[TOY].shape.scales.angular_velocity / (2 * np.pi)
    assert motion.trajectory.omega[0, 2] * spins == pytest.approx(lab.explorer.spin)
    assert motion.curves[-1, 0] > 0.05 and not lab.scene.refused
    lab.ask(tilt=8.0)  # and everything else is unchanged
    assert getattr(lab.scene.start, name) == value


def test_the_patch_is_the_tables(lab):
    lab.ask(patch=0.15)
    assert lab.scene.motions["ordinary"].start.friction == Contensou(0.3, 0.01)
    # of a smaller patch the toy stands longer: physics by another body, 4.50 s and 10.38 s
    falls = first_times(whole_on("ordinary", start_of(*ARRIVAL[1:], None, 0.15)))["falls"]
    assert falls == pytest.approx(10.38, abs=0.05)


def test_a_life_that_is_longer_than_what_is_computed_says_so(monkeypatch):
    whole = whole_on("ordinary", start_of(*ARRIVAL[1:]))
    assert not whole.cut and "computed only up to" not in story(whole).stages[-1].why
    monkeypatch.setattr(life, "MOST_ROWS", 300)
    whole_on.cache_clear()
    cut = whole_on("ordinary", start_of(TOY, 30.0, TILT, MU))
    whole_on.cache_clear()
    assert cut.cut == life.LONG and len(cut.trajectory.t) == 300
    assert story(cut).stages[-1].why.endswith(
        f"Its motion is computed only up to {cut.start.seconds:.3g} s. The top goes on.")  # fmt: skip


def test_a_body_that_would_be_in_the_table_is_told_at_the_tilt(lab):
    lab.ask(toy="Disc on a peg", tilt=120.0)
    assert lab.scene.messages["tilt"].startswith("At 120° a part of this body would be below the table.")
    assert lab.nearest == {"tilt": 90.0} and "90° or less" in lab.scene.messages["tilt"]
    assert (lab.scene.toy, lab.explorer.tilt) == ("Disc on a peg", TILT)
    lab.ask(tilt=80.0)
    assert lab.scene.start.tilt == 80 and not lab.scene.messages
    lab.ask(tilt=120.0)
    assert lab.scene.messages and lab.inputs == (ARRIVAL[0], start_of("Disc on a peg", SPIN, 80.0, 0.3))


def test_a_table_on_which_it_cannot_begin_says_so_in_its_place(lab):
    lab.ask(tilt=150.0, table="rough")
    assert lab.scene.motions["rough"] is None and not lab.scene.messages
    assert lab.scene.stages[0].why.startswith("At 150° its stem or rim would be below this table")
    lab.ask(table="three")
    assert lab.scene.motions["ordinary"] is not None and lab.scene.refused.keys() == {"rough", "ice"}


def test_changing_the_table_keeps_the_start_and_the_start_the_table(lab):
    lab.ask(table="ice")
    assert lab.scene.motions["ice"].start.spin == SPIN and lab.scene.motions["ordinary"] is None
    lab.ask(spin=30.0)
    assert lab.scene.table == "ice" and lab.scene.motions["ice"].start.spin == 30


def test_beside_the_server_the_newest_is_computed_and_one_event_tells_it():
    posted, scenes = Queue(), []
    lab = Lab(Runs(posted.put))
    lab.show()  # the stored run is there at once
    assert lab.scene.toy == TOY and posted.empty()
    lab.param.watch(lambda event: scenes.append(event.new.start.spin), "scene")
    for spin in (20.0, 21.0, 22.0):
        lab.ask(spin=spin)
    assert lab.busy and lab.scene.start.spin == SPIN
    while lab.busy:
        posted.get(timeout=60)()
    assert scenes == [20.0, 22.0] and lab.scene.start.spin == 22


def test_an_older_run_never_takes_the_place_of_the_arrival_that_was_asked_for_since():
    posted = Queue()
    lab = Lab(Runs(posted.put))
    lab.show()
    for spin in (5.0, SPIN):  # the second of them is stored, and there at once
        lab.ask(spin=spin)
    while lab.busy:
        posted.get(timeout=60)()
    assert lab.scene.start.spin == lab.explorer.spin == SPIN


def test_at_rest_the_strip_is_made_once_for_all_visitors(monkeypatch):
    asked = []
    found = Ends(SPINS, ("leans",) * len(SPINS), "stem")
    monkeypatch.setattr("app.model.lab.lab.ends_once", lambda key, look: asked.append(key) or found)
    monkeypatch.setattr("app.model.lab.lab.known_ends", lambda key: found if key in asked else None)
    for _ in range(2):
        lab = Lab()
        lab.show()
        lab.ask(mu=0.5)
        assert lab.ends is None
        lab.rest()
        assert lab.ends is found
        lab.ask(spin=10.0)
        assert lab.ends is found  # of all spins
        lab.ask(mu=0.6)
        assert lab.ends is None
    assert asked == [ends.of_spins(start_of(TOY, 0.0, TILT, 0.5))]
