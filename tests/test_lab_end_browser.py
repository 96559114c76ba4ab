"""The Lab in Chromium: the end of the time and of the page can be reached, and what is enlarged looks the same."""

import re

import numpy as np
import pytest
from lab_page import TIME, UNIT, arrival, come
from playwright.sync_api import expect

from app.model.arrival import ARRIVAL
from app.model.lab.run import whole_on

pytestmark = pytest.mark.served

END = 12.0  # s: of the arrival's life
NOW = f"{TIME} * {UNIT}"


@pytest.fixture
def page(server, chromium):
    with arrival(server, chromium, reduced_motion="no-preference") as page:
        yield page


def run_from_its_start(page):
    page.get_by_role("button", name="again").click()
    page.wait_for_function(f"{NOW} > 0.05 && {NOW} < {END} / 2")


def stays_at_its_end(page):
    """It pauses there; that it could go on would show within some frames of the screen."""
    page.get_by_role("button", name="Play", exact=True).wait_for()
    for _ in range(3):
        page.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
        assert page.evaluate(NOW) == pytest.approx(END, abs=0.01)
    assert page.locator(".clock").inner_text() == "12.00 s"


def test_the_key_end_goes_to_the_end_while_it_plays_and_stays_there(page):
    run_from_its_start(page)
    page.get_by_role("slider", name="Time").press("End")
    stays_at_its_end(page)
    page.get_by_role("button", name="Play", exact=True).click()  # from the start
    page.wait_for_function(f"{NOW} > 0.05 && {NOW} < {END} / 2")


def test_a_pointer_that_lets_go_beyond_the_edge_leaves_the_time_at_the_end(page):
    run_from_its_start(page)
    box = page.locator(".strip .plot").bounding_box()
    middle = box["y"] + box["height"] / 2
    page.mouse.move(box["x"] + 100, middle)
    page.mouse.down()
    for share in (0.5, 0.9, 1.02):
        page.mouse.move(box["x"] + share * box["width"], middle)
    page.wait_for_function(f"Math.abs({NOW} - {END}) < 0.01")
    page.mouse.up()
    stays_at_its_end(page)


# How each kind of line and area of the picture is painted.
PAINT = """() => {
    const all = (root) => [...root.querySelectorAll("*")].flatMap((e) => [e, ...e.shadowRoot ? all(e.shadowRoot) : []])
    const found = all(document).find((e) => e.matches(".answer .plot > svg"))
    return Object.fromEntries([...found.querySelectorAll("polyline, polygon, path, line, circle, text")].map((e) => {
        const {stroke, fill, strokeWidth, strokeDasharray, opacity, fontWeight} = getComputedStyle(e)
        const paint = [stroke, fill, strokeWidth, strokeDasharray, opacity, fontWeight].join()
        return [`${e.tagName} ${e.getAttribute("class") ?? ""}`, paint]
    }))
}"""


@pytest.mark.parametrize("tab", ["Energy", "Spin", "Path"])
def test_a_picture_that_is_enlarged_is_painted_as_before(page, tab):
    page.locator(".answer").get_by_role("tab", name=tab).click()
    small, plot = page.evaluate(PAINT), page.locator(".answer .plot")
    height = plot.bounding_box()["height"]
    page.get_by_role("button", name="Large, over the whole window").click()
    close = page.get_by_role("button", name="Small again")
    expect(close).to_be_focused()
    expect(close).to_have_text("×")
    assert plot.bounding_box()["height"] > 1.5 * height
    large = page.evaluate(PAINT)
    assert large and all(paint == small.get(kind, paint) for kind, paint in large.items())
    assert small.keys() <= large.keys()
    close.click()
    expect(page.get_by_role("button", name="Large, over the whole window")).to_be_focused()
    assert page.evaluate(PAINT) == small


def test_what_is_kept_is_counted_to_the_play_head(page):
    """Jellett's constant is nearly kept while the top turns over, and lost at the end of its life."""
    page.get_by_role("radio", name="All three").click()
    page.locator(".lab[data-table=three][data-whole]").wait_for()
    motion, time = whole_on(*ARRIVAL), page.get_by_role("slider", name="Time")
    jellett = motion.trajectory.jellett / motion.start.top.I1
    cell = page.locator(".keeps tbody tr").first.get_by_role("cell")
    time.press("End")
    page.get_by_role("button", name="Play", exact=True).wait_for()
    for t, energy, word in ((1.3, "lost as heat", "nearly kept"), (END, "lost as heat", "lost")):
        time.evaluate("(bar, t) => { bar.value = t; bar.dispatchEvent(new Event('input')) }", t)
        page.get_by_text(f"from 0 s to {t:.2f} s", exact=True).wait_for()
        assert cell.nth(0).inner_text().startswith(energy)
        said, first, last = re.fullmatch(r"([a-z ]+?)\s*([\d.]+) → ([\d.]+)", cell.nth(1).inner_text()).groups()
        assert said == word and float(first) == pytest.approx(jellett[0], abs=0.005)
        assert float(last) == pytest.approx(np.interp(t, motion.seconds, jellett), abs=0.01)


@pytest.mark.parametrize("ghost", [False, True])
def test_on_a_phone_the_last_fold_can_be_pressed(chromium, server, ghost):
    """Nothing lies over it at the end of the page, whatever the height of the controls at its foot."""
    phone = chromium.new_context(viewport={"width": 390, "height": 844}, is_mobile=True, has_touch=True)
    page = phone.new_page()
    come(page, f"{server}?")
    page.locator(".main-content").wait_for()
    if ghost:
        page.get_by_role("slider", name="Spin").press("ArrowLeft")
        page.locator(".chip").wait_for()
    for fold in ("Top: stem, ballast", "Numbers"):
        page.locator(".main-content").evaluate("page => page.scrollTo(0, page.scrollHeight)")
        summary = page.locator("summary", has_text=fold)
        summary.tap()
        expect(summary.locator("..")).to_have_attribute("open", "")
    page.locator(".main-content").evaluate("page => page.scrollTo(0, page.scrollHeight)")
    row, dock = page.locator(".numbers tr").last, page.locator(".dock")
    assert row.bounding_box()["y"] + row.bounding_box()["height"] <= dock.bounding_box()["y"] + 1
    phone.close()
