"""The top builder without its widgets: from dimensions, presets and files to a shape and the motion that it is given.

In SI, as in tippe_core.bodies; dimensions that are shown or set are in the unit of their Dimension.
"""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from itertools import pairwise
from types import MappingProxyType
from typing import TypeAlias

import numpy as np
import param

from app.model.build.dimensions import FAMILIES, INSIDES, MASS, Dimension, Value, changed, density_dimension, sentence
from app.model.build.inside import filled, inside
from app.model.scene import Scene
from app.model.setup import TOYS
from app.text import listed, say
from tippe_core import (
    PRESETS,
    BareSphere,
    Constants,
    Lathe,
    Measured,
    Preset,
    Scales,
    Shape,
    Solid,
    Top,
    TopError,
    TruncatedSphere,
    Turned,
    a_from_rocking,
    ball,
    cylinder,
    f3_squared,
    frustum,
    load_top,
    pole_constants,
    rocking_period,
    save_top,
)

# The start of a new body: the spin near theta = 0 that the paper's top has at K_R = 10; for a tippe top also K_J at the
# share of P that it has at K_J = 7. An ordinary top is released at a tilt, or it would not stay up.
THROWN_SHARE = 7 / pole_constants(Top.paper(), 10.0)[0]
THROWN_SPIN = 10.0 / f3_squared(0.0, Top.paper()) ** 0.5 * Scales.paper().angular_velocity  # rad/s
THROWN_TILT = 0.3

LARGEST_FILE = 64 * 1024  # bytes of a saved top
Motion: TypeAlias = Callable[[Shape], tuple[float, float]]  # K_J and K_R
Edit: TypeAlias = Callable[[tuple[Value, ...], Callable[[tuple[Value, ...], int], Value]], tuple[Value, ...]]


@dataclass(frozen=True, kw_only=True)
class Draft:
    """The body that is being built, with everything that its views show.

    messages: a sentence for each field (also "file" and "stl") whose value was refused; the shape is then the last
    valid one. about: the quantity that they say cannot be. name and source: those of the preset, else empty; the name
    is tippe_core's.
    """

    shape: Shape
    messages: MappingProxyType[str, str] = field(default_factory=lambda: MappingProxyType({}))
    about: str = ""
    name: str = ""
    source: str = ""

    @property
    def family(self) -> str:
        """The kind of body, a key in build.toml."""
        return FAMILIES[type(self.shape)][0]

    @property
    def dimensions(self) -> tuple[Dimension, ...]:
        """The Dimensions that can be set."""
        dimensions = FAMILIES[type(self.shape)][1] + INSIDES[inside(self.shape)]
        if isinstance(self.shape, Lathe) and isinstance(self.shape.density, tuple):
            heights = pairwise(height for _, height in self.shape.points)  # a step in the radius is not a piece
            pieces = [density_dimension(f"density {index}", "piece_density", low=1e3 * low, high=1e3 * high)
                      for index, (low, high) in enumerate(heights, 1) if high > low]  # fmt: skip
            return (dimensions[0], density_dimension("density 0", "peg_density"), *pieces, MASS)
        return dimensions


