"""The track on the table

The points where a rolling top touches the table, over six nutations, and the path of its centre of mass above. Each
nutation is a copy of the first one, rotated and displaced. A fast top rolls almost straight on, so y is stretched here.
"""

import matplotlib.pyplot as plt
import numpy as np

from tippe_core import Constants, Rolling, Top

K_J, K_R, E = 2.0, 10.0, 49.0
LINK = "?v=1&tab=roll&by=E&KJ=2&KR=10&E=49&track=yes&G=yes"
rolling = Rolling(Top.paper(), Constants(K_J, K_R, E))
motion = rolling(np.linspace(0, 6 * rolling.period, 3000))
plt.plot(*motion.contact.T, lw=0.9, label="contact point")
plt.plot(*motion.com[:, :2].T, lw=0.9, label="centre of mass")
plt.xlabel("x, R")
plt.ylabel("y, R")
plt.legend()
