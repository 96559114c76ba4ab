"""The server's end of a page's connection: what comes is bounded, counted, and answered in a sentence."""

import asyncio
import logging
import time
import traceback
from contextlib import suppress
from functools import partial
from pathlib import Path
from types import SimpleNamespace
from urllib.parse import urlsplit

from bokeh.protocol.exceptions import MessageError, ProtocolError, ValidationError
from bokeh.util.token import get_session_id, get_token_payload
from panel.io.document import dispatch_tornado
from panel.io.resources import LOCAL_DIST, patch_model_css
from panel.io.server import WSHandler
from tornado.websocket import WebSocketClosedError

from app import text
from app.server.door import Budget, budget
from app.server.messages import Refused, look_at
from app.widgets.failure import tell

log = logging.getLogger("tippe")

LARGEST_FRAGMENT = 256 * 1024  # bytes
MOST_FRAGMENTS = 5  # of one message: header, metadata, content, and one buffer with a header
EACH_MESSAGE, WHOLE_PAGE = 0.002, 0.08  # s: what a message costs at least, and one that asks for the whole page

SOCKETS = 3  # of one session: its page's, and what is left of one that was lost
FRESH = 120  # s in which a page that was sent may open its session
TOKEN_LASTS = 24 * 3600


def in_english(refusal):
    return text.say(f"main.server.{refusal}", text.DEFAULT)


def ours(error):
    """Whether an error came out of this project's own code, and so is a bug of its."""
    here = str(Path(__file__).parents[2])
    # where others' code is only called
    names = ("app_hooks", "server/answers", "server/door", "server/server", "server/sockets")
    through = {f"{here}/app/{name}.py" for name in names}
    files = {frame.filename for frame in traceback.extract_tb(error.__traceback__)} - through
    return any(file.startswith((f"{here}/app/", f"{here}/tippe_core/")) for file in files)


def note(error, whose="a session"):
    """Logs what could not be done, in one line unless it is a bug of ours; returns a sentence for the sender."""
    if not isinstance(error, Refused) and ours(error):
        log.error("a bug, met by %s: %s", whose, "".join(traceback.format_exception(error)))
        return "The server could not do that; what is shown has not changed."
    name = type(error).__name__
    log.warning("refused from %s: %s: %.300s", whose, name, " ".join(str(error).split()))
    return str(error) if isinstance(error, Refused) else f"The server did not take that ({name})."


def why_not_made(application):
    """Why the last page could not be made, or None. Panel keeps it, and would show it to all who come after."""
    runner = application.handlers[0]._main_handler._runner
    reason, runner._failed, runner._error, runner._error_detail = runner.error_detail, False, None, None
    return reason


def prepare(document):
    """What Panel does to the session that it writes a page from, and a session that is made from a token lacks."""
    document._template_variables["dist_url"] = LOCAL_DIST
    for root in document.roots:
        patch_model_css(root, dist_url=LOCAL_DIST)


class Socket(WSHandler):
    """Bokeh's, with a limit at each place where a browser could ask for more than its share."""

    entered, fragments = None, 0  # of the message that is coming in

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
        if self.ws_connection is None:  # gone again
            return
        self.set_nodelay(True)  # a message is three writes and more; the second would wait for the first one's receipt
        self.entered = address
        door.enter(address)
        if known:
            # Under the lock nothing that the session has to say comes before the greeting.
            session = context.get_session(session_id)
            await budget(session).steps(session.with_document_locked(super()._async_open, token))
            return
        await door.making.turn(address)
        start = time.monotonic()
        try:
            if self.ws_connection is not None and not self.ws_connection.is_closing():
                mine = Budget()
                session = await mine.steps(context.create_session_if_needed(session_id, self.request, token))
                session.budget = mine
                reason = why_not_made(context.application)
                if reason:
                    log.error("a bug: a page could not be made: %s", reason)
                    self._refuse(4000, "The page could not be made.")
                    return
                prepare(session.document)
                await mine.steps(super()._async_open(token))
        finally:
            door.making.done(time.monotonic() - start)

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
            with budget(self.connection.session).work():
                super().on_close()

    def _refuse(self, code, sentence):
        log.warning("refused %s: %.200s", self.request.remote_ip, sentence)
        self.close(code, sentence.encode()[:120].decode(errors="ignore"))

    async def on_message(self, fragment):
        if self.connection is None:
            self._refuse(1002, "A message came before the session was open.")
            return
        mine = budget(self.connection.session)
        before = mine.spent
        least = await mine.steps(self._take(fragment))
        if not least or self.connection is None:
            return
        mine.spend(max(0.0, least - (mine.spent - before)))
        wait = mine.wait()
        if wait and not mine.told:
            log.warning("%s sends more than its share; it is read more slowly", self.request.remote_ip)
        mine.told = wait > 0
        if wait:
            await asyncio.sleep(wait)

    async def _take(self, fragment):
        """Answers where this was the last of a message; returns what that costs at least, else 0."""
        self.fragments += 1
        try:
            if self.fragments > MOST_FRAGMENTS:
                raise Refused(f"A message comes in at most {MOST_FRAGMENTS} pieces.")
            message = await self.receiver.consume(fragment)
        except (MessageError, ProtocolError, ValidationError, Refused, ValueError, RecursionError) as error:
            self._refuse(1007, f"That is no message: {error}")
            return 0
        except Exception as error:
            self._refuse(1007, f"That is no message ({type(error).__name__}).")
            return 0
        if message is None:
            return 0
        self.fragments = 0
        await self._answer(message)
        return WHOLE_PAGE if message.msgtype == "PULL-DOC-REQ" else EACH_MESSAGE

    async def _answer(self, message):
        """The reply to a message. What cannot be done is said in one line, to the sender and in the log."""
        try:
            look_at(message, self.connection.session.document)
            reply = await self.handler._handlers[message.msgtype](message, self.connection)
        except Exception as error:
            sentence = note(error, self.request.remote_ip)
            reply = self.connection and self._error(message, sentence)
            if self.connection and not isinstance(error, Refused):
                tell(self.connection.session.document)
        if reply and self.connection is not None:
            await self.send_message(reply)

    async def send_message(self, message):
        """All pieces at once: Bokeh's waits for each to be out, and Panel's messages, meanwhile, for it."""
        with suppress(WebSocketClosedError):
            with await self.write_lock.acquire():
                pieces = dispatch_tornado(SimpleNamespace(_socket=self), msg=message)
            await asyncio.gather(*pieces)

    def _error(self, message, sentence):
        reply = self.connection.error(message, sentence)
        reply.content["traceback"] = None
        return reply
