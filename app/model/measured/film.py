"""A film's data with the settings of its fit, as text: a table that any program reads, below a line that starts with `#
film:` and holds the settings. In a link the text is compressed."""

import base64
import binascii
import itertools
import json
import math
import zlib
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from app.model.measured.cells import MeasuredError
from app.model.measured.data import Data, Series
from app.model.measured.motion import OF_LAW
from app.model.measured.remembered import checked
from app.model.measured.unpack import LARGEST
from app.model.measured.work import LOOSE, models
from tippe_core import Scales, Shape, Top, TopError, load_top, save_top

MARK = "# film:"
FINE = 20.0  # a value is written to this fraction of its error
MICRO = 6  # decimals of a time in s
LONGEST_PACKED = 6000  # characters of a link
UNITS = {"tilt": "rad", "line": "rad", "azimuth": "rad", "spin": "rad/s", "precession": "rad/s"}


@dataclass(frozen=True, eq=False)
class Film:
    """law: a key of OF_LAW except "rolling"; loose: keys of LOOSE; part: (start, end) in s. top, scales, shape: those
    of the filmed top. fits: stored_fit() of the rolling and of the sliding fit; empty if nothing was fitted."""

    law: str
    loose: tuple[str, ...]
    part: tuple[float, float]
    top: Top
    scales: Scales
    shape: Shape | None
    fits: tuple[dict[str, Any], ...] = ()

    @property
    def free(self) -> tuple[str, ...]:
        """The parameters that these keys set free."""
        return tuple(name for key in self.loose for name in LOOSE[key])


def table_of(data: Data) -> str:
    """The data as a table that table.read() accepts, with as many digits as their errors justify: one row for each
    time, more where times repeat, and an empty cell where nothing was measured."""
    heads = [f"{name.replace('_', ' ')} ({UNITS.get(name, 'm')}) ± {series.error:.4g}"
             for name, series in data.series.items()]  # fmt: skip
    columns = [_cells(series) for series in data.series.values()]
    rows = ["\t".join(["time (s)", *heads])]
    for key in sorted({key for column in columns for key in column}):
        rows.append("\t".join([time_text(key[0]), *(column.get(key, "") for column in columns)]))
    return "\n".join(rows) + "\n"


def _cells(series: Series) -> dict[tuple[float, int], str]:
    """{(time, how many values of this time came before): the value}."""
    digits = max(0, math.ceil(-math.log10(series.error / FINE)))
    cells: dict[tuple[float, int], str] = {}
    for t, value in zip(map(float, series.t), series.values, strict=True):
        again = next(i for i in itertools.count() if (t, i) not in cells)
        cells[t, again] = f"{value:.{digits}f}"
    return cells


def time_text(t: float) -> str:
    """A time in s to the microsecond, so that times and the part of a film are rounded in the same way, and frames stay
    distinct however late a film begins."""
    return np.format_float_positional(round(t, MICRO), trim="-")


def written(film: Film, data: Data) -> str:
    """The text of a film's data and settings."""
    top, scales = film.top, film.scales
    stored = {
        "law": film.law,
        "loose": film.loose,
        "part": [round(each, MICRO) for each in film.part],
        "top": [top.a, top.I1, top.I3, scales.R, scales.M, scales.g],
        "body": json.loads(save_top(film.shape)) if film.shape else None,
    } | ({"fits": film.fits} if film.fits else {})
    return f"{MARK} {json.dumps(stored)}\n{table_of(data)}"


def opened(text: str | bytes) -> Film | None:
    """The settings in a text, None if it is only a table. Raises MeasuredError if they cannot be read."""
    plain = text.decode("utf-8-sig", "replace") if isinstance(text, bytes) else text.removeprefix("\ufeff")
    for line, stored in enumerate(plain[:LARGEST].split("\n", 20)[:20], 1):
        if stored.startswith(MARK):
            try:
                return _film(json.loads(stored[len(MARK) :], parse_int=float))
            except (ValueError, TypeError, KeyError, RecursionError, TopError):
                raise MeasuredError("film", line=line) from None
    return None


def _film(stored: Any) -> Film:
    law, loose, part, top = stored["law"], tuple(stored["loose"]), stored["part"], stored["top"]
    numbers = np.array([*part, *top], dtype=float)
    if law not in OF_LAW or law == "rolling" or set(loose) - set(LOOSE) or numbers.shape != (8,):
        raise ValueError(law)
    if not np.isfinite(numbers).all() or min(numbers[5:]) <= 0:
        raise ValueError("numbers")
    start, end, a, I1, I3, R, M, g = map(float, numbers)
    shape = load_top(json.dumps(stored["body"])) if stored["body"] else None
    film = Film(law, loose, (start, end), Top(a, I1, I3), Scales(R, M, g), shape)
    fits = stored.get("fits", ())
    if fits and all("covariance" in each for each in fits):  # without, it is of before correlations were kept: fit anew
        both = models(film.top, film.scales, shape, law, film.free)
        return replace(film, fits=tuple(checked(each, model) for each, model in zip(fits, both, strict=True)))
    return film


def packed(text: str) -> str:
    """The text in letters and digits, for a link; "" if it is too long."""
    letters = base64.urlsafe_b64encode(zlib.compress(text.encode(), 9)).decode().rstrip("=")
    return letters if len(letters) <= LONGEST_PACKED else ""


def unpacked(letters: str) -> str:
    """The text that packed() compressed. Raises ValueError."""
    unpack = zlib.decompressobj()
    try:
        text = unpack.decompress(base64.urlsafe_b64decode(letters + "=" * (-len(letters) % 4)), LARGEST).decode()
        if not unpack.eof:
            raise ValueError("length")
        return text
    except (binascii.Error, zlib.error, ValueError):
        raise ValueError("film") from None
