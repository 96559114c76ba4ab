"""The tab Maps in Chromium: the map appears, a click and a drag lead to runs, impossible requests change nothing."""

import re

import pytest
from axe import LARGE, check
from playwright.sync_api import expect
from visiting import IN_SIGHT, PIXEL, Visit, go_to, wait

from app.text import listed

pytestmark = pytest.mark.served

MAP = "Bokeh.documents.flatMap((doc) => [...doc.all_models]).find((m) => m.name == 'maps' && m.renderers)"
SIDE = f"() => ({MAP})?.renderers[1].data_source.data.image[0]?.shape?.[0] ?? 0"  # cells along a side
BEAD = f"() => {{ const {{x, y}} = ({MAP}).renderers.at(-1).data_source.data; return [x[0], y[0]] }}"
RANGE = f"() => {{ const {{x_range: x, y_range: y}} = {MAP}; return [x.start, x.end, y.start, y.end] }}"


def come(context, server):
    """The page with a map of 9 cells a side."""
    page = context.new_page()
    Visit(page, f"{server}?v=1&tab=maps&map=spin_5_50_tilt_1_40_contensou_10_6_9", whole=False)
    page.get_by_role("status").filter(has_text="28.6 rev/s, 5.7").wait_for()
    page.wait_for_function(f"() => ({SIDE})() == 9")
    page.get_by_role("button", name="Stop").and_(page.locator("[aria-disabled=true]")).wait_for()
    return page


def enter(page, label, text):
    entry = page.get_by_label(label, exact=True)
    entry.fill(text)
    entry.press("Enter")


def pull(page, *places):
    """Drags from the first of these places of the map to the last."""
    pixels = page.evaluate(f"places => places.map(([x, y]) => ({PIXEL})(['maps', x, y]))", places)
    page.mouse.move(*pixels[0])
    page.mouse.down()
    for pixel in pixels[1:]:
        page.mouse.move(*pixel)
    page.mouse.up()


def a_click_on_a_cell_shows_its_run_and_the_top_at_its_start(page):
    """Also after the run before has been played."""
    pill, play = page.locator(".film .pill"), page.locator(".film > button")
    for tilt in (25, 6):
        page.mouse.click(*page.evaluate(PIXEL, ["maps", 44.0, tilt]))
        middle = 1 + 39 * (int((tilt - 1) / 39 * 9) + 0.5) / 9  # of its cell
        page.wait_for_function(f"y => {{ const at = ({BEAD})(); return at[0] == 42.5 && Math.abs(at[1] - y) < 1e-9 }}",
                               arg=middle)  # fmt: skip
        page.get_by_text(f"0.00 s · {middle:.0f}°", exact=True).wait_for()
        page.wait_for_function("""middle => {
          const [x, y] = __tippe.tops("map")[0].quaternion
          return Math.abs(180 / Math.PI * Math.acos(1 - 2 * (x * x + y * y)) - middle) < 1e-3
        }""", arg=middle)  # fmt: skip
        play.click()
        page.wait_for_function("__tippe.time('map') > 0.05")
        play.click()
        wait(page, lambda: not pill.inner_text().startswith("0.00 s"))
    page.get_by_role("status").filter(has_text="stands on its stem").wait_for()


def the_bead_is_dragged(page):
    x, y = page.evaluate(BEAD)
    pull(page, [x, y], [x - 11, y + 3], [x - 22, y + 6], [x - 36, y + 10])
    page.get_by_role("status").filter(has_text=re.compile(r"^\W*6\.\d+ rev/s, 17")).wait_for()
    expect(page.get_by_label("The run at, Across", exact=True)).to_have_value(re.compile(r"^6\."))


def what_cannot_be_is_said_and_the_map_stays(page):
    enter(page, "Across, to", "3")
    page.get_by_role("alert").filter(has_text="spin_from = 5").wait_for()
    assert page.evaluate(SIDE) == 9
    enter(page, "Across, to", "50")
    page.get_by_role("alert").filter(has_text="spin_from").wait_for(state="detached")


