"""Tops as one would draw them: dimensions in SI -> mass properties, outline, Top and Scales. Fig. 7 and others.

O, the centre of the sphere that rolls, is at height 0, and heights are counted along axis 3 (up when theta = 0), so the
contact is at -R and a tippe top's G below 0. Every shape is a frozen record of its dimensions, keyword-only, and gives

    .solid .mass .com .moments .volume      kg, m (height of G above O, -a), (I1, I3) in kg m^2, m^3
    .top .scales                            Top(a, I1, I3) and Scales(R, M): what the paper's equations need
    .profile(n) .touch_angle .edge .stl()   for drawing, for the limits of the round peg, for printing

An impossible body is a TopError that names the dimension.
"""

import json
from collections.abc import Callable, Collection
from dataclasses import dataclass, fields, replace
from functools import cached_property
from math import acos, atan2, hypot, inf, isfinite, pi, sqrt
from typing import TYPE_CHECKING, Any, ClassVar, Self, TypeAlias

import numpy as np
from scipy.optimize import brentq

from .errors import TopError, finite
from .solids import DENSEST, LARGEST, Frustum, Solid, Zone, ball, cylinder, frustum, zone
from .top import Scales, Top
from .types import Array, Number, Rim

SMALLEST = 1e-6  # m: no peg is smaller, and no power of it is lost
LONG = LARGEST / 4  # m: heights that are added stay below LARGEST
LIGHTEST, THINNEST = 1e-30, 1e-9  # kg, kg/m^3: no product of them is lost
MOST_POINTS, MOST_PIECES = 400, 64
SCHEMA, VERSION, LONGEST = "tippe-top-explorer/top", 1, 65_536  # bytes
Json: TypeAlias = Any  # whatever a stranger wrote


