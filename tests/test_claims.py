"""What the paper says in words: figures 1 and 4, section VI, notes 57 and 58."""

import numpy as np
import pytest
import rigid_body as rb
from cases import CASES, PAPER, TOPS
from high_precision import Curve, mp, mpf
from scipy.optimize import minimize_scalar

from tippe_core import (
    Constants,
    Coulomb,
    Rolling,
    SmoothedCoulomb,
    State,
    Viscous,
    f,
    friction_force,
    jellett_potential,
    lift_off_and_slip_tielines,
    normal_force,
    pole_constants,
    roll,
    slide,
    steady_precessions,
    tielines,
)

P = pole_constants(PAPER, 10.0)[0]
MANY_K_J = np.linspace(0.0, P * (1 - 1e-6), 60)


@pytest.fixture(scope="module")
def turning_over():
    """The reference inversion: theta = 0.1, w3 = 8.8, smoothed Coulomb friction mu = 0.3, eps = 1, until inverted."""
    return slide(PAPER, State(0.1, 0, 0, 8.8), SmoothedCoulomb(0.3, 1.0), np.linspace(0, 300, 30001), rtol=1e-11)


def test_the_top_turns_over(turning_over, compare):
    """Fig. 1: upright and spinning, at last inverted, G higher by nearly 2a, spinning the other way about its axis."""
    m = turning_over
    end = "the reference motion, to its last digit"
    compare("Fig. 1", np.cos(m.theta[-1]), -0.99947, 0.5e-5, end)
    compare("Fig. 1", m.omega[-1, 2], -7.6113, 0.5e-4, end)
    rise = m.com[-1, 2] - m.com[0, 2]
    compare("Fig. 1", rise, PAPER.a * (np.cos(0.1) + 0.99947), 1e-6, "G's height 1 - a cos(theta)")
    w_z = m.omega[:, 2] * np.cos(m.theta) + m.omega[:, 1] * np.sin(m.theta)
    assert w_z.min() > 0  # about the vertical it turns the same way all the time (note 33)


def test_sign_of_omega_3(turning_over, compare):
    """Rolling keeps it on every motion; sliding brings it through zero."""
    for name in ("K_J = 7", "K_R < 0", "loaded", "ordinary", "merged wells"):
        case = CASES[name]
        motion = roll(case.top, case.constants, np.linspace(0, 3 * case.period, 200), well=case.row)
        compare("sign of omega_3", np.sign(motion.omega[:, 2]), np.sign(case.K_R), 0, "the sign of K_R")
        body = rb.integrate(
            rb.Body.of(case.top),
            motion.quaternion[0],
            rb.to_body(motion.psi[0], *motion.omega[0]),
            [0.0, case.period / 3, case.period / 2],
        )
        signs = np.sign(body.omega_body[:, 2].astype(float))
        compare("sign of omega_3", signs, np.sign(case.K_R), 0, "the rigid body in space")
    signs = np.sign(turning_over.omega[:, 2])
    compare("sign of omega_3", [signs[0], signs[-1], (np.diff(signs) != 0).sum()], [1, -1, 1], 0, "sliding: Fig. 1")


@pytest.mark.parametrize("friction", [SmoothedCoulomb(0.3, 1.0), Viscous(0.3), Coulomb(0.2)], ids=repr)
def test_jellett_is_kept_and_routh_is_not(friction, compare):
    motion = slide(PAPER, State(1.2, 0.5, -1.0, 6.0, vx=8.0, vy=9.0), friction, np.linspace(0, 10, 201), rtol=1e-12)
    compare("Jellett with sliding", motion.jellett / motion.jellett[0], 1, 1e-10, "its value at the start")
    assert np.ptp(motion.routh) > 1e-2


def test_torques_of_the_friction_force(turning_over, compare):
    """Fig. 4: L_z' = F_1' a_perp, L_3' = F_1' r_perp, so L_z'/L_3' = a/R; by differences of the returned motion."""
    m, h = turning_over, turning_over.t[1]
    s, c = np.sin(m.theta), np.cos(m.theta)
    L3 = PAPER.I3 * m.omega[:, 2]
    L_z = L3 * c + PAPER.I1 * m.omega[:, 1] * s

    def rate(x):  # sixth order
        return (45 * (x[4:-2] - x[2:-4]) - 9 * (x[5:-1] - x[1:-5]) + (x[6:] - x[:-6])) / (60 * h)

    push = m.force[3:-3, 0]
    compare("Fig. 4", rate(L3), push * s[3:-3], 1e-7, "d/dt of the returned motion")
    compare("Fig. 4", rate(L_z), push * PAPER.a * s[3:-3], 1e-7, "d/dt of the returned motion")


