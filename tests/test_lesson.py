"""Each number of the lesson, compared with the paper's, another program's, a closed form, or a simulation that does
not use the constants."""

import re
from urllib.parse import parse_qsl

import numpy as np
import pytest
import rigid_body as rb
from cases import BALL, LOADED, ORDINARY, PAPER, TOPS
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation

from app.model.colours import COLOURS
from app.model.explorer import Explorer
from app.model.lesson import lesson, runs
from app.model.lesson.parts import Choice
from app.model.setup import start_of
from app.state.url_state import explorer_of
from app.tabs.learn.lesson import opened
from app.text import LANGUAGES, listed, say
from tippe_core import PRESETS, SmoothedCoulomb, Top, pole_constants, slide

RAD_S = 180.0  # of the arrival's toy


def answered(name, top=PAPER, **changed):
    """The Answer of a step for a top, some of its inputs changed."""
    step = lesson.OF_NAME[name]
    explorer = Explorer(a=top.a, I1=top.I1, I3=top.I3)
    if step.inputs:
        explorer.set(**step.inputs(top) | changed)
    return step.answer(explorer.scene)


def numbers_of(name):
    return answered(name).numbers


def test_six_steps_the_own_toy_and_five_for_theorists():
    assert [step.name for step in lesson.LESSON] == ["flips", "way", "height", "tables", "arms", "proof", "yours"]
    assert [step.name for step in lesson.THEORY] == ["creep", "turning", "ties", "jump", "slip"]
    assert {*lesson.BEFORE.values()} <= {*lesson.NAMES} and not {*lesson.BEFORE} & {*lesson.NAMES}


@pytest.mark.parametrize("name", ["flips", "way", "height", "tables", "arms"])
def test_a_step_opens_its_motion_in_the_lab(name):
    tops = lesson.OF_NAME[name].tops
    explorer, wrong = explorer_of(dict(parse_qsl(opened(tops)[1:])))
    start = runs.on_table(tops[0]).start
    assert not wrong and explorer.table in (*tops, "three") and (explorer.table == "three") == (len(tops) > 1)
    assert (explorer.spin, explorer.tilt, explorer.mu) == (start.spin, start.tilt, start.mu)
    assert explorer.shape == start.shape and explorer.law == start.law


@pytest.mark.parametrize("step, drawn", [
    ("arms", {"L_3": "omega", "L_z": "ink", "kept": "jellett"}),
    ("jump", {"motion": "normal", "limit": "normal", "zero": "grey"}),
    ("ties", {"lift": "normal", "motion": "accent"}),
    ("slip", {"lift": "normal", "slip": "ink", "motion": "accent"}),
])  # fmt: skip
def test_a_quantity_has_the_colour_that_it_has_in_the_lab(step, drawn):
    assert {curve.key: curve.colour for curve in answered(step).picture.curves} == {
        key: COLOURS[colour] for key, colour in drawn.items()
    }


WORDED = TOPS | {"G at the pole": Top(-1.0, 0.731, 0.276), "far from O": Top(0.9, 0.919, 0.981)}


@pytest.mark.slow
@pytest.mark.parametrize("top", WORDED.values(), ids=WORDED.keys())
@pytest.mark.parametrize("step", lesson.STEPS, ids=lesson.NAMES)
def test_every_step_has_words_for_every_top(step, top):
    """All numbers are there in both languages, and the answer can be guessed; not to know yet is no answer."""
    scene = Explorer(a=top.a, I1=top.I1, I3=top.I3).scene
    answer = step.answer(lesson.planned(step, scene))
    numbers = answer.numbers | {"spin": 1.0, "tilt": 1.0} if step.name == "yours" else answer.numbers
    for language in LANGUAGES:
        for key in ("question", "hint", answer.told, "learned"):
            words = say(f"learn.{step.name}.{key}", language, **numbers)
            assert "{" not in words and not re.search(r"\b(nan|inf)\b", words)
        if isinstance(step.asks, Choice):
            known = listed(f"learn.{step.name}.options", language)
            assert {*step.asks.options} - {"unsure"} <= {*known} and answer.truth in {*known}
    if not isinstance(step.asks, Choice):
        assert np.isnan(answer.truth) or step.asks.near(answer.truth) > 0
    for name in step.sources:
        assert listed(f"sources.{name}.full")
    for curve in answer.picture.curves if answer.picture else ():
        assert say(f"learn.curves.{curve.key}") and curve.x.shape == curve.y.shape


