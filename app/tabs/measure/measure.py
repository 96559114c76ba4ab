"""The tab Measure: what somebody measured of a top on film, beside rolling and sliding, with fitted numbers."""

import html
from dataclasses import replace

import panel as pn
import panel_material_ui as pmui

from app.model.measured_data import corrected, settled
from app.model.measured_examples import EXAMPLES, FOLDER
from app.model.measured_fit import fit
from app.model.measured_kept import kept
from app.model.measured_motion import model_of
from app.model.measured_report import program, residuals_table
from app.model.measured_table import UNITS, MeasuredError, read
from app.model.runs import Run, Runs, Stopped
from app.tabs.measure.figures import pictures
from app.tabs.measure.file import MeasuredFile
from app.tabs.measure.report import report
from app.tabs.measure.words import TABLE, found_words, models_table, notes_words, numbers_table
from app.text import listed, say, told
from app.widgets.cards import BUTTON, PLAIN, alert, card, field, flow, grid, note, on_click, words
from app.widgets.controls import typed_number
from app.widgets.download import Download
from tippe_core import TopError

LOOSE = {"body": ("a", "I1", "I3"), "push": ("tilt_rate", "across"), "losses": ("rolling_resistance", "air_drag")}
SELECT = {"size": "small", "margin": 0, "width": 150}


