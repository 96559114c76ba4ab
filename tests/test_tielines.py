"""Limit energies and tielines, compared with bisection over the trajectories of a rigid body (limits.py)."""

from itertools import pairwise

import numpy as np
import pytest
from cases import BALL, LOADED, ORDINARY, PAPER, TWO_WELLS
from limits import Family, limit

from tippe_core import (
    Constants,
    Top,
    friction_force,
    limit_energy,
    normal_force,
    pole_constants,
    steady_precessions,
    tielines,
    turning_points,
)

FLAT = Top(a=0.5, I1=0.3, I3=0.5)

LIMITS = {
    "paper, lift-off": (PAPER, 7.0, 10.0, None),
    "paper, slip": (PAPER, 4.0, 10.0, 0.5),
    "paper, slips off the turning point": (PAPER, 1.0, 10.0, 0.3),
    "past P": (PAPER, 9.5, 10.0, None),
    "past P, slip": (PAPER, 9.5, 10.0, 0.5),
    "at P": (PAPER, pole_constants(PAPER, 10.0)[0], 10.0, None),
    "K_J < 0": (PAPER, -4.0, 10.0, None),
    "K_J < 0, slip": (PAPER, -4.0, 10.0, 0.5),
    "K_R < 0": (PAPER, 5.0, -10.0, 0.5),
    "no spin": (PAPER, 2.0, 0.0, 0.5),
    "loaded": (LOADED, 3.0, 6.0, None),
    "loaded, slip": (LOADED, 3.0, 6.0, 0.4),
    "loaded, K_J < 0": (LOADED, -2.0, 6.0, 0.6),
    "flat": (FLAT, 2.0, 5.0, 0.5),
    "two wells": (TWO_WELLS, 3.9525, 14.85, None),
    "two wells, slip": (TWO_WELLS, 3.9525, 14.85, 0.9),
    "ordinary": (ORDINARY, 20.0, 40.0, None),
    "ordinary, slip": (ORDINARY, 20.0, 40.0, 0.8),
    # these have their verge, or an end of the well, within a grid's step of a pole
    "lift-off next to a pole": (
        Top(0.2507964841198581, 8.459442556129655, 3.265320952429272),
        0.10515756631197892,
        -0.42690268321592306,
        None,
    ),
    "slip next to a pole": (
        Top(-0.07319541080627334, 5.073009515875978, 6.222492263260422),
        -2.743961145174088,
        -5.757661254306643,
        1.5,
    ),
    "well next to a pole": (
        Top(0.5508642735488226, 3.32336138337635, 0.49956981979648274),
        -0.11828259514286751,
        -1.2764891583731544,
        0.2,
    ),
    "slip inside a wide well": (
        Top(-0.18127617572412857, 1.9847303370096325, 2.404373526467092),
        5.6861285773389705,
        -10.432830947523819,
        1.5,
    ),
    # wells with few points of the grid in them, or none
    "slips at the inner end of a narrow well": (Top(0.4494736842, 0.399, 0.302402), 1.2959222089, 10.0, 0.5),
    "slips at the outer end of a narrow well": (Top(0.071, 0.399, 0.57536), 5.508213, 10.0, 0.1),
    "slips within a narrow well": (Top(-6.905, 50.0, 74.45), 177.63321896, 200.0, 0.5),
    "slips in a very narrow well": (Top(0.48283419, 0.46147260, 0.42828796), -106.018559438, 193.595652681, 0.3),
    "even the steady precession slips": (PAPER, 1.0, 10.0, 0.01),
    "ball": (BALL, 2.0, 5.0, None),
    "ball, slip": (BALL, 2.0, 5.0, 0.1),
}


def bisected(name):
    top, K_J, K_R, mu_s = LIMITS[name]
    return limit(top, K_J, K_R, mu_s)


@pytest.mark.parametrize("name", LIMITS)
def test_limit_energy_by_bisection(name):
    top, K_J, K_R, mu_s = LIMITS[name]
    expected = bisected(name)[0]
    np.testing.assert_allclose(limit_energy(top, K_J, K_R, mu_s), expected, rtol=1e-9)


@pytest.mark.parametrize("name", LIMITS)
def test_tieline_by_bisection(name):
    top, K_J, K_R, mu_s = LIMITS[name]
    E, inner, outer, verge = bisected(name)
    line = tielines(top, np.array([K_J]), K_R, mu_s)
    np.testing.assert_allclose(line.E[0], E, rtol=1e-9)
    if np.isnan(E):
        assert line.limited_by[0] == "no motion"
        assert np.isnan([line.theta_inner[0], line.theta_outer[0]]).all()
    elif np.isinf(E):
        assert line.limited_by[0] == "nothing"
    else:
        # theta moves like the square root of the energy where the well is narrow
        np.testing.assert_allclose([line.theta_inner[0], line.theta_outer[0]], [inner, outer], rtol=0, atol=2e-6)
        np.testing.assert_allclose(line.theta_verge[0], verge, rtol=0, atol=2e-4)
        lifted = Family(top, K_J, K_R).margin(verge, E, None) < 1e-3
        assert line.limited_by[0] == ("lift-off" if mu_s is None or lifted else "slip")


