"""The rooms of the page: a place for each view, one of which is visible. The browser answers a click at once; a view is
created when it is first shown, and then stays; if nobody has looked at it for long, the page gives its parts back.
Until then its place says that it is being created, or that this failed."""

import logging
import time
from functools import partial

import panel as pn
import param

from app import turns
from app.model.runs import connected_to, to_session
from app.text import say
from app.widgets.cards import alert, column, note, words
from app.widgets.failure import after_long, attempt
from app.widgets.form import Form
from app.widgets.forms import Button
from app.widgets.hold import held

AROUND = (24, 28)
AWAY = 600.0  # s after which a Form gives its parts back: Python has what was entered in it

log = logging.getLogger("tippe")


class Place:
    """The place of a view. name: its name; make: a function that returns the view; add: RenderScheduler.now.

    Views are created in turn among all pages of the server, in two steps: the view, and then what the browser gets of
    it. Between the steps, and after them, others are served."""

    def __init__(self, name, make, add):
        self._make, self._add, self._view, self._requested = make, add, None, False
        self._waits, self._stands = False, False  # whether the view is to be shown, and whether it is
        self._left = None  # when the page looked elsewhere
        self._failed, self._turn, self._document = False, None, pn.state.curdoc
        self._says = words(self._waiting(), margin=AROUND)
        self.column = column(self._says, name=f"place-of-{name}", visible=False)

    @staticmethod
    def _waiting(before=0):
        """What stands there until the view does; before: how many are served first."""
        name = {0: "waits", 1: "next"}.get(before, "before")
        return f'<div role="status">{note(say(f"main.making.{name}", count=before))}</div>'

    def ask(self):
        """Has the view created when its turn comes, unless it exists or is being created."""
        if self._requested:
            return
        self._requested = True
        if self._failed:
            self._failed = False
            self.column.objects, self._stands = [self._says], False
        self._says.object = self._waiting()
        if self._document is None or self._document.session_context is None:  # no server, so no others
            self._add(self.fill)
            return
        self._line_up()

    def leave(self):
        """Its page looks elsewhere: it gives up its turn, unless that has come."""
        if self._turn is not None and self._turn.leave():
            self._turn, self._requested = None, False

    def left(self):
        """Its page looks elsewhere from now on: after a long time it gives its parts back."""
        self._left = time.monotonic()
        after_long(AWAY, self._is_away, self._left)

    def _is_away(self, left):
        if connected_to(self._document)():
            self._post(partial(self._give_back, left))
        elif left == self._left:  # its line is cut for a moment, or it is gone, and this with it
            after_long(AWAY, self._is_away, left)

    def _give_back(self, left):
        is_away = self._stands and left == self._left and not self.column.visible
        if is_away and isinstance(self._view, Form):
            self.column.objects, self._requested, self._stands = [self._says], False, False

    def fill(self):
        """Creates the view now. An error leaves a sentence, and creating it can be tried again."""
        self._requested = True
        self._attempt(self._view_made, self._end)

    def _line_up(self):
        self._turn = turns.rooms().ask(self._document, self._come, self._tell)

    def _come(self, turn):
        """The turn has come, but the page's document is not locked yet."""
        if connected_to(self._document)():
            self._post(partial(self._step, turn))
        elif turn.begin():
            self._requested = False
            turn.done(0)

    def _post(self, act):
        to_session(self._document)(partial(attempt, act))

    def _step(self, turn):
        if turn is not self._turn:  # it was given up meanwhile
            return
        if not turn.begin():  # it was not taken up in time
            self._line_up()
            return
        start = time.monotonic()
        try:
            if self._waits:
                self._add(partial(self._attempt, self._put))
            else:
                with held():
                    self._attempt(self._create)
        finally:
            end = turn.rest if self._waits and not self._failed else turn.done
            end(time.monotonic() - start)

    def _tell(self, before):
        self._post(lambda: setattr(self._says, "object", self._waiting(before)))

    def _view_made(self):
        self._view = self._view or self._make()

    def _create(self):
        self._view_made()
        self._waits = True

    def _put(self):
        """Shows the view, with all that goes with it: each change by itself would have all models counted."""
        self._waits = False
        with self._document.models.freeze():
            self._end()

    def _end(self):
        self.column.objects, self._stands = [self._view], True

    def _attempt(self, *steps):
        try:
            for step in steps:
                step()
        except Exception:
            log.exception("a bug: a tab could not be made")
            self._requested, self._failed = False, True
            again = Button(say("main.making.again"), self.ask)
            self.column.objects = [
                words(alert(say("main.making.failed")), margin=AROUND),
                pn.Row(again, margin=(0, 28)),
            ]


class Rooms(param.Parameterized):
    """room: the name of the room that is shown; level: how much the page shows.

    makers: {name in the address: function that creates the view}; tabs: {name: names of its rooms}; levels: the names
    of levels; opened, level: what is shown first; usual: the room if there is no such one; at_once: rooms whose view is
    then created with the page. add: RenderScheduler.now.
    """

    room = param.Selector(doc="a key of makers")
    level = param.Selector(doc="one of the levels")

    def __init__(self, makers, tabs, levels, url_state, add, at_once, opened, usual, level):
        super().__init__()
        self.tabs = tabs
        self.param.room.objects, self.param.level.objects = list(makers), list(levels)
        self.room = opened if opened in makers else usual
        self.level = level
        self._places = {name: Place(name, make, add) for name, make in makers.items()}
        self._at_once = at_once
        self._last = {}  # tab -> the room of it that was shown last
        self.columns = [place.column for place in self._places.values()]
        self._last[self.tab] = self.room
        if self.room in at_once:
            self._places[self.room].column.visible = True
            self._places[self.room].fill()
        else:
            self._look()
        self.param.watch(self._moved, "room")
        # both are always given to the UrlState, which leaves them out of a link if they are the default
        url_state.add(self, lambda rooms: {"room": None, "level": None})

    @property
    def tab(self):
        """The name of the tab to which the present room belongs."""
        return next(tab for tab, rooms in self.tabs.items() if self.room in rooms)

    def first(self, tab):
        """The room that a tab shows when it is chosen: the last one that was shown."""
        return self._last.get(tab, self.tabs[tab][0])

    def place(self, room):
        """The name in the document of a room's place."""
        return self._places[room].column.name

    def _moved(self, event):
        self._last[self.tab] = self.room
        if event.old not in self._at_once:
            self._places[event.old].left()
        self._look()

    def _look(self):
        for name, place in self._places.items():
            place.column.visible = name == self.room
            if name != self.room:
                place.leave()
        # Its results might reach the page before the page itself: it is created once that has loaded.
        ask = self._places[self.room].ask
        if pn.state.loaded:
            ask()
        else:
            pn.state.onload(ask)
