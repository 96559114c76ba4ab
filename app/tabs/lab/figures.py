"""The figures of the Lab at the level "Research": the motion over time, the well in which the top moves like a bead,
the map of all tops."""

import numpy as np
from bokeh.models import BoxAnnotation, ColumnDataSource, Label, MultiLine, Range1d, Scatter, Segment, Span, Text

from app.bundle import call
from app.model.build.dimensions import named
from app.model.colours import COLOURS, FAINT, INK
from app.model.families.groups import areas
from app.model.lab.tracks import QUANTITIES, ledger, tracks
from app.model.lab.wells import wells
from app.model.regimes import COLOUR, ENDS, FLIES, GLIDES, ROLLS, SLIPS, WOULD_LIFT
from app.model.setup import TABLES
from app.tabs.lab.words import LOOKS
from app.text import listed, say, written
from app.widgets.plots import draw, on_click, on_pointer, plain
from tippe_core import PRESETS as BODIES

CLOCK = "lab"
IN_RIBBON = (ROLLS, SLIPS, GLIDES, FLIES, WOULD_LIFT, ENDS)
LEDGER = {"spin": COLOURS["omega"], "precession and nutation": COLOURS["momentum"], "motion of G": FAINT,
          "height": COLOURS["jellett"], "heat": COLOURS["friction"]}  # fmt: skip
MAP_X, MAP_Y = (-0.6, 0.8), (0.45, 1.75)
MAP_PX, LETTER_PX = (300, 300), 6  # the map's size, and the width of a letter, approximate, to keep names apart
NEAR = 0.035  # of the map's width: a click this near to a known top selects it
SAME = 1e-3  # two tops this near each other on the map share one mark


class Figures:
    """Quantities over time, the energies and the ribbon of regimes, each with a line at the time of the clock."""

    def __init__(self):
        self.x_range = Range1d(0, 1)
        self.spans, self.figures = [], {}
        for name in (*QUANTITIES, "ledger", "regime"):
            self.figures[name] = fig = plain(x_range=self.x_range, y_range=Range1d(0, 1), name=f"planes-{name}")
            fig.min_border_left = 50
            fig.yaxis.ticker.desired_num_ticks = 3
            fig.xaxis.visible = name == "regime"
            self.spans.append(Span(location=0, dimension="height", level="overlay", line_color=INK, line_width=1.5))
            fig.add_layout(self.spans[-1])
        self.figures["regime"].yaxis.visible = False
        self.figures["regime"].grid.visible = False
        self.figures["normal"].add_layout(
            BoxAnnotation(top=0, fill_color=COLOURS["normal"], fill_alpha=0.15, line_color=None)
        )
        columns = [prefix + name for name in QUANTITIES for prefix in ("", "t_")]
        self.curves = {plane: ColumnDataSource({name: [] for name in columns}) for plane in TABLES}
        self.lines = {
            (plane, name): self.figures[name].line(
                f"t_{name}", name, source=source, line_color=LOOKS[plane], line_width=2, name=plane
            )
            for plane, source in self.curves.items()
            for name in QUANTITIES
        }
        self.energies = ColumnDataSource({name: [] for name in ("t", *LEDGER)})
        self.figures["ledger"].varea_stack(list(LEDGER), x="t", color=list(LEDGER.values()), source=self.energies)
        self.unit = ColumnDataSource(tags=[1.0])  # s in one unit of the clock's time
        self.ribbons = ColumnDataSource({name: [] for name in ("start", "end", "low", "high", "colour")})
        self.figures["regime"].quad(
            left="start", right="end", bottom="low", top="high", fill_color="colour", line_color=None,
            source=self.ribbons,
        )  # fmt: skip
        self.figures["theta"].js_on_change(
            "inner_width", call("followSpans", spans=self.spans, path=self.unit, range=self.x_range, clock=CLOCK)
        )
        for fig in self.figures.values():
            on_pointer(fig, call("seekAlong", path=self.unit, clock=CLOCK))

    def show(self, scene, until=np.inf):
        """Draws the motions of a LabScene, at first up to a time (s)."""
        scales, end = scene.start.scales, 0.0
        ribbons = []
        for plane in TABLES:
            motion = scene.motions[plane]
            if motion is None:
                self.curves[plane].data = {name: [] for name in self.curves[plane].data}
                continue
            found, end = tracks(motion, scales), max(end, float(motion.t[-1]) * scales.time)
            self.curves[plane].data = {f"t_{name}": track.t for name, track in found.items()} | {
                name: track.value for name, track in found.items()
            }
            ribbons += [(plane, a * scales.time, b * scales.time, which) for a, b, which in motion.stretches]
        row = [TABLES.index(plane) for plane, *_ in ribbons]
        self.ribbons.data = {
            "start": [start for _, start, _, _ in ribbons],
            "end": [end for _, _, end, _ in ribbons],
            "low": [i + 0.1 for i in row],
            "high": [i + 0.9 for i in row],
            "colour": [COLOUR[int(which)] for *_, which in ribbons],
        }
        self.unit.tags = [scales.time]
        self.x_range.update(start=0, end=min(end, until))
        for name in QUANTITIES:
            shown = [self.curves[which].data[name] for which in TABLES]
            shown = np.concatenate([values for values in shown if len(values)] or [np.zeros(1)])
            low, high = float(shown.min()), float(shown.max())
            low = min(0.0, low) if name != "omega3" else low
            if name == "normal":
                high = max(1.5, high)
            pad = 0.08 * (high - low) or 0.05 * (1 + abs(high))
            self.figures[name].y_range.update(start=low - pad, end=high + pad)
        row = TABLES.index(scene.table) if scene.table in TABLES else None
        self.figures["regime"].y_range.update(start=row or 0, end=len(TABLES) if row is None else row + 1)
        motion = scene.motions[scene.watched]
        if motion is None:
            self.energies.data = {name: [] for name in ("t", *LEDGER)}
            return
        t, parts = ledger(motion, scales)
        self.energies.data = {"t": t} | parts
        self.figures["ledger"].y_range.update(start=0, end=1.05 * float(sum(parts.values()).max()) or 1.0)


