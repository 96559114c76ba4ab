"""Ten lines of Python that compute a picture's numbers."""

import numpy as np

HEAD = """\
import matplotlib.pyplot as plt
import numpy as np
from tippe_core import """


def python_of_plane(scene):
    """Ten lines of Python whose `lift` and `slip` are Fig. 6's tielines."""
    return f"""{HEAD}Top, lift_off_and_slip_tielines

top = {scene.top!r}
K_J = {_rows(scene.plane)}
lift, slip = lift_off_and_slip_tielines(top, K_J, K_R={scene.constants.K_R!r}, mu_s={float(scene.mu_s)!r})
plt.hlines(K_J, slip.theta_inner, slip.theta_outer)
plt.plot(lift.theta_inner, K_J, lift.theta_outer, K_J, slip.theta_verge, K_J, lift.theta_steady, K_J)
plt.savefig("fig6.png")
"""


def python_of_surface(scene):
    """Ten lines of Python whose `theta` and `height` are Fig. 5's surface, on the rows where E is limited."""
    plane, K_R = scene.plane, scene.constants.K_R
    which = ["lift-off", "slip"].index(plane.limit)
    share = f"(1 - np.cos(np.linspace(0, np.pi, {plane.theta.shape[1]}))) / 2"
    return f"""{HEAD}Constants, Top, f1_squared, lift_off_and_slip_tielines
from tippe_core.paper import rounded_f

tie = lift_off_and_slip_tielines(top := {scene.top!r}, {_rows(plane)}, K_R={K_R!r}, mu_s={float(scene.mu_s)!r})[{which}]
K_J, inner, outer = tie.K_J[:, None], tie.theta_inner[:, None], tie.theta_outer[:, None]
E = np.where(np.isfinite(tie.E), tie.E, tie.E_steady)[:, None]
theta = inner + (outer - inner) * ({share})
height = np.maximum(f1_squared(theta, top) * rounded_f(theta, top, Constants(K_J, {K_R!r}, E)), 0)
plt.figure().add_subplot(projection="3d").plot_surface(theta, K_J + 0 * theta, height).figure.savefig("fig5.png")
"""


def python_of_motion(scene):
    """Ten lines of Python whose `motion` is the trajectory, and `ratio` its F_h/F_z."""
    return f"""{HEAD}Constants, State, Top, roll

t = {_frames(scene)}
motion = roll({scene.top!r}, {_given(scene)})
F_x, F_y, F_z = motion.force.T
ratio = np.hypot(F_x, F_y) / np.abs(F_z)
plt.plot(t, motion.theta, t, F_z, t, ratio)
plt.savefig("motion.png")
"""


def _frames(scene):
    """The times of its frames as an expression."""
    t = scene.trajectory.t
    return f"{float(t[1])!r} * np.arange({len(t)})"


def _given(scene):
    """The arguments of roll() for this motion, at the times t."""
    constants, state = scene.constants, scene.state
    if scene.rolling.start is state:
        names = ("theta", "theta_dot", "omega2", "omega3", "phi", "psi")
        return f"None, t, start=State({', '.join(f'{name}={float(getattr(state, name))!r}' for name in names)})"
    return f"{constants!r}, t, well={scene.well}"


def python_of_portrait(name):
    """A function of a scene: ten lines of Python whose `x` and `y` are the curve of that portrait."""
    x_and_y = {
        "phase": "motion.theta, motion.omega[:, 0]",
        "f": "motion.theta, motion.omega[:, 0] ** 2",
        "track": "motion.contact.T",
        "force": "motion.force[:, :2].T / motion.force[:, 2]",
    }[name]

    def python(scene):
        t = scene.nutation.t
        times = _frames(scene) if name == "track" else f"np.linspace(0, {float(t[-1])!r}, {len(t)})"
        return f"""{HEAD}Constants, State, Top, roll

t = {times}
motion = roll({scene.top!r}, {_given(scene)})
x, y = {x_and_y}
plt.plot(x, y)
plt.savefig("{name}.png")
"""

    return python


def python_of_potential(scene):
    """Ten lines of Python whose `x` and `y` are the effective potential: the energy at which f, which is linear in it,
    is 0."""
    theta, _ = scene.potential
    K_J, K_R, E = scene.constants.K_J, scene.constants.K_R, scene.constants.E
    return f"""{HEAD}Constants, Top, f

top = {scene.top!r}
x = np.linspace({float(theta[0])!r}, {float(theta[-1])!r}, {len(theta)})
low, high = (f(x, top, Constants({K_J!r}, {K_R!r}, E)) for E in (0.0, {E!r}))
y = {E!r} * low / (low - high)
plt.plot(x, y, {list(map(float, scene.turning))!r}, {[E, E]!r})
plt.savefig("potential.png")
"""


def _rows(plane):
    """The K_J of Plane's tielines as an expression: even steps, and those through the poles."""
    even = plane.hover_K_J
    step = float(even[1] - even[0])
    poles = ", ".join(repr(float(K_J)) for K_J in np.setdiff1d(plane.K_J, even))
    return f"np.union1d({step!r} * np.arange({round(even[0] / step)}, {round(even[-1] / step) + 1}), [{poles}])"


PYTHON = {
    "Fig. 6": python_of_plane, "Fig. 5": python_of_surface, "The motion": python_of_motion,
    **{name: python_of_portrait(name) for name in ("phase", "f", "track", "force")}, "potential": python_of_potential,
}  # fmt: skip
