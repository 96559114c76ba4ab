"""Servers for tests: `python -m app` with some settings, another command that serves the page, a Redis."""

import multiprocessing
import os
import runpy
import signal
import socket
import subprocess
import sys
import time
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from patience import PATIENCE, poll
from visiting import free_port
from wire import get


@dataclass
class Served:
    """A running server: its process, the page's address, and what it wrote."""

    process: subprocess.Popen
    url: str
    output: Path

    @property
    def log(self):
        """Everything logged so far."""
        return self.output.read_text(encoding="utf-8")

    @property
    def root(self):
        """The address without the page's path."""
        return self.url.rsplit("/", 1)[0]


# Code for a server: it looks for what is over so often, which otherwise takes seconds.
TIDY = """
import app.server.server as server
made, server.TIDY = server.BokehTornado, 0.2
server.BokehTornado = lambda *given, **named: made(*given, **named | {"check_unused_sessions_milliseconds": 200})
"""


def end(process, how=signal.SIGTERM):
    """Ends a server. One that does not end of itself is killed, and that is an error. SIGINT sends no page elsewhere
    first, which takes a second for each."""
    if process.poll() is None:
        process.send_signal(how)
    try:
        process.wait(PATIENCE)
    finally:
        process.kill()


ROOT = Path(__file__).parent.parent
IMPORTED = ["app.page.page", "app.server.server", "app.model.votes.desk"]  # what takes a server seconds


class Forked:
    """`python -m app`, forked from a process that has imported all of it: what Popen has, of such a process."""

    def __init__(self, arguments, environment, output, code):
        if multiprocessing.get_start_method(allow_none=True) != "forkserver":
            multiprocessing.set_start_method("forkserver", force=True)
            multiprocessing.set_forkserver_preload(IMPORTED)
        self._process = multiprocessing.Process(target=serve, args=(arguments, environment, str(output), code))
        self._process.start()
        self.pid, self.terminate, self.kill = self._process.pid, self._process.terminate, self._process.kill

    @property
    def returncode(self):
        return self._process.exitcode

    poll = returncode.fget

    def send_signal(self, how):
        os.kill(self.pid, how)

    def wait(self, seconds=None):
        self._process.join(seconds)
        if self.returncode is None:
            raise subprocess.TimeoutExpired("python -m app", seconds)
        return self.returncode


def serve(arguments, environment, output, code):
    """Runs `python -m app` in this process, after this code."""
    with open(output, "a") as file:
        for descriptor in (1, 2):
            os.dup2(file.fileno(), descriptor)
    os.chdir(ROOT)
    os.environ.clear()
    os.environ.update(environment)
    sys.argv = ["app", *arguments]
    exec(code, {})
    runpy.run_module("app", run_name="__main__", alter_sys=True)


@contextmanager
def served(output, wait=True, before=(), arguments=(), code="", **settings):
    """Runs `python -m app` with these settings until the end of the block. output: the file for its log. wait: begin
    the block when the server answers. before: a command that runs the rest of its arguments. code: runs first."""
    settings = {"port": free_port(), "address": "127.0.0.1"} | settings
    environment = {**os.environ, **{f"TIPPE_{name.upper()}": str(value) for name, value in settings.items()}}
    if before or os.name != "posix":
        with output.open("a") as file:
            process = subprocess.Popen([*before, sys.executable, "-m", "app", *arguments], env=environment, stdout=file,
                                       cwd=ROOT, stderr=subprocess.STDOUT)  # fmt: skip
    else:
        process = Forked(arguments, environment, output, code)
    root = f"http://127.0.0.1:{settings['port']}"
    try:
        if wait:
            until(lambda: process.poll() is not None or answers(root + "/liveness"))
            assert process.poll() is None, output.read_text(encoding="utf-8")
        yield Served(process, root + settings.get("prefix", "") + "/app", output)
    finally:
        end(process, signal.SIGINT if os.name == "posix" else signal.SIGTERM)


@contextmanager
def redis_serving(port):
    """Runs a Redis without files until the end of the block, and gives its URL."""
    process = subprocess.Popen(["redis-server", "--port", str(port), "--bind", "127.0.0.1", "--save", "",
                                "--appendonly", "no"], stdout=subprocess.DEVNULL)  # fmt: skip
    try:
        until(lambda: listens(port))
        yield f"redis://127.0.0.1:{port}/0"
    finally:
        process.kill()
        process.wait()


def listens(port):
    """Whether a server accepts connections on this port."""
    with socket.socket() as probe:
        return probe.connect_ex(("127.0.0.1", port)) == 0


@contextmanager
def serving(command, output, folder):
    """Runs a command that serves the page until the end of the block. Waits until it answers or has ended."""
    port = free_port()
    with output.open("w") as file:
        process = subprocess.Popen([*command, "--port", str(port), "--address", "localhost"], cwd=folder, stdout=file,
                                   stderr=subprocess.STDOUT)  # fmt: skip
    url = f"http://localhost:{port}/app"
    try:
        until(lambda: process.poll() is not None or answers(url))
        yield Served(process, url, output)
    finally:
        end(process)


def megabytes(pid):
    """The resident memory of a process."""
    return int(Path(f"/proc/{pid}/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6


def answers(url):
    """Whether a GET request succeeds."""
    try:
        return get(url)[0] == 200
    except OSError:
        return False


def until(condition, seconds=PATIENCE):
    """Waits until a condition is true, and returns its value."""
    return poll(condition, lambda: time.sleep(0.05), seconds)
