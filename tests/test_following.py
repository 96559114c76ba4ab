"""Slips that begin or end at zero velocity: cases that random starts found."""

import numpy as np
import pytest

from tippe_core import Coulomb, State, Top, TopError, TruncatedSphere, slide, slide_many

HIGH = Top(-0.2454897923141801, 0.40494017382608083, 0.5778737683032509)
STARTS = State(0.4087055815807693, 0.2916478503386393, -0.9472819728347419, -6.011226922036484)
STEMMED = Top(0.0697954960388368, 0.3990636621477112, 0.40813957183087674)
THROWN = State(0.03977425866686964, -1.2164000519599374, 2.2504581101501886, 16.924084444954786)
EDGE = (0.2, 1.7125, 0.0)


@pytest.mark.parametrize("rtol, left", [(1e-6, 1e-5), (1e-9, 1e-8), (1e-11, 1e-10)])
def test_energy_and_heat_hold_where_a_slip_begins(rtol, left):
    """It slips at 14.49985: samples just after it were of an energy of 1e86."""
    moved = slide(HIGH, STARTS, Coulomb(0.3), np.append(0, np.linspace(14.4998, 14.5003, 501)), rtol)
    assert [what for _, what in moved.events][-1] == "slips"
    total = moved.energy + moved.heat
    assert np.abs(total - total[0]).max() < left


def test_energy_and_heat_hold_where_a_short_slip_ends():
    """It sticks at 71.9635 and slips again at 71.9747: 1e42 of heat stayed for good."""
    many = slide_many(STEMMED, THROWN, Coulomb(0.3), 100.0, EDGE, rtol=1e-9)
    assert abs(many.energy_error) < 1e-7 and 0 < many.heat < 60


def test_what_cannot_be_followed_says_so():
    with pytest.raises(TopError) as error:
        slide(Top.paper(), State(0.1, 0, 0, 10), Coulomb(0.3), np.linspace(0, 5, 51), edge=(5, -5))
    assert error.value.code == "not-followed"


def test_nothing_asked_is_nothing_given():
    top, start = Top.paper(), State(0.1, 0, 0, 10)
    for times in ([], np.zeros((0, 3))):
        assert slide_many(top, start, Coulomb(0.3), times).end.shape == np.shape(times)


def test_a_bad_nudge_is_refused():
    start = State(0.1, 0, 0, 10)
    with pytest.raises(TopError, match="nudge"):
        slide_many(Top.paper(), start, Coulomb(0.3), 0.1, TruncatedSphere.paper().edge, nudge=0)
