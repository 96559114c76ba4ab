"""Where the energy of a motion stands between its steady precession and the two limits, and back."""

from dataclasses import dataclass

import numpy as np

from tippe_core import Top, figures
from tippe_core.types import Array

# Beyond it the squares of what follows leave a float's range.
LARGEST = 1e6
# A limit that is never reached still needs a place on the energy slider: this share of the energy above the last one.
UNLIMITED = 0.25


@dataclass(frozen=True, eq=False, kw_only=True)
class Marks:
    """The energies that the energy control is marked with, E; inf where nothing limits, nan where even the steady
    precession breaks the limit. nodes: the (3,) finite energies at which the control stands at 0, 1 and 2."""

    steady: float
    slip: float
    lift: float
    theta_steady: float
    nodes: Array

    def energy(self, share: float) -> float:
        """0 the steady precession, 1 the limit of friction, 2 that of F_z; straight on beyond 2, and below 0."""
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
    lift, slip = figures(top, [K_J], K_R, mu_s)
    steady, E_slip, E_lift = float(lift.E_steady[0]), float(slip.E[0]), float(lift.E[0])
    nodes = [steady]
    for E in (E_slip, E_lift):
        if np.isnan(E):
            E = nodes[-1]
        elif not E < steady + LARGEST * (1 + abs(steady)):  # no limit, or one that no top ever reaches
            E = nodes[-1] + UNLIMITED * (1 + abs(steady))
        nodes.append(max(E, nodes[-1]))  # rounding may put a limit below what it is a limit of
    if nodes[2] == nodes[0]:
        nodes[2] += UNLIMITED * (1 + abs(steady))
    return Marks(
        steady=steady, slip=E_slip, lift=E_lift, theta_steady=float(lift.theta_steady[0]), nodes=np.array(nodes)
    )
