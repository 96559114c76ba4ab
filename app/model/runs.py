"""Long computations, in a few threads that all pages share in turns.

The server's own thread answers everybody, so long computations are not done there. A thread cannot be safely stopped
from outside; so a computation checks a flag now and then (look), and ends if its page has closed or wants something
else. A page has one computation of each kind: a newer one replaces the one before.
"""

import logging
import os
import random
import sys
import threading
import time
from collections import Counter
from collections.abc import Callable, Hashable
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import suppress
from contextvars import ContextVar, copy_context
from typing import Any, TypeAlias

from app.model.cores import cores
from app.text import speaking, spoken

NICE = 5  # how much lower the priority of a map is than that of moving something
# A run rests for NAP after each TURN, s, so that the server gets to its other visitors.
TURN, NAP = 0.01, 0.001
SAY = 0.5  # s: visitors who wait longer are told their place in the queue, and how often

_NOW: ContextVar["Run | None"] = ContextVar("run", default=None)
Piece: TypeAlias = Callable[[], None]
Post: TypeAlias = Callable[[Piece], None]  # calls it on a session's own thread
Place: TypeAlias = Callable[[int], None]  # called with a place in a queue, or with 0 when it is left
Result: TypeAlias = Any  # the result of some work, or its exception; whoever began the work knows its type
Document: TypeAlias = Any  # Bokeh's, which is not imported here
log = logging.getLogger("tippe")


class Stopped(Exception):
    """Raised within a run that should end."""


class Full(Stopped):
    """The result of a run that is refused, because too many wait already: this many."""


def stand_back() -> None:
    """Gives this thread, and those that it starts, a lower priority and no more cores than there is time for, on
    systems on which threads have their own."""
    if sys.platform == "linux":
        usable, most = os.sched_getaffinity(0), cores()
        if most < len(usable):
            os.sched_setaffinity(0, random.sample(sorted(usable), most))
        first = os.getpriority(os.PRIO_PROCESS, os.getpid())  # of the thread that answers
        os.setpriority(os.PRIO_PROCESS, threading.get_native_id(), min(first + NICE, 19))


