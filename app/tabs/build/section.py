"""The section of the body that is being built, along axis 3, with handles and its dimensions as in a technical
drawing."""

import json

import numpy as np
import param

from app.bundle import Bundled
from app.model.bodies import body
from app.model.build.dimensions import handles, pulled, value_of
from app.model.build.measures import measures
from app.state import validate
from app.text import listed, say
from app.widgets.forms import hear, one_of
from app.widgets.numbers import tidy
from tippe_core import LoadedSphere, TruncatedSphere, Turned

FINE = 4  # digits of a length in mm


class SectionView(Bundled):
    """The drawing, whose handles are grabbed in the browser. Lengths in mm: x from axis 3, z above O along it."""

    state = param.String(
        default="{}",
        doc="JSON. R: radius of the ball; com: z of G; parts: {body, hollow, core}, each a list of half outlines "
        "[[x, z]]; measures: name, start, end, where it is drawn, and what it says; handles: {dimension: [x, z, "
        "[name, what it says], value, least, largest]}; free: whether a double click adds a point.",
    )
    hand = param.List(default=[], doc="[dimension, x, z] of a hand on a handle.")
    tapped = param.List(default=[], doc="[count, dimension, x, z] of a double click; dimension: empty beside all.")

    @classmethod
    def says(cls, language=None):
        return super().says(language) | {"label": listed("roll.figures", language)["section"]}


class Section:
    """pull: called with (dimension, value in SI) by a hand; tap: with (dimension or "", x, z in m) for a double
    click."""

    def __init__(self, pull, tap=None):
        self._pull, self._tap, self._shape = pull, tap, None
        self.last_point = None  # index of the point of a Lathe that was dragged last
        self.view = SectionView(sizing_mode="stretch_width", margin=0)
        hear(self.view, hand=self._pulled, tapped=self._tapped)

    def _pulled(self, event):
        name, x, z = validate.parts(event.new, one_of(handles(self._shape)), validate.number, validate.number)
        if name.startswith("point "):
            self.last_point = int(name[6:])
        self._pull(name, pulled(self._shape, name, x / 1e3, z / 1e3))

    def _tapped(self, event):
        named = one_of({"", *handles(self._shape)})  # not of a body that is no longer there
        _, name, x, z = validate.parts(event.new, validate.number, named, validate.number, validate.number)
        self._tap(name, x / 1e3, z / 1e3)

    def show(self, draft):
        shape = self._shape = draft.shape
        known = {dimension.name: dimension for dimension in draft.dimensions}
        grips = {name: [*_mm(at), *self._readout(known.get(name), at)] for name, at in handles(shape).items()}
        drawn = [measure for measure in measures(shape) if measure.name in known]
        self.view.state = json.dumps({
            "R": _mm(shape.R), "com": _mm(shape.com), "handles": grips, "free": "point 0" in grips,
            "parts": {part: [_mm(outline) for outline in outlines] for part, outlines in parts(shape).items()},
            "measures": [dimensioned(measure, shape, known[measure.name]) for measure in drawn],
        })  # fmt: skip

    def _readout(self, dimension, at):
        """The words of a handle, its value, and its range."""
        if dimension is None:  # a point of a free profile
            x, z = _mm(at)
            return ["", say("build.bench.point", x=tidy(x), z=tidy(z))], z, -z, z
        value = value_of(self._shape, dimension.name) * dimension.factor
        readout = [dimension.words, f"{tidy(value)} {dimension.unit}".strip()]
        return readout, round(value, FINE), dimension.low, dimension.high


def _mm(lengths):
    """In mm, as a number or as lists."""
    return np.round(1e3 * np.asarray(lengths, dtype=float), FINE).tolist()


def dimensioned(measure, shape, dimension):
    """A Measure, and what is written beside it."""
    value = tidy(value_of(shape, measure.name) * dimension.factor)
    return {
        "name": measure.name, "start": _mm(measure.start), "end": _mm(measure.end), "shown": measure.is_shown,
        "at": ("left" if measure.is_left else "right") if measure.is_height else "out" if measure.is_outside else "in",
        "says": [say(f"build.short.{dimension.key}"), f"{value} {dimension.unit}".strip()],
    }  # fmt: skip


def parts(shape):
    """{part of the drawing: half outlines (k, 2) in m}, in drawing order."""
    found = {"body": [shape.R * body(shape)], "hollow": [], "core": []}
    if isinstance(shape, Turned):
        inner = shape.solid.outlines[1:]
        found["hollow"] = [np.vstack([edge.points(24) for edge in outline]) for outline in inner]
    if isinstance(shape, LoadedSphere):
        turn = np.linspace(0, np.pi, 37)
        core = np.column_stack([shape.b * np.sin(turn), shape.b * np.cos(turn) - shape.d])
        found["core" if shape.core_density else "hollow"].append(core)
    if isinstance(shape, TruncatedSphere) and shape.disc:
        low, wide = shape.height - shape.R, shape.disc
        high = low + shape.thickness
        found["core"].append(np.array([(0, low), (wide, low), (wide, high), (0, high)]))
    return found
