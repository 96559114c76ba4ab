"""The worker processes of a server, and their memory."""

import ctypes
import gc
import logging
import os
from contextlib import suppress

from app.server.memory import memory

log = logging.getLogger("tippe")

LIBC = ctypes.CDLL(None) if os.name == "posix" else None
REPLACE = 10  # the exit code of a worker that is to be replaced
MOST_LOST = 100  # crashed workers, after which the server itself must be at fault
MEGABYTE = 2**20


def workers(count, board):
    """Starts count worker processes. One that ends is replaced, and all end with this process, however it ends.
    Returns, in each of them, the end of a pipe whose other end this process holds."""
    held, ours = os.pipe()
    places, lost = {}, 0  # process: its row of the board
    try:
        while lost <= MOST_LOST:
            for place in {*range(count)} - {*places.values()}:
                process = os.fork()
                if not process:
                    os.close(ours)
                    board.mine = place
                    return held
                places[process] = place
            process, status = os.wait()
            place, code = places.pop(process, None), os.waitstatus_to_exitcode(status)
            if place is not None and code not in (0, REPLACE):
                lost += 1
                log.warning("lost worker %d, process %d: %s", place, process,
                            f"exit code {code}" if code >= 0 else f"signal {-code}")  # fmt: skip
        raise SystemExit(1)
    except SystemExit:  # by __main__ at SIGTERM, or as above
        log.info("stopping the workers")
        os.close(ours)
        with suppress(ChildProcessError):
            while True:
                os.wait()
        raise


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
