"""Figures below the map, all at the bead: the final tilt over the spin with the steady motions, growth and rotation
rates of small deviations, and the scaling of the time of inversion."""

from functools import partial

import numpy as np
from bokeh.models import ColumnDataSource, Line, MultiLine, Scatter

from app.model import ends
from app.model.colours import ACCENT, INK
from app.model.maps.kept import read_below, ships_below
from app.model.maps.rates import rates
from app.model.maps.steady import bifurcation, spins_of
from app.model.once import ONCE
from app.model.runs import MAPS, WORK, Run, Stopped
from app.tabs.maps.words import with_unit
from app.text import error_text, listed, say
from app.widgets.cards import TABLE, Hidden, alert, note, words
from app.widgets.drawing import drawn
from app.widgets.failure import ended
from app.widgets.hold import held
from app.widgets.plots import draw, plain
from tippe_core import TopError

COLOURS = {"upright": ACCENT, "tumbling": ends.COLOUR["stem"], "inverted": "#9b2d20"}
OF_KEY = {ACCENT: "var(--accent)"}  # the figures change it on dark too
DASHES = {True: "solid", False: "dashed"}
SIDE_BY_SIDE = ".figures { display: flex; flex-flow: row wrap } .one { flex: 1 1 240px; min-width: 0 }"
SHADES = (ends.COLOUR["stem"], None)  # of the points after the first and the second time


class Bends:
    """The final tilt over the spin."""

    def __init__(self):
        self.figure = fig = _figure("bends", 230, (0, 184))
        fig.yaxis.ticker = [0, 45, 90, 135, 180]
        self.lines = ColumnDataSource({"xs": [], "ys": [], "dash": []})
        self.dots = [ColumnDataSource({"x": [], "y": []}) for _ in SHADES]
        self.sweeps = [ColumnDataSource({"x": [], "y": []}) for _ in ("up", "down")]
        self.life = ColumnDataSource({"x": [], "y": []})
        self.here = ColumnDataSource({"x": [0.0, 0.0], "y": [0.0, 184.0]})
        draw(fig, Line, "x", "y", source=self.life, line_color="#c77d2b", line_width=1.5)
        draw(fig, MultiLine, xs="xs", ys="ys", source=self.lines, line_color=INK, line_width=2, line_dash="dash")
        for source, shade in zip(self.dots, SHADES, strict=True):
            draw(fig, Scatter, "x", "y", source=source, size=6, fill_color=shade, line_color=INK, line_width=0.8)
        for source, marker in zip(self.sweeps, ("triangle", "inverted_triangle"), strict=True):
            draw(fig, Line, "x", "y", source=source, line_color=ACCENT, line_width=1, line_alpha=0.6)
            draw(fig, Scatter, "x", "y", source=source, marker=marker, size=7, fill_color=None, line_color=ACCENT)
        draw(fig, Line, "x", "y", source=self.here, line_color=ACCENT, line_width=1.5)

    @property
    def sources(self):
        return self.lines, *self.dots, *self.sweeps, self.life

    def show(self, found):
        """Draws a Bifurcation."""
        self.figure.x_range.update(start=float(found.spin[0]), end=float(found.spin[-1]))
        self.lines.data = {"xs": [line.spin for line in found.lines], "ys": [line.theta for line in found.lines],
                           "dash": [DASHES[line.stable] for line in found.lines]}  # fmt: skip
        for source, theta in zip(self.dots, found.theta, strict=True):
            source.data = {"x": found.spin, "y": theta}
        for source, theta in zip(self.sweeps, (found.up, found.down), strict=True):
            source.data = {"x": found.swept, "y": theta}
        inside = found.life.spin >= found.spin[0]
        self.life.data = {"x": np.where(inside, found.life.spin, np.nan), "y": found.life.theta}


