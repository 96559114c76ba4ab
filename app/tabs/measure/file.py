"""What a link stores of a film, and the input of a table: a file that is chosen or dropped on the page, or pasted text.
The browser reads it, and thins it out if it is long."""

import param

from app.bundle import Bundled
from app.model.measured.table import HEAD, LARGEST, MOST


class Filmed(param.Parameterized):
    """What a link stores of the tab, if wanted."""

    film = param.String(default="", doc="the data and their settings, compressed; empty: not in the link")


class MeasuredFile(Bundled):
    """The newest text of a table. It is stored only in this session."""

    most = param.Integer(default=LARGEST, constant=True, doc="bytes of a text as it is sent, in JSON; rows of a longer "
                         "one are left out")  # fmt: skip
    rows = param.Integer(default=MOST, constant=True, doc="rows of a table; if there are more, some are left out")
    head = param.Integer(default=HEAD, constant=True, doc="first lines, which are always kept")
    table = param.List(
        default=["", 1, 0, "", 0],
        doc="[the text, n if it has every n-th row of the file or 0 if its lines are too long for any, how many texts "
        "so far, the file's name, its size in bytes]",
    )
