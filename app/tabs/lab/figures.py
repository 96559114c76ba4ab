"""The figures of the Lab at the level "Research": the motion over time, the well in which the top moves like a bead,
the map of all tops."""

import numpy as np
from bokeh.models import ColumnDataSource, Label, MultiLine, Patch, Scatter, Segment, Text, VArea

from app.bundle import call
from app.model.build.dimensions import named
from app.model.colours import COLOURS, FAINT, INK
from app.model.families.groups import areas
from app.model.lab.tracks import ledger
from app.model.lab.wells import wells
from app.model.setup import OF_LAW
from app.text import listed, say, written
from app.widgets.plots import draw, on_click, padded, plain
from app.widgets.times import CLOCK, TimeFigures
from tippe_core import PRESETS as BODIES

LEDGER = {"spin": COLOURS["omega"], "precession and nutation": COLOURS["momentum"], "motion of G": FAINT,
          "height": COLOURS["energy"], "heat": COLOURS["energy_wash"]}  # fmt: skip
MAP_X, MAP_Y = (-0.6, 0.8), (0.45, 1.75)
MAP_PX, LETTER_PX = (300, 300), 6  # the map's size, and the width of a letter, approximate, to keep names apart
NEAR = 0.035  # of the map's width: a click this near to a known top selects it
SAME = 1e-3  # two tops this near each other on the map share one mark


class Times(TimeFigures):
    """The quantities of the runs over time, and below them where the energy of the one that is watched is."""

    def __init__(self):
        super().__init__()
        self.energies = ColumnDataSource({name: [] for name in ("t", *LEDGER)})
        fig = self.add("ledger")
        for below, (name, colour) in zip((0, *LEDGER), LEDGER.items(), strict=False):
            draw(fig, VArea, "t", y1=below, y2=name, source=self.energies, fill_color=colour, fill_alpha=0.6)

    def show(self, scene, until=np.inf):
        """Draws the motions of a LabScene, at first up to a time (s)."""
        start, motion = scene.start, scene.motions[scene.watched]
        moved = {table: each.trajectory for table, each in scene.motions.items() if each is not None}
        limit = start.mu if scene.watched != "ice" and "mu" in OF_LAW[start.law] else None
        events = [t for t, *_ in scene.events]
        self.show_motions(moved, scene.watched, start.scales, mu=limit, until=until, events=events)
        t, parts = ledger(motion, start.scales) if motion is not None else ([], dict.fromkeys(LEDGER, np.empty(0)))
        sums = np.cumsum([parts[name] for name in LEDGER], axis=0)  # each up to where the next begins
        self.energies.data = {"t": t} | dict(zip(LEDGER, sums, strict=True))
        self.figures["ledger"].y_range.update(start=0, end=1.05 * sums[-1].max(initial=0.0) or 1.0)


class Well:
    """V_J over theta with its steady states; the top moves in it as a bead, and the energy that it has left is shown
    above. If there are several wells in succession, the one at the time of the clock is shown."""

    def __init__(self):
        self.figure = fig = plain(x_range=(-5, 185), y_range=(0, 1), name="planes-well", min_border_left=50,
                                  min_height=130)  # fmt: skip
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
        fig.js_on_change("inner_width", call("followWell", path=self.path, bead=self.bead, wells=self.wells,
                                             steady=self.steady, none=self.none, range=fig.y_range,
                                             clock=CLOCK))  # fmt: skip

    def show(self, scene):
        found, bead = wells(scene.motions[scene.watched], scene.start)
        spans = [padded(well.low, well.high) for well in found]
        lows, highs = ([span[end] for span in spans] for end in ("start", "end"))
        self.wells.data = {"theta": [np.degrees(well.theta) for well in found], "V": [well.V for well in found],
                           "alpha": [1.0] + [0.0] * (len(found) - 1), "low": lows, "high": highs}  # fmt: skip
        which = np.repeat(np.arange(len(found)), [len(well.places) for well in found])
        places, V, stable = (np.concatenate([getattr(well, part) for well in found])
                             for part in ("places", "heights", "stable"))  # fmt: skip
        self.steady.data = {"theta": np.degrees(places), "V": V, "stable": stable.astype(float), "well": which,
                            "fill": stable * (which == 0.0), "alpha": (which == 0).astype(float)}  # fmt: skip
        self.figure.y_range.update(**spans[0])
        scale = scene.start.scales.time
        self.path.tags = [scale]
        self.path.data = {"t": bead.t * scale, "theta": np.degrees(bead.theta), "V": bead.V, "E": bead.E,
                          "well": bead.which}  # fmt: skip
        if not len(bead.t):
            self.bead.data = {name: [] for name in self.bead.data}


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
        self.figure = fig = plain(x_range=MAP_X, y_range=MAP_Y, name="planes-map")
        (left, right), (low, high) = MAP_X, MAP_Y
        looks = {"never rises": (FAINT, 0.3), "can invert": (COLOURS["friction"], 0.22),
                 "rises part of the way": (COLOURS["jellett"], 0.25), "can stand upright": (COLOURS["normal"], 0.2),
                 "never stands upright": (FAINT, 0.15)}  # fmt: skip
        for group, (x, y) in areas(left, right, low, high).items():
            colour, alpha = looks[group]
            draw(fig, Patch, "x", "y", source=ColumnDataSource({"x": x, "y": y}), level="underlay", fill_color=colour,
                 fill_alpha=alpha, line_color=None)  # fmt: skip
        places = {"never rises": (0.33, 0.55), "can invert": (0.6, 1.2), "rises part of the way": (0.36, 1.6),
                  "can stand upright": (-0.3, 1.15), "never stands upright": (-0.3, 1.66)}  # fmt: skip
        x, y = zip(*places.values(), strict=True)
        names = ColumnDataSource({"x": x, "y": y, "name": [listed("planes.groups")[group] for group in places]})
        draw(fig, Text, "x", "y", text="name", source=names, text_align="center", text_color=INK, text_font_size="12px",
             text_font_style="italic")  # fmt: skip
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
