"""roll() compared with itself: what a long run conserves, and symmetries of the motion."""

import numpy as np
import pytest
import rigid_body as rb
from cases import CASES, PAPER, POLES, Case
from high_precision import mp

from tippe_core import Constants, Rolling, State, Top, TopError, glide, roll

NUTATIONS = 50


def samples(period, nutations=NUTATIONS):
    """So many nutations, at instants of all phases."""
    return np.linspace(0, nutations * float(period), min(6 * nutations, 130) + 1)


LONG_RUN = {name: CASES[name] for name in ("K_J = 7", "K_R < 0", "past P", "large energy", "shallow well",
                                           "merged wells", "ordinary", "loaded", "ball", "nearly steady")}  # fmt: skip


def differentiation(t):
    """The matrix that gives the derivative, at the samples, of the polynomial through them (barycentric)."""
    t = t.astype(rb.LONG)
    gap = t[:, None] - t[None, :]
    np.fill_diagonal(gap, 1)
    scale = (t[-1] - t[0]) / 4
    weight = 1 / np.prod(gap / scale, axis=1)
    matrix = weight[None, :] / weight[:, None] / gap
    np.fill_diagonal(matrix, 0)
    np.fill_diagonal(matrix, -matrix.sum(axis=1))
    return matrix


def window(start, width, n=48):
    """Times near Chebyshev's over a window, each an exact float: the derivative must not see their rounding."""
    grain = 2.0**36
    return np.round((start + width / 2 * (1 - np.cos(np.pi * np.arange(n) / (n - 1)))) * grain) / grain


def constants_from_poses(top, t, quaternion):
    """Jellett, Routh and energy of each pose, with the angular velocity from the quaternion's derivative."""
    q, rate = quaternion.astype(rb.LONG).T, (differentiation(t) @ quaternion.astype(rb.LONG)).T
    spin = 2 * rb.product(np.stack([-q[0], -q[1], -q[2], q[3]]), rate)
    inner = slice(8, -8)  # next to the ends a derivative is mostly the rounding of its samples
    return [x[inner] for x in rb.constants(rb.Body.of(top), q.T, spin[:3].T)], spin[:3].T


def test_the_derivative_is_sharp_enough_to_judge():
    """On the rigid body's own poses, rounded to doubles, the recomputed constants keep to 1e-13."""
    times = window(3.0, 0.25)
    q, w = rb.euler_quaternion(0, 0.5, 0), rb.to_body(0, 1.0, 3.0, 8.8)
    motion = rb.integrate(rb.Body.of(PAPER), q, w, times)
    expected = rb.constants(rb.Body.of(PAPER), q, w)
    found, _ = constants_from_poses(PAPER, times, motion.quaternion.astype(float))
    for value, constant in zip(found, expected, strict=True):
        assert np.abs(value / constant - 1).max() < 1e-13


@pytest.mark.parametrize("nutation", [0, 10_000])
@pytest.mark.parametrize("case", LONG_RUN.values(), ids=LONG_RUN.keys())
def test_constants_are_kept(case, nutation):
    """Recomputed from poses and their time derivative: K_J, K_R and E to 1e-12 over 10,000 nutations."""
    period = float(case.period)
    fastest = np.abs(roll(case.top, case.constants, samples(period, 1), well=case.row).omega).max()
    times = window(nutation * period + 0.1 * period, min(0.6 * period, 6 / fastest))
    trajectory = roll(case.top, case.constants, np.append(0.0, times), well=case.row)
    found, _ = constants_from_poses(case.top, times, trajectory.quaternion[1:])
    expected = (case.K_J, case.K_R, case.constants.E)
    for name, value, constant in zip(("K_J", "K_R", "E"), found, expected, strict=True):
        np.testing.assert_allclose(value.astype(float), constant, rtol=1e-12, atol=0, err_msg=name)


