"""The dimensions of the body in its section, as in a technical drawing: a line between two points, and the number."""

import math

from bokeh.models import ColumnDataSource, Scatter, Segment, Text

from app.model.build.dimensions import value_of
from app.model.build.measures import measures
from app.model.colours import COLOURS, FAINT, INK
from app.text import say
from app.widgets.numbers import tidy
from app.widgets.plots import PAPER, draw

COLUMN, STEP = 0.10, 0.035  # relative to the figure: from the body to the first of the heights, and between two of them
ALONG = 0.75  # of a slanted line: where its length is written, clear of G
SIZE = 7  # px, the head of an arrow


class Dimensioned:
    """Draws them in fig, the Section's figure."""

    def __init__(self, fig):
        self.lines = ColumnDataSource({name: [] for name in ("x", "z", "x1", "z1", "colour", "width")})
        self.tips = ColumnDataSource({name: [] for name in ("x", "z", "angle", "colour")})
        # the dragged one has a Text of its own: the look of the page can change one colour, not a column of them
        self.said, self.held = (
            ColumnDataSource({name: [] for name in ("x", "z", "text", "dx", "dy", "align")}) for _ in range(2)
        )
        draw(fig, Segment, source=self.lines, x0="x", y0="z", x1="x1", y1="z1", line_color="colour", line_width="width")
        draw(fig, Scatter, "x", "z", source=self.tips, marker="triangle", size=SIZE, angle="angle",
             fill_color="colour", line_color=None)  # fmt: skip
        for source, colour in ((self.said, INK), (self.held, COLOURS["accent"])):
            draw(fig, Text, "x", "z", source=source, text="text", x_offset="dx", y_offset="dy", text_color=colour,
                 text_align="align", text_baseline="middle", text_font_size="12px", text_font_style="bold",
                 background_fill_color=PAPER, background_fill_alpha=0.8, padding=2)  # fmt: skip

    def show(self, shape, dimensions, held, wide, span):
        """Draws the measures of a shape; dimensions: those of a Draft; held: the name of the one being dragged; wide:
        the half-width of the body, mm; span: that of the figure."""
        known = {dimension.name: dimension for dimension in dimensions}
        lines, tips, words, heights = [], [], {False: [], True: []}, 0
        for measure in measures(shape):
            dimension = known.get(measure.name)
            if dimension is None or not (measure.is_shown or measure.name == held):
                continue
            (x, z), (x1, z1) = ((1e3 * a, 1e3 * b) for a, b in (measure.start, measure.end))
            colour, thick = (COLOURS["accent"], 2) if measure.name == held else (FAINT, 1)
            said = words[measure.name == held]
            text = self._text(dimension, value_of(shape, measure.name))
            if measure.is_left:
                at = -wide - STEP * span
                lines += [(x, z, at, z, FAINT, 0.5), (x1, z1, at, z1, FAINT, 0.5), (at, z, at, z1, colour, thick)]
                tips += [(at, max(z, z1), 0, colour), (at, min(z, z1), math.pi, colour)]
                said.append((at, (z + z1) / 2, text.replace(" ", "\n", 1), -6, 0, "right"))
            elif measure.is_height:
                at = wide + (COLUMN + STEP * (heights % 2)) * span
                heights += 1
                lines += [(x, z, at, z, FAINT, 0.5), (x1, z1, at, z1, FAINT, 0.5), (at, z, at, z1, colour, thick)]
                up = 0 if z1 > z else math.pi
                tips += [(at, z1, up, colour), (at, z, math.pi - up, colour)]
                said.append((at, (z + z1) / 2, text.replace(" ", "\n", 1), 6, 0, "left"))
            else:
                lines.append((x, z, x1, z1, colour, thick))
                left, up = x1 < x, z1 > z
                said.append((x1, z1, text, -12 if left else 12, -8 if up else 0, "right" if left else "left")
                            if measure.is_outside
                            else (x + ALONG * (x1 - x), z + ALONG * (z1 - z), text, 0, 0, "center"))  # fmt: skip
        drawn = (self.lines, lines), (self.tips, tips), (self.said, words[False]), (self.held, words[True])
        for source, rows in drawn:
            source.data = {name: [row[i] for row in rows] for i, name in enumerate(source.column_names)}

    @staticmethod
    def _text(dimension, value):
        name = say(f"build.short.{dimension.key}")
        return f"{name} {tidy(value * dimension.factor)} {dimension.unit}".strip()
