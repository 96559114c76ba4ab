"""Fig. 6 in Chromium, alone on a page without a server: what is drawn, and a hand and keys on it."""

import json

import numpy as np
import pytest
from axe import violations
from components import *  # noqa: F403
from visiting import IN_SIGHT

from app.model.explorer import Explorer
from app.model.roll.slipping import slipping
from app.model.start import arrives
from app.text import listed, speaking
from app.widgets.plane_view import PlaneView
from tippe_core import Top, tielines

pytestmark = pytest.mark.served

SEEN = "window.__tippe?.plane?.pictures"
PIXEL = "([theta, value, plot]) => __tippe.plane.pixel(theta, value, plot)"
# The boxes of all names, of the drawing, and of the card that shows the motion from near.
BOXES = """() => {
  const {bar} = __tippe.plane, svg = bar.ownerSVGElement
  const box = (part) => {
    const {left, right, top, bottom} = part.getBoundingClientRect()
    return [left, top, right, bottom]
  }
  return {names: [...svg.querySelectorAll(".name")].map((name) => {
      const all = [...name.querySelectorAll("text")].map(box)
      return [Math.min, Math.min, Math.max, Math.max].map((most, i) => most(...all.map((one) => one[i])))
    }), whole: box(svg)}
}"""


@pytest.fixture
def figure(alone):
    """figure(inputs, high, language, view, found, **like) gives the Alone with the figure `.view` of a Scene, `.scene`,
    at rest; with an Alone `found`, that one, and the figure in place of the one before."""

    def open_(inputs=(), high=600, language="en", view=(), found=None, **like):
        if found:
            found.leave(found.view)
        else:
            found = alone(**like)
        found.scene = scene = Explorer(**dict(inputs)).scene
        with speaking(language):
            found.view = PlaneView(height=high, **dict(view))
        found.view.show_selected(scene)
        found.view.show_plane(scene)
        found.view.show_slipping(slipping(scene), scene)
        found.show(found.view)
        found.page.wait_for_function(f"{SEEN} > 0")
        found.pixel = lambda theta, value, plot="plane": found.page.evaluate(PIXEL, [float(theta), float(value), plot])
        return found

    return open_


def hands(figure):
    """What it has asked for."""
    return [value for _, name, value in figure.told if name == "hand"]


# ---- what is drawn ----


CASES = {
    "the paper's": {}, "slips at once": {"mu_s": 0.1}, "past the poles": {"upper": False},
    "the paper's own part": {"upper": "paper"}, "a ball": {"a": 0.0, "I1": 0.4, "I3": 0.4}, "a toy": arrives(),
    "low": {"K_J": 1.0}, "would slip": {"energy": 1.5},
}  # fmt: skip


def apart(one, other):
    return one[2] <= other[0] or other[2] <= one[0] or one[3] <= other[1] or other[3] <= one[1]


@pytest.mark.parametrize(("wide", "language"), [(360, "de"), (570, "en")])
def test_names_stand_in_the_figure_and_on_no_other(figure, wide, language):
    """On a phone and beside the stage; the motion and its limits are always named."""
    names, found = listed("roll.plane", language)["names"], None
    for case, inputs in CASES.items():
        found = figure(inputs, 560, language, found=found, viewport={"width": wide, "height": 700})
        boxes, said = found.page.evaluate(BOXES), found.page.evaluate("__tippe.plane.names")
        left, top, right, bottom = boxes["whole"]
        for i, box in enumerate(boxes["names"]):
            assert box[0] >= left - 1 and box[1] >= top - 1 and box[2] <= right + 1 and box[3] <= bottom + 1, said[i]
            assert [said[k] for k, other in enumerate(boxes["names"][:i]) if not apart(box, other)] == [], (
                case,
                said[i],
            )
        limited = {*found.scene.plane.slip.limited_by} & {"slip"}
        for name in ("verge", "steady") if limited else ("steady",):
            assert any(text.startswith(bare(names[name][-1])) for text in said), (case, name)


def bare(text):
    """Without marks, as in a name."""
    return text.replace("\n", "").replace("<i>", "").replace("</i>", "").replace("<sub>", "").replace("</sub>", "")


