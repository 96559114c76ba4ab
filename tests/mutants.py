"""Would a wrong formula be noticed? python tests/mutants.py (hours; --share, --minutes for less).

In statements that compute something one sign and one factor are changed, one at a time, in a process of its own, and
the tests that run through the statement (reach.py) are run until one fails: first those that noticed a change near it,
then those that are quick and run through little else, then what else is in the files of the first of them: other
parameters, and tests that look at a result which another test had computed before. data/mutants.jsonl keeps
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
import os
import re
import signal
import subprocess
import sys
import time
from collections import Counter, defaultdict
from dataclasses import dataclass
from pathlib import Path

import pytest
from fingerprint import core
from mutants_page import EXPLAINED, LOG, PAGE, STORES, functions_in, logged, page, unquoted
from mutation import sites
from reach import KEPT, OPTIONS, PARTS, ROOT, SECONDS, in_turn, marks, prepare, statements

EACH = 2
"""So many changes of each file are tried at least."""
SHARE = 0.25
"""Of the other changes; those of functions in docs/equations.md are all tried."""
MINUTES = 2
"""Of the processor for all tests of one change."""
FIRST = 8
"""So many tests are tried before the files of all the others are read."""


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
    def function(self):
        """(it, its hash)"""
        return next((node, mark) for node, mark in functions_in(core(), self.path)
                    if node.lineno <= self.line <= node.end_lineno)  # fmt: skip

    @property
    def place(self):
        """(name of its function, hash of that)"""
        return self.function[0].name, self.function[1]

    @property
    def statement(self):
        """Its number in the function."""
        return next(i for i, (line, _) in enumerate(statements(self.function[0])) if line == self.line)

    @property
    def key(self):
        return self.place[1], self.before, self.after

    @property
    def draw(self):
        """Between 0 and 1, the same for the same change."""
        return drawn(f"{self.before}\n{self.after}") / 2**256


def drawn(text):
    """A number below 2**256."""
    return int(hashlib.sha256(unquoted(text).encode()).hexdigest(), 16)


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


@functools.cache
def mutants(path):
    """All of a file."""
    return [*_mutants(path)]


def _mutants(path):
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
    for path in sorted(path for path in core().paths.values() if Path(path).stem not in STORES):
        each = sorted(mutants(path), key=lambda mutant: mutant.draw)
        drawn += [mutant for i, mutant in enumerate(each)
                  if i < EACH or mutant.draw < share
                  or (path in files and (path, mutant.place[0]) in printed)]  # fmt: skip
    return sorted(drawn, key=lambda mutant: mutant.draw)


@functools.cache
def reach(part):
    """What reach.py has kept of a part, the tests of each statement of a function by its hash, and in how many
    functions each test is."""
    kept = json.loads(KEPT.read_text(encoding="utf-8"))[part]
    by_mark = marks(kept)
    width = Counter(test for numbers in by_mark.values() for test in {t for n in numbers for t in kept["sets"][n]})
    return kept, by_mark, width


def tests_of(mutant):
    """[(test, seconds that it takes)] in the order in which they are tried; of a function that is new, those of the one
    that had its name, or of its file."""
    kept, by_mark, width = reach(mutant.part)
    name, mark = mutant.place
    if mark in by_mark:
        numbers = {by_mark[mark][mutant.statement]}
    else:
        of_file = kept["reached"].get(mutant.path, {})
        near = of_file[name].values() if name in of_file else (each for of in of_file.values() for each in of.values())
        numbers = {number for each in near for number in each}
    tests = {test for number in numbers for test in kept["sets"][number]}
    here, there = witnesses()[mark], witnesses()[mutant.path]

    def rank(test):
        name, seconds = kept["tests"][test]
        name = name.partition("[")[0]
        return -here[name], -min(there[name], 3), (seconds + 0.3) * width[test]

    return [tuple(kept["tests"][test]) for test in sorted(tests, key=rank)]


@functools.cache
def witnesses():
    """{hash of a function, or path: Counter of the tests that noticed a change in it}"""
    found = defaultdict(Counter)
    paths = {mark: path for path in core().paths.values() for _, mark in functions_in(core(), path)}
    for line in logged():
        if line.get("code") in paths and line["test"]:
            for place in (line["code"], paths[line["code"]]):
                found[place][line["by"]] += 1
    return found


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
    """A pytest plugin that runs these tests in this order, or the others of their files, and keeps the first that
    fails. It ends a process in which one takes some times as long as it did."""

    def __init__(self, seconds, limit, others):
        self._seconds, self._limit, self._others, self.by, self.all = seconds, limit, others, "", True

    @pytest.hookimpl(trylast=True)
    def pytest_collection_modifyitems(self, items):
        named = {name_of(item.nodeid): item for item in items}
        if self._others:
            functions = {test.partition("[")[0] for test in self._seconds}
            mine = sorted((name for name in named if name not in self._seconds),
                          key=lambda name: name.partition("[")[0] not in functions)  # fmt: skip
        else:
            mine = [name for name in self._seconds if name in named]
        items[:] = [named[name] for name in mine]

    def pytest_runtest_logstart(self, nodeid):
        signal.setitimer(signal.ITIMER_VIRTUAL, 10 + 5 * self._seconds.get(name_of(nodeid), SECONDS))
        signal.alarm(600)  # one that waits for ever

    def pytest_runtest_logfinish(self):
        if not self.by and time.process_time() > self._limit:
            self.all = False
            raise KeyboardInterrupt

    def pytest_runtest_logreport(self, report):
        if report.failed:
            self.by = name_of(report.nodeid).partition("[")[0]

    pytest_collectreport = pytest_runtest_logreport


def name_of(nodeid):
    return nodeid.removeprefix("tests/")


def noticed(limit, mutant):
    """(the test that fails with this change, "" if none does; whether all were run; the seconds that it took).
    limit: of these."""
    tests = tests_of(mutant)
    sys.meta_path.insert(0, Changed(mutant.path, source_of(mutant)))
    for some, others in ((tests[:FIRST], False), (tests[FIRST:], False), (tests[:FIRST], True)):
        by, whole = tried(dict(some), limit, others)
        if by or not whole:
            break
    return by, bool(tests) and whole, round(time.process_time(), 1)


def tried(tests, limit, others):
    """(the first of these tests that fails, or of their other parameters, or ""; whether all were run)"""
    files = dict.fromkeys(ROOT / "tests" / test.partition("::")[0] for test in tests)
    paths = [str(file) for file in files if file.exists()]
    if not paths:
        return "", True
    witness = Witness(tests, limit, others)
    status = pytest.main(["-x", *OPTIONS, "-m", "not served", *paths], plugins=[witness])
    return witness.by or ("an error" if status in (3, 4) else ""), witness.all


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
            if mutant.part == part and mutant.key not in before and options.only in mutant.path
            and time.monotonic() - start < 60 * options.minutes)  # fmt: skip
    for mutant, answer in in_turn(functools.partial(noticed, 60 * options.limit), todo, options.processes):
        by, whole, seconds = answer or ("no end", True, None)
        line = {"file": Path(mutant.path).stem, "before": mutant.before, "after": mutant.after, "by": by,
                "test": digest_of(by), "rest": not by and not whole, "code": mutant.place[1], "commit": commit.strip(),
                "date": str(datetime.date.today()), "seconds": seconds}  # fmt: skip
        with LOG.open("a", encoding="utf-8") as log:
            log.write(json.dumps(line, ensure_ascii=False) + "\n")
        if line["test"]:
            for place in (mutant.place[1], mutant.path):
                witnesses()[place][by] += 1
        print(f"{mutant.path}: {by or 'SURVIVES'} {mutant.after}", flush=True)


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("--share", type=float, default=SHARE, help="of the changes that no printed equation has")
    options.add_argument("--minutes", type=float, default=float("inf"), help="for each part; then write the page")
    options.add_argument("--limit", type=float, default=MINUTES, help="minutes of the processor for each change")
    options.add_argument("--processes", type=int, default=os.cpu_count(), help="so many at once; else one a core")
    options.add_argument("--again", action="store_true", help="try anew what no test noticed")
    options.add_argument("--only", default="", metavar="PATH", help="changes of files with this in their path")
    options.add_argument("--part", choices=PARTS, help="this one alone, without the page")
    chosen = options.parse_args()
    if chosen.part:
        run(chosen.part, chosen)
    else:
        for part in PARTS:
            subprocess.run([sys.executable, __file__, *sys.argv[1:], "--part", part], check=True)
        last = (json.dumps(line, ensure_ascii=False) + "\n" for line in logged())
        LOG.write_text("".join(last), encoding="utf-8")
        PAGE.write_text(text(), encoding="utf-8")


if __name__ == "__main__":
    main()
