"""Where four hundred throws end

Each dot is a run; all begin with the same tilt. The spin decides whether it turns over. With little friction it also
takes long: these were followed for 600 $(R/g)^{1/2}$.
"""

import matplotlib.pyplot as plt
import numpy as np

from tippe_core import SmoothedCoulomb, State, Top, slide_many

LINK = "?v=2&tab=maps"
spin, mu = np.meshgrid(np.linspace(0.3, 4, 20), np.linspace(0.05, 0.6, 20))
throws = [State(0.1, 0, 0, each) for each in spin.ravel()]
tables = [SmoothedCoulomb(each, eps=1.0) for each in mu.ravel()]
many = slide_many(Top.paper(), throws, tables, 600.0)
shown = plt.scatter(spin.ravel(), mu.ravel(), c=np.degrees(many.theta_end), s=60, cmap="viridis", vmin=0, vmax=180)
plt.colorbar(shown, label="θ at the end, degrees")
plt.xlabel("spin, $(g/R)^{1/2}$")
plt.ylabel("μ")
