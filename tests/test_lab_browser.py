"""The Lab in Chromium: on arrival the top flips without a click, and what is chosen is shown, on any screen."""

import itertools
from urllib.parse import parse_qs, urlsplit

import numpy as np
import pytest
from axe_playwright_python.base import AXE_SCRIPT
from lab_page import TIME, TOPS, UNIT, arrival, come, entry, line, pause, put
from PIL import Image
from playwright.sync_api import expect
from test_axe import CONTRAST, DARK, LIGHT, LOOK, violations
from visiting import is_seen, wait

from app.model.lab.run import start_of
from tippe_core import Constants, grip

pytestmark = pytest.mark.served

# The tilt of the visible top in degrees, from its pose alone.
TILT = f"""(() => {{
    const [x, y] = {TOPS}[0].quaternion
    return 180 / Math.PI * Math.acos(1 - 2 * (x * x + y * y))
}})()"""


# Touch targets of the Lab that are less than 44 px high.
SMALL = """() => {
    const all = (root) => [...root.querySelectorAll("*")].flatMap((e) => [e, ...e.shadowRoot ? all(e.shadowRoot) : []])
    const lab = all(document).find((e) => e.matches(".lab"))
    return [...lab.querySelectorAll("button, select, input:not(.num, .at)")].filter((e) => e.checkVisibility())
        .map((e) => [e.className || e.textContent, e.getBoundingClientRect().height]).filter(([, h]) => h < 43.9)
}"""


@pytest.fixture
def page(server, chromium):
    with arrival(server, chromium) as page:
        yield page


@pytest.fixture
def moving(server, chromium):
    """The page as it is without any wish of the system."""
    with arrival(server, chromium, reduced_motion="no-preference") as page:
        yield page


def choose(page, table):
    page.get_by_role("radio", name=table).click()
    page.locator(f".lab[data-table={table.lower()}]").wait_for()


def test_it_flips_on_arrival_with_nothing_clicked(moving):
    page = moving
    assert urlsplit(page.url).query == ""
    assert page.get_by_role("tab", name="Lab").get_attribute("aria-selected") == "true"
    page.wait_for_function(f"{TILT} > 170")
    assert page.evaluate(TIME) * UNIT == pytest.approx(1.47, abs=0.3)  # physics says 1.471 s
    page.get_by_text("It stands on its stem and spins on.").wait_for()
    page.wait_for_function(f"{TIME} * {UNIT} > 2")
    assert page.evaluate(TILT) > 170


def test_its_life_goes_on_to_its_end_faster_where_nothing_new_happens(moving):
    page = moving
    time, speed = page.get_by_role("slider", name="Time"), page.get_by_role("combobox", name="Speed")
    assert float(time.get_attribute("max")) == pytest.approx(12, abs=0.02)
    speeds = set()
    stages = (2.2, "It stands on its stem"), (7.0, "It comes off its stem"), (11.5, "The table grips it: it rolls.")
    for t, said in stages:
        time.evaluate("(bar, t) => { bar.value = t; bar.dispatchEvent(new Event('input')) }", t)
        page.get_by_text(said).first.wait_for()
        speeds.add(speed.input_value())
    page.get_by_text("now real speed").wait_for()
    assert "1" in speeds
    page.wait_for_function(f"{TIME} * {UNIT} > 11.9")
    assert 60 < page.evaluate(TILT) < 70  # it leans


def test_another_table_keeps_the_start_and_begins_anew(page):
    page.get_by_role("slider", name="Time").press("End")
    put(page, "Spin, in turns a second", 30)
    before = [entry(page, name).input_value() for name in ("Spin, in turns a second", "Tilt, in degrees")]
    assert before == ["30.0", "5.7"]
    page.get_by_role("button", name="On a table so rough that it can only roll").click()
    page.locator(".lab[data-table=rough]").wait_for()
    page.wait_for_function(f"{TIME} * {UNIT} < 5")
    assert [entry(page, name).input_value() for name in ("Spin, in turns a second", "Tilt, in degrees")] == before
    assert not entry(page, "Friction, its coefficient").is_visible()  # if nothing slips it has no effect
    heights = np.array([float(point.split(",")[1]) for point in line(page).split()])
    right_angle = page.locator(".strip .grid").first.get_attribute("y1")
    assert heights.min() > float(right_angle) + 30  # it never comes close
    page.get_by_text("Rolling, it never turns over.").wait_for()


