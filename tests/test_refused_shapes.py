"""Impossible bodies, and files: each is refused with the name of what is wrong, or read as it was saved."""

import json
from math import asin, cos

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from test_shapes import BORED, PAPER, SHAPES, VASE

from tippe_core import (
    Ball,
    BareSphere,
    Lathe,
    LoadedSphere,
    OrdinaryTop,
    StemmedSphere,
    TopError,
    TruncatedSphere,
    Turned,
    ball,
    cylinder,
    frustum,
    load_top,
    save_top,
    zone,
)

# --- what is refused ---

GOOD = {"R": 0.016, "c": 0.0082, "l": 0.0192, "r": 0.0032, "M": 0.0115}
FILLED = GOOD | {"hole": 0.009, "depth": 0.008, "disc": 0.004, "thickness": 0.003, "height": 0.002}
PEG = {"R": 0.002, "h": 0.01, "r1": 0.02, "r2": 0.02, "t": 0.004, "r": 0.002, "l": 0.01, "M": 0.02}
CORE = {"R": 0.02, "b": 0.008, "d": 0.01, "density": 700.0, "core_density": 7800.0}
SPHERE = {"R": 0.02, "M": 0.02, "a": 0.3, "I1": 0.37, "I3": 0.4}
TOY = {"R": 0.015, "M": 0.006, "a": 0.2, "I1": 0.593, "I3": 0.519, "r": 0.005, "h": 0.013}


@pytest.mark.parametrize(
    ("kind", "good", "name", "value"),
    [
        (TruncatedSphere, GOOD, "R", 0.0), (TruncatedSphere, GOOD, "R", -0.016), (TruncatedSphere, GOOD, "R", np.nan),
        (TruncatedSphere, GOOD, "R", 1e9), (TruncatedSphere, GOOD, "R", 1e-9), (TruncatedSphere, GOOD, "c", 0.017),
        (TruncatedSphere, GOOD, "c", -0.016), (TruncatedSphere, GOOD, "l", -0.01), (TruncatedSphere, GOOD, "l", 0.0),
        (TruncatedSphere, GOOD, "l", np.inf), (TruncatedSphere, GOOD, "r", 0.0145), (TruncatedSphere, GOOD, "r", 0.0),
        (TruncatedSphere, GOOD, "r", "thick"), (TruncatedSphere, GOOD, "M", 0.0), (TruncatedSphere, GOOD, "M", 1e9),
        (TruncatedSphere, FILLED, "hole", 0.0032), (TruncatedSphere, FILLED, "hole", 0.0138),
        (TruncatedSphere, FILLED, "hole", 0.0), (TruncatedSphere, FILLED, "hole", -0.009),
        (TruncatedSphere, FILLED, "depth", 0.0), (TruncatedSphere, FILLED, "depth", 0.0242),
        (TruncatedSphere, FILLED, "disc", 0.0), (TruncatedSphere, FILLED, "disc", 0.0078),
        (TruncatedSphere, FILLED, "disc", np.nan), (TruncatedSphere, FILLED, "thickness", 0.0),
        (TruncatedSphere, FILLED, "thickness", 0.0143), (TruncatedSphere, FILLED, "thickness", -0.001),
        (TruncatedSphere, FILLED, "height", 0.0), (TruncatedSphere, FILLED, "height", 0.02),
        (TruncatedSphere, FILLED, "M", 0.0011),
        (OrdinaryTop, PEG, "h", -0.001), (OrdinaryTop, PEG, "r1", 0.0), (OrdinaryTop, PEG, "r2", 0.001),
        (OrdinaryTop, PEG, "t", 0.0), (OrdinaryTop, PEG, "r", 0.03), (OrdinaryTop, PEG, "l", 0.0),
        (LoadedSphere, CORE, "b", 0.02), (LoadedSphere, CORE, "d", 0.012), (LoadedSphere, CORE, "d", -0.013),
        (LoadedSphere, CORE, "density", 0.0), (LoadedSphere, CORE, "core_density", -1.0),
        (BareSphere, SPHERE, "a", 0.9), (BareSphere, SPHERE, "a", 1.5), (BareSphere, SPHERE, "I1", 0.9),
        (BareSphere, SPHERE, "I3", 0.8), (BareSphere, SPHERE, "M", -1.0),
        (StemmedSphere, TOY, "r", 0.0), (StemmedSphere, TOY, "r", 0.016), (StemmedSphere, TOY, "h", 0.02),
        (StemmedSphere, TOY, "h", 0.009), (StemmedSphere, TOY, "a", 0.9), (StemmedSphere, TOY, "I1", 1.3),
        (Ball, {"R": 0.02, "M": 0.04}, "M", None),
    ],
)  # fmt: skip
def test_impossible_bodies_are_named(kind, good, name, value):
    kind(**good)
    with pytest.raises(TopError) as raised:
        kind(**good | {name: value})
    # the stem is too thick for its face, or the face too small for the stem
    assert raised.value.name == ("r" if (name, value) == ("r2", 0.001) else name)
    assert raised.value.allowed and str(raised.value).endswith(".")


