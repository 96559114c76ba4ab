"""The laws of friction: Contensou's compared with Coulomb's law summed over the patch, its limits, and bad input."""

import numpy as np
import pytest

from tippe_core import Contensou, Coulomb, SmoothedCoulomb, State, Top, TopError, Viscous, slide, slide_many
from tippe_core.motion.friction import bounds, push, sticks

MU, RADIUS = 0.3, 1 / 30


def patch(q):
    """Points (n, 2) and areas (n,) over the unit disc, for what is smooth along and about lines through (0, q), where
    it does not slip if the disc slides by q along x and turns by 1; closer where the pressure ends, at the rim."""
    nodes, weights = np.polynomial.legendre.leggauss(120)
    if q < 1:
        angle = np.arange(240)[:, None] * np.pi / 120
        far = -q * np.sin(angle) + np.sqrt(1 - (q * np.cos(angle)) ** 2)
        s, ds = (1 + nodes) / 2, weights / 2
        along, area = far * (1 - s * s), far * 2 * s * ds * np.pi / 120
    else:
        across, turn = nodes[:, None] * np.pi / 2, weights[:, None] * np.pi / 2
        half = np.arcsin(np.sin(across) / q)
        angle = half - np.pi / 2
        tau = np.arange(1, 121) * np.pi / 121
        along = q * np.cos(half) + np.cos(across) * np.cos(tau)
        area = np.cos(across) / (q * np.cos(half)) * turn * np.cos(across) * np.sin(tau) * np.pi / 121
    x, y = along * np.cos(angle), q + along * np.sin(angle)
    return np.stack([x.ravel(), y.ravel()], axis=1), (along * area).ravel()


def summed(mu, radius, u, omega_n):
    """F (2,) and T per unit of F_z of Coulomb's law at each point under Hertz's pressure, with the slip u along x."""
    points, areas = patch(u / (radius * abs(omega_n)))
    points[:, 1] *= np.sign(omega_n)
    x, y = (radius * points).T
    pressure = 3 / (2 * np.pi) * np.sqrt(np.maximum(0, 1 - (points**2).sum(axis=1))) * areas
    slip = np.stack([u - omega_n * y, omega_n * x])
    force = -mu * pressure * slip / np.hypot(*slip)
    return force.sum(axis=1), (x * force[1] - y * force[0]).sum()


@pytest.mark.parametrize("omega_n", [9.0, -0.2])
@pytest.mark.parametrize("q", [0.01, 0.1, 0.3, 0.6, 0.9, 1.1, 1.5, 2.0, 2.99, 3.01, 5.0, 20.0, 1e3])
def test_contensou_is_coulombs_law_summed_over_the_patch(q, omega_n, compare):
    u = q * RADIUS * abs(omega_n)
    k, t = push(Contensou(MU, RADIUS).law, u * u, omega_n)
    force, torque = summed(MU, RADIUS, u, omega_n)
    got, expected = np.array([-k * u, -t]), np.array([force[0], torque])
    compare("Contensou", got, expected, 1e-11, "Coulomb's law summed over the patch", abs(expected))
    assert force[1] == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("q", [1.0, 3.0])
def test_the_forms_of_contensous_law_meet(q):
    omega_n, law = 2.0, Contensou(MU, RADIUS).law
    below, above = (push(law, (q * RADIUS * omega_n * (1 + side)) ** 2, omega_n) for side in (-1e-12, 1e-12))
    assert above == pytest.approx(below, rel=1e-11)


def test_its_closed_form_keeps_its_digits():
    mpmath = pytest.importorskip("mpmath")
    with mpmath.workdps(60):
        for q in np.geomspace(1e-6, 1e8, 99):
            u = q * RADIUS * 7.0
            k, t = push(Contensou(MU, RADIUS).law, u * u, 7.0)
            q = mpmath.mpf(np.sqrt(u * u)) / (mpmath.mpf(RADIUS) * 7)
            A, Q = mpmath.asin(min(1, 1 / q)), mpmath.sqrt(max(0, 1 - 1 / q**2))
            force = MU * mpmath.mpf(3) / 4 * (q * (1 - q**2 / 4) * A + (mpmath.mpf(1) / 2 + q**2 / 4) * Q)
            torque = mpmath.mpf(MU * RADIUS) * 3 / 8 * (
                (1 - q**2 + 3 * q**4 / 8) * A + (3 * q / 4 - 3 * q**3 / 8) * Q)  # fmt: skip
            assert k * u == pytest.approx(float(force), rel=1e-13)
            assert t == pytest.approx(float(torque), rel=1e-13)


