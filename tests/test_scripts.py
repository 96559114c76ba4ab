"""The private parts of Bokeh, Panel and three.js that the scripts use: all are in one module, and still exist."""

import ast
import re
from pathlib import Path

import bokeh.server
import pytest

import app.page.page  # noqa: F401  all components
from app.bundle import Bundled, inlined

FRONTEND = Path(__file__).parent.parent / "app/frontend"
BORROWED = FRONTEND / "src/borrowed.js"
BOKEH = Path(bokeh.server.__file__).parent / "static/js/bokeh.js"
PYTHON = [path for path in FRONTEND.parent.rglob("*.py") if "node_modules" not in path.parts]
PAGES = [path for path in FRONTEND.parent.rglob("*.html") if "node_modules" not in path.parts]
INLINED = [path for path in FRONTEND.parent.rglob("*.js") if not {"frontend", "static"} & {*path.parts}
           and path.name not in ("call.js", "ticks.js")]  # fmt: skip
OTHERS = [path for path in FRONTEND.glob("src/**/*.js") if path != BORROWED]

# {our name: the part of Bokeh that it uses, as in Bokeh's own script}
USED = {
    "viewOf": ["find_one("],
    "scalesOf": ["get frame()", "x_scale", "y_scale"],
    "eventsOf": ["this.events_el =", "canvas_view"],
    "pressNever": ["this.ui_event_bus =", "this.ui_gestures =", "press_threshold = "],
}


@pytest.mark.parametrize("ours", USED)
def test_what_is_borrowed_of_bokeh_is_still_there(ours):
    assert re.search(rf"\b{ours}\b", BORROWED.read_text(encoding="utf-8"))
    script = BOKEH.read_text(encoding="utf-8")
    assert [name for name in USED[ours] if name not in script] == []


def test_what_is_borrowed_of_three_is_still_there():
    three = FRONTEND / "node_modules/three/build"
    if not three.is_dir():
        pytest.skip("three.js is only where the bundle was built")
    script = "".join(path.read_text(encoding="utf-8") for path in three.glob("three.module*.js"))
    for name in ("isXRRenderTarget", "__webglFramebuffer"):
        assert name in BORROWED.read_text(encoding="utf-8") and name in script


@pytest.mark.parametrize("path", OTHERS, ids=lambda path: path.name)
def test_no_other_script_borrows(path):
    """A name that begins with _ is private to its library; our own for tests is __tippe."""
    private = {*re.findall(r"\.(_\w+)", path.read_text(encoding="utf-8"))} - {"__tippe"}
    assert private == set()
    assert not re.search(r"canvas_view|find_one|tool_views|ui_event_bus", path.read_text(encoding="utf-8"))


@pytest.mark.parametrize("path", PYTHON, ids=lambda path: path.name)
def test_no_javascript_stands_in_python(path):
    strings = [node.value for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
               if isinstance(node, ast.Constant) and isinstance(node.value, str)]  # fmt: skip
    found = [
        text
        for text in strings
        if re.search(r"=> ?\{|\b(const|let) [\w{\[]+.* = |addEventListener|document\.\w+\(", text)
    ]
    assert found == []


@pytest.mark.parametrize("path", PAGES, ids=lambda path: path.name)
def test_no_javascript_stands_in_html(path):
    """Scripts in a page are files, which tsc and ESLint check, or data."""
    text = path.read_text(encoding="utf-8")
    scripts = re.findall(r"<script([^>]*)>(.*?)</script>", text, re.DOTALL)
    assert [inside for _, inside in scripts if not re.fullmatch(r"\$\w+|\{\{ \w+ \}\}", inside)] == []
    assert not re.search(r"""\son\w+=|javascript:""", text)


@pytest.mark.parametrize("path", INLINED, ids=lambda path: path.name)
def test_a_script_that_stands_in_a_page_ends_where_it_ends(path):
    assert not re.search(r"</script|<!--", path.read_text(encoding="utf-8"), re.I)
    assert inlined(path).startswith("{\n") and inlined(path).endswith("\n}")


@pytest.mark.parametrize("kind", Bundled.__subclasses__(), ids=lambda kind: kind.__name__)
def test_no_component_hides_what_all_have(kind):
    assert "is_new" not in vars(kind) and isinstance(vars(kind).get("says", classmethod(len)), classmethod)


# ---- what the scripts tell one another ----

SAID = re.compile(r"""dispatchEvent\(new CustomEvent\(["'`](tippe:[a-z]+)""")
HEARD = re.compile(r"""\baddEventListener\(["'`](tippe:[a-z]+)""")
HOUSE = FRONTEND.parent.parent / "docs/house.md"


def told(pattern):
    """{event: the files that send it, or listen to it}"""
    found = {}
    for path in (*FRONTEND.glob("src/**/*.js"), *FRONTEND.parent.glob("*.js"), *FRONTEND.parent.glob("*.html")):
        inside = path.is_relative_to(FRONTEND)
        name = path.relative_to(FRONTEND / "src" if inside else FRONTEND.parent.parent).as_posix()
        for event in pattern.findall(path.read_text(encoding="utf-8")):
            found.setdefault(event, set()).add(name)
    return found


def test_the_list_of_events_is_whole():
    """docs/house.md lists every event of the window, who sends it and who listens."""
    rows = re.findall(r"^\| `(tippe:[a-z]+)` \|([^|]*)\|([^|]*)\| (.*) \|$", HOUSE.read_text(encoding="utf-8"), re.M)
    named = re.compile("`([^`]+)`")
    assert {event: {*named.findall(sent)} for event, sent, _, _ in rows} == told(SAID)
    assert {event: {*named.findall(heard)} for event, _, heard, _ in rows} == told(HEARD)
    assert all(carries for *_, carries in rows)


@pytest.mark.parametrize("path", OTHERS, ids=lambda path: path.name)
def test_no_script_asks_another_by_the_window(path):
    """Modules import each other. The window holds only reports for tests, and the functions that Bokeh's callbacks
    call."""
    text = path.read_text(encoding="utf-8")
    assert {*re.findall(r"\bwindow\.(\w*tippe\w*)", text)} <= {"__tippe", "tippeCallbacks"}
    assert not re.search(r"\bwindow\[|\bglobalThis\b", text)
    if "__tippe" in text:  # which is set there, and never read
        assert not re.search(r"__tippe\.\w+\(", text)
