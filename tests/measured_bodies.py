"""Films of tops that are no top of ours: moved by the tests' own rigid bodies, seen with noise."""

from types import MappingProxyType

import numpy as np
import rigid_body as rb
import sliding_body as sb
from scipy.optimize import least_squares

from app.model.measured.data import Data, Series, settled
from app.model.measured.fit import fit
from app.model.measured.motion import BOUNDS, model_of, residuals_of
from app.model.measured.table import read
from tippe_core import Scales, Top, TopError

FRAMES, RATE = 72, 60
OFTEN = 6  # times per frame at which the load is checked
ERRORS = {"tilt": np.radians(1.0), "spin": 2 * np.pi * 0.3, "azimuth": np.radians(1.5)}
KINDS = ("smoothed", "rolling", "viscous")
LOSSES = ("rolling_resistance", "air_drag")
LOSSY = range(2000, 2010)
"""Seeds of films with both losses."""
HARD = ("outliers", "gaps", "slow", "unstated", "side", "above")
"""Films as a class brings them: 5 % of the tilts wrong by 30 degrees; a quarter of the values missing, in two pieces;
25 frames a second; no errors stated; of two points on the axis, from the side and from above."""
WRONG, SHARE, SLOW, SLOW_FRAMES = np.radians(30), 0.05, 25, 40
APART, BLUR, CAMERA = 0.034, 2e-4, 0.7
"""m between the two points, m of noise in each place, rad: the camera's direction."""


def case(seed):
    """(kind, Top, Scales, truth {name: value}) of a seed."""
    rng = np.random.default_rng(seed)
    kind, I1 = KINDS[seed % 3 if seed not in LOSSY else 2 * (seed % 2)], rng.uniform(0.35, 0.5)
    top = Top(rng.uniform(0.05, 0.25), I1, I1 * rng.uniform(0.9, 1.1))
    truth = {"tilt": rng.uniform(0.15, 0.5), "spin": rng.uniform(6, 9) * rng.choice([-1, 1])}
    if kind == "rolling":
        truth |= {"tilt": rng.uniform(0.4, 1.2), "tilt_rate": rng.uniform(-0.3, 0.3), "across": rng.uniform(-1, 1)}
    elif kind == "smoothed":
        truth |= {"mu": rng.uniform(0.15, 0.45), "eps": rng.uniform(0.1, 0.4)}
    else:
        truth |= {"gamma": rng.uniform(0.1, 0.4)}
    if seed in LOSSY:
        truth |= {"rolling_resistance": rng.uniform(0.005, 0.02), "air_drag": rng.uniform(0.005, 0.012)}
    return kind, top, Scales(R=rng.uniform(0.015, 0.02), M=0.01), truth


def moved(seed, t):
    """(axis (n, 3), spin (n,) in rad/s) of a case at the times t (s), until its motion ends."""
    kind, top, scales, truth = case(seed)
    axis, spin = (_rolled if kind == "rolling" else _slid)(top, truth, t / scales.time)
    return axis, spin * scales.angular_velocity


def film(seed, what=("tilt", "spin"), frames=FRAMES, rate=RATE):
    """(the case, its Data with noise)."""
    t = np.arange(frames) / rate
    axis, spin = moved(seed, t)
    seen = {"tilt": np.arccos(axis[:, 2]), "spin": spin,
            "azimuth": np.unwrap(np.arctan2(axis[:, 1], axis[:, 0]))}  # fmt: skip
    rng, count = np.random.default_rng([seed, 1]), len(axis)
    series = {name: Series(t[:count], seen[name] + ERRORS[name] * rng.normal(size=count), ERRORS[name])
              for name in what}  # fmt: skip
    return case(seed), Data(MappingProxyType(series))


