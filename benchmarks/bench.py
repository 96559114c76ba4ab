"""How fast the core is, against peers in the same run: make bench.

Every row is a ratio to a peer or a number with its aim, and is printed whether it is won or lost. Times are processor
time on one thread; repetitions take turns, so that a busy machine is busy for all, and medians are printed. Each run is
kept in benchmarks/results.md.

    figures   Fig. 5 and Fig. 6 whole, 64 K_J, both limits, tielines and turning points, against one plain numpy
              evaluation of f, (36), on theta[None, :] and K_J[:, None], 512 theta, and against the straightforward
              SciPy version: a grid, brentq for the turning points, bisection of the energy, K_J by K_J
    theta(t)  set-up included, against heyoka's compiled Taylor integrator (compiling not counted) and SciPy's DOP853,
              each at the loosest tolerance with which its error is at most 1e-11. Peers integrate u = cos(theta),
              u'' = d/du[(1 - u^2) f]/2: no trigonometry, no turning points, their best form. Errors are against the
              rigid body of tests/rigid_body.py over 400 nutations, beyond that against Rolling, whose phase the tests
              hold against fifty digits
    roll()    full poses, track and forces at 10,000 times, against one plain f
    a move    of K_J in Explorer, all it solves, against one plain f
    shares    allowed_shares() of 30 x 30 tippe tops (family.py has more of them)
    slide()   against MuJoCo at equal drift of C_J (sliding.py)
"""

import argparse
import datetime
import os
import platform
import statistics
import subprocess
import sys
import time
import tracemalloc
import urllib.request
from pathlib import Path

import heyoka
import numpy as np
import scipy
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, minimize_scalar

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))
import rigid_body as rb
import sliding

from app.model.explorer import Explorer
from tippe_core import (
    Constants,
    Rolling,
    Top,
    allowed_shares,
    f,
    omega2,
    omega3,
    pole_constants,
    roll,
    turning_points,
)
from tippe_core import (
    lift_off_and_slip_tielines as both,
)

HERE = Path(__file__).parent
TOP = Top.paper()
K_R, MU_S = 10.0, 0.5
MOTION = Constants(7.0, 10.0, 28.0)
FRAMES, ERROR = 10_000, 1e-11
PATIENCE = 2.0  # s: a peer that took longer is not asked for ten times the span
K_J = np.linspace(0, pole_constants(TOP, K_R)[0] * (1 - 1e-4), 64)


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


def plain_margin(theta, K_J, K_R, E, mu_s):
    """F_z, or mu_s F_z - F_h, by (37) to (39) as printed, f' by central differences."""
    a, I1, I3, h = TOP.a, TOP.I1, TOP.I3, 1e-5
    s, c, value = np.sin(theta), np.cos(theta), plain_f(theta, K_J, K_R, E)
    slope = (plain_f(theta + h, K_J, K_R, E) - plain_f(theta - h, K_J, K_R, E)) / (2 * h)
    f3 = np.sqrt(I3 + s**2 + I3 / I1 * (c - a) ** 2)
    w3 = K_R / f3
    w2 = (K_J - I3 / I1 * (c - a) * w3) / s
    Fz = 1 + a * (s * slope / 2 + c * value)
    if mu_s is None:
        return Fz
    Fx = I3 * K_R * np.sqrt(np.maximum(value, 0)) / f3**3 * (c - I3 / I1 * (c - a))
    Fy = (a * s * Fz + I1 * slope / 2 - I1 * c / s * w2**2 + I3 * w2 * w3) / (1 - a * c)
    return mu_s * Fz - np.hypot(Fx, Fy)


