"""Quantities of a motion over time, one figure below the other on one time axis, each with a line at the time of the
clock. A curve has the colour of its quantity; which table it is of is told by its dashes."""

import numpy as np
from bokeh.models import BoxAnnotation, ColumnDataSource, Line, Range1d, VSpan

from app.bundle import call
from app.model.colours import COLOURS, FAINT, INK
from app.model.lab.tracks import QUANTITIES, Track, tracks
from app.model.setup import TABLES
from app.text import say
from app.widgets.plots import draw, on_pointer, plain, rule

ROWS = {"theta": ("theta",), "omega3": ("omega3",), "normal": ("normal",), "ratio": ("ratio",), "slip": ("slip",),
        "constants": ("E", "K_J", "K_R")}  # fmt: skip
"""{figure: its quantities}"""
COLOUR = {"theta": "ink", "omega3": "omega", "normal": "normal", "ratio": "normal", "slip": "ink", "E": "energy",
          "K_J": "jellett", "K_R": "routh"}  # fmt: skip
"""{quantity: a name of COLOURS}"""
DASHES = {"ordinary": [], "rough": [7, 4], "ice": [2, 3]}
CLOCK = "lab"  # of the browser
LEFT = 50  # px, left of every time axis
RISES = 1.4  # how far above the friction of the table its axis goes at least


def label(name):
    """What a figure shows, and its unit, as HTML, each quantity in the colour of its curve."""
    if name not in ROWS:
        return say("planes.keys.energy")
    wording = "<br>".join(
        f'<b style="color: var(--{COLOUR[each]}, {COLOURS[COLOUR[each]]})">{say(f"planes.quantities.{each}")}</b>'
        for each in ROWS[name]
    )
    return f"{wording}<br>" + say(f"planes.units.{name}")


def key():
    """Which dashes a table has, as HTML."""
    return "".join(
        f'<span><svg width="26" height="6" aria-hidden="true"><path d="M0 3H26" fill="none" stroke="currentColor" '
        f'stroke-width="2" stroke-dasharray="{" ".join(map(str, dash))}"/></svg> {say(f"planes.plane.{table}")}</span> '
        for table, dash in DASHES.items()
    )


class TimeFigures:
    """figures: {name: figure}, of ROWS and those that add() has added."""

    def __init__(self):
        self._unit = ColumnDataSource(tags=[1.0])  # s in one unit of the clock's time
        self._x_range, self._spans, self.figures = Range1d(0, 1), [], {}
        self._events = ColumnDataSource({"t": []})
        names = [prefix + name for name in QUANTITIES for prefix in ("", "t_")]
        self.curves = {table: ColumnDataSource({name: [] for name in names}) for table in TABLES}
        for name, quantities in ROWS.items():
            fig = self.add(name)
            for table, source in self.curves.items():
                for each in quantities:
                    draw(fig, Line, f"t_{each}", each, source=source, line_color=COLOURS[COLOUR[each]], line_width=1.6,
                         line_dash=DASHES[table])  # fmt: skip
            draw(fig, VSpan, "t", source=self._events, line_color=FAINT, line_dash=[2, 3])
        self._limit = rule(self.figures["ratio"], "width", 1, line_color=INK, line_dash=[6, 4], line_width=1)
        pulls = BoxAnnotation(top=0, fill_color=COLOURS["normal"], fill_alpha=0.15, line_color=None)
        self.figures["normal"].add_layout(pulls)
        followed = {"spans": self._spans, "path": self._unit, "range": self._x_range, "clock": CLOCK}
        self.figures["theta"].js_on_change("inner_width", call("moveLines", **followed))

    def add(self, name):
        """One more figure on the same time axis; the last one shows the times."""
        for fig in self.figures.values():
            fig.xaxis.visible = False
        fig = self.figures[name] = plain(x_range=self._x_range, y_range=(0, 1), name=f"times-{name}",
                                         min_border_left=LEFT)  # fmt: skip
        fig.yaxis.ticker.desired_num_ticks = 3
        self._spans.append(rule(fig, "height", level="overlay", line_color=COLOURS["accent"], line_width=2))
        on_pointer(fig, call("seekAlong", path=self._unit, clock=CLOCK))
        return fig

    def show_motions(self, trajectories, watched, scales, *, mu=None, until=np.inf, events=()):
        """Draws {table: Trajectory}, at first up to a time (s). watched: the table whose constants are shown; mu: the
        friction that the table can give at most, if there is such a limit; events: their times (s)."""
        end, shown = 0.0, {name: [] for name in QUANTITIES}
        for table, source in self.curves.items():
            moved = trajectories.get(table)
            if moved is None:
                source.data = {name: [] for name in source.data}
                continue
            found, end = tracks(moved, scales), max(end, float(moved.t[-1]) * scales.time)
            if table != watched:
                t = found["theta"].t
                found |= dict.fromkeys(ROWS["constants"], Track(t, np.full(len(t), np.nan)))
            source.data = {f"t_{name}": track.t for name, track in found.items()} | {
                name: track.value for name, track in found.items()}  # fmt: skip
            for name, track in found.items():
                known = track.value[np.isfinite(track.value)]
                shown[name] += [known] if len(known) else []
        self._unit.tags, self._events.data = [scales.time], {"t": list(events)}
        self._x_range.update(start=0, end=min(end, until))
        self._limit.update(visible=mu is not None, location=mu or 0.0)
        for name, quantities in ROWS.items():
            values = np.concatenate([each for quantity in quantities for each in shown[quantity]] or [np.zeros(1)])
            low, high = float(values.min()), float(values.max())
            if name not in ("theta", "omega3"):
                low = min(0.0, low)
            high = {"normal": max(1.5, high), "ratio": max(high, RISES * (mu or 0.0))}.get(name, high)
            pad = 0.08 * (high - low) or 0.05 * (1 + abs(high))
            self.figures[name].y_range.update(start=low - pad, end=high + pad)
