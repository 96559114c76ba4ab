"""Random states from a Sobol sequence over the whole range of the sliders (a from -10, which can be typed): each
quantity that tippe_core returns for a state, its constants or its time is compared with the paper's formulas in fifty
digits, in which the given floats are taken as exact. An error is given twice: relative to the value itself, and
relative to the largest of the terms that the paper's formula adds up (for an angle, to pi). Where a sum of large
terms passes through zero only the second can be small, because there the last digit of any term is larger than the
value.
"""

import numpy as np
from high_precision import Curve, mp, mpf
from scipy.stats import qmc

from tippe_core import (
    Constants,
    Rolling,
    State,
    Top,
    TopError,
    f,
    friction_force,
    normal_force,
    omega2,
    omega3,
    steady_precessions,
    turning_points,
)

MANY, FEW = 2**14, 2**6
PERIODS = 8  # one in this many states has its period, phi and psi integrated, because fifty digits are slow
LEAST = [-10.0, 0.05, 0.025, 0.0, -8.0, -8.0, -16.0]
MOST = [0.5, 2.0, 2.0, np.pi, 8.0, 8.0, 16.0]


def states(n):
    """n pairs of Top and State: a, I1, I3/I1, theta, theta_dot, omega2, omega3."""
    points = qmc.scale(qmc.Sobol(7, seed=2000).random(n), LEAST, MOST)
    for k, (a, I1, ratio, theta, *spins) in enumerate(points.tolist()):
        if k % 2:
            a = (a + 10) / 10.5 * 2.5 - 2  # every second one within the range of the slider
        yield Top(a, I1, ratio * I1), State(theta, *spins)


def forces(curve, theta, f_value):
    """(37), (38), (39) and the largest term of each."""
    s, c = mp.sin(theta), mp.cos(theta)
    B, g = curve.bracket(theta), curve.I3 / curve.I1
    f1, f2, f3 = curve.f1_squared(theta), curve.f2_squared(theta), curve.f3(theta)
    # f' with the product rule of (36)
    dB = g * s * curve.K_R * (curve.I3 + 1 - curve.a * c) / f3**3
    df2 = 2 * s * c * curve.I1 / curve.I3 - 2 * (c - curve.a) * s
    terms = [-2 * curve.a * s, -df2 * (B / s) ** 2, -2 * f2 * B * dB / s**2, 2 * f2 * B * B * c / s**3,
             -2 * curve.a * s * f_value]  # fmt: skip
    slope, size = sum(terms) / f1, max(map(abs, terms)) / f1
    w2, w3 = B / s, curve.K_R / f3
    Fz = 1 + curve.a * (s * slope / 2 + c * f_value)
    z_size = max(1, abs(curve.a) * s * size, abs(curve.a * f_value))
    w1 = mp.sqrt(f_value) if f_value > 0 else mp.nan
    Fx = -curve.I3 * curve.K_R * w1 / f3**3 * (c - g * (c - curve.a))
    parts = [curve.a * s * Fz, curve.I1 * slope / 2, -curve.I1 * c / s * w2**2, curve.I3 * w2 * w3]
    lever = 1 - curve.a * c
    y_size = max(abs(curve.a) * s * z_size, curve.I1 * size, *map(abs, parts)) / min(1, abs(lever))
    return (Fx, abs(Fx)), (sum(parts) / lever, y_size), (Fz, z_size)


def of_the_constants(top, state):
    """quantity -> (found, exact, size) for functions of theta and the constants, which are floats taken as exact."""
    constants = Constants.from_state(top, state.theta, state.theta_dot, state.omega2, state.omega3)
    curve, theta = Curve(top, constants.K_J, constants.K_R, constants.E), mpf(state.theta)
    s = mp.sin(theta)
    exact_f, w2 = curve.f(theta), curve.omega2(theta)
    f1 = curve.f1_squared(theta)
    bracket_size = abs(curve.K_J) + abs(curve.bracket(theta) - curve.K_J)
    w2_size = bracket_size / s
    f_size = max(abs(curve.e), abs(2 * curve.a), curve.f2_squared(theta) * w2_size**2) / f1
    Fx, Fy, Fz = forces(curve, theta, exact_f)
    wide = w2_size**2 * curve.f2_squared(theta) * (1 + abs(curve.a)) / (f1 * s)
    found_x, found_y = friction_force(state.theta, top, constants)
    yield "f", float(f(state.theta, top, constants)), exact_f, f_size
    yield "omega_2'", float(omega2(state.theta, top, constants)), w2, w2_size
    yield "omega_3", float(omega3(state.theta, top, constants)), curve.omega3(theta), abs(curve.omega3(theta))
    yield "F_x", float(found_x), Fx[0], Fx[1] * max(1, f_size / abs(exact_f))
    yield "F_y", float(found_y), Fy[0], max(Fy[1], wide)
    yield "F_z", float(normal_force(state.theta, top, constants)), Fz[0], max(Fz[1], wide)


