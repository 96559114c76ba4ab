"""Accepts connections while there is room for them; otherwise they wait unaccepted.

To the system each connection is an open file, and a process may have only so many (ulimit -n). At the limit no
connection can be accepted, and a server that keeps trying does nothing else any more.
"""

import logging
import os
import time
from weakref import WeakSet

from tornado.ioloop import IOLoop
from tornado.iostream import IOStream

try:
    import resource
except ImportError:  # Windows, where connections are not counted with the files
    resource = None

log = logging.getLogger("tippe")

FILES = (65_536, 10_240, 4_096)  # limits to ask for; macOS allows 10,240 whatever it reports
OTHERS = 64  # of them are reserved for other things, or a quarter if there are few
STALLED = 10.0  # s without a byte read, after which a connection may be closed to make room
LOOK_AGAIN = 0.25  # s
SAY_AGAIN = 60.0  # s
AT_ONCE = 64  # connections, before the others are served


def most_files():
    """Raises the limit of open files as far as the system allows and returns it; None if there is none."""
    if resource is None:
        return None
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    unlimited = resource.RLIM_INFINITY
    for files in FILES if hard == unlimited else (min(files, hard) for files in FILES):
        if soft == unlimited or soft >= files:
            break
        try:
            resource.setrlimit(resource.RLIMIT_NOFILE, (files, hard))
            return files
        except (OSError, ValueError):
            continue
    return None if soft == unlimited else soft


class Stream(IOStream):
    """A stream that records when it last sent a byte."""

    def __init__(self, *arguments, **named):
        super().__init__(*arguments, **named)
        self.sent = time.monotonic()

    def write_to_fd(self, data):
        count = super().write_to_fd(data)
        if count:
            self.sent = time.monotonic()
        return count


class Arrivals:
    """Accepts connections at listening sockets for an HTTPServer. files: from most_files()."""

    def __init__(self, http, sockets, files):
        self.sockets, self._http, self._files = sockets, http, files
        self._last = None if files is None else files - min(OTHERS, files // 4)
        self._said, self._again, self._streams = -SAY_AGAIN, None, WeakSet()

    def start(self):
        """Starts accepting."""
        for each in self.sockets:
            IOLoop.current().add_handler(each, self._arrived, IOLoop.READ)

    def stop(self):
        """Stops accepting; the sockets stay open."""
        for each in self.sockets:
            IOLoop.current().remove_handler(each)
        if self._again is not None:
            IOLoop.current().remove_timeout(self._again)

    def _arrived(self, listening, _events):
        for _ in range(AT_ONCE):
            try:
                connection, address = listening.accept()
            except (BlockingIOError, ConnectionAbortedError):
                return
            except OSError as error:  # no room, whatever the reason
                self._wait(error.strerror)
                return
            stream = Stream(connection, max_buffer_size=self._http.max_buffer_size,
                            read_chunk_size=self._http.read_chunk_size)  # fmt: skip
            self._streams.add(stream)
            self._http.handle_stream(stream, address)
            # The system gives each file the least number that is free: all below are open.
            if self._last is not None and connection.fileno() >= self._last:
                self._wait(f"{connection.fileno() + 1} of {self._files} files are open")
                return

    def _wait(self, reason):
        self.stop()
        if time.monotonic() - self._said > SAY_AGAIN:
            self._said = time.monotonic()
            log.warning("no more connections for now: %s (ulimit -n); who comes waits until others leave", reason)
        self._again = IOLoop.current().call_later(LOOK_AGAIN, self._look)

    def _look(self):
        """Whether there is room again."""
        now = time.monotonic()
        for stream in tuple(self._streams):
            if stream.writing() and now - stream.sent > STALLED:
                stream.close()
        try:
            probe = os.open(os.devnull, os.O_RDONLY)
        except OSError:
            probe = None
        else:
            os.close(probe)
        if probe is None or (self._last is not None and probe >= self._last):
            self._again = IOLoop.current().call_later(LOOK_AGAIN, self._look)
        else:
            self.start()
