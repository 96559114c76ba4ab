"""Regimes and colours: one list of each, for Python and for JavaScript; tests/frontend/regimes.test.js has its side."""

import json
import re
from pathlib import Path

import pytest

from app.model import regimes
from app.model.colours import COLOURS, FAINT, GREY, INK
from app.text import LANGUAGES, listed

APP = Path(__file__).parent.parent / "app"
SOURCES = [path for kind in ("*.py", "*.js") for path in APP.rglob(kind)
           if not {"node_modules", "static"} & {*path.parts}]  # fmt: skip


def read(name):
    return json.loads((APP / "model" / name).read_text(encoding="utf-8"))


def test_python_has_the_one_list_of_regimes():
    listed_ones = read("regimes.json")
    codes = {name.lower(): code for name, code in vars(regimes).items() if isinstance(code, int)}
    assert codes == {regime["name"]: code for code, regime in enumerate(listed_ones)}
    assert list(regimes.COLOUR) == [regime["colour"] for regime in listed_ones]


def test_python_has_the_one_list_of_colours():
    assert read("colours.json") == COLOURS
    assert (COLOURS["ink"], COLOURS["faint"], COLOURS["grey"]) == (INK, FAINT, GREY)


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_regime_has_its_words(language):
    assert [*listed("browser.Top3D.verdicts", language)] == [*regimes.NAMES]
    could = [name for name in regimes.NAMES if name == "rolls" or name.startswith("would")]
    assert [*listed("controls.worst", language)] == could
    for key in ("browser.Surface3D.worst", "roll.pull"):
        assert [*listed(key, language)] == could[1:]
    assert {*listed("planes.regimes", language)} < {*regimes.NAMES}


def test_regimes_that_stand_beside_each_other_are_told_apart():
    """In the ribbon of the three planes, and of one motion."""
    for beside in ((regimes.ROLLS, regimes.SLIPS, regimes.FLIES, regimes.WOULD_LIFT, regimes.ENDS),
                   (regimes.ROLLS, regimes.WOULD_SLIP, regimes.WOULD_LIFT)):  # fmt: skip
        assert len({regimes.COLOUR[code] for code in beside}) == len(beside)


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: path.name)
def test_there_is_no_second_table_of_regimes(path):
    text = path.read_text(encoding="utf-8")
    assert not re.search(r"""["']would_(slip|lift)["']|\bwould_(slip|lift):""", text)  # their names
    assert not re.search(r"""["']roll["'].{0,40}["']slip["'].{0,40}["']air["']""", text)  # the core's
    if path.stem != "regimes":
        assert not re.search(r"\b(ROLLS|WOULD_SLIP|WOULD_LIFT|SLIPS|FLIES|ENDS)(, \w+)* = ", text)  # their codes
    violet = regimes.COLOUR[regimes.FLIES]  # no quantity has this one
    assert violet not in text
