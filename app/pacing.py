"""Keeps the picture under the hand: of a stream of requests only the newest is solved, once the last was painted."""

import time

import param
from panel.custom import JSComponent

# While a person drags, the whole page follows this often at least; in between only the first stage does.
WHOLE_PAGE_EVERY = 0.25
# A hidden tab paints nothing and so never answers.
ANSWER_WITHIN = 2.0


class Painted(JSComponent):
    """Answers `sent` with the same number in `painted`, after the browser painted all that came before it."""

    sent = param.Integer(default=0)
    painted = param.Integer(default=0)

    _esm = """
    export function render({model}) {
      model.on("sent", () => requestAnimationFrame(() => setTimeout(() => { model.painted = model.sent })))
    }
    """


class Pacer:
    """Between the controls and an Explorer, and between its scenes and the views.

    stages: functions of a scene, the first the cheap picture of what the hand moves, the others the rest of the page.
    """

    def __init__(self, explorer, *stages):
        self.explorer, self.stages = explorer, stages
        self.painted = Painted(width=0, height=0, margin=0)
        self._wanted, self._to_show = {}, []
        self._sent_at = self._whole_at = None
        explorer.param.watch(self._show, "scene")
        self.painted.param.watch(self._on_painted, "painted")

    def request(self, **inputs):
        """Asks for these inputs of the Explorer; a later request for the same input replaces one still waiting."""
        self._wanted.update(inputs)
        if self._sent_at is None or time.monotonic() - self._sent_at > ANSWER_WITHIN:
            self._solve()

    def _solve(self):
        inputs, self._wanted = self._wanted, {}
        self.explorer.param.update(**inputs)

    def _show(self, event):
        self._to_show = list(self.stages)
        self._next_stage()

    def _next_stage(self):
        self._to_show.pop(0)(self.explorer.scene)
        self._sent_at = time.monotonic()
        if not self._to_show:
            self._whole_at = self._sent_at
        self.painted.sent += 1

    def _on_painted(self, event):
        if event.new != self.painted.sent:
            return
        self._sent_at = None
        overdue = self._whole_at is None or time.monotonic() - self._whole_at > WHOLE_PAGE_EVERY
        if self._to_show and (overdue or not self._wanted):
            self._next_stage()
        elif self._wanted:
            self._solve()
