"""Bodies whose inside is unknown: spheres with given a, I1 and I3."""

from dataclasses import dataclass
from functools import cached_property
from math import sqrt

from ..errors import TopError
from ..paper.top import Top
from .ranges import SMALLEST, in_range, weight
from .shape import Shape
from .solids import Solid, ball, zone


@dataclass(frozen=True, kw_only=True)
class BareSphere(Shape):
    """A ball with an unknown interior.

    Parameters
    ----------
    R : float
        radius, m
    M : float
        mass, kg
    a, I1, I3 : float
        in R and MR^2, as in Top

    Raises
    ------
    TopError
        for anything else, with the name, the value and the allowed range
    """

    R: float
    M: float
    a: float
    I1: float
    I3: float

    _weights = ("M",)

    def _check(self) -> None:
        weight(self.M)
        Top(self.a, self.I1, self.I3)
        # int r^2 dm <= M reach^2 about O, and it is I1 + I3/2 + a^2
        room = self._reach**2 - self.I3 / 2
        if self.I1 > room:
            raise TopError("I1", self.I1, f"I1 <= {self._reach**2:g} - I3/2 = {room:g}",
                           "More does not fit into the body.", code="does-not-fit")  # fmt: skip
        most = sqrt(room - self.I1)
        in_range("a", self.a, -most, most, "R", code="does-not-fit", remedy="More does not fit into the body.")

    @property
    def _reach(self) -> float:
        """The largest distance of its surface from O, in R."""
        return 1.0

    @property
    def mass(self) -> float:
        """M, kg."""
        return self.M

    @property
    def com(self) -> float:
        """Height of G above O, m: -a in SI."""
        return -self.a * self.R

    @property
    def moments(self) -> tuple[float, float]:
        """(I1, I3) at G, kg m^2."""
        unit = self.M * self.R**2
        return self.I1 * unit, self.I3 * unit

    @property
    def top(self) -> Top:
        """Its a, I1 and I3, in units of R and M."""
        return Top(self.a, self.I1, self.I3)

    @cached_property
    def solid(self) -> Solid:
        """Its outer surface; the distribution of mass inside is unknown."""
        return ball(self.R)

    def stl(self, sides: int = 128) -> bytes:
        """Not possible.

        Parameters
        ----------
        sides : int
            flat faces around the axis

        Returns
        -------
        bytes
            never

        Raises
        ------
        TopError
            always: the inside is unknown
        """
        raise TopError("shape", type(self).__name__, "a shape whose inside is known", "Give it dimensions to print it.",
                       code="inside-unknown")  # fmt: skip


@dataclass(frozen=True, kw_only=True)
class StemmedSphere(BareSphere):
    """A BareSphere with a stem with a round end: a ball of radius r protrudes from it.

    The two surfaces meet in a circle, R - r < h < R + r.

    Parameters
    ----------
    R, M, a, I1, I3 : float
        of the whole body, as in BareSphere
    r, h : float
        radius of that ball, and the height of its centre above O, m

    Raises
    ------
    TopError
        for anything else, with the name, the value and the allowed range
    """

    r: float
    h: float

    def _check(self) -> None:
        in_range("r", self.r, SMALLEST, self.R, "m")
        in_range("h", self.h, self.R - self.r, self.R + self.r, "m", above=True, below=True)
        super()._check()

    @property
    def _reach(self) -> float:
        return (self.h + self.r) / self.R

    @cached_property
    def solid(self) -> Solid:
        """Its outer surface; the distribution of mass inside is unknown."""
        meet = (self.h**2 + (self.R - self.r) * (self.R + self.r)) / (2 * self.h)
        return zone(self.R, -self.R, meet) + zone(self.r, meet, self.h + self.r, self.h)
