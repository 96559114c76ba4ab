"""Serves the page in the process of the tests, so that they can inspect it, and make it fail."""

import asyncio
import threading
from contextlib import contextmanager
from pathlib import Path

from bokeh.server.server import Server
from panel.io.application import build_single_handler_application
from serving import until
from tornado.ioloop import IOLoop

APP = Path(__file__).parent.parent / "app"
LINGER = 1  # ms that a session is kept after its page has closed


class Inside:
    """A server in this process."""

    def __init__(self, server, loop):
        self.url, self.loop, self._server = f"http://localhost:{server.port}/app", loop, server

    @property
    def sessions(self):
        """Bokeh's live sessions."""
        return self._server.get_sessions("/app")

    def wait_for_sessions(self, count):
        """Waits until there are this many sessions."""
        until(lambda: len(self.sessions) == count, 120)


@contextmanager
def inside(linger=LINGER):
    """Runs an Inside until the end of the block."""
    there, found = threading.Event(), []

    async def serve():
        done = asyncio.Event()
        server = Server({"/app": build_single_handler_application(APP)}, io_loop=IOLoop.current(), port=0,
                        unused_session_lifetime_milliseconds=linger, check_unused_sessions_milliseconds=20,
                        websocket_max_message_size=2**27)  # fmt: skip
        server.start()
        found.extend((Inside(server, asyncio.get_running_loop()), done))
        there.set()
        await done.wait()
        server.stop()
        await asyncio.sleep(0.1)

    thread = threading.Thread(target=lambda: asyncio.run(serve()), daemon=True)
    thread.start()
    assert there.wait(60)
    served, done = found
    try:
        yield served
    finally:
        served.loop.call_soon_threadsafe(done.set)
        thread.join(60)
