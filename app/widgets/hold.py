"""What changes together is sent together."""

from contextlib import contextmanager
from contextvars import ContextVar

import panel as pn

LATE = ContextVar("late", default=None)  # {what sends: the function}, while changes are held


@contextmanager
def held():
    """Context in which all changes of the page are one message; what later() was given is called once, at the end."""
    if LATE.get() is not None:
        yield
        return
    late = {}
    before = LATE.set(late)
    with pn.io.hold():
        try:
            yield
        finally:
            LATE.reset(before)
            for send in late.values():
                send()


def later(owner, send):
    """Calls send() now, or at the end of held(), once for its owner."""
    late = LATE.get()
    if late is None:
        send()
    else:
        late[id(owner)] = send
