"""Saved files, without a browser: read by other programs' readers, and compared with tippe_core's own numbers."""

import base64
import io
import json
import re
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pandas as pd
import pygltflib
import pytest
from bokeh.settings import settings
from PIL import Image

from app.model.explorer import Explorer
from app.page.site import mailed
from app.share import export, glb, prints, programs
from app.share.letter import figures
from tippe_core import PRESETS, Constants, Top, TruncatedSphere, lift_off_and_slip_tielines, roll

LINK = "http://localhost/app?v=1&KJ=6.5"


def scene_of(**inputs):
    return Explorer(**inputs).scene


@pytest.fixture(scope="module")
def scene():
    return scene_of(K_J=6.5, mu_s=0.4)


@pytest.fixture(scope="module")
def motion(scene):
    """The same motion, computed by tippe_core."""
    return roll(Top.paper(), Constants(6.5, 10.0, scene.constants.E), scene.trajectory.t)


def test_csv_is_the_motion_to_the_last_digit(scene, motion):
    file = export.motion_csv(scene, LINK)
    table = pd.read_csv(io.BytesIO(file), comment="#")
    assert np.array_equal(table["theta (rad)"], motion.theta)
    assert np.array_equal(table[[f"quaternion_{axis} (1)" for axis in "xyzw"]], motion.quaternion)
    assert np.array_equal(table[["x (R)", "y (R)"]], motion.contact)
    assert np.array_equal(table[[f"omega_{i} ((g/R)^1/2)" for i in "123"]], motion.omega)
    assert np.array_equal(table[[f"force_{axis} (Mg)" for axis in "xyz"]], motion.force)
    said = [line[2:] for line in file.decode().splitlines() if line.startswith("# ")]
    for line in ("K_J = 6.5 (g/R)^1/2", "mu_s = 0.4", "I1 = 0.399 MR^2", "M = 0.0115 kg", "g = 9.81 m/s^2", LINK,
                 "t: time, in (R/g)^1/2 = 0.0403855 s"):  # fmt: skip
        assert line in said
    for column in table.columns:
        name = re.sub("_[xyzw123]$", "", column.split(" (")[0])
        assert any(line.startswith({"x": "contact", "y": "contact"}.get(name, name) + ":") for line in said)


def test_csv_of_the_tielines_is_fig_6(scene):
    table = pd.read_csv(io.BytesIO(export.tielines_csv(scene)), comment="#")
    lift, slip = lift_off_and_slip_tielines(Top.paper(), table["tieline_K_J"].to_numpy(), 10.0, 0.4)
    assert np.array_equal(table["lift_theta_outer"], lift.theta_outer)
    assert np.array_equal(table["slip_theta_verge"], slip.theta_verge)
    assert np.array_equal(table["slip_E"], slip.E)


def test_npz_has_both_and_says_what_they_are(scene, motion):
    with np.load(io.BytesIO(export.arrays_npz(scene, LINK)), allow_pickle=False) as file:
        said = json.loads(str(file["header"]))
        assert np.array_equal(file["phi"], motion.phi) and np.array_equal(file["com"], motion.com)
        assert np.array_equal(file["tieline_K_J"], scene.plane.K_J)
        assert set(said["units"]) == set(file.files) - {"header"}
    assert said["parameters"]["E"] == {"value": scene.constants.E, "unit": "MgR"} and said["link"] == LINK


MOTIONS = {
    "paper": {"K_J": 6.5},
    "all of it, at slipping": {"K_J": -3.0, "upper": False, "limit": "slip", "mu_s": 0.3},
    "from a state": {"theta": 0.5, "theta_dot": 0.4, "omega2": -1.5, "omega3": 8.0, "phi": 0.3, "given": "state"},
    "nothing limits it": {"a": 0.0, "I1": 0.4, "I3": 0.4, "K_J": 3.0},
    "an ordinary top": {"a": -1.891, "I1": 1.105, "I3": 0.196, "K_R": 14.85, "K_J": 3.9525, "upper": False},
}


