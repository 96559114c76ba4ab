"""The top, the surface and a control alone in Chromium, fed with made-up motion: what is drawn is what was sent."""

import numpy as np
import pytest
from components import *  # noqa: F403
from PIL import Image

from app.bundle import Bundled, pack
from app.share.parts import Photo
from app.widgets.controls import control, track
from app.widgets.forms import Choice
from app.widgets.numbers import Numbers
from app.widgets.surface3d import Surface3D
from app.widgets.top3d import Top3D, pack_frames

pytestmark = pytest.mark.served


def test_the_notice_of_three_travels_with_the_bundle():
    static = Bundled._bundle.parent
    assert "@license" in Bundled._bundle.read_text(encoding="utf-8")
    assert "three.js authors" in (static / "THIRD_PARTY_NOTICES.txt").read_text(encoding="utf-8")


N = 40
T = np.linspace(0, 4, N)


def frames(tilt=0.4, regime=0, t=T):
    """An invented motion, not that of a top: a rotation about z, and a circle of the contact."""
    half, spun = tilt / 2, 0.75 * t
    quaternion = np.column_stack([
        np.sin(half) * np.cos(spun), np.sin(half) * np.sin(spun), np.cos(half) * np.sin(spun),
        np.cos(half) * np.cos(spun)])  # fmt: skip
    contact = np.column_stack([np.cos(t), np.sin(t)])
    com, up = np.column_stack([contact, np.full(N, 0.93)]), np.tile([0.1, 0.2, 1.0], (N, 1))
    packed = pack_frames(t, quaternion, contact, com, np.full(N, tilt), up, 8 * up, 3 * up, np.full(N, regime))
    return packed, quaternion, contact


OUTLINE = pack([[0, -1], [0.7, -0.7], [1, 0], [0.85, 0.5], [0.2, 0.5], [0.2, 1.7], [0, 1.7]])
DRAWN = "Object.values(window.__tippe ?? {}).some(view => view.pictures > 0)"


def top_of(motion, **more):
    return Top3D(**{"frames": motion, "profile": OUTLINE, "playing": False, "height": 400} | more)


def drawn(page, name):
    return page.evaluate(f"window.__tippe.top3d.{name}")


def assert_pose(page, motion, index):
    _, quaternion, contact = motion
    page.wait_for_function("want => Math.abs(window.__tippe.top3d.position[0] - want) < 1e-6",
                           arg=float(np.float32(contact[index, 0])))  # fmt: skip
    # float32 on the wire: seven digits.
    np.testing.assert_allclose(drawn(page, "quaternion"), quaternion[index], atol=2e-7)
    np.testing.assert_allclose(drawn(page, "position"), [*contact[index], 1], atol=2e-7)


def test_steps_scrubs_and_seeks_show_exact_frames_and_tell_python(alone):
    motion, found = frames(), alone()
    top = top_of(motion[0])
    page = found.show(top)
    page.wait_for_function(DRAWN)
    assert_pose(page, motion, 0)
    page.get_by_label("One frame forward").click()
    assert_pose(page, motion, 1)
    page.get_by_label("One frame back").click()
    page.get_by_label("One frame back").click()
    assert_pose(page, motion, N - 1)
    page.get_by_label("Time").fill("17")
    assert_pose(page, motion, 17)
    found.until(lambda: abs(top.time - T[17]) < 1e-6)
    page.evaluate("t => window.dispatchEvent(new CustomEvent('tippe:seek', {detail: {t}}))", float(T[23]))
    assert_pose(page, motion, 23)
    found.until(lambda: abs(top.time - T[23]) < 1e-6)
    found.put(top, time=float(T[9]))
    assert_pose(page, motion, 9)
    other = frames(tilt=1.1, regime=1)
    found.put(top, frames=other[0])  # another motion is drawn at the same time
    page.wait_for_function("window.__tippe.top3d.verdict === 'would slip here'")
    assert_pose(page, other, 9)


def test_plays_without_traffic_pauses_on_a_frame_and_lets_go_of_everything_when_removed(alone):
    found = alone(draws=True, reduced_motion="no-preference")
    top = top_of(frames()[0])
    page = found.show(top)
    page.wait_for_function(DRAWN)
    page.get_by_label("Play").click()
    found.until(lambda: top.playing)
    page.evaluate("""() => {
        window.ticks = 0
        window.addEventListener("tippe:clock", () => { window.ticks += 1 })
    }""")
    told = len(found.told)
    page.wait_for_function("window.ticks > 5 && __tippe.top3d.t > 0.2")  # so that it pauses on a later frame
    assert len(found.told) == told
    page.get_by_label("Pause").click()
    found.until(lambda: not top.playing and top.time > 0)
    assert np.abs(T - top.time).min() < 1e-6
    assert drawn(page, "t") == pytest.approx(top.time)
    page.locator("canvas").first.evaluate(
        "canvas => canvas.addEventListener('webglcontextlost', () => { window.lost = true })"
    )
    found.leave(top)
    page.wait_for_function("window.lost && !window.__tippe.top3d")


