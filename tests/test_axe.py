"""The page checked by axe-core for WCAG 2.2 A and AA: every tab and its contents, each in a look of its own, and on
a phone."""

import pytest
from axe_playwright_python.base import AXE_SCRIPT
from visiting import WHOLE, go_to

pytestmark = pytest.mark.served

RULES = {"type": "tag", "values": ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa"]}
CONTRAST = {"type": "rule", "values": ["color-contrast"]}
AXE = """(options) => {
    window.found = null
    axe.run(document, {resultTypes: ["violations"], preload: false, ...options}).then(({violations}) => {
        window.found = violations.flatMap(({id, nodes}) => nodes.map(({target, html, any}) =>
            `${id}: ${target} ${html.slice(0, 200)} ${any[0]?.message ?? ""}`))
    }, (error) => { window.found = [`${error}`] })
}"""


def violations(page, rules=RULES):
    """The violations that axe-core, already loaded in the page, finds. Playwright waits without end for a promise, but
    not for a value."""
    page.evaluate(AXE, {"runOnly": rules})
    return page.wait_for_function("window.found").json_value()


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


LIGHT, DARK, LARGE, DARK_LARGE = (False, False), (True, False), (False, True), (True, True)

# What a person does on one visit, step by step, and the look in which axe-core then checks the page.
STEPS = {
    "Roll": (LIGHT, [click("button", "effective potential"), click("button", "unrolled"), below]),
    "the keys": (LIGHT, [press("?"), awaited("dialog[open]")]),
    "the tour": (DARK_LARGE, [click("button", "Take the tour"), awaited(".stop")]),
    "Share": (DARK_LARGE, [click("button", "Skip"), click("button", "Share"),
                           awaited("svg:has(title:text-is('QR code of the link'))")]),
    "an error": (DARK_LARGE, [press("Escape"), click("button", "initial state"), an_error]),
    "Three planes": (DARK, [high, room("Three planes"), click("radio", "All three"), click("button", "viscous"),
                            click("button", "by its constants")]),
    "Build a top": (DARK, [room("Build a top"), awaited("button:text-is('Add')")]),
    "a list": (DARK, [lambda page: page.get_by_label("Presets").first.click(), awaited("[role=listbox]")]),
    "Families": (LARGE, [escape, room("Families"), awaited("button:text-is('Compute the map')")]),
    "Maps": (LARGE, [room("Maps"), awaited("h2:text-is('Where runs and formula disagree')")]),
    "Measure": (LARGE, [room("Measure"), awaited("button:text-is('Example: it rolls')")]),
    "Lab, its path": (LIGHT, [room("Lab"), click("radio", "Explore"), click("radio", "Ordinary"), click("tab", "Path"),
                              awaited(".answer .dot"),
                              lambda page: page.locator("summary:text-is('Numbers')").click()]),
    "Lab, all three": (LIGHT, [click("radio", "All three"), awaited(".keeps table")]),
    "the menu": (DARK, [click("radio", "Ordinary"), click("button", "More"), awaited(".menu:visible")]),
    "Learn": (DARK, [room("Learn"), awaited(".covered")]),
    "Learn, seen": (DARK, [click("radio", "It stays upright as long as it spins"),
                           click("button", "Watch what it does"), to_the_end]),
    "Derivation": (LIGHT, [click("button", "The derivation"), awaited(".line .sides b"),
                           lambda page: page.locator(".line button:visible").first.click()]),
    "Teachers": (LIGHT, [click("button", "For teachers"),
                         awaited("button:text-is('Close the class and forget its votes')")]),
    "presented": (DARK_LARGE, [click("button", "Present to a class (P)"), awaited(".lesson.present"),
                               press("ArrowRight"), awaited(".link-said:has-text('?vote=')")]),
    "History": (DARK_LARGE, [press("Escape"), click("button", "History"), awaited("ol:visible >> nth=0")]),
}  # fmt: skip


def checked(page, look, where):
    page.wait_for_function("window.Bokeh?.documents?.[0]?.is_idle")
    page.evaluate(LOOK, look)
    assert violations(page) == [], where


COLOURS = """() => {
    const all = (root) => [...root.querySelectorAll("*")]
        .flatMap((e) => [e, ...e.shadowRoot ? all(e.shadowRoot) : []])
    const kinds = "[role=tab][aria-selected=false], .MuiToggleButton-root:not(.Mui-selected), label"
    const widgets = all(document).filter((e) => e.matches(kinds) && e.offsetParent)
    return widgets.map((e) => getComputedStyle(e).color.match(/[\\d.]+/g).slice(0, 3).map(Number))
        .map(([r, g, b]) => r + g + b)
}"""


def the_widgets_go_dark_at_once(page):
    """In the same frame as the page; they are not created again one by one."""
    quiet = 0x5B + 0x68 + 0x75  # the colour --faint of the other tabs in the head
    light = page.evaluate(COLOURS)
    page.evaluate(LOOK, DARK)
    dark = page.evaluate(COLOURS)
    page.evaluate(LOOK, LIGHT)
    assert len(light) == len(dark) > 10
    assert max(light) <= quiet < 450 < min(dark)


def test_axe_finds_nothing_and_no_other_machine_is_asked(chromium, server):
    with chromium.new_context(viewport={"width": 1400, "height": 1000}, reduced_motion="reduce") as context:
        page, asked = context.new_page(), []
        page.on("request", lambda request: asked.append(request.url))
        page.goto(f"{server}?tab=roll")
        page.wait_for_function("window.__tippe?.top3d?.pictures > 0 && Bokeh.documents[0].is_idle")
        assert not page.evaluate("__tippe.top3d.playing")
        the_widgets_go_dark_at_once(page)
        page.evaluate(AXE_SCRIPT)
        for name, (look, steps) in STEPS.items():
            for step in steps:
                step(page)
            checked(page, look, name)
            if name == "presented":
                vote = f"http://{page.locator('.link-said').inner_text()}"
        page.goto(vote)
        page.get_by_role("radio").first.wait_for()
        page.evaluate(AXE_SCRIPT)
        assert violations(page) == [], "a vote"
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
        checked(page, LIGHT, name)
    for place in (4, 6):  # the two arms in place of the top; the question about one's own
        page.locator(".crumbs button").nth(place).click()
        page.locator(".option:visible").first.wait_for()
        assert violations(page) == [], place
        page.evaluate(LOOK, DARK)
        assert violations(page, CONTRAST) == [], place
        page.evaluate(LOOK, LIGHT)
    phone.close()
