"""The private parts of Panel and Bokeh that are used nevertheless, each in one place, and all here.

A new version may change any of them without notice. tests/test_borrowed.py fails if one has changed, or if another is
used anywhere else in the page. The issues are those of the libraries.
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
from bokeh.core.serialization import Deserializer, Serializer, UnknownReferenceError
from bokeh.document import Document
from bokeh.document.events import DocumentPatchedEvent
from bokeh.document.models import DocumentModelManager
from bokeh.model import Model
from bokeh.protocol.messages.patch_doc import patch_doc
from bokeh.server.connection import ServerConnection
from bokeh.server.session import ServerSession
from bokeh.server.tornado import BokehTornado
from panel.custom import JSComponent
from panel.io.resources import LOCAL_DIST
from tornado.websocket import WebSocketProtocol13

from app.together import set_together

FREEZES = (panel.custom, panel.layout.base, panel.layout.grid)  # the modules that use Panel's freeze_doc
MADE = WeakKeyDictionary()  # event -> the message that begins with it
WAITING = WeakKeyDictionary()  # connection -> messages that were made and not yet sent


# --- for any server


class InThisThread(ThreadPoolExecutor):
    """An executor that runs a function at once, in the calling thread."""

    def submit(self, function, /, *arguments, **named):
        future = Future()
        try:
            future.set_result(function(*arguments, **named))
        except BaseException as error:
            future.set_exception(error)
        return future


def in_one_thread(loop, context):
    """1. Keeps the work of sessions in the server's own thread. loop: asyncio's; context: Bokeh's ApplicationContext.
    From 3.10 on Bokeh gives it to executors, which is not faster; and Panel answers some messages in the event loop
    without the document's lock: with a second thread, two of them would change one session at the same time.
    https://github.com/bokeh/bokeh/pull/15239, https://github.com/holoviz/panel/pull/8675"""
    here = InThisThread(1)
    loop.set_default_executor(here)
    executor = getattr(context, "_executor", None)  # Bokeh 3.9 has none
    if executor is not None:
        executor._executor = here


def thawed(freeze):
    """2. Bokeh's and Panel's methods that freeze a document's list of models while they change it: it would stay frozen
    if the change fails. We found no issue; on the mechanism: https://github.com/bokeh/bokeh/issues/14962"""

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
    """3. Panel's function that writes what waits for a document's page. If two writes had begun, the first to end
    removed the mark that they share, and the second then found nothing to write: its changes waited until something
    else was sent. It came with https://github.com/holoviz/panel/pull/6667; we found no issue about the loss."""
    module = panel.io.document
    waiting = module._WRITE_EVENTS if hasattr(module, "_WRITE_EVENTS") else module._WRITE_MSGS  # Panel 1.10, 1.9

    async def dispatched(document):
        if document in waiting:
            module._WRITE_BLOCK[document] = True
        await dispatch(document)

    return dispatched


def put(connection, events):
    """Makes one message of these events, the same for each connection of a session, and queues it there: another one
    would only refer by name to what the first one brings."""
    first = events[0]
    if first not in MADE:
        MADE[first] = message_of(events)
    WAITING.setdefault(connection, deque()).append(MADE[first])


class Known(Serializer):
    """9. Gives the names of models without listing all of a page, half of a message's cost. We found no issue."""

    def __init__(self, models):
        super().__init__()
        self._models = models

    def get_ref(self, thing):
        known = isinstance(thing, Model) and self._models.get_by_id(thing.id) is thing
        return thing.ref if known and thing not in self._models._new_models else super().get_ref(thing)


def named_in(part):
    """The ids in a part of a message."""
    if isinstance(part, dict):
        yield from (part["id"],) if isinstance(part.get("id"), str) else ()
        part = [*part.values()]
    for each in part if isinstance(part, list) else ():
        yield from named_in(each)


def apply(document, patch, *, setter=None):
    """9. What Bokeh's method of a Document does with a message. That lists the names of all models first, and takes it
    that the page now knows them all, those too that are still to be sent."""
    models, names = document.models, {*named_in(getattr(patch, "content", patch))}
    reader = Deserializer([model for model in map(models.get_by_id, names) if model], setter=setter)
    try:
        events = reader.deserialize(patch)["events"]
    except UnknownReferenceError as error:
        if models.seen(error.id):  # of a model that has gone meanwhile
            return
        raise
    for event in events:
        DocumentPatchedEvent.handle_event(document, event, setter)
    models.flush_synced(lambda model: model.id not in names)


def message_of(events):
    """Bokeh's PATCH-DOC of these events of one document."""
    models = events[0].document.models
    serializer = Known(models)
    message = patch_doc(patch_doc.create_header(), {}, {"events": serializer.encode(events)})
    models.flush_synced(lambda model: not serializer.has_ref(model))
    message.add_buffers(*serializer.buffers)
    return message


async def send(connection):
    """Sends what the connection has waiting."""
    waiting = WAITING[connection]
    while waiting:
        await connection._socket.send_message(waiting.popleft())


def send_one(connection, event):
    """Replaces what Bokeh 3.9 does for each change, awaited when its lock opens."""
    put(connection, [event])
    return send(connection)


def send_all(document, connections, events):
    """Replaces what Panel 1.9 does for the changes that it held back."""
    for connection in connections:
        put(connection, events)
        panel.io.document._dispatch_write_task(document, send, connection)


