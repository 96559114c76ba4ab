"""What is said of a run on the three planes is what the run does."""

import re

import numpy as np
import pytest
from house import of, planes_of, ran

from app.model.explorer import Explorer
from app.model.motion import THROWN
from app.model.planes.run import solve
from app.model.planes.tracks import BUCKETS, extremes, tracks
from app.model.planes.wells import intervals
from app.tabs.planes import plots
from app.tabs.planes.words import ball_words, fate
from app.text import speaking
from tippe_core import State, TopError


@pytest.fixture
def explorer():
    return Explorer()


# ---- what is said of a run is what the run does ----


@pytest.fixture(scope="module")
def usual():
    """The first look's picture."""
    return planes_of(Explorer()).picture


def heights(picture):
    """Of the ball's lowest point and of the lowest on the rim of the stem's end, straight from the pose; t in s."""
    moved = picture.motions["ordinary"].trajectory
    x, y, z, w = moved.quaternion.T
    c, s = 1 - 2 * (x * x + y * y), 2 * np.hypot(x * z - w * y, y * z + w * x)
    radius, up, _ = picture.settings.shape.edge
    centre = moved.com[:, 2] + moved.top.a * c
    return moved.t * picture.settings.scales.time, centre - 1, centre + up * c - radius * s


@pytest.mark.slow
def test_the_default_run_is_told_with_all_its_touches(usual):
    picture, said = ran(usual)
    t, ball, stem = heights(picture)
    off = t[ball > 1e-7]
    assert f"on its ball until {off[0]:.2f} s, then for 8.2 ms on its stem alone" in said
    assert np.sum((ball > 1e-7) & (t < off[0] + 0.02)) == pytest.approx(8.2e-3 / t[1], abs=1)
    both = t[np.flatnonzero((ball > 1e-7) | (stem > 1e-6))[-1] + 1]
    assert f"and from {both:.2f} s to the end on both ball and stem" in said
    assert "118.8° at 5 s" in said and said.startswith("It leans and goes round.")
    with speaking("de"):
        assert "8,2 ms lang auf dem Stiel allein" in fate(picture, "ordinary")


@pytest.mark.slow
def test_on_its_way_back_it_does_not_turn_over(usual):
    """After 60 s it is upright: what 5 s show of it is cut."""
    for spin in (25.0, 35.0):
        picture, said = ran(usual, spin=spin)
        theta = picture.motions["ordinary"].trajectory.theta
        assert theta[-1] < theta[-1000] and not said.startswith("It turns over")
        assert "Its motion is computed only up to 5 s. The top goes on." in said
    picture, said = ran(usual, spin=25.0, seconds=60.0)
    theta = np.degrees(picture.motions["ordinary"].trajectory.theta)
    assert theta[-1] < 0.2 and f"{theta[-1]:.1f}° at 60 s" in said and "It stands upright" in said


@pytest.mark.slow
def test_the_balls_verdict_is_of_the_ball_alone_and_void_from_the_stems_touch(usual):
    picture, _ = ran(usual, spin=25.0)
    said = re.sub(r"<[^>]*>", "", ball_words(picture))
    moved, (t, ball, _) = picture.motions["ordinary"].trajectory, heights(picture)
    first, J = t[ball > 1e-7][0], moved.jellett
    assert said.startswith("By the energy VJ of its ball alone, without a stem, and not by a run, ")
    assert f"no longer holds from {first:.2f} s on" in said and f"by {100 * np.ptp(J) / np.abs(J).max():.3g} %" in said
    assert "in this run it has not" in ball_words(ran(usual, spin=5.0)[0])
    thrown = ran(usual, spin=32.0, landing="stop", seconds=2.2)[0]
    assert thrown.motions["ordinary"].ended == THROWN and "no longer holds from 2.12 s on" in ball_words(thrown)
    assert "from the start" in ball_words(ran(usual, tilt=150.0, seconds=0.5)[0])
    assert "stem" not in ball_words(ran(usual, stem=False, seconds=0.5)[0])


def test_of_a_patch_nothing_is_said_to_come_given_time(usual):
    """In none of 24 runs on a patch did what holds for a point come true: pivoting takes J."""
    picture, _ = ran(usual, law="contact", seconds=1.0)
    J = picture.motions["ordinary"].trajectory.jellett
    said = ball_words(picture)
    assert "given time" not in said and f"in this run {100 * np.ptp(J) / np.abs(J).max():.3g} % of it" in said


