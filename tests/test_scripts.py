"""The private parts of Bokeh, Panel and three.js that the scripts use: all are in one module, and still exist."""

import ast
import re
from pathlib import Path

import bokeh.server
import pytest
from text_files import sources, text, tree, wrong_in

import app.page.page  # noqa: F401  all components
from app.bundle import Bundled, inlined

FRONTEND = Path(__file__).parent.parent / "app/frontend"
BORROWED = FRONTEND / "src/borrowed.js"
BOKEH = Path(bokeh.server.__file__).parent / "static/js/bokeh.js"
INLINED = [path for path in sources("*.js") if "frontend" not in path.parts
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


def test_the_shaders_of_three_name_what_the_stage_puts_into_them():
    three = FRONTEND / "node_modules/three/src/renderers/shaders/ShaderChunk"
    if not three.is_dir():
        pytest.skip("three.js is only where the bundle was built")
    stage = text(FRONTEND / "src/three/stage.js")
    assert 'ShaderChunk.colorspace_fragment = "gl_FragColor = sRGBTransferOETF(' in stage
    assert "gl_FragColor = linearToOutputTexel(" in text(three / "colorspace_fragment.glsl.js")
    assert "vec4 sRGBTransferOETF(" in text(three / "colorspace_pars_fragment.glsl.js")


def test_no_other_script_borrows():
    """A name that begins with _ is private to its library; our own for tests is __tippe."""
    private = r"\._(?!_tippe\b)\w+|canvas_view|find_one|tool_views|ui_event_bus"
    assert wrong_in(OTHERS, lambda path: re.findall(private, text(path))) == {}


def scripts_in(path):
    """The strings of a module that are JavaScript."""
    script = re.compile(r"=> ?\{|\b(const|let) [\w{\[]+.* = |addEventListener|document\.\w+\(")
    strings = (node.value for node in ast.walk(tree(path)) if isinstance(node, ast.Constant))
    return [each for each in strings if isinstance(each, str) and script.search(each)]


def test_no_javascript_stands_in_python():
    assert wrong_in(sources("*.py"), scripts_in) == {}


def scripts_of(path):
    """Those of a page that are no files, which tsc and ESLint check, and no data."""
    scripts = re.findall(r"<script[^>]*>(.*?)</script>", text(path), re.DOTALL)
    found = [inside for inside in scripts if not re.fullmatch(r"(\$\w+|\{\{ \w+ \}\})?", inside)]
    return found + re.findall(r"""\son\w+=|javascript:""", text(path))


def test_no_javascript_stands_in_html():
    assert wrong_in(sources("*.html"), scripts_of) == {}


def test_a_script_that_stands_in_a_page_ends_where_it_ends():
    assert wrong_in(INLINED, lambda path: re.findall(r"(?i)</script|<!--", text(path))) == {}
    assert len(INLINED) > 2 and all(re.fullmatch(r"\{\n.*\n\}", inlined(path), re.S) for path in INLINED)


def test_no_component_hides_what_all_have():
    for kind in Bundled.__subclasses__():
        assert "is_new" not in vars(kind) and isinstance(vars(kind).get("says", classmethod(len)), classmethod), kind


# ---- what the scripts tell one another ----

SAID = re.compile(r"""dispatchEvent\(new CustomEvent\(["'`](tippe:[a-z]+)""")
HEARD = re.compile(r"""\baddEventListener\(["'`](tippe:[a-z]+)""")
ARCHITECTURE = FRONTEND.parent.parent / "docs/architecture.md"


def told(pattern):
    """{event: the files that send it, or listen to it}"""
    found = {}
    app = FRONTEND.parent
    for path in (*FRONTEND.glob("src/**/*.js"), *app.glob("*.js"), *app.glob("widgets/*.js"), *app.glob("*.html")):
        inside = path.is_relative_to(FRONTEND)
        name = path.relative_to(FRONTEND / "src" if inside else FRONTEND.parent.parent).as_posix()
        for event in pattern.findall(path.read_text(encoding="utf-8")):
            found.setdefault(event, set()).add(name)
    return found


def test_the_list_of_events_is_whole():
    """docs/architecture.md lists every event of the window, who sends it and who listens."""
    rows = re.findall(
        r"^\| `(tippe:[a-z]+)` \|([^|]*)\|([^|]*)\| (.*) \|$", ARCHITECTURE.read_text(encoding="utf-8"), re.M
    )
    named = re.compile("`([^`]+)`")
    assert {event: {*named.findall(sent)} for event, sent, _, _ in rows} == told(SAID)
    assert {event: {*named.findall(heard)} for event, _, heard, _ in rows} == {
        event: files
        for event, files in told(HEARD).items()
        if event != "tippe:missing"  # sent by the page's first lines
    }
    assert all(carries for *_, carries in rows)


def asked_by_the_window(path):
    """What a script finds there but the functions that Bokeh's callbacks call, and reports for tests, never read."""
    window = r"\bwindow\.(?!__tippe\b|tippeCallbacks\b)\w*tippe\w*|\bwindow\[|\bglobalThis\b|__tippe\.\w+\("
    return re.findall(window, text(path))


def test_no_script_asks_another_by_the_window():
    """Modules import each other."""
    assert wrong_in(OTHERS, asked_by_the_window) == {}
