"""A text to be copied."""

import param

from app.bundle import Bundled


class Copy(Bundled):
    """A text with a button that copies it, also on a page without https, where browsers may forbid that."""

    text = param.String(default="")
    label = param.String(default="")
    rows = param.Integer(default=1)
    button = param.List(default=[], doc="the words of its button, before and after copying")
