"""The words and drawings about a map's runs: why they differ from a formula, how they end, and which body they are
for."""

from dataclasses import replace

import numpy as np
import pytest

from app.model.maps import steady
from app.model.maps.body import outline_of
from app.model.maps.choice import AT
from app.model.maps.kept import recall
from app.model.maps.lines import disagreements
from app.model.maps.maps import AT_FIRST, UNITS, Map
from app.model.maps.rates import OfLaw, Power, by_law, rates
from app.model.maps.solving import CURVE, Level, run
from app.model.maps.steady import Bifurcation, bifurcation, fixed
from app.model.maps.throw import throw_of
from app.tabs.maps.picture import MapFigure
from app.tabs.maps.steady import of_laws, of_powers
from app.tabs.maps.words import colours_say, of_reason
from tippe_core import PRESETS, State, slide, thresholds
from tippe_core.linear import tumbling

LEFT, RIGHT = (0, 0), (0, 2)  # a cell that cannot stand turned over by the formula, and one that can


def told(law, at, end, time_stem=np.nan, hops=0.0):
    """{kind: why} of a map all of whose other runs do what the formula says."""
    asked = Map(cells=3, law=law, across_range=(2.0, 50.0))
    ends = np.full((3, 3), "inverted", "<U8")
    ends[:, 0] = "leaning"
    columns = {name: np.full((3, 3), np.nan) for name in UNITS}
    ends[at], columns["time_stem"][at], columns["hops"][at] = end, time_stem, hops
    x, y = asked.centres(3)
    found = disagreements(Level(request=asked, x=x, y=y, end=ends, columns=columns))
    assert all(each.count == 1 and each.reasons[0][1:] == (1, (x[at[1]], y[at[0]])) for each in found)
    return {each.kind: each.reasons[0].why for each in found}


@pytest.mark.parametrize(
    ("law", "at", "run", "said"),
    [
        ("contensou", LEFT, ("stem",), {"beyond": "carries"}),
        ("contensou", LEFT, ("inverted",), {"beyond": "high"}),
        ("contensou", RIGHT, ("leaning", 1.0, 30.0), {"lies": "lifts"}),
        ("contensou", RIGHT, ("leaning", 1.0), {"lies": "falls"}),
        ("viscous", RIGHT, ("leaning", 1.0), {"lies": "falls"}),
        ("coulomb", RIGHT, ("rolling",), {"lies": "sticks"}),
        ("contensou", RIGHT, ("moving",), {"lies": "moving"}),
        ("contensou", RIGHT, ("leaning",), {"lies": "leans"}),
        ("coulomb", RIGHT, ("upright",), {"lies": "slow", "stays": "slow"}),
        ("contensou", RIGHT, ("upright",), {"lies": "slow", "stays": "slow"}),
        ("contensou", RIGHT, ("inverted",), {}),
    ],
)
def test_why_a_run_does_otherwise_is_said_by_what_it_did(law, at, run, said):
    assert told(law, at, *run) == said


def test_each_reason_is_told_with_the_number_of_its_runs_the_most_frequent_first():
    asked = Map(cells=3, across_range=(35.0, 50.0))
    ends, none = np.full((3, 3), "inverted", "<U8"), np.full((3, 3), np.nan)
    ends[0], ends[1, 1] = "leaning", "moving"
    x, y = asked.centres(3)
    (found,) = disagreements(Level(request=asked, x=x, y=y, end=ends, columns=dict.fromkeys(UNITS, none)))
    assert (found.kind, found.count, found.allowed, found.low, found.high) == ("lies", 4, 9, x[0], x[2])
    assert found.reasons == (("leans", 3, (x[1], y[0])), ("moving", 1, (x[1], y[1])))
    first, second = (of_reason(found, k, asked) for k in (0, 1))
    assert first.startswith("In this map, 4 of the 9 runs") and "3 of them: they come to lean on the way." in first
    assert "from 37.5 to 47.5 rev/s." in first and "at 42.5 rev/s." in of_reason(
        replace(found, low=x[1], high=x[1]), 0, asked
    )
    assert second == "1 of them: they are still on their way at the end."
    alone = replace(found, count=3, reasons=found.reasons[:1])
    assert "All of them: they come to lean" in of_reason(alone, 0, asked)


