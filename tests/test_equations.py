"""The paper's equations one by one: (1) to (26) and (B1) to (B4) on returned motions differentiated numerically, (27)
to (29) as R -> 0, (30) to (39) at random states of the rigid body and in fifty digits."""

from functools import cache
from types import SimpleNamespace

import numpy as np
import pytest
import rigid_body as rb
import sliding_body as sb
from cases import CASES, LOADED, ORDINARY, PAPER, TOPS
from high_precision import Curve, mp, mpf
from scipy.integrate import quad
from scipy.optimize import brentq
from test_rolling import rolled as body_rolled
from test_rolling_long import differentiation, window

from tippe_core import (
    Constants,
    Gliding,
    Rolling,
    State,
    Top,
    Viscous,
    f,
    f1_squared,
    f2_squared,
    f3_squared,
    friction_force,
    normal_force,
    omega2,
    omega3,
)

MOTIONS = ["K_J = 7", "K_R < 0", "merged wells", "loaded", "ordinary"]
INNER = slice(8, -8)  # next to the ends a derivative is mostly the rounding of its samples
Z = np.array([0.0, 0.0, 1.0])


def dot(p, q):
    return (p * q).sum(axis=1)


def column(x):
    return x[:, None]


def vectors(top, motion):
    """What the equations are about, in space axes, row a time, and d/dt of any of it; from a Trajectory."""
    t = motion.t.astype(rb.LONG)
    matrix, q = differentiation(motion.t), motion.quaternion.astype(rb.LONG).T
    rate = 2 * rb.product(np.stack([-q[0], -q[1], -q[2], q[3]]), (matrix @ q.T).T)[:3]
    axis = rb.rotate(q, column(Z) * np.ones(len(t))).T
    across = np.cross(Z, axis)
    first = across / np.linalg.norm(across.astype(float), axis=1)[:, None]  # 1'
    second = np.cross(axis, first)
    w1, w2, w3 = motion.omega.astype(rb.LONG).T
    F = (
        column(motion.force[:, 0]) * first
        + column(motion.force[:, 1]) * np.cross(Z, first)
        + column(motion.force[:, 2]) * Z
    )
    contact = np.column_stack([motion.contact, np.zeros(len(t))]).astype(rb.LONG)
    return SimpleNamespace(
        a=top.a, I1=top.I1, I3=top.I3, dI=top.I3 - top.I1, d=lambda x: matrix @ x, axis=axis, first=first,
        second=second, omega=column(w1) * first + column(w2) * second + column(w3) * axis, w1=w1, w2=w2, w3=w3,
        turning=rb.rotate(q, rate).T, L=column(top.I1 * w1) * first + column(top.I1 * w2) * second
        + column(top.I3 * w3) * axis, L3=top.I3 * w3, r=motion.com - contact, com=motion.com.astype(rb.LONG), F=F,
        theta=motion.theta, s=np.sin(motion.theta), c=np.cos(motion.theta), motion=motion)  # fmt: skip


@cache
def rolled(name):
    case = CASES[name]
    period = float(case.period)
    rolling = Rolling(case.top, case.constants, well=case.row)
    fastest = np.abs(rolling(np.linspace(0, period, 7)).omega).max()
    return vectors(case.top, rolling(window(0.1 * period, min(0.6 * period, 6 / fastest)))), case


@pytest.fixture(params=MOTIONS)
def motion(request):
    return rolled(request.param)


def same(compare, row, left, right, within=1e-10, against="d/dt of the returned motion"):
    """left = right away from the ends of the window, in shares of their size."""
    left, right = np.broadcast_arrays(left, right)
    left, right = left[INNER], right[INNER]
    compare(row, left, right, within, against, scale=1 + float(max(np.abs(left).max(), np.abs(right).max())))


