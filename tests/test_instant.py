"""One instant of the motion with friction: accelerations, forces, rates and the effect of an impulse, in each
combination of the contacts' modes, against Newton's and Euler's equations for a body in space, solved by LAPACK."""

from itertools import product as pairs

import numpy as np
import pytest
import rigid_body as rb
import sliding_body as sb
from cases import PAPER
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from tippe_core import Contensou, Coulomb, SmoothedCoulomb, Top, TruncatedSphere, Viscous
from tippe_core.motion import at, contacts, impact, implicit, preparing
from tippe_core.motion.dynamics import (
    SLOW,
    SLOW_ROLLING,
    STEADY,
    arrange,
    forces,
    from_direction,
    kinetic,
    rates,
    turning,
)
from tippe_core.motion.friction import push
from tippe_core.motion.records import BALL, MOTION, NO_ONE, OPEN, SLIP, STEM, STICK, new
from tippe_core.motion.stepper import at_share

EDGES = {"a rim": TruncatedSphere.paper().edge, "rounded": (0.3, 1.3, 0.1), "a ball": (0.0, 1.5, 0.2)}
LAWS = {"coulomb": Coulomb(0.3, 0.4), "viscous": Viscous(0.7), "smoothed": SmoothedCoulomb(0.2, 0.3),
        "patch": Contensou(0.3, 0.05), "patch without torque": Contensou(0.3, 0.05, pivots=False)}  # fmt: skip
LOSSES = (0.02, 0.03)
MODES = [modes for modes in pairs((OPEN, SLIP, STICK), repeat=2) if modes != (STICK, STICK)]
LEANING = Top(-0.4, 0.7, 0.3)  # on both contacts its centre is between them
TOPS = {"paper": PAPER, "leaning": LEANING}


