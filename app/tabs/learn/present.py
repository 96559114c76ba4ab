"""The teacher's side of a class: a room that asks the question of the step on the big screen, and what the screen may
show of it."""

from itertools import pairwise

import numpy as np
import panel as pn

from app.model.lesson import lesson
from app.model.lesson.parts import Choice
from app.model.votes.ballots import Away
from app.model.votes.classroom import Refused
from app.state.names import VOTE, is_local, query
from app.tabs.learn.poll import Counter, page_address, question_of, refusal
from app.widgets.codes import qr

BINS = 12


def counts(step, votes):
    """[what, how many]: of the options by their keys, of numbers by intervals."""
    if isinstance(step.asks, Choice):
        return [[key, votes.count(key)] for key in step.asks.options]
    found, edges = np.histogram(votes, bins=BINS, range=(step.asks.low, step.asks.high))
    return [
        [f"{low:.4g} \N{EN DASH} {high:.4g}", int(n)] for (low, high), n in zip(pairwise(edges), found, strict=True)
    ]


class Teacher:
    """kept: its `room` is the key of the room, or "", its `step` the one on the screen; now: the present scene; show:
    called with what the screen has of the room, a dict, {} if none is open.

    Requests are passed to the room one after the other, each with the step that is on the screen by then.
    """

    def __init__(self, kept, now, show):
        self._kept, self._now, self._show = kept, now, show
        self._counter, self._room, self._wish, self._busy = Counter(), None, None, False
        self.come_back()

    def come_back(self):
        """Returns to the room whose key came with the address."""
        key = self._kept.room
        if key and self._room is None and not self._busy:
            self._do(lambda rooms: rooms.owned(key))

    def present(self):
        """Opens a room, unless one is open."""
        if self._room is None and not self._busy and not self._kept.room:
            question, address = self._question(), self._counter.address

            def work(rooms):
                room, self._kept_key = rooms.open(address, **question)
                return room

            self._do(work)

    def reveal(self):
        self._wishes(lambda rooms: rooms.reveal(self._kept.room))

    def reset(self):
        self._wishes(lambda rooms: rooms.reset(self._kept.room))

    def close(self):
        """Ends the class: its votes are deleted."""
        key = self._kept.room
        if key:
            self._forget("")
            self._counter.ask(lambda rooms: rooms.close(key), lambda result: None)

    def follow(self):
        """To be called when the step on the screen may have changed."""
        if self._room is not None and self._room.step != self._kept.step:
            self._wishes(None)

    def _question(self):
        return question_of(lesson.OF_NAME[self._kept.step], self._now())

    def _wishes(self, work):
        if self._room is None:
            return
        self._wish = work or self._wish
        if not self._busy:
            self._next()

    def _next(self):
        """Sends first the step, then the requests."""
        if self._room is not None and self._room.step != self._kept.step:
            question = self._question()
            self._do(lambda rooms: rooms.ask(self._kept.room, **question))
        elif self._wish:
            work, self._wish = self._wish, None
            self._do(work)

    def _do(self, work):
        self._busy = True
        self._counter.ask(work, self._done)

    def _done(self, result):
        self._busy = False
        if not self._refused(result):
            self._take(result)
            self._next()

    def _refused(self, result):
        """Says so if there is no room, or if it cannot be reached."""
        if isinstance(result, Refused):
            self._forget(refusal("vote", result))
        elif isinstance(result, Away):
            self._tell(refusal("vote", result))
        return isinstance(result, (Refused, Away))

    _kept_key = ""

    def _take(self, room):
        first, new = self._room is None, self._kept_key
        self._room = room
        if self._kept_key:
            self._kept.room, self._kept_key = self._kept_key, ""
        if first and not new and room.step in lesson.OF_NAME:
            self._kept.step = room.step  # the class continues where it was
        if first:
            self._counter.watch(room.code, self._news)
        self._tell("")

    def _news(self, room):
        if not self._refused(room or Refused("over")):
            self._room = room
            self._tell("")

    def _tell(self, sentence):
        room = self._room
        if room is None:
            self._show({"wording": sentence} if sentence else {})
            return
        address = page_address() + query({VOTE: room.code})
        # nobody sees the votes of others before the answer is shown
        found = counts(lesson.OF_NAME[room.step], list(room.votes)) if room.shown else []
        self._show({
            "code": room.code, "address": address, "step": room.step, "shown": room.shown, "counts": found,
            "voted": len(room.votes), "phones": max(room.phones, len(room.votes)), "wording": sentence,
            "local": is_local(pn.state.location.hostname),
            "picture": qr(address, border=2),
        })  # fmt: skip

    def _forget(self, sentence):
        """Drops the room, which no longer exists, and says why."""
        self._counter.leave()
        self._room, self._wish, self._kept.room = None, None, ""
        self._tell(sentence)
