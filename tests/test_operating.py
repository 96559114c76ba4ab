"""What an operator needs: readiness, metrics, the log, how a server stops, and how a worker is replaced."""

import asyncio
import json
import logging
import os
import re
import signal
import subprocess
import sys
import threading
import time
from importlib import metadata
from pathlib import Path
from types import SimpleNamespace
from urllib.request import urlopen

import pytest
from prometheus_client.parser import text_string_to_metric_families
from serving import TIDY, answers, served, until
from wire import Closed, Visitor, get, run

from app.model.runs import Pool
from app.server import shutdown
from app.server.admission import Admission
from app.server.logs import Line, Seldom, refused, without_addresses
from app.server.settings import Settings
from app.server.shutdown import GracefulShutdown
from app.server.worker_status import FIELDS, HEARD, Board
from app.text import say

forks = pytest.mark.skipif(sys.platform == "win32", reason="processes share a socket by fork")


def test_who_says_nothing_any_more_is_not_asked(monkeypatch):
    board, now = Board(2), [100.0]
    monkeypatch.setattr("app.server.worker_status.time", SimpleNamespace(monotonic=lambda: now[0]))
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


def test_a_refusal_is_logged_once_in_ten_seconds_for_each_address_and_then_with_a_count(monkeypatch):
    now, seldom, said = [50.0], Seldom(), []
    monkeypatch.setattr("app.server.logs.time", SimpleNamespace(monotonic=lambda: now[0]))
    logger = logging.Logger("tried")
    logger.addHandler(handler := logging.Handler())
    handler.addFilter(seldom)
    handler.emit = lambda record: said.append(record.getMessage())
    log = SimpleNamespace(getLogger=lambda name: logger, ERROR=logging.ERROR)
    monkeypatch.setattr("app.server.logs.logging", log)
    for address in ("10.0.0.1", "10.0.0.1", "10.0.0.2", "10.0.0.1"):
        refused(address, "full", "refused %s: %s", address, "full")
    refused("10.0.0.1", "other", "refused %s: %s", "10.0.0.1", "100 % other")
    assert said == ["refused 10.0.0.1: full", "refused 10.0.0.2: full", "refused 10.0.0.1: 100 % other"]
    now[0] += 10
    refused("10.0.0.1", "full", "refused %s: %s", "10.0.0.1", "full")
    assert said[3:] == ["refused 10.0.0.1: full (2 more like this before)"]
    for number in range(30_000):  # many addresses are not remembered for ever
        now[0] += 0.01
        refused(str(number), "full", "refused %s: %s", number, "full")
    assert len(seldom._passed) <= 10_002 and seldom.errors == 0
    logger.error("a bug")
    assert seldom.errors == 1


class Kept:
    """A session, as far as the admission looks at it."""

    def __init__(self, address, connections):
        self.address, self.connection_count, self.expires = address, connections, False

    def request_expiration(self):
        self.expires = True


def test_what_sessions_left_behind_hold_is_counted_to_their_address():
    """An address that opens and closes pages keeps itself out, and nobody else."""
    sessions = [Kept("a", 0) for _ in range(3)] + [Kept("b", 1)]
    admission = Admission(Settings(sessions=4, sessions_per_address=3), SimpleNamespace(sessions=sessions))
    admission.sockets = [SimpleNamespace(address="b")]
    assert admission.refusal("a") == "crowded" and not admission.full
    assert admission.refusal("b") is None and [each.expires for each in sessions] == [True, True, True, False]
    sessions[:] = [Kept("a", 1) for _ in range(4)]
    assert admission.refusal("b") == "full" and admission.full


def test_no_more_pages_are_let_in_than_the_memory_of_the_container_has_room_for(monkeypatch):
    monkeypatch.setattr("app.server.settings.memory_limit", lambda: 2 * 2**30)
    assert (Settings.of({}).sessions, Settings.of({"TIPPE_WORKERS": "2"}).sessions) == (204, 83)
    assert Settings.of({"TIPPE_SESSIONS": "9"}).sessions == 9
    monkeypatch.setattr("app.server.admission.memory_limit", lambda: 1e9)
    monkeypatch.setattr("app.server.admission.memory", lambda: used[0])
    admission, used = Admission(Settings(sessions=4), SimpleNamespace(sessions=[])), [0.8e9]
    assert admission.refusal("a") is None
    used[0] = 0.95e9
    assert admission.refusal("a") == "full" and admission.full


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


