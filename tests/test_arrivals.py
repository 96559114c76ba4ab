"""More connections than the system allows open files: they wait, the log says so in one line, and idle ones are
closed."""

import asyncio
import os
import resource
import socket
import sys
from itertools import count
from pathlib import Path
from urllib.parse import urlsplit

import pytest
from serving import served, serving, until
from tornado.httpserver import HTTPServer
from tornado.netutil import bind_sockets
from tornado.web import Application
from wire import Visitor, get, run

from app.server import arrivals

pytestmark = pytest.mark.served

FEW = 96  # open files
UNDER = ["sh", "-c", f'ulimit -n {FEW} && exec "$@"', "sh"]

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
def test_more_connections_than_files_wait_and_then_come_in(tmp_path):
    async def crowded(server):
        inside = await Visitor.enter(f"{server.url}?tab=roll")
        connections = await asyncio.to_thread(crowd, server.url, 3 * FEW)
        await asyncio.to_thread(until, lambda: "no more connections for now" in server.log)
        answered, _ = await inside.answer(await inside.set(inside.find("Dial")[0], "asked", [1, 6.5, False]))
        inside.leave()
        return answered, connections

    with served(tmp_path / "log", before=UNDER) as server:
        answered, connections = run(crowded(server))
        assert answered == "OK"
        # waiting connections are accepted when the first ones have gone, and all are closed in the end
        until(lambda: all(map(closed, connections)), 60)
        assert get(server.url)[0] == 200
        assert run(Visitor.enter(server.url)).component("LabView")
        assert server.log.count("no more connections") == 1 and len(server.log.splitlines()) < 10
        for each in connections:
            each.close()


@pytest.mark.slow
def test_those_who_do_not_read_what_they_asked_for_make_room(tmp_path):
    """While data is being sent to them, they do not use a second open file each."""
    with served(tmp_path / "log", before=UNDER) as server:
        connections = [greedy(server.url) for _ in range(FEW)]
        assert run(Visitor.enter(server.url)).component("LabView")
        assert "no more connections" in server.log and len(server.log.splitlines()) < 10
        for each in connections:
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


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc/self/limits").exists(), reason="reads Linux's list of limits")
@pytest.mark.parametrize("command", ["app", "panel serve app"])
def test_the_server_raises_its_limit(command, tmp_path):
    hard = resource.getrlimit(resource.RLIMIT_NOFILE)[1]
    limited = ["sh", "-c", 'ulimit -S -n 256 && exec "$@"', "sh", sys.executable, "-m", *command.split()]
    with serving(limited, tmp_path / "log", Path(__file__).parent.parent) as server:
        [line] = [line for line in Path(f"/proc/{server.process.pid}/limits").read_text().splitlines()
                  if line.startswith("Max open files")]  # fmt: skip
        assert int(line.split()[3]) == min(hard, 65_536)
