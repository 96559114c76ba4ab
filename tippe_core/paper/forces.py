"""The forces at the contact point, equations (37) to (39), as functions of theta."""

import numpy as np

from ..errors import checked_many
from ..types import Like, Scalars, Vector
from . import equations as eq
from .constants import Constants, versines
from .curve import f, omega2, omega3
from .top import Top


def forces_on_curve(theta: Scalars, top: Top, constants: Constants, w1_squared: Scalars) -> Vector:
    """(F_x, F_y, F_z) of (37) to (39), in Mg, for theta_dot > 0 and theta_dot^2 = w1_squared."""
    v, m = versines(theta)
    w2, w3 = (function(theta, top, constants) for function in (omega2, omega3))
    with np.errstate(invalid="ignore"):
        return eq.force(1 - v, np.sqrt(v * m), np.sqrt(w1_squared), w1_squared, w2, w3, top)


@checked_many
def normal_force(theta: Like, top: Top, constants: Constants) -> Like:
    """F_z = 1 + a (s f'/2 + c f), (37).

    Parameters
    ----------
    theta : float or array
        tilt in rad; broadcasts
    top : Top
        the top
    constants : Constants
        K_J, K_R and E; they broadcast with theta

    Returns
    -------
    float or array
        in Mg; nan at a pole that no motion with this K_J can reach

    Raises
    ------
    TopError
        for anything else, with the name, the value and the allowed range
    """
    return forces_on_curve(theta, top, constants, f(theta, top, constants))[2]


@checked_many
def friction_force(theta: Like, top: Top, constants: Constants) -> tuple[Like, Like]:
    """(F_x, F_y) for theta_dot > 0, (38) and (39); F_x changes sign with theta_dot.

    Parameters
    ----------
    theta : float or array
        tilt in rad; broadcasts
    top : Top
        the top
    constants : Constants
        K_J, K_R and E; they broadcast with theta

    Returns
    -------
    tuple of two: float or array
        in Mg: F_x along 1' (the line of nodes), nan where f < 0, and F_y along z cross 1'

    Raises
    ------
    TopError
        for anything else, with the name, the value and the allowed range
    """
    return forces_on_curve(theta, top, constants, f(theta, top, constants))[:2]
