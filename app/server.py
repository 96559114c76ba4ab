"""The page for a class or for the open internet: `python -m app`, set by environment variables (Settings).

`panel serve app` serves the same page to one person. Here, what one visitor may cost the others is bounded: sessions
are counted and made one at a time, in turn among addresses; a message is looked at before Bokeh takes it, and has an
end; a visitor who sends more than a share of the processor can answer is read more slowly. docs/DEPLOY.md and
SECURITY.md say what follows from that.
"""

import asyncio
import ctypes
import gc
import inspect
import json
import logging
import os
import platform
import re
import secrets
import signal
import sys
import threading
import time
import traceback
import types
import webbrowser
from collections import Counter, OrderedDict, deque
from contextlib import contextmanager, suppress
from dataclasses import replace
from functools import partial
from pathlib import Path
from types import SimpleNamespace
from urllib.parse import urlsplit

import bokeh.server.urls
import panel as pn
from bokeh.core.validation import silence
from bokeh.core.validation.warnings import EMPTY_LAYOUT
from bokeh.protocol.exceptions import MessageError, ProtocolError, ValidationError
from bokeh.server.server import BaseServer
from bokeh.server.session import ServerSession
from bokeh.server.tornado import BokehTornado
from bokeh.settings import settings as bokeh_settings
from bokeh.util.token import get_session_id, get_token_payload
from panel.io.application import build_single_handler_application
from panel.io.document import _cleanup_doc, dispatch_tornado
from panel.io.resources import LOCAL_DIST, patch_model_css
from panel.io.server import ComponentResourceHandler, DocHandler, WSHandler, get_static_routes
from panel.io.session import generate_session
from panel.io.state import set_curdoc
from tornado.httpserver import HTTPServer
from tornado.ioloop import IOLoop, PeriodicCallback
from tornado.iostream import StreamClosedError
from tornado.netutil import bind_sockets
from tornado.web import HTTPError, RequestHandler, StaticFileHandler
from tornado.websocket import WebSocketClosedError

from app import text
from app.arrivals import Arrivals, most_files

log = logging.getLogger("tippe")

LARGEST_FRAGMENT = 256 * 1024  # bytes; a saved top is at most 64 KiB, a third more as base64
MOST_FRAGMENTS = 35  # of one message: header, metadata, content, and 16 buffers with a header each
MOST_EVENTS, MOST_PARTS, DEEPEST = 100, 10_000, 16
KINDS = {"PATCH-DOC", "PULL-DOC-REQ", "SERVER-INFO-REQ"}  # a browser never pushes a document
EVENTS = {"ModelChanged", "MessageSent"}  # nor adds roots, or streams

SHARE, SAVED = 0.5, 5.0  # of the processor for one session, and s of it that a quiet one has saved up
EACH_MESSAGE, WHOLE_PAGE = 0.002, 0.08  # s: what the cheapest message costs, and one that asks for the whole page
LONGEST_WAIT = 0.25  # s, beside what a message cost itself, so that "Cancel" comes through

SOCKETS = 3  # of one session: its page's, and what is left of one that was lost
# s after which a connection on which nothing is asked is closed. A browser keeps six open for minutes; a proxy, few.
IDLE, IDLE_PROXY = 5, 75
FRESH = 120  # s in which a page that was sent may open its session
TOKEN_LASTS = 24 * 3600
PING = 45  # s
TIDY = 10  # s
LIBC = ctypes.CDLL(None) if os.name == "posix" else None
PIECE = 64 * 1024  # bytes of a static file
GRACE = 3.0  # s from SIGTERM to the end, whatever still runs


# --- who may come in


def in_english(refusal):
    return text.say(f"main.server.{refusal}", text.DEFAULT)


