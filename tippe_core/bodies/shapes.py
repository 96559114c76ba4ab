"""The kinds of bodies: the tippe top of Fig. 7, the loaded sphere of Fig. 2, ordinary tops, arbitrary outlines."""

from dataclasses import dataclass, replace
from functools import cached_property
from math import acos, atan2, hypot
from typing import Self

import numpy as np

from ..errors import TopError, finite
from ..types import Number, Rim
from .bare import BareSphere, StemmedSphere
from .inside import STEEL, across, check_disc, check_hole, volume_of_disc
from .ranges import LONG, MOST_POINTS, SMALLEST, THINNEST, check_stem, in_range, rows_of
from .shape import OneMaterial, Shape, Turned, check_one_piece
from .slices import DENSEST, LARGEST
from .solids import Solid, ball, cylinder, frustum, zone

FACETS = 16  # frustums that stand for a rounded edge


@dataclass(frozen=True, kw_only=True)
class TruncatedSphere(OneMaterial):
    """Fig. 7: a sphere, cut off by a plane, with a cylinder on the cut, the stem. All lengths in m.

    Parameters
    ----------
    R, c : float
        radius of the sphere, and height of the cut; c = R: the whole sphere
    l, r : float
        length and radius of the stem; l = r = 0: no stem
    M : float
        mass of all of it, kg; density is that of the wood
    rounding : float
        radius of the edge of the stem's end, from 0 (sharp) to r (half a ball). For the mass it is replaced by 16
        facets, which remove half a percent more material than the rounding; for contact it is exactly round
    hole, depth : float
        radius and depth below the cut of a hole around the stem, which stands on its floor; 0: none
    disc, thickness, height : float
        of a steel disc (7850 kg/m^3) in the wood, with its lower face at the height above the contact point; 0:
        none

    Raises
    ------
    TopError
        for anything else, with the name, the value and the allowed range
    """

    R: float
    c: float
    l: float
    r: float
    M: float
    rounding: float = 0.0
    hole: float = 0.0
    depth: float = 0.0
    disc: float = 0.0
    thickness: float = 0.0
    height: float = 0.0

    @classmethod
    def paper(cls) -> Self:
        """Appendix A: R = 1.6 cm, c = 0.82 cm, l = 1.92 cm, r = 0.32 cm, M = 11.5 g."""
        return cls(R=0.016, c=0.0082, l=0.0192, r=0.0032, M=0.0115)

    @classmethod
    def from_density(cls, density: float, **dimensions: float) -> Self:
        """The shape whose wood has this density, instead of a mass.

        Parameters
        ----------
        density : float
            of the wood, kg/m^3
        **dimensions : float
            all but M, as for the shape itself, m

        Returns
        -------
        TruncatedSphere
            with the mass that follows

        Raises
        ------
        TopError
            as the shape itself
        """
        let_in = {name: dimensions.pop(name, 0.0) for name in ("disc", "thickness", "height")}
        whole = super().from_density(density, **dimensions)
        if not any(let_in.values()):
            return whole
        disc, thickness = (finite(name, let_in[name]) for name in ("disc", "thickness"))
        return replace(whole, M=whole.M + (STEEL - whole.density) * volume_of_disc(disc, thickness), **let_in)

    def _check(self) -> None:
        in_range("c", self.c, -self.R, self.R, "m", above=True, code="cut-misses",
                 why="the cut goes through the sphere")  # fmt: skip
        in_range("r", self.r, 0, across(self.R, self.c), "m", code="stem-too-wide",
                 why="the radius of the face it stands on", remedy="Make it thinner, or the face wider.")  # fmt: skip
        in_range("l", self.l, 0, LONG, "m")
        check_stem(self.r, self.l)
        in_range("rounding", self.rounding, SMALLEST if self.rounding > 0 else 0, min(self.r, self.l), "m")
        check_hole(self.R, self.c, self.r, self.hole, self.depth)
        check_disc(self.R, self.floor, self.M, self.disc, self.thickness, self.height)

    @property
    def floor(self) -> float:
        """The height above O on which the stem stands, m: of the cut, or of the hole's floor."""
        return self.c - self.depth

    @property
    def _place_of_disc(self) -> Solid:
        return cylinder(self.disc, self.height - self.R, self.height - self.R + self.thickness)

    @cached_property
    def inlay(self) -> Solid:
        """The steel disc, if there is one."""
        return STEEL * self._place_of_disc if self.disc else Solid(())

    @cached_property
    def form(self) -> Solid:
        """The wood, with the density 1 kg/m^3."""
        form, top, b = zone(self.R, -self.R, self.c), self.c + self.l, self.rounding
        if self.hole:
            form -= cylinder(self.hole, self.floor, self.c)
        if self.disc:
            form -= self._place_of_disc
        if self.l and top - b > self.floor:
            form += cylinder(self.r, self.floor, top - b)
        if not b:
            return form
        angle = np.linspace(0, np.pi / 2, FACETS + 1)
        radii, heights = (self.r - b + b * np.cos(angle)).tolist(), (top - b + b * np.sin(angle)).tolist()
        radii[-1] = self.r - b
        for r_low, r_high, low, high in zip(radii, radii[1:], heights, heights[1:], strict=False):
            form += frustum(r_low, r_high, low, high)
        return form

    @cached_property
    def _touch(self) -> tuple[float | None, Rim | None]:
        angle, edge = super()._touch
        b = self.rounding / self.R
        q, h = self.r / self.R - b, (self.c + self.l) / self.R - b
        D = hypot(q, h)
        if not b or D <= 1 - b:
            return angle, edge
        rounded = atan2(q, -h) - acos((1 - b) / D)
        return (rounded, (q, h, b)) if angle is None or rounded <= angle else (angle, edge)


