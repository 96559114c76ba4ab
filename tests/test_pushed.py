"""A push: the state after it is that of a rigid body on contacts that yield, which gets the same impulse."""

import numpy as np
import pytest
import stem_body
from cases import LOADED, PAPER
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation
from test_contacts import EDGE

from tippe_core import Contensou, Coulomb, SmoothedCoulomb, State, TopError, Viscous, pushed, slide

LEANS = State(0.6, 0.4, 1.0, 9.0, phi=0.7, psi=0.3, vx=0.3, vy=-0.2)
FLIES = State(0.6, 0.4, 1.0, 9.0, vx=0.3, z=1.6, vz=0.1)
LIES = State(2.2, 0.0, 1.0, -4.0, vx=0.1, vy=0.1)  # on its stem alone


def axes(state):
    """Columns: 1', 2' and 3 in space."""
    return Rotation.from_euler("ZXZ", [state.phi, state.theta, 0.0]).as_matrix()


def body(top, state):
    """(I about G, w, the point O seen from G) in space."""
    to_space = axes(state)
    inertia = to_space @ np.diag([top.I1, top.I1, top.I3]) @ to_space.T
    return inertia, to_space @ [state.theta_dot, state.omega2, state.omega3], top.a * to_space[:, 2]


def in_space(state, vector):
    return Rotation.from_euler("z", state.phi).apply(vector)


def velocity(top, state, edge=None):
    """That of G in space; without vz the lower part stays on the table."""
    vx, vy, _ = in_space(state, [state.vx or 0.0, state.vy or 0.0, 0.0])
    if state.vz is not None:
        return np.array([vx, vy, state.vz])
    w = body(top, state)[1]
    rho = min(parts(top, state, edge), key=lambda rho: rho[2])
    return np.array([vx, vy, -np.cross(w, rho)[2]])


def parts(top, state, edge=None):
    """The lowest points of ball and stem, seen from G."""
    e, up = axes(state)[:, 2], np.array([0.0, 0.0, 1.0])
    found = [top.a * e - up]
    if edge is not None:
        b, h, q = (*edge, 0.0)[:3]
        out = up - e[2] * e
        found.append((top.a + h) * e - b * out / np.linalg.norm(out) - q * up)
    return found


def energy(top, state, edge=None):
    inertia, w, _ = body(top, state)
    v = velocity(top, state, edge)
    return w @ inertia @ w / 2 + v @ v / 2


def free(top, state, push, place, edge=None):
    """(w, v) of a body in space that no table carries, after the push."""
    inertia, w, O = body(top, state)
    F, r = in_space(state, push), O + in_space(state, place)
    return w + np.linalg.solve(inertia, np.cross(r, F)), velocity(top, state, edge) + F


def yielding(monkeypatch, top, state, push, place, friction, times, edge=None, **table):
    begin = stem_body._start

    def kicked(*given):
        y, (w, v) = begin(*given), free(top, state, push, place, edge)
        y[4:7], y[10:13] = axes(state).T @ w, v
        if state.z is not None:
            y[9] = state.z
        return y

    monkeypatch.setattr(stem_body, "_start", kicked)
    return stem_body.integrate(top, state, friction, times, edge, **table)


PUSHES = {
    "down on the side": (LEANS, [0.2, 0.1, -0.6], [0.1, -0.6, 0.7], Coulomb(0.3), None),
    "sideways": (LEANS, [0.5, 0.4, 0.0], [0.0, -0.9, 0.2], Coulomb(0.4), None),
    "on oil": (LEANS, [0.3, -0.2, -0.5], [0.5, -0.5, 0.5], Viscous(0.5), None),
    "on a smoothed law": (LEANS, [0.3, -0.2, -0.5], [0.5, -0.5, 0.5], SmoothedCoulomb(0.3, 0.2), None),
    "with a patch": (LEANS, [0.3, 0.2, -0.5], [0.5, -0.5, 0.5], Contensou(0.3, 0.03), None),
    "lifted": (LEANS, [0.1, 0.0, 0.7], [0.0, 0.2, -0.3], Coulomb(0.3), None),
    "in flight": (FLIES, [0.3, -0.2, 0.1], [0.5, -0.5, 0.5], Coulomb(0.3), None),
    "on its stem": (LIES, [0.1, 0.1, -0.5], [0.0, 0.5, 0.6], Coulomb(0.3), EDGE),
}  # fmt: skip


