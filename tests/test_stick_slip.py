"""Where slide() sticks, slips and leaves the table: events, their times, and limiting cases."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
import sliding_body as sb
from cases import PAPER

from tippe_core import (
    Constants,
    Coulomb,
    Rolling,
    SmoothedCoulomb,
    State,
    Top,
    TruncatedSphere,
    Viscous,
    slide,
    tielines,
)
from tippe_core.motion import sliding

REFERENCE = State(0.1, 0, 0, 8.8), SmoothedCoulomb(0.3, 1.0)


# ---- stick and slip ----


def rolling_start(K_J, share):
    """A State that rolls at first; its energy above the steady precession's is share times the slip limit's."""
    limit = tielines(PAPER, K_J, 10.0, 0.5)
    steady, most = float(np.ravel(limit.E_steady)[0]), float(np.ravel(limit.E)[0])
    rolling = Rolling(PAPER, Constants(K_J, 10.0, steady + share * (most - steady)))
    at = rolling(np.array([0.0, 0.05 * rolling.period]))
    theta, (w1, w2, w3) = at.theta[1], at.omega[1]
    c, s = np.cos(theta), np.sin(theta)
    return State(theta, w1, w2, w3, vx=w2 * (c - PAPER.a) - w3 * s, vy=-w1 * (1 - PAPER.a * c))


STICK_SLIP = [(7.0, 1.3, Coulomb(0.3, 0.5)), (7.0, 1.3, Coulomb(0.5)), (5.0, 1.02, Coulomb(0.49, 0.5)),
              (8.0, 1.3, Coulomb(0.5)), (2.0, 1.02, Coulomb(0.3, 0.5))]  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize(("K_J", "share", "friction"), STICK_SLIP)
def test_sticking_and_slipping(K_J, share, friction):
    times = np.linspace(0, 2, 2001)
    moved = slide(PAPER, rolling_start(K_J, share), friction, times, rtol=1e-11)
    finer = slide(PAPER, rolling_start(K_J, share), friction, times, rtol=1e-12)
    assert [what for _, what in moved.events[:4]] == ["slips", "sticks", "slips", "sticks"]
    np.testing.assert_allclose(*([t for t, _ in m.events] for m in (moved, finer)), rtol=0, atol=1e-9)
    rolls = moved.regime == "roll"
    F_h, F_z = np.hypot(*moved.force[:, :2].T), moved.force[:, 2]
    assert np.all(F_h[rolls] <= friction.mu_s * F_z[rolls] * (1 + 1e-9))
    np.testing.assert_array_equal(moved.slip[rolls], 0)
    fast = np.hypot(*moved.slip.T) > 1e-6
    np.testing.assert_allclose(F_h[~rolls], friction.mu_k * F_z[~rolls], rtol=1e-9)
    u, F = moved.slip[fast], moved.force[fast, :2]
    assert np.all((u * F).sum(axis=1) < 0)
    assert np.abs(u[:, 0] * F[:, 1] - u[:, 1] * F[:, 0]).max() < 1e-9
    assert np.diff(moved.energy).max() < 1e-10
    assert np.abs(moved.jellett / moved.jellett[0] - 1).max() < 1e-10
    assert np.ptp(moved.routh[: np.argmin(rolls)]) < 1e-12
    assert np.abs(np.diff(moved.quaternion, axis=0)).max() < 0.02
    for t, what in moved.events:
        around = np.searchsorted(moved.t, t) + np.array([-1, 0])
        assert list(moved.regime[around]) == (["roll", "slip"] if what == "slips" else ["slip", "roll"])


@pytest.mark.slow
@pytest.mark.parametrize("over", [1e-7, 1e-5, 1e-3, 0.3])
@pytest.mark.parametrize("K_J", [7.0, 8.0])
@pytest.mark.parametrize("friction", [Coulomb(0.5), Coulomb(0.4999999, 0.5)])
def test_grazing_the_limit_of_friction(friction, K_J, over):
    """Rolling that needs hardly more than mu_s F_z slips and sticks in turns, never at one instant.

    Without SLACK half of these do, one without end: (8, 0.3, mu_s = mu_k).
    """
    moved = slide(PAPER, rolling_start(K_J, 1 + over), friction, np.linspace(0, 1, 11))
    t, what = zip(*moved.events, strict=True)
    assert all(a != b for a, b in pairwise(what))
    assert len(t) < 2 or np.diff(t).min() > 1e-7
    assert len(t) < 20


@pytest.mark.parametrize("slip", [1e-14, 1e-12, 1e-11, 1e-10])
def test_a_start_with_next_to_no_slip_sticks_at_once(slip):
    start = rolling_start(7.0, 0.5)
    moved = slide(PAPER, replace(start, vx=start.vx + slip), Coulomb(0.5), np.linspace(0, 3, 31))
    assert moved.events == () or ([what for _, what in moved.events] == ["sticks"] and moved.events[0][0] < 1e-8)
    rolled = Rolling(PAPER, None, start)(moved.t)
    np.testing.assert_allclose(moved.omega, rolled.omega, rtol=0, atol=1e-8)


def test_no_more_events_than_can_be_followed(monkeypatch):
    monkeypatch.setattr(sliding, "MOST_EVENTS", 5)
    moved = slide(PAPER, rolling_start(5.0, 1.02), Coulomb(0.49, 0.5), np.linspace(0, 10, 101))
    assert [what for _, what in moved.events] == ["slips", "sticks", "slips", "sticks", "slips", "too many events"]
    assert moved.events[4][0] == moved.events[5][0] > moved.t[-1]


@pytest.mark.parametrize(("state", "friction", "more"), [
    (State(1.0, 0, 0, 1e6), Viscous(0.3), {}),
    (State(0.1, 0, 0, 9.0), Coulomb(0.3, 0.4), {}),
    (State(3.0, 0, 0, -9.0), Viscous(0.3), {"edge": TruncatedSphere.paper().edge}),
    (State(1.5, 3.0, 5.0, 3e4), Viscous(0.3), {}),
])  # fmt: skip
def test_more_steps_than_can_be_followed_end_it_and_what_was_computed_stays(monkeypatch, state, friction, more):
    times = np.linspace(0, 40, 4_000_001) if state.omega3 == 1e6 else np.linspace(0, 40, 40_001)
    most, told = 5 if state.omega3 == 1e6 else 20, []
    monkeypatch.setattr(sliding, "STEPS_BETWEEN_CALLS", 1)
    monkeypatch.setattr(sliding, "MOST_STEPS", most)
    moved = slide(PAPER, state, friction, times, progress=told.append, **more)
    t, what = moved.events[-1]
    assert what == "too many steps" and 0 < len(moved.t) < len(times)
    assert moved.t[-1] <= t < moved.t[-1] + 2 * times[1]
    assert len(told) == most and told[-1] == pytest.approx(t / 40)
    monkeypatch.setattr(sliding, "MOST_STEPS", 100_000)
    longer = slide(PAPER, state, friction, times[: len(moved.t)], **more)
    assert longer.events == moved.events[:-1]
    np.testing.assert_allclose(longer.theta, moved.theta, rtol=0, atol=1e-7)


def test_a_high_top_lets_go_from_rest():
    """On the way from no slip the integration's trial steps grow beyond any float."""
    top, times = Top(-10.0, 120.0, 20.0), np.linspace(0, 2.5, 6)
    moved = slide(top, State(1.0, 0, 0, 0), Coulomb(0.3), times, rtol=1e-11)
    assert moved.events == () and np.all(moved.slip[:, 1] > 0)
    still = np.zeros(3)
    motion = sb.integrate(top, lambda _: np.array([0, 0.3, 0]), moved.quaternion[0], still, still, moved.com[0], times)
    np.testing.assert_allclose(moved.com, motion.com, rtol=0, atol=1e-8)


