"""A class opens the same room at once: its views are created in turn, and others are served meanwhile."""

import asyncio
import html
import itertools
import time
from contextvars import ContextVar
from types import SimpleNamespace

import pytest
import visitors
from serving import served
from wire import Page, Visitor, get, run

import app.turns
from app.text import say
from app.turns import TAKEN, Turn, Turns

PATIENCE = 900  # s
CLASS = 5  # the last of each language is told of three before him


def test_who_waits_is_told_how_many_come_first_and_who_leaves_is_not_counted():
    """Four ask at once; the first to wait leaves."""

    async def asked():
        turns, order, told = Turns(0), [], {name: [] for name in "abcd"}
        mine = {name: turns.ask(name, lambda turn: order.append(turn.whose), told[name].append) for name in "abcd"}
        assert order == ["a"] and mine["a"].begin()
        assert told == {"a": [], "b": [1], "c": [2], "d": [3]} and turns.waiting() == 3
        assert mine["b"].leave() and not mine["b"].leave() and not mine["a"].leave()
        assert told == {"a": [], "b": [1], "c": [2, 1], "d": [3, 2]}
        for name in "ac":
            assert order[-1] == name and (name == "a" or mine[name].begin())
            mine[name].done(0)
            await asyncio.sleep(0.01)
        assert order == ["a", "c", "d"] and told["d"] == [3, 2, 1] and turns.waiting() == 0

    run(asked())


def test_a_long_queue_is_told_only_where_something_has_changed():
    """With each step five are told, and of the others those for whom a fifth fewer come first."""

    async def asked():
        turns, told = Turns(0), [0]

        def go(turn):
            turn.begin()
            told.append(0)

        def tell(before):
            told[-1] += 1

        waiting = [turns.ask(i, go, tell) for i in range(250)]
        for turn in waiting[:-6]:
            before = len(told)
            turn.done(0)
            while len(told) == before:
                await asyncio.sleep(0)
        return told[2:-1]  # without those who ask

    assert max(run(asked())) < 40


def test_others_are_served_between_the_steps_of_a_turn_and_nobody_else_has_one():
    async def asked():
        turns, order, ready = Turns(1), [], asyncio.Event()

        def go(turn):
            assert turn.begin()
            order.append(turn.whose)
            asyncio.get_running_loop().call_soon(order.append, "others")
            (turn.rest if order.count(turn.whose) == 1 else turn.done)(0.01)
            if len(order) > 6:
                asyncio.get_running_loop().call_soon(ready.set)

        for name in "ab":
            turns.ask(name, go)
        await ready.wait()
        return order

    assert run(asked()) == ["a", "others", "a", "others", "b", "others", "b", "others"]


@pytest.mark.parametrize("busy", [False, True])
def test_a_pause_is_half_as_long_if_others_need_little(busy, monkeypatch):
    """busy: whether the clock of the thread says that others are served in it all the time."""
    pauses, clock = [], itertools.count()
    loop = SimpleNamespace(call_later=lambda seconds, act, *given: (pauses.append(seconds), act(*given)))
    monkeypatch.setattr(app.turns, "IOLoop", SimpleNamespace(current=lambda: loop))
    monkeypatch.setattr(app.turns, "time", SimpleNamespace(monotonic=time.monotonic, thread_time=clock.__next__))
    turns = Turns(1.0 if busy else 8.0)  # between two looks the thread has worked 1 s
    turns._now = turn = Turn(turns, "a", None, None)
    turn.done(1.0)
    assert sum(pauses) == (1.0 if busy else 4.0)


def test_a_turn_that_nobody_takes_up_passes_and_comes_too_late(monkeypatch):
    monkeypatch.setattr("app.turns.TAKEN", 0.02)
    assert TAKEN > 1

    async def asked():
        turns, order = Turns(0), []
        lazy = turns.ask("lazy", lambda turn: order.append("lazy"))
        turns.ask("next", lambda turn: order.append("next"))
        while len(order) < 2:
            await asyncio.sleep(0.005)
        assert not lazy.begin()
        return order

    assert run(asked()) == ["lazy", "next"]


