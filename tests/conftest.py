"""Fixtures for all tests, which share one browser and one server. Hypothesis draws the same examples in every run, so
a new failure is due to a change of the code."""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest
import references
from durations import Durations
from evidence import compare as compare
from hypothesis import HealthCheck, settings
from playwright.sync_api import sync_playwright
from serving import answers, end, redis_serving, until
from visiting import Contexts, Visit, free_port, launch
from watching import Watch

settings.register_profile(
    "repeatable", derandomize=True, deadline=None, max_examples=25, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile("repeatable")


def pytest_addoption(parser):
    parser.addoption("--remake", action="store_true", help="compute the slow oracles' answers again and store them")
    parser.addoption("--store", action="store_true", help="store those that are missing; with -n 0")
    parser.addoption("--write-durations", action="store_true", help="store how long each file of tests takes")
    parser.addoption("--long", action="store_true", help="run also those that are slow by nature: `make long`")
    parser.addoption(
        "--shortest-first", action="store_true", help="run the shortest files of tests first, not the longest"
    )


def pytest_collection_modifyitems(config, items):
    if config.getoption("--long"):
        return
    items[:], long = (
        [item for item in items if bool(item.get_closest_marker("long")) is is_long] for is_long in (False, True)
    )
    config.hook.pytest_deselected(items=long)


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_auto_num_workers(config):
    """Twice as many as there are processors: a test that waits for a page or a server leaves one to another."""
    return 2 * (os.cpu_count() or 2)


def pytest_configure(config):
    references.REMAKE = config.getoption("--remake")
    references.STORE = references.REMAKE or config.getoption("--store")
    config.pluginmanager.register(Durations(config))


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item, call):
    """Stores how the pages look when a test first fails, before its fixtures close them."""
    report = yield
    watch = item.config.stash.get(WATCH, None)
    if watch and report.failed and uses_a_browser(item) and not item.stash.get(STORED, False):
        item.stash[STORED] = True
        report.sections.append(("the pages at this failure", f"{watch.store(item.nodeid)}"))
    return report


WATCH, STORED = pytest.StashKey(), pytest.StashKey()


def uses_a_browser(item):
    return "chromium" in item.fixturenames


@pytest.fixture(autouse=True)
def page_errors(request):
    """The Watch of the browser. An error in a page fails the test in which it happens, unless the test allows it."""
    if not uses_a_browser(request.node):
        yield None
        return
    request.getfixturevalue("chromium")
    watch = request.config.stash[WATCH]
    watch.console.clear()
    yield watch
    assert watch.end() == []


@pytest.fixture(scope="session", autouse=True)
def votes():
    """The servers of the tests store votes in a temporary file, not in that of the user."""
    folder = tempfile.mkdtemp()
    os.environ["TIPPE_VOTES"] = f"{folder}/votes.sqlite"
    yield
    shutil.rmtree(folder)


@pytest.fixture(scope="session")
def redis():
    """The URL of a Redis."""
    if not shutil.which("redis-server"):
        pytest.skip("redis-server is not installed: `make redis`")
    with redis_serving(free_port()) as url:
        yield url


@pytest.fixture(scope="session")
def chromium(request):
    with sync_playwright() as playwright:
        browser = launch(playwright)
        request.config.stash[WATCH] = Watch(browser)
        Contexts(browser)
        yield browser
        browser.close()


@pytest.fixture(scope="session")
def server():
    """The address of the page, served by `panel serve app`."""
    port = free_port()
    process = subprocess.Popen(
        [sys.executable, "-m", "panel", "serve", "app", "--port", str(port), "--address", "localhost"],
        cwd=Path(__file__).parent.parent,
    )
    url = f"http://localhost:{port}/app"
    try:
        until(lambda: process.poll() is not None or answers(url))
        assert process.poll() is None, "panel serve app has ended"
        yield url
    finally:
        end(process)


@pytest.fixture
def explorer():
    """An Explorer at rest, of the paper's top."""
    from app.model.explorer import Explorer  # not for tests that need nothing of the app

    return Explorer()


@pytest.fixture(params=[(1400, 900)], ids=["1400x900"])
def visit(request, server, chromium):
    """A Visit in a window of this size. Nothing moves by itself, because software drawing slows everything."""
    width, height = request.param
    with chromium.new_context(viewport={"width": width, "height": height}, reduced_motion="reduce") as context:
        yield Visit(context.new_page(), server)
