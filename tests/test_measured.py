"""The tab Measure without a browser: the examples, what is refused, what is taken home; and the tab in Chromium."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

from app.model.explorer import Explorer
from app.model.measured_examples import EXAMPLES, FOLDER, example
from app.model.measured_table import read
from app.tabs.measure.measure import Measure

ROOT = Path(__file__).parent.parent


@pytest.mark.parametrize("name", EXAMPLES)
def test_an_example_is_what_its_program_makes(name):
    """To its last digit but one: another processor may round another way."""
    there, made = (read(text) for text in ((FOLDER / f"made-{name}.csv").read_bytes(), example(name)))
    for one, other in zip(there.columns, made.columns, strict=True):
        assert one.name == other.name
        assert abs(one.values - other.values).max() < 0.011


@pytest.fixture(scope="module")
def tab():
    """The tab, with the example that slips, fitted."""
    made = Measure(Explorer().scene)
    made.take_example("slips")
    made.compute()
    return made


@pytest.mark.slow
def test_the_example_that_slips_is_told_so_and_recovered(tab):
    assert "This top slipped." in tab.found.object and "cannot have rolled" in tab.found.object
    sliding = tab._found.sliding
    for name, made in {"tilt": 0.2, "spin": 8.0, "mu": 0.35, "radius": 0.02}.items():
        assert abs(sliding.model.values[name] - made) < 3 * sliding.errors[name]


@pytest.mark.slow
def test_what_cannot_be_read_leaves_what_was_there(tab):
    before = tab.pictures.view.objects, tab._data, tab._found
    tab.take("no table\n")
    assert 'role="alert"' in tab.said.object and "ine 1" in tab.said.object
    assert (tab.pictures.view.objects, tab._data, tab._found) == before


@pytest.mark.slow
def test_the_program_taken_home_repeats_the_fit(tab):
    program = tab._program(*tab._home).decode()
    said = subprocess.run([sys.executable, "-c", program], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    again = {name: float(value) for name, value in re.findall(r"  (\w+) = (\S+)", said.split("contensou")[1])}
    sliding = tab._found.sliding
    for name, error in sliding.errors.items():
        assert abs(again[name] - sliding.model.values[name]) < 0.1 * error


@pytest.mark.slow
def test_the_report_is_whole(tab):
    report = tab._report(*tab._home).decode()
    assert report.count("<svg") == 2
    assert "This top slipped." in report
    assert "http" not in report
    assert len(tab._residuals(*tab._home).splitlines()) == 1 + 2 * 216


@pytest.mark.served
def test_an_example_is_fitted_in_the_page(server, chromium):
    page = chromium.new_page(viewport={"width": 390, "height": 800})
    page.set_default_timeout(180_000)
    errors = []
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.add_init_script("localStorage.setItem('tippe:tour', '1')")
    page.goto(f"{server}?tab=measure")
    page.get_by_role("button", name="Example: it rolls").click()
    page.get_by_role("button", name="Fit", exact=True).click()
    page.get_by_text("This top rolled.").wait_for()
    assert page.evaluate("document.documentElement.scrollWidth") == 390
    page.close()
    assert not errors
