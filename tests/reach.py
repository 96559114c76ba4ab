"""Which tests run through which function of the core and the model: python tests/reach.py writes data/reach.json, from
which mutants.py takes the tests that it runs. For the core its kernels run as Python, and its own tests are tried; for
the model kernels are compiled. A test that takes more than 8 s of the processor so is left out."""

import concurrent.futures
import functools
import json
import multiprocessing
import os
import re
import signal
import subprocess
import sys
import time
from collections import Counter
from concurrent.futures import Executor, Future
from contextlib import contextmanager
from itertools import islice
from multiprocessing.connection import wait
from pathlib import Path

import pytest
from fingerprint import core
from mutants_page import functions_in

ROOT = Path(__file__).parent.parent
KEPT = ROOT / "tests" / "data" / "reach.json"
OPTIONS = ["-q", "-p", "no:cacheprovider", "-p", "no:xdist", "-p", "no:randomly", "--rootdir", str(ROOT)]
PARTS = ("tippe_core", "app/model")
SECONDS = 8
EACH = 2
"""So many tests of one function are kept of those that reach a line: those with the quickest parameters."""


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
                raise RuntimeError(f"failed for {argument}")
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

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_setup(self):
        with limited():
            yield

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_call(self):
        with limited():
            yield

    def pytest_runtest_logreport(self, report):
        if report.when == "call" and report.passed:
            self.seconds[report.nodeid] = round(time.process_time() - self._start, 2)

    def pytest_runtest_logfinish(self):
        self._coverage.switch_context("")


@contextmanager
def limited():
    """Context that ends by a TimeoutError after SECONDS; after each s more, where the error is lost in a callback."""
    signal.setitimer(signal.ITIMER_VIRTUAL, SECONDS, 1)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)


class Inline(Executor):
    """In place of threads: a signal cannot end what another thread computes."""

    def __init__(self, *_):
        pass

    def submit(self, call, /, *given, **options):
        future = Future()
        try:
            future.set_result(call(*given, **options))
        except Exception as error:
            future.set_exception(error)
        return future


def stop(*_):
    raise TimeoutError(f"longer than {SECONDS} s")


def measured(part, file):
    """{test: seconds}, {path: {line: [test]}} of a file of tests."""
    import coverage

    signal.signal(signal.SIGVTALRM, stop)
    concurrent.futures.ThreadPoolExecutor = Inline
    measure = coverage.Coverage(data_file=None, include=[f"{ROOT}/{part}/*"], config_file=False)
    reach = Reach(measure)
    measure.start()
    marks = "not served" if part == "app/model" else "not served and not slow"
    pytest.main([*OPTIONS, "-m", marks, str(file)], plugins=[reach])
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


def tried(part, file):
    """The same, or None if the limit struck in the middle of a library, from which the file did not recover."""
    try:
        return measured(part, file)
    except Exception:
        return None


def chosen(seconds, lines):
    """{path: {function: its tests}}, in the order of their times."""
    found = {}
    for path, of_file in sorted(lines.items()):
        for function, _ in functions_in(core(), path):
            inside = [tests for line, tests in of_file.items() if function.lineno < line <= function.end_lineno]
            quick = {test for tests in inside for test in quickest(tests, seconds)}
            found.setdefault(path, {}).setdefault(function.name, set()).update(quick)
    return {path: {name: sorted(tests, key=seconds.get) for name, tests in of_file.items() if tests}
            for path, of_file in found.items()}  # fmt: skip


def quickest(tests, seconds):
    """EACH of each function of tests."""
    count = Counter()
    for test in sorted(tests, key=seconds.get):
        name, _, _ = test.partition("[")
        count[name] += 1
        if count[name] <= EACH:
            yield test


def prepare(part):
    """Before children are made: what is slow to import is imported; kernels of the core are Python, since stored ones
    would call the code as it was."""
    if part == "tippe_core":
        os.environ["NUMBA_DISABLE_JIT"] = "1"
    sys.path[:0] = [str(ROOT / "tests"), str(ROOT)]
    for name in ("hypothesis", "mpmath", "mujoco", "numba", "playwright.sync_api", "pytest", "scipy.fft", "scipy.stats",
                 "scipy.integrate", "scipy.optimize", "sympy.physics.mechanics"):  # fmt: skip
        __import__(name)


def tests_of(part):
    """The files of tests that may run through it: those of the app, or the others."""
    for file in sorted((ROOT / "tests").glob("test_*.py")):
        if not file.stem.endswith("browser") and bool(
            re.search(r"^ *(from|import) app\b", file.read_text(encoding="utf-8"), re.M)
        ) == (part == "app/model"):
            yield file


def find(part):
    """Measures one part, and puts it into the file."""
    prepare(part)
    seconds, lines = {}, {}
    for file, found in in_turn(functools.partial(tried, part), tests_of(part)):
        print(file.name, "did not end" if found is None else f"{len(found[0])} tests", flush=True)
        took, reached = found or ({}, {})
        seconds |= took
        for path, of_file in reached.items():
            for line, tests in of_file.items():
                lines.setdefault(path, {}).setdefault(line, []).extend(tests)
    reached = chosen(seconds, lines)
    tests = sorted({test for of_file in reached.values() for each in of_file.values() for test in each})
    number = {test: i for i, test in enumerate(tests)}
    kept = json.loads(KEPT.read_text(encoding="utf-8")) if KEPT.exists() else {}
    kept[part] = {
        "tests": [[test.removeprefix("tests/"), seconds[test]] for test in tests],
        "reached": {path: {name: [number[test] for test in each] for name, each in of_file.items()}
                    for path, of_file in reached.items()},
    }  # fmt: skip
    KEPT.write_text(json.dumps(kept, ensure_ascii=False, separators=(",", ":")) + "\n", encoding="utf-8")


if __name__ == "__main__":
    if sys.argv[1:]:
        find(sys.argv[1])
    else:
        for each in PARTS:
            subprocess.run([sys.executable, __file__, each], check=True)
