"""A top of one's own, measured with a stopwatch, a balance and a caliper."""

from app.model.build.builder import Rocking
from app.model.build.dimensions import sentence
from app.text import listed, say
from app.widgets.cards import alert, flow, note, words
from app.widgets.forms import Button, Field
from app.widgets.numbers import typed_number
from tippe_core import TopError


class RockingFields:
    """A top of one's own: mass, diameter and the period of small rocking without spin -> a/R."""

    # name, initial value, size of the unit in SI
    FIELDS = (("D", "32.0", 1e-3), ("dD", "0.1", 1e-3), ("T", "1.08", 1.0), ("dT", "0.01", 1.0), ("M", "11.5", 1e-3))

    def __init__(self, builder):
        self.builder = builder
        spoken = listed("build.own.spoken")
        shows = listed("build.own.fields")
        self.entries = {name: Field(spoken[name], value=value, shows=shows[name]) for name, value, _ in self.FIELDS}
        self.formula, self.result = words(say("build.own.formula")), words()
        self.use = Button(say("build.own.explore"), self._use, margin=(4, 0))
        for entry in self.entries.values():
            entry.param.watch(lambda event: self._show(), "value")
        builder.param.watch(lambda event: self._show(), "draft")
        self._show()

    @property
    def view(self):
        """Fields, formula, answer."""
        return [words(say("build.own.says")), self.formula, flow(*self.entries.values()), self.result, self.use]

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

    def _use(self):
        rocking, found = self._found()
        self.builder.measured(M=rocking.M, R=rocking.D / 2, a=found.value)