def test_what_stays_upright_was_too_short_or_has_lost_its_spin():
    """The spin that a run without any tilt has left at the end, against the published spin below which it is stable."""
    said = {}
    for seconds in (0.02, 4.0):
        asked = Map(body="The paper's tippe top", cells=3, across_range=(7.0, 8.0), up_range=(1.0, 3.0),
                    seconds=seconds, values=(("second", 2.0),))  # fmt: skip
        x, y = asked.centres(3)
        columns = {name: np.full((3, 3), np.nan) for name in UNITS}
        level = Level(request=asked, x=x, y=y, end=np.full((3, 3), "upright"), columns=columns)
        found = next(each for each in disagreements(level) if each.kind == "stays")
        said |= {(place, seconds): reason.why for reason in found.reasons for place in [reason.one]}
    for (place, seconds), why in said.items():
        cell = replace(asked, seconds=seconds).at(*place)
        spins = State(1e-9, 0.0, 0.0, cell.state.omega3, vx=0.0, vy=0.0)
        moved = slide(cell.top, spins, cell.friction, [0.0, cell.t_end])
        stable = abs(moved.omega[-1, 2]) < thresholds(cell.top).upright.spin
        assert why == ("pivoting" if stable else "slow")
    assert {*said.values()} == {"pivoting", "slow"}


def test_the_worst_number_may_be_below_zero():
    asked = Map(cells=3)
    columns = {name: np.full((3, 3), np.nan) for name in UNITS}
    columns["energy_error"][0] = -5e-6, 1e-6, 0.0
    level = Level(request=asked, x=np.arange(3.0), y=np.arange(3.0), end=np.full((3, 3), "stem"), columns=columns)
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


def test_small_motions_grow_by_each_law_as_those_of_a_run_do():
    """Upright, at the spin of the bead; by Coulomb's law the top rolls, and no run grows."""
    asked = Map(body="Top S", law="viscous", across_range=(12.0, 16.0), values=(("mu", 0.5),))
    found = {(each.law, each.branch): each for each in by_law(asked, asked.values_at(14.0, 5.7))}
    assert len(found) == 12 and abs(found["coulomb", "upright"].growth) < 1e-6
    for law in ("viscous", "smoothed", "contensou"):
        assert found[law, "inverted"].growth < 0, law
        cell = replace(asked, law=law).at(14.0, 5.7)
        spin = steady.launch(cell) * 14.0 / (cell.top.I3 * (1 - cell.top.a))
        growth = found[law, "upright"].growth * cell.scales.time
        moved = slide(cell.top, State(1e-8, 0, 0, spin, vx=0.0, vy=0.0), cell.friction,
                      np.linspace(0, 8 / growth, 2000), rtol=1e-11)  # fmt: skip
        late = moved.t > 6 / growth
        left = 14.0 * moved.jellett[late].mean() / moved.jellett[0]  # pivoting takes some of the spin
        told = {(each.law, each.branch): each for each in by_law(asked, asked.values_at(left, 5.7))}
        grown = np.polyfit(moved.t[late], np.log(moved.theta[late]), 1)[0] / cell.scales.time
        assert grown == pytest.approx(told[law, "upright"].growth, rel=0.03), law


def test_inverted_spin_that_is_too_slow_falls_as_a_run_does():
    asked = Map(body="Top S", law="viscous", values=(("mu", 0.5),), across_range=(2.0, 16.0))
    (told,) = (each for each in by_law(asked, asked.values_at(6.0, 5.7))
               if (each.law, each.branch) == ("viscous", "inverted"))  # fmt: skip
    cell = asked.at(6.0, 5.7)
    C_J = slide(cell.top, cell.state, cell.friction, [0.0]).jellett[0]
    unit = slide(cell.top, State(np.pi, 0, 0, 1.0, vx=0.0, vy=0.0), cell.friction, [0.0]).jellett[0]
    start = State(np.pi - 1e-8, 0, 0, C_J / unit, vx=0.0, vy=0.0)
    growth = told.growth * cell.scales.time
    moved = slide(cell.top, start, cell.friction, np.linspace(0, 9 / growth, 2000), rtol=1e-11)
    late = moved.t > 6 / growth
    grown = np.polyfit(moved.t[late], np.log(np.pi - moved.theta[late]), 1)[0]
    assert growth > 0 and grown == pytest.approx(growth, rel=0.03)


