"""The code in the README runs unchanged, and prints what the README says."""

import contextlib
import io
import re
from pathlib import Path

README = (Path(__file__).parents[1] / "README.md").read_text(encoding="utf-8")


def test_readme_code_prints_what_it_says():
    [code] = re.findall(r"```python\n(.*?)```", README, re.S)
    [printed] = re.findall(r"prints\n\n```\n(.*?)```", README, re.S)
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        exec(code, {})
    assert out.getvalue() == printed
