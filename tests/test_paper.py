"""What the paper prints, to half the last printed digit, and the table of ten tielines to every digit.

The table comes from the formulas; tests/limits.py finds the same digits by bisection over trajectories of a rigid body.
"""

import numpy as np
import pytest

from tippe_core import Constants, Scales, Top, f1_squared, f3_squared, limit_energy, omega3, pole_constants, tielines
from tippe_core import f as theta_dot_squared

TOP = Top.paper()
P = pole_constants(TOP, 10.0)[0]

# K_J, 2E' (F_z), inner, outer, 2E' (mu_s = 0.5), inner, outer, verge; the last row is K_J at P, printed as 8.3651
TABLE = """
0       4.03286  1.3085  1.6943   2.88682  1.3383  1.6637  1.6478
1       3.99619  1.1960  1.5787   2.99743  1.2210  1.5519  1.5323
2       4.06714  1.0797  1.4646   3.12279  1.1023  1.4393  1.4181
3       4.26842  0.9578  1.3508   3.26472  0.9804  1.3242  1.3035
4       4.65286  0.8274  1.2365   3.42535  0.8529  1.2043  1.1870
5       5.33490  0.6844  1.1207   3.60713  0.7165  1.0764  1.0664
6       6.58010  0.5220  1.0040   3.82036  0.5654  0.9350  0.9350
7       9.08885  0.3294  0.8907   4.30872  0.3839  0.7754  0.7754
8       14.86605 0.0945  0.7991   5.78017  0.1328  0.5837  0.5837
8.3651  18.57392 0.0000  0.7789   7.16871  0.0000  0.4998  0.4998
"""
ROWS = np.array([[float(x) for x in line.split()] for line in TABLE.strip().splitlines()])
K_J = np.append(ROWS[:-1, 0], P)


def two_E_prime(E):
    return 2 * E - 10.0**2 + TOP.I1 / TOP.I3 * K_J**2


def test_tielines_of_fig_5():
    lines = tielines(TOP, K_J, 10.0)
    np.testing.assert_allclose(two_E_prime(lines.E), ROWS[:, 1], rtol=0, atol=0.5e-5)
    np.testing.assert_allclose(lines.theta_inner, ROWS[:, 2], rtol=0, atol=0.5e-4)
    np.testing.assert_allclose(lines.theta_outer, ROWS[:, 3], rtol=0, atol=0.5e-4)
    assert list(lines.limited_by) == ["lift-off"] * 10


def test_tielines_of_fig_6():
    lines = tielines(TOP, K_J, 10.0, 0.5)
    np.testing.assert_allclose(two_E_prime(lines.E), ROWS[:, 4], rtol=0, atol=0.5e-5)
    np.testing.assert_allclose(lines.theta_inner, ROWS[:, 5], rtol=0, atol=0.5e-4)
    np.testing.assert_allclose(lines.theta_outer, ROWS[:, 6], rtol=0, atol=0.5e-4)
    np.testing.assert_allclose(lines.theta_verge, ROWS[:, 7], rtol=0, atol=0.5e-4)
    assert list(lines.limited_by) == ["slip"] * 10


def test_point_P():
    """Fig. 5: K_J = 8.37, f1^2 theta_dot^2 = 18.6, E' = 9.29, E = 25.1 at P."""
    E = limit_energy(TOP, P, 10.0)
    constants = Constants(P, 10.0, E)
    theta = 1e-8  # P as a float lies some 1e-16 beside the true one: at 0 itself f would be that of another trajectory
    height = f1_squared(theta, TOP) * theta_dot_squared(theta, TOP, constants)
    assert P == pytest.approx(8.37, abs=0.005)
    assert P == pytest.approx(8.36508, abs=0.5e-5)
    assert height == pytest.approx(18.6, abs=0.05)
    assert height == pytest.approx(18.574, abs=0.5e-3)
    assert constants.two_E_prime(TOP) / 2 == pytest.approx(9.29, abs=0.005)
    assert constants.two_E_prime(TOP) / 2 == pytest.approx(9.28696, abs=0.5e-5)
    assert E == pytest.approx(25.1, abs=0.05)
    assert E == pytest.approx(25.07, abs=0.005)


def test_asymmetry():
    """Appendix A: delta I/I1 = 0.0226."""
    assert (TOP.I3 - TOP.I1) / TOP.I1 == pytest.approx(0.0226, abs=0.5e-4)


def test_inverted_pole():
    assert pole_constants(TOP, 10.0)[1] == pytest.approx(-8.708, abs=0.5e-3)


def test_spin_of_the_real_top():
    """The paper prints "about 20 cycles/s" for K_R = 10, which does not follow from (31); (31) gives 34.7."""
    w3 = omega3(0.0, TOP, Constants(P, 10.0, 25.07))
    assert w3 == pytest.approx(8.80, abs=0.005)
    assert w3 * Scales.paper().angular_velocity / (2 * np.pi) == pytest.approx(34.7, abs=0.05)


def test_routh_loss():
    """Sec. VI: from theta near 0 to pi the spin energy falls by about 20 %, computed 18.1 %."""
    w3 = omega3(np.array([0.0, np.pi]), TOP, Constants(0.0, 10.0, 60.0))
    loss = 1 - (w3[1] / w3[0]) ** 2
    assert loss == pytest.approx(0.181, abs=0.5e-3)
    assert loss == pytest.approx(1 - f3_squared(0.0, TOP) / f3_squared(np.pi, TOP), rel=1e-14)


def test_gravity_against_hand_spins():
    """Sec. VI: 2 Mga/(I3 w3^2/2) is 1 % to 25 % for the spins that a hand gives, w3 from 8.3 to 1.66 (g/R)^1/2."""
    share = 2 * TOP.a / (TOP.I3 * np.array([8.3, 1.66]) ** 2 / 2)
    np.testing.assert_allclose(share, [0.01, 0.25], atol=0.005)
