"""What an operator needs: readiness, metrics, the log, how a server stops, and how a worker is replaced."""

import asyncio
import json
import logging
import re
import signal
import sys
import threading
from pathlib import Path
from types import SimpleNamespace

import pytest
from prometheus_client.parser import text_string_to_metric_families
from serving import served, until
from wire import Closed, Visitor, get, run

from app.model.runs import Pool
from app.server import ending
from app.server.board import FIELDS, HEARD, Board
from app.server.ending import Ending
from app.server.logs import Line, without_addresses
from app.server.settings import Settings
from app.text import say

pytestmark = pytest.mark.served
forks = pytest.mark.skipif(sys.platform == "win32", reason="processes share a socket by fork")


def ready(server, prefix=""):
    """(status, reasons, sessions of all workers)"""
    status, headers, text = get(f"{server.url.removesuffix('/app').removesuffix('/tops')}{prefix}/readyz")
    said = json.loads(text)
    assert headers["Cache-Control"] == "no-store" and said["ready"] == (status == 200) == (not said["why"])
    return status, said["why"], sum(said["sessions"].values())


def compiled(server):
    """Waits until the kernels are compiled: before that the server is not ready."""
    until(lambda: "compiling" not in ready(server)[1], 600)


def test_a_full_server_lives_but_is_not_ready_with_the_prefix_and_without(tmp_path):
    async def visit():
        visitor = await Visitor.enter(server.url)
        for prefix in ("", "/tops"):
            assert await asyncio.to_thread(ready, server, prefix) == (503, ["full"], 1)
        visitor.leave()

    with served(tmp_path / "log", prefix="/tops", sessions=1, linger=3600) as server:
        compiled(server)
        assert ready(server) == ready(server, "/tops") == (200, [], 0)
        run(visit())
        until(lambda: ready(server)[0] == 200)  # its session is kept, but its place is free
        for prefix in ("", "/tops"):
            assert get(f"{server.root.removesuffix('/tops')}{prefix}/liveness")[0] == 200
        assert get(f"{server.root}/metrics")[0] == 404 == get(f"{server.root.removesuffix('/tops')}/metrics")[0]


@forks
def test_any_worker_speaks_for_all(tmp_path):
    async def visits():
        inside = [await Visitor.enter(server.url) for _ in range(3)]
        await asyncio.to_thread(until, lambda: {ready(server)[2] for _ in range(8)} == {3})
        for each in inside:
            each.leave()

    with served(tmp_path / "log", workers=2, metrics=1) as server:
        until(lambda: server.log.count("serving") == 2, 60)
        until(lambda: len(json.loads(get(server.root + "/readyz")[2])["sessions"]) == 2)
        run(visits())
        assert {labels["worker"] for labels in measured(server)["tippe_sessions"]} == {"0", "1"}


def test_who_says_nothing_any_more_is_not_asked(monkeypatch):
    board, now = Board(2), [100.0]
    monkeypatch.setattr("app.server.board.time", SimpleNamespace(monotonic=lambda: now[0]))
    for board.mine in (0, 1):
        board.write(**dict.fromkeys(FIELDS, board.mine))
    assert [row["sessions"] for row in board.read().values()] == [0, 1]
    now[0] += HEARD / 2
    board.mine = 1
    board.write(**dict.fromkeys(FIELDS, 5))
    now[0] += HEARD / 2 + 1
    assert {worker: row["sessions"] for worker, row in board.read().items()} == {1: 5}
    board.leave()
    assert board.read() == {}


class Labels(dict):
    """A dict as a hashable key."""

    def __hash__(self):
        return hash(tuple(sorted(self.items())))


def measured(server):
    """{name: {labels: value}} in /metrics."""
    status, headers, text = get(server.root + "/metrics")
    assert status == 200 and headers["Content-Type"].startswith("text/plain")
    found = {}
    for family in text_string_to_metric_families(text):
        for sample in family.samples:
            found.setdefault(sample.name, {})[Labels(sample.labels)] = sample.value
    return found


