"""The tab for building a body, without a browser: its fields, its sentences, and whether the body turns over."""

import json
from dataclasses import replace
from types import SimpleNamespace

import pytest
from doubles import builder_of

from app.model.build.builder import Rocking
from app.model.build.dimensions import FAMILIES, INSIDES, changed, sentence, value_of
from app.model.build.inside import filled, inside
from app.model.build.verdict import Verdict, verdict
from app.model.runs import Full, Runs, Stopped
from app.tabs.build.build import Build
from app.tabs.build.verdict import VerdictWords
from tippe_core import (
    PRESETS,
    Ball,
    Lathe,
    Top,
    TopError,
    TruncatedSphere,
    save_top,
)


def told(bench):
    """{dimension: its value} as the controls show them."""
    return json.loads(bench.dimensions.view.state)["values"]


@pytest.fixture
def builder(explorer):
    return builder_of(explorer)


def test_every_dimension_is_a_field_within_its_slider():
    for preset in PRESETS:
        for dimension in FAMILIES[type(preset.shape)][1]:
            shown = value_of(preset.shape, dimension.name) * dimension.factor
            assert dimension.low <= shown <= dimension.high, (preset.name, dimension.name)


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
    assert builder.draft.name == "Loaded sphere" and "the core is not in it" in bench.derived.object
    builder.set("core_density", 0.0)  # a cavity has this density
    assert "STL" not in bench.derived.object and bench.families.value != "loaded sphere"
    bench.families.value = "loaded sphere"
    assert builder.draft.name == "Loaded sphere"


def test_the_inside_is_chosen_where_a_body_has_one(builder, explorer):
    bench = Build(builder)
    assert bench.inside.view.visible and bench.inside.switch.value == "solid" and not bench.inside.steel.visible
    bench.inside.switch.value = "both"
    assert {"hole", "depth", "disc", "thickness", "height"} <= {*told(bench)} and bench.inside.steel.visible
    assert explorer.scene.shape.disc > 0 and "the disc is not in it" in bench.derived.object
    builder.choose(PRESETS[0].name)
    assert bench.inside.switch.value == "solid" and "hole" not in told(bench)
    builder.choose("Uniform ball")
    assert not bench.inside.view.visible and builder.draft.name == "Uniform ball"


def test_a_material_sets_the_density_and_the_density_says_which_material_it_is(builder, explorer):
    bench = Build(builder)
    assert bench.material.view.value == "" and "other, 755.9 kg/m³" in bench.material.view.options
    bench.material.view.value = "beech"
    shape = explorer.scene.shape
    assert shape.density == pytest.approx(710) and bench.material.view.value == "beech"
    assert told(bench)["density"] == pytest.approx(710)
    assert (shape.top.a, shape.top.I1, shape.top.I3) == pytest.approx(
        (lambda top: (top.a, top.I1, top.I3))(TruncatedSphere.paper().top))  # fmt: skip
    builder.set("density", 675.2)
    assert bench.material.view.value == "oak" and explorer.scene.shape.density == pytest.approx(675.2)
    builder.set("M", 0.0115)
    assert bench.material.view.value == ""
    builder.choose("Loaded sphere")  # its core stays of steel
    assert bench.material.view.value == "acrylic"
    bench.material.view.value = "steel"
    assert explorer.scene.shape.density == explorer.scene.shape.core_density == 7850
    builder.choose("Free profile")
    bench.material.view.value = "lime"
    assert explorer.scene.shape.density == 535
    builder.part_densities()
    assert not bench.material.view.visible
    builder.choose("Top S")
    assert not bench.material.view.visible


def test_every_dimension_of_an_inside_is_within_its_slider():
    for preset in PRESETS:
        if inside(preset.shape):
            shape = filled(preset.shape, "both")
            for dimension in INSIDES["both"]:
                assert dimension.low <= value_of(shape, dimension.name) * dimension.factor <= dimension.high


def test_many_pieces_have_their_controls_soon(builder, explorer):
    """Of hundreds of them: they are one component, so that they do not block the server."""
    many = 100
    points = tuple((0.01 + 0.001 * (i % 2), -0.009 + 0.0005 * i) for i in range(many))
    bench = Build(builder)
    builder.load(save_top(Lathe(R=0.02, points=points, density=(700.0,) * many)))
    assert [*told(bench)] == [each.name for each in builder.draft.dimensions] and len(told(bench)) > many
    assert [part["name"] for part in json.loads(bench.dimensions.view.parts)] == [*told(bench)]
    builder.choose(PRESETS[0].name)
    assert [*told(bench)] == [each.name for each in builder.draft.dimensions] and len(told(bench)) < 32


def test_a_dimension_that_cannot_be_says_so_and_offers_the_nearest_that_can(builder, explorer):
    bench, before = Build(builder), builder.draft.shape
    bench.dimensions.view.request = [1, "r", 99.0, True]
    state = json.loads(bench.dimensions.view.state)
    assert builder.draft.shape is before and state["refused"] == {"r": 99.0} and state["messages"]["r"]
    assert state["values"]["r"] == pytest.approx(1e3 * before.r)
    near = state["nearest"]["r"]
    bench.dimensions.view.request = [2, "r", near, True]
    state = json.loads(bench.dimensions.view.state)
    assert not state["messages"] and builder.draft.shape.r == pytest.approx(near / 1e3) and near > state["answered"]
    builder.choose("Leine and Glocker's toy")  # its stem has a place of its own, which a larger sphere swallows
    bench.dimensions.view.request = [3, "R", 60.0, True]
    said = json.loads(bench.dimensions.view.state)["messages"]["R"]
    assert "radius of the sphere 60 mm" in said and "13 mm" in said  # names the field that was typed in


