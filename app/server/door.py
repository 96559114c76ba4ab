"""Admission of visitors, and how much of the server's own thread each session may take."""

import time
import types
from collections import Counter
from contextlib import contextmanager

from app.turns import Turns

SHARE, SAVED = 0.5, 5.0  # share of the processor for one session, and s of it that a quiet session can save up
LONGEST_WAIT = 0.25  # s, in addition to the cost of the message itself, so that "Cancel" gets through


class Door:
    """Counts sessions and pages, and lets them be made in turn. context: Bokeh's application context of the page."""

    def __init__(self, settings, context):
        self.settings, self._context = settings, context
        self.sockets = set()  # of pages that were let in
        self.making, self.pages = Turns(pause=0.25), Turns(pause=4)
        self.stopping, self.refused = False, Counter()  # why -> how often

    @property
    def sessions(self):
        return list(self._context.sessions)

    @property
    def full(self):
        """Whether no more pages are let in, after sessions whose page has closed have been dropped."""
        return sum(bool(each.connection_count) for each in self.sessions) >= self.settings.sessions

    @property
    def served(self):
        """Whether there has been any visitor."""
        return self.making.turns > 0

    @property
    def idle(self):
        """Whether there is no visitor, nor one about to enter."""
        return not (self.sessions or self.sockets or self.making.waiting() or self.pages.waiting())

    def refusal(self, address):
        """The reason for refusing a page, a key of [server] in main.toml; None if there is room."""
        if self.stopping:
            return "stopping"
        if len(self.sessions) + self.making.waiting() >= self.settings.sessions:
            for session in self.sessions:
                if not session.connection_count:  # its page has closed: Bokeh need not keep it for a reconnection
                    session.request_expiration()
            return "full"
        if sum(socket.address == address for socket in self.sockets) >= self.settings.sessions_per_address:
            return "crowded"
        return None


class Budget:
    """A session's share of the processor. A session over its share waits, and nothing is read from it meanwhile."""

    _running = None  # the one being charged now; there is only one thread

    def __init__(self):
        self.left, self.at, self.spent, self.told = SAVED, time.monotonic(), 0.0, False
        self._since = 0.0

    def spend(self, seconds):
        """Charges seconds of the processor."""
        now = time.monotonic()
        self.left = min(SAVED, self.left + SHARE * (now - self.at)) - seconds
        self.at, self.spent = now, self.spent + seconds

    def wait(self):
        """The time to wait after a message, s."""
        seconds, self.spent = max(0.0, min(-self.left / SHARE, LONGEST_WAIT + self.spent)), 0.0
        return seconds

    @contextmanager
    def work(self):
        """Context that charges the work done inside: once, and without what is charged to another session."""
        outer = Budget._running
        self._change(outer, self)
        try:
            yield
        finally:
            self._change(self, outer)

    @staticmethod
    def _change(before, after):
        now = time.thread_time()  # of this thread: runs beside it are others'
        if before is not None:
            before.spend(now - before._since)
        if after is not None:
            after._since = now
        Budget._running = after

    async def steps(self, coroutine):
        """Awaits a coroutine and charges its own steps, not what others do between them."""
        return await self._stepping(coroutine)

    @types.coroutine
    def _stepping(self, coroutine):
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
    """The Budget of a Bokeh session."""
    if not hasattr(session, "budget"):
        session.budget = Budget()
    return session.budget
