"""The page for people who use the keyboard or a screen reader, for first visitors, and in German; its look and the
wheel."""

import re
from pathlib import Path

import pytest
from axe import DARK_LARGE, LIGHT, LOOK, check
from visiting import Visit

from app.text import listed, say

pytestmark = pytest.mark.served

# All visible and spoken text of the page, piece by piece.
SAID = """
() => {
  const said = [], spoken = ["aria-label", "aria-valuetext", "title", "placeholder", "alt"]
  const read = (root) => {
    for (const element of root.querySelectorAll(":not(style, script)")) {
      for (const {nodeType, textContent} of element.childNodes) if (nodeType == 3) said.push(textContent.trim())
      for (const name of spoken) said.push(element.getAttribute(name)?.trim())
      if (element.shadowRoot) read(element.shadowRoot)
    }
  }
  read(document)
  return said.filter((words) => words)
}
"""


def words_of(language):
    """All words of a language, in pieces between elements and numbers."""

    def pieces(found):
        if isinstance(found, str):
            return {piece.strip() for piece in re.split(r"<[^>]*>|{[^}]*}|\n", found)}
        return set().union(*map(pieces, found.values() if isinstance(found, dict) else found))

    folder = Path(__file__).parent.parent / "app/text" / language
    return set().union(*(pieces(listed(path.stem, language)) for path in folder.glob("*.toml")))


def test_keys_of_the_page_and_a_tour_that_covers_nothing_it_shows(chromium, server):
    page = chromium.new_page(viewport={"width": 1400, "height": 900}, reduced_motion="reduce")
    Visit(page, server, near=True)
    for playing in ("", "!"):  # paused at first, where a person prefers less motion
        page.locator("body").press("Space")
        page.wait_for_function(f"{playing}__tippe.top3d.playing")
    # near the start, where another motion has its frames at the same times
    page.evaluate("window.dispatchEvent(new CustomEvent('tippe:seek:lab', {detail: {t: 0}}))")
    page.wait_for_function("__tippe.top3d.index == 0")
    page.locator("body").press("ArrowRight")
    page.wait_for_function("__tippe.top3d.index == 1")
    said = page.get_by_role("status", name="How it rolls").filter(has_text="The top rolls all along")
    said.wait_for(state="attached")
    keys = page.get_by_role("dialog", name="Keys")
    page.locator("body").press("F1")
    keys.get_by_text("play or pause").wait_for()
    check(page, "the keys")
    page.keyboard.press("Escape")
    keys.wait_for(state="hidden")
    page.get_by_role("button", name="More", exact=True).click()
    page.get_by_role("button", name="Accessibility", exact=True).click()
    page.get_by_role("dialog", name="Accessibility").get_by_text("WCAG 2.2").wait_for()
    check(page, "the statement")
    page.keyboard.press("Escape")
    slider = page.get_by_role("slider", name="Jellett’s constant")
    slider.press("ArrowRight")  # there it belongs to the control
    assert slider.get_attribute("aria-valuetext") == "7.01 root g over R"
    assert page.evaluate("__tippe.top3d.index") == 1
    page.locator("body").press("Space")
    assert not page.evaluate("__tippe.top3d.playing")
    page.get_by_role("button", name="Share").click()
    page.locator("svg:has(title:text-is('QR code of the link'))").wait_for()
    check(page, "Share", DARK_LARGE)
    page.evaluate(LOOK, LIGHT)
    page.keyboard.press("Escape")
    for size in ({"width": 1400, "height": 900}, {"width": 390, "height": 844}):
        page.set_viewport_size(size)
        the_tour(page, size["width"])
    page.get_by_role("slider", name="Jellett’s constant").click()  # on a phone it stands under the pictures
    page.close()


def the_tour(page, width):
    """It covers nothing that it shows, and can be skipped."""
    page.locator("body").press("F1")
    page.get_by_role("button", name="Take the tour").click()
    for i in range(1, 6):
        step = page.get_by_role("dialog").filter(has_text=f"{i} of 5")
        step.wait_for()
        box, ring = step.bounding_box(), page.locator(".ring:has(+ .stop)")
        assert box["x"] >= 0 and box["x"] + box["width"] <= width
        shown = ring.bounding_box() if ring.is_visible() else None
        assert shown is None or any(
            one[at] >= other[at] + other[size] - 8
            for one, other in ((box, shown), (shown, box)) for at, size in (("x", "width"), ("y", "height"))
        ), (width, i, box, shown)  # fmt: skip
        if i == 1 and width > 1000:
            check(page, "the tour", DARK_LARGE)
            page.evaluate(LOOK, LIGHT)
        if i < 5:
            page.get_by_role("button", name="Next", exact=True).click()
    page.keyboard.press("Escape")
    step.wait_for(state="hidden")
    page.locator("body").press("F1")
    page.get_by_role("button", name="Take the tour").click()
    page.get_by_role("button", name="Skip").click()
    page.locator(".stop").wait_for(state="hidden")


