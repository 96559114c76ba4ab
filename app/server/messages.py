"""What a browser may send to the page, checked as it arrives, before Bokeh, Panel or a widget uses it.

This file lists what each part of the page may be sent, with type, length and size; everything else is Refused. The
libraries do not check: numpy accepts a type of any width from a message, and Bokeh creates any model that it describes.
"""

import json
import re
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

from app.model.build.builder import LARGEST_FILE
from app.state.codecs import Pushes

MOST_EVENTS, MOST_PARTS, DEEPEST = 100, 10_000, 16
KINDS = {"PATCH-DOC", "PULL-DOC-REQ"}  # a browser never pushes a document

LARGEST = 1e15  # number; up to it integers are exact
LONGEST = 16 * 1024  # letters; the longest address of a page is 12,000
MOST = 1_000  # entries of a list


class Refused(ValueError):
    """A message that a browser running this page never sends. The sentence goes to the sender."""


# --- values, as they are in a message's JSON


@dataclass(frozen=True)
class Value:
    """The allowed values of something: in words, and as a function of a value and the model that it is for."""

    words: str
    fits: Any

    def __or__(self, other):
        return Value(f"{self.words} or {other.words}", lambda value, of: self.fits(value, of) or other.fits(value, of))


def _is_number(value, low=-LARGEST, high=LARGEST):
    return type(value) in (int, float) and low <= value <= high  # which nan and infinity are not


def number(low=-LARGEST, high=LARGEST):
    """A number in this range."""
    return Value(f"a number from {low:g} to {high:g}", lambda value, of: _is_number(value, low, high))


def text(longest=LONGEST):
    """A text of at most this many characters."""
    return Value(f"text of at most {longest} letters", lambda value, of: type(value) is str and len(value) <= longest)


def one_of(*values):
    """One of these texts."""
    return Value(f"one of {', '.join(values)}", lambda value, of: type(value) is str and value in values)


def row(*values, or_none=False):
    """A list of exactly these; or_none: or an empty one."""

    def fits(value, of):
        if type(value) is not list or len(value) != len(values):
            return or_none and value == []
        return all(each.fits(entry, of) for each, entry in zip(values, value, strict=True))

    return Value(f"a list of {', '.join(each.words for each in values)}", fits)


def many(each, most=MOST):
    """A list of at most this many."""
    return Value(f"a list of at most {most}, each {each.words}",
                 lambda value, of: type(value) is list and len(value) <= most
                 and all(each.fits(entry, of) for entry in value))  # fmt: skip


def _plain(value, of=None, levels=4):
    if type(value) is list:
        return levels > 0 and len(value) <= MOST and all(_plain(entry, of, levels - 1) for entry in value)
    if type(value) is dict:
        entries = entries_of(value)
        return levels > 0 and entries is not None and all(_plain(entry, of, levels - 1) for entry in entries.values())
    return value is None or type(value) is bool or _is_number(value) or TEXT.fits(value, of)


def entries_of(value):
    """{name: value} of the representation of a dict in a message; None if it is not one."""
    entries = value.get("entries", []) if isinstance(value, dict) and value.get("type") == "map" else None
    if not isinstance(entries, list) or len(entries) > MOST or not set(value) <= {"type", "entries"}:
        return None
    if not all(type(entry) is list and len(entry) == 2 and SHORT.fits(entry[0], None) for entry in entries):
        return None
    return dict(entries)


def _is_of_form(value, of):
    """[count, number of a part of the Form, what of it, its new value], of which the part may be sent the last."""
    if not row(COUNT, COUNT, SHORT, ANYTHING).fits(value, of):
        return False
    _, at, name, new = value
    kind = {part.get("at"): part["kind"] for part in _parts_of(json.loads(of.parts)["tree"])}.get(at)
    allowed = CHANGES.get(kind, {}).get(name)
    return allowed is not None and allowed.fits(new, SimpleNamespace(**json.loads(of.state)["of"][at]))


def _parts_of(tree):
    return [part for each in tree for part in (each, *_parts_of(each.get("inside", ())))]