def test_equations_of_motion(motion, compare):
    m, _ = motion
    v = np.cross(m.omega, m.r)
    same(compare, "(1)", m.d(v), m.F - Z)
    same(compare, "(2)", m.d(m.L), -np.cross(m.r, m.F))
    same(compare, "(3)", m.r, Z - m.a * m.axis, 1e-13, "G and the contact point returned")
    same(compare, "(4)", m.d(m.com), np.cross(m.turning, m.r))
    same(compare, "(5)", m.L, m.I1 * m.turning + m.dI * column(m.w3) * m.axis)
    same(compare, "(15)", m.d(m.L), -np.cross(m.r, m.d(v) + Z))
    same(compare, "Fig. 2", m.d(m.com), v)
    resolved = np.column_stack([dot(m.r, axis) for axis in (m.first, m.second, m.axis)])
    same(compare, "Fig. 3", resolved, np.column_stack([0 * m.s, m.s, m.c - m.a]), 1e-13, "vectors in space")


def test_jellett(motion, compare):
    m, case = motion
    r_dot, dL = m.d(m.r), m.d(m.L)
    size = np.linalg.norm(m.L.astype(float), axis=1).max() * (1 + abs(m.a))
    C_J = m.I1 * case.K_J
    same(compare, "(7)", dot(dL, m.r) / size, 0)
    same(compare, "(8)", dot(m.L, r_dot) / size, 0)
    same(compare, "(9)", m.d(dot(m.L, m.r)) / size, 0)
    same(compare, "(10)", dot(m.L, m.r), C_J, 1e-13, "I1 K_J given")
    same(compare, "(11)", r_dot, -m.a * np.cross(m.turning, m.axis))
    along = dot(m.I1 * m.turning + m.dI * column(m.w3) * m.axis, np.cross(m.turning, m.axis))
    same(compare, "(12)", dot(m.L, r_dot), -m.a * along)
    same(compare, "(13)", m.L[:, 2] - m.a * m.L3, C_J, 1e-13, "I1 K_J given")
    same(compare, "(14)", m.motion.jellett, dot(m.L, m.r), 1e-13, "L . r from vectors")


def test_derivation_of_the_routh_constant(motion, compare):
    m, case = motion
    I1, I3, dI, a, w3 = m.I1, m.I3, m.dI, m.a, m.w3
    omega_dot, w3_dot, v_dot = m.d(m.omega), m.d(w3), m.d(np.cross(m.omega, m.r))
    r3, across, theta_dot = dot(m.r, m.axis), m.s, m.d(m.theta)
    axis_z, carried = np.cross(m.axis, Z), np.cross(m.axis, v_dot)
    lean = dot(m.turning, axis_z)
    same(compare, "(16)", I3 * w3_dot, dot(carried, m.r))
    turned = column(r3) * omega_dot - column(w3_dot) * m.r + a * column(w3) * np.cross(m.turning, m.axis)
    same(compare, "(17)", carried, turned)
    r2 = dot(m.r, m.r)
    same(compare, "(18)", dot(carried, m.r), r3 * dot(omega_dot, m.r) - r2 * w3_dot + a * w3 * lean)
    same(compare, "(19)", m.d(m.L), I1 * omega_dot + dI * (column(w3_dot) * m.axis + column(w3) * m.d(m.axis)))
    same(compare, "(20)", I1 * dot(omega_dot, m.r) + dI * (r3 * w3_dot + w3 * lean), 0)
    ratio = dI / I1
    right = -ratio * r3**2 * w3_dot - ratio * r3 * w3 * lean - r2 * w3_dot + a * w3 * lean
    same(compare, "(21)", I3 * w3_dot, right)
    g, tipping = I3 / I1, w3**2 * theta_dot * m.s
    falling = -g * r3**2 * w3 * w3_dot - across**2 * w3 * w3_dot
    same(compare, "(22)", I3 * w3 * w3_dot, falling + (g - 1) * r3 * tipping - a * tipping)
    printed = falling - (g - 1) * r3 * tipping + a * tipping
    off = np.abs(I3 * w3 * w3_dot - printed)[INNER].max()
    assert off > 1e-3 * np.abs(I3 * w3 * w3_dot)[INNER].max()  # the signs of the page hold on no motion
    turning = -g * r3 * m.d(r3) * w3**2 - across * m.d(across) * w3**2
    same(compare, "(23)", I3 * w3 * w3_dot, falling + turning)
    half = (I3 + across**2 + g * r3**2) * w3**2 / 2
    same(compare, "(24)", m.d(half) / half.max(), 0)
    same(compare, "(25)", half, case.K_R**2 / 2, 1e-13, "K_R given")
    same(compare, "(25)", m.motion.routh, case.K_R, 1e-13, "K_R given")
    # (26) has the value that the turning point in fifty digits gives it
    inner = case.interval[0]
    w3_inner, w2_inner = case.curve.omega3(inner), case.curve.omega2(inner)

    def isaeva(w3, w_z, C_J):
        return ((I3 - I1) * (I3 + 1) - I3 * a**2) * w3**2 - 2 * C_J * w_z + I1 * w_z**2

    expected = isaeva(w3_inner, w3_inner * mp.cos(inner) + w2_inner * mp.sin(inner), I1 * case.K_J)
    size = float(abs(I3 * w3_inner**2) * (1 + a * a) + abs(expected))
    value = isaeva(w3, m.omega[:, 2], m.motion.jellett)
    compare("(26)", value[INNER], float(expected), 1e-12, "the turning point in fifty digits", scale=size)
    I_eff = I1 * m.s**2 + I3 * (m.c - a) ** 2
    same(compare, "Routh by I_eff", (I1 * I3 + I_eff) * w3**2 / 2, I1 * case.K_R**2 / 2, 1e-13, "K_R given")


