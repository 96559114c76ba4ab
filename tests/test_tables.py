"""The runs on the three tables, without a browser: they are those of tippe_core, and do what the paper says."""

import re
from dataclasses import replace

import numpy as np
import pytest
from doubles import by_hand, lab_of, ran, told

from app.model.explorer import Explorer
from app.model.lab.examples import EXAMPLES
from app.model.lab.lab import scene_of
from app.model.lab.nudged import nudged
from app.model.lab.tracks import BUCKETS, extremes, tracks
from app.model.lab.wells import intervals, wells
from app.model.motion import for_reader, touches
from app.model.regimes import ENDS, FLIES, ROLLS, SLIPS
from app.model.run import THROWN, computed, on, watched
from app.model.setup import FARTHEST_TURN, LEAST_FRAMES, MOST_FRAMES, MOST_SECONDS, MOST_TURN, TABLES
from app.tabs.lab.words import ball_words, scatter_words
from app.text import speaking
from tippe_core import (
    Constants,
    Coulomb,
    Scales,
    State,
    Stretch,
    Top,
    TopError,
    glide,
    grip,
    jellett_potential,
    outcome,
    roll,
    slide,
    steady_states,
)

HAND = next(iter(EXAMPLES))


def example(name, **changes):
    """The Setup of one of EXAMPLES."""
    inputs = dict(EXAMPLES[name])
    return by_hand(inputs.pop("toy"), **inputs | changes)


def on_ordinary(start):
    return on(start, "ordinary")


@pytest.mark.slow
def test_the_papers_top_flips_only_where_it_slides():
    motions = scene_of("three", by_hand()).motions
    sliding = motions["ordinary"]
    assert sliding.tilt[0] < 90 and sliding.seconds[np.argmax(sliding.tilt > 90)] < sliding.seconds[-1] / 2
    assert sliding.tilt.max() > 90 and all(motions[table].tilt.max() < 90 for table in ("rough", "ice"))
    assert sliding.start.top == Top.paper()


# N. Rutstam, arXiv:1306.2470: launched at 25 rad/s it goes upright, at 60 it hangs at 1.908 +- 0.003, at 90 it inverts.
@pytest.mark.slow
@pytest.mark.parametrize("name, verdict, seconds, low, high", [
    ("fast", "turns over", 10.0, 3.1, np.pi), ("hangs", "hangs", 25.0, 1.905, 1.914),
    ("never", "goes upright", 25.0, 0, 0.01),
])  # fmt: skip
def test_the_three_regimes_of_top_S(name, verdict, seconds, low, high):
    start = example(f"Top S {name}", seconds=seconds)
    scene = scene_of("three", start)
    theta = scene.motions["ordinary"].trajectory.theta
    assert outcome(start.top, start.state).verdict == verdict
    assert np.all((theta[-50:] >= low) & (theta[-50:] <= high))
    for table in ("rough", "ice"):
        other = scene.motions[table].trajectory
        assert other.theta.max() < np.radians(6)
        assert np.all(other.omega[:, 2] > 0)


@pytest.mark.slow
def test_an_ordinary_top_rises_above_its_own_threshold():
    start = example("An ordinary top rises", seconds=6.0)
    top, limits = start.top, outcome(start.top, start.state).thresholds
    assert top.a < 0 and on_ordinary(start).trajectory.theta[-1] < np.radians(1)
    # physics.md: upright is stable if omega^2 > Mg|a|(1 - alpha)^2/(I3(1 - alpha) - I1)
    omega = np.sqrt(-top.a * (1 - top.a) ** 2 / (top.I3 * (1 - top.a) - top.I1))
    assert limits.upright.stable == "above" and limits.upright.spin == pytest.approx(omega, rel=1e-12)


