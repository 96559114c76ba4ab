"""The tab Maps without a browser: requests, clicks, the address, and the sentences."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from app.model.maps import kept
from app.model.maps.maps import OWN, Map
from app.model.runs import Full, Runs, Stopped
from app.model.scene import solve as solve_scene
from app.server.messages import CHANGES
from app.state.map_text import MapText
from app.state.url_state import UrlState, read
from app.tabs.maps.maps import Maps
from app.tabs.maps.steady import Steady
from tippe_core import PRESETS, Top, TopError, slide_many

ROOT = Path(__file__).parent.parent


@pytest.fixture(autouse=True)
def nothing_kept(monkeypatch):
    """Maps of few cells, none of which is stored."""
    monkeypatch.setitem(Map.__init__.__kwdefaults__, "cells", 3)
    monkeypatch.setattr(kept, "_path", lambda asked: None)
    kept._memory.clear()


def slide_many_of(asked, places):
    cells = [asked.at(*place) for place in places]
    first = cells[0]
    return slide_many(
        first.top, [cell.state for cell in cells], first.friction, first.t_end, first.edge, rtol=asked.rtol
    )


# ---- the tab ----


@pytest.fixture(autouse=True)
def nothing_below(request, monkeypatch):
    """Replaces what is shown below the map, which takes seconds for each place."""
    if "below" not in request.node.name:
        monkeypatch.setattr(Steady, "show", lambda *given: None)


def test_what_stands_below_the_map():
    """Leine and Glocker's toy: stands on its stem, and comes off it; the closed form of the steady motions as lines."""
    below = Steady(Runs())
    below.show(Map(seconds=2.0), (28.6, 5.7))
    assert "stands on its stem first at 1.67 s" in below.says.object
    assert len(below.bends.lines.data["xs"]) == 4 and np.isfinite(below.bends.dots[0].data["y"]).sum() > 30
    below.deep.visible = True
    upright, runs = below.pair.branches["upright"]
    growth = np.interp(runs.data["x"], upright.data["x"], upright.data["growth"])
    good = np.isfinite(runs.data["y"])
    np.testing.assert_allclose(runs.data["y"][good], growth[good], rtol=0.05)
    assert "<table>" in below.powers.object
    row = re.search(r"a real contact</th><td>([\d.]+); ([\d.]+)<", below.laws.object)
    for name, told in zip(("growth", "turning"), row.groups(), strict=True):  # the figures say what the table says
        assert np.interp(28.6, upright.data["x"], upright.data[name]) == pytest.approx(float(told), rel=0.02)


@pytest.mark.parametrize("error, says", [(Full(17), "17 computations wait"), (Stopped(), "was stopped before")])
def test_what_stands_below_says_that_it_ended_and_is_asked_for_again(monkeypatch, error, says):
    asked = []

    def never(*given):
        asked.append(given)
        raise error

    monkeypatch.setattr("app.tabs.maps.steady.bifurcation", never)
    below = Steady(Runs())
    for times in (1, 2):
        below.show(Map(), (28.6, 5.7))
        assert says in below.says.object and "under way" not in below.says.object and len(asked) == times


def test_below_a_place_that_cannot_be_nothing_of_the_one_before_is_left(monkeypatch):
    below = Steady(Runs())
    below.deep.visible = True
    below.show(Map(seconds=2.0), (28.6, 5.7))
    assert below.pair.branches["upright"][0].data["x"].size

    def never(*given):
        raise TopError("a", 1.5, "a < 1")

    monkeypatch.setattr("app.tabs.maps.steady.bifurcation", never)
    below.show(Map(seconds=2.0), (28.6, 8.0))
    assert 'role="alert"' in below.says.object and "tilt of 8°" in below.title.object
    assert not below.rates_title.object and not below.powers.object
    pictures = *below.bends.sources, *below.pair.sources
    assert not any(len(column) for source in pictures for column in source.data.values())


def test_another_click_on_the_same_place_asks_again(tab, monkeypatch):
    shown = []
    monkeypatch.setattr(Steady, "show", lambda *given: shown.append(given))
    tab.go(30.0, 8.0)
    tab.go(30.0, 8.0)
    assert len(shown) == 2


@pytest.fixture
def tab():
    fresh = Maps()
    fresh.settings.entries["cells"].value = "3"
    return fresh


