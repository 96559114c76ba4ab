"""Why it turns over

With friction, $C_J$ stays and the energy falls; so a fast top ends where it has the least energy for its $C_J$:
inverted. The friction is Coulomb’s, $\\mu=0.3$, smoothed where it hardly slips.
"""

import matplotlib.pyplot as plt
import numpy as np

from tippe_core import Scales, SmoothedCoulomb, State, Top, slide

LINK = "?v=2&tab=three-planes&by=hand&spin=25&tilt=6&law=smoothed&mu_k=.3&eps=1&stem=no&seconds=8"
top, scales = Top.paper(), Scales.paper()
start = State(theta=np.radians(6), theta_dot=0, omega2=0, omega3=25 * 2 * np.pi * scales.time)
motion = slide(top, start, SmoothedCoulomb(0.3, eps=1.0), np.linspace(0, 8, 2000) / scales.time)
figure, (above, below) = plt.subplots(2, 1, sharex=True)
above.plot(motion.t * scales.time, np.degrees(motion.theta))
above.set_ylabel("θ, degrees")
below.plot(motion.t * scales.time, motion.energy / motion.energy[0], label="E")
below.plot(motion.t * scales.time, motion.jellett / motion.jellett[0], label="$C_J$")
below.set(xlabel="s", ylabel="of what it was")
below.legend()