@dataclass(frozen=True, kw_only=True)
class Shape:
    """What all shapes share. R (m) is the radius of the sphere that rolls: the body, or its peg."""

    R: float

    _weights: ClassVar[tuple[str, ...]] = ("density",)  # the fields in proportion to which the mass is

    if TYPE_CHECKING:  # it is a field of Turned, which a property here would be in the way of

        @property
        def solid(self) -> Solid: ...

    def __post_init__(self) -> None:
        for field in fields(self):
            if field.type in (float, "float"):
                object.__setattr__(self, field.name, finite(field.name, getattr(self, field.name)))
        _range("R", self.R, SMALLEST, LONG, "m")
        self._check()

    def _check(self) -> None:
        """Raises TopError where the dimensions do not make a body."""

    @property
    def mass(self) -> float:
        """M, kg."""
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
        """Of the material, m^3."""
        return self.solid.volume

    @property
    def scales(self) -> Scales:
        """Scales(R, M) with g = 9.81 m/s^2."""
        return Scales(self.R, self.mass)

    @property
    def top(self) -> Top:
        """The Top this body is: a/R, I1/(M R^2), I3/(M R^2)."""
        unit = self.mass * self.R**2
        I1, I3 = self.moments
        return Top(a=0.0 - self.com / self.R, I1=I1 / unit, I3=I3 / unit)

    def profile(self, n: int = 200) -> Array:
        """Radius and height above O (m) from the contact point at (0, -R) to the body's top, corners exact: (n, 2).

        Raises TopError where n is less than the number of corners.
        """
        return self.solid.profile(n)

    def stl(self, sides: int = 128) -> bytes:
        """The body as a binary STL file (bytes), in mm; see Solid.stl."""
        return self.solid.stl(sides)

    @cached_property
    def touch_angle(self) -> float | None:
        """theta in radians from which not only the sphere of radius R touches the table; None if that never happens.

        At theta the table's plane is rho sin(theta) - z cos(theta) = R. A point at the distance D from O, at the angle
        beta from the lower end of axis 3, comes to it when D cos(theta - beta) = R; the end of the sphere's surface is
        such a point with D = R. A round part of radius b about a centre at height e does when R + e cos(theta) = b.
        """
        return self._touch[0]

    @property
    def edge(self) -> Rim | None:
        """What touches there, the edge of the stem's end as a rule: (radius, height above O, rounding) in R, or None.

        A circle about axis 3, 0 where it is a point, rounded by a ball of that radius along it.
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
        """The same body of a material, or materials, so much denser that it weighs M (kg)."""
        factor = _mass(finite("M", M)) / self.mass
        return replace(self, **{name: _times(factor, getattr(self, name)) for name in self._weights})

    def __add__(self, other: "Solid | Shape") -> "Turned":
        """With something put on: a Solid weighed in kg/m^3, or all of another shape."""
        return Turned(R=self.R, solid=self.solid + (other.solid if isinstance(other, Shape) else other))

    def __sub__(self, other: "Solid | Shape") -> "Turned":
        """With something taken away: `top - top.density * cylinder(r, low, high)` is bored."""
        return Turned(R=self.R, solid=self.solid - (other.solid if isinstance(other, Shape) else other))


class OneMaterial(Shape):
    """A shape of one density throughout, given by its mass M (kg)."""

    _weights = ("M",)

    if TYPE_CHECKING:  # M is a field of each kind, in its own place

        @property
        def M(self) -> float: ...
        @property
        def form(self) -> Solid: ...

    def __post_init__(self) -> None:
        super().__post_init__()
        _mass(self.M)
        if not 0 < self.density <= DENSEST:
            raise TopError("M", self.M, f"at most {DENSEST * self.form.volume:g} kg for this body ({DENSEST:g} kg/m^3)")

    @classmethod
    def from_density(cls, density: float, **dimensions: float) -> Self:
        """The shape of a material of that density (kg/m^3)."""
        _range("density", finite("density", density), THINNEST, DENSEST, "kg/m^3")
        body = cls(M=1e-3, **dimensions)  # type: ignore[call-arg]  # a field of each kind
        return replace(body, M=density * body.form.mass)  # type: ignore[call-arg]

    @cached_property
    def solid(self) -> Solid:
        return self.density * self.form

    @property
    def mass(self) -> float:
        return self.M

    @property
    def density(self) -> float:
        """kg/m^3."""
        return self.M / self.form.mass


@dataclass(frozen=True, kw_only=True)
class TruncatedSphere(OneMaterial):
    """Fig. 7: a sphere of radius R cut off by a plane at height c, and on the cut a cylinder, the stem.

    The stem has the radius r and the length l. All in m, M in kg. r = l = 0: no stem. c = R: the whole sphere.
    """

    R: float
    c: float
    l: float
    r: float
    M: float

    @classmethod
    def paper(cls) -> Self:
        """Appendix A: R = 1.6 cm, c = 0.82 cm, l = 1.92 cm, r = 0.32 cm, M = 11.5 g."""
        return cls(R=0.016, c=0.0082, l=0.0192, r=0.0032, M=0.0115)

    def _check(self) -> None:
        _range("c", self.c, -self.R, self.R, "m, the cut goes through the sphere", above=True)
        cut = sqrt((self.R - self.c) * (self.R + self.c))
        _range("r", self.r, 0, cut, "m, the radius of the cut it stands on", remedy="Lower r, or cut lower.")
        _range("l", self.l, 0, LONG, "m")
        _stem(self.r, self.l)

    @cached_property
    def form(self) -> Solid:
        sphere = zone(self.R, -self.R, self.c)
        return sphere + cylinder(self.r, self.c, self.c + self.l) if self.l else sphere


@dataclass(frozen=True, kw_only=True)
class Ball(OneMaterial):
    """A uniform ball of radius R (m) and mass M (kg)."""

    R: float
    M: float

    @cached_property
    def form(self) -> Solid:
        return ball(self.R)


@dataclass(frozen=True, kw_only=True)
class LoadedSphere(Shape):
    """Fig. 2: a ball of radius R with a ball of radius b and another density in it, the distance d below O.

    In m and kg/m^3. core_density = 0 is a cavity; d < 0 puts it above O, where a cavity makes a tippe top.
    """

    R: float
    b: float
    d: float
    density: float
    core_density: float

    _weights = ("density", "core_density")

    def _check(self) -> None:
        _range("b", self.b, SMALLEST, self.R, "m, inside the ball", below=True)
        room = self.R - self.b
        _range("d", self.d, -room, room, "m, or the core sticks out", above=True, below=True)
        _range("density", self.density, THINNEST, DENSEST, "kg/m^3")
        _range("core_density", self.core_density, 0, DENSEST, "kg/m^3, 0 for a cavity")

    @cached_property
    def solid(self) -> Solid:
        sphere = self.density * ball(self.R)
        if self.core_density == self.density:
            return sphere
        return sphere + (self.core_density - self.density) * ball(self.b, -self.d)


@dataclass(frozen=True, kw_only=True)
class OrdinaryTop(OneMaterial):
    """A top with G above O: a peg, a disc or cone on it, and a stem.

    The peg is a rod of radius R with a round end about O, h long above O. On it stands the body, t thick, of radius r1
    at its lower face and r2 at its upper one (r1 = r2 is a disc), and on that a stem of radius r and length l
    (r = l = 0: none). All in m, M in kg.
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
        _range("h", self.h, 0, LONG, "m, the peg's rod")
        _range("r1", self.r1, 0, LARGEST, "m, or the body hangs on a point", above=True)
        _range("r2", self.r2, 0, LARGEST, "m")
        _range("t", self.t, SMALLEST, LONG, "m")
        _range("r", self.r, 0, self.r2, "m, the radius r2 of the face the stem stands on")
        _range("l", self.l, 0, LONG, "m")
        _stem(self.r, self.l)

    @cached_property
    def form(self) -> Solid:
        face = self.h + self.t
        form = zone(self.R, -self.R, 0) + frustum(self.r1, self.r2, self.h, face)
        if self.h:
            form += cylinder(self.R, 0, self.h)
        return form + cylinder(self.r, face, face + self.l) if self.l else form


