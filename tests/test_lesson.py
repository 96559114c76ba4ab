"""Each answer of the lesson against the paper's number, a peer's, or an integration that knows no constant."""

import re

import numpy as np
import pytest
import rigid_body as rb
import stem_body as st
from cases import BALL, LOADED, ORDINARY, PAPER, TOPS
from references import kept

from app.model import lesson, lesson_parts, lesson_sliding
from app.model.explorer import Explorer
from app.text import listed, say
from tippe_core import PRESETS, Scales, State, Top, Viscous, outcome, slide, thresholds

RAD_S = Scales.paper().angular_velocity


def explored(step, top):
    """The Explorer as the step sets it up, by its own inputs."""
    explorer = Explorer(a=top.a, I1=top.I1, I3=top.I3)
    explorer.param.update(**step.inputs(top))
    assert not explorer.scene.messages
    return explorer.scene


def answered(name, top=PAPER, **changed):
    step = lesson.STEPS[lesson.NAMES.index(name)]
    explorer = Explorer(a=top.a, I1=top.I1, I3=top.I3)
    explorer.param.update(**step.inputs(top) | changed)
    return step.answer(explorer.scene)


def test_ten_steps_in_the_order_of_the_argument():
    assert len(lesson.STEPS) == 10 and lesson.NAMES[0] == "free" and lesson.NAMES[-2:] == ("proof", "flip")


WORDED = TOPS | {"G at the pole": Top(-1.0, 0.731, 0.276), "far from O": Top(0.9, 0.919, 0.981)}


@pytest.mark.slow
@pytest.mark.parametrize("top", WORDED.values(), ids=WORDED.keys())
@pytest.mark.parametrize("step", lesson.STEPS, ids=lesson.NAMES)
def test_every_step_has_words_for_every_top(step, top):
    """The planned motion is what the inputs give, all numbers are there, and the answer is one of the options."""
    scene = explored(step, top)
    explorer = Explorer(a=top.a, I1=top.I1, I3=top.I3)
    plan = lesson.planned(step, explorer.scene)
    assert np.array_equal(plan.trajectory.theta, scene.trajectory.theta)
    answer, asks = step.answer(scene), step.asks(scene)
    assert "{" not in say(f"learn.{step.name}.question", **answer.numbers)
    never = isinstance(answer.truth, float) and np.isnan(answer.truth)
    told = say(f"learn.{step.name}.{answer.told}", **answer.numbers)
    assert "{" not in told and not re.search(r"\b(nan|inf)\b", told)
    if answer.doubt:
        assert lesson.judged(step, scene, answer.truth)[0] == "open" and say(f"learn.doubt.{answer.doubt}")
    elif isinstance(asks, lesson_parts.Choice):
        assert answer.truth in asks.options
        assert lesson.judged(step, scene, answer.truth)[0] == "right"
        assert {lesson.judged(step, scene, other)[0] for other in asks.options if other != answer.truth} == {"off"}
    elif not never:
        assert lesson.judged(step, scene, answer.truth)[0] == "right"
        assert lesson.judged(step, scene, answer.truth + 1e3)[0] == "off"
        # the slider reaches it, or a good guess
        assert asks.verdict(np.clip(answer.truth, asks.low, asks.high), answer.truth) == "right"
    for name in step.sources:
        assert listed(f"sources.{name}.full")
    for curve in answer.picture.curves:
        assert say(f"learn.curves.{curve.key}")
        assert curve.x.shape == curve.y.shape


@pytest.mark.slow
def test_the_papers_top():
    """Gray and Nickel's numbers, and physics.md's for what friction does."""
    assert answered("jellett").truth == pytest.approx(0.070, abs=1e-10)
    # 1 % to 25 % for spins of 8.3 to 1.66
    for spin, printed, digits in ((8.3, 1, 0.05), (1.66, 25, 0.5)):
        given = {"theta": 1e-9, "theta_dot": 0.0, "omega2": 0.0, "omega3": spin, "given": "state"}
        assert answered("energy", **given).truth == pytest.approx(printed, abs=digits)
    assert answered("routh").truth == pytest.approx(18.1, abs=0.05)
    assert answered("proof").truth == "opposite"
    assert answered("flip").numbers["rad"] == pytest.approx(43.56, abs=5e-3)
    assert answered("flip").truth == pytest.approx(6.93, abs=5e-3)
    ball, _ = lesson_sliding.slid(PAPER, 8.8)
    assert np.interp(300.0, ball.t, np.cos(ball.theta)) == pytest.approx(-0.99947, abs=5e-5)
    assert answered("ties").numbers["pole"] == pytest.approx(8.36508, abs=5e-6)