class Door:
    """Counts sessions, and has them made one at a time, in turn among the addresses that ask."""

    def __init__(self, settings):
        self.settings, self.sessions = settings, {}  # Bokeh's own, by id
        self.open = Counter()  # sessions and waiting ones, by address
        self.known, self.gone = set(), 0  # ids of the sessions that tidy() saw, and how many went since it tidied
        self._waiting = OrderedDict()  # address -> deque of futures
        self._busy = False

    def refusal(self, address):
        """Why not, a key of [server] in main.toml; None where there is room."""
        if len(self.sessions) + sum(map(len, self._waiting.values())) >= self.settings.sessions:
            return "full"
        if self.open[address] >= self.settings.sessions_per_address:
            return "crowded"
        return None

    def enter(self, address):
        self.open[address] += 1

    def leave(self, address):
        self.open[address] -= 1
        if self.open[address] <= 0:
            del self.open[address]

    async def turn(self, address):
        """Returns when it is this one's turn; the next waits for done()."""
        if not self._busy:
            self._busy = True
            return
        mine = asyncio.get_running_loop().create_future()
        self._waiting.setdefault(address, deque()).append(mine)
        await mine

    def done(self, took):
        """Those inside are served before the next is made."""
        IOLoop.current().call_later(took / 4, self._next)

    def _next(self):
        if not self._waiting:
            self._busy = False
            return
        address, queue = self._waiting.popitem(last=False)
        mine = queue.popleft()
        if queue:
            self._waiting[address] = queue  # behind the others
        mine.set_result(None)


class Budget:
    """A session's share of the processor: who is over it waits, and while he waits nothing is read from him."""

    def __init__(self):
        self.left, self.at, self.spent, self.told = SAVED, time.monotonic(), 0.0, False

    def spend(self, seconds):
        """Counts s of the processor."""
        now = time.monotonic()
        self.left = min(SAVED, self.left + SHARE * (now - self.at)) - seconds
        self.at, self.spent = now, self.spent + seconds

    def wait(self):
        """s to wait after a message."""
        seconds, self.spent = max(0.0, min(-self.left / SHARE, LONGEST_WAIT + self.spent)), 0.0
        return seconds

    @contextmanager
    def work(self):
        """Counts what is done inside."""
        start = time.thread_time()  # of this thread: runs beside it are others'
        try:
            yield
        finally:
            self.spend(time.thread_time() - start)

    @types.coroutine
    def steps(self, coroutine):
        """Awaits a coroutine and counts its own steps, not what others do between them."""
        step, value = coroutine.send, None
        while True:
            try:
                with self.work():
                    awaited = step(value)
            except StopIteration as end:
                return end.value
            try:
                step, value = coroutine.send, (yield awaited)
            except GeneratorExit:
                coroutine.close()
                raise
            except BaseException as error:
                step, value = coroutine.throw, error


def budget(session):
    """The one of a Bokeh session."""
    if not hasattr(session, "budget"):
        session.budget = Budget()
    return session.budget


def counted(with_document_locked):
    """Bokeh's method through which a session does whatever it does later, Panel's answers to changed values among it:
    with what that costs put on the session's budget."""

    async def with_document_locked_and_counted(session, function, *arguments, **named):
        mine = budget(session)

        def work():
            with mine.work():
                result = function(*arguments, **named)
            return mine.steps(result) if inspect.iscoroutine(result) else result

        return await with_document_locked(session, work)

    return with_document_locked_and_counted


# --- what may come in


class Refused(ValueError):
    """What a browser running this page never sends. The sentence goes to whoever sent it."""


