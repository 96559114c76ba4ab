"""Contensou's law where the patch hardly slips and hardly spins: implicit steps, and both contacts at rest.

tests/data/creeping.json holds what explicit steps alone gave, without a limit to their number: for the paper's top from
12 s on 33 s of the processor for 2 s of its motion.
"""

import json
from pathlib import Path

import numpy as np
import pytest
import sliding_body as sb
from scipy.integrate import solve_ivp

from tippe_core import PRESETS, Contensou, LoadedSphere, State, Top, grip, slide, slide_many
from tippe_core.motion import at, contacts, events, implicit, preparing, run
from tippe_core.motion.dynamics import arrange, rates
from tippe_core.motion.records import LOG, NO_ONE, OPEN, SAMPLE, SLIP, STICK, modes_of
from tippe_core.motion.stepper import at_share
from tippe_core.motion.summary import begin

KNOWN = json.loads((Path(__file__).parent / "data/creeping.json").read_text(encoding="utf-8"))
FREE = Top(a=-2.893199979896467, I1=5.029282603270844, I3=6.547745891340401)  # the preset Free profile
STEPS = 32  # of slide() between two calls of progress


def motion_of(known):
    """The records of a motion that is known, at its start."""
    state = State(**known["state"])
    P = preparing.problem(Top(*known["top"]), Contensou(known["mu"], known["radius"]),
                          preparing.checked_edge(known["edge"]), (0.0, 0.0), 1e-9)  # fmt: skip
    W = preparing.motion(*preparing.beginning(state, 0.0, P))
    preparing.start(W, P, state)
    return W, P


def one_by_one(W, P, until):
    """Yields the event, if any, with which each step of a motion ends, and does what follows from it."""
    log, none, rows = np.zeros(20_000, LOG), np.zeros(0), np.zeros(0, SAMPLE)
    begin(W, P, log, np.inf)
    while W.y[at.TIME] < until:
        event = run.follow(W, P, log, none, rows, until, W.steps + 1)
        yield event[0]
        if event[0] not in (run.MORE, run.OVER):
            assert not events.happens(W, P, log, event, True)


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


@pytest.mark.parametrize("begins", [2.0, 30.0])
def test_an_implicit_step_that_is_taken_is_of_its_order(begins):
    """Against scipy's DOP853, in the next step of a motion that creeps, some hundred times as long as its slip takes to
    relax. Its error, the estimate of that and the error of its polynomial are less than 2^-4 of those of a step twice
    as long, and less than is allowed."""
    W, P = motion_of(KNOWN[0])
    for _ in one_by_one(W, P, begins):
        pass
    S, modes, out, errors, y = W.step, modes_of(W), np.zeros(16), [], W.y.copy()
    assert W.stiff and W.implicit and W.creeps == 0 and modes == (SLIP, OPEN)

    def rate(_, z):
        rates(z, NO_ONE, modes, P, W.contacts, out)
        return out / out[at.TIME]

    for h in (2 * W.h, W.h):
        S.new[:], S.z[:] = y, y
        rate(0, y)
        assert implicit.is_stiff(W, P, h)
        run.scales(W, P, NO_ONE)
        implicit.differentiate(W, P)
        estimate, _ = implicit.implicit_step(W, P, h)
        shares = np.array([0.3, 0.7, 1.0])
        exact = solve_ivp(rate, (0, h), y, "DOP853", h * shares, rtol=1e-13, atol=1e-16).y.T
        found = np.zeros((3, 16))
        for x, each in zip(shares[:2], found, strict=False):
            at_share(W, P, x, each)
        found[2] = S.new
        off = np.abs(found - exact).max(axis=1)
        errors.append([estimate, off[:2].max(), off[2]])
    assert (np.array(errors[1]) < [1.0, implicit.TOLERANCE, implicit.TOLERANCE]).all()
    assert (np.divide(*errors) > 2**4).all()


def test_the_slip_at_most_halves_in_an_implicit_step():
    """Leine and Glocker's toy, whose slip vanishes at 0.9874: its last implicit steps end where it is half as large,
    and none goes further."""
    W, P = motion_of(KNOWN[4])
    left, before = [], None
    for _ in one_by_one(W, P, 0.9873):
        axis = sb.matrix(W.y[:4])[:, 2]
        w = omega(W.y, P, axis)
        v = W.y[[at.VX, at.VY, at.VZ]]
        now = np.hypot(np.hypot(*(v + np.cross(w, P.a * axis - sb.UP))[:2]), P.law.radius * w[2])
        if W.implicit:
            left.append(now / before)
        before = now
    assert len(left) > 20 and 0.495 < min(left) < 0.505


def omega(y, P, axis):
    inertia = P.I1 * np.eye(3) + (P.I3 - P.I1) * np.outer(axis, axis)
    return np.linalg.solve(inertia, y[[at.LX, at.LY, at.LZ]])


def off_the_table(y, P, known):
    """Height and rising of ball and stem, from the body in space."""
    axis = sb.matrix(y[:4])[:, 2]
    arms = [contact(axis) for contact in (sb.sphere(P), sb.edge(P, *known["edge"][:2]))]
    turns = [np.cross(omega(y, P, axis), arm)[2] for arm in arms]
    return np.array([y[at.Z] + arm[2] for arm in arms]), y[at.VZ] + np.array(turns)


def both_closed(W):
    return OPEN not in modes_of(W)


