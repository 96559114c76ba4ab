"""The saved files of a run on each table describe that run, and the saved Python program computes it again."""

import io
import json
import struct
import xml.etree.ElementTree as ET

import numpy as np
import pandas as pd
import pytest
from PIL import Image

from app.model.measured import read
from app.model.run import motion_on, whole_on
from app.model.setup import start_of
from app.share.saved_runs import NODS, Shown, caption, drawn, run_csv, run_glb, run_npz, run_print, run_python
from tippe_core import glide, grip, roll

TOY = "The paper's tippe top"
START = TOY, 12.0, 25.0, 0.3
TABLES = "ordinary", "rough", "ice"


@pytest.fixture(scope="module", params=TABLES)
def shown(request):
    return Shown(request.param, motion_on(request.param, start_of(*START)).trajectory, start_of(*START))


def test_the_table_has_it_in_SI(shown):
    moved, scales = shown.trajectory, shown.setup.scales
    text = run_csv(shown, "https://example.org/?v=1")
    table = pd.read_csv(io.BytesIO(text), comment="#")
    codes = {0: "roll", 3: "slip", 4: "air"}
    assert np.array_equal(table["theta (rad)"], moved.theta)
    assert [codes[code] for code in table["regime (1)"]] == list(moved.regime)
    assert np.array_equal(table["t (s)"], moved.t * scales.time) and set(table["support (1)"]) == {0}
    weight = scales.M * scales.g
    assert np.allclose(table["force_z (N)"], weight * moved.force[:, 2], rtol=1e-12)
    assert np.allclose(table["com_z (m)"], 0.016 * moved.com[:, 2], rtol=1e-12)
    energy = table["energy (J)"]
    assert np.allclose(energy + table["heat (J)"], energy[0], rtol=1e-3)  # lost energy is heat
    below = text.decode().splitlines()[len(table) + 1 :]
    assert f"# table = {shown.table}" in below and "# https://example.org/?v=1" in below
    assert "# regime: 0 roll, 3 slip, 4 air" in below and "# support: 0 ball, 1 stem, 2 both, 3 none" in below


def test_tracker_takes_the_table_and_its_track_as_they_are(shown):
    """By the rules of its source (DataTool.parseData, ParticleDataTrack): lines that begin with # are passed over; the
    first line of words has the names; a row with any word is no data; the time is t or time before a bracket; of a pair
    of names that begin or end with x and y, the rest is the same."""
    rows = [line.split(",") for line in run_csv(shown).decode().splitlines() if not line.startswith("#")]
    names, numbers = rows[0], np.array([[float(cell) for cell in row] for row in rows[1:]])
    assert numbers.shape == (len(shown.trajectory.t), len(names))
    assert [name.split("(")[0].strip() for name in names].count("t") == 1
    tracks = {axis: [name.strip(axis).strip() for name in names if name.startswith(axis) or name.endswith(axis)]
              for axis in "xy"}  # fmt: skip
    assert tracks == {"x": ["(m)"], "y": ["(m)"]}
    track = numbers[:, [names.index("x (m)"), names.index("y (m)")]]
    assert np.allclose(track, shown.setup.scales.R * shown.trajectory.contact, rtol=1e-12)


def test_the_tab_measure_reads_the_table(shown):
    found = {column.quantity: column for column in read("run.csv", run_csv(shown)).columns if column.quantity}
    assert not any(column.guessed for column in found.values())
    every = round(len(shown.trajectory.t) / len(found["tilt"].values))
    assert np.allclose(found["tilt"].si[-1], shown.trajectory.theta[-1:], atol=0.1) and every >= 1
    assert {"time", "tilt", "azimuth", "spin", "x", "y"} <= {*found}


def test_the_arrays_are_the_tables(shown):
    table = pd.read_csv(io.BytesIO(run_csv(shown)), comment="#")
    with np.load(io.BytesIO(run_npz(shown))) as arrays:
        assert np.array_equal(arrays["slip"][:, 1], table["slip_y (m/s)"])
        assert json.loads(str(arrays["header"]))["parameters"]["M"] == [0.0115, "kg"]


def test_the_python_computes_it_again(shown, monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "agg")
    code = run_python(shown)
    found: dict = {}
    exec(code, found)
    moved, motion = shown.trajectory, found["motion"]
    rows = np.searchsorted(motion.t, moved.t)  # only those needed to show it are kept
    assert np.array_equal(motion.t[rows], moved.t) and np.allclose(motion.theta[rows], moved.theta, atol=1e-9)
    assert (tmp_path / "run.png").stat().st_size > 1000


