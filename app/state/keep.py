"""The state of the page as the query of a URL, and the steps back and forth through it.

Each view names what of it is to be kept: a Parameterized, and a Field for each parameter. A query holds what is not the
default, every number to the last digit: ?v=1&KJ=6.7&mu=.3. What a stranger wrote there is read, never believed.
"""

import base64
import binascii
import re
import zlib
from dataclasses import dataclass, fields
from functools import partial
from typing import Any
from urllib.parse import parse_qsl, quote

import param

from app.model.explorer import Explorer
from app.model.region import PAPER
from app.state import asked
from app.text import say, told
from tippe_core import TopError, load_top, save_top
from tippe_core.bodies.files import LONGEST
from tippe_core.bodies.shapes import KINDS

# The defaults are part of a version: with others, or with another meaning of a name, this becomes 2.
VERSION = 1
LONGEST_QUERY = 12_000  # a body of the most points that can be built is shorter
MOST_NAMES = 60
LONGEST_NUMBER = 32
STEPS = 100
SECRET = "room"  # the teacher's key of a vote: in his own address, and in no link that is given away

NUMBER = re.compile(r"-?(\d+\.?\d*|\.\d+)(e-?\d+)?", re.ASCII)


class Number:
    """A float, as short as it can be and to the last digit."""

    @staticmethod
    def text(value):
        """Of a finite number."""
        text = repr(float(value)).removesuffix(".0").replace("e+", "e").replace("e-0", "e-")
        return re.sub(r"^(-?)0\.", r"\1.", text)

    @staticmethod
    def value(text):
        """Of what text() wrote; else a ValueError."""
        if len(text) > LONGEST_NUMBER or not NUMBER.fullmatch(text) or abs(float(text)) == float("inf"):
            raise ValueError(say("share.link.number"))
        return float(text)


class Numbers:
    """So many floats in a list, or none."""

    def __init__(self, count):
        self._count = count

    @staticmethod
    def text(value):
        """Of finite numbers."""
        return "_".join(map(Number.text, map(asked.number, value)))

    def value(self, text):
        """Of what text() wrote; else a ValueError."""
        parts = text.split("_") if text else []
        if len(parts) not in (0, self._count):
            raise ValueError(say("share.link.numbers", count=self._count))
        return [Number.value(part) for part in parts]


class OneOf:
    """One of a few values, each by its word."""

    def __init__(self, **words):
        self._words = words

    def text(self, value):
        """The word of a value; Unasked where it has none."""
        for word, known in self._words.items():
            if known == value:
                return word
        raise asked.Unasked(f"not one of {', '.join(self._words)}")

    def value(self, text):
        """The value of a word; else a ValueError."""
        if text not in self._words:
            raise ValueError(say("share.link.one_of", words=", ".join(self._words)))
        return self._words[text]


class Body:
    """A shape: its kind and its dimensions in SI; where those are lists, its file, packed."""

    PACKED = "z"

    @classmethod
    def text(cls, shape):
        """Of any Shape."""
        dimensions = [getattr(shape, field.name) for field in fields(shape)]
        if all(isinstance(value, float) for value in dimensions):
            return "_".join([type(shape).__name__, *map(Number.text, dimensions)])
        return cls.PACKED + base64.urlsafe_b64encode(zlib.compress(save_top(shape).encode(), 9)).decode().rstrip("=")

    @classmethod
    def value(cls, text):
        """Of what text() wrote; else a ValueError, which may be the TopError of an impossible body."""
        if text.startswith(cls.PACKED):
            shape = cls._unpacked(text[len(cls.PACKED) :])
        else:
            name, *dimensions = text.split("_")
            kind = KINDS.get(name)
            if kind is None or len(dimensions) != len(fields(kind)):
                raise ValueError(say("share.link.body"))
            names = (field.name for field in fields(kind))
            shape = kind(**{name: Number.value(size) for name, size in zip(names, dimensions, strict=True)})
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


@dataclass(frozen=True)
class Field:
    """A parameter that is kept: its name in the URL, how it is written, and whether changing it is a step to undo."""

    key: str
    codec: Any
    undoable: bool = True


