"""Explore, Research and back in Chromium; and a link that is refused, and mended with its button."""

import pytest
from lab_page import come, entry, put
from playwright.sync_api import expect
from visiting import PATIENCE

pytestmark = pytest.mark.served

MUJOCO = ("v=2&tab=three-planes&by=hand&body=BareSphere_.02_.0554745694_.271579_.573941_.578216&spin=31.831&tilt=.3"
          "&mu_k=1&law=coulomb&stem=no")  # fmt: skip
BEFORE = "Before: Friction 0.30"


def level(page, name):
    page.get_by_role("radio", name=name, exact=True).locator("visible=true").first.click()


def table(page):
    return page.locator(".rooms [role=radio][aria-checked=true]")


def test_explore_research_explore_changes_nothing(server, chromium):
    visit = come(chromium.new_page(viewport={"width": 1400, "height": 900}), f"{server}?")
    page = visit.page
    put(page, "Friction", "0.12")
    ghost = page.get_by_text(BEFORE).locator("visible=true").first
    ghost.wait_for()
    page.wait_for_url("**mu_k=.12*")
    undo = page.get_by_role("button", name="Undo").locator("visible=true").first
    expect(undo).to_be_enabled()
    for _ in range(2):
        level(page, "Research")
        expect(table(page)).to_have_text("Ordinary", timeout=PATIENCE)
        sliding = page.locator("input[type=range][data-input=mu]")
        expect(sliding).to_have_value("0.12", timeout=PATIENCE)
        expect(sliding).to_be_visible(timeout=PATIENCE)
        level(page, "Explore")
        expect(entry(page, "Friction").first).to_have_value("0.12")
        expect(ghost).to_be_visible()
        page.locator(".lab[data-table=ordinary]").wait_for()
        assert "table=" not in page.url and "mu_k=.12" in page.url
    undo.click()
    expect(entry(page, "Friction").first).to_have_value("0.30")
    expect(undo).to_be_disabled()
    page.get_by_role("radio", name="Ice", exact=True).locator("visible=true").first.click()
    page.locator(".lab[data-table=ice]").wait_for()
    level(page, "Research")
    expect(table(page)).to_have_text("Ice", timeout=PATIENCE)
    page.close()
    assert not visit.errors


def test_a_link_with_too_little_static_friction_says_so_and_takes_the_nearest(server, chromium):
    page = chromium.new_page(viewport={"width": 1400, "height": 900})
    errors = []
    page.on("pageerror", lambda error: errors.append(error))
    page.goto(f"{server}?{MUJOCO}")
    wrong = page.get_by_text("Friction at rest is the larger one.")
    wrong.wait_for(timeout=PATIENCE)
    expect(page.get_by_text("The motions are being computed")).to_have_count(0)
    page.get_by_role("button", name="Take 1", exact=True).click()
    expect(wrong).to_have_count(0, timeout=PATIENCE)
    page.wait_for_url("**mu=1*")
    page.wait_for_function(
        "window.__tippe?.tops?.('planes').some((top) => top.pictures && top.count)", timeout=PATIENCE
    )
    page.close()
    assert not errors
