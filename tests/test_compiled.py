"""Kernels: compiled once and stored, never stale, whether files can be written or not, and with the same results as
Python."""

import ast
import json
import os
import pkgutil
import shutil
import signal
import subprocess
import sys
import threading
import time
from contextlib import contextmanager, suppress
from decimal import Decimal
from importlib import import_module
from math import inf
from pathlib import Path

import numpy as np
import pytest
from serving import served, serving, until
from wire import Visitor, run

import tippe_core
from tippe_core import kept
from tippe_core.ahead import CALLS, compile_all
from tippe_core.compiled import Kernel, ahead, compiled, not_kept, why_not

ROOT = Path(__file__).parent.parent
CALLEE = """from .compiled import compiled

def product(x, y):
    return x * y

@compiled
def square(x):
    return product(x, x)
"""
CALLER = """from .compiled import compiled
from .callee import square

@compiled
def total(x, n):
    s = 0 * x
    for _ in range(n):
        s += square(x)
    return s
"""
# Prints the results, how many kernels were compiled and how many found, and why they are not stored; then which the
# process says that it had to compile.
RUN = """import json, os
import numpy as np
from tippe_core import kept
from tippe_core.caller import total
from tippe_core.compiled import not_kept, why_not
print(json.dumps([float(total({}, 3)), *(sum(getattr(total.dispatcher.stats, name).values()) for name in
      ("cache_misses", "cache_hits")), not_kept(), why_not(), os.fspath(kept.folder() or "")]))
print(json.dumps([name.partition("(")[0] for name in kept.made]))
"""
# The same of all these arguments.
ALL_FOUND = """import json
import numpy as np
from tippe_core.caller import total
values = [float(total(x, 3)) for x in (%s)]
print(json.dumps([values, *(sum(getattr(total.dispatcher.stats, name).values()) for name in
      ("cache_misses", "cache_hits"))]))
"""


class Package:
    """A tippe_core with two kernels, one of which calls the other in another file."""

    def __init__(self, folder):
        self.folder = folder / "tippe_core"
        self.folder.mkdir()
        for name in ("compiled.py", "kept.py"):
            shutil.copy(ROOT / "tippe_core" / name, self.folder)
        (self.folder / "__init__.py").touch()
        (self.folder / "callee.py").write_text(CALLEE)
        (self.folder / "caller.py").write_text(CALLER)

    def begin(self, x="2.0", code=RUN, before=(), **environment):
        kept_out = ("NUMBA", "XDG_CACHE", "PYTHONPATH")
        inherited = {name: value for name, value in os.environ.items() if not name.startswith(kept_out)}
        inherited |= {"HOME": str(self.folder.parent / "home"), "PYTHONPATH": str(self.folder.parent)}
        return subprocess.Popen([*before, sys.executable, "-B", "-c", code.format(x)], env=inherited | environment,
                                cwd="/", stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)  # fmt: skip

    def run(self, *arguments, **named):
        said, errors = (process := self.begin(*arguments, **named)).communicate()
        assert process.returncode == 0, errors
        found, *self.made = map(json.loads, said.splitlines())
        return found

    def found(self):
        return sorted(path.name for path in (self.folder / "__pycache__").glob("kernels-*"))


@pytest.fixture
def package(tmp_path):
    return Package(tmp_path)


@pytest.fixture(scope="module")
def compiled_once(tmp_path_factory):
    """A Package after its first run, and what that printed."""
    package = Package(tmp_path_factory.mktemp("package"))
    return package, package.run()


@pytest.fixture
def stored(package, compiled_once):
    """A Package whose kernels are stored, as after its first run."""
    before, (*_, there) = compiled_once
    shutil.copytree(before.folder / "__pycache__", package.folder / "__pycache__")
    package.stored = package.folder / Path(there).relative_to(before.folder)
    return package


@pytest.fixture
def read_only(package, tmp_path):
    """make(*writable) makes all folders read-only except these; returns the start of a command for which this holds
    even as root."""
    if os.name != "posix":
        pytest.skip("knows how to take rights away on POSIX alone")
    root = os.getuid() == 0
    if root and not shutil.which("setpriv"):
        pytest.skip("root writes everywhere, and there is no setpriv")

    def make(*writable):
        for folder in (tmp_path, package.folder, *package.folder.rglob("*/")):
            folder.chmod(0o755 if folder in writable else 0o555)
        return ("setpriv", "--bounding-set=-dac_override") if root else ()

    yield make
    for folder in (tmp_path, *tmp_path.rglob("*/")):
        folder.chmod(0o755)


