"""`python -m app`: its settings, whom it lets in, what it sends, and how it ends."""

import asyncio
import os
import re
import signal
import subprocess
import sys
from contextlib import suppress
from dataclasses import fields
from html import escape
from http.client import HTTPConnection
from pathlib import Path
from types import SimpleNamespace
from unittest.mock import Mock
from urllib.request import urlopen

import panel.io.document
import pytest
import yaml
from bokeh.document import Document, without_document_lock
from bokeh.document.events import TitleChangedEvent
from bokeh.protocol import Protocol
from bokeh.server.session import ServerSession
from tornado.httpclient import HTTPClientError, HTTPRequest
from tornado.ioloop import IOLoop
from tornado.websocket import websocket_connect
from visiting import free_port
from wire import TOKEN, Closed, Visitor, answers, get, run, served, until

from app.borrowed import counted, in_one_thread, to_the_last
from app.server.door import Budget, Turns, budget
from app.server.messages import Refused, look_at
from app.server.settings import Settings
from app.server.sockets import Socket
from app.text import say

pytestmark = pytest.mark.served

ROOT = Path(__file__).parent.parent


@pytest.fixture(scope="module")
def server(tmp_path_factory):
    with served(tmp_path_factory.mktemp("server") / "log", sessions=3, sessions_per_address=2, linger=1) as server:
        yield server


@pytest.mark.parametrize("name, value, says", [
    ("PORT", "x", "whole number from 1 to 65535"), ("PORT", "65536", "65535"), ("WORKERS", "0", "from 1 to 64"),
    ("ORIGINS", "a b", "host:port"), ("PREFIX", "/a?b", "a path"), ("LOG", "loud", "debug, info"),
    ("FRAMES", "*; script-src *", "sources"), ("PROT", "5006", "no setting"),
])  # fmt: skip
def test_a_setting_that_cannot_be_is_named(name, value, says):
    with pytest.raises(ValueError, match=f"TIPPE_{name}") as error:
        Settings.of({f"TIPPE_{name}": value})
    assert says in str(error.value) or name == "PROT"


def started(*arguments, **settings):
    """`python -m app` that ends by itself."""
    environment = {**os.environ, **{f"TIPPE_{name.upper()}": value for name, value in settings.items()}}
    return subprocess.run([sys.executable, "-m", "app", *arguments], cwd=ROOT, capture_output=True, text=True,
                          timeout=120, env=environment)  # fmt: skip


@pytest.mark.parametrize("arguments, settings, says", [
    ((), {"port": "no"}, "TIPPE_PORT is 'no'; allowed is a whole number from 1 to 65535"),
    (("--port", "no"), {"port": "5006"}, "--port is 'no'; allowed is a whole number from 1 to 65535"),
    (("--sessions-per-address=0",), {}, "--sessions-per-address is '0'; allowed is a whole number from 1"),
    (("--prot", "8765"), {}, "unrecognized arguments: --prot 8765"), (("8765",), {}, "unrecognized arguments: 8765"),
    (("--port",), {}, "argument --port: expected one argument"),
    (("--port", ""), {}, "--port is ''; allowed is a whole number"),
    (("--prefix", "a" * 60 + "?"), {}, "such as /tops"), (("--prefix", "tüps"), {}, "ASCII"),
    (("--prefix", "a/.."), {}, "such as /tops"),
])  # fmt: skip
def test_a_bad_setting_ends_the_start_with_a_sentence(arguments, settings, says):
    done = started(*arguments, **settings)
    assert done.returncode == 2 and says in done.stderr and "Traceback" not in done.stderr


def test_help_names_every_setting():
    done = started("--help", no_setting="")
    assert done.returncode == 0 and "TIPPE_PORT=8765" in done.stdout
    for item in fields(Settings):
        assert f"--{item.name.replace('_', '-')} " in done.stdout


@pytest.mark.parametrize("given, prefix", [("", ""), ("/", ""), ("tops", "/tops"), ("/a/b-c/", "/a/b-c")])
def test_a_prefix_may_have_its_slashes_or_not(given, prefix):
    assert Settings.of({"TIPPE_PREFIX": given}).prefix == Settings.of({}, ["--prefix", given]).prefix == prefix


