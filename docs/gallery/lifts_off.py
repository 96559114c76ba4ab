"""How far it can lean before it lifts off (Fig. 5 of the paper)

Each line is one motion: the one with the most energy that a rolling top of that $K_J$ can have, from its inner turning
point to its outer one. With more, the table would have to pull it down somewhere.
"""

import matplotlib.pyplot as plt
import numpy as np

from tippe_core import Top, pole_constants, tielines

LINK = "?v=1&tab=roll&limit=lift"
top, K_R = Top.paper(), 10.0
K_J = np.linspace(0, pole_constants(top, K_R)[0], 120)
lines = tielines(top, K_J, K_R)
plt.fill_between(K_J, lines.theta_inner, lines.theta_outer, alpha=0.3)
plt.vlines(K_J[::6], lines.theta_inner[::6], lines.theta_outer[::6])
plt.xlabel("$K_J$")
plt.ylabel("θ, rad")
