"""Bodies that can be made, and their mass properties as a Top. Those in __all__ are public beside the names of
tippe_core, for a program that draws bodies, or reads them from files."""

from .files import LONGEST, given, names_of
from .inside import STEEL, across
from .shape import OneMaterial
from .shapes import KINDS
from .slices import LARGEST

__all__ = ["KINDS", "LARGEST", "LONGEST", "STEEL", "OneMaterial", "across", "given", "names_of"]