@pytest.mark.parametrize("known", KNOWN[6:], ids=lambda known: known["name"])
def test_two_closed_contacts_stay_on_the_table(known):
    """Over a life in which a patch creeps, slips and comes to rest: never so far from the table, and never rising or
    sinking so fast, as a single step may err."""
    W, P = motion_of(known)
    worst = {}
    for _ in one_by_one(W, P, known["t"][-1]):
        if both_closed(W):
            off = np.abs(off_the_table(W.y, P, known)).max()
            worst[modes_of(W)] = max(worst.get(modes_of(W), 0.0), off)
    assert {(SLIP, SLIP), (STICK, STICK)} <= set(worst) and max(worst.values()) < 1e-9


@pytest.mark.parametrize(("modes", "creeps"), [((SLIP, SLIP), 0), ((SLIP, SLIP), 1), ((STICK, STICK), 0)])
def test_a_closed_contact_that_has_drifted_comes_back_to_the_table(modes, creeps):
    """As something critically damped at a rate of 1; the ball stays on the table."""
    known = KNOWN[6]
    W, P = motion_of(known)
    next(_ for _ in one_by_one(W, P, known["t"][-1]) if modes_of(W) == modes and W.stiff == creeps)
    y, begins, implicit_steps = W.y, W.y[at.TIME], 0
    y[at.PX] += 1e-6
    y[:4] /= np.linalg.norm(y[:4])
    arrange(y, NO_ONE, modes, P, W.contacts)
    contacts.known(y, W.contacts)
    W.rated = 0
    height, rises = (each[1] for each in off_the_table(y, P, known))
    assert min(abs(height), abs(rises)) > 1e-6
    for event in one_by_one(W, P, begins + 2.0):
        if event not in (run.MORE, run.OVER):
            break
        t, grows = y[at.TIME] - begins, height + rises
        heights, speeds = off_the_table(y, P, known)
        np.testing.assert_allclose(heights, [0.0, (height + grows * t) * np.exp(-t)], rtol=0, atol=1e-9)
        np.testing.assert_allclose(speeds, [0.0, (rises - grows * t) * np.exp(-t)], rtol=0, atol=1e-9)
        implicit_steps += W.implicit
    assert implicit_steps > 5 if creeps else t == 2.0


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
        rocks, leans, spins = moved.omega[-200:].T
        assert 2.5 < np.abs(rocks).max() < 3.5 and np.abs(spins).max() < 1e-4
        assert np.abs(leans * np.sin(moved.theta[-200:])).max() < 1e-4  # itself it is as 1/sin(theta) near the vertical
    assert np.abs(runs[0].heat - runs[1].heat).max() < 1e-4


# ---- a patch whose slip and spin go through 0 ----


def starts_that_roll(count, seed):
    """(top, state, radius of the patch): what is left of hands' starts once the table has gripped them."""
    rng = np.random.default_rng(seed)
    for i in range(count):
        top = (Top(-0.5, 1.2, 0.6), Top.paper(), Top(0.2, 0.8, 0.7))[i % 3]
        state = State(rng.uniform(0.2, 2.9), *(rng.normal(size=3) * [0.3, 0.5, 0.6]))
        yield top, grip(top, state)[0], np.exp(rng.uniform(np.log(1e-5), np.log(1e-2)))


def test_no_energy_comes_from_a_patch_that_starts_to_slide():
    """Friction turns energy into heat; the least slip that it starts with is too little to count."""
    for top, state, radius in starts_that_roll(120, 3):
        moved = slide(top, state, Contensou(0.3, radius), np.linspace(0, 12, 241))
        assert np.diff(moved.heat).min() > -1e-6
        assert np.abs(moved.energy + moved.heat - moved.energy[0]).max() < 2e-6


@pytest.mark.parametrize("radius", [1.33e-4, 1e-5, 9e-6, 1e-8])
def test_a_tiny_patch_starts_to_slide_without_a_kick(radius):
    """The torque that held it is far above what it can bear: the change was too large by that, and gained 0.05."""
    state = State(1.8181672215169036, 0.02842366786242766, 0.14424413069158581, 0.33887182446751596,
                  vx=-0.29175334181585766, vy=-0.02494381882837499)  # fmt: skip
    moved = slide(Top(-0.5, 1.2, 0.6), state, Contensou(0.3, radius), np.linspace(0, 1.7, 171))
    assert ("slips" in {event for _, event in moved.events}) == (radius >= 1e-5)  # a point rolls on
    assert np.diff(moved.heat).min() > -1e-6


def test_a_patch_that_slides_on_through_rest_stays_on_the_table():
    """F_z is 1.3 there. Beyond the end of the step its height was that of a straight line, 1e-7 off."""
    state = State(2.7388187260398933, 1.106104142770902, -0.5322954775860238, -0.2835137865282,
                  vx=0.3346813905338781, vy=-0.5973088281616645)  # fmt: skip
    moved = slide(Top(-0.5, 1.2, 0.6), state, Contensou(0.3, 1.79e-5), [0, 0.915, 0.91577])
    assert [event for _, event in moved.events] == ["slips"]


@pytest.mark.parametrize("rtol", [1e-5, 1e-6, 3e-7, 1e-7, 1e-8])
@pytest.mark.parametrize(("theta", "omega3", "radius"), [
    (1.0768681484805014, 9.388734976844733, 0.03125), (1.7466725795386315, 3.367891739505597, 0.008),
])  # fmt: skip
def test_a_slip_below_the_tolerance_is_followed_all_the_same(theta, omega3, radius, rtol):
    """Explicit steps may change v by more than all of the slip: they and implicit ones took turns for ever."""
    found = slide_many(Top.paper(), State(theta, 0, 0, omega3), Contensou(0.3, radius), 1486.0, rtol=rtol)
    exact = slide_many(Top.paper(), State(theta, 0, 0, omega3), Contensou(0.3, radius), 1486.0, rtol=1e-9)
    assert found.end == "moving" and found.heat == pytest.approx(exact.heat, rel=1e-5)