def test_who_has_gone_before_his_turn_is_left_out():
    async def asked():
        turns, order = Turns(0), []
        first = await turns.turn("first")
        gone = asyncio.create_task(turns.turn("gone"))
        last = asyncio.create_task(turns.turn("last"))
        await asyncio.sleep(0.01)
        gone.cancel()
        await asyncio.sleep(0.01)
        order.append(turns.waiting())
        first.done(0)
        await last
        return order

    assert run(asked()) == [1]


def test_each_is_called_as_the_page_that_asked_whoever_was_served_before():
    """Panel tells pages apart by a context variable."""
    page, heard = ContextVar("page"), []

    async def asked():
        turns, done = Turns(0), asyncio.Event()

        def go(turn):
            heard.append((turn.whose, page.get()))
            assert turn.begin()
            turn.done(0)
            if turn.whose == "c":
                done.set()

        for name in "abc":
            page.set(name)
            turns.ask(name, go, lambda before, name=name: heard.append((name, page.get())))
        page.set("none")
        await done.wait()

    run(asked())
    assert len(heard) > 4 and all(whose == whom for whose, whom in heard)


class Clocked(Page):
    """A Page that notes when its room came, and what stood there before."""

    room, came, said = "maps", None, ()

    def heard(self, content):
        self.said = [*self.said, *(event["new"] for event in content["events"] if event.get("attr") == "text"
                                   and "status" in str(event["new"]))]  # fmt: skip

    async def open(self):
        await super().open(self.room)
        self.came = time.monotonic()


async def class_opens(server):
    """When each of the class had the room, when another visitor's moves and /liveness were answered, and the class."""
    students = []
    for i in range(CLASS):
        visitor = await Visitor.enter(server.url, headers={"Accept-Language": ("en", "de")[i % 2]})
        students.append(Clocked(visitor))
        await visitor.ready()
    other, moves, lives = await visitors.come(server.url), [], []
    dial = other.visitor.group("K_J")

    async def move():
        while True:
            await other.set(dial, "request", [len(moves) + 1, "K_J", 6 + 0.01 * (len(moves) % 90), False])
            moves.append(time.monotonic())
            await asyncio.sleep(0.02)

    async def live():
        while True:
            assert (await asyncio.to_thread(get, f"{server.root}/liveness"))[0] == 200
            lives.append(time.monotonic())
            await asyncio.sleep(0.02)

    beside = [asyncio.create_task(act()) for act in (move, live)]
    while len(moves) < 3:
        await asyncio.sleep(0.05)
    await asyncio.gather(*(student.open() for student in students))
    for task in beside:
        task.cancel()
    for page in (*students, other):
        await page.leave()
    return sorted(student.came for student in students), moves, lives, students


def gaps(times, events):
    """Between how many neighbours of these times there was such an event."""
    return sum(any(a < event < b for event in events) for a, b in itertools.pairwise(times))


@pytest.mark.slow
@pytest.mark.served
def test_a_class_that_opens_a_room_at_once_stops_nobody_and_sees_how_many_come_first(tmp_path):
    """In one piece, as it was, nobody's move was answered between the first and the last."""
    with served(tmp_path / "log") as server:
        came, moves, lives, students = run(class_opens(server), PATIENCE)
    assert gaps(came, moves) >= CLASS / 2 and gaps(came, lives) >= CLASS / 2
    numbers = [say("main.making.before", language, count=3) for language in ("en", "de")]
    nexts = [say("main.making.next", language) for language in ("en", "de")]
    said = [html.unescape("".join(student.said)) for student in students]
    assert all(any(text in each for each in said) for text in numbers + nexts)
    assert "Traceback" not in server.log and "kernels" not in server.log  # all are kept
