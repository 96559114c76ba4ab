"""The page around Bokeh's own: in it the top moves before the scripts, the session and the controls have come.

What the session's Top3D will say is written into the page. first.js draws it at once, and hands the picture over to
the component when that is made; meanwhile the scripts load, and the server makes the session.
"""

import base64
import json
from pathlib import Path

import panel_material_ui as pmui
from panel.custom import JSComponent

from app.borrowed import address_of
from app.bundle import Bundled
from app.text import LANGUAGES
from app.widgets.cards import HEIGHT_OF_A_CARD
from app.widgets.top3d import Top3D

PAGE = Path(__file__).with_name("first.html")
BORROWED = Path(__file__).with_name("borrowed.js").read_text(encoding="utf-8")


def top_of(rooms):
    """The rolling top of the first view that has one and is made already; None where none is."""
    found = (top for room in rooms for top in room.select(Top3D))
    return next((top for top in found if not top.clock), None)


def variables(top, search):
    """What PAGE needs. top: the Top3D that the page begins with, or None; search: of the address that it is for."""
    found = {"borrowed": BORROWED, "bundles": [address_of(kind) for kind in (Bundled, pmui.Page)]}
    if top is not None:
        found["card_height"] = HEIGHT_OF_A_CARD
        found["first"] = json.dumps({"search": search, "model": said(top)}).replace("<", "\\u003c")
    return found


def said(top):
    """All that a Top3D says; bytes in base64, and its words in each language."""
    values = {name: getattr(top, name) for name in top.param if name not in JSComponent.param}
    for name, value in values.items():
        if isinstance(value, bytes):
            values[name] = {"base64": base64.b64encode(value).decode()}
    return values | {"texts": {language: Top3D.says(language) for language in LANGUAGES}}