@pytest.mark.slow
def test_all_three_are_tippe_cores_from_one_start():
    start = by_hand(law="coulomb", mu=0.2, mu_s=0.3, spin=15.0, tilt=25.0, slip=0.4, stem=False, seconds=2.0)
    scene, top = scene_of("three", start), Top.paper()
    spin, theta = 15 * 2 * np.pi * np.sqrt(0.016 / 9.81), np.radians(25)
    state = State(theta, 0, 0, spin, vx=-0.6 * spin * np.sin(theta), vy=0)
    assert scene.motions["ordinary"].t[-1] * start.scales.time == pytest.approx(2)
    for table in TABLES:
        found = scene.motions[table].trajectory
        expected = {"rough": lambda t: roll(top, None, t, grip(top, state)[0]), "ice": lambda t: glide(top, state, t),
                    "ordinary": lambda t: slide(top, state, Coulomb(0.2, 0.3), t)}[table](found.t)  # fmt: skip
        for name in ("theta", "omega", "slip", "com", "force"):
            assert getattr(found, name) == pytest.approx(getattr(expected, name), abs=1e-9)
    # the slip of the start: what G at rest has, 0.4 of it
    assert scene.motions["ordinary"].slip[0] == pytest.approx(0.4 * spin * np.sin(theta), rel=1e-12)
    assert [which for *_, which in scene.motions["ordinary"].stretches] == [SLIPS, ROLLS]


@pytest.mark.slow
def test_a_start_by_constants_is_the_rolling_motion():
    explorer = Explorer(given="share", K_J=7.0, K_R=10.0, energy=0.9, table="three")
    lab = lab_of(explorer)
    rough, scene = lab.scene.motions["rough"].trajectory, explorer.scene
    expected = roll(scene.top, scene.constants, rough.t)
    assert rough.theta == pytest.approx(expected.theta, abs=1e-9)
    assert rough.routh == pytest.approx(np.full(len(rough.t), scene.constants.K_R), abs=1e-9)
    for table in TABLES:
        assert lab.scene.motions[table].slip[0] == pytest.approx(0, abs=1e-12)
    explorer.set(K_J=6.0)
    assert lab.scene.motions["rough"].trajectory.jellett[0] == pytest.approx(6.0 * 0.399)


@pytest.mark.slow
@pytest.mark.parametrize("name", [HAND, "Top S hangs", "An ordinary top rises"])
def test_the_ledger_adds_up_and_heat_only_grows(name):
    motion = on_ordinary(example(name))
    ledger = motion.ledger
    total = sum(ledger.values())
    assert np.ptp(total) < 1e-6 * total[0]
    assert np.all(np.diff(ledger["heat"]) > -1e-9) and ledger["heat"][-1] > 0.005 * total[0]
    assert all(np.all(part > -1e-12) for part in ledger.values())


@pytest.mark.slow
def test_what_survives_on_each_table():
    motions = scene_of("three", by_hand(stem=False, tilt=60.0, spin=4.0, seconds=2.0)).motions
    stays = {table: {name for name, drift in motion.drift.items() if drift < 1e-7} for table, motion in motions.items()}
    assert stays == {"rough": {"J", "Routh", "E"}, "ice": {"J", "E", "L_3", "L_z"}, "ordinary": {"J"}}
    lost = [drift for motion in motions.values() for drift in motion.drift.values() if drift > 1e-7]
    assert min(lost) > 1e-4


@pytest.mark.slow
def test_the_stem_ends_what_one_contact_keeps():
    motion = on_ordinary(by_hand())
    until, event, drift = motion.alone
    shape, moved = motion.start.shape, motion.trajectory
    *_, last_but_one, last = moved.theta[moved.t < until]
    assert "stem" in event and last_but_one < last < shape.touch_angle < 2 * last - last_but_one
    assert drift < 1e-8 < motion.drift["J"]
    assert on_ordinary(by_hand(stem=False)).trajectory.theta[-1] > shape.touch_angle + 0.5


@pytest.mark.slow
def test_a_motion_that_stops_early_stands_still_to_the_end():
    rolling = Explorer(given="share", K_J=7.0, K_R=10.0, energy=0.9).let_go
    scene = scene_of("three", by_hand(rolling=rolling, landing="stop", seconds=3.0))
    motion = scene.motions["ordinary"]
    assert motion.ended == "lifts off" and motion.trajectory.t[-1] < 0.5 * motion.t[-1]
    assert motion.t[-1] == scene.motions["rough"].t[-1]
    assert motion.stretches[-1][2] == ENDS and motion.frames[-1][0] == SLIPS
    flies = on_ordinary(by_hand(rolling=rolling, seconds=3.0))
    assert not flies.ended and FLIES in {which for *_, which in flies.stretches}


