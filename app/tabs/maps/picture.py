"""Level of a map -> Bokeh: an image of its cells, hatching of mixed cells, lines of closed forms, the bead."""

import numpy as np
from bokeh.models import BoxAnnotation, ColumnDataSource, ImageRGBA, Label, Line, MultiLine, Quad, Scatter, Segment
from bokeh.palettes import Viridis256
from scipy.ndimage import distance_transform_edt

from app.bundle import call
from app.model import ends
from app.model.colours import ACCENT, INK
from app.model.maps.lines import lines
from app.text import listed, say
from app.widgets.plots import draw, on_pointer, plain, rule

CLOCK = "map"  # of the run at the bead: the top in 3-D, and the curve that follows it
# Colours on the cells, which are the same in every look: as numbers, because the look exchanges their names.
DARK, ON_MAP = (f"rgb({', '.join(map(str, bytes.fromhex(colour[1:])))})" for colour in (INK, ACCENT))
DASHES = {"stands": "dashed", "leaves": "dotted", "painleve": "solid", "window_low": "dashdot",
          "window_high": "dotdash"}  # fmt: skip
LEAST_AREA, LEAST_ROOM = 0.06, 0.05  # of the map's area and width: an end with less room is named in the key only
EDGE = 0.25  # of the width
WIDE = 4.0  # a name needs this much more room to the sides than above and below


class MapFigure:
    """The figure; show() fills it. hand: where the browser puts the bead, whether on a clicked cell, or a box."""

    def __init__(self):
        self.figure = fig = plain(say("maps.label"), 440, name="maps", x_range=(0, 1), y_range=(0, 1),
                                  min_border_left=44)  # fmt: skip
        fig.grid.visible = False
        empty = {"image": [], "x": [], "y": [], "w": [], "h": []}
        self.coarse, self.fine = ColumnDataSource(empty), ColumnDataSource(empty)
        for source in (self.coarse, self.fine):
            draw(fig, ImageRGBA, "x", "y", image="image", dw="w", dh="h", source=source)
        self.mixed = ColumnDataSource({"left": [], "right": [], "bottom": [], "top": []})
        self._hatch = draw(fig, Quad, left="left", right="right", bottom="bottom", top="top", source=self.mixed,
                           fill_alpha=0, line_color=None, hatch_pattern="right_diagonal_line", hatch_color=DARK,
                           hatch_alpha=0.55, hatch_scale=7)  # fmt: skip
        self.lines = ColumnDataSource({"xs": [], "ys": [], "dash": []})
        draw(fig, MultiLine, xs="xs", ys="ys", source=self.lines, line_color="#fefefe", line_width=5)
        draw(fig, MultiLine, xs="xs", ys="ys", source=self.lines, line_color=DARK, line_width=2, line_dash="dash")
        self.bead = ColumnDataSource({"x": [0.0], "y": [0.0]})
        line = {"x1": "x", "y1": "y", "line_color": ON_MAP, "line_width": 1.5}
        self._to_axes = [draw(fig, Segment, source=self.bead, **line, **begin)
                         for begin in ({"x0": 0.0, "y0": "y"}, {"x0": "x", "y0": 0.0})]  # fmt: skip
        draw(fig, Scatter, "x", "y", source=self.bead, level="overlay", size=17, fill_color="#fefefe",
             line_color=ON_MAP, line_width=5)  # fmt: skip
        self.words = []
        for _ in ends.NAMES:
            self.words.append(Label(x=0, y=0, text=" ", visible=False, text_align="center", text_baseline="middle",
                                    text_font_size="12px", text_font_style="bold"))  # fmt: skip
            fig.add_layout(self.words[-1])
        self.hand = ColumnDataSource({"x": [0.0], "y": [0.0], "cell": [0]})
        box = BoxAnnotation(left=0, right=0, bottom=0, top=0, visible=False, fill_color=ON_MAP, fill_alpha=0.15,
                            line_color=ON_MAP, line_width=2)  # fmt: skip
        fig.add_layout(box)
        on_pointer(fig, call("pullBead", fig=fig, hand=self.hand, bead=self.bead, box=box))
        fig.js_on_change("inner_width", call("keepFinger", fig=fig, bead=self.bead, hand=self.hand))
        fig.js_on_change("inner_width", call("moveBead", fig=fig, hand=self.hand, bead=self.bead, map=self.fine))

    def begin(self, request):
        """Clears the figure for another map."""
        self.figure.x_range.update(start=request.across_range[0], end=request.across_range[1])
        self.figure.y_range.update(start=request.up_range[0], end=request.up_range[1])
        self._to_axes[0].glyph.x0, self._to_axes[1].glyph.y0 = request.across_range[0], request.up_range[0]
        for source in (self.coarse, self.fine, self.mixed, self.lines):
            source.data = {name: [] for name in source.data}
        for word in self.words:
            word.visible = False

    def show(self, level, colour):
        """Shows a level as far as it is computed; the coarser one stays below until it is complete."""
        left, right, bottom, top = *level.request.across_range, *level.request.up_range
        drawn = {"image": [cells(level, colour)], "x": [left], "y": [bottom], "w": [right - left], "h": [top - bottom]}
        self.fine.data = drawn
        if level.whole:
            self.coarse.data = drawn
            self._name_areas(level, colour)
        self._hatch.glyph.hatch_color = DARK if colour == "end" else "#fefefe"  # visible on the cells
        if level.finest:
            self._mark(level)
            drawn = lines(level.request)
            self.lines.data = {"xs": [line[:, 0] for _, line in drawn], "ys": [line[:, 1] for _, line in drawn],
                               "dash": [DASHES[name] for name, _ in drawn]}  # fmt: skip

    def _mark(self, level):
        rows, columns = np.nonzero(level.mixed)
        wide, high = (half_step(x) for x in (level.x, level.y))
        x, y = level.x[columns], level.y[rows]
        self.mixed.data = {"left": x - wide, "right": x + wide, "bottom": y - high, "top": y + high}

    def _name_areas(self, level, colour):
        named = listed("maps.ends")
        for word, end in zip(self.words, ends.NAMES, strict=True):
            own = level.end == end
            room = _room(own) if colour == "end" and own.mean() >= LEAST_AREA else np.zeros(1)
            if room.max() < LEAST_ROOM * len(level.x):
                word.visible = False
                continue
            i, j = np.unravel_index(np.argmax(room), room.shape)
            x, align = _beside_edge(level, j, room[i, j] - 1)
            word.update(x=x, y=level.y[i], text=named[end], text_align=align,
                        text_color=ends.WORDS_ON.get(end, DARK), visible=True)  # fmt: skip


