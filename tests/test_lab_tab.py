"""The Lab's tab without a browser: what a wish of the browser does, and what a link keeps."""

import pytest

from app.model.arrival import TILT
from app.model.lab import Lab
from app.model.start import arrives
from app.tabs.lab.lab import SLIDERS, LabTab, spelled
from app.text import speaking


@pytest.fixture
def tab(monkeypatch):
    monkeypatch.setattr("app.tabs.lab.lab.after", lambda seconds, act: act())
    lab, done = Lab(), []
    made = LabTab(lab, lambda: done.append("research"), lambda: done.append("rests"))
    made.lab, made.done = lab, done
    lab.show()
    return made


def wish(tab, *asked):
    tab.view.asked = list(asked)
    return tab.view.state


def test_a_wish_is_answered_with_its_count(tab):
    frames = tab.view.frames_ordinary
    state = wish(tab, 1, "tilt", 12.0)
    assert (state["answered"], state["values"]["tilt"]) == (1, 12.0)
    assert tab.view.frames_ordinary != frames
    assert tab.done == ["rests"]


def test_what_cannot_be_is_said_and_the_motion_stays(tab):
    frames = tab.view.frames_ordinary
    state = wish(tab, 1, "tilt", 185.0)
    assert list(state["messages"]) == ["tilt"] and state["refused"] == {"tilt": 185.0}
    assert state["values"]["tilt"] == TILT and "5.7°" in state["old"]
    assert tab.view.frames_ordinary == frames
    assert wish(tab, 2, "tilt", state["values"]["tilt"])["messages"] == {}


def test_another_table_has_its_own_motion_and_the_same_start(tab):
    before = wish(tab, 1, "spin", 30.0)["values"]
    state = wish(tab, 2, "table", "three")
    assert state["table"] == "three" and state["values"] == before
    assert all(getattr(tab.view, f"curves_{table}") for table in ("ordinary", "rough", "ice"))
    assert {len(run["keeps"]) for run in state["runs"].values()} == {4}


def test_the_papers_figures_are_asked_for(tab):
    wish(tab, 1, "research", 1)
    assert "research" in tab.done


@pytest.mark.parametrize("asked", [[1, "runs", 2], [1, "tilt"], ["1", "tilt", 3], []])
def test_what_a_page_never_sends_changes_nothing(tab, asked):
    before = tab.view.state
    assert wish(tab, *asked) == before


def test_a_slider_has_the_start_of_the_arrival_within_it():
    for name, (low, high, step, _) in SLIDERS.items():
        assert low < arrives()[name] < high and step < high - low


def test_numbers_are_written_as_the_language_writes_them():
    assert spelled("at 4.5 s, 21 mm.") == "at 4.5\u00a0s, 21\u00a0mm."
    with speaking("de"):
        assert spelled("Nach 4.5 s fällt er. Ende.") == "Nach 4,5\u00a0s fällt er. Ende."
