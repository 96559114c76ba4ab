"""All the words of the page, a folder a language: say("learn.free.title") is `title` under [free] in learn.toml.

Words are HTML; a number stands in them as {name:.2f}, with a decimal point in every language, as on the axes and in the
files that are saved. English is complete by definition, and the tests compare every other language with it.
"""

import re
import string
import tomllib
from functools import cache
from pathlib import Path

LANGUAGES = {"en": "English", "de": "Deutsch"}
DEFAULT = "en"


class _Numbers(string.Formatter):
    def format_field(self, value, form):
        said = super().format_field(value, form)
        return said if isinstance(value, str) else said.replace("-", "−")


@cache
def _file(language, name):
    return tomllib.loads((Path(__file__).parent / language / f"{name}.toml").read_text(encoding="utf-8"))


_ask = [lambda: DEFAULT]


def ask(language):
    """From now on language() tells in which one a page speaks when it says something."""
    _ask[0] = language


def spoken():
    """The language of the page that is being served now, a key of LANGUAGES."""
    return _ask[0]()


def preferred(header):
    """The first of a browser's languages, as in its Accept-Language, that is one of LANGUAGES."""
    wishes = []
    for place, wish in enumerate(header.split(",")[:20]):
        tag, _, weight = wish.strip().partition(";q=")
        try:
            wishes.append((-float(weight or 1), place, tag.split("-")[0].lower()))
        except ValueError:
            continue
    return next((tag for weight, _, tag in sorted(wishes) if weight < 0 and tag in LANGUAGES), DEFAULT)


def listed(key, language=None):
    """What stands under a key, as it is: words, a list of them, or a table."""
    name, *path = key.split(".")
    found = _file(language or spoken(), name)
    for part in path:
        found = found[part]
    return found


def say(key, language=None, **numbers):
    """The words under a key, with these numbers in them. KeyError where there are none, or one lacks its number."""
    return _Numbers().format(listed(key, language), **numbers)


def told(error, language=None):
    """The sentence of a TopError of the core, in the page's language; as plain text, not HTML."""
    language = language or spoken()
    if language == DEFAULT:
        return str(error)
    shown = f"{error.value:.10g}" if isinstance(error.value, float) else str(error.value)
    said = say("core.sentence", language, name=error.name, shown=shown, allowed=translated(error.allowed, language))
    return said + (f" {translated(error.remedy, language)}" if error.remedy else "")


def translated(words, language=None):
    """Words of the core, which speaks English, in the page's language; as they are where they have no translation."""
    language = language or spoken()
    if language == DEFAULT:
        return words
    for pattern, other in _patterns(language):
        found = pattern.fullmatch(words)
        if found:
            return other.format(*found.groups())
    return words


@cache
def _patterns(language):
    """[core.words] says what words with numbers {} in them become."""
    return [(re.compile("(.*?)".join(map(re.escape, words.split("{}"))), re.DOTALL), other)
            for words, other in listed("core.words", language).items()]  # fmt: skip