class Well:
    """V_J over theta with its steady states; the top moves in it as a bead, and the energy that it has left is shown
    above. If there are several wells in succession, the one at the time of the clock is shown."""

    def __init__(self):
        self.figure = fig = plain(x_range=Range1d(-5, 185), y_range=Range1d(0, 1), name="planes-well")
        fig.min_border_left, fig.min_height = 50, 130
        fig.xaxis.ticker = [0, 30, 60, 90, 120, 150, 180]
        self.wells = ColumnDataSource({name: [] for name in ("theta", "V", "alpha", "low", "high")})
        self.steady = ColumnDataSource({name: [] for name in ("theta", "V", "stable", "well", "fill", "alpha")})
        # read and written by the browser's clock; well: the index of the present well, -1 for none
        self.path = ColumnDataSource({name: [] for name in ("t", "theta", "V", "E", "well")}, tags=[1.0])
        self.bead = ColumnDataSource({"theta": [], "V": [], "E": []})
        draw(fig, MultiLine, xs="theta", ys="V", source=self.wells, line_color=COLOURS["theta"], line_alpha="alpha",
             line_width=2.5)  # fmt: skip
        draw(fig, Scatter, "theta", "V", source=self.steady, size=8, fill_color=INK, fill_alpha="fill", line_color=INK,
             line_width=1.5, line_alpha="alpha")  # fmt: skip
        on_top = {"source": self.bead, "level": "overlay"}
        draw(fig, Segment, x0="theta", y0="V", x1="theta", y1="E", line_color=COLOURS["energy"], line_width=2, **on_top)
        draw(fig, Scatter, "theta", "E", marker="dash", size=16, line_color=COLOURS["energy"], line_width=3, **on_top)
        draw(fig, Scatter, "theta", "V", size=15, fill_color=COLOURS["friction"], line_color="white", line_width=2,
             **on_top)  # fmt: skip
        self.none = Label(x=90, y=0, y_offset=60, text=say("planes.keys.no_well"), text_align="center",
                          text_color=COLOURS["friction"], text_font_size="14px", visible=False)  # fmt: skip
        fig.add_layout(self.none)
        fig.js_on_change(
            "inner_width",
            call(
                "followWell",
                path=self.path,
                bead=self.bead,
                wells=self.wells,
                steady=self.steady,
                none=self.none,
                range=fig.y_range,
                clock=CLOCK,
            ),
        )

    def show(self, scene):
        found, bead = wells(scene.motions[scene.watched], scene.start)
        lows, highs = zip(*(padded(well.low, well.high) for well in found), strict=True)
        self.wells.data = {"theta": [np.degrees(well.theta) for well in found], "V": [well.V for well in found],
                           "alpha": [1.0] + [0.0] * (len(found) - 1), "low": lows, "high": highs}  # fmt: skip
        which = np.repeat(np.arange(len(found)), [len(well.places) for well in found])
        places, V, stable = (np.concatenate([getattr(well, part) for well in found])
                             for part in ("places", "heights", "stable"))  # fmt: skip
        self.steady.data = {"theta": np.degrees(places), "V": V, "stable": stable.astype(float), "well": which,
                            "fill": stable * (which == 0.0), "alpha": (which == 0).astype(float)}  # fmt: skip
        self.figure.y_range.update(start=lows[0], end=highs[0])
        scale = scene.start.scales.time
        self.path.tags = [scale]
        self.path.data = {"t": bead.t * scale, "theta": np.degrees(bead.theta), "V": bead.V, "E": bead.E,
                          "well": bead.which}  # fmt: skip
        if not len(bead.t):
            self.bead.data = {name: [] for name in self.bead.data}