def of_the_state(top, state):
    """The constants of a state, from floats taken as exact."""
    theta, w1, w2, w3 = map(mpf, (state.theta, state.theta_dot, state.omega2, state.omega3))
    found = Constants.from_state(top, state.theta, state.theta_dot, state.omega2, state.omega3)
    exact = Curve(top, 0, 0)
    s, c, f3 = mp.sin(theta), mp.cos(theta), exact.f3(theta)
    first, second = s * w2, exact.I3 / exact.I1 * (c - exact.a) * w3
    yield "K_J", found.K_J, first + second, max(abs(first), abs(second))
    yield "K_R", found.K_R, f3 * w3, abs(f3 * w3)
    v2 = (w2 * (c - exact.a) - w3 * s) ** 2 + w1**2 * (1 + exact.a**2 - 2 * exact.a * c)
    kinetic = (exact.I1 * (w1**2 + w2**2) + exact.I3 * w3**2 + v2) / 2
    E = kinetic + exact.a * (1 - c)
    yield "E", found.E, E, max(kinetic, abs(exact.a))
    K_J, K_R = first + second, f3 * w3
    curve = Curve(top, K_J, K_R, E)
    rolling = Rolling(top, None, state)
    for name, place in zip(("inner turning point", "outer turning point"), rolling.turning_points, strict=True):
        yield name, place, zero_next_to(curve, place), mp.pi


def zero_next_to(curve, theta):
    """The zero of f in fifty digits that Newton's steps reach from a float that should be it."""
    x = mpf(theta)
    for _ in range(8):
        h = mpf(10) ** -25 * min(x, mp.pi - x)
        here, beside = curve.f(x), curve.f(x + h)
        step = here * h / (beside - here)
        x -= step
        if abs(step) < mpf(10) ** -30 * x:
            break
    return x


def of_the_well(top, state):
    """Steady precessions, turning points and the period of the float constants."""
    constants = Constants.from_state(top, state.theta, state.theta_dot, state.omega2, state.omega3)
    curve = Curve(top, constants.K_J, constants.K_R, constants.E)
    for theta in steady_precessions(top, constants.K_J, constants.K_R).theta:
        x = mpf(float(theta))
        for _ in range(6):
            first, second = (mp.diff(curve.U, x, n) for n in (1, 2))
            x -= first / second
            if abs(first / second) < mpf(10) ** -22:
                break
        yield "steady precession", float(theta), x, mp.pi
    rows = turning_points(top, constants)
    well = int(np.argmax([inner - 1e-9 <= state.theta <= outer + 1e-9 for inner, outer in rows]))
    rolling = Rolling(top, constants, well=well)
    inner, outer = (zero_next_to(curve, x) for x in rows[well])
    times = integrals(curve, inner, outer)
    if times is None:
        return
    for name, found, exact in zip(
        ("period", "advance of phi", "advance of psi"),
        (rolling.period, rolling.phi_advance, rolling.psi_advance),
        times,
        strict=True,
    ):
        yield name, found, exact, abs(exact) if name == "period" else max(2 * mp.pi, abs(exact))


def integrals(curve, inner, outer):
    """(period, phi, psi) of one nutation by the midpoint rule in kappa, doubled until thirty digits stand still."""

    def rates(kappa):
        c1, c2 = mp.cos(inner), mp.cos(outer)
        c = (c1 + c2) / 2 + (c1 - c2) / 2 * mp.cos(kappa)
        theta = mp.acos(c)
        s = mp.sin(theta)
        h = (c1 - c2) / 2 * mp.sin(kappa) / (s * mp.sqrt(curve.f(theta)))
        phi = curve.omega2(theta) / s
        return h, h * phi, h * (curve.omega3(theta) - phi * c)

    before, n = None, 16
    with mp.workdps(40):
        while n <= 1024:
            rows = [rates(mp.pi * (k + mpf("0.5")) / n) for k in range(n)]
            now = [2 * mp.pi / n * sum(column) for column in zip(*rows, strict=True)]
            if before and all(abs(x - y) < mpf(10) ** -15 * max(1, abs(x)) for x, y in zip(now, before, strict=True)):
                return now
            before, n = now, 2 * n
    return None


def errors(n):
    """quantity -> list of (share of the value, share of the terms); and how often a TopError or nan was the answer."""
    found, said = {}, {}
    for k, (top, state) in enumerate(states(n)):
        parts = (of_the_state, of_the_constants, of_the_well) if k % PERIODS == 0 else (of_the_state, of_the_constants)
        for part in parts:
            try:
                rows = list(part(top, state))
            except TopError as error:
                said[error.name] = said.get(error.name, 0) + 1
                continue
            for name, value, exact, size in rows:
                if np.isnan(value):
                    said[name] = said.get(name, 0) + 1
                    continue
                off = abs(mpf(value) - exact)
                found.setdefault(name, []).append((float(off / abs(exact)), float(off / size)))
    return {name: np.array(rows) for name, rows in found.items()}, said


def report(n):
    found, said = errors(n)
    yield (f"{n:,} states; the period and what follows it for every {PERIODS}th of them, where 1,024 nodes settle the "
           "reference itself.\n")  # fmt: skip
    yield "| quantity | values | share of itself: median | worst | beyond 1e-9 | share of the terms: median | worst |"
    yield "|---|---|---|---|---|---|---|"
    for name, rows in found.items():
        own, terms = rows.T
        yield (f"| {name} | {len(rows):,} | {np.median(own):.1e} | {own.max():.1e} | {(own > 1e-9).sum()} "
               f"| {np.median(terms):.1e} | {terms.max():.1e} |")  # fmt: skip
    yield "\nAnswered by nan or a TopError: " + (", ".join(f"{k} {v} times" for k, v in said.items()) or "none") + "."
