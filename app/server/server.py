"""The page for a class or for the open internet: `python -m app`, set by environment variables (Settings).

`panel serve app` serves the same page to one person. Here, what one visitor can cost the others is bounded: sessions
are counted and created one at a time, in turn among addresses (admission); a message is checked before Bokeh uses it
(messages), and its size is limited (sockets); a visitor who sends more than a share of the processor can answer is read
more slowly. docs/DEPLOY.md and SECURITY.md describe the consequences.
"""

import gc
import logging
import secrets
import signal
import sys
import threading
import webbrowser
from dataclasses import replace

import panel as pn
from bokeh.application.handlers.function import FunctionHandler
from bokeh.core.validation import silence
from bokeh.core.validation.warnings import EMPTY_LAYOUT
from bokeh.events import DocumentReady
from bokeh.server.server import BaseServer
from bokeh.server.tornado import BokehTornado
from bokeh.settings import settings as bokeh_settings
from panel.io.application import Application
from panel.io.session import generate_session
from panel.io.state import set_curdoc
from tornado.ioloop import IOLoop, PeriodicCallback
from tornado.netutil import bind_sockets

from app import VERSION
from app.borrowed import mend
from app.kernels import compile_beside
from app.server import health, logs
from app.server.admission import Admission
from app.server.answers import log_request, routes
from app.server.files import Bounded, most_files
from app.server.loop import charging, in_one_thread
from app.server.pages import Page, Sheet
from app.server.processes import tidier, workers
from app.server.shutdown import GracefulShutdown
from app.server.sockets import LARGEST_FRAGMENT, Socket, note
from app.server.worker_status import Board, Watch

log = logging.getLogger("tippe")

# s after which a connection on which nothing is asked is closed. A browser keeps six open for minutes; a proxy, few.
IDLE, IDLE_PROXY = 5, 75
PING = 45  # s
FRESH = 900  # s in which a page that was sent may open its session: at 100 kbit/s its scripts take 130
TIDY = 10  # s
SWITCH = 0.0002  # s: the server's thread waits for each computing one so long after each write. Python's 0.005 adds up


def serve(settings, sockets, show, board, parent=None):
    """Serves until SIGTERM, or until the other end of the pipe `parent` is closed; returns the exit code. show: puts
    the page into the document being served."""
    sys.setswitchinterval(SWITCH)
    compile_beside()  # before anything is computed
    bokeh_settings.perform_error_diagnostics = False  # an absent property's name would be compared with all others
    bokeh_settings.perform_document_validation = False  # every page has the same parts: the tests look at them
    silence(EMPTY_LAYOUT)  # a tab that nobody looked at yet
    pn.config.exception_handler = note
    tornado = prepared(settings, show)
    gc.collect()
    gc.freeze()  # what all sessions share stays: looking through it again took a fifth of the making of each
    idle = IDLE_PROXY if settings.proxy else IDLE
    http = Bounded(tornado, xheaders=bool(settings.proxy), max_body_size=LARGEST_FRAGMENT, files=most_files(),
                   max_header_size=32 * 1024, idle_connection_timeout=idle, body_timeout=idle)  # fmt: skip
    loop = IOLoop.current()
    loop.asyncio_loop.set_exception_handler(logs.unheard)
    in_one_thread(loop.asyncio_loop)
    loop.asyncio_loop.set_task_factory(charging)
    server = BaseServer(loop, tornado, http)

    shutdown = GracefulShutdown(settings, tornado.admission, http, server)

    for name in (signal.SIGTERM, signal.SIGINT):
        signal.signal(name, shutdown.begin)
    if parent is not None:
        loop.add_handler(parent, lambda *_: (loop.remove_handler(parent), shutdown.begin(signal.SIGTERM)), IOLoop.READ)
    PeriodicCallback(tidier(tornado.admission, shutdown.replace), 1000 * TIDY).start()
    tornado.watch = Watch(board, tornado.admission)
    tornado.watch.start()
    pn.state.add_periodic_callback(lambda: None, 1, count=1)  # Panel's first timer keeps the session that it is made in
    server.start()
    http.add_sockets(sockets)
    where = settings.address or "localhost", settings.port, settings.prefix
    log.info("serving http://%s:%d%s/app, version %s", *where, VERSION)
    if settings.show and parent is None:
        address = f"http://localhost:{settings.port}{settings.prefix}/app"
        threading.Thread(target=webbrowser.open, args=[address], daemon=True).start()
    loop.start()
    board.leave()
    return shutdown.code


def prepared(settings, show):
    """Bokeh's tornado application, with our routes and what they need."""

    def make(document):
        with set_curdoc(document):
            show()

    mend()
    application = Application(FunctionHandler(make))
    template = generate_session(application)  # of all pages, made before the first visitor comes
    template.document.callbacks.trigger_event(DocumentReady())
    tornado = BokehTornado(
        {"/app": application},
        secret_key=settings.secret.encode(),
        sign_sessions=True,
        keep_alive_milliseconds=0,  # tornado's own pings end connections that do not answer
        websocket_ping_interval=PING,
        websocket_ping_timeout=PING,
        websocket_max_message_size_bytes=LARGEST_FRAGMENT,
        unused_session_lifetime_milliseconds=1000 * settings.linger,
        check_unused_sessions_milliseconds=5000,
        session_token_expiration=FRESH,
        include_headers=["User-Agent", "Accept-Language", "Host"],
        include_cookies=[],
        log_function=log_request,
    )
    context = tornado.applications["/app"]
    tornado.tippe, tornado.admission, tornado.sheet = (
        settings,
        Admission(settings, context),
        Sheet(template, tornado.resources()),
    )
    path = f"{settings.prefix}/app/ws"
    socket = (path, Socket, {"application_context": context, "bokeh_websocket_path": path})
    page = (f"{settings.prefix}/app/?", Page)
    tornado.add_handlers(
        ".*", [socket, page, *health.routes(settings), *routes(tornado)]
    )  # before Bokeh's own, all of them
    for each in template.document.session_destroyed_callbacks:
        each(template.document.session_context)
    template.destroy()
    return tornado


def main(settings, show):
    """Listens and serves; returns the exit code."""
    logs.begin(settings)
    if not settings.secret:
        settings = replace(settings, secret=secrets.token_hex(32))
    try:
        sockets = bind_sockets(settings.port, settings.address or None)
    except OSError as error:
        print(f"port {settings.port}, address {settings.address!r}: {error.strerror}. Choose others by --port and "
              "--address, or TIPPE_PORT and TIPPE_ADDRESS.", file=sys.stderr)  # fmt: skip
        return 1
    board = Board(settings.workers)
    parent = workers(settings.workers, board) if settings.workers > 1 or settings.memory else None
    return serve(settings, sockets, show, board, parent)
