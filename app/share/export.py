"""A Scene as tables (CSV, NPZ), with units and constants; its other files are made by glb.py and programs.py."""

import io
import json

import numpy as np

from app.model.regimes import NAMES, SLIPS
from app.model.scene import Scene
from app.text import DEFAULT, listed

REGIMES = listed("regimes.here", DEFAULT)
# name: (what it is, unit, scale of that unit in SI, SI unit)
UNITS = {
    "t": ("time", "(R/g)^1/2", "time", "s"),
    "theta": ("angle of axis 3 with the vertical", "rad", None, ""),
    "phi": ("azimuth of axis 1'", "rad", None, ""),
    "psi": ("turn about axis 3", "rad", None, ""),
    "quaternion": ("body to space, x y z w", "", None, ""),
    "contact": ("point of contact on the table, x y", "R", "R", "m"),
    "trace": ("point of contact in the body's axes, from the centre O of the ball, x y z", "R", "R", "m"),
    "com": ("centre of mass G, x y z", "R", "R", "m"),
    "omega": ("angular velocity about 1', 2', 3", "(g/R)^1/2", "angular_velocity", "rad/s"),
    "force": ("of the table on the top, along x = 1', y = z cross 1', z", "Mg", "force", "N"),
    "ratio": ("F_h/F_z", "", None, ""),
    "K_J": ("Jellett's constant from the motion", "(g/R)^1/2", "angular_velocity", "rad/s"),
    "K_R": ("Routh's constant from the motion", "(MR^2)^1/2 (g/R)^1/2", None, ""),
    "E": ("energy from the motion", "MgR", "energy", "J"),
    "regime": (", ".join(f"{code} {REGIMES[name]}" for code, name in enumerate(NAMES[:SLIPS])), "", None, ""),
}
LIMITS = {"lift": "F_z >= 0 alone", "slip": "F_h <= mu_s F_z as well"}
OF_LIMIT = {
    "E": "the largest E in MgR (inf: nothing limits it, nan: no motion)",
    "theta_inner": "inner turning point in rad",
    "theta_outer": "outer turning point in rad",
    "theta_verge": "where the limit is reached, in rad",
}
TIELINES = {
    "tieline_K_J": "the tielines of Fig. 6: K_J in (g/R)^1/2",
    **{f"{limit}_{name}": f"{says} under {what}" for limit, what in LIMITS.items() for name, says in OF_LIMIT.items()},
    "theta_steady": "the steady precession in rad",
}


def parameters(scene: Scene):
    """The parameters of the motion, every number to the last digit: {name: (value, unit)}."""
    top, constants, scales = scene.top, scene.constants, scene.scales
    inner, outer = scene.turning
    return {
        "a": (top.a, "R"), "I1": (top.I1, "MR^2"), "I3": (top.I3, "MR^2"), "K_J": (constants.K_J, "(g/R)^1/2"),
        "K_R": (constants.K_R, "(MR^2)^1/2 (g/R)^1/2"), "E": (constants.E, "MgR"), "mu_s": (float(scene.mu_s), ""),
        "theta_inner": (inner, "rad"), "theta_outer": (outer, "rad"),
        "R": (scales.R, "m"), "M": (scales.M, "kg"), "g": (scales.g, "m/s^2"),
    }  # fmt: skip


def motion_table(scene):
    """{name: (n,) or (n, k) array} of the motion, in the units of UNITS."""
    motion = scene.trajectory
    own = ("ratio", "K_J", "K_R", "E", "regime")  # of the Scene
    return {name: getattr(scene if name in own else motion, name) for name in UNITS}


def tieline_table(scene):
    """{name: (n,) array} of the tielines, in the units of TIELINES."""
    plane = scene.plane
    of_limits = {f"{limit}_{name}": getattr(getattr(plane, limit), name) for limit in LIMITS for name in OF_LIMIT}
    return {"tieline_K_J": plane.K_J} | of_limits | {"theta_steady": plane.lift.theta_steady}


def header(scene, link=""):
    """The lines above a table: its contents, the parameters, and the link."""
    lines = ["Tippe top explorer: a top that rolls without slipping (Gray and Nickel, Am. J. Phys. 68, 821 (2000))"]
    lines += [f"{name} = {value!r} {unit}".rstrip() for name, (value, unit) in parameters(scene).items()]
    return lines + [link] * bool(link)


def _unit_line(name, scales):
    what, unit, scale, si = UNITS[name]
    unit_text = f", in {unit}" * bool(unit) + (f" = {getattr(scales, scale):.6g} {si}" if scale else "")
    return f"{name}: {what}{unit_text}"


def motion_csv(scene, link=""):
    """The motion as CSV (bytes), one row for each frame, numbers to the last digit."""
    table = motion_table(scene)
    lines = header(scene, link) + [_unit_line(name, scene.scales) for name in table]
    return csv(lines, columns(table, {name: unit for name, (_, unit, *_) in UNITS.items()}))


def tielines_csv(scene, link=""):
    """Fig. 6's tielines as CSV (bytes), like motion_csv."""
    table = tieline_table(scene)
    return csv(header(scene, link) + [f"{name}: {TIELINES[name]}" for name in table], table)


def columns(table, units):
    """{name (unit): (n,) array} of each column of a table; units: {name: its unit, "" for a pure number}.

    Tracker takes columns that are called x and y for the track of a point, and any that ends with x or y: each name
    has a unit behind it, (1) for a pure number."""
    found = {}
    for name, values in table.items():
        axes = {"omega": ("1", "2", "3"), "quaternion": "xyzw"}.get(name, "xyz")
        rows = zip((f"{name}_{axis}" for axis in axes), values.T, strict=False) if values.ndim > 1 else [(name, values)]
        for called, column in rows:
            found[f"{called.removeprefix('contact_')} ({units[name] or 1})"] = column
    return found


def csv(lines, columns):
    """Columns of numbers below their names, as Tracker and spreadsheets open them, then lines that begin with #, as
    bytes."""
    rows = zip(*(column.tolist() for column in columns.values()), strict=True)
    text = ",".join(columns) + "\n" + "".join(",".join(map(repr, row)) + "\n" for row in rows)
    return (text + "".join(f"# {line}\n" for line in lines)).encode()


def arrays_npz(scene, link=""):
    """Motion and tielines as NPZ (bytes); `header`, a string, is JSON with the parameters, the units and the link."""
    fields = {
        "about": header(scene)[0],
        "link": link,
        "parameters": {name: {"value": value, "unit": unit} for name, (value, unit) in parameters(scene).items()},
        "units": {name: _unit_line(name, scene.scales) for name in UNITS} | TIELINES,
    }
    file = io.BytesIO()
    np.savez_compressed(file, header=np.array(json.dumps(fields)), **motion_table(scene), **tieline_table(scene))
    return file.getvalue()
