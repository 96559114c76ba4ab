"""Text that changes with each move of a hand."""

import param

from app.bundle import Bundled
from app.widgets.cards import TYPE


class LiveText(Bundled):
    """HTML in the page's own type. Changing the text of a Panel pane costs the server several times as much."""

    text = param.String(default="", doc="HTML.")


def live_text(style=TYPE, **options):
    """style: its CSS."""
    return LiveText(stylesheets=[style], **({"sizing_mode": "stretch_width", "margin": 0} | options))
