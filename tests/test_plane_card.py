"""Fig. 6 and what follows when a motion leaves its tieline, without a browser."""

import json

import numpy as np
import pytest

from app.model.explorer import Explorer
from app.model.start import arrives
from app.widgets.plane_card import PlaneCard
from tippe_core import Constants, Top, roll


@pytest.fixture
def card():
    """A PlaneCard that sends requests to an Explorer, and shows its scenes when nothing is dragged."""
    explorer, slid = Explorer(), []
    card = PlaneCard(lambda **inputs: explorer.set(**inputs), lambda: slid.append("slips"))
    card.explorer, card.slid = explorer, slid

    def show(scene):
        card.plane.show_selected(scene)
        card.plane.show_plane(scene)
        card.show_path(scene)

    explorer.param.watch(lambda event: show(event.new), "scene")
    show(explorer.scene)
    return card


def state(card):
    return json.loads(card.plane.state)


def rows(values, width, kind="<f4"):
    """The columns of the bytes of a table."""
    return np.frombuffer(values, kind).reshape(-1, width).T


def test_all_tilts_are_shown_and_the_papers_own_by_one_switch(card):
    assert state(card)["theta_range"] == [0, np.pi]
    card.explorer.set(upper="paper")
    assert state(card)["theta_range"] == [0, pytest.approx(1.03 * 1.6943, abs=1e-3)]


def test_the_limits_arrive_as_they_are(card):
    """To the last digit, because they decide whether a place rolls."""
    plane = card.explorer.scene.plane
    K_J, lift_in, slip_in, slip_out, lift_out, verge, lift_verge, steady, slip_E, *_ = np.frombuffer(
        card.plane.limits, "<f8"
    ).reshape(11, -1)
    pairs = ((K_J, plane.K_J), (lift_in, plane.lift.theta_inner), (slip_in, plane.slip.theta_inner),
             (slip_out, plane.slip.theta_outer), (lift_out, plane.lift.theta_outer), (verge, plane.slip.theta_verge),
             (lift_verge, plane.lift.theta_verge), (steady, plane.lift.theta_steady),
             (slip_E, plane.slip.E))  # fmt: skip
    assert all(np.array_equal(ours, theirs, equal_nan=True) for ours, theirs in pairs)


@pytest.mark.parametrize("inputs", [{}, {"energy": 1e-9}, {"K_J": 0.1, "K_R": 0.1}, {"K_R": 300.0, "K_J": 100.0}])
def test_the_bead_has_one_nutation_of_the_motion(card, inputs):
    card.explorer.set(**inputs)
    scene = card.explorer.scene
    t, theta = rows(card.plane.motion, 2)
    period = state(card)["period"]
    assert len(t) <= 129 and t[0] == 0 and np.ptp(np.diff(t)) < 1e-5 * t[-1]
    assert t[-1] > 0.99 * period or t[-1] > 0.99 * scene.trajectory.t[-1]
    c = scene.constants
    expected = roll(Top.paper(), Constants(c.K_J, c.K_R, c.E), t.astype(float)).theta
    assert theta == pytest.approx(expected, abs=1e-5)


def test_a_move_of_a_hand_is_a_small_message(card):
    """And only that: what is the same for all motions is sent once."""
    told = {}
    card.plane.param.watch(lambda *events: told.update({e.name: e.new for e in events}), ["state", "motion", "limits",
                                                                                      "field", "path"])  # fmt: skip
    card.plane.show_selected(Explorer(K_J=6.5).scene)
    assert {*told} == {"state", "motion", "path"} and sum(map(len, told.values())) < 1500


def test_the_path_leaves_the_tieline_by_its_end_and_is_that_motions_alone(card):
    theta, low, high, K_J, K_R = rows(card.plane.path, 5)
    assert theta[0] == np.float32(card.explorer.scene.turning[1]) and K_J[0] == pytest.approx(7)
    assert theta[-1] > np.pi / 2 and K_R[-1] < 0 and np.all((low <= theta + 1e-6) & (theta <= high + 1e-6))
    said = state(card)
    assert 0 < said["touches"] < len(theta) and np.degrees(said["touch"]) == pytest.approx(119, abs=0.5)
    before = card.explorer.scene
    card.plane.show_selected(Explorer(K_J=6.0).scene)
    assert not card.plane.path and "touches" not in state(card)
    card.show_path(before)
    assert card.plane.path


def test_where_it_would_slip_there_is_a_road(card):
    assert state(card)["roads"] == []
    card.explorer.set(energy=1.5)
    assert state(card)["roads"] == ["slip"]
    card.plane.pressed = [1, "slip"]
    assert card.slid == ["slips"]


@pytest.mark.parametrize("sent", [[1, "elsewhere"], [1], ["slip", 1], [1, ["slip"]]])
def test_what_no_button_sends_is_passed_over(card, sent):
    before = card.explorer.scene
    card.plane.pressed = sent
    assert card.slid == [] and card.explorer.scene is before


def test_a_toy_that_was_gripped_is_shown_from_near_and_one_press_shows_the_papers_top(card):
    assert not state(card)["near"] and "paper" not in state(card)["roads"]
    card.explorer.set(**arrives())
    said = state(card)
    assert np.degrees([said["inner"], said["outer"]]) == pytest.approx((1.2, 5.7), abs=0.05)
    assert said["near"] and "paper" in said["roads"]
    card.plane.pressed = [1, "paper"]
    assert card.explorer.scene.top == Top.paper() and card.explorer.scene.constants.K_J == 7
    assert not state(card)["near"] and "paper" not in state(card)["roads"]


def test_a_picture_of_before_is_named_while_a_value_is_refused(card):
    assert state(card)["old"] is None
    card.explorer.set(K_J=1e99)
    assert card.explorer.scene.messages and state(card)["old"] == ["7", "10", "27.9804"]
    assert state(card)["K_J"] == 7 and card.plane.path
    card.explorer.set(K_J=6.5)
    assert state(card)["old"] is None