def test_the_curves_are_where_the_core_has_them_and_a_pointer_is_told_what_it_meets(figure):
    found = figure()
    the_curves_are_where_the_core_has_them(found)
    a_hand_is_told_within_a_pixel_of_each_axis_and_not_beyond(found)
    the_cursor_says_what_would_be_grabbed(found)


def the_curves_are_where_the_core_has_them(found):
    K_J = found.scene.plane.K_J[::7]
    slip, lift = (tielines(Top.paper(), K_J, 10.0, mu) for mu in (0.5, None))
    on = """([name, at]) => { const path = __tippe.plane.bar.ownerSVGElement.querySelector(`.curves .${name}`)
        const [left, top] = [path.ownerSVGElement.getBoundingClientRect()].flatMap(({left, top}) => [left, top])
        const numbers = path.getAttribute("d").split(/[ML]/).slice(1).map((pair) => pair.split(" ").map(Number))
        return Math.min(...numbers.map(([x, y]) => Math.hypot(x + left - at[0], y + top - at[1]))) }"""
    for name, theta in {"verge": slip.theta_verge, "force": lift.theta_verge, "steady": lift.theta_steady}.items():
        for place in zip(theta, K_J, strict=True):
            assert found.page.evaluate(on, [name, found.pixel(*place)]) < 0.2, (name, place)


def a_hand_is_told_within_a_pixel_of_each_axis_and_not_beyond(found):
    page, (left, bottom), (right, top) = found.page, found.pixel(0, 0), found.pixel(np.pi, found.scene.plane.pole)
    for x, y in ((left, bottom - 40), (left + 200, bottom), (right, bottom - 40), (left + 200, top)):
        page.mouse.move(x + 0.5, y + 0.5 * (1 if y == top else -1))
        page.locator(".tippe-readout:visible").wait_for()
        page.mouse.move(
            x + (0 if left < x < right else 30 if x == right else -30),
            y + (0 if top < y < bottom else 30 if y == bottom else -30),
        )
        page.locator(".tippe-readout").wait_for(state="hidden")


def the_cursor_says_what_would_be_grabbed(found):
    cursor = "() => __tippe.plane.bar.ownerSVGElement.style.cursor"
    for place, wanted in (((found.scene.turning[0], 7), "grab"), ((found.scene.turning[1], 7), "ew-resize"),
                          ((0.6, 7), "ns-resize"), ((2, 3), "pointer")):  # fmt: skip
        found.page.mouse.move(*found.pixel(*place))
        assert found.page.evaluate(cursor) == wanted


def test_the_bead_follows_the_named_clock_alone_and_repeats(figure):
    found = figure(view={"clock": "lab"})
    scene, at = found.scene, "__tippe.plane.selected.theta"
    tell = "([name, t]) => { dispatchEvent(new CustomEvent(name, {detail: {t}})); return __tippe.plane.selected.theta }"
    start = found.page.evaluate(at)
    assert start == pytest.approx(scene.turning[0], abs=1e-6)
    assert found.page.evaluate(tell, ["tippe:clock", 0.2]) == start
    for t in (0.1, 0.3, scene.rolling.period, 50.25 * scene.rolling.period):
        theta = found.page.evaluate(tell, ["tippe:clock:lab", t])
        assert theta == pytest.approx(scene.rolling(np.array([0.0, t])).theta[1], abs=1e-3)
    circles = """() => [...__tippe.plane.bar.ownerSVGElement.querySelectorAll(".bead circle")].slice(0, 2)
        .map((c) => Number(c.getAttribute("cx")) + c.ownerSVGElement.getBoundingClientRect().left)"""
    x = found.pixel(theta, 7)[0]
    assert found.page.evaluate(circles) == pytest.approx([x, x], abs=0.1)  # in both plots


def test_an_old_picture_is_pale_and_says_of_what_it_is(figure):
    found = figure()
    section = found.page.locator("section.plane")
    assert "old" not in section.get_attribute("class")
    explorer = Explorer()
    explorer.set(K_J=1e99)
    found.view.show_selected(explorer.scene)
    found.send()
    found.page.get_by_text("Old picture: KJ = 7, KR = 10, E = 27.9804").wait_for()
    assert "old" in section.get_attribute("class")
    found.view.show_selected(Explorer().scene)
    found.send()
    found.page.wait_for_function("!document.querySelector('main > div').shadowRoot.querySelector('.old')")
    assert not found.page.get_by_text("Old picture").count()


