"""How a server ends: open pages are told one after the other and reconnect elsewhere; then it closes."""

import asyncio
import logging
import random
import signal

from tornado.ioloop import IOLoop

from app import text
from app.server.processes import REPLACE

log = logging.getLogger("tippe")

GRACE = 3  # s from the last page to the end, whatever is still running
APART = 1.0  # s between two pages at most: another server makes one in less
LAST = 0.2  # s for the last messages to go out


class GracefulShutdown:
    """The end of one process. Meanwhile no page is let in: /readyz and the page refuse."""

    def __init__(self, settings, admission, http, server):
        self.code = 0
        self._settings, self._admission, self._http, self._server = settings, admission, http, server
        self._at_once = False

    def begin(self, number, _frame=None):
        """Handler of a signal. SIGINT, or a second signal, ends without waiting."""
        self._at_once = self._at_once or self._admission.stopping or number == signal.SIGINT
        if self._admission.stopping:
            return
        self._admission.stopping = True
        if hasattr(signal, "alarm"):
            signal.alarm(GRACE + self._settings.drain)  # kills a process that does not end by itself
        IOLoop.current().add_callback_from_signal(self._end)

    def replace(self):
        """Ends so that another process takes its place; there are no visitors."""
        self.code = REPLACE
        self.begin(signal.SIGINT)

    async def _end(self):
        told = list(self._admission.sockets)
        log.info("stopping: %d open pages are sent elsewhere", len(told))
        random.shuffle(told)
        apart = min(APART, self._settings.drain / max(len(told), 1))
        for count, each in enumerate(told):
            if count:
                await asyncio.sleep(0 if self._at_once else apart)
            each.close(1001, text.say("main.server.stopping", text.DEFAULT))
        self._http.stop()  # accepts nobody any more
        await asyncio.sleep(LAST)
        self._server.stop(wait=False)
        IOLoop.current().stop()
