"""The builder in Chromium: handles, presets, files and STL."""

import json
import re
import struct
from urllib.parse import parse_qs

import numpy as np
import pytest
from playwright.sync_api import expect
from visiting import Visit, wait

from app.model.build.inside import inside
from app.state.codecs import Body
from tippe_core import PRESETS, TruncatedSphere, load_top, save_top

pytestmark = pytest.mark.served

# Where a point of a figure, in its own coordinates, is on the screen.
PLACE = """
([figure, x, y]) => {
  const queue = [...Bokeh.index.roots]
  while (queue.length) {
    const view = queue.pop()
    if (view.model.name == figure && view.frame) {
      const {left, top} = view.canvas_view.el.getBoundingClientRect()
      return [left + view.frame.x_scale.compute(x), top + view.frame.y_scale.compute(y)]
    }
    queue.push(...view.child_views ?? [])
  }
}
"""
# Of the body that the section shows, in mm: its greatest "x" and "z".
SECTION = """(column) => {
  const figure = [...Bokeh.documents[0]._all_models.values()].find((m) => m.name == "section" && m.renderers)
  return Math.max(...figure.renderers[0].data_source.data[column])
}"""
# The greatest height above O of the body that is turned in 3-D, in R.
DRAWN = """() => {
  const top = [...Bokeh.documents[0]._all_models.values()].find((m) => m.attributes.data?.attributes?.profile)
  const profile = top.data.profile
  const rows = new Float32Array(profile.buffer ?? profile)
  return Math.max(...rows.filter((_, i) => i % 2))
}"""


# The visible words.
SEEN = """() => {
  const all = (root) => [...root.querySelectorAll("*")].flatMap((e) => [e, ...e.shadowRoot ? all(e.shadowRoot) : []])
  const seen = (e) => !e.matches("script, style") && e.checkVisibility({ visibilityProperty: true })
  const texts = all(document).filter(seen).flatMap((e) => [...e.childNodes].filter(({ nodeType }) => nodeType == 3))
  return texts.map(({ data }) => data).join(" ")
}"""


@pytest.fixture
def bench(server, chromium):
    with chromium.new_context(viewport={"width": 1400, "height": 1500}, reduced_motion="reduce") as context:
        visit = Visit(context.new_page(), f"{server}?v=2&tab=build-a-top", whole=False)
        visit.page.get_by_role("button", name="Save this top").wait_for()
        visit.page.wait_for_function("Bokeh.documents[0].is_idle")
        yield visit


def choose(visit, preset):
    """Chooses a preset, and waits until its numbers are shown."""
    visit.page.get_by_role("combobox", name="Presets").click()
    visit.page.get_by_role("listbox").get_by_role("option", name=preset.name, exact=True).click()
    shape = preset.shape
    for text in (f"= {shape.top.a:.4f}".replace("-", "−"), f"= {shape.top.I1:.4f}", f"{1e3 * shape.mass:.4g} g"):
        visit.page.get_by_text(text).locator("visible=true").first.wait_for()
    visit.page.get_by_text(preset.source[:50]).wait_for()
    visit.page.wait_for_function(f"z => Math.abs(({SECTION})('z') - z) < 0.1", arg=1e3 * shape.profile(96)[:, 1].max())


def drag(visit, start, end, rest=0):
    """rest: ms between pressing and moving."""

    def places():
        return [visit.page.evaluate(PLACE, ["section", *place]) for place in (start, end)]

    wait(visit.page, lambda: places() == places())  # another body has another scale, which comes a moment later
    here, there = places()
    visit.page.mouse.move(*here)
    visit.page.mouse.down()
    visit.page.wait_for_timeout(rest)
    for share in (0.3, 0.6, 1.0):
        visit.page.mouse.move(*(np.array(here) * (1 - share) + np.array(there) * share), steps=3)
    visit.page.mouse.up()


def download(visit, label):
    with visit.page.expect_download() as waiting:
        visit.page.get_by_role("button", name=label).click()
    return waiting.value.path().read_bytes()


def load(visit, text):
    visit.page.locator("input[type=file]").set_input_files(
        {"name": "top.json", "mimeType": "application/json", "buffer": text.encode()})  # fmt: skip


def a_preset_shows_its_numbers_and_its_source(bench):
    for preset in (PRESETS[3], PRESETS[6], PRESETS[-1]):
        choose(bench, preset)
        assert bench.page.locator("[role=alert]").locator("visible=true").count() == 0


