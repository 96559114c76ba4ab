"""The example notebook runs as it is, and its views come out as views."""

from pathlib import Path

import nbformat
import pytest
from nbclient import NotebookClient

NOTEBOOK = Path(__file__).parent.parent / "docs" / "example.ipynb"


@pytest.mark.slow
def test_the_example_runs():
    book = nbformat.read(NOTEBOOK, as_version=4)
    assert not any(cell.get("outputs") for cell in book.cells), "committed without its output"
    NotebookClient(book, timeout=120, resources={"metadata": {"path": NOTEBOOK.parent.parent}}).execute()
    said = ["".join(out.get("text", "") + out.get("data", {}).get("text/plain", "") for out in cell.outputs)
            for cell in book.cells if cell.cell_type == "code"]  # fmt: skip
    # the paper's top at K_J = 7 on mu_s = 0.5 turns at 0.3839 and 0.7754 rad
    assert said[0] == "(22.0, 44.4)"
    assert said[2].startswith("it ends at 178 degrees")
    assert len(said[3].splitlines()) == 5
    views = [out.data for out in book.cells[-1].outputs if "data" in out]
    assert any("text/html" in data and "Top3D" in str(data) for data in views)
