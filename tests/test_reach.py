"""The page without a mouse, without eyes, without patience: by keyboard, as axe-core sees it, and on a first visit."""

import pytest
from axe_playwright_python.sync_playwright import Axe
from visiting import Visit

RULES = {"runOnly": ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa"]}


def violations(page):
    found = Axe().run(page, options=RULES).response["violations"]
    return [(each["id"], node["target"], node["html"][:200]) for each in found for node in each["nodes"]]


def test_keys_of_the_page(visit):
    page = visit.page
    page.locator("body").press("Space")
    page.wait_for_function("!__tippe.top3d.playing")
    index = page.evaluate("__tippe.top3d.index")
    page.locator("body").press("ArrowRight")
    page.wait_for_function("i => __tippe.top3d.index == i", arg=index + 1)
    page.get_by_role("status", name="What the top does now").filter(has_text="The top rolls all along").wait_for(
        state="attached"
    )
    page.locator("body").press("?")
    page.get_by_role("dialog", name="Keys").get_by_text("play or pause").wait_for()
    page.keyboard.press("Escape")
    page.get_by_role("dialog", name="Keys").wait_for(state="hidden")
    slider = page.get_by_role("slider", name="Jellett’s constant")
    slider.press("ArrowRight")  # the control's own there
    assert slider.get_attribute("aria-valuetext") == "7.01 root g over R"
    assert page.evaluate("__tippe.top3d.index") == index + 1
    page.locator("body").press("Space")
    assert not page.evaluate("__tippe.top3d.playing")


@pytest.fixture
def first(chromium, server, request):
    width, height = request.param
    page = chromium.new_page(viewport={"width": width, "height": height})
    visit = Visit(page, server, first=True)
    yield visit
    page.close()
    assert not visit.errors


@pytest.mark.parametrize("first", [(1400, 900), (390, 844)], ids=["1400x900", "390x844"], indirect=True)
def test_the_tour_comes_once_covers_nothing_it_shows_and_can_be_skipped(first):
    page = first.page
    for i in range(1, 6):
        step = page.get_by_role("dialog").filter(has_text=f"{i} of 5")
        step.wait_for()
        box, ring = step.bounding_box(), page.locator(".ring")
        assert box["x"] >= 0 and box["x"] + box["width"] <= page.viewport_size["width"]
        if ring.is_visible():
            shown = ring.bounding_box()
            apart = [
                box["x"] >= shown["x"] + shown["width"] - 8,
                shown["x"] >= box["x"] + box["width"] - 8,
                box["y"] >= shown["y"] + shown["height"] - 8,
                shown["y"] >= box["y"] + box["height"] - 8,
            ]
            assert any(apart), (i, box, shown)
        if i < 5:
            page.get_by_role("button", name="Next", exact=True).click()
    page.keyboard.press("Escape")
    step.wait_for(state="hidden")
    page.reload()
    page.wait_for_function("window.__tippe?.surface3d?.pictures > 0")
    assert not page.locator(".stop").is_visible()
    page.locator("body").press("?")
    page.get_by_role("button", name="Take the tour").click()
    page.get_by_role("button", name="Skip").click()
    page.locator(".stop").wait_for(state="hidden")


@pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
def test_axe_finds_nothing_on_the_first_tab(chromium, server, dark):
    page = chromium.new_context(viewport={"width": 1400, "height": 900}, reduced_motion="reduce").new_page()
    page.add_init_script("localStorage.setItem('tippe:tour', '1')")
    page.goto(server)
    page.wait_for_function("window.__tippe?.surface3d?.pictures > 0 && Bokeh.documents[0].is_idle")
    assert not page.evaluate("__tippe.top3d.playing")
    if dark:
        page.get_by_label("dark", exact=True).click()
        # the widgets follow one after the other
        for name in ("Learn", "at slipping"):
            widget = page.get_by_role("tab" if name == "Learn" else "button", name=name).element_handle()
            page.wait_for_function("e => /rgba?\\(2\\d\\d/.test(getComputedStyle(e).color)", arg=widget)
    assert violations(page) == []
    page.locator("body").press("?")
    page.get_by_role("dialog", name="Keys").wait_for()
    assert violations(page) == []
    page.context.close()