def the_end_of_the_stem_is_rounded_by_hand_and_the_material_chosen(bench):
    choose(bench, PRESETS[1])
    choose(bench, PRESETS[0])
    drag(bench, (-3.2, 27.4), (-2.4, 26.6))
    bench.page.get_by_role("combobox", name="Material").click()
    bench.page.get_by_role("listbox").get_by_role("option", name="beech, 710 kg/m³", exact=True).click()
    bench.page.get_by_text("density 710 kg/m³").locator("visible=true").wait_for()
    top = load_top(download(bench, "Save this top"))
    assert top.rounding == pytest.approx(0.8e-3 / (1 - np.sqrt(0.5)), abs=5e-4)
    assert top.density == pytest.approx(710)


def a_dragged_handle_changes_number_section_and_the_top_in_3d(bench):
    choose(bench, PRESETS[1])
    choose(bench, PRESETS[0])
    drag(bench, (0, 27.4), (0, 20.2))  # the end of the stem, from l = 19.2 to 12 mm
    bench.page.wait_for_function(f"() => Math.abs(({SECTION})('z') - 20.2) < 0.5")
    top = load_top(download(bench, "Save this top"))
    assert top.l == pytest.approx(0.012, abs=5e-4)
    assert bench.page.evaluate(SECTION, "z") == pytest.approx(1e3 * (top.c + top.l), abs=1e-9)
    bench.page.get_by_text(f"= {top.top.a:.4f}").locator("visible=true").first.wait_for()
    # the field beside the slider, and the body in 3-D
    fields = [field.input_value() for field in bench.page.locator("input[type=text]").all()]
    assert f"{1e3 * top.l:.6g}" in fields
    bench.page.wait_for_function(f"z => Math.abs(({DRAWN})() - z) < 1e-6", arg=(top.c + top.l) / top.R)


def a_changed_top_is_no_preset_and_the_preset_can_be_chosen_again(bench):
    choose(bench, PRESETS[1])
    choose(bench, PRESETS[0])
    drag(bench, (0, 27.4), (0, 20.2), rest=500)
    bench.page.get_by_role("combobox", name="Presets").filter(has_text="none of these").wait_for()
    choose(bench, PRESETS[0])
    assert download(bench, "Save this top").decode() == save_top(TruncatedSphere.paper())


def a_top_is_saved_and_loaded_back_and_a_bad_file_changes_nothing(bench):
    choose(bench, PRESETS[4])
    text = download(bench, "Save this top").decode()
    assert load_top(text) == PRESETS[4].shape
    choose(bench, PRESETS[0])
    document = json.loads(text)
    document["dimensions"]["t"] = -0.004
    load(bench, json.dumps(document))
    bench.page.get_by_text("t = −4 mm is not possible").wait_for()
    load(bench, "no top at all")
    bench.page.get_by_role("alert").filter(has_text="JSON").wait_for()
    assert download(bench, "Save this top").decode() == save_top(TruncatedSphere.paper())
    load(bench, text)
    number = f"= {PRESETS[4].shape.top.a:.4f}".replace("-", "−")
    bench.page.get_by_text(number).locator("visible=true").first.wait_for()
    assert download(bench, "Save this top").decode() == text


def a_file_far_too_large_stays_where_it_is(bench, tmp_path, page_errors):
    page_errors.allow("exceeds maximum file size")  # of the library
    choose(bench, PRESETS[1])
    choose(bench, PRESETS[0])
    path = tmp_path / "top.json"
    with path.open("wb") as file:
        file.truncate(100_000_000)
    sent = len(bench.sent)
    bench.page.locator("input[type=file]").set_input_files(path)
    bench.page.get_by_text("allowed is at most 65536 bytes").wait_for()
    assert sum(map(len, bench.sent[sent:])) < 100_000
    assert download(bench, "Save this top").decode() == save_top(TruncatedSphere.paper())


