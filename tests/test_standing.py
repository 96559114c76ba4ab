"""When a top that stands on its stem can no longer tip: by plain geometry, and matrices and rotations of other
libraries."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from tippe_core import Top
from tippe_core.motion.standing import FLAT, crossed, energy_above_rest, lies, tipping_energy

TOP = Top(0.07, 0.399, 0.408).numbers
HEAVY = Top(-0.9, 1.5, 1.0).numbers  # G is so near to the stem's end that it comes to the ball before G is over the rim
RNG = np.random.default_rng(24)


@pytest.mark.parametrize(
    "top, edge, onto_ball",
    [
        (TOP, (0.2, 1.7, 0.0), False),
        (TOP, (0.3, 1.2, 0.1), False),
        (HEAVY, (0.6, 1.05, 0.0), True),
        (HEAVY, (0.6, 1.0, 0.05), True),
    ],
)
def test_what_G_must_rise_to_tip_over_is_its_highest_place_until_the_ball_touches(top, edge, onto_ball):
    """The centre of the rim's rounding turns about the point below it, and with it G and the ball's centre O."""
    b, h, q = edge
    lean = np.linspace(0, 1.5, 150_001)[:, None]
    # from the rim's centre, in the plane of the lean, to G and O
    G, O = (Rotation.from_euler("y", -lean).apply((b, 0.0, height))[:, 2] for height in (top.a + h, h))
    touches = np.argmax(O + q < 1)
    assert (G[touches:].max() > G[:touches].max() + 1e-3) == onto_ball
    assert tipping_energy(top, edge) == pytest.approx(G[:touches].max() - G[0], abs=1e-5)


def test_the_energy_above_rest_is_that_of_a_rigid_body():
    """With the tensor of inertia in space; at rest G is a + h + q high."""
    edge = (0.2, 1.7, 0.1)
    for _ in range(20):
        turn, L, v, z = Rotation.random(random_state=RNG), *RNG.normal(size=(2, 3)), RNG.uniform(0.5, 2)
        y = np.zeros(16)
        y[:4], y[5:8], y[[8, 9, 14]], y[15] = turn.as_quat(), L, v, z
        R = turn.as_matrix()
        inverse = R @ np.diag([1 / TOP.I1, 1 / TOP.I1, 1 / TOP.I3]) @ R.T
        energy = L @ inverse @ L / 2 + v @ v / 2 + z - (0.07 + 1.7 + 0.1)
        assert energy_above_rest(TOP, edge, y, L @ R[:, 2]) == pytest.approx(energy, rel=1e-12)


def test_it_lies_where_its_turn_about_the_rim_takes_it_no_further_than_flat():
    """Kinetic energy about the rim, by Steiner, against what G rises over the rim's width, just below and above it.

    Nearly upright, and with a spin that turns the lean round."""
    b, h, _ = edge = (0.2, 1.7, 0.0)
    for _ in range(20):
        e = np.array([*0.05 * RNG.normal(size=2), -1.0])
        e, w = e / np.linalg.norm(e), RNG.normal(size=3) * (1, 1, 30)
        about_rim = (TOP.I1 + (TOP.a + h) ** 2 + b**2) * np.sum(np.cross(w, e) ** 2) / 2
        at_limit = w * np.sqrt(b * FLAT / about_rim)
        assert lies(TOP, edge, tuple(e), tuple(0.99 * at_limit))
        assert not lies(TOP, edge, tuple(e), tuple(1.01 * at_limit))


def test_on_the_other_side_it_leans_as_much():
    """Mirrored about the vertical through axis 3's lean, whatever its turn about axis 3: half a turn about Z of e."""
    for lean in (1e-6, 1e-3, 0.5):
        turn = Rotation.from_euler("ZXZ", [RNG.uniform(0, 6), np.pi - lean, RNG.uniform(0, 6)])
        y = np.zeros(16)
        y[:4] = turn.as_quat()
        e = turn.apply((0, 0, 1))
        other = Rotation.from_quat(crossed(y, e)[:4])
        assert other.apply((0, 0, 1)) == pytest.approx(e * (-1, -1, 1), abs=1e-12)
        # the shortest turn that does it: by twice the lean, about a horizontal axis
        moved = (other * turn.inv()).as_rotvec()
        assert np.linalg.norm(moved) == pytest.approx(2 * lean, rel=1e-6) and abs(moved[2]) < 1e-9