@pytest.mark.parametrize("case", PUSHES)
def test_it_is_that_of_a_body_on_contacts_that_yield(monkeypatch, case):
    state, push, place, friction, edge = PUSHES[case]
    times = np.array([0.02, 0.1, 0.2])  # long after the table has answered
    after = pushed(PAPER, state, push, place, friction, edge)
    moved = slide(PAPER, after, friction, [0.0, *times], edge=edge)
    found = yielding(monkeypatch, PAPER, state, push, place, friction, [0.0, *times], edge, k=1e9, eps=1e-5,
                     share=0.1)  # fmt: skip
    np.testing.assert_allclose(moved.theta[1:], found.theta[1:], atol=3e-5)
    np.testing.assert_allclose(moved.omega[1:], found.omega[1:], atol=6e-4)
    np.testing.assert_allclose(moved.com[1:, 2], found.com[1:, 2], atol=3e-5)


SIZE, PLACE = st.floats(-1.5, 1.5), st.floats(-0.7, 0.7)


@settings(max_examples=60)
@given(theta=st.floats(0.05, 3.0), rates=st.tuples(*[st.floats(-6, 6)] * 3), push=st.tuples(*[SIZE] * 3),
       place=st.tuples(*[PLACE] * 3), top=st.sampled_from([PAPER, LOADED]), edge=st.sampled_from([None, EDGE]),
       friction=st.sampled_from([Coulomb(0.3), Viscous(0.4), Contensou(0.2, 0.05)]))  # fmt: skip
def test_it_takes_no_more_energy_than_the_push_gives_and_nothing_enters_the_table(
    theta, rates, push, place, top, edge, friction
):
    state = State(theta, *rates, phi=0.4, vx=0.2, vy=-0.3)
    after = pushed(top, state, push, place, friction, edge)
    (_, w, O), (w_free, v_free) = body(top, state), free(top, state, push, place, edge)
    r = O + in_space(state, place)
    mean = (velocity(top, state, edge) + np.cross(w, r) + v_free + np.cross(w_free, r)) / 2
    work = in_space(state, push) @ mean
    assert energy(top, after, edge) <= energy(top, state, edge) + work + 1e-9
    lower = min(rho[2] for rho in parts(top, state, edge))
    for rho in parts(top, after, edge):
        if rho[2] < lower + 1e-9:
            assert (velocity(top, after, edge) + np.cross(body(top, after)[1], rho))[2] > -1e-9


def test_no_push_changes_nothing():
    after = pushed(PAPER, LEANS, [0, 0, 0], [0.3, 0.2, 0.1], Viscous(0.3))
    for name in ("theta", "theta_dot", "omega2", "omega3", "phi", "psi", "vx", "vy"):
        assert getattr(after, name) == pytest.approx(getattr(LEANS, name), abs=1e-12)
    assert after.z is None and after.vz is None


def test_through_the_axis_of_a_sleeping_top_it_only_leans():
    """About the upright axis phi is free, and the spin about it stays."""
    after = pushed(PAPER, State(0.0, 0.0, 0.0, 9.0, phi=0.2), [0.3, 0.0, 0.0], [0.0, 0.0, 0.9], Viscous(0.0))
    assert (after.omega2, after.vx**2 + after.vy**2) == (0.0, pytest.approx(0.09)) and after.omega3 == 9.0
    assert after.theta_dot == pytest.approx(0.3 * (0.9 + PAPER.a) / PAPER.I1)  # the ice gives no torque about y
    moved, there = (
        slide(PAPER, after, Viscous(0.0), [0.0, 1e-4]),
        slide(PAPER, State(0.0, 0, 0, 9.0), Viscous(0.0), [0.0]),
    )
    assert moved.com[1, :2] - moved.com[0, :2] == pytest.approx(0.3e-4 * np.array([np.cos(0.2), np.sin(0.2)]), abs=1e-9)
    assert moved.com[0, 2] == there.com[0, 2]


@pytest.mark.parametrize(
    ("push", "place", "code"),
    [([0, 0, 2e3], [0, 0, 1], "too-large"), ([0, 0, 1], [0, 0, -1.5], "out-of-range"),
     ([0, 1], [0, 0, 0], "wrong-kind"), ([0, 0, np.nan], [0, 0, 0], "not-finite")],
)  # fmt: skip
def test_a_push_that_cannot_be_says_why(push, place, code):
    with pytest.raises(TopError) as caught:
        pushed(PAPER, LEANS, push, place, Coulomb(0.3))
    assert caught.value.code == code
