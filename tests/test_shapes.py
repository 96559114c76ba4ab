"""Shapes: masses and moments against other ways of integrating, outlines and STL files read back, rocking, files."""

import json
from collections import Counter
from dataclasses import fields, replace
from math import acos, asin, cos, degrees, pi, sin, sqrt

import numpy as np
import pytest
import rigid_body as rb
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad
from scipy.optimize import brentq

from tippe_core import (
    PRESETS,
    Ball,
    BareSphere,
    Lathe,
    LoadedSphere,
    OrdinaryTop,
    Scales,
    StemmedSphere,
    Top,
    TopError,
    TruncatedSphere,
    Turned,
    a_from_rocking,
    ball,
    cylinder,
    dimension_from_rocking,
    frustum,
    load_top,
    rocking_period,
    save_top,
    zone,
)

PAPER = TruncatedSphere.paper()
BORED = PAPER - PAPER.density * cylinder(0.002, 0.010, 0.0274)
HOLLOW = Ball(R=0.02, M=0.04) - Ball(R=0.02, M=0.04).density * ball(0.012, 0.004)
# a cap with a hanging rim, as a mushroom
RIM = cylinder(0.015, 0.004, 0.014) - cylinder(0.013, 0.004, 0.011)
UNDERCUT = Turned(R=0.004, solid=700 * (zone(0.004, -0.004, 0) + cylinder(0.004, 0, 0.011) + RIM))
CAVITY = LoadedSphere(R=0.02, b=0.007, d=-0.009, density=900.0, core_density=0.0)
VASE = Lathe(R=0.005, points=((0.003, -0.003), (0.018, 0.004), (0.018, 0.009), (0.004, 0.009), (0.002, 0.03)),
             density=(7800.0, 2700.0, 2700.0, 1.0, 700.0))  # fmt: skip
SHAPES = {preset.name: preset.shape for preset in PRESETS} | {
    "bored": BORED, "hollow": HOLLOW, "undercut": UNDERCUT, "cavity": CAVITY, "vase": VASE,
    "no stem": TruncatedSphere(R=0.02, c=0.004, l=0.0, r=0.0, M=0.02)}  # fmt: skip
SOLID = {name: shape for name, shape in SHAPES.items() if not isinstance(shape, BareSphere)}

PRINTED = 5e-4  # half of the third digit


def of(solid):
    return solid.mass, solid.com, solid.I1, solid.I3


# --- masses and moments ---


def test_the_papers_top():
    """Appendix A's dimensions against its printed 0.070, 0.399, 0.408, and the four figures checked beforehand."""
    top = PAPER.top
    assert (top.a, top.I1, top.I3) == pytest.approx((0.070, 0.399, 0.408), abs=PRINTED)
    assert (top.a, top.I1, top.I3) == pytest.approx((0.0698, 0.3991, 0.4081), abs=5e-5)
    assert PAPER.scales == Scales.paper()
    assert 500 < PAPER.density < 1000  # a light hardwood


def test_the_closed_forms_of_textbooks():
    R, r, h, z = 0.7, 0.3, 1.1, 0.4
    M = 4 / 3 * pi * R**3
    assert of(ball(R, z)) == pytest.approx((M, z, 2 / 5 * M * R**2, 2 / 5 * M * R**2), rel=1e-13)
    M = pi * r**2 * h
    assert of(cylinder(r, z, z + h)) == pytest.approx(
        (M, z + h / 2, M * (3 * r**2 + h**2) / 12, M * r**2 / 2), rel=1e-13)  # fmt: skip
    M = pi * r**2 * h / 3
    assert of(frustum(r, 0, z, z + h)) == pytest.approx(
        (M, z + h / 4, 3 / 80 * M * (4 * r**2 + h**2), 3 / 10 * M * r**2), rel=1e-13)  # fmt: skip
    M = 2 / 3 * pi * R**3
    assert of(zone(R, -R, 0)) == pytest.approx((M, -3 / 8 * R, 83 / 320 * M * R**2, 2 / 5 * M * R**2), rel=1e-13)
    b = 0.45
    M, I = 4 / 3 * pi * (R**3 - b**3), 8 / 15 * pi * (R**5 - b**5)
    shell = ball(R) - ball(b)
    assert (shell.mass, shell.volume, shell.I1, shell.I3) == pytest.approx((M, M, I, I), rel=1e-13)


