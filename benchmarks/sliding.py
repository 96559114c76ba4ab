"""How fast slide() is: rows of make bench.

The reference inversion, 300 (R/g)^1/2 of the paper's top under smoothed Coulomb friction (mu = 0.3, eps = 1,
theta = 0.1, w3 = 8.8), 3,001 samples: processor time on one core, and for comparison in the same run MuJoCo stepping
the same top: a sphere with its mass off centre on a plane, its contact frictionless and the law of friction given as a
force (a callback in Python, timed with and without; without it the motion is another one, but a step costs the same).
Aim: with a drift of C_J of 1e-8 or less 40 times as fast as MuJoCo's RK4 without Python's law at the largest step tried
that keeps 1e-6. implicitfast, of first order, as MuJoCo advises for contacts: its drift falls with the step, so that
the step for 1e-6 is found by proportion.

slide_many(): 50 x 50 starts, theta by spin, of 10 s of appendix A's top with its stem, by the clock. Aim:
10 s on two cores, with Coulomb's law and with the smoothed one. And runs a second of Contensou's law on one thread,
on two, and in two processes.
"""

import math
import os
import statistics
import sys
import time
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from pathlib import Path
from types import SimpleNamespace

import mujoco
import numpy as np

from tippe_core import Contensou, Coulomb, SmoothedCoulomb, State, Top, TruncatedSphere, slide, slide_many

sys.path.insert(0, str(Path(__file__).parent.parent / "tests"))
from mujoco_sphere import placed

TOP, STATE, FRICTION = Top.paper(), State(0.1, 0.0, 0.0, 8.8), SmoothedCoulomb(0.3, 1.0)
TIMES = np.linspace(0, 300, 3001)


def drift(C_J):
    return np.abs(C_J / C_J[0] - 1).max()


def friction(model, data):
    """The law of FRICTION at the sphere's lowest point, as MuJoCo's generalised force."""
    (xx, xy, xz, yx, yy, yz, *_), (vx, vy, _, w1, w2, w3) = data.xmat[1].tolist(), data.qvel.tolist()
    ux, uy = vx - (yx * w1 + yy * w2 + yz * w3), vy + (xx * w1 + xy * w2 + xz * w3)
    N = data.efc_force[0] if data.nefc else 0.0
    k = FRICTION.mu * N / math.sqrt(ux * ux + uy * uy + FRICTION.eps**2)
    tx, ty = -k * uy, k * ux  # of the torque -z x F
    data.qfrc_applied[:] = -k * ux, -k * uy, 0, xx * tx + yx * ty, xy * tx + yy * ty, xz * tx + yz * ty


def stepped(integrator, step):
    """MuJoCo over the reference inversion: drift of C_J, seconds with the law, without it, cos(theta) at the end."""
    model, data = placed(TOP, STATE.theta, step, 0.05 / step**2, integrator=integrator)
    data.qvel[5] = STATE.omega3  # about axis 3, on which both O and G lie at rest

    def C_J():
        up = data.xmat[1].reshape(3, 3)[2]
        L = data.qvel[3:] * (TOP.I1, TOP.I1, TOP.I3)
        return L @ up - TOP.a * L[2]

    steps, values, spent = round(TIMES[-1] / step), [TOP.I3 * (math.cos(STATE.theta) - TOP.a) * STATE.omega3], []
    for law in (friction, None):
        mujoco.set_mjcb_control(law)
        start = time.process_time()
        for _ in range(100):
            mujoco.mj_step(model, data, steps // 100)
            values.append(C_J())
        spent.append(time.process_time() - start)
        if law:
            found, end = drift(np.array(values)), data.xmat[1][8]
    mujoco.set_mjcb_control(None)
    return found, *spent, end


def seconds(job, repetitions=5):
    spent = []
    for _ in range(repetitions):
        start = time.process_time()
        job()
        spent.append(time.process_time() - start)
    return statistics.median(spent)


def rows():
    """What, our time, the peer's, ratio, verdict."""
    for rtol in (1e-6, 1e-9, 1e-12, 2e-8):
        moved = slide(TOP, STATE, FRICTION, TIMES, rtol)
        ours, found = seconds(lambda rtol=rtol: slide(TOP, STATE, FRICTION, TIMES, rtol)), drift(moved.jellett)
        yield f"slide(), drift of C_J {found:.1e}", f"{1e3 * ours:.3g} ms", "", "", ""
    assert found <= 1e-8
    for integrator, steps in (("implicitfast", (1e-3,)), ("RK4", (0.05, 0.03, 0.02, 0.01))):
        for step in steps:
            found, spent, bare, _ = stepped(integrator, step)
            if found <= 1e-6:
                break
        share = max(found / 1e-6, 1.0)
        times = bare * share / ours
        verdict = "aim 40" + ("" if times >= 40 else " **lost**" if times < 1 else " **missed**")
        yield (f"slide(), drift of C_J within 1e-8, MuJoCo {mujoco.__version__} {integrator} within 1e-6",
               f"{1e3 * ours:.3g} ms",
               f"step {step / share:.1e}: {1e3 * bare * share:.3g} ms, {1e3 * spent * share:.3g} with Python's law",
               f"{times:.3g} times faster", verdict)  # fmt: skip
    yield from many()


def many():
    """Rows of slide_many()."""
    body = TruncatedSphere.paper()
    end = 10 / body.scales.time
    theta, omega3 = np.meshgrid(np.linspace(0.02, 1.0, 50), np.linspace(2.0, 12.0, 50))
    starts = SimpleNamespace(theta=theta, theta_dot=0.0, omega2=0.0, omega3=omega3, phi=0.0, psi=0.0,
                             x=0.0, y=0.0, vx=0.0, vy=0.0)  # fmt: skip
    for law in (Coulomb(0.3, 0.3), SmoothedCoulomb(0.3, 0.1)):
        slide_many(body.top, STATE, law, 1.0, body.edge)  # compiled
        begin = time.perf_counter()
        found = slide_many(body.top, starts, law, end, body.edge)
        spent = time.perf_counter() - begin
        verdict = "aim 10 s on two cores" + ("" if spent <= 10 else " **missed**")
        kinds = ", ".join(f"{int((found.end == kind).sum())} {kind}" for kind in np.unique(found.end))
        yield f"slide_many(), 2,500 runs of 10 s, {law}", f"{spent:.3g} s", f"{os.cpu_count()} cores", kinds, verdict
    law = Contensou(0.3, 0.02)
    for what, pool, count in (("1 thread", ThreadPoolExecutor, 1), ("2 threads", ThreadPoolExecutor, 2),
                              ("2 processes", ProcessPoolExecutor, 2)):  # fmt: skip
        with pool(count) as executor:
            slide_many(body.top, starts, law, 0.1, body.edge, executor=executor)  # started, and compiled
            begin = time.perf_counter()
            slide_many(body.top, starts, law, end, body.edge, executor=executor)
            spent = time.perf_counter() - begin
        yield f"slide_many(), 2,500 runs of 10 s, {law}, {what}", f"{theta.size / spent:.4g} runs a second", "", "", ""
