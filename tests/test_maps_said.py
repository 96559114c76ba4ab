"""The words and drawings about a map's runs: why they differ from a formula, how they end, and which body they are
for."""

from dataclasses import replace

import numpy as np
import pytest

from app.model.maps import steady
from app.model.maps.body import outline_of
from app.model.maps.lines import disagreements
from app.model.maps.maps import UNITS, Map
from app.model.maps.rates import rates
from app.model.maps.solving import Level
from app.model.maps.steady import Bifurcation, bifurcation, fixed
from app.model.maps.throw import throw_of
from tippe_core import PRESETS, State, slide

LEFT, RIGHT = (0, 0), (0, 2)  # a cell that cannot stand turned over by the formula, and one that can


def told(law, at, end, time_stem=np.nan, hops=0.0):
    """{kind: why} of a map all of whose other runs do what the formula says."""
    asked = Map(cells=3, law=law, across_range=(2.0, 50.0))
    ends = np.full((3, 3), "inverted", "<U8")
    ends[:, 0] = "leaning"
    columns = {name: np.full((3, 3), np.nan) for name in UNITS}
    ends[at], columns["time_stem"][at], columns["hops"][at] = end, time_stem, hops
    x, y = asked.centres(3)
    found = disagreements(Level(asked=asked, x=x, y=y, end=ends, columns=columns))
    assert all((each.count, each.one) == (1, (x[at[1]], y[at[0]])) for each in found)
    return {each.kind: each.why for each in found}


@pytest.mark.parametrize(
    ("law", "at", "run", "said"),
    [
        ("contensou", LEFT, ("stem",), {"beyond": "carries"}),
        ("contensou", LEFT, ("inverted",), {"beyond": "high"}),
        ("contensou", RIGHT, ("leaning", 1.0, 30.0), {"lies": "lifts"}),
        ("contensou", RIGHT, ("leaning", 1.0), {"lies": "falls"}),
        ("viscous", RIGHT, ("leaning", 1.0), {"lies": "stem"}),
        ("coulomb", RIGHT, ("rolling",), {"lies": "sticks"}),
        ("contensou", RIGHT, ("moving",), {"lies": "time"}),
        ("contensou", RIGHT, ("leaning",), {"lies": "pivoting"}),
        ("smoothed", RIGHT, ("leaning",), {"lies": "time"}),
        ("coulomb", RIGHT, ("upright",), {"lies": "time", "stays": "sticks"}),
        ("contensou", RIGHT, ("inverted",), {}),
    ],
)
def test_why_a_run_does_otherwise_is_said_by_what_it_did(law, at, run, said):
    assert told(law, at, *run) == said


def test_the_worst_number_may_be_below_zero():
    asked = Map(cells=3)
    columns = {name: np.full((3, 3), np.nan) for name in UNITS}
    columns["energy_error"][0] = -5e-6, 1e-6, 0.0
    level = Level(asked=asked, x=np.arange(3.0), y=np.arange(3.0), end=np.full((3, 3), "stem"), columns=columns)
    assert level.worst("energy_error") == 5e-6 and np.isnan(level.worst("C_J_drift"))


