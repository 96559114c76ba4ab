"""docs/extending.md: each of its differences is small, and all of them together work in a copy of the package."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
DIFFS = re.findall(r"```diff\n(.*?)```", (ROOT / "docs" / "extending.md").read_text(encoding="utf-8"), re.DOTALL)
EXTENDED = """
import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq
from sliding_body import integrate, matrix
from tippe_core import (ConedSphere, Coulomb, SmoothedCoulomb, State, Stribeck, Top, grip, load_top, roll, save_top,
                        slide)

paper, start = Top.paper(), State(0.3, 0.0, 0.0, 9.0)

# the law, against Newton and Euler in space by scipy
times, law = np.linspace(0, 1.1, 45), Stribeck(0.2, 0.4, 0.3)
slow = State(0.3, 0.0, 0.0, 3.0)
moved = slide(paper, slow, law, times, rtol=1e-11)
assert (moved.regime == "slip").all() and np.hypot(*moved.slip.T).min() < 0.1 < 0.6 < np.hypot(*moved.slip.T).max()
q = moved.quaternion[0]
other = integrate(paper, lambda u: (0.2 + 0.2 * np.exp(-(u @ u) / 0.09)) * u / np.linalg.norm(u), q,
                  3.0 * matrix(q)[:, 2], np.zeros(3), moved.com[0], times, rtol=1e-11)
axes = np.array([matrix(q)[:, 2] for q in other.quaternion])
np.testing.assert_allclose(np.cos(moved.theta), axes[:, 2], rtol=0, atol=1e-8)
np.testing.assert_allclose(moved.heat, -other.work, rtol=0, atol=1e-8)
assert slide(paper, slow, law, [0, 1.5]).events[0][1] == "sticks"

# the note, against the samples, where it slips and where it rolls
times = np.linspace(0, 30, 30001)
for law, state in ((Coulomb(0.3), start), (Coulomb(5.0), State(1.0, 0.0, 0.2, 6.0))):
    moved = slide(paper, state, law, times)
    turns = np.array([t for t, name in moved.notes if name == "theta turns"])
    found = times[:-1][np.diff(np.sign(moved.omega[:, 0])) != 0]
    assert len(found) > 3
    near = np.abs(turns[:, None] - found).min(axis=0)
    assert near[found > 0.01].max() < 2e-3 and abs(len(turns) - len(found)) <= 1

# the end, where it slips, and against the exact motion where it rolls
turns_over = paper, State(0.1, 0.0, 0.0, 8.8), SmoothedCoulomb(0.3, 1.0)
moved = slide(*turns_over, np.linspace(0, 300, 3001))
when, name = moved.events[-1]
assert name == "leans too far" and moved.t[-1] < when < moved.t[-1] + 0.1 + 1e-9 and moved.theta.max() < 2.0
assert abs(slide(*turns_over, [0, when - 1e-7]).theta[-1] - 2.0) < 1e-6
state, _ = grip(paper, State(1.8, 0.5, 0.0, 0.3))  # it rolls from the start
moved = slide(paper, state, Coulomb(5.0), np.linspace(0, 10, 1001))
tilt = lambda t: roll(paper, None, [0, t], state).theta[1] - 2.0
assert moved.events[-1][1] == "leans too far" and abs(moved.events[-1][0] - brentq(tilt, 0, moved.t[-1] + 0.02)) < 1e-8

# the shape, against integrals over its slices
body = ConedSphere(R=0.02, c=0.012, l=0.03, M=0.03)
def radius(z):
    return np.sqrt(body.R**2 - z * z) if z < body.c else 0.016 * (body.c + body.l - z) / body.l
volume, first = (quad(lambda z: np.pi * radius(z) ** 2 * z**n, -body.R, body.c + body.l, points=[body.c], limit=200)[0]
                 for n in (0, 1))
np.testing.assert_allclose([body.density * volume, body.com], [body.M, first / volume], rtol=1e-9)
assert load_top(save_top(body)) == body and body.top.I3 < body.top.I1
"""


@pytest.mark.parametrize("diff", DIFFS)
def test_a_change_is_small(diff):
    changed = [line for line in diff.splitlines() if re.match(r"[+-](?![+-]{2} )", line)]
    assert 0 < len(changed) <= 60 and 0 < diff.count("\n+++ ") <= 3


@pytest.fixture
def extended(tmp_path):
    """A copy of the package with all of them."""
    shutil.copytree(ROOT / "tippe_core", tmp_path / "tippe_core", ignore=shutil.ignore_patterns("__pycache__"))
    alone = os.environ | {"GIT_CEILING_DIRECTORIES": str(tmp_path.parent)}  # not as a part of a repository around it
    for diff in DIFFS:
        subprocess.run(["git", "apply", "-"], input=diff, text=True, cwd=tmp_path, check=True, env=alone)
    return tmp_path


def test_all_of_them_apply_to_the_package_as_it_is(extended):
    assert "FARTHEST = 2.0" in (extended / "tippe_core/motion/contacts.py").read_text(encoding="utf-8")


@pytest.mark.long
def test_all_of_them_work_in_a_copy(extended):
    path = os.pathsep.join([str(extended), str(ROOT / "tests")])
    subprocess.run([sys.executable, "-c", EXTENDED], cwd=extended, env=os.environ | {"PYTHONPATH": path}, check=True)