def by_shells(bottom, top, widest, breaks):
    """(M, z_G, I1, I3) of unit density from cylindrical shells: bottom(rho) and top(rho) bound the body."""

    def integral(weight):
        return quad(lambda rho: 2 * pi * rho * weight(rho, bottom(rho), top(rho)), 0, widest,
                    points=breaks, epsabs=0, epsrel=1e-11, limit=200)[0]  # fmt: skip

    M = integral(lambda rho, low, high: high - low)
    z = integral(lambda rho, low, high: (high**2 - low**2) / 2) / M
    I3 = integral(lambda rho, low, high: rho**2 * (high - low))
    across = integral(lambda rho, low, high: ((high - z) ** 3 - (low - z) ** 3) / 3)
    return M, z, I3 / 2 + across, I3


@given(st.floats(-0.9, 0.95), st.floats(0.05, 3), st.floats(0.05, 1))
def test_truncated_sphere_by_shells(c, l, share):
    cut = sqrt(1 - c * c)
    r = share * cut

    def high(rho):
        return c + l if rho < r else c if rho < cut else sqrt(1 - rho * rho)

    widest = 1.0 if c > 0 else cut
    expected = by_shells(lambda rho: -sqrt(1 - rho * rho), high, widest, [x for x in (r, cut) if x < widest])
    found = of(TruncatedSphere(R=1, c=c, l=l, r=r, M=1).form)
    assert found == pytest.approx(expected, rel=1e-8, abs=1e-9)


def by_rings(density, widest, low, high, cell=2e-5):
    """(M, z_G, I1, I3) from a sum over rings of square section; density(rho, z) in their middle."""
    rho, z = np.meshgrid(np.arange(0, widest, cell) + cell / 2, np.arange(low, high, cell) + cell / 2)
    dm = 2 * pi * rho * density(rho, z) * cell**2
    M = dm.sum()
    centre = (dm * z).sum() / M
    I3 = (dm * rho**2).sum()
    return M, centre, I3 / 2 + (dm * (z - centre) ** 2).sum(), I3


def paper_density(rho, z):
    ball = (rho**2 + z**2 < 0.016**2) & (z < 0.0082)
    return PAPER.density * (ball | ((rho < 0.0032) & (z > 0.0081) & (z < 0.0274)))


def vase_density(rho, z):
    peg = 7800.0 * ((rho**2 + z**2 < 0.005**2) & (z < -0.003))
    bowl = 2700.0 * ((z > -0.003) & (z < 0.009) & (rho < np.minimum(0.018, 0.003 + (z + 0.003) * 15 / 7)))
    return peg + bowl + 700.0 * ((z > 0.009) & (z < 0.03) & (rho < 0.004 - (z - 0.009) * 2 / 21))


def cone_density(rho, z):
    shape = SHAPES["Wooden cone"]
    peg, cone = (z < 0) & (rho**2 + z**2 < 0.006**2), (z > 0) & (z < 0.025) & (rho < 0.006 + z * 0.016 / 0.025)
    return shape.density * (peg | cone | ((z > 0.025) & (z < 0.045) & (rho < 0.004)))


GRIDS = {
    "paper": (PAPER, paper_density, 0.016, -0.016, 0.0274),
    "bored": (BORED, lambda rho, z: paper_density(rho, z) * ((rho > 0.002) | (z < 0.010)), 0.016, -0.016, 0.0274),
    "loaded": (SHAPES["Loaded sphere"],
               lambda rho, z: 1190.0 * (rho**2 + z**2 < 0.02**2) + 6660.0 * (rho**2 + (z + 0.010) ** 2 < 0.008**2),
               0.02, -0.02, 0.02),
    "cavity": (CAVITY, lambda rho, z: 900.0 * (rho**2 + z**2 < 0.02**2) * (rho**2 + (z - 0.009) ** 2 > 0.007**2),
               0.02, -0.02, 0.02),
    "vase": (VASE, vase_density, 0.018, -0.005, 0.03),
    "cone": (SHAPES["Wooden cone"], cone_density, 0.022, -0.006, 0.045),
    "undercut": (UNDERCUT, lambda rho, z: 700.0 * (((rho**2 + z**2 < 0.004**2) & (z < 0)) | ((z > 0) & (z < 0.014)
                 & (rho < 0.004)) | ((z > 0.004) & (z < 0.014) & (rho < 0.015) & ((rho > 0.013) | (z > 0.011)))),
                 0.015, -0.004, 0.014),
}  # fmt: skip