def test_what_is_not_there_yet_is_drawn_when_it_comes(alone):
    found, view, scene = alone(), PlaneView(height=600), Explorer().scene
    found.show(view)
    view.show_selected(scene)
    found.send()
    assert found.page.evaluate(SEEN) == 0
    view.show_plane(scene)
    found.send()
    found.page.wait_for_function(f"{SEEN} > 0")
    drawn = "() => __tippe.plane.bar.ownerSVGElement.querySelectorAll('.path .goes').length"
    assert found.page.evaluate(drawn) == 0
    view.show_slipping(slipping(scene), scene)
    found.send()
    found.page.wait_for_function(f"() => ({drawn})() === 4")
    found.leave(view)
    found.page.evaluate("dispatchEvent(new CustomEvent('tippe:clock', {detail: {t: 1}}))")  # nobody hears it


# ---- a hand ----


def test_what_is_pressed_is_held_at_once_wherever_the_pointer_goes(figure):
    """Also after a rest, and outside the figure, up to the last of it; and the place under the pointer is what is asked
    for."""
    found = figure()
    page, end = found.page, (found.scene.turning[1], 7)
    for grip, start in {"line": (0.62, 7), "end": end, "tieline": (1.1, 3), "point": (2, 5)}.items():
        before = len(hands(found))
        page.mouse.move(*found.pixel(*start))
        page.mouse.down()
        if grip == "end":
            page.wait_for_timeout(500)  # the rest itself
        page.mouse.move(*found.pixel(1.5, 4))  # in one jump
        found.until(lambda: hands(found) and hands(found)[-1][1] == pytest.approx(1.5, abs=1e-6))
        asked = hands(found)[-1]
        grips = [each[0] for each in hands(found)[before:]]  # first may come what the hand before asked for last
        assert {*grips[grips.index(grip) :]} == {grip}
        assert asked[2] == pytest.approx(7 if grip == "end" else 4, abs=1e-6)
        page.mouse.move(-50, 20)
        page.mouse.up()
        found.until(lambda: hands(found)[-1][1] == 0)
        if grip == "tieline":  # let go, it is the nearest
            found.until(lambda: hands(found)[-1][2] in found.scene.plane.K_J)


def test_the_bead_moves_the_clock_and_asks_for_nothing(figure):
    found = figure(view={"clock": "lab"})
    page, scene = found.page, found.scene
    page.evaluate(
        """() => { window.sought = []; addEventListener("tippe:seek:lab", ({detail}) => sought.push(detail)) }"""
    )
    page.mouse.move(*found.pixel(scene.turning[0], 7))
    page.mouse.down()
    page.mouse.move(*found.pixel(0.6, 6))
    page.mouse.up()
    first, last = page.evaluate("sought")
    assert first["held"] and not last["held"] and not hands(found)
    assert scene.rolling(np.array([0.0, last["t"]])).theta[1] == pytest.approx(0.6, abs=1e-3)


def test_a_hand_that_pulls_is_told_why_it_does_not_roll(figure):
    found = figure()
    page = found.page
    page.mouse.move(*found.pixel(found.scene.turning[1], 7))
    page.mouse.down()
    page.mouse.move(*found.pixel(0.9, 7))
    found.until(lambda: hands(found))
    found.view.show_selected(Explorer(energy=1.5).scene)
    found.send()
    page.locator(".tippe-readout:visible", has_text="It would slip on the way").wait_for()
    found.view.show_selected(found.scene)
    found.send()
    page.locator(".tippe-readout").wait_for(state="hidden")
    page.mouse.up()


def touch(page, *places):
    session = page.context.new_cdp_session(page)
    for kind, place in (("touchStart", places[0]), *(("touchMove", place) for place in places[1:]), ("touchEnd", None)):
        points = [] if place is None else [dict(zip("xy", place, strict=True))]
        session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})