def test_the_command_line_goes_before_the_environment():
    settings = Settings.of({"TIPPE_PORT": "1", "TIPPE_LOG": "debug"}, ["--port=8765", "--show", "--proxy", "0"])
    assert (settings.port, settings.show, settings.proxy, settings.log) == (8765, 1, 0, "debug")


def test_options_are_served_under_a_prefix_and_every_way_leads_to_the_page(tmp_path):
    port = free_port()
    with served(tmp_path / "log", port=port, arguments=["--prefix", "tops", "--sessions", "7"]) as server:
        assert f"http://127.0.0.1:{port}/tops/app" in server.log
        for path in ("", "/", "/tops", "/tops/", "/tops/app/"):
            with urlopen(f"http://127.0.0.1:{port}{path}?KJ=6.5") as answer:
                assert answer.status == 200 and answer.url == f"http://127.0.0.1:{port}/tops/app?KJ=6.5"


# What Windows, or its Python, has not; 14 is what SIGALRM is elsewhere.
LACKS = """
import os, runpy, signal, sys
import bokeh.server.server, numpy, panel, scipy  # which do not ask for it there
for module, names in ((os, "uname fork getuid geteuid getloadavg"), (signal, "setitimer alarm SIGALRM SIGPROF")):
    for name in names.split():
        delattr(module, name)
sys.modules.update(resource=None, fcntl=None, termios=None)
sys.argv[1:] = sys.argv[4:]
runpy.run_module("app", run_name="__main__", alter_sys=True)
"""


def test_it_starts_and_serves_where_the_system_lacks_what_windows_lacks(tmp_path):
    with served(tmp_path / "log", before=[sys.executable, "-c", LACKS]) as server:
        visitor = run(Visitor.enter(server.url))
        assert visitor.component("LabView")
    assert "Traceback" not in server.log
    done = subprocess.run([sys.executable, "-c", LACKS, "", "", "", "--workers=2"], cwd=ROOT, capture_output=True,
                          text=True, timeout=120)  # fmt: skip
    assert done.returncode == 2 and "--workers is '2'; allowed is 1 on this system" in done.stderr


class Clock:
    """Stands in for the processor's: work() is the only thing that takes time."""

    def __init__(self, monkeypatch):
        self.now = 0.0
        monkeypatch.setattr("app.server.door.time", self)

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
        with suppress(ZeroDivisionError):
            await asyncio.gather(asyncio.sleep(0.05), others())
        clock.work(0.05)
        return "done"

    async def others():
        clock.work(0.2)
        raise ZeroDivisionError

    assert run(budget.steps(mine())) == "done"
    assert budget.spent == pytest.approx(0.1)


def test_what_is_done_for_another_in_the_midst_is_counted_to_him_and_nothing_twice(monkeypatch):
    clock = Clock(monkeypatch)
    mine, his = Budget(), Budget()
    with mine.work():
        clock.work(1)
        with his.work():
            clock.work(2)
            with mine.work():
                clock.work(4)
        with mine.work():
            clock.work(8)
    clock.work(16)
    assert mine.spent == pytest.approx(13) and his.spent == pytest.approx(2)


@pytest.mark.parametrize("how", ["add_next_tick_callback", "add_timeout_callback"])
def test_what_a_session_does_later_is_counted_with_the_lock_and_without(how, monkeypatch):
    """Panel's answers to a changed slider wait for no lock."""
    clock = Clock(monkeypatch)
    monkeypatch.setattr(
        ServerSession, "_wrap_document_callback", counted(ServerSession._wrap_document_callback, budget)
    )

    async def both():
        in_one_thread(asyncio.get_running_loop(), None)
        session, done = ServerSession("mine", document := Document(), io_loop=IOLoop.current()), []

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
            getattr(document, how)(each, *([1] if "timeout" in how else []))
        while len(done) < 3:
            await asyncio.sleep(0.001)
        return budget(session).spent

    assert run(both()) == pytest.approx(3.1)


