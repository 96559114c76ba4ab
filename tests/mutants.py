"""Would a wrong formula be noticed? python tests/mutants.py (hours; --share, --minutes for less).

In statements that compute something one sign and one factor are changed, one at a time, in a process of its own, and
the tests that run through the function are run until one fails, the quickest first (reach.py). data/mutants.jsonl keeps
what each change came to, docs/mutants.md tells it (mutants_page.py). What is known is not tried again, unless the
function that was changed or the test that noticed it is another now.
"""

import argparse
import ast
import datetime
import functools
import hashlib
import importlib.abc
import importlib.util
import json
import re
import signal
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

from fingerprint import core
from mutants_page import EXPLAINED, LOG, PAGE, functions_in, logged, page
from mutation import sites
from reach import KEPT, OPTIONS, PARTS, ROOT, in_turn, prepare

EACH = 2
"""So many changes of each file are tried at least."""
SHARE = 0.25
"""Of the other changes; those of functions in docs/equations.md are all tried."""
MINUTES = 5
"""Of the processor for all tests of one change."""


@dataclass(frozen=True)
class Mutant:
    path: str
    number: int
    """Of the change in this file."""
    line: int
    before: str
    after: str

    @property
    def part(self):
        return next(part for part in PARTS if self.path.startswith(part))

    @functools.cached_property
    def place(self):
        """(name of its function, hash of that)."""
        return next((node.name, mark) for node, mark in functions_in(core(), self.path)
                    if node.lineno <= self.line <= node.end_lineno)  # fmt: skip

    @property
    def key(self):
        return self.place[1], self.before, self.after

    @property
    def draw(self):
        """Between 0 and 1, the same for the same change."""
        return drawn(f"{self.before}\n{self.after}") / 2**256


def drawn(text):
    """A number below 2**256; each Python writes the quotes of a formatted string in its own way."""
    return int(hashlib.sha256(re.sub("[\"']", "", text).encode()).hexdigest(), 16)


def changes(tree):
    """One sign and one factor of each statement, chosen by the statement's hash: (statement, its text, the text with
    the change, what makes the change)."""
    groups = {}
    for site in sites(tree):
        groups.setdefault((id(site[0]), site[1]), []).append(site)
    for group in groups.values():
        before = ast.unparse(group[0][0])
        statement, _, node, field, value = group[drawn(before) % len(group)]
        kept, change = getattr(node, field), functools.partial(setattr, node, field, value)
        change()
        yield statement, before, ast.unparse(statement), change
        setattr(node, field, kept)


def mutants(path):
    """All of a file."""
    for number, (statement, before, after, _) in enumerate(changes(ast.parse((ROOT / path).read_text("utf-8")))):
        pairs = zip(before.splitlines(), after.splitlines(), strict=True)
        for old, new in ((old.strip(), new.strip()) for old, new in pairs if old != new):
            yield Mutant(path, number, statement.lineno, old, new)


def source_of(mutant):
    """Of the file with the change."""
    tree = ast.parse((ROOT / mutant.path).read_text("utf-8"))
    *_, change = next(each for number, each in enumerate(changes(tree)) if number == mutant.number)
    change()
    return ast.unparse(tree)


def equations():
    """{(path, function)} of docs/equations.md."""
    rows = re.findall(r"\| `([\w/]+\.py)` \| (.*) \|", (ROOT / "docs" / "equations.md").read_text(encoding="utf-8"))
    return {(f"tippe_core/{path}", name) for path, names in rows for name in re.findall(r"`([\w.]+)`", names)}


def sample(share):
    """All changes of the equations, some of each file, and a share of the others; in an order that is drawn, so that
    what is known after some time is a sample, too."""
    drawn, printed = [], equations()
    files = {path for path, _ in printed}
    for path in sorted(core().paths.values()):
        each = sorted(mutants(path), key=lambda mutant: mutant.draw)
        drawn += [mutant for i, mutant in enumerate(each)
                  if i < EACH or mutant.draw < share
                  or (path in files and (path, mutant.place[0]) in printed)]  # fmt: skip
    return sorted(drawn, key=lambda mutant: mutant.draw)


@functools.cache
def reach(part):
    kept = json.loads(KEPT.read_text(encoding="utf-8"))[part]
    return [tuple(each) for each in kept["tests"]], kept["reached"]


def tests_of(mutant):
    """[(test, seconds that it takes)]; of a function that is new, those of the others of its file."""
    tests, reached = reach(mutant.part)
    of_file = reached.get(mutant.path, {})
    numbers = of_file.get(mutant.place[0]) or {number for each in of_file.values() for number in each}
    return sorted((tests[number] for number in numbers), key=lambda test: test[1])


