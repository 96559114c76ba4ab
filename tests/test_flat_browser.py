"""A browser without WebGL: the top is drawn flat, and everything that controls its clock or saves it still works."""

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


def test_a_flat_top_follows_links_keys_and_figures_and_is_saved(chromium, server, page_errors):
    page_errors.allow("WebGL")
    motion = solve(Top.paper(), 7.0, 10.0, 0.5, 0.9).trajectory
    context = chromium.new_context(viewport={"width": 1400, "height": 900}, reduced_motion="reduce")
    page = context.new_page()
    page.add_init_script(NO_WEBGL)
    visit = Visit(page, f"{server}?v=1&tab=roll&t={float(motion.t[23])!r}", whole=False)
    page.locator("p:text('no WebGL, so the top is drawn flat'):visible").first.wait_for()
    page.wait_for_function(WHOLE)
    bar = page.locator("input.scrub:visible").first.element_handle()

    def until_scrubbed(index):
        page.wait_for_function("([bar, index]) => bar.value == index", arg=[bar, index])

    def until_tilted(theta):
        """Waits until the bar shows a frame with this tilt, and the portrait's bead as well."""
        near = np.flatnonzero(np.abs(motion.theta - theta) < 0.02).tolist()
        page.wait_for_function(
            """([column, bar, near, theta]) =>
                near.includes(Number(bar.value)) && Math.abs(eval(column)(["phase", 2, "x"])[0] - theta) < 0.02""",
            arg=[COLUMN, bar, near, theta])  # fmt: skip

    # the time of a link, and the keys
    until_scrubbed("23")
    page.locator("button[aria-label=Play]:visible").first.wait_for()
    page.locator("body").press("ArrowRight")
    page.wait_for_function("t => Math.abs(new URLSearchParams(location.search).get('t') - t) < 1e-6",
                           arg=float(motion.t[24]))  # fmt: skip
    for _ in range(2):
        page.locator("body").press("ArrowLeft")
    until_scrubbed("22")
    said = page.get_by_role("status", name="What the top does now").filter(has_text="seconds, rolls.")
    said.wait_for(state="attached")
    page.locator("body").press("Space")
    page.locator("button[aria-label=Pause]:visible").first.wait_for()
    page.wait_for_function("bar => bar.value != 22", arg=bar)
    page.locator("body").press("Space")
    page.locator("button[aria-label=Play]:visible").first.wait_for()
    page.wait_for_function("""() => [...Bokeh.documents[0].all_models]
        .filter((m) => m.type == "Span" && m.level == "overlay")
        .every((m) => Math.abs(m.location - __tippe.flat.t) < 1e-6)""")

    # a hand on a portrait, and on Fig. 6
    page.get_by_role("button", name="phase portrait").scroll_into_view_if_needed()
    x, y = (visit.column("phase", 1, column) for column in "xy")
    i = len(x) // 3
    page.mouse.click(*visit.pixel("phase", x[i], y[i]))
    until_tilted(x[i])
    page.locator("[data-figure=plane]").first.evaluate("e => e.scrollIntoView({block: 'center'})")
    shown, aim = motion.theta[int(bar.input_value())], 0.62
    visit.drag(visit.pixel("plane", shown, 7.0), visit.pixel("plane", aim, 7.0))
    page.mouse.up()
    until_tilted(aim)

    # a picture of it
    page.get_by_role("button", name="Share").click()
    with page.expect_download() as download:
        page.get_by_role("button", name="PNG").first.click()
    picture = np.array(Image.open(download.value.path()).convert("RGB"))
    assert picture.shape[1] == 2400
    body = (picture == (0xE3, 0xB9, 0x81)).all(axis=2)  # the colour of its wood
    assert 0.01 < body.mean() < 0.5
    context.close()