# ---- the seven steps ----


def test_it_flips_when_leine_and_glocker_say():
    """Their toy at 180 rad/s: past 90 degrees, on its stem, and off it again, within 1 %."""
    answer = answered("flips")
    assert answer.truth == "over"
    assert [answer.numbers[code] for code in ("over", "stands", "falls")] == pytest.approx(
        [0.977, 1.471, 4.497], rel=1e-2
    )


def turns(poses, t):
    """(about its own axis, as seen from above), rev/s between two poses of a body close together."""
    step = (Rotation.from_quat(poses[1]) * Rotation.from_quat(poses[0]).inv()).as_rotvec() / (t[1] - t[0])
    axis = Rotation.from_quat(poses.mean(axis=0)).apply([0, 0, 1])
    return step @ axis / (2 * np.pi), step[2] / (2 * np.pi)


def test_the_spin_that_is_told_is_that_of_the_poses_which_are_seen():
    """A painted dot, by two pictures: it has no part in how the lesson finds its numbers."""
    motion, numbers, step = runs.on_table("ordinary"), numbers_of("way"), lesson.OF_NAME["way"]
    t, poses = motion.frames[0] * motion.start.scales.time, motion.frames[1]
    for when, names in ((0.0, ("own", "above")), (step.end, ("own_end", "above_end"))):
        i = min(np.searchsorted(t, when), len(t) - 2)
        seen = turns(poses[i : i + 2], t[i : i + 2])
        assert [numbers[name] for name in names] == pytest.approx(seen, abs=0.15)
    i = np.searchsorted(t, numbers["zero"])
    assert turns(poses[i - 4 : i - 2], t[i - 4 : i - 2])[0] > 0 > turns(poses[i + 1 : i + 3], t[i + 1 : i + 3])[0]
    assert answered("way").truth == "other" and numbers["above_end"] > 0 > numbers["own_end"]


def test_what_pays_for_the_height():
    """Heights by the toy's drawing: 15 mm and a centre 3 mm off; a stem that ends 16 + 5 mm away. Energy of the spin:
    I3 omega^2/2, with I3 = 7e-7 kg m^2 and 6 g."""
    numbers = numbers_of("height")
    assert numbers["low"] == pytest.approx(15 - 3 * np.cos(np.radians(5.73)), abs=1e-3)
    assert numbers["high"] == pytest.approx(21, abs=0.6)  # not quite upright on its stem yet
    assert numbers["spin_start"] == pytest.approx(1e3 * 7e-7 * RAD_S**2 / 2 / (0.006 * 9.81), rel=1e-3)
    assert numbers["height"] + numbers["heat"] == pytest.approx(numbers["spin"], rel=1e-3)
    assert answered("height").truth == "spin"


def smooth_turning(top, theta, spin):
    """The other zero of theta_dot^2 on ice: G at rest, w3 and L_z = I3 w3 cos theta kept (the paper's appendix B)."""
    w3, L_z, c = spin, top.I3 * spin * np.cos(theta), np.cos

    def rest(x):
        gained = (L_z - top.I3 * w3 * c(x)) ** 2 / (2 * top.I1 * np.sin(x) ** 2)
        return gained - top.a * (c(x) - c(theta))  # energy gained by falling, minus that used by turning

    return brentq(rest, 0.3 * theta, theta - 1e-6)


