"""Many tops at once: Figs. 5 and 6 of several side by side, and how much of Fig. 5's region friction leaves them."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from app.model.builder import thrown
from app.model.dimensions import named
from tippe_core import (
    PRESETS,
    Constants,
    OrdinaryTop,
    Tielines,
    Top,
    TopError,
    allowed_shares,
    f,
    f1_squared,
    figures,
    pole_constants,
)
from tippe_core.types import Array

TIELINES, POINTS = 48, 40
PEGS = (0.0, 0.0036, 0.0072, 0.0108, 0.0162)  # m, the last one the preset's own


@dataclass(frozen=True, eq=False)
class Region:
    """Figs. 5 and 6 of one top: its name, K_J(P), and the tielines of both limits at part (n,) = K_J/K_J(P), 0 to 1.

    theta, height (n, m): Fig. 5's f1^2 theta_dot^2 on the tielines of lift-off, in units of K_R^2, so that tops spun
    differently have one scale.
    """

    name: str
    top: Top
    pole: float
    part: Array
    lift: Tielines
    slip: Tielines
    theta: Array
    height: Array


def region(name: str, top: Top, K_R: float, mu_s: float, count: int = TIELINES) -> Region:
    """The Region of a top, from tippe_core's own tielines."""
    pole = pole_constants(top, K_R)[0]
    part = (np.arange(count) + 0.5) / count
    lift, slip = figures(top, part * pole, K_R, mu_s)
    share = (1 - np.cos(np.linspace(0, np.pi, POINTS))) / 2
    theta = lift.theta_inner[:, None] + (lift.theta_outer - lift.theta_inner)[:, None] * share
    limited = np.isfinite(lift.E)
    rows = Constants((part * pole)[:, None], K_R, np.where(limited, lift.E, lift.E_steady)[:, None])
    height = np.maximum(f1_squared(theta, top) * f(theta, top, rows), 0) / (K_R**2 or 1)
    height[~limited] = np.nan
    return Region(name, top, float(pole), part, lift, slip, theta, height)


@dataclass(frozen=True, eq=False)
class Map:
    """The share (m, n) over I3/I1 (m,) and a (n,), nan where there is no such top, or its row is not done."""

    a: Array
    ratio: Array
    share: Array


def share_map(I1: float, K_R: float, mu_s: float, a: Array, ratio: Array) -> Iterator[tuple[int, Map]]:
    """Yields (tops done, the Map so far) after every row. Whoever stops taking has stopped it."""
    share = np.full((len(ratio), len(a)), np.nan)
    for row, part in enumerate(ratio):
        share[row] = allowed_shares(a, I1, I1 * part, K_R, mu_s)
        yield (row + 1) * len(a), Map(a, ratio, share.copy())


def presets() -> list[tuple[str, Top, float]]:
    """[(name, Top, K_R)]: every preset, thrown as a new body is; of two with one shape the first."""
    first = {preset.shape: preset for preset in reversed(PRESETS)}
    return [(named(preset.name), preset.top, thrown(preset.shape, preset.top)[1])
            for preset in PRESETS if first[preset.shape] is preset]  # fmt: skip


def pegs() -> list[tuple[str, Top, float]]:
    """[(name, Top, K_R)]: ordinary tops, the disc on pegs of several lengths, a/R to about -10, all with one spin."""
    disc = ordinary()
    bodies = [replace(disc, h=h) for h in PEGS]
    return [(f"a = {body.top.a:.3g}".replace("-", "−"), body.top, thrown(body)[1]) for body in bodies]


def ordinary() -> OrdinaryTop:
    """The preset that is an ordinary top with a/R near -10."""
    shapes = (preset.shape for preset in PRESETS)
    return next(shape for shape in shapes if isinstance(shape, OrdinaryTop) and shape.top.a < -5)


def neighbours(top: Top, which: str) -> list[tuple[str, Top]]:
    """[(name, Top)]: up to five tops with "a", or with "I3" at this I1, from half of this top's to one and a half."""
    tops = []
    for factor in (0.5, 0.75, 1.0, 1.25, 1.5):
        try:
            if which == "a":
                named = f"a = {factor * top.a:.3g}", Top(factor * top.a, top.I1, top.I3)
            else:
                named = f"I₃/I₁ = {factor * top.I3 / top.I1:.3g}", Top(top.a, top.I1, factor * top.I3)
        except TopError:
            continue  # half the family may not exist, such as I3 > 2 I1
        tops.append((named[0].replace("-", "−"), named[1]))
    return tops
