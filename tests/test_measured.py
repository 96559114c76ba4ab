"""The tab Measure: the examples, what is refused, and what can be saved, without a browser; then the tab in
Chromium."""

import re
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from axe import LARGE, check
from playwright.sync_api import expect

from app.model.explorer import Explorer
from app.model.measured import fit, shown
from app.model.measured.data import settled
from app.model.measured.examples import EXAMPLES, FOLDER, example
from app.model.measured.kept import kept
from app.model.measured.made import LAW, found_of_example, made_anew
from app.model.measured.table import read
from app.model.measured.work import LONGEST
from app.tabs.measure.home import report_file, residuals_file
from app.tabs.measure.measure import Measure
from app.tabs.measure.recipe import recipe
from app.tabs.measure.words import numbers_table
from app.text import LANGUAGES, speaking


@pytest.mark.parametrize("name", EXAMPLES)
def test_an_example_is_what_its_program_makes(name):
    """All digits but the last: another processor may round differently."""
    there, made = (read(text) for text in ((FOLDER / f"made-{name}.csv").read_bytes(), example(name)))
    for one, other in zip(there.columns, made.columns, strict=True):
        assert one.name == other.name
        assert abs(one.values - other.values).max() < 0.011


@pytest.mark.long
@pytest.mark.slow
@pytest.mark.parametrize("name", EXAMPLES)
def test_a_stored_fit_of_an_example_is_what_its_program_finds(name, monkeypatch):
    """From where it was found; that a search from elsewhere comes there is tested in test_measured_fit.py."""
    stored = found_of_example(name, LAW, ())
    ends = {each.model.name: np.array([each.model.values[free] for free in each.model.free]) for each in stored.fits}
    monkeypatch.setattr(fit, "GROWING", (1.0,))
    monkeypatch.setattr(fit, "starts", lambda model, data: [ends[model.name]] * fit.AGREEING)
    monkeypatch.setattr(fit, "scattered", lambda model, data: [])
    anew = made_anew(name)
    for one, other in zip(stored.fits, anew.fits, strict=True):
        assert {*one.unknown} >= {*other.unknown} and one.sure == other.sure  # other minima leave more unknown
        assert one.chi2 == pytest.approx(other.chi2, rel=1e-3)
        for number, error in other.errors.items():
            assert abs(one.model.values[number] - other.model.values[number]) < 0.1 * error
            assert one.errors[number] == pytest.approx(error, rel=0.02)
        if not one.refused:
            np.testing.assert_allclose(one.correlation, other.correlation, atol=0.01)


@pytest.fixture(scope="module")
def tab():
    """The tab with the fitted example that slips."""
    made = Measure(Explorer().scene)
    made.take_example("slips")
    made.compute()
    return made


def test_an_example_shows_both_constants_of_a_top_that_rolls():
    data, (top, scales, *_) = settled(read(example("rolls"))), Measure(Explorer().scene)._body
    found = kept(data, top, scales)
    assert {name: each.stayed for name, each in found.items()} == {"K_R": True, "K_J": True}


def test_an_error_that_nobody_stated_is_shown():
    """In grey, in the unit of its column: of values that scatter by 0.5 degrees."""
    made, rng = Measure(Explorer().scene), np.random.default_rng(3)
    rows = (f"{i / 100:.2f};{20 + 0.5 * rng.normal():.3f};{5 + i / 100:.2f}" for i in range(400))
    made.take("\n".join(["t (s);tilt (deg);spin (rev/s) ± 0.2", *rows]))
    _, tilt, spin = (entry for entry in made.columns._errors)
    assert tilt.value == "" and float(tilt.placeholder) == pytest.approx(0.5, rel=0.15)
    assert spin.value == "0.2"


FRAMES = "\n".join(["frame\ttilt (deg)", *(f"{i}\t{5 + i}" for i in range(30))])


def test_a_table_that_needs_a_word_more_has_no_data_before():
    made = Measure(Explorer().scene)
    made.take_example("rolls")
    made.take(FRAMES)
    assert "frames" in made.wording.object and made._data is None and made._example == ""
    made.columns.rate.value = "240"
    assert made._data.t[-1] == pytest.approx(29 / 240)
    made.take(FRAMES)  # of another camera
    assert made.columns.rate.value == "" and made._data is None


