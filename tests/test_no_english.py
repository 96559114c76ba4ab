"""No English text exists outside app/text/."""

import ast
import re
from functools import cache

from text_files import APP, MODULES, every, name_of, text, tree, wrong_in

from app.text import DEFAULT

CORE = APP.parent / "tippe_core"
SCRIPTS = sorted((APP / "frontend/src").rglob("*.js"))


# ---- no English beside the words ----

TOKEN = re.compile(r"""//[^\n]*|/\*.*?\*/|("(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])*')|[`{}]""", re.DOTALL)
TEMPLATE = re.compile(r"(?:\\.|\$(?!\{)|[^`$\\])*", re.DOTALL)

# Strings that look like English but that no visitor reads: {end of a path: {beginning of the string: why}}.
NOT_SAID = {
    "answers.py": {"GET, HEAD": "a header"},
    **{name: {"": "said to the log"} for name in ("validate.py", "form.py")},
    "compare.py": {"I1 > 0 (in MR^2)": "the core's own"},
    **{name: {"": "files of data and programs, which are the same in every language"}
       for name in ("export.py", "measured/examples.py", "measured/report.py", "glb.py", "programs.py",
                    "saved_runs.py")},
    "codecs.py": {"not one of {}": "said to the log"},
    **{name: {"": "said to who writes the page"} for name in ("url_state.py", "names.py")},
    "prints.py": {"tippe top": "never shown"},
    **{name: {"": "said to the operator, or to a program that is no browser"}
       for name in ("server.py", "arrivals.py", "ballots.py", "desk.py", "files.py", "health.py", "logs.py",
                    "messages.py", "pages.py", "settings.py", "site.py", "sockets.py")},
    "src/tokens.js": {"dark large": "a key"},
    "three/stage.js": {"precision highp": "a shader"},
}  # fmt: skip


def bare(words):
    """The text without HTML elements, CSS rules, and calls."""
    words = re.sub(r"<(style|script)\b.*?</\1>", " § ", words, flags=re.DOTALL)
    for other in (r"<[^<>]*>?", *2 * [r"[^{}]*\{[^{}]*:[^{}]*\}"], *3 * [r"[\w-]+\([^()]*\)"]):
        words = re.sub(other, " § ", words)
    return words


@cache
def vocabulary():
    """All words in the English files."""
    words = [bare(words) for words in every(DEFAULT).values() if isinstance(words, str)]
    return set(re.findall("[a-z]{2,}", " ".join(words).lower()))


def is_english(words):
    """Two words of the vocabulary in succession."""
    pairs = re.findall(r"(?=\b([a-z]{2,})[,:;]? +([a-z]{2,})\b)", bare(words).lower())
    return any(one in vocabulary() and other in vocabulary() for one, other in pairs)


def literals(script):
    """All strings and templates of a JavaScript file; § stands for inserted values."""
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
    """Every string of a module, an f-string as a whole with {} for inserted values; those that only its readers see do
    not count."""
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
    """The strings of a file that the page could show."""
    if path.suffix == ".js":
        return literals(text(path))
    found = []
    for words in constants(tree(path)):
        found += literals(words) if "const " in words else [words]
    return found


@cache
def enumerated():
    """Names that the core uses, and the keys of their words."""
    names = {key.rpartition(".")[2] for key in every(DEFAULT)}
    return names.union(*(constants(tree(path)) for path in CORE.rglob("*.py")))


def english(path):
    left = [words for words in strings(path) if words not in enumerated() and is_english(words)]
    allowed = [start for name, starts in NOT_SAID.items() if path.as_posix().endswith(f"/{name}") for start in starts]
    gone = [start for start in allowed if not any(words.startswith(start) for words in left)]
    return [words for words in left if not words.startswith(tuple(allowed))] + [f"no more: {start}" for start in gone]


def test_no_english_is_left_in_the_code():
    assert wrong_in([*MODULES, *SCRIPTS], english) == {}


def labels(path):
    for node in ast.walk(tree(path)):
        if isinstance(node, ast.keyword) and node.arg in ("label", "title", "placeholder", "description"):
            written = node.value.value if isinstance(node.value, ast.Constant) else ""
            if re.fullmatch("[A-Za-z ]{2,}", written or "") and written != "Python":
                yield node.value.lineno, written


def test_no_label_is_written_in_the_code():
    assert wrong_in(MODULES, lambda path: [*labels(path)]) == {}
