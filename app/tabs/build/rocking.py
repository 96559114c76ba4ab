"""A top of one's own, measured with a stopwatch, a balance and a caliper."""

import numpy as np

from app.model.build.builder import Rocking, rocks_once
from app.model.build.dimensions import sentence
from app.text import listed, say
from app.widgets.cards import alert, flow, note, words
from app.widgets.forms import Button, Field
from app.widgets.numbers import tidy
from tippe_core import TopError

AGREES = 2.0  # errors


class RockingFields:
    """A top of one's own: mass, diameter and the period of small rocking without spin -> a/R."""

    # name, size of the unit in SI; those that are left empty are the drawing's, but for the period
    FIELDS = (("T", 1.0), ("dT", 1.0), ("D", 1e-3), ("dD", 1e-3), ("M", 1e-3))
    TIMED = ("T", "dT")

    def __init__(self, builder):
        self.builder = builder
        spoken = listed("build.own.spoken")
        shows = listed("build.own.fields")
        self.entries = {name: Field(spoken[name], shows=shows[name]) for name, _ in self.FIELDS}
        self.formula, self.result = words(say("build.own.formula")), words()
        self.use = Button(say("build.own.explore"), self._use, margin=(4, 0))
        for entry in self.entries.values():
            entry.on("value", lambda event: self._show())
        builder.param.watch(lambda event: self._show(), "draft")
        self._show()

    @property
    def view(self):
        """Fields, formula, answer."""
        return [words(say("build.own.says")), self.formula, flow(*self.entries.values()), self.result, self.use]

    def _found(self):
        """(Rocking, Measured); raises TopError, ValueError."""
        values = self._drawn()
        for name, unit in self.FIELDS:
            entry = self.entries[name]
            if entry.value.strip() or name in self.TIMED:
                values[name] = entry.number("build.own.not_a_number") * unit
            else:
                entry.refuse()
        rocking = Rocking(**values)
        return rocking, rocking.a(self.builder.draft.shape)

    def _drawn(self):
        """The diameter and the mass of the drawing."""
        shape = self.builder.draft.shape
        return {"D": 2 * shape.scales.R, "dD": 0.0, "M": shape.mass}

    def _show(self):
        for name, value in self._drawn().items():
            self.entries[name].placeholder = tidy(value * 1e3)
        wording = self.builder.draft.messages.get("measured")
        if self.builder.draft.shape.top.a < 0:
            self.result.object = note(say("build.own.cannot"))
            self.use.disabled = True
            return
        shape = self.builder.draft.shape
        if not all(self.entries[name].value.strip() for name in self.TIMED):
            self.result.object, self.use.disabled = say("build.own.drawing", period=rocks_once(shape)), True
            return
        try:
            rocking, found = self._found()
        except ValueError as error:
            self.result.object = alert(sentence(error)) if isinstance(error, TopError) else ""
            self.use.disabled = True
            return
        self.use.disabled = False
        off = abs(found.value - shape.top.a) / found.uncertainty if found.uncertainty else np.inf
        agrees = say("build.own.agrees" if off <= AGREES else "build.own.differs", a=shape.top.a, times=off)
        self.result.object = alert(wording) or " ".join((say(
            "build.own.found", a=found.value, uncertainty=found.uncertainty, period=found.shares["T"],
            diameter=found.shares["R"], below=found.value * rocking.D / 2 * 1e3, I1=shape.top.I1), agrees))  # fmt: skip

    def _use(self):
        rocking, found = self._found()
        self.builder.measured(M=rocking.M, R=rocking.D / 2, a=found.value)
