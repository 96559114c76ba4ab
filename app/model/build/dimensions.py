"""The dimensions of a body that can be set, dragged and shown: in SI, and for a reader each in its own unit."""

import math
import re
from dataclasses import dataclass, fields, replace
from typing import Any, TypeAlias

import numpy as np

from app.model.build.inside import INSIDE, inside_handles, inside_pulled, with_inside
from app.text import error_text, listed, say
from tippe_core import (
    Ball,
    BareSphere,
    Lathe,
    LoadedSphere,
    OrdinaryTop,
    Shape,
    StemmedSphere,
    TopError,
    TruncatedSphere,
    Turned,
)
from tippe_core.bodies import LARGEST, OneMaterial, across

CORNER = 1 - math.sqrt(0.5)  # of the radius of a rounded edge: how far its middle is from both faces

Value: TypeAlias = Any  # the type of a field: a number, a tuple of numbers or of points, a Solid


@dataclass(frozen=True)
class Dimension:
    """A field of a shape as a reader sees it: factor is the number of its units in one of SI; low to high is the range
    of the slider.

    key: that of its words in build.toml; numbers: the values that these quote, (name, value).
    """

    name: str
    key: str
    unit: str
    factor: float
    low: float
    high: float
    step: float
    numbers: tuple[tuple[str, Value], ...] = ()

    @property
    def words(self) -> str:
        return say(f"build.dimensions.{self.key}", **dict(self.numbers))


def _length(name: str, key: str, low: float, high: float) -> Dimension:
    return Dimension(name, key, "mm", 1e3, low, high, 0.1)


def density_dimension(name: str, key: str, **numbers: float) -> Dimension:
    return Dimension(name, key, "kg/m³", 1.0, 0, 12_000, 10, tuple(numbers.items()))


MASS = Dimension("M", "mass", "g", 1e3, 0.5, 200, 0.1)
# in a body of one material each of them determines the other
_WEIGHT = (MASS, density_dimension("density", "weight"))
# of a body with an unknown interior
_MEASURED = (MASS, Dimension("a", "a", "", 1.0, -0.9, 0.9, 0.005), Dimension("I1", "I1", "", 1.0, 0.05, 0.7, 0.001),
             Dimension("I3", "I3", "", 1.0, 0.05, 0.7, 0.001))  # fmt: skip

_HOLE = (_length("hole", "hole", 0.5, 30), _length("depth", "hole_depth", 0.5, 40))
_DISC = (_length("disc", "disc", 0.5, 30), _length("thickness", "disc_thickness", 0.2, 20),
         _length("height", "disc_height", 0.1, 40))  # fmt: skip
INSIDES = {"": (), "solid": (), "hole": _HOLE, "disc": _DISC, "both": (*_HOLE, *_DISC)}
"""{what is inside, as in inside.py: its Dimensions}."""

FAMILIES: dict[type[Shape], tuple[str, tuple[Dimension, ...]]]
FAMILIES = {
    TruncatedSphere: ("truncated sphere with a stem", (
        _length("R", "sphere", 2, 40), _length("c", "cut", -20, 40),
        _length("l", "stem", 0, 60), _length("r", "stem_radius", 0, 15),
        _length("rounding", "rounding", 0, 15), *_WEIGHT)),
    LoadedSphere: ("loaded sphere", (
        _length("R", "sphere", 2, 40), _length("b", "core", 0.5, 30), _length("d", "depth", -30, 30),
        density_dimension("density", "sphere_density"), density_dimension("core_density", "core_density"), MASS)),
    OrdinaryTop: ("ordinary top", (
        _length("R", "peg", 0.5, 20), _length("h", "peg_height", 0, 60),
        _length("r1", "below", 0.5, 50), _length("r2", "above", 0, 50),
        _length("t", "thickness", 0.5, 60), _length("r", "stem_radius", 0, 15),
        _length("l", "stem", 0, 60), *_WEIGHT)),
    Ball: ("uniform ball", (_length("R", "radius", 2, 40), *_WEIGHT)),
    BareSphere: ("sphere of unknown inside", (_length("R", "sphere", 2, 40), *_MEASURED)),
    StemmedSphere: ("sphere with a round stem, of unknown inside", (
        _length("R", "sphere", 2, 40), _length("r", "stem_end", 0.5, 20), _length("h", "stem_height", 0.5, 60),
        *_MEASURED)),
    Lathe: ("turned from points", (_length("R", "peg", 0.5, 40), density_dimension("density", "density"), MASS)),
    Turned: ("turned from pieces", (MASS,)),
}  # fmt: skip
"""{kind of shape: (the name of its family, a key in build.toml, the Dimensions that can be set)}."""


