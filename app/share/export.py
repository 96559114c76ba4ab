"""A Scene to take home: tables (CSV, NPZ) with units and constants, a glTF animation, the Python that gives it.

Nothing here draws; app/share/prints.py and app/share/letter.py do.
"""

import io
import json
import struct

import numpy as np

from app.model.regimes import WORDS
from app.model.scene import Scene
from tippe_core import turning_points

# name: (what it is, unit, the scale of that unit in SI, the SI unit)
UNITS = {
    "t": ("time", "(R/g)^1/2", "time", "s"),
    "theta": ("angle of axis 3 with the vertical", "rad", None, ""),
    "phi": ("azimuth of axis 1'", "rad", None, ""),
    "psi": ("turn about axis 3", "rad", None, ""),
    "quaternion": ("body to space, x y z w", "", None, ""),
    "contact": ("point of contact on the table, x y", "R", "R", "m"),
    "com": ("centre of mass G, x y z", "R", "R", "m"),
    "omega": ("angular velocity about 1', 2', 3", "(g/R)^1/2", "angular_velocity", "rad/s"),
    "force": ("of the table on the top, along x = 1', y = z cross 1', z", "Mg", "force", "N"),
    "ratio": ("F_h/F_z", "", None, ""),
    "K_J": ("Jellett's constant from the motion", "(g/R)^1/2", "angular_velocity", "rad/s"),
    "K_R": ("Routh's constant from the motion", "(MR^2)^1/2 (g/R)^1/2", None, ""),
    "E": ("energy from the motion", "MgR", "energy", "J"),
    "regime": (", ".join(f"{code} {word}" for code, word in enumerate(WORDS)), "", None, ""),
}
TIELINES = {
    "tieline_K_J": "the tielines of Fig. 6: K_J in (g/R)^1/2",
    **{
        f"{limit}_{name}": f"{says} under {what}"
        for limit, what in (("lift", "F_z >= 0 alone"), ("slip", "F_h <= mu_s F_z as well"))
        for name, says in {
            "E": "the largest E in MgR (inf: nothing limits it, nan: no motion)",
            "theta_inner": "inner turning point in rad",
            "theta_outer": "outer turning point in rad",
            "theta_verge": "where the limit is reached, in rad",
        }.items()
    },
    "theta_steady": "the steady precession in rad",
}

AROUND = 48  # corners of the body's rings in the glTF animation
GLTF_TYPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4"}
FLOAT, UNSIGNED, ARRAY, ELEMENTS = 5126, 5125, 34962, 34963
PAINT = ((0.72, 0.45, 0.20), (0.95, 0.90, 0.80))  # wood, in two tones, so that a turn shows


def parameters(scene: Scene):
    """What the motion is, every number to the last digit: {name: (value, unit)}."""
    top, constants, scales = scene.top, scene.constants, scene.scales
    inner, outer = scene.turning
    return {
        "a": (top.a, "R"),
        "I1": (top.I1, "MR^2"),
        "I3": (top.I3, "MR^2"),
        "K_J": (constants.K_J, "(g/R)^1/2"),
        "K_R": (constants.K_R, "(MR^2)^1/2 (g/R)^1/2"),
        "E": (constants.E, "MgR"),
        "mu_s": (float(scene.mu_s), ""),
        "theta_inner": (inner, "rad"),
        "theta_outer": (outer, "rad"),
        "R": (scales.R, "m"),
        "M": (scales.M, "kg"),
        "g": (scales.g, "m/s^2"),
    }


def motion_table(scene):
    """{name: (n,) or (n, k) array} of the motion, in the units of UNITS."""
    motion = scene.trajectory
    table = {name: getattr(motion, name) for name in ("t", "theta", "phi", "psi", "quaternion", "contact", "com")}
    return table | {
        "omega": motion.omega, "force": motion.force, "ratio": scene.ratio,
        "K_J": scene.K_J, "K_R": scene.K_R, "E": scene.E, "regime": scene.regime}  # fmt: skip


def tieline_table(scene):
    """{name: (n,) array} of the tielines shown, in the units of TIELINES."""
    plane = scene.plane
    table = {"tieline_K_J": plane.K_J}
    for limit in ("lift", "slip"):
        for name in ("E", "theta_inner", "theta_outer", "theta_verge"):
            table[f"{limit}_{name}"] = getattr(getattr(plane, limit), name)
    return table | {"theta_steady": plane.lift.theta_steady}


