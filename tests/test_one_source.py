"""Each equation has one source: if one of its signs is changed, floats, arrays, Decimals and compiled code all
change."""

import ast
import inspect
import types
from decimal import Decimal, localcontext

import numpy as np
import pytest
from cases import PAPER, TOPS
from high_precision import Curve, mp, mpf

from tippe_core import Constants, State
from tippe_core.compiled import share_called
from tippe_core.paper import curve, differences, equations, wells
from tippe_core.paper.constants import EXACT, Exact, exact_top
from tippe_core.paper.poles import Floats, K_J_of_pole, bracket_near, pole_offsets

numba = pytest.importorskip("numba")
pytestmark = pytest.mark.skipif(numba.config.DISABLE_JIT, reason="nothing is compiled")

FUNCTIONS = [name for name, value in vars(equations).items()
             if inspect.isfunction(value) and value.__module__ == equations.__name__]  # fmt: skip
OTHER = {ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Div: ast.Mult, ast.Mult: ast.Div}


class Change(ast.NodeTransformer):
    """Turns the n-th sign of a function, the signs + and - before the others."""

    def __init__(self, kinds, n):
        self.kinds, self.left, self.done = kinds, n, False

    def visit_BinOp(self, node):
        if isinstance(node.op, self.kinds):
            if self.left == 0:
                node.op, self.done = OTHER[type(node.op)](), True
            self.left -= 1
        return self.generic_visit(node)


def changed(name, n=0):
    """equations.py with a sign of one function turned, as a module of its own."""
    tree = ast.parse(inspect.getsource(equations))
    function = next(node for node in tree.body if isinstance(node, ast.FunctionDef) and node.name == name)
    for kinds in ((ast.Add, ast.Sub), (ast.Div, ast.Mult)):
        change = Change(kinds, n)
        change.visit(function)
        if change.done:
            break
    assert change.done, name
    module = types.ModuleType("tippe_core.paper.changed")
    module.__package__ = "tippe_core.paper"
    exec(compile(ast.fix_missing_locations(tree), equations.__file__, "exec"), vars(module))
    return module


def arguments(name):
    """Floats for all parameters but the top, none of them special."""
    names = [x for x in inspect.signature(getattr(equations, name)).parameters if x != "top"]
    return [0.3 + 0.17 * k for k in range(len(names))]


def flat(value):
    return np.array([float(x) for x in (value if isinstance(value, tuple) else (value,))])


def by_all_four(module, name):
    """The function's value by floats, an array, Decimals and a compiled kernel."""
    function, given = getattr(module, name), arguments(name)
    array = function(*(np.array([x, x]) for x in given), PAPER)
    with localcontext(EXACT):
        exact = function(*map(Decimal, given), exact_top(PAPER))
    share_called(function)
    kernel = numba.njit(error_model="numpy")(function)(*given, PAPER.numbers)  # not compiled(), which would store it
    first = tuple(x[0] for x in array) if isinstance(array, tuple) else array[0]
    return [flat(x) for x in (function(*given, PAPER), first, exact, kernel)]


@pytest.mark.parametrize("name", FUNCTIONS)
def test_a_changed_sign_changes_all_four_alike(name):
    before, after = flat(getattr(equations, name)(*arguments(name), PAPER)), by_all_four(changed(name), name)
    for value in after[1:]:
        np.testing.assert_allclose(value, after[0], rtol=1e-13, atol=1e-14)
    assert np.abs(after[0] - before).max() > 1e-3


@pytest.mark.parametrize("name", ["f1_2", "f2_2", "U", "theta_dot_2", "two_E_prime"])
def test_f_changes_alike_in_floats_and_in_decimals(name, monkeypatch):
    """The kernels' Python is what runs here: f of a number, of an array, and point by point in Decimals."""
    constants, theta = Constants(7.0, 10.0, 28.0), np.array([0.5, 0.7, 1.9])
    plain = getattr(curve.theta_dot_2_on, "py_func", curve.theta_dot_2_on)
    monkeypatch.setattr(curve, "theta_dot_2_on", plain)
    before = curve.f(theta, PAPER, constants)
    monkeypatch.setattr(equations, name, getattr(changed(name), name))
    after = curve.f(theta, PAPER, constants)
    assert np.abs(after - before).min() > 1e-3
    assert curve.f(0.7, PAPER, constants) == pytest.approx(after[1], rel=1e-14)
    exact = curve.exact_f(PAPER, theta, *(np.full(3, K) for K in (7.0, 10.0, 28.0)))
    np.testing.assert_allclose(exact, after, rtol=1e-10)