@pytest.mark.parametrize("nutation", [0, 10_000])
def test_constants_are_kept_through_the_pole(nutation):
    case = POLES["P"]
    top, K_J, K_R, constants = case.top, case.K_J, case.K_R, case.constants
    period = Rolling(top, constants).period
    times = window((nutation - 0.15) * period if nutation else 0.85 * period, 0.3 * period)
    trajectory = roll(top, constants, np.append(0.0, times))
    found, _ = constants_from_poses(top, times, trajectory.quaternion[1:])
    for name, value, constant in zip(("K_J", "K_R", "E"), found, (K_J, K_R, constants.E), strict=True):
        np.testing.assert_allclose(value.astype(float), constant, rtol=1e-12, atol=0, err_msg=name)


@pytest.mark.parametrize("nutation", [0, 10_000])
def test_contact_point_runs_as_the_pose_rolls(nutation):
    """d(track)/dt = omega x z, both from derivatives of what is returned; far away a track has fewer digits."""
    case = CASES["K_J = 7"]
    period = float(case.period)
    times = window((nutation + 0.1) * period, 0.6 * period)
    trajectory = roll(case.top, case.constants, np.append(0.0, times))
    _, spin = constants_from_poses(case.top, times, trajectory.quaternion[1:])
    wx, wy, _ = rb.rotate(trajectory.quaternion[1:].T, spin.T)
    matrix = differentiation(times)
    velocity = matrix @ trajectory.contact[1:].astype(rb.LONG)
    # a unit in the last place of each sample, as the derivative magnifies it
    blur = np.spacing(np.abs(trajectory.contact).max()) * float(np.abs(matrix[8:-8]).sum(axis=1).max())
    expected = np.column_stack([wy, -wx])
    np.testing.assert_allclose(velocity[8:-8].astype(float), expected[8:-8].astype(float), rtol=0, atol=1e-12 + blur)


@pytest.mark.parametrize("case", CASES.values(), ids=CASES.keys())
def test_returned_constants_are_those_of_the_motion(case):
    """Trajectory's C_J, K_R and E agree with the vectors' of the returned pose and spin: (14), (25), (6)."""
    trajectory = roll(case.top, case.constants, samples(case.period, 3), well=case.row)
    omega = np.stack([rb.to_body(psi, *spins) for psi, spins in zip(trajectory.psi, trajectory.omega, strict=True)])
    jellett, routh, energy = rb.constants(rb.Body.of(case.top), trajectory.quaternion, omega)
    for found, vectors in ((trajectory.jellett / case.top.I1, jellett), (trajectory.routh, routh),
                           (trajectory.energy, energy)):  # fmt: skip
        np.testing.assert_allclose(found, vectors.astype(float), rtol=1e-12, atol=1e-12)


def test_equation_26_along_the_motion():
    """[(I3 - I1)(I3 + 1) - I3 a^2] w3^2 - 2 C_J w_z + I1 w_z^2 = const, Isaeva's form of Routh's constant."""
    for case in (CASES["K_J = 7"], CASES["ordinary"], CASES["merged wells"], CASES["loaded"]):
        a, I1, I3 = case.top.a, case.top.I1, case.top.I3
        trajectory = roll(case.top, case.constants, samples(case.period, 3), well=case.row)
        _, w2, w3 = trajectory.omega.T
        w_z = w3 * np.cos(trajectory.theta) + w2 * np.sin(trajectory.theta)
        value = ((I3 - I1) * (I3 + 1) - I3 * a**2) * w3**2 - 2 * trajectory.jellett * w_z + I1 * w_z**2
        size = np.abs(2 * trajectory.jellett * w_z).max() + np.abs(I1 * w_z**2).max() + I3 * np.abs(w3**2).max()
        assert np.ptp(value) < 1e-13 * size * (1 + a * a)
        assert np.ptp(w3) > 1e-3 * np.abs(w3).max()  # a motion in which the terms do vary


