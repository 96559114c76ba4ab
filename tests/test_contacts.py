"""Flight, landing and the edge of the stem's end against a rigid body that shares no formula with slide()."""

from dataclasses import replace

import numpy as np
import pytest
import sliding_body as sb
import stem_body
from cases import PAPER
from references import kept

from tippe_core import (
    PRESETS,
    Ball,
    Coulomb,
    OrdinaryTop,
    SmoothedCoulomb,
    State,
    Top,
    TruncatedSphere,
    Viscous,
    slide,
)
from tippe_core.motion.impact import impact as four
from tippe_core.motion.records import IMPACT, LAW, new

STEM = TruncatedSphere.paper()
EDGE = STEM.edge
TOUCH = STEM.touch_angle
VISCOUS = Viscous(0.3)


def gap(edge, c, s):
    radius, height, rounding = edge
    return 1 + height * c - radius * s - rounding


def impact(W, u0, friction):
    """The impulse alone, of a body that does not spin about the vertical."""
    law = new(LAW)
    for name, value in friction.law._asdict().items():
        law[name] = value
    whole = np.zeros((4, 4))
    whole[:3, :3], whole[3, 3] = W, 1.0
    return four(whole, np.append(u0, 0.0), law, new(IMPACT))[:3]


def law(friction):
    return lambda u: friction.k(u @ u) * u


def matrices(moved):
    return np.array([sb.matrix(q) for q in moved.quaternion])


def momenta(moved):
    """L about G and v of G, (n, 3) each, in space."""
    top, L = moved.top, moved.omega * [moved.top.I1, moved.top.I1, moved.top.I3]
    turn = np.exp(1j * moved.phi) * (moved.velocity[:, 0] + 1j * moved.velocity[:, 1])
    assert top is moved.top
    return sb.in_space(moved.phi, moved.theta, *L.T), np.stack([turn.real, turn.imag, moved.velocity[:, 2]], axis=1)


def first_instant(moved):
    i = sb.in_space(moved.phi, moved.theta, *moved.omega.T)[0]
    return moved.quaternion[0], i, momenta(moved)[1][0], moved.com[0]


def lowest(edge, theta):
    """Height of the lowest point of all of a rounded circle's, while the sphere stands on the table."""
    radius, height, rounding = edge
    turn = np.linspace(0, 2 * np.pi, 2001)
    return (1 + height * np.cos(theta) + radius * np.sin(theta) * np.cos(turn)).min() - rounding


@pytest.mark.parametrize("shape", [STEM, OrdinaryTop(R=2e-3, h=6e-3, r1=2e-2, r2=2e-2, t=5e-3, r=2e-3, l=1e-2, M=0.02),
                                   Ball(R=0.01, M=0.01), *(preset.shape for preset in PRESETS)])  # fmt: skip
def test_the_edge_of_a_shape_is_what_touches(shape):
    """Its lowest point comes to the table at touch_angle, and is above it before."""
    if shape.touch_angle is None:
        assert shape.edge is None
        return
    for tilt, sign in ((0, 0), (-1e-3, 1), (1e-3, -1)):
        theta = shape.touch_angle + tilt
        height = lowest(shape.edge, theta)
        assert abs(height) < 1e-12 if sign == 0 else height * sign > 1e-7
        assert gap(shape.edge, np.cos(theta), np.sin(theta)) == pytest.approx(height, abs=1e-12)


def test_the_height_of_a_rounded_edge():
    edge = 0.5, 0.9, 0.1
    for theta in (0.3, 1.5, 2.8):
        assert gap(edge, np.cos(theta), np.sin(theta)) == pytest.approx(lowest(edge, theta), abs=1e-12)


@pytest.mark.parametrize("edge", [EDGE, (0.1, 1.6, 0.1), (0.0, 1.5, 0.2)])
def test_on_a_rounded_end_the_lowest_point_is_on_the_table(edge):
    """O is then as far below 1 as that point would be below the table if the sphere stood on it."""
    moved = slide(PAPER, State(2.9, 0, 0, -9.0), VISCOUS, np.linspace(0, 1, 11), rtol=1e-10, edge=edge)
    assert moved.supports == ((0.0, "stem"),) and np.ptp(moved.theta) > 1e-3
    O = [1 - lowest(edge, theta) for theta in moved.theta]
    np.testing.assert_allclose(moved.com[:, 2], O - PAPER.a * np.cos(moved.theta), rtol=0, atol=1e-9)
    np.testing.assert_allclose(np.ptp(sum(moved.ledger)), 0, atol=1e-8)


