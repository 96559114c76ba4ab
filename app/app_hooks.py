"""What Bokeh calls for this folder when a server starts, whichever starts it: `python -m app` or `panel serve app`."""

import asyncio
from concurrent.futures import Future, ThreadPoolExecutor

import bokeh

from app.arrivals import most_files


class Here(ThreadPoolExecutor):
    """Does what it is given at once, in the thread that gives it."""

    def submit(self, function, /, *arguments, **named):
        future = Future()
        try:
            future.set_result(function(*arguments, **named))
        except BaseException as error:
            future.set_exception(error)
        return future


def on_server_loaded(server_context):
    """Asks for as many open files as may be, and keeps what sessions do in the server's own thread.

    From 3.10 on Bokeh gives it to the event loop's executor, and what is sent to one of its own. That is no faster, for
    one thread at a time has the interpreter (a move costs an eighth more of the processor). But Panel answers some
    messages of a page, such as a dragged slider's, in the event loop without the document's lock: beside a thread, two
    of them would change one session at a time. What takes long is given to app.runs.
    """
    most_files()
    here = Here(1)
    asyncio.get_running_loop().set_default_executor(here)
    if tuple(map(int, bokeh.__version__.split(".")[:2])) >= (3, 10):
        # Private: if another Bokeh has none, this is an error in the log, at the start.
        server_context.application_context._executor._executor = here
