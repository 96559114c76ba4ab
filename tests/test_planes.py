"""The three planes without a browser: the motions are tippe_core's, and do what physics.md and the paper say."""

import re
from dataclasses import replace
from functools import cache
from queue import Queue

import numpy as np
import pytest
from house import builder_of, choose, planes_of

from app.model.explorer import Explorer
from app.model.planes.picture import LEAST_FRAMES, MOST_FRAMES, MOST_SECONDS, MOST_TURN, PLANES
from app.model.planes.planes import PRESETS
from app.model.planes.run import THROWN, for_reader, nudged, solve, touches
from app.model.planes.tracks import BUCKETS, extremes, tracks
from app.model.planes.wells import wells, whiles
from app.model.regimes import ENDS, FLIES, ROLLS, SLIPS
from app.model.runs import Runs
from app.tabs.planes import plots
from app.tabs.planes.three_planes import ThreePlanes
from app.tabs.planes.words import ball_words, fate, scatter_words
from app.text import speaking
from tippe_core import PRESETS as BODIES
from tippe_core import Coulomb, Scales, State, Stretch, Top, TopError, glide, grip, jellett_potential, roll, slide

HAND = next(iter(PRESETS))


@pytest.fixture
def explorer():
    return Explorer()


@pytest.fixture
def planes(explorer):
    return planes_of(explorer)


def chosen(explorer, planes, name):
    choose(name, explorer, planes)
    assert not planes.picture.messages
    return planes.picture


@pytest.mark.slow
def test_the_first_look_is_a_flip_and_only_where_it_slides(explorer, planes):
    motions = planes.picture.motions
    sliding = motions["sliding"]
    assert planes.plane == "sliding" and sliding.starts_below and sliding.crossings[0] < sliding.t[-1] / 2
    assert not any(len(motions[plane].crossings) for plane in ("rough", "smooth"))
    assert planes.picture.settings.top == Top.paper()


# N. Rutstam, arXiv:1306.2470: launched at 25 rad/s it goes upright, at 60 it hangs at 1.908 +- 0.003, at 90 it inverts.
@pytest.mark.slow
@pytest.mark.parametrize(
    "name, verdict, low, high",
    [("fast", "turns over", 3.1, np.pi), ("hangs", "hangs", 1.905, 1.914), ("never", "goes upright", 0, 0.01)],
)
def test_the_three_regimes_of_top_S(explorer, planes, name, verdict, low, high):
    picture = chosen(explorer, planes, f"Top S {name}")
    theta = picture.motions["sliding"].trajectory.theta
    assert picture.outcome.verdict == verdict
    assert np.all((theta[-50:] >= low) & (theta[-50:] <= high))
    for plane in ("rough", "smooth"):
        other = picture.motions[plane].trajectory
        assert other.theta.max() < np.radians(6)
        assert np.all(other.omega[:, 2] > 0)
    planes.ask(table="ice")
    assert chosen(explorer, planes, f"Top S {name}").state == picture.state and planes.plane == "smooth"


@pytest.mark.slow
def test_an_ordinary_top_rises_above_its_own_threshold(explorer, planes):
    picture = chosen(explorer, planes, "An ordinary top rises")
    top, limits = picture.settings.top, picture.outcome.thresholds
    assert top.a < 0 and picture.motions["sliding"].trajectory.theta[-1] < np.radians(1)
    # physics.md: upright is stable if omega^2 > Mg|a|(1 - alpha)^2/(I3(1 - alpha) - I1)
    omega = np.sqrt(-top.a * (1 - top.a) ** 2 / (top.I3 * (1 - top.a) - top.I1))
    assert limits.upright.stable == "above" and limits.upright.spin == pytest.approx(omega, rel=1e-12)
    unit = picture.settings.scales.angular_velocity / (2 * np.pi)
    assert f"{omega * unit:.3g} rev/s" in picture.outcome.sentence


