"""The only thread of a process that talks to the store of votes, and the pages that watch rooms in it."""

import logging
import math
import os
import queue
import threading
import time
from functools import lru_cache

from app.model.votes.ballots import Away, store
from app.model.votes.classroom import LASTS, LOST, USED, VOTES_OF_ADDRESS, Refused, Room, Rooms

LOOK_EVERY = 0.5  # s
PAUSE = 2.0  # s for which the store is not asked again after it did not answer
PHONES_EVERY = 2.0  # s: a phone is told of the votes of others at most this often
MOST_WAITING = 1000

log = logging.getLogger("tippe")


class Desk:
    """The only thread of this process that talks to the store: pages put requests to it, and are called back in that
    thread.

    So a store that does not answer makes no page wait, and what 250 pages watch is read once.
    """

    def __init__(self, where=None, votes_of_address=VOTES_OF_ADDRESS):
        self._where, self._votes_of_address = where, votes_of_address
        self._requested, self._watches, self._used = queue.Queue(MOST_WAITING), set(), {}
        self._thread, self._lock, self._rooms, self._away = None, threading.Lock(), None, (-math.inf, None)

    def keep(self, where, votes_of_address):
        """To be called before anything else, if at all: where votes are stored, as in TIPPE_VOTES."""
        self._where, self._votes_of_address = where, votes_of_address

    def ask(self, work, done):
        """Calls done() with the result of work(Rooms), or with its exception: Refused, Away, or that of a bug."""
        with self._lock:
            if self._thread is None:
                self._thread = threading.Thread(target=self._serve, name="votes", daemon=True)
                self._thread.start()
        try:
            self._requested.put_nowait((work, done))
        except queue.Full:
            done(Away("full"))

    def watch(self, code, told, votes=True):
        """Calls told(Room) now and whenever the room changes (with votes=False, new votes are not told at once),
        told(None) when it is closed, told(Refused("lost")) when the store came back without it, and told(Away) while
        the store does not answer. Returns a function that ends this."""
        watch = Watch(code, told, votes)
        self._watches.add(watch)
        self.ask(lambda rooms: None, lambda result: None)  # wakes the thread if it sleeps
        return lambda: self._watches.discard(watch)

    @property
    def away(self):
        """Whether the store did not answer the last time."""
        return self._away[1] is not None

    def _serve(self):
        due = 0.0
        while True:
            try:
                left = max(0.0, due - time.monotonic()) if self._watches else None
                self._answer(*self._requested.get(timeout=left))
            except queue.Empty:
                pass
            if time.monotonic() >= due and self._watches:
                self._answer(self._look, self._tell)
                due = time.monotonic() + LOOK_EVERY

    def _answer(self, work, done):
        when, error = self._away
        if time.monotonic() - when < PAUSE:
            result = error
        else:
            try:
                result = work(self._opened())
            except Away as away:
                if error is None:
                    log.error("votes are away: %.300s", " ".join(str(away).split()))
                result, self._away = away, (time.monotonic(), away)
            except Exception as error:
                result = error
            else:
                self._away = (-math.inf, None)
        try:
            done(result)
        except Exception:
            log.exception("a page could not be told of its votes")

    def _opened(self):
        if self._rooms is None:
            try:
                where = os.environ.get("TIPPE_VOTES", "") if self._where is None else self._where
                self._rooms = Rooms(store(where, LASTS + 2 * USED), self._votes_of_address)
            except ValueError as error:
                raise Away(f"TIPPE_VOTES is {where!r}; allowed is {error}.") from None
        return self._rooms

    def _look(self, rooms):
        watches = tuple(self._watches)
        now, used = time.monotonic(), {watch.code for watch in watches if watch.votes}  # rooms watched by their owners
        self._used = {code: self._used.get(code, now) for code in used}
        for code, since in self._used.items():
            if now - since > USED:
                rooms.use(code)
                self._used[code] = now
        return watches, rooms.look({watch.code for watch in watches})

    def _tell(self, result):
        if isinstance(result, Away):
            for watch in tuple(self._watches):
                watch.tell(result, result)
        elif isinstance(result, Exception):
            raise result
        else:
            watches, texts = result
            for watch in watches:
                watch.tell(texts.get(watch.code))


@lru_cache(64)
def read(code, text):
    """Room.of(), or Refused("lost"), cached for all pages that watch the room."""
    return Refused("lost") if text == LOST else Room.of(code, text)


class Watch:
    """A page that watches a room."""

    def __init__(self, code, told, votes):
        self.code, self.votes, self._told, self._last = code, votes, told, ...
        self._room, self._when = None, -math.inf

    def tell(self, text, away=None):
        """Tells the page what is there now, if that has changed."""
        if away is not None:
            if self.votes and not isinstance(self._last, Away):
                self._last = away
                self._told(away)
            return
        if text == self._last or (text is None and self._last == LOST):
            return
        room = read(self.code, text)
        if not self.votes and self._waits(room):
            return
        self._last, self._room, self._when = text, room, time.monotonic()
        self._told(room)

    def _waits(self, room):
        """Whether only votes have changed, too soon after the last time; they will come with a later look."""
        before, early = self._room, time.monotonic() - self._when < PHONES_EVERY
        both = isinstance(room, Room) and isinstance(before, Room)
        return both and early and (room.step, room.shown) == (before.step, before.shown)


DESK = Desk()
"""The Desk of this process."""
