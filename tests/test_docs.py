"""All code on the pages of docs/ runs, and prints what the page says: python tests/test_docs.py PAGE writes that."""

import ast
import contextlib
import functools
import io
import re
import sys
import textwrap
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
import pytest
from claims import ROWS

import tippe_core
from app.state.names import NAMES
from app.state.url_state import explorer_of, read
from app.text import LANGUAGES, listed
from tippe_core import Top

HERE = Path(__file__).parent
DOCS, CORE = HERE.parent / "docs", HERE.parent / "tippe_core"
PAGES = sorted(path.stem for path in DOCS.glob("*.md"))
matplotlib.use("agg")


def text(page):
    return (DOCS / f"{page}.md").read_text(encoding="utf-8")


PRINTED = re.compile(r"```python\n(.*?)```\n\nprints\n\n```text\n(.*?)```", re.S)


def prints(code):
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        exec(code, {})
    return out.getvalue()


def written(page):
    """The page's text with what its code prints today."""
    return PRINTED.sub(
        lambda each: each[0].replace(f"```text\n{each[2]}```", f"```text\n{prints(each[1])}```"), text(page)
    )


@pytest.mark.slow
@pytest.mark.parametrize("page", [page for page in PAGES if "```python" in text(page)])
def test_printed_lines(page):
    for code, printed in PRINTED.findall(text(page)):
        assert prints(code) == printed
    assert text(page).count("```python") == text(page).count("\nprints\n")


@pytest.mark.parametrize("page", [page for page in PAGES if ".. plot::" in text(page)])
def test_figures(page):
    for block in re.findall(r"\.\. plot::\n\n(.*?)```", text(page), re.S):
        exec(textwrap.dedent(block), {})
        assert any(axes.has_data() for axes in plt.gcf().axes)
        plt.close("all")


def test_pages_are_in_the_index_and_nothing_is_fetched_from_outside():
    """Sphinx refuses a page or notebook that no index lists, in any folder that conf.py does not exclude."""
    listed = " ".join(re.findall(r"```{toctree}.*?\n\n(.*?)```", text("index"), re.S)).split()
    conf = (DOCS / "conf.py").read_text(encoding="utf-8")
    excluded = ast.literal_eval(re.search(r"exclude_patterns = (\[.*?\])", conf)[1])
    there = [path.relative_to(DOCS).with_suffix("") for path in DOCS.rglob("*") if path.suffix in (".md", ".ipynb")]
    assert sorted([*listed, "index"]) == sorted(path.as_posix() for path in there if path.parts[0] not in excluded)
    pages = "".join(text(page) for page in PAGES) + conf
    assert not re.search(r"(src|href)=|mathjax_path|html_js_files|html_css_files|!\[[^]]*\]\(http", pages)


NAME = r"`(\w+)`"
ROW = r"\| `([\w/]+\.py)` \| ([^|]*) \|$"


@functools.cache
def defined(file):
    """The functions and classes that a file of tippe_core defines, with their docstrings; imported ones do not
    count."""
    tree = ast.parse((CORE / file).read_text(encoding="utf-8"))
    return {node.name: ast.get_docstring(node) or "" for node in tree.body if hasattr(node, "name")}


def test_each_equation_is_where_the_page_says():
    """The page has all numbers from 1 to 39, and the named files contain the functions, with that number in their
    docstrings."""
    page, numbers = text("equations"), set()
    for line in page.splitlines():
        first, last = (re.search(r"^\| \((\d+)\)" + part, line) for part in ("", r"(?: to|,) \((\d+)\)"))
        if first:
            numbers |= {*range(int(first[1]), int(last[2] if last else first[1]) + 1)}
        if row := re.search(ROW, line):
            names = re.findall(NAME, row[2])
            assert names and {*names} <= {*defined(row[1])}, line
            if row[1] == "paper/equations.py" and first:
                for name in names:
                    assert f"({first[1]})" in defined(row[1])[name], name
    assert numbers == {*range(1, 40)}


def test_every_equation_is_on_the_page():
    listed = {name for file, names in re.findall(ROW, text("equations"), re.M) if file == "paper/equations.py"
              for name in re.findall(NAME, names)}  # fmt: skip
    assert listed == {*defined("paper/equations.py")}


def test_the_walks_name_functions_that_are_there():
    walks = text("equations").split("## Three walks")[1]
    files = {file for file in re.findall(r"`([\w/]+\.py)`", walks)} | {"paper/equations.py", "paper/poles.py"}
    names = {name for file in files for name in defined(file)}
    assert {*re.findall(NAME, walks)} <= names


