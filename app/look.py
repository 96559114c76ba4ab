"""How the page looks: light or dark, and large, of high contrast, for a projector."""

import param

from app.bundle import Bundled


class Look(Bundled):
    dark = param.Boolean(default=False, doc="Light on dark.")
    large = param.Boolean(default=False, doc="Large type and stronger contrast, to be read across a room.")