@pytest.mark.parametrize(
    ("make", "name"),
    [
        (lambda: Lathe(R=0.005, points=(), density=700.0), "points"),
        (lambda: Lathe(R=0.005, points=((0.003, -0.006),), density=700.0), "points[0] height"),
        (lambda: Lathe(R=0.005, points=((0.003, -0.005),), density=700.0), "points[0] height"),
        (lambda: Lathe(R=0.005, points=((0.01, 0.0), (0.01, -0.001)), density=700.0), "points[1] height"),
        (lambda: Lathe(R=0.005, points=((0.01, 0.0), (-0.01, 0.001)), density=700.0), "points[1] radius"),
        (lambda: Lathe(R=0.005, points=((0.01, 0.0), (0.01, np.nan)), density=700.0), "points[1]"),
        (lambda: Lathe(R=0.005, points=((0.01, 0.0), (0.01,)), density=700.0), "points[1]"),
        (lambda: Lathe(R=0.005, points=((0.01, 0.0), (0.01, 0.01)), density=(700.0,)), "density"),
        (lambda: Lathe(R=0.005, points=((0.01, 0.0), (0.01, 0.01)), density=(700.0, 0.0)), "density[1]"),
        (lambda: Lathe(R=0.005, points=((0.01, 0.0),), density=-1.0), "density"),
        (lambda: Lathe(R=0.005, points=((0.0, 0.005), (0.0, 0.006), (0.01, 0.007)), density=1.0), "points"),
        (lambda: Lathe(R=0.005, points=((0.01, 0.0), (0.0, 0.01), (0.01, 0.02)), density=1.0), "points"),
        (lambda: Turned(R=0.1, solid=ball(0.1) - frustum(0.1, 0.02, 0.0, 0.03) + cylinder(0.02, 0.0, 0.05)), "solid"),
        (lambda: Ball(R=0.02, M=0.04) - 9000 * ball(0.01), "density"),
        (lambda: PAPER - PAPER.density * ball(0.001, -0.0165), "density"),
        (lambda: PAPER + 700 * ball(0.002, 0.05), "solid"),
        (lambda: PAPER + 700 * cylinder(0.01, -0.02, 0), "R"),
        (lambda: Turned(R=0.01, solid=700 * ball(0.02)), "R"),
        (lambda: Turned(R=0.01, solid=700 * cylinder(0.01, -0.01, 0.01)), "R"),
        (lambda: Turned(R=0.01, solid="ball"), "solid"),
        (lambda: zone(0.01, -0.02, 0.0), "low"),
        (lambda: zone(-0.01, -0.01, 0.01), "R"),
        (lambda: cylinder(0.01, 0.02, 0.01), "high"),
        (lambda: frustum(0.01, -0.01, 0.0, 0.01), "r_high"),
        (lambda: SHAPES["Top S"].stl(), "shape"),
        (lambda: PAPER.stl(2), "sides"),
        (lambda: PAPER.with_mass(0.0), "M"),
        (lambda: TruncatedSphere.from_density(-1.0, R=0.016, c=0.0, l=0.0, r=0.0), "density"),
    ],
)  # fmt: skip
def test_impossible_profiles_and_solids_are_named(make, name):
    with pytest.raises(TopError) as raised:
        make()
    assert raised.value.name == name


# --- files ---


@pytest.mark.parametrize("name", SHAPES)
def test_a_saved_top_comes_back(name):
    text = save_top(SHAPES[name])
    assert load_top(text) == SHAPES[name]
    assert load_top(text.encode()) == SHAPES[name]
    document = json.loads(text)
    assert (document["schema"], document["version"]) == ("tippe-top-explorer/top", 1)
    assert len(text) < 4000


