"""Numbers in sentences, in the notation of the page's language."""

import re

from app.text import decimal_point


def spelled(words):
    """The words with their numbers in the notation of the page's language, and no line break before a unit."""
    words = re.sub(r"(?<=\d)\.(?=\d)", decimal_point(), words)
    return re.sub(r"(?<=\d) (?=(mm|s|rev/s|U/s|%)\b)", "\N{NO-BREAK SPACE}", words)
