"""The tab Maps: a map of runs, what one of them does, and what is set."""

import time
from contextlib import contextmanager
from functools import partial

import panel as pn
import panel_material_ui as pmui

from app.model.dimensions import named
from app.model.maps import COLOURS_BY, LAWS, QUANTITIES, SECONDS, Map
from app.model.maps_kept import keep, recall
from app.model.maps_lines import disagreement, lines
from app.model.maps_solving import run as one_run
from app.model.maps_solving import solve
from app.model.runs import MAPS, Run, Runs, Stopped
from app.share.parts import Copy
from app.state import asked as sent
from app.tabs.maps.export import KINDS, made, python, title, with_unit
from app.tabs.maps.picture import MapFigure, RunFigure
from app.tabs.maps.words import colours_say, of_disagreement, of_run, of_worst
from app.text import listed, say, told
from app.widgets.cards import BUTTON, alert, beside, field, flow, note, on_click, progress, words
from app.widgets.controls import typed_number
from app.widgets.download import Download
from tippe_core import PRESETS, TopError

PICTURE_EVERY = 0.3  # s
FIXED = ("spin", "tilt", "slip", "mu", "second")  # to be typed where they are on no axis
SIDE = {"background": "var(--card, white)", "border-radius": "10px", "padding": "10px 14px", "box-sizing": "border-box"}