@pytest.mark.parametrize("name", GRIDS)
def test_moments_against_a_sum_over_rings(name):
    """All corners lie between rings; along a slope the rings step, which averages to a tenth of a ring in R or less."""
    shape, *grid = GRIDS[name]
    M, com, I1, I3 = by_rings(*grid)
    lost = 0.1 * 2e-5 / shape.R  # at most 4e-4
    assert shape.mass == pytest.approx(M, rel=lost)
    assert shape.com == pytest.approx(com, abs=lost * shape.R)
    assert shape.moments == pytest.approx((I1, I3), rel=lost)


lengths = st.floats(0.2, 3)


@st.composite
def solids(draw):
    z, h = draw(st.floats(-2, 2)), draw(lengths)
    density = draw(st.floats(0.5, 20))
    if draw(st.booleans()):
        R = draw(lengths)
        low = z + R * draw(st.floats(-1, 0.5))
        return density * zone(R, low, min(low + h, z + R), z)
    return density * frustum(draw(lengths), draw(lengths), z, z + h)


@given(solids(), solids(), st.floats(-5, 5))
def test_parallel_axes(one, other, distance):
    """Two bodies together by Steiner's theorem, and a body moved along the axis keeps its moments."""
    M, _, I1, I3 = of(one + other)
    assert one.mass + other.mass == pytest.approx(M, rel=1e-12)
    assert one.I3 + other.I3 == pytest.approx(I3, rel=1e-12)
    reduced = one.mass * other.mass / M
    assert one.I1 + other.I1 + reduced * (one.com - other.com) ** 2 == pytest.approx(I1, rel=1e-10)
    [piece] = one.slices
    moved = {name: getattr(piece, name) + distance for name in ("low", "high", "centre") if hasattr(piece, name)}
    there = type(one)((replace(piece, **moved),))
    assert of(there) == pytest.approx((one.mass, one.com + distance, one.I1, one.I3), rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("factor", [0.05, 37.0])
@pytest.mark.parametrize("name", SHAPES)
def test_scaling(name, factor):
    """A copy k times larger of the same material: the same Top, k^3 the mass; a denser one only weighs more."""
    shape = SHAPES[name]

    def grow(value):
        return tuple(map(grow, value)) if isinstance(value, tuple) else factor * value

    if isinstance(shape, Turned):
        pieces = shape.solid.slices
        sizes = [{f.name: factor * getattr(p, f.name) for f in fields(p) if f.name != "density"} for p in pieces]
        grown = tuple(replace(p, **size) for p, size in zip(pieces, sizes, strict=True))
        larger = Turned(R=factor * shape.R, solid=type(shape.solid)(grown))
    else:
        kept = {"density", "core_density", "a", "I1", "I3"}
        sizes = {f.name: grow(getattr(shape, f.name)) for f in fields(shape) if f.name not in kept}
        larger = replace(shape, **sizes | ({"M": factor**3 * shape.M} if "M" in sizes else {}))
    for other in (larger, shape.with_mass(factor * shape.mass)):
        assert (other.top.a, other.top.I1, other.top.I3) == pytest.approx(
            (shape.top.a, shape.top.I1, shape.top.I3), rel=1e-9, abs=1e-12)  # fmt: skip
    assert larger.mass == pytest.approx(factor**3 * shape.mass, rel=1e-10)
    assert larger.volume == pytest.approx(factor**3 * shape.volume, rel=1e-9)
    assert shape.with_mass(factor * shape.mass).mass == pytest.approx(factor * shape.mass, rel=1e-12)


def test_density_from_mass_and_mass_from_density():
    assert TruncatedSphere.from_density(PAPER.density, R=0.016, c=0.0082, l=0.0192, r=0.0032).M == pytest.approx(0.0115)
    assert Ball.from_density(1190.0, R=0.02).M == pytest.approx(1190 * 4 / 3 * pi * 0.02**3, rel=1e-13)


def test_presets():
    tops = {preset.name: preset.shape.top for preset in PRESETS}
    assert tops["Top S"] == Top(a=0.3, I1=131 / 350, I3=2 / 5)
    assert tops["Disc on a peg"].a == pytest.approx(-10, abs=0.2)
    disc = SHAPES["Disc on a peg"]
    assert disc.com + disc.R == pytest.approx(0.020, abs=5e-5)  # the source: 20 mm above the table
    assert disc.moments[1] == pytest.approx(6.25e-6, rel=0.05)  # and, for the bare disc, 0.625e-5 kg m^2
    assert tops["Uniform ball"].a == 0
    assert tops["Uniform ball"].I1 == pytest.approx(0.4, rel=1e-14)
    assert tops["Loaded sphere"].a > 0 > tops["Wooden cone"].a
    toy = SHAPES["Leine and Glocker's toy"]
    assert toy.moments == pytest.approx((8e-7, 7e-7), rel=1e-14) and toy.com == pytest.approx(-0.003, rel=1e-14)
    assert toy.edge == pytest.approx((0, 13 / 15, 1 / 3), rel=1e-15)
    assert all(preset.source and preset.name for preset in PRESETS)


# --- outlines ---


@pytest.mark.parametrize("name", SHAPES)
def test_profile(name):
    """From (0, -R) to the axis, n points, the first on the sphere; it encloses the outside's volume, better with n."""
    shape = SHAPES[name]
    profile = shape.profile(4000)
    assert profile.shape == (4000, 2)
    assert profile[0] == pytest.approx((0, -shape.R))
    assert profile[-1, 0] == 0
    assert np.all(profile[:, 0] >= 0)
    assert np.hypot(*profile[1]) == pytest.approx(shape.R, rel=1e-12)
    cavity = 4 / 3 * pi * {"hollow": 0.012**3, "cavity": 0.007**3, "Hollow tippe top": 0.005**3}.get(name, 0)
    assert turned_volume(profile) == pytest.approx(shape.volume + cavity, rel=2e-6)
    coarse, fine = (turned_volume(shape.profile(n)) for n in (400, 800))
    assert abs(fine - shape.volume - cavity) <= 0.3 * abs(coarse - shape.volume - cavity) + 1e-12 * shape.volume


def turned_volume(profile):
    (rho, z), (next_rho, next_z) = profile[:-1].T, profile[1:].T
    return np.sum(pi / 3 * (rho**2 + rho * next_rho + next_rho**2) * (next_z - z))


def test_profile_has_the_corners_of_figure_7():
    profile = PAPER.profile(50)
    cut = sqrt(0.016**2 - 0.0082**2)
    for corner in [(0, -0.016), (cut, 0.0082), (0.0032, 0.0082), (0.0032, 0.0274), (0, 0.0274)]:
        assert np.min(np.abs(profile - corner).max(axis=1)) < 1e-15
    on_sphere = profile[:-3]
    assert np.hypot(*on_sphere.T) == pytest.approx(0.016, rel=1e-13)
    with pytest.raises(TopError, match="5 \\(the corners\\)"):
        PAPER.profile(4)


def test_stem_of_the_paper():
    """The end of the stem meets the table, for a circle of radius 0.2 R at 1.7125 R above O, near 119 degrees."""
    assert degrees(PAPER.touch_angle) == pytest.approx(119, abs=0.5)
    theta = PAPER.touch_angle
    assert 0.0032 * sin(theta) - 0.0274 * cos(theta) == pytest.approx(0.016, rel=1e-12)


@pytest.mark.parametrize("name", SHAPES)
def test_touch_angle_by_tilting(name):
    """Tilt the outline: before the angle only the sphere is lowest, after it something else is (or its edge)."""
    shape = SHAPES[name]
    points = shape.profile(6000) / shape.R
    on_sphere = abs(np.hypot(*points.T) - 1) < 1e-9
    off, end = points[~on_sphere], np.arctan2(*(points[on_sphere] * [1, -1]).T).max()
    if shape.touch_angle is None:
        assert end == pytest.approx(pi)
        return
    before, after = shape.touch_angle - 1e-3, shape.touch_angle + 1e-3
    assert before < end
    assert lowest(off, before) < 1
    assert lowest(off, after) > 1 or after > end


def lowest(points, theta):
    """How far below O the lowest of the points is when the top leans by theta, in R."""
    return (points * [sin(theta), -cos(theta)]).sum(axis=1).max()


@pytest.mark.parametrize("share", [0.1, 0.5, 1.0])
def test_a_rounded_stem(share):
    """Its mass by Pappus, its touch by the lowest point of all of its outline, and what is kept of it."""
    b = share * PAPER.r
    shape, q = replace(PAPER, rounding=b), PAPER.r - b
    taken = pi * b * PAPER.r**2 - pi * (q * q * b + q * pi * b * b / 2 + 2 * b**3 / 3)
    assert PAPER.form.volume - shape.form.volume == pytest.approx(taken, rel=0.01)
    assert shape.mass == pytest.approx(PAPER.M, rel=1e-12)
    angle, points = shape.touch_angle, shape.profile(1000)
    assert lowest(points, angle - 1e-3) == pytest.approx(shape.R, rel=1e-5)
    if share < 1:  # else the cut's rim is the first
        assert lowest(points, angle + 1e-2) > shape.R * (1 + 1e-4)
        assert shape.edge == pytest.approx((q / shape.R, (shape.c + shape.l - b) / shape.R, b / shape.R))
    assert load_top(save_top(shape)) == shape
    assert "rounding" not in save_top(PAPER)  # as before there was one
    for bad in (-1e-4, 1.01 * PAPER.r, float("nan")):
        with pytest.raises(TopError, match="rounding"):
            replace(PAPER, rounding=bad)


def test_round_end_touches():
    """A ball of radius b on a ball of radius R, centres e apart: both touch where the table is tangent to both."""
    R, b, e = 0.02, 0.015, 0.03
    shape = Turned(R=R, solid=zone(R, -R, 0.01) + cylinder(0.008, 0.01, 0.02) + zone(b, 0.02, e + b, e))
    assert shape.touch_angle == pytest.approx(pi - acos((R - b) / e), rel=1e-12)


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
    # every directed edge once, and its reverse once: two triangles an edge, turned alike
    assert set(edges.values()) == {1}
    assert all((b, a) in edges for a, b in edges)
    wound = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]).astype(float)
    wound /= np.linalg.norm(wound, axis=1, keepdims=True)
    assert np.einsum("ni,ni->n", wound, normals).min() > 0.99
    assert mesh_moments(corners)[0] > 0


