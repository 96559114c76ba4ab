"""Shapes: masses and moments compared with other integrations, outlines and STL files read back, rocking, files."""

from dataclasses import fields, replace
from math import acos, cos, degrees, pi, sin, sqrt

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from tippe_core import (
    PRESETS,
    Ball,
    BareSphere,
    Lathe,
    LoadedSphere,
    Scales,
    Top,
    TopError,
    TruncatedSphere,
    Turned,
    ball,
    cylinder,
    frustum,
    load_top,
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
    "no stem": TruncatedSphere(R=0.02, c=0.004, l=0.0, r=0.0, M=0.02),
    "a hole": replace(PAPER, hole=0.009, depth=0.008), "a bowl": TruncatedSphere(
        R=0.02, c=0.004, l=0.0, r=0.0, M=0.02, hole=0.012, depth=0.015),
    "a disc": replace(PAPER, disc=0.004, thickness=0.003, height=0.002),
    "a hole and a disc": TruncatedSphere.from_density(
        720.0, R=0.015, c=0.0116, l=0.0064, r=0.0045, rounding=0.0045, hole=0.009, depth=0.008, disc=0.004,
        thickness=0.003, height=0.002)}  # fmt: skip
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


def hole_density(rho, z):
    shape = SHAPES["a hole"]
    wood = (rho**2 + z**2 < 0.016**2) & (z < 0.0082) & ((rho > 0.009) | (z < 0.0002))
    return shape.density * (wood | ((rho < 0.0032) & (z > 0) & (z < 0.0274)))


def filled_density(rho, z):
    turn = np.linspace(0, pi / 2, 17)  # the facets of its round end
    stem = (z > 0) & (rho < np.interp(z, 0.0135 + 0.0045 * np.sin(turn), 0.0045 * np.cos(turn), right=0))
    wood = (rho**2 + z**2 < 0.015**2) & (z < 0.0116) & ((rho > 0.009) | (z < 0.0036))
    steel = (rho < 0.004) & (z > -0.013) & (z < -0.010)
    return np.where(steel, 7850.0, 720.0 * (wood | stem))


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
    "a hole": (SHAPES["a hole"], hole_density, 0.016, -0.016, 0.0274),
    "a hole and a disc": (SHAPES["a hole and a disc"], filled_density, 0.015, -0.015, 0.018),
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
    filled = getattr(shape, "disc", 0)  # steel, whose density is fixed
    for other in (larger,) if filled else (larger, shape.with_mass(factor * shape.mass)):
        assert (other.top.a, other.top.I1, other.top.I3) == pytest.approx(
            (shape.top.a, shape.top.I1, shape.top.I3), rel=1e-9, abs=1e-12)  # fmt: skip
    assert larger.mass == pytest.approx(factor**3 * shape.mass, rel=1e-10)
    assert larger.volume == pytest.approx(factor**3 * shape.volume, rel=1e-9)
    if not filled:
        assert shape.with_mass(factor * shape.mass).mass == pytest.approx(factor * shape.mass, rel=1e-12)


def test_density_from_mass_and_mass_from_density():
    assert TruncatedSphere.from_density(PAPER.density, R=0.016, c=0.0082, l=0.0192, r=0.0032).M == pytest.approx(0.0115)
    assert Ball.from_density(1190.0, R=0.02).M == pytest.approx(1190 * 4 / 3 * pi * 0.02**3, rel=1e-13)


def test_a_hole_takes_its_wood_and_a_disc_is_steel():
    """What a cylinder takes away is its volume; the steel that comes in weighs its own, whatever the wood does."""
    dimensions = {name: getattr(PAPER, name) for name in ("R", "c", "l", "r")}
    hole, disc = {"hole": 0.009, "depth": 0.008}, {"disc": 0.004, "thickness": 0.003, "height": 0.002}
    drilled, steel = pi * (0.009**2 - 0.0032**2) * 0.008, pi * 0.004**2 * 0.003
    assert replace(PAPER, **hole).volume == pytest.approx(PAPER.volume - drilled, rel=1e-13)
    assert replace(PAPER, **disc).volume == pytest.approx(PAPER.volume, rel=1e-13)
    for density in (300.0, 720.0, 9000.0):
        wood = density * (PAPER.volume - drilled - steel)
        both = TruncatedSphere.from_density(density, **dimensions, **hole, **disc)
        assert (both.density, both.mass) == pytest.approx((density, wood + 7850 * steel), rel=1e-12)
        heavier = both.with_mass(both.mass + 0.001)
        assert heavier.mass - heavier.density * (heavier.volume - steel) == pytest.approx(7850 * steel, rel=1e-11)
    assert TruncatedSphere.from_density(720.0, **dimensions, **hole).M == pytest.approx(
        720 * (PAPER.volume - drilled), rel=1e-12)  # fmt: skip


@given(st.floats(-0.9, 1), st.floats(0, 0.99), st.floats(0.01, 0.99), st.floats(0.01, 0.99), st.floats(0.01, 0.99))
def test_any_hole_around_a_stem_by_shells(c, thin, wide, deep, length):
    """Cylindrical shells again: of the wall, the floor below the hole, and the stem."""
    floor = c - deep * (c + 1)
    most = min(sqrt(1 - c * c), sqrt(1 - floor * floor))
    hole = wide * most
    r = thin * hole
    if r < 1e-6 or hole > most * (1 - 1e-6):
        return
    shape = TruncatedSphere(R=1, c=c, l=length, r=r, M=1, hole=hole, depth=c - floor)

    def high(rho):
        return c + length if rho < r else floor if rho < hole else min(c, sqrt(1 - rho * rho)) if c > 0 else c

    widest = 1.0 if c > 0 else sqrt(1 - c * c)
    breaks = [x for x in (r, hole, sqrt(1 - c * c)) if 0 < x < widest]
    expected = by_shells(lambda rho: -sqrt(1 - rho * rho), high, widest, breaks)
    assert of(shape.form) == pytest.approx(expected, rel=1e-8, abs=1e-9)
    assert len(shape.solid.outlines) == 1


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
    if share < 1:  # otherwise the rim of the cut touches first
        assert lowest(points, angle + 1e-2) > shape.R * (1 + 1e-4)
        assert shape.edge == pytest.approx((q / shape.R, (shape.c + shape.l - b) / shape.R, b / shape.R))
    assert load_top(save_top(shape)) == shape
    assert "rounding" not in save_top(PAPER)  # as in files from before it existed
    for bad in (-1e-4, 1.01 * PAPER.r, float("nan")):
        with pytest.raises(TopError, match="rounding"):
            replace(PAPER, rounding=bad)


def test_round_end_touches():
    """A ball of radius b on a ball of radius R, centres e apart: both touch where the table is tangent to both."""
    R, b, e = 0.02, 0.015, 0.03
    shape = Turned(R=R, solid=zone(R, -R, 0.01) + cylinder(0.008, 0.01, 0.02) + zone(b, 0.02, e + b, e))
    assert shape.touch_angle == pytest.approx(pi - acos((R - b) / e), rel=1e-12)
