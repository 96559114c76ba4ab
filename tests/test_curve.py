"""f, turning points and steady precessions against formulas (30)-(36) in fifty digits."""

import re

import numpy as np
import pytest
from cases import CASES, LOADED, ORDINARY, PAPER, POLES, TWO_WELLS, Case
from high_precision import Curve, mp, mpf

from tippe_core import (
    Constants,
    NoMotionError,
    Top,
    f,
    omega2,
    omega3,
    pole_constants,
    steady_precessions,
    turning_points,
)

THETAS = np.concatenate([np.linspace(0.05, 3.09, 41), 10.0 ** -np.arange(2, 9), np.pi - 10.0 ** -np.arange(2, 9)])


@pytest.mark.parametrize("case", CASES.values(), ids=CASES.keys())
def test_curve_in_fifty_digits(case):
    """Rounding of theta itself moves f by |f'| theta eps, and of the terms by eps times their size; no more is lost."""
    value, spin2, spin3 = (function(THETAS, case.top, case.constants) for function in (f, omega2, omega3))
    for k, theta in enumerate(map(mpf, THETAS)):
        slope = abs(mp.diff(case.curve.f, theta))
        size = (abs(case.curve.e) + case.curve.U(theta)) / case.curve.f1_squared(theta)
        assert abs(value[k] - case.curve.f(theta)) <= 1e-14 * (size + case.K_R**2 + slope)
        assert abs(spin3[k] - case.curve.omega3(theta)) <= 1e-14 * abs(case.K_R)
        lean = abs(mp.diff(case.curve.omega2, theta))
        assert abs(spin2[k] - case.curve.omega2(theta)) <= 1e-14 * (
            abs(case.curve.omega2(theta)) + lean + abs(case.K_R)
        )


@pytest.mark.parametrize("case", CASES.values(), ids=CASES.keys())
def test_turning_points(case):
    """The theta of f = 0, to 1e-12; near a pole to 1e-12 of its distance from the pole."""
    expected = np.array([[float(x) for x in row] for row in case.intervals])
    found = turning_points(case.top, case.constants)
    np.testing.assert_allclose(found, expected, rtol=1e-12, atol=0)
    np.testing.assert_allclose(np.pi - found, np.pi - expected, rtol=0, atol=1e-12)


@pytest.mark.parametrize("case", POLES.values(), ids=POLES.keys())
def test_turning_points_at_a_pole(case):
    found = turning_points(case.top, case.constants)
    np.testing.assert_allclose(found, [[float(x) for x in row] for row in case.intervals], rtol=0, atol=1e-12)


@pytest.mark.parametrize("pole", [0, 1])
@pytest.mark.parametrize("top", [PAPER, TWO_WELLS, ORDINARY, LOADED])
def test_constants_of_the_poles(top, pole):
    """The bracket of (36) vanishes at theta = 0, pi."""
    curve = Curve(top, 0, 7)
    expected = -curve.bracket(mp.pi * pole)
    assert pole_constants(top, 7.0)[pole] == pytest.approx(float(expected), rel=2e-16 * 4)
    np.testing.assert_allclose(
        pole_constants(top, [-7.0, 0.0, 14.0])[pole], float(expected) * np.array([-1, 0, 2]), rtol=1e-15
    )


@pytest.mark.parametrize("distance", [1e-3, 1e-6, 1e-9, 1e-12])
def test_inner_turning_point_next_to_P(distance):
    """It lies where theta is of the order of the distance; its digits must not drown in those of K_J."""
    case = Case(PAPER, pole_constants(PAPER, 10.0)[0] - distance, 10.0, 4.0)
    [[inner, _]] = turning_points(PAPER, case.constants)
    low, high = mpf(inner) * (1 - mpf("1e-9")), mpf(inner) * (1 + mpf("1e-9"))
    assert 0 < inner < 10 * distance
    assert case.curve.f(low) < 0 < case.curve.f(high)


@pytest.mark.slow
@pytest.mark.parametrize("rise", [1e-4, 1e-8, 1e-11, 3e-13])
@pytest.mark.parametrize("name", ["K_J = 7", "shallow well", "ordinary"])
def test_narrow_well(name, rise):
    """Close above the steady precession the interval is short as the root of the energy; both ends keep 1e-12."""
    base = CASES[name]
    case = Case(base.top, base.K_J, base.K_R, rise, base.well)
    expected = case.intervals
    found = turning_points(case.top, case.constants)
    row = min(range(len(expected)), key=lambda k: expected[k][1] - expected[k][0])
    assert len(found) == len(expected)
    np.testing.assert_allclose(found[row], [float(x) for x in expected[row]], rtol=0, atol=1e-12)
    assert found[row][0] < found[row][1]


def test_wells_merge_at_the_height_of_the_barrier():
    """physics.md's top of two wells: two intervals below the barrier near theta = 2.23, one above."""
    curve = Curve(TWO_WELLS, 3.9525, 14.85)
    top_of_barrier = mp.findroot(lambda x: mp.diff(curve.U, x), mpf("2.23"))
    barrier = curve.energy_of(curve.U(top_of_barrier))
    below = turning_points(TWO_WELLS, Constants(3.9525, 14.85, float(barrier - mpf("1e-9"))))
    above = turning_points(TWO_WELLS, Constants(3.9525, 14.85, float(barrier + mpf("1e-9"))))
    assert below.shape == (2, 2) and above.shape == (1, 2)
    assert below[0, 1] < top_of_barrier < below[1, 0]
    assert below[1, 0] - below[0, 1] < 1e-3
    np.testing.assert_allclose(above[0], [below[0, 0], below[1, 1]], atol=1e-8)


