"""Laws of friction at a contact: k(u^2), with F_h = -k F_z u and u the slip."""

from dataclasses import dataclass
from typing import TypeAlias

from ..errors import TopError, finite
from ..types import Number


@dataclass(frozen=True)
class Coulomb:
    """F_h = -mu_k F_z u/|u| where the top slips; where it does not, what keeps it rolling, up to mu_s F_z.

    mu_s >= mu_k > 0; mu_s = mu_k where it is not given. Raises TopError for anything else.
    """

    mu_k: float
    mu_s: float = None  # type: ignore[assignment]  # once made, it has one

    def __post_init__(self) -> None:
        _positive(self, "mu_k")
        if self.mu_s is None:
            object.__setattr__(self, "mu_s", self.mu_k)
        _positive(self, "mu_s")
        if self.mu_s < self.mu_k:
            raise TopError("mu_s", self.mu_s, f"mu_s >= mu_k = {self.mu_k:g}", "Friction at rest is the larger one.")

    def k(self, square: Number) -> Number:
        return self.mu_k / square**0.5


@dataclass(frozen=True)
class Viscous:
    """F_h = -gamma F_z u, gamma >= 0 in (gR)^-1/2: one of g s/m in SI, F = -g N v, is gamma = g (gR)^1/2 here.

    gamma = 0 is the smooth plane. Raises TopError for anything else.
    """

    gamma: float

    def __post_init__(self) -> None:
        _positive(self, "gamma", zero=True)

    def k(self, square: Number) -> Number:
        return self.gamma


@dataclass(frozen=True)
class SmoothedCoulomb:
    """F_h = -mu F_z u/(u^2 + eps^2)^1/2, mu > 0, eps > 0 in (gR)^1/2: Coulomb's law made smooth, so it never sticks.

    Raises TopError for anything else.
    """

    mu: float
    eps: float

    def __post_init__(self) -> None:
        _positive(self, "mu")
        _positive(self, "eps")

    def k(self, square: Number) -> Number:
        return self.mu / (square + self.eps * self.eps) ** 0.5


Friction: TypeAlias = Coulomb | Viscous | SmoothedCoulomb


def holding(law: Friction) -> float:
    """mu_s of a law that holds; any other never does."""
    return law.mu_s if isinstance(law, Coulomb) else 0.0


def _positive(law: Friction, name: str, zero: bool = False) -> None:
    value = finite(name, getattr(law, name))
    if value < 0 or (value == 0 and not zero):
        raise TopError(name, value, f"{name} {'>=' if zero else '>'} 0")
    object.__setattr__(law, name, value)
