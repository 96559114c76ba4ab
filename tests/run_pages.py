"""The Runs of a page without a page, and threads that are all busy."""

import threading
from queue import Queue
from types import SimpleNamespace

from serving import until

from app.model.runs import WORK, Run, Runs

PATIENCE = 60  # s


class Page:
    """A page's Runs, and what they have posted to its session."""

    def __init__(self):
        self.posted = Queue()
        self.runs = Runs(self.posted.put)

    def next(self):
        """Does what was posted first, as a session does."""
        self.posted.get(timeout=PATIENCE)()


def one_page():
    page = Page()
    yield page
    page.runs.leave()


def all_busy():
    """All threads are, each with another visitor's work, until end()."""
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
    """What is called when a run is done."""
    return results.append
