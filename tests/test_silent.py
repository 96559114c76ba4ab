"""A server that does not answer, though its line is open: the page says so."""

import os
import signal
import sys

import pytest
from serving import served

pytestmark = [pytest.mark.served, pytest.mark.skipif(sys.platform == "win32", reason="no process is stopped there")]


def test_a_server_that_hangs_is_said_and_what_was_set_is_done_when_it_goes_on(tmp_path, chromium):
    with served(tmp_path / "log") as server:
        page = chromium.new_page(reduced_motion="reduce")
        page.goto(server.url)
        page.wait_for_function("globalThis.Bokeh?.documents?.length")
        says = page.get_by_role("alert").filter(has_text="has not answered")
        os.kill(server.process.pid, signal.SIGSTOP)
        try:
            page.get_by_role("radio", name="Rough").click()
            says.wait_for()
        finally:
            os.kill(server.process.pid, signal.SIGCONT)
        says.wait_for(state="detached")
        page.wait_for_function("location.search.includes('rough')")
        page.close()
