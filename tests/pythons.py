"""Every Python of this machine from 3.11 on: the project is installed as people install it, without the lock and with
the newest libraries that its bounds allow, and visitors come, by websocket and in Chromium. On 3.11 once more with the
lowest libraries.

    python tests/pythons.py [3.12 ...]            these alone
    python tests/pythons.py newest                the newest alone
    python tests/pythons.py --newest              prints its path
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from contextlib import contextmanager
from importlib.util import find_spec
from pathlib import Path

import visitors
from serving import serving
from visiting import PATIENCE, Visit, go_to, launch

sys.path.insert(0, str(Path(__file__).parent.parent))
from app.text import say

ROOT = Path(__file__).parent.parent
FIRST, LAST = 11, 14  # of Python 3; missing ones among these are reported
SHOWN = ("panel", "bokeh", "param", "numpy", "scipy", "tornado", "matplotlib", "segno", "numba")
VISITORS = 4
# Whether a panel of the Lab has its content.
CHOSEN = """panel => {
    const [doc] = Bokeh.documents, models = [...doc.all_models]
    const values = (options) => [...(options instanceof Map ? options.values() : Object.values(options))]
    const [choice] = models.filter(({data}) => data?.options && values(data.options).includes(panel))
    return choice.data.value == panel && doc.is_idle
}"""
# Whether a room has replaced the sentence that it is being created.
STANDS = """([place, waits]) => {
    const [doc] = Bokeh.documents, {children} = doc.get_model_by_name(place)
    return children.length == 1 && children[0].id != waits && doc.is_idle
}"""


def pythons():
    """{(3, minor): the program}, the newest of each on the PATH or among pyenv's."""
    places = [Path(folder) for folder in os.environ.get("PATH", "").split(os.pathsep)]
    if shutil.which("pyenv"):
        root = Path(subprocess.run(["pyenv", "root"], capture_output=True, text=True).stdout.strip())
        places += [path / "bin" for path in (root / "versions").glob("*")]
    found = {}
    for program in (path for place in places for path in [*place.glob("python3.*"), *place.glob("python.exe")]):
        if not re.fullmatch(r"python(3\.\d+)?(\.exe)?", program.name):
            continue
        try:
            asked = subprocess.run([program, "-c", "import sys, venv; print(*sys.version_info[:3])"],
                                   capture_output=True, text=True)  # fmt: skip
        except OSError:  # it cannot be started
            continue
        if asked.returncode == 0:  # a shim of pyenv may lead to no Python
            version = tuple(map(int, asked.stdout.split()))
            if version[:2] >= (3, FIRST):
                found[version[:2]] = max(found.get(version[:2], ((), None)), (version, str(program)))
    return {minor: program for minor, (_, program) in sorted(found.items())}


def installed(python, folder, constraints=None):
    """The Python of an environment in which the project is; raises RuntimeError with what pip said."""
    subprocess.run([python, "-m", "venv", folder], check=True)
    inside = folder / ("Scripts" if os.name == "nt" else "bin") / "python"
    bounds = ["--constraint", constraints] if constraints else []
    pip = [inside, "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
    done = subprocess.run([*pip, ROOT, *bounds], capture_output=True, text=True)
    if done.returncode:
        raise RuntimeError(done.stderr)
    return inside


def look(url, browser):
    """Opens every room in Chromium; whether all came and the page said of no error."""
    page = browser.new_page(viewport={"width": 1400, "height": 900})
    try:
        visit = Visit(page, url, listens=True)
        for panel in visitors.PANELS:
            page.get_by_role("radio", name=say(f"research.panels.{panel}", "en"), exact=True).click()
            page.wait_for_function(CHOSEN, arg=panel)
        rooms = ("Build a top", "Families", "Learn", "Maps", "Measure")  # visit is in the Lab
        for room, name in zip(rooms, visitors.ROOMS, strict=True):
            waits = page.evaluate("n => Bokeh.documents[0].get_model_by_name(n).children[0].id", f"place-of-{name}")
            go_to(page, room)
            page.wait_for_function(STANDS, arg=[f"place-of-{name}", waits], timeout=PATIENCE)
        print(f"    Chromium: {len(visitors.PANELS)} panels and {len(rooms)} rooms opened, "
              f"{len(visit.errors)} errors in the page", *visit.errors)  # fmt: skip
        return not visit.errors
    except Exception as error:
        print(f"    Chromium: {type(error).__name__}: {error}")
        return False
    finally:
        page.close()


def tried(name, python, browser, constraints=None):
    """Whether all went well; prints what happened."""
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        try:
            inside = installed(python, folder / "venv", constraints)
        except (RuntimeError, OSError, subprocess.CalledProcessError) as error:
            print(f"{name}: cannot be installed by {python}: {error}")
            return False
        asked = ("import importlib.metadata as m, platform as p, app; print(p.python_version(), app.__path__[0], "
                 f"*(f'{{name}} {{m.version(name)}}' for name in {SHOWN}), sep=', ')")  # fmt: skip
        said = subprocess.run([inside, "-c", asked], cwd=folder, capture_output=True, text=True, check=True).stdout
        version, app, versions = said.strip().split(", ", 2)
        print(f"{name}: Python {version}, {versions}", flush=True)
        # Visitors to a server without kernels: test_compiled.py.
        subprocess.run([inside, "-m", "tippe_core"], cwd=folder, stdout=subprocess.DEVNULL, check=True)
        good = True
        for command in (["-m", "app"], ["-m", "panel", "serve", app]):
            print("  python", *command[:3], flush=True)
            log = folder / "log"
            with serving([inside, *command], log, folder) as server:
                came = visitors.main(server.url, VISITORS) == 0
                fine = came and (browser is None or look(server.url, browser))
            # A page that closes while Bokeh 3.10 stops causes a traceback, so the log counts only until then.
            said = log.read_text().partition("Received signal")[0].splitlines()
            wrong = [line for line in said if re.search("ERROR|Traceback|a bug|Error:", line)]
            if wrong or not fine:
                print(*log.read_text().splitlines()[-40:], sep="\n")
            good = good and fine and not wrong
        return good


def main(only):
    """Prints a table; returns the exit code."""
    found = pythons()
    for minor in range(FIRST, LAST + 1):
        if (3, minor) not in found:
            print(f"Python 3.{minor}: there is none on this machine")
    if only == ["newest"]:
        only = ["{}.{}".format(*max(found))]
    chosen = {version: program for version, program in found.items() if not only or "{}.{}".format(*version) in only}
    with chromium() as browser:
        good = [tried("newest libraries", program, browser) for program in chosen.values()]
        if (3, FIRST) in chosen:
            good.append(tried("lowest libraries", chosen[3, FIRST], browser, ROOT / "locks/lowest.txt"))
    return 0 if good and all(good) else 1


@contextmanager
def chromium():
    """A browser, or None where Playwright is not installed."""
    if find_spec("playwright") is None:
        print("Playwright is not installed: nobody comes in Chromium")
        yield None
        return
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        browser = launch(playwright)
        yield browser
        browser.close()


if __name__ == "__main__":
    if sys.argv[1:] == ["--newest"]:
        sys.exit(print(pythons()[max(pythons())]))
    sys.exit(main(sys.argv[1:]))
