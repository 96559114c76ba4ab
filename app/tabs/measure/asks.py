"""What a table does not say by itself: which of its runs is meant, and from where a film was taken; and what was chosen
by hand, for the next file with the same columns."""

from dataclasses import replace

from app.model.measured.points import VIEWS
from app.text import say
from app.widgets.cards import column, flow, note, words
from app.widgets.forms import Choice, Menu

REMEMBERED = 20  # tables
DRAWN = """<svg width="150" height="52" viewBox="0 0 150 52" fill="none" stroke="currentColor" stroke-width="1.5"
aria-hidden="true"><path d="M2 45h66M30 18l10-15"/><circle cx="24" cy="31" r="14"/><circle cx="112" cy="26" r="22"/>
<path d="M112 26l20-14" stroke-width="3"/><circle cx="112" cy="26" r="2"/></svg>"""


class Asks:
    """view: the questions, if there are any. changed: called with the Table that answers them."""

    def __init__(self, changed):
        self._changed, self._table, self._chosen = changed, None, {}
        self.run = Menu(say("measure.which_run"), options={"": ""}, value="")
        self.seen = Choice({say(f"measure.views.{view}"): view for view in VIEWS}, VIEWS[0])
        self._of_view = flow(words(note(say("measure.which_view")), sizing_mode=None), words(DRAWN, sizing_mode=None),
                             self.seen)  # fmt: skip
        self.view = column()
        for part in (self.run, self.seen):
            part.on("value", self._answered)

    def show(self, table, anew):
        """Asks what this table leaves open; returns it, if not anew, with what was chosen before for such columns."""
        table = table if anew else self._as_before(table)
        runs = list(table.runs)
        self.run.put(options={run: run for run in runs or [""]}, value=table.run)
        self.seen.put(value=table.view or VIEWS[0])
        self.view.objects = [self.run] * (len(runs) > 1) + [self._of_view] * bool(table.view)
        self._table = table
        return table

    def _answered(self, event):
        if self._table is not None:
            self._table = self._table.of(self.run.value, self.seen.value if self._table.view else "")
            self.remember(self._table)
            self._changed(self._table)

    def remember(self, table):
        """Keeps what was chosen for the columns with these names."""
        names = tuple(column.name for column in table.columns)
        self._chosen.pop(names, None)
        self._chosen[names] = [replace(column, values=None) for column in table.columns], table.run, table.view
        if len(self._chosen) > REMEMBERED:
            self._chosen.pop(next(iter(self._chosen)))

    def _as_before(self, table):
        names = tuple(column.name for column in table.columns)
        if names not in self._chosen:
            return table
        chosen, run, view = self._chosen[names]
        columns = tuple(replace(was, values=now.values) for was, now in zip(chosen, table.columns, strict=True))
        return replace(table, columns=columns, run=run, view=view)
