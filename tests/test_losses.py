"""Contensou's law, rolling resistance and air drag in a motion, and the kernels without a compiler."""

import json
import os
import subprocess
import sys

import numpy as np
import pytest
from cases import LOADED, PAPER

from tippe_core import (
    Contensou,
    Coulomb,
    Scales,
    SmoothedCoulomb,
    State,
    Top,
    TopError,
    TruncatedSphere,
    Viscous,
    slide,
)

BALL = Top(0.0, 0.4, 0.4)
EDGE = TruncatedSphere.paper().edge
TOY, ROUND = Top(0.2, 0.5926, 0.5185), (0.0, 13 / 15, 1 / 3)  # Leine and Glocker's


def patch_moment(mu, radius, u, spin):
    """Over F_z: Coulomb's law at each point of a patch with Hertz's pressure, summed over rings and angles."""
    r = (np.arange(400) + 0.5)[:, None] / 400 * radius
    angle = (np.arange(720) + 0.5) / 720 * 2 * np.pi
    p = 3 / (2 * np.pi * radius**2) * np.sqrt(1 - (r / radius) ** 2) * r * (radius / 400) * (2 * np.pi / 720)
    x, y = r * np.cos(angle), r * np.sin(angle)
    vx, vy = u - spin * y, spin * x
    return -mu * np.sum(p * (x * vy - y * vx) / np.hypot(vx, vy))


def test_pivoting_takes_C_J_at_its_own_rate():
    """dC_J/dt = T (1 - a c), T summed over the patch."""
    friction, h = Contensou(0.3, 0.1), 1e-3
    times = np.array([0, *(t + d for t in (1.0, 5.0, 20.0) for d in (-h, 0, h))])
    moved = slide(PAPER, State(0.6, 0, 0, 6.0), friction, times, rtol=1e-12)
    for k in (2, 5, 8):
        s, c = np.sin(moved.theta[k]), np.cos(moved.theta[k])
        spin, u = moved.omega[k, 1] * s + moved.omega[k, 2] * c, np.hypot(*moved.slip[k])
        T = moved.force[k, 2] * patch_moment(0.3, 0.1, u, spin)
        rate = (moved.jellett[k + 1] - moved.jellett[k - 1]) / (2 * h)
        assert rate == pytest.approx(T * (1 - PAPER.a * c), rel=1e-3)
    np.testing.assert_allclose(sum(moved.ledger), moved.energy[0], rtol=0, atol=1e-9)


def test_a_patch_without_extent_is_coulombs_point():
    times, state = np.linspace(0, 30, 301), State(1.0, 0.3, 0.2, 6.0)
    point, patch = (slide(PAPER, state, law, times) for law in (Coulomb(0.4), Contensou(0.4, 0.0)))
    assert point.events == patch.events and point.events
    np.testing.assert_array_equal(point.theta, patch.theta)
    small = slide(PAPER, state, Contensou(0.4, 1e-5), times[:20], rtol=1e-10)
    np.testing.assert_allclose(small.theta, point.theta[:20], rtol=0, atol=1e-5)


def test_a_spinning_ball_is_stopped_by_its_patch():
    """On the spot |T| = (3 pi/16) mu F_z radius: its spin falls evenly, then it holds."""
    mu, radius, spin = 0.3, 0.05, 2.0
    rate = 3 * np.pi / 16 * mu * radius / 0.4
    moved = slide(BALL, State(0.0, 0, 0, spin), Contensou(mu, radius), np.linspace(0, 2 * spin / rate, 41))
    np.testing.assert_allclose(moved.omega[:, 2], np.maximum(spin - rate * moved.t, 0), rtol=0, atol=1e-6)
    ((t, what),) = moved.events
    assert what == "sticks" and t == pytest.approx(spin / rate, abs=1e-6) and moved.regime[-1] == "roll"


def test_a_patch_at_rest_rolls_without_pivoting():
    """Leine and Glocker's toy at last: neither slips nor spins about the vertical, and keeps its energy."""
    friction, scales = Contensou(0.3, 1 / 30), Scales(R=0.015, M=0.006)
    start = State(0.1, 0, 0, 180 / scales.angular_velocity)
    moved = slide(TOY, start, friction, np.linspace(0, 12 / scales.time, 1201), edge=ROUND)
    assert moved.events[-1][1] == "sticks"
    rolls = moved.regime == "roll"
    assert rolls.sum() > 100 and np.ptp(moved.energy[rolls]) < 1e-8
    spin = moved.omega[:, 1] * np.sin(moved.theta) + moved.omega[:, 2] * np.cos(moved.theta)
    assert np.abs(spin[rolls]).max() < 1e-7 and np.abs(moved.slip[rolls]).max() == 0
    F_h, F_z = np.hypot(*moved.force[rolls, :2].T), moved.force[rolls, 2]
    assert np.all(F_h < 0.3 * F_z)
    np.testing.assert_allclose(sum(moved.ledger), moved.energy[0], rtol=0, atol=1e-7)


@pytest.mark.parametrize(("rad_per_s", "passes", "stands", "leaves"), [
    (180, 0.98, 1.47, 4.50), (200, 1.07, 1.67, 6.46), (240, 1.32, 2.03, 9.81)])  # fmt: skip