def test_slip_that_goes_through_zero_turns_round():
    """A lean top falls in a plane: its slip can only turn round through 0, where rolling would need more friction."""
    top, times = Top(-1.2, 1.5, 0.1), np.linspace(0, 4, 41)
    moved = slide(top, State(1.0, 0, 0, 0), Coulomb(0.1), times, rtol=1e-11)
    (t0, what), (t1, again) = moved.events
    assert what == again == "slips" and 2.7 < t0 < 2.71
    along = (moved.slip @ [1, 1j] * np.exp(1j * moved.phi)).imag  # in space: the axes turn over at the pole
    assert np.all(along[(times > 0) & (times < t0)] > 0) and np.all(along[(times > t0) & (times < t1)] < 0)
    q, still, first, second = moved.quaternion[0], np.zeros(3), times[times < t0], times[(times > t0) & (times < t1)]
    there = sb.integrate(top, lambda _: sb.UP[[0, 2, 1]] * 0.1, q, still, still, moved.com[0], np.append(first, t0))
    np.testing.assert_allclose(moved.com[: len(first)], there.com[:-1], rtol=0, atol=1e-8)
    on = sb.integrate(top, lambda _: sb.UP[[0, 2, 1]] * -0.1, there.quaternion[-1], there.omega[-1],
                      there.velocity[-1], there.com[-1], np.append(t0, second))  # fmt: skip
    np.testing.assert_allclose(moved.com[len(first) : len(first) + len(second)], on.com[1:], rtol=0, atol=1e-8)
    np.testing.assert_allclose(sum(moved.ledger), moved.energy[0], rtol=0, atol=1e-8)


