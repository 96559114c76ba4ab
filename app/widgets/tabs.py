"""The tabs: a header, and a place for each view. A click is answered in the browser, at once; a view is made when
it is first looked at, and then stays. Until then its place says that it is being made, or that it could not be."""

import logging

import panel as pn
import panel_material_ui as pmui

from app.bundle import CALL
from app.text import say
from app.widgets.cards import BUTTON, alert, note, on_click, words

AROUND = (24, 28)

log = logging.getLogger("tippe")


class Place:
    """Where a view is to be. name: the place's own; make: a function that returns the view; soon: of a Pacer."""

    def __init__(self, name, make, soon):
        self._make, self._soon, self._view, self._asked = make, soon, None, False
        again = pmui.Button(label=say("main.making.again"), **BUTTON)
        on_click(again, lambda event: self.ask())
        self._wrong = [words(alert(say("main.making.failed")), margin=AROUND), pn.Row(again, margin=(0, 28))]
        self.column = pn.Column(
            self._waiting(), name=f"place of {name}", sizing_mode="stretch_width", margin=0, visible=False
        )

    @staticmethod
    def _waiting():
        return words(f'<div role="status">{note(say("main.making.waits"))}</div>', margin=AROUND)

    def ask(self):
        """Has the view made, where it is neither there nor under way."""
        if self._asked:
            return
        self._asked = True
        if self.column.objects == self._wrong:
            self.column.objects = [self._waiting()]
        self._soon(self.fill)

    def fill(self):
        """Makes the view now. What fails leaves a sentence, and can be asked for again."""
        self._asked = True
        try:
            self._view = self._view or self._make()
            self.column.objects = [self._view]
        except Exception:
            log.exception("a bug: a tab could not be made")
            self._asked = False
            self.column.objects = self._wrong


def tabs(views, keep, soon, opened, at_once):
    """A list of the header and the places.

    views: {name in the address: maker}; opened: the name of the one that is looked at first; at_once: those that are
    then made with the page. soon: of a Pacer.
    """
    first = list(views).index(opened)
    places = [Place(name, make, soon) for name, make in views.items()]
    columns = [place.column for place in places]
    header = pmui.Tabs(
        *((say(f"main.tabs.{name}"), pn.Spacer(height=0)) for name in views),
        active=first,
        sizing_mode="stretch_width",
        margin=0,
        sx={"& .MuiTab-root": {"textTransform": "none", "minHeight": 40, "padding": "8px 16px"}},
    )

    def look(active):
        if active not in range(len(places)):  # no page sends that
            return
        for i, column in enumerate(columns):
            column.visible = i == active
        # What another computes might overtake the page itself: it is made when that is there.
        if pn.state.loaded:
            places[active].ask()
        else:
            pn.state.onload(places[active].ask)

    if opened in at_once:
        columns[first].visible = True
        places[first].fill()
    else:
        look(first)
    header.param.watch(lambda event: look(event.new), "active")
    given = {"places": [column.name for column in columns]}
    header.jscallback(args={"run": "turnTab", "given": given}, active=CALL)
    # it is said always, and left out where it goes without saying
    keep.add(header, lambda header: {"active": None})
    return [header, *columns]
