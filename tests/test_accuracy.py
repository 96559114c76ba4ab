"""Fifty digits: a sample of the map of docs/validation.md, and the hard places one by one."""

import accuracy
import numpy as np
import pytest
from cases import CASES, POLES
from high_precision import Curve, mp, mpf

from tippe_core import Constants, Rolling, f, friction_force, normal_force, pole_constants, turning_points

HARD = ["deep well", "shallow well", "merged wells", "just merged", "ordinary", "ordinary, back", "next to P",
        "beyond P", "a hair from P", "next to the inverted pole", "nearly steady"]  # fmt: skip
DIGITS = "the paper's formulas in fifty digits"


@pytest.fixture(params=HARD)
def hard(request):
    return CASES[request.param]


@pytest.mark.slow
def test_sample_of_the_map():
    """Nothing is off by 1e-9 of itself, and nothing by more than rounding of the terms it is the sum of."""
    found, said = accuracy.errors(accuracy.FEW)
    assert len(found) == 15 and not said
    for name, rows in found.items():
        own, terms = rows.max(axis=0)
        assert own < 1e-9 and terms < 1e-13, (name, own, terms)


def inside(case, shares=(0.001, 0.1, 0.5, 0.9, 0.999)):
    inner, outer = case.interval
    return [float(inner + (outer - inner) * mpf(share)) for share in shares]


@pytest.mark.slow
def test_f_at_hard_places(hard, compare):
    for theta in inside(hard):
        x = mpf(theta)
        size = (abs(hard.curve.e) + hard.curve.U(x)) / hard.curve.f1_squared(x) + hard.K_R**2
        # the float theta is exact, but cos(theta) is rounded: f' theta eps
        slope = abs(mp.diff(hard.curve.f, x)) * min(x, mp.pi - x) * mpf("1e-2")
        compare("mpmath: f", f(theta, hard.top, hard.constants), hard.curve.f(x), 1e-14, DIGITS,
                scale=float(size + slope))  # fmt: skip


@pytest.mark.parametrize("share", [1e-4, 1e-6, 1e-8])
def test_f_and_forces_next_to_a_turning_point(hard, share):
    """Also where f has lost nearly all figures of its terms, 1e-9 of itself is right."""
    for theta in inside(hard, (share, 1 - share)):
        exact = hard.curve.f(mpf(theta))
        if exact < 1e-9 * hard.curve.U(mpf(theta)):
            continue  # a few of the last digits of theta itself
        assert f(theta, hard.top, hard.constants) == pytest.approx(float(exact), rel=1e-9, abs=0)
        found = friction_force(theta, hard.top, hard.constants)[0]
        assert found == pytest.approx(float(accuracy.forces(hard.curve, mpf(theta), exact)[0][0]), rel=1e-9, abs=0)


@pytest.mark.parametrize("name", POLES)
def test_f_on_the_way_through_a_pole(name, compare):
    """The float K_J of a pole stands for the pole's own: f next to it against the exact K_J there."""
    top, K_J, K_R = POLES[name].top, POLES[name].K_J, POLES[name].K_R
    pole = np.pi if "inverted" in name else 0.0
    exact = -Curve(top, 0, K_R).bracket(mp.pi if pole else mpf(0)) if K_R else mpf(0)
    assert float(exact) == K_J == (pole_constants(top, K_R)[int(pole > 0)] if K_R else 0.0)
    E = 300.0
    curve = Curve(top, exact, K_R, E)
    for near in (1e-1, 1e-3, 1e-5, 1e-8):
        theta = abs(pole - near)
        x = mpf(theta)
        # 2E' belongs to the float K_J
        e = 2 * mpf(E) - curve.K_R**2 + curve.I1 / curve.I3 * mpf(K_J) ** 2
        expected = (e - curve.U(x)) / curve.f1_squared(x)
        compare("mpmath: f", f(theta, top, Constants(K_J, K_R, E)), expected, 1e-13, DIGITS,
                scale=float(abs(e) + K_R**2) / float(curve.f1_squared(x)))  # fmt: skip


def test_forces_at_hard_places(hard, compare):
    for theta in inside(hard):
        x = mpf(theta)
        value = hard.curve.f(x)
        exact = accuracy.forces(hard.curve, x, value)
        found = [*friction_force(theta, hard.top, hard.constants), normal_force(theta, hard.top, hard.constants)]
        size = (abs(hard.curve.e) + hard.curve.U(x)) / hard.curve.f1_squared(x) + hard.K_R**2
        size *= (1 + abs(mpf(hard.top.a))) ** 2
        for k, (got, (expected, _)) in enumerate(zip(found, exact, strict=True)):
            # F_x has the root of f as a factor, which feels f's rounding as 1/(2 f^(1/2))
            scale = float(size) * (max(1.0, float(size / mp.sqrt(value))) if k == 0 else 1.0)
            compare("mpmath: forces", got, expected, 1e-14, DIGITS, scale=scale)


@pytest.mark.slow
def test_turning_points_at_hard_places(hard, compare):
    expected = np.array([[float(x) for x in row] for row in hard.intervals])
    found = turning_points(hard.top, hard.constants)
    compare("mpmath: turning points", found, expected, 1e-12, DIGITS, scale=np.minimum(expected, 1))


@pytest.mark.slow
def test_periods_at_hard_places(hard, compare):
    found = Rolling(hard.top, hard.constants, well=hard.row).period
    compare("mpmath: period", found, hard.exact_period, 1e-12, DIGITS, scale=float(hard.exact_period))
