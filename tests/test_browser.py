"""The whole page in Chromium: it shows the numbers of tippe_core, and plays without the server."""

import numpy as np
import pytest
from axe import DARK, LIGHT, LOOK, check
from visiting import Visit, wait

from app.model.scene import solve
from tippe_core import Top

pytestmark = pytest.mark.served

K_J_FIELD, I3_FIELD = 0, 6  # indices among the controls

FIELDS = "input[type=text]:visible"
# The positions of all figures, 3-D pictures and controls.
PLACES = """() => [...Bokeh.documents[0]._all_models.values()].filter((model) => "sizing_mode" in model.properties)
    .map((model) => Bokeh.index.find_one(model)?.el?.getBoundingClientRect()).filter((box) => box?.width)
    .map(({x, y, width, height}) => [x, y, width, height])"""


COLOURS = """() => {
    const all = (root) => [...root.querySelectorAll("*")]
        .flatMap((e) => [e, ...e.shadowRoot ? all(e.shadowRoot) : []])
    const kinds = "[role=tab][aria-selected=false], [role=radio][aria-checked=false], label"
    const widgets = all(document).filter((e) => e.matches(kinds) && e.offsetParent)
    return widgets.map((e) => getComputedStyle(e).color.match(/[\\d.]+/g).slice(0, 3).map(Number))
        .map(([r, g, b]) => r + g + b)
}"""


def the_widgets_go_dark_at_once(page):
    """In the same frame as the page; they are not created again one by one."""
    page.wait_for_function("Bokeh.documents[0].is_idle")
    quiet = 0x5B + 0x68 + 0x75  # the colour --faint of the other tabs in the head
    light = page.evaluate(COLOURS)
    page.evaluate(LOOK, DARK)
    dark = page.evaluate(COLOURS)
    page.evaluate(LOOK, LIGHT)
    assert len(light) == len(dark) > 10
    assert max(light) <= quiet < 450 < min(dark)


def the_top_and_the_lines_over_time_go_with_the_clock(visit):
    motion = solve(Top.paper(), 7.0, 10.0, 0.5, 0.9).trajectory
    for index in (0, 100, 777):
        t = float(motion.t[index])
        visit.page.evaluate("t => window.dispatchEvent(new CustomEvent('tippe:seek', {detail: {t}}))", t)
        visit.page.wait_for_function("i => __tippe.top3d.index == i", arg=index)
        drawn = np.array(visit.page.evaluate("__tippe.top3d.quaternion"))
        assert abs(drawn @ motion.quaternion[index]) == pytest.approx(1, abs=1e-6)
        visit.page.wait_for_function("""t => {
            const lines = [...Bokeh.documents[0]._all_models.values()]
                .filter((m) => m.type == "Span" && m.level == "overlay")
            return lines.length && lines.every((m) => Math.abs(m.location - t) < 0.02)
        }""", arg=t)  # fmt: skip


def a_bad_value_is_said_beside_its_control(visit):
    before = visit.column("theta", 0, "theta")
    field = visit.page.locator(FIELDS).nth(I3_FIELD)
    for text, says in (("0.9", "0.9"), ("not this", "not a number")):
        field.fill(text)
        field.press("Enter")
        visit.page.locator("[role=alert]:visible", has_text=says).wait_for()
    assert np.array_equal(visit.column("theta", 0, "theta"), before)
    field.fill("0.4")
    field.press("Enter")
    visit.page.locator("[role=alert]:visible").wait_for(state="detached")
    visit.until_column("theta", 0, "theta", solve(Top(0.07, 0.399, 0.4), 7.0, 10.0, 0.5, 0.9).trajectory.theta[0])
    field.fill("0.408")
    field.press("Enter")
    visit.until_column("theta", 0, "theta", before[0])


def nothing_moves_while_a_slider_is_dragged(visit):
    """Numbers get longer, and sentences appear and disappear, but nothing on the page moves."""
    page = visit.page
    page.wait_for_function("Bokeh.documents[0].is_idle")
    before = page.evaluate(PLACES)
    thumb = page.locator("input[data-input]:visible").nth(K_J_FIELD).bounding_box()
    across, up = thumb["x"], thumb["y"] + thumb["height"] / 2
    visit.drag((across + 0.7 * thumb["width"], up), (across + 0.2 * thumb["width"], up))
    field = page.locator(FIELDS).nth(K_J_FIELD)
    page.wait_for_function("field => Number(field.value) < 2.5", arg=field.element_handle())
    assert len(before) > 20 and page.evaluate(PLACES) == before
    page.mouse.up()
    # all pictures of the drag have arrived, so that none arrives after what is typed next
    wait(page, lambda: abs(visit.column("constants", 0, "K_J")[0] - float(field.input_value())) < 1e-4)
    page.wait_for_function("Bokeh.documents[0].is_idle")
    assert page.evaluate(PLACES) == before


