"""Where a table comes in: chosen, dropped or pasted. It is read in the browser, and thinned there if it is long."""

import param

from app.bundle import Bundled


class MeasuredFile(Bundled):
    """The newest text of a table. Nothing of it is kept anywhere but in this session."""

    most = param.Integer(default=180_000, constant=True, doc="characters of a text; of a longer one rows are left out")
    table = param.List(default=["", 1], doc="[the text, each how-manieth row of the file it has]; the browser's")
    refused = param.Integer(default=0, doc="megabytes of a file that was too large to be read; the browser's")
