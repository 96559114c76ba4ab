"""ending() of a sliding motion, compared with the heights of ball and stem above the table, and with the motion
itself."""

from itertools import pairwise

import numpy as np
import pytest

from tippe_core import (
    Coulomb,
    Scales,
    SmoothedCoulomb,
    State,
    Top,
    TopError,
    TruncatedSphere,
    Viscous,
    ending,
    glide,
    slide,
)

PAPER, EDGE, SCALES = Top.paper(), TruncatedSphere.paper().edge, Scales.paper()
HAND = SmoothedCoulomb(0.3, 0.1)
SECOND = 1 / SCALES.time


def thrown(spin, seconds, friction=HAND, edge=EDGE, tilt=10.0, samples=2001, **how):
    """The paper's top let go at so many rev/s, from the degrees of tilt."""
    start = State(np.radians(tilt), 0, 0, 2 * np.pi * spin / SCALES.angular_velocity)
    how = {"edge": edge} | how
    return slide(PAPER, start, friction, np.linspace(0, seconds * SECOND, samples), **how)


def heights(moved):
    """Of the ball's lowest point and of the lowest on the rim of the stem's end, straight from the pose."""
    x, y, z, w = moved.quaternion.T
    c, s = 1 - 2 * (x * x + y * y), 2 * np.hypot(x * z - w * y, y * z + w * x)
    radius, up, _ = EDGE
    centre = moved.com[:, 2] + PAPER.a * c
    return centre - 1, centre + up * c - radius * s


@pytest.mark.slow
def test_on_what_it_stands_is_what_is_at_the_table():
    for spin in (20, 35, 38):
        moved = thrown(spin, 5.0)
        ball, stem = heights(moved)
        found = ending(moved).stretches
        assert found[0].start == 0 and found[-1].end == moved.t[-1]
        assert all(a.end == b.start and a.on != b.on for a, b in pairwise(found))
        for stretch in found:
            inside = (moved.t > stretch.start) & (moved.t < stretch.end)
            for which, height in (("ball", ball[inside]), ("stem", stem[inside])):
                if stretch.on in (which, "both"):
                    assert np.all(np.abs(height) < 1e-6)
                elif height.size > 1:  # it may separate arbitrarily slowly
                    assert np.all(height > -1e-6) and height.max() > 1e-6


@pytest.mark.slow
def test_the_default_page_leaves_its_ball_for_8_ms_and_then_leans_on_both():
    found = ending(thrown(20, 5.0))
    _, (start, end, on), *_, last = found.stretches
    assert on == "stem" and start * SCALES.time == pytest.approx(2.567, abs=1e-3)
    assert (end - start) * SCALES.time == pytest.approx(0.008, abs=5e-4)
    assert last.on == "both" and last.start * SCALES.time == pytest.approx(2.63, abs=5e-3)
    assert (found.end, found.on, found.cut) == ("leaning", "both", True)
    assert np.degrees([found.least, found.most]) == pytest.approx(118.79, abs=0.01)


@pytest.mark.slow
@pytest.mark.parametrize(("moved", "end", "settled"), [
    (lambda: thrown(25, 5.0), "moving", False),  # on its way back to 0
    (lambda: thrown(38, 5.0), "stem", False),
    (lambda: thrown(20, 5.0, Coulomb(0.3)), "upright", True),  # caught rolling
    (lambda: thrown(20, 5.0, edge=None), "inverted", False),
    (lambda: thrown(2, 60.0, edge=None), "upright", True),
    (lambda: thrown(20, 60.0, Viscous(0.3), edge=None), "inverted", True),
    (lambda: thrown(20, 5.0, Coulomb(0.3), edge=None, tilt=60.0), "rolling", True),
    (lambda: thrown(20, 0.5, edge=None, tilt=0.01), "upright", False),  # growing
])  # fmt: skip
def test_where_it_is_in_the_end(moved, end, settled):
    found = ending(moved())
    assert (found.end, found.settled, found.ended) == (end, settled, "")
    assert found.cut != found.settled


def test_what_ends_it_early_is_said():
    moved = slide(PAPER, State(1.9, 3.0, 0.0, 15.0), HAND, np.linspace(0, 5, 500), edge=EDGE, landing="stop")
    found = ending(moved)
    assert moved.t[-1] < 5 and found.ended == "lifts off"
    assert not found.settled and not found.cut and not found.flat
    with pytest.raises(TopError, match="trajectory"):
        ending(glide)
