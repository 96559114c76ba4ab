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
from .ending import SUNK, UPRIGHT, Ending, Stretch, ending, lowest, sunk
from .errors import NoMotionError, TopError
from .forces import friction_force, normal_force
from .friction import Coulomb, SmoothedCoulomb, Viscous
from .outcome import Change, Outcome, SteadyStates, Thresholds, jellett_potential, outcome, steady_states, thresholds
from .rolling import Rolling, roll
from .shapes import (
    PRESETS,
    Ball,
    BareSphere,
    Lathe,
    LoadedSphere,
    Measured,
    OrdinaryTop,
    Preset,
    Shape,
    TruncatedSphere,
    Turned,
    a_from_rocking,
    dimension_from_rocking,
    load_top,
    rocking_period,
    save_top,
)
from .share import allowed_shares
from .sliding import beside, growth, sensitivity, slide
from .smooth import Gliding, glide
from .solids import Solid, ball, cylinder, frustum, zone
from .tielines import Tielines, figures, limit_energy, tielines
from .top import Scales, Top
from .trajectory import Ledger, Trajectory

__all__ = [
    "PRESETS",
    "SUNK",
    "UPRIGHT",
    "Ball",
    "BareSphere",
    "Change",
    "Constants",
    "Coulomb",
    "Ending",
    "Gliding",
    "Lathe",
    "Ledger",
    "LoadedSphere",
    "Measured",
    "NoMotionError",
    "OrdinaryTop",
    "Outcome",
    "Preset",
    "Rolling",
    "Scales",
    "Shape",
    "SmoothedCoulomb",
    "Solid",
    "State",
    "SteadyPrecessions",
    "SteadyStates",
    "Stretch",
    "Thresholds",
    "Tielines",
    "Top",
    "TopError",
    "Trajectory",
    "TruncatedSphere",
    "Turned",
    "Viscous",
    "a_from_rocking",
    "allowed_shares",
    "ball",
    "beside",
    "cylinder",
    "dimension_from_rocking",
    "ending",
    "f",
    "f1_squared",
    "f2_squared",
    "f3_squared",
    "figures",
    "friction_force",
    "frustum",
    "glide",
    "growth",
    "jellett_potential",
    "limit_energy",
    "load_top",
    "lowest",
    "normal_force",
    "omega2",
    "omega3",
    "outcome",
    "pole_constants",
    "rocking_period",
    "roll",
    "save_top",
    "sensitivity",
    "slide",
    "steady_precessions",
    "steady_states",
    "sunk",
    "thresholds",
    "tielines",
    "turning_points",
    "zone",
]
