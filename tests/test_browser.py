"""The level "Research" in Chromium: it shows the numbers of tippe_core beside Explore's stage, and sets nothing."""

import re

import numpy as np
import pytest
from axe import DARK, LIGHT, check
from doubles import by_hand
from playwright.sync_api import expect
from visiting import IN_SIGHT, WHOLE, Visit, entry, open_panel, wait

from app.model.explorer import Explorer
from app.model.families.known_tops import known_tops
from app.model.lab.lab import scene_of
from app.model.scene import solve
from tippe_core import PRESETS, Top, glide, grip, roll, slide

pytestmark = pytest.mark.served

MODELS = "Bokeh.documents.flatMap((doc) => [...doc.all_models])"
# The columns of a name of the sources in a figure, in the order of the tables.
COLUMN = f"""
([figure, column]) => {MODELS}.find((m) => m.name == figure && m.renderers).renderers
    .map((r) => r.data_source.data).filter((d) => column in d).map((d) => Array.from(d[column]))
"""
TOPS = "__tippe.tops('lab').filter((top) => top.count > 0)"
SELECTED = "() => __tippe.plane.selected"
# The positions of all controls and pictures.
PLACES = f"""() => {MODELS}.filter((model) => "sizing_mode" in model.properties)
    .map((model) => Bokeh.index.find_one(model)?.el?.getBoundingClientRect()).filter((box) => box?.width)
    .map(({{x, y, width, height}}) => [x, y, width, height])"""


def put(page, name, value):
    entry(page, name).fill(str(value))
    entry(page, name).press("Enter")


def until_selected(page, **values):
    page.wait_for_function(
        f"(want) => {{ const has = ({SELECTED})(); return Object.entries(want).every(([k, v]) => has[k] === v) }}",
        arg=values,
    )


def seek(page, t):
    page.evaluate("t => window.dispatchEvent(new CustomEvent('tippe:seek:lab', {detail: {t}}))", t)
    page.wait_for_function(f"t => {TOPS}.length && {TOPS}.every((top) => Math.abs(top.t - t) < 1e-6)", arg=t)


def the_top_is_the_one_that_rolls(page):
    """Its pose between two frames too: against tippe_core at that time."""
    start = Explorer(table="rough").setup
    state, _ = grip(start.top, start.state)
    for t in (0.0, 0.3, 2.0):
        seek(page, t)
        q = roll(start.top, None, [0.0, t], state).quaternion[-1]
        page.wait_for_function(
            "q => Math.abs(__tippe.top3d.quaternion.reduce((sum, x, i) => sum + x * q[i], 0)) > 1 - 1e-6",
            arg=q.tolist(),
        )


def a_bad_value_is_said_beside_its_control(page):
    before = page.evaluate(SELECTED)
    for text, says in (("0.9", "0.9"), ("not this", "not a number")):
        put(page, "I3", text)
        page.locator("[role=alert]:visible", has_text=says).wait_for()
    assert page.evaluate(SELECTED)["inner"] == before["inner"]
    put(page, "I3", "0.4")
    page.locator("[role=alert]:visible").wait_for(state="detached")
    _, outer = solve(Top(0.07, 0.399, 0.4), 7.0, 10.0, 0.5, 0.9).turning
    wait(page, lambda: page.evaluate(SELECTED)["outer"] == pytest.approx(outer, abs=1e-6))
    put(page, "I3", "0.408")
    wait(page, lambda: page.evaluate(SELECTED)["outer"] == pytest.approx(before["outer"], abs=1e-6))


def an_old_picture_takes_no_more_room(page):
    note = page.get_by_text("as the height to which it could lift the top").first
    before = note.bounding_box()["height"]
    put(page, "tilt", 185)
    old = note.filter(has_text="Old picture")
    old.wait_for()
    assert old.bounding_box()["height"] == before
    page.get_by_role("button", name="Back to").click()
    old.wait_for(state="detached")


