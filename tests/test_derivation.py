"""Both sides of every equation of the paper, computed in different ways, for ten random motions of ten random tops."""

from dataclasses import replace

import numpy as np
import pytest

from app.model import stretches
from app.model.explorer import Explorer
from app.model.roll import derivation
from app.text import listed
from tippe_core import Gliding, State, Top

NUMBERS = [f"({i})" for i in range(1, 40)] + ["(B1)", "(B2)", "(B3)", "(B4)"]

MOTIONLESS = ("(27)", "(28)", "(29)", "(32)", "(34)", "(35)")  # limits and geometry


@pytest.fixture(scope="module", params=range(10))
def motion(request):
    """A scene and its windows on both planes: a random top and a random state."""
    rng = np.random.default_rng(1000 + request.param)
    I1 = rng.uniform(0.2, 1.5)
    top = {"a": rng.uniform(-1.5, 0.6), "I1": I1, "I3": I1 * rng.uniform(0.3, 1.9)}
    state = {"theta": rng.uniform(0.3, 2.7), "theta_dot": rng.normal(), "omega2": 2 * rng.normal(),
             "omega3": 5 * rng.normal(), "phi": rng.uniform(-3, 3), "psi": rng.uniform(-3, 3)}  # fmt: skip
    explorer = Explorer(**top)
    explorer.set(given="state", **state)
    assert not explorer.scene.messages and explorer.scene.state.theta == state["theta"]
    return {"rough": stretches.rolled(explorer.scene), "smooth": stretches.glided(explorer.scene)}


def test_every_equation_is_there_with_its_words():
    assert [line.number for line in derivation.LINES] == NUMBERS
    for line in derivation.LINES:
        assert listed("derivation.lines")[line.key]
        assert set(line.symbols.split()) <= set(derivation.SYMBOLS)
    assert set(listed("derivation.symbols")) == set(derivation.SYMBOLS)


@pytest.mark.slow
def test_both_sides_agree(motion):
    for line in derivation.LINES:
        t, left, right = derivation.both_sides(line, motion[line.plane])
        assert np.isfinite(left).all() and len(t) >= 30, line.number
        assert derivation.difference(left, right).max() < 1e-9, line.number
        assert np.abs(left - right).max() < 1e-9, line.number


def test_a_wrong_motion_is_seen(motion):
    """The sides are not one number twice: of a motion whose velocity, spin, force or place is off they differ."""
    wrong = {plane: [*off(windows[0])] for plane, windows in motion.items()}
    for line in derivation.LINES:
        if line.number not in MOTIONLESS:
            sides = (derivation.both_sides(line, [window])[1:] for window in wrong[line.plane])
            assert max(np.nanmax(derivation.difference(left, right)) for left, right in sides) > 1e-6, line.number


def off(window):
    """The window, with one of what its motion says off by a thousandth, in turn."""
    for name in ("omega", "force", "velocity", "com", "quaternion"):
        bad = getattr(window.motion, name) * (1 + 1e-3 * np.sin(3 * window.t))[:, None]
        yield stretches.Window(window.top, replace(window.motion, **{name: bad}), window.constants, window.state)


def test_the_signs_of_22_as_printed_hold_on_no_motion(motion):
    """The page prints (22) with the signs of its two terms in theta_dot exchanged; here they are as (21) gives them."""
    [m, *_] = motion["rough"]
    inner = slice(stretches.EDGE, -stretches.EDGE)
    left = (m.I3 * m.w3 * m.d(m.w3))[inner]
    printed = (derivation.falling(m) - ((m.I3 / m.I1 - 1) * m.r3 - m.a) * derivation.tipping(m))[inner]
    assert np.abs(left - printed).max() > 1e-3 * np.abs(left).max()


def test_the_smooth_plane_next_to_an_unstable_precession():
    """Where the nodes of the nutation are crowded: this start once raised a TypeError."""
    top = Top(a=-0.36, I1=1.32, I3=0.63)
    for spin in (1.5, 1.9, 2.3):
        gliding = Gliding(top, State(0.02, 0.0, 0.01, spin))
        motion = gliding(np.linspace(0, gliding.period, 40))
        assert np.ptp(motion.energy) < 1e-12 * (1 + motion.energy[0])
