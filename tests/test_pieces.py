"""Pieces of the core, each against what it stands for: where no whole motion that takes a second would tell that one is
wrong."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import rigid_body as rb
import sliding_body as sb
from cases import LOADED, ORDINARY, PAPER
from scipy.integrate import cumulative_simpson
from scipy.optimize import brentq

from tippe_core import (
    Constants,
    Contensou,
    Coulomb,
    State,
    Top,
    TopError,
    TruncatedSphere,
    Viscous,
    endings,
    f,
    outcome,
    pushed,
    roll,
    slide_many,
    steady_precessions,
    tielines,
    turning_points,
)
from tippe_core.bodies.slices import Frustum, crossings
from tippe_core.classify import LEANS, UPRIGHT, judged
from tippe_core.linear import tumbling, tumbling_modes
from tippe_core.motion import at, impact, preparing
from tippe_core.motion.contacts import soften
from tippe_core.motion.crowding import crowded, crowding, eta_halves
from tippe_core.motion.implicit import slowest_patch
from tippe_core.motion.periodic import skip
from tippe_core.motion.records import BALL, IMPACT, LAW, MOTION, OPEN, SLIP, STEM, STICK, new
from tippe_core.motion.rolling import Rolling
from tippe_core.motion.rolling_part import RollingPart
from tippe_core.motion.series import sine
from tippe_core.paper.tielines import tilts_near_poles

EDGE = TruncatedSphere.paper().edge


def law_of(friction):
    law = new(LAW)
    for name, value in friction.law._asdict().items():
        law[name] = value
    return law


def test_the_sine_is_exact_to_rounding():
    x = np.linspace(-np.pi / 2, np.pi / 2, 2001)
    np.testing.assert_allclose([sine(one) for one in x], np.sin(x), rtol=4e-16, atol=0)


def test_a_grid_is_denser_towards_the_poles():
    theta = tilts_near_poles(64)
    gaps = np.diff(theta)
    assert len(theta) == 65 and theta[0] == 0.0 and theta[-1] == pytest.approx(np.pi, rel=1e-15)
    assert (np.diff(gaps[:32]) > 0).all() and gaps[31] > 10 * gaps[0]
    np.testing.assert_allclose(gaps, gaps[::-1], rtol=1e-9)


@pytest.mark.parametrize("K_J", [-9.0, -4.0, 0.0, 5.0])
def test_many_tielines_are_about_the_steady_precession_of_least_energy(K_J):
    """Also beyond 90 degrees."""
    theta = steady_precessions(PAPER, K_J, 10.0).theta[0]
    found = tielines(PAPER, [K_J], 10.0)
    assert found.theta_inner[0] < theta < found.theta_outer[0]


# ---- impacts of a patch ----

COUPLED = np.array([[3.0, 0.2, 0.4, 0.3], [0.2, 2.5, -0.3, 0.1], [0.4, -0.3, 1.2, 0.25], [0.3, 0.1, 0.25, 2.0]])


@pytest.mark.parametrize("speed", [0.2, 1.0, 8.0])
def test_a_patch_at_rest_is_held_in_an_impact_up_to_its_torque(speed):
    """Whatever its speed; beyond it slips and spins, and as a patch's friction has no scale, in proportion to it."""
    start = np.array([0.0, 0.0, -1.0, 0.0])
    held = np.linalg.solve(COUPLED, -start)
    needs = abs(held[3]) / held[2]
    assert np.hypot(*held[:2]) < 0.9 * held[2]
    for share, holds in ((1.1, True), (0.9, False)):
        law = law_of(Contensou(1.0, share * needs / (3 * np.pi / 16)))
        J = impact.impact(COUPLED, speed * start, law, new(IMPACT)) / speed
        assert (np.abs(J - held).max() < 1e-12) == holds
        np.testing.assert_allclose(J, impact.impact(COUPLED, start, law, new(IMPACT)), rtol=0, atol=1e-7)


