"""Kernels that are not compiled yet are compiled in the background, and run as plain Python until then."""

import logging
import os
import subprocess
import sys
import threading
import time
import warnings
from functools import cache
from pathlib import Path

import tippe_core
from tippe_core import kept
from tippe_core.__main__ import WATCHING
from tippe_core.ahead import compile_all
from tippe_core.compiled import ahead, why_not

DAY = 86400.0  # s
NICE = 5  # the lower priority of the compiler; visitors are answered more slowly until it is done
log = logging.getLogger("tippe")
_compiling = threading.Event()


def compiling() -> bool:
    """Whether kernels are being compiled now."""
    return _compiling.is_set()


@cache
def compile_beside() -> None:
    """Starts compiling if needed, and writes so in the log. To be called before anything is computed; a second call has
    no effect."""
    if log.level == logging.NOTSET:  # under panel serve, which shows only warnings
        log.setLevel(logging.INFO)
    # Compiled kernels divide by 0 without a word, and so do those that run as Python.
    warnings.filterwarnings("ignore", category=RuntimeWarning, module="tippe_core")
    if reason := why_not():
        log.info("kernels run as Python, some hundred times slower than compiled: %s", reason)
        return
    if folder := kept.folder():
        threading.Thread(target=_use, args=(folder,), daemon=True).start()
    if not kept.complete(folder):
        log.info("no compiled kernels are kept for this version and processor: they are compiled beside the server, "
                 "which computes in Python until then. `python -m tippe_core` does it ahead")  # fmt: skip
        begun = threading.Event()
        threading.Thread(target=_compile, args=(begun,), name="compiler", daemon=True).start()
        begun.wait()


def _use(folder: Path) -> None:
    """Another version removes what nothing has used for long, and a server may run for longer."""
    while True:
        kept.used(folder)
        time.sleep(DAY)


def _compile(begun: threading.Event) -> None:
    start = time.monotonic()
    with ahead():
        _compiling.set()
        begun.set()
        if sys.platform == "linux":  # on other systems a thread has no priority of its own
            os.setpriority(os.PRIO_PROCESS, threading.get_native_id(), NICE)
        try:
            if kept.folder() is not None:
                _compile_in_a_process()
            reason = compile_all()  # kernels that are stored already are only read
        except Exception:
            log.exception("compiling ahead ended early; the rest is compiled when it is needed")
            return
        finally:
            _compiling.clear()
    log.info("kernels are compiled, after %.0f s%s", time.monotonic() - start, reason and f", but not kept: {reason}")


def _compile_in_a_process() -> None:
    """A thread that compiles would take turns with the other threads of this process at the interpreter. The child ends
    with this process: its standard input is a pipe that nobody writes to, and the system closes it however this ends.
    """
    home = Path(tippe_core.__file__).parent.parent
    path = os.pathsep.join(filter(None, (str(home), os.environ.get("PYTHONPATH"))))
    low = getattr(subprocess, "BELOW_NORMAL_PRIORITY_CLASS", 0)  # Windows
    with subprocess.Popen([sys.executable, "-m", "tippe_core", WATCHING], env=os.environ | {"PYTHONPATH": path},
                          stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                          creationflags=low) as process:  # fmt: skip
        if hasattr(os, "setpriority"):
            os.setpriority(os.PRIO_PROCESS, process.pid, NICE)
        assert process.stderr
        errors = process.stderr.read()  # not communicate(), which closes the input
    if process.returncode:
        log.warning("compiling in a process of its own failed: %s", errors.strip().rpartition("\n")[2])
