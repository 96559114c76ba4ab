"""A Scene, whose numbers are those of tippe_core: planes, limits and frames for the pictures."""

import numpy as np
import pytest

import app.model.bodies
import app.model.explorer
import app.model.frames
import app.model.region
import app.model.scene
from app.model.regimes import ROLLS
from app.model.scene import Marks
from tippe_core import (
    Ball,
    Constants,
    OrdinaryTop,
    Rolling,
    Top,
    TruncatedSphere,
    ball,
    friction_force,
    limit_energy,
    normal_force,
    omega2,
    omega3,
    roll,
    steady_precessions,
    tielines,
    turning_points,
)

# Tielines of the paper's top at K_R = 10: K_J, 2E' (F_z), inner, outer, 2E' (mu_s = 0.5), inner, outer, verge.
TABLE = np.array(
    [
        [0, 4.03286, 1.3085, 1.6943, 2.88682, 1.3383, 1.6637, 1.6478],
        [1, 3.99619, 1.1960, 1.5787, 2.99743, 1.2210, 1.5519, 1.5323],
        [2, 4.06714, 1.0797, 1.4646, 3.12279, 1.1023, 1.4393, 1.4181],
        [3, 4.26842, 0.9578, 1.3508, 3.26472, 0.9804, 1.3242, 1.3035],
        [4, 4.65286, 0.8274, 1.2365, 3.42535, 0.8529, 1.2043, 1.1870],
        [5, 5.33490, 0.6844, 1.1207, 3.60713, 0.7165, 1.0764, 1.0664],
        [6, 6.58010, 0.5220, 1.0040, 3.82036, 0.5654, 0.9350, 0.9350],
        [7, 9.08885, 0.3294, 0.8907, 4.30872, 0.3839, 0.7754, 0.7754],
        [8, 14.86605, 0.0945, 0.7991, 5.78017, 0.1328, 0.5837, 0.5837],
    ]
)


def test_fig_6_of_the_first_visit_is_the_papers_table(explorer):
    plane = explorer.scene.plane
    rows = np.searchsorted(plane.K_J, TABLE[:, 0])
    assert np.array_equal(plane.K_J[rows], TABLE[:, 0])
    shown = np.column_stack(
        [
            plane.lift.theta_inner,
            plane.lift.theta_outer,
            plane.slip.theta_inner,
            plane.slip.theta_outer,
            plane.slip.theta_verge,
        ]
    )[rows]
    assert shown == pytest.approx(TABLE[:, [2, 3, 5, 6, 7]], abs=5e-5)
    for tie, column in ((plane.lift, 1), (plane.slip, 4)):
        two_E_prime = Constants(plane.K_J, 10.0, tie.E).two_E_prime(Top.paper())
        assert two_E_prime[rows] == pytest.approx(TABLE[:, column], abs=5e-6)


def test_fig_5_ends_at_the_papers_point_P(explorer):
    plane = explorer.scene.plane
    assert plane.pole == pytest.approx(8.36508, abs=5e-6)
    assert plane.pole_height == pytest.approx(18.574, abs=5e-4)
    assert plane.K_J[-1] == plane.pole
    assert np.all(plane.height[:-1, [0, -1]] < 1e-9 * plane.height.max())


@pytest.mark.parametrize(
    "inputs",
    [
        {},
        {"K_J": 3.0, "K_R": 6.0},
        {"K_J": 12.0},
        {"upper": False, "K_J": -5.0},
        {"a": -1.5, "I1": 3.0, "I3": 0.5, "K_J": 0.5},
    ],
)
def test_the_numbers_are_tippe_cores(explorer, inputs):
    explorer.set(**inputs)
    scene = explorer.scene
    assert not scene.messages
    slip = limit_energy(scene.top, explorer.K_J, explorer.K_R, explorer.mu_s)
    steady = tielines(scene.top, [explorer.K_J], explorer.K_R).E_steady[0]
    if np.isfinite(slip):
        assert scene.constants.E == pytest.approx(steady + explorer.energy * (slip - steady), rel=1e-12)
    wells = turning_points(scene.top, scene.constants)
    well = int(np.flatnonzero((wells == scene.turning).all(axis=1))[0])
    expected = roll(scene.top, scene.constants, scene.trajectory.t, well=well)
    assert np.array_equal(scene.trajectory.quaternion, expected.quaternion)
    assert np.array_equal(scene.trajectory.theta, expected.theta)


