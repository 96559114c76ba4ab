"""Tippe tops and other tops with round pegs, after C. G. Gray and B. G. Nickel, Am. J. Phys. 68, 821 (2000).

Lengths in R, masses in M, accelerations in g. The names below are the public ones.
"""

from .constants import Constants, State
from .curve import (
    SteadyPrecessions,
    f,
    f1_squared,
    f2_squared,
    f3_squared,
    omega2,
    omega3,
    pole_constants,
    steady_precessions,
    turning_points,
)
from .errors import NoMotionError, TopError
from .forces import friction_force, normal_force
from .rolling import Rolling, roll
from .tielines import Tielines, figures, limit_energy, tielines
from .top import Scales, Top
from .trajectory import Trajectory

__all__ = [
    "Constants",
    "NoMotionError",
    "Rolling",
    "Scales",
    "State",
    "SteadyPrecessions",
    "Tielines",
    "Top",
    "TopError",
    "Trajectory",
    "f",
    "f1_squared",
    "f2_squared",
    "f3_squared",
    "figures",
    "friction_force",
    "limit_energy",
    "normal_force",
    "omega2",
    "omega3",
    "pole_constants",
    "roll",
    "steady_precessions",
    "tielines",
    "turning_points",
]
