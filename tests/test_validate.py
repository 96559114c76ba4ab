"""A browser that sends something else instead of a number: one line in the log, and the page is unchanged."""

import math

import pytest
from bokeh.document import Document
from doubles import builder_of
from panel.io.state import set_curdoc

from app.model.explorer import Explorer
from app.model.playing import Playing, together
from app.state.codecs import Numbers
from app.state.url_state import UrlState
from app.tabs.build.build import Build
from app.tabs.lab.rolling import Rolling
from app.widgets.controls import Controls
from app.widgets.scheduling import RenderScheduler
from app.widgets.surface3d import Surface3D
from app.widgets.top3d import Top3D

VALUES = (None, True, -1, 10**400, 1e308, math.nan, "", "x" * 5000, [], {}, [[{"a": [None]}], {"b": 1}])
NUMBERS = [value for value in VALUES if value != 1e308]  # which is unusual, but a number: it is answered like one


@pytest.fixture
def scheduler(explorer):
    with set_curdoc(Document()):
        yield RenderScheduler(explorer)


@pytest.fixture
def one_line(caplog):
    """Each ignored value gives one line in the log, and no error."""
    yield
    for record in caplog.records:
        if record.name == "tippe":
            assert record.levelname == "WARNING" and record.getMessage().startswith("passed over: ")
            assert "\n" not in record.getMessage() and record.exc_info is None


def lists(value, *others):
    """Lists of the right length with this value at each place, or the value itself if it is a list; too short and too
    long lists."""
    for i in range(len(others)):
        yield [*others[:i], value, *others[i + 1 :]]
    yield from ([value], [*others, value])
    if isinstance(value, list):
        yield value


@pytest.mark.slow
def test_a_dial_passes_over_what_it_never_sends(explorer, scheduler, one_line):
    controls = Controls(explorer.scene, scheduler.ask)
    control = controls.numbers
    for i, value in enumerate(VALUES):
        for typed, wish in ((False, 6.0), (True, "6")):
            for sent in lists(value, 1, "K_J", wish, typed):
                control.view.request = sent
                assert math.isfinite(explorer.scene.constants.K_J)
        control.view.request = [99 + i, "K_J", 6.25 + i, False]
        assert scheduler._wanted.get("K_J", explorer.K_J) == 6.25 + i


@pytest.mark.slow
def test_a_hand_on_a_picture_passes_over_what_it_never_sends(explorer, scheduler, one_line):
    [[place], draws] = Rolling(scheduler, None, None).surface()
    draws["pictures"](explorer.scene)
    [surface] = place.select(Surface3D)
    for right in (("line", 0.5, 6.0), ("tieline", 0.5, 6.0)):
        for value in NUMBERS:
            for sent in lists(value, *right):
                surface.hand = sent
    assert math.isfinite(explorer.scene.constants.K_J)


@pytest.mark.slow
def test_a_slider_of_the_builder_passes_over_what_it_never_sends(one_line):
    with set_curdoc(Document()):
        explorer = Explorer()
        workshop = Build(builder_of(explorer))
        knob = workshop.dimensions
        for i, value in enumerate(NUMBERS):
            before = workshop.builder.draft.shape.R
            for sent in lists(value, 1, "R", 20.0, False):
                knob.view.request = sent
                assert workshop.builder.draft.shape.R in (before, 0.020)
            knob.view.request = [99 + i, "R", 18.0 + i, False]
            assert workshop.builder.draft.shape.R == pytest.approx(0.018 + 0.001 * i)


@pytest.mark.slow
@pytest.mark.parametrize("value", VALUES, ids=range(len(VALUES)))
def test_what_has_no_word_in_a_link_goes_back_to_what_was(scheduler, value, one_line):
    url_state, playing = UrlState(), Playing()
    controls = Controls(scheduler._explorer.scene, scheduler.ask)
    top = Top3D()
    together(playing, top)
    url_state.add(playing)
    url_state.add(controls)
    for owner, name in ((top, "camera"), (top, "speed"), (controls, "face")):
        before = getattr(owner, name)
        for sent in (value, [value], [1.0, value, 2.0]):
            try:
                setattr(owner, name, sent)
            except ValueError:  # raised by the widget itself
                continue
            url_state.commit()
        good = [] if name == "camera" else before
        assert getattr(owner, name) in (good, [1.0, 1e308, 2.0], [1.0, -1, 2.0], 0, 1) or value in ((), 1)
    url_state.commit()
    assert all(part not in url_state.query for part in ("nan", "inf", "x" * 100))
    assert Numbers(3).text([1, 2, 3]) == "1_2_3"