def test_metrics_count_what_there_is(tmp_path):
    async def visit():
        visitor = await Visitor.enter(server.url)
        kind, _ = await visitor.answer(await visitor.say("PATCH-DOC", {"events": ["nonsense"]}))
        assert kind == "ERROR"
        assert (await asyncio.to_thread(get, server.url))[0] == 503
        found = await asyncio.to_thread(measured, server)
        visitor.leave()
        return found

    with served(tmp_path / "log", metrics=1, sessions=1) as server:
        found = run(visit())
        one = Labels(worker="0")
        assert found["tippe_sessions"][one] == found["tippe_connections"][one] == found["tippe_full"][one] == 1
        assert found["tippe_refused_total"][Labels(worker="0", why="full")] == 1
        assert found["tippe_refused_total"][Labels(worker="0", why="message")] == 1
        assert found["tippe_queue_turns_total"][Labels(worker="0", queue="session")] == 1
        assert found["tippe_queue_length"][Labels(worker="0", queue="run")] == 0
        assert 0 <= found["tippe_event_loop_lag_seconds"][one] < 60
        assert found["tippe_memory_bytes"][one] > 1e8 and not found["tippe_open_files"][one] < 3


def test_a_pool_knows_how_many_wait_and_waited():
    pool, go = Pool(1, "tried"), threading.Event()
    done = [threading.Event() for _ in range(3)]
    for number, each in enumerate(done):
        pool.add(number, lambda each=each: (go.wait(60), each.set()))
    gone = lambda: None  # noqa: E731
    pool.add("another", gone)
    assert pool.waiting() == 3 and pool.turns == 1
    assert pool.remove("another", gone) and pool.waiting() == 2
    go.set()
    assert all(each.wait(60) for each in done)
    assert pool.waiting() == 0 and pool.turns == 3 and pool.waited > 0


def test_at_sigterm_no_page_is_let_in_and_those_that_are_open_are_told(tmp_path):
    async def until_told(visitor):
        with pytest.raises(Closed) as closed:
            while True:
                await visitor.receive()
        assert closed.value.args == (1001, say("main.server.stopping", "en"))

    async def drained():
        inside = [await Visitor.enter(server.url) for _ in range(4)]
        server.process.send_signal(signal.SIGTERM)
        await asyncio.to_thread(until, lambda: ready(server)[:2] == (503, ["stopping"]))
        status, headers, text = await asyncio.to_thread(get, server.url)
        assert status == 503 and headers["Retry-After"] and say("main.server.stopping", "en") in text
        await asyncio.gather(*map(until_told, inside))

    with served(tmp_path / "log", drain=60) as server:
        compiled(server)
        run(drained())
        assert server.process.wait(60) == 0
        assert "4 open pages" in server.log and "Traceback" not in server.log


@pytest.mark.parametrize("pages, drain, signals, slept", [
    (3, 60, [signal.SIGTERM], [1, 1]), (3, 1.5, [signal.SIGTERM], [0.5, 0.5]), (3, 60, [signal.SIGINT], []),
    (3, 60, [signal.SIGTERM] * 2, []), (1, 60, [signal.SIGTERM], []), (0, 60, [signal.SIGTERM], []),
])  # fmt: skip
def test_pages_are_sent_elsewhere_one_after_the_other(pages, drain, signals, slept, monkeypatch):
    did = []

    async def asleep(seconds):
        did.append(seconds)

    monkeypatch.setattr(ending, "asyncio", SimpleNamespace(sleep=asleep))
    monkeypatch.setattr(ending, "signal", SimpleNamespace(SIGINT=signal.SIGINT))
    told = SimpleNamespace(close=lambda code, words: did.append("told"))
    loop = SimpleNamespace(add_callback_from_signal=lambda act: begun.append(act), stop=lambda: did.append("stopped"))
    monkeypatch.setattr(ending, "IOLoop", SimpleNamespace(current=lambda: loop))
    arrivals = SimpleNamespace(stop=lambda: did.append("closed"), sockets=[])
    begun, door = [], SimpleNamespace(sockets=[told] * pages, stopping=False)
    end = Ending(SimpleNamespace(drain=drain), door, arrivals, SimpleNamespace(stop=lambda wait: None))
    for each in signals:
        end.begin(each)
    [act] = begun
    run(act())
    assert door.stopping and end.code == 0
    between = [each for each in did if isinstance(each, float | int)]
    assert sum(between[:-1]) == pytest.approx(sum(slept)) and did.count("told") == pages
    assert did[-3:] == ["closed", ending.LAST, "stopped"]
    if slept:
        assert did[:2] == ["told", pytest.approx(slept[0] / 10)] and did[11] == "told"


