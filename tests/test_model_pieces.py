"""Pieces of the model, each against what it stands for: where no other test would notice that one is wrong."""

import math
from dataclasses import replace
from itertools import pairwise
from types import MappingProxyType, SimpleNamespace

import numpy as np
import pytest
from scipy.optimize import least_squares
from scipy.stats import chi2
from test_measured_errors import TRUE, filmed

from app.model import life, side_by_side, story, telling
from app.model.build.builder import Draft
from app.model.build.dimensions import changed, handles, nearest
from app.model.build.inside import filled, with_inside
from app.model.build.measures import measures
from app.model.events import happened
from app.model.explorer import Explorer
from app.model.lab.wells import Interval, well
from app.model.lesson import lesson, runs
from app.model.maps import body, steady
from app.model.maps.maps import OWN, Map
from app.model.maps.rates import _grown
from app.model.measured import known
from app.model.measured.cells import MeasuredError, cells_of
from app.model.measured.data import Data, Series, settled
from app.model.measured.fit import Problem, _judged
from app.model.measured.motion import _axis_seen, _between
from app.model.measured.names import likely
from app.model.measured.remembered import checked
from app.model.measured.shown import shown
from app.model.measured.starts import FIRST, scattered, starts
from app.model.measured.table import PACKED, read, text_inside
from app.model.measured.work import part_of
from app.model.phases import Phase, Samples, phases
from app.model.pool import TURN, Pool
from app.model.roll import slipping as slips
from app.model.roll.portraits import _arc
from app.model.roll.slipping import slipping
from app.model.run import motion_on
from app.model.runs import Run
from app.model.scene import solve
from app.model.setup import start_of
from app.model.start import Start
from app.model.stretches import EDGE, rolled
from app.model.votes import desk
from app.model.votes.classroom import LASTS
from app.text import say
from tippe_core import (
    PRESETS,
    Constants,
    Lathe,
    State,
    Top,
    TruncatedSphere,
    pole_constants,
    slide,
    spinning_modes,
    steady_states,
)

SHAPES = {preset.name: preset.shape for preset in PRESETS}


def dimension(shape, name):
    return next(each for each in Draft(shape=shape).dimensions if each.name == name)


# ---- a body's section ----


def test_the_handle_of_a_turned_tops_radius_is_in_the_middle_of_its_peg():
    shape = Lathe(R=0.005, density=700.0, points=((0.0048, -0.0014), (0.018, 0.01), (0.003, 0.045)))
    at, (radius, height) = np.array(handles(shape)["R"]), shape.points[0]
    assert np.hypot(*at) == pytest.approx(shape.R)
    assert np.hypot(*(at - (radius, height))) == pytest.approx(np.hypot(*(at - (0.0, -shape.R))))


@pytest.mark.parametrize(
    ("name", "key", "wanted", "low", "high"),
    [
        ("Wooden cone", "r2", 0.0, 4.0, 4.0),  # the stem is as thick as that
        ("Disc on a peg", "density", 1e9, 1e8, 1e9),
    ],
)
def test_the_nearest_that_is_possible_is_where_the_body_ends_to_be_one(name, key, wanted, low, high):
    assert low <= nearest(SHAPES[name], dimension(SHAPES[name], key), wanted) <= high


def test_there_is_no_nearest_beyond_a_value_that_is_the_last_possible():
    shape = SHAPES["Wooden cone"]
    last = nearest(shape, dimension(shape, "r"), 150.0)
    at_its_end = changed(shape, "r", last / 1000)
    assert nearest(at_its_end, dimension(at_its_end, "r"), 150.0) is None


def test_the_handle_of_a_stems_radius_is_on_the_stem():
    shape = TruncatedSphere.paper()
    x, z = handles(shape)["r"]
    assert x == shape.r and shape.c < z < shape.c + shape.l