@dataclass(frozen=True, kw_only=True)
class Lathe(Shape):
    """A free outline on a round peg: points (radius, height above O) in m, from the peg upwards.

    The sphere of radius R about O reaches up to the first point's height; frustums join the points, and a step out or
    in is two points of one height. density (kg/m^3) is one number, or one a point: the first for the peg up to
    points[0], the others for the piece from the point before (that of a step counts for nothing).
    """

    R: float
    points: tuple[tuple[float, float], ...]
    density: tuple[float, ...] | float

    def _check(self) -> None:
        points = _rows("points", self.points, 2, MOST_POINTS)
        last = -self.R
        for index, (radius, height) in enumerate(points):
            _range(f"points[{index}] radius", radius, 0, LARGEST, "m")
            _range(f"points[{index}] height", height, last, self.R if index == 0 else LARGEST,
                   "m, from the sphere's lowest point or the point before up", above=index == 0)  # fmt: skip
            last = height
        object.__setattr__(self, "points", points)
        given: Number = self.density  # also of another sequence
        if np.ndim(given) == 0:
            density = _range("density", finite("density", given), THINNEST, DENSEST, "kg/m^3")
        else:
            if len(given) != len(points):
                raise TopError("density", given, f"one number, or as many as points ({len(points)})")
            density = tuple(finite(f"density[{index}]", value) for index, value in enumerate(given))
            for index, value in enumerate(density):
                _range(f"density[{index}]", value, THINNEST, DENSEST, "kg/m^3")
        object.__setattr__(self, "density", density)
        _one_piece("points", self.solid)

    @cached_property
    def solid(self) -> Solid:
        densities = self.density if isinstance(self.density, tuple) else [self.density] * len(self.points)
        solid = densities[0] * zone(self.R, -self.R, self.points[0][1])
        for (r_low, low), (r_high, high), density in zip(self.points, self.points[1:], densities[1:], strict=False):
            if high > low and (r_low or r_high):
                solid += density * frustum(r_low, r_high, low, high)
        return solid


@dataclass(frozen=True, kw_only=True)
class Turned(Shape):
    """Any Solid that stands on a sphere of radius R (m) about O: what `shape + solid` and `shape - solid` give."""

    R: float
    solid: Solid

    _weights = ("solid",)

    def _check(self) -> None:
        if not isinstance(self.solid, Solid) or not 1 <= len(self.solid.slices) <= MOST_PIECES:
            raise TopError("solid", self.solid, f"a Solid of 1 to {MOST_PIECES} pieces")
        _one_piece("solid", self.solid)
        peg = self.solid.outline[0]
        near = 1e-9 * self.R
        if not (peg.arc and abs(peg.arc.R - self.R) <= near and abs(peg.arc.centre) <= near and peg.start[0] == 0
                and abs(peg.start[1] + self.R) <= near):  # fmt: skip
            raise TopError("R", self.R, "the radius of the sphere about O at the solid's lowest point",
                           "Put zone(R, -R, ...) at the bottom, whole.")  # fmt: skip