def test_leaning_dies_out_and_goes_round_as_a_run_does_that_was_pushed():
    """The nodding of top S about the tilt at which it hangs: how its peaks shrink, and how often they come."""
    asked = Map(body="Top S", law="viscous", values=(("mu", 0.5),), across_range=(2.0, 16.0))
    cell = asked.at(9.55, 5.7)
    _, _, omega2, omega3, *_ = tumbling(cell.top, 1.95)
    pushed = State(1.95, 0.0, 1.02 * omega2, omega3, vx=0.0, vy=0.0)
    moved = slide(cell.top, pushed, cell.friction, np.linspace(0, 900, 6000), rtol=1e-11)
    spin = moved.jellett[-1] / steady.launch(cell)
    (told,) = (each for each in by_law(asked, asked.values_at(spin, 5.7))
               if (each.law, each.branch) == ("viscous", "tumbling"))  # fmt: skip
    away = np.abs(moved.theta - moved.theta[-1])
    peaks = np.flatnonzero((away[1:-1] > away[:-2]) & (away[1:-1] > away[2:])) + 1
    peaks = peaks[(moved.t[peaks] > 100) & (moved.t[peaks] < 500)]
    t = moved.t[peaks] * cell.scales.time
    assert np.polyfit(t, np.log(away[peaks]), 1)[0] == pytest.approx(told.growth, rel=0.05)
    assert np.pi / np.diff(t).mean() == pytest.approx(told.turning, rel=0.01)


def test_growth_is_of_spins_from_zero_on_and_none_of_a_map_without_any():
    body = {"body": "Top S", "law": "viscous", "seconds": 0.1}
    upright, *_ = rates(Map(across_range=(-10.0, 16.0), **body), (14.0, 5.7)).branches
    assert upright.spin[0] == 0.0 and upright.spin[-1] == 16.0
    assert rates(Map(across_range=(-20.0, -10.0), **body), (-14.0, 5.7)).branches == ()


def test_what_goes_round_is_told_in_turns():
    said = of_laws((OfLaw("viscous", "upright", 1.5, 2 * np.pi * 3), OfLaw("viscous", "tumbling", np.nan, np.nan)),
                   {"spin": 28.6})  # fmt: skip
    assert said.count("1.5; 3<") == 1 and "nan" not in said and "28.6 rev/s" in said


def test_a_top_that_spins_the_other_way_has_as_many_pictures():
    asked = Map(across_range=(-60.0, 60.0), law="viscous")
    one, other = run(asked, 60.0, 5.7), run(asked, -60.0, 5.7)
    assert CURVE < len(one.t) == len(other.t)
    np.testing.assert_allclose(one.theta, other.theta, atol=1e-6)  # its mirror image


def test_only_an_area_with_room_for_its_name_is_named():
    level, figure = recall(Map()), MapFigure()
    for side, named in ((10, False), (16, True)):  # of 48 cells: 4 and 11 % of the map
        ends = np.full(level.end.shape, "stem", level.end.dtype)
        ends[10 : 10 + side, 10 : 10 + side] = "leaning"
        figure.show(replace(level, end=ends), "end")
        shown = [word.text for word in figure.words if word.visible]
        assert ("leans, without nodding" in shown) is named


def test_too_few_runs_for_a_power_are_not_called_none():
    none, few, good = (Power("viscous", "spin", np.nan, np.nan, runs) for runs in (0, 2, 9))
    said = [of_powers((each,)) for each in (none, few, good._replace(power=-0.5, error=0.04))]
    assert "none turns over" in said[0] and "too few turn over" in said[1] and "−0.50 ± 0.04" in said[2]


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


def test_the_map_shown_first_answers_for_most_starts_and_for_the_first_top():
    """It stands on its stem there, as the list of its own run says; and it says how many are decided."""
    level = recall(AT_FIRST)
    decided = int((level.end != "moving").sum())
    assert decided > 0.7 * level.end.size
    assert level.end[level.cell(*AT)] == run(AT_FIRST, *AT).end == "stem"
    assert f"{decided:,} of {level.end.size:,} runs are decided" in colours_say(level, "end")
