"""Long work waits its turn: a visitor who waits sees his place, and the number of waiting ones is limited."""

import math
import threading
from queue import Queue

import pytest
import visitors
from inside import inside
from patience import PATIENCE
from serving import until
from wire import run as run_async

from app.model import cores, pool
from app.model.runs import WORK, Full, Pool, Run, Runs, Stopped
from app.text import say

TWO = ("en", "es")


@pytest.fixture(autouse=True)
def often(monkeypatch):
    """A visitor who has to wait is told at once."""
    monkeypatch.setattr(pool, "SAY", 0.01)


@pytest.fixture
def busy():
    """Keeps all threads of WORK busy with pieces of other visitors, until they may go() one by one."""
    gate, done = Queue(), []
    for i in range(WORK.threads):
        WORK.add(f"other {i}", lambda: done.append(gate.get(timeout=PATIENCE)))
    until(lambda: WORK._working.total() == WORK.threads)
    yield lambda: gate.put(None)
    for _ in range(WORK.threads - len(done)):
        gate.put(None)
    until(lambda: not WORK._working)


def test_who_waits_is_told_his_place_and_that_his_turn_has_come():
    pool, gate, told = Pool(1, "queue"), Queue(), {name: [] for name in "abc"}
    pool.add("first", lambda: gate.get(timeout=PATIENCE))
    for name in told:
        pool.add(name, lambda: gate.get(timeout=PATIENCE), told[name].append)
    until(lambda: told == {"a": [1], "b": [2], "c": [3]})
    gate.put(None)
    until(lambda: told == {"a": [1, 0], "b": [2, 1], "c": [3, 2]})
    for _ in range(3):
        gate.put(None)
    until(lambda: [places[-1] for places in told.values()] == [0, 0, 0])
    until(lambda: not (pool._working or pool._telling))
    assert not pool._places and not pool._told  # nothing of visitors who have left is stored


def test_who_has_something_under_way_is_told_nothing():
    """He waits for his own work only."""
    pool, gate, told = Pool(2, "queue"), Queue(), []
    for _ in range(2):
        pool.add("a", lambda: gate.get(timeout=PATIENCE), told.append)
    rounds = threading.Event()
    pool.add("b", lambda: gate.get(timeout=PATIENCE))
    pool.add("c", lambda: gate.get(timeout=PATIENCE), lambda place: rounds.set())
    assert rounds.wait(PATIENCE) and told == []
    for _ in range(4):
        gate.put(None)
    until(lambda: not (pool._working or pool._telling))


def test_what_is_too_much_is_refused_and_may_be_asked_for_again():
    pool, gate, posted = Pool(1, "small", 2), threading.Event(), Queue()
    full, results = [], []
    pages = [Runs(posted.put, full=full.append) for _ in range(4)]
    for page in pages:
        page.begin(Run(lambda run: gate.wait(PATIENCE), results.append), "a", pool)
    for _ in range(2):
        posted.get(timeout=PATIENCE)()
    assert full == [2] and [type(each) for each in results] == [Full] and issubclass(Full, Stopped)
    gate.set()
    for _ in range(3):
        posted.get(timeout=PATIENCE)()
    pages[3].begin(Run(lambda run: "again", results.append), "a", pool)
    posted.get(timeout=PATIENCE)()
    assert results[1:] == [True, True, True, "again"] and full == [2]


def test_a_page_that_is_gone_waits_no_more(busy):
    posted, places = Queue(), []
    page = Runs(posted.put, waits=places.append)
    page.begin(Run(lambda run: None, lambda result: None), "a")
    posted.get(timeout=PATIENCE)()
    assert places == [1]
    page.leave()
    until(lambda: not WORK._telling)
    assert not WORK._waiting and not WORK._places


@pytest.mark.parametrize(
    ("mine", "limits", "given"),
    [
        ("0::/", {"": "150000 100000"}, 1.5),
        ("0::/", {"": "max 100000"}, math.inf),
        ("0::/", {}, math.inf),
        ("1:cpu:/old", {"": "100000 100000"}, math.inf),
        ("4:memory:/x\n0::/system.slice/tippe.service", {"system.slice": "400000 100000",
                                                        "system.slice/tippe.service": "200000 100000"}, 2.0),
        ("0::/pods/one", {"pods": "300000 100000", "pods/one": "max 100000"}, 3.0),
    ],
)  # fmt: skip
def test_the_cores_of_a_container_are_those_it_has_the_time_of(mine, limits, given, tmp_path):
    """The lines come from Docker, a machine without limits, cgroups version 1, systemd, and Kubernetes."""
    (tmp_path / "mine").write_text(mine)
    for folder, text in limits.items():
        (tmp_path / "groups" / folder).mkdir(parents=True, exist_ok=True)
        (tmp_path / "groups" / folder / "cpu.max").write_text(text + "\n")
    assert cores.given(tmp_path / "groups", tmp_path / "mine") == given


@pytest.mark.parametrize(("given", "whole"), [(0.5, 1), (1.0, 1), (2.7, 2), (math.inf, None)])
def test_whole_cores_and_no_more_than_the_machine_lets_it_have(given, whole, monkeypatch):
    monkeypatch.setattr(cores, "given", lambda: given)
    monkeypatch.setattr(cores, "allowed", lambda: 8)
    assert cores.cores() == (whole or 8)


async def ask_in_two_languages(url, go):
    """Two visitors of the Lab change its spin while the server computes for others."""
    pages = [visitors.Page(await visitors.Visitor.enter(url, headers={"Accept-Language": each})) for each in TWO]
    said = []
    for page, language in zip(pages, TWO, strict=True):
        await page.visitor.ready()
        [failure], [lab] = page.visitor.find("Failure"), page.visitor.find("LabView")
        before = page.now(lab, "frames_ordinary")
        await page.set(lab, "request", [1, "spin", 21.0])
        place = len(said) + 1
        await page.until(lambda: page.now(failure, "waits") == say("main.queue.waits", language, count=place))  # noqa: B023
        said.append((page, failure, lab, before, language))
    go()
    [_, (page, failure, _, _, language)] = said
    await page.until(lambda: page.now(failure, "waits") in ("", say("main.queue.waits", language, count=1)))
    go()
    for page, failure, lab, before, _ in said:
        await page.until(lambda: page.now(failure, "waits") == "" and page.now(lab, "frames_ordinary") != before)  # noqa: B023
        await page.leave()


@pytest.mark.served
def test_visitors_in_the_queue_see_their_places_until_their_runs_are_there(busy):
    with inside() as here:
        run_async(ask_in_two_languages(here.url, busy), PATIENCE)