@dataclass(frozen=True, kw_only=True)
class BareSphere(Shape):
    """A ball of radius R (m) and mass M (kg) of whose inside only a, I1, I3 are known (in R and MR^2, as in Top)."""

    R: float
    M: float
    a: float
    I1: float
    I3: float

    _weights = ("M",)

    def _check(self) -> None:
        _mass(self.M)
        Top(self.a, self.I1, self.I3)
        # int r^2 dm <= M R^2 about O, and it is I1 + I3/2 + a^2
        most = sqrt(max(0.0, 1 - self.I1 - self.I3 / 2))
        if self.I1 + self.I3 / 2 > 1:
            raise TopError("I1", self.I1, f"I1 <= 1 - I3/2 = {1 - self.I3 / 2:g}", "More does not fit into the sphere.")
        _range("a", self.a, -most, most, "R, or it does not fit into the sphere")

    @property
    def mass(self) -> float:
        return self.M

    @property
    def com(self) -> float:
        return -self.a * self.R

    @property
    def moments(self) -> tuple[float, float]:
        unit = self.M * self.R**2
        return self.I1 * unit, self.I3 * unit

    @property
    def top(self) -> Top:
        return Top(self.a, self.I1, self.I3)

    @cached_property
    def solid(self) -> Solid:
        """Its outside: where the mass is inside is not known."""
        return ball(self.R)

    def stl(self, sides: int = 128) -> bytes:
        raise TopError("shape", "BareSphere", "a shape whose inside is known", "Give it dimensions to print it.")


KINDS: dict[str, type[Shape]]
KINDS = {kind.__name__: kind for kind in (TruncatedSphere, LoadedSphere, OrdinaryTop, Lathe, Turned, Ball, BareSphere)}


def _mass(M: float) -> float:
    _range("M", M, 0, inf, "kg", above=True)
    return _range("M", M, LIGHTEST, inf, "kg")


def _stem(r: float, l: float) -> None:
    if (r == 0) != (l == 0):
        name = "r" if r == 0 else "l"
        raise TopError(name, 0.0, f"{name} > 0 (m)", "A stem has a radius and a length; with both 0 there is none.")
    if 0 < l < SMALLEST:
        raise TopError("l", l, f"0, or l >= {SMALLEST:g} (m)")


def _range(
    name: str,
    value: float,
    low: float,
    high: float,
    unit: str,
    above: bool = False,
    below: bool = False,
    remedy: str = "",
) -> float:
    """value, or a TopError unless low <= value <= high (< where above, below)."""
    if (low < value if above else low <= value) and (value < high if below else value <= high) and isfinite(value):
        return value
    left = f"{low:g} {'<' if above else '<='} " if isfinite(low) else ""
    right = f" {'<' if below else '<='} {high:g}" if isfinite(high) else ""
    raise TopError(name, value, f"{left}{name}{right} ({unit})", remedy)


def _rows(name: str, rows: object, columns: int, most: int) -> tuple[tuple[float, ...], ...]:
    """A tuple of tuples of floats."""
    if not isinstance(rows, (list, tuple, np.ndarray)) or not 1 <= len(rows) <= most:
        raise TopError(name, rows, f"1 to {most} rows of {columns} numbers")
    for index, row in enumerate(rows):
        if np.shape(row) != (columns,):
            raise TopError(f"{name}[{index}]", row, f"{columns} numbers")
    return tuple(
        tuple(finite(f"{name}[{index}]", value) for value in row) for index, row in enumerate(rows))  # fmt: skip


def _one_piece(name: str, solid: Solid) -> None:
    if solid.mass <= 0 or solid.pieces != 1:
        raise TopError(name, f"{solid.pieces} bodies", "one body", "Make its parts overlap or touch.")
    starts = [id(edge.start) for outline in solid.outlines for edge in outline]
    through_axis = any(edge.end[0] == 0 for outline in solid.outlines for edge in outline[:-1])
    if through_axis or len(set(starts)) < len(starts):
        raise TopError(name, "a point or circle", "a face where parts meet", "Make them overlap, or leave a gap.")


def _times(factor: float, weight: Number) -> Number:
    return tuple(factor * value for value in weight) if isinstance(weight, tuple) else factor * weight


# --- rocking at rest: a from a stopwatch ---


@dataclass(frozen=True)
class Measured:
    """A value with its standard uncertainty, and the share of each input in it, in the value's units."""

    value: float
    uncertainty: float
    shares: dict[str, float]


