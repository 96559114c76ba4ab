"""What the browser draws of the Lab."""

import param

from app.bundle import Bundled
from app.model.lab.allowed import LIMITS
from app.model.playing import Playing
from app.state.names import LEVELS
from app.text import listed, say


def capital(words):
    return words[0].upper() + words[1:]


def inputs(language=None):
    """{input: its words}, as at the head of a control."""
    known = listed("controls.inputs", language)
    return {name: known[name] | {"name": capital(known[name]["name"])} for name in LIMITS}


class LabView(Bundled, Playing):
    """The whole tab: the top on its table, the tilt over time, what happens and why, a figure that answers, and the
    controls of the start.

    For each table it has the frames of the motion, as `pack_frames` packs them, and its curves: float32 rows of the
    time (s), the tilt (degrees), the height of G, the energy and the heat so far (as mm of height), the spin about the
    top's own axis and its rotation seen from above (rev/s), and the code of the regime; for all three side by side
    also what it conserves, float32 rows as of app.model.keeps. All are empty if there is no such motion. The browser
    writes what is of Playing; what is shown with the top is as of a Top3D, at the level "Research".
    """

    SAYS = ("Stage", "Top3D", "NumberControls")
    REGIMES = "here"

    # JSON, because Panel and Bokeh search each part of a dict again and again, which was a quarter of a move
    state = param.String(default="{}", doc="The inputs, what was refused, the progress of the present run.")
    told = param.String(default="{}", doc="The inputs of what is shown, and its runs in words.")
    profile = param.Bytes(default=b"", doc="As of a Top3D.")
    a = param.Number(default=0.0, doc="G's distance below O, in R.")
    seconds = param.Number(default=1.0, bounds=(0, None), doc="Seconds of the real top in one unit of time.")
    frames_ordinary = param.Bytes(default=b"")
    frames_rough = param.Bytes(default=b"")
    frames_ice = param.Bytes(default=b"")
    curves_ordinary = param.Bytes(default=b"")
    curves_rough = param.Bytes(default=b"")
    curves_ice = param.Bytes(default=b"")
    keeps_ordinary = param.Bytes(default=b"")
    keeps_rough = param.Bytes(default=b"")
    keeps_ice = param.Bytes(default=b"")
    level = param.String(default=LEVELS[0], doc="How much the page shows: one of LEVELS.")
    request = param.List(
        default=[], doc="[count, name, value] of a request; state tells the last count that was answered. The names "
        "are a Lab's inputs; example: one of EXAMPLES; research: the paper's figures; why, why_not: a place of Learn."
    )  # fmt: skip

    @classmethod
    def says(cls, language=None):
        more = {name: listed(f"planes.{name}", language) for name in ("law", "landing", "presets")}
        alone = {name: say(f"planes.{key}", language) for name, key in (
            ("stem", "stem.can"), ("caught", "caught"), ("lands", "keys.lands"), ("example", "example"))}  # fmt: skip
        return super().says(language) | listed("lab_view.view", language) | {
            "more": more | alone, "inputs": inputs(language)}  # fmt: skip
