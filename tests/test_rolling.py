"""roll() compared with the rigid body, which does not use the constants."""

import numpy as np
import pytest
import rigid_body as rb
from cases import CASES, LOADED, ORDINARY, PAPER, POLES, digits
from high_precision import Curve, mp, mpf
from references import kept

from tippe_core import Constants, Rolling, State, omega2, omega3, roll, steady_precessions

NUTATIONS = 50


def samples(period, nutations=NUTATIONS):
    """So many nutations, at instants of all phases."""
    return np.linspace(0, nutations * float(period), min(6 * nutations, 130) + 1)


@kept
def integrated(top, q, omega, times, *contact):
    motion = rb.integrate(rb.Body.of(top), q, omega, times, *contact)
    return tuple(np.asarray(part, dtype=float) for part in
                 (motion.quaternion, motion.omega_body, motion.contact, motion.force))  # fmt: skip


def rolled(top, q, omega, times, *contact):
    """The rigid body's Motion, in floats."""
    return rb.Motion(times, *integrated(top, q, omega, times, *contact))


def in_space(trajectory):
    """Angular velocity and contact force along the space axes."""
    phi, theta = trajectory.phi, trajectory.theta
    x, y = np.stack([np.cos(phi), np.sin(phi), 0 * phi]), np.stack([-np.sin(phi), np.cos(phi), 0 * phi])
    z = np.array([0, 0, 1.0])[:, None]
    two, three = np.cos(theta) * y + np.sin(theta) * z, np.cos(theta) * z - np.sin(theta) * y
    w1, w2, w3 = trajectory.omega.T
    Fx, Fy, Fz = trajectory.force.T
    return (w1 * x + w2 * two + w3 * three).T, (Fx * x + Fy * y + Fz * z).T


def assert_same_motion(trajectory, motion, top):
    q = motion.quaternion.astype(float)
    q *= np.sign((q * trajectory.quaternion).sum(axis=1))[:, None]
    contact = motion.contact.astype(float)
    np.testing.assert_allclose(trajectory.quaternion, q, rtol=0, atol=1e-9)
    np.testing.assert_allclose(trajectory.contact, contact, rtol=0, atol=1e-9)
    axis = rb.rotate(motion.quaternion.T, np.array([0, 0, 1.0])[:, None] * np.ones(len(q))).T
    centre = np.column_stack([contact, np.ones(len(q))]) - top.a * axis.astype(float)
    np.testing.assert_allclose(trajectory.com, centre, rtol=0, atol=1e-9 * (1 + abs(top.a)))
    # the turning axes have no direction at a pole itself
    off = np.sin(trajectory.theta) > 1e-6
    omega, force = in_space(trajectory)
    expected, pushed = motion.omega.astype(float), motion.force.astype(float)
    np.testing.assert_allclose(omega[off], expected[off], rtol=0, atol=1e-8 * max(1, np.abs(expected).max()))
    np.testing.assert_allclose(force[off], pushed[off], rtol=0, atol=1e-8 * max(1, np.abs(pushed).max()))
    np.testing.assert_array_equal(trajectory.slip, 0)
    assert set(trajectory.regime) == {"roll"}


def first_instant(trajectory):
    """(quaternion, omega along the body's axes) that the rigid body takes over."""
    psi = trajectory.psi[0]
    return trajectory.quaternion[0], rb.to_body(psi, *trajectory.omega[0])


FROM_OUTSIDE = ["K_J = 7", "K_J < 0", "both < 0", "shallow well", "a hair from P", "next to the inverted pole"]
STARTS = [(name, "inner") for name in CASES] + [(name, "outer") for name in FROM_OUTSIDE]


@pytest.mark.parametrize(("name", "start"), STARTS)
def test_fifty_nutations(name, start):
    """From the turning point in fifty digits, where (30) and (31) give the spins."""
    case = CASES[name]
    theta = case.interval[start == "outer"]
    spins = (rb.LONG(digits(omega(theta))) for omega in (case.curve.omega2, case.curve.omega3))
    q = rb.euler_quaternion(0, rb.LONG(digits(theta)), 0)
    times = samples(case.period)
    motion = rolled(case.top, q, rb.to_body(0, 0, *spins), times)
    assert_same_motion(roll(case.top, case.constants, times, start, case.row), motion, case.top)