@given(st.floats(1e-2, 1), st.floats(-0.99, 1), st.floats(1e-3, 5), st.floats(1e-3, 1), st.floats(1e-4, 10))
def test_any_truncated_sphere_comes_back(R, c, l, share, M):
    r = share * R * cos(asin(c))
    shape = TruncatedSphere(R=R, c=c * R, l=0.0 if r < 1e-6 * R else l, r=0.0 if r < 1e-6 * R else r, M=M)
    assert load_top(save_top(shape)) == shape


def changed(**changes):
    document = json.loads(save_top(PAPER))
    for name, value in changes.items():
        where = document if name in document else document["dimensions"]
        where[name] = value
    return json.dumps(document)


SHALLOW, DEEP = '{"a":' * 500 + "1" + "}" * 500, "[" * 60_000


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("", "file"), ("nonsense", "file"), ("null", "file"), ("[]", "file"), ("3", "file"), ("{}", "schema"),
        (b"\xff\xfe\x00", "file"), (b"\x89PNG\r\n", "file"), (DEEP, "file"), (" " * 70_000, "file"), (SHALLOW, "a"),
        (None, "text"), (7, "text"),
        (changed(schema="other"), "schema"), (changed(schema=None), "schema"), (changed(schema=["x" * 500]), "schema"),
        (changed(version=2), "version"), (changed(version="1"), "version"), (changed(version=True), "version"),
        (changed(kind="os.system"), "kind"), (changed(kind=["Ball"]), "kind"), (changed(kind="Shape"), "kind"),
        (changed(kind="LoadedSphere"), "c"), (changed(kind="Ball"), "c"), (changed(dimensions=[]), "dimensions"),
        (changed(dimensions={}), "R"), (changed(colour="red"), "colour"), (changed(__class__="x"), "__class__"),
        (changed(r=None), "r"), (changed(r="0.003"), "r"), (changed(r=True), "r"), (changed(r=[0.003]), "r"),
        (changed(r=0.5), "r"), (changed(R=-0.016), "R"), (changed(c=0.02), "c"), (changed(M=0), "M"),
        (changed(M={"__reduce__": 1}), "M"),
        (changed(r=1).replace('"r": 1', '"r": NaN'), "r"), (changed(r=1).replace('"r": 1', '"r": -Infinity'), "r"),
        (changed(r=1).replace('"r": 1', '"r": 1e999'), "r"),
        (changed(r=1).replace('"r": 1', '"r": ' + "9" * 5000), "r"),
        (changed(r=1).replace('"r": 1', '"r": 0.001, "r": 0.002'), "r"),
        (save_top(VASE).replace("0.018", '"0.018"'), "points[1]"),
        (save_top(VASE).replace("7800.0", "[7800.0]"), "density[0]"),
        (save_top(BORED).replace('"Zone"', '"Torus"', 1), "solid[0].piece"),
        (save_top(BORED).replace('"centre"', '"middle"', 1), "middle"),
        (save_top(BORED).replace('"low": -0.016', '"low": -0.018', 1), "solid[0].low"),
    ],
    ids=lambda value: repr(value)[:40] if not isinstance(value, str) else value[:24] + str(len(value)),
)  # fmt: skip
def test_hostile_files_are_refused_by_name(text, name):
    with pytest.raises(TopError) as raised:
        load_top(text)
    assert raised.value.name == name
    assert len(str(raised.value)) < 500


json_values = st.recursive(
    st.none() | st.booleans() | st.floats() | st.integers() | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=5), inner, max_size=3),
    max_leaves=8,
)


@given(st.sampled_from(sorted(SHAPES)), st.data())
def test_a_file_with_anything_in_a_field_is_a_top_or_a_TopError(name, data):
    document = json.loads(save_top(SHAPES[name]))
    field = data.draw(st.sampled_from(sorted(document["dimensions"])))
    document["dimensions"][field] = data.draw(json_values)
    try:
        shape = load_top(json.dumps(document))
    except TopError as error:
        assert str(error)
    else:
        assert shape.mass > 0
        shape.profile(500)


@given(st.binary(max_size=200) | st.text(max_size=200))
def test_random_bytes_are_refused(data):
    with pytest.raises(TopError):
        load_top(data)
