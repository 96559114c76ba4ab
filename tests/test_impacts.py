"""Painlevé's limit, properties of every motion, flight and impact, compared with Newton's law for the whole body."""

from itertools import pairwise

import numpy as np
import pytest
import sliding_body as sb
from cases import LOADED, PAPER
from hypothesis import example, given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation
from sliding_body import in_space
from test_contacts import EDGE, GREASED, VISCOUS, first_instant, gap, impact, law, matrices, momenta

from tippe_core import (
    Coulomb,
    SmoothedCoulomb,
    State,
    TopError,
    TruncatedSphere,
    Viscous,
    slide,
    slide_many,
)

# ---- Painleve's limit ----


@pytest.mark.parametrize("law", [Coulomb, lambda mu: SmoothedCoulomb(mu, 0.1)])
@pytest.mark.parametrize("slope", [2.2, 2.6, 2.9])
def test_painleve_on_the_stem(law, slope):
    """It stops where the rigid body's own N is negative though nothing else would carry."""
    state, contact, stopped = State(slope, 0, 0, 0, vy=-1), sb.edge(PAPER, *EDGE[:2]), []
    for mu in np.arange(0.3, 2.05, 0.1):
        moved = slide(PAPER, state, law(mu), [0, 1e-3], edge=EDGE)
        push = law(mu)
        q, w, v, _ = first_instant(slide(PAPER, state, GREASED, [0], edge=EDGE))
        axis = sb.matrix(q)[:, 2]
        (N,) = sb.supported(PAPER, lambda u, push=push: push.k(u @ u) * u * [1, 1, 0], (contact,), axis, w, v)[2]
        if N < 0:
            assert moved.events == ((0.0, "Painleve's limit"),) and len(moved.t) == 1
            assert moved.force[0, 2] == 0 and moved.supports == ((0.0, "stem"),)
        else:
            assert "Painleve's limit" not in {what for _, what in moved.events}
            assert moved.force[0, 2] == pytest.approx(N, rel=1e-6)
        stopped.append(N < 0)
    assert stopped[-1] and not stopped[0]


def test_painleves_limit_of_the_issue():
    for mu in (1.0, 2.0):
        moved = slide(PAPER, State(2.6, 0, 0, 0, vy=-1), Coulomb(mu), [0, 1.0], edge=EDGE)
        assert moved.events == ((0.0, "Painleve's limit"),)


SANK = (State(1.05452101, -4.47557814, 1.66558761, -2.27392277, vx=0.61912355, vy=0.15238439), 2.33594616)


def above_the_table(moved):
    """Of the ball's lowest point, from the pose; and the ledger with the heat is kept."""
    np.testing.assert_allclose(sum(moved.ledger), moved.energy[0], rtol=0, atol=1e-8)
    return moved.com[:, 2] + [sb.sphere(moved.top)(axis)[2] for axis in matrices(moved)[:, :, 2]]


def starts(count):
    random = np.random.default_rng(7)
    for _ in range(count):
        yield (State(random.uniform(0.2, 2), *random.normal(0, 4, 2), random.normal(0, 8), vx=random.normal(),
                     vy=random.normal()), random.uniform(0, 3))  # fmt: skip


def test_painleve_on_the_ball():
    """Viscous friction of a fast slip: no N of the rigid body balances it, though without it the table would push.

    It was called "lifts off", and the top fell into the table, to -4e-4 R.
    """
    limit = left = 0
    for state, gamma in (SANK, *starts(150)):
        moved = slide(PAPER, state, Viscous(gamma), np.linspace(0, 0.03, 61), rtol=1e-10)
        assert above_the_table(moved).min() > -1e-9
        q, w, v, _ = first_instant(slide(PAPER, state, GREASED, [0]))
        N, free = (sb.accelerations(PAPER, lambda u, k=k: k * u * [1, 1, 0], sb.matrix(q)[:, 2], w, v)[2]
                   for k in (gamma, 0.0))  # fmt: skip
        at_once = [what for t, what in moved.events if t == 0]
        assert at_once == (["lifts off"] if free < 0 else ["Painleve's limit"] if N < 0 else [])
        if at_once == ["Painleve's limit"]:
            assert len(moved.t) == 1 and moved.force[0, 2] == 0 and moved.supports == ((0.0, "ball"),)
        limit, left = limit + (free > 0 > N), left + (free < 0)
    assert limit > 5 and left > 5


