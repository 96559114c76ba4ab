"""Tables in the forms in which the programs of a class write them."""

import numpy as np
import pytest

from app.model.explorer import Explorer
from app.model.measured import read as read_file
from app.model.measured.cells import MeasuredError
from app.model.measured.data import settled
from app.model.measured.names import understood
from app.model.measured.table import read, taken_as
from app.tabs.measure.measure import Measure
from app.tabs.measure.recipe import recipe
from app.text import LANGUAGES, speaking

T = np.arange(20) / 60  # s
TILT = 0.1 + 0.5 * T  # rad
SPIN = 125.0 - 10 * T  # rad/s


def table(names, *columns, between="\t", form="{:.4f}".format, end="\n"):
    rows = [between.join(map(form, row)) for row in zip(*columns, strict=True)]
    return end.join([*([between.join(names)] if names else []), *rows]) + end


def german(text):
    return text.replace(".", ",")


def clock(t, shape):
    return shape.format(h=int(23 + t // 60), m=59, s=58 + t)


CAPSTONE = "Time (s) Run #1", "Angle (rad) Run #1", "Angular Velocity (rad/s) Run #1"
# fmt: off
PROGRAMS = {
    "Capstone": "\ufeff" + german(table(CAPSTONE, T, TILT, SPIN, end="\r\n")),
    "Capstone in German": table(("Zeit (s) Lauf 1", "Winkel (rad) Lauf 1", "Winkelgeschwindigkeit (rad/s) Lauf 1"),
                                T, TILT, SPIN, between=";"),
    "Capstone with a channel": table(("Time (s) Run #1", "Angle, Ch P1 (rad) Run #1",
                                      "Angular Velocity, Ch P1 (rad/s) Run #1"), T, TILT, SPIN),
    "Logger Pro": table(('"Latest: Time (s)"', '"Latest: Theta (rad)"', '"Latest: Angular Velocity (rad/s)"'),
                        T, TILT, SPIN, between=",", form="{:g}".format),
    "Graphical Analysis": table(("Data Set 1:Time(s)", "Data Set 1:Angle(rad)", "Data Set 1:Angular Velocity(rad/s)"),
                                T, TILT, SPIN, between=","),
    "Graphical Analysis 4": table(("Run 1: Time (s)", "Run 1: Angle (rad)", "Run 1: Angular Velocity (rad/s)"),
                                  T, TILT, SPIN, between=","),
    "Capstone, copied from its table": "Run #1\tRun #1\tRun #1\tRun #2\n" + table(
        ("Time (s)", "Angle (rad)", "Angular Velocity (rad/s)", "Angle (rad)"), T, TILT, SPIN, 2 * TILT),
    "a column of words": "who;t;theta;omega\n" + "".join(
        f"Anna;{t:.4f};{a:.4f};{w:.4f}\n" for t, a, w in zip(T, TILT, SPIN, strict=True)),
    "AndroSensor's names": "".join(["theta;GYROSCOPE Z (rad/s);Time since start in ms ;YYYY-MO-DD HH-MI-SS_SSS\n", *(
        f"{a:.4f};{w:.4f};{1000 * t:.1f};2026-02-15 12:26:41:{1000 * t:03.0f}\n"
        for t, a, w in zip(T, TILT, SPIN, strict=True))]),
    "MATLAB": "% made by hand\n" + table(("% t", "theta", "omega3"), T, TILT, SPIN, between=" ", form="{:.6e}".format),
    "numpy": "# t,theta,omega3\n" + table((), T, TILT, SPIN, between=","),
    "a comment in C": "// by our logger\n" + table(("t", "theta", "omega3"), T, TILT, SPIN, between=";"),
    "a comment with ;": "; by our logger\n" + table(("t", "theta", "omega3"), T, TILT, SPIN, between=","),
    "Sensor Logger": table(("time", "seconds_elapsed", "z", "y", "x"), 1.7e18 + 1e9 * T, T, SPIN, 0 * T, 0 * T,
                           between=",", form="{:.8f}".format),
    "units behind a slash": table(("t / s", "θ / rad", "ω / s⁻¹"), T, TILT, SPIN, between=";"),
    "units as a program names them": table(("t_s", "tilt_rad", "spin_rad_per_s"), T, TILT, SPIN, between=","),
    "units in a line": "t,tilt,spin\ns,rad,rad s^-1\n" + table((), T, TILT, SPIN, between=","),
    "thousands": "t (ms);tilt (mrad);theta (rad);spin (rad/s)\n" + "".join(
        f"{1000 * t + 1000:,.1f};{1000 * a:,.2f};{a:.4f};{w:.4f}\n".translate(str.maketrans(",.", ".,"))
        for t, a, w in zip(T, TILT, SPIN, strict=True)),
    "decimal commas between commas": ",stem,,\nt,theta,omega,\n" + "".join(
        f"{t:.6E},{a:.6E},{w:.6E},\n".replace(".", ",") for t, a, w in zip(T, TILT, SPIN, strict=True)),
    "pairs between commas": "t,theta,omega\n" + "".join(
        f"{t:.4f},{a:.4f},{w:.4f}\n".replace(".", ",") for t, a, w in zip(T, TILT, SPIN, strict=True)),
    "a clock": "clock,theta,omega\n" + "".join(
        f"01:{59 + (t + 59 >= 60)}:{(59 + t) % 60:07.4f},{a:.4f},{w:.4f}\n"
        .replace(":60:", ":00:").replace("01:00", "02:00") for t, a, w in zip(T, TILT, SPIN, strict=True)),
    "a clock past midnight": "Uhrzeit;theta;omega\n" + "".join(
        f"{'23:59:59' if t < 0.2 else '00:00:00'},{t + 0.8 - (t >= 0.2):.6f};{a:.4f};{w:.4f}\n".replace(",0.", ",")
        .replace(".", ",") for t, a, w in zip(T, TILT, SPIN, strict=True)),
    "a clock with twelve hours": "time,theta,omega\n" + "".join(
        f"{'12:59:59' if t < 0.2 else '1:00:00'}{(t + 0.8) % 1:.6f} PM,{a:.4f},{w:.4f}\n".replace("590.", "59.")
        .replace("000.", "00.") for t, a, w in zip(T, TILT, SPIN, strict=True)),
    "ISO times": "timestamp,theta,omega\n" + "".join(
        f"2026-02-15T12:26:{41 + t:07.4f}Z,{a:.4f},{w:.4f}\n" for t, a, w in zip(T, TILT, SPIN, strict=True)),
}
# fmt: on


@pytest.mark.parametrize("text", PROGRAMS.values(), ids=[*PROGRAMS])
def test_a_table_is_read_as_its_program_wrote_it(text):
    data = settled(read(text))
    spin = data.series["spin"]
    np.testing.assert_allclose(spin.t - spin.t[0], T, atol=2e-4)
    assert abs(spin.t[0]) < 10  # also where a clock says when
    np.testing.assert_allclose(spin.values, SPIN, atol=1e-3)
    assert {*data.series} == ({"spin"} if "elapsed" in text else {"tilt", "spin"})
    if "tilt" in data.series:
        np.testing.assert_allclose(data.series["tilt"].values, TILT, atol=1e-4)


@pytest.mark.parametrize(("name", "unit"), [
    ("spin_rev_per_s", "rev/s"), ("spin (rev per second)", "rev/s"), ("Drehzahl in U pro min", "rpm"),
    ("ω in s⁻¹", "rad/s"), ("omega_rad_s", "rad/s"), ("tilt_deg", "deg"), ("t_s", "s"), ("RPM", "rpm"),
    ("omega_z [1/s]", "rad/s"),
    ("omega [rad·s⁻¹]", "rad/s"), ("ω3/(rad/s)", "rad/s"), ("angular velocity (°/s)", "deg/s"), ("n (1/s)", "rev/s"),
    ("Winkelgeschwindigkeit (1/s)", "rad/s"), ("t/µs", "us"), ("time (ns)", "ns"), ("spin", "")])  # fmt: skip
def test_a_unit_is_found_wherever_it_stands(name, unit):
    assert understood(name)[1] == unit


def test_of_several_runs_the_first_is_shown_and_another_can_be_chosen():
    """The second run is shorter; Capstone leaves its cells empty."""
    names = *CAPSTONE, *(name.replace("#1", "#2") for name in CAPSTONE)
    rows = [f"{t:.4f}\t{a:.4f}\t{w:.4f}\t" + (f"{t:.4f}\t{2 * a:.4f}\t{w / 2:.4f}" if i < 12 else "\t\t")
            for i, (t, a, w) in enumerate(zip(T, TILT, SPIN, strict=True))]  # fmt: skip
    found = read("\n".join(["\t".join(names), *rows]) + "\n")
    assert (found.runs, found.run) == (("Run #1", "Run #2"), "Run #1") and not found.notes
    np.testing.assert_allclose(settled(found).series["tilt"].values, TILT, atol=1e-4)
    second = settled(found.of("Run #2", "")).series
    np.testing.assert_allclose(second["tilt"].values, 2 * TILT[:12], atol=1e-4)
    np.testing.assert_allclose(second["spin"].t, T[:12], atol=1e-4)


def test_a_run_without_a_time_of_its_own_has_that_of_the_first():
    """As Capstone exports a table with one column of the time."""
    found = read(table((*CAPSTONE[:2], "Angle (rad) Run #3"), T, TILT, 2 * TILT))
    for run, size in (("Run #1", 1), ("Run #3", 2)):
        np.testing.assert_allclose(settled(found.of(run, "")).series["tilt"].values, size * TILT, atol=1e-4)


@pytest.mark.parametrize(("name", "quantity"), [
    ("Gyroscope.csv", "spin"), ("a.csv", "spin"), ("Accelerometer.csv", ""), ("Gravity.csv", "")])  # fmt: skip
def test_a_loggers_file_of_another_sensor_is_no_spin(name, quantity):
    assert [column.quantity for column in read_file(name, PROGRAMS["Sensor Logger"].encode()).columns] == [
        "", "time", quantity, "", ""]  # fmt: skip


@pytest.mark.parametrize("name", PROGRAMS)
def test_a_file_gives_what_is_written_and_what_that_is_in_si(name):
    found = read_file(name, PROGRAMS[name].encode("utf-8"))
    of = {column.quantity: column for column in found.columns if column.quantity}
    assert (of["spin"].unit, of["spin"].si[0]) == ("rad/s", pytest.approx(SPIN[0])) and of["time"].unit in ("s", "ms")
    np.testing.assert_allclose(np.diff(of["time"].si), np.diff(T), atol=2e-4)
    np.testing.assert_allclose(of["time"].values * {"s": 1, "ms": 1e-3}[of["time"].unit], of["time"].si)
    if "tilt" in of:
        np.testing.assert_allclose(of["tilt"].si, TILT, atol=1e-4)


def test_of_a_long_file_some_rows_are_read_and_an_error_is_a_sentence():
    found = read_file("long.csv", table(("t (s)", "tilt (rad)"), np.arange(40_000) / 1e3, np.ones(40_000)).encode())
    assert 1000 < len(found.lines) <= 5000 and found.columns[0].si[-1] > 39
    for data, part in (
        (b"", "nothing in this table"),
        (b"1" * 10_000_000, "lines are so long"),
        (b"PK\x03\x04", "damaged"),
    ):
        with pytest.raises(MeasuredError, match=part):
            read_file("any", data)


def test_a_comma_that_may_be_either_is_not_guessed():
    with pytest.raises(MeasuredError, match="width"):
        read("t,theta\n" + "".join(f"{i},5,2\n" for i in range(20)))


def test_the_position_angle_is_taken_as_tracker_means_it():
    """Counted from +x: of a stem that leans by 0.1 rad, 84.3 degrees."""
    found = read(
        "\tstem\nt\tθr\n" + "".join(f"{t:.6E}\t{90 - np.degrees(a):.6E}\n" for t, a in zip(T, TILT, strict=True))
    )
    np.testing.assert_allclose(settled(found).series["line"].values, TILT, atol=1e-6)
    tilt = taken_as(found.columns[1], "tilt")
    by_hand = settled(type(found)((found.columns[0], tilt), found.lines))
    np.testing.assert_allclose(by_hand.series["tilt"].values, TILT, atol=1e-6)


@pytest.mark.parametrize(("high", "view", "expected"), [
    (0.035 - 0.02 * T, "side", {"tip", "tip_side"}), (0.01 * np.sin(9 * T), "above", {"x", "y"})])  # fmt: skip
def test_one_point_is_its_height_from_the_side_and_a_track_from_above(high, view, expected):
    found = read(table(("t", "x", "y"), T, 0.002 * np.cos(9 * T), high, form="{:.6E}".format))
    assert found.view == view and {*settled(found).series} == expected
    other = {"side": "above", "above": "side"}[view]
    assert {*settled(found.of("", other)).series} == {"tip", "tip_side", "x", "y"} - expected


def test_a_table_of_too_many_columns_is_said_with_their_number():
    with pytest.raises(MeasuredError) as caught:
        read("\n".join([",".join(f"c{i}" for i in range(2000)), *[",".join("1" * 2000)] * 9]))
    assert (caught.value.code, caught.value.numbers) == ("columns", {"count": 2000, "most": 100})


# ---- the page ----


def asked(tab):
    return [part is tab.asks.run for part in tab.asks.view.objects]


def test_the_page_asks_for_a_run_and_a_view_only_where_a_file_leaves_them_open():
    tab = Measure(Explorer().scene)
    tab.take(PROGRAMS["Capstone"], name="one.txt")
    assert asked(tab) == []
    names = *CAPSTONE, *(name.replace("#1", "#2") for name in CAPSTONE)
    tab.take(table(names, T, TILT, SPIN, T, 2 * TILT, SPIN))
    assert asked(tab) == [True] and [*tab.asks.run.options] == ["Run #1", "Run #2"]
    tab.asks.run.value = "Run #2"
    np.testing.assert_allclose(tab._data.series["tilt"].values, 2 * TILT, atol=1e-4)
    tab.take(PROGRAMS["a clock"])
    assert asked(tab) == []
    point = table(("t", "x", "y"), T, 0.002 * np.cos(9 * T), 0.035 - 0.02 * T, form="{:.6E}".format)
    tab.take(point)
    assert asked(tab) == [False] and tab.asks.seen.value == "side" and {*tab._data.series} == {"tip", "tip_side"}
    tab.asks.seen.value = "above"
    assert {*tab._data.series} == {"x", "y"}
    tab.take(point.replace("0.0020", "0.0030"))  # the next one of the same camera
    assert tab.asks.seen.value == "above" and {*tab._data.series} == {"x", "y"}


def test_what_was_chosen_by_hand_is_used_for_the_next_file_with_the_same_names():
    tab = Measure(Explorer().scene)
    names = "A", "B (2)", "C [rad/s]"
    tab.take(table(names, T, TILT, SPIN))
    assert tab._data is None
    for i, quantity in enumerate(("time", "tilt", "spin")):
        tab.columns.view[0].views[i].objects[1].value = quantity
    tab.columns.view[0].views[1].objects[2].value = "deg"
    assert tab._data.series["tilt"].values[0] == pytest.approx(np.radians(0.1))
    tab.take(table(("t", "theta"), T, TILT))
    tab.take(table(names, T, 3 * TILT, SPIN))
    assert tab._data.series["tilt"].values[0] == pytest.approx(np.radians(0.3), rel=1e-3)
    assert [column.unit for column in tab._table.columns] == ["s", "deg", "rad/s"]
    tab.take(table((*names[:2], "D"), T, TILT, SPIN))
    assert tab._data is None
    other = Measure(Explorer().scene)  # the choices of one page are not those of another
    other.take(table(names, T, TILT, SPIN))
    assert other._data is None


@pytest.mark.parametrize("language", LANGUAGES)
def test_there_is_a_sheet_for_each_program_and_it_says_that_it_was_not_tried(language):
    with speaking(language):
        page = recipe("sheets")
        button = Measure(Explorer().scene).recipes[1]
    for program in ("Tracker 6", "Capstone 2", "Logger Pro 3", "Graphical Analysis 5", "phyphox", "Sensor Logger"):
        assert program in page
    not_tried, one = {"en": ("not tried by us", "one page"), "de": ("von uns nicht", "eine Seite"),
                      "es": ("No hemos probado", "una página")}[language]  # fmt: skip
    assert not_tried in page and button.filename == "from-your-program.html" and one in button.label