@forks
@pytest.mark.slow
def test_a_worker_that_grew_is_replaced_when_nobody_is_there(tmp_path):
    """With a bound of 1 MB every page is too much; a worker is not replaced before its first page."""

    async def visit():
        visitor = await Visitor.enter(f"{server.url}?tab=roll")
        answered, _ = await visitor.answer(await visitor.set(visitor.find("Dial")[0], "asked", [1, 6.5, False]))
        assert answered == "OK" and server.log.count("takes the place") == before
        visitor.leave()

    with served(tmp_path / "log", memory=1, linger=1) as server:
        for before in range(2):
            run(visit())
            until(lambda: server.log.count("serving") == before + 2, 120)  # noqa: B023
        assert server.log.count("takes the place") == 2 and "lost worker" not in server.log


@pytest.mark.parametrize("line, left", [
    ("refused 10.0.0.7 a page: full", "refused - a page: full"), ("404 GET /a.b (::1)", "404 GET /a.b (-)"),
    ("of 2001:db8::17, or 10.1.2.3:5006", "of -, or -"), ("from 10.1.2.3: no", "from -: no"),
    ("after 0.5 s, at 12:34:56", "after 0.5 s, at 12:34:56"),
    ("panel 1.9.4 and a: b", "panel 1.9.4 and a: b"), ("10.0.0.7", "-"), ("::ffff:1.2.3.4 left", "- left"),
])  # fmt: skip
def test_a_log_without_addresses(line, left):
    assert without_addresses(line) == left


def test_a_line_of_the_log_is_one_object_with_its_trace():
    address = "10.0.0.7"
    try:
        raise ValueError(f"of\n{address}")
    except ValueError:
        trace = sys.exc_info()
    record = logging.LogRecord("tippe", logging.ERROR, "", 1, "met by %s:\nall", (address,), trace)
    line = Line(as_json=True, addresses=False).format(record)
    said = json.loads(line)
    assert "\n" not in line and said["message"] == "met by -:\nall" and said["level"] == "ERROR"
    assert "ValueError" in said["trace"] and address not in line
    plain = Line(as_json=False, addresses=True).format(record)
    assert "met by 10.0.0.7" in plain and "ValueError" in plain


def test_a_server_writes_json_and_no_addresses_where_that_is_asked_for(tmp_path):
    with served(tmp_path / "log", log_format="json", log_addresses=0) as server:
        assert get(server.url + "/nowhere")[0] == 404
        until(lambda: "404" in server.log and server.log.endswith("\n"))  # after the answer has been sent
        lines = [json.loads(line) for line in server.log.splitlines()]
        assert {"time", "level", "process", "message"} <= lines[0].keys()
        assert "404 GET /app/nowhere (-)" in [line["message"] for line in lines] and "127.0.0.1" not in server.log


def test_the_unit_of_systemd_sets_what_there_is_and_waits_long_enough():
    unit = (Path(__file__).parent.parent / "deploy/tippe.service").read_text(encoding="utf-8")
    [command] = re.findall(r"(?m)^ExecStart=\S+ -m app (.*)$", unit)
    variables = dict(
        each.split("=", 1) for line in re.findall(r"(?m)^Environment=(.*)$", unit) for each in line.split()
    )
    known = {name: value for name, value in variables.items() if name.startswith("TIPPE_")}
    settings = Settings.of(known, command.split())
    assert (settings.prefix, settings.proxy, settings.workers, settings.memory) == ("/tops", 1, 2, 800)
    assert int(re.findall(r"TimeoutStopSec=(\d+)", unit)[0]) >= settings.drain + ending.GRACE


def test_metrics_need_their_package(monkeypatch):
    monkeypatch.setattr("app.server.settings.find_spec", lambda name: None)
    with pytest.raises(ValueError, match=r"TIPPE_METRICS is '1'; allowed is 0 .*\[metrics\]"):
        Settings.of({"TIPPE_METRICS": "1"})
    assert Settings.of({"TIPPE_METRICS": "0"}).metrics == 0