def test_a_short_hop_of_a_start_ends_where_the_ball_meets_the_table():
    """Up and down again within the first step of the flight; it was followed to that step's end, below the table."""
    state, friction = State(1.89178890, -3.72605542, 1.10835478, 9.26861311, vx=0.7131987, vy=-0.9385750), VISCOUS
    moved = slide(PAPER, state, friction, np.linspace(0, 0.02, 201), rtol=1e-10)
    assert [what for _, what in moved.events[:2]] == ["lifts off", "lands"]
    assert above_the_table(moved).min() > -1e-9
    # the flight in closed form: L is kept, and the axis goes round it
    (L, *_), (v, *_) = momenta(moved)
    axis, along, z = matrices(moved)[0, :, 2], L / np.linalg.norm(L), moved.com[0, 2]
    t, turn = (landed := moved.events[1][0]), np.linalg.norm(L) / PAPER.I1 * landed
    there = (axis * np.cos(turn) + np.cross(along, axis) * np.sin(turn)
             + along * (along @ axis) * (1 - np.cos(turn)))  # fmt: skip
    assert 0 < t < 0.01 and abs(z + v[2] * t - t * t / 2 + sb.sphere(PAPER)(there)[2]) < 1e-12


# ---- what holds of all motions ----

EDGES = [None, EDGE, (0.0, 13 / 15, 1 / 3), (0.5, 0.9, 0.1), (0.3, 1.2, 0.0)]
LAWS = st.one_of(
    st.builds(Coulomb, st.floats(0.05, 2.0)), st.builds(Viscous, st.floats(0, 3.0)),
    st.builds(SmoothedCoulomb, st.floats(0.05, 2.0), st.floats(0.05, 1.0)))  # fmt: skip
RATES = st.floats(-9, 9)


@settings(max_examples=40)
@given(theta=st.floats(0.01, 3.13), rates=st.tuples(RATES, RATES, RATES), vx=st.floats(-2, 2), vy=st.floats(-2, 2),
       friction=LAWS, edge=st.sampled_from(EDGES), landing=st.sampled_from(["stop", "plastic"]))  # fmt: skip
@example(1.0, (0.5, 3.0, 8.0), 0.0, 0.0, Coulomb(0.2), None, "stop")
@example(1.0, (0.5, 3.0, 8.0), 0.0, 0.0, Coulomb(0.2), EDGE, "plastic")
@example(2.6, (0.0, 0.0, 0.0), 0.0, -1.0, Coulomb(2.0), EDGE, "stop")
def test_the_table_never_pulls_and_supports_are_what_touches(theta, rates, vx, vy, friction, edge, landing):
    moved = slide(PAPER, State(theta, *rates, vx=vx, vy=vy), friction, np.linspace(0, 1.5, 61), edge=edge,
                  landing=landing, rtol=1e-8)  # fmt: skip
    assert np.all(moved.force[:, 2] >= 0)
    times, names = zip(*moved.supports, strict=True)
    assert times[0] == 0 and np.all(np.diff(times) > 0) and all(a != b for a, b in pairwise(names))
    carried = np.array(names)[np.searchsorted(times, moved.t, "right") - 1]
    np.testing.assert_array_equal(carried == "none", moved.regime == "air")
    c, s = np.cos(moved.theta), np.sin(moved.theta)
    clear = moved.com[:, 2] - (1 - PAPER.a * c)
    parts = {"ball": clear} | ({"stem": clear + gap(edge, c, s)} if edge else {})
    for name, height in parts.items():
        assert height.min() > -1e-7
        np.testing.assert_allclose(height[(carried == name) | (carried == "both")], 0, atol=1e-7)


# ---- flight and impact ----


def flight():
    """A motion with a flight, sampled closely around its ends."""
    state = State(1.5, 3.0, 5.0, 3.0)
    (t0, _), (t1, _) = slide(PAPER, state, VISCOUS, np.linspace(0, 3, 31), rtol=1e-12).events[:2]
    near = 1e-9
    times = np.concatenate([[0, t0 - near], np.linspace(t0 + near, t1 - near, 101), [t1 + near]])
    return slide(PAPER, state, VISCOUS, times, rtol=1e-12)


