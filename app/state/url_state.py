"""The state of the page as the query of its address, and undo and redo.

names.py says which name stores what. A query contains only what differs from the default, every number to the last
digit: ?v=4&KJ=6.7&mu=.3. It may come from anyone, so it is checked.
"""

from dataclasses import dataclass
from functools import partial
from typing import Any
from urllib.parse import parse_qsl

import param

from app.model.explorer import Explorer
from app.model.start import DEFAULTS, GIVEN, USUAL, arrives
from app.state import older, validate
from app.state.codecs import Number
from app.state.names import FRAME, NAMES, SECRET, VERSION, VERSION_NAME, of, query
from app.text import error_text, say
from tippe_core import TopError

LONGEST_QUERY = 12_000  # characters; the body with the most points that can be built needs fewer
MOST_NAMES = 60
STEPS = 100

EXPLORER = of("Explorer")


def read(query):
    """(texts, sentence): the names and texts of a query; those of an address with nothing else, and a sentence, if it
    is not valid. Never raises."""
    query = query.removeprefix("?")
    if len(query) > LONGEST_QUERY:
        return {}, say("share.link.too_long", letters=len(query))
    try:
        texts = dict(parse_qsl(query, keep_blank_values=True, max_num_fields=MOST_NAMES))
    except ValueError:
        return {}, say("share.link.too_many")
    version = texts.pop(VERSION_NAME, str(VERSION) if _is_look(texts) else "1")
    if version == "1":
        texts = older.second(texts)
    if version in ("1", "2"):
        texts = older.third(texts)
    if version in ("1", "2", "3"):
        return older.fourth(texts), ""
    return texts, "" if version == str(VERSION) else say("share.link.newer")


def _is_look(texts):
    """Whether all that is said is how the page looks, or its language."""
    texts = {key: text for key, text in texts.items() if key != FRAME}
    looks = {name.key: name for name in (*of("Look").values(), *of("PageLanguage").values())}
    return all(key in looks for key in texts) and not values(texts, {key: looks[key] for key in texts})[1]


def shared(query):
    """The part of a query that may be shared with others."""
    return "&".join(part for part in query.split("&") if not part.startswith(f"{SECRET}="))


def values(texts, known):
    """(values, sentence): the parameters in texts; invalid ones are left out and named in the sentence. Never
    raises."""
    found, wrong = {}, []
    for parameter, name in known.items():
        if name.key not in texts:
            continue
        try:
            found[parameter] = name.codec.value(texts[name.key])
        except ValueError as error:
            impossible = isinstance(error, TopError)
            wrong.append(error_text(error) if impossible else say("share.link.to_be", name=name.key, what=str(error)))
    return found, say("share.link.unreadable", wrong=" ".join(wrong)) if wrong else ""


def inputs_of(texts):
    """(inputs, sentence): the inputs of an Explorer in texts, with the body's own a, I1 and I3. Never raises."""
    inputs, sentence = values(texts, EXPLORER)
    if "shape" in inputs:
        top = inputs["shape"].top
        inputs = {"a": top.a, "I1": top.I1, "I3": top.I3} | inputs
    return inputs, sentence


def explorer_of(texts):
    """(Explorer, sentence): the start in texts, or that of the arrival if it is impossible. Never raises."""
    inputs, sentence = inputs_of(texts)
    first = arrives()
    try:
        return Explorer(**first | inputs), sentence
    # the solver's error for numbers whose squares or reciprocals overflow
    except (ValueError, ArithmeticError) as error:
        why = error_text(error) if isinstance(error, TopError) else say("share.link.extreme")
        return Explorer(**first), say("share.link.impossible", why=why)


def kept(explorer, texts=None, sentence="", **more):
    """The UrlState of a page with this Explorer, which the link has already set. A start by hand is stored even if its
    rolling motion cannot be computed."""
    url_state = UrlState(
        texts, sentence, allowed=lambda: explorer.given == "hand" or not explorer.scene.messages, **more
    )
    url_state.add(explorer, usual, opened=True, put=explorer.set, watch=["start"])
    return url_state


def usual(explorer):
    """{parameter: value} of an Explorer if a query does not mention it; only the inputs by which the start is given,
    and the body."""
    names = [name for name in EXPLORER if name not in USUAL or name in GIVEN[explorer.given]]
    first = {name: DEFAULTS[name] for name in names}
    first |= {name: value for name, value in arrives().items() if name in first}
    if explorer.shape == first["shape"]:
        return first
    top = explorer.shape.top
    return first | {"a": top.a, "I1": top.I1, "I3": top.I3}


@dataclass(frozen=True)
class Part:
    """The state of one view: a Parameterized, {parameter: Name}, a function that returns the relevant parameters with
    their defaults, and one that sets parameters."""

    owner: param.Parameterized
    known: dict
    usual: Any
    put: Any

    def state(self, undoable=False):
        """{parameter: present value} of the relevant parameters."""
        names = (name for name in self.usual(self.owner) if self.known[name].undoable or not undoable)
        return {name: getattr(self.owner, name) for name in names}