def test_a_kernel_is_compiled_once_and_then_found(compiled_once, stored):
    """Its folder is dated by that, and nothing is removed."""
    before, (value, compiled_now, found, *reasons, there) = compiled_once
    assert (value, compiled_now, found, reasons) == (12.0, 1, 0, ["", ""])
    assert before.made == [["tippe_core.callee.square", "tippe_core.caller.total"]]
    assert Path(there).parent == before.folder / "__pycache__"
    found = stored.stored
    old = aged(found.parent / f"kernels-cpython-311-generic-{16 * 'a'}", 400)
    kept.mark(found)
    os.utime(found, (0, 0))
    assert stored.run() == [12.0, 0, 1, "", "", str(found)] and stored.made == [[]]
    assert found.stat().st_mtime > time.time() - 3600 and old.is_dir()


def test_a_callee_in_another_file_that_changed_is_noticed(stored):
    (stored.folder / "callee.py").write_text(CALLEE.replace("x * y", "x - y"))
    value, compiled_now, *_, after = stored.run()
    assert (value, compiled_now) == (0.0, 1)
    assert stored.found() == sorted({stored.stored.name, Path(after).name}) and len(stored.found()) == 2


def test_versions_that_share_a_folder_keep_each_others_kernels(tmp_path):
    """Started in turn, as around a roll-back, or beside each other."""
    versions = []
    for name in ("one", "two"):
        (tmp_path / name).mkdir()
        versions.append(Package(tmp_path / name))
    (versions[1].folder / "callee.py").write_text(CALLEE + "# changed\n")
    shared = str(tmp_path / "shared")
    started = [each.run(NUMBA_CACHE_DIR=shared) for each in (*versions, versions[0])]
    assert [(compiled_now, found) for _, compiled_now, found, *_ in started] == [(1, 0), (1, 0), (0, 1)]
    one, two, again = (folder for *_, folder in started)
    assert one == again != two


def aged(path, days):
    """A folder that was last used so many days ago."""
    path.mkdir(parents=True)
    (path / "a.nbc").touch()
    os.utime(path, (then := time.time() - 86400 * days, then))
    return path


def test_what_nothing_has_used_for_long_goes_once_another_folder_is_complete(tmp_path, monkeypatch):
    recent, own = (aged(tmp_path / f"kernels-cpython-311-generic-{16 * mark}", days)
                   for mark, days in (("a", 29), ("b", 31)))  # fmt: skip
    aged(tmp_path / f"kernels-cpython-310-generic-{16 * 'c'}", 31)
    others = aged(tmp_path / "kernels-of-something-else", 400)
    monkeypatch.setattr("tippe_core.ahead.CALLS", ())
    monkeypatch.setattr("tippe_core.ahead.not_kept", lambda: "")
    monkeypatch.setattr(kept, "folder", lambda: own)
    compile_all()
    assert kept.complete(own) and sorted(tmp_path.iterdir()) == sorted([recent, own, others])


def test_another_processor_has_kernels_of_its_own(stored):
    assert stored.run(NUMBA_CPU_NAME="generic")[-1] != str(stored.stored) and len(stored.found()) == 2


def test_where_nothing_can_be_written_what_is_kept_is_found(stored, read_only):
    kept.mark(stored.stored)
    before = read_only()
    assert stored.run(before=before) == [12.0, 0, 1, "", "", str(stored.stored)]
    # others are compiled, but not stored
    value, compiled_now, found, reason, *_ = stored.run("2", before=before)
    assert (value, compiled_now, found) == (12.0, 1, 0) and "ermission" in reason


def test_where_nothing_can_be_written_and_nothing_is_kept_kernels_are_compiled(package, read_only):
    value, compiled_now, found, reason, why, folder = package.run(before=read_only())
    assert (value, compiled_now, found, why, folder) == (12.0, 1, 0, "", "")
    assert str(package.folder) in reason


def test_beside_sources_that_cannot_be_written_kernels_are_in_the_users_cache(package, read_only, tmp_path):
    home = tmp_path / "home"
    home.mkdir()
    before = read_only(home)
    *_, folder = package.run(before=before)
    assert Path(folder).is_relative_to(home)
    assert package.run(before=before) == [12.0, 0, 1, "", "", folder]


@pytest.mark.slow
def test_several_processes_at_once_lose_nothing_and_mix_nothing_up(package):
    """Each of them compiles for another type of argument, into the same list."""
    given = ("2.0", "2", "np.float32(1.5)")
    begun = [package.begin(x) for x in given]
    values = [json.loads(each.communicate()[0].splitlines()[0])[0] for each in begun]
    assert values == [12.0, 12.0, 6.75]
    assert package.run(code=ALL_FOUND % ", ".join(given)) == [values, 0, len(given)]


