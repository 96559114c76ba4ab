"""Compiling ahead of time: one small call of every public function that uses kernels, so that exactly the kernels that
are called get compiled.

A new public function, or a new type of argument that reaches a kernel, needs an entry in CALLS.
"""

import time
from collections.abc import Callable

import numpy as np

import tippe_core as core

from . import kept
from .compiled import not_kept

TOP = core.Top.paper()
MOTION = core.Constants(K_J=7.0, K_R=10.0, E=27.0)
THETA = np.linspace(0.5, 2.5, 4)
TIMES = np.linspace(0.0, 1.0, 4)
START = core.State(theta=0.1, theta_dot=0.0, omega2=0.0, omega3=9.0)
K_J = np.linspace(0.0, 8.0, 4)
LAWS = (core.Coulomb(0.3, 0.35), core.SmoothedCoulomb(0.3, 0.1), core.Viscous(0.3), core.Contensou(0.3, 0.01))


def curve() -> None:
    """On floats, and on arrays of one and of two dimensions."""
    surface = core.Constants(K_J[:, None], MOTION.K_R, MOTION.E)
    for theta, constants in ((1.0, MOTION), (THETA, MOTION), (THETA, surface)):
        for function in (core.f, core.omega2, core.omega3, core.normal_force, core.friction_force):
            function(theta, TOP, constants)
    core.turning_points(TOP, MOTION)
    core.steady_precessions(TOP, float(MOTION.K_J), float(MOTION.K_R))


def lines() -> None:
    core.limit_energy(TOP, 7.0, 10.0, 0.5)
    core.tielines(TOP, K_J, 10.0)
    core.lift_off_and_slip_tielines(TOP, K_J, 10.0, 0.5)


def shares() -> None:
    core.allowed_shares(np.array([0.05, -0.5]), 0.4, 0.4, 10.0, 0.5)


def rolling() -> None:
    core.roll(TOP, MOTION, TIMES)
    core.roll(TOP, None, TIMES, START)


def smooth() -> None:
    core.glide(TOP, START, TIMES)
    core.outcome(TOP, START)


def sliding() -> None:
    """With each friction law, as a whole sphere and with the edge of the stem, with a landing, and standing on the
    stem."""
    top, edge = core.TruncatedSphere.paper().top, core.TruncatedSphere.paper().edge
    on_the_stem = core.State(theta=3.0, theta_dot=0.0, omega2=0.0, omega3=-9.0)
    for law in LAWS:
        core.slide(top, START, law, TIMES)
        core.slide(top, START, law, TIMES, edge=edge)
        core.slide(top, on_the_stem, law, TIMES, edge=edge)
    core.slide_many(top, START, LAWS[0], 1.0, edge, nudge=1e-6)


# In the order in which visitors of the page first need them.
CALLS: tuple[tuple[str, Callable[[], None]], ...] = (
    ("f, the spins and the forces", curve),
    ("tielines", lines),
    ("rolling", rolling),
    ("the smooth plane", smooth),
    ("sliding, with each law of friction", sliding),
    ("the shares of many tops", shares),
)


def compile_all(say: Callable[[str], object] = lambda text: None) -> str:
    """Compiles whatever is not stored yet, and stores it; when it has completed a folder, it removes those that nothing
    has used for long. say: is called with the progress, in pieces of lines. Returns the reason why the kernels could
    not be stored; empty if they were."""
    for number, (name, call) in enumerate(CALLS, 1):
        say(f"  {number} of {len(CALLS)}  {name}: ")
        start = time.monotonic()
        call()
        say(f"{time.monotonic() - start:.1f} s\n")
    folder, reason = kept.folder(), not_kept()
    if folder is not None and not reason and not kept.complete(folder):
        kept.mark(folder)
        kept.remove_unused(folder)
    return reason