def test_vectors_along_the_axes_of_space(explorer):
    """Checked by the motion itself: the velocity of G is omega x r, and Newton's law gives the force."""
    scene = explorer.scene
    motion = scene.trajectory
    step = motion.t[1] - motion.t[0]
    r = motion.com - np.column_stack([motion.contact, np.zeros(len(motion.t))])
    velocity = np.cross(scene.omega, r)
    middle = (motion.com[2:] - motion.com[:-2]) / (2 * step)
    assert velocity[1:-1] == pytest.approx(middle, abs=50 * step**2)
    acceleration = (velocity[2:] - velocity[:-2]) / (2 * step)
    assert acceleration + np.array([0, 0, 1]) == pytest.approx(scene.force[1:-1], abs=500 * step**2)
    torque = np.cross(-r, scene.force)[1:-1]
    assert (scene.momentum[2:] - scene.momentum[:-2]) / (2 * step) == pytest.approx(torque, abs=500 * step**2)


def test_a_uniform_ball_is_limited_by_nothing(explorer):
    explorer.set(a=0.0, I1=0.4, I3=0.4)
    assert not explorer.scene.messages
    assert any("Nothing limits" in note for note in explorer.scene.notes)


def test_hover_knows_the_whole_plane(explorer):
    """On a tieline its own energy; at its end, where the top turns, the same from both sides."""
    plane = explorer.scene.plane
    assert np.isfinite(plane.hover_E).all()
    assert plane.hover_E.shape == plane.hover_ratio.shape == (len(plane.hover_K_J), len(plane.hover_theta))
    for j, K_J in enumerate(plane.hover_K_J):
        row = int(np.flatnonzero(plane.K_J == K_J)[0])
        inside = (plane.hover_theta > plane.slip.theta_inner[row]) & (plane.hover_theta < plane.slip.theta_outer[row])
        assert plane.hover_E[j, inside] == pytest.approx(plane.slip.E[row], rel=1e-12)
        assert np.all(plane.hover_ratio[j, inside] <= 0.5 + 1e-9)
        assert np.all(plane.hover_E[j, ~inside] > plane.slip.E[row])
    step = plane.theta_range[1] / len(plane.hover_theta)  # each the middle of its column of the picture
    assert plane.hover_theta[[0, -1]] == pytest.approx([step / 2, plane.theta_range[1] - step / 2])
    assert np.nanmax(plane.lift.theta_outer) < plane.theta_range[1]
    row, column = np.unravel_index(np.argmin(np.abs(plane.hover_ratio - 0.4)), plane.hover_ratio.shape)
    top, constants = Top.paper(), Constants(plane.hover_K_J[row], 10.0, plane.hover_E[row, column])
    theta = plane.hover_theta[column]
    ratio = np.hypot(*friction_force(theta, top, constants)) / normal_force(theta, top, constants)
    assert plane.hover_ratio[row, column] == pytest.approx(ratio, rel=1e-9)


def test_a_plane_that_ends_at_a_whole_step_has_a_tieline_there():
    plane = app.model.region.plane(Top.paper(), 10.0, 0.5, True, "slip", 0.0, 12.0)
    assert plane.K_J[0] == 0 and plane.K_J[-1] == plane.hover_K_J[-1] == 12.0


@pytest.mark.parametrize("nodes", [(3.0, 5.0, 9.0), (3.0, 3.0, 9.0), (3.0, 9.0, 9.0)])
def test_the_control_of_the_energy_runs_one_way_and_back(nodes):
    """Also where friction limits nothing, or all; beyond both ends it goes straight on."""
    marks = Marks(steady=3.0, slip=nodes[1], lift=9.0, theta_steady=1.0, nodes=np.array(nodes))
    energies = np.linspace(1.0, 12.0, 56)
    shares = [marks.share(E) for E in energies]
    assert np.all(np.diff(shares) > 0)
    assert [marks.energy(share) for share in shares] == pytest.approx(energies, abs=1e-12)


@pytest.mark.parametrize("K_R", [1.0, 10.0])
def test_where_nothing_limits_the_energy_the_control_has_room(K_R):
    """A uniform ball (a = 0: F_z = 1, F_h = 0): half as much again as the steady precession has, and some MgR."""
    marks = app.model.scene.energy_marks(Top(0.0, 0.4, 0.4), 1.0, K_R, 0.5)
    assert np.isinf([marks.slip, marks.lift]).all()
    assert marks.nodes[2] - marks.steady == pytest.approx(0.5 * (1 + marks.steady))


