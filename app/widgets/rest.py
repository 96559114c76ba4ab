"""When a hand is at rest: one definition for the whole page."""

import time

from app.widgets.failure import after

REST = 0.25  # s


class Rest:
    """Calls act() once nothing has moved for REST, with one timer for all movements; is_held: whether a hand that does
    not move is still down. is_due: whether something has moved since."""

    def __init__(self, act, is_held=bool):
        self._act, self._is_held, self._last, self.is_due = act, is_held, 0.0, False

    def moved(self):
        """To be called with each movement."""
        self._last = time.monotonic()
        if not self.is_due:
            self._wait(REST)

    def _wait(self, seconds):
        self.is_due = True
        after(seconds, self._look)

    def _look(self):
        self.is_due = False
        left, held = self._last + REST - time.monotonic(), True
        if left > 0:
            self._wait(left)
            return
        try:
            held = self._is_held()
        finally:  # also where that fails
            if held:
                self._wait(REST)
        if not held:
            self._act()
