"""The top builder without its widgets: dimensions, presets and files -> a shape, and the motion it is given.

SI, as in tippe_core.bodies. Where a person reads or sets a dimension it is in the unit of its Dimension.
"""

import re
from collections.abc import Callable
from dataclasses import dataclass, field, fields, replace
from types import MappingProxyType
from typing import Any, TypeAlias

import numpy as np
import param

from app.model.bodies import fits
from app.model.explorer import Explorer
from app.text import listed, say, told
from tippe_core import (
    PRESETS,
    Ball,
    BareSphere,
    Constants,
    Lathe,
    LoadedSphere,
    Measured,
    OrdinaryTop,
    Preset,
    Scales,
    Shape,
    Solid,
    StemmedSphere,
    Top,
    TopError,
    TruncatedSphere,
    Turned,
    a_from_rocking,
    ball,
    cylinder,
    frustum,
    load_top,
    pole_constants,
    save_top,
)
from tippe_core.bodies.shape import OneMaterial
from tippe_core.bodies.slices import LARGEST
from tippe_core.paper.curve import f3_squared

# What a new body is thrown with: the spin near theta = 0 that the paper's top has at K_R = 10, and a tippe top's K_J at
# the share of P that it has at K_J = 7. An ordinary top is let go at a tilt, or it would not stay up.
THROWN_SHARE = 7 / pole_constants(Top.paper(), 10.0)[0]
THROWN_SPIN = 10.0 / f3_squared(0.0, Top.paper()) ** 0.5 * Scales.paper().angular_velocity  # rad/s
THROWN_TILT = 0.3

LARGEST_FILE = 64 * 1024  # bytes, of a saved top

Value: TypeAlias = Any  # of a field: a number, a tuple of them or of points, a Solid
Motion: TypeAlias = Callable[[Shape], tuple[float, float]]  # K_J and K_R
Edit: TypeAlias = Callable[[tuple[Value, ...], Callable[[tuple[Value, ...], int], Value]], tuple[Value, ...]]