def test_what_cannot_be_is_said_beside_it_and_the_motion_stays(page):
    choose(page, "Ordinary")
    page.locator(".lab[data-whole]").wait_for()
    before = line(page)
    put(page, "Tilt, in degrees", 185)
    page.get_by_role("alert").filter(has_text="Tilt goes from 0°").wait_for()
    page.get_by_text("Old picture: Tilt 5.7°").first.wait_for()
    assert line(page) == before
    assert entry(page, "Tilt, in degrees").input_value() == "185"
    page.get_by_role("button", name="Back to 5.7°").click()
    page.get_by_text("Old picture").first.wait_for(state="hidden")
    assert entry(page, "Tilt, in degrees").input_value() == "5.7"
    put(page, "Tilt, in degrees", 185)
    page.get_by_role("button", name="Take 175°").click()
    expect(page.get_by_role("alert").filter(has_text="Tilt goes")).to_be_hidden()
    expect(entry(page, "Tilt, in degrees")).to_have_value("175.0")
    page.get_by_text("Old picture").first.wait_for(state="hidden")
    put(page, "Tilt, in degrees", "half")
    page.get_by_role("alert").filter(has_text="half is not a number").wait_for()
    put(page, "Tilt, in degrees", "5,73")
    page.get_by_role("alert").filter(has_text="half").wait_for(state="hidden")


def test_the_run_before_stays_pale_until_it_is_dismissed(chromium, server):
    page = chromium.new_page(viewport={"width": 1400, "height": 900}, locale="en", reduced_motion="reduce")
    come(page, f"{server}?")
    put(page, "Spin, in turns a second", 22)
    page.get_by_text("Spin: 28.6 rev/s → 22.0 rev/s").wait_for()
    page.get_by_text("Before: Spin 28.6 rev/s").wait_for()
    assert page.locator(".strip .then").count() == 1
    assert page.locator(".answer .then").count() == 1
    page.get_by_role("button", name="Go back to before").click()
    page.wait_for_function("!location.search.includes('spin=22')")
    expect(page.locator(".strip .then")).to_have_count(0)
    put(page, "Spin, in turns a second", 30)
    page.get_by_role("button", name="Forget the run before").click()
    page.get_by_text("Before: Spin").wait_for(state="hidden")
    expect(page.locator(".strip .then")).to_have_count(0)
    page.close()


def test_numbers_are_in_a_fold_and_where_the_pointer_is(page):
    pause(page)
    page.get_by_role("slider", name="Time").press("Home")
    page.locator("summary", has_text="Numbers").click()
    page.get_by_role("row", name="tilt 5.7°").wait_for()
    page.locator("summary", has_text="Numbers").click()
    page.get_by_role("button", name="Large, over the whole window").click()
    page.get_by_role("dialog").get_by_role("heading", name="Where does the height come from?").wait_for()
    panel = page.get_by_role("dialog").get_by_role("tabpanel")
    panel.hover()
    readout, box = page.locator(".readout", has_text="turned into heat"), panel.bounding_box()
    xs = itertools.cycle((0.5, 0.55))

    def pointed():
        """The plot takes its size a moment after the dialog has opened, and then sees the pointer when it moves."""
        page.mouse.move(box["x"] + next(xs) * box["width"], box["y"] + box["height"] / 2)
        return readout.is_visible()

    wait(page, pointed)
    page.keyboard.press("Escape")
    page.get_by_role("dialog").wait_for(state="detached")


def test_a_link_opens_the_same_elsewhere(page, chromium, server):
    put(page, "Spin, in turns a second", 28.8)
    put(page, "Tilt, in degrees", 12)
    choose(page, "Ice")
    page.wait_for_function("location.search.includes('table=ice') && location.search.includes('tilt=12')")
    asked = parse_qs(urlsplit(page.url).query)
    assert asked == {"v": ["2"], "tab": ["lab"], "table": ["ice"], "spin": ["28.8"], "tilt": ["12"]}
    other = chromium.new_page(viewport={"width": 1400, "height": 900}, reduced_motion="reduce")
    come(other, page.url)
    other.locator(".lab[data-table=ice]").wait_for()
    assert entry(other, "Tilt, in degrees").input_value() == "12.0"
    assert line(other) == line(page)
    other.close()


def test_three_tables_are_seen_at_once_on_one_clock(page):
    page.get_by_role("radio", name="All three").click()
    page.locator(".lab[data-table=three][data-whole]").wait_for()
    page.wait_for_function(f"{TOPS}.filter((top) => top.count && top.pictures > 1).length == 3")
    assert page.get_by_role("row").count() == 4
    pause(page)
    page.get_by_role("slider", name="Time").press("End")
    page.wait_for_function(f"new Set({TOPS}.filter((top) => top.count).map((top) => top.t.toFixed(3))).size == 1")


