"""A new table replaces all that came of the one before; a column that is chosen by hand has the unit in its name."""

import numpy as np
import pytest

from app.model.explorer import Explorer
from app.model.measured.film import Film, packed, written
from app.model.measured.made import LAW
from app.tabs.measure.measure import Measure
from app.text import LANGUAGES, speaking
from tippe_core import Scales, Top

T = np.arange(60) / 60  # s
TILT = 0.1 + 0.9 * T  # rad
SPIN = 125.0 - 10 * T  # rad/s
ZIP = b"PK\x03\x04\x14\0\0\0\x08\0"  # as each such file begins
PASCO = ("Time (s) Run #1", "Angle (rad) Run #1", "Angular Velocity (rad/s) Run #1")


def table(names, *columns, between="\t", comma=True):
    """A table as a measuring program writes it."""
    columns = columns or (T, TILT, SPIN)
    rows = [between.join(names), *(between.join(f"{x:.4f}" for x in row) for row in zip(*columns, strict=True))]
    return "\ufeff" + "\r\n".join(rows).replace(".", "," if comma else ".") + "\r\n"


KNOWN = table(("t (s)", "tilt (rad)", "spin (rad/s)"))
UNKNOWN = table(("Time A [s]", "Winkel A in rad", "Drehung A [rad/s]"))
FRAMES = table(("frame", "tilt (rad)"), np.arange(60), TILT)
FALLS = table(("t (s)", "tilt (rad)"), T[::-1], TILT)
FAR = table(("t (s)", "tilt (rad)"), 1.7e15 + 1e3 * np.arange(60), TILT)  # no film's times


class Later:
    """Runs whose answers come when they are asked for."""

    beside = True

    def __init__(self):
        self.begun = {}

    def begin(self, run, kind, pool=None):
        self.begun[kind] = run

    def answer(self, kind):
        run = self.begun[kind]
        run.done(run.result())


@pytest.fixture
def fitted():
    """The tab with a fitted example, whose data are in the link."""
    tab = Measure(Explorer().scene)
    tab.take_example("slips")
    tab.compute()
    tab.home.in_link.value = ["link"]
    assert "This top slipped." in tab.found.object and tab.filmed.film and tab.stage.frames and tab.home.fit
    return tab


def is_blank(tab):
    """Whether nothing is shown that was computed."""
    assert (tab._found, tab._kept, tab.constants.objects, tab.found.object) == (None, {}, [], "")
    assert (tab.stage.frames, tab.stage.measured, tab.stage.tilts) == (b"", b"", b"")
    assert (tab.home.film, tab.home.fit, tab.home.view.visible, tab.filmed.film) == ("", (), False, "")
    return tab.start.disabled and tab.cancel.disabled and tab.take_home.disabled


@pytest.mark.parametrize("text", [UNKNOWN, FRAMES, FALLS])
def test_a_table_without_data_leaves_nothing_of_the_one_before(fitted, text):
    fitted.take(text, name="mine.txt")
    assert is_blank(fitted) and fitted._data is None and not fitted.part.visible
    assert len(fitted.pictures.view.objects) == 1  # the empty frame
    assert fitted.over.objects == [fitted.columns.view] and fitted.below.objects == []
    assert "Your film should be of the top that this page shows" in fitted.about.object
    fitted._pulled(0.5)  # what a page sends that has not heard of it yet
    fitted.compute()
    assert is_blank(fitted)


def test_data_that_cannot_be_fitted_leave_nothing_of_the_ones_before(fitted):
    fitted.take(FAR, name="mine.txt")
    assert is_blank(fitted) and "cannot be fitted" in fitted.wording.object
    assert not any(curve.data["t"].size for curve in fitted.pictures._series.curves.values())


