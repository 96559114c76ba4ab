"""The list of what happened in a run is read from the run, and can be seen and clicked."""

from dataclasses import replace

import numpy as np
import pytest
from doubles import by_hand

from app.model.lab.event_list import MOST, events_of
from app.model.lab.lab import scene_of
from app.model.run import on
from app.model.setup import start_of
from app.text import speaking

TOY = "Leine and Glocker's toy"


@pytest.fixture(scope="module")
def toy():
    """The Lab's toy on its three tables."""
    return scene_of("three", start_of(TOY, 28.65, 5.73, 0.3))


def told(scene, table):
    return events_of(scene.motions[table])


def test_the_toys_life_has_the_times_of_another_body_on_compliant_contacts(toy):
    """Over at 0.98 s, its own spin zero there; the stem touches, it stands, falls, the ball touches, off its stem."""
    found = told(toy, "ordinary")
    assert [moment.seconds for moment in found] == sorted(moment.seconds for moment in found)
    times = {moment.word: moment.seconds for moment in found}
    for word, time in (
        ("turns over", 0.977),
        ("its spin about its own axis passes zero", 0.98),
        ("stands on its stem", 1.471),
        ("starts to fall", 4.497),
    ):
        assert times[word] == pytest.approx(time, abs=0.01)
    by_contact = {round(moment.seconds, 2) for moment in found}
    assert {1.37, 4.75, 5.57} <= by_contact
    assert found[0][:3] == (0.0, 0.0, "let go") and found[0].more.startswith("slips on its ball, 5.7°")
    over = next(moment for moment in found if "passes zero" in moment.word)
    moved = toy.motions["ordinary"].trajectory
    assert abs(np.interp(over.t, moved.t, moved.routh)) < 0.02 and "<i>K</i><sub>R</sub> \N{MINUS SIGN}0.0" in over.more
    with speaking("de"):
        assert told(toy, "ordinary")[0].word == "losgelassen"


def test_what_only_rolls_or_glides_has_little_to_tell(toy):
    assert [moment.word for plane in ("rough", "ice") for moment in told(toy, plane)] == ["let go", "let go"]
    assert events_of(None) == ()


def test_one_event_has_one_word():
    """That it sticks for good is that the table grips it; that the ball leaves is not yet a stand on the stem."""
    caught = replace(start_of(TOY, 28.65, 5.73, 0.3), law="coulomb")
    assert [moment.word for moment in events_of(on(caught, "ordinary"))] == ["let go", "is gripped and rolls"]
    for law in ("contact", "smoothed"):
        words = [moment.word for moment in events_of(on(replace(caught, law=law), "ordinary"))]
        assert sum("stands on its" in word for word in words) == 1 and any(
            "stem carries it" in word or "rattles on its ball and stem" in word for word in words
        )
    slow = replace(start_of("Wooden cone", 5.0, 20.0, 0.3), law="coulomb")  # it sticks and slips before
    assert [moment.word for moment in events_of(on(slow, "ordinary"))].count("sticks") == 1


def test_a_stem_that_chatters_is_told_in_few_lines():
    """The paper's top rattles on ball and stem."""
    found = events_of(on(by_hand(), "ordinary"))
    assert len(found) <= MOST and any("rattles on its ball and stem until" in moment.word for moment in found)