@pytest.mark.slow
@pytest.mark.parametrize("case", CASES.values(), ids=CASES.keys())
def test_steady_precessions(case):
    """Every minimum of U found in fifty digits is a stable one; every one returned is an extremum of U of its kind."""
    theta, stable = steady_precessions(case.top, case.K_J, case.K_R)
    expected = sorted(case.steady)
    np.testing.assert_allclose(theta[stable], expected, rtol=0, atol=1e-12)
    for x, is_stable in zip(map(mpf, theta), stable, strict=True):
        step = mpf("1e-9") * min(x, mp.pi - x)
        before, after = (mp.diff(case.curve.U, y) for y in (x - step, x + step))
        assert before < 0 < after if is_stable else after < 0 < before


def test_steady_precessions_of_two_wells():
    """Stable, unstable, stable: two minima of U with the barrier between them."""
    theta, stable = steady_precessions(TWO_WELLS, 3.9525, 14.85)
    np.testing.assert_allclose(theta, [1.467, 2.2305, 2.995], atol=5e-3)
    assert list(stable) == [True, False, True]


def test_steady_precession_itself():
    """At the least energy the interval is a point, at less there is none."""
    theta, _ = steady_precessions(PAPER, 7.0, 10.0)
    w2, w3 = (float(g(theta[0], PAPER, Constants(7.0, 10.0, 0.0))) for g in (omega2, omega3))
    constants = Constants.from_state(PAPER, theta[0], 0.0, w2, w3)
    [[inner, outer]] = turning_points(PAPER, constants)
    np.testing.assert_allclose([inner, outer], theta[0], rtol=0, atol=1e-7)


def test_f_broadcasts():
    K_J = np.array([1.0, 5.0, 7.0])
    table = f(np.linspace(0.3, 2.0, 4), PAPER, Constants(K_J[:, None], 10.0, 25.0))
    assert table.shape == (3, 4)
    for row, K in zip(table, K_J, strict=True):
        np.testing.assert_allclose(row, f(np.linspace(0.3, 2.0, 4), PAPER, Constants(K, 10.0, 25.0)), rtol=1e-13)


@pytest.mark.parametrize("start", [(4.77, 2.55), (3.65, 1.85)])
@pytest.mark.parametrize("apart", [3e-3, 1e-4])
def test_two_steady_precessions_next_to_each_other(start, apart):
    """Where a well and its barrier are about to merge, nearer to each other than any grid would see."""

    def slope(K_J, theta):
        return mp.diff(Curve(TWO_WELLS, K_J, 14.85).U, theta)

    def curved(K_J, theta):
        return mp.diff(Curve(TWO_WELLS, K_J, 14.85).U, theta, 2)

    K_J, theta = mp.findroot(lambda K, x: [slope(K, x), curved(K, x)], start, tol=mpf(10) ** -30)
    per_K = mp.diff(lambda K: slope(K, theta), K_J)
    third = mp.diff(Curve(TWO_WELLS, K_J, 14.85).U, theta, 3)
    K_J = float(K_J - third / per_K * mpf(apart) ** 2 / 8)
    expected = [float(mp.findroot(lambda x: slope(K_J, x), theta + side * apart / 2)) for side in (-1, 1)]
    assert expected[1] - expected[0] == pytest.approx(apart, rel=0.01)
    found, stable = steady_precessions(TWO_WELLS, K_J, 14.85)
    assert len(found) == 3 and sum(stable) == 2
    pair = found[np.argsort(np.abs(found - float(theta)))[:2]]
    np.testing.assert_allclose(sorted(pair), expected, rtol=0, atol=1e-12 / apart)


@pytest.mark.parametrize("kind", ["any", "at P", "at the inverted pole", "K_J = 0", "two decimals"])
def test_the_least_energy_as_it_is_said_is_allowed(kind):
    """Random tops of all sizes: typed in again, it gives the motion next to the steady precession, and no error."""
    rng = np.random.default_rng([*kind.encode()])
    for _ in range(40):
        I1 = 10 ** rng.uniform(-2, 2)
        top = Top(rng.uniform(-3, 0.9), I1, I1 * rng.uniform(0.001, 2))
        K_J, K_R = rng.normal(size=2) * 10 ** rng.uniform(-2, 2, 2)
        K_J = {"at P": pole_constants(top, K_R)[0], "at the inverted pole": pole_constants(top, K_R)[1],
               "K_J = 0": 0.0, "two decimals": round(K_J, 2)}.get(kind, K_J)  # fmt: skip
        with pytest.raises(NoMotionError) as caught:
            turning_points(top, Constants(K_J, K_R, -1e8))
        said = re.match(r"E >= (\S+) for this top", caught.value.allowed)[1]
        inner, outer = turning_points(top, Constants(K_J, K_R, float(said)))[0]
        assert 0 <= inner <= outer <= np.pi
        # and not by being higher than it need be
        with pytest.raises(NoMotionError):
            turning_points(top, Constants(K_J, K_R, float(said) - 2e-9 * abs(float(said))))
