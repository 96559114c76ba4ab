"""Would a wrong formula be noticed? python tests/mutants.py (many hours; --files, --share, --minutes for less).

In each statement that computes something one sign and one factor are changed, one at a time, in a process of its own,
and the tests are run until one fails. data/mutants.jsonl keeps what each change came to, docs/mutants.md tells it
(mutants_page.py). What is known is not tried again, unless the function that was changed or the test that noticed it is
another now. `python tests/ages.py` writes the page anew and tries nothing.
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
import signal
import subprocess
import sys
import time
from collections import Counter
from pathlib import Path

from fingerprint import core
from mutants_page import EXPLAINED, LOG, PAGE, ROOT, functions_in, logged, page
from mutation import sites


def files(names):
    """Of tests."""
    return [f"test_{name}.py" for name in names.split()]


PAPER = ["equations", "poles", "constants", "curve", "forces", "wells", "limits"]
ROLLING = ["differences", "nutation", "phase", "series", "crowding", "rolling"]
SLIDING = ["friction", "dynamics", "stepper", "run", "events", "contacts", "impact", "standing",
           "preparing", "poses", "periodic", "sliding", "many", "summary"]  # fmt: skip
CORE = [*PAPER, *ROLLING, "smooth", *SLIDING]
APP = [
    "explorer",
    "scene",
    "marks",
    "hands",
    "region",
    "frames",
    "bodies",
    "family",
]
FILES = [*CORE, *APP]
QUICK = ["test_equations.py::test_functions_of_theta_at_random_states", "test_equations.py", "test_curve.py",
         "test_forces.py", "test_symbolic.py", "test_paper.py", "test_top.py"]  # fmt: skip
ROLLS = files("smooth accuracy rolling rolling_long sliding stick_slip claims tielines properties")
SLIDES = files("stem ending tables outcome properties")
REST = dict.fromkeys(SLIDING, SLIDES)
FIRST = {
    **{name: ["test_symbolic.py", "test_equations.py", "test_rolling.py", "test_rolling_long.py"] for name in ROLLING},
    **{name: ["test_contacts.py", "test_impacts.py", "test_sliding.py", "test_stick_slip.py"] for name in SLIDING},
    "limits": ["test_tielines.py"],
    "smooth": ["test_equations.py", "test_smooth.py"],
    "friction": ["test_friction.py", "test_mujoco.py", "test_sliding.py", "test_stick_slip.py"],
    "dynamics": ["test_mujoco.py", "test_symbolic.py", "test_sliding.py", "test_contacts.py", "test_impacts.py"],
    "standing": ["test_contacts.py", "test_impacts.py"],
    **{name: ["test_many.py", "test_contacts.py", "test_impacts.py"] for name in ("periodic", "many", "summary")},
}
OF_APP = {
    **{
        name: files("scene explorer scheduling url_state derivation export")
        for name in ("explorer", "scene", "marks", "region", "frames", "bodies")
    },
    "hands": ["test_hands.py"],
    "family": ["test_family_map.py", "test_builder.py", "test_scene.py"],
}
REST_OF_APP = files("explorer scene tables lesson export builder family_map")


def tests_of(name, slow, best):
    """Those to be tried for a file; slow: those that are left when the first found nothing. best: what goes first."""
    first = OF_APP[name] if name in APP else [*FIRST.get(name, []), *QUICK]
    rest = REST_OF_APP if name in APP else REST.get(name, ROLLS)
    return [test for test in rest if test not in first] if slow else [*dict.fromkeys([*best, *first])]


def best_of(known, name):
    """The tests that have noticed most in this file."""
    noticed = Counter(line["by"] for line in known.values() if line["file"] == name and "::" in line["by"])
    return [test for test, _ in noticed.most_common(8)]


def path_of(name):
    """A file keeps its results when it moves to another folder."""
    (path,) = (ROOT / ("app" if name in APP else "tippe_core")).rglob(f"{name}.py")
    return path


def source_of(name):
    return path_of(name).read_text(encoding="utf-8")


def code_at(name, number):
    """The hash of the function that has a line of a file."""
    path = path_of(name).relative_to(ROOT).as_posix()
    return next(
        mark for function, mark in functions_in(core(), path) if function.lineno <= number <= function.end_lineno
    )


def groups_of(tree):
    """The signs, and the factors, of each statement: one of each group is changed."""
    groups = {}
    for site in sites(tree):
        groups.setdefault((id(site[0]), site[1]), []).append(site)
    return [*groups.values()]


def mutants(name):
    """(line, before, after, source) for one sign and one factor of each statement, chosen by the statement's hash."""
    tree = ast.parse(source_of(name))
    for group in groups_of(tree):
        before = ast.unparse(group[0][0])
        pick = int(hashlib.sha256(before.encode()).hexdigest(), 16) % len(group)
        statement, _, node, field, value = group[pick]
        kept = getattr(node, field)
        setattr(node, field, value)
        after, source = ast.unparse(statement), ast.unparse(tree)
        setattr(node, field, kept)
        pairs = zip(before.splitlines(), after.splitlines(), strict=True)
        for old, new in ((old.strip(), new.strip()) for old, new in pairs if old != new):
            yield statement.lineno, old, new, source


