"""The components of Share: the address and keys, the link and its code, a photo, the time."""

import param

from app.bundle import ENCODERS, Bundled, Encoders, address_of


class Address(Bundled):
    """The page's own address, history and keys: sets its query to `search`, which is a new entry of the browser's
    history where `where` changes, and tells whether a hand is down and which gesture it makes."""

    search = param.String(default="", doc="the part after the path; written to the address bar")
    where = param.String(default="", doc="what is open; any text")
    visited = param.List(
        default=[], doc="[count, where] when the browser's Back or Forward was used; the browser writes it"
    )
    page = param.String(default="", doc="the address without it, prefix included; the browser writes it")
    held = param.Boolean(
        default=False, doc="whether a mouse button or finger is down; the browser writes it, like all below"
    )
    gesture = param.Integer(default=0, doc="how often that happened")
    undone = param.Integer(default=0, doc="how often Ctrl+Z was pressed")
    redone = param.Integer(default=0, doc="how often Ctrl+Shift+Z or Ctrl+Y was pressed")
    reloads = param.Integer(default=0, doc="when it grows, the page is reloaded from its address")


class ShareHead(Bundled):
    """The link, a button that copies it, and its QR code, which can fill the screen."""

    link = param.String(default="", doc="the address of what is shown")
    picture = param.String(default="", doc="its QR code as an SVG; empty if the link is too long")
    wording = param.List(default=[], doc="sentences about it")
    opened = param.Integer(default=0, doc="how often it was opened")
    closed = param.Integer(default=0, doc="how often it was closed; the browser writes it")


class Paper(Bundled):
    """A button that prints a page of its own."""

    label = param.String(default="")
    page = param.String(default="", doc="in HTML")


class Frame(Bundled):
    """Makes the page fit into a frame of another page, and tells that page how high it is."""


class Embed(Bundled):
    """The code that shows the page in a frame of another page, and how that would look."""

    code = param.String(default="", doc="in HTML")
    frames = param.String(default="*", doc="the pages that may show it, as in a content security policy")


class Film(Bundled):
    """Saves the Lab's stage, line and headline as a film, which the browser draws and writes."""

    SAYS = ("Stretch",)
    encoders = param.String(default=address_of(Encoders, ENCODERS), doc="the address of the script that writes files")
    anew = param.Integer(default=0, doc="grows when another motion or pace may be filmed")


class Photo(Bundled):
    """A button that saves the picture of the top as a PNG with the caption below."""

    caption = param.List(default=[], doc="lines of plain text")
    wide = param.Integer(default=2400, doc="of the picture, in px")
    none = param.String(default="", doc="the words if no top is in sight")


class Clock(param.Parameterized):
    """The present time of a Playing."""

    at = param.Number(default=None, allow_None=True, doc="in (R/g)^1/2; None while it plays")

    def __init__(self, playing):
        super().__init__(at=None if playing.playing else playing.time)
        self._playing = playing
        playing.param.watch(self._read, ["playing", "time"])
        self.param.watch(self._put, "at")

    def _read(self, *events):
        self.at = None if self._playing.playing else self._playing.time

    def _put(self, event):
        if event.new is not None:
            self._playing.param.update(time=event.new, playing=False)
