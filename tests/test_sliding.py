"""slide() compared with a rigid body that shares no formula with it, published motions, and conserved quantities."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
import sliding_body as sb
from cases import LOADED, ORDINARY, PAPER
from rigid_body import euler_quaternion

from tippe_core import (
    Coulomb,
    Scales,
    SmoothedCoulomb,
    State,
    Top,
    TopError,
    Viscous,
    beside,
    glide,
    growth,
    outcome,
    roll,
    sensitivity,
    slide,
    steady_states,
    thresholds,
)

S_SCALES = Scales(R=0.02, M=0.02, g=9.82)
REFERENCE = State(0.1, 0, 0, 8.8), SmoothedCoulomb(0.3, 1.0)


MOTIONS = {
    "viscous": (LOADED, State(0.1, 0, 0, 4.0), Viscous(0.443)),
    "smoothed": (PAPER, *REFERENCE),
    "everything": (PAPER, State(1.2, 0.5, -1.0, 6.0, 0.4, 2.0, 0.3, -0.2, 0.5, -0.7), Viscous(0.2)),
    "ordinary": (ORDINARY, State(0.3, 0.1, 0.2, 3.0, vx=0.3), SmoothedCoulomb(0.2, 0.1)),
    "Coulomb, slipping on": (PAPER, State(0.8, 0, 0, 8.0, vx=8.0, vy=9.0), Coulomb(0.2)),
    "from the pole": (PAPER, State(0.0, 1.0, 0, 6.0, vx=0.1), Viscous(0.3)),
    "from the inverted pole": (LOADED, State(np.pi, 0.2, 0, 3.0), SmoothedCoulomb(0.3, 0.5)),
    "no friction": (PAPER, State(0.5, 0.2, 1.0, 5.0, vx=0.4), Viscous(0.0)),
}


@pytest.mark.parametrize("name", MOTIONS)
def test_against_the_rigid_body(name):
    top, state, friction = MOTIONS[name]
    times = np.linspace(2.0, 12.0, 101)
    motion = sb.stored(top, friction, *sb.first_instant(top, state), times)
    moved = slide(top, state, friction, times, rtol=1e-12)
    assert moved.events == () and set(moved.regime) == {"slip"}
    q = motion.quaternion / np.linalg.norm(motion.quaternion, axis=1)[:, None]
    q *= np.sign((q * moved.quaternion).sum(axis=1))[:, None]
    np.testing.assert_allclose(moved.quaternion, q, rtol=0, atol=1e-8)
    np.testing.assert_allclose(moved.com, motion.com, rtol=0, atol=1e-8 * max(1, abs(top.a)))
    omega = sb.in_space(moved.phi, moved.theta, *moved.omega.T)
    np.testing.assert_allclose(omega, motion.omega, rtol=0, atol=1e-8)
    axes = np.array([sb.matrix(x)[:, 2] for x in q])
    body = list(zip(axes, motion.omega, motion.velocity, strict=True))
    slips = np.array([sb.slip(top, *row) for row in body])[:, :2]
    np.testing.assert_allclose(sb.rotated(moved.phi, moved.slip), slips, rtol=0, atol=1e-8)
    N = np.array([sb.accelerations(top, lambda u: friction.k(u @ u) * u, *row)[2] for row in body])
    np.testing.assert_allclose(moved.force[:, 2], N, rtol=0, atol=1e-7)
    O = moved.com[:, :2] + top.a * axes[:, :2]
    np.testing.assert_allclose(moved.contact, O, rtol=0, atol=1e-8 * max(1, abs(top.a)))
    np.testing.assert_allclose(moved.energy - moved.energy[0], motion.work, rtol=0, atol=1e-8)
    # the angles make the quaternion, up to its sign, and are continuous
    for i in range(0, 101, 10):
        again = euler_quaternion(moved.phi[i], moved.theta[i], moved.psi[i]).astype(float)
        assert abs(abs(again @ moved.quaternion[i]) - 1) < 1e-12
    off = np.sin(moved.theta) > 0.05
    if off.all():
        assert np.abs(np.diff(moved.phi)).max() < 1.0


def test_reference_inversion():
    """physics.md's smoothed Coulomb top; C_J, the energy and the work of friction over the whole inversion."""
    times = np.linspace(0, 300, 30001)
    moved = slide(PAPER, *REFERENCE, times, rtol=1e-12)
    assert abs(moved.t[np.argmax(moved.theta > np.pi / 2)] - 180) < 2
    assert np.cos(moved.theta[-1]) == pytest.approx(-0.99947, abs=5e-6)
    assert moved.omega[-1, 2] == pytest.approx(-7.6113, abs=5e-5)
    assert np.abs(moved.jellett / moved.jellett[0] - 1).max() < 1e-10
    assert np.diff(moved.energy).max() < 1e-10
    assert moved.routh[0] * moved.routh[-1] < 0
    power = (moved.force[:, :2] * moved.slip).sum(axis=1)
    h = times[1]
    work = h * (power.sum() - (power[0] + power[-1]) / 2)
    work -= h**2 / 12 * (np.gradient(power, h, edge_order=2)[-1] - np.gradient(power, h, edge_order=2)[0])
    assert moved.energy[-1] - moved.energy[0] == pytest.approx(work, abs=1e-8)
    np.testing.assert_allclose(moved.heat, moved.energy[0] - moved.energy, rtol=0, atol=1e-8)
    np.testing.assert_allclose(sum(moved.ledger), moved.energy[0], rtol=0, atol=1e-8)