def named(preset: str) -> str:
    """The name on the page of a preset of tippe_core."""
    return listed("build.presets")[preset]["name"]


def sentence(error: TopError) -> str:
    """A TopError in the units of the sliders: m becomes mm, kg becomes g."""
    unit = {"m": "mm", "kg": "g"}.get(error.numbers.get("unit", ""))
    if unit is None or not isinstance(error.value, float):
        return error_text(error)
    numbers = {name: _thousandfold(error.numbers[name]) for name in ("range", "most") if name in error.numbers}
    value = float(f"{1e3 * error.value:.6g}")
    return error_text(error.replaced(error.name, value, unit=unit, **numbers), unit=unit)


def _thousandfold(number: Value) -> Value:
    """A number, or every number in a formula such as 0 < R <= 0.5, times a thousand."""
    if not isinstance(number, str):
        return 1e3 * number
    return re.sub(r"(?<![\w./[])-?\d+(\.\d+)?(e[+-]?\d+)?(?![\w.])", lambda x: f"{1e3 * float(x[0]):g}", number)


def value_of(shape: Shape, name: str) -> Value:
    """The dimension with that name, in SI; "point 2" and "density 2" belong to row 2 of a Lathe."""
    field, index = _field(name)
    if name == "M":
        return shape.mass
    return getattr(shape, field) if index is None else getattr(shape, field)[index]


def changed(shape: Shape, name: str, value: Value) -> Shape:
    """The shape with another value of that dimension. Its form does not change if a mass is set where densities are
    given, or the other way round; what is inside is changed in the same wood."""
    field, index = _field(name)
    given = {one.name: getattr(shape, one.name) for one in fields(shape)}
    if name == "M" and "M" not in given:
        return shape.with_mass(value)
    if name == "density" and isinstance(shape, OneMaterial):
        return type(shape).from_density(value, **{key: size for key, size in given.items() if key != "M"})
    if name in INSIDE and isinstance(shape, TruncatedSphere):
        return with_inside(shape, **{name: value})
    if index is not None:
        rows = list(getattr(shape, field))
        rows[index] = value
        given[field] = tuple(rows)
    else:
        given[field] = value
    return replace(shape, **{field: given[field]})


def nearest(shape: Shape, dimension: Dimension, wanted: float) -> float | None:
    """The last possible value on the way from the present value of a dimension to an impossible one, in its unit and in
    steps of its slider; None if that is the present value."""
    name, factor, step = dimension.name, dimension.factor, dimension.step
    present = value_of(shape, name) * factor

    def can_be(value: float) -> bool:
        try:
            changed(shape, name, value / factor).top  # noqa: B018  (a body may be sound and still stand on no peg)
        except TopError:
            return False
        return True

    far = 1e6 * dimension.high
    good, bad = present, min(max(wanted, -far), far)
    while abs(bad - good) > 0.01 * step:
        middle = (good + bad) / 2
        good, bad = (middle, bad) if can_be(middle) else (good, middle)
    way = 1 if wanted > present else -1
    last = way * math.floor(way * good / step + 0.02)  # the limit itself may be possible
    for found in (round(steps * step, 6) for steps in (last, last - way)):
        if (found - present) * way > 0 and can_be(found):
            return found
    return None


