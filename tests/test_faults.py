"""What a person sees when something breaks, with `python -m app`: a sentence, and afterwards all settings are back."""

import asyncio
import os
import re
import shutil
import signal
import subprocess
import sys
from contextlib import contextmanager, suppress
from pathlib import Path
from types import SimpleNamespace

import pytest
from bokeh.util.token import generate_jwt_token, generate_session_id
from components import alone as alone
from components import lab as lab
from lab_page import DRAWN, entry, put
from serving import answers, end, served, until
from test_operating import until_told
from tornado.httpclient import HTTPClientError
from visiting import free_port, wait
from watching import LOST
from wire import TOKEN, Closed, Visitor, get, run

from app.server.admission import Admission
from app.server.server import FRESH
from app.server.settings import Settings
from app.server.sockets import SOCKETS, Socket
from app.text import LANGUAGES, say
from app.widgets.waiting import REASONS, waiting

ROOT = Path(__file__).parent.parent
SPIN = "Spin, in turns a second"
HERE = "() => window.Bokeh?.documents?.length > 0"


def set_spin(page, text):
    """Types the spin of Explore, waits until the address has it, and marks the page: reloading removes the mark."""
    page.wait_for_function(DRAWN)
    put(page, SPIN, text)
    page.wait_for_function("text => location.search.includes('spin=' + text)", arg=text)
    page.evaluate("window.mark = 1")


def has_come_back(page, spin):
    """Waits until the page has been reloaded with this spin."""
    page.wait_for_function(f"!window.mark && {DRAWN}")
    page.wait_for_function("text => location.search.includes('spin=' + text)", arg=spin)
    wait(page, lambda: entry(page, SPIN).input_value() == spin)


@pytest.fixture
def page(chromium, page_errors):
    page_errors.allow(f"{LOST}|Failed to load Bokeh|Error rendering Bokeh items")
    page = chromium.new_page(viewport={"width": 1400, "height": 900}, reduced_motion="reduce")
    yield page
    page.close()


# --- the page is there


def goes_on(page):
    drawn = "__tippe.tops('lab')[0].pictures"
    page.wait_for_function(f"n => {drawn} > n", arg=page.evaluate(drawn))


@pytest.mark.served
def test_graphics_memory_that_is_taken_away_is_said_and_the_picture_goes_on_when_it_is_back(lab):
    page = lab(draws=True, reduced_motion="no-preference").page  # it must go on
    page.evaluate("""() => {
        const { prototype } = WebGL2RenderingContext, { fenceSync } = prototype
        prototype.fenceSync = () => { prototype.fenceSync = fenceSync; return null }
    }""")  # what a picture finds between the loss and its event
    page.wait_for_function("WebGL2RenderingContext.prototype.fenceSync.length > 0")
    goes_on(page)
    page.evaluate("""() => {
        const canvases = []
        const look = (root) => { for (const each of root.querySelectorAll("*")) {
            if (each.localName == "canvas" && each.getContext("webgl2")) canvases.push(each)
            if (each.shadowRoot) look(each.shadowRoot) } }
        look(document)
        window.lost = canvases.map((canvas) => canvas.getContext("webgl2").getExtension("WEBGL_lose_context"))
        lost.forEach((each) => each.loseContext())
    }""")
    told = page.get_by_text("graphics memory away").locator("visible=true")
    told.first.wait_for()
    page.evaluate("lost.forEach((each) => each.restoreContext())")
    wait(page, lambda: not told.count())
    goes_on(page)


@contextmanager
def behind(proxy, *servers):
    """Runs the proxy of compose.yaml in front of these replicas; gives its root address."""
    port = free_port()
    lines = "\n".join(f"    server {i} {each.root[7:]}" for i, each in enumerate(servers))
    text = (ROOT / "deploy/haproxy.cfg").read_text(encoding="utf-8").replace("bind :8080", f"bind 127.0.0.1:{port}")
    proxy.write_text(re.sub(r"(?m)^    server-template.*$", lines, text))
    process = subprocess.Popen(["haproxy", "-f", proxy], stdout=subprocess.DEVNULL)
    try:
        until(lambda: answers(f"http://127.0.0.1:{port}/app"))
        yield f"http://127.0.0.1:{port}"
    finally:
        end(process)