class Instant:
    """A body in space at one instant, its contacts, and what slide() has of it."""

    def __init__(self, top, law, edge, on_both=False):
        self.top, self.friction, self.edge = top, law, edge
        self.P = preparing.problem(top, law, edge, LOSSES, 1e-9)
        self.C, draw = new(MOTION).contacts, np.random.default_rng(5)
        p = rb.euler_quaternion(0.4, self.touches(), 1.1).astype(float) if on_both else draw.normal(size=4)
        p /= np.linalg.norm(p)
        self.axis = sb.matrix(p)[:, 2]
        self.inertia = top.I1 * np.eye(3) + (top.I3 - top.I1) * np.outer(self.axis, self.axis)
        self.rho = [self.at(i, self.axis) for i in range(2)]
        self.w = 0.5 * (self.rho[STEM] - self.rho[BALL]) if on_both else draw.normal(size=3) * 2
        self.y = np.zeros(16)
        self.y[[at.PX, at.PY, at.PZ, at.PW]] = p
        self.y[[at.LX, at.LY, at.LZ]] = self.inertia @ self.w
        self.y[[at.VX, at.VY, at.VZ, at.Z]] = draw.normal(size=4) * [0.5, 0.5, 0.1, 0.1]
        turned, h = np.cross(self.w, self.axis), 1e-5
        self.rho_dot = [(self.at(i, self.axis + h * turned) - self.at(i, self.axis - h * turned)) / (2 * h)
                        for i in range(2)]  # fmt: skip

    def touches(self):
        """The tilt at which both are on the table."""

        def apart(theta):
            axis = np.array([np.sin(theta), 0.0, np.cos(theta)])
            return self.at(BALL, axis)[2] - self.at(STEM, axis)[2]

        return brentq(apart, 1.2, 3.0, xtol=1e-15)

    def at(self, i, axis):
        """From G to where contact i would touch."""
        if i == BALL:
            return sb.sphere(self.top)(axis)
        radius, height, rounding = self.edge
        return sb.edge(self.top, radius, height)(axis) - rounding * sb.UP

    def columns(self, i, mode, u, modes):
        """(force, torque about the contact, the condition that belongs to it) of each unknown at a contact."""
        w_h = np.append(self.w[:2], 0.0)
        rolls = -self.P.delta * w_h / np.hypot(np.hypot(*w_h[:2]), SLOW_ROLLING)
        if mode == SLIP:
            k, t = push(self.friction.law, float(u[:2] @ u[:2]), float(self.w[2]))
            yield np.array([-k * u[0], -k * u[1], 1.0]), rolls - t * sb.UP, 2
        if mode == STICK:
            yield sb.UP, rolls, 2
            yield np.eye(3)[0], np.zeros(3), 0
            yield np.eye(3)[1], np.zeros(3), 1
            if self.friction.law.pivots and OPEN in modes:
                yield np.zeros(3), sb.UP, 3

    def solve(self, modes, slip, height):
        """(w', v', F, M, the matrix of how each unknown changes each condition): what leaves the table or stays on it
        does so after the drift with which it begins has decayed as STEADY says. The least friction if it is not
        determined."""
        unknowns = [(i, *each) for i in range(2) for each in self.columns(i, modes[i], slip[i], modes)]
        inverse = np.linalg.inv(self.inertia)
        free = inverse @ (-np.cross(self.w, self.inertia @ self.w) - self.P.drag * self.w)
        matrix, right = np.zeros((len(unknowns), len(unknowns))), np.zeros(len(unknowns))

        def moves(w_dot, v_dot, i, part):
            return w_dot[2] if part == 3 else (v_dot + np.cross(w_dot, self.rho[i]))[part]

        for r, (i, _, _, part) in enumerate(unknowns):
            for c, (j, force, torque, _) in enumerate(unknowns):
                matrix[r, c] = moves(inverse @ (np.cross(self.rho[j], force) + torque), force, i, part)
            drift = STEADY * self.w[2] if part == 3 else 2 * STEADY * slip[i][part]
            drift += STEADY**2 * height[i] if part == 2 else 0.0
            swing = 0.0 if part == 3 else np.cross(self.w, self.rho_dot[i])[part]
            right[r] = -moves(free, -sb.UP, i, part) - swing - drift
        found = np.linalg.lstsq(matrix, right)[0] if unknowns else right
        F, M, w_dot, v_dot = np.zeros((2, 3)), np.zeros((2, 3)), free, -sb.UP
        for (i, force, torque, _), size in zip(unknowns, found, strict=True):
            F[i] += size * force
            M[i] += size * torque
        for i in range(2):
            w_dot, v_dot = w_dot + inverse @ (np.cross(self.rho[i], F[i]) + M[i]), v_dot + F[i]
        return w_dot, v_dot, F, M, matrix, [i for i, *_ in unknowns]


def near(found, expected, digits=1e-7):
    size = 1 + max(np.abs(expected).max(), np.abs(found).max())
    np.testing.assert_allclose(found, expected, rtol=0, atol=digits * size)


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("edge", EDGES)
@pytest.mark.parametrize("top", TOPS)
def test_forces_and_accelerations_in_all_modes(top, edge, law):
    here = Instant(TOPS[top], LAWS[law], EDGES[edge])
    P, C = here.P, here.C
    for modes in MODES:
        turn = arrange(here.y, NO_ONE, modes, P, C)
        near(turn[0], here.axis)
        near(turn[1], here.w)
        near(C.rho, here.rho)
        near(C.rho_dot, here.rho_dot)
        near(C.u, [C.G[:3] + np.cross(here.w, rho) for rho in here.rho])
        near(C.height, [C.G[3] + rho[2] for rho in here.rho])
        first = next((i for i in range(2) if modes[i] != OPEN), None)
        if first is not None:
            near([C.u[first, 2], C.height[first]], [0.0, 0.0], 1e-14)
        slip, height = C.u.copy(), C.height.copy()
        minor = forces(turn, modes, P, C)
        w_dot, v_dot, F, M, matrix, owners = here.solve(modes, slip, height)
        near(C.w_dot, w_dot)
        near(C.v_dot, v_dot)
        near(C.L_dot, here.inertia @ w_dot + np.cross(here.w, here.inertia @ here.w))
        near(C.F, F)
        near(C.M, M)
        slips = [r for r, i in enumerate(owners) if modes[i] == SLIP]
        minors = [matrix[r, r] for r in slips] + [np.linalg.det(matrix)] * (OPEN not in modes)
        assert minor == pytest.approx(minors[0] if len(owners) == 1 else min(1.0, *minors, 1.0), rel=1e-7)


