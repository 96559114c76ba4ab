"""Outlines of solids of revolution: edges, and how they join."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ..types import Array
from .slices import Slice, Zone


@dataclass(frozen=True, eq=False)
class Edge:
    """A part of an outline from start to end, (radius, height) each, with the solid on its left; slice is None for a
    flat face."""

    slice: Slice | None
    start: Array
    end: Array

    @property
    def arc(self) -> Zone | None:
        """The spherical zone to which the edge belongs, if it is an arc."""
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
        """Points n equal steps apart, with both ends exact: (n + 1, 2)."""
        share = np.linspace(0, 1, n + 1)[:, None]
        if arc := self.arc:
            first, last = self._angles(arc)
            angle = first + (last - first) * share[:, 0]
            points = np.column_stack([np.sin(angle), -np.cos(angle)]) * arc.R + [0, arc.centre]
        else:
            points = self.start + (self.end - self.start) * share
        points[0], points[-1] = self.start, self.end
        return points


def flats(below: list[Array], above: list[Array], axis: Array) -> list[Edge]:
    """The flat faces at one height, where the solid is just below it but not above, or the reverse."""
    radii = sorted({id(point): point for point in [*below, *above, axis]}.values(), key=lambda point: -point[0])
    edges = []
    for outer, inner in pairwise(radii):
        under, over = (sum(point[0] >= outer[0] for point in ends) % 2 for ends in (below, above))
        if under and not over:
            edges.append(Edge(None, outer, inner))
        elif over and not under:
            edges.append(Edge(None, inner, outer))
    return edges


def chains(edges: list[Edge]) -> list[tuple[Edge, ...]]:
    """The edges in order, as chains of adjoining ones; neighbours on the same surface are merged."""
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


def encloses(outline: tuple[Edge, ...]) -> bool:
    """Whether the solid is inside the closed outline: then its signed volume, 3 V/pi from cones, is positive."""
    rows = np.vstack([edge.points(16) for edge in outline])
    (radius, z), (next_radius, next_z) = rows[:-1].T, rows[1:].T
    return np.sum((radius**2 + radius * next_radius + next_radius**2) * (next_z - z)) > 0