def test_a_piece_of_a_turned_top_is_named_by_its_heights_in_mm():
    shape = Lathe(R=0.005, density=(7e3, 1e3, 700.0), points=((0.005, 0.0), (0.018, 0.01), (0.003, 0.045)))
    assert [dict(dimension(shape, f"density {i}").numbers) for i in (1, 2)] == [
        {"low": 0.0, "high": 10.0},
        {"low": 10.0, "high": 45.0},
    ]


def test_dimension_lines_begin_and_end_where_the_solid_does():
    """A rounding is measured from the centre of its circle, a disc at half its thickness."""
    shape = TruncatedSphere(R=0.016, c=0.0082, l=0.0192, r=0.0032, M=0.0115, rounding=0.002,
                            disc=0.006, thickness=0.002, height=0.004, hole=0.004, depth=0.003)  # fmt: skip
    at = {each.name: (np.array(each.start), np.array(each.end)) for each in measures(shape)}
    start, end = at["rounding"]
    assert np.hypot(*(end - start)) == pytest.approx(0.002)
    assert start == pytest.approx((-(0.0032 - 0.002), 0.0082 + 0.0192 - 0.002))  # below its end, within its side
    edge = at["R"][1]
    assert np.hypot(*edge) == pytest.approx(0.016) and edge[0] < 0 and edge[1] < 0  # on the left of what rolls
    (left, top), (beside, floor) = at["depth"]
    assert left == beside == -0.004 and top - floor == pytest.approx(0.003)
    (_, low), (_, high) = at["thickness"]
    assert high - low == pytest.approx(0.002) and low == pytest.approx(0.004 - 0.016)
    assert [z for _, z in at["disc"]] == pytest.approx([(low + high) / 2] * 2)


def test_a_hole_ends_above_a_disc_however_thick_it_is():
    shape = filled(TruncatedSphere.paper(), "disc")
    thick = with_inside(shape, thickness=0.8 * (shape.c + shape.R - shape.height), disc=0.3 * shape.R)
    both = filled(thick, "both")
    assert both.hole > both.r and both.floor > both.height + both.thickness - both.R


def test_a_stem_that_a_map_lengthens_begins_where_it_did():
    """Its foot, of radius 0.5, is on a ball of radius 1; a tenth of the way up it is a tenth of the way up."""
    foot = math.sqrt(0.75)
    own = np.array([[0.0, -1.0], [0.8, 0.6], [0.5, foot], [0.5, foot + 0.05], [0.5, foot + 0.5], [0.0, foot + 0.5]])
    drawn = body.outline_of(SimpleNamespace(across="spin", up="stem", body=OWN),
                            SimpleNamespace(edge=(0.45, 2.0, 0.05)), own)  # fmt: skip
    assert drawn[:, 0].tolist() == own[:, 0].tolist()
    assert drawn[:, 1] == pytest.approx([-1, 0.6, foot, foot + (2.05 - foot) / 10, 2.05, 2.05])


# ---- the lesson ----


def answer(name):
    step, explorer = lesson.OF_NAME[name], Explorer()
    explorer.set(**(step.inputs(explorer.top) if step.inputs else {}))
    return step.answer(explorer.scene), explorer.scene


def test_the_last_tie_is_that_of_the_pole():
    found, scene = answer("ties")
    heights = np.concatenate([np.asarray(curve.y, float).ravel() for curve in found.picture.curves])
    assert np.nanmax(heights) == pytest.approx(found.numbers["pole"], rel=1e-6)
    assert scene.constants.K_J < found.numbers["pole"]
    assert found.numbers["inner"] < found.numbers["middle"] < found.numbers["outer"]
    lost, _ = answer("slip")
    heights = np.concatenate([np.asarray(curve.y, float).ravel() for curve in lost.picture.curves])
    assert np.nanmax(heights) == pytest.approx(found.numbers["pole"], rel=1e-6)