@dataclass(frozen=True)
class Dimension:
    """A field of a shape as a person reads it: factor is the number of units in one of SI; low to high, the slider.

    key: of its words, in workshop.toml; numbers: what stands in them, (name, value).
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
        return say(f"workshop.dimensions.{self.key}", **dict(self.numbers))


def _length(name: str, key: str, low: float, high: float) -> Dimension:
    return Dimension(name, key, "mm", 1e3, low, high, 0.1)


def _density(name: str, key: str, **numbers: float) -> Dimension:
    return Dimension(name, key, "kg/m³", 1.0, 0, 12_000, 10, tuple(numbers.items()))


_MASS = Dimension("M", "mass", "g", 1e3, 0.5, 200, 0.1)
# of one material: each sets the other
_WEIGHT = (_MASS, _density("density", "weight"))
# of a body whose inside is not known
_MEASURED = (_MASS, Dimension("a", "a", "", 1.0, -0.9, 0.9, 0.005), Dimension("I1", "I1", "", 1.0, 0.05, 0.7, 0.001),
             Dimension("I3", "I3", "", 1.0, 0.05, 0.7, 0.001))  # fmt: skip

FAMILIES: dict[type[Shape], tuple[str, tuple[Dimension, ...]]]
FAMILIES = {
    TruncatedSphere: ("truncated sphere with a stem", (
        _length("R", "sphere", 2, 40), _length("c", "cut", -20, 40),
        _length("l", "stem", 0, 60), _length("r", "stem_radius", 0, 15), *_WEIGHT)),
    LoadedSphere: ("loaded sphere", (
        _length("R", "sphere", 2, 40), _length("b", "core", 0.5, 30), _length("d", "depth", -30, 30),
        _density("density", "sphere_density"), _density("core_density", "core_density"), _MASS)),
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
    Lathe: ("turned from points", (_length("R", "peg", 0.5, 40), _density("density", "density"), _MASS)),
    Turned: ("turned from pieces", (_MASS,)),
}  # fmt: skip
"""{kind of shape: the name of its family, a key in workshop.toml, and the Dimensions that can be set}."""


def named(preset: str) -> str:
    """What a preset of tippe_core is called on the page."""
    return listed("workshop.presets")[preset]["name"]


@dataclass(frozen=True, kw_only=True)
class Draft:
    """The body as it stands on the bench: all that its views show.

    messages: a sentence for each field ("file" and "stl" among them) that was given what cannot be; the shape is then
    the last good one. name and source: of the preset it is, else empty; the name is tippe_core's.
    """

    shape: Shape
    messages: MappingProxyType[str, str] = field(default_factory=lambda: MappingProxyType({}))
    name: str = ""
    source: str = ""

    @property
    def family(self) -> str:
        """What kind of body it is: a key in workshop.toml."""
        return FAMILIES[type(self.shape)][0]

    @property
    def dimensions(self) -> tuple[Dimension, ...]:
        """The Dimensions that can be set."""
        dimensions = FAMILIES[type(self.shape)][1]
        if isinstance(self.shape, Lathe) and isinstance(self.shape.density, tuple):
            last = self.shape.points[0][1]
            pieces = [_density("density 0", "peg_density")]
            for index, (_, height) in enumerate(self.shape.points[1:], 1):
                if height > last:  # a step is no piece
                    pieces.append(_density(f"density {index}", "piece_density", low=1e3 * last, high=1e3 * height))
                last = height
            return (dimensions[0], *pieces, _MASS)
        return dimensions


class Builder(param.Parameterized):
    """Changes the body of an Explorer. Every change, or refusal, is one `draft` event.

    request: what takes the Explorer's new inputs, Explorer.param.update or a Pacer's request.
    """

    # __init__ makes the first one
    draft: param.ClassSelector[Draft] = param.ClassSelector(  # type: ignore[assignment]
        class_=Draft, constant=True, doc="the body as it stands"
    )

    def __init__(self, explorer: Explorer, request: Callable[..., object] | None = None) -> None:
        super().__init__()  # type: ignore[no-untyped-call]  # of param
        self._explorer, self._request = explorer, request or explorer.param.update
        self._publish(_draft(explorer.shape, self._present))

    def set(self, name: str, value: float | tuple[float, float]) -> None:
        """One dimension, in SI; "point 2" and "density 2" are those of a Lathe's row 2."""
        self._try(name, lambda: changed(self.draft.shape, name, value))

    @property
    def _lathe(self) -> Lathe:
        """The body, where it is one of points."""
        assert isinstance(self.draft.shape, Lathe)
        return self.draft.shape

    def add_point(self, x: float = 0.0, z: float | None = None) -> None:
        """A point of a Lathe's profile: at radius |x| and height z, or in the middle of its longest piece."""
        points = self._lathe.points
        if z is None:
            rows = np.array(points)
            index = int(np.hypot(*np.diff(rows, axis=0).T).argmax()) + 1 if len(rows) > 1 else 1
            x, z = rows[index - 1 : index + 1].mean(axis=0) if len(rows) > 1 else rows[0] + [0, self.draft.shape.R]
        else:
            index = sum(height <= z for _, height in points)
        self._rows("points", lambda rows, fill: (*rows[:index], fill(rows, index), *rows[index:]), (abs(x), z))

    def remove_point(self, index: int) -> None:
        """Takes the point away."""
        self._rows("points", lambda rows, fill: (*rows[:index], *rows[index + 1 :]), ())

    def _rows(self, name: str, edit: Edit, point: tuple[float, ...]) -> None:
        """The Lathe whose points, and densities if it has one a point, are edited alike."""
        shape = self._lathe
        rows: dict[str, Value] = {
            "points": edit(shape.points, lambda rows, index: tuple(round(float(x), 5) for x in point))
        }
        if isinstance(shape.density, tuple):
            rows["density"] = edit(shape.density, lambda rows, index: rows[min(index, len(rows) - 1)])
        self._try(name, lambda: replace(shape, **rows))

    def part_densities(self) -> None:
        """A density for each piece of a Lathe instead of one for all, or back to the first."""
        shape = self._lathe
        density = shape.density[0] if isinstance(shape.density, tuple) else (shape.density,) * len(shape.points)
        self._try("density", lambda: replace(shape, density=density))

    def compose(self, kind: str, density: float, r: float, low: float, high: float) -> None:
        """Puts a piece on the body, or takes it away where the density (kg/m^3) is negative: a "cylinder" or "cone"
        (its point up) from the height low to high (m), or a "ball" of radius r about (low + high)/2."""

        def made() -> Shape:
            form = {"cylinder": lambda: cylinder(r, low, high), "cone": lambda: frustum(r, 0.0, low, high),
                    "ball": lambda: ball(r, (low + high) / 2)}[kind]()  # fmt: skip
            return self.draft.shape + density * form

        self._try("piece", made)

    def take_off(self) -> None:
        """Undoes the last compose of a Turned body."""
        shape = self.draft.shape
        self._try("piece", lambda: Turned(R=shape.R, solid=Solid(shape.solid.slices[:-1])))

    def choose(self, name: str) -> None:
        """The preset of this name, thrown anew."""
        self._take(next(preset for preset in PRESETS if preset.name == name))

    def choose_family(self, family: str) -> None:
        """The first preset of a family, thrown anew."""
        self._take(next(preset for preset in PRESETS if FAMILIES[type(preset.shape)][0] == family))

    def load(self, text: str | bytes) -> None:
        """The body in a file that save() wrote, thrown anew."""
        self._try("file", lambda: load_top(text), thrown)

    def refuse_file(self, largest: int) -> None:
        """Says that a file was larger than so many bytes."""
        self._refuse("file", TopError(
            "file", "too large", "at most {most} bytes", "A saved top is far smaller.", code="file-too-large",
            most=largest))  # fmt: skip

    def follow(self) -> None:
        """Shows the body that the Explorer was given by something else."""
        now = _draft(self._explorer.shape, self._present)
        if (now.shape, now.name) != (self.draft.shape, self.draft.name):
            self._publish(now)

    def save(self) -> str:
        """The body as the text of a small JSON file."""
        return save_top(self.draft.shape)

    def stl(self) -> bytes | None:
        """The body as the bytes of an STL file, in mm; None, and a sentence at "stl", where there is none."""
        try:
            return self.draft.shape.stl()
        except TopError as error:
            self._refuse("stl", error)
            return None

    def measured(self, *, M: float, R: float, a: float) -> None:
        """A sphere of this M and R with a/R as measured and the inertia, in MR^2, of the body on the bench."""
        own = self.draft.shape.top
        self._try("measured", lambda: BareSphere(R=R, M=M, a=a, I1=own.I1, I3=own.I3))

    def attach(self) -> None:
        """Gives the Explorer the body's own a, I1 and I3 back."""
        self._adopt(self.draft.shape, self._keep)

    @property
    def attached(self) -> bool:
        """Whether the Explorer's a, I1 and I3 are the body's."""
        return fits(self.draft.shape, self._present)

    @property
    def _present(self) -> Top:
        """The Explorer's top."""
        return Top(self._explorer.a, self._explorer.I1, self._explorer.I3)

    def _take(self, preset: Preset) -> None:
        self._adopt(preset.shape, top=preset.top)

    def _try(self, name: str, make: Callable[[], Shape], motion: Motion | None = None) -> None:
        try:
            shape = make()
            shape.top  # noqa: B018  (a body may be sound and still stand on no peg)
        except TopError as error:
            self._refuse(name, error)
        else:
            self._adopt(shape, motion or self._keep)

    def _refuse(self, name: str, error: TopError) -> None:
        self._publish(replace(self.draft, messages=MappingProxyType({name: sentence(error)})))

    def _adopt(self, shape: Shape, motion: Motion | None = None, top: Top | None = None) -> None:
        top = top or shape.top
        self._publish(_draft(shape, top))
        K_J, K_R = motion(shape) if motion else thrown(shape, top)
        self._request(shape=shape, a=top.a, I1=top.I1, I3=top.I3, K_J=K_J, K_R=K_R)

    def _publish(self, draft: Draft) -> None:
        with param.edit_constant(self):
            self.draft = draft

    def _keep(self, shape: Shape) -> tuple[float, float]:
        """K_J and K_R of the same spin in rad/s near theta = 0, and the same share of P, as the Explorer has now."""
        explorer = self._explorer
        if explorer.scene.top == shape.top and explorer.scene.scales == shape.scales:
            return explorer.K_J, explorer.K_R
        before = explorer.scene.top
        slower = shape.scales.time / explorer.scene.scales.time
        K_R = explorer.K_R * slower * (f3_squared(0.0, shape.top) / f3_squared(0.0, before)) ** 0.5
        pole = pole_constants(before, explorer.K_R)[0]
        share = explorer.K_J / pole if pole else 0.0
        return float(share * pole_constants(shape.top, K_R)[0]), float(K_R)


