"""Figures that are described once: each page sees its own values, and sends what its browser may send."""

import json

import numpy as np
import pytest
from bokeh.models import ColumnDataSource, CustomJS, Line

from app.state.validate import InvalidMessage
from app.tabs.maps.picture import MapFigure
from app.text import speaking
from app.widgets.drawing import drawn
from app.widgets.hold import held
from app.widgets.plots import draw, plain


class Curve:
    """A figure with a curve, and a place that the browser sends."""

    def __init__(self, *names):
        self.figure = plain("a curve", 200, x_range=(0, 1), y_range=(0, 1))
        self.curves = {name: ColumnDataSource({"x": [], "y": []}) for name in names}
        for source in self.curves.values():
            draw(self.figure, Line, "x", "y", source=source)
        self.hand = ColumnDataSource({"x": [0.0]})
        self.figure.js_on_change("inner_width", CustomJS(args={"hand": self.hand}, code=""))


def test_pages_share_a_description_and_nothing_else():
    one, other = drawn(Curve, "a"), drawn(Curve, "a")
    one.figure.y_range.update(start=-1, end=3)
    one.curves["a"].data = {"x": [1.0], "y": [2.0]}
    assert one.drawing.described == other.drawing.described
    assert (one.figure.y_range.start, other.figure.y_range.start) == (-1, 0) and not other.drawing.looks
    assert one.curves["a"].data["y"] == [2.0] and other.curves["a"].data["y"] == []
    assert drawn(Curve, "a", "b").drawing.described != one.drawing.described
    assert drawn(Curve, "a").figure.y_range.end == 1


def test_what_is_as_described_is_not_sent():
    one = drawn(Curve, "a")
    one.figure.y_range.end = 3
    one.figure.y_range.end = 1
    assert [*one.drawing.looks.values()] == [{}]


def test_a_description_has_the_numbers_of_its_language():
    with speaking("de"):
        german = drawn(MapFigure).drawing.described
    assert "CustomJSTickFormatter" in german and "CustomJSTickFormatter" not in drawn(MapFigure).drawing.described


def test_its_models_are_all_in_the_description():
    found = drawn(Curve, "a")
    inside = json.dumps(json.loads(found.drawing.described)["doc"])
    assert all(f'"{each.id}"' in inside for each in (found.figure, found.hand, found.curves["a"]))


def test_changes_that_are_held_are_sent_once_and_seen_at_once():
    one, sent = drawn(Curve, "a", "b"), []
    names = [name for name in one.drawing.param if name == "looks" or name.startswith("data")]
    one.drawing.param.watch(lambda *events: sent.extend(events), names)
    with held():
        for end in (2, 3):
            one.figure.y_range.end = end
            one.curves["a"].data = {"x": np.arange(end), "y": np.arange(end)}
        assert one.figure.y_range.end == 3 and len(one.curves["a"].data["x"]) == 3 and not sent
    assert len(sent) == 2 and one.figure.y_range.end == 3


def test_only_what_a_page_listens_to_is_heard():
    one, heard = drawn(Curve, "a"), []
    one.hand.on_change("data", lambda name, old, new: heard.append((name, new)))
    assert one.drawing.heard == [one.hand.id]
    one.drawing.sent = [1, one.hand.id, {"x": [0.5]}]
    assert heard == [("data", {"x": [0.5]})]
    for wrong in ([2, one.curves["a"].id, {"x": [0.5]}], [3, "p0", {}], [4, one.hand.id, [0.5]], [5, 7, {}]):
        with pytest.raises(InvalidMessage):
            one.drawing._take(type("Event", (), {"new": wrong})())
    assert len(heard) == 1