@pytest.mark.parametrize("name", SOLID)
def test_stl_is_closed_and_outward(name):
    assert_closed_and_outward(*read_stl(SOLID[name].stl(48)))


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
    if name in ("Loaded sphere", "vase"):  # a mesh knows one density
        pieces = shape.solid.slices[:1] if name == "Loaded sphere" else shape.solid.slices
        solid = type(shape.solid)(tuple(replace(piece, density=1.0) for piece in pieces))
    else:
        solid = (1 / max(piece.density for piece in shape.solid.slices)) * shape.solid
    expected = np.array([solid.mass * 1e9, solid.com * 1e3, solid.I1 * 1e15, solid.I3 * 1e15])
    coarse, fine = (np.array(mesh_moments(read_stl(shape.stl(sides))[1])) for sides in (128, 256))
    limit = fine + (fine - coarse) / 3
    assert limit[[0, 2, 3]] == pytest.approx(expected[[0, 2, 3]], rel=2e-5)
    assert limit[1] == pytest.approx(expected[1], abs=2e-5 * 1e3 * shape.R)
    assert abs(fine[0] / expected[0] - 1) < 0.3 * abs(coarse[0] / expected[0] - 1)


# --- rocking ---


def simulated_period(top, amplitude):
    """Period of the body released at rest at theta = amplitude: twice the time from one upright to the next."""
    body, start = rb.Body.of(top), rb.euler_quaternion(0, amplitude, 0)

    def tilt(t):
        return float(rb.integrate(body, start, np.zeros(3), [0, t]).quaternion[-1, 0])

    guess = 2 * pi * sqrt((top.I1 + (1 - top.a) ** 2) / top.a)
    passes = [brentq(tilt, at * 0.95 * guess, at * 1.05 * guess, xtol=1e-13, rtol=1e-14) for at in (0.25, 0.75)]
    return 2 * (passes[1] - passes[0])


