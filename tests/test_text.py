"""Every language says the same things with the same numbers; what the code asks for is there; no English beside it."""

import ast
import importlib
import itertools
import re
from fnmatch import fnmatch
from functools import cache
from pathlib import Path
from string import Formatter

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.bundle import Bundled
from app.text import DEFAULT, LANGUAGES, listed, preferred, say, written

APP = Path(__file__).parent.parent / "app"
CORE = APP.parent / "tippe_core"
SCRIPTS = sorted((APP / "frontend/src").rglob("*.js"))
OTHERS = [language for language in LANGUAGES if language != DEFAULT]

# Values that are one in every language, by file.table.key: names, and keys of other tables.
SAME = (
    "sources.*.short",
    "history.part.*.sources.*",
    "planes.survives.*",
    "browser.Dial.entry",
    "controls.notes.energy",
    "lab.keeps.millimetres",
    "lab_view.view.inputs.patch.unit",
    "lab_view.view.number.*.1",
    "measure.heads.*",
    "measure.units.*",
    "measure.number_units.radius",
)
NUMBERS = r"\{[^{}]*\}"
SHORT_ELEMENT = r"<(i|b|sub|sup)>[^<]{0,4}</\1>"


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


def numbers(words):
    return {(name, form, how) for _, name, form, how in Formatter().parse(words) if name is not None}


def shape(found):
    """The kind of a value; of words, the numbers in them."""
    return sorted(numbers(found), key=str) if isinstance(found, str) else f"{type(found).__name__} of {len(found)}"


# ---- the languages beside each other ----


@pytest.mark.parametrize("language", OTHERS)
def test_a_language_is_complete(language):
    """What the core says of errors is English in the code, so English has no file for it: test_errors.py."""
    assert files(language) == files(DEFAULT) | {"errors"}
    other = {key: shape(found) for key, found in every(language).items() if key.split(".")[0] != "errors"}
    assert other == {key: shape(found) for key, found in every(DEFAULT).items()}


@pytest.mark.parametrize("language", OTHERS)
def test_a_language_is_not_english(language):
    english, same = every(DEFAULT), {}
    for key, words in every(language).items():
        bare = re.sub(rf"{SHORT_ELEMENT}|<[^>]*>|{NUMBERS}", "", words) if isinstance(words, str) else ""
        if re.search("[A-Za-zÀ-ÿ]{2,}", bare) and words == english.get(key):
            same[key] = words
    assert {key: words for key, words in same.items() if not any(fnmatch(key, known) for known in SAME)} == {}


# ---- what the code asks for ----


@cache
def tree(path):
    return ast.parse(path.read_text(encoding="utf-8"))


MODULES = sorted(path for path in APP.rglob("*.py") if not {"node_modules", "text"} & {*path.parts})


def name_of(call):
    """Of a function called by itself or out of a module; a method's is another."""
    if isinstance(call.func, ast.Attribute):
        return call.func.attr if getattr(call.func.value, "id", "") == "text" else ""
    return getattr(call.func, "id", "")


def pattern(node):
    """A regular expression for what a literal or f-string can be; None for what is neither."""
    if isinstance(node, ast.Constant):
        return re.escape(node.value) if isinstance(node.value, str) else None
    if isinstance(node, ast.IfExp):
        both = [pattern(node.body), pattern(node.orelse)]
        return f"(?:{'|'.join(both)})" if all(both) else None
    if isinstance(node, ast.JoinedStr):
        return "".join(pattern(part) or "[^.]+" for part in node.values)
    if isinstance(node, ast.FormattedValue):
        return pattern(node.value) if isinstance(node.value, ast.IfExp) else "[^.]+"
    return None


def asked():
    """(place, pattern of the key, names of the numbers or None) of each say() and listed()."""
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
    assert len(calls) > 60
    for place, key, names in calls:
        found = [words for name, words in known.items() if re.fullmatch(key, name)]
        numbered = {name for name, _, _ in numbers(found[0])} if names is not None and len(found) == 1 else set()
        if not found or not numbered <= (names or set()):
            wrong.append((place, key, found[:1]))
    assert wrong == []