@pytest.mark.slow
def test_results_do_not_depend_on_the_tolerance():
    """Ten times finer, and after 300 (R/g)^1/2 theta is the same to some 2e4 rtol; so is the time of passing pi/2."""
    times = np.linspace(0, 300, 3001)
    ladder = [(rtol, slide(PAPER, *REFERENCE, times, rtol=rtol)) for rtol in (1e-8, 1e-10, 1e-11, 1e-12)]
    passing = [np.interp(0, -np.cos(moved.theta[1700:1900]), times[1700:1900]) for _, moved in ladder]
    for (rtol, moved), (_, finer) in pairwise(ladder):
        assert np.abs(moved.theta - finer.theta).max() < 1e5 * rtol
    assert np.ptp(passing) < 1e-3 and np.ptp(passing[1:]) < 1e-5
    default, halved = slide(PAPER, *REFERENCE, times), slide(PAPER, *REFERENCE, times, rtol=5e-10)
    assert np.abs(default.jellett / default.jellett[0] - 1).max() < 1e-8
    assert np.abs(default.theta - halved.theta).max() < 1e-3


@pytest.mark.parametrize(("rad_per_s", "end"), [(25, 0.0), (60, 1.90888), (90, np.pi)])
def test_the_three_regimes_of_S(rad_per_s, end):
    top, unit = LOADED, S_SCALES
    state, times = State(0.1, 0, 0, rad_per_s / unit.angular_velocity), np.linspace(0, 25 / unit.time, 501)
    moved = slide(top, state, Viscous(1.0 * unit.velocity), times)
    assert moved.theta[-1] == pytest.approx(end, abs=0.003)
    assert outcome(top, state).theta == pytest.approx(end, abs=0.003)
    free = slide(top, state, Viscous(0.0), times)
    assert free.theta.max() < np.pi / 2
    np.testing.assert_allclose(free.omega[:, 2], free.omega[0, 2], rtol=1e-8)


GROUPS = [LOADED, Top(a=0.1, I1=0.5, I3=0.4), Top(a=0.1, I1=0.3, I3=0.45), Top(a=-0.3, I1=0.4, I3=0.5)]


@pytest.mark.slow
@pytest.mark.parametrize("top", GROUPS)
@pytest.mark.parametrize("theta", [0.1, 2.0])
@pytest.mark.parametrize("spin", [0.5, 1.0, 2.0, 4.0])
def test_outcome_is_what_viscous_friction_comes_to(top, spin, theta):
    """Weak friction, for it settles sooner than one that hardly lets the top slip."""
    state = State(theta, 0, 0, spin)
    said = outcome(top, state)
    if said.certain:
        moved = slide(top, state, Viscous(0.015), np.array([0.0, 3000.0]), rtol=1e-7)
        assert moved.theta[-1] == pytest.approx(said.theta, abs=0.02)


