"""`python -m tippe_core`: compiles the kernels ahead of time, so that nobody waits for the compiler later.

With WATCHING it ends as soon as its standard input does: if that is a pipe from the process that started it, with that
process, however it ends. Kernels that were compiled by then are stored.
"""

import os
import sys
import threading
from collections.abc import Sequence
from contextlib import nullcontext
from functools import partial

from . import kept
from .ahead import compile_all
from .compiled import why_not

WATCHING = "--until-input-ends"


def main(arguments: Sequence[str] = ()) -> int:
    """Prints what it does; returns the exit code: 1 if the compiled kernels cannot be stored."""
    if WATCHING in arguments:
        threading.Thread(target=_end_with_input, name="input", daemon=True).start()
    reason = why_not()
    if reason:
        print(f"tippe_core computes in Python, some hundred times slower than compiled: {reason}.")
        return 0
    folder = kept.folder()
    if kept.complete(folder):
        print(f"The compiled kernels of tippe_core are kept in {folder}.")
        return 0
    print("Compiling the kernels of tippe_core, once for these sources and this processor, so that nobody has to wait "
          "for it later:", flush=True)  # fmt: skip
    with kept.locked(folder, "ahead") if folder else nullcontext():  # one process compiles, the others wait
        reason = compile_all(partial(print, end="", flush=True))
    if reason:
        print(f"They could not be kept: {reason}.", file=sys.stderr)
        return 1
    size = sum(path.stat().st_size for path in folder.iterdir()) if folder else 0
    print(f"Kept in {folder} ({size / 1e6:.1f} MB).")
    return 0


def _end_with_input() -> None:
    while os.read(0, 1024):
        pass
    os._exit(1)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