# ---- on the stem, and on both ----

ON_BOTH = State(TOUCH, 0.0, 0.31, -1.32, vx=0.58, vy=-0.31)
SUPPORTED = {
    "stem": (State(3.0, 0, 0, -9.0), VISCOUS, (sb.edge(PAPER, *EDGE[:2]),)),
    "stem, moving": (State(2.9, 0.1, -0.2, -8.0, 0.3, 0.2, 1.0, 2.0, 0.2, 0.1), SmoothedCoulomb(0.2, 0.3),
                     (sb.edge(PAPER, *EDGE[:2]),)),
    "both": (ON_BOTH, VISCOUS, (sb.sphere(PAPER), sb.edge(PAPER, *EDGE[:2]))),
    "both, moving": (replace(ON_BOTH, omega2=0.4, omega3=-0.3, vx=0.3, vy=-0.2, phi=1.0), SmoothedCoulomb(0.2, 0.3),
                     (sb.sphere(PAPER), sb.edge(PAPER, *EDGE[:2]))),
}  # fmt: skip


@pytest.mark.parametrize("name", SUPPORTED)
def test_on_the_stem_and_on_both_against_the_rigid_body(name):
    state, friction, contacts = SUPPORTED[name]
    times = np.linspace(0.0, 3.0, 31)
    moved = slide(PAPER, state, friction, times, rtol=1e-12, edge=EDGE)
    assert {what for _, what in moved.events} <= ({"stem touches"} if len(contacts) > 1 else set())
    motion = sb.stored(PAPER, friction, *first_instant(moved), times, rim=EDGE[:2], is_on_ball=len(contacts) > 1)
    q = motion.quaternion / np.linalg.norm(motion.quaternion, axis=1)[:, None]
    q *= np.sign((q * moved.quaternion).sum(axis=1))[:, None]
    np.testing.assert_allclose(moved.quaternion, q, rtol=0, atol=1e-8)
    np.testing.assert_allclose(moved.com, motion.com, rtol=0, atol=1e-8)
    np.testing.assert_allclose(momenta(moved)[1], motion.velocity, rtol=0, atol=1e-8)
    np.testing.assert_allclose(moved.energy - moved.energy[0], motion.work, rtol=0, atol=1e-8)
    np.testing.assert_allclose(moved.heat, -motion.work, rtol=0, atol=1e-8)
    axes = matrices(moved)[:, :, 2]
    for i in range(0, 31, 5):
        w, v = motion.omega[i], motion.velocity[i]
        N = sb.supported(PAPER, law(friction), contacts, axes[i], w, v)[2]
        rho = np.array([contact(axes[i]) for contact in contacts])
        assert np.all(N > 0)
        assert moved.force[i, 2] == pytest.approx(N.sum(), abs=1e-6)
        np.testing.assert_allclose(moved.contact[i], moved.com[i, :2] + N @ rho[:, :2] / N.sum(), rtol=0, atol=1e-6)
        np.testing.assert_allclose(moved.com[i, 2] + rho[:, 2], 0, atol=1e-9)


def test_rolling_on_the_stem():
    """Coulomb's friction stops the edge; then energy stays, the edge rests on the table, and friction in its cone."""
    friction = Coulomb(0.3)
    moved = slide(PAPER, State(3.0, 0, 0, -9.0), friction, np.linspace(0, 4, 401), rtol=1e-12, edge=EDGE)
    assert [what for _, what in moved.events] == ["sticks"]
    rolls = moved.regime == "roll"
    assert 100 < rolls.sum() < 300
    assert np.ptp(moved.energy[rolls]) < 1e-10
    axes, (_, v) = matrices(moved)[:, :, 2], momenta(moved)
    w = sb.in_space(moved.phi, moved.theta, *moved.omega.T)
    for i in np.flatnonzero(rolls)[::20]:
        np.testing.assert_allclose(v[i] + np.cross(w[i], sb.edge(PAPER, *EDGE[:2])(axes[i])), 0, atol=1e-10)
    F_h = np.hypot(*moved.force[:, :2].T)
    assert np.all(F_h[rolls] < 0.3 * moved.force[rolls, 2])
    # Newton: the force is the acceleration of G plus its weight
    h, i = 1e-2, np.flatnonzero(rolls)[1:-1]
    turn = np.exp(1j * moved.phi[i]) * (moved.force[i, 0] + 1j * moved.force[i, 1])
    F = np.stack([turn.real, turn.imag, moved.force[i, 2] - 1], axis=1)
    np.testing.assert_allclose((moved.com[i + 1] - 2 * moved.com[i] + moved.com[i - 1]) / h**2, F, rtol=0, atol=5e-3)

    # from there on it rolls again, without an event
    k = i[50]
    state = State(moved.theta[k], *moved.omega[k], moved.phi[k], moved.psi[k], *moved.com[k, :2],
                  *moved.velocity[k, :2])  # fmt: skip
    again = slide(PAPER, state, friction, moved.t[k : k + 101], rtol=1e-12, edge=EDGE)
    assert again.events == () and set(again.regime) == {"roll"}
    np.testing.assert_allclose(again.com, moved.com[k : k + 101], rtol=0, atol=1e-9)