@pytest.mark.slow
def test_a_stem_that_throws_the_top_up_is_not_the_table_that_lets_it_go():
    """slide() calls both "lifts off"; where it is the stem's first touch, the tilt then is that of the touch."""
    shape = by_hand().shape
    for omega3, event in ((5.0, THROWN), (15.0, "lifts off")):
        start = State(shape.touch_angle - 0.2, 3.0, 0.0, omega3, vx=0.0, vy=0.0)
        motion = on_ordinary(by_hand(rolling=start, seconds=0.02))
        until, found, _ = motion.alone
        assert found == event
        moved = slide(shape.top, start, motion.start.friction, np.linspace(0, until, 400), edge=shape.edge)
        assert (abs(moved.theta[-1] - shape.touch_angle) < 1e-3) == (event == THROWN)


def test_rough_and_ice_end_where_the_stem_touches():
    fast = State(1.9, 3.0, 0.0, 3.0, vx=0.0, vy=0.0)
    scene, _ = ran(rolling=fast, seconds=1.0)
    angle = scene.start.shape.touch_angle
    for table in ("rough", "ice"):
        motion = scene.motions[table]
        assert motion.ended == "stem touches" and angle - 0.1 < motion.trajectory.theta[-1] < angle
        assert f"At {motion.alone[0] * scene.start.scales.time:.2f} s its stem touches" in told(scene, table)
    whole, _ = ran(rolling=fast, seconds=1.0, stem=False)
    assert all(whole.motions[table].trajectory.theta.max() > angle for table in ("rough", "ice"))
    under, _ = ran(tilt=150.0, seconds=0.5)
    for table in ("rough", "ice"):
        assert under.motions[table] is None and "would be below this table" in told(under, table)


@pytest.mark.slow
def test_a_run_beside_the_run_tells_where_a_nudge_decides():
    little, much = (
        nudged(on_ordinary(by_hand(spin=spin, seconds=seconds))) for spin, seconds in ((18, 3.5), (38, 2.3))
    )
    assert little < 30 and much > 150
    assert not scatter_words(little) and "one of many" in scatter_words(much)
    assert 5 < nudged(on_ordinary(by_hand())) < 60


def test_the_times_of_a_slow_run_and_of_one_that_precesses_fast():
    settings = by_hand(spin=0.0, tilt=0.0, seconds=0.05)
    assert len(settings.times) == LEAST_FRAMES + 1 and settings.times[-1] * settings.scales.time == pytest.approx(0.05)
    fast = replace(settings, rolling=State(1.0, 0.0, 60.0, 0.0), seconds=2.0)
    assert 60.0 * np.diff(fast.times).max() < MOST_TURN


@pytest.mark.parametrize("top", [Top.paper(), Top(-2.0, 4.5, 1.0)])
def test_the_height_in_the_ledger_is_that_of_G_above_its_lowest_place(top):
    motion = on_ordinary(by_hand(top=top, shape=None, stem=False, tilt=60.0, seconds=0.5))
    height = motion.trajectory.com[:, 2]  # of G above the table, 1 - a cos(theta); least where 3 points up, or down
    assert motion.ledger["height"] == pytest.approx(height - (1 - abs(top.a)), abs=1e-12)


@pytest.mark.parametrize("table", TABLES)
def test_the_arrows_of_the_force_obey_newton(table):
    """F and the weight, along the axes of space, are what moves G: against second differences of its place."""
    start = State(1.0, 0.0, 3.0, 2.0, vx=1.0, vy=0.5)
    setup = by_hand(stem=False, rolling=start, law="viscous", gamma=0.5, seconds=0.1)
    motion = watched(setup, table, computed(setup, table)[0], whole=False)  # evenly spaced
    t, _, _, com, _, force, *_ = motion.frames
    step = t[1]
    acceleration = (com[2:] - 2 * com[1:-1] + com[:-2]) / step**2
    assert np.ptp(motion.trajectory.phi) > 1
    assert force[1:-1] - (0, 0, 1) == pytest.approx(acceleration, abs=0.01)


