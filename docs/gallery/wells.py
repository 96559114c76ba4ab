"""Between which tilts it nutates

The square of $\\dot\\theta$, (36), over the tilt, for three energies. A motion is possible where it is not negative.
The dots are the turning points.
"""

import matplotlib.pyplot as plt
import numpy as np

from tippe_core import Constants, Top, f, turning_points

K_J, K_R, E = 7.0, 10.0, 27.98
LINK = "?v=1&tab=roll&by=E&KJ=7&KR=10&E=27.98"
top, theta = Top.paper(), np.linspace(0.3, 0.95, 300)
for energy in (27.85, E, 28.2):
    motion = Constants(K_J, K_R, energy)
    plt.plot(theta, f(theta, top, motion), label=f"E = {energy}")
    plt.plot(turning_points(top, motion)[0], [0, 0], "ko")
plt.axhline(0, color="k", lw=0.8)
plt.xlabel("θ, rad")
plt.ylabel("$\\dot\\theta^2=f(\\theta)$, $g/R$")
plt.ylim(-2, None)
plt.legend()
