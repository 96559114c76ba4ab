"""In which order the files of tests run, and how long each takes: durations.json, written with --write-durations.

pytest-randomly shuffles the tests of a file; --randomly-seed repeats an order. Files run longest first, so that no
worker is left alone with a long one at the end.
"""

import json
from collections import Counter, defaultdict
from pathlib import Path

import pytest

TESTS = Path(__file__).parent
STORED = TESTS / "durations.json"
SLOW = 1.0  # s: only tests that take longer are stored by name


def stored():
    """{file: {"seconds": of all its tests, "slow": {test: seconds}}}"""
    return json.loads(STORED.read_text(encoding="utf-8")) if STORED.exists() else {}


def in_order(files, seconds, shortest=False):
    """Longest first, or shortest; a file that was never timed is taken for a long one."""
    return sorted(files, key=lambda file: seconds.get(file, float("inf")), reverse=not shortest)


def updated(old, tests):
    """old: as stored. tests: Counter of the seconds of {(file, test): seconds} that have run now; other files keep
    theirs as long as they exist."""
    found = defaultdict(dict)
    for (file, test), seconds in tests.items():
        found[file][test] = seconds
    new = {file: {"seconds": round(sum(each.values()), 1),
                  "slow": {test: round(seconds, 1) for test, seconds in sorted(each.items(), key=lambda one: -one[1])
                           if seconds > SLOW}}
           for file, each in found.items()}  # fmt: skip
    every = {file: each for file, each in old.items() if (TESTS / file).exists()} | new
    return {file: every[file] for file in in_order(every, {file: each["seconds"] for file, each in every.items()})}


class Durations:
    """A pytest plugin."""

    def __init__(self, config):
        self.shortest = config.getoption("--shortest-first")
        self.write = config.getoption("--write-durations") and not hasattr(config, "workerinput")
        self.tests = Counter()

    def pytest_collection_modifyitems(self, items):
        """Keeps the order within each file, which pytest-randomly and pytest have chosen before."""
        seconds = {file: each["seconds"] for file, each in stored().items()}
        files = in_order(dict.fromkeys(item.path.name for item in items), seconds, self.shortest)
        place = {file: i for i, file in enumerate(files)}
        items.sort(key=lambda item: place[item.path.name])

    def pytest_runtest_logreport(self, report):
        file, _, test = report.nodeid.partition("::")
        self.tests[Path(file).name, test] += report.duration

    @pytest.hookimpl(trylast=True)
    def pytest_sessionfinish(self):
        if self.write and self.tests:
            STORED.write_text(json.dumps(updated(stored(), self.tests), indent=1, ensure_ascii=False) + "\n",
                              encoding="utf-8")  # fmt: skip