@pytest.mark.slow
def test_all_three_are_tippe_cores_from_one_start(explorer, planes):
    planes.ask(law="coulomb", mu=0.2, mu_s=0.3, spin=15.0, tilt=25.0, slip=0.4, stem=False, seconds=2.0)
    picture, scales, top = planes.picture, planes.picture.settings.scales, Top.paper()
    spin, theta = 15 * 2 * np.pi * np.sqrt(0.016 / 9.81), np.radians(25)
    state = State(theta, 0, 0, spin, vx=-0.6 * spin * np.sin(theta), vy=0)
    t = picture.motions["sliding"].t
    assert t[-1] * scales.time == pytest.approx(2)
    expected = {
        "rough": roll(top, None, t, grip(top, state)[0]),
        "smooth": glide(top, state, t),
        "sliding": slide(top, state, Coulomb(0.2, 0.3), t, landing="plastic"),
    }
    for plane in PLANES:
        found = picture.motions[plane].trajectory
        for name in ("theta", "omega", "slip", "com", "force"):
            assert getattr(found, name) == pytest.approx(getattr(expected[plane], name), abs=1e-9)
    # the slip of the start: what G at rest has, 0.4 of it
    assert picture.motions["sliding"].slip[0] == pytest.approx(0.4 * spin * np.sin(theta), rel=1e-12)
    assert [which for *_, which in picture.motions["sliding"].stretches] == [SLIPS, ROLLS]


@pytest.mark.slow
def test_a_start_by_constants_is_the_motion_of_the_tab_roll(explorer, planes):
    explorer.param.update(given="share", K_J=7.0, K_R=10.0, energy=0.9)
    planes.follow(explorer.scene)
    rough, scene = planes.picture.motions["rough"].trajectory, explorer.scene
    expected = roll(scene.top, scene.constants, rough.t)
    assert rough.theta == pytest.approx(expected.theta, abs=1e-9)
    assert rough.routh == pytest.approx(np.full(len(rough.t), scene.constants.K_R), abs=1e-9)
    for plane in PLANES:
        assert planes.picture.motions[plane].slip[0] == pytest.approx(0, abs=1e-12)
    explorer.K_J = 6.0
    planes.follow(explorer.scene)
    assert planes.picture.motions["rough"].trajectory.jellett[0] == pytest.approx(6.0 * 0.399)


@pytest.mark.slow
@pytest.mark.parametrize("name", [HAND, "Top S hangs", "An ordinary top rises"])
def test_the_ledger_adds_up_and_heat_only_grows(explorer, planes, name):
    motion = chosen(explorer, planes, name).motions["sliding"]
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
    assert stays == {"rough": {"J", "Routh", "E"}, "smooth": {"J", "E", "L_3", "L_z"}, "sliding": {"J"}}
    lost = [drift for motion in planes.picture.motions.values() for drift in motion.drift.values() if drift > 1e-7]
    assert min(lost) > 1e-4


@pytest.mark.slow
def test_the_stem_ends_what_one_contact_keeps(explorer, planes):
    until, event, drift = planes.picture.motions["sliding"].alone
    shape, moved = planes.picture.settings.shape, planes.picture.motions["sliding"].trajectory
    *_, last_but_one, last = moved.theta[moved.t < until]
    assert "stem" in event and last_but_one < last < shape.touch_angle < 2 * last - last_but_one
    assert drift < 1e-8 < planes.picture.motions["sliding"].drift["J"]
    planes.ask(stem=False)
    assert planes.picture.motions["sliding"].trajectory.theta[-1] > shape.touch_angle + 0.5


@pytest.mark.slow
def test_a_motion_that_stops_early_stands_still_to_the_end(explorer, planes):
    explorer.param.update(given="share", K_J=7.0, K_R=10.0, energy=0.9)
    planes.ask(landing="stop", seconds=3.0)
    motion = planes.picture.motions["sliding"]
    assert motion.ended == "lifts off" and motion.trajectory.t[-1] < 0.5 * motion.t[-1]
    assert motion.t[-1] == planes.picture.motions["rough"].t[-1]
    assert motion.stretches[-1][2] == ENDS and motion.frames[-1][0] == SLIPS
    planes.ask(landing="plastic")
    flies = planes.picture.motions["sliding"]
    assert not flies.ended and FLIES in {which for *_, which in flies.stretches}


