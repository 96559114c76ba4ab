"""The Explorer without a browser: each change is one solve and one event, and an error is shown at its control."""

import dataclasses
import json
import time

import numpy as np
import pytest

import app.model.bodies
import app.model.explorer
import app.model.frames
import app.model.region
import app.model.scene
from app.model.explorer import Explorer
from app.model.regimes import ROLLS, WOULD_LIFT, WOULD_SLIP
from app.model.scene import solve
from app.model.start import GIVEN
from app.widgets.controls import Controls, values_of
from tippe_core import (
    Constants,
    State,
    Top,
    TopError,
    roll,
)


def watch(explorer):
    scenes = []
    explorer.param.watch(lambda event: scenes.append(event.new), "scene")
    return scenes


def test_several_inputs_make_one_solve_and_one_event(explorer, monkeypatch):
    solves, scenes = [], watch(explorer)
    solve = app.model.scene.solve
    monkeypatch.setattr(
        app.model.explorer, "solve", lambda *inputs, **face: solves.append(inputs) or solve(*inputs, **face)
    )
    explorer.set(K_J=5.0, K_R=9.0, mu_s=0.4, energy=0.5)
    assert len(solves) == len(scenes) == 1
    assert scenes[0] is explorer.scene
    assert (explorer.scene.constants.K_J, explorer.scene.constants.K_R, explorer.scene.mu_s) == (5.0, 9.0, 0.4)


def test_the_scene_cannot_be_set_or_changed_from_outside(explorer):
    with pytest.raises(TypeError):
        explorer.scene = dataclasses.replace(explorer.scene)
    with pytest.raises(dataclasses.FrozenInstanceError):
        explorer.scene.mu_s = 1.0


def test_what_did_not_change_is_the_same_object(explorer):
    plane = explorer.scene.plane
    explorer.set(K_J=6.0)
    assert explorer.scene.plane is plane
    explorer.set(mu_s=0.3)
    assert explorer.scene.plane is not plane


def test_the_energy_goes_from_rolling_through_slipping_to_lifting_off(explorer):
    seen = []
    for share in (0.0, 0.5, 0.999, 1.01, 1.99, 2.01):
        explorer.set(energy=share)
        seen.append(explorer.scene.regime.max())
    assert seen == [ROLLS, ROLLS, ROLLS, WOULD_SLIP, WOULD_SLIP, WOULD_LIFT]
    assert explorer.scene.normal.min() < 0


@pytest.mark.parametrize("share", [0.0, 0.4, 1.0, 1.7, 2.0, 2.2])
def test_share_and_energy_are_each_others_inverse(explorer, share):
    marks = explorer.scene.marks
    assert marks.share(marks.energy(share)) == pytest.approx(share, abs=1e-12)


@pytest.mark.parametrize(
    "name, value, says",
    [
        ("I3", 0.9, "2 I1"),
        ("I1", -0.1, "I1"),
        ("a", 1.2, "a"),
        ("energy", -0.2, "E >= "),
        ("mu_s", -0.1, "mu_s"),
        ("K_J", float("nan"), "K_J"),
    ],
)
def test_what_cannot_be_is_said_beside_its_control_and_the_picture_stays(explorer, name, value, says):
    good, before = explorer.scene, getattr(explorer, name)
    explorer.set(**{name: value})
    assert list(explorer.scene.messages) == [name]
    assert says in explorer.scene.messages[name]
    for part in dataclasses.fields(good):
        if part.name not in ("messages", "nearest", "inputs"):
            assert getattr(explorer.scene, part.name) is getattr(good, part.name)
    asked = explorer.scene.inputs
    assert {key for key, was in good.inputs.items() if asked[key] is not was and asked[key] != was} <= {name, "E"}
    assert asked[name] is value
    explorer.set(**{name: before})
    assert not explorer.scene.messages


def inputs_of(explorer):
    return {name: getattr(explorer, name) for names in GIVEN.values() for name in names}


def test_constants_and_initial_state_follow_each_other_to_the_last_digit(explorer):
    start = State(0.6, 1.5, -2.0, 9.0)
    scenes = watch(explorer)
    explorer.set(theta=0.6, theta_dot=1.5, omega2=-2.0, omega3=9.0)
    assert explorer.given == "state" and len(scenes) == 1 and not explorer.scene.messages
    constants = Constants.from_state(Top.paper(), 0.6, 1.5, -2.0, 9.0)
    assert explorer.scene.constants == constants
    assert (explorer.K_J, explorer.K_R, explorer.E) == (constants.K_J, constants.K_R, constants.E)
    expected = roll(Top.paper(), None, explorer.scene.trajectory.t, start=start)
    assert np.array_equal(explorer.scene.trajectory.quaternion, expected.quaternion)
    assert explorer.scene.trajectory.theta[0] == pytest.approx(0.6, abs=1e-15)

    explorer.set(E=40.0)
    assert explorer.given == "E" and explorer.scene.constants == Constants(constants.K_J, constants.K_R, 40.0)
    state = explorer.scene.state
    assert (explorer.theta, explorer.theta_dot, explorer.omega2, explorer.omega3) == (
        state.theta,
        state.theta_dot,
        state.omega2,
        state.omega3,
    )
    back = Constants.from_state(Top.paper(), state.theta, state.theta_dot, state.omega2, state.omega3)
    assert (back.K_J, back.K_R, back.E) == pytest.approx((constants.K_J, constants.K_R, 40.0), rel=1e-13)