def test_what_cannot_be_leaves_the_last_map(tab):
    before = tab.level
    for entry, typed, name in (("across_to", "3", "spin_from"), ("up_to", "500", "tilt"), ("cells", "1e9", "cells"),
                               ("seconds", "long", "seconds")):  # fmt: skip
        good = tab.settings.entries[entry].value
        tab.settings.entries[entry].value = typed
        why, near, back = tab.settings.entries[entry].wrong
        assert name in why and back == good and tab.level is before
        assert near == {"across_to": "", "up_to": "180", "cells": "96", "seconds": ""}[entry]
        tab.settings.entries[entry].value = good if entry == "cells" else near or good  # a map of 96 takes minutes
        assert tab.settings.entries[entry].wrong == []
        tab.settings.entries[entry].value = good


def test_a_click_goes_to_the_run_of_a_cell(tab):
    tab._by_hand({"x": [44.0], "y": [6.0], "cell": [1]})
    i, j = tab.level.cell(44.0, 6.0)
    assert tab.choice.place == [tab.level.x[j], tab.level.y[i]] and tab.level.end[i, j] == "stem"
    assert "stands on its stem" in tab.run_says.object
    tab._by_hand({"x": [44.0], "y": [6.0], "cell": [0]})
    assert tab.choice.place == [44.0, 6.0] and tab.settings.entries["here_across"].value == "44"
    for odd in ({}, {"x": ["a"], "y": [1], "cell": [1]}, {"x": 3, "y": [1], "cell": [1]}):
        tab._by_hand(odd)
    assert tab.choice.place == [44.0, 6.0]


def test_another_axis_law_and_colour(tab):
    tab.settings.choices["law"].value = "smoothed"
    assert tab.request.law == "smoothed" and tab.request.start["second"] == 0.1
    tab.settings.choices["up"].value = "mu"
    assert (
        tab.request.up_range == (0.05, 0.6)
        and not tab.settings.entries["mu"].visible
        and tab.settings.entries["tilt"].visible
    )
    tab.settings.choices["colour"].value = "growth"
    assert tab.request.nudged and np.isfinite(tab.level.columns["growth"]).any()


def test_a_box_looks_closer_and_the_whole_range_comes_back(tab):
    tab._by_hand({"x": [30.0, 20.0], "y": [5.0, 10.0], "cell": [0, 0]})
    assert (tab.request.across_range, tab.request.up_range) == ((20.0, 30.0), (5.0, 10.0))
    assert tab.level.x[0] == pytest.approx(20 + 10 / 6) and 20 < tab.choice.place[0] < 30
    tab.settings.look_at(*tab._usual_spans())
    assert tab.request.across_range == (5.0, 50.0)


def test_the_button_looks_closer_around_the_bead_and_never_beyond_the_map(tab):
    tab.go(20.0, 39.0)
    tab.settings.look_at(*tab._around())
    assert tab.request.across_range == pytest.approx((12.5, 27.5)) and tab.request.up_range == pytest.approx(
        (27.0, 40.0)
    )
    assert tab.choice.place == [20.0, 39.0]


def test_as_many_reasons_as_there_are_can_be_gone_to():
    tab = Maps()
    [form] = tab.disagree
    _, *parts = form.views
    says, shows = [part.object for part in parts[::2]], parts[1::2]
    assert 2 < len(shows) == len(says) == len(tab._ones)
    assert "630 of the 1,465 runs" in says[0] and "561 of them: they come onto the stem" in says[0]
    assert says[1].startswith("69 of them: the stem throws them up")
    for one in tab._ones:
        i, j = tab.level.cell(*one)
        assert (tab.level.x[j], tab.level.y[i]) == one


def test_pieces_are_shown_while_it_is_drawn(tab, monkeypatch):
    seen = []
    monkeypatch.setattr("app.tabs.maps.maps.PICTURE_EVERY", -1.0)  # every piece
    monkeypatch.setattr("app.model.maps.solving.PIECE", 0.0)  # small ones on a fast machine, too
    monkeypatch.setattr(Maps, "_show_part", lambda tab, run, level, share: seen.append(int((level.end != "").sum())))
    tab.settings.entries["seconds"].value = "0.3"
    tab.settings.entries["cells"].value = "24"
    assert len([cells for cells in seen if cells not in (3 * 3, 8 * 8, 24 * 24)]) > 3


