"""The bundled components in a browser, fed with made-up motion: what is drawn is what was sent.

The page as a whole has its own tests; here one component stands alone, so a failure says where it is.
"""

import numpy as np
import panel as pn
import pytest
from visiting import free_port, wait

from app.bundle import Bundled, pack
from app.widgets.controls import Control
from app.widgets.surface3d import Surface3D
from app.widgets.top3d import Top3D, pack_frames

pytestmark = pytest.mark.served


def test_the_notice_of_three_travels_with_the_bundle():
    static = Bundled._bundle.parent
    assert "@license" in Bundled._bundle.read_text(encoding="utf-8")
    assert "three.js authors" in (static / "THIRD_PARTY_NOTICES.txt").read_text(encoding="utf-8")


N = 40
T = np.linspace(0, 4, N)


def frames(tilt=0.4, regime=0):
    """An invented motion, not that of a top: a rotation about z, and a circle of the contact."""
    turn = 1.5 * T
    half, spun = tilt / 2, turn / 2
    quaternion = np.column_stack(
        [
            np.sin(half) * np.cos(spun),
            np.sin(half) * np.sin(spun),
            np.cos(half) * np.sin(spun),
            np.cos(half) * np.cos(spun),
        ]
    )
    contact = np.column_stack([np.cos(T), np.sin(T)])
    com = np.column_stack([contact, np.full(N, 0.93)])
    up = np.tile([0.1, 0.2, 1.0], (N, 1))
    packed = pack_frames(T, quaternion, contact, com, np.full(N, tilt), up, 8 * up, 3 * up, np.full(N, regime))
    return packed, quaternion, contact


OUTLINE = pack([[0, -1], [0.7, -0.7], [1, 0], [0.85, 0.5], [0.2, 0.5], [0.2, 1.7], [0, 1.7]])


@pytest.fixture
def serve(chromium):
    """serve(component) gives the page that shows it."""
    servers, pages = [], []

    def start(component, ready="Object.values(window.__tippe ?? {}).some(view => view.pictures > 0)", **context):
        column = pn.Column(component, width=640)
        port = free_port()
        servers.append(pn.serve(column, port=port, threaded=True, show=False))
        page = chromium.new_context(viewport={"width": 720, "height": 600}, **context).new_page()
        pages.append(page)
        page.goto(f"http://localhost:{port}/")
        page.wait_for_function(ready)
        return page, column

    yield start
    for page in pages:
        page.context.close()
    for server in servers:
        server.stop()


def drawn(page, name):
    return page.evaluate(f"window.__tippe.top3d.{name}")


def assert_pose(page, quaternion, contact, index):
    page.wait_for_function(
        "want => Math.abs(window.__tippe.top3d.position[0] - want) < 1e-6", arg=float(np.float32(contact[index, 0]))
    )
    # float32 on the wire: seven digits.
    np.testing.assert_allclose(drawn(page, "quaternion"), quaternion[index], atol=2e-7)
    np.testing.assert_allclose(drawn(page, "position"), [*contact[index], 1], atol=2e-7)


@pytest.fixture
def top():
    return Top3D(frames=frames()[0], profile=OUTLINE, playing=False, height=400, sizing_mode="stretch_width")


def test_steps_and_scrubs_show_exact_frames_and_tell_python(serve, top):
    _, quaternion, contact = frames()
    page, _ = serve(top)
    assert_pose(page, quaternion, contact, 0)
    page.get_by_label("One frame forward").click()
    assert_pose(page, quaternion, contact, 1)
    page.get_by_label("One frame back").click()
    page.get_by_label("One frame back").click()
    assert_pose(page, quaternion, contact, N - 1)
    page.get_by_label("Time").fill("17")
    assert_pose(page, quaternion, contact, 17)
    wait(page, lambda: abs(top.time - T[17]) < 1e-6)


def test_seeks_from_python_and_from_the_page(serve, top):
    _, quaternion, contact = frames()
    page, _ = serve(top)
    top.time = float(T[9])
    assert_pose(page, quaternion, contact, 9)
    page.evaluate("t => window.dispatchEvent(new CustomEvent('tippe:seek', {detail: {t}}))", float(T[23]))
    assert_pose(page, quaternion, contact, 23)
    wait(page, lambda: abs(top.time - T[23]) < 1e-6)


def test_a_new_motion_is_drawn_at_the_same_time(serve, top):
    page, _ = serve(top)
    top.time = float(T[9])
    page.wait_for_function("window.__tippe.top3d.index === 9")
    packed, quaternion, contact = frames(tilt=1.1, regime=1)
    top.frames = packed
    page.wait_for_function("window.__tippe.top3d.verdict === 'would slip here'")
    assert_pose(page, quaternion, contact, 9)


def test_plays_without_traffic_and_pauses_on_a_frame(serve, top):
    page, _ = serve(top)
    page.evaluate("""() => {
        window.sent = 0; window.ticks = 0;
        const send = WebSocket.prototype.send;
        WebSocket.prototype.send = function (...args) { window.sent += 1; return send.apply(this, args) };
        window.addEventListener("tippe:clock", () => { window.ticks += 1 });
    }""")
    page.get_by_label("Play").click()
    wait(page, lambda: top.playing)
    sent = page.evaluate("window.sent")
    page.evaluate("window.ticks = 0")
    page.wait_for_function("window.ticks > 20")
    assert page.evaluate("window.sent") == sent
    page.get_by_label("Pause").click()
    wait(page, lambda: not top.playing and top.time > 0)
    assert np.abs(T - top.time).min() < 1e-6
    assert drawn(page, "t") == pytest.approx(top.time)