@pytest.mark.parametrize("change", [{"K_J": 6.1}, {"E": 28.1}, {"omega3": 8.8}, {"theta": 0.5, "theta_dot": -0.3}])
def test_what_was_can_be_put_back(explorer, change):
    explorer.set(**change)
    before, given = inputs_of(explorer), explorer.given
    kept = {name: before[name] for name in GIVEN[given]}
    for other in ({"K_J": 3.0}, {"E": 29.0}, {"theta": 0.7}):
        explorer.set(**other)
        assert inputs_of(explorer) != before
        explorer.set(given=given, **kept)
        assert inputs_of(explorer) == before


def test_the_face_shown_changes_nothing(explorer):
    scene, scenes, before = explorer.scene, watch(explorer), inputs_of(explorer)
    controls = Controls(scene, explorer.set)
    controls.face = "state"
    assert explorer.scene is scene and not scenes and inputs_of(explorer) == before


@pytest.mark.parametrize("given", ["hand", "share", "state"])
@pytest.mark.parametrize(("name", "value"), [
    ("I3", 2.0), ("K_J", 1e9), ("K_J", "seven"), ("energy", "much"), ("mu_s", -1.0),
])  # fmt: skip
def test_to_go_back_from_what_is_refused_changes_nothing(given, name, value):
    """A start by hand stays one, though its constants are only as they follow."""
    explorer = Explorer(given=given)
    before, good = inputs_of(explorer), explorer.start
    controls = Controls(explorer.scene, explorer.set, lambda: explorer.back)
    explorer.param.watch(lambda event: controls.show(event.new), "scene")
    for number, wish in enumerate((value, values_of(explorer.scene)[name]), 1):
        controls.numbers.view.request = [number, name, wish, wish == value]
        assert bool(json.loads(controls.numbers.view.state)["messages"]) == (wish == value)
    assert not explorer.scene.messages and inputs_of(explorer) == before and explorer.start == good


def test_to_go_back_undoes_nothing_else():
    explorer = Explorer()
    controls = Controls(explorer.scene, explorer.set, lambda: explorer.back)
    explorer.param.watch(lambda event: controls.show(event.new), "scene")
    explorer.set(K_J=1e9)
    explorer.set(table="ice", mu=0.2, solve=False)
    controls.numbers.view.request = [1, "K_J", "seven", True]
    controls.numbers.view.request = [2, "I1", "one", True]
    controls.numbers.view.request = [3, "I1", explorer.scene.top.I1, False]
    assert [*explorer.scene.messages] == ["K_J"]  # still refused: I1 alone was gone back to
    controls.numbers.view.request = [4, "K_J", explorer.scene.constants.K_J, False]
    assert not explorer.scene.messages and (explorer.table, explorer.mu) == ("ice", 0.2)


def test_a_steady_precession_is_said_to_stay_and_another_motion_to_go_from_one_tilt_to_another(explorer):
    scene = explorer.scene
    assert "from 0.391 to 0.763 rad (22.4° to 43.7°)" in Controls._notes(scene)["energy"]
    explorer.set(E=scene.marks.steady)
    assert "stays at 0." in Controls._notes(explorer.scene)["energy"]


@pytest.mark.parametrize("name, value", [("theta", 4.0), ("theta_dot", float("inf"))])
def test_a_state_that_cannot_be_is_said_beside_it(explorer, name, value):
    good = explorer.scene
    explorer.set(**{name: value})
    assert list(explorer.scene.messages) == [name] and explorer.scene.trajectory is good.trajectory


@pytest.mark.parametrize("top, K_J, K_R", [
    ((1e-300, 0.399, 0.408), 7, 10), ((1e-300, 0.4, 0.4), 7, 10), ((1e-18, 0.4, 0.4), 7, 10),
    ((-1e-12, 0.4, 0.4), 7, 10),
    ((0, 4849, 32), 0, 0), ((0, 4849, 32), 1e-9, 1e-9), ((0, 0.4, 0.4), 0, 0), ((0.07, 0.399, 0.408), 1e5, 1e5),
    ((-3.2307207395080297e-186, 5.5806048614695545, 0.28808290121391705), -172.95825185713196, 1.8838881546812526e-05),
])  # fmt: skip
def test_a_top_at_the_edge_of_what_can_be_is_answered_soon(top, K_J, K_R):
    start = time.process_time()
    try:
        scene = solve(Top(*top), K_J, K_R, 0.5, 0.9)
    except TopError as error:
        assert error.name == "E"  # no such motion, or none that can be resolved, and it says so
    else:
        assert np.ptp(scene.E) < 1e-9 * (1 + abs(scene.constants.E))
        assert scene.turning[0] <= scene.trajectory.theta.min() + 1e-9
        assert scene.trajectory.theta.max() <= scene.turning[1] + 1e-9
    assert time.process_time() - start < 2  # 0.5 s where nothing else runs; it was up to 9


@pytest.mark.parametrize("name, top", [
    ("I3", (-7.66, 1.919, 1e-300)), ("I1", (-1e6, 5e-324, 1e-323)), ("I3", (-8.55, 0.0124, 5e-324)),
    ("I3", (-1.891, 3.1e-11, 1e-13)), ("a", (-1e7, 1.0, 1.0)), ("I1", (0.07, 1e7, 1e7)),
])  # fmt: skip
def test_a_top_that_no_body_is_is_refused_at_once(name, top):
    with pytest.raises(TopError, match=f"^{name} = ") as error:
        solve(Top(*top), 7.0, 10.0, 0.5, 0.9)
    assert "allowed is" in str(error.value) and "thin" in str(error.value)