def test_note_57(turning_over, compare):
    """When friction has brought L_3 to 0, L_z is 1 - a/R = 93 % of what it was, and theta about 90 degrees."""
    m = turning_over
    L3 = m.omega[:, 2] * PAPER.I3
    L_z = L3 * np.cos(m.theta) + PAPER.I1 * m.omega[:, 1] * np.sin(m.theta)
    k = int(np.argmax(L3 < 0))
    share = L3[k - 1] / (L3[k - 1] - L3[k])
    left = L_z[k - 1] + share * (L_z[k] - L_z[k - 1])
    compare("93 %", left / L_z[0], 0.93, 0.005, "the paper, half its last digit")
    compare("93 %", left, L_z[0] - PAPER.a * L3[0], 1e-6, "(13) from the start")
    degrees = np.degrees(m.theta[k])
    compare("about 90 deg", degrees, 90, 5, "the paper, “about”")


@pytest.mark.parametrize("top", TOPS.values(), ids=TOPS.keys())
def test_gallops_minimum(top, compare):
    """Least rotational energy at theta and J, by minimising over omega, with L . r = J as vectors."""
    body = rb.Body.of(top)
    for theta in (0.2, 1.0, 1.9, 2.9):
        s, c, J = np.sin(theta), np.cos(theta), 1.7
        q = rb.euler_quaternion(0, theta, 0)
        J2, J3 = (top.I1 * float(rb.constants(body, q, rb.to_body(0, 0, *w))[0]) for w in ((1, 0), (0, 1)))

        def spins(x, J2=J2, J3=J3, J=J):  # all with L . r = J: the shortest, and along the line
            return (J * np.array([J2, J3]) + x * np.array([-J3, J2])) / (J2**2 + J3**2)

        def energy(x, spins=spins):
            w2, w3 = spins(x)
            return (top.I1 * w2**2 + top.I3 * w3**2) / 2

        best = minimize_scalar(energy, bracket=(-1, 1), tol=1e-14)
        gallop = jellett_potential(theta, top, J) - top.a * (1 - c)
        compare("Gallop's minimum", gallop, best.fun, 1e-12, "the least over omega, numerically", scale=1 + best.fun)
        w2, w3 = spins(best.x)
        lean = (w2 * (c - top.a) - w3 * s) / np.hypot(w2, w3) / np.hypot(s, c - top.a)
        compare("rotation about r", lean, 0, 1e-6, "the omega of the minimum found")
        r = np.array([0, s, c - top.a])
        I_r = r @ np.diag([top.I1, top.I1, top.I3]) @ r / (r @ r)
        compare("rotation about r", J**2 / (2 * gallop), (r @ r) * I_r, 1e-12, "r . I r", scale=(r @ r) * I_r)


# ---- Figs. 5 and 6 ----


def test_where_the_verge_is(compare):
    """F_z = 0 at the outer turning point, F_h = mu_s F_z for small K_J before it."""
    lift, slip = lift_off_and_slip_tielines(PAPER, MANY_K_J, 10.0, 0.5)
    compare("lift-off at the outer turning point", lift.theta_verge, lift.theta_outer, 1e-10, "the turning point of f")
    apart = slip.theta_outer - slip.theta_verge
    assert apart.max() > 0.01 and apart.min() > -1e-10 and (apart < 1e-10).any()
    K_J = np.array([1.0, 3.0, 5.0, 6.0, 8.0])
    found = tielines(PAPER, K_J, 10.0, 0.5)
    before = (found.theta_outer - found.theta_verge > 1e-3).astype(float)
    compare("verge off the turning point", before, [1, 1, 1, 0, 0], 0, "the table of test_paper.py")
    for K, E, verge, row in zip(MANY_K_J, slip.E, slip.theta_verge, turning(slip), strict=True):
        theta = np.linspace(*row, 4001)
        share = ratio(theta, Constants(K, 10.0, E))
        compare("mu_s = 0.5", np.nanmax(share), 0.5, 1e-5, "the largest on a grid of 4,001 points")
        at = ratio(verge, Constants(K, 10.0, E))
        assert np.isnan(at) or abs(at - 0.5) < 1e-6
        assert abs(theta[np.nanargmax(share)] - verge) < 3 * (theta[1] - theta[0])


def turning(lines):
    return np.transpose([lines.theta_inner, lines.theta_outer])


def ratio(theta, constants):
    """F_h/F_z; where rounding makes f negative at a turning point, with F_x = 0."""
    x, y = friction_force(theta, PAPER, constants)
    return np.hypot(np.nan_to_num(x), y) / normal_force(theta, PAPER, constants)


