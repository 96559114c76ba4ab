"""Thresholds and steady states, compared with linearised equations of motion that contain neither, and published
numbers."""

import numpy as np
import pytest
import sliding_body as sb
from cases import BALL, PAPER
from scipy.optimize import brentq, minimize_scalar

from tippe_core import (
    Scales,
    State,
    Top,
    TopError,
    Viscous,
    jellett_potential,
    outcome,
    slide,
    steady_states,
    thresholds,
)

S = Top(a=0.3, I1=131 / 350, I3=0.4)
S_SCALES = Scales(R=0.02, M=0.02, g=9.82)
RISER = Top(a=-1.0, I1=2.0, I3=2.6)
FLAT = Top(a=0.1, I1=0.3, I3=0.45)
LONG = Top(a=0.1, I1=0.5, I3=0.4)
TOPS = [PAPER, S, RISER, FLAT, LONG, Top(a=-0.2, I1=0.5, I3=0.4), Top(a=-0.2, I1=0.3, I3=0.45)]


def viscous(u):
    return 0.5 * u


def growth(top, pole, spin):
    return sb.linearised(top, viscous, pole, spin).real.max()


@pytest.mark.parametrize("top", TOPS)
@pytest.mark.parametrize("pole", [1, -1])
def test_thresholds_are_where_the_largest_eigenvalue_crosses_zero(top, pole):
    limits = thresholds(top)
    change = limits.upright if pole == 1 else limits.inverted
    if pole == -1 and top.a == -1:
        return  # the inverted top's G is at the contact point
    if np.isnan(change.spin):
        for spin in (0.1, 1.0, 5.0, 20.0):
            assert (growth(top, pole, spin) < 0) == (change.stable == "always")
            assert change.holds(spin) == (change.stable == "always")
        return
    found = brentq(lambda w: growth(top, pole, w), change.spin / 2, change.spin * 2, xtol=1e-10)
    assert abs(found / change.spin - 1) < 1e-6
    assert (growth(top, pole, change.spin * 1.2) < 0) == (change.stable == "above") == change.holds(-1.2 * change.spin)


def test_the_friction_coefficient_drops_out():
    for gamma in (0.05, 3.0):

        def law(u, gamma=gamma):
            return gamma * u

        spin = brentq(lambda w, law=law: sb.linearised(PAPER, law, 1, w).real.max(), 1, 3, xtol=1e-10)
        assert abs(spin / thresholds(PAPER).upright.spin - 1) < 1e-6


@pytest.mark.parametrize(("top", "scales", "upright", "launch", "digits"),
                         [(PAPER, Scales.paper(), 43.56, 41.61, 2), (S, S_SCALES, 27.668, 76.761, 3)])  # fmt: skip
def test_published_spins(top, scales, upright, launch, digits):
    limits, unit = thresholds(top), scales.angular_velocity
    assert round(limits.upright.spin * unit, digits) == upright
    assert round(limits.launch * unit, digits) == launch
    assert limits.group == "can invert"
    # R|J| > sqrt(M g R^3 I3 alpha)(1 + alpha)^2/sqrt(1 + alpha - gamma), Rauch-Wojciechowski
    C_J = (top.I3 * top.a) ** 0.5 * (1 + top.a) ** 2 / (1 + top.a - top.I1 / top.I3) ** 0.5
    assert limits.launch * top.I3 * (1 - top.a) == pytest.approx(C_J, rel=1e-14)


def test_ordinary_top():
    limits = thresholds(RISER)
    assert limits.upright.stable == "above"
    assert limits.upright.spin == pytest.approx(1.118, abs=5e-4)
    assert outcome(RISER, State(0.1, 0, 0, 1.15)).verdict == "goes upright"
    assert outcome(RISER, State(0.1, 0, 0, 1.05)).verdict == "hangs"


def test_groups():
    groups = ["can invert", "can invert", "can stand upright", "never rises", "rises part of the way",
              "never stands upright", "can stand upright", "neutral"]  # fmt: skip
    assert [thresholds(top).group for top in [*TOPS, BALL]] == groups


def test_how_far_a_long_top_rises():
    limit = thresholds(LONG).rise
    fast = [outcome(LONG, State(0.1, 0, 0, w)).theta for w in (3.0, 10.0, 100.0, 1000.0)]
    assert all(np.diff(fast) > 0)
    assert fast[-1] < limit == pytest.approx(fast[-1], abs=1e-5)


