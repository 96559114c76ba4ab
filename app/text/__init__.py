"""All the words of the page, one folder for each language: say("learn.free.title") is `title` under [free] in
learn.toml.

Words are HTML, and {name:.2f} stands for a number, which the page writes in the notation of its language; saved files
have a decimal point in every language. English is complete by definition, and the tests compare every other language
with it.
"""

import re
import string
import tomllib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from functools import cache
from pathlib import Path
from typing import Any, TypeAlias

from tippe_core import TopError
from tippe_core.errors import shown

LANGUAGES = {"en": "English", "de": "Deutsch", "es": "Español"}
DEFAULT = "en"
CODES = {
    "no-such-body": "a body thinner or wider than any",
    "too-many-turns": "a motion too long to be shown, as fast as it turns",
    "stem-below-table": "a tilt at which a stem or rim is below the table",
    "body-below-table": "a tilt at which another part is",
    "too-few-values": "fewer measured values than the numbers that are fitted need",
}
"""{code: what is wrong} for errors of the page itself; the others are in tippe_core.errors.CODES."""
Found: TypeAlias = Any  # what a key leads to: words, a list of them, or a table


_COMMA = str.maketrans("-.,", "−,\N{NARROW NO-BREAK SPACE}")
MARKS = {"en": str.maketrans("-", "−"), "de": _COMMA, "es": _COMMA}
"""{language: its minus sign, decimal point and thousands separator}."""


def decimal_point() -> str:
    """The decimal point of the page's language."""
    return ".".translate(MARKS[spoken()])


class _Numbers(string.Formatter):
    def __init__(self, language: str) -> None:
        self._marks = MARKS[language]

    def format_field(self, value: object, form: str) -> str:
        wording = super().format_field(value, form)
        if not isinstance(value, str) and not wording.strip("-0."):
            wording = wording.removeprefix("-")  # no minus zero
        return wording if isinstance(value, str) else wording.translate(self._marks)


@cache
def _file(language: str, name: str) -> dict[str, Found]:
    return tomllib.loads((Path(__file__).parent / language / f"{name}.toml").read_text(encoding="utf-8"))


_ask: list[Callable[[], str]] = [lambda: DEFAULT]
_inside: ContextVar[str | None] = ContextVar("language", default=None)


def ask(language: Callable[[], str]) -> None:
    """From now on language() returns the language in which a page speaks."""
    _ask[0] = language


def spoken() -> str:
    """The language of the page that is being served now, a key of LANGUAGES."""
    return _inside.get() or _ask[0]()


@contextmanager
def speaking(language: str) -> Iterator[None]:
    """Inside, spoken() is this language: for a thread of its own, which serves no page."""
    before = _inside.set(language)
    try:
        yield
    finally:
        _inside.reset(before)


_WISH = re.compile(r"\s*([a-z]{1,8}|\*)(?:-[a-z\d-]+)?\s*(?:;\s*q=(0(?:\.\d{0,3})?|1(?:\.0{0,3})?)\s*)?", re.I | re.A)


def preferred(header: str) -> str:
    """The one of LANGUAGES that a browser prefers, from its Accept-Language (RFC 9110); de-AT counts as de."""
    likes: dict[str, tuple[float, int]] = {}  # "de" or "*" -> (weight, the earlier the larger)
    for place, wish in enumerate(header.split(",")[:20]):
        if found := _WISH.fullmatch(wish):
            tag, weight = found[1].lower(), float(found[2] or 1)
            likes[tag] = max(likes.get(tag, (0.0, 0)), (weight, -place))
    others = likes.get("*", (0.0, 0))
    best = max(LANGUAGES, key=lambda language: likes.get(language, others))
    return best if likes.get(best, others)[0] > 0 else DEFAULT


def listed(key: str, language: str | None = None) -> Found:
    """What is stored under a key: words, a list of them, or a table."""
    name, *path = key.split(".")
    found = _file(language or spoken(), name)
    for part in path:
        found = found[part]
    return found


def say(key: str, language: str | None = None, **numbers: object) -> str:
    """The words under a key, with these numbers. KeyError if there are none, or if a number is missing."""
    words: str = listed(key, language)
    return _Numbers(language or spoken()).format(words, **numbers) if "{" in words else words


def written(value: object, form: str = "", language: str | None = None) -> str:
    """A number that is not part of a sentence, in this format and in the notation of the page's language."""
    return _Numbers(language or spoken()).format_field(value, form)


def error_text(error: TopError, language: str | None = None, unit: str = "") -> str:
    """The sentence of a TopError in the page's language, as plain text, not HTML; unit: that in which its value is
    shown.

    In English it is the core's own. Another language has words for each code in errors.toml: the allowed range and the
    remedy if the core gives these in words, or a whole sentence.
    """
    language = language or spoken()
    value = shown(error.value)
    if language == DEFAULT:
        wording = str(error)
    else:
        words = listed(f"errors.codes.{error.code}", language)
        allowed = words["allowed"].format(**error.numbers) if "allowed" in words else error.allowed
        parts = error.numbers | {"name": called(error.name, language), "value": value, "allowed": allowed}
        wording = words.get("sentence", listed("errors.sentence", language)).format(**parts)
        if "remedy" in words:
            wording += " " + words["remedy"].format(**error.numbers)
        wording = re.sub(r"(?<=\d)[.](?=\d)", ".".translate(MARKS[language]), wording)
    return wording.replace(f" = {value} ", f" = {value} {unit} ", 1) if unit else wording


def called(name: str, language: str | None = None) -> str:
    """The name on the page of the quantity of a TopError: as in the core unless [names] of errors.toml has a word for
    it; points[2] is a row of points[]."""
    language = language or spoken()
    if language == DEFAULT:
        return name
    rows = re.findall(r"\[\d+\]", name)
    words = listed("errors.names", language).get(re.sub(r"\[\d+\]", "[]", name))
    return words.replace("[]", rows[0], 1) if words and rows else words or name
