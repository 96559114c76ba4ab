"""The three constants of the motion without slipping, given directly or by an initial state."""

from dataclasses import dataclass, fields
from decimal import Context, Decimal, localcontext
from functools import lru_cache
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from ..errors import Compared, TopError, finite, has_arrays, set_arrays, single
from ..types import Array, Scalars
from . import equations as eq
from .equations import AnyTop
from .top import Top, TopNumbers

# The terms of (36) cancel to many figures near a pole and near a steady precession. Everything there is algebraic in
# cos(theta), so where it matters it is evaluated in Decimals with 60 digits (near a pole 1 - c may be 1e-34).
EXACT = Context(prec=60, Emin=-999999, Emax=999999)
CLOSED = 1e-9  # R: a contact that is higher above the table is open
LARGEST = 1e12  # in a State: far beyond any real top, and EXACT keeps 36 figures even of the squares


def exact_top(top: AnyTop) -> TopNumbers:
    """a, I1, I3 as Decimals. Raises TopError if this is many tops."""
    return _exact(top.numbers if isinstance(top, Top) else top)


@lru_cache(256)
def _exact(top: TopNumbers) -> TopNumbers:
    return TopNumbers(Decimal(top.a), Decimal(top.I1), Decimal(top.I3))


@dataclass(frozen=True, eq=False)
class Constants(Compared):
    """The constants of a rolling motion: K_J (30), K_R (31) and the energy E (6).

    Parameters
    ----------
    K_J, K_R : float or array
        in (g/R)^1/2 and (MgR)^1/2
    E : float or array
        in MgR; all three broadcast together

    Raises
    ------
    TopError
        where one is not finite
    """

    K_J: Scalars
    K_R: Scalars
    E: Scalars

    def __post_init__(self) -> None:
        set_arrays("constants", self, finite=True)

    def two_E_prime(self, top: Top) -> Scalars:
        """2E' = 2E - K_R^2 + (I1/I3) K_J^2, the shifted energy of (33).

        Parameters
        ----------
        top : Top
            the top to which the constants belong

        Returns
        -------
        float or array
            MgR; correctly rounded for scalars
        """
        if any(np.ndim(x) for x in (self.K_J, self.K_R, self.E)):
            return eq.two_E_prime(self.E, self.K_J, self.K_R, top)
        return float(Exact.of(self, top).e)

    @classmethod
    def from_state(cls, top: Top, theta: float, theta_dot: float, omega2: float, omega3: float) -> Self:
        """The constants of the rolling motion that passes through a state, by (30), (31) and (6).

        Parameters
        ----------
        top : Top
            the top
        theta : float
            rad, in [0, pi]
        theta_dot, omega2, omega3 : float
            angular velocities about 1', 2' and 3, (g/R)^1/2

        Returns
        -------
        Constants
            in units of R, M and g

        Raises
        ------
        TopError
            for a state that is not possible, as State()
        """
        exact = Exact.of_state(State(theta, theta_dot, omega2, omega3), top)
        with localcontext(EXACT):
            E = eq.E_of(exact.e, exact.K_J, exact.K_R, exact_top(top))
        return cls(float(exact.K_J), float(exact.K_R), float(E))


