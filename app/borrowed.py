"""The parts of Panel and Bokeh that are not ours to use, and are used all the same: each once, and all here.

A newer version may change any of them without a word. tests/test_borrowed.py fails where one has changed, and where
another stands anywhere else in the page. The issues named are the libraries' own.
"""

import inspect
from collections import deque
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager
from functools import cache, partial, wraps
from weakref import WeakKeyDictionary

import panel.custom
import panel.io.document
import panel.layout.base
import panel.layout.grid
import panel.reactive
import panel_material_ui as pmui
import param
from bokeh.core.serialization import Serializer
from bokeh.document.models import DocumentModelManager
from bokeh.model import Model
from bokeh.protocol.messages.patch_doc import patch_doc
from bokeh.server.connection import ServerConnection
from bokeh.server.session import ServerSession
from bokeh.server.tornado import BokehTornado
from panel.io.resources import LOCAL_DIST

FREEZES = (panel.custom, panel.layout.base, panel.layout.grid)  # the modules that have Panel's freeze_doc
MADE = WeakKeyDictionary()  # of an event, the message that begins with it
WAITING = WeakKeyDictionary()  # of a connection, the messages that are made and not out


# --- of a server, whichever starts it


class Here(ThreadPoolExecutor):
    """Does what it is given at once, in the thread that gives it."""

    def submit(self, function, /, *arguments, **named):
        future = Future()
        try:
            future.set_result(function(*arguments, **named))
        except BaseException as error:
            future.set_exception(error)
        return future


def in_one_thread(loop, context):
    """1. Keeps what sessions do in the server's own thread. loop: asyncio's; context: Bokeh's ApplicationContext.

    From 3.10 on Bokeh gives it to the event loop's executor, and what is sent to one of its own, which is private. That
    is no faster, for one thread at a time has the interpreter (a move costs an eighth more of the processor). But Panel
    answers some messages of a page, such as a dragged slider's, in the event loop without the document's lock: beside a
    thread, two of them would change one session at a time. What takes long is given to app.model.runs.
    https://github.com/bokeh/bokeh/pull/15239, https://github.com/holoviz/panel/pull/8675
    """
    here = Here(1)
    loop.set_default_executor(here)
    executor = getattr(context, "_executor", None)  # Bokeh 3.9 has none
    if executor is not None:
        executor._executor = here


def thawed(freeze):
    """2. Bokeh's and Panel's methods that keep a document's list of models while they change, until they have changed:
    where that fails it would be kept for good, and nothing new would reach the page.

    Neither has a word on it; that there is such a thing: https://github.com/bokeh/bokeh/issues/14962
    """

    @contextmanager
    def frozen(of, *arguments, **named):
        models = getattr(of, "models", of)
        before = getattr(models, "_freeze_count", 0)
        try:
            with freeze(of, *arguments, **named):
                yield
        finally:
            while getattr(models, "_freeze_count", 0) > before:
                models._pop_freeze()

    return frozen


def to_the_last(dispatch):
    """3. Panel's function that writes what waits for a document's page. The first of two that were begun ends their
    common mark, and the second then took it that there is nothing: what it had lay there until something else was sent.

    It was made for https://github.com/holoviz/panel/pull/6667; on what it loses there is no issue that we found.
    """
    module = panel.io.document
    waiting = module._WRITE_EVENTS if hasattr(module, "_WRITE_EVENTS") else module._WRITE_MSGS  # Panel 1.10, 1.9

    async def dispatched(document):
        if document in waiting:
            module._WRITE_BLOCK[document] = True
        await dispatch(document)

    return dispatched


def put(connection, events):
    """One message of these, behind what the connection has waiting. A second connection of the session, as a page has
    that comes back, gets the same one: another would only tell the name of what the first one brings."""
    first = events[0]
    if first not in MADE:
        MADE[first] = message_of(events)
    WAITING.setdefault(connection, deque()).append(MADE[first])


class Known(Serializer):
    """9. Names a model that the page has: Bokeh's own lists the names of all of them first, for each message, which was
    half of what it cost. models: of the document. No issue that we found."""

    def __init__(self, models):
        super().__init__()
        self._models = models

    def get_ref(self, thing):
        known = isinstance(thing, Model) and self._models.get_by_id(thing.id) is thing
        return thing.ref if known and thing not in self._models._new_models else super().get_ref(thing)


def message_of(events):
    """Bokeh's PATCH-DOC of these events of one document."""
    models = events[0].document.models
    serializer = Known(models)
    message = patch_doc(patch_doc.create_header(), {}, {"events": serializer.encode(events)})
    models.flush_synced(lambda model: not serializer.has_ref(model))
    message.add_buffers(*serializer.buffers)
    return message


async def send(connection):
    """What the connection has waiting goes out."""
    waiting = WAITING[connection]
    while waiting:
        await connection._socket.send_message(waiting.popleft())


def send_one(connection, event):
    """What Bokeh 3.9 does for each change; awaited when its lock opens."""
    put(connection, [event])
    return send(connection)


def send_all(document, connections, events):
    """What Panel 1.9 does for what it held back."""
    for connection in connections:
        put(connection, events)
        panel.io.document._dispatch_write_task(document, send, connection)