@pytest.mark.parametrize("language", LANGUAGES)
def test_where_no_column_is_known_the_page_asks_at_its_top(language):
    with speaking(language):
        tab = Measure(Explorer().scene)
        tab.view  # noqa: B018
        tab.take(UNKNOWN)
        says = {"en": "No column was recognised. Say what each is:",
                "de": "Keine Spalte wurde erkannt. Geben Sie an, was jede ist:",
                "es": "No se ha reconocido ninguna columna. Di qué es cada una:"}[language]  # fmt: skip
        assert f'role="alert">{says}<' in tab.wording.object
        [whole] = tab.view.views
        over = next(part for part in whole.objects if "over" in part.css_classes)
        assert over.objects[:2] == [tab.wording, tab.over] and tab.over.objects == [tab.columns.view]
        assert len(tab.columns.view.objects[0].views) == 4  # three columns, and the frame rate


def test_a_file_that_cannot_be_read_says_what_is_still_shown(fitted):
    before = fitted.found.object, fitted.stage.frames, fitted.filmed.film
    fitted.take(ZIP, name="export.zip")
    assert "cannot be opened" in fitted.wording.object and "Still shown: Example: it slips" in fitted.wording.object
    assert (fitted.found.object, fitted.stage.frames, fitted.filmed.film) == before and not fitted.take_home.disabled
    fitted.take(KNOWN, name="<b>first</b>.txt")
    fitted.take(ZIP, name="export.zip")
    assert "Still shown: &lt;b&gt;first&lt;/b&gt;.txt" in fitted.wording.object
    fitted.law.value = "viscous"  # the page goes on with what is shown
    assert "Still shown" not in fitted.wording.object and not fitted.start.disabled


def test_a_table_whose_lines_are_too_long_is_said_with_its_size(fitted):
    fitted.file.table = ["", 0, 1, "wide.csv", 4_000_000]
    assert "4,000 kB" in fitted.wording.object and "Still shown: Example" in fitted.wording.object
    fitted.file.table = [KNOWN, 1, 2, "mine.txt", len(KNOWN)]
    fitted.file.table = ["", 0, 3, "wide.csv", 4_000_000]
    assert "Still shown: mine.txt" in fitted.wording.object


def test_a_part_that_is_long_enough_again_takes_the_sentence_away():
    tab = Measure(Explorer().scene, Later())
    tab.take(KNOWN)
    tab._pulled(0.98)
    assert 'role="alert"' in tab.wording.object and is_blank(tab)
    tab._pulled(0.1)
    assert "alert" not in tab.wording.object and not tab.start.disabled


def test_what_is_still_being_computed_of_one_film_is_not_shown_with_the_next():
    runs = Later()
    tab = Measure(Explorer().scene, runs)
    tab.take_example("slips")
    guess, fit = (runs.begun[kind].result() for kind in ("guess", "fit"))
    late = [(runs.begun["guess"], guess), (runs.begun["fit"], fit)]
    tab.take(UNKNOWN)
    for run, result in late:
        run.done(result)
    assert is_blank(tab)


def test_the_constants_of_one_film_are_not_said_of_the_next():
    """While the next one waits for its fit."""
    runs = Later()
    tab = Measure(Explorer().scene, runs)
    tab.take_example("slips")
    runs.answer("guess")
    assert "constant" in tab.found.object or tab._kept
    tab.take_example("rolls")
    assert tab._kept == {} and "constant" not in tab.found.object and tab.constants.objects == []


def film_of(tab, **change):
    """The text of a saved film."""
    film = Film("viscous", ("body",), (0.1, 0.8), Top(0.1, 0.4, 0.41), Scales(0.02, 0.03, 9.8), None)
    return written(film, tab._data)


def test_a_saved_film_leaves_neither_its_law_nor_its_place_in_the_link():
    tab = Measure(Explorer().scene, Later())
    tab.take(KNOWN)
    film = film_of(tab)
    tab.take(film)
    assert (tab.law.value, tab.loose.value) == ("viscous", ["body"])
    tab.filmed.film = packed(film)
    tab.take(KNOWN)
    assert (tab.law.value, tab.loose.value, tab.filmed.film) == (LAW, [], "")
    tab.filmed.film = packed(film)
    tab.take(film)  # a film with other data, and not fitted yet
    assert tab.filmed.film == ""


