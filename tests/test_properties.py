"""Properties of every top and every motion, for examples drawn by hypothesis."""

import numpy as np
import rigid_body as rb
from high_precision import Curve, mp, mpf
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from tippe_core import (
    Constants,
    Rolling,
    Scales,
    State,
    Top,
    f,
    friction_force,
    limit_energy,
    normal_force,
    roll,
    turning_points,
)


def numbers(low, high):
    return st.floats(low, high, allow_nan=False, allow_subnormal=False)


@st.composite
def tops(draw):
    I1 = draw(numbers(0.05, 30))
    return Top(a=draw(numbers(-10, 0.9)), I1=I1, I3=I1 * draw(numbers(0.05, 2)))


states = st.builds(
    State,
    theta=numbers(0.02, 3.12),
    theta_dot=numbers(-3, 3),
    omega2=numbers(-5, 5),
    omega3=numbers(-10, 10),
)
PAPER = Top.paper()
SPINNING = State(0.5, 0.7, 3.0, 8.8)
ROCKING = State(0.5, 0.7, 0.0, 0.0)


def constants_of(top, state):
    return Constants.from_state(top, state.theta, state.theta_dot, state.omega2, state.omega3)


def size_of(top, constants):
    """What rounding is measured against: the terms of (33) and (36)."""
    return (1 + 4 * abs(top.a) + abs(constants.E) + constants.K_R**2 + top.I1 / top.I3 * constants.K_J**2) / (
        top.I1 + (1 - abs(top.a)) ** 2
    )


@given(tops(), states)
@example(PAPER, SPINNING)
@example(PAPER, ROCKING)
def test_f_is_zero_at_turning_points_and_not_negative_between(top, state):
    """A sign change of f, in fifty digits, within 1e-12 of each end; f >= 0 between, f < 0 outside all intervals."""
    constants = constants_of(top, state)
    assume(abs(state.theta_dot) > 1e-3)
    rows = turning_points(top, constants)
    curve = Curve(top, constants.K_J, constants.K_R, constants.E)
    delta = mpf("1e-12")
    for inner, outer in rows:
        for end, inward in ((inner, 1), (outer, -1)):
            if delta < end < mp.pi - delta:
                assert curve.f(mpf(end) + inward * delta) > 0 > curve.f(mpf(end) - inward * delta)
        between = np.linspace(inner, outer, 103)[1:-1]
        assert (f(between, top, constants) >= -1e-13 * size_of(top, constants)).all()
    for theta in np.linspace(0.01, 3.13, 60):
        inside = any(inner - 1e-12 <= theta <= outer + 1e-12 for inner, outer in rows)
        assert inside == (curve.f(mpf(theta)) > 0)
    assert any(inner - 1e-9 <= state.theta <= outer + 1e-9 for inner, outer in rows)


@given(tops(), states)
@example(PAPER, SPINNING)
@example(Top(-1.0, 0.4, 0.4), State(np.pi - 0.02, 1.0, 0.5, 3.0))
def test_forces_against_the_rigid_body(top, state):
    assume(abs(state.theta_dot) > 0.1)
    constants = constants_of(top, state)
    expected = rb.force_at(rb.Body.of(top), state.theta, abs(state.theta_dot), state.omega2, state.omega3)
    found = [*friction_force(state.theta, top, constants), normal_force(state.theta, top, constants)]
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-11 * (1 + size_of(top, constants)) * (1 + abs(top.a)))


@given(tops(), states, numbers(0.005, 3), numbers(0.001, 50), numbers(1.6, 25))
@example(PAPER, SPINNING, 0.016, 0.0115, 9.81)
def test_size_mass_and_gravity_leave_the_dimensionless_motion(top, state, R, M, g):
    """The same top in SI, integrated as a rigid body with its own R, M and g, is the dimensionless one times Scales."""
    scales = Scales(R, M, g)
    theta, w = state.theta, np.array([state.theta_dot, state.omega2, state.omega3])
    z = np.array([0, np.sin(theta), np.cos(theta)])
    axis = np.array([0, 0, 1.0])
    # Newton and Euler in SI: six unknowns, I w' + w x I w = -r x F, M v' = F - M g z
    spin = w * scales.angular_velocity
    r = R * z - top.a * R * axis
    inertia = np.diag([top.I1, top.I1, top.I3]) * scales.inertia

    def skew(v):
        return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])

    # in units in which the matrix is well scaled: w' in g/R, F in Mg
    matrix = np.block([[inertia * g / R, skew(r) * scales.force], [-M * skew(r) * g / R, -np.eye(3) * scales.force]])
    known = np.concatenate([-np.cross(spin, inertia @ spin),
                            -M * g * z - M * np.cross(spin, -top.a * R * np.cross(spin, axis))])  # fmt: skip
    row_scale = np.repeat([scales.energy, scales.force], 3)
    force = np.linalg.solve(matrix / row_scale[:, None], known / row_scale)[3:] * scales.force
    assume(abs(state.theta_dot) > 0.1)
    turning = [force[0], np.cos(theta) * force[1] - np.sin(theta) * force[2], force @ z]
    turning[0] *= np.sign(state.theta_dot)
    w_sized = abs(top.a) * (w @ w) + 1
    constants = constants_of(top, state)
    found = [*friction_force(theta, top, constants), normal_force(theta, top, constants)]
    np.testing.assert_allclose(np.array(found) * scales.force, turning, rtol=0,
                               atol=1e-11 * scales.force * (w_sized + size_of(top, constants)))  # fmt: skip
    speed = np.linalg.norm(np.cross(spin, r))
    energy = (spin @ inertia @ spin + M * speed**2) / 2 + M * g * top.a * R * (1 - np.cos(theta))
    np.testing.assert_allclose(constants.E * scales.energy, energy, rtol=1e-11, atol=1e-12 * scales.energy)


