"""The paper itself: the top, its constants of the motion, f(theta), the forces, and the limits that they set. Those in
__all__ are public beside the names of tippe_core, for a program that draws f and its limits."""

from . import equations
from .curve import rounded_f
from .equations import rolling_velocity
from .forces import forces_on_curve

__all__ = ["equations", "forces_on_curve", "rolling_velocity", "rounded_f"]
