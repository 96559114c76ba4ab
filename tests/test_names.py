"""A name stands for one thing in tippe_core: no two modules have functions of the same name."""

import ast
from collections import defaultdict
from pathlib import Path

PACKAGE = Path(__file__).parent.parent / "tippe_core"
WRAPPED = {"omega3"}  # (31) in paper/equations.py, and the same for users, checked, in paper/curve.py


def test_no_function_has_the_name_of_another():
    found = defaultdict(set)
    for path in PACKAGE.rglob("*.py"):
        for node in ast.parse(path.read_text(encoding="utf-8")).body:
            if isinstance(node, ast.FunctionDef):
                found[node.name].add(path.relative_to(PACKAGE).as_posix())
    assert len(found) > 300
    assert {name: paths for name, paths in found.items() if len(paths) > 1 and name not in WRAPPED} == {}
