"""The Lab alone in Chromium: hands on its bar, its fields, its axis and its pictures, and how it looks."""

import re

import numpy as np
import pytest
from axe import contrast, violations
from components import *  # noqa: F403
from lab_page import TIME, TOPS, UNIT, entry, line, pause, put
from PIL import Image
from playwright.sync_api import expect

from app.model.arrival import ARRIVAL
from app.model.run import whole_on
from app.model.setup import start_of
from app.share.parts import Photo

pytestmark = pytest.mark.served

END = 12.0  # s: of the arrival's life
NOW = f"{TIME} * {UNIT}"
SEEK = "(bar, t) => { bar.value = t; bar.dispatchEvent(new Event('input')) }"
LOOK = "look => { __tippe.wear(look); window.dispatchEvent(new CustomEvent('tippe:look')) }"
PHONE = {"viewport": {"width": 390, "height": 844}, "is_mobile": True, "has_touch": True}


def slid(page, name, value):
    """Moves a slider."""
    page.locator(f"#lab-{name}").evaluate(SEEK, value)


def middle(part):
    box = part.bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def test_fields_ask_and_show_what_was_before_and_what_is_typed_stays(lab):
    found = lab()
    the_run_before_stays_pale_until_it_is_dismissed(found)
    what_is_typed_or_selected_stays_while_answers_come(found)
    a_slider_asks_at_every_move_and_spin_it_is_the_stronger_the_longer_it_is_held(found)


def the_run_before_stays_pale_until_it_is_dismissed(found):
    page = found.page
    put(page, "Spin, in turns a second", 22)
    page.get_by_text("Spin: 28.6 rev/s → 22.0 rev/s").wait_for()
    page.get_by_text("Before: Spin 28.6 rev/s").wait_for()
    for picture in (".strip", ".answer"):
        expect(page.locator(f"{picture} .then")).to_have_count(1)
    page.get_by_role("button", name="Go back to before").click()
    found.until(lambda: round(found.lab.explorer.spin, 1) == 28.6)
    expect(page.locator(".strip .then")).to_have_count(0)
    put(page, "Spin, in turns a second", 30)
    page.get_by_role("button", name="Forget the run before").click()
    page.get_by_text("Before: Spin").wait_for(state="hidden")
    expect(page.locator(".strip .then")).to_have_count(0)


def what_is_typed_or_selected_stays_while_answers_come(found):
    """What is typed next would otherwise be appended to what was selected."""
    page, tilt = found.page, entry(found.page, "Tilt, in degrees")
    tilt.fill("7,2")
    slid(page, "spin", 29)
    page.get_by_text("→ 29.0 rev/s").first.wait_for()
    assert found.lab.explorer.spin == 29 and tilt.input_value() == "7,2"
    put(page, "Tilt, in degrees", "half")
    alert = page.get_by_role("alert").filter(has_text="half")
    alert.filter(has_text="half is not a number").wait_for()
    tilt.select_text()
    slid(page, "spin", 29.5)
    page.get_by_text("→ 29.5 rev/s").first.wait_for()
    assert tilt.evaluate("(field) => field.value.slice(field.selectionStart, field.selectionEnd)") == tilt.input_value()
    page.keyboard.insert_text("5,73")
    tilt.press("Enter")
    alert.wait_for(state="hidden")
    assert tilt.input_value() == "5.7"


def a_slider_asks_at_every_move_and_spin_it_is_the_stronger_the_longer_it_is_held(found):
    page, spin = found.page, entry(found.page, "Spin, in turns a second")
    put(page, "Spin, in turns a second", 30)
    found.until(lambda: found.lab.explorer.spin == 30)
    before, slider = line(page), page.locator("#lab-spin")
    for _ in range(12):
        slider.press("ArrowLeft")
    assert spin.input_value() == "28.8"
    found.until(lambda: found.lab.explorer.spin == 28.8)
    page.wait_for_function("([line, before]) => line.getAttribute('points') != before",
                           arg=[page.locator(".strip .rest").first.element_handle(), before])  # fmt: skip
    page.get_by_role("button", name="Spin it").hover()
    page.mouse.down()
    page.get_by_role("button", name=re.compile(r"(3[2-9]|4.) rev")).wait_for()
    page.mouse.up()
    found.until(lambda: 31.5 <= found.lab.explorer.spin <= 50)
    page.get_by_role("button", name="Pause").wait_for()