@pytest.mark.parametrize("pages, drain, signals, slept", [
    (3, 60, [signal.SIGTERM], [1, 1]), (3, 1.5, [signal.SIGTERM], [0.5, 0.5]), (3, 60, [signal.SIGINT], []),
    (3, 60, [signal.SIGTERM] * 2, []), (1, 60, [signal.SIGTERM], []), (0, 60, [signal.SIGTERM], []),
])  # fmt: skip
def test_pages_are_sent_elsewhere_one_after_the_other(pages, drain, signals, slept, monkeypatch):
    did = []

    async def asleep(seconds):
        did.append(seconds)

    monkeypatch.setattr(shutdown, "asyncio", SimpleNamespace(sleep=asleep))
    monkeypatch.setattr(shutdown, "signal", SimpleNamespace(SIGINT=signal.SIGINT))
    told = SimpleNamespace(close=lambda code, words: did.append("told"))
    loop = SimpleNamespace(add_callback_from_signal=lambda act: begun.append(act), stop=lambda: did.append("stopped"))
    monkeypatch.setattr(shutdown, "IOLoop", SimpleNamespace(current=lambda: loop))
    arrivals = SimpleNamespace(stop=lambda: did.append("closed"), sockets=[])
    begun, admission = [], SimpleNamespace(sockets=[told] * pages, stopping=False)
    end = GracefulShutdown(SimpleNamespace(drain=drain), admission, arrivals, SimpleNamespace(stop=lambda wait: None))
    for each in signals:
        end.begin(each)
    [act] = begun
    run(act())
    assert admission.stopping and end.code == 0
    between = [each for each in did if isinstance(each, float | int)]
    assert sum(between[:-1]) == pytest.approx(sum(slept)) and did.count("told") == pages
    assert did[-3:] == ["closed", shutdown.LAST, "stopped"]
    if slept:
        assert did[:3] == ["told", pytest.approx(slept[0]), "told"]


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


def test_the_unit_of_systemd_sets_what_there_is_and_waits_long_enough():
    unit = (Path(__file__).parent.parent / "deploy/tippe.service").read_text(encoding="utf-8")
    [command] = re.findall(r"(?m)^ExecStart=\S+ -m app (.*)$", unit)
    variables = dict(
        each.split("=", 1) for line in re.findall(r"(?m)^Environment=(.*)$", unit) for each in line.split()
    )
    known = {name: value for name, value in variables.items() if name.startswith("TIPPE_")}
    settings = Settings.of(known, command.split())
    assert (settings.prefix, settings.proxy, settings.workers, settings.memory) == ("/tops", 1, 2, 800)
    assert int(re.findall(r"TimeoutStopSec=(\d+)", unit)[0]) >= settings.drain + shutdown.GRACE


def test_metrics_need_their_package(monkeypatch):
    monkeypatch.setattr("app.server.settings.find_spec", lambda name: None)
    with pytest.raises(ValueError, match=r"TIPPE_METRICS is '1'; allowed is 0 .*\[metrics\]"):
        Settings.of({"TIPPE_METRICS": "1"})
    assert Settings.of({"TIPPE_METRICS": "0"}).metrics == 0


# --- servers


def ready(root):
    """(status, reasons, sessions of all workers)"""
    status, headers, text = get(f"{root}/readyz")
    said = json.loads(text)
    assert headers["Cache-Control"] == "no-store" and said["ready"] == (status == 200) == (not said["why"])
    return status, said["why"], sum(said["sessions"].values())


class Labels(dict):
    """A dict as a hashable key."""

    def __hash__(self):
        return hash(tuple(sorted(self.items())))


def measured(root):
    """{name: {labels: value}} in /metrics."""
    status, headers, text = get(root + "/metrics")
    assert status == 200 and headers["Content-Type"].startswith("text/plain")
    found = {}
    for family in text_string_to_metric_families(text):
        for sample in family.samples:
            found.setdefault(sample.name, {})[Labels(sample.labels)] = sample.value
    return found


def workers_of(pid):
    return subprocess.run(["pgrep", "-P", str(pid)], capture_output=True, text=True).stdout.split()


