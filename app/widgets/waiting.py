"""What the page says until it is there, and whether it asks anew: a part of its HTML, in one language."""

import json
from functools import cache
from html import escape
from pathlib import Path
from string import Template

from app.bundle import inlined
from app.text import say

HERE = Path(__file__)
PART, SCRIPT = Template(HERE.with_suffix(".html").read_text(encoding="utf-8")), inlined(HERE.with_suffix(".js"))
REASONS = ("full", "crowded", "stopping", "ended", "failed", "lost")
"""Why a page may be refused at its socket: the reason that is sent begins with the name, and a colon."""


@cache
def waiting(language):
    """The HTML."""
    words = {
        name: say(f"main.server.{name}", language) for name in ("coming", "made", "again", "now", "boxed", *REASONS)
    }
    return PART.substitute(words=escape(json.dumps(words, ensure_ascii=False)), script=SCRIPT)