def test_what_goes_on_slipping_does_so_slowly_against_what_would_have_held_it():
    q, scale = np.array([3e-10, -2e-10, -0.4, 0.3]), 0.7
    rest = impact.held(COUPLED, q, law_of(Coulomb(0.3)))
    u = (q + COUPLED @ impact.away(COUPLED, q, rest, scale))[:3]
    size = 2 * impact.STOPPED * scale
    np.testing.assert_allclose(u[:2], -size * rest[:2] / np.hypot(*rest[:2]), rtol=1e-9, atol=0)
    assert u[2] == pytest.approx(-0.4)


def test_how_fast_a_slip_relaxes():
    """The least of the slips, with the spin's; and the fastest u' = -k N (1 + z^2/I1) u of the contacts that slip."""
    P = preparing.problem(PAPER, Contensou(0.3, 0.05), EDGE, (0.0, 0.0), 1e-9)
    C = new(MOTION).contacts
    C.u[:, :2], C.F[:, :2], C.rho[:, 2] = [[3e-3, 4e-3], [6e-3, 8e-3]], [[0.03, 0.04], [0.3, 0.4]], [-0.9, -1.3]
    found = slowest_patch(0.2, (SLIP, SLIP), P, C)
    assert found == pytest.approx((BALL, np.hypot(5e-3, 0.05 * 0.2), 50 * (1 + 1.3**2 / PAPER.I1)), rel=1e-12)
    assert slowest_patch(0.2, (SLIP, STICK), P, C)[2] == pytest.approx(10 * (1 + 0.9**2 / PAPER.I1), rel=1e-12)


# ---- from one form of a state to another ----


@pytest.mark.parametrize("theta", [0.0, 0.7, 2.9, np.pi])
def test_a_motion_goes_on_from_its_state(theta):
    """Also at a pole, where phi is chosen anew."""
    P = preparing.problem(PAPER, Viscous(0.3), None, (0.0, 0.0), 1e-9)
    turn, omega = np.exp(0.4j), (0.8, -0.5, 3.0)
    y = preparing.y_of(P, theta, np.sin(theta / 2), np.cos(theta / 2), turn, 1.7, omega, 0.3 + 0.6j, 0.2 - 0.1j, 0.0,
                       0.0)  # fmt: skip
    angles = np.array([0.0, 0.4])
    again, _ = preparing.beginning(preparing.state_of(preparing.motion(y, angles), P), 0.0, P)
    np.testing.assert_allclose(again[at.LX : at.TIME], y[at.LX : at.TIME], rtol=0, atol=1e-13)
    one, other = (z[[at.PX, at.PY, at.PZ, at.PW]] for z in (y, again))
    np.testing.assert_allclose(sb.matrix(other)[:, 2], sb.matrix(one)[:, 2], rtol=0, atol=1e-13)


def test_rolling_ends_where_the_exact_motion_is():
    P = preparing.problem(PAPER, Coulomb(2.0), EDGE, (0.0, 0.0), 1e-9)
    start = roll(PAPER, None, [0.0], State(1.0, 0.3, 0.2, 6.0, phi=0.8, psi=0.3, x=0.1, y=0.2))
    state = State(1.0, 0.3, 0.2, 6.0, 0.8, 0.3, 0.1, 0.2, *start.velocity[0, :2])
    W = preparing.motion(*preparing.beginning(state, 2.0, P))
    preparing.on_table(W, P, BALL)
    W.modes[:] = STICK, OPEN
    part = RollingPart.of(PAPER, W, P)._replace(ends=3.7)
    part.end(W, P)
    exact = roll(PAPER, None, [0.0, 1.7], state)
    matrix, axis = sb.matrix(W.y[:4]), sb.matrix(exact.quaternion[1])[:, 2]
    L = sb.in_space(exact.phi, exact.theta, *(exact.omega * [PAPER.I1, PAPER.I1, PAPER.I3]).T)[1]
    turn = np.exp(1j * exact.phi[1]) * complex(*exact.velocity[1, :2])
    np.testing.assert_allclose(matrix[:, 2], axis, rtol=0, atol=1e-10)
    np.testing.assert_allclose(W.y[[at.LX, at.LY, at.LZ]], L, rtol=0, atol=1e-10)
    np.testing.assert_allclose(W.y[[at.VX, at.VY]], [turn.real, turn.imag], rtol=0, atol=1e-10)
    np.testing.assert_allclose(W.y[[at.X, at.Y, at.Z]], exact.com[1], rtol=0, atol=1e-10)
    assert W.y[at.TIME] == 3.7 and W.angles == pytest.approx([0.0, exact.phi[1]], abs=1e-12)


