"""Reads a table of measurements of a top, from a film or a phone, and interprets each column.

What cannot be read raises a MeasuredError with its line; what was read but left out is a note of the Table.
"""

import json
import math
import re
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from threading import Lock

import numpy as np

from app.model.measured import unpack
from app.model.measured.cells import MeasuredError, Notes, cells_of
from app.model.measured.names import UNITS, is_from_x, likely, understood, without_run
from app.model.measured.points import Roles, guessed_view, roles_of, with_axis
from app.model.measured.unpack import HEAD, LARGEST, PACKED, SECONDS, UNPACKED, decoded, is_packed
from tippe_core.types import Array

NO_GYROSCOPE = re.compile(r"accel|gravity|magnet|orient", re.I)
"""In the name of a logger's file: it has the same columns for other sensors."""
_OPENING = Lock()  # one file at a time


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

    @property
    def si(self) -> Array:
        """The values in s (or frames), rad, rad/s or m; an angle that is counted from +x as one from the upright. Those
        of a column that is not used as they are."""
        if not self.quantity:
            return self.values
        values = self.values * UNITS[self.quantity][self.unit]
        if self.quantity in ("line", "tilt") and is_from_x(self.name):
            values = (np.pi / 2 - values + np.pi) % (2 * np.pi) - np.pi
        return np.abs(values) if self.quantity == "tilt" and is_from_x(self.name) else values


@dataclass(frozen=True, eq=False)
class Table:
    """lines: the line number in the file of each row. notes: (code, numbers); the codes are keys of [notes] in
    measure.toml. runs: those in it; run: the one that is used. view: "side" or "above" if it has points of a film;
    roles: what they are in each. file: the name of its file, if that is known."""

    columns: tuple[Column, ...]
    lines: tuple[int, ...]
    notes: Notes = ()
    runs: tuple[str, ...] = ()
    run: str = ""
    view: str = ""
    roles: Roles = field(default_factory=dict)
    file: str = ""

    def of(self, run: str, view: str) -> "Table":
        """The Table with the columns of this run, and those of points as seen from there."""
        return replace(self, columns=_chosen(self.columns, self.roles, run, view, self.file), run=run, view=view)


def text_inside(data: bytes) -> tuple[str, int]:
    """(the text of the table in a file that is no text, n if it has every n-th row of it), by a program of its own that
    may take little memory and time. Raises MeasuredError."""
    if len(data) > PACKED:
        raise MeasuredError("packed", size=len(data) / 1e6, most=PACKED / 1e6)
    with _OPENING:
        try:
            done = subprocess.run([sys.executable, "-I", unpack.__file__], input=data, capture_output=True,
                                  timeout=3 * SECONDS)  # fmt: skip
            first, second = json.loads(done.stdout)
        except (subprocess.TimeoutExpired, ValueError):
            first, second = "bomb", {}
    if isinstance(second, int):
        return first, second
    raise MeasuredError(first, **second, **({"most": UNPACKED / 1e6} if first == "bomb" else {}))


def read(data: bytes | str, file: str = "") -> Table:
    """The Table in a file's bytes, or in a text; file: its name. Raises MeasuredError, and nothing else."""
    if isinstance(data, bytes) and is_packed(data):
        data, _ = text_inside(data)
    size = len(data if isinstance(data, bytes) else data.encode("utf-8", "replace"))
    if size > LARGEST:
        raise MeasuredError("too-large", size=size / 1000, most=LARGEST / 1000)
    text = decoded(data) if isinstance(data, bytes) else data.removeprefix("\ufeff")
    if "\0" in text:
        raise MeasuredError("no-text", line=text[: text.index("\0")].count("\n") + 1)
    cells = cells_of(text)
    names, values = with_axis(cells.names, cells.values)
    plain = tuple(Column(name, "", "", False, understood(name)[2], values[:, i]) for i, name in enumerate(names))
    runs = tuple(dict.fromkeys(run for name in names if (run := without_run(name)[1])))
    roles = {} if _is_logger(names) else roles_of(names)
    view = guessed_view(names, values) if roles else ""
    table = Table(plain, tuple(map(int, cells.lines)), cells.notes, runs, roles=roles, file=file)
    table = table.of(runs[0] if runs else "", view)
    return replace(table, notes=(*cells.notes, *_noted(table)))


def _noted(table: Table) -> Iterator[tuple[str, dict[str, object]]]:
    """Rows without a time, those that repeat one, and gaps."""
    lines, time = np.array(table.lines), next((each for each in table.columns if each.quantity == "time"), None)
    timed = np.isfinite(time.values) if time else np.ones(len(lines), bool)
    if not timed.all() and len(table.runs) < 2:
        yield "no-time", {"count": int((~timed).sum()), "line": int(lines[~timed][0])}
    lines = lines[timed]
    if time:
        again = lines[1:][np.diff(time.values[timed]) == 0]
        if again.size:
            yield "repeated", {"count": int(again.size), "line": int(again[0])}
    for column in table.columns:
        missing = ~np.isfinite(column.values[timed])
        if column.quantity and missing.any():
            yield "gaps", {"name": column.name, "count": int(missing.sum()), "line": int(lines[missing][0])}


def _chosen(columns: tuple[Column, ...], roles: Roles, run: str, view: str, file: str) -> tuple[Column, ...]:
    """The columns, each as what its name says; of several with the same quantity, the one that says its unit. A run
    without a time of its own has that of the first one."""
    timed = {without_run(each.name)[1] for each in columns if understood(each.name)[0] == "time"}
    wording = [understood(column.name) for column in columns]
    ranks: dict[str, tuple[bool, bool, int]] = {}
    for i, (quantity, unit, _) in enumerate(wording):
        of_run = run if quantity != "time" or run in timed else min(timed, default="")
        elsewhere = i in roles or without_run(columns[i].name)[1] not in ("", of_run)
        if not quantity or elsewhere or not np.isfinite(columns[i].values).any():
            continue
        counted = likely(quantity, columns[i].values, columns[i].name) != "frames"
        rank = unit in UNITS[quantity], counted, -i
        ranks[quantity] = max(rank, ranks.get(quantity, rank))
    quantities = {-rank[-1]: quantity for quantity, rank in ranks.items()}
    for i, (side, above) in roles.items():
        quantity = above if view == "above" else side
        if quantity not in quantities.values() and np.isfinite(columns[i].values).any():
            quantities[i] = quantity
    if _is_logger([column.name for column in columns]):  # its z is the axis through the phone's screen
        z = next((i for i, column in enumerate(columns) if column.name.strip().lower() == "z"), None)
        z = None if NO_GYROSCOPE.search(file) else z
        quantities = {i: each for i, each in quantities.items() if each == "time"} | ({} if z is None else {z: "spin"})
    return tuple(taken_as(column, quantities.get(i, "")) for i, column in enumerate(columns))


def _is_logger(names: list[str]) -> bool:
    """Whether this is the gyroscope's table of Sensor Logger: time, seconds_elapsed, z, y, x."""
    return {"seconds_elapsed", "x", "y", "z"} <= {name.strip().lower() for name in names}


def taken_as(column: Column, quantity: str) -> Column:
    """The column as another quantity: in the unit that its name says, or else in a likely one."""
    if not quantity:
        return replace(column, quantity="", unit="", guessed=False)
    _, unit, _ = understood(column.name)
    guessed = unit not in UNITS[quantity]
    unit = likely(quantity, column.values, column.name) if guessed else unit
    return replace(column, quantity=quantity, unit=unit, guessed=guessed)


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
