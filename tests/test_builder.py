"""The builder without a browser: a body changes in one event, and the explorer's numbers are the body's."""

import json
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from house import builder_of
from limits import limit

from app.model.build.builder import Rocking
from app.model.build.dimensions import FAMILIES, changed, handles, pulled, sentence, value_of
from app.model.build.verdict import verdict
from app.model.explorer import Explorer
from app.model.families.family import region, share_map
from app.model.lab.run import TooLong
from app.model.runs import Runs
from app.tabs.build.build import KNOBS, Build
from app.tabs.build.verdict import VerdictWords
from app.tabs.families.compare import Compare
from app.widgets.typeset import typeset
from tippe_core import (
    PRESETS,
    Ball,
    BareSphere,
    Lathe,
    Top,
    TopError,
    TruncatedSphere,
    allowed_shares,
    figures,
    load_top,
    pole_constants,
    rocking_period,
    save_top,
)
from tippe_core.paper.share import GRID_M, GRID_V, PART, widths


@pytest.fixture
def explorer():
    return Explorer()


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
    explorer.param.update(a=0.070, I1=0.399, I3=0.408)  # as an undo does
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
    assert len(scenes) == 1 and not scene.messages
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
    explorer.I1 = 0.42
    assert explorer.scene.shape is None
    assert any("set apart from the body" in note for note in explorer.scene.notes)
    assert explorer.scene.profile[-1] == pytest.approx([0, 1])
    builder.attach()
    assert explorer.scene.shape == TruncatedSphere.paper()
    assert not any("set apart" in note for note in explorer.scene.notes)


def test_the_stem_touches_the_table_where_physics_md_has_it(explorer, builder):
    assert np.degrees(builder.draft.shape.touch_angle) == pytest.approx(119, abs=0.5)
    explorer.param.update(upper=False, K_J=-5.0, K_R=10.0, energy=0.9)
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
    [*(preset.shape for preset in PRESETS), replace(TruncatedSphere.paper(), l=0.0, r=0.0)],
    ids=lambda s: type(s).__name__,
)
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


def test_every_dimension_is_a_field_within_its_slider():
    for preset in PRESETS:
        for dimension in FAMILIES[type(preset.shape)][1]:
            shown = value_of(preset.shape, dimension.name) * dimension.factor
            assert dimension.low <= shown <= dimension.high, (preset.name, dimension.name)


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


@pytest.mark.parametrize(
    "make, says",
    [
        (lambda: Top(1.5, 0.4, 0.4), "a = 1.5 is not possible: allowed is a < 1 (in units of R)."),
        (lambda: Ball(R=-1.0, M=0.01), "R = -1000 mm is not possible"),
        (lambda: replace(PRESETS[3].shape, l=5000.0), "0 <= l <= 250000 (mm)"),
    ],
)
def test_sentences_are_in_the_units_of_the_sliders(make, says):
    with pytest.raises(TopError) as error:
        make()
    assert says in sentence(error.value)


def test_a_diameter_that_cannot_be_is_called_a_diameter():
    with pytest.raises(TopError) as error:
        Rocking(T=1.08, dT=0.01, D=0.0, dD=1e-4, M=0.0115).a(TruncatedSphere.paper())
    assert sentence(error.value).startswith("the diameter = 0 mm is not possible")


def test_the_bench_says_what_is_printed_and_goes_back_to_a_preset(builder, explorer):
    bench = Build(builder)
    bench.families.value = "loaded sphere"
    assert bench.presets.value == "Loaded sphere" and "the core is not in it" in bench.derived.object
    builder.set("core_density", 0.0)  # a cavity is
    assert "STL" not in bench.derived.object and bench.families.value != "loaded sphere"
    bench.families.value = "loaded sphere"
    assert builder.draft.name == "Loaded sphere"


# --- families ---


