"""Long computations, in a few threads that all pages share in turns.

The server's own thread answers everybody, so long computations are not done there. A thread cannot be safely stopped
from outside; so a computation checks a flag now and then (look), and ends if its page has closed or wants something
else. A page has one computation of each kind: a newer one replaces the one before.
"""

import math
import time
from collections.abc import Callable
from contextvars import ContextVar, copy_context
from functools import partial
from typing import Any, TypeAlias

from app.model.pool import FILES, LATER, MAPS, NAP, NICE, TURN, WORK, Full, Piece, Place, Pool, Stopped, stand_back
from app.text import speaking, spoken

__all__ = ["FILES", "LATER", "MAPS", "NICE", "TURN", "WORK", "Full", "Pool", "Run", "Runs", "Stopped", "connected_to",
           "look", "stand_back", "to_session"]  # fmt: skip

_NOW: ContextVar["Run | None"] = ContextVar("run", default=None)
Post: TypeAlias = Callable[[Piece], None]  # calls it on a session's own thread
Result: TypeAlias = Any  # the result of some work, or its exception; whoever began the work knows its type
Document: TypeAlias = Any  # Bokeh's, which is not imported here


class Run:
    """One piece of work. work: a function of this Run, called in a thread; done: a function of the result of work, or
    of the exception that it raised. reached: its progress, as a number of its own."""

    def __init__(self, work: Callable[["Run"], Result], done: Callable[[Result], None]) -> None:
        self.work, self.done = work, done
        self.begun, self.reached, self.stopped = time.monotonic(), 0.0, False
        self._rested = self._gave_way = self.begun
        self._drop: Piece | None = None
        self._here: Callable[[], bool] = lambda: True
        self._rest: Callable[[], float] = lambda: NAP
        self._slice = math.inf
        self._give_way: Callable[[float], None] = time.sleep

    def enter(self, pool: Pool, page: object, drop: Piece, here: Callable[[], bool]) -> None:
        """Gives it a place in a pool, as work of a page. drop: takes it out of the queue; here: whether the page is
        connected."""
        self._drop, self._here, self._rest = drop, here, lambda: pool.rest(page)
        self._slice, self._give_way = pool.slice, partial(pool.give_way, page)

    @property
    def elapsed(self) -> float:
        """The time taken so far, s."""
        return time.monotonic() - self.begun

    def stop(self) -> None:
        """Ends it: at once if it still waits for a thread, otherwise at its next look()."""
        if self.stopped:
            return
        self.stopped = True
        if self._drop:
            self._drop()

    def forget(self) -> None:
        """Ends it without calling done, because something else is wanted by now."""
        self.done = lambda result: None
        self.stop()

    def look(self, reached: float = 0.0) -> None:
        """To be called often from within the work: raises Stopped if the run should end."""
        self.reached = reached
        if self.stopped or not self._here():
            raise Stopped
        if time.monotonic() - self._rested > TURN:
            time.sleep(self._rest())
            self._rested = time.monotonic()
        if self._rested - self._gave_way > self._slice:
            self.wait(0.0)

    def wait(self, seconds: float) -> None:
        """Lets the work of others be done, for so many s at least; raises Stopped if the run should end."""
        self._give_way(seconds)
        self._gave_way = time.monotonic()
        if self.stopped or not self._here():
            raise Stopped

    def result(self) -> Result:
        """The result of the work, or the exception that it raised, to be passed to another thread."""
        self._rested = self._gave_way = time.monotonic()  # it may have waited for its turn
        try:
            return self.work(self) if self._here() else Stopped()
        except Exception as error:
            return error


def look(reached: float = 0.0) -> None:
    """Run.look of the run of this thread; does nothing in other threads."""
    run = _NOW.get()
    if run is not None:
        run.look(reached)


class TooLong(Exception):
    """A run takes longer than anybody wants to wait, for example that of a rim that chatters."""


