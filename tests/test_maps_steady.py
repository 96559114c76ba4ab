"""Below a map: steady motions as lines, how runs end after a long time, and the exponents of the time of inversion."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from app.model.maps import choice, steady
from app.model.maps.kept import BELOW, SHIPPED, read_below, recall, ships_below
from app.model.maps.maps import Map
from app.model.maps.rates import POINTS, REACH, powers, rates
from app.model.maps.solving import run
from app.model.maps.steady import _brought, bifurcation, fixed, launch, life, steady_lines
from app.tabs.maps.picture import MapFigure
from app.tabs.maps.steady import of_life
from app.tabs.maps.words import of_run
from app.text import listed
from tippe_core import Scales, State, slide, slide_many

UNIT = Scales(R=0.02, M=0.02, g=9.82)
TOP_S = Map(body="Top S", law="viscous", values=(("mu", UNIT.velocity),), across_range=(2.0, 16.0), seconds=25.0)
HANGS = 60 / (2 * np.pi), np.degrees(0.1)  # rev/s, degrees
AT = np.degrees(1.90888)  # the minimum of V_J of that start


def test_a_steady_motion_is_where_V_J_has_its_minimum():
    cell = TOP_S.at(*HANGS)
    tumbling = [line for line in steady_lines(cell.top, launch(cell), 2.0, 16.0) if 0 < line.theta.min() < 180]
    (stable,) = (line for line in tumbling if line.stable)
    order = np.argsort(stable.spin)
    spin = HANGS[0] * cell.scales.angular_velocity / UNIT.angular_velocity  # the authors use another g
    assert np.interp(spin, stable.spin[order], stable.theta[order]) == pytest.approx(AT, abs=0.01)


@pytest.mark.slow
def test_runs_that_go_on_from_one_another_lie_there_too_and_a_point_takes_no_C_J():
    found = bifurcation(TOP_S, HANGS)
    np.testing.assert_allclose(found.life.spin, HANGS[0], rtol=1e-5)
    assert found.life.end == pytest.approx(AT, abs=0.2) and np.isnan(found.life.stands)
    stable = next(line for line in found.lines if line.stable and 0 < line.theta.min() < 180)
    order, inside = np.argsort(stable.spin), (found.swept > 8) & (found.swept < 11)
    line = np.interp(found.swept, stable.spin[order], stable.theta[order])
    for swept in (found.up, found.down):
        np.testing.assert_allclose(swept[inside], line[inside], atol=1.0)


FIRST = 5  # runs of each sweep, of 17: each goes on from the one before


@pytest.mark.slow
@pytest.mark.parametrize("request_", BELOW, ids=lambda request: request.body)
def test_what_ships_of_what_is_below_a_map_is_what_is_computed(request_, monkeypatch):
    """Of the sweeps up and down the beginnings."""
    ships, whole = read_below(request_), steady._sweep
    monkeypatch.setattr(steady, "_sweep", lambda own, tilt, spins, look: whole(own, tilt, spins[:FIRST], look))
    for found, kept in zip((bifurcation(request_, choice.AT), rates(request_, choice.AT)), ships, strict=True):
        assert repr(vars(found).keys()) == repr(vars(kept).keys())
        for name, value in vars(found).items():
            there = vars(kept)[name]
            if name.startswith(("up", "down")):
                assert len(there) == len(kept.swept)
                there = there[:FIRST] if name.startswith("up") else there[-FIRST:]
            for one, other in zip(flat(value), flat(there), strict=True):
                np.testing.assert_allclose(one, other, rtol=1e-3, atol=0.01) if one.dtype.kind == "f" else (
                    np.testing.assert_array_equal(one, other))  # fmt: skip
    assert ships_below(request_, choice.AT) and not ships_below(request_, (28.7, 5.7))


def flat(value):
    """The arrays within tuples of tuples."""
    return [part for each in value for part in flat(each)] if isinstance(value, tuple) else [np.asarray(value)]


@pytest.mark.slow
def test_the_life_of_a_toy_is_that_of_its_run_looked_at_closely():
    """It stands where its tilt is beyond 170 degrees, and it slips where its contact moves."""
    cell = Map().at(28.6, 5.7)
    found, time = life(cell, None), cell.scales.time
    t = np.linspace(0, 60 / time, 12_001)
    moved = slide(cell.top, cell.state, cell.friction, t, rtol=1e-6, edge=cell.edge)
    high, half = moved.theta > np.radians(170), round(0.5 / (60 / 12_000))  # samples in half a second
    stands = next(i for i in np.flatnonzero(high) if high[i : i + half].all())
    leaves = np.flatnonzero(high)[-1]
    slips = np.flatnonzero(np.linalg.norm(moved.slip, axis=1) > 1e-9)[-1]
    assert (found.stands, found.leaves) == pytest.approx(
        moved.t[[stands, leaves]] * time, abs=0.15
    )  # it has a sample every 0.1 s
    assert found.stands < found.leaves < found.rolls < 60
    assert found.rolls == pytest.approx(moved.t[slips] * time, abs=0.11)  # it has a sample every 0.1 s
    said = of_life(SimpleNamespace(life=found, hysteresis=None))
    assert "and stands there last at" in said and "rolls without slipping" in said


@pytest.mark.slow
def test_what_stands_on_its_stem_at_the_end_does_not_come_off_it_there():
    """Without pivoting, nothing takes its spin."""
    found = life(Map(law="smoothed").at(40.0, 5.7), None)
    assert np.isfinite(found.stands) and found.end > 170 and np.isnan(found.leaves) and np.isnan(found.rolls)
    said = of_life(SimpleNamespace(life=found, hysteresis=None))
    assert "is still on it after 60 s" in said and " last at" not in said and "rolls" not in said


@pytest.mark.slow
def test_a_power_is_the_slope_of_single_runs():
    """By numpy's own regression of runs that were made one by one, and looked at closely."""
    place = (40.0, 5.7)
    own, x = fixed(Map(), place), Map().values_at(*place)
    found = {(power.law, power.quantity): power for power in powers(own, x)}
    by = np.geomspace(1 / REACH, REACH, POINTS)
    for quantity in ("spin", "mu"):
        times = []
        for each in by:
            values = tuple((name, x[name] * (each if name == quantity else 1)) for name in ("mu", "second", "slip"))
            spin = x["spin"] * (each if quantity == "spin" else 1)
            cell = replace(own, values=values).at(spin, x["tilt"])
            t = np.linspace(0, cell.t_end, 40_001)
            moved = slide(cell.top, cell.state, cell.friction, t, rtol=1e-9, edge=cell.edge)
            times.append(moved.t[np.argmax(moved.theta > np.pi / 2)])
        (slope, _), covariance = np.polyfit(np.log(by), np.log(times), 1, cov=True)
        power = found["contensou", quantity]
        assert power.runs == POINTS
        assert power.power == pytest.approx(slope, abs=2e-3)
        assert power.error == pytest.approx(np.sqrt(covariance[0, 0]), rel=0.05)