def test_a_link_keeps_its_film_when_it_is_opened():
    tab = Measure(Explorer().scene, Later())
    tab.take(KNOWN)
    letters = packed(film_of(tab))
    other = Measure(Explorer().scene, Later())
    other.filmed.film = letters
    assert other.view is not None and other.filmed.film == letters and other.law.value == "viscous"


# ---- a column that is chosen by hand ----


def row(tab, i):
    """The parts that stand in the row of the i-th column."""
    [form] = tab.columns.view
    return form.views[i].objects


def chosen(tab, i):
    """(the menu of what the i-th column is, that of its unit, whether the page says that it was guessed)."""
    _, quantity, unit, _, guessed = row(tab, i)
    return quantity, unit, "guessed" in guessed.object


NAMES = [
    PASCO,
    ("Zeit A [s]", "Winkel A in rad", "Drehung A [rad/s]"),
    ("A (1) (s)", "B (2) (rad)", "C (3) (rad/s)"),
]


@pytest.mark.parametrize("names", NAMES)
def test_a_file_by_hand_has_the_numbers_that_it_has_by_itself(names):
    tab = Measure(Explorer().scene, Later())
    tab.take(table(names))
    for i, quantity in enumerate(("time", "tilt", "spin")):
        chosen(tab, i)[0].value = quantity
        assert not chosen(tab, i)[2]
    assert [chosen(tab, i)[1].value for i in range(3)] == ["s", "rad", "rad/s"]
    by_hand, tab_itself = tab._data, Measure(Explorer().scene, Later())
    tab_itself.take(KNOWN)
    np.testing.assert_array_equal(by_hand.series["tilt"].values, tab_itself._data.series["tilt"].values)
    np.testing.assert_allclose(by_hand.series["tilt"].values[[0, -1]], [0.1, 0.985], atol=1e-9)
    np.testing.assert_allclose(by_hand.series["spin"].values[[0, -1]], [125.0, 115.1667], atol=1e-9)
    np.testing.assert_allclose(by_hand.series["spin"].t[[0, -1]], [0.0, 0.9833], atol=1e-9)


@pytest.mark.parametrize(("name", "quantity", "unit", "size", "value"), [
    ("Time [ms]", "time", "ms", 2000.0, 2.0), ("θ of the stem in deg", "tilt", "deg", 90.0, np.pi / 2),
    ("Omega 1 (rpm)", "spin", "rpm", 60.0, 2 * np.pi), ("stem above (cm)", "tip", "cm", 3.0, 0.03)])  # fmt: skip
def test_the_unit_is_that_in_the_name_of_a_column(name, quantity, unit, size, value):
    """The numbers were converted by hand."""
    ramp = np.linspace(0, size, 60)
    by_hand = {"time": "tilt (rad)"}.get(quantity, "t (s)"), TILT if quantity == "time" else T
    tab = Measure(Explorer().scene, Later())
    tab.take(table((by_hand[0], name), by_hand[1], ramp))
    menu, of_unit, _ = chosen(tab, 1)
    menu.value = ""
    menu.value = quantity
    assert of_unit.value == unit and not chosen(tab, 1)[2]
    found = tab._data.t if quantity == "time" else tab._data.series[quantity].values
    assert found[-1] == pytest.approx(value, rel=1e-6)


def test_a_unit_that_no_name_says_is_guessed_until_somebody_chooses_it():
    tab = Measure(Explorer().scene, Later())
    tab.take(table(("A", "B", "C (m)")))
    for i, quantity in enumerate(("time", "tilt", "spin")):
        chosen(tab, i)[0].value = quantity
        assert chosen(tab, i)[2]
    assert [chosen(tab, i)[1].value for i in range(3)] == ["s", "rad", "rad/s"]  # 125 is no number of turns a second
    tab.columns._errors[2].value = "0.5"
    assert chosen(tab, 2)[2] and tab._data.series["spin"].error == 0.5
    chosen(tab, 2)[1].value = "rev/s"
    assert not chosen(tab, 2)[2] and tab._data.series["spin"].values[0] == pytest.approx(125 * 2 * np.pi)
