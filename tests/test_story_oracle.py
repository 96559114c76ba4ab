"""Two numbers that the page says of a contact with a patch, by a body on a table that yields: no formula is shared."""

import numpy as np
from stem_body import integrate

from app.model.explorer import Explorer
from app.model.lesson import lesson
from app.model.maps.maps import Map
from app.model.maps.steady import life
from tippe_core import PRESETS, Contensou, State

TOYS = {preset.name: preset for preset in PRESETS}


def tilts(name, seconds, spin=28.65, tilt=5.73, mu=0.3, patch=0.5e-3):
    """(t, s; tilt, degrees; load of the stem, Mg) of a toy that is let go on an ordinary table."""
    shape, top = TOYS[name].shape, TOYS[name].top
    start = State(np.radians(tilt), 0.0, 0.0, 2 * np.pi * spin * shape.scales.time)
    t = np.arange(0.0, seconds, 0.002)
    law = Contensou(mu, patch / shape.scales.R)
    moved = integrate(top, start, law, t / shape.scales.time, shape.edge)
    return t, np.degrees(moved.theta), moved.loads[:, 1]


def test_the_first_stand_below_a_map():
    """Its stem touches at 1.37 s, and it is above 170 degrees for 0.09 s; it stays there only from 1.67 s on."""
    t, tilt, on_stem = tilts("Leine and Glocker's toy", 3.0, 28.6, 5.7)
    edges = np.flatnonzero(np.diff((tilt > 170).astype(int))) + 1
    first, ends, then = t[edges]
    assert 1.4 < first < ends - 0.05 < 1.6 and abs(t[np.argmax(on_stem > 0)] - 1.374) < 0.005
    assert abs(life(Map(seconds=2.0).at(28.6, 5.7), None).stands - then) < 0.005


def test_how_far_the_papers_top_gets():
    """137.6 degrees at 2.29 s, while it hops; it does not stay beyond 120."""
    t, tilt, _ = tilts("The paper's tippe top", 5.9)
    answer = lesson.OF_NAME["yours"].answer(Explorer().scene)
    assert answer.truth == "not" and abs(answer.numbers["high"] - tilt.max()) < 0.05
    assert np.sum(tilt > 120) * (t[1] - t[0]) < 0.5
