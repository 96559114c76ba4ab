"""What the portraits show, compared with the integrated motion and the geometry of a ring."""

import numpy as np
import pytest

from app.model.explorer import Explorer
from app.model.roll.portraits import pushes, square, track
from app.state.validate import InvalidMessage
from app.widgets import choices
from app.widgets.portraits import Curve, Force, Phase, Potential, Ring, Track
from tippe_core.paper.curve import f


@pytest.fixture(params=[2.0, 7.0], ids="K_J={}".format)
def scene(request):
    explorer = Explorer()
    explorer.set(K_J=request.param)
    return explorer.scene


def test_a_track_that_is_unrolled_is_as_long_as_it_was(scene):
    seen = track(scene)
    middle, inner = np.mean(scene.rosette[2:]), scene.rosette[2]
    along = np.diff(seen.along) * (inner + (seen.across[1:] + seen.across[:-1]) / 2) / middle
    steps = np.hypot(*np.diff(scene.trajectory.contact, axis=0).T)
    assert np.hypot(along, np.diff(seen.across)) == pytest.approx(steps, rel=1e-3, abs=1e-6)
    assert seen.across.min() == pytest.approx(0, abs=1e-3) and seen.across.max() == pytest.approx(seen.width, abs=1e-3)


def test_the_rings_are_touched_and_not_crossed(scene):
    seen = track(scene, 480)
    assert len(seen.t) <= 2 * 480 and [len(x) for x in (seen.x, seen.y)] == [len(seen.t)] * 2
    x, y, *_ = scene.rosette
    away = np.hypot(seen.x - x, seen.y - y)
    for ring, touched in zip(seen.rings, (away.min(), away.max()), strict=True):
        assert np.hypot(ring[0] - x, ring[1] - y) == pytest.approx(touched, abs=1e-3)


def test_the_push_and_the_square_are_those_of_the_motion(scene):
    """The same nutation in half as many frames, of which the scene says F_h/F_z; and (36)."""
    frames = round(len(scene.trajectory.t) * scene.rolling.period / scene.trajectory.t[-1])
    x, y = pushes(scene)
    assert np.hypot(x, y)[::2][:frames] == pytest.approx(scene.ratio[:frames], rel=1e-9)
    assert square(scene) == pytest.approx(f(scene.nutation.theta, scene.top, scene.constants), abs=1e-9)


# ---- the head's choices need no page ----


@pytest.mark.parametrize("kind", [Curve, Phase, Potential, Track, Ring, Force])
def test_no_colour_is_a_column_of_data_which_the_dark_look_would_not_exchange(kind):
    drawn = kind().figure.renderers
    columns = {name for each in drawn for name in each.data_source.data}
    glyphs = [each.glyph for each in drawn]
    colours = {str(getattr(glyph, name)) for glyph in glyphs for name in glyph.properties() if name.endswith("_color")}
    assert colours and columns.isdisjoint(colours)


def test_a_choice_calls_what_it_was_given_and_nothing_unknown():
    told = []
    does = choices.asks(toy=told.append, language=told.append, share=lambda: told.append("share"))
    for name, value in (("toy", "Top S"), ("language", "de"), ("share", None)):
        does[name](value)
        if value:
            with pytest.raises(InvalidMessage):
                does[name]("a yo-yo")
    assert told == ["Top S", "de", "share"]


def test_tops_are_told_by_their_names():
    chosen, known = choices.tops("Top S")
    assert chosen == "Top S" and "Top S" in dict(known) and "" not in dict(known)
    own, known = choices.tops("of somebody's own")
    assert own == "" == known[0][0] and "Top S" in dict(known)
