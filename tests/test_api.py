"""What a user of the package meets: one or many, starts that cannot be, parts of a Trajectory, executors."""

import re
from concurrent.futures import ProcessPoolExecutor
from importlib.metadata import version
from types import SimpleNamespace
from typing import get_args

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import tippe_core
from tippe_core import (
    PRESETS,
    Constants,
    Contensou,
    Coulomb,
    Gliding,
    Rolling,
    SmoothedCoulomb,
    State,
    Top,
    TopError,
    TruncatedSphere,
    Viscous,
    allowed_shares,
    f,
    glide,
    grip,
    outcome,
    roll,
    slide,
    slide_many,
    spinning_modes,
    steady_states,
    strongest_friction,
    thresholds,
    tielines,
)
from tippe_core.motion.crowding import midpoints

PAPER, EDGE, MOTION = Top.paper(), TruncatedSphere.paper().edge, Constants(7.0, 10.0, 27.0)
START = State(0.1, 0, 0, 8.8)


def test_the_version_is_that_of_the_package():
    assert tippe_core.__version__ == version("tippe-top-explorer")


def test_states_and_tops_of_many_motions():
    """Arrays as fields, lists and namespaces are the same motions."""
    tilts, a = np.array([0.1, 0.4, 0.9]), np.array([[0.07], [0.2]])
    as_arrays = slide_many(Top(a, 0.399, 0.408), State(tilts, 0, 0, 9.0), Viscous(0.3), 5.0)
    one_by_one = slide_many(np.array([[Top(x, 0.399, 0.408)] for (x,) in a], dtype=object),
                            [State(t, 0, 0, 9.0) for t in tilts], Viscous(0.3), 5.0)  # fmt: skip
    assert as_arrays.theta_end.shape == (2, 3)
    np.testing.assert_array_equal(as_arrays.theta_end, one_by_one.theta_end)
    alone = slide(Top(0.2, 0.399, 0.408), State(0.9, 0, 0, 9.0), Viscous(0.3), [0, 5.0])
    assert as_arrays.theta_end[1, 2] == pytest.approx(alone.theta[-1], abs=1e-4)


@pytest.mark.parametrize("use", [
    lambda many, tops: slide(PAPER, many, Viscous(0.3), [0, 1]),
    lambda many, tops: slide(tops, START, Viscous(0.3), [0, 1]),
    lambda many, tops: glide(PAPER, many, [0, 1]),
    lambda many, tops: roll(PAPER, None, [0, 1], many),
    lambda many, tops: outcome(PAPER, many),
    lambda many, tops: roll(tops, MOTION, [0, 1]),
])  # fmt: skip
def test_where_one_is_meant_many_are_refused(use):
    with pytest.raises(TopError) as refused:
        use(State(np.array([0.1, 0.2]), 0, 0, 9.0), Top(np.array([0.07, 0.08]), 0.4, 0.41))
    assert refused.value.code == "many"


def test_fields_of_many_broadcast_or_are_refused():
    with pytest.raises(TopError, match="broadcast"):
        State([0.1, 0.2], [0, 0, 0], 0, 9.0)
    with pytest.raises(TopError):
        Top(["a", "b"], 0.4, 0.4)


def test_thresholds_of_many_are_those_of_each():
    a, I1 = np.array([[0.07], [-0.2], [0.0]]), np.array([0.3, 0.399, 0.6])
    many = thresholds(Top(a, I1, 0.408))
    for place in np.ndindex(3, 3):
        one = thresholds(Top(a[place[0], 0], I1[place[1]], 0.408))
        assert many.group[place] == one.group
        for pole in ("upright", "inverted"):
            change, alone = getattr(many, pole), getattr(one, pole)
            assert change.stable[place] == alone.stable
            np.testing.assert_equal(change.spin[place], alone.spin)
            assert change.holds(2.0)[place] == alone.holds(2.0)
    with pytest.raises(TopError, match="I3"):
        thresholds(Top(0.07, np.array([0.4, 0.1]), 0.408))


