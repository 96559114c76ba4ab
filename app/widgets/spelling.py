"""Numbers in sentences, as the page's language writes them."""

import re

from app.text import decimal_point


def spelled(words):
    """Words with their numbers as the page's language writes them, and no line's end before a unit."""
    words = re.sub(r"(?<=\d)\.(?=\d)", decimal_point(), words)
    return re.sub(r"(?<=\d) (?=(mm|s|rev/s|U/s|%)\b)", "\N{NO-BREAK SPACE}", words)
