"""Runs the tests that give evidence and writes docs/validation.md from what they found: python tests/validation.py.

The whole accuracy map is computed here too; the test suite takes a sample of it. --rows leaves the map and the films as
they are. What was found is in data/validation.json, each row with its date and a hash of the functions it is about;
`python tests/ages.py` writes the page anew from it, after a change of these functions, and computes nothing.
"""

import argparse
import datetime
import inspect
import json
import platform
import sys
from pathlib import Path

import accuracy
import measured_proof
import mpmath
import numpy as np
import pytest
import scipy
import sympy
from claims import ROWS, SLIPS
from fingerprint import fingerprint

import tippe_core

TESTS = Path(__file__).parent
PAGE = TESTS.parent / "docs" / "validation.md"
FILE = TESTS / "data" / "validation.json"


class Collector:
    """A pytest plugin: row -> [(difference, allowed, against, test)] of the tests that passed."""

    def __init__(self):
        self.found, self.failed = {}, []

    def pytest_runtest_logreport(self, report):
        if report.failed:
            self.failed.append(report.nodeid)
        elif report.when == "call":
            for name, value in report.user_properties:
                if name == "evidence":
                    row, *rest = value
                    self.found.setdefault(row, []).append((*rest, report.nodeid.split("[")[0]))


def files():
    """Those whose tests use the fixture."""
    return sorted(str(p) for p in TESTS.glob("test_*.py") if "compare(" in p.read_text())


def code_of(functions):
    """The hash of what a row is about: names of tippe_core as in the table; of a method, its class."""
    return fingerprint(*(getattr(tippe_core, name.split(".")[0]) for name in functions.split(", ")))


def today():
    """What is noted of something that is computed now."""
    versions = ", ".join(f"{each.__name__} {each.__version__}" for each in (np, scipy, mpmath, sympy))
    return {"date": str(datetime.date.today()),
            "with": f"{platform.machine()}, Python {platform.python_version()}, {versions}"}  # fmt: skip


def found_for(key, functions, found):
    """A row of the file: [compared with, largest difference, allowed, tests]."""
    by_oracle = {}
    for difference, allowed, against, test in found[key]:
        most, limit, tests = by_oracle.get(against, (0.0, 0.0, set()))
        by_oracle[against] = max(most, difference), max(limit, allowed), tests | {test.split("/")[-1]}
    lines = [(against, most, limit, sorted(tests)) for against, (most, limit, tests) in sorted(by_oracle.items())]
    return {**today(), "code": code_of(functions), "found": lines}


def table(rows, kept):
    yield "| what | it says | functions | compared with | largest difference | allowed | tests | computed |"
    yield "|---|---|---|---|---|---|---|---|"
    for key, (says, functions) in rows.items():
        row = kept[key]
        when = row["date"] if row["code"] == code_of(functions) else f"{row['date']}, older code"
        for i, (against, most, limit, tests) in enumerate(row["found"]):
            first, last = ((f"**{key}**", says, f"`{functions}`"), when) if i == 0 else (("", "", ""), "")
            names = ", ".join(f"`{test}`" for test in tests)
            cells = *first, against, f"{most:.1e}", f"{limit:.1e}", names, last
            yield "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def ages(kept):
    """How much of the page is of today's code."""
    rows = {key: functions for rows in ROWS.values() for key, (_, functions) in rows.items()}
    old = [key for key, functions in rows.items() if kept["rows"][key]["code"] != code_of(functions)]
    if old:
        yield (f"**{len(old)} of the {len(rows)} rows are not of today’s code**: a function that they go through has "
               "changed since. They are marked “older code”.")  # fmt: skip
    else:
        yield f"All {len(rows)} rows are of today’s code."
    yield measured_proof.age([*measured_proof.kept().values()])
    same = kept["map"]["code"] == map_code()
    yield (f"The accuracy map was computed on {kept['map']['date']}"
           + (" with today’s code." if same else ": **it is not of today’s code**."))  # fmt: skip


def map_code():
    return fingerprint(*(each for each in vars(accuracy).values() if getattr(each, "__name__", "") in
                         tippe_core.__all__))  # fmt: skip


def page(kept):
    yield "# Validation"
    yield ""
    yield ("Written by `make validation` from the results of the tests, not by hand. Each row has a statement of the "
           "paper, the functions of tippe_core that it concerns, what they were compared with, and the largest "
           "difference found. Differences are absolute, in units of R, M and g, or relative to the size of the terms "
           "if these are large; “allowed” is the largest difference that the test accepts.")  # fmt: skip
    yield ""
    yield " ".join(ages(kept))
    yield ""
    made = sorted({row["with"] for row in [*kept["rows"].values(), kept["map"]] if row["with"]})
    yield f"Computed on {'; '.join(made)}."
    for name, rows in ROWS.items():
        yield f"\n## {name}\n"
        yield from table(rows, kept["rows"])
    yield "\n## Slips in the paper\n"
    yield "| what | evidence | row |\n|---|---|---|"
    for what, evidence, row in SLIPS:
        yield f"| {what} | {evidence} | {row} |"
    yield "\n## Tops on film\n"
    yield from kept["films"]["lines"]
    yield "\n## Accuracy map\n"
    yield inspect.getdoc(accuracy)
    yield ""
    yield from kept["map"]["lines"]


def text():
    """The page, of what is kept."""
    return "\n".join(page(json.loads(FILE.read_text(encoding="utf-8")))) + "\n"


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("--rows", action="store_true", help="only what the tests find, not the map and the films")
    only_rows = options.parse_args().rows
    collector = Collector()
    code = pytest.main(["-q", "-p", "no:cacheprovider", *files()], plugins=[collector])
    rows = {key: functions for rows in ROWS.values() for key, (_, functions) in rows.items()}
    missing = [row for row in rows if row not in collector.found]
    if code or missing:
        sys.exit(f"not written: failed {collector.failed}, rows without evidence {missing}")
    kept = json.loads(FILE.read_text(encoding="utf-8")) if only_rows else {}
    kept["rows"] = {key: found_for(key, functions, collector.found) for key, functions in rows.items()}
    if not only_rows:
        kept["films"] = {"lines": [*measured_proof.lines([*measured_proof.kept().values()])]}
        kept["map"] = {**today(), "code": map_code(), "lines": [*accuracy.report(accuracy.MANY)]}
    FILE.write_text(json.dumps(kept, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    PAGE.write_text(text(), encoding="utf-8")


if __name__ == "__main__":
    main()