def test_the_allowed_share_is_the_area_of_the_papers_table():
    """physics.md's tielines of the paper's top at K_R = 10: outer - inner over K_J from 0 to P, by trapezoids."""
    K_J = np.array([0, 1, 2, 3, 4, 5, 6, 7, 8, 8.3651])
    lift = np.array([1.6943, 1.5787, 1.4646, 1.3508, 1.2365, 1.1207, 1.0040, 0.8907, 0.7991, 0.7789]) - [
        1.3085,
        1.1960,
        1.0797,
        0.9578,
        0.8274,
        0.6844,
        0.5220,
        0.3294,
        0.0945,
        0.0,
    ]
    slip = np.array([1.6637, 1.5519, 1.4393, 1.3242, 1.2043, 1.0764, 0.9350, 0.7754, 0.5837, 0.4998]) - [
        1.3383,
        1.2210,
        1.1023,
        0.9804,
        0.8529,
        0.7165,
        0.5654,
        0.3839,
        0.1328,
        0.0,
    ]
    share = np.trapezoid(slip, K_J) / np.trapezoid(lift, K_J)
    # the rule's own error with ten points, both areas curved alike
    assert allowed_shares(0.07, 0.399, 0.408, 10.0, 0.5) == pytest.approx(share, abs=3e-3)


def exact_share(a, I1, I3, K_R, mu_s):
    """From tielines at the same 64 K_J, each refined to full accuracy."""
    top = Top(a, I1, I3)
    lift, slip = figures(top, PART * pole_constants(top, K_R)[0], K_R, mu_s)
    return np.nansum(slip.theta_outer - slip.theta_inner) / np.nansum(lift.theta_outer - lift.theta_inner)


@pytest.mark.parametrize(
    "a, ratio, I1, K_R, mu_s",
    [
        (0.07, 1.02, 0.399, 10.0, 0.5),
        (0.02, 0.6, 0.399, 10.0, 0.5),
        (0.3, 1.6, 0.399, 10.0, 0.1),
        (0.5, 0.8, 0.399, 4.0, 0.3),
        (-10.1, 1.9, 48.2, 53.3, 0.5),
        (-5.0, 1.0, 48.2, 53.3, 0.5),
        (-2.9, 1.04, 3.66, 23.6, 0.5),
        (-1.7, 0.6, 0.4, 10.0, 0.5),
        (-8.0, 1.2, 2.0, 30.0, 0.5),
    ],
)
def test_the_bulk_share_is_that_of_the_exact_tielines(a, ratio, I1, K_R, mu_s):
    """Tippe and ordinary tops, wells of a radian and of 1e-5, one and two of them. 5e-4 is a thirtieth of what the eye
    could tell on the map's scale of colours."""
    share = allowed_shares(a, I1, ratio * I1, K_R, mu_s)
    assert share == pytest.approx(exact_share(a, I1, ratio * I1, K_R, mu_s), abs=5e-4)


@pytest.mark.parametrize(
    "a, I1, I3, K_R, mu_s, row",
    [(0.070, 0.399, 0.408, 10.0, 0.5, 40), (0.449, 0.399, 0.3024, 10.0, 0.5, 14), (-2.9, 3.66, 3.8, 23.6, 0.5, 62)],
)
def test_a_width_is_that_of_the_slow_search(a, I1, I3, K_R, mu_s, row):
    """limits.py walks trajectory after trajectory with a rigid body's own forces."""
    top = Top(a, I1, I3)
    with np.errstate(all="ignore"):
        found = widths(GRID_V, GRID_M, *np.array([[a], [I1], [I3]]), K_R, mu_s, PART)[:, 0, row]
    for width, mu in zip(found, (None, mu_s), strict=True):
        _, inner, outer, _ = limit(top, PART[row] * pole_constants(top, K_R)[0], K_R, mu)
        assert width == pytest.approx(np.nan_to_num(outer - inner), rel=1e-3)