@pytest.mark.parametrize("state", [State(0.8, 9.0, 0, 3.0), State(0.8, 9.0, 0, 3.0, 1.7, vx=1.5, vy=-0.8)])
def test_lift_off_ends_the_motion(state):
    times = np.linspace(0, 5, 5001)
    moved = slide(PAPER, state, Viscous(0.3), times, rtol=1e-11, landing="stop")
    ((t, what),) = moved.events
    assert what == "lifts off" and moved.t[-1] <= t < moved.t[-1] + 1.001e-3
    assert moved.force[:, 2].min() > 0 and moved.force[-1, 2] < 0.02
    motion = sb.integrate(PAPER, lambda u: 0.3 * u, *sb.first_instant(PAPER, state), np.array([0.0, t]))
    axis = sb.matrix(motion.quaternion[-1])[:, 2]
    N = sb.accelerations(PAPER, lambda u: 0.3 * u, axis, motion.omega[-1], motion.velocity[-1])[2]
    assert abs(N) < 1e-7


@pytest.mark.parametrize(("name", "call"), [
    ("mu_k", lambda: Coulomb(-0.1)),
    ("mu_k", lambda: Coulomb(0)),
    ("mu_s", lambda: Coulomb(0.3, 0.2)),
    ("gamma", lambda: Viscous(-1)),
    ("eps", lambda: SmoothedCoulomb(0.3, 0)),
    ("mu", lambda: SmoothedCoulomb(np.nan, 1)),
    ("state", lambda: slide(PAPER, 1, Viscous(1), [0, 1])),
    ("friction", lambda: slide(PAPER, REFERENCE[0], 0.3, [0, 1])),
    ("times", lambda: slide(PAPER, *REFERENCE, [1, 0])),
    ("rtol", lambda: slide(PAPER, *REFERENCE, [0, 1], rtol=0)),
    ("omega3", lambda: slide(PAPER, State(1.0, 0, 0, 1e100), Viscous(1), [0, 1])),
    ("vx", lambda: State(1.0, 0, 0, 1.0, vx=-1e13)),
    ("mu_k", lambda: slide(ORDINARY, State(1.0, 0, 0, 1.0), Coulomb(9.0), [0, 1])),
])  # fmt: skip
def test_bad_input_is_named(name, call):
    with pytest.raises(TopError) as caught:
        call()
    assert caught.value.name == name


@pytest.mark.slow
def test_sensitivity_tells_a_start_on_the_barrier_from_one_below_it():
    """Between its thresholds the paper's top stands on either end, and a steady precession in between parts the two."""
    limits = thresholds(PAPER)
    C_J = PAPER.I3 * (1 - PAPER.a) * (limits.upright.spin + limits.launch) / 2
    steady = steady_states(PAPER, C_J)
    theta = steady.theta[1]
    assert list(steady.stable) == [True, False, True]
    I_eff = PAPER.I1 * np.sin(theta) ** 2 + PAPER.I3 * (np.cos(theta) - PAPER.a) ** 2
    turn = C_J / I_eff  # of the whole top, about the vertical through G
    state = State(theta, 0, turn * np.sin(theta), turn * (np.cos(theta) - PAPER.a))
    friction, times = Viscous(1.0), np.linspace(0, 5000, 101)
    on, off = (sensitivity(PAPER, start, friction, times) for start in (state, REFERENCE[0]))
    assert on > 100 * off


def test_a_start_beside_another_and_how_much_a_nudge_grew():
    """More tilted, but from 1 rad on less, so that it stays between the poles; growth counts what both have."""
    assert beside(State(0.5, 0, 0, 1), 1e-6).theta == pytest.approx(0.5 + 1e-6, abs=1e-15)
    assert beside(State(3.0, 0, 0, 1), 1e-6).theta == pytest.approx(3.0 - 1e-6, abs=1e-15)
    near, moved = (glide(PAPER, State(theta, 0, 0, 8.8), np.linspace(0, 0.2, n)) for theta, n in ((0.5, 5), (0.6, 3)))
    assert growth(moved, near, 0.05) == pytest.approx(2.0, rel=0.05)


