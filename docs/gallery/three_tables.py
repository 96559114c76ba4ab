"""The same throw on three tables

Rough, smooth, and with friction. Only where it slides does the top turn over.
"""

import matplotlib.pyplot as plt
import numpy as np

from tippe_core import SmoothedCoulomb, State, Top, glide, roll, slide

LINK = "?v=1&tab=three-planes&plane=compare&spin=20&tilt=.3&law=smoothed&mu_smooth=.3&eps=1&stem=no&seconds=10"
top, times = Top.paper(), np.linspace(0, 260, 4000)
start = State(theta=0.3, theta_dot=0, omega2=0, omega3=5.0)
for name, motion in (
    ("rough", roll(top, None, times, start=start)),
    ("smooth", glide(top, start, times)),
    ("with friction", slide(top, start, SmoothedCoulomb(0.3, eps=1.0), times)),
):
    plt.plot(times, np.degrees(motion.theta), label=name)
plt.xlabel("$t$, $(R/g)^{1/2}$")
plt.ylabel("θ, degrees")
plt.legend()
