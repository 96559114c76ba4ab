"""Moving, typing and dragging in the Lab, in Chromium."""

import re
from urllib.parse import parse_qs, urlsplit

import pytest
from lab_page import TIME, TOPS, UNIT, arrival, entry, line, pause, put
from playwright.sync_api import expect

pytestmark = pytest.mark.served


@pytest.fixture
def page(server, chromium):
    with arrival(server, chromium) as page:
        yield page


def test_the_head_of_the_bar_is_dragged_from_a_rest(page):
    pause(page)
    box = page.locator(".strip .head").bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.wait_for_timeout(500)  # the rest itself
    page.mouse.move(x + 80, y - 30)
    page.mouse.move(x + 200, y - 60)
    moved = page.locator(".strip .head").bounding_box()
    assert moved["x"] - box["x"] == pytest.approx(200, abs=2)
    page.mouse.up()
    ends = page.locator(".strip .axis").first.bounding_box()
    end = float(page.get_by_role("slider", name="Time").get_attribute("max"))
    expected = end * (x + 200 - ends["x"]) / ends["width"]
    page.wait_for_function(f"t => Math.abs({TIME} * {UNIT} - t) < 0.02", arg=expected)


def test_the_bar_is_moved_by_keys(page):
    slider = page.get_by_role("slider", name="Time")
    slider.press("Home")
    page.wait_for_function(f"{TIME} == 0")
    expect(slider).to_have_attribute("aria-valuetext", re.compile("^0.00 s, tilt 6 degrees"))
    slider.press("ArrowRight")
    page.wait_for_function(f"{TIME} > 0")


def test_what_is_selected_to_be_typed_over_stays_selected_while_answers_come(page):
    """Otherwise what is typed next would be appended to it."""
    put(page, "Tilt, in degrees", "half")
    page.get_by_role("alert").filter(has_text="half is not a number").wait_for()
    tilt = entry(page, "Tilt, in degrees")
    tilt.select_text()
    page.locator("#lab-spin").evaluate("""(slider) => {
        slider.value = 29.5
        slider.dispatchEvent(new Event("input"))
    }""")
    page.wait_for_function("location.search.includes('spin=29.5')")
    assert tilt.evaluate("(field) => field.value.slice(field.selectionStart, field.selectionEnd)") == tilt.input_value()
    page.keyboard.insert_text("5,73")
    tilt.press("Enter")
    page.get_by_role("alert").filter(has_text="half").wait_for(state="hidden")
    assert tilt.input_value() == "5.7"


def test_what_is_typed_is_not_written_over_while_answers_come(page):
    tilt = entry(page, "Tilt, in degrees")
    tilt.fill("7,2")
    page.locator("#lab-spin").evaluate("""(slider) => {
        slider.value = 29
        slider.dispatchEvent(new Event("input"))
    }""")
    page.wait_for_function("location.search.includes('spin=29')")
    assert tilt.input_value() == "7,2"
    page.get_by_text("→ 29.0 rev/s").first.wait_for()


def test_the_axis_is_pulled_after_a_rest_and_let_go_with_the_hand(page):
    pause(page)
    page.get_by_role("slider", name="Time").press("Home")
    handle = page.get_by_role("slider", name="Tilt of the axis at the start")
    page.wait_for_function(f"{TOPS}[0].quaternion[1] == 0 && {TOPS}[0].quaternion[2] == 0")
    box = handle.bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.wait_for_timeout(500)  # the rest itself
    page.mouse.move(x - 60, y + 40, steps=3)
    page.wait_for_function("location.search.includes('tilt=')")
    pulled = float(parse_qs(urlsplit(page.url).query)["tilt"][0])
    assert pulled > 10
    assert float(entry(page, "Tilt, in degrees").input_value()) == pytest.approx(pulled, abs=0.06)
    page.mouse.move(x + 90, y + 60, steps=3)  # beyond the vertical
    page.wait_for_function("new URLSearchParams(location.search).get('tilt') == '0'")
    page.mouse.move(x - 60, y + 40, steps=3)
    page.wait_for_function(f"location.search.includes('tilt={pulled:g}')")
    page.mouse.up()
    page.get_by_role("button", name="Pause").wait_for()
    pause(page)
    page.get_by_role("slider", name="Time").press("Home")
    handle.press("ArrowRight")
    page.wait_for_function(f"!location.search.includes('tilt={pulled:g}')")


def test_spin_it_is_the_stronger_the_longer_it_is_held(page):
    page.get_by_role("button", name="Spin it").hover()
    page.mouse.down()
    page.get_by_role("button", name="50 rev/s").wait_for()
    page.mouse.up()
    page.wait_for_function("location.search.includes('spin=50')")
    page.get_by_role("button", name="Pause").wait_for()


def test_a_slider_asks_at_every_move_and_the_newest_is_shown(page):
    put(page, "Spin, in turns a second", 30)
    page.wait_for_function("location.search.includes('spin=30')")
    before = line(page)
    slider = page.locator("#lab-spin")
    for _ in range(12):
        slider.press("ArrowLeft")
    assert entry(page, "Spin, in turns a second").input_value() == "28.8"
    page.wait_for_function("!location.search.includes('spin=30') && location.search.includes('spin=28.8')")
    assert line(page) != before
