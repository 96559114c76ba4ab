"""The page in Chromium as it opens for everybody: the top flips without a click, what is chosen is shown, a link opens
the same elsewhere, on a phone and in German too. test_lab_hands_browser.py has hands on the Lab alone."""

from urllib.parse import parse_qs, urlsplit

import numpy as np
import pytest
from axe import DARK, LIGHT, LOOK, contrast, violations
from lab_page import TIME, TOPS, UNIT, arrival, come, entry, line, pause, put
from playwright.sync_api import expect
from visiting import is_seen

from app.model.setup import start_of
from tippe_core import Constants, grip

pytestmark = pytest.mark.served

# The tilt of the visible top in degrees, from its pose alone.
TILT = f"""(() => {{
    const [x, y] = {TOPS}[0].quaternion
    return 180 / Math.PI * Math.acos(1 - 2 * (x * x + y * y))
}})()"""


def test_it_flips_with_nothing_clicked_another_table_keeps_the_start_and_a_link_opens_the_same(server, chromium):
    with arrival(server, chromium, draws=True, reduced_motion="no-preference") as page:
        assert urlsplit(page.url).query == ""
        assert page.get_by_role("tab", name="Lab").get_attribute("aria-selected") == "true"
        page.wait_for_function(f"{TILT} > 170")
        assert page.evaluate(TIME) * UNIT == pytest.approx(1.47, abs=0.3)  # physics says 1.471 s
        page.get_by_text("It stands on its stem and spins on.").wait_for()
        page.wait_for_function(f"{TIME} * {UNIT} > 2")
        assert page.evaluate(TILT) > 170
        that_it_plays_is_in_the_link_at_once(page)
        another_table(page)
        what_cannot_be(page)
        page.get_by_role("radio", name="Ice").click()
        page.locator(".lab[data-table=ice]").wait_for()
        put(page, "Tilt, in degrees", 12)
        page.wait_for_function("location.search.includes('table=ice') && location.search.includes('tilt=12')")
        asked = parse_qs(urlsplit(page.url).query)
        asked.pop("t", None)  # if it has come to the end of its motion meanwhile
        assert asked == {"v": ["4"], "table": ["ice"], "spin": ["28.8"], "tilt": ["12"]}
        with chromium.new_context(viewport=page.viewport_size, reduced_motion="reduce") as elsewhere:
            other = come(elsewhere.new_page(), page.url).page
            other.locator(".lab[data-table=ice]").wait_for()
            assert other.locator("#first").is_hidden()  # nothing else was drawn meanwhile
            assert entry(other, "Tilt, in degrees").input_value() == "12.0"
            assert line(other) == line(page)
            the_papers_figures(other)


def that_it_plays_is_in_the_link_at_once(page):
    """Also where pictures follow each other so quickly that its time never rests, as the events here."""
    pause(page)
    page.wait_for_function("/[?&]t=/.test(location.search)")
    frames = page.evaluate("""setInterval(() => dispatchEvent(new CustomEvent("tippe:clock:lab",
        { detail: { t: performance.now() / 1e5, playing: true } })), 20)""")
    page.wait_for_function("!/[?&]t=/.test(location.search)")
    page.evaluate("clearInterval", frames)


def another_table(page):
    """It keeps the start, and the motion begins anew."""
    names = "Spin, in turns a second", "Tilt, in degrees"
    put(page, names[0], 28.8)
    page.get_by_role("slider", name="Time").press("End")
    before = [entry(page, name).input_value() for name in names]
    assert before == ["28.8", "5.7"]
    page.get_by_role("button", name="On a table so rough that it can only roll").click()
    page.locator(".lab[data-table=rough]").wait_for()
    page.wait_for_function(f"{TIME} * {UNIT} < 5")
    assert [entry(page, name).input_value() for name in names] == before
    assert not entry(page, "Coefficient of friction").is_visible()  # if nothing slips it has no effect
    heights = np.array([float(point.split(",")[1]) for point in line(page).split()])
    right_angle = page.locator(".strip .grid").first.get_attribute("y1")
    assert heights.min() > float(right_angle) + 30  # it never comes close
    page.get_by_text("Rolling, it does not turn over.").wait_for()


def what_cannot_be(page):
    """It is said beside it, the motion stays, and there is a remedy."""
    page.locator(".lab[data-whole]").wait_for()
    before, tilt, old = line(page), entry(page, "Tilt, in degrees"), page.get_by_text("Old picture").first
    put(page, "Tilt, in degrees", 185)
    page.get_by_role("alert").filter(has_text="Tilt goes from 0°").wait_for()
    old.filter(has_text="Tilt 5.7°").wait_for()
    assert line(page) == before and tilt.input_value() == "185"
    page.get_by_role("button", name="Back to 5.7°").click()
    old.wait_for(state="hidden")
    assert tilt.input_value() == "5.7"
    put(page, "Tilt, in degrees", 185)
    page.get_by_role("button", name="Take 175°").click()
    expect(page.get_by_role("alert").filter(has_text="Tilt goes")).to_be_hidden()
    expect(tilt).to_have_value("175.0")
    old.wait_for(state="hidden")