@pytest.mark.parametrize("top", TOPS.values(), ids=TOPS.keys())
def test_the_bracket_next_to_a_pole_is_that_of_36(top):
    """B = d + x C against the printed bracket in fifty digits, at both poles and far from them."""
    K_J, K_R = 3.0, 7.0
    exact = Curve(top, K_J, K_R)
    offsets = [float(d) for d in pole_offsets(top, K_J, K_R)]
    for side in (1.0, -1.0):
        for x in (1e-20, 1e-6, 0.01, 0.4, 1.0):
            theta = mp.acos(side * (1 - mpf(x)))
            B, w3 = bracket_near(side, x, Floats(top.numbers, K_R, *offsets))
            assert B == pytest.approx(float(exact.bracket(theta)), rel=1e-14, abs=1e-14 * K_R)
            assert w3 == pytest.approx(float(exact.omega3(theta)), rel=1e-14)


@pytest.mark.parametrize("top", TOPS.values(), ids=TOPS.keys())
def test_the_slope_of_U_is_that_of_U(top):
    """s^4 dU/dc against U differentiated numerically in fifty digits."""
    exact, K_J, K_R = wells.ExactCurve.of(top, 3.0, 7.0), 3.0, 7.0
    reference = Curve(top, K_J, K_R)
    for c in (-0.9, -0.3, 0.2, 0.95):
        expected = mp.diff(lambda c: reference.U(mp.acos(c)), mpf(c)) * (1 - mpf(c) ** 2) ** 2
        with localcontext(EXACT):
            assert float(exact.N(Decimal(c))) == pytest.approx(float(expected), rel=1e-12)


def exactly(x):
    return Decimal(float(x))


def printed_slope(equations, side, x, K_R, top):
    """C of B = d + x C by the printed bracket of (36), in Decimals: B/x of the trajectory through the pole."""
    with localcontext(EXACT):
        t, x, K_R = exact_top(top), exactly(x), exactly(K_R)
        c, pole = exactly(side) * (1 - x), exactly(side)
        w3 = equations.omega3(c, x * (2 - x), K_R, t)
        return equations.bracket(c, equations.K_J_of_spin(pole, equations.omega3(pole, 0, K_R, t), t), w3, t) / x


def rearranged_slope(side, x, K_R, top):
    """The same by poles.py."""
    through = Floats(top.numbers, K_R, 0.0, 0.0)
    return bracket_near(side, x, through)[0] / x


PLACES = [(side, x) for side in (1.0, -1.0) for x in (1e-9, 0.01, 0.4, 1.0, 1.7)]


@pytest.mark.parametrize("top", TOPS.values(), ids=TOPS.keys())
def test_the_slope_next_to_a_pole_is_that_of_the_printed_bracket(top):
    for side, x in PLACES:
        assert rearranged_slope(side, x, 7.0, top) == pytest.approx(
            float(printed_slope(equations, side, x, 7.0, top)), rel=1e-13, abs=1e-13)  # fmt: skip


@pytest.mark.parametrize("name, n", [("bracket", 0), ("K_J_of_spin", 0), ("f3_2", 2)])
def test_a_changed_sign_parts_the_printed_bracket_from_the_one_next_to_a_pole(name, n, monkeypatch):
    """Of f3_2 the sign in (c - a), for with another f3^2 < 0; further from the pole both follow f3_2 alike."""
    monkeypatch.setattr(equations, name, getattr(changed(name, n), name))
    for side, x in (place for place in PLACES if place[1] < 1):
        printed = float(printed_slope(equations, side, x, 7.0, PAPER))
        assert abs(rearranged_slope(side, x, 7.0, PAPER) - printed) > 1e-3 * abs(printed)


def test_the_pole_that_the_bracket_is_counted_from_is_that_of_the_printed_one():
    """K_J_of_pole is where the printed bracket vanishes."""
    with localcontext(EXACT):
        t = exact_top(PAPER)
        for side in (Decimal(1), Decimal(-1)):
            w3 = equations.omega3(side, 0, Decimal(7), t)
            assert equations.bracket(side, K_J_of_pole(side, Decimal(7), t), w3, t) == 0


