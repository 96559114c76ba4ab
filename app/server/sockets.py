"""The server's end of a page's connection: messages are bounded, charged, and answered, if need be by a sentence."""

import asyncio
import logging
import time
import traceback
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
from app.server.admission import SLOW, Budget, budget
from app.server.answers import Answer
from app.server.logs import refused
from app.server.loop import CHARGED
from app.server.messages import Refused, look_at
from app.widgets.failure import tell

log = logging.getLogger("tippe")

LARGEST_FRAGMENT = 256 * 1024  # bytes
MOST_FRAGMENTS = 5  # of one message: header, metadata, content, and one buffer with a header
# s: the least cost of a message, of one that asks for the whole page, and of a read, of which each frame takes three
EACH_MESSAGE, WHOLE_PAGE, EACH_READ = 0.002, 0.08, 0.0001

SOCKETS = 3  # of one session: that of its page, and remains of lost ones


def ours(error):
    """Whether an error was raised in this project's own code, and so is one of its bugs."""
    if isinstance(error, Refused):
        return False
    here = str(Path(__file__).parents[2])
    # where others' code is only called
    through = (f"{here}/app/borrowed.py", f"{here}/app/server/")
    files = [frame.filename for frame in traceback.extract_tb(error.__traceback__)]
    called = [file for file in files if file.endswith("/messages.py") or not file.startswith(through)]
    return any(file.startswith((f"{here}/app/", f"{here}/tippe_core/")) for file in called)


