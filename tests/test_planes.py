"""The three planes without a browser: the motions are those of tippe_core, and do what the paper says."""

from dataclasses import replace
from queue import Queue

import numpy as np
import pytest
from house import chosen, planes_of, ran

from app.model.explorer import Explorer
from app.model.motion import THROWN, touches
from app.model.planes.planes import PRESETS
from app.model.planes.run import nudged, solve
from app.model.planes.wells import intervals
from app.model.regimes import ENDS, FLIES, ROLLS, SLIPS
from app.model.runs import Runs
from app.model.setup import LEAST_FRAMES, MOST_TURN, TABLES
from app.tabs.planes.words import fate, scatter_words
from tippe_core import Coulomb, State, Stretch, Top, glide, grip, roll, slide

HAND = next(iter(PRESETS))


@pytest.fixture
def explorer():
    return Explorer()


@pytest.fixture
def planes(explorer):
    return planes_of(explorer)


@pytest.mark.slow
def test_the_first_look_is_a_flip_and_only_where_it_slides(explorer, planes):
    motions = planes.picture.motions
    sliding = motions["ordinary"]
    assert planes.plane == "ordinary" and sliding.starts_below and sliding.crossings[0] < sliding.t[-1] / 2
    assert not any(len(motions[plane].crossings) for plane in ("rough", "ice"))
    assert planes.picture.settings.top == Top.paper()


# N. Rutstam, arXiv:1306.2470: launched at 25 rad/s it goes upright, at 60 it hangs at 1.908 +- 0.003, at 90 it inverts.
@pytest.mark.slow
@pytest.mark.parametrize(
    "name, verdict, low, high",
    [("fast", "turns over", 3.1, np.pi), ("hangs", "hangs", 1.905, 1.914), ("never", "goes upright", 0, 0.01)],
)
def test_the_three_regimes_of_top_S(explorer, planes, name, verdict, low, high):
    picture = chosen(explorer, planes, f"Top S {name}")
    theta = picture.motions["ordinary"].trajectory.theta
    assert picture.outcome.verdict == verdict
    assert np.all((theta[-50:] >= low) & (theta[-50:] <= high))
    for plane in ("rough", "ice"):
        other = picture.motions[plane].trajectory
        assert other.theta.max() < np.radians(6)
        assert np.all(other.omega[:, 2] > 0)
    planes.ask(table="ice")
    assert chosen(explorer, planes, f"Top S {name}").state == picture.state and planes.plane == "ice"


@pytest.mark.slow
def test_an_ordinary_top_rises_above_its_own_threshold(explorer, planes):
    picture = chosen(explorer, planes, "An ordinary top rises")
    top, limits = picture.settings.top, picture.outcome.thresholds
    assert top.a < 0 and picture.motions["ordinary"].trajectory.theta[-1] < np.radians(1)
    # physics.md: upright is stable if omega^2 > Mg|a|(1 - alpha)^2/(I3(1 - alpha) - I1)
    omega = np.sqrt(-top.a * (1 - top.a) ** 2 / (top.I3 * (1 - top.a) - top.I1))
    assert limits.upright.stable == "above" and limits.upright.spin == pytest.approx(omega, rel=1e-12)


@pytest.mark.slow
def test_all_three_are_tippe_cores_from_one_start(explorer, planes):
    planes.ask(law="coulomb", mu=0.2, mu_s=0.3, spin=15.0, tilt=25.0, slip=0.4, stem=False, seconds=2.0)
    picture, scales, top = planes.picture, planes.picture.settings.scales, Top.paper()
    spin, theta = 15 * 2 * np.pi * np.sqrt(0.016 / 9.81), np.radians(25)
    state = State(theta, 0, 0, spin, vx=-0.6 * spin * np.sin(theta), vy=0)
    t = picture.motions["ordinary"].t
    assert t[-1] * scales.time == pytest.approx(2)
    expected = {
        "rough": roll(top, None, t, grip(top, state)[0]),
        "ice": glide(top, state, t),
        "ordinary": slide(top, state, Coulomb(0.2, 0.3), t),
    }
    for plane in TABLES:
        found = picture.motions[plane].trajectory
        for name in ("theta", "omega", "slip", "com", "force"):
            assert getattr(found, name) == pytest.approx(getattr(expected[plane], name), abs=1e-9)
    # the slip of the start: what G at rest has, 0.4 of it
    assert picture.motions["ordinary"].slip[0] == pytest.approx(0.4 * spin * np.sin(theta), rel=1e-12)
    assert [which for *_, which in picture.motions["ordinary"].stretches] == [SLIPS, ROLLS]