class Measure:
    """view: the tab. scene: the first, whose top is the one that was filmed; show() is for others. runs: the page's
    Runs."""

    def __init__(self, scene, runs=None):
        self._scene, self._runs, self._run = scene, runs or Runs(), None
        self._table, self._data, self._fits, self._part = None, None, None, (0.0, 0.0)
        self._thinned = 1
        self.file = MeasuredFile(sizing_mode="stretch_width", margin=(6, 0))
        self.file.param.watch(lambda event: self.take(event.new[0], event.new[1]), "table")
        self.file.param.watch(lambda event: self._wrong(say("measure.large", size=event.new)), "refused")
        self.said, self.columns = words(), pn.Column(sizing_mode="stretch_width", margin=0)
        self.rate = field("", say("measure.rate"))
        self.rate.param.watch(lambda event: self._settle(), "value")
        self.part = pmui.RangeSlider(label=say("measure.part"), start=0, end=1, value=(0, 1), step=0.01, format="0.00",
                                     visible=False, margin=(6, 12), sizing_mode="stretch_width")  # fmt: skip
        self.part.param.watch(lambda event: self._draw(), "value_throttled")
        self.law = pmui.RadioButtonGroup(label="", options={says: law for law, says in listed("measure.laws").items()},
                                         value="contensou", size="small", margin=0, sx=PLAIN)  # fmt: skip
        self.loose = pmui.CheckBoxGroup(label=say("measure.loose_label"), value=[], inline=True, margin=(4, 0),
                                        options={says: name for name, says in listed("measure.loose").items()},
                                        )  # fmt: skip
        self.start = pmui.Button(label=say("measure.fit"), disabled=True, **BUTTON)
        self.cancel = pmui.Button(label=say("measure.cancel"), disabled=True, **BUTTON)
        on_click(self.start, self.compute)
        on_click(self.cancel, lambda event: self._run and self._run.stop())
        self.curves = pn.Column(sizing_mode="stretch_width", margin=0)
        self.found = words(note(say("measure.nothing_yet")), style=TABLE)
        self.home = flow(*self._downloads())
        self.home.visible = False

    @property
    def view(self):
        """Two cards: what was measured, and what was found."""
        examples = [pmui.Button(label=says, **BUTTON) for says in listed("measure.examples").values()]
        for button, name in zip(examples, EXAMPLES, strict=True):
            on_click(button, lambda event, name=name: self.take((FOLDER / f"made-{name}.csv").read_bytes()))
        measured = card(say("measure.measured"), words(say("measure.says")), self.file, flow(*examples), self.said,
                        self.columns, self.part, self.curves, height="max-content")  # fmt: skip
        found = card(say("measure.found_title"), words(say("measure.of_this_top")), flow(self.law), self.loose,
                     flow(self.start, self.cancel), self.found, self.home, words(note(say("measure.private"))),
                     words(say("measure.recipe")), height="max-content")  # fmt: skip
        return grid(measured, found)

    def show(self, scene):
        """From now on a film is of the top of this scene; what was fitted stays as it is."""
        self._scene = scene

    def _downloads(self):
        kinds = {"report": "top-on-film.html", "residuals": "residuals.csv", "program": "repeat_fit.py"}
        for kind, name in kinds.items():
            yield Download(self._runs, lambda: self._home, getattr(self, f"_{kind}"), label=say(f"measure.home.{kind}"),
                           filename=name)  # fmt: skip

    @property
    def _home(self):
        """What the files are made of."""
        return self._data.between(*self._part), self._fits, tuple(self._loose), self._part, self.found.object

    def _report(self, data, fits, loose, part, found):
        return report(data, fits, found, program(data, fits, loose, *part)).encode()

    def _residuals(self, data, fits, *others):
        return residuals_table(data, min(fits, key=lambda each: each.aic)).encode()

    def _program(self, data, fits, loose, part, found):
        return program(data, fits, loose, *part).encode()

    def _wrong(self, sentence):
        self.said.object = alert(sentence)

    def take(self, text, each=1):
        """A table, bytes or text. One that cannot be read leaves what was there."""
        try:
            table = read(text)
        except MeasuredError as error:
            self._wrong(say(f"measure.wrong.{error.code}", **error.numbers))
            return
        self._table, self._thinned = table, each
        self.columns.objects = [self._column(i, column) for i, column in enumerate(table.columns)]
        self._settle()

    def _column(self, i, column):
        """Its name, and what it is taken for."""
        name = words(f"{i + 1}. {html.escape(column.name)}", sizing_mode=None, width=120, margin=(6, 0))
        quantity = pmui.Select(label=say("measure.column.quantity", name=column.name), value=column.quantity,
                               options={says: key for key, says in self._quantities().items()}, **SELECT)  # fmt: skip
        unit = pmui.Select(label=say("measure.column.unit"), value=column.unit,
                           options=[*UNITS.get(column.quantity, {"": 1})], **SELECT | {"width": 85})  # fmt: skip
        error = field("" if column.error is None else f"{column.error:g}", say("measure.column.error"), width=56)

        def changed(event):
            now = corrected(self._table.columns[i], quantity.value, unit.value)
            try:
                now = replace(now, error=typed_number(error.value) if error.value.strip() else None)
            except ValueError:
                self._wrong(say("measure.wrong.error", name=column.name))
                return
            unit.param.update(options=[*UNITS.get(now.quantity, {"": 1})], value=now.unit)
            columns = (*self._table.columns[:i], now, *self._table.columns[i + 1 :])
            self._table = replace(self._table, columns=columns)
            self._settle()

        for entry in (quantity, unit, error):
            entry.param.watch(changed, "value")
        return flow(name, quantity, unit, words("±", sizing_mode=None), error, margin=(4, 0))

    @staticmethod
    def _quantities():
        return {"": say("measure.unused"), "time": say("measure.quantities.time"),
                **{name: say(f"measure.quantities.{name}") for name in UNITS if name != "time"}}  # fmt: skip

    def _settle(self):
        """The data of the table as it is understood now."""
        if self._table is None:
            return
        frames = any(column.unit == "frames" for column in self._table.columns)
        if frames and self.rate not in self.columns.objects:
            self.columns.append(flow(words(say("measure.rate"), sizing_mode=None), self.rate))
        try:
            data = settled(self._table, self._frame_rate())
        except MeasuredError as error:
            self._wrong(say(f"measure.wrong.{error.code}", **error.numbers))
            self.start.disabled = True
            return
        self._data = data
        thinned = note(say("measure.thinned", each=self._thinned)) if self._thinned > 1 else ""
        self.said.object = note(notes_words(self._table.notes)) + thinned
        first, last = float(data.t[0]), float(data.t[-1])
        self.part.param.update(start=first, end=last, value=(first, last), step=(last - first) / 200 or 0.01,
                               visible=True)  # fmt: skip
        self._draw()

    def _frame_rate(self):
        try:
            return typed_number(self.rate.value)
        except ValueError:
            return 0.0

    def _draw(self):
        """The dots alone: what was fitted before is no longer of this."""
        self._fits, self._part = None, tuple(map(float, self.part.value))
        self.home.visible = False
        self.found.object = note(say("measure.ready"))
        try:
            self._data.between(*self._part)
        except MeasuredError as error:
            self._wrong(say(f"measure.wrong.{error.code}", **error.numbers))
            self.start.disabled = True
            return
        self.start.disabled = False
        self.curves.objects = pictures(self._data)

    @property
    def _loose(self):
        return [name for key in self.loose.value for name in LOOSE[key]]

    def compute(self, event=None):
        """Both fits, beside the server."""
        scene, data, law, loose = self._scene, self._data.between(*self._part), self.law.value, self._loose
        of_rolling = tuple(name for name in loose if name in LOOSE["body"])

        def work(run):
            models = [model_of(name, scene.top, scene.scales, scene.shape, names)
                      for name, names in (("rolling", of_rolling), (law, loose))]  # fmt: skip
            return (*(fit(model, data) for model in models), kept(data, scene.top, scene.scales))

        self.start.disabled, self.cancel.disabled = True, False
        self.found.object = f'<div role="status">{note(say("measure.waits"))}</div>'
        self._run = Run(work, self._done)
        self._runs.begin(self._run, "fit")

    def _done(self, result):
        self.start.disabled, self.cancel.disabled = False, True
        if isinstance(result, Exception):
            said = told(result) if isinstance(result, TopError) else say("measure.failed")
            self.found.object = note(say("measure.cancelled")) if isinstance(result, Stopped) else alert(said)
            if not isinstance(result, (Stopped, TopError)):
                raise result
            return
        *fits, constants = result
        self._fits = tuple(fits)
        rolling, sliding = fits
        better = min(fits, key=lambda each: each.aic)
        unit = better.model.scales.angular_velocity
        self.found.object = (found_words(rolling, sliding, constants) + numbers_table(better, unit)
                             + models_table(rolling, sliding))  # fmt: skip
        self.curves.objects = pictures(self._data, better.left, *self._part)
        self.home.visible = True
