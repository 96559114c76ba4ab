"""Admission of visitors, and how much of the server's own thread each session may take."""

import math
import time
from collections import Counter

from app.server.memory import FILLED, memory, memory_limit
from app.turns import Turns

SHARE = 0.5  # of the thread, for all sessions together that take more than a little
LIGHT, SAVED = 0.2, 0.2  # s that a session saves up in each s in which it says nothing, and in all
SPARE = 1.5  # s that they can take before any of them waits
SLOW = 0.25  # s of waiting that the log tells


class Admission:
    """Counts sessions, and lets them be made in turn. context: Bokeh's application context of the page."""

    def __init__(self, settings, context):
        self.settings, self._context = settings, context
        self.sockets = set()  # of pages that were let in
        self.making = Turns(pause=0.25)
        self.stopping, self.refused = False, Counter()  # why -> how often
        self.moves, self.moving = 0, 0.0  # how many messages were answered, and s that this took in all
        self._most = FILLED * memory_limit() / settings.workers

    @property
    def sessions(self):
        return list(self._context.sessions)

    @property
    def full(self):
        """Whether no more pages are let in; a session whose page has closed keeps nobody out."""
        open_pages = sum(bool(each.connection_count) for each in self.sessions)
        return open_pages + self.making.waiting() >= self.settings.sessions or memory() > self._most

    @property
    def served(self):
        """Whether there has been any visitor."""
        return self.making.turns > 0

    @property
    def idle(self):
        """Whether there is no visitor, nor one about to enter."""
        return not (self.sessions or self.sockets or self.making.waiting())

    def moved(self, took):
        """Counts a message that was answered after so many s."""
        self.moves, self.moving = self.moves + 1, self.moving + took

    def refusal(self, address):
        """The reason for refusing a page, a key of [server] in main.toml; None if there is room."""
        if self.stopping:
            return "stopping"
        left = [session for session in self.sessions if not session.connection_count]  # for its page to come back
        full = self.full
        if full or len(self.sessions) + self.making.waiting() >= self.settings.sessions:
            for session in left:
                session.request_expiration()
        if full:
            return "full"
        mine = [session for session in left if getattr(session, "address", None) == address]
        here = sum(socket.address == address for socket in self.sockets)
        if here + len(mine) >= self.settings.sessions_per_address:
            for session in mine:
                session.request_expiration()
            return "crowded"
        return None


class Budget:
    """What a session takes of the server's thread. It saves up a little of it while it says nothing. Those that take
    more have one share together: each waits until what all of them have taken is paid for, and nothing is read from it
    meanwhile. What is done in turn (app/turns.py) is not charged: there others are served between."""

    _paid = -math.inf  # when what these sessions have taken will be paid for

    def __init__(self):
        self.left, self.spent, self.in_turn = SAVED, 0.0, 0.0

    def rest(self, seconds):
        """It said nothing for so many seconds."""
        self.left = min(SAVED, max(0.0, self.left) + LIGHT * seconds)

    def spend(self, seconds):
        """Charges seconds of the thread, less those that were its turn."""
        seconds, self.in_turn = max(0.0, seconds - self.in_turn), 0.0
        self.left, self.spent = self.left - seconds, self.spent + seconds

    def wait(self):
        """The time to wait before more is read, s."""
        spent, self.spent = self.spent, 0.0
        if self.left >= 0:
            return 0.0
        now = time.monotonic()
        Budget._paid = max(Budget._paid, now - spent - SPARE / SHARE) + spent / SHARE
        return max(0.0, Budget._paid - now)