def test_neither_rolling_nor_gliding_turns_it_over():
    """Ice by appendix B; the rough table by a body that knows no constant, from where its impulse leaves it."""
    numbers, start = numbers_of("tables"), runs.on_table("ordinary").start
    inner = smooth_turning(start.top, start.state.theta, start.state.omega3)
    assert (numbers["ice_min"], numbers["ice_max"]) == pytest.approx((np.degrees(inner), 5.73), abs=2e-3)
    rough = runs.on_table("rough").trajectory
    w1, w2, w3 = rough.omega[0]
    times = np.linspace(0, rough.t[np.argmax(rough.t > 8.0)], 1201)
    moved = rb.integrate(rb.Body.of(start.top), rb.euler_quaternion(0.0, rough.theta[0], 0.0),
                         rb.to_body(0.0, w1, w2, w3), times)  # fmt: skip
    q = moved.quaternion.astype(float)
    theta = np.degrees(2 * np.arctan2(np.hypot(q[:, 0], q[:, 1]), np.hypot(q[:, 2], q[:, 3])))
    assert (numbers["rough_min"], numbers["rough_max"]) == pytest.approx((theta.min(), theta.max()), abs=5e-3)
    assert answered("tables").truth == "neither"


def test_one_torque_has_two_arms():
    """a/R is 3 mm of 15 mm; L by the inertia of the toy and the turning of its poses."""
    numbers, motion = numbers_of("arms"), runs.on_table("ordinary")
    assert numbers["a"] == pytest.approx(3 / 15) and numbers["one_to"] == pytest.approx(5)
    n, top, poses = runs.on_ball(motion), motion.start.top, motion.frames[1]
    t, taken = motion.frames[0], []
    for i in (0, n - 2):
        rate = (Rotation.from_quat(poses[i + 1]) * Rotation.from_quat(poses[i]).inv()).as_rotvec() / (t[i + 1] - t[i])
        axis = Rotation.from_quat(poses[i : i + 2].mean(axis=0)).apply([0, 0, 1])
        L = top.I1 * rate + (top.I3 - top.I1) * (rate @ axis) * axis
        taken.append((L @ axis, L[2]))
    own, upright = np.subtract(*taken)
    assert numbers["share"] == pytest.approx(100 * upright / own, abs=1.0)
    assert answered("arms").truth == "own" and 0 < numbers["drift"] < 3


def test_the_contradiction():
    """The paper's top at 34.7 turns a second: by (30) with cos = 1 and -1, by (31) with 18.1 % of the energy lost."""
    answer, a = answered("proof"), PAPER.a
    spin = answer.numbers["spin"]
    assert spin == pytest.approx(34.66, abs=0.05)
    assert answer.numbers["jellett"] == pytest.approx(-spin * (np.cos(0.1) - a) / (1 + a), rel=1e-3)
    assert answer.numbers["routh"] == pytest.approx(spin * (1 - 0.181) ** 0.5, rel=2e-3)
    assert (answer.numbers["jellett"], answer.numbers["routh"]) == pytest.approx((-30.0, 31.4), abs=0.05)
    # physics.md: by t = 300 it stands inverted, and spins as Jellett's constant wants it
    assert answer.numbers["slipped"] == pytest.approx(answer.numbers["jellett"], abs=0.1)
    assert answer.truth == "opposite" and answer.numbers["end"] > 177


@pytest.mark.slow
def test_a_run_that_slips_comes_onto_its_head():
    found = runs.slipped()
    assert np.interp(300.0, found.t, np.cos(found.theta)) == pytest.approx(-0.99947, abs=5e-4)


@pytest.mark.slow
def test_ones_own_toy():
    """No key is stored: another top, another answer; a uniform ball has nothing to turn over."""
    assert answered("yours", LOADED).truth == "over"
    paper = answered("yours")  # it is past 90 degrees, but does not stay beyond 120
    assert paper.truth == "not" and paper.numbers["high"] > 90
    assert answered("yours", BALL).truth == "not"
    toy = next(preset for preset in PRESETS if preset.name == "Leine and Glocker's toy")
    scene = Explorer(shape=toy.shape, a=toy.top.a, I1=toy.top.I1, I3=toy.top.I3).scene
    assert lesson.OF_NAME["yours"].answer(scene).numbers["over"] == pytest.approx(0.977, rel=1e-2)


# ---- for theorists ----


