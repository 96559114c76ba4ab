"""Explore, Research and back, and the browser's history, in Chromium."""

import pytest
from axe import DARK, check
from lab_page import come, entry, put
from playwright.sync_api import expect

pytestmark = pytest.mark.served

BEFORE = "Before: Friction 0.30"


def level(page, name):
    page.get_by_role("radio", name=name, exact=True).locator("visible=true").first.click()


def table(page):
    return page.locator(".stage .switch [role=radio][aria-checked=true]")


def levels_change_nothing(page):
    """Explore, Research and back: what was set, its ghost and its step of undo are there."""
    ghost = page.get_by_text(BEFORE).locator("visible=true").first
    ghost.wait_for()
    undo = page.get_by_role("button", name="Undo").locator("visible=true").first
    expect(undo).to_be_enabled()
    level(page, "Research")
    expect(table(page)).to_have_text("Ordinary")
    expect(entry(page, "Friction").first).to_have_value("0.12")
    expect(page.get_by_role("radio", name="Over time", exact=True)).to_be_visible()
    page.get_by_role("button", name="More", exact=True).click()
    page.locator(".menu:visible").wait_for()
    check(page, "the menu", DARK)
    page.keyboard.press("Escape")
    level(page, "Explore")
    expect(entry(page, "Friction").first).to_have_value("0.12")
    expect(ghost).to_be_visible()
    page.locator(".lab[data-table=ordinary]").wait_for()
    page.wait_for_url(lambda url: "level=" not in url)
    assert "table=" not in page.url and "mu_k=.12" in page.url
    undo.click()
    expect(entry(page, "Friction").first).to_have_value("0.30")
    expect(undo).to_be_disabled()


def test_levels_change_nothing_and_rooms_and_steps_of_the_lesson_are_entries_of_the_history(server, chromium):
    with chromium.new_context(viewport={"width": 1400, "height": 900}, reduced_motion="reduce") as context:
        page = come(context.new_page(), f"{server}?").page
        put(page, "Friction", "0.12")
        page.wait_for_url("**mu_k=.12*")
        levels_change_nothing(page)
        put(page, "Friction", "0.12")
        page.wait_for_url("**mu_k=.12*")
        page.get_by_text("Learn", exact=True).locator("visible=true").first.click()
        page.wait_for_url("**tab=learn*")
        step = page.locator("[aria-current=step]")
        first = step.get_attribute("title")
        page.locator("li button:not([aria-current])").locator("visible=true").first.click()
        page.wait_for_url("**step=*")
        second = step.get_attribute("title")
        assert second != first
        page.go_back()
        expect(step).to_have_attribute("title", first)
        page.go_back()
        expect(entry(page, "Friction").first).to_be_visible()
        page.wait_for_url(lambda url: "mu_k=.12" in url and "learn" not in url)  # what was set stays
        page.go_forward()
        page.go_forward()
        expect(step).to_have_attribute("title", second)