def test_the_spin_is_raised_and_then_lowered(monkeypatch):
    """Each tilt stands over its own spin; where the two ends differ by more than a few degrees, it is said."""
    asked = []

    def swept(own, tilt, spins, look):
        asked.append(spins)
        return np.arange(len(spins), dtype=float), np.full(len(spins), "leaning")

    monkeypatch.setattr(steady, "_sweep", swept)
    found = bifurcation(Map(seconds=0.1), (28.6, 5.7))
    (up, down), count = asked, len(found.swept)
    assert up[0] == down[-1] == found.swept[0] == 5.0 and up[-1] == down[0] == found.swept[-1] == 50.0
    assert found.up.tolist() == [*range(count)] and found.down.tolist() == [*range(count)][::-1]
    assert found.times == (0.1, 0.4) and not np.allclose(*found.theta, equal_nan=True)
    part = {"lines": (), "spin": found.spin, "times": found.times, "theta": found.theta, "life": found.life}
    swept = np.array([5.0, 10.0, 15.0, 20.0])
    leans = np.full(4, "leaning")
    one = Bifurcation(
        swept=swept, up=np.array([0.0, 0.0, 120.0, 180.0]), down=np.array([1.0, 90.0, 150.0, 180.0]), **part,
        up_end=leans, down_end=leans,
    )  # fmt: skip
    assert one.hysteresis == (10.0, 15.0)
    assert replace(one, down=one.up + 1).hysteresis is None
    # the tilt of what nods is that of a moment, and what still changes has no end yet
    nods, moves = np.full(4, "rolling"), np.full(4, "moving")
    assert replace(one, up_end=nods, down_end=nods).hysteresis is None
    assert replace(one, up_end=moves).hysteresis is None and replace(one, down_end=moves).hysteresis is None
    assert replace(one, up_end=nods).hysteresis == (5.0, 20.0)


def test_small_motions_go_round_as_those_of_a_run_do():
    """Upright, while the tilt of a run grows: seen from above, by the azimuth of its axis."""
    asked = Map(body="Top S", law="viscous", values=(("mu", 0.5),), across_range=(12.0, 16.0))
    found = rates(asked, (14.0, 5.7))
    (upright,) = (branch for branch in found.branches if branch.name == "upright")
    cell = asked.at(14.0, 5.7)
    spin = steady.launch(cell) * 14.0 / (cell.top.I3 * (1 - cell.top.a))
    growth = np.interp(14.0, upright.spin, upright.growth) * cell.scales.time
    moved = slide(cell.top, State(1e-7, 0, 0, spin, vx=0.0, vy=0.0), cell.friction, np.linspace(0, 12 / growth, 4000),
                  rtol=1e-11)  # fmt: skip
    late = (moved.t > 6 / growth) & (moved.theta < 0.01)
    round_ = np.polyfit(moved.t[late], np.unwrap(moved.phi[late]), 1)[0] / cell.scales.time
    assert np.interp(14.0, upright.spin, upright.turning) == pytest.approx(abs(round_), rel=0.02)


@pytest.mark.parametrize("up", ["stem", "rounding"])
def test_a_stem_is_drawn_as_long_as_it_is(up):
    toy = Map(up=up, up_range=(1.0, 30.0))
    stem = 25.0 if up == "stem" else toy.start["stem"]
    value = 25.0 if up == "stem" else 3.0
    drawn = outline_of(toy, toy.at(28.6, value), None)
    assert drawn[:, 1].max() * 1e3 * toy.thing.scales.R == pytest.approx(stem, rel=1e-9)
    assert outline_of(Map(), Map().at(28.6, 5.7), None)[:, 1].max() * 15 == pytest.approx(18, rel=1e-3)


def test_the_lab_has_only_runs_that_it_can_make():
    assert throw_of(Map(), 28.6, 5.7) == ("Leine and Glocker's toy", 28.6, 5.7, 0.3)
    for other in (Map(values=(("slip", 0.5),)), Map(law="smoothed"), Map(across="R", across_range=(8.0, 30.0)),
                  Map(values=(("second", 0.7),))):  # fmt: skip
        assert throw_of(other, 28.6, 5.7) is None


def test_what_stands_below_a_map_over_tops_is_of_the_top_at_the_bead():
    asked = Map(across="a", up="ratio", across_range=(0.02, 0.4), up_range=(0.7, 1.5))
    own = fixed(asked, (0.13, 1.2))
    preset = next(preset for preset in PRESETS if preset.name == asked.body)
    assert own.thing.top.a == 0.13 and own.thing.top.I1 / own.thing.top.I3 == pytest.approx(1.2)
    assert own.thing.top.I3 == preset.top.I3 and (own.across, own.up) == ("spin", "tilt")