def test_the_map_is_in_the_address_and_undone():
    tab = Maps()
    url_state = UrlState()
    url_state.add(tab.choice)
    tab.choice.param.watch(lambda *events: url_state.commit(), [*tab.choice.INPUTS])
    assert url_state.query == ""
    tab.settings.entries["cells"].value = "3"
    tab.settings.choices["law"].value = "smoothed"
    tab.settings.entries["mu"].value = "0.25"
    asked = tab.choice.request
    texts, sentence = read(url_state.query)
    again = MapText.value(texts["map"])
    assert not sentence and again == asked and dict(again.values) == {"mu": 0.25}
    url_state.undo()
    assert tab.settings.entries["mu"].value == "0.3" and tab.request.values == ()
    url_state.undo()
    assert tab.request.law == "contensou"
    url_state.redo()
    url_state.redo()
    assert tab.choice.request == asked
    for odd in ("", "spin", "_".join(["spin"] * 10), MapText.text(asked) + "_mu", MapText.text(asked) + "_own_3"):
        with pytest.raises(ValueError):
            MapText.value(odd)


@pytest.mark.parametrize("preset", PRESETS, ids=lambda preset: preset.name)
def test_a_link_has_the_map_of_its_own_body(preset):
    asked = Map(body=preset.name)
    assert MapText.value(MapText.text(asked)) == asked


@pytest.fixture
def few_cells(monkeypatch):
    """The map of the page's top has 9 cells at first."""
    monkeypatch.setattr("app.tabs.maps.maps.AT_FIRST", Map(cells=3))


def test_the_pages_top_slides(few_cells):
    assert Maps(scene=solve_scene(Top.paper(), 7.0, 10.0, 0.5, 0.9)).request.body == "The paper's tippe top"
    own = Top(0.1, 0.42, 0.41)
    tab = Maps(scene=solve_scene(own, 7.0, 10.0, 0.5, 0.9, shape=None))
    assert tab.request.body == OWN and tab.request.thing.top == own and tab.level.finest
    toy = next(preset for preset in PRESETS if preset.name == "Leine and Glocker's toy")
    tab.show(solve_scene(toy.top, 7.0, 10.0, 0.5, 0.5, shape=toy.shape))
    assert tab.request.body == toy.name and tab.request.own is None


def test_a_link_has_the_map_of_the_pages_own_top(few_cells):
    own = Top(0.1, 0.42, 0.41)
    scene = solve_scene(own, 7.0, 10.0, 0.5, 0.9, shape=None)
    text = MapText.text(replace(Maps(scene=scene).choice.request, law="viscous", cells=3))
    tab = Maps(scene=scene)
    tab.choice.request = MapText.value(text)
    assert tab.request.thing.top == own and tab.level.finest
    assert MapText.text(tab.choice.request) == text
    stem = replace(Map(), across="stem", up="spin", across_range=(16.0, 40.0), up_range=(5.0, 50.0), cells=3)
    tab.choice.request = MapText.value(MapText.text(replace(stem, body=OWN)))  # which a top without a stem has not
    assert tab.choice.request == tab.usual["request"] and tab.wording.object


def test_the_run_of_the_bead_goes_to_the_lab():
    thrown = []
    tab = Maps(throw=lambda *start: thrown.append(start))
    assert tab.thrown.visible and not thrown  # the map alone sets no start
    tab.choice.request = replace(Map(), across_range=(20.0, 30.0), cells=3)
    assert not thrown
    tab.go(30.0, 8.0)
    assert thrown == [("Leine and Glocker's toy", 30.0, 8.0, 0.3, False)]
    tab.settings.choices["law"].value = "viscous"
    assert not tab.thrown.visible


def test_the_map_that_ships_is_what_is_computed():
    shipped = kept.recall(Map(cells=48))
    assert shipped.finest
    i, j = np.array([3, 20, 40, 44]), np.array([44, 30, 10, 25])
    fresh = slide_many_of(Map(), [(shipped.x[b], shipped.y[a]) for a, b in zip(i, j, strict=True)])
    assert fresh.end.tolist() == shipped.end[i, j].tolist()
    np.testing.assert_allclose(np.degrees(fresh.theta_end), shipped.columns["theta_end"][i, j], rtol=1e-4)


def test_what_a_hand_on_the_map_sends_is_let_in():
    """What frontend/src/figures/maps.js sends: a place, the middle of a cell, two corners of a box."""
    for x, y, cell in (([30.5], [6.5], [0]), ([30.5], [6.5], [1]), ([5.0, 6.0], [1.0, 2.0], [0, 0])):
        entries = [["x", x], ["y", y], ["cell", cell]]
        assert CHANGES["Drawing"]["sent"].fits([1, "p7", {"type": "map", "entries": entries}], None)
    sent = set(re.findall(r"cell: (\[.*?\]) }", (ROOT / "app/frontend/src/figures/maps.js").read_text("utf-8")))
    assert sent == {"[0]", "[0, 0]", "[Number(clicked)]"}
