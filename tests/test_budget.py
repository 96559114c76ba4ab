"""How much processor time a session gets, and whose turn it is."""

import asyncio
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from threading import Thread, get_ident
from types import SimpleNamespace

import numpy as np
import pytest
from bokeh.document import Document, without_document_lock
from bokeh.server.session import ServerSession
from tornado.httpserver import HTTPServer
from tornado.ioloop import IOLoop
from tornado.netutil import bind_sockets
from tornado.web import Application
from tornado.websocket import WebSocketHandler, websocket_connect
from wire import run

from app.model.runs import to_session
from app.server import sockets
from app.server.admission import Budget
from app.server.loop import charging, in_one_thread
from app.server.sockets import Socket
from app.turns import CHARGED, Turns


class Clock:
    """A clock that only work() advances, in place of the processor's."""

    def __init__(self, monkeypatch):
        self.now = 0.0
        for module in ("admission", "loop"):
            monkeypatch.setattr(f"app.server.{module}.time", self)
        monkeypatch.setattr(Budget, "_paid", -np.inf)

    def thread_time(self):
        return self.now

    monotonic = thread_time

    def work(self, seconds):
        self.now += seconds


def test_what_a_coroutine_does_itself_is_counted_and_not_what_others_do_while_it_waits(monkeypatch):
    clock = Clock(monkeypatch)
    budget = Budget()

    async def mine():
        clock.work(0.05)
        asyncio.get_running_loop().call_soon(clock.work, 0.8)  # of somebody else
        with suppress(ZeroDivisionError):
            await asyncio.gather(asyncio.sleep(0.05), part())
        clock.work(0.05)
        return "done"

    async def part():
        clock.work(0.2)
        raise ZeroDivisionError

    async def charged():
        asyncio.get_running_loop().set_task_factory(charging)
        CHARGED.set(budget)
        task = asyncio.create_task(mine())
        CHARGED.set(None)
        return await task

    assert run(charged()) == "done"
    assert budget.spent == pytest.approx(0.3)


class Server:
    """What to_session() looks at."""

    def __init__(self):
        self.server_context = self.application_context = self
        self.io_loop = IOLoop.current()


@pytest.mark.parametrize("how", ["add_next_tick_callback", "add_timeout_callback", "a thread"])
def test_what_a_session_does_later_is_charged_with_the_lock_and_without(how, monkeypatch):
    """Panel's handlers of a changed slider do not wait for a lock, and runs tell their results from threads."""
    clock = Clock(monkeypatch)
    mine, other = Budget(), Budget()

    async def both():
        loop = asyncio.get_running_loop()
        in_one_thread(loop)
        loop.set_task_factory(charging)
        document, done = Document(), []
        session = ServerSession("mine", document, io_loop=IOLoop.current())
        server = Server()
        document._session_context = lambda: server
        CHARGED.set(mine)
        post = to_session(document)

        @without_document_lock
        async def at_once():
            clock.work(0.1)
            await asyncio.sleep(0)
            clock.work(0.2)
            done.append(1)

        async def locked():
            clock.work(0.4)
            await asyncio.sleep(0)
            clock.work(0.8)
            done.append(1)

        def plain():
            clock.work(1.6)
            done.append(1)

        for each in (at_once, locked, plain):
            if how == "a thread":
                thread = Thread(target=post, args=(each,))
                thread.start()
                thread.join()
            else:
                getattr(document, how)(each, *([1] if "timeout" in how else []))
        CHARGED.set(other)
        while len(done) < 3:
            await asyncio.sleep(0.001)
        session.destroy()

    run(both())
    assert mine.spent == pytest.approx(3.1) and other.spent == 0


def test_what_is_given_to_an_executor_is_done_at_once_in_the_servers_own_thread():
    """Bokeh 3.10 gives it the callbacks of sessions."""
    where = []

    async def work():
        loop = asyncio.get_running_loop()
        in_one_thread(loop)
        with ThreadPoolExecutor(1) as thread:
            for executor in (None, thread):
                await loop.run_in_executor(executor, lambda: where.append(get_ident()))
        with pytest.raises(ZeroDivisionError):
            await loop.run_in_executor(None, lambda: 1 / 0)
        return get_ident()

    assert {run(work())} == {*where} and len(where) == 2


def test_each_frame_of_a_websocket_is_charged(monkeypatch):
    """A ping, and a message in three frames of which two are empty."""
    reads = []

    class Handler(WebSocketHandler):
        _paced, address, told = Socket._paced, "here", False
        budget = SimpleNamespace(rest=lambda seconds: None, spend=reads.append, wait=lambda: 0)

        def __init__(self, *given):
            super().__init__(*given)
            stream = self.request.connection.stream
            stream.read_bytes = self._paced(stream.read_bytes, stream.closed)

        def on_message(self, message):
            self.write_message(f"{message} after {len(reads)}")

    async def send():
        server = HTTPServer(Application([("/", Handler)]))
        [listening] = bind_sockets(0, "127.0.0.1")
        server.add_socket(listening)
        client = await websocket_connect(f"ws://127.0.0.1:{listening.getsockname()[1]}/")
        frames = ((0x89, 0x80, b""), (0x01, 0x81, b"x"), (0x00, 0x80, b""), (0x80, 0x80, b""))
        for first, mask_and_length, rest in frames:
            await client.protocol.stream.write(bytes([first, mask_and_length, 0, 0, 0, 0]) + rest)
        said = await client.read_message()
        server.stop()
        return said

    assert run(send()) == f"x after {3 * 4}"
    assert set(reads) == {sockets.EACH_READ}


