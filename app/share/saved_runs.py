"""The runs on the tables that are shown, to take home: as a table, as arrays, as a picture, in 3-D, and the Python that
computes one again."""

import io
import json
from dataclasses import dataclass

import numpy as np

from app.model.planes.picture import Setup
from app.share import export, glb, prints
from tippe_core import Trajectory

UNITS = {
    "t": ("time", "s", "time"), "theta": ("angle of axis 3 with the vertical", "rad", None),
    "phi": ("azimuth of axis 1'", "rad", None), "psi": ("turn about axis 3", "rad", None),
    "contact": ("point of contact on the table, x y", "m", "R"), "com": ("centre of mass G, x y z", "m", "R"),
    "quaternion": ("body to space, x y z w", "", None),
    "omega": ("angular velocity about 1', 2', 3", "rad/s", "angular_velocity"),
    "slip": ("velocity of the top's material at the contact, x y", "m/s", "velocity"),
    "force": ("of the table on the top, along x = 1', y = z cross 1', z", "N", "force"),
    "jellett": ("C_J, in MR^2 (g/R)^1/2", "", None), "routh": ("K_R, in (MR^2)^1/2 (g/R)^1/2", "", None),
    "energy": ("energy", "J", "energy"), "heat": ("heat since the start", "J", "energy"),
}  # fmt: skip
"""{array of a Trajectory: (what it is, unit, the scale that makes it SI)}."""
ROUGH, SMOOTH = "rough", "smooth"
SLIDING = {"ordinary": "sliding", "rough": ROUGH, "ice": SMOOTH} | {name: name for name in (ROUGH, SMOOTH, "sliding")}


@dataclass(frozen=True, eq=False)
class Shown:
    """One of them: the table, the motion, and what it began with."""

    table: str
    trajectory: Trajectory
    setup: Setup

    @property
    def name(self):
        """The table's name: rough, smooth or sliding."""
        return SLIDING[self.table]

    @property
    def parameters(self):
        """{name: (value, unit)} of what it is, every number to the last digit."""
        top, scales = self.setup.top, self.setup.scales
        law = repr(self.setup.friction) if self.name == "sliding" else self.name
        return {
            "table": (self.name, ""), "friction": (law, ""), "a": (top.a, "R"), "I1": (top.I1, "MR^2"),
            "I3": (top.I3, "MR^2"), "start": (repr(self.setup.state), ""), "R": (scales.R, "m"),
            "M": (scales.M, "kg"), "g": (scales.g, "m/s^2"),
        }  # fmt: skip

    # what glb.py takes of a Scene

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
    """A run as CSV (bytes), a row a frame; lines that begin with # say what it is."""
    lines = ["Tippe top explorer: a top on a table"]
    lines += [f"{name} = {value} {unit}".rstrip() for name, (value, unit) in shown.parameters.items()]
    lines += [link] * bool(link) + [f"{name}: {what}" + f", in {unit}" * bool(unit)
                                    for name, (what, unit, _) in UNITS.items()]  # fmt: skip
    return export.csv(lines, dict(export.columns(columns(shown))) | {"regime": shown.trajectory.regime})


def run_npz(shown, link=""):
    """A run as NPZ (bytes); `header`, a string, is JSON with parameters, units and the link."""
    said = {"parameters": {name: list(pair) for name, pair in shown.parameters.items()}, "link": link,
            "units": {name: f"{what} ({unit})" for name, (what, unit, _) in UNITS.items()}}  # fmt: skip
    file = io.BytesIO()
    np.savez_compressed(file, header=np.array(json.dumps(said)), regime=shown.trajectory.regime, **columns(shown))
    return file.getvalue()


def run_glb(shown, slower):
    """A run as a glTF animation (bytes)."""
    return glb.animation_glb(shown, slower, shown.parameters)


def run_print(shown, kind):
    """The tilt, the normal force and the energy of a run over time, as the bytes of a "png" or "svg" file."""
    moved, scales = shown.trajectory, shown.setup.scales
    rows = ((r"$\theta$ (°)", np.degrees(moved.theta)), (r"$F_z$ ($Mg$)", moved.force[:, 2]),
            (r"$E$ ($MgR$)", moved.energy))  # fmt: skip
    return prints.curves(moved.t * scales.time, rows, _caption(shown), kind)


def _caption(shown):
    top, state, scales = shown.setup.top, shown.setup.state, shown.setup.scales
    spin = state.omega3 * scales.angular_velocity / (2 * np.pi)
    return (
        f"$a$ = {top.a:.6g} $R$,  $I_1$ = {top.I1:.6g} $MR^2$,  $I_3$ = {top.I3:.6g} $MR^2$;  "
        f"$R$ = {1e3 * scales.R:.4g} mm,  $M$ = {1e3 * scales.M:.4g} g",
        rf"{shown.parameters['friction'][0]};  $\theta$ = {np.degrees(state.theta):.5g}°, {spin:.6g}/s",
    )


def run_python(shown):
    """Python whose `motion` is the trajectory."""
    setup, names = shown.setup, "theta theta_dot omega2 omega3 phi psi vx vy".split()
    given = {name: getattr(setup.state, name) for name in names}
    state = ", ".join(f"{name}={float(value)!r}" for name, value in given.items() if value is not None)
    times = setup.times
    edge = None if setup.edge is None else tuple(float(x) for x in setup.edge)
    moves = {
        ROUGH: "roll(top, None, t, grip(top, state)[0])",
        SMOOTH: "glide(top, state, t)",
        "sliding": f"slide(top, state, {setup.friction!r}, t, landing={setup.landing!r}, edge={edge!r})",
    }[shown.name]
    law = f"{type(setup.friction).__name__}, " * (shown.name == "sliding")
    uses = {ROUGH: "grip, roll", SMOOTH: "glide", "sliding": "slide"}[shown.name]
    return f"""\
import matplotlib.pyplot as plt
import numpy as np
from tippe_core import {law}State, Top, {uses}

top = {setup.top!r}
state = State({state})
t = np.linspace(0, {float(times[-1])!r}, {len(times)})
motion = {moves}
plt.plot(motion.t * {float(setup.scales.time)!r}, np.degrees(motion.theta))
plt.savefig("run.png")
"""
