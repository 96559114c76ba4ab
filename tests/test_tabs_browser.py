"""Tabs in Chromium, on a server with faults: a click is answered at once, and an error breaks nothing else."""

import re
import sys
from contextlib import contextmanager
from pathlib import Path

import pytest
from serving import serving, until
from visiting import Visit, go_to

pytestmark = pytest.mark.served

ROOT = Path(__file__).parent.parent
SERVE = "\nfrom app.__main__ import run\nrun()"

# Panel's part for the figure of the map, or the view of the tab, fails once; the figures of the tops come late.
IN_PANEL = """
from panel.pane.plot import Bokeh
failed_in_panel, real_in_panel = [], Bokeh._get_model
def fails_in_panel(pane, *arguments, **named):
    if getattr(pane.object, "name", "") == "map" and not failed_in_panel:
        failed_in_panel.append(True)
        raise RuntimeError("made to fail in Panel")
    return real_in_panel(pane, *arguments, **named)
Bokeh._get_model = fails_in_panel
"""
IN_MAKER = """
import app.page.house as page
failed_in_maker, real_in_maker = [], page.House.families
def fails_in_maker(*arguments):
    if not failed_in_maker:
        failed_in_maker.append(True)
        raise RuntimeError("made to fail in the maker")
    return real_in_maker(*arguments)
page.House.families = fails_in_maker
"""
IN_HOOKS = """
from panel.viewable import Viewable
failed_in_hooks, real_in_hooks = [], Viewable._preprocess
def fails_in_hooks(self, root, changed=None, old_models=None):
    parts = (changed or self).select()
    if not failed_in_hooks and any(getattr(getattr(part, "object", None), "name", "") == "map" for part in parts):
        failed_in_hooks.append(True)
        raise RuntimeError("made to fail in the hooks")
    return real_in_hooks(self, root, changed, old_models)
Viewable._preprocess = fails_in_hooks
"""
# The view waits for a file, and the whole server with it; the first map never finishes.
SLOW = """
import os, sys, time
import app.tabs.families.compare as compare, app.page.house as page
real_view, real_map, maps = page.House.families, compare.share_map, []
def late(*arguments):
    while not os.path.exists(GO):
        time.sleep(0.05)
    return real_view(*arguments)
def endless(*arguments):
    maps.append(True)
    if len(maps) > 1:
        yield from real_map(*arguments)
        return
    while True:
        time.sleep(0.02)
        print("WORKS", flush=True)
        yield 1, next(real_map(*arguments))[1]
real_work = compare.Compare._work
def work(self, *arguments):
    try:
        return real_work(self, *arguments)
    finally:
        print("ENDED", flush=True)
page.House.families, compare.share_map, compare.Compare._work = late, endless, work
"""
# The number of finished rows of the map.
ROWS = """() => {
  const map = [...Bokeh.documents[0]._all_models.values()].find((m) => m.name == "map" && m.renderers)
  const share = map?.renderers[0].data_source.data.share[0] ?? []
  return Array.from(share).flat(2).filter(Number.isFinite).length
}"""
FAILURES = ("the maker", "the hooks", "Panel")
URLS = """() => [...Bokeh.documents[0]._all_models.values()].filter((m) => m.type == "ImportedStyleSheet")
  .map((m) => m.url)"""


@contextmanager
def broken(code, tmp_path):
    """A server with this fault."""
    command = [sys.executable, "-c", code + SERVE]
    with serving(command, tmp_path / "log", ROOT) as server:
        yield server


@pytest.fixture
def page(chromium):
    page = chromium.new_page(viewport={"width": 1400, "height": 900})
    yield page
    page.close()


def elsewhere(visit, server):
    """The requests of the page to other machines."""
    return [url for url in visit.requests if not url.startswith((server.root, "data:", "blob:"))]


def test_a_tab_that_cannot_be_made_says_so_costs_nothing_and_can_be_opened_again(page, tmp_path):
    with broken(IN_MAKER + IN_HOOKS + IN_PANEL, tmp_path) as server:
        visit = Visit(page, server.url)
        before = page.evaluate(URLS)
        alert = page.get_by_role("alert").filter(has_text="could not be loaded")
        for _ in FAILURES:
            go_to(page, "Families")
            alert.wait_for()
            go_to(page, "Build a top")  # another tab, after that
            page.get_by_role("button", name="Save this top").wait_for()
            assert not alert.is_visible()
        go_to(page, "Families")
        page.get_by_role("button", name="Compute the map").wait_for()
        go_to(page, "Roll")
        page.locator("[data-figure=plane]").first.wait_for()
        assert not re.findall("cdn", " ".join(page.evaluate(URLS)), re.I)
        assert set(before) <= set(page.evaluate(URLS))
        assert elsewhere(visit, server) == []
        assert all(server.log.count(f"RuntimeError: made to fail in {where}") == 1 for where in FAILURES)
        page.close()  # before its server goes


def test_a_click_is_answered_at_once_and_leaving_ends_what_was_under_way(chromium, page, tmp_path):
    go = tmp_path / "go"
    with broken(SLOW.replace("GO", repr(str(go))), tmp_path) as server:
        Visit(page, server.url)
        go_to(page, "Families")
        page.get_by_text("This tab is loading").locator("visible=true").wait_for()  # while the server is blocked
        assert not page.locator("[data-figure=plane]").first.is_visible()
        assert page.get_by_role("tab", name="Maps").get_attribute("aria-selected") == "true"
        go.touch()
        page.get_by_role("button", name="Compute the map").wait_for()
        page.locator("svg[aria-label^='Figure 6: ']").first.wait_for()
        until(lambda: "WORKS" in server.log)
        assert "ENDED" not in server.log
        page.goto("about:blank")
        until(lambda: "ENDED" in server.log, 60)

        again = chromium.new_page(viewport={"width": 1400, "height": 900})
        Visit(again, server.url)
        go_to(again, "Families")
        again.wait_for_function(f"() => ({ROWS})() > 1000")
        again.get_by_role("progressbar").wait_for(state="hidden")
        rows = again.evaluate(ROWS)
        go_to(again, "Roll")
        again.locator("[data-figure=plane]").first.wait_for()
        go_to(again, "Families")
        button = again.get_by_role("button", name="Compute the map")
        button.wait_for()
        assert again.evaluate(ROWS) == rows and button.is_enabled()
        button.click()
        again.get_by_role("button", name="Cancel").and_(again.locator(":enabled")).wait_for()
        again.wait_for_function(f"rows => ({ROWS})() == rows", arg=rows)
        again.close()
