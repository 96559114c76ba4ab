"""What the top does, told in Chromium beside the picture of it: in words, as a trace on its ball, as sound."""

import re

import numpy as np
import pytest
from axe import violations
from components import *  # noqa: F403
from lab_page import TIME, come, pause

from app.model.run import whole_on
from app.model.setup import start_of
from app.text import listed

pytestmark = pytest.mark.served


def test_what_it_does_is_told_in_words_and_its_trace_is_on_the_ball(lab):
    run, page = whole_on("ordinary", start_of("Leine and Glocker's toy", 28.65, 5.73, 0.3)), lab(draws=True).page
    moved, unit = run.trajectory, run.start.scales.time
    told, time = page.get_by_role("status", name="What the top does now"), page.get_by_role("slider", name="Time")
    for key in ("Home", "End"):
        time.press(key)
        row = 0 if key == "Home" else -1
        said = told.filter(has_text=f"Tilt {np.degrees(moved.theta[row]):.0f} degrees, on its ball.")
        said.wait_for(state="attached")
        spin = moved.omega[row, 2]
        above = moved.omega[row, 1] * np.sin(moved.theta[row]) + spin * np.cos(moved.theta[row])
        told_of = r"(?:from above it turns|from its stem) ([\d.]+ times|hardly)(.*?)[,.]"
        ways = re.findall(told_of, said.text_content())
        for (much, way), rate in zip(ways, (above, spin), strict=True):
            turns = rate / unit / (2 * np.pi)
            assert float(much.replace("hardly", "0").split()[0]) == pytest.approx(abs(turns), abs=0.51)
            assert much == "hardly" or way.endswith("anticlockwise" if turns > 0 else "second clockwise")
    page.evaluate("window.dispatchEvent(new CustomEvent('tippe:seek:lab', {detail: {t: 60}}))")
    told.filter(has_text="on its stem alone").wait_for(state="attached")
    its_trace_is_on_the_ball_beside_its_map(page)


def its_trace_is_on_the_ball_beside_its_map(page):
    page.get_by_role("tab", name="Trace").click()
    page.get_by_role("slider", name="Time").press("End")
    page.get_by_text("at a tilt of 84° it turns back").wait_for()
    for cap in listed("lab_view.view.answers.trace.caps"):
        page.locator(".answer svg text", has_text=cap).wait_for()
    drawn, whole = (page.locator(f".answer path.{kind}").get_attribute("d") for kind in ("past", "rest"))
    assert drawn == whole and len(whole) > 10_000
    assert violations(page) == []


LISTENED = """
window.made = []
const Context = window.AudioContext
window.AudioContext = class extends Context {
  constructor() { super(); window.made.push(this); this.gains = [] }
  createGain() { const gain = super.createGain(); this.gains.push(gain.gain); return gain }
}
"""


def test_it_is_silent_until_a_person_wants_sound_and_whenever_it_stands_still(server, chromium):
    """Its rubbing and its hum; Chromium has a clock for its sound even where nothing can be heard."""
    with chromium.new_context(viewport={"width": 1400, "height": 900}, reduced_motion="no-preference") as context:
        context.add_init_script(LISTENED)
        page = come(context.new_page(), f"{server}?").page
        page.locator(".lab[data-whole]").wait_for()
        page.wait_for_function(f"{TIME} > 2")  # it plays
        assert page.evaluate("made.length") == 0
        page.get_by_role("button", name="More", exact=True).click()
        page.get_by_role("switch", name="sound").check()
        page.wait_for_function("made.length == 1 && made[0].state == 'running' && made[0].gains[0].value > 0.01")
        page.wait_for_function("made[0].gains[1].value > 0.01")
        pause(page)
        page.wait_for_function("made[0].state == 'suspended'")
        page.get_by_role("button", name="Play", exact=True).click()
        page.wait_for_function("made[0].state == 'running'")
        page.get_by_role("button", name="More", exact=True).click()
        page.get_by_role("switch", name="sound").uncheck()
        page.wait_for_function("made[0].state == 'closed'")
        page.reload()
        page.wait_for_function(f"{TIME} > 2")
        assert page.evaluate("made.length") == 0 and "sound" not in page.url