def _is_column(value, of):
    entries = entries_of(value)
    return (entries is not None and len(entries) <= 10
            and all(many(NUMBER | SHORT | NONE, 10).fits(column, of) for column in entries.values()))  # fmt: skip


FLAG = Value("true or false", lambda value, of: type(value) is bool)
ANYTHING = Value("anything", lambda value, of: True)
NONE = Value("null", lambda value, of: value is None)
COUNT = Value("a whole number from 0", lambda value, of: type(value) is int and 0 <= value <= LARGEST)
NUMBER, TEXT, SHORT = number(), text(), text(300)
PLAIN = Value("plain and bounded", _plain)
OF_FORM = Value("a count, one of its parts, and what that may be sent", _is_of_form)
COLUMNS = Value("a few numbers or words in each of a few columns", _is_column)
# What depends on the model as it is now.
CHOSEN = Value("one of its values", lambda value, of: any(type(value) is type(each) and value == each
                                                          for each in of.options.values()))  # fmt: skip
CHECKED = Value("some of its values", lambda value, of: type(value) is list and all(CHOSEN.fits(each, of)
                                                                                   for each in value))  # fmt: skip
ON_SLIDER = Value("a number on the slider", lambda value, of: _is_number(value, of.start, of.end))


# --- what each part may be sent


ANGLE, SIZE = number(0, 4), number(-1e6, 1e6)  # rad; no input is larger
LENGTH = number(-1e4, 1e4)  # mm
SHOWN = ("show_track", "show_trace", "show_com_path", "show_force", "show_cone", "show_omega", "show_momentum",
         "follow")  # fmt: skip
PICTURE = dict.fromkeys(SHOWN, FLAG) | {
    "time": SIZE, "playing": FLAG, "speed": number(0, 100),
    "camera": row(NUMBER, NUMBER, NUMBER, or_none=True),
}  # fmt: skip
ON_PLANE = row(one_of("tieline", "line", "end", "point"), ANGLE, SIZE)

# Of a class of models, its attributes that the browser changes.
CHANGES = {
    # BokehJS's and Panel's
    "Column": {"scroll_position": NUMBER},
    "BrowserInfo": {"dark_mode": FLAG, "device_pixel_ratio": NUMBER, "language": SHORT, "timezone": SHORT,
                    "timezone_offset": NUMBER, "webdriver": FLAG, "webgl": FLAG},
    "Location": {name: TEXT for name in ("href", "hostname", "pathname", "protocol", "port", "search", "hash")},
    # ours
    "Address": {"page": TEXT, "held": FLAG, "gesture": COUNT, "undone": COUNT, "redone": COUNT,
                "visited": row(COUNT, SHORT)},
    "Button": {"clicks": COUNT},
    "Checks": {"value": CHECKED},
    "Choice": {"value": CHOSEN},
    "Download": {"clicks": COUNT},
    "Drawing": {"sent": row(COUNT, SHORT, COLUMNS)},
    "Form": {"sent": OF_FORM},
    "MeasuredFile": {"table": row(text(200_000), COUNT, COUNT, SHORT, COUNT),
                     "piece": row(text(200_000), COUNT, COUNT, COUNT, SHORT, COUNT)},
    "Field": {"value": text(60)},
    "Menu": {"value": CHOSEN},
    "LessonView": {"request": row(COUNT, one_of("vote"), NUMBER | SHORT) | row(COUNT, SHORT, SHORT)},
    "Head": {"request": row(COUNT, SHORT, FLAG | SHORT)},
    "LabView": PICTURE | {"request": row(COUNT, SHORT, NUMBER | SHORT | FLAG)
                          | row(COUNT, one_of("pushes"), text(Pushes.LONGEST))},
    "Look": {"dark": FLAG, "large": FLAG},
    "NumberControls": {"request": row(COUNT, SHORT, NUMBER | SHORT, FLAG)},
    "Painted": {"painted": COUNT},
    "PlaneView": {"hand": ON_PLANE, "pressed": row(COUNT, SHORT)},
    "Phone": {"mark": text(32)},
    "SectionView": {"hand": row(SHORT, LENGTH, LENGTH), "tapped": row(COUNT, SHORT, LENGTH, LENGTH)},
    "ShareHead": {"closed": COUNT},
    "Stretch": {"pulled": row(COUNT, ON_SLIDER, ON_SLIDER)},
    "Surface3D": {"hand": ON_PLANE},
    "TextFile": {"sent": row(text(LARGEST_FILE), COUNT, COUNT)},
    "Top3D": PICTURE,
    "TopsMap": {"state": PLAIN, "picked": row(COUNT, SHORT), "moved": row(COUNT, number(-1, 1), number(0.1, 10))},
}  # fmt: skip
EVENTS = ("document_ready",)  # the page's; nothing here hears of a part's