@pytest.mark.slow
def test_a_start_by_constants_is_the_motion_of_the_tab_roll(explorer, planes):
    explorer.param.update(given="share", K_J=7.0, K_R=10.0, energy=0.9)
    planes.follow(explorer.scene)
    rough, scene = planes.picture.motions["rough"].trajectory, explorer.scene
    expected = roll(scene.top, scene.constants, rough.t)
    assert rough.theta == pytest.approx(expected.theta, abs=1e-9)
    assert rough.routh == pytest.approx(np.full(len(rough.t), scene.constants.K_R), abs=1e-9)
    for plane in TABLES:
        assert planes.picture.motions[plane].slip[0] == pytest.approx(0, abs=1e-12)
    explorer.K_J = 6.0
    planes.follow(explorer.scene)
    assert planes.picture.motions["rough"].trajectory.jellett[0] == pytest.approx(6.0 * 0.399)


@pytest.mark.slow
@pytest.mark.parametrize("name", [HAND, "Top S hangs", "An ordinary top rises"])
def test_the_ledger_adds_up_and_heat_only_grows(explorer, planes, name):
    motion = chosen(explorer, planes, name).motions["ordinary"]
    ledger = motion.ledger
    total = sum(ledger.values())
    assert np.ptp(total) < 1e-6 * total[0]
    assert np.all(np.diff(ledger["heat"]) > -1e-9) and ledger["heat"][-1] > 0.005 * total[0]
    assert all(np.all(part > -1e-12) for part in ledger.values())


@pytest.mark.slow
def test_what_survives_on_each_plane(explorer, planes):
    planes.ask(stem=False, tilt=60.0, spin=4.0, seconds=2.0)
    stays = {
        plane: {name for name, drift in motion.drift.items() if drift < 1e-7}
        for plane, motion in planes.picture.motions.items()
    }
    assert stays == {"rough": {"J", "Routh", "E"}, "ice": {"J", "E", "L_3", "L_z"}, "ordinary": {"J"}}
    lost = [drift for motion in planes.picture.motions.values() for drift in motion.drift.values() if drift > 1e-7]
    assert min(lost) > 1e-4


@pytest.mark.slow
def test_the_stem_ends_what_one_contact_keeps(explorer, planes):
    until, event, drift = planes.picture.motions["ordinary"].alone
    shape, moved = planes.picture.settings.shape, planes.picture.motions["ordinary"].trajectory
    *_, last_but_one, last = moved.theta[moved.t < until]
    assert "stem" in event and last_but_one < last < shape.touch_angle < 2 * last - last_but_one
    assert drift < 1e-8 < planes.picture.motions["ordinary"].drift["J"]
    planes.ask(stem=False)
    assert planes.picture.motions["ordinary"].trajectory.theta[-1] > shape.touch_angle + 0.5


@pytest.mark.slow
def test_a_motion_that_stops_early_stands_still_to_the_end(explorer, planes):
    explorer.param.update(given="share", K_J=7.0, K_R=10.0, energy=0.9)
    planes.ask(landing="stop", seconds=3.0)
    motion = planes.picture.motions["ordinary"]
    assert motion.ended == "lifts off" and motion.trajectory.t[-1] < 0.5 * motion.t[-1]
    assert motion.t[-1] == planes.picture.motions["rough"].t[-1]
    assert motion.stretches[-1][2] == ENDS and motion.frames[-1][0] == SLIPS
    planes.ask(landing="plastic")
    flies = planes.picture.motions["ordinary"]
    assert not flies.ended and FLIES in {which for *_, which in flies.stretches}


@pytest.mark.slow
def test_a_stem_that_throws_the_top_up_is_not_the_table_that_lets_it_go(explorer, planes):
    """slide() calls both "lifts off"; where it is the stem's first touch, the tilt then is that of the touch."""
    shape = planes.picture.settings.shape
    for omega3, event in ((5.0, THROWN), (15.0, "lifts off")):
        start = State(shape.touch_angle - 0.2, 3.0, 0.0, omega3, vx=0.0, vy=0.0)
        picture = solve(replace(planes.picture.settings, rolling=start, seconds=0.02))
        until, found, _ = picture.motions["ordinary"].alone
        assert found == event
        moved = slide(shape.top, start, picture.friction, np.linspace(0, until, 400), edge=shape.edge)
        assert (abs(moved.theta[-1] - shape.touch_angle) < 1e-3) == (event == THROWN)
        assert ("its stem touches and throws it up" in fate(picture, "ordinary")) == (event == THROWN)


@pytest.fixture(scope="module")
def usual():
    """The default picture."""
    return planes_of(Explorer()).picture


def test_rough_and_smooth_end_where_the_stem_touches(usual):
    fast = State(1.9, 3.0, 0.0, 3.0, vx=0.0, vy=0.0)
    picture = solve(replace(usual.settings, rolling=fast, seconds=1.0))
    angle = usual.settings.shape.touch_angle
    for plane in ("rough", "ice"):
        motion = picture.motions[plane]
        assert motion.ended == "stem touches" and angle - 0.1 < motion.trajectory.theta[-1] < angle
        assert f"At {motion.alone[0] * picture.settings.scales.time:.2f} s its stem touches" in fate(picture, plane)
    whole = solve(replace(usual.settings, rolling=fast, seconds=1.0, stem=False))
    assert all(whole.motions[plane].trajectory.theta.max() > angle for plane in ("rough", "ice"))
    under, _ = ran(usual, tilt=150.0, seconds=0.5)
    for plane in ("rough", "ice"):
        assert under.motions[plane] is None and "below the table" in fate(under, plane)