def test_without_a_limit_all_is_allowed_and_more_friction_allows_more():
    assert allowed_shares(0.0, 0.4, 0.4, 10.0, 0.5) == 1
    shares = [allowed_shares(0.07, 0.399, 0.408, 10.0, mu_s) for mu_s in (0.1, 0.3, 0.5, 1.0, 20.0)]
    assert shares == sorted(shares) and shares[-1] == pytest.approx(1, abs=0.01)


def test_shares_of_many_are_those_of_each():
    """The same numbers, whatever else is in the batch."""
    a, I3 = np.linspace(-3.0, 0.4, 70), np.linspace(0.3, 0.7, 70)
    together = allowed_shares(a, 0.4, I3, 10.0, 0.5)
    for index in (0, 31, 32, 64, 69):
        assert together[index] == allowed_shares(a[index], 0.4, I3[index], 10.0, 0.5)


def test_a_map_grows_row_by_row_and_has_holes_where_no_top_is():
    steps = list(share_map(0.4, 10.0, 0.5, np.array([0.07, 0.3, 1.5]), np.array([1.0, 2.5])))
    assert [done for done, _ in steps] == [3, 6]
    assert np.isnan(steps[0][1].share[1]).all()
    share = steps[-1][1].share
    assert share[0, 0] == allowed_shares(0.07, 0.4, 0.4, 10.0, 0.5)
    assert np.array_equal(np.isnan(share), [[False, False, True], [True, True, True]])


def test_fig_5_of_a_region_is_the_papers():
    """The paper's P at its height 18.6, here in units of K_R^2; the tielines start and end at height 0."""
    found = region("", Top.paper(), 10.0, 0.5, count=2000)
    before, last = found.height[-2:].max(axis=1) * 100
    assert last + (last - before) / 2 == pytest.approx(18.6, abs=0.05)
    assert np.abs(found.height[:, [0, -1]]).max() < 1e-9
    assert found.theta[:, [0, -1]] == pytest.approx(np.column_stack([found.lift.theta_inner, found.lift.theta_outer]))
    assert np.all(np.diff(found.theta, axis=1) > 0)


def test_the_map_of_the_other_kind_starts_from_a_top_of_that_kind():
    for a, kind, other in ((-0.5, "ordinary", "tippe"), (0.07, "tippe", "ordinary")):
        compare = Compare(Explorer(a=a, K_R=3.0).scene)
        assert compare.kind.value == kind and compare.entries["K_R"].value == "3"
        compare.kind.value = other
        assert compare.entries["K_R"].value != "3" and float(compare.entries["I1"].value) > 0


def test_a_map_of_either_kind_fills_and_shows_this_top(explorer, monkeypatch):
    monkeypatch.setattr("app.tabs.families.compare.RATIOS", np.array([0.9, 1.1]))
    monkeypatch.setattr(
        "app.tabs.families.compare.SPANS", {"tippe": np.array([0.1, 0.2]), "ordinary": np.array([-10.0, -5.0])}
    )
    compare = Compare(explorer.scene)
    for kind, own in (("tippe", 1), ("ordinary", 0)):
        compare.kind.value = kind
        compare.compute()
        assert np.all((compare.shares.data["share"][0] > 0) & (compare.shares.data["share"][0] < 1))
        assert len(compare.here.data["a"]) == own
        assert compare.cancel.disabled and not compare.start.disabled


def test_a_map_stops_when_told_and_refuses_what_cannot_be(explorer, monkeypatch):
    asked = []

    def slowly(*args):
        yield 10, share_map_of_nothing
        compare.cancel.clicks += 1
        yield 20, share_map_of_nothing
        asked.append("more")

    share_map_of_nothing = next(share_map(0.4, 10.0, 0.5, np.array([0.07]), np.array([1.0, 1.1])))[1]
    monkeypatch.setattr("app.tabs.families.compare.share_map", slowly)
    compare = Compare(explorer.scene)
    compare.compute()
    assert not asked and "Cancelled" in compare.said.object and not compare.start.disabled
    for name, text in (("mu_s", "-1"), ("I1", "0"), ("K_R", "fast")):
        compare = Compare(explorer.scene)
        compare.entries[name].value = text
        compare.compute()
        assert typeset(name) in compare.said.object and not compare.start.disabled


