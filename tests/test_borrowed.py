"""Private parts of Panel and Bokeh: each still exists and behaves as we need, each patch has its effect, and no
other module of the page uses private parts."""

import ast
import asyncio
import inspect
import json
import sys
import threading
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from types import SimpleNamespace
from unittest.mock import Mock

import panel as pn
import panel.io.document
import panel.reactive
import param
import pytest
from bokeh.core.serialization import Serializer, UnknownReferenceError
from bokeh.document import Document
from bokeh.document.events import ModelChangedEvent
from bokeh.document.models import DocumentModelManager
from bokeh.models import ColumnDataSource, Div, ImportedStyleSheet, Row
from bokeh.protocol import Protocol
from bokeh.server.connection import ServerConnection
from bokeh.server.contexts import ApplicationContext
from bokeh.server.session import ServerSession
from bokeh.server.tornado import BokehTornado
from panel.custom import JSComponent
from panel.io.resources import CDN_DIST, LOCAL_DIST
from panel.io.state import set_curdoc
from tornado.httpserver import HTTPServer
from tornado.ioloop import IOLoop
from tornado.locks import Lock
from tornado.netutil import bind_sockets
from tornado.web import Application
from tornado.websocket import WebSocketHandler, WebSocketProtocol13, websocket_connect

from app import borrowed
from app.bundle import BUNDLE, Bundled

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
    assert foreign(Path(borrowed.__file__)) >= {"_executor", "_freeze_count", "_pop_freeze", "_dispatch_msgs",
        "_WRITE_BLOCK", "_wrap_document_callback", "_priority_changes", "_busy__ignore", "_render_esm"}  # fmt: skip


# --- of a server


def run(coroutine):
    """What a coroutine returns. Playwright leaves a loop running in the thread of the tests, so it has another."""
    with ThreadPoolExecutor(1) as thread:
        return thread.submit(asyncio.run, coroutine).result()


def test_a_session_works_in_the_servers_own_thread():
    """1. What is passed to an executor is done when the call returns; Bokeh's own executor, if it has one, is
    unchanged."""
    where = []

    async def work():
        loop = asyncio.get_running_loop()
        application = BokehTornado({"/app": lambda document: None}).applications["/app"]
        borrowed.in_one_thread(loop, application)
        await loop.run_in_executor(None, lambda: where.append(threading.get_ident()))
        if hasattr(application, "_executor"):
            await application._executor.run(lambda: where.append(threading.get_ident()))
        with pytest.raises(ZeroDivisionError):
            await loop.run_in_executor(None, lambda: 1 / 0)
        return threading.get_ident()

    [mine] = {run(work())}
    assert where and set(where) == {mine}
    has = "executor" in inspect.signature(ApplicationContext).parameters
    assert has == hasattr(ApplicationContext(SimpleNamespace()), "_executor")


def test_a_list_of_models_is_kept_no_longer_than_the_change_that_failed():
    """2."""
    document = Document()
    for freeze, of in ((DocumentModelManager.freeze, document.models), (panel.io.document.freeze_doc, document)):
        named = {} if of is document.models else {"model": Div(), "properties": {}, "force": True}
        with pytest.raises(ZeroDivisionError), borrowed.thawed(freeze)(of, **named):
            assert document.models._freeze_count == 1
            1 / 0  # noqa: B018
        assert document.models._freeze_count == 0
    for module in borrowed.FREEZES:
        assert list(inspect.signature(module.freeze_doc).parameters)[:1] in (["doc"], ["of"])


class Socket:
    """The browser's end of a page, which is slow."""

    def __init__(self):
        self.write_lock, self.ws_connection, self.written = Lock(), Mock(is_closing=lambda: False), []

    async def send_message(self, message):
        async with self.write_lock:
            await asyncio.sleep(0)
            self.written.append(message.content_json)

    def send(self, text_data):
        if '"events"' in text_data:
            self.written.append(text_data)
        return asyncio.sleep(0)


async def show_and_fill():
    """Panel adds a figure while something else is being written, and Bokeh fills it under its lock."""
    document, row, source = Document(), Row(), ColumnDataSource({"x": [0]})
    document.add_root(row)
    session, socket = ServerSession("mine", document, io_loop=IOLoop.current()), Socket()
    connection = ServerConnection(Protocol(), socket, None, session)
    with set_curdoc(document):
        panel.state._loaded[document] = True
        async with socket.write_lock:
            document.hold("combine")
            row.children = [Div(name="figure", tags=[source])]
            events, document.callbacks._held_events = document.callbacks._held_events, []
            document.unhold()
            panel.io.document.schedule_write_events(document, [connection], events)
            await asyncio.sleep(0)
        await session.with_document_locked(source.update, data={"x": [1.5]})
        await asyncio.sleep(0.1)
    session.destroy()
    return [("figure" in text, "1.5" in text) for text in socket.written]