class Maps:
    """The tab's content. runs: the page's Runs."""

    def __init__(self, runs=None):
        self._runs, self._run, self._silent = runs or Runs(), None, False
        self.asked, self.level, self._found = Map(), None, None
        start = self.asked.start
        self.place = (start["spin"], start["tilt"])
        self._make_choices()
        self._make_entries(start)
        self.head, self.bar, self.said = words(), words(visible=False, margin=(4, 0)), words()
        self.names, self.worst, self.key = words(), words(), words(margin=(6, 0))
        self.run_says, self.why = words(margin=(6, 0)), words()
        self.map, self.curve = MapFigure(self._by_hand), RunFigure()
        self.stop = pmui.Button(label=say("maps.stop"), disabled=True, **BUTTON)
        self.show_one = pmui.Button(label=say("maps.show_one"), visible=False, **BUTTON)
        on_click(self.stop, lambda event: self._run and self._run.stop())
        on_click(self.show_one, lambda event: self.go(*self._found.one, cell=True))
        self.python = Copy(label=say("maps.python"), button=listed("share.copy"), rows=6, sizing_mode="stretch_width")
        self.files = [
            Download(self._runs, lambda: (self.level, self.colour.value), partial(_file, kind), label=kind.upper(),
                     filename=f"tippe-top-map.{kind}", margin=0)
            for kind in KINDS
        ]  # fmt: skip
        self.map.begin(self.asked)
        self.draw()

    def _make_choices(self):
        quantities = {says: name for name, says in listed("maps.quantities").items()}
        bodies = {named(preset.name): preset.name for preset in PRESETS}
        tables = {
            "bodies": (bodies, self.asked.body),
            "across": (quantities, self.asked.across),
            "up": (quantities, self.asked.up),
            "colour": ({listed("maps.colours")[name]: name for name in COLOURS_BY}, "end"),
            "law": ({listed("maps.laws")[name]: name for name in LAWS}, self.asked.law),
        }
        self.choices = {name: pmui.Select(label=say(f"maps.{name}"), options=options, value=value, size="small",
                                          width=172, margin=(8, 0, 0, 0))
                        for name, (options, value) in tables.items()}  # fmt: skip
        self.colour = self.choices["colour"]
        for name, select in self.choices.items():
            select.param.watch(partial(self._chosen, name), "value")

    def _make_entries(self, start):
        called = listed("maps.quantities")
        shown = {"across_from": 5, "across_to": 50, "up_from": 1, "up_to": 40, "seconds": 6, "cells": 48}
        shown |= {name: start[name] for name in FIXED} | {"here_across": self.place[0], "here_up": self.place[1]}
        spoken = {"seconds": say("maps.seconds"), "cells": say("maps.cells")} | {name: called[name] for name in FIXED}
        for side in ("across", "up"):
            spoken |= {f"{side}_{end}": f"{say(f'maps.{side}')}, {say(f'maps.{end}')}" for end in ("from", "to")}
            spoken[f"here_{side}"] = f"{say('maps.here')}, {say(f'maps.{side}')}"
        self.entries = {name: field(f"{value:.4g}", spoken[name], width=66) for name, value in shown.items()}
        for name, entry in self.entries.items():
            entry.param.watch(partial(self._typed, name), "value")
        self.rows = {name: beside(_called(name, self.asked.law), self.entries[name]) for name in FIXED}
        self._show_rows()

    def _show_rows(self):
        taken, law = (self.choices["across"].value, self.choices["up"].value), self.choices["law"].value
        for name, row in self.rows.items():
            row.visible = name not in taken and (name != "second" or bool(SECONDS[law]))
            row[0].object = _called(name, law)

    @property
    def view(self):
        """The two sides, one above the other where there is little room."""
        entry = self.entries
        ranges = [flow(words(say(f"maps.{side}"), sizing_mode=None, width=80),
                       beside(say("maps.from"), entry[f"{side}_from"]), beside(say("maps.to"), entry[f"{side}_to"]),
                       margin=(4, 0))
                  for side in ("across", "up")]  # fmt: skip
        place = flow(words(say("maps.here"), sizing_mode=None), entry["here_across"], entry["here_up"], margin=(4, 0))
        left = [self.head, self.names, _figure(self.map.figure),
                flow(self.stop, self.bar, margin=(4, 0)), self.said, words(note(say("maps.hint"))), place, self.worst,
                words(f"<h2>{say('maps.export')}</h2>", margin=(8, 0)), flow(*self.files), self.python]  # fmt: skip
        right = [self.run_says, _figure(self.curve.figure),
                 words(f'<div class="axis">{say("maps.run.theta")}</div>'), self.key, self.why, self.show_one,
                 flow(*self.choices.values()), *ranges, flow(*self.rows.values()),
                 flow(*(beside(say(f"maps.{name}"), entry[name]) for name in ("seconds", "cells")))]  # fmt: skip
        sides = [pn.Column(*parts, margin=0, styles=SIDE | {"flex": flex, "min-width": "0"})
                 for parts, flex in ((left, "3 1 480px"), (right, "2 1 330px"))]  # fmt: skip
        styles = {"display": "flex", "flex-flow": "row wrap", "gap": "12px", "padding": "12px", "align-items": "start"}
        return pn.Column(*sides, sizing_mode="stretch_width", margin=0, styles=styles)

    # ---- what a person sets ----

    @contextmanager
    def _quietly(self):
        self._silent = True
        try:
            yield
        finally:
            self._silent = False

    def _chosen(self, name, event):
        if self._silent:
            return
        with self._quietly():
            if name in ("across", "up"):
                quantity = QUANTITIES[event.new]
                self._write({f"{name}_from": quantity.low, f"{name}_to": quantity.high})
            if name == "law":
                start = Map(law=event.new).start
                self._write({"second": start["second"]})
        self._show_rows()
        self.draw()

    def _typed(self, name, event):
        if self._silent:
            return
        if not name.startswith("here"):
            self.draw()
            return
        try:
            self.go(*(self._number(f"here_{side}") for side in ("across", "up")))
        except ValueError as error:
            self.said.object = alert(str(error))

    def _write(self, values):
        for name, value in values.items():
            self.entries[name].value = f"{value:.4g}"

    def _number(self, name):
        text = self.entries[name].value
        try:
            return typed_number(text)
        except ValueError:
            raise ValueError(say("maps.not_a_number", name=name, text=text)) from None

    def _map(self):
        """What is set, as a Map; raises ValueError, TopError."""
        value = {name: self._number(name) for name in self.entries if not name.startswith("here")}
        chosen = {name: select.value for name, select in self.choices.items()}
        axes = (chosen["across"], chosen["up"])
        fixed = tuple((name, value[name]) for name in FIXED if name not in axes)
        return Map(body=chosen["bodies"], across=axes[0], up=axes[1], law=chosen["law"], values=fixed,
                   across_range=(value["across_from"], value["across_to"]),
                   up_range=(value["up_from"], value["up_to"]), seconds=value["seconds"],
                   cells=int(value["cells"]) if value["cells"].is_integer() else value["cells"],
                   nudged=chosen["colour"] == "growth")  # fmt: skip

    # ---- the map ----

    def draw(self):
        """Draws what is set; where that cannot be, a sentence says why, and the last map stays."""
        try:
            asked = self._map()
        except ValueError as error:
            self.said.object = alert(told(error) if isinstance(error, TopError) else str(error))
            return
        self.said.object = ""
        self.head.object = f"<h2>{title(asked, self.colour.value)}</h2>" + note(
            say("maps.count", across=asked.cells, up=asked.cells, count=asked.cells**2)
        )
        if asked == self.asked and self.level is not None:
            self._show(self.level)
            return
        if (asked.across, asked.up, asked.across_range, asked.up_range) != self._axes(self.asked) or self.level is None:
            self._place_within(asked)
        self.asked, self.level = asked, None
        self.names.object = note(f"↑ {with_unit(asked.up)} &emsp; → {with_unit(asked.across)}")
        self.python.text = python(asked)
        self.map.begin(asked)
        self._run = Run(partial(self._work, asked), partial(self._done, asked))
        self.stop.disabled, self.bar.visible, self.bar.object = False, True, _bar(0)
        self._runs.begin(self._run, "maps", MAPS)
        if before := MAPS.before(self._runs):
            self.said.object = note(say("maps.waits", count=before))
        self.go(*self.place)

    @staticmethod
    def _axes(asked):
        return asked.across, asked.up, asked.across_range, asked.up_range

    def _place_within(self, asked):
        """The bead on the map: where it was, if that is on it, else in the middle."""
        spans = (asked.across_range, asked.up_range)
        same = (asked.across, asked.up) == (self.asked.across, self.asked.up)
        inside = same and all(low <= x <= high for x, (low, high) in zip(self.place, spans, strict=True))
        if not inside:
            self.place = tuple((low + high) / 2 for low, high in spans)

    def _work(self, asked, run):
        level = recall(asked)
        shown = 0.0
        if level is None:
            for level in solve(asked, run.look):
                # a message now and then: more would queue up on a slow line
                if level.whole or time.monotonic() > shown + PICTURE_EVERY:
                    shown = time.monotonic()
                    self._runs.post(partial(self._show_part, run, level.copy(), run.reached))
            keep(level)
        lines(asked)
        return level, disagreement(level)

    def _show_part(self, run, level, share):
        if run is self._run and not run.stopped:
            with pn.io.hold():
                self.said.object = ""
                self.bar.object = _bar(100 * share)
                self._show(level)

    def _show(self, level):
        self.level = level
        self.map.show(level, self.colour.value)
        self.key.object = colours_say(level, self.colour.value)

    def _done(self, asked, result):
        self.stop.disabled, self.bar.visible = True, False
        if isinstance(result, Stopped):
            self.said.object = note(say("maps.stopped"))
            return
        if isinstance(result, Exception):
            self.said.object = alert(say("maps.failed"))
            raise result
        level, self._found = result
        with pn.io.hold():
            self._show(level)
            self.said.object = ""
            self.worst.object = note(of_worst(level))
            self.why.object = of_disagreement(self._found, asked)
            self.show_one.visible = self._found is not None

    # ---- one run ----

    def _by_hand(self, data):
        """A place that the browser sends; what no page sends is passed over."""
        try:
            across, up = (sent.number(data[name][0]) for name in ("x", "y"))
            cell = bool(data["cell"][0])
        except (sent.Unasked, KeyError, IndexError, TypeError):
            return
        self.go(across, up, cell)

    def go(self, across, up, cell=False):
        """Shows the run of a place; cell: of the middle of the cell that it is in."""
        if cell and self.level is not None:
            i, j = self.level.cell(across, up)
            across, up = float(self.level.x[j]), float(self.level.y[i])
        self.place, asked = (across, up), self.asked
        self.map.bead.data = {"x": [across], "y": [up]}
        with self._quietly():
            self._write({"here_across": across, "here_up": up})
        self._runs.begin(
            Run(lambda run: one_run(asked, across, up, run.look), partial(self._ran, asked, across, up)), "maps-run"
        )

    def _ran(self, asked, across, up, result):
        if isinstance(result, TopError):
            self.run_says.object = alert(told(result))
        elif isinstance(result, Exception):
            if not isinstance(result, Stopped):
                raise result
        else:
            with pn.io.hold():
                self.run_says.object = of_run(asked, across, up, result)
                self.curve.show(result.t, result.theta, asked.seconds)


def _file(kind, level, colour):
    return made(level, colour, kind)


def _figure(figure):
    return pn.pane.Bokeh(figure, sizing_mode="stretch_width", height=figure.height, margin=0)


def _bar(percent):
    return progress(percent, say("maps.progress"))


def _called(name, law):
    if name == "second":
        return listed("maps.seconds_of")[law]
    return with_unit(name)