@pytest.mark.slow
@pytest.mark.parametrize("inputs", MOTIONS.values(), ids=MOTIONS)
def test_the_python_gives_the_same_numbers(inputs, tmp_path, monkeypatch):
    monkeypatch.setenv("MPLBACKEND", "agg")
    monkeypatch.chdir(tmp_path)
    scene = scene_of(**inputs)
    plane, trajectory = scene.plane, scene.trajectory

    def run(name):
        code = programs.PYTHON[name](scene)
        assert len([line for line in code.splitlines() if line]) <= 10
        names = {}
        exec(compile(code, name, "exec"), names)
        names["plt"].close("all")
        return names

    names = run("Fig. 6")
    for ours, theirs in ((names["lift"], plane.lift), (names["slip"], plane.slip)):
        for column in ("K_J", "E", "theta_inner", "theta_outer", "theta_verge"):
            assert np.array_equal(getattr(ours, column), getattr(theirs, column), equal_nan=True)
    names = run("The motion")
    for column in ("t", "theta", "phi", "psi", "quaternion", "contact", "com", "omega", "force"):
        assert np.array_equal(getattr(names["motion"], column), getattr(trajectory, column))
    assert np.array_equal(names["ratio"], scene.ratio)
    one = scene.nutation
    F_z = np.where(one.force[:, 2] > 1e-3, one.force[:, 2], np.nan)
    for name, x, y in (("phase", one.theta, one.omega[:, 0]), ("f", one.theta, one.omega[:, 0] ** 2),
                       ("track", *trajectory.contact.T), ("force", *(one.force[:, :2].T / F_z))):  # fmt: skip
        names, there = run(name), np.isfinite(x)
        assert np.array_equal(names["x"][there], x[there]) and np.array_equal(names["y"][there], y[there])
    names = run("potential")
    theta, E = scene.potential
    assert np.array_equal(names["x"], theta)
    assert names["y"] == pytest.approx(E, rel=1e-11)
    limited = np.isfinite(plane.surface.E)
    if limited.any():
        names = run("Fig. 5")
        assert np.array_equal(names["theta"][limited], plane.theta[limited])
        assert np.array_equal(names["height"][limited], plane.height[limited])


def array(gltf, index):
    accessor = gltf.accessors[index]
    view = gltf.bufferViews[accessor.bufferView]
    kind = {5126: "<f4", 5125: "<u4"}[accessor.componentType]
    columns = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[accessor.type]
    values = np.frombuffer(gltf.binary_blob(), kind, accessor.count * columns, view.byteOffset)
    return values.reshape(accessor.count, columns).astype(float)


@pytest.mark.parametrize("preset", PRESETS, ids=lambda preset: preset.name)
def test_gltf_is_the_body_and_its_motion(preset):
    top = preset.shape.top
    scene = scene_of(shape=preset.shape, a=top.a, I1=top.I1, I3=top.I3, K_J=0.4, K_R=12.0, energy=0.3)
    gltf = pygltflib.GLTF2.load_from_bytes(glb.animation_glb(scene, slower=16))
    trajectory, R = scene.trajectory, preset.shape.R
    animation = gltf.animations[0]
    seconds = array(gltf, animation.samplers[0].input)[:, 0]
    assert seconds == pytest.approx(16 * trajectory.t * scene.scales.time, rel=1e-6, abs=1e-6)
    found = {channel.target.path: array(gltf, animation.samplers[channel.sampler].output)
             for channel in animation.channels}  # fmt: skip
    # G is a below O along axis 3: the nodes' own translation and rotation put it where tippe_core has it
    x, y, z, w = found["rotation"].T
    axis = np.column_stack([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)])
    tolerance = 1e-6 * R * np.abs(trajectory.com).max()  # of a float32
    assert found["translation"] - top.a * R * axis == pytest.approx(R * trajectory.com, abs=tolerance)
    assert np.abs(np.sum(found["rotation"] * trajectory.quaternion, axis=1)) == pytest.approx(1, abs=1e-6)
    assert np.all(np.sum(found["rotation"][1:] * found["rotation"][:-1], axis=1) > 0)
    primitive = gltf.meshes[gltf.nodes[animation.channels[0].target.node].mesh].primitives[0]
    points = array(gltf, primitive.attributes.POSITION)
    corners = points[array(gltf, primitive.indices).astype(int).reshape(-1, 3)]
    volume = np.sum(np.cross(corners[:, 0], corners[:, 1]) * corners[:, 2]) / 6
    # outwards, and as large as the body seen from outside; a ring of 48 corners has 0.3 % less area than its circle
    seen = {"Top S": 4 / 3 * np.pi * R**3, "Hollow tippe top": TruncatedSphere.paper().volume}
    assert volume == pytest.approx(seen.get(preset.name, preset.shape.volume), rel=0.01)
    assert gltf.asset.extras["slower than the real top by"] == 16


THREE = Path(__file__).parent.parent / "app/frontend/node_modules/three"
READER = """<script type="importmap">{"imports": {"three": "./build/three.module.js"}}</script><script type="module">
import * as THREE from "three"
import { GLTFLoader } from "./examples/jsm/loaders/GLTFLoader.js"
window.read = async (file, seconds, points) => {
  const bytes = Uint8Array.from(atob(file), (letter) => letter.charCodeAt(0))
  const { scene, animations } = await new GLTFLoader().parseAsync(bytes.buffer, "")
  const mixer = new THREE.AnimationMixer(scene), top = scene.getObjectByName("top")
  mixer.clipAction(animations[0]).play()
  return seconds.map((time) => {
    mixer.setTime(time)
    scene.updateMatrixWorld(true)
    return points.map((point) => new THREE.Vector3(...point).applyMatrix4(top.matrixWorld).toArray())
  })
}
</script>"""


