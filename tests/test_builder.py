"""The builder without a browser: a body changes in one event, and the explorer has the numbers of the body."""

import json
from dataclasses import replace

import numpy as np
import pytest
from doubles import builder_of
from hypothesis import given
from hypothesis import strategies as st

from app.model.build.builder import Rocking
from app.model.build.dimensions import changed, handles, pulled, value_of
from app.model.build.inside import INSIDE, KINDS, filled, inside
from tippe_core import (
    PRESETS,
    BareSphere,
    Top,
    TopError,
    TruncatedSphere,
    load_top,
    rocking_period,
    save_top,
)


@pytest.fixture
def builder(explorer):
    return builder_of(explorer)


def watch(thing, name):
    seen = []
    thing.param.watch(lambda event: seen.append(event.new), name)
    return seen


def test_the_first_visit_is_the_papers_rounded_top_in_the_body_of_appendix_A(explorer, builder):
    scene = explorer.scene
    assert scene.top == Top.paper()
    assert scene.shape == builder.draft.shape == TruncatedSphere.paper()
    assert builder.draft.name == "The paper's tippe top" and "appendix A" in builder.draft.source
    # Fig. 7: the lowest point, the sphere, the stem's radius and its end
    assert scene.profile[0] == pytest.approx([0, -1])
    assert scene.profile[-1] == pytest.approx([0, (0.82 + 1.92) / 1.6])
    assert np.any(np.all(np.isclose(scene.profile, [0.32 / 1.6, 0.82 / 1.6]), axis=1))


def test_the_papers_top_is_one_wherever_it_is_chosen_and_what_its_lengths_give_has_a_name_of_its_own(explorer, builder):
    builder.choose("Top S")
    builder.choose("The paper's tippe top")
    assert explorer.scene.top == Top.paper() and explorer.scene.shape == TruncatedSphere.paper()
    builder.choose("Appendix A's shape, a = 0.0698")
    assert explorer.scene.top == TruncatedSphere.paper().top and round(explorer.scene.top.a, 4) == 0.0698
    assert builder.draft.name == "Appendix A's shape, a = 0.0698"
    explorer.set(a=0.070, I1=0.399, I3=0.408)  # as undo does
    assert builder.draft.name == "The paper's tippe top"


def test_a_dimension_is_one_event_and_the_explorer_follows(explorer, builder):
    drafts, scenes = watch(builder, "draft"), watch(explorer, "scene")
    builder.set("l", 0.010)
    expected = replace(TruncatedSphere.paper(), l=0.010)
    assert [draft.shape for draft in drafts] == [expected]
    assert not drafts[0].messages and not drafts[0].name
    assert len(scenes) == 1
    assert scenes[0].top == expected.top and scenes[0].shape == expected
    assert scenes[0].profile[-1] == pytest.approx([0, (0.0082 + 0.010) / 0.016])


def test_the_motion_stays_the_same_throw_when_a_dimension_changes(explorer, builder):
    def rev_per_second():
        return explorer.scene.upright_spin * explorer.scene.scales.angular_velocity / (2 * np.pi)

    before = rev_per_second(), explorer.K_J / explorer.scene.plane.pole
    builder.set("R", 0.019)
    assert rev_per_second() == pytest.approx(before[0], rel=1e-12)
    assert explorer.K_J / explorer.scene.plane.pole == pytest.approx(before[1], rel=1e-12)
    assert explorer.scene.scales.R == 0.019 and explorer.scene.scales.M == 0.0115


@pytest.mark.parametrize("preset", PRESETS, ids=lambda preset: preset.name)
def test_presets(explorer, builder, preset):
    drafts, scenes, other = watch(builder, "draft"), watch(explorer, "scene"), builder.draft.name != preset.name
    builder.choose(preset.name)
    assert len(drafts) == other and (builder.draft.name, builder.draft.source) == (preset.name, preset.source)
    scene = explorer.scene
    assert len(scenes) == other and not scene.messages
    assert scene.top == preset.top and scene.shape == preset.shape and scene.scales == preset.shape.scales
    # The spin stays what the paper's top has at K_R = 10 (physics.md: 34.7 cycles/s), and the table carries the motion.
    assert scene.upright_spin * scene.scales.angular_velocity / (2 * np.pi) == pytest.approx(34.7, abs=0.05) or (
        preset.shape.com > 0
    )
    assert np.isfinite(scene.marks.slip) or preset.name == "Uniform ball"
    assert scene.normal.min() > 0 and scene.regime.max() == 0
    # the lowest point is the contact of the sphere that rolls, and nothing is below the table
    assert scene.profile[0] == pytest.approx([0, -1]) and scene.profile[:, 1].min() >= -1


