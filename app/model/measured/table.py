"""Reads a table of measurements of a top, from a film or a phone, and interprets each column.

Tracker separates columns with tabs or commas, below a line or two of names; a sheet may have a line of units below the
names; phyphox puts names and units in quotes; spreadsheets use semicolons and decimal commas. What cannot be read
raises a MeasuredError with its line; what was read but left out is a note of the Table.
"""

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from tippe_core.types import Array

LARGEST = 200_000
"""Bytes of a table as it is sent, in JSON, with room for the rest of the message: the server accepts 256 KiB."""
FEWEST, MOST = 8, 5000
"""The least and the largest number of rows."""
HEAD = 12
"""The number of first lines that the browser keeps when it shortens a long table."""
USUAL = {"rev/s": 60.0, "rad/s": 600.0, "deg/s": math.inf}
"""{unit: the largest spin that is plausible in it}."""
SLOWEST = 1.0  # between two rows: a longer step is in ms, not in s

ANGLES = {"deg": math.pi / 180, "rad": 1.0}
RATES = {"rev/s": 2 * math.pi, "rad/s": 1.0, "deg/s": math.pi / 180, "rpm": math.pi / 30}
LENGTHS = {"mm": 1e-3, "cm": 1e-2, "m": 1.0}
UNITS = {
    "time": {"s": 1.0, "ms": 1e-3, "frames": 1.0},
    "tilt": ANGLES,
    "azimuth": ANGLES,
    "spin": RATES,
    "precession": RATES,
    "height": LENGTHS,
    "tip": LENGTHS,
    "x": LENGTHS,
    "y": LENGTHS,
    "tip_x": LENGTHS,
    "tip_y": LENGTHS,
    "side": LENGTHS,
    "tip_side": LENGTHS,
}
"""{quantity: {unit: its size in s, rad, rad/s or m}}; for frames the frame rate is needed as well."""

# The names of each quantity in tables, in lower case and reduced to letters and digits.
NAMES = {
    "time": "t time zeit seconds frame frames bild bilder timestamp",
    "tilt": "tilt theta θ thetar θr neigung inclination nutation tiltangle neigungswinkel",
    "azimuth": "azimuth azimut phi φ ϕ",
    "spin": "spin omega3 ω3 w3 ω drehung drehzahl eigendrehung gyroscopez gyroskopz angularvelocity "
    "angularvelocityz winkelgeschwindigkeit winkelgeschwindigkeitz",
    "precession": "precession präzession phidot precessionrate präzessionsrate",
    "height": "height höhe heightofg h zg",
    "tip": "tip tipheight stemtip spitze stielende heightoftip",
    "x": "x contactx trackx",
    "y": "y contacty tracky",
    "tip_x": "tipx xtip stemtipx spitzex",
    "tip_y": "tipy ytip stemtipy spitzey",
    "side": "side fromtheside contactfromtheside vonderseite auflagevonderseite",
    "tip_side": "tipside tipfromtheside stemtipfromtheside spitzevonderseite",
}
_QUANTITY = {name: quantity for quantity, names in NAMES.items() for name in names.split()}
_UNIT = {
    "s": "s", "sec": "s", "second": "s", "seconds": "s", "sekunden": "s", "ms": "ms", "frame": "frames",
    "frames": "frames", "bild": "frames", "bilder": "frames", "deg": "deg", "°": "deg", "degree": "deg",
    "degrees": "deg", "grad": "deg", "rad": "rad", "radian": "rad", "radians": "rad", "rev/s": "rev/s",
    "u/s": "rev/s", "1/s": "rev/s", "hz": "rev/s", "rad/s": "rad/s", "deg/s": "deg/s", "°/s": "deg/s",
    "grad/s": "deg/s", "rpm": "rpm", "rev/min": "rpm", "u/min": "rpm", "1/min": "rpm", "mm": "mm", "cm": "cm", "m": "m",
}  # fmt: skip
_NUMBER = re.compile(r"[+-]?(\d+([.,]\d*)?|[.,]\d+)([eE][+-]?\d{1,3})?", re.A)
_UNIT_LAST = re.compile(r"(?:\s+in\s+|[/_ ]\s*)([^/_\s]+(?:/[^/_\s]+)?)\s*$")
_GAP = {"", "-", "nan", "na", "n/a", "null", "none"}