@pytest.mark.parametrize("top, state, friction", [
    (PAPER, [0.1, 0.2], Coulomb(0.3)), (PAPER, [{"theta": 0.1}], Coulomb(0.3)), (PAPER, START, [0.3, 0.4]),
    (PAPER, START, ["Coulomb"]), ([PAPER, None], START, Coulomb(0.3)), (PAPER, None, Coulomb(0.3)),
])  # fmt: skip
def test_a_mistake_of_the_caller_raises_at_once(top, state, friction):
    with pytest.raises(TopError) as refused:
        slide_many(top, state, friction, 1.0)
    assert refused.value.code == "wrong-kind"


def test_a_field_that_is_missing_is_named():
    with pytest.raises(TopError, match=r"theta_dot"):
        slide_many(PAPER, SimpleNamespace(theta=0.1, thetadot=0, omega2=0, omega3=9.0), Coulomb(0.3), 1.0)


def test_each_refused_cell_has_its_reason():
    """The code of the error that the single motion raises, or of the event that ended it."""
    tops = SimpleNamespace(a=[0.07, 1.5, 0.07, 0.07], I1=0.399, I3=[0.408, 0.408, 0.9, 0.408])
    laws = SimpleNamespace(mu_k=[0.3, 0.3, 0.3, 50.0])
    found = slide_many(tops, START, laws, [1.0, 1.0, 1.0, 1.0])
    assert list(found.end == "refused") == [False, True, True, True]
    assert list(found.reason) == ["", "too-high", "too-flat", "too-strong"]
    for i in range(1, 4):
        with pytest.raises(TopError) as error:
            slide(Top(tops.a[i], tops.I1, tops.I3[i]), START, Coulomb(laws.mu_k[i]), [0, 1])
        assert error.value.code == found.reason[i]
    bowl = (np.sin(1.4), -np.cos(1.4), 0.0)  # of a sphere that ends at 1.4 rad
    ended = slide_many(PAPER, State(1.0, 2.0, 0, 1.0), Viscous(0.3), 5.0, edge=bowl)
    assert (ended.end, ended.reason) == ("refused", "beyond-rim")


@pytest.mark.parametrize("landing", ["stop", "plastic"])
def test_one_and_many_fly_alike(landing):
    state = State(2.2, 0, 0, 12.0)
    one = slide(PAPER, state, Coulomb(0.3), np.linspace(0, 5, 501), edge=EDGE, landing=landing)
    many = slide_many(PAPER, state, Coulomb(0.3), 5.0, EDGE, rtol=1e-9, landing=landing)
    assert many.hops == sum(what == "lifts off" for _, what in one.events) > 0
    assert (one.events[-1][1] == "lifts off" and len(one) < 501) == (landing == "stop")
    assert (many.end, many.reason) == ("refused", "lifts-off") if landing == "stop" else many.reason == ""
    assert many.state_end.theta == pytest.approx(one.theta[-1], abs=0.2 if landing == "stop" else 1e-5)


def test_a_start_in_flight_goes_on_only_where_it_flies():
    state = State(2.8, 0.1, -0.5, -9.0)
    stopped, flying = (slide_many(PAPER, state, Viscous(0.3), 1.0, EDGE, landing=how) for how in ("stop", "plastic"))
    assert slide(PAPER, state, Viscous(0.3), [0, 1.0], edge=EDGE, landing="stop").events == ((0.0, "lifts off"),)
    assert (stopped.end, stopped.reason, stopped.theta_end) == ("refused", "lifts-off", pytest.approx(2.8, abs=1e-12))
    assert flying.reason == "" and flying.theta_end != pytest.approx(2.8, abs=1e-3)


def test_at_the_threshold_itself_as_one_below_it():
    change = thresholds(PAPER).upright
    assert change.stable == "below" and change.holds(change.spin) and not change.holds(np.nextafter(change.spin, 99))


def test_another_executor_gives_the_same_numbers():
    starts = State(np.linspace(0.05, 1.5, 40), 0, 0, 9.0)
    mine, seen = slide_many(PAPER, starts, Coulomb(0.3), 3.0, EDGE), []
    with ProcessPoolExecutor(2) as processes:
        theirs = slide_many(PAPER, starts, Coulomb(0.3), 3.0, EDGE, executor=processes, progress=seen.append)
        with pytest.raises(ZeroDivisionError):
            slide_many(PAPER, starts, Coulomb(0.3), 3.0, EDGE, executor=processes, progress=lambda done: 1 / 0)
    for name in ("theta_end", "heat", "time_90", "end", "reason"):
        np.testing.assert_array_equal(getattr(mine, name), getattr(theirs, name))
    assert seen[-1] == 1 and np.all(np.diff(seen) > 0)