def test_turning_points_of_the_table():
    """The row K_J = 7 of Fig. 6: at its limit of friction the motion turns at 0.7754 rad."""
    answer = answered("turning", K_J=7.0, energy=1.0)
    assert np.radians(answer.truth) == pytest.approx(0.7754, abs=5e-5)
    assert np.radians(answer.numbers["inner"]) == pytest.approx(0.3839, abs=5e-5)
    answer = answered("jump", K_J=6.0)
    assert answer.truth == "outer" and np.radians(answer.numbers["verge"]) == pytest.approx(1.0040, abs=5e-5)


@pytest.mark.slow
def test_the_answers_are_the_tops_own():
    """No key is stored: another top, another answer."""
    assert answered("proof", ORDINARY).truth == "size"
    assert answered("ties", BALL).truth == "stays" and answered("jump", BALL).truth == "never"
    assert answered("free", BALL).truth == "upright" and answered("free", LOADED).truth == "over"
    assert np.isnan(answered("flip", BALL).truth) and np.isnan(answered("flip", ORDINARY).truth)
    assert answered("slip", mu_s=5.0).truth < answered("slip", mu_s=0.3).truth


@pytest.mark.slow
@pytest.mark.parametrize("top", [PAPER, LOADED], ids=["paper", "loaded"])
def test_the_spin_that_turns_it_over(top):
    """Just below and just above it, friction itself is asked, and the minimum of V_J."""
    least = lesson_sliding.needed_spin(top)
    for share, over in ((0.9, False), (1.1, True)):
        state = State(0.02, 0.0, 0.0, share * least)
        assert (outcome(top, state).verdict == "turns over") == over
        motion = slide(top, state, Viscous(1.0), np.linspace(0, 4000, 9), rtol=1e-7)
        assert (motion.theta[-1] > np.pi - 0.05) == over


def test_group_s_of_the_literature():
    """76.761 rad/s with R = 2 cm and g = 9.82: the launch needed for inverted stability."""
    assert lesson_sliding.needed_spin(LOADED) * (9.82 / 0.02) ** 0.5 == pytest.approx(76.761, abs=5e-4)
    assert thresholds(LOADED).launch == lesson_sliding.needed_spin(LOADED)


# ---- every preset, every step, against motions that the core does not compute ----

LONG = np.linspace(0.0, 1200.0, 1201)


def became(top, spin, edge):
    """Where the oracle with a stem is in the last tenth of a long time, an option of step 1, and theta at its end."""
    return in_the_end(top, State(lesson_parts.TILT, 0, 0, spin), lesson_sliding.FRICTION, LONG, edge)


@kept(st)
def in_the_end(top, state, friction, times, edge):
    motion = st.integrate(top, state, friction, times, edge, damping=1.0, share=1.0)
    last = 0.9 * times[-1]
    theta = motion.theta[times > last]
    on_stem = motion.spent(st.STEM, since=last) > 0.99
    end = "over" if on_stem or theta.min() > np.pi - 0.3 else "upright" if theta.max() < 0.2 else "between"
    return end, np.degrees(motion.theta[-1])


def of_preset(preset, name):
    """(Answer, Scene) of a step for a preset."""
    shape, step = preset.shape, lesson.STEPS[lesson.NAMES.index(name)]
    explorer = Explorer(shape=shape, a=shape.top.a, I1=shape.top.I1, I3=shape.top.I3)
    explorer.param.update(**step.inputs(shape.top))
    assert not explorer.scene.messages
    return step.answer(explorer.scene), explorer.scene


def rolled(scene):
    """One nutation of the rigid body from the scene's start: theta, omega in space, omega_3, the force in space."""
    state, top = scene.state, scene.top
    times = np.linspace(0, scene.rolling.period, 801)
    motion = rb.integrate(rb.Body.of(top), rb.euler_quaternion(state.phi, state.theta, state.psi),
                          rb.to_body(state.psi, state.theta_dot, state.omega2, state.omega3), times)  # fmt: skip
    q = motion.quaternion.astype(float)
    theta = 2 * np.arctan2(np.hypot(q[:, 0], q[:, 1]), np.hypot(q[:, 2], q[:, 3]))
    return theta, motion.omega.astype(float), motion.omega_body[:, 2].astype(float), motion.force.astype(float)


