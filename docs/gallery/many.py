"""Where four hundred starts end

Each dot is a run of the paper’s top with its stem; all begin with a tilt of 6° and last 24 s. From about 8 turns a
second on it tips over until its stem touches, at 119°. With little friction this takes longer. The explorer computes
the same runs as a map.
"""

import matplotlib.pyplot as plt
import numpy as np

from tippe_core import PRESETS, Scales, SmoothedCoulomb, State, Top, slide_many

LINK = "?v=2&tab=maps&map=spin_1_16_mu_.05_.6_smoothed_1_24_21_tilt_6_second_1"
top, scales = Top.paper(), Scales.paper()
spin, mu = np.meshgrid(np.linspace(1, 16, 21), np.linspace(0.05, 0.6, 21))
throws = [State(np.radians(6), 0, 0, each * 2 * np.pi * scales.time) for each in spin.ravel()]
tables = [SmoothedCoulomb(each, eps=1.0) for each in mu.ravel()]
many = slide_many(top, throws, tables, 24 / scales.time, edge=PRESETS[0].shape.edge)
shown = plt.scatter(spin.ravel(), mu.ravel(), c=np.degrees(many.theta_end), s=60, cmap="viridis", vmin=0, vmax=180)
plt.colorbar(shown, label="θ at the end, degrees")
plt.xlabel("turns a second")
plt.ylabel("μ")
