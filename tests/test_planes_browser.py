"""The tab of the three planes in Chromium: the page shows what a person switches, picks, stops and types."""

import re

import numpy as np
import pytest
from house import planes_of
from visiting import IN_SIGHT, PIXEL, Visit

from app.model.explorer import Explorer
from tippe_core import PRESETS

pytestmark = pytest.mark.served

TOPS = "__tippe.tops('planes')"
TOP = "__tippe.tops('planes').find((top) => top.label.includes(plane))"
MODELS = "[...Bokeh.documents[0]._all_models.values()]"
# Of a source in the figure of this name that has this column; of those of several planes, in the order of PLANES.
COLUMN = f"""
([figure, column]) => {MODELS}.find((m) => m.name == figure && m.renderers).renderers
    .map((r) => r.data_source.data).filter((d) => column in d).map((d) => Array.from(d[column]))
"""


@pytest.fixture
def page(server, chromium):
    """The page with the tab open, and the start given by spin and tilt."""
    with chromium.new_context(viewport={"width": 1400, "height": 900}, reduced_motion="reduce") as context:
        page = context.new_page()
        Visit(page, f"{server}?v=2&tab=three-planes", whole=False)
        choose(page, "spin, tilt and slip")
        page.get_by_text(re.compile("Friction law in use: smoothed Coulomb")).wait_for()
        put(page, "spin", 20)
        put(page, "tilt", 10)
        page.wait_for_function("/by=hand/.test(location.search) && !/spin=|tilt=/.test(location.search)")
        page.wait_for_function(f"{TOPS}.some(top => top.count > 0 && top.pictures > 0)")
        yield page


@pytest.fixture(scope="module")
def first():
    """The default picture."""
    return planes_of(Explorer()).picture


def field(page, name):
    """The number field of a visible control."""
    said = {"spin": "spin, in revolutions per second", "tilt": "tilt, in degrees",
            "seconds": "time computed, in seconds", "eps": "slip scale of the friction, in root g R"}  # fmt: skip
    return page.get_by_role("textbox", name=said[name], exact=True).locator("visible=true")


def put(page, name, value):
    field(page, name).fill(str(value))
    field(page, name).press("Enter")


def choose(page, name):
    page.get_by_role("button", name=name, exact=True).click()


def put_on(page, table):
    page.get_by_role("radio", name=table, exact=True).click()


def the_first_look_says_that_only_sliding_turns_it_over(page, first):
    page.get_by_text(re.compile(r"^rough: never turns over: in rolling")).wait_for()
    page.get_by_text(re.compile(r"^smooth: never turns over")).wait_for()
    page.get_by_text(re.compile(r"^sliding: leans on ball and stem: 118\.8° at 5 s; past 90° at 2\.\d+ s")).wait_for()
    page.get_by_text(re.compile("Friction law in use: smoothed Coulomb")).wait_for()
    page.wait_for_function(f"n => {TOPS}.length == 1 && {TOPS}[0].count == n", arg=len(first.motions["sliding"].t))
    shown = page.evaluate(COLUMN, ["planes-theta", "theta"])
    for values, motion in zip(shown, first.motions.values(), strict=True):
        theta = np.degrees(motion.trajectory.theta)
        assert (min(values), max(values)) == pytest.approx((theta.min(), theta.max()), abs=1e-6)


def three_tops_side_by_side_go_by_one_clock(page, first):
    put_on(page, "All three")
    page.wait_for_function(f"{TOPS}.length == 3 && {TOPS}.every(top => top.count > 0)")
    for moves in (True, False):
        page.locator("button.play:visible").first.click()
        page.wait_for_function(f"moves => {TOPS}.every(top => top.playing === moves)", arg=moves)
    page.evaluate("window.dispatchEvent(new CustomEvent('tippe:seek:planes', {detail: {t: 40}}))")
    page.wait_for_function(f"{TOPS}.every(top => Math.abs(top.t - 40) < 0.1 && top.t == {TOPS}[0].t)")
    t = page.evaluate(f"{TOPS}[0].t")
    index = int(np.argmin(np.abs(first.motions["rough"].t - t)))
    for plane, motion in first.motions.items():
        page.wait_for_function(f"([plane, i]) => {TOP}.index == i", arg=[plane, index])
        drawn = np.array(page.evaluate(f"(plane) => {TOP}.quaternion", plane))
        assert abs(drawn @ motion.trajectory.quaternion[index]) == pytest.approx(1, abs=1e-5)
    # the bead in the well and the lines over time stand where the sliding top is
    page.wait_for_function(
        f"t => {MODELS}.filter((m) => m.type == 'Span' && Math.abs(m.location - t) < 1e-4).length == 6",
        arg=t * first.settings.scales.time,
    )
    bead = page.evaluate(COLUMN, ["planes-well", "E"])[0]
    assert bead == pytest.approx([first.motions["sliding"].trajectory.energy[index]], abs=1e-4)
    table = page.locator("table").first.inner_text()
    assert len(re.findall(r"stays to \d·10", table)) == 8 and "to 2.57 s, where it stands on its stem" in table
    put_on(page, "Ice")
    page.get_by_text(re.compile("Friction law in use: smooth plane")).wait_for()


