"""Solids of revolution about axis 3: sums of slices, where a negative density removes material. In SI units."""

from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import TypeAlias

import numpy as np

from ..errors import TopError, checked
from ..types import Array, Scalars
from . import mesh
from .outline import Edge, chains, encloses, flats
from .ranges import whole
from .slices import EMPTY, NODES, SAME, WEIGHTS, Frustum, Slice, Zone, crossings

Cell: TypeAlias = tuple[float, float, list[Slice]]


@dataclass(frozen=True)
class Solid:
    """A sum of slices. `700 * solid` multiplies the density; `+` and `-` add and remove material."""

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
        """Mass, kg."""
        return float(self._moments[0])

    @property
    def com(self) -> float:
        """Height of the centre of mass G above O, m."""
        return float(self._moments[1] / self._moments[0])

    @property
    def I3(self) -> float:
        """Moment of inertia about axis 3, kg m^2."""
        return float(self._moments[3])

    @property
    def I1(self) -> float:
        """Moment of inertia about any axis through G perpendicular to axis 3, kg m^2."""
        _, first, second, axial = self._moments
        return float(axial / 2 + second - first * self.com)

    @property
    def size(self) -> float:
        """An upper bound of its dimensions, m."""
        return max(max(abs(piece.low), abs(piece.high), piece.widest) for piece in self.slices)

    @cached_property
    def _cells(self) -> list[Cell]:
        """(low, high, curves) from the bottom up; curves, from the outside inwards, separate material from empty
        space."""
        near, most = SAME * self.size, max(abs(piece.density) for piece in self.slices)
        heights = [z for piece in self.slices for z in (piece.low, piece.high)]
        for index, one in enumerate(self.slices):
            for other in self.slices[:index]:
                low, high = max(one.low, other.low), min(one.high, other.high)
                if high > low:
                    heights += crossings(one, other, low, high)
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
                    continue  # two coincident surfaces
                if radius <= near:
                    break
                if density < -EMPTY * most:
                    raise TopError(
                        "density", density, "0 or more everywhere",
                        "More is taken away than there is at the height {middle:g} m.", code="more-taken-away",
                        middle=middle)  # fmt: skip
                if (density > EMPTY * most) != full:
                    full = not full
                    curves.append(piece)
            cells.append((low, high, curves))
        return cells

    @property
    def volume(self) -> float:
        """Volume of the material, m^3."""
        total = 0.0
        for low, high, curves in self._cells:
            for place, piece in enumerate(curves):
                half = (high - low) / 2
                squares = piece.radius(low + half * (1 + NODES)) ** 2
                total += (-1) ** place * np.pi * half * (WEIGHTS @ squares)
        return float(total)

    @cached_property
    def outlines(self) -> list[tuple[Edge, ...]]:
        """The outlines as tuples of Edges: first those from axis to axis, lowest first, then closed ones."""
        near = SAME * self.size
        known: list[Array] = []

        def point(radius: Scalars, height: float) -> Array:
            """One array for each position, so that adjoining edges share it."""
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
            edges += flats(below, starts, point(0, low))
            below = [point(piece.radius(high), high) for piece in curves]
            for place, (piece, start, end) in enumerate(zip(curves, starts, below, strict=True)):
                edges.append(Edge(piece, start, end) if place % 2 == 0 else Edge(piece, end, start))
        return chains([edge for edge in edges if edge.start is not edge.end])

    @property
    def outline(self) -> tuple[Edge, ...]:
        """The outer outline: Edges from the lowest point on the axis to the highest."""
        return self.outlines[0]

    @property
    def pieces(self) -> int:
        """The number of separate bodies, including any that are loose in a cavity."""
        return sum(encloses(outline) for outline in self.outlines)

    def profile(self, n: int) -> Array:
        """The outer outline, from the lowest point on the axis to the highest.

        Every corner is one of the points; the others are distributed over the arcs in proportion to their lengths.

        Parameters
        ----------
        n : int
            number of points

        Returns
        -------
        array (n, 2)
            radius and height above O, m

        Raises
        ------
        TopError
            if n is less than the number of corners
        """
        corners = len(self.outline) + 1
        whole("n", n, corners, 1_000_000, " (the corners)")
        arcs = np.array([edge.length if edge.arc else 0.0 for edge in self.outline])
        lengths = arcs if arcs.any() else np.array([edge.length for edge in self.outline])
        shares = np.concatenate([[0], np.cumsum(lengths)]) / lengths.sum()
        steps = 1 + np.diff(np.round((n - corners) * shares).astype(int))
        rows = [edge.points(count)[:-1] for edge, count in zip(self.outline, steps, strict=True)]
        return np.vstack([*rows, self.outline[-1].end])

    def stl(self, sides: int = 128) -> bytes:
        """The surface, including cavities, with axis 3 along z and O at the origin.

        It is closed: every edge belongs to two triangles, and the normals point out of the solid.

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
            for another number of sides than is possible
        """
        return mesh.stl(self.outlines, sides)


@checked
def zone(R: float, low: float, high: float, centre: float = 0.0) -> Solid:
    """The part of a ball between two heights, with the density 1 kg/m^3.

    Parameters
    ----------
    R : float
        radius of the ball, m
    low, high : float
        the heights, m
    centre : float
        height of the ball's centre, m

    Returns
    -------
    Solid
        of that density

    Raises
    ------
    TopError
        for anything else, with the name, the value and the allowed range
    """
    return Solid((Zone(R=R, low=low, high=high, centre=centre),))


@checked
def ball(R: float, centre: float = 0.0) -> Solid:
    """A whole ball with the density 1 kg/m^3.

    Parameters
    ----------
    R : float
        radius, m
    centre : float
        height of its centre, m

    Returns
    -------
    Solid
        of that density; 700 * solid has 700 kg/m^3

    Raises
    ------
    TopError
        for anything else, with the name, the value and the allowed range
    """
    return zone(R, centre - R, centre + R, centre)


@checked
def frustum(r_low: float, r_high: float, low: float, high: float) -> Solid:
    """A frustum of a cone, or a whole cone, with the density 1 kg/m^3.

    Parameters
    ----------
    r_low, r_high : float
        radius at its lower and its upper face, m
    low, high : float
        their heights, m

    Returns
    -------
    Solid
        of that density

    Raises
    ------
    TopError
        for anything else, with the name, the value and the allowed range
    """
    return Solid((Frustum(r_low=r_low, r_high=r_high, low=low, high=high),))


@checked
def cylinder(r: float, low: float, high: float) -> Solid:
    """A cylinder with the density 1 kg/m^3.

    Parameters
    ----------
    r : float
        radius, m
    low, high : float
        the heights between which it is, m

    Returns
    -------
    Solid
        of that density

    Raises
    ------
    TopError
        for anything else, with the name, the value and the allowed range
    """
    return frustum(r, r, low, high)
