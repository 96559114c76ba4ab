"""Keeps the pictures under the hand: of a stream of requests only the newest is solved, once the last scene was
painted."""

import time
from contextlib import ExitStack
from functools import partial

import panel as pn
import param

from app.borrowed import at_once
from app.bundle import Bundled
from app.widgets.failure import after, attempt
from app.widgets.hold import held
from app.widgets.rest import REST, Rest

# Two, so that one can be on its way while the browser paints the other.
HANDS_IN_FLIGHT = 2
STILL_AFTER = 0.6  # s: a hand that moves in steps rests between them, but is not still
# A hidden browser tab paints nothing and so never answers.
ANSWER_WITHIN = 2.0


class Painted(Bundled):
    """Answers `sent` with the same number in `painted`, once the browser has painted everything that came before it."""

    sent = param.Integer(default=0)
    painted = param.Integer(default=0)


class RenderScheduler:
    """Stands between the hands and an Explorer, and between its scenes and the views. In one direction: a hand asks,
    the Explorer solves, and the one scene comes here, to be shown.

    Views say when they show scenes: shows(). "hand" is for what a hand moves, and is cheap. The "pictures" follow in
    turn, each in a message of its own once the one before is painted, so that a hand never waits for more than one; a
    round of them shows one scene, the newest at its start. "rest" is for a hand at rest, or for an input that is
    refused; "still" for what takes longer than a step, and waits until the hand has gone, and at first until the page
    has loaded. After a single step pictures and "rest" come in one message, because each message costs the server more
    than its contents.
    """

    def __init__(self, explorer):
        self._explorer = explorer
        self._shows = {"hand": [], "pictures": [], "rest": [], "still": []}
        self.painted = Painted(width=0, height=0, margin=0)
        at_once(self.painted, "painted")
        self._wanted, self._round, self._round_is_due, self._resting = {}, [], False, True
        self._single = True  # whether the hand was at rest before the last request
        self._rested = None  # the scene that was shown to "rest" since then
        self._stayed = explorer.scene  # the scene that was last shown to "still"
        self._rest = Rest(self._rests, self._is_asking)
        self._later, self._begun = [], False
        self._hands, self._drawing = [], []  # (number, time of sending) of what the browser has yet to paint
        self._sent = 0  # the last number
        explorer.param.watch(self._on_scene, "scene")
        self.painted.param.watch(self._on_painted, "painted")

    def shows(self, show, when):
        """Calls show(scene) now, and from now on when a scene is to be shown; when is "hand", "pictures", "rest" or
        "still"."""
        if when == "still":
            self.later(lambda: show(self._explorer.scene))
        else:
            show(self._explorer.scene)
        self._shows[when].append(show)

    def begin(self):
        """To be called when the page has loaded."""
        self._begun = True
        self._advance()
        after(ANSWER_WITHIN, self._finish)

    def soon(self, make):
        """Runs a function that adds something to the page, before anything else that waits: two such messages under way
        at the same time may each depend on the other."""
        if not self._begun:
            make()
            return
        self._later.insert(0, make)
        self._advance()
        after(ANSWER_WITHIN, self._finish)

    def now(self, make):
        """Runs a function that adds something to the page, for which it has waited already: at once, whatever the
        browser has yet to paint."""
        self._send(make, self._drawing)

    def later(self, make):
        """Runs a function that adds something to the page which is not needed at first: after the page has loaded, in
        turn with the pictures, after everything else that waits."""
        self._later.append(make)
        if self._begun:
            after(ANSWER_WITHIN, self._finish)

    def ask(self, **inputs):
        """Requests these inputs of the Explorer; a later request for the same input replaces one that still waits."""
        self._wanted.update(inputs)
        self._single, self._rested = self._resting, None  # a request is answered even if nothing changes
        self._resting = False
        self._rest.moved()
        self._advance()

    def _advance(self):
        late = time.monotonic() - ANSWER_WITHIN
        self._hands = [sent for sent in self._hands if sent[1] > late]
        self._drawing = [sent for sent in self._drawing if sent[1] > late]
        if self._wanted and len(self._hands) < HANDS_IN_FLIGHT:
            inputs, self._wanted = self._wanted, {}
            self._explorer.set(**inputs)
        if not self._drawing and not (self._single and self._hands):
            if not self._round and self._round_is_due:
                scene, self._round_is_due = self._explorer.scene, False
                draws = [self._all] if self._single else self._shows["pictures"]
                self._round = [partial(draw, scene) for draw in draws]
            if self._round:
                self._send(self._round.pop(0), self._drawing)
            elif self._begun and self._later:
                self._send(self._later.pop(0), self._drawing)

    def _all(self, scene):
        with ExitStack() as others:
            others.callback(self._say, scene)
            others.callback(_each, self._shows["pictures"], scene)

    def _say(self, scene):
        if scene is not self._rested:
            self._rested = scene
            _each(self._shows["rest"], scene)

    def _on_scene(self, event):
        self._send(partial(_each, self._shows["hand"], event.new), self._hands)
        self._round_is_due = True
        if self._resting or event.new.messages or event.old.messages:
            self._say(event.new)
        if self._resting:
            after(STILL_AFTER, partial(self._stay, event.new))

    def _is_asking(self):
        self._advance()  # also for a hidden tab, which sends no answer that would do it
        return bool(self._wanted)

    def _rests(self):
        self._resting, scene = True, self._explorer.scene
        self._say(scene)
        self._finish_later()
        after(STILL_AFTER - REST, partial(self._stay, scene))

    def _stay(self, scene):
        if self._resting and scene is self._explorer.scene and scene is not self._stayed:
            self._stayed = scene
            self.later(partial(self._show_still, scene))
            self._advance()

    def _show_still(self, scene):
        if scene is self._explorer.scene:
            _each(self._shows["still"], scene)

    def _finish_later(self):
        if self._round or self._round_is_due or (self._begun and self._later):
            after(ANSWER_WITHIN, self._finish)

    def _finish(self):
        """Also shows the pictures of a tab that does not answer, after a time."""
        self._advance()
        self._finish_later()

    def _send(self, draw, in_flight):
        self._sent = number = self._sent + 1

        def sent():
            draw()
            self.painted.sent = number

        if self._begun or not pn.state.curdoc:
            with held():  # one message, in order, so that the answer comes after the picture
                sent()
        else:  # until the page has loaded Bokeh sends only changes that are made under its lock
            pn.state.curdoc.add_next_tick_callback(partial(attempt, sent))
        in_flight.append((number, time.monotonic()))

    def _on_painted(self, event):
        self._hands = [sent for sent in self._hands if sent[0] > event.new]
        self._drawing = [sent for sent in self._drawing if sent[0] > event.new]
        self._advance()


def _each(shows, scene):
    """Shows a scene in all views, even if one of them fails."""
    with held(), ExitStack() as others:
        for show in reversed(shows):
            others.callback(show, scene)
