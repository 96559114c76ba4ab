"""The processes of a server, and their memory."""

import ctypes
import gc
import os
from contextlib import suppress

from tornado.process import fork_processes

LIBC = ctypes.CDLL(None) if os.name == "posix" else None


def workers(count):
    """So many processes; one that ends is replaced, and all end with this one, however it ends. Returns, in each of
    them, the end of a pipe whose other end this one holds."""
    held, ours = os.pipe()
    try:
        fork_processes(count)
    except SystemExit:  # by __main__, at SIGTERM
        os.close(ours)
        with suppress(ChildProcessError):
            while True:
                os.wait()
        raise
    os.close(ours)
    return held


def tidier(door):
    """A function that gives the memory of ended sessions back to the system: their models refer to each other. What
    lives is frozen: else Python looks through all of it now and then, which is a second for 100 sessions, and finds
    nothing."""
    known, gone = set(), 0

    def tidy():
        nonlocal known, gone
        now = {session.id for session in door.sessions}
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

    return tidy