def test_a_finger_pulls_the_tieline_and_elsewhere_it_scrolls_or_taps(figure):
    found = figure(high=900, viewport={"width": 390, "height": 500}, is_mobile=True, has_touch=True)
    x, y = found.pixel(0.62, 7)
    touch(found.page, *((x, y + by) for by in range(0, 61, 10)))
    found.until(lambda: hands(found) and hands(found)[-1][2] < 6.5)
    assert hands(found)[-1][0] == "line" and found.page.evaluate("document.querySelector('main').scrollTop") == 0
    count, (x, y) = len(hands(found)), found.pixel(1.6, 5)
    found.page.evaluate("document.querySelector('main').addEventListener('scrollend', () => window.rests = true)")
    touch(found.page, *((x, y - by) for by in range(0, 121, 10)))
    found.page.wait_for_function("window.rests && document.querySelector('main').scrollTop > 40")
    assert len(hands(found)) == count
    found.page.evaluate_handle("__tippe.plane.bar").evaluate(IN_SIGHT)  # until it has stopped
    touch(found.page, found.pixel(2, 5))
    found.until(lambda: len(hands(found)) > count)
    assert hands(found)[-1] == ["point", pytest.approx(2, abs=0.05), pytest.approx(5, abs=0.1)]


# ---- keys, buttons, the ear ----


# All at once: a key counts on the one before for half a second, within which a busy machine presses but one.
PRESS = """(grip, keys) => {
  for (const key of keys) grip.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true, composed: true }))
}"""


def test_arrow_keys_move_what_has_the_focus(figure):
    found = figure()
    page = found.page
    line, end, bead = (page.get_by_role("slider", name=name) for name in listed("roll.plane")["grips"].values())
    line.evaluate(PRESS, ["ArrowUp", "ArrowUp", "ArrowDown", "PageDown"])
    found.until(lambda: len(hands(found)) == 4)
    step = hands(found)[0][2] - 7
    assert step > 0 and [hand[2] for hand in hands(found)] == pytest.approx([7 + n * step for n in (1, 2, 1, -9)])
    end.focus()
    page.keyboard.press("ArrowLeft")
    found.until(lambda: len(hands(found)) == 5)
    assert hands(found)[-1] == ["end", pytest.approx(found.scene.turning[1] - 0.01), 7]
    page.evaluate("""() => { addEventListener("tippe:seek:lab", ({detail}) => (window.sought = detail)) }""")
    bead.focus()
    page.keyboard.press("ArrowRight")
    assert page.evaluate("sought")["t"] == pytest.approx(found.scene.rolling.period / 64)
    assert line.get_attribute("aria-valuetext") == "7" and end.get_attribute("aria-valuetext") == "43.7°"


def test_a_press_on_a_button_is_sent_and_the_figure_stays_where_it_is(figure):
    found = figure(arrives())
    page = found.page
    before = found.pixel(1, 1)
    for road in ("slip", "paper"):
        page.get_by_role("button", name=listed("roll.roads")[road]).click()
    found.until(lambda: [value for _, name, value in found.told if name == "pressed"] == [[1, "slip"], [2, "paper"]])
    found.view.show_selected(Explorer().scene)
    found.send()
    page.get_by_role("button").first.wait_for(state="hidden")
    assert json.loads(found.view.state)["roads"] == [] and found.pixel(1, 1) == before


# As the page does it: app/frontend/src/widgets/look.js.
LOOK = """look => {
  __tippe.wear(look)
  document.documentElement.style.setProperty("--card", look.startsWith("dark") ? "#0e1318" : "#fff")
  document.body.style.background = "var(--card)"
  dispatchEvent(new CustomEvent("tippe:look"))
}"""


def test_it_is_said_what_is_selected_axe_finds_nothing_and_a_look_is_taken_at_once(figure):
    found = figure({"energy": 1.5})
    said = found.page.locator("svg[role=group]").get_attribute("aria-label")
    inner, outer = np.degrees(found.scene.turning)
    assert said.startswith(listed("roll.figures")["plane"]) and "would slip on the way" in said
    assert f"constant 7, tilts from {inner:.1f} to {outer:.1f} degrees" in said
    size = "() => getComputedStyle(__tippe.plane.bar.ownerSVGElement).fontSize"
    for look, high in (("", "12px"), ("dark large", "16px")):
        found.page.evaluate(LOOK, look)
        assert found.page.evaluate(size) == high
        assert violations(found.page) == [], look
