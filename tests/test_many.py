"""slide_many() compared with slide(), run by run, and with what is known of the ends."""

import os
import pickle
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
    States,
    Top,
    TopError,
    TruncatedSphere,
    Viscous,
    beside,
    ending,
    pushed,
    roll,
    sensitivity,
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


@pytest.mark.parametrize("law", [Coulomb(0.3), Viscous(0.3), Contensou(0.3, 1 / 30)])
@pytest.mark.parametrize(("theta", "vz", "edge"), [(0.3, -1.0, None), (3.0, -0.3, EDGE)])
def test_a_start_that_moves_into_the_table_is_that_of_one_that_just_comes_down(law, theta, vz, edge):
    c, s = np.cos(theta), np.sin(theta)
    low = 1 - PAPER.a * c if edge is None else EDGE[0] * s - (EDGE[1] + PAPER.a) * c
    starts = [State(theta, 0.0, 0.0, 8.0, z=low + above, vz=vz) for above in (1e-7, 0.0)]
    falls, there = (slide(PAPER, start, law, [0, 0.05, 2.0], edge=edge) for start in starts)
    assert there.theta == pytest.approx(falls.theta, abs=1e-5)
    assert there.heat[1:] == pytest.approx(falls.heat[1:], abs=1e-5) and there.heat[0] > 0.9 * falls.heat[1]
    assert there.events[0][1] == falls.events[0][1] and there.events[0][0] == 0
    many = slide_many(PAPER, starts[1], law, 2.0, edge, rtol=1e-9)
    assert many.theta_end == pytest.approx(there.theta[-1], abs=1e-6)
    assert many.energy_error == pytest.approx(0, abs=1e-7) and many.heat == pytest.approx(there.heat[-1], abs=1e-6)


def test_where_a_run_ends_another_goes_on_also_in_the_air():
    law, start = SmoothedCoulomb(0.3, 0.3), State(0.3, 0.5, 0, 8, z=3.0, vz=1.0)
    first = slide_many(PAPER, start, law, [0.5, 1.0, 4.0], rtol=1e-9)
    whole, then = (
        slide_many(PAPER, start, law, 6.0),
        slide_many(PAPER, first.state_end, law, [5.5, 5.0, 2.0], rtol=1e-9),
    )
    assert then.theta_end == pytest.approx(np.full(3, whole.theta_end), abs=1e-4)
    assert first.heat + then.heat == pytest.approx(np.full(3, whole.heat), abs=1e-4)


def test_a_nudge_beside_a_start_with_a_height():
    start = pushed(PAPER, State(0.3, 0, 0, 8.0), (0, 0, 0.5), (0, 0, 1.0), Coulomb(0.3))
    assert start.z is not None
    found = slide_many(PAPER, start, Coulomb(0.3), 1.0, nudge=1e-6)
    assert found.reason == "" and found.growth > 0
    assert sensitivity(PAPER, start, Coulomb(0.3), [0, 1.0]) == pytest.approx(float(found.growth), rel=0.01)
    beyond = slide_many(PAPER, State(0.3, 0, 0, 8.0), Coulomb(0.3), 1.0, nudge=5.0)
    assert beyond.end == "refused" and beyond.reason and np.isnan(beyond.theta_end)


def test_one_and_many_are_refused_alike_where_it_may_not_fly():
    top, edge, law = Top(-0.3, 0.8, 0.6), (0.3, 1.2, 0.0), SmoothedCoulomb(0.3, 0.3)
    starts = [State(theta, rate, 0.0, spin) for theta in (0.4, 1.0) for rate in (0.0, 2.0) for spin in (1.0, 6.0)]
    many = slide_many(top, starts, law, 5.0, edge, rtol=1e-9, landing="stop")
    ones = [slide(top, start, law, np.linspace(0, 5, 501), edge=edge, landing="stop") for start in starts]
    assert many.end.tolist() == [ending(one).end for one in ones] and "lifts-off" in many.reason


def test_next_to_an_unstable_pole_it_leaves_in_proportion():
    near, far = (slide(PAPER, State(np.pi - away, 0, 0, 0.3), Coulomb(0.3), [0, 20.0]) for away in (1e-8, 1e-6))
    assert (np.pi - near.theta[-1]) * 100 == pytest.approx(np.pi - far.theta[-1], rel=1e-3)
    assert np.isfinite(roll(PAPER, None, [0, 1.0], State(np.pi - 1e-8, 0, 0, 0.3)).omega).all()


def test_a_law_of_fields_is_the_one_of_which_most_are_there():
    start, fields = State(0.3, 0, 0, 8.0), SimpleNamespace(mu=0.3, radius=np.array([0.03]))
    assert (
        slide_many(PAPER, start, fields, 1.0).theta_end == slide_many(PAPER, start, Contensou(0.3, 0.03), 1.0).theta_end
    )
    with pytest.raises(TopError, match="SmoothedCoulomb with mu, eps alone"):
        slide_many(PAPER, start, SimpleNamespace(mu=0.3, eps=0.1, radius=0.03), 1.0)


def test_one_impossible_top_does_not_end_a_map():
    tops = Top(np.array([0.07, -1e60, -1e150]), 0.4, 0.4)
    found = slide_many(tops, State(0.3, 0, 0, 1.0), Coulomb(0.3), 0.1)
    assert found.end[0] != "refused" and len(found.end) == 3


def test_an_error_of_another_process_arrives():
    with pytest.raises(TopError) as refused:
        slide(PAPER, State(0.3, 0, 0, 8.0), Coulomb(50.0), [0, 1])
    assert str(pickle.loads(pickle.dumps(refused.value))) == str(refused.value)


def test_the_last_progress_is_the_whole():
    told = []
    slide(PAPER, State(0.3, 0, 0, 8.0), Coulomb(0.3), [0, 1000.0], progress=told.append)
    assert told == sorted(told) and told[-1] == 1.0


def test_states_have_the_defaults_of_a_state():
    """(All of its fields had to be given.)"""
    tilts, spins = np.array([0.1, 0.4]), np.array([3.0, 9.0])
    found = slide_many(PAPER, States(tilts, 0.0, 0.0, spins), Coulomb(0.3), 3.0)
    given = slide_many(PAPER, State(tilts, 0.0, 0.0, spins), Coulomb(0.3), 3.0)
    assert (found.theta_end == given.theta_end).all() and (found.reason == "").all()