def test_a_place_is_said_with_its_units():
    found = run(Map(seconds=0.1), 28.6, 5.7)
    assert "28.6 rev/s, 5.7°, after 6 s: " in of_run(Map(), 28.6, 5.7, found)
    assert "0.3, 5.7°, after 6 s: " in of_run(Map(across="mu", across_range=(0.1, 0.5)), 0.3, 5.7, found)


def test_a_word_on_the_map_stands_on_its_own_colour_and_is_not_cut_off():
    for asked in SHIPPED:
        level, figure = recall(asked), MapFigure()
        figure.begin(asked)
        figure.show(level, "end")
        shown = [word for word in figure.words if word.visible]
        assert shown
        for word in shown:
            i, j = level.cell(word.x, word.y)
            assert listed("maps.ends")[level.end[i, j]] == word.text and 0 < i < len(level.y) - 1
            share = j / len(level.x)
            assert word.text_align == ("left" if share < 0.2 else "right" if share > 0.8 else word.text_align)


def test_what_a_sweep_brings_on_slips_in_proportion():
    """All velocities of the end of one run, with that of its contact, by the same factor."""
    one, next_one = (Map().at(spin, 5.7) for spin in (20.0, 30.0))
    ended = slide_many(one.top, one.state, one.friction, one.t_end / 4, one.edge).state_end
    brought = _brought(ended, next_one)
    before, after = (
        slide(one.top, State(*map(float, each[:10])), one.friction, [0.0], edge=one.edge) for each in (ended, brought)
    )
    by = after.omega[0, 2] / before.omega[0, 2]
    assert after.jellett[0] / before.jellett[0] == pytest.approx(by) and abs(by - 1) > 0.1
    np.testing.assert_allclose(after.slip[0], by * before.slip[0], rtol=1e-9)
