"""The page by keyboard and by ear, and the tour of a first visit."""

import param

from app.bundle import Bundled


class Guide(Bundled):
    """Two buttons, "Tour" and "?"; the keys of the page; and what the top does now as a text that is read out."""

    said = param.String(default="", doc="What the motion on display is, in plain words; for a hand at rest.")
    seconds = param.Number(default=1.0, doc="Seconds of the real top in one unit of time.")
