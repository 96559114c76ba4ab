"""What the page says where the server could not do what was asked of it: an error anywhere in the page's own work."""

import logging
from functools import partial
from weakref import WeakKeyDictionary, ref

import panel as pn
import param

from app.bundle import Bundled
from app.model.runs import Full, Stopped, to_session
from app.text import say

log = logging.getLogger("tippe")
PAGES = WeakKeyDictionary()  # document -> a weak reference to its Failure, which knows its document


class Failure(Bundled):
    """One sentence, until it is closed or the page is loaded anew; and another while the page waits for others."""

    words = param.String(doc="What it says.")
    close = param.String(constant=True, doc="Of the button that closes it.")
    times = param.Integer(default=0, doc="How often something has failed so far.")
    waits = param.String(doc="Where in the queue the page is; empty where it is in none.")

    def __init__(self):
        super().__init__(words=say("main.failed"), close=say("main.close"), width=0, height=0, margin=0)
        PAGES[pn.state.curdoc] = ref(self)


def _page(document):
    return PAGES.get(document, lambda: None)() if document else None


def tell(document=None):
    """Has the page of a Bokeh document say it; of the one that is being served, where none is given."""
    document = document or pn.state.curdoc
    page = _page(document)
    if page:
        to_session(document)(lambda: page.param.update(words=say("main.failed"), times=page.times + 1))


def waits(place):
    """Has the page that is being served say its place in a queue; 0: it is in none any more."""
    page = _page(pn.state.curdoc)
    if page:
        page.waits = say("main.queue.waits", count=place) if place else ""


def full(waiting):
    """Has it say that what was asked for is not done, as so many wait already."""
    page = _page(pn.state.curdoc)
    if page:
        page.param.update(words=say("main.queue.full", count=waiting), times=page.times + 1)


def ended(error):
    """What a view says where its own work has ended with this and nothing is under way any more."""
    if isinstance(error, Full):
        return say("main.queue.full", count=error.args[0])
    return say("main.queue.stopped" if isinstance(error, Stopped) else "main.failed")


def failure():
    """A Failure, which from now on is told of whatever fails in this session; the server's own handler hears it too."""
    handler = pn.config.exception_handler or logged

    def handle(error):
        try:
            tell()
        finally:
            handler(error)

    pn.config.exception_handler = handle  # of this session alone
    return Failure()


def logged(error):
    """Where the server has no handler of its own."""
    log.error("a callback failed", exc_info=error)


def after(seconds, act):
    """Calls act() on the thread of the page that is being served, so many s from now; an error is told."""
    pn.state.curdoc.add_timeout_callback(partial(attempt, act), max(round(1000 * seconds), 20))


def attempt(act):
    """Calls act() now; an error is handled as in Panel's own callbacks, and so told."""
    pn.state.execute(act, schedule=False)
