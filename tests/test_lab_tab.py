"""The Lab's tab without a browser: the effect of a browser's request, and what a link stores."""

import json

import numpy as np
import pytest

from app.model.arrival import TILT, TOY
from app.model.explorer import Explorer
from app.model.lab.lab import Lab
from app.model.start import arrives
from app.tabs.lab.lab import SLIDERS, LabTab, begin, spelled
from app.text import speaking
from tippe_core import PRESETS


@pytest.fixture
def tab(monkeypatch):
    for module in ("tabs.lab.lab", "widgets.rest"):
        monkeypatch.setattr(f"app.{module}.after", lambda seconds, act: act())
    monkeypatch.setattr("app.widgets.rest.REST", 0.0)
    lab, done = Lab(), []
    lab.rest = lambda: None  # the ends for all spins are not needed here
    made = LabTab(lab, lambda: done.append("rests"), research=lambda: done.append("research"))
    made.lab, made.done = lab, done
    lab.show()
    return made


def wish(tab, *asked):
    tab.view.request = list(asked)
    return shown(tab)


def shown(tab):
    return json.loads(tab.view.told) | json.loads(tab.view.state)


def test_what_no_hand_of_the_tab_has_changed_comes_to_rest_too(monkeypatch):
    """As after an undo; of several scenes the last one counts."""
    waits, rested = [], []
    monkeypatch.setattr("app.widgets.rest.after", lambda seconds, act: waits.append(act))
    monkeypatch.setattr("app.widgets.rest.REST", 0.0)
    lab = Lab()
    lab.rest = lambda: rested.append(lab.explorer.tilt)
    begin(lab)
    for tilt in (11.0, 12.0):
        lab.ask(tilt=tilt)
    for act in waits:
        act()
    assert rested == [TILT, 12.0]


def test_a_push_too_many_is_answered_and_the_others_stay(tab):
    for count in (12, 13):
        said = wish(tab, count, "pushes", "~".join(f"{0.1 * i:.1f}_0_0_10_.01_0_0" for i in range(1, count + 1)))
    assert "up to 12 pushes" in said["messages"]["pushes"] and said["answered"] == 13
    assert len(tab.lab.explorer.pushes) == 12
    assert not wish(tab, 14, "pushes", "")["messages"]


def test_inertias_that_no_body_has_leave_what_is_shown(tab):
    before = shown(tab)
    tab.lab.explorer.set(I3=2.0)  # typed at the level "Research"
    tab.show()
    assert shown(tab)["of"] == before["of"] and shown(tab)["was"] == shown(tab)["wants"] == ""


def test_a_wish_is_answered_with_its_count(tab):
    frames = tab.view.frames_ordinary
    state = wish(tab, 1, "tilt", 12.0)
    assert (state["answered"], state["values"]["tilt"]) == (1, 12.0)
    assert tab.view.frames_ordinary != frames
    assert tab.done == ["rests"]


def test_the_stem_and_the_ballast_are_ordinary_controls(tab):
    """A rounder, longer stem: another body, whose runs end differently."""
    state = shown(tab)
    assert [name for name, *_ in state["dims"]] == ["dim:R", "dim:r", "dim:h", "dim:a"]
    assert state["values"]["dim:r"] == 5.0 and state["sliders"]["dim:r"][3] == 1
    state = wish(tab, 1, "dim:r", 3.0)
    assert state["values"]["dim:r"] == 3.0 and tab.lab.scene.motions["ordinary"].start.shape.r == pytest.approx(3e-3)
    assert state["of"]["dim:r"][:2] == [3.0, "Radius of the stem's end 3.0\u00a0mm"]
    motion = tab.lab.scene.motions["ordinary"]
    for number, (value, said) in enumerate(
        [("round", "round is not a number"), (1e9, "1000000000"), ("nan", "nan")], 2
    ):
        state = wish(tab, number, "dim:r", value)
        assert said in state["messages"]["dim:r"] and state["refused"]["dim:r"] == value
        assert tab.lab.scene.motions["ordinary"] is motion and state["values"]["dim:r"] == 3.0
    assert not wish(tab, 9, "dim:r", 5.0)["messages"]


@pytest.mark.parametrize("preset", PRESETS, ids=lambda preset: preset.name)
def test_every_toy_has_its_dimensions_in_the_limits_of_their_sliders(tab, preset):
    state = wish(tab, 1, "toy", preset.name)
    for name, *_ in state["dims"]:
        low, high, *_ = state["sliders"][name]
        assert low <= state["values"][name] <= high
    if state["dims"]:
        name, *_ = state["dims"][0]
        grown = wish(tab, 2, name, 1.1 * state["values"][name])
        assert grown["values"][name] == pytest.approx(1.1 * state["values"][name]) and not grown["messages"]


