"""What a person sees when something breaks, with `python -m app`: a sentence, and afterwards all settings are back."""

import os
import re
import shutil
import signal
import subprocess
import sys
from contextlib import contextmanager
from pathlib import Path

import pytest
from serving import answers, served, until
from visiting import Visit, free_port
from watching import LOST as LOST_SERVER
from wire import Visitor, get, run

pytestmark = pytest.mark.served

LOST = "No connection to the server"
BACK = 60_000  # ms
ROOT = Path(__file__).parent.parent


class Stay(Visit):
    """A visit whose websocket can be cut."""

    def __init__(self, page, url):
        self.sockets = []
        page.route_web_socket(re.compile("/ws"), lambda each: self.sockets.append((each, each.connect_to_server())))
        super().__init__(page, url)

    def cut(self):
        """Both ends of the connection."""
        ours, theirs = self.sockets.pop()
        theirs.close()
        ours.close(code=1011)


def set_K_J(page, text):
    """Types K_J, waits until the address contains it, and marks the page: reloading removes the mark."""
    field = page.locator("input[type=text]").first
    field.fill(text)
    field.press("Enter")
    page.wait_for_function("text => location.search.includes('KJ=' + text)", arg=text)
    page.evaluate("window.mark = 1")


def has_come_back(page, K_J):
    """Waits until the page has been reloaded with this K_J."""
    page.wait_for_function("!window.mark && window.__tippe?.top3d?.pictures > 2", timeout=BACK)
    page.wait_for_function("text => location.search.includes('KJ=' + text)", arg=K_J)
    assert page.locator("input[type=text]").first.input_value() == K_J


@pytest.fixture
def page(chromium, page_errors):
    page_errors.allow(LOST_SERVER)
    page = chromium.new_page(viewport={"width": 1400, "height": 900})
    yield page
    page.close()


@pytest.fixture(scope="module")
def steady(tmp_path_factory):
    with served(tmp_path_factory.mktemp("steady") / "log") as server:
        yield server
        assert "Traceback" not in server.log


def goes_on(page):
    pictures = page.evaluate("__tippe.top3d.pictures")
    page.wait_for_function("n => __tippe.top3d.pictures > n", arg=pictures)


def test_graphics_that_are_taken_away_come_back_and_after_a_cut_the_page_is_as_it_was(page, steady):
    visit = Stay(page, steady.url)
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
    page.get_by_text("graphics memory away").first.wait_for()
    page.evaluate("lost.forEach((each) => each.restoreContext())")
    page.get_by_text("graphics memory away").first.wait_for(state="detached")
    goes_on(page)

    set_K_J(page, "6.5")
    visit.cut()
    page.get_by_text(LOST).wait_for()
    has_come_back(page, "6.5")


def test_after_the_server_was_lost_the_page_is_as_it_was(page, tmp_path):
    port = free_port()
    with served(tmp_path / "log", port=port) as server:
        Visit(page, server.url)
        set_K_J(page, "6.5")
        server.process.kill()
        page.get_by_text(LOST).wait_for()
        playing = page.evaluate("__tippe.top3d.t")
        page.wait_for_function("t => __tippe.top3d.t != t", arg=playing)  # the picture goes on without a server
    with served(tmp_path / "log", port=port):
        has_come_back(page, "6.5")


def test_a_visitor_who_stops_reading_holds_up_nobody(steady):
    async def stall(url):
        deaf, other = [await Visitor.enter(f"{url}?tab=roll") for _ in range(2)]
        for i in range(200):  # and never reads the answers
            await deaf.set(deaf.find("Dial")[0], "asked", [i, 6 + i / 1000, False])
        answered, _ = await other.answer(await other.set(other.find("Dial")[0], "asked", [1, 6.5, False]))
        deaf.leave(), other.leave()
        return answered

    assert run(stall(steady.url)) == "OK"


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no full disk to write to")
def test_a_full_disk_stops_nobody(tmp_path):
    port = free_port()
    with open("/dev/full", "w") as full:
        process = subprocess.Popen([sys.executable, "-m", "app"], cwd=ROOT, stdout=full, stderr=full,
                                   env={**os.environ, "TIPPE_PORT": str(port), "TMPDIR": "/dev/full"})  # fmt: skip
    try:
        until(lambda: answers(f"http://127.0.0.1:{port}/liveness"), 60)
        visitor = run(Visitor.enter(f"http://127.0.0.1:{port}/app"))
        assert visitor.component("LabView")
    finally:
        process.terminate()
        assert process.wait(10) == 0


