"""The tab Maps in Chromium: the map appears, a click and a drag lead to runs, impossible requests change nothing."""

import math
import re

import pytest
from visiting import PIXEL, Visit, wait

from app.text import listed

pytestmark = pytest.mark.served

# How many cells a side the finest picture has, and whether something is hatched or lined.
SIDE = """() => {
  const map = [...Bokeh.documents[0]._all_models.values()].find((m) => m.name == "maps" && m.renderers)
  return map?.renderers[1].data_source.data.image[0]?.shape?.[0] ?? 0
}"""
BEAD = """() => {
  const map = [...Bokeh.documents[0]._all_models.values()].find((m) => m.name == "maps" && m.renderers)
  const {x, y} = map.renderers.at(-1).data_source.data
  return [x[0], y[0]]
}"""


@pytest.fixture
def page(server, chromium):
    page = chromium.new_page(viewport={"width": 1400, "height": 1000}, reduced_motion="reduce")
    Visit(page, f"{server}?v=1&tab=maps&map=spin_5_50_tilt_1_40_contensou_10_6_9", whole=False)
    page.get_by_role("status").filter(has_text="28.6 rev/s, 5.7").wait_for()
    page.wait_for_function(f"() => ({SIDE})() == 9")
    page.get_by_role("button", name="Stop").and_(page.locator(":disabled")).wait_for()
    yield page
    page.close()


def enter(page, label, text):
    entry = page.get_by_label(label, exact=True)
    entry.fill(text)
    entry.press("Enter")


def said(page):
    return page.get_by_role("status").filter(has_text="rev/s,").inner_text()


def a_click_on_a_cell_and_a_drag_of_the_bead_show_their_runs(page):
    page.mouse.click(*page.evaluate(PIXEL, ["maps", 44.0, 6.0]))
    x, y = 42.5, 1 + 39 * 1.5 / 9  # the middle of its cell
    wait(page, lambda: page.evaluate(BEAD) == pytest.approx([x, y], abs=1e-9))
    page.get_by_role("status").filter(has_text="stands on its stem").wait_for()
    page.mouse.move(*page.evaluate(PIXEL, ["maps", x, y]))
    page.mouse.down()
    for share in (0.3, 0.6, 1.0):
        page.mouse.move(*page.evaluate(PIXEL, ["maps", x - 36 * share, y + 10 * share]))
    page.mouse.up()
    wait(page, lambda: re.match(r"6\.\d+ rev/s, 17", said(page)))
    entry = page.get_by_label("The run at, Across", exact=True)
    wait(page, lambda: entry.input_value().startswith("6."))


def the_top_beside_is_at_the_start_of_the_run_that_was_clicked(page):
    """Also without playing it, and after the one before has been played."""
    pill, play = page.locator(".film .pill"), page.locator(".film > button")
    for tilt in (25, 10):
        page.mouse.click(*page.evaluate(PIXEL, ["maps", 44.0, tilt]))
        wait(page, lambda: page.evaluate(BEAD)[0] == 42.5)
        middle = 1 + 39 * (int((tilt - 1) / 39 * 9) + 0.5) / 9  # of its cell
        page.get_by_text(f"0.00 s · {middle:.0f}°", exact=True).wait_for()
        x, y, *_ = page.evaluate("__tippe.tops('map')[0].quaternion")
        assert math.degrees(math.acos(1 - 2 * (x * x + y * y))) == pytest.approx(middle, abs=1e-3)
        play.click()
        page.wait_for_function("__tippe.time('map') > 0.05")
        play.click()
        wait(page, lambda: not pill.inner_text().startswith("0.00 s"))


def arrow_keys_move_the_bead_and_the_top_beside_is_that_of_its_run(page):
    x, y = page.evaluate(BEAD)
    page.get_by_role("img", name="Map: the end of each run").focus()
    page.keyboard.press("ArrowRight")
    page.keyboard.press("Shift+ArrowUp")
    wait(page, lambda: abs(page.evaluate(BEAD)[0] - x - 5) < 1e-9)  # of 9 cells from 5 to 50
    entry = page.get_by_label("The run at, Up", exact=True)
    wait(page, lambda: abs(float(entry.input_value()) - y - 39 / 90) < 1e-3)
    page.wait_for_function("() => window.__tippe.tops('map').length == 1")


def what_cannot_be_is_said_and_the_map_stays(page):
    enter(page, "Across, to", "3")
    page.get_by_role("alert").filter(has_text="spin_from = 5").wait_for()
    assert page.evaluate(SIDE) == 9
    enter(page, "Across, to", "50")
    page.get_by_role("alert").filter(has_text="spin_from").wait_for(state="detached")