def rocking_period(top: Top) -> float:
    """Period in (R/g)^1/2 of small rocking about theta = 0, without spin and without slipping; needs a > 0.

    T = 2 pi [(I1 + (1 - a)^2)/a]^1/2
    """
    if top.a <= 0:
        raise TopError("a", top.a, "a > 0", "Only a top whose G lies below O rocks about theta = 0.")
    return 2 * pi * sqrt((top.I1 + (1 - top.a) ** 2) / top.a)


def a_from_rocking(
    *,
    T: float,
    R: float,
    I1: float,
    g: float = 9.81,
    dT: float = 0.0,
    dR: float = 0.0,
    dI1: float = 0.0,
    dg: float = 0.0,
) -> Measured:
    """a (in R) of a top that rocks with the period T (s): Measured, with the d.. as standard uncertainties.

    R in m, I1 in MR^2 (from the shape), g in m/s^2. With q = (T/2 pi)^2 g/R the period's formula is
        a^2 - (2 + q) a + 1 + I1 = 0,    a = 2 (1 + I1)/(2 + q + [(2 + q)^2 - 4 (1 + I1)]^1/2),
    the other root being larger than 1; and (2 + q - 2a) da = dI1 - a dq.
    Raises TopError where no a < 1 gives so short a period.
    """
    given = {"T": T, "R": R, "I1": I1, "g": g}
    for name, value in given.items():
        given[name] = _range(name, finite(name, value), 1e-9, 1e9, "SI; I1 in MR^2")
    errors = {"T": dT, "R": dR, "I1": dI1, "g": dg}
    for name, value in errors.items():
        errors[name] = _range(f"d{name}", finite(f"d{name}", value), 0, 1e9, "SI; I1 in MR^2")
    T, R, I1, g = given.values()
    q = (T / (2 * pi)) ** 2 * g / R
    # a < 1: at a = 1 the quadratic is I1 - q, so q > I1; and both roots are real
    least = max(I1, 2 * sqrt(1 + I1) - 2)
    if not q > least:
        shortest = 2 * pi * sqrt(least * R / g)
        raise TopError("T", T, f"T > {shortest:.6g} s for this R, I1 and g", "No top of this kind rocks faster.")
    root = sqrt((2 + q) ** 2 - 4 * (1 + I1))
    a = 2 * (1 + I1) / (2 + q + root)
    slopes = {"T": -a * 2 * q / T, "R": a * q / R, "I1": 1.0, "g": -a * q / g}
    shares = {name: abs(slope) * errors[name] / root for name, slope in slopes.items()}
    return Measured(a, hypot(*shares.values()), shares)


def dimension_from_rocking(
    family: Callable[[float], Shape],
    *,
    T: float,
    low: float,
    high: float,
    g: float = 9.81,
    dT: float = 0.0,
    dg: float = 0.0,
) -> Measured:
    """The one unknown dimension of a body that rocks with the period T (s): Measured, in the dimension's unit.

    family(x) is the shape for the dimension x, tried from low to high; where it is no body, or does not rock, x is
    passed over. Example: lambda d: LoadedSphere(R=.02, b=.008, d=d, density=700, core_density=7800).
    Raises TopError where none or more than one x in the range has this period.
    """
    _range("T", finite("T", T), 0, inf, "s", above=True)
    _range("g", finite("g", g), 0, inf, "m/s^2", above=True)

    def period(x: float) -> float:
        try:
            shape = family(float(x))
            return rocking_period(shape.top) * replace(shape.scales, g=g).time
        except TopError:
            return np.nan

    tried = np.linspace(finite("low", low), finite("high", high), 257)
    periods = np.array([period(x) for x in tried])
    if np.isnan(periods).all():
        raise TopError("low", low, "a range with a body in it that rocks", "Give other low and high.")
    at = np.flatnonzero((periods[:-1] >= T) != (periods[1:] >= T))
    at = [index for index in at if not np.isnan(periods[index : index + 2]).any()]
    if len(at) != 1:
        span = f"{np.nanmin(periods):.6g} to {np.nanmax(periods):.6g} s, and reached once"
        raise TopError("T", T, span, "Narrow low and high." if at else "Widen low and high.")
    first, last = tried[at[0]], tried[at[0] + 1]
    x = brentq(lambda x: period(x) - T, first, last, xtol=1e-15 * max(abs(first), abs(last)), rtol=1e-14)
    step = (last - first) * 1e-3
    ahead, behind = (y if isfinite(period(y)) else x for y in (x + step, x - step))
    slope = (period(ahead) - period(behind)) / (ahead - behind)
    shares = {"T": finite("dT", dT) / abs(slope), "g": T / (2 * g) * finite("dg", dg) / abs(slope)}
    return Measured(float(x), float(hypot(*shares.values())), {name: float(share) for name, share in shares.items()})


