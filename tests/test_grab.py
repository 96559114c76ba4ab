"""Dragging in the pictures, in Chromium: what is dragged follows, and everything else with it."""

import pytest
from visiting import PIXEL, WHOLE, Visit, wait

from app.model.roll.region import least_energy
from app.model.scene import solve
from tippe_core import Constants, Top, roll, tielines, turning_points

pytestmark = pytest.mark.served

TOP = Top.paper()
FIELDS = {"K_J": 0, "energy": 2}  # indices among the controls

# The motion on display, as Fig. 6 shows it.
SELECTED = """
() => {
  const plane = [...Bokeh.documents[0]._all_models.values()].find((m) => m.name == "plane" && m.renderers)
  const {data} = plane.renderers.map((r) => r.data_source).find((s) => s.data.worst)
  return Object.fromEntries(Object.entries(data).map(([name, values]) => [name, values[0]]))
}
"""


def selected(visit):
    return visit.page.evaluate(SELECTED)


def until_selected(visit, **values):
    """Waits until Fig. 6 shows these values, in rad and (g/R)^1/2, within the width of a pixel."""
    visit.page.wait_for_function(
        f"(want) => {{ const has = ({SELECTED})(); "
        "return Object.entries(want).every(([k, v]) => Math.abs(has[k] - v) < 0.01) }",
        arg=values,
    )
    return selected(visit)


def until_field(visit, place, value):
    visit.page.wait_for_function(
        """([i, value]) => {
            const seen = (e) => e.matches("input[type=text]") && e.offsetParent
            const find = (root) => [...root.querySelectorAll("*")].flatMap(
              (e) => [...(seen(e) ? [e] : []), ...(e.shadowRoot ? find(e.shadowRoot) : [])])
            return Math.abs(Number(find(document)[i].value.replace("−", "-")) - value) < 1e-4
        }""",
        arg=[place, value],
    )


def top_stands_on(visit, constants):
    """Whether the first frame of the 3-D top belongs to this motion."""
    visit.page.evaluate("window.dispatchEvent(new CustomEvent('tippe:seek', {detail: {t: 0}}))")
    q = roll(TOP, constants, [0.0]).quaternion[0]
    visit.page.wait_for_function(
        "q => Math.abs(__tippe.top3d.quaternion.reduce((sum, x, i) => sum + x * q[i], 0)) > 1 - 1e-6", arg=q.tolist()
    )


def stop_at_the_start(visit):
    """Goes to the start: there the bead is at the inner end, where it does not disturb the tests."""
    visit.pause()
    visit.page.evaluate("window.dispatchEvent(new CustomEvent('tippe:seek', {detail: {t: 0}}))")
    visit.page.wait_for_function("__tippe.top3d.index == 0")


def begin_again(visit, first):
    """Shows the first motion, whatever the step before has done."""
    page = visit.page
    # after releasing, the step of undo is made a moment later
    page.wait_for_function(
        f"""([undo, first]) => {{ undo.click(); const now = ({SELECTED})()
            return undo.disabled && Bokeh.documents[0].is_idle
                && Object.entries(first).every(([name, value]) => now[name] == value) }}""",
        arg=[page.get_by_role("button", name="Undo").element_handle(), first], polling=200)  # fmt: skip
    page.locator("[data-figure=plane]").first.scroll_into_view_if_needed()


def an_end_of_the_tieline_is_the_energy(visit):
    """Also after a rest: Bokeh takes a pointer that rests for 0.3 s for a press, and does not drag."""
    stop_at_the_start(visit)
    before = selected(visit)
    visit.drag(visit.pixel("plane", before["outer"], 7.0), visit.pixel("plane", 0.86, 6.2), rest=400)
    after = until_selected(visit, outer=0.86, K_J=7.0)
    assert after["worst"] == 1
    visit.page.locator(".tippe-readout:visible", has_text="It would slip on the way").wait_for()
    visit.page.mouse.up()
    E = float(least_energy(after["outer"], TOP, 7.0, 10.0))
    until_field(visit, FIELDS["energy"], E)
    assert turning_points(TOP, Constants(7.0, 10.0, E))[0] == pytest.approx([after["inner"], after["outer"]], abs=1e-9)
    top_stands_on(visit, Constants(7.0, 10.0, E))


def the_tieline_itself_is_K_J(visit):
    stop_at_the_start(visit)
    visit.drag(visit.pixel("plane", 0.62, 7.0), visit.pixel("plane", 0.62, 5.5))
    after = until_selected(visit, K_J=5.5)
    visit.page.mouse.up()
    until_field(visit, FIELDS["K_J"], after["K_J"])


