"""The three planes without a browser: the motions are tippe_core's, and do what physics.md and the paper say."""

from dataclasses import replace
from queue import Queue

import numpy as np
import pytest

from app.builder import Builder
from app.explorer import Explorer
from app.planes import ENDS, MOST_TURN, PLANES, PRESETS, SLIPS, THROWN, Planes, solve
from app.runs import Runs
from app.three_planes import ThreePlanes, fate, verdict_words
from app.top3d import REGIMES
from tippe_core import PRESETS as BODIES
from tippe_core import Coulomb, State, Top, glide, roll, slide

HAND = next(iter(PRESETS))


@pytest.fixture
def explorer():
    return Explorer()


@pytest.fixture
def planes(explorer):
    return Planes(explorer, Builder(explorer))


def chosen(planes, name):
    planes.choose(name)
    assert not planes.picture.messages
    return planes.picture


def test_the_first_look_is_a_flip_and_only_where_it_slides(planes):
    motions = planes.picture.motions
    assert planes.plane == "sliding" and motions["sliding"].overturned < motions["sliding"].t[-1] / 2
    assert all(np.isnan(motions[plane].overturned) for plane in ("rough", "smooth"))
    assert planes.picture.settings.top == Top.paper()


# N. Rutstam, arXiv:1306.2470: launched at 25 rad/s it goes upright, at 60 it hangs at 1.908 +- 0.003, at 90 it inverts.
@pytest.mark.parametrize(
    "name, verdict, low, high",
    [("fast", "turns over", 3.1, np.pi), ("hangs", "hangs", 1.905, 1.914), ("never", "goes upright", 0, 0.01)],
)
def test_the_three_regimes_of_top_S(planes, name, verdict, low, high):
    picture = chosen(planes, f"Top S {name}")
    theta = picture.motions["sliding"].trajectory.theta
    assert picture.outcome.verdict == verdict
    assert np.all((theta[-50:] >= low) & (theta[-50:] <= high))
    for plane in ("rough", "smooth"):
        other = picture.motions[plane].trajectory
        assert other.theta.max() < np.radians(6)
        assert np.all(other.omega[:, 2] > 0)
    assert chosen(planes, f"no friction: {name}").state == picture.state and planes.plane == "smooth"


def test_an_ordinary_top_rises_above_its_own_threshold(planes):
    picture = chosen(planes, "An ordinary top rises")
    top, limits = picture.settings.top, picture.outcome.thresholds
    assert top.a < 0 and picture.motions["sliding"].trajectory.theta[-1] < np.radians(1)
    # physics.md: upright is stable if omega^2 > Mg|a|(1 - alpha)^2/(I3(1 - alpha) - I1)
    omega = np.sqrt(-top.a * (1 - top.a) ** 2 / (top.I3 * (1 - top.a) - top.I1))
    assert limits.upright.stable == "above" and limits.upright.spin == pytest.approx(omega, rel=1e-12)
    unit = picture.settings.scales.angular_velocity / (2 * np.pi)
    assert f"{omega * unit:.3g} rev/s" in picture.outcome.sentence


def test_all_three_are_tippe_cores_from_one_start(planes):
    planes.param.update(law="coulomb", mu_k=0.2, mu_s=0.3, spin=15.0, tilt=25.0, slip=0.4, stem=False, seconds=2.0)
    picture, scales, top = planes.picture, planes.picture.settings.scales, Top.paper()
    spin, theta = 15 * 2 * np.pi * np.sqrt(0.016 / 9.81), np.radians(25)
    state = State(theta, 0, 0, spin, vx=-0.6 * spin * np.sin(theta), vy=0)
    t = picture.motions["sliding"].t
    assert t[-1] * scales.time == pytest.approx(2)
    expected = {
        "rough": roll(top, None, t, State(theta, 0, 0, spin)),
        "smooth": glide(top, state, t),
        "sliding": slide(top, state, Coulomb(0.2, 0.3), t, landing="plastic"),
    }
    for plane in PLANES:
        found = picture.motions[plane].trajectory
        for name in ("theta", "omega", "slip", "com", "force"):
            assert getattr(found, name) == pytest.approx(getattr(expected[plane], name), abs=1e-9)
    # the slip of the start: what G at rest has, 0.4 of it
    assert picture.motions["sliding"].slip[0] == pytest.approx(0.4 * spin * np.sin(theta), rel=1e-12)
    words = [REGIMES[which] for *_, which in picture.motions["sliding"].stretches]
    assert words == ["slips", "rolls"]


