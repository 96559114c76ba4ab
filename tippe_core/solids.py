"""Solids of revolution about axis 3: exact masses and moments, outlines, and a mesh to print. SI throughout.

Every piece is a slice between two heights z (above O, along axis 3) whose squared radius rho^2 is a quadratic in z:
a zone of a sphere, rho^2 = R^2 - (z - centre)^2, or a frustum of a cone, with the cylinder among them. For a density D

    M = pi D int rho^2 dz,    M z_G = pi D int rho^2 z dz,    int z^2 dm = pi D int rho^2 z^2 dz,
    I3 = (pi/2) D int rho^4 dz,    I1 = I3/2 + int z^2 dm - M z_G^2,

and all the integrands are polynomials of degree four at most, which three Gauss points integrate exactly.
Solids add and subtract slice by slice: a negative density takes away.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import TypeAlias

import numpy as np

from .errors import TopError, finite
from .types import Array, Scalars

LARGEST = 1e3  # m; no top is larger, and no power of it overflows
DENSEST = 1e9  # kg/m^3
SAME = 1e-7  # of a solid's size: points that are closer are one point, also in the single precision of an STL file
EMPTY = 1e-9  # of the largest density: less is rounding of a difference
_NODES, _WEIGHTS = np.sqrt(0.6) * np.array([-1, 0, 1]), np.array([5, 8, 5]) / 9  # of Gauss, on (-1, 1)


@dataclass(frozen=True, kw_only=True)
class Slice(ABC):
    """What lies between the heights low and high (m), with a density (kg/m^3) that is negative where it takes away."""

    low: float
    high: float
    density: float = 1.0

    def __post_init__(self) -> None:
        for name in self.__dataclass_fields__:
            object.__setattr__(self, name, finite(name, getattr(self, name)))
            most = DENSEST if name == "density" else LARGEST
            if abs(getattr(self, name)) > most:
                raise TopError(name, getattr(self, name), f"-{most:g} to {most:g} (SI)")
        if not self.low < self.high:
            raise TopError("high", self.high, f"high > low = {self.low:g} m", "A piece has a height.")

    @property
    @abstractmethod
    def widest(self) -> float:
        """The largest radius."""

    @abstractmethod
    def radius(self, z: Scalars) -> Array:
        """At the heights z, of any shape."""

    @property
    @abstractmethod
    def square(self) -> Array:
        """rho^2 as coefficients (3,) of z^2, z, 1."""

    @cached_property
    def moments(self) -> Array:
        """M, M z_G, int z^2 dm, I3: (4,)."""
        half, middle = (self.high - self.low) / 2, (self.low + self.high) / 2
        z = middle + half * _NODES
        square = self.radius(z) ** 2
        weighed = np.pi * self.density * half * _WEIGHTS * square
        mass = weighed.sum()
        # about the middle first, so that of a ball G is O itself, whatever order a machine sums in
        first = middle * mass + half * _NODES[2] * (weighed[2] - weighed[0])
        return np.array([mass, first, (weighed * z**2).sum(), (weighed * square).sum() / 2])


@dataclass(frozen=True, kw_only=True)
class Zone(Slice):
    """A zone (or cap, or all) of a sphere of radius R with its centre at a height above O."""

    R: float
    centre: float = 0.0

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.R <= 0:
            raise TopError("R", self.R, "R > 0 (m)")
        bottom, crown = self.centre - self.R, self.centre + self.R
        rounding = 1e-12 * (abs(self.centre) + self.R)
        for name in ("low", "high"):
            if not bottom - rounding <= getattr(self, name) <= crown + rounding:
                raise TopError(name, getattr(self, name), f"{bottom:g} to {crown:g} m, within the sphere")

    @property
    def widest(self) -> float:
        return self.R

    def radius(self, z: Scalars) -> Array:
        height = np.asarray(z) - self.centre
        return np.sqrt(np.maximum((self.R - height) * (self.R + height), 0))

    @property
    def square(self) -> Array:
        return np.array([-1.0, 2 * self.centre, self.R**2 - self.centre**2])


@dataclass(frozen=True, kw_only=True)
class Frustum(Slice):
    """A cone's frustum with radius r_low at the bottom and r_high at the top."""

    r_low: float
    r_high: float

    def __post_init__(self) -> None:
        super().__post_init__()
        for name in ("r_low", "r_high"):
            if getattr(self, name) < 0:
                raise TopError(name, getattr(self, name), f"{name} >= 0 (m)")

    @property
    def widest(self) -> float:
        return max(self.r_low, self.r_high)

    def radius(self, z: Scalars) -> Array:
        share = (np.asarray(z) - self.low) / (self.high - self.low)
        return np.maximum(self.r_low * (1 - share) + self.r_high * share, 0)

    @property
    def square(self) -> Array:
        slope = (self.r_high - self.r_low) / (self.high - self.low)
        line = np.array([slope, self.r_low - slope * self.low])
        return np.polymul(line, line) if slope else np.array([0.0, 0.0, line[1] ** 2])


