"""Regimes and colours: one list of each, for Python and JavaScript; tests/frontend/regimes.test.js tests the other
side."""

import colorsys
import json
import re

import pytest
from text_files import APP, sources, text, wrong_in

from app.model import arrival, ends, regimes
from app.model.colours import COLOURS, FAINT, GREY, INK
from app.text import LANGUAGES, listed
from tippe_core import Coulomb, State, Top, slide_many

SOURCES = sources("*.py", "*.js", "*.html", "*.css", "*.json", "*.toml", "*.svg")


def read(name):
    return json.loads((APP / "model" / name).read_text(encoding="utf-8"))


def test_python_has_the_one_list_of_regimes():
    listed_ones = read("regimes.json")
    codes = {name.lower(): code for name, code in vars(regimes).items() if isinstance(code, int)}
    assert codes == {regime["name"]: code for code, regime in enumerate(listed_ones)}
    assert list(regimes.COLOUR) == [COLOURS[regime["colour"]] for regime in listed_ones]


def test_python_has_the_one_list_of_colours():
    listed_ones = read("colours.json")
    dark = listed_ones.pop("on_dark")
    assert listed_ones == COLOURS and {*dark} <= {*COLOURS}
    assert (COLOURS["ink"], COLOURS["faint"], COLOURS["grey"]) == (INK, FAINT, GREY)


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_end_has_its_colour_and_its_words(language):
    listed_ones = read("ends.json")
    assert [*ends.COLOUR.items()] == [(end["name"], end["colour"]) for end in listed_ones]
    assert all("on_dark" in end for end in listed_ones if "in_lab" in end)
    assert [*listed("maps.ends", language)] == [*ends.NAMES]
    assert {*listed("lab.ends", language)} == {*ends.IN_LAB, "mixed"} and {*arrival.read_ends()} <= {*ends.IN_LAB}


def test_what_the_core_calls_an_end_is_in_the_list():
    top = Top.paper()
    many = slide_many(top, [State(0.1, 0.0, 0.0, spin) for spin in (0.0, 20.0, 60.0)], Coulomb(0.3), 9.0)
    assert {*many.end.ravel()} <= {*ends.NAMES}


def test_there_is_no_second_table_of_ends():
    own = {colour[1:].lower() for colour in ends.COLOUR.values()}
    others = [path for path in SOURCES if path.name != "ends.json"]
    assert len(others) > 300 and wrong_in(others, lambda path: own & {*colours_in(text(path))}) == {}


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_regime_has_its_words(language):
    words = listed("regimes", language)
    assert [*words["here"]] == [*regimes.NAMES]
    could = [name for name in regimes.NAMES if name == "rolls" or name.startswith("would")]
    assert [*words["way"]] == could
    assert [*words["why_html"]] == could[1:]
    assert {*words["stretch"]} == {*regimes.NAMES} - {"would_slip"}  # a slipping motion slips, and would not
    assert len(words) == 4


def test_regimes_that_stand_beside_each_other_are_told_apart():
    """In the ribbon of a run, and in that of a rolling motion."""
    for beside in ((regimes.ROLLS, regimes.SLIPS, regimes.GLIDES, regimes.FLIES, regimes.WOULD_LIFT, regimes.ENDS),
                   (regimes.ROLLS, regimes.WOULD_SLIP, regimes.WOULD_LIFT)):  # fmt: skip
        assert len({regimes.COLOUR[code] for code in beside}) == len(beside)


NAMES = re.compile(r"""["']would_(slip|lift)["']|\bwould_(slip|lift)( =|:)""")
OF_THE_CORE = re.compile(r"""["']roll["'].{0,40}["']slip["'].{0,40}["']air["']""")
CODES = re.compile(r"\b(ROLLS|WOULD_SLIP|WOULD_LIFT|SLIPS|FLIES|ENDS)(, \w+)* = ")


def test_there_is_no_second_table_of_regimes():
    def wrong(path):
        patterns = (NAMES, OF_THE_CORE) if path.stem == "regimes" else (NAMES, OF_THE_CORE, CODES)
        return [found[0] for pattern in patterns for found in pattern.finditer(text(path))]

    assert wrong_in([path for path in SOURCES if path.name not in ("regimes.json", "regimes.toml")], wrong) == {}


HEX = re.compile(r"(?:#|0x)([0-9a-f]{6}|[0-9a-f]{3})(?:[0-9a-f]{2})?\b", re.IGNORECASE)
TRIPLE = re.compile(r"\brgba?\(\s*(\d+)[ ,]+(\d+)[ ,]+(\d+)")
# Of a quantity by its name in any of the tables that there were.
NAMED = re.compile(
    r"""["'\w-]*\b(theta|normal|friction|omega|spin|momentum|jellett|routh|energy|force|K_J|K_R|heat|flies|slips|rolls)"""
    r"""["']?\]?\s*[:=]\s*["'`]?(#|0x)[0-9a-f]""", re.IGNORECASE)  # fmt: skip


def colours_in(words):
    """Each colour as six digits in lower case."""
    for digits in HEX.findall(words):
        yield (digits if len(digits) == 6 else "".join(2 * digit for digit in digits)).lower()
    for triple in TRIPLE.findall(words):
        yield "".join(f"{int(part):02x}" for part in triple)


def hue(digits):
    """(hue in degrees, chroma 0 to 1)"""
    red, green, blue = (int(digits[i : i + 2], 16) / 255 for i in (0, 2, 4))
    return 360 * colorsys.rgb_to_hsv(red, green, blue)[0], max(red, green, blue) - min(red, green, blue)


OURS = {name: colour[1:].lower() for name, colour in COLOURS.items() if name not in ("ink", "faint", "grey")}
OF_ITS_OWN = ("omega", "normal", "flies")  # hues that nothing else uses, so that their shades are recognised


def second_colours(words):
    """The colours in a text that belong to a quantity or a regime."""
    for digits in colours_in(words):
        where, much = hue(digits)
        shade = much > 0.15 and any(abs(where - hue(OURS[name])[0]) < 12 for name in OF_ITS_OWN)
        if shade or digits in OURS.values():
            yield digits
    yield from (found[0] for found in NAMED.finditer(words))


def test_there_is_no_second_table_of_colours():
    others = [path for path in SOURCES if path.name != "colours.json"]
    assert wrong_in(others, lambda path: [*second_colours(text(path))]) == {}


@pytest.mark.parametrize("second", [
    "--q-spin: #f1c", 'omega: "#123456"', "0x1f7a3d", "#A3246F", "stroke='#1558c014'", "rgb(31 122 61 / 20%)",
    "LEDGER = {'energy': '#111111'}"])  # fmt: skip
def test_a_second_colour_is_found(second):
    assert [*second_colours(second)]
