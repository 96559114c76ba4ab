"""Each answer of the lesson against the paper's number, a peer's, or an integration that knows no constant."""

import re

import numpy as np
import pytest
from cases import BALL, LOADED, ORDINARY, PAPER, TOPS

from app import lesson
from app.explorer import Explorer
from app.text import listed, say
from tippe_core import Scales, State, Top, Viscous, outcome, slide, thresholds

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


@pytest.mark.parametrize("top", WORDED.values(), ids=WORDED.keys())
@pytest.mark.parametrize("step", lesson.STEPS, ids=lesson.NAMES)
def test_every_step_has_words_for_every_top(step, top):
    """The planned motion is what the inputs give, all numbers are there, and the answer is one of the options."""
    scene = explored(step, top)
    explorer = Explorer(a=top.a, I1=top.I1, I3=top.I3)
    plan = lesson.planned(step, explorer.scene, explorer.shape)
    assert np.array_equal(plan.trajectory.theta, scene.trajectory.theta)
    answer, asks = step.answer(scene), step.asks(scene)
    assert "{" not in say(f"learn.{step.name}.question", **answer.numbers)
    never = isinstance(answer.truth, float) and np.isnan(answer.truth)
    told = say(f"learn.{step.name}.{answer.told}", **answer.numbers)
    assert "{" not in told and not re.search(r"\b(nan|inf)\b", told)
    if isinstance(asks, lesson.Choice):
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
    assert np.cos(np.radians(answered("free").numbers["end"])) == pytest.approx(-0.99947, abs=5e-5)
    assert answered("ties").numbers["pole"] == pytest.approx(8.36508, abs=5e-6)


def test_turning_points_of_the_table():
    """The row K_J = 7 of Fig. 6: at its limit of friction the motion turns at 0.7754 rad."""
    answer = answered("turning", K_J=7.0, energy=1.0)
    assert np.radians(answer.truth) == pytest.approx(0.7754, abs=5e-5)
    assert np.radians(answer.numbers["inner"]) == pytest.approx(0.3839, abs=5e-5)
    answer = answered("jump", K_J=6.0)
    assert answer.truth == "outer" and np.radians(answer.numbers["verge"]) == pytest.approx(1.0040, abs=5e-5)


def test_the_answers_are_the_tops_own():
    """No key is stored: another top, another answer."""
    assert answered("proof", ORDINARY).truth == "size"
    assert answered("ties", BALL).truth == "stays" and answered("jump", BALL).truth == "never"
    assert answered("free", BALL).truth == "upright" and answered("free", LOADED).truth == "between"
    assert np.isnan(answered("flip", BALL).truth) and np.isnan(answered("flip", ORDINARY).truth)
    assert answered("slip", mu_s=5.0).truth < answered("slip", mu_s=0.3).truth


@pytest.mark.parametrize("top", [PAPER, LOADED], ids=["paper", "loaded"])
def test_the_spin_that_turns_it_over(top):
    """Just below and just above it, friction itself is asked, and the minimum of V_J."""
    least = lesson.needed_spin(top)
    for share, over in ((0.9, False), (1.1, True)):
        state = State(0.02, 0.0, 0.0, share * least)
        assert (outcome(top, state).verdict == "turns over") == over
        motion = slide(top, state, Viscous(1.0), np.linspace(0, 4000, 9), rtol=1e-7)
        assert (motion.theta[-1] > np.pi - 0.05) == over


def test_group_s_of_the_literature():
    """76.761 rad/s with R = 2 cm and g = 9.82: the launch needed for inverted stability."""
    assert lesson.needed_spin(LOADED) * (9.82 / 0.02) ** 0.5 == pytest.approx(76.761, abs=5e-4)
    assert thresholds(LOADED).launch == lesson.needed_spin(LOADED)
