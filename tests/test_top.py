"""Top, Scales, Constants, State: what they accept, and that errors name the value and the allowed range."""

from dataclasses import replace
from functools import partial

import numpy as np
import pytest
import rigid_body as rb
from cases import PAPER, TOPS

from tippe_core import (
    BareSphere,
    Constants,
    Coulomb,
    Scales,
    State,
    Top,
    TopError,
    glide,
    grip,
    limit_energy,
    outcome,
    roll,
    slide,
    tielines,
    turning_points,
)


def test_paper():
    assert (PAPER.a, PAPER.I1, PAPER.I3) == (0.070, 0.399, 0.408)
    scales = Scales.paper()
    assert (scales.R, scales.M, scales.g) == (0.016, 0.0115, 9.81)


def test_scales_are_one_unit_in_SI():
    scales = Scales(R=0.02, M=0.3, g=9.8)
    assert scales.time == pytest.approx(0.0451753951452626, rel=1e-12)  # sqrt(0.02/9.8)
    assert scales.time * scales.angular_velocity == pytest.approx(1, rel=1e-15)
    assert scales.force == pytest.approx(2.94, rel=1e-15)
    assert scales.energy == pytest.approx(0.0588, rel=1e-15)
    assert scales.energy * scales.time == pytest.approx(scales.angular_momentum, rel=1e-14)
    assert scales.inertia * scales.angular_velocity == pytest.approx(scales.angular_momentum, rel=1e-14)


@pytest.mark.parametrize("top", TOPS.values(), ids=TOPS.keys())
def test_constants_from_state_are_the_rigid_bodys(top):
    rng = np.random.default_rng(3)
    for _ in range(20):
        theta, spins = rng.uniform(0.01, np.pi - 0.01), rng.normal(scale=5, size=3)
        constants = Constants.from_state(top, theta, *spins)
        body = rb.Body.of(top)
        q = rb.euler_quaternion(0.7, theta, -1.1)
        expected = rb.constants(body, q, rb.to_body(-1.1, *spins))
        np.testing.assert_allclose([constants.K_J, constants.K_R, constants.E],
                                   [float(x) for x in expected], rtol=1e-13, atol=1e-13)  # fmt: skip


@pytest.mark.parametrize(
    ("make", "name", "value"),
    [
        (lambda: Top(1.0, 0.4, 0.4), "a", 1.0),
        (lambda: Top(np.nan, 0.4, 0.4), "a", np.nan),
        (lambda: Top(-np.inf, 0.4, 0.4), "a", -np.inf),
        (lambda: Top("x", 0.4, 0.4), "a", "x"),
        (lambda: Top(0.1, 0.0, 0.4), "I1", 0.0),
        (lambda: Top(0.1, -0.4, 0.4), "I1", -0.4),
        (lambda: Top(0.1, 0.4, -0.4), "I3", -0.4),
        (lambda: Top(0.1, 0.4, 0.9), "I3", 0.9),
        (lambda: Scales(0.0, 1.0), "R", 0.0),
        (lambda: Scales(1.0, -1.0), "M", -1.0),
        (lambda: Scales(1.0, 1.0, np.nan), "g", np.nan),
        (lambda: Constants(np.nan, 10.0, 1.0), "K_J", np.nan),
        (lambda: Constants(1.0, np.inf, 1.0), "K_R", np.inf),
        (lambda: Constants(1.0, np.array([1.0, np.nan]), 1.0), "K_R", np.nan),
        (lambda: Constants(1.0, 10.0, "high"), "E", "high"),
        (lambda: Constants(1.0, 10.0, None), "E", None),
        (lambda: State(-0.1, 0.0, 1.0, 1.0), "theta", -0.1),
        (lambda: State(3.2, 0.0, 1.0, 1.0), "theta", 3.2),
        (lambda: State(1.0, np.nan, 1.0, 1.0), "theta_dot", np.nan),
        (lambda: State(1.0, 0.0, 1.0, 1.0, phi=np.inf), "phi", np.inf),
        (lambda: Constants.from_state(PAPER, 4.0, 0.0, 1.0, 1.0), "theta", 4.0),
        (lambda: Constants.from_state(PAPER, 1.0, 0.0, 1.0, np.nan), "omega3", np.nan),
        (lambda: turning_points(PAPER, Constants(7.0, 10.0, 20.0)), "E", 20.0),
        (lambda: roll(PAPER, Constants(7.0, 10.0, 20.0), [0.0, 1.0]), "E", 20.0),
        (lambda: roll(PAPER, Constants(7.0, 10.0, 30.0), [0.0, 1.0], start="middle"), "start", "middle"),
        (lambda: roll(PAPER, Constants(7.0, 10.0, 30.0), [0.0, 1.0], well=1), "well", 1),
        (lambda: roll(PAPER, Constants(7.0, 10.0, 30.0), [0.0, 1.0], well=-1), "well", -1),
        (lambda: roll(PAPER, Constants(7.0, 10.0, 30.0), [0.0, np.nan]), "times", None),
        (lambda: roll(PAPER, Constants(7.0, 10.0, 30.0), [[0.0, 1.0]]), "times", None),
        (lambda: roll(PAPER, Constants(7.0, 10.0, 30.0), []), "times", None),
        (lambda: roll(PAPER, Constants(7.0, 10.0, 30.0), "now"), "times", None),
        (lambda: roll(PAPER, None, [0.0, 1.0]), "constants", None),
        (lambda: limit_energy(PAPER, np.nan, 10.0), "K_J", np.nan),
        (lambda: limit_energy(PAPER, 7.0, np.inf), "K_R", np.inf),
        (lambda: limit_energy(PAPER, 7.0, 10.0, -0.1), "mu_s", -0.1),
        (lambda: limit_energy(PAPER, 7.0, 10.0, np.nan), "mu_s", np.nan),
        (lambda: tielines(PAPER, [0.0, np.inf], 10.0), "K_J", np.inf),
        (lambda: tielines(PAPER, [0.0, 1.0], 10.0, -1.0), "mu_s", -1.0),
        (lambda: tielines(PAPER, [0.0, 1.0], "fast"), "K_R", "fast"),
    ],
)
def test_bad_input_is_named_with_its_value_and_the_allowed_range(make, name, value):
    with pytest.raises(ValueError) as raised:
        make()
    error = raised.value
    assert isinstance(error, TopError)
    assert error.name == name
    if value is not None:
        np.testing.assert_equal(error.value, value)
    assert error.allowed
    assert name in str(error) and str(error).endswith(".")