def test_the_axis_is_pulled_after_a_rest_and_let_go_with_the_hand(lab):
    found = lab()
    page, start = found.page, found.lab.explorer
    page.get_by_role("slider", name="Time").press("Home")
    handle, field = page.get_by_role("slider", name="Tilt of the axis at the start"), entry(page, "Tilt, in degrees")
    page.wait_for_function(f"{TOPS}[0].quaternion[1] == 0 && {TOPS}[0].quaternion[2] == 0")
    x, y = middle(handle)
    page.mouse.move(x, y)
    page.mouse.down()
    page.wait_for_timeout(500)  # the rest itself
    page.mouse.move(x - 60, y + 40)
    found.until(lambda: start.tilt > 10)
    pulled = start.tilt
    expect(field).to_have_value(f"{pulled:.1f}")
    for across, down in ((90, 60), (-60, 30)):  # beyond the vertical, in every direction, the axis stays at the hand
        page.mouse.move(x + across, y + down)
        page.wait_for_function(
            """([handle, x, y]) => {
            const { left, top, width, height } = handle.getBoundingClientRect()
            return Math.hypot(left + width / 2 - x, top + height / 2 - y) < 2 && handle.dataset.wording.endsWith("°")
        }""",
            arg=[handle.element_handle(), x + across, y + down],
        )
        assert start.tilt > 10
    page.mouse.move(x - 60, y + 40)
    found.until(lambda: abs(start.tilt - pulled) < 0.5)
    pulled = start.tilt
    page.mouse.up()
    page.get_by_role("button", name="Pause").wait_for()
    pause(page)
    page.get_by_role("slider", name="Time").press("Home")
    handle.press("ArrowRight")
    found.until(lambda: start.tilt != pulled)


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


def test_its_life_goes_faster_where_nothing_happens_and_stays_at_its_end_however_it_got_there(lab):
    page = lab(reduced_motion="no-preference").page
    time, speed = page.get_by_role("slider", name="Time"), page.get_by_role("combobox", name="Speed")
    assert float(time.get_attribute("max")) == pytest.approx(END, abs=0.02)
    speeds = set()
    stages = (2.2, "It stands on its stem"), (6.0, "It comes off its stem"), (11.5, "The table grips it: it rolls.")
    for t, said in stages:
        time.evaluate(SEEK, t)
        page.get_by_text(said).first.wait_for()
        speeds.add(speed.evaluate("list => list.selectedOptions[0].text"))
    page.get_by_text("now real speed").wait_for()
    assert "as fits · real speed" in speeds
    stays_at_its_end(page)
    run_from_its_start(page)
    time.press("End")  # a key, while it plays
    stays_at_its_end(page)
    page.get_by_role("button", name="Play", exact=True).click()  # from the start
    page.wait_for_function(f"{NOW} > 0.05 && {NOW} < {END} / 2")
    box, (_, y) = page.locator(".strip .plot").bounding_box(), middle(page.locator(".strip .plot"))
    page.mouse.move(box["x"] + 100, y)
    page.mouse.down()
    for share in (0.5, 0.9, 1.02):  # lets go beyond the edge
        page.mouse.move(box["x"] + share * box["width"], y)
    page.wait_for_function(f"Math.abs({NOW} - {END}) < 0.01")
    page.mouse.up()
    stays_at_its_end(page)


