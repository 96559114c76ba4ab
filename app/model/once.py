"""Answers that all pages share: what several ask for is computed once, and what a class opens costs nothing more."""

import threading
from collections import OrderedDict
from collections.abc import Callable, Hashable
from typing import Any, TypeAlias

Answer: TypeAlias = Any  # whoever asks knows its type

OTHERS = 0.3  # s between two looks for what is being computed for another page


class Once:
    """The newest answers in memory. most: how many."""

    def __init__(self, most: int) -> None:
        self._most, self._changing = most, threading.Lock()
        self._found: OrderedDict[Hashable, Answer] = OrderedDict()
        self._claimed: set[Hashable] = set()

    def __contains__(self, request: Hashable) -> bool:
        return request in self._found

    def find(
        self, wait: Callable[[float], object], request: Hashable, work: Callable[[], Answer],
        recall: Callable[[Any], Answer] | None = None,
    ) -> Answer:  # fmt: skip
        """The answer to a request: that of work(), unless it is known or is being computed already. wait(s): called
        between two looks for what another computes, such as Run.wait; what it raises ends this. recall(request): from a
        store that work() fills, if it is not this memory; None for what is not there."""
        while True:
            if (found := (recall or self._recall)(request)) is not None:
                return found
            with self._changing:
                mine = request not in self._claimed
                self._claimed.add(request)
            if not mine:
                wait(OTHERS)
                continue
            try:
                found = (recall or self._recall)(request)
                if found is None:
                    found = work()
                    if not recall:
                        self._store(request, found)
                return found
            finally:
                self._claimed.discard(request)

    def _recall(self, request: Hashable) -> Answer:
        with self._changing:
            if request in self._found:
                self._found.move_to_end(request)
            return self._found.get(request)

    def _store(self, request: Hashable, found: Answer) -> None:
        with self._changing:
            self._found[request] = found
            while len(self._found) > self._most:
                self._found.popitem(last=False)


ONCE = Once(64)  # of at most some 0.2 MB
