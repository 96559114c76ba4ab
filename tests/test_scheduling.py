"""A stream of requests: only the newest is solved, pictures follow in turn, and what has to wait is shown at rest."""

import json

import numpy as np
import pytest

import app.model.bodies
import app.model.explorer
import app.model.frames
import app.model.region
import app.model.scene
from app.widgets.controls import Controls
from app.widgets.scheduling import RenderScheduler
from tippe_core import (
    Lathe,
    Top,
)


@pytest.fixture
def scheduler(explorer, monkeypatch):
    """With three pictures, of which the second fails; drawn lists what was drawn."""
    drawn, timers, failing = [], [], []
    for module in ("scheduling", "rest"):
        monkeypatch.setattr(f"app.widgets.{module}.after", lambda seconds, then: timers.append(then))

    def fails(scene):
        raise ZeroDivisionError

    scheduler = RenderScheduler(explorer)
    scheduler.shows(lambda scene: drawn.append("hand"), "hand")
    for picture in (lambda scene: drawn.append("first"), lambda scene: failing and fails(scene),
                    lambda scene: drawn.append("last")):  # fmt: skip
        scheduler.shows(picture, "pictures")
    scheduler.shows(lambda scene: drawn.append("words"), "rest")
    drawn.clear()
    failing.append(True)
    scheduler.timers, scheduler.drawn = timers, drawn
    return scheduler


def test_a_picture_that_fails_keeps_no_other_back(scheduler):
    scheduler.ask(K_J=6.5)
    with pytest.raises(ZeroDivisionError):
        scheduler.painted.painted = scheduler.painted.sent
    assert scheduler.drawn == ["hand", "first", "last", "words"]


def test_a_hand_comes_to_rest_also_where_a_picture_fails(scheduler):
    for K_J in (6.5, 6.6, 6.7):
        scheduler.ask(K_J=K_J)
    scheduler._rest._last -= 1  # as if long ago
    scheduler._hands.clear()
    with pytest.raises(ZeroDivisionError):
        while scheduler.timers:
            scheduler.timers.pop()()
            scheduler._drawing.clear()
    scheduler.drawn.clear()
    scheduler._drawing.clear()
    scheduler.ask(K_J=6.8)
    assert scheduler._single and scheduler.drawn[0] == "hand"


def test_what_cannot_be_is_said_at_the_control_that_was_used(explorer, scheduler):
    controls = Controls(explorer.scene, scheduler.ask)
    controls.face = "state"
    for name in ("omega3", "theta_dot"):
        before = explorer.scene
        controls._request(name, 9e6, typed=True)
        controls.show(explorer.scene)
        assert explorer.scene.messages and explorer.scene.rolling is before.rolling
        assert [*json.loads(controls.numbers.view.state)["messages"]] == [name]
        controls._request(name, 0.5, typed=True)
        scheduler._hands.clear()
        controls.show(explorer.scene)


@pytest.mark.parametrize("upper", [True, False])
def test_the_plane_reaches_to_the_poles_and_to_the_motion(upper):
    """From 0 to P = 8.36508, where the paper draws it, and with half a unit of room beside a K_J outside."""
    for K_J in (-12.3, -3.4, 0.0, 4.0, 8.3, 9.4, 9.6, 30.2):
        low, high = app.model.region.K_J_range(Top.paper(), K_J, 10.0, upper)
        assert low <= 0 and high >= 8.36508 and low <= K_J <= high
        assert upper or low < -8.708  # the inverted pole's
        if K_J < (0 if upper else -10.9):
            assert 0.5 <= K_J - low < 1.5 and low == round(low)
        if K_J > (8.37 if upper else 10.5):
            assert 0.5 <= high - K_J < 1.5 and high == round(high)


def test_a_top_without_spin_has_a_plane_all_the_same():
    assert app.model.region.K_J_range(Top.paper(), 0.0, 0.0, True) == (-1.0, 1.0)
    assert app.model.region.K_J_range(Top.paper(), 5.0, 0.0, True) == (-1.0, 6.0)


def test_the_curve_of_the_energy_goes_past_both_turning_points(explorer):
    """Also where they are one, in a steady precession."""
    for share in (0.0, 1.0):
        explorer.set(energy=share)
        theta, least = explorer.scene.potential
        inner, outer = explorer.scene.turning
        assert theta[0] < inner - 0.02 and outer + 0.02 < theta[-1]
        assert least[0] > explorer.scene.constants.E < least[-1]


def test_a_body_of_many_corners_is_drawn_with_all_of_them():
    points = tuple((0.01 + 1e-3 * (i % 2), 1e-4 * i) for i in range(400))
    drawn = app.model.bodies.body(Lathe(R=0.01, points=points, density=700.0))
    assert all(np.hypot(*(drawn - np.array(point) / 0.01).T).min() < 1e-12 for point in points)


def test_the_stand_in_of_a_body_that_is_not_known():
    """A ball, where G is below O or little above it; else a disc about G, on a peg of radius R."""
    for a in (0.5, 0.07, 0.0, -0.25):
        radius, height = app.model.bodies.outline(Top(a, 0.4, 0.4)).T
        np.testing.assert_allclose(np.hypot(radius, height), 1, atol=1e-12)
    radius, height = app.model.bodies.outline(Top(-2.0, 3.0, 2.25)).T
    wide = radius == radius.max()
    assert radius.max() == pytest.approx(1.5 * 1.5) and height[wide].mean() == pytest.approx(2.0)
    assert height.min() == pytest.approx(-1.0)
    assert radius[-1] == 0 and height[-1] == height[-2] == height.max() > height[wide].max()
