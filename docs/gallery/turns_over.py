"""Why it turns over

With friction, $C_J$ stays and the energy falls; so a fast top ends where it has the least energy for its $C_J$: on its
other end. The friction is Coulomb’s, $\\mu=0.3$, smoothed where it hardly slides.
"""

import matplotlib.pyplot as plt
import numpy as np

from tippe_core import Scales, SmoothedCoulomb, State, Top, slide

LINK = "?v=1&tab=three-planes&plane=sliding&law=smoothed&mu_smooth=.3&eps=1&stem=no&spin=25&tilt=.1&seconds=8"
top, scales = Top.paper(), Scales.paper()
spin = 25 * 2 * np.pi * scales.time
motion = slide(
    top, State(theta=0.1, theta_dot=0, omega2=0, omega3=spin), SmoothedCoulomb(0.3, eps=1.0), np.linspace(0, 200, 2000)
)
figure, (above, below) = plt.subplots(2, 1, sharex=True)
above.plot(motion.t * scales.time, np.degrees(motion.theta))
above.set_ylabel("θ, degrees")
below.plot(motion.t * scales.time, motion.energy / motion.energy[0], label="E")
below.plot(motion.t * scales.time, motion.jellett / motion.jellett[0], label="$C_J$")
below.set(xlabel="s", ylabel="of what it was")
below.legend()