def the_papers_figures(page):
    """They have this top and start."""
    page.get_by_role("radio", name="Rough").click()
    page.locator(".lab[data-table=rough]").wait_for()
    page.get_by_role("button", name="The paper’s figures for this top").click()
    page.locator("[data-figure=plane]").first.wait_for()
    assert is_seen(page, "Roll")
    page.wait_for_function("location.search.includes('level=research')")  # the same start, at the other level
    assert {"spin=28.8", "tilt=12"} <= {*urlsplit(page.url).query.split("&")}
    start = start_of("Leine and Glocker's toy", 28.8, 12.0, 0.3)
    state, lost = grip(start.top, start.state)
    found = Constants.from_state(start.top, state.theta, state.theta_dot, state.omega2, state.omega3)
    jellett = float(page.get_by_role("slider", name="Jellett’s constant").input_value())
    assert jellett == pytest.approx(float(found.K_J), abs=0.006)
    page.get_by_text(f"that took {lost:.2g} MgR of its energy at once").first.wait_for()


# Whether two parts of the Lab can overlap, given the longest words of the first.
COVERS = """(lab, [one, other, words]) => {
    lab.querySelector(one).textContent = words
    const [a, b] = [one, other].map((name) => lab.querySelector(name).getBoundingClientRect())
    return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom
}"""
# What a finger touches that is less than 44 px high.
SMALL = """lab => [...lab.querySelectorAll("button, select, input:not(.num, .at)")].filter((e) => e.checkVisibility())
    .map((e) => [e.className || e.textContent, e.getBoundingClientRect().height]).filter(([, high]) => high < 43.9)"""
DOWN = "page => page.scrollTo(0, page.scrollHeight)"


def test_on_a_german_phone_nothing_covers_what_is_said_all_can_be_changed_and_axe_finds_nothing(chromium, server):
    phone = chromium.new_context(viewport={"width": 390, "height": 844}, is_mobile=True, has_touch=True,
                                 reduced_motion="reduce")  # fmt: skip
    page = come(phone.new_page(), f"{server}?v=2&tab=lab&lang=de").page
    assert page.evaluate("document.documentElement.scrollWidth") <= 390
    assert page.locator(".lab").evaluate(SMALL) == []
    for other in (".paces", ".starts"):
        longest = "Kippt auf die Seite · 140° · jetzt 1/16 Tempo"
        assert not page.locator(".lab").evaluate(COVERS, [".pill", other, longest]), other
    whole = page.locator("main")
    for before in ("nothing", "an earlier run"):  # beside which the controls at the foot of the page are higher
        for fold in ("Kreisel: Stiel, Ballast", "Zahlen"):
            whole.evaluate(DOWN)
            summary = page.locator("summary", has_text=fold)
            summary.tap()
            expect(summary.locator("..")).to_have_attribute("open", "")
        whole.evaluate(DOWN)
        row, dock = page.locator(".numbers tr").last, page.locator(".dock")
        assert row.bounding_box()["y"] + row.bounding_box()["height"] <= dock.bounding_box()["y"] + 1, before
        for fold in ("Kreisel: Stiel, Ballast", "Zahlen") if before == "nothing" else ():
            page.locator("summary", has_text=fold).evaluate("summary => summary.parentElement.open = false")
            page.get_by_role("slider", name="Drehung").press("ArrowLeft")
            page.locator(".chip").wait_for()
            assert page.locator(".lab").evaluate(SMALL) == []  # also the way back to it, in a sentence
    radius = page.get_by_label("Radius der Kugel").first
    radius.scroll_into_view_if_needed()
    for part in (radius, *(page.get_by_role("button", name=name) for name in ("Abspielen", "Los"))):
        expect(part).to_be_in_viewport()
    page.get_by_role("radio", name="Alle drei").click()
    expect(page.locator(".dock input[type=range]").first).to_be_visible()
    page.locator(".lab[data-table=three]").wait_for()
    assert violations(page, leaves_out=["color-contrast"]) == [], "three tables"  # a large screen has the same colours
    axe_finds_nothing(page)
    phone.close()


def axe_finds_nothing(page):
    page.set_viewport_size({"width": 390, "height": 1600})  # nothing is half under the dock, which a scroll would free
    page.locator("main").evaluate("page => page.scrollTo(0, 0)")
    page.get_by_role("radio", name="Gewöhnlich").click()
    page.locator(".lab[data-table=ordinary]").wait_for()
    assert violations(page) == [], "the lab"
    page.get_by_role("button", name="Mehr", exact=True).click()
    assert violations(page) == [], "the menu"
    page.get_by_role("tab", name="Lernen").locator("visible=true").click()
    page.locator("main .covered").first.wait_for()
    for place in (4, 6):  # the two arms in place of the top; the question about one's own
        page.locator(".crumbs button").nth(place).click()
        page.locator(".option:visible").first.wait_for()
        assert violations(page) == [], place
        page.evaluate(LOOK, DARK)
        assert contrast(page) == [], place
        page.evaluate(LOOK, LIGHT)