def straightforward(K_J, K_R, mu_s):
    """(E, inner, outer) of one tieline: trajectory after trajectory, until the margin is negative somewhere on one."""
    grid = np.linspace(1e-3, np.pi - 1e-3, 512)
    least = minimize_scalar(lambda x: -plain_f(x, K_J, K_R, 0.0) * (TOP.I1 + 1 + TOP.a**2 - 2 * TOP.a * np.cos(x)),
                            bounds=(1e-3, np.pi - 1e-3), method="bounded", options={"xatol": 1e-10})  # fmt: skip
    bottom = least.fun / 2

    def ends(E):
        allowed = plain_f(grid, K_J, K_R, E) > 0
        left = grid[(grid < least.x) & ~allowed]
        right = grid[(grid > least.x) & ~allowed]
        places = left[-1] if len(left) else None, right[0] if len(right) else None
        return [edge if place is None else brentq(plain_f, place, least.x, args=(K_J, K_R, E), xtol=1e-12)
                for place, edge in zip(places, grid[[0, -1]], strict=True)]  # fmt: skip

    def worst(E):
        inner, outer = ends(E)
        return plain_margin(np.linspace(inner, outer, 201), K_J, K_R, E, mu_s).min()

    good, bad = bottom + 1e-6, bottom + 1.0
    while worst(bad) >= 0:
        good, bad = bad, bad + 2 * (bad - bottom)
    while bad - good > 1e-9:
        middle = (good + bad) / 2
        good, bad = (good, middle) if worst(middle) < 0 else (middle, bad)
    return good, *ends(good)


def all_straightforward():
    return np.array([[straightforward(K, K_R, mu) for K in K_J] for mu in (None, MU_S)])


def timed(job):
    """Processor time, which other work on the machine changes least."""
    start = time.process_time()
    job()
    return time.process_time() - start


def medians(repetitions, **jobs):
    """Median seconds of each job, run in turns."""
    seconds = {name: [] for name in jobs}
    for _ in range(repetitions):
        for name, job in jobs.items():
            seconds[name].append(timed(job))
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


class Peers:
    """theta at the times from the inner turning point."""

    def __init__(self):
        self.inner = turning_points(TOP, MOTION)[0, 0]
        u, v = heyoka.make_vars("u", "v")
        self.taylor = {tol: heyoka.taylor_adaptive([(u, v), (v, acceleration(u, heyoka.sqrt))], [0.0, 0.0], tol=tol)
                       for tol in (1e-10, 1e-12, 1e-13, 1e-14, 1e-15)}  # fmt: skip
        self.tolerances = {"heyoka": list(self.taylor), "DOP853": [1e-10, 1e-12, 1e-13, 3e-14]}

    def core(self, times, _):
        return Rolling(TOP, MOTION).theta(times)

    def heyoka(self, times, tol):
        taylor = self.taylor[tol]
        taylor.time = 0.0
        taylor.state[:] = np.cos(self.inner), 0.0
        return np.arccos(taylor.propagate_grid(times)[-1][:, 0])

    def DOP853(self, times, tol):
        solved = solve_ivp(
            lambda t, y: (y[1], acceleration(y[0], np.sqrt)), times[[0, -1]], (np.cos(self.inner), 0.0),
            method="DOP853", rtol=tol, atol=tol, t_eval=times)  # fmt: skip
        return np.arccos(solved.y[0])

    def loosest(self, name, times, expected):
        """(tolerance, error) of the loosest tolerance with an error within ERROR; of the tightest, if none has it.

        Longer spans, which come later, begin with the tolerance found.
        """
        while True:
            tol = self.tolerances[name][0]
            error = np.abs(getattr(self, name)(times, tol) - expected).max()
            if error <= ERROR or len(self.tolerances[name]) == 1:
                return tol, error
            del self.tolerances[name][0]


def fresh(code):
    """Seconds that a line of code prints in a new interpreter."""
    return float(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout)


IMPORT = """import time
import numpy, scipy.fft, scipy.integrate, scipy.optimize
start = time.process_time()
import tippe_core
print(time.process_time() - start)"""


def server_start(path, port):
    """Seconds from the command to the first page it answers."""
    start = time.perf_counter()
    process = subprocess.Popen([sys.executable, "-m", "panel", "serve", str(path), "--port", str(port)],
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)  # fmt: skip
    try:
        while time.perf_counter() - start < 120:
            try:
                urllib.request.urlopen(f"http://localhost:{port}/{Path(path).stem}", timeout=60).close()
                return time.perf_counter() - start
            except OSError:
                time.sleep(0.02)
    finally:
        process.terminate()
        process.wait()
    return float("nan")


def peak(job):
    """Peak of what Python and numpy hold during the job, MB."""
    tracemalloc.start()
    job()
    most = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    return most / 1e6


