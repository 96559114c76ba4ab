"""Tops a second of the map of allowed shares: python benchmarks/family.py. Aim: 1,000 on one core, 64 K_J by 256 theta.

A map like the page's, from the module that the page uses; processor time, so that other work on the machine counts
less, and beside it the time of one plain numpy evaluation of f, (36), on a grid of that size.

Results
-------
2026-11-21, AMD EPYC (2 cores, shared with other work: load 3), Python 3.11.7, numpy 2.4.6
400 tops in 2.50 s: 160 tops/s; one top 6.24 ms / plain f 0.146 ms = 42.8
The aim is missed six times over: every tieline is refined to tippe_core's full accuracy, which a map does not need. The
same sum on the bare grid reached 760 tops/s, but was wrong by up to 0.13 in the share, so it is not used.
"""

import platform
import time

import numpy as np

from app.family import TIELINES, share_map
from tippe_core import Constants, Top, f

A, RATIOS = np.linspace(0.02, 0.5, 20), np.linspace(0.6, 1.6, 20)
REPEAT = 200


def main():
    top = Top.paper()
    start = time.process_time()
    done = sum(1 for _ in share_map(top.I1, 10.0, 0.5, A, RATIOS))
    spent = time.process_time() - start
    theta, K_J = np.linspace(0.01, 3.13, 256), np.linspace(0, 8, TIELINES)[:, None]
    start = time.process_time()
    for _ in range(REPEAT):
        f(theta, top, Constants(K_J, 10.0, 28.0))
    plain = (time.process_time() - start) / REPEAT
    print(f"Python {platform.python_version()}, numpy {np.__version__}, {platform.machine()}")
    print(f"{done} tops in {spent:.2f} s: {done / spent:.0f} tops/s (aim 1000)")
    print(f"one top {1e3 * spent / done:.2f} ms / plain f {1e3 * plain:.3f} ms = {spent / done / plain:.1f}")


if __name__ == "__main__":
    main()
