"""Long work: beside the server, ended where nobody wants it any more, and each run as if it were alone."""

import asyncio
import gc
import os
import sys
import threading
import weakref
from collections import Counter
from functools import partial
from pathlib import Path
from queue import Queue
from types import SimpleNamespace

import numpy as np
import pytest
from bokeh.document import Document
from bokeh.server.tornado import BokehTornado
from house import planes_of
from panel.io.application import build_single_handler_application
from wire import run as run_async
from wire import until

from app.model.explorer import Explorer
from app.model.families.family import share_map
from app.model.lesson import lesson
from app.model.runs import MAPS, NICE, TURN, WORK, Pool, Run, Runs, Stopped, look, to_session
from app.tabs.families.compare import Compare
from app.tabs.learn.learn import Learn
from app.text import speaking, spoken
from tippe_core import SmoothedCoulomb, State, Top, slide

PATIENCE = 60  # s


class Page:
    """A page's Runs, and what they have posted to its session."""

    def __init__(self):
        self.posted = Queue()
        self.runs = Runs(self.posted.put)

    def next(self):
        """Does what was posted first, as a session does."""
        self.posted.get(timeout=PATIENCE)()


@pytest.fixture
def page():
    page = Page()
    yield page
    page.runs.leave()


@pytest.fixture
def busy():
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
            look(1.5)  # of the run that this thread does

    run = Run(work, told(results))
    page.runs.begin(run, "a")
    assert begun.wait(PATIENCE)
    run.stop()
    page.next()
    assert isinstance(results[0], Stopped) and run.reached == 1.5


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
    # a thread lets go of its work soon after it has told of it
    until(lambda: gc.collect() >= 0 and gone() is None)


def test_a_run_may_end_while_its_document_is_taken_apart():
    document, session = Document(), lambda event: None
    document.on_change(session)
    document.destroy(session)
    with pytest.raises(AttributeError):
        document.add_next_tick_callback(print)
    to_session(document)(print)
    with pytest.raises(AttributeError):  # but what is wrong with one that lives is said
        to_session(SimpleNamespace(session_context="open"))(print)


def test_an_error_is_told_too(page):
    results = []
    page.runs.begin(Run(lambda run: 1 / 0, told(results)), "a")
    page.next()
    assert isinstance(results[0], ZeroDivisionError)


class Crowd:
    """Visitors of a pool of their own: in which order their pieces are begun, and how many of each at a time."""

    def __init__(self, threads):
        self.pool, self.begun, self.go = Pool(threads, "crowd"), [], Queue()
        self.working, self.most, self.changing = Counter(), Counter(), threading.Lock()

    def piece(self, visitor, name):
        def work():
            with self.changing:
                self.begun.append(name)
                self.working[visitor] += 1
                self.most[visitor] = max(self.most[visitor], self.working[visitor])
            self.go.get(timeout=PATIENCE)
            with self.changing:
                self.working[visitor] -= 1

        self.pool.add(visitor, work)
        return work

    def end(self, pieces):
        """Lets so many end."""
        for _ in range(pieces):
            self.go.put(None)


def test_visitors_take_turns_however_much_one_of_them_asks_for():
    crowd = Crowd(threads=1)
    for i in range(50):
        crowd.piece("flood", f"flood {i}")
    for visitor in ("a", "b"):
        for i in range(2):
            crowd.piece(visitor, f"{visitor} {i}")
    crowd.end(54)
    until(lambda: len(crowd.begun) == 54)
    assert crowd.begun[:7] == ["flood 0", "a 0", "b 0", "flood 1", "a 1", "b 1", "flood 2"]
    assert [name for name in crowd.begun if name.startswith("flood")] == [f"flood {i}" for i in range(50)]


def test_a_thread_is_free_for_who_has_none_under_way():
    """However much one asks for: who comes then need not wait for any of it."""
    crowd = Crowd(threads=4)
    for i in range(9):
        crowd.piece("flood", f"flood {i}")
    until(lambda: len(crowd.begun) == 3)
    crowd.piece("other", "other")
    until(lambda: "other" in crowd.begun)
    assert sorted(crowd.begun) == ["flood 0", "flood 1", "flood 2", "other"]
    assert crowd.pool.rest("flood") > 2 * crowd.pool.rest("other") + 2 * TURN * 0.9  # his three share one share
    crowd.end(10)
    until(lambda: len(crowd.begun) == 10)
    assert crowd.most["flood"] == 3
    until(lambda: not crowd.pool._working)