def test_what_slips_begins_with_the_spin_that_it_was_given():
    found, _ = answer("proof")
    slips = next(curve for curve in found.picture.curves if curve.key == "slips")
    assert slips.y[0] == pytest.approx(runs.proof().spin, rel=1e-9)
    assert slips.y[-1] == pytest.approx(found.numbers["slipped"], abs=0.2)
    run = runs.proof()
    turned = Constants.from_state(run.setup.top, np.pi, 0.0, 0.0, run.jellett / run.setup.turns)
    assert turned.K_J == pytest.approx(run.start.K_J, rel=1e-9)


def test_what_friction_takes_is_in_percent_of_what_was_there():
    found, _ = answer("arms")
    assert next(curve for curve in found.picture.curves if curve.key == "L_3").y[0] == pytest.approx(100)
    # a force at a point takes a times as much from L_z; a patch takes a little beside
    assert found.numbers["share"] == pytest.approx(found.numbers["ideal"], rel=0.1)


def test_the_height_of_a_motion_at_the_pole_is_drawn_as_far_as_the_pole():
    K_J = (1 - 1e-5) * float(pole_constants(Top.paper(), 10.0)[1])
    scene = solve(Top.paper(), K_J, 10.0, 0.0, share=1.0)
    found = lesson.OF_NAME["turning"].answer(scene)
    curve = found.picture.curves[0]
    assert 179.5 < curve.x.max() < 180 and np.all(np.isfinite(curve.y))


def test_nutations_are_timed_in_seconds():
    scene = solve(Top.paper(), 7.0, 10.0, 0.5, share=0.5)
    _, rows = runs.nutations(scene, 3.0)
    assert rows[-1, 0] == pytest.approx(3 * scene.rolling.period * math.sqrt(scene.scales.R / scene.scales.g))


# ---- a run ----


def test_a_start_that_rolls_has_its_spin_in_turns_a_second():
    start = Start()
    spin = 3.0 * math.sqrt(start.shape.scales.g / start.shape.scales.R)  # rad/s
    assert start.setup(State(0.5, 0.0, 0.0, 3.0)).spin * 2 * math.pi == pytest.approx(spin)


@pytest.mark.parametrize(("name", "value"), [("E", 1.0), ("a", 1.2)])
def test_the_nearest_that_is_offered_is_possible_and_nearly_the_last(name, value):
    explorer = Explorer()
    explorer.set(**{name: value})
    (near,) = explorer.scene.nearest.values()
    for asked, refused in ((near, False), (near + (value - near) / 100, True)):
        explorer.set(**{name: asked})
        assert bool(explorer.scene.messages) == refused


def phases_of(t, tilt):
    n = len(t)
    return phases(Samples(t, tilt, np.full(n, "ball"), np.full(n, False), np.full(n, 20.0), np.ones(n), (), 0.2))


def test_a_passage_begins_when_the_side_is_passed_between_two_samples():
    t = np.linspace(0, 6, 601)
    tilt = np.interp(t, [0, 1.003, 2.003, 6], [20, 20, 175, 175])
    found = phases_of(t, tilt)
    over = next(phase for phase in found if phase.kind == "over")
    assert over.start == pytest.approx(1.003 + 70 / 155, abs=1e-6)


def test_a_rise_ends_where_it_stays_unless_that_is_at_the_very_end():
    t = np.linspace(0, 6.2, 621)
    tilt = np.interp(t, [0, 5, 6.2], [20, 80, 80])
    found = phases_of(t, tilt)
    assert found[0].kind == "rises" and 4 < found[0].end < 5.6


def test_it_is_past_its_side_each_time_that_it_goes_there():
    t = np.linspace(0, 12, 1201)
    found = phases_of(t, np.interp(t, [0, 2, 4, 6, 8, 10, 12], [20, 160, 160, 20, 20, 160, 160]))
    assert [phase.start for phase in found if phase.kind == "over"] == pytest.approx([1, 9])


def test_what_swings_and_ends_a_little_lower_has_not_sunk():
    """Its mean falls by 11 degrees, but that of the second half of the way is only some 2 below that of the first."""
    t = np.linspace(0, 12, 2401)
    mean = np.interp(t, [0, 1, 1.5, 10, 10.6, 12], [80, 80, 77, 76, 69, 69])
    assert [phase.kind for phase in phases_of(t, mean + 6 * np.sin(8 * t))] == ["swings"]