def test_angles_make_the_quaternion_and_are_continuous():
    case = CASES["large energy"]
    trajectory = roll(case.top, case.constants, np.linspace(0, 5 * float(case.period), 2001))
    built = np.stack([rb.euler_quaternion(*angles).astype(float)
                      for angles in zip(trajectory.phi, trajectory.theta, trajectory.psi, strict=True)])  # fmt: skip
    built *= np.sign((built * trajectory.quaternion).sum(axis=1))[:, None]
    np.testing.assert_allclose(trajectory.quaternion, built, rtol=0, atol=1e-12)
    for angle in (trajectory.phi, trajectory.psi):
        assert np.abs(np.diff(angle)).max() < 0.5
    assert (np.einsum("ij,ij->i", trajectory.quaternion[1:], trajectory.quaternion[:-1]) > 0).all()


def test_many_samples_are_the_same_as_few():
    """A time's pose does not depend on the other times, on their order, or on where the clock started."""
    case = CASES["K_J = 7"]
    times = np.linspace(0, 40, 1001)
    whole = roll(case.top, case.constants, times)
    order = np.concatenate([[0], np.random.default_rng(2).permutation(np.arange(1, 1001))])
    shuffled = roll(case.top, case.constants, times[order])
    np.testing.assert_allclose(shuffled.quaternion, whole.quaternion[order], rtol=0, atol=1e-14)
    one = roll(case.top, case.constants, times[[0, 700]])
    np.testing.assert_allclose(one.contact[1], whole.contact[700], rtol=0, atol=1e-13)
    later = roll(case.top, case.constants, times + 16)
    np.testing.assert_allclose(later.quaternion, whole.quaternion, rtol=0, atol=1e-12)
    np.testing.assert_array_equal(later.t, times + 16)
    fast = Rolling(case.top, case.constants).theta(times)
    np.testing.assert_allclose(fast, whole.theta, rtol=0, atol=1e-14)


def test_backwards_in_time():
    """Times before times[0] are the past: the rigid body from there arrives at the start."""
    case = CASES["K_J = 7"]
    trajectory = roll(case.top, case.constants, np.array([0.0, -3.0]), "outer")
    omega = rb.to_body(trajectory.psi[1], *trajectory.omega[1])
    motion = rb.integrate(rb.Body.of(case.top), trajectory.quaternion[1], omega, [-3.0, 0.0], trajectory.contact[1])
    q = motion.quaternion[-1].astype(float)
    np.testing.assert_allclose(q * np.sign(q @ trajectory.quaternion[0]), trajectory.quaternion[0], rtol=0, atol=1e-11)
    np.testing.assert_allclose(motion.contact[-1].astype(float), 0, rtol=0, atol=1e-11)


NEEDLES = Top(-2.138, 0.0316, 3.16e-8), Top(-2.1382383878657505, 0.031587264640263776, 3.1619859066805554e-08)


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("move", [lambda top, state: roll(top, None, [0, 1.0], state),
                                  lambda top, state: glide(top, state, [0, 1.0])])  # fmt: skip
@pytest.mark.parametrize("top", NEEDLES)
def test_a_start_that_cannot_be_resolved_is_told_of_the_start(move, top):
    """A needle upright but for 1e-9 rad; nobody gave an E."""
    with pytest.raises(TopError) as caught:
        move(top, State(1e-9, 0, 0, 2.0))
    assert (caught.value.name, caught.value.value) == ("theta", 1e-9)
    assert "change the start a little" in caught.value.remedy and "E" not in str(caught.value).split()


def test_constants_that_cannot_be_resolved_are_told_of_the_energy():
    with pytest.raises(TopError) as caught:
        roll(NEEDLES[0], Constants.from_state(NEEDLES[0], 1e-9, 0, 0, 2.0), [0, 1.0])
    assert caught.value.name == "E"


def test_case_periods_are_what_they_say():
    """The cases stay the hard ones they are meant to be."""
    assert CASES["a hair from P"].interval[0] < 1e-9
    assert CASES["past the equator"].interval[1] > mp.pi / 2
    assert len(CASES["shallow well"].curve.turning_points()) == 2
    assert len(CASES["just merged"].curve.turning_points()) == 1
    assert isinstance(CASES["ball"], Case)
