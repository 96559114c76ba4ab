"""All the words of the lesson, a folder a language: say("learn.free.title") is `title` under [free] in learn.toml.

Words are HTML; a number stands in them as {name:.2f}.
"""

import string
import tomllib
from functools import cache
from pathlib import Path

LANGUAGE = "en"


class _Numbers(string.Formatter):
    def format_field(self, value, form):
        said = super().format_field(value, form)
        return said if isinstance(value, str) else said.replace("-", "−")


@cache
def _file(language, name):
    return tomllib.loads((Path(__file__).parent / language / f"{name}.toml").read_text(encoding="utf-8"))


def listed(key, language=LANGUAGE):
    """What stands under a key, as it is: words, a list of them, or a table."""
    name, *path = key.split(".")
    found = _file(language, name)
    for part in path:
        found = found[part]
    return found


def say(key, language=LANGUAGE, **numbers):
    """The words under a key, with these numbers in them. KeyError where there are none, or one lacks its number."""
    return _Numbers().format(listed(key, language), **numbers)
