"""The server's end of a page's connection: messages are bounded, charged, and answered, if need be by a sentence."""

import asyncio
import logging
import select
import time
import traceback
from functools import partial
from pathlib import Path
from urllib.parse import urlsplit

from bokeh.protocol import Protocol
from bokeh.protocol.exceptions import ProtocolError
from bokeh.protocol.receiver import Receiver
from bokeh.server.session import ServerSession
from bokeh.server.views.ws import WSHandler
from bokeh.util.token import check_token_signature, get_session_id, get_token_payload
from panel.io.resources import LOCAL_DIST, patch_model_css
from tornado.ioloop import IOLoop
from tornado.websocket import WebSocketHandler

from app import text
from app.server.admission import SLOW, Budget
from app.server.answers import Answer
from app.server.logs import refused
from app.server.messages import Refused, look_at
from app.turns import CHARGED
from app.widgets.failure import tell

log = logging.getLogger("tippe")

LARGEST_FRAGMENT = 256 * 1024  # bytes
MOST_FRAGMENTS = 5  # of one message: header, metadata, content, and one buffer with a header
EACH_READ = 0.0001  # s that a read is charged, of which each frame takes three
LEAST = 0.005  # s: shorter waits cost more than they save
NOTICED = 0.25  # s within which a page that waits, and goes, is noticed

SOCKETS = 3  # of one session: that of its page, and remains of lost ones

ROOT = Path(__file__).parents[2]
OURS = (f"{ROOT}/app/", f"{ROOT}/tippe_core/")
CALLS = (f"{ROOT}/app/borrowed.py", f"{ROOT}/app/server/")  # in which others' code is only called


def ours(error):
    """Whether an error was raised in this project's own code, and so is one of its bugs."""
    files = [frame.filename for frame in traceback.extract_tb(error.__traceback__)]
    return not isinstance(error, Refused) and any(
        each.startswith(OURS) and (not each.startswith(CALLS) or each.endswith("/messages.py")) for each in files
    )


def note(error, whose="a session"):
    """Logs what failed, in one line unless it is a bug of ours; returns a sentence for the sender."""
    if ours(error):
        log.error("a bug, met by %s: %s", whose, "".join(traceback.format_exception(error)))
        return "The server could not do that; what is shown has not changed."
    name = type(error).__name__
    refused(whose, name, "refused from %s: %s: %.300s", whose, name, " ".join(str(error).split()))
    return str(error) if isinstance(error, Refused) else f"The server did not take that ({name})."


def gone(stream):
    """Closes a stream whose other end has closed, and says so. What it had sent would hide that until it is read."""
    if not stream.closed() and hasattr(select, "POLLRDHUP"):
        look = select.poll()
        look.register(stream.fileno(), select.POLLRDHUP)
        if look.poll(0):
            stream.close()
    return stream.closed()


def prepare(document):
    """Prepares a session created from a token as Panel prepares one from which it generates a page."""
    document.template_variables["dist_url"] = LOCAL_DIST
    for root in document.roots:
        patch_model_css(root, dist_url=LOCAL_DIST)
    # A page that lost its server loads anew (notices.js). Bokeh would meanwhile open another session, and fail with it.
    document.config.update(reconnect_session=False, notifications=None, notify_connection_status=False)