def long_table(step):
    """A table of 600 rows, this many s apart."""
    rows = (f"{i * step:.4f},{5 + i % 7},{20 + i % 5}" for i in range(600))
    return "\n".join(["t (s),tilt (deg),spin (rev/s)", *rows])


def test_of_a_film_of_hours_a_part_is_fitted(monkeypatch):
    """A film of the greatest length. If it is longer, or contains too few measured values, a message says so and
    nothing runs."""
    made = Measure(Explorer().scene)
    monkeypatch.setattr(shown, "shown", lambda model, data: pytest.fail("run") if np.ptp(data.t) > LONGEST else None)
    made.take(long_table(1.0))
    assert made.part.value == [0, LONGEST] and "599 s" in made.wording.object and not made.start.disabled
    made._pulled(300.0)
    assert made.part.value == [300.0, 300.0] and "8 measured values, and at most 60 s" in made.wording.object
    made.take(long_table(30.0))
    assert "ms as the unit" in made.wording.object and made.start.disabled and made.part.end == pytest.approx(17_970)


def test_a_guess_is_chosen_by_the_beginning_of_a_film(monkeypatch):
    """A film for which each of the many starts would take seconds."""
    runs, of_problem = [], shown.Problem.residuals

    def counted(own, x):
        runs.append(np.ptp(own.data.t))
        return of_problem(own, x)

    monkeypatch.setattr(shown.Problem, "residuals", counted)
    Measure(Explorer().scene).take(long_table(0.05))
    assert len(runs) > 10 and max(runs) <= shown.LOOK


@pytest.mark.parametrize(("each", "line"), [(1, 24), (5, 71), (40, 441)])
def test_a_line_is_that_of_the_file(each, line):
    """A table thinned by the browser: 12 lines are kept, and of the others every n-th, counted from 0."""
    file = ["t,tilt", *(f"{i / 100:.2f},5" for i in range(1, 12 + 30 * each))]
    file[line - 1] = f"{(line - 1) / 100:.2f},five"
    kept = [row for i, row in enumerate(file) if i < 12 or i % each == 0]
    made = Measure(Explorer().scene)
    made.take("\n".join(kept), each)
    assert f"Line {line}, column tilt" in made.wording.object


@pytest.mark.slow
def test_the_example_that_slips_is_told_so_and_recovered(tab):
    assert "This top slipped." in tab.found.object and "did not roll without losses" in tab.found.object
    assert "rolling is ruled out" in tab.found.object
    sliding = tab._found.sliding
    for name, made in {"tilt": 0.2, "spin": 8.0, "mu": 0.35, "radius": 0.02}.items():
        assert abs(sliding.model.values[name] - made) < 3 * sliding.errors[name]
    at = sliding.model.free.index
    assert sliding.together
    for one, other, r in sliding.together:
        assert r == pytest.approx(sliding.correlation[at(one), at(other)])


@pytest.mark.slow
def test_what_cannot_be_read_leaves_what_was_there(tab):
    before = tab.pictures.view.objects, tab._data, tab._found
    tab.take("no table\n")
    assert 'role="alert"' in tab.wording.object and "ine 1" in tab.wording.object
    assert (tab.pictures.view.objects, tab._data, tab._found) == before
    assert "Still shown: Example: it slips" in tab.wording.object


@pytest.mark.slow
def test_the_report_is_whole(tab):
    report = report_file(*tab.home.fit).decode()
    assert report.count("<svg") == 3
    assert "This top slipped." in report and "432 measured values" in report
    assert "not filmed, made by this program with noise" in report
    assert "http" not in report
    for each in re.findall(r"<svg.*?</svg>", report, re.DOTALL):
        ElementTree.fromstring(each)
    assert len(residuals_file(*tab.home.fit).splitlines()) == 1 + 2 * 216