def test_whole_nutations_are_skipped_as_the_exact_motion_goes():
    """From one time in the first of them to the same in the last that fits."""
    P = preparing.problem(PAPER, Coulomb(2.0), None, (0.0, 0.0), 1e-9)
    begin = State(1.0, 0.3, 0.2, 6.0, x=0.1, y=0.2)
    T = Rolling(PAPER, None, begin).period
    times, end = T * np.array([0.0, 0.13, 1.13, 0.4, 7.4]), 7.9 * T
    moved = roll(PAPER, None, times, begin)

    def row(i):
        return np.array([times[i], moved.phi[i], moved.psi[i], *moved.com[i, :2], moved.theta[i]])

    def y_at(i):
        turn, v = np.exp(1j * moved.phi[i]), complex(*moved.velocity[i, :2])
        y = preparing.y_of(P, moved.theta[i], np.sin(moved.theta[i] / 2), np.cos(moved.theta[i] / 2), turn,
                           moved.phi[i] + moved.psi[i], moved.omega[i], v * turn, complex(*moved.com[i, :2]), times[i],
                           0.0)  # fmt: skip
        return y, np.array([0.0, moved.phi[i]])

    (y, angles), (exact, _) = y_at(3), y_at(4)
    assert skip(y, angles, row(1), row(2), end)
    np.testing.assert_allclose(y[at.LX :], exact[at.LX :], rtol=0, atol=1e-8)
    np.testing.assert_allclose(sb.matrix(y[:4])[:, 2], sb.matrix(exact[:4])[:, 2], rtol=0, atol=1e-8)
    assert angles.sum() == pytest.approx(moved.phi[4], abs=1e-8)
    assert angles[0] - angles[1] + y[at.CHI] == pytest.approx(moved.psi[4], abs=1e-8)
    assert not skip(y, angles, row(1), row(2), end)


def test_rolling_that_skips_nutations_ends_as_the_exact_motion():
    begin = State(1.0, 0.3, 0.2, 6.0, x=0.1, y=0.2)
    end = 12.3 * Rolling(PAPER, None, begin).period
    exact = roll(PAPER, None, [0.0, end], begin)
    rolls = replace(begin, vx=float(exact.velocity[0, 0]), vy=float(exact.velocity[0, 1]))
    now = slide_many(PAPER, rolls, Coulomb(5.0), end, rtol=1e-11).state_end
    np.testing.assert_allclose([now.theta, now.x, now.y], [exact.theta[1], *exact.com[1, :2]], rtol=0, atol=1e-7)
    for mine, other in ((now.phi, exact.phi[1]), (now.psi, exact.psi[1])):
        np.testing.assert_allclose(np.exp(1j * mine), np.exp(1j * other), rtol=0, atol=1e-7)


def test_a_short_motion_keeps_what_it_should():
    many = slide_many(PAPER, State(1.0, 0.3, 0.2, 6.0), Viscous(0.3), 0.5, rtol=1e-10)
    assert 0 <= many.C_J_drift < 1e-9 and abs(many.energy_error) < 1e-9 and many.heat > 1e-3


# ---- outcomes, and small motions ----


