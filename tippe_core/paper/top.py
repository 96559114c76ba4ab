"""The top as it enters the paper's equations: three numbers, and the scales that give them SI units."""

from dataclasses import dataclass
from typing import NamedTuple, Self

from ..errors import Compared, TopError, finite, has_arrays, positive, set_arrays, single
from ..types import Number


class TopNumbers(NamedTuple):
    """a, I1, I3 of a Top in the form that the equations use: floats, arrays that broadcast, or Decimals."""

    a: Number
    I1: Number
    I3: Number


@dataclass(frozen=True, eq=False)
class Top(Compared):
    """A symmetric top with a round peg (Gray and Nickel, Sec. II and Fig. 2), in units of R and M.

    Where many motions are meant (slide_many, thresholds), the fields may be arrays that broadcast; they are then
    checked where they are used.

    Parameters
    ----------
    a : float
        distance of the centre of mass G from the sphere's centre O, below O on axis 3 when theta = 0: a > 0 tippe
        top, a < 0 ordinary top, a = 0 uniform ball. a < 1: G lies above the contact point
    I1 : float
        moment of inertia at G about any axis perpendicular to axis 3, in MR^2
    I3 : float
        moment of inertia at G about axis 3, in MR^2; I3 <= 2 I1 for any body

    Raises
    ------
    TopError
        for anything else, with the name, the value and the allowed range
    """

    a: float
    I1: float
    I3: float

    def __post_init__(self) -> None:
        if has_arrays(self):
            set_arrays("top", self)
            return
        for name in ("a", "I1", "I3"):
            object.__setattr__(self, name, finite(name, getattr(self, name)))
        if self.a >= 1:
            raise TopError("a", self.a, "a < 1 (in units of R)", "The centre of mass must lie above the contact point.",
                           code="too-high")  # fmt: skip
        for name in ("I1", "I3"):
            positive(name, getattr(self, name), unit=" (in MR^2)")
        if self.I3 > 2 * self.I1 * (1 + 1e-15):
            raise TopError(
                "I3", self.I3, f"0 < I3 <= 2 I1 = {2 * self.I1:g}",
                "No body has more: lower I3 or raise I1 to {least:g} or above.", code="too-flat",
                least=self.I3 / 2)  # fmt: skip

    @classmethod
    def paper(cls) -> Self:
        """The commercial wooden top of appendix A: a = 0.070, I1 = 0.399, I3 = 0.408."""
        return cls(a=0.070, I1=0.399, I3=0.408)

    @property
    def numbers(self) -> TopNumbers:
        """a, I1, I3 as floats, for compiled functions. Raises TopError if this is many tops."""
        single("top", self)
        return TopNumbers(self.a, self.I1, self.I3)


@dataclass(frozen=True)
class Scales:
    """The scales of a real top. Each property is one unit of Sec. VI in SI units.

    Parameters
    ----------
    R : float
        m
    M : float
        kg
    g : float
        m/s^2

    Raises
    ------
    TopError
        for anything else, with the name, the value and the allowed range
    """

    R: float
    M: float
    g: float = 9.81

    def __post_init__(self) -> None:
        for name in ("R", "M", "g"):
            object.__setattr__(self, name, positive(name, getattr(self, name), unit=" (SI)"))

    @classmethod
    def paper(cls) -> Self:
        """The top of appendix A: R = 1.6 cm, M = 11.5 g."""
        return cls(R=0.016, M=0.0115)

    @property
    def time(self) -> float:
        """(R/g)^1/2 in s."""
        return (self.R / self.g) ** 0.5

    @property
    def angular_velocity(self) -> float:
        """(g/R)^1/2 in rad/s."""
        return (self.g / self.R) ** 0.5

    @property
    def velocity(self) -> float:
        """(gR)^1/2 in m/s."""
        return (self.g * self.R) ** 0.5

    @property
    def force(self) -> float:
        """Mg in N."""
        return self.M * self.g

    @property
    def energy(self) -> float:
        """MgR in J."""
        return self.M * self.g * self.R

    @property
    def inertia(self) -> float:
        """MR^2 in kg m^2."""
        return self.M * self.R**2

    @property
    def angular_momentum(self) -> float:
        """M (gR^3)^1/2 in kg m^2/s."""
        return self.M * (self.g * self.R**3) ** 0.5