def header(scene, link=""):
    """The lines above a table: what it is, the parameters, where it is from."""
    lines = ["Tippe top explorer: a top that rolls without slipping (Gray and Nickel, Am. J. Phys. 68, 821 (2000))"]
    lines += [f"{name} = {value!r} {unit}".rstrip() for name, (value, unit) in parameters(scene).items()]
    return lines + [link] * bool(link)


def _unit_line(name, scales):
    what, unit, scale, si = UNITS[name]
    said = f", in {unit}" * bool(unit) + (f" = {getattr(scales, scale):.6g} {si}" if scale else "")
    return f"{name}: {what}{said}"


def motion_csv(scene, link=""):
    """The motion as CSV (bytes), a row a frame, numbers to the last digit; lines that begin with # say the units."""
    table = motion_table(scene)
    lines = header(scene, link) + [_unit_line(name, scene.scales) for name in table]
    return _csv(lines, dict(_columns(table)))


def tielines_csv(scene, link=""):
    """Fig. 6's tielines as CSV (bytes), like motion_csv."""
    table = tieline_table(scene)
    return _csv(header(scene, link) + [f"{name}: {TIELINES[name]}" for name in table], table)


def _columns(table):
    for name, values in table.items():
        if values.ndim == 1:
            yield name, values
            continue
        axes = {"omega": ("1", "2", "3"), "quaternion": "xyzw"}.get(name, "xyz")
        for axis, column in zip(axes, values.T, strict=False):
            yield f"{name}_{axis}", column


def _csv(lines, columns):
    text = "".join(f"# {line}\n" for line in lines) + ",".join(columns) + "\n"
    rows = zip(*(column.tolist() for column in columns.values()), strict=True)
    return (text + "".join(",".join(map(repr, row)) + "\n" for row in rows)).encode()


def arrays_npz(scene, link=""):
    """Motion and tielines as NPZ (bytes); `header`, a string, is JSON with parameters, units and the link."""
    said = {
        "about": header(scene)[0],
        "link": link,
        "parameters": {name: {"value": value, "unit": unit} for name, (value, unit) in parameters(scene).items()},
        "units": {name: _unit_line(name, scene.scales) for name in UNITS} | TIELINES,
    }
    file = io.BytesIO()
    np.savez_compressed(file, header=np.array(json.dumps(said)), **motion_table(scene), **tieline_table(scene))
    return file.getvalue()


def animation_glb(scene, slower=16.0):
    """The trajectory as a glTF 2.0 binary (bytes): the body, its track and the table, in m, y up.

    slower: how many times longer than the real motion the animation takes; the asset's extras say so too.
    The keyframes are the frames of the scene; the body's origin is O, which stands R above the contact.
    """
    R, motion = scene.scales.R, scene.trajectory
    file = _Gltf()
    points, normals, colours, corners = _revolved(scene.profile * R)
    body = file.mesh("the top", points, normals, colours, corners)
    track = np.column_stack([motion.contact * R, np.full(len(motion.t), 1e-3 * R)])
    path = file.line("track of the contact", track, (0.0, 0.447, 0.698, 1.0))
    middle, half = _around(track[:, :2], 3 * R)
    square = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * half + middle
    table = file.mesh(
        "table",
        np.column_stack([square, np.zeros(4)]),
        np.tile([0.0, 0.0, 1.0], (4, 1)),
        np.full((4, 3), 0.8),
        np.array([0, 1, 2, 0, 2, 3]),
    )
    centre = np.column_stack([motion.contact * R, np.full(len(motion.t), R)])
    seconds = file.accessor((motion.t - motion.t[0]) * scene.scales.time * slower, bounds=True)
    channels = [("translation", file.accessor(centre)), ("rotation", file.accessor(_unbroken(motion.quaternion)))]
    # physics has z up, glTF y
    upright = [-(0.5**0.5), 0.0, 0.0, 0.5**0.5]
    document = {
        "asset": {
            "version": "2.0",
            "generator": "Tippe top explorer",
            "extras": {
                "slower than the real top by": slower,
                "parameters": {name: f"{value!r} {unit}" for name, (value, unit) in parameters(scene).items()},
            },
        },
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [
            {"name": "z up", "rotation": upright, "children": [1, 2, 3]},
            {"name": "top", "mesh": body},
            {"name": "track", "mesh": path},
            {"name": "table", "mesh": table},
        ],
        "animations": [
            {
                "name": f"rolling, {slower:g} times slower",
                "samplers": [{"input": seconds, "output": output, "interpolation": "LINEAR"} for _, output in channels],
                "channels": [
                    {"sampler": i, "target": {"node": 1, "path": path}} for i, (path, _) in enumerate(channels)
                ],
            }
        ],
    }
    return file.packed(document)