@dataclass(frozen=True, kw_only=True)
class Ball(OneMaterial):
    """A uniform ball.

    Parameters
    ----------
    R : float
        radius, m
    M : float
        mass, kg

    Raises
    ------
    TopError
        for anything else, with the name, the value and the allowed range
    """

    R: float
    M: float

    @cached_property
    def form(self) -> Solid:
        """The ball, with the density 1 kg/m^3."""
        return ball(self.R)


@dataclass(frozen=True, kw_only=True)
class LoadedSphere(Shape):
    """Fig. 2: a ball that contains a ball of another density.

    Parameters
    ----------
    R, b : float
        their radii, m
    d : float
        distance of the inner ball below O, m; d < 0 is above O, where a cavity makes a tippe top
    density, core_density : float
        kg/m^3; core_density = 0 is a cavity

    Raises
    ------
    TopError
        for anything else, with the name, the value and the allowed range
    """

    R: float
    b: float
    d: float
    density: float
    core_density: float

    _weights = ("density", "core_density")

    def _check(self) -> None:
        in_range("b", self.b, SMALLEST, self.R, "m", below=True, code="core-sticks-out", why="or the core sticks out")
        room = self.R - self.b
        in_range("d", self.d, -room, room, "m", above=True, below=True, code="core-sticks-out",
                 why="or the core sticks out")  # fmt: skip
        in_range("density", self.density, THINNEST, DENSEST, "kg/m^3")
        in_range("core_density", self.core_density, 0, DENSEST, "kg/m^3")

    @cached_property
    def solid(self) -> Solid:
        """The sphere with its core."""
        sphere = self.density * ball(self.R)
        if self.core_density == self.density:
            return sphere
        return sphere + (self.core_density - self.density) * ball(self.b, -self.d)


