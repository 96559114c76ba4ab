"""Figs. 5 and 6 of one top compared with others, and the share of Fig. 5's region without slipping for many tops."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from app.model.region import between
from tippe_core import (
    PRESETS,
    Constants,
    OrdinaryTop,
    Tielines,
    Top,
    allowed_shares,
    f,
    f1_squared,
    lift_off_and_slip_tielines,
    pole_constants,
)
from tippe_core.types import Array

TIELINES, POINTS = 48, 40


@dataclass(frozen=True, eq=False)
class Region:
    """Figs. 5 and 6 of one top: its name, K_J(P), and the tielines of both limits at part (n,) = K_J/K_J(P), 0 to 1.

    theta, height (n, m): f1^2 theta_dot^2 of Fig. 5 on the tielines of lift-off, in units of K_R^2, so that tops with
    different spins have the same scale.
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
    """The Region of a top, from the tielines of tippe_core."""
    pole = pole_constants(top, K_R)[0]
    part = (np.arange(count) + 0.5) / count
    lift, slip = lift_off_and_slip_tielines(top, part * pole, K_R, mu_s)
    theta = between(lift.theta_inner, lift.theta_outer, POINTS)
    limited = np.isfinite(lift.E)
    rows = Constants((part * pole)[:, None], K_R, np.where(limited, lift.E, lift.E_steady)[:, None])
    height = np.maximum(f1_squared(theta, top) * f(theta, top, rows), 0) / (K_R**2 or 1)
    height[~limited] = np.nan
    return Region(name, top, float(pole), part, lift, slip, theta, height)


@dataclass(frozen=True, eq=False)
class Map:
    """The share (m, n) over I3/I1 (m,) and a (n,); nan where there is no such top, or in rows not computed yet."""

    a: Array
    ratio: Array
    share: Array


def share_map(I1: float, K_R: float, mu_s: float, a: Array, ratio: Array) -> Iterator[tuple[int, Map]]:
    """Yields (tops done, the Map so far) after every row; a caller that stops iterating stops it."""
    share = np.full((len(ratio), len(a)), np.nan)
    for row, part in enumerate(ratio):
        share[row] = allowed_shares(a, I1, I1 * part, K_R, mu_s)
        yield (row + 1) * len(a), Map(a, ratio, share.copy())


def ordinary() -> OrdinaryTop:
    """The preset of an ordinary top with a/R near -10."""
    shapes = (preset.shape for preset in PRESETS)
    return next(shape for shape in shapes if isinstance(shape, OrdinaryTop) and shape.top.a < -5)
