"""Many tops at once: how much of the (K_J, theta) plane friction leaves them, and Fig. 6 of several side by side."""

from dataclasses import dataclass

import numpy as np

from tippe_core import Top, TopError, figures, pole_constants

TIELINES = 64


@dataclass(frozen=True, eq=False)
class Region:
    """Fig. 6 of one top: its name, K_J(P), and the tielines of both limits at part (n,) = K_J/K_J(P), 0 to 1."""

    name: str
    top: Top
    pole: float
    part: np.ndarray
    lift: object
    slip: object


def region(name, top, K_R, mu_s, count=TIELINES):
    """The Region of a top, from tippe_core's own tielines (on its grid of 256 theta, then refined)."""
    pole = pole_constants(top, K_R)[0]
    part = (np.arange(count) + 0.5) / count
    return Region(name, top, float(pole), part, *figures(top, part * pole, K_R, mu_s))


def allowed_share(top, K_R, mu_s):
    """The share, 0 to 1, of Fig. 5's region of the (K_J, theta) plane, K_J from 0 to P, that friction leaves.

    The area between the turning points of the tielines under F_h <= mu_s F_z, over the area under F_z >= 0 alone; a
    tieline that does not exist is 0 wide, one that nothing limits is as wide as theta.
    """
    both = region("", top, K_R, mu_s)
    slip, lift = (np.nansum(limit.theta_outer - limit.theta_inner) for limit in (both.slip, both.lift))
    return float(slip / lift) if lift else np.nan


@dataclass(frozen=True, eq=False)
class Map:
    """The share (m, n) over I3/I1 (m,) and a (n,), nan where there is no such top, or its row is not done."""

    a: np.ndarray
    ratio: np.ndarray
    share: np.ndarray


def share_map(I1, K_R, mu_s, a, ratio):
    """Yields (tops done, the Map so far) after every top. Whoever stops taking has stopped it."""
    share = np.full((len(ratio), len(a)), np.nan)
    for done, (row, column) in enumerate(np.ndindex(share.shape), 1):
        try:
            share[row, column] = allowed_share(Top(float(a[column]), I1, float(I1 * ratio[row])), K_R, mu_s)
        except TopError:
            pass  # no such top: the map has a hole there
        yield done, Map(a, ratio, share)


def neighbours(top, which):
    """[(name, Top)]: up to five tops with "a", or with "I3" at this I1, from half of this top's to one and a half."""
    tops = []
    for factor in (0.5, 0.75, 1.0, 1.25, 1.5):
        try:
            if which == "a":
                tops.append((f"a = {factor * top.a:.3g}", Top(factor * top.a, top.I1, top.I3)))
            else:
                tops.append((f"I₃/I₁ = {factor * top.I3 / top.I1:.3g}", Top(top.a, top.I1, factor * top.I3)))
        except TopError:
            continue  # half the family may not exist, such as I3 > 2 I1
    return tops