@pytest.mark.slow
def test_a_stem_that_throws_the_top_up_is_not_the_table_that_lets_it_go(explorer, planes):
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


# ---- what is said of a run is what the run does ----


@pytest.fixture(scope="module")
def usual():
    """The first look's picture."""
    return planes_of(Explorer()).picture


def ran(usual, **settings):
    """A Picture with other settings than the first look's, and what is said of it, without its marks."""
    picture = solve(replace(usual.settings, **settings))
    return picture, re.sub(r"<[^>]*>", "", fate(picture, "sliding"))


def heights(picture):
    """Of the ball's lowest point and of the lowest on the rim of the stem's end, straight from the pose; t in s."""
    moved = picture.motions["sliding"].trajectory
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
    assert said.startswith("leans on ball and stem: 118.8° at 5 s") and "turn" not in said
    with speaking("de"):
        assert "8,2 ms lang auf dem Stiel allein" in fate(picture, "sliding")


@pytest.mark.slow
def test_on_its_way_back_it_does_not_turn_over(usual):
    """After 60 s it is upright: what 5 s show of it is cut."""
    for spin in (25.0, 35.0):
        picture, said = ran(usual, spin=spin)
        theta = picture.motions["sliding"].trajectory.theta
        assert theta[-1] < theta[-1000] and said.startswith("is still on its way")
        assert "The end of the 5 s merely cuts it: its tilt still falls." in said
    picture, said = ran(usual, spin=25.0, seconds=60.0)
    theta = np.degrees(picture.motions["sliding"].trajectory.theta)
    assert theta[-1] < 0.2 and said.startswith(f"is upright: {theta[-1]:.1f}° at 60 s")
    assert "so it stays" in said


@pytest.mark.slow
def test_the_balls_verdict_is_of_the_ball_alone_and_void_from_the_stems_touch(usual):
    picture, _ = ran(usual, spin=25.0)
    said = re.sub(r"<[^>]*>", "", ball_words(picture))
    moved, (t, ball, _) = picture.motions["sliding"].trajectory, heights(picture)
    first, J = t[ball > 1e-7][0], moved.jellett
    assert said.startswith("What friction would do to its ball alone, without a stem, while it slips: ")
    assert f"void from {first:.2f} s on" in said and f"by {100 * np.ptp(J) / np.abs(J).max():.3g} %" in said
    assert "in this run it has not" in ball_words(ran(usual, spin=5.0)[0])
    thrown = ran(usual, spin=32.0, landing="stop", seconds=2.2)[0]
    assert thrown.motions["sliding"].ended == THROWN and "void from 2.12 s on" in ball_words(thrown)
    assert "from the start" in ball_words(ran(usual, tilt=150.0, seconds=0.5)[0])
    assert "stem" not in ball_words(ran(usual, stem=False, seconds=0.5)[0])


@pytest.mark.slow
def test_true_stick_holds_it_and_the_page_says_when_and_that_it_rises_no_more(usual):
    picture, said = ran(usual, law="coulomb", mu_s=0.3)
    moved = picture.motions["sliding"].trajectory
    since = moved.t[moved.regime == "roll"][0] * picture.settings.scales.time
    assert 0.03 < since < 0.07 and moved.theta[moved.regime == "roll"].max() < np.radians(5.2)
    told = float(re.search(r"True stick has held it since ([\d.]+) s", said)[1])
    assert told == pytest.approx(since, abs=0.008) and "never rises further" in said


