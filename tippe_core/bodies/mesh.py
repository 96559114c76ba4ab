"""The surface of a solid of revolution as triangles, for printing."""

from collections.abc import Iterable, Sequence
from itertools import pairwise

import numpy as np

from ..errors import TopError
from ..types import Array
from .outline import Edge


def stl(outlines: Iterable[Sequence[Edge]], sides: int) -> bytes:
    """The surface within the outlines (m) as a binary STL file, in mm: see Solid.stl."""
    if isinstance(sides, bool) or not isinstance(sides, (int, np.integer)) or not 3 <= sides <= 1024:
        raise TopError("sides", sides, "a whole number from {low} to {high}", code="not-whole", low=3, high=1024)
    turn = 2 * np.pi * np.arange(sides) / sides
    around, onwards = np.column_stack([np.cos(turn), np.sin(turn)]), np.roll(np.arange(sides), -1)
    triangles = []
    for outline in outlines:
        for edge in outline:
            angle = edge.length / edge.arc.R if edge.arc else 0.0
            points = edge.points(max(1, int(np.ceil(angle * sides / (2 * np.pi) - 1e-9))))
            for first, second in pairwise(points):
                P, Q = (np.column_stack([radius * around, np.full(sides, z)]) for radius, z in (first, second))
                if first[0]:
                    triangles.append(np.stack([P, P[onwards], Q[onwards]], axis=1))
                if second[0]:
                    triangles.append(np.stack([P, Q[onwards], Q], axis=1))
    return _binary(1e3 * np.concatenate(triangles))


def _binary(triangles: Array) -> bytes:
    """(n, 3 corners, 3) to the bytes of an STL file."""
    across = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    length = np.linalg.norm(across, axis=1, keepdims=True)
    rows = np.zeros(len(triangles), dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    # + 0: a zero has no sign, so that a corner has the same bytes in all its triangles
    rows["normal"], rows["corners"] = across / np.where(length, length, 1), triangles + 0.0
    header = b"tippe top, mm, axis 3 along z".ljust(80)
    return header + np.uint32(len(rows)).astype("<u4").tobytes() + rows.tobytes()