def test_a_life_is_shown_until_some_time_after_it_rolls():
    moved = SimpleNamespace(regime=np.array(["slip"] * 5 + ["roll"] * 5), t=10.0 * np.arange(10), events=())
    assert life._end(moved, 2.0, ended=False) == pytest.approx(2 * 50 + life.AFTER)


def test_the_words_of_a_phase_are_of_its_first_and_its_last_sample():
    told = SimpleNamespace(motion=SimpleNamespace(seconds=np.arange(9) / 10))
    assert story._Told._here(told, Phase("rolls", 0.2, 0.4)) == slice(2, 5)


def test_a_tilt_between_two_numbers_is_told_by_its_middle():
    motion = SimpleNamespace(tilt=np.array([10.48, 10.52]), ended_at=None)
    assert story._caption(motion) == say("lab.caption.stays_near", mean=10.5)


def test_the_first_touch_of_a_stem_is_an_event_unless_it_stands_on_it_at_once():
    for touches, codes in ((3.0, ["stands-on-stem"]), (2.0, ["stem", "stands-on-stem"])):
        motion = SimpleNamespace(pushes=(), cuts={}, phases=(Phase("stands-on-stem", 3.02, 5.0),), ended_at=None,
                                 touches=touches, start=SimpleNamespace(top=Top.paper()))  # fmt: skip
        assert [code for _, code in happened(motion)] == codes


def test_what_is_said_of_tables_together_is_by_their_numbers():
    """0.3 % of the energy are not worth a word, 1 % are; what it leaves its first tilt by is rounded up."""

    def said(left, lost):
        curves = np.array([[0, 10, 0, left, lost, 0, 0, 0]])
        return side_by_side.of_all({
            name: SimpleNamespace(curves=curves, tilt=np.array([10.0, *tilts]), pushes=())
            for name, tilts in (("rough", (12.31, 9.9)), ("ice", (9.0, 10.1)))})[1]  # fmt: skip

    assert say("lab.three.keep") in said(99.7, 0.3)
    assert say("lab.three.grip", lost=0.001, start=0.1) in said(0.099, 0.001)
    assert say("lab.three.near", rough_by=2.4, ice_by=1.0) in said(99.7, 0.3)


@pytest.mark.parametrize("toy", ["The paper's tippe top", "Disc on a peg"])
def test_the_share_that_a_grip_takes_is_of_the_energy_above_rest(toy):
    """Let go with its mass centre at rest and spinning about its own axis; that of a disc is lowest turned over."""
    motion = motion_on("rough", start_of(toy, 10.0, 20.0, 0.3))
    top, state = motion.start.top, motion.start.state
    energy = top.I3 * state.omega3**2 / 2 + abs(top.a) - top.a * math.cos(state.theta)
    told = telling._table(motion)
    assert told["gripped"] == pytest.approx(motion.lost / energy)
    rate = math.sqrt(motion.start.scales.g / motion.start.scales.R)  # rad/s
    assert told["samples"]["spin"][0] * 2 * math.pi == pytest.approx(rate * motion.trajectory.omega[0, 2])


def test_a_well_is_shown_as_high_as_its_bead_comes():
    top = Top.paper()
    one = Interval(0.0, 0.0, 5.0, steady_states(top, 5.0))
    assert well(top, one, np.array([0.0])).high < 100 and well(top, one, np.array([0.0, 1e4, 3.0])).high == 1e4


def test_an_arc_is_drawn_a_little_beyond_its_track_on_both_sides():
    assert _arc(np.array([3.0, 3.5, 4.0]), 1.0) == pytest.approx((2.94, 4.06))


