"""Dragging in the pictures, in Chromium: what is dragged follows, and everything else with it."""

import pytest
from visiting import COLUMN, IN_SIGHT, Visit, entry, open_panel, wait

from app.model.region import least_energy
from tippe_core import Constants, Top, roll, tielines, turning_points

pytestmark = pytest.mark.served

TOP = Top.paper()
STATE = ("theta", "theta_dot", "omega2", "omega3")

# The motion on display, as Fig. 6 shows it.
SELECTED = "() => window.__tippe?.plane?.selected"


def selected(visit):
    return visit.page.evaluate(SELECTED)


def motion_of(visit, shown=None):
    """What determines the motion on display."""
    shown = shown or selected(visit)
    return {name: shown[name] for name in ("K_J", "K_R", "inner", "outer")}


def until_selected(visit, **values):
    """Waits until Fig. 6 shows these values, in rad and (g/R)^1/2, within the width of a pixel."""
    visit.page.wait_for_function(
        f"(want) => {{ const has = ({SELECTED})(); "
        "return Object.entries(want).every(([k, v]) => Math.abs(has[k] - v) < 0.01) }",
        arg=values,
    )
    return selected(visit)


def field(visit, name):
    """The number in the field of an input."""
    return float(entry(visit.page, name).input_value().replace("−", "-"))


def until_field(visit, name, value):
    wait(visit.page, lambda: abs(field(visit, name) - value) < 1e-4)


def show_state(visit):
    visit.page.get_by_role("radio", name="State", exact=True).click()
    visit.page.locator(":text('its rate'):visible").wait_for()


def type_in(visit, name, text):
    entry(visit.page, name).fill(text)
    entry(visit.page, name).press("Enter")


def top_stands_on(visit, state_or_constants, **options):
    """Whether the first frame of the 3-D top belongs to this motion."""
    visit.page.evaluate("window.dispatchEvent(new CustomEvent('tippe:seek:lab', {detail: {t: 0}}))")
    q = roll(TOP, state_or_constants, [0.0], **options).quaternion[0]
    visit.page.wait_for_function(
        "q => Math.abs(__tippe.top3d.quaternion.reduce((sum, x, i) => sum + x * q[i], 0)) > 1 - 1e-6", arg=q.tolist()
    )


def stop_at_the_start(visit):
    """Goes to the start: there the bead is at the inner end, where it does not disturb the tests."""
    visit.pause()
    visit.page.evaluate("window.dispatchEvent(new CustomEvent('tippe:seek:lab', {detail: {t: 0}}))")
    visit.page.wait_for_function("__tippe.top3d.index == 0")


@pytest.fixture(scope="module")
def one(chromium, server):
    """The page that all tests here share; nothing in it moves by itself."""
    context = chromium.new_context(viewport={"width": 1400, "height": 900}, reduced_motion="reduce")
    visit = Visit(context.new_page(), server)
    visit.page.wait_for_function(SELECTED)
    visit.first = {name: selected(visit)[name] for name in ("K_J", "inner", "outer")}
    yield visit
    context.close()


@pytest.fixture
def visit(one):
    """That page with its first motion, whatever an earlier test has done."""
    page = one.page
    page.mouse.up()  # in case a test failed with the button pressed
    if page.get_by_role("radio", name="Constants", exact=True).get_attribute("aria-checked") != "true":
        page.get_by_role("radio", name="Constants", exact=True).click()
        page.get_by_role("slider", name="Routh’s constant").wait_for()
    open_panel(page, "Which motions roll")
    # after releasing, the step of undo is made a moment later
    page.wait_for_function(
        f"""([undo, first]) => {{ undo.click(); const now = ({SELECTED})()
            return undo.disabled && Bokeh.documents[0].is_idle
                && Object.entries(first).every(([name, value]) => now[name] == value) }}""",
        arg=[page.get_by_role("button", name="Undo").element_handle(), one.first], polling=200)  # fmt: skip
    # all of it, wherever another test has scrolled to
    plane = page.locator("[data-figure=plane]").first
    plane.wait_for()
    plane.evaluate("element => element.scrollIntoView({block: 'center', behavior: 'instant'})")
    return one


def test_an_end_of_the_tieline_is_the_energy(visit):
    stop_at_the_start(visit)
    before = selected(visit)
    visit.drag(visit.pixel("plane", before["outer"], 7.0), visit.pixel("plane", 0.86, 6.2))
    after = until_selected(visit, outer=0.86, K_J=7.0)
    assert after["worst"] == 1
    visit.page.locator(".tippe-readout:visible", has_text="It would slip on the way").wait_for()
    visit.page.mouse.up()
    E = float(least_energy(after["outer"], TOP, 7.0, 10.0))
    until_field(visit, "energy", E)
    assert turning_points(TOP, Constants(7.0, 10.0, E))[0] == pytest.approx([after["inner"], after["outer"]], abs=1e-9)
    top_stands_on(visit, Constants(7.0, 10.0, E))


# Whether the read-out is in the window, and covers neither the bead nor the tieline on display.
CLEAR = """([ends, bead]) => {
  const box = document.querySelector(".tippe-readout").getBoundingClientRect()
  const inside = ([x, y]) => x > box.left && x < box.right && y > box.top && y < box.bottom
  const on = Array.from({length: 21}, (_, i) => ends[0].map((x, k) => x + i / 20 * (ends[1][k] - x)))
  const whole = box.left >= 0 && box.top >= 0 && box.right <= innerWidth && box.bottom <= innerHeight
  return whole && ![...on, bead].some(inside)
}"""


