"""The row at the head of the page: its name, the top, the tabs, the level, undo and redo, Share, and a menu behind
three dots. On a phone the tabs are at the foot.

The browser answers a click on a tab by showing the place of its room; Python then has the view created.
"""

import param

from app.bundle import Bundled
from app.state import validate
from app.text import LANGUAGES, listed, say, spoken
from app.widgets.forms import hear, one_of
from app.widgets.hold import held


class Head(Bundled):
    state = param.Dict(default={}, doc="Everything that it shows; set by HeadBar.")
    request = param.List(default=[], doc="[count, name, value] of a request; the browser writes it.")


class HeadBar:
    """view: the Head. rooms: the page's Rooms; url_state: its UrlState; look: its Look; toured: the room and level of
    the tour.

    does: {name: function of a value} for all other requests: "toy", "share", "language".
    """

    SWITCHES = ("dark", "large")

    def __init__(self, rooms, url_state, look, does, toured=None):
        self._rooms, self._url_state, self._look, self._toured, self._answered = rooms, url_state, look, toured, 0
        self._toy, self._toys, self._shares = "", [], False
        steps = {"undo": lambda value: url_state.undo(), "redo": lambda value: url_state.redo()}
        switches = {name: lambda value, name=name: setattr(look, name, bool(value)) for name in self.SWITCHES}
        goes = {name: lambda value, name=name: setattr(rooms, name, one_of(rooms.param[name].objects)(value))
                for name in ("room", "level")}  # fmt: skip
        self._does = steps | switches | goes | does
        self.view = Head(margin=0, sizing_mode="stretch_width")
        hear(self.view, request=self._heard)
        rooms.param.watch(self._say, ["room", "level"])
        url_state.param.watch(self._say, ["can_undo", "can_redo"])
        look.param.watch(self._say, list(self.SWITCHES))
        self._say()

    def _heard(self, event):
        count, name, value = validate.parts(event.new, validate.number, one_of(self._does), validate.anything)
        self._answered = int(count)
        with held():
            try:
                self._does[name](value)
            finally:
                self._say()  # confirms that it was answered

    def tops(self, chosen, known):
        """Sets the tops that can be chosen, as [name, words], and the present one; "" if it is none of them."""
        self._toy, self._toys = chosen, known
        self._say()

    def opened(self, shares):
        """Sets whether Share is open."""
        self._shares = shares
        self._say()

    def _say(self, *events):
        rooms, url_state = self._rooms, self._url_state
        names, here = listed("main.rooms"), rooms.tabs[rooms.tab]
        self.view.state = {
            "room": rooms.room, "level": rooms.level, "tab": rooms.tab,
            "tour": (rooms.room, rooms.level) == self._toured,
            "tabs": [[tab, say(f"main.tabs.{tab}"), rooms.first(tab)] for tab in rooms.tabs],
            "levels": [[level, say(f"main.levels.{level}")] for level in rooms.param.level.objects],
            # in the row below: other rooms of the tab
            "rooms": [[room, names.get(room, ""), room] for room in here] if len(here) > 1 else [],
            "places": {room: rooms.place(room) for room in rooms.param.room.objects},
            "toy": self._toy, "toys": self._toys, "undo": url_state.can_undo, "redo": url_state.can_redo,
            "shares": self._shares,
            "language": spoken(), "languages": [list(each) for each in LANGUAGES.items()],
            **{name: getattr(self._look, name) for name in self.SWITCHES}, "answered": self._answered,
        }  # fmt: skip
