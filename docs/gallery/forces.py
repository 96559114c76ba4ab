"""What the table does

The force (37) to (39) during half a nutation, in units of the weight. The table holds a rolling top sideways with
$\\mu_sF_z$ at most; where the dashed line is above that, it slips.
"""

import matplotlib.pyplot as plt
import numpy as np

from tippe_core import Constants, Top, friction_force, normal_force, turning_points

K_J, K_R, E = 7.0, 10.0, 27.98
LINK = "?v=1&tab=roll&by=E&KJ=7&KR=10&E=27.98"
top, motion = Top.paper(), Constants(K_J, K_R, E)
inner, outer = turning_points(top, motion)[0]
theta = np.linspace(inner, outer, 400)[1:-1]
F_z, (F_x, F_y) = normal_force(theta, top, motion), friction_force(theta, top, motion)
for force, name in ((F_z, "$F_z$"), (F_x, "$F_x$"), (F_y, "$F_y$"), (0.5 * F_z, "$\\mu_sF_z$")):
    plt.plot(theta, force, label=name)
plt.plot(theta, np.hypot(F_x, F_y), "k--", label="$F_h$")
plt.xlabel("θ, rad")
plt.ylabel("force, $Mg$")
plt.legend()
