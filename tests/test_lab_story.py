"""What the Lab says of a run is what the run did, and where runs end for all spins."""

import re
import threading
from collections import OrderedDict
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from itertools import cycle

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.model import life
from app.model.arrival import TILT, TOY
from app.model.events import first_times
from app.model.lab import ends
from app.model.lab.ends import SPINS, ends_of, mixed
from app.model.lab.lab import scene_of
from app.model.regimes import ENDS
from app.model.run import motion_on, whole_on
from app.model.runs import Stopped
from app.model.setup import SECONDS, TABLES, TOYS, start_of
from app.model.story import story
from app.text import LANGUAGES, speaking
from tippe_core import PRESETS, Contensou, State, TopError, slide

CONE = "Wooden cone"


def codes(motion):
    return first_times(motion)


# ---- the story ----


STARTS = (-20.0, 60.0), (0.0, 6.0), (5.0, 120.0), (35.0, 6.0), (35.0, 0.0), (0.0, 180.0), (5.0, 60.0), (-20.0, 6.0)


@pytest.mark.slow
@pytest.mark.parametrize("preset", PRESETS, ids=lambda preset: preset.name)
def test_every_preset_has_a_story_or_a_sentence_why_not(preset):
    for language, (spin, tilt) in zip(cycle(LANGUAGES), STARTS, strict=False):
        with speaking(language):
            try:
                scene = scene_of("three", start_of(preset.name, spin, tilt, 0.3))
            except TopError as error:
                assert error.name == "tilt" and error.code == "body-below-table"
                continue
            assert scene.stories.keys() | scene.refused.keys() == set(TABLES)
            for table, told in scene.stories.items():
                check(told, scene.motions[table])


def check(told, motion):
    times = [stage.t for stage in told.stages]
    assert times[0] == 0 and times == sorted(times) and times[-1] <= SECONDS
    assert all(0 < event.t <= SECONDS for event in told.events)
    words = " ".join([told.caption, *(word for stage in told.stages for word in stage[1:]),
                      *(word for event in told.events for word in event[2:])])  # fmt: skip
    assert not re.search(r"[{}]|\bnan\b|\binf\b|  ", words)
    if motion.ended_at is not None:
        assert (motion.frames[-1][-1] == ENDS and "ends" in codes(motion)) or "flat" in codes(motion)


def test_an_ordinary_top_is_set_upright_and_a_slow_one_falls():
    motion = motion_on("ordinary", start_of(CONE, 20.0, 15.0, 0.3))
    up = story(motion)
    assert [event.code for event in up.events] == ["stands-upright"]
    assert up.stages[-1].headline == "It stands upright and spins." and "hold it there" in up.stages[-1].why
    (since,) = codes(motion).values()
    assert np.interp(since, motion.seconds, motion.tilt) == pytest.approx(5, abs=0.1)
    down = story(motion_on("ordinary", start_of(CONE, 0.5, 6.0, 0.3)))
    assert down.stages[0].headline == "Without spin it falls over."
    slow = story(motion_on("ordinary", start_of(CONE, 3.8, 6.0, 0.3))).stages[0]
    assert slow.headline == "It falls." and "it would need about 13" in slow.why
    assert "its rim touches" in [event.word for event in down.events]


def test_a_run_that_nobody_waits_for_says_so(monkeypatch):
    """A cone whose rim chatters, and less patience than a page has."""
    monkeypatch.setattr(life, "MOST_LOOKS", 5)
    scene = scene_of("ordinary", start_of(CONE, 8.0, 6.0, 0.3), whole=True)
    motion = scene.motions["ordinary"]
    assert motion.cut == life.CATCHES and not scene.refused and 0 < motion.start.seconds < 6
    assert scene.stages[-1].why.endswith(
        f"catches and slips so fast that it is computed only up to {motion.start.seconds:.3g} s. The top goes on."
    )


def test_the_papers_top_hangs_on_no_stem_and_is_caught():
    """At 35 rev/s its stem touches, it falls back on its ball and is caught, rolling: as a direct run of it says."""
    motion = motion_on("ordinary", start_of("The paper's tippe top", 35.0, 6.0, 0.3))
    assert list(codes(motion)) == ["stem", "off", "rolls"]  # it is beyond 120 degrees for less than half a second
    preset = TOYS["The paper's tippe top"]
    shape, scales = preset.shape, preset.shape.scales
    state = State(np.radians(6), 0, 0, 2 * np.pi * 35 / scales.angular_velocity)
    moved = slide(preset.top, state, Contensou(0.3, 0.5e-3 / scales.R), np.linspace(0, 6 / scales.time, 6001),
                  edge=shape.edge)  # fmt: skip
    slipped = moved.t[moved.regime == "slip"][-1] * scales.time
    assert codes(motion)["rolls"] == pytest.approx(slipped, abs=0.01)
    assert set(moved.regime[moved.t * scales.time > slipped + 1e-6]) == {"roll"}


# ---- where runs of all spins end ----


@pytest.mark.slow
def test_the_strip_of_the_toy_leans_and_then_stands():
    """With elastic contacts: never at 22.3 rev/s, always from 27.06 on."""
    found = ends.known_ends(start_of(TOY, 0.0, TILT, 0.3))  # which ships; a test computes it anew
    # just where it begins to lean the runs end by turns on either side of the judge's limit
    assert [each.code for each in found.segments if each.code != "mixed"] == ["upright", "leans", "stands"]
    assert 22.3 < found.segments[-1].least < 27.06
    assert found.segments[0].least == 0 and found.segments[-1].most == 50
    assert all(a.most == b.least for a, b in zip(found.segments, found.segments[1:], strict=False))
    assert ends.known_ends(start_of(TOY, 0.0, TILT, 0.31)) is None