def test_starts_paused_where_less_motion_is_preferred_and_says_where_there_is_none(alone):
    motion, found = frames(), alone()
    top = top_of(b"", playing=True)
    page = found.show(top)
    page.wait_for_function(DRAWN)
    assert drawn(page, "verdict") == "no motion to show"
    found.put(top, frames=motion[0])
    page.wait_for_function("window.__tippe.top3d.verdict === 'rolls'")
    assert_pose(page, motion, 0)
    found.until(lambda: not top.playing)
    assert drawn(page, "playing") is False


def over_the_surface(page):
    """Moves the mouse until the picture shows values, and no end of the tieline is below it."""
    canvas = page.locator("canvas")
    box = canvas.bounding_box()
    for y in np.linspace(0.75, 0.4, 8):
        for x in np.linspace(0.4, 0.7, 8):
            page.mouse.move(box["x"] + x * box["width"], box["y"] + y * box["height"])
            page.evaluate("() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
            says = page.evaluate("window.__tippe.surface3d.readout?.includes('E = ')")  # no surface there
            if says and canvas.evaluate("e => e.style.cursor") != "move":
                return
    raise AssertionError("no place of the picture reads a value off")


def test_the_surface_holds_what_was_sent_reads_it_off_and_tells_what_was_picked(alone):
    K_J, share = np.linspace(0, 8, 9), np.linspace(0, 1, 12)
    theta = 0.2 + 0.05 * K_J[:, None] + share
    height = 8 * share * (1 - share) * np.ones_like(theta)
    height[3] = np.nan  # no motion: a gap, not a wall
    surface = Surface3D(
        K_J=pack(K_J), theta=pack(theta), heights=pack(height), energy=pack(20 + K_J), theta_max=1.8, height=400,
        selected=pack([2, 0.3, 1.3]), selected_curve=pack(np.column_stack([theta[2], height[2]])))  # fmt: skip
    found = alone(draws=True, viewport={"width": 720, "height": 600})
    page = found.show(surface)
    page.wait_for_function("window.__tippe?.surface3d?.rows === 9 && window.__tippe.surface3d.columns === 12")
    np.testing.assert_allclose(page.evaluate("window.__tippe.surface3d.theta"), theta.ravel(), rtol=1e-7)

    over_the_surface(page)
    page.mouse.down()
    page.mouse.up()
    found.until(lambda: len(surface.hand) == 3)
    grip, angle, up = surface.hand
    row = np.abs(K_J - up).argmin()
    assert grip == "tieline" and up == pytest.approx(K_J[row])
    assert np.abs(theta[row] - angle).min() < 1e-6
    page.wait_for_function("window.__tippe.surface3d.readout.includes('rad')")
    assert f"E = {20 + K_J[row]:.4f}" in page.evaluate("window.__tippe.surface3d.readout")

    found.put(surface, K_J=pack(K_J[:5]), theta=pack(theta[:5] + 0.1), heights=pack(height[:5]), energy=pack(K_J[:5]))
    page.wait_for_function("window.__tippe.surface3d.rows === 5")
    np.testing.assert_allclose(page.evaluate("window.__tippe.surface3d.theta"), (theta[:5] + 0.1).ravel(), rtol=1e-6)


def test_a_control_is_told_only_what_answers_its_last_wish(alone):
    asked, found = [], alone()
    group = Numbers([control("K_J")], lambda name, value, typed: asked.append((name, value, typed)))

    def show(value):
        group.show({"K_J": value}, {"K_J": track("K_J", value)}, notes={"K_J": "said"})

    show(7.0)
    page = found.show(group.view)
    slider, field = page.get_by_role("slider", name="Jellett’s constant"), page.get_by_role("textbox")
    for _ in range(3):
        slider.press("ArrowLeft")
    found.until(lambda: asked == [("K_J", 6.99, False)])  # one at a time; of those that wait, the newest
    assert slider.get_attribute("aria-valuetext") == "6.97 root g over R"
    show(6.99)  # an answer to the first request after the next one was made
    found.send()
    found.until(lambda: len(asked) == 2)
    assert asked[1] == ("K_J", 6.97, False)
    assert slider.input_value() == "6.97" and field.input_value() == "6.97"
    show(6.5)  # something else changed it
    found.send()
    page.wait_for_function("input => input.value == '6.5'", arg=slider.element_handle())
    assert field.input_value() == "6.5"
    field.fill("half")
    show(6.4)  # typed text is not overwritten
    found.send()
    page.wait_for_function("input => input.value == '6.4'", arg=slider.element_handle())
    assert field.input_value() == "half"
    field.press("Enter")
    page.get_by_role("alert").get_by_text("not a number").wait_for()
    assert field.input_value() == "half"
    page.get_by_role("button", name="Back to 6.4").click()
    page.get_by_role("alert").wait_for(state="hidden")
    assert field.input_value() == "6.4" and len(asked) == 2  # no motion was made of a text


def test_a_typed_number_is_sent_as_typed_and_escape_brings_back_what_was(alone):
    asked, found = [], alone()
    group = Numbers([control("energy", marks=enumerate(["steady", "slips", "lifts off"]))],
                    lambda name, value, typed: asked.append((name, value, typed)))  # fmt: skip
    group.show({"energy": 0.5}, {"energy": track("energy", 0.5)}, fields={"energy": 26.9})
    page = found.show(group.view)
    slider, field = page.get_by_role("slider", name="energy"), page.get_by_role("textbox")
    assert slider.get_attribute("aria-valuetext") == "50 percent of the way from steady to slips"
    field.fill("30")
    field.press("Escape")
    assert field.input_value() == "26.9" and not asked
    field.fill("28")
    field.press("Enter")
    found.until(lambda: asked == [("energy", 28, True)])
    field.fill("−2,5")
    group.show({"energy": 0.5}, {"energy": track("energy", 0.5)}, fields={"energy": 26.9})  # the answer
    found.send()
    field.press("Enter")
    found.until(lambda: asked[1:] == [("energy", -2.5, True)])  # and nothing from Python came back as a request
    assert slider.input_value() == "0.5"  # its slider has the share between the marks, the field E


def test_a_choice_is_of_its_values_by_hand_and_from_python(alone):
    found, choice = alone(), Choice({"one": 0, "two": 1, "three": 2}, 0, "Which")
    page = found.show(choice)
    one, two, three = (page.get_by_role("radio", name=name) for name in choice.options)
    two.click()
    found.until(lambda: choice.value == 1)
    two.press("ArrowRight")
    found.until(lambda: choice.value == 2)
    assert three.get_attribute("aria-checked") == "true" and three.evaluate("e => e.getRootNode().activeElement === e")
    found.put(choice, value=0)
    page.wait_for_function("e => e.ariaChecked === 'true'", arg=one.element_handle())
    assert three.get_attribute("aria-checked") == "false" and [news for *_, news in found.told] == [1, 2]
    found.put(choice, options={"four": 0, "five": 7})
    page.get_by_role("radio", name="five").click()
    found.until(lambda: choice.value == 7)


NO_WEBGL = """const real = HTMLCanvasElement.prototype.getContext
HTMLCanvasElement.prototype.getContext = function(kind, ...more) {
    return kind.startsWith("webgl") ? null : real.call(this, kind, ...more) }"""


@pytest.fixture
def flat(alone, page_errors):
    """flat(**like) gives an Alone in a browser without WebGL."""
    page_errors.allow("WebGL")

    def open_(**like):
        found = alone(**like)
        found.page.evaluate(f"() => {{ {NO_WEBGL} }}")
        return found

    return open_


FLAT = "p:text('no WebGL, so the top is drawn flat')"


def test_a_flat_top_goes_with_the_clock_and_is_saved(flat):
    """It begins at the time of a link; its buttons, and a figure that seeks."""
    motion, found = frames(), flat()
    top = top_of(motion[0], time=float(T[23]))
    page = found.show(top, Photo())
    page.locator(FLAT).wait_for()

    def until_at(index):
        page.wait_for_function("index => __tippe.flat?.index == index && __tippe.flat.pictures > 0", arg=index)

    until_at(23)
    page.get_by_label("One frame forward").click()
    found.until(lambda: abs(top.time - T[24]) < 1e-6)
    page.evaluate("t => window.dispatchEvent(new CustomEvent('tippe:seek', {detail: {t}}))", float(T[9]))
    until_at(9)
    assert page.evaluate("__tippe.flat.verdict") == "rolls"
    page.get_by_label("Play").click()
    page.wait_for_function("__tippe.flat.playing && __tippe.flat.index > 9")
    page.get_by_label("Pause").click()
    found.until(lambda: not top.playing and np.abs(T - top.time).min() < 1e-6)
    with page.expect_download() as download:
        page.get_by_role("button", name="PNG").click()
    picture = np.array(Image.open(download.value.path()).convert("RGB"))
    assert picture.shape[1] == 2400
    body = (picture == (0xE3, 0xB9, 0x81)).all(axis=2)  # the colour of its wood
    assert 0.01 < body.mean() < 0.5


def test_tops_of_one_clock_play_as_one_also_where_they_are_drawn_flat(flat):
    """Each shows its own motion at the same time: playing one moves the others along."""
    found = flat(reduced_motion="no-preference")
    tops = [top_of(frames(t=T * (1 + i / 9))[0], clock="planes", height=320) for i in range(3)]
    page = found.show(*tops)
    assert page.locator(FLAT).count() == 3
    times = "() => __tippe.tops('planes').filter((top) => top.count > 1).map((top) => top.t)"
    page.wait_for_function(f"() => ({times})().length == 3")
    page.get_by_label("Play").first.click()
    page.wait_for_function(f"() => ({times})().every((t) => t > 0.05)")
    page.get_by_label("Pause").first.click()
    page.wait_for_function("() => __tippe.tops('planes').every((top) => !top.playing)")
    first, *others = page.evaluate(times)
    assert others == pytest.approx([first] * 2, abs=0.12)
