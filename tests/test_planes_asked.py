"""Requests to the three planes: what is refused and in which words, what is stopped, what is drawn."""

import asyncio
import re
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from queue import Queue
from types import SimpleNamespace

import numpy as np
import pytest
from bokeh.document import Document
from house import builder_of, chosen, of, planes_of, ran
from panel.io.state import set_curdoc

from app.model.explorer import Explorer
from app.model.motion import for_reader
from app.model.planes.run import solve
from app.model.planes.wells import wells
from app.model.runs import Runs
from app.model.setup import MOST_FRAMES, MOST_SECONDS
from app.tabs.planes.three_planes import ThreePlanes
from app.tabs.planes.words import fate
from app.text import speaking
from tippe_core import PRESETS as BODIES
from tippe_core import Scales, State, Top, TopError, jellett_potential


@pytest.fixture
def explorer():
    return Explorer()


@pytest.fixture
def planes(explorer):
    return planes_of(explorer)


# ---- what is said of a run is what the run does ----


@pytest.fixture(scope="module")
def usual():
    """The default picture."""
    return planes_of(Explorer()).picture


DISC, CONE, PAPERS = "Disc on a peg", "Wooden cone", "The paper's tippe top"


@pytest.mark.slow
def test_a_start_by_constants_that_is_refused_is_answered_beside_the_constants(explorer, planes):
    """Then there is no slider of the tilt."""
    rolling = replace(planes.picture.settings, rolling=planes.picture.state)
    planes._publish(rolling, TopError("tilt", 100.0, "at most 90"))
    assert set(planes.picture.messages) == {"by"}


@pytest.mark.slow
def test_a_start_past_the_touch_is_refused_for_that_and_not_for_its_nutation():
    picture = solve(of(PAPERS, spin=0.0, tilt=179.99, seconds=0.1))
    assert "below the table" in fate(picture, "ice") and "a little" not in fate(picture, "ice")


def test_a_run_that_can_go_no_further_shows_what_was_computed_and_says_why(usual, monkeypatch):
    pushed = State(2.6, 0.0, 0.0, 0.0, vx=0.0, vy=-1.0)
    picture, said = ran(usual, law="coulomb", mu=1.0, mu_s=1.0, rolling=pushed, seconds=0.5)
    assert said.startswith("It goes no further.") and "149.0° at 0 s" in said and "Painlevé’s limit" in said
    monkeypatch.setattr("tippe_core.motion.sliding.MOST_STEPS", 640)
    picture, said = ran(usual, spin=38.0, seconds=60.0)
    motion = picture.motions["ordinary"]
    last = motion.trajectory.events[-1][0] * picture.settings.scales.time
    assert not picture.messages and 0.1 < last < 59 and motion.t[-1] > motion.trajectory.t[-1]
    assert f"At {last:.2f} s it takes more steps than one run may compute" in said
    with speaking("de"):
        _, said = ran(usual, law="coulomb", mu=1.0, mu_s=1.0, rolling=pushed)
    assert "Grenze nach Painlevé" in said


def test_a_limit_is_told_in_what_stands_beside_the_controls():
    scales = Scales.paper()
    error = for_reader(TopError("times", 1500.0, "at most {most:g}", "followed past t = {t:g}{unit}.",
                                most=1357.06, t=1357.06, unit=""), scales)  # fmt: skip
    assert (error.name, error.allowed) == ("seconds", "at most 54.81") and "t = 54.81 s" in error.remedy
    error = for_reader(TopError("theta", 2.6, "less than {most:g} for this top", most=2.07326), scales)
    assert (error.name, error.allowed) == ("tilt", "less than 118.8 for this top")
    assert error.value == pytest.approx(149.0, abs=0.05)
    error = for_reader(TopError("omega3", 10.0, "at most {most:g}", most=40), scales)
    assert (error.name, error.value) == ("spin", pytest.approx(10 * np.sqrt(9.81 / 0.016) / (2 * np.pi), rel=1e-5))


def test_the_longest_time_that_a_refusal_names_is_one_that_is_taken(explorer, planes):
    settings = replace(planes.picture.settings, spin=300.0, seconds=MOST_SECONDS)
    with pytest.raises(TopError) as error:
        settings.times  # noqa: B018
    most = float(re.search(r"at most ([\d.e+]+) s", error.value.allowed)[1])
    assert len(replace(settings, seconds=0.99 * most).times) == MOST_FRAMES + 1
    with pytest.raises(TopError):
        replace(settings, seconds=1.02 * most).times  # noqa: B018


def test_a_run_is_done_to_the_share_of_its_seconds(explorer, planes):
    class Halfway:
        elapsed, reached = 1.0, 0.5

    planes._run, planes._running = Halfway(), planes.picture.settings
    assert planes.share == pytest.approx(0.5)


BAD = [
    ("tilt", {"tilt": 200.0}),
    ("spin", {"spin": float("nan")}),
    ("slip", {"slip": float("inf")}),
    ("seconds", {"seconds": 0.0}),
    ("seconds", {"seconds": 61.0}),
    ("seconds", {"seconds": 60.0, "spin": 400.0}),
    ("mu_s", {"law": "coulomb", "mu": 0.5, "mu_s": 0.4}),
    ("gamma", {"law": "viscous", "gamma": -1.0}),
    ("eps", {"eps": 0.0}),
    ("mu", {"mu": -0.1}),
]