def test_the_last_spin_is_that_of_the_top_that_turns_about_its_contact():
    """omega along r, and C_J = L . r."""
    found = outcome(LOADED, State(0.1, 0, 0, 2.7))
    assert found.verdict == "hangs"
    axis = np.array([0.0, -np.sin(found.theta), np.cos(found.theta)])
    inertia = LOADED.I1 * np.eye(3) + (LOADED.I3 - LOADED.I1) * np.outer(axis, axis)
    r = sb.UP - LOADED.a * axis
    assert found.omega3 == pytest.approx(found.C_J * (r @ axis) / (r @ inertia @ r), rel=1e-12)


def test_a_top_that_turns_over_from_below_stays_inverted():
    assert outcome(PAPER, State(3.0, 0, 0, -12.0)).verdict == "stays inverted"
    assert outcome(PAPER, State(0.2, 0, 0, 12.0)).verdict == "turns over"


@pytest.mark.parametrize("theta", [0.6, 1.4])
def test_rolling_about_tumbling_is_that_of_the_body_in_space(theta):
    """The eigenvalues of its linearised motion, by differences."""
    body, start = rb.Body(LOADED.a, LOADED.I1, LOADED.I3), tumbling(LOADED, theta)[:4]

    def rate(y):
        theta, w1, w2, w3 = y
        z, w = np.array([0.0, np.sin(theta), np.cos(theta)]), y[1:]
        w_dot, _ = rb.acceleration(body, z, w)
        psi_dot = w3 - w2 / np.tan(theta)
        return np.array([w1, w_dot[0] - psi_dot * w2, w_dot[1] + psi_dot * w1, w_dot[2]])

    np.testing.assert_allclose(rate(start), 0, atol=1e-12)
    steps = 1e-4 * np.eye(4)
    columns = [(8 * (rate(start + h) - rate(start - h)) - (rate(start + 2 * h) - rate(start - 2 * h))) / 12e-4
               for h in steps]  # fmt: skip
    found = tumbling_modes(LOADED, Coulomb(0.3), theta), np.linalg.eigvals(np.array(columns).T)
    mine, other = (sorted(each, key=lambda x: (round(x.imag, 4), x.real)) for each in found)
    np.testing.assert_allclose(mine, other, rtol=0, atol=1e-5)


# ---- arrays, heights, ends ----


def test_f_on_three_axes_is_f_at_each_place():
    K_J, K_R, theta = np.linspace(-2, 6, 3)[:, None, None], np.array([8.0, 10.0])[:, None], np.linspace(0.3, 2.8, 4)
    found = f(theta, PAPER, Constants(K_J, K_R, 27.0))
    each = [[[f(x, PAPER, Constants(J, R, 27.0)) for x in theta] for R in (8.0, 10.0)] for J in np.linspace(-2, 6, 3)]
    np.testing.assert_allclose(found, each, rtol=1e-13, atol=1e-13)


@pytest.mark.parametrize("edge", [None, EDGE])
def test_the_height_of_g_above_what_touches(edge):
    P = preparing.problem(PAPER, Viscous(0.3), edge, (0.0, 0.0), 1e-9)
    for theta in (0.3, 1.5, 2.9):
        axis = np.array([0.0, -np.sin(theta), np.cos(theta)])
        contacts = [sb.sphere(PAPER), *([sb.edge(PAPER, *edge[:2])] if edge else [])]
        assert preparing.height(P, theta) == pytest.approx(-min(contact(axis)[2] for contact in contacts), abs=1e-12)


def test_the_judge_of_an_end():
    near = np.pi - UPRIGHT
    assert [judged(False, "ball", *each, False) for each in ((0.0, 0.19), (0.0, 0.21), (near + 0.01, 3.1))] == [
        "upright", "moving", "inverted"]  # fmt: skip
    leans = [(1.0, 1.0 + LEANS - 0.01), (1.0, 1.0 + LEANS + 0.01), (near - 0.1, 3.1)]
    assert [judged(False, "ball", *each, False) for each in leans] == ["leaning", "moving", "moving"]
    assert judged(False, "ball", 2.0, 1.0, True) == "rolling" and judged(False, "stem", 2.0, 1.0, True) == "stem"


