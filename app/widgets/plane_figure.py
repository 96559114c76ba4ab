"""Fig. 6 in Bokeh: the tielines in the (K_J, theta) plane, what friction costs there, and the motion in it."""

import numpy as np
from bokeh.models import (
    ColumnDataSource,
    CustomJS,
    CustomJSHover,
    HoverTool,
    Label,
    Range1d,
    Span,
)

from app.model.colours import COLOURS, FAINT, INK
from app.model.regimes import COLOUR, ROLLS
from app.text import listed
from app.widgets.plots import FOLLOW_CLOCK, plain

# What a hand on Fig. 6 takes hold of, and what becomes of it: the bead moves the clock, all in the browser; an end of
# the tieline on display is the energy, the tieline itself K_J; any other tieline becomes the motion, and beyond the
# tielines the motion that turns there. `hand` takes the last four to Python.
GRAB = """
const {x, y, event_name} = cb_obj
const row = Object.fromEntries(Object.entries(selected.data).map(([name, values]) => [name, values[0]]))
const {frame: {x_scale, y_scale}, canvas_view: {ui_event_bus}, tool_views} = Bokeh.index.find_one(fig)
const REACH = 14
const {K_J, slip_in, slip_out} = limits.data
const nearest = K_J.reduce((best, _, j) => Math.abs(K_J[j] - y) < Math.abs(K_J[best] - y) ? j : best, 0)
const grip = (sx, sy) => {
  const away = (theta, K_J) => Math.hypot(x_scale.compute(theta) - sx, y_scale.compute(K_J) - sy)
  if (away(row.theta, row.K_J) < REACH) return "bead"
  if (Math.min(away(row.inner, row.K_J), away(row.outer, row.K_J)) < REACH) return "end"
  if (away(Math.min(Math.max(x_scale.invert(sx), row.inner), row.outer), row.K_J) < REACH) return "line"
  return x >= slip_in[nearest] && x <= slip_out[nearest] ? "tieline" : "point"
}
const over = () => grip(x_scale.compute(x), y_scale.compute(y))
if (event_name == "mousemove") {
  if (!hand.grip) ui_event_bus.set_cursor({bead: "grab", end: "ew-resize", line: "ns-resize"}[over()] ?? "pointer")
  return
}
// a quick hand is elsewhere by the time it counts as dragging
if (event_name == "panstart") hand.grip = hand.scrolls ? null : hand.pressed ? grip(...hand.pressed) : over()
if (event_name == "tap") hand.grip = over()
const taken = hand.grip, done = event_name == "tap" || event_name == "panend"
if (done) hand.grip = null
if (event_name == "panstart") tool_views.get(hover)._move_exit()
hover.setv({active: !hand.grip}, {sync: false})
if (taken == "bead" || event_name == "tap" && taken == "line") {
  const {t, theta} = motion.data, now = window.tippe.time(), last = t.length - 1
  const clamp = (value, one, other) => Math.min(Math.max(value, Math.min(one, other)), Math.max(one, other))
  const aim = clamp(x, row.inner, row.outer)
  // of the times at which the motion is nearest to the hand, the one next to now
  let found = now, least = Infinity
  for (let i = 0; i < last; i++) {
    const [from, to] = [theta[i], theta[i + 1]], inside = clamp(aim, from, to)
    const at = t[i] + (from == to ? 0 : (inside - from) / (to - from)) * (t[i + 1] - t[i])
    const away = 1e3 * Math.abs(inside - aim) + Math.abs(at - now) / (t[last] - t[0])
    if (away < least) [found, least] = [at, away]
  }
  window.dispatchEvent(new CustomEvent("tippe:seek", {detail: {t: found, held: !done}}))
} else if (taken && !(event_name == "tap" && taken == "end")) {
  const on = taken == "end" ? row.K_J : taken == "tieline" && done ? K_J[nearest] : y
  if (event_name != "panend") hand.data = {grip: [taken], theta: [x], K_J: [on]}
}
// why not, where the hand is
const say = () => {
  const text = [" ", would_slip, would_lift]
  const worst = selected.data.worst[0], right = x > (fig.x_range.start + fig.x_range.end) / 2
  const visible = !!hand.grip && hand.grip != "bead" && worst > 0
  if (!visible && !sentence.visible) return
  const align = right ? {text_align: "right", x_offset: -12} : {text_align: "left", x_offset: 12}
  sentence.setv({x, y, text: text[worst], visible, ...align}, {sync: false})
}
hand.say = say
say()
"""

READ_PLANE = """
const {K_J, slip_E, lift_E, slip_by, lift_by} = limits.data
const away = (j) => Math.abs(K_J[j] - special_vars.y)
const nearest = K_J.reduce((best, _, j) => away(j) < away(best) ? j : best, 0)
if (format == "K_J") return K_J[nearest].toFixed(3)
if (format == "theta") return `${special_vars.x.toFixed(3)} rad = ${(special_vars.x * 180 / Math.PI).toFixed(1)}°`
if (format == "E") return `${value.toFixed(4)} MgR`
if (format == "ratio") return Number.isFinite(value) ? value.toFixed(3) : no_contact
const limits_it = {slip: then_slip, "lift-off": then_lift, "no motion": steady_cannot, nothing: unlimited}
if (!(value > slip_E[nearest])) return limits_it[slip_by[nearest]]
const why = {slip: not_slip, "lift-off": not_lift}
return why[value > lift_E[nearest] ? lift_by[nearest] : slip_by[nearest]] ?? not_at_all
"""

