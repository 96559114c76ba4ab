"""Files of the runs on the tables that are shown: tables, arrays, figures, 3-D animations, and the Python that computes
a run again."""

import io
import json
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicHermiteSpline, CubicSpline

from app.model.life import pushed_rows
from app.model.phases import carried
from app.model.pushes import push_words
from app.model.regimes import OF_CORE
from app.model.setup import Setup
from app.share import export, glb, prints, programs
from app.text import say
from tippe_core import Contensou, Coulomb, SmoothedCoulomb, Trajectory

SLIP = ("velocity of the top's material at the contact, x y", "(gR)^1/2", "velocity", "m/s")
UNITS = {
    name: (what, si or unit, scale)
    for name in ("t", "theta", "phi", "psi", "contact", "com", "trace", "quaternion", "omega", "slip", "force")
    for what, unit, scale, si in [{**export.UNITS, "slip": SLIP}[name]]
} | {
    "jellett": ("C_J, in MR^2 (g/R)^1/2", "", None), "routh": ("K_R, in (MR^2)^1/2 (g/R)^1/2", "", None),
    "energy": ("energy", "J", "energy"), "heat": ("heat since the start", "J", "energy"),
}  # fmt: skip
"""{array of a Trajectory: (what it is, unit, its scale in SI)}."""
SUPPORTS = np.array(["ball", "stem", "both", "none"])
CODES = {
    "regime": (", ".join(f"{code} {name}" for name, code in OF_CORE.items()), "", None),
    "support": (", ".join(f"{code} {name}" for code, name in enumerate(SUPPORTS)), "", None),
}
"""The same of the columns that say what it does and what it stands on, as numbers: Tracker reads no words."""
ORDINARY, ROUGH, ICE = "ordinary", "rough", "ice"
OF_ONE = "in units of M, R and g"
LONGEST = 60.0  # s: the longest animation
NODS = 12  # how many nods are drawn of a motion that repeats them for ever


@dataclass(frozen=True, eq=False)
class Shown:
    """One of these runs: the table, the motion, and its start."""

    table: str
    trajectory: Trajectory
    setup: Setup

    @property
    def parameters(self):
        """{name: (value, unit)} of its parameters, every number to the last digit."""
        top, scales = self.setup.top, self.setup.scales
        law = (repr(self.setup.friction), OF_ONE) if self.table == ORDINARY else (self.table, "")
        pushes = {f"push {i}": (f"{push.size:.6g} mN s at {push.t:.6g} s", "")
                  for i, push in enumerate(self.setup.pushes, 1)}  # fmt: skip
        return pushes | {
            "table": (self.table, ""), "friction": law, "a": (top.a, "R"), "I1": (top.I1, "MR^2"),
            "I3": (top.I3, "MR^2"), "start": (repr(self.setup.state), OF_ONE), "R": (scales.R, "m"),
            "M": (scales.M, "kg"), "g": (scales.g, "m/s^2"),
        }  # fmt: skip

    # the attributes of a Scene that glb.py needs

    @property
    def scales(self):
        return self.setup.scales

    @property
    def profile(self):
        return self.setup.profile


def columns(shown):
    """{name: (n,) or (n, k) array} of a run, in the units of UNITS."""
    scales = shown.setup.scales
    return {name: getattr(shown.trajectory, name) * (getattr(scales, scale) if scale else 1.0)
            for name, (_, _, scale) in UNITS.items()}  # fmt: skip


def run_csv(shown, link=""):
    """A run as CSV (bytes), one row for each frame; lines that begin with #, below the numbers, describe it."""
    lines = ["Tippe top explorer: a top on a table"]
    lines += [f"{name} = {value} {unit}".rstrip() for name, (value, unit) in shown.parameters.items()]
    lines += [link] * bool(link) + [f"{name}: {what}" + f", in {unit}" * bool(unit)
                                    for name, (what, unit, _) in (UNITS | CODES).items()]  # fmt: skip
    moved = shown.trajectory
    on = np.argmax(carried(moved, moved.t)[:, None] == SUPPORTS, axis=1)
    table = columns(shown) | {"regime": np.array([OF_CORE[name] for name in moved.regime]), "support": on}
    return export.csv(lines, export.columns(table, {name: unit for name, (_, unit, _) in (UNITS | CODES).items()}))


def run_npz(shown, link=""):
    """A run as NPZ (bytes); `header`, a string, is JSON with the parameters, the units and the link."""
    header = {"parameters": {name: list(pair) for name, pair in shown.parameters.items()}, "link": link,
            "units": {name: f"{what} ({unit})" for name, (what, unit, _) in UNITS.items()}}  # fmt: skip
    file = io.BytesIO()
    np.savez_compressed(file, header=np.array(json.dumps(header)), regime=shown.trajectory.regime, **columns(shown))
    return file.getvalue()


def run_glb(shown, slower):
    """A run as a glTF animation (bytes), this many times slower than in reality, but not longer than LONGEST."""
    seconds = shown.trajectory.t[-1] * shown.setup.scales.time
    slower = max(1.0, min(slower, LONGEST / seconds))
    name = {ORDINARY: "on an ordinary table", ROUGH: "rolling", ICE: "on ice"}[shown.table]
    return glb.animation_glb(shown, slower, shown.parameters, name)


