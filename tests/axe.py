"""axe-core, for the rules of WCAG 2.2 A and AA, on a page that a test has open."""

from axe_playwright_python.base import AXE_SCRIPT

RULES = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa"]
AXE = """([rules, leaves_out]) => {
    window.found = null
    axe.run(document, {resultTypes: ["violations"], preload: false, runOnly: rules,
                       rules: Object.fromEntries(leaves_out.map((rule) => [rule, {enabled: false}]))})
        .then(({violations}) => {
            window.found = violations.flatMap(({id, nodes}) => nodes.map(({target, html, any}) =>
                `${id}: ${target} ${html.slice(0, 200)} ${any[0]?.message ?? ""}`))
        }, (error) => { window.found = [`${error}`] })
}"""

# Only the browser knows the look: once it is set there, the page has it.
LOOK = """([dark, large]) => Bokeh.documents.flatMap((doc) => [...doc.all_models])
    .find((m) => m.data?.attributes && "large" in m.data.attributes).data.setv({dark, large})"""
LIGHT, DARK, LARGE, DARK_LARGE = (False, False), (True, False), (False, True), (True, True)


def violations(page, rules=RULES, leaves_out=()):
    """What axe-core finds. Playwright waits without end for a promise, but not for a value."""
    if not page.evaluate("Boolean(window.axe)"):
        page.evaluate(AXE_SCRIPT)
    page.evaluate(AXE, [rules, leaves_out])
    return page.wait_for_function("window.found").json_value()


def contrast(page):
    """What axe-core finds of colours alone."""
    return violations(page, ["color-contrast"])


def check(page, where, look=LIGHT):
    """axe-core finds nothing in this look, in which the page stays: another one draws all figures again."""
    page.wait_for_function("window.Bokeh?.documents?.[0]?.is_idle")
    page.evaluate(LOOK, look)
    found = violations(page)
    assert found == [], (where, found)
