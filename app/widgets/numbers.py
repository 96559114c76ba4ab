"""A group of inputs as one component: number controls, choices, and sentences about them."""

import html
import json
import math

import param

from app.bundle import Bundled
from app.state import validate
from app.text import say, written
from app.widgets.forms import hear


class NumberControls(Bundled):
    """The group in the browser.

    Only Python writes `state` and only the browser `request`, so neither comes back as a request of the other. The
    browser counts its requests; `state` names the last one that it answers; until then a control stays where a hand
    put it.
    """

    # JSON, because Panel and Bokeh search each part of a dict again and again
    parts = param.String(default="[]", doc="As of heading(), number(), choice(), words() and dock(), in order.")
    state = param.String(default="{}", doc="As of Numbers.show(), and the last count that was answered.")
    request = param.List(default=[], doc="[count, name, number or text, whether it was typed].")


def heading(text, choice=None):
    """A title; at its right, a choice."""
    return {"kind": "heading", "text": text, "choice": choice}


def number(name, wording, *, lines=0, marks=()):
    """A number control. wording: its words: name, typed (that of its field) and unit; html, speaks: the name and the
    unit as they are shown and read aloud; hint: on hover; lines: of words that are reserved below; marks: (value, word)
    of named places on the slider."""
    return {"kind": "number", "name": name, "wording": wording, "lines": lines, "marks": [list(mark) for mark in marks]}


def choice(name, label, options):
    """One of several. label: for screen readers; options: {value: word}."""
    listed = [[value, word, ""] for value, word in options.items()]
    return {"kind": "choice", "name": name, "label": label, "options": listed}


def words(name):
    """A sentence."""
    return {"kind": "words", "name": name}


def dock(label, *numbers):
    """Number controls that stand at the foot of the window on a phone, one at a time. label: for screen readers."""
    return {"kind": "dock", "label": label, "parts": numbers}


def flat(parts):
    """All parts, those of a dock too."""
    return [each for part in parts for each in part.get("parts", [part])]


def tidy(value):
    """A number with six digits, as a control shows it."""
    return written(value, ".6g")


class Numbers:
    """A group of inputs, `view`. ask: called with the name of one, the requested value, and whether it was typed."""

    def __init__(self, parts, ask, **layout):
        self._ask, self._answered, self._state = ask, 0, {}
        self._wrong = {}  # {name: text that was typed and is not a number}
        self.view = NumberControls(**({"sizing_mode": "stretch_width", "margin": 0} | layout))
        self.lay_out(parts)
        hear(self.view, request=self._on_request)

    def lay_out(self, parts):
        """Replaces the inputs; show() is to follow."""
        all_parts = flat(parts)
        choices = [each for part in all_parts if "options" in (each := part.get("choice") or part)]
        self._options = {each["name"]: [value for value, *_ in each["options"]] for each in choices}
        self._numbers = {part["name"] for part in all_parts if part["kind"] == "number"}
        self._parts = json.dumps(parts)

    def _on_request(self, event):
        count, name, wish, typed = validate.parts(event.new, validate.number, validate.text, validate.anything, bool)
        if name in self._options:
            if wish not in self._options[name]:
                raise validate.InvalidMessage(wish)
        elif name not in self._numbers:
            raise validate.InvalidMessage(name)
        elif not (typed and isinstance(wish, str)):
            wish = validate.number(wish)
        self._answered = int(count)
        is_text = name in self._wrong and name not in self._state["messages"]  # which is all that was refused
        goes_back = is_text and not typed and wish == self._state["values"][name]
        self._wrong.clear()
        if isinstance(wish, str) and name in self._numbers:
            self._wrong[name] = wish
            self._tell()
        elif goes_back:
            self._tell()
        else:
            self._ask(name, wish, typed)

    def show(self, values, sliders, *, fields=None, notes=None, messages=None, refused=None, nearest=None, hidden=(),
             words=None):  # fmt: skip
        """values: {input: its last valid value}; sliders: {input: (least, most, step, decimals or None)}; fields: the
        numbers for the fields, where they differ; notes: {input: HTML}; messages: {input: why its value is refused, as
        HTML}, refused: those values, and nearest: the nearest possible ones; hidden: names of parts; words: {sentence:
        HTML}."""
        tried = {name: value if math.isfinite(value) else str(value) for name, value in (refused or {}).items()}
        self._state = {"values": values, "sliders": sliders, "fields": fields or {}, "notes": notes or {},
                       "messages": messages or {}, "refused": tried, "nearest": nearest or {},
                       "hidden": list(hidden), "words": words or {}}  # fmt: skip
        self._tell()

    def follow(self, values, sliders, fields):
        """Shows some of the values at once."""
        for name, new in (("values", values), ("sliders", sliders), ("fields", fields)):
            self._state[name] |= new
        self._tell()

    def _tell(self):
        state = self._state
        wrong = {name: say("controls.not_a_number", text=html.escape(text), shown=tidy(state["values"][name]))
                 for name, text in self._wrong.items()}  # fmt: skip
        told = state | {"messages": state["messages"] | wrong, "refused": state["refused"] | self._wrong}
        self.view.tell(parts=self._parts, state=json.dumps(told | {"answered": self._answered}, allow_nan=False))
