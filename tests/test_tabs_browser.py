"""A tab in Chromium, on a server that is slow: a click is answered at once, and who leaves ends the work."""

import pytest
from lab_page import come
from serving import served, until
from visiting import go_to

pytestmark = pytest.mark.served

# The view waits for a file, and the whole server with it; the first map never finishes.
SLOW = """
import os, sys, time
import app.tabs.families.compare as compare, app.page.session as page
real_view, real_map, maps = page.Session.families, compare.share_map, []
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
page.Session.families, compare.share_map, compare.Compare._work = late, endless, work
"""
# The number of finished rows of the map.
ROWS = """() => {
  const map = Bokeh.documents.flatMap((doc) => [...doc.all_models]).find((m) => m.name == "map" && m.renderers)
  const share = map?.renderers[0].data_source.data.share[0] ?? []
  return Array.from(share).flat(2).filter(Number.isFinite).length
}"""


@pytest.fixture
def page(chromium):
    page = chromium.new_page(viewport={"width": 1400, "height": 900}, reduced_motion="reduce")
    yield page
    page.close()


def test_a_click_is_answered_at_once_and_leaving_ends_what_was_under_way(chromium, page, tmp_path):
    go = tmp_path / "go"
    with served(tmp_path / "log", code=SLOW.replace("GO", repr(str(go)))) as server:
        come(page, f"{server.url}?")
        go_to(page, "Families")
        page.get_by_text("This tab is loading").locator("visible=true").wait_for()  # while the server is blocked
        assert not page.locator(".lab").is_visible()
        assert page.get_by_role("tab", name="Maps").get_attribute("aria-selected") == "true"
        go.touch()
        page.get_by_role("button", name="Compute the map").wait_for()
        page.locator("svg[aria-label^='Figure 6: ']").first.wait_for()
        until(lambda: "WORKS" in server.log)
        assert "ENDED" not in server.log
        page.goto("about:blank")
        until(lambda: "ENDED" in server.log, 60)

        again = chromium.new_page(viewport={"width": 1400, "height": 900}, reduced_motion="reduce")
        come(again, f"{server.url}?")
        go_to(again, "Families")
        again.wait_for_function(f"() => ({ROWS})() > 1000")
        again.get_by_role("progressbar").wait_for(state="hidden")
        rows = again.evaluate(ROWS)
        go_to(again, "Lab")
        again.locator(".lab").wait_for()
        go_to(again, "Families")
        button = again.get_by_role("button", name="Compute the map")
        button.wait_for()
        assert again.evaluate(ROWS) == rows and button.is_enabled()
        again.get_by_role("radio", name="ordinary tops").click()  # which nobody has seen yet
        button.click()
        again.get_by_role("button", name="Cancel").and_(again.locator("[aria-disabled=false]")).wait_for()
        again.wait_for_function(f"rows => ({ROWS})() == rows", arg=rows)
        again.close()