def test_what_cannot_be_is_said_and_the_motion_stays(tab):
    frames = tab.view.frames_ordinary
    state = wish(tab, 1, "tilt", 185.0)
    assert list(state["messages"]) == ["tilt"] and state["refused"] == {"tilt": 185.0}
    assert state["values"]["tilt"] == TILT and "5.7°" in state["old"]
    assert tab.view.frames_ordinary == frames
    assert state["nearest"] == {"tilt": 175.0}
    state = wish(tab, 2, "tilt", state["nearest"]["tilt"])
    assert state["messages"] == state["nearest"] == {} and state["values"]["tilt"] == 175.0


def test_the_nearest_size_that_can_be_is_offered_and_can_be_taken(tab):
    """A stem's end of 5 mm cannot be wider than its ball of 15 mm, nor 20 mm above that, where the two only touch."""
    for number, (name, wanted, near) in enumerate([("dim:r", 16.0, 15.0), ("dim:h", 1e300, 19.9)]):
        state = wish(tab, 3 * number + 1, name, wanted)
        assert state["nearest"] == {name: near} and state["values"][name] != near
        was = state["values"][name]
        state = wish(tab, 3 * number + 2, name, near)
        assert not state["messages"] and state["values"][name] == near
        wish(tab, 3 * number + 3, name, was)
    size = wish(tab, 90, "toy", TOY)["values"]["dim:r"]
    wish(tab, 91, "dim:r", 16.0)
    assert wish(tab, 92, "dim:r", size)["toy"] == TOY  # which one it is, if one goes back
    assert not wish(tab, 99, "dim:r", "round")["nearest"]


def test_another_table_has_its_own_motion_and_the_same_start(tab):
    before = wish(tab, 1, "spin", 30.0)["values"]
    state = wish(tab, 2, "table", "three")
    assert state["table"] == "three" and state["values"] == before
    assert all(getattr(tab.view, f"curves_{table}") for table in ("ordinary", "rough", "ice"))
    for table in ("ordinary", "rough", "ice"):
        rows = np.frombuffer(getattr(tab.view, f"keeps_{table}"), np.float32).reshape(-1, 13)
        assert rows[0, 0] == 0 and np.isfinite(rows).all()
    wish(tab, 3, "table", "ice")
    assert not tab.view.keeps_ice


def test_at_research_a_value_says_what_it_means_for_this_top(tab):
    """Let go with G at rest, the ball's lowest point moves at omega R sin(tilt)."""
    assert shown(tab)["notes"] == {}
    tab.view.level = "research"
    speed = 100 * 2 * np.pi * 28.65 * 0.015 * np.sin(np.radians(5.73))
    assert f"slips at {speed:.3g} cm/s" in shown(tab)["notes"]["slip"]
    assert shown(tab)["rubs"][-1][0] == "slip"
    tab.view.level = "explore"
    assert [name for name, *_ in shown(tab)["rubs"]] == ["patch"]


def test_a_refused_constant_names_the_stage_as_old_at_research_only(tab):
    """Below the steady precession there is no motion (E' of f = f' = 0), so the stage still has the one before."""
    rolling = Explorer()
    possible = rolling.scene
    rolling.set(solve=False, E=possible.marks.steady - 1, given="E")
    rolling.settle()
    tab.follow(rolling.scene)
    assert shown(tab)["old"] == ""
    tab.view.level = "research"
    assert shown(tab)["old"] == f"energy {possible.constants.E:.6g}"
    rolling.set(solve=False, E=possible.constants.E, given="E")
    rolling.settle()
    tab.follow(rolling.scene)
    assert shown(tab)["old"] == ""


def test_the_papers_figures_are_asked_for(tab):
    wish(tab, 1, "research", 1)
    assert "research" in tab.done


@pytest.mark.parametrize("asked", [[1, "runs", 2], [1, "tilt"], ["1", "tilt", 3], []])
def test_what_a_page_never_sends_changes_nothing(tab, asked):
    before = shown(tab)
    assert wish(tab, *asked) == before


def test_a_slider_has_the_start_of_the_arrival_within_it():
    for name, (low, high, step, _) in SLIDERS.items():
        assert low < getattr(Explorer(**arrives()).setup, name) < high and step < high - low


def test_numbers_are_written_as_the_language_writes_them():
    assert spelled("at 4.5 s, 21 mm.") == "at 4.5\u00a0s, 21\u00a0mm."
    with speaking("de"):
        assert spelled("Nach 4.5 s fällt er. Ende.") == "Nach 4,5\u00a0s fällt er. Ende."


@pytest.mark.parametrize("name, beyond, track", [("spin", -5.0, [-100, 50]), ("tilt", 80.2, [0, 180])])
def test_a_slider_reaches_to_a_value_beyond_it(tab, name, beyond, track):
    """To the bound of what may be typed; back among the usual ones it is as before."""
    usual = shown(tab)["sliders"][name][:2]
    state = wish(tab, 1, name, beyond)
    assert (state["values"][name], state["sliders"][name][:2]) == (beyond, track) and not state["messages"]
    assert wish(tab, 2, name, 20.0)["sliders"][name][:2] == usual
