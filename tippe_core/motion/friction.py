"""Laws of friction at a contact, per unit of the normal force F_z.

    F_h = -k F_z u ,     T = -t F_z

u is the slip velocity, omega_n the angular velocity about the normal, and T the torque about the normal. A law is given
by k(u^2, omega_n) and t(u^2, omega_n). Only Contensou's law depends on omega_n and has a torque: its contact is a small
patch, not a point. Each law is a frozen record of its parameters; `law` is the form that kernels use.
"""

from dataclasses import dataclass
from typing import NamedTuple, TypeAlias

import numpy as np

from ..compiled import compiled
from ..errors import TopError, positive
from ..types import Number

COULOMB, VISCOUS, SMOOTHED, CONTENSOU = range(4)
SERIES = 9.0  # (u/(radius omega_n))^2 above which the closed forms lose more digits than the series in 1/q^2
LEAST = 1e-300  # radius omega_n below which its inverse would overflow: counts as no spin
LEAST_PATCH = 1e-5  # (R): smaller patches, of less than 0.2 um for a toy, count as points, which they resemble to 1e-5
STEEP = 1e8  # k above which linear equations leave the slip out: its share is 1/k, and rounding adds 1e-16 k


class Law(NamedTuple):
    """A law in the form that kernels use.

    kind tells push() its formula. mu_s: the coefficient of static friction, 0 if there is none: otherwise the law is
    set-valued at rest, and a slip may stop. width: a speed in the formula. radius: that of a contact that is a patch,
    not a point, and stops only if it does not spin either. pivots: whether it has a torque.
    """

    kind: int
    mu: float
    mu_s: float
    width: float = 0.0
    radius: float = 0.0
    pivots: bool = False


@dataclass(frozen=True)
class _Friction:
    """What all laws have in common."""

    @property
    def law(self) -> Law:
        raise NotImplementedError

    def k(self, square: Number, omega_n: float = 0.0) -> Number:
        """k at u^2 = square (a number or an array), in (gR)^-1/2."""
        if np.ndim(square) == 0:
            return push(self.law, float(square), float(omega_n))[0]
        return np.array([self.k(one, omega_n) for one in square])

    def _positive(self, name: str, zero: bool = False) -> None:
        object.__setattr__(self, name, positive(name, getattr(self, name), zero))


@dataclass(frozen=True)
class Coulomb(_Friction):
    """F_h = -mu_k F_z u/|u| while the top slips; while it rolls, the force of the constraint, up to mu_s F_z.

    Parameters
    ----------
    mu_k : float
        coefficient of sliding friction, > 0
    mu_s : float
        coefficient of static friction, mu_s >= mu_k; mu_k if it is not given

    Raises
    ------
    TopError
        for anything else, with the name, the value and the allowed range
    """

    mu_k: float
    mu_s: float = None  # type: ignore[assignment]  # never None after __post_init__

    def __post_init__(self) -> None:
        self._positive("mu_k")
        if self.mu_s is None:
            object.__setattr__(self, "mu_s", self.mu_k)
        self._positive("mu_s")
        if self.mu_s < self.mu_k:
            raise TopError("mu_s", self.mu_s, f"mu_s >= mu_k = {self.mu_k:g}", "Static friction is the larger one.",
                           code="below-sliding")  # fmt: skip

    @property
    def law(self) -> Law:
        """In the form that kernels use."""
        return Law(COULOMB, self.mu_k, self.mu_s)


@dataclass(frozen=True)
class Viscous(_Friction):
    """F_h = -gamma F_z u.

    In SI units F_h = -gamma_SI F_z u with gamma_SI in s/m, and gamma = gamma_SI (gR)^1/2. gamma = 0 is the smooth
    plane.

    Parameters
    ----------
    gamma : float
        in (gR)^-1/2, 0 or more

    Raises
    ------
    TopError
        for anything else, with the name, the value and the allowed range
    """

    gamma: float

    def __post_init__(self) -> None:
        self._positive("gamma", zero=True)

    @property
    def law(self) -> Law:
        """In the form that kernels use."""
        return Law(VISCOUS, self.gamma, 0.0)


@dataclass(frozen=True)
class SmoothedCoulomb(_Friction):
    """F_h = -mu F_z u/(u^2 + eps^2)^1/2: a smoothed Coulomb law, which never sticks.

    Parameters
    ----------
    mu : float
        coefficient of sliding friction, > 0
    eps : float
        the speed below which it is smoothed, in (gR)^1/2, > 0

    Raises
    ------
    TopError
        for anything else, with the name, the value and the allowed range
    """

    mu: float
    eps: float

    def __post_init__(self) -> None:
        self._positive("mu")
        self._positive("eps")

    @property
    def law(self) -> Law:
        """In the form that kernels use."""
        return Law(SMOOTHED, self.mu, 0.0, self.eps)