def thrown(shape: Shape, top: Top | None = None) -> tuple[float, float]:
    """(K_J, K_R) of the throw that a new body is given."""
    spin, top = THROWN_SPIN * shape.scales.time, top or shape.top
    if top.a < 0:
        constants = Constants.from_state(top, THROWN_TILT, 0.0, 0.0, spin)
        return float(constants.K_J), float(constants.K_R)
    K_R = spin * f3_squared(0.0, top) ** 0.5
    return float(THROWN_SHARE * pole_constants(top, K_R)[0]), float(K_R)


def _draft(shape: Shape, top: Top) -> Draft:
    known = [preset for preset in PRESETS if preset.shape == shape]
    if not known:
        return Draft(shape=shape)
    known = next((preset for preset in known if preset.top == top), known[-1])
    return Draft(shape=shape, name=known.name, source=listed("workshop.presets")[known.name]["source"])


def sentence(error: TopError) -> str:
    """A TopError in the units of the sliders: what is in m becomes mm, what is in kg becomes g."""
    unit = {"m": "mm", "kg": "g"}.get(error.numbers.get("unit", ""))
    if unit is None or not isinstance(error.value, float):
        return told(error)
    numbers = {name: _thousandfold(error.numbers[name]) for name in ("range", "most") if name in error.numbers}
    value = float(f"{1e3 * error.value:.6g}")
    return told(error.replaced(error.name, value, unit=unit, **numbers), unit=unit)