def a_click_on_another_tieline_is_that_motion_at_its_limit(visit):
    visit.pause()
    visit.page.mouse.click(*visit.pixel("plane", 1.2, 3.01))
    after = until_selected(visit, K_J=3.0, inner=0.9804, outer=1.3242)
    assert after["K_J"] == 3.0 and after["worst"] == 0
    E = float(tielines(TOP, [3.0], 10.0, 0.5).E[0])
    until_field(visit, FIELDS["energy"], float(f"{E:.6g}"))
    top_stands_on(visit, Constants(3.0, 10.0, E))


def beyond_the_tielines_the_motion_turns_under_the_hand_and_the_picture_says_why_not(visit):
    visit.page.mouse.click(*visit.pixel("plane", 1.1, 7.5))
    assert until_selected(visit, K_J=7.5, outer=1.1)["worst"] == 2
    visit.page.mouse.move(*visit.pixel("plane", 1.3, 6.0))
    visit.page.get_by_text("It cannot roll here: it would lift off on the way").wait_for()
    visit.page.mouse.move(*visit.pixel("plane", 0.96, 6.0))
    visit.page.get_by_text("It cannot roll here: it would slip on the way").wait_for()


def the_bead_moves_the_clock_and_nothing_else(visit):
    stop_at_the_start(visit)
    visit.page.wait_for_function("""[...Bokeh.documents[0]._all_models.values()].some(
        (m) => m.type == "Label" && m.visible && m.text.startsWith("rolls again"))""")  # it appears last
    place, aim = selected(visit), 0.7
    visit.drag(visit.pixel("plane", place["theta"], 7.0), visit.pixel("plane", aim, 7.3))
    visit.sent.clear()
    visit.page.mouse.move(*visit.pixel("plane", aim - 0.02, 7.3))
    # the nearest frame of 64 in a nutation
    visit.page.wait_for_function(f"(aim) => Math.abs(({SELECTED})().theta - aim) < 0.02", arg=aim - 0.02)
    constants = solve(TOP, 7.0, 10.0, 0.5, 0.9).constants

    def at_the_clocks_time():
        theta = roll(TOP, constants, [0.0, visit.page.evaluate("__tippe.top3d.t")]).theta[1]
        return abs(theta - selected(visit)["theta"]) < 1e-3

    wait(visit.page, at_the_clocks_time)
    assert not visit.sent
    visit.page.mouse.up()


def test_everything_in_the_pictures_of_roll_can_be_pulled(chromium, server):
    """With reduced motion no clock runs; the bead is at the start of the motion, not at theta = 0."""
    with chromium.new_context(viewport={"width": 1400, "height": 900}, reduced_motion="reduce") as context:
        visit = Visit(context.new_page(), server)
        at_first = selected(visit)
        assert at_first["theta"] == pytest.approx(at_first["inner"], abs=1e-4)
        for step in (
            an_end_of_the_tieline_is_the_energy,
            the_tieline_itself_is_K_J,
            a_click_on_another_tieline_is_that_motion_at_its_limit,
            beyond_the_tielines_the_motion_turns_under_the_hand_and_the_picture_says_why_not,
            the_bead_moves_the_clock_and_nothing_else,
        ):
            step(visit)
            begin_again(visit, {name: at_first[name] for name in ("K_J", "inner", "outer")})


def test_a_finger_pulls_the_tieline_and_scrolls_the_page_from_elsewhere(chromium, server):
    """On a phone, of which nothing is wider."""
    phone = chromium.new_context(viewport={"width": 390, "height": 844}, is_mobile=True, has_touch=True,
                                 reduced_motion="reduce", user_agent="Android Mobile")  # fmt: skip
    visit = Visit(phone.new_page(), server, whole=False)
    page, touch = visit.page, phone.new_cdp_session(visit.page)
    page.wait_for_function(f"() => window.Bokeh?.documents?.length && ({WHOLE})()")
    page.wait_for_function("document.documentElement.scrollWidth <= innerWidth")
    box = page.locator("canvas").first.bounding_box()
    assert 0 <= box["x"] and box["x"] + box["width"] <= 390

    def drag(x, y, by):
        for kind, at in (("touchStart", y), *(("touchMove", y + by * i / 8) for i in range(1, 9)), ("touchEnd", None)):
            points = [] if at is None else [{"x": x, "y": at}]
            touch.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

    top = "() => document.body.getClientRects().length && (" + PIXEL + ")(['plane', 0.62, 7])[1]"
    page.locator("[data-figure=plane]").first.evaluate("e => e.scrollIntoView({block: 'end'})")
    place = page.evaluate(top)
    x, y = visit.pixel("plane", 0.62, 7.0)
    drag(x, y, 60)
    page.wait_for_function("/KJ=/.test(location.search)")  # once everything is at rest
    K_J = selected(visit)["K_J"]
    assert K_J < 6
    assert page.evaluate(top) == pytest.approx(place, abs=1)
    drag(*visit.pixel("plane", 1.4, 8.0), -120)
    page.wait_for_function(f"place => ({top})() < place - 40", arg=place)
    assert selected(visit)["K_J"] == K_J
    phone.close()
    assert not visit.errors
