"""Conversion between the energy of a motion and its position between steady precession and the two limits."""

from dataclasses import dataclass

import numpy as np

from tippe_core import Top, lift_off_and_slip_tielines
from tippe_core.types import Array

# Above this, squares of what follows exceed the range of floats.
LARGEST = 1e6
# A limit that is never reached still needs a place on the energy slider: this fraction above the last energy.
UNLIMITED = 0.25


@dataclass(frozen=True, eq=False, kw_only=True)
class Marks:
    """The energies that are marked on the energy control, E; inf if nothing limits the energy, nan if even the steady
    precession violates the limit. nodes: (3,), the finite energies at the positions 0, 1 and 2."""

    steady: float
    slip: float
    lift: float
    theta_steady: float
    nodes: Array

    def energy(self, share: float) -> float:
        """The energy at a position: 0 is the steady precession, 1 the limit of friction, 2 that of F_z; linear beyond 2
        and below 0."""
        slopes = np.diff(self.nodes)
        if share < 0:
            return self.nodes[0] + share * (slopes[0] or slopes[1])
        if share > 2:
            return self.nodes[2] + (share - 2) * (slopes[1] or slopes[0])
        return float(np.interp(share, (0, 1, 2), self.nodes))

    def share(self, energy: float) -> float:
        """The inverse of energy(share)."""
        start, middle, end = self.nodes
        if energy < start:
            return (energy - start) / ((middle - start) or (end - start))
        if energy > end:
            return 2 + (energy - end) / ((end - middle) or (end - start))
        if middle > start and energy <= middle:
            return (energy - start) / (middle - start)
        return 1 + (energy - middle) / (end - middle) if end > middle else 1.0


def energy_marks(top: Top, K_J: float, K_R: float, mu_s: float) -> Marks:
    lift, slip = lift_off_and_slip_tielines(top, [K_J], K_R, mu_s)
    steady, E_slip, E_lift = float(lift.E_steady[0]), float(slip.E[0]), float(lift.E[0])
    nodes = [steady]
    for E in (E_slip, E_lift):
        if np.isnan(E):
            E = nodes[-1]
        elif not E < steady + LARGEST * (1 + abs(steady)):  # no limit, or one that no top ever reaches
            E = nodes[-1] + UNLIMITED * (1 + abs(steady))
        nodes.append(max(E, nodes[-1]))  # rounding may put one limit below another
    if nodes[2] == nodes[0]:
        nodes[2] += UNLIMITED * (1 + abs(steady))
    return Marks(steady=steady, slip=E_slip, lift=E_lift, theta_steady=float(lift.theta_steady[0]),
                 nodes=np.array(nodes))  # fmt: skip
