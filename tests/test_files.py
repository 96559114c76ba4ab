"""More connections than the system allows open files: they are closed, the log says so in one line, and so are idle
ones."""

import asyncio
import resource
import socket
import sys
from types import SimpleNamespace
from urllib.parse import urlsplit

import pytest
from serving import served, until
from wire import Visitor, run

from app import app_hooks
from app.server import files

FEW = 96  # open files
UNDER = f"import resource; resource.setrlimit(resource.RLIMIT_NOFILE, ({FEW}, {FEW}))"

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="there, sockets are not counted with the files")


def crowd(url, many):
    """Opens this many connections that ask for nothing."""
    place = urlsplit(url)
    return [socket.create_connection((place.hostname, place.port), timeout=60) for _ in range(many)]


def closed(connection):
    """Whether the server has closed it."""
    connection.setblocking(False)
    try:
        return connection.recv(1) == b""
    except BlockingIOError:
        return False


@pytest.mark.slow
@pytest.mark.served
def test_more_connections_than_files_are_closed_and_others_come_in_when_those_before_have_gone(tmp_path):
    """Those who say nothing are closed after some seconds. Who is inside notices nothing."""

    async def crowded(server):
        inside = await Visitor.enter(f"{server.url}?tab=roll")
        silent = await asyncio.to_thread(crowd, server.url, 2 * FEW)
        await asyncio.to_thread(until, lambda: "as many files are open" in server.log)
        answered, _ = await inside.answer(await inside.set(inside.group("K_J"), "request", [1, "K_J", 6.5, False]))
        inside.leave()
        return answered, silent

    with served(tmp_path / "log", code=UNDER) as server:
        answered, silent = run(crowded(server))
        assert answered == "OK"
        until(lambda: all(map(closed, silent)))
        assert run(Visitor.enter(server.url)).component("LabView")
        assert len(server.log.splitlines()) < 10 and "Too many open files" not in server.log
        for each in silent:
            each.close()


def test_as_many_files_are_asked_for_as_may_be(monkeypatch):
    unlimited = resource.RLIM_INFINITY
    for soft, hard, refuses, most in (
        (256, 4096, None, 4096), (256, unlimited, 10_241, 10_240),  # macOS
        (1024, 1 << 20, None, 65_536), (1024, 20_000, None, 20_000), (1 << 20, 1 << 20, None, 1 << 20),
        (64, 64, None, 64), (unlimited, unlimited, None, None),
    ):  # fmt: skip
        limit = [soft, hard]

        def raised(_, wanted, limit=limit, refuses=refuses):
            if refuses and wanted[0] >= refuses:
                raise ValueError("not allowed")
            limit[:] = wanted

        monkeypatch.setattr(files.resource, "getrlimit", lambda _, limit=limit: tuple(limit))
        monkeypatch.setattr(files.resource, "setrlimit", raised)
        assert files.most_files() == most
        assert limit[1] == hard and (most is None or limit[0] == most)


def test_panel_serve_raises_the_limit_too(monkeypatch):
    did = []
    for name in ("compile_beside", "mend", "in_one_thread", "most_files"):
        monkeypatch.setattr(app_hooks, name, lambda *given, name=name: did.append(name))

    async def load():
        app_hooks.on_server_loaded(SimpleNamespace(application_context=None))

    run(load())
    assert "most_files" in did
