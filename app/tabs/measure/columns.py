"""How the columns of a table were interpreted, with some of their values, to be corrected."""

import html
from dataclasses import replace

import numpy as np

from app.model.measured.names import UNITS
from app.model.measured.table import taken_as
from app.text import say, written
from app.widgets import cards
from app.widgets.cards import flow, note, words
from app.widgets.form import Form
from app.widgets.forms import Field, Menu, typed_number

FIRST = 4  # values


class Columns:
    """view: one row for each column. changed: called with a Table that was corrected; wrong: called with a sentence if
    a correction is impossible."""

    def __init__(self, changed, wrong):
        self._changed, self._wrong, self._table, self._errors = changed, wrong, None, ()
        self.rate, self.view = None, cards.column(margin=(8, 0))

    @property
    def frames_a_second(self):
        """Frames per second, as typed; 0 if empty."""
        try:
            return typed_number(self.rate.value)
        except ValueError:
            return 0.0

    def _ask_rate(self):
        """Makes an empty field for it."""
        self.rate = Field(say("measure.rate"), shows=say("measure.rate"))
        self.rate.on("value", lambda event: self._changed(self._table))
        return self.rate

    def show(self, table):
        """Shows a new table."""
        self._table, self._errors = table, ()
        self._of_rate = flow(self._ask_rate())
        self.view.objects = [Form(*(self._row(i, column) for i, column in enumerate(table.columns)), self._of_rate)]
        self.show_rate()

    def show_rate(self):
        """Asks for the frame rate if the time is counted in frames."""
        self._of_rate.visible = any(column.unit == "frames" for column in self._table.columns)

    def show_errors(self, data):
        """Shows in grey, where no error is typed, the one that the Data have."""
        for column, entry in zip(self._table.columns, self._errors, strict=True):
            series = data.series.get(column.quantity)
            size = series and series.error / UNITS[column.quantity][column.unit]
            entry.placeholder = written(size, ".2g") if series else ""

    def _row(self, i, column):
        values = column.values[np.isfinite(column.values)][:FIRST]
        shown = "; ".join(written(value, ".4g") for value in values)
        name = words(f"<b>{html.escape(column.name)}</b><br>{note(f'{shown} …')}", sizing_mode=None, width=170)
        quantity = Menu(say("measure.column.quantity", name=column.name), value=column.quantity,
                        options={says: key for key, says in _quantities().items()})  # fmt: skip
        unit = Menu(say("measure.column.unit"), value=column.unit, options=_units(column))
        error = Field(say("measure.column.error"), value="" if column.error is None else written(column.error, "g"),
                      shows="±", align="end")  # fmt: skip
        guessed = words(_guessed(column), sizing_mode=None, align="end")
        self._errors = (*self._errors, error)

        def asks(column):
            unit.visible, error.visible = bool(column.quantity), column.quantity not in ("", "time")

        asks(column)

        def correct(now):
            columns = (*self._table.columns[:i], now, *self._table.columns[i + 1 :])
            self._table = replace(self._table, columns=columns)
            unit.param.update(options=_units(now), value=now.unit)
            guessed.object = _guessed(now)
            asks(now)
            self.show_rate()
            self._changed(self._table)

        def to_unit(event):
            now = self._table.columns[i]
            if event.new != now.unit and event.new in UNITS.get(now.quantity, ()):
                correct(replace(now, unit=event.new, guessed=False))

        def to_error(event):
            try:
                size = typed_number(event.new) if event.new.strip() else None
            except ValueError:
                self._wrong(say("measure.wrong.error", name=column.name))
                return
            correct(replace(self._table.columns[i], error=size))

        quantity.on("value", lambda event: correct(taken_as(self._table.columns[i], event.new or "")))
        unit.on("value", to_unit)
        error.on("value", to_error)
        return flow(name, quantity, unit, error, guessed, margin=(4, 0))


def _guessed(column):
    return note(say("measure.guessed")) if column.guessed else ""


def _units(column):
    return {unit: unit for unit in UNITS.get(column.quantity, {"": 1})}


def _quantities():
    return {"": say("measure.unused"), "time": say("measure.quantities.time"),
            **{name: say(f"measure.quantities.{name}") for name in UNITS if name != "time"}}  # fmt: skip
