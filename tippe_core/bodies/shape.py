"""Tops given by their dimensions in SI units: mass properties, outline, Top and Scales. Fig. 7 and others.

Heights are measured along axis 3 (upwards when theta = 0) from O, the centre of the sphere that rolls, so the contact
point is at -R, and G of a tippe top is below 0. Every shape is a frozen record of its dimensions, keyword-only, and has

    .solid .mass .com .moments .volume      kg, m (height of G above O, -a), (I1, I3) in kg m^2, m^3
    .top .scales                            Top(a, I1, I3) and Scales(R, M): what the paper's equations need
    .profile(n) .touch_angle .edge .stl()   for drawing, for the limits of the round peg, for printing

An impossible body raises a TopError that names the dimension.
"""

from dataclasses import dataclass, fields, replace
from functools import cached_property
from math import acos, atan2, hypot, inf, pi
from typing import TYPE_CHECKING, ClassVar, Self

from ..errors import TopError, finite
from ..paper.top import Scales, Top
from ..types import Array, Number, Rim
from .ranges import LONG, MOST_PIECES, SMALLEST, THINNEST, in_range, weight
from .slices import DENSEST
from .solids import Solid


@dataclass(frozen=True, kw_only=True)
class Shape:
    """The properties that all shapes have.

    Parameters
    ----------
    R : float
        radius of the sphere that rolls, m: of the body, or of its peg

    Raises
    ------
    TopError
        for anything else, with the name, the value and the allowed range
    """

    R: float

    _weights: ClassVar[tuple[str, ...]] = ("density",)  # the fields to which the mass is proportional

    if TYPE_CHECKING:  # it is a field of Turned; a property here would be in its way

        @property
        def solid(self) -> Solid: ...

    def __post_init__(self) -> None:
        for field in fields(self):
            if field.type in (float, "float"):
                object.__setattr__(self, field.name, finite(field.name, getattr(self, field.name)))
        in_range("R", self.R, SMALLEST, LONG, "m")
        self._check()

    def _check(self) -> None:
        """Raises TopError if the dimensions do not make a body."""

    @property
    def mass(self) -> float:
        """Mass M, kg."""
        return self.solid.mass

    @property
    def com(self) -> float:
        """Height of G above O, m: -a in SI."""
        return self.solid.com

    @property
    def moments(self) -> tuple[float, float]:
        """(I1, I3) at G, kg m^2."""
        return self.solid.I1, self.solid.I3

    @property
    def volume(self) -> float:
        """Volume of the material, m^3."""
        return self.solid.volume

    @property
    def scales(self) -> Scales:
        """Scales(R, M) with g = 9.81 m/s^2."""
        return Scales(self.R, self.mass)

    @property
    def top(self) -> Top:
        """The body as a Top: a/R, I1/(M R^2), I3/(M R^2)."""
        unit = self.mass * self.R**2
        I1, I3 = self.moments
        return Top(a=0.0 - self.com / self.R, I1=I1 / unit, I3=I3 / unit)

    def profile(self, n: int = 200) -> Array:
        """The outline from the contact point (0, -R) to the body's top.

        Parameters
        ----------
        n : int
            number of points; the corners are exact

        Returns
        -------
        array (n, 2)
            radius and height above O, m

        Raises
        ------
        TopError
            if n is less than the number of corners
        """
        return self.solid.profile(n)

    def stl(self, sides: int = 128) -> bytes:
        """The body as a solid for a printer; see Solid.stl.

        Parameters
        ----------
        sides : int
            flat faces around the axis

        Returns
        -------
        bytes
            a binary STL file, in mm

        Raises
        ------
        TopError
            if the inside is not known, or for another number of sides than is possible
        """
        return self.solid.stl(sides)

    @cached_property
    def touch_angle(self) -> float | None:
        """The smallest theta (rad) at which something other than the sphere of radius R touches the table; None if that
        never happens.

        At theta the plane of the table is rho sin(theta) - z cos(theta) = R. A point at the distance D from O, at the
        angle beta from the lower end of axis 3, reaches it when D cos(theta - beta) = R; the end of the sphere's
        surface is such a point with D = R. A round part of radius b with its centre at the height e reaches it when R +
        e cos(theta) = b.
        """
        return self._touch[0]

    @property
    def edge(self) -> Rim | None:
        """The part that touches there, usually the edge of the stem's end: (radius, height above O, rounding) in R, or
        None.

        It is a circle about axis 3 (a point if the radius is 0), rounded with the given radius.
        """
        return self._touch[1]

    @cached_property
    def _touch(self) -> tuple[float | None, Rim | None]:
        found = []
        for edge in self.solid.outline[1:]:
            for radius, z in (edge.start, edge.end):
                D, beta = hypot(radius, z), atan2(radius, -z)
                if D >= self.R * (1 - 1e-12):
                    found.append((beta - acos(min(1.0, self.R / D)), (float(radius / self.R), float(z / self.R), 0.0)))
            if (arc := edge.arc) and abs(arc.R - self.R) < abs(arc.centre):
                theta = acos((arc.R - self.R) / arc.centre)
                point = arc.centre - arc.R * (arc.R - self.R) / arc.centre
                if edge.start[1] < point < edge.end[1]:
                    found.append((theta, (0.0, float(arc.centre / self.R), float(arc.R / self.R))))
        angle, edge = min(found, default=(inf, None))
        return (angle, edge) if angle < pi - 1e-9 else (None, None)

    def with_mass(self, M: float) -> Self:
        """The same body with its density, or densities, scaled; what is let into it keeps its own.

        Parameters
        ----------
        M : float
            its mass, kg

        Returns
        -------
        Shape
            of the same kind and dimensions

        Raises
        ------
        TopError
            if M is not positive, or not possible for it
        """
        factor = weight(M) / self.mass
        return replace(self, **{name: _times(factor, getattr(self, name)) for name in self._weights})

    def __add__(self, other: "Solid | Shape") -> "Turned":
        """The body with something added: a Solid with its density in kg/m^3, or another shape."""
        return Turned(R=self.R, solid=self.solid + (other.solid if isinstance(other, Shape) else other))

    def __sub__(self, other: "Solid | Shape") -> "Turned":
        """The body with something removed: `top - top.density * cylinder(r, low, high)` has a hole."""
        return Turned(R=self.R, solid=self.solid - (other.solid if isinstance(other, Shape) else other))