@pytest.mark.slow
@pytest.mark.parametrize("name", ["The paper's tippe top", "Top S", "Loaded sphere", "cavity"])
def test_rocking_period_is_the_rolling_bodys_for_small_swings(name):
    """The full body's period tends to the formula's as the square of the amplitude."""
    top = SHAPES[name].top
    gaps = np.array([simulated_period(top, amplitude) / rocking_period(top) - 1 for amplitude in (0.08, 0.04, 0.02)])
    assert gaps[:-1] / gaps[1:] == pytest.approx(4, rel=0.01)
    # twice extrapolated: amplitude^2, then amplitude^4
    once = (4 * gaps[1:] - gaps[:-1]) / 3
    assert (16 * once[1] - once[0]) / 15 == pytest.approx(0, abs=1e-10)


@given(st.floats(0.001, 0.95), st.floats(0.05, 0.8), st.floats(0.005, 0.1))
def test_a_from_the_period(a, I1, R):
    top = Top(a, I1, I1)
    scales = Scales(R=R, M=1.0)
    found = a_from_rocking(T=rocking_period(top) * scales.time, R=R, I1=I1)
    assert found.value == pytest.approx(a, rel=1e-9)


def test_uncertainty_of_a_is_the_spread_of_many_measurements():
    rng = np.random.default_rng(1)
    errors = {"T": 0.01, "R": 5e-5, "I1": 0.004, "g": 0.01}
    values = {"T": 1.08, "R": 0.016, "I1": 0.399, "g": 9.81}
    found = a_from_rocking(**values, **{"d" + name: error for name, error in errors.items()})
    draws = [{name: rng.normal(values[name], errors[name]) for name in values} for _ in range(20000)]
    drawn = [a_from_rocking(**draw).value for draw in draws]
    assert found.value == pytest.approx(np.mean(drawn), abs=0.03 * np.std(drawn))
    assert found.uncertainty == pytest.approx(np.std(drawn), rel=0.03)
    assert found.shares["T"] == max(found.shares.values())
    for name in values:
        one = [a_from_rocking(**values | {name: rng.normal(values[name], errors[name])}).value for _ in range(5000)]
        assert found.shares[name] == pytest.approx(np.std(one), rel=0.05)