def test_friction_leaves_less(compare):
    """A considerable fraction of the trajectories of Fig. 5 slips, and the others have a smaller range."""
    lift, slip = lift_off_and_slip_tielines(PAPER, MANY_K_J, 10.0, 0.5)
    assert (slip.theta_inner >= lift.theta_inner - 1e-12).all() and (slip.theta_outer < lift.theta_outer).all()
    areas = [np.trapezoid(lines.theta_outer - lines.theta_inner, MANY_K_J) for lines in (slip, lift)]
    table = np.array([[0, 1.3085, 1.6943, 1.3383, 1.6637], [1, 1.1960, 1.5787, 1.2210, 1.5519],
                      [2, 1.0797, 1.4646, 1.1023, 1.4393], [3, 0.9578, 1.3508, 0.9804, 1.3242],
                      [4, 0.8274, 1.2365, 0.8529, 1.2043], [5, 0.6844, 1.1207, 0.7165, 1.0764],
                      [6, 0.5220, 1.0040, 0.5654, 0.9350], [7, 0.3294, 0.8907, 0.3839, 0.7754],
                      [8, 0.0945, 0.7991, 0.1328, 0.5837], [8.3651, 0, 0.7789, 0, 0.4998]])  # fmt: skip
    K = table[:, 0]
    expected = np.trapezoid(table[:, 4] - table[:, 3], K) / np.trapezoid(table[:, 2] - table[:, 1], K)
    compare("a considerable fraction", areas[0] / areas[1], expected, 0.01, "the ten tielines of test_paper.py")
    assert 0.1 < 1 - areas[0] / areas[1] < 0.5


def test_barrier_at_P(compare):
    """[...]^2 goes as theta^4 at P: halving theta divides it by 16, and f is finite; off P f falls without end."""
    curve = Curve(PAPER, 0, 10)
    exact = Curve(PAPER, -curve.bracket(mpf(0)), 10)
    fall = [float(exact.bracket(mpf(x)) ** 2) for x in (1e-3, 5e-4)]
    compare("barrier at P", fall[0] / fall[1], 16, 1e-4, "[...] in fifty digits, theta halved")
    at, beside = Constants(P, 10.0, 26.0), Constants(P - 1e-3, 10.0, 26.0)
    heights = f(np.array([1e-3, 1e-6, 1e-9]), PAPER, at)
    expected = [float(Curve(PAPER, exact.K_J, 10, 26).f(mpf(x))) for x in (1e-3, 1e-6, 1e-9)]
    compare("barrier at P", heights, expected, 1e-11, "f in fifty digits", scale=abs(expected[0]))
    assert f(1e-6, PAPER, beside) < -1e5


def test_peaks_of_the_curves_are_stable(compare):
    for K in MANY_K_J[::6]:
        theta, stable = steady_precessions(PAPER, K, 10.0)
        assert list(stable) == [True]
        curve = Curve(PAPER, K, 10.0)
        curve = curve.at(curve.energy_of(curve.U(mpf(theta[0]))))
        slope, bend = (mp.diff(curve.f, mpf(theta[0]), n) for n in (1, 2))
        assert bend < 0
        compare("peaks are stable", float(slope / bend), 0, 1e-11, "f' in fifty digits: distance to its zero")
        period = Rolling(PAPER, Constants(K, 10.0, float(curve.E) + 1e-9)).period
        small = 2 * np.pi / float(mp.sqrt(-bend / 2))
        compare("small motion", period / small, 1, 1e-6, "f'' in fifty digits")


def test_no_transition_without_slipping(compare):
    """From near 0 to near pi: [...] would have to nearly vanish at both poles, which needs two different K_J."""
    north, south = pole_constants(PAPER, 10.0)
    curve = Curve(PAPER, 0, 10)
    compare("no transition", [north, south], [-float(curve.bracket(x)) for x in (mpf(0), mp.pi)], 1e-14, "fifty digits")
    assert north * south < 0
    lines = tielines(PAPER, np.linspace(south, north, 201), 10.0)
    assert set(lines.limited_by) == {"lift-off"}
    assert not np.any((lines.theta_inner < 0.5) & (lines.theta_outer > np.pi / 2))
    assert not np.any((lines.theta_inner < np.pi / 2) & (lines.theta_outer > np.pi - 0.5))


def test_time_by_quadrature(compare):
    for name in ("K_J = 7", "deep well", "ordinary"):
        case = CASES[name]
        theta, t = case.third
        found = Rolling(case.top, case.constants, well=case.row).theta(np.array([0.0, float(t)]))[1]
        compare("t by quadrature", found, float(theta), 1e-13, "the integral in fifty digits")
