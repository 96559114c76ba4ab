"""The look of the page: light or dark, and large with high contrast, for a projector."""

import param

from app.bundle import Bundled

# A font of the visitor's own system.
FAMILY = 'Inter, "Segoe UI", -apple-system, "Liberation Sans", Arial, system-ui, sans-serif'


class Look(Bundled):
    dark = param.Boolean(default=None, allow_None=True, doc="Light on dark; None: as set in the visitor's system.")
    large = param.Boolean(default=False, doc="Large type and stronger contrast, legible across a room.")