@dataclass(frozen=True, eq=False)
class State(Compared):
    """The state of a motion at one instant, in units of R, M and g.

    Where many motions are meant (slide_many), the fields may be arrays that broadcast; they are then checked where they
    are used.

    Parameters
    ----------
    theta, phi, psi : float
        Euler angles in rad, theta in [0, pi]
    theta_dot, omega2, omega3 : float
        angular velocities about 1', 2' and 3, in (g/R)^1/2
    x, y : float or None
        horizontal position of G in space, R; None: each function makes its own choice (rolling: the contact point
        starts at the origin)
    vx, vy : float or None
        horizontal velocity of G, in (gR)^1/2, along the axes x, y that turn with phi; None: likewise (rolling: that
        of rolling)
    z, vz : float or None
        height of G above the table, R, and its vertical velocity, (gR)^1/2, for a start in flight of slide() or
        slide_many(); None: on the table. The other functions do not know flights

    Raises
    ------
    TopError
        if a value is not finite or exceeds 1e12, or if theta is not in [0, pi]
    """

    theta: float
    theta_dot: float
    omega2: float
    omega3: float
    phi: float = 0.0
    psi: float = 0.0
    x: float | None = None
    y: float | None = None
    vx: float | None = None
    vy: float | None = None
    z: float | None = None
    vz: float | None = None

    def __post_init__(self) -> None:
        if has_arrays(self):
            set_arrays("state", self)
            return
        for field in fields(self):
            value = getattr(self, field.name)
            if value is not None or field.default is not None:
                object.__setattr__(self, field.name, finite(field.name, value))
                if abs(getattr(self, field.name)) > LARGEST:
                    raise TopError(field.name, value, "at most {most:g} in size", code="too-large", most=LARGEST)
        if not 0 <= self.theta <= np.pi:
            raise TopError("theta", self.theta, "0 <= theta <= pi (rad)")
        if self.vz is not None and self.z is None:
            raise TopError("vz", self.vz, "None", "On the table it follows from the rest; give z too.",
                           code="contradiction")  # fmt: skip
        if self.omega2 and self.theta in (0.0, np.pi):
            raise TopError("omega2", self.omega2, "0 on the vertical axis, where 2' has no direction",
                           "Give the whole horizontal angular velocity as theta_dot.", code="no-direction")  # fmt: skip


@dataclass(frozen=True)
class Exact:
    """K_J, K_R and e = 2E', with the precision of EXACT."""

    K_J: Decimal
    K_R: Decimal
    e: Decimal

    @classmethod
    def of(cls, constants: Constants, top: Top) -> Self:
        with localcontext(EXACT):
            K_J, K_R, E = (Decimal(float(x)) for x in (constants.K_J, constants.K_R, constants.E))
            return cls(nonzero(K_J), nonzero(K_R), eq.two_E_prime(E, K_J, K_R, exact_top(top)))

    @classmethod
    def of_state(cls, state: State, top: Top) -> Self:
        """From a State, by (30), (31) and (33)."""
        single("state", state)
        with localcontext(EXACT):
            t, (v, c, s2) = exact_top(top), exact_place(state.theta)
            w1, w2, w3 = Decimal(state.theta_dot), Decimal(state.omega2), Decimal(state.omega3)
            K_J, K_R = eq.K_J(c, s2.sqrt(), w2, w3, t), eq.K_R(c, s2, w3, t)
            e = eq.two_E_prime_of_motion(w1 * w1, eq.U(v, c, s2, w2 * w2, t), c, t)
            return cls(nonzero(K_J), nonzero(K_R), e)


def nonzero(K: Decimal) -> Decimal:
    """K, or 0 if it is so small that the turn near a pole, at 1 - c near K^2, is beyond the range of floats."""
    return K if abs(K) > Decimal("1e-24") else Decimal(0)


def versines(theta: ArrayLike) -> tuple[Array, Array]:
    """(1 - cos theta, 1 + cos theta), both to full relative precision, also near their zeros; pi is the inverted
    pole."""
    theta = np.asarray(theta, dtype=float)
    v, m = 2 * np.sin(theta / 2) ** 2, 2 * np.cos(theta / 2) ** 2
    return v, np.where(theta == np.pi, 0.0, m)


def require_contact(top: Top, state: State) -> None:
    """Raises a TopError for a State in flight."""
    if state.z is not None and state.z > (least := 1 - top.a * np.cos(state.theta)) + CLOSED:
        raise TopError("z", state.z, "z <= {most:.10g}", "In flight it touches nothing.", code="in-flight", most=least)


def exact_place(theta: float) -> tuple[Decimal, Decimal, Decimal]:
    """1 - c, c and s^2 in the context EXACT, from versines()."""
    v, m = (Decimal(float(x)) for x in versines(theta))
    v = v if v <= m else 2 - m
    return v, 1 - v, v * (2 - v)


def exact_versine(theta: float) -> Decimal:
    """1 - cos(theta) with the precision of EXACT, for theta from 0 to pi; the float pi is the inverted pole."""
    if theta == np.pi:
        return Decimal(2)
    x2, k = Decimal(theta) ** 2, 2
    term = total = x2 / 2
    while abs(term) > total * Decimal("1e-50"):
        k += 2
        term *= -x2 / (k * (k - 1))
        total += term
    return total
