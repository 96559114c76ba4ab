"""Files that are no text: a zip, workbooks, Tracker's own; and those that would harm who opens them."""

import base64
import io
import struct
import zipfile
import zlib
from pathlib import Path

import numpy as np
import pytest

from app.model.explorer import Explorer
from app.model.measured.cells import MeasuredError
from app.model.measured.data import settled
from app.model.measured.table import read, text_inside
from app.model.measured.unpack import COLUMNS, HEAD, LARGEST, PACKED, shortened
from app.tabs.measure.measure import Measure
from app.text import LANGUAGES, say

DATA = Path(__file__).parent / "data"
NAMES = "Time (s)", "Gyroscope z (rad/s)"
ROWS = [(i / 100, 125.5 - i / 8) for i in range(20)]
CSV = "\n".join([",".join(f'"{name}"' for name in NAMES), *(f"{t:.9E},{w:.9E}" for t, w in ROWS)]) + "\n"
XML = '<?xml version="1.0" encoding="UTF-8"?>'
SHEETS = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"
OFFICE = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
URN = "urn:oasis:names:tc:opendocument:xmlns:"
PACKAGE = "http://schemas.openxmlformats.org/package/2006"


def zipped(files):
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, text in files.items():
            archive.writestr(name, text)
    return made.getvalue()


