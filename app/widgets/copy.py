"""A text to copy."""

import param

from app.bundle import Bundled


class Copy(Bundled):
    """A text to take along, and a button that copies it, also where a page without https may not."""

    text = param.String(default="")
    label = param.String(default="")
    rows = param.Integer(default=1)
    button = param.List(default=[], doc="what its button says, and what it says once that is done")
