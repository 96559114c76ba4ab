"""slide_many() compared with slide(), run by run, and with what is known of the ends."""

import os
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from tippe_core import (
    Contensou,
    Coulomb,
    Scales,
    SmoothedCoulomb,
    State,
    Top,
    TopError,
    TruncatedSphere,
    Viscous,
    beside,
    ending,
    roll,
    slide,
    slide_many,
)

PAPER, EDGE = Top.paper(), TruncatedSphere.paper().edge
SPINS, TILTS = np.array([3.0, 5.5, 9.0]), np.array([0.1, 1.2, 2.9])
STARTS = SimpleNamespace(theta=TILTS[:, None], theta_dot=0.0, omega2=0.0, omega3=SPINS)


@pytest.mark.parametrize("friction", [Coulomb(0.3), SmoothedCoulomb(0.3, 0.1), Viscous(0.3), Contensou(0.3, 1 / 30)])
def test_run_by_run(friction):
    """The same motion at a coarser tolerance, with nothing kept of it but its end."""
    t_end, times = 40.0, np.linspace(0, 40, 4001)
    many = slide_many(PAPER, STARTS, friction, t_end, EDGE, rtol=1e-8)
    assert many.end.shape == (3, 3) and not many.theta_end.flags.writeable
    for i, j in np.ndindex(3, 3):
        moved = slide(PAPER, State(TILTS[i], 0, 0, SPINS[j]), friction, times, edge=EDGE)
        what = [name for _, name in moved.events]
        assert many.hops[i, j] == what.count("lifts off") and many.flew[i, j] == (many.hops[i, j] > 0)
        passed = np.flatnonzero(np.diff(np.sign(moved.theta - np.pi / 2)))
        t90 = np.nan
        if passed.size:
            k = passed[0]
            t90 = np.interp(0, (moved.theta - np.pi / 2)[k : k + 2] * np.sign(moved.omega[k, 0]), times[k : k + 2])
        assert many.time_90[i, j] == pytest.approx(t90, abs=1e-3, nan_ok=True)
        assert moved.time_90 == pytest.approx(t90, abs=1e-3, nan_ok=True)
        assert many.end[i, j] == ending(moved).end, (i, j)
        assert abs(many.energy_error[i, j]) < 1e-6
        if moved.events and moved.events[-1][1] == "stands upright":
            continue
        now, end = many.state_end, moved.theta[-1]
        assert many.theta_end[i, j] == now.theta[i, j] == pytest.approx(end, abs=1e-4)
        assert many.heat[i, j] == pytest.approx(moved.heat[-1], abs=1e-4)
        rates = [part[i, j] for part in (now.theta_dot, now.omega2, now.omega3)]
        np.testing.assert_allclose(rates, moved.omega[-1], rtol=0, atol=2e-3)
        np.testing.assert_allclose([now.x[i, j], now.y[i, j]], moved.com[-1, :2], rtol=0, atol=1e-3)
        np.testing.assert_allclose(np.exp(1j * now.phi[i, j]), np.exp(1j * moved.phi[-1]), rtol=0, atol=1e-3)


def test_rolling_for_good_is_the_exact_motion():
    """Whole nutations are skipped; roll()'s series is the end of it all the same."""
    state, friction = State(1.0, 0.3, 0.2, 6.0), Coulomb(0.3, 0.6)
    (moved, many) = (slide(PAPER, state, friction, [0, 400.0]), slide_many(PAPER, state, friction, 400.0, rtol=1e-10))
    assert [what for _, what in moved.events] == ["sticks"] and many.end == "leaning"
    now = many.state_end
    assert many.theta_end == pytest.approx(moved.theta[-1], abs=1e-6)
    np.testing.assert_allclose([now.x, now.y], moved.com[-1, :2], rtol=0, atol=1e-5)
    for mine, other in ((now.phi, moved.phi), (now.psi, moved.psi)):
        np.testing.assert_allclose(np.exp(1j * mine), np.exp(1j * other[-1]), rtol=0, atol=1e-5)
    assert abs(many.energy_error) < 1e-8 and many.C_J_drift < 1e-8


ROLLS = Coulomb(5.0)  # enough friction to roll from the start


@pytest.mark.parametrize("theta, theta_dot, spin", [(0.9, 0.0, 0.3), (2.2, 0.0, 0.3), (1.0, 0.8, 1.0), (0.3, 0.1, 6.0)])
def test_a_top_that_rolls_passes_90_degrees_when_the_exact_motion_does(theta, theta_dot, spin):
    """Rolling is not followed in steps; slide(), asked for two times, tells it all the same."""
    state, close = State(theta, theta_dot, 0.2, spin), np.linspace(0, 60, 60_001)
    exact = roll(PAPER, None, close, state)
    c = np.cos(exact.theta)
    passed = np.flatnonzero(np.diff(np.sign(c)))[:1]
    t90 = close[passed] + c[passed] / (c[passed] - c[passed + 1]) * (close[1] - close[0])
    rolls = replace(state, vx=float(exact.velocity[0, 0]), vy=float(exact.velocity[0, 1]))
    moved = slide(PAPER, rolls, ROLLS, [0, 60.0])
    assert (moved.regime == "roll").all()
    assert moved.time_90 == pytest.approx(t90[0] if t90.size else np.nan, abs=1e-6, nan_ok=True)


