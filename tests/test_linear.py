"""Growth and rotation of small motions, compared with central differences of another formulation, runs, and
thresholds."""

from functools import partial

import numpy as np
import pytest
import sliding_body

from tippe_core import (
    Contensou,
    Coulomb,
    SmoothedCoulomb,
    State,
    Top,
    TopError,
    Viscous,
    roll,
    slide,
    spinning_modes,
    steady_states,
    thresholds,
    tumbling_modes,
)
from tippe_core.linear import tumbling

PAPER, S, TOY = Top.paper(), Top(a=0.3, I1=131 / 350, I3=0.4), Top(a=0.2, I1=16 / 27, I3=14 / 27)
LAWS = (Viscous(0.3), SmoothedCoulomb(0.3, 0.5), Contensou(0.3, 1 / 30))


@pytest.mark.parametrize("top", [PAPER, S, TOY, Top(-1.0, 2.0, 2.6)])
@pytest.mark.parametrize("inverted", [False, True])
def test_eigenvalues_of_another_formulation(top, inverted):
    """Six real unknowns by central differences; three complex ones and their conjugates here."""
    for gamma, spin in ((0.3, 5.0), (1.5, 9.0), (0.05, -4.0)):
        found = spinning_modes(top, Viscous(gamma), spin, inverted)
        both = np.concatenate([found, found.conj()])
        law = partial(np.multiply, gamma)
        other = sliding_body.linearised(top, law, -1 if inverted else 1, spin)
        for one in other:
            assert np.abs(both - one).min() < 1e-7


@pytest.mark.parametrize("law", LAWS)
def test_growth_changes_its_sign_at_the_thresholds(law):
    for top in (PAPER, S, TOY):
        limits = thresholds(top)
        for change, inverted in ((limits.upright, False), (limits.inverted, True)):
            below, above = (spinning_modes(top, law, part * change.spin, inverted)[0].real for part in (0.999, 1.001))
            assert (below < 0) == (change.stable == "below") and (above < 0) == (change.stable == "above")


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize(("top", "spin"), [(PAPER, 9.0), (S, 5.0), (TOY, 7.04)])
def test_a_run_grows_as_its_fastest_mode(law, top, spin):
    """From 1e-7 rad on, once the other modes have died away; at the spin that pivoting has left by then."""
    growth, others = spinning_modes(top, law, spin)[:2].real
    t0 = min(8 / (growth - others), 8 / growth)
    times = np.linspace(0, t0 + 1 / growth, 400)
    moved = slide(top, State(1e-7, 0, 0, spin), law, times, rtol=1e-11)
    late = times > t0
    found = np.polyfit(times[late], np.log(moved.theta[late]), 1)[0]
    assert found == pytest.approx(spinning_modes(top, law, moved.omega[late, 2].mean())[0].real, rel=0.01)


@pytest.mark.parametrize("law", [*LAWS, Coulomb(0.3)])
def test_tumbling_is_steady_and_stable_where_the_potential_is_least(law):
    for theta in (1.0, 1.5, 1.9, 2.4):
        y = tumbling(S, theta)
        moved = slide(S, State(theta, 0, y[2], y[3], vx=0, vy=0), law, np.linspace(0, 5, 9), rtol=1e-11)
        if not isinstance(law, Contensou):  # whose pivoting slows it
            np.testing.assert_allclose(moved.theta, theta, atol=1e-8)
        modes = tumbling_modes(S, law, theta)
        assert np.abs(modes).min() < 1e-9
        c = np.cos(theta)
        C_J = S.I1 * np.sin(theta) * y[2] + S.I3 * (c - S.a) * y[3]
        steady = steady_states(S, C_J)
        stable = bool(steady.stable[np.argmin(np.abs(steady.theta - theta))])
        assert np.abs(steady.theta - theta).min() < 1e-9
        if not isinstance(law, Coulomb):
            assert (modes.real.max() < 1e-9) == stable


def test_rolling_about_a_precession_turns_as_the_nutation_does():
    """By friction that holds: a pair of imaginary numbers, the frequency of a small nutation."""
    theta = 1.5
    y = tumbling(S, theta)
    modes = tumbling_modes(S, Coulomb(0.3), theta)
    state = State(theta + 1e-4, 0, y[2], y[3])
    times = np.linspace(0, 40, 20001)
    moved = roll(S, None, times, state).theta
    crossings = np.flatnonzero(np.diff(np.sign(moved - moved.mean())) > 0)
    period = np.diff(times[crossings]).mean()
    assert np.abs(modes.real).max() < 1e-9 and modes.imag.max() == pytest.approx(2 * np.pi / period, rel=1e-3)


