"""How fast the core is, as ratios to a peer in the same run: python benchmarks/bench.py (needs the extra "bench").

(a) Fig. 5 and Fig. 6 whole, 64 K_J, both limits, tielines and turning points, divided by one plain numpy evaluation
    of f, (36), on theta[None, :] and K_J[:, None], 512 theta.                                            aim: <= 15
(b) theta(t) at 10,000 times over 400 nutations, set-up included, error <= 1e-11, against
    heyoka's compiled Taylor integrator, tol 1e-15, compiling not counted                                  aim: >= 5
    SciPy's DOP853, rtol = atol = 1e-13                                                                  aim: >= 100
    Peers integrate u = cos(theta), u'' = d/du[(1 - u^2) f]/2: no trigonometry, no turning points, their best form.
    Errors are those against the rigid body of tests/rigid_body.py, which uses no formula of the paper.
(c) roll(): full poses, track and forces at the same 10,000 times                                     aim: <= 10 ms

Repetitions take turns, so that a busy machine is busy for all; medians are printed.

Results
-------
2026-11-21, AMD EPYC (2 cores), Python 3.11.7, numpy 2.4.6, scipy 1.17.1, heyoka 7.13.2
(a) figures 1.694 ms / plain f 0.099 ms = 17.1   (aim <= 15)
(b) theta(t) 1.16 ms, error 1.2e-13; heyoka 4.71 ms, error 5.4e-14: 4.1 times   (aim >= 5)
    DOP853 3797 ms, error 1.8e-11: 2184 times   (aim >= 100)
(c) roll() 4.59 ms   (aim <= 10)
"""

import argparse
import datetime
import platform
import statistics
import sys
import time
from pathlib import Path

import heyoka
import numpy as np
import scipy
from scipy.integrate import solve_ivp

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))
import rigid_body as rb

from tippe_core import Constants, Rolling, Top, figures, omega2, omega3, roll, turning_points

TOP = Top.paper()
K_R, MU_S = 10.0, 0.5
MOTION = Constants(7.0, 10.0, 28.0)
NUTATIONS, FRAMES = 400, 10_000


def plain_f(theta, K_J, K_R, E):
    """(36) as anyone writes it in numpy."""
    a, I1, I3 = TOP.a, TOP.I1, TOP.I3
    s2, c = np.sin(theta) ** 2, np.cos(theta)
    f1_squared = I1 + 1 + a**2 - 2 * a * c
    f2_squared = I1 + I1 / I3 * s2 + (c - a) ** 2
    f3 = np.sqrt(I3 + s2 + I3 / I1 * (c - a) ** 2)
    two_E_prime = 2 * E - K_R**2 + I1 / I3 * K_J**2
    bracket = K_J - I3 / I1 * (c - a) * K_R / f3
    return (two_E_prime - 2 * a * (1 - c) - f2_squared / s2 * bracket**2) / f1_squared


def medians(repetitions, **jobs):
    """Median seconds of each job, run in turns."""
    seconds = {name: [] for name in jobs}
    for _ in range(repetitions):
        for name, job in jobs.items():
            start = time.perf_counter()
            job()
            seconds[name].append(time.perf_counter() - start)
    return {name: statistics.median(values) for name, values in seconds.items()}


def acceleration(u, sqrt):
    """u'' = d/du[(1 - u^2) f(u)]/2 with (1 - u^2) f = [(1 - u^2)(2E' - 2a(1 - u)) - f2^2 B^2]/f1^2."""
    a, I1, I3 = TOP.a, TOP.I1, TOP.I3
    g, e = I3 / I1, MOTION.two_E_prime(TOP)
    s2, p = 1.0 - u * u, u - a
    f3_squared = I3 + s2 + g * p * p
    q = MOTION.K_R / sqrt(f3_squared)  # w3
    B = MOTION.K_J - g * p * q
    B_slope = -g * q * (1.0 + I3 - a * u) / f3_squared
    f2_squared, f2_slope = I1 + s2 / g + p * p, 2 * p - 2 * u / g
    f1_squared, rest = I1 + 1 + a * a - 2 * a * u, e - 2 * a * (1.0 - u)
    top_line = s2 * rest - f2_squared * B * B
    slope = 2 * a * s2 - 2 * u * rest - B * (f2_slope * B + 2 * f2_squared * B_slope)
    return (slope + 2 * a * top_line / f1_squared) / (2 * f1_squared)