def test_ends_of_the_paper_and_of_the_three_regimes_of_S():
    """25, 60 and 90 rad/s of top S by viscous friction, as published: upright, hanging, inverted."""
    top, unit = Top(a=0.3, I1=131 / 350, I3=0.4), Scales(R=0.02, M=0.02, g=9.82)
    spins = np.array([25.0, 60.0, 90.0]) / unit.angular_velocity
    starts = [State(0.1, 0, 0, spin) for spin in spins]
    many = slide_many(top, starts, Viscous(unit.velocity), 25 / unit.time)
    assert many.end.tolist() == ["upright", "leaning", "inverted"]
    assert many.theta_end[1] == pytest.approx(1.90888, abs=0.003)
    caught = slide_many(PAPER, State(0.1, 0, 0, 8.8), [Coulomb(0.3), Coulomb(0.3, 0.4)], 100.0)
    assert caught.end.tolist() == ["upright"] * 2 and np.isnan(caught.time_90).all()


def test_what_broadcasts_and_what_is_refused():
    tops = SimpleNamespace(a=[0.07, 1.5], I1=0.399, I3=0.408)  # a < 1
    laws = np.array([Viscous(0.3), SmoothedCoulomb(0.2, 0.1)], dtype=object)[:, None]
    many = slide_many(tops, State(0.3, 0, 0, 5.0), laws, [[1.0]], [EDGE, (0.2, 0.1, 0.0)])
    assert many.end.tolist() == [["moving", "refused"]] * 2 or many.end[:, 1].tolist() == ["refused"] * 2
    assert np.isnan(many.theta_end[:, 1]).all() and np.isfinite(many.theta_end[:, 0]).all()
    fast = slide_many(PAPER, State(2.6, 0, 0, 0, vy=-1), Coulomb(2.0), 1.0, EDGE)  # Painleve's limit
    assert fast.end == "refused"
    for name, call in {
        "t_end": lambda: slide_many(PAPER, [State(0.1, 0, 0, 1)] * 2, Viscous(1), [1.0, 2.0, 3.0]),
        "rtol": lambda: slide_many(PAPER, State(0.1, 0, 0, 1), Viscous(1), 1.0, rtol=0),
        "air_drag": lambda: slide_many(PAPER, State(0.1, 0, 0, 1), Viscous(1), 1.0, air_drag=-1),
        "state": lambda: slide_many(PAPER, 3.0, Viscous(1), 1.0),
        "top": lambda: slide_many(3.0, State(0.1, 0, 0, 1), Viscous(1), 1.0),
        "friction": lambda: slide_many(PAPER, State(0.1, 0, 0, 1), 3.0, 1.0),
        "edge": lambda: slide_many(PAPER, State(0.1, 0, 0, 1), Viscous(1), 1.0, edge=3.0),
    }.items():
        with pytest.raises(TopError) as caught:
            call()
        assert caught.value.name == name


def test_the_same_numbers_on_one_core(monkeypatch):
    friction = SmoothedCoulomb(0.3, 0.1)
    several = slide_many(PAPER, STARTS, friction, 60.0, EDGE)
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: {0}, raising=False)
    one = slide_many(PAPER, STARTS, friction, 60.0, EDGE)
    for name in ("theta_end", "heat", "F_z_least", "time_90", "end", "hops"):
        np.testing.assert_array_equal(getattr(several, name), getattr(one, name))


def test_progress_and_stop():
    seen = []

    class Stop(Exception):
        pass

    def stop(share):
        raise Stop

    slide_many(PAPER, STARTS, Viscous(0.3), np.full((5, 1, 1), 5.0), progress=seen.append)
    assert seen[-1] == 1.0 and np.all(np.diff(seen) > 0)
    with pytest.raises(Stop):
        slide_many(PAPER, STARTS, Viscous(0.3), np.full((5, 1, 1), 5.0), progress=stop)


def test_growth_of_a_nudge():
    state, friction = State(0.1, 0, 0, 8.8), SmoothedCoulomb(0.3, 1.0)
    many = slide_many(PAPER, state, friction, 170.0, rtol=1e-10, nudge=1e-5)
    ends = [slide(PAPER, start, friction, [0, 170.0], rtol=1e-11).theta[-1] for start in (state, beside(state, 1e-5))]
    assert many.growth == pytest.approx(abs(ends[1] - ends[0]) / 1e-5, rel=1e-2)
    assert np.isnan(slide_many(PAPER, state, friction, 1.0).growth)
