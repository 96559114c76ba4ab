"""Films of tops that are no top of ours: moved by the tests' own rigid bodies, seen with noise."""

from types import MappingProxyType

import numpy as np
import rigid_body as rb
import sliding_body as sb
from scipy.optimize import least_squares

from app.model.measured.data import Data, Series
from app.model.measured.fit import fit
from app.model.measured.motion import BOUNDS, model_of, residuals_of
from tippe_core import Scales, Top, TopError

FRAMES, RATE = 72, 60
OFTEN = 6  # times per frame at which the load is checked
ERRORS = {"tilt": np.radians(1.0), "spin": 2 * np.pi * 0.3, "azimuth": np.radians(1.5)}
KINDS = ("smoothed", "rolling", "viscous")
LOSSES = ("rolling_resistance", "air_drag")
LOSSY = range(2000, 2010)
"""Seeds of films with both losses."""


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


def film(seed, what=("tilt", "spin")):
    """(the case, its Data with noise)."""
    kind, top, scales, truth = found = case(seed)
    t = np.arange(FRAMES) / RATE
    axis, spin = _rolled(top, truth, t / scales.time) if kind == "rolling" else _slid(top, truth, t / scales.time)
    seen = {"tilt": np.arccos(axis[:, 2]), "spin": spin * scales.angular_velocity,
            "azimuth": np.unwrap(np.arctan2(axis[:, 1], axis[:, 0]))}  # fmt: skip
    rng, count = np.random.default_rng([seed, 1]), len(axis)
    series = {name: Series(t[:count], seen[name] + ERRORS[name] * rng.normal(size=count), ERRORS[name])
              for name in what}  # fmt: skip
    return found, Data(MappingProxyType(series))


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
    """[(name, how many standard errors it is off the truth, of the side on which that lies)] of what it knows."""
    rows = []
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
