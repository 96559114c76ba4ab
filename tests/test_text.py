"""Every language says the same with the same numbers, and has everything that the code asks for."""

import ast
import importlib
import re
from fnmatch import fnmatch
from string import Formatter

import pytest
from hypothesis import given
from hypothesis import strategies as st
from text_files import APP, MODULES, every, files, name_of, tree

from app.bundle import Bundled
from app.text import DEFAULT, LANGUAGES, preferred, say, written
from app.widgets.forms import Part

OTHERS = [language for language in LANGUAGES if language != DEFAULT]

# Values that are equal in every language, by file.table.key: names, and keys of other tables.
SAME = (
    "planes.units.slip",
    "sources.*.short",
    "history.part.*.sources.*",
    "planes.survives.*",
    "controls.notes.energy",
    "controls.inputs.K_?.name",
    "controls.inputs.*.unit",
    "lab.pushed.small",
    "lab.pushed.large",
    "lab_view.view.number.*.1",
    "lab_view.view.push_units.*",
    "lab_view.view.keep.units.0",
    "measure.heads.*",
    "measure.units.*",
    "measure.number_units.radius",
    "published.results.friedl.what",
    "published.view.milliseconds",
)
SHARED = {"es": "rev/s|kg/m³|Material"}  # words that are a language's as well as English
NUMBERS = r"\{[^{}]*\}"
SHORT_ELEMENT = r"<(i|b|sub|sup)>[^<]{0,4}</\1>"


def numbers(words):
    return {(name, form, how) for _, name, form, how in Formatter().parse(words) if name is not None}


def shape(found):
    """The type of a value; for words, the numbers in them."""
    return sorted(numbers(found), key=str) if isinstance(found, str) else f"{type(found).__name__} of {len(found)}"


# ---- the languages beside each other ----


@pytest.mark.parametrize("language", OTHERS)
def test_a_language_is_complete(language):
    """The core's error texts are English in the code, so English has no file for them: test_errors.py."""
    assert files(language) == files(DEFAULT) | {"errors"}
    other = {key: shape(found) for key, found in every(language).items() if key.split(".")[0] != "errors"}
    assert other == {key: shape(found) for key, found in every(DEFAULT).items()}


@pytest.mark.parametrize("language", OTHERS)
def test_a_language_is_not_english(language):
    english, same = every(DEFAULT), {}
    for key, words in every(language).items():
        shared = SHARED.get(language, "<")
        bare = re.sub(rf"{SHORT_ELEMENT}|<[^>]*>|{NUMBERS}|{shared}", "", words) if isinstance(words, str) else ""
        if re.search("[A-Za-zÀ-ÿ]{2,}", bare) and words == english.get(key):
            same[key] = words
    assert {key: words for key, words in same.items() if not any(fnmatch(key, known) for known in SAME)} == {}


# ---- what the code asks for ----


def pattern(node):
    """A regular expression for the possible values of a literal or f-string; None for anything else."""
    if isinstance(node, ast.Constant):
        return re.escape(node.value) if isinstance(node.value, str) else None
    if isinstance(node, ast.IfExp):
        both = [pattern(node.body), pattern(node.orelse)]
        return f"(?:{'|'.join(both)})" if all(both) else None
    if isinstance(node, ast.JoinedStr):
        return "".join(pattern(part) or r"[^.\n]+" for part in node.values)
    if isinstance(node, ast.FormattedValue):
        return pattern(node.value) if isinstance(node.value, ast.IfExp) else r"[^.\n]+"
    return None


def asked():
    """(place, pattern of the key, names of the numbers or None) of each call of say() and listed()."""
    for path in MODULES:
        for node in ast.walk(tree(path)):
            if isinstance(node, ast.Call) and name_of(node) in ("say", "listed") and node.args:
                key = pattern(node.args[0])
                if key is not None:
                    names = {keyword.arg for keyword in node.keywords}
                    known = None if None in names or name_of(node) == "listed" else names - {"language"}
                    yield f"{path.name}:{node.lineno}", key, known


@pytest.mark.parametrize("language", LANGUAGES)
def test_what_is_asked_for_is_there(language):
    known, calls, wrong = every(language), list(asked()), []
    names_of_all = "\n".join(known)
    assert len(calls) > 60
    for place, key, names in calls:
        found = [known[name] for name in re.findall(f"(?m)^{key}$", names_of_all)]
        numbered = {name for name, _, _ in numbers(found[0])} if names is not None and len(found) == 1 else set()
        if not found or not numbered <= (names or set()):
            wrong.append((place, key, found[:1]))
    assert wrong == []