def test_the_time_of_theta_counts_from_the_start():
    """Also alone, and as one number; the Trajectory starts at times[0]."""
    rolling, times = Rolling(PAPER, MOTION), np.array([0.0, 5.0, 40.0])
    together = rolling.theta(times)
    assert [rolling.theta(t) for t in times] == list(together)
    assert rolling.theta([5.0])[0] == together[1] == rolling(times).theta[1]
    np.testing.assert_array_equal(rolling(times + 7).theta, rolling(times).theta)
    np.testing.assert_array_equal(rolling.theta(times.reshape(3, 1)).ravel(), together)
    tilt = rolling.theta(0.1)
    assert f(tilt, PAPER, MOTION) == pytest.approx(
        ((rolling.theta(0.1 + 1e-5) - rolling.theta(0.1 - 1e-5)) / 2e-5) ** 2, rel=1e-6)  # fmt: skip


def test_parts_of_a_trajectory():
    moved = slide(PAPER, State(2.2, 0, 0, 12), Coulomb(0.3), np.linspace(0, 5, 51), edge=EDGE)
    part = moved[10:20]
    assert len(moved) == 51 and len(part) == 10 and part.t[0] == moved.t[10]
    np.testing.assert_array_equal(part.energy, moved.energy[10:20])
    assert all(t <= part.t[-1] for t, _ in part.events) and moved[:].events == moved.events
    np.testing.assert_array_equal(moved[moved.theta > 2.5].theta, moved.theta[moved.theta > 2.5])
    np.testing.assert_array_equal(moved[[0, 3]].t, moved.t[[0, 3]])
    for rows in (3, slice(0, 0)):
        with pytest.raises(TopError):
            moved[rows]


def test_the_state_at_a_time_goes_on_as_the_motion_does():
    times = np.linspace(0, 4, 401)
    moved = slide(PAPER, START, Viscous(0.3), times, rtol=1e-11)
    again = slide(PAPER, moved.at(2.0), Viscous(0.3), times[200:], rtol=1e-11)
    np.testing.assert_allclose(again.theta, moved.theta[200:], rtol=0, atol=1e-8)
    np.testing.assert_allclose(again.com, moved.com[200:], rtol=0, atol=1e-8)
    assert moved.at(2.005).theta == pytest.approx(moved.theta[200:202].mean(), abs=1e-12)
    assert moved.at(2.0).z is None
    flies = slide(PAPER, State(0.6, 0.4, 1.0, 9.0, vx=0.3, z=1.6, vz=0.5), Viscous(0.3), times[:150], rtol=1e-11)
    again = slide(PAPER, flies.at(0.4), Viscous(0.3), times[40:150], rtol=1e-11)
    np.testing.assert_allclose(again.com, flies.com[40:], rtol=0, atol=1e-8)
    with pytest.raises(TopError, match="0 to 4"):
        moved.at(4.1)


def test_a_motion_ends_where_another_part_of_the_body_touches():
    """No point of the body is below the table before; the motion without a profile is the same until then."""
    body = next(preset.shape for preset in PRESETS if preset.name == "Disc on a peg")
    profile, times = body.profile(200) / body.R, np.linspace(0, 2, 2001)
    start = State(np.radians(89.0), 3.0, 0, 0.0)
    free = slide(body.top, start, Viscous(0.3), times, edge=body.edge)
    held = slide(body.top, start, Viscous(0.3), times, edge=body.edge, profile=profile)
    time, what = held.events[-1]
    assert what == "another part touches" and held.t[-1] < time < times[-1] and len(held) < len(free)
    np.testing.assert_array_equal(held.theta, free.theta[: len(held)])
    turns = np.linspace(0, 2 * np.pi, 73)
    points = np.array([[r * np.cos(turn), r * np.sin(turn), z + body.top.a] for r, z in profile for turn in turns])
    heights = [
        Rotation.from_quat(q).apply(points)[:, 2].min() + z
        for q, z in zip(free.quaternion, free.com[:, 2], strict=True)
    ]
    assert min(heights[: len(held)]) > -2e-3 > heights[len(held)] - 1e-3


