"""Rocking without spin: measuring a with a stopwatch."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import hypot, inf, isfinite, pi, sqrt

import numpy as np
from scipy.optimize import brentq

from ..errors import TopError, checked, finite
from ..paper.top import Top
from .ranges import in_range
from .shape import Shape


@dataclass(frozen=True)
class Measured:
    """A measured value.

    Attributes
    ----------
    value : float
        in the unit of the quantity
    uncertainty : float
        its standard uncertainty, in the same unit
    shares : dict
        the contribution of each input to that, in the same unit
    """

    value: float
    uncertainty: float
    shares: dict[str, float]


@checked
def rocking_period(top: Top) -> float:
    """The period of small oscillations about theta = 0 without spin and without slipping:

    T = 2 pi [(I1 + (1 - a)^2)/a]^1/2

    Parameters
    ----------
    top : Top
        with a > 0

    Returns
    -------
    float
        in (R/g)^1/2

    Raises
    ------
    TopError
        for a <= 0
    """
    if top.a <= 0:
        raise TopError("a", top.a, "a > 0", "Only a top whose G lies below O rocks about theta = 0.",
                       code="does-not-rock")  # fmt: skip
    return 2 * pi * sqrt((top.I1 + (1 - top.a) ** 2) / top.a)


@checked
def a_from_rocking(
    *,
    T: float,
    R: float,
    I1: float,
    g: float = 9.81,
    dT: float = 0.0,
    dR: float = 0.0,
    dI1: float = 0.0,
    dg: float = 0.0,
) -> Measured:
    """a of a top that rocks with a measured period.

    With q = (T/2 pi)^2 g/R the formula for the period becomes
        a^2 - (2 + q) a + 1 + I1 = 0,    a = 2 (1 + I1)/(2 + q + [(2 + q)^2 - 4 (1 + I1)]^1/2),
    because the other root is larger than 1; and (2 + q - 2a) da = dI1 - a dq.

    Parameters
    ----------
    T : float
        period, s
    R : float
        radius of the sphere that rolls, m
    I1 : float
        in MR^2, from the shape
    g : float
        m/s^2
    dT, dR, dI1, dg : float
        standard uncertainties, in the same units

    Returns
    -------
    Measured
        a in R

    Raises
    ------
    TopError
        if no a < 1 gives so short a period
    """
    given, errors = {"T": T, "R": R, "I1": I1, "g": g}, {"T": dT, "R": dR, "I1": dI1, "g": dg}
    T, R, I1, g = (in_range(name, value, 1e-9, 1e9, "SI; I1 in MR^2") for name, value in given.items())
    errors = {name: in_range(f"d{name}", value, 0, 1e9, "SI; I1 in MR^2") for name, value in errors.items()}
    q = (T / (2 * pi)) ** 2 * g / R
    # a < 1: at a = 1 the quadratic is I1 - q, so q > I1; and both roots are real
    least = max(I1, 2 * sqrt(1 + I1) - 2)
    if not q > least:
        shortest = 2 * pi * sqrt(least * R / g)
        raise TopError("T", T, "T > {least:.6g} s for this R, I1 and g", "No top of this kind rocks faster.",
                       code="too-fast", least=shortest)  # fmt: skip
    root = sqrt((2 + q) ** 2 - 4 * (1 + I1))
    a = 2 * (1 + I1) / (2 + q + root)
    slopes = {"T": -a * 2 * q / T, "R": a * q / R, "I1": 1.0, "g": -a * q / g}
    shares = {name: abs(slope) * errors[name] / root for name, slope in slopes.items()}
    return Measured(a, hypot(*shares.values()), shares)


@checked
def dimension_from_rocking(
    family: Callable[[float], Shape],
    *,
    T: float,
    low: float,
    high: float,
    g: float = 9.81,
    dT: float = 0.0,
    dg: float = 0.0,
) -> Measured:
    """One unknown dimension of a body that rocks with a measured period.

    Parameters
    ----------
    family : callable
        family(x) is the shape with the dimension x, such as lambda d: LoadedSphere(R=.02, b=.008, d=d, density=700,
        core_density=7800); values for which there is no body, or one that does not rock, are skipped
    T : float
        period, s
    low, high : float
        range of the dimension, in its unit
    g : float
        m/s^2
    dT, dg : float
        standard uncertainties

    Returns
    -------
    Measured
        in the unit of the dimension

    Raises
    ------
    TopError
        if no x in the range, or more than one, gives this period
    """
    in_range("T", T, 0, inf, "s", above=True)
    in_range("g", g, 0, inf, "m/s^2", above=True)

    def period(x: float) -> float:
        try:
            shape = family(float(x))
            return rocking_period(shape.top) * replace(shape.scales, g=g).time
        except TopError:
            return np.nan

    tried = np.linspace(finite("low", low), finite("high", high), 257)
    periods = np.array([period(x) for x in tried])
    if np.isnan(periods).all():
        raise TopError(
            "low", low, "a range with a body in it that rocks", "Give other low and high.", code="none-rocks"
        )
    at = np.flatnonzero((periods[:-1] >= T) != (periods[1:] >= T))
    at = [index for index in at if not np.isnan(periods[index : index + 2]).any()]
    if len(at) != 1:
        code, remedy = ("reached-twice", "Narrow low and high.") if at else ("not-reached", "Widen low and high.")
        raise TopError("T", T, "{low:.6g} to {high:.6g} s, and reached once", remedy, code=code,
                       low=np.nanmin(periods), high=np.nanmax(periods))  # fmt: skip
    first, last = tried[at[0]], tried[at[0] + 1]
    x = brentq(lambda x: period(x) - T, first, last, xtol=1e-15 * max(abs(first), abs(last)), rtol=1e-14)
    step = (last - first) * 1e-3
    ahead, behind = (y if isfinite(period(y)) else x for y in (x + step, x - step))
    slope = (period(ahead) - period(behind)) / (ahead - behind)
    shares = {"T": finite("dT", dT) / abs(slope), "g": T / (2 * g) * finite("dg", dg) / abs(slope)}
    return Measured(float(x), float(hypot(*shares.values())), {name: float(share) for name, share in shares.items()})