class MeasuredError(ValueError):
    """An error in a table. code: a key of [wrong] in measure.toml; numbers: the values that its sentence quotes."""

    def __init__(self, code: str, **numbers: object) -> None:
        super().__init__(f"{code}: {numbers}")
        self.code, self.numbers = code, numbers


@dataclass(frozen=True, eq=False)
class Column:
    """name: as in the table. quantity: a key of UNITS, or "" if the column is not used. guessed: the unit is not in the
    table. error: that of one value, in this unit, if the name ends in "± error", else None."""

    name: str
    quantity: str
    unit: str
    guessed: bool
    error: float | None
    values: Array


@dataclass(frozen=True, eq=False)
class Table:
    """lines: the line number in the file of each row. notes: (code, numbers); the codes are keys of [notes] in
    measure.toml."""

    columns: tuple[Column, ...]
    lines: tuple[int, ...]
    notes: tuple[tuple[str, dict[str, object]], ...] = ()


def read(data: bytes | str) -> Table:
    """The Table in a file's bytes, or in a text. Raises MeasuredError, and nothing else."""
    size = len(data if isinstance(data, bytes) else data.encode("utf-8", "replace"))
    if size > LARGEST:
        raise MeasuredError("too-large", size=size / 1000, most=LARGEST / 1000)
    text = _decoded(data) if isinstance(data, bytes) else data.removeprefix("\ufeff")
    if text.startswith("PK\x03\x04"):
        raise MeasuredError("packed")
    if "\0" in text:
        raise MeasuredError("no-text", line=text[: text.index("\0")].count("\n") + 1)
    text = text.replace("\u2212", "-")  # a minus as programs print it
    lines = [(number, line) for number, line in enumerate(re.split(r"\r\n|\r|\n", text), 1)
             if line.strip() and not line.lstrip().startswith("#")]  # fmt: skip
    if not lines:
        raise MeasuredError("empty")
    between = _separator(lines)
    rows = [(number, _cells(line, between)) for number, line in lines]
    if all(len(cells) > 1 and not cells[-1] for _, cells in rows):  # a separator after the last cell of each line
        rows = [(number, cells[:-1]) for number, cells in rows]
    first = next((i for i, (_, cells) in enumerate(rows) if _is_data(cells)), None)
    if first is None:
        raise MeasuredError("no-numbers", line=rows[0][0], text=rows[0][1][0][:40])
    width = len(rows[first][1])
    heads = [_without_end(cells, width) for _, cells in rows[:first]]
    heads = [cells for cells in heads if len(cells) == width]
    if first and not heads and len(rows[first - 1][1]) > 1:
        raise MeasuredError("width", line=rows[first][0], found=width, expected=len(rows[first - 1][1]))
    return _table(_names(heads), rows[first:], between, whole=text[-1] in "\r\n")


def _decoded(data: bytes) -> str:
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return data.decode("utf-16", "replace")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("cp1252", "replace")


def _separator(lines: list[tuple[int, str]]) -> str:
    """The separator: the one that occurs in most lines; a space only if there is no other, or commas are decimal."""
    for between in "\t;,":
        if sum(between in line and not (between == "," and _is_spaced(line)) for _, line in lines) > len(lines) / 2:
            return between
    return " "


def _is_spaced(line: str) -> bool:
    """Whether there are only spaces between the numbers of a line."""
    cells = line.split()
    return len(cells) > 1 and all(_NUMBER.fullmatch(cell) and not cell.endswith(",") for cell in cells)


def _names(heads: list[list[str]]) -> list[str] | None:
    """The names from the last line above the numbers, with the units of the line below them if that contains only
    units, and below the point that Tracker followed if several columns have the same name."""
    if len(heads) > 1 and all(not cell or _bare(cell) in _UNIT for cell in heads[-1]) and any(heads[-1]):
        return [f"{name} ({_bare(unit)})" if unit else name for name, unit in zip(*heads[-2:], strict=True)]
    if len(heads) > 1 and len(set(heads[-1])) < len(heads[-1]) and not heads[-2][0]:
        names, point = [], ""
        for above, name in zip(*heads[-2:], strict=True):
            point = above or point
            names.append(f"{point} {name}".strip())
        return names
    return heads[-1] if heads else None