def test_energy(motion, compare):
    m, case = motion
    v = m.d(m.com)
    by_vectors = (dot(m.turning, m.L) + dot(v, v)) / 2 + (m.com[:, 2] - (1 - m.a))
    same(compare, "(6)", by_vectors, case.constants.E)
    same(compare, "(6)", m.motion.energy, case.constants.E, 1e-13, "E given")


@pytest.mark.parametrize("name", MOTIONS)
def test_the_rigid_body_moves_the_same_way(name, compare):
    case, against = CASES[name], "Newton's and Euler's equations with the rolling constraint, 10 nutations"
    times = np.linspace(0, 10 * case.period, 31)
    found = Rolling(case.top, case.constants, well=case.row)(times)
    body = body_rolled(case.top, found.quaternion[0], rb.to_body(found.psi[0], *found.omega[0]), times)
    q = body.quaternion.astype(float)
    q *= np.sign((q * found.quaternion).sum(axis=1))[:, None]
    compare("rigid body", found.quaternion, q, 1e-9, against)
    compare("rigid body", found.contact, body.contact, 1e-9, against, scale=1 + np.abs(found.contact).max())
    compare("rigid body", found.force[:, 2], body.force[:, 2], 1e-9, against, scale=1 + np.abs(found.force).max())


# ---- (27) to (29): the peg shrinks to a point ----


def sharpened(R):
    """A top of mass 1 whose G is 1 above the tip, moments 0.3 and 0.2, peg of radius R: in units of R."""
    return Top(a=-1 / R, I1=0.3 / R**2, I3=0.2 / R**2)


def test_small_peg(compare):
    """Angular momenta in units of M, the distance |a| of G and g: L = R^(3/2) of those in units of R."""
    theta = np.linspace(0.3, 1.1, 9)
    errors = {row: [] for row in ("(27)", "(28)", "(29)")}
    for R in (1e-3, 5e-4):
        top = sharpened(R)
        state = 0.7, 0.0, 2.0 * R**0.5, 40.0 * R**0.5
        constants = Constants.from_state(top, *state)
        w3, w2 = omega3(theta, top, constants), omega2(theta, top, constants)
        L3, s, c = 0.2 * w3 / R**0.5, np.sin(theta), np.cos(theta)
        L_z = L3 * c + 0.3 * w2 / R**0.5 * s
        a, I1 = -1.0, 0.3
        first_order = 1 + a * R * c / (I1 + a * a)
        errors["(27)"].append(np.ptp(L3 / first_order))
        errors["(28)"].append(np.ptp(L_z - a * a * c / (I1 + a * a) * L3))
        r = np.stack([0 * s, s, c - top.a]) * R
        spin = np.stack([0 * s, w2, w3]) / R**0.5
        carried = rb.cross(r, rb.cross(spin, r))
        errors["(29)"].append(np.ptp(L_z + carried[1] * s + carried[2] * c))
    for row, order in (("(27)", 2), ("(28)", 1), ("(29)", 1)):
        coarse, fine = errors[row]
        compare(row, coarse / fine, 2**order, 0.02, f"order of what is left: R^{order}, R halved")


