"""Families of tops: the allowed fraction of the plane compared with a slow search, and their map, row by row."""

import numpy as np
import pytest
from limits import limit

from app.model.explorer import Explorer
from app.model.families.family import region, share_map
from app.tabs.families.compare import Compare
from tippe_core import (
    Top,
    allowed_shares,
    lift_off_and_slip_tielines,
    pole_constants,
)
from tippe_core.paper.share import GRID_M, GRID_V, PART, widths

# --- families ---


def test_the_allowed_share_is_the_area_of_the_papers_table():
    """physics.md's tielines of the paper's top at K_R = 10: outer - inner over K_J from 0 to P, by trapezoids."""
    K_J = np.array([0, 1, 2, 3, 4, 5, 6, 7, 8, 8.3651])
    lift = np.array([1.6943, 1.5787, 1.4646, 1.3508, 1.2365, 1.1207, 1.0040, 0.8907, 0.7991, 0.7789]) - [
        1.3085,
        1.1960,
        1.0797,
        0.9578,
        0.8274,
        0.6844,
        0.5220,
        0.3294,
        0.0945,
        0.0,
    ]
    slip = np.array([1.6637, 1.5519, 1.4393, 1.3242, 1.2043, 1.0764, 0.9350, 0.7754, 0.5837, 0.4998]) - [
        1.3383,
        1.2210,
        1.1023,
        0.9804,
        0.8529,
        0.7165,
        0.5654,
        0.3839,
        0.1328,
        0.0,
    ]
    share = np.trapezoid(slip, K_J) / np.trapezoid(lift, K_J)
    # the rule's own error with ten points, both areas curved alike
    assert allowed_shares(0.07, 0.399, 0.408, 10.0, 0.5) == pytest.approx(share, abs=3e-3)


def exact_share(a, I1, I3, K_R, mu_s):
    """From tielines at the same 64 K_J, each refined to full accuracy."""
    top = Top(a, I1, I3)
    lift, slip = lift_off_and_slip_tielines(top, PART * pole_constants(top, K_R)[0], K_R, mu_s)
    return np.nansum(slip.theta_outer - slip.theta_inner) / np.nansum(lift.theta_outer - lift.theta_inner)


@pytest.mark.parametrize(
    "a, ratio, I1, K_R, mu_s",
    [
        (0.07, 1.02, 0.399, 10.0, 0.5),
        (0.02, 0.6, 0.399, 10.0, 0.5),
        (0.3, 1.6, 0.399, 10.0, 0.1),
        (0.5, 0.8, 0.399, 4.0, 0.3),
        (-10.1, 1.9, 48.2, 53.3, 0.5),
        (-5.0, 1.0, 48.2, 53.3, 0.5),
        (-2.9, 1.04, 3.66, 23.6, 0.5),
        (-1.7, 0.6, 0.4, 10.0, 0.5),
        (-8.0, 1.2, 2.0, 30.0, 0.5),
    ],
)
def test_the_bulk_share_is_that_of_the_exact_tielines(a, ratio, I1, K_R, mu_s):
    """Tippe and ordinary tops, wells of a radian and of 1e-5, one and two of them. 5e-4 is a thirtieth of what the eye
    could tell on the map's scale of colours."""
    share = allowed_shares(a, I1, ratio * I1, K_R, mu_s)
    assert share == pytest.approx(exact_share(a, I1, ratio * I1, K_R, mu_s), abs=5e-4)


@pytest.mark.parametrize(
    "a, I1, I3, K_R, mu_s, row",
    [(0.070, 0.399, 0.408, 10.0, 0.5, 40), (0.449, 0.399, 0.3024, 10.0, 0.5, 14), (-2.9, 3.66, 3.8, 23.6, 0.5, 62)],
)
def test_a_width_is_that_of_the_slow_search(a, I1, I3, K_R, mu_s, row):
    """limits.py walks trajectory after trajectory with a rigid body's own forces."""
    top = Top(a, I1, I3)
    with np.errstate(all="ignore"):
        found = widths(GRID_V, GRID_M, *np.array([[a], [I1], [I3]]), K_R, mu_s, PART)[:, 0, row]
    for width, mu in zip(found, (None, mu_s), strict=True):
        _, inner, outer, _ = limit(top, PART[row] * pole_constants(top, K_R)[0], K_R, mu)
        assert width == pytest.approx(np.nan_to_num(outer - inner), rel=1e-3)


