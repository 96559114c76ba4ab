"""The same start on three tables

Rough, smooth, and with friction. Only where it slips does the top turn over.
"""

import matplotlib.pyplot as plt
import numpy as np

from tippe_core import Scales, SmoothedCoulomb, State, Top, glide, roll, slide

LINK = "?v=2&tab=three-planes&table=three&by=hand&spin=20&tilt=17&law=smoothed&mu_k=.3&eps=1&stem=no&seconds=10"
top, scales = Top.paper(), Scales.paper()
times = np.linspace(0, 10, 4000) / scales.time
start = State(theta=np.radians(17), theta_dot=0, omega2=0, omega3=20 * 2 * np.pi * scales.time)
for name, motion in (
    ("rough", roll(top, None, times, start=start)),
    ("smooth", glide(top, start, times)),
    ("with friction", slide(top, start, SmoothedCoulomb(0.3, eps=1.0), times)),
):
    plt.plot(times * scales.time, np.degrees(motion.theta), label=name)
plt.xlabel("s")
plt.ylabel("θ, degrees")
plt.legend()
