"""How a server ends: open pages are told and come back elsewhere, one after the other; then it closes."""

import asyncio
import logging
import random
import signal

from tornado.ioloop import IOLoop

from app import text
from app.server.processes import REPLACE

log = logging.getLogger("tippe")

GRACE = 3  # s from the last page to the end, whatever still runs
APART = 1.0  # s between two pages at most: another server makes one in less
LAST = 0.2  # s, in which what was said goes out


class Ending:
    """Of one process. While it lasts no page is let in, so /readyz and the page say no."""

    def __init__(self, settings, door, arrivals, server):
        self.code = 0
        self._settings, self._door, self._arrivals, self._server = settings, door, arrivals, server
        self._at_once = False

    def begin(self, number, _frame=None):
        """At a signal. SIGINT, or a second one, asks to wait for nobody."""
        self._at_once = self._at_once or self._door.stopping or number == signal.SIGINT
        if self._door.stopping:
            return
        self._door.stopping = True
        if hasattr(signal, "alarm"):
            signal.alarm(GRACE + self._settings.drain)  # which ends what does not come to an end
        IOLoop.current().add_callback_from_signal(self._end)

    def replace(self):
        """Ends so that another process takes its place. Nobody is here."""
        self.code = REPLACE
        self.begin(signal.SIGINT)

    async def _end(self):
        told = list(self._door.sockets)
        log.info("stopping: %d open pages are sent elsewhere", len(told))
        random.shuffle(told)
        apart = min(APART, self._settings.drain / max(len(told), 1))
        for count, each in enumerate(told):
            if count:
                await self._wait(apart)
            each.close(1001, text.say("main.server.stopping", text.DEFAULT))
        self._arrivals.stop()
        for each in self._arrivals.sockets:
            each.close()
        await asyncio.sleep(LAST)
        self._server.stop(wait=False)
        IOLoop.current().stop()

    async def _wait(self, seconds):
        for _ in range(10):
            if not self._at_once:
                await asyncio.sleep(seconds / 10)