def a_disagreement_can_be_gone_to(page):
    before = page.evaluate(BEAD)
    page.get_by_role("button", name="Show one such run").first.click()
    wait(page, lambda: page.evaluate(BEAD) != before)
    assert page.get_by_text("Where runs and formula disagree").is_visible()


RANGE = """() => {
  const map = [...Bokeh.documents[0]._all_models.values()].find((m) => m.name == "maps" && m.renderers)
  return [map.x_range.start, map.x_range.end, map.y_range.start, map.y_range.end]
}"""


def a_box_looks_closer_and_undo_goes_back(page):
    before = page.evaluate(RANGE)
    page.get_by_label("The run at, Across", exact=True).fill("45")
    page.get_by_label("The run at, Across", exact=True).press("Enter")
    wait(page, lambda: abs(page.evaluate(BEAD)[0] - 45) < 1e-9)
    page.mouse.move(*page.evaluate(PIXEL, ["maps", 15.0, 10.0]))
    page.mouse.down()
    for x, y in ((18.0, 14.0), (21.0, 20.0), (25.0, 30.0)):
        page.mouse.move(*page.evaluate(PIXEL, ["maps", x, y]))
    page.mouse.up()
    wait(page, lambda: page.evaluate(RANGE) != before)
    left, right, bottom, top = page.evaluate(RANGE)
    assert abs(left - 15) < 0.5 and abs(right - 25) < 0.5 and abs(bottom - 10) < 0.5 and abs(top - 30) < 0.5
    page.get_by_role("button", name="The whole range").click()
    wait(page, lambda: page.evaluate(RANGE) == before)


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
    """A swipe that scrolls the page does not look closer as well, but the button does."""
    phone = chromium.new_context(viewport={"width": 390, "height": 844}, has_touch=True, is_mobile=True,
                                 reduced_motion="reduce")  # fmt: skip
    page = phone.new_page()
    Visit(page, f"{server}?v=1&tab=maps&map=spin_5_50_tilt_1_40_contensou_2_6_9", whole=False)
    page.get_by_role("status").filter(has_text="28.6 rev/s, 5.7").wait_for()
    page.wait_for_function(f"() => ({SIDE})() == 9")
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
    wait(page, lambda: abs(page.evaluate(RANGE)[1] - page.evaluate(RANGE)[0] - 15) < 1e-3)  # rounded as an entry is
    phone.close()


def it_fits_a_phone(page):
    page.set_viewport_size({"width": 390, "height": 844})
    page.wait_for_function("() => document.documentElement.scrollWidth <= 390")


# Where the first word that is set like this stands, in whatever shadow.
WORD = """(word) => {
  const within = (root) => {
    for (const part of root.querySelectorAll("*")) {
      const deeper = part.shadowRoot && within(part.shadowRoot)
      if (deeper) return deeper
      for (const node of part.childNodes) {
        const at = node.nodeType === 3 && !part.closest("button, label, style, script") ? node.data.indexOf(word) : -1
        if (at < 0) continue
        const range = document.createRange()
        range.setStart(node, at)
        range.setEnd(node, at + word.length)
        part.scrollIntoView({ block: "center", behavior: "instant" })
        const box = range.getBoundingClientRect()
        if (box.width) return [box.x + box.width / 2, box.y + box.height / 2]
      }
    }
  }
  return within(document)
}"""


def a_term_is_explained_where_the_mouse_rests_and_hidden_when_it_goes(page):
    page.set_viewport_size({"width": 1400, "height": 1000})
    box = page.locator(".tippe-readout:visible", has_text=listed("glossary.terms.nudge.is", "en"))

    page.wait_for_function(WORD, arg="nudge")  # scrolls it into the window
    page.evaluate("() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
    page.mouse.move(*page.wait_for_function(WORD, arg="nudge").json_value())
    box.wait_for()
    page.mouse.move(0, 0)
    box.wait_for(state="detached")


def test_one_visit(page):
    """One visit, step by step."""
    arrow_keys_move_the_bead_and_the_top_beside_is_that_of_its_run(page)
    a_click_on_a_cell_and_a_drag_of_the_bead_show_their_runs(page)
    the_top_beside_is_at_the_start_of_the_run_that_was_clicked(page)
    what_cannot_be_is_said_and_the_map_stays(page)
    a_disagreement_can_be_gone_to(page)
    a_box_looks_closer_and_undo_goes_back(page)
    a_term_is_explained_where_the_mouse_rests_and_hidden_when_it_goes(page)
    it_fits_a_phone(page)
