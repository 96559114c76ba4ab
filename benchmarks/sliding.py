"""How fast slide() is: python benchmarks/sliding.py.

The reference inversion, 300 (R/g)^1/2 of the paper's top under smoothed Coulomb friction (mu = 0.3, eps = 1,
theta = 0.1, w3 = 8.8), 3,001 samples: processor time on one core at a drift of C_J of 1e-8 or less     aim: <= 0.5 s
and, for comparison, SciPy's DOP853 with the same right-hand side, in the same run.

Results
-------
2026-11-21, AMD EPYC (2 cores, shared with other work: load 3), Python 3.11.7, numpy 2.4.6, scipy 1.17.1
slide rtol 1e-09: 0.227 s, drift of C_J 3.9e-09   (aim <= 0.5 s at 1e-8)
slide rtol 1e-10: 0.271 s, drift of C_J 5.9e-10
slide rtol 1e-12: 0.389 s, drift of C_J 4.7e-12
DOP853 rtol 1e-9: 0.523 s, drift of C_J 3.5e-09
"""

import datetime
import platform
import statistics
import time

import numpy as np
import scipy
from scipy.integrate import solve_ivp

from tippe_core import SmoothedCoulomb, State, Top, slide
from tippe_core.sliding import _Run

TOP, STATE, FRICTION = Top.paper(), State(0.1, 0.0, 0.0, 8.8), SmoothedCoulomb(0.3, 1.0)
TIMES = np.linspace(0, 300, 3001)


def drift(C_J):
    return np.abs(C_J / C_J[0] - 1).max()


def peer(rtol):
    """C_J at the samples by DOP853."""
    run = _Run(TOP, FRICTION, rtol)
    y = solve_ivp(run._rates, (0, 300), run._start(STATE, 0.0), "DOP853", TIMES, rtol=rtol, atol=rtol).y
    return run._trajectory(y, y).jellett


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
    for rtol in (1e-9, 1e-10, 1e-12):
        moved = slide(TOP, STATE, FRICTION, TIMES, rtol)
        spent = seconds(lambda rtol=rtol: slide(TOP, STATE, FRICTION, TIMES, rtol))
        print(f"slide rtol {rtol:.0e}: {spent:.3f} s, drift of C_J {drift(moved.jellett):.1e}")
    spent = seconds(lambda: peer(1e-9), 3)
    print(f"DOP853 rtol 1e-9: {spent:.3f} s, drift of C_J {drift(peer(1e-9)):.1e}")