def padded(low, high):
    """The range with some margin below and above."""
    pad = 0.08 * (high - low) or 0.05
    return low - pad, high + pad


def beside(place, name, taken):
    """(dx, dy) in px and the side at which a name does not overlap those in taken, to which it is added."""
    ends = zip(MAP_PX, place, (MAP_X, MAP_Y), strict=True)
    x, y = (size * (value - low) / (high - low) for size, value, (low, high) in ends)
    width = LETTER_PX * len(name)
    for dy in (0, 14, -14, 28, -28, 42):
        for dx, align in ((8, "left"), (-8, "right")):
            start = x + dx - (width if align == "right" else 0)
            box = start, start + width, y - dy - 6, y - dy + 6
            if x - width < 0 and align == "right":
                continue
            if not any(box[0] < b[1] and b[0] < box[1] and box[2] < b[3] and b[2] < box[3] for b in taken):
                taken.append(box)
                return dx, dy, align
    return 8, 0, "left"


class Map:
    """The three groups over a/R and I1/I3. pick: called with (a, I1/I3) of a click; pick_body: with the name of a known
    top."""

    def __init__(self, pick, pick_body):
        self._pick, self._pick_body = pick, pick_body
        self.figure = fig = plain(x_range=Range1d(*MAP_X), y_range=Range1d(*MAP_Y), name="planes-map")
        (left, right), (low, high) = MAP_X, MAP_Y
        looks = {"never rises": (FAINT, 0.3), "can invert": (COLOURS["friction"], 0.22),
                 "rises part of the way": (COLOURS["jellett"], 0.25), "can stand upright": (COLOURS["normal"], 0.2),
                 "never stands upright": (FAINT, 0.15)}  # fmt: skip
        for group, (x, y) in areas(left, right, low, high).items():
            colour, alpha = looks[group]
            fig.patch(x, y, fill_color=colour, fill_alpha=alpha, line_color=None, level="underlay")
        places = {"never rises": (0.33, 0.55), "can invert": (0.6, 1.2), "rises part of the way": (0.36, 1.6),
                  "can stand upright": (-0.3, 1.15), "never stands upright": (-0.3, 1.66)}  # fmt: skip
        x, y = zip(*places.values(), strict=True)
        fig.text(x, y, text=[listed("planes.groups")[group] for group in places], text_align="center",
                 text_color=INK, text_font_size="12px", text_font_style="italic")  # fmt: skip
        fig.ygrid.visible = fig.xgrid.visible = False
        # a top far to the left is drawn at the edge, with its position beside its name
        self.known, marks, taken = {}, [], []
        for body in BODIES:
            top = body.top
            if any(np.hypot(top.a - a, top.I1 / top.I3 - ratio) < SAME for a, ratio in self.known.values()):
                continue
            inside = top.a > left
            place = self.known[body.name] = (top.a if inside else left + 0.03, top.I1 / top.I3)
            name = named(body.name)
            if not inside:
                name = say("planes.map.far", name=name, a=written(top.a, ".0f"))
            marks.append((*place, name, "circle" if inside else "triangle", *beside(place, name, taken)))
        names = ("x", "y", "name", "marker", "dx", "dy", "align")
        known = ColumnDataSource(dict(zip(names, zip(*marks, strict=True), strict=True)))
        draw(fig, Scatter, "x", "y", source=known, size=9, marker="marker", fill_color="white", line_color=INK,
             line_width=1.5)  # fmt: skip
        draw(fig, Text, "x", "y", text="name", x_offset="dx", y_offset="dy", text_align="align", source=known,
             text_font_size="12px", text_color=INK, text_baseline="middle")  # fmt: skip
        self.here = ColumnDataSource({"x": [], "y": []})
        draw(fig, Scatter, "x", "y", source=self.here, size=13, fill_color=COLOURS["friction"], line_color="white",
             line_width=2, level="overlay")  # fmt: skip
        on_click(fig, self._tapped)

    def _tapped(self, event):
        (left, right), (low, high) = MAP_X, MAP_Y
        away = {name: np.hypot((x - event.x) / (right - left), (y - event.y) / (high - low))
                for name, (x, y) in self.known.items()}  # fmt: skip
        nearest = min(away, key=away.get)
        if away[nearest] < NEAR:
            self._pick_body(nearest)
        else:
            self._pick(round(event.x, 3), round(event.y, 3))

    def show(self, top):
        ratio = top.I1 / top.I3
        self.here.data = {"x": [np.clip(top.a, MAP_X[0] + 0.03, MAP_X[1])], "y": [np.clip(ratio, *MAP_Y)]}