async def comes(url, cookie):
    """(a Visitor who asks as often as it takes, his cookie then)."""
    while True:
        status, headers, text = get(url, Cookie=cookie)
        if status == 200:
            cookie = headers.get("Set-Cookie", cookie).split(";")[0]
            with suppress(Closed, HTTPClientError):
                return await Visitor.enter(url, TOKEN.search(text)[1], {"Cookie": cookie}), cookie
        await asyncio.sleep(0.1)


@pytest.mark.served
@pytest.mark.skipif(not shutil.which("haproxy"), reason="haproxy, the proxy of compose.yaml, is not installed")
def test_behind_the_proxy_a_page_goes_to_another_replica_when_its_own_stops_or_is_killed(tmp_path):
    """A page in a browser comes back by loading its address again, as above."""
    common = {"proxy": 1, "secret": "s", "wait": False}

    async def visit(url):
        visitor, cookie = await comes(url, "")
        mine, other = (one, two) if '"sessions": 1' in get(one.root + "/liveness")[2] else (two, one)
        mine.process.send_signal(signal.SIGTERM)
        await until_told(visitor)
        visitor, cookie = await comes(url, cookie)
        assert mine.process.wait(60) == 0 and '"sessions": 0' not in get(other.root + "/liveness")[2]
        with served(tmp_path / "c", **common | {"port": int(mine.root.rsplit(":", 1)[1])}) as again:
            until(lambda: answers(again.root + "/readyz"))
            # what becomes of another replica does not disturb it
            await visitor.answer(await visitor.set("p0", "no", 0))
            other.process.kill()
            with pytest.raises(Closed):
                await visitor.receive()
            await comes(url, cookie)
            assert '"sessions": 0' not in get(again.root + "/liveness")[2]

    with served(tmp_path / "a", **common) as one, served(tmp_path / "b", **common) as two:
        until(lambda: all(answers(each.root + "/readyz") for each in (one, two)))
        with behind(tmp_path / "haproxy.cfg", one, two) as root:
            assert get(f"{root}/metrics")[0] == 403
            run(visit(f"{root}/app"))


# --- the page is not yet there

SECRET = b"secret"
MINE = generate_session_id(secret_key=SECRET, signed=True)


def session(connections, name=""):
    return SimpleNamespace(connection_count=connections, id=name, request_expiration=lambda: None)


@pytest.mark.parametrize(
    ("reason", "how"),
    [
        ("ended", {"expiration": -1}),
        ("full", {"sessions": [session(1)], "limits": {"sessions": 1}}),
        ("crowded", {"sockets": [SimpleNamespace(address="127.0.0.1")], "limits": {"sessions_per_address": 1}}),
        ("crowded", {"sessions": [session(SOCKETS, MINE)]}),
        ("stopping", {"stopping": True}),
        ("stopping", {"stopping": True, "sessions": [session(0, MINE)]}),
    ],
)
def test_the_reason_begins_with_its_name_for_which_the_page_has_words(reason, how):
    admission = Admission(Settings(**how.get("limits", {})), SimpleNamespace(sessions=how.get("sessions", [])))
    admission.sockets, admission.stopping = how.get("sockets", []), how.get("stopping", False)
    socket, closed = Socket.__new__(Socket), []
    socket.application = SimpleNamespace(admission=admission, secret_key=SECRET)
    socket.request = SimpleNamespace(remote_ip="127.0.0.1")
    socket.token = generate_jwt_token(MINE, secret_key=SECRET, signed=True, expiration=how.get("expiration", FRESH))
    socket.close = lambda *how: closed.append(how)
    socket.open()
    [(code, said)] = closed
    assert code == 4000 and said.startswith(f"{reason}: ") and reason in REASONS
    for language in LANGUAGES:
        assert say(f"main.server.{reason}", language) in waiting(language)


def test_a_page_on_a_slow_line_has_time():
    """1.6 MB at 100 kbit/s, or for 200 telephones at 20 Mbit/s, take 130 s."""
    assert FRESH >= 4 * 130


