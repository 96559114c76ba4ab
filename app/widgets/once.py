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

    def find(self, run, request, work):
        """The answer to what is asked (hashable): that of work(), unless it is known or is being computed already.
        To be called within a Run."""
        while True:
            with self._changing:
                if request in self._found:
                    self._found.move_to_end(request)
                    return self._found[request]
                if mine := request not in self._claimed:
                    self._claimed.add(request)
            if not mine:
                run.wait(OTHERS)
                continue
            try:
                found = work()
                with self._changing:
                    self._found[request] = found
                    while len(self._found) > self._most:
                        self._found.popitem(last=False)
                return found
            finally:
                self._claimed.discard(request)


ONCE = Once(64)  # of at most some 0.2 MB