def look_at(message):
    """Raises Refused for what is no message of this page's, whatever its values."""
    if message.msgtype not in KINDS:
        raise Refused(f"A {str(message.msgtype)[:40]!r} message is not for this server.")
    if message.msgtype != "PATCH-DOC":
        return
    events = message.content.get("events") if isinstance(message.content, dict) else None
    if not isinstance(events, list) or not 0 < len(events) <= MOST_EVENTS:
        raise Refused(f"A message has a list of 1 to {MOST_EVENTS} events.")
    for event in events:
        kind = event.get("kind") if isinstance(event, dict) else None
        if kind not in EVENTS:
            raise Refused(f"An event of kind {str(kind)[:40]!r} is not for this server.")
    parts, level = 0, [message.content]
    for _ in range(DEEPEST):
        level = [part for whole in level for part in (whole.values() if isinstance(whole, dict) else whole)
                 if isinstance(part, (dict, list, str, int, float))]  # fmt: skip
        parts += len(level)
        if parts > MOST_PARTS:
            raise Refused(f"A message has at most {MOST_PARTS} parts.")
        level = [part for part in level if isinstance(part, (dict, list))]
        if any(isinstance(part, dict) and part.get("type") == "bytes" and isinstance(part.get("data"), str)
               for part in level):  # fmt: skip
            raise Refused("Bytes come in a buffer: as text they may be packed without end.")
        if not level:
            return
    raise Refused(f"A message is at most {DEEPEST} deep.")


def ours(error):
    """Whether an error came out of this project's own code, and so is a bug of its."""
    here = str(Path(__file__).parent.parent)
    through = {__file__, str(Path(__file__).with_name("app_hooks.py"))}  # where others' code is only called
    files = {frame.filename for frame in traceback.extract_tb(error.__traceback__)} - through
    return any(file.startswith((f"{here}/app/", f"{here}/tippe_core/")) for file in files)


def note(error, whose="a session"):
    """Logs what could not be done, in one line unless it is a bug of ours; returns a sentence for the sender."""
    if ours(error):
        log.error("a bug, met by %s: %s", whose, "".join(traceback.format_exception(error)))
        return "The server could not do that; what is shown has not changed."
    name = type(error).__name__
    log.warning("refused from %s: %s: %.300s", whose, name, " ".join(str(error).split()))
    return str(error) if isinstance(error, Refused) else f"The server did not take that ({name})."