@pytest.mark.served
@pytest.mark.skipif(not THREE.is_dir(), reason="three.js is here where the bundle was built")
def test_three_js_reads_the_gltf_and_moves_the_body_as_computed(scene, chromium):
    page = chromium.new_page()
    asked = []

    def answer(route):
        name = route.request.url.removeprefix("http://three.test/")
        asked.append(name)
        if name:
            route.fulfill(path=THREE / name, content_type="text/javascript")
        else:
            route.fulfill(body=READER, content_type="text/html")

    page.route("**", answer)
    page.goto("http://three.test/")
    page.wait_for_function("typeof read == 'function'")
    motion, scales, top = scene.trajectory, scene.scales, scene.top
    at = [0, 7, len(motion.t) // 2, len(motion.t) - 2]
    # G, and G moved by R along axes 3 and 1 of the body
    points = scales.R * np.array([[0, 0, -top.a], [0, 0, 1 - top.a], [1, 0, -top.a]])
    seconds = 16 * scales.time * motion.t[at]
    file = base64.b64encode(glb.animation_glb(scene, slower=16)).decode()
    found = page.evaluate("(all) => read(...all)", [file, seconds.tolist(), points.tolist()])
    page.close()
    x, y, z, w = motion.quaternion[at].T
    third = np.column_stack([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)])
    first = np.column_stack([1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)])
    com = motion.com[at]
    expected = scales.R * np.stack([com, com + third, com + first], axis=1)
    found = np.array(found)[..., [0, 2, 1]] * [1, -1, 1]  # there y is up
    assert found == pytest.approx(expected, abs=1e-4 * scales.R)
    assert "examples/jsm/loaders/GLTFLoader.js" in asked


@pytest.mark.slow
@pytest.mark.parametrize("name", ["plane", "surface", "motion"])  # and all are drawn below
def test_a_figure_for_print(scene, name):
    svg = prints.draw(scene, name, "svg")
    root = ET.fromstring(svg)
    assert root.tag.endswith("svg") and root.get("width") == f"{183 / 25.4 * 72:.6f}".rstrip("0") + "pt"
    # text is drawn as paths, each after a comment with that text
    said = svg.decode()
    for parameter in (r"$K_J$ = 6.5", r"$\mu_s$ = 0.4", "$I_1$ = 0.399", "$a$ = 0.07", "$E$ = "):
        assert parameter in said


@pytest.mark.slow
def test_a_figure_is_printed_the_same_again_and_as_finely_as_a_journal_asks(scene):
    assert prints.draw(scene, "force", "svg") == prints.draw(scene, "force", "svg")
    picture = Image.open(io.BytesIO(prints.draw(scene, "force", "png")))
    assert picture.info["dpi"] == pytest.approx((600, 600), abs=1)
    assert picture.width == pytest.approx(183 / 25.4 * 600, abs=2)


def test_the_printed_curves_are_the_scenes(scene, motion):
    lines = {line.get_label(): line for line in prints.DRAWN["plane"](scene).axes[0].lines}
    assert np.array_equal(lines["verge of slipping"].get_xdata(), scene.plane.slip.theta_verge)
    assert np.array_equal(lines["this motion"].get_xdata(), scene.turning)
    theta, force = (axes.lines[0].get_ydata() for axes in prints.DRAWN["motion"](scene).axes[:2])
    assert np.array_equal(theta, motion.theta) and np.array_equal(force, motion.force[:, 2])


@pytest.mark.slow
@pytest.mark.parametrize("which", ["nothing limits it", "an ordinary top"])
def test_odd_motions_can_be_printed(which):
    scene = scene_of(**MOTIONS[which])
    for name in prints.FIGURES:
        prints.DRAWN[name](scene).draw_without_rendering()


@pytest.mark.slow
def test_the_letter_asks_for_nothing(scene):
    below, values = figures(scene)
    page = mailed(LINK + '&x="><script>alert(1)</script>', {}, below, letter=values).decode()
    bokeh = settings.bokehjs_path() / "js" / "bokeh.min.js"
    assert len(page) - bokeh.stat().st_size < 1_930_000  # with the runs on three tables
    outside = re.sub(r"<script.*?</script>", "", page, flags=re.DOTALL)
    assert "alert(1)" not in outside.replace("&lt;script&gt;alert(1)&lt;/script&gt;", "")
    assert not re.findall(r"""(?:src|href)=["'](?!http://localhost/app\?)""", outside)
    assert "three.js authors" in page and "Anaconda" in page
