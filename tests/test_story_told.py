"""The independent checker over runs that are computed: starts of which something false was said, and random ones."""

import pytest
import story_checker
from story_checker import BODIES, CASES, LIVES, STEMLESS, faults, starts, starts_of_laws, told_by

from app.model import life, run, tell
from app.model.setup import start_of
from app.model.story import story

FALSE = [
    ("hollow", "spin=20.616&tilt=17.50&mu_k=0.070"),  # "from 15° to 15°": heights, in mm
    ("ball", "spin=0.813&tilt=79.81&mu_k=0.084"),  # "to and fro" of what went one way
    ("loaded", "spin=43.236&tilt=1.95&mu_k=0.341"),  # slides, and it swings
    ("Leine", "spin=11.836&tilt=7.40&mu_k=0.062"),  # sinks, in pieces each of which does, but not together
]
REFUSED = [
    ("paper", "spin=27.5&tilt=51.8"),  # "seconds = 60 is not possible"
    ("disc", "spin=17.219&tilt=7.73&mu_k=0.076"),  # 60.1 s
]


def told(preset, start):
    return tell(f"?v=2&body={BODIES[preset]}&{start}&table=three&tab=lab")


@pytest.mark.parametrize(("preset", "start"), FALSE)
def test_what_was_false_is_so_no_more(preset, start):
    assert faults(told(preset, start), preset in STEMLESS) == []


@pytest.mark.parametrize(("preset", "start"), REFUSED)
def test_rough_and_ice_are_not_refused_for_what_the_ordinary_table_does(preset, start):
    found = told(preset, start)["tables"]
    assert not found["rough"]["refused"] and not found["ice"]["refused"]


def test_a_life_that_takes_too_long_is_shown_as_far_as_it_is_computed_and_goes_on_from_there(monkeypatch):
    """Rough and ice only ask it how long to be shown."""
    start = start_of("Wooden cone", 49.5, 20.0, 0.751)
    life.life_of.cache_clear()
    monkeypatch.setattr(life, "MOST_LOOKS", 20)
    first, later = life.life_of(start).until(6.0), life.life_of(start).until(6.0)
    assert first.cut == later.cut == life.CATCHES and 0 < first.seconds < later.seconds < 6
    assert later.moved[: len(first.moved)].theta.tolist() == first.moved.theta.tolist()
    cut = run.on(start, "ordinary")
    assert cut.start.seconds > later.seconds and cut.ended_at is None
    whole = run.whole_on("ordinary", start)
    assert story(whole).stages[-1].why.endswith(f"computed only up to {whole.start.seconds:.3g} s. The top goes on.")
    assert run.whole_on("rough", start).start.seconds == whole.start.seconds
    for function in (run.whole_on, life.life_of):
        function.cache_clear()


@pytest.mark.long
@pytest.mark.parametrize("drawn", [starts(100, 51), starts_of_laws(60, 51)], ids=["contact", "point"])
def test_nothing_false_is_said_of_random_starts(drawn):
    drawn, false, failed = list(drawn), [], []
    for (preset, query), found in zip(drawn, told_by(query for _, query in drawn), strict=True):
        if "error" not in found:
            false += [(query, *fault) for fault in faults(found, preset in STEMLESS)]
        elif "TopError" not in found["error"]:  # of a body that cannot be put down so
            failed.append((query, found["error"]))
    assert not false and not failed


@pytest.mark.slow
@pytest.mark.parametrize("starts", [CASES, pytest.param(LIVES, marks=pytest.mark.long)], ids=["cases", "lives"])
def test_nothing_false_is_said_of_the_cases_of_the_past(starts):
    assert not story_checker.counted(story_checker.cases(starts))
