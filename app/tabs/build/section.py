"""The section of the body that is being built, along axis 3, with handles."""

import math

import numpy as np
from bokeh.models import ColumnDataSource, HoverTool, MultiLine, Patch, Range1d, Scatter, Span, Text

from app.bundle import call
from app.model.bodies import body
from app.model.build.dimensions import handles, pulled, value_of
from app.model.colours import COLOURS, FAINT, INK
from app.tabs.build.dimensioned import Dimensioned
from app.text import say
from app.widgets.numbers import tidy
from app.widgets.plots import PAPER, draw, plain
from tippe_core import LoadedSphere, TruncatedSphere, Turned

PARTS = {"body": "#d9b98c", "hollow": PAPER, "core": "#8a96a3"}  # of the section, in drawing order
FRAME = 276  # px, until the browser has reported the size; square, so that both axes have the same scale
BORDERS = {"left": 40, "right": 10, "above": 20, "below": 30}  # px; both sums are equal, because the figure is square
ROOM = 1.9  # widths of a body, including its dimensions beside it
ASIDE = 0.06  # of the width, by which the view extends further to the right, where the heights are written
REACH = 16  # px from a handle within which it can be grabbed


class Section:
    """The section along axis 3, to scale in mm, with handles. pull: called with (dimension, value in SI) by a hand."""

    def __init__(self, pull):
        self._pull, self._held, self._shape, self._span = pull, None, None, 0.0
        self.last_point = None  # index of the point of a Lathe that was dragged last
        self.figure = fig = plain(x_range=Range1d(-1, 1), y_range=Range1d(-1, 1), name="section")
        borders = {
            f"min_border_{side}": px
            for side, px in zip(("left", "right", "top", "bottom"), BORDERS.values(), strict=True)
        }
        fig.update(sizing_mode="scale_width", aspect_ratio=1, **borders)
        fig.xaxis.ticker.desired_num_ticks = fig.yaxis.ticker.desired_num_ticks = 5
        # One Patch each: of Patches Bokeh 3.10 may draw only as many as there were before.
        self.parts = {part: ColumnDataSource({"x": [], "z": []}) for part in PARTS}
        self.lines = ColumnDataSource({"x": [], "z": [], "colour": [], "dash": [], "width": []})
        self.points = ColumnDataSource({"x": [], "z": [], "colour": []})
        self.letters = ColumnDataSource({"x": [], "z": [], "text": [], "dx": [], "dy": [], "style": []})
        self.handles = ColumnDataSource({"x": [], "z": [], "name": [], "says": []})
        for part, colour in PARTS.items():
            draw(fig, Patch, "x", "z", source=self.parts[part], fill_color=colour, line_color=INK, line_width=1.5)
        self.table = Span(dimension="width", line_color=INK, line_width=2)
        fig.add_layout(self.table)
        draw(fig, MultiLine, xs="x", ys="z", source=self.lines, line_color="colour", line_dash="dash",
             line_width="width")  # fmt: skip
        draw(fig, Scatter, "x", "z", source=self.points, size=8, fill_color="colour", line_color="white")
        draw(fig, Text, "x", "z", text="text", source=self.letters, x_offset="dx", y_offset="dy", text_color=INK,
             text_font_size="15px", text_font_style="style", text_font={"value": "Georgia, serif"},
             text_align="center", text_baseline="middle")  # fmt: skip
        self.measured = Dimensioned(fig)
        knobs = draw(fig, Scatter, "x", "z", source=self.handles, size=14, fill_color="white",
                     line_color=COLOURS["theta"], line_width=3)  # fmt: skip
        fig.add_tools(HoverTool(renderers=[knobs], tooltips="@says", point_policy="snap_to_data"))
        self.pressed = ColumnDataSource({"x": [], "z": []})
        fig.js_on_change("inner_width", call("pressSection", fig=fig, pressed=self.pressed))
        fig.on_event("panstart", self._take)
        fig.on_event("pan", self._drag)
        fig.on_event("panend", self._let_go)

    def _take(self, event):
        pressed = self.pressed.data
        self._held = self.handle_at(pressed["x"][0], pressed["z"][0]) if len(pressed["x"]) else None
        if self._held and self._held.startswith("point "):
            self.last_point = int(self._held[6:])

    def handle_at(self, x, y):
        """The name of the handle that a hand at (x, y) in mm grabs, or None."""
        places = {name: np.hypot(1e3 * across - x, 1e3 * z - y) for name, (across, z) in handles(self._shape).items()}
        nearest = min(places, key=places.get, default=None)
        return nearest if places and places[nearest] < REACH * self._span / (self.figure.inner_width or FRAME) else None

    def _drag(self, event):
        if self._held:
            self._pull(self._held, pulled(self._shape, self._held, event.x / 1e3, event.y / 1e3))

    def _let_go(self, event):
        if self._held:
            self._held = None
            self._frame()

    def show(self, draft):
        shape = self._shape = draft.shape
        profile = 1e3 * shape.R * body(shape)
        R, height = 1e3 * shape.R, 1e3 * shape.com
        if not self._held:
            self._frame()
        span = self._span
        parts = {"body": [profile], "hollow": [1e3 * rows for rows in _cavities(shape)], "core": []}
        turn = np.linspace(0, np.pi, 37)
        if isinstance(shape, LoadedSphere):
            core = np.column_stack([shape.b * np.sin(turn), shape.b * np.cos(turn) - shape.d])
            parts["core" if shape.core_density else "hollow"].append(1e3 * core)
        if isinstance(shape, TruncatedSphere) and shape.disc:
            low, wide = shape.height - shape.R, shape.disc
            high = low + shape.thickness
            parts["core"].append(1e3 * np.array([(0, low), (wide, low), (wide, high), (0, high)]))
        for part, outlines in parts.items():
            x, z = _closed(outlines)
            self.parts[part].data = {"x": x, "z": z}
        low, high = min(-R, profile[:, 1].min()), profile[:, 1].max()
        wide = profile[:, 0].max()
        aside, self.table.location = wide + 0.05 * span, -R
        straight = [
            ((0, 0), (low, high + 0.06 * span), FAINT, [8, 4], 1.5),
            ((-wide - 0.03 * span, wide + 0.03 * span), (height, height), FAINT, [8, 4], 1.5),
            ((aside, aside), (0, height), COLOURS["friction"], [], 3),
            ((0, aside), (0, 0), COLOURS["friction"], [2, 3], 1),
            ((0, aside), (height, height), COLOURS["friction"], [2, 3], 1),
        ]
        sphere = (R * np.sin(2 * turn), R * np.cos(2 * turn), FAINT, [2, 4], 1)
        x, z, colour, dash, thick = zip(sphere, *straight, strict=True)
        self.lines.data = {"x": list(x), "z": list(z), "colour": colour, "dash": list(dash), "width": thick}
        self.points.data = {"x": [0, 0, 0], "z": [0, height, -R], "colour": [INK, COLOURS["friction"], INK]}
        letters = [
            (0, 0, "O", -12, -10, "italic"), (0, height, "G", 14, 10 if height <= 0 else -10, "italic"),
            (0, -R, "C", 0, 14, "italic"),
            (aside, height / 2, "a", 10, 0, "italic"), (0, high + 0.06 * span, "3", 0, -10, "normal"),
            (-wide - 0.03 * span, height, "1", -10, 0, "normal"),
        ]  # fmt: skip
        self.letters.data = dict(zip(("x", "z", "text", "dx", "dy", "style"), zip(*letters, strict=True), strict=True))
        self.measured.show(shape, draft.dimensions, self._held, wide, span)
        said = {dimension.name: dimension for dimension in draft.dimensions}
        at = handles(shape)
        self.handles.data = {
            "x": [1e3 * x for x, _ in at.values()],
            "z": [1e3 * z for _, z in at.values()],
            "name": list(at),
            "says": [f"{said[name].words}: {tidy(value_of(shape, name) * said[name].factor)} {said[name].unit}"
                     if name in said else say("build.bench.point", x=tidy(1e3 * x), z=tidy(1e3 * z))
                     for name, (x, z) in at.items()],
        }  # fmt: skip

    def _frame(self):
        """Ranges that show all of the body, in coarse steps, so that the view does not move all the time."""
        profile = 1e3 * self._shape.R * body(self._shape)
        low, high = profile[:, 1].min(), profile[:, 1].max()
        needed = max(ROOM * 2 * profile[:, 0].max(), 1.3 * (high - low))
        self._span = span = 1.25 ** math.ceil(math.log(needed, 1.25))
        middle = (low + high) / 2
        for axis, centre in ((self.figure.x_range, ASIDE * span), (self.figure.y_range, middle)):
            axis.update(start=centre - span / 2, end=centre + span / 2)


def _closed(outlines):
    """x and z of a Patch for outlines (k, 2) of bodies of revolution, with gaps between them."""
    rows = [np.vstack([half, half[::-1] * (-1, 1), [[np.nan, np.nan]]]) for half in outlines]
    return np.vstack(rows)[:-1].T if rows else np.empty((2, 0))


def _cavities(shape):
    """Closed outlines inside the body, (k, 2) m."""
    if not isinstance(shape, Turned):
        return []
    return [np.vstack([edge.points(24) for edge in outline]) for outline in shape.solid.outlines[1:]]
