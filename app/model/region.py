"""The plane of K_J and theta, Figs. 5 and 6: all tielines of one top at one K_R and mu_s."""

from dataclasses import dataclass
from functools import lru_cache
from typing import Literal, TypeAlias

import numpy as np

from tippe_core import (
    Constants,
    Tielines,
    Top,
    f1_squared,
    f2_squared,
    lift_off_and_slip_tielines,
    omega2,
    pole_constants,
)
from tippe_core.paper import forces_on_curve, rounded_f
from tippe_core.types import Array, Scalars

LEAST_TIELINES = 48
MESH_COLUMNS = 48
HOVER_COLUMNS = 128  # over all tilts: 1.4 degrees each

PAPER: Literal["paper"] = "paper"
Upper: TypeAlias = bool | Literal["paper"]
"""The part of the plane that is shown: True, K_J from 0 to P and all tilts; False, past both poles; PAPER, K_J from 0
to P and the tilts of the paper's own figure."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Plane:
    """What Figs. 5 and 6 show for one top at one K_R and mu_s: all tielines, whichever motion is selected.

    K_J (n,) ascending; lift and slip are tippe_core's Tielines at these K_J for the two limits (F_z >= 0 alone, and F_h
    <= mu_s F_z as well). theta, height (n, m): the mesh of f1^2 theta_dot^2 in Fig. 5 on the tielines of `surface`,
    each row from its inner to its outer turning point; surface_range: the range of theta. hover_theta (k,), hover_K_J
    (j,): where hover_E and hover_ratio (j, k) are given: on each tieline of the slip limit for its own motion, beyond
    its ends for the motion of least energy that reaches this tilt.
    """

    K_J: Array
    lift: Tielines
    slip: Tielines
    surface: Tielines
    theta: Array
    height: Array
    K_J_range: tuple[float, float]
    theta_range: tuple[float, float]
    surface_range: tuple[float, float]
    limit: str
    pole: float
    pole_height: float
    hover_theta: Array
    hover_K_J: Array
    hover_E: Array
    hover_ratio: Array


def between(inner: Scalars, outer: Scalars, columns: int) -> Array:
    """Angles from inner to outer, denser near the ends; (..., columns)."""
    share = (1 - np.cos(np.linspace(0, np.pi, columns))) / 2
    inner, outer = np.asarray(inner)[..., None], np.asarray(outer)[..., None]
    return inner + (outer - inner) * share


def height(theta: Array, top: Top, constants: Constants) -> Array:
    """f1^2 theta_dot^2 of (36), and 0 at those ends of the last axis that are turning points in (0, pi)."""
    value = f1_squared(theta, top) * rounded_f(theta, top, constants)
    return np.maximum(value, 0)


def K_J_range(top: Top, K_J: float, K_R: float, upper: Upper) -> tuple[float, float]:
    """The range of K_J: from 0 to P, or past both poles; in any case it includes K_J."""
    poles = pole_constants(top, K_R)
    beyond = 0.25 * max(map(abs, poles))
    low, high = sorted((0.0, poles[0])) if upper else (min(poles) - beyond, max(poles) + beyond)
    if high - low < 1e-9:
        low, high = -1.0, 1.0
    # In whole steps, so that the picture does not change at each step of a K_J outside.
    if K_J < low:
        low = float(np.floor(K_J - 0.5))
    if K_J > high:
        high = float(np.ceil(K_J + 0.5))
    return float(low), float(high)


@lru_cache(maxsize=8)
def plane(top: Top, K_R: float, mu_s: float, upper: Upper, limit: str, low: float, high: float) -> Plane:
    """The Plane. The same arguments give the same object, so a view can tell by identity that nothing has changed."""
    poles = pole_constants(top, K_R)
    step = 2.0 ** np.floor(np.log2((high - low) / LEAST_TIELINES))
    even = step * np.arange(np.ceil(low / step - 1e-9), np.floor(high / step + 1e-9) + 1)
    K_J = np.union1d(even, [pole for pole in poles if low <= pole <= high])
    lift, slip = lift_off_and_slip_tielines(top, K_J, K_R, mu_s)
    surface = lift if limit == "lift-off" else slip

    limited = np.isfinite(surface.E)
    theta = between(surface.theta_inner, surface.theta_outer, MESH_COLUMNS)
    rows = Constants(K_J[:, None], K_R, np.where(limited, surface.E, surface.E_steady)[:, None])
    heights = np.where(limited[:, None], height(theta, top, rows), np.nan)

    surface_end = max(np.pi / 2, np.nanmax(lift.theta_outer, initial=0.0)) * 1.03 if upper else np.pi
    theta_end = surface_end if upper == PAPER else np.pi
    hover_theta = theta_end * (np.arange(HOVER_COLUMNS) + 0.5) / HOVER_COLUMNS
    own = np.isin(K_J, even)
    hover_E, hover_ratio = everywhere(top, hover_theta, K_J[own], K_R, slip.E[own])
    pole = poles[0]
    at_pole = np.flatnonzero(K_J == pole)
    return Plane(
        K_J=K_J, lift=lift, slip=slip, surface=surface, theta=theta, height=heights, K_J_range=(low, high),
        theta_range=(0.0, float(theta_end)), surface_range=(0.0, float(surface_end)), limit=limit, pole=float(pole),
        pole_height=float(heights[at_pole].max(initial=0.0)) if at_pole.size else 0.0, hover_theta=hover_theta,
        hover_K_J=even, hover_E=hover_E, hover_ratio=hover_ratio,
    )  # fmt: skip


def least_energy(theta: Array, top: Top, K_J: Scalars, K_R: Scalars) -> Array:
    """E of the motion that turns at theta: (33) with theta_dot = 0, 2E' = 2a(1 - c) + f2^2 w2^2."""
    w2 = omega2(theta, top, Constants(K_J, K_R, 0.0))
    two_E_prime = 2 * top.a * (1 - np.cos(theta)) + f2_squared(theta, top) * w2**2
    return (two_E_prime + K_R**2 - top.I1 / top.I3 * K_J**2) / 2


def everywhere(top: Top, theta: Array, K_J: Array, K_R: float, E_limit: Array) -> tuple[Array, Array]:
    """E and F_h/F_z at (K_J, theta), each (len(K_J), len(theta)); F_h/F_z is inf where F_z <= 0."""
    theta, K_J = theta[None, :], K_J[:, None]
    E = np.fmax(least_energy(theta, top, K_J, K_R), np.where(np.isfinite(E_limit), E_limit, np.nan)[:, None])
    constants = Constants(K_J, K_R, E)
    # At a turning point rounding may leave f just below 0, where theta_dot is not real.
    w1_squared = np.maximum(rounded_f(theta, top, constants), 0)
    F_x, F_y, F_z = forces_on_curve(theta, top, constants, w1_squared)
    with np.errstate(divide="ignore", invalid="ignore"):
        return E, np.where(F_z > 0, np.hypot(F_x, F_y) / F_z, np.inf)
