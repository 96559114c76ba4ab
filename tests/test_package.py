"""Installation: dependency bounds, a lock file that fits them, and a source archive that can be worked with."""

import ast
import json
import os
import platform
import re
import shutil
import subprocess
import sys
import tarfile
import tomllib
import zipfile
from functools import partial
from pathlib import Path

import pytest
import yaml
from packaging.requirements import Requirement
from serving import serving
from wire import Visitor, run

ROOT = Path(__file__).parent.parent
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
BOUNDS = {each.name: each for each in map(Requirement, PROJECT["project"]["dependencies"])}
LOCKS = sorted((ROOT / "locks").glob("*.txt"))
PYTHONS = ("3.11.0", "3.12.0", "3.13.0", "3.14.0")


def pins(path, python=None):
    """{name: version} of a lock file, for a Linux with this Python; without a Python, all of them in one list."""
    lines = re.findall(r"(?m)^([A-Za-z0-9][\w.-]*==.*?) *\\?$", path.read_text(encoding="utf-8"))
    requirements = map(Requirement, lines)
    system = {"sys_platform": "linux", "platform_machine": "x86_64", "os_name": "posix"}
    if python:
        system |= {"python_full_version": python, "python_version": python.rpartition(".")[0]}
        requirements = [each for each in requirements if not each.marker or each.marker.evaluate(system)]
    return [(each.name, next(iter(each.specifier)).version) for each in requirements]


@pytest.mark.parametrize("name", BOUNDS)
def test_every_dependency_has_a_lower_and_an_upper_bound(name):
    assert {each.operator for each in BOUNDS[name].specifier} == {">=", "<"}


@pytest.mark.slow
def test_what_is_imported_at_run_time_is_declared():
    """Imports by package name: what pip installs along today it may not install tomorrow."""
    files = [path for part in ("app", "tippe_core") for path in (ROOT / part).rglob("*.py")]
    nodes = [node for path in files if "node_modules" not in path.parts
             for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))]  # fmt: skip
    names = [each.name for node in nodes if isinstance(node, ast.Import) for each in node.names]
    names += [node.module for node in nodes if isinstance(node, ast.ImportFrom) and not node.level]
    others = {name.partition(".")[0] for name in names} - sys.stdlib_module_names - {"app", "tippe_core"}
    assert {name.replace("_", "-") for name in others} == {*BOUNDS, "redis", "prometheus-client"}  # extras


@pytest.mark.parametrize("python", PYTHONS)
@pytest.mark.parametrize("lock", ["run", "test"])
def test_the_lock_is_within_the_bounds_on_every_python(lock, python):
    locked = dict(pins(ROOT / f"locks/{lock}.txt", python))
    for name, bound in BOUNDS.items():
        assert bound.specifier.contains(locked[name]), name


def test_the_lowest_libraries_are_those_that_the_bounds_allow():
    lowest = dict(pins(ROOT / "locks/lowest.txt"))
    for name, bound in BOUNDS.items():
        [least] = [each.version for each in bound.specifier if each.operator == ">="]
        assert Requirement(f"x=={least}").specifier.contains(lowest[name]), name


@pytest.mark.parametrize("path", LOCKS, ids=lambda path: path.stem)
def test_a_lock_names_no_place_and_the_files_that_were_locked(path):
    text = path.read_text(encoding="utf-8")
    assert "://" not in text and "--index" not in text and "--find" not in text
    if path.stem != "lowest":
        # every pin is followed by the hashes of its files
        assert len(re.findall(r"==.*\\\n    --hash=sha256:", text)) == len(pins(path)) > 3


def test_the_image_and_the_tests_are_installed_from_the_lock():
    for name in ("Dockerfile", "Makefile"):
        text = (ROOT / name).read_text(encoding="utf-8")
        assert "--require-hashes -r locks/build.txt" in text and "-r locks/run.txt" in text
        # other installs bring no dependencies, except for the program that makes the locks
        for line in re.findall(r"pip install (.*)", text):
            assert "--require-hashes" in line or "--no-deps" in line or "'uv" in line, line


@pytest.fixture(scope="module")
def archives(tmp_path_factory):
    """The folder with the wheel and the source archive, made from a copy of what git tracks and the bundle; those of
    the core alone are in its folder core."""
    if not (ROOT / ".git").exists() or not shutil.which("git"):
        pytest.skip("copies what git has")
    copy, made = tmp_path_factory.mktemp("copy"), tmp_path_factory.mktemp("made")
    known = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    for path in filter(None, known.split("\0")):
        if (ROOT / path).is_file():
            (copy / path).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / path, copy / path)
    shutil.copytree(ROOT / "app/static", copy / "app/static")
    for source, folder in ((copy, made), (copy / "deploy/core", made / "core")):
        build = [sys.executable, "-m", "hatchling", "build", "-d", folder]
        subprocess.run(build, cwd=source, check=True, capture_output=True)
    return made