def test_of_a_kind_a_page_has_one_piece_and_the_newest_answers(page, busy):
    begun, results = [], []
    for i in range(300):
        page.runs.begin(Run(lambda run, i=i: begun.append(i) or i, told(results)), "a")
    page.runs.begin(Run(lambda run: "other", told(results)), "another")
    busy.end()
    until(lambda: page.posted.qsize() == 301)
    for _ in range(301):
        page.next()
    assert begun == [299] and sorted(results, key=str) == [299, "other"]


def test_nothing_is_begun_for_who_has_left(busy):
    """Left is also whose connection has ended: the session that it leaves lives for half a minute more."""
    here, begun = [True], []
    gone = Page()
    gone.runs = Runs(gone.posted.put, lambda: bool(here))
    leaving = Page()
    for page in (gone, leaving):
        for kind in "abc":
            page.runs.begin(Run(lambda run: begun.append("piece"), lambda result: None), kind)
    leaving.runs.leave()
    here.clear()
    busy.end()
    for _ in "abc":
        gone.next()
    assert begun == [] and not WORK._waiting and leaving.posted.empty()


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
    """Two visitors: of scipy before 1.17 only one could have an integrator."""
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
    """Bokeh from 3.10 on gives their work to the loop's executor and to its own, beside what Panel does in the loop
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


@pytest.mark.slow
def test_the_lesson_begins_before_its_runs_are_there(page):
    """Its first step ships; the others are computed beside the server, and anew for another top."""
    scene = Explorer().scene
    learn = Learn(scene, page.runs)
    assert [step["name"] for step in learn.lesson.steps] == ["flips"] and {*learn.lesson.runs} == {"ordinary"}
    page.next()
    assert tuple(step["name"] for step in learn.lesson.steps) == lesson.NAMES
    assert {name for step in lesson.STEPS for name in step.tops} <= {*learn.lesson.runs, *learn.lesson.others}
    before = learn.lesson.others["yours"]
    learn.show(Explorer(a=0.3, I1=0.374, I3=0.4).scene)
    page.next()
    assert learn.lesson.others["yours"]["curves"] != before["curves"]


@pytest.mark.slow
def test_what_was_asked_for_last_is_shown_where_all_wait_for_a_thread(page, busy, monkeypatch):
    monkeypatch.setattr("app.model.planes.planes.PATIENCE", 0.0)
    explorer = Explorer()
    planes = planes_of(explorer, page.runs)
    planes.ask(spin=21.0)
    planes.ask(spin=22.0)  # before the session hears that the first is not run
    busy.end()
    while planes.busy:
        page.next()
    assert planes.picture.settings.spin == 22.0


def test_a_map_asked_for_again_ends_the_one_before(page, monkeypatch):
    def slowly(*asked):
        while True:
            yield 10, nothing

    nothing = next(share_map(0.4, 10.0, 0.5, np.array([0.07]), np.array([1.0, 1.1])))[1]
    monkeypatch.setattr("app.tabs.families.compare.share_map", slowly)
    compare = Compare(Explorer().scene, page.runs)
    compare.compute()
    first = compare._run
    compare.compute()  # two clicks, before the button is seen to be taken away
    assert first.stopped
    compare.cancel.clicks += 1
    while not compare.said.object:
        assert not compare.cancel.disabled
        page.next()
    assert "Cancelled" in compare.said.object and not compare.start.disabled


@pytest.mark.skipif(sys.platform != "linux", reason="a thread has no priority of its own here")
def test_a_map_stands_back_with_all_threads_that_it_begins():
    found, done = [], threading.Event()

    def priority():
        return os.getpriority(os.PRIO_PROCESS, threading.get_native_id())

    def piece():
        found.append(priority())
        beside = threading.Thread(target=lambda: found.append(priority()))
        beside.start()
        beside.join()
        done.set()

    MAPS.add(object(), piece)
    assert done.wait(20)
    assert found == 2 * [min(priority() + NICE, 19)]