def test_a_family_is_one_of_its_presets(builder):
    for family in ("ordinary top", "loaded sphere", "uniform ball", "truncated sphere with a stem"):
        builder.choose_family(family)
        assert builder.draft.family == family


@pytest.mark.parametrize(
    "name, value, says",
    [
        ("c", 0.020, "c = 20 mm is not possible: allowed is -16 < c <= 16 (mm, the cut goes through the sphere)."),
        ("r", 0.015, "0 <= r <= 13.739 (mm"),
        ("l", 0.0, "With both 0 there is none"),
        ("R", 0.005, "c = 8.2 mm"),
        ("M", -1e-3, "M = -1 g is not possible: allowed is 0 < M (g)."),
        ("R", float("nan"), "R = nan"),
    ],
)
def test_a_bad_dimension_is_said_at_its_field_and_changes_nothing(explorer, builder, name, value, says):
    shape, scene, drafts = builder.draft.shape, explorer.scene, watch(builder, "draft")
    builder.set(name, value)
    assert len(drafts) == 1 and list(builder.draft.messages) == [name]
    assert says.lower() in builder.draft.messages[name].lower()
    assert builder.draft.shape is shape and explorer.scene is scene
    builder.set("l", 0.0190)
    assert not builder.draft.messages


def test_moving_a_I1_I3_parts_them_from_the_body_and_says_so(explorer, builder):
    explorer.set(I1=0.42)
    assert explorer.scene.shape is None
    assert any("set independently of the body" in note for note in explorer.scene.notes)
    assert explorer.scene.profile[-1] == pytest.approx([0, 1])
    builder.attach()
    assert explorer.scene.shape == TruncatedSphere.paper()
    assert not any("set independently" in note for note in explorer.scene.notes)


def test_the_stem_touches_the_table_where_physics_md_has_it(explorer, builder):
    assert np.degrees(builder.draft.shape.touch_angle) == pytest.approx(119, abs=0.5)
    explorer.set(upper=False, K_J=-5.0, K_R=10.0, energy=0.9)
    assert explorer.scene.turning[1] > builder.draft.shape.touch_angle
    assert any("119°" in note for note in explorer.scene.notes)


# --- files ---


def test_save_and_load(builder, explorer):
    builder.choose("Wooden cone")
    builder.set("t", 0.021)
    text, shape = builder.save(), builder.draft.shape
    builder.choose("Uniform ball")
    drafts, scenes = watch(builder, "draft"), watch(explorer, "scene")
    builder.load(text.encode())
    assert builder.draft.shape == shape and explorer.scene.shape == shape
    assert len(drafts) == len(scenes) == 1
    assert load_top(builder.save()) == shape


@pytest.mark.parametrize(
    "change, says",
    [
        ({"schema": "other"}, "schema"),
        ({"version": 2}, "version"),
        ({"kind": "Cube"}, "kind"),
        ({"dimensions": {"R": 0.016}}, "missing"),
    ],
)
def test_a_file_that_cannot_be_is_said_and_changes_nothing(explorer, builder, change, says):
    shape, scene = builder.draft.shape, explorer.scene
    for text in (json.dumps(json.loads(save_top(shape)) | change), "no file", b"\xff\xfe", b"x" * 100_000):
        builder.load(text)
        assert list(builder.draft.messages) == ["file"]
        assert builder.draft.shape is shape and explorer.scene is scene
    builder.load(json.dumps(json.loads(save_top(shape)) | change))
    assert says in builder.draft.messages["file"]


def test_an_impossible_body_in_a_file_names_its_field(builder):
    document = json.loads(save_top(TruncatedSphere.paper()))
    document["dimensions"]["c"] = 0.5
    builder.load(json.dumps(document))
    assert builder.draft.messages["file"].startswith("c = 500 mm is not possible")


def test_stl(builder):
    assert len(builder.stl()) > 84
    builder.choose("Top S")
    assert builder.stl() is None and "inside is known" in builder.draft.messages["stl"]


# --- handles ---