@given(tops(), states, numbers(0.5, 20))
@example(PAPER, SPINNING, 10.0)
@example(PAPER, ROCKING, 7.0)
def test_time_reversal(top, state, duration):
    """Where it arrives, turn every velocity round: it goes back the way it came."""
    assume(abs(state.theta_dot) > 0.05)
    there = roll(top, None, [0.0, duration], state)
    assume(1e-3 < there.theta[1] < np.pi - 1e-3)
    w1, w2, w3 = -there.omega[1]
    back = State(there.theta[1], w1, w2, w3, phi=there.phi[1], psi=there.psi[1], x=there.com[1, 0], y=there.com[1, 1])
    home = roll(top, None, [0.0, duration], back)
    same = abs(home.quaternion[1] @ there.quaternion[0])
    # the state handed over is rounded; a motion past an unstable steady precession multiplies that
    growth = 1 + np.abs(there.omega).max() * duration
    period = Rolling(top, None, state).period
    assume(period * np.abs(there.omega).max() < 200)
    assert 1 - same < (1e-11 * growth) ** 2 + 1e-14
    np.testing.assert_allclose(home.com[1], there.com[0], rtol=0, atol=1e-10 * growth * (1 + abs(top.a)))


@given(tops(), states)
@example(PAPER, SPINNING)
def test_nutation_in_and_out_is_one_curve(top, state):
    """theta_dot -> -theta_dot: the same nutation run through the other way, seen in a mirror."""
    assume(abs(state.theta_dot) > 0.05)
    rolling = Rolling(top, None, state)
    assume(np.isfinite(rolling.period) and rolling.period < 100)
    mirrored = State(state.theta, -state.theta_dot, state.omega2, state.omega3)
    times = np.linspace(0, 1, 9) * rolling.period
    onward, other = roll(top, None, times, state), roll(top, None, -times, mirrored)
    np.testing.assert_allclose(onward.theta, other.theta, rtol=0, atol=1e-10)
    np.testing.assert_allclose(np.exp(1j * onward.phi), np.exp(-1j * other.phi), rtol=0, atol=1e-8)
    np.testing.assert_allclose(
        onward.force[:, 2], other.force[:, 2], rtol=0, atol=1e-8 * (1 + size_of(top, constants_of(top, state)))
    )


@given(tops(), states, numbers(0.1, 30))
@example(PAPER, SPINNING, 10.0)
@example(PAPER, State(0.5, -0.7, 3.0, 8.8), 10.0)
def test_mirror(top, state, duration):
    """The mirror x -> -x turns the spins round and keeps theta: (K_J, K_R) -> (-K_J, -K_R)."""
    times = np.linspace(0, duration, 7)
    motion = roll(top, None, times, state)
    image = roll(top, None, times, State(state.theta, state.theta_dot, -state.omega2, -state.omega3))
    np.testing.assert_allclose(image.theta, motion.theta, rtol=0, atol=1e-11)
    np.testing.assert_allclose(image.quaternion, motion.quaternion * [1, -1, -1, 1], rtol=0, atol=1e-10)
    np.testing.assert_allclose(
        image.contact, motion.contact * [-1, 1], rtol=0, atol=1e-10 * (1 + np.abs(motion.contact).max())
    )
    size = 1 + np.abs(motion.force).max()
    np.testing.assert_allclose(image.force, motion.force * [-1, 1, 1], rtol=0, atol=1e-10 * size)
    given_constants, turned = (
        constants_of(top, state),
        constants_of(top, State(state.theta, state.theta_dot, -state.omega2, -state.omega3)),
    )
    assert (turned.K_J, turned.K_R, turned.E) == (-given_constants.K_J, -given_constants.K_R, given_constants.E)


@given(tops(), numbers(-8, 8), numbers(0.5, 15), st.sampled_from([None, 0.2, 0.5, 2.0]))
@example(PAPER, 7.0, 10.0, 0.5)
def test_limit_energy_in_a_mirror(top, K_J, K_R, mu_s):
    np.testing.assert_allclose(limit_energy(top, K_J, K_R, mu_s), limit_energy(top, -K_J, -K_R, mu_s), rtol=1e-11)


@settings(max_examples=10)
@given(tops(), states)
@example(PAPER, SPINNING)
@example(Top(0.3, 131 / 350, 0.4), State(3.1, 1.0, 2.0, -4.0))
def test_roll_is_the_rigid_bodys_motion(top, state):
    """Any top from any state for some turns of the body."""
    assume(abs(state.theta_dot) > 0.02)
    spin = np.sqrt(state.theta_dot**2 + state.omega2**2 + state.omega3**2)
    times = np.linspace(0, 40 / (1 + spin), 9)
    q = rb.euler_quaternion(0, state.theta, 0)
    motion = rb.integrate(rb.Body.of(top), q, rb.to_body(0, state.theta_dot, state.omega2, state.omega3), times)
    found = roll(top, None, times, State(state.theta, state.theta_dot, state.omega2, state.omega3, x=0.0, y=0.0))
    expected = motion.quaternion.astype(float)
    expected *= np.sign((expected * found.quaternion).sum(axis=1))[:, None]
    np.testing.assert_allclose(found.quaternion, expected, rtol=0, atol=1e-9)
    track = motion.contact.astype(float)
    np.testing.assert_allclose(found.contact - found.contact[0], track, rtol=0, atol=1e-9 * (1 + np.abs(track).max()))