def test_a_dimension_from_the_period():
    """The depth of a core from the stopwatch, and its uncertainty from two stopwatches."""

    def loaded(d):
        return LoadedSphere(R=0.02, b=0.008, d=d, density=1190.0, core_density=7850.0)

    T = rocking_period(loaded(0.0071).top) * loaded(0.0071).scales.time
    found = dimension_from_rocking(loaded, T=T, dT=0.002, low=0.0, high=0.0119)
    assert found.value == pytest.approx(0.0071, rel=1e-10)
    apart = [dimension_from_rocking(loaded, T=T + dT, low=0.0, high=0.0119).value for dT in (-0.002, 0.002)]
    assert found.uncertainty == pytest.approx(abs(apart[1] - apart[0]) / 2, rel=0.01)
    with pytest.raises(TopError, match=r"T = 0.2 .* reached once"):
        dimension_from_rocking(loaded, T=0.2, low=0.0, high=0.0119)


def test_rocking_that_cannot_be():
    with pytest.raises(TopError, match="a = 0 "):
        rocking_period(Ball(R=0.02, M=0.04).top)
    with pytest.raises(TopError, match=r"T = 0.1 .* T > 0\.\d+ s"):
        a_from_rocking(T=0.1, R=0.016, I1=0.4)
    with pytest.raises(TopError, match="dT = -1"):
        a_from_rocking(T=1.0, R=0.016, I1=0.4, dT=-1)
    with pytest.raises(TopError, match="low = 0 "):
        dimension_from_rocking(lambda d: Ball(R=0.02, M=0.04), T=1.0, low=0.0, high=1.0)


# --- what is refused ---

GOOD = {"R": 0.016, "c": 0.0082, "l": 0.0192, "r": 0.0032, "M": 0.0115}
PEG = {"R": 0.002, "h": 0.01, "r1": 0.02, "r2": 0.02, "t": 0.004, "r": 0.002, "l": 0.01, "M": 0.02}
CORE = {"R": 0.02, "b": 0.008, "d": 0.01, "density": 700.0, "core_density": 7800.0}
SPHERE = {"R": 0.02, "M": 0.02, "a": 0.3, "I1": 0.37, "I3": 0.4}
TOY = {"R": 0.015, "M": 0.006, "a": 0.2, "I1": 0.593, "I3": 0.519, "r": 0.005, "h": 0.013}


@pytest.mark.parametrize(
    ("kind", "good", "name", "value"),
    [
        (TruncatedSphere, GOOD, "R", 0.0), (TruncatedSphere, GOOD, "R", -0.016), (TruncatedSphere, GOOD, "R", np.nan),
        (TruncatedSphere, GOOD, "R", 1e9), (TruncatedSphere, GOOD, "R", 1e-9), (TruncatedSphere, GOOD, "c", 0.017),
        (TruncatedSphere, GOOD, "c", -0.016), (TruncatedSphere, GOOD, "l", -0.01), (TruncatedSphere, GOOD, "l", 0.0),
        (TruncatedSphere, GOOD, "l", np.inf), (TruncatedSphere, GOOD, "r", 0.0145), (TruncatedSphere, GOOD, "r", 0.0),
        (TruncatedSphere, GOOD, "r", "thick"), (TruncatedSphere, GOOD, "M", 0.0), (TruncatedSphere, GOOD, "M", 1e9),
        (OrdinaryTop, PEG, "h", -0.001), (OrdinaryTop, PEG, "r1", 0.0), (OrdinaryTop, PEG, "r2", 0.001),
        (OrdinaryTop, PEG, "t", 0.0), (OrdinaryTop, PEG, "r", 0.03), (OrdinaryTop, PEG, "l", 0.0),
        (LoadedSphere, CORE, "b", 0.02), (LoadedSphere, CORE, "d", 0.012), (LoadedSphere, CORE, "d", -0.013),
        (LoadedSphere, CORE, "density", 0.0), (LoadedSphere, CORE, "core_density", -1.0),
        (BareSphere, SPHERE, "a", 0.9), (BareSphere, SPHERE, "a", 1.5), (BareSphere, SPHERE, "I1", 0.9),
        (BareSphere, SPHERE, "I3", 0.8), (BareSphere, SPHERE, "M", -1.0),
        (StemmedSphere, TOY, "r", 0.0), (StemmedSphere, TOY, "r", 0.016), (StemmedSphere, TOY, "h", 0.02),
        (StemmedSphere, TOY, "h", 0.009), (StemmedSphere, TOY, "a", 0.9), (StemmedSphere, TOY, "I1", 1.3),
        (Ball, {"R": 0.02, "M": 0.04}, "M", None),
    ],
)  # fmt: skip
def test_impossible_bodies_are_named(kind, good, name, value):
    kind(**good)
    with pytest.raises(TopError) as raised:
        kind(**good | {name: value})
    # a stem is too thick for its face, or the face too small for its stem
    assert raised.value.name == ("r" if (name, value) == ("r2", 0.001) else name)
    assert raised.value.allowed and str(raised.value).endswith(".")