def test_every_row_is_on_the_page_with_evidence():
    """docs/validation.md has each row once, with a difference and with existing tests."""
    page = text("validation")
    sources = "".join(p.read_text(encoding="utf-8") for p in HERE.glob("test_*.py"))
    for rows in ROWS.values():
        for key in rows:
            [line] = [line for line in page.splitlines() if line.startswith(f"| **{key}** |")]
            cells = re.split(r"(?<!\\)\|", line)[1:-1]
            float(cells[4]), float(cells[5])
            tests = re.findall(r"`(test_\w+\.py)::(\w+)`", cells[6])
            assert tests and f'"{key}"' in sources, key
            for file, name in tests:
                assert f"def {name}(" in (HERE / file).read_text(encoding="utf-8")


def test_the_house_names_files_that_are_there():
    named = re.findall(r"`((?:app|tippe_core)/[\w/]+\.\w+)`", text("architecture"))
    assert len(named) > 20 and [name for name in named if not (DOCS.parent / name).is_file()] == []


def test_the_reference_has_each_public_name_once():
    named = re.findall(r"\.\. auto\w+:: tippe_core\.(\w+)", text("api"))
    assert sorted(named) == sorted(tippe_core.__all__)


GALLERY = sorted((DOCS / "gallery").glob("*.py"))


@pytest.mark.parametrize("path", GALLERY, ids=lambda path: path.stem)
def test_a_script_of_the_gallery_draws_what_its_link_opens(path):
    """The script uses the numbers of the link, and the link contains nothing that the explorer does not know."""
    code, found = path.read_text(encoding="utf-8"), {}
    title, words = ast.get_docstring(ast.parse(code)).split("\n\n")
    place = f"## {title}\n\n{words}\n\n```{{eval-rst}}\n.. plot:: gallery/{path.name}\n```\n\n"
    try:
        exec(code, found)
        assert any(axes.has_data() for axes in plt.gcf().axes)
    finally:
        plt.close("all")
    assert f"{place}[Open it in the explorer](http://localhost:5006/app{found['LINK']})\n" in text("gallery")
    texts, wrong = read(found["LINK"])
    explorer, impossible = explorer_of(texts)
    assert not wrong + impossible and texts.keys() <= NAMES.keys()
    for key, codec in ((key, NAMES[key].codec) for key in texts):
        codec.value(texts[key])
    assert explorer.scene.top.a == pytest.approx(Top.paper().a, abs=3e-4)
    if "start" in found:  # a State, of a hand that gives the spin in turns a second and the tilt in degrees
        turns = found["start"].omega3 * (9.81 / 0.016) ** 0.5 / (2 * np.pi)
        assert float(texts["spin"]) == pytest.approx(turns) and float(texts["mu_k"]) == 0.3 and texts["stem"] == "no"
        assert float(texts["tilt"]) == pytest.approx(np.degrees(found["start"].theta))
    for name, key in (("K_J", "KJ"), ("K_R", "KR"), ("E", "E")):
        if key in texts:
            assert float(texts[key]) == found[name] == pytest.approx(getattr(explorer.scene.constants, name))


def test_the_gallery_has_ten():
    assert len(GALLERY) == text("gallery").count(".. plot::") == 10


def test_a_term_is_explained_once():
    terms = [each.strip() for row in re.findall(r"(?m)^\| ([^|]+) \|", text("glossary"))
             for each in re.split(r"[,;]", row)]  # fmt: skip
    assert len(terms) == len({*terms}) > 50


def test_the_page_explains_a_term_as_the_glossary_does():
    """The hover texts and docs/glossary.md have the same words."""
    rows = dict(re.findall(r"(?m)^\| ([^|,]+?)(?:,[^|]*)? \| (.*) \|$", text("glossary")))
    hover = {each["forms"].split("|")[0]: each["is"] for each in listed("glossary.terms", "en").values()}
    assert hover == {name: rows.get(name) for name in hover} and len(hover) > 40


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_form_belongs_to_one_term(language):
    forms = [form.lower() for each in listed("glossary.terms", language).values() for form in each["forms"].split("|")]
    assert len(forms) == len({*forms})


if __name__ == "__main__":
    (DOCS / f"{sys.argv[1]}.md").write_text(written(sys.argv[1]), encoding="utf-8")
