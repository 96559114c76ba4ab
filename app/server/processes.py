"""The worker processes of a server, and their memory."""

import ctypes
import gc
import logging
import os
from contextlib import suppress

from tornado.process import fork_processes

from app.server.memory import memory

log = logging.getLogger("tippe")

LIBC = ctypes.CDLL(None) if os.name == "posix" else None
REPLACE = 10  # the exit code of a worker that is to be replaced
MOST_LOST = 10_000  # workers that crashed or were replaced, after which the server itself must be at fault
MEGABYTE = 2**20


def workers(count, board):
    """Starts count worker processes. One that crashes is replaced, and all end with this process, however it ends.
    Returns, in each of them, the end of a pipe whose other end this process holds."""
    held, ours = os.pipe()
    try:
        board.mine = fork_processes(count, MOST_LOST)
    except SystemExit:  # by __main__ at SIGTERM
        log.info("stopping the workers")
        os.close(ours)
        with suppress(ChildProcessError):
            while True:
                os.wait()
        raise
    os.close(ours)
    return held


def tidier(admission, replace):
    """A function that collects ended sessions, whose models refer to each other, and returns their memory to the
    system. Live objects are frozen: otherwise Python searches all of them now and then, which takes a second for 100
    sessions and finds nothing. replace: called if the process still exceeds its bound and there are no visitors."""
    known, gone = set(), 0
    bound = admission.settings.memory * MEGABYTE

    def tidy():
        nonlocal known, gone
        now = {session.id for session in admission.sessions}
        made, gone = now - known, gone + len(known - now)
        known, ended = now, gone >= 20 or (gone and not now)
        if ended:
            gone = 0
            gc.unfreeze()
            gc.collect()
            if hasattr(LIBC, "malloc_trim"):  # glibc's
                LIBC.malloc_trim(0)
        if made or ended:
            gc.freeze()
        if bound and admission.served and admission.idle and memory() > bound:
            log.info(
                "%d MB of memory, and nobody here: another worker takes the place of this one", memory() // MEGABYTE
            )
            replace()

    return tidy