@dataclass(frozen=True, eq=False)
class Edge:
    """A stretch of an outline from start to end, radius and height (2,), the solid on its left; slice is None on a
    flat."""

    slice: Slice | None
    start: Array
    end: Array

    @property
    def arc(self) -> Zone | None:
        """The sphere's zone whose arc it is."""
        return self.slice if isinstance(self.slice, Zone) else None

    def _angles(self, arc: Zone) -> tuple[float, float]:
        first, last = (np.arctan2(point[0], arc.centre - point[1]) for point in (self.start, self.end))
        return first, last

    @property
    def length(self) -> float:
        if arc := self.arc:
            return arc.R * abs(np.subtract(*self._angles(arc)))
        return float(np.hypot(*(self.end - self.start)))

    def points(self, n: int) -> Array:
        """n steps of equal length, both ends as they are: (n + 1, 2)."""
        share = np.linspace(0, 1, n + 1)[:, None]
        if arc := self.arc:
            first, last = self._angles(arc)
            angle = first + (last - first) * share[:, 0]
            points = np.column_stack([np.sin(angle), -np.cos(angle)]) * arc.R + [0, arc.centre]
        else:
            points = self.start + (self.end - self.start) * share
        points[0], points[-1] = self.start, self.end
        return points


Cell: TypeAlias = tuple[float, float, list[Slice]]


