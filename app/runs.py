"""Long work, beside the server: in a few threads that all pages share.

The server's own thread answers everybody, so what may take long is not done there. Nothing outside can end a thread
without harm; so what is done in one looks at its flag now and then (look), and ends where its page has gone or wants
something else.
"""

import logging
import time
from concurrent.futures import ThreadPoolExecutor
from contextvars import ContextVar

from app.text import speaking, spoken

# Who asks while all are busy waits, and sees that nothing is done yet.
THREADS = ThreadPoolExecutor(4, thread_name_prefix="run")
# A run rests for NAP after each TURN, s, so that the server gets to its other visitors.
TURN, NAP = 0.01, 0.001

_NOW = ContextVar("run", default=None)
log = logging.getLogger("tippe")


class Stopped(Exception):
    """Raised within a run that is to end."""


class Run:
    """One piece of work. work: a function of this Run, called in a thread; done: one of what work returned, or of the
    exception that it raised. reached: how far it is, in a number of its own."""

    def __init__(self, work, done):
        self.work, self.done = work, done
        self.begun, self.reached, self.stopped = time.monotonic(), 0.0, False
        self._rested, self._drop = self.begun, None

    @property
    def elapsed(self):
        """How long it has taken so far, s."""
        return time.monotonic() - self.begun

    def stop(self):
        """Ends it: at once where it still waits for a thread, else at its next look."""
        if self.stopped:
            return
        self.stopped = True
        if self._drop:
            self._drop()

    def forget(self):
        """Ends it, and it is not told: something else is asked for by now."""
        self.done = lambda result: None
        self.stop()

    def look(self, reached=0.0):
        """To be called from within, often: raises Stopped where the run is to end."""
        self.reached = reached
        if self.stopped:
            raise Stopped
        if time.monotonic() - self._rested > TURN:
            time.sleep(NAP)
            self._rested = time.monotonic()

    def result(self):
        """What it returns, or the exception that it raises: it is told on another thread."""
        try:
            return self.work(self)
        except Exception as error:
            return error


def look(reached=0.0):
    """Run.look of the run that this thread does; nothing where it does none."""
    run = _NOW.get()
    if run is not None:
        run.look(reached)


def to_session(document):
    """What calls a function on the thread of a Bokeh document's session: for Runs."""

    def post(function):
        try:
            document.add_next_tick_callback(function)
        except AttributeError:
            # Bokeh takes a document apart in one thread and says afterwards that its session has ended.
            if document.session_context is not None:
                raise

    return post


class Runs:
    """What one page has under way.

    post: takes a function and calls it on the session's own thread. None: what is begun is done at once, without a
    thread.
    """

    def __init__(self, post=None):
        self._post, self._under_way, self._left = post, set(), False

    @property
    def beside(self):
        """Whether there are threads."""
        return self._post is not None

    def begin(self, run):
        """Has its work done, in the language of this page, and then tells it on the session's thread."""
        if not self.beside:
            run.done(run.result())
            return
        language = spoken()

        def tell(result):
            self._under_way.discard(run)
            self.post(lambda: run.done(result))

        def worked():
            now = _NOW.set(run)
            try:
                with speaking(language):
                    result = run.result()
            finally:
                _NOW.reset(now)  # else the thread would keep the page
            tell(result)

        def drop():
            if future.cancel():
                tell(Stopped())

        self._under_way.add(run)
        future = THREADS.submit(worked)
        future.add_done_callback(_logged)
        run._drop = drop

    def post(self, function):
        """Calls it on the session's thread, unless the page has gone."""
        if self._left:
            return
        if self.beside:
            self._post(function)
        else:
            function()

    def leave(self):
        """The page has gone: all that it has under way ends."""
        self._left = True
        for run in tuple(self._under_way):
            run.stop()


def _logged(future):
    """What nobody waits for."""
    if not future.cancelled() and future.exception():
        log.error("a run could not be told", exc_info=future.exception())
