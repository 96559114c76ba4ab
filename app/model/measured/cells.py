"""The cells of a table, as programs write them: what separates them, which lines are names, and what number each is.

Tracker separates columns with tabs or commas, below a line or two of names; a sheet may have a line of units below the
names; phyphox puts names and units in quotes; spreadsheets use semicolons, decimal commas and points between thousands.
"""

import math
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import accumulate

import numpy as np

from app.model.measured.names import NUMBER, is_run, is_unit, understood
from app.model.measured.unpack import COLUMNS, FEWEST, MOST
from app.text import say
from tippe_core.types import Array

Row = tuple[int, list[str]]
Notes = tuple[tuple[str, dict[str, object]], ...]

_COMMENT = re.compile(r"\s*(#|%|//|!|;(?=[^;]*$))+\s*")
_GAP = {"", "-", "nan", "na", "n/a", "null", "none"}
_THOUSANDS = re.compile(r"[+-]?\d{1,3}(?:(?:\.\d{3})+,\d+|(?:,\d{3})+\.\d+|(?:\.\d{3}){2,}|(?:,\d{3}){2,})")
_CLOCK = re.compile(r"(?:[\d.-]{8,10}[T ]+)?(?:(\d{1,2}):)?(\d{1,2}):(\d\d(?:[.,]\d*)?)"
                    r"\s*(?:Z|[+-]\d\d:?\d\d|([AP])M)?", re.A | re.I)  # fmt: skip
DAY = 86400.0
LETTERS = 200
"""Of a column's name, so that what looks into it takes no time that grows with a file."""


class MeasuredError(ValueError):
    """An error in a table. code: a key of [wrong] in measure.toml; numbers: the values that its sentence quotes."""

    def __init__(self, code: str, **numbers: object) -> None:
        super().__init__(code, numbers)
        self.code, self.numbers = code, numbers

    def __str__(self) -> str:
        return f"{self.code}: {say(f'measure.wrong.{self.code}', None, **self.numbers)}"


@dataclass(frozen=True, eq=False)
class Cells:
    """names: of the columns. lines: the line number in the file of each row; values: (rows, columns), NaN for a gap, in
    s from the first where there were times of a clock. notes: as those of a Table."""

    names: list[str]
    lines: Array
    values: Array
    notes: Notes


def cells_of(text: str) -> Cells:
    """The Cells of a text. Raises MeasuredError."""
    text = re.sub(r"(?<=\d)['\u2019\u00a0\u202f](?=\d{3})", "", text.replace("\u2212", "-"))  # as programs print them
    all_lines = [*enumerate(re.split(r"\r\n|\r|\n", text), 1)]
    lines = [(number, line) for number, line in all_lines if line.strip() and not _COMMENT.match(line)]
    if not lines:
        raise MeasuredError("empty")
    between = _separator(lines)
    rows = [(number, _cells(line, between)) for number, line in lines]
    if all(len(cells) > 1 and not cells[-1] for _, cells in rows):  # a separator after the last cell of each line
        rows = [(number, cells[:-1]) for number, cells in rows]
    rows = _without_thousands(rows)
    first = next((i for i, (_, cells) in enumerate(rows) if _is_data(cells)), None)
    if first is None:
        raise MeasuredError("no-numbers", line=rows[0][0], text=rows[0][1][0][:40])
    if between == "," and first:
        rows = rows[:first] + _with_decimal_commas(rows[first:], len(_without_end(rows[first - 1][1], 0)))
    width = len(rows[first][1])
    if width > COLUMNS:
        raise MeasuredError("columns", count=width, most=COLUMNS)
    heads = [[cell[:LETTERS] for cell in _without_end(cells, width)] for _, cells in rows[:first]]
    heads = [cells for cells in heads if len(cells) == width]
    if not heads:  # they may stand in a comment, as MATLAB and numpy write them
        above = [[cell[:LETTERS] for cell in _cells(_COMMENT.sub("", line, count=1), between)]
                 for number, line in all_lines if number < rows[first][0] and _COMMENT.match(line)]  # fmt: skip
        heads = [cells for cells in above if len(cells) == width and not _is_data(cells)]
    if first and not heads and len(rows[first - 1][1]) > 1:
        raise MeasuredError("width", line=rows[first][0], found=width, expected=len(rows[first - 1][1]))
    return _table(_names(heads), rows[first:], between, whole=text[-1] in "\r\n")