# How each kind of line and area of the picture is painted.
PAINT = """plot => Object.fromEntries(
    [...plot.querySelectorAll(":scope > svg :is(polyline, polygon, path, line, circle, text)")].map((e) => {
        const {stroke, fill, strokeWidth, strokeDasharray, opacity, fontWeight} = getComputedStyle(e)
        const paint = [stroke, fill, strokeWidth, strokeDasharray, opacity, fontWeight].join()
        return [`${e.tagName} ${e.getAttribute("class") ?? ""}`, paint]
    }))"""
# Whether the words of the height stand in its area, in the colour of the ground.
IN_ITS_AREA = """(answer) => {
    const word = answer.querySelector(".word.inside"), area = answer.querySelector(".lifts")
    if (!word || !area) return false
    const [inner, outer] = [word, area].map((part) => part.getBoundingClientRect())
    return getComputedStyle(word).fill === getComputedStyle(word.closest(".frame")).backgroundColor
        && outer.top < inner.top && inner.bottom < outer.bottom
}"""


def test_its_bar_is_dragged_and_moved_by_keys_and_a_picture_is_enlarged(lab):
    page = lab().page
    the_bar_is_dragged_from_a_rest_and_moved_by_keys(page)
    a_picture_that_is_enlarged_is_painted_as_before_and_has_numbers_at_the_pointer(page)


def the_bar_is_dragged_from_a_rest_and_moved_by_keys(page):
    time, head = page.get_by_role("slider", name="Time"), page.locator(".strip .head")
    before, (x, y) = head.bounding_box(), middle(head)
    page.mouse.move(x, y)
    page.mouse.down()
    page.wait_for_timeout(500)  # the rest itself
    page.mouse.move(x + 80, y - 30)
    page.mouse.move(x + 200, y - 60)
    assert head.bounding_box()["x"] - before["x"] == pytest.approx(200, abs=2)
    page.mouse.up()
    ends = page.locator(".strip .axis").first.bounding_box()
    expected = float(time.get_attribute("max")) * (x + 200 - ends["x"]) / ends["width"]
    page.wait_for_function(f"t => Math.abs({NOW} - t) < 0.02", arg=expected)
    time.press("Home")
    page.wait_for_function(f"{TIME} == 0")
    expect(time).to_have_attribute("aria-valuetext", re.compile("^0.00 s, tilt 6 degrees"))
    time.press("ArrowRight")
    page.wait_for_function(f"{TIME} > 0")


def a_picture_that_is_enlarged_is_painted_as_before_and_has_numbers_at_the_pointer(page):
    plot, larger = page.locator(".answer .plot"), page.get_by_role("button", name="Large, over the whole window")
    page.locator("summary", has_text="Numbers").click()
    page.get_by_role("slider", name="Time").press("Home")
    page.get_by_role("row", name="tilt 5.7°").wait_for()
    for tab in ("Track", "Spin", "Energy"):
        page.locator(".answer").get_by_role("tab", name=tab).click()
        small, height = plot.evaluate(PAINT), plot.bounding_box()["height"]
        larger.click()
        close = page.get_by_role("button", name="Small again")
        expect(close).to_be_focused()
        expect(close).to_have_text("×")
        assert plot.bounding_box()["height"] > 1.5 * height, tab
        large = plot.evaluate(PAINT)
        assert small.keys() <= large.keys() and all(paint == small.get(kind, paint) for kind, paint in large.items())
        if tab == "Energy":
            page.get_by_role("dialog").get_by_role("heading", name="Where does the height come from?").wait_for()
            page.mouse.move(*middle(plot))
            page.locator(".readout", has_text="turned into heat").wait_for()
        close.click()
        expect(larger).to_be_focused()
        assert plot.evaluate(PAINT) == small, tab


def test_the_height_is_read_on_its_own_area_where_the_energy_leaves_no_room_over_it(lab):
    page = lab({"spin": 4}).page
    for look in ("light", "dark"):
        page.evaluate(LOOK, look)
        page.wait_for_function(IN_ITS_AREA, arg=page.locator(".answer").element_handle())