class Builder(param.Parameterized):
    """Requests other bodies. The present body, `draft`, is that of the last scene, with what has been refused since;
    each change is one event.

    ask: called with inputs of the Explorer; follow() is to be called with each of its scenes.
    """

    # __init__ makes the first one
    draft: param.ClassSelector[Draft] = param.ClassSelector(  # type: ignore[assignment]
        class_=Draft, constant=True, doc="the present body"
    )

    def __init__(self, scene: Scene, ask: Callable[..., object]) -> None:
        super().__init__()  # type: ignore[no-untyped-call]  # of param
        self._ask, self._scene = ask, scene
        self._coming: Shape | None = None  # requested, but not in a scene yet: the next edit starts from it
        self._top = scene.top
        self._publish(_draft(scene.inputs["shape"], scene.top))

    def follow(self, scene: Scene) -> None:
        """Takes over the body of this scene, whoever requested it."""
        self._scene, self._coming, shape = scene, None, scene.inputs["shape"]
        if (shape, scene.top) != (self.draft.shape, self._top):
            now = _draft(shape, scene.top)
            if (now.shape, now.name) != (self.draft.shape, self.draft.name):
                self._publish(now)
            self._top = scene.top

    def set(self, name: str, value: float | tuple[float, float]) -> None:
        """Sets one dimension, in SI; "point 2" and "density 2" belong to row 2 of a Lathe."""
        self._try(name, lambda: changed(self._body, name, value))

    @property
    def _lathe(self) -> Lathe:
        """The body, if it is a Lathe."""
        assert isinstance(self._body, Lathe)
        return self._body

    def add_point(self, x: float = 0.0, z: float | None = None) -> None:
        """Adds a point to a Lathe's profile: at radius |x| and height z, or in the middle of its longest piece."""
        points = self._lathe.points
        if z is None:
            rows = np.array(points)
            index = int(np.hypot(*np.diff(rows, axis=0).T).argmax()) + 1 if len(rows) > 1 else 1
            x, z = rows[index - 1 : index + 1].mean(axis=0) if len(rows) > 1 else rows[0] + [0, self._body.R]
        else:
            index = sum(height <= z for _, height in points)
        self._rows("points", lambda rows, fill: (*rows[:index], fill(rows, index), *rows[index:]), (abs(x), z))

    def remove_point(self, index: int) -> None:
        """Removes a point."""
        self._rows("points", lambda rows, fill: (*rows[:index], *rows[index + 1 :]), ())

    def _rows(self, name: str, edit: Edit, point: tuple[float, ...]) -> None:
        """Applies the same edit to the points of a Lathe and to its densities, if it has one for each point."""
        shape = self._lathe
        rows: dict[str, Value] = {
            "points": edit(shape.points, lambda rows, index: tuple(round(float(x), 5) for x in point))
        }
        if isinstance(shape.density, tuple):
            rows["density"] = edit(shape.density, lambda rows, index: rows[min(index, len(rows) - 1)])
        self._try(name, lambda: replace(shape, **rows))

    def part_densities(self) -> None:
        """Switches a Lathe between one density and one for each piece."""
        shape = self._lathe
        density = shape.density[0] if isinstance(shape.density, tuple) else (shape.density,) * len(shape.points)
        self._try("density", lambda: replace(shape, density=density))

    def compose(self, kind: str, density: float, r: float, low: float, high: float) -> None:
        """Adds a piece to the body, or removes it if the density (kg/m^3) is negative: a "cylinder" or "cone" (apex
        upwards) from the height low to high (m), or a "ball" of radius r about (low + high)/2."""

        def made() -> Shape:
            form = {"cylinder": lambda: cylinder(r, low, high), "cone": lambda: frustum(r, 0.0, low, high),
                    "ball": lambda: ball(r, (low + high) / 2)}[kind]()  # fmt: skip
            return self._body + density * form

        self._try("piece", made)

    def take_off(self) -> None:
        """Undoes the last compose() of a Turned body."""
        shape = self._body
        self._try("piece", lambda: Turned(R=shape.R, solid=Solid(shape.solid.slices[:-1])))

    def choose(self, name: str) -> None:
        """Takes the preset with this name, with a new start."""
        self._take(TOYS[name])

    def choose_family(self, family: str) -> None:
        """Takes the first preset of a family, with a new start."""
        self._take(next(preset for preset in PRESETS if FAMILIES[type(preset.shape)][0] == family))

    def fill(self, kind: str) -> None:
        """Sets what a truncated sphere has inside, one of app.model.build.inside.KINDS, in the same wood."""
        shape = self._body
        if isinstance(shape, TruncatedSphere):
            self._try("inside", lambda: filled(shape, kind))

    def load(self, text: str | bytes) -> None:
        """Takes the body in a file that save() wrote, with a new start."""
        self._try("file", lambda: load_top(text), thrown)

    def refuse_file(self, largest: int) -> None:
        """Says that a file was larger than this many bytes."""
        self._refuse("file", TopError(
            "file", "too large", "at most {most} bytes", "A saved top is far smaller.", code="file-too-large",
            most=largest))  # fmt: skip

    def save(self) -> str:
        """The body as the text of a small JSON file."""
        return save_top(self.draft.shape)

    def stl(self) -> bytes | None:
        """The body as the bytes of an STL file, in mm; None, and a sentence at "stl", if that is impossible."""
        try:
            return self.draft.shape.stl()
        except TopError as error:
            self._refuse("stl", error)
            return None

    def measured(self, *, M: float, R: float, a: float) -> None:
        """Takes a sphere with the measured M, R and a/R, and with the moments of inertia, in MR^2, of the present
        body."""
        own = self._body.top
        self._try("measured", lambda: BareSphere(R=R, M=M, a=a, I1=own.I1, I3=own.I3))

    def attach(self) -> None:
        """Sets the Explorer back to the body's own a, I1 and I3."""
        self._adopt(self._body, self._keep)

    @property
    def _body(self) -> Shape:
        """The body from which an edit starts."""
        return self._coming or self.draft.shape

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
        self._publish(replace(self.draft, messages=MappingProxyType({name: sentence(error)}), about=error.name))

    def _adopt(self, shape: Shape, motion: Motion | None = None, top: Top | None = None) -> None:
        top = top or shape.top
        self._coming, constants = shape, {}
        if self._scene.inputs.get("given") != "hand":  # which releases any body in the same way
            constants = dict(zip(("K_J", "K_R"), motion(shape) if motion else thrown(shape, top), strict=True))
        self._ask(shape=shape, a=top.a, I1=top.I1, I3=top.I3, **constants)
        if self.draft.messages:
            self._publish(replace(self.draft, messages=MappingProxyType({})))

    def _publish(self, draft: Draft) -> None:
        with param.edit_constant(self):
            self.draft = draft

    def _keep(self, shape: Shape) -> tuple[float, float]:
        """K_J and K_R for the same spin in rad/s near theta = 0 and the same share of P as in the present scene."""
        scene = self._scene
        K_J, K_R = scene.inputs["K_J"], scene.inputs["K_R"]
        if scene.top == shape.top and scene.scales == shape.scales:
            return K_J, K_R
        slower = shape.scales.time / scene.scales.time
        spun = K_R * slower * (f3_squared(0.0, shape.top) / f3_squared(0.0, scene.top)) ** 0.5
        pole = pole_constants(scene.top, K_R)[0]
        share = K_J / pole if pole else 0.0
        return float(share * pole_constants(shape.top, spun)[0]), float(spun)


def thrown(shape: Shape, top: Top | None = None) -> tuple[float, float]:
    """(K_J, K_R) of the start of a new body."""
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
    return Draft(shape=shape, name=known.name, source=listed("build.presets")[known.name]["source"])


@dataclass(frozen=True, kw_only=True)
class Rocking:
    """Measurements with a stopwatch, a balance and a caliper, in SI, each with its standard uncertainty."""

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
            if error.name not in ("R", "dR"):
                raise
            word, value, limits = {
                "R": ("diameter", self.D, "2e-09 <= D <= 2e+09"),
                "dR": ("diameter_uncertainty", self.dD, "0 <= dD <= 2e+09"),
            }[error.name]  # the diameter was measured
            raise TopError(say(f"build.own.{word}"), value, "{range} ({unit})", range=limits, unit="m") from None


def rocks_once(shape: Shape) -> float:
    """The period, in s, of small rocking of a body with G below O, without spin and without slipping."""
    return rocking_period(shape.top) * shape.scales.time