def test_the_life_of_a_real_toy(rad_per_s, passes, stands, leaves):
    """When it passes 90 and 170 degrees and last falls below 170, as an own body on two compliant contacts has it."""
    scales = Scales(R=0.015, M=0.006)
    times = np.linspace(0, 16 / scales.time, 16_001)
    start = State(0.1, 0, 0, rad_per_s / scales.angular_velocity)
    moved = slide(TOY, start, Contensou(0.3, 1 / 30), times, edge=ROUND)
    seconds, tilt = moved.t * scales.time, np.degrees(moved.theta)
    assert seconds[np.argmax(tilt > 90)] == pytest.approx(passes, abs=0.011)
    assert seconds[np.argmax(tilt > 170)] == pytest.approx(stands, abs=0.011)
    assert seconds[np.flatnonzero(tilt > 170)[-1]] == pytest.approx(leaves, abs=0.02)  # it falls slowly at first
    assert tilt[-1] == pytest.approx(65, abs=3)


def test_air_drag_of_a_ball_that_spins_on_the_spot():
    """I3 w3' = -k w3"""
    moved = slide(BALL, State(0.0, 0, 0, 5.0), Viscous(0.3), np.linspace(0, 20, 21), air_drag=0.02)
    np.testing.assert_allclose(moved.omega[:, 2], 5 * np.exp(-0.02 / 0.4 * moved.t), rtol=1e-7)
    np.testing.assert_allclose(sum(moved.ledger), moved.energy[0], rtol=0, atol=1e-8)


def test_rolling_resistance_of_a_ball_that_rolls():
    """About the point of contact (I + 1) w' = -delta."""
    w, delta = 2.0, 1e-3
    start = State(np.pi / 2, w, 0, 0, vx=0.0, vy=-w)
    moved = slide(BALL, start, Coulomb(0.3), np.linspace(0, 100, 11), rolling_resistance=delta)
    assert moved.events == () and set(moved.regime) == {"roll"}
    speed = np.hypot(moved.velocity[:, 0], moved.velocity[:, 1])
    np.testing.assert_allclose(speed, w - delta / 1.4 * moved.t, rtol=0, atol=1e-6)
    np.testing.assert_allclose(sum(moved.ledger), moved.energy[0], rtol=0, atol=1e-8)


@pytest.mark.parametrize("friction", [Coulomb(0.3), SmoothedCoulomb(0.3, 0.1), Contensou(0.3, 1 / 30), Viscous(0.5)])
def test_the_books_balance_with_all_losses_and_a_stem(friction):
    how = {"edge": EDGE, "rolling_resistance": 1e-3, "air_drag": 1e-3}
    moved = slide(PAPER, State(0.5, 0, 0, 9.0), friction, np.linspace(0, 100, 501), **how)
    np.testing.assert_allclose(sum(moved.ledger), moved.energy[0], rtol=0, atol=1e-7)
    assert np.diff(moved.heat).min() > -1e-9
    free = slide(PAPER, State(0.5, 0, 0, 9.0), friction, moved.t, edge=EDGE)
    assert np.abs(free.theta - moved.theta).max() > 1e-3


@pytest.mark.parametrize("loss", ["rolling_resistance", "air_drag"])
def test_a_loss_is_not_negative(loss):
    for value in (-1e-3, np.nan):
        with pytest.raises(TopError) as caught:
            slide(PAPER, State(0.1, 0, 0, 5.0), Viscous(0.3), [0, 1.0], **{loss: value})
        assert caught.value.name == loss


@pytest.mark.parametrize("rad_per_s", [55, 68])
def test_rtol_is_what_it_says(rad_per_s):
    """C_J, which friction keeps, over 900 (R/g)^1/2 at rtol = 1e-9."""
    unit = Scales(R=0.02, M=0.02, g=9.82)
    state = State(0.1, 0, 0, rad_per_s / unit.angular_velocity)
    moved = slide(LOADED, state, Viscous(unit.velocity), np.linspace(0, 900, 901), rtol=1e-9)
    assert np.abs(moved.jellett / moved.jellett[0] - 1).max() < 1e-8


def test_a_minute_is_no_error():
    scales = Scales.paper()
    times = np.linspace(0, 60 / scales.time, 6001)
    start = State(np.radians(10), 0, 0, 2 * np.pi * 30 / scales.angular_velocity)
    moved = slide(PAPER, start, SmoothedCoulomb(0.3, 0.1), times, rtol=1e-8, edge=EDGE)
    assert moved.t[-1] == times[-1] or moved.events[-1][1] == "stands upright"
    np.testing.assert_allclose(sum(moved.ledger), moved.energy[0], rtol=0, atol=1e-6)


RUNS = """
import json
import numpy as np
from tippe_core import *
paper, edge, out = Top.paper(), TruncatedSphere.paper().edge, []
for state, friction in ((State(0.1, 0, 0, 8.8), SmoothedCoulomb(0.3, 1.0)), (State(0.8, 0, 0, 4.0), Coulomb(0.5)),
                        (State(1.9, 0.5, 0, -3.0), Viscous(0.3)), (State(0.8, 9.0, 0, 3.0), Contensou(0.3, 0.05))):
    moved = slide(paper, state, friction, [0, 0.2, 0.4], rtol=1e-7, edge=edge)
    out.append([moved.quaternion.tolist(), moved.heat.tolist(), [t for t, _ in moved.events]])
print(json.dumps(out))
"""


def test_without_a_compiler_the_numbers_are_the_same():
    found = []
    for off in ("1", "0"):
        done = subprocess.run([sys.executable, "-c", RUNS], env=os.environ | {"NUMBA_DISABLE_JIT": off}, check=True,
                              capture_output=True, text=True)  # fmt: skip
        found.append(json.loads(done.stdout))
    for plain, fast in zip(*found, strict=True):
        for one, other in zip(plain, fast, strict=True):
            np.testing.assert_allclose(one, other, rtol=0, atol=1e-9)