@pytest.mark.slow
@pytest.mark.parametrize("preset", PRESETS, ids=[preset.name for preset in PRESETS])
def test_what_slides_against_the_oracle(preset):
    """Steps 1, 9 and 10. With the runs that stopped at the first lift-off, Top S "ended leaning" at 30 degrees."""
    answer, scene = of_preset(preset, "free")
    assert not answer.doubt
    assert answer.truth == became(scene.top, scene.upright_spin, preset.shape.edge)[0]
    assert answer.stem == (preset.shape.edge is not None)
    answer, scene = of_preset(preset, "proof")
    edge = preset.shape.edge if scene.top.a < 0 else None
    ends, theta = became(scene.top, scene.upright_spin, edge)
    assert answer.numbers["end"] == pytest.approx(theta, abs=3.0)
    answer, scene = of_preset(preset, "flip")
    assert not answer.doubt
    if np.isnan(answer.truth):
        assert ends != "over"
        return
    least = lesson_sliding.needed_spin(scene.top)
    slow, fast = (became(scene.top, share * least, edge) for share in (0.8, 2.0))
    assert slow[0] != "over" and fast[0] == "over"
    assert (answer.numbers["slow_end"], answer.numbers["fast_end"]) == pytest.approx((slow[1], fast[1]), abs=3.0)


@pytest.mark.slow
def test_a_rim_is_no_stem_and_ends_what_the_well_says():
    """The disc's first edge is that of the disc: it comes to lie on it, where Jellett's constant does not stay."""
    disc = next(preset for preset in PRESETS if preset.name == "Disc on a peg")
    answer, _ = of_preset(disc, "flip")
    said = say(f"learn.flip.{answer.told}", **answer.numbers)
    assert np.ptp(answer.motion.jellett) > 0.01 * np.abs(answer.motion.jellett).max()
    assert "its rim touches" in said and "not by this argument" in said
    assert "rim" in of_preset(disc, "free")[0].numbers["on"]
    assert answered("flip").numbers["but"] == ""


@pytest.mark.slow
@pytest.mark.parametrize("preset", PRESETS, ids=[preset.name for preset in PRESETS])
def test_what_rolls_against_the_rigid_body(preset):
    """Steps 2 to 8, by one nutation of a body that knows no constant."""
    answer, scene = of_preset(preset, "jellett")
    top = scene.top
    theta, omega, w3, _ = rolled(scene)
    axis_z = np.cos(theta)
    L_3, L_z = top.I3 * w3, top.I1 * omega[:, 2] + (top.I3 - top.I1) * w3 * axis_z
    spread = L_3 - L_3.mean()
    if np.ptp(L_3) > 1e-6:
        assert answer.truth == pytest.approx(spread @ (L_z - L_z.mean()) / (spread @ spread), abs=1e-6)
    numbers = of_preset(preset, "routh")[0].numbers
    assert (numbers["inner"], numbers["outer"]) == pytest.approx((w3.min(), w3.max()), rel=1e-4)
    numbers = of_preset(preset, "energy")[0].numbers
    rise = top.a * (axis_z[0] - axis_z[400])
    assert numbers["height_outer"] - numbers["height_inner"] == pytest.approx(rise, abs=1e-6)
    answer, scene = of_preset(preset, "turning")
    theta = rolled(scene)[0]
    assert answer.truth == pytest.approx(np.degrees(theta.max()), abs=1e-3)
    answer, scene = of_preset(preset, "slip")
    force = rolled(scene)[3]
    ratio = np.hypot(force[:, 0], force[:, 1]) / force[:, 2]
    assert answer.numbers["ratio"] == pytest.approx(ratio.max(), rel=2e-3)
    answer, scene = of_preset(preset, "jump")
    force = rolled(scene)[3][:, 2]
    assert (answer.numbers["least"], answer.numbers["most"]) == pytest.approx((force.min(), force.max()), abs=2e-3)
    least = np.argmin(force) if answer.truth != "never" else None
    if answer.truth in ("inner", "outer"):  # just below the energy at which it jumps
        assert (least == 400) == (answer.truth == "outer")
