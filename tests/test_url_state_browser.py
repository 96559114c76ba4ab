"""Keeping the state, in Chromium: link, QR code, undo, and files that are opened and compared."""

import io
import json
import re

import numpy as np
import pandas as pd
import pytest
import zxingcpp
from PIL import Image
from visiting import IN_SIGHT, Visit, entry, wait
from wire import Visitor, run

from app.model.scene import solve
from tippe_core import Top

pytestmark = pytest.mark.served

# A hash of the motion as the 3-D view has it.
FRAMES = """async () => {
  const found = Bokeh.documents.flatMap((doc) => [...doc.all_models]).find((m) => m.data?.frames_rough)
  const hash = await crypto.subtle.digest("SHA-256", found.data.frames_rough)
  return Array.from(new Uint8Array(hash)).join()
}"""
SELECTED = "() => ({ ...__tippe.plane.selected, theta: 0 })"  # what Fig. 6 shows, without where its bead is
PAPERS = "?v=3&tab=roll"


@pytest.fixture
def go(chromium):
    """Opens an address in a new browser context; an error in the page fails the test."""
    visits = []

    def open_(url, **like):
        visits.append(Visit(chromium.new_page(viewport={"width": 1400, "height": 900}, **like), url))
        return visits[-1]

    yield open_
    for visit in visits:
        visit.page.close()


def thumb(visit):
    return visit.page.get_by_role("slider", name="Jellett’s constant")


def until_address(visit, pattern):
    visit.page.wait_for_function("pattern => new RegExp(pattern).test(location.search)", arg=pattern)


def until_K_J(visit, value):
    visit.page.wait_for_function("value => __tippe.plane.selected.K_J === value", arg=value)


def undo_is_one_step_a_gesture(visit):
    """In the end all is as it was."""
    roll = visit.page.url
    thumb(visit).evaluate(IN_SIGHT)
    box = thumb(visit).bounding_box()
    x, y = box["x"] + 0.7 * box["width"], box["y"] + box["height"] / 2
    visit.page.mouse.move(x, y)
    visit.page.mouse.down()
    for i in range(1, 6):
        before = visit.page.evaluate("__tippe.plane.selected.K_J")
        visit.page.mouse.move(x - 12 * i, y)
        address = visit.page.url
        # the address waits until the drag ends, however long it takes
        visit.page.wait_for_function("K_J => __tippe.plane.selected.K_J !== K_J", arg=before)
        assert visit.page.url == address == roll
    visit.page.mouse.up()
    until_address(visit, "KJ=")
    dragged = visit.page.evaluate("__tippe.plane.selected.K_J")
    undo, redo = (visit.page.get_by_role("button", name=name) for name in ("Undo", "Redo"))
    visit.page.keyboard.press("Control+z")
    until_K_J(visit, 7)
    visit.page.wait_for_function("!/KJ=/.test(location.search)")
    assert visit.page.url == roll
    visit.page.wait_for_function("button => button.disabled", arg=undo.element_handle())
    redo.click()
    until_K_J(visit, dragged)
    undo.click()
    until_K_J(visit, 7)
    visit.page.keyboard.press("Control+Shift+z")
    until_K_J(visit, dragged)
    # in a text field these keys belong to the field
    text = entry(visit.page, "K_J")
    text.fill("5")
    text.press("Control+z")
    visit.page.evaluate("() => new Promise((done) => setTimeout(done, 0))")
    assert visit.page.evaluate("__tippe.plane.selected.K_J") == dragged
    text.press("Escape")
    undo.click()
    until_K_J(visit, 7)
    visit.page.wait_for_function("!/KJ=/.test(location.search)")


def test_a_link_opens_the_same_picture_elsewhere_and_undo_is_one_step_a_gesture(go, server):
    visit = go(server + PAPERS, reduced_motion="reduce")
    until_address(visit, "v=4.*level=research")  # as the page itself writes it
    undo_is_one_step_a_gesture(visit)
    steps = visit.page.evaluate("history.length")
    slider = thumb(visit)
    slider.focus()
    slider.press("ArrowLeft")
    until_address(visit, "KJ=6\\.99")
    visit.page.locator(".paces .speed").select_option(str(1 / 4))
    until_address(visit, "slow=4")
    for act in ("Play", "Pause"):
        visit.page.get_by_role("button", name=act, exact=True).click()
    until_address(visit, "[?&]t=")
    assert visit.page.evaluate("history.length") == steps  # the entry was replaced, none was added
    visit.page.get_by_role("button", name="More", exact=True).click()
    visit.page.get_by_label("dark", exact=True).click()
    for key in ("Shift+ArrowRight", "Shift+ArrowUp", "-"):
        visit.page.locator("canvas[aria-label^='The top']").first.press(key)
    until_address(visit, "view=[^&]*_1\\.4.*dark=yes")  # after the last change
    visit.page.get_by_role("button", name="Share").click()
    box = visit.page.get_by_label("Link to what is shown")
    visit.page.wait_for_function("box => box.value", arg=box.element_handle())
    link = box.input_value()
    assert link == visit.page.url and len(link) < 300
    code = visit.page.locator("svg:has(title:text-is('QR code of the link'))")
    found = zxingcpp.read_barcodes(Image.open(io.BytesIO(code.screenshot())))
    assert [code.text for code in found] == [link]

    other = go(link)
    other.page.wait_for_function("t => window.__tippe?.top3d?.t === t", arg=visit.page.evaluate("__tippe.top3d.t"))
    assert visit.page.evaluate(SELECTED) == other.page.evaluate(SELECTED)
    for column in ("K_J", "slip_in", "verge"):
        assert np.array_equal(visit.column("plane", 0, column), other.column("plane", 0, column))
    assert visit.page.evaluate(FRAMES) == other.page.evaluate(FRAMES)
    assert not other.page.evaluate("__tippe.top3d.playing")
    eye = visit.page.evaluate("__tippe.top3d.eye")
    assert other.page.evaluate("__tippe.top3d.eye") == pytest.approx(eye, abs=2e-3)
    assert other.page.evaluate("document.documentElement.dataset.look") == "dark"
    assert other.page.locator(".paces .speed").input_value() == str(1 / 4)
    assert thumb(other).input_value() == slider.input_value()