def test_flight_is_free_and_the_impact_balances():
    moved = flight()
    assert [what for _, what in moved.events[:2]] == ["lifts off", "lands"]
    air = slice(2, 103)
    assert set(moved.regime[air]) == {"air"} and set(moved.regime[[0, 1, 103]]) == {"slip"}
    L, v = momenta(moved)
    np.testing.assert_allclose(L[air], np.broadcast_to(L[1], (101, 3)), rtol=0, atol=1e-7)
    t = moved.t[air] - moved.t[1]
    fall = moved.com[1] + v[1] * t[:, None] - np.outer(t**2 / 2, sb.UP)
    np.testing.assert_allclose(moved.com[air], fall, rtol=0, atol=1e-7)
    axes = matrices(moved)[:, :, 2]
    # the axis goes round L at |L|/I1, found by turning it as a rigid body does
    turn, along = np.linalg.norm(L[1]) / PAPER.I1 * t[-1], L[1] / np.linalg.norm(L[1])
    there = (axes[1] * np.cos(turn) + np.cross(along, axes[1]) * np.sin(turn)
             + along * (along @ axes[1]) * (1 - np.cos(turn)))  # fmt: skip
    np.testing.assert_allclose(axes[102], there, rtol=0, atol=1e-7)
    heights = moved.com[air, 2] + [sb.sphere(PAPER)(axis)[2] for axis in axes[air]]
    assert heights.min() > -1e-12 and abs(heights[-1]) < 1e-8 and heights[50] > 1e-3
    # the impact: no jump of place, momentum and angular momentum from one impulse at the contact, no bounce
    i, j = 102, 103
    push, rho = v[j] - v[i], sb.sphere(PAPER)(axes[j])
    np.testing.assert_allclose(L[j] - L[i], np.cross(rho, push), rtol=0, atol=1e-7)
    w = in_space(moved.phi, moved.theta, *moved.omega.T)
    before, after = (v[k] + np.cross(w[k], rho) for k in (i, j))
    assert before[2] < -1e-3 and abs(after[2]) < 1e-7 and push[2] > 0
    assert moved.energy[j] < moved.energy[i]
    assert moved.heat[j] - moved.heat[i] == pytest.approx(moved.energy[i] - moved.energy[j], abs=1e-9)
    assert np.ptp(moved.heat[air]) < 1e-15
    assert (push[:2] @ (before + after)[:2]) < 0  # friction works against the slip


BALL = np.diag([1 + 1 / 0.4, 1 + 1 / 0.4, 1.0])  # of a uniform ball: u_h = v - w x r, r = z


@pytest.mark.parametrize(("friction", "kept"), [
    (Viscous(0.4), np.exp(-0.4 * 3.5 * 0.7)),
    (Viscous(0.0), 1.0),
    (Coulomb(0.2), 1 - 0.2 * 3.5 * 0.7 / 1.3),
    (Coulomb(0.9), 0.0),
])  # fmt: skip
def test_the_impact_of_a_ball(friction, kept):
    """Falling at 0.7: P = 0.7, and the slip (of 1.3) obeys du/dP = -3.5 k u, in closed form."""
    u0 = np.array([0.5, 1.2, -0.7])
    u = u0 + BALL @ impact(BALL, u0, friction)
    np.testing.assert_allclose(u, [0.5 * kept, 1.2 * kept, 0], rtol=0, atol=1e-9)


def test_an_impact_that_turns_the_slip_round():
    """A lean body whose slip stops on the way: less friction than mu_s then slips on, more sticks."""
    W = np.array([[3.0, 0, 1.2], [0, 3.0, 0], [1.2, 0, 1.0]])
    u0 = np.array([0.1, 0.0, -1.0])
    held = impact(W, u0, Coulomb(0.5))
    np.testing.assert_allclose(u0 + W @ held, 0, atol=1e-12)
    slips = impact(W, u0, Coulomb(0.2))
    u = u0 + W @ slips
    assert abs(u[2]) < 1e-9 and u[0] > 0.1 and slips[0] < 0
    assert slips[0] == pytest.approx(-0.2 * slips[2], rel=1e-6)


# ---- what is asked for ----


def test_stop_at_lift_off_is_as_it_was():
    state, times = State(0.8, 9.0, 0, 3.0), np.linspace(0, 1, 101)
    stopped, flying = (slide(PAPER, state, VISCOUS, times, landing=how) for how in ("stop", "plastic"))
    assert stopped.events == flying.events[:1] and len(stopped.t) < len(flying.t) == 101
    np.testing.assert_array_equal(stopped.com, flying.com[: len(stopped.t)])


