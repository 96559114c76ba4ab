"""glide() compared with the rigid body in space without friction, over many nutations, and with its own constants."""

import numpy as np
import pytest
import sliding_body as sb
from cases import BALL, LOADED, ORDINARY, PAPER
from scipy.integrate import quad
from sliding_body import first_instant, in_space, rotated

from tippe_core import Gliding, State, Top, TopError, Viscous, glide, slide

STARTS = {
    "slow": (PAPER, State(0.8, 0.3, 1.5, 4.0, 0.4, -0.3, 0.2, 0.1, 0.3, -0.5)),
    "from rest": (PAPER, State(1.0, 0, 0, 5.0)),
    "rising": (PAPER, State(2.2, -0.4, 0.7, -3.0)),
    "loaded": (LOADED, State(0.1, 0, 0, 4.0)),
    "ordinary": (Top(a=-2.0, I1=3.0, I3=1.0), State(0.5, 0.1, 0.3, 8.0)),
    "heavy": (ORDINARY, State(0.4, 0.0, 0.1, 5.0)),
    "ball": (BALL, State(0.7, 0.2, 0.5, 3.0)),
    "steady, nearly": (PAPER, State(1.0, 1e-5, 0.0, 0.0)),
    "through the pole": (PAPER, State(0.0, 0.6, 0, 5.0)),
    "through the inverted pole": (LOADED, State(np.pi, 0.7, 0, 4.0, 0.3, 0.2)),
    "back through the pole": (PAPER, State(0.0, -0.6, 0, 5.0, 0.2, 0.3, vx=0.1)),
    "a hair from the pole": (PAPER, State(1e-7, 0.5, 0.2, 5.0)),
    "rocking": (PAPER, State(0.5, 0, 0, 0)),
}


@pytest.mark.parametrize("name", STARTS)
def test_against_the_rigid_body(name):
    top, state = STARTS[name]
    times = np.linspace(3.0, 23.0, 81)
    motion = sb.stored(top, Viscous(0.0), *first_instant(top, state), times, rtol=1e-13)
    moved = glide(top, state, times)
    q = motion.quaternion / np.linalg.norm(motion.quaternion, axis=1)[:, None]
    q *= np.sign((q * moved.quaternion).sum(axis=1))[:, None]
    assert moved.events == ()
    np.testing.assert_allclose(moved.quaternion, q, rtol=0, atol=2e-10)
    np.testing.assert_allclose(moved.com, motion.com, rtol=0, atol=2e-10 * max(1, abs(top.a)))
    off = np.sin(moved.theta) > 1e-6
    omega = in_space(moved.phi, moved.theta, *moved.omega.T)
    np.testing.assert_allclose(omega[off], motion.omega[off], rtol=0, atol=2e-9)
    body = [(sb.matrix(x)[:, 2], w, v) for x, w, v in zip(q, motion.omega, motion.velocity, strict=True)]
    slips = np.array([sb.slip(top, *row) for row in body])[:, :2]
    np.testing.assert_allclose(rotated(moved.phi, moved.slip)[off], slips[off], rtol=0, atol=1e-8)
    N = np.array([sb.accelerations(top, lambda u: 0 * u, *row)[2] for row in body])
    np.testing.assert_allclose(moved.force[off, 2], N[off], rtol=0, atol=1e-7)
    np.testing.assert_allclose(moved.energy[off], moved.energy[off][0], rtol=1e-12, atol=1e-13)
    np.testing.assert_allclose(moved.jellett[off], moved.jellett[off][0], rtol=1e-12, atol=1e-13)


def test_a_motion_through_a_pole_turns_there():
    for name, end in (("through the pole", 0), ("through the inverted pole", 1)):
        assert Gliding(*STARTS[name]).turning_points[end] == np.pi * end