@pytest.mark.parametrize("top", TOPS)
@pytest.mark.parametrize("C_J", [0.05, 0.3, -0.9, 4.0])
def test_steady_states_are_the_extrema_on_a_grid(top, C_J):
    theta = np.linspace(0, np.pi, 20001)
    V = jellett_potential(theta, top, C_J)
    slope = np.sign(np.diff(V))
    least = np.flatnonzero(np.diff([-1, *slope, 1]) > 0)
    steady = steady_states(top, C_J)
    np.testing.assert_allclose(steady.theta[steady.stable], theta[least], atol=2e-4)
    for x in steady.theta[steady.stable]:
        bounds = max(x - 0.1, 0), min(x + 0.1, np.pi)
        around = minimize_scalar(jellett_potential, bounds, args=(top, C_J), bounds=bounds, method="bounded")
        assert jellett_potential(x, top, C_J) <= around.fun + 1e-12


def test_the_three_regimes_of_S():
    def at(rad_per_s):
        return outcome(S, State(0.1, 0, 0, rad_per_s / S_SCALES.angular_velocity))

    assert [at(w).verdict for w in (25, 60, 90)] == ["goes upright", "hangs", "turns over"]
    assert at(60).theta == pytest.approx(1.90888, abs=5e-6)
    rev = S_SCALES.angular_velocity / (2 * np.pi)
    limits = at(90).thresholds
    assert f"{at(90).launch * rev:.3g} {limits.upright.spin * rev:.2g} {limits.launch * rev:.3g}" == "14.2 4.4 12.2"
    assert (limits.upright.stable, limits.inverted.stable) == ("below", "above")
    assert outcome(PAPER, State(0.1, 0, 0, 42 / Scales.paper().angular_velocity)).verdict == "goes upright"
    assert outcome(BALL, State(0.7, 0, 0, 3.0)).theta == 0.7


@pytest.mark.parametrize("spin", [25.0, 60.0, 90.0])
def test_the_last_tilt_and_spin_are_those_of_a_run(spin):
    """Goes upright, hangs, turns over: what a run comes to, by a law that leaves C_J as it was."""
    start = State(0.1, 0, 0, spin / S_SCALES.angular_velocity)
    found, moved = outcome(S, start), slide(S, start, Viscous(0.3), np.linspace(0, 1500, 9), rtol=1e-9)
    assert moved.theta[-1] == pytest.approx(found.theta, abs=1e-6)
    assert moved.omega[-1, 2] == pytest.approx(found.omega3, rel=1e-6)


def test_a_start_with_energy_for_both_ends_says_so():
    between = State(2.5, 0, 0, 42 / Scales.paper().angular_velocity)
    assert outcome(PAPER, between).certain
    assert not outcome(PAPER, State(0.1, 2.0, 0, between.omega3)).certain


@pytest.mark.parametrize("moves", ["theta_dot", "vx", "vy"])
def test_a_start_is_certain_up_to_the_energy_of_the_barrier(moves):
    """The energy of the body in space, in motion that leaves C_J as it is: at most the maximum of V_J in between."""
    C_J, theta = 0.6325, 0.6
    s, c = np.sin(theta), np.cos(theta)
    I_eff = PAPER.I1 * s * s + PAPER.I3 * (c - PAPER.a) ** 2
    rest = {"theta": theta, "theta_dot": 4e-3, "omega2": C_J * s / I_eff, "omega3": C_J * (c - PAPER.a) / I_eff,
            "vx": 3e-3, "vy": -2e-3}  # fmt: skip

    def energy(speed):
        q, omega, velocity, com = sb.first_instant(PAPER, State(**rest | {moves: speed}))
        along = sb.matrix(q).T @ omega
        return (along**2 @ [PAPER.I1, PAPER.I1, PAPER.I3] + velocity @ velocity) / 2 + com[2] - (1 - PAPER.a)

    barrier = jellett_potential(np.linspace(theta, 1.5, 1001), PAPER, C_J).max()
    speed = brentq(lambda speed: energy(speed) - barrier, 0.0, 1.0)
    for share, certain in ((0.999, True), (1.001, False)):
        found = outcome(PAPER, State(**rest | {moves: share * speed}))
        assert found.certain == certain and found.C_J == pytest.approx(C_J, rel=1e-12)


@pytest.mark.parametrize(("name", "call"), [
    ("state", lambda: outcome(PAPER, 3)),
    ("C_J", lambda: steady_states(PAPER, np.nan)),
    ("C_J", lambda: steady_states(PAPER, 1e200)),
    ("omega3", lambda: outcome(PAPER, State(1.0, 0, 0, 1e160))),
])  # fmt: skip
def test_bad_input_is_named(name, call):
    with pytest.raises(TopError) as caught:
        call()
    assert caught.value.name == name