def in_order():
    """3, for Panel 1.9 and Bokeh 3.9: messages go out in the order in which they were made. Both wrote on their own, so
    that one which names a figure overtook the one that brings it, and the browser knew of no such figure. The newer
    ones make a message only when they write it. https://github.com/holoviz/panel/pull/6028"""
    ServerConnection.send_patch_document = send_one
    panel.io.document.write_events = panel.io.document.schedule_write_events = send_all


def behind(write):
    """3, for Panel 1.10 and Bokeh 3.10. write: Bokeh's method that writes the changes of a session when its lock opens:
    behind what Panel held back for the same page, which waits for a free socket, and may bring what they name."""

    async def written(session, changes):
        for connections, events in panel.io.document._WRITE_EVENTS.pop(session.document, []):
            message = connections[0].protocol.create("PATCH-DOC", events)
            for connection in connections:
                await connection.send_message(message)
        await write(session, changes)

    return written


def lost_at_once(connect):
    """10. Bokeh's method that connects a page to its session. From 3.10 on the page may have gone by then: nobody was
    told of it, and the session was kept for good. No issue that we found."""

    def connected(server, protocol, socket, context, session):
        connection = connect(server, protocol, socket, context, session)
        if socket.ws_connection is None:
            server.client_lost(connection)
        return connection

    return connected


@cache
def mend():
    """2, 3, 10, and 4: where Panel takes its style sheets from for a part that never came into a document, because its
    view failed. It would ask another machine; and all parts share their sheets, so the page would lose them.
    https://github.com/holoviz/panel/issues/7073, https://github.com/holoviz/panel/pull/8408"""
    DocumentModelManager.freeze = thawed(DocumentModelManager.freeze)
    for module in FREEZES:
        module.freeze_doc = thawed(module.freeze_doc)
    panel.io.document._dispatch_msgs = to_the_last(panel.io.document._dispatch_msgs)
    if hasattr(panel.io.document, "_WRITE_MSGS"):  # Panel 1.9
        in_order()
    else:
        ServerSession._send_pending_patches = behind(ServerSession._send_pending_patches)
    BokehTornado.new_connection = lost_at_once(BokehTornado.new_connection)
    panel.reactive.CDN_DIST = LOCAL_DIST


# --- of `python -m app`


def counted(wrap, budget):
    """5. Bokeh's method that readies what a session is to do later, at the next tick or after some time: with what that
    costs put on the session's budget, whether it waits for the document's lock or, as Panel's own answers, does not.
    budget: function of the session. No issue that we found."""

    def counting(session, act):
        @wraps(act)
        def work(*arguments, **named):
            mine = budget(session)
            with mine.work():
                result = act(*arguments, **named)
            return mine.steps(result) if inspect.iscoroutine(result) else result

        return work

    def wrap_and_count(session, callback):
        # Bokeh 3.10 calls it in a task of its own, whose steps are not among those of what is ready.
        return counting(session, wrap(session, counting(session, callback)))

    return wrap_and_count


def count(budget):
    """From now on what sessions do later is counted."""
    ServerSession._wrap_document_callback = counted(ServerSession._wrap_document_callback, budget)


# --- of components


def at_once(component, *properties):
    """6. Lets these properties of a Panel component arrive without Panel's wait of 50 ms, without its busy signal,
    which costs as much as the rest of a small answer, and without making every parameter of the component writable
    first, which was a fifteenth of a move. No issue that we found."""
    component._priority_changes = component._busy__ignore = list(properties)
    component._process_events = partial(_take, component, component._process_events, {*properties})


def _take(component, process, properties, changes):
    """What a page has changed of a component; process: Panel's own way, for what is not among the properties."""
    document = panel.state.curdoc
    if not changes or document is None or not changes.keys() <= properties:
        process(changes)
        return
    component._in_process__events[document] = changes  # so that the page is not told what it has said
    try:
        component.param.update(**changes)
    finally:
        component._in_process__events.pop(document, None)


def address_of(component):
    """7. Where the page that is being made finds the JavaScript of a component that came in a bundle (so since
    https://github.com/holoviz/panel/pull/7410), so that the browser may fetch it before Panel says so."""
    return component._render_esm(True, server=True)


class WholeFile(pmui.FileInput):
    """8. Takes a file in one piece, and counts those that were refused because they are too large: the base class has
    no word for them, and puts together as many pieces as are sent, of any size.
    https://github.com/panel-extensions/panel-material-ui/issues/282, https://github.com/holoviz/panel/issues/541"""

    LARGEST = 0  # bytes
    refused = param.Integer(default=0)
    _sent = None  # until the browser says that this is all

    def _handle_msg(self, msg):
        status = msg["status"]
        if status == "upload_event":
            self._sent = msg
        elif status == "finished" and self._sent:
            sent, self._sent = self._sent, None
            if isinstance(sent["data"], bytes | memoryview) and len(sent["data"]) <= self.LARGEST:
                self.param.update(value=bytes(sent["data"]), filename=sent["name"], mime_type=sent["mime_type"])
            else:
                self.refused += 1
            self._send_msg({"status": "finished"})
        elif status == "error":
            self.refused += 1