def test_where_the_limit_is_no_more_than_the_steady_precession_the_control_has_room():
    """So fast a precession that the difference is lost among floats."""
    marks = app.model.scene.energy_marks(Top.paper(), 1e6, 0.0, 0.5)
    assert marks.lift == pytest.approx(marks.steady, rel=1e-15) and marks.nodes[2] - marks.steady == pytest.approx(
        0.25 * (1 + marks.steady)
    )


def test_a_limit_far_off_is_marked_where_it_is():
    """Of a fast ball with G hardly below O: the limit of F_z, some 1/a beyond."""
    marks = app.model.scene.energy_marks(Top(1e-4, 0.4, 0.4), 100.0, 100.0, 1e3)
    assert np.isfinite(marks.lift) and marks.nodes[2] == marks.lift


def test_no_frame_turns_the_top_far_and_a_nutation_has_many():
    """A nutation that needs few frames for the turn; and one of a thin top, with many turns about axis 3 in it."""
    for top, K_J, K_R, E, many in ((Top.paper(), 8.0, 10.0, 29.0, 64), (Top(-1.0, 2.0, 0.05), 0.0, 10.0, 48.96, 400)):
        constants = Constants(K_J, K_R, E)
        period = Rolling(top, constants).period
        times = app.model.frames.frame_times(period, top, constants)
        step = np.diff(times).max()
        assert many - 1e-9 < period / step < 2 * many
        longest = app.model.frames.MOST_FRAMES * step
        assert times[-1] == pytest.approx(min(app.model.frames.NUTATIONS * period, longest), rel=1e-3)
        assert np.abs(roll(top, constants, times).omega * step).max() < app.model.frames.MOST_TURN


@pytest.mark.parametrize(
    "shape, part",
    [
        (TruncatedSphere.paper(), "stem"),
        (TruncatedSphere(R=0.016, c=0.0082, l=0.0192, r=0.0135, M=0.0115), "stem"),
        (TruncatedSphere(R=0.016, c=0.0, l=0.0, r=0.0, M=0.0115), "rim"),
        (OrdinaryTop(R=0.0018, h=0.0162, r1=0.025, r2=0.025, t=0.004, r=0.002, l=0.015, M=0.020), "rim"),
        (Ball(R=0.01, M=0.01) + 1000.0 * ball(0.02, 0.02), "rim"),
        (None, "stem"),
    ],
)
def test_what_touches_beside_the_ball_has_its_name(shape, part):
    """The end of a stem; or what is no stem's: the edge of a cut, a disc wider than the ball."""
    assert app.model.bodies.second_part(shape) == part


def test_a_top_that_rocks_through_upright_has_its_rosette_there(explorer):
    """Without spin: from upright to one side and back, then to the other, half a turn about the point below."""
    explorer.set(K_J=0.0, K_R=0.0, E=0.05)
    assert not explorer.scene.messages
    farthest = explorer.scene.turning[1]  # so far it rolls, in R
    assert explorer.scene.rosette == pytest.approx((0.0, 0.0, 0.0, farthest), abs=1e-12)


def test_at_the_limit_itself_the_top_still_rolls(explorer):
    for K_J in (0.0, 3.0, 6.0, 7.0, 8.0):
        explorer.set(K_J=K_J, energy=1.0)
        assert explorer.scene.regime.max() == ROLLS


def test_levels_and_potential_are_of_the_same_well(explorer):
    """Where the potential is least the steady precession stands, and a level is level: its energy from its state."""
    scene = explorer.scene
    theta, E = scene.potential
    (steady,) = steady_precessions(scene.top, 7.0, 10.0).theta
    assert abs(theta[E.argmin()] - steady) < theta[1] - theta[0]
    for theta, theta_dot in scene.levels:
        w2, w3 = omega2(theta, scene.top, scene.constants), omega3(theta, scene.top, scene.constants)
        found = [Constants.from_state(scene.top, *state).E for state in zip(theta, theta_dot, w2, w3, strict=True)]
        assert np.ptp(found) < 1e-12 * found[0]


def test_the_track_stays_between_two_circles(explorer):
    for K_J in (2.0, 7.0):
        explorer.set(K_J=K_J)
        x, y, nearest, farthest = explorer.scene.rosette
        away = np.hypot(*(explorer.scene.trajectory.contact - (x, y)).T)
        # The circles are touched between two frames.
        assert nearest - 1e-9 <= away.min() < nearest + 1e-3 and farthest - 1e-3 < away.max() <= farthest + 1e-3
