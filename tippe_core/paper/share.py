"""How much of the (K_J, theta) plane is left by finite friction: Fig. 6 compared with Fig. 5, for thousands of tops a
second."""

import numpy as np
from numpy.typing import ArrayLike

from ..compiled import compiled
from ..errors import checked, finite, positive
from ..types import Array, Scalars
from .constants import versines
from .limits import MORE, least_U, limit_of
from .poles import Floats, K_J_of_pole, angle
from .tielines import tilts_near_poles
from .top import TopNumbers

ROWS = 64  # values of K_J
PART = (np.arange(ROWS) + 0.5) / ROWS  # in units of K_J(P)
MUCH = 1.3
POINTS, CLOSE = 10, 1e-4  # on each side of a steady precession; relative accuracy of a zero
GRID_V, GRID_M = versines(tilts_near_poles(32))


@checked
def allowed_shares(a: ArrayLike, I1: ArrayLike, I3: ArrayLike, K_R: float, mu_s: float) -> Scalars:
    """How much of the region of Fig. 5 in the (K_J, theta) plane, K_J from 0 to P, is left if the top must not slip.

    It is the sum of the widths in theta of 64 tielines with F_h <= mu_s F_z, divided by the same sum with F_z >= 0
    alone. A tieline without a motion has width 0, one that nothing limits has width pi.

    Parameters
    ----------
    a, I1, I3 : float or array
        of many tops, as in Top (R, MR^2); they broadcast together
    K_R : float
        (31), in (MgR)^1/2
    mu_s : float
        coefficient of static friction, 0 or more

    Returns
    -------
    float or array
        0 to 1; nan where there is no such Top, or where the region of Fig. 5 is empty

    Raises
    ------
    TopError
        for a K_R or mu_s out of range
    """
    K_R, mu_s = finite("K_R", K_R), positive("mu_s", mu_s, zero=True)
    a, I1, I3 = np.broadcast_arrays(*(np.asarray(value, dtype=float) for value in (a, I1, I3)))
    share = np.full(a.shape, np.nan)
    with np.errstate(all="ignore"):
        there = np.isfinite(a) & np.isfinite(I1) & np.isfinite(I3) & (a < 1) & (I1 > 0) & (I3 > 0) & (I3 <= 2 * I1)
        lift, slip = widths(GRID_V, GRID_M, a[there], I1[there], I3[there], K_R, mu_s, PART).sum(axis=2)
        share[there] = slip / lift
    return share if share.ndim else float(share)


@compiled
def widths(V: Array, M: Array, a: Array, I1: Array, I3: Array, K_R: float, mu_s: float, part: Array) -> Array:
    """Widths in theta (rad) of the tielines of Figs. 5 and 6, (2, n, len(part)), of n tops at K_J = part * K_J(P)."""
    found, paths, far = np.empty((2, len(a), len(part))), np.empty((2, POINTS + MORE + 2, 6)), np.empty(2)
    near, reach = np.empty(2), np.empty(2)
    limits = ((1.0, 0.0), (mu_s, 1.0))
    for i in range(len(a)):
        top = TopNumbers(a[i], I1[i], I3[i])
        upright, inverted = K_J_of_pole(1.0, K_R, top), K_J_of_pole(-1.0, K_R, top)
        for j in range(len(part)):
            K_J = part[j] * upright
            curve = Floats(top, K_R, K_J - upright, K_J - inverted)
            x, side, _ = least_U(V, M, curve, CLOSE)
            near[0], near[1] = angle(x, side), angle(x, -side)
            for way in range(2):  # much as far as the last one
                far[way] = max(near[way] - MUCH * reach[way], 0.0) if j > 0 else 0.0
            for k in range(2):
                _, inner, outer, _, _ = limit_of(paths, x, side, POINTS, curve, limits[k], far, CLOSE)
                found[k, i, j] = outer - inner if outer > inner else 0.0
                if k == 0:
                    reach[:] = near - far
    return found
