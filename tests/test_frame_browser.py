"""The page in a sandboxed frame of a page at another origin, with the code that Share gives."""

import re
import threading
from http.server import BaseHTTPRequestHandler, HTTPServer

import pytest
import visitors
from components import alone as alone
from lab_page import come, put
from serving import served
from visiting import wait
from watching import LOST
from wire import run

from app.share.parts import Embed

pytestmark = pytest.mark.served

# A course page: it is higher than the window, and gives the frame the height that this asks for.
COURSE = """<!doctype html><html lang="en"><title>course</title><link rel="icon" href="data:,">
<body style="margin: 0"><div style="height: 200px">above</div><div style="width: 900px">%s</div>
<div style="height: 3000px">below</div><script>
window.heights = []
addEventListener("message", ({ data, source }) => {
  const frame = document.querySelector("iframe")
  if (source !== frame.contentWindow || data?.subject !== "lti.frameResize") return
  heights.push(data.height)
  frame.height = data.height
})
</script>"""
SANDBOX = '<iframe sandbox="allow-scripts allow-same-origin allow-downloads"'
SCROLLS = "({ scrollHeight, clientHeight }) => scrollHeight > clientHeight"


class Course(BaseHTTPRequestHandler):
    """A real server, because a browser lets no page without an address frame one of this machine."""

    frame = ""

    def do_GET(self):
        self.send_response(200)
        self.send_header("Content-Type", "text/html")
        self.end_headers()
        self.wfile.write((COURSE % self.frame).encode())

    def log_message(self, *said):
        pass


@pytest.fixture(scope="module")
def host():
    """The address of the course."""
    server = HTTPServer(("127.0.0.1", 0), Course)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://localhost:{server.server_port}"
    server.shutdown()
    server.server_close()


@pytest.fixture(scope="module")
def framed(host, tmp_path_factory):
    """The address of the page, which the course may frame."""
    with served(tmp_path_factory.mktemp("framed") / "log", frames=host) as server:
        yield server.url


def code(page):
    page.get_by_role("button", name="Share", exact=True).click()
    page.get_by_text("In a page of yours").wait_for()
    return page.get_by_role("textbox", name="In a page of yours")


def course(context, host, iframe):
    """A page of the course, and the frame in it."""
    page, Course.frame = context.new_page(), iframe
    page.goto(f"{host}/course")
    frame = next(each for each in page.frames if each != page.main_frame)
    return page, frame


def whole(frame):
    frame.wait_for_function("window.__tippe?.tops?.('lab').some((top) => top.pictures && top.count)")
    frame.wait_for_selector(".lab[data-whole]")


LIKE = {"viewport": {"width": 1400, "height": 900}, "reduced_motion": "reduce"}


def test_a_course_shows_it_as_high_as_it_is_and_keeps_its_own_scrolling_and_keys(host, framed, chromium):
    with chromium.new_context(**LIKE) as context:
        shared = come(context.new_page(), f"{framed}?v=4&spin=20").page
        iframe = code(shared).input_value()
        assert re.search(r'src="[^"]*\?v=4&amp;spin=20&amp;frame=1"', iframe)
        shared.close()
        page, frame = course(context, host, iframe.replace("<iframe", SANDBOX))
        whole(frame)
        root = frame.locator("html")
        wait(page, lambda: page.evaluate("heights.length") and not root.evaluate(SCROLLS))
        assert frame.get_by_role("button", name="Share").count() == 0 == frame.get_by_role("tab", name="Lab").count()
        for part in (".stage", ".strip", ".say", ".controls"):
            assert frame.locator(part).first.bounding_box()["height"] > 50
        assert frame.get_by_role("textbox", name="Spin").input_value() == "20.0"

        x, y, width, height = (frame.locator(".stage").bounding_box()[name] for name in ("x", "y", "width", "height"))
        page.mouse.move(x + width / 2, y + height / 2)
        page.mouse.wheel(0, 300)
        wait(page, lambda: page.evaluate("scrollY") == 300)
        before = frame.evaluate("__tippe.time('lab')")
        for key in ("ArrowRight", "PageDown"):
            page.keyboard.press(key)
        wait(page, lambda: page.evaluate("scrollY") > 600)
        assert frame.evaluate("__tippe.time('lab')") == before

        put(frame, "Spin", 25)
        wait(page, lambda: "spin=25" in frame.url)
        assert "frame=1" in frame.url and page.url == f"{host}/course"
        wait(page, lambda: not root.evaluate(SCROLLS))


def test_the_lesson_in_a_sandbox_keeps_its_height_and_prints_into_a_file(host, framed, chromium, page_errors):
    for what in ("allow-popups", "origin 'null'", "tippe.js", "Bokeh", LOST):  # what the browser refuses, it says
        page_errors.allow(what)
    with chromium.new_context(**LIKE) as context:
        lesson = f'{SANDBOX} src="{framed}?tab=learn&amp;frame=1" width="900" allow="fullscreen"></iframe>'
        page, frame = course(context, host, lesson)
        frame.locator(".option").first.wait_for()
        wait(page, lambda: page.evaluate("heights.at(-1) > 300"))
        with page.expect_download() as download:
            frame.get_by_role("button", name="Worksheet").click()
        assert download.value.suggested_filename == "tippe-top-sheet.html"
        frame.get_by_role("button", name="Present").click()
        frame.wait_for_selector(".presenting")
        page.wait_for_function("document.fullscreenElement")
        page.keyboard.press("Escape")
        frame.wait_for_selector(".presenting", state="detached")
        assert min(page.evaluate("heights")) > 0

        page, frame = course(context, host, lesson.replace("allow-same-origin", ""))
        frame.get_by_text("must have allow-same-origin").wait_for()


def test_a_server_that_allows_no_frame_says_which_setting_does(tmp_path, alone):
    async def frames(url):
        page = await visitors.come(url)
        await page.head("share")
        await page.until(lambda: page.visitor.find("Embed"))
        return page.now(page.visitor.find("Embed")[0], "frames")

    with served(tmp_path / "log") as server:
        page = alone().show(Embed(code="<iframe>", frames=run(frames(server.url))))
    page.get_by_text("TIPPE_FRAMES").wait_for()
    assert not page.locator("textarea").is_visible()