def test_what_goes_past_90_degrees_is_not_said_to_stay_below(usual):
    picture, _ = ran(usual, spin=0.3, tilt=117.0, seconds=2.0)
    assert picture.motions["rough"].trajectory.theta.max() > np.pi / 2
    assert "turn over" not in fate(picture, "rough")


@pytest.mark.slow
def test_true_stick_holds_it_and_the_page_says_when_and_that_it_rises_no_more(usual):
    picture, said = ran(usual, law="coulomb", mu_s=0.3)
    moved = picture.motions["ordinary"].trajectory
    since = moved.t[moved.regime == "roll"][0] * picture.settings.scales.time
    assert 0.03 < since < 0.07 and moved.theta[moved.regime == "roll"].max() < np.radians(5.2)
    assert picture.motions["ordinary"].rolls_since == pytest.approx(since, abs=0.008)
    assert f"At {since:.2f} s the table grips it, and it rolls." in said and "leaves it" not in said


def test_of_a_rolling_top_all_of_its_nutation_is_told(usual):
    """Its last tenth is less than one swing here."""
    picture, said = ran(usual, law="coulomb", spin=0.0, tilt=60.0, seconds=1.0, slip=0.5)
    moved = picture.motions["ordinary"].trajectory
    theta = np.degrees(moved.theta[moved.regime == "roll"])
    assert f"between {theta.min():.0f}° and {theta.max():.0f}°" in said and "forever" in said
    assert np.ptp(theta) > 1.5 * np.ptp(theta[-len(theta) // 10 :])
    moved, said = ran(usual, law="coulomb", spin=0.0, tilt=60.0, seconds=0.2, slip=0.5)
    assert "forever" not in said and "back and forth" not in said


def test_exactly_upright_it_stays_so_and_nobody_says_that_it_will_turn_over(usual):
    picture, said = ran(usual, tilt=0.0)
    assert np.all(picture.motions["ordinary"].trajectory.theta == 0)
    assert "0.0° at 5 s" in said and "out of an exact balance" in said and "leaves it" not in said
    assert "exactly in balance it stays as it is; nudged, it will turn over" in ball_words(picture)
    assert ran(usual, tilt=0.001, seconds=1.0)[0].outcome.verdict == "turns over"


def test_no_bead_is_above_the_energy_that_it_has(usual):
    """V_J is the least energy at its J: drawn with another J it is not."""
    picture, _ = ran(usual, spin=25.0)
    well = plots.Well()
    well.show(picture, "ordinary")
    t, V, E, which = (np.array(well.path.data[name]) for name in ("t", "V", "E", "well"))
    assert np.all(V[which >= 0] <= E[which >= 0] + 1e-9)
    times, _, stem = heights(picture)
    touching = np.abs(np.interp(t, times, stem)) < 1e-6
    assert np.all(which[touching & (t > 2.45) & (t < 3.1)] == -1) and set(which) == {-1, 0, 1}
    C_J = [found.C_J for found in intervals(picture, "ordinary")]
    assert C_J == pytest.approx([2.37, 0.165], abs=0.005)  # of the issue


def test_a_fast_swing_keeps_its_width():
    """Of 9,000 values of a swing with 900 periods the curve has the least and the largest of each stretch, in order."""
    t = np.linspace(0, 1, 9_000)
    values = np.sin(2 * np.pi * 900 * t) * (1 + t)
    track = extremes(t, values)
    assert len(track.t) == 2 * BUCKETS and np.all(np.diff(track.t) >= 0)
    assert {*track.value} >= {values.min(), values.max()} and {*track.value} <= {*values}
    assert extremes(t[:800], values[:800]).value is not track.value and len(extremes(t[:800], values[:800]).t) == 800


def test_tracks_are_in_the_units_of_the_page(usual):
    picture, _ = ran(usual, seconds=1.0)
    motion, scales = picture.motions["ordinary"], picture.settings.scales
    found = tracks(motion, scales)
    assert found["theta"].value[0] == pytest.approx(picture.settings.tilt)
    assert found["omega3"].value[0] == pytest.approx(picture.settings.spin)
    assert found["theta"].t[-1] == pytest.approx(1.0, abs=1e-3)
    metres = np.sqrt(scales.R * 9.81)  # R and (R/g)^1/2 in a second
    assert found["slip"].value.max() == pytest.approx(100 * metres * motion.slip.max(), rel=2e-3)


def all_said(settings):
    picture = solve(settings)
    return picture, re.sub(r"<[^>]*>", "", " ".join((fate(picture, "ordinary"), ball_words(picture))))


DISC, CONE, PAPERS = "Disc on a peg", "Wooden cone", "The paper's tippe top"
NO_SPIN, FREE, STICKS = {"spin": 0.0}, {"law": "viscous", "gamma": 0.0}, {"law": "coulomb", "mu": 1.0, "mu_s": 1.0}
SAID = [
    (DISC, NO_SPIN | {"tilt": 10.0, "seconds": 1.0}, ["on both ball and rim", "without a rim"], ["stem"]),
    (CONE, {"seconds": 5.0}, ["It stands upright", "The top goes on."], ["forever"]),
    (PAPERS, NO_SPIN | {"tilt": 180.0, "seconds": 0.2}, ["stands flat on the end of its stem"],
     ["smallest disturbance would"]),
    (PAPERS, FREE | NO_SPIN | {"tilt": 130.0, "seconds": 4.0}, ["impacts without a bounce have taken 0.265"],
     ["forever"]),
    (CONE, NO_SPIN | {"seconds": 3.0}, ["It lies still.", "no longer holds from"], ["goes on", "by 0 %"]),
    (PAPERS, FREE | {"spin": 30.0, "seconds": 1.0}, ["between 9.9° and 10.0°", "forever"], ["Rubbing", "upright"]),
    (DISC, {"seconds": 1.0}, [], ["is upright"]),
    (PAPERS, {"tilt": 0.001, "seconds": 3.0}, ["stable only below 6.9", "The top goes on."], ["hold it there"]),
    (PAPERS, NO_SPIN | {"tilt": 118.0}, [], ["turns over"]),
    (PAPERS, {"tilt": 90.0, "seconds": 0.2}, ["As an upright start of"], ["back past it", "below 90"]),
    (PAPERS, NO_SPIN | {"tilt": 119.0, "seconds": 1.0}, ["It is for ", "and after that to the end on its ball"],
     ["0.00 s"]),
    (PAPERS, FREE | NO_SPIN | {"tilt": 179.0, "seconds": 1.0}, ["stands flat on the end of its stem"], ["forever"]),
    ("Uniform ball", {}, ["in the last tenth of the time 1.8° to 3.9°"], ["forever"]),
    (PAPERS, STICKS | {"spin": 30.0, "tilt": 130.0, "seconds": 0.3}, ["Painlevé’s limit", "is not computed"],
     ["It stands on its stem"]),
]  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize(("body", "settings", "says", "nots"), SAID)
def test_what_is_said_is_so(body, settings, says, nots):
    _, said = all_said(of(body, **settings))
    assert all(words in said for words in says), said
    assert not any(words in said for words in nots), said


@pytest.mark.slow
def test_stuck_since_its_last_touch_and_not_before():
    """A touch of 0.16 ms falls between two samples."""
    picture, said = all_said(of(PAPERS, **STICKS | NO_SPIN | {"tilt": 130.0}))
    last = picture.motions["ordinary"].ending.stretches[-1].start * picture.settings.scales.time
    assert "The table grips it: it rolls." in said and picture.motions["ordinary"].rolls_since >= round(last, 2) > 3


def deepest(picture):
    """The lowest point of the whole body in all of the run, above the table."""
    moved, (radius, z) = picture.motions["ordinary"].trajectory, picture.settings.shape.profile(400).T
    c, s = np.cos(moved.theta)[:, None], np.sin(moved.theta)[:, None]
    return (moved.com[:, 2:] + moved.top.a * c + (z * c - radius * s) / picture.settings.shape.R).min()


@pytest.mark.parametrize(("body", "most"), [(DISC, 90.0), (CONE, 132.0)])
def test_no_other_part_of_the_body_is_below_the_table(body, most):
    """The disc lies on its side at a right angle; the cone on rim and stem at 180 degrees less atan(3/3.33)."""
    for tilt in (most + 1, 175.0, 180.0):
        with pytest.raises(TopError, match=f"at most {most:.0f}|at most 131.9"):
            solve(of(body, tilt=tilt, seconds=0.1))
    assert deepest(solve(of(body, tilt=most - 1, seconds=0.1))) > -1e-6
    fast = State(np.radians(most - 1), 3.0, 0.0, 0.0, vx=0.0, vy=0.0)
    picture, said = all_said(of(body, rolling=fast, seconds=0.3))
    assert deepest(picture) > -1e-6 and picture.motions["ordinary"].ended == "another part touches"
    assert said.startswith("It goes no further.") and "nothing is computed here" in said
