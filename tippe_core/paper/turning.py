"""What a rolling top may do at given constants: its steady precessions, and the ranges of theta in which it moves."""

from decimal import localcontext
from typing import NamedTuple

import numpy as np

from ..errors import checked
from ..types import Array, Bools
from .constants import EXACT, Constants, Exact
from .top import Top
from .wells import ExactCurve, exact_angle, find_stations, wells


class SteadyPrecessions(NamedTuple):
    """The steady precessions at given K_J and K_R.

    Attributes
    ----------
    theta : array (k,)
        tilts in rad, ascending
    stable : array of bool (k,)
        True at minima of U
    """

    theta: Array
    stable: Bools


@checked
def steady_precessions(top: Top, K_J: float, K_R: float) -> SteadyPrecessions:
    """The steady precessions f = f' = 0 at K_J and K_R. Stable (f'' < 0) means a minimum of U.

    Parameters
    ----------
    top : Top
        the top
    K_J, K_R : float
        (30) and (31), in (g/R)^1/2 and (MgR)^1/2

    Returns
    -------
    SteadyPrecessions
        theta in (0, pi), or 0 or pi itself if K_J is exactly that of the pole

    Raises
    ------
    TopError
        for anything else, with the name, the value and the allowed range
    """
    with localcontext(EXACT):
        stations = [s for s in find_stations(ExactCurve.of(top, K_J, K_R)) if s.kinetic.is_finite()]
        return SteadyPrecessions(
            np.array([exact_angle(s.c) for s in stations]), np.array([s.bottom for s in stations], bool)
        )


@checked
def turning_points(top: Top, constants: Constants) -> Array:
    """The intervals of theta in which f >= 0.

    Parameters
    ----------
    top : Top
        the top
    constants : Constants
        numbers

    Returns
    -------
    array (k, 2)
        theta in rad, one row for each interval, from theta = 0 upwards; for a steady precession both ends are equal

    Raises
    ------
    NoMotionError
        if f < 0 everywhere
    """
    return np.array(
        [[exact_angle(w.inner), exact_angle(w.outer)] for w in wells(ExactCurve(top, Exact.of(constants, top)))]
    )
