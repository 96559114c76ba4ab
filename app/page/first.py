"""The page around Bokeh's: it shows the moving top of the arrival before the scripts, the session and the controls are
there.

On arrival the Lab is the same in every session. Its words are written into the page; its numbers are in a file that the
browser caches. early.js requests the file, frontend/src/first.js draws both, and hands the picture over to the
session's component once that is there. Bokeh's scripts, twice as large, are fetched after that; on any other address
at once.

    python -m app.page.first

writes the file anew, after `python -m app.model.arrival`; a test compares it with what a session sends.
"""

import gzip
import hashlib
import json
from functools import cache
from pathlib import Path
from urllib.parse import urlencode

import numpy as np

from app.bundle import BUNDLE, Bundled, address_of, as_json, inlined, values_of
from app.model.lab.lab import Lab
from app.state import names
from app.state import opened as room
from app.tabs.lab.lab import LabTab
from app.text import LANGUAGES, speaking
from app.widgets.look import FAMILY
from app.widgets.waiting import waiting

PAGE = Path(__file__).with_name("first.html")
TEMPLATE = PAGE.read_text(encoding="utf-8")
EARLY, BORROWED = inlined(PAGE.with_name("early.js")), inlined(PAGE.parents[1] / "borrowed.js")
FILE = Path(__file__).with_name("arrival.gz")
FRAME, POSE, CURVE = 21, 11, 8  # columns: of a frame (pack_frames), of these its pose, and of a curve
NUMBERS = {"profile": (2, 2, 2**20), "frames_ordinary": (FRAME, POSE, 2**12), "curves_ordinary": (CURVE, CURVE, 2**7)}
"""{array of a LabView: (columns, those that are needed at first, steps per unit)}."""


class Numbers:
    """Tells Panel's server where the file is."""

    _bundle_path = FILE


def arrival():
    """A LabView as it is on arrival, without a session."""
    lab = Lab()
    lab.show()
    lab.rest()
    return LabTab(lab, None).view


def written(view, numbers=NUMBERS):
    """The file: a line of JSON, [[name, rows, columns, stored columns, steps per unit], ...], then each column as the
    second differences of its whole steps, which are too small to be seen, as int32: it compresses well."""
    heads, parts = [], []
    for name, (width, needed, steps) in numbers.items():
        rows = np.frombuffer(getattr(view, name), "<f4").reshape(-1, width)
        heads.append([name, len(rows), width, needed, steps])
        counts = np.round(rows[:, :needed].T.astype(float) * steps)
        parts.append(np.diff(np.pad(counts, ((0, 0), (2, 0))), n=2).astype("<i4").tobytes())
    return gzip.compress(b"\n".join([json.dumps(heads).encode(), b"".join(parts)]), 9, mtime=0)


@cache
def words():
    """JSON of {language: everything else in a LabView on arrival}."""
    found = {}
    for language in LANGUAGES:
        with speaking(language):
            view = arrival()
            kept = values_of(view)
        found[language] = {name: value for name, value in kept.items() if not isinstance(value, bytes)}
    return as_json(found)


def searches():
    """{query that opens the arrival and nothing else: its language, or "" for the browser's}."""
    found = {}
    for tab in ({}, {names.TAB: room.FIRST}):
        for language in ("", *LANGUAGES):
            request = tab | ({names.LANGUAGE: language} if language else {})
            versions = ({}, {names.VERSION_NAME: str(names.VERSION)})
            found |= {names.query(more | request) if more | request else "": language for more in versions}
    return found


@cache
def version():
    return hashlib.sha256(FILE.read_bytes()).hexdigest()[:12]


def variables(language):
    """The variables of TEMPLATE; language: that of the page."""
    bundle = address_of(Bundled, BUNDLE)
    early = {"language": language, "bundle": bundle, "searches": searches(),
             "numbers": f"{address_of(Numbers, FILE)}?{urlencode({'v': version()})}"}  # fmt: skip
    return {"bundle": bundle, "first": words(), "early": as_json(early),
            "early_script": EARLY, "borrowed": BORROWED, "family": FAMILY, "waiting": waiting(language)}  # fmt: skip


if __name__ == "__main__":
    FILE.write_bytes(written(arrival()))
