"""Each equation has one source: with a sign of it changed, floats, arrays, Decimals and compiled code change alike."""

import ast
import inspect
import types
from decimal import Decimal, localcontext

import numpy as np
import pytest
from cases import PAPER, TOPS
from high_precision import Curve, mp, mpf

from tippe_core import Constants, State
from tippe_core.compiled import compiled
from tippe_core.paper import curve, equations, wells
from tippe_core.paper.constants import EXACT, Exact, exact_top
from tippe_core.paper.poles import Floats, bracket_near, pole_offsets

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
    _ = compiled(flat).dispatcher  # before the first, numba has not been told which functions kernels share
    kernel = numba.njit(error_model="numpy")(function)(*given, PAPER.numbers)  # and not compiled(), which keeps it
    first = tuple(x[0] for x in array) if isinstance(array, tuple) else array[0]
    return [flat(x) for x in (function(*given, PAPER), first, exact, kernel)]


@pytest.mark.parametrize("name", FUNCTIONS)
def test_a_changed_sign_changes_all_four_alike(name):
    before, after = by_all_four(equations, name), by_all_four(changed(name), name)
    for value in before[1:]:
        np.testing.assert_allclose(value, before[0], rtol=1e-13, atol=1e-14)
    for value in after[1:]:
        np.testing.assert_allclose(value, after[0], rtol=1e-13, atol=1e-14)
    assert np.abs(after[0] - before[0]).max() > 1e-3


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


def test_energies_come_back():
    """(33) there and back, and (33) of a motion."""
    state = State(0.8, 0.3, 1.5, 4.0)
    constants = Constants.from_state(PAPER, state.theta, state.theta_dot, state.omega2, state.omega3)
    e = constants.two_E_prime(PAPER)
    assert equations.E_of(e, constants.K_J, constants.K_R, PAPER) == pytest.approx(constants.E, rel=1e-14)
    assert float(Exact.of_state(state, PAPER).e) == pytest.approx(e, rel=1e-13)
