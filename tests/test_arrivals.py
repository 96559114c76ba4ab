"""More connections than the system allows open files: they wait, the log says so in one line, and idle ones are
closed."""

import asyncio
import os
import resource
import socket
import sys
from itertools import count
from types import SimpleNamespace
from urllib.parse import urlsplit

import pytest
from serving import served, until
from tornado.httpserver import HTTPServer
from tornado.netutil import bind_sockets
from tornado.web import Application
from wire import Visitor, run

from app import app_hooks
from app.server import arrivals

FEW = 96  # open files
UNDER = f"import resource; resource.setrlimit(resource.RLIMIT_NOFILE, ({FEW}, {FEW}))"

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="there, sockets are not counted with the files")


def crowd(url, many):
    """Opens this many connections that ask for nothing."""
    place = urlsplit(url)
    return [socket.create_connection((place.hostname, place.port), timeout=60) for _ in range(many)]


def greedy(url):
    """A connection that requests large files, one after the other, and reads nothing."""
    place = urlsplit(url)
    connection = socket.socket()
    connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
    connection.settimeout(60)
    connection.connect((place.hostname, place.port))
    connection.sendall(20 * f"GET /static/js/bokeh.min.js HTTP/1.1\r\nHost: {place.netloc}\r\n\r\n".encode())
    return connection


def closed(connection):
    """Whether the server has closed it."""
    connection.setblocking(False)
    try:
        return connection.recv(1) == b""
    except BlockingIOError:
        return False


@pytest.mark.slow
@pytest.mark.served
def test_more_connections_than_files_wait_and_come_in_when_those_before_have_gone(tmp_path):
    """Those who say nothing, and those who do not read what they asked for, are closed. While data are being sent to
    these, they do not use a second open file each. Who is inside notices nothing."""

    async def crowded(server):
        inside = await Visitor.enter(f"{server.url}?tab=roll")
        silent = await asyncio.to_thread(crowd, server.url, 2 * FEW)
        await asyncio.to_thread(until, lambda: "no more connections for now" in server.log)
        answered, _ = await inside.answer(await inside.set(inside.group("K_J"), "asked", [1, "K_J", 6.5, False]))
        inside.leave()
        return answered, silent

    with served(tmp_path / "log", code=UNDER) as server:
        answered, silent = run(crowded(server))
        assert answered == "OK"
        deaf = [greedy(server.url) for _ in range(FEW)]
        assert run(Visitor.enter(server.url)).component("LabView")
        until(lambda: all(map(closed, silent)))
        assert server.log.count("no more connections") == 1 and len(server.log.splitlines()) < 10
        for each in silent + deaf:
            each.close()


def test_a_server_that_stops_takes_nobody_again(monkeypatch, caplog):
    monkeypatch.setattr(arrivals, "LOOK_AGAIN", 0)

    def free():
        """The number that the next opened file gets."""
        number = os.open(os.devnull, os.O_RDONLY)
        os.close(number)
        return number

    async def stopped():
        [listening] = bind_sockets(0, "127.0.0.1")
        room = free() + 1  # for the client's end, but not for the server's
        files = next(files for files in count() if files - min(arrivals.OTHERS, files // 4) == room)
        arriving = arrivals.Arrivals(HTTPServer(Application()), [listening], files)
        arriving.start()
        caller = await asyncio.to_thread(socket.create_connection, listening.getsockname())
        while "no more connections" not in caplog.text:
            await asyncio.sleep(0)
        arriving.stop()
        listening.close()
        caller.close()
        while free() >= room:
            await asyncio.sleep(0)
        for _ in range(10):  # now it would notice that there is room again
            await asyncio.sleep(0)

    run(stopped())
    assert "Exception" not in caplog.text


def test_as_many_files_are_asked_for_as_may_be(monkeypatch):
    unlimited = resource.RLIM_INFINITY
    for soft, hard, refuses, found in (
        (256, 4096, None, 4096), (256, unlimited, 10_241, 10_240),  # macOS
        (1024, 1 << 20, None, 65_536), (1024, 20_000, None, 20_000), (1 << 20, 1 << 20, None, 1 << 20),
        (64, 64, None, 64), (unlimited, unlimited, None, None),
    ):  # fmt: skip
        limit = [soft, hard]

        def raised(_, wanted, limit=limit, refuses=refuses):
            if refuses and wanted[0] >= refuses:
                raise ValueError("not allowed")
            limit[:] = wanted

        monkeypatch.setattr(arrivals.resource, "getrlimit", lambda _, limit=limit: tuple(limit))
        monkeypatch.setattr(arrivals.resource, "setrlimit", raised)
        assert arrivals.most_files() == found
        assert limit[1] == hard and (found is None or limit[0] == found)


def test_panel_serve_raises_the_limit_too(monkeypatch):
    did = []
    for name in ("compile_beside", "mend", "in_one_thread", "most_files"):
        monkeypatch.setattr(app_hooks, name, lambda *given, name=name: did.append(name))

    async def load():
        app_hooks.on_server_loaded(SimpleNamespace(application_context=None))

    run(load())
    assert "most_files" in did
