"""How fast slide() is: python benchmarks/sliding.py.

The reference inversion, 300 (R/g)^1/2 of the paper's top under smoothed Coulomb friction (mu = 0.3, eps = 1,
theta = 0.1, w3 = 8.8), 3,001 samples: processor time on one core at a drift of C_J of 1e-8 or less     aim: <= 0.5 s
and, for comparison in the same run, SciPy's DOP853 with the same right-hand side, and MuJoCo stepping the same top: a
sphere with its mass off centre on a plane, its contact frictionless and the law of friction given as a force (a
callback in Python, timed with and without; without it the motion is another one, but a step costs the same). Aim: at
least 5 times faster than MuJoCo at the step that gives it a drift of 1e-6. Integrators: implicitfast, of first order,
as MuJoCo advises for contacts, whose drift falls with the step, so that the step for 1e-6 is found by proportion; and
RK4, at the largest step tried that keeps 1e-6.

Results
-------
2026-11-21, AMD EPYC (2 cores, shared with other work: load 3), Python 3.11.7, numpy 2.4.6, scipy 1.17.1
slide rtol 1e-07: 0.201 s, drift of C_J 2.7e-07, cos(theta) at the end -0.99947
slide rtol 1e-09: 0.253 s, drift of C_J 3.9e-09, cos(theta) at the end -0.99947
slide rtol 1e-10: 0.293 s, drift of C_J 5.9e-10, cos(theta) at the end -0.99947
slide rtol 1e-12: 0.415 s, drift of C_J 4.7e-12, cos(theta) at the end -0.99947
DOP853 rtol 1e-9: 0.366 s, drift of C_J 3.6e-09
MuJoCo 4.0.0 implicitfast, step 0.001: 1.853 s (1.040 s without the law), drift of C_J 2.9e-04,
    cos(theta) at the end -0.99948
    at a drift of 1e-6 (step 3.5e-06): 2.65e+03 times the time of slide, 1.49e+03 without the law   (aim >= 5)
MuJoCo 4.0.0 RK4, step 0.05: 0.137 s (0.067 s without the law), drift of C_J 1.2e-05, cos(theta) at the end -0.99951
MuJoCo 4.0.0 RK4, step 0.03: 0.227 s (0.113 s without the law), drift of C_J 1.8e-06, cos(theta) at the end -0.99950
MuJoCo 4.0.0 RK4, step 0.02: 0.341 s (0.170 s without the law), drift of C_J 4.4e-07, cos(theta) at the end -0.99949
    at a drift of 1e-6 (step 2.0e-02): 1.7 times the time of slide, 0.844 without the law   (aim >= 5)
Against the integrator that MuJoCo advises, thousands of times; against its RK4, which a smooth law and a single
contact suit, the aim of 5 is missed: 1.7 times, and equal if the Python of the law were free.
"""

import datetime
import math
import platform
import statistics
import sys
import time
from pathlib import Path

import mujoco
import numpy as np
import scipy
from scipy.integrate import solve_ivp

from tippe_core import SmoothedCoulomb, State, Top, slide
from tippe_core.sliding import _Run

sys.path.insert(0, str(Path(__file__).parent.parent / "tests"))
from mujoco_sphere import placed

TOP, STATE, FRICTION = Top.paper(), State(0.1, 0.0, 0.0, 8.8), SmoothedCoulomb(0.3, 1.0)
TIMES = np.linspace(0, 300, 3001)


def drift(C_J):
    return np.abs(C_J / C_J[0] - 1).max()


def peer(rtol):
    """C_J at the samples by DOP853."""
    run = _Run(TOP, FRICTION, rtol)
    y = solve_ivp(run._rates, (0, 300), run._start(STATE, 0.0), "DOP853", TIMES, rtol=rtol, atol=rtol).y
    return run._trajectory(y, y).jellett


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


if __name__ == "__main__":
    print(f"{datetime.date.today()}, {platform.processor() or platform.machine()}, Python {platform.python_version()}, "
          f"numpy {np.__version__}, scipy {scipy.__version__}")  # fmt: skip
    best = {}
    for rtol in (1e-7, 1e-9, 1e-10, 1e-12):
        moved = slide(TOP, STATE, FRICTION, TIMES, rtol)
        spent = seconds(lambda rtol=rtol: slide(TOP, STATE, FRICTION, TIMES, rtol))
        print(f"slide rtol {rtol:.0e}: {spent:.3f} s, drift of C_J {drift(moved.jellett):.1e}, cos(theta) at the end "
              f"{np.cos(moved.theta[-1]):.5f}")  # fmt: skip
        best.setdefault(drift(moved.jellett) <= 1e-6, spent)
    spent = seconds(lambda: peer(1e-9), 3)
    print(f"DOP853 rtol 1e-9: {spent:.3f} s, drift of C_J {drift(peer(1e-9)):.1e}")
    for integrator, steps in (("implicitfast", (1e-3,)), ("RK4", (0.05, 0.03, 0.02, 0.01))):
        for step in steps:
            found, spent, bare, end = stepped(integrator, step)
            print(f"MuJoCo {mujoco.__version__} {integrator}, step {step:g}: {spent:.3f} s ({bare:.3f} s without the "
                  f"law), drift of C_J {found:.1e}, cos(theta) at the end {end:.5f}")  # fmt: skip
            if found <= 1e-6:
                break
        share = max(found / 1e-6, 1.0)
        print(f"    at a drift of 1e-6 (step {step / share:.1e}): {spent * share / best[True]:.3g} times the time of "
              f"slide, {bare * share / best[True]:.3g} without the law   (aim >= 5)")  # fmt: skip
