"""The Runs of a page without a browser, and a state in which all threads are busy."""

import threading
from queue import Queue
from types import SimpleNamespace

from patience import PATIENCE
from serving import until

from app.model.runs import WORK, Run, Runs


class Page:
    """The Runs of a page, and the calls that they have posted to its session."""

    def __init__(self):
        self.posted = Queue()
        self.runs = Runs(self.posted.put)

    def next(self):
        """Runs the first posted call, as a session does."""
        self.posted.get(timeout=PATIENCE)()


def one_page():
    page = Page()
    yield page
    page.runs.leave()


def all_busy():
    """Keeps every thread busy with the work of another visitor, until end()."""
    until(lambda: not WORK._working.total())  # of a test before
    go, pages = threading.Event(), [Page() for _ in range(WORK.threads)]
    for page in pages:
        page.runs.begin(Run(lambda run: go.wait(PATIENCE), lambda result: None), "a")
    until(lambda: WORK._working.total() == WORK.threads)

    def end():
        go.set()
        for page in pages:
            page.next()

    yield SimpleNamespace(end=end)
    go.set()


def told(results):
    """The function to call when a run is done."""
    return results.append
