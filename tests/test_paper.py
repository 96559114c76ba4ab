"""What the paper prints, to half the last printed digit, and the table of ten tielines to every digit.

The table comes from the formulas; tests/limits.py finds the same digits by bisection over trajectories of a rigid body.
"""

import numpy as np
import pytest
from high_precision import Curve, mp, mpf
from limits import limit

from tippe_core import (
    Ball,
    Constants,
    Scales,
    Top,
    TruncatedSphere,
    f1_squared,
    f3_squared,
    limit_energy,
    omega3,
    pole_constants,
    tielines,
)
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


def test_tielines_of_fig_5(compare):
    lines, table = tielines(TOP, K_J, 10.0), "bisection over trajectories, six figures"
    compare("Fig. 5", two_E_prime(lines.E), ROWS[:, 1], 0.5e-5, table)
    compare("Fig. 5", np.transpose([lines.theta_inner, lines.theta_outer]), ROWS[:, 2:4], 0.5e-4, table)
    assert list(lines.limited_by) == ["lift-off"] * 10


def test_tielines_of_fig_6(compare):
    lines, table = tielines(TOP, K_J, 10.0, 0.5), "bisection over trajectories, six figures"
    compare("Fig. 6", two_E_prime(lines.E), ROWS[:, 4], 0.5e-5, table)
    compare("Fig. 6", np.transpose([lines.theta_inner, lines.theta_outer]), ROWS[:, 5:7], 0.5e-4, table)
    compare("Fig. 6", lines.theta_verge, ROWS[:, 7], 0.5e-4, table)
    assert list(lines.limited_by) == ["slip"] * 10


@pytest.mark.parametrize("K", [1.0, 4.0, 7.0, 8.0])
def test_figures_by_bisection_over_a_rigid_body(K, compare):
    """No formula of the paper: energy after energy until the body in space would jump or slip."""
    for row, mu_s in (("Fig. 5", None), ("Fig. 6", 0.5)):
        lines = tielines(TOP, [K], 10.0, mu_s)
        E, inner, outer, _ = limit(TOP, K, 10.0, mu_s)
        found = lines.E[0], lines.theta_inner[0], lines.theta_outer[0]
        compare(row, found, (E, inner, outer), 1e-8, "bisection over trajectories of the rigid body")


def test_point_P(compare):
    """Fig. 5: K_J = 8.37, f1^2 theta_dot^2 = 18.6, E' = 9.29, E = 25.1 at P."""
    E, print_ = limit_energy(TOP, P, 10.0), "the paper, half its last digit"
    constants = Constants(P, 10.0, E)
    theta = 1e-8  # the float P is off by about 1e-16: at 0 itself f would belong to another trajectory
    height = f1_squared(theta, TOP) * theta_dot_squared(theta, TOP, constants)
    compare("8.37", P, 8.37, 0.005, print_)
    compare("18.6", height, 18.6, 0.05, print_)
    compare("9.29", constants.two_E_prime(TOP) / 2, 9.29, 0.005, print_)
    compare("25.1", E, 25.1, 0.05, print_)
    assert pytest.approx(8.36508, abs=5e-6) == P
    assert constants.two_E_prime(TOP) / 2 == pytest.approx(9.28696, abs=5e-6)
    compare("18.6", height, constants.two_E_prime(TOP), 1e-9, "2E' of the same motion")
    bracket = Curve(TOP, 0, 10).bracket(mpf(0))
    compare("8.37", P, float(-bracket), 2e-15, "the bracket of (36) in fifty digits")


def test_asymmetry(compare):
    """Appendix A: delta I/I1 = 0.0226."""
    compare("0.0226", (TOP.I3 - TOP.I1) / TOP.I1, 0.0226, 0.5e-4, "the paper, half its last digit")


def test_appendix_A(compare):
    """Fig. 7's dimensions in, a/R, I3 and I1 out."""
    body, print_ = TruncatedSphere.paper(), "the paper, half its last digit"
    given = TruncatedSphere(R=0.016, c=0.0082, l=0.0192, r=0.0032, M=0.0115)
    assert given == body
    compare("a/R = 0.070", body.top.a, 0.070, 0.0005, print_)
    compare("I3 = 0.408", body.top.I3, 0.408, 0.0005, print_)
    compare("I1 = 0.399", body.top.I1, 0.399, 0.0005, print_)
    compare("Fig. 7", [body.scales.R, body.scales.M], [0.016, 0.0115], 0, "the paper, exactly")
    # the solid of revolution slice by slice, z up from O along 3: cut sphere, then the stem from the cut
    z = np.linspace(-1, (0.82 + 1.92) / 1.6, 400_001)
    z = (z[1:] + z[:-1]) / 2
    radius2 = np.where(z < 0.82 / 1.6, 1 - z**2, 0.2**2)
    mass, G = radius2.sum(), (radius2 * z).sum() / radius2.sum()
    I3 = (radius2**2 / 2).sum() / mass
    I1 = (radius2 * (radius2 / 4 + (z - G) ** 2)).sum() / mass
    slices = "the body slice by slice"
    for row, got, expected in (("a/R = 0.070", body.top.a, -G), ("I3 = 0.408", body.top.I3, I3),
                               ("I1 = 0.399", body.top.I1, I1)):  # fmt: skip
        compare(row, got, expected, 2e-5, slices)
    ball = Ball(R=0.02, M=0.1).top
    compare("0.4", [ball.I1, ball.I3], 0.4, 1e-15, "the paper")


def test_inverted_pole():
    assert pole_constants(TOP, 10.0)[1] == pytest.approx(-8.708, abs=0.5e-3)


def test_spin_of_the_real_top(compare):
    """The paper prints "about 20 cycles/s" for K_R = 10, which does not follow from (31); (31) gives 34.7."""
    w3 = omega3(0.0, TOP, Constants(P, 10.0, 25.07))
    assert w3 == pytest.approx(8.80, abs=0.005)
    compare("20 cycles/s", w3 * Scales.paper().angular_velocity / (2 * np.pi), 34.7, 0.05, "(31) by hand: 34.7, not 20")
    # the spin of 20 cycles/s has another K_R, whatever theta it is measured at
    K_R = 20 * 2 * np.pi / Scales.paper().angular_velocity * np.sqrt(f3_squared(np.linspace(0, np.pi, 181), TOP))
    assert K_R.max() < 7


def test_routh_loss(compare):
    """Sec. VI: from theta near 0 to pi the spin energy falls by about 20 %, computed 18.1 %."""
    w3 = omega3(np.array([0.0, np.pi]), TOP, Constants(0.0, 10.0, 60.0))
    loss = 1 - (w3[1] / w3[0]) ** 2
    compare("about 20 %", loss, 0.2, 0.05, "the paper, “about”")
    assert loss == pytest.approx(0.181, abs=0.5e-3)
    curve = Curve(TOP, 0, 10)
    compare("about 20 %", loss, float(1 - (curve.f3(0) / curve.f3(mp.pi)) ** 2), 1e-15, "fifty digits")


def test_gravity_against_hand_spins(compare):
    """Sec. VI: 2 Mga/(I3 w3^2/2) is 1 % to 25 % for the spins that a hand gives, w3 from 8.3 to 1.66 (g/R)^1/2."""
    share = 2 * TOP.a / (TOP.I3 * np.array([8.3, 1.66]) ** 2 / 2)
    compare("1 % to 25 %", share, [0.01, 0.25], 0.005, "the paper, half its last digit")