def in_order():
    """3, for Panel 1.9 and Bokeh 3.9: messages are sent in the order in which they were made. Each library wrote on its
    own, so one that refers to a figure could overtake the one that contains it. https://github.com/holoviz/panel/pull/6028"""
    ServerConnection.send_patch_document = send_one
    panel.io.document.write_events = panel.io.document.schedule_write_events = send_all


def behind(write):
    """3, for Panel 1.10 and Bokeh 3.10. write: Bokeh's method that writes the changes of a session when its lock opens.
    They now come behind what Panel held back for the same page, which waits for a free socket, and may contain what
    they refer to."""

    async def written(session, changes):
        for connections, events in panel.io.document._WRITE_EVENTS.pop(session.document, []):
            message = connections[0].protocol.create("PATCH-DOC", events)
            for connection in connections:
                await connection.send_message(message)
        await write(session, changes)

    return written


def lost_at_once(connect):
    """10. Bokeh's method that connects a page to its session. From 3.10 on the page may have closed by then; nobody was
    told, and the session was kept for ever. We found no issue."""

    def connected(server, protocol, socket, context, session):
        connection = connect(server, protocol, socket, context, session)
        if socket.ws_connection is None:
            server.client_lost(connection)
        return connection

    return connected


@cache
def mend():
    """Applies 2, 3, 9, 10, and 4: the source of Panel's style sheets for a part that never entered a document, because
    its view failed. Panel would request them from another host; and since all parts share their sheets, the page would
    lose them. https://github.com/holoviz/panel/issues/7073, https://github.com/holoviz/panel/pull/8408"""
    DocumentModelManager.freeze = thawed(DocumentModelManager.freeze)
    for module in FREEZES:
        module.freeze_doc = thawed(module.freeze_doc)
    panel.io.document._dispatch_msgs = to_the_last(panel.io.document._dispatch_msgs)
    if hasattr(panel.io.document, "_WRITE_MSGS"):  # Panel 1.9
        in_order()
    else:
        ServerSession._send_pending_patches = behind(ServerSession._send_pending_patches)
    BokehTornado.new_connection = lost_at_once(BokehTornado.new_connection)
    Document.apply_json_patch = apply
    panel.reactive.CDN_DIST = LOCAL_DIST


# --- for `python -m app`


def counted(wrap, budget):
    """5. Bokeh's method that prepares what a session does later, at the next tick or after some time: its cost is added
    to the session's budget, whether it waits for the document's lock or, as Panel's own answers, does not. budget: a
    function of the session. We found no issue."""

    def counting(session, act):
        @wraps(act)
        def work(*arguments, **named):
            mine = budget(session)
            with mine.work():
                result = act(*arguments, **named)
            return mine.steps(result) if inspect.iscoroutine(result) else result

        return work

    def wrap_and_count(session, callback):
        # Bokeh 3.10 calls it in a task of its own, whose steps are not counted with the rest.
        return counting(session, wrap(session, counting(session, callback)))

    return wrap_and_count


def count(budget):
    """From now on counts what sessions do later, and lets each frame of a websocket be counted."""
    WebSocketProtocol13._receive_frame = paced(WebSocketProtocol13._receive_frame)
    ServerSession._wrap_document_callback = counted(ServerSession._wrap_document_callback, budget)


def paced(receive):
    """11. tornado's method that reads one frame of a websocket: after each, also a ping or a part of a message, the
    handler's pace() is awaited. We found no issue."""

    async def received(protocol):
        await receive(protocol)
        if hasattr(protocol.handler, "pace"):  # a client has none
            await protocol.handler.pace()

    return received


# --- for components


def at_once(component, *properties):
    """6. Lets these properties of a Panel component arrive without Panel's delay of 50 ms, without its busy signal, and
    without making every parameter of the component writable first. We found no issue."""
    component._priority_changes = component._busy__ignore = list(properties)
    component._process_events = partial(_take, component, component._process_events, {*properties})


class Direct(JSComponent):
    """6. A component whose values go out without the two holds that Panel makes for each component, where the page's
    messages are held already: those cost more than the values."""

    def _param_change(self, *events):
        values = {event.name: event.new for event in events}
        for ref, (model, _) in self._models.items():
            document = model.document
            if not (document and document is panel.state.curdoc and document.callbacks.hold_value
                    and values.keys() <= self.own()):  # fmt: skip
                super()._param_change(*events)
                return
            told = self._in_process__events.get(document, {})
            news = {name: value for name, value in values.items() if name not in told or told[name] != value}
            self._changing[ref] = [*news]
            try:
                model.data.update(**news)
            finally:
                del self._changing[ref]

    @classmethod
    @cache
    def own(cls):
        """The names of its values, none of which is a part of the page or an event."""
        return set(cls.param) - set(JSComponent.param)


def _take(component, process, properties, changes):
    """Applies what a page has changed of a component; process: Panel's own method, for other properties."""
    document = panel.state.curdoc
    if not changes or document is None or not changes.keys() <= properties:
        process(changes)
        return
    component._in_process__events[document] = changes  # so that the page is not told what it has sent
    try:
        set_together(component, **changes)
    finally:
        component._in_process__events.pop(document, None)


def address_of(component):
    """7. The address on this page of a component's JavaScript, if that is in a bundle (so since
    https://github.com/holoviz/panel/pull/7410), so that the browser can request it before Panel says so."""
    return component._render_esm(True, server=True)
