"""Which tests run through which function of the core and the model: python tests/reach.py writes data/reach.json, from
which mutants.py takes the tests that it runs. Kernels run as Python; a test that takes more than 20 s of the
processor so is left out."""

import json
import multiprocessing
import os
import signal
import sys
import time
from itertools import islice
from multiprocessing.connection import wait
from pathlib import Path

from fingerprint import core
from mutants_page import functions_in

ROOT = Path(__file__).parent.parent
KEPT = ROOT / "tests" / "data" / "reach.json"
OPTIONS = ["-q", "-p", "no:cacheprovider", "-p", "no:xdist", "-p", "no:randomly", "--rootdir", str(ROOT)]
SECONDS = 20
EACH = 3
"""So many tests are kept of those that reach a line: the quickest."""


def in_turn(call, arguments):
    """(argument, call(argument), or None where a signal ended it), each in a child of this process, one a core: a
    child has the libraries that are imported here, and what it changes goes with it."""
    fork, waiting, running = multiprocessing.get_context("fork"), iter(arguments), {}
    while True:
        for argument in islice(waiting, os.cpu_count() - len(running)):
            mine, its = fork.Pipe(duplex=False)
            child = fork.Process(target=_answer, args=(its, call, argument))
            child.start()
            its.close()
            running[mine] = argument, child
        if not running:
            return
        for pipe in wait(running):
            argument, child = running.pop(pipe)
            try:
                answer = pipe.recv()
            except EOFError:
                answer = None
            child.join()
            if child.exitcode > 0:  # a mistake here is no answer
                raise RuntimeError(f"{call.__name__}({argument}) failed")
            yield argument, answer


def _answer(pipe, call, argument):
    sink = os.open(os.devnull, os.O_WRONLY)
    os.dup2(sink, 1)
    os.dup2(sink, 2)
    pipe.send(call(argument))


class Reach:
    """A pytest plugin that measures which lines each test runs through, and for how long."""

    def __init__(self, coverage):
        self._coverage, self.seconds, self._start = coverage, {}, 0.0

    def pytest_runtest_logstart(self, nodeid):
        self._coverage.switch_context(nodeid)
        self._start = time.process_time()
        signal.setitimer(signal.ITIMER_VIRTUAL, SECONDS)

    def pytest_runtest_logreport(self, report):
        if report.when == "call" and report.passed:
            self.seconds[report.nodeid] = round(time.process_time() - self._start, 2)
        if report.when == "teardown":
            signal.setitimer(signal.ITIMER_VIRTUAL, 0)
            self._coverage.switch_context("")


def stop(*_):
    raise TimeoutError(f"longer than {SECONDS} s")


def measured(file):
    """{test: seconds}, {path: {line: [test]}} of a file of tests."""
    import coverage
    import pytest

    signal.signal(signal.SIGVTALRM, stop)
    code = [f"{ROOT}/tippe_core/*", f"{ROOT}/app/model/*"]
    measure = coverage.Coverage(data_file=None, include=code, config_file=False)
    reach = Reach(measure)
    measure.start()
    pytest.main([*OPTIONS, "-m", "not served and not slow", str(file)], plugins=[reach])
    measure.stop()
    data = measure.get_data()
    lines = {
        Path(path).relative_to(ROOT).as_posix(): {
            line: [test for test in tests if test in reach.seconds]
            for line, tests in data.contexts_by_lineno(path).items()
        }
        for path in data.measured_files()
    }
    return reach.seconds, lines


def chosen(seconds, lines):
    """{path: {function: its tests}}: for each line the quickest, in the order of their times."""
    found = {}
    for path, of_file in sorted(lines.items()):
        for function, _ in functions_in(core(), path):
            inside = [tests for line, tests in of_file.items() if function.lineno < line <= function.end_lineno]
            quick = {test for tests in inside for test in sorted(tests, key=seconds.get)[:EACH]}
            found.setdefault(path, {}).setdefault(function.name, set()).update(quick)
    return {path: {name: sorted(tests, key=seconds.get) for name, tests in of_file.items() if tests}
            for path, of_file in found.items()}  # fmt: skip


def prepare():
    """Before children are made: kernels are Python, since stored ones would call the code as it was; and what is slow
    to import is imported."""
    os.environ["NUMBA_DISABLE_JIT"] = "1"
    sys.path[:0] = [str(ROOT / "tests"), str(ROOT)]
    for name in ("hypothesis", "mpmath", "mujoco", "numba", "playwright.sync_api", "pytest", "scipy.fft", "scipy.stats",
                 "scipy.integrate", "scipy.optimize", "sympy.physics.mechanics"):  # fmt: skip
        __import__(name)


def main():
    prepare()
    seconds, lines = {}, {}
    for file, found in in_turn(measured, sorted((ROOT / "tests").glob("test_*.py"))):
        print(file.name, "did not end" if found is None else f"{len(found[0])} tests", flush=True)
        took, reached = found or ({}, {})
        seconds |= took
        for path, of_file in reached.items():
            for line, tests in of_file.items():
                lines.setdefault(path, {}).setdefault(line, []).extend(tests)
    reached = chosen(seconds, lines)
    tests = sorted({test for of_file in reached.values() for each in of_file.values() for test in each})
    number = {test: i for i, test in enumerate(tests)}
    kept = {
        "tests": [[test.removeprefix("tests/"), seconds[test]] for test in tests],
        "reached": {path: {name: [number[test] for test in each] for name, each in of_file.items()}
                    for path, of_file in reached.items()},
    }  # fmt: skip
    KEPT.write_text(json.dumps(kept, ensure_ascii=False, separators=(",", ":")) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