@pytest.mark.parametrize("origins, host, lets", [
    ("", "anything:99", True), ("*", "anything:99", True), ("top.org", "top.org", True),
    ("top.org", "TOP.org:443", True),
    ("top.org", "top.org:5006", False), ("top.org:5006", "top.org:5006", True), ("top.org:*", "top.org:1", True),
    ("top.org", "nottop.org", False), ("top.org", "top.org.evil.com", False), ("*.top.org", "a.top.org", True),
    ("*.top.org", "top.org.evil.com", False), ("https://top.org/, b.org", "b.org", True),
    ("[::1]:5006", "[::1]:5006", True),
])  # fmt: skip
def test_which_names_the_server_goes_by(origins, host, lets):
    assert Settings.of({"TIPPE_ORIGINS": origins}).lets(host) is lets


def test_sessions_are_made_in_turn_among_addresses():
    async def asked():
        turns, order = Turns(0.25), []

        async def one(address):
            await turns.turn(address)
            order.append(address)
            turns.done(0)

        await asyncio.gather(*(one(address) for address in ["flood"] * 5 + ["b", "c"]))
        return order

    assert run(asked()) == ["flood", "flood", "b", "c", "flood", "flood", "flood"]


def test_who_spends_more_than_a_share_waits_and_not_for_ever():
    budget = Budget()
    budget.spend(1.0)
    assert budget.wait() == 0
    budget.spend(60.0)
    assert budget.wait() == 60.25
    budget.spend(0.01)
    assert budget.wait() == pytest.approx(0.26)


@pytest.mark.parametrize("value", [[[]] * 10_001, [0] * 10_001, {"type": "bytes", "data": "H4sI"}, "deep"])
def test_what_is_too_much_for_a_message(value):
    for _ in range(20 if value == "deep" else 0):
        value = [value]
    content = {"events": [{"kind": "ModelChanged", "model": {"id": "p1"}, "attr": "value", "new": value}]}
    models = SimpleNamespace(get_by_id=lambda id: None, seen=lambda id: True)
    with pytest.raises(Refused):
        look_at(SimpleNamespace(msgtype="PATCH-DOC", content=content, payload=SimpleNamespace(buffers=[])),
                SimpleNamespace(models=models))  # fmt: skip


def test_headers_and_no_cookie(server):
    status, headers, text = get(server.url)
    policy = headers["Content-Security-Policy"]
    nonce = policy.split("'nonce-")[1].split("'")[0]
    assert status == 200 and text.count("<script") == text.count(f'<script nonce="{nonce}"') > 5
    assert nonce not in get(server.url)[2]
    assert "default-src 'none'" in policy and "frame-ancestors 'self'" in policy
    assert headers["X-Content-Type-Options"] == "nosniff" and headers["Cache-Control"] == "no-store"
    assert "Server" not in headers and "Set-Cookie" not in headers


def test_a_page_is_written_once_and_has_a_token_and_a_nonce_of_its_own(server):
    """Writing it anew for each took 0.15 s, in which nobody else was served."""

    def apart(language):
        _, headers, text = get(server.url, **{"Accept-Language": language})
        token = TOKEN.search(text)[1]
        nonce = headers["Content-Security-Policy"].split("'nonce-")[1].split("'")[0]
        return token, nonce, text.replace(token, "").replace(nonce, "")

    one, other, german = apart("en"), apart("en"), apart("de")
    assert one[2] == other[2] and one[0] != other[0] and one[1] != other[1]
    for language, page in (("en", one), ("de", german)):
        assert f'"{escape(say("main.server.made", language))}"' in page[2]


def ask(server, method, path):
    """An answer to any method, and its text."""
    connection = HTTPConnection(server.root.removeprefix("http://"), timeout=60)
    connection.request(method, path)
    answer = connection.getresponse()
    return answer, answer.read().decode()


@pytest.mark.parametrize("path", ["/app", "/app/", "/", "/liveness", "/nothing", "/static/js/bokeh.min.js"])
def test_HEAD_answers_as_GET_without_a_body_and_other_methods_in_a_line(path, server):
    got, text = ask(server, "GET", path)
    head, nothing = ask(server, "HEAD", path)
    assert head.status == got.status and nothing == "" and int(head.headers["Content-Length"]) == len(text.encode())
    assert "default-src 'none'" in head.headers["Content-Security-Policy"]
    for method in ("POST", "PUT", "DELETE", "PATCH", "OPTIONS", "TRACE"):
        answer, text = ask(server, method, path)
        assert (answer.status, text.count("\n")) == (404 if path == "/nothing" and method != "TRACE" else 405, 1)
        assert len(text) < 40 and "default-src 'none'" in answer.headers["Content-Security-Policy"]
        assert answer.status == 404 or "GET" in answer.headers["Allow"]
    assert "Traceback" not in server.log