def test_of_those_who_ask_for_the_same_ends_at_once_one_computes_them(monkeypatch):
    asked, go, found = [], threading.Event(), object()

    def slow(key, look=None):
        asked.append(key)
        assert go.wait(60)
        return ends._kept.setdefault(key, found)

    monkeypatch.setattr(ends, "ends_of", slow)
    monkeypatch.setattr(ends, "_kept", OrderedDict())
    with ThreadPoolExecutor(3) as threads:
        waits = [
            threads.submit(ends.ends_once, start_of(TOY, 0.0, TILT, 0.77), look=lambda share: go.set())
            for _ in range(3)
        ]
        assert [each.result() for each in waits] == [found] * 3
    assert len(asked) == 1 and not ends.ONCE._claimed


def test_after_one_who_stops_only_one_of_the_others_computes(monkeypatch):
    """The first run stops once a second one waits; the second one then runs until a third waits or runs."""
    asked, second_waits, third_came, found = [], threading.Event(), threading.Event(), object()

    def slow(key, look=None):
        asked.append(key)
        if len(asked) == 1:
            assert second_waits.wait(60)
            raise Stopped
        if len(asked) == 2:
            second_computes.set()
            assert third_came.wait(60)
            return ends._kept.setdefault(key, found)
        third_came.set()
        return found

    second_computes = threading.Event()
    monkeypatch.setattr(ends, "ends_of", slow)
    monkeypatch.setattr(ends, "_kept", OrderedDict())
    with ThreadPoolExecutor(3) as threads:
        one = threads.submit(ends.ends_once, start_of(TOY, 0.0, TILT, 0.77))
        two = threads.submit(ends.ends_once, start_of(TOY, 0.0, TILT, 0.77), look=lambda share: second_waits.set())
        assert second_computes.wait(60)
        three = threads.submit(ends.ends_once, start_of(TOY, 0.0, TILT, 0.77), look=lambda share: third_came.set())
        assert isinstance(one.exception(), Stopped) and two.result() is three.result() is found
    assert len(asked) == 2 and not ends.ONCE._claimed


@pytest.fixture
def few_spins(monkeypatch):
    """Every eighth spin only."""
    monkeypatch.setattr(ends, "SPINS", SPINS[::8])


def test_what_another_thread_throws_away_is_found_whole_or_not_at_all(monkeypatch):
    """The oldest entry is removed while it is being looked up, as with a slow thread."""

    class Slow(OrderedDict):
        def get(self, key):
            found = super().get(key)
            other = threads.submit(ends.ends_of, start_of(TOY, 0.0, TILT, 0.78))
            with suppress(TimeoutError):
                other.result(1)
            return found

    monkeypatch.setattr(ends, "_codes", lambda starts, look: ())
    monkeypatch.setattr(ends, "MOST", 1)
    monkeypatch.setattr(ends, "_kept", Slow())
    found = ends.ends_of(start_of(TOY, 0.0, TILT, 0.77))
    with ThreadPoolExecutor(1) as threads:
        assert ends.known_ends(start_of(TOY, 0.0, TILT, 0.77)) is found
    assert [key.mu for key in ends._kept] == [0.78]


@pytest.mark.slow
@pytest.mark.parametrize("toy", ["The paper's tippe top", "Top S"])
def test_the_strip_is_what_single_runs_do(toy, request):
    if toy == "Top S":
        request.getfixturevalue("few_spins")
    found = ends_of(start_of(toy, 0.0, 6.0, 0.3))
    for i in np.linspace(0, len(ends.SPINS) - 1, 3, dtype=int):
        motion = whole_on("ordinary", start_of(toy, float(ends.SPINS[i]), 6.0, 0.3))
        kinds = (("stands", "stands-on-stem"), ("inverted", "stands-inverted"))
        expected = next((code for code, kind in kinds if kind in codes(motion)), None)
        if expected is None:
            expected = "leans" if motion.tilt[-1] > 20 else "upright"
        assert found.codes[i] == expected, ends.SPINS[i]
    if toy != "Top S":
        assert [segment.code for segment in found.segments].count("leans") > 1  # interleaved, and shown like that


@pytest.mark.slow
def test_what_rises_slowly_stands_too(few_spins):
    """With little friction: its own life stands from 8 to 16 s on, and after 6 s it leans."""
    found = ends_of(start_of(TOY, 0.0, 5.7, 0.05))
    assert found.segments[-1].code == "stands" and found.segments[-1].least < 30
    for spin in (30.0, 45.0):
        assert "stands-on-stem" in codes(whole_on("ordinary", start_of(TOY, spin, 5.7, 0.05)))


@given(st.lists(st.sampled_from("ab"), min_size=1, max_size=30))
def test_nothing_is_smoothed(letters):
    """Spins that are not marked as mixed are unchanged; mixed ones have another end within two cells."""
    for i, (was, shown) in enumerate(zip(letters, mixed(tuple(letters)), strict=True)):
        assert shown in (was, "mixed")
        assert shown != "mixed" or len(set(letters[max(i - 2, 0) : i + 3])) == 2
    alternating = tuple("aaaa" + "ba" * 4 + "bbbb")
    assert mixed(alternating) == ("a",) * 3 + ("mixed",) * 10 + ("b",) * 3
