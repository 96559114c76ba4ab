"""The dimensions drawn in the section are those of the body: lengths measured in the drawing equal them."""

import json
import math

import pytest

from app.model.arrival import TOY, read_ends
from app.model.build.builder import Builder, Draft
from app.model.build.dimensions import FAMILIES, value_of
from app.model.build.inside import INSIDE, filled
from app.model.build.measures import measures
from app.model.explorer import Explorer
from app.model.families.known_tops import known_of
from app.model.lab.ends import SPINS, Ends
from app.model.start import arrives
from app.tabs.build.section import Section
from app.tabs.build.verdict import strip_of
from app.text import written
from tippe_core import PRESETS

BODIES = {preset.name: preset.shape for preset in PRESETS}
FILLED = filled(PRESETS[0].shape, "both")


@pytest.mark.parametrize("name", [*BODIES, "filled"])
def test_what_is_measured_is_as_long_as_the_dimension_says(name):
    shape = BODIES.get(name, FILLED)
    for measure in measures(shape):
        (x, z), (x1, z1) = measure.start, measure.end
        said = value_of(shape, measure.name) * (shape.R if measure.name == "a" else 1.0)
        drawn = abs(z1 - z) if measure.is_height else math.hypot(x1 - x, z1 - z)
        assert drawn == pytest.approx(abs(said), abs=1e-9), measure


def drawn(draft):
    section = Section(lambda *wish: None)
    section.show(draft)
    return json.loads(section.view.state)


def test_the_section_says_each_in_its_unit():
    draft = Builder(Explorer().scene, lambda **inputs: None).draft
    shape, lengths = draft.shape, {each.name: each for each in FAMILIES[type(draft.shape)][1]}
    said = {each["name"]: each["says"][1] for each in drawn(draft)["measures"]}
    assert {*said} == {measure.name for measure in measures(shape)} and len(said) >= 4
    for name, text in said.items():
        assert text == f"{written(1e3 * value_of(shape, name), '.4g')} {lengths[name].unit}"


@pytest.mark.parametrize("name", [*BODIES, "filled"])
def test_each_ring_has_the_value_that_pulling_it_to_where_it_is_gives(name):
    shape = BODIES.get(name, FILLED)
    asked = []
    section = Section(lambda *wish: asked.append(wish))
    section.show(Draft(shape=shape))
    for ring, (x, z, *_) in json.loads(section.view.state)["handles"].items():
        section.view.hand = [ring, x, z]
        assert asked.pop() == (
            ring,
            pytest.approx(value_of(shape, ring), abs=5e-4 if ring == "a" else 2e-5),
        )  # as exact as a hand is
        assert section.last_point == (int(ring[6:]) if ring.startswith("point ") else section.last_point)
    section.view.hand = ["nobody", 0, 0]
    assert not asked


def test_a_hole_and_a_disc_stand_in_the_section_and_three_are_measured_only_while_held():
    asked = []
    builder = Builder(Explorer().scene, lambda **inputs: asked.append(inputs["shape"]))
    builder.fill("both")
    [shape] = asked
    found = drawn(Draft(shape=shape))
    shown = {each["name"]: each["shown"] for each in found["measures"] if each["name"] in INSIDE}
    assert shown == {"hole": False, "depth": True, "disc": True, "thickness": False, "height": False}
    [core], [body] = found["parts"]["core"], found["parts"]["body"]
    assert min(z for _, z in core) == pytest.approx(1e3 * (shape.height - shape.R), abs=1e-3)
    assert max(x for x, _ in core) == pytest.approx(1e3 * shape.disc, abs=1e-3)
    for corner in ((shape.hole, shape.c), (shape.hole, shape.floor), (shape.r, shape.floor)):
        assert min(math.dist(one, (1e3 * corner[0], 1e3 * corner[1])) for one in body) < 1e-3


def test_the_strip_of_ends_has_each_of_them_and_the_spin_of_the_verdict():
    ends = Ends(SPINS, read_ends(), "stem")
    drawn = strip_of(ends)
    assert drawn.count('class="end ') == len(ends.segments) + len({each.code for each in ends.segments})
    assert "left: 57.30%" in drawn and TOY not in drawn  # 28.65 of 50 rev/s
    assert all(each.word in drawn for each in ends.segments)
    least = min(spin for spin, code in zip(SPINS, ends.codes, strict=True) if code == "stands")
    assert f"stands on its stem, from {least:.1f}<" in drawn  # the same spin as on the map of all tops
    assert least == known_of(Explorer(**arrives()).scene).stands_from
    assert 'class="end ' not in strip_of(None)