def _without_end(cells: list[str], width: int) -> list[str]:
    """A line of names without the empty cells that Tracker adds at its end."""
    full = max((i for i, cell in enumerate(cells, 1) if cell), default=0)
    return cells[: max(full, width)]


def _bare(unit: str) -> str:
    return unit.strip("()[] ").lower()


def _cells(line: str, between: str) -> list[str]:
    """The cells of a line, without quotes."""
    if between == " ":
        return line.split()
    cells = re.findall(rf'(?:^|{between})[ ]*("[^"]*"|[^{between}]*)', line)
    return [cell.strip().strip('"').strip() for cell in cells]


def _is_data(cells: list[str]) -> bool:
    """Whether this is a row of numbers, possibly with gaps."""
    full = [cell for cell in cells if cell]
    numbers = sum(bool(_NUMBER.fullmatch(cell)) for cell in full)
    return numbers > 0 and numbers >= len(full) / 2


def _shape(cell: str) -> tuple[int, bool]:
    """(the number of characters behind the decimal mark, whether there is an exponent)."""
    _, *behind = re.split("[.,]", cell, maxsplit=1)
    return len("".join(behind)), "e" in cell.lower()


def _is_cut(rows: list[tuple[int, list[str]]]) -> bool:
    """Whether the last cell of a text that does not end with a line is only the beginning of a number: all cells above
    it have the same number of decimals, and it has fewer, or is no number."""
    above, last = [cells[-1] for _, cells in rows[:-1] if cells[-1].lower() not in _GAP], rows[-1][1][-1]
    shapes = {_shape(cell) for cell in above}
    if len(above) < FEWEST or len(shapes) > 1 or last.lower() in _GAP:
        return False
    ((decimals, _),) = shapes
    return not _NUMBER.fullmatch(last) or (_shape(last)[0] < decimals and not _shape(last)[1])


def _table(names: list[str] | None, rows: list[tuple[int, list[str]]], between: str, whole: bool = True) -> Table:
    """whole: the text ends with the end of a line."""
    notes: list[tuple[str, dict[str, object]]] = []
    width = len(names or rows[0][1])
    if names is None:
        notes.append(("no-header", {"line": rows[0][0]}))
        names = [str(i + 1) for i in range(width)]
    if len(rows[-1][1]) < width and len(rows) > 1:
        notes.append(("cut-short", {"line": rows[-1][0], "found": len(rows[-1][1]), "expected": width}))
        rows = rows[:-1]
    elif not whole and _is_cut(rows):
        notes.append(("cut-cell", {"line": rows[-1][0], "text": rows[-1][1][-1][:40]}))
        rows = rows[:-1]
    for number, cells in rows:
        # a gap at the end of a row may have lost its separator
        if len(cells) not in (width, width - 1) or (len(cells) < width and between in ", "):
            raise MeasuredError("width", line=number, found=len(cells), expected=width)
        cells.extend([""] * (width - len(cells)))
    if not FEWEST <= len(rows) <= MOST:
        raise MeasuredError("rows", rows=len(rows), least=FEWEST, most=MOST)
    _check_decimals(rows)
    values = np.array([[_value(cell, number, name) for cell, name in zip(cells, names, strict=True)]
                       for number, cells in rows])  # fmt: skip
    lines = np.array([number for number, _ in rows])
    columns = _columns(names, values)
    time = next((i for i, column in enumerate(columns) if column.quantity == "time"), None)
    if time is not None:
        timed = np.isfinite(values[:, time])
        if not timed.all():
            notes.append(("no-time", {"count": int((~timed).sum()), "line": int(lines[~timed][0])}))
        values, lines = values[timed], lines[timed]
        again = lines[1:][np.diff(values[:, time]) == 0]
        if again.size:
            notes.append(("repeated", {"count": int(again.size), "line": int(again[0])}))
    columns = _columns(names, values)
    notes.extend(_gaps(columns, lines))
    return Table(columns, tuple(map(int, lines)), tuple(notes))


