"""Two bodies and their numbers

The motion depends on a body through three numbers, $a$, $I_1$ and $I_3$. Here they are for two bodies that can be
turned on a lathe.
"""

import matplotlib.pyplot as plt

from tippe_core import TruncatedSphere

LINK = "?v=1&tab=build-a-top&body=TruncatedSphere_.016_.0082_.0192_.0032_.0115"
paper = TruncatedSphere(R=0.016, c=0.0082, l=0.0192, r=0.0032, M=0.0115)
short = TruncatedSphere(R=0.016, c=0.0082, l=0.0120, r=0.0032, M=0.0115)
figure, places = plt.subplots(1, 2, sharey=True)
for body, axes in zip((paper, short), places, strict=True):
    radius, height = 100 * body.profile().T
    axes.fill_betweenx(height, -radius, radius, alpha=0.3)
    axes.plot(0, -100 * body.top.a * body.R, "ko")
    axes.set(aspect="equal", xlabel="cm", title=f"a = {body.top.a:.3f}, I₃/I₁ = {body.top.I3 / body.top.I1:.3f}")
places[0].set_ylabel("height above O, cm")
