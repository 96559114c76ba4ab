"""The state of the page as the query of a URL, and the steps back and forth through it.

Which name keeps what is in names.py. A query holds what is not the default, every number to the last digit:
?v=2&KJ=6.7&mu=.3. What a stranger wrote there is read, never believed.
"""

from dataclasses import dataclass
from functools import partial
from typing import Any
from urllib.parse import parse_qsl

import param

from app.model.explorer import Explorer
from app.model.start import arrives
from app.state import asked, older
from app.state.codecs import Body, Number
from app.state.names import SECRET, VERSION_NAME, of, query
from app.text import say, told
from tippe_core import TopError

# The defaults are part of a version: with others, or with another meaning of a name, this becomes 3.
VERSION = 2
LONGEST_QUERY = 12_000  # a body of the most points that can be built is shorter
MOST_NAMES = 60
STEPS = 100

EXPLORER = of("Explorer")
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
    version = texts.pop(VERSION_NAME, "1")
    if version == "1":
        return older.today(texts), ""
    return texts, "" if version == str(VERSION) else say("share.link.newer")


def shared(query):
    """What of a query others may see."""
    return "&".join(part for part in query.split("&") if not part.startswith(f"{SECRET}="))


def values(texts, known, skip=()):
    """(values, sentence): the parameters that texts give, those not possible left out and named. Never raises."""
    found, wrong = {}, []
    for parameter, name in known.items():
        if name.key not in texts:
            continue
        try:
            found[parameter] = name.codec.value(texts[name.key])
        except ValueError as error:
            impossible = isinstance(error, TopError)
            wrong.append(told(error) if impossible else say("share.link.to_be", name=name.key, what=error))
    return found, say("share.link.unreadable", wrong=" ".join(wrong)) if wrong else ""


def inputs_of(texts):
    """(inputs, sentence): what texts ask of an Explorer, a body with its own numbers. Never raises."""
    inputs, sentence = values(texts, EXPLORER)
    if "shape" in inputs:
        top = inputs["shape"].top
        inputs = {"a": top.a, "I1": top.I1, "I3": top.I3} | inputs
    return inputs, sentence


def explorer_of(texts, explores=False):
    """(Explorer, sentence): the start that texts ask for, else the default one of this level. Never raises."""
    inputs, sentence = inputs_of(texts)
    first = arrives() if explores else {}
    try:
        return Explorer(**first | inputs), sentence
    # what the solver says of numbers whose squares or reciprocals are no numbers
    except (ValueError, ArithmeticError) as error:
        why = told(error) if isinstance(error, TopError) else say("share.link.extreme")
        return Explorer(**first), say("share.link.impossible", why=why)


def kept(explorer, texts=None, sentence="", explores=lambda: False, **more):
    """The Keep of a page about this Explorer, of which the link has been obeyed already. explores(): whether the page
    explores. What a hand lets go may be kept where it cannot be said how that rolls."""
    keep = Keep(texts, sentence, allowed=lambda: explorer.given == "hand" or not explorer.scene.messages, **more)
    keep.add(explorer, lambda explorer: usual(explorer, explores()), opened=True)
    return keep


def usual(explorer, explores=False):
    """{parameter: value} of an Explorer where a query is silent about it: the start by which it is given, its body."""
    names = [name for name in EXPLORER if name not in FOLLOWING or name in Explorer.GIVEN[explorer.given]]
    first = {name: Explorer.param[name].default for name in names}
    if explores:
        first |= {name: value for name, value in arrives().items() if name in first}
    if explorer.shape == first["shape"]:
        return first
    top = explorer.shape.top
    return first | {"a": top.a, "I1": top.I1, "I3": top.I3}


@dataclass(frozen=True)
class Part:
    """What one view keeps: a Parameterized, {parameter: Name}, and what says which of them count, with defaults."""

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
    allowed: whether what is set now can be shown at all; else it is passed over. shortest: of the texts of a query,
    those that have to be said.
    """

    query = param.String(default="", doc="the state, from the question mark on; empty where all is the default")
    can_undo = param.Boolean(default=False, doc="whether there is a step back")
    can_redo = param.Boolean(default=False, doc="whether there is a step forward")
    sentence = param.String(default="", doc="what was wrong with the link, until something is changed")
    changed = param.Event(doc="something that is kept was set; a hand may still be at it")

    def __init__(self, texts=None, sentence="", allowed=lambda: True, shortest=lambda texts: texts):
        super().__init__(sentence=sentence)
        self._shortest = shortest
        self._texts = dict(texts or {})  # of views that are not made yet
        self._parts, self._allowed = [], allowed
        self._steps, self._at, self._gesture = [{}], 0, None

    @property
    def waits(self):
        """{key: text} of the link that no view has asked for yet."""
        return dict(self._texts)

    def add(self, owner, usual=None, opened=False):
        """Keeps of a view too what NAMES has of its class, at what the link said of it.

        usual: the owner's parameters that count now, with their defaults; without it all of them. opened: the link has
        been obeyed already.
        """
        kind = type(owner).__name__
        known = of(kind)
        if not known:
            raise LookupError(f"no name of an address is of a {kind}: see NAMES")
        if any(type(part.owner).__name__ == kind for part in self._parts):
            raise LookupError(f"the names of a {kind} are taken: {', '.join(name.key for name in known.values())}")
        first = {name: owner.param[name].default for name in known}
        part = Part(owner, known, usual or (lambda owner: first))
        found, wrong = values(self._texts, known)
        for name in known.values():
            self._texts.pop(name.key, None)
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
        texts = self._shortest(texts | self._texts)
        self.param.update(
            query=query({VERSION_NAME: str(VERSION)} | texts) if texts else "",
            can_undo=self._at > 0,
            can_redo=self._at < len(self._steps) - 1,
        )


def same(value, other):
    """Equal to the last digit, and in the sign of zero."""
    return value == other and (not isinstance(value, float) or Number.text(value) == Number.text(other))