def test_a_point_that_is_pushed_may_be_as_low_as_the_table():
    state, edge = State(0.7, 0.0, 0.0, 2.0), EDGE
    pushed(PAPER, state, (0.1, 0.0, 0.0), (0.0, 0.0, -1.0), Viscous(0.3), edge)
    with pytest.raises(TopError) as caught:
        pushed(PAPER, state, (0.1, 0.0, 0.0), (0.0, 0.0, -1.2), Viscous(0.3), edge)
    assert caught.value.name == "at" and caught.value.numbers["least"] == pytest.approx(-1.0, abs=1e-12)


def test_surfaces_cross_where_they_are_equally_wide():
    """Two that are nearly the same cone; also where a coefficient is small, but not nothing."""
    one = Frustum(low=0.0, high=0.05, r_low=0.01, r_high=0.02)
    other = Frustum(low=0.0, high=0.05, r_low=0.0100003, r_high=0.01999986)
    (z,) = crossings(one, other, 0.0, 0.05)
    assert one.radius(z) == pytest.approx(other.radius(z), rel=1e-12)


def test_two_contacts_that_meet_softly_stay_closed():
    """Both u_z vanish, by vertical impulses alone."""
    top, edge = Top(-0.4, 0.7, 0.3), (0.3, 1.3, 0.1)
    P, C = preparing.problem(top, Viscous(0.3), edge, (0.0, 0.0), 1e-3), new(MOTION).contacts
    theta = brentq(lambda theta: preparing.gap(P, np.cos(theta), np.sin(theta)), 1.5, 3.0, xtol=1e-15)
    y = preparing.y_of(P, theta, np.sin(theta / 2), np.cos(theta / 2), np.exp(0.4j), 0.4, (2e-3, 0.0, 0.0), 0.01 + 0j,
                       0j, 0.0, 0.0)  # fmt: skip
    y[at.Z], y[at.VZ] = 1 - top.a * np.cos(theta), -3e-3
    before = y.copy()
    assert np.abs(impact.moving(y, STEM, P, C)[2]) > 1e-3
    soften(y, np.array([True, True]), P, C)
    assert [impact.moving(y, i, P, C)[2] for i in (BALL, STEM)] == pytest.approx([0.0, 0.0], abs=1e-14)
    np.testing.assert_array_equal(y[[at.VX, at.VY]], before[[at.VX, at.VY]])
    assert y[at.LZ] == pytest.approx(before[at.LZ], abs=1e-14) and y[at.VZ] != before[at.VZ]


# ---- crowded nodes ----


@pytest.mark.parametrize(("y0", "eps"), [(0.3, 1e-3), (-0.8, 0.05), (1.0, 1e-5), (-1.0, 2e-3)])
def test_nodes_crowd_where_a_function_is_least(y0, eps):
    """At its minimum, as near as that is sharp: in Q = (y - y0)^2 + eps^2, or at an end in Q = eps + |y - y0|."""

    def Q(y):
        return eps + np.abs(y - y0) if abs(y0) == 1 else (y - y0) ** 2 + eps**2

    found = crowding(Q, 64)
    assert (found.y0, found.eps) == pytest.approx((y0, eps), rel=1e-3)


@pytest.mark.parametrize("size", [1.0, 7.0])
def test_the_way_back_from_crowded_nodes(size):
    """eta of a node from its kappa, of which only the ratio of sine and cosine counts."""
    crowd = crowding(lambda y: (y - 0.3) ** 2 + 1e-4, 64)
    cos_half, sin_half, _ = crowded(16, crowd)
    eta = [2 * np.arctan2(*eta_halves(size * sine, size * cosine, crowd))
           for sine, cosine in zip(sin_half, cos_half, strict=True)]  # fmt: skip
    np.testing.assert_allclose(eta, (np.arange(16) + 0.5) * np.pi / 16, atol=1e-9)


@pytest.mark.parametrize(("top", "theta", "y0"), [(PAPER, np.pi - 1e-2, -1.0), (ORDINARY, 1e-4, 1.0)])
def test_nodes_crowd_where_a_motion_lingers(top, theta, y0):
    """At the pole where it is thrown nearly upright and falls: there its kappa is 0 or pi."""
    assert Rolling(top, None, State(theta, 0.0, 0.0, 0.05))._crowding.y0 == y0


