"""One instant of the motion with friction: accelerations, forces, rates and the effect of an impulse, in each
combination of the contacts' modes, against Newton's and Euler's equations for a body in space, solved by LAPACK."""

from itertools import product as pairs

import numpy as np
import pytest
import rigid_body as rb
import sliding_body as sb
from cases import PAPER
from scipy.optimize import brentq

from tippe_core import Contensou, Coulomb, SmoothedCoulomb, Top, TruncatedSphere, Viscous
from tippe_core.motion import at, preparing
from tippe_core.motion.dynamics import SLOW, SLOW_ROLLING, STEADY, arrange, forces, kinetic, rates, turning
from tippe_core.motion.friction import push
from tippe_core.motion.records import BALL, MOTION, NO_ONE, OPEN, SLIP, STEM, STICK, new

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


@pytest.mark.parametrize(("drag", "mu_s", "over"), [(0.2, 0.2, STEM), (-1.0, 0.402, BALL), (0.2, 0.4, None)])
def test_two_contacts_that_hold_share_the_friction_between_them(drag, mu_s, over):
    """The least of it; where that is more than one contact has, the nearest to it with which it is not. Drag is any
    torque here."""
    here = Instant(LEANING, Coulomb(mu_s), EDGES["rounded"], on_both=True)
    C, modes, here.P.drag = here.C, (STICK, STICK), drag
    turn = arrange(here.y, NO_ONE, modes, here.P, C)
    near(C.u, np.zeros((2, 3)), 1e-12)
    near(C.height, [0.0, 0.0], 1e-12)
    assert forces(turn, modes, here.P, C) == 1.0
    w_dot, v_dot, F, M, *_ = here.solve(modes, 0 * C.u, 0 * C.height)
    needs = np.hypot(*F[:, :2].T) / F[:, 2]
    assert [need > mu_s for need in needs] == [i == over for i in range(2)]
    if over is not None:
        along = np.append(here.rho[STEM] - here.rho[BALL], 0.0)[:2]
        along /= np.linalg.norm(along)
        held = F[over, :2]
        ways = np.roots([1.0, 2 * held @ along, held @ held - (mu_s * F[over, 2]) ** 2])
        least = min(ways, key=abs)
        F[over, :2], F[1 - over, :2] = held + least * along, F[1 - over, :2] - least * along
    near(C.F, F)
    near(C.M, M)
    near(C.w_dot, w_dot)
    near(C.v_dot, v_dot)


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("modes", [(SLIP, OPEN), (OPEN, SLIP), (SLIP, SLIP), (STICK, SLIP), (OPEN, OPEN)])
def test_rates_are_those_of_the_body_and_its_energy_is_heat(law, modes):
    """With log|u| and the direction of a slip too, in place of the velocity."""
    here = Instant(LEANING, LAWS[law], EDGES["rounded"])
    P, C, y, out = here.P, here.C, here.y, np.zeros(16)
    for slowest in {NO_ONE, BALL if modes[BALL] == SLIP else STEM if modes[STEM] == SLIP else NO_ONE}:
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