class UrlState(param.Parameterized):
    """The state of a page: its query, and undo and redo.

    commit() is to be called when a gesture ends; it updates the query and, if something undoable has changed, adds a
    step. allowed: whether the present inputs can be shown; if not, they are not stored. shortest: reduces the texts of
    a query to those that are needed.
    """

    query = param.String(default="", doc="the state, from the question mark on; empty if all of it is the default")
    where = param.String(default="", doc="the part of the state that says what is open, as a query")
    can_undo = param.Boolean(default=False, doc="whether there is a step back")
    can_redo = param.Boolean(default=False, doc="whether there is a step forward")
    sentence = param.String(default="", doc="the errors in the link, until something is changed")
    changed = param.Event(doc="a stored parameter was set; the gesture may still go on")

    def __init__(self, texts=None, sentence="", allowed=lambda: True, shortest=lambda texts: texts):
        super().__init__(sentence=sentence)
        self._shortest = shortest
        self._texts = dict(texts or {})  # for views that do not exist yet
        self._parts, self._allowed = [], allowed
        self._steps, self._at, self._gesture = [{}], 0, None

    @property
    def waits(self):
        """{key: text} of the link that no view has asked for yet."""
        return dict(self._texts)

    def add(self, owner, usual=None, opened=False, put=None, watch=None):
        """Also stores the parameters that NAMES lists for the class of this view, and sets them as the link says.

        usual: returns the owner's relevant parameters with their defaults; all of them if it is not given. opened: the
        link has already been applied. put: sets them, and watch: what to watch for them, if an owner keeps them in a
        record of its own.
        """
        kind = type(owner).__name__
        known = of(kind)
        if not known:
            raise LookupError(f"no name of an address is of a {kind}: see NAMES")
        if any(type(part.owner).__name__ == kind for part in self._parts):
            raise LookupError(f"the names of a {kind} are taken: {', '.join(name.key for name in known.values())}")
        first = {} if usual else {name: owner.param[name].default for name in known}
        part = Part(owner, known, usual or (lambda owner: first), put or owner.param.update)
        found, wrong = values(self._texts, known)
        for name in known.values():
            self._texts.pop(name.key, None)
        if not opened:
            part.put(**found)
            self.sentence = " ".join(filter(None, (self.sentence, wrong)))
        self._parts.append(part)
        owner.param.watch(partial(self._set, known), watch or list(known))
        # creating a view is not a step
        self._steps = [step | {id(owner): part.state(undoable=True)} for step in self._steps]
        self._write()

    def _set(self, known, *events):
        """Sets parameters back that were given a value which a page never sends."""
        for event in events:
            if event.name not in known or (event.new is None and event.obj.param[event.name].allow_None):
                continue  # no page sends a record; and None, where it is allowed, is not written in a link
            try:
                known[event.name].codec.text(event.new)
            except (ValueError, TypeError, OverflowError) as error:
                validate.log_invalid(event, error)
                event.obj.param.update(**{event.name: event.old})
        self.param.trigger("changed")

    def commit(self, gesture=None):
        """Ends a gesture. A late change by the same gesture (if it is not None) does not make another step."""
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
        """One step back; if the present inputs cannot be shown, only to the last step."""
        self._go(self._at - self._allowed())

    def redo(self):
        """One step forward."""
        self._go(self._at + 1)

    def visit(self, where):
        """Opens what was open before, given as `where`; what cannot be read opens the default."""
        waiting = {key: text for key, text in read(where)[0].items() if key in NAMES and NAMES[key].where}
        for part in self._parts:
            known = {parameter: name for parameter, name in part.known.items() if name.where}
            found = values(waiting, known)[0]
            usual = part.usual(part.owner)
            first = {name: usual[name] for name in known if usual.get(name) is not None}
            part.put(**first | found)
            for name in known.values():
                waiting.pop(name.key, None)
        self._texts |= waiting
        self._write()

    def _go(self, to):
        if not 0 <= to < len(self._steps):
            return
        self._at, self._gesture = to, None
        for part in self._parts:
            part.put(**self._steps[to][id(part.owner)])
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
        texts |= self._texts
        version = {VERSION_NAME: str(VERSION)}
        where = {key: texts[key] for key in sorted(texts) if key in NAMES and NAMES[key].where}
        texts = self._shortest(texts)
        self.param.update(
            where=query(version | where),
            query=query(version | texts) if texts else "",
            can_undo=self._at > 0,
            can_redo=self._at < len(self._steps) - 1,
        )


def same(value, other):
    """Whether two values are equal to the last digit, including the sign of zero."""
    return value == other and (not isinstance(value, float) or Number.text(value) == Number.text(other))
