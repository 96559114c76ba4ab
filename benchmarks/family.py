"""Tops a second of the map of allowed shares: python benchmarks/family.py. Aim: 3,000 on one core, 64 K_J.

The page's own maps, of tippe tops and of ordinary ones; processor time, so that other work on the machine counts less;
beside it, in the same run, one evaluation of f, (36), on a grid of 64 by 256, and what paper/tielines.py
takes for the same tops, against which the shares are compared too.

Results
-------
2026-11-21, AMD EPYC (2 cores, shared with other work: load 5), Python 3.11.7, numpy 2.4.6
tippe tops: 1025 tops/s, 4.7 times plain f; tielines 137/s; differ by 1e-06 (median), 1e-03 (95 %), 7e-03 (most)
tippe tops, slow: 1227 tops/s, 4.0 times plain f; tielines 182/s; differ by 1e-05 (median), 5e-04 (95 %), 2e-03 (most)
ordinary tops, a to -10: 596 tops/s, 8.2 times plain f; tielines 70/s; differ by 9e-07 (median),
    4e-05 (95 %), 3e-03 (most)
ordinary tops, light: 568 tops/s, 8.6 times plain f; tielines 90/s; differ by 1e-06 (median), 5e-05 (95 %), 2e-04 (most)
With a load of 1: 1087, 1437, 753 and 771 tops/s. The aim is met for tippe tops and missed for ordinary ones: their
wells are far narrower than a point of the grid, and each needs one to three closer grids of its own.
The largest differences among tippe tops are rows on which tielines lets the other turning point slip.
"""

import platform
import time

import numpy as np

from app.model.families.family import ordinary
from tippe_core import Constants, Top, allowed_shares, f, lift_off_and_slip_tielines, pole_constants
from tippe_core.paper.share import PART, ROWS

RATIOS = np.linspace(0.6, 1.9, 30)
DISC = ordinary().top.I1
# name, a, I1, K_R
MAPS = (
    ("tippe tops", np.linspace(0.02, 0.5, 30), 0.399, 10.0),
    ("tippe tops, slow", np.linspace(0.02, 0.5, 30), 0.399, 4.0),
    ("ordinary tops, a to -10", np.linspace(-10, -0.2, 30), DISC, 53.3),
    ("ordinary tops, light", np.linspace(-10, -0.2, 30), 3.66, 23.6),
)
EVERY, REPEAT, MU_S, COLUMNS = 11, 200, 0.5, 256


def exact(top, K_R):
    lift, slip = lift_off_and_slip_tielines(top, PART * pole_constants(top, K_R)[0], K_R, MU_S)
    return np.nansum(slip.theta_outer - slip.theta_inner) / np.nansum(lift.theta_outer - lift.theta_inner)


def timed(function):
    start = time.process_time()
    return function(), time.process_time() - start


def main():
    theta, K_J = np.linspace(0.01, 3.13, COLUMNS), np.linspace(0, 8, ROWS)[:, None]
    constants = Constants(K_J, 10.0, 28.0)
    allowed_shares(0.07, 0.399, 0.408, 10.0, MU_S)  # compiled
    _, plain = timed(lambda: [f(theta, Top.paper(), constants) for _ in range(REPEAT)])
    plain /= REPEAT
    print(f"Python {platform.python_version()}, numpy {np.__version__}, {platform.machine()}")
    for name, a, I1, K_R in MAPS:
        a, ratio = (grid.ravel() for grid in np.meshgrid(a, RATIOS))
        shares, spent = timed(lambda a=a, I1=I1, ratio=ratio, K_R=K_R: allowed_shares(a, I1, I1 * ratio, K_R, MU_S))
        tops = [Top(a[i], I1, I1 * ratio[i]) for i in range(0, len(a), EVERY)]
        slow, spent_slow = timed(lambda tops=tops, K_R=K_R: np.array([exact(top, K_R) for top in tops]))
        off = np.abs(shares[::EVERY] - slow)
        print(
            f"{name}: {len(a) / spent:.0f} tops/s, {spent / len(a) / plain:.1f} times plain f; "
            f"tielines {len(tops) / spent_slow:.0f}/s; "
            f"differ by {np.median(off):.0e} (median), {np.quantile(off, 0.95):.0e} (95 %), {off.max():.0e} (most)"
        )


if __name__ == "__main__":
    main()
