"""A body that rocks on a table: its period, and what follows from a measured one."""

from math import pi, sqrt

import numpy as np
import pytest
import rigid_body as rb
from hypothesis import given
from hypothesis import strategies as st
from references import kept
from scipy.optimize import brentq
from test_shapes import SHAPES

from tippe_core import (
    Ball,
    LoadedSphere,
    Scales,
    Top,
    TopError,
    a_from_rocking,
    dimension_from_rocking,
    rocking_period,
)

# --- rocking ---


@kept
def simulated_period(top, amplitude):
    """(period,) of the body released at rest at theta = amplitude: twice the time from one upright to the next."""
    body, start = rb.Body.of(top), rb.euler_quaternion(0, amplitude, 0)

    def tilt(t):
        return float(rb.integrate(body, start, np.zeros(3), [0, t]).quaternion[-1, 0])

    guess = 2 * pi * sqrt((top.I1 + (1 - top.a) ** 2) / top.a)
    passes = [brentq(tilt, at * 0.95 * guess, at * 1.05 * guess, xtol=1e-13, rtol=1e-14) for at in (0.25, 0.75)]
    return (2 * (passes[1] - passes[0]),)


@pytest.mark.parametrize("name", ["The paper's tippe top", "Top S", "Loaded sphere", "cavity"])
def test_rocking_period_is_the_rolling_bodys_for_small_swings(name):
    """The full body's period tends to the formula's as the square of the amplitude."""
    top = SHAPES[name].top
    gaps = np.array([simulated_period(top, amplitude)[0] / rocking_period(top) - 1 for amplitude in (0.08, 0.04, 0.02)])
    assert gaps[:-1] / gaps[1:] == pytest.approx(4, rel=0.01)
    # twice extrapolated: amplitude^2, then amplitude^4
    once = (4 * gaps[1:] - gaps[:-1]) / 3
    assert (16 * once[1] - once[0]) / 15 == pytest.approx(0, abs=1e-10)


@given(st.floats(0.001, 0.95), st.floats(0.05, 0.8), st.floats(0.005, 0.1))
def test_a_from_the_period(a, I1, R):
    top = Top(a, I1, I1)
    scales = Scales(R=R, M=1.0)
    found = a_from_rocking(T=rocking_period(top) * scales.time, R=R, I1=I1)
    assert found.value == pytest.approx(a, rel=1e-9)


def test_uncertainty_of_a_is_the_spread_of_many_measurements():
    rng = np.random.default_rng(1)
    errors = {"T": 0.01, "R": 5e-5, "I1": 0.004, "g": 0.01}
    values = {"T": 1.08, "R": 0.016, "I1": 0.399, "g": 9.81}
    found = a_from_rocking(**values, **{"d" + name: error for name, error in errors.items()})
    draws = [{name: rng.normal(values[name], errors[name]) for name in values} for _ in range(20000)]
    drawn = [a_from_rocking(**draw).value for draw in draws]
    assert found.value == pytest.approx(np.mean(drawn), abs=0.03 * np.std(drawn))
    assert found.uncertainty == pytest.approx(np.std(drawn), rel=0.03)
    assert found.shares["T"] == max(found.shares.values())
    for name in values:
        one = [a_from_rocking(**values | {name: rng.normal(values[name], errors[name])}).value for _ in range(5000)]
        assert found.shares[name] == pytest.approx(np.std(one), rel=0.05)


def test_a_dimension_from_the_period():
    """The depth of a core from the stopwatch, and its uncertainty from two stopwatches."""

    def loaded(d):
        return LoadedSphere(R=0.02, b=0.008, d=d, density=1190.0, core_density=7850.0)

    T = rocking_period(loaded(0.0071).top) * loaded(0.0071).scales.time
    found = dimension_from_rocking(loaded, T=T, dT=0.002, low=0.0, high=0.0119)
    assert found.value == pytest.approx(0.0071, rel=1e-10)
    apart = [dimension_from_rocking(loaded, T=T + dT, low=0.0, high=0.0119).value for dT in (-0.002, 0.002)]
    assert found.uncertainty == pytest.approx(abs(apart[1] - apart[0]) / 2, rel=0.01)
    apart = [dimension_from_rocking(loaded, T=T, g=9.81 + dg, low=0.0, high=0.0119).value for dg in (-0.01, 0.01)]
    found = dimension_from_rocking(loaded, T=T, dg=0.01, low=0.0, high=0.0119)
    assert found.shares["g"] == found.uncertainty == pytest.approx(abs(apart[1] - apart[0]) / 2, rel=0.01)
    with pytest.raises(TopError, match=r"T = 0.2 .* reached once"):
        dimension_from_rocking(loaded, T=0.2, low=0.0, high=0.0119)


def test_rocking_that_cannot_be():
    with pytest.raises(TopError, match="a = 0 "):
        rocking_period(Ball(R=0.02, M=0.04).top)
    with pytest.raises(TopError, match=r"T = 0.1 .* T > 0\.\d+ s"):
        a_from_rocking(T=0.1, R=0.016, I1=0.4)
    with pytest.raises(TopError, match="dT = -1"):
        a_from_rocking(T=1.0, R=0.016, I1=0.4, dT=-1)
    with pytest.raises(TopError, match="low = 0 "):
        dimension_from_rocking(lambda d: Ball(R=0.02, M=0.04), T=1.0, low=0.0, high=1.0)
