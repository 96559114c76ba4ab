"""The page for a class or for the open internet: `python -m app`, set by environment variables (Settings).

`panel serve app` serves the same page to one person. Here, what one visitor may cost the others is bounded: sessions
are counted and made one at a time, in turn among addresses (door); a message is looked at before Bokeh takes it
(messages), and has an end (sockets); a visitor who sends more than a share of the processor can answer is read more
slowly. docs/DEPLOY.md and SECURITY.md say what follows from that.
"""

import asyncio
import ctypes
import gc
import logging
import os
import platform
import secrets
import signal
import sys
import threading
import time
import traceback
import webbrowser
from dataclasses import replace
from pathlib import Path

import bokeh.server.urls
import panel as pn
from bokeh.core.validation import silence
from bokeh.core.validation.warnings import EMPTY_LAYOUT
from bokeh.server.server import BaseServer
from bokeh.server.session import ServerSession
from bokeh.server.tornado import BokehTornado
from bokeh.settings import settings as bokeh_settings
from panel.io.application import build_single_handler_application
from panel.io.document import _cleanup_doc
from panel.io.server import ComponentResourceHandler, get_static_routes
from panel.io.session import generate_session
from panel.io.state import set_curdoc
from tornado.httpserver import HTTPServer
from tornado.ioloop import IOLoop, PeriodicCallback
from tornado.iostream import StreamClosedError
from tornado.netutil import bind_sockets
from tornado.web import RequestHandler, StaticFileHandler
from tornado.websocket import WebSocketClosedError

from app.kernels import compile_beside
from app.server.answers import (
    Component,
    Liveness,
    Page,
    Root,
    Sheet,
    in_pieces,
    log_request,
    set_default_headers,
    write_error,
)
from app.server.arrivals import Arrivals, most_files
from app.server.door import Door, counted
from app.server.sockets import LARGEST_FRAGMENT, TOKEN_LASTS, Socket, note, why_not_made

log = logging.getLogger("tippe")

# s after which a connection on which nothing is asked is closed. A browser keeps six open for minutes; a proxy, few.
IDLE, IDLE_PROXY = 5, 75
PING = 45  # s
TIDY = 10  # s
LIBC = ctypes.CDLL(None) if os.name == "posix" else None
GRACE = 3.0  # s from SIGTERM to the end, whatever still runs


def serve(settings, sockets, parent=None):
    """Serves until SIGTERM, or until the other end of the pipe parent is closed."""
    compile_beside()  # before anything is computed
    bokeh_settings.perform_error_diagnostics = False  # an absent property's name would be compared with all others
    silence(EMPTY_LAYOUT)  # a tab that nobody looked at yet
    RequestHandler.set_default_headers, RequestHandler.write_error = set_default_headers, write_error
    StaticFileHandler.get_content = in_pieces(StaticFileHandler.get_content)
    # Private: if another Bokeh has none, the server does not start.
    ServerSession._wrap_document_callback = counted(ServerSession._wrap_document_callback)
    pn.config.exception_handler = note
    bokeh.server.urls.per_app_patterns[:] = [(r"/ws", Socket), (r"/?", Page)]
    static = [(pattern, Component if handler is ComponentResourceHandler else handler, *more)
              for pattern, handler, *more in get_static_routes({})]  # fmt: skip
    apps = {"/app": build_single_handler_application(Path(__file__).parents[1])}
    template = warm(apps["/app"])
    tornado = BokehTornado(
        apps,
        prefix=settings.prefix,
        extra_patterns=[(r"/?", Root), *static],
        secret_key=settings.secret.encode(),
        sign_sessions=True,
        keep_alive_milliseconds=0,  # tornado's own pings end connections that do not answer
        websocket_ping_interval=PING,
        websocket_ping_timeout=PING,
        websocket_max_message_size_bytes=LARGEST_FRAGMENT,
        unused_session_lifetime_milliseconds=1000 * settings.linger,
        check_unused_sessions_milliseconds=5000,
        session_token_expiration=TOKEN_LASTS,
        include_headers=["User-Agent", "Accept-Language", "Host"],
        include_cookies=[],
        log_function=log_request,
    )
    tornado.add_handlers(r".*", [(r"/liveness", Liveness), (r"/", Root)])  # there, whatever the prefix
    context = tornado.applications["/app"]
    tornado.tippe, tornado.door = settings, Door(settings)
    tornado.door.sessions = context._sessions
    tornado.sheet = Sheet(template, tornado.resources())
    _cleanup_doc(template.document, destroy=False)
    gc.collect()
    gc.freeze()  # what all sessions share stays: looking through it again took a fifth of the making of each
    idle = IDLE_PROXY if settings.proxy else IDLE
    http = HTTPServer(tornado, xheaders=bool(settings.proxy), max_body_size=LARGEST_FRAGMENT,
                      max_header_size=32 * 1024, idle_connection_timeout=idle, body_timeout=idle)  # fmt: skip
    arrivals = Arrivals(http, sockets, most_files())
    loop = IOLoop.current()
    loop.asyncio_loop.set_exception_handler(unheard)
    server = BaseServer(loop, tornado, http)

    def stop(*_):
        log.info("stopping")
        if hasattr(signal, "setitimer"):
            signal.signal(signal.SIGALRM, lambda *_: os._exit(0))  # where something does not come to an end
            signal.setitimer(signal.ITIMER_REAL, GRACE)
        loop.add_callback_from_signal(close)

    async def close():
        arrivals.stop()
        for each in sockets:
            each.close()
        for connection in list(tornado._clients):
            connection._socket.close(1001, "The server is stopping.")
        await asyncio.sleep(0.2)
        server.stop(wait=False)
        loop.stop()

    for name in (signal.SIGTERM, signal.SIGINT):
        signal.signal(name, stop)
    if parent is not None:
        loop.add_handler(parent, lambda *_: (loop.remove_handler(parent), stop()), IOLoop.READ)
    PeriodicCallback(lambda: tidy(tornado.door), 1000 * TIDY).start()
    loop.add_callback(pn.state._schedule_busy_cleanup)  # the first session's would keep that session
    server.start()
    arrivals.start()
    log.info("serving http://%s:%d%s/app", settings.address or "localhost", settings.port, settings.prefix)
    if settings.show and parent is None:
        address = f"http://localhost:{settings.port}{settings.prefix}/app"
        threading.Thread(target=webbrowser.open, args=[address], daemon=True).start()
    loop.start()