class Changed(importlib.abc.MetaPathFinder, importlib.abc.Loader):
    """Imports one module from a changed source."""

    def __init__(self, name, source):
        self.name, self.source = name, source

    def find_spec(self, name, path, target=None):
        return importlib.util.spec_from_loader(name, self) if name == self.name else None

    def create_module(self, spec):
        return None

    def exec_module(self, module):
        exec(compile(self.source, self.name, "exec"), module.__dict__)


class Witness:
    """A pytest plugin that tells the first test that fails, through a pipe; one that does not end ends the process."""

    def __init__(self, pipe, seconds):
        self._pipe, self._seconds = pipe, seconds

    def pytest_runtest_logstart(self):
        signal.setitimer(signal.ITIMER_VIRTUAL, self._seconds)

    def pytest_runtest_logreport(self, report):
        if report.failed:
            self._tell(report.nodeid)

    def pytest_collectreport(self, report):
        if report.failed:
            self._tell(report.nodeid)

    def _tell(self, nodeid):
        os.write(self._pipe, f"{nodeid.split('/')[-1].split('[')[0]}\n".encode())


def noticed_by(name, source, folder, tests, seconds):
    """The test that fails with the changed source, "" if none does; in a child of this process, which has the libraries
    imported. A motion that never ends, or a module that cannot be imported, is noticed too."""
    read, write = os.pipe()
    child = os.fork()
    if child == 0:
        code = 1
        try:
            sink = os.open(os.devnull, os.O_WRONLY)
            os.dup2(sink, 1)
            os.dup2(sink, 2)
            module = ".".join(path_of(name).relative_to(ROOT).with_suffix("").parts)
            sys.meta_path.insert(0, Changed(module, source))
            import pytest

            options = ["-x", "-q", "-p", "no:cacheprovider", "-p", "no:xdist"]
            paths = [str(folder / test) for test in tests if (folder / test.split("::")[0]).exists()]
            code = int(pytest.main([*options, *paths], plugins=[Witness(write, seconds)]))
        finally:
            os._exit(code)
    os.close(write)
    with os.fdopen(read) as pipe:
        told = pipe.readline().strip()
    _, status = os.waitpid(child, 0)
    return told or ("no end" if os.WIFSIGNALED(status) else "an error") if status else ""


def text():
    """The page, of what is kept."""
    chosen = sum(len(groups_of(ast.parse(source_of(name)))) for name in FILES)
    return "\n".join(page(logged(), chosen)) + "\n"


@functools.cache
def functions_of(folder, file):
    """{name: its source} of a file of tests."""
    text = (folder / file).read_text(encoding="utf-8") if (folder / file).exists() else ""
    return {
        node.name: ast.get_source_segment(text, node)
        for node in ast.walk(ast.parse(text))
        if isinstance(node, ast.FunctionDef)
    }


