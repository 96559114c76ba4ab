"""The threads that all pages share, and whose turn it is."""

import logging
import math
import os
import random
import sys
import threading
import time
from collections import Counter
from collections.abc import Callable, Hashable
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import suppress
from typing import TypeAlias

from app.model.cores import cores

NICE = 5  # how much lower the priority of a map is than that of moving something
# A run rests for NAP after each TURN, s, so that the server gets to its other visitors.
TURN, NAP = 0.01, 0.001
SAY = 0.5  # s: visitors who wait longer are told their place in the queue, and how often

Piece: TypeAlias = Callable[[], None]
Place: TypeAlias = Callable[[int], None]  # called with a place in a queue, or with 0 when it is left
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
    asked for this work, so that nobody is told that it waits; slice: s after which a piece gives way to one that waits,
    and goes on in its turn."""

    def __init__(
        self, threads: int, name: str, most: int = 400, begin: Piece | None = None, *, unrequested: bool = False,
        slice: float = math.inf,
    ) -> None:  # fmt: skip
        self.threads, self.most, self.unrequested, self.slice = threads, most, unrequested, slice
        kept = threads if slice == math.inf else threads + most  # a piece that gives way keeps its thread
        self._executor = ThreadPoolExecutor(kept, thread_name_prefix=name, initializer=begin)
        self._resuming: set[Piece] = set()  # those that wait to go on
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
            if self.waiting() >= self.most:
                raise Full(self.waiting())
            self._waiting.setdefault(visitor, []).append(piece)
            self._since[piece] = time.monotonic()
            self._fill()
            if piece in self._since and not self.unrequested:
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
        """The number of pieces that have not begun."""
        return len(self._since) - len(self._resuming)

    def give_way(self, visitor: Hashable, away: float = 0.0) -> None:
        """Called by a piece under way: lets those that wait be done first, each for its slice, and then returns. away:
        for so many s it waits for something else."""
        go = threading.Event()
        with self._changing:
            if not away and not self._waiting:
                return
            self._ended(visitor)
        time.sleep(away)
        with self._changing:
            self._resuming.add(go.set)
            self._since[go.set] = time.monotonic()
            self._waiting.setdefault(visitor, []).insert(0, go.set)
            self._fill()
        go.wait()

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
            queue = [each for each, pieces in self._waiting.items()
                     if not self._working[each] and pieces[0] not in self._resuming]  # fmt: skip
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
            if piece in self._resuming:
                self._resuming.remove(piece)
                del self._since[piece]
                self._working[visitor] += 1
                piece()
                continue
            self.turns, self.waited = self.turns + 1, self.waited + time.monotonic() - self._since.pop(piece)
            self._working[visitor] += 1
            with suppress(RuntimeError):  # Python is ending and accepts nothing more
                self._executor.submit(self._do, visitor, piece).add_done_callback(_logged)

    def _do(self, visitor: Hashable, piece: Piece) -> None:
        try:
            piece()
        finally:
            with self._changing:
                self._ended(visitor)

    def _ended(self, visitor: Hashable) -> None:
        self._working[visitor] -= 1
        if not self._working[visitor]:
            del self._working[visitor]
        self._put_last(visitor, self._waiting.get(visitor))
        self._fill()

    def _put_last(self, visitor: Hashable, waiting: list[Piece] | None) -> None:
        self._waiting.pop(visitor, None)
        if waiting:
            self._waiting[visitor] = waiting


def _logged(future: Future[None]) -> None:
    """Logs the exception of a future that nobody waits for."""
    if not future.cancelled() and future.exception():
        log.error("a run could not be told", exc_info=future.exception())


# With all threads busy a visitor waits, and sees that nothing is computed yet.
WORK = Pool(max(2, min(cores() + 1, 4)), "run")
# The rest of a run, for example, which is computed when a hand rests, gives way to what hands wait for.
LATER = Pool(2, "later", begin=stand_back, unrequested=True)
FILES = Pool(1, "file", 100)  # matplotlib draws one figure at a time
# A map takes all cores; with more threads all maps would only be later. A short one overtakes a long one.
MAPS = Pool(2, "map", 40, stand_back, slice=1.0)