def test_the_python_of_a_whole_life_goes_to_its_end(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "agg")
    life, found = whole_on("ordinary", start_of("Leine and Glocker's toy", 22.0, 5.73, 0.3)), {}
    exec(run_python(Shown("ordinary", life.trajectory, life.start)), found)
    motion, moved = found["motion"], life.trajectory
    assert motion.t[-1] == pytest.approx(moved.t[-1], abs=1e-6)
    assert np.degrees(abs(motion.theta[-1] - moved.theta[-1])) < 0.1


def test_the_animation_stands_on_its_ball_where_the_ball_is(shown):
    """O is R above the table while the ball touches it."""
    document = run_glb(shown, 4.0)
    length = struct.unpack("<I", document[12:16])[0]
    said = json.loads(document[20 : 20 + length])
    assert said["asset"]["extras"]["parameters"]["table"] == shown.table
    slower = said["asset"]["extras"]["slower than the real top by"]
    words = {"ordinary": "on an ordinary table", "rough": "rolling", "ice": "on ice"}[shown.table]
    assert said["animations"][0]["name"] == f"{words}, {slower:.3g} times slower"
    [times] = {sampler["input"] for sampler in said["animations"][0]["samplers"]}
    assert said["accessors"][times]["count"] == len(shown.trajectory.t)
    longest = said["accessors"][times]["max"][0]
    assert longest == pytest.approx(slower * shown.trajectory.t[-1] * shown.setup.scales.time) and longest < 60.1
    channel = next(each for each in said["animations"][0]["channels"] if each["target"]["path"] == "translation")
    place = said["accessors"][said["animations"][0]["samplers"][channel["sampler"]]["output"]]
    view = said["bufferViews"][place["bufferView"]]
    start = 28 + length + view.get("byteOffset", 0)
    centre = np.frombuffer(document, "<f4", 3 * place["count"], start).reshape(-1, 3)
    ball = shown.trajectory.regime != "air"
    ball &= shown.trajectory.t < next((t for t, on in shown.trajectory.supports if on != "ball"), np.inf)
    assert np.allclose(centre[ball, 2], 0.016, atol=1e-8) and ball.sum() > 50


@pytest.mark.slow
def test_the_picture_is_one(shown):
    """Two columns of a journal wide, at 600 dpi: lines on white, no black area."""
    picture = Image.open(io.BytesIO(run_print(shown, "png"))).convert("L")
    assert picture.width == pytest.approx(183 / 25.4 * 600, abs=2)
    assert 0.01 < np.mean(np.array(picture) < 128) < 0.12
    assert len([*ET.fromstring(run_print(shown, "svg")).iter("{http://www.w3.org/2000/svg}path")]) > 50


def test_the_picture_shows_single_nods_where_all_would_be_one_black_area(shown):
    seconds, rows, words = drawn(shown)
    tilt, force, _ = rows.values()
    setup = shown.setup
    whole = shown.trajectory.t * setup.scales.time
    if shown.table == "ordinary":
        assert np.array_equal(seconds, whole) and "the first" not in words[1]
        return
    turns = np.flatnonzero(np.diff(np.sign(np.diff(tilt))))
    assert len(turns) in (2 * NODS - 1, 2 * NODS) and f"the first {seconds[-1]:.2g} s of {whole[-1]:.3g} s" in words[1]
    t = seconds / setup.scales.time
    motion = roll(setup.top, None, t, grip(setup.top, setup.state)[0]) if shown.table == "rough" else glide(
        setup.top, setup.state, t)  # fmt: skip
    assert np.allclose(tilt, np.degrees(motion.theta), atol=0.01 * np.ptp(tilt))  # the width of the line
    assert np.allclose(force, motion.force[:, 2], atol=0.01 * np.ptp(force))


def test_what_stands_below_the_picture_is_said_in_words(shown):
    said = " ".join(caption(shown))
    rubs = {"ordinary": r"$\mu$ = 0.3, patch of 0.5 mm", "rough": "it rolls", "ice": "no friction"}
    assert rubs[shown.table] in said and "12 turns a second" in said and "25°" in said and "(mu=" not in said