def digest_of(folder, nodeid):
    """Of the text of a test; "" where it is none."""
    file, _, function = nodeid.partition("::")
    text = functions_of(folder, file).get(function, "") if function else ""
    return hashlib.sha256(text.encode()).hexdigest()[:12] if text else ""


def still_so(line, folder):
    """Whether what was found can be taken as it is: the test that noticed it is the same."""
    return line["by"] in ("", "no end", "an error") or line["test"] == digest_of(folder, line["by"])


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("--files", nargs="*", default=FILES)
    options.add_argument("--share", type=int, default=1, help="every so many mutants only")
    options.add_argument("--seconds", type=int, default=600, help="of processor time for a test, kernels as Python")
    options.add_argument("--minutes", type=float, default=float("inf"), help="then write the page with what is known")
    options.add_argument("--tests", type=Path, default=ROOT / "tests", help="the folder of another suite, to compare")
    options.add_argument("--check", action="store_true", help="first run the tests without any change")
    options.add_argument("--log", type=Path, default=LOG, help="where what is known is kept")
    options.add_argument("--again", action="store_true", help="try anew what no test noticed")
    chosen = options.parse_args()
    folder, log = chosen.tests.resolve(), chosen.log
    sys.path[:0] = [str(folder), str(ROOT)]
    os.environ["NUMBA_DISABLE_JIT"] = "1"  # otherwise stored kernels that call the changed code would be used
    import hypothesis  # noqa: F401
    import mpmath  # noqa: F401
    import mujoco  # noqa: F401
    import numba  # noqa: F401
    import playwright.sync_api  # noqa: F401
    import pytest  # noqa: F401
    import scipy.fft
    import scipy.integrate
    import scipy.optimize
    import scipy.stats  # noqa: F401
    import sympy.physics.mechanics  # noqa: F401

    start = time.monotonic()
    commit = subprocess.run(["git", "rev-parse", "--short", "HEAD"], cwd=ROOT, capture_output=True, text=True).stdout
    known = {}  # (hash of the function, before, after) -> a line of the log
    for line in logged(log):
        again = chosen.again and line["by"] == "" and (line["file"], line["after"]) not in EXPLAINED
        if still_so(line, folder) and not again:
            known[line.get("code"), line["before"], line["after"]] = line
    if chosen.check and (by := noticed_by("equations", source_of("equations"), folder,
                                          [*QUICK, *ROLLS, *SLIDES, *REST_OF_APP], chosen.seconds)):  # fmt: skip
        sys.exit(f"the tests fail without any change: {by}")
    chosen_ones = [(name, *mutant) for name in chosen.files for mutant in list(mutants(name))[:: chosen.share]]
    # in the order of their hashes, so that the results at the time limit are a random sample
    chosen_ones.sort(key=lambda one: hashlib.sha256(repr(one[:4]).encode()).hexdigest())
    for slow in (False, True):  # the quick tests notice most
        for name, line, before, after, source in chosen_ones:
            code = code_at(name, line)
            key = code, before, after
            if time.monotonic() - start > 60 * chosen.minutes:
                break
            if key in known and not (slow and known[key]["rest"] and (name, after) not in EXPLAINED):
                continue
            by = noticed_by(name, source, folder, tests_of(name, slow, best_of(known, name)), chosen.seconds)
            known[key] = {"file": name, "before": before, "after": after, "by": by, "test": digest_of(folder, by),
                          "rest": not by and not slow, "code": code, "commit": commit.strip(),
                          "date": str(datetime.date.today())}  # fmt: skip
            with log.open("a", encoding="utf-8") as file:
                file.write(json.dumps(known[key], ensure_ascii=False) + "\n")
            print(f"{name}:{line} {by or 'SURVIVES'} {after}", flush=True)
    if folder == ROOT / "tests":
        PAGE.write_text(text(), encoding="utf-8")


if __name__ == "__main__":
    main()