def test_starts_paused_where_a_person_prefers_less_motion(serve):
    moving = Top3D(frames=frames()[0], profile=OUTLINE, height=400, sizing_mode="stretch_width")
    page, _ = serve(moving, reduced_motion="reduce")
    wait(page, lambda: not moving.playing)
    assert drawn(page, "playing") is False


def test_lets_go_of_everything_when_removed(serve, top):
    page, column = serve(top)
    page.evaluate("""() => {
        window.lost = false;
        const find = root => root.querySelector("canvas") ??
          [...root.querySelectorAll("*")].map(e => e.shadowRoot && find(e.shadowRoot)).find(Boolean);
        find(document).addEventListener("webglcontextlost", () => { window.lost = true });
    }""")
    column.clear()
    page.wait_for_function("window.lost && !window.__tippe.top3d")


def test_no_motion_is_said_and_a_later_one_shown(serve, top):
    top.frames = b""
    page, _ = serve(top)
    assert drawn(page, "verdict") == "no motion to show"
    top.frames, quaternion, contact = frames()
    page.wait_for_function("window.__tippe.top3d.verdict === 'rolls'")
    assert_pose(page, quaternion, contact, 0)


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


def test_the_surface_holds_what_was_sent_reads_it_off_and_tells_what_was_picked(serve):
    K_J, share = np.linspace(0, 8, 9), np.linspace(0, 1, 12)
    theta = 0.2 + 0.05 * K_J[:, None] + share
    height = 8 * share * (1 - share) * np.ones_like(theta)
    height[3] = np.nan  # no motion: a gap, not a wall
    surface = Surface3D(
        K_J=pack(K_J), theta=pack(theta), heights=pack(height), energy=pack(20 + K_J), theta_max=1.8, height=400,
        selected=pack([2, 0.3, 1.3]), selected_curve=pack(np.column_stack([theta[2], height[2]])),
        sizing_mode="stretch_width")  # fmt: skip
    page, _ = serve(surface)
    page.wait_for_function("window.__tippe.surface3d.rows === 9 && window.__tippe.surface3d.columns === 12")
    np.testing.assert_allclose(page.evaluate("window.__tippe.surface3d.theta"), theta.ravel(), rtol=1e-7)

    over_the_surface(page)
    page.mouse.down()
    page.mouse.up()
    wait(page, lambda: len(surface.picked) == 2)
    row = np.abs(K_J - surface.picked[0]).argmin()
    assert surface.picked[0] == pytest.approx(K_J[row])
    assert np.abs(theta[row] - surface.picked[1]).min() < 1e-6
    page.wait_for_function("window.__tippe.surface3d.readout.includes('rad')")
    assert f"E = {20 + K_J[row]:.4f}" in page.evaluate("window.__tippe.surface3d.readout")

    surface.param.update(K_J=pack(K_J[:5]), theta=pack(theta[:5] + 0.1), heights=pack(height[:5]), energy=pack(K_J[:5]))
    page.wait_for_function("window.__tippe.surface3d.rows === 5")
    np.testing.assert_allclose(page.evaluate("window.__tippe.surface3d.theta"), (theta[:5] + 0.1).ravel(), rtol=1e-6)


def test_a_control_is_told_only_what_answers_its_last_wish(serve):
    asked = []
    control = Control("K_J", 7.0, lambda name, value, typed=False: asked.append((value, typed)))
    page, _ = serve(control.view, ready="Bokeh.documents[0]?.is_idle")
    slider, entry = page.get_by_role("slider", name="Jellett’s constant"), page.get_by_role("textbox")
    for _ in range(3):
        slider.press("ArrowLeft")
    wait(page, lambda: len(asked) == 3)
    assert asked == [(6.99, False), (6.98, False), (6.97, False)]
    assert slider.get_attribute("aria-valuetext") == "6.97 root g over R"
    control.view.told = [1, 6.99, "6.99"]  # an answer to the first request after the next one was sent
    control.view.words = "said"
    page.get_by_text("said").wait_for()
    assert slider.input_value() == "6.97" and entry.input_value() == "6.97"

    control.follow(6.5, 6.5)  # something else changed it
    page.wait_for_function("input => input.value == '6.5'", arg=slider.element_handle())
    assert entry.input_value() == "6.5"
    entry.fill("half")
    control.follow(6.4, 6.4)  # typed text is not overwritten
    page.wait_for_function("input => input.value == '6.4'", arg=slider.element_handle())
    assert entry.input_value() == "half"
    entry.press("Enter")
    page.get_by_role("alert").get_by_text("not a number").wait_for()
    entry.fill("−2,5")
    entry.press("Enter")
    wait(page, lambda: len(asked) == 4)
    assert asked[3] == (-2.5, True)  # and no value from Python came back as a request