@dataclass(frozen=True, kw_only=True)
class OrdinaryTop(OneMaterial):
    """A top with G above O: a peg, a disc or cone on it, and a stem.

    Parameters
    ----------
    R, h : float
        the peg: a rod of radius R with a hemispherical end about O and the length h above O, m
    r1, r2, t : float
        the body on it: radius at its lower and its upper face (r1 = r2 is a disc), and thickness, m
    r, l : float
        radius and length of the stem, m; r = l = 0: none
    M : float
        mass, kg

    Raises
    ------
    TopError
        for anything else, with the name, the value and the allowed range
    """

    R: float
    h: float
    r1: float
    r2: float
    t: float
    r: float
    l: float
    M: float

    def _check(self) -> None:
        in_range("h", self.h, 0, LONG, "m")
        in_range(
            "r1", self.r1, 0, LARGEST, "m", above=True, code="hangs-on-a-point", why="or the body hangs on a point"
        )
        in_range("r2", self.r2, 0, LARGEST, "m")
        in_range("t", self.t, SMALLEST, LONG, "m")
        in_range("r", self.r, 0, self.r2, "m", code="stem-too-wide", why="the radius of the face it stands on",
                 remedy="Make it thinner, or the face wider.")  # fmt: skip
        in_range("l", self.l, 0, LONG, "m")
        check_stem(self.r, self.l)

    @cached_property
    def form(self) -> Solid:
        """The body, with the density 1 kg/m^3."""
        face = self.h + self.t
        form = zone(self.R, -self.R, 0) + frustum(self.r1, self.r2, self.h, face)
        if self.h:
            form += cylinder(self.R, 0, self.h)
        return form + cylinder(self.r, face, face + self.l) if self.l else form


@dataclass(frozen=True, kw_only=True)
class Lathe(Shape):
    """An arbitrary outline on a round peg.

    The sphere of radius R about O ends at the height of the first point. Frustums join the points; a step in the radius
    is given by two points at the same height.

    Parameters
    ----------
    R : float
        radius of the peg, m
    points : rows (k, 2)
        radius and height above O, m, from the peg upwards
    density : float or sequence
        kg/m^3: one number, or one for each point: the first for the peg up to points[0], each of the others for the
        piece below its point (ignored at a step)

    Raises
    ------
    TopError
        for anything else, with the name, the value and the allowed range
    """

    R: float
    points: tuple[tuple[float, float], ...]
    density: tuple[float, ...] | float

    def _check(self) -> None:
        points = rows_of("points", self.points, 2, MOST_POINTS)
        last = -self.R
        for index, (radius, height) in enumerate(points):
            in_range(f"points[{index}] radius", radius, 0, LARGEST, "m")
            in_range(
                f"points[{index}] height", height, last, self.R if index == 0 else LARGEST, "m", above=index == 0,
                code="falling", remedy="Each is at least as high as the one before.")  # fmt: skip
            last = height
        object.__setattr__(self, "points", points)
        given: Number = self.density  # or another sequence
        if np.ndim(given) == 0:
            density = in_range("density", given, THINNEST, DENSEST, "kg/m^3")
        else:
            if len(given) != len(points):
                raise TopError("density", given, "one number, or as many as points ({count})", code="wrong-count",
                               count=len(points))  # fmt: skip
            density = tuple(in_range(f"density[{index}]", value, THINNEST, DENSEST, "kg/m^3")
                            for index, value in enumerate(given))  # fmt: skip
        object.__setattr__(self, "density", density)
        check_one_piece("points", self.solid)

    @cached_property
    def solid(self) -> Solid:
        """The body, each part with its density."""
        densities = self.density if isinstance(self.density, tuple) else [self.density] * len(self.points)
        solid = densities[0] * zone(self.R, -self.R, self.points[0][1])
        for (r_low, low), (r_high, high), density in zip(self.points, self.points[1:], densities[1:], strict=False):
            if high > low and (r_low or r_high):
                solid += density * frustum(r_low, r_high, low, high)
        return solid


KINDS: dict[str, type[Shape]]
KINDS = {kind.__name__: kind for kind in (TruncatedSphere, LoadedSphere, OrdinaryTop, Lathe, Turned, Ball, BareSphere,
                                          StemmedSphere)}  # fmt: skip