class Changed(importlib.abc.MetaPathFinder, importlib.abc.Loader):
    """Imports one module from a changed source."""

    def __init__(self, path, source):
        self._name, self._source = ".".join(Path(path).with_suffix("").parts), source

    def find_spec(self, name, path, target=None):
        return importlib.util.spec_from_loader(name, self) if name == self._name else None

    def create_module(self, spec):
        return None

    def exec_module(self, module):
        exec(compile(self._source, self._name, "exec"), module.__dict__)


class Witness:
    """A pytest plugin that keeps the first test that fails, and ends a process in which one takes ten times as long as
    it did."""

    def __init__(self, seconds):
        self._seconds, self.by, self.all = seconds, "", True

    def pytest_runtest_logstart(self, nodeid):
        signal.setitimer(signal.ITIMER_VIRTUAL, 20 + 10 * self._seconds.get(nodeid.removeprefix("tests/"), 0))

    def pytest_runtest_logfinish(self):
        if not self.by and time.process_time() > 60 * MINUTES:
            self.all = False
            raise KeyboardInterrupt

    def pytest_runtest_logreport(self, report):
        if report.failed:
            self.by = report.nodeid.split("/")[-1].split("[")[0]

    pytest_collectreport = pytest_runtest_logreport


def noticed(mutant):
    """(the test that fails with this change, "" if none does; whether all were run)."""
    import pytest

    tests = dict(tests_of(mutant))
    if not tests:
        return "", False
    sys.meta_path.insert(0, Changed(mutant.path, source_of(mutant)))
    witness = Witness(tests)
    paths = [str(ROOT / "tests" / test) for test in tests if (ROOT / "tests" / test.split("::")[0]).exists()]
    status = pytest.main(["-x", *OPTIONS, *paths], plugins=[witness])
    return witness.by or ("an error" if status not in (0, 2) else ""), witness.all


@functools.cache
def functions_of(file):
    """{name: its source} of a file of tests."""
    path = ROOT / "tests" / file
    text = path.read_text(encoding="utf-8") if path.exists() else ""
    return {node.name: ast.get_source_segment(text, node)
            for node in ast.walk(ast.parse(text)) if isinstance(node, ast.FunctionDef)}  # fmt: skip


def digest_of(nodeid):
    """Of the text of a test; "" where it is none."""
    file, _, function = nodeid.partition("::")
    text = functions_of(file).get(function, "") if function else ""
    return hashlib.sha256(text.encode()).hexdigest()[:12] if text else ""


def known(again):
    """{key of a change: its line of the log} as far as it can be taken as it is: the test that noticed it is the same.
    again: without those that no test noticed."""
    return {
        (line.get("code"), line["before"], line["after"]): line
        for line in logged()
        if (line["by"] in ("no end", "an error") or line["test"] == digest_of(line["by"]))
        and not (again and line["by"] == "" and (line["file"], line["after"]) not in EXPLAINED)
    }


def text():
    """The page, of what is kept."""
    return "\n".join(page(logged(), len(sample(SHARE)))) + "\n"


def run(part, options):
    """Tries the changes of one part, which prepare() has to be called for once in a process."""
    prepare(part)
    reach(part)  # once, for all children
    start, before = time.monotonic(), known(options.again)
    commit = subprocess.run(["git", "rev-parse", "--short", "HEAD"], cwd=ROOT, capture_output=True, text=True).stdout
    todo = (mutant for mutant in sample(options.share)
            if mutant.part == part and mutant.key not in before
            and time.monotonic() - start < 60 * options.minutes)  # fmt: skip
    for mutant, answer in in_turn(noticed, todo):
        by, whole = answer or ("no end", True)
        line = {"file": Path(mutant.path).stem, "before": mutant.before, "after": mutant.after, "by": by,
                "test": digest_of(by), "rest": not by and not whole, "code": mutant.place[1], "commit": commit.strip(),
                "date": str(datetime.date.today())}  # fmt: skip
        with LOG.open("a", encoding="utf-8") as log:
            log.write(json.dumps(line, ensure_ascii=False) + "\n")
        print(f"{mutant.path}: {by or 'SURVIVES'} {mutant.after}", flush=True)


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("--share", type=float, default=SHARE, help="of the changes that no printed equation has")
    options.add_argument("--minutes", type=float, default=float("inf"), help="for each part; then write the page")
    options.add_argument("--again", action="store_true", help="try anew what no test noticed")
    options.add_argument("--part", choices=PARTS, help="this one alone, without the page")
    chosen = options.parse_args()
    if chosen.part:
        run(chosen.part, chosen)
    else:
        for part in PARTS:
            subprocess.run([sys.executable, __file__, *sys.argv[1:], "--part", part], check=True)
        PAGE.write_text(text(), encoding="utf-8")


if __name__ == "__main__":
    main()
