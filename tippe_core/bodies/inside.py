"""What a truncated sphere can have inside: a hole turned into its cut, around the stem, and a disc of steel in it."""

from math import inf, pi, sqrt

from ..errors import TopError
from .ranges import SMALLEST, in_range

STEEL = 7850.0  # kg/m^3


def check_hole(R: float, c: float, r: float, hole: float, depth: float) -> None:
    """Raises TopError unless a hole of this radius, so deep below the cut at c, leaves a wall around and a floor."""
    if not _given(hole=hole, depth=depth):
        return
    in_range("depth", depth, SMALLEST, c + R, "m", below=True, code="hole-too-deep",
             why="or it goes through the bottom")  # fmt: skip
    # the sphere is wider between its floor and the cut
    wide = min(across(R, c), across(R, c - depth))
    in_range("hole", hole, r, wide, "m", above=True, below=True, code="hole-too-wide",
             why="wider than the stem, and a wall is left around it")  # fmt: skip


def check_disc(R: float, below: float, M: float, disc: float, thickness: float, height: float) -> None:
    """Raises TopError unless the steel disc is lighter than the whole and in the wood: its lower face at a height above
    the sphere's lowest point, its upper one not above `below`."""
    if not _given(disc=disc, thickness=thickness, height=height):
        return
    room, why = below + R, "or the disc sticks out"
    in_range("height", height, 0, room, "m", above=True, below=True, code="disc-sticks-out", why=why)
    in_range("thickness", thickness, 0, room - height, "m", above=True, code="disc-sticks-out", why=why)
    wide = min(across(R, height - R), across(R, height + thickness - R))
    in_range("disc", disc, 0, wide, "m", above=True, below=True, code="disc-sticks-out", why=why)
    mass = STEEL * volume_of_disc(disc, thickness)
    in_range("M", M, mass, inf, "kg", above=True, code="lighter-than-its-disc", why="more than the disc alone")


def across(R: float, z: float) -> float:
    """The radius of the circle in which a plane at the height z above O cuts the sphere of radius R about O; 0 beyond
    the sphere."""
    return sqrt(max((R - z) * (R + z), 0.0))


def volume_of_disc(disc: float, thickness: float) -> float:
    """pi r^2 h of a disc, also of one that cannot be."""
    return pi * disc**2 * thickness


def _given(**sizes: float) -> bool:
    """Whether there is such a part; a TopError where some of its sizes are 0 and others are not."""
    missing = [name for name, size in sizes.items() if size == 0]
    if missing and len(missing) < len(sizes):
        code, remedy = "half-a-disc", "A disc has a radius, a thickness and a height; with all 0 there is none."
        if "hole" in sizes:
            code, remedy = "half-a-hole", "A hole has a radius and a depth; with both 0 there is none."
        raise TopError(missing[0], 0.0, "{range} ({unit})", remedy, code=code, range=f"{missing[0]} > 0", unit="m")
    return not missing
