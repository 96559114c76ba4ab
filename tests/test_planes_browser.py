"""The tab of the three planes in Chromium: the page shows what a person switches, picks, stops and types."""

import re

import numpy as np
import pytest
from axe import DARK, check
from house import planes_of
from playwright.sync_api import expect
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


def field(page, name):
    """The number field of a visible control."""
    said = {"spin": "Spin, in turns a second", "tilt": "Tilt, in degrees"}
    return page.get_by_role("textbox", name=said[name], exact=True).locator("visible=true")


def put(page, name, value):
    field(page, name).fill(str(value))
    field(page, name).press("Enter")


def choose(page, name):
    page.get_by_role("button", name=name, exact=True).or_(page.get_by_role("radio", name=name, exact=True)).click()


def says(page, words):
    page.get_by_text(re.compile(words)).wait_for()


def the_first_look_says_that_only_sliding_turns_it_over(page, first):
    says(page, r"^rough: Rolling, it does not turn over\.")
    says(page, r"^ice: Without rubbing it does not turn over\.")
    says(page, r"^ordinary: It leans and goes round\. 118\.8° at 5 s; past 90° at 2\.\d+ s")
    page.wait_for_function(f"n => {TOPS}.length == 1 && {TOPS}[0].count == n", arg=len(first.motions["ordinary"].t))
    shown = page.evaluate(COLUMN, ["planes-theta", "theta"])
    for values, motion in zip(shown, first.motions.values(), strict=True):
        theta = np.degrees(motion.trajectory.theta)
        assert (min(values), max(values)) == pytest.approx((theta.min(), theta.max()), abs=1e-6)


def three_tops_side_by_side_go_by_one_clock(page, first):
    page.get_by_role("radio", name="All three", exact=True).click()
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
    assert bead == pytest.approx([first.motions["ordinary"].trajectory.energy[index]], abs=1e-4)
    table = page.locator("table").first.inner_text()
    assert (
        len(re.findall(r"stays to \d·10", table)) == 8
        and "to 2.57 s, where its ball leaves, and its stem carries it" in table
    )


def a_bad_value_is_said_and_nothing_is_lost(page):
    put(page, "tilt", 200)
    says(page, "tilt = 200 is not possible")
    assert page.get_by_text(re.compile("^ordinary: It leans and goes round")).count()
    put(page, "tilt", 10)
    page.get_by_text(re.compile("tilt = 200 is not possible")).wait_for(state="detached")


def a_preset_sets_the_top_the_start_and_the_law_and_undo_takes_it_back(page):
    choose(page, "Hangs halfway")
    says(page, r"^ordinary: .* 109\.\d° at 25 s.*; past 90° at 1\.99 s")
    says(page, "Friction law in use: viscous")
    expect(field(page, "spin")).to_have_value("9.5493")
    # and the address follows without another gesture
    page.wait_for_function("/spin=9.5493&.*law=viscous/.test(location.search)")
    page.keyboard.press("Control+z")
    page.wait_for_function("!location.search.includes('law=')")
    says(page, "Friction law in use: smoothed Coulomb")


def of_two_quick_clicks_on_the_map_the_second_counts(page):
    """Bokeh calls it a doubletap, though it is elsewhere. The first is where the map has the top of a preset."""
    page.locator("[data-figure=planes-map]").evaluate(IN_SIGHT)
    top = next(body for body in PRESETS if body.name == "Loaded sphere").shape.top
    here = f"place => ['x', 'y'].every((c, i) => Math.abs(({COLUMN})(['planes-map', c]).at(-1)[0] - place[i]) < 5e-3)"
    page.mouse.click(*page.evaluate(PIXEL, ["planes-map", top.a, top.I1 / top.I3]))
    page.wait_for_function(here, arg=[top.a, top.I1 / top.I3])
    pixels = [page.evaluate(PIXEL, ["planes-map", *place]) for place in ([0.6, 0.7], [0.3, 1.0])]
    page.mouse.click(*pixels[0])
    page.mouse.click(*pixels[1])
    page.wait_for_function(here, arg=[0.3, 1.0])


def test_the_three_planes(server, chromium):
    first = planes_of(Explorer()).picture  # the default one, with the start given by spin and tilt
    with chromium.new_context(viewport={"width": 1400, "height": 900}, reduced_motion="reduce") as context:
        page = context.new_page()
        Visit(page, f"{server}?v=2&tab=three-planes", whole=False)
        choose(page, "spin, tilt and slip")
        says(page, "Friction law in use: smoothed Coulomb")
        put(page, "spin", 20)
        put(page, "tilt", 10)
        page.wait_for_function("/by=hand/.test(location.search) && !/spin=|tilt=/.test(location.search)")
        page.wait_for_function(f"{TOPS}.some(top => top.count > 0 && top.pictures > 0)")
        the_first_look_says_that_only_sliding_turns_it_over(page, first)
        a_bad_value_is_said_and_nothing_is_lost(page)
        three_tops_side_by_side_go_by_one_clock(page, first)
        a_preset_sets_the_top_the_start_and_the_law_and_undo_takes_it_back(page)
        of_two_quick_clicks_on_the_map_the_second_counts(page)
        page.set_viewport_size({"width": 1400, "height": 3000})  # all of it is in sight
        check(page, "three planes", DARK)
