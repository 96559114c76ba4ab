"""The faults of libraries that docs/upstream describes, each shown by its program, which uses nothing of ours."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
NOTES = sorted((ROOT / "docs/upstream").glob("*.md"))


@pytest.mark.slow
@pytest.mark.parametrize(
    "note", [note for note in NOTES if "```python" in note.read_text()], ids=lambda note: note.stem
)
def test_the_fault_is_still_there(note, tmp_path):
    """Otherwise what we borrow because of it can go."""
    text = note.read_text(encoding="utf-8")
    program = re.search(r"(?s)```python\n(.*?)```", text)[1]
    promised = re.search(r"(?m)^prints\n\n((?: {4}.*\n)+)", text)[1].replace("    ", "")
    assert "import app" not in program and "from app" not in program
    (tmp_path / "program.py").write_text(program, encoding="utf-8")
    done = subprocess.run([sys.executable, "program.py"], cwd=tmp_path, capture_output=True, text=True)
    assert done.stdout == promised, done.stderr


def test_each_part_that_is_borrowed_has_its_note_with_a_report():
    files = [ROOT / "app/borrowed.py", ROOT / "app/borrowed.js", ROOT / "app/frontend/src/borrowed.js"]
    named = {name for file in files for name in re.findall(r"docs/upstream/([\w-]+)\.md", file.read_text("utf-8"))}
    assert named == {note.stem for note in NOTES}
    assert all("\n## Report\n\n**" in note.read_text(encoding="utf-8") for note in NOTES)