def test_a_german_page_says_nothing_in_english_adapts_and_keeps_its_state_in_another_language(chromium, server):
    page = chromium.new_page(viewport={"width": 1400, "height": 900}, color_scheme="dark", reduced_motion="reduce")
    Visit(page, f"{server}?lang=de&tab=roll", near=True)
    assert page.evaluate("document.documentElement.lang") == "de"
    it_says_nothing_in_english(page)
    the_wheel(page)
    decimal_commas(page)
    its_look(page)
    before = page.url
    page.get_by_role("radio", name="English").click()
    page.wait_for_function("document.documentElement.lang == 'en' && window.__tippe?.top3d?.pictures > 0")
    assert page.url == before.replace("lang=de", "lang=en")
    assert page.get_by_role("slider", name="Jellett’s constant").input_value() == "6.5"
    page.close()


def it_says_nothing_in_english(page):
    """Nor do its errors and its tour."""
    page.get_by_role("slider", name="Jellett-Konstante").press("ArrowLeft")
    page.wait_for_url(re.compile(r"\?v=4&.*&KJ=6\.99&.*&lang=de&level=research$"))
    inertia = page.get_by_label("Trägheitsmoment um die Achse, in M R Quadrat")
    inertia.fill("2")
    inertia.press("Enter")
    page.get_by_text("I3 = 2 ist nicht möglich: erlaubt ist 0 < I3 ≤ 2 I1 = 0,798.").wait_for()
    inertia.fill("viel")
    inertia.press("Enter")
    page.get_by_text("„viel“ ist keine Zahl.").wait_for()
    page.get_by_role("button", name="Mehr").click()
    page.get_by_role("button", name="Rundgang").click()
    said = []
    for i in range(1, 6):
        page.get_by_role("dialog").filter(has_text=f"{i} von 5").wait_for()
        said += page.evaluate(SAID)
        page.locator(".stop .next").click()
    page.get_by_role("button", name="Teilen").click()
    page.wait_for_function("box => box.value", arg=page.get_by_label("Link zu dem, was").element_handle())
    page.get_by_role("button", name="Schließen", exact=True).wait_for()
    said += page.evaluate(SAID)
    german = words_of("de")
    english = {words for words in words_of("en") - german if re.search("[A-Za-z]{3}", words)}
    assert "Die Konstanten" in said and "Teilen, was zu sehen ist" in said
    assert english & set(said) == set()
    long = [words for words in english if len(words) > 11]
    assert [words for words in long if any(words in each for each in said)] == []
    page.keyboard.press("Escape")
    inertia.fill("0,408")
    inertia.press("Enter")
    page.get_by_text("„viel“ ist keine Zahl.").wait_for(state="hidden")


LOOKS = "name => document.documentElement.dataset.look === name"
HIGHER = "([part, before]) => part.getBoundingClientRect().top < before"


def the_wheel(page):
    """Over the top it scrolls the page, and with Ctrl it zooms."""
    top = page.locator("canvas[aria-label^='Der Kreisel']").first
    top.click()  # also after a click, which does not turn it
    slider = page.get_by_role("slider", name="Jellett-Konstante").element_handle()
    box, before = top.bounding_box(), slider.bounding_box()["y"]
    page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    page.mouse.wheel(0, 100)
    page.wait_for_function(HIGHER, arg=[slider, before])
    assert top.bounding_box()["y"] > 0  # it stays in sight
    assert "view=" not in page.url
    page.keyboard.down("Control")
    page.mouse.wheel(0, 100)
    page.keyboard.up("Control")
    page.wait_for_function("() => location.search.includes('view=')")


TICKS = """ticks => {
  const models = Bokeh.documents.flatMap((doc) => [...doc.all_models])
  const ours = models.find(({ type }) => type === "CustomJSTickFormatter")
  const theirs = new (Bokeh.Models.get("BasicTickFormatter"))()
  return [ours, theirs].map(each => each.doFormat(ticks, { loc: 0 }))
}"""


def decimal_commas(page):
    """On axes, in fields, and in 3-D."""
    page.locator(".clock").filter(has_text=re.compile(r"^\d+,\d\d s$")).wait_for()
    field = page.get_by_role("textbox", name="Jellett-Konstante, in Wurzel g durch R")
    field.fill("6,5")
    field.press("Enter")
    page.wait_for_function("() => /KJ=6\\.5/.test(location.search)")
    page.get_by_role("radio", name=say("research.panels.time", "de")).click()
    page.locator("[data-figure=times-theta]").wait_for()
    for given in ([-0.5, 0.1 + 0.2, 1], [0, 0.5, 1], [-2e-7, -1e-7, 0], [0, 50000, 100000], [1.0001, 1.0002], []):
        ours, theirs = page.evaluate(TICKS, given)
        assert ours == [each.replace(".", ",") for each in theirs], given
    assert page.evaluate(TICKS, [-0.5, 0.1 + 0.2, 1])[0] == ["−0,5", "0,3", "1"]
    assert page.evaluate(TICKS, [-2.5e-7, -1e-7])[0] == ["−2,500e−7", "−1,000e−7"]


def its_look(page):
    """It is dark where the system is, until a person chooses."""
    page.wait_for_function(LOOKS, arg="dark")
    page.get_by_role("button", name="Mehr", exact=True).click()
    box = page.get_by_label("dunkel", exact=True)
    assert box.is_checked() and "dark" not in page.url
    for look in ("light", "dark"):
        page.emulate_media(color_scheme=look)
        page.wait_for_function(LOOKS, arg=look)
    box.click()
    page.wait_for_function(LOOKS, arg="light")
    page.wait_for_function("() => location.search.includes('dark=no')")
    assert not box.is_checked()
