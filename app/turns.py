"""What is expensive for a server's one thread is done for one visitor at a time; others are served between."""

import asyncio
import time
from collections import OrderedDict, deque
from contextvars import ContextVar, copy_context
from weakref import WeakKeyDictionary

from tornado.ioloop import IOLoop

CHARGED = ContextVar("charged", default=None)  # the Budget of the session for which something is done, now or later
TAKEN = 2.0  # s within which a turn has to be taken up: a page that cannot take it keeps nobody waiting
IDLE = 0.5  # a pause is half as long if the thread has worked less than this part of it
EXACT, NEWS = 5, 0.8  # a visitor is told each of the last places, and before those each that is nearer by a fifth


class Turn:
    """A turn that was asked for. go: is called with it when it is time to begin() something, and again after rest(), on
    the event loop's thread; told: is called with how many are served before it, while that changes."""

    def __init__(self, turns, whose, go, told):
        self.whose, self.since, self.begun = whose, time.monotonic(), False
        self._turns, self._go, self._told, self._last = turns, go, told, None
        self._context = copy_context()  # in that of another page Panel would take this one's changes for that page's

    def begin(self):
        """Whether the turn is still to be had. If so, it lasts until rest() or done()."""
        return self._turns.taken(self)

    def rest(self, took):
        """Lets others be served after something that took so many s, and then calls go() again."""
        self._turns.after(took, self, self._turns.give)

    def done(self, took):
        """Ends it; others are served before the next one."""
        self._turns.after(took, self, self._turns.end)

    def leave(self):
        """Gives it up, unless it has begun; returns whether it did."""
        return self._turns.drop(self)

    def come(self):
        """Says that it is time."""
        self._context.run(self._go, self)

    def tell(self, before):
        """Says how many are served before it, if that is news."""
        if self._told is not None and (self._last is None or (before < self._last and (
                before <= EXACT or before <= NEWS * self._last))):  # fmt: skip
            self._last = before
            self._context.run(self._told, before)


class Turns:
    """Lets things be done one at a time, in turn among those that ask, each of whom may ask for several. pause: the
    time after each in which the admitted visitors are served, as a multiple of the time that it took; half of it if
    they need little."""

    def __init__(self, pause):
        self._pause, self._waiting = pause, OrderedDict()  # whose -> deque of turns
        self._now, self._limit = None, None  # the turn that is had, and what takes it away if nobody takes it up
        self.turns, self.waited = 0, 0.0  # how many there were, and s that these waited

    def waiting(self, whose=None):
        """The number of those that wait, in all or of one."""
        return sum(map(len, self._waiting.values())) if whose is None else len(self._waiting.get(whose, ()))

    def ask(self, whose, go, told=None):
        """A Turn; go() is called at once if nobody else has one."""
        turn = Turn(self, whose, go, told)
        self._waiting.setdefault(whose, deque()).append(turn)
        if self._now is None:
            self._next()
        elif told is not None:
            self._tell()
        return turn

    async def turn(self, whose):
        """Returns when it is the caller's turn, as a Turn that has begun."""
        while True:
            come = asyncio.get_running_loop().create_future()
            turn = self.ask(whose, lambda turn, come=come: come.done() or come.set_result(None))
            try:
                await come
            except asyncio.CancelledError:
                turn.leave()
                raise
            if turn.begin():
                return turn

    # ---- for a Turn ----

    def give(self, turn):
        self._limit = IOLoop.current().call_later(TAKEN, self.end, turn)
        turn.come()

    def taken(self, turn):
        if self._now is turn and self._limit is not None:
            IOLoop.current().remove_timeout(self._limit)
            self._limit, turn.begun = None, True
        return self._now is turn

    def after(self, took, turn, act):
        if (budget := CHARGED.get()) is not None:
            budget.in_turn = took
        half, worked = took * self._pause / 2, time.thread_time()

        def look():
            idle = time.thread_time() - worked < IDLE * half
            IOLoop.current().call_later(0 if idle else half, lambda: self._now is turn and act(turn))

        IOLoop.current().call_later(half, look)

    def end(self, turn):
        if self._now is turn:
            self._next()

    def drop(self, turn):
        queue = self._waiting.get(turn.whose, ())
        if turn in queue:
            queue.remove(turn)
            if not queue:
                del self._waiting[turn.whose]
            self._tell()
            return True
        if self._now is turn and self._limit is not None and not turn.begun:
            self.taken(turn)
            self.after(0, turn, self.end)
            return True
        return False

    def _next(self):
        self._now = None
        if not self._waiting:
            return
        whose, queue = self._waiting.popitem(last=False)
        self._now = turn = queue.popleft()
        if queue:
            self._waiting[whose] = queue  # behind the others
        self.turns, self.waited = self.turns + 1, self.waited + time.monotonic() - turn.since
        self._tell()
        self.give(turn)

    def _tell(self):
        for before, queue in enumerate(self._waiting.values(), 1):
            queue[0].tell(before)


_ROOMS = WeakKeyDictionary()  # event loop -> Turns


def rooms():
    """The Turns in which the rooms of this server's pages are created."""
    return _ROOMS.setdefault(IOLoop.current().asyncio_loop, Turns(pause=1.0))
