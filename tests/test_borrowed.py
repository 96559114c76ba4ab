"""Private parts of Panel and Bokeh: each still exists and behaves as we need, each patch has its effect, and no
other module of the page uses private parts."""

import ast
import asyncio
import inspect
import json
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from unittest.mock import Mock

import panel as pn
import panel.io.document
import panel.reactive
import param
import pytest
from bokeh.core.serialization import Buffer
from bokeh.document import Document
from bokeh.document.events import TitleChangedEvent
from bokeh.document.models import DocumentModelManager
from bokeh.models import Div, ImportedStyleSheet
from bokeh.protocol import Protocol
from bokeh.server.views.ws import WSHandler
from panel.custom import JSComponent
from panel.io.resources import CDN_DIST, LOCAL_DIST
from panel.io.state import set_curdoc
from tornado.locks import Lock
from tornado.websocket import WebSocketClosedError

from app import borrowed
from app.bundle import BUNDLE, Bundled, address_of

APP = Path(borrowed.__file__).parent
# Documented by Panel under these names: a component's JavaScript and style, and its messages.
DOCUMENTED = {"_esm", "_bundle", "_stylesheets", "_importmap"}


def foreign(path):
    """The private names of other modules that a file uses: x._name and getattr(x, "_name"), where x is not self, cls or
    a name of the file; and private names of its own classes that a library's base class has too."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    made = {
        node.name for node in ast.walk(tree) if isinstance(node, ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef)
    }
    made |= {target.id for node in ast.walk(tree) if isinstance(node, ast.Assign)
             for target in node.targets if isinstance(target, ast.Name)}  # fmt: skip
    made |= {node.attr for node in ast.walk(tree) if isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store)
             and isinstance(node.value, ast.Name) and node.value.id in ("self", "cls")}  # fmt: skip
    found = set()
    for node in ast.walk(tree):
        name = node.attr if isinstance(node, ast.Attribute) else None
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in ("getattr", "setattr"):
            name = getattr(node.args[1], "value", None)
        if isinstance(node, ast.ImportFrom) and not (node.module or "").startswith(("app", "tippe_core")):
            found |= {alias.name for alias in node.names if private(alias.name)}
        if isinstance(name, str) and private(name) and name not in made:
            found.add(name)
    return found


def private(name):
    return name.startswith("_") and not name.startswith("__")


def ours():
    """All imported modules of the page, by their files."""

    import app.__main__
    import app.app_hooks
    import app.server.server  # noqa: F401

    return {module.__file__: module for name, module in [*sys.modules.items()] if name.split(".")[0] == "app"}


@pytest.mark.parametrize("path", sorted(APP.rglob("*.py")), ids=lambda path: path.relative_to(APP).as_posix())
def test_no_other_module_borrows(path):
    if path == Path(borrowed.__file__):
        return
    assert foreign(path) - {"_exit", "_replace", "_fields"} == set()  # these belong to os, and to every namedtuple
    module = ours().get(str(path))
    for kind in vars(module).values() if module else ():
        if isinstance(kind, type) and kind.__module__ == module.__name__:
            theirs = {name for base in kind.__mro__ if not base.__module__.startswith(("app", "tippe_core"))
                      for name in vars(base) if private(name)}  # fmt: skip
            mine = {name for name in vars(kind) if private(name) and not name.startswith(("_param_", "_abc_"))}
            mine = {name for name in mine if f" {name}" in path.read_text(encoding="utf-8")}
            assert mine & theirs - DOCUMENTED == set(), kind


def test_the_test_finds_what_is_borrowed():
    found = foreign(Path(borrowed.__file__))
    assert found >= {"_freeze_count", "_pop_freeze", "_priority_changes", "_busy__ignore"}


# --- of a server


def run(coroutine):
    """What a coroutine returns. Playwright leaves a loop running in the thread of the tests, so it has another."""
    with ThreadPoolExecutor(1) as thread:
        return thread.submit(asyncio.run, coroutine).result()


def test_a_list_of_models_is_kept_no_longer_than_the_change_that_failed():
    """1."""
    document = Document()
    for freeze, of in ((DocumentModelManager.freeze, document.models), (panel.io.document.freeze_doc, document)):
        named = {} if of is document.models else {"model": Div(), "properties": {}, "force": True}
        with pytest.raises(ZeroDivisionError), borrowed.thawed(freeze)(of, **named):
            assert document.models._freeze_count == 1
            1 / 0  # noqa: B018
        assert document.models._freeze_count == 0
    for module in borrowed.FREEZES:
        assert list(inspect.signature(module.freeze_doc).parameters)[:1] in (["doc"], ["of"])


def closed(*given, **named):
    raise WebSocketClosedError


def test_a_message_is_written_at_once_and_keeps_nobody_waiting():
    """2. Even where somebody else has the lock, and also to a page that has closed."""
    written = []

    def write(piece, binary=False):
        written.append((piece, binary))
        return asyncio.sleep(0)

    async def send():
        socket = WSHandler.__new__(WSHandler)
        socket.write_lock, socket.ws_connection = Lock(), Mock(is_closing=lambda: False, write_message=write)
        message = Protocol().create("PATCH-DOC", [TitleChangedEvent(document, "new")])
        message.add_buffer(Buffer("b1", b"12"))
        async with socket.write_lock:
            sent = borrowed.send_message(socket, message)
            assert [binary for _, binary in written] == [False, False, False, False, True]
            await sent
        assert json.loads(written[0][0])["num_buffers"] == 1 and "new" in written[2][0]
        assert json.loads(written[3][0]) == {"id": "b1"} and written[4][0] == b"12"
        socket.ws_connection.write_message = closed
        await borrowed.send_message(socket, message)

    document = Document()
    run(send())


def sheets():
    """The addresses of the style sheets of a part whose document belongs to no server."""
    with set_curdoc(Document()):
        found = pn.widgets.Button().get_root().stylesheets
    return [sheet.url for sheet in found if isinstance(sheet, ImportedStyleSheet)]


def test_style_sheets_of_a_part_without_a_document_stay_here(monkeypatch):
    """3."""
    monkeypatch.setattr(panel.reactive, "CDN_DIST", CDN_DIST)
    assert any(url.startswith(CDN_DIST) for url in sheets())  # otherwise this patch is no longer needed
    monkeypatch.setattr(panel.reactive, "CDN_DIST", LOCAL_DIST)
    assert sheets() and all(url.startswith(LOCAL_DIST) for url in sheets())


# --- of components


class Requesting(JSComponent):
    request = param.Integer(default=0)
    _esm = "export function render() {}"


def test_a_property_arrives_without_waiting(monkeypatch):
    """4. When Panel receives a change from a page: at once, without a busy signal; otherwise 50 ms later."""
    waits, busy = [], []
    monkeypatch.setattr(pn.state, "execute", lambda act, schedule=None: waits.append(0))
    monkeypatch.setattr(type(pn.state), "_add_busy_event", lambda state, name: busy.append(name))
    for prompt in (False, True):
        with set_curdoc(Document()):
            component = Requesting()
        if prompt:
            borrowed.at_once(component, "request")
        document = Mock(session_context=True, add_timeout_callback=lambda act, wait: waits.append(wait))
        component._server_change(document, "p1", None, "request", 0, 1)
        component._process_events({"request": 2})
        assert component.request == 2
    assert waits == [50, 0] and len(busy) == 1


def test_a_bundle_is_where_panel_says():
    """The address of a component's JavaScript, so that the browser can request it before Panel says so."""
    assert address_of(Bundled, BUNDLE) == Bundled._render_esm(True, server=True).partition("?")[0]
