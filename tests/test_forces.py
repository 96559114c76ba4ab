"""The force at the contact, compared with the rigid body's equations, and with the paper's forms with f' from
differences."""

import numpy as np
import pytest
import rigid_body as rb
from cases import CASES, TOPS
from high_precision import mp, mpf

from tippe_core import Constants, friction_force, normal_force


@pytest.mark.parametrize("top", TOPS.values(), ids=TOPS.keys())
def test_forces_of_the_rigid_body(top):
    """Random states; the force that keeps the contact point at rest, sign of theta_dot positive as in (38)."""
    rng = np.random.default_rng(5)
    body = rb.Body.of(top)
    for _ in range(50):
        theta, theta_dot = rng.uniform(0.02, np.pi - 0.02), rng.uniform(0.3, 4)
        w2, w3 = rng.normal(scale=4, size=2)
        constants = Constants.from_state(top, theta, theta_dot, w2, w3)
        expected = rb.force_at(body, theta, theta_dot, w2, w3)
        found = [*friction_force(theta, top, constants), normal_force(theta, top, constants)]
        # K_J and K_R round w2 by eps K_J/sin(theta)
        size = 1 + (1 + abs(top.a)) * (theta_dot**2 + w2**2 + w3**2) / np.sin(theta)
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-12 * size)


@pytest.mark.parametrize("case", CASES.values(), ids=CASES.keys())
def test_forces_as_the_paper_writes_them(case):
    """(37), (38), (39), with f' differentiated numerically in fifty digits."""
    curve, (inner, outer) = case.curve, case.interval
    for share in (0.02, 0.3, 0.5, 0.8, 0.97):
        theta = mpf(float(inner + (outer - inner) * mpf(share)))
        s, c, f, slope = mp.sin(theta), mp.cos(theta), curve.f(theta), mp.diff(curve.f, theta)
        w2, w3, ratio = curve.omega2(theta), curve.omega3(theta), curve.I3 / curve.I1
        Fz = 1 + curve.a * (s * slope / 2 + c * f)
        Fx = -curve.I3 * curve.K_R * mp.sqrt(f) / curve.f3(theta) ** 3 * (c - ratio * (c - curve.a))
        Fy = curve.a * s * Fz + curve.I1 * slope / 2 - curve.I1 * c / s * w2**2 + curve.I3 * w2 * w3
        Fy /= 1 - curve.a * c
        size = float(abs(Fz) + abs(Fy) + abs(Fx) + w3**2 + w2**2)
        found = [*friction_force(float(theta), case.top, case.constants),
                 normal_force(float(theta), case.top, case.constants)]  # fmt: skip
        # theta_dot is the square root of a difference: its rounding grows where f is small
        blur = 1e-14 * size * (1 + size / float(mp.sqrt(f)))
        np.testing.assert_allclose(found, [float(Fx), float(Fy), float(Fz)], rtol=0, atol=max(blur, 1e-13 * size))


def test_F_y_where_39_is_zero_over_zero():
    """At a cos(theta) = 1 the paper's form has no value; the force has."""
    top = TOPS["two wells"]
    theta = np.arccos(1 / top.a) + np.array([-1e-9, 0, 1e-9])
    constants = Constants.from_state(top, theta[1], 1.0, 2.0, 5.0)
    _, Fy = friction_force(theta, top, constants)
    expected = rb.force_at(rb.Body.of(top), theta[1], 1.0, 2.0, 5.0)[1]
    np.testing.assert_allclose(Fy, expected, rtol=0, atol=1e-7)
    assert Fy[1] == pytest.approx(expected, abs=1e-12)


def test_no_friction_from_theta_dot_where_no_motion_is():
    """Where f < 0, F_x is nan, and F_y and F_z, polynomials in f, are not."""
    case = CASES["K_J = 7"]
    Fx, Fy = friction_force(2.5, case.top, case.constants)
    assert np.isnan(Fx) and np.isfinite(Fy) and np.isfinite(normal_force(2.5, case.top, case.constants))


def test_uniform_ball_feels_its_weight_alone():
    ball = TOPS["ball"]
    constants = Constants.from_state(ball, 1.0, 2.0, 2.0, 5.0)
    theta = np.linspace(0.95, 1.05, 5)
    Fx, Fy = friction_force(theta, ball, constants)
    np.testing.assert_allclose(normal_force(theta, ball, constants), 1, rtol=0, atol=1e-15)
    np.testing.assert_allclose([Fx, Fy], 0, rtol=0, atol=1e-13)
