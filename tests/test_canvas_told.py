"""Who does not see a stage is told what it shows, at the picture itself and in the words of the story."""

import numpy as np
import pytest
from lab_page import arrival

from app.model.run import whole_on
from app.model.setup import start_of
from app.model.story import story
from app.page.site import mailed
from app.text import say

pytestmark = pytest.mark.served

# Of each canvas that is seen, its name.
NAMES = """() => {
  const found = [], visit = (root) => {
    for (const each of root.querySelectorAll("*")) {
      if (each.localName == "canvas" && each.getClientRects().length && each.role == "img") found.push(each.ariaLabel)
      if (each.shadowRoot) visit(each.shadowRoot)
    }
  }
  visit(document)
  return found
}"""


SIZE = {"viewport": {"width": 1400, "height": 900}, "reduced_motion": "reduce", "draws": True}


def told(page, *words):
    """Waits until the name of a canvas has all of these words."""
    page.wait_for_function(
        f"words => ({NAMES})().some((name) => words.every((each) => name.includes(each)))", arg=words
    )


@pytest.fixture
def visit(server, chromium):
    """visit(query) opens the page there."""
    with chromium.new_context(**SIZE) as context:

        def open_(query):
            page = context.new_page()
            page.goto(f"{server}?{query}")
            return page

        yield open_


def of_the_arrival(page):
    run = whole_on("ordinary", start_of("Leine and Glocker's toy", 28.65, 5.73, 0.3))
    time = page.get_by_role("slider", name="Time")
    for key, at in (("Home", 0), ("End", -1)):
        time.press(key)
        _, headline, *_ = story(run).stages[at]
        told(page, say("lab_view.view.stage"), headline, f"Tilt {np.degrees(run.trajectory.theta[at]):.0f} degrees")


def test_the_lab_and_a_mailed_page_tell_what_the_top_does(server, chromium, tmp_path):
    path = tmp_path / "mailed.html"
    path.write_bytes(mailed("", {}))
    with arrival(server, chromium, draws=True) as page:
        of_the_arrival(page)
        letter = page.context.new_page()
        letter.goto(path.as_uri())
        letter.locator(".lab[data-whole]").wait_for()
        of_the_arrival(letter)


def test_each_of_three_tops_tells_what_it_does(visit):
    page = visit("v=4&table=three")
    for table in ("ordinary", "rough", "ice"):
        told(page, say(f"lab_view.view.labels.{table}"), "degrees")
    assert len(page.evaluate(NAMES)) == 3


def test_learn_and_its_big_screen_tell_the_tilt_and_only_after_the_guess_what_the_top_does(visit):
    page = visit("v=4&tab=learn")
    told(page, "Tilt ")
    [before] = page.evaluate(NAMES)
    page.keyboard.press("Alt+p")
    page.locator(".present").wait_for()
    told(page, "Tilt ")
    page.keyboard.press("Escape")
    page.locator(".option").first.click()
    page.locator(".dock .primary").first.click()
    page.get_by_role("slider", name=say("learn.view.time")).press("End")
    shorts = [
        short for *_, short in story(whole_on("ordinary", start_of("Leine and Glocker's toy", 28.65, 5.73, 0.3))).stages
    ]
    page.wait_for_function(
        f"shorts => ({NAMES})().some((name) => shorts.some((each) => name.includes(each)))", arg=shorts
    )
    assert not any(short in before for short in shorts)


def test_build_tells_how_heavy_and_large_the_top_is(visit):
    told(visit("v=4&tab=build-a-top"), say("build.spin.top"), "mm wide", "mm high")
