"""The map of the tops with names: what decides whether one can turn over, and what is said of it."""

import re
from xml.etree import ElementTree

import numpy as np
import pytest

from app.model.explorer import Explorer
from app.model.families.__main__ import least
from app.model.families.known_tops import known_of, known_tops
from app.model.lab.ends import known_ends
from app.model.setup import TOYS
from app.tabs.families.tops import Tops, sentence
from tippe_core import PRESETS, lift_off_and_slip_tielines


def test_every_preset_has_a_place_and_no_two_share_one():
    places = [(top.top.a, top.ratio) for top in known_tops()]
    for preset in PRESETS:
        away = [abs(preset.top.a - a) + abs(preset.top.I1 / preset.top.I3 - ratio) for a, ratio in places]
        assert min(away) < 1e-3
    assert len({(round(a, 3), round(ratio, 3)) for a, ratio in places}) == len(places)


@pytest.mark.parametrize(
    "name, said",
    [
        # 43.56 rad/s upright, and 41.61 for what it has to be launched with: physics.md
        ("The paper's tippe top", f"not below {43.56 / (2 * np.pi):.1f}."),
        # 27.668 and 76.761 rad/s with g = 9.82
        ("Top S", f"not below {76.761 * (9.80665 / 9.82) ** 0.5 / (2 * np.pi):.1f}."),
        # Leine and Glocker's: standing is allowed from 19 turns a second on
        ("Leine and Glocker's toy", "not below 19.0."),
        ("Leine and Glocker's toy", "in runs from 25.5 turns a second on"),
        ("Loaded sphere", "148° at most"),
        ("Uniform ball", "it prefers no tilt"),
    ],
)
def test_what_is_said_of_a_top_is_what_its_numbers_decide(name, said):
    assert said in sentence(next(top for top in known_tops() if top.name == name))


def test_the_least_spin_is_that_of_runs(monkeypatch):
    """None of the runs below it stands, whatever the bound for a point allows: of those that ship, which test_lab.py
    computes anew."""
    name = "Leine and Glocker's toy"
    monkeypatch.setattr("app.model.families.__main__.ends_of", known_ends)
    assert next(top for top in known_tops() if top.name == name).stands_from == least(name)


@pytest.fixture
def view():
    asked = []
    view = Tops(Explorer().scene, lambda **inputs: asked.append(inputs), asked.append, asked.append)
    view.request = asked
    return view


def test_a_click_shows_a_top_large_and_changes_nothing_else(view):
    view.map.picked = [1, "Loaded sphere"]
    assert "148°" in view.head.object and view.map.state["chosen"] == "Loaded sphere" and view.request == []
    assert len(list(ElementTree.fromstring(f"<p>{view.figures.object}</p>").iter("svg"))) == 2
    view.map.picked = [2, "no such top"]
    assert view.map.state["chosen"] == "Loaded sphere"


def test_a_known_top_that_the_page_comes_to_is_looked_at_and_else_what_was_clicked_stays(view):
    scene = Explorer().scene
    top_s = Explorer(a=0.3, I1=TOYS["Top S"].top.I1, I3=TOYS["Top S"].top.I3).scene
    view.show(top_s)
    assert view.map.state["chosen"] == "Top S" and "Top S" in view.head.object
    view.map.picked = [1, "Loaded sphere"]
    for shown in (top_s, Explorer(a=0.2, I3=0.399 / 1.1).scene):
        view.show(shown)
        assert view.map.state["chosen"] == "Loaded sphere"
    view.show(scene)
    assert view.map.state["chosen"] == known_of(scene).name


def test_the_ring_is_the_pages_top_and_asks_for_another(view):
    here = view.map.state["here"]
    assert here["a"] == 0.07 and here["ratio"] == pytest.approx(0.399 / 0.408) and here["outline"] is None
    view.map.moved = [1, 0.2, 1.1]
    assert view.request == [{"a": 0.2, "I3": pytest.approx(0.399 / 1.1)}]
    view.show(Explorer(a=0.2, I3=0.399 / 1.1).scene)
    assert view.map.state["here"]["a"] == 0.2 and view.map.state["here"]["outline"]
    assert known_of(Explorer(a=0.2, I3=0.399 / 1.1).scene) is None


def test_fig_6_of_a_top_has_its_steady_precession_where_the_core_has_it(view):
    view.map.picked = [1, "Top S"]
    six, _ = ElementTree.fromstring(f"<p>{view.figures.object}</p>").iter("svg")
    [steady] = [path for path in six.iter("path") if path.get("stroke-dasharray") == "6 4"]
    points = np.array(re.findall(r"(-?[\d.]+) (-?[\d.]+)", steady.get("d")), float)
    texts = {text.text: float(text.get("x")) for text in six.iter("text") if text.text in ("0", "3")}
    found = next(top for top in known_tops() if top.name == "Top S").shown(0.5)
    lift, _ = lift_off_and_slip_tielines(found.top, found.part * found.pole, 9.4519, 0.5)
    upright, three = 34.0, texts["3"]
    theta = 3 * (points[:, 0] - upright) / (three - upright)
    assert theta == pytest.approx(lift.theta_steady, abs=0.02)
    assert TOYS["Top S"].top == found.top
