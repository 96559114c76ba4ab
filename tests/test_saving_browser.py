"""Every file that Share saves of the run on each table: saved in Chromium, and read by other programs."""

import io
import json
import os
import subprocess
import sys
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pandas as pd
import pygltflib
import pytest
from lab_page import come, pause
from PIL import Image

pytestmark = pytest.mark.served

TABLES = {"Ordinary": "ordinary", "Rough": "rough", "Ice": "ice"}
ROOT = Path(__file__).parent.parent


def choose(page, table):
    page.get_by_role("radio", name=table, exact=True).click()
    page.locator(f".lab[data-table={TABLES.get(table, 'three')}][data-whole]").wait_for()


def share(page):
    if not page.get_by_role("button", name="CSV", exact=True).count():
        page.get_by_role("button", name="Share", exact=True).click()
    page.get_by_role("button", name="CSV", exact=True).wait_for()


def saved(page, label, name):
    """The bytes of the file of this name, saved by the last button with that label (the first PNG is the photo)."""
    with page.expect_download() as download:
        page.get_by_role("button", name=label, exact=True).locator("visible=true").last.click()
    assert download.value.suggested_filename == name
    return download.value.path().read_bytes()


def read(csv):
    """The columns by their names without their units."""
    return pd.read_csv(io.BytesIO(csv), comment="#").rename(columns=lambda name: name.split(" (")[0])


def each_file_is_that_run(page, tmp_path):
    """On the ordinary table, on which it turns over and loses energy."""
    csv = saved(page, "CSV", "tippe-top-ordinary.csv")
    run = read(csv)
    link = page.locator("input[readonly]").locator("visible=true").input_value()
    assert "# table = ordinary\n" in csv.decode() and f"# {link}\n" in csv.decode()
    tilt, energy = np.degrees(run["theta"]), run["energy"]
    assert not run.isna().any(axis=None) and run["t"].iloc[-1] == pytest.approx(12)
    assert tilt.max() > 170 and energy.iloc[-1] < energy.iloc[0] / 4
    assert np.allclose(energy + run["heat"], energy[0], rtol=1e-3)  # lost energy is heat

    with np.load(io.BytesIO(saved(page, "NumPy", "tippe-top-ordinary.npz"))) as arrays:
        assert np.array_equal(arrays["theta"], run["theta"])
        assert json.loads(str(arrays["header"]))["parameters"]["table"][0] == "ordinary"

    picture = Image.open(io.BytesIO(saved(page, "PNG", "tippe-top-ordinary.png"))).convert("L")
    assert picture.width == pytest.approx(183 / 25.4 * 600, abs=2)  # two columns of a journal, 600 dpi
    assert 0.01 < np.mean(np.array(picture) < 128) < 0.12  # lines on white, no black area

    svg = saved(page, "SVG", "tippe-top-ordinary.svg")
    assert ET.fromstring(svg).tag.endswith("svg")
    drawn = page.context.browser.new_page()
    drawn.set_content(svg.decode())
    seen = np.array(Image.open(io.BytesIO(drawn.locator("svg").screenshot())).convert("L"))
    drawn.close()
    assert 0.01 < np.mean(seen < 128) < 0.12

    gltf = pygltflib.GLTF2.load_from_bytes(saved(page, "GLB", "tippe-top-ordinary.glb"))
    times = gltf.accessors[gltf.animations[0].samplers[0].input]
    assert times.count == len(run) and gltf.asset.extras["parameters"]["table"] == "ordinary"

    (tmp_path / "run.py").write_bytes(saved(page, ".py", "tippe-top-ordinary.py"))
    again = "import run; np = run.np; np.save('tilt.npy', np.c_[run.motion.t, run.motion.theta])"
    done = subprocess.run([sys.executable, "-c", again], cwd=tmp_path, capture_output=True, text=True, check=False,
                          env=os.environ | {"PYTHONPATH": str(ROOT), "MPLBACKEND": "agg"})  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert Image.open(tmp_path / "run.png").width > 400
    t, theta = np.load(tmp_path / "tilt.npy").T
    rows = np.rint((len(t) - 1) * run["t"] / run["t"].iloc[-1]).astype(int)  # only those needed to show it are saved
    assert np.allclose(theta[rows[:200]], run["theta"][:200], atol=1e-6)


def test_the_files_of_each_table_are_its_run_also_when_all_three_are_shown(server, chromium, tmp_path):
    with chromium.new_context(viewport={"width": 1400, "height": 900}, reduced_motion="reduce") as context:
        page = come(context.new_page(), f"{server}?v=2&tab=lab&table=ordinary").page
        pause(page)
        alone = {}
        for label, table in TABLES.items():
            choose(page, label)
            share(page)
            page.get_by_text(f"This motion, {table}").locator("visible=true").wait_for()
            alone[table] = read(saved(page, "CSV", f"tippe-top-{table}.csv"))
            if table == "ordinary":
                each_file_is_that_run(page, tmp_path)
            else:
                run = alone[table]
                assert run["t"].iloc[-1] == pytest.approx(6) and np.degrees(run["theta"]).max() < 6
                assert np.ptp(run["energy"]) < 1e-6 * run["energy"][0]
        choose(page, "All three")
        share(page)
        for table in TABLES.values():
            page.get_by_role("radio", name="ice" if table == "ice" else f"{table} table", exact=True).click()
            page.get_by_text(f"This motion, {table}").locator("visible=true").wait_for()
            run = read(saved(page, "CSV", f"tippe-top-{table}.csv"))
            assert np.allclose(run["theta"][:400], alone[table]["theta"][:400], atol=1e-9)
