"""axe-core itself, and in every room on a phone. On a large screen the tests of each room ask it, in the look that they
choose; test_lab_browser.py asks it on a phone."""

import pytest
from axe import contrast, violations
from visiting import go_to

pytestmark = pytest.mark.served

ON_A_PHONE = {
    "Roll": "canvas:visible",
    "Three planes": "canvas:visible",
    "Build a top": "button:text('Save this top')",
    "Families": "button:text-is('Compute the map')",
    "Maps": "h2:text-is('Where runs and formula disagree')",
    "Measure": "button:text-is('Example: it rolls')",
    "Learn": "main .covered",
}


FAULTS = "<html lang=en><title>t</title><main><h1>Seen</h1><button></button><p style='color: #aaa'>pale</p></main>"


def test_axe_finds_what_is_there(chromium):
    page = chromium.new_page()
    page.set_content(FAULTS)
    for found, ids in ((violations(page), ["button-name", "color-contrast"]), (contrast(page), ["color-contrast"]),
                       (violations(page, leaves_out=["color-contrast"]), ["button-name"])):  # fmt: skip
        assert [each.partition(":")[0] for each in found] == ids
    page.close()


def opened_on_a_phone(chromium, server):
    phone = chromium.new_context(viewport={"width": 390, "height": 844}, reduced_motion="reduce", is_mobile=True,
                                 has_touch=True, user_agent="Mozilla/5.0 (Linux; Android 14) Mobile")  # fmt: skip
    page = phone.new_page()
    page.goto(server)  # the page on arrival
    page.locator("button:text-is('Spin it'):visible").wait_for()
    page.locator("#first").wait_for(state="detached")
    return page


def open_room(page, name):
    if not page.get_by_role("radio", name="Research").locator("visible=true").count():
        page.get_by_role("button", name="More", exact=True).click()
    go_to(page, name)
    page.locator(ON_A_PHONE[name]).first.wait_for()
    page.wait_for_function("window.Bokeh?.documents?.[0]?.is_idle")


@pytest.mark.long
def test_axe_finds_nothing_in_any_room_on_a_phone(chromium, server):
    """Of the colours only where they are of the phone's own parts: all others have those of a large screen."""
    page = opened_on_a_phone(chromium, server)
    for name in ON_A_PHONE:
        open_room(page, name)
        assert violations(page, leaves_out=["color-contrast"]) == [], name
    page.context.close()