def test_slip_of_the_stem_goes_through_zero():
    """Falling in a plane from its edge the stem slips one way, then the other, without a halt."""
    moved = slide(PAPER, State(2.5, 0.5, 0, 0), Coulomb(0.1), np.linspace(0, 2, 201), rtol=1e-11, edge=EDGE)
    (t0, what), *_ = moved.events
    assert what == "slips"
    along = moved.slip[:, 1]
    before, after = along[(moved.t > 0) & (moved.t < t0)], along[moved.t > t0]
    assert np.all(before * before[0] > 0) and np.all(after * before[0] < 0)
    np.testing.assert_allclose(sum(moved.ledger), moved.energy[0], rtol=0, atol=1e-8)
    np.testing.assert_allclose(np.abs(moved.force[1:, 1]), 0.1 * moved.force[1:, 2], rtol=1e-9)


HANDING = [(State(1.9, 0, 0, -3.0), VISCOUS), (State(1.9, 0, 0, -1.0), Coulomb(0.3, 0.4)),
           (State(1.5, 3.0, 5.0, 3.0), Coulomb(0.3, 0.35)), (State(0.1, 0, 0, 8.8), SmoothedCoulomb(0.3, 1.0)),
           (State(2.5, 0, 0, -9.0), SmoothedCoulomb(0.3, 0.1))]  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize(("state", "friction"), HANDING)
def test_hand_over_landing_and_flight(state, friction):
    """Nothing goes through the table, energy only falls and all of it is in the ledger, forces push within the law."""
    times = np.linspace(0, 196 if state.theta == 0.1 else 18, 1001)
    moved = slide(PAPER, state, friction, times, rtol=1e-11, edge=EDGE)
    what = [name for _, name in moved.events]
    assert {"stands on its stem", "lands on its stem"} & set(what)
    axes = matrices(moved)[:, :, 2]
    for contact in (sb.sphere(PAPER), sb.edge(PAPER, *EDGE[:2])):
        heights = moved.com[:, 2] + [contact(axis)[2] for axis in axes]
        assert heights.min() > -1e-9
    assert np.diff(moved.energy).max() < 1e-10
    np.testing.assert_allclose(sum(moved.ledger), moved.energy[0], rtol=0, atol=1e-8)
    assert np.all(moved.force[:, 2] >= 0)
    air = moved.regime == "air"
    np.testing.assert_array_equal(moved.force[air], 0)
    if isinstance(friction, Coulomb):
        assert np.all(np.hypot(*moved.force[:, :2].T) <= friction.mu_s * moved.force[:, 2] * (1 + 1e-9))
    # at half the tolerance the same, but for how many of ever smaller bounces count
    finer = slide(PAPER, state, friction, times, rtol=5e-12, edge=EDGE)
    assert {name for _, name in finer.events} == set(what)
    for (a, name), (b, same) in zip(moved.events[:3], finer.events[:3], strict=True):
        assert name == same and abs(a - b) < 1e-6
    assert finer.theta[-1] == pytest.approx(moved.theta[-1], abs=1e-5)


# ---- flat on the stem's end ----

H, B = PAPER.a + EDGE[1], EDGE[0]  # of G above the flat end, and the end's radius
HELD = Coulomb(5.0)
GREASED = Viscous(0.0)