@pytest.mark.parametrize("turn", [0.0, 0.4, 1.1])
def test_a_top_on_its_rounded_stem_is_near_its_limit_where_its_axis_is_nearly_vertical(turn):
    """There the contact goes round the stem; the limit is the sine of its tilt, whichever way it leans."""
    here = Instant(PAPER, LAWS["viscous"], EDGES["rounded"])
    here.y[[at.PX, at.PY, at.PZ, at.PW]] = rb.euler_quaternion(turn, np.pi - 0.01, 0.0).astype(float)
    here.y[[at.LX, at.LY, at.LZ]] = [0.0, 0.0, -1.0]
    forces(arrange(here.y, NO_ONE, (OPEN, SLIP), here.P, here.C), (OPEN, SLIP), here.P, here.C)
    assert contacts.margin(here.y, 9.0, (OPEN, SLIP), here.P, here.C) == pytest.approx(np.sin(0.01), rel=1e-6)


def holding(drag, mu_s):
    """Both contacts hold, and a torque, which drag may be, turns the top about the line between them."""
    here = Instant(LEANING, Coulomb(mu_s), EDGES["rounded"], on_both=True)
    C, modes, here.P.drag = here.C, (STICK, STICK), drag
    turn = arrange(here.y, NO_ONE, modes, here.P, C)
    near(C.u, np.zeros((2, 3)), 1e-12)
    near(C.height, [0.0, 0.0], 1e-12)
    assert forces(turn, modes, here.P, C) == 1.0
    w_dot, v_dot, F, M, *_ = here.solve(modes, 0 * C.u, 0 * C.height)
    near(C.M, M)
    near(C.w_dot, w_dot)
    near(C.v_dot, v_dot)
    return here, F


def test_two_contacts_that_hold_have_the_least_friction_between_them():
    here, F = holding(0.2, 0.4)
    assert (np.hypot(*F[:, :2].T) < 0.4 * F[:, 2]).all()
    near(here.C.F, F)


@pytest.mark.parametrize(("drag", "mu_s", "over"), [(0.2, 0.2, STEM), (-1.0, 0.402, BALL)])
def test_where_the_least_friction_is_too_much_for_one_contact_the_other_takes_what_is_more(drag, mu_s, over):
    """The nearest to the least with which it is not too much."""
    here, F = holding(drag, mu_s)
    needs = np.hypot(*F[:, :2].T) / F[:, 2]
    assert [need > mu_s for need in needs] == [i == over for i in range(2)]
    along = (here.rho[STEM] - here.rho[BALL])[:2]
    along /= np.linalg.norm(along)
    held = F[over, :2]
    ways = np.roots([1.0, 2 * held @ along, held @ held - (mu_s * F[over, 2]) ** 2])
    least = min(ways, key=abs)
    F[over, :2], F[1 - over, :2] = held + least * along, F[1 - over, :2] - least * along
    near(here.C.F, F)


