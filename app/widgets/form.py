"""Words, and what a hand sets or presses beside them, as one part of the page. Each by itself would be two or three
models of Bokeh, and a room has fifty of them: all to be created, counted and sent."""

import json
from functools import partial

import panel as pn
import param

from app.bundle import Bundled, values_of
from app.state import validate
from app.widgets.download import Download
from app.widgets.forms import Button, Checks, Choice, Field, Menu, Stretch, TextFile, hear

PARTS = (Button, Checks, Choice, Download, Field, Menu, Stretch, TextFile)
FILE = "file"  # of a Download: sent once, not with the state of all


class Form(Bundled):
    """views: words(), columns and rows of them, and PARTS, which hear of hands and change as they would alone. Their
    columns keep what they have."""

    parts = param.String(default="{}", constant=True, doc="JSON. tree: kind (of a part, or words or column), at (its "
                         "number), style, sends (names), sheet (of words), inside; sheets: CSS")  # fmt: skip
    state = param.String(default="{}", doc="JSON. heard: how many messages; of: what each part shows, by its number")
    sent = param.List(default=[0, 0, "", None], doc="[how many so far, number of a part, what of it, its new value]")
    file = param.List(default=[], doc="[number of a Download, its newest file]")

    def __init__(self, *views, **params):
        self.views, self._parts, self._sheets, self._heard = views, [], {}, 0
        tree = [self._tree(view) for view in views]
        self._of = [shown(part) for part in self._parts]
        super().__init__(parts=json.dumps({"tree": tree, "sheets": [*self._sheets]}), state=self._state(),
                         **({"sizing_mode": "stretch_width", "margin": 0} | params))  # fmt: skip
        for at, part in enumerate(self._parts):
            files = [FILE] if isinstance(part, Download) else []
            part.param.watch(partial(self._changed, at), [*self._of[at], *files])
        hear(self, sent=self._take)

    def select(self, selector=None):
        return super().select(selector) + [found for view in self.views for found in view.select(selector)]

    def _tree(self, view):
        found = {"at": len(self._parts), "style": style_of(view)}
        self._parts.append(view)
        if isinstance(view, pn.Column):
            return found | {"kind": "column", "inside": [self._tree(each) for each in view]}
        if isinstance(view, pn.pane.HTML):
            sheet = "".join(view.stylesheets)
            return found | {"kind": "words", "sheet": self._sheets.setdefault(sheet, len(self._sheets))}
        return found | {"kind": type(view).__name__, "sends": [*view.SENDS]}

    def _state(self):
        return json.dumps({"heard": self._heard, "of": self._of})

    def _changed(self, at, *events):
        for event in events:
            if event.name == FILE:
                self.file = [at, *event.new]
            else:
                self._of[at][event.name] = event.new
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
            self.state = self._state()


def shown(part):
    """{name: value} of what a part shows."""
    if isinstance(part, pn.pane.HTML):
        return {"visible": part.visible, "object": part.object}
    own = {} if isinstance(part, pn.Column) else values_of(part)
    return {name: value for name, value in own.items() if name != FILE} | {"visible": part.visible}


def style_of(view):
    """CSS that gives it the place that it would have alone."""
    margin = view.margin if isinstance(view.margin, tuple) else (view.margin or 0,)
    style = {"margin": " ".join(f"{side}px" for side in margin)} | (view.styles or {})
    if view.align in ("center", "end"):
        style["align-self"] = "flex-end" if view.align == "end" else "center"
    elif not (view.sizing_mode or "").startswith("stretch"):
        style["align-self"] = "flex-start"
    if view.width:
        style["width"] = f"{view.width}px"
    return ";".join(f"{name}:{value}" for name, value in style.items())


def fits(view):
    """Whether a Form may have it: it has no look of its own, and no column that is empty, to be filled later."""
    if view.css_classes or (view.stylesheets and not isinstance(view, pn.pane.HTML)):
        return False
    if type(view) is pn.Column:
        return len(view) > 0 and all(map(fits, view))
    return type(view) is pn.pane.HTML or isinstance(view, PARTS)


def joined(views):
    """The same views, but those that follow each other and fit as one Form."""
    found, now = [], []
    for view in (*views, None):
        if view is not None and fits(view):
            now.append(view)
            continue
        is_small = len(now) == 1 and type(now[0]) is not pn.Column
        found += now if is_small or not now else [Form(*now)]
        found, now = found + [view] * (view is not None), []
    return found