def test_what_fills_a_figure_comes_behind_the_figure(monkeypatch):
    """3."""
    if hasattr(panel.io.document, "_WRITE_MSGS"):
        monkeypatch.setattr(ServerConnection, "send_patch_document", ServerConnection.send_patch_document)
        for name in ("write_events", "schedule_write_events"):
            monkeypatch.setattr(panel.io.document, name, getattr(panel.io.document, name))
        borrowed.in_order()
    else:
        monkeypatch.setattr(
            ServerSession, "_send_pending_patches", borrowed.behind(ServerSession._send_pending_patches)
        )
    (brought, _), filled = run(show_and_fill())  # a message that is made later contains the later number
    assert brought and filled == (False, True)


def test_each_connection_of_a_session_is_brought_what_is_new():
    """3. With Bokeh's own messages, one for each connection, only the first one gets them."""

    class Connection:
        protocol = Protocol()

    document, row = Document(), Row()
    document.add_root(row)
    row.children = [Div(text="new")]
    event, both = ModelChangedEvent(document, row, "children", row.children), (Connection(), Connection())
    for connection in both:
        borrowed.put(connection, [event])
    assert all("new" in borrowed.WAITING[connection][0].content_json for connection in both)


def test_a_message_says_what_bokehs_own_would_and_a_new_model_once():
    """9."""
    document, known, new = Document(), Div(text="known"), Row(Div(text="fresh"))
    page = Row(known)
    document.add_root(page)
    document.models.flush_synced()
    page.children.append(new)

    def event(value):
        return ModelChangedEvent(document, page, "children", value)

    said = []
    for value in (list(page.children), list(page.children), [page, None, {"a": float("nan")}, known]):
        own = Serializer(references=document.models.synced_references)
        expected = own.encode([event(value)])
        message = borrowed.message_of([event(value)])
        assert json.dumps(message.content["events"]) == json.dumps(expected)
        said.append(message.content_json)
    assert ["fresh" in each for each in said] == [True, False, False]
    assert not document.models.synced_references ^ {*document.models}


@pytest.mark.parametrize("act", [Document.apply_json_patch, borrowed.apply])
def test_a_message_of_a_page_does_what_bokeh_does_with_it(act):
    """9. With a new model, one that is still to be sent, one that has been removed, and one that never existed."""
    document, known, gone = Document(), Div(text="before"), Div()
    page, other = Row(known, gone), Row()
    for root in (page, other):
        document.add_root(root)
    document.models.flush_synced()
    other.children.append(Div(name="unsent"))
    brought = {"type": "object", "name": "Div", "id": "mine", "attributes": {"text": "brought"}}
    act(document, {"events": [
        {"kind": "ModelChanged", "model": known.ref, "attr": "text", "new": "after"},
        {"kind": "ModelChanged", "model": page.ref, "attr": "children", "new": [known.ref, brought]}]})  # fmt: skip
    assert known.text == "after" and page.children == [known, document.get_model_by_id("mine")]
    assert page.children[1].text == "brought"
    new = {*document.models} - document.models.synced_references
    assert {each.name for each in new} == ({"unsent"} if act is borrowed.apply else set())  # not yet on the page
    act(document, {"events": [{"kind": "ModelChanged", "model": gone.ref, "attr": "text", "new": "late"}]})
    assert gone.text == ""
    with pytest.raises(UnknownReferenceError):
        act(document, {"events": [{"kind": "ModelChanged", "model": {"id": "no"}, "attr": "text", "new": ""}]})


def test_what_writes_to_a_page_waits_under_these_names():
    """3. Its effect is tested in test_server.py."""
    module = panel.io.document
    assert list(inspect.signature(inspect.unwrap(module._dispatch_msgs)).parameters) in (["doc"], ["document"])
    source = inspect.getsource(module)  # not of its function, which another test may have replaced
    assert "_WRITE_BLOCK[doc] = True" in source and "_dispatch_msgs" in source
    assert "_WRITE_EVENTS" in source or "_WRITE_MSGS" in source


class Clients(BokehTornado):
    """What a Bokeh server stores about its connections."""

    def __init__(self):
        self._clients = set()

    def _require_running(self):
        pass


@pytest.mark.parametrize("here", [True, False])
def test_who_left_before_he_was_connected_leaves_no_connection(here):
    """10."""
    server, socket, session = Clients(), Socket(), ServerSession("mine", Document(), io_loop=IOLoop())
    if not here:
        socket.ws_connection = None
    connect = borrowed.lost_at_once(BokehTornado.new_connection)
    connection = connect(server, Protocol(), socket, None, session)
    assert connection.protocol
    assert (session.connection_count, len(server._clients)) == (here, here)
    session.destroy()


def sheets():
    """The addresses of the style sheets of a part whose document belongs to no server."""
    with set_curdoc(Document()):
        found = pn.widgets.Button().get_root().stylesheets
    return [sheet.url for sheet in found if isinstance(sheet, ImportedStyleSheet)]


