"""Each click in a figure counts. Bokeh calls the second of two quick ones a doubletap, and not a tap as well."""

import ast

from bokeh.models import CustomJS
from text_files import APP, sources, tree, wrong_in

from app.widgets.plots import on_pointer, plain

LISTENS = "widgets/plots.py"  # where a figure is made to listen to clicks
NAMES = "frontend/src/figures/seeking.js"  # where gestures are named


def test_no_figure_listens_to_the_first_of_two_clicks_alone():
    allowed = APP / LISTENS, APP / "server" / "messages.py"  # the latter: what a browser may send
    others = [path for path in sources("*.py") if path not in allowed]
    assert wrong_in(others, lambda path: [node.lineno for node in ast.walk(tree(path))
                                          if isinstance(node, ast.Constant) and node.value == "tap"]) == {}  # fmt: skip


def test_the_browser_takes_the_second_click_for_a_click():
    scripts = [path for path in (APP / "frontend" / "src").rglob("*.js") if "event_name" in path.read_text("utf-8")]
    assert scripts == [APP / NAMES]


def test_a_figure_hears_both_clicks_in_the_browser():
    fig, act = plain(), CustomJS(code="")
    on_pointer(fig, act, "mousemove")
    names = ("tap", "doubletap", "panstart", "pan", "panend", "mousemove")
    assert fig.js_event_callbacks == {name: [act] for name in names}
