"""An enlarged view of the motion in Fig. 6 if its tieline is too short: a toy that the rough table has gripped nods by
a few degrees, which is only some pixels on the axis of all tilts."""

import numpy as np
import panel as pn
from bokeh.models import Line, Range1d, Scatter, Segment

from app.model.colours import COLOURS, FAINT, INK
from app.text import say
from app.widgets.cards import words
from app.widgets.plots import draw, plain

SHORT = 0.06  # of the theta axis: shorter tielines are also shown enlarged
ROUND = 0.7  # of the tieline's length, shown beyond either end
LOOK = {"position": "absolute", "right": "10px", "bottom": "10px", "width": "200px", "z-index": "2",
        "background": "var(--card, white)", "border": f"1px solid {FAINT}", "border-radius": "6px",
        "padding": "4px 6px"}  # fmt: skip


class PlaneInset:
    """plane: a PlaneFigure, whose sources it draws again. view: an overlay for it, empty if it is not needed, because a
    figure is a tenth of the cost of a page."""

    def __init__(self, plane):
        self._plane, self.figure, self._says = plane, None, words()
        self.view = pn.Column(visible=False, margin=0, styles=LOOK)

    def _make(self):
        plane = self._plane
        self.figure = fig = plain(x_range=Range1d(0, 1), y_range=Range1d(0, 1), name="plane-near")
        fig.update(sizing_mode="stretch_width", height=88)
        fig.xaxis.ticker.desired_num_ticks, fig.yaxis.ticker.desired_num_ticks = 4, 3
        draw(fig, Segment, x0="slip_in", x1="slip_out", y0="K_J", y1="K_J", source=plane.limits, line_color=INK,
             line_alpha=0.55)  # fmt: skip
        draw(fig, Line, "lift_verge", "K_J", source=plane.limits, line_color=COLOURS["normal"], line_width=2)
        draw(fig, Line, "verge", "K_J", source=plane.limits, line_color=COLOURS["friction"], line_width=2)
        draw(fig, Line, "steady", "K_J", source=plane.limits, line_color=INK, line_width=1.5, line_dash=[6, 4])
        on_top = {"source": plane.selected, "level": "overlay"}
        draw(fig, Segment, x0="inner", x1="outer", y0="K_J", y1="K_J", line_color="colour", line_width=5,
             line_cap="round", **on_top)  # fmt: skip
        draw(fig, Scatter, "theta", "K_J", size=11, fill_color="white", line_color=INK, line_width=2, **on_top)

    def show(self, scene):
        (inner, outer), plane = scene.turning, scene.plane
        length = outer - inner
        short = bool(length < SHORT * plane.theta_range[1])
        if short:
            made = self.figure is None
            if made:
                self._make()
            around = max(ROUND * length, 1e-3)
            self.figure.x_range.update(start=inner - around, end=outer + around)
            high = 0.06 * (plane.K_J_range[1] - plane.K_J_range[0])
            K_J = float(scene.constants.K_J)
            self.figure.y_range.update(start=K_J - high, end=K_J + high)
            self._says.object = say("roll.near.says", inner=np.degrees(inner), outer=np.degrees(outer))
            if made:
                figure = pn.pane.Bokeh(self.figure, sizing_mode="stretch_width", height=88, margin=0)
                self.view.objects = [self._says, figure]
        elif self.figure is not None:
            self.figure, self.view.objects, self._says.object = None, [], ""
        self.view.visible = short