def reference(theta, times):
    """theta(t) of the rigid body started at rest in theta."""
    w2, w3 = (g(theta, TOP, MOTION) for g in (omega2, omega3))
    body = rb.Body.of(TOP)
    motion = rb.integrate(body, rb.euler_quaternion(0, theta, 0), rb.to_body(0, 0, w2, w3), times)
    x, y, z, w = motion.quaternion.T
    return (2 * np.arctan2(np.hypot(x, y), np.hypot(z, w))).astype(float)


def run(repetitions):
    inner = turning_points(TOP, MOTION)[0, 0]
    times = np.linspace(0, NUTATIONS * Rolling(TOP, MOTION).period, FRAMES)
    expected = reference(inner, times)

    theta, K_J = np.linspace(0.005, np.pi - 0.005, 512), np.linspace(0, 8.365, 64)
    E = np.full((64, 1), 30.0)
    one = medians(
        repetitions * 20,
        plain=lambda: plain_f(theta[None, :], K_J[:, None], K_R, E),
        figures=lambda: figures(TOP, K_J, K_R, MU_S),
    )

    u, v = heyoka.make_vars("u", "v")
    taylor = heyoka.taylor_adaptive([(u, v), (v, acceleration(u, heyoka.sqrt))], [0.0, 0.0], tol=1e-15)

    def by_heyoka():
        taylor.time = 0.0
        taylor.state[:] = np.cos(inner), 0.0
        return np.arccos(taylor.propagate_grid(times)[-1][:, 0])

    def by_scipy():
        solved = solve_ivp(
            lambda t, y: (y[1], acceleration(y[0], np.sqrt)), times[[0, -1]], (np.cos(inner), 0.0),
            method="DOP853", rtol=1e-13, atol=1e-13, t_eval=times)  # fmt: skip
        return np.arccos(solved.y[0])

    def by_core():
        return Rolling(TOP, MOTION).theta(times)

    def whole():
        return roll(TOP, MOTION, times)

    errors = {job.__name__: np.abs(job() - expected).max() for job in (by_core, by_heyoka, by_scipy)}
    two = medians(repetitions, core=by_core, heyoka=by_heyoka, roll=whole)
    slow = medians(max(1, repetitions // 10), core=by_core, scipy=by_scipy)

    versions = f"Python {platform.python_version()}, numpy {np.__version__}, scipy {scipy.__version__}, "
    yield f"{datetime.date.today()}, {processor()}, {versions}heyoka {heyoka.__version__}"
    yield (f"(a) figures {1e3 * one['figures']:.3f} ms / plain f {1e3 * one['plain']:.3f} ms"
           f" = {one['figures'] / one['plain']:.1f}   (aim <= 15)")  # fmt: skip
    yield (f"(b) theta(t) {1e3 * two['core']:.2f} ms, error {errors['by_core']:.1e};"
           f" heyoka {1e3 * two['heyoka']:.2f} ms, error {errors['by_heyoka']:.1e}:"
           f" {two['heyoka'] / two['core']:.1f} times   (aim >= 5)")  # fmt: skip
    yield (f"    DOP853 {1e3 * slow['scipy']:.0f} ms, error {errors['by_scipy']:.1e}:"
           f" {slow['scipy'] / slow['core']:.0f} times   (aim >= 100)")  # fmt: skip
    yield f"(c) roll() {1e3 * two['roll']:.2f} ms   (aim <= 10)"


def processor():
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
        return next(line.split(":")[1].strip() for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.processor() or platform.machine()


if __name__ == "__main__":
    options = argparse.ArgumentParser(description="Ratios of the core to its peers.")
    options.add_argument("--repetitions", type=int, default=50)
    for line in run(options.parse_args().repetitions):
        print(line, flush=True)