def test_the_cases_include_every_answer():
    energies = np.array([bisected(name)[0] for name in LIMITS])
    assert np.isnan(energies).any() and np.isinf(energies).any() and np.isfinite(energies).sum() > 10


@pytest.mark.parametrize("mu_s", [None, 0.2])
@pytest.mark.parametrize("top", [PAPER, LOADED, TWO_WELLS, ORDINARY], ids=["paper", "loaded", "two wells", "ordinary"])
def test_tielines_do_what_they_say(top, mu_s):
    """On each: the turning points are those of the energy; nothing is violated on it; just above it something is."""
    K_R = 10.0
    K_J = np.linspace(-9, 9, 7)
    lines = tielines(top, K_J, K_R, mu_s)
    np.testing.assert_array_equal(lines.K_J, K_J)
    np.testing.assert_allclose(limit_energy(top, K_J, K_R, mu_s), lines.E, rtol=1e-13)
    for k, E in enumerate(lines.E):
        theta, stable = steady_precessions(top, K_J[k], K_R)
        if not np.isfinite(E):
            assert lines.limited_by[k] == ("no motion" if np.isnan(E) else "nothing")
            continue
        rows = turning_points(top, Constants(K_J[k], K_R, E))
        ends = np.array([lines.theta_inner[k], lines.theta_outer[k]])
        assert np.abs(rows - ends).sum(axis=1).min() < 1e-10
        assert ends[0] - 1e-9 <= lines.theta_steady[k] <= ends[1] + 1e-9
        assert np.abs(theta[stable] - lines.theta_steady[k]).min() < 1e-12
        assert lines.E_steady[k] <= E
        assert ends[0] - 1e-6 <= lines.theta_verge[k] <= ends[1] + 1e-6
        for share, kept in ((1 - 1e-6, True), (1 + 1e-4, False)):
            energy = lines.E_steady[k] + share * (E - lines.E_steady[k])
            assert holds(top, Constants(K_J[k], K_R, energy), lines.theta_steady[k], mu_s) == kept


def holds(top, constants, theta_p, mu_s):
    """Whether neither limit is passed on the trajectory round theta_p."""
    rows = turning_points(top, constants)
    inner, outer = next(row for row in rows if row[0] - 1e-9 <= theta_p <= row[1] + 1e-9)
    theta = inner + (outer - inner) * np.sin(np.linspace(0.001, 1.5698, 3001)) ** 2
    Fx, Fy = friction_force(theta, top, constants)
    Fz = normal_force(theta, top, constants)
    slack = Fz if mu_s is None else np.minimum(Fz, mu_s * Fz - np.hypot(Fx, Fy))
    return bool(slack.min() > -1e-9)


@pytest.mark.parametrize("pole", [0, 1], ids=["upright", "inverted"])
@pytest.mark.parametrize("top", [PAPER, LOADED, FLAT, ORDINARY], ids=["paper", "loaded", "flat", "ordinary"])
def test_turning_points_next_to_a_pole(top, pole):
    """Their distance to the pole is that of turning_points, which has sixty digits, to twelve figures of theta."""
    P = pole_constants(top, 10.0)[pole]
    K_J = P * (1 + np.array([-1e-3, -1e-6, -1e-9, -1e-12, 1e-12, 1e-9, 1e-6, 1e-3]))
    for mu_s in (None, 1.5):
        lines = tielines(top, K_J, 10.0, mu_s)
        for k in np.flatnonzero(np.isfinite(lines.E)):
            rows = turning_points(top, Constants(K_J[k], 10.0, lines.E[k]))
            ends = [lines.theta_inner[k], lines.theta_outer[k]]
            assert np.abs(rows - ends).max(axis=1).min() < 1e-12
            assert rows.min() == pytest.approx(ends[0], rel=1e-9)


def test_array_of_K_J_is_the_same_as_one_by_one():
    K_J = np.linspace(-12, 12, 25)
    together = limit_energy(PAPER, K_J, 10.0, 0.5)
    assert together.shape == (25,)
    alone = [limit_energy(PAPER, K, 10.0, 0.5) for K in K_J]
    np.testing.assert_allclose(together, alone, rtol=1e-12)
    assert np.ndim(alone[0]) == 0


@pytest.mark.parametrize("mu_s", [None, 0.5])
def test_mirrored_tops_have_mirrored_tielines(mu_s):
    """A film of the motion seen in a mirror: (K_J, K_R) -> (-K_J, -K_R)."""
    K_J = np.linspace(0, 8, 9)
    lines, mirrored = tielines(PAPER, K_J, 10.0, mu_s), tielines(PAPER, -K_J, -10.0, mu_s)
    for name in ("E", "theta_inner", "theta_outer", "theta_verge"):
        np.testing.assert_allclose(getattr(lines, name), getattr(mirrored, name), rtol=1e-12, atol=1e-12)
    assert list(lines.limited_by) == list(mirrored.limited_by)


def test_more_friction_allows_more():
    K_J = np.linspace(0, 8, 17)
    energies = [limit_energy(PAPER, K_J, 10.0, mu_s) for mu_s in (0.3, 0.5, 1.0, 10.0, None)]
    for less, more in pairwise(energies):
        assert (less <= more + 1e-12).all()
