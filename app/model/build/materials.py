"""Materials of which a top can be made, each known by its density alone."""

from types import MappingProxyType

from tippe_core import Shape
from tippe_core.bodies import STEEL

MATERIALS = MappingProxyType({"lime": 535.0, "oak": 675.0, "beech": 710.0, "acrylic": 1190.0, "steel": STEEL})
"""{name, a key in build.toml: density, kg/m^3}. The woods: European lime, English oak and European beech, the average
dried weights of The Wood Database (wood-database.com). The acrylic is that of the presets, as in data sheets of cast
PMMA (ISO 1183). The steel is that of a disc."""

SAME = 0.5  # kg/m^3: no difference in the number that is shown


def density_of(shape: Shape) -> float | None:
    """The density that a material sets (of a loaded sphere: of what is around its core), kg/m^3; None if there is none,
    or one for each piece."""
    density = getattr(shape, "density", None)
    return float(density) if isinstance(density, int | float) else None


def material(shape: Shape) -> str:
    """The material with that density, one of MATERIALS, or ""."""
    density = density_of(shape)
    if density is None:
        return ""
    return next((name for name, of_it in MATERIALS.items() if abs(of_it - density) < SAME), "")