def test_the_page_needs_no_place_to_write():
    """matplotlib does need one, for its list of fonts, but only when a figure is printed."""
    code = """
import sys
import app.page.page
print("matplotlib" in sys.modules, "app.share.prints" in sys.modules)"""
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, timeout=120)
    assert done.stdout.split()[-2:] == ["False", "True"], done.stderr[-2000:]


@contextmanager
def replicas(folder):
    """Two replicas behind the proxy of compose.yaml, and its root address."""
    port = free_port()
    common = {"proxy": 1, "secret": "s", "wait": False}
    with served(folder / "a", **common) as one, served(folder / "b", **common) as two:
        until(lambda: all(answers(each.root + "/readyz") for each in (one, two)), 60)
        servers = "\n".join(f"    server {name} {each.root[7:]}" for name, each in (("a", one), ("b", two)))
        text = (ROOT / "deploy/haproxy.cfg").read_text(encoding="utf-8").replace("bind :8080", f"bind 127.0.0.1:{port}")
        config = folder / "haproxy.cfg"
        config.write_text(re.sub(r"(?m)^    server-template.*$", servers, text))
        proxy = subprocess.Popen(["haproxy", "-f", config], stdout=subprocess.DEVNULL)
        try:
            until(lambda: answers(f"http://127.0.0.1:{port}/app"))
            yield one, two, f"http://127.0.0.1:{port}"
        finally:
            proxy.terminate()
            proxy.wait()


def with_sessions(*servers):
    """Of two replicas, the one that has a session, and the other."""
    return servers if '"sessions": 1' in get(servers[0].root + "/liveness")[2] else servers[::-1]


haproxy = pytest.mark.skipif(not shutil.which("haproxy"), reason="haproxy, the proxy of compose.yaml, is not installed")


@haproxy
@pytest.mark.long
def test_behind_the_proxy_a_session_survives_another_replica_and_returns_from_its_own(page, tmp_path):
    with replicas(tmp_path) as (one, two, root):
        Visit(page, f"{root}/app")
        page.evaluate("window.mark = 1")
        mine, other = with_sessions(one, two)
        other.process.kill()
        assert page.evaluate("window.mark") == 1
        set_K_J(page, "6.5")
        again = {"port": int(other.root.rsplit(":", 1)[1]), "proxy": 1, "secret": "s", "wait": False}
        with served(tmp_path / "c", **again):
            mine.process.send_signal(signal.SIGKILL)
            page.get_by_text(LOST).wait_for()
            has_come_back(page, "6.5")


@haproxy
@pytest.mark.long
def test_behind_the_proxy_a_replica_that_stops_sends_its_pages_to_the_other(page, tmp_path):
    with replicas(tmp_path) as (one, two, root):
        Visit(page, f"{root}/app")
        assert get(f"{root}/metrics")[0] == 403
        set_K_J(page, "6.5")
        mine, other = with_sessions(one, two)
        mine.process.send_signal(signal.SIGTERM)
        page.get_by_text(LOST).wait_for()
        has_come_back(page, "6.5")
        assert mine.process.wait(60) == 0 and '"sessions": 0' not in get(other.root + "/liveness")[2]


LISTENS_IN = """
import sys
def heard(event, arguments):
    if event in ("socket.connect", "socket.getaddrinfo", "socket.gethostbyname"):
        print("CALLS", event, arguments[event == "socket.connect"], flush=True)
sys.addaudithook(heard)
"""


def test_the_server_calls_nobody(tmp_path, monkeypatch):
    (tmp_path / "sitecustomize.py").write_text(LISTENS_IN)
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))

    async def visit(url):
        visitor = await Visitor.enter(f"{url}?tab=roll")
        answered, _ = await visitor.answer(await visitor.set(visitor.find("Dial")[0], "asked", [1, 6.5, False]))
        visitor.leave()
        return answered

    with served(tmp_path / "log", address="127.0.0.1") as server:
        assert run(visit(server.url)) == "OK"
        calls = [line for line in server.log.splitlines() if line.startswith("CALLS")]
    assert calls == ["CALLS socket.getaddrinfo 127.0.0.1"]  # its own address, to listen on