@dataclass(frozen=True)
class Solid:
    """Slices taken together; `700 * solid` weighs it with a density, `+` and `-` put on and take away."""

    slices: tuple[Slice, ...]

    def __add__(self, other: "Solid") -> "Solid":
        return Solid(self.slices + other.slices)

    def __sub__(self, other: "Solid") -> "Solid":
        return self + -1 * other

    def __rmul__(self, factor: float) -> "Solid":
        return Solid(tuple(replace(piece, density=factor * piece.density) for piece in self.slices))

    @cached_property
    def _moments(self) -> Array:
        return sum((piece.moments for piece in self.slices), np.zeros(4))

    @property
    def mass(self) -> float:
        """kg."""
        return float(self._moments[0])

    @property
    def com(self) -> float:
        """Height of G above O, m."""
        return float(self._moments[1] / self._moments[0])

    @property
    def I3(self) -> float:
        """About axis 3, kg m^2."""
        return float(self._moments[3])

    @property
    def I1(self) -> float:
        """At G about any axis across axis 3, kg m^2."""
        _, first, second, axial = self._moments
        return float(axial / 2 + second - first * self.com)

    @property
    def size(self) -> float:
        """A length, m, that nothing of it exceeds."""
        return max(max(abs(piece.low), abs(piece.high), piece.widest) for piece in self.slices)

    @cached_property
    def _cells(self) -> list[Cell]:
        """(low, high, curves) from the bottom up; curves, from outside inwards, part the solid from what is empty."""
        near, most = SAME * self.size, max(abs(piece.density) for piece in self.slices)
        heights = [z for piece in self.slices for z in (piece.low, piece.high)]
        for index, one in enumerate(self.slices):
            for other in self.slices[:index]:
                low, high = max(one.low, other.low), min(one.high, other.high)
                if high > low:
                    heights += _crossings(one, other, low, high)
        levels: list[float] = []
        for z in sorted(heights):
            if not levels or z - levels[-1] > near:
                levels.append(z)
        cells = []
        for low, high in pairwise(levels):
            middle = (low + high) / 2
            present = [(float(piece.radius(middle)), piece) for piece in self.slices if piece.low < middle < piece.high]
            present.sort(key=lambda pair: -pair[0])
            curves, density, full = [], 0.0, False
            for place, (radius, piece) in enumerate(present):
                density += piece.density
                if place + 1 < len(present) and radius - present[place + 1][0] <= near:
                    continue  # two surfaces in one
                if radius <= near:
                    break
                if density < -EMPTY * most:
                    raise TopError(
                        "density", density, "0 or more everywhere",
                        f"More is taken away than there is at the height {middle:g} m.")  # fmt: skip
                if (density > EMPTY * most) != full:
                    full = not full
                    curves.append(piece)
            cells.append((low, high, curves))
        return cells

    @property
    def volume(self) -> float:
        """Of all that is not empty, m^3."""
        total = 0.0
        for low, high, curves in self._cells:
            for place, piece in enumerate(curves):
                half = (high - low) / 2
                squares = piece.radius(low + half * (1 + _NODES)) ** 2
                total += (-1) ** place * np.pi * half * (_WEIGHTS @ squares)
        return float(total)

    @cached_property
    def outlines(self) -> list[tuple[Edge, ...]]:
        """Tuples of Edges: first those from axis to axis, the lowest first; then closed ones."""
        near = SAME * self.size
        known: list[Array] = []

        def point(radius: Scalars, height: float) -> Array:
            """One array a place, so that edges that meet share it."""
            for old in known:
                if abs(old[0] - radius) <= near and abs(old[1] - height) <= near:
                    return old
            known.append(np.array([0.0 if radius <= near else float(radius), float(height)]))
            return known[-1]

        edges: list[Edge] = []
        below: list[Array] = []
        above = self._cells[-1][1]
        for low, high, curves in [*self._cells, (above, above, [])]:
            starts = [point(piece.radius(low), low) for piece in curves]
            edges += _flats(below, starts, point(0, low))
            below = [point(piece.radius(high), high) for piece in curves]
            for place, (piece, start, end) in enumerate(zip(curves, starts, below, strict=True)):
                edges.append(Edge(piece, start, end) if place % 2 == 0 else Edge(piece, end, start))
        return _chains([edge for edge in edges if edge.start is not edge.end])

    @property
    def outline(self) -> tuple[Edge, ...]:
        """The outside: Edges from the lowest point of the axis to the highest."""
        return self.outlines[0]

    @property
    def pieces(self) -> int:
        """How many bodies it is that do not touch; one that is loose in a cavity counts."""
        return sum(_encloses(outline) for outline in self.outlines)

    def profile(self, n: int) -> Array:
        """(n, 2): radius and height above O (m) of the outside from the lowest point of the axis to the highest.

        Every corner is one of the points; the others are spread over the arcs by their length.
        """
        corners = len(self.outline) + 1
        if isinstance(n, bool) or not isinstance(n, (int, np.integer)) or not corners <= n <= 1_000_000:
            raise TopError("n", n, f"a whole number of points from {corners} (the corners) to 1000000")
        arcs = np.array([edge.length if edge.arc else 0.0 for edge in self.outline])
        lengths = arcs if arcs.any() else np.array([edge.length for edge in self.outline])
        shares = np.concatenate([[0], np.cumsum(lengths)]) / lengths.sum()
        steps = 1 + np.diff(np.round((n - corners) * shares).astype(int))
        rows = [edge.points(count)[:-1] for edge, count in zip(self.outline, steps, strict=True)]
        return np.vstack([*rows, self.outline[-1].end])

    def stl(self, sides: int = 128) -> bytes:
        """The surface, cavities too, as a binary STL file (bytes), `sides` flat faces to a turn.

        In mm, axis 3 along z, O at the origin. Closed: every edge belongs to two triangles, and the normals point out
        of the solid.
        """
        if isinstance(sides, bool) or not isinstance(sides, (int, np.integer)) or not 3 <= sides <= 1024:
            raise TopError("sides", sides, "a whole number from 3 to 1024")
        turn = 2 * np.pi * np.arange(sides) / sides
        around, onwards = np.column_stack([np.cos(turn), np.sin(turn)]), np.roll(np.arange(sides), -1)
        triangles = []
        for outline in self.outlines:
            for edge in outline:
                angle = edge.length / edge.arc.R if edge.arc else 0.0
                points = edge.points(max(1, int(np.ceil(angle * sides / (2 * np.pi) - 1e-9))))
                for first, second in pairwise(points):
                    P, Q = (np.column_stack([radius * around, np.full(sides, z)]) for radius, z in (first, second))
                    if first[0]:
                        triangles.append(np.stack([P, P[onwards], Q[onwards]], axis=1))
                    if second[0]:
                        triangles.append(np.stack([P, Q[onwards], Q], axis=1))
        return _binary_stl(1e3 * np.concatenate(triangles))