def run_print(shown, kind):
    """The tilt, the normal force and the energy of a run over time, and its trace, as the bytes of a "png" or "svg"
    file."""
    return prints.curves(*drawn(shown), shown.trajectory.trace[: _first_nods(shown) or None], kind)


def drawn(shown):
    """What run_print draws: (s, {quantity: values}, two lines of mathtext)."""
    moved, words = shown.trajectory, caption(shown)
    seconds = moved.t * shown.setup.scales.time
    rows = {r"$\theta$ (°)": np.degrees(moved.theta), r"$F_z$ ($Mg$)": moved.force[:, 2], r"$E$ ($MgR$)": moved.energy}
    count = _first_nods(shown)
    if not count:
        return seconds, rows, words
    t = moved.t[:count]
    smooth = np.linspace(0, t[-1], 40 * NODS)
    rows = {name: CubicSpline(t, values[:count])(smooth) for name, values in rows.items()}
    # the rate of the tilt is in each frame, omega_1
    rows[next(iter(rows))] = np.degrees(CubicHermiteSpline(t, moved.theta[:count], moved.omega[:count, 0])(smooth))
    wording = say("share.first", first=seconds[count - 1], whole=seconds[-1])
    return smooth * shown.setup.scales.time, rows, (words[0], words[1] + wording)


def _first_nods(shown):
    """The number of frames of the first NODS nods if the motion has so many that all of them would be a black area;
    else 0."""
    turns = np.flatnonzero(np.diff(np.sign(np.diff(shown.trajectory.theta)))) + 2
    return 0 if shown.table == ORDINARY or len(turns) <= 4 * NODS else int(turns[2 * NODS])


def caption(shown):
    """Its description, in two lines of mathtext."""
    top, state, scales = shown.setup.top, shown.setup.state, shown.setup.scales
    spin = state.omega3 * scales.angular_velocity / (2 * np.pi)
    return (
        f"$a$ = {top.a:.6g} $R$,  $I_1$ = {top.I1:.6g} $MR^2$,  $I_3$ = {top.I3:.6g} $MR^2$;  "
        f"$R$ = {1e3 * scales.R:.4g} mm,  $M$ = {1e3 * scales.M:.4g} g",
        rf"{_law(shown)};  $\theta$ = {np.degrees(state.theta):.5g}°, {say('share.spin', spin=spin)}"
        + f", {push_words(shown.setup.pushes)}" * bool(shown.setup.pushes),
    )


def _law(shown):
    """The friction law in words, lengths in mm and speeds in cm/s."""
    law, scales = shown.setup.friction, shown.setup.scales
    if shown.table != ORDINARY:
        return say(f"share.laws.{shown.table}")
    match law:
        case Contensou(mu=mu, radius=radius):
            return say("share.laws.contact", mu=mu, patch=1e3 * scales.R * radius)
        case Coulomb(mu_k=mu_k, mu_s=mu_s):
            return say("share.laws.coulomb", mu_k=mu_k, mu_s=mu_s)
        case SmoothedCoulomb(mu=mu, eps=eps):
            return say("share.laws.smoothed", mu=mu, speed=100 * scales.velocity * eps)
    return say("share.laws.viscous", gamma=law.gamma / scales.velocity)


def run_python(shown):
    """Python whose `motion` is the trajectory; that from its last push on if it is pushed."""
    setup, names = shown.setup, "theta theta_dot omega2 omega3 phi psi x y vx vy z vz".split()
    pushed, times = pushed_rows(shown.trajectory)[-1:], setup.times
    begins = shown.trajectory.at(shown.trajectory.t[pushed[0]]) if pushed else setup.state
    given = {name: getattr(begins, name) for name in names}
    state = ", ".join(f"{name}={float(value)!r}" for name, value in given.items() if value is not None)
    first = float(shown.trajectory.t[pushed[0]]) if pushed else 0
    edge = None if setup.edge is None else tuple(float(x) for x in setup.edge)
    moves = {
        ROUGH: "roll(top, None, t, grip(top, state)[0])",
        ICE: "glide(top, state, t)" if begins.z is None else "slide(top, state, Viscous(0.0), t)",
        ORDINARY: f"slide(top, state, {setup.friction!r}, t, landing={setup.landing!r}, edge={edge!r})",
    }[shown.table]
    law = f"{type(setup.friction).__name__}, " * (shown.table == ORDINARY)
    uses = {ROUGH: "grip, roll", ICE: "glide" if begins.z is None else "Viscous, slide", ORDINARY: "slide"}[shown.table]
    return f"""{programs.HEAD}{law}State, Top, {uses}

top = {setup.top!r}
state = State({state}){"  # just after its last push" * bool(pushed)}
t = np.linspace({first!r}, {float(times[-1])!r}, {len(times)})
motion = {moves}
plt.plot(motion.t * {float(setup.scales.time)!r}, np.degrees(motion.theta))
plt.savefig("run.png")
"""