class Rates:
    """How fast small deviations grow and turn, over the spin."""

    def __init__(self):
        self.figures = grow, turn = _figure("growth", 170), _figure("turning", 170)
        self.branches = {}
        for name, colour in COLOURS.items():
            line, runs = ColumnDataSource({"x": [], "growth": [], "turning": []}), ColumnDataSource({"x": [], "y": []})
            draw(grow, Line, "x", "growth", source=line, line_color=colour, line_width=2)
            draw(turn, Line, "x", "turning", source=line, line_color=colour, line_width=2)
            draw(grow, Scatter, "x", "y", source=runs, size=6, fill_color=colour, line_color=INK)
            self.branches[name] = line, runs

    @property
    def sources(self):
        return sum(self.branches.values(), ())

    def show(self, branches):
        for branch in branches:
            line, runs = self.branches[branch.name]
            line.data = {"x": branch.spin, "growth": branch.growth, "turning": branch.turning / (2 * np.pi)}
            runs.data = {"x": branch.run_spin, "y": branch.run_growth}
            for fig in self.figures:
                fig.x_range.update(start=float(branch.spin[0]), end=float(branch.spin[-1]))
        of_figures = ([(b.growth, b.run_growth) for b in branches], [(b.turning / (2 * np.pi),) for b in branches])
        for fig, rows in zip(self.figures, of_figures, strict=True):
            seen = np.concatenate([np.zeros(1), *(np.ravel(row) for rows_ in rows for row in rows_)])
            seen = seen[np.isfinite(seen)]
            room = 0.06 * (np.ptp(seen) or 1.0)
            fig.y_range.update(start=float(seen.min() - room), end=float(seen.max() + room))


class Steady:
    """view: its parts. show() computes the results for a place of a map in a thread; the newest request counts."""

    def __init__(self, runs):
        self._runs, self._key, self._drawn = runs, None, False
        self.title, self.says, self.key, self.rates_title = words(), words(), words(), words()
        self.laws, self.powers = words(style=TABLE), words(style=TABLE)
        self.bends = drawn(Bends)
        self.pair, self._small = None, None  # the figures of growth and turning, once they are shown
        self.deep = Hidden(self._deep)

    @property
    def view(self):
        return [self.title, self.bends.drawing, self.key, self.says, self.deep]

    def _deep(self):
        """What is open at the level Research: the rates, and the tables of scaling."""
        self.pair, spins = drawn(Rates, stylesheets=[SIDE_BY_SIDE]), self.bends.figure.x_range
        for fig in self.pair.figures:
            fig.x_range.update(start=spins.start, end=spins.end)
        self._draw_rates()
        named = listed("maps.branches")
        key = "".join(f'<span style="color: {OF_KEY.get(colour, colour)}">■</span> {named[name]} &emsp; '
                      for name, colour in COLOURS.items())  # fmt: skip
        return [self.rates_title, words(note(key)), self.pair.drawing, self.laws, self.powers]

    def show(self, request, place):
        """Computes and draws the results for the bead at a place of a Map."""
        x = request.values_at(*place)
        self.bends.here.data = {"x": [x["spin"]] * 2, "y": [0.0, 184.0]}
        moved = {name: value for name, value in x.items() if name != "spin"}
        key = (request.body, request.own, request.law, request.seconds, request.across, request.up,
               request.across_range, request.up_range, *moved.values(), round(x["spin"], 1))  # fmt: skip
        if key == self._key:
            return
        self._key = key
        if not self._drawn:  # else the figures still show the previous place
            self.title.object = _title(x)
            for fig in (self.bends.figure, *(self.pair.figures if self.pair else ())):
                fig.x_range.update(**dict(zip(("start", "end"), spins_of(request), strict=True)))
        self.says.object = note(say("maps.steady.waits"))
        wanted = bifurcation, request, *place
        ships = ships_below(request, place)

        def work(run):
            if ships:
                return read_below(request)
            return bifurcation(request, place, run.look), rates(request, place, run.look)

        run = Run(lambda run: ONCE.find(run.wait, wanted, partial(work, run)), partial(self._done, key, x))
        self._runs.begin(run, "maps-steady", WORK if ships or wanted in ONCE else MAPS)

    def _done(self, key, x, result):
        if key != self._key:
            return
        if isinstance(result, TopError):
            with held():
                self.title.object = _title(x)
                self._clear()
                self.says.object = alert(error_text(result))
            return
        if isinstance(result, Exception):
            self._key = None  # so that it is computed again
            self.says.object = note(ended(result))
            if not isinstance(result, Stopped):
                raise result
            return
        found, small = result
        self._small = small
        with held():
            self._drawn, self.title.object = True, _title(x)
            self.bends.show(found)
            self._draw_rates()
            self.says.object = of_life(found)
            first, second = found.times
            self.key.object = note(say("maps.steady.key", first=first, second=second))
            self.laws.object, self.powers.object = of_laws(small.laws, x), of_powers(small.powers)

    def _clear(self):
        """Clears the results of the previous place."""
        self._drawn, self._small = False, None
        for wording in (self.rates_title, self.key, self.laws, self.powers):
            wording.object = ""
        for source in (*self.bends.sources, *(self.pair.sources if self.pair else ())):
            source.data = {name: [] for name in source.data}

    def _draw_rates(self):
        if self.pair and self._small is not None:
            self.rates_title.object = f"<h2>{say('maps.steady.rates')}</h2>"
            self.pair.show(self._small.branches)


