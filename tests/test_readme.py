"""The code in the README runs unchanged, and prints what the README says."""

import contextlib
import io
import re
from pathlib import Path

from app.model.lesson.lesson import LESSON

README = (Path(__file__).parents[1] / "README.md").read_text(encoding="utf-8")


def test_readme_code_prints_what_it_says():
    [code] = re.findall(r"```python\n(.*?)```", README, re.S)
    [printed] = re.findall(r"prints\n\n```\n(.*?)```", README, re.S)
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        exec(code, {})
    assert out.getvalue() == printed


def test_the_lesson_has_as_many_steps_as_the_readme_says():
    numbers = {"six": 6, "seven": 7, "eight": 8}
    [number] = re.findall(r"lesson in (\w+) steps", README)
    assert numbers[number] == len(LESSON)
