"""How the page looks and adapts, in Chromium: the system's dark look, the language, the wheel, and dragging."""

import re

import pytest
from visiting import WHOLE

pytestmark = pytest.mark.served

LOOKS = "name => document.documentElement.dataset.look === name"
TOP = "canvas[aria-label^='The top'], canvas[aria-label^='Der Kreisel']"
# The chosen camera views of all tops on the page.
VIEWS = """() => [...Bokeh.documents[0]._all_models.values()].map((m) => m.data?.attributes?.camera)
    .filter((view) => view?.length)"""
HIGHER = "([part, before]) => part.getBoundingClientRect().top < before"


@pytest.fixture
def opened(chromium, server):
    """Opens an address in a browser context like this one."""
    contexts = []

    def open_(search="", **like):
        contexts.append(chromium.new_context(**{"viewport": {"width": 1400, "height": 900}} | like))
        page = contexts[-1].new_page()
        page.goto(server + search)
        return page

    yield open_
    for context in contexts:
        context.close()


def test_the_page_is_dark_where_the_system_is_until_a_person_chooses(opened):
    page = opened("?v=1&tab=roll", color_scheme="dark")
    page.wait_for_function(LOOKS, arg="dark")
    page.get_by_role("button", name="More", exact=True).click()
    box = page.get_by_label("dark", exact=True)
    assert box.is_checked() and "dark" not in page.url
    page.emulate_media(color_scheme="light")
    page.wait_for_function(LOOKS, arg="light")
    page.emulate_media(color_scheme="dark")
    page.wait_for_function(LOOKS, arg="dark")
    box.click()
    page.wait_for_function(LOOKS, arg="light")
    page.wait_for_function("() => location.search.includes('dark=no')")
    assert not box.is_checked()


def test_a_german_page_writes_decimal_commas_on_axes_in_fields_and_in_3d(opened):
    page = opened("?v=1&tab=roll&lang=de")
    page.locator(TOP).first.wait_for()
    field = page.locator("input[type=text][aria-label^='Schwerpunkt'], input[type=text]").first
    page.wait_for_function("() => window.__tippe?.top3d?.count > 0")
    said = page.locator(".time").first
    said.filter(has_text=re.compile(r"^\d,\d{4} s")).wait_for()
    field.fill("6,5")
    field.press("Enter")
    page.wait_for_function("() => /KJ=6\\.5/.test(location.search)")
    ticks = """ticks => {
      const [ours] = [...Bokeh.documents[0].all_models].filter(({ type }) => type === "CustomJSTickFormatter")
      const theirs = new (Bokeh.Models.get("BasicTickFormatter"))()
      return [ours, theirs].map(each => each.doFormat(ticks, { loc: 0 }))
    }"""
    for given in ([-0.5, 0.1 + 0.2, 1], [0, 0.5, 1], [-2e-7, -1e-7, 0], [0, 50000, 100000], [1.0001, 1.0002], []):
        ours, theirs = page.evaluate(ticks, given)
        assert ours == [each.replace(".", ",") for each in theirs], given
    assert page.evaluate(ticks, [-0.5, 0.1 + 0.2, 1])[0] == ["−0,5", "0,3", "1"]
    assert page.evaluate(ticks, [-2.5e-7, -1e-7])[0] == ["−2,500e−7", "−1,000e−7"]


def test_the_wheel_over_the_top_scrolls_the_page_and_with_ctrl_zooms(opened):
    page = opened("?v=1&tab=roll")
    page.wait_for_function(WHOLE)  # otherwise there is nothing to scroll
    top, slider = page.locator(TOP).first, page.get_by_role("slider", name="Jellett’s constant").element_handle()
    top.click()  # also after a click, which does not turn it
    assert page.evaluate(VIEWS) == []
    box, before = top.bounding_box(), slider.bounding_box()["y"]
    page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    page.mouse.wheel(0, 100)
    page.wait_for_function(HIGHER, arg=[slider, before])
    assert top.bounding_box()["y"] > 0  # it stays in sight
    assert "view=" not in page.url
    page.keyboard.down("Control")
    page.mouse.wheel(0, 100)
    page.keyboard.up("Control")
    page.wait_for_function("() => location.search.includes('view=')")
    assert len(page.evaluate(VIEWS)) == 1


# Whether the words of the height stand in its area, in the colour of the ground; all read at once, for the bar is drawn
# anew when the rest of the life is there.
IN_ITS_AREA = """(answer) => {
    const word = answer.querySelector(".word.inside"), area = answer.querySelector(".lifts")
    if (!word || !area) return false
    const [inner, outer] = [word, area].map((part) => part.getBoundingClientRect())
    return getComputedStyle(word).fill === getComputedStyle(word.closest(".frame")).backgroundColor
        && outer.top < inner.top && inner.bottom < outer.bottom
}"""


def test_the_height_is_read_on_its_own_area_where_the_energy_leaves_no_room_over_it(opened):
    for look in ("light", "dark"):
        page = opened("?v=2&tab=lab&level=explore&by=hand&spin=4&tilt=5.7", color_scheme=look)
        page.locator(".answer .lifts").wait_for()
        page.wait_for_function(IN_ITS_AREA, arg=page.locator(".answer").element_handle())