def test_pages_are_given_out_in_turn_and_not_without_end_to_one_address(server):
    """Here 2 may wait; 20 come at once."""

    async def crowd():
        host, port = server.root.removeprefix("http://").split(":")
        both = [await asyncio.open_connection(host, port) for _ in range(20)]
        for _, writer in both:
            writer.write(b"GET /app HTTP/1.1\r\nHost: 127.0.0.1\r\nConnection: close\r\n\r\n")
        return [(await reader.read()).decode() for reader, _ in both]

    answers = run(crowd())
    refused = [answer for answer in answers if answer.startswith("HTTP/1.1 503")]
    assert 0 < len(refused) < 20 and all(answer.startswith(("HTTP/1.1 503", "HTTP/1.1 200")) for answer in answers)
    assert all("Retry-After: 10" in each and say("main.server.hurried", "en") in each for each in refused)
    assert get(server.url)[0] == 200


@pytest.mark.parametrize("path, status", [
    ("/liveness?endpoint=/app", 200), ("/nothing", 404), ("/app/autoload.js?bokeh-autoload-element=1", 404),
    ("/app/metadata", 404), ("/components/antigravity/a/b/c", 404), ("/components/app.main/../../x/y", 404),
    ("/app/static/../main.py", 404), ("/static/../bokeh.json", 403), ("/components/app.page/../../x/y", 404),
    ("/app?v=1&KJ=%3Cscript%3Ealert(1)%3C/script%3E", 200),
    ("/app?bokeh-session-id=mine", 200), ("/app?theme=%22%3E%3Cscript%3Ealert(1)%3C/script%3E", 200),
    ("/app?" + "x" * 12_000, 200),
])  # fmt: skip
def test_addresses_that_mean_ill(path, status, server):
    found, _, text = get(server.root + path)
    assert found == status
    assert "alert(1)" not in text and "Traceback" not in text and "mine" not in text


@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="reads Linux's list of signals")
def test_no_clock_interrupts_what_the_server_does(server):
    """One raised into whatever ran, the event loop too: a thread's time was compared with another's (Bokeh 3.10)."""

    async def visit():
        (await Visitor.enter(server.url)).leave()

    run(visit())
    [caught] = re.findall(r"SigCgt:\s*(\w+)", Path(f"/proc/{server.process.pid}/status").read_text())
    for clock in (signal.SIGPROF, signal.SIGVTALRM, signal.SIGALRM):
        assert not int(caught, 16) >> (clock - 1) & 1, clock.name
    until(lambda: '"sessions": 0' in get(server.root + "/liveness")[2])


def test_a_page_of_another_site_may_not_connect(server):
    with pytest.raises(Exception, match="403"):
        run(Visitor.enter(server.url, headers={"Origin": "http://evil.example"}))
    assert "evil.example" in server.log


def test_a_session_needs_a_token_of_this_server(server):
    with pytest.raises(Closed):
        run(Visitor.enter(server.url, token="eyJzZXNzaW9uX2lkIjogIm1pbmUiLCAic2Vzc2lvbl9leHBpcnkiOiA5OTk5OTk5OTk5fQ"))


def test_a_session_has_few_sockets(server):
    async def crowd():
        mine = [await Visitor.enter(server.url)]
        mine += [await Visitor.enter(server.url, mine[0].token, pull=False) for _ in range(2)]
        with pytest.raises(Closed, match="4000"):
            await Visitor.enter(server.url, mine[0].token, pull=False)
        for visitor in mine:
            visitor.leave()

    run(crowd())
    until(lambda: '"sessions": 0' in get(server.root + "/liveness")[2])