@dataclass(frozen=True)
class Contensou(_Friction):
    """Coulomb's law at each point of a round contact patch with Hertzian pressure.

    The patch slides and spins about its normal at the same time, so the direction of friction varies over it. With the
    slip velocity u + omega_n x r at the point r, the law is the integral over the patch

        F_h = -mu int p (u + omega_n x r)/|u + omega_n x r| dA ,   p = 3 F_z/(2 pi radius^2) (1 - r^2/radius^2)^1/2 ,

    and T is the integral of r x the same; contensou() has the closed forms. The contact cannot stick while it spins. If
    u and radius omega_n both vanish, it sticks up to bounds().

    P. Contensou, in Kreiselprobleme (IUTAM, Springer 1963); for the tippe top R. I. Leine and Ch. Glocker, Eur. J.
    Mech. A/Solids 22, 193 (2003).

    Parameters
    ----------
    mu : float
        coefficient of friction, > 0
    radius : float
        of the patch, in R; 0, or less than 1e-5, is Coulomb(mu)
    pivots : bool
        False leaves T out, for experiments

    Raises
    ------
    TopError
        for anything else, with the name, the value and the allowed range
    """

    mu: float
    radius: float
    pivots: bool = True

    def __post_init__(self) -> None:
        self._positive("mu")
        self._positive("radius", zero=True)
        if not isinstance(self.pivots, bool | np.bool_ | int | float) or self.pivots not in (True, False):
            raise TopError("pivots", self.pivots, "True | False", code="wrong-kind")

    def __repr__(self) -> str:
        return f"Contensou(mu={self.mu!r}, radius={self.radius!r}{'' if self.pivots else ', pivots=False'})"

    @property
    def law(self) -> Law:
        """In the form that kernels use."""
        if self.radius < LEAST_PATCH:
            return Coulomb(self.mu).law
        return Law(CONTENSOU, self.mu, self.mu, 0.0, self.radius, bool(self.pivots))


Friction: TypeAlias = Coulomb | Viscous | SmoothedCoulomb | Contensou


@compiled
def push(law: Law, square: float, omega_n: float) -> tuple[float, float]:
    """(k, t) of a law at u^2 = square and the angular velocity omega_n about the normal.

    k is mu/|u| (Coulomb), gamma (viscous), mu/(u^2 + eps^2)^1/2 (smoothed); for Contensou's law see contensou(). Where
    the law is set-valued, at u = 0 and radius omega_n = 0, both are 0; bounds() gives its limits there.
    """
    if law.kind == VISCOUS:
        return law.mu, 0.0
    if law.kind == SMOOTHED:
        return law.mu / np.sqrt(square + law.width * law.width), 0.0
    if law.kind == CONTENSOU and law.radius * abs(omega_n) > LEAST:
        k, t = contensou(law.mu, law.radius, square, omega_n)
        return k, (t if law.pivots else 0.0)
    return (law.mu / np.sqrt(square) if square > 0.0 else 0.0), 0.0


@compiled
def bounds(law: Law) -> tuple[float, float]:
    """The largest |F_h| and |T| per unit of F_z at a contact that neither slips nor spins: mu_s and, for Contensou's
    law, (3 pi/16) mu radius."""
    return law.mu_s, (3 * np.pi / 16 * law.mu * law.radius if law.pivots else 0.0)


@compiled
def is_point(law: Law) -> bool:
    """Whether a slip may stop at a point, as with Coulomb's law: its direction is undefined there."""
    return law.mu_s > 0.0 and law.radius == 0.0


def sticks(law: Law, omega_n: float) -> bool:
    """Whether a contact that does not slip, but spins with omega_n about its normal, goes on without slip however it is
    pushed, up to bounds(): the law is set-valued there (Coulomb's always, Contensou's at radius omega_n = 0), or so
    close to that that k exceeds STEEP."""
    k, limit = push(law, 0.0, omega_n)[0], bounds(law)[0]
    return k > STEEP or (k == 0.0 and limit > 0.0)


def contensou(mu: float, radius: float, square: float, omega_n: float) -> tuple[float, float]:
    """(k, t) of Contensou's law for radius omega_n other than 0. With q = |u|/(radius |omega_n|),

        |F_h| = mu F_z (3/4) [q (1 - q^2/4) A + (1/2 + q^2/4) Q]
        |T| = mu F_z radius (3/8) [(1 - q^2 + 3 q^4/8) A + (3 q/4 - 3 q^3/8) Q]
        A = asin(min(1, 1/q)) ,   Q = (1 - 1/q^2)^1/2 if q > 1, else 0 .

    Rearranged for q <= 1, where A = pi/2 and |F_h|/|u| has a limit at u = 0. For large q, where terms of order q^3
    cancel, the brackets are written as hypergeometric series:

        |F_h| = mu F_z 2F1(-1/2, 1/2; 5/2; 1/q^2) ,   |T| = mu F_z radius/(5 q) 2F1(1/2, 1/2; 7/2; 1/q^2) .
    """
    w = radius * abs(omega_n)
    u = np.sqrt(square)
    if u <= w:
        q = u / w
        k = 3 * np.pi / 8 * mu / w * (1 - q * q / 4)
        t = 3 * np.pi / 16 * mu * radius * (1 - q * q + 3 * q**4 / 8)
    elif u * u < SERIES * w * w:
        q = u / w
        A, Q = np.arcsin(1 / q), np.sqrt(1 - 1 / (q * q))
        k = mu / u * 3 / 4 * (q * (1 - q * q / 4) * A + (1 / 2 + q * q / 4) * Q)
        t = mu * radius * 3 / 8 * ((1 - q * q + 3 * q**4 / 8) * A + (3 * q / 4 - 3 * q**3 / 8) * Q)
    else:
        x = w / u
        k = mu / u * hypergeometric(-0.5, 2.5, x * x)
        t = mu * radius * x / 5 * hypergeometric(0.5, 3.5, x * x)
    return k, (t if omega_n > 0 else -t)


def hypergeometric(a: float, c: float, x: float) -> float:
    """2F1(a, 1/2; c; x) for 0 <= x <= 1/SERIES: the sum of (a)_n (1/2)_n/(c)_n x^n/n!, whose terms fall as x^n."""
    term = total = 1.0
    for n in range(15):
        term *= (a + n) * (0.5 + n) / ((c + n) * (1 + n)) * x
        total += term
    return total