def _title(x):
    return f"<h2>{say('maps.steady.title', tilt=x['tilt'])}</h2>"


def of_life(found):
    """What becomes of the bead's run in the long term, and whether the sweeps up and down differ."""
    life, wording = found.life, []
    if np.isfinite(life.stands):
        wording.append(say("maps.steady.stands", time=life.stands))
        wording.append(say("maps.steady.leaves", time=life.leaves) if np.isfinite(life.leaves)
                    else say("maps.steady.stays", time=life.seconds))  # fmt: skip
    if np.isfinite(life.rolls):
        wording.append(say("maps.steady.rolls", time=life.rolls))
    wording.append(say("maps.steady.end", time=life.seconds, tilt=life.end))
    if differ := found.hysteresis:
        wording.append(say("maps.steady.hysteresis", low=differ[0], high=differ[1]))
    else:
        wording.append(say("maps.steady.no_hysteresis"))
    return " ".join(wording)


def of_laws(laws, x):
    """A table: growth and rotation of small motions at the spin of the bead, for each law."""
    cells = {(each.law, each.branch): say("maps.steady.of_law", growth=each.growth, turning=each.turning / (2 * np.pi))
             for each in laws if np.isfinite(each.growth)}  # fmt: skip
    return note(say("maps.steady.laws", spin=x["spin"])) + _table(cells, listed("maps.branches")) if laws else ""


def of_powers(powers):
    """A table: how the time to reach 90 degrees scales with each quantity, for each law."""
    if not powers:
        return ""
    named = listed("maps.quantities")
    table = _table({(power.law, power.quantity): _power(power) for power in powers},
                   {name: named[name] for name in ("spin", "mu", "second")})  # fmt: skip
    return f"<h2>{say('maps.steady.powers')}</h2>" + note(say("maps.steady.powers_say")) + table


def _power(power):
    if np.isfinite(power.power):
        return say("maps.steady.power", power=power.power, error=power.error)
    return say("maps.steady.few_powers" if power.runs else "maps.steady.no_power")


def _table(cells, columns):
    """A row for each law. cells: {(law, a key of columns): its words}; columns: {key: its name}."""
    rows = "".join(f"<tr><th scope='row'>{name}</th>"
                   + "".join(f"<td>{cells.get((law, column), '')}</td>" for column in columns) + "</tr>"
                   for law, name in listed("maps.laws").items())  # fmt: skip
    head = "".join(f"<th scope='col'>{name}</th>" for name in columns.values())
    return f"<table><tr><th></th>{head}</tr>{rows}</table>"


def _figure(name, height, span=(0, 1)):
    return plain(say(f"maps.labels.{name}"), height, name=f"maps-{name}", x_range=(0, 1), y_range=span,
                 min_border_left=44, x_axis_label=with_unit("spin"))  # fmt: skip