def test_many_pieces_have_their_knobs_in_portions(builder, explorer):
    """Hundreds of them would keep the server for seconds."""
    many = 100
    points = tuple((0.01 + 0.001 * (i % 2), -0.009 + 0.0005 * i) for i in range(many))
    asked = []
    bench = Build(builder, asked.append)
    builder.load(save_top(Lathe(R=0.02, points=points, density=(700.0,) * many)))
    assert len(bench._knobs) == KNOBS and len(asked) == 1
    while asked:
        asked.pop()()
    assert list(bench._knobs) == [each.name for each in builder.draft.dimensions] and len(bench._knobs) > many
    assert sum(len(part) for part in bench.dimensions) == len(bench._knobs)

    builder.choose(PRESETS[0].name)
    builder.load(save_top(Lathe(R=0.02, points=points, density=(700.0,) * many)))
    [late] = asked
    builder.choose(PRESETS[0].name)
    late()  # another body is on the bench by now
    assert list(bench._knobs) == [each.name for each in builder.draft.dimensions] and len(bench._knobs) < KNOBS


@pytest.mark.slow
@pytest.mark.parametrize("value", [5e-324, 1e-300, 1e-12, 1e3, 1e9, 1e300])
@pytest.mark.parametrize("preset", PRESETS, ids=lambda preset: preset.name)
def test_no_number_in_a_field_is_too_small_or_too_large_to_be_answered(builder, preset, value):
    builder.choose(preset.name)
    for name in [dimension.name for dimension in builder.draft.dimensions]:
        builder.choose(preset.name)
        builder.set(name, value)
        if builder.draft.messages:
            assert not builder.draft.messages[name].startswith(("high", "low"))  # no field is called so
            assert builder.draft.shape == preset.shape


@pytest.mark.parametrize("given", [{"T": 1e200}, {"D": 1e-300}, {"dT": 1e300}, {"dD": 1e300}])
def test_a_period_or_diameter_out_of_this_world_is_refused(given):
    rocking = Rocking(**({"T": 1.08, "dT": 0.01, "D": 0.032, "dD": 1e-4, "M": 0.0115} | given))
    with pytest.raises(TopError):
        rocking.a(TruncatedSphere.paper())


# ---- whether it turns over ----


def test_the_verdict_is_that_of_the_run():
    """Leine and Glocker's toy stands; the same with its mass in the middle does not; a body that cannot be so."""
    toy = next(preset.shape for preset in PRESETS if preset.name.startswith("Leine"))
    found = verdict(toy)
    assert (found.code, found.headline) == ("over", "Yes, it turns over.")
    assert "past 90° after 1.0 s. It stands on its stem after 1.5 s. It starts to fall at 4.5 s." in found.why
    round_ = verdict(changed(toy, "a", 0.0))
    assert round_.code == "not" and "its tilt is between" in round_.why


def test_a_body_that_cannot_be_let_go_so_has_a_verdict_that_says_so(monkeypatch):
    def never(*start):
        raise TooLong

    monkeypatch.setattr("app.model.build.verdict.whole_on", never)
    found = verdict(PRESETS[0].shape)
    assert found.code == "refused" and "could not be computed" in found.headline and "chatters" in found.why


def test_the_words_beside_the_body_are_of_that_body():
    runs = Runs()
    told = VerdictWords(runs)
    assert "Working out" in told.view.object
    toy = next(preset.shape for preset in PRESETS if preset.name.startswith("Leine"))
    told.show(SimpleNamespace(shape=toy))
    assert "Yes, it turns over." in told.view.object and "Working out" not in told.view.object
    told.show(SimpleNamespace(shape=None))  # parted: nothing is known of it
    assert "Yes, it turns over." in told.view.object