# ---- a rolling motion ----


def test_notes_of_90_degrees_are_when_it_is_there():
    motion = Rolling(PAPER, None, State(1.5, 0.6, 0.3, 0.8))
    times = np.linspace(0.0, 2.5 * motion.period, 9)
    notes = np.array([t for t, _ in motion._notes(times)])
    assert len(notes) >= 4 and np.all(np.diff(notes) > 0) and notes[-1] > 1.2 * motion.period
    np.testing.assert_allclose(motion.theta(notes), np.pi / 2, atol=1e-9)


def test_g_goes_as_fast_as_rolling_says():
    """Its path, found by integrating a series, against the integral of its velocity."""
    motion = Rolling(PAPER, None, State(1.0, 0.3, 0.2, 3.0))
    t = np.linspace(0.0, 1.5 * motion.period, 2001)
    moved = motion(t)
    velocity = np.exp(1j * moved.phi) * (moved.velocity[:, 0] + 1j * moved.velocity[:, 1])
    path = moved.com[:, 0] + 1j * moved.com[:, 1]
    np.testing.assert_allclose(path - path[0], cumulative_simpson(velocity, x=t, initial=0), atol=1e-9)


def test_the_mark_that_the_table_leaves_on_a_ball_is_on_its_surface():
    moved = roll(PAPER, None, np.linspace(0, 9, 30), State(1.0, 0.3, 0.2, 3.0))
    np.testing.assert_allclose(np.linalg.norm(moved.trace, axis=1), 1.0, rtol=0, atol=1e-12)


def test_constants_beside_a_state_are_those_of_the_state():
    state = State(1.0, 0.3, 0.2, 3.0)
    own = Constants.from_state(PAPER, 1.0, 0.3, 0.2, 3.0)
    assert roll(PAPER, own, [0.0], state).theta[0] == pytest.approx(1.0)
    with pytest.raises(TopError, match="K_J"):
        roll(PAPER, replace(own, K_J=own.K_J + 1e-6), [0.0], state)


def test_a_well_is_narrow_but_no_point_above_the_rounding_of_a_large_energy():
    """Of K_R = 1000 an energy has half a million MgR, of which rounding is 1e-10."""
    theta = steady_precessions(PAPER, 500.0, 1000.0).theta[0]

    def moves(E):
        try:
            return len(turning_points(PAPER, Constants(500.0, 1000.0, E))) > 0
        except TopError:
            return False

    low, high = 0.0, 1e6
    for _ in range(70):
        middle = (low + high) / 2
        low, high = (low, middle) if moves(middle) else (middle, high)
    inner, outer = turning_points(PAPER, Constants(500.0, 1000.0, high + 1e-7))[0]
    assert inner < theta < outer


# ---- many runs ----


def test_the_last_progress_is_all_of_it():
    seen = []
    slide_many(PAPER, State(0.1, 0.0, 0.0, [1.0, 2.0]), Coulomb(0.3), 0.01, progress=seen.append)
    assert seen[-1] == 1.0 and max(seen) == 1.0


# ---- an end ----


@pytest.mark.parametrize(
    ("heat", "quiet"),
    [([0.0, 0.0, 0.0], True), ([0.0, 4e-3, 7e-3], True), ([0.0, 4e-3, 1e-2], False), ([0.0, 0.0, 4e-3], False)],
)
def test_it_is_quiet_where_friction_takes_little_and_ever_less(heat, quiet):
    """On its stem, with an energy of motion of 8 MgR: in its last span a thousandth, and no more than in the half
    before."""
    t = np.array([1.0, 2.0, 3.0])
    moved = SimpleNamespace(t=t, heat=np.array(heat), ledger=SimpleNamespace(kinetic=[8.0]))
    assert endings._quiet(moved, np.full(3, True), "stem") is quiet