TOOLTIP = """
<div style="font: 13px system-ui, sans-serif; color: #22303c; line-height: 1.5">
<i>K</i><sub>J</sub> = @E{K_J} (<i>g</i>/<i>R</i>)<sup>½</sup><br><i>θ</i> = @E{theta}<br><i>E</i> = @E{E}<br>
<i>F</i><sub>h</sub>/<i>F</i><sub>z</sub> = @ratio{ratio}<br>@E{limit}</div>
"""


class PlaneFigure:
    """Fig. 6: tielines under the friction limit, what friction costs shaded, and the selected motion on top."""

    def __init__(self, motion):
        self.figure = fig = plain(x_range=Range1d(0, 1), y_range=Range1d(0, 1), name="plane")
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
                "lift_E",
                "slip_by",
                "lift_by",
            )
        }
        self.pole = ColumnDataSource({"theta": [0.0], "K_J": [0.0]})
        self.field = ColumnDataSource({"E": [], "ratio": [], "x": [], "y": [], "w": [], "h": []})
        self.selected = ColumnDataSource(
            {
                "K_J": [0.0],
                "inner": [0.0],
                "outer": [0.0],
                "steady": [0.0],
                "theta": [0.0],
                "colour": [INK],
                "worst": [ROLLS],
            }
        )
        self.hand = ColumnDataSource({"grip": [""], "theta": [0.0], "K_J": [0.0]})

        for left, right in (("lift_in", "slip_in"), ("slip_out", "lift_out")):
            fig.harea(y="K_J", x1=left, x2=right, source=self.limits, fill_color=COLOURS["friction"], fill_alpha=0.16)
        fig.segment(
            x0="slip_in",
            x1="slip_out",
            y0="K_J",
            y1="K_J",
            source=self.limits,
            line_color=INK,
            line_alpha=0.55,
            line_width=1,
        )
        fig.line("lift_in", "K_J", source=self.limits, line_color=FAINT, line_width=1)
        fig.line("lift_verge", "K_J", source=self.limits, line_color=COLOURS["normal"], line_width=2)
        fig.line("verge", "K_J", source=self.limits, line_color=COLOURS["friction"], line_width=2)
        fig.line("steady", "K_J", source=self.limits, line_color=INK, line_width=1.5, line_dash=[6, 4])
        fig.add_layout(Span(location=np.pi / 2, dimension="height", line_color=FAINT, line_dash=[2, 4]))
        fig.scatter("theta", "K_J", source=self.pole, size=8, color=INK)
        fig.text(
            "theta",
            "K_J",
            text={"value": "P"},
            source=self.pole,
            x_offset=6,
            y_offset=-4,
            text_font_style="italic",
            text_font_size="15px",
            text_color=INK,
        )

        everywhere = fig.image("E", x="x", y="y", dw="w", dh="h", source=self.field, global_alpha=0, level="overlay")
        read = CustomJSHover(args={"limits": self.limits} | listed("roll.plane"), code=READ_PLANE)
        self.hover = HoverTool(
            renderers=[everywhere],
            tooltips=TOOLTIP,
            formatters={"@E": read, "@ratio": read},
            point_policy="follow_mouse",
        )
        fig.add_tools(self.hover)

        on_top = {"source": self.selected, "level": "overlay"}
        fig.segment(
            x0="inner", x1="outer", y0="K_J", y1="K_J", line_color="colour", line_width=5, line_cap="round", **on_top
        )
        fig.scatter(
            "steady", "K_J", marker="dash", angle=np.pi / 2, size=14, line_color="colour", line_width=2, **on_top
        )
        fig.scatter("inner", "K_J", size=9, fill_color="colour", line_color="white", line_width=1, **on_top)
        fig.scatter("outer", "K_J", size=9, fill_color="colour", line_color="white", line_width=1, **on_top)
        fig.scatter("theta", "K_J", size=13, fill_color="white", line_color=INK, line_width=2, **on_top)
        self.sentence = Label(
            x=0,
            y=0,
            text=" ",
            visible=False,
            level="overlay",
            y_offset=16,
            text_color=INK,
            text_font_size="13px",
            background_fill_color="white",
            background_fill_alpha=0.92,
            border_line_color=FAINT,
            padding=6,
        )
        fig.add_layout(self.sentence)
        self._plane = None
        self._listen(motion.source)

    def _listen(self, motion):
        """To the browser's own clock, which moves the bead, and to hands."""
        fig = self.figure
        own = {"fig": fig, "hand": self.hand}
        with_clock = own | {"motion": motion, "selected": self.selected}
        fig.js_on_change("inner_width", CustomJS(args=with_clock, code=FOLLOW_CLOCK))
        grab = CustomJS(
            args=with_clock
            | {"limits": self.limits, "sentence": self.sentence, "hover": self.hover}
            | listed("roll.pull"),
            code=GRAB,
        )
        for event in ("tap", "panstart", "pan", "panend", "mousemove"):
            fig.js_on_event(event, grab)
        self.selected.js_on_change("patching", CustomJS(args=own, code="hand.say?.()"))

    def show_selected(self, scene):
        inner, outer = scene.turning
        worst = int(scene.regime.max())
        # A patch, because theta, where the bead is, belongs to the browser's clock.
        row = {
            "K_J": scene.constants.K_J,
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
            "lift_E": lift.E,
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
