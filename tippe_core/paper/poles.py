"""The bracket B of (36) near a pole, where its terms cancel on every trajectory that comes close.

There it is split: near theta = 0, with x = 1 - c, B = d + x C. The pole offset d = K_J - K_J(P) is known with more
digits than K_J, and C has no cancellation. Seen from the inverted pole the equations are those of another top, with
a -> -a, c -> -c, K_R -> -K_R, and with 2E' smaller by 4a.
"""

from decimal import Decimal, localcontext
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from ..errors import checked_many, finite, numbers
from ..types import Array, Bools, Like, Number, Scalars
from . import equations as eq
from .constants import EXACT, exact_top
from .equations import AnyTop
from .top import Top, TopNumbers


def seen_from(side: Number, top: AnyTop) -> TopNumbers:
    """The top as seen from the pole cos(theta) = side: 1 for the upright, -1 for the inverted one."""
    return TopNumbers(side * top.a, top.I1, top.I3)


class Floats(NamedTuple):
    """A top, K_J and K_R in the form that kernels use: K_J as its offsets from the upright and the inverted pole."""

    top: TopNumbers
    K_R: float
    upright: float
    inverted: float


def bracket_near(side: Number, x: Number, curve: Floats) -> tuple[Number, Number]:
    """B and w3 where cos(theta) is at the distance x from the pole cos(theta) = side."""
    c, s2 = side * (1 - x), x * (2 - x)
    d, w3 = curve.upright if side > 0 else curve.inverted, eq.omega3(c, s2, curve.K_R, curve.top)
    C = pole_slope(x, np.sqrt(eq.f3_2(c, s2, curve.top)), side * w3, seen_from(side, curve.top))
    return d + x * C, w3


def angle(x: float, side: float) -> float:
    """theta (rad) where cos(theta) is at the distance x from the pole cos(theta) = side."""
    turned = 2 * np.arctan2(np.sqrt(x), np.sqrt(2 - x))
    return turned if side > 0 else np.pi - turned


def pole_slope(x: Number, f3: Number, w3: Number, top: AnyTop) -> Number:
    """C in B = d + x C at x = 1 - c, where x C is B on the trajectory through the pole:

    (36)  x C = K_J(P) - (I3/I1)(c - a) K_R/f3,  K_J(P) = (I3/I1)(1 - a) K_R/f3(P),  with K_R/f3 = w3

    Rearranged, because it is 0/0 at x = 0. With p = 1 - a, q = c - a, and f3(P) and f3 at the pole and at x,
    p/f3(P) - q/f3 = (p f3 - q f3(P))/(f3(P) f3) = x {p^2 (2 - x) + I3 (p + q)}/{f3(P) f3 (p f3 + q f3(P))}
    by (32). q is computed as p - x, because 1 - x loses digits of x when a is close to 1.
    """
    p, q, f3_P = 1 - top.a, 1 - top.a - x, np.sqrt(eq.f3_2(1.0, 0.0, top))
    unit = top.I3 / top.I1 * w3 / f3_P
    if p * q > 0:
        return unit * one_sign(x, p, q, f3_P, f3, top)
    return unit * (f3_P if p == 0 else two_signs(x, p, q, f3_P, f3))


def one_sign(x: Number, p: Number, q: Number, f3_P: Number, f3: Number, top: AnyTop) -> Number:
    """(p f3 - q f3(P))/x, when p f3 and q f3(P) nearly cancel"""
    return (p * p * (2 - x) + top.I3 * (p + q)) / (p * f3 + q * f3_P)


def two_signs(x: Number, p: Number, q: Number, f3_P: Number, f3: Number) -> Number:
    """(p f3 - q f3(P))/x, when they do not"""
    return (p * f3 - q * f3_P) / x


@checked_many
def pole_constants(top: Top, K_R: Like) -> tuple[Like, Like]:
    """(K_J at P, K_J at the inverted pole): the values for which the bracket of (36) vanishes at theta = 0 and at pi.

    K_J(P) = (I3/I1)(1 - a) K_R/f3(0). Only trajectories with these K_J pass through the poles.

    Parameters
    ----------
    top : Top
        the top
    K_R : float or array
        (31), in (MgR)^1/2, of any shape

    Returns
    -------
    tuple of two: float or array
        in (g/R)^1/2; for a single number the nearest floats, which every function here takes as exactly the poles'
        K_J

    Raises
    ------
    TopError
        for anything else, with the name, the value and the allowed range
    """
    if np.ndim(K_R):
        K_R = numbers("K_R", K_R)
        return K_J_of_pole(1.0, K_R, top), K_J_of_pole(-1.0, K_R, top)
    upright, inverted = exact_pole_constants(top, Decimal(finite("K_R", K_R)))
    return float(upright), float(inverted)  # type: ignore[return-value]  # one number is given


def K_J_of_pole(side: Number, K_R: Number, top: AnyTop) -> Number:
    """K_J of the trajectories through the pole cos(theta) = side."""
    return eq.K_J_of_spin(side, eq.omega3(side, 0, K_R, top), top)


@lru_cache(256)
def pole_ratios(top: Top) -> tuple[Decimal, Decimal]:
    """K_J/K_R at P and at the inverted pole."""
    t = exact_top(top)
    with localcontext(EXACT):
        one = Decimal(1)
        return K_J_of_pole(one, one, t), K_J_of_pole(-one, one, t)


def exact_pole_constants(top: Top, K_R: Decimal) -> tuple[Decimal, Decimal]:
    """K_J at P and at the inverted pole, as Decimals."""
    with localcontext(EXACT):
        upright, inverted = pole_ratios(top)
        return upright * K_R, inverted * K_R


@lru_cache(256)
def in_two_floats(top: Top, K_R: float) -> tuple[tuple[float, float], tuple[float, float]]:
    """K_J at P and at the inverted pole, each as the nearest float and the remainder."""
    upright, inverted = ((float(K), float(K - Decimal(float(K)))) for K in exact_pole_constants(top, Decimal(K_R)))
    return upright, inverted


def pole_offsets(top: Top, K_J: Scalars, K_R: Scalars) -> tuple[Array, Array]:
    """The pole offsets: d = K_J - K_J(P), and the same at the inverted pole, free of the rounding error of K_J(P)."""
    parts = np.array([in_two_floats(top, K) for K in np.ravel(K_R).tolist()])
    upright, inverted = (K_J - near - rest for near, rest in parts.T.swapaxes(0, 1).reshape(2, 2, *np.shape(K_R)))
    return np.where(at_pole(upright, K_J), 0.0, upright), np.where(at_pole(inverted, K_J), 0.0, inverted)


def at_pole(d: Number, K_J: Scalars) -> Bools:
    """Whether K_J is that of the pole to the last digit: no float is nearer to it."""
    return np.abs(d) <= 0.51 * np.spacing(np.abs(K_J))