def _field(name: str) -> tuple[str, int | None]:
    """The field of a shape that contains a dimension, and the row there, or None."""
    field, _, index = name.partition(" ")
    return {"point": "points"}.get(field, field), int(index) if index else None


def handles(shape: Shape) -> dict[str, tuple[float, float]]:
    """The handles of the section: {dimension: (x, z)}, m, x perpendicular to axis 3 and z above O along it."""
    R = shape.R
    side = (R * np.sqrt(0.5), -R * np.sqrt(0.5))
    if isinstance(shape, TruncatedSphere):
        at = {"R": side, "c": (-across(R, shape.c), shape.c)} | inside_handles(shape)
        stem = {"r": (shape.r, shape.c + shape.l / 2), "l": (0.0, shape.c + shape.l), "rounding": on_rounding(shape)}
        return at | stem if shape.l else at
    if isinstance(shape, LoadedSphere):
        return {"R": side, "b": (shape.b, -shape.d), "d": (0.0, -shape.d)}
    if isinstance(shape, OrdinaryTop):
        face = shape.h + shape.t
        at = {"R": side, "h": (-shape.r1, shape.h), "r1": (shape.r1, shape.h), "r2": (shape.r2, face),
              "t": (-shape.r2, face)}  # fmt: skip
        return at | {"r": (shape.r, face + shape.l / 2), "l": (0.0, face + shape.l)} if shape.l else at
    if isinstance(shape, BareSphere):
        at = {"R": side, "a": (0.0, -shape.a * R)}
        return at | {"r": (shape.r, shape.h), "h": (0.0, shape.h)} if isinstance(shape, StemmedSphere) else at
    if isinstance(shape, Lathe):
        half = np.arccos(-shape.points[0][1] / R) / 2
        return {"R": (R * np.sin(half), -R * np.cos(half)),
                **{f"point {index}": point for index, point in enumerate(shape.points)}}  # fmt: skip
    return {"R": side} if isinstance(shape, Ball) else {}


def on_rounding(shape: TruncatedSphere) -> tuple[float, float]:
    """The middle of the rounded edge of the stem's end, on its left, (x, z) in m."""
    inwards = CORNER * shape.rounding
    return inwards - shape.r, shape.c + shape.l - inwards


def pulled(shape: Shape, name: str, x: float, z: float) -> float | tuple[float, float]:
    """The value of the dimension (SI, to 0.01 mm) for which its handle is nearest to (x, z)."""
    if name.startswith("point ") and isinstance(shape, Lathe):
        # not beyond its neighbours, because the heights of a profile ascend
        points, index = shape.points, int(name[6:])
        low = points[index - 1][1] if index else -shape.R
        high = points[index + 1][1] if index + 1 < len(points) else LARGEST
        return (max(0.0, round(float(x), 5)), min(max(round(float(z), 5), low), high))
    if name in INSIDE and isinstance(shape, TruncatedSphere):
        value = inside_pulled(shape, name, x, z)
    elif name == "rounding" and isinstance(shape, TruncatedSphere):
        cut_off = (shape.r - abs(x)) + (shape.c + shape.l - z)
        value = min(max(cut_off / (2 * CORNER), 0.0), shape.r, shape.l)
    elif name == "R" and isinstance(shape, Lathe):
        value = np.hypot(x, z)
    elif name == "R":
        value = (x - z) * np.sqrt(0.5)
    elif name in ("r", "r1", "r2", "b"):
        value = abs(x)
    elif name == "a":
        return round(float(-z / shape.R), 3)
    else:
        below = {"l": getattr(shape, "c", 0.0), "d": 0.0, "c": 0.0, "h": 0.0, "t": getattr(shape, "h", 0.0)}[name]
        if name == "l" and isinstance(shape, OrdinaryTop):
            below = shape.h + shape.t
        value = -z if name == "d" else z - below
    return round(float(value), 5)