@pytest.mark.parametrize("inverted", [False, True])
@pytest.mark.parametrize(("top", "spin"), [(PAPER, 9.0), (S, -6.0), (TOY, 12.0)])
def test_rolling_beside_a_pole_has_the_two_modes(top, spin, inverted):
    """By friction that holds: e_x + i e_y of a rolling run obeys the linear recursion of two exponentials."""
    modes = spinning_modes(top, Coulomb(0.3), spin, inverted)
    step, pole = 0.05, np.pi if inverted else 0.0
    moved = roll(top, None, np.arange(0, 20, step), State(abs(pole - 1e-4), 0, 0, spin))
    xi = np.sin(moved.theta) * np.exp(1j * moved.phi)
    found, *_ = np.linalg.lstsq(np.column_stack([xi[1:-1], -xi[:-2]]), xi[2:])
    expected = np.exp(step * modes)
    np.testing.assert_allclose(found, [expected.sum(), expected.prod()], atol=1e-6)


STICKING = (
    (Contensou(0.3, 0.0), 9.0), (Contensou(0.3, 1e-14), 9.0), (Contensou(0.3, 0.01), 0.0),
    (Contensou(0.3, 0.01), 1e-12), (SmoothedCoulomb(0.3, 1e-14), 9.0), (SmoothedCoulomb(0.3, 1e-300), 9.0),
    (Viscous(1e15), 9.0))  # fmt: skip


@pytest.mark.parametrize("inverted", [False, True])
@pytest.mark.parametrize(("law", "spin"), STICKING)
def test_a_contact_that_no_push_can_move_rolls(law, spin, inverted):
    """e_x + i e_y of a rolling run obeys the linear recursion of the two exponentials, whichever law makes it roll."""
    modes = spinning_modes(PAPER, law, spin, inverted)
    step, pole = 0.05, np.pi if inverted else 0.0
    moved = roll(PAPER, None, np.arange(0, 10, step), State(abs(pole - 1e-5), 0, 0, spin))
    xi = np.sin(moved.theta) * np.exp(1j * moved.phi)
    assert len(modes) == 2
    expected = np.exp(step * modes)
    np.testing.assert_allclose(xi[2:], expected.sum() * xi[1:-1] - expected.prod() * xi[:-2], atol=1e-11)


@pytest.mark.parametrize(("law", "spin"), [(Contensou(0.3, 0.01), 0.0), (Contensou(0.3, 0.0), 0.0),
                                           (Contensou(0.3, 0.0), 0.1)])  # fmt: skip
def test_a_run_that_falls_over_rolling_grows_as_its_fastest_mode(law, spin):
    """Inverted, by the equations of sliding, in which the contact may stick."""
    growth = spinning_modes(PAPER, law, spin, True)[0].real
    times = np.linspace(0, 12 / growth, 400)
    moved = slide(PAPER, State(np.pi - 1e-7, 0, 0, spin), law, times, rtol=1e-11)
    late = times > 8 / growth
    assert growth == pytest.approx(np.polyfit(times[late], np.log(np.pi - moved.theta[late]), 1)[0], rel=1e-3)


@pytest.mark.parametrize("inverted", [False, True])
@pytest.mark.parametrize("spin", [0.0, 1e-12, 9.0])
def test_slower_modes_tend_to_rolling_as_a_patch_shrinks(spin, inverted):
    """The other one dies away at once; what is left differs by 1/k, below and above the k that counts as sticking."""
    rolling = spinning_modes(PAPER, Coulomb(0.3), spin, inverted)
    for w in (1e-5, 1e-8, 1e-9, 1e-10, 1e-14, 1e-301, 0.0):  # radius |omega_n|
        law = Contensou(0.3, w / (spin or 1.0))
        found = spinning_modes(PAPER, law, spin, inverted)
        for one in rolling:
            assert np.abs(found - one).min() < 1e3 * w + 2e-7
        assert not np.any(found.real[2:] > -1e4)


@pytest.mark.parametrize(
    "law", [Contensou(0.3, 0.0), Contensou(0.3, 1e-14), SmoothedCoulomb(0.3, 1e-14), Viscous(1e15)]
)
def test_a_tumbling_contact_that_no_push_can_move_rolls(law):
    theta = 1.5
    y = tumbling(S, theta)
    modes = tumbling_modes(S, law, theta)
    times = np.linspace(0, 20, 10001)
    moved = roll(S, None, times, State(theta + 1e-4, 0, y[2], y[3])).theta
    period = np.diff(times[np.flatnonzero(np.diff(np.sign(moved - moved.mean())) > 0)]).mean()
    assert len(modes) == 4 and np.abs(modes.real).max() < 1e-9
    assert modes.imag.max() == pytest.approx(2 * np.pi / period, rel=1e-3)


def test_what_has_no_steady_tumbling():
    with pytest.raises(TopError):
        tumbling_modes(PAPER, Viscous(0.3), 0.0)
    with pytest.raises(TopError):
        tumbling_modes(Top(0.3, 0.2, 0.4), Viscous(0.3), 0.5)
