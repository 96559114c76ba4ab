"""Fixtures for all tests, which share one browser and one server. Hypothesis draws the same examples in every run, so
a new failure is due to a change of the code."""

import os
import shutil
import subprocess
import sys
import tempfile
import time
import urllib.request
from pathlib import Path

import pytest
import references
from evidence import compare as compare
from hypothesis import HealthCheck, settings
from playwright.sync_api import sync_playwright
from serving import redis_serving
from visiting import Visit, free_port, launch

settings.register_profile(
    "repeatable", derandomize=True, deadline=None, max_examples=60, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile("repeatable")


def pytest_addoption(parser):
    parser.addoption("--remake", action="store_true", help="compute the slow oracles' answers again and store them")


def pytest_configure(config):
    references.REMAKE = config.getoption("--remake")


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
def chromium():
    with sync_playwright() as playwright:
        browser = launch(playwright)
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
    deadline = time.monotonic() + 60
    while True:
        try:
            urllib.request.urlopen(url, timeout=60).close()
            break
        except OSError:
            if process.poll() is not None or time.monotonic() > deadline:
                process.terminate()
                pytest.fail(f"panel serve app did not answer on {url}")
            time.sleep(0.1)
    yield url
    process.terminate()
    process.wait()


@pytest.fixture(scope="module", params=[(1400, 900)], ids=["1400x900"])
def visit(request, server, chromium):
    """A Visit that all tests of a file share, in a window of this size. An error in the page fails the last test."""
    width, height = request.param
    page = chromium.new_page(viewport={"width": width, "height": height})
    visit = Visit(page, server)
    yield visit
    page.close()
    assert not visit.errors