def how(seed):
    """A key of HARD for every fourth seed, of every kind alike, else ""."""
    return HARD[seed // 4 // 3 % len(HARD)] if seed % 4 == 3 else ""


def hard_film(seed, how):
    """(the case, its Data) of a film as a class brings it; how: a key of HARD, or ""."""
    if how in ("side", "above"):
        t = np.arange(FRAMES) / RATE
        table = read(tracked(("stem", "ball"), t, pictures(moved(seed, t)[0], how, seed)))
        return case(seed), settled(table.of("", how))
    found, data = film(seed, **({"frames": SLOW_FRAMES, "rate": SLOW} if how == "slow" else {}))
    rng, series = np.random.default_rng([seed, 2]), dict(data.series)
    if how == "outliers":
        tilt = series["tilt"]
        at = rng.choice(len(tilt.t), round(SHARE * len(tilt.t)), replace=False)
        tilt.values[at] += WRONG * rng.choice([-1, 1], len(at))
    elif how == "gaps":
        for name, each in series.items():
            size = len(each.t) // 8
            gone = [rng.integers(0, len(each.t) - size) + np.arange(size) for _ in range(2)]
            there = np.delete(np.arange(len(each.t)), np.concatenate(gone))
            series[name] = Series(each.t[there], each.values[there], each.error)
    elif how == "unstated":
        rows = zip(data.t, *(each.values for each in series.values()), strict=True)
        text = "".join("\t".join(f"{x:.6f}" for x in row) + "\n" for row in rows)
        return found, settled(read("t (s)\ttilt (rad)\tspin (rad/s)\n" + text))
    return found, Data(MappingProxyType(series))


def pictures(axis, view, seed=5, noise=BLUR):
    """(stem, ball), (n, 2) each, in m: what a camera sees from there, while the ball rolls about."""
    turned = axis[:, :2] @ np.array([[np.cos(CAMERA), -np.sin(CAMERA)], [np.sin(CAMERA), np.cos(CAMERA)]])
    vector = turned if view == "above" else np.column_stack([turned[:, 0], axis[:, 2]])
    t = np.arange(len(axis)) / RATE
    rolls = np.column_stack([0.01 * np.sin(9 * t), 0.01 * np.cos(7 * t)])
    ball = rolls if view == "above" else np.column_stack([rolls[:, 0], np.full(len(axis), 0.016)])
    rng = np.random.default_rng(seed)
    return [each + noise * rng.normal(size=each.shape) for each in (ball + APART * vector, ball)]


def tracked(names, t, points, error=BLUR):
    """A table of these points as Tracker writes it, with the error of a value behind its name."""
    head = "t\t" + "\t".join(f"{name} {axis} (m) \u00b1 {error}" for name in names for axis in "xy")
    rows = ["\t".join(f"{x:.6E}" for x in (when, *np.concatenate(row))) for when, *row in zip(t, *points, strict=False)]
    return "\n".join([head, *rows]) + "\n"


def _slid(top, truth, times):
    """(axis (n, 3), spin (n,)) with the law of friction written out, until the table would have to pull."""
    if "gamma" in truth:
        law = lambda u: truth["gamma"] * u  # noqa: E731
    else:
        law = lambda u: truth["mu"] * u / np.sqrt(u @ u + truth["eps"] ** 2)  # noqa: E731
    half = truth["tilt"] / 2
    axis = np.array([0.0, -np.sin(2 * half), np.cos(2 * half)])
    often = np.linspace(times[0], times[-1], OFTEN * (len(times) - 1) + 1)
    losses = tuple(truth.get(name, 0.0) for name in LOSSES)
    motion = sb.integrate(top, law, np.array([np.sin(half), 0, 0, np.cos(half)]), truth["spin"] * axis, np.zeros(3),
                          np.zeros(3), often, rtol=1e-8, losses=losses)  # fmt: skip
    axes = np.array([sb.matrix(q)[:, 2] for q in motion.quaternion])
    states = zip(axes, motion.omega, motion.velocity, strict=True)
    load = np.array([sb.accelerations(top, law, *state, losses)[2] for state in states])
    end = int(np.argmax(load < 0.05)) if load.min() < 0.05 else len(load)
    return axes[:end:OFTEN], (motion.omega * axes).sum(axis=1)[:end:OFTEN]


def _rolled(top, truth, times):
    omega = rb.to_body(0.0, truth["tilt_rate"], truth["across"], truth["spin"])
    motion = rb.integrate(rb.Body.of(top), rb.euler_quaternion(0.0, truth["tilt"], 0.0), omega, times)
    axis = np.zeros((3, len(times)))
    axis[2] = 1
    axes = rb.rotate(motion.quaternion.T, axis.astype(motion.quaternion.dtype)).T.astype(float)
    return axes, motion.omega_body[:, 2].astype(float)


def recovered(seed):
    """[(name, how many standard errors the fit is off the truth)] of the numbers that it says it knows, and the Fit."""
    (kind, top, scales, truth), data = film(seed)
    found = fit(model_of(kind, top, scales), data)
    return off_truth(found, truth), found


def off_truth(found, truth):
    """[(name, how many standard errors it is off the truth, of the side on which that lies)] of what it knows. Of a
    motion that the data do not tell from its mirror image, the truth is the one with a positive spin."""
    rows, way = [], 1 if found.handed else np.sign(truth["spin"])
    truth = truth | {name: way * truth[name] for name in ("spin", "across") if name in truth}
    for name in found.model.free:
        if name not in found.unknown:
            off = found.model.values[name] - truth[name]
            rows.append((name, off / found.sides[name][int(off < 0)]))
    return rows


def other_value(found, data, name, truth):
    """A value half as large, or half as large again, or further away than two of its errors, or at the end of what is
    possible, with which the others, fitted anew from what was found, from its mirror and from the truth, leave less
    than 4 more of chi-square; None where there is none."""
    names, value = [each for each in found.model.free if each != name], found.model.values[name]
    least, (low, high) = found.chi2, BOUNDS[name]
    below, above = found.sides[name]
    limits = np.array([BOUNDS[each] for each in names]).T
    here = found.model.values
    mirrored = {**here, **{each: -here[each] for each in ("tilt_rate",) if each in names}}
    for there in (0.5 * value, 1.5 * value, value - 2.5 * below, value + 2.5 * above, low, high):
        held = found.model.with_values({name: float(np.clip(there, low, high))})

        def rest(x, held=held):
            try:
                return residuals_of(held.with_values(dict(zip(names, map(float, x), strict=True))), data).row
            except TopError:
                return np.full(len(found.residuals.row), 1e4)

        for start in (here, mirrored, {**here, **truth}):
            x = np.clip([start[each] for each in names], limits[0] + 1e-6, limits[1] - 1e-6)
            best = least_squares(rest, x, bounds=limits, x_scale=np.maximum(np.abs(x), 0.05), diff_step=1e-4)
            if 2 * best.cost < least + 4:
                return float(held.values[name])
    return None