# Near flat, rocking hard: the paper's top launched at 48 rev/s and 10 degrees under SmoothedCoulomb(0.3, 0.1), at
# t = 74.668 (it "stood upright" at 74.674); and by the spin of such a one alone, from 1e-3 rad.
NEARLY_FLAT = [State(3.1378602723, 0.4518077358, 0.0291667914, -5.4783462842, vx=0.2345688500, vy=-0.7695601846),
               State(np.pi - 1e-3, 0, 0, -6.0), State(np.pi - 1e-3, 0, 0, -2.0)]  # fmt: skip


@kept
def yielding(top, state, friction, times, edge):
    """(theta,) on a table of springs."""
    return (stem_body.integrate(top, state, friction, times, edge, k=1e9, damping=20.0).theta,)


@pytest.mark.parametrize("state", NEARLY_FLAT)
@pytest.mark.parametrize("friction", [SmoothedCoulomb(0.3, 0.1), VISCOUS])
def test_nearly_flat_it_stands_only_where_it_rocks_no_more(state, friction):
    """Against springs for contacts: it leans on its rim again, by more than half the angle at which G is over it.

    The first passes flat at 8e-4 rad, and so fast that only the stiffest spring is a hard table.
    """
    times = np.linspace(0, 4, 61)
    moved = slide(PAPER, state, friction, times, edge=EDGE)
    assert "stands upright" not in {what for _, what in moved.events} and len(moved.t) == 61
    np.testing.assert_allclose(moved.theta, yielding(PAPER, state, friction, times, EDGE)[0], rtol=0, atol=5e-3)
    assert (np.pi - moved.theta).max() > np.arctan2(B, H) / 2


def test_the_spin_of_a_flat_top_is_counted():
    """Turning slowly it comes down from its rim and stands; its energy is below G's greatest height."""
    moved = slide(PAPER, State(3.1, 0, 0, -0.1), SmoothedCoulomb(0.3, 0.1), np.linspace(0, 5, 501), edge=EDGE)
    ((t, what),) = moved.events
    assert what == "stands upright" and t - 0.02 < moved.t[-1] < t and np.pi - moved.theta[-1] < 0.01
    assert moved.energy[-1] + 1 - PAPER.a < np.hypot(H, B)


@pytest.mark.parametrize(("friction", "inertia"), [(HELD, PAPER.I1 + H * H), (GREASED, PAPER.I1)])
@pytest.mark.parametrize("share", [0.95, 1.05])
def test_rocking_over_the_rim(friction, inertia, share):
    """In a plane, from the rim, with just less and just more energy than G needs to get over it.

    Where the rim holds, its inertia is that about the rim; on ice that about G, and G rises by b theta_dot.
    """
    rises = np.hypot(H, B) - H
    # at the angle alpha just off flat: 1/2 (inertia + b^2) rate^2 = what is missing
    alpha, b = 2e-3, B
    height = H * (np.cos(alpha) - 1) + b * np.sin(alpha)
    rate = np.sqrt(2 * (share * rises - height) / (inertia + b * b))
    state = State(np.pi - alpha, -rate, 0, 0, vx=0, vy=rate * H if friction is HELD else 0.0)
    moved = slide(PAPER, state, friction, np.linspace(0, 20, 201), edge=EDGE)
    ends = moved.events[-1][1]
    assert (ends == "stands upright") == (share < 1), moved.events
    if share < 1:
        assert (np.pi - moved.theta).max() < np.arctan2(b, H)


@pytest.mark.parametrize(("friction", "inertia"), [(HELD, PAPER.I1 + H * H), (GREASED, PAPER.I1)])
def test_the_flat_end_comes_down_in_a_plane(friction, inertia):
    """On to the opposite point of the rim, which an impulse there stops: in closed form (Housner 1963, for blocks)."""
    rate = 0.15 if friction is HELD else 0.3
    state = State(3.05, rate, 0, 0, vx=0, vy=-rate * H if friction is HELD else 0.0)
    t0 = next(t for t, what in slide(PAPER, state, friction, [0, 5.0], edge=EDGE).events if what == "rocks over")
    near = 1e-5
    moved = slide(PAPER, state, friction, [0, t0 - near, t0 + near], edge=EDGE)
    assert [what for _, what in moved.events if what not in ("sticks", "slips")] == ["rocks over"]
    assert moved.supports == ((0.0, "stem"),)
    (before, after), turn = moved.omega[1:, 0], np.cos(np.diff(moved.phi[1:]))[0]
    assert turn == pytest.approx(-1)  # 1' turns round where the axis passes upright
    kept = (inertia - B * B) / (inertia + B * B)
    assert -after / before == pytest.approx(kept, abs=1e-4)
    drop = moved.energy[1] - moved.energy[2]
    assert drop == pytest.approx((inertia + B * B) * before**2 / 2 * (1 - kept**2), rel=1e-3)
    np.testing.assert_allclose(np.ptp(sum(moved.ledger)), 0, atol=1e-8)


