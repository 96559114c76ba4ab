"""Long work: it runs beside the server, stops when nobody wants it any more, and each run is independent of the
others."""

import asyncio
import gc
import sys
import threading
import weakref
from functools import partial
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from bokeh.document import Document
from bokeh.document.events import DocumentChangedEvent
from bokeh.server.tornado import BokehTornado
from panel.io.application import build_single_handler_application
from run_pages import PATIENCE, Page, all_busy, one_page, told
from serving import until
from tornado.ioloop import IOLoop
from wire import run as run_async

from app.model.runs import Run, Runs, Stopped, look, to_session
from app.server.loop import in_one_thread
from app.text import speaking, spoken
from tippe_core import SmoothedCoulomb, State, Top, slide

page, busy = pytest.fixture(one_page), pytest.fixture(all_busy)


def test_a_run_is_done_elsewhere_in_the_language_of_its_page_and_told_to_its_session(page):
    results = []
    with speaking("de"):
        page.runs.begin(Run(lambda run: (spoken(), threading.get_ident()), told(results)), "a")
    assert results == []
    page.next()
    [(language, thread)] = results
    assert language == "de" and thread != threading.get_ident()


def test_a_run_ends_at_its_next_look(page):
    results, begun = [], threading.Event()

    def work(run):
        begun.set()
        while True:
            look(1.5)  # of the run in this thread

    run = Run(work, told(results))
    page.runs.begin(run, "a")
    assert begun.wait(PATIENCE)
    run.stop()
    page.next()
    assert isinstance(results[0], Stopped) and run.reached == 1.5


def test_an_answer_that_waits_for_its_session_is_forgotten_when_a_newer_begins(page):
    results = []
    page.runs.begin(Run(lambda run: "old", told(results)), "a")
    until(lambda: not page.posted.empty())
    page.runs.begin(Run(lambda run: "new", told(results)), "a")
    page.next()
    page.next()
    assert results == ["new"]


def test_a_run_that_waits_for_a_thread_ends_at_once(page, busy):
    results = []
    waiting = Run(lambda run: results.append("worked"), told(results))
    page.runs.begin(waiting, "a")
    waiting.stop()
    waiting.stop()
    page.next()
    busy.end()
    assert len(results) == 1 and isinstance(results[0], Stopped)


def test_what_a_page_has_under_way_ends_when_it_leaves_and_nothing_is_told(page):
    begun, ended = threading.Event(), threading.Event()

    def work(run):
        begun.set()
        try:
            while True:
                run.look()
        finally:
            ended.set()

    page.runs.begin(Run(work, lambda result: pytest.fail("the page has gone")), "a")
    assert begun.wait(PATIENCE)
    page.runs.leave()
    assert ended.wait(PATIENCE)
    page.runs.begin(Run(lambda run: pytest.fail("the page has gone"), lambda result: None), "a")
    assert page.posted.empty()


def test_no_thread_keeps_what_a_run_was_about(page):
    class Picture:
        pass

    picture = Picture()
    gone = weakref.ref(picture)
    page.runs.begin(Run(lambda run, picture=picture: None, lambda result: None), "a")
    del picture
    page.next()
    # a thread releases its work shortly after announcing the result
    until(lambda: gc.collect() >= 0 and gone() is None)


def test_a_run_may_end_while_its_document_is_taken_apart():
    document, session = Document(), lambda event: None
    document.on_change(session)
    document.destroy(session)
    with pytest.raises(AttributeError):
        document.add_next_tick_callback(print)
    to_session(document)(print)
    with pytest.raises(AttributeError):  # but an error in a live one is reported
        to_session(SimpleNamespace(session_context=SimpleNamespace(server_context=None)))(print)


class Pausing(DocumentChangedEvent):
    """A change that a document holds back: a thread that has found it there waits until all of them were let go."""

    def __init__(self, document):
        super().__init__(document)
        self.reached, self.gone = threading.Event(), threading.Event()

    def combine(self, event):
        self.reached.set()
        self.gone.wait(PATIENCE)
        return False


def test_what_a_thread_tells_is_not_lost_when_the_page_lets_its_changes_go():
    """A click's result was lost so, once: the table in the address had changed, the picture never did."""
    results = []

    async def told_meanwhile():
        server = BokehTornado({"/app": lambda document: None})
        server.initialize(IOLoop.current())
        in_one_thread(asyncio.get_running_loop())
        session = await server.applications["/app"].create_session_if_needed("mine")
        post, held = to_session(session.document), Pausing(session.document)

        def tell():
            post(lambda: results.append(threading.get_ident()))
            held.reached.set()

        session.document.hold()
        session.document.callbacks.trigger_on_change(held)
        thread = threading.Thread(target=tell)
        thread.start()
        held.reached.wait(PATIENCE)
        session.document.unhold()
        held.gone.set()
        thread.join()
        for _ in range(100):  # turns of the event loop
            await asyncio.sleep(0)
        return threading.get_ident()

    mine = run_async(told_meanwhile())
    assert results == [mine]


def test_an_error_is_told_too(page):
    results = []
    page.runs.begin(Run(lambda run: 1 / 0, told(results)), "a")
    page.next()
    assert isinstance(results[0], ZeroDivisionError)


def test_a_run_ends_when_its_connection_does(page):
    here, begun, results = [True], threading.Event(), []
    page.runs = Runs(page.posted.put, lambda: bool(here))

    def work(run):
        begun.set()
        while True:
            look()

    page.runs.begin(Run(work, told(results)), "a")
    assert begun.wait(PATIENCE)
    here.clear()
    page.next()
    assert isinstance(results[0], Stopped)


def test_without_a_session_a_run_is_done_at_once():
    results = []
    Runs().begin(Run(lambda run: threading.get_ident(), told(results)), "a")
    assert results == [threading.get_ident()]


def test_two_runs_at_a_time_are_each_as_it_is_alone():
    """Two visitors at once: with scipy before 1.17 only one of them could have an integrator."""
    times = np.linspace(0, 60, 200)

    def moved(tilt):
        return slide(Top.paper(), State(tilt, 0, 0, 8.8), SmoothedCoulomb(0.3, 1.0), times, progress=look).theta

    tilts = (0.1, 0.2, 0.3, 0.4)
    alone, beside, page = [moved(tilt) for tilt in tilts], {}, Page()
    before = sys.getswitchinterval()
    sys.setswitchinterval(1e-5)
    try:
        for tilt in tilts:
            page.runs.begin(Run(lambda run, tilt=tilt: moved(tilt), partial(beside.__setitem__, tilt)), tilt)
        for _ in tilts:
            page.next()
    finally:
        sys.setswitchinterval(before)
    for tilt, theta in zip(tilts, alone, strict=True):
        assert np.array_equal(beside[tilt], theta)


def test_sessions_work_in_the_servers_own_thread():
    """Bokeh from 3.10 on passes work to the loop's executor and to its own, besides what Panel does in the loop
    meanwhile."""
    app = build_single_handler_application(Path(__file__).parent.parent / "app")

    async def where():
        context = BokehTornado({"/app": app}).applications["/app"]
        app.on_server_loaded(context.server_context)
        with pytest.raises(ZeroDivisionError):
            await asyncio.to_thread(lambda: 1 / 0)
        theirs = getattr(context, "_executor", None)
        sent = [await theirs.run(threading.get_ident)] if theirs else []
        return {*sent, await asyncio.to_thread(threading.get_ident), threading.get_ident()}

    assert len(run_async(where())) == 1
