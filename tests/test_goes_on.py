"""Sliding: a motion that goes on from where it was is the motion that never stopped, and that of another integrator."""

from dataclasses import fields

import numpy as np
import pytest
import sliding_body as sb
from cases import LOADED, PAPER

from tippe_core import (
    PRESETS,
    Contensou,
    Coulomb,
    Sliding,
    SmoothedCoulomb,
    State,
    TopError,
    TruncatedSphere,
    Viscous,
    slide,
)

TOYS = {preset.name: preset for preset in PRESETS}
FLIES, EDGE = (PAPER, State(2.2, 0.0, 0.0, 12.0), Coulomb(0.3)), TruncatedSphere.paper().edge


def differs(one, other):
    """The names of the fields of two Trajectories that are not the same to the last bit."""
    return [
        field.name
        for field in fields(one)
        if not np.array_equal(np.asarray(getattr(one, field.name)), np.asarray(getattr(other, field.name)))
    ]


def gone_on(parts, *start, **how):
    sliding = Sliding(*start, float(parts[0][0]), **how)
    return [sliding.until(part) for part in parts if len(part)]


@pytest.mark.parametrize("seed", range(0, 40, 3))  # of each law, and of each toy
def test_in_parts_it_is_the_same_to_the_last_bit(seed):
    random = np.random.default_rng(seed)
    toy, mu = PRESETS[seed % len(PRESETS)], float(0.02 * 40 ** random.random())
    laws = (Coulomb(mu), Coulomb(mu, 1.5 * mu), Viscous(mu), SmoothedCoulomb(mu, 0.05), Contensou(mu, 0.02))
    state = State(random.uniform(0, 3.1), 0.2 * random.normal(), 0.0, 8 * random.normal())
    edge = toy.shape.edge
    landing, delta = "plastic" if seed % 4 else "stop", 0.0 if seed % 7 else 0.01
    how = {"edge": edge, "rtol": 10.0 ** -random.integers(6, 10), "landing": landing, "rolling_resistance": delta,
           "profile": toy.shape.profile(101) / toy.shape.R if edge else None}  # fmt: skip
    start = toy.top, state, laws[seed // 8], np.linspace(1.0, random.uniform(2, 100), random.integers(1, 1000))
    try:
        whole = slide(*start, **how)
    except TopError as error:
        pytest.skip(str(error))
    *start, times = start
    cuts = np.sort(random.integers(1, len(times) + 1, 3))
    parts = gone_on(np.split(times, cuts), *start, **how)
    assert differs(parts[-1], whole) == []
    for part, asked in zip(parts, [*cuts, len(times)], strict=False):
        assert differs(part[:asked], slide(*start, times[:asked], **how)) == []  # whatever follows


def test_each_way_of_going_on_is_met():
    """The starts above roll exactly, land, stand, and end; here is one of each, cut where it does."""
    leine = TOYS["Leine and Glocker's toy"]
    flips = leine.top, State(0.1, 0.0, 0.0, 7.04), Contensou(0.3, 0.02)
    rolls = PAPER, State(0.4, 0.0, 0.0, 6.0), Coulomb(0.4)
    times = np.linspace(0, 80, 4001)
    for start, event in ((flips, "stands on its stem"), (rolls, "sticks"), (FLIES, "lands on its stem")):
        edge = {flips: leine.shape.edge, FLIES: EDGE}.get(start)
        whole = slide(*start, times, edge=edge)
        when = next(t for t, name in whole.events if name == event)
        cut = int(np.searchsorted(times, when))
        for where in (cut - 1, cut, cut + 1, len(times) - 1):
            assert differs(gone_on([times[:where], times[where:]], *start, edge=edge)[-1], whole) == []


@pytest.mark.parametrize(
    ("top", "state", "friction"),
    [(PAPER, State(0.1, 0, 0, 8.8), SmoothedCoulomb(0.3, 1.0)), (LOADED, State(0.1, 0, 0, 4.0), Viscous(0.443))],
)
def test_going_on_against_the_rigid_body(top, state, friction):
    times = np.linspace(0.0, 12.0, 61)
    other = sb.integrate(top, lambda u: friction.k(u @ u) * u, *sb.first_instant(top, state), times)
    moved = gone_on(np.split(times, [1, 2, 17, 18, 40]), top, state, friction, rtol=1e-12)[-1]
    axes = np.array([sb.matrix(q)[:, 2] for q in other.quaternion])
    np.testing.assert_allclose(np.cos(moved.theta), axes[:, 2], rtol=0, atol=1e-8)
    np.testing.assert_allclose(moved.com, other.com, rtol=0, atol=1e-8)
    np.testing.assert_allclose(moved.heat, -other.work, rtol=0, atol=1e-8)


def test_what_has_ended_does_not_go_on():
    sliding = Sliding(*FLIES, edge=EDGE, landing="stop")
    ended = sliding.until([0.0, 5.0])
    assert sliding.ended and ended.events[-1][1] == "lifts off"
    assert differs(sliding.until([6.0, 9.0]), ended) == []


def test_it_has_no_way_back():
    sliding = Sliding(PAPER, State(0.3, 0.0, 0.0, 9.0), Coulomb(0.3), 1.0)
    with pytest.raises(TopError, match="times"):
        sliding.until([0.5, 2.0])
    assert len(sliding.until([1.0, 2.0])) == 2
    with pytest.raises(TopError, match="times"):
        sliding.until([1.5])
    assert len(sliding.until([2.0, 3.0])) == 4
