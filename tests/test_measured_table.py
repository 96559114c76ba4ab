"""Tables as Tracker, phyphox and spreadsheets write them, and what is wrong with others."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.model.measured.data import roughness, settled
from app.model.measured.table import LARGEST, MeasuredError, read, taken_as, written
from app.text import LANGUAGES, listed, say

ROWS = [(i / 60, 5 + 2 * i, 28 - i / 8) for i in range(20)]


def table(head, between, decimal="."):
    lines = [between.join(f"{x:.4f}".replace(".", decimal) for x in row) for row in ROWS]
    return "\n".join([*([head] if head else []), *lines]) + "\n"


TRACKER = table("mass A\t\t\nt\tθ (°)\tspin (rev/s) ± 0.3", "\t", ",")
PHYPHOX = table('"Time (s)","Gyroscope x (rad/s)","Gyroscope z (rad/s)"', ",")
SHEET = table("Zeit/s;Neigung [Grad];Drehzahl (U/min)", ";", ",")
NAMED = table("t_ms tilt_deg spin", " ")
UNITS_BELOW = table("a wooden top\nt,tilt,spin\n(s),deg,rev/s", ",")
IN_WORDS = table("Zeit in s;Neigung in Grad;Drehzahl in U/s", ";", ",")
SIDE = table("t;stem tip from the side (mm);height of tip (mm)", ";", ",")
PHONE_ONE = table('"Time (s)"\t"Angular velocity (rad/s)"\t"Acceleration (m/s^2)"', "\t")
EN_PALABRAS = table("Tiempo en segundos;Inclinación en grados;Giro en vueltas/s", ";", ",")
SPANISH_PHONE = table('"Tiempo (s)"\t"Velocidad angular x (rad/s)"\t"Velocidad angular z (rad/s)"', "\t", ",")
GERMAN_PHONE = table('"Zeit (s)"\t"Winkelgeschwindigkeit x (rad/s)"\t"Winkelgeschwindigkeit z (rad/s)"', "\t", ",")


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (TRACKER, [("time", "s"), ("tilt", "deg"), ("spin", "rev/s")]),
        (PHYPHOX, [("time", "s"), ("", ""), ("spin", "rad/s")]),
        (SHEET, [("time", "s"), ("tilt", "deg"), ("spin", "rpm")]),
        (NAMED, [("time", "ms"), ("tilt", "deg"), ("spin", "rev/s")]),
        (UNITS_BELOW, [("time", "s"), ("tilt", "deg"), ("spin", "rev/s")]),
        (IN_WORDS, [("time", "s"), ("tilt", "deg"), ("spin", "rev/s")]),
        (GERMAN_PHONE, [("time", "s"), ("", ""), ("spin", "rad/s")]),
        (SPANISH_PHONE, [("time", "s"), ("", ""), ("spin", "rad/s")]),
        (EN_PALABRAS, [("time", "s"), ("tilt", "deg"), ("spin", "rev/s")]),
        (
            table("t,stem tip from the side (mm),height of tip (mm)", ","),
            [("time", "s"), ("tip_side", "mm"), ("tip", "mm")],
        ),
        (PHONE_ONE, [("time", "s"), ("spin", "rad/s"), ("", "")]),
        (table("t tilt spin", " ", ","), [("time", "s"), ("tilt", "deg"), ("spin", "rev/s")]),
    ],
)
def test_columns_are_understood(text, expected):
    found = read(text)
    assert [(column.quantity, column.unit) for column in found.columns] == expected
    got = np.array([column.values for column in found.columns]).T
    np.testing.assert_allclose(got, ROWS, atol=6e-5)


SEVERAL = "#multi:\n{0}tip{0}{0}ball{0}{0}{0}\nt{0}x{0}y{0}x{0}y{0}\n"


@pytest.mark.parametrize("end", ["", "{0}"])
@pytest.mark.parametrize("between", ["\t", ",", ";"])
def test_points_that_tracker_followed_name_their_columns(between, end):
    """Tracker ends its lines with a separator, the lines of names at least. Before a point is marked, there are gaps
    only."""
    row = (between.join(["{1:.9E}", *["{2:.9E}"] * 4]) + end).format
    rows = [row(between, i / 60, 0.01 * i) for i in range(20)]
    rows[0] = "0.000000000E0" + 4 * between + end.format(between)
    found = read("\n".join([SEVERAL.format(between) + rows[0], *rows[1:]]) + "\n")
    assert [column.name for column in found.columns[:5]] == ["t", "tip x", "tip y", "ball x", "ball y"]
    assert [column.quantity for column in found.columns[:5]] == ["time", "tip_x", "tip_y", "", ""]
    np.testing.assert_allclose(settled(found).series["tip_x"].values, 0.01 * np.arange(1, 20))


def test_decimal_commas_in_quotes_and_signs_as_they_are_printed():
    """As a sheet on the web writes them where decimals have commas."""
    rows = (f'"{i / 60:.4f}","{5 + i}","{-i / 2:.1f}"'.replace(".", ",").replace("-", "\u2212") for i in range(20))
    found = read("\n".join(["t,tilt,spin", *rows]))
    assert [column.quantity for column in found.columns] == ["time", "tilt", "spin"]
    np.testing.assert_allclose(found.columns[2].values, -np.arange(20) / 2)
    with pytest.raises(MeasuredError, match="decimals"):
        read("\n".join(["t,tilt", *(f'"{i},1",{i}.5' for i in range(20))]))


def test_an_empty_column_is_taken_for_nothing():
    found = read("\n".join(["t\ttilt\tspin", *(f"{i / 60:.4f}\t{5 + i}\t" for i in range(12))]))
    assert [column.quantity for column in found.columns] == ["time", "tilt", ""]
    assert set(settled(found).series) == {"tilt"}


@pytest.mark.parametrize(("largest", "unit"), [(30, "rev/s"), (190, "rad/s"), (10800, "deg/s")])
def test_a_spin_without_a_unit_is_one_that_a_top_can_have(largest, unit):
    spin = read("\n".join(["t,spin", *(f"{i / 60:.4f},{largest - i}" for i in range(12))])).columns[1]
    assert (spin.unit, spin.guessed) == (unit, True)


def test_values_come_in_radians_and_seconds():
    data = settled(read(TRACKER))
    np.testing.assert_allclose(data.series["tilt"].values[:2], np.radians([5, 7]), atol=1e-12)
    np.testing.assert_allclose(data.series["spin"].values[0], 28 * 2 * math.pi)
    assert data.series["spin"].error == pytest.approx(0.3 * 2 * math.pi)
    assert data.series["tilt"].t[1] == pytest.approx(1 / 60, abs=1e-4)
    assert settled(read(NAMED)).series["tilt"].t[-1] == pytest.approx(19 / 60 / 1000, abs=1e-7)


def test_frames_need_their_rate():
    found = read("\n".join(["frame\ttilt (deg)", *(f"{i}\t{5 + i}" for i in range(12))]))
    assert found.columns[0].unit == "frames"
    assert settled(found, rate=240).series["tilt"].t[-1] == pytest.approx(11 / 240)
    with pytest.raises(MeasuredError, match="rate"):
        settled(found)


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16", "utf-8"])
def test_bytes_are_decoded(encoding):
    assert read(TRACKER.encode(encoding)).columns[1].name == "θ (°)"
    assert read(TRACKER.replace("θ", "tilt").encode("cp1252")).columns[1].quantity == "tilt"


@pytest.mark.parametrize(("step", "unit"), [(1 / 30, "s"), (1000 / 240, "ms"), (1000 / 30, "ms")])
def test_times_without_a_unit_are_those_of_a_film(step, unit):
    time = read("\n".join(["t,tilt", *(f"{i * step:.4f},{5 + i}" for i in range(12))])).columns[0]
    assert (time.unit, time.guessed) == (unit, True)


def test_a_pause_of_a_film_leaves_its_times_in_seconds():
    time = read("\n".join(["t,tilt", *(f"{i / 30 + 5 * (i > 8):.4f},{5 + i}" for i in range(12))])).columns[0]
    assert (time.unit, time.guessed) == ("s", True)


@pytest.mark.parametrize(("largest", "unit"), [(0.043, "m"), (1.9, "m"), (5, "mm"), (43, "mm")])
def test_a_length_without_a_unit_is_one_that_a_film_of_a_top_shows(largest, unit):
    """A track may be more than a metre long, and a small top less than a centimetre high."""
    height = read("\n".join(["t,height", *(f"{i / 60:.4f},{largest * (1 - i / 60):.5f}" for i in range(12))])).columns[
        1
    ]
    assert (height.unit, height.guessed) == (unit, True)


def lines(*changed, base=TRACKER):
    """A table with some of its lines, counted from 1, changed."""
    parts = base.splitlines()
    for number, line in changed:
        parts[number - 1] = line
    return "\n".join(parts)


@pytest.mark.parametrize(
    ("text", "code", "numbers"),
    [
        ("", "empty", {}),
        ("some words\nand more of them\n", "no-numbers", {"line": 1}),
        ("t\ttilt\n1\t\0\n", "no-text", {"line": 2}),
        ("x" * (LARGEST + 1), "too-large", {"most": 200}),
        (lines((7, "0,1")), "width", {"line": 7, "found": 1}),
        ("t,tilt\n0,1,5,2\n" * 9, "width", {"line": 2, "found": 4, "expected": 2}),
        (lines((9, "0.1\t5.0\t28.0")), "decimals", {"line": 9, "text": "0.1"}),
        (lines((9, "0,1\tfive\t28,0")), "not-a-number", {"line": 9, "text": "five"}),
        (lines((9, "0,1\t1e999\t28,0")), "not-a-number", {"line": 9}),
        ("\n".join(TRACKER.splitlines()[:6]), "rows", {"rows": 4}),
    ],
)
def test_what_cannot_be_read_is_said_with_its_line(text, code, numbers):
    with pytest.raises(MeasuredError) as caught:
        read(text)
    assert caught.value.code == code
    assert caught.value.numbers.items() >= numbers.items()
    for language in LANGUAGES:
        assert say(f"measure.wrong.{code}", language, **caught.value.numbers)


def test_times_that_fall_are_said_and_repeated_ones_are_data():
    with pytest.raises(MeasuredError) as caught:
        settled(read(lines((10, "0,0\t5,0\t28,0"))))
    assert caught.value.code == "falling"
    assert caught.value.numbers["line"] == 10
    again = lines((10, TRACKER.splitlines()[8]))
    assert len(settled(read(again)).series["tilt"].t) == 20


def test_what_is_left_out_is_a_note():
    gaps = read(lines((5, "0,05\tNaN\t27,75"), (6, "\t9,0\t27,0"), (22, "0,31\t4")))
    assert [code for code, _ in gaps.notes] == ["cut-short", "no-time", "gaps"]
    assert gaps.notes[0][1]["line"] == 22
    assert gaps.notes[1][1] == {"count": 1, "line": 6}
    assert len(settled(gaps).series["tilt"].t) == 17
    bare = read(table("", "\t"))
    assert bare.notes[0] == ("no-header", {"line": 1})
    again = read(lines((7, TRACKER.splitlines()[5])))
    assert again.notes == (("repeated", {"count": 1, "line": 7}),)
    cut = read(lines()[:-2])
    assert cut.notes == (("cut-cell", {"line": 22, "text": TRACKER.splitlines()[21].split("\t")[2][:-2]}),)
    assert {code for code, _ in (*gaps.notes, *bare.notes, *again.notes, *cut.notes)} == set(listed("measure.notes"))


@pytest.mark.parametrize(("end", "whole"), [("0,3333\t43,0\t2", False), ("0,3333\t43,0000\t25,6E-", False),
                                            ("0,3333\t43,0000\t25,5000", True), ("0,3333\t43,0\t", True)])  # fmt: skip
def test_a_number_that_is_cut_short_is_left_out(end, whole):
    """Only at the end of a text, and not where a cell is empty; a text that ends with its line is whole."""
    found = read(TRACKER + end)
    assert ([code for code, _ in found.notes if code != "gaps"] == []) is whole
    assert len(found.lines) == 20 + whole
    assert not read(TRACKER + "0,3333\t43,0\t2\n").notes
    # where decimals differ, as programs write them that leave out zeros, a short number is none that is cut
    assert not read(TRACKER.replace("28,0000", "28,0") + "0,3333\t43,0\t2").notes


@pytest.mark.parametrize(("change", "code", "numbers"), [
    (lambda row: f"0.5,{row[1]},{row[2]}", "no-time-passes", {"time": 0.5, "line": 2}),
    (lambda row: f"{row[0]},1e200,{row[2]}", "beyond", {"line": 2, "name": "tilt (deg)", "unit": "deg"}),
    (lambda row: f"{row[0]},5,{row[2] if row[0] < 0.1 else 800}", "beyond", {"line": 8, "name": "spin (rev/s)"}),
])  # fmt: skip
def test_what_no_film_of_a_top_can_show_is_said(change, code, numbers):
    """A tilt is at most 180 degrees; with what an error may add."""
    with pytest.raises(MeasuredError) as caught:
        settled(read("\n".join(["t (s),tilt (deg),spin (rev/s)", *map(change, ROWS)])))
    assert caught.value.code == code and caught.value.numbers.items() >= numbers.items()
    for language in LANGUAGES:
        assert say(f"measure.wrong.{code}", language, **caught.value.numbers)


def test_numbers_without_names_are_not_taken_for_names():
    with pytest.raises(MeasuredError) as caught:
        settled(read(table("", ";")))
    assert (caught.value.code, caught.value.numbers["line"]) == ("no-names", 1)


def test_a_column_can_be_corrected():
    found = read(table("a\tb\tc", "\t"))
    with pytest.raises(MeasuredError, match="no-columns"):
        settled(found)
    columns = [*map(taken_as, found.columns, ("time", "tilt", "precession"))]
    data = settled(type(found)(tuple(columns), found.lines))
    assert list(data.series) == ["tilt", "precession"]
    assert columns[2].unit == "rev/s"
    twice = type(found)((columns[0], columns[1], taken_as(found.columns[2], "tilt")), found.lines)
    with pytest.raises(MeasuredError, match="twice"):
        settled(twice)


def test_the_error_of_a_value_is_read_off_its_jumps():
    noise = np.random.default_rng(7).normal(size=4000)
    assert roughness(np.sin(np.linspace(0, 20, 4000)) + 0.02 * noise) == pytest.approx(0.02, rel=0.05)


@given(st.one_of(st.text(), st.text(alphabet='t1,.;\t\n -θ(°)"±#e'), st.binary()))
def test_no_text_raises_anything_else(data):
    try:
        settled(read(data))
    except MeasuredError as error:
        for language in LANGUAGES:
            assert say(f"measure.wrong.{error.code}", language, **error.numbers)


@given(
    st.lists(
        st.tuples(st.floats(0, 1e3), st.floats(-1e9, 1e9), st.none() | st.floats(-1e-9, 1e-9)), min_size=8, max_size=30
    )
)
def test_what_is_written_is_read_again(rows):
    values = [[repr(x) if x is not None else "" for x in row] for row in rows]
    first = read("\n".join("\t".join(cells) for cells in [["t (s)", "tilt (rad)", "spin (rad/s)"], *values]))
    second = read(written(first))
    assert [column.name for column in second.columns] == [column.name for column in first.columns]
    for one, two in zip(first.columns, second.columns, strict=True):
        assert np.array_equal(one.values, two.values, equal_nan=True)