def test_a_profile_is_checked():
    with pytest.raises(TopError, match=re.escape("Array(k, 2)")):
        slide(PAPER, START, Viscous(0.3), [0, 1], profile=[1.0, 2.0])
    cone = next(preset.shape for preset in PRESETS if preset.name == "Wooden cone")
    with pytest.raises(TopError, match=re.escape("Shape.profile(n) / Shape.R")):  # that of Shape.profile is in m
        slide(cone.top, START, Viscous(0.3), [0, 1], profile=cone.profile(200))


def test_what_needs_the_table_refuses_a_top_in_flight():
    above = State(0.5, 0.0, 0.0, 10.0, z=2.0)
    for act in (grip, outcome, lambda top, state: roll(top, None, [0.0, 1.0], state),
                lambda top, state: glide(top, state, [0.0, 1.0])):  # fmt: skip
        with pytest.raises(TopError, match="In flight"):
            act(PAPER, above)


@pytest.mark.parametrize("name", ["executor", "progress"])
def test_many_runs_name_what_cannot_compute_or_hear_them_before_they_begin(name):
    with pytest.raises(TopError) as caught:
        slide_many(PAPER, START, Viscous(0.3), [1e9] * 9, **{name: "x"})
    assert caught.value.name == name


@pytest.mark.parametrize("top", [PAPER, Top(-0.5, 0.2, 0.3), Top(0.9, 0.01, 0.02), Top(-3.0, 2.0, 1.0)])
def test_the_strongest_friction_is_the_minimum(top):
    """Of the printed expression, on a grid as fine as rounding allows around its smallest value."""
    low, high = 1e-3, np.pi - 1e-3
    for _ in range(6):
        theta = np.linspace(low, high, 20_001)
        s, c = np.sin(theta), np.cos(theta)
        values = (top.I1 + (top.a * s) ** 2) / (abs(top.a * (1 - top.a * c)) * s)
        i, step = int(values.argmin()), theta[1] - theta[0]
        low, high = theta[i] - 3 * step, theta[i] + 3 * step
    assert strongest_friction(top) == pytest.approx(values.min(), rel=1e-13)


@pytest.mark.parametrize("a", [1e-300, -1e-160, 1e-30, -1e150])
def test_the_strongest_friction_of_an_extreme_top(a):
    """I1/|a| at the equator where a is minute; 2 I1^(1/2)/|a| next to a pole where it is huge."""
    least = 0.4 / abs(a) if abs(a) < 1 else 2 * np.sqrt(0.4) / abs(a)
    assert strongest_friction(Top(a, 0.4, 0.41)) == pytest.approx(least, rel=1e-12)


def test_shared_arrays_cannot_be_written():
    for part in midpoints(32):
        with pytest.raises(ValueError, match="read-only"):
            part[0] = 0.0


def test_of_modes_that_grow_alike_the_precession_comes_first():
    """The rate at which a fast top that rolls precesses, and no jump along the spins."""
    top, spins = Top(-0.2, 0.3, 0.4), np.linspace(3.0, 40.0, 200)
    modes = np.array([spinning_modes(top, Coulomb(0.3), spin) for spin in spins])
    rates = np.abs(modes[:, 0].imag)
    assert np.abs(modes.real).max() < 1e-9 and np.all(np.abs(np.diff(rates)) < 0.1 * rates[:-1])
    moved = roll(top, None, np.linspace(0, 400, 4001), State(1e-3, 0, 0, 40.0))
    assert np.polyfit(moved.t, moved.phi, 1)[0] == pytest.approx(rates[-1], rel=1e-5)


# ---- the traps that there were ----


def test_a_fast_mode_of_the_slip_hides_none_that_grows():
    """Next to the pole's threshold, with a patch so small that the slip decays at 1e8."""
    I = 0.399 + 1.07**2
    most = 2 * np.sqrt(0.07 / I) * I / (0.408 + 1.07)
    for radius, share in ((1e-8, 0.9), (1e-7, 0.999)):
        modes = spinning_modes(Top.paper(), Contensou(0.3, radius), share * most, inverted=True)
        assert modes[0].real == modes.real.max() > 0.005


def test_any_law_is_a_friction():
    assert {*get_args(tippe_core.Friction)} == {Coulomb, Viscous, SmoothedCoulomb, Contensou}