def test_without_a_limit_all_is_allowed_and_more_friction_allows_more():
    assert allowed_shares(0.0, 0.4, 0.4, 10.0, 0.5) == 1
    shares = [allowed_shares(0.07, 0.399, 0.408, 10.0, mu_s) for mu_s in (0.1, 0.3, 0.5, 1.0, 20.0)]
    assert shares == sorted(shares) and shares[-1] == pytest.approx(1, abs=0.01)


def test_shares_of_many_are_those_of_each():
    """The same numbers, whatever else is in the batch."""
    a, I3 = np.linspace(-3.0, 0.4, 70), np.linspace(0.3, 0.7, 70)
    together = allowed_shares(a, 0.4, I3, 10.0, 0.5)
    for index in (0, 31, 32, 64, 69):
        assert together[index] == allowed_shares(a[index], 0.4, I3[index], 10.0, 0.5)


def test_a_map_grows_row_by_row_and_has_holes_where_no_top_is():
    steps = list(share_map(0.4, 10.0, 0.5, np.array([0.07, 0.3, 1.5]), np.array([1.0, 2.5])))
    assert [done for done, _ in steps] == [3, 6]
    assert np.isnan(steps[0][1].share[1]).all()
    share = steps[-1][1].share
    assert share[0, 0] == allowed_shares(0.07, 0.4, 0.4, 10.0, 0.5)
    assert np.array_equal(np.isnan(share), [[False, False, True], [True, True, True]])


def test_fig_5_of_a_region_is_the_papers():
    """The paper's P at its height 18.6, here in units of K_R^2; the tielines start and end at height 0."""
    found = region("", Top.paper(), 10.0, 0.5, count=2000)
    before, last = found.height[-2:].max(axis=1) * 100
    assert last + (last - before) / 2 == pytest.approx(18.6, abs=0.05)
    assert np.abs(found.height[:, [0, -1]]).max() < 1e-9
    assert found.theta[:, [0, -1]] == pytest.approx(np.column_stack([found.lift.theta_inner, found.lift.theta_outer]))
    assert np.all(np.diff(found.theta, axis=1) > 0)


def test_the_map_of_the_other_kind_starts_from_a_top_of_that_kind():
    for a, kind, other in ((-0.5, "ordinary", "tippe"), (0.07, "tippe", "ordinary")):
        compare = Compare(Explorer(a=a, K_R=3.0).scene)
        assert compare.kind.value == kind and compare.entries["K_R"].value == "3"
        compare.kind.value = other
        assert compare.entries["K_R"].value != "3" and float(compare.entries["I1"].value) > 0


def test_a_map_of_either_kind_fills_and_shows_this_top(explorer, monkeypatch):
    monkeypatch.setattr("app.tabs.families.compare.RATIOS", np.array([0.9, 1.1]))
    monkeypatch.setattr(
        "app.tabs.families.compare.SPANS", {"tippe": np.array([0.1, 0.2]), "ordinary": np.array([-10.0, -5.0])}
    )
    compare = Compare(explorer.scene)
    for kind, own in (("tippe", 1), ("ordinary", 0)):
        compare.kind.value = kind
        compare.compute()
        assert np.all((compare.map.shares.data["share"][0] > 0) & (compare.map.shares.data["share"][0] < 1))
        assert len(compare.map.here.data["a"]) == own
        assert compare.cancel.disabled and not compare.start.disabled


def test_a_map_stops_when_told_and_refuses_what_cannot_be(explorer, monkeypatch):
    asked = []

    def slowly(*args):
        yield 10, share_map_of_nothing
        compare.cancel.clicks += 1
        yield 20, share_map_of_nothing
        asked.append("more")

    share_map_of_nothing = next(share_map(0.4, 10.0, 0.5, np.array([0.07]), np.array([1.0, 1.1])))[1]
    monkeypatch.setattr("app.tabs.families.compare.share_map", slowly)
    compare = Compare(explorer.scene)
    compare.compute()
    assert not asked and "Cancelled" in compare.wording.object and not compare.start.disabled
    for name, text in (("mu_s", "-1"), ("I1", "0"), ("K_R", "fast")):
        compare = Compare(explorer.scene)
        compare.entries[name].value = text
        compare.compute()
        why, _, back = compare.entries[name].wrong
        assert name in why and float(back) >= 0 and not compare.start.disabled
