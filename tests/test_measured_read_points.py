"""Two points on the axis, seen from the side or from above: the numbers of a film that an own body made come back."""

import math

import measured_bodies as bodies
import numpy as np
import pytest
from test_measured_fit import from_here

from app.model.measured.data import settled
from app.model.measured.fit import fit
from app.model.measured.motion import model_of, residuals_of
from app.model.measured.table import read

T = np.arange(bodies.FRAMES) / bodies.RATE


def moved(seed):
    _, top, scales, truth = bodies.case(seed)
    return top, scales, truth, bodies.moved(seed, T)[0]


@pytest.fixture(scope="module")
def filmed():
    return moved(0)


@pytest.mark.parametrize("view", ["side", "above"])
def test_the_true_motion_leaves_nothing_but_noise_in_either_picture(view, filmed):
    """The camera's direction and the points' distance are fitted, whatever they are called and wherever the ball is."""
    top, scales, truth, axis = filmed
    table = read(bodies.tracked(("A", "B"), T, bodies.pictures(axis, view)))
    assert table.view == view
    data = settled(table)
    assert {*data.series} == ({"axis_x", "axis_y"} if view == "above" else {"axis_side", "axis_up"})
    left = residuals_of(model_of("smoothed", top, scales).with_values(truth), data)
    assert left.row @ left.row == pytest.approx(len(left.row), abs=4 * math.sqrt(2 * len(left.row)))
    length = np.hypot(*(left.values[name] for name in data.series))
    if view == "above":
        np.testing.assert_allclose(length, bodies.APART * np.hypot(*axis.T[:2]), atol=bodies.BLUR)
    away = truth | {"spin": 1.05 * truth["spin"]}
    other = residuals_of(model_of("smoothed", top, scales).with_values(away), data).row
    assert other @ other > 2 * len(other)


@pytest.mark.parametrize("view", ["side", "above"])
def test_the_wrong_view_does_not_fit(view, filmed):
    top, scales, truth, axis = filmed
    other = {"side": "above", "above": "side"}[view]
    data = settled(read(bodies.tracked(("stem", "ball"), T, bodies.pictures(axis, view))).of("", other))
    left = residuals_of(model_of("smoothed", top, scales).with_values(truth), data).row
    assert left @ left > 10 * len(left)


def test_one_angle_from_the_side_is_that_of_the_axis_in_the_picture(filmed):
    """Tracker's position angle of the stem's end, in degrees from +x, with the origin in the ball."""
    top, scales, truth, axis = filmed
    stem, ball = bodies.pictures(axis, "side", noise=0.0)
    turn = np.degrees(np.arctan2(*(stem - ball).T[::-1])) + np.random.default_rng(3).normal(size=len(axis))
    rows = "".join(f"{t:.6E}\t{each:.6E}\n" for t, each in zip(T, turn, strict=False))
    data = settled(read("t (s)\t\u03b8r (deg) \u00b1 1\n" + rows))
    left = residuals_of(model_of("smoothed", top, scales).with_values(truth), data).row
    assert left @ left == pytest.approx(len(left), abs=4 * math.sqrt(2 * len(left)))


@pytest.mark.slow
@pytest.mark.parametrize("view", ["side", "above"])
def test_a_film_of_two_points_gives_the_numbers_of_its_motion(view, filmed, monkeypatch):
    top, scales, truth, axis = filmed
    from_here(truth, monkeypatch)
    held = {name: truth[name] for name in ("mu", "eps")}  # the rest of them: tests/measured_proof.py
    found = fit(
        model_of("smoothed", top, scales, **held),
        settled(read(bodies.tracked(("stem", "ball"), T, bodies.pictures(axis, view)))),
    )
    off = bodies.off_truth(found, truth)
    assert len(off) == 2 and max(abs(each) for _, each in off) < 3.5 and not found.refused
