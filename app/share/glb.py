"""The motion as a glTF 2.0 animation."""

import json
import struct

import numpy as np

from app.model.lab.traced import pieces
from app.share.export import parameters

AROUND = 48  # points around each ring of the body
GLTF_TYPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4"}
FLOAT, UNSIGNED, ARRAY, ELEMENTS = 5126, 5125, 34962, 34963
OVER = 1.006  # R from O: so that the ball does not hide the trace
PAINT = ((0.72, 0.45, 0.20), (0.95, 0.90, 0.80))  # wood, in two tones, so that the rotation is visible


def animation_glb(scene, slower=16.0, described=None, name="rolling"):
    """The trajectory as a glTF 2.0 binary (bytes): the body with the trace on it, its track and the table, in m, y
    up.

    slower: how many times longer than the real motion the animation takes; this is also in the asset's extras. scene: a
    Scene, or an object with the same attributes, such as saved_runs.Shown; described: its parameters; name: that of the
    animation. The keyframes are the frames of the scene; the body's origin is O, which is a above G along the axis.
    """
    R, motion, described = scene.scales.R, scene.trajectory, described or parameters(scene)
    file = _Gltf()
    points, normals, colours, corners = _revolved(scene.profile * R)
    body = file.mesh("the top", points, normals, colours, corners)
    track = np.column_stack([motion.contact * R, np.full(len(motion.t), 1e-3 * R)])
    path = file.line("track of the contact", track)
    marks = np.repeat(pieces(motion.trace), 2, axis=1)[:, 1:-1].reshape(-1, 3)  # both ends of each part
    line = [{"name": "trace on the ball", "mesh": file.line("the trace", OVER * R * marks, 1)}] if len(marks) else []
    middle, half = _around(track[:, :2], 3 * R)
    square = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * half + middle
    table = file.mesh("table", np.column_stack([square, np.zeros(4)]), np.tile([0.0, 0.0, 1.0], (4, 1)),
                      np.full((4, 3), 0.8), np.array([0, 1, 2, 0, 2, 3]))  # fmt: skip
    x, y, z, w = motion.quaternion.T
    axis = np.column_stack([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)])
    centre = (motion.com + motion.top.a * axis) * R
    seconds = file.accessor((motion.t - motion.t[0]) * scene.scales.time * slower, bounds=True)
    channels = [("translation", file.accessor(centre)), ("rotation", file.accessor(_unbroken(motion.quaternion)))]
    # physics has z up, glTF has y up
    upright = [-(0.5**0.5), 0.0, 0.0, 0.5**0.5]
    written = {key: f"{value if isinstance(value, str) else repr(value)} {unit}".rstrip()
               for key, (value, unit) in described.items()}  # fmt: skip
    extras = {"slower than the real top by": slower, "parameters": written}
    document = {
        "asset": {"version": "2.0", "generator": "Tippe top explorer", "extras": extras},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [
            {"name": "z up", "rotation": upright, "children": [1, 2, 3]},
            {"name": "top", "mesh": body} | ({"children": [4]} if line else {}),
            {"name": "track", "mesh": path},
            {"name": "table", "mesh": table},
            *line,
        ],
        "animations": [
            {
                "name": f"{name}, {slower:.3g} times slower",
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
        accessor = {"bufferView": len(self._views) - 1, "componentType": UNSIGNED if integers else FLOAT,
                    "count": len(columns), "type": GLTF_TYPES[columns.shape[1]]}  # fmt: skip
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

    def line(self, name, points, mode=3):
        """A line through these points; with mode 1 lines between two of them each."""
        material = {"pbrMetallicRoughness": {"metallicFactor": 0.0, "baseColorFactor": [0.0, 0.447, 0.698, 1.0]}}
        return self._add(name, material, attributes={"POSITION": self.accessor(points, ARRAY, bounds=True)}, mode=mode)

    def _add(self, name, material, **primitive):
        self._materials.append(material)
        self._meshes.append({"name": name, "primitives": [primitive | {"material": len(self._materials) - 1}]})
        return len(self._meshes) - 1

    def packed(self, document):
        text = json.dumps(document | {
            "meshes": self._meshes, "materials": self._materials, "accessors": self._accessors,
            "bufferViews": self._views, "buffers": [{"byteLength": len(self._binary)}],
        }).encode()  # fmt: skip
        text += b" " * (-len(text) % 4)
        chunks = struct.pack("<I4s", len(text), b"JSON") + text
        chunks += struct.pack("<I4s", len(self._binary), b"BIN\0") + self._binary
        return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def _revolved(profile):
    """(points, normals, colours, corners) of a profile (k, 2) rotated about axis 3; each edge has its own two rings."""
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
    """q and -q are the same rotation; without changes of sign from frame to frame the interpolation takes the shorter
    way."""
    flips = np.sign(np.sum(quaternion[1:] * quaternion[:-1], axis=1))
    return quaternion * np.concatenate([[1.0], np.cumprod(np.where(flips < 0, -1.0, 1.0))])[:, None]