class Pool:
    """A few threads, and a queue for them. Visitors take turns: next is the one with the fewest pieces of work under
    way, and of these the one whose turn was longest ago. The last free thread is reserved for a visitor with none under
    way. most: the number of pieces that may wait; begin: called first in each thread; unasked: whether no visitor has
    asked for this work, so that nobody is told that it waits."""

    def __init__(
        self, threads: int, name: str, most: int = 400, begin: Piece | None = None, *, unasked: bool = False
    ) -> None:
        self.threads, self.most, self.unasked = threads, most, unasked
        self._executor = ThreadPoolExecutor(threads, thread_name_prefix=name, initializer=begin)
        self._waiting: dict[Hashable, list[Piece]] = {}  # visitor -> waiting pieces
        self._working: Counter[Hashable] = Counter()  # how many are under way
        self._since: dict[Piece, float] = {}  # when each waiting piece was added
        self.turns, self.waited = 0, 0.0  # how many pieces were begun, and s that these had waited
        self._places: dict[Hashable, Place] = {}  # visitor who waits -> the function to tell the place
        self._told: dict[Hashable, int] = {}  # the place that was told last
        self._telling = False  # whether _tell() is to be called
        self._changing = threading.Lock()

    def add(self, visitor: Hashable, piece: Piece, place: Place = lambda place: None) -> None:
        """Has the piece called in a thread when its turn comes. place: is called, on another thread, with the place in
        the queue of a visitor who waits for long, and with 0 when the turn has come. Raises Full."""
        with self._changing:
            if len(self._since) >= self.most:
                raise Full(len(self._since))
            self._waiting.setdefault(visitor, []).append(piece)
            self._since[piece] = time.monotonic()
            self._fill()
            if piece in self._since and not self.unasked:
                self._places[visitor] = place
                self._tell_later()

    def remove(self, visitor: Hashable, piece: Piece) -> bool:
        """Removes a piece that still waits; returns whether it did."""
        with self._changing:
            waits = piece in self._waiting.get(visitor, ())
            if waits:
                self._waiting[visitor].remove(piece)
                del self._since[piece]
                if not self._waiting[visitor]:
                    del self._waiting[visitor]
        return waits

    def waiting(self) -> int:
        """The number of pieces that wait for a thread."""
        return len(self._since)

    def _tell_later(self) -> None:
        if not self._telling:
            self._telling = True
            timer = threading.Timer(SAY, self._tell)
            timer.daemon = True
            timer.start()

    def _tell(self) -> None:
        """Tells visitors who have waited long enough, and have nothing under way, each change of their place."""
        with self._changing:
            now, before = time.monotonic(), self._told
            queue = [each for each in self._waiting if not self._working[each]]
            self._told = {each: place for place, each in enumerate(queue, 1)
                          if each in before or now - self._since[self._waiting[each][0]] >= SAY}  # fmt: skip
            news = [(self._places[each], self._told.get(each, 0)) for each in before | self._told
                    if before.get(each) != self._told.get(each)]  # fmt: skip
            self._places = {each: place for each, place in self._places.items() if each in self._waiting}
            self._telling = False
            if self._since or self._told:
                self._tell_later()
        for tell, place in news:
            tell(place)

    def rest(self, visitor: Hashable) -> float:
        """The time (s) for which a piece of this visitor rests after each turn; all pieces of a visitor share one
        share."""
        alone = len(self._working) < 2
        return NAP if alone else NAP + TURN * (self._working[visitor] - 1)

    def _fill(self) -> None:
        while self._waiting and (free := self.threads - self._working.total()):
            visitor = min(self._waiting, key=lambda each: self._working[each])
            if self._working[visitor] and free == 1:
                return
            piece, *later = self._waiting[visitor]
            self._put_last(visitor, later)
            self.turns, self.waited = self.turns + 1, self.waited + time.monotonic() - self._since.pop(piece)
            self._working[visitor] += 1
            with suppress(RuntimeError):  # Python is ending and accepts nothing more
                self._executor.submit(self._do, visitor, piece).add_done_callback(_logged)

    def _do(self, visitor: Hashable, piece: Piece) -> None:
        try:
            piece()
        finally:
            with self._changing:
                self._working[visitor] -= 1
                if not self._working[visitor]:
                    del self._working[visitor]
                self._put_last(visitor, self._waiting.get(visitor))
                self._fill()

    def _put_last(self, visitor: Hashable, waiting: list[Piece] | None) -> None:
        self._waiting.pop(visitor, None)
        if waiting:
            self._waiting[visitor] = waiting


# With all threads busy a visitor waits, and sees that nothing is computed yet.
WORK = Pool(max(2, min(cores() + 1, 4)), "run")
# The rest of a run, for example, which is computed when a hand rests, gives way to what hands wait for.
LATER = Pool(2, "later", begin=stand_back, unasked=True)
FILES = Pool(1, "file", 100)  # matplotlib draws one figure at a time
# Each piece of a map takes all cores for some seconds; with more threads all maps would only be later.
MAPS = Pool(2, "map", 40, stand_back)


class Run:
    """One piece of work. work: a function of this Run, called in a thread; done: a function of the result of work, or
    of the exception that it raised. reached: its progress, as a number of its own."""

    def __init__(self, work: Callable[["Run"], Result], done: Callable[[Result], None]) -> None:
        self.work, self.done = work, done
        self.begun, self.reached, self.stopped = time.monotonic(), 0.0, False
        self._rested = self.begun
        self._drop: Piece | None = None
        self._here: Callable[[], bool] = lambda: True
        self._rest: Callable[[], float] = lambda: NAP

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

    def result(self) -> Result:
        """The result of the work, or the exception that it raised, to be passed to another thread."""
        try:
            return self.work(self) if self._here() else Stopped()
        except Exception as error:
            return error


def look(reached: float = 0.0) -> None:
    """Run.look of the run of this thread; does nothing in other threads."""
    run = _NOW.get()
    if run is not None:
        run.look(reached)


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
            self._under_way.pop(run, None)
            self.post(lambda: run.done(result))

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
        run._drop, run._here, run._rest = drop, self._here, lambda: pool.rest(self)
        try:
            pool.add(self, worked, lambda place: self.post(lambda: self._waits(place)))
        except Full as full:
            waiting = full.args[0]
            tell(full)
            if not pool.unasked:
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


def _logged(future: Future[None]) -> None:
    """Logs the exception of a future that nobody waits for."""
    if not future.cancelled() and future.exception():
        log.error("a run could not be told", exc_info=future.exception())
