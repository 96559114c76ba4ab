"""What a link stores of a film, and the input of a table: a file that is chosen or dropped on the page, or pasted text.

The browser reads a table of text, and thins it out if it is long. A zip, a workbook, or a file of Tracker's own comes
whole, in pieces, and is opened here: by a program of its own, without a file on the disk."""

import base64
import binascii

import param

from app.bundle import Bundled
from app.model.measured.cells import MeasuredError
from app.model.measured.table import text_inside
from app.model.measured.unpack import HEAD, LARGEST, MOST, PACKED
from app.model.runs import Run
from app.state import validate
from app.text import say
from app.widgets.cards import note
from app.widgets.failure import unless_stopped
from app.widgets.forms import hear


class Filmed(param.Parameterized):
    """What a link stores of the tab, if wanted."""

    film = param.String(default="", doc="the data and their settings, compressed; empty: not in the link")


class MeasuredFile(Bundled):
    """The newest text of a table. It is stored only in this session."""

    most = param.Integer(default=LARGEST, constant=True, doc="bytes of a text as it is sent, in JSON; rows of a longer "
                         "one are left out")  # fmt: skip
    rows = param.Integer(default=MOST, constant=True, doc="rows of a table; if there are more, some are left out")
    head = param.Integer(default=HEAD, constant=True, doc="first lines, which are always kept")
    packed = param.Integer(default=PACKED, constant=True, doc="bytes of a file that is sent whole")
    table = param.List(
        default=["", 1, 0, "", 0],
        doc="[the text, n if it has every n-th row of the file or 0 if its lines are too long for any, how many texts "
        "so far, the file's name, its size in bytes]",
    )
    piece = param.List(
        default=["", 0, 0, 0, "", 0],
        doc="[bytes of a packed file in base64, their place, how many pieces it has, how many files so far, its name, "
        "its size in bytes]",
    )


class Brought:
    """file: the input. take: called with a table's text, n if it has every n-th row, and the file's name; refuse: with
    a MeasuredError. wording: the words that say that a file is being opened."""

    def __init__(self, runs, take, refuse, wording):
        self._runs, self._take, self._refuse, self._wording, self._pieces = runs, take, refuse, wording, []
        self.file = MeasuredFile(sizing_mode="stretch_width", margin=(6, 0))
        hear(self.file, table=self._table, piece=self._piece)

    def _table(self, event):
        kinds = validate.text, validate.number, validate.number, validate.text, validate.number
        text, each, _, name, size = validate.parts(event.new, *kinds)
        if each < 1:
            self._refuse(MeasuredError("too-large", size=size / 1000, most=LARGEST / 1000))
        else:
            self._take(text, int(each), name=name)

    def _piece(self, event):
        kinds = validate.text, validate.number, validate.number, validate.number, validate.text, validate.number
        text, at, count, _, name, size = validate.parts(event.new, *kinds)
        self._pieces = self._pieces if at else []
        if size > PACKED:
            self._refuse(MeasuredError("packed", size=size / 1e6, most=PACKED / 1e6))
            return
        try:
            self._pieces.append(base64.b64decode(text, validate=True))
        except (binascii.Error, ValueError):
            raise validate.InvalidMessage("not base64") from None
        if at != len(self._pieces) - 1 or sum(map(len, self._pieces)) > PACKED:
            self._pieces = []
            raise validate.InvalidMessage("piece")
        if len(self._pieces) >= count:
            data, self._pieces = b"".join(self._pieces), []
            self._wording.object = f'<div role="status">{note(say("measure.opens"))}</div>'
            done = unless_stopped(lambda found: self._take(*found, name=name), self._refuse, MeasuredError)
            self._runs.begin(Run(lambda run: text_inside(data), done), "open")
