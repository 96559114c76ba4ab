"""Which tests run through which statement of the core and the model: python tests/reach.py writes data/reach.json, from
which mutants.py takes the tests that it runs. For the core its kernels run as Python, and its own tests are tried; for
the model kernels are compiled. A test that takes more than 8 s of the processor so is left out."""

import argparse
import ast
import concurrent.futures
import functools
import json
import multiprocessing
import os
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


def in_turn(call, arguments, processes=None):
    """(argument, call(argument), or None where a signal ended it), each in a child of this process, one a core or so
    many at once: a child has the libraries that are imported here, and what it changes goes with it."""
    fork, waiting, running = multiprocessing.get_context("fork"), iter(arguments), {}
    while True:
        for argument in islice(waiting, (processes or os.cpu_count()) - len(running)):
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
    """Context that ends by a TimeoutError after SECONDS; after each s more, where the error is lost in a callback. What
    waits for another thread, which there is not, ends by the clock."""
    signal.setitimer(signal.ITIMER_VIRTUAL, SECONDS, 1)
    signal.setitimer(signal.ITIMER_REAL, 3 * SECONDS, 1)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)
        signal.setitimer(signal.ITIMER_REAL, 0)


class Inline(Executor):
    """In place of threads: a signal cannot end what another thread computes."""

    def __init__(self, *_, **__):
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
    signal.signal(signal.SIGALRM, stop)
    concurrent.futures.ThreadPoolExecutor = Inline
    measure = coverage.Coverage(data_file=None, include=[f"{ROOT}/{part}/*"], config_file=False)
    reach = Reach(measure)
    measure.start()
    marks = "not served" if part == "app/model" else "not served and not slow"
    status = pytest.main([*OPTIONS, "-m", marks, str(file)], plugins=[reach])
    measure.stop()
    if status not in (0, 1, 5):  # as where a file cannot be read with what is put in place of threads
        raise RuntimeError(f"{file.name}: pytest ended with {status}")
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


def statements(function):
    """[(its first line, its last without those of statements in it)] of a function, in their order."""
    inside = (each for each in ast.walk(function) if isinstance(each, ast.stmt) and each is not function)
    for each in sorted(inside, key=lambda each: (each.lineno, each.col_offset)):
        body = getattr(each, "body", None)
        yield each.lineno, max(each.lineno, body[0].lineno - 1) if body else each.end_lineno


def chosen(seconds, lines):
    """{path: {function: {its hash: [the tests of each of its statements]}}}, the tests in the order of their times."""
    found = {}
    for path, of_file in sorted(lines.items()):
        for function, mark in functions_in(core(), path):
            reached = [{test for line in range(first, last + 1) for test in of_file.get(line, ())}
                       for first, last in statements(function)]  # fmt: skip
            if any(reached):
                found.setdefault(path, {}).setdefault(function.name, {})[mark] = [
                    tuple(quickest(tests, seconds)) for tests in reached
                ]
    return found


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
        if not file.stem.endswith("browser") and imports_app(file) == (part == "app/model"):
            yield file


def imports_app(file):
    return any(
        name.split(".")[0] == "app"
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8")))
        for name in ([node.module or ""] if isinstance(node, ast.ImportFrom)
                     else [each.name for each in node.names] if isinstance(node, ast.Import) else [])
    )  # fmt: skip


def find(part, processes, only):
    """Measures one part, and puts it into the file. only: files of tests; of the others is what was found before."""
    prepare(part)
    kept = json.loads(KEPT.read_text(encoding="utf-8")) if KEPT.exists() else {}
    files = [file for file in tests_of(part) if not only or file.name in only]
    seconds, lines = {}, {}
    for file, found in in_turn(functools.partial(tried, part), files, processes):
        print(file.name, "DID NOT END" if found is None else f"{len(found[0])} tests", flush=True)
        took, reached = found or ({}, {})
        seconds |= {test.removeprefix("tests/"): each for test, each in took.items()}
        for path, of_file in reached.items():
            for line, tests in of_file.items():
                lines.setdefault(path, {}).setdefault(line, []).extend(test.removeprefix("tests/") for test in tests)
    if only:
        add(lines, seconds, kept[part], {file.name for file in files})
    kept = json.loads(KEPT.read_text(encoding="utf-8")) if KEPT.exists() else {}  # the other part may be new meanwhile
    kept[part] = packed(seconds, chosen(seconds, lines))
    KEPT.write_text(json.dumps(kept, ensure_ascii=False, separators=(",", ":")) + "\n", encoding="utf-8")


def add(lines, seconds, kept, files):
    """Adds what is kept of tests in other files than these, as far as a function is as it was."""
    numbered, by_mark = kept["tests"], marks(kept)
    for path in core().paths.values():
        for function, mark in functions_in(core(), path):
            for (line, _), number in zip(statements(function), by_mark.get(mark, ()), strict=False):
                for test, took in (numbered[each] for each in kept["sets"][number]):
                    if test.partition("::")[0] not in files:
                        seconds[test] = took
                        lines.setdefault(path, {}).setdefault(line, []).append(test)


def marks(kept):
    """{hash of a function: the number of the set of tests of each of its statements}"""
    return {mark: numbers for of_file in kept["reached"].values() for of_name in of_file.values()
            for mark, numbers in of_name.items()}  # fmt: skip


def packed(seconds, reached):
    """As it is kept: each set of tests once, since most statements of a function have the same."""
    sets = sorted({tests for of_file in reached.values() for of_name in of_file.values()
                   for each in of_name.values() for tests in each})  # fmt: skip
    names = sorted({test for each in sets for test in each})
    number, place = {test: i for i, test in enumerate(names)}, {tests: i for i, tests in enumerate(sets)}
    return {
        "tests": [[test, seconds[test]] for test in names],
        "sets": [[number[test] for test in tests] for tests in sets],
        "reached": {path: {name: {mark: [place[tests] for tests in each] for mark, each in of_name.items()}
                           for name, of_name in of_file.items()} for path, of_file in reached.items()},
    }  # fmt: skip


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("--part", choices=PARTS, help="this one alone")
    options.add_argument("--processes", type=int, default=os.cpu_count(), help="so many at once; else one a core")
    options.add_argument("--only", nargs="+", default=[], metavar="FILE", help="measure these files of tests alone")
    chosen = options.parse_args()
    if chosen.part:
        find(chosen.part, chosen.processes, chosen.only)
    else:
        for each in PARTS:
            subprocess.run([sys.executable, __file__, *sys.argv[1:], "--part", each], check=True)


if __name__ == "__main__":
    main()