def test_too_short_a_slip_tells_nothing(monkeypatch):
    scene, whole = solve(Top.paper(), 7.0, 10.0, 0.5, share=1.0), slips.slide
    monkeypatch.setattr(slips, "NODS", 1)
    monkeypatch.setattr(slips, "slide", lambda *given, **options: whole(*given, **options)[: slips.SAMPLES])
    state, period = slips.at_the_end(scene), scene.rolling.period
    assert slips._slipping.__wrapped__(scene.top, state, 0.3, None, period) is None


def test_a_slip_is_followed_from_the_constants_of_the_motion_that_begins_it():
    scene = solve(Top.paper(), 7.0, 10.0, 0.5, share=1.0)
    found = slipping(scene)
    assert (found.K_J[0], found.K_R[0]) == pytest.approx((7.0, 10.0), rel=1e-9)


def test_windows_of_a_derivation_leave_no_gap():
    """What is trusted of each (without EDGE nodes at either end) meets what is trusted of the next."""
    found = rolled(solve(Top.paper(), 7.0, 10.0, 0.5, share=0.5))
    assert len(found) > 1
    for one, then in pairwise(found):
        assert then.t[EDGE] == pytest.approx(one.t[-1 - EDGE], abs=1e-9)
        np.testing.assert_allclose(one._L3(1.0).real, one.I3 * one.w3, rtol=1e-9)  # of its own ball, as it moves


# ---- below a map ----


def test_a_line_of_steady_motions_has_two_points_at_least():
    spin = np.array([2.0, 3.0, 4.0, 5.0, 6.0])
    lines = steady._cut(spin, 10 * spin, np.array([True, True, False, True, True]))
    assert [line.spin.tolist() for line in lines] == [[2.0, 3.0], [5.0, 6.0]]


def test_the_growth_of_a_slow_spin_is_seen_in_its_run():
    here = Map(body="Top S", law="viscous", across_range=(2.0, 16.0), seconds=25.0).at(5.0, 1.0)
    turns = 5.0 * 2 * np.pi / here.scales.angular_velocity
    (growth, *_) = spinning_modes(here.top, here.friction, turns, False).real
    assert _grown("upright", here, steady.launch(here) * 5.0, None)[1] == pytest.approx(growth, rel=0.02)


def test_runs_below_a_map_end_when_it_says(monkeypatch):
    for name, value in {"RUNS": 2, "SWEEP": 2, "_sweep": lambda own, tilt, spins, look: (spins, spins),
                        "life": lambda here, look: None}.items():  # fmt: skip
        monkeypatch.setattr(steady, name, value)
    own = Map(body="Top S", law="viscous", values=(("mu", 0.4),), across_range=(6.0, 9.0), seconds=3.0)
    found, cell = steady.bifurcation(own, (6.0, 20.0)), own.at(9.0, 20.0)
    t = np.array([0.0, *found.times]) * math.sqrt(cell.scales.g / cell.scales.R)
    moved = slide(cell.top, cell.state, cell.friction, t, edge=cell.edge)
    assert found.theta[:, 1] == pytest.approx(np.degrees(moved.theta[1:]), abs=0.05)


# ---- measured tops ----


def later(data, by):
    return Data(MappingProxyType({name: replace(each, t=each.t + by) for name, each in data.series.items()}))


def test_a_film_may_begin_late():
    data = filmed(("tilt", "spin"))
    frames = [len(shown(TRUE, later(data, by)).t) for by in (0.0, 100.0)]
    assert frames[0] == frames[1] > len(data.t)
    assert np.ptp(part_of(later(data, 100.0), 100.1, 100.4).t) == pytest.approx(0.3, abs=0.01)


def test_another_minimum_far_to_either_side_makes_a_number_unknown():
    problem, x = Problem(TRUE, filmed(("tilt", "spin"))), np.array([TRUE.values[name] for name in TRUE.free])
    for way in (-0.1, 0.1):
        others = [x + way * (np.array(TRUE.free) == "tilt")]
        assert _judged(problem, x, True, others, given_up=True).unknown == ("tilt",)