def test_the_papers_figures_have_this_top_and_start(page):
    choose(page, "Rough")
    put(page, "Spin, in turns a second", 28.8)
    put(page, "Tilt, in degrees", 12)
    page.wait_for_function("location.search.includes('spin=28.8') && location.search.includes('tilt=12')")
    page.get_by_role("button", name="The paper’s figures for this top").click()
    page.locator("[data-figure=plane]").first.wait_for()
    assert is_seen(page, "Roll")
    page.wait_for_function("location.search.includes('by=hand')")  # the same start, at the other level
    assert {"spin=28.8", "tilt=12"} <= {*urlsplit(page.url).query.split("&")}
    start = start_of("Leine and Glocker's toy", 28.8, 12.0, 0.3)
    state, lost = grip(start.top, start.state)
    found = Constants.from_state(start.top, state.theta, state.theta_dot, state.omega2, state.omega3)
    jellett = float(page.get_by_role("slider", name="Jellett’s constant").input_value())
    assert jellett == pytest.approx(float(found.K_J), abs=0.006)
    page.get_by_text(f"that took {lost:.2g} MgR of its energy at once").first.wait_for()


@pytest.mark.parametrize("size", [(1400, 900), (390, 844)], ids=["1400", "390"])
def test_axe_finds_nothing(chromium, server, size):
    context = chromium.new_context(viewport={"width": size[0], "height": size[1]}, reduced_motion="reduce")
    page = context.new_page()
    come(page, f"{server}?")
    assert not page.evaluate(f"{TOPS}[0].playing")  # it does not start by itself
    page.evaluate(AXE_SCRIPT)
    for table in ("Ordinary", "All three"):
        page.get_by_role("radio", name=table).click()
        page.wait_for_function("Bokeh.documents[0].is_idle")
        assert violations(page) == [], table
        page.evaluate(LOOK, DARK)
        assert violations(page, CONTRAST) == [], table
        page.evaluate(LOOK, LIGHT)
    page.get_by_role("button", name="Spin all three").click()
    page.wait_for_function(f"{TOPS}.some((top) => top.playing && top.t > 0)")
    context.close()


def test_all_that_a_finger_touches_is_44_px_high(chromium, server):
    phone = chromium.new_context(viewport={"width": 390, "height": 844}, is_mobile=True, has_touch=True)
    page = phone.new_page()
    come(page, f"{server}?")
    small = page.evaluate(SMALL)
    assert small == []
    assert page.evaluate("document.documentElement.scrollWidth") <= 390
    phone.close()


# Whether two parts of the Lab can overlap, given the longest words of the first.
COVERS = """([one, other, words]) => {
    const all = (root) => [...root.querySelectorAll("*")].flatMap((e) => [e, ...e.shadowRoot ? all(e.shadowRoot) : []])
    const find = (name) => all(document).find((e) => e.matches(".lab " + name))
    find(one).textContent = words
    const [a, b] = [one, other].map((name) => find(name).getBoundingClientRect())
    return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom
}"""


def test_on_a_phone_nothing_covers_what_the_stage_says_and_the_top_can_be_changed(chromium, server):
    phone = chromium.new_context(viewport={"width": 390, "height": 844}, is_mobile=True, has_touch=True)
    page = phone.new_page()
    come(page, f"{server}?v=2&tab=lab&lang=de")
    page.get_by_role("button", name="Anhalten").click()
    longest = "Kippt auf die Seite · 140° · jetzt 1/16 Tempo"
    for other in (".paces", ".starts"):
        assert not page.evaluate(COVERS, [".pill", other, longest]), other
    entry = page.get_by_label("Radius der Kugel").first
    page.get_by_text("Kreisel: Stiel, Ballast").click()
    entry.scroll_into_view_if_needed()
    expect(entry).to_be_in_viewport()
    expect(page.get_by_role("button", name="Abspielen")).to_be_in_viewport()
    expect(page.get_by_role("button", name="Los")).to_be_in_viewport()
    page.get_by_role("radio", name="Alle drei").click()
    expect(page.locator(".dock input[type=range]").first).to_be_visible()
    phone.close()


def test_a_photo_has_the_tops_that_are_in_sight(chromium, server, tmp_path):
    page = chromium.new_page(viewport={"width": 1400, "height": 900}, reduced_motion="reduce")
    come(page, f"{server}?v=2&tab=lab&table=three")
    page.wait_for_function(f"{TOPS}.filter((top) => top.pictures && top.count).length == 3")
    page.get_by_role("button", name="Share", exact=True).click()
    button = page.get_by_role("button", name="PNG", exact=True).first  # of the photo
    with page.expect_download() as download:
        button.click()
    picture = Image.open(download.value.path()).convert("RGB")
    assert picture.width == pytest.approx(2400, abs=9) and picture.height < picture.width / 2
    for third in range(3):
        part = picture.crop((third * 800, 0, third * 800 + 800, picture.height))
        assert len(part.resize((80, 80)).getcolors(10_000)) > 300, third  # a top
    page.close()