def the_stl_that_is_saved_is_the_body_in_mm(bench):
    choose(bench, PRESETS[1])
    choose(bench, PRESETS[0])
    data = download(bench, "Save STL")
    (count,) = struct.unpack("<I", data[80:84])
    rows = np.frombuffer(data[84:], dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    assert len(rows) == count
    A, B, C = np.moveaxis(rows["corners"].astype(float), 1, 0)
    # the divergence theorem; 128 flat faces to a turn are smaller than the round body by 4e-4
    volume = np.einsum("ij,ij->", A, np.cross(B, C)) / 6 * 1e-9
    assert volume == pytest.approx(TruncatedSphere.paper().volume, rel=1e-3)
    assert rows["corners"][..., 2].min() == -16 and rows["corners"][..., 2].max() == pytest.approx(27.4)


def a_point_of_a_free_profile_is_dragged_and_another_added(bench):
    preset = next(preset for preset in PRESETS if preset.name == "Free profile")
    choose(bench, preset)
    drag(bench, (22, 16), (28, 15))
    bench.page.wait_for_function(f"() => Math.abs(({SECTION})('x') - 28) < 1")
    bench.page.get_by_role("button", name="Add a point").click()
    bench.page.wait_for_function("Bokeh.documents[0].is_idle")
    points = load_top(download(bench, "Save this top")).points
    assert len(points) == len(preset.shape.points) + 1
    assert max(points)[0] == pytest.approx(0.028, abs=1e-3)


def a_hole_and_a_disc_are_chosen_and_dragged_and_are_in_the_link(bench):
    choose(bench, PRESETS[1])
    choose(bench, PRESETS[0])
    bench.page.get_by_role("button", name="both", exact=True).click()
    bench.page.get_by_text("The disc is of steel.").locator("visible=true").wait_for()
    bench.page.wait_for_function("Bokeh.documents[0].is_idle")
    first = load_top(download(bench, "Save this top"))
    assert inside(first) == "both"
    middle = 1e3 * (first.c - first.depth / 2)
    drag(bench, (-1e3 * first.hole, middle), (-12, middle))
    bench.page.wait_for_function(
        "Math.abs(new URLSearchParams(location.search).get('body').split('_')[7] - 0.012) < 3e-4"
    )
    top = load_top(download(bench, "Save this top"))
    assert top.hole == pytest.approx(0.012, abs=3e-4) and (top.depth, top.disc) == (first.depth, first.disc)
    assert top.density == pytest.approx(TruncatedSphere.paper().density, rel=1e-9)
    bench.page.wait_for_function(f"z => Math.abs(({DRAWN})() - z) < 1e-6", arg=(top.c + top.l) / top.R)
    address = bench.page.evaluate("location.search")
    assert Body.value(parse_qs(address[1:])["body"][0]) == top
    bench.page.get_by_role("button", name="solid", exact=True).click()
    expect(bench.page.get_by_text("The disc is of steel.").locator("visible=true")).to_have_count(0)


def test_who_explores_sees_the_top_beside_its_section_without_greek(server, chromium):
    page = chromium.new_page(viewport={"width": 1400, "height": 900})
    page.goto(server + "?v=2&tab=build-a-top&level=explore")
    section, top = (
        page.get_by_role("heading", name=name)
        for name in ("The body, cut along its axis", "The top on a rough table, where it only rolls")
    )
    top.wait_for()
    page.get_by_role("button", name="Save this top").wait_for()
    page.wait_for_function("Bokeh.documents[0].is_idle")
    assert section.bounding_box()["y"] == pytest.approx(top.bounding_box()["y"], abs=1)
    before = top.bounding_box()["y"]
    page.mouse.move(300, 700)
    page.mouse.wheel(0, 30)
    page.wait_for_function("([top, y]) => top.getBoundingClientRect().top < y", arg=[section.element_handle(), before])
    assert top.bounding_box()["y"] == pytest.approx(before, abs=1)  # it has not moved
    assert not set(re.findall("[Α-Ωα-ω]", page.evaluate(SEEN))) - {"θ"}
    page.get_by_role("radio", name="Research").click()
    expect(page.get_by_text("2π").first).to_be_visible()
    page.close()


def test_a_body_is_built_by_hand_saved_and_loaded(bench, tmp_path, page_errors):
    """One visit: each step chooses its body."""
    a_preset_shows_its_numbers_and_its_source(bench)
    a_dragged_handle_changes_number_section_and_the_top_in_3d(bench)
    a_changed_top_is_no_preset_and_the_preset_can_be_chosen_again(bench)
    the_end_of_the_stem_is_rounded_by_hand_and_the_material_chosen(bench)
    a_hole_and_a_disc_are_chosen_and_dragged_and_are_in_the_link(bench)
    a_top_is_saved_and_loaded_back_and_a_bad_file_changes_nothing(bench)
    a_file_far_too_large_stays_where_it_is(bench, tmp_path, page_errors)
    the_stl_that_is_saved_is_the_body_in_mm(bench)
    a_point_of_a_free_profile_is_dragged_and_another_added(bench)
