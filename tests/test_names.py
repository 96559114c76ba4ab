"""Everything that an address can contain is in one table, and nowhere else."""

import ast
import re

import param
import pytest
from text_files import APP, sources, text, tree, wrong_in

from app.model.explorer import Explorer
from app.state import names
from app.state.keep import Keep
from app.state.names import NAMES, ROWS

TABLE, OLDER = APP / "state" / "names.py", APP / "state" / "older.py"
EVERY = sorted({*NAMES, names.VOTE, names.VERSION_NAME})
SOURCES = [path for path in sources("*.py", "*.js", "*.html", "*.toml") if path not in (TABLE, OLDER)]
IN_A_LINK = re.compile(rf"[?&]({'|'.join(EVERY)})=")
READ = re.compile(r"URLSearchParams|searchParams")
BEFORE = ("early.js", "first.js")  # what the browser shows before it reaches Python, in the language of the address


def test_a_name_is_given_once():
    assert len(ROWS) == len(NAMES)
    assert len({(name.owner, name.parameter) for name in ROWS}) == len(ROWS)
    assert not {names.VOTE, names.VERSION_NAME} & NAMES.keys()
    assert {names.TAB, names.LANGUAGE, names.SECRET} < NAMES.keys()


def test_what_the_table_does_not_have_is_not_kept():
    class Other(param.Parameterized):
        a = param.Number(default=1.0)

    with pytest.raises(LookupError, match="Other"):
        Keep().add(Other())


def test_a_name_that_is_taken_is_not_given_again():
    keep = Keep()
    keep.add(Explorer())
    with pytest.raises(LookupError, match=r"taken: body, a, .*KJ"):
        keep.add(Explorer())


def test_a_link_that_is_given_away_has_only_names_of_the_table():
    assert names.link(tab="learn", vote="A B") == "?tab=learn&vote=A%20B"
    with pytest.raises(LookupError, match="stpe"):
        names.link(tab="learn", stpe="lift")


def other_places(path):
    """Where a file has a row, looks up a name in an address as a literal, or puts a link together by hand."""
    if path.name != "keep.py":  # its docstring contains an address
        yield from IN_A_LINK.findall(text(path))
    if READ.search(text(path)):
        yield from [] if path.name in BEFORE else ["reads an address"]
        yield from {*re.findall(r"""["'](\w+)["']""", text(path))} & {*EVERY} - {names.LANGUAGE}
    if path.suffix == ".py":
        yield from second_places(tree(path))


def test_there_is_no_second_place():
    assert len(SOURCES) > 300 and wrong_in(SOURCES, lambda path: [*other_places(path)]) == {}


def second_places(tree):
    """The lines of the rows, and of names that are looked up as literals in texts."""
    for node in ast.walk(tree):
        match node:
            case ast.Call(func=ast.Name(id="Name") | ast.Attribute(attr="Name")):
                yield node.lineno
            case ast.Call(func=ast.Attribute(attr="get" | "pop"), args=[ast.Constant(value=str(key)), *_]) if (
                key in EVERY and asks_texts(node.func.value)
            ):
                yield node.lineno
            case ast.Subscript(value=found, slice=ast.Constant(value=str(key))) if key in EVERY and asks_texts(found):
                yield node.lineno
            case ast.Compare(left=ast.Constant(value=str(key)), ops=[ast.In() | ast.NotIn()], comparators=[found]) if (
                key in EVERY and asks_texts(found)
            ):
                yield node.lineno


def asks_texts(node):
    """Whether a name is the result of read(), or the arguments of a request."""
    return re.search(r"\btexts\b|\bread\(|query_arguments", ast.unparse(node)) is not None


@pytest.mark.parametrize("second", [
    'Name("x", "Lab", "x", Number)', 'texts.get("tab")', 'read(search)[0].get("lang")', 'texts["vote"]', '"v" in texts',
    'self.request.query_arguments.get("lang", [b""])'])  # fmt: skip
def test_a_second_place_is_found(second):
    assert [*second_places(ast.parse(second))] == [1]
