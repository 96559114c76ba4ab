"""The largest motions of a rolling top: the tielines of Figs. 5 and 6."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import checked, finite, numbers, positive, read_only
from ..types import Array, Like, Number
from . import equations as eq
from .constants import versines
from .limits import least_U_of, limits_of
from .poles import pole_offsets
from .top import Top
from .wells import ExactCurve, find_stations

POINTS = 20  # on each side of the steady precession


def tilts_near_poles(cells: int) -> Array:
    """A grid of theta (rad) that is denser near the poles, where U is steep."""
    part = np.arange(cells + 1) / cells
    return np.pi * (part - 0.9 * np.sin(2 * np.pi * part) / (2 * np.pi))


GRID_V, GRID_M = versines(tilts_near_poles(128))


@dataclass(frozen=True, eq=False)
class Tielines:
    """One tieline for each K_J: the trajectory of largest energy on which the top neither leaves the table nor (if mu_s
    is given) slips. Read-only arrays of the shape of K_J.

    Attributes
    ----------
    K_J : array
        (30), in (g/R)^1/2
    E : array
        its energy (6), in MgR
    theta_inner, theta_outer : array
        its turning points, rad
    theta_verge : array
        where on it the limit is reached first, rad
    limited_by : array of str
        "lift-off", "slip", "nothing" (E is inf: no energy violates the limit) or "no motion" (E is nan: even the
        steady precession violates it)
    theta_steady, E_steady : array
        the steady precession of least energy, rad and MgR
    """

    K_J: Array
    E: Array
    theta_inner: Array
    theta_outer: Array
    theta_verge: Array
    limited_by: NDArray[np.str_]
    theta_steady: Array
    E_steady: Array


@checked
def limit_energy(top: Top, K_J: Like, K_R: float, mu_s: float | None = None) -> Like:
    """The largest E (6) with F_z >= 0, and F_h <= mu_s F_z where mu_s is given, on the whole trajectory.

    It is for the well around the steady precession of least energy.

    Parameters
    ----------
    top : Top
        the top
    K_J : float or array
        (30), in (g/R)^1/2, of any shape
    K_R : float
        (31), in (MgR)^1/2
    mu_s : float or None
        coefficient of static friction, 0 or more

    Returns
    -------
    float or array
        in MgR; inf where nothing limits the energy (a uniform ball), nan where even the steady precession violates
        the limit

    Raises
    ------
    TopError
        for anything else, with the name, the value and the allowed range
    """
    E: Number = tielines(top, K_J, K_R, mu_s).E
    return E if np.ndim(K_J) else E.item()


@checked
def tielines(top: Top, K_J: ArrayLike, K_R: float, mu_s: float | None = None) -> Tielines:
    """The tielines of Fig. 5 (F_z >= 0) or of Fig. 6 (also F_h <= mu_s F_z).

    Parameters
    ----------
    top : Top
        the top
    K_J : float or array
        (30), in (g/R)^1/2, of any shape
    K_R : float
        (31), in (MgR)^1/2
    mu_s : float or None
        coefficient of static friction, 0 or more; None for Fig. 5

    Returns
    -------
    Tielines
        arrays of the shape of K_J

    Raises
    ------
    TopError
        for anything else, with the name, the value and the allowed range
    """
    return limited(top, K_J, K_R, [mu_s])[0]


@checked
def lift_off_and_slip_tielines(top: Top, K_J: ArrayLike, K_R: float, mu_s: float) -> tuple[Tielines, Tielines]:
    """The tielines of Figs. 5 and 6, faster than by two calls of tielines().

    Parameters
    ----------
    top : Top
        the top
    K_J : float or array
        (30), in (g/R)^1/2, of any shape
    K_R : float
        (31), in (MgR)^1/2
    mu_s : float
        coefficient of static friction, 0 or more

    Returns
    -------
    tuple of two Tielines
        with F_z >= 0 alone, and with F_h <= mu_s F_z

    Raises
    ------
    TopError
        for anything else, with the name, the value and the allowed range
    """
    lift, slip = limited(top, K_J, K_R, [None, mu_s])
    return lift, slip


def limited(top: Top, K_J: ArrayLike, K_R: float, limits: Sequence[float | None]) -> list[Tielines]:
    """One Tielines for each of the limits: None for F_z >= 0 alone, or a value of mu_s."""
    shape, K_J, K_R = np.shape(K_J), numbers("K_J", K_J).ravel(), finite("K_R", K_R)
    for mu in limits:
        if mu is not None:
            positive("mu_s", mu, zero=True)
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
        parts: list[Number] = [column.reshape(shape) for column in columns]
        read_only(*parts)
        lines.append(Tielines(*parts))
    return lines


def steady_of_least_energy(top: Top, K_J: Array, K_R: float, offsets: Array) -> Array:
    """The minimum of U: rows of x and side, see limits.py."""
    steady = least_U_of(GRID_V, GRID_M, top.numbers, K_R, offsets)
    for i in np.flatnonzero(steady[:, 2] == 0):
        bottoms = [s for s in find_stations(ExactCurve.of(top, K_J[i], K_R)) if s.bottom]
        if bottoms:  # else U is constant, as for a ball at rest with G at O: any tilt will do
            c = max(bottoms, key=lambda s: s.kinetic).c
            steady[i, :2] = (float(1 - c), 1.0) if c > 0 else (float(1 + c), -1.0)
    return steady
