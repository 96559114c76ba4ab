"""Divided differences of (32), (34) and (36) over the two turning points, c1 and c2, and a third point c.

A function g of cos(theta) has the values g1, g2 and g there, and


    g_12 = (g1 - g2)/(c1 - c2) ,   g_2c = (g2 - g)/(c2 - c) ,   g_12c = (g_12 - g_2c)/(c1 - c)

They are rearranged so that nothing cancels, however close the turning points are: polynomials are divided out, the rest
follows from the product rules (g h)_12 = g1 h_12 + g_12 h2 and (g h)_12c = g1 h_12c + g_12 h_2c + g_12c h.
"""

from typing import NamedTuple

from ..types import Number
from . import equations as eq
from .equations import AnyTop


class Place(NamedTuple):
    """A point: c = cos(theta), s^2, f3 and the bracket B."""

    c: Number
    s2: Number
    f3: Number
    B: Number


class Differences(NamedTuple):
    """g_12, g_2c and g_12c."""

    over_12: Number
    over_2c: Number
    over_12c: Number


def of_f3(one: Place, two: Place, here: Place, top: AnyTop) -> Differences:
    """(32)  f3^2 = I3 + s^2 + (I3/I1)(c - a)^2: its differences divided by sums of f3, from f3^2 = f3 f3"""
    ratio = top.I3 / top.I1
    y_12 = ((ratio - 1) * (one.c + two.c) - 2 * ratio * top.a) / (one.f3 + two.f3)
    y_2c = ((ratio - 1) * (two.c + here.c) - 2 * ratio * top.a) / (two.f3 + here.f3)
    return Differences(y_12, y_2c, (ratio - 1 - y_12 * y_2c) / (one.f3 + here.f3))


def of_bracket(one: Place, two: Place, here: Place, K_R: Number, top: AnyTop) -> Differences:
    """(36)  B = K_J - (I3/I1)(c - a) K_R/f3, from the differences of f3 and of r = 1/f3"""
    y = of_f3(one, two, here, top)
    r_12, r_2c = -y.over_12 / (one.f3 * two.f3), -y.over_2c / (two.f3 * here.f3)
    r_12c = -(y.over_12c / one.f3 + r_12 * y.over_2c) / here.f3
    k = -top.I3 / top.I1 * K_R
    return Differences(k * ((one.c - top.a) * r_12 + 1 / two.f3), k * ((two.c - top.a) * r_2c + 1 / here.f3),
                       k * ((one.c - top.a) * r_12c + r_2c))  # fmt: skip


def Q(one: Place, two: Place, here: Place, K_R: Number, e: Number, top: AnyTop) -> Number:
    """(36)  s^2 theta_dot^2 = (c1 - c)(c - c2) Q, with the turning points c1 and c2

    Q f1^2 = -{s^2 [2E' - 2a(1 - c)] - f2^2 B^2}_12c, with (34)  f2^2 = I1 + (I1/I3) s^2 + (c - a)^2
    """
    B, ratio = of_bracket(one, two, here, K_R, top), top.I1 / top.I3
    f2_12, f2_12c = (1 - ratio) * (one.c + two.c) - 2 * top.a, 1 - ratio
    BB_12c = one.B * B.over_12c + B.over_12 * B.over_2c + B.over_12c * here.B
    BB_2c = B.over_2c * (two.B + here.B)
    kinetic = eq.f2_2(one.c, one.s2, top) * BB_12c + f2_12 * BB_2c + f2_12c * here.B * here.B
    potential = -(e - 2 * top.a) - 2 * top.a * (one.c + two.c + here.c)
    return (kinetic - potential) / eq.f1_2(here.c, top)