def test_pointed_top_is_lagranges(compare):
    """theta of L_3, L_Z conserved about a fixed tip, and its period by quadrature; Richardson in R."""
    I, I3, L3, theta0 = 0.3 + 1.0, 0.2, 4.0, 0.7
    L_Z = L3 * np.cos(theta0) + I * np.sin(theta0) * 2.0

    def theta_dot_squared(theta):
        s, c = np.sin(theta), np.cos(theta)
        bend = 2.0**2 * I - (L_Z - L3 * c) ** 2 / (I * s * s)
        return (bend + 2 * (np.cos(theta0) - c)) / I

    grid = np.linspace(0.2, 1.4, 4001)
    inside = grid[theta_dot_squared(grid) > 0]
    step = grid[1] - grid[0]
    low = brentq(theta_dot_squared, inside[0] - step, inside[0]) if inside[0] < 0.699 else theta0
    high = brentq(theta_dot_squared, inside[-1], inside[-1] + step) if inside[-1] > 0.701 else theta0
    half, middle = (high - low) / 2, (high + low) / 2
    expected = 2 * quad(lambda x: half * np.cos(x) / np.sqrt(theta_dot_squared(middle + half * np.sin(x))),
                        -np.pi / 2, np.pi / 2, epsabs=1e-10)[0]  # fmt: skip
    periods = []
    for R in (2e-4, 1e-4):
        state = State(theta0, 0.0, 2.0 * R**0.5, L3 / I3 * R**0.5)
        periods.append(Rolling(sharpened(R), None, state).period * R**0.5)
    compare("(29)", 2 * periods[1] - periods[0], expected, 1e-6, "period of Lagrange's top by quadrature")


# ---- (30) to (39) at random states ----


@pytest.mark.parametrize("top", TOPS.values(), ids=TOPS.keys())
def test_functions_of_theta_at_random_states(top, compare):
    rng = np.random.default_rng(11)
    body = rb.Body.of(top)
    vectorial, digits = "vectors of the rigid body", "fifty digits"
    for _ in range(40):
        theta, w1 = rng.uniform(0.05, np.pi - 0.05), rng.uniform(0.3, 4)
        w2, w3 = rng.normal(scale=4, size=2)
        K_J, K_R, E = rb.constants(body, rb.euler_quaternion(0.4, theta, -2), rb.to_body(-2, w1, w2, w3))
        constants = Constants.from_state(top, theta, w1, w2, w3)
        size = 1 + float(abs(K_J) + abs(K_R))
        compare("(30)", constants.K_J, K_J, 1e-14, vectorial, scale=size)
        compare("(30)", omega2(theta, top, constants), w2, 1e-14, vectorial, scale=size / np.sin(theta))
        compare("(31)", constants.K_R, K_R, 1e-14, vectorial, scale=size)
        compare("(31)", omega3(theta, top, constants), w3, 1e-14, vectorial, scale=size)
        f1, f2 = f1_squared(theta, top), f2_squared(theta, top)
        right = 2 * top.a * (1 - np.cos(theta)) + f2 * w2**2 + f1 * w1**2
        energies = 1 + float(abs(E) + K_R**2 + top.I1 / top.I3 * K_J**2)
        compare("(33)", constants.two_E_prime(top), right, 1e-14, vectorial, scale=energies)
        curve = Curve(top, 0, 0)
        compare("(35)", f1, float(curve.f1_squared(mpf(theta))), 1e-15, digits, scale=(1 + abs(top.a)) ** 2 + top.I1)
        compare("(34)", f2, float(curve.f2_squared(mpf(theta))), 1e-15, digits, scale=(1 + abs(top.a)) ** 2 + top.I1)
        f3 = f3_squared(theta, top)
        compare("(32)", f3, float(curve.f3(mpf(theta)) ** 2), 1e-15, digits, scale=f3)
        blur = energies / f1 / np.sin(theta)
        compare("(36)", f(theta, top, constants), w1**2, 1e-14, vectorial, scale=blur)
        F = rb.force_at(body, theta, w1, w2, w3)
        found = [*friction_force(theta, top, constants), normal_force(theta, top, constants)]
        size = 1 + (1 + abs(top.a)) * (w1**2 + w2**2 + w3**2) / np.sin(theta)
        for row, got, expected in zip(("(38)", "(39)", "(37)"), found, F, strict=True):
            compare(row, got, expected, 1e-12, "Newton's and Euler's equations of the rigid body", scale=size)