def after_a_slider_moved_the_data_on_display_are_tippe_cores(visit):
    """Also in a tab that paints nothing: then nothing tells the server that its pictures have arrived."""
    field = visit.page.locator(FIELDS).nth(K_J_FIELD)
    field.fill("7")
    field.press("Enter")
    visit.until_column("constants", 0, "K_J", 7.0)
    visit.page.wait_for_function("Bokeh.documents[0].is_idle")
    visit.page.evaluate("() => { window.requestAnimationFrame = () => 0 }")
    thumb = visit.page.locator("input[data-input]:visible").nth(K_J_FIELD)
    thumb.focus()
    for _ in range(30):
        thumb.press("ArrowLeft")
    scene = solve(Top.paper(), 6.7, 10.0, 0.5, 0.9)
    visit.until_column("constants", 0, "K_J", scene.K_J[0])
    motion, every = scene.trajectory, 2
    # The slider's own sum of steps differs from 6.7 in the last digits.
    for figure, values in {"theta": motion.theta, "normal": scene.normal, "ratio": scene.ratio}.items():
        assert visit.column(figure, 0, figure) == pytest.approx(values[::every], abs=1e-11)
    plane = {"K_J": scene.plane.K_J, "slip_in": scene.plane.slip.theta_inner, "verge": scene.plane.slip.theta_verge}
    for column, values in plane.items():
        assert np.array_equal(visit.column("plane", 0, column), values)


def test_what_is_shown_is_tippe_cores(visit):
    visit.pause()
    the_widgets_go_dark_at_once(visit.page)
    check(visit.page, "roll")
    the_top_and_the_lines_over_time_go_with_the_clock(visit)
    a_bad_value_is_said_beside_its_control(visit)
    nothing_moves_while_a_slider_is_dragged(visit)
    after_a_slider_moved_the_data_on_display_are_tippe_cores(visit)


def test_it_moves_at_once_sends_nothing_and_what_is_out_of_sight_is_drawn_when_it_comes_into_sight(chromium, server):
    """Fig. 5 is visible from the start, with all controls of the motion."""
    with chromium.new_context(viewport={"width": 1400, "height": 900}) as context:
        visit = Visit(context.new_page(), server, near=True)
        page = visit.page
        assert page.title() == "Tippe top explorer"
        page.wait_for_function(
            "t => __tippe.top3d.t != t && __tippe.top3d.playing", arg=page.evaluate("__tippe.top3d.t")
        )
        wait(page, lambda: plays_without_a_word(visit))  # a page that has just loaded still sends its size
        visit.pause()
        shown = "m => m.near === false"
        page.wait_for_function(f"[...Bokeh.documents[0]._all_models.values()].filter({shown}).length == 3")
        for seen in ("canvas[aria-label^='Figure 5']", "[data-figure=plane]", *(
                f"input[data-input={name}]" for name in ("K_J", "K_R", "energy", "mu_s"))):  # fmt: skip
            box = page.locator(seen).first.bounding_box()
            assert box["y"] + min(box["height"], 30) < 900, seen
        field = page.locator(FIELDS).nth(K_J_FIELD)
        field.fill("6.7")
        field.press("Enter")
        expected = solve(Top.paper(), 6.7, 10.0, 0.5, 0.9)
        page.wait_for_function("n => __tippe.top3d.count == n", arg=len(expected.trajectory.t))
        page.wait_for_function("/KJ=6.7/.test(location.search)")  # everything is at rest
        assert visit.column("constants", 0, "K_J")[0] == pytest.approx(7.0)
        page.locator("[data-figure=constants]").first.evaluate("e => e.scrollIntoView({block: 'center'})")
        visit.until_column("constants", 0, "K_J", expected.K_J[0])


def plays_without_a_word(visit):
    """Whether the page has sent and heard nothing for five pictures."""
    visit.sent.clear()
    pictures = visit.page.evaluate("__tippe.top3d.pictures")
    visit.page.wait_for_function("n => __tippe.top3d.pictures > n + 5", arg=pictures)
    return not visit.sent
