"""Every line of code on the pages of docs/ runs, and prints what the page says."""

import contextlib
import io
import re
import textwrap
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
import pytest
from claims import ROWS

HERE = Path(__file__).parent
DOCS = HERE.parent / "docs"
PAGES = sorted(path.stem for path in DOCS.glob("*.md"))
matplotlib.use("agg")


def text(page):
    return (DOCS / f"{page}.md").read_text(encoding="utf-8")


@pytest.mark.slow
@pytest.mark.parametrize("page", [page for page in PAGES if "```python" in text(page)])
def test_printed_lines(page):
    for code, printed in re.findall(r"```python\n(.*?)```\n\nprints\n\n```text\n(.*?)```", text(page), re.S):
        out = io.StringIO()
        with contextlib.redirect_stdout(out):
            exec(code, {})
        assert out.getvalue() == printed
    assert text(page).count("```python") == text(page).count("\nprints\n")


@pytest.mark.parametrize("page", [page for page in PAGES if ".. plot::" in text(page)])
def test_figures(page):
    for block in re.findall(r"\.\. plot::\n\n(.*?)```", text(page), re.S):
        exec(textwrap.dedent(block), {})
        assert any(axes.has_data() for axes in plt.gcf().axes)
        plt.close("all")


def test_pages_are_in_the_index_and_nothing_is_fetched_from_outside():
    listed = re.search(r"```{toctree}.*?\n\n(.*?)```", text("index"), re.S)[1].split()
    assert sorted([*listed, "index"]) == PAGES
    pages = "".join(text(page) for page in PAGES) + (DOCS / "conf.py").read_text(encoding="utf-8")
    assert not re.search(r"(src|href)=|mathjax_path|html_js_files|html_css_files|!\[[^]]*\]\(http", pages)


def test_every_row_is_on_the_page_with_evidence():
    """docs/validation.md has each row once, with a difference and with tests that are there."""
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
