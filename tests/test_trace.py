"""The path of the contact on the ball, as carbon paper would mark it, against a rigid body that knows no angles."""

import io

import numpy as np
import pandas as pd
import pygltflib
import pytest
import sliding_body as sb
from matplotlib.figure import Figure
from scipy.spatial.transform import Rotation
from test_export import array

from app.model.lab.traced import turns_back
from app.model.run import motion_on, whole_on
from app.model.setup import start_of
from app.share import prints
from app.share.export import motion_csv
from app.share.saved_runs import Shown, run_csv, run_glb
from app.tabs.lab.words import trace_words
from tippe_core import State, Top, Viscous, slide

TALL, FLAT = Top(0.2, 0.44, 0.36), Top(0.2, 0.35, 0.40)
LAW, TILT, TURNS = Viscous(0.6), 0.7, 10.0  # it goes round at that rate, without nodding


@pytest.fixture(scope="module", params=[TALL, FLAT], ids=["I1 > I3", "I1 < I3"])
def turned(request):
    """(a Trajectory that turns over, the same motion of the rigid body)."""
    top, times = request.param, np.linspace(0, 8, 500)
    spin = top.I1 * TURNS * np.cos(TILT) / top.I3
    state = State(TILT, 0, TURNS * np.sin(TILT), spin, vx=0.0, vy=0.0)
    alone = sb.integrate(top, lambda u: LAW.gamma * u, *sb.first_instant(top, state), times, rtol=1e-9)
    return slide(top, state, LAW, times), alone


def test_it_is_the_lowest_point_of_the_ball_seen_from_the_body(turned):
    moved, alone = turned
    below = [sb.matrix(q).T @ -sb.UP for q in alone.quaternion]
    np.testing.assert_allclose(moved.trace, below, rtol=0, atol=2e-5)


def test_it_turns_back_near_the_equator_one_way_or_the_other(turned):
    """cos theta' = a/(Omega^2 (I1 - I3)), Pliskin 1954, (6), for a steady precession Omega."""
    moved, alone = turned
    below = np.array([sb.matrix(q).T @ -sb.UP for q in alone.quaternion])
    around, tilt = np.unwrap(np.arctan2(below[:, 1], below[:, 0])), np.arccos(-below[:, 2])
    near = (tilt > np.pi / 4) & (tilt < 3 * np.pi / 4)
    around, tilt, rate = around[near], tilt[near], alone.omega[near, 2]
    is_tall = moved.top.I1 > moved.top.I3
    at = int(np.argmin(around) if is_tall else np.argmax(around))  # the spin was positive
    assert abs(around[[0, -1]] - around[at]).min() > 0.25
    back = turns_back(moved)
    assert back.runs_with is not is_tall and back.theta == pytest.approx(tilt[at], abs=0.02)
    steady = np.arccos(moved.top.a / (rate[at] ** 2 * (moved.top.I1 - moved.top.I3)))
    assert back.theta == pytest.approx(steady, abs=0.1)


@pytest.mark.parametrize("toy, spin, says", [("Leine and Glocker's toy", 28.65, "against"), ("Top S", 60.0, "with")])
def test_the_page_says_which_way(toy, spin, says):
    motion = whole_on("ordinary", start_of(toy, spin, 5.73, 0.3))
    words = trace_words(motion.trajectory)
    assert f"runs round {says} the spin" in words
    assert f"{np.degrees(turns_back(motion.trajectory).theta):.0f}°" in words


def test_nothing_is_said_of_a_top_that_stays_low():
    assert trace_words(motion_on("ice", start_of("Leine and Glocker's toy", 28.65, 5.73, 0.3)).trajectory) == ""


def test_the_marks_are_on_the_ball_or_on_the_rim_of_the_stem():
    motion = whole_on("ordinary", start_of("Leine and Glocker's toy", 28.65, 5.73, 0.3))
    trace, (radius, height, rounding) = motion.trajectory.trace, motion.start.edge
    ball, stem = (motion.carried == on for on in ("ball", "stem"))
    np.testing.assert_allclose(np.linalg.norm(trace[ball], axis=1), 1, atol=1e-6)
    from_rim = np.hypot(np.hypot(*trace[stem, :2].T) - radius, trace[stem, 2] - height)  # which is round like a ring
    assert stem.sum() > 100
    np.testing.assert_allclose(from_rim, rounding, atol=1e-6)


def test_the_saved_tables_have_it(explorer_scene):
    start = start_of("The paper's tippe top", 12.0, 25.0, 0.3)
    run = Shown("rough", motion_on("rough", start).trajectory, start)
    for text, size in ((run_csv(run), start.scales.R), (motion_csv(explorer_scene), 1.0)):
        table = pd.read_csv(io.BytesIO(text), comment="#")
        columns = [name for name in table if name.startswith("trace_")]
        assert [name.split(" ")[0] for name in columns] == ["trace_x", "trace_y", "trace_z"]
        marks, tilt = table[columns].to_numpy(), table["theta (rad)"].to_numpy()
        np.testing.assert_allclose(marks[:, 2], -size * np.cos(tilt), atol=1e-9)
        np.testing.assert_allclose(np.linalg.norm(marks, axis=1), size, rtol=1e-9)
        path = np.stack([table[f"{axis} ({'m' if size != 1 else 'R'})"] for axis in "xy"], axis=1)
        lengths = [np.linalg.norm(np.diff(each, axis=0), axis=1).sum() for each in (marks, path)]
        assert lengths[0] == pytest.approx(lengths[1], rel=0.02)  # it rolls: as far on the ball as on the table


def test_on_the_saved_animation_each_mark_is_above_the_table_where_it_touches():
    start = start_of("The paper's tippe top", 12.0, 25.0, 0.3)
    moved, R = motion_on("rough", start).trajectory, start.scales.R
    gltf = pygltflib.GLTF2.load_from_bytes(run_glb(Shown("rough", moved, start), 4.0))
    [node] = [node for node in gltf.nodes if node.name == "trace on the ball"]
    assert gltf.nodes.index(node) in next(node for node in gltf.nodes if node.name == "top").children
    primitive = gltf.meshes[node.mesh].primitives[0]
    ends = array(gltf, primitive.attributes.POSITION)
    parts = len(ends) // (len(moved) - 1)
    assert primitive.mode == 1 and parts * (len(moved) - 1) == len(ends)
    translation, rotation = (array(gltf, sampler.output) for sampler in gltf.animations[0].samplers)
    marks = Rotation.from_quat(rotation[:-1]).apply(ends[::parts]) + translation[:-1]
    np.testing.assert_allclose(marks[:, :2], R * moved.contact[:-1], atol=1e-5 * R)
    assert np.all(marks[:, 2] < 0) and np.all(marks[:, 2] > -0.01 * R)  # a little above the ball


@pytest.mark.parametrize("tilt", [30, 60, 120, 150])
def test_on_the_printed_caps_a_mark_is_on_the_ring_of_its_tilt(tilt):
    angle, both, upper = np.radians([tilt - 0.5, tilt + 0.5]), Figure().subplots(2), tilt > 90
    prints._caps(both, np.stack([np.sin(angle), 0 * angle, -np.cos(angle)], axis=1))
    [drawn] = both[int(upper)].collections[0].get_segments()
    [ring] = [text.get_position()[1] for text in both[int(upper)].texts if text.get_text() == f"{tilt}°"]
    assert drawn.mean(axis=0) == pytest.approx([abs(ring) if upper else -abs(ring), 0.0])  # seen from outside


@pytest.fixture
def explorer_scene():
    from app.model.explorer import Explorer

    return Explorer().scene
