"""A file has at most 350 lines and a function at most 60, as CONTRIBUTING.md says. ESLint counts the functions of
the scripts."""

import ast
import json
import re
from pathlib import Path

from text_files import text, tree, wrong_in

ROOT = Path(__file__).parent.parent
LINES, OF_A_FUNCTION = 350, 60
FILES = [path for folder in ("app", "tippe_core") for kind in ("*.py", "*.js") for path in (ROOT / folder).rglob(kind)
         if not {"node_modules", "static"} & {*path.parts}]  # fmt: skip


def too_long(path):
    if text(path).count("\n") > LINES:
        yield text(path).count("\n")
    if path.suffix == ".js":
        yield from re.findall("eslint-disable|@ts-nocheck", text(path))
        return
    for node in ast.walk(tree(path)):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            docstring = node.body[0] if ast.get_docstring(node, clean=False) else None
            described = docstring.end_lineno - docstring.lineno + 1 if docstring else 0
            if (size := node.end_lineno - node.lineno + 1 - described) > OF_A_FUNCTION:
                yield node.name, size


def test_a_file_is_short_and_so_are_its_functions():
    assert len(FILES) > 300 and wrong_in(FILES, lambda path: [*too_long(path)]) == {}


def test_eslint_counts_the_same_in_every_script():
    config = (ROOT / "tests/frontend/eslint.config.js").read_text(encoding="utf-8")
    assert f'"max-lines": ["error", {LINES}]' in config
    assert f'"max-lines-per-function": ["error", {OF_A_FUNCTION}]' in config
    assert re.findall(r'"max-lines[\w-]*": (?!\["error")', config) == []
    assert 'files: ["**/*.js"]' in config and re.findall(r"ignores: (\[.*?\])", config) == ['["app/static"]']


def test_tsc_checks_every_script():
    config = (ROOT / "tests/frontend/tsconfig.json").read_text(encoding="utf-8")
    assert '"checkJs": true' in config and '"strict": true' in config
    assert "exclude" not in config
    folders = [
        (ROOT / "tests/frontend" / each).resolve() for each in json.loads(re.search(r'"include": (\[.*\])', config)[1])
    ]
    seen = [path for path in FILES if path.suffix == ".js" and ROOT / "app" in path.parents]
    assert [path for path in seen if not any(path.match(str(each)) or each in path.parents for each in folders)] == []
    assert len(seen) > 80