def test_what_is_read_of_a_place_covers_neither_bead_nor_tieline(visit):
    stop_at_the_start(visit)
    place = selected(visit)
    ends = [visit.pixel("plane", place[end], 7.0) for end in ("inner", "outer")]
    for theta, K_J in ((0.5, 7.0), (0.39, 7.0), (0.76, 6.9), (0.6, 7.4), (1.2, 3.0), (3.0, 0.1), (0.05, 8.3)):
        visit.page.mouse.move(*visit.pixel("plane", theta, K_J))
        visit.page.locator(".tippe-readout:visible", has_text=f"{theta:.2f}").wait_for()
        assert visit.page.evaluate(CLEAR, [ends, visit.pixel("plane", place["theta"], 7.0)])


def test_a_click_on_another_tieline_is_that_motion_at_its_limit(visit):
    visit.pause()
    visit.page.mouse.click(*visit.pixel("plane", 1.2, 3.01))
    after = until_selected(visit, K_J=3.0, inner=0.9804, outer=1.3242)
    assert after["K_J"] == 3.0 and after["worst"] == 0
    E = float(tielines(TOP, [3.0], 10.0, 0.5).E[0])
    until_field(visit, "energy", float(f"{E:.6g}"))
    top_stands_on(visit, Constants(3.0, 10.0, E))


def test_beyond_the_tielines_the_motion_turns_under_the_hand_and_the_picture_says_why_not(visit):
    visit.page.mouse.click(*visit.pixel("plane", 1.1, 7.5))
    assert until_selected(visit, K_J=7.5, outer=1.1)["worst"] == 2
    visit.page.mouse.move(*visit.pixel("plane", 1.3, 6.0))
    visit.page.get_by_text("It cannot roll here: it would lift off on the way").wait_for()
    visit.page.mouse.move(*visit.pixel("plane", 0.96, 6.0))
    visit.page.get_by_text("It cannot roll here: it would slip on the way").wait_for()


def test_a_state_that_is_typed_shows_its_constants_and_the_other_face_keeps_it(visit):
    visit.pause()
    show_state(visit)
    for name, text in {"theta": "0.6", "theta_dot": "1.5", "omega2": "−2", "omega3": "9"}.items():
        type_in(visit, name, text)
        until_field(visit, name, float(text.replace("−", "-")))
    constants = Constants.from_state(TOP, 0.6, 1.5, -2.0, 9.0)
    before = until_selected(visit, K_J=float(constants.K_J), K_R=float(constants.K_R))
    visit.page.get_by_text(f"{constants.K_J:.4g}".replace("-", "−")).locator("visible=true").first.wait_for()
    visit.page.get_by_role("radio", name="Constants", exact=True).click()
    visit.page.get_by_role("slider", name="Routh’s constant").wait_for()
    for name in ("K_J", "K_R"):
        until_field(visit, name, float(f"{getattr(constants, name):.6g}"))
    until_field(visit, "energy", float(f"{constants.E:.6g}"))
    show_state(visit)
    assert [field(visit, place) for place in STATE] == [0.6, 1.5, -2.0, 9.0]
    assert motion_of(visit) == motion_of(visit, before)
    type_in(visit, "theta", "4")
    alert = visit.page.locator("[role=alert]:visible")
    alert.wait_for()
    assert "θ" in alert.inner_text()
    assert motion_of(visit) == motion_of(visit, before)


def test_the_floor_of_fig_5_can_be_pulled_and_says_why_not(visit):
    visit.pause()
    before = field(visit, "energy")
    open_panel(visit.page, "Surface")
    visit.page.locator("canvas[aria-label^='Figure 5']").evaluate(IN_SIGHT)
    visit.page.wait_for_function("() => __tippe.surface3d?.selected === 7")
    _, outer = visit.page.evaluate("__tippe.surface3d.grips")
    visit.drag(outer, (outer[0] + 25, outer[1] + 4))
    wait(visit.page, lambda: field(visit, "energy") > before + 1)
    assert field(visit, "K_J") == 7.0
    visit.page.wait_for_function("__tippe.surface3d.readout.includes('on the way')")
    visit.page.mouse.up()


PORTRAITS = {"phase portrait": "phase", "f(θ)": "f", "effective potential": "potential", "unrolled": "ring",
             "force in its disc": "force"}  # fmt: skip


def test_the_bead_of_each_portrait_goes_with_the_clock_and_the_clock_with_it(visit):
    visit.pause()
    open_panel(visit.page, "Portraits")
    for name, figure in PORTRAITS.items():
        visit.page.get_by_role("radio", name=name, exact=True).click()
        visit.page.wait_for_function(
            """name => {
                const models = Bokeh.documents.flatMap((doc) => [...doc.all_models])
                const m = models.find((m) => m.name == name && m.renderers)
                return m && Bokeh.index.find_one(m)?.frame?.bbox.width > 50
            }""", arg=figure)  # fmt: skip
        line = {"phase": 3, "force": 1, "potential": 1}.get(figure, 0)
        t, x, y = (visit.column(figure, line, column).tolist() for column in "txy")
        visit.page.locator(f"[data-figure={figure}]").first.evaluate("e => e.scrollIntoView({block: 'center'})")
        i = len(t) // 3
        visit.page.mouse.click(*visit.pixel(figure, x[i], y[i]))
        visit.page.wait_for_function(
            """([name, column, renderer, x]) => Math.abs(eval(column)([name, renderer, "x"])[0] - x) < 0.02""",
            arg=[figure, COLUMN, line + 1, x[i]])  # fmt: skip