@pytest.mark.parametrize("query", ["?KJ=%3Cscript%3Ealert(1)%3C/script%3E", "?body=" + 9_000 * "Z%3C"],
                         ids=["script", "long"])  # fmt: skip
def test_a_bad_link_says_so_and_shows_the_first_motion(server, query):
    async def visit():
        visitor = await Visitor.enter(server + query)
        visitor.leave()
        return visitor

    visitor = run(visit())
    [said] = re.findall(r'role="alert">(.*?link.*?)</div>', visitor.says)
    assert "<script" not in said and len(said) < 500
    states = [json.loads(visitor.models[group][1]["state"]) for group in visitor.find("NumberControls", "state")]
    if "KJ" in query:
        assert states[0]["values"]["K_J"] == 7
    else:  # of which nothing is read: the arrival
        [lab] = [visitor.models[lab][1] for lab in visitor.find("LabView", "state")]
        assert json.loads(lab["state"])["values"]["spin"] == 28.65


def test_what_is_saved_is_what_is_shown(go, server, chromium, tmp_path):
    visit = go(server + "?v=1&KJ=6.5&mu=.4", draws=True, reduced_motion="reduce")
    scene = solve(Top.paper(), 6.5, 10.0, 0.4, 0.9)
    visit.page.get_by_role("button", name="Share").click()
    visit.page.locator("summary", has_text="The paper’s figures of this motion").click()

    def button(says, label):
        """The field to the right of these words."""
        words = visit.page.get_by_text(says, exact=True).first.bounding_box()
        for found in visit.page.get_by_role("button", name=label, exact=True).all():
            box = found.bounding_box()
            if box and abs(box["y"] + box["height"] / 2 - words["y"] - words["height"] / 2) < 20:
                return found
        return None  # the page is still being laid out

    def save(says, label):
        visit.page.get_by_role("button", name=label, exact=True).last.wait_for()
        with visit.page.expect_download() as download:
            wait(visit.page, lambda: button(says, label)).click()
        path = tmp_path / download.value.suggested_filename
        download.value.save_as(path)
        return path

    table = pd.read_csv(save("Data", "CSV"), comment="#")
    assert np.array_equal(table["theta (rad)"], scene.trajectory.theta)
    assert np.array_equal(table["K_J ((g/R)^1/2)"], scene.K_J)
    with np.load(save("Data", "NumPy")) as arrays:
        assert np.array_equal(arrays["slip_theta_inner"], scene.plane.slip.theta_inner)
    figure = save("Fig. 6: which motions roll", "SVG").read_text(encoding="utf-8")
    assert "$K_J$ = 6.5" in figure
    still = Image.open(save("The top", "PNG"))
    assert still.width == 2400
    assert len(still.convert("RGB").resize((240, 160)).getcolors(100_000)) > 500  # not blank

    page = save("One page to mail", "HTML")
    assert page.stat().st_size < 3_200_000  # with the runs on three tables, and Bokeh
    visit.page.close()  # otherwise both are drawn all the time
    context = chromium.new_context(draws=True, offline=True, reduced_motion="no-preference")
    mailed, asked = context.new_page(), []
    mailed.on("request", lambda request: asked.append(request.url))
    mailed.goto(page.as_uri())
    mailed.wait_for_function("window.__tippe?.tops?.('lab')[0]?.pictures > 2 && __tippe.surface3d?.pictures > 0")
    start = mailed.evaluate("__tippe.tops('lab')[0].t")
    mailed.wait_for_function("t => __tippe.tops('lab')[0].t != t", arg=start)
    spans = """() => Bokeh.documents.flatMap((doc) => [...doc.all_models])
        .filter((m) => m.type == "Span" && m.level == "overlay")"""
    mailed.get_by_role("button", name="Pause").click()
    follows = "Math.abs(m.location - unit * __tippe.tops('lab')[0].t) < 1e-9"
    mailed.wait_for_function(f"unit => ({spans})().every((m) => {follows})", arg=scene.scales.time)
    mailed.wait_for_function("window.__tippe.plane?.pictures > 0")
    mailed.evaluate("dispatchEvent(new CustomEvent('tippe:seek:lab', {detail: {t: 0.3}}))")
    mailed.wait_for_function("Math.abs(__tippe.plane.selected.theta - __tippe.plane.selected.inner) > 0.01")
    assert "rolls: its tieline" in mailed.evaluate("__tippe.plane.names")
    shown = mailed.evaluate("""() => Bokeh.documents.flatMap((doc) => [...doc.all_models])
        .find((m) => m.name == "times-theta" && m.renderers).renderers
        .map(({ data_source }) => Array.from(data_source.data.theta ?? [])).find((theta) => theta.length)""")
    theta = np.degrees(scene.trajectory.theta)
    assert [min(shown), max(shown), shown[0]] == pytest.approx([theta.min(), theta.max(), theta[0]], abs=1e-2)
    assert [url for url in asked if not re.match("(file|blob|data):", url)] == []
    context.close()