def modules_of(script):
    """A script of the bundle and all that it imports of our own."""
    found, new = set(), {script}
    while new:
        path = new.pop()
        found.add(path)
        imports = re.findall(r'from "(\.[\w./]+\.js)"', path.read_text(encoding="utf-8"))
        new |= {(path.parent / name).resolve() for name in imports} - found
    return found


def components():
    """(name, script) of the bundle's index."""
    index = (APP / "frontend/src/index.js").read_text(encoding="utf-8")
    scripts = dict(re.findall(r'import { (\w+) } from "\./([\w/]+\.js)"', index))
    shown = re.findall(r"(\w+): { render: (\w+)", index)
    return [(name, APP / "frontend/src" / scripts[render]) for name, render in shown]


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize(("name", "script"), components(), ids=[name for name, _ in components()])
def test_what_the_bundle_asks_for_is_there(name, script, language):
    module = next(path for path in MODULES if re.search(rf"^class {name}\(Bundled\)", path.read_text("utf-8"), re.M))
    importlib.import_module(".".join(module.relative_to(APP.parent).with_suffix("").parts))
    [component] = [kind for kind in Bundled.__subclasses__() if kind.__name__ == name]
    known = set(component.says(language))
    wanted = {
        key for path in modules_of(script) for key in re.findall(r"\btexts\.(\w+)", path.read_text(encoding="utf-8"))
    }
    assert wanted <= known


# ---- no English beside the words ----

TOKEN = re.compile(r"""//[^\n]*|/\*.*?\*/|("(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])*')|[`{}]""", re.DOTALL)
TEMPLATE = re.compile(r"(?:\\.|\$(?!\{)|[^`$\\])*", re.DOTALL)

# What looks like English in the code and is none that a visitor reads: {the end of a path: {its beginning: why}}.
NOT_SAID = {
    "answers.py": {"GET, HEAD": "a header"},
    "asked.py": {"": "said to the log"},
    "compare.py": {"I1 > 0 (in MR^2)": "the core's own"},
    **{name: {"": "files of data and programs, which are the same in every language"}
       for name in ("export.py", "measured/examples.py", "measured/report.py", "glb.py", "programs.py",
                    "saved_runs.py")},
    "measured/table.py": {"": "what tables call their columns"},
    "codecs.py": {"not one of {}": "said to the log"},
    **{name: {"": "said to who writes the page"} for name in ("keep.py", "names.py")},
    "prints.py": {"tippe top": "never shown"},
    **{name: {"": "said to the operator, or to a program that is no browser"}
       for name in ("server.py", "arrivals.py", "ballots.py", "health.py", "logs.py", "messages.py", "settings.py",
                    "sockets.py")},
    "look.js": {"dark large": "a key"},
}  # fmt: skip


def bare(words):
    """Without elements, rules of CSS, and calls."""
    words = re.sub(r"<(style|script)\b.*?</\1>", " § ", words, flags=re.DOTALL)
    for other in (r"<[^<>]*>?", *2 * [r"[^{}]*\{[^{}]*:[^{}]*\}"], *3 * [r"[\w-]+\([^()]*\)"]):
        words = re.sub(other, " § ", words)
    return words


@cache
def vocabulary():
    """The words of the English files."""
    words = [bare(words) for words in every(DEFAULT).values() if isinstance(words, str)]
    return set(re.findall("[a-z]{2,}", " ".join(words).lower()))


def is_english(words):
    """Two words of the vocabulary, one after the other."""
    pairs = re.findall(r"(?=\b([a-z]{2,})[,:;]? +([a-z]{2,})\b)", bare(words).lower())
    return any(one in vocabulary() and other in vocabulary() for one, other in pairs)


def literals(script):
    """All strings and templates of a JavaScript, § for what is put into them."""
    found, around, at = [], [], 0  # around: the templates here, each with its pieces and the braces open in it
    while at < len(script):
        if around and around[-1][1] == 0:
            text = TEMPLATE.match(script, at)
            around[-1][0].append(text[0])
            if script[text.end()] == "`":
                found.append("§".join(around.pop()[0]))
            else:
                around[-1][1] = 1
            at = text.end() + (1 if script[text.end()] == "`" else 2)
        elif token := TOKEN.search(script, at):
            at = token.end()
            if token[1]:
                found.append(token[1][1:-1])
            elif token[0] == "`":
                around.append([[], 0])
            elif token[0] in "{}" and around:
                around[-1][1] += 1 if token[0] == "{" else -1
        else:
            break
    return found


