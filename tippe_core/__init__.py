"""Tippe tops and other tops with round pegs, after C. G. Gray and B. G. Nickel, Am. J. Phys. 68, 821 (2000).

Units: lengths in R, masses in M, accelerations in g, so times in (R/g)^1/2. The names in __all__ are the public ones.
"""

from contextlib import suppress
from importlib.metadata import PackageNotFoundError, version

from .bodies.bare import BareSphere, StemmedSphere
from .bodies.files import load_top, save_top
from .bodies.presets import PRESETS, Preset
from .bodies.rocking import Measured, a_from_rocking, dimension_from_rocking, rocking_period
from .bodies.shape import Shape, Turned
from .bodies.shapes import Ball, Lathe, LoadedSphere, OrdinaryTop, TruncatedSphere
from .bodies.solids import Solid, ball, cylinder, frustum, zone
from .classify import UPRIGHT
from .endings import Ending, Stretch, ending
from .errors import NoMotionError, TopError
from .linear import spinning_modes, tumbling_modes
from .motion.friction import Contensou, Coulomb, Friction, SmoothedCoulomb, Viscous
from .motion.grip import grip
from .motion.many import Many, States, slide_many
from .motion.nudge import beside, growth, sensitivity
from .motion.preparing import strongest_friction
from .motion.pushing import pushed
from .motion.rolling import Rolling, roll
from .motion.sliding import Sliding, slide
from .motion.smooth import Gliding, glide
from .motion.trajectory import SUNK, Ledger, Trajectory, lowest
from .outcomes import Change, Outcome, SteadyStates, Thresholds, jellett_potential, outcome, steady_states, thresholds
from .paper.constants import Constants, State
from .paper.curve import f, f1_squared, f2_squared, f3_squared, omega2, omega3
from .paper.forces import friction_force, normal_force
from .paper.poles import pole_constants
from .paper.share import allowed_shares
from .paper.tielines import Tielines, lift_off_and_slip_tielines, limit_energy, tielines
from .paper.top import Scales, Top
from .paper.turning import SteadyPrecessions, steady_precessions, turning_points

__version__ = "unknown"  # sources that are not installed
for _installed in ("tippe-core", "tippe-top-explorer"):  # this alone, or with the page
    with suppress(PackageNotFoundError):
        __version__ = version(_installed)

__all__ = [
    "PRESETS", "SUNK", "UPRIGHT", "Ball", "BareSphere", "Change", "Constants", "Contensou", "Coulomb", "Ending",
    "Friction", "Gliding", "Lathe", "Ledger", "LoadedSphere", "Many", "Measured", "NoMotionError", "OrdinaryTop",
    "Outcome", "Preset", "Rolling", "Scales", "Shape", "Sliding", "SmoothedCoulomb", "Solid", "State", "States",
    "SteadyPrecessions", "SteadyStates", "StemmedSphere", "Stretch", "Thresholds", "Tielines", "Top", "TopError",
    "Trajectory", "TruncatedSphere", "Turned", "Viscous", "__version__", "a_from_rocking", "allowed_shares", "ball",
    "beside", "cylinder", "dimension_from_rocking", "ending", "f", "f1_squared", "f2_squared", "f3_squared",
    "friction_force", "frustum", "glide", "grip", "growth", "jellett_potential", "lift_off_and_slip_tielines",
    "limit_energy", "load_top", "lowest", "normal_force", "omega2", "omega3", "outcome", "pole_constants", "pushed",
    "rocking_period", "roll", "save_top", "sensitivity", "slide", "slide_many", "spinning_modes",
    "steady_precessions", "steady_states", "strongest_friction", "thresholds", "tielines", "tumbling_modes",
    "turning_points", "zone",
]  # fmt: skip
