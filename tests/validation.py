"""Runs the tests that give evidence and writes docs/validation.md from what they found: python tests/validation.py.

The whole accuracy map is computed here too; the test suite takes a sample of it.
"""

import datetime
import inspect
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

TESTS = Path(__file__).parent
PAGE = TESTS.parent / "docs" / "validation.md"


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


def table(rows, found):
    yield "| what | it says | functions | compared with | largest difference | allowed | tests |"
    yield "|---|---|---|---|---|---|---|"
    for key, (says, functions) in rows.items():
        by_oracle = {}
        for difference, allowed, against, test in found[key]:
            most, limit, tests = by_oracle.get(against, (0.0, 0.0, set()))
            by_oracle[against] = max(most, difference), max(limit, allowed), tests | {test.split("/")[-1]}
        for i, (against, (most, limit, tests)) in enumerate(sorted(by_oracle.items())):
            first = (f"**{key}**", says, f"`{functions}`") if i == 0 else ("", "", "")
            names = ", ".join(f"`{test}`" for test in sorted(tests))
            cells = *first, against, f"{most:.1e}", f"{limit:.1e}", names
            yield "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def page(found, accuracy_lines):
    yield "# Validation"
    yield ""
    yield ("Written by `make validation` from the results of the tests, not by hand. Each row has a statement of the "
           "paper, the functions of tippe_core that it concerns, what they were compared with, and the largest "
           "difference found. Differences are absolute, in units of R, M and g, or relative to the size of the terms "
           "if these are large; “allowed” is the largest difference that the test accepts.")  # fmt: skip
    yield ""
    yield (f"{datetime.date.today()}, {platform.machine()}, Python {platform.python_version()}, "
           f"numpy {np.__version__}, scipy {scipy.__version__}, mpmath {mpmath.__version__}, "
           f"sympy {sympy.__version__}.")  # fmt: skip
    for name, rows in ROWS.items():
        yield f"\n## {name}\n"
        yield from table(rows, found)
    yield "\n## Slips in the paper\n"
    yield "| what | evidence | row |\n|---|---|---|"
    for what, evidence, row in SLIPS:
        yield f"| {what} | {evidence} | {row} |"
    yield "\n## Tops on film\n"
    yield from measured_proof.lines([*measured_proof.kept().values()])
    yield "\n## Accuracy map\n"
    yield inspect.getdoc(accuracy)
    yield ""
    yield from accuracy_lines


def main():
    collector = Collector()
    code = pytest.main(["-q", "-p", "no:cacheprovider", *files()], plugins=[collector])
    missing = [row for rows in ROWS.values() for row in rows if row not in collector.found]
    if code or missing:
        sys.exit(f"not written: failed {collector.failed}, rows without evidence {missing}")
    PAGE.write_text("\n".join(page(collector.found, accuracy.report(accuracy.MANY))) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
