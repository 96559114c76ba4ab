"""Votes of a class: rooms in this process's memory, no names, bounded; gone with the teacher's page."""

import secrets
import threading
import time
from dataclasses import dataclass, field

MOST_ROOMS, MOST_VOTES = 100, 400
LASTS = 3 * 3600.0  # s
LETTERS = "23456789ABCDEFGHJKLMNPQRSTUVWXYZ"  # none that is taken for another
CODE_LENGTH = 6
BETWEEN = 1.0  # s between two votes of one page
BURST, EACH_SECOND = 60, 30  # of a room: so many at once, and so many a second after that


class Refused(Exception):
    """A vote or a room that cannot be; its text is a key under [student] or [vote] in teach.toml."""


@dataclass(eq=False)
class Room:
    """One question to a class, which each page says in its own language, and the votes by page.

    step: a lesson.Step; numbers: for the words of its question; asks: a lesson.Choice or Guess.
    """

    code: str
    step: object
    numbers: dict
    asks: object
    born: float
    votes: dict = field(default_factory=dict)
    last: dict = field(default_factory=dict)
    allowance: float = BURST
    refilled: float = 0.0

    def possible(self, value):
        options = getattr(self.asks, "options", None)
        if options is not None:
            return value in options
        return isinstance(value, (int, float)) and self.asks.low <= value <= self.asks.high


class Rooms:
    """All rooms of a process. clock: seconds that only grow; safe from several threads."""

    def __init__(self, clock=time.monotonic):
        self._clock, self._rooms, self._lock = clock, {}, threading.Lock()

    def _forget_old(self):
        old = [code for code, room in self._rooms.items() if self._clock() - room.born > LASTS]
        for code in old:
            del self._rooms[code]

    def open(self, step, numbers, asks):
        """A new Room; Refused("full") where there are too many."""
        with self._lock:
            self._forget_old()
            if len(self._rooms) >= MOST_ROOMS:
                raise Refused("full")
            while (code := "".join(secrets.choice(LETTERS) for _ in range(CODE_LENGTH))) in self._rooms:
                pass
            self._rooms[code] = Room(code, step, numbers, asks, self._clock(), refilled=self._clock())
            return self._rooms[code]

    def close(self, code):
        with self._lock:
            self._rooms.pop(code, None)

    def room(self, code):
        """The Room, or None."""
        with self._lock:
            self._forget_old()
            return self._rooms.get(code)

    def vote(self, code, page, value):
        """Counts the vote of a page (any hashable secret of it) in place of its earlier one, or raises Refused."""
        with self._lock:
            self._forget_old()
            room, now = self._rooms.get(code), self._clock()
            if room is None:
                raise Refused("gone")
            if not room.possible(value):
                raise Refused("wrong")
            room.allowance = min(BURST, room.allowance + EACH_SECOND * (now - room.refilled))
            room.refilled = now
            if now - room.last.get(page, -BETWEEN) < BETWEEN or room.allowance < 1:
                raise Refused("fast")
            if page not in room.votes and len(room.votes) >= MOST_VOTES:
                raise Refused("full")
            room.allowance -= 1
            room.last[page] = now
            room.votes[page] = value

    def tally(self, code):
        """The votes of a room, a list; empty where there is none."""
        with self._lock:
            room = self._rooms.get(code)
            return list(room.votes.values()) if room else []


ROOMS = Rooms()
"""Those of this process: with several workers a room is known to the one that its teacher is on."""
