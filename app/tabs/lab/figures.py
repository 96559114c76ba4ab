"""The figures of the Lab at the level "Research": the motion over time, the well in which the top moves like a
bead."""

import numpy as np
from bokeh.models import ColumnDataSource, Label, MultiLine, Scatter, Segment, VArea

from app.bundle import call
from app.model.colours import COLOURS, FAINT, INK
from app.model.lab.tracks import ledger
from app.model.lab.wells import wells
from app.model.setup import OF_LAW
from app.text import say
from app.widgets.plots import draw, padded, plain
from app.widgets.times import CLOCK, TimeFigures

LEDGER = {"spin": COLOURS["omega"], "precession and nutation": COLOURS["momentum"], "motion of G": FAINT,
          "height": COLOURS["energy"], "heat": COLOURS["energy_wash"]}  # fmt: skip


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
