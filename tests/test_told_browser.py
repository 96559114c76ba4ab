"""What the top does, told in Chromium beside the picture of it: in words and as a trace on its ball."""

import re

import numpy as np
import pytest
from axe import check
from lab_page import arrival

from app.model.run import whole_on
from app.model.setup import start_of
from app.text import listed

pytestmark = pytest.mark.served


def test_what_it_does_is_told_in_words(server, chromium):
    run = whole_on("ordinary", start_of("Leine and Glocker's toy", 28.65, 5.73, 0.3))
    moved, unit = run.trajectory, run.start.scales.time
    with arrival(server, chromium) as page:
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


def test_the_trace_is_on_the_ball_beside_its_map_and_the_statement_in_the_menu(server, chromium):
    with arrival(server, chromium) as page:
        page.get_by_role("tab", name="Trace").click()
        page.get_by_role("slider", name="Time").press("End")
        page.get_by_text("at a tilt of 84° it turns back").wait_for()
        for cap in listed("lab_view.view.answers.trace.caps"):
            page.locator(".answer svg text", has_text=cap).wait_for()
        drawn, whole = (page.locator(f".answer path.{kind}").get_attribute("d") for kind in ("past", "rest"))
        assert drawn == whole and len(whole) > 10_000
        check(page, "the trace")
        page.get_by_role("button", name="More", exact=True).click()
        page.get_by_role("button", name="Accessibility", exact=True).click()
        page.get_by_role("dialog", name="Accessibility").get_by_text("WCAG 2.2").wait_for()
        check(page, "the statement")
        page.keyboard.press("Escape")
        page.keyboard.press("F1")
        page.get_by_role("dialog", name="Keys").wait_for()