STEP = Decimal("1e-20")  # of c, where the printed derivatives are taken as quotients in sixty digits


def along(c, K_J, K_R, e, t):
    """w2, w3, the bracket, U and f at c by the printed forms, in Decimals."""
    s2 = 1 - c * c
    w3 = equations.omega3(c, s2, K_R, t)
    B = equations.bracket(c, K_J, w3, t)
    U = equations.U(1 - c, c, s2, B * B / s2, t)
    return B / s2.sqrt(), w3, B, U, equations.theta_dot_2(e, U, c, t)


@pytest.mark.parametrize("top", TOPS.values(), ids=TOPS.keys())
def test_the_slopes_and_the_forces_are_those_of_the_printed_forms(top):
    """bracket_slope, s4_U_slope and force_terms, with (37) to (39) as the paper prints them."""
    K = Decimal(3), Decimal(7), Decimal(90)
    with localcontext(EXACT):
        t = exact_top(top)
        for c in map(Decimal, ("-0.9", "-0.3", "0.2", "0.95")):
            s2, s = 1 - c * c, (1 - c * c).sqrt()
            w2, w3, B, _, f = along(c, *K, t)
            before, after = along(c - STEP, *K, t), along(c + STEP, *K, t)
            dB, dU, df = ((after[i] - before[i]) / (2 * STEP) for i in (2, 3, 4))
            slope = equations.bracket_slope(c, s2, w3, t)
            assert float(slope) == pytest.approx(float(dB), rel=1e-12)
            assert float(equations.s4_U_slope(c, s2, B, slope, t)) == pytest.approx(float(s2 * s2 * dU), rel=1e-12)
            f_prime, w1 = -s * df, abs(f).sqrt()  # of theta
            F_z = 1 + t.a * (s * f_prime / 2 + c * f)
            F_x = -t.I3 * w3 * w1 / equations.f3_2(c, s2, t) * (c - t.I3 / t.I1 * (c - t.a))
            F_y = t.a * s * F_z + t.I1 * f_prime / 2 - t.I1 * c / s * w2 * w2 + t.I3 * w2 * w3
            X, Y, Z = equations.force(c, s, w1, f, w2, w3, t)
            assert [float(x) for x in (X, (1 - t.a * c) * Y, Z)] == pytest.approx(
                [float(x) for x in (F_x, F_y, F_z)], rel=1e-12, abs=1e-12)  # fmt: skip


@pytest.mark.parametrize("top", TOPS.values(), ids=TOPS.keys())
@pytest.mark.parametrize("places", [("0.9", "-0.4", "0.3"), ("0.3", "0.2999999999", "0.29999999995")])
def test_the_divided_difference_is_that_of_the_printed_equation(top, places):
    """Q in floats against the quotients of quotients of s^2 (2E' - U) in sixty digits."""
    K = Decimal(3), Decimal(7), Decimal(20)
    with localcontext(EXACT):
        t, c = exact_top(top), [exactly(x) for x in places]
        *_, B, U, _ = zip(*(along(x, *K, t) for x in c), strict=True)
        one, two, here = ((1 - x * x) * (K[2] - u) for x, u in zip(c, U, strict=True))
        expected = ((two - here) / (c[1] - c[2]) - (one - two) / (c[0] - c[1])) / (c[0] - c[2])
        expected = float(expected / equations.f1_2(c[2], t))
        given = [differences.Place(float(x), float(1 - x * x), float(equations.f3_2(x, 1 - x * x, t).sqrt()), float(b))
                 for x, b in zip(c, B, strict=True)]  # fmt: skip
    assert differences.Q(*given, 7.0, 20.0, top) == pytest.approx(expected, rel=1e-12, abs=1e-11)


def test_energies_come_back():
    """(33) there and back, and (33) of a motion."""
    state = State(0.8, 0.3, 1.5, 4.0)
    constants = Constants.from_state(PAPER, state.theta, state.theta_dot, state.omega2, state.omega3)
    e = constants.two_E_prime(PAPER)
    assert equations.E_of(e, constants.K_J, constants.K_R, PAPER) == pytest.approx(constants.E, rel=1e-14)
    assert float(Exact.of_state(state, PAPER).e) == pytest.approx(e, rel=1e-13)