def nothing_moves_while_a_slider_is_dragged(visit):
    """Numbers get longer, and sentences appear and disappear, but nothing on the page moves."""
    page = visit.page
    page.wait_for_function("Bokeh.documents[0].is_idle")
    slider = page.get_by_role("slider", name="Jellett’s constant")
    slider.evaluate(IN_SIGHT)
    before, thumb = page.evaluate(PLACES), slider.bounding_box()
    up = thumb["y"] + thumb["height"] / 2
    visit.drag((thumb["x"] + 0.7 * thumb["width"], up), (thumb["x"] + 0.2 * thumb["width"], up))
    wait(page, lambda: float(entry(page, "K_J").input_value()) < 2.5)
    assert len(before) > 5 and page.evaluate(PLACES) == before
    page.mouse.up()
    wait(
        page, lambda: page.evaluate(SELECTED)["K_J"] == pytest.approx(float(entry(page, "K_J").input_value()), abs=1e-4)
    )


def after_a_slider_moved_the_figure_is_tippe_cores(page):
    put(page, "K_J", 6.7)
    scene = solve(Top.paper(), 6.7, 10.0, 0.5, 0.9)
    until_selected(page, K_J=6.7)
    for column, values in (("K_J", scene.plane.K_J), ("slip_in", scene.plane.slip.theta_inner),
                           ("verge", scene.plane.slip.theta_verge)):  # fmt: skip
        wait(page, lambda column=column, values=values: np.array_equal(
            page.evaluate("name => Array.from(__tippe.plane.limits[name])", column), values))  # fmt: skip


def test_what_rolls_is_tippe_cores(visit):
    page = visit.page
    visit.pause()
    for look in (LIGHT, DARK):
        check(page, "research", look)
    the_top_is_the_one_that_rolls(page)
    a_bad_value_is_said_beside_its_control(page)
    an_old_picture_takes_no_more_room(page)
    nothing_moves_while_a_slider_is_dragged(visit)
    after_a_slider_moved_the_figure_is_tippe_cores(page)


def test_research_and_back_is_the_same_canvas_whose_time_goes_on_and_sends_nothing(chromium, server):
    with chromium.new_context(viewport={"width": 1400, "height": 900}, reduced_motion="no-preference") as context:
        visit = Visit(context.new_page(), f"{server}?v=4", whole=False, listens=True)
        page = visit.page
        assert page.title() == "Tippe top explorer"
        page.wait_for_function(f"window.__tippe?.top3d && {TOPS}.length && __tippe.top3d.t > 0")
        canvas = page.locator("canvas[aria-label^='The top']").first.element_handle()
        page.evaluate("canvas => { window.canvas = canvas }", canvas)
        for level, there in (("Research", True), ("Explore", False), ("Research", True), ("Explore", False)):
            before = page.evaluate("__tippe.top3d.t")
            page.get_by_role("radio", name=level, exact=True).click()
            expect(page.get_by_role("radio", name="Over time", exact=True)).to_be_visible(visible=there)
            page.wait_for_function("t => __tippe.top3d.t > t", arg=before)
            assert page.evaluate("canvas.isConnected && __tippe.top3d.playing")
            page.wait_for_function(f"location.search == '{'?v=4&level=research' if there else ''}'")
        received = page.evaluate("__tippe.top3d.motions.received")
        visit.sent.clear()
        page.get_by_role("radio", name="Research", exact=True).click()
        page.wait_for_function("location.search == '?v=4&level=research'")
        assert page.evaluate("__tippe.top3d.motions.received") == received  # no motion was computed for it
        page.get_by_role("radio", name="Rough", exact=True).click()
        page.wait_for_function(WHOLE)
        page.wait_for_function(
            "t => __tippe.top3d.t != t && __tippe.top3d.playing", arg=page.evaluate("__tippe.top3d.t")
        )
        wait(page, lambda: plays_without_a_word(visit))  # a page that has just loaded still sends its size
        visit.pause()
        for name in ("K_J", "K_R", "energy", "mu_s"):
            box = entry(page, name).bounding_box()
            assert box["y"] + min(box["height"], 30) < 900, name


def plays_without_a_word(visit):
    """Whether the page has sent and heard nothing for five pictures."""
    visit.sent.clear()
    pictures = visit.page.evaluate("__tippe.top3d.pictures")
    visit.page.wait_for_function("n => __tippe.top3d.pictures > n + 5", arg=pictures)
    return not visit.sent


# ---- the runs on the tables ----

HAND = "?v=4&level=research&panel=time&" + "body=TruncatedSphere_.016_.0082_.0192_.0032_.0115&a=.07&I1=.399&I3=.408"
THROWN = f"{HAND}&spin=20&tilt=10&mu_k=.3&law=smoothed&eps=.1&table=three"