@pytest.mark.parametrize("name", ["slow", "rising", "ordinary"])
def test_period_and_turning_points(name):
    """Appendix B's theta_dot^2 vanishes at the turning points; its quadrature between them is the period."""
    top, state = STARTS[name]
    gliding = Gliding(top, state)
    s, c = np.sin(state.theta), np.cos(state.theta)
    L3, L_z = top.I3 * state.omega3, top.I3 * state.omega3 * c + top.I1 * state.omega2 * s
    two_E = (top.I1 * (state.theta_dot**2 + state.omega2**2) + top.I3 * state.omega3**2
             + (top.a * s * state.theta_dot) ** 2 + 2 * top.a * (1 - c))  # fmt: skip

    def f(theta):
        s, c = np.sin(theta), np.cos(theta)
        right = two_E - L3**2 / top.I3 - 2 * top.a * (1 - c) - (L_z - L3 * c) ** 2 / (top.I1 * s**2)
        return right / (top.I1 + top.a**2 * s**2)

    inner, outer = gliding.turning_points
    np.testing.assert_allclose(f(gliding.turning_points), 0, atol=1e-11)
    half, middle = (outer - inner) / 2, (outer + inner) / 2
    whole = 2 * quad(lambda x: half * np.cos(x) / np.sqrt(f(middle + half * np.sin(x))), -np.pi / 2, np.pi / 2,
                     epsabs=1e-11, epsrel=1e-11)[0]  # fmt: skip
    assert gliding.period == pytest.approx(whole, rel=1e-7)
    assert gliding.theta(np.array([0, gliding.period]))[1] == pytest.approx(state.theta, abs=1e-12)


def test_ten_thousand_nutations_keep_everything():
    top, state = STARTS["slow"]
    gliding = Gliding(top, state)
    moved = gliding(np.linspace(0, 1e4 * gliding.period, 20011))
    assert np.abs(moved.energy / moved.energy[0] - 1).max() < 1e-11
    assert np.abs(moved.jellett / moved.jellett[0] - 1).max() < 1e-12
    turns = gliding(np.array([0, 1e4]) * gliding.period).phi
    assert turns[1] - turns[0] == pytest.approx(1e4 * gliding.phi_advance, rel=1e-12)
    np.testing.assert_allclose(np.diff(moved.com[:, :2], 2, axis=0), 0, atol=1e-8)  # a straight line at constant speed


def test_no_friction_never_flips():
    for name in ("loaded", "from rest"):
        top, state = STARTS[name]
        moved = glide(top, state, np.linspace(0, 2000, 20001))
        assert moved.theta.max() < np.pi / 2
        np.testing.assert_array_equal(moved.omega[:, 2], state.omega3)


def test_steady_precession_stays():
    """Euler's equation about 1' with theta at rest and F_z = 1: I1 c phi_dot^2 - I3 w3 phi_dot - a = 0."""
    top, theta, w3 = PAPER, 0.9, 6.0
    s, c = np.sin(theta), np.cos(theta)
    phi_dot = np.roots([top.I1 * c, -top.I3 * w3, -top.a])[1].real
    moved = glide(top, State(theta, 0, phi_dot * s, w3), np.linspace(0, 100, 101))
    np.testing.assert_allclose(moved.theta, theta, atol=1e-12)
    np.testing.assert_allclose(moved.phi, phi_dot * moved.t, rtol=1e-10)
    np.testing.assert_allclose(moved.force[:, 2], 1, atol=1e-12)


def test_lift_off_is_where_sliding_without_friction_puts_it():
    state, times = State(0.8, 9.0, 0, 3.0), np.linspace(1, 6, 501)
    moved, slid = glide(PAPER, state, times), slide(PAPER, state, Viscous(0.0), times, rtol=1e-12, landing="stop")
    assert moved.events[0][1] == "lifts off" == slid.events[0][1]
    assert moved.events[0][0] == pytest.approx(slid.events[0][0], abs=1e-9)
    assert len(moved.t) == len(slid.t) and moved.force[:, 2].min() > 0
    gliding = Gliding(PAPER, state)
    assert vars(gliding).get("lift_off") is None and gliding.lift_off == vars(gliding)["lift_off"]  # sought once


@pytest.mark.parametrize(("name", "call"), [("state", lambda: glide(PAPER, 3, [0, 1])),
                                            ("omega3", lambda: glide(PAPER, State(1, 0, 0, 1e60), [0, 1])),
                                            ("times", lambda: glide(PAPER, State(1, 0, 0, 1), [1, 0]))])  # fmt: skip
def test_bad_input_is_named(name, call):
    with pytest.raises(TopError) as caught:
        call()
    assert caught.value.name == name


@pytest.mark.parametrize(("spin", "tilt"), [(4.922, 47.70), (13.18, 87.1), (9.1, 120.3)])
def test_a_uniform_ball_at_rest_but_for_its_spin_keeps_its_tilt(spin, tilt):
    """Nothing acts on it; by rounding alone it seemed to turn, towards no turning point."""
    start = State(np.radians(tilt), 0, 0, spin * 2 * np.pi * (0.02 / 9.81) ** 0.5)
    assert glide(BALL, start, np.linspace(0, 10, 5)).theta == pytest.approx(np.radians(tilt), abs=1e-9)
