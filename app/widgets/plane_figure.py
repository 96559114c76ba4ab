"""Fig. 6 in Bokeh: the tielines in the (K_J, theta) plane, the effect of friction, and the selected motion."""

import numpy as np
from bokeh.models import ColumnDataSource, HArea, Line, Range1d, Scatter, Segment, Span, Text

from app.bundle import call
from app.model.colours import COLOURS, FAINT, INK
from app.model.regimes import COLOUR, ROLLS
from app.text import listed
from app.widgets.controls import SPIN, SYMBOLS
from app.widgets.plots import draw, on_pointer, plain


class PlaneFigure:
    """Fig. 6: tielines under the friction limit, the part lost to friction shaded, and the selected motion on top."""

    def __init__(self, motion):
        self.figure = plain(x_range=Range1d(0, 1), y_range=Range1d(0, 1), name="plane")
        self.limits = ColumnDataSource()
        self.limits.data = {
            name: np.zeros(0)
            for name in (
                "K_J",
                "lift_in",
                "lift_out",
                "slip_in",
                "slip_out",
                "verge",
                "lift_verge",
                "steady",
                "slip_E",
                "slip_by",
                "lift_by",
            )
        }
        self.pole = ColumnDataSource({"theta": [0.0], "K_J": [0.0]})
        # values for any point of the plane: rows upwards, and the ranges
        self.field = ColumnDataSource({"E": [], "ratio": [], "x": [], "y": [], "w": [], "h": []})
        self.selected = ColumnDataSource(
            {
                "K_J": [0.0],
                "K_R": [0.0],
                "inner": [0.0],
                "outer": [0.0],
                "steady": [0.0],
                "theta": [0.0],
                "colour": [INK],
                "worst": [ROLLS],
            }
        )
        self.hand = ColumnDataSource({"grip": [""], "theta": [0.0], "K_J": [0.0]})
        self._plane = None
        self._draw_limits()
        self._draw_selected()
        self._listen(motion.source)

    def _draw_limits(self):
        fig = self.figure
        for left, right in (("lift_in", "slip_in"), ("slip_out", "lift_out")):
            draw(fig, HArea, y="K_J", x1=left, x2=right, source=self.limits, fill_color=COLOURS["friction"],
                 fill_alpha=0.16)  # fmt: skip
        draw(fig, Segment, x0="slip_in", x1="slip_out", y0="K_J", y1="K_J", source=self.limits, line_color=INK,
             line_alpha=0.55, line_width=1)  # fmt: skip
        draw(fig, Line, "lift_in", "K_J", source=self.limits, line_color=FAINT, line_width=1)
        draw(fig, Line, "lift_verge", "K_J", source=self.limits, line_color=COLOURS["normal"], line_width=2)
        draw(fig, Line, "verge", "K_J", source=self.limits, line_color=COLOURS["friction"], line_width=2)
        draw(fig, Line, "steady", "K_J", source=self.limits, line_color=INK, line_width=1.5, line_dash=[6, 4])
        fig.add_layout(Span(location=np.pi / 2, dimension="height", line_color=FAINT, line_dash=[2, 4]))
        draw(fig, Scatter, "theta", "K_J", source=self.pole, size=8, fill_color=INK, line_color=INK)
        draw(fig, Text, "theta", "K_J", text={"value": "P"}, source=self.pole, x_offset=6, y_offset=-4,
             text_font_style="italic", text_font_size="15px", text_color=INK)  # fmt: skip

    def _draw_selected(self):
        """The selected motion, above everything else, and why it cannot roll."""
        fig = self.figure
        on_top = {"source": self.selected, "level": "overlay"}
        draw(fig, Segment, x0="inner", x1="outer", y0="K_J", y1="K_J", line_color="colour", line_width=5,
             line_cap="round", **on_top)  # fmt: skip
        draw(fig, Scatter, "steady", "K_J", marker="dash", angle=np.pi / 2, size=14, line_color="colour", line_width=2,
             **on_top)  # fmt: skip
        draw(fig, Scatter, "inner", "K_J", size=9, fill_color="colour", line_color="white", line_width=1, **on_top)
        draw(fig, Scatter, "outer", "K_J", size=9, fill_color="colour", line_color="white", line_width=1, **on_top)
        draw(fig, Scatter, "theta", "K_J", size=13, fill_color="white", line_color=INK, line_width=2, **on_top)

    def _listen(self, motion):
        """Connects the browser's clock, which moves the bead, and hands."""
        fig, hand = self.figure, {"fig": self.figure, "hand": self.hand, "selected": self.selected}
        fig.js_on_change("inner_width", call("followMotion", motion=motion, **hand))
        words = listed("roll.plane") | {"place": place_words()}
        hand |= {"limits": self.limits, "field": self.field, "words": words, "pulled": listed("regimes.why_html")}
        on_pointer(fig, call("pullPlane", motion=motion, **hand), "mousemove")
        self.selected.js_on_change("patching", call("sayPull", **hand))

    def show_selected(self, scene):
        inner, outer = scene.turning
        worst = int(scene.regime.max())
        # A patch, because the browser's clock sets theta, the position of the bead.
        row = {
            "K_J": scene.constants.K_J,
            "K_R": scene.constants.K_R,
            "inner": inner,
            "outer": outer,
            "steady": scene.marks.theta_steady,
            "colour": COLOUR[worst],
            "worst": worst,
        }
        self.selected.patch({name: [(0, value)] for name, value in row.items()})

    def show_plane(self, scene):
        plane = scene.plane
        if plane is self._plane:
            return
        self._plane = plane
        lift, slip = plane.lift, plane.slip
        self.limits.data = {
            "K_J": plane.K_J,
            "lift_in": lift.theta_inner,
            "lift_out": lift.theta_outer,
            "slip_in": slip.theta_inner,
            "slip_out": slip.theta_outer,
            "verge": slip.theta_verge,
            "lift_verge": lift.theta_verge,
            "steady": lift.theta_steady,
            "slip_E": slip.E,
            "slip_by": list(slip.limited_by),
            "lift_by": list(lift.limited_by),
        }
        step = plane.hover_K_J[1] - plane.hover_K_J[0]
        low, high = plane.hover_K_J[0] - step / 2, plane.hover_K_J[-1] + step / 2
        self.field.data = {
            "E": [plane.hover_E.astype(np.float32)],
            "ratio": [plane.hover_ratio.astype(np.float32)],
            "x": [0.0],
            "w": [plane.theta_range[1]],
            "y": [low],
            "h": [high - low],
        }
        self.pole.data = {"theta": [0.0], "K_J": [plane.pole]}
        pad = 0.065 * (plane.K_J_range[1] - plane.K_J_range[0])
        self.figure.y_range.update(start=plane.K_J_range[0] - pad, end=plane.K_J_range[1] + 1.6 * pad)
        self.figure.x_range.update(start=-0.015 * plane.theta_range[1], end=plane.theta_range[1])


def place_words():
    """The readings at a point, as HTML; the browser fills in the numbers."""
    numbers = {
        "K_J": f"{{K_J}} {SPIN}",
        "angle": "{theta} rad = {degrees}°",
        "energy": "{E} <i>MgR</i>",
        "ratio": "{ratio}",
    }
    rows = [f"{SYMBOLS[name]} = {text}" for name, text in numbers.items()]
    return "<br>".join([*rows, "<b>{verdict}</b>"])