def test_contensous_limits():
    law = Contensou(MU, RADIUS).law
    k, t = push(law, 0.0, -5.0)
    assert k == pytest.approx(3 * np.pi / 8 * MU / (RADIUS * 5)) and t == pytest.approx(-3 * np.pi / 16 * MU * RADIUS)
    k, t = push(law, 4.0, 1e-9)
    assert k == pytest.approx(MU / 2) and t == pytest.approx(MU * RADIUS**2 * 1e-9 / (5 * 2))
    assert push(law, 4.0, 0.0) == (MU / 2, 0.0) and push(law, 0.0, 0.0) == (0.0, 0.0)
    assert bounds(law) == (MU, pytest.approx(push(law, 0.0, 5.0)[1]))
    for square, omega_n in [(0.0, 1e-320), (5e-324, 0.0), (5e-324, 1e-310), (1e-300, 1e300), (1e300, 1e-300)]:
        assert np.all(np.isfinite(push(law, square, omega_n)))


def test_smoothed_coulomb_has_contensous_slope_at_small_slip():
    smoothed = SmoothedCoulomb(MU, 8 / (3 * np.pi) * RADIUS * 5)
    assert push(Contensou(MU, RADIUS).law, 0.0, 5.0)[0] == pytest.approx(smoothed.k(0.0), rel=1e-14)


@pytest.mark.parametrize("square", [0.0, 1e-30, 0.01, 4.0])
def test_a_patch_of_no_size_is_coulombs(square):
    contensou, coulomb = Contensou(MU, 0), Coulomb(MU)
    assert push(contensou.law, square, 9.0) == push(coulomb.law, square, 9.0)
    assert bounds(contensou.law) == bounds(coulomb.law) == (MU, 0.0)
    small = push(Contensou(MU, 1e-9).law, square, 9.0)
    if square > 1e-10:
        assert small == pytest.approx(push(coulomb.law, square, 9.0), abs=1e-12)


@pytest.mark.parametrize(("law", "omega_n", "expected"), [
    (Coulomb(MU), 9.0, True), (Contensou(MU, RADIUS), 9.0, False), (Contensou(MU, RADIUS), 0.0, True),
    (Contensou(MU, RADIUS), -1e-12, True), (Contensou(MU, 0), 9.0, True), (SmoothedCoulomb(MU, 0.1), 0.0, False),
    (SmoothedCoulomb(MU, 1e-12), 9.0, True), (Viscous(0), 9.0, False), (Viscous(0.3), 0.0, False)])  # fmt: skip
def test_a_contact_sticks_where_no_push_makes_it_slip(law, omega_n, expected):
    assert sticks(law.law, omega_n) == expected


def test_the_laws_of_a_point():
    assert push(Coulomb(0.3, 0.4).law, 4.0, 9.0) == (0.15, 0.0)
    assert push(Viscous(0.7).law, 4.0, 9.0) == (0.7, 0.0)
    assert push(SmoothedCoulomb(0.3, 1.5).law, 4.0, 9.0) == (0.3 / 2.5, 0.0)
    assert [bounds(law.law)[0] for law in (Coulomb(0.3, 0.4), Viscous(1), SmoothedCoulomb(0.3, 1))] == [0.4, 0, 0]


@pytest.mark.parametrize(("name", "values"), [
    ("mu", (0, 0.1)), ("mu", (-0.3, 0.1)), ("mu", (np.nan, 0.1)), ("radius", (0.3, -1e-9)), ("radius", (0.3, np.inf)),
    ("radius", (0.3, "wide"))])  # fmt: skip
def test_what_is_no_patch_is_refused(name, values):
    with pytest.raises(TopError) as refused:
        Contensou(*values)
    assert refused.value.name == name


def test_a_patch_whose_torque_is_left_out_keeps_jelletts_constant():
    """Any force at the contact point keeps C_J (14); only a torque about the normal changes it."""
    top, start = Top.paper(), State(0.1, 0.0, 0.0, 9.0)
    with_torque, without = (Contensou(MU, 0.02, pivots=pivots) for pivots in (True, False))
    moved, kept = (slide(top, start, law, np.linspace(0, 10, 101)) for law in (with_torque, without))
    assert np.abs(moved.jellett / moved.jellett[0] - 1).max() > 5e-3
    assert np.abs(kept.jellett / kept.jellett[0] - 1).max() < 1e-8
    assert np.ptp(kept.energy + kept.heat) < 1e-8 < 1e-3 < kept.heat[-1]
    assert np.isnan(slide_many(top, start, with_torque, 5.0).C_J_drift)
    assert slide_many(top, start, without, 5.0).C_J_drift < 1e-5
    assert push(without.law, 0.04, 9.0) == (push(with_torque.law, 0.04, 9.0)[0], 0.0)
    assert repr(without) == "Contensou(mu=0.3, radius=0.02, pivots=False)" and eval(repr(with_torque)) == with_torque
    with pytest.raises(TopError) as refused:
        Contensou(MU, 0.02, pivots="no")
    assert refused.value.name == "pivots"
