"""Shared memory in which each worker reports its state once a second, so that any worker can tell whether a new page
would be let in by any of them, and how the whole server is doing."""

import mmap
import os
import time
from collections import deque

import numpy as np
from tornado.ioloop import IOLoop

from app.kernels import compiling
from app.model.runs import FILES, LATER, MAPS, WORK
from app.model.votes.desk import DESK
from app.server.logs import SELDOM
from app.server.memory import memory
from app.turns import rooms

STEP = 1.0  # s
HEARD = 15.0  # s after which a worker that reports nothing counts as ended
REMEMBERED = 15  # steps over which the longest delay is reported
REFUSALS = ("stranger", "full", "crowded", "stopping", "ended", "failed", "connection", "message")
POOLS = {"run": WORK, "later": LATER, "file": FILES, "map": MAPS}
# Each reports how many wait, how many had their turn, and how long those waited.
QUEUES = ("session", "room", *POOLS)
STATES = ("full", "stopping", "compiling")
FIELDS = ("at", *STATES, "sessions", "connections", "delay", "memory", "files", "moves", "moving", "errors",
          "processor", "started", "away",
          *(f"refused {why}" for why in REFUSALS),
          *(f"{queue} {each}" for queue in QUEUES for each in ("waiting", "turns", "waited")))  # fmt: skip


def files():
    """The number of open files of this process; nan if unknown."""
    return next((float(len(os.listdir(path))) for path in ("/proc/self/fd", "/dev/fd") if os.path.isdir(path)), np.nan)


class Board:
    """To be created before the workers, each of which writes to its own row, mine."""

    def __init__(self, workers):
        self._rows = np.frombuffer(mmap.mmap(-1, 8 * workers * len(FIELDS)), float).reshape(workers, -1)
        self.mine = 0

    def write(self, **values):
        """Writes all FIELDS except the time."""
        values["at"] = time.monotonic()  # one clock for all processes
        self._rows[self.mine] = [values[name] for name in FIELDS]

    def leave(self):
        """Removes this worker."""
        self._rows[self.mine] = 0

    def read(self):
        """{worker: {field: number}} of the live workers."""
        heard = time.monotonic() - HEARD
        return {worker: dict(zip(FIELDS, row.tolist(), strict=True)) for worker, row in enumerate(self._rows)
                if row[0] > max(heard, 0)}  # fmt: skip


class Watch:
    """Reports the state of this worker's admission on the board."""

    def __init__(self, board, admission):
        self.board, self._admission = board, admission
        self._delays, self._started = deque([0.0], REMEMBERED), time.time()

    def start(self):
        """From now on, until the process ends."""
        self._due = time.monotonic()
        self._step()

    def _step(self):
        self._delays.append(time.monotonic() - self._due)
        self.look()
        self._due = time.monotonic() + STEP
        IOLoop.current().call_later(STEP, self._step)

    def look(self):
        """Writes the present state."""
        admission = self._admission
        queues = {"session": admission.making, "room": rooms()} | POOLS
        self.board.write(
            full=admission.full, stopping=admission.stopping, compiling=compiling(), sessions=len(admission.sessions),
            connections=len(admission.sockets), delay=max(self._delays), memory=memory(),
            files=files() if admission.settings.metrics else np.nan, moves=admission.moves, moving=admission.moving,
            errors=SELDOM.errors, processor=time.process_time(), started=self._started, away=DESK.away,
            **{f"refused {why}": admission.refused[why] for why in REFUSALS},
            **{f"{name} waiting": queue.waiting() for name, queue in queues.items()},
            **{f"{name} turns": queue.turns for name, queue in queues.items()},
            **{f"{name} waited": queue.waited for name, queue in queues.items()},
        )  # fmt: skip

    def now(self):
        """Board.read, with this worker's row of this moment."""
        self.look()
        return self.board.read()