def test_of_a_rolling_top_all_of_its_nutation_is_told(usual):
    """Its last tenth is less than one swing here."""
    picture, said = ran(usual, law="coulomb", spin=0.0, tilt=60.0, seconds=1.0, slip=0.5)
    moved = picture.motions["sliding"].trajectory
    theta = np.degrees(moved.theta[moved.regime == "roll"])
    assert f"between {theta.min():.1f}° and {theta.max():.1f}°: rolling" in said
    assert np.ptp(theta) > 1.5 * np.ptp(theta[-len(theta) // 10 :])
    moved, said = ran(usual, law="coulomb", spin=0.0, tilt=60.0, seconds=0.2, slip=0.5)
    assert "before it has swung once" in said and "never rises" not in said


def test_exactly_upright_it_stays_so_and_nobody_says_that_it_will_turn_over(usual):
    picture, said = ran(usual, tilt=0.0)
    assert np.all(picture.motions["sliding"].trajectory.theta == 0)
    assert said.startswith("stays exactly as it is: 0.0° at 5 s") and "merely cuts" not in said
    assert "exactly in balance it stays as it is; nudged, it will turn over" in ball_words(picture)
    assert ran(usual, tilt=0.001, seconds=1.0)[0].outcome.verdict == "turns over"


def test_no_bead_is_above_the_energy_that_it_has(usual):
    """V_J is the least energy at its J: drawn with another J it is not."""
    picture, _ = ran(usual, spin=25.0)
    well = plots.Well()
    well.show(picture, "sliding")
    t, V, E, which = (np.array(well.path.data[name]) for name in ("t", "V", "E", "well"))
    assert np.all(V[which >= 0] <= E[which >= 0] + 1e-9)
    times, _, stem = heights(picture)
    touching = np.abs(np.interp(t, times, stem)) < 1e-6
    assert np.all(which[touching & (t > 2.45) & (t < 3.1)] == -1) and set(which) == {-1, 0, 1}
    C_J = [found.C_J for found in whiles(picture, "sliding")]
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
    motion, scales = picture.motions["sliding"], picture.settings.scales
    found = tracks(motion, scales)
    assert found["theta"].value[0] == pytest.approx(picture.settings.tilt)
    assert found["omega3"].value[0] == pytest.approx(picture.settings.spin)
    assert found["theta"].t[-1] == pytest.approx(1.0, abs=1e-3)
    metres = np.sqrt(scales.R * 9.81)  # R and (R/g)^1/2 in a second
    assert found["slip"].value.max() == pytest.approx(100 * metres * motion.slip.max(), rel=2e-3)


@cache
def first_of(body):
    explorer = Explorer()
    builder = builder_of(explorer)
    builder.choose(body)
    return planes_of(explorer).picture.settings


def of(body, **settings):
    """The Settings of the first look with another body."""
    return replace(first_of(body), **settings)


def all_said(settings):
    picture = solve(settings)
    return picture, re.sub(r"<[^>]*>", "", " ".join((fate(picture, "sliding"), ball_words(picture))))


DISC, CONE, PAPERS = "Disc on a peg", "Wooden cone", "The paper's tippe top"
NO_SPIN, FREE, STICKS = {"spin": 0.0}, {"law": "viscous", "gamma": 0.0}, {"law": "coulomb", "mu": 1.0, "mu_s": 1.0}
SAID = [
    (DISC, NO_SPIN | {"tilt": 10.0, "seconds": 1.0}, ["on both ball and rim", "without a rim"], ["stem"]),
    (CONE, {"seconds": 5.0}, ["creeps on"], ["so it stays"]),
    (PAPERS, NO_SPIN | {"tilt": 180.0, "seconds": 0.2}, ["stands flat on its stem"], ["least nudge would"]),
    (PAPERS, FREE | NO_SPIN | {"tilt": 130.0, "seconds": 4.0}, ["impacts without a bounce have taken 0.265"],
     ["for ever"]),
    (CONE, NO_SPIN | {"seconds": 3.0}, ["It lies at rest.", "void from"], ["precession", "by 0 %"]),
    (PAPERS, FREE | {"spin": 30.0, "seconds": 1.0}, ["leans: "], ["is upright"]),
    (DISC, {"seconds": 1.0}, [], ["is upright"]),
    (PAPERS, {"tilt": 0.001, "seconds": 3.0}, ["is still on its way", "its tilt still grows"], ["is upright"]),
    (PAPERS, NO_SPIN | {"tilt": 118.0}, [], ["its tilt still falls"]),
    (PAPERS, {"tilt": 90.0, "seconds": 0.2}, ["As an upright start of"], ["back past it", "below 90"]),
    (PAPERS, NO_SPIN | {"tilt": 119.0, "seconds": 1.0}, ["It is for ", "and after that to the end on its ball"],
     ["0.00 s"]),
    (PAPERS, FREE | NO_SPIN | {"tilt": 179.0, "seconds": 1.0}, ["stands flat on its stem"], ["for ever"]),
    ("Uniform ball", {}, ["so it goes on, between 1.8° and 3.9°"], ["so it stays"]),
    (PAPERS, STICKS | {"spin": 30.0, "tilt": 130.0, "seconds": 0.3}, ["goes no further: "], ["stands on its stem: "]),
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
    last = picture.motions["sliding"].ending.stretches[-1].start * picture.settings.scales.time
    assert float(re.search(r"True stick has held it since ([\d.]+) s", said)[1]) >= round(last, 2) > 3


def deepest(picture):
    """The lowest point of the whole body in all of the run, above the table."""
    moved, (radius, z) = picture.motions["sliding"].trajectory, picture.settings.shape.profile(400).T
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
    assert deepest(picture) > -1e-6 and picture.motions["sliding"].ended == "another part touches"
    assert said.startswith("goes no further") and "nothing is computed here" in said


@pytest.mark.slow
def test_a_start_by_constants_that_is_refused_is_answered_beside_the_constants(explorer, planes):
    """The slider of the tilt is not there then."""
    rolling = replace(planes.picture.settings, rolling=planes.picture.state)
    planes._publish(rolling, TopError("tilt", 100.0, "at most 90"))
    assert set(planes.picture.messages) == {"by"}


@pytest.mark.slow
def test_a_start_past_the_touch_is_refused_for_that_and_not_for_its_nutation():
    picture = solve(of(PAPERS, spin=0.0, tilt=179.99, seconds=0.1))
    assert "below the table" in fate(picture, "smooth") and "a little" not in fate(picture, "smooth")


def test_rough_and_smooth_end_where_the_stem_touches(usual):
    fast = State(1.9, 3.0, 0.0, 3.0, vx=0.0, vy=0.0)
    picture = solve(replace(usual.settings, rolling=fast, seconds=1.0))
    angle = usual.settings.shape.touch_angle
    for plane in ("rough", "smooth"):
        motion = picture.motions[plane]
        assert motion.ended == "stem touches" and angle - 0.1 < motion.trajectory.theta[-1] < angle
        assert f"At {motion.alone[0] * picture.settings.scales.time:.2f} s its stem touches" in fate(picture, plane)
    whole = solve(replace(usual.settings, rolling=fast, seconds=1.0, stem=False))
    assert all(whole.motions[plane].trajectory.theta.max() > angle for plane in ("rough", "smooth"))
    under, _ = ran(usual, tilt=150.0, seconds=0.5)
    for plane in ("rough", "smooth"):
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


def test_a_run_that_can_go_no_further_shows_what_was_computed_and_says_why(usual, monkeypatch):
    pushed = State(2.6, 0.0, 0.0, 0.0, vx=0.0, vy=-1.0)
    picture, said = ran(usual, law="coulomb", mu=1.0, mu_s=1.0, rolling=pushed, seconds=0.5)
    assert said.startswith("goes no further: 149.0° at 0 s") and "Painlevé’s limit" in said
    monkeypatch.setattr("tippe_core.motion.sliding.MOST_STEPS", 640)
    picture, said = ran(usual, spin=38.0, seconds=60.0)
    motion = picture.motions["sliding"]
    last = motion.trajectory.events[-1][0] * picture.settings.scales.time
    assert not picture.messages and 0.1 < last < 59 and motion.t[-1] > motion.trajectory.t[-1]
    assert f"At {last:.3g} s the computation stops: it has turned so often" in said
    with speaking("de"):
        _, said = ran(usual, law="coulomb", mu=1.0, mu_s=1.0, rolling=pushed)
    assert "Grenze nach Painlevé" in said


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


def test_the_longest_time_that_a_refusal_names_is_one_that_is_taken(explorer, planes):
    settings = replace(planes.picture.settings, spin=300.0, seconds=MOST_SECONDS)
    with pytest.raises(TopError) as error:
        settings.times  # noqa: B018
    most = float(re.search(r"at most ([\d.e+]+) s", error.value.allowed)[1])
    assert len(replace(settings, seconds=0.99 * most).times) == MOST_FRAMES + 1
    with pytest.raises(TopError):
        replace(settings, seconds=1.02 * most).times  # noqa: B018


def test_the_times_of_a_slow_run_and_of_one_that_precesses_fast(explorer, planes):
    settings = replace(planes.picture.settings, spin=0.0, tilt=0.0, seconds=0.05)
    assert len(settings.times) == LEAST_FRAMES + 1 and settings.times[-1] * settings.scales.time == pytest.approx(0.05)
    fast = replace(settings, rolling=State(1.0, 0.0, 60.0, 0.0), seconds=2.0)
    assert 60.0 * np.diff(fast.times).max() < MOST_TURN


@pytest.mark.parametrize("top", [Top.paper(), Top(-2.0, 4.5, 1.0)])
def test_the_height_in_the_ledger_is_that_of_G_above_its_lowest_place(explorer, planes, top):
    settings = replace(planes.picture.settings, top=top, shape=None, stem=False, tilt=60.0, seconds=0.5)
    motion = solve(settings).motions["sliding"]
    height = motion.trajectory.com[:, 2]  # of G above the table, 1 - a cos(theta); least where 3 points up, or down
    assert motion.ledger["height"] == pytest.approx(height - (1 - abs(top.a)), abs=1e-12)


@pytest.mark.parametrize("plane", PLANES)
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
    motion = picture.motions["sliding"]
    end = motion.ending
    on_stem = replace(end, stretches=(Stretch(0.0, motion.t[-1], "stem"),))
    moved = replace(picture, motions={"sliding": replace(motion, ending=on_stem)})
    (well,) = whiles(moved, "sliding")
    assert well.end < 0 and well.C_J == picture.outcome.C_J


def test_a_start_past_a_right_angle_has_not_overturned_where_it_falls_back(explorer, planes):
    """Without spin, 100 degrees up: it falls to the other side of a right angle, which is no turning over."""
    settings = replace(planes.picture.settings, stem=False, tilt=100.0, spin=0.0, seconds=0.3)
    motion = solve(settings).motions["sliding"]
    assert len(motion.crossings) and not motion.starts_below


def test_a_run_is_done_to_the_share_of_its_seconds(explorer, planes):
    class Halfway:
        elapsed, reached = 1.0, 0.5 * explorer.seconds / planes.picture.settings.scales.time

    planes._run, planes._running = Halfway(), planes.picture.settings
    assert planes.share == pytest.approx(0.5)


@pytest.mark.slow
@pytest.mark.parametrize("name", [HAND, "Top S fast"])
def test_no_frame_turns_the_top_far(explorer, planes, name):
    for motion in chosen(explorer, planes, name).motions.values():
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
    ("mu_s", {"law": "coulomb", "mu": 0.5, "mu_s": 0.4}),
    ("gamma", {"law": "viscous", "gamma": -1.0}),
    ("eps", {"eps": 0.0}),
    ("mu", {"mu": -0.1}),
]


@pytest.mark.slow
def test_a_bad_value_is_said_and_the_last_good_picture_stays(explorer, planes):
    planes.ask(seconds=1.0)
    before = planes.picture
    for control, inputs in BAD:
        good = {name: planes.inputs[name] for name in inputs}
        planes.ask(**inputs)
        assert list(planes.picture.messages) == [control]
        assert planes.picture.motions is before.motions and planes.picture.settings is before.settings
        planes.ask(**good)
        assert not planes.picture.messages
        before = planes.picture


@pytest.mark.slow
def test_at_the_poles_and_without_spin_there_is_an_answer(explorer, planes):
    planes.ask(stem=False)
    for inputs in ({"tilt": 0.0}, {"tilt": 180.0}, {"tilt": 10.0, "spin": 0.0}, {"tilt": 60.0, "spin": -20.0}):
        planes.ask(seconds=1.0, **inputs)
        assert not planes.picture.messages
        assert planes.picture.state.theta == np.radians(inputs["tilt"])


@pytest.mark.slow
def test_a_preset_brings_its_body(explorer, planes):
    body = next(body for body in BODIES if body.name == "Top S")
    assert chosen(explorer, planes, "Top S fast").settings.top == body.shape.top == explorer.scene.top
    assert planes.picture.settings.scales.R == explorer.scene.scales.R == 0.02


@pytest.mark.slow
def test_of_many_asked_for_at_once_the_newest_is_shown_and_a_run_can_be_stopped(explorer):
    posted, shown = Queue(), []
    planes = planes_of(explorer, Runs(posted.put))

    def finish():
        while planes.busy:
            posted.get(timeout=60)()

    finish()
    planes.param.watch(lambda event: shown.append(event.new), "picture")
    for tilt in (11.0, 12.0, 13.0, 14.0):
        planes.ask(tilt=tilt)
    finish()
    assert [picture.settings.tilt for picture in shown] == [11.0, 14.0]

    # an undo puts back the body first, then the inputs: one run, of both
    explorer.param.update(a=0.08)
    planes.follow(explorer.scene)
    planes.ask(tilt=15.0)
    finish()
    assert [(picture.settings.top.a, picture.settings.tilt) for picture in shown[2:]] == [(0.08, 15.0)]

    last = planes.picture
    planes.ask(eps=1e-4, seconds=60.0)
    planes.stop()
    finish()
    assert "Stopped" in planes.picture.messages["run"] and planes.picture.motions is last.motions
    planes.ask(eps=0.1, seconds=5.0)
    finish()
    assert not planes.picture.messages and planes.picture.settings.seconds == 5.0


@pytest.mark.slow
def test_a_place_on_the_map_keeps_I3(explorer, planes):
    inputs = {"plane": "sliding", **planes.picture.inputs}
    view = ThreePlanes(inputs, planes.ask, explorer.param.update, builder_of(explorer).choose, planes)
    view.show(planes.picture)
    view.pick(0.2, 0.9)
    assert explorer.scene.top == Top(0.2, 0.9 * 0.408, 0.408)


@pytest.mark.slow
@pytest.mark.parametrize("law", ["contact", "viscous"])
def test_what_the_bead_has_left_stands_above_it(explorer, planes, law):
    """Where pivoting changes C_J too: V_J is the least energy at any C_J."""
    planes.ask(law=law, seconds=3.0)
    _, bead = wells(planes.picture, "sliding")
    inside = bead.which >= 0
    assert inside.sum() > 100 and np.all(bead.E[inside] >= bead.V[inside])
    # at first its own C_J is that of the well to a few parts in a thousand, and what is left is the energy over V_J
    start = planes.picture.motions["sliding"].trajectory
    assert bead.E[0] - bead.V[0] == pytest.approx(
        start.energy[0] - jellett_potential(start.theta[0], start.top, start.jellett[0]), abs=1e-9)  # fmt: skip


def test_without_its_stem_the_ball_alone_is_drawn(explorer, planes):
    """Nothing of it would stop at the table, through which a stem would be seen to go."""
    settings = planes.picture.settings
    assert settings.drawn is settings.profile and settings.profile[:, 1].max() > 1.5
    alone = replace(settings, stem=False).drawn
    assert np.allclose(np.hypot(*alone.T), 1, atol=1e-6)