def _gaps(columns: tuple[Column, ...], lines: Array) -> Iterator[tuple[str, dict[str, object]]]:
    for column in columns:
        missing = ~np.isfinite(column.values)
        if column.quantity and missing.any():
            found: dict[str, object] = {
                "name": column.name,
                "count": int(missing.sum()),
                "line": int(lines[missing][0]),
            }
            yield "gaps", found


def _check_decimals(rows: list[tuple[int, list[str]]]) -> None:
    """Raises MeasuredError if some numbers have a decimal comma and others a point."""
    first = ""
    for number, cells in rows:
        for cell in cells:
            mark = next((mark for mark in ".," if mark in cell), "")
            if mark and _NUMBER.fullmatch(cell):
                first = first or mark
                if mark != first:
                    raise MeasuredError("decimals", line=number, text=cell, mark=first)


def _value(cell: str, line: int, name: str) -> float:
    if cell.lower() in _GAP:
        return math.nan
    value = float(cell.replace(",", ".")) if _NUMBER.fullmatch(cell) else math.inf
    if not math.isfinite(value):
        raise MeasuredError("not-a-number", line=line, name=name[:40], text=cell[:40])
    return value


def _columns(names: list[str], values: Array) -> tuple[Column, ...]:
    columns: list[Column] = []
    taken = {""}
    for i, name in enumerate(names):
        quantity, _, error = _understood(name)
        if quantity in taken or not np.isfinite(values[:, i]).any():
            quantity = ""
        taken.add(quantity)
        columns.append(taken_as(Column(name, "", "", False, error, values[:, i]), quantity))
    return tuple(columns)


def taken_as(column: Column, quantity: str) -> Column:
    """The column as another quantity: in the unit that its name says, or else in a likely one."""
    if not quantity:
        return replace(column, quantity="", unit="", guessed=False)
    _, unit, _ = _understood(column.name)
    guessed = unit not in UNITS[quantity]
    unit = _likely(quantity, column.values, column.name) if guessed else unit
    return replace(column, quantity=quantity, unit=unit, guessed=guessed)


def _understood(name: str) -> tuple[str, str, float | None]:
    """(quantity, unit, error) from a column's name; "" or None for what it does not say."""
    name, _, error = name.partition("±")
    found = _NUMBER.fullmatch(error.strip())
    parts = [*re.finditer(r"[(\[]([^)\]]*)[)\]]", name), *_UNIT_LAST.finditer(name)]
    unit = next((part for part in parts if part[1].strip().lower() in _UNIT), None)
    known = _UNIT[unit[1].strip().lower()] if unit else ""
    called = name[: unit.start()] + name[unit.end() :] if unit else name
    bare = re.sub(r"[^a-zäöüßθφϕω0-9]", "", called.lower())
    return _QUANTITY.get(bare, ""), known, float(error.strip().replace(",", ".")) if found else None


def _likely(quantity: str, values: Array, name: str) -> str:
    """The most likely unit of a column that does not say it."""
    largest = float(np.nanmax(np.abs(values))) if np.isfinite(values).any() else 0.0
    if quantity == "time":
        if re.match("frame|bild", name.lower()):
            return "frames"
        steps = np.diff(values[np.isfinite(values)])
        return "ms" if steps.size and float(np.median(steps)) > SLOWEST else "s"
    if UNITS[quantity] is ANGLES:
        return "rad" if largest <= math.pi + 0.2 else "deg"
    if UNITS[quantity] is RATES:
        return next(unit for unit, most in USUAL.items() if largest <= most)
    return "m" if largest < 2 else "mm"


def line_in_file(line: int, each: int) -> int:
    """The line in the original file of a line in the shortened table: the browser keeps the first HEAD lines, and of
    the others those whose number, counted from 0, is a multiple of each."""
    beyond = line - 1 - HEAD
    return line if each == 1 or beyond < 0 else each * (math.ceil(HEAD / each) + beyond) + 1


def written(table: Table) -> str:
    """The table as text that read() accepts, with tabs between the columns."""
    heads = [column.name for column in table.columns]
    rows = zip(*(column.values for column in table.columns), strict=True)
    cells = [["" if math.isnan(x) else repr(float(x)) for x in row] for row in rows]
    return "".join("\t".join(row) + "\n" for row in [heads, *cells])
