"""Limit energies the slow way: for one energy after another, walk the whole trajectory and look at the contact force.

The motion at each theta is recovered from the definitions of the constants as vectors (rigid_body.constants), the
force from the rigid body's own equations: no formula of the paper, and no linearity in the energy, is used.
"""

import numpy as np
import rigid_body as rb
from references import kept
from scipy.optimize import brentq, minimize_scalar

ENDS = 10.0 ** -np.arange(2.1, 9, 0.05)
GRID = np.sort(np.concatenate([np.linspace(0.008, np.pi - 0.008, 1500), ENDS, np.pi - ENDS]))


class Family:
    """All motions with one K_J and K_R."""

    def __init__(self, top, K_J, K_R):
        self.body, self.K_J, self.K_R = rb.Body.of(top), K_J, K_R
        self.grid_floor = self.floor(GRID)

    def _constants(self, theta, w1, w2, w3):
        theta = np.asarray(theta, dtype=float)
        zero = 0 * theta
        q = np.stack([np.sin(theta / 2), zero, zero, np.cos(theta / 2)], axis=-1)  # phi = psi = 0: 1', 2' are 1, 2
        return rb.constants(self.body, q, np.stack([w1 + zero, w2 + zero, w3 + zero], axis=-1))

    def spins(self, theta):
        """(w2, w3): the constants are linear in them, so unit motions give the coefficients."""
        jellett_2, _, _ = self._constants(theta, 0, 1, 0)
        jellett_3, routh_3, _ = self._constants(theta, 0, 0, 1)
        w3 = self.K_R / routh_3
        return (self.K_J - jellett_3 * w3) / jellett_2, w3

    def floor(self, theta):
        """The least energy possible at theta (theta_dot = 0)."""
        return self._constants(theta, 0, *self.spins(theta))[2]

    def theta_dot(self, theta, E):
        at_rest = self._constants(theta, 0, 0, 0)[2]
        unit = self._constants(theta, 1, 0, 0)[2] - at_rest
        return np.sqrt(np.maximum(0, E - self.floor(theta)) / unit)

    def bottom(self):
        """(theta, E) of the steady precession of least energy."""
        k = np.argmin(self.grid_floor)
        low, high = GRID[max(k - 1, 0)], GRID[min(k + 1, len(GRID) - 1)]
        best = minimize_scalar(self.floor, bounds=(low, high), method="bounded", options={"xatol": 1e-12})
        return best.x, best.fun

    def ends(self, theta_p, E):
        """The turning points on either side of theta_p."""
        above = self.grid_floor > E
        left, right = np.flatnonzero(above & (GRID < theta_p)), np.flatnonzero(above & (GRID > theta_p))

        def end(k, default):
            if not k:
                return default
            return brentq(lambda x: self.floor(x) - E, *k, xtol=1e-14) if E > self.floor(theta_p) else theta_p

        nearest_left = max((x for x in GRID[left]), default=None)
        nearest_right = min((x for x in GRID[right]), default=None)
        inner = end((nearest_left, theta_p) if nearest_left is not None else None, GRID[0])
        outer = end((theta_p, nearest_right) if nearest_right is not None else None, GRID[-1])
        return inner, outer

    def margin(self, theta, E, mu_s):
        """Negative where the top lifts off or slips."""
        x, y, z = rb.force_at(self.body, theta, self.theta_dot(theta, E), *self.spins(theta))
        return z if mu_s is None else np.minimum(z, mu_s * z - np.hypot(x, y))

    def worst(self, E, mu_s, theta_p):
        """(least margin, theta of it) on the whole trajectory."""
        inner, outer = self.ends(theta_p, E)
        mean, half = (inner + outer) / 2, (outer - inner) / 2

        def along(kappa):
            return self.margin(np.clip(mean - half * np.cos(kappa), inner, outer), E, mu_s)

        kappa = np.linspace(0, np.pi, 201)
        values = along(kappa)
        k = int(np.argmin(values))
        best = minimize_scalar(along, bounds=(kappa[max(k - 1, 0)], kappa[min(k + 1, 200)]), method="bounded",
                               options={"xatol": 1e-10})  # fmt: skip
        if best.fun < values[k]:
            return best.fun, mean - half * np.cos(best.x)
        return values[k], mean - half * np.cos(kappa[k])

    def limit(self, mu_s=None):
        """(E, inner, outer, verge): the energies tried rise from the steady precession to the first that fails."""
        theta_p, E_p = self.bottom()
        if self.margin(theta_p, E_p, mu_s) < 0:
            return np.nan, np.nan, np.nan, np.nan
        good = E_p
        for rise in np.geomspace(1e-4, 1e5, 120):
            if self.worst(E_p + rise, mu_s, theta_p)[0] < 0:
                bad = E_p + rise
                break
            good = E_p + rise
        else:
            return np.inf, np.nan, np.nan, np.nan
        while bad - good > 1e-12 * max(1, abs(bad)):
            middle = (good + bad) / 2
            if middle in (good, bad):
                break
            if self.worst(middle, mu_s, theta_p)[0] < 0:
                bad = middle
            else:
                good = middle
        return good, *self.ends(theta_p, good), self.worst(bad, mu_s, theta_p)[1]


@kept
def limit(top, K_J, K_R, mu_s=None):
    """Family.limit()"""
    return Family(top, K_J, K_R).limit(mu_s)