@pytest.mark.parametrize("law", LAWS)
def test_rates_are_those_of_the_body_and_its_energy_is_heat(law):
    """With log|u| and the direction of a slip too, in place of the velocity."""
    here = Instant(LEANING, LAWS[law], EDGES["rounded"])
    P, C, y, out = here.P, here.C, here.y, np.zeros(16)
    for modes in ((SLIP, OPEN), (OPEN, SLIP), (SLIP, SLIP), (STICK, SLIP), (OPEN, OPEN)):
        for slowest in {NO_ONE, *(i for i in range(2) if modes[i] == SLIP)}:
            arrange(y, NO_ONE, modes, P, C)
            z, u, height = y.copy(), C.u.copy(), C.height.copy()
            if slowest != NO_ONE:
                z[at.LOG_U], z[at.BETA] = np.log(np.hypot(*u[slowest, :2])), np.arctan2(u[slowest, 1], u[slowest, 0])
            rates(z, slowest, modes, P, C, out)
            near(C.u, u)
            w_dot, v_dot, *_ = here.solve(modes, u, height)
            speeds = [np.hypot(np.hypot(*u[i, :2]), P.law.radius * here.w[2]) for i in range(2) if modes[i] == SLIP]
            g = np.prod([speed / (speed + SLOW) for speed in speeds]) if P.law.mu_s > 0 else 1.0
            dy = out / g
            p, p_dot = y[[at.PX, at.PY, at.PZ, at.PW]], dy[[at.PX, at.PY, at.PZ, at.PW]]
            frame = 2 * rb.product(p_dot, p * [-1, -1, -1, 1])
            near(frame, np.append(here.w - here.w @ here.axis * here.axis, 0.0))
            near(dy[at.CHI], here.w @ here.axis)
            near(dy[[at.LX, at.LY, at.LZ]], here.inertia @ w_dot + np.cross(here.w, here.inertia @ here.w))
            near(dy[[at.X, at.Y, at.Z, at.TIME, at.VZ]], [*C.G[[0, 1, 3 - 1]], 1.0, v_dot[2]])
            moved = C.G[:3] @ v_dot + here.w @ (here.inertia @ w_dot) + C.G[2]  # the energy of motion, and of height
            near(dy[at.HEAT], -moved)
            if slowest == NO_ONE:
                near(dy[[at.VX, at.VY]], v_dot[:2])
                continue
            rho, rho_dot = here.rho[slowest], here.rho_dot[slowest]
            u_dot = (v_dot + np.cross(w_dot, rho) + np.cross(here.w, rho_dot))[:2]
            slip = u[slowest, :2]
            near(dy[at.LOG_U], u_dot @ slip / (slip @ slip))
            near(dy[at.BETA], (slip[0] * u_dot[1] - slip[1] * u_dot[0]) / (slip @ slip))


def test_the_energy_of_motion():
    here = Instant(LEANING, LAWS["viscous"], EDGES["rounded"])
    v = here.y[[at.VX, at.VY, at.VZ]]
    found = kinetic(here.y, turning(here.y, here.P)[2], here.P)
    assert found == pytest.approx((here.w @ here.inertia @ here.w + v @ v) / 2, rel=1e-12)


# ---- an impulse ----


def effect(here, i, j):
    """(4, 4): how an impulse and an angular impulse about z at contact j change (u_i, w_z)."""
    inverse, found = np.linalg.inv(here.inertia), np.zeros((4, 4))
    for n in range(4):
        J = np.eye(4)[n]
        w = inverse @ (np.cross(here.rho[j], J[:3]) + J[3] * sb.UP)
        found[:, n] = [*(J[:3] + np.cross(w, here.rho[i])), w[2]]
    return found


def velocities(y, here):
    """v and w of a state whose orientation is that of here."""
    return y[[at.VX, at.VY, at.VZ]], np.linalg.solve(here.inertia, y[[at.LX, at.LY, at.LZ]])


def energy_of(y, here):
    v, w = velocities(y, here)
    return (v @ v + w @ here.inertia @ w) / 2


