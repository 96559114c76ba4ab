"""The force at the contact where a formula of it has no value. Elsewhere: test_equations.py and test_accuracy.py."""

import numpy as np
import pytest
import rigid_body as rb
from cases import CASES, TOPS

from tippe_core import Constants, friction_force, normal_force


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