# --- presets ---


@dataclass(frozen=True)
class Preset:
    """A shape with a name for a menu and where it comes from; stated: its Top where that is told beside its lengths."""

    name: str
    shape: Shape
    source: str
    stated: Top | None = None

    @property
    def top(self) -> Top:
        return self.stated or self.shape.top


PRESETS = (
    Preset(
        "The paper's tippe top", TruncatedSphere.paper(),
        "Gray and Nickel, Am. J. Phys. 68, 821 (2000), appendix A and Fig. 7: a = 0.070, I1 = 0.399, I3 = 0.408 "
        "(Top.paper()), in the body whose lengths are given there.", Top.paper()),
    Preset(
        "Top S", BareSphere(R=0.02, M=0.02, a=0.3, I1=131 / 350, I3=2 / 5),
        "Simulations of the tippe top by Rauch-Wojciechowski and Rutstam (N. Rutstam, arXiv:1306.2470), with "
        "g = 9.82 m/s^2. A sphere whose inside is not told; the bracket of (26) is 0."),
    Preset(
        "Loaded sphere", LoadedSphere(R=0.02, b=0.008, d=0.010, density=1190.0, core_density=7850.0),
        "The form of the paper's Fig. 2; dimensions our own: an acrylic ball 40 mm across with a steel ball of 16 mm."),
    Preset(
        "Disc on a peg", OrdinaryTop(R=0.0018, h=0.0162, r1=0.025, r2=0.025, t=0.004, r=0.002, l=0.015, M=0.020),
        "Math. Probl. Eng. 2018, 6132891, Table 2: disc of 25 mm radius, 20 g, G 20 mm above the table. Peg, thickness "
        "and stem our own; a/R near -10 as in Gray and Nickel's closing remark on ordinary tops."),
    Preset(
        "Wooden cone", OrdinaryTop(R=0.006, h=0.0, r1=0.006, r2=0.022, t=0.025, r=0.004, l=0.020, M=0.013),
        "Dimensions our own: a turned wooden top on a blunt peg."),
    Preset(
        "Uniform ball", Ball(R=0.02, M=0.040),
        "a = 0 and I1 = I3 = 2/5; dimensions our own, an acrylic ball 40 mm across."),
    Preset(
        "Hollow tippe top", TruncatedSphere.paper() - TruncatedSphere.paper().density * ball(0.005, 0.002),
        "The paper's top with a ball of 5 mm radius taken away about 2 mm above O; the cavity is our own."),
    Preset(
        "Free profile", Lathe(
            R=0.005, density=700.0,
            points=((0.005, 0.0), (0.018, 0.010), (0.022, 0.016), (0.018, 0.021), (0.004, 0.024), (0.003, 0.045))),
        "Dimensions our own: a turned wooden top whose points can be dragged."),
    Preset(
        "Appendix A's shape, a = 0.0698", TruncatedSphere.paper(),
        "The same body with what its lengths give, not rounded: a = 0.0698, I1 = 0.3991, I3 = 0.4081. Where the stem "
        "touches, so small a difference may decide where a motion ends."),
)  # fmt: skip


# --- files ---


def save_top(shape: Shape) -> str:
    """The shape as the text of a small JSON document: its kind, and its dimensions in SI."""
    dimensions = {field.name: getattr(shape, field.name) for field in fields(shape)}
    if isinstance(shape, Turned):
        dimensions["solid"] = [
            {"piece": type(piece).__name__, **{field.name: getattr(piece, field.name) for field in fields(piece)}}
            for piece in shape.solid.slices
        ]
    document = {"schema": SCHEMA, "version": VERSION, "kind": type(shape).__name__, "dimensions": dimensions}
    return json.dumps(document, indent=1) + "\n"


