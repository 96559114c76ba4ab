"""The body as a mesh for a 3-D printer: closed, facing outwards, with the right volume, centre and inertia."""

from collections import Counter
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from test_shapes import SOLID, turned_volume

from tippe_core import Ball, Lathe

# --- STL ---


def read_stl(data):
    """Normals (n, 3) and corners (n, 3, 3) of a binary STL file."""
    count = int(np.frombuffer(data[80:84], "<u4")[0])
    assert len(data) == 84 + 50 * count
    rows = np.frombuffer(data[84:], dtype=[("v", "<f4", (4, 3)), ("attribute", "<u2")])
    return rows["v"][:, 0].astype(float), rows["v"][:, 1:]


def mesh_moments(corners):
    """(V, z_G, I1, I3) of what the triangles enclose: tetrahedra to the origin (divergence theorem)."""
    A, B, C = corners.astype(float).transpose(1, 0, 2)
    six = np.einsum("ni,ni->n", A, np.cross(B, C))
    V = six.sum() / 6
    centre = (six[:, None] * (A + B + C)).sum(axis=0) / 24 / V
    S = A + B + C
    squares = np.einsum("n,nij->ij", six / 120, sum(x[:, :, None] * x[:, None, :] for x in (A, B, C, S)))
    xx, yy, zz = np.diag(squares)
    assert centre[:2] == pytest.approx((0, 0), abs=1e-5)
    return V, centre[2], yy + zz - V * centre[2] ** 2, xx + yy


def assert_closed_and_outward(normals, corners):
    edges = Counter()
    for triangle in corners:
        a, b, c = (corner.tobytes() for corner in triangle)
        assert len({a, b, c}) == 3
        edges.update([(a, b), (b, c), (c, a)])
    # every directed edge once, and its reverse once: two triangles per edge, with the same orientation
    assert set(edges.values()) == {1}
    assert all((b, a) in edges for a, b in edges)
    wound = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]).astype(float)
    wound /= np.linalg.norm(wound, axis=1, keepdims=True)
    assert np.einsum("ni,ni->n", wound, normals).min() > 0.99
    assert mesh_moments(corners)[0] > 0


@pytest.mark.parametrize("name", SOLID)
def test_stl_is_closed_and_outward(name):
    assert_closed_and_outward(*read_stl(SOLID[name].stl(48)))


@pytest.mark.parametrize("sides", [12, 48, 96])
def test_an_arc_has_as_many_pieces_as_the_circle_about_the_axis(sides):
    """A ball: half of them from pole to pole, each ring of two triangles a side, one at a pole."""
    normals, _ = read_stl(Ball(R=0.01, M=0.01).stl(sides))
    assert len(normals) == 2 * sides * (sides // 2 - 1)


@given(st.lists(st.tuples(st.floats(0.001, 0.03), st.floats(0, 0.01)), min_size=1, max_size=8), st.floats(-0.9, 0.9))
def test_stl_of_any_lathe_profile_is_closed(steps, height):
    """Points that rise by steps, some of them by nothing; the sum over frustums once more gives the volume."""
    rises = np.cumsum([0.0] + [0.0 if rise < 1e-4 else rise for _, rise in steps[1:]])
    points = [(radius, 0.01 * height + rise) for (radius, _), rise in zip(steps, rises, strict=True)]
    shape = Lathe(R=0.01, points=points, density=700.0)
    assert_closed_and_outward(*read_stl(shape.stl(12)))
    assert turned_volume(shape.profile(20000)) == pytest.approx(shape.mass / 700, rel=1e-6)


@pytest.mark.parametrize("name", SOLID)
def test_stl_has_the_bodys_volume_centre_and_inertia(name):
    """In mm and unit density. Flat faces cost 1/sides^2; two meshes take that away and leave single precision."""
    shape = SOLID[name]
    if name in ("Loaded sphere", "vase"):  # a mesh has only one density
        pieces = shape.solid.slices[:1] if name == "Loaded sphere" else shape.solid.slices
        solid = type(shape.solid)(tuple(replace(piece, density=1.0) for piece in pieces))
    elif getattr(shape, "disc", 0):
        solid = replace(shape, disc=0.0, thickness=0.0, height=0.0).form
    else:
        solid = (1 / max(piece.density for piece in shape.solid.slices)) * shape.solid
    expected = np.array([solid.mass * 1e9, solid.com * 1e3, solid.I1 * 1e15, solid.I3 * 1e15])
    coarse, fine = (np.array(mesh_moments(read_stl(shape.stl(sides))[1])) for sides in (128, 256))
    limit = fine + (fine - coarse) / 3
    assert limit[[0, 2, 3]] == pytest.approx(expected[[0, 2, 3]], rel=2e-5)
    assert limit[1] == pytest.approx(expected[1], abs=2e-5 * 1e3 * shape.R)
    assert abs(fine[0] / expected[0] - 1) < 0.3 * abs(coarse[0] / expected[0] - 1)