def letters(j):
    return (letters(j // 26 - 1) if j >= 26 else "") + chr(65 + j % 26)


def cell(i, j, value):
    at = f'r="{letters(j)}{i + 1}"'
    if isinstance(value, str) and value.startswith("="):
        return f"<c {at}><f>{value[1:]}</f><v>{125.5 - (i - 1) / 8}</v></c>"
    if isinstance(value, str):
        return f'<c {at} t="inlineStr"><is><t>{value}</t></is></c>'
    return f"<c {at}><v>{value!r}</v></c>"


def sheet(rows):
    inside = "".join(f'<row r="{i + 1}">' + "".join(cell(i, j, x) for j, x in enumerate(row)) + "</row>"
                     for i, row in enumerate(rows))  # fmt: skip
    return f'{XML}<worksheet xmlns="{SHEETS}"><sheetData>{inside}</sheetData></worksheet>'


def xlsx(*sheets, **more):
    """A workbook of these sheets, as text."""
    count = range(1, len(sheets) + 1)
    return zipped({
        "[Content_Types].xml": f'{XML}<Types xmlns="{PACKAGE}/content-types"/>',
        "_rels/.rels": f'{XML}<Relationships xmlns="{PACKAGE}/relationships"><Relationship Id="r1" '
                       f'Type="{OFFICE}/officeDocument" Target="xl/workbook.xml"/></Relationships>',
        "xl/workbook.xml": f'{XML}<workbook xmlns="{SHEETS}" xmlns:r="{OFFICE}"><sheets>' + "".join(
            f'<sheet name="S{i}" sheetId="{i}" r:id="r{i}"/>' for i in count) + "</sheets></workbook>",
        "xl/_rels/workbook.xml.rels": f'{XML}<Relationships xmlns="{PACKAGE}/relationships">' + "".join(
            f'<Relationship Id="r{i}" Type="{OFFICE}/worksheet" Target="worksheets/sheet{i}.xml"/>' for i in count)
            + "</Relationships>",
        **{f"xl/worksheets/sheet{i}.xml": text for i, text in enumerate(sheets, 1)}, **more})  # fmt: skip


def ods(rows, repeated=1):
    def of(value):
        kind = (
            f'office:value-type="float" office:value="{value}"'
            if not isinstance(value, str)
            else 'office:value-type="string"'
        )
        many = f'table:number-columns-repeated="{repeated}"'
        return f"<table:table-cell {many} {kind}><text:p>{value}</text:p></table:table-cell>"

    names = "".join(f' xmlns:{name}="{URN}{name}:1.0"' for name in ("office", "table", "text"))
    inside = "".join(f"<table:table-row>{''.join(map(of, row))}</table:table-row>" for row in rows)
    return zipped({"mimetype": "application/vnd.oasis.opendocument.spreadsheet",
                   "META-INF/manifest.xml": f'{XML}<m:manifest xmlns:m="{URN}manifest:1.0"/>',
                   "content.xml": f'{XML}<office:document-content{names}><office:body><office:spreadsheet><table:table '
                                  f'table:name="S">{inside}</table:table></office:spreadsheet></office:body>'
                                  "</office:document-content>"})  # fmt: skip


def trk(points, unit="m", scale=4000.0, angle=0.0, start=0, every=1):
    """A film of Tracker's, with this scale in pixels per unit and its axes turned by an angle in degrees."""

    def thing(kind, inside, outer="property name='item' type='object'"):
        return f"<{outer}><object class='org.opensourcephysics.{kind}'>{inside}</object></property>"

    def number(name, value):
        return f"<property name='{name}' type='double'>{value}</property>"

    def frames(kind, each):
        return (
            "<property name='framedata' type='array'>"
            + "".join(thing(f"{kind}$FrameData", inside, f"property name='[{n}]' type='object'") for n, inside in each)
            + "</property>"
        )

    turned = np.exp(1j * np.radians(angle))  # an image's y points down
    tracks = ""
    for name, track in points.items():
        places = [
            number("x", 320 + scale * (z * turned).real) + number("y", 240 - scale * (z * turned).imag) for z in track
        ]
        marks = frames("cabrillo.tracker.PointMass", [(start + every * n, place) for n, place in enumerate(places)])
        tracks += thing("cabrillo.tracker.PointMass", f"<property name='name' type='string'>{name}</property>{marks}")
    axes = (
        number("xorigin", 320.0)
        + number("yorigin", 240.0)
        + number("angle", angle)
        + number("xscale", scale)
        + number("yscale", scale)
    )
    clip = number("startframe", start) + number("stepsize", every) + number("starttime", 100.0)
    parts = {
        "videoclip": thing("media.core.VideoClip", clip),
        "clipcontrol": thing("media.core.StepperClipControl", number("delta_t", 1000 / 240)),
        "coords": thing("media.core.ImageCoordSystem", frames("media.core.ImageCoordSystem", [(0, axes)])),
    }
    inside = "".join(part.replace("name='item'", f"name='{name}'") for name, part in parts.items())
    inside += f"<property name='length_unit' type='string'>{unit}</property>"
    tracks = f"<property name='tracks' type='collection'>{tracks}</property>"
    return (
        f"{XML}\n<object class='org.opensourcephysics.cabrillo.tracker.TrackerPanel'>{inside}{tracks}</object>".encode()
    )


TABLE = [NAMES, *ROWS]
FILES = {
    "phyphox's zip": zipped(
        {"meta/device.csv": "property,value\n" * 30, "Raw Data.csv": CSV, "meta/time.csv": "a,b\n1,2\n"}
    ),
    "any zip": zipped({"__MACOSX/._film.csv": "\0" * 9999, "../../film.CSV": CSV, "readme.txt": "words"}),
    "utf-16 in a zip": zipped({"film.txt": CSV.encode("utf-16")}),
    "xlsx": xlsx(sheet([("a title",)]), sheet(TABLE)),
    "xlsx with formulas": xlsx(
        sheet([NAMES, *((t, f'=HYPERLINK("http://x/"&amp;A{i})') for i, (t, _) in enumerate(ROWS))])
    ),
    "xlsm with a macro": xlsx(sheet(TABLE), **{"xl/vbaProject.bin": b"\xd0\xcf\x11\xe0" + bytes(600)}),
    "ods": ods(TABLE),
    "phyphox's xls": (DATA / "phyphox.xls").read_bytes(),
}


@pytest.mark.parametrize("data", FILES.values(), ids=[*FILES])
def test_the_table_in_a_file_is_read(data):
    found = settled(read(data)).series["spin"]
    np.testing.assert_allclose(found.t, [t for t, _ in ROWS], atol=1e-9)
    np.testing.assert_allclose(found.values, [w for _, w in ROWS], atol=1e-9)


@pytest.mark.parametrize("angle", [0.0, 17.0])
@pytest.mark.parametrize("packed", [False, True])
def test_a_film_of_tracker_is_read_in_its_own_axes(angle, packed):
    """Point by point where it was, whatever the scale, the axes and the frames of its film; a .trz is a zip with it."""
    stem, ball = 0.03 * np.exp(1j * np.linspace(1.5, 1.2, 30)), np.linspace(0, 0.01, 30) + 0.002j
    data = trk({"stem": stem + ball, "ball": ball}, angle=angle, start=7, every=2)
    table = read(zipped({"video/film.mp4": b"\0" * 999, "film.trk": data}) if packed else data)
    assert [column.name for column in table.columns[:5]] == [
        "t (ms)",
        "stem x (m)",
        "stem y (m)",
        "ball x (m)",
        "ball y (m)",
    ]
    np.testing.assert_allclose(table.columns[1].values + 1j * table.columns[2].values, stem + ball, atol=1e-8)
    data = settled(table)
    np.testing.assert_allclose(data.series["axis_up"].values, stem.imag, atol=1e-8)
    np.testing.assert_allclose(data.t, 0.1 + np.arange(30) * 2 / 240, atol=1e-9)


def test_a_film_without_a_scale_is_read_in_pixels():
    """Their distance is fitted, so that the scale of two points does not matter."""
    stem = 0.03 * np.exp(1j * np.linspace(1.5, 1.2, 30))
    assert [column.name for column in read(trk({"a": stem, "b": 0 * stem}, scale=1.0)).columns[1:3]] == ["a x", "a y"]


def lying():
    """A zip whose directory says that its table has 100 bytes."""
    data = bytearray(zipped({"film.csv": "1,2\n" * 10_000_000}))
    for mark, place in ((b"PK\x01\x02", 24), (b"PK\x03\x04", 22)):
        data[data.index(mark) + place : data.index(mark) + place + 4] = struct.pack("<I", 100)
    return bytes(data)


def bomb(size=60_000_000):
    return zipped({"film.csv": "1,2\n" * (size // 4)})


HARMFUL = {
    "a zip of 60 MB": (bomb, "bomb"),
    "a zip that lies about its size": (lying, "damaged"),
    "a sheet of 60 MB": (lambda: xlsx(sheet(TABLE), **{"xl/media/image1.png": bytes(60_000_000)}), "bomb"),
    "a sheet of millions of cells": (
        lambda: xlsx(
            sheet(TABLE).replace("</sheetData>", "<row>" + "<c><v>1</v></c>" * 3_000_000 + "</row></sheetData>")
        ),
        "bomb",
    ),
    "a sheet of two cells, far apart": (
        lambda: xlsx(
            sheet([*TABLE]).replace("</sheetData>", '<row r="1048576"><c r="XFD1048576"><v>1</v></c></row></sheetData>')
        ),
        "bomb",
    ),
    "a cell repeated a billion times": (lambda: ods(TABLE, 10**9), "columns"),
    "a sheet of too many columns": (lambda: xlsx(sheet([range(COLUMNS + 1)] * 9)), "columns"),
    "entities": (
        lambda: trk({"a": [1]}).replace(b"<object", b'<!DOCTYPE x [<!ENTITY a "aaaa">]><object', 1),
        "damaged",
    ),
    "an external entity": (lambda: XML.encode() + b'<!DOCTYPE x SYSTEM "file:///etc/passwd"><object/>', "damaged"),
    "half of a zip": (lambda: FILES["phyphox's zip"][:200], "damaged"),
    "half of a workbook": (lambda: (DATA / "phyphox.xls").read_bytes()[:1500], "damaged"),
    "a zip of pictures": (lambda: zipped({"a.png": b"\x89PNG"}), "nothing-inside"),
    "a workbook of words": (lambda: xlsx(sheet([("a", "b")] * 20)), "nothing-inside"),
    "a film without points": (lambda: trk({}), "nothing-tracked"),
    "a web page": (lambda: b"<?xml version='1.0'?><html/>", "damaged"),
    "XML a thousand deep": (lambda: XML.encode() + b"<a>" * 100_000, "damaged"),
    "more than may be sent": (lambda: b"PK\x03\x04" + bytes(PACKED), "packed"),
}


@pytest.mark.parametrize(("make", "code"), HARMFUL.values(), ids=[*HARMFUL])
def test_what_would_harm_is_a_sentence(make, code, tmp_path, monkeypatch):
    """And nothing is written where it runs."""
    monkeypatch.chdir(tmp_path)
    with pytest.raises(MeasuredError) as caught:
        read(make())
    assert caught.value.code == code and not [*tmp_path.iterdir()]
    for language in LANGUAGES:
        assert say(f"measure.wrong.{code}", language, **caught.value.numbers)


@pytest.mark.parametrize("long", ["(" * 95_000, "t: " * 60_000, "a/ " * 60_000, "a" + " per " * 30_000, "[1" * 90_000])
def test_a_name_as_long_as_a_file_is_read_in_no_time(long):
    """What looks for a unit in it took minutes of the server's own thread: this test would not end."""
    found = read(f"{long},tilt (rad)\n" + "1,0.5\n" * 10)
    assert len(found.columns[0].name) <= 200 and found.columns[1].quantity == "tilt"


def test_a_formula_in_a_column_that_is_used_is_named():
    with pytest.raises(MeasuredError) as caught:
        read("t,tilt\n" + "=1+1,0.5\n" * 10)
    assert (caught.value.code, caught.value.numbers["text"]) == ("not-a-number", "=1+1")


def test_of_a_loggers_zip_the_gyroscope_is_read():
    table = "time,seconds_elapsed,z,y,x\n" + "".join(f"{i}0000000,{i / 100},{100 + i},0,0\n" for i in range(20))
    found = read(zipped({"Accelerometer.csv": table + table.split("\n", 1)[1], "Gyroscope.csv": table}))
    assert len(found.lines) == 20 and found.columns[2].quantity == "spin"


def test_a_long_table_in_a_file_is_shortened_as_in_the_browser():
    """Its first lines, and of the others those whose number is divisible by n."""
    lines = ["t (s),spin (rad/s)", *(f"{i / 1000:.4f},{100 + i % 7}.25" for i in range(30_000))]
    text, each = text_inside(zipped({"film.csv": "\n".join(lines)}))
    kept = text.split("\n")
    assert each > 5 and len(text) <= LARGEST and kept[:HEAD] == lines[:HEAD]
    assert kept[HEAD:] == [line for i, line in enumerate(lines) if i >= HEAD and i % each == 0]
    assert shortened("a\nb") == ("a\nb", 1)


def sent(tab, data, name="export.zip", size=100_000):
    """As the page sends it."""
    parts = [data[i : i + size] for i in range(0, len(data), size)] or [b""]
    for at, part in enumerate(parts):
        tab.file.piece = [base64.b64encode(part).decode(), at, len(parts), 1, name, len(data)]


def test_a_file_that_comes_in_pieces_is_opened_when_all_are_there():
    tab = Measure(Explorer().scene)
    sent(tab, FILES["phyphox's zip"], size=300)
    assert {*tab._data.series} == {"spin"} and tab._name == "export.zip"
    noise = np.random.default_rng(1).bytes(250_000)
    sent(tab, FILES["phyphox's zip"] + noise, name="other.zip")
    assert "cannot be opened" in tab.wording.object and "Still shown: export.zip" in tab.wording.object


def test_pieces_that_no_page_sends_are_passed_over(caplog):
    tab = Measure(Explorer().scene)
    tab.take(CSV, name="mine.txt")
    for piece in (
        ["?", 0, 1, 1, "a", 9],
        ["QUJD", 3, 4, 1, "a", 9],
        ["QUJD", 0, 2, 1, 5, 9],
        ["QUJD", 0, 2, 1, "a", float("nan")],
    ):
        tab.file.piece = piece
    assert len(caplog.records) == 4 and tab._name == "mine.txt"
    tab.file.piece = ["", 0, 1, 2, "big.xlsx", 7_000_000]
    assert "7.0 MB" in tab.wording.object and "2 MB" in tab.wording.object


def test_deflate_cannot_make_two_megabytes_more_than_the_memory_that_is_allowed():
    """The largest ratio is 1032: the program that opens a file ends by its memory, not the server by its own."""
    assert len(zlib.compress(bytes(10_000_000), 9)) * 1032 > 9_900_000
