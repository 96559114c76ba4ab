"""`python -m app`: who may connect, what it sends, and how it stops."""

import gzip
import re
import resource
import signal
import sys
from html import escape
from http.client import HTTPConnection
from pathlib import Path
from types import SimpleNamespace

import pytest
from serving import TIDY, served, until
from tornado.httpclient import HTTPRequest
from tornado.websocket import websocket_connect
from wire import TOKEN, Closed, Visitor, get, run

from app.server.messages import Refused, look_at
from app.text import say

pytestmark = pytest.mark.served

ROOT = Path(__file__).parent.parent


@pytest.fixture(scope="module")
def running(tmp_path_factory):
    """Of few sessions and, at first, of few open files."""
    few = "from resource import *; setrlimit(RLIMIT_NOFILE, (256, getrlimit(RLIMIT_NOFILE)[1]))"
    few = few if sys.platform != "win32" else ""
    with served(tmp_path_factory.mktemp("server") / "log", code=few + TIDY, sessions=3, sessions_per_address=2,
                linger=1) as server:  # fmt: skip
        yield server


@pytest.fixture
def server(running):
    """The server, when the visitors of earlier tests are gone."""
    until(lambda: '"sessions": 0' in get(running.root + "/liveness")[2] and get(running.url)[0] == 200)
    return running


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
    """Rendering it again for each visitor took 0.15 s, in which nobody else was served."""

    def apart(language):
        _, headers, text = get(server.url, **{"Accept-Language": language})
        token = TOKEN.search(text)[1]
        nonce = headers["Content-Security-Policy"].split("'nonce-")[1].split("'")[0]
        return token, nonce, text.replace(token, "").replace(nonce, "")

    one, other, german = apart("en"), apart("en"), apart("de")
    assert one[2] == other[2] and one[0] != other[0] and one[1] != other[1]
    for language, page in (("en", one), ("de", german)):
        assert page[2].count(escape(say("main.server.made", language))) == 1


def fetch(server, method, path, **headers):
    """The answer to a request of any method, and its bytes as sent."""
    connection = HTTPConnection(server.root.removeprefix("http://"), timeout=60)
    connection.request(method, path, headers={name.replace("_", "-"): value for name, value in headers.items()})
    answer = connection.getresponse()
    return answer, answer.read()


def ask(server, method, path):
    """The answer to a request of any method, and its text."""
    answer, body = fetch(server, method, path)
    return answer, body.decode()


@pytest.mark.parametrize(
    "path",
    [
        "/static/js/bokeh.min.js",
        "/static/extensions/panel/panel.min.js",
        "/components/app.bundle/Bundled/_bundle_path/static/tippe.js",
    ],
)
def test_scripts_are_sent_compressed_to_who_takes_that(path, server):
    plain, whole = fetch(server, "GET", path)
    answer, packed = fetch(server, "GET", path, Accept_Encoding="gzip, deflate, br")
    head, _ = fetch(server, "HEAD", path, Accept_Encoding="gzip")
    assert gzip.decompress(packed) == whole and len(packed) < 0.4 * len(whole)
    assert answer.headers["Content-Encoding"] == head.headers["Content-Encoding"] == "gzip"
    assert int(head.headers["Content-Length"]) == len(packed)
    assert "Content-Encoding" not in plain.headers
    for name in ("Content-Type", "Last-Modified", "Vary"):  # so that caches distinguish the two
        assert plain.headers[name] == answer.headers[name]
    assert plain.headers["Vary"] == "Accept-Encoding" and plain.headers["Etag"] != answer.headers["Etag"]
    part, body = fetch(server, "GET", path, Accept_Encoding="gzip", Range="bytes=5-14")
    assert (part.status, body) == (206, whole[5:15]) and "Content-Encoding" not in part.headers
    for given in (plain, answer):
        kept, _ = fetch(server, "GET", path, Accept_Encoding=given.headers.get("Content-Encoding", "identity"),
                        If_None_Match=given.headers["Etag"])  # fmt: skip
        assert kept.status == 304


@pytest.mark.parametrize("path", ["/app", "/liveness", "/nothing", "/static/js/bokeh.min.js"])
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
def test_no_clock_interrupts_what_the_server_does_bokeh_does_not_reconnect_and_the_limit_of_files_is_raised(server):
    """A signal handler interrupted whatever ran, even the event loop, because one thread's time was compared with
    another's (Bokeh 3.10)."""

    async def visit():
        visitor = await Visitor.enter(server.url)
        [config] = visitor.find("DocumentConfig")
        visitor.leave()
        return visitor.models[config][1]

    assert run(visit()) == {"reconnect_session": False, "notifications": None, "notify_connection_status": False}
    [files] = re.findall(r"Max open files +(\d+)", Path(f"/proc/{server.process.pid}/limits").read_text())
    assert int(files) == min(resource.getrlimit(resource.RLIMIT_NOFILE)[1], 65_536)
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


def test_a_page_asks_for_all_of_itself_once(server):
    async def ask_twice():
        visitor = await Visitor.enter(server.url)
        kind, content, _ = await visitor.ask("PULL-DOC-REQ", {})
        visitor.leave()
        return kind, content["text"]

    assert run(ask_twice()) == ("ERROR", "A page asks for all of itself once.")


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


def test_no_more_sessions_than_there_are_places_and_the_log_tells_no_key_of_a_vote(server):
    async def crowd():
        inside = [await Visitor.enter(server.url) for _ in range(2)]
        status, headers, text = get(f"{server.url}?tab=learn&room=ABCDEF.secret")
        assert status == 503 and headers["Retry-After"] and "Too many pages are open from your address." in text
        for visitor in inside:
            visitor.leave()

    run(crowd())
    assert get(f"{server.url}/nowhere?room=ABCDEF.secret")[0] == get(f"{server.root}/metrics")[0] == 404
    until(lambda: get(server.url)[0] == 200)
    assert "503 GET /app" not in server.log and "secret" not in server.log  # the refusal has a line already
    assert "Too many pages" in server.log and "Traceback" not in server.log


def test_who_leaves_while_he_connects_leaves_no_traceback(server):
    address = HTTPRequest(server.url.replace("http", "ws", 1) + "/ws", headers={"Origin": server.root})

    async def hasty(token):
        (await websocket_connect(address, subprotocols=["bokeh", token])).close()

    def token():
        return TOKEN.search(get(server.url)[2])  # none while the server is full

    for _ in range(12):
        run(hasty(until(token).group(1)))
    until(lambda: get(server.url)[0] == 200)
    assert "Traceback" not in server.log