def constants(module):
    """Every string in a module, an f-string as a whole with {} for what is put in; not what only its readers see."""
    passed = set()
    for node in ast.walk(module):
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
            passed.add(id(node.value))
        unseen = [node.value] if isinstance(node, ast.keyword) and node.arg == "doc" else []
        if isinstance(node, ast.Call) and name_of(node) in ("TopError", "NoMotionError", "namedtuple"):
            unseen = node.args
        if isinstance(node, ast.Call) and getattr(getattr(node.func, "value", None), "id", "") in ("log", "logger"):
            unseen = node.args
        passed.update(id(inner) for each in unseen for inner in ast.walk(each))
    for node in ast.walk(module):
        if isinstance(node, ast.JoinedStr) and id(node) not in passed:
            passed.update(map(id, node.values))
            yield "".join(part.value if isinstance(part, ast.Constant) else "{}" for part in node.values)
        elif isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in passed:
            yield node.value


def strings(path):
    """What a file of the page could show."""
    if path.suffix == ".js":
        return literals(path.read_text(encoding="utf-8"))
    found = []
    for words in constants(tree(path)):
        found += literals(words) if "const " in words else [words]
    return found


@cache
def enumerated():
    """What the core calls things, and the keys under which there are words for them."""
    names = {key.rpartition(".")[2] for key in every(DEFAULT)}
    return names.union(*(constants(tree(path)) for path in CORE.rglob("*.py")))


@pytest.mark.parametrize("path", [*MODULES, *SCRIPTS], ids=lambda path: path.name)
def test_no_english_is_left_in_the_code(path):
    left = [words for words in strings(path) if words not in enumerated() and is_english(words)]
    allowed = [start for name, starts in NOT_SAID.items() if path.as_posix().endswith(f"/{name}") for start in starts]
    assert [words for words in left if not words.startswith(tuple(allowed))] == []
    assert [start for start in allowed if not any(words.startswith(start) for words in left)] == []


@pytest.mark.parametrize("path", MODULES, ids=lambda path: path.name)
def test_no_label_is_written_in_the_code(path):
    for node in ast.walk(tree(path)):
        if isinstance(node, ast.keyword) and node.arg in ("label", "title", "placeholder", "description"):
            written = node.value.value if isinstance(node.value, ast.Constant) else ""
            assert not re.fullmatch("[A-Za-z ]{2,}", written or "") or written == "Python", node.value.lineno


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
        # what is no weight, or no tag, is passed over
        "de;q=2, en;q=0.1": "en",
        "de;q=nan, en": "en",
        "de;q=-1, en": "en",
        "de;q=0.12345, en;q=0.1": "en",
        "de;q=, en": "en",
        "de_DE, en": "en",
        "<script>, de": "de",
        "x" * 10_000: "en",
        "fr," * 10_000 + "de": "en",  # nobody speaks so many
    }.items(),
)
def test_what_a_browser_asks_for(header, language):
    assert preferred(header) == language


PIECES = st.sampled_from(["de", "en", "*", "-AT", ";", "q=", "0.5", "1", ",", " ", "\u0660"])


@given(st.text() | st.lists(PIECES).map("".join))
def test_any_header_gives_a_language(header):
    assert preferred(header) in LANGUAGES


def test_numbers_are_written_as_the_language_does():
    assert [written(-1234.5, ",.1f", language) for language in LANGUAGES] == [
        "−1,234.5",
        "−1\N{NARROW NO-BREAK SPACE}234,5",
    ]
    assert ["12.3" in say("roll.says.unit", "en", time="", milliseconds=12.34),
            "12,3" in say("roll.says.unit", "de", time="", milliseconds=12.34)] == [True, True]  # fmt: skip
