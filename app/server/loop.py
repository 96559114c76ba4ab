"""How the event loop of a server works: all of a session's code in its own thread, charged to that session."""

import asyncio
import time
from collections.abc import Coroutine

from app.turns import CHARGED


def in_one_thread(loop):
    """Lets what is given to an executor be done at once, in the loop's own thread. Bokeh from 3.10 on gives it the
    callbacks of sessions; that is not faster, and while one runs, Panel may change the same session in the loop."""

    def at_once(executor, function, *arguments):
        future = loop.create_future()
        try:
            future.set_result(function(*arguments))
        except BaseException as error:
            future.set_exception(error)
        return future

    loop.run_in_executor = at_once


class Charged(Coroutine):
    """A coroutine that charges to a Budget what it does itself, and not what others do while it waits."""

    def __init__(self, coroutine, budget):
        self._coroutine, self._budget = coroutine, budget

    def _step(self, step, *given):
        start = time.thread_time()  # of this thread: runs beside it are others'
        try:
            return step(*given)
        finally:
            self._budget.spend(time.thread_time() - start)

    def send(self, value):
        return self._step(self._coroutine.send, value)

    def throw(self, *error):
        return self._step(self._coroutine.throw, *error)

    def close(self):
        self._coroutine.close()

    def __await__(self):
        return self._coroutine.__await__()


def charging(loop, coroutine, **options):
    """A task factory: each step of a task is charged to the session whose message, timer or callback began it."""
    context = options.get("context")
    budget = context.get(CHARGED) if context else CHARGED.get()
    return asyncio.Task(coroutine if budget is None else Charged(coroutine, budget), loop=loop, **options)