def there_is_no_well_while_the_stem_touches(page, first):
    """The bead disappears with it; before that both are there."""
    put_on(page, "Ordinary")
    well = f"{MODELS}.find((m) => m.name == 'planes-well' && m.renderers)"
    hidden = f"t => {well}.center.some((m) => m.type == 'Label' && m.visible) == (t > 2.6)"
    for t, beads in ((4.0, 0), (1.0, 1)):
        page.evaluate("t => window.dispatchEvent(new CustomEvent('tippe:seek:planes', {detail: {t}}))",
                      t / first.settings.scales.time)  # fmt: skip
        page.wait_for_function(hidden, arg=t)
        page.wait_for_function(f"n => ({COLUMN})(['planes-well', 'E'])[0].length == n", arg=beads)
        shown = page.evaluate(COLUMN, ["planes-well", "alpha"])[0]
        assert shown == [beads]


def a_preset_sets_the_top_the_start_and_the_law(page):
    choose(page, "Hangs halfway")
    page.get_by_text(re.compile(r"^sliding: leans: 109\.\d° at 25 s.*; past 90° at 1\.99 s")).wait_for()
    page.get_by_text(re.compile("Friction law in use: viscous")).wait_for()
    page.wait_for_function("field => field.value == '9.5493'", arg=field(page, "spin").element_handle())
    # and the address follows without another gesture
    page.wait_for_function("/spin=9.5493&.*law=viscous/.test(location.search)")
    page.keyboard.press("Control+z")
    page.wait_for_function("!location.search.includes('law=')")
    page.get_by_text(re.compile("Friction law in use: smoothed Coulomb")).wait_for()
    choose(page, "The paper’s top by hand")
    page.get_by_text(re.compile("^sliding: leans on ball and stem")).wait_for()


def a_bad_value_is_said_and_nothing_is_lost(page):
    put(page, "tilt", 200)
    page.get_by_text(re.compile("tilt = 200 is not possible")).wait_for()
    assert page.get_by_text(re.compile("^sliding: leans on ball and stem")).count()
    put(page, "tilt", 10)
    page.get_by_text(re.compile("tilt = 200 is not possible")).wait_for(state="detached")


def a_long_run_shows_how_far_it_is_and_can_be_stopped(page):
    put(page, "eps", 1e-8)  # so stiff that it takes several seconds
    stop = page.get_by_role("button", name="Stop", exact=True)
    stop.wait_for()
    assert page.locator(".bk-Row").filter(has=stop).locator("progress").last.is_visible()
    stop.click()
    page.get_by_text(re.compile(r"Stopped at \S+ s of the motion")).wait_for()
    stop.wait_for(state="hidden")
    assert page.get_by_text(re.compile("^sliding: leans on ball and stem.* at 5 s")).count()
    put(page, "eps", 0.1)
    page.get_by_text(re.compile("Stopped at")).wait_for(state="detached")


def a_click_on_the_map_goes_there(page):
    page.locator("[data-figure=planes-map]").evaluate(IN_SIGHT)
    body = next(body for body in PRESETS if body.name == "Loaded sphere")
    page.mouse.click(*page.evaluate(PIXEL, ["planes-map", body.shape.top.a, body.shape.top.I1 / body.shape.top.I3]))
    here = f"a => ({COLUMN})(['planes-map', 'x']).some((x) => x.length == 1 && Math.abs(x[0] - a) < 0.005)"
    page.wait_for_function(here, arg=body.shape.top.a)
    page.mouse.click(*page.evaluate(PIXEL, ["planes-map", 0.5, 0.8]))
    page.wait_for_function(here, arg=0.5)
    assert page.evaluate(COLUMN, ["planes-map", "y"])[-1] == pytest.approx([0.8], abs=0.005)


def of_two_quick_clicks_on_the_map_the_second_counts(page):
    """Bokeh calls it a doubletap, though it is elsewhere."""
    page.locator("[data-figure=planes-map]").evaluate(IN_SIGHT)
    one, other = (page.evaluate(PIXEL, ["planes-map", *place]) for place in ((0.6, 0.7), (0.3, 1.0)))
    page.mouse.click(*one)
    page.mouse.click(*other)
    here = f"place => ['x', 'y'].every((c, i) => Math.abs(({COLUMN})(['planes-map', c]).at(-1)[0] - place[i]) < 5e-3)"
    page.wait_for_function(here, arg=[0.3, 1.0])


def test_one_visit(page, first):
    """One visit, step by step."""
    the_first_look_says_that_only_sliding_turns_it_over(page, first)
    three_tops_side_by_side_go_by_one_clock(page, first)
    there_is_no_well_while_the_stem_touches(page, first)
    a_bad_value_is_said_and_nothing_is_lost(page)
    a_long_run_shows_how_far_it_is_and_can_be_stopped(page)
    a_preset_sets_the_top_the_start_and_the_law(page)
    a_click_on_the_map_goes_there(page)
    of_two_quick_clicks_on_the_map_the_second_counts(page)