def zone(R: float, low: float, high: float, centre: float = 0.0) -> Solid:
    """The part of a ball between two heights, weighing 1 kg/m^3."""
    return Solid((Zone(R=R, low=low, high=high, centre=centre),))


def ball(R: float, centre: float = 0.0) -> Solid:
    return zone(R, centre - R, centre + R, centre)


def frustum(r_low: float, r_high: float, low: float, high: float) -> Solid:
    """A frustum of a cone, or a whole one, weighing 1 kg/m^3."""
    return Solid((Frustum(r_low=r_low, r_high=r_high, low=low, high=high),))


def cylinder(r: float, low: float, high: float) -> Solid:
    return frustum(r, r, low, high)


def _crossings(one: Slice, other: Slice, low: float, high: float) -> list[float]:
    """Heights between low and high at which two surfaces meet."""
    gap = np.polysub(one.square, other.square)
    if np.abs(np.polyval(gap, np.linspace(low, high, 3))).max() <= SAME * max(one.widest, other.widest) ** 2:
        return []
    # a coefficient that is rounding next to the others only makes a root far away, which may overflow
    terms = np.abs(gap) * max(abs(low), abs(high)) ** np.arange(len(gap) - 1, -1, -1)
    roots = np.roots(np.where(terms > 1e-16 * terms.max(), gap, 0.0))
    return [float(z) for z in roots.real[np.abs(roots.imag) == 0] if low < z < high]


def _flats(below: list[Array], above: list[Array], axis: Array) -> list[Edge]:
    """Flat faces at one height: where there is something just below it and nothing above, or the reverse."""
    radii = sorted({id(point): point for point in [*below, *above, axis]}.values(), key=lambda point: -point[0])
    edges = []
    for outer, inner in pairwise(radii):
        under, over = (sum(point[0] >= outer[0] for point in ends) % 2 for ends in (below, above))
        if under and not over:
            edges.append(Edge(None, outer, inner))
        elif over and not under:
            edges.append(Edge(None, inner, outer))
    return edges


def _chains(edges: list[Edge]) -> list[tuple[Edge, ...]]:
    """Edges that follow each other, put in order; neighbours on one surface become one."""
    leaving: dict[int, list[Edge]] = {}
    for edge in edges:
        leaving.setdefault(id(edge.start), []).append(edge)
    on_axis = sorted((edge for edge in edges if edge.start[0] == 0), key=lambda edge: edge.start[1])
    outlines, used = [], set()
    for first in [*on_axis, *edges]:
        if id(first) in used:
            continue
        chain: list[Edge] = []
        edge = first
        while edge is not None:
            used.add(id(edge))
            if chain and edge.slice is not None and edge.slice is chain[-1].slice:
                chain[-1] = Edge(edge.slice, chain[-1].start, edge.end)
            else:
                chain.append(edge)
            edge = next((edge for edge in leaving.get(id(edge.end), []) if id(edge) not in used), None)
        outlines.append(tuple(chain))
    return outlines


def _encloses(outline: tuple[Edge, ...]) -> bool:
    """Whether the solid is on the inner side of the outline: 3 V/pi of the cones to its ends is then positive."""
    rows = np.vstack([edge.points(16) for edge in outline])
    (radius, z), (next_radius, next_z) = rows[:-1].T, rows[1:].T
    return np.sum((radius**2 + radius * next_radius + next_radius**2) * (next_z - z)) > 0


def _binary_stl(triangles: Array) -> bytes:
    """(n, 3 corners, 3) to the bytes of an STL file."""
    across = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    length = np.linalg.norm(across, axis=1, keepdims=True)
    rows = np.zeros(len(triangles), dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    # + 0: a zero has no sign, so that a corner has the same bytes in all its triangles
    rows["normal"], rows["corners"] = across / np.where(length, length, 1), triangles + 0.0
    header = b"tippe top, mm, axis 3 along z".ljust(80)
    return header + np.uint32(len(rows)).astype("<u4").tobytes() + rows.tobytes()
