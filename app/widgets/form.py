"""Columns of words, and what a hand sets or presses beside them, as one part of the page. Each by itself would be two
or three models of Bokeh, and a room has eighty of them: all to be created, counted and sent."""

import json
from functools import partial

import panel as pn
import param

from app.bundle import Bundled, values_of
from app.state import validate
from app.widgets.download import Download
from app.widgets.forms import Button, Checks, Choice, Field, Menu, Stretch, TextFile, hear
from app.widgets.hold import later
from app.widgets.light import Light, Stack, Words

PARTS = (Button, Checks, Choice, Download, Field, Menu, Stretch, TextFile)
FILE = "file"  # of a Download: sent once, not with the state of all


class Form(Bundled):
    """views: Stacks; Words and PARTS, which hear of hands and change as they would alone; and others, which are parts
    of the page by themselves, in their places among these."""

    parts = param.String(default="{}", constant=True, doc="JSON. tree: kind (of a part, or words, column or other), at "
                         "(its number), style, sends (names), sheet (of its own), inside; sheets: CSS")  # fmt: skip
    others = pn.viewable.Children(default=[], constant=True)
    state = param.String(default="{}", doc="JSON. heard: how many messages; of: what each part shows, by its number")
    sent = param.List(default=[0, 0, "", None], doc="[how many so far, number of a part, what of it, its new value]")
    file = param.List(default=[], doc="[number of a Download, its newest file]")

    def __init__(self, *views, **params):
        self.views, self._parts, self._sheets, self._heard, others = views, [], {}, 0, []
        tree = [self._tree(view, others) for view in views]
        self._of = [shown(part) for part in self._parts]
        super().__init__(parts=json.dumps({"tree": tree, "sheets": [*self._sheets]}), state=self._state(),
                         others=others, **({"sizing_mode": "stretch_width", "margin": 0} | params))  # fmt: skip
        for at, part in enumerate(self._parts):
            files = [FILE] if isinstance(part, Download) else []
            part.param.watch(partial(self._changed, at), [*self._of[at], *files])
        hear(self, sent=self._take)

    def select(self, selector=None):
        inside = (part for part in self._parts if isinstance(part, Bundled))
        return super().select(selector) + [found for part in inside for found in part.select(selector)]

    def _tree(self, view, others):
        if not isinstance(view, (Light, *PARTS)):
            others.append(view)
            return {"kind": "other"}
        found = {"at": len(self._parts), "style": style_of(view)}
        self._parts.append(view)
        if view.stylesheets:
            found["sheet"] = self._sheets.setdefault("".join(view.stylesheets), len(self._sheets))
        if isinstance(view, Stack):
            return found | {"kind": "column", "inside": [self._tree(each, others) for each in view.objects]}
        if isinstance(view, Words):
            return found | {"kind": "words"}
        return found | {"kind": type(view).__name__, "sends": [*view.SENDS]}

    def _state(self):
        return json.dumps({"heard": self._heard, "of": self._of})

    def _changed(self, at, *events):
        for event in events:
            if event.name == FILE:
                self.file = [at, *event.new]
            else:
                self._of[at][event.name] = event.new
        later(self, self._send)

    def _send(self):
        self.state = self._state()

    def _take(self, event):
        count, at, name, new = validate.parts(
            event.new, validate.number, validate.number, validate.text, validate.anything
        )
        part = self._parts[int(at)] if 0 <= at < len(self._parts) else None
        if name not in getattr(part, "SENDS", ()):
            raise validate.InvalidMessage("no such part")
        self._heard = int(count)
        try:
            setattr(part, name, new)
        finally:
            later(self, self._send)


def shown(part):
    """{name: value} of what a part shows."""
    if isinstance(part, Light):
        return {name: getattr(part, name) for name in part.SHOWS}
    own = {name: value for name, value in values_of(part).items() if name != FILE}
    return own | {name: getattr(part, name) for name in Light.SHOWS}


def style_of(view):
    """CSS that gives it the place that it would have alone."""
    margin = view.margin if isinstance(view.margin, tuple) else (view.margin or 0,)
    style = {"margin": " ".join(f"{side}px" for side in margin)} | (view.styles or {})
    if view.align in ("center", "end"):
        style["align-self"] = "flex-end" if view.align == "end" else "center"
    elif not (view.sizing_mode or "").startswith("stretch"):
        style["align-self"] = "flex-start"
    style |= {name: f"{size}px" for name in ("width", "height") if (size := getattr(view, name))}
    return ";".join(f"{name}:{value}" for name, value in style.items())
