"""Contensou's law where the patch hardly slips and hardly spins: implicit steps, and both contacts at rest.

tests/data/creeping.json holds what explicit steps alone gave, without a limit to their number: for the paper's top from
12 s on 33 s of the processor for 2 s of its motion.
"""

import json
from pathlib import Path

import numpy as np
import pytest

from tippe_core import PRESETS, Contensou, LoadedSphere, State, Top, slide

KNOWN = json.loads((Path(__file__).parent / "data/creeping.json").read_text(encoding="utf-8"))
FREE = Top(a=-2.893199979896467, I1=5.029282603270844, I3=6.547745891340401)  # the preset Free profile
STEPS = 32  # of slide() between two calls of progress


def steps(top, state, friction, times, edge):
    """The Trajectory, and about how many steps it took."""
    calls = []
    return slide(top, state, friction, times, edge=edge, progress=calls.append), STEPS * len(calls)


@pytest.mark.parametrize("known", KNOWN, ids=lambda known: known["name"])
def test_it_creeps_as_with_explicit_steps(known):
    moved, took = steps(Top(*known["top"]), State(**known["state"]), Contensou(known["mu"], known["radius"]),
                        known["t"], known["edge"])  # fmt: skip
    theta, heat, C_J = (np.array(known[name]) for name in ("theta", "heat", "C_J"))
    assert np.degrees(np.abs(moved.theta - theta)).max() < 0.1
    assert np.abs(moved.heat - heat).max() < 1e-3 * heat[-1]
    assert np.abs(moved.jellett - C_J).max() < 1e-3 * np.abs(C_J).max()
    assert took < 20_000  # millions before


def test_a_long_life_costs_few_steps():
    """60 s of the paper's top, most of which it creeps. (It did not end: more than four million.)"""
    known = KNOWN[0]
    moved, took = steps(Top.paper(), State(**known["state"]), Contensou(known["mu"], known["radius"]),
                        np.linspace(0, 1450, 3001), known["edge"])  # fmt: skip
    assert len(moved) == 3001 and took < 400_000


def test_where_g_is_high_above_the_contact_its_slip_relaxes_faster():
    """The preset Free profile on its stem. (Its implicit steps began too late: more than three million, of which the
    stable steps were a few per mille.)"""
    lies = State(1.9030309754187849, 0.040229798771672716, 0.0, 2.076727624827055)
    moved, took = steps(FREE, lies, Contensou(0.48094829622583657, 0.01), np.linspace(0, 300, 301), (3.6, 2.0, 0.0))
    assert len(moved) == 301 and took < 50_000


def test_a_top_that_rolls_on_ball_and_stem_shares_the_friction():
    """The preset Free profile comes to roll on its side, in a circle. The friction along the line between its contacts
    that the ball cannot hold the stem holds. (The ball slipped and stuck by turns, and the run did not end.)"""
    lies = State(0.752371816073774, 0.0, -0.06918797343306982, 0.5902207942999111, vx=-0.69, vy=-0.02)
    moved, took = steps(FREE, lies, Contensou(0.3, 0.1), np.linspace(0, 100, 201), (3.6, 2.0, 0.0))
    assert len(moved) == 201 and took < 20_000
    assert len(moved.events) < 100 and moved.supports[-1][1] == "both" and set(moved.regime[-100:]) == {"roll"}
    for kept in (moved.theta, np.hypot(*moved.velocity[:, :2].T), moved.heat):
        assert np.ptp(kept[-100:]) < 1e-9


@pytest.mark.parametrize(("name", "spin", "tilt", "mu"), [
    ("Free profile", 30, 20, 0.3), ("Wooden cone", 30, 30, 0.3), ("Disc on a peg", 6, 21, 0.4)])  # fmt: skip
def test_a_patch_that_halts_beside_a_closed_contact_leaves_that_closed(name, spin, tilt, mu):
    """(An impulse at the one alone opened the other by some 1e-8, and they closed and opened by turns: "too many
    events".)"""
    body = next(preset.shape for preset in PRESETS if preset.name == name)
    time = body.scales.time
    start = State(np.radians(tilt), 0.0, 0.0, 2 * np.pi * spin * time)
    moved = slide(body.top, start, Contensou(mu, 5e-4 / body.R), np.linspace(0, 60 / time, 601), edge=body.edge)
    assert len(moved) == 601 and moved.events[-1][1] == "sticks" and moved.supports[-1][1] == "both"
    assert set(moved.regime[-100:]) == {"roll"} and np.ptp(moved.energy[-100:]) < 1e-6


@pytest.mark.parametrize(("name", "spin", "tilt", "mu"), [
    ("Free profile", 5, 56.4, 0.34), ("Wooden cone", 3.21, 18.9, 0.59), ("Disc on a peg", 16.81, 67.3, 0.283),
])  # fmt: skip
def test_two_patches_come_to_rest_together(name, spin, tilt, mu):
    """(Each that halted moved the other, which slipped, halted and moved the first: "too many events".)"""
    body = next(preset.shape for preset in PRESETS if preset.name == name)
    time = body.scales.time
    start = State(np.radians(tilt), 0.0, 0.0, 2 * np.pi * spin * time)
    moved = slide(
        body.top, start, Contensou(mu, 5e-4 / body.R), np.linspace(0, 1 / time, 501), edge=body.edge, rtol=1e-6
    )
    assert len(moved) == 501 and len(moved.events) < 50 and moved.supports[-1][1] == "both"
    assert np.abs(moved.energy + moved.heat - moved.energy[0]).max() < 1e-4
    assert np.abs(moved.slip[-50:]).max() < 1e-9 and np.ptp(moved.heat[-50:]) < 1e-6


@pytest.mark.slow
def test_a_patch_that_hardly_slips_does_not_halt_long_after_the_end():
    """A sphere with a heavy core that rocks in a plane, at last without any spin: it slips and sticks by turns. (Where
    a slip had only just begun it lost one unit in the last place, and was taken to halt when it would have vanished at
    that rate: "rim touches" at 21,892 s, of a sphere that has no rim, and hundreds of slips where there is one.)"""
    body = LoadedSphere(R=0.02, b=0.008, d=0.01, density=1190, core_density=7850)
    unit = (body.scales.R / body.scales.g) ** 0.5
    start = State(np.radians(92.88), 0.0, 0.0, 46.646 * 2 * np.pi * unit)
    runs = [slide(body.top, start, Contensou(0.32, 0.0005 / body.R), np.linspace(0, 50 / unit, 2001), rtol=rtol)
            for rtol in (1e-9, 1e-10)]  # fmt: skip
    for moved in runs:
        assert len(moved) == 2001 and {name for _, name in moved.events} == {"sticks", "slips"}
        assert len(moved.events) < 1500 and all(0 < t <= moved.t[-1] for t, _ in moved.events)
        assert np.abs(moved.energy + moved.heat - moved.energy[0]).max() < 1e-4
        assert 2.5 < np.abs(moved.omega[-200:, 0]).max() < 3.5 and np.abs(moved.omega[-200:, 1:]).max() < 1e-2
    assert np.abs(runs[0].heat - runs[1].heat).max() < 1e-4
