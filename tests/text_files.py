"""What stands in the files of app/text/, and the code that asks for it."""

import ast
import itertools
from functools import cache
from pathlib import Path

from app.text import listed

APP = Path(__file__).parent.parent / "app"


@cache
def files(language):
    return {path.stem for path in (APP / "text" / language).glob("*.toml")}


def parts(found, path=()):
    """What stands in a file: (path, words, a table or a list), the root too."""
    yield ".".join(map(str, path)), found
    if not isinstance(found, str):
        for name, inner in found.items() if isinstance(found, dict) else enumerate(found):
            yield from parts(inner, (*path, name))


@cache
def every(language):
    """{key: words, a table or a list} of all files."""
    return dict(itertools.chain.from_iterable(parts(listed(name, language), (name,)) for name in files(language)))


@cache
def text(path):
    return path.read_text(encoding="utf-8")


@cache
def tree(path):
    return ast.parse(text(path))


def sources(*kinds):
    """The files of these kinds that are written by hand, in app/."""
    return sorted(path for kind in kinds for path in APP.rglob(kind) if not {"node_modules", "static"} & {*path.parts})


def wrong_in(paths, wrong):
    """{path: what is wrong there} of the files in which wrong(path) finds anything."""
    return {path.relative_to(APP.parent).as_posix(): found for path in paths if (found := wrong(path))}


MODULES = sorted(path for path in APP.rglob("*.py") if not {"node_modules", "text"} & {*path.parts})


def name_of(call):
    """Of a function called by itself or out of a module; a method's is another."""
    if isinstance(call.func, ast.Attribute):
        return call.func.attr if getattr(call.func.value, "id", "") == "text" else ""
    return getattr(call.func, "id", "")