def note(error, whose="a session"):
    """Logs what failed, in one line unless it is a bug of ours; returns a sentence for the sender."""
    if ours(error):
        log.error("a bug, met by %s: %s", whose, "".join(traceback.format_exception(error)))
        return "The server could not do that; what is shown has not changed."
    name = type(error).__name__
    refused(whose, name, "refused from %s: %s: %.300s", whose, name, " ".join(str(error).split()))
    return str(error) if isinstance(error, Refused) else f"The server did not take that ({name})."


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

    def __init__(self, *arguments, **named):
        super().__init__(*arguments, **named)
        self._before = Budget()  # of what comes before its session is there
        stream = self.request.connection.stream
        stream.read_bytes = self._paced(stream.read_bytes)

    @property
    def address(self):
        return self.request.remote_ip

    def check_origin(self, origin):
        settings = self.application.tippe
        lets = (
            settings.lets(urlsplit(origin).netloc) if settings.origins else WebSocketHandler.check_origin(self, origin)
        )
        if lets:
            return True
        self.application.admission.refused["stranger"] += 1
        self.refused = True
        line = "refused a connection to %s by a page of %.100r: TIPPE_ORIGINS"
        refused(self.address, "stranger", line, self.request.host, origin)
        return False

    def select_subprotocol(self, subprotocols):
        self.token = subprotocols[1] if len(subprotocols) == 2 else ""
        return super().select_subprotocol(subprotocols)

    def open(self):
        IOLoop.current().add_callback(self._let_in)  # reads meanwhile, so as to notice a visitor who leaves

    async def _let_in(self):
        try:
            await self._enter()
        except (ProtocolError, RuntimeError, ValueError, KeyError) as error:
            self._refuse(1008, str(error))

    async def _enter(self):
        app = self.application
        if not check_token_signature(self.token, signed=True, secret_key=app.secret_key):
            raise ProtocolError("That token is not of this server.")
        session_id, expiry = get_session_id(self.token), get_token_payload(self.token)["session_expiry"]
        session = next((each for each in app.admission.sessions if each.id == session_id), None)
        if session is not None and not app.admission.stopping:
            refusal = "crowded" if session.connection_count >= SOCKETS else None
        else:
            refusal = "ended" if time.time() > expiry else app.admission.refusal(self.address)
        if refusal:
            self._refuse_for(refusal)
            return
        if self.ws_connection is None:  # gone again
            return
        self.set_nodelay(True)  # a message is three writes and more; the second would wait for the first one's receipt
        app.admission.sockets.add(self)
        if session is not None:
            CHARGED.set(budget(session))
            # Under the lock nothing that the session has to say comes before the greeting.
            await budget(session).steps(session.with_document_locked(self._greet, session))
            return
        turn = await app.admission.making.turn(self.address)
        start = time.monotonic()
        try:
            if self.ws_connection is not None and not self.ws_connection.is_closing():
                mine = Budget()
                CHARGED.set(mine)
                await mine.steps(self._make(session_id, mine))
        finally:
            turn.done(time.monotonic() - start)

    async def _make(self, session_id, mine):
        try:
            session = await self.application_context.create_session_if_needed(session_id, self.request, self.token)
        except Exception as error:
            note(error, self.address)
            self._refuse_for("failed")
            return
        session.budget, session.address = mine, self.address
        prepare(session.document)
        await self._greet(session)

    async def _greet(self, session):
        protocol = Protocol()
        self.receiver = Receiver(protocol)
        self.connection = self.application.new_connection(protocol, self, self.application_context, session)
        if self.ws_connection is None:  # gone meanwhile, and on_close() had no connection to end
            self.application.client_lost(self.connection)
        else:
            await self.send_message(protocol.create("ACK"))

    def on_close(self):
        self.application.admission.sockets.discard(self)
        if self.close_code is None and not self.refused:
            log.info(
                "lost the connection of %s, or it sent a piece over %d KiB", self.address, LARGEST_FRAGMENT // 1024
            )
        if self.connection is not None:
            with budget(self.connection.session).work():
                super().on_close()

    def _refuse_for(self, reason):
        """The page says it in its own words: waiting.js, which reads the name."""
        self._refuse(4000, f"{reason}: {text.say(f'main.server.{reason}', text.DEFAULT)}", reason)

    def _refuse(self, code, sentence, why="connection"):
        self.refused = True
        self.application.admission.refused[why] += 1
        refused(self.address, why, "refused %s: %.200s", self.address, sentence)
        self.close(code, sentence.encode()[:120].decode(errors="ignore"))

    @property
    def _mine(self):
        return self._before if self.connection is None else budget(self.connection.session)

    def _paced(self, read):
        """The stream's read_bytes(), which reads each part of a frame, also of a ping or of a part of a message: it is
        charged, and who sends more than a share waits before the next is read."""

        async def read_bytes(*how, **named):
            data = await read(*how, **named)
            mine = self._mine
            mine.spend(EACH_READ)
            wait = mine.wait()
            if wait > SLOW and not mine.told:
                log.warning("%s sends more than its share; it is read more slowly", self.address)
            mine.told = wait > SLOW
            if wait:
                await asyncio.sleep(wait)
            return data

        return read_bytes

    async def on_message(self, fragment):
        if self.ws_connection is None or self.ws_connection.is_closing():
            return  # who has left gets no answer to what was read ahead
        if self.connection is None:
            self._refuse(1002, "A message came before the session was open.")
            return
        mine = self._mine
        CHARGED.set(mine)
        before = mine.spent
        least = await mine.steps(self._take(fragment))
        mine.spend(max(0.0, least - (mine.spent - before)))

    async def _take(self, fragment):
        """Adds a fragment, and answers if it was the last of a message; returns the least cost of that, else 0."""
        self.fragments += 1
        try:
            if self.fragments > MOST_FRAGMENTS:
                raise Refused(f"A message comes in at most {MOST_FRAGMENTS} pieces.")
            message = await self.receiver.consume(fragment)
        except Exception as error:
            self._refuse(1007, f"That is no message: {error if str(error) else type(error).__name__}")
            return 0
        if message is None:
            return 0
        self.fragments = 0
        start = time.monotonic()
        await self._answer(message)
        self.application.admission.moved(time.monotonic() - start)
        return WHOLE_PAGE if message.msgtype == "PULL-DOC-REQ" else EACH_MESSAGE

    async def _answer(self, message):
        """The reply to a message. A failure is reported in one line, to the sender and in the log."""
        try:
            look_at(message, self.connection.session.document)
            act = ServerSession.pull if message.msgtype == "PULL-DOC-REQ" else ServerSession.patch
            reply = await act(message, self.connection)
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
