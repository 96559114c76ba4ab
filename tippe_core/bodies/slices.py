"""Slices of solids of revolution about axis 3: exact masses and moments of inertia, in SI units.

Every piece is a slice between two heights z (above O, along axis 3) whose squared radius rho^2 is a quadratic in z: a
zone of a sphere, rho^2 = R^2 - (z - centre)^2, or a frustum of a cone, including cylinders. For a density D

    M = pi D int rho^2 dz,    M z_G = pi D int rho^2 z dz,    int z^2 dm = pi D int rho^2 z^2 dz,
    I3 = (pi/2) D int rho^4 dz,    I1 = I3/2 + int z^2 dm - M z_G^2,

and all integrands are polynomials of degree four at most, which three-point Gauss quadrature integrates exactly.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..errors import TopError, finite
from ..types import Array, Scalars

LARGEST = 1e3  # m: larger than any top, and no power of it overflows
DENSEST = 1e9  # kg/m^3
SAME = 1e-7  # relative to the solid's size: closer points count as one, also in the single precision of an STL file
EMPTY = 1e-9  # relative to the largest density: less is a rounding error
NODES, WEIGHTS = np.sqrt(0.6) * np.array([-1, 0, 1]), np.array([5, 8, 5]) / 9  # Gauss quadrature on (-1, 1)


@dataclass(frozen=True, kw_only=True)
class Slice(ABC):
    """A solid between the heights low and high (m), with a density (kg/m^3), negative if it removes material."""

    low: float
    high: float
    density: float = 1.0

    def __post_init__(self) -> None:
        for name in self.__dataclass_fields__:
            object.__setattr__(self, name, finite(name, getattr(self, name)))
            most = DENSEST if name == "density" else LARGEST
            if abs(getattr(self, name)) > most:
                raise TopError(name, getattr(self, name), f"-{most:g} <= {name} <= {most:g} (SI)")
        if not self.low < self.high:
            raise TopError("high", self.high, "{range} ({unit})", range=f"high > low = {self.low:g}", unit="m")

    @property
    @abstractmethod
    def widest(self) -> float:
        """The largest radius."""

    @abstractmethod
    def radius(self, z: Scalars) -> Array:
        """The radius (m) at the heights z, of any shape."""

    @property
    @abstractmethod
    def square(self) -> Array:
        """The coefficients (3,) of z^2, z, 1 in rho^2."""

    @cached_property
    def moments(self) -> Array:
        """M, M z_G, int z^2 dm, I3: (4,)."""
        half, middle = (self.high - self.low) / 2, (self.low + self.high) / 2
        z = middle + half * NODES
        square = self.radius(z) ** 2
        weighed = np.pi * self.density * half * WEIGHTS * square
        mass = weighed.sum()
        # first about the middle, so that G of a ball is O exactly, in whatever order the machine sums
        first = middle * mass + half * NODES[2] * (weighed[2] - weighed[0])
        return np.array([mass, first, (weighed * z**2).sum(), (weighed * square).sum() / 2])


@dataclass(frozen=True, kw_only=True)
class Zone(Slice):
    """A zone (or cap, or the whole) of a sphere of radius R, with its centre at the height `centre` above O."""

    R: float
    centre: float = 0.0

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.R <= 0:
            raise TopError("R", self.R, "{range} ({unit})", range="R > 0", unit="m")
        bottom, crown = self.centre - self.R, self.centre + self.R
        rounding = 1e-12 * (abs(self.centre) + self.R)
        for name in ("low", "high"):
            if not bottom - rounding <= getattr(self, name) <= crown + rounding:
                raise TopError(name, getattr(self, name), "{range} ({unit}, within the sphere)", code="outside-sphere",
                               range=f"{bottom:g} <= {name} <= {crown:g}", unit="m")  # fmt: skip

    @property
    def widest(self) -> float:
        return self.R

    def radius(self, z: Scalars) -> Array:
        height = np.asarray(z) - self.centre
        return np.sqrt(np.maximum((self.R - height) * (self.R + height), 0))

    @property
    def square(self) -> Array:
        return np.array([-1.0, 2 * self.centre, self.R**2 - self.centre**2])


@dataclass(frozen=True, kw_only=True)
class Frustum(Slice):
    """A frustum of a cone with the radius r_low at the bottom and r_high at the top."""

    r_low: float
    r_high: float

    def __post_init__(self) -> None:
        super().__post_init__()
        for name in ("r_low", "r_high"):
            if getattr(self, name) < 0:
                raise TopError(name, getattr(self, name), "{range} ({unit})", range=f"{name} >= 0", unit="m")

    @property
    def widest(self) -> float:
        return max(self.r_low, self.r_high)

    def radius(self, z: Scalars) -> Array:
        share = (np.asarray(z) - self.low) / (self.high - self.low)
        return np.maximum(self.r_low * (1 - share) + self.r_high * share, 0)

    @property
    def square(self) -> Array:
        slope = (self.r_high - self.r_low) / (self.high - self.low)
        line = np.array([slope, self.r_low - slope * self.low])
        return np.polymul(line, line) if slope else np.array([0.0, 0.0, line[1] ** 2])


def crossings(one: Slice, other: Slice, low: float, high: float) -> list[float]:
    """The heights between low and high at which two surfaces intersect."""
    gap = np.polysub(one.square, other.square)
    if np.abs(np.polyval(gap, np.linspace(low, high, 3))).max() <= SAME * max(one.widest, other.widest) ** 2:
        return []
    # a coefficient that is only rounding gives a spurious root far away, which may overflow
    terms = np.abs(gap) * max(abs(low), abs(high)) ** np.arange(len(gap) - 1, -1, -1)
    roots = np.roots(np.where(terms > 1e-16 * terms.max(), gap, 0.0))
    return [float(z) for z in roots.real[np.abs(roots.imag) == 0] if low < z < high]
