"""The page checked by axe-core for WCAG 2.2 A and AA: every tab and its contents, in every look, and on a phone."""

import pytest
from axe_playwright_python.base import AXE_SCRIPT
from visiting import WHOLE, go_to

pytestmark = pytest.mark.served

RULES = {"type": "tag", "values": ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa"]}
CONTRAST = {"type": "rule", "values": ["color-contrast"]}
AXE = """async (options) => {
    const {violations} = await axe.run(document, {resultTypes: ["violations"], preload: false, ...options})
    return violations.flatMap(({id, nodes}) => nodes.map(({target, html, any}) =>
        `${id}: ${target} ${html.slice(0, 200)} ${any[0]?.message ?? ""}`))
}"""


def violations(page, rules=RULES, but=()):
    """The violations that axe-core, already loaded in the page, finds. but: rules to skip."""
    return page.evaluate(AXE, {"runOnly": rules, "rules": {rule: {"enabled": False} for rule in but}})


# Only the browser knows the look: once it is set there, the page has it.
LOOK = """([dark, large]) => [...Bokeh.documents[0]._all_models.values()]
    .find((m) => m.data?.attributes && "on_dark" in m.data.attributes).data.setv({dark, large})"""


def click(role, name):
    return lambda page: page.get_by_role(role, name=name, exact=True).first.click()


def awaited(selector):
    return lambda page: page.locator(selector).first.wait_for()


def press(key):
    return lambda page: page.locator("body").press(key)


def escape(page):
    page.keyboard.press("Escape")
    page.locator("[role=dialog]:visible, [role=listbox]:visible").wait_for(state="hidden")


def high(page):
    """Makes the window tall, so that a whole long tab is visible; the cards of Roll would grow with it."""
    page.set_viewport_size({"width": page.viewport_size["width"], "height": 3000})


def an_error(page):
    page.locator(":text('its rate'):visible").wait_for()
    entry = page.locator("input[type=text]:visible").first
    entry.fill("half")
    entry.press("Enter")
    page.locator("[role=alert]:visible").first.wait_for()


def to_the_end(page):
    bar = page.get_by_role("slider", name="Time", exact=True).locator("visible=true").first
    bar.focus()
    bar.press("End")
    page.locator(".told .big").wait_for()


def room(name):
    return lambda page: go_to(page, name)


def below(page):
    page.get_by_role("button", name="unrolled").scroll_into_view_if_needed()


# What a person does on one visit, step by step, and what axe-core then checks: the first half of the steps light, the
# others dark; with a star also the contrast in the large look. To change the look is what costs most.
STEPS = {
    "Roll *": [click("button", "effective potential"), click("button", "unrolled")],
    "Roll, below": [below],
    "the keys": [press("?"), awaited("dialog[open]")],
    "the tour": [click("button", "Take the tour"), awaited(".stop")],
    "Share": [click("button", "Skip"), click("button", "Share"),
                awaited("svg:has(title:text-is('QR code of the link'))")],
    "an error": [press("Escape"), click("button", "initial state"), an_error],
    "Three planes *": [high, room("Three planes"), click("radio", "All three"),
                       click("button", "viscous")],
    "Three planes otherwise": [click("button", "smoothed"), click("radio", "Ice"),
                               click("button", "by its constants")],
    "Build a top": [room("Build a top"), awaited("button:text-is('Add')")],
    "a list": [lambda page: page.get_by_label("Presets").first.click(), awaited("[role=listbox]")],
    "Families": [escape, room("Families"), awaited("button:text-is('Compute the map')")],
    "Maps": [room("Maps"), awaited("h2:text-is('Where runs and formula disagree')")],
    "Measure *": [room("Measure"), awaited("button:text-is('Example: it rolls')")],
    "Lab *": [room("Lab"), click("radio", "Explore"), awaited("button:text-is('Spin it')")],
    "Lab, its spin": [click("tab", "Spin"), awaited("[aria-selected=true]:text-is('Spin')")],
    "Lab, its path": [click("tab", "Path"), awaited(".answer .dot"),
                      lambda page: page.locator("summary:text-is('Numbers')").click()],
    "Lab, rough *": [click("tab", "Energy"), click("radio", "Rough"), awaited(".lab[data-table=rough]")],
    "Lab, ice": [click("radio", "Ice"), awaited(".lab[data-table=ice]")],
    "Lab, all three *": [click("radio", "All three"), awaited(".keeps table")],
    "the menu": [click("radio", "Ordinary"), click("button", "More"), awaited(".menu:visible")],
    "Learn *": [room("Learn"), awaited(".covered")],
    "Learn, seen *": [click("radio", "It stays upright as long as it spins"), click("button", "Watch what it does"),
                      to_the_end],
    "Derivation": [click("button", "The derivation"), awaited(".line .sides b"),
                   lambda page: page.locator(".line button:visible").first.click()],
    "Teachers": [click("button", "For teachers"), awaited("button:text-is('Close the class and forget its votes')")],
    "presented": [click("button", "Present to a class (P)"), awaited(".lesson.present"), press("ArrowRight"),
                  awaited(".link-said:has-text('?vote=')")],
    "History": [press("Escape"), click("button", "History"), awaited("ol:visible >> nth=0")],
}  # fmt: skip
LIGHT, DARK, LARGE, DARK_LARGE = (False, False), (True, False), (False, True), (True, True)


def test_axe_finds_nothing_anywhere_in_any_look_and_no_other_machine_is_asked(chromium, server):
    page = chromium.new_context(viewport={"width": 1400, "height": 1000}, reduced_motion="reduce").new_page()
    asked = []
    page.on("request", lambda request: asked.append(request.url))
    page.goto(f"{server}?tab=roll")
    page.wait_for_function("window.__tippe?.top3d?.pictures > 0 && Bokeh.documents[0].is_idle")
    assert not page.evaluate("__tippe.top3d.playing")
    page.evaluate(AXE_SCRIPT)
    vote = None
    for i, (name, steps) in enumerate(STEPS.items()):
        look, large = (LIGHT, LARGE) if 2 * i < len(STEPS) else (DARK, DARK_LARGE)
        for step in steps:
            step(page)
        page.wait_for_function("Bokeh.documents[0].is_idle")
        if 2 * i in (len(STEPS), len(STEPS) + 1):
            page.evaluate(LOOK, look)
        found = {look: violations(page)}
        if name.endswith("*"):
            page.evaluate(LOOK, large)
            found[large] = violations(page, CONTRAST)
            page.evaluate(LOOK, look)
        assert not any(found.values()), (name, found)
        if name == "presented":
            vote = f"http://{page.locator('.link-said').inner_text()}"
    page.goto(vote)
    page.get_by_role("radio").first.wait_for()
    page.evaluate(AXE_SCRIPT)
    assert violations(page) == []
    page.context.close()
    assert len(asked) > 10
    assert [url for url in asked if not url.startswith((server.rsplit("/", 1)[0], "data:", "blob:"))] == []


ON_A_PHONE = {
    "Roll": "canvas",
    "Three planes": "canvas:visible",
    "Build a top": "button:text-is('Add')",
    "Families": "button:text-is('Compute the map')",
    "Maps": "h2:text-is('Where runs and formula disagree')",
    "Measure": "button:text-is('Example: it rolls')",
    "Learn": "main .covered",
}


def test_axe_finds_nothing_on_a_phone(chromium, server):
    phone = chromium.new_context(viewport={"width": 390, "height": 844}, reduced_motion="reduce", is_mobile=True,
                                 has_touch=True, user_agent="Mozilla/5.0 (Linux; Android 14) Mobile")  # fmt: skip
    page = phone.new_page()
    page.goto(server)  # the page on arrival
    awaited("button:text-is('Spin it'):visible")(page)
    page.evaluate(AXE_SCRIPT)
    assert violations(page) == [], "the lab"
    page.goto(f"{server}?tab=roll")
    page.wait_for_function(f"() => window.Bokeh?.documents?.length && ({WHOLE})()")
    page.evaluate(AXE_SCRIPT)
    page.get_by_role("button", name="More", exact=True).click()
    assert violations(page) == [], "the menu"
    for name, ready in ON_A_PHONE.items():
        go_to(page, name)
        awaited(ready)(page)
        page.wait_for_function("Bokeh.documents[0].is_idle")
        assert violations(page, but=["color-contrast"]) == [], name  # which does not depend on the width
    for place in (4, 6):  # the two arms in place of the top; the question about one's own
        page.locator(".crumbs button").nth(place).click()
        page.locator(".option:visible").first.wait_for()
        assert violations(page) == [], place
        page.evaluate(LOOK, DARK)
        assert violations(page, CONTRAST) == [], place
        page.evaluate(LOOK, LIGHT)
    phone.close()


def test_the_widgets_go_dark_at_once(visit):
    """In the same frame as the page; they are not created again one by one."""
    colour = """() => {
        const all = (root) => [...root.querySelectorAll("*")]
            .flatMap((e) => [e, ...e.shadowRoot ? all(e.shadowRoot) : []])
        const kinds = "[role=tab][aria-selected=false], .MuiToggleButton-root:not(.Mui-selected), label"
        const widgets = all(document).filter((e) => e.matches(kinds) && e.offsetParent)
        return widgets.map((e) => getComputedStyle(e).color.match(/[\\d.]+/g).slice(0, 3).map(Number))
            .map(([r, g, b]) => r + g + b)
    }"""
    quiet = 0x5B + 0x68 + 0x75  # the colour --faint of the other tabs in the head
    light = visit.page.evaluate(colour)
    visit.page.evaluate(LOOK, DARK)
    dark = visit.page.evaluate(colour)
    assert len(light) == len(dark) > 10
    assert max(light) <= quiet < 450 < min(dark)