class Socket(WSHandler):
    """Bokeh's, with a limit at each place where a browser could ask for more than its share."""

    entered = None

    def check_origin(self, origin):
        host = urlsplit(origin).netloc.lower()
        if self.application.tippe.lets(host) if self.application.tippe.hosts else host == self.request.host.lower():
            return True
        log.warning("refused a connection to %s by a page of %.100r: TIPPE_ORIGINS", self.request.host, origin)
        return False

    def open(self, *arguments, **named):
        try:
            super().open(*arguments, **named)
        except (ProtocolError, RuntimeError, ValueError, KeyError) as error:
            self._refuse(1008, str(error))

    async def _async_open(self, token):
        try:
            await self._enter(token)
        except (ProtocolError, RuntimeError, ValueError, KeyError) as error:
            self._refuse(1008, str(error))

    async def _enter(self, token):
        payload = get_token_payload(token)
        context, door, address = self.application_context, self.application.door, self.request.remote_ip
        session_id = get_session_id(token)
        known = session_id in context._sessions
        if known:
            refusal = "crowded" if context.get_session(session_id).connection_count >= SOCKETS else None
        else:
            age = TOKEN_LASTS - (payload["session_expiry"] - time.time())
            refusal = "ended" if age > FRESH else door.refusal(address)
            if refusal == "full":
                await context._cleanup_sessions(0)  # those whose page has gone
                refusal = door.refusal(address)
        if refusal:
            self._refuse(4000, in_english(refusal))
            return
        self.set_nodelay(True)  # a message is three writes and more; the second would wait for the first one's receipt
        self.entered = address
        door.enter(address)
        if known:
            # Under the lock nothing that the session has to say comes before the greeting.
            await context.get_session(session_id).with_document_locked(super()._async_open, token)
            return
        await door.turn(address)
        start = time.monotonic()
        try:
            if self.ws_connection is not None and not self.ws_connection.is_closing():
                await context.create_session_if_needed(session_id, self.request, token)
                reason = failure(context.application)
                if reason:
                    log.error("a bug: a page could not be made: %s", reason)
                    self._refuse(4000, "The page could not be made.")
                    return
                prepare(context.get_session(session_id).document)
                await super()._async_open(token)
        finally:
            door.done(time.monotonic() - start)

    def get_websocket_protocol(self):
        """Tornado's, which ends a connection over too large a piece without a word in the log."""
        protocol = super().get_websocket_protocol()
        if protocol is not None:
            protocol.close = partial(self._closing, protocol.close)
        return protocol

    def _closing(self, close, code=None, reason=None):
        if code == 1009:
            log.warning("refused %s: a piece over %d KiB", self.request.remote_ip, LARGEST_FRAGMENT // 1024)
        close(code, reason)

    def on_close(self):
        if self.entered is not None:
            self.application.door.leave(self.entered)
            self.entered = None
        if self.connection is not None:
            super().on_close()

    def _refuse(self, code, sentence):
        log.warning("refused %s: %.200s", self.request.remote_ip, sentence)
        self.close(code, sentence.encode()[:120].decode(errors="ignore"))

    async def on_message(self, fragment):
        if self.connection is None:
            return self._refuse(1002, "A message came before the session was open.")
        self.fragments = getattr(self, "fragments", 0) + 1
        try:
            if self.fragments > MOST_FRAGMENTS:
                raise Refused(f"A message comes in at most {MOST_FRAGMENTS} pieces.")
            message = await self.receiver.consume(fragment)
        except (MessageError, ProtocolError, ValidationError, Refused, ValueError, RecursionError) as error:
            return self._refuse(1007, f"That is no message: {error}")
        except Exception as error:
            return self._refuse(1007, f"That is no message ({type(error).__name__}).")
        if message is None:
            return None
        self.fragments = 0
        await self._answer(message)
        if self.connection is None:
            return None
        mine = budget(self.connection.session)
        mine.spend(WHOLE_PAGE if message.msgtype == "PULL-DOC-REQ" else EACH_MESSAGE)
        wait = mine.wait()
        if wait and not mine.told:
            log.warning("%s sends more than its share; it is read more slowly", self.request.remote_ip)
        mine.told = wait > 0
        if wait:
            await asyncio.sleep(wait)

    async def _answer(self, message):
        """The reply to a message. What cannot be done is said in one line, to the sender and in the log."""
        try:
            look_at(message)
            if message.msgtype == "PATCH-DOC":
                message.apply_to_document = self._bounded(message.apply_to_document)
            reply = await self.handler._handlers[message.msgtype](message, self.connection)
        except Exception as error:
            sentence = note(error, self.request.remote_ip)
            reply = self.connection and self._error(message, sentence)
        if reply and self.connection is not None:
            await self.send_message(reply)

    async def send_message(self, message):
        """All pieces at once: Bokeh's waits for each to be out, and Panel's messages, meanwhile, for it."""
        with suppress(WebSocketClosedError):
            with await self.write_lock.acquire():
                pieces = dispatch_tornado(SimpleNamespace(_socket=self), msg=message)
            await asyncio.gather(*pieces)

    def _bounded(self, apply):
        def applied(*arguments):
            with budget(self.connection.session).work():
                apply(*arguments)

        return applied

    def _error(self, message, sentence):
        reply = self.connection.error(message, sentence)
        reply.content["traceback"] = None
        return reply


# --- what goes out

HEADERS = {
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "same-origin",  # the address holds what a person set
    "Cross-Origin-Opener-Policy": "same-origin",
    "Permissions-Policy": "camera=(), geolocation=(), microphone=(), payment=(), usb=()",
}
# BokehJS makes functions of the page's CustomJS, and Panel imports a component's code from a blob.
POLICY = (
    "default-src 'none'; script-src 'self' 'nonce-{nonce}' 'unsafe-eval' blob:; style-src 'self' 'unsafe-inline'; "
    "img-src 'self' data: blob:; font-src 'self' data:; connect-src 'self' ws://{host} wss://{host} blob: data:; "
    "worker-src 'self' blob:; manifest-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors {frames}"
)
# While the page waits for its turn, and where it is not let in.
WAITING = """
<div id="waiting" role="status" style="display:none;position:fixed;inset:auto 10% 24px;text-align:center;z-index:9999;
font:16px/1.5 system-ui,sans-serif;color:#22303c;background:white;border-radius:8px;padding:8px"></div>
<script>
(() => {
  const words = document.getElementById("waiting")
  const say = (text) => { words.textContent = text; words.style.display = "block" }
  const here = () => window.Bokeh?.documents?.length > 0
  setTimeout(() => here() || say(MADE), 3000)
  addEventListener("unhandledrejection", () => {
    if (here()) return
    say(BUSY)
    setTimeout(() => location.reload(), 5000 + 5000 * Math.random())
  })
  const look = setInterval(() => { if (here()) { words.remove(); clearInterval(look) } }, 200)
})()
</script>
"""
PLAIN = """<!doctype html><html lang="{lang}"><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>{title}</title>{again}
<p style="font: 18px/1.5 system-ui, sans-serif; margin: 20vh 10vw; color: #22303c">{sentence}</p></html>"""


def policy(request, settings, nonce=""):
    host = request.host if re.fullmatch(r"[\w.:\[\]-]{1,260}", request.host) else ""
    text = POLICY.format(nonce=nonce, host=host, frames=settings.frames)
    return text if host else text.replace(" ws:// wss://", "")


class Handler(RequestHandler):
    """Of this project's few plain answers."""

    @property
    def tippe(self):
        return self.application.tippe

    @property
    def language(self):
        """The one of the address, else the one that this browser prefers."""
        asked = self.request.query_arguments.get("lang", [b""])[-1].decode(errors="replace")
        return asked if asked in text.LANGUAGES else text.preferred(self.request.headers.get("Accept-Language", ""))

    def words(self, name):
        return text.say(f"main.server.{name}", self.language)

    def say(self, status, sentence, again=0):
        """A page with one sentence."""
        self.set_status(status)
        self.set_header("Content-Type", "text/html; charset=utf-8")
        self.set_header("Cache-Control", "no-store")
        self.set_header("Content-Security-Policy", policy(self.request, self.tippe))
        if again:
            self.set_header("Retry-After", str(again))
        refresh = f'<meta http-equiv="refresh" content="{again}">' if again else ""
        title = text.say("main.title", self.language)
        self.finish(PLAIN.format(lang=self.language, title=title, sentence=sentence, again=refresh))


class Page(Handler, DocHandler):
    """The page, from one template session: a visitor's own is made when his browser opens the socket."""

    async def get(self, *arguments, **named):
        if self.request.path.endswith("/"):  # the page's own addresses are relative to one without
            Root.get(self)
            return
        if not self.tippe.lets(self.request.host):
            log.warning("refused a page at %.100r: TIPPE_ORIGINS", self.request.host)
            self.say(403, self.words("stranger"))
            return
        refusal = self.application.door.refusal(self.request.remote_ip)
        if refusal:
            log.warning("refused %s a page: %s", self.request.remote_ip, in_english(refusal))
            self.say(503, f"{self.words(refusal)} {self.words('again')}", again=10)
            return
        self.nonce = secrets.token_urlsafe(16)
        self.set_header("Content-Security-Policy", policy(self.request, self.tippe, self.nonce))
        await super().get(*arguments, **named)

    def write(self, chunk):
        if isinstance(chunk, str) and "</body>" in chunk:
            before, after = chunk.rsplit("</body>", 1)
            waiting = WAITING
            for name in ("made", "busy"):
                waiting = waiting.replace(name.upper(), json.dumps(self.words(name)))
            chunk = re.sub(r"<script(?=[\s>])", f'<script nonce="{self.nonce}"', f"{before}{waiting}</body>{after}")
        super().write(chunk)


class Root(Handler):
    """Where the page is, for who asks for the server alone."""

    def get(self):
        self.redirect(f"{self.tippe.prefix}/app" + (f"?{self.request.query}" if self.request.query else ""))


class Liveness(Handler):
    """For the health checks of containers, and how full it is."""

    def get(self):
        self.set_header("Cache-Control", "no-store")
        self.write({"live": True, "sessions": len(self.application.door.sessions)})


class Component(ComponentResourceHandler):
    """Panel's would import any module that a visitor names."""

    def parse_url_path(self, path):
        if path.split("/")[0] not in sys.modules:
            raise HTTPError(404)
        return super().parse_url_path(path)


def in_pieces(get_content):
    """tornado's method that reads a static file, with the file open for each piece anew: else a connection that reads
    slowly would be two open files."""

    def read(cls, path, start=None, end=None):
        start, end = start or 0, os.path.getsize(path) if end is None else end
        for at in range(start, end, PIECE):
            yield b"".join(get_content(path, at, min(at + PIECE, end)))

    return classmethod(read)


def set_default_headers(handler):
    for name, value in HEADERS.items():
        handler.set_header(name, value)
    handler.clear_header("Server")


# --- the server


def serve(settings, sockets, parent=None):
    """Serves until SIGTERM, or until the other end of the pipe parent is closed."""
    bokeh_settings.perform_error_diagnostics = False  # an absent property's name would be compared with all others
    silence(EMPTY_LAYOUT)  # a tab that nobody looked at yet
    RequestHandler.set_default_headers = set_default_headers
    StaticFileHandler.get_content = in_pieces(StaticFileHandler.get_content)
    ServerSession.with_document_locked = counted(ServerSession.with_document_locked)
    pn.config.exception_handler = note
    bokeh.server.urls.per_app_patterns[:] = [(r"/ws", Socket), (r"/?", Page)]
    static = [(pattern, Component if handler is ComponentResourceHandler else handler, *more)
              for pattern, handler, *more in get_static_routes({})]  # fmt: skip
    apps = {"/app": build_single_handler_application(Path(__file__).parent)}
    warm(apps["/app"], settings)
    gc.collect()
    gc.freeze()  # what all sessions share stays: looking through it again took a fifth of the making of each
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
    )
    tornado.add_handlers(r".*", [(r"/liveness", Liveness), (r"/", Root)])  # there, whatever the prefix
    context = tornado.applications["/app"]
    tornado.tippe, tornado.door = settings, Door(settings)
    tornado.door.sessions = context._sessions
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


def failure(application):
    """Why the last page could not be made, or None. Panel keeps it, and would show it to all who come after."""
    runner = application.handlers[0]._main_handler._runner
    reason, runner._failed, runner._error, runner._error_detail = runner.error_detail, False, None, None
    return reason


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


def prepare(document):
    """What Panel does to the session that it writes a page from, and a session that is made from a token lacks."""
    document._template_variables["dist_url"] = LOCAL_DIST
    for root in document.roots:
        patch_model_css(root, dist_url=LOCAL_DIST)


def warm(application, settings):
    """One session that is the template of all pages, made before the first visitor comes."""
    pn.config.reuse_sessions, pn.config.session_key_func = True, lambda request: "page"
    session = generate_session(application)
    reason = failure(application)
    if reason:
        raise SystemExit(reason)
    with set_curdoc(session.document):
        pn.state._session_key_funcs[f"{settings.prefix}/app"] = pn.config.session_key_func
        pn.state._sessions["page"] = session
        session.block_expiration()
        pn.state._on_load(None)
    _cleanup_doc(session.document, destroy=False)


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