# --- the check


def look_at(message, document):
    """Raises Refused for anything that this page never sends. message: as received by Bokeh."""
    kind, content = message.msgtype, message.content
    if kind not in KINDS:
        raise Refused(f"A {str(kind)[:40]!r} message is not for this server.")
    if kind != "PATCH-DOC":
        return
    _count(content)
    events = content.get("events") if isinstance(content, dict) and set(content) <= {"events"} else None
    if not isinstance(events, list) or not 0 < len(events) <= MOST_EVENTS:
        raise Refused(f"A message has a list of 1 to {MOST_EVENTS} events, and nothing else.")
    if any(len(buffer.data) > LARGEST_FILE for buffer in message.payload.buffers):
        raise Refused(f"A file has at most {LARGEST_FILE} bytes.")
    for event in events:
        kind = event.get("kind") if isinstance(event, dict) else None
        if kind == "ModelChanged":
            _look_at_change(event, document.models)
        elif kind == "MessageSent":
            _look_at_event(event)
        else:
            raise Refused(f"An event of kind {str(kind)[:40]!r} is not for this server.")


def _count(content):
    parts, level = 0, [content]
    for _ in range(DEEPEST):
        level = [part for whole in level for part in (whole.values() if isinstance(whole, dict) else whole)
                 if isinstance(part, (dict, list, str, int, float))]  # fmt: skip
        parts += len(level)
        if parts > MOST_PARTS:
            raise Refused(f"A message has at most {MOST_PARTS} parts.")
        level = [part for part in level if isinstance(part, (dict, list))]
        if not level:
            return
    raise Refused(f"A message is at most {DEEPEST} deep.")


def _model(reference, models):
    """The model that is referred to; None if it no longer exists, in which case Bokeh ignores the message."""
    name = reference.get("id") if isinstance(reference, dict) and len(reference) == 1 else None
    model = models.get_by_id(name) if isinstance(name, str) else None
    if model is None and not (isinstance(name, str) and models.seen(name)):
        raise Refused("That is no part of this page.")
    return model


def _called(model):
    """The name of a model's class; a component of Panel has a numbered class of its own for its data."""
    return re.sub(r"\d+$", "", type(model).__name__)


def _look_at_change(event, models):
    if set(event) != {"kind", "model", "attr", "new"} or not isinstance(event["attr"], str):
        raise Refused("A change names a model, an attribute and its new value.")
    model, attribute = _model(event["model"], models), event["attr"]
    allowed = PLAIN if model is None else CHANGES.get(_called(model), {}).get(attribute)
    if allowed is None:
        raise Refused(f"The page itself changes no {attribute[:40]!r} of a {_called(model)}.")
    if not allowed.fits(event["new"], model):
        raise Refused(f"A {_called(model)}'s {attribute[:40]!r} is {allowed.words}, not {shown(event['new'])}.")


def _look_at_event(event):
    data = event.get("msg_data")
    if (
        event != {"kind": "MessageSent", "msg_type": "bokeh_event", "msg_data": data}
        or not isinstance(data, dict)
        or set(data) != {"type", "name", "values"}
        or data["type"] != "event"
    ):
        raise Refused("A message to the page is an event.")
    name, values = data["name"], entries_of(data["values"])
    if name not in EVENTS or values is None:
        raise Refused(f"An event {shown(name)} is not for this page.")
    if values:
        raise Refused(f"In {name!r}, {next(iter(values))[:40]!r} is not for this page.")


def shown(value):
    """A value as it is printed in a sentence."""
    return f"{value!r:.60}" if isinstance(value, (str, float, bool, type(None))) else f"a {type(value).__name__}"