@pytest.mark.parametrize("start", ["inner", "outer"])
@pytest.mark.parametrize("case", POLES.values(), ids=POLES.keys())
def test_fifty_nutations_through_a_pole(case, start):
    """The start is roll()'s own (at a pole the azimuth is a matter of choice), with the constants asked for."""
    top, constants, (inner, outer) = case.top, case.constants, case.interval
    times = samples(case.exact_period)
    trajectory = roll(top, constants, times, start)
    q, omega = first_instant(trajectory)
    found = [float(x) for x in rb.constants(rb.Body.of(top), q, omega)]
    np.testing.assert_allclose(found, [case.K_J, case.K_R, constants.E], rtol=1e-14, atol=1e-14)
    assert trajectory.theta[0] == pytest.approx(float(outer if start == "outer" else inner), abs=1e-12)
    assert_same_motion(trajectory, rolled(top, q, omega, times), top)


@pytest.mark.parametrize(("name", "start"), [(name, end) for name in CASES for end in ("inner", "outer")])
def test_the_start_is_the_state_at_the_turning_point(name, start):
    """Its constants, by the vectors of the rigid body, are those asked for, and theta is where f vanishes."""
    case = CASES[name]
    state = Rolling(case.top, case.constants, start, case.row).start
    assert state.theta == pytest.approx(float(case.interval[start == "outer"]), abs=1e-12)
    assert state.theta_dot == 0
    q = rb.euler_quaternion(0, state.theta, 0)
    found = rb.constants(rb.Body.of(case.top), q, rb.to_body(0, 0, state.omega2, state.omega3))
    np.testing.assert_allclose(
        [float(x) for x in found], [case.K_J, case.K_R, case.constants.E], rtol=1e-12, atol=1e-12
    )


@pytest.mark.parametrize("start", ["inner", "outer"])
@pytest.mark.parametrize("case", POLES.values(), ids=POLES.keys())
def test_from_the_start_of_a_motion_through_a_pole_the_same_motion_begins(case, start):
    top, constants, times = case.top, case.constants, np.linspace(0, 3, 31)
    state = Rolling(top, constants, start).start
    again, moved = roll(top, None, times, state), roll(top, constants, times, start)
    assert {0.0, np.pi} & {float(x) for x in Rolling(top, constants).turning_points}
    q = again.quaternion * np.sign((again.quaternion * moved.quaternion).sum(axis=1))[:, None]
    np.testing.assert_allclose(q, moved.quaternion, rtol=0, atol=1e-11)
    np.testing.assert_allclose(again.contact, moved.contact, rtol=0, atol=1e-11)


@pytest.mark.parametrize("top", [PAPER, ORDINARY, LOADED], ids=["paper", "ordinary", "loaded"])
@pytest.mark.parametrize("theta_dot", [0.4, -0.4])
def test_fifty_nutations_from_a_state(top, theta_dot):
    """In the middle of a nutation, inward and outward, with angles and place of its own."""
    state = State(0.9, theta_dot, 2.0, 7.0, phi=0.4, psi=-2.0, x=3.0, y=-1.0)
    constants = Constants.from_state(top, state.theta, state.theta_dot, state.omega2, state.omega3)
    times = 5 + samples(Rolling(top, constants).period)
    trajectory = roll(top, None, times, state)
    q = rb.euler_quaternion(state.phi, state.theta, state.psi)
    omega = rb.to_body(state.psi, state.theta_dot, state.omega2, state.omega3)
    # x, y are G's; G lies a below O along 3, and the contact is under O
    axis = rb.rotate(q, np.array([0, 0, 1.0]))
    contact = np.array([state.x, state.y]) + top.a * axis[:2]
    assert_same_motion(trajectory, rolled(top, q, omega, times, contact), top)
    np.testing.assert_allclose(trajectory.com[0, :2], [state.x, state.y], rtol=0, atol=1e-14)
    np.testing.assert_allclose(trajectory.phi[0], state.phi, atol=1e-14)
    np.testing.assert_allclose(trajectory.psi[0], state.psi, atol=1e-14)


def test_a_state_at_the_pole():
    """A top that stands upright, spins and is pushed: only its whole horizontal angular velocity means anything."""
    state = State(0.0, 1.2, 0.0, 8.0, phi=0.3, psi=0.5)
    times = np.linspace(0, 20, 201)
    trajectory = roll(PAPER, None, times, state)
    q = rb.euler_quaternion(0.3, 0.0, 0.5)
    motion = rolled(PAPER, q, rb.to_body(0.5, 1.2, 0.0, 8.0), times)
    assert_same_motion(trajectory, motion, PAPER)


