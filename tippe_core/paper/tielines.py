"""The largest motions of a rolling top: the tielines of Figs. 5 and 6."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import TopError, finite
from ..types import Array, Scalars
from . import equations as eq
from .constants import versines
from .limits import limits_of, lowest_of
from .poles import pole_offsets
from .top import Top
from .wells import ExactCurve, find_stations

POINTS = 20  # on each side of the steady precession


def crowded(cells: int) -> Array:
    """A grid of theta (rad) that is denser near the poles, where U is steep."""
    part = np.arange(cells + 1) / cells
    return np.pi * (part - 0.9 * np.sin(2 * np.pi * part) / (2 * np.pi))


GRID_V, GRID_M = versines(crowded(128))


@dataclass(frozen=True, eq=False)
class Tielines:
    """One tieline for each K_J, as arrays of its shape: the trajectory of largest energy on which the top neither
    leaves the table nor (if mu_s is given) slips.

    E: its energy (6), in MgR. theta_inner, theta_outer: its turning points, rad. theta_verge: where on it the limit is
    reached first. limited_by: "lift-off", "slip", "nothing" (E is inf: no energy violates the limit) or "no motion" (E
    is nan: even the steady precession violates it). theta_steady, E_steady: the steady precession of least energy.
    """

    K_J: Array
    E: Array
    theta_inner: Array
    theta_outer: Array
    theta_verge: Array
    limited_by: NDArray[np.str_]
    theta_steady: Array
    E_steady: Array


@overload
def limit_energy(top: Top, K_J: float, K_R: float, mu_s: float | None = None) -> float: ...
@overload
def limit_energy(top: Top, K_J: Array, K_R: float, mu_s: float | None = None) -> Array: ...
def limit_energy(top: Top, K_J: Scalars, K_R: float, mu_s: float | None = None) -> Scalars:
    """The largest E (6), in MgR, with F_z >= 0 (and F_h <= mu_s F_z if mu_s is given) on the whole trajectory.

    It is for the well around the steady precession of least energy. K_J: a number or an array; K_R, mu_s: numbers. inf
    where nothing limits the energy (a uniform ball), nan where even the steady precession violates the limit.
    """
    E = tielines(top, K_J, K_R, mu_s).E
    return E if np.ndim(K_J) else float(E)


def tielines(top: Top, K_J: ArrayLike, K_R: float, mu_s: float | None = None) -> Tielines:
    """The Tielines of Fig. 5 (mu_s None: F_z >= 0) or of Fig. 6 (also F_h <= mu_s F_z). K_J of any shape, K_R a
    number."""
    return limited(top, K_J, K_R, [mu_s])[0]


def figures(top: Top, K_J: ArrayLike, K_R: float, mu_s: float) -> tuple[Tielines, Tielines]:
    """(tielines of Fig. 5, tielines of Fig. 6), faster than by two calls of tielines()."""
    lift, slip = limited(top, K_J, K_R, [None, mu_s])
    return lift, slip


def limited(top: Top, K_J: ArrayLike, K_R: float, limits: Sequence[float | None]) -> list[Tielines]:
    """One Tielines for each of the limits: None for F_z >= 0 alone, or a value of mu_s."""
    shape, K_J = np.shape(K_J), np.asarray(K_J, dtype=float)
    if not np.all(np.isfinite(K_J)):
        raise TopError("K_J", float(K_J[~np.isfinite(K_J)].flat[0]), "finite numbers", code="not-finite")
    K_J, K_R = K_J.ravel(), finite("K_R", K_R)
    for mu in limits:
        if mu is not None and finite("mu_s", mu) < 0:
            raise TopError("mu_s", float(mu), "mu_s >= 0")
    offsets = np.stack(pole_offsets(top, K_J, K_R), axis=1)
    steady = steady_of_least_energy(top, K_J, K_R, offsets)
    pairs = np.array([(1.0, 0.0) if mu is None else (mu, 1.0) for mu in limits])
    with np.errstate(all="ignore"):  # without numba
        found, at_rest = limits_of(top.numbers, K_R, offsets, steady, pairs, POINTS)
    theta_p, E_p = at_rest[0], eq.E_of(at_rest[1], K_J, K_R, top)
    lines = []
    for mu, (e, inner, outer, verge, F_z) in zip(limits, found, strict=True):
        by = np.where((F_z > 1e-9) & (mu is not None), "slip", "lift-off")
        by = np.where(np.isnan(e), "no motion", np.where(np.isinf(e), "nothing", by))
        columns = K_J, eq.E_of(e, K_J, K_R, top), inner, outer, verge, by, theta_p, E_p
        lines.append(Tielines(*(column.reshape(shape) for column in columns)))
    return lines


def steady_of_least_energy(top: Top, K_J: Array, K_R: float, offsets: Array) -> Array:
    """The minimum of U: rows of x and side, see limits.py."""
    steady = lowest_of(GRID_V, GRID_M, top.numbers, K_R, offsets)
    for i in np.flatnonzero(steady[:, 2] == 0):
        bottoms = [s for s in find_stations(ExactCurve.of(top, K_J[i], K_R)) if s.bottom]
        if bottoms:  # else U is constant, as for a ball at rest with G at O: any tilt will do
            c = max(bottoms, key=lambda s: s.kinetic).c
            steady[i, :2] = (float(1 - c), 1.0) if c > 0 else (float(1 + c), -1.0)
    return steady
