"""Opens a file that is no text: a zip, a workbook (.xlsx, .xls, .ods), or Tracker's own file (.trk, .trz).

It runs as a program of its own, with little memory and time and without the rest of the page, because a small file may
unpack to gigabytes: text_inside() of table.py starts it. Nothing is written to a disk, no formula and no macro is run
(of a formula the stored value is read), and a name in an archive is only compared.
"""

import io
import json
import math
import re
import sys
import zipfile
from collections.abc import Iterator
from datetime import date, datetime, time, timedelta
from typing import Any
from xml.etree import ElementTree

LARGEST = 200_000
"""Bytes of a table as it is sent, in JSON, with room for the rest of the message: the server accepts 256 KiB."""
FEWEST, MOST = 8, 5000
"""The least and the largest number of rows."""
HEAD = 12
"""The number of first lines that are kept when a long table is shortened."""
PACKED, UNPACKED = 2_000_000, 50_000_000
"""Bytes of a file that is sent whole, and of all that is in it."""
MEMORY, SECONDS = 400_000_000, 10
"""Bytes and processor time that opening it may take."""
COLUMNS = 100
ZIP, OLD = b"PK\x03\x04", b"\xd0\xcf\x11\xe0"  # as a zip begins, and a workbook of before 2007
XML = ("<?xml", "<object")


class Wrong(Exception):
    """args: a key of [wrong] in measure.toml, and its numbers."""


def decoded(data: bytes) -> str:
    """The text of these bytes."""
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return data.decode("utf-16", "replace")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("cp1252", "replace")


def is_packed(data: bytes) -> bool:
    """Whether a file begins like one of these."""
    return data[:4] in (ZIP, OLD) or data[:200].decode("latin-1").lstrip("ï»¿ \r\n").startswith(XML)


def text_of(data: bytes) -> str:
    """The table in such a file."""
    if data[:4] == ZIP:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            inside = {info.filename: info for info in archive.infolist()}
            if sum(info.file_size for info in inside.values()) > UNPACKED:
                raise Wrong("bomb", {})
            if not {"[Content_Types].xml", "content.xml"} & inside.keys():
                data = _of_archive(archive, inside)
                return text_of(data) if is_packed(data) and data[:4] != ZIP else decoded(data)
    elif is_packed(data) and data[:4] != OLD:
        return "\n".join("\t".join(row) for row in _tracked(decoded(data)))
    return "\n".join("\t".join(row) for row in _of_workbook(data))


def _of_archive(archive: zipfile.ZipFile, inside: dict[str, zipfile.ZipInfo]) -> bytes:
    """The table in a zip: phyphox's raw data, a logger's gyroscope, Tracker's file, or else the largest table."""
    tables = [name for name in inside if re.search(r"\.(csv|tsv|txt|trk)$", name, re.I)
              and not re.match(r"(__MACOSX|meta)/", name)]  # fmt: skip
    if not tables:
        raise Wrong("nothing-inside", {"count": len(inside)})

    def rank(name: str) -> tuple[int, int]:
        kinds = r"raw ?data\.csv$", r"(^|/)gyro(scope)?\.csv$", r"\.trk$"
        return -next((i for i, kind in enumerate(kinds) if re.search(kind, name, re.I)), 3), inside[name].file_size

    return archive.read(max(tables, key=rank))


def _of_workbook(data: bytes) -> list[list[str]]:
    """The rows of the first sheet with numbers."""
    from python_calamine import CalamineWorkbook

    book = CalamineWorkbook.from_filelike(io.BytesIO(data))
    for name in book.sheet_names:
        rows = [[*map(_cell, row)] for row in book.get_sheet_by_name(name).to_python()]
        if sum(any(re.match(r"[-\d]", cell) for cell in row) for row in rows) >= FEWEST:
            if len(rows[0]) > COLUMNS:
                raise Wrong("columns", {"count": len(rows[0]), "most": COLUMNS})
            return rows
    raise Wrong("nothing-inside", {"count": len(book.sheet_names)})


def _cell(value: Any) -> str:
    if isinstance(value, float):
        return f"{value:.10g}" if math.isfinite(value) else ""
    if isinstance(value, timedelta):
        return f"{value.total_seconds():.10g}"
    if isinstance(value, (datetime, date, time)):
        return value.isoformat(*([" "] if isinstance(value, datetime) else []))
    return re.sub(r'[\s"]+', " ", str(value)).strip()