@pytest.mark.parametrize("distance", [1e-3, 1e-7, 1e-11])
@pytest.mark.parametrize("theta_dot", [0.3, -0.3])
@pytest.mark.parametrize("pole", [0.0, np.pi])
def test_a_state_next_to_a_pole(pole, theta_dot, distance):
    """The azimuth there depends on the last digits of the distance from the pole."""
    state = State(abs(pole - distance), theta_dot, -1.4, 6.0, x=0.0, y=0.0)
    times = np.linspace(0, 10, 101)
    trajectory = roll(LOADED, None, times, state)
    q = rb.euler_quaternion(0, state.theta, 0)
    contact = LOADED.a * rb.rotate(q, np.array([0, 0, 1.0]))[:2]
    motion = rolled(LOADED, q, rb.to_body(0, theta_dot, -1.4, 6.0), times, contact)
    np.testing.assert_allclose(trajectory.omega[0], [theta_dot, -1.4, 6.0], rtol=0, atol=1e-9)
    assert_same_motion(trajectory, motion, LOADED)


@pytest.mark.parametrize("theta", [0.0, np.pi])
def test_sleeping_top(theta):
    """Upright or inverted, spinning without a push: it stays."""
    trajectory = roll(PAPER, None, np.linspace(0, 50, 101), State(theta, 0.0, 0.0, 9.0))
    q = rb.euler_quaternion(0, theta, 0)
    motion = rolled(PAPER, q, np.array([0, 0, 9.0]), trajectory.t)
    assert_same_motion(trajectory, motion, PAPER)


@pytest.mark.parametrize(
    ("top", "K_J", "K_R"), [(PAPER, 7.0, 10.0), (PAPER, -3.0, 10.0), (ORDINARY, 20.0, 40.0), (LOADED, 3.0, -6.0)]
)
def test_steady_precession_stays(top, K_J, K_R):
    """theta is constant, phi and psi turn evenly, the contact point runs on a circle; so does the rigid body."""
    theta, stable = steady_precessions(top, K_J, K_R)
    theta = theta[stable][0]
    w2, w3 = (float(g(theta, top, Constants(K_J, K_R, 0.0))) for g in (omega2, omega3))
    times = np.linspace(0, 30, 301)
    trajectory = roll(top, None, times, State(theta, 0.0, w2, w3))
    np.testing.assert_allclose(trajectory.theta, theta, rtol=0, atol=2e-15 * 4)
    phi_dot = w2 / np.sin(theta)
    np.testing.assert_allclose(trajectory.phi, phi_dot * times, rtol=1e-13, atol=1e-13)
    np.testing.assert_allclose(trajectory.psi, (w3 - phi_dot * np.cos(theta)) * times, rtol=1e-13, atol=1e-13)
    speed = abs(w2 * np.cos(theta) - w3 * np.sin(theta))
    radius = speed / abs(phi_dot)
    chord = np.hypot(*trajectory.contact.T)
    np.testing.assert_allclose(chord, 2 * radius * abs(np.sin(phi_dot * times / 2)), rtol=0, atol=1e-9)
    motion = rolled(top, rb.euler_quaternion(0, theta, 0), rb.to_body(0, 0, w2, w3), times)
    assert_same_motion(trajectory, motion, top)


def test_steady_precession_given_by_its_energy():
    """Constants of the steady precession itself, rounded to floats: found as such, not refused."""
    curve = Curve(PAPER, 7, 10)
    [theta] = curve.steady()
    E = float(curve.energy_of(curve.U(theta)))
    trajectory = roll(PAPER, Constants(7.0, 10.0, E), np.linspace(0, 100, 11))
    np.testing.assert_allclose(trajectory.theta, float(theta), rtol=0, atol=1e-7)


def small_rocking_period(top):
    """physics.md, "Rocking at rest": 2 pi ((I1 + (1 - a)^2)/a)^1/2."""
    return 2 * np.pi * np.sqrt((top.I1 + (1 - top.a) ** 2) / top.a)


def test_small_rocking():
    """theta goes from the pole out and back in half a rocking."""
    E = PAPER.a * 1e-8 / 2  # up to theta = 1e-4
    period = Rolling(PAPER, Constants(0.0, 0.0, E)).period
    assert 2 * period == pytest.approx(small_rocking_period(PAPER), rel=1e-7)


PHASES = ["K_J = 7", "past the equator", "deep well", "merged wells", "ordinary", "a hair from P", "nearly steady"]


@pytest.mark.parametrize("name", PHASES)
def test_period_and_phase_in_fifty_digits(name):
    """The period, and where the top is at a third of the way out, at once, after 1 and after 400 nutations."""
    case = CASES[name]
    rolling, period = Rolling(case.top, case.constants, well=case.row), case.exact_period
    assert rolling.period == pytest.approx(float(period), rel=1e-13)
    theta, out = case.third
    for turns in (0, 1, 400):
        t = float(turns * period + out)
        blur = mp.sqrt(case.curve.f(theta)) * (mpf(t) - turns * period - out)  # of t as a float
        found = rolling.theta(np.array([0.0, t]))[1]
        assert found == pytest.approx(float(theta + blur), abs=1e-11)
