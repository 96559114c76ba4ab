"""Tests of the oracles: compared with the equations themselves, another program, published numbers, and half their
steps."""

import numpy as np
import pytest
import rigid_body as rb
from high_precision import Curve, mp, mpf
from scipy.integrate import solve_ivp

BODIES = [rb.Body(0.07, 0.399, 0.408), rb.Body(-1.891, 1.105, 0.196), rb.Body(-10.0, 30.0, 5.0), rb.Body(0, 0.4, 0.4)]


def skew(v):
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


@pytest.mark.parametrize("body", BODIES)
def test_contact_force_solves_newton_and_euler(body):
    """The six equations as a 6 x 6 matrix for (w', F), by LAPACK."""
    rng = np.random.default_rng(1)
    for _ in range(20):
        z, w = rng.normal(size=3), 5 * rng.normal(size=3)
        z /= np.linalg.norm(z)
        inertia = np.diag([body.I1, body.I1, body.I3])
        axis = np.array([0, 0, 1.0])
        r = z - body.a * axis
        matrix = np.block([[inertia, skew(r)], [-skew(r), -np.eye(3)]])
        known = np.concatenate([-np.cross(w, inertia @ w), -z - np.cross(w, -body.a * np.cross(w, axis))])
        solved = np.linalg.solve(matrix, known)
        w_dot, force = rb.acceleration(body, z, w)
        scale = np.abs(solved).max()
        np.testing.assert_allclose(np.concatenate([w_dot, force]), solved, atol=1e-12 * scale)


@pytest.mark.slow
@pytest.mark.parametrize("body", BODIES)
def test_integration_halves_its_step_without_change_and_keeps_what_must_be_kept(body):
    q, w = rb.euler_quaternion(0.3, 0.5, 0.2), rb.to_body(0.2, 1.0, 3.0, 8.8)
    times = np.linspace(0, 6, 31)
    motion = rb.integrate(body, q, w, times)
    finer = rb.integrate(body, q, w, times, turn=1.25)
    for name in ("quaternion", "omega_body", "contact", "force"):
        scale = max(1, np.abs(getattr(motion, name)).max())
        assert np.abs(getattr(motion, name) - getattr(finer, name)).max() < 1e-12 * scale
    for values in rb.constants(body, motion.quaternion, motion.omega_body):
        assert np.abs(values - values[0]).max() < 1e-13 * max(1, abs(values[0]))
    assert np.abs((motion.quaternion**2).sum(axis=1) - 1).max() < 1e-14


def test_integration_agrees_with_dop853_in_space_axes():
    """A second integrator on a second set of unknowns: rotation matrix, angular velocity in space, O's place."""
    body = BODIES[0]
    inertia = np.diag([body.I1, body.I1, body.I3])
    up = np.array([0, 0, 1.0])

    def rates(_, y):
        turned, w, place = y[:9].reshape(3, 3), y[9:12], y[12:]
        in_space = turned @ inertia @ turned.T
        axis = turned[:, 2]
        r = up - body.a * axis
        matrix = np.block([[in_space, skew(r)], [-skew(r), -np.eye(3)]])
        known = np.concatenate([-np.cross(w, in_space @ w), -up - np.cross(w, -body.a * np.cross(w, axis))])
        w_dot = np.linalg.solve(matrix, known)[:3]
        return np.concatenate([(skew(w) @ turned).ravel(), w_dot, np.cross(w, up)[: len(place)]])

    q, w = rb.euler_quaternion(0.3, 0.5, 0.2), rb.to_body(0.2, 1.0, 3.0, 8.8)
    motion = rb.integrate(body, q, w, [0, 1, 2])

    def matrix(q):
        return np.column_stack([rb.rotate(q, e) for e in np.eye(3)]).astype(float)

    start = np.concatenate([matrix(q).ravel(), rb.rotate(q, w).astype(float), [0, 0]])
    peer = solve_ivp(rates, (0, 2), start, method="DOP853", rtol=1e-12, atol=1e-13).y[:, -1]
    np.testing.assert_allclose(peer[:9].reshape(3, 3), matrix(motion.quaternion[-1]), atol=1e-10)
    np.testing.assert_allclose(peer[12:], motion.contact[-1].astype(float), atol=1e-10)


@pytest.mark.slow
def test_high_precision_period_of_the_page():
    """physics.md: K_J = 7, K_R = 10, 2E' = 4 has the period 0.67072906113508 to fourteen figures."""
    curve = Curve(rb.Body(0.070, 0.399, 0.408), 7, 10)
    curve = curve.at(curve.energy_of(mpf(4)))
    [(inner, outer)] = curve.turning_points()
    assert abs(curve.period(inner, outer) - mpf("0.67072906113508")) < 1e-14
    assert abs(curve.f(inner)) < mpf(10) ** -45 and abs(curve.f(outer)) < mpf(10) ** -45


@pytest.mark.slow
def test_high_precision_period_is_the_rigid_bodys():
    """Two roads to one number: quadrature of (36), and a body integrated through one nutation."""
    body = BODIES[0]
    curve = Curve(body, 7, 10)
    curve = curve.at(curve.energy_of(mpf(4)))
    [(inner, outer)] = curve.turning_points()
    omega = rb.to_body(0, 0, rb.LONG(mp.nstr(curve.omega2(inner), 25)), rb.LONG(mp.nstr(curve.omega3(inner), 25)))
    q = rb.euler_quaternion(0, rb.LONG(mp.nstr(inner, 25)), 0)
    period = float(curve.period(inner, outer))
    motion = rb.integrate(body, q, omega, period * np.array([0, 0.5, 1]))
    tilt = 2 * np.arctan2(np.hypot(*motion.quaternion[:, :2].T), np.hypot(*motion.quaternion[:, 2:].T))
    np.testing.assert_allclose(tilt.astype(float), [float(inner), float(outer), float(inner)], atol=1e-13)