def a_term_is_explained_where_the_mouse_rests(page):
    word = page.get_by_text(re.compile(r"\bnudge\b")).locator("visible=true").first
    word.scroll_into_view_if_needed()
    box = page.locator(".tippe-readout:visible", has_text=listed("glossary.terms.nudge.is", "en"))
    page.mouse.move(*word.evaluate("""part => {
        const node = [...part.childNodes].find((each) => each.nodeType === 3 && each.data.includes("nudge"))
        const range = document.createRange(), at = node.data.indexOf("nudge")
        range.setStart(node, at), range.setEnd(node, at + 5)
        const { x, y, width, height } = range.getBoundingClientRect()
        return [x + width / 2, y + height / 2]
    }"""))  # fmt: skip
    box.wait_for()
    page.mouse.move(0, 0)
    box.wait_for(state="detached")


def a_box_looks_closer_and_undo_goes_back(page):
    before = page.evaluate(RANGE)
    enter(page, "The run at, Across", "45")
    wait(page, lambda: abs(page.evaluate(BEAD)[0] - 45) < 1e-9)
    page.locator("[data-figure=maps]").evaluate(IN_SIGHT)
    pull(page, [15.0, 10.0], [18.0, 14.0], [21.0, 20.0], [25.0, 30.0])
    wait(page, lambda: page.evaluate(RANGE) == pytest.approx([15, 25, 10, 30], abs=0.5))
    page.get_by_role("button", name="Undo").locator("visible=true").first.click()
    wait(page, lambda: page.evaluate(RANGE) == before)


def test_a_map_is_read_by_hand_and_looked_at_closely(server, chromium):
    with chromium.new_context(viewport={"width": 1400, "height": 1000}, reduced_motion="reduce") as context:
        page = come(context, server)
        a_click_on_a_cell_shows_its_run_and_the_top_at_its_start(page)
        the_bead_is_dragged(page)
        what_cannot_be_is_said_and_the_map_stays(page)
        a_term_is_explained_where_the_mouse_rests(page)
        a_box_looks_closer_and_undo_goes_back(page)
        check(page, "maps", LARGE)
        go_to(page, "Families")
        page.get_by_role("button", name="Compute the map").wait_for()
        check(page, "families", LARGE)


def swipe(page, start, by, steps=8):
    """A finger; the browser decides what it does."""
    hand = page.context.new_cdp_session(page)
    for k, kind in enumerate(["touchStart", *["touchMove"] * steps]):
        points = [{"x": start[0] + by[0] * k / steps, "y": start[1] + by[1] * k / steps}]
        hand.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
        page.evaluate("() => new Promise(requestAnimationFrame)")  # as often as a screen tells of a finger
    hand.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})


# Resolves when the page no longer scrolls, as it does for a while after a finger has left it.
AT_REST = f"""(point) => new Promise((resolve) => {{
  const pixel = {PIXEL}
  let at, same = 0
  const look = () => {{
    const now = pixel(point)[1]
    same = now === at ? same + 1 : 0
    at = now
    same > 10 ? resolve() : requestAnimationFrame(look)
  }}
  look()
}})"""


def test_a_finger_moves_the_bead_and_scrolls_elsewhere(server, chromium):
    """A swipe that scrolls the page does not look closer as well, but the button does; and it fits a phone."""
    like = {"viewport": {"width": 390, "height": 844}, "has_touch": True, "is_mobile": True, "reduced_motion": "reduce"}
    with chromium.new_context(**like) as phone:
        page = come(phone, server)
        page.wait_for_function("() => document.documentElement.scrollWidth <= 390")
        before = page.evaluate(RANGE)
        above = page.evaluate(PIXEL, ["maps", 40.0, 20.0])
        swipe(page, above, (-60, -120))
        wait(page, lambda: page.evaluate(PIXEL, ["maps", 40.0, 20.0])[1] < above[1] - 20)  # it scrolled
        page.evaluate(AT_REST, ["maps", 40.0, 20.0])
        x, y = page.evaluate(BEAD)
        assert (x, y) == (28.6, 5.7)
        swipe(page, page.evaluate(PIXEL, ["maps", x, y]), (-80, -80))
        wait(page, lambda: page.evaluate(BEAD)[0] < x - 5 and page.evaluate(BEAD)[1] > y + 3)
        page.get_by_role("status").filter(has_text="rev/s, 1").wait_for()  # its run, at more than 9 degrees
        assert page.evaluate(RANGE) == before
        page.get_by_role("button", name="Look closer here").tap()
        wait(page, lambda: abs(page.evaluate(RANGE)[1] - page.evaluate(RANGE)[0] - 15) < 1e-3)  # as an entry is rounded
