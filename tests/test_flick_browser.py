"""A flick on the top of the Lab in Chromium: it pushes a top that moves, and spins one at rest."""

import re

import numpy as np
import pytest
from components import *  # noqa: F403
from lab_page import TIME, TOPS, UNIT, pause
from playwright.sync_api import expect
from test_lab_hands_browser import SEEK, middle

pytestmark = pytest.mark.served

SAID = re.compile(r"[\d.]+")
TOUCH = "canvas => !canvas.dispatchEvent(new TouchEvent('touchstart', { bubbles: true, cancelable: true }))"


def flicked(page, across, down=0):
    """What is said at the arrow of a flick, before it is let go; the top stays where it is meanwhile."""
    x, y = middle(page.locator(".top canvas").first)
    page.mouse.move(x, y + 20)
    assert not page.locator(".top canvas").first.evaluate(TOUCH)  # a finger would scroll the page
    page.mouse.down()
    assert page.locator(".top canvas").first.evaluate(TOUCH)
    page.mouse.move(x + across / 2, y + 20 + down / 2)
    page.mouse.move(x + across, y + 20 + down)
    label = page.locator(".labels .point").filter(has_text=SAID).first
    label.wait_for()
    said = label.inner_text()
    page.mouse.up()
    return said


def at(page, t):
    page.get_by_role("slider", name="Time").evaluate(SEEK, t)
    page.wait_for_function(f"t => Math.abs({TIME} * {UNIT} - t) < 1e-3", arg=t)
    page.wait_for_function(f"{TOPS}[0].motions.shown == {TOPS}[0].motions.received")


def test_a_flick_spins_a_top_at_rest_and_pushes_one_that_moves(lab):
    found = lab()
    page, start = found.page, found.lab.explorer
    said = flicked(page, -100)
    assert said.startswith("let go at −") and said.endswith(" turns a second")
    turns = -float(SAID.search(said).group())
    found.until(lambda: start.spin == turns)
    assert -40 < turns < -2 and not start.pushes
    page.get_by_role("button", name="Pause").wait_for()
    pause(page)
    at(page, 0.5)
    before = found.lab.scene.motions["ordinary"]
    eye = page.evaluate(f"{TOPS}[0].eye")
    said = flicked(page, 60)
    found.until(lambda: len(start.pushes) == 1)
    [push] = start.pushes
    assert said.endswith(" mN s") and push.size == pytest.approx(float(SAID.search(said).group()), rel=0.01)
    assert push.t == pytest.approx(0.5, abs=1e-3)
    t, moved = before.seconds, before.trajectory
    phi, theta = (np.interp(push.t, t, angles) for angles in (moved.phi, moved.theta))
    right = np.cross([0.0, 0.0, 1.0], eye)
    x, y, z = push.impulse
    space = [x * np.cos(phi) - y * np.sin(phi), x * np.sin(phi) + y * np.cos(phi), z]
    assert np.dot(space, right) / np.linalg.norm(right) > 0.99 * push.size  # to the right
    height = np.sin(theta) * push.point[1] + np.cos(theta) * push.point[2]
    R = 1e3 * before.start.scales.R
    assert np.linalg.norm(push.point) == pytest.approx(R, rel=0.02) and abs(height) < R  # on the ball
    page.get_by_role("button", name="Pause").wait_for()  # it goes on from there
    expect(page.get_by_role("status").filter(has_text="You pushed it at 0.50 s")).to_be_visible()
    pause(page)
    arrow = page.locator(".labels .point").filter(has_text=said).first
    for t, is_seen in ((0.4, False), (0.51, True), (2.0, False)):
        at(page, t)
        expect(arrow).to_be_visible(visible=is_seen)


def test_keys_push_it_and_what_is_too_strong_is_said_and_changes_nothing(lab):
    found = lab()
    page, start = found.page, found.lab.explorer
    at(page, 0.5)
    canvas = page.locator(".top canvas").first
    canvas.press("Alt+Shift+ArrowUp")
    found.until(lambda: len(start.pushes) == 1)
    pushes, canvas_box = start.pushes, canvas.bounding_box()
    assert pushes[0].point[:2] == (0.0, 0.0) and pushes[0].impulse[2] == 0.0
    page.get_by_role("button", name="Pause").wait_for()
    pause(page)
    at(page, 0.9)
    flicked(page, 3 * canvas_box["width"])
    expect(page.get_by_role("status").filter(has_text="are too many")).to_be_visible()
    assert start.pushes == pushes
    page.get_by_role("button", name="Spin it").click()
    found.until(lambda: not start.pushes)
