"""How far it can lean before it slips (Fig. 6)

As above, on a table that holds it sideways with half of its weight at most, $\\mu_s=0.5$. The dashed line is where the
motions with the most energy are on the verge of slipping.
"""

import matplotlib.pyplot as plt
import numpy as np

from tippe_core import Top, pole_constants, tielines

LINK = "?v=1&tab=roll&mu=.5&limit=slip"
top, K_R = Top.paper(), 10.0
K_J = np.linspace(0, pole_constants(top, K_R)[0], 120)
lines = tielines(top, K_J, K_R, mu_s=0.5)
plt.fill_between(K_J, lines.theta_inner, lines.theta_outer, alpha=0.3)
plt.plot(K_J, lines.theta_verge, "k--")
plt.xlabel("$K_J$")
plt.ylabel("θ, rad")