@pytest.mark.parametrize(
    "shape",
    [*(preset.shape for preset in PRESETS), replace(TruncatedSphere.paper(), l=0.0, r=0.0),
     replace(TruncatedSphere.paper(), rounding=0.0015), *(filled(TruncatedSphere.paper(), kind) for kind in KINDS)],
    ids=lambda s: type(s).__name__,
)  # fmt: skip
def test_a_handle_pulled_to_where_it_is_changes_nothing(shape):
    for name, (x, z) in handles(shape).items():
        assert pulled(shape, name, x, z) == pytest.approx(value_of(shape, name), abs=5e-4 if name == "a" else 5.1e-6)


@pytest.mark.parametrize("preset", PRESETS, ids=lambda preset: preset.name)
def test_a_handle_goes_where_the_hand_is(preset):
    for name in handles(preset.shape):
        for factor in (0.95, 1.02):
            value = factor * np.array(value_of(preset.shape, name))
            try:
                other = changed(preset.shape, name, tuple(value) if value.ndim else float(value))
            except TopError:
                continue
            there = handles(other)[name]
            assert pulled(preset.shape, name, *there) == pytest.approx(
                value, abs=5e-4 if name == "a" else 5.1e-6), name  # fmt: skip


def test_the_rounding_is_pulled_from_a_sharp_edge_to_half_a_ball_and_no_further():
    shape = TruncatedSphere.paper()
    r, top = shape.r, shape.c + shape.l
    for b in (0.001, 0.002, r):
        there = handles(replace(shape, rounding=b))["rounding"]
        # on the edge, whose centre is b from the side and from the end
        assert np.hypot(there[0] + r - b, there[1] - top + b) == pytest.approx(b)
        assert pulled(shape, "rounding", *there) == pytest.approx(b)
    assert pulled(shape, "rounding", -2 * r, top + 0.01) == 0
    assert pulled(shape, "rounding", 0.0, top - 0.01) == r
    assert pulled(replace(shape, l=0.001), "rounding", 0.0, top - 0.02) == 0.001


def test_a_density_sets_the_mass_and_a_mass_the_densities(builder):
    builder.choose("Uniform ball")
    builder.set("R", 0.02)
    builder.set("density", 700.0)
    assert builder.draft.shape.mass == pytest.approx(700 * 4 / 3 * np.pi * 0.02**3, rel=1e-12)
    builder.choose("Loaded sphere")
    before = builder.draft.shape
    builder.set("M", 2 * before.mass)
    after = builder.draft.shape
    assert after.density == pytest.approx(2 * before.density) and after.b == before.b
    assert after.top.I3 == pytest.approx(before.top.I3, rel=1e-12)
    for name, value in (("density", -1.0), ("M", 0.0)):
        builder.set(name, value)
        assert builder.draft.shape == after and name in builder.draft.messages


# --- what is inside ---


def test_a_hole_and_a_disc_come_and_go_in_the_same_wood(builder, explorer):
    paper = TruncatedSphere.paper()
    seen = {}
    for kind in ("hole", "both", "disc", "solid"):
        builder.fill(kind)
        shape = seen[kind] = builder.draft.shape
        assert inside(shape) == kind and explorer.scene.shape == shape
        assert shape.density == pytest.approx(paper.density, rel=1e-12)
        assert {name for name in INSIDE if name in [each.name for each in builder.draft.dimensions]} == {*KINDS[kind]}
        assert (set(handles(shape)) & {*INSIDE}) == {*KINDS[kind]}
    hole, both, disc, solid = seen.values()
    assert (both.hole, both.depth) == (hole.hole, hole.depth) and (disc.disc, disc.height) == (both.disc, both.height)
    assert hole.mass < paper.mass < disc.mass and solid.mass == pytest.approx(paper.mass, rel=1e-12)
    # what is taken away above lowers G, and so does steel at the bottom
    assert paper.top.a < hole.top.a < both.top.a and paper.top.a < disc.top.a
    # a wider hole takes wood away, and leaves its density
    builder.fill("hole")
    builder.set("hole", 0.011)
    wider = builder.draft.shape
    assert hole.mass - wider.mass == pytest.approx(paper.density * np.pi * (0.011**2 - hole.hole**2) * hole.depth)
    builder.set("hole", 0.02)
    assert builder.draft.shape == wider and "hole = 20 mm" in builder.draft.messages["hole"]
    builder.choose("Uniform ball")
    builder.fill("hole")
    assert builder.draft.name == "Uniform ball" and inside(builder.draft.shape) == ""