def _thousandfold(number: Value) -> Value:
    """A number, or all those in a formula such as 0 < R <= 0.5, a thousand times as large."""
    if not isinstance(number, str):
        return 1e3 * number
    return re.sub(r"(?<![\w./[])-?\d+(\.\d+)?(e[+-]?\d+)?(?![\w.])", lambda x: f"{1e3 * float(x[0]):g}", number)


@dataclass(frozen=True, kw_only=True)
class Rocking:
    """What a stopwatch, a balance and a caliper say: SI, each with its standard uncertainty."""

    T: float
    dT: float
    D: float
    dD: float
    M: float

    def a(self, shape: Shape) -> Measured:
        """a/R with its uncertainty, a tippe_core.Measured, for the I1 (in MR^2) of the shape."""
        try:
            return a_from_rocking(T=self.T, R=self.D / 2, I1=shape.top.I1, dT=self.dT, dR=self.dD / 2)
        except TopError as error:
            # what was measured is the diameter
            if error.name == "R":
                raise TopError(
                    say("workshop.own.diameter"), self.D, "{range} ({unit})", range="2e-09 <= D <= 2e+09", unit="m"
                ) from None
            if error.name == "dR":
                raise TopError(
                    say("workshop.own.diameter_uncertainty"),
                    self.dD,
                    "{range} ({unit})",
                    range="0 <= dD <= 2e+09",
                    unit="m",
                ) from None
            raise


def value_of(shape: Shape, name: str) -> Value:
    """The dimension of that name, in SI; "point 2" and "density 2" are those of a Lathe's row 2."""
    field, index = _field(name)
    if name == "M":
        return shape.mass
    return getattr(shape, field) if index is None else getattr(shape, field)[index]


def changed(shape: Shape, name: str, value: Value) -> Shape:
    """The shape with another value of that dimension; a mass where densities are given, or the other way round, keeps
    the form."""
    field, index = _field(name)
    given = {one.name: getattr(shape, one.name) for one in fields(shape)}
    if name == "M" and "M" not in given:
        return shape.with_mass(value)
    if name == "density" and isinstance(shape, OneMaterial):
        return type(shape).from_density(value, **{key: size for key, size in given.items() if key != "M"})
    if index is not None:
        rows = list(getattr(shape, field))
        rows[index] = value
        given[field] = tuple(rows)
    else:
        given[field] = value
    return replace(shape, **{field: given[field]})


def _field(name: str) -> tuple[str, int | None]:
    """The field of a shape that a dimension is in, and its row there or None."""
    field, _, index = name.partition(" ")
    return {"point": "points"}.get(field, field), int(index) if index else None


def handles(shape: Shape) -> dict[str, tuple[float, float]]:
    """Where the section can be taken hold of: {dimension: (x, z)}, m, x across axis 3 and z above O along it."""
    R = shape.R
    side = (R * np.sqrt(0.5), -R * np.sqrt(0.5))
    if isinstance(shape, TruncatedSphere):
        cut = np.sqrt((R - shape.c) * (R + shape.c))
        at = {"R": side, "c": (-cut, shape.c)}
        return at | {"r": (shape.r, shape.c + shape.l / 2), "l": (0.0, shape.c + shape.l)} if shape.l else at
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


def pulled(shape: Shape, name: str, x: float, z: float) -> float | tuple[float, float]:
    """The dimension (SI, to 0.01 mm) at which its handle is nearest to (x, z)."""
    if name.startswith("point ") and isinstance(shape, Lathe):
        # no further than its neighbours: the heights of a profile rise
        points, index = shape.points, int(name[6:])
        low = points[index - 1][1] if index else -shape.R
        high = points[index + 1][1] if index + 1 < len(points) else LARGEST
        return (max(0.0, round(float(x), 5)), min(max(round(float(z), 5), low), high))
    if name == "R" and isinstance(shape, Lathe):
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