@pytest.fixture(scope="module")
def unpacked(archives, tmp_path_factory):
    """The source archive, unpacked."""
    folder = tmp_path_factory.mktemp("sdist")
    with tarfile.open(next(archives.glob("*.tar.gz"))) as archive:
        archive.extractall(folder, filter="data")
    [path] = folder.iterdir()
    return path


@pytest.mark.served
def test_the_archives_are_as_an_index_wants_them(archives):
    pytest.importorskip("twine", reason="twine is not installed: locks/test.txt has it")
    made = [*archives.rglob("*.whl"), *archives.rglob("*.tar.gz")]
    done = subprocess.run([sys.executable, "-m", "twine", "check", "--strict", *made], capture_output=True, text=True)
    assert done.returncode == 0 and done.stdout.count("PASSED") == 4, done.stdout


@pytest.mark.served
@pytest.mark.long
def test_the_wheel_in_an_empty_environment_starts_from_any_directory_and_a_visitor_comes(archives, tmp_path):
    """Without node, a compiler or the sources. Kernels run as Python here; another test compiles them."""
    [wheel] = archives.glob("*.whl")
    locked = "--require-hashes", "-r", ROOT / "locks/run.txt"
    folder = installed(tmp_path / "venv", locked, ["--no-deps", wheel]).parent
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    alone = ["env", "-u", "PYTHONPATH", "NUMBA_DISABLE_JIT=1", f"PATH={folder}", folder / "tippe-top"]
    with serving(alone, tmp_path / "log", elsewhere) as server:
        assert server.process.poll() is None, server.log
        assert run(Visitor.enter(server.url)).component("LabView")
        assert "Traceback" not in server.log and "Warning" not in server.log
    assert [*elsewhere.iterdir()] == []


CORE = tomllib.loads((ROOT / "deploy/core/pyproject.toml").read_text(encoding="utf-8"))


def test_the_core_alone_has_the_version_and_the_bounds_of_the_explorer():
    for name in ("version", "license", "requires-python"):
        assert CORE["project"][name] == PROJECT["project"][name]
    bounds = {each.name: each for each in map(Requirement, CORE["project"]["dependencies"])}
    assert bounds == {name: BOUNDS[name] for name in ("numpy", "scipy", "numba")}
    assert CORE["build-system"]["requires"] == PROJECT["build-system"]["requires"][:1]


def installed(folder, *whats):
    """The Python of a new environment with what pip installs for each list of arguments."""
    inside = folder / ("Scripts" if os.name == "nt" else "bin") / "python"
    subprocess.run([sys.executable, "-m", "venv", folder], check=True)
    for what in whats:
        done = subprocess.run([inside, "-m", "pip", "install", "--quiet", *what], capture_output=True, text=True)
        if re.search("No matching distribution|Max retries|timed out", done.stderr):
            pytest.skip("the index of packages cannot be reached")
        assert done.returncode == 0, done.stderr
    return inside


@pytest.mark.served
def test_the_source_archive_of_the_core_makes_the_same_wheel(archives, tmp_path):
    """In a clone its sources are elsewhere than in the archive."""
    with tarfile.open(next((archives / "core").glob("*.tar.gz"))) as archive:
        archive.extractall(tmp_path, filter="data")
    [source] = tmp_path.iterdir()
    build = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", tmp_path]
    subprocess.run(build, cwd=source, check=True, capture_output=True)
    wheels = (zipfile.ZipFile(next(folder.glob("*.whl"))) for folder in (archives / "core", tmp_path))
    made, again = ({name for name in wheel.namelist() if name.startswith("tippe_core/")} for wheel in wheels)
    assert made == again and {"tippe_core/LICENSE", "tippe_core/motion/sliding.py"} < made


@pytest.mark.served
@pytest.mark.long
def test_the_core_alone_runs_the_ten_lines_of_the_readme(tmp_path):
    """In an environment without Panel, in the locked versions of what it depends on."""
    build = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", tmp_path]
    subprocess.run(build, cwd=ROOT / "deploy/core", check=True, capture_output=True)
    [wheel] = tmp_path.glob("tippe_core-*.whl")
    locked, known = tmp_path / "locked.txt", pins(ROOT / "locks/run.txt", platform.python_version())
    locked.write_text("\n".join(f"{name}=={version}" for name, version in known), encoding="utf-8")
    inside = installed(tmp_path / "venv", ["--constraint", locked, wheel])
    lines = re.compile(r"```python\n(.*?)```.*?prints\n\n```\n(.*?)```", re.DOTALL)
    code, printed = lines.search((ROOT / "README.md").read_text(encoding="utf-8")).groups()
    alone = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    run = partial(subprocess.run, cwd=tmp_path, env=alone, capture_output=True, text=True, check=True)
    assert run([inside, "-c", code]).stdout == printed
    asks = "import importlib.metadata as m, tippe_core as t; print(t.__version__, *(d.name for d in m.distributions()))"
    version, *names = run([inside, "-c", asks]).stdout.split()
    assert version == PROJECT["project"]["version"]
    assert {*names} - {"pip", "setuptools"} == {"llvmlite", "numba", "numpy", "scipy", "tippe-core"}