def test_who_asks_for_the_whole_page_again_and_again_waits(monkeypatch, caplog):
    """On a clock that stands still: a whole page counts 0.08 s, and 5 s are saved up."""
    Clock(monkeypatch)
    waited = []

    async def asleep(seconds):
        waited.append(seconds)

    async def nothing(*_):
        return SimpleNamespace(msgtype="PULL-DOC-REQ")

    monkeypatch.setattr("app.server.sockets.asyncio", SimpleNamespace(sleep=asleep))
    socket = Socket.__new__(Socket)
    socket.connection = SimpleNamespace(session=SimpleNamespace())
    socket.request, socket.receiver = SimpleNamespace(remote_ip="10.0.0.7"), SimpleNamespace(consume=nothing)
    socket._answer = nothing

    async def ask(times):
        for _ in range(times):
            await socket.on_message("")

    run(ask(62))
    assert waited == []
    run(ask(3))
    assert waited == pytest.approx([0.08, 0.24, 0.33], abs=1e-6)
    assert "10.0.0.7 sends more than its share" in caplog.text


async def full(server):
    """As many Visitors as there are places; of tests before, some may still be taken."""
    inside = []
    while len(inside) < 2:
        try:
            inside.append(await Visitor.enter(server.url))
        except HTTPClientError:
            await asyncio.sleep(0.1)
    return inside


def test_no_more_sessions_than_there_are_places(server):
    async def crowd():
        inside = await full(server)
        status, headers, text = get(server.url)
        assert status == 503 and headers["Retry-After"] and "Too many pages are open from your address." in text
        for visitor in inside:
            visitor.leave()

    run(crowd())
    until(lambda: get(server.url)[0] == 200)
    assert "Too many pages" in server.log and "Traceback" not in server.log


def test_the_log_tells_no_key_of_a_vote(server):
    async def crowd():
        inside = await full(server)
        assert get(f"{server.url}?tab=learn&room=ABCDEF.secret")[0] == 503
        for visitor in inside:
            visitor.leave()

    run(crowd())
    assert get(f"{server.url}/nowhere?room=ABCDEF.secret")[0] == 404
    until(lambda: get(server.url)[0] == 200)
    assert "503 GET /app" in server.log and "secret" not in server.log


def test_who_leaves_while_he_connects_leaves_no_traceback(server):
    address = HTTPRequest(server.url.replace("http", "ws", 1) + "/ws", headers={"Origin": server.root})

    async def hasty(token):
        (await websocket_connect(address, subprotocols=["bokeh", token])).close()

    for _ in range(8):
        until(lambda: get(server.url)[0] == 200)
        run(hasty(TOKEN.search(get(server.url)[2]).group(1)))
    until(lambda: get(server.url)[0] == 200)
    assert "Traceback" not in server.log


def workers_of(pid):
    return subprocess.run(["pgrep", "-P", str(pid)], capture_output=True, text=True).stdout.split()