def test_a_start_by_constants_is_the_motion_of_the_tab_roll(explorer, planes):
    planes.by = "constants"
    rough, scene = planes.picture.motions["rough"].trajectory, explorer.scene
    expected = roll(scene.top, scene.constants, rough.t)
    assert rough.theta == pytest.approx(expected.theta, abs=1e-9)
    assert rough.routh == pytest.approx(np.full(len(rough.t), scene.constants.K_R), abs=1e-9)
    for plane in PLANES:
        assert planes.picture.motions[plane].slip[0] == pytest.approx(0, abs=1e-12)
    explorer.K_J = 6.0
    planes.follow(explorer.scene)
    assert planes.picture.motions["rough"].trajectory.jellett[0] == pytest.approx(6.0 * 0.399)


@pytest.mark.parametrize("name", [HAND, "Top S hangs", "An ordinary top rises"])
def test_the_ledger_adds_up_and_heat_only_grows(planes, name):
    motion = chosen(planes, name).motions["sliding"]
    ledger = motion.ledger
    total = sum(ledger.values())
    assert np.ptp(total) < 1e-6 * total[0]
    assert np.all(np.diff(ledger["heat"]) > -1e-9) and ledger["heat"][-1] > 0.005 * total[0]
    assert all(np.all(part > -1e-12) for part in ledger.values())


def test_what_survives_on_each_plane(planes):
    planes.param.update(stem=False, tilt=60.0, spin=4.0, seconds=2.0)
    stays = {
        plane: {name for name, drift in motion.drift.items() if drift < 1e-7}
        for plane, motion in planes.picture.motions.items()
    }
    assert stays == {"rough": {"J", "Routh", "E"}, "smooth": {"J", "E", "L_3", "L_z"}, "sliding": {"J"}}
    lost = [drift for motion in planes.picture.motions.values() for drift in motion.drift.values() if drift > 1e-7]
    assert min(lost) > 1e-4


def test_the_stem_ends_what_one_contact_keeps(planes):
    until, event, drift = planes.picture.motions["sliding"].alone
    shape, moved = planes.picture.settings.shape, planes.picture.motions["sliding"].trajectory
    *_, last_but_one, last = moved.theta[moved.t < until]
    assert "stem" in event and last_but_one < last < shape.touch_angle < 2 * last - last_but_one
    assert drift < 1e-8 < planes.picture.motions["sliding"].drift["J"]
    planes.stem = False
    assert planes.picture.motions["sliding"].trajectory.theta[-1] > shape.touch_angle + 0.5


def test_a_motion_that_stops_early_stands_still_to_the_end(planes):
    planes.param.update(by="constants", landing="stop", seconds=3.0)
    motion = planes.picture.motions["sliding"]
    assert motion.ended == "lifts off" and motion.trajectory.t[-1] < 0.5 * motion.t[-1]
    assert motion.t[-1] == planes.picture.motions["rough"].t[-1]
    assert motion.stretches[-1][2] == ENDS and motion.frames[-1][0] == SLIPS
    planes.landing = "plastic"
    flies = planes.picture.motions["sliding"]
    assert not flies.ended and "in the air" in {REGIMES[which] for *_, which in flies.stretches}


def test_a_stem_that_throws_the_top_up_is_not_the_table_that_lets_it_go(planes):
    """slide() calls both "lifts off"; where it is the stem's first touch, the tilt then is that of the touch."""
    shape = planes.picture.settings.shape
    for omega3, event in ((5.0, THROWN), (15.0, "lifts off")):
        start = State(shape.touch_angle - 0.2, 3.0, 0.0, omega3, vx=0.0, vy=0.0)
        picture = solve(replace(planes.picture.settings, rolling=start, seconds=0.02))
        until, found, _ = picture.motions["sliding"].alone
        assert found == event
        moved = slide(shape.top, start, picture.friction, np.linspace(0, until, 400), edge=shape.edge)
        assert (abs(moved.theta[-1] - shape.touch_angle) < 1e-3) == (event == THROWN)
        assert ("its stem touches and throws it up" in fate(picture, "sliding")) == (event == THROWN)