def modules_of(script):
    """A script of the bundle and everything of ours that it imports."""
    found, new = set(), {script}
    while new:
        path = new.pop()
        found.add(path)
        imports = re.findall(r'from "(\.[\w./]+\.js)"', path.read_text(encoding="utf-8"))
        new |= {(path.parent / name).resolve() for name in imports} - found
    return found


def components():
    """(name, script) in the index of the bundle."""
    index = (APP / "frontend/src/index.js").read_text(encoding="utf-8")
    imports = re.findall(r'import { (.+) } from "\./([\w/]+\.js)"', index)
    shown = [(name, APP / "frontend/src" / file) for names, file in imports for name in re.findall(r" as (\w+)", names)]
    assert len(shown) > 30
    return shown


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize(("name", "script"), components(), ids=[name for name, _ in components()])
def test_what_the_bundle_asks_for_is_there(name, script, language):
    module = next(
        path for path in MODULES if re.search(rf"^class {name}\((Bundled|Part)\b", path.read_text("utf-8"), re.M)
    )
    importlib.import_module(".".join(module.relative_to(APP.parent).with_suffix("").parts))
    [component] = [kind for kind in (*Bundled.__subclasses__(), *Part.__subclasses__()) if kind.__name__ == name]
    inside = getattr(importlib.import_module(component.__module__), "PARTS", ())  # which bring their own texts
    known = {key for kind in (component, *inside) for key in kind.says(language)}
    wanted = {
        key for path in modules_of(script) for key in re.findall(r"\btexts\.(\w+)", path.read_text(encoding="utf-8"))
    }
    assert wanted <= known


# ---- which language a page speaks ----


@pytest.mark.parametrize(
    ("header", "language"),
    {
        "": "en",
        "de": "de",
        "DE": "de",
        "en": "en",
        "fr": "en",
        "de-AT": "de",
        "de-Latn-CH-1996": "de",
        "den": "en",
        "da, en-gb;q=0.8, en;q=0.7": "en",  # the example of RFC 9110, 12.5.4
        "de, en": "de",
        "en, de": "en",
        "en;q=0.8, de;q=0.9": "de",
        "en;q=0.899, de;q=0.9": "de",
        "de;q=0.5, en;q=0.5": "de",
        "fr, de;q=0.2": "de",
        "es-419, en": "es",
        "ca, es;q=0.9, en;q=0.8": "es",
        "est": "en",
        "de;q=0": "en",
        "de;q=0.000, fr": "en",
        "de;q=0, de-CH": "de",
        "*": "en",
        "fr, *;q=0.5": "en",
        "de;q=0.4, *;q=0.5": "en",
        "de;q=0.5, *;q=0.4": "de",
        "en;q=0, *": "de",
        "*;q=0": "en",
        "de ; q=0.9 , en;q=0.8": "de",
        "en;q=0.5,\tde": "de",
        "en;Q=0.5, de;Q=0.6": "de",
        ", ,de,": "de",
        # invalid weights and tags are ignored
        "de;q=2, en;q=0.1": "en",
        "de;q=nan, en": "en",
        "de;q=-1, en": "en",
        "de;q=0.12345, en;q=0.1": "en",
        "de;q=, en": "en",
        "de_DE, en": "en",
        "<script>, de": "de",
        "x" * 10_000: "en",
        "fr," * 10_000 + "de": "en",  # too many languages
    }.items(),
)
def test_what_a_browser_asks_for(header, language):
    assert preferred(header) == language


PIECES = st.sampled_from(["de", "en", "*", "-AT", ";", "q=", "0.5", "1", ",", " ", "\u0660"])


@given(st.text() | st.lists(PIECES).map("".join))
def test_any_header_gives_a_language(header):
    assert preferred(header) in LANGUAGES


def test_numbers_are_written_as_the_language_does():
    comma = "−1\N{NARROW NO-BREAK SPACE}234,5"
    assert {language: written(-1234.5, ",.1f", language) for language in LANGUAGES} == {
        "en": "−1,234.5", "de": comma, "es": comma}  # fmt: skip
    assert ["12.3" in say("roll.says.unit", "en", time="", milliseconds=12.34),
            "12,3" in say("roll.says.unit", "de", time="", milliseconds=12.34)] == [True, True]  # fmt: skip