def compared(what, ours, peer, name, aim=None):
    """A row: the ratio, and whether it is won; aim in times faster."""
    times = peer / ours
    verdict = "" if aim is None else f"aim {aim:g}"
    verdict += "" if times >= (aim or 1) else " **lost**" if times < 1 else " **missed**"
    return what, f"{1e3 * ours:.3g} ms", f"{name} {1e3 * peer:.3g} ms", f"{times:.3g} times faster", verdict.strip()


def run(repetitions, port):
    theta, E = np.linspace(0.005, np.pi - 0.005, 512), np.full((64, 1), 30.0)
    one = medians(repetitions * 20, plain=lambda: plain_f(theta[None, :], K_J[:, None], K_R, E),
                  figures=lambda: both(TOP, K_J, K_R, MU_S))  # fmt: skip
    ratio = one["figures"] / one["plain"]
    yield ("Figs. 5 + 6, 64 K_J", f"{1e3 * one['figures']:.3g} ms",
           f"one plain f, 64 x 512: {1e3 * one['plain']:.3g} ms", f"costs {ratio:.1f} of them",
           "aim 8 at most" + ("" if ratio <= 8 else " **missed**"))  # fmt: skip
    slow = medians(max(1, repetitions // 20), figures=lambda: both(TOP, K_J, K_R, MU_S), scipy=all_straightforward)
    yield compared("Figs. 5 + 6, 64 K_J", slow["figures"], slow["scipy"], "grid + brentq + bisection")
    found = both(TOP, K_J, K_R, MU_S)
    off = [np.abs(lines.E - rows[:, 0]).max() for lines, rows in zip(found, all_straightforward(), strict=True)]
    yield "", "", f"its E differs by {off[0]:.0e} (lift-off), {off[1]:.0e} (slip)", "", ""

    peers = Peers()
    period = Rolling(TOP, MOTION).period
    took = {"heyoka": 0.0, "DOP853": 0.0}
    for nutations in (4, 40, 400, 4000):
        times = np.linspace(0, nutations * period, FRAMES)
        expected = reference(peers.inner, times) if nutations <= 400 else peers.core(times, None)
        error = np.abs(peers.core(times, None) - expected).max()
        turns = max(3, repetitions // 5)
        for name, aim, count in (("heyoka", 5, turns), ("DOP853", 100, 1)):
            if took[name] > PATIENCE:
                yield f"theta(t), {nutations} nutations", "", f"{name}: not waited for", "", ""
                continue
            tol, peer_error = peers.loosest(name, times, expected)
            spent = medians(count, core=lambda times=times: peers.core(times, None),
                            peer=lambda name=name, times=times, tol=tol: getattr(peers, name)(times, tol))  # fmt: skip
            took[name] = spent["peer"]
            known = f"error {error:.0e}" if nutations <= 400 else "held to be right"
            yield compared(f"theta(t), {nutations} nutations, {known}", spent["core"], spent["peer"],
                           f"{name}, tol {tol:.0e}, error {peer_error:.0e}:",
                           aim if nutations == 400 else 1)  # fmt: skip
    for nutations in (4, 40, 400, 4000):
        times = np.linspace(0, nutations * period, FRAMES)
        spent = medians(repetitions, roll=lambda times=times: roll(TOP, MOTION, times))["roll"]
        ratio = spent / one["plain"]
        yield (f"roll(), {nutations} nutations, 10,000 samples", f"{1e3 * spent:.3g} ms",
               f"one plain f: {1e3 * one['plain']:.3g} ms", f"costs {ratio:.1f} of them", "")  # fmt: skip

    for n in (16, 64, 256, 1024, 4096):
        K = np.linspace(0, K_J[-1], n)
        spent = medians(max(3, repetitions // 5), figures=lambda K=K: both(TOP, K, K_R, MU_S))["figures"]
        yield f"Figs. 5 + 6, {n} K_J", f"{1e3 * spent:.3g} ms", "", f"{1e6 * spent / n:.3g} µs a K_J", ""
    for n, m in ((64, 64), (64, 512), (512, 64), (512, 512), (2048, 512)):
        constants, grid = Constants(np.linspace(0, 8, n)[:, None], K_R, 30.0), np.linspace(0.01, 3.13, m)
        spent = medians(max(3, repetitions // 5), f=lambda grid=grid, c=constants: f(grid, TOP, c),
                        plain=lambda grid=grid, c=constants: plain_f(grid, c.K_J, K_R, 30.0))  # fmt: skip
        yield compared(f"surface f, {n} K_J x {m} theta: {1e9 * spent['f'] / (n * m):.3g} ns a point", spent["f"],
                       spent["plain"], "plain f")  # fmt: skip

    explorer, places = Explorer(), np.linspace(6.0, 7.5, 41)

    def moves():
        for place in places:
            explorer.set(K_J=float(place))

    spent = medians(5, moves=moves)["moves"] / len(places)
    ratio = spent / one["plain"]
    yield ("a move of K_J in Explorer", f"{1e3 * spent:.3g} ms", f"one plain f: {1e3 * one['plain']:.3g} ms",
           f"costs {ratio:.1f} of them", "")  # fmt: skip
    a, I3 = (grid.ravel() for grid in np.meshgrid(np.linspace(0.02, 0.5, 30), 0.399 * np.linspace(0.6, 1.9, 30)))
    spent = medians(5, shares=lambda: allowed_shares(a, 0.399, I3, K_R, MU_S))["shares"]
    yield ("allowed_shares(), tippe tops", f"{1e3 * spent / len(a):.3g} ms a top", "", f"{len(a) / spent:.0f} a second",
           "aim 3000" + ("" if len(a) / spent >= 3000 else " **missed**"))  # fmt: skip

    times = np.linspace(0, 400 * period, 10**6)
    for what, job in (("figures, 64 K_J", lambda: both(TOP, K_J, K_R, MU_S)),
                      ("figures, 4096 K_J", lambda: both(TOP, np.linspace(0, 8, 4096), K_R, MU_S)),
                      ("surface f, 512 x 512", lambda: f(np.linspace(0.01, 3.1, 512), TOP,
                                                         Constants(np.linspace(0, 8, 512)[:, None], K_R, 30.0))),
                      ("roll(), 10,000 samples", lambda: roll(TOP, MOTION, times[::100])),
                      ("roll(), 1,000,000 samples", lambda: roll(TOP, MOTION, times))):  # fmt: skip
        yield f"peak of memory, {what}", f"{peak(job):.3g} MB", "", "", ""

    yield from sliding.rows()

    spent = statistics.median(fresh(IMPORT) for _ in range(7))
    yield ("import tippe_core beyond numpy and scipy", f"{spent:.3f} s", "", "",
           "aim 0.3 s" + ("" if spent <= 0.3 else " **missed**"))  # fmt: skip
    bare = HERE / "bare.py"
    bare.write_text('import panel as pn\n\npn.panel("hello").servable()\n')
    try:
        starts = [(server_start(HERE.parent / "app", port), server_start(bare, port + 1)) for _ in range(3)]
    finally:
        bare.unlink()
    ours, peer = (statistics.median(column) for column in zip(*starts, strict=True))
    yield ("panel serve app, command to first page", f"{ours:.2f} s", f"a Panel page that says hello: {peer:.2f} s",
           f"{ours - peer:.2f} s more", "")  # fmt: skip


def processor():
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
        return next(line.split(":")[1].strip() for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.processor() or platform.machine()


def main():
    options = argparse.ArgumentParser(description="The core against its peers; appends to benchmarks/results.md.")
    options.add_argument("--repetitions", type=int, default=50)
    options.add_argument("--port", type=int, default=5130)
    options.add_argument("--note", default="", help="what else the machine was doing")
    chosen = options.parse_args()
    load = f"load {os.getloadavg()[0]:.1f}" if sys.platform != "win32" else ""
    lines = [f"## {datetime.date.today()}", "",
             ", ".join(part for part in (processor(), f"Python {platform.python_version()}", f"numpy {np.__version__}",
                       f"scipy {scipy.__version__}", f"heyoka {heyoka.__version__}", load, chosen.note) if part), "",
             "| what | tippe_core | peer | ratio | |", "|---|---|---|---|---|"]  # fmt: skip
    print("\n".join(lines), flush=True)
    for row in run(chosen.repetitions, chosen.port):
        lines.append("| " + " | ".join(row) + " |")
        print(lines[-1], flush=True)
    kept = HERE / "results.md"
    before = kept.read_text(encoding="utf-8") if kept.exists() else "# Results of make bench, newest last\n"
    kept.write_text(before + "\n" + "\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