def load_top(text: str | bytes) -> Shape:
    """The shape in a document (str or bytes) that save_top wrote, or one like it. Raises TopError, naming the field."""
    if not isinstance(text, (str, bytes)):
        raise TopError("file", type(text).__name__, "the text of a saved top")
    if len(text) > LONGEST:
        raise TopError("file", f"{len(text)} bytes", f"at most {LONGEST} bytes", "A saved top is far smaller.")
    try:
        text = text.decode("utf-8-sig") if isinstance(text, bytes) else text
        # every number a float: a whole number of a million digits is inf, and refused as such
        document = json.loads(text, parse_int=float, parse_constant=float, object_pairs_hook=_without_repeats)
    except TopError:
        raise
    except (ValueError, RecursionError) as error:
        raise TopError("file", "text", "a JSON document", f"{str(error)[:120]}.") from None
    _fields("file", document, ("schema", "version", "kind", "dimensions"))
    for name, wanted in (("schema", SCHEMA), ("version", VERSION)):
        if isinstance(document[name], bool) or document[name] != wanted:
            raise TopError(name, _short(document[name]), repr(wanted), "This is not a top saved by this program.")
    kind = KINDS.get(document["kind"]) if isinstance(document["kind"], str) else None
    if kind is None:
        raise TopError("kind", _short(document["kind"]), ", ".join(KINDS))
    dimensions = document["dimensions"]
    _fields("dimensions", dimensions, [field.name for field in fields(kind)])
    for name, value in dimensions.items():
        if name == "points" or (name == "density" and isinstance(value, list)):
            _numbers(name, value)
        elif name == "solid":
            dimensions[name] = _solid(value)
        else:
            _number(name, value)
    return kind(**{name: _frozen(value) for name, value in dimensions.items()})


def _solid(pieces: Json) -> Solid:
    if not isinstance(pieces, list) or not 1 <= len(pieces) <= MOST_PIECES:
        raise TopError("solid", _short(pieces), f"a list of 1 to {MOST_PIECES} pieces")
    slices = []
    for index, piece in enumerate(pieces):
        name = f"solid[{index}]"
        word = piece.get("piece") if isinstance(piece, dict) else None
        kinds: dict[str, type[Zone | Frustum]] = {"Zone": Zone, "Frustum": Frustum}
        kind = kinds.get(word) if isinstance(word, str) else None
        if kind is None:
            raise TopError(f"{name}.piece", _short(word), "Zone, Frustum")
        _fields(name, piece, ["piece", *(field.name for field in fields(kind))])
        sizes = {key: value for key, value in piece.items() if key != "piece"}
        for key, value in sizes.items():
            _number(f"{name}.{key}", value)
        try:
            slices.append(kind(**sizes))
        except TopError as error:
            raise TopError(f"{name}.{error.name}", error.value, error.allowed, error.remedy) from None
    return Solid(tuple(slices))


def _without_repeats(pairs: list[tuple[str, Json]]) -> dict[str, Json]:
    names = [name for name, _ in pairs]
    for name in names:
        if names.count(name) > 1:
            raise TopError(_short(name), "given more than once", "one value")
    return dict(pairs)


def _fields(name: str, record: Json, wanted: Collection[str]) -> None:
    if not isinstance(record, dict):
        raise TopError(name, _short(record), f"an object with {', '.join(wanted)}")
    for field in record:
        if field not in wanted:
            raise TopError(_short(field), "unknown field", ", ".join(wanted), f"Remove it from {name}.")
    for field in wanted:
        if field not in record:
            raise TopError(field, "missing", ", ".join(wanted), f"Add it to {name}.")


def _number(name: str, value: Json) -> None:
    if not isinstance(value, float):
        raise TopError(name, _short(value), "a number")


def _numbers(name: str, values: Json) -> None:
    """A list of numbers, or of lists of numbers."""
    if not isinstance(values, list) or not 1 <= len(values) <= MOST_POINTS:
        raise TopError(name, _short(values), f"a list of 1 to {MOST_POINTS}")
    for index, value in enumerate(values):
        for number in value if name == "points" and isinstance(value, list) else [value]:
            _number(f"{name}[{index}]", number)


def _frozen(value: Json) -> Json:
    return tuple(_frozen(item) for item in value) if isinstance(value, list) else value


def _short(value: Json) -> Json:
    """What is shown of something a stranger wrote."""
    shown = value if isinstance(value, (str, float, bool, type(None))) else type(value).__name__
    return shown[:40] if isinstance(shown, str) else shown