def test_energy_below_the_well_names_the_least_energy():
    """The range that would work is in the message, and works."""
    with pytest.raises(TopError) as raised:
        turning_points(PAPER, Constants(7.0, 10.0, 20.0))
    least = float(raised.value.allowed.split(">= ")[1].split()[0])
    [[inner, outer]] = turning_points(PAPER, Constants(7.0, 10.0, least + 1e-6))
    assert 0 < outer - inner < 0.02


def test_records_do_not_change():
    for record in (PAPER, Scales.paper(), Constants(1.0, 2.0, 3.0), State(1.0, 0.0, 0.0, 1.0)):
        name = next(iter(record.__dataclass_fields__))
        with pytest.raises(AttributeError):
            setattr(record, name, 1.0)


@pytest.mark.parametrize(("a", "I1", "I3"), [(0.0, 2 / 3, 2 / 3), (0.0, 0.5, 1.0), (0.5, 5 / 12, 2 / 3)])
def test_a_body_may_have_all_its_mass_at_its_surface(a, I1, I3):
    """A spherical shell, a ring around the equator, the shell of the lower half: all as far from O as can be."""
    part = 1 - 1e-9
    BareSphere(R=0.02, M=0.02, a=part * a, I1=part * I1, I3=part * I3)
    with pytest.raises(TopError, match="fit into the body"):
        BareSphere(R=0.02, M=0.02, a=1.001 * a, I1=1.001 * I1, I3=1.001 * I3)


START, TIMES = State(0.1, 0.0, 0.0, 9.0), [0.0, 1.0]
MANY_TOPS, MANY_STATES = Top(np.array([0.1, 0.2]), 0.4, 0.4), State(np.array([0.1, 0.2]), 0.0, 0.0, 9.0)


@pytest.mark.parametrize("move", [lambda top, state: roll(top, None, TIMES, state),
                                  lambda top, state: slide(top, state, Coulomb(0.3), TIMES), glide, grip, outcome],
                         ids=["roll", "slide", "glide", "grip", "outcome"])  # fmt: skip
def test_what_takes_one_top_and_one_state_says_so(move):
    """Neither None nor many of them: the error names the argument, and where many belong."""
    given = partial(move, times=TIMES) if move is glide else move
    with pytest.raises(TopError, match=r"^top = None"):
        given(None, START)
    with pytest.raises(TopError, match=r"^top = Top.*slide_many\(\)"):
        given(MANY_TOPS, START)
    with pytest.raises(TopError, match=r"^(state|start) = State.*slide_many\(\)"):
        given(PAPER, MANY_STATES)


@pytest.mark.parametrize("one, same, other", [
    (MANY_STATES, State([0.1, 0.2], 0.0, 0.0, 9.0), State([0.1, 0.3], 0.0, 0.0, 9.0)),
    (MANY_TOPS, Top([0.1, 0.2], 0.4, 0.4), Top(0.1, 0.4, 0.4)),
    (State(0.1, -0.0, 0.0, 9.0), START, State(0.1, 0.0, 0.0, 9.0, z=2.0)),
])  # fmt: skip
def test_equality_is_one_bool(one, same, other):
    assert (one == same) is True and hash(one) == hash(same)
    assert (one == other) is False and (one == 1) is False


def test_grip_needs_the_table():
    """At the height 1 - a c of G the ball touches the table; higher up nothing is gripped."""
    touches = 1 - PAPER.a * np.cos(START.theta)
    assert grip(PAPER, replace(START, z=touches))[1] > 0
    with pytest.raises(TopError) as error:
        grip(PAPER, replace(START, z=touches + 1e-6))
    assert error.value.code == "in-flight"