# The first page's token has ended when it is sent.
OLD = """
import app.server.pages as pages
real, first = pages.generate_jwt_token, [-60]
def given(*arguments, expiration, **named):
    return real(*arguments, expiration=first.pop() if first else expiration, **named)
pages.generate_jwt_token = given
"""


# What app/widgets/waiting.js does after some seconds waits for pass().
HELD = """{ const { setTimeout: later } = window, held = [], itsOwn = /location\\.reload|isHere/
window.setTimeout = (run, ...given) => itsOwn.test(String(run)) ? held.push(run) : later(run, ...given)
window.pass = () => { held.splice(0).forEach((run) => run()) } }"""
SAYS = "(text) => { window.pass(); return document.getElementById('waiting')?.textContent.includes(text) }"
COMES = f"() => {{ window.pass(); return ({HERE})() }}"


def hold(page, name):
    """Holds back a script of the page until the function that is returned is called."""
    held, free = [], []
    page.route(re.compile(re.escape(name)), lambda route: route.continue_() if free else held.append(route))

    def go():
        wait(page, lambda: held)
        free.append(True)
        for route in held:
            route.continue_()

    return go


@pytest.mark.served
def test_a_page_that_is_refused_at_its_socket_says_why_and_comes_by_itself(page, tmp_path):
    """Its scripts came too late; tests/frontend/waiting.test.js has all reasons."""
    page.add_init_script(HELD)
    with served(tmp_path / "log", code=OLD) as server:
        go = hold(page, "/bokeh.min.js")
        page.goto(server.url, wait_until="commit")
        page.wait_for_function(SAYS, arg=say("main.server.coming", "en"))
        go()
        page.get_by_text(say("main.server.ended", "en")).wait_for()
        page.wait_for_function(COMES)
        wait(page, lambda: not page.locator("#waiting").count())
        assert "ended: " in server.log


# --- the system


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
"""Runs the server without what is missing on Windows, or in its Python; elsewhere SIGALRM is 14."""


LISTENS_IN = """
import os, sys
calls = open(os.environ["CALLS"], "a", buffering=1)
def heard(event, arguments):
    if event in ("socket.connect", "socket.getaddrinfo", "socket.gethostbyname"):
        print(event, arguments[event == "socket.connect"], file=calls)
    elif event == "import" and arguments[0] == "matplotlib":
        print(*arguments[:1], file=calls)
sys.addaudithook(heard)
"""


@pytest.mark.served
@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no full disk to write to")
def test_on_a_full_disk_where_the_system_lacks_what_windows_lacks_it_serves_and_calls_nobody(tmp_path):
    """matplotlib needs a place to write, for its list of fonts, but only when a figure is printed."""
    (tmp_path / "sitecustomize.py").write_text(LISTENS_IN)
    port, calls, command = free_port(), tmp_path / "calls", [sys.executable, "-c", LACKS, "", "", ""]
    room = os.environ | {"TIPPE_PORT": str(port), "TIPPE_ADDRESS": "127.0.0.1", "TMPDIR": "/dev/full",
                         "PYTHONPATH": str(tmp_path), "CALLS": str(calls)}  # fmt: skip

    async def visit():
        visitor = await Visitor.enter(f"http://127.0.0.1:{port}/app?tab=roll")
        answered, _ = await visitor.answer(await visitor.set(visitor.group("K_J"), "request", [1, "K_J", 6.5, False]))
        visitor.leave()
        return answered

    with open("/dev/full", "w") as full:
        process = subprocess.Popen(command, cwd=ROOT, stdout=full, stderr=full, env=room)
    try:
        until(lambda: answers(f"http://127.0.0.1:{port}/liveness"))
        assert run(visit()) == "OK"
        assert calls.read_text().splitlines() == ["socket.getaddrinfo 127.0.0.1"]  # its own address, to listen on
        done = subprocess.run([*command, "--workers=2"], cwd=ROOT, capture_output=True, text=True)
        assert done.returncode == 2 and "'2'; allowed is a whole number from 1 to 1: this system" in done.stderr
    finally:
        process.terminate()
        assert process.wait(60) == 0
