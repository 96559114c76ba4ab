"""Numbers in sentences, as the page's language writes them."""

import re

from app.text import listed


def spelled(words):
    """Words with their numbers as the page's language writes them, and no line's end before a unit."""
    words = re.sub(r"(?<=\d)\.(?=\d)", listed("lab_view.view.decimal"), words)
    return re.sub(r"(?<=\d) (?=(mm|s|rev/s|U/s|%)\b)", "\N{NO-BREAK SPACE}", words)
