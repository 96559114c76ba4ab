"""The lesson's figures: a step's graph, and the section through the top as in the paper's Fig. 4."""

import numpy as np
import panel as pn
from bokeh.models import ColumnDataSource, Range1d

from app.bundle import call
from app.model.colours import COLOURS, FAINT, GREY, INK
from app.model.levers import levers
from app.text import say
from app.widgets.cards import swatch, words
from app.widgets.plots import plain

CLOCK = "learn"
MARGIN = 0.06


class StepFigure:
    """A lesson_parts.Picture: curves and points over two axes."""

    def __init__(self):
        self.figure = fig = plain(x_range=Range1d(0, 1), y_range=Range1d(0, 1), name="lesson")
        fig.update(sizing_mode="stretch_width", height=280)
        self.curves = ColumnDataSource({"xs": [], "ys": [], "colour": [], "dash": []})
        self.points = ColumnDataSource({"x": [], "y": [], "name": []})
        fig.multi_line("xs", "ys", source=self.curves, line_color="colour", line_dash="dash", line_width=2)
        fig.scatter("x", "y", source=self.points, size=9, fill_color="white", line_color=INK, line_width=2)
        fig.text("x", "y", "name", source=self.points, x_offset=-8, y_offset=-8, text_align="right", text_color=INK,
                 text_font_size="13px")  # fmt: skip
        self.key, self.x, self.y = words(""), words(""), words("")

    @property
    def view(self):
        return [self.key, self.y, pn.pane.Bokeh(self.figure, sizing_mode="stretch_width", margin=0), self.x]

    def show(self, picture):
        self.curves.data = {
            "xs": [curve.x for curve in picture.curves], "ys": [curve.y for curve in picture.curves],
            "colour": [curve.colour for curve in picture.curves], "dash": [curve.dash for curve in picture.curves],
        }  # fmt: skip
        self.points.data = {
            "x": [point.x for point in picture.points], "y": [point.y for point in picture.points],
            "name": [say(f"learn.points.{point.key}") for point in picture.points],
        }  # fmt: skip
        for axis, values in (("x_range", [part.x for part in (*picture.curves, *picture.points)]),
                             ("y_range", [part.y for part in (*picture.curves, *picture.points)])):  # fmt: skip
            values = np.concatenate([np.atleast_1d(value) for value in values])
            low, high = np.nanmin(values), np.nanmax(values)
            pad = MARGIN * (high - low) or 0.05 * (1 + abs(low))
            getattr(self.figure, axis).update(start=low - pad, end=high + pad)
        known = {curve.key: curve for curve in picture.curves if curve.key != "zero"}
        key = "".join(swatch(c.colour, say(f"learn.curves.{c.key}"), c.dash) for c in known.values())
        self.key.object = f'<div class="key">{key}</div>'
        self.x.object = f'<div class="axis">{say(f"learn.axes.{picture.x}")}</div>'
        self.y.object = f"<div>{say(f'learn.axes.{picture.y}')}</div>"


POSE = ("axis_x", "axis_y", "G_x", "G_y", "foot_x", "foot_y")


class SectionFigure:
    """The paper's Fig. 4, live: the section through the contact point and the axis, with the two lever arms of F_x."""

    def __init__(self):
        self.figure = fig = plain(x_range=Range1d(-2.1, 2.1), y_range=Range1d(-0.45, 3.1), name="section",
                                  match_aspect=True)  # fmt: skip
        fig.update(sizing_mode="stretch_width", height=330)
        fig.grid.visible = fig.axis.visible = False
        self.motion = ColumnDataSource({name: [0.0, 1.0] for name in ("t", "push", *POSE)})
        self.body = ColumnDataSource({name: np.zeros(1) for name in ("across", "along", "x", "y")})
        five, six = [0.0] * 5, [0.0] * 6
        self.lines = ColumnDataSource(
            {"x0": six, "y0": list(six), "x1": list(six), "y1": list(six),
             "colour": [FAINT, FAINT, GREY, COLOURS["friction"], COLOURS["theta"], FAINT],
             "dash": ["dashed", "dotted", "solid", "solid", "solid", "dotted"],
             "width": [1.5, 1.5, 2, 8, 5, 1.5]})  # fmt: skip
        self.points = ColumnDataSource(
            {"x": five, "y": list(five), "name": ["O", "G", "C", "3", "F⊙"], "dx": [10, 10, -18, 8, 8],
             "dy": [-4, 4, 16, 0, 20], "size": [5, 8, 7, 0, 0]})  # fmt: skip
        fig.patch("x", "y", source=self.body, fill_color="#d9b48a", fill_alpha=0.35, line_color="#8a6a42")
        fig.segment(x0=[-2.1], x1=[2.1], y0=[0], y1=[0], line_color=INK, line_width=1.5)
        fig.segment("x0", "y0", "x1", "y1", source=self.lines, line_color="colour", line_dash="dash",
                    line_width="width")  # fmt: skip
        fig.scatter("x", "y", source=self.points, size="size", color=INK)
        fig.text("x", "y", "name", source=self.points, x_offset="dx", y_offset="dy", text_color=INK,
                 text_font_size="15px", text_font_style="italic")  # fmt: skip
        turn = call(
            "turnSection", motion=self.motion, body=self.body, lines=self.lines, points=self.points, clock=CLOCK
        )
        fig.js_on_change("inner_width", turn)
        self.words = words("")

    @property
    def view(self):
        return [self.words, pn.pane.Bokeh(self.figure, sizing_mode="stretch_width", margin=0)]

    def show(self, scene):
        radius, height = scene.profile.T
        across, along = np.concatenate([radius, -radius[::-1]]), np.concatenate([height, height[::-1]])
        self.body.data = {"across": across, "along": along, "x": across.copy(), "y": along + 1}
        found = levers(scene)
        points = (found.axis, found.G, found.foot)
        pose = [column for point in points for column in np.ascontiguousarray(point.T)]
        self.motion.data = {"t": scene.trajectory.t, "push": found.push, **dict(zip(POSE, pose, strict=True))}
        arms = swatch(COLOURS["friction"], say("learn.arms.z")) + swatch(COLOURS["theta"], say("learn.arms.three"))
        self.words.object = f'<div class="key">{arms}</div>'
