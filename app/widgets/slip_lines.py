"""The effect of slipping in Fig. 6: the path of the motion if it slips from its tieline's end, and K_R below it on the
same theta axis. Rolling, a motion stays on its tieline; slipping, K_J is nearly conserved while K_R passes through
zero."""

import numpy as np
from bokeh.models import ColumnDataSource, HArea, Label, Line, Range1d, Scatter, Segment, Span

from app.model.colours import COLOURS, FAINT, INK
from app.text import say
from app.widgets.plots import draw, plain

HIGH = 96  # px
LEFT = 44  # px, the left margin of both figures, which aligns their theta axes
LETTER = 0.02  # of the width, in the narrowest figure
ROWS = {"K_J": COLOURS["jellett"], "K_R": COLOURS["omega"]}
BESIDE = {"text_color": INK, "text_font_size": "12px", "visible": False}


class SlipLines:
    """plane: the PlaneFigure over which they are drawn. below: K_R over theta. show() is for a hand at rest."""

    def __init__(self, plane):
        self._plane, self._shown = plane, None
        above = plane.figure
        self.below = plain(x_range=above.x_range, y_range=Range1d(-1, 1), name="routh")
        self.below.update(sizing_mode="stretch_width", height=HIGH)
        self.below.yaxis.ticker.desired_num_ticks = 3
        self.below.ygrid.ticker = self.below.yaxis.ticker
        for fig in (above, self.below):
            fig.min_border_left = LEFT
        above.xaxis.visible = False
        self.below.add_layout(Span(location=0, dimension="width", line_color=FAINT))
        names = ("theta", "low", "high", "K_J", "K_R")
        # up to where the stem touches; beyond, as for a whole sphere; and the end
        self.own, self.beyond, self.end = (ColumnDataSource({name: [] for name in names}) for _ in range(3))
        for fig, row in ((above, "K_J"), (self.below, "K_R")):
            self._draw(fig, row)
        on_top = {"source": plane.selected, "level": "overlay"}
        draw(self.below, Segment, x0="inner", x1="outer", y0="K_R", y1="K_R", line_color="colour", line_width=5,
             line_cap="round", **on_top)  # fmt: skip
        draw(self.below, Scatter, "theta", "K_R", size=11, fill_color="white", line_color=INK, line_width=2, **on_top)
        self.touch = Span(location=np.pi, dimension="height", line_color=FAINT, line_dash=[2, 3], visible=False)
        above.add_layout(self.touch)
        self.words = {"keeps": Label(x=0, y=0, y_offset=12, **BESIDE),
                      "ends": Label(x=0, y=0, y_offset=-10, text_baseline="top", **BESIDE),
                      "touches": Label(x=0, y=0, **BESIDE),
                      "goes": Label(x=0, y=0, y_offset=-2, text_baseline="top",
                                    **BESIDE)}  # fmt: skip
        for name, label in self.words.items():
            (self.below if name == "goes" else above).add_layout(label)

    def _draw(self, fig, row):
        for source, alpha, dash in ((self.own, 0.25, "solid"), (self.beyond, 0.12, [5, 4])):
            draw(fig, HArea, y=row, x1="low", x2="high", source=source, fill_color=ROWS[row], fill_alpha=alpha)
            draw(fig, Line, "theta", row, source=source, line_color=ROWS[row], line_width=3, line_dash=dash)
        draw(fig, Scatter, "theta", row, source=self.end, size=10, fill_color="white", line_color=ROWS[row],
             line_width=3)  # fmt: skip

    def clear(self):
        """Removes the path of another motion."""
        if self._shown is not None:
            self.show(None, None)

    def show(self, path, scene):
        """path: the Slipping of the Scene; None if there is none."""
        if path is self._shown:
            return
        self._shown = path
        for label in self.words.values():
            label.update(x=0, y=0, text=" ", visible=False)
        self.touch.update(location=np.pi, visible=False)
        if path is None:
            for source in (self.own, self.beyond, self.end):
                source.data = {name: [] for name in source.data}
            self.below.y_range.update(start=-1, end=1)
            return
        rows = {name: getattr(path, name) for name in self.own.data}
        count = len(path.theta)
        until = count if path.touches is None else path.touches + 1
        for source, part in ((self.own, slice(0, until)), (self.beyond, slice(until - 1, count)),
                             (self.end, slice(count - 1, count))):  # fmt: skip
            source.data = {name: row[part] if part != slice(count - 1, count) or source is self.end else row[:0]
                           for name, row in rows.items()}  # fmt: skip
        low, high = min(0, path.K_R.min()), max(0, path.K_R.max())
        pad = 0.12 * (high - low) or 1.0
        self.below.y_range.update(start=low - pad, end=high + pad)
        self._say(path, scene)

    def _say(self, path, scene):
        theta, K_J, K_R = float(path.theta[-1]), float(path.K_J[-1]), float(path.K_R[-1])
        high = scene.plane.K_J_range
        through = path.K_R[0] * K_R < 0
        goes = say(f"roll.slips.{'through' if through else 'changes'}")
        said = {"keeps": (theta, float(path.K_J.mean()), say("roll.slips.keeps")),
                "goes": (theta, float(self.below.y_range.end), goes)}  # fmt: skip
        if path.rolls:
            said["ends"] = theta, K_J, say("roll.slips.ends", degrees=np.degrees(theta))
        touch = scene.shape.touch_angle if scene.shape else None
        if path.touches is not None:
            self.touch.update(location=touch, visible=True)
            text = say("roll.slips.touches", degrees=np.degrees(touch))
            said["touches"] = self._plane.figure.x_range.end, high[0] + 0.55 * (high[1] - high[0]), text
        end = self._plane.figure.x_range.end
        for name, (x, y, text) in said.items():
            self.words[name].update(**_beside(x, text, end), y=y, text=text, visible=True)


def _beside(x, text, end):
    """Where the words for a point start: left of it; if they would begin outside the figure, right of it; or else at
    its edge."""
    wide = LETTER * end * max(map(len, text.split("\n")))
    if x >= wide:
        return {"x": x, "x_offset": -2, "text_align": "right"}
    return {"x": x if x + wide < end else 0, "x_offset": 10, "text_align": "left"}
