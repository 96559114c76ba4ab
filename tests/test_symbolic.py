"""Lagrange's equations, derived by sympy from the kinetic and potential energy alone, against roll(), glide(), slide().

Coordinates x, y of O, phi, theta, psi; rolling is the pair of conditions that the contact point is at rest, with
Lagrange's multipliers, which are the friction force. Nothing of the paper's is used.
"""

from functools import cache

import numpy as np
import pytest
import sympy as sp
from cases import TOPS
from sympy.physics.mechanics import LagrangesMethod, dynamicsymbols
from test_rolling_long import differentiation, window

from tippe_core import Constants, Rolling, State, Viscous, f, friction_force, glide, normal_force, slide

AGAINST = "sympy: Lagrange's equations with multipliers"


@cache
def equations():
    """(rolling, pushed): functions of (a, I1, I3, q (5), q' (5)[, F_x, F_y]) -> matrix, right side of M q'' = ..."""
    t = dynamicsymbols._t
    q = x, y, phi, theta, psi = dynamicsymbols("x y phi theta psi")
    a, I1, I3, Fx, Fy = sp.symbols("a I1 I3 F_x F_y")
    s, c = sp.sin(theta), sp.cos(theta)
    axis = sp.Matrix([sp.sin(phi) * s, -sp.cos(phi) * s, c])
    nodes = sp.Matrix([sp.cos(phi), sp.sin(phi), 0])
    omega = theta.diff(t) * nodes + phi.diff(t) * sp.Matrix([0, 0, 1]) + psi.diff(t) * axis
    G = sp.Matrix([x, y, 1]) - a * axis
    v, w3 = G.diff(t), phi.diff(t) * c + psi.diff(t)
    energy = (v.dot(v) + I1 * (theta.diff(t) ** 2 + (phi.diff(t) * s) ** 2) + I3 * w3**2) / 2
    lagrangian = energy - G[2]
    contact = sp.Matrix([x, y, 1]).diff(t) + omega.cross(sp.Matrix([0, 0, -1]))
    rates = [z.diff(t) for z in q]
    plain = {**dict(zip(q, sp.symbols("q:5"), strict=True)), **dict(zip(rates, sp.symbols("u:5"), strict=True))}
    names = [a, I1, I3, *sp.symbols("q:5"), *sp.symbols("u:5")]

    def function(method, extra):
        method.form_lagranges_equations()
        matrices = [m.subs({r: plain[r] for r in rates}).subs({z: plain[z] for z in q})
                    for m in (method.mass_matrix_full, method.forcing_full)]  # fmt: skip
        return sp.lambdify([*names, *extra], matrices, "numpy", cse=True)

    rolling = function(LagrangesMethod(lagrangian, q, nonhol_coneqs=list(contact[:2])), [])
    virtual = contact[0] * Fx + contact[1] * Fy  # the power of the force
    forces = [virtual.diff(r) for r in rates]
    method = LagrangesMethod(lagrangian, q)
    method.form_lagranges_equations()
    mass, forcing = (m.subs({r: plain[r] for r in rates}).subs({z: plain[z] for z in q})
                     for m in (method.mass_matrix, method.forcing))  # fmt: skip
    Q = sp.Matrix(forces).subs({r: plain[r] for r in rates}).subs({z: plain[z] for z in q})
    return rolling, sp.lambdify([*names, Fx, Fy], [mass, forcing + Q], "numpy", cse=True)


def coordinates(motion, i):
    """q and q' of sample i; phi = 0 is as good as any, and O's velocity is G's plus omega x a 3."""
    theta, (w1, w2, w3) = motion.theta[i], motion.omega[i]
    s, c, a = np.sin(theta), np.cos(theta), motion.top.a
    phi_dot = w2 / s
    ux, uy = motion.slip[i]
    # O's velocity along x = 1' and y: the slip, and omega x z of the rolling contact
    vx, vy = ux + w2 * c - w3 * s, uy - w1
    return (motion.top.a, motion.top.I1, motion.top.I3, 0, 0, 0, theta, 0), (vx, vy, phi_dot, w1, w3 - phi_dot * c), a