def _separator(lines: list[tuple[int, str]]) -> str:
    """The separator: the one that occurs in most lines; a space only if there is no other, or commas are decimal."""
    for between in "\t;,":
        if sum(between in line and not (between == "," and _is_spaced(line)) for _, line in lines) > len(lines) / 2:
            return between
    return " "


def _is_spaced(line: str) -> bool:
    """Whether there are only spaces between the numbers of a line."""
    cells = line.split()
    return len(cells) > 1 and all(NUMBER.fullmatch(cell) and not cell.endswith(",") for cell in cells)


def _names(heads: list[list[str]]) -> list[str] | None:
    """The names from the last line above the numbers, with the units of the line below them if that contains only
    units, and below the point that Tracker followed if several columns have the same name. Capstone's run may have a
    line of its own."""
    if len(heads) < 2:
        return heads[-1] if heads else None
    above, names = heads[-2:]
    for of_run, others in ((above, names), (names, above)):
        if _all_are(is_run, of_run):
            return [f"{name} {run}".strip() for name, run in zip(others, of_run, strict=True)]
    if _all_are(is_unit, names):
        return [f"{name} ({unit.strip('()[] ')})" if unit else name for name, unit in zip(above, names, strict=True)]
    if len(set(names)) < len(names) and not above[0]:
        points: Iterator[str] = accumulate(above, lambda before, point: point or before)
        return [f"{point} {name}".strip() for point, name in zip(points, names, strict=True)]
    return names


def _all_are(is_one: Callable[[str], bool], cells: list[str]) -> bool:
    """Whether all cells that are not empty are such, and some are not empty."""
    return any(cells) and all(not cell or is_one(cell) for cell in cells)


def _without_end(cells: list[str], width: int) -> list[str]:
    """A line of names without the empty cells that Tracker adds at its end."""
    full = max((i for i, cell in enumerate(cells, 1) if cell), default=0)
    return cells[: max(full, width)]


def _cells(line: str, between: str) -> list[str]:
    """The cells of a line, without quotes."""
    if between == " ":
        return line.split()
    cells = re.findall(rf'(?:^|{between})[ ]*("[^"]*"|[^{between}]*)', line)
    return [cell.strip().strip('"').strip() for cell in cells]


def _without_thousands(rows: list[Row]) -> list[Row]:
    """The rows without the points, or commas, between thousands: there are such if some number has both marks, or one
    of them twice."""
    found = next((cell for _, cells in rows for cell in cells if _THOUSANDS.fullmatch(cell)), None)
    if found is None:
        return rows
    mark = next(each for each in found if each in ".,")
    whole = re.compile(rf"[+-]?\d{{1,3}}(?:\{mark}\d{{3}})+(?:[.,]\d*)?")
    return [(number, [cell.replace(mark, "") if whole.fullmatch(cell) else cell for cell in cells])
            for number, cells in rows]  # fmt: skip


def _with_decimal_commas(rows: list[Row], width: int) -> list[Row]:
    """The rows with each number that a decimal comma has parted as one cell again, if this leaves no doubt: then there
    are as many cells as names. Either all numbers have an exponent, or none of them lacks its decimals."""
    for join in (_by_exponent, _in_pairs):
        joined = [(number, join(cells)) for number, cells in rows]
        if all(len(one) == width < len(cells) for (_, one), (_, cells) in zip(joined, rows, strict=True)):
            return joined
    return rows


