"""Two numbers that the page says of a contact with a patch, by a body on a table that yields: no formula is shared."""

import numpy as np
from references import kept
from stem_body import integrate

from app.model.explorer import Explorer
from app.model.keeps import while_it_turns
from app.model.lesson import lesson
from app.model.maps.maps import Map
from app.model.maps.steady import life
from app.model.run import SHIPS, whole_on
from tippe_core import PRESETS, Contensou, State

TOYS = {preset.name: preset for preset in PRESETS}


@kept
def yielded(top, start, law, times, edge):
    """The tilt, the turn (1, 2, 3) and the load of the stem, Mg, of a top on a table that yields."""
    moved = integrate(top, start, law, times, edge)
    return moved.theta, moved.omega, moved.loads[:, 1]


def yielding(name, seconds, spin=28.65, tilt=5.73, mu=0.3, patch=0.5e-3):
    """(t, s; what yielded() says) of a toy that is let go on an ordinary table."""
    shape, top = TOYS[name].shape, TOYS[name].top
    start = State(np.radians(tilt), 0.0, 0.0, 2 * np.pi * spin * shape.scales.time)
    t = np.arange(0.0, seconds, 0.002)
    return t, *yielded(top, start, Contensou(mu, patch / shape.scales.R), t / shape.scales.time, shape.edge)


def test_the_first_stand_below_a_map():
    """Its stem touches at 1.37 s, and it is above 170 degrees for 0.09 s; it stays there only from 1.67 s on."""
    t, theta, _, on_stem = yielding("Leine and Glocker's toy", 3.0, 28.6, 5.7)
    tilt = np.degrees(theta)
    edges = np.flatnonzero(np.diff((tilt > 170).astype(int))) + 1
    first, ends, then = t[edges]
    assert 1.4 < first < ends - 0.05 < 1.6 and abs(t[np.argmax(on_stem > 0)] - 1.374) < 0.005
    assert abs(life(Map(seconds=2.0).at(28.6, 5.7), None).stands - then) < 0.005


def test_how_far_the_papers_top_gets():
    """137.6 degrees at 2.29 s, while it hops; it does not stay beyond 120."""
    t, theta, *_ = yielding("The paper's tippe top", 5.9)
    tilt = np.degrees(theta)
    answer = lesson.OF_NAME["yours"].answer(Explorer().scene)
    assert answer.truth == "not" and abs(answer.numbers["high"] - tilt.max()) < 0.05
    assert np.sum(tilt > 120) * (t[1] - t[0]) < 0.5


def test_jelletts_constant_of_the_arrival_until_its_stem_touches():
    """4.818 at 1.371 s; 3 ms later the touch has made it 4.79."""
    t, theta, omega, on_stem = yielding("Leine and Glocker's toy", 1.4)
    before, top = int(np.argmax(on_stem > 0)) - 1, TOYS["Leine and Glocker's toy"].top
    c, s, (_, w2, w3) = np.cos(theta[before]), np.sin(theta[before]), omega[before]
    until, _, last = while_it_turns(whole_on(*SHIPS))
    assert abs(until - t[before]) < 0.005 and abs(last - (s * w2 + top.I3 / top.I1 * (c - top.a) * w3)) < 0.002