class RunFigure:
    """The tilt of one run over time, with the time that the stage shows; it can be dragged to another."""

    def __init__(self):
        self.figure = fig = plain(say("maps.label_run"), 200, name="maps-run", x_range=(0, 1), y_range=(0, 180),
                                  min_border_left=44)  # fmt: skip
        fig.yaxis.ticker.desired_num_ticks = 4
        self.source = ColumnDataSource({"t": [], "theta": []})
        draw(fig, Line, "t", "theta", source=self.source, line_color=INK, line_width=2)
        now = rule(fig, "height", line_color=ACCENT, line_width=1.5)
        fig.js_on_change("inner_width", call("moveLines", spans=[now], clock=CLOCK))
        on_pointer(fig, call("seekAlong", clock=CLOCK))

    def show(self, t, theta, seconds):
        self.source.data = {"t": t, "theta": theta}
        self.figure.x_range.end = seconds


def _room(own):
    """How far each cell of an area is from its edge, for a name, which is wide."""
    room = distance_transform_edt(np.pad(own, 1), sampling=(WIDE, 1))[1:-1, 1:-1]
    room[[0, -1]] = 0  # a name there would be cut off
    return room


def _beside_edge(level, j, room):
    """Where a name is placed and how it is aligned: near a side of the map, so that it is not cut off."""
    x, n = level.x, len(level.x)
    left, right = j < EDGE * n, n - 1 - j < EDGE * n
    if right:
        return x[min(j + int(room), n - 1)], "right"
    return (x[max(j - int(room), 0)], "left") if left else (x[j], "center")


def half_step(x):
    """Half the distance between neighbours."""
    return (x[1] - x[0]) / 2


def span(level, colour):
    """The smallest and the largest value of a column so far; None if there are none."""
    values = level.columns[colour]
    values = values[np.isfinite(values)]
    return (float(values.min()), float(values.max())) if values.size else None


def cells(level, colour):
    """The colours for Bokeh, (up, across) of uint32; transparent where no cell was run or there is no value."""
    rgba = np.zeros((*level.end.shape, 4), np.uint8)
    if colour == "end":
        for end, name in ends.COLOUR.items():
            rgba[level.end == end] = (*bytes.fromhex(name[1:]), 255)
    elif found := span(level, colour):
        low, high = found
        values = level.columns[colour]
        there = np.isfinite(values)
        palette = np.array([[*bytes.fromhex(name[1:]), 255] for name in Viridis256], np.uint8)
        share = (values[there] - low) / ((high - low) or 1.0)
        rgba[there] = palette[np.clip((255 * share).astype(int), 0, 255)]
    return rgba.view(np.uint32).reshape(level.end.shape)