@pytest.mark.parametrize("late, touched", [(0.1, True), (0.01, False)])
def test_a_lift_off_is_laid_to_the_stem_where_the_top_has_come_to_touch_with_it(late, touched):
    """A tilt of 0.5 a unit of time, 0.05 short of the touch at the last sample before."""
    settings = by_hand()
    moved = roll(Top.paper(), None, [0.0, 1e-3, 1.0], State(settings.touch_angle - 0.05, 0.5, 0.0, 0.0))
    assert touches(moved, 1e-3 + late, settings) == touched


def test_a_run_of_which_no_while_is_on_the_ball_has_the_well_of_its_start_at_no_time():
    motion = on_ordinary(by_hand(seconds=0.5))
    on_stem = replace(motion.ending, stretches=(Stretch(0.0, motion.t[-1], "stem"),))
    (well,) = intervals(replace(motion, ending=on_stem), motion.start)
    start = motion.start.state
    assert well.end < 0
    # C_J of G at rest, spun about the axis: I3 omega_3 (cos(theta) - a)
    assert well.C_J == pytest.approx(0.408 * start.omega3 * (np.cos(start.theta) - 0.070), rel=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("name", [HAND, "Top S fast"])
def test_no_frame_turns_the_top_far(name):
    for motion in scene_of("three", example(name, seconds=2.0)).motions.values():
        q = motion.trajectory.quaternion
        turn = 2 * np.arccos(np.clip(np.abs((q[1:] * q[:-1]).sum(axis=1)), 0, 1))
        assert turn.max() < FARTHEST_TURN


# ---- limits ----


def test_a_run_that_can_go_no_further_shows_what_was_computed_and_says_why(monkeypatch):
    pushed = State(2.6, 0.0, 0.0, 0.0, vx=0.0, vy=-1.0)
    stuck = {"law": "coulomb", "mu": 1.0, "mu_s": 1.0, "rolling": pushed, "seconds": 0.5}
    _, said = ran(**stuck)
    assert said.startswith("It goes no further.") and "Painlevé’s limit" in said
    monkeypatch.setattr("tippe_core.motion.sliding.MOST_STEPS", 640)
    scene, said = ran(spin=38.0, seconds=60.0)
    motion = scene.motions["ordinary"]
    last = motion.trajectory.events[-1][0] * scene.start.scales.time
    assert not scene.refused and 0.1 < last < 59 and motion.t[-1] > motion.trajectory.t[-1]
    assert f"At {last:.2f} s it takes more steps than one run may compute" in said
    with speaking("de"):
        assert "Grenze nach Painlevé" in ran(**stuck)[1]


def test_a_limit_is_told_in_what_stands_beside_the_controls():
    scales = Scales.paper()
    error = for_reader(TopError("times", 1500.0, "at most {most:g}", "followed past t = {t:g}{unit}.",
                                most=1357.06, t=1357.06, unit=""), scales)  # fmt: skip
    assert (error.name, error.allowed) == ("seconds", "at most 54.81") and "t = 54.81 s" in error.remedy
    error = for_reader(TopError("theta", 2.6, "less than {most:g} for this top", most=2.07326), scales)
    assert (error.name, error.allowed) == ("tilt", "less than 118.8 for this top")
    assert error.value == pytest.approx(149.0, abs=0.05)
    error = for_reader(TopError("omega3", 10.0, "at most {most:g}", most=40), scales)
    assert (error.name, error.value) == ("spin", pytest.approx(10 * np.sqrt(9.81 / 0.016) / (2 * np.pi), rel=1e-5))


def test_the_longest_time_that_a_refusal_names_is_one_that_is_taken():
    settings = by_hand(spin=300.0, seconds=MOST_SECONDS)
    with pytest.raises(TopError) as error:
        settings.times  # noqa: B018
    most = float(re.search(r"at most ([\d.e+]+) s", error.value.allowed)[1])
    assert len(replace(settings, seconds=0.99 * most).times) == MOST_FRAMES + 1
    with pytest.raises(TopError):
        replace(settings, seconds=1.02 * most).times  # noqa: B018


@pytest.mark.slow
@pytest.mark.parametrize("inputs", [{"tilt": 0.0}, {"tilt": 180.0}, {"spin": 0.0}, {"tilt": 60.0, "spin": -20.0}])
def test_at_the_poles_and_without_spin_there_is_an_answer(inputs):
    scene, _ = ran(stem=False, seconds=1.0, **inputs)
    assert not scene.refused
    assert scene.start.state.theta == np.radians(inputs.get("tilt", 10.0))


def test_without_its_stem_the_ball_alone_is_drawn():
    """It could not stop at the table, and the stem would be seen to pass through it."""
    settings = by_hand()
    assert settings.drawn is settings.profile and settings.profile[:, 1].max() > 1.5
    alone = by_hand(stem=False).drawn
    assert np.allclose(np.hypot(*alone.T), 1, atol=1e-6)


@pytest.mark.parametrize(("law", "caught"), [("coulomb", True), ("contact", False)])
def test_a_top_that_coulombs_law_catches(law, caught):
    assert on_ordinary(by_hand(law=law, spin=30.0, tilt=5.0, seconds=3.0)).caught is caught


# ---- the bead in its well ----


@pytest.mark.slow
@pytest.mark.parametrize("law", ["contact", "viscous"])
def test_what_the_bead_has_left_stands_above_it(law):
    """Where pivoting changes C_J too: V_J is the least energy at any C_J."""
    motion = on_ordinary(by_hand(law=law, seconds=3.0))
    _, bead = wells(motion, motion.start)
    inside = bead.which >= 0
    assert inside.sum() > 100 and np.all(bead.E[inside] >= bead.V[inside])
    # at first its own C_J is that of the well to a few parts in a thousand, and what is left is the energy over V_J
    start = motion.trajectory
    assert bead.E[0] - bead.V[0] == pytest.approx(
        start.energy[0] - jellett_potential(start.theta[0], start.top, start.jellett[0]), abs=1e-9)  # fmt: skip


def heights(motion):
    """Of the ball's lowest point and of the lowest on the rim of the stem's end, straight from the pose; t in s."""
    moved = motion.trajectory
    x, y, z, w = moved.quaternion.T
    c, s = 1 - 2 * (x * x + y * y), 2 * np.hypot(x * z - w * y, y * z + w * x)
    radius, up, _ = motion.start.shape.edge
    centre = moved.com[:, 2] + moved.top.a * c
    return moved.t * motion.start.scales.time, centre - 1, centre + up * c - radius * s


def test_no_bead_is_above_the_energy_that_it_has():
    """V_J is the least energy at its J: drawn with another J it is not."""
    motion = on_ordinary(by_hand(spin=25.0))
    found, bead = wells(motion, motion.start)
    t = bead.t * motion.start.scales.time
    assert np.all(bead.V[bead.which >= 0] <= bead.E[bead.which >= 0] + 1e-9)
    times, _, stem = heights(motion)
    touching = np.abs(np.interp(t, times, stem)) < 1e-6
    assert np.all(bead.which[touching & (t > 2.45) & (t < 3.1)] == -1) and set(bead.which) == {-1, 0, 1}
    C_J = [each.C_J for each in intervals(motion, motion.start)]
    assert C_J == pytest.approx([2.37, 0.165], abs=0.005)
    assert found[0].places == pytest.approx(steady_states(motion.start.top, C_J[0]).theta)


# ---- what is shown over time ----


def test_a_fast_swing_keeps_its_width():
    """Of 9,000 values of a swing with 900 periods the curve has the least and the largest of each stretch, in order."""
    t = np.linspace(0, 1, 9_000)
    values = np.sin(2 * np.pi * 900 * t) * (1 + t)
    track = extremes(t, values)
    assert len(track.t) == 2 * BUCKETS and np.all(np.diff(track.t) >= 0)
    assert {*track.value} >= {values.min(), values.max()} and {*track.value} <= {*values}
    assert extremes(t[:800], values[:800]).value is not track.value and len(extremes(t[:800], values[:800]).t) == 800


def test_tracks_are_in_the_units_of_the_page():
    motion = on_ordinary(by_hand(seconds=1.0))
    scales = motion.start.scales
    found = tracks(motion.trajectory, scales)
    assert found["theta"].value[0] == pytest.approx(10.0) and found["omega3"].value[0] == pytest.approx(20.0)
    assert found["theta"].t[-1] == pytest.approx(1.0, abs=1e-3)
    metres = np.sqrt(scales.R * 9.81)  # R and (R/g)^1/2 in a second
    assert found["slip"].value.max() == pytest.approx(100 * metres * motion.slip.max(), rel=2e-3)
    given, state = motion.start, motion.start.state
    first = Constants.from_state(given.top, state.theta, state.theta_dot, state.omega2, state.omega3)
    assert [found[name].value[0] for name in ("K_J", "K_R")] == pytest.approx([first.K_J, first.K_R], rel=1e-9)
    assert 0.5 * given.mu < np.nanmax(found["ratio"].value) <= given.mu * (1 + 1e-6)  # no table gives more


def test_nothing_has_a_ratio_of_forces_in_the_air():
    """A top that is thrown up: by its stem, as its events say."""
    motion = on_ordinary(example("Flips" if "Flips" in EXAMPLES else HAND, seconds=2.0))
    found = tracks(motion.trajectory, motion.start.scales)["ratio"]
    assert np.isnan(found.value).any() == (motion.trajectory.force[:, 2] <= 0).any()


# ---- what is said ----


@pytest.mark.slow
def test_the_balls_verdict_is_of_the_ball_alone_and_void_from_the_stems_touch():
    scene, _ = ran(spin=25.0)
    said = re.sub(r"<[^>]*>", "", ball_words(scene))
    motion = scene.motions["ordinary"]
    moved, (t, ball, _) = motion.trajectory, heights(motion)
    first, J = t[ball > 1e-7][0], moved.jellett
    assert said.startswith("By the energy VJ of its ball alone, without a stem, and not by a run, ")
    assert f"no longer holds from {first:.2f} s on" in said and f"by {100 * np.ptp(J) / np.abs(J).max():.3g} %" in said
    assert "in this run it has not" in ball_words(ran(spin=5.0)[0])
    thrown = ran(spin=32.0, landing="stop", seconds=2.2)[0]
    assert thrown.motions["ordinary"].ended == THROWN and "no longer holds from 2.12 s on" in ball_words(thrown)
    assert "from the start" in ball_words(ran(tilt=150.0, seconds=0.5)[0])
    assert "stem" not in ball_words(ran(stem=False, seconds=0.5)[0])


def test_of_a_patch_nothing_is_said_to_come_given_time():
    """In none of 24 runs on a patch did what holds for a point come true: pivoting takes J."""
    scene, _ = ran(law="contact", seconds=1.0)
    J = scene.motions["ordinary"].trajectory.jellett
    said = ball_words(scene)
    assert "given time" not in said and f"in this run {100 * np.ptp(J) / np.abs(J).max():.3g} % of it" in said


def test_what_goes_past_90_degrees_is_not_said_to_stay_below():
    scene, _ = ran(spin=0.3, tilt=117.0, seconds=2.0)
    assert scene.motions["rough"].trajectory.theta.max() > np.pi / 2
    assert "turn over" not in told(scene, "rough")


@pytest.mark.slow
def test_true_stick_holds_it_and_the_page_says_when_and_that_it_rises_no_more():
    scene, said = ran(law="coulomb", mu_s=0.3)
    motion = scene.motions["ordinary"]
    moved = motion.trajectory
    since = moved.t[moved.regime == "roll"][0] * scene.start.scales.time
    assert 0.03 < since < 0.07 and moved.theta[moved.regime == "roll"].max() < np.radians(5.2)
    assert motion.rolls_since == pytest.approx(since, abs=0.008)
    assert f"At {since:.2f} s the table grips it, and it rolls." in said and "leaves it" not in said


def test_exactly_upright_it_stays_so_and_nobody_says_that_it_will_turn_over():
    scene, said = ran(tilt=0.0)
    assert np.all(scene.motions["ordinary"].trajectory.theta == 0)
    assert "out of an exact balance" in said and "leaves it" not in said
    assert "exactly in balance it stays as it is; nudged, it will turn over" in ball_words(scene)
    start = by_hand(tilt=0.001)
    assert outcome(start.top, start.state).verdict == "turns over"


DISC, CONE, PAPERS = "Disc on a peg", "Wooden cone", "The paper's tippe top"
NO_SPIN, FREE, STICKS = {"spin": 0.0}, {"law": "viscous", "gamma": 0.0}, {"law": "coulomb", "mu": 1.0, "mu_s": 1.0}
SAID = [
    (DISC, NO_SPIN | {"tilt": 10.0, "seconds": 1.0}, ["without a rim"], ["stem"]),
    (CONE, {"seconds": 5.0}, ["It stands upright", "At 5 s it still spins"], ["forever"]),
    (PAPERS, NO_SPIN | {"tilt": 180.0, "seconds": 0.2}, ["stands flat on the end of its stem"],
     ["smallest disturbance would"]),
    (PAPERS, FREE | NO_SPIN | {"tilt": 130.0, "seconds": 4.0}, ["impacts without a bounce have taken 0.265"],
     ["forever"]),
    (CONE, NO_SPIN | {"seconds": 3.0}, ["It lies still.", "no longer holds from"], ["goes on", "by 0 %"]),
    (PAPERS, FREE | {"spin": 30.0, "seconds": 1.0}, ["between 9.9° and 10.0°", "forever"], ["Rubbing", "upright"]),
    (DISC, {"seconds": 1.0}, [], ["is upright"]),
    (PAPERS, {"tilt": 0.001, "seconds": 3.0}, ["stable only below 6.9", "At 3 s it still spins"], ["hold it there"]),
    (PAPERS, NO_SPIN | {"tilt": 118.0}, [], ["turns over"]),
    (PAPERS, {"tilt": 90.0, "seconds": 0.2}, ["As an upright start of"], ["back past it", "below 90"]),
    (PAPERS, FREE | NO_SPIN | {"tilt": 179.0, "seconds": 1.0}, ["stands flat on the end of its stem"], ["forever"]),
    (PAPERS, STICKS | {"spin": 30.0, "tilt": 130.0, "seconds": 0.3}, ["Painlevé’s limit", "is not computed"],
     ["It stands on its stem"]),
]  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize(("body", "settings", "says", "nots"), SAID)
def test_what_is_said_is_so(body, settings, says, nots):
    scene, said = ran(body, **settings)
    said = re.sub(r"<[^>]*>", "", f"{said} {ball_words(scene)}")
    assert all(words in said for words in says), said
    assert not any(words in said for words in nots), said


@pytest.mark.slow
def test_stuck_since_its_last_touch_and_not_before():
    """A touch of 0.16 ms falls between two samples."""
    scene, said = ran(**STICKS | NO_SPIN | {"tilt": 130.0})
    motion = scene.motions["ordinary"]
    last = motion.ending.stretches[-1].start * scene.start.scales.time
    assert "The table grips it: it rolls." in said and motion.rolls_since >= round(last, 2) > 3


def deepest(motion):
    """The lowest point of the whole body in all of the run, above the table."""
    moved, (radius, z) = motion.trajectory, motion.start.shape.profile(400).T
    c, s = np.cos(moved.theta)[:, None], np.sin(moved.theta)[:, None]
    return (moved.com[:, 2:] + moved.top.a * c + (z * c - radius * s) / motion.start.shape.R).min()


@pytest.mark.parametrize(("body", "most"), [(DISC, 90.0), (CONE, 132.0)])
def test_no_other_part_of_the_body_is_below_the_table(body, most):
    """The disc lies on its side at a right angle; the cone on rim and stem at 180 degrees less atan(3/3.33)."""
    for tilt in (most + 1, 175.0, 180.0):
        with pytest.raises(TopError, match=f"at most {most:.0f}|at most 131.9"):
            on_ordinary(by_hand(body, tilt=tilt, seconds=0.1))
    assert deepest(on_ordinary(by_hand(body, tilt=most - 1, seconds=0.1))) > -1e-6
    fast = State(np.radians(most - 1), 3.0, 0.0, 0.0, vx=0.0, vy=0.0)
    scene, said = ran(body, rolling=fast, seconds=0.3)
    motion = scene.motions["ordinary"]
    assert deepest(motion) > -1e-6 and motion.ended == "another part touches"
    assert said.startswith("It goes no further.") and "nothing is computed here" in said
