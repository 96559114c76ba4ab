"""A top of one's own, measured with a stopwatch, a balance and a caliper."""

import panel as pn
import panel_material_ui as pmui

from app.model.build.builder import Rocking
from app.model.build.dimensions import sentence
from app.tabs.build.fields import grid
from app.text import listed, say
from app.widgets.cards import BUTTON, alert, field, note, on_click, words
from app.widgets.numbers import typed_number
from tippe_core import TopError


class RockingFields:
    """A top of one's own: mass, diameter and the period of small rocking without spin -> a/R."""

    # name, initial value, size of the unit in SI
    FIELDS = (("D", "32.0", 1e-3), ("dD", "0.1", 1e-3), ("T", "1.08", 1.0), ("dT", "0.01", 1.0), ("M", "11.5", 1e-3))

    def __init__(self, builder):
        self.builder = builder
        spoken = listed("build.own.spoken")
        self.entries = {name: field(value, spoken[name]) for name, value, _ in self.FIELDS}
        self.formula, self.result = words(say("build.own.formula")), words()
        self.use = pmui.Button(label=say("build.own.explore"), **BUTTON | {"margin": (4, 0)})
        on_click(self.use, self._use)
        for entry in self.entries.values():
            entry.param.watch(lambda event: self._show(), "value")
        builder.param.watch(lambda event: self._show(), "draft")
        self._show()

    @property
    def view(self):
        """Fields, formula, answer."""
        fields = [
            pn.Row(words(note(says), margin=(5, 6, 0, 0)), self.entries[name], sizing_mode="stretch_width",
                   margin=(2, 0))
            for name, says in listed("build.own.fields").items()]  # fmt: skip
        return [words(say("build.own.says")), self.formula, grid(*fields), self.result, self.use]

    def _found(self):
        """(Rocking, Measured); raises TopError, ValueError."""
        values = {}
        for name, _, unit in self.FIELDS:
            entry = self.entries[name]
            try:
                values[name] = typed_number(entry.value) * unit
            except ValueError:
                raise ValueError(say("build.own.not_a_number", text=entry.value)) from None
        rocking = Rocking(**values)
        return rocking, rocking.a(self.builder.draft.shape)

    def _show(self):
        said = self.builder.draft.messages.get("measured")
        if self.builder.draft.shape.top.a < 0:
            self.result.object = note(say("build.own.cannot"))
            self.use.disabled = True
            return
        try:
            rocking, found = self._found()
        except ValueError as error:
            self.result.object = alert(sentence(error) if isinstance(error, TopError) else str(error))
            self.use.disabled = True
            return
        self.use.disabled = False
        self.result.object = alert(said) or say(
            "build.own.found", a=found.value, uncertainty=found.uncertainty, period=found.shares["T"],
            diameter=found.shares["R"], below=found.value * rocking.D / 2 * 1e3,
            I1=self.builder.draft.shape.top.I1)  # fmt: skip

    def _use(self, event):
        rocking, found = self._found()
        self.builder.measured(M=rocking.M, R=rocking.D / 2, a=found.value)