def lives(pid):
    """One that has ended may wait for a system that collects it late."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except FileNotFoundError:
        return False


@pytest.mark.skipif(sys.platform == "win32", reason="processes share a socket by fork")
@pytest.mark.parametrize("how", [signal.SIGTERM, signal.SIGKILL])
def test_all_workers_end_with_the_first_process(how, tmp_path):
    with served(tmp_path / "log", workers=2, prefix="/tops") as server:
        assert get(server.url)[0] == 200 and server.url.endswith("/tops/app")
        workers = workers_of(server.process.pid)
        assert len(workers) == 2
        until(lambda: server.log.count("serving") == 2, 60)
        os.kill(int(workers[0]), signal.SIGKILL)  # one that is lost is replaced
        until(lambda: len(workers_of(server.process.pid)) == 2 and workers[0] not in workers_of(server.process.pid))
        until(lambda: server.log.count("serving") == 3, 60)
        workers = workers_of(server.process.pid)
        server.process.send_signal(how)
        server.process.wait()
        until(lambda: not any(map(lives, workers)), 60)
        assert not answers(server.url)
        assert how == signal.SIGKILL or (server.process.returncode == 0 and "stopping" in server.log)


def test_the_files_for_many_replicas_set_what_there_is():
    compose = yaml.safe_load((ROOT / "compose.yaml").read_text(encoding="utf-8"))
    app, proxy = compose["services"]["app"], compose["services"]["proxy"]
    values = {name: re.sub(r"\$\{\w+:-(.*)\}", r"\1", str(value)) for name, value in app["environment"].items()}
    assert Settings.of(values).proxy == 1 and app["read_only"] and set(app["networks"]) <= set(compose["networks"])
    assert (ROOT / proxy["volumes"][0].split(":")[0]).is_file()

    proxy = (ROOT / "deploy/haproxy.cfg").read_text(encoding="utf-8")
    for believed in ("X-Real-IP", "X-Scheme"):  # by tornado, before the other two
        assert f"http-request del-header {believed}" in proxy

    first, *others = yaml.safe_load_all((ROOT / "deploy/kubernetes.yaml").read_text(encoding="utf-8"))
    [pod] = first["spec"]["template"]["spec"]["containers"]
    assert Settings.of({each["name"]: each.get("value", "") for each in pod["env"]}).proxy == 1
    assert [each["kind"] for each in others[:4]] == ["Service", "Ingress", "PodDisruptionBudget", "NetworkPolicy"]


def test_the_files_for_many_replicas_start_the_redis_that_they_name():
    compose = yaml.safe_load((ROOT / "compose.yaml").read_text(encoding="utf-8"))
    app, redis = compose["services"]["app"], compose["services"]["redis"]
    assert app["environment"]["TIPPE_VOTES"] == "redis://redis:6379/0" and app["depends_on"] == ["redis"]
    assert redis["networks"] == app["networks"] and redis["read_only"]

    every = {(each["kind"], each["metadata"]["name"]): each["spec"]
             for each in yaml.safe_load_all((ROOT / "deploy/kubernetes.yaml").read_text(encoding="utf-8"))}  # fmt: skip
    [pod] = every["Deployment", "tippe"]["template"]["spec"]["containers"]
    assert {"name": "TIPPE_VOTES", "value": "redis://tippe-redis:6379/0"} in pod["env"]
    there = every["Deployment", "tippe-redis"]["template"]
    [container] = there["spec"]["containers"]
    assert container["args"] == redis["command"] and container["image"] == redis["image"]
    service = every["Service", "tippe-redis"]
    assert service["selector"] == there["metadata"]["labels"] and service["ports"][0]["port"] == 6379
    [to_redis, to_names] = every["NetworkPolicy", "tippe"]["egress"]
    assert to_redis["to"][0]["podSelector"]["matchLabels"] == there["metadata"]["labels"]
    assert {each["port"] for each in to_names["ports"]} == {53}
    assert every["NetworkPolicy", "tippe-redis"]["egress"] == []


def test_the_image_keeps_votes_on_a_volume():
    image = (ROOT / "Dockerfile").read_text(encoding="utf-8")
    [path] = re.findall(r"TIPPE_VOTES=(\S+)/votes.sqlite", image)
    assert f"\nVOLUME {path}\n" in image and f"-o 65534 -g 65534 -m 700 {path}\n" in image


def test_the_docs_list_every_setting():
    text = (ROOT / "docs/DEPLOY.md").read_text(encoding="utf-8")
    assert all(f"| TIPPE_{item.name.upper()} |" in text for item in fields(Settings))


async def say_two_things():
    """What of two changes of a document reaches its page, where the second comes just as the first has been written."""
    written, writing, document = [], [], Document()

    def send(text_data):
        written.append(text_data)
        writing.append(asyncio.get_running_loop().create_future())
        return writing[-1]

    connection = Mock(_socket=SimpleNamespace(send=send), protocol=Protocol())
    for title in ("first", "second"):
        panel.io.document.schedule_write_events(document, [connection], [TitleChangedEvent(document, title)])
        if title == "first":
            await asyncio.sleep(0)
            for each in writing:
                each.set_result(None)
    await asyncio.sleep(0.1)
    return [title for title in ("first", "second") if any(f'"{title}"' in text for text in written)]


def test_what_is_said_while_something_else_is_written_comes_too(monkeypatch):
    monkeypatch.setattr(panel.io.document, "_dispatch_msgs", to_the_last(panel.io.document._dispatch_msgs))
    assert run(say_two_things()) == ["first", "second"]