def test_files_cut_short_are_compiled_anew(stored):
    for path in stored.stored.glob("*.nb?"):
        path.write_bytes(path.read_bytes()[:100])
    assert stored.run()[:3] == [12.0, 1, 0]
    assert stored.run()[:3] == [12.0, 0, 1]


def test_a_folder_is_complete_while_all_its_files_are_there(stored):
    folder = stored.stored
    assert not kept.complete(folder)
    kept.mark(folder)
    assert kept.complete(folder)
    next(folder.glob("*.nbc")).unlink()
    assert not kept.complete(folder)


def test_without_numba_or_told_not_to_compile_kernels_run_as_python(package):
    print_all = ("import sys; {}; from tippe_core.caller import total; from tippe_core.compiled import why_not; "
                 "import json; print(json.dumps([total(2.0, 3), why_not()]))")  # fmt: skip
    value, why = package.run("sys.modules['numba'] = None", print_all)
    assert value == 12.0 and "numba" in why
    value, why = package.run("", print_all.replace("{}; ", ""), NUMBA_DISABLE_JIT="1")
    assert value == 12.0 and "NUMBA_DISABLE_JIT" in why
    assert package.found() == []


def test_the_command_does_nothing_without_numba():
    code = "import sys; sys.modules['numba'] = None; import runpy; runpy.run_module('tippe_core', run_name='__main__')"
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0 and "in Python" in done.stdout and "numba" in done.stdout


def test_what_imports_the_core_does_not_import_numba():
    code = "import tippe_core, sys; sys.exit('numba' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], cwd=ROOT).returncode == 0


def inverse(x):
    return 1 / x


def test_what_a_kernel_calls_is_python_elsewhere_and_divides_as_it_does():
    @compiled
    def least(x):
        return -inverse(x)

    assert least(Decimal(4)) if why_not() else least(0.0) == -inf
    assert inverse(Decimal(4)) == Decimal("0.25") and inverse(np.array([2.0, 4.0])).tolist() == [0.5, 0.25]


def test_while_one_thread_compiles_the_others_run_python():
    @compiled
    def double(x):
        return 2 * x

    said = []
    with ahead():
        other = threading.Thread(target=lambda: said.append(double(2.0)))
        other.start()
        other.join()
        assert said == [4.0] and "dispatcher" not in vars(double)
        assert double(3.0) == 6.0 and "dispatcher" in vars(double)


def kernels():
    """All kernels of tippe_core, by name."""
    found = {}
    for module in pkgutil.walk_packages(tippe_core.__path__, "tippe_core."):
        if module.name != "tippe_core.__main__":
            for name, value in vars(import_module(module.name)).items():
                if isinstance(value, Kernel) and value.__module__ == module.name:
                    found[f"{module.name}.{name}"] = value
    return found


@pytest.mark.skipif(bool(why_not()), reason="nothing is compiled")
def test_every_kernel_is_compiled_ahead():
    said = []
    assert compile_all(said.append) == not_kept() == ""
    for name, kernel in kernels().items():
        code = kernel.py_func.__code__
        files = kept.folder().glob(f"{Path(code.co_filename).stem}.{kernel.__name__}-*-{code.co_firstlineno}.*.nbi")
        assert list(files), f"{name} is not called by tippe_core.ahead"
    assert "".join(said).count("\n") == len(CALLS)


PAGE = """from tippe_core import kept
from tippe_core.ahead import compile_all
assert compile_all() == ""
kept.made.clear()

from app.model.families import family
from app.model.lesson import lesson
from app.model.explorer import Explorer
from app.model.families.known_tops import known_tops
from app.model.lab.lab import Lab
from app.model.setup import LAWS
explorer = Explorer()
for step in lesson.STEPS:
    step.answer(lesson.planned(step, explorer.scene))
explorer.set(given="hand", spin=20.0, tilt=10.0, table="three")
lab = Lab(explorer=explorer)
lab.show()
for law in LAWS:
    lab.ask(law=law)
    explorer.set(given="state")
    lab.ask(spin=20.0)
for top in known_tops():
    top.shown(0.5)
next(family.share_map(0.4, 10.0, 0.5, [0.1, -0.2], [1.0, 1.1]))
print(*kept.made, sep="\\n")
"""


