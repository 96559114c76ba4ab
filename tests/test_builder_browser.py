"""The builder in Chromium: presets, handles, and files in and out."""

import json
from urllib.parse import parse_qs

import numpy as np
import pytest
from axe import DARK, check
from playwright.sync_api import expect
from visiting import IN_SIGHT, Visit, texts, wait

from app.model.build.inside import inside
from app.state.codecs import Body
from tippe_core import PRESETS, TruncatedSphere, load_top, save_top

pytestmark = pytest.mark.served

MODELS = "Bokeh.documents.flatMap((doc) => [...doc.all_models])"
SHOWN = f"JSON.parse({MODELS}.find((m) => m.attributes.data?.attributes?.tapped).data.state)"
# The greatest height of the body that the section shows, in mm.
SECTION = f"() => Math.max(...({SHOWN}.parts?.body[0] ?? []).map(([, z]) => z))"
# The greatest height above O of the body that is turned in 3-D, in R.
DRAWN = f"""() => {{
  const profile = {MODELS}.find((m) => m.attributes.data?.attributes?.profile)?.data.profile ?? []  // it comes later
  return Math.max(...new Float32Array(profile.buffer ?? profile).filter((_, i) => i % 2))
}}"""
PAPERS, TOY = PRESETS[0], PRESETS[4]


def is_drawn(page, shape):
    """Waits until section and 3-D view have a body of this height, in m."""
    page.wait_for_function(f"z => Math.abs(({SECTION})() - z) < 0.1", arg=1e3 * shape.profile(96)[:, 1].max())
    page.wait_for_function(f"z => Math.abs(({DRAWN})() - z) < 1e-3", arg=shape.profile(96)[:, 1].max() / shape.R)


def number(page, text):
    page.get_by_text(text.replace("-", "−")).locator("visible=true").first.wait_for()


def choose(page, preset):
    """Chooses a preset in the head, and waits until its numbers and its source are shown."""
    page.locator(".toy").select_option(preset.name)
    for text in (f"= {preset.shape.top.a:.4f}", f"= {preset.shape.top.I1:.4f}", f"{1e3 * preset.shape.mass:.4g} g"):
        number(page, text)
    page.get_by_text(preset.source[:50]).wait_for()
    is_drawn(page, preset.shape)


def drag(page, name, across, up):
    """Pulls a ring of the section so many mm."""
    ring, places = page.locator(f"[data-name='{name}'] .ring"), []
    page.locator("[data-figure=section]").evaluate(IN_SIGHT)

    def rests():
        places.append(ring.bounding_box())
        return places[-2:-1] == places[-1:]

    wait(page, rests)  # another body has another scale, which comes a moment later
    box, ball = places[-1], page.locator("[data-figure=section] circle.dashed").first
    scale = float(ball.get_attribute("r")) / page.evaluate(f"{SHOWN}.R")
    here = np.array([box["x"] + box["width"] / 2, box["y"] + box["height"] / 2])
    page.mouse.move(*here)
    page.mouse.down()
    for share in (0.3, 0.6, 1.0):
        page.mouse.move(*(here + share * scale * np.array([across, -up])), steps=3)
    page.mouse.up()


def saved(page):
    with page.expect_download() as waiting:
        page.get_by_role("button", name="Save this top").click()
    return waiting.value.path().read_bytes()


def load(page, text):
    page.locator("input[type=file]").set_input_files(
        {"name": "top.json", "mimeType": "application/json", "buffer": text.encode()})  # fmt: skip


def section_and_top_stand_side_by_side(page):
    """The drawing on the left, the top and what becomes of it on the right, both from the top of the room on."""
    section, spin = page.locator("[data-figure=section]").first, page.get_by_role("button", name="Spin it")
    left, right = section.bounding_box(), spin.bounding_box()
    assert left["x"] < 100 < 500 < left["x"] + left["width"] <= right["x"]
    assert left["y"] < right["y"] < left["y"] + left["height"]


