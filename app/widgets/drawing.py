"""Bokeh's figures as one light part of the page.

A figure has forty models of Bokeh's. They are created once for all pages of a server, and each page gets their
description, from which the browser makes them; after that only what differs is sent.
"""

from functools import lru_cache

import param
from bokeh.core.json_encoder import serialize_json
from bokeh.document import Document
from bokeh.model import Model
from bokeh.models import ColumnDataSource, Plot

from app.bundle import Bundled
from app.state import validate
from app.text import spoken
from app.widgets.forms import hear
from app.widgets.hold import later

SHARES = 8  # into so many the data of a drawing are divided: one whose data change is sent with all of it
MOST = 64  # descriptions that are kept


class Drawing(Bundled):
    """Figures, one below the other, with the HTML of `heads` before each. data0, data1, ... are {id of a source: its
    data}, of those whose data differ from the description."""

    described = param.String(constant=True, doc="JSON: the document, and the height of each figure in px; 0: it fills "
                             "its place")  # fmt: skip
    heads = param.List(default=[])
    looks = param.Dict(default={}, doc="{id of a model: {property: value}}: what differs from the description")
    heard = param.List(default=[], doc="The ids of the sources whose changes the browser sends.")
    sent = param.List(default=[0, "", {}], doc="[how many so far, id of a source, its data]")
    data0, data1, data2, data3, data4, data5, data6, data7 = (param.Dict(default={}) for _ in range(SHARES))

    def __init__(self, description, ids, **params):
        self._places, self._hears = {id: f"data{number % SHARES}" for number, id in enumerate(ids)}, {}
        self._late = {}  # {parameter: its new value}, not sent yet
        super().__init__(described=description, **({"margin": 0} | params))
        hear(self, sent=self._take)

    def get(self, model, name):
        """The present value of a property of a model."""
        if name == "data" and model.id in self._places:
            return self._now(self._places[model.id]).get(model.id, model.data)
        return self._now("looks").get(model.id, {}).get(name, getattr(model, name))

    def _now(self, name):
        return self._late.get(name, getattr(self, name))

    def set(self, model, values):
        """Sets properties of a model."""
        others = dict(values)
        if model.id in self._places and "data" in others:
            place = self._places[model.id]
            self._late[place] = self._now(place) | {model.id: others.pop("data")}
        looks, before = self._now("looks"), self._now("looks").get(model.id, {})
        differ = {name: value for name, value in (before | others).items() if value != getattr(model, name)}
        if differ != before:
            self._late["looks"] = {**looks, model.id: differ}
        if self._late:
            later(self, self._send)

    def _send(self):
        late, self._late = self._late, {}
        self.tell(**late)

    def hear(self, model, act):
        """Calls act("data", old, new) when the browser changes the data of a source."""
        self._hears[model.id] = model, act
        self.heard = [*self._hears]

    def _take(self, event):
        _, id, data = validate.parts(event.new, validate.number, validate.text, validate.anything)
        if id not in self._hears or not isinstance(data, dict):
            raise validate.InvalidMessage(id)
        model, act = self._hears[id]
        act("data", self.get(model, "data"), data)


class Remote:
    """A model of the description, with the values that one page sees. Those that are models are Remotes, too."""

    __slots__ = ("drawing", "model")

    def __init__(self, drawing, model):
        object.__setattr__(self, "drawing", drawing)
        object.__setattr__(self, "model", model)

    def __getattr__(self, name):
        return remote(self.drawing, self.drawing.get(self.model, name))

    def __setattr__(self, name, value):
        self.drawing.set(self.model, {name: value})

    def update(self, **values):
        self.drawing.set(self.model, values)

    def on_change(self, name, act):
        self.drawing.hear(self.model, act)


def remote(drawing, value):
    """The value, but with Remotes in place of models."""
    if isinstance(value, Model):
        return Remote(drawing, value)
    if isinstance(value, dict):
        return {name: remote(drawing, each) for name, each in value.items()}
    return type(value)(remote(drawing, each) for each in value) if type(value) in (list, tuple) else value


def drawn(kind, *arguments, **layout):
    """kind(*arguments), whose attributes are figures and other models of Bokeh's, for one page. It is created once for
    all pages of a language, and here has Remotes in place of models. Its `drawing` is the part of the page."""
    made, description, ids, fills = _description(kind, arguments, spoken())
    drawing = Drawing(description, ids, **({"sizing_mode": "stretch_both" if fills else "stretch_width"} | layout))
    found = object.__new__(kind)
    found.__dict__.update({name: remote(drawing, value) for name, value in vars(made).items()}, drawing=drawing)
    return found


@lru_cache(MOST)
def _description(kind, arguments, language):
    """(what is created once, its JSON, the ids of its sources, whether a figure of it fills its place)."""
    made = kind(*arguments)
    document, figures = Document(), [*dict.fromkeys(_figures(vars(made).values()))]
    for fig in figures:
        document.add_root(fig)
    ids = [source.id for source in document.select({"type": ColumnDataSource})]
    heights = [0 if fig.sizing_mode == "stretch_both" else fig.height for fig in figures]
    given = {"doc": document.to_json(deferred=False), "heights": heights}
    return made, serialize_json(given), ids, not all(heights)


def _figures(values):
    for value in values:
        if isinstance(value, Plot):
            yield value
        elif isinstance(value, (list, tuple, dict)):
            yield from _figures(value.values() if isinstance(value, dict) else value)
