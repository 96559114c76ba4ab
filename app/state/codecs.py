"""How values are written in the address and read from it: text() of a value, value() of a text.

A text may come from anyone, so it is checked: value() raises a ValueError with a sentence.
"""

import base64
import binascii
import re
import zlib
from itertools import pairwise

from app.model.measured import film
from app.model.setup import MOST_SECONDS, Push
from app.model.votes.classroom import KEY
from app.state import validate
from app.text import say
from tippe_core import load_top, save_top
from tippe_core.bodies import KINDS, LONGEST, given, names_of

LONGEST_NUMBER = 32

NUMBER = re.compile(r"-?(\d+\.?\d*|\.\d+)(e-?\d+)?", re.ASCII)


class Number:
    """A float, in as few characters as keep every digit."""

    @staticmethod
    def text(value):
        """The text of a finite number."""
        text = repr(float(value)).removesuffix(".0").replace("e+", "e").replace("e-0", "e-")
        return re.sub(r"^(-?)0\.", r"\1.", text)

    @staticmethod
    def value(text):
        """The number in a text; else raises ValueError."""
        if len(text) > LONGEST_NUMBER or not NUMBER.fullmatch(text) or abs(float(text)) == float("inf"):
            raise ValueError(say("share.link.number"))
        return float(text)


class Same:
    """A float, or None, which is written as a word: the same as another one."""

    WORD = "same"

    @staticmethod
    def text(value):
        """The text of a finite number, or of None."""
        return Same.WORD if value is None else Number.text(value)

    @staticmethod
    def value(text):
        """The number in a text, or None; else raises ValueError."""
        return None if text == Same.WORD else Number.value(text)


class Numbers:
    """A list of a fixed number of floats, or None."""

    def __init__(self, count):
        self._count = count

    @staticmethod
    def text(value):
        """The text of finite numbers."""
        return "_".join(map(Number.text, map(validate.number, value)))

    def value(self, text):
        """The numbers in a text; else raises ValueError."""
        parts = text.split("_") if text else []
        if len(parts) not in (0, self._count):
            raise ValueError(say("share.link.numbers", count=self._count))
        return [Number.value(part) for part in parts]


class OneOf:
    """One of a few values, each written as a word."""

    def __init__(self, **words):
        self._words = words

    def text(self, value):
        """The word of a value; raises Unasked if it has none."""
        for word, known in self._words.items():
            if known == value:
                return word
        raise validate.InvalidMessage(f"not one of {', '.join(self._words)}")

    def value(self, text):
        """The value of a word; else raises ValueError."""
        if text not in self._words:
            raise ValueError(say("share.link.one_of", words=", ".join(self._words)))
        return self._words[text]


class Body:
    """A shape: its kind and its dimensions in SI units, or, if these include lists, its file, compressed."""

    PACKED = "z"

    @classmethod
    def text(cls, shape):
        """The text of any Shape."""
        names = names_of(type(shape))[0]
        while names[-1] not in given(shape):  # those at the end that go without saying
            names.pop()
        dimensions = [getattr(shape, name) for name in names]
        if all(isinstance(value, float) for value in dimensions):
            return "_".join([type(shape).__name__, *map(Number.text, dimensions)])
        return cls.PACKED + base64.urlsafe_b64encode(zlib.compress(save_top(shape).encode(), 9)).decode().rstrip("=")

    @classmethod
    def value(cls, text):
        """The Shape in a text; else raises ValueError, which may be the TopError of an impossible body."""
        if text.startswith(cls.PACKED):
            shape = cls._unpacked(text[len(cls.PACKED) :])
        else:
            name, *dimensions = text.split("_")
            kind = KINDS.get(name)
            names, silent = names_of(kind) if kind else ([], [])
            if kind is None or not len(names) - len(silent) <= len(dimensions) <= len(names):
                raise ValueError(say("share.link.body"))
            shape = kind(**{name: Number.value(size) for name, size in zip(names, dimensions, strict=False)})
        shape.top  # noqa: B018  (a body may be sound and still stand on no peg)
        return shape

    @staticmethod
    def _unpacked(text):
        unpack = zlib.decompressobj()
        try:
            document = unpack.decompress(base64.urlsafe_b64decode(text + "=" * (-len(text) % 4)), LONGEST)
        except (binascii.Error, zlib.error, ValueError):
            raise ValueError(say("share.link.file")) from None
        return load_top(document)


class Pushes:
    """Pushes, in the order of their times: of each seven numbers, its time, point and impulse."""

    MOST, FARTHEST, STRONGEST = 12, 1e4, 1e6  # mm, mN s
    LONGEST = MOST * 7 * (LONGEST_NUMBER + 1)

    @staticmethod
    def text(value):
        """The text of a tuple of Push."""
        return "~".join(Numbers.text([push.t, *push.point, *push.impulse]) for push in value)

    @classmethod
    def value(cls, text):
        """The tuple of Push in a text; else raises ValueError."""
        rows = [Numbers(7).value(part) for part in text.split("~")] if text else []
        times = [0.0, *(row[0] for row in rows if row), MOST_SECONDS]
        if not all(rows) or len(rows) > cls.MOST or any(a >= b for a, b in pairwise(times)) or any(
            max(map(abs, row[1:4])) > cls.FARTHEST or max(map(abs, row[4:])) > cls.STRONGEST for row in rows
        ):  # fmt: skip
            raise ValueError(say("share.link.pushes", most=cls.MOST, seconds=MOST_SECONDS))
        return tuple(Push(t, (x, y, z), (a, b, c)) for t, x, y, z, a, b, c in rows)


class Key:
    """The secret key of a teacher, in the teacher's own link."""

    text = staticmethod(str)

    @staticmethod
    def value(text):
        if not KEY.fullmatch(text):
            raise ValueError(say("teach.vote.key"))
        return text


class Film:
    """A film's data and fit, compressed; or ""."""

    text = staticmethod(str)

    @staticmethod
    def value(text):
        """The compressed text itself if it holds a film; else raises ValueError."""
        try:
            if text:
                film.unpacked(text)
        except ValueError:
            raise ValueError(say("share.link.film")) from None
        return text
