"""How the page looks and adapts, in Chromium: the system's dark look, the language, and the wheel."""

import re

import pytest
from visiting import WHOLE

from app.text import say

pytestmark = pytest.mark.served

LOOKS = "name => document.documentElement.dataset.look === name"
HIGHER = "([part, before]) => part.getBoundingClientRect().top < before"


def test_a_page_takes_the_systems_look_writes_german_numbers_and_scrolls_with_the_wheel(chromium, server):
    context = chromium.new_context(
        viewport={"width": 1400, "height": 900}, color_scheme="dark", reduced_motion="reduce"
    )
    page = context.new_page()
    page.goto(f"{server}?v=1&tab=roll&lang=de")
    page.wait_for_function(WHOLE)  # otherwise there is nothing to scroll
    page.wait_for_function("() => window.__tippe?.top3d?.count > 0")
    the_wheel(page)
    decimal_commas(page)
    its_look(page)
    context.close()


def the_wheel(page):
    """Over the top it scrolls the page, and with Ctrl it zooms."""
    top = page.locator("canvas[aria-label^='Der Kreisel']").first
    top.click()  # also after a click, which does not turn it
    slider = page.get_by_role("slider", name="Jellett-Konstante").element_handle()
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


TICKS = """ticks => {
  const [ours] = [...Bokeh.documents[0].all_models].filter(({ type }) => type === "CustomJSTickFormatter")
  const theirs = new (Bokeh.Models.get("BasicTickFormatter"))()
  return [ours, theirs].map(each => each.doFormat(ticks, { loc: 0 }))
}"""


def decimal_commas(page):
    """On axes, in fields, and in 3-D."""
    page.locator(".clock").filter(has_text=re.compile(r"^\d+,\d\d s$")).wait_for()
    field = page.get_by_role("textbox", name="Jellett-Konstante, in Wurzel g durch R")
    field.fill("6,5")
    field.press("Enter")
    page.wait_for_function("() => /KJ=6\\.5/.test(location.search)")
    page.get_by_role("radio", name=say("research.panels.time", "de")).click()
    page.locator("[data-figure=times-theta]").wait_for()
    for given in ([-0.5, 0.1 + 0.2, 1], [0, 0.5, 1], [-2e-7, -1e-7, 0], [0, 50000, 100000], [1.0001, 1.0002], []):
        ours, theirs = page.evaluate(TICKS, given)
        assert ours == [each.replace(".", ",") for each in theirs], given
    assert page.evaluate(TICKS, [-0.5, 0.1 + 0.2, 1])[0] == ["−0,5", "0,3", "1"]
    assert page.evaluate(TICKS, [-2.5e-7, -1e-7])[0] == ["−2,500e−7", "−1,000e−7"]


def its_look(page):
    """It is dark where the system is, until a person chooses."""
    page.wait_for_function(LOOKS, arg="dark")
    page.get_by_role("button", name="Mehr", exact=True).click()
    box = page.get_by_label("dunkel", exact=True)
    assert box.is_checked() and "dark" not in page.url
    for look in ("light", "dark"):
        page.emulate_media(color_scheme=look)
        page.wait_for_function(LOOKS, arg=look)
    box.click()
    page.wait_for_function(LOOKS, arg="light")
    page.wait_for_function("() => location.search.includes('dark=no')")
    assert not box.is_checked()