@pytest.mark.parametrize("top", TOPS)
def test_an_impulse_changes_momentum_and_what_it_takes_is_heat(top):
    here = Instant(TOPS[top], LAWS["patch"], EDGES["rounded"])
    P, C, y = here.P, here.C, here.y.copy()
    impact.moving(y, BALL, P, C)
    for i, j in pairs(range(2), repeat=2):
        near(impact.mobility(i, j, y, P, C), effect(here, i, j))
    J = np.array([0.3, -0.2, 0.5, 0.1])
    impact.give_impulse(y, STEM, J, P, C)
    (v, w), (v0, w0) = velocities(y, here), velocities(here.y, here)
    near(v - v0, J[:3])
    near(here.inertia @ (w - w0), np.cross(here.rho[STEM], J[:3]) + J[3] * sb.UP)
    near(y[at.HEAT], energy_of(here.y, here) - energy_of(y, here))


@pytest.mark.parametrize("law", ["coulomb", "patch", "patch without torque"])
@pytest.mark.parametrize("modes", [(STICK, OPEN), (OPEN, STICK), (STICK, SLIP), (SLIP, STICK)])
def test_a_halt_takes_the_rest_of_a_slip_and_leaves_the_other_contact_on_the_table(law, modes):
    here = Instant(LEANING, LAWS[law], EDGES["rounded"])
    P, C, y = here.P, here.C, here.y.copy()
    i = modes.index(STICK)
    impact.halted(y, modes, P, C)
    (v, w), (v0, w0) = velocities(y, here), velocities(here.y, here)
    near(v + np.cross(w, here.rho[i]), np.zeros(3))
    if P.law.pivots:
        near(w[2], 0.0)
    other = np.zeros(3)
    if SLIP in modes:
        near((v + np.cross(w, here.rho[1 - i]))[2], 0.0)
        # what is left of the angular momentum about contact i is due to a vertical impulse at the other
        apart, about = here.rho[1 - i] - here.rho[i], here.inertia @ (w - w0) - np.cross(here.rho[i], v - v0)
        push = np.cross(apart, sb.UP)
        other = about @ push / (push @ push) * push
        assert np.linalg.norm(other) > 1e-3
    turned = here.inertia @ (w - w0) - np.cross(here.rho[i], v - v0) - other
    near(turned[:2], np.zeros(2))
    if not P.law.pivots:
        near(turned[2], 0.0)
    near(y[at.HEAT], energy_of(here.y, here) - energy_of(y, here))


@pytest.mark.parametrize("law", ["coulomb", "patch", "patch without torque"])
def test_two_contacts_that_halt_together_rest(law):
    here = Instant(LEANING, LAWS[law], EDGES["rounded"], on_both=True)
    y = here.y.copy()
    y[[at.LX, at.LY, at.LZ]] += [0.2, -0.3, 0.1]
    begins = energy_of(y, here)
    impact.halted(y, (STICK, STICK), here.P, here.C)
    v, w = velocities(y, here)
    near([v + np.cross(w, rho) for rho in here.rho], np.zeros((2, 3)), 1e-12)
    near(y[at.HEAT], begins - energy_of(y, here))


IMPACTS = {
    "slips on": ([0.9, -0.4, -0.5, 0.0], "coulomb"),
    "slips on, smoothed": ([0.9, -0.4, -0.5, 3.0], "smoothed"),
    "a patch that slips and spins": ([0.3, 0.2, -0.4, 9.0], "patch"),
    "a patch without torque": ([0.3, 0.2, -0.4, 9.0], "patch without torque"),
}


@pytest.mark.parametrize("name", IMPACTS)
@pytest.mark.parametrize("contact", [BALL, STEM])
def test_an_impact_follows_the_law_of_friction_until_nothing_approaches(name, contact):
    """d(impulse)/dP = z - k u, with torque -t, until u_z = 0: by scipy."""
    start, law = IMPACTS[name]
    here = Instant(LEANING, LAWS[law], EDGES["rounded"])
    W, start, I = effect(here, contact, contact), np.array(start), new(MOTION).contacts.impact
    found = impact.impact(W, start, here.P.law, I)

    def grows(_, J):
        u = start + W @ J
        k, t = push(here.friction.law, float(u[0] ** 2 + u[1] ** 2), float(u[3]))
        return [-k * u[0], -k * u[1], 1.0, -t]

    def falls(_, J):
        return (start + W @ J)[2]

    falls.terminal = True
    moved = solve_ivp(grows, (0, 10), np.zeros(4), "DOP853", rtol=1e-12, atol=1e-14, events=falls)
    assert moved.status == 1 and np.hypot(*(start + W @ moved.y[:, -1])[:2]) > 0.02
    np.testing.assert_allclose(found, moved.y[:, -1], rtol=0, atol=1e-10)


