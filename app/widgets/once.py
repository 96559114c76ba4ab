"""Answers that all pages share: what several ask for is computed once, and what a class opens costs nothing more."""

import threading
from collections import OrderedDict

OTHERS = 0.3  # s between two looks for what is being computed for another page


class Once:
    """The newest answers in memory. most: how many."""

    def __init__(self, most):
        self._most, self._found, self._claimed, self._changing = most, OrderedDict(), set(), threading.Lock()

    def __contains__(self, request):
        return request in self._found

    def find(self, run, request, work, recall=None):
        """The answer to a request (hashable): that of work(), unless it is known or is being computed already. To be
        called within a Run. recall(request): from a store that work() fills, if it is not this memory; None for what
        is not there."""
        while True:
            if (found := (recall or self._recall)(request)) is not None:
                return found
            with self._changing:
                mine = request not in self._claimed
                self._claimed.add(request)
            if not mine:
                run.wait(OTHERS)
                continue
            try:
                found = (recall or self._recall)(request)
                return self._stored(request, work(), recall) if found is None else found
            finally:
                self._claimed.discard(request)

    def _recall(self, request):
        with self._changing:
            if request in self._found:
                self._found.move_to_end(request)
            return self._found.get(request)

    def _stored(self, request, found, elsewhere):
        if not elsewhere:
            with self._changing:
                self._found[request] = found
                while len(self._found) > self._most:
                    self._found.popitem(last=False)
        return found


ONCE = Once(64)  # of at most some 0.2 MB