def test_sessions_are_made_in_turn_among_addresses():
    async def asked():
        turns, order = Turns(0.25), []

        async def one(address):
            turn = await turns.turn(address)
            order.append(address)
            turn.done(0)

        await asyncio.gather(*(one(address) for address in ["flood"] * 5 + ["b", "c"]))
        return order

    assert run(asked()) == ["flood", "flood", "b", "c", "flood", "flood", "flood"]


def test_who_takes_a_little_never_waits_and_who_takes_much_waits_as_long_as_it_took(monkeypatch):
    clock = Clock(monkeypatch)
    budget = Budget()
    for _ in range(1000):
        clock.work(1.0)
        budget.rest(0.9)
        budget.spend(0.1)
        assert budget.wait() == 0
    clock.work(60.0)
    budget.spend(60.0)
    assert budget.wait() == pytest.approx(60.0, abs=1.5 / 0.5)  # less what all may take before
    clock.work(200.0)
    budget.rest(200.0)
    budget.spend(0.2)
    assert budget.wait() == 0


@pytest.mark.parametrize("cost", [0.002, 0.08, 1.0])
def test_all_who_take_much_have_half_together_and_who_rests_between_never_waits(cost, monkeypatch):
    """16 sessions send the next message as soon as they may; one moves a slider each 0.3 s."""
    clock = Clock(monkeypatch)
    due, used = {Budget(): 0.0 for _ in range(16)}, 0.0
    hand, moved = Budget(), 0.0
    while clock.now < 600:
        first = min(due, key=due.get)
        clock.now = max(clock.now, due[first])
        clock.work(cost)
        used += cost * (clock.now > 300)  # after what they had saved up
        first.spend(cost)
        due[first] = clock.now + first.wait()
        if clock.now - moved >= 0.3:
            hand.rest(clock.now - moved - 0.03)
            hand.spend(0.03)
            moved = clock.now
            assert hand.wait() == 0
    assert 0.45 * 300 < used <= 0.5 * 300 + 16 * cost


def test_what_is_done_in_turn_is_not_charged():
    """There others are served between."""

    async def asked():
        budget, turns = Budget(), Turns(0)
        CHARGED.set(budget)
        turn = await turns.turn("mine")
        turn.done(0.5)
        budget.spend(0.6)
        budget.spend(0.2)
        return budget.spent

    assert run(asked()) == pytest.approx(0.3)


def test_a_teacher_who_switches_rooms_twice_a_second_is_read_at_once(monkeypatch):
    """Each switch costs 0.05 s, besides the making of the room; after each fifth a map is shown, which costs 0.2 s."""
    clock = Clock(monkeypatch)
    teacher = Budget()
    for switch in range(120):
        cost = 0.2 if switch % 5 == 4 else 0.05
        clock.work(cost)
        teacher.spend(cost)
        assert teacher.wait() == 0
        clock.work(0.5 - cost)
        teacher.rest(0.5 - cost)


def test_a_hand_that_drags_for_a_minute_is_read_at_once(monkeypatch):
    """120 messages a second, of which each costs 3.5 ms."""
    clock = Clock(monkeypatch)
    hand, late = Budget(), []
    for due in np.arange(0, 60, 1 / 120):
        late.append(clock.now - due)
        clock.now = max(clock.now, due)
        clock.work(0.0035)
        hand.spend(0.0035)
        clock.work(hand.wait())
    assert max(late) < 0.01


def test_who_asks_for_much_again_and_again_waits(monkeypatch, caplog):
    """With a stopped clock: a message costs 0.08 s and its frame 0.0003; 0.2 s are its own, and 1.5 s everybody's."""
    Clock(monkeypatch)
    waited = []

    async def asleep(seconds):
        waited.append(seconds)

    async def nothing(*_):
        pass

    monkeypatch.setattr("app.server.sockets.asyncio", SimpleNamespace(sleep=asleep))
    socket = Socket.__new__(Socket)
    socket.budget, socket.request = Budget(), SimpleNamespace(remote_ip="10.0.0.7")

    async def ask(times):
        read = socket._paced(nothing, lambda: False)
        for _ in range(times):
            socket.budget.spend(0.08)
            for _ in range(3):  # header, mask and content of a frame
                await read()

    run(ask(20))
    assert waited == []
    run(ask(2))
    assert waited == pytest.approx([20 * 0.0803 / 0.5 - 0.0803 - 1.5 / 0.5] * 3, abs=3e-3)  # 2 of 22 are its own
    run(ask(1))
    assert "10.0.0.7 sends more than its share" in caplog.text
