"""The letters of dimensions."""

SYMBOLS = {"r1": "<i>r</i><sub>1</sub>", "r2": "<i>r</i><sub>2</sub>", "I1": "<i>I</i><sub>1</sub>",
           "I3": "<i>I</i><sub>3</sub>"}  # fmt: skip
# these have no letter in the paper
WORDS = ("density", "core_density", "rounding", "hole", "depth", "disc", "thickness", "height")


def symbol(name):
    """The letter of a dimension; "" if a word names it."""
    if name.startswith("density ") or name in WORDS:
        return ""
    return SYMBOLS.get(name, f"<i>{name}</i>")