def patience(most: int) -> Callable[[float], None]:
    """A function like look() that raises TooLong after so many calls."""
    left = iter(range(most))

    def patient(reached: float) -> None:
        look(reached)
        if next(left, None) is None:
            raise TooLong

    return patient


def to_session(document: Document) -> Post:
    """A function that calls another on the thread of a Bokeh document's session, for Runs. To be called on that thread;
    the function itself may be called on any.

    Bokeh's add_next_tick_callback is safe on other threads only while nothing holds the document's changes back, as
    Panel often does: otherwise the request joins these, and is lost if they are let go at the same moment. So the
    server's own thread makes it.
    """
    loop, here = _loop_of(document), copy_context()  # to whose session it is charged: server/loop.py

    def request(function: Piece) -> None:
        try:
            document.add_next_tick_callback(function)
        except AttributeError:
            # Bokeh destroys a document and reports only afterwards that its session has ended.
            if document.session_context is not None:
                raise

    return (lambda function: loop.add_callback(here.run, request, function)) if loop else request


def _loop_of(document: Document) -> Any:
    """The event loop of the server that serves a Bokeh document; None if none does."""
    server = document.session_context and document.session_context.server_context
    application = server and server.application_context
    return application and application.io_loop


def connected_to(document: Document) -> Callable[[], bool]:
    """A function that tells whether the page of a Bokeh document is connected, not only its session left, for Runs."""

    def here() -> bool:
        session = document.session_context and document.session_context.session
        return bool(session and session.connection_count)

    return here


class Runs:
    """The work of one page: one piece of each kind.

    post: calls a function on the session's own thread; if None, work is done at once, without a thread. here: whether
    the page is still connected; otherwise nothing is begun, and its work ends. waits: is called with the page's place
    in a queue, 0 when it is no longer in one; full: is called with the number of those that wait, if no more may.
    """

    def __init__(
        self,
        post: Post | None = None,
        here: Callable[[], bool] = lambda: True,
        waits: Place = lambda place: None,
        full: Callable[[int], None] = lambda waiting: None,
    ) -> None:
        self._post, self._here, self._left = post, here, False
        self._waits, self._full = waits, full
        self._under_way: dict[Run, str] = {}

    @property
    def beside(self) -> bool:
        """Whether there are threads."""
        return self._post is not None

    def begin(self, run: Run, kind: str, pool: Pool = WORK) -> None:
        """Has the work done, in the language of this page, and then calls done on the session's thread. Earlier work of
        the same kind ends without an answer: only the newest answers."""
        if self._left:
            return
        if not self.beside:
            run.done(run.result())
            return
        language = spoken()

        def tell(result: Result) -> None:
            def done() -> None:
                self._under_way.pop(run, None)  # not before: until then a newer one has it forgotten
                run.done(result)

            self.post(done)

        def worked() -> None:
            now = _NOW.set(run)
            try:
                with speaking(language):
                    result = run.result()
            finally:
                _NOW.reset(now)  # otherwise the thread would keep the page alive
            tell(result)

        def drop() -> None:
            if pool.remove(self, worked):
                tell(Stopped())

        for before, its_kind in tuple(self._under_way.items()):
            if its_kind == kind:
                before.forget()
        self._under_way[run] = kind
        run.enter(pool, self, drop, self._here)
        try:
            pool.add(self, worked, lambda place: self.post(lambda: self._waits(place)))
        except Full as full:
            waiting = full.args[0]
            tell(full)
            if not pool.unrequested:
                self.post(lambda: self._full(waiting))

    def post(self, function: Piece) -> None:
        """Calls a function on the session's thread, unless the page has closed."""
        if self._left:
            return
        if self._post is not None:
            self._post(function)
        else:
            function()

    def leave(self) -> None:
        """Ends all work of the page, which has closed."""
        self._left = True
        for run in tuple(self._under_way):
            run.stop()