def test_rocking_over_against_a_table_that_yields():
    state, friction = State(2.6, 0, 0, 0, vy=-1), SmoothedCoulomb(0.7, 0.1)
    times = np.linspace(0, 4, 41)
    moved = slide(PAPER, state, friction, times, edge=EDGE)
    assert moved.events[0][1] == "rocks over"
    np.testing.assert_allclose(moved.theta, yielding(PAPER, state, friction, times, EDGE)[0], rtol=0, atol=2e-4)


def test_a_wide_end_comes_down_and_stays():
    """b^2 > I1, no friction: the impulse at the far side turns it back; so it lies on all of its rim, and glides on."""
    top, edge = Top(0.1, 0.2, 0.3), (0.7, 1.0, 0.0)
    moved = slide(top, State(2.9, 0, 0, 0, vy=3.0), GREASED, np.linspace(0, 5, 51), edge=edge)
    assert moved.energy[-1] > 4 and moved.events[-1][1] == "stands upright"


@pytest.mark.parametrize("theta_dot", [0.4, -0.4])
def test_a_start_flat_on_the_end_leans_to_where_it_moves(theta_dot):
    """Both ways alike, and with no impact: the energy is the start's."""
    moved = slide(PAPER, State(np.pi, theta_dot, 0, 0), GREASED, np.linspace(0, 0.5, 6), edge=EDGE)
    assert moved.events == () and np.all(np.diff(moved.theta) < 0)
    flat = PAPER.I1 * theta_dot**2 / 2 + (B * theta_dot) ** 2 / 2 + H - (1 - PAPER.a)
    np.testing.assert_allclose(moved.energy, flat, rtol=0, atol=1e-8)


@pytest.mark.parametrize("lean", [0.0, 1e-8, 9e-7])
@pytest.mark.parametrize("spin", [2.0, -30.0])
@pytest.mark.parametrize("friction", [SmoothedCoulomb(0.3, 0.1), VISCOUS, Coulomb(0.3), GREASED])
def test_a_start_flat_on_the_end_with_a_spin_stands(friction, spin, lean):
    """All of the rim carries alike: neither weight nor friction has a side to tip it to. It rocked over 1000 times."""
    moved = slide(PAPER, State(np.pi - lean, 0, 0, spin), friction, np.linspace(0, 4, 41), edge=EDGE)
    ((t, what),) = moved.events
    assert what == "stands upright" and t < 1e-8 and moved.supports == ((0.0, "stem"),)
    heights = moved.com[:, 2] + [sb.edge(PAPER, *EDGE[:2])(axis)[2] for axis in matrices(moved)[:, :, 2]]
    np.testing.assert_allclose(heights, 0, atol=1e-9)
    np.testing.assert_allclose(sum(moved.ledger), PAPER.I3 * spin**2 / 2 + H - (1 - PAPER.a), rtol=0, atol=2e-7)


@pytest.mark.parametrize("share", [0.97, 1.03])
def test_a_start_flat_on_the_end_that_slides(share):
    """It trips over the leading rim where the torque of friction about G, mu H, is more than that of the weight, b."""
    state, friction = State(np.pi, 0, 0, 0, vx=1.0, vy=0.5), Coulomb(share * B / H)
    moved = slide(PAPER, state, friction, np.linspace(0, 1, 11), edge=EDGE)
    stands = [what for _, what in moved.events] == ["stands upright"]
    assert stands == (share < 1), moved.events
    if not stands:  # its bottom points where it came from, its upper end, against axis 3, ahead
        axis = matrices(moved)[3, :, 2]
        assert len(moved.t) == 11 and -axis[:2] @ [1.0, 0.5] > 0.99 * np.hypot(*axis[:2]) * np.hypot(1.0, 0.5) > 0