@pytest.mark.parametrize(
    ("make", "name"),
    [
        (lambda: Lathe(R=0.005, points=(), density=700.0), "points"),
        (lambda: Lathe(R=0.005, points=((0.003, -0.006),), density=700.0), "points[0] height"),
        (lambda: Lathe(R=0.005, points=((0.003, -0.005),), density=700.0), "points[0] height"),
        (lambda: Lathe(R=0.005, points=((0.01, 0.0), (0.01, -0.001)), density=700.0), "points[1] height"),
        (lambda: Lathe(R=0.005, points=((0.01, 0.0), (-0.01, 0.001)), density=700.0), "points[1] radius"),
        (lambda: Lathe(R=0.005, points=((0.01, 0.0), (0.01, np.nan)), density=700.0), "points[1]"),
        (lambda: Lathe(R=0.005, points=((0.01, 0.0), (0.01,)), density=700.0), "points[1]"),
        (lambda: Lathe(R=0.005, points=((0.01, 0.0), (0.01, 0.01)), density=(700.0,)), "density"),
        (lambda: Lathe(R=0.005, points=((0.01, 0.0), (0.01, 0.01)), density=(700.0, 0.0)), "density[1]"),
        (lambda: Lathe(R=0.005, points=((0.01, 0.0),), density=-1.0), "density"),
        (lambda: Lathe(R=0.005, points=((0.0, 0.005), (0.0, 0.006), (0.01, 0.007)), density=1.0), "points"),
        (lambda: Lathe(R=0.005, points=((0.01, 0.0), (0.0, 0.01), (0.01, 0.02)), density=1.0), "points"),
        (lambda: Turned(R=0.1, solid=ball(0.1) - frustum(0.1, 0.02, 0.0, 0.03) + cylinder(0.02, 0.0, 0.05)), "solid"),
        (lambda: Ball(R=0.02, M=0.04) - 9000 * ball(0.01), "density"),
        (lambda: PAPER - PAPER.density * ball(0.001, -0.0165), "density"),
        (lambda: PAPER + 700 * ball(0.002, 0.05), "solid"),
        (lambda: PAPER + 700 * cylinder(0.01, -0.02, 0), "R"),
        (lambda: Turned(R=0.01, solid=700 * ball(0.02)), "R"),
        (lambda: Turned(R=0.01, solid=700 * cylinder(0.01, -0.01, 0.01)), "R"),
        (lambda: Turned(R=0.01, solid="ball"), "solid"),
        (lambda: zone(0.01, -0.02, 0.0), "low"),
        (lambda: zone(-0.01, -0.01, 0.01), "R"),
        (lambda: cylinder(0.01, 0.02, 0.01), "high"),
        (lambda: frustum(0.01, -0.01, 0.0, 0.01), "r_high"),
        (lambda: SHAPES["Top S"].stl(), "shape"),
        (lambda: PAPER.stl(2), "sides"),
        (lambda: PAPER.with_mass(0.0), "M"),
        (lambda: TruncatedSphere.from_density(-1.0, R=0.016, c=0.0, l=0.0, r=0.0), "density"),
    ],
)  # fmt: skip
def test_impossible_profiles_and_solids_are_named(make, name):
    with pytest.raises(TopError) as raised:
        make()
    assert raised.value.name == name


# --- files ---