@pytest.mark.parametrize(
    "start", [State(1.0, 1.5, 0.4, 3.0), State(2.0, -1.0, 0.3, 2.0, phi=0.7), State(1.5, 0.0, 1.0, 0.5)]
)
def test_rolling_and_gliding_note_when_they_pass_90_degrees(start):
    """Where the samples' theta - 90 degrees changes its sign, and as slide() without friction locates it."""
    times = np.linspace(2.0, 62.0, 60001)
    rolling, gliding = roll(PAPER, None, times, start), glide(PAPER, start, times)
    for moved in (rolling, gliding):
        after = np.flatnonzero(np.diff(np.sign(moved.theta - np.pi / 2)))
        passed = np.array([t for t, name in moved.notes if name == "theta passes 90 degrees"])
        assert len(passed) == len(after) and len(after) != 1
        assert np.all((moved.t[after] <= passed) & (passed <= moved.t[after + 1]))
        assert moved.time_90 == passed[0] if len(passed) else np.isnan(moved.time_90)
    slid = slide(PAPER, start, Viscous(0.0), times, rtol=1e-12)
    if gliding.events == ():
        np.testing.assert_allclose([t for t, _ in slid.notes], [t for t, _ in gliding.notes], rtol=0, atol=1e-7)


def test_very_many_passages_are_not_listed():
    start = State(1.4, 1.0, 0.2, 1.0)
    moved = roll(PAPER, None, [0.0, 1e9], start)
    assert 1000 < len(moved.notes) <= 10_000 and moved.time_90 == roll(PAPER, None, [0.0, 50.0], start).time_90


def test_motions_tell_their_constants():
    rolling = Rolling(PAPER, MOTION)
    assert (rolling.K_J, rolling.K_R) == (7.0, 10.0) and rolling.E == pytest.approx(27.0, abs=1e-14)
    gliding = Gliding(PAPER, START)
    moved = gliding(np.linspace(0, 9, 10))
    np.testing.assert_allclose(moved.L_z, gliding.L_z, rtol=1e-13)
    np.testing.assert_allclose(moved.L_3, gliding.L_3, rtol=1e-13)
    np.testing.assert_allclose(
        moved.energy - moved.ledger.translation + moved.velocity[:, 2] ** 2 / 2, gliding.E, rtol=1e-12
    )


def test_what_is_computed_cannot_be_written_and_what_is_given_stays_the_callers():
    K_J = np.linspace(1.0, 7.0, 4)
    for part in (*vars(tielines(PAPER, K_J, 10.0, 0.5)).values(), *steady_states(PAPER, 2.0)):
        with pytest.raises(ValueError, match="read-only"):
            part[0] = part[1]
    K_J[0] = 2.0


def test_numbers_give_a_number():
    found = [allowed_shares(a, 0.399, 0.408, 10.0, 0.5) for a in (0.07, np.array([0.07]))]
    assert isinstance(found[0], float) and found[0] == found[1][0] == pytest.approx(0.789, abs=5e-4)


@pytest.mark.slow
def test_a_cluster_gives_the_same_numbers():
    """Two processes of dask.distributed: the same to the last bit, with progress, and stopped by it."""
    distributed = pytest.importorskip("distributed", reason="dask.distributed is not installed")
    starts, seen = State(np.linspace(0.05, 1.5, 80), 0, 0, 9.0), []
    here = slide_many(PAPER, starts, Contensou(0.3, 0.02), 3.0, EDGE)
    how = {"n_workers": 2, "threads_per_worker": 1, "processes": True, "host": "127.0.0.1", "dashboard_address": None}
    with distributed.LocalCluster(**how) as cluster, distributed.Client(cluster) as client:
        executor = client.get_executor()
        there = slide_many(PAPER, starts, Contensou(0.3, 0.02), 3.0, EDGE, executor=executor, progress=seen.append)
        with pytest.raises(ZeroDivisionError):
            slide_many(PAPER, starts, Contensou(0.3, 0.02), 3.0, EDGE, executor=executor, progress=lambda done: 1 / 0)
    for name in ("theta_end", "heat", "time_90", "time_stem", "F_z_least", "end", "reason"):
        np.testing.assert_array_equal(getattr(here, name), getattr(there, name))
    np.testing.assert_array_equal([*here.state_end], [*there.state_end])
    assert seen[-1] == 1 and np.all(np.diff(seen) > 0)
