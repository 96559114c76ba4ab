"""Scene -> Bokeh: one nutation in the planes that physicists use, the track from above, the force in its disc.

Each card draws one Portrait at a time. The beads move with the browser's clock, and dragging one sets the clock.
"""

import numpy as np
from bokeh.models import ColumnDataSource, Line, MultiLine, Patch, Scatter

from app.bundle import call
from app.model.colours import COLOURS, FAINT, INK
from app.model.roll import portraits
from app.text import say
from app.widgets.plots import PAPER, draw, on_pointer, padded, plain, rule

POINTS_OF_A_TRACK = 480  # on a screen


class Portrait:
    """A curve along which the motion runs, with a bead at the time of the clock. whole: all frames are drawn, not one
    nutation."""

    name = ""  # in roll.toml, and the name of the figure
    colour = COLOURS["theta"]
    whole = False
    aspect = False  # whether both axes have the same scale

    def __init__(self):
        ranges = {"match_aspect": True} if self.aspect else {"x_range": (0, 1), "y_range": (0, 1)}
        self.figure = fig = plain(name=self.name, **ranges)
        self.curve = ColumnDataSource({"t": np.zeros(2), "x": np.zeros(2), "y": np.zeros(2)})
        self.bead = ColumnDataSource({"x": [0.0], "y": [0.0]})
        seen = self.below() or ()
        line = draw(fig, Line, "x", "y", source=self.curve, line_color=self.colour, line_width=2.5)
        draw(fig, Scatter, "x", "y", source=self.bead, level="overlay", size=13, fill_color="white", line_color=INK,
             line_width=2)  # fmt: skip
        if self.aspect:
            fig.x_range.renderers = fig.y_range.renderers = [line, *seen]
        fig.js_on_change("inner_width", call("followCurve", curve=self.curve, bead=self.bead, fig=fig))
        on_pointer(fig, call("seekOnCurve", curve=self.curve, fig=fig, whole=self.whole))
        self._shown = None

    def below(self):
        """Draws what is below the curve, and returns what of it is to be seen as a whole."""

    def show(self, scene):
        shown = (scene.trajectory, scene.mu_s)
        if shown != self._shown:
            self._shown = shown
            self.draw(scene)

    def words(self, scene):
        return say(f"roll.portraits.{self.name}.says")

    def put(self, motion, x, y):
        self.curve.data = {"t": motion.t, "x": x, "y": y}

    def frame(self, x, y):
        """Sets the ranges so that they contain these values."""
        for range_, values in ((self.figure.x_range, x), (self.figure.y_range, y)):
            range_.update(**padded(np.min(values), np.max(values)))


class Curve(Portrait):
    name = "f"
    axes = "<i>θ</i> (rad)", "<i>θ̇</i><sup>2</sup> (<i>g</i>/<i>R</i>)"

    def below(self):
        rule(self.figure, "width", line_color=FAINT)

    def draw(self, scene):
        motion = scene.nutation
        square = portraits.square(scene)
        self.put(motion, motion.theta, square)
        self.frame(motion.theta, [0, square.max()])


class Phase(Portrait):
    name = "phase"
    axes = "<i>θ</i> (rad)", "<i>θ̇</i> (<i>g</i>/<i>R</i>)<sup>½</sup>"

    def below(self):
        self.levels = [ColumnDataSource({"x": [], "y": []}) for _ in range(3)]
        kinds = (FAINT, "solid"), (COLOURS["friction"], "dashed"), (COLOURS["normal"], "dashed")
        for source, (colour, dash) in zip(self.levels, kinds, strict=True):
            draw(self.figure, Line, "x", "y", source=source, line_color=colour, line_dash=dash, line_width=1.3,
                 line_alpha=0.8)  # fmt: skip

    def draw(self, scene):
        motion, loops = scene.nutation, scene.levels
        closed = [np.append(np.concatenate([(theta, rate), (theta[::-1], -rate[::-1])], axis=1), [[np.nan]] * 2, axis=1)
                  for theta, rate in loops]  # fmt: skip
        groups = np.concatenate(closed[:-2], axis=1), *closed[-2:]  # few arrays are sent faster
        for source, (x, y) in zip(self.levels, groups, strict=True):
            source.data = {"x": x, "y": y}
        self.put(motion, motion.theta, motion.omega[:, 0])
        outermost, fastest = loops[-1]
        edge = max(fastest.max(), motion.omega[:, 0].max())
        self.frame([*outermost, *motion.theta], [-edge, edge])