EXPLORER = {
    "shape": Field("body", Body),
    "a": Field("a", Number),
    "I1": Field("I1", Number),
    "I3": Field("I3", Number),
    "mu_s": Field("mu", Number),
    "given": Field("by", OneOf(share="share", E="E", state="state")),
    "K_J": Field("KJ", Number),
    "K_R": Field("KR", Number),
    "energy": Field("e", Number),
    "E": Field("E", Number),
    "theta": Field("th", Number),
    "theta_dot": Field("thd", Number),
    "omega2": Field("w2", Number),
    "omega3": Field("w3", Number),
    "phi": Field("phi", Number),
    "psi": Field("psi", Number),
    "upper": Field("half", OneOf(yes=True, no=False, paper=PAPER)),
    "limit": Field("limit", OneOf(lift="lift-off", slip="slip")),
}
FOLLOWING = {name for names in Explorer.GIVEN.values() for name in names}


def read(query):
    """(texts, sentence): the names and texts of a query, {} and a sentence where it cannot be one. Never raises."""
    query = query.removeprefix("?")
    if len(query) > LONGEST_QUERY:
        return {}, say("share.link.too_long", letters=len(query))
    try:
        texts = dict(parse_qsl(query, keep_blank_values=True, max_num_fields=MOST_NAMES))
    except ValueError:
        return {}, say("share.link.too_many")
    version = texts.pop("v", str(VERSION))
    return texts, "" if version == str(VERSION) else say("share.link.newer")


def shared(query):
    """What of a query others may see."""
    return "&".join(part for part in query.split("&") if not part.startswith(f"{SECRET}="))


def values(texts, known, skip=()):
    """(values, sentence): the parameters that texts give, those not possible left out and named. Never raises."""
    found, wrong = {}, []
    for name, field in known.items():
        if field.key not in texts:
            continue
        try:
            found[name] = field.codec.value(texts[field.key])
        except ValueError as error:
            impossible = isinstance(error, TopError)
            wrong.append(told(error) if impossible else say("share.link.to_be", name=field.key, what=error))
    return found, say("share.link.unreadable", wrong=" ".join(wrong)) if wrong else ""


def explorer_of(texts):
    """(Explorer, sentence): the motion that texts ask for, else the default one. Never raises."""
    inputs, sentence = values(texts, EXPLORER)
    if "shape" in inputs:
        top = inputs["shape"].top
        inputs = {"a": top.a, "I1": top.I1, "I3": top.I3} | inputs
    try:
        return Explorer(**inputs), sentence
    # what the solver says of numbers whose squares or reciprocals are no numbers
    except (ValueError, ArithmeticError) as error:
        why = told(error) if isinstance(error, TopError) else say("share.link.extreme")
        return Explorer(), say("share.link.impossible", why=why)


def kept(explorer, texts=None, sentence=""):
    """The Keep of a page about this Explorer, of which the link has been obeyed already."""
    keep = Keep(texts, sentence, allowed=lambda: not explorer.scene.messages)
    keep.add(explorer, EXPLORER, usual, opened=True)
    return keep


def usual(explorer):
    """{parameter: value} of an Explorer where a query is silent about it: the motion by which it is given, its body."""
    names = [name for name in EXPLORER if name not in FOLLOWING or name in Explorer.GIVEN[explorer.given]]
    first = {name: Explorer.param[name].default for name in names}
    if explorer.shape == first["shape"]:
        return first
    top = explorer.shape.top
    return first | {"a": top.a, "I1": top.I1, "I3": top.I3}


@dataclass(frozen=True)
class Part:
    """What one view keeps: a Parameterized, {parameter: Field}, and what says which of them count, with defaults."""

    owner: param.Parameterized
    known: dict
    usual: Any

    def state(self, undoable=False):
        """{parameter: value} as of now, of those that count."""
        names = (name for name in self.usual(self.owner) if self.known[name].undoable or not undoable)
        return {name: getattr(self.owner, name) for name in names}