@pytest.mark.slow
def test_a_bad_value_is_said_and_the_last_good_picture_stays(explorer, planes):
    planes.ask(seconds=1.0)
    before = planes.picture
    for control, inputs in BAD:
        good = {name: planes.inputs[name] for name in inputs}
        planes.ask(**inputs)
        assert list(planes.picture.messages) == [control]
        assert planes.picture.motions is before.motions and planes.picture.settings is before.settings
        planes.ask(**good)
        assert not planes.picture.messages
        before = planes.picture


@pytest.mark.slow
def test_at_the_poles_and_without_spin_there_is_an_answer(explorer, planes):
    planes.ask(stem=False)
    for inputs in ({"tilt": 0.0}, {"tilt": 180.0}, {"tilt": 10.0, "spin": 0.0}, {"tilt": 60.0, "spin": -20.0}):
        planes.ask(seconds=1.0, **inputs)
        assert not planes.picture.messages
        assert planes.picture.state.theta == np.radians(inputs["tilt"])


@pytest.mark.slow
def test_a_preset_brings_its_body(explorer, planes):
    body = next(body for body in BODIES if body.name == "Top S")
    assert chosen(explorer, planes, "Top S fast").settings.top == body.shape.top == explorer.scene.top
    assert planes.picture.settings.scales.R == explorer.scene.scales.R == 0.02


@pytest.mark.slow
def test_of_many_asked_for_at_once_the_newest_is_shown_and_a_run_can_be_stopped(explorer):
    posted, shown = Queue(), []
    planes = planes_of(explorer, Runs(posted.put))

    def finish():
        while planes.busy:
            posted.get(timeout=60)()

    finish()
    planes.param.watch(lambda event: shown.append(event.new), "picture")
    for tilt in (11.0, 12.0, 13.0, 14.0):
        planes.ask(tilt=tilt)
    finish()
    assert [picture.settings.tilt for picture in shown] == [11.0, 14.0]

    # an undo puts back the body first, then the inputs: one run, of both
    explorer.param.update(a=0.08)
    planes.follow(explorer.scene)
    planes.ask(tilt=15.0)
    finish()
    assert [(picture.settings.top.a, picture.settings.tilt) for picture in shown[2:]] == [(0.08, 15.0)]

    last = planes.picture
    planes.ask(eps=1e-4, seconds=60.0)
    planes.stop()
    finish()
    assert "Stopped" in planes.picture.messages["run"] and planes.picture.motions is last.motions
    planes.ask(eps=0.1, seconds=5.0)
    finish()
    assert not planes.picture.messages and planes.picture.settings.seconds == 5.0


@pytest.mark.slow
def test_a_place_on_the_map_keeps_I3(explorer, planes):
    inputs = {"plane": "ordinary", **planes.picture.inputs}
    view = ThreePlanes(inputs, planes.ask, explorer.param.update, builder_of(explorer).choose, planes)
    view.show(planes.picture)
    view.pick(0.2, 0.9)
    assert explorer.scene.top == Top(0.2, 0.9 * 0.408, 0.408)


@pytest.mark.slow
@pytest.mark.parametrize("law", ["contact", "viscous"])
def test_what_the_bead_has_left_stands_above_it(explorer, planes, law):
    """Where pivoting changes C_J too: V_J is the least energy at any C_J."""
    planes.ask(law=law, seconds=3.0)
    _, bead = wells(planes.picture, "ordinary")
    inside = bead.which >= 0
    assert inside.sum() > 100 and np.all(bead.E[inside] >= bead.V[inside])
    # at first its own C_J is that of the well to a few parts in a thousand, and what is left is the energy over V_J
    start = planes.picture.motions["ordinary"].trajectory
    assert bead.E[0] - bead.V[0] == pytest.approx(
        start.energy[0] - jellett_potential(start.theta[0], start.top, start.jellett[0]), abs=1e-9)  # fmt: skip


def test_without_its_stem_the_ball_alone_is_drawn(explorer, planes):
    """It could not stop at the table, and the stem would be seen to pass through it."""
    settings = planes.picture.settings
    assert settings.drawn is settings.profile and settings.profile[:, 1].max() > 1.5
    alone = replace(settings, stem=False).drawn
    assert np.allclose(np.hypot(*alone.T), 1, atol=1e-6)


def test_a_top_that_coulombs_law_catches_leads_to_why(explorer, planes):
    shown, view = (
        [],
        ThreePlanes({"plane": "ordinary"} | planes.inputs, *(None,) * 3, planes, None, lambda: shown.append(1)),
    )
    for law, leads in (("coulomb", True), ("contact", False), ("coulomb", True)):
        planes.ask(law=law, spin=30.0, tilt=5.0, seconds=3.0)
        view.show(planes.picture)
        assert view._why.visible is leads
    view._why.clicks += 1
    assert shown == [1]


def test_a_run_that_no_session_waits_for_is_not_followed_for_ever(planes):
    view = ThreePlanes({"plane": "ordinary"} | planes.inputs, None, None, None, SimpleNamespace(busy=True))

    async def wait():
        with set_curdoc(Document()):
            view.wait()
        return asyncio.all_tasks() - {asyncio.current_task()}

    with ThreadPoolExecutor(1) as other:  # a browser's loop may run in this one
        assert other.submit(asyncio.run, wait()).result() == set()