def test_a_point_is_caught_and_a_patch_creeps():
    """Caught after 0.03 to 0.05 s at 2 to 6 degrees. The patch nearly as Coulomb's law made smooth with the same slope
    at small slip, eps = (8/3 pi) rho omega, which has no patch."""
    answer = answered("creep")
    assert answer.truth == "patch"
    assert 0.03 <= answer.numbers["caught"] <= 0.05
    assert 2 <= round(answer.numbers["low"], 1) <= answer.numbers["high"] <= 6
    start = start_of("Leine and Glocker's toy", 28.65, 5.73, 0.3)
    eps = 8 / (3 * np.pi) * (1e-4 / start.scales.R) * start.state.omega3
    smooth = slide(start.top, start.state, SmoothedCoulomb(0.3, eps), start.times, rtol=1e-8,
                   edge=start.edge)  # fmt: skip
    over = smooth.t[np.argmax(smooth.theta > np.pi / 2)] * start.scales.time
    assert answer.numbers["over"] == pytest.approx(over, rel=0.06)


def test_turning_points_of_the_table():
    """The row K_J = 7 of Fig. 6: at its limit of friction the motion turns at 0.7754 rad."""
    answer = answered("turning", K_J=7.0, energy=1.0)
    assert np.radians(answer.truth) == pytest.approx(0.7754, abs=5e-5)
    assert np.radians(answer.numbers["inner"]) == pytest.approx(0.3839, abs=5e-5)
    answer = answered("jump", K_J=6.0)
    assert answer.truth == "outer" and np.radians(answer.numbers["verge"]) == pytest.approx(1.0040, abs=5e-5)
    assert answered("ties").numbers["pole"] == pytest.approx(8.36508, abs=5e-6)


@pytest.mark.slow
def test_the_answers_are_the_tops_own():
    """No key is stored: another top, another answer."""
    assert answered("ties", BALL).truth == "stays" and answered("jump", BALL).truth == "never"
    assert answered("ties", ORDINARY).numbers["pole"] == pytest.approx(pole_constants(ORDINARY, 10.0)[0])
    assert answered("slip", mu_s=5.0).truth < answered("slip", mu_s=0.3).truth


def of_preset(preset, name):
    """(Answer, Scene) of a step for a preset."""
    shape, step = preset.shape, lesson.OF_NAME[name]
    scene = Explorer(shape=shape, a=shape.top.a, I1=shape.top.I1, I3=shape.top.I3).scene
    plan = lesson.planned(step, scene)
    return step.answer(plan), plan


def rolled(scene):
    """One nutation of the rigid body from the scene's start: theta, the force in space."""
    state, top = scene.state, scene.top
    times = np.linspace(0, scene.rolling.period, 801)
    motion = rb.integrate(rb.Body.of(top), rb.euler_quaternion(state.phi, state.theta, state.psi),
                          rb.to_body(state.psi, state.theta_dot, state.omega2, state.omega3), times)  # fmt: skip
    q = motion.quaternion.astype(float)
    return 2 * np.arctan2(np.hypot(q[:, 0], q[:, 1]), np.hypot(q[:, 2], q[:, 3])), motion.force.astype(float)


@pytest.mark.slow
@pytest.mark.parametrize("preset", PRESETS, ids=[preset.name for preset in PRESETS])
def test_what_rolls_against_the_rigid_body(preset):
    """By one nutation of a body that knows no constant."""
    answer, scene = of_preset(preset, "turning")
    assert answer.truth == pytest.approx(np.degrees(rolled(scene)[0].max()), abs=1e-3)
    answer, scene = of_preset(preset, "slip")
    force = rolled(scene)[1]
    ratio = np.hypot(force[:, 0], force[:, 1]) / force[:, 2]
    assert answer.numbers["ratio"] == pytest.approx(ratio.max(), rel=2e-3)
    answer, scene = of_preset(preset, "jump")
    force = rolled(scene)[1][:, 2]
    assert (answer.numbers["least"], answer.numbers["most"]) == pytest.approx((force.min(), force.max()), abs=2e-3)
    least = np.argmin(force) if answer.truth != "never" else None
    if answer.truth in ("inner", "outer"):  # just below the energy at which it jumps
        assert (least == 400) == (answer.truth == "outer")
