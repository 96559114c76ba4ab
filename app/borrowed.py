"""The private parts of Panel and Bokeh that are used nevertheless, each in one place, and all here.

A new version may change any of them without notice. tests/test_borrowed.py fails if one has changed, or if another is
used anywhere else in the page. For each, docs/upstream has a minimal program that shows the fault without us, and the
text of a report.
"""

import asyncio
import json
from contextlib import contextmanager, suppress
from functools import cache

import panel.custom
import panel.layout.base
import panel.layout.grid
import panel.reactive
from bokeh.document.models import DocumentModelManager
from bokeh.server.views.ws import WSHandler
from panel.io.resources import LOCAL_DIST
from tornado.websocket import WebSocketClosedError, WebSocketHandler

FREEZES = (panel.custom, panel.layout.base, panel.layout.grid)  # the modules that use Panel's freeze_doc


def thawed(freeze):
    """1. Bokeh's and Panel's methods that freeze a document's list of models while they change it: it would stay frozen
    if the change fails. docs/upstream/frozen.md"""

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


def send_message(socket, message):
    """2. Bokeh's method that sends a message to a page, but all of it at once, without the lock for which Panel waits
    before it sends its own messages. With that, those of the two come in another order than they were made in, and the
    last may be left behind. docs/upstream/order.md"""
    pieces = [(message.header_json, False), (message.metadata_json, False), (message.content_json, False)]
    for buffer in message.buffers:
        pieces += [(json.dumps(buffer.ref), False), (buffer.to_bytes(), True)]
    written = []
    with suppress(WebSocketClosedError):
        written = [WebSocketHandler.write_message(socket, *piece) for piece in pieces]
    return all_of(written)


async def all_of(written):
    """Waits until all of it is on its way, or the page has closed."""
    with suppress(WebSocketClosedError):
        await asyncio.gather(*written)


@cache
def mend():
    """Applies 1 and 2, and

    3. the source of Panel's style sheets for a part that never entered a document, because its view failed: Panel would
    request them from another host; and since all parts share their sheets, the page would lose them.
    docs/upstream/sheets.md"""
    DocumentModelManager.freeze = thawed(DocumentModelManager.freeze)
    for module in FREEZES:
        module.freeze_doc = thawed(module.freeze_doc)
    WSHandler.send_message = send_message
    panel.reactive.CDN_DIST = LOCAL_DIST


def at_once(component, *properties):
    """4. Lets these properties of a Panel component arrive without Panel's delay of 50 ms, and without its busy signal.
    docs/upstream/delay.md"""
    component._priority_changes = component._busy__ignore = list(properties)