def unheard(loop, context):
    """What nobody waits for: that a page has closed while something was on its way to it is no error."""
    if not isinstance(context.get("exception"), (WebSocketClosedError, StreamClosedError)):
        loop.default_exception_handler(context)


def tidy(door):
    """Gives the memory of ended sessions back to the system: their models refer to each other. What lives is frozen:
    else Python looks through all of it now and then, which is a second for 100 sessions, and finds nothing."""
    now = set(door.sessions)
    made, door.gone = now - door.known, door.gone + len(door.known - now)
    door.known, ended = now, door.gone >= 20 or (door.gone and not now)
    if ended:
        door.gone = 0
        gc.unfreeze()
        gc.collect()
        if hasattr(LIBC, "malloc_trim"):  # glibc's
            LIBC.malloc_trim(0)
    if made or ended:
        gc.freeze()


def warm(application):
    """One session that is the template of all pages, made before the first visitor comes."""
    session = generate_session(application)
    reason = why_not_made(application)
    if reason:
        raise SystemExit(reason)
    with set_curdoc(session.document):
        pn.state._on_load(None)
    return session


def supervise(settings, sockets):
    """Keeps so many workers on the same sockets; one that ends is replaced, and all end with this one, however it ends.

    (panel serve --num-procs forks too, but its first process waits for the others with no signal handler: SIGTERM ends
    that one alone and leaves the workers to the system.)
    """
    workers, ending, failed = {}, [], []
    held, ours_ends = os.pipe()

    def begin():
        pid = os.fork()
        if pid:
            workers[pid] = time.monotonic()
            return
        code = 1
        try:
            os.close(ours_ends)
            for name in (signal.SIGTERM, signal.SIGINT, signal.SIGALRM):
                signal.signal(name, signal.SIG_DFL)
            serve(settings, sockets, parent=held)
            code = 0
        except BaseException:
            traceback.print_exc()
        finally:
            os._exit(code)

    def end(*_):
        ending.append(True)
        for pid in workers:
            os.kill(pid, signal.SIGTERM)

    for name in (signal.SIGTERM, signal.SIGINT):
        signal.signal(name, end)
    for _ in range(settings.workers):
        begin()
    while workers:
        pid, status = os.wait()
        lived = time.monotonic() - workers.pop(pid)
        if ending:
            continue
        code = os.waitstatus_to_exitcode(status)
        log.error("worker %d ended (%d) after %.0f s", pid, code, lived)
        if lived < 5 and code >= 0:  # not one that somebody killed
            log.error("a worker that ends by itself within 5 s is not replaced: stopping")
            failed.append(True)
            end()
        else:
            time.sleep(min(1.0, 1 / max(lived, 0.1)))
            if not ending:
                begin()
    return 1 if failed else 0


def main(settings):
    """Listens and serves; returns the exit code."""
    sys.stdout.reconfigure(errors="backslashreplace")  # half a character, sent by somebody, is no reason not to log
    logging.basicConfig(stream=sys.stdout, level=logging.WARNING, force=True,
                        format=f"%(asctime)s %(levelname)s {platform.node()} %(process)d %(message)s")  # fmt: skip
    log.setLevel(settings.log.upper())
    for name in ("bokeh", "panel"):  # their own handlers write to another stream, in another form
        logging.getLogger(name).handlers.clear()
        logging.getLogger(name).setLevel("CRITICAL")  # what they say of an error, note() says
    if settings.log == "debug":
        logging.getLogger("tornado.access").setLevel(logging.INFO)
    if not settings.secret:
        settings = replace(settings, secret=secrets.token_hex(32))
    try:
        sockets = bind_sockets(settings.port, settings.address or None)
    except OSError as error:
        print(f"port {settings.port}, address {settings.address!r}: {error.strerror}. Choose others by --port and "
              "--address, or TIPPE_PORT and TIPPE_ADDRESS.", file=sys.stderr)  # fmt: skip
        return 1
    if settings.workers > 1:
        return supervise(settings, sockets)
    serve(settings, sockets)
    return 0