@pytest.mark.parametrize("law", ["coulomb", "patch"])
def test_a_slip_that_an_impact_stops_is_held_to_its_end(law):
    here = Instant(LEANING, {"coulomb": Coulomb(0.6, 3.0), "patch": Contensou(2.0, 0.2)}[law], EDGES["rounded"])
    W, start = effect(here, BALL, BALL), np.array([0.05, -0.02, -2.0, 0.1])
    J = impact.impact(W, start, here.P.law, new(MOTION).contacts.impact)
    held = 4 if law == "patch" else 3
    near((start + W @ J)[:held], np.zeros(held), 1e-11)
    if law == "coulomb":
        assert J[3] == 0.0


# ---- an implicit step ----


def creeping(size=1.0):
    """A motion of a patch that hardly slips and hardly spins, before a step; its rates in time. size: of the slip."""
    here = Instant(LEANING, Contensou(0.3, 0.05), EDGES["rounded"])
    W, P = new(MOTION), here.P
    y = here.y.copy()
    y[[at.LX, at.LY, at.LZ]] = here.inertia @ (0.7 * np.cross(sb.UP, here.axis) + [0.0, 0.0, 2e-3 * size])
    W.y[:], W.modes[:], W.step.scale[:] = y, (SLIP, OPEN), 1e-9
    v_x, v_y = -np.cross(np.linalg.solve(here.inertia, y[[at.LX, at.LY, at.LZ]]), here.rho[BALL])[:2]
    W.y[[at.VX, at.VY]] = v_x + 3e-4 * size, v_y - 2e-4 * size
    W.y[at.VZ], W.y[at.Z] = -np.cross(np.linalg.solve(here.inertia, W.y[5:8]), here.rho[BALL])[2], -here.rho[BALL][2]
    W.step.z[:], W.creeps = W.y, BALL
    out = np.zeros(16)

    def rate(_, z):
        rates(z, NO_ONE, (SLIP, OPEN), P, W.contacts, out)
        return out / out[at.TIME]

    return W, P, rate


def directed(W, P, y):
    """The state with the direction and the size of the slip in it, in a unit that does not change."""
    W.step.z[:] = y
    implicit.to_direction(W, P)
    z = W.step.z.copy()
    z[at.SIGMA] *= W.step.unit
    return z


def test_a_state_comes_back_from_the_direction_of_its_slip():
    W, P, _ = creeping()
    z = directed(W, P, W.y)
    assert z[at.SIGMA] == pytest.approx(np.hypot(np.hypot(3e-4, 2e-4), 0.05 * 2e-3), rel=1e-9)
    near(z[[at.NX, at.NY, at.NZ]] * z[at.SIGMA], [3e-4, -2e-4, 1e-4], 1e-15)
    from_direction(W.step.z, BALL, W.step.unit, P, W.contacts)
    near(W.step.z, W.y, 1e-15)


