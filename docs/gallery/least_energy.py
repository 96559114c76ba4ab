"""Upright or inverted, by the spin

The least energy with a given $C_J$, over the tilt (note 58 of the paper). For a slow spin it is least upright, for a
fast one inverted. Between 6.6 and 6.9 turns a second both are minima, and so both are stable. The explorer shows the
curve for the start of a motion, here for 6.7 turns a second.
"""

import matplotlib.pyplot as plt
import numpy as np

from tippe_core import Scales, Top, jellett_potential

LINK = "?v=2&tab=three-planes&by=hand&spin=6.7&tilt=1&law=smoothed&mu_k=.3&eps=1&stem=no&seconds=8"
top, scales, theta = Top.paper(), Scales.paper(), np.linspace(0, np.pi, 300)
for spin in (5.0, 6.0, 6.7, 7.4, 8.0):
    omega3 = spin * 2 * np.pi * scales.time
    energy = jellett_potential(theta, top, top.I3 * omega3 * (1 - top.a))
    plt.plot(np.degrees(theta), energy - energy[0], label=f"{spin:g} turns a second")
plt.xlabel("θ, degrees")
plt.ylabel("least energy less that upright, $MgR$")
plt.legend()