def test_a_start_that_leaves_the_table_at_once():
    state, times = State(2.8, 0.1, -0.5, -9.0), np.linspace(0, 1, 11)
    stopped = slide(PAPER, state, VISCOUS, times, edge=EDGE, landing="stop")
    assert stopped.events == ((0.0, "lifts off"),) and list(stopped.regime) == ["air"]
    assert stopped.supports == ((0.0, "none"),)
    flying = slide(PAPER, state, VISCOUS, times, edge=EDGE)
    assert flying.regime[0] == "air" and flying.events[0] == (0.0, "lifts off") and len(flying.t) == 11
    assert flying.events[1][1].startswith("lands") and flying.supports[:1] == ((0.0, "none"),)


@pytest.mark.parametrize("friction", [Coulomb(0.2), VISCOUS, SmoothedCoulomb(0.2, 0.1)])
def test_a_start_on_the_ball_that_leaves_the_table_at_once(friction):
    """G falls freely from it, as N of the rigid body would have to pull."""
    state, times = State(1.0, 0.5, 3, 8), np.linspace(0, 0.15, 16)
    stopped = slide(PAPER, state, friction, times, landing="stop")
    assert stopped.events == ((0.0, "lifts off"),) and list(stopped.regime) == ["air"]
    q, w, v, _ = first_instant(stopped)
    push = law(friction)
    assert sb.accelerations(PAPER, lambda u: push(u) * [1, 1, 0], sb.matrix(q)[:, 2], w, v)[2] < 0
    flying = slide(PAPER, state, friction, times)
    z = flying.com[0, 2] + flying.velocity[0, 2] * times - times**2 / 2
    np.testing.assert_allclose(flying.com[:, 2], z, rtol=0, atol=1e-9)


def test_a_loaded_sphere_needs_no_stem():
    times = np.linspace(0, 60, 61)
    whole = slide(LOADED, State(0.1, 0, 0, 4.0), VISCOUS, times)
    assert whole.events == ()


def test_progress_and_stop():
    class Stop(Exception):
        pass

    seen = []

    def stops(done):
        seen.append(done)
        if 300 * done > 100:
            raise Stop

    with pytest.raises(Stop):
        slide(PAPER, State(0.1, 0, 0, 8.8), SmoothedCoulomb(0.3, 1.0), [0, 300.0], progress=stops)
    assert len(seen) > 10 and np.all(np.diff(seen) > 0) and 100 < 300 * seen[-1] < 110
    for state, friction in ((State(0.1, 0, 0, 8.8), Coulomb(0.5)), (State(3.0, 0, 0, -9.0), VISCOUS),
                            (State(1.5, 3.0, 5.0, 3.0), Coulomb(0.3))):  # fmt: skip
        seen.clear()
        slide(PAPER, state, friction, [0, 10.0], edge=EDGE, progress=seen.append)
        assert seen


def test_the_surface_of_a_cut_ball_ends():
    bowl = TruncatedSphere(R=0.016, c=0.004, l=0, r=0, M=0.01)
    for friction in (VISCOUS, Coulomb(0.5)):
        moved = slide(bowl.top, State(1.0, 2.0, 0, 1.0), friction, np.linspace(0, 5, 501), edge=bowl.edge)
        assert moved.events[-1][1] == "rim touches"
        assert 0 < bowl.touch_angle - moved.theta[-1] < 0.05
    with pytest.raises(TopError):
        slide(bowl.top, State(2.0, 0, 0, 1.0), VISCOUS, [0, 1], edge=bowl.edge)


@pytest.mark.parametrize(("name", "more"), [
    ("landing", {"landing": "elastic"}),
    ("edge", {"edge": (0.1, 0.2)}),
    ("edge", {"edge": (-1.0, 2.0)}),
    ("edge", {"edge": (1.0, np.nan)}),
    ("edge", {"edge": 3.0}),
    ("edge", {"edge": (0.5, 0.7, 0.05)}),  # inside the sphere that rolls
])  # fmt: skip
def test_bad_input_is_named(name, more):
    with pytest.raises(TopError) as caught:
        slide(PAPER, State(0.1, 0, 0, 1.0), VISCOUS, [0, 1], **more)
    assert caught.value.name == name


def test_an_edge_may_reach_out_of_the_sphere_by_its_rounding():
    assert len(slide(PAPER, State(0.1, 0, 0, 1.0), VISCOUS, [0, 1], edge=(0.5, 0.8, 0.1)).t) == 2


