"""Which end is up at which spin

The least energy with a given $C_J$, over the angle (note 58 of the paper). For a slow spin it is least upright, for a
fast one inverted, between the two at an angle.
"""

import matplotlib.pyplot as plt
import numpy as np

from tippe_core import Top, jellett_potential

LINK = "?v=1&tab=learn&learn=lesson"
top, theta = Top.paper(), np.linspace(0, np.pi, 300)
for spin in (1.2, 1.5, 1.6, 1.7, 2.0):
    energy = jellett_potential(theta, top, top.I3 * spin * (1 - top.a))
    plt.plot(np.degrees(theta), energy - energy[0], label=f"spin {spin}")
plt.xlabel("θ, degrees")
plt.ylabel("least energy less that upright, $MgR$")
plt.legend()