@pytest.mark.served
def test_the_source_archive_has_all_that_git_has(unpacked):
    known = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True).stdout.split("\n")
    assert [path for path in known if path and (ROOT / path).exists() and not (unpacked / path).exists()] == []


@pytest.mark.served
@pytest.mark.long
def test_the_source_archive_passes_its_tests_of_files(unpacked):
    """Tests of files that are not programs: the settings of proxies and clusters, the docs, the README."""
    done = subprocess.run([sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "tests/test_readme.py",
                           "tests/test_settings.py", "tests/test_package.py", "-k",
                           "(files or docs or readme or lock) and not archive"],
                          cwd=unpacked, capture_output=True, text=True)  # fmt: skip
    assert done.returncode == 0, done.stdout[-3000:]


def test_the_command_of_the_package_is_that_of_the_module():
    """What pip makes of it is `from app.__main__ import run; run()`."""
    module, _, function = PROJECT["project"]["scripts"]["tippe-top"].partition(":")
    tree = ast.parse((ROOT / f"{module.replace('.', '/')}.py").read_text(encoding="utf-8"))
    [defined] = [node for node in tree.body if isinstance(node, ast.FunctionDef) and node.name == function]
    assert not defined.args.args


def test_the_list_of_what_is_installed_has_the_locked_libraries_and_those_of_the_bundle():
    with (ROOT / "deploy/sbom.py").open("rb") as program:
        done = subprocess.run([sys.executable, "-"], stdin=program, capture_output=True, check=True)
    listed = json.loads(done.stdout)
    assert (listed["bomFormat"], listed["metadata"]["component"]["name"]) == ("CycloneDX", "tippe-top-explorer")
    refs = {each["bom-ref"] for each in listed["components"]}
    assert len(refs) == len(listed["components"])  # the format wants them unique
    lock = dict(pins(ROOT / "locks/run.txt", platform.python_version()))
    assert {f"pkg:pypi/{name}@{version}" for name, version in lock.items()} <= refs
    bundled = json.loads((ROOT / "app/frontend/package.json").read_text(encoding="utf-8"))["dependencies"]
    assert {f"pkg:npm/{name}@{version}" for name, version in bundled.items()} <= refs
    if shutil.which("dpkg-query"):
        query = ["dpkg-query", "--show", "--showformat", "${db:Status-Abbrev}\\t${Package}\\n"]
        names = subprocess.run(query, capture_output=True, text=True, check=True).stdout.splitlines()
        installed = {name for status, name in (line.split("\t") for line in names) if status[1] == "i"}
        assert installed == {each["name"] for each in listed["components"] if each["purl"].startswith("pkg:deb/")}


def test_what_is_to_be_cited_is_this_version_and_the_paper():
    cited = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    assert {name: cited[name] for name in ("version", "license")} == {
        name: PROJECT["project"][name] for name in ("version", "license")
    }
    [paper] = cited["references"]
    assert (paper["volume"], paper["start"], paper["year"]) == (68, 821, 2000)
    assert PROJECT["project"]["urls"]["Paper"] == f"https://doi.org/{paper['doi']}"


def test_the_workflows_do_what_the_tests_and_the_readme_do():
    tests, release = (
        yaml.safe_load((ROOT / ".github" / "workflows" / f"{name}.yml").read_text(encoding="utf-8"))["jobs"]
        for name in ("tests", "release")
    )
    assert {"run": ".ci/run"} in tests["all"]["steps"]
    assert [f"{python}.0" for python in tests["every"]["strategy"]["matrix"]["python"]] == list(PYTHONS)
    assert {*tests["every"]["strategy"]["matrix"]["system"]} == {"ubuntu-latest", "macos-latest", "windows-latest"}
    assert {name: job.get("needs") for name, job in release.items()} == {
        "archives": None, "image": "archives", "index": "image", "page": "image"  # what fails publishes nothing
    }  # fmt: skip


def test_every_action_is_pinned_by_its_commit_and_says_which_version_that_is():
    """A tag can be moved to another program."""
    text = "".join(path.read_text(encoding="utf-8") for path in (ROOT / ".github/workflows").glob("*.yml"))
    used = re.findall(r"uses: (.*)", text)
    assert len(used) > 8
    assert [each for each in used if not re.fullmatch(r"[\w-]+/[\w-]+@[0-9a-f]{40}  # v\d+\.\d+\.\d+", each)] == []