class _Gltf:
    """Collects arrays and meshes; packed() makes the file."""

    def __init__(self):
        self._binary, self._views, self._accessors, self._meshes, self._materials = b"", [], [], [], []

    def accessor(self, values, target=None, bounds=False):
        integers = np.issubdtype(np.asarray(values).dtype, np.integer)
        values = np.ascontiguousarray(values, "<u4" if integers else "<f4")
        view = {"buffer": 0, "byteOffset": len(self._binary), "byteLength": values.nbytes}
        self._binary += values.tobytes()
        self._views.append(view | ({"target": target} if target else {}))
        columns = values.reshape(len(values), -1)
        accessor = {
            "bufferView": len(self._views) - 1,
            "componentType": UNSIGNED if integers else FLOAT,
            "count": len(columns),
            "type": GLTF_TYPES[columns.shape[1]],
        }
        if bounds:
            accessor |= {"min": columns.min(axis=0).tolist(), "max": columns.max(axis=0).tolist()}
        self._accessors.append(accessor)
        return len(self._accessors) - 1

    def mesh(self, name, points, normals, colours, corners):
        attributes = {
            "POSITION": self.accessor(points, ARRAY, bounds=True),
            "NORMAL": self.accessor(normals, ARRAY),
            "COLOR_0": self.accessor(colours, ARRAY),
        }
        material = {"pbrMetallicRoughness": {"metallicFactor": 0.0, "roughnessFactor": 0.6}, "doubleSided": True}
        return self._add(name, material, attributes=attributes, indices=self.accessor(corners, ELEMENTS))

    def line(self, name, points, colour):
        material = {"pbrMetallicRoughness": {"metallicFactor": 0.0, "baseColorFactor": list(colour)}}
        return self._add(name, material, attributes={"POSITION": self.accessor(points, ARRAY, bounds=True)}, mode=3)

    def _add(self, name, material, **primitive):
        self._materials.append(material)
        self._meshes.append({"name": name, "primitives": [primitive | {"material": len(self._materials) - 1}]})
        return len(self._meshes) - 1

    def packed(self, document):
        text = json.dumps(
            document
            | {
                "meshes": self._meshes,
                "materials": self._materials,
                "accessors": self._accessors,
                "bufferViews": self._views,
                "buffers": [{"byteLength": len(self._binary)}],
            }
        ).encode()
        text += b" " * (-len(text) % 4)
        chunks = struct.pack("<I4s", len(text), b"JSON") + text
        chunks += struct.pack("<I4s", len(self._binary), b"BIN\0") + self._binary
        return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def _revolved(profile):
    """(points, normals, colours, corners) of a profile (k, 2) turned about axis 3; each edge has its own two rings."""
    if profile[0, 1] > profile[-1, 1]:
        profile = profile[::-1]
    edges = np.stack([profile[:-1], profile[1:]], axis=1)
    along = np.diff(edges, axis=1)[:, 0]
    length = np.hypot(*along.T)
    edges, along, length = edges[length > 0], along[length > 0], length[length > 0]
    outwards = np.column_stack([along[:, 1], -along[:, 0]]) / length[:, None]
    angle = 2 * np.pi * np.arange(AROUND + 1) / AROUND
    round_, zero = np.column_stack([np.cos(angle), np.sin(angle)]), np.zeros(AROUND + 1)

    def turned(pairs):  # (edges, 2, AROUND + 1, 3)
        flat = pairs[..., 0, None, None] * np.column_stack([round_, zero])
        return flat + pairs[..., 1, None, None] * np.array([0.0, 0.0, 1.0])

    points = turned(edges).reshape(-1, 3)
    normals = turned(np.repeat(outwards[:, None], 2, axis=1)).reshape(-1, 3)
    sector = (np.arange(AROUND + 1) // (AROUND // 4)) % 2
    colours = np.tile(np.array(PAINT)[sector], (2 * len(edges), 1))
    ring = AROUND + 1
    k = np.arange(AROUND)
    quad = np.column_stack([k, k + 1, k + ring, k + ring, k + 1, k + ring + 1]).ravel()
    corners = (2 * ring * np.arange(len(edges))[:, None] + quad).ravel()
    return points, normals, colours, corners


def _around(points, margin):
    low, high = points.min(axis=0), points.max(axis=0)
    return (low + high) / 2, (high - low).max() / 2 + margin


def _unbroken(quaternion):
    """q and -q are one turn; with no change of sign from frame to frame what lies between is the shorter one."""
    flips = np.sign(np.sum(quaternion[1:] * quaternion[:-1], axis=1))
    return quaternion * np.concatenate([[1.0], np.cumprod(np.where(flips < 0, -1.0, 1.0))])[:, None]


def python_of_plane(scene):
    """Ten lines of Python whose `lift` and `slip` are Fig. 6's tielines."""
    return f"""\
import matplotlib.pyplot as plt
import numpy as np
from tippe_core import Top, figures

top = {scene.top!r}
K_J = {_rows(scene.plane)}
lift, slip = figures(top, K_J, K_R={scene.constants.K_R!r}, mu_s={float(scene.mu_s)!r})
plt.hlines(K_J, slip.theta_inner, slip.theta_outer)
plt.plot(lift.theta_inner, K_J, lift.theta_outer, K_J, slip.theta_verge, K_J, lift.theta_steady, K_J)
plt.savefig("fig6.png")
"""


def python_of_surface(scene):
    """Ten lines of Python whose `theta` and `height` are Fig. 5's surface, on the rows where something limits E."""
    plane, K_R = scene.plane, scene.constants.K_R
    which = ["lift-off", "slip"].index(plane.limit)
    share = f"(1 - np.cos(np.linspace(0, np.pi, {plane.theta.shape[1]}))) / 2"
    return f"""\
import matplotlib.pyplot as plt
import numpy as np
from tippe_core import Constants, Top, f1_squared, figures
from tippe_core.paper.curve import rounded_f

tie = figures(top := {scene.top!r}, {_rows(plane)}, K_R={K_R!r}, mu_s={float(scene.mu_s)!r})[{which}]
K_J, inner, outer = tie.K_J[:, None], tie.theta_inner[:, None], tie.theta_outer[:, None]
E = np.where(np.isfinite(tie.E), tie.E, tie.E_steady)[:, None]
theta = inner + (outer - inner) * ({share})
height = np.maximum(f1_squared(theta, top) * rounded_f(theta, top, Constants(K_J, {K_R!r}, E)), 0)
plt.figure().add_subplot(projection="3d").plot_surface(theta, K_J + 0 * theta, height).figure.savefig("fig5.png")
"""


def python_of_motion(scene):
    """Ten lines of Python whose `motion` is the trajectory, and `ratio` its F_h/F_z."""
    t = scene.trajectory.t
    return f"""\
import matplotlib.pyplot as plt
import numpy as np
from tippe_core import Constants, State, Top, roll

t = {float(t[1])!r} * np.arange({len(t)})
motion = roll({scene.top!r}, {_given(scene)})
F_x, F_y, F_z = motion.force.T
ratio = np.hypot(F_x, F_y) / np.abs(F_z)
plt.plot(t, motion.theta, t, F_z, t, ratio)
plt.savefig("motion.png")
"""


def _given(scene):
    """How roll() is told of the motion, at the times t."""
    constants, state = scene.constants, scene.state
    if scene.rolling.start is state:
        names = ("theta", "theta_dot", "omega2", "omega3", "phi", "psi")
        return f"None, t, start=State({', '.join(f'{name}={float(getattr(state, name))!r}' for name in names)})"
    wells = turning_points(scene.top, constants)
    return f"{constants!r}, t, well={int(np.abs(wells - scene.turning).sum(axis=1).argmin())}"


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
        times = f"np.linspace(0, {float(t[-1])!r}, {len(t)})"
        if name == "track":
            t = scene.trajectory.t
            times = f"{float(t[1])!r} * np.arange({len(t)})"
        return f"""import matplotlib.pyplot as plt
import numpy as np
from tippe_core import Constants, State, Top, roll

t = {times}
motion = roll({scene.top!r}, {_given(scene)})
x, y = {x_and_y}
plt.plot(x, y)
plt.savefig("{name}.png")
"""

    return python


def python_of_potential(scene):
    """Ten lines of Python whose `x` and `y` are the effective potential: the energy at which f, linear in it, is 0."""
    theta, _ = scene.potential
    K_J, K_R, E = scene.constants.K_J, scene.constants.K_R, scene.constants.E
    return f"""import matplotlib.pyplot as plt
import numpy as np
from tippe_core import Constants, Top, f

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