@pytest.mark.slow
@pytest.mark.skipif(bool(why_not()), reason="nothing is compiled")
def test_nothing_that_the_page_computes_is_compiled_when_it_is_asked_for():
    done = subprocess.run([sys.executable, "-c", PAGE], cwd=ROOT, capture_output=True, text=True)
    assert (done.returncode, done.stdout.strip()) == (0, ""), done.stderr


def test_no_kernel_starts_threads_or_loosens_arithmetic():
    """If two Python threads enter numba's threads, the process ends; and fastmath gives different numbers elsewhere."""
    for path in (ROOT / "tippe_core").rglob("*.py"):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        imported = {name.name for node in ast.walk(tree) if isinstance(node, ast.Import) for name in node.names}
        imported |= {node.module for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)}
        if path.name not in ("compiled.py", "kept.py"):
            assert not any(str(name).startswith("numba") for name in imported), path
        named = {word.arg for node in ast.walk(tree) if isinstance(node, ast.Call) for word in node.keywords}
        if path.name == "compiled.py":
            assert named & {"nogil", "parallel", "fastmath"} == {"nogil"}


async def moves(url):
    """The answer to a visitor who moves a slider of a rolling motion."""
    visitor = await Visitor.enter(f"{url}?tab=roll")
    answered, _ = await visitor.answer(await visitor.set(visitor.group("K_J"), "request", [1, "K_J", 6.5, False]))
    visitor.leave()
    return answered


@contextmanager
def begun(command, kernels, log, monkeypatch):
    """Serves the page by this command, with this folder as numba's cache."""
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(kernels))
    if command.startswith("app"):
        code = "from tippe_core import kept; kept.folder.cache_clear()"
        with served(log, code=code, arguments=command.split()[1:]) as server:
            yield server
    else:
        with serving([sys.executable, "-m", *command.split()], log, ROOT) as server:
            yield server


@pytest.mark.served
@pytest.mark.skipif(bool(why_not()), reason="nothing is compiled")
@pytest.mark.parametrize("command", ["app", pytest.param("panel serve app", marks=pytest.mark.long)])
def test_a_server_that_finds_no_kernels_answers_while_they_are_compiled(command, tmp_path, monkeypatch):
    """The file that says that everything is stored is missing: otherwise this would take minutes."""
    log, here = tmp_path / "log", kept.folder()
    there = tmp_path / "kernels" / "tippe-top-explorer" / here.name
    shutil.copytree(here, there, ignore=shutil.ignore_patterns(kept.COMPLETE))
    with begun(command, tmp_path / "kernels", log, monkeypatch) as server:
        assert run(moves(server.url)) == "OK"
        until(lambda: "kernels are compiled" in log.read_text(), 300)
    said = log.read_text()
    assert said.count("no compiled kernels are kept") == said.count("kernels are compiled, after") == 1
    assert "ended early" not in said and "but not kept" not in said
    assert kept.complete(there)


def descendants(pid):
    """{process: its command} of all that a process started, and what these did."""
    found = {}
    for task in Path(f"/proc/{pid}/task").glob("*/children"):
        for child in map(int, task.read_text().split()):
            with suppress(OSError):  # has just ended
                found |= {child: Path(f"/proc/{child}/cmdline").read_text()} | descendants(child)
    return found


def still_runs(pid):
    """Whether a process has not ended."""
    with suppress(OSError):
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] not in "ZX"
    return False


@pytest.mark.served
@pytest.mark.skipif(bool(why_not()), reason="nothing is compiled")
@pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")
@pytest.mark.parametrize(("command", "end"), [
    ("app --workers 2", signal.SIGKILL), *(pytest.param(*each, marks=pytest.mark.long) for each in (
        ("app", signal.SIGTERM), ("app", signal.SIGKILL), ("app --workers 2", signal.SIGINT),
        ("panel serve app", signal.SIGINT), ("panel serve app", signal.SIGKILL)))])  # fmt: skip
def test_what_compiles_for_a_server_ends_with_it(command, end, tmp_path, monkeypatch):
    many = 2 if "2" in command else 1
    with begun(command, tmp_path / "kernels", tmp_path / "log", monkeypatch) as server:

        def compilers():
            return [each for each, line in descendants(server.process.pid).items() if "\0tippe_core\0" in line]

        until(lambda: len(compilers()) == many, 60)
        started = compilers()
        server.process.send_signal(end)
        server.process.wait(60)
        try:
            until(lambda: not any(map(still_runs, started)), 30)
        finally:
            for each in filter(still_runs, started):
                os.kill(each, signal.SIGKILL)
    assert not any(map(kept.complete, (tmp_path / "kernels").iterdir()))  # nor did it end because it was done