def test_events_are_located_to_1e_9():
    """Rolling lets go where the exact motion reaches the limit, slipping ends where the slip of a finer run is 0."""
    friction, state = Coulomb(0.3, 0.5), rolling_start(7.0, 1.3)
    (slips, _), (sticks, _) = slide(PAPER, state, friction, [0, 1.0], rtol=1e-12).events[:2]
    rolled = Rolling(PAPER, None, state)
    before, after = rolled(np.array([0, slips - 1e-9, slips + 1e-9])).force[1:]
    assert np.hypot(*before[:2]) < 0.5 * before[2] and np.hypot(*after[:2]) > 0.5 * after[2]
    left = 1e-4 * np.arange(4, 0, -1)
    u = np.hypot(*slide(PAPER, state, friction, np.array([0, *(sticks - left)]), rtol=1e-13).slip[1:].T)
    *_, slope, offset = np.polyfit(left, u, 3)
    assert abs(offset / slope) < 1e-9
    closest = slide(PAPER, state, friction, np.array([0, sticks - 2e-9, sticks + 2e-9]), rtol=1e-13)
    assert list(closest.regime[1:]) == ["slip", "roll"]
    # lift-off: N of the rigid body changes sign within 1e-9
    state, law = State(0.8, 9.0, 0, 3.0), Viscous(0.3)
    ((t, _),) = slide(PAPER, state, law, [0, 5.0], rtol=1e-12, landing="stop").events
    motion = sb.integrate(PAPER, lambda u: 0.3 * u, *sb.first_instant(PAPER, state), np.array([0, t - 1e-9, t + 1e-9]))
    N = [sb.accelerations(PAPER, lambda u: 0.3 * u, sb.matrix(motion.quaternion[i])[:, 2], motion.omega[i],
                          motion.velocity[i])[2] for i in (1, 2)]  # fmt: skip
    assert N[0] > 0 > N[1]


def test_equal_coefficients_are_the_limit_of_smoothed_friction():
    """Another law, ever steeper at zero slip, that knows no events: the distance falls in proportion to eps."""
    state, times = rolling_start(7.0, 1.3), np.linspace(0, 2, 201)
    moved = slide(PAPER, state, Coulomb(0.5), times, rtol=1e-11)
    distance = [np.abs(slide(PAPER, state, SmoothedCoulomb(0.5, eps), times, rtol=1e-11).quaternion
                       - moved.quaternion).max() for eps in (1e-2, 1e-3, 1e-4)]  # fmt: skip
    assert distance[2] < 1e-3
    assert distance[1] < distance[0] / 5 and distance[2] < distance[1] / 5


def test_coulomb_with_stick_is_soon_caught_rolling_and_never_flips():
    for friction in (Coulomb(0.3), Coulomb(0.3, 0.4)):
        moved = slide(PAPER, REFERENCE[0], friction, np.linspace(0, 300, 3001))
        assert [what for _, what in moved.events] == ["sticks"] and moved.events[0][0] < 1
        assert moved.theta.max() < 0.2 and np.all(moved.omega[:, 2] > 0)


def test_a_start_that_rolls_is_the_exact_rolling_motion():
    times = np.linspace(1, 20, 200)
    state = rolling_start(7.0, 0.5)
    moved = slide(PAPER, state, Coulomb(0.5), times)
    rolled = Rolling(PAPER, None, state)(times)
    assert moved.events == () and set(moved.regime) == {"roll"}
    for name in ("quaternion", "contact", "com", "omega", "force", "phi", "psi"):
        expected = getattr(rolled, name).copy()
        if name in ("com", "contact"):  # roll() counts from the contact point, slide() from G
            expected[:, :2] -= rolled.com[0, :2]
        np.testing.assert_allclose(getattr(moved, name), expected, rtol=0, atol=1e-10)


@pytest.mark.parametrize("state", [State(0.0, 0.8, 0, 5.0, vx=0, vy=-0.8 * 0.93),
                                   State(np.pi, 0.5, 0, 3.0, vx=0, vy=-0.5 * 1.07)])  # fmt: skip
def test_a_start_that_rolls_through_a_pole(state):
    times = np.linspace(0, 5, 51)
    moved, rolled = slide(PAPER, state, Coulomb(0.5, 100.0), times), Rolling(PAPER, None, state)(times)
    assert set(moved.regime) == {"roll"}
    away = rolled.com[0] * (1, 1, 0)
    np.testing.assert_allclose(moved.com, rolled.com - away, rtol=0, atol=1e-10)
    sign = np.sign((moved.quaternion * rolled.quaternion).sum(axis=1))[:, None]
    np.testing.assert_allclose(moved.quaternion, sign * rolled.quaternion, rtol=0, atol=1e-10)
