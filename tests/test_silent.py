"""A line that is slow or cut without a word, a server that does not answer though its line is open, and a tab that
slept: the page says so, and comes back."""

import os
import signal
import socket
import sys
import threading
from contextlib import contextmanager, suppress

import pytest
from lab_page import TIME
from playwright.sync_api import Error
from serving import served
from test_faults import HERE, has_come_back, set_spin
from visiting import free_port
from watching import LOST

from app.text import say

pytestmark = [pytest.mark.served, pytest.mark.skipif(sys.platform == "win32", reason="no process is stopped there")]
SILENT = "has not answered"
# skip(ms): for the page so much more time has passed. A request with a time limit has a fortieth of it.
SKIP = """{ const now = performance.now.bind(performance), limit = AbortSignal.timeout.bind(AbortSignal); let more = 0
performance.now = () => now() + more
window.skip = (ms) => { more += ms }
AbortSignal.timeout = (ms) => limit(ms / 40) }"""


@pytest.fixture
def page(chromium, page_errors):
    page_errors.allow(f"{LOST}|Failed to load Bokeh|Error rendering Bokeh items")
    page = chromium.new_page(viewport={"width": 1400, "height": 900}, reduced_motion="reduce")
    page.add_init_script(SKIP)
    yield page
    page.close()


class Line:
    """A line to a server, at a port of its own. cut(): what is on it from now on is lost, in both directions, without
    a word. mend(): what was cut is reset, as by a router that has forgotten it; a new connection is a new line. While
    the server is gone, it is refused."""

    def __init__(self, port):
        self.port, self._to, self._lines, self._here = free_port(), port, [], []
        self._open = threading.Event()
        self._open.set()
        self._listening = socket.create_server(("127.0.0.1", self.port))
        threading.Thread(target=self._accept, daemon=True).start()

    def cut(self):
        self._open.clear()
        for each in self._lines:
            each.set()

    def mend(self):
        self._open.set()
        for here in self._here:
            with suppress(OSError):
                here.shutdown(socket.SHUT_RDWR)

    def close(self):
        self._listening.close()

    def _accept(self):
        with suppress(OSError):
            while True:
                here, _ = self._listening.accept()
                try:
                    there = socket.create_connection(("127.0.0.1", self._to))
                except OSError:
                    here.close()
                    continue
                lost = threading.Event()
                if not self._open.is_set():
                    lost.set()
                self._lines.append(lost)
                self._here.append(here)
                for one, other in ((here, there), (there, here)):
                    threading.Thread(target=self._carry, args=(one, other, lost), daemon=True).start()

    @staticmethod
    def _carry(one, other, lost):
        with suppress(OSError):
            while data := one.recv(65536):
                if not lost.is_set():
                    other.sendall(data)
        with suppress(OSError):
            if not lost.is_set():
                other.shutdown(socket.SHUT_WR)


@contextmanager
def line_to(port):
    """A Line to the server at this port, and the address of the page over it."""
    line = Line(port)
    try:
        yield line, f"http://127.0.0.1:{line.port}/app"
    finally:
        line.close()


def ask_in_vain(page, table):
    """Clicks where no answer comes, and for the page seconds pass."""
    page.get_by_role("radio", name=table).click()
    page.evaluate("skip(6000)")


def test_whatever_becomes_of_its_server_the_page_says_it_and_comes_back_with_all_that_was_set(page, tmp_path):
    """It hangs, and does what was asked of it when it goes on; its line is cut without a word; it is killed while the
    tab sleeps, in which a page runs no line of its scripts."""
    port = free_port()
    with line_to(port) as (line, url):
        with served(tmp_path / "log", port=port) as server:
            page.goto(url)
            set_spin(page, "29.5")
            says = page.get_by_role("alert").filter(has_text=SILENT)
            os.kill(server.process.pid, signal.SIGSTOP)
            try:
                ask_in_vain(page, "Rough")
                says.wait_for()
            finally:
                os.kill(server.process.pid, signal.SIGCONT)
            says.wait_for(state="detached")
            page.wait_for_function("location.search.includes('rough')")
            lost = page.get_by_role("alert").filter(has_text=say("main.lost", "en"))
            line.cut()
            ask_in_vain(page, "Ice")
            says.wait_for()
            with page.expect_event("requestfailed", lambda request: request.url.endswith("readyz")):
                page.evaluate("skip(25_000)")  # and what it asks then is not waited for without end
            lost.wait_for()
            assert page.evaluate("window.mark") == 1  # nothing answers: there is nothing to load
            line.mend()
            has_come_back(page, "29.5")
            page.evaluate("window.mark = 1")
            devtools = page.context.new_cdp_session(page)
            devtools.send("Page.setWebLifecycleState", {"state": "frozen"})
            server.process.kill()
        with suppress(Error):  # Chromium had not let it sleep
            devtools.send("Page.setWebLifecycleState", {"state": "active"})
        lost.wait_for()
        page.get_by_role("button", name="Play", exact=True).click()
        page.wait_for_function(f"t => {TIME} != t", arg=page.evaluate(TIME))  # it plays without a server
        with served(tmp_path / "log", port=port) as server:
            has_come_back(page, "29.5")
            assert "refused" not in server.log and "Traceback" not in server.log


@pytest.mark.long
def test_on_a_slow_line_the_page_says_that_it_is_coming_and_comes(page, tmp_path):
    """100 kbit/s and 400 ms, with nothing in the browser's cache."""
    devtools = page.context.new_cdp_session(page)
    slow = {"offline": False, "latency": 400, "downloadThroughput": 12_500, "uploadThroughput": 12_500}
    devtools.send("Network.enable")
    devtools.send("Network.emulateNetworkConditions", slow)
    with served(tmp_path / "log") as server:
        page.goto(server.url, wait_until="commit")
        page.get_by_text(say("main.server.coming", "en")).wait_for()
        page.wait_for_function(HERE, timeout=900_000)
        assert "refused" not in server.log  # at the first try