class Potential(Portrait):
    name = "potential"
    axes = "<i>θ</i> (rad)", "<i>E</i> (<i>MgR</i>)"
    colour = COLOURS["energy"]

    def below(self):
        self.potential = ColumnDataSource({"theta": [], "E": []})
        draw(self.figure, Line, "theta", "E", source=self.potential, line_color=INK, line_width=2)
        self.slip, self.lift = (rule(self.figure, "width", line_color=COLOURS[name], line_dash=[6, 4], line_width=1.5)
                                for name in ("friction", "normal"))  # fmt: skip

    def draw(self, scene):
        motion, marks = scene.nutation, scene.marks
        theta, E = scene.potential
        self.potential.data = {"theta": theta, "E": E}
        for span, limit in ((self.slip, marks.slip), (self.lift, marks.lift)):
            span.visible = bool(np.isfinite(limit))
            span.location = limit if span.visible else 0
        energy = scene.constants.E
        self.put(motion, motion.theta, np.full(len(motion.t), energy))
        top = max(energy, *(limit for limit in (marks.slip, marks.lift) if np.isfinite(limit)), energy + 0.05)
        self.frame(theta, [marks.steady, top + 0.1 * (top - marks.steady)])


class Track(Portrait):
    name = "track"
    axes = "<i>x</i> (<i>R</i>)", "<i>y</i> (<i>R</i>)"
    whole = True
    aspect = True

    def below(self):
        self.circles = ColumnDataSource({"x": [], "y": []})
        draw(self.figure, MultiLine, xs="x", ys="y", source=self.circles, line_color=FAINT, line_dash=[6, 4],
             line_width=1.5)  # fmt: skip

    def draw(self, scene):
        seen = portraits.track(scene, POINTS_OF_A_TRACK)
        self.put(seen, seen.x, seen.y)
        self.circles.data = {"x": [x for x, _ in seen.rings], "y": [y for _, y in seen.rings]}

    def words(self, scene):
        if scene.rosette is None:
            return say("roll.portraits.track.straight")
        _, _, nearest, farthest = scene.rosette
        return say("roll.portraits.track.says", nearest=nearest, farthest=farthest)


class Ring(Portrait):
    """The rosette unrolled: that of a large circle is too thin to be seen from above."""

    name = "ring"
    whole = True

    @property
    def axes(self):
        return say("roll.portraits.ring.across"), say("roll.portraits.ring.up")

    def below(self):
        self.edges = [rule(self.figure, "width", line_color=FAINT, line_dash=[6, 4], line_width=1.5) for _ in range(2)]

    def draw(self, scene):
        seen = portraits.track(scene, POINTS_OF_A_TRACK)
        for edge, location in zip(self.edges, (0.0, seen.width), strict=True):
            edge.location = location
        self.put(seen, seen.along, seen.across)
        self.frame(seen.along, [0, seen.width])


class Force(Portrait):
    name = "force"
    axes = "<i>F</i><sub>x</sub>/<i>F</i><sub>z</sub>", "<i>F</i><sub>y</sub>/<i>F</i><sub>z</sub>"
    colour = COLOURS["friction"]
    aspect = True

    def below(self):
        self.disc = ColumnDataSource({"x": [], "y": []})
        self.figure.background_fill_color, self.figure.background_fill_alpha = COLOURS["friction"], 0.12
        return [draw(self.figure, Patch, "x", "y", source=self.disc, fill_color=PAPER, line_color=INK,
                     line_dash=[6, 4], line_width=1.5)]  # fmt: skip

    def draw(self, scene):
        self.disc.data = dict(zip("xy", portraits.circle(scene.mu_s), strict=True))
        self.put(scene.nutation, *portraits.pushes(scene))