def a_dragged_handle_changes_number_section_and_the_top_in_3d(page):
    """The end of the stem, from l = 19.2 to 12 mm."""
    drag(page, "l", 0, -7.2)
    page.wait_for_function(f"() => Math.abs(({SECTION})() - 20.2) < 0.5")
    expect(page.locator(".toy option:checked")).to_have_text("Your own top")
    top = load_top(saved(page))
    assert top.l == pytest.approx(0.012, abs=5e-4)
    assert page.evaluate(SECTION) == pytest.approx(1e3 * (top.c + top.l), abs=1e-3)
    number(page, f"= {top.top.a:.4f}")
    assert f"{1e3 * top.l:.6g}" in texts(page)
    page.wait_for_function(f"z => Math.abs(({DRAWN})() - z) < 1e-6", arg=(top.c + top.l) / top.R)


def a_ring_goes_on_with_the_arrow_keys_and_says_so(page):
    """As many tenths of a millimetre as keys, and the focus stays."""
    ring = page.locator("[data-name=l]")
    before = load_top(saved(page)).l
    ring.focus()
    for _ in range(5):
        page.keyboard.press("ArrowUp")
    expect(ring).to_have_attribute("aria-valuetext", f"{1e3 * before + 0.5:.6g} mm")
    expect(ring).to_be_focused()
    assert load_top(saved(page)).l == pytest.approx(before + 5e-4, abs=1e-9)


def a_bad_file_changes_nothing_and_one_that_was_saved_is_loaded(page, text):
    before, document = saved(page), json.loads(text)
    document["dimensions"]["t"] = -0.004
    load(page, json.dumps(document))
    page.get_by_text("t = −4 mm is not possible").wait_for()
    load(page, "no top at all")
    page.get_by_role("alert").filter(has_text="JSON").wait_for()
    assert saved(page) == before
    load(page, text)
    number(page, f"= {TOY.shape.top.a:.4f}")
    assert saved(page).decode() == text


def a_file_far_too_large_stays_where_it_is(bench, path):
    with path.open("wb") as file:
        file.truncate(100_000_000)
    before, sent = saved(bench.page), len(bench.sent)
    bench.page.locator("input[type=file]").set_input_files(path)
    bench.page.get_by_text("allowed is at most 65536 bytes").wait_for()
    assert sum(map(len, bench.sent[sent:])) < 100_000
    assert saved(bench.page) == before


def a_hole_and_a_disc_are_chosen_and_dragged_and_are_in_the_link(page):
    page.get_by_role("radio", name="both", exact=True).click()
    page.get_by_text("The disc is of steel.").locator("visible=true").wait_for()
    page.wait_for_function("Bokeh.documents[0].is_idle")
    first = load_top(saved(page))
    assert inside(first) == "both"
    drag(page, "hole", 1e3 * first.hole - 12, 0)
    page.wait_for_function("Math.abs(new URLSearchParams(location.search).get('body').split('_')[7] - 0.012) < 3e-4")
    top = load_top(saved(page))
    assert top.hole == pytest.approx(0.012, abs=3e-4) and (top.depth, top.disc) == (first.depth, first.disc)
    assert top.density == pytest.approx(TruncatedSphere.paper().density, rel=1e-9)
    assert Body.value(parse_qs(page.evaluate("location.search")[1:])["body"][0]) == top
    page.get_by_role("radio", name="solid", exact=True).click()
    expect(page.get_by_text("The disc is of steel.").locator("visible=true")).to_have_count(0)


def test_a_top_is_built_saved_and_loaded(server, chromium, tmp_path):
    with chromium.new_context(draws=True, viewport={"width": 1400, "height": 1500}, reduced_motion="reduce") as context:
        bench = Visit(context.new_page(), f"{server}?v=2&tab=build-a-top", whole=False, listens=True)
        page = bench.page
        page.get_by_role("button", name="Save this top").wait_for()
        page.wait_for_function("Bokeh.documents[0].is_idle")
        choose(page, TOY)
        text = saved(page).decode()
        assert load_top(text) == TOY.shape
        section_and_top_stand_side_by_side(page)
        choose(page, PAPERS)
        a_dragged_handle_changes_number_section_and_the_top_in_3d(page)
        a_ring_goes_on_with_the_arrow_keys_and_says_so(page)
        choose(page, PAPERS)
        assert saved(page).decode() == save_top(TruncatedSphere.paper())
        a_hole_and_a_disc_are_chosen_and_dragged_and_are_in_the_link(page)
        a_file_far_too_large_stays_where_it_is(bench, tmp_path / "top.json")
        a_bad_file_changes_nothing_and_one_that_was_saved_is_loaded(page, text)
        check(page, "build", DARK)
