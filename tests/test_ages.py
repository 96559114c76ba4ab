"""The pages of what was found by long runs say how much of it is of today's code."""

import copy
import json

import ages
import measured_proof
import mutants
import mutants_page
import pytest
import validation
from claims import ROWS
from fingerprint import Code, core


@pytest.mark.parametrize("page", ages.PAGES, ids=lambda page: page.name)
def test_a_page_says_how_old_it_is(page):
    """Of today's code, without a date written by hand."""
    same = page.read_text(encoding="utf-8") == ages.PAGES[page]()
    assert same, f"{page.name} does not say how old it is: python tests/ages.py writes it anew"


def test_a_row_of_other_code_is_counted_and_marked():
    kept = json.loads(validation.FILE.read_text(encoding="utf-8"))
    new = copy.deepcopy(kept)
    for rows in ROWS.values():
        new["rows"] |= {key: kept["rows"][key] | {"code": validation.code_of(of)} for key, (_, of) in rows.items()}
    assert f"All {len(kept['rows'])} rows are of today’s code." in "\n".join(validation.page(new))
    for key in ("(1)", "Fig. 5"):
        new["rows"][key] |= {"code": "0", "date": "2000-01-02"}
    lines = [*validation.page(new)]
    assert f"**2 of the {len(kept['rows'])} rows are not of today’s code**" in lines[4]
    marked = [line for line in lines if line.endswith(" 2000-01-02, older code |")]
    assert [line.split("**")[1] for line in marked] == ["(1)", "Fig. 5"]


def test_a_map_and_films_of_other_code_are_told():
    kept = json.loads(validation.FILE.read_text(encoding="utf-8"))
    for code, words in (("0", "**it is not of today’s code**"), (validation.map_code(), "with today’s code.")):
        kept["map"] |= {"code": code, "date": "2000-01-02"}
        head = " ".join(validation.ages(kept))
        assert words in head and "2000-01-02" in head
    films = [{"fit": measured_proof.stamp()}, {"fit": "0"}, {"fit": "0"}]
    assert measured_proof.age(films[:1]) == "All 1 films were asked of today’s fit."
    assert "2 of the 3 films" in measured_proof.age(films)


def of(before, **named):
    line = {"file": "old", "before": before, "by": "test_x.py::test_y", "rest": False, "date": "2000-01-02"}
    return line | {"after": before.replace("+", "-")} | named


def test_a_mutant_counts_as_noticed_only_where_its_function_is_as_it_was(monkeypatch):
    """Wherever that function is now; where it is not known which it was, its statement has to be there."""
    monkeypatch.setattr(mutants_page, "standing", lambda: {"y = a + b": {"5a": ("f", "new"), "5b": ("g", "other")}})
    placed = {"5a": ("f", "new"), "5b": ("g", "other"), "5c": None, None: ("f", "new")}
    for code, place in placed.items():
        assert mutants_page.place_of(of("y = a + b", code=code)) == place
    assert mutants_page.place_of(of("y = a + c")) is mutants_page.place_of(of("y = a + c", code="5a")) is None
    lines = [of("y = a + b", code="5a"), of("y = a + b", by="", code="5b"), of("y = a + b", code="5c"), of("y = a + c")]
    page = "\n".join(mutants_page.page(lines, 7))
    assert "Of the 4 changes that were tried, 2 are of today’s code, of 2000-01-02, and the tests noticed 1" in page
    assert "2 are of functions or statements that are no more" in page and "has 7 such changes" in page
    assert "| new | 1 | 1 (100 %) | 0 | 0 |\n| other | 1 | 0 (0 %) | 0 | 1 |\n| all | 2 | 1 (50 %) | 0 | 1 |" in page
    assert "- `g` of `other`: not explained yet" in page and "| old |" not in page


def test_what_is_explained_of_a_change_is_of_a_statement_of_today():
    unquoted = mutants_page.unquoted
    today = {unquoted(change.after) for path in core().paths.values() for change in mutants.mutants(path)}
    assert [key for key in mutants_page.EXPLAINED if unquoted(key[1]) not in today] == []


def test_the_log_of_mutants_has_its_fields():
    for line in mutants_page.logged():
        assert {"file", "before", "after", "by", "date", "commit"} <= line.keys()


def test_a_function_keeps_its_results_in_another_file():
    """The hash of a mutant is of the function alone: not of its file, nor of what it calls."""
    text = (
        "from .x import y\n\ndef f(a):\n    return y(a) + 1\n\nclass C:\n    def g(self):\n        return 2 * self.a\n"
    )
    code = Code({"p/one.py": text, "p/x.py": "def y(a): return a\n"})
    moved = Code({"q/r/two.py": f'"""Here."""\n{text}'.replace(".x", "..s.z"), "q/s/z.py": "def y(a): pass\n"})
    first, second = (dict((node.name, mark) for node, mark in mutants_page.functions_in(each, path))
                     for each, path in ((code, "p/one.py"), (moved, "q/r/two.py")))  # fmt: skip
    assert first == second and first.keys() == {"f", "g"}
    other = Code({"p/one.py": text.replace("2 *", "3 *"), "p/x.py": ""})
    found = dict((node.name, mark) for node, mark in mutants_page.functions_in(other, "p/one.py"))
    assert found["f"] == first["f"] and found["g"] != first["g"]