@pytest.mark.slow
@pytest.mark.parametrize("value", [5e-324, 1e-300, 1e-12, 1e3, 1e9, 1e300])
@pytest.mark.parametrize("preset", PRESETS, ids=lambda preset: preset.name)
def test_no_number_in_a_field_is_too_small_or_too_large_to_be_answered(builder, preset, value):
    builder.choose(preset.name)
    for name in [dimension.name for dimension in builder.draft.dimensions]:
        builder.choose(preset.name)
        builder.set(name, value)
        if builder.draft.messages:
            assert not builder.draft.messages[name].startswith(("high", "low"))  # no field has these names
            assert builder.draft.shape == preset.shape


@pytest.mark.parametrize("given", [{"T": 1e200}, {"D": 1e-300}, {"dT": 1e300}, {"dD": 1e300}])
def test_a_period_or_diameter_out_of_this_world_is_refused(given):
    rocking = Rocking(**({"T": 1.08, "dT": 0.01, "D": 0.032, "dD": 1e-4, "M": 0.0115} | given))
    with pytest.raises(TopError):
        rocking.a(TruncatedSphere.paper())


# ---- whether it turns over ----


def test_the_verdict_is_that_of_the_run():
    """Leine and Glocker's toy stands; with its mass in the middle it does not; and a body for which this is
    impossible."""
    toy = next(preset.shape for preset in PRESETS if preset.name.startswith("Leine"))
    found = verdict(toy)
    assert (found.code, found.headline) == ("stands", "Yes: it gets onto its stem.")
    assert "past 90° after 1.0 s. It stands on its stem after 1.5 s. It starts to fall at 4.5 s." in found.why
    round_ = verdict(changed(toy, "a", 0.0))
    assert round_.code in ("upright", "leans") and "its tilt is between" in round_.why


def test_a_body_that_cannot_be_let_go_so_has_a_verdict_that_says_so(monkeypatch):
    def never(*start):
        raise TopError("mu", 0.3, "mu < 0.2", "More friction than that no normal force balances.", code="too-strong")

    monkeypatch.setattr("app.model.build.verdict.whole_on", never)
    found = verdict(PRESETS[0].shape)
    assert found.code == "refused" and "could not be computed" in found.headline and "mu < 0.2" in found.why


def scene_of(shape, top=None):
    """What VerdictWords reads of a Scene."""
    return SimpleNamespace(shape=shape, top=top or shape.top, scales=shape.scales)


def test_the_words_beside_the_body_are_of_that_body():
    runs = Runs()
    told = VerdictWords(runs)
    assert "Working out" in told.view.object
    toy = next(preset.shape for preset in PRESETS if preset.name.startswith("Leine"))
    told.show(scene_of(toy))
    assert "Yes: it gets onto its stem." in told.view.object and "Working out" not in told.view.object
    told.show(SimpleNamespace(shape=None, top=toy.top))  # set independently of a body: nothing is known of it
    assert "Yes: it gets onto its stem." in told.view.object


def ending_in(monkeypatch, error):
    """The keys of the words used by VerdictWords if all runs of all spins end like this."""
    asked = []

    def never(*key, look):
        asked.append(key)
        raise error

    monkeypatch.setattr("app.tabs.build.verdict.ends_once", never)
    monkeypatch.setattr("app.tabs.build.verdict.known_ends", lambda *key: None)
    monkeypatch.setattr("app.tabs.build.verdict.verdict", lambda shape: Verdict("stands", "Yes", "so"))
    return asked


@pytest.mark.parametrize(
    "error, says, again",
    [
        (Full(17), "17 computations wait", True),
        (Stopped(), "was stopped before it was done", True),
        (TopError("a", 1.5, "a < 1"), "it could not be computed: a = 1.5 is not possible: allowed is a &lt; 1", False),
    ],
)
def test_the_strip_says_what_came_of_it_and_is_asked_for_again(monkeypatch, error, says, again):
    asked = ending_in(monkeypatch, error)
    told, preset = VerdictWords(Runs()), PRESETS[0]
    scene = scene_of(preset.shape, preset.top)
    for times in (1, 2):
        told.show(scene)
        assert says in told.strip.object and "Working it out" not in told.strip.object
        assert len(asked) == (times if again else 1)


def test_the_strip_is_of_the_scene_that_is_shown(monkeypatch):
    asked = ending_in(monkeypatch, Stopped())
    told, preset = VerdictWords(Runs()), PRESETS[0]
    own = changed(preset.shape, "a", 0.0) if hasattr(preset.shape, "a") else PRESETS[1].shape
    told.show(scene_of(preset.shape, preset.top))
    told.show(scene_of(own))
    assert [key.shape for (key,) in asked] == [preset.shape, own] and asked[0][0].top == preset.top


def test_a_verdict_that_nobody_computed_says_so(monkeypatch):
    def never(shape):
        raise Full(17)

    ending_in(monkeypatch, Stopped())
    monkeypatch.setattr("app.tabs.build.verdict.verdict", never)
    told = VerdictWords(Runs())
    told.show(scene_of(PRESETS[0].shape))
    assert "17 computations wait" in told.view.object and "Working out" not in told.view.object