def _tracked(text: str) -> Iterator[list[str]]:
    """The points of a .trk: their pixels in the coordinates of the film. An image's y points down; its scale is in
    pixels per unit of length, 1 if it was never set; times are in ms."""
    if "<!" in re.sub(r"<!\[CDATA\[|<!--", "", text):  # entities
        raise Wrong("damaged", {})
    tree = ElementTree.fromstring(re.sub(r"^[^<]*<\?.*?\?>", "", text, count=1, flags=re.S))
    if tree.tag != "object":
        raise Wrong("damaged", {})
    clip, coords = _first(tree, "VideoClip"), _first(tree, "ImageCoordSystem")
    start, every = int(_number(clip, "startframe", 0)), max(int(_number(clip, "stepsize", 1)), 1)
    duration = _number(_first(tree, "ClipControl"), "delta_t", _number(_first(tree, "Video"), "delta_t", 1000.0))
    begun = _number(clip, "starttime", 0.0)
    points = [(_attribute(each, "name") or "?", dict(_frames(each))) for each in tree.iter("object")
              if str(each.get("class")).endswith(".PointMass")]  # fmt: skip
    points = [(name, frames) for name, frames in points if frames]
    if not points:
        raise Wrong("nothing-tracked", {})
    axes = dict(_frames(coords)) if coords is not None else {}
    unit = _attribute(tree, "length_unit") or "m"
    of_unit = f" ({unit})" if any(_number(each, "xscale", 1.0) != 1.0 for each in axes.values()) else ""
    yield ["t (ms)", *(f"{name} {axis}{of_unit}" for name, _ in points for axis in "xy")]
    now = None
    for n in range(max(max(frames) for _, frames in points) + 1):
        now = axes.get(n, now)
        if any(n in frames for _, frames in points) and n >= start and (n - start) % every == 0:
            cells = [cell for _, frames in points for cell in _in_film(frames.get(n), now)]
            yield [f"{begun + (n - start) * duration:.10g}", *cells]


def _in_film(frame: ElementTree.Element | None, axes: ElementTree.Element | None) -> list[str]:
    if frame is None:
        return ["", ""]
    turn = math.radians(_number(axes, "angle", 0.0))
    x = (_number(frame, "x", 0.0) - _number(axes, "xorigin", 0.0)) / _number(axes, "xscale", 1.0)
    y = (_number(axes, "yorigin", 0.0) - _number(frame, "y", 0.0)) / _number(axes, "yscale", 1.0)
    s, c = math.sin(turn), math.cos(turn)
    return [f"{c * x + s * y:.8g}", f"{c * y - s * x:.8g}"]


def _first(tree: ElementTree.Element, kind: str) -> ElementTree.Element | None:
    return next((each for each in tree.iter("object") if str(each.get("class")).endswith(kind)), None)


def _frames(thing: ElementTree.Element) -> Iterator[tuple[int, ElementTree.Element]]:
    """(its number, the frame) for each frame of a point or of the axes."""
    for frame in thing.findall("property[@name='framedata']/property"):
        inside = frame.find("object")
        if inside is not None and re.fullmatch(r"\[\d{1,6}\]", str(frame.get("name"))):
            yield int(str(frame.get("name"))[1:-1]), inside


def _attribute(thing: ElementTree.Element | None, name: str) -> str:
    return (thing.findtext(f"property[@name='{name}']") or "").strip() if thing is not None else ""


def _number(thing: ElementTree.Element | None, name: str, default: float) -> float:
    value = float(_attribute(thing, name) or default)
    return value if math.isfinite(value) else default


def shortened(text: str) -> tuple[str, int]:
    """(the text, 1), or of a longer one its first lines and every n-th of the others, and n: as the browser does it."""
    lines = re.split(r"\r\n|\r|\n", text)
    each = 1 if len(lines) <= MOST + 3 else math.ceil((len(lines) - HEAD) / (MOST - HEAD))
    while True:
        kept = [line for i, line in enumerate(lines) if i < HEAD or i % each == 0]
        if sum(len(line.encode()) + 2 for line in kept) <= LARGEST:
            return "\n".join(kept), each
        if each > len(lines):
            raise Wrong("too-large", {"size": len(text) / 1000, "most": LARGEST / 1000})
        each = math.ceil(1.2 * each)


def main() -> None:
    """Reads a file from stdin, and writes [text, each] or [code, numbers] in JSON."""
    try:
        import resource

        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
        resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS))
    except (ImportError, ValueError, OSError):  # elsewhere only time limits it
        pass
    try:
        answer: tuple[Any, ...] = shortened(text_of(sys.stdin.buffer.read(PACKED + 1)))
    except Wrong as wrong:
        answer = wrong.args
    except MemoryError:
        answer = "bomb", {}
    except Exception:
        answer = "damaged", {}
    sys.stdout.buffer.write(json.dumps(answer).encode())


if __name__ == "__main__":
    main()
