"""Keeps the picture under the hand: of a stream of requests only the newest is solved, once the last was painted."""

import time

import panel as pn
import param
from panel.custom import JSComponent

# Two, so that one is on its way while the browser paints the other.
HANDS_IN_FLIGHT = 1
# A hidden tab paints nothing and so never answers.
ANSWER_WITHIN = 2.0


def at_once(component, *properties):
    """Lets these properties of a Panel component arrive without Panel's wait of 50 ms, and without its busy signal."""
    component._priority_changes = component._busy__ignore = list(properties)


class Painted(JSComponent):
    """Answers `sent` with the same number in `painted`, after the browser painted all that came before it."""

    sent = param.Integer(default=0)
    painted = param.Integer(default=0)
    narrow = param.Boolean(default=False, doc="whether the window is too narrow for controls beside the pictures")

    _esm = """
    export function render({model}) {
      if (innerWidth < 900) model.narrow = true
      model.on("sent", () => requestAnimationFrame(() => setTimeout(() => { model.painted = model.sent })))
    }
    """


class Pacer:
    """Between the controls and an Explorer, and between its scenes and the views.

    hand and rest: functions of a scene; hand draws what the hand moves and is cheap, rest draws all else. The newest
    request is solved and drawn by `hand` once the one before is painted; `rest` follows when its own last picture is
    painted, and leaves out scenes that have been overtaken.
    """

    def __init__(self, explorer, hand, rest):
        self.explorer, self._hand, self._rest = explorer, hand, rest
        self.painted = Painted(width=0, height=0, margin=0)
        at_once(self.painted, "painted")
        self._wanted, self._rest_is_due = {}, False
        self._hands, self._rests = [], []  # (number, when sent) of what the browser has yet to paint
        explorer.param.watch(self._on_scene, "scene")
        self.painted.param.watch(self._on_painted, "painted")

    def request(self, **inputs):
        """Asks for these inputs of the Explorer; a later request for the same input replaces one still waiting."""
        self._wanted.update(inputs)
        self._advance()

    def _advance(self):
        late = time.monotonic() - ANSWER_WITHIN
        self._hands = [sent for sent in self._hands if sent[1] > late]
        self._rests = [sent for sent in self._rests if sent[1] > late]
        if self._wanted and not self._hands:
            inputs, self._wanted = self._wanted, {}
            self.explorer.param.update(**inputs)

    def _on_scene(self, event):
        self._send(self._hand, self._hands)
        self._rest_is_due = True

    def _send(self, draw, in_flight):
        with pn.io.hold():  # one message, in order, so that the answer comes after the pictures
            draw(self.explorer.scene)
            self.painted.sent += 1
        in_flight.append((self.painted.sent, time.monotonic()))

    def _on_painted(self, event):
        self._hands = [sent for sent in self._hands if sent[0] > event.new]
        self._rests = [sent for sent in self._rests if sent[0] > event.new]
        self._advance()
        if self._rest_is_due and not self._rests:
            self._rest_is_due = False
            self._send(self._rest, self._rests)