class OneMaterial(Shape):
    """A shape of uniform density, but for what is let into it, given by its mass M (kg)."""

    _weights = ("M",)

    if TYPE_CHECKING:  # each kind has M as a field, in its own position

        @property
        def M(self) -> float: ...
        @property
        def form(self) -> Solid: ...

    def __post_init__(self) -> None:
        super().__post_init__()
        weight(self.M)
        if not 0 < self.density <= DENSEST:
            most = DENSEST * self.form.volume + self.inlay.mass
            raise TopError("M", self.M, "at most {most:g} {unit} for this body ({densest:g} kg/m^3)",
                           code="too-dense", most=most, densest=DENSEST, unit="kg")  # fmt: skip

    @classmethod
    def from_density(cls, density: float, **dimensions: float) -> Self:
        """The shape with this density (kg/m^3) instead of a mass."""
        in_range("density", density, THINNEST, DENSEST, "kg/m^3")
        body = cls(M=1e-3, **dimensions)  # type: ignore[call-arg]  # a field of each kind
        return replace(body, M=density * body.form.mass)  # type: ignore[call-arg]

    @property
    def inlay(self) -> Solid:
        """What is let into it, of another material; `form` has no room there."""
        return Solid(())

    @cached_property
    def solid(self) -> Solid:
        """The body with its density."""
        return self.density * self.form + self.inlay

    @property
    def mass(self) -> float:
        """M, kg."""
        return self.M

    @property
    def density(self) -> float:
        """Density, kg/m^3."""
        return (self.M - self.inlay.mass) / self.form.mass


@dataclass(frozen=True, kw_only=True)
class Turned(Shape):
    """Any Solid on a sphere about O: the result of `shape + solid` and `shape - solid`.

    Parameters
    ----------
    R : float
        radius of the sphere, m
    solid : Solid
        the whole body

    Raises
    ------
    TopError
        for anything else, with the name, the value and the allowed range
    """

    R: float
    solid: Solid

    _weights = ("solid",)

    def _check(self) -> None:
        if not isinstance(self.solid, Solid) or not 1 <= len(self.solid.slices) <= MOST_PIECES:
            raise TopError(
                "solid", self.solid, "a Solid of {count} pieces", code="wrong-count", count=f"1 - {MOST_PIECES}"
            )
        check_one_piece("solid", self.solid)
        peg = self.solid.outline[0]
        near = 1e-9 * self.R
        if not (peg.arc and abs(peg.arc.R - self.R) <= near and abs(peg.arc.centre) <= near and peg.start[0] == 0
                and abs(peg.start[1] + self.R) <= near):  # fmt: skip
            raise TopError("R", self.R, "the radius of the sphere about O at the solid's lowest point",
                           "Put zone(R, -R, ...) at the bottom, whole.", code="no-peg")  # fmt: skip


def check_one_piece(name: str, solid: Solid) -> None:
    if solid.mass <= 0 or solid.pieces != 1:
        raise TopError(name, f"{solid.pieces} bodies", "one body", "Make its parts overlap or touch.",
                       code="several-bodies", pieces=solid.pieces)  # fmt: skip
    starts = [id(edge.start) for outline in solid.outlines for edge in outline]
    through_axis = any(edge.end[0] == 0 for outline in solid.outlines for edge in outline[:-1])
    if through_axis or len(set(starts)) < len(starts):
        raise TopError(name, "a point or circle", "a face where parts meet", "Make them overlap, or leave a gap.",
                       code="meets-in-a-point")  # fmt: skip


def _times(factor: float, weight: Number) -> Number:
    return tuple(factor * value for value in weight) if isinstance(weight, tuple) else factor * weight