@pytest.mark.parametrize("edge, event", [((0.2, 1.2, 0.0), "lifts off"), ((0.8, 0.6, 0.0), "rim touches")])
def test_a_top_that_rolls_comes_to_its_stem_when_roll_says_so(edge, event):
    """Without slip slide() is roll(), until the edge is at the table: a stem throws it up there, at a rim it ends."""
    state = State(0.9, 1.5, 0.2, 0.5)
    b, h, _ = edge
    angle = np.arctan2(b, -h) - np.arccos(1 / np.hypot(b, h)) if np.hypot(b, h) > 1 + 1e-9 else np.arccos(-h)
    times = np.linspace(0, 6, 6001)
    rolled = roll(PAPER, None, times, state)
    first = np.argmax(rolled.theta > angle)
    assert first
    expected = np.interp(angle, rolled.theta[first - 1 : first + 1], times[first - 1 : first + 1])
    w2, w3 = state.omega2, state.omega3
    s, c = np.sin(state.theta), np.cos(state.theta)
    vy = -state.theta_dot * (1 - PAPER.a * c)
    rolling = replace(state, vx=w2 * (c - PAPER.a) - w3 * s, vy=vy)
    moved = slide(PAPER, rolling, Coulomb(1.0, 100.0), times, edge=edge, landing="stop")
    assert moved.events == ((pytest.approx(expected, abs=1e-6), event),)


@pytest.mark.parametrize("pole, spin", [(0.0, 3.0), (np.pi, -2.0)])
def test_a_top_that_rolls_through_a_pole_keeps_its_azimuth(pole, spin):
    """From the pole itself, with any azimuth: no slip, so roll()'s quaternion."""
    start = State(pole, 1.0, 0.0, spin, phi=0.7, psi=0.4)
    vy = -np.cos(pole) * (np.cos(pole) - PAPER.a)  # u_y = 0
    times = np.linspace(0, 1.0, 11)
    moved = slide(PAPER, replace(start, vx=0.0, vy=vy), Coulomb(5.0), times, landing="stop")
    assert set(moved.regime) == {"roll"}
    assert np.abs((moved.quaternion * roll(PAPER, None, times, start).quaternion).sum(axis=1)) == pytest.approx(1)


def test_a_stem_that_ends_in_a_ball_may_have_its_centre_within_the_sphere():
    """It sticks out of the sphere all the same (Leine and Glocker's toy)."""
    assert slide(PAPER, State(0.1, 0, 0, 5.0), Viscous(0.3), [0, 1.0], edge=(0.0, 13 / 15, 1 / 3)).t[-1] == 1.0
    with pytest.raises(TopError, match="not inside"):
        slide(PAPER, State(0.1, 0, 0, 5.0), Viscous(0.3), [0, 1.0], edge=(0.0, 0.6, 1 / 3))


@pytest.mark.parametrize("top", [PAPER, LOADED, ORDINARY])
def test_painleves_limit_is_where_the_normal_force_has_none(top):
    """F_z grows like 1/(1 - mu/limit) where friction presses the top down most: twice as large at half the distance."""
    with pytest.raises(TopError) as error:
        slide(top, State(1.0, 0, 0, 1.0), Coulomb(1e3), [0, 1.0])
    limit = float(error.value.allowed.split("<")[1].split()[0])

    def pressed(mu, theta):
        starts = [State(theta, 0, 0, 0, vx=0.0, vy=vy) for vy in (-1, 1)]
        return max(slide(top, start, Coulomb(mu * limit), [0.0]).force[0, 2] for start in starts)

    def most(mu):
        """At 45 tilts, and then at 40 about the one at which it is largest."""
        coarse, step = np.linspace(0, np.pi, 46, retstep=True)
        near = max(coarse[1:-1], key=lambda theta: pressed(mu, theta))
        fine = near + step * np.linspace(-1, 1, 41)
        return max(pressed(mu, theta) for theta in fine if 0 < theta < np.pi)

    assert most(0.999) / most(0.998) == pytest.approx(2.0, rel=0.02)
