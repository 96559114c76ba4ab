"""A browser without WebGL: the top is drawn flat, and everything that controls its clock or saves it still works."""

import io

import numpy as np
import pytest
from PIL import Image
from visiting import COLUMN, WHOLE, Visit

from app.model.scene import solve
from tippe_core import Top

pytestmark = pytest.mark.served

NO_WEBGL = """const real = HTMLCanvasElement.prototype.getContext
HTMLCanvasElement.prototype.getContext = function(kind, ...more) {
    return kind.startsWith("webgl") ? null : real.call(this, kind, ...more) }"""


@pytest.fixture
def flat(chromium, server, page_errors):
    """flat(query="") gives a Visit without WebGL with the whole first tab."""
    page_errors.allow("WebGL")
    pages = []

    def go(query=""):
        page = chromium.new_page(viewport={"width": 1400, "height": 900})
        pages.append(page)
        page.add_init_script(NO_WEBGL)
        visit = Visit(page, server + query, whole=False)
        page.locator("p:text('no WebGL, so the top is drawn flat'):visible").first.wait_for()
        if "tab=" not in query:  # the cards of Roll are created when it is shown
            page.wait_for_function(WHOLE)
        return visit

    yield go
    for page in pages:
        page.close()


def seek(visit, index):
    """Goes to a frame; nothing has the focus."""
    t = float(solve(Top.paper(), 7.0, 10.0, 0.5, 0.9).trajectory.t[index])
    visit.page.evaluate("t => window.dispatchEvent(new CustomEvent('tippe:seek', {detail: {t}}))", t)
    until_scrubbed(visit, str(index))


def stop(visit):
    """Goes to the start, where the axis is most upright."""
    visit.page.locator("button:is([aria-label=Pause], [aria-label=Play]):visible").first.wait_for()
    pause = visit.page.locator("button[aria-label=Pause]:visible")
    if pause.count():
        visit.page.locator("body").press("Space")  # a click would leave the focus on the button
    visit.page.locator("button[aria-label=Play]:visible").first.wait_for()
    seek(visit, 0)


def scrubbed(visit):
    """The frame that the bar of the top shows."""
    return int(visit.page.locator("input.scrub:visible").first.input_value())


def until_scrubbed(visit, index):
    bar = visit.page.locator("input.scrub:visible").first.element_handle()
    visit.page.wait_for_function("([bar, index]) => bar.value == index", arg=[bar, index])


def until_tilted(visit, motion, theta):
    """Waits until the bar shows a frame of this motion with this tilt, and the portrait's bead as well."""
    near = np.flatnonzero(np.abs(motion.theta - theta) < 0.02).tolist()
    visit.page.wait_for_function(
        """([column, bar, near, theta]) =>
            near.includes(Number(bar.value)) && Math.abs(eval(column)(["phase", 2, "x"])[0] - theta) < 0.02""",
        arg=[COLUMN, visit.page.locator("input.scrub:visible").first.element_handle(), near, theta])  # fmt: skip


def test_a_hand_on_a_portrait_and_on_fig_6_moves_the_clock(flat):
    visit = flat()
    stop(visit)
    motion = solve(Top.paper(), 7.0, 10.0, 0.5, 0.9).trajectory
    until_tilted(visit, motion, motion.theta[0])
    visit.page.get_by_role("button", name="phase portrait").scroll_into_view_if_needed()
    x, y = (visit.column("phase", 1, column) for column in "xy")
    i = len(x) // 3
    visit.page.mouse.click(*visit.pixel("phase", x[i], y[i]))
    until_tilted(visit, motion, x[i])

    aim = 0.62
    visit.page.locator("[data-figure=plane]").first.evaluate("e => e.scrollIntoView({block: 'center'})")
    visit.drag(visit.pixel("plane", motion.theta[scrubbed(visit)], 7.0), visit.pixel("plane", aim, 7.0))
    visit.page.mouse.up()
    until_tilted(visit, motion, aim)


def test_space_and_the_arrows_are_the_clocks_and_what_is_said_names_the_motion(flat):
    visit = flat()
    page = visit.page
    stop(visit)
    page.locator("body").press("Space")
    page.wait_for_function("__tippe.flat.t != 0")
    page.locator("body").press("Space")
    page.locator("button[aria-label=Play]:visible").first.wait_for()
    page.wait_for_function("""() => [...Bokeh.documents[0]._all_models.values()]
        .filter((m) => m.type == "Span" && m.level == "overlay")
        .every((m) => Math.abs(m.location - __tippe.flat.t) < 1e-6)""")
    seek(visit, 17)
    page.locator("body").press("ArrowRight")
    until_scrubbed(visit, "18")
    page.locator("body").press("ArrowLeft")
    page.locator("body").press("ArrowLeft")
    until_scrubbed(visit, "16")
    said = page.get_by_role("status", name="What the top does now").filter(has_text="seconds, rolls.")
    said.wait_for(state="attached")
    page.locator("body").press("Space")
    page.locator("button[aria-label=Pause]:visible").first.wait_for()
    page.wait_for_function("bar => bar.value != 16", arg=page.locator("input.scrub:visible").first.element_handle())


def test_the_time_of_a_link_is_shown_and_kept(flat):
    motion = solve(Top.paper(), 7.0, 10.0, 0.5, 0.9).trajectory
    visit = flat(f"?v=1&t={float(motion.t[23])!r}")
    until_scrubbed(visit, "23")
    visit.page.locator("button[aria-label=Play]:visible").first.wait_for()
    visit.page.locator("body").press("ArrowRight")
    visit.page.wait_for_function("t => Math.abs(new URLSearchParams(location.search).get('t') - t) < 1e-6",
                                 arg=float(motion.t[24]))  # fmt: skip


def test_png_saves_the_top_as_it_is_drawn(flat):
    """When it is tilted, its dark outline leans to the right of the middle."""
    visit = flat()
    stop(visit)
    visit.page.get_by_role("button", name="Share").click()
    with visit.page.expect_download() as waiting:
        visit.page.get_by_role("button", name="PNG").first.click()
    picture = np.array(Image.open(io.BytesIO(open(waiting.value.path(), "rb").read())).convert("RGB"))
    assert picture.shape[1] == 2400
    body = (picture == (0xE3, 0xB9, 0x81)).all(axis=2)  # the colour of its wood
    assert 0.01 < body.mean() < 0.5


def test_tops_of_one_clock_play_as_one(flat):
    """The three tops of Three planes show their own motions at the same time: stepping one moves the others along."""
    visit = flat("?v=1&tab=three-planes&plane=compare")
    times = "() => __tippe.tops('planes').filter((top) => top.count > 1).map((top) => top.t)"
    visit.page.wait_for_function(f"() => ({times})().length == 3")
    before = visit.page.evaluate(times)
    visit.page.wait_for_function(f"before => ({times})().every((t, i) => t != before[i])", arg=before)
    visit.page.locator("body").press("Space")
    visit.page.wait_for_function("() => __tippe.tops('planes').every((top) => !top.playing)")
    first, *others = visit.page.evaluate(times)
    assert others == pytest.approx([first] * 2, abs=0.1)
