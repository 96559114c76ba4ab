"""What a truncated sphere has inside: nothing, a hole around its stem, a disc of steel, or both."""

from dataclasses import fields

from tippe_core import Shape, TruncatedSphere
from tippe_core.bodies import across

HOLE, DISC = ("hole", "depth"), ("disc", "thickness", "height")
INSIDE = (*HOLE, *DISC)
KINDS = {"solid": (), "hole": HOLE, "disc": DISC, "both": INSIDE}
"""{what is inside, a key in build.toml: its dimensions}."""

# The first hole and the first disc: in R, and the least and the largest share of the available room.
TOY = {"hole": 9 / 15, "depth": 8 / 15, "disc": 4 / 15, "thickness": 3 / 15, "height": 2 / 15}
QUARTER, HALF, MOST = 0.25, 0.5, 0.9


def inside(shape: Shape) -> str:
    """One of KINDS; "" for a body that cannot have any of them."""
    if not isinstance(shape, TruncatedSphere):
        return ""
    sizes = tuple(name for name in INSIDE if getattr(shape, name))
    return next(kind for kind, names in KINDS.items() if names == sizes)


def with_inside(shape: TruncatedSphere, **sizes: float) -> TruncatedSphere:
    """The shape in the same wood, with these dimensions of its inside."""
    given = {one.name: getattr(shape, one.name) for one in fields(shape) if one.name != "M"}
    return TruncatedSphere.from_density(shape.density, **given | sizes)


def filled(shape: TruncatedSphere, kind: str) -> TruncatedSphere:
    """The shape with that inside: it keeps what it has of it, and the rest is as in a toy, or smaller."""
    names = KINDS[kind]
    sizes = {name: getattr(shape, name) if name in names else 0.0 for name in INSIDE}
    R, c = shape.R, shape.c
    if "hole" in names and not shape.hole:
        below = sizes["height"] + sizes["thickness"]  # the room that a disc leaves in the sphere
        depth = sizes["depth"] = _mm(min(TOY["depth"] * R, HALF * (c + R - below), HALF * (c + across(R, shape.r))))
        room = min(across(R, c), across(R, c - depth)) - shape.r
        sizes["hole"] = _mm(min(max(TOY["hole"] * R, shape.r + QUARTER * room), shape.r + MOST * room))
    if "disc" in names and not shape.disc:
        room = c + R - sizes["depth"]
        height = sizes["height"] = _mm(min(TOY["height"] * R, QUARTER * room))
        thickness = sizes["thickness"] = _mm(min(TOY["thickness"] * R, HALF * (room - height)))
        wide = min(across(R, height - R), across(R, height + thickness - R))
        sizes["disc"] = _mm(min(TOY["disc"] * R, MOST * wide))
    return with_inside(shape, **sizes)


def inside_handles(shape: TruncatedSphere) -> dict[str, tuple[float, float]]:
    """The handles of its hole and its disc, as in dimensions.handles()."""
    at = {}
    if shape.hole:
        at = {"hole": (-shape.hole, shape.c - shape.depth / 2), "depth": (-(shape.hole + shape.r) / 2, shape.floor)}
    if shape.disc:
        low = shape.height - shape.R
        at |= {"disc": (shape.disc, low + shape.thickness / 2), "height": (0.0, low),
               "thickness": (0.0, low + shape.thickness)}  # fmt: skip
    return at


def inside_pulled(shape: TruncatedSphere, name: str, x: float, z: float) -> float:
    """The value of the dimension for which its handle is nearest to (x, z)."""
    if name == "depth":
        return shape.c - z
    return {"height": z + shape.R, "thickness": z + shape.R - shape.height}.get(name, abs(x))


def _mm(length: float) -> float:
    """The length rounded to 0.01 mm, unless that is zero."""
    return round(length, 5) or length