def test_a_search_tries_both_ways_of_turning_across():
    across = {float(x[TRUE.free.index("across")]) for x in starts(TRUE, filmed(("tilt", "spin")))}
    assert {-1.0, -0.3, 0.3, 1.0} <= across


def test_saved_errors_have_a_correlation_of_one_at_most():
    model = SimpleNamespace(free=("tilt", "spin"))
    said = {"values": {"tilt": 0.1, "spin": 8.0}, "sides": dict.fromkeys(model.free, (0.1, 0.1)), "unknown": (),
            "sure": True}  # fmt: skip
    assert checked(said | {"covariance": [0.01, -0.09, 1.0]}, model)["covariance"][1, 0] == -0.09
    with pytest.raises(ValueError, match="covariance"):
        checked(said | {"covariance": [0.01, -0.11, 1.0]}, model)


@pytest.mark.parametrize(("head", "code"), [("note;tilt (deg)", "no-time-column"), ("t (s);note", "nothing")])
def test_what_columns_lack_is_said_of_the_line_of_their_names(head, code):
    with pytest.raises(MeasuredError, match=code) as refused:
        settled(read("\n".join([head, *(f"{i};1" for i in range(9))])))
    assert refused.value.numbers["line"] == 1


def test_the_camera_of_a_picture_from_the_side_is_that_of_least_squares():
    random = np.random.default_rng(3)
    lean = 0.4 * np.exp(1j * np.linspace(0, 9, 60))
    up = np.sqrt(1 - np.abs(lean) ** 2)
    across = 0.05 * np.real(lean * np.exp(-0.7j)) + random.normal(0, 2e-3, 60)
    high = 0.05 * up + random.normal(0, 2e-3, 60)
    series = {name: Series(np.arange(60.0), each, 1.0) for name, each in (("axis_side", across), ("axis_up", high))}
    found = _axis_seen("axis_side", lean, up, series)

    def residuals(x):
        return np.concatenate([across - x[1] * np.real(lean * np.exp(-1j * x[0])), high - x[1] * up])

    turn, length = least_squares(residuals, (0.6, 0.05), xtol=1e-15, ftol=1e-15, gtol=1e-15).x
    assert found["axis_side"] == pytest.approx(length * np.real(lean * np.exp(-1j * turn)), abs=1e-9)
    assert found["axis_up"] == pytest.approx(length * up, abs=1e-9)


def test_starts_of_a_fit_are_scattered_within_what_was_measured():
    series = Series(np.arange(9.0), np.full(9, 0.5), 0.01)
    model = SimpleNamespace(free=("tilt",), scales=SimpleNamespace(angular_velocity=1.0), values={"tilt": 0.5})
    data = SimpleNamespace(series={"tilt": series}, handed=True)
    points = np.array(scattered(model, data))
    assert 0.5 - FIRST * 0.01 <= points.min() < 0.47 and 0.53 < points.max() <= 0.5 + FIRST * 0.01


def test_what_nothing_is_known_of_is_scattered_about_its_first_value():
    model = SimpleNamespace(free=("I1",), values={"I1": 0.5}, scales=SimpleNamespace(angular_velocity=1.0))
    points = np.array(scattered(model, SimpleNamespace(series={}, handed=True)))
    assert 0.4 <= points.min() < 0.42 and 0.58 < points.max() <= 0.6


def test_a_line_turns_by_its_slope():
    lean, up = 0.4 * np.exp(1j * np.linspace(0, 6, 20)), np.linspace(0.2, 0.9, 20)
    seen, h = np.linspace(-1, 1, 20), 1e-6
    numeric = (_between(seen, lean, up, 0.7 - h)[0] - _between(seen, lean, up, 0.7 + h)[0]) / (2 * h)
    np.testing.assert_allclose(_between(seen, lean, up, 0.7)[1], numeric, atol=1e-8)


def test_a_beginning_is_of_the_first_times():
    t = np.linspace(2.0, 4.0, 9)
    problem = SimpleNamespace(data=SimpleNamespace(series={"tilt": Series(t, t, 1.0)}))
    assert Problem.beginning(problem, 0.5).tolist() == (t <= 3.0).tolist()


