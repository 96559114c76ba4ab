"""The page's messages about errors in its own work, and about waiting in a queue."""

import logging
from contextvars import Context
from functools import partial
from weakref import WeakKeyDictionary, WeakMethod, ref

import panel as pn
import param
from tornado.ioloop import IOLoop

from app.bundle import Bundled
from app.model.runs import Full, Stopped, to_session
from app.text import say
from tippe_core import TopError

log = logging.getLogger("tippe")
PAGES = WeakKeyDictionary()  # document -> a weak reference to its Failure, because that refers to the document


class Failure(Bundled):
    """A sentence that stays until it is closed or the page is reloaded; and another while the page waits in a queue."""

    words = param.String(doc="What it says.")
    close = param.String(constant=True, doc="Of the button that closes it.")
    times = param.Integer(default=0, doc="How often something has failed so far.")
    waits = param.String(doc="The page's place in a queue, in words; empty if it is in none.")

    def __init__(self):
        super().__init__(words=say("main.failed"), close=say("main.close"), width=0, height=0, margin=0)
        PAGES[pn.state.curdoc] = ref(self)


def _page(document):
    return PAGES.get(document, lambda: None)() if document else None


def tell(document=None):
    """Shows the sentence on the page of a Bokeh document; by default that of the one being served."""
    document = document or pn.state.curdoc
    page = _page(document)
    if page:
        to_session(document)(lambda: page.param.update(words=say("main.failed"), times=page.times + 1))


def waits(place):
    """Shows the page's place in a queue; 0: it no longer waits."""
    page = _page(pn.state.curdoc)
    if page:
        page.waits = say("main.queue.waits", count=place) if place else ""


def full(waiting):
    """Says that a request was refused, because so many are waiting already."""
    page = _page(pn.state.curdoc)
    if page:
        page.param.update(words=say("main.queue.full", count=waiting), times=page.times + 1)


def ended(error):
    """The sentence that a view shows if its own work ended with this error."""
    if isinstance(error, Full):
        return say("main.queue.full", count=error.args[0])
    return say("main.queue.stopped" if isinstance(error, Stopped) else "main.failed")


def unless_stopped(take, refuse=None, refused=TopError):
    """A function for the result of a Run: if there is one, take() is called with it, and refuse(), if given, with an
    error of the kind `refused`. Other errors are raised, and so are shown."""

    def done(result):
        if not isinstance(result, Exception):
            take(result)
        elif refuse and isinstance(result, refused):
            refuse(result)
        elif not isinstance(result, Stopped):
            raise result

    return done


def failure():
    """A Failure that shows any error in this session; the server's own handler is called too."""
    handler = pn.config.exception_handler or logged

    def handle(error):
        try:
            tell()
        finally:
            handler(error)

    pn.config.exception_handler = handle  # only for this session
    return Failure()


def logged(error):
    """Logs an error if the server has no handler of its own."""
    log.error("a callback failed", exc_info=error)


def after(seconds, act):
    """Calls act() on the page's thread after so many seconds; errors are shown."""
    pn.state.curdoc.add_timeout_callback(partial(attempt, act), max(round(1000 * seconds), 20))


def attempt(act):
    """Calls act() now; errors are handled as in Panel's own callbacks, and so are shown."""
    pn.state.execute(act, schedule=False)


def after_long(seconds, method, *given):
    """Calls a method on the loop's thread after so many seconds, unless its object is gone. A timer of the loop keeps
    its context until its time has come, even if it is cancelled: with that of a page, as after() has, the page would
    stay as long, so this one has none."""
    method = WeakMethod(method)

    def act():
        if (call := method()) is not None:
            call(*given)

    Context().run(IOLoop.current().call_later, seconds, act)
