"""How the event loop of a server works: all of a session's code in its own thread, charged to that session."""

import asyncio
from contextvars import ContextVar

CHARGED = ContextVar("charged", default=None)  # the Budget of the session for which something is done, now or later


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


def charging(loop, coroutine, **options):
    """A task factory: each step of a task is charged to the session whose message, timer or callback began it."""
    context = options.get("context")
    budget = context.get(CHARGED) if context else CHARGED.get()
    return asyncio.Task(coroutine if budget is None else budget.steps(coroutine), loop=loop, **options)