def test_style_sheets_of_a_part_without_a_document_stay_here(monkeypatch):
    """4."""
    monkeypatch.setattr(panel.reactive, "CDN_DIST", CDN_DIST)
    assert any(url.startswith(CDN_DIST) for url in sheets())  # otherwise this patch is no longer needed
    monkeypatch.setattr(panel.reactive, "CDN_DIST", LOCAL_DIST)
    assert sheets() and all(url.startswith(LOCAL_DIST) for url in sheets())


def test_what_a_session_does_later_goes_through_the_method_that_is_counted(monkeypatch):
    """5. What it counts is tested in test_budget.py."""
    assert list(inspect.signature(ServerSession._wrap_document_callback).parameters)[:2] in (
        ["self", "callback"], ["session", "callback"])  # fmt: skip
    seen = []
    monkeypatch.setattr(ServerSession, "_wrap_document_callback", lambda _, act: seen.append(act) or act)

    async def later():
        document = Document()
        document.add_next_tick_callback(list)
        session = ServerSession("mine", document, io_loop=IOLoop.current())
        document.add_timeout_callback(list, 1)
        session.destroy()

    run(later())
    assert len(seen) == 2


# --- of components


class Asked(JSComponent):
    asked = param.Integer(default=0)
    _esm = "export function render() {}"


def test_each_frame_of_a_websocket_is_followed_by_its_pace(monkeypatch):
    """11. A ping, and a message in three frames of which two are empty."""
    paces = []
    monkeypatch.setattr(WebSocketProtocol13, "_receive_frame", WebSocketProtocol13._receive_frame)
    WebSocketProtocol13._receive_frame = borrowed.paced(WebSocketProtocol13._receive_frame)

    class Handler(WebSocketHandler):
        async def pace(self):
            paces.append(len(paces))

        def on_message(self, message):
            self.write_message(message)

    async def send():
        server = HTTPServer(Application([("/", Handler)]))
        [listening] = bind_sockets(0, "127.0.0.1")
        server.add_socket(listening)
        client = await websocket_connect(f"ws://127.0.0.1:{listening.getsockname()[1]}/")
        for first, mask_and_length, rest in (
            (0x89, 0x80, b""),
            (0x01, 0x81, b"x"),
            (0x00, 0x80, b""),
            (0x80, 0x80, b""),
        ):
            await client.protocol.stream.write(bytes([first, mask_and_length, 0, 0, 0, 0]) + rest)
        said = await client.read_message()
        server.stop()
        return said

    assert run(send()) == "x"
    assert len(paces) == 4


def test_a_property_arrives_without_waiting(monkeypatch):
    """6. When Panel receives a change from a page: at once, without a busy signal; otherwise 50 ms later."""
    waits, busy = [], []
    monkeypatch.setattr(pn.state, "execute", lambda act, schedule=None: waits.append(0))
    monkeypatch.setattr(type(pn.state), "_add_busy_event", lambda state, name: busy.append(name))
    for prompt in (False, True):
        with set_curdoc(Document()):
            component = Asked()
        if prompt:
            borrowed.at_once(component, "asked")
        document = Mock(session_context=True, add_timeout_callback=lambda act, wait: waits.append(wait))
        component._server_change(document, "p1", None, "asked", 0, 1)
        component._process_events({"asked": 2})
        assert component.asked == 2
    assert waits == [50, 0] and len(busy) == 1


class Direct(borrowed.Direct):
    asked = param.Integer(default=0)
    told = param.List(default=[])
    _esm = "export function render() {}"


class Slow(JSComponent):
    asked = param.Integer(default=0)
    told = param.List(default=[])
    _esm = "export function render() {}"


def sent_of(kind, monkeypatch):
    """The messages held for the page, and its state, after some properties were set by Python and others by the
    page."""
    document = Document()
    monkeypatch.setattr(pn.state, "_unblocked", lambda document: True)
    monkeypatch.setattr(type(pn.state), "_thread_id", threading.get_ident())
    with set_curdoc(document):
        component = kind()
        document.add_root(component.get_root(document))
        monkeypatch.setattr(Document, "session_context", Mock())
        panel.state._loaded[document] = True
        document.hold("combine")
        component.param.update(told=[1], asked=1)
        component._in_process__events[document] = {"asked": 3}
        component.param.update(told=[2], asked=3)
        component.asked = 4
        component.visible = False
        found = {event.attr: event.new for event in document.callbacks._held_events}
        [(model, _)] = component._models.values()
        return found, model.data.told, model.data.asked, model.visible, component._changing, component._events


def test_what_is_set_goes_out_as_panel_would_send_it(monkeypatch):
    """6. But not back to the page that set it."""
    assert borrowed.Direct in Bundled.__mro__ and Direct.own() == {"asked", "told"}
    mine, theirs = sent_of(Direct, monkeypatch), sent_of(Slow, monkeypatch)
    assert mine == theirs == ({"told": [2], "asked": 4, "visible": False}, [2], 4, False, {}, {})


def test_a_bundle_is_where_panel_says():
    """7."""
    assert borrowed.address_of(Bundled) == f"./components/app.bundle/Bundled/_bundle_path/static/{BUNDLE.name}"