class Keep(param.Parameterized):
    """The state of a page: its query, and undo and redo.

    at_rest() is to be called when a gesture ends; it makes the query, and where something undoable changed, a step.
    allowed: whether what is set now can be shown at all; else it is passed over. shortest: of the
    texts of a query, those that have to be said.
    """

    query = param.String(default="", doc="the state, from the question mark on; empty where all is the default")
    can_undo = param.Boolean(default=False, doc="whether there is a step back")
    can_redo = param.Boolean(default=False, doc="whether there is a step forward")
    sentence = param.String(default="", doc="what was wrong with the link, until something is changed")
    changed = param.Event(doc="something that is kept was set; a hand may still be at it")

    def __init__(self, texts=None, sentence="", allowed=lambda: True):
        super().__init__(sentence=sentence)
        self.shortest = lambda texts: texts
        self._texts = dict(texts or {})  # of views that are not made yet
        self._parts, self._allowed = [], allowed
        self._steps, self._at, self._gesture = [{}], 0, None

    def add(self, owner, known, usual=None, opened=False):
        """Keeps these parameters of a view too, at what the link said of them.

        usual: the owner's parameters that count now, with their defaults; without it all of them. opened: the link has
        been obeyed already.
        """
        first = {name: owner.param[name].default for name in known}
        part = Part(owner, known, usual or (lambda owner: first))
        found, wrong = values(self._texts, known)
        for field in known.values():
            self._texts.pop(field.key, None)
        if not opened:
            owner.param.update(**found)
            self.sentence = " ".join(filter(None, (self.sentence, wrong)))
        self._parts.append(part)
        owner.param.watch(partial(self._set, known), list(known))
        # it is not a step that a view was made
        self._steps = [step | {id(owner): part.state(undoable=True)} for step in self._steps]
        self._write()

    def _set(self, known, *events):
        """What a page never sends goes back to what was."""
        for event in events:
            if known[event.name].codec is Body or (event.new is None and event.obj.param[event.name].allow_None):
                continue  # no page sends a body; and None, where it may be, has no word in a link
            try:
                known[event.name].codec.text(event.new)
            except (ValueError, TypeError, OverflowError) as error:
                asked.pass_over(event, error)
                event.obj.param.update(**{event.name: event.old})
        self.param.trigger("changed")

    def at_rest(self, gesture=None):
        """A gesture has ended; what comes late of the same gesture, which is not None, makes no step of its own."""
        if not self._allowed():
            return
        step = {id(part.owner): part.state(undoable=True) for part in self._parts}
        if step != self._steps[self._at]:
            late = gesture is not None and gesture == self._gesture
            self._steps = [*self._steps[: self._at + (not late)], step][-STEPS - 1 :]
            self._at = len(self._steps) - 1
            self._gesture = gesture
            self.sentence = ""
        self._write()

    def undo(self):
        """One step back; only to the last one that could be shown where what is set now cannot."""
        self._go(self._at - self._allowed())

    def redo(self):
        """One step forward."""
        self._go(self._at + 1)

    def _go(self, to):
        if not 0 <= to < len(self._steps):
            return
        self._at, self._gesture = to, None
        for part in self._parts:
            part.owner.param.update(**self._steps[to][id(part.owner)])
        self._write()

    def _write(self):
        texts = {}
        for part in self._parts:
            first = part.usual(part.owner)
            texts |= {
                part.known[name].key: part.known[name].codec.text(value)
                for name, value in part.state().items()
                if not same(value, first[name])
            }
        texts = self.shortest(texts | self._texts)
        texts = {"v": str(VERSION)} | texts if texts else {}
        self.param.update(
            query="?" + "&".join(f"{quote(key)}={quote(text)}" for key, text in texts.items()) if texts else "",
            can_undo=self._at > 0,
            can_redo=self._at < len(self._steps) - 1,
        )


def same(value, other):
    """Equal to the last digit, and in the sign of zero."""
    return value == other and (not isinstance(value, float) or Number.text(value) == Number.text(other))