class Socket(Answer, WSHandler):
    """Bokeh's handler, with a limit for everything of which a browser could take more than its share."""

    token, fragments = "", 0  # fragments: of the message that is coming in
    told = pulled = False  # told: that it is slowed; pulled: it has its page

    def __init__(self, *arguments, **named):
        super().__init__(*arguments, **named)
        self.budget = Budget()  # that of its session, if there is one already
        stream = self.request.connection.stream
        stream.read_bytes = self._paced(stream.read_bytes, partial(gone, stream))

    @property
    def address(self):
        return self.request.remote_ip

    @property
    def is_here(self):
        return self.ws_connection is not None and not self.ws_connection.is_closing()

    def check_origin(self, origin):
        settings = self.application.tippe
        lets = settings.lets(urlsplit(origin).netloc) if settings.origins else (
            WebSocketHandler.check_origin(self, origin))  # fmt: skip
        if not lets:
            line = "refused a connection to %s by a page of %.100r: TIPPE_ORIGINS"
            self.refuse("stranger", line, self.request.host, origin)
        return lets

    def select_subprotocol(self, subprotocols):
        self.token = subprotocols[1] if len(subprotocols) == 2 else ""
        return super().select_subprotocol(subprotocols)

    def open(self):
        """Lets it in, or says why not. Its session is made later: a visitor who leaves is noticed meanwhile."""
        app, key = self.application, self.application.secret_key
        try:
            if not check_token_signature(self.token, signed=True, secret_key=key):
                raise ProtocolError("That token is not of this server.")
            session_id, expiry = get_session_id(self.token), get_token_payload(self.token)["session_expiry"]
        except (ProtocolError, RuntimeError, ValueError, KeyError) as error:
            self._end(1008, "connection", str(error))
            return
        session = next((each for each in app.admission.sessions if each.id == session_id), None)
        if session is not None and not app.admission.stopping:
            refusal = "crowded" if session.connection_count >= SOCKETS else None
        else:
            refusal = "ended" if time.time() > expiry else app.admission.refusal(self.address)
        if refusal:
            self._refuse_for(refusal)
            return
        self.set_nodelay(True)  # a message is three writes and more; the second would wait for the first one's receipt
        app.admission.sockets.add(self)
        self.budget = getattr(session, "budget", self.budget)
        CHARGED.set(self.budget)  # for all that is begun here and by its messages: server/loop.py
        if session is None:
            IOLoop.current().add_callback(self._make, session_id)
        else:  # under the lock nothing that the session has to say comes before the greeting
            IOLoop.current().add_callback(session.with_document_locked, self._greet, session)

    async def _make(self, session_id):
        turn = await self.application.admission.making.turn(self.address)
        start = time.monotonic()
        try:
            if self.is_here:
                session = await self.application_context.create_session_if_needed(session_id, self.request, self.token)
                session.budget, session.address = self.budget, self.address
                prepare(session.document)
                await self._greet(session)
        except Exception as error:
            note(error, self.address)
            self._refuse_for("failed")
        finally:
            turn.done(time.monotonic() - start)

    async def _greet(self, session):
        if self.is_here:
            protocol = Protocol()
            self.receiver = Receiver(protocol)
            self.connection = self.application.new_connection(protocol, self, self.application_context, session)
            await self.send_message(protocol.create("ACK"))

    def on_close(self):
        self.application.admission.sockets.discard(self)
        if self.close_code is None and not self.refused:
            log.info(
                "lost the connection of %s, or it sent a piece over %d KiB", self.address, LARGEST_FRAGMENT // 1024
            )
        super().on_close()

    def _refuse_for(self, reason):
        """The page says it in its own words: waiting.js, which reads the name."""
        self._end(4000, reason, f"{reason}: {text.say(f'main.server.{reason}', text.DEFAULT)}")

    def _end(self, code, why, sentence):
        self.refuse(why, "refused %s: %.200s", self.address, sentence)
        self.close(code, sentence.encode()[:120].decode(errors="ignore"))

    def _paced(self, read, gone):
        """The stream's read_bytes(), which reads each part of a frame, also of a ping or of a part of a message: it is
        charged, and who sends more than a share waits before the next is read."""

        async def read_bytes(*how, **named):
            start = time.monotonic()
            data = await read(*how, **named)
            self.budget.rest(time.monotonic() - start)
            self.budget.spend(EACH_READ)
            wait = self.budget.wait()
            if wait > SLOW and not self.told:
                log.warning("%s sends more than its share; it is read more slowly", self.address)
            self.told = wait > SLOW
            while wait > LEAST and not gone():
                await asyncio.sleep(min(wait, NOTICED))
                wait -= NOTICED
            return data

        return read_bytes

    async def on_message(self, fragment):
        if not self.is_here:
            return  # who has left gets no answer to what was read ahead
        if self.connection is None:
            self._end(1002, "connection", "A message came before the session was open.")
            return
        self.fragments += 1
        try:
            if self.fragments > MOST_FRAGMENTS:
                raise Refused(f"A message comes in at most {MOST_FRAGMENTS} pieces.")
            message = await self.receiver.consume(fragment)
        except Exception as error:
            self._end(1007, "connection", f"That is no message: {error if str(error) else type(error).__name__}")
            return
        if message is not None:
            self.fragments, start = 0, time.monotonic()
            await self._answer(message)
            self.application.admission.moved(time.monotonic() - start)

    def _pulled(self, message):
        """All of the page, which takes a twentieth of a second to write."""
        if self.pulled:
            raise Refused("A page asks for all of itself once.")
        self.pulled = True
        return ServerSession.pull(message, self.connection)

    async def _answer(self, message):
        """The reply to a message. A failure is reported in one line, to the sender and in the log."""
        try:
            look_at(message, self.connection.session.document)
            if message.msgtype == "PULL-DOC-REQ":
                reply = await self._pulled(message)
            else:
                reply = await ServerSession.patch(message, self.connection)
        except Exception as error:
            sentence = note(error, self.address)
            self.application.admission.refused["message"] += 1
            if self.connection is None:
                return
            reply = self.connection.error(message, sentence)
            reply.content["traceback"] = None
            if not isinstance(error, Refused):
                tell(self.connection.session.document)
        if reply and self.connection is not None:
            await self.send_message(reply)
