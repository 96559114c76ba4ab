"""What is shown before Bokeh and the session have arrived: it needs little data, it moves, and the session takes it
over."""

import gzip
import json
import re
import urllib.request
from itertools import combinations
from urllib.parse import urljoin

import numpy as np
import pytest
from lab_page import DRAWN, TIME, TOPS, entry
from playwright.sync_api import expect
from watching import LOST

from app.page import first
from app.state.opened import FIRST, opened
from app.state.url_state import read
from app.text import LANGUAGES

MOST, WHOLE = 350_000, 1_200_000  # bytes, compressed: before the first frame, and before the page is idle


def arrays():
    """The contents of the file, {name: rows}."""
    line, _, bytes_ = gzip.decompress(first.FILE.read_bytes()).partition(b"\n")
    numbers, found = np.frombuffer(bytes_, "<i4"), {}
    for name, count, _, needed, steps in json.loads(line):
        columns, numbers = numbers[: count * needed].reshape(needed, count), numbers[count * needed :]
        found[name] = columns.cumsum(axis=1).cumsum(axis=1).T / steps
    assert not len(numbers)
    return found


def test_the_file_holds_what_a_session_sends():
    view = first.arrival()
    for name, rows in arrays().items():
        width, needed, steps = first.NUMBERS[name]
        sent = np.frombuffer(getattr(view, name), "<f4").reshape(-1, width)[:, :needed]
        assert rows == pytest.approx(sent, abs=0.5 / steps + 1e-6), name


def test_each_language_has_its_words_and_nothing_else():
    words = json.loads(first.words())
    says = [
        (each["texts"]["spin_it"], json.loads(each["told"])["runs"]["ordinary"]["stages"]) for each in words.values()
    ]
    assert [*words] == [*LANGUAGES]
    assert all(one[0] != other[0] and one[1] != other[1] for one, other in combinations(says, 2))
    values = [json.loads(each["state"])["values"] for each in words.values()]
    assert all(each == values[0] for each in values)


def test_it_is_drawn_only_where_the_session_opens_the_same():
    for search in first.searches():
        assert opened(read(search)[0]) == FIRST, search


@pytest.mark.served
def test_what_must_arrive_before_the_first_frame_is_small(server):
    """Counted are the page, the style sheets in its head, the bundle with the needed part of three.js, and the run."""
    url = server.rstrip("/")
    page = urllib.request.urlopen(url).read()
    early = json.loads(re.search(rb'id="early">(.*?)<', page)[1])
    head, text = page.partition(b"</head>")[0].decode(), page.decode()
    files = [*re.findall(r'rel="stylesheet" href="([^"]+)"', head), early["numbers"]]
    files += [next(name for name in re.findall(r'rel="modulepreload" href="([^"]+)"', head) if "tippe" in name)]
    assert len(files) >= 2
    assert not re.findall(r"<script[^>]* src=", text.partition('id="first"')[0])  # none blocks it
    sizes = {name: len(gzip.compress(urllib.request.urlopen(urljoin(url, name)).read(), 9)) for name in files}
    assert len(gzip.compress(page)) + sum(sizes.values()) <= MOST, sizes


@pytest.mark.served
@pytest.mark.parametrize("lost", ["arrival.gz", "static/tippe.js"])
def test_the_rest_comes_even_where_it_does_not(server, chromium, lost, page_errors):
    page_errors.allow(f"{LOST}|Failed to fetch|Bokeh|Panel")
    page = chromium.new_page()
    page.route(f"**/*{lost}*", lambda route: route.abort())
    page.route("**/bokeh.min.js*", lambda route: route.abort())
    with page.expect_request("**/bokeh.min.js*"):
        page.goto(f"{server}?")
    assert page.locator("#first").is_hidden()
    page.close()


@pytest.mark.served
def test_it_moves_before_bokeh_comes_and_the_session_takes_over_what_a_hand_made_of_it(server, chromium):
    page = chromium.new_page(viewport={"width": 1400, "height": 900}, reduced_motion="no-preference")
    order, held = [], []
    page.on("request", lambda request: order.append(("asked", request.resource_type, request.url)))
    page.on("requestfinished", lambda request: order.append(("came", request.resource_type, request.url)))
    page.route("**/bokeh.min.js*", lambda route: held.append(route))
    page.goto(f"{server}?", wait_until="commit")
    page.wait_for_function(f"{DRAWN} && {TIME} > 2")
    page.get_by_role("button", name="Pause").click()
    page.get_by_role("slider", name="Time").press("Home")
    page.get_by_text("Rubbing tips it up.").wait_for()
    canvas = page.locator("canvas[aria-label^='The top']").first.element_handle()
    page.evaluate("canvas => { window.before = canvas }", canvas)
    page.wait_for_function(f"{TOPS}[0].quaternion[1] == 0 && {TOPS}[0].quaternion[2] == 0")  # drawn, as it is let go
    drawn = f"(([top]) => [top.t, ...top.quaternion, ...top.eye])({TOPS})"
    pose = page.evaluate(drawn)
    page.locator("#lab-spin").press("ArrowRight")
    entry(page, "Friction").fill("0.1")
    assert held and page.evaluate("!window.Bokeh?.documents?.length")
    held[0].continue_()
    page.locator("#first").wait_for(state="detached")
    # the same picture at the same time, and what was set before is asked for now
    page.wait_for_function("location.search.includes('spin=28.8')")
    assert page.get_by_role("textbox", name="Spin, in turns a second").input_value() == "28.8"
    assert page.evaluate("before.isConnected")
    assert page.evaluate(drawn) == pytest.approx(pose, abs=2e-3)
    page.wait_for_function("Bokeh.documents.some((doc) => doc.is_idle)")
    bokeh_was_asked_for_last_and_all_is_light(page, order)
    expect(entry(page, "Friction")).to_be_focused()  # who typed types on
    page.keyboard.type("2")
    page.keyboard.press("Enter")
    page.wait_for_url("**mu_k=.12*")
    page.close()


def bokeh_was_asked_for_last_and_all_is_light(page, order):
    """And no font was; light is all that was fetched before the page is idle, compressed."""
    early = json.loads(page.locator("#early").inner_text())

    def place(step, name):
        return next(i for i, (what, _, url) in enumerate(order) if what == step and name in url)

    needed = max(place("came", name.split("?")[0].lstrip(".")) for name in (early["bundle"], early["numbers"]))
    assert min(place("asked", name) for name in ("bokeh.min.js", "panel.min.js")) > needed
    assert not [url for _, kind, url in order if kind == "font"]
    names = page.evaluate("performance.getEntriesByType('resource').map(({ name }) => name)")
    files = {page.url.split("?")[0], *(name for name in names if name.startswith("http"))}
    sizes = {name: len(gzip.compress(urllib.request.urlopen(name).read())) for name in files}
    assert {"panel.min.js", "katex.min.js"} <= {name.split("?")[0].split("/")[-1] for name in sizes}
    assert sum(sizes.values()) <= WHOLE, sizes