def test_in_the_air_it_turns_as_a_body_without_torque():
    """Thrown up by its own turning: the orientation, the turn about axis 3 included, with L constant in space."""
    start = State(2.5, 6.0, 1.0, 4.0, phi=0.3, psi=0.8)
    times = np.linspace(0, 0.3, 31)
    moved = slide(PAPER, start, Coulomb(0.3), times, rtol=1e-12)
    air = moved.regime == "air"
    assert moved.events[0] == (0.0, "lifts off") and air[:10].all()
    q, omega, *_ = first_instant(moved)
    inertia = np.diag([PAPER.I1, PAPER.I1, PAPER.I3])

    def rates(_, q):
        R = Rotation.from_quat(q).as_matrix()
        w = R @ np.linalg.inv(inertia) @ R.T @ L
        return 0.5 * (Rotation.from_quat([*w, 0.0]) * Rotation.from_quat(q)).as_quat() * np.linalg.norm(w)

    R = Rotation.from_quat(q).as_matrix()
    L = R @ inertia @ R.T @ omega
    turned = solve_ivp(rates, (0, times[-1]), q, t_eval=times[air], rtol=1e-12, atol=1e-13).y.T
    apart = (Rotation.from_quat(moved.quaternion[air]) * Rotation.from_quat(turned).inv()).magnitude()
    assert apart.max() < 1e-8
    assert np.ptp(moved.psi[air]) > 0.1


@pytest.mark.parametrize("friction", [Viscous(0.3), Coulomb(0.3)])
def test_on_the_stem_the_body_turns_as_its_omega_says(friction):
    """The turn about axis 3 included: from one instant to the next but one, against omega at the one between."""
    times = np.linspace(0, 1.0, 2001)
    moved = slide(PAPER, State(3.0, 0, 0, -9.0), friction, times, rtol=1e-12, edge=EDGE)
    assert {what for _, what in moved.supports} == {"stem"}
    turned = Rotation.from_quat(moved.quaternion)
    omega = in_space(moved.phi, moved.theta, *moved.omega.T)[1:-1]
    found = (turned[2:] * turned[:-2].inv()).as_rotvec() / (2 * times[1])
    assert np.abs(found - omega).max() < 2e-4 * np.abs(omega).max()


# ---- starts in flight ----


@pytest.mark.parametrize("landing", ["plastic", "stop"])
def test_a_top_that_starts_in_flight_falls_freely_until_it_lands(landing):
    """Galilei's parabola; without a spin the tilt stays, so the height of G at which it lands is known."""
    start, times = State(0.5, 0.0, 0.0, 0.0, vx=0.3, vy=-0.2, z=1.5, vz=0.4), np.linspace(0, 2, 41)
    moved = slide(PAPER, start, VISCOUS, times, landing=landing)
    [lands] = [t for t, name in moved.events if name == "lands"]
    low = 1 - PAPER.a * np.cos(0.5)
    assert lands == pytest.approx(0.4 + np.sqrt(0.16 + 2 * (1.5 - low)), abs=1e-9)
    flies = moved.t < lands
    assert (moved.regime[flies] == "air").all() and moved.events[0][1] == "lands"
    t = times[flies]
    np.testing.assert_allclose(moved.com[flies, 2], 1.5 + 0.4 * t - t**2 / 2, rtol=0, atol=1e-12)
    np.testing.assert_allclose(moved.com[flies, :2], t[:, None] * [0.3, -0.2], rtol=0, atol=1e-12)
    assert moved.supports[:2] == ((0.0, "none"), (lands, "ball"))
    assert np.ptp(moved.energy + moved.heat) < 1e-9


def test_a_start_in_flight_lands_on_the_stem_and_many_know_it():
    start = State(2.9, 0.0, 0.0, -6.0, z=2.5)
    moved = slide(PAPER, start, VISCOUS, [0, 1.5], edge=EDGE)
    assert moved.events[0][1] == "lands on its stem"
    heights = np.array([2.5, 0.5])
    many = slide_many(PAPER, State(2.9, 0.0, 0.0, -6.0, z=heights), VISCOUS, 1.5, EDGE)
    assert many.time_stem[0] == pytest.approx(moved.events[0][0], abs=1e-6) and many.hops[0] == 0
    assert many.reason.tolist() == ["", "out-of-range"] and many.end[1] == "refused"


def test_a_start_in_the_table_or_half_in_flight_is_refused():
    low = 1 - PAPER.a * np.cos(0.5)
    with pytest.raises(TopError, match=f"{low:.6g}") as refused:
        slide(PAPER, State(0.5, 0, 0, 5, z=low - 1e-3), VISCOUS, [0, 1])
    assert refused.value.name == "z"
    with pytest.raises(TopError) as refused:
        State(0.5, 0, 0, 5, vz=1.0)
    assert refused.value.name == "vz"