def test_hops_at_much_spin_are_said_to_be_chaotic(planes):
    for omega3, chaotic in ((22.0, True), (15.0, False)):
        start = State(1.9, 3.0, 0.0, omega3, vx=0.0, vy=0.0)
        picture = solve(replace(planes.picture.settings, rolling=start, seconds=0.02))
        assert "air" in picture.motions["sliding"].trajectory.regime
        assert ("chaotic" in verdict_words(picture)) == chaotic


@pytest.mark.parametrize("name", [HAND, "Top S fast"])
def test_no_frame_turns_the_top_far(planes, name):
    for motion in chosen(planes, name).motions.values():
        q = motion.trajectory.quaternion
        turn = 2 * np.arccos(np.clip(np.abs((q[1:] * q[:-1]).sum(axis=1)), 0, 1))
        assert turn.max() < MOST_TURN + 1e-6


BAD = [
    ("tilt", {"tilt": 200.0}),
    ("spin", {"spin": float("nan")}),
    ("slip", {"slip": float("inf")}),
    ("seconds", {"seconds": 0.0}),
    ("seconds", {"seconds": 61.0}),
    ("seconds", {"seconds": 60.0, "spin": 400.0}),
    ("mu_s", {"law": "coulomb", "mu_k": 0.5, "mu_s": 0.4}),
    ("gamma", {"law": "viscous", "gamma": -1.0}),
    ("eps", {"eps": 0.0}),
    ("mu", {"mu": -0.1}),
]


def test_a_bad_value_is_said_and_the_last_good_picture_stays(planes):
    planes.param.update(seconds=1.0)
    before = planes.picture
    for control, inputs in BAD:
        good = {name: getattr(planes, name) for name in inputs}
        planes.param.update(**inputs)
        assert list(planes.picture.messages) == [control]
        assert planes.picture.motions is before.motions and planes.picture.settings is before.settings
        planes.param.update(**good)
        assert not planes.picture.messages
        before = planes.picture


def test_at_the_poles_and_without_spin_there_is_an_answer(planes):
    planes.stem = False
    for inputs in ({"tilt": 0.0}, {"tilt": 180.0}, {"tilt": 10.0, "spin": 0.0}, {"tilt": 60.0, "spin": -20.0}):
        planes.param.update(seconds=1.0, **inputs)
        assert not planes.picture.messages
        assert planes.picture.state.theta == np.radians(inputs["tilt"])


def test_a_preset_brings_its_body(explorer, planes):
    body = next(body for body in BODIES if body.name == "Top S")
    assert chosen(planes, "Top S fast").settings.top == body.shape.top == explorer.scene.top
    assert planes.picture.settings.scales.R == explorer.scene.scales.R == 0.02


def test_of_many_asked_for_at_once_the_newest_is_shown_and_a_run_can_be_stopped(explorer):
    posted, shown = Queue(), []
    planes = Planes(explorer, Builder(explorer), Runs(posted.put))

    def finish():
        while planes.busy:
            posted.get(timeout=60)()

    finish()
    planes.param.watch(lambda event: shown.append(event.new), "picture")
    for tilt in (11.0, 12.0, 13.0, 14.0):
        planes.tilt = tilt
    finish()
    assert [picture.settings.tilt for picture in shown] == [11.0, 14.0]

    # an undo puts back the body first, then the inputs: one run, of both
    explorer.param.update(a=0.08)
    planes.follow(explorer.scene)
    planes.tilt = 15.0
    finish()
    assert [(picture.settings.top.a, picture.settings.tilt) for picture in shown[2:]] == [(0.08, 15.0)]

    last = planes.picture
    planes.param.update(eps=1e-4, seconds=60.0)
    planes.stop()
    finish()
    assert "Stopped" in planes.picture.messages["run"] and planes.picture.motions is last.motions
    planes.param.update(eps=0.1, seconds=5.0)
    finish()
    assert not planes.picture.messages and planes.picture.settings.seconds == 5.0


def test_a_place_on_the_map_keeps_I3(explorer, planes):
    view = ThreePlanes(planes, Builder(explorer), explorer.param.update)
    view.pick(0.2, 0.9)
    assert explorer.scene.top == Top(0.2, 0.9 * 0.408, 0.408)
