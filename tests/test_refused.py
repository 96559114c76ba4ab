"""A page that is refused at its socket says why, and comes by itself."""

import re
import sys
from types import SimpleNamespace

import pytest
from bokeh.util.token import generate_jwt_token, generate_session_id
from serving import served
from visiting import wait
from watching import LOST
from wire import run

from app.server.door import Door
from app.server.server import FRESH
from app.server.settings import Settings
from app.server.sockets import SOCKETS, Socket
from app.text import LANGUAGES, say
from app.widgets.waiting import REASONS, waiting

SECRET = b"secret"
HERE = "() => window.Bokeh?.documents?.length > 0"


def refused(name, expiration=FRESH, sessions=(), sockets=(), stopping=False, limits=None):
    """How the server closes the socket of a page with this session: (code, reason)."""
    context = SimpleNamespace(sessions=list(sessions))
    door = Door(Settings(**(limits or {})), context)
    door.sockets.update(sockets)
    door.stopping = stopping
    socket, closed = Socket.__new__(Socket), []
    socket.application = SimpleNamespace(door=door, secret_key=SECRET)
    socket.request = SimpleNamespace(remote_ip="127.0.0.1")
    socket.token = generate_jwt_token(name, secret_key=SECRET, signed=True, expiration=expiration)
    socket.close = lambda *how: closed.append(how)
    run(socket._enter())
    return closed


def session(connections, name=""):
    return SimpleNamespace(connection_count=connections, id=name, request_expiration=lambda: None)


MINE = generate_session_id(secret_key=SECRET, signed=True)


class His:
    """Another socket of this address."""

    address = "127.0.0.1"


@pytest.mark.parametrize(
    ("reason", "how"),
    [
        ("ended", {"expiration": -1}),
        ("full", {"sessions": [session(1)], "limits": {"sessions": 1}}),
        ("crowded", {"sockets": [His()], "limits": {"sessions_per_address": 1}}),
        ("crowded", {"sessions": [session(SOCKETS, MINE)]}),
        ("stopping", {"stopping": True}),
        ("stopping", {"stopping": True, "sessions": [session(0, MINE)]}),
    ],
)
def test_the_reason_begins_with_its_name_for_which_the_page_has_words(reason, how):
    [(code, said)] = refused(MINE, **how)
    assert code == 4000 and said.startswith(f"{reason}: ") and reason in REASONS
    for language in LANGUAGES:
        assert say(f"main.server.{reason}", language) in waiting(language)


def test_a_page_on_a_slow_line_has_time():
    """1.6 MB at 100 kbit/s, or for 200 telephones at 20 Mbit/s, take 130 s."""
    assert FRESH >= 4 * 130


@pytest.fixture
def page(chromium, page_errors):
    page_errors.allow(f"{LOST}|Failed to load Bokeh|Error rendering Bokeh items")
    page = chromium.new_page(viewport={"width": 1400, "height": 900})
    yield page
    page.close()


def hold(page, name):
    """Holds back a script of the page until the function that is returned is called."""
    held, free = [], []

    def came(route):
        if free:
            route.continue_()
        else:
            held.append(route)

    def go():
        wait(page, lambda: held)
        free.append(True)
        for route in held:
            route.continue_()

    page.route(re.compile(re.escape(name)), came)
    return go


# The first page's token has ended when it is sent.
OLD = """
import runpy, sys
import app.server.pages as pages
real, first = pages.generate_jwt_token, [-60]
def given(*arguments, expiration, **named):
    return real(*arguments, expiration=first.pop() if first else expiration, **named)
pages.generate_jwt_token = given
sys.argv[1:] = sys.argv[4:]
runpy.run_module("app", run_name="__main__", alter_sys=True)
"""


@pytest.mark.served
def test_a_page_whose_scripts_came_too_late_says_so_and_comes_by_itself(page, tmp_path):
    with served(tmp_path / "log", before=[sys.executable, "-c", OLD]) as server:
        go = hold(page, "/bokeh.min.js")
        page.goto(server.url, wait_until="commit")
        page.get_by_text(say("main.server.coming", "en")).wait_for()
        go()
        page.get_by_text(say("main.server.ended", "en")).wait_for()
        page.wait_for_function(HERE)
        assert not page.locator("#waiting").count()
        assert "ended: " in server.log


@pytest.mark.served
def test_a_page_for_which_there_was_no_room_comes_when_there_is(page, chromium, tmp_path):
    with served(tmp_path / "log", sessions=1, linger=1) as server:
        go = hold(page, "/bokeh.min.js")
        page.goto(server.url, wait_until="commit")
        other = chromium.new_page()
        other.goto(server.url)
        other.wait_for_function(HERE)
        go()
        page.get_by_text(say("main.server.full", "en")).wait_for()
        assert page.get_by_role("button", name=say("main.server.now", "en")).is_visible()
        other.close()
        page.wait_for_function(HERE)