def test_a_fit_begins_within_its_bounds():
    problem = SimpleNamespace(bounds=np.array([[0.0], [1.0]]), residuals=lambda x: x)
    assert all(0 < x[0] < 1 for x in Problem.best_of(problem, [np.array([-3.0]), np.array([3.0])], 2))


def test_a_full_half_turn_and_its_noise_are_radians():
    assert likely("tilt", np.array([0.1, np.pi + 0.1]), "tilt") == "rad" != likely("tilt", np.array([0.1, 4.0]), "tilt")


def test_a_chi_square_is_good_up_to_one_standard_deviation_above_its_mean():
    problem = SimpleNamespace(count=50)
    limit = chi2(50).mean() + chi2(50).std()
    assert Problem.good(problem, limit - 1e-6) and not Problem.good(problem, limit + 1e-6)


def test_a_parabola_is_straight_however_high_its_lowest_point_is():
    bounds = np.array([[-9.0], [9.0]])
    axis = np.array([2.0])
    assert known._straight(lambda x: np.array([x[0] / 2, 30.0]), np.zeros(1), axis, bounds)
    assert not known._straight(lambda x: np.array([x[0] ** 2 / 2, 30.0]), np.zeros(1), axis, bounds)


def test_where_nothing_changes_no_better_minimum_is_found():
    problem = SimpleNamespace(bounds=np.array([[-1.0], [1.0]]), residuals=lambda x: np.array([3.0]))
    error, _, better = known._far(problem, np.zeros(1), 9.0, 0, 1, np.array([0.1]), [])
    assert error == np.inf and better is None


def test_a_row_may_have_lost_its_last_separator_and_has_no_cell_too_many():
    rows = [f"{t};1.0;{t}.5" for t in range(20)]
    found = cells_of("\n".join(["t;a;b", *rows[:7], "7;1.0", *rows[8:]]))
    assert found.values.shape == (20, 3) and np.isnan(found.values[7, 2])
    with pytest.raises(MeasuredError, match="width"):
        cells_of("\n".join(["t;a;b", *rows[:7], "7;1.0;7.5;9", *rows[8:]]))


def test_a_text_that_is_too_large_is_refused_by_its_size_in_kB():
    with pytest.raises(MeasuredError) as refused:
        read("x" * 300_000)
    assert refused.value.numbers == {"size": 300, "most": 200}


def test_a_file_that_is_too_large_is_refused_by_its_size_in_MB():
    with pytest.raises(MeasuredError) as refused:
        text_inside(bytes(PACKED + 500_000))
    assert refused.value.numbers["size"] - refused.value.numbers["most"] == pytest.approx(0.5)


# ---- threads ----


def test_pieces_of_one_visitor_have_one_share_among_others():
    """Three of them, each of which works for a TURN and rests then, take no more than one that works on."""
    pool = Pool(2, "shares")
    pool._working.update({"one": 3, "other": 1})
    assert pool.rest("one") >= 2 * TURN


def test_work_lets_others_go_on_after_its_slice_and_not_before():
    gave = []
    pool = SimpleNamespace(rest=lambda page: 0.0, slice=60.0, give_way=lambda page, seconds: gave.append(seconds))
    run = Run(lambda run: None, print)
    run.enter(pool, "page", None, lambda: True)
    run.look()
    assert not gave
    run._gave_way -= 61
    run.look()
    assert gave == [0.0]


# ---- votes ----


def test_a_store_keeps_a_class_for_longer_than_it_is_open(monkeypatch):
    """A class's use is recorded late; the store may not delete it before its time."""
    asked = []
    monkeypatch.setattr(desk, "store", lambda where, lasts: asked.append(lasts))
    monkeypatch.setattr(desk, "Rooms", lambda *_: None)
    desk.Desk("a file")._opened()
    assert LASTS < asked[0] < 2 * LASTS
