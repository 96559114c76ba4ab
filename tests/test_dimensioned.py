"""The dimensions drawn in the section are those of the body: lengths measured in the drawing equal them."""

import math
import re

import pytest

from app.model.arrival import TOY, read_ends
from app.model.build.builder import Builder, Draft
from app.model.build.dimensions import FAMILIES, value_of
from app.model.build.inside import INSIDE, filled
from app.model.build.measures import measures
from app.model.explorer import Explorer
from app.model.lab.ends import SPINS, Ends
from app.tabs.build.section import Section
from app.tabs.build.verdict import STRIP, strip_of
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


def test_the_section_says_each_in_its_unit_and_what_is_held_in_the_colour_of_what_is_chosen():
    builder = Builder(Explorer().scene, lambda **inputs: None)
    section = Section(lambda *wish: None)
    section.show(builder.draft)
    said = [text.replace("\n", " ") for text in section.measured.said.data["text"]]
    shape, lengths = builder.draft.shape, {each.name: each for each in FAMILIES[type(builder.draft.shape)][1]}
    drawn = {measure.name for measure in measures(shape)}
    assert len(said) == len(drawn) >= 4
    for name in drawn:
        size = written(1e3 * value_of(shape, name), ".4g")
        assert any(text.endswith(f"{size} {lengths[name].unit}") for text in said), name
    assert not section.measured.held.data["text"]
    section._held = "l"
    section.show(builder.draft)
    assert len(section.measured.said.data["text"]) == len(said) - 1
    assert [text.split("\n")[0] for text in section.measured.held.data["text"]] == ["stem"]


def test_a_hole_and_a_disc_stand_in_the_section_and_each_is_measured_while_it_is_held():
    asked = []
    builder = Builder(Explorer().scene, lambda **inputs: asked.append(inputs["shape"]))
    builder.fill("both")
    [shape] = asked
    section = Section(lambda *wish: None)
    draft = Draft(shape=shape)
    for held in (None, *INSIDE):
        section.show(draft)
        section._held = held
        section.show(draft)
        texts = [text.split("\n")[0].split(" ")[0] for text in section.measured.said.data["text"]]
        assert sorted(text for text in texts if text in ("hole", "disc")) == sorted(
            {"disc": ["hole"], "depth": ["disc"]}.get(held, ["disc", "hole"]))  # fmt: skip
        assert len(section.measured.held.data["text"]) == (held is not None)
    low = 1e3 * (shape.height - shape.R)
    assert min(section.parts["core"].data["z"]) == pytest.approx(low)
    assert max(section.parts["core"].data["x"]) == pytest.approx(1e3 * shape.disc)
    at = list(zip(section.parts["body"].data["x"], section.parts["body"].data["z"], strict=True))
    for corner in ((shape.hole, shape.c), (shape.hole, shape.floor), (shape.r, shape.floor)):
        assert min(math.dist(one, (1e3 * corner[0], 1e3 * corner[1])) for one in at) < 1e-9


def test_the_strip_of_ends_has_each_of_them_and_the_spin_of_the_verdict():
    ends = Ends(SPINS, read_ends(), "stem")
    drawn = strip_of(ends)
    assert drawn.count('class="end ') == len(ends.segments) + len({each.code for each in ends.segments})
    assert "left: 57.30%" in drawn and TOY not in drawn  # 28.65 of 50 rev/s
    assert all(each.word in drawn for each in ends.segments)
    assert 'class="end ' not in strip_of(None)
    assert re.search(r"var\(--of\)", STRIP) and not re.search(
        r"var\(--(?!of)[\w-]+\)", STRIP + drawn
    )  # light sets none