def spin_rates(theta, rates, accelerations):
    """d/dt of w1, w2, w3 from q' and q''."""
    s, c, w1 = np.sin(theta), np.cos(theta), rates[3]
    phi_dot, (_, _, phi_2, theta_2, psi_2) = rates[2], accelerations
    return np.array([theta_2, phi_2 * s + phi_dot * c * w1, psi_2 + phi_2 * c - phi_dot * s * w1])


def symbolic(motion, i, push=None):
    """(w', F_x, F_y, F_z) of sample i; push: the horizontal force, None when the top rolls."""
    place, rates, a = coordinates(motion, i)
    rolling, pushed = equations()
    if push is None:
        matrix, right = rolling(*place, *rates)
        solved = np.linalg.solve(np.array(matrix, float), np.array(right, float).ravel())
        accelerations, push = solved[5:10], solved[10:]
    else:
        matrix, right = pushed(*place, *rates, *push)
        accelerations = np.linalg.solve(np.array(matrix, float), np.array(right, float).ravel())
    theta, w1 = place[6], rates[3]
    F_z = 1 + a * (np.sin(theta) * accelerations[3] + np.cos(theta) * w1**2)  # M z_G'' + Mg
    return spin_rates(theta, rates, accelerations), (*push, F_z)


def random_states(seed, n):
    rng = np.random.default_rng(seed)
    for _ in range(n):
        yield State(rng.uniform(0.3, 2.8), rng.uniform(0.3, 2), rng.normal(scale=2), rng.normal(scale=5))


def assert_same(compare, motion, push=None):
    """On a short window of the motion: d/dt of the spins, and the contact force returned."""
    slope = differentiation(motion.t) @ motion.omega
    for i in (12, 24, 35):
        rates, force = symbolic(motion, i, push and motion.force[i, :2])
        size = 1 + np.abs(rates).max() + np.abs(motion.omega[i]).max() ** 2
        compare("Lagrange", slope[i], rates, 1e-10, AGAINST, scale=size)
        compare("Lagrange", motion.force[i], force, 1e-10, AGAINST, scale=size * (1 + abs(motion.top.a)))


@pytest.mark.slow
@pytest.mark.parametrize("top", TOPS.values(), ids=TOPS.keys())
def test_rolling(top, compare):
    for state in random_states(21, 6):
        constants = Constants.from_state(top, state.theta, state.theta_dot, state.omega2, state.omega3)
        times = window(0.0, 0.1 / (1 + abs(state.omega2) + abs(state.omega3)))
        motion = Rolling(top, None, state)(times)
        assert_same(compare, motion)
        # the functions of theta themselves, at the state
        _, force = symbolic(motion, 0)
        size = (1 + abs(top.a)) * (1 + state.theta_dot**2 + state.omega2**2 + state.omega3**2) / np.sin(state.theta)
        found = [*friction_force(state.theta, top, constants), normal_force(state.theta, top, constants)]
        for row, got, expected in zip(("(38)", "(39)", "(37)"), found, force, strict=True):
            compare(row, got, expected, 1e-10, AGAINST, scale=size)
        # (36): theta'' = f'/2, with f' by differences of f
        h = 1e-3
        sample = f(state.theta + h * np.array([-3, -2, -1, 1, 2, 3]), top, constants)
        slope = np.array([-1, 9, -45, 45, -9, 1]) @ sample / (60 * h)
        compare("(36)", slope / 2, symbolic(motion, 0)[0][0], 1e-10, AGAINST, scale=100 * size)


@pytest.mark.parametrize("top", TOPS.values(), ids=TOPS.keys())
def test_viscous_friction(top, compare):
    stayed = 0
    for state in random_states(22, 10):
        times = window(0.0, 0.1 / (1 + abs(state.omega2) + abs(state.omega3)))
        motion = slide(top, state, Viscous(0.3), times, rtol=1e-13)
        if not motion.events:  # on the table
            assert_same(compare, motion, "push")
            stayed += 1
    assert stayed >= 3


@pytest.mark.parametrize("top", TOPS.values(), ids=TOPS.keys())
def test_smooth_plane(top, compare):
    stayed = 0
    for state in random_states(23, 6):
        times = window(0.0, 0.1 / (1 + abs(state.omega2) + abs(state.omega3)))
        motion = glide(top, state, times)
        if not motion.events:
            assert_same(compare, motion, "push")
            stayed += 1
    assert stayed >= 3
