"""The dimensions of a body in its section: the two points between which each is measured."""

import math
from typing import NamedTuple, TypeAlias

from app.model.build.dimensions import on_rounding
from tippe_core import BareSphere, Lathe, LoadedSphere, OrdinaryTop, Shape, StemmedSphere, TruncatedSphere, Turned
from tippe_core.bodies import across

Point: TypeAlias = tuple[float, float]


class Measure(NamedTuple):
    """A dimension by name, measured between two points of the section, (x, z) in m. Both points of a height are on the
    body; its dimension line is beside them."""

    name: str
    start: Point
    end: Point

    @property
    def is_height(self) -> bool:
        """Whether it is measured along axis 3, beside the body."""
        return self.name in HEIGHTS

    @property
    def is_left(self) -> bool:
        """For a height: whether it is to the left of the body."""
        return self.name in LEFT

    @property
    def is_outside(self) -> bool:
        """Whether its number is beyond its end, outside the body."""
        return self.name in OUTSIDE or self.start[1] == self.end[1]

    @property
    def is_shown(self) -> bool:
        """Whether it is also drawn when it is not being dragged."""
        return self.name not in WHILE_HELD


HEIGHTS = ("a", "c", "d", "h", "l", "t", "depth", "thickness", "height")
LEFT = ("depth",)
OUTSIDE = ("rounding",)
WHILE_HELD = ("hole", "thickness", "height")  # otherwise there is no room for them


def measures(shape: Shape) -> list[Measure]:
    """The Measures of a body that can be drawn, from below."""
    R, low = shape.R, -shape.R * math.sqrt(0.5)
    found = [] if isinstance(shape, Lathe | Turned) else [Measure("R", (0.0, 0.0), (low, low))]
    if isinstance(shape, TruncatedSphere):
        rim = across(R, shape.c)
        found.append(Measure("c", (0.0, 0.0), (rim, shape.c)))
        if shape.l:
            found += _stem(shape.r, shape.c, shape.l, rim)
        if shape.rounding:
            b = shape.rounding
            found.append(Measure("rounding", (b - shape.r, shape.c + shape.l - b), on_rounding(shape)))
        found += _inside(shape)
    elif isinstance(shape, LoadedSphere):
        core = (0.0, -shape.d)
        found += [Measure("d", (0.0, 0.0), core), Measure("b", core, (shape.b, -shape.d))]
    elif isinstance(shape, OrdinaryTop):
        face = shape.h + shape.t
        found += [Measure("h", (0.0, 0.0), (shape.r1, shape.h)), Measure("t", (shape.r1, shape.h), (shape.r2, face)),
                  Measure("r1", (0.0, shape.h), (-shape.r1, shape.h)),
                  Measure("r2", (0.0, face), (-shape.r2, face))]  # fmt: skip
        if shape.l:
            found += _stem(shape.r, face, shape.l, shape.r2)
    elif isinstance(shape, BareSphere):
        found.append(Measure("a", (0.0, 0.0), (0.0, -shape.a * R)))
        if isinstance(shape, StemmedSphere):
            end = (0.0, shape.h)
            found += [Measure("h", (0.0, 0.0), end), Measure("r", end, (end[0] - shape.r, end[1]))]
    return found


def _stem(r: float, foot: float, length: float, rim: float) -> list[Measure]:
    """Those of a stem that begins at the height foot, on a face of this radius."""
    return [Measure("l", (rim, foot), (r, foot + length)),
            Measure("r", (0.0, foot + length / 2), (-r, foot + length / 2))]  # fmt: skip


def _inside(shape: TruncatedSphere) -> list[Measure]:
    """Those of a hole and of a disc."""
    found = []
    if shape.hole:
        found.append(Measure("hole", (0.0, shape.floor), (shape.hole, shape.floor)))
        found.append(Measure("depth", (-shape.hole, shape.c), (-shape.hole, shape.floor)))
    if shape.disc:
        low = shape.height - shape.R
        high, middle = low + shape.thickness, low + shape.thickness / 2
        found += [Measure("disc", (0.0, middle), (-shape.disc, middle)),
                  Measure("thickness", (shape.disc, low), (shape.disc, high)),
                  Measure("height", (0.0, -shape.R), (shape.disc, low))]  # fmt: skip
    return found