def test_the_rates_and_the_jacobian_of_an_implicit_step():
    W, P, rate = creeping()
    change = 1e-7 * rate(0, W.y.copy())
    expected = (directed(W, P, W.y + change) - directed(W, P, W.y - change)) / 2e-7
    W.step.z[:] = W.y
    implicit.differentiate(W, P)
    S, beside, other = W.step, np.zeros(16), np.zeros(16)
    others = [i for i in range(16) if i not in (at.NX, at.NY, at.NZ, at.SIGMA, at.Z)]
    near(S.K[0][others], rate(0, W.y.copy())[others], 1e-12)
    near(S.K[0][[at.NX, at.NY, at.NZ]], expected[[at.NX, at.NY, at.NZ]], 1e-5)
    assert S.K[0, at.SIGMA] * S.unit == pytest.approx(expected[at.SIGMA], rel=1e-5)
    for n, i in enumerate(implicit.FEEDS):
        h = 1e-5 * np.eye(16)[i]
        implicit.creeping_rates(S.z + h, W, P, beside)
        implicit.creeping_rates(S.z - h, W, P, other)
        near(S.J[:, n], (beside - other) / 2e-5, 1e-3)
    for i in set(range(16)) - set(implicit.FEEDS):
        h = 1e-3 * np.eye(16)[i]
        implicit.creeping_rates(S.z + h, W, P, beside)
        implicit.creeping_rates(S.z - h, W, P, other)
        near(beside, other, 1e-10)


def test_when_a_slip_would_be_half_as_large():
    """As |s| of the body changes, where implicit steps are taken."""
    W, P, rate = creeping()
    W.step.new[:] = y = W.y.copy()
    dy = rate(0, y).copy()
    assert implicit.is_stiff(W, P, 0.1)
    size, change = (directed(W, P, y)[at.SIGMA] for y in (y, y + 1e-7 * dy))
    W.step.z[:] = y
    implicit.differentiate(W, P)
    assert implicit.until_half(W) == pytest.approx(0.5 * size / (size - change) * 1e-7, rel=1e-4)
    W.step.K[0, at.SIGMA] *= -1
    assert implicit.until_half(W) == np.inf


def test_a_stem_that_slips_while_the_ball_sticks_is_not_stiff():
    W, P, _ = creeping()
    W.step.new[:] = W.y
    rates(W.y, NO_ONE, (SLIP, OPEN), P, W.contacts, np.zeros(16))
    assert implicit.is_stiff(W, P, 1.0) and W.creeps == BALL
    assert not implicit.is_stiff(W, P, 1e-5)
    W.contacts.u[STEM], W.contacts.F[STEM] = [1e-4, 0.0, 0.0], [-0.3, 0.0, 1.0]
    W.modes[:] = OPEN, SLIP
    assert implicit.is_stiff(W, P, 1.0) and W.creeps == STEM
    W.modes[:] = STICK, SLIP
    assert not implicit.is_stiff(W, P, 1.0)


def test_an_implicit_step_and_its_polynomial_are_of_their_order():
    """Against scipy's DOP853; in a quarter of a step the error, and that of the estimate, are 4^5 times smaller at
    least, and those of the polynomial 4^4.5 times. (Below 1e-8 of the slip the difference quotients show: so at a
    larger slip than where such steps are taken; those are in test_creeping.py.)"""
    W, P, rate = creeping(10.0)
    S, errors, W.implicit = W.step, [], 1
    for h in (4e-3, 1e-3):
        S.z[:] = W.y
        implicit.differentiate(W, P)
        estimate, least = implicit.implicit_step(W, P, h)
        shares = np.array([0.3, 0.7, 1.0])
        exact = solve_ivp(rate, (0, h), W.y.copy(), "DOP853", h * shares, rtol=1e-13, atol=1e-16).y.T
        found = np.zeros((3, 16))
        for x, y in zip(shares[:2], found, strict=False):
            at_share(W, P, x, y)
        found[2] = S.new
        off = np.abs(found - exact)[:, :14].max(axis=1)
        errors.append([estimate, off[:2].max(), off[2]])
        assert least == pytest.approx(W.contacts.height[STEM], abs=3e-3)  # which is below the table here
    assert (np.divide(*errors) > [4**5, 4**4.5, 4**5]).all()
    assert (np.array(errors[1]) < [3.0, 1e-9, 1e-10]).all()
