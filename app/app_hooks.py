"""What Bokeh calls for this folder when a server starts, whichever starts it: `python -m app` or `panel serve app`."""

import asyncio
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager

import bokeh
import panel.custom
import panel.io.document
import panel.io.resources
import panel.layout.base
import panel.layout.grid
import panel.reactive
from bokeh.document.models import DocumentModelManager
from panel.io.resources import CDN_DIST, LOCAL_DIST

from app.kernels import compile_beside
from app.server.arrivals import most_files


class Here(ThreadPoolExecutor):
    """Does what it is given at once, in the thread that gives it."""

    def submit(self, function, /, *arguments, **named):
        future = Future()
        try:
            future.set_result(function(*arguments, **named))
        except BaseException as error:
            future.set_exception(error)
        return future


def thawed(freeze):
    """Bokeh's or Panel's method that keeps a document's list of models while they change: where that fails it would be
    kept for good, and nothing new would reach the page."""

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


def at_home(patch_stylesheet):
    """Panel's function that gives a style sheet its address. Of a part that never came into the document, because its
    view failed, Panel would ask another machine; and all parts share their sheets, so the page would lose them."""

    def patched(stylesheet, dist_url):
        patch_stylesheet(stylesheet, LOCAL_DIST if dist_url == CDN_DIST else dist_url)

    return patched


def to_the_last(dispatch):
    """Panel's function that writes what waits for a document's page. The first of two that were begun ends their common
    mark, and the second then took it that there is nothing: what it had lay there until something else was sent."""
    module = panel.io.document
    waiting = module._WRITE_EVENTS if hasattr(module, "_WRITE_EVENTS") else module._WRITE_MSGS  # Panel 1.10, 1.9

    async def dispatched(document):
        if document in waiting:
            module._WRITE_BLOCK[document] = True
        await dispatch(document)

    return dispatched


def on_server_loaded(server_context):
    """Has kernels compiled that are not kept, asks for as many open files as may be, and keeps what sessions do in the
    server's own thread.

    From 3.10 on Bokeh gives it to the event loop's executor, and what is sent to one of its own. That is no faster, for
    one thread at a time has the interpreter (a move costs an eighth more of the processor). But Panel answers some
    messages of a page, such as a dragged slider's, in the event loop without the document's lock: beside a thread, two
    of them would change one session at a time. What takes long is given to app.model.runs.
    """
    compile_beside()
    most_files()
    DocumentModelManager.freeze = thawed(DocumentModelManager.freeze)
    for module in (panel.custom, panel.layout.base, panel.layout.grid):
        module.freeze_doc = thawed(module.freeze_doc)
    for module in (panel.io.resources, panel.reactive):
        module.patch_stylesheet = at_home(module.patch_stylesheet)
    panel.io.document._dispatch_msgs = to_the_last(panel.io.document._dispatch_msgs)
    here = Here(1)
    asyncio.get_running_loop().set_default_executor(here)
    if tuple(map(int, bokeh.__version__.split(".")[:2])) >= (3, 10):
        # Private: if another Bokeh has none, this is an error in the log, at the start.
        server_context.application_context._executor._executor = here
