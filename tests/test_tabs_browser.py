"""Tabs in Chromium, on a server with something wrong in it: a click is answered at once, a failure costs nothing."""

import re
import sys
from contextlib import contextmanager
from pathlib import Path

import pytest
from visiting import Visit
from wire import serving

ROOT = Path(__file__).parent.parent
SERVE = "\nfrom app.__main__ import run\nrun()"

# What Panel makes of the map's figure, or the view of the tab itself, fails once; the figures of the tops come late.
IN_PANEL = """
from panel.pane.plot import Bokeh
failed, real = [], Bokeh._get_model
def fails_once(pane, *arguments, **named):
    if getattr(pane.object, "name", "") == "map" and not failed:
        failed.append(True)
        raise RuntimeError("made to fail in Panel")
    return real(pane, *arguments, **named)
Bokeh._get_model = fails_once
"""
IN_MAKER = """
import app.page as page
failed, real = [], page.family_view
def fails_once(*arguments):
    if not failed:
        failed.append(True)
        raise RuntimeError("made to fail in the maker")
    return real(*arguments)
page.family_view = fails_once
"""
IN_HOOKS = """
from panel.viewable import Viewable
failed, real = [], Viewable._preprocess
def fails_once(self, root, changed=None, old_models=None):
    parts = (changed or self).select()
    if not failed and any(getattr(getattr(part, "object", None), "name", "") == "map" for part in parts):
        failed.append(True)
        raise RuntimeError("made to fail in the hooks")
    return real(self, root, changed, old_models)
Viewable._preprocess = fails_once
"""
URLS = """() => [...Bokeh.documents[0]._all_models.values()].filter((m) => m.type == "ImportedStyleSheet")
  .map((m) => m.url)"""


@contextmanager
def broken(code, tmp_path):
    """A server with this wrong in it."""
    command = [sys.executable, "-c", code + SERVE]
    with serving(command, tmp_path / "log", ROOT) as server:
        yield server


@pytest.fixture
def page(chromium):
    page = chromium.new_page(viewport={"width": 1400, "height": 900})
    yield page
    page.close()


def elsewhere(visit, server):
    """The addresses on other machines that the page asked for."""
    return [url for url in visit.requests if not url.startswith((server.root, "data:", "blob:"))]


@pytest.mark.parametrize("code", [IN_PANEL, IN_HOOKS, IN_MAKER], ids=["in Panel", "in its hooks", "in ours"])
def test_a_tab_that_cannot_be_made_says_so_costs_nothing_and_can_be_opened_again(page, tmp_path, code):
    with broken(code, tmp_path) as server:
        visit = Visit(page, server.url)
        before = page.evaluate(URLS)
        page.get_by_role("tab", name="Families").click()
        alert = page.get_by_role("alert").filter(has_text="could not be made")
        alert.wait_for()
        page.get_by_role("tab", name="Build a top").click()  # another one, after it
        page.get_by_role("button", name="Save this top").wait_for()
        assert not alert.is_visible()
        page.get_by_role("tab", name="Families").click()
        page.get_by_role("button", name="Compute the map").wait_for()
        page.get_by_role("tab", name="Roll").click()
        page.locator("[data-figure=plane]").first.wait_for()
        assert not re.findall("cdn", " ".join(page.evaluate(URLS)), re.I)
        assert set(before) <= set(page.evaluate(URLS))
        assert elsewhere(visit, server) == []
        assert "made to fail" in server.log