def test_three_tops_have_one_clock_what_they_keep_is_counted_to_it_and_a_photo_has_them_all(lab):
    """Jellett's constant is nearly kept while the top turns over, and lost at the end of its life."""
    found = lab({"table": "three"}, draws=True)
    page = found.show(Photo())
    page.wait_for_function(f"{TOPS}.filter((top) => top.count && top.pictures).length == 3")
    motion, time = whole_on("ordinary", start_of(*ARRIVAL[1:])), page.get_by_role("slider", name="Time")
    jellett = motion.trajectory.jellett / motion.start.top.I1
    cell = page.locator(".keeps tbody tr").first.get_by_role("cell")
    assert page.locator(".keeps").get_by_role("row").count() == 4
    for t, word in ((1.3, "nearly kept"), (END, "lost")):
        time.evaluate(SEEK, t)
        page.get_by_text(f"from 0 s to {t:.2f} s", exact=True).wait_for()
        assert cell.nth(0).inner_text().startswith("lost as heat")
        pattern = r"([a-z ]+?):?\s*([\d.]+) → ([\d.]+)(?s:.*)"
        said, first, last = re.fullmatch(pattern, cell.nth(1).inner_text()).groups()
        assert said == word and float(first) == pytest.approx(jellett[0], abs=0.005)
        assert float(last) == pytest.approx(np.interp(t, motion.seconds, jellett), abs=0.01)
    page.wait_for_function(f"new Set({TOPS}.filter((top) => top.count).map((top) => top.t.toFixed(3))).size == 1")
    page.evaluate(WRITTEN)
    with page.expect_download() as download:
        page.get_by_role("button", name="PNG", exact=True).click()
    written = re.fullmatch(r"t = ([\d.]+) s, θ = (\d+)° / (\d+)° / (\d+)°", page.evaluate("written").pop())
    seconds, *tilts = map(float, written.groups())
    runs = [whole_on(table, start_of(*ARRIVAL[1:])) for table in ("ordinary", "rough", "ice")]
    assert seconds == pytest.approx(END, abs=0.006)
    assert tilts == pytest.approx([np.interp(END, run.seconds, run.tilt) for run in runs], abs=1)
    picture = Image.open(download.value.path()).convert("RGB")
    assert picture.width == pytest.approx(2400, abs=9) and picture.height < picture.width / 2
    for third in range(3):
        part = picture.crop((third * 800, 0, third * 800 + 800, picture.height))
        assert len(part.resize((80, 80)).getcolors(10_000)) > 300, third  # a top


# Notes all words that are written on a canvas.
WRITTEN = """() => {
  window.written = []
  const pen = CanvasRenderingContext2D.prototype, write = pen.fillText
  pen.fillText = function (words, ...place) { written.push(words); write.call(this, words, ...place) }
}"""


def test_a_finger_that_scrolls_the_page_leaves_the_view_of_the_top(lab):
    found = lab(**PHONE)
    page, (_, y) = found.page, middle(found.page.locator(".stage"))
    touch = page.context.new_cdp_session(page)
    for kind, up in (("touchStart", 0), *(("touchMove", 8 * i) for i in range(1, 13)), ("touchEnd", None)):
        points = [] if up is None else [{"x": 30, "y": y - up}]
        touch.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
    page.wait_for_function("document.querySelector('main').scrollTop > 20")
    assert "camera" not in {name for _, name, _ in found.told}


def test_axe_finds_nothing(lab):
    page = lab().page
    assert not page.evaluate(f"{TOPS}[0].playing")  # it does not start by itself
    for table in ("Ordinary", "All three"):
        page.get_by_role("radio", name=table).click()
        page.locator(f".lab[data-table={'three' if ' ' in table else 'ordinary'}]").wait_for()
        assert violations(page) == [], table
    page.evaluate(LOOK, "dark")
    assert contrast(page) == []
    page.get_by_role("button", name="Spin all three").click()
    page.wait_for_function(f"{TOPS}.some((top) => top.playing && top.t > 0)")