@pytest.mark.slow
def test_its_numbers_are_written_as_the_language_writes_them(tab):
    with speaking("de"):
        said, report = numbers_table(tab._found.better), report_file(*tab.home.fit).decode()
    assert re.search(r"<td class=n>0,3\d+</td>", said) and not re.search(r"\d\.\d", said)
    assert ">0,5<" in report and ">0.5<" not in report


@pytest.mark.served
def test_the_recipe_is_one_page(chromium):
    """As printed by a browser on A4, in each language."""
    for language in LANGUAGES:
        with speaking(language):
            text = recipe()
        page = chromium.new_page()
        page.set_content(text)
        printed = page.pdf(prefer_css_page_size=True)
        page.close()
        assert len(re.findall(rb"/Type\s*/Page[^s]", printed)) == 1


DROP = """text => { const brought = new DataTransfer();
  brought.items.add(new File([text], "mine.txt", { type: "text/plain" }));
  for (const type of ["dragover", "drop"])
    window.dispatchEvent(new DragEvent(type, { dataTransfer: brought, bubbles: true, cancelable: true })); }"""


def brought(page, label):
    """The text of the file that a click on these words saves."""
    with page.expect_download() as download:
        page.get_by_text(label).click()
    return Path(download.value.path()).read_text("utf-8")


@pytest.mark.served
def test_a_film_is_saved_and_linked_and_another_is_dropped_fitted_and_pulled(server, chromium):
    """The example's fit is stored, so it is there while the page is still being drawn."""
    with chromium.new_context(viewport={"width": 1400, "height": 1000}, reduced_motion="reduce") as context:
        page = context.new_page()
        page.goto(f"{server}?tab=measure")
        page.get_by_text("This top slipped.").wait_for()
        numbers = page.locator("table").first.inner_text()
        wanted = page.get_by_text("Open a film’s data").bounding_box()
        assert wanted["y"] + wanted["height"] < 920, "not below the numbers' first screen"
        home = page.get_by_role("button", name="Take home")
        expect(home).to_be_enabled()
        home.click()
        assert len(brought(page, "Residuals (CSV)").splitlines()) == 1 + 2 * 216
        film = brought(page, "The film, to be opened again")
        page.get_by_label("The data in the page’s link").check()
        page.wait_for_function("() => location.href.includes('film=')")
        link = page.url

        page.get_by_role("button", name="Example: it rolls").click()
        page.get_by_role("heading", name="This top rolled.").wait_for()
        for name, is_enabled in (("Take home", True), ("Fit", True), ("Stop", False)):
            expect(page.get_by_role("button", name=name, exact=True)).to_be_enabled(enabled=is_enabled)

        page.evaluate(DROP, film)
        page.get_by_text("was saved with the film").wait_for()
        assert page.locator("table").first.inner_text() == numbers

        page.evaluate(DROP, example("rolls").replace("# Nobody", "# Somebody"))
        page.get_by_text("mine.txt", exact=True).wait_for()
        page.evaluate(DROP, "a letter\nto nobody\n")
        page.get_by_role("alert").filter(has_text="No line holds numbers").wait_for()
        assert page.get_by_text("mine.txt", exact=True).count() == 1

        picture = page.get_by_role("img", name="Tilt: what was measured and fitted, over time")
        picture.wait_for()
        box = picture.bounding_box()
        # the range of time has 2 % more at both ends, between a margin of 52 px and one of 8
        x, y = box["x"] + 52 + (box["width"] - 60) * 0.02 / 1.04, box["y"] + 80
        page.mouse.move(x, y)
        page.mouse.down()
        page.mouse.move(x + 60, y, steps=5)
        page.mouse.move(x + 240, y, steps=10)
        page.mouse.up()
        ends = page.locator("input[type=text][aria-label^='Part that is fitted']")
        expect(ends.first).to_have_value(re.compile(r"^0\.[12]\d\d$"))
        expect(ends.last).to_have_value("0.746")
        check(page, "measure", LARGE)
    with chromium.new_context(viewport={"width": 390, "height": 844}, reduced_motion="reduce") as phone:
        page = phone.new_page()
        page.goto(link)
        page.get_by_text("was saved with the film").wait_for()
        assert page.locator("table").first.inner_text() == numbers
        page.wait_for_function("document.documentElement.scrollWidth == 390")
