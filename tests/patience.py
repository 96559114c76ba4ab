"""How long a test waits for what should come soon; a busy machine is slow, and software draws."""

import inspect
import time

PATIENCE = 120  # s


def poll(condition, pause, seconds=PATIENCE):
    """The value of a condition as soon as it is true. pause: called between two looks."""
    end = time.monotonic() + seconds
    while not (found := condition()):
        if time.monotonic() > end:
            raise AssertionError(f"waited {seconds:g} s for {source(condition)}, which is still {found!r}")
        pause()
    return found


def source(condition):
    """The text of a function."""
    try:
        return " ".join(inspect.getsource(condition).split())
    except (OSError, TypeError):  # not from a file
        return repr(condition)