def _by_exponent(cells: list[str]) -> list[str]:
    joined: list[str] = []
    for cell in cells:
        if joined and re.fullmatch(r"[+-]?\d+", joined[-1]) and re.fullmatch(r"\d+[eE][+-]?\d+", cell):
            joined[-1] += "," + cell
        else:
            joined.append(cell)
    return joined


def _in_pairs(cells: list[str]) -> list[str]:
    pairs = [*zip(cells[::2], cells[1::2], strict=False)]
    good = len(cells) % 2 == 0 and all(re.fullmatch(r"[+-]?\d+", a) and re.fullmatch(r"\d+", b) for a, b in pairs)
    return [f"{a},{b}" for a, b in pairs] if good else cells


def _is_data(cells: list[str]) -> bool:
    """Whether this is a row of numbers, possibly with gaps."""
    full = [cell for cell in cells if cell]
    numbers = sum(map(_is_number, full))
    return numbers > 0 and numbers >= len(full) / 2


def _is_number(cell: str) -> bool:
    return bool(NUMBER.fullmatch(cell) or _CLOCK.fullmatch(cell))


def _shape(cell: str) -> tuple[int, bool]:
    """(the number of characters behind the decimal mark, whether there is an exponent)."""
    _, *behind = re.split("[.,]", cell, maxsplit=1)
    return len("".join(behind)), "e" in cell.lower()


def _is_cut(rows: list[Row]) -> bool:
    """Whether the last cell of a text that does not end with a line is only the beginning of a number: all cells above
    it have the same number of decimals, and it has fewer, or is no number."""
    above, last = [cells[-1] for _, cells in rows[:-1] if cells[-1].lower() not in _GAP], rows[-1][1][-1]
    shapes = {_shape(cell) for cell in above}
    if len(above) < FEWEST or len(shapes) > 1 or last.lower() in _GAP:
        return False
    ((decimals, _),) = shapes
    return not NUMBER.fullmatch(last) or (_shape(last)[0] < decimals and not _shape(last)[1])


def _table(names: list[str] | None, rows: list[Row], between: str, whole: bool = True) -> Cells:
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
    for i in range(width):
        if not understood(names[i])[0] and not any(_is_number(cells[i]) for _, cells in rows):  # of words
            for _, cells in rows:
                cells[i] = ""
    values = np.array([[_value(cell, number, name) for cell, name in zip(cells, names, strict=True)]
                       for number, cells in rows])  # fmt: skip
    for i in range(width):
        if any(_CLOCK.fullmatch(cells[i]) for _, cells in rows):
            names[i] += " (s)"
            there = np.isfinite(values[:, i])
            turned = np.unwrap(values[there, i], period=DAY)  # past midnight
            values[there, i] = turned - turned[:1]
    return Cells(names, np.array([number for number, _ in rows]), values, tuple(notes))


def _check_decimals(rows: list[Row]) -> None:
    """Raises MeasuredError if some numbers have a decimal comma and others a point."""
    marked = [(mark, number, cell) for number, cells in rows for cell in cells for mark in ".,"
              if mark in cell and NUMBER.fullmatch(cell)]  # fmt: skip
    for mark, number, cell in marked:
        if mark != marked[0][0]:
            raise MeasuredError("decimals", line=number, text=cell, mark=marked[0][0])


def _value(cell: str, line: int, name: str) -> float:
    if cell.lower() in _GAP:
        return math.nan
    if clock := _CLOCK.fullmatch(cell):
        return _since(*clock.groups())
    value = float(cell.replace(",", ".")) if NUMBER.fullmatch(cell) else math.inf
    if not math.isfinite(value):
        raise MeasuredError("not-a-number", line=line, name=name[:40], text=cell[:40])
    return value


def _since(hours: str | None, minutes: str, seconds: str, half: str | None) -> float:
    """Seconds since midnight; half: A or P of a clock with twelve hours."""
    hour = float(hours or 0)
    if half:
        hour = hour % 12 + 12 * (half.upper() == "P")
    return hour * 3600 + float(minutes) * 60 + float(seconds.replace(",", "."))