def test_three_tables_side_by_side_go_by_one_clock(chromium, server):
    motions = scene_of("three", by_hand(seconds=6.0)).motions
    with chromium.new_context(viewport={"width": 1400, "height": 900}, reduced_motion="reduce") as context:
        visit = Visit(context.new_page(), server + THROWN, whole=False)
        page = visit.page
        page.wait_for_function(f"window.__tippe?.tops && {TOPS}.length == 3")
        seek(page, 40.0)
        start = motions["ordinary"].start
        unit, t = start.scales.time, [0.0, 40.0]
        gripped, _ = grip(start.top, start.state)
        poses = {"ordinary": slide(start.top, start.state, start.friction, t), "ice": glide(start.top, start.state, t),
                 "rough": roll(start.top, None, t, gripped)}  # fmt: skip
        for label, moved in poses.items():
            page.wait_for_function(
                f"""([label, q]) => {TOPS}.filter((top) => top.label.includes(label)).some((top) =>
                    Math.abs(top.quaternion.reduce((sum, x, i) => sum + x * q[i], 0)) > 1 - 1e-4)""",
                arg=[label, moved.quaternion[-1].tolist()],
            )
        page.wait_for_function(
            f"t => {MODELS}.filter((m) => m.type == 'Span' && Math.abs(m.location - t) < 1e-4).length == 7",
            arg=40.0 * unit,
        )
        shown = page.evaluate(COLUMN, ["times-theta", "theta"])
        for values, table in zip(shown, ("ordinary", "rough", "ice"), strict=True):
            theta = np.degrees(motions[table].trajectory.theta)
            assert min(values) <= theta.min() + 1e-6 and max(values) >= theta.max() - 1e-6
        check(page, "over time", DARK)


def test_the_panels_show_what_happened_and_an_example_sets_top_start_and_law(chromium, server):
    with chromium.new_context(viewport={"width": 1400, "height": 900}, reduced_motion="reduce") as context:
        visit = Visit(context.new_page(), f"{server}?v=4&level=research", whole=False)
        page = visit.page
        open_panel(page, "Values")
        page.get_by_role("button", name=re.compile(r"^1\.47 s\s*stands on its stem")).click()
        unit = np.sqrt(0.015 / 9.81)  # s of this toy
        page.wait_for_function("t => Math.abs(__tippe.top3d.t - t) < 0.3", arg=1.471 / float(unit))
        page.locator("summary", has_text="details of its friction").click()
        page.get_by_label("An example", exact=True).select_option("Top S hangs")
        expect(page.get_by_label("Spin, in turns a second", exact=True)).to_have_value("9.5")
        page.wait_for_function("/spin=9.5493&.*law=viscous/.test(location.search)")
        page.keyboard.press("Control+z")
        page.wait_for_function("!location.search.includes('law=')")
        check(page, "values", DARK)
        open_panel(page, "Ends")
        the_map_takes_clicks_and_its_areas_are_those_of_the_core(page)


# The areas of the map of tops that contain the place of each known one.
AREAS = """map => Object.fromEntries([...map.querySelectorAll("[data-name]")].map((top) => {
    const {e, f} = top.transform.baseVal[0].matrix
    const found = ["turns", "part"].filter((area) => map.querySelector(`.${area}`).isPointInFill(new DOMPoint(e, f)))
    return [top.dataset.name, found.join()]
}))"""


def the_map_takes_clicks_and_its_areas_are_those_of_the_core(page):
    areas = page.get_by_role("group", name="Map of tops").evaluate(AREAS)
    groups = {"can invert": "turns", "rises part of the way": "part"}
    known = [top for top in known_tops() if top.limits.group != "neutral"]  # that one is where the lines meet
    assert {top.name: areas[top.name] for top in known} == {
        top.name: groups.get(top.limits.group, "") for top in known}  # fmt: skip
    page.get_by_role("button", name="Loaded sphere", exact=True).click()
    top = next(body for body in PRESETS if body.name == "Loaded sphere").shape.top
    ring = page.get_by_role("slider", name="The page’s top")
    expect(ring).to_have_attribute("aria-valuetext", f"a/R {top.a:.3f}, I₁/I₃ {top.I1 / top.I3:.3f}")
    ring.press("ArrowRight")
    page.wait_for_function("a => Math.abs(new URLSearchParams(location.search).get('a') - a) < 1e-6", arg=top.a + 0.005)
