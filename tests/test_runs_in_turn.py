"""Long work of many visitors: whose turn it is, which answer belongs to whom, and what has to wait."""

import os
import sys
import threading
import time
from collections import Counter
from queue import Queue

import numpy as np
import pytest
from doubles import lab_of
from run_pages import PATIENCE, Page, all_busy, one_page, told
from serving import until

from app.model.explorer import Explorer
from app.model.families.family import share_map
from app.model.lab.ends import SPINS
from app.model.lab.lab import Lab
from app.model.lesson import lesson
from app.model.runs import LATER, MAPS, NICE, TURN, WORK, Pool, Run, Runs
from app.tabs.families.compare import Compare
from app.tabs.learn.learn import Learn

page, busy = pytest.fixture(one_page), pytest.fixture(all_busy)


class Crowd:
    """Visitors of a separate pool: the order in which their pieces start, and how many run at a time."""

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
        """Lets this many pieces end."""
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
    """However much one visitor requests, another one need not wait for it."""
    crowd = Crowd(threads=4)
    for i in range(9):
        crowd.piece("flood", f"flood {i}")
    until(lambda: len(crowd.begun) == 3)
    crowd.piece("other", "other")
    until(lambda: "other" in crowd.begun)
    assert sorted(crowd.begun) == ["flood 0", "flood 1", "flood 2", "other"]
    assert crowd.pool.rest("flood") > 2 * crowd.pool.rest("other") + 2 * TURN * 0.9  # one share for all three
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
    """A visitor whose connection has ended has left too, although his session lives on for half a minute."""
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


@pytest.mark.slow
def test_the_lesson_begins_before_its_runs_are_there(page):
    """The first step is in the package; the others are computed beside the server, and again for another top."""
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
    monkeypatch.setattr("app.model.lab.lab.PATIENCE", 0.0)
    lab = lab_of(Explorer(), page.runs)
    lab.ask(spin=21.0)
    lab.ask(spin=22.0)  # before the session is told that the first one is not run
    busy.end()
    while lab.busy:
        page.next()
    assert lab.scene.start.spin == 22.0


def test_a_map_asked_for_again_ends_the_one_before(page, monkeypatch):
    def slowly(*asked):
        while True:
            yield 10, nothing

    nothing = next(share_map(0.4, 10.0, 0.5, np.array([0.07]), np.array([1.0, 1.1])))[1]
    monkeypatch.setattr("app.tabs.families.compare.share_map", slowly)
    compare = Compare(Explorer().scene, page.runs)
    compare.compute()
    first = compare._run
    compare.compute()  # two clicks, before the button disappears
    assert first.stopped
    compare.cancel.clicks += 1
    while not compare.wording.object:
        assert not compare.cancel.disabled
        page.next()
    assert "Cancelled" in compare.wording.object and not compare.start.disabled


def test_what_a_hand_waits_for_does_not_wait_for_the_rest_of_other_runs(page, monkeypatch):
    """Somebody who has requested nothing is not told that he waits. The ends are those of a few spins."""
    monkeypatch.setattr("app.model.lab.ends.SPINS", SPINS[::10])
    go, places = threading.Event(), []
    for name in range(LATER.threads + 1):
        LATER.add(name, lambda: go.wait(PATIENCE), places.append)
    lab = Lab(page.runs)
    lab.show()
    lab.ask(spin=33.0, tilt=12.0)
    lab.rest()
    page.next()
    assert lab.scene.start.spin == 33.0 and not (lab.scene.whole or lab.busy)
    assert LATER.waiting() == 3  # including the rest of this run, and the ends for all spins
    go.set()
    while not (lab.scene.whole and lab.ends):
        page.next()
    assert lab.scene.start.spin == 33.0 and not places


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


def test_a_short_map_overtakes_a_long_one_and_both_are_done():
    """One thread; each look is a piece of work, and the short one comes when the long one has begun."""
    pool, order, posted, begun = Pool(1, "sliced", slice=0.0), [], Queue(), threading.Event()

    def work(name, looks):
        def run(run):
            for _ in range(looks):
                begun.set()
                if name == "long":
                    come.wait(PATIENCE)
                time.sleep(2 * TURN)
                run.look()
                order.append(name)

        return run

    come, long, short = threading.Event(), Runs(posted.put), Runs(posted.put)
    long.begin(Run(work("long", 20), lambda result: order.append("long is done")), "map", pool)
    assert begun.wait(PATIENCE)
    short.begin(Run(work("short", 3), lambda result: order.append("short is done")), "map", pool)
    come.set()
    for _ in range(2):
        posted.get(timeout=PATIENCE)()
    assert order[-1] == "long is done" and order.index("short is done") < order.index("long is done")
    assert order.count("long") == 20 and order.index("short") < 4
    assert not (pool._working or pool._waiting or pool._since or pool._resuming)


def test_who_gave_way_and_has_left_ends_when_its_turn_comes():
    pool, posted, came = Pool(1, "sliced", slice=0.0), Queue(), threading.Event()

    def forever(run):
        while True:
            came.set()
            time.sleep(2 * TURN)
            run.look()

    page, other = Runs(posted.put), Runs(posted.put)
    page.begin(Run(forever, lambda result: None), "map", pool)
    assert came.wait(PATIENCE)
    other.begin(Run(forever, lambda result: None), "map", pool)
    page.leave()
    other.leave()
    until(lambda: not (pool._working or pool._waiting or pool._resuming))