def lives(pid):
    """A process that has ended may wait until the system collects it."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except FileNotFoundError:
        return False


def ends(server, how):
    """Ends the first process of a server with this signal; all its workers end with it."""
    workers = workers_of(server.process.pid)
    server.process.send_signal(how)
    server.process.wait()
    until(lambda: not any(map(lives, workers)))
    assert not answers(server.url)


async def until_told(visitor):
    with pytest.raises(Closed) as closed:
        while True:
            await visitor.receive()
    assert closed.value.args == (1001, say("main.server.stopping", "en"))


async def whole_life(server, roots):
    """Two visitors fill the server; a strange message and a third visitor are refused, and counted. One leaves, another
    comes; at SIGTERM no page is let in, and those that are open are told. Returns the metrics of the full server."""
    inside = [await Visitor.enter(server.url) for _ in range(2)]
    kind, _ = await inside[0].answer(await inside[0].say("PATCH-DOC", {"events": ["nonsense"]}))
    assert kind == "ERROR"
    for root in roots:
        assert await asyncio.to_thread(ready, root) == (503, ["full"], 2)
    assert (await asyncio.to_thread(get, server.url))[0] == 503
    found = await asyncio.to_thread(measured, roots[0])
    inside.pop().leave()
    await asyncio.to_thread(until, lambda: ready(server.root)[0] == 200)  # the session is kept, but its place is free
    await asyncio.to_thread(until, lambda: get(server.url)[0] == 200)
    inside.append(await Visitor.enter(server.url))
    server.process.send_signal(signal.SIGTERM)
    await asyncio.to_thread(until, lambda: ready(server.root)[:2] == (503, ["stopping"]))
    status, headers, text = await asyncio.to_thread(get, server.url)
    assert status == 503 and headers["Retry-After"] and say("main.server.stopping", "en") in text
    await asyncio.gather(*map(until_told, inside))
    return found


@pytest.mark.served
def test_a_server_with_a_prefix_says_how_it_is_until_it_stops(tmp_path):
    """It is found from everywhere, is full, counts, writes JSON without addresses, and sends its pages elsewhere."""
    options = {"sessions": 2, "linger": 3600, "metrics": 1, "drain": 60, "log_format": "json", "log_addresses": 0}
    with served(tmp_path / "log", arguments=["--prefix", "tops"], prefix="/other", **options) as server:
        bare = server.url.removesuffix("/other/app")
        server.url = f"{bare}/tops/app"  # the option goes before the variable
        for path in ("", "/", "/tops", "/tops/", "/tops/app/"):
            with urlopen(f"{bare}{path}?KJ=6.5") as answer:
                assert answer.status == 200 and answer.url == f"{server.url}?KJ=6.5"
        until(lambda: "compiling" not in ready(bare)[1], 600)
        roots = (bare, server.root)
        assert [ready(root) for root in roots] == 2 * [(200, [], 0)]
        assert [get(f"{root}/liveness")[0] for root in roots] == [200, 200] and get(f"{bare}/nowhere")[0] == 404
        found, one = run(whole_life(server, roots)), Labels(worker="0")
        assert found["tippe_sessions"][one] == found["tippe_connections"][one] == 2 and found["tippe_full"][one] == 1
        assert found["tippe_refused_total"][Labels(worker="0", why="full")] == 1
        assert found["tippe_refused_total"][Labels(worker="0", why="message")] == 1
        assert found["tippe_queue_turns_total"][Labels(worker="0", queue="session")] == 2
        assert found["tippe_queue_length"][Labels(worker="0", queue="run")] == 0
        assert found["tippe_moves_total"][one] >= 1 and 0 < found["tippe_moves_seconds_total"][one] < 60
        assert found["tippe_sessions_made_total"][one] == 2 and found["tippe_errors_total"][one] == 0
        assert found["tippe_cpu_seconds_total"][one] > 0.1 and found["tippe_votes_away"][one] == 0
        assert abs(found["tippe_start_time_seconds"][one] - time.time()) < 3600
        assert found["tippe_build"] == {Labels(version=metadata.version("tippe-top-explorer")): 1}
        assert 0 <= found["tippe_event_loop_lag_seconds"][one] < 60
        assert found["tippe_memory_bytes"][one] > 1e8 and not found["tippe_open_files"][one] < 3
        assert server.process.wait(60) == 0
        lines = [json.loads(line) for line in server.log.splitlines()]
        assert {"time", "level", "process", "message"} <= lines[0].keys()
        said = "\n".join(line["message"] for line in lines)
        assert "serving http://-/tops/app" in said and "404 GET /nowhere (-)" in said
        assert "2 open pages" in said and "Traceback" not in server.log
        assert "127.0.0.1" not in server.log


@forks
@pytest.mark.served
def test_any_worker_speaks_for_all_a_lost_one_is_replaced_and_all_end_when_the_first_process_is_killed(tmp_path):
    async def visits():
        inside = [await Visitor.enter(server.url) for _ in range(3)]
        await asyncio.to_thread(until, lambda: {ready(server.root)[2] for _ in range(8)} == {3})
        for each in inside:
            each.leave()

    with served(tmp_path / "log", workers=2, metrics=1) as server:
        until(lambda: server.log.count("serving") == 2)
        until(lambda: len(json.loads(get(server.root + "/readyz")[2])["sessions"]) == 2)
        run(visits())
        assert {labels["worker"] for labels in measured(server.root)["tippe_sessions"]} == {"0", "1"}
        lost = workers_of(server.process.pid)[0]
        os.kill(int(lost), signal.SIGKILL)
        until(lambda: server.log.count("serving") == 3)
        assert len(now := workers_of(server.process.pid)) == 2 and lost not in now
        ends(server, signal.SIGKILL)


@forks
@pytest.mark.served
def test_a_worker_that_grew_is_replaced_when_nobody_is_there(tmp_path):
    """With a bound of 1 MB every page is too much; a worker is not replaced before its first page."""

    async def visit():
        visitor = await Visitor.enter(f"{server.url}?tab=roll")
        answered, _ = await visitor.answer(await visitor.set(visitor.group("K_J"), "request", [1, "K_J", 6.5, False]))
        assert answered == "OK" and "takes the place" not in server.log
        visitor.leave()

    with served(tmp_path / "log", code=TIDY, memory=1, linger=1) as server:
        run(visit())
        until(lambda: server.log.count("serving") == 2)
        assert get(server.url)[0] == 200
        assert server.log.count("with status 10, restarting") == 1