# ---- appendix B ----

GLIDES = [(PAPER, State(0.8, 0.3, 1.5, 4.0, 0.4, -0.3, 0.2, 0.1, 0.3, -0.5)),
          (LOADED, State(0.9, 0.2, -0.5, 4.0, vx=0.2)), (Top(-2.0, 3.0, 1.0), State(0.5, 0.1, 0.3, 8.0, vy=0.1)),
          (ORDINARY, State(0.4, 0.1, 0.1, 5.0))]  # fmt: skip


@pytest.mark.parametrize(("top", "state"), GLIDES)
def test_smooth_plane(top, state, compare):
    gliding = Gliding(top, state)
    fastest = np.abs(gliding(np.linspace(0, gliding.period, 7)).omega).max()
    m = vectors(top, gliding(window(0.0, min(0.6 * gliding.period, 6 / fastest))))
    v, E = m.d(m.com), m.motion.energy
    same(compare, "(B1)", m.d(m.L), -np.cross(m.r, m.F))
    same(compare, "(B1)", m.d(v), m.F - Z, 1e-8)
    half = (dot(m.turning, m.L) + dot(v, v)) / 2 + m.com[:, 2] - (1 - top.a)
    same(compare, "(B2)", half, half[20])
    same(compare, "(B2)", half, E, against="Trajectory.energy")
    changing = (top.I1 * (m.w1**2 + m.w2**2) + v[:, 2] ** 2) / 2 + m.com[:, 2]
    same(compare, "(B3)", changing, changing[20])
    same(compare, "(B4)", m.L[:, 2], top.I3 * m.w3 * m.c + top.I1 * m.w2 * m.s, 1e-13, "vectors in space")
    same(compare, "(B4)", m.L[:, 2], m.L[20, 2], 1e-13, "its value at another instant")
    # the single variable: theta_dot^2 by (B3) and (B4), with (B4)'s omega_2'
    L_z, L3 = float(m.L[20, 2]), top.I3 * state.omega3
    w2 = (L_z - L3 * m.c) / (top.I1 * m.s)
    f_B = (2 * (changing[20] - m.com[:, 2]) - top.I1 * w2**2) / (top.I1 + (top.a * m.s) ** 2)
    same(compare, "(B4)", m.d(m.axis[:, 2]) ** 2, m.s**2 * f_B)  # in cos(theta), smooth next to the pole too
    five = np.column_stack([v[:, 0], v[:, 1], m.L3, m.L[:, 2], half])
    same(compare, "five constants", five, five[20])


# from a turning point with both other zeros of the cubic on one side of it, the farther one out of reach
FROM_REST = [(LOADED, State(0.49, 0.0, -0.8, 0.3)), (Top(-2.0, 3.0, 1.0), State(2.77, 0.0, 0.76, 1.84))]


@pytest.mark.parametrize(("top", "state"), GLIDES + FROM_REST)
def test_smooth_plane_in_space(top, state, compare):
    times = np.linspace(0, 8, 9)
    body = sb.stored(top, Viscous(0.0), *sb.first_instant(top, state), times, rtol=1e-13)
    found = Gliding(top, state)(times)
    q = body.quaternion / np.linalg.norm(body.quaternion, axis=1)[:, None]
    q *= np.sign((q * found.quaternion).sum(axis=1))[:, None]
    compare("(B1)", found.quaternion, q, 2e-10, "a rigid body in space (DOP853)")
    compare("five constants", found.com, body.com, 2e-10, "a rigid body in space (DOP853)", scale=1 + abs(top.a))