@pytest.mark.parametrize("name", SHAPES)
def test_a_saved_top_comes_back(name):
    text = save_top(SHAPES[name])
    assert load_top(text) == SHAPES[name]
    assert load_top(text.encode()) == SHAPES[name]
    document = json.loads(text)
    assert (document["schema"], document["version"]) == ("tippe-top-explorer/top", 1)
    assert len(text) < 4000


@given(st.floats(1e-2, 1), st.floats(-0.99, 1), st.floats(1e-3, 5), st.floats(1e-3, 1), st.floats(1e-4, 10))
def test_any_truncated_sphere_comes_back(R, c, l, share, M):
    r = share * R * cos(asin(c))
    shape = TruncatedSphere(R=R, c=c * R, l=0.0 if r < 1e-6 * R else l, r=0.0 if r < 1e-6 * R else r, M=M)
    assert load_top(save_top(shape)) == shape


def changed(**changes):
    document = json.loads(save_top(PAPER))
    for name, value in changes.items():
        where = document if name in document else document["dimensions"]
        where[name] = value
    return json.dumps(document)


SHALLOW, DEEP = '{"a":' * 500 + "1" + "}" * 500, "[" * 60_000


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("", "file"), ("nonsense", "file"), ("null", "file"), ("[]", "file"), ("3", "file"), ("{}", "schema"),
        (b"\xff\xfe\x00", "file"), (b"\x89PNG\r\n", "file"), (DEEP, "file"), (" " * 70_000, "file"), (SHALLOW, "a"),
        (None, "file"), (7, "file"),
        (changed(schema="other"), "schema"), (changed(schema=None), "schema"), (changed(schema=["x" * 500]), "schema"),
        (changed(version=2), "version"), (changed(version="1"), "version"), (changed(version=True), "version"),
        (changed(kind="os.system"), "kind"), (changed(kind=["Ball"]), "kind"), (changed(kind="Shape"), "kind"),
        (changed(kind="LoadedSphere"), "c"), (changed(kind="Ball"), "c"), (changed(dimensions=[]), "dimensions"),
        (changed(dimensions={}), "R"), (changed(colour="red"), "colour"), (changed(__class__="x"), "__class__"),
        (changed(r=None), "r"), (changed(r="0.003"), "r"), (changed(r=True), "r"), (changed(r=[0.003]), "r"),
        (changed(r=0.5), "r"), (changed(R=-0.016), "R"), (changed(c=0.02), "c"), (changed(M=0), "M"),
        (changed(M={"__reduce__": 1}), "M"),
        (changed(r=1).replace('"r": 1', '"r": NaN'), "r"), (changed(r=1).replace('"r": 1', '"r": -Infinity'), "r"),
        (changed(r=1).replace('"r": 1', '"r": 1e999'), "r"),
        (changed(r=1).replace('"r": 1', '"r": ' + "9" * 5000), "r"),
        (changed(r=1).replace('"r": 1', '"r": 0.001, "r": 0.002'), "r"),
        (save_top(VASE).replace("0.018", '"0.018"'), "points[1]"),
        (save_top(VASE).replace("7800.0", "[7800.0]"), "density[0]"),
        (save_top(BORED).replace('"Zone"', '"Torus"', 1), "solid[0].piece"),
        (save_top(BORED).replace('"centre"', '"middle"', 1), "middle"),
        (save_top(BORED).replace('"low": -0.016', '"low": -0.018', 1), "solid[0].low"),
    ],
    ids=lambda value: repr(value)[:40] if not isinstance(value, str) else value[:24] + str(len(value)),
)  # fmt: skip
def test_hostile_files_are_refused_by_name(text, name):
    with pytest.raises(TopError) as raised:
        load_top(text)
    assert raised.value.name == name
    assert len(str(raised.value)) < 500


json_values = st.recursive(
    st.none() | st.booleans() | st.floats() | st.integers() | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=5), inner, max_size=3),
    max_leaves=8,
)


@given(st.sampled_from(sorted(SHAPES)), st.data())
def test_a_file_with_anything_in_a_field_is_a_top_or_a_TopError(name, data):
    document = json.loads(save_top(SHAPES[name]))
    field = data.draw(st.sampled_from(sorted(document["dimensions"])))
    document["dimensions"][field] = data.draw(json_values)
    try:
        shape = load_top(json.dumps(document))
    except TopError as error:
        assert str(error)
    else:
        assert shape.mass > 0
        shape.profile(500)


@given(st.binary(max_size=200) | st.text(max_size=200))
def test_random_bytes_are_refused(data):
    with pytest.raises(TopError):
        load_top(data)