@pytest.mark.slow
def test_a_run_beside_the_run_tells_where_a_nudge_decides(usual, explorer):
    calm, _ = ran(usual, spin=18.0, seconds=3.5)
    wild, _ = ran(usual, spin=38.0, seconds=2.3)
    little, much = nudged(calm), nudged(wild)
    assert little < 30 and much > 150
    assert not scatter_words(replace(calm, growth=little))
    assert "one of many" in scatter_words(replace(wild, growth=much))
    posted = Queue()
    threaded = planes_of(explorer, Runs(posted.put))
    while threaded.picture is None or threaded.picture.growth is None:
        posted.get(timeout=120)()
    assert 5 < threaded.picture.growth < 60


def test_the_times_of_a_slow_run_and_of_one_that_precesses_fast(explorer, planes):
    settings = replace(planes.picture.settings, spin=0.0, tilt=0.0, seconds=0.05)
    assert len(settings.times) == LEAST_FRAMES + 1 and settings.times[-1] * settings.scales.time == pytest.approx(0.05)
    fast = replace(settings, rolling=State(1.0, 0.0, 60.0, 0.0), seconds=2.0)
    assert 60.0 * np.diff(fast.times).max() < MOST_TURN


@pytest.mark.parametrize("top", [Top.paper(), Top(-2.0, 4.5, 1.0)])
def test_the_height_in_the_ledger_is_that_of_G_above_its_lowest_place(explorer, planes, top):
    settings = replace(planes.picture.settings, top=top, shape=None, stem=False, tilt=60.0, seconds=0.5)
    motion = solve(settings).motions["ordinary"]
    height = motion.trajectory.com[:, 2]  # of G above the table, 1 - a cos(theta); least where 3 points up, or down
    assert motion.ledger["height"] == pytest.approx(height - (1 - abs(top.a)), abs=1e-12)


@pytest.mark.parametrize("plane", TABLES)
def test_the_arrows_of_the_force_obey_newton(explorer, planes, plane):
    """F and the weight, along the axes of space, are what moves G: against second differences of its place."""
    start = State(1.0, 0.0, 3.0, 2.0, vx=1.0, vy=0.5)
    settings = replace(planes.picture.settings, stem=False, rolling=start, law="viscous", gamma=0.5, seconds=0.1)
    motion = solve(settings).motions[plane]
    t, _, _, com, _, force, *_ = motion.frames
    step = t[1]
    acceleration = (com[2:] - 2 * com[1:-1] + com[:-2]) / step**2
    assert np.ptp(motion.trajectory.phi) > 1
    assert force[1:-1] - (0, 0, 1) == pytest.approx(acceleration, abs=0.01)


@pytest.mark.parametrize("late, touched", [(0.1, True), (0.01, False)])
def test_a_lift_off_is_laid_to_the_stem_where_the_top_has_come_to_touch_with_it(explorer, planes, late, touched):
    """A tilt of 0.5 a unit of time, 0.05 short of the touch at the last sample before."""
    settings = planes.picture.settings
    moved = roll(Top.paper(), None, [0.0, 1e-3, 1.0], State(settings.touch_angle - 0.05, 0.5, 0.0, 0.0))
    assert touches(moved, 1e-3 + late, settings) == touched


def test_a_run_of_which_no_while_is_on_the_ball_has_the_well_of_its_start_at_no_time(explorer, planes):
    picture = planes.picture
    motion = picture.motions["ordinary"]
    end = motion.ending
    on_stem = replace(end, stretches=(Stretch(0.0, motion.t[-1], "stem"),))
    moved = replace(picture, motions={"ordinary": replace(motion, ending=on_stem)})
    (well,) = intervals(moved, "ordinary")
    assert well.end < 0 and well.C_J == picture.outcome.C_J


def test_a_start_past_a_right_angle_has_not_overturned_where_it_falls_back(explorer, planes):
    """Without spin, 100 degrees up: it falls to the other side of a right angle, which is no turning over."""
    settings = replace(planes.picture.settings, stem=False, tilt=100.0, spin=0.0, seconds=0.3)
    motion = solve(settings).motions["ordinary"]
    assert len(motion.crossings) and not motion.starts_below


@pytest.mark.slow
@pytest.mark.parametrize("name", [HAND, "Top S fast"])
def test_no_frame_turns_the_top_far(explorer, planes, name):
    for motion in chosen(explorer, planes, name).motions.values():
        q = motion.trajectory.quaternion
        turn = 2 * np.arccos(np.clip(np.abs((q[1:] * q[:-1]).sum(axis=1)), 0, 1))
        assert turn.max() < MOST_TURN + 1e-6