@given(st.floats(0.002, 0.04), st.floats(-0.8, 1), st.floats(0.001, 0.9), st.floats(0, 4), st.sampled_from([*KINDS]),
       st.sampled_from([*KINDS]))  # fmt: skip
def test_there_is_room_for_a_hole_and_a_disc_in_any_toy(R, c, thin, l, first, then):
    r = thin * R * np.sqrt(1 - c * c) if l > 0.01 else 0.0
    if l > 0.01 and r < 1e-4:
        return
    shape = TruncatedSphere.from_density(700.0, R=R, c=c * R, l=l * R if r else 0.0, r=float(r))
    filled_twice = filled(filled(shape, first), then)
    assert inside(filled_twice) == then and filled_twice.density == pytest.approx(700.0)


# --- free profiles and pieces ---


def test_a_point_of_a_profile_goes_with_the_hand_and_stays_between_its_neighbours(builder, explorer):
    builder.choose("Free profile")
    shape = builder.draft.shape
    builder.set("point 2", pulled(shape, "point 2", 0.030, 0.015))
    assert builder.draft.shape.points[2] == (0.030, 0.015) and explorer.scene.shape == builder.draft.shape
    assert [30e-3 / 5e-3, 15e-3 / 5e-3] in explorer.scene.profile.tolist()
    # up past the next point, and across the axis
    assert pulled(shape, "point 2", -0.01, 0.5) == (0.0, shape.points[3][1])


def test_points_come_and_go_with_their_densities(builder):
    builder.choose("Free profile")
    before = builder.draft.shape
    builder.add_point(-0.020, 0.013)
    assert builder.draft.shape.points == (*before.points[:2], (0.020, 0.013), *before.points[2:])
    builder.remove_point(2)
    assert builder.draft.shape == before
    builder.part_densities()
    builder.set("density 5", 8000.0)
    # the last piece is a frustum of 4 and 3 mm, 21 mm high: its volume by the school's formula
    stem = np.pi / 3 * 0.021 * (0.004**2 + 0.004 * 0.003 + 0.003**2)
    assert builder.draft.shape.mass - before.mass == pytest.approx(7300 * stem)
    assert {dimension.name for dimension in builder.draft.dimensions} == {"R", "M", *(f"density {i}" for i in range(6))}
    builder.add_point()
    assert len(builder.draft.shape.density) == len(builder.draft.shape.points) == 7
    for _ in range(8):
        builder.remove_point(len(builder.draft.shape.points) - 1)
    assert "points" in builder.draft.messages  # a profile needs a point, and the last good body stays
    assert builder.draft.shape.mass > 0


def test_pieces_put_on_and_taken_away(builder, explorer):
    paper = TruncatedSphere.paper()
    builder.compose("ball", -paper.density, 0.005, -0.003, 0.007)
    assert builder.draft.shape == next(preset.shape for preset in PRESETS if preset.name == "Hollow tippe top")
    assert explorer.scene.scales.M == pytest.approx(paper.mass - paper.density * 4 / 3 * np.pi * 0.005**3)
    builder.compose("ball", -paper.density, 0.005, 0.050, 0.060)
    assert "piece" in builder.draft.messages and len(builder.draft.shape.solid.slices) == 3
    builder.take_off()
    assert builder.draft.shape.top.a == pytest.approx(paper.top.a, rel=1e-12)
    builder.compose("cylinder", 700.0, 0.002, 0.0274, 0.040)
    assert builder.draft.shape.profile(50)[-1] == pytest.approx([0, 0.040])


# --- measured ---


def test_the_period_of_a_known_top_gives_its_a_back(builder, explorer):
    shape = TruncatedSphere.paper()
    T = rocking_period(shape.top) * shape.scales.time
    found = Rocking(T=T, dT=0.01 * T, D=2 * shape.R, dD=1e-4, M=0.012).a(shape)
    assert found.value == pytest.approx(shape.top.a, rel=1e-9)
    # one per cent of T, by two periods instead of a derivative
    other = Rocking(T=1.01 * T, dT=0, D=2 * shape.R, dD=0, M=0.012).a(shape)
    assert found.shares["T"] == pytest.approx(abs(other.value - found.value), rel=0.03)
    builder.measured(M=0.012, R=0.016, a=found.value)
    assert isinstance(builder.draft.shape, BareSphere)
    assert explorer.scene.top.a == pytest.approx(shape.top.a, rel=1e-9) and explorer.scene.scales.M == 0.012
